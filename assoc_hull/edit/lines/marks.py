"""Marks of a new line: where its plane meets the net, which of them it needs, and their order.

A new line is cut from curves of lower rank and from boundary curves. Lines of higher rank were
fitted to the hull too: their places come among its marks as guides. Beside those that the role
rule chooses, marks are required that the line would else pass too far off. Where a curve touches
the plane, a tangency replaces its double root.

The order of the marks of a new line.

The planes of the lines that are cut divide the hull into facets. The sense in which a curve passes
the new plane gives the facet that the line comes from and the one it goes on into; all ways
together are made shortest. Where there are no planes to divide by, the nearest mark is next.
`headings` gives the direction at each mark, the fuller side of the hull always on one hand.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import attrs
import numpy as np

from assoc_hull.edit.crossings.adopted_points import (
    NO_ROOT,
    parameter_at_tangency,
    stays_near_plane,
    without_double_roots,
)
from assoc_hull.edit.crossings.settle_crossings import one_place
from assoc_hull.errors import NoMeetingError
from assoc_hull.geometry.curves import (
    CurveData,
    FloatArray,
    IntArray,
    SplineBatch,
)
from assoc_hull.geometry.splines.distance import closest_points
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.plane_intersections import PlaneIntersections, intersect_planes
from assoc_hull.geometry.splines.segments import derivative
from assoc_hull.model.gaps import crossing_normals, tangents
from assoc_hull.model.kinds import FAMILIES, BoundaryKind
from assoc_hull.model.roles import BoolArray
from assoc_hull.model.tables import CurveIntersections, HullState

if TYPE_CHECKING:
    from assoc_hull.edit.crossings.adopted_points import PlaneTangency

__all__ = [
    "Marks",
    "Trails",
    "distinct_marks",
    "find_guides",
    "find_marks",
    "forward",
    "headings",
    "nearest_order",
    "one_end_a_place",
    "plane_misses",
    "required_marks",
    "through_facets",
    "with_guides",
    "with_tangencies",
]


def with_tangencies(
    state: HullState, marks: Marks, line: int, touches: Sequence[PlaneTangency]
) -> Marks:
    """Put the tangencies of a line among its marks, and take out the double roots they stand for.

    Those of boundary curves on which lines end become marks at which the line turns.
    """
    normal, offset = state.lines.normal[line], float(state.lines.offset[line])
    kept = np.ones(len(marks.curve), bool)
    for each in touches:
        kept &= ~((marks.curve == each.curve) & ~without_double_roots(state, marks.xyz, each.xyz))
        kept &= ~_along(state, marks, each, normal, offset)
    found = marks.take(np.flatnonzero(kept))
    ends = [
        each for each in touches
        if state.lines.boundary[state.line_of(each.curve)] == BoundaryKind.END
    ]  # fmt: skip
    return found.join(_as_marks(state, ends)) if ends else found


def _as_marks(state: HullState, touches: Sequence[PlaneTangency]) -> Marks:
    count = len(touches)
    at = [
        float(closest_points(state.spline(each.curve), 0, each.xyz[None])[0][0]) for each in touches
    ]
    return Marks(
        np.array([each.curve for each in touches], np.int64),
        np.array(at),
        np.array([each.xyz for each in touches]),
        np.zeros(count, np.int64),
        np.full(count, int(BoundaryKind.KNUCKLE)),
        np.full(count, NO_ROOT),
        np.zeros(count, bool),
    )


def _along(
    state: HullState, marks: Marks, touch: PlaneTangency, normal: FloatArray, offset: float
) -> np.typing.NDArray[np.bool_]:
    """Tell which marks lie on curves that run nearly in the plane from a tangency to the mark."""
    found = np.zeros(len(marks.curve), bool)
    for curve in np.unique(marks.curve).tolist():
        start = parameter_at_tangency(state, curve, touch.xyz)
        for i in np.flatnonzero(marks.curve == curve).tolist() if start is not None else []:
            found[i] = stays_near_plane(
                state, curve, (start or 0.0, float(marks.at[i])), (normal, offset)
            )
    return found


# --------------------------------------------------------------------------------------
# Marks of a new plane.


@attrs.frozen(eq=False)
class Marks:
    """Where the new plane meets the net.

    Attributes
    ----------
    curve : (k,) int
        The curve met.
    at : (k,), m
        Parameter on it.
    xyz : (k, 3), m
        The place, exactly in both planes.
    sign : (k,) int
        Sense in which it passes the new plane: +1 to the positive side, -1 or 0.
    boundary : (k,) int
        A `BoundaryKind`, or -1 on other lines.
    root : (k,) int
        Which of the curve's intersections with the plane it is, counted along the curve;
        `NO_ROOT` at a tangency.
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
    return FAMILIES[state.groups.family[group]].rank


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
        raise plane_misses(state, group, normal, position)
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
    curves = curves[np.isin(state.lines.group[state.curves.line[curves]], groups)]
    if not len(curves):
        return _no_marks()
    batch = SplineBatch.join([state.spline(curve) for curve in curves.tolist()])
    met = intersect_planes(batch, normal, np.array([position]), state.tolerances.factor)
    owner = curves[met.curve]
    lines = state.curves.line[owner]
    root = np.arange(len(owner)) - np.searchsorted(met.curve, met.curve)
    # the coordinate of the met line's own plane to the last bit, not to rounding
    xyz = met.xyz.copy()
    own = (state.lines.normal[lines] == 1.0) & state.lines.planar[lines][:, None]
    xyz[own] = np.broadcast_to(state.lines.offset[lines][:, None], xyz.shape)[own]
    return Marks(
        owner,
        met.t.copy(),
        xyz,
        met.sign.astype(np.int64),
        state.lines.boundary[lines].astype(np.int64),
        root,
        np.full(len(owner), guide),
    )


def _no_marks() -> Marks:
    none = np.zeros(0, np.int64)
    return Marks(none, np.zeros(0), np.zeros((0, 3)), none, none, none, np.zeros(0, np.bool_))


def plane_misses(
    state: HullState, group: int, normal: FloatArray, position: float
) -> NoMeetingError:
    """Give the error of a plane that cuts no line: beside the hull, or at its very edge."""
    curves = state.live("curves")
    reach = np.concatenate([state.spline(curve).xyz @ normal for curve in curves.tolist()])
    nearest = max(0.0, float(reach.min() - position), float(position - reach.max()))
    return NoMeetingError(
        f"the plane at {position:g} m of {state.groups.name[group]}", nearest,
        f"choose a position above {reach.min():.3f} and below {reach.max():.3f} m",
        touches=nearest == 0.0,
    )  # fmt: skip


_ONE_MARK = 1e-3
"""Times `Tolerances.factor`: marks nearer than this (m) are one: the role rule would take none."""


def distinct_marks(state: HullState, marks: Marks) -> Marks:
    """Drop marks that coincide with one that is kept: contacts first, then lower rank."""
    return marks.take(_distinct(state, marks))


def one_end_a_place(state: HullState, marks: Marks) -> Marks:
    """Drop marks that coincide at a corner of two boundary curves on which lines end.

    Two of them would make a piece of no length. One stays where the line begins there; none where
    it only touches the corner, which shows by the number of ends: every piece has two.
    """
    ends = np.flatnonzero(marks.boundary == BoundaryKind.END)
    kept = ends[_distinct(state, marks.take(ends))]
    double = np.setdiff1d(ends, kept)
    if len(double) and len(kept) % 2:
        least = state.tolerances.factor * _ONE_MARK
        away = np.abs(marks.xyz[kept] - marks.xyz[double[0]]).max(axis=1)
        kept = kept[away > least]
    others = np.flatnonzero(marks.boundary != BoundaryKind.END)
    return marks.take(np.union1d(others, kept))


def _distinct(state: HullState, marks: Marks) -> IntArray:
    """Give the numbers of marks that stay, rising."""
    order = np.lexsort((np.arange(len(marks.curve)), -marks.boundary, marks.guide))
    kept: list[int] = []
    least = state.tolerances.factor * _ONE_MARK
    for item in order.tolist():
        away = np.abs(marks.xyz[kept] - marks.xyz[item]).max(axis=1) if kept else np.array([np.inf])
        if away.min() > least:
            kept.append(item)
    return np.array(sorted(kept), np.int64)


# --------------------------------------------------------------------------------------
# Guides: between its marks, lines of higher rank know better where the new line, made through its
# marks, would pass them far off or not come to their planes at all.


def with_guides(state: HullState, line: int, pieces: list[Marks]) -> list[Marks]:
    """Put the places where lines of higher rank pass a new line's plane among its marks.

    `pieces` are in order along the line; each guide goes between the marks of the nearest one, or
    is left out where it lies farther than `one_place` from all.
    """
    normal, offset = state.lines.normal[line].copy(), float(state.lines.offset[line])
    guides = find_guides(state, int(state.lines.group[line]), normal, offset)
    if not len(guides.curve) or not pieces:
        return pieces
    # Two marks may lie at one place, where a line begins at the corner of two boundary curves.
    kept = [_distinct(state, piece) for piece in pieces]
    shapes = SplineBatch.join([
        loft(CurveData.single(piece.xyz[some])) for piece, some in zip(pieces, kept, strict=True)
    ])  # fmt: skip
    feet = [closest_points(shapes, i, guides.xyz) for i in range(len(pieces))]
    away = np.array([foot[2] for foot in feet])
    nearest = np.where(away.min(axis=0) <= one_place(state), away.argmin(axis=0), -1)
    found: list[Marks] = []
    for i, piece in enumerate(pieces):
        mine = np.flatnonzero(nearest == i)
        knots = shapes.knot[shapes.start[i] : shapes.start[i + 1]]
        off = np.abs(piece.xyz[:, None] - piece.xyz[kept[i]][None]).max(axis=2)
        own = knots[off.argmin(axis=1)]
        at = np.concatenate([own, _between(feet[i][0][mine], knots)])
        found.append(piece.join(guides.take(mine)).take(np.argsort(at, kind="stable")))
    return found


def _between(at: FloatArray, knots: FloatArray) -> FloatArray:
    """Keep parameters off the ends of a piece: these are boundary curves' and stay the ends."""
    found: FloatArray = np.clip(at, np.nextafter(knots[0], np.inf), np.nextafter(knots[-1], 0.0))
    return found


# --------------------------------------------------------------------------------------
# Required marks. A line through those of the role rule alone may pass another mark too far off, or
# never come to the plane of the mark's line near it. Then the crossing there would be lost, though
# both lines pass: it would die, and be born again farther on, with the hull's shape the same.


def required_marks(
    state: HullState,
    marks: Marks,
    kind: np.typing.NDArray[np.int8],
    direction: FloatArray,
    ruled: BoolArray,
) -> BoolArray:
    """Add the marks that a line through those of the rule alone would pass too far off.

    Without them a short piece between two ends would be straight, and its crossings lost.

    Parameters
    ----------
    state : HullState
        The tables.
    marks : Marks
        Where the line passes, in order along it, with guides.
    kind, direction : (k,) int8, (k, 3)
        Of the line at its marks.
    ruled : (k,) bool
        What the rule chooses.

    Returns
    -------
    (k,) bool
        The marks that the line is to be made through. It meets the planes of all others
        near them; those it is cut from it passes within the tolerance of adoption.
    """
    picked = ruled.copy()
    while not picked.all():
        spline = loft(CurveData.single(marks.xyz[picked], kind[picked], direction[picked]))
        rest = np.flatnonzero(~picked)
        away = closest_points(spline, 0, marks.xyz[rest])[2]
        far = (away > state.tolerances.adoption) & ~marks.guide[rest]
        far |= _unmet(state, marks, spline)[rest]
        if not far.any():
            break
        picked[rest[int(np.where(far, away, -1.0).argmax())]] = True
    return picked


def _unmet(state: HullState, marks: Marks, spline: SplineBatch) -> BoolArray:
    """Tell at which marks of plane lines a line has no intersection near with their planes."""
    lines = state.curves.line[marks.curve]
    planar = state.lines.planar[lines] & (marks.boundary < 0)
    unmet: BoolArray = planar.copy()
    for normal in sorted({tuple(row) for row in state.lines.normal[lines[planar]].tolist()}):
        mine = np.flatnonzero(planar & (state.lines.normal[lines] == normal).all(axis=1))
        offsets, plane = np.unique(state.lines.offset[lines[mine]], return_inverse=True)
        met = intersect_planes(spline, np.array(normal), offsets, state.tolerances.factor)
        unmet[mine[_paired(state, marks.take(mine), plane, spline, met)]] = False
    return unmet


def _paired(
    state: HullState, marks: Marks, plane: IntArray, spline: SplineBatch, met: PlaneIntersections
) -> IntArray:
    """Give the marks that have an intersection of their own near, the nearest pairs first."""
    mark, root = np.nonzero(plane[:, None] == met.plane[None, :])
    step = marks.xyz[mark] - met.xyz[root]
    apart = np.sqrt((step * step).sum(axis=1))
    theirs = tangents(state, marks.curve, marks.at)[mark]
    slope = derivative(spline, np.zeros(len(root), np.int64), met.t[root])
    own = slope / np.sqrt((slope * slope).sum(axis=1))[:, None]
    gap = np.abs((step * crossing_normals(own, theirs)).sum(axis=1))
    near = (apart <= one_place(state)) & (gap <= state.tolerances.adoption)
    taken: tuple[set[int], set[int]] = set(), set()
    for i in np.flatnonzero(near)[np.argsort(apart[near], kind="stable")].tolist():
        one, other = int(mark[i]), int(root[i])
        if one not in taken[0] and other not in taken[1]:
            taken[0].add(one)
            taken[1].add(other)
    return np.array(sorted(taken[0]), np.int64)


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
    >>> from assoc_hull.edit.lines.marks import nearest_order
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
