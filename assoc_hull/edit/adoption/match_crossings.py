"""Where given lines meet: contacts with boundary curves, and crossings of families.

All places are found on the *reference* splines, those through a line's own points; the
value of a crossing comes from the curve of lower rank.
"""

from __future__ import annotations

import math
from collections import defaultdict

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, PointKind, SplineBatch
from assoc_hull.geometry.splines.distance import closest_points
from assoc_hull.geometry.splines.plane_intersections import PlaneIntersections, intersect_planes
from assoc_hull.geometry.splines.segments import bezier_points, derivative
from assoc_hull.model.gaps import crossing_normals
from assoc_hull.model.kinds import FAMILIES, BoundaryKind
from assoc_hull.model.tables import HullState

__all__ = [
    "Contact",
    "LineIntersection",
    "find_contacts",
    "find_line_intersections",
    "snap_to_coordinate_planes",
]

_REACH = 0.1
"""Times `Tolerances.factor`: how far (m) the end of a line may lie from the boundary curve it is
meant to end on."""

_LAST_BITS = 8.0
"""Spacings of floating point numbers by which two ways to one place may differ."""

_TOUCH, _BESIDE = 1e-6, 1e-3
"""Times the same: a place this near (m) lies on a boundary; the box of a segment is widened, for
rounding."""


@attrs.frozen(eq=False)
class Contact:
    """A fixed point of a line on a boundary curve.

    Attributes
    ----------
    boundary, curve : int
        The two curves.
    point : int
        Index of the line's point.
    at : float, m
        Parameter on the boundary's reference.
    xyz : (3,), m
        The place.
    sign : int
        Sense in which the boundary passes the plane of the line.
    """

    boundary: int
    curve: int
    point: int
    at: float
    xyz: FloatArray
    sign: int


@attrs.frozen(eq=False)
class LineIntersection:
    """A crossing of two given curves.

    Attributes
    ----------
    a, b : int
        The curves, a of lower rank.
    at : (float, float), m
        Parameters on the references.
    angle_deg : (float, float)
        Between each curve and the other's plane.
    spots : ((3,), (3,)), m
        Places on a and on b.
    gap : float, m
        How far the two curves pass each other, along the hull's normal.
    sign : int
        Sense in which a passes the plane of b.
    """

    a: int
    b: int
    at: tuple[float, float]
    angle_deg: tuple[float, float]
    spots: tuple[FloatArray, FloatArray]
    gap: float
    sign: int


def snap_to_coordinate_planes(
    state: HullState, lines: tuple[int, ...], xyz: FloatArray
) -> FloatArray:
    """Put a place exactly into the coordinate planes of lines."""
    out = np.array(xyz)
    for line in lines:
        exact = state.lines.normal[line] == 1.0
        out[exact] = state.lines.offset[line]
    return out


def _needs(kind: int, is_end: bool) -> BoundaryKind | None:
    if is_end:
        return BoundaryKind.END
    if kind == PointKind.TANGENT:
        return BoundaryKind.FLAT
    return BoundaryKind.KNUCKLE if kind == PointKind.KNUCKLE else None


def find_contacts(
    state: HullState, reference: SplineBatch, kinds: list[np.typing.NDArray[np.int8]]
) -> list[Contact]:
    """Find the boundary curve under each end, tangent and knuckle point of each line.

    Parameters
    ----------
    state : HullState
        Lines, curves and associations; no points yet.
    reference : SplineBatch
        The splines through the given points, by number of curve.
    kinds : list of (n,) int8
        The kinds of the points of each curve.
    """
    found: list[Contact] = []
    known = _Boundaries.of(state, reference)
    for curve in range(reference.count):
        line = state.line_of(curve)
        if state.lines.boundary[line] >= 0:
            continue
        boundaries = _boundaries_of(state, line)
        start, stop = int(reference.start[curve]), int(reference.start[curve + 1])
        for point in range(stop - start):
            is_end = point in (0, stop - start - 1)
            needed = _needs(int(kinds[curve][point]), is_end)
            mine = [b for b, kind in boundaries if kind == needed]
            if needed is None or not mine:
                continue
            place = reference.xyz[start + point]
            contact = _nearest(known, mine, line, place)
            if contact is not None:
                boundary, at, xyz, sign = contact
                found.append(Contact(boundary, curve, point, at, xyz, sign))
    return found


def _boundaries_of(state: HullState, line: int) -> list[tuple[int, BoundaryKind]]:
    """Give the boundary curves associated with the group of a line, with their kinds."""
    group = state.groups.name[int(state.lines.group[line])]
    linked = {pair.a for pair in state.associations if pair.b == group}
    linked |= {pair.b for pair in state.associations if pair.a == group}
    names = state.groups.name.data
    return [
        (curve, BoundaryKind(int(state.lines.boundary[other])))
        for curve in state.live("curves").tolist()
        if state.lines.boundary[other := state.line_of(curve)] >= 0
        and names[int(state.lines.group[other])] in linked
    ]


@attrs.frozen(eq=False)
class _Boundaries:
    """The reference splines, with the boxes of their segments and what was asked before."""

    state: HullState
    reference: SplineBatch
    low: FloatArray
    high: FloatArray
    _met: dict[tuple[int, int], PlaneIntersections] = attrs.field(factory=dict)

    @classmethod
    def of(cls, state: HullState, reference: SplineBatch) -> _Boundaries:
        control = bezier_points(reference)
        beside = state.tolerances.factor * _BESIDE
        return cls(state, reference, control.min(axis=1) - beside, control.max(axis=1) + beside)

    def meet(self, boundary: int, line: int) -> PlaneIntersections:
        """Give where a boundary passes the plane of a line: the same for both ends of it."""
        key = (boundary, line)
        if key not in self._met:
            lines = self.state.lines
            offset = np.array([float(lines.offset[line])])
            curve = self.reference.curve(boundary)
            self._met[key] = intersect_planes(
                curve, lines.normal[line], offset, self.state.tolerances.factor
            )
        return self._met[key]

    def may_touch(self, boundary: int, place: FloatArray) -> bool:
        """Tell whether a place lies in, or right beside, the box of a segment."""
        first, stop = (int(self.reference.start[boundary + i]) - boundary - i for i in (0, 1))
        inside = (self.low[first:stop] <= place) & (place <= self.high[first:stop])
        return bool(inside.all(axis=1).any())


def _nearest(
    known: _Boundaries, boundaries: list[int], line: int, place: FloatArray
) -> tuple[int, float, FloatArray, int] | None:
    """Give the boundary's passage through the line's plane that is nearest to a place.

    Where the boundary runs in the plane there is no passage: then its nearest point.
    """
    state = known.state
    reach, touch = (state.tolerances.factor * each for each in (_REACH, _TOUCH))
    best: tuple[float, int, float, FloatArray, int] | None = None
    for boundary in boundaries:
        met, own = known.meet(boundary, line), state.line_of(boundary)
        planes = (own, line) if state.lines.planar[own] else (line,)
        for i in range(len(met.t)):
            away = float(np.linalg.norm(met.xyz[i] - place))
            if away < reach and (best is None or away < best[0]):
                xyz = snap_to_coordinate_planes(state, planes, met.xyz[i])
                best = (away, boundary, float(met.t[i]), xyz, int(met.sign[i]))
        if (best is not None and best[0] <= touch) or not known.may_touch(boundary, place):
            continue
        at, xyz, away_all = closest_points(known.reference, boundary, place[None])
        if float(away_all[0]) < touch:
            # A last bit that scaling has cost would put a line beside those that end there, too:
            # across the plane of a waterline that it only touches. Powers of two cost none.
            bits = 0.0 if math.frexp(state.tolerances.factor)[0] == 0.5 else _LAST_BITS
            same = np.abs(xyz[0] - place) <= bits * np.spacing(np.abs(place))
            spot = snap_to_coordinate_planes(state, planes, np.where(same, place, xyz[0]))
            best = (0.0, boundary, float(at[0]), spot, 0)
    return None if best is None else best[1:]


def find_line_intersections(state: HullState, reference: SplineBatch) -> list[LineIntersection]:
    """Find all crossings of associated families, in a fixed order."""
    found: list[LineIntersection] = []
    names = state.groups.name.data
    for link in state.associations:
        first, second = names.index(link.a), names.index(link.b)
        pair = sorted(
            (first, second), key=lambda g: (FAMILIES[state.groups.family[g]].rank, names[g])
        )
        if "boundary" in {state.groups.family[group] for group in pair}:
            continue
        found += _pair_up(state, reference, pair[0], pair[1])
    return found


def _pair_up(state: HullState, reference: SplineBatch, a: int, b: int) -> list[LineIntersection]:
    """Match the meetings of two families, plane by plane."""
    on_a, on_b = _meet(state, reference, a, b), _meet(state, reference, b, a)
    found: list[LineIntersection] = []
    reach = state.tolerances.factor * _REACH
    for line_a, line_b in sorted(set(on_a) & {(first, second) for second, first in on_b}):
        ends = [
            (one, other, *_gap(one, other))
            for one in on_a[line_a, line_b]
            for other in on_b[line_b, line_a]
        ]
        used: set[tuple[str, int, float]] = set()
        for one, other, gap, _ in sorted(ends, key=lambda end: (end[2] + 0.01 * end[3], end[0].at)):
            keys = {("a", one.curve, one.at), ("b", other.curve, other.at)}
            if gap > reach or used & keys:
                continue
            used |= keys
            lines = (line_a, line_b)
            spots = (
                snap_to_coordinate_planes(state, lines, one.xyz),
                snap_to_coordinate_planes(state, lines, other.xyz),
            )
            angles = (one.angle_deg, other.angle_deg)
            found.append(
                LineIntersection(
                    one.curve, other.curve, (one.at, other.at), angles, spots, gap, one.sign
                )
            )
    return found


@attrs.frozen(eq=False)
class _Root:
    curve: int
    at: float
    xyz: FloatArray
    tangent: FloatArray
    angle_deg: float
    sign: int


def _gap(one: _Root, other: _Root) -> tuple[float, float]:
    offset = one.xyz - other.xyz
    normal = crossing_normals(one.tangent[None], other.tangent[None])[0]
    return abs(float(offset @ normal)), float(np.linalg.norm(offset))


def _meet(
    state: HullState, reference: SplineBatch, mine: int, other: int
) -> defaultdict[tuple[int, int], list[_Root]]:
    """Meet all curves of one group with all planes of another, by (line, other line)."""
    found: defaultdict[tuple[int, int], list[_Root]] = defaultdict(list)
    groups = state.lines.group[state.curves.line[: reference.count]]
    curves = np.flatnonzero(groups == mine)
    lines = np.flatnonzero(state.lines.planar.data & (state.lines.group.data == other))
    lines = lines[np.argsort(state.lines.offset[lines], kind="stable")]
    if not len(curves) or not len(lines):
        return found
    batch = SplineBatch.join([reference.curve(curve) for curve in curves.tolist()])
    for normal in sorted({tuple(row) for row in state.lines.normal[lines].tolist()}):
        chosen = lines[(state.lines.normal[lines] == normal).all(axis=1)]
        offsets, factor = state.lines.offset[chosen].copy(), state.tolerances.factor
        met = intersect_planes(batch, np.array(normal), offsets, factor)
        for root in _roots(batch, curves, met, np.array(normal)):
            line = int(chosen[root[0]])
            found[state.line_of(root[1].curve), line].append(root[1])
    return found


def _roots(
    batch: SplineBatch, curves: IntArray, met: PlaneIntersections, normal: FloatArray
) -> list[tuple[int, _Root]]:
    slope = derivative(batch, met.curve, met.t)
    tangent = slope / np.linalg.norm(slope, axis=1)[:, None]
    angle = np.degrees(np.arcsin(np.minimum(np.abs(tangent @ normal), 1.0)))
    return [
        (
            int(met.plane[i]),
            _Root(
                int(curves[met.curve[i]]), float(met.t[i]), met.xyz[i], tangent[i],
                float(angle[i]), int(met.sign[i]),
            ),
        )
        for i in range(len(met.t))
    ]  # fmt: skip
