"""Smooth lines through pieces of digitised or cut points, fitted so that they intersect.

`plan_piece` splits a piece at its corners and tangent points and fits each stretch between them;
`join_plans` fits all lines again, at once; `make_source` gives the line that a net can adopt.
Points of a piece are (n, 2) in its plane, (n, 3) for a boundary curve in space, m.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise

import attrs
import numpy as np

from assoc_hull.edit.adoption.adopt_lines import match_lines
from assoc_hull.edit.adoption.match_crossings import LineIntersection
from assoc_hull.geometry.curves import FloatArray, IntArray, PointKind, SplineBatch
from assoc_hull.geometry.polylines.circular_arcs import CircularArc
from assoc_hull.geometry.polylines.operations import cumulative_lengths
from assoc_hull.geometry.polylines.smoothing import (
    FitTie,
    PolylineFit,
    SmoothedPolyline,
    fit_polyline,
    join_fits,
    straight_polyline,
)
from assoc_hull.geometry.polylines.straight_runs import StraightRun
from assoc_hull.geometry.splines.plane_intersections import intersect_planes
from assoc_hull.geometry.splines.segments import derivative
from assoc_hull.io.lines.slices import AXES
from assoc_hull.io.slicing.features import (
    FeatureRules,
    PieceFeatures,
    is_well_known,
    plane_columns,
    runs_of,
)
from assoc_hull.model.kinds import BoundaryKind
from assoc_hull.model.line_source import LineSource
from assoc_hull.model.tables import Association

__all__ = [
    "PieceBreak",
    "PiecePlan",
    "Rim",
    "SmoothReport",
    "SmoothStretch",
    "in_space",
    "join_plans",
    "make_source",
    "piece_columns",
    "piece_plane",
    "plan_piece",
    "snap_ends",
]


@attrs.frozen(eq=False)
class PieceBreak:
    """Where a piece is split: length along it (m), point (d,), unit tangent; None at a corner."""

    at: float
    place: FloatArray
    direction: FloatArray | None


@attrs.frozen(eq=False)
class Rim:
    """A smooth boundary curve, and how far (m) the places it was made of lie off it at most."""

    curve: SplineBatch
    residual: float


@attrs.frozen(eq=False)
class SmoothStretch:
    """Part of a piece between two breaks.

    Attributes
    ----------
    ends : (2, d), m
        Its first and last place.
    fitted : PolylineFit or None
        The smooth curve, None where it is straight.
    """

    ends: FloatArray
    fitted: PolylineFit | None

    def draw(self) -> SmoothedPolyline:
        """Give the curve as points."""
        return straight_polyline(self.ends, 5) if self.fitted is None else self.fitted.draw()


@attrs.frozen(eq=False)
class PiecePlan:
    """A piece with its breaks and the curves between them.

    Attributes
    ----------
    part : PieceFeatures
        The piece.
    breaks : tuple of PieceBreak
        In order along it.
    runs : tuple of StraightRun
        Straight runs.
    stretches : tuple of SmoothStretch
        One more than breaks.
    """

    part: PieceFeatures
    breaks: tuple[PieceBreak, ...]
    runs: tuple[StraightRun, ...]
    stretches: tuple[SmoothStretch, ...]


def plan_piece(part: PieceFeatures, rules: FeatureRules | None = None) -> PiecePlan:
    """Split a piece at its features and fit a smooth curve to each stretch."""
    wanted = rules or FeatureRules()
    breaks = [PieceBreak(corner.at, corner.place, None) for corner in part.corners]
    runs = runs_of(part, wanted)
    breaks += [
        PieceBreak(onset.at, onset.place, run.direction)
        for run in runs
        for onset in (run.before, run.after)
        if is_well_known(onset, part.noise, wanted)
    ]
    breaks = _apart(breaks, float(cumulative_lengths(part.points)[-1]))
    drawn = [
        (run.begin if run.before.kind == "end" else run.before.at, run.after.at)
        for run in runs
        if run.before.kind != "gradual" and run.after.kind != "gradual"
    ]
    stretches = tuple(_stretches(part, breaks, drawn))
    return PiecePlan(part, tuple(breaks), runs, stretches)


def _stretches(
    part: PieceFeatures, breaks: list[PieceBreak], drawn: list[tuple[float, float]]
) -> list[SmoothStretch]:
    """Fit a smooth curve between breaks, none within the lengths `drawn` (m) of straight runs."""
    points, at = part.points, cumulative_lengths(part.points)
    ends = [PieceBreak(0.0, points[0], None), *breaks, PieceBreak(float(at[-1]), points[-1], None)]
    found = []
    for low, high in pairwise(ends):
        inside = (at > low.at + 1e-3) & (at < high.at - 1e-3)
        mine = np.concatenate([low.place[None], points[inside], high.place[None]])
        allowed = np.interp([low.at, *at[inside], high.at], at, part.allowed)
        if any(a - 0.05 <= low.at and high.at <= b + 0.05 for a, b in drawn):
            fitted = None
        else:
            # Chords of facets lie on the mesh; those of a digitised line lie inside its hull.
            fitted = fit_polyline(
                mine, allowed, low.direction, high.direction, curved=part.depth == 0.0
            )
        found.append(SmoothStretch(mine[[0, -1]], fitted))
    return found


def _apart(breaks: list[PieceBreak], length: float) -> list[PieceBreak]:
    """Leave out breaks at the ends and tangent points that lie close to another break."""
    out: list[PieceBreak] = []
    for each in sorted(breaks, key=lambda b: (b.direction is not None, b.at)):
        # Corners stand first in this order, so that of two close breaks the corner stays.
        # Two runs of a flat may have been led to one place of its border.
        clear = all(
            abs(each.at - other.at) > 0.3 and np.abs(each.place - other.place).max() > 1e-3
            for other in out
        )
        if clear and 0.3 < each.at < length - 0.3:
            out.append(each)
    return sorted(out, key=lambda b: b.at)


def piece_columns(part: PieceFeatures) -> list[int]:
    """Give the axes (0 x, 1 y, 2 z) of the coordinates that the points of a piece hold."""
    if part.line.group != "boundary":
        return plane_columns(part.line.group)
    if part.points.shape[1] == 3:
        return [0, 1, 2]
    flat = int(np.argmin(np.ptp(part.piece.points, axis=0)))
    return [axis for axis in range(3) if axis != flat]


def in_space(part: PieceFeatures, xy: FloatArray) -> FloatArray:
    """Give points of a piece, (n, d), in space, (n, 3), m."""
    columns = piece_columns(part)
    out = np.empty((len(xy), 3))
    out[:, columns] = xy
    for axis in set(range(3)) - set(columns):
        out[:, axis] = _level(part, axis)
    return out


def _level(part: PieceFeatures, axis: int) -> float:
    """Give the coordinate (m) of the plane of a piece along `axis`."""
    if part.line.group != "boundary":
        return part.line.offset
    level = round(float(np.median(part.piece.points[:, axis])), 6)
    return level + 0.0


def piece_plane(part: PieceFeatures) -> tuple[FloatArray, float] | None:
    """Give unit normal and offset (m) of the plane of a piece, None for one in space."""
    if part.line.group != "boundary":
        return np.eye(3)[AXES[part.line.group]], part.line.offset
    if part.points.shape[1] == 3:
        return None
    axis = next(iter(set(range(3)) - set(piece_columns(part))))
    return np.eye(3)[axis], _level(part, axis)


@attrs.frozen
class SmoothReport:
    """How one piece was smoothed.

    Attributes
    ----------
    line : str
        The line.
    given, points : int
        Points before and after.
    noise : float, m
        Scatter or depth of facets.
    band : float, m
        How far the hull may lie off the smooth line: its residual, what its ends were moved by
        to lie on boundary curves, and the depth of facets or twice the scatter.
    residual : float, m
        Largest distance of a given place from the smooth curve.
    knuckles, tangents : int
        Knuckle and tangent points.
    onsets : tuple of (str, float, float, float)
        Every end of a straight run: kind, length along the piece (m), radius or nan (m) and
        uncertainty (m).
    arcs : tuple of CircularArc
        Its circular arcs, in the coordinates that vary on the piece.
    """

    line: str
    given: int
    points: int
    noise: float
    band: float
    residual: float
    knuckles: int
    tangents: int
    onsets: tuple[tuple[str, float, float, float], ...]
    arcs: tuple[CircularArc, ...] = ()


_FADE = 400.0
"""The line follows its end over this many times the move: it turns by a sixth of a degree."""

_REACH = 0.1
"""How far (m across line and hull) an end may lie from the smooth boundary curve it is on, and as
far besides as this was smoothed: by the depth of coarse facets, that is more."""

_ALONG = 1.0
"""How far (m) it may lie from there at all: a boundary that a line meets at a small angle, as that
of a deck with little sheer, crosses the line's plane far from where facets do."""


def snap_ends(
    part: PieceFeatures, borders: Mapping[str, Sequence[Rim]], least: float
) -> PieceFeatures:
    """Move the ends of a piece onto the smooth boundary curves (by name) they lie on.

    Ends that lie closer than `least` (m) stay: the intersection with the boundary replaces them.
    """
    axis, columns = AXES[part.line.group], plane_columns(part.line.group)
    plane = np.eye(3)[axis], np.array([part.line.offset])
    points, keep = part.points.copy(), np.ones(len(part.points), np.bool_)
    most = 0.0
    for end, name in ((0, part.piece.ends[0]), (-1, part.piece.ends[1])):
        rims = borders.get(name, [])
        met = [intersect_planes(rim.curve, *plane).xyz for rim in rims]
        places = np.concatenate(met)[:, columns] if met else np.zeros((0, 2))
        away = np.linalg.norm(places - part.points[end], axis=1)
        if not len(away):
            continue
        nearest = int(away.argmin())
        smoothed = np.repeat([rim.residual for rim in rims], [len(each) for each in met])[nearest]
        step = places[nearest] - part.points[end]
        # Where the plane cuts the hull at a small angle, a move along the line matters little.
        sine, reach = part.sine[end], _REACH + float(smoothed)
        if not least < sine * away.min() or sine * _across(part.points, end, step) > reach:
            continue
        if away.min() > _ALONG:
            continue
        far = (
            cumulative_lengths(part.points)
            if end == 0
            else cumulative_lengths(part.points[::-1])[::-1]
        )
        # The move fades as a smooth step, so that the line keeps its tangent, and its other end.
        part_way = np.maximum(1.0 - far / min(_FADE * float(away.min()), float(far.max())), 0.0)
        points += (part_way * part_way * (3.0 - 2.0 * part_way))[:, None] * step
        points[end] = places[nearest]
        most = max(most, float(away.min()))
        # Points that the end has come close to would make the line turn back.
        keep &= np.linalg.norm(part.points - part.points[end], axis=1) > 3.0 * away.min()
        keep[end] = True
    if most == 0.0 or keep.sum() < 3:
        return part
    return attrs.evolve(
        part, points=points[keep], allowed=part.allowed[keep], sine=part.sine[keep], moved=most
    )


def _across(points: FloatArray, end: int, step: FloatArray) -> float:
    """Give how far (m) a step from an end of a polyline, 0 or -1, leads off its direction there."""
    from_end = np.linalg.norm(points - points[end], axis=1)
    ahead = points[int(np.argmax(from_end > _REACH))] - points[end]
    size = float(np.linalg.norm(ahead))
    if size == 0.0:
        return float(np.linalg.norm(step))
    along = float(step @ ahead) / size
    return float(np.sqrt(max(float(step @ step) - along * along, 0.0)))


def make_source(plan: PiecePlan, tolerance: float) -> tuple[LineSource, SmoothReport]:
    """Draw a piece as a line that can be adopted within `tolerance` (m) of the smooth curve."""
    part = plan.part
    drawn = [stretch.draw() for stretch in plan.stretches]
    xy, kind, direction = _chain(plan, drawn)
    kept = _to_port(part, xy, kind)
    xy, kind, direction = xy[kept], kind[kept], direction[kept]
    way = np.zeros((len(xy), 3))
    way[:, piece_columns(part)] = direction
    line, sine = (
        part.line,
        np.interp(cumulative_lengths(xy), cumulative_lengths(part.points), part.sine),
    )
    # Ends and tangent points of all lines lie on boundary curves, so these are held closer.
    near = tolerance / sine if line.group != "boundary" else np.full(len(xy), 0.2 * tolerance)
    source = LineSource.make(
        line.group, line.name, in_space(part, xy), kind=kind.tolist(), direction=way,
        tolerance=near, dense=True, plane=piece_plane(part),
        boundary=BoundaryKind.END if line.group == "boundary" else None,
    )  # fmt: skip
    onsets = tuple(
        (o.kind, o.at, o.radius, o.uncertainty)
        for run in plan.runs for o in (run.before, run.after) if o.kind != "end"
    )  # fmt: skip
    residual = max(each.residual for each in drawn)
    band = residual + part.moved + max(part.depth, 2.0 * part.noise)
    report = SmoothReport(
        line.name, len(part.points), len(xy), part.noise, band, residual,
        int((kind == PointKind.KNUCKLE).sum()), int((kind == PointKind.TANGENT).sum()), onsets,
        part.arcs,
    )  # fmt: skip
    return source, report


_BEYOND = 1e-6
"""Points of a smooth line farther (m) beyond the centre plane than rounding takes them are none."""


def _to_port(part: PieceFeatures, xy: FloatArray, kind: np.typing.NDArray[np.int8]) -> IntArray:
    """Leave out smooth points beyond the centre plane: a line along it is smoothed across it."""
    columns = piece_columns(part)
    if part.line.group == "boundary" or 1 not in columns:
        return np.arange(len(xy))
    kept = (xy[:, columns.index(1)] >= -_BEYOND) | (kind != PointKind.SMOOTH)
    kept[[0, -1]] = True
    return np.flatnonzero(kept)


def _chain(
    plan: PiecePlan, drawn: list[SmoothedPolyline]
) -> tuple[FloatArray, np.typing.NDArray[np.int8], FloatArray]:
    """Put the curves of a piece one behind the other: points, kinds and given directions."""
    places = [each.points if i == 0 else each.points[1:] for i, each in enumerate(drawn)]
    last = np.cumsum([len(each) for each in places])[:-1] - 1
    points = np.concatenate(places)
    kind = np.full(len(points), PointKind.SMOOTH, np.int8)
    direction = np.zeros_like(points)
    for i, each in zip(last.tolist(), plan.breaks, strict=True):
        kind[i] = PointKind.KNUCKLE if each.direction is None else PointKind.TANGENT
        if each.direction is not None:
            direction[i] = each.direction
    return points, kind, direction


# --------------------------------------------------------------------------------------
# All lines fitted at once, tied to each other where they intersect.

_ROUNDS = 2
"""How often the intersections are found again: they move as the lines do."""

_LEAST_SINE = 0.05
"""Lines that cross at a smaller angle (sine) have no normal that can be relied on."""


def join_plans(
    plans: Sequence[PiecePlan], associations: Sequence[Association], near: float
) -> list[PiecePlan]:
    """Fit lines that were smoothed one by one again, all at once, so that they intersect.

    `associations` are the pairs of groups that do; a gap of `near` (m) between two lines weighs as
    much as a datum passed by all that is allowed. The order of `plans` is kept.
    """
    found = list(plans)
    for _ in range(_ROUNDS):
        fits = [each.fitted for plan in found for each in plan.stretches]
        numbers = _numbers(fits)
        ties = _ties(found, associations, numbers)
        joined = iter(join_fits([each for each in fits if each is not None], ties, near))
        found = [
            attrs.evolve(
                plan,
                stretches=tuple(
                    each if each.fitted is None else attrs.evolve(each, fitted=next(joined))
                    for each in plan.stretches
                ),
            )
            for plan in found
        ]
    return found


def _numbers(fits: Sequence[PolylineFit | None]) -> list[int]:
    """Give each stretch that is fitted its number, -1 to straight ones."""
    count = iter(range(len(fits)))
    return [-1 if each is None else next(count) for each in fits]


@attrs.frozen(eq=False)
class _Track:
    """Which fit each point of a line comes from: first point, fit and lengths (m) per stretch.

    `kept` are the points that the line has: those beyond the centre plane are left out of it.
    """

    first: IntArray
    number: list[int]
    at: list[FloatArray]
    kept: IntArray

    def find(self, interval: int, part: float) -> tuple[int, float]:
        """Give the fit, -1 if straight, and the length for a place in an interval of points."""
        low, high = self.kept[interval : interval + 2].tolist()
        # What is left out is smooth: an interval never reaches over the end of a stretch.
        stretch = int(np.searchsorted(self.first, low, "right")) - 1
        at, begin = self.at[stretch], int(self.first[stretch])
        below, above = float(at[low - begin]), float(at[high - begin])
        return self.number[stretch], below + part * (above - below)


def _tracks(plans: Sequence[PiecePlan], numbers: Sequence[int]) -> list[_Track]:
    tracks, begin = [], 0
    for plan in plans:
        drawn = [each.draw() for each in plan.stretches]
        at = [each.at for each in drawn]
        first = np.concatenate([[0], np.cumsum([len(each) - 1 for each in at])[:-1]])
        xy, kind, _ = _chain(plan, drawn)
        kept = _to_port(plan.part, xy, kind)
        tracks.append(_Track(first, list(numbers[begin : begin + len(at)]), at, kept))
        begin += len(at)
    return tracks


def _ties(
    plans: Sequence[PiecePlan], associations: Sequence[Association], numbers: Sequence[int]
) -> list[FitTie]:
    """Give a tie for every intersection at which at least one line may move."""
    sources = [make_source(plan, 1.0)[0] for plan in plans]
    reference, intersections = match_lines(sources, associations)
    tracks = _tracks(plans, numbers)
    curve = np.array([[each.a, each.b] for each in intersections]).reshape(-1, 2)
    at = np.array([each.at for each in intersections]).reshape(-1, 2)
    one, other = (_unit(derivative(reference, curve[:, i], at[:, i])) for i in (0, 1))
    across = np.cross(one, other)
    sine = np.sqrt((across * across).sum(axis=1))
    found = []
    for i in np.flatnonzero(sine > _LEAST_SINE).tolist():
        tie = _tie(plans, tracks, reference, intersections[i], across[i] / sine[i])
        if tie is not None:
            found.append(tie)
    return found


def _unit(slope: FloatArray) -> FloatArray:
    return np.asarray(slope / np.sqrt((slope * slope).sum(axis=1))[:, None])


def _tie(
    plans: Sequence[PiecePlan],
    tracks: Sequence[_Track],
    reference: SplineBatch,
    crossing: LineIntersection,
    normal: FloatArray,
) -> FitTie | None:
    """Tie two fits along the common normal of their lines, None where both are straight.

    Along the lines themselves each may slide, so that only the gap across both counts.
    """
    ends = []
    for curve, at, spot in zip((crossing.a, crossing.b), crossing.at, crossing.spots, strict=True):
        knot = reference.knot[int(reference.start[curve]) : int(reference.start[curve + 1])]
        interval = int(np.clip(np.searchsorted(knot, at, "right") - 1, 0, len(knot) - 2))
        part = (at - float(knot[interval])) / float(knot[interval + 1] - knot[interval])
        number, length = tracks[curve].find(interval, part)
        way = normal[piece_columns(plans[curve].part)]
        ends.append((number, length, way, _rest(plans[curve], number, normal, spot)))
    # A straight stretch (-1) comes second: it does not move, and only its height counts.
    ends.sort(key=lambda end: end[0] < 0)
    (a, at_a, way_a, rest_a), (b, at_b, way_b, rest_b) = ends
    return None if a < 0 else FitTie(a, at_a, way_a, b, at_b, way_b, rest_b - rest_a)


def _rest(plan: PiecePlan, number: int, normal: FloatArray, spot: FloatArray) -> float:
    """Give the part of the height along the normal (m) that the fit cannot change.

    That is all of it for a straight stretch, and what the plane of the line holds for others.
    """
    plane = piece_plane(plan.part)
    if number < 0 or plane is None:
        return float(spot @ normal)
    return float(plane[0] @ normal) * plane[1]
