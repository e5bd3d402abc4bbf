"""Putting the marks of a new line in order through the facets of the net.

The planes of the lines that are cut divide the hull into facets. At every mark the sense in
which its curve passes the new plane tells from which facet the new line comes and into which
it goes on: the fuller side of the hull lies always on the same hand. So what leaves a facet
is joined to what enters it. Going to the nearest mark instead takes short cuts where a line
turns back on itself, as round a bulb and in the neck behind it.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.edit.newline.headings import forward, headings
from assoc_hull.edit.newline.plane_marks import Marks
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.model.kinds import BoundaryKind
from assoc_hull.model.state import HullState

__all__ = ["Trails", "through_facets"]

_ASTRAY = 10.0
"""A way between marks counts so many times its length for each plane it leaps over."""

_NEVER = 1e9
"""Longer (m) than any way."""


@attrs.frozen
class Trails:
    """Marks in order.

    Attributes
    ----------
    open : list of (n,) int
        Pieces from end to end.
    rings : list of (n,) int
        Marks that go round and come back.
    """

    open: list[IntArray]
    rings: list[IntArray]


@attrs.frozen(eq=False)
class _Facets:
    """From which facet the new line comes at each mark, and into which it goes, (k, f) int."""

    come: IntArray
    go: IntArray


def through_facets(state: HullState, marks: Marks, normal: FloatArray) -> Trails | None:
    """Order marks into pieces, and into rings that end nowhere.

    Parameters
    ----------
    state : HullState
        The tables.
    marks : Marks
        Where a new plane meets the net.
    normal : (3,)
        Unit normal of the plane.

    Returns
    -------
    Trails or None
        None where the marks do not tell: no ends, no planes, or not as many beginnings as
        endings.
    """
    is_end = marks.boundary == BoundaryKind.END
    if not is_end.any() or is_end.all():
        return None
    facets = _facets(state, marks)
    if facets is None:
        return None
    begins = _begins(marks, facets, is_end)
    first, last = np.flatnonzero(~is_end | begins), np.flatnonzero(~is_end | ~begins)
    if len(first) != len(last):
        return None
    cost, starts = _ways(marks, facets, first, last), np.flatnonzero(is_end & begins)
    trails = _followed(_joined(cost, first, last), starts)
    if not trails.rings:
        return trails
    # A ring may be but a short cut past a place where the new line turns back.
    against = _backward(marks, headings(state, marks, normal), first, last)
    other = _followed(_joined(np.where(against, _NEVER, cost), first, last), starts)
    return other if _leaps(facets, other) <= _leaps(facets, trails) else trails


def _facets(state: HullState, marks: Marks) -> _Facets | None:
    """Give each facet a number a family: that of the planes below it; None without planes."""
    lines = state.curves.line.data[marks.curve]
    plain = marks.boundary < 0
    groups = np.unique(state.lines.group.data[lines[plain]])
    live = state.live("lines")
    planes = live[np.isin(state.lines.group.data[live], groups) & state.lines.planar.data[live]]
    normals = sorted({tuple(row) for row in state.lines.normal.data[planes].tolist()})
    if not normals:
        return None
    come, go = [], []
    sense = marks.sign * forward(state, marks.curve)
    for normal in normals:
        family = planes[(state.lines.normal.data[planes] == normal).all(axis=1)]
        offsets = np.unique(state.lines.offset.data[family])
        own = plain & np.isin(lines, family)
        height = np.where(own, state.lines.offset.data[lines], marks.xyz @ np.array(normal))
        below = np.searchsorted(offsets, height)
        upward = sense * (-1 if normal[0] == 1.0 else 1) > 0
        come.append(below + (own & ~upward))
        go.append(below + (own & upward))
    return _Facets(np.column_stack(come), np.column_stack(go))


def _begins(
    marks: Marks, facets: _Facets, is_end: np.typing.NDArray[np.bool_]
) -> np.typing.NDArray[np.bool_]:
    """Tell at which ends the new line begins: where the nearest mark comes from their facet."""
    begins = np.zeros(len(is_end), bool)
    inner = np.flatnonzero(~is_end)
    for end in np.flatnonzero(is_end).tolist():
        step = marks.xyz[inner] - marks.xyz[end]
        away = np.sqrt((step * step).sum(axis=1))
        after = away * (1.0 + _ASTRAY * np.abs(facets.come[inner] - facets.go[end]).sum(axis=1))
        before = away * (1.0 + _ASTRAY * np.abs(facets.go[inner] - facets.come[end]).sum(axis=1))
        begins[end] = after.min() < before.min()
    return begins


def _ways(marks: Marks, facets: _Facets, first: IntArray, last: IntArray) -> FloatArray:
    """Give the way from each mark to each other (m), much longer where it leaps over planes."""
    step = marks.xyz[first][:, None] - marks.xyz[last][None]
    away = np.sqrt((step * step).sum(axis=2))
    leap = np.abs(facets.go[first][:, None] - facets.come[last][None]).sum(axis=2)
    cost: FloatArray = away * (1.0 + _ASTRAY * leap)
    cost[first[:, None] == last[None]] = _NEVER
    return cost


def _backward(
    marks: Marks, heading: FloatArray, first: IntArray, last: IntArray
) -> np.typing.NDArray[np.bool_]:
    """Tell which ways run against the heading at both their ends."""
    step = marks.xyz[last][None] - marks.xyz[first][:, None]
    leaving = (step * heading[first][:, None]).sum(axis=2)
    arriving = (step * heading[last][None]).sum(axis=2)
    against: np.typing.NDArray[np.bool_] = (leaving < 0.0) & (arriving < 0.0)
    return against


def _leaps(facets: _Facets, trails: Trails) -> int:
    """Count the planes that the ways leap over."""
    ways = [trails.open, [np.append(ring, ring[0]) for ring in trails.rings]]
    return sum(
        int(np.abs(facets.go[way[:-1]] - facets.come[way[1:]]).sum())
        for some in ways
        for way in some
    )


def _joined(cost: FloatArray, first: IntArray, last: IntArray) -> dict[int, int]:
    """Give each mark the one that comes next, so that all ways together are shortest."""
    from scipy.optimize import linear_sum_assignment

    here, there = linear_sum_assignment(cost)
    return dict(zip(first[here].tolist(), last[there].tolist(), strict=True))


def _followed(after: dict[int, int], begins: IntArray) -> Trails:
    """Follow the marks from each beginning; what is left goes round."""
    left = set(after) | set(after.values())

    def follow(at: int) -> IntArray:
        trail: list[int] = []
        while at in left:
            trail.append(at)
            left.discard(at)
            at = after.get(at, -1)
        return np.array(trail, np.int64)

    found = [follow(start) for start in begins.tolist()]
    rings: list[IntArray] = []
    while left:
        rings.append(follow(min(left)))
    return Trails(found, rings)
