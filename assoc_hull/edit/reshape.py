"""Re-shaping a curve: it takes the designer's new shape, the hull around it follows.

The curve's own shared points take the exact meeting of the designer's curve with the
partner planes. All other points in reach get the normal change of the curve, times a fade:
for a waterline or a buttock the change at the same x, fading with the distance seen along
x; for a section the change at its nearest point seen along x, fading along the length.
"""

from __future__ import annotations

from typing import Literal

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.edit.field import FieldContext, Shift, bell, move_normal, row_spacing
from assoc_hull.edit.normals import hull_normals
from assoc_hull.edit.ride import ride_links
from assoc_hull.edit.thread import interval_of
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.closest import closest
from assoc_hull.geometry.crossing import meet_planes
from assoc_hull.geometry.curves import CurveData, FloatArray, IntArray, PointKind, SplineBatch
from assoc_hull.geometry.spline import evaluate, loft
from assoc_hull.model.family import Role, Sort
from assoc_hull.model.make import PointSpec
from assoc_hull.model.recipe import curve_data
from assoc_hull.model.state import HullState

__all__ = ["Reshape", "reshape"]

Fade = Literal["auto"] | tuple[float, float] | None


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
    across_flats: bool

    def shift(self, ground: FieldContext, part: float) -> Shift:
        """Give the displacements for a part of the whole change."""
        own = part * (self.places - self.start)
        if self.radius is None:
            return Shift(self.rows, own, np.zeros(0, np.int64))
        others = ground.free[~np.isin(ground.free, self.rows)]
        others = others[~(ground.state.rows.reader.data[others] == self.curve).any(axis=1)]
        distance = ground.flat_distance[np.searchsorted(ground.free, others)]
        amount = part * self._amount(ground.state.rows.xyz.data[others])
        if not self.across_flats:
            amount = amount * (1.0 - bell(distance / self.radius[1]))
        reach = amount != 0.0
        rest = move_normal(ground, others[reach], amount[reach])
        return Shift(
            np.concatenate([self.rows, rest.rows]), np.concatenate([own, rest.delta]), rest.left
        )

    def exact(self) -> tuple[IntArray, FloatArray]:
        """The curve's own points land on the designer's curve."""
        return self.rows, self.places

    def _amount(self, xyz: FloatArray) -> FloatArray:
        """Give the faded normal change at points, (k,), m."""
        assert self.radius is not None  # noqa: S101 - shift has looked
        if self.along_x:
            fade = bell((xyz[:, 0] - self.old.xyz[0, 0]) / self.radius[0])
            near = np.flatnonzero(fade != 0.0)
            flat = np.array(xyz[near])
            flat[:, 0] = self.old.xyz[0, 0]
            at = closest(self.old, 0, flat)[0] if len(near) else np.zeros(0)
            amount = np.zeros(len(xyz))
            amount[near] = fade[near] * self._change(at)
            return amount
        return self._at_same_x(xyz)

    def _at_same_x(self, xyz: FloatArray) -> FloatArray:
        """Take the change where the old curve has the same x, nearest seen along x."""
        assert self.radius is not None  # noqa: S101 - shift has looked
        levels, place = np.unique(xyz[:, 0], return_inverse=True)
        met = meet_planes(self.old, np.array([1.0, 0.0, 0.0]), levels)
        first = np.searchsorted(met.plane, np.arange(len(levels) + 1))
        amount = np.zeros(len(xyz))
        change = self._change(met.t) if len(met.t) else np.zeros(0)
        for turn in range(int(np.diff(first).max(initial=0))):
            index = first[:-1][place] + turn
            has = np.flatnonzero(index < first[1:][place])
            step = xyz[has, 1:] - met.xyz[index[has], 1:]
            girth = np.sqrt((step * step).sum(axis=1))
            value = change[index[has]] * bell(girth / self.radius[1])
            stronger = np.abs(value) > np.abs(amount[has])
            amount[has[stronger]] = value[stronger]
        return amount

    def _change(self, at: FloatArray) -> FloatArray:
        """Give the normal change of the curve at parameters of the old one, (k,), m."""
        zero = np.zeros(len(at), np.int64)
        here = evaluate(self.old, zero, np.clip(at, 0.0, self.old.knot[-1]))
        inside = (at > self.span[0]) & (at < self.span[1])
        there = closest(self.new, 0, here)[1]
        normal = np.column_stack([np.interp(at, self.old.knot, self.normal[:, i]) for i in range(3)])
        length = np.sqrt((normal * normal).sum(axis=1))
        normal = normal / np.where(length > 1e-12, length, 1.0)[:, None]
        change: FloatArray = ((there - here) * normal).sum(axis=1)
        return np.where(inside, change, 0.0)


def reshape(
    edit: Transaction,
    curve: int,
    points: ArrayLike,
    span: tuple[float, float],
    fade: Fade = "auto",
    *,
    across_flats: bool = False,
) -> list[int]:
    """Ask for a curve to take a new shape.

    Parameters
    ----------
    edit : Transaction
        The edit.
    curve : int
        The curve.
    points : (k, 3), m
        Points of the new shape, in the curve's plane. One that lies in the plane of a
        shared crossing gives that crossing its value; the others become placed points.
    span : (float, float), m
        Where the curve may change: x for waterlines, buttocks and boundary curves, z for
        sections.
    fade : "auto", (r_x, r_g) in m, or None
        How the change fades; None: only this curve's own points move, and gaps are what
        they become.
    across_flats : bool
        Whether the field may move flats.

    Returns
    -------
    list of int
        The placed points that were made.

    Raises
    ------
    BadInputError
        Points off the curve's plane or outside the span, an empty span, radii not above 0.
    """
    state = edit.state
    section = state.family(state.line_of(curve)).axis == 0
    shape = _checked(state, curve, points, span, 2 if section else 0)
    old = state.spline(curve)
    window = _window(old, shape, span, 2 if section else 0)
    new = _designed(state, curve, old, shape, window)
    rows = _own_rows(state, curve, old, window)
    places = _places(state, curve, rows, new)
    mine = (state.rows.sort.data[rows] == Sort.ADOPTED) | (state.rows.role.data[rows] == Role.SHARED)
    rows, places = rows[mine], places[mine]
    radius = _radius(state, fade, shape)
    start = state.rows.xyz.data[rows].copy()
    normals = hull_normals(state)[state.curves.rows.data[curve]]
    edit.pending.fields.append(
        Reshape(curve, old, new, normals, rows, places, start, radius, section, window, across_flats)
    )
    edit.pending.moved_curves.add(curve)
    return _place(edit, curve, shape, places)


def _checked(
    state: HullState, curve: int, points: ArrayLike, span: tuple[float, float], axis: int
) -> FloatArray:
    where = f"in reshape of {state.curves.key.data[curve]}"
    shape = np.atleast_2d(np.array(points, np.float64))
    if shape.ndim != 2 or shape.shape[1] != 3 or not len(shape) or not np.isfinite(shape).all():
        raise BadInputError(f"the points have the shape {shape.shape}", where, "give (k, 3) numbers")
    if not span[0] < span[1]:
        raise BadInputError(f"the span {span} is empty", where, "give (lower, upper)")
    off = (shape[:, axis] <= span[0]) | (shape[:, axis] >= span[1])
    if off.any():
        raise BadInputError(
            f"the point {shape[off][0].tolist()} lies outside the span {span}", where,
            "widen the span or leave the point out",
        )  # fmt: skip
    line = state.line_of(curve)
    if state.lines.planar.data[line]:
        away = np.abs(shape @ state.lines.normal.data[line] - state.lines.offset.data[line])
        if away.max() > 1e-9:
            raise BadInputError(
                f"a point lies {away.max():.3g} m off the plane of the line", where,
                "put it in the plane",
            )  # fmt: skip
    return shape


def _window(
    old: SplineBatch, shape: FloatArray, span: tuple[float, float], axis: int
) -> tuple[float, float]:
    """Give the stretch of the old curve, by parameter, that holds the points within the span."""
    at = closest(old, 0, shape)[0]
    outside = (old.xyz[:, axis] <= span[0]) | (old.xyz[:, axis] >= span[1])
    before = old.knot[outside & (old.knot <= at.min())]
    after = old.knot[outside & (old.knot >= at.max())]
    low = float(before.max()) if len(before) else float(old.knot[0])
    high = float(after.min()) if len(after) else float(old.knot[-1])
    return low, high


def _designed(
    state: HullState, curve: int, old: SplineBatch, shape: FloatArray, window: tuple[float, float]
) -> SplineBatch:
    """Loft the designer's curve: the old points outside the stretch, the new ones inside."""
    data = curve_data(state, np.array([curve]))
    keep = (old.knot <= window[0]) | (old.knot >= window[1])
    at = closest(old, 0, shape)[0]
    order = np.argsort(np.concatenate([old.knot[keep], at]), kind="stable")
    kind = np.concatenate([data.kind[keep], np.full(len(shape), int(PointKind.SMOOTH), np.int8)])
    direction = np.concatenate([data.direction[keep], np.zeros((len(shape), 3))])
    return loft(
        CurveData(
            np.array([0, len(order)]),
            np.concatenate([old.xyz[keep], shape])[order],
            kind[order],
            direction[order],
            data.end_kind.copy(),
            data.end_vector.copy(),
        ),
        [f"the new shape of {state.curves.key.data[curve]}"],
    )


def _own_rows(
    state: HullState, curve: int, old: SplineBatch, window: tuple[float, float]
) -> IntArray:
    inside = (old.knot > window[0]) & (old.knot < window[1])
    rows: IntArray = state.curves.rows.data[curve][inside]
    return rows[state.rows.sort.data[rows] != Sort.PLACED]


def _places(state: HullState, curve: int, rows: IntArray, new: SplineBatch) -> FloatArray:
    """Give the meeting of the designer's curve with each crossing's plane, nearest first."""
    places = closest(new, 0, state.rows.xyz.data[rows])[1].copy() if len(rows) else np.zeros((0, 3))
    for i, row in enumerate(rows.tolist()):
        if state.rows.sort.data[row] != Sort.CROSSING:
            continue
        pair = state.rows.curve.data[row]
        other = state.line_of(int(pair[0] if pair[1] == curve else pair[1]))
        if not state.lines.planar.data[other]:
            continue
        plane = state.lines.normal.data[other].copy(), state.lines.offset.data[[other]].copy()
        met = meet_planes(new, *plane)
        if len(met.t):
            step = met.xyz - state.rows.xyz.data[row]
            places[i] = met.xyz[int(np.argmin((step * step).sum(axis=1)))]
        exact = state.lines.normal.data[other] == 1.0
        places[i, exact] = state.lines.offset.data[other]
    line = state.line_of(curve)
    if state.lines.planar.data[line]:
        places[:, state.lines.normal.data[line] == 1.0] = state.lines.offset.data[line]
    return places


def _radius(state: HullState, fade: Fade, shape: FloatArray) -> tuple[float, float] | None:
    if fade is None:
        return None
    if fade == "auto":
        middle = shape[len(shape) // 2]
        girth = 3.0 * row_spacing(state, middle)
        return 3.0 * _station_spacing(state), girth
    if not all(np.isfinite(each) and each > 0.0 for each in fade):
        raise BadInputError(f"the fade {fade}", "in reshape", "give two radii above 0")
    return float(fade[0]), float(fade[1])


def _station_spacing(state: HullState) -> float:
    lines = state.live("lines")
    across = lines[state.lines.planar.data[lines] & (state.lines.normal.data[lines, 0] == 1.0)]
    offsets = np.sort(state.lines.offset.data[across])
    return float(np.median(np.diff(offsets))) if len(offsets) > 1 else state.particulars.length / 20.0


def _place(
    edit: Transaction, curve: int, shape: FloatArray, places: FloatArray
) -> list[int]:
    """Make placed points of the designer's points that no crossing holds."""
    state = edit.state
    made: list[int] = []
    for point in shape:
        if len(places) and float(np.abs(places - point).max(axis=1).min()) < 1e-9:
            continue
        row = int(edit.maker.points([PointSpec(curve, point, Sort.PLACED)])[0])
        rows: IntArray = state.curves.rows.data[curve]
        index = interval_of(state.rows.xyz.data[rows], point)
        edit.maker.define(curve, np.insert(rows, index, row))
        edit.pending.structural = True
        edit.pending.curves.add(curve)
        made.append(row)
    if made:
        ride_links(state, np.array([curve]), edit.journal)
    return made

