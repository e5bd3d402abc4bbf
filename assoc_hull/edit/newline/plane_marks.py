"""Where a new plane meets the net: the marks that a line there can be cut from."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.errors import NoMeetingError
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.splines.plane_intersections import meet_planes
from assoc_hull.model.kinds import FAMILIES
from assoc_hull.model.roles import BoolArray
from assoc_hull.model.state import HullState

__all__ = ["Marks", "find_guides", "find_marks", "spread"]


@attrs.frozen(eq=False)
class Marks:
    """Where the new plane meets what is there.

    Attributes
    ----------
    curve : (k,) int
        The curve met.
    at : (k,), m
        Parameter on it.
    xyz : (k, 3), m
        The place, exactly in both planes.
    sign : (k,) int
        Sense in which it passes the new plane.
    boundary : (k,) int
        A `BoundaryKind`, or -1 on other lines.
    root : (k,) int
        Which of the curve's meetings with the plane it is, counted along the curve.
    guide : (k,) bool
        Whether the new line is not cut from it, but is to pass it.
    ring : bool
        Whether the last is followed by the first.
    """

    curve: IntArray
    at: FloatArray
    xyz: FloatArray
    sign: IntArray
    boundary: IntArray
    root: IntArray
    guide: BoolArray
    ring: bool = False

    def take(self, chosen: IntArray) -> Marks:
        """Give some of the marks, in the order of the indices."""
        return Marks(
            self.curve[chosen],
            self.at[chosen],
            self.xyz[chosen],
            self.sign[chosen],
            self.boundary[chosen],
            self.root[chosen],
            self.guide[chosen],
            self.ring,
        )

    def join(self, other: Marks) -> Marks:
        """Give these marks and after them those of another set."""
        return Marks(
            np.concatenate([self.curve, other.curve]),
            np.concatenate([self.at, other.at]),
            np.concatenate([self.xyz, other.xyz]),
            np.concatenate([self.sign, other.sign]),
            np.concatenate([self.boundary, other.boundary]),
            np.concatenate([self.root, other.root]),
            np.concatenate([self.guide, other.guide]),
            self.ring,
        )


def _linked(state: HullState, group: int) -> list[int]:
    """Give the groups associated with a group, the lowest rank first."""
    names = state.groups.name.data
    mine = names[group]
    linked = {pair.b for pair in state.associations if pair.a == mine}
    linked |= {pair.a for pair in state.associations if pair.b == mine}
    return sorted(
        (i for i in range(len(names)) if names[i] in linked),
        key=lambda i: (_rank(state, i), names[i]),
    )


def _rank(state: HullState, group: int) -> int:
    return FAMILIES[state.groups.family.data[group]].rank


def _sources(state: HullState, group: int) -> list[int]:
    """Give the groups a new line is cut from: lower ranks, or all if there is but one."""
    others = _linked(state, group)
    lower = [i for i in others if _rank(state, i) < _rank(state, group)]
    if any(_rank(state, i) > 0 for i in lower):
        return lower
    return lower + [i for i in others if _rank(state, i) > _rank(state, group)][:1]


def find_marks(state: HullState, group: int, normal: FloatArray, position: float) -> Marks:
    """Meet every curve that a line of a group is cut from with a new plane.

    Raises
    ------
    NoMeetingError
        If the plane meets fewer than two places.
    """
    found = _meet(state, _sources(state, group), normal, position, guide=False)
    if len(found.curve) < 2:
        raise _misses(state, group, normal, position)
    return found


def find_guides(state: HullState, group: int, normal: FloatArray, position: float) -> Marks:
    """Meet every curve of higher rank, that a line of a group is not cut from, with a new plane."""
    others = set(_linked(state, group)) - set(_sources(state, group))
    return _meet(state, sorted(others), normal, position, guide=True)


def _meet(
    state: HullState, groups: list[int], normal: FloatArray, position: float, *, guide: bool
) -> Marks:
    """Meet every curve of some groups with a new plane."""
    curves = state.live("curves")
    curves = curves[np.isin(state.lines.group.data[state.curves.line.data[curves]], groups)]
    if not len(curves):
        return _no_marks()
    batch = SplineBatch.join([state.spline(curve) for curve in curves.tolist()])
    met = meet_planes(batch, normal, np.array([position]))
    owner = curves[met.curve]
    lines = state.curves.line.data[owner]
    root = np.arange(len(owner)) - np.searchsorted(met.curve, met.curve)
    xyz = met.xyz.copy()
    own = (state.lines.normal.data[lines] == 1.0) & state.lines.planar.data[lines][:, None]
    xyz[own] = np.broadcast_to(state.lines.offset.data[lines][:, None], xyz.shape)[own]
    return Marks(
        owner,
        met.t.copy(),
        xyz,
        met.sign.astype(np.int64),
        state.lines.boundary.data[lines].astype(np.int64),
        root,
        np.full(len(owner), guide),
    )


def _no_marks() -> Marks:
    none = np.zeros(0, np.int64)
    return Marks(none, np.zeros(0), np.zeros((0, 3)), none, none, none, np.zeros(0, np.bool_))


def _misses(state: HullState, group: int, normal: FloatArray, position: float) -> NoMeetingError:
    curves = state.live("curves")
    reach = np.concatenate([state.spline(curve).xyz @ normal for curve in curves.tolist()])
    nearest = max(0.0, float(reach.min() - position), float(position - reach.max()))
    return NoMeetingError(
        f"the plane at {position:g} m of {state.groups.name.data[group]}",
        nearest,
        f"choose a position between {reach.min():.3f} and {reach.max():.3f} m",
    )


def spread(marks: Marks) -> Marks:
    """Drop marks that coincide with one that is kept: contacts first, then lower rank."""
    order = np.lexsort((np.arange(len(marks.curve)), -marks.boundary, marks.guide))
    kept: list[int] = []
    for item in order.tolist():
        away = np.abs(marks.xyz[kept] - marks.xyz[item]).max(axis=1) if kept else np.array([np.inf])
        if away.min() > 1e-3:
            kept.append(item)
    return marks.take(np.array(sorted(kept), np.int64))
