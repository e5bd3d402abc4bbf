"""The order of the marks of a new line.

The planes of the lines that are cut divide the hull into facets. The sense in which a curve passes
the new plane gives the facet that the line comes from and the one it goes on into; all ways
together are made shortest. Where there are no planes to divide by, the nearest mark is next.
`headings` gives the direction at each mark, the fuller side of the hull always on one hand.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.edit.lines.marks import Marks
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.model.gaps import crossing_normals, tangents
from assoc_hull.model.kinds import BoundaryKind
from assoc_hull.model.tables import CurveIntersections, HullState

__all__ = [
    "Trails",
    "forward",
    "headings",
    "nearest_order",
    "through_facets",
]

# --------------------------------------------------------------------------------------
# Without facets: from an end, always to the nearest mark left.


def nearest_order(
    xyz: FloatArray, is_end: np.typing.NDArray[np.bool_], axis: int
) -> list[IntArray]:
    """Order marks into connected pieces.

    Parameters
    ----------
    xyz : (k, 3), m
        The marks.
    is_end : (k,) bool
        Marks at which a piece ends.
    axis : int
        Pieces begin at the end with the lower coordinate along this axis.

    Returns
    -------
    list of (n,) int
        The pieces, the one with the lowest beginning first. Without ends, one piece from
        the lowest mark. Ties by the order given.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.edit.lines.mark_order import nearest_order
    >>> marks = np.array([[3.0, 0, 0], [0, 0, 0], [1, 1, 0], [2, 1, 0]])
    >>> [piece.tolist() for piece in nearest_order(marks, np.array([True, True, False, False]), 0)]
    [[1, 2, 3, 0]]
    """
    left = np.ones(len(xyz), bool)
    pieces: list[IntArray] = []
    while left.any():
        starts = np.flatnonzero(left & is_end)
        if not len(starts):
            if pieces:
                break
            starts = np.flatnonzero(left)
        at = int(starts[np.argmin(xyz[starts, axis])])
        pieces.append(_walk(xyz, is_end, left, at))
    return [piece for piece in pieces if len(piece) > 1]


def _walk(
    xyz: FloatArray,
    is_end: np.typing.NDArray[np.bool_],
    left: np.typing.NDArray[np.bool_],
    at: int,
) -> IntArray:
    """Walk from a mark to the nearest one left, until an end or the last mark."""
    piece = [at]
    left[at] = False
    while left.any():
        rest = np.flatnonzero(left)
        step = xyz[rest] - xyz[at]
        at = int(rest[np.argmin((step * step).sum(axis=1))])
        piece.append(at)
        left[at] = False
        if is_end[at]:
            break
    return np.array(piece, np.int64)


# --------------------------------------------------------------------------------------
# Headings. The hull's normal is the cross product of the tangents of two curves; which way is
# outward follows from the sense of the families: sections run upward, other lines forward.


def forward(state: HullState, curves: IntArray) -> IntArray:
    """Give +1 for curves that run as their family should, -1 for others, (k,) int."""
    found = np.ones(len(curves), np.int64)
    for i, curve in enumerate(curves.tolist()):
        axis = 2 if state.family(state.line_of(curve)).axis == 0 else 0
        ends = state.spline(curve).xyz[[0, -1], axis]
        found[i] = -1 if ends[1] < ends[0] else 1
    return found


def headings(state: HullState, marks: Marks, normal: FloatArray) -> FloatArray:
    """Give the direction of a new line at its marks, (k, 3), unit vectors in its plane.

    `normal` is the unit normal of the plane. Zero where a curve has no crossing.
    """
    outward = np.zeros((len(marks.curve), 3))
    for curve in np.unique(marks.curve[marks.boundary < 0]).tolist():
        at, known = _normals(state, curve)
        mine = np.flatnonzero(marks.curve == curve)
        for axis in range(3 if len(at) else 0):
            outward[mine, axis] = np.interp(marks.at[mine], at, known[:, axis])
    ahead = np.cross(normal, outward)
    length = np.sqrt((ahead * ahead).sum(axis=1))
    found: FloatArray = ahead / np.where(length > 0.0, length, 1.0)[:, None]
    return found


def _normals(state: HullState, curve: int) -> tuple[FloatArray, FloatArray]:
    """Give the hull's outward normal at a curve's crossings with other lines, along it."""
    meets: CurveIntersections = state.curves.meets[curve]
    known = meets.row >= 0
    known[known] = ~state.rows.contact[meets.row[known]]
    rows, at = meets.row[known], meets.parameter[known]
    if not len(rows):
        return at, np.zeros((0, 3))
    side = (state.rows.curve[rows, 0] == curve).astype(np.int64)
    others = state.rows.curve[rows, side]
    own = tangents(state, np.full(len(rows), curve), at)
    theirs = tangents(state, others, state.rows.parameter[rows, side])
    across = crossing_normals(own, theirs)
    outward = np.cross(_left_of(state, curve), own)
    inward = (across * outward).sum(axis=1) < 0.0
    order = np.argsort(at, kind="stable")
    return at[order], np.where(inward[:, None], -across, across)[order]


def _left_of(state: HullState, curve: int) -> FloatArray:
    """Give the vector whose cross product with a curve's tangent points out of the hull."""
    line = state.line_of(curve)
    sense = float(forward(state, np.array([curve]))[0])
    upward = state.family(line).axis == 0
    found: FloatArray = state.lines.normal[line] * (-sense if upward else sense)
    return found


# --------------------------------------------------------------------------------------
# Through the facets of the net: what leaves a facet is joined to what enters it. Going to the
# nearest mark instead takes short cuts where a line turns back on itself, as round a bulb and in
# the neck behind it.

_ASTRAY = 10.0
"""A way between marks counts so many times its length more for each plane it leaps over."""

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
    """Order marks of a plane with a unit normal (3,) into pieces, and rings that end nowhere.

    None where the marks do not decide it: no ends, no planes, or not as many beginnings as endings.
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
    # a ring may be only a short cut past a place where the new line turns back
    against = _backward(marks, headings(state, marks, normal), first, last)
    other = _followed(_joined(np.where(against, _NEVER, cost), first, last), starts)
    return other if _leaps(facets, other) <= _leaps(facets, trails) else trails


def _facets(state: HullState, marks: Marks) -> _Facets | None:
    """Give facets by how many planes of each family lie below them; None without planes."""
    lines = state.curves.line[marks.curve]
    plain = marks.boundary < 0
    groups = np.unique(state.lines.group[lines[plain]])
    live = state.live("lines")
    planes = live[np.isin(state.lines.group[live], groups) & state.lines.planar[live]]
    normals = sorted({tuple(row) for row in state.lines.normal[planes].tolist()})
    if not normals:
        return None
    come, go = [], []
    sense = marks.sign * forward(state, marks.curve)
    for normal in normals:
        family = planes[(state.lines.normal[planes] == normal).all(axis=1)]
        offsets = np.unique(state.lines.offset[family])
        own = plain & np.isin(lines, family)
        height = np.where(own, state.lines.offset[lines], marks.xyz @ np.array(normal))
        below = np.searchsorted(offsets, height)
        # sections run upward, other lines forward: the signs of their passages are opposite
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
    """Give the cost (m) of the way from each mark to each other: longer where it leaps over planes.

    A way from a mark to itself never pays.
    """
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
