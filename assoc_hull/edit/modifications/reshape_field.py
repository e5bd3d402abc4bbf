"""The field of a re-shaped curve: how the hull around it follows.

For a waterline or a buttock the other points take the curve's normal change at the same x,
fading with the distance seen along x; for a section the change at its nearest point seen
along x, fading along the length. What defines lines of a group that takes nothing from the
curve's, by a one-way association, stays.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.edit.field import FieldContext, Shift, bell, move_normal
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.splines.closest import closest
from assoc_hull.geometry.splines.evaluation import evaluate
from assoc_hull.geometry.splines.plane_intersections import meet_planes
from assoc_hull.model.state import HullState

__all__ = ["Reshape"]


@attrs.frozen(eq=False)
class Reshape:
    """The field of a re-shaped curve.

    Attributes
    ----------
    curve : int
        The curve.
    old, new : SplineBatch
        Its spline before, and the designer's.
    normal : (k, 3)
        Outward normals of the hull at the knots of `old`.
    rows, places : (r,) int, (r, 3), m
        The curve's own points, and where the designer's curve has them.
    start : (r, 3), m
        Where they were.
    radius : (float, float), m, or None
        Fade along the length and the girth; None: no other point moves.
    along_x : bool
        Whether the curve is a section, whose change fades along the length.
    span : (float, float), m
        Parameters on `old` between which the curve changes.
    flat : (k,), m
        Distance of the knots of `old` from the nearest border of a flat. Where another
        point is as far from it as the curve, it moves as much as the curve.
    across_flats : bool
        Whether flats are moved too.
    """

    curve: int
    old: SplineBatch
    new: SplineBatch
    normal: FloatArray
    rows: IntArray
    places: FloatArray
    start: FloatArray
    radius: tuple[float, float] | None
    along_x: bool
    span: tuple[float, float]
    flat: FloatArray
    across_flats: bool

    @property
    def strict(self) -> bool:
        """Whether the curve's own points move and no other."""
        return self.radius is None

    def shift(self, ground: FieldContext, part: float) -> Shift:
        """Give the displacements for a part of the whole change."""
        own = part * (self.places - self.start)
        if self.radius is None:
            return Shift(self.rows, own, np.zeros(0, np.int64))
        others = ground.free[~np.isin(ground.free, self.rows)]
        others = others[~(ground.state.rows.reader.data[others] == self.curve).any(axis=1)]
        others = others[~_defines(ground.state, others, _givers(ground.state, self.curve))]
        distance = ground.flat_distance[np.searchsorted(ground.free, others)]
        amount, at = self._amount(ground.state.rows.xyz.data[others])
        amount = part * amount
        if not self.across_flats:
            own_distance = np.interp(at, self.old.knot, self.flat)
            amount = amount * (1.0 - bell(distance / np.minimum(self.radius[1], own_distance)))
        reach = amount != 0.0
        rest = move_normal(ground, others[reach], amount[reach])
        return Shift(
            np.concatenate([self.rows, rest.rows]), np.concatenate([own, rest.delta]), rest.left
        )

    def exact(self) -> tuple[IntArray, FloatArray]:
        """Give the curve's own points, which land on the designer's curve."""
        return self.rows, self.places

    def left(self, state: HullState, done: float) -> float:
        """Give the part of the change that is still to come, when a part is `done`."""
        return 1.0 - done

    def _amount(self, xyz: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give the faded normal change at points, and the parameter it comes from, (k,), m."""
        assert self.radius is not None
        if self.along_x:
            fade = bell((xyz[:, 0] - self.old.xyz[0, 0]) / self.radius[0])
            near = np.flatnonzero(fade != 0.0)
            flat = np.array(xyz[near])
            flat[:, 0] = self.old.xyz[0, 0]
            at, amount = np.zeros(len(xyz)), np.zeros(len(xyz))
            at[near] = closest(self.old, 0, flat)[0] if len(near) else 0.0
            amount[near] = fade[near] * self._change(at[near])
            return amount, at
        return self._at_same_x(xyz)

    def _at_same_x(self, xyz: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Take the change where the old curve has the same x, nearest seen along x."""
        assert self.radius is not None
        levels, place = np.unique(xyz[:, 0], return_inverse=True)
        met = meet_planes(self.old, np.array([1.0, 0.0, 0.0]), levels)
        first = np.searchsorted(met.plane, np.arange(len(levels) + 1))
        amount, at = np.zeros(len(xyz)), np.zeros(len(xyz))
        change = self._change(met.t) if len(met.t) else np.zeros(0)
        for turn in range(int(np.diff(first).max(initial=0))):
            index = first[:-1][place] + turn
            has = np.flatnonzero(index < first[1:][place])
            step = xyz[has, 1:] - met.xyz[index[has], 1:]
            girth = np.sqrt((step * step).sum(axis=1))
            value = change[index[has]] * bell(girth / self.radius[1])
            stronger = np.abs(value) > np.abs(amount[has])
            amount[has[stronger]] = value[stronger]
            at[has[stronger]] = met.t[index[has[stronger]]]
        return amount, at

    def _change(self, at: FloatArray) -> FloatArray:
        """Give the normal change of the curve at parameters of the old one, (k,), m."""
        zero = np.zeros(len(at), np.int64)
        here = evaluate(self.old, zero, np.clip(at, 0.0, self.old.knot[-1]))
        inside = (at > self.span[0]) & (at < self.span[1])
        there = closest(self.new, 0, here)[1]
        normal = np.column_stack(
            [np.interp(at, self.old.knot, self.normal[:, i]) for i in range(3)]
        )
        length = np.sqrt((normal * normal).sum(axis=1))
        normal = normal / np.where(length > 1e-12, length, 1.0)[:, None]
        change: FloatArray = ((there - here) * normal).sum(axis=1)
        return np.where(inside, change, 0.0)


def _givers(state: HullState, curve: int) -> IntArray:
    """Give the groups that generate points on a curve's group and take none from it."""
    names = state.groups.name.data
    mine = names[int(state.lines.group.data[state.line_of(curve)])]
    given = [link.a for link in state.associations if link.b == mine and not link.two_way]
    return np.array([names.index(name) for name in given], np.int64)


def _defines(state: HullState, rows: IntArray, groups: IntArray) -> np.typing.NDArray[np.bool_]:
    """Tell which points define a curve of one of the groups."""
    reader = state.rows.reader.data[rows]
    group = state.lines.group.data[state.curves.line.data[reader]]
    found: np.typing.NDArray[np.bool_] = (np.isin(group, groups) & (reader >= 0)).any(axis=1)
    return found
