"""Boundary curves through marks of neighbouring lines: knuckle lines and borders of flats.

A mark is a point that one line shows, with its uncertainty ("doubt": 2 standard deviations, m).
The curve is drawn as smooth as the doubts allow; then every line that crosses it gets its corner
or tangent point there. `draw_borders` does all of it; knuckle lines come first, because a straight
run of a flat is looked for between corners.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise

import attrs
import numpy as np
from numpy.polynomial.polynomial import polyfit, polyval

from assoc_hull.geometry.curves import (
    CurveData,
    FloatArray,
    IntArray,
    PointKind,
    SplineBatch,
    freeze,
)
from assoc_hull.geometry.polylines.borders import border_bends, fit_border, order_places
from assoc_hull.geometry.polylines.corners import Corner
from assoc_hull.geometry.polylines.flats import fit_plane
from assoc_hull.geometry.polylines.operations import (
    cumulative_lengths,
    project_on_polyline,
    resample,
    runs_where,
)
from assoc_hull.geometry.polylines.straight_runs import Onset
from assoc_hull.geometry.splines.distance import closest_points, closest_points_each
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.plane_intersections import intersect_planes
from assoc_hull.geometry.splines.segments import derivative, sample
from assoc_hull.io.lines.slices import AXES
from assoc_hull.io.slicing.features import (
    FeatureRules,
    KnuckleTrace,
    PieceFeatures,
    plane_columns,
    runs_of,
)
from assoc_hull.io.slicing.flats import FlatFound, RimMark, find_flats
from assoc_hull.io.slicing.smooth_lines import in_space
from assoc_hull.model.kinds import BoundaryKind
from assoc_hull.model.line_source import LineSource

__all__ = [
    "BoundaryCurve",
    "BoundaryMarks",
    "KnuckleEnds",
    "OutlineCorner",
    "draw_borders",
    "draw_boundary_curve",
    "draw_flats",
    "draw_knuckles",
    "loft_source",
    "plane_intersections",
]

_OVER = (0.05, 0.25)
"""By which parts of its last step a border is led on beyond its last mark, at least and at most:
between them by so much that the line of that mark can be adopted beside its end."""

_ROOM = 1.05
"""Of the least distance of adopted points, so that rounding does not take one away."""

_SURE = 0.2
"""A border is adopted within this part of the doubt of its marks."""


@attrs.frozen(eq=False)
class BoundaryCurve:
    """A boundary curve made from what neighbouring lines show.

    Attributes
    ----------
    name : str
        Such as "flat of side" or "knuckle 1".
    kind : BoundaryKind
        FLAT or KNUCKLE.
    lines : tuple of str
        The lines whose marks it was drawn from, in order along it.
    places : (n, 3), m
        The curve at these marks.
    doubt : (n,), m
        How far each mark may lie off the border, 2 standard deviations.
    residual : float, m
        Largest distance of a mark from the curve.
    taken : int
        Tangent or knuckle points of lines that lie on it.
    """

    name: str
    kind: BoundaryKind
    lines: tuple[str, ...]
    places: FloatArray
    doubt: FloatArray
    residual: float
    taken: int = 0

    def __attrs_post_init__(self) -> None:
        freeze(self.places, self.doubt)


@attrs.frozen(eq=False)
class BoundaryMarks:
    """Marks in order along a border.

    Attributes
    ----------
    lines : tuple of str
        The lines they are on.
    places : (n, 3), m
        Where.
    doubt : (n,), m
        How far each may lie off the border.
    plane : ((3,), float) or None
        Unit normal and offset (m) of its plane, if it has one.
    held : (bool, bool)
        Whether the first and the last is the corner of an outline, at which the border ends.
    """

    lines: tuple[str, ...]
    places: FloatArray
    doubt: FloatArray
    plane: tuple[FloatArray, float] | None
    held: tuple[bool, bool] = (False, False)

    def reversed(self) -> BoundaryMarks:
        """Give the marks the other way round."""
        return BoundaryMarks(
            self.lines[::-1], self.places[::-1].copy(), self.doubt[::-1].copy(), self.plane,
            self.held[::-1],
        )  # fmt: skip


@attrs.frozen(eq=False)
class OutlineCorner:
    """A corner of the outline of an end, as a transom has: name of the line, place (3,), m."""

    name: str
    place: FloatArray


@attrs.frozen(eq=False)
class KnuckleEnds:
    """Where knuckle lines may end: corners of outlines, and curves of the profile by their name."""

    corners: Sequence[OutlineCorner] = ()
    profile: Sequence[tuple[str, SplineBatch]] = ()


def draw_boundary_curve(
    name: str, kind: BoundaryKind, course: BoundaryMarks, rules: FeatureRules, tolerance: float
) -> tuple[LineSource, BoundaryCurve]:
    """Draw a boundary curve through marks, from aft, as smooth as their doubt allows.

    It may pass the smooth curve by `tolerance` (m), or by more where the marks are less sure, and
    is led on a little beyond both ends, so that the lines of the first and last mark cross it;
    at the corner of an outline it ends.
    """
    if course.places[0, 0] > course.places[-1, 0]:
        course = course.reversed()
    corners = border_bends(course.places, course.doubt, rules.border_deg)
    xyz = fit_border(course.places, course.doubt, corners, rules.apart)
    held = [end for end, is_held in zip((0, -1), course.held, strict=True) if is_held]
    xyz[held] = course.places[held]
    away = np.sqrt(((xyz - course.places) ** 2).sum(axis=1))
    kept = _spaced(xyz, course.doubt, corners, rules.apart)
    drawn = xyz[kept]
    ends = np.array([
        _beyond(drawn[1], drawn[0], rules.apart), _beyond(drawn[-2], drawn[-1], rules.apart)
    ])  # fmt: skip
    free = ~np.array(course.held)
    whole = np.concatenate([ends[:1][free[:1]], drawn, ends[1:][free[1:]]])
    kinds = np.full(len(whole), int(PointKind.SMOOTH))
    led = int(free[0])
    kinds[np.searchsorted(kept, np.array(corners, np.int64)) + led] = int(PointKind.KNUCKLE)
    sure = np.maximum(tolerance, _SURE * course.doubt[kept])
    sure = np.concatenate([sure[:1][free[:1]], sure, sure[-1:][free[1:]]])
    source = LineSource.make(
        "boundary", name, _in_plane(whole, course.plane), plane=course.plane, boundary=kind,
        kind=kinds.tolist(), tolerance=sure,
    )  # fmt: skip
    return source, BoundaryCurve(name, kind, course.lines, xyz, course.doubt, float(away.max()))


def _beyond(before: FloatArray, last: FloatArray, apart: float) -> FloatArray:
    """Give the place to which a border is led on straight beyond its last mark."""
    step = last - before
    part = float(np.clip(_ROOM * apart / max(float(np.sqrt(step @ step)), 1e-300), *_OVER))
    # Not beyond the centre plane, which a knuckle that runs into the stem would pass.
    if last[1] > 0.0 > last[1] + 2.0 * part * step[1]:
        part = -0.5 * float(last[1] / step[1])
    return np.asarray(last + part * step)


def _spaced(xyz: FloatArray, doubt: FloatArray, corners: Sequence[int], apart: float) -> IntArray:
    """Give numbers of places `apart` (m) from one another: ends, corners, of others the surest."""
    fixed = {0, len(xyz) - 1, *corners}
    kept = sorted(fixed)
    rest = [i for i in np.argsort(doubt, kind="stable").tolist() if i not in fixed]
    for i in rest:
        if float(np.sqrt(((xyz[kept] - xyz[i]) ** 2).sum(axis=1)).min()) >= apart:
            kept.append(i)
    return np.array(sorted(kept), np.int64)


def _in_plane(xyz: FloatArray, plane: tuple[FloatArray, float] | None) -> FloatArray:
    """Project points (n, 3), m, onto a plane of unit normal and offset (m)."""
    if plane is None:
        return xyz
    normal, offset = plane
    out = xyz + (offset - (xyz * normal).sum(axis=1))[:, None] * normal
    # The coordinate across a plane of the grid is exact, free of the rounding of the line above.
    out[:, normal == 1.0] = offset
    return np.asarray(out)


def loft_source(source: LineSource) -> SplineBatch:
    """Loft a line through its own points."""
    return loft(
        CurveData(
            np.array([0, len(source.points)]), source.points, source.kind, source.direction,
            np.array([source.ends.kind], np.int8), np.array([source.ends.vector], np.float64),
        )
    )  # fmt: skip


def plane_intersections(spline: SplineBatch, part: PieceFeatures) -> FloatArray:
    """Give the places where a boundary curve crosses the plane of a piece, (k, 3), m."""
    normal = np.eye(3)[AXES[part.line.group]]
    return np.asarray(intersect_planes(spline, normal, np.array([part.line.offset])).xyz)


# --------------------------------------------------------------------------------------
# Knuckle lines, on which the lines that cross them are split.

_SAME = 0.1
"""Two knuckle lines are one where a place of one lies this near (m) to the other."""

_APART = 0.3
"""Length (m) of a line around a knuckle line in which its corner is looked for; nearer to an end
of a line there is none."""

_LEAST_DOUBT = 5e-3
"""A mark counts as no surer than this (m): weights of the fit stay bounded."""


def draw_knuckles(
    parts: list[PieceFeatures],
    knuckles: list[KnuckleTrace],
    rules: FeatureRules,
    tolerance: float,
    outlines: KnuckleEnds | None = None,
) -> tuple[list[PieceFeatures], list[LineSource], list[BoundaryCurve]]:
    """Draw knuckle lines, and let every line that crosses one have its corner there.

    `knuckles` were found on lines of single groups; `tolerance` (m) is that of adoption. A knuckle
    line ends at the corner of an outline, or at the stem, that it leads to. Gives the pieces in
    their order, the sources of the boundary curves, and a record of each.
    """
    out = list(parts)
    sources: list[LineSource] = []
    borders: list[BoundaryCurve] = []
    known = [line for each in knuckles for line in _known(each, rules)]
    left = outlines or KnuckleEnds()
    for course in _knuckle_courses(known, tolerance):
        name = f"knuckle {len(borders) + 1}"
        reached, corners = _to_outlines(course, parts, left, rules)
        # Where lines pass by on the way to a corner, the knuckle line is the one without it.
        for drawn in (reached, course) if corners else (course,):
            source, border = draw_boundary_curve(
                name, BoundaryKind.KNUCKLE, drawn, rules, tolerance
            )
            split, taken, missed = _split_on(loft_source(source), out, drawn, rules, tolerance)
            if missed <= taken - len(course.lines):
                out = split
                sources.append(source)
                borders.append(attrs.evolve(border, taken=taken))
                if drawn is not course:
                    free = [each for each in left.corners if each not in corners]
                    left = attrs.evolve(left, corners=free)
                break
    return out, sources, borders


def _to_outlines(
    course: BoundaryMarks,
    parts: Sequence[PieceFeatures],
    outlines: KnuckleEnds,
    rules: FeatureRules,
) -> tuple[BoundaryMarks, list[OutlineCorner]]:
    """Lead a knuckle line on to corners of outlines or the stem, and give where it ends."""
    found = course
    corners: list[OutlineCorner] = []
    for _ in range(2):
        found = found.reversed()
        before, last = found.places[-2:]
        corner = _corner_ahead(before, last, parts, outlines.corners, rules)
        corner = corner or _stem_ahead(found.places, parts, outlines.profile, rules)
        if corner is not None:
            corners.append(corner)
            found = BoundaryMarks(
                (*found.lines, corner.name), np.concatenate([found.places, corner.place[None]]),
                np.append(found.doubt, _LEAST_DOUBT), _plane_with(found.plane, corner.place),
                (found.held[0], True),
            )  # fmt: skip
    return found, corners


def _corner_ahead(
    before: FloatArray,
    last: FloatArray,
    parts: Sequence[PieceFeatures],
    outlines: Sequence[OutlineCorner],
    rules: FeatureRules,
) -> OutlineCorner | None:
    """Give the corner that a knuckle line leads to, as from line to line, and no line between."""
    step = last - before
    axis = int(np.argmax(np.abs(step)))
    way = float(np.sign(step[axis]))
    passed = _next_line(last, axis, way, parts)
    found: list[tuple[float, int]] = []
    for i, corner in enumerate(outlines):
        gap = way * float(corner.place[axis] - last[axis])
        guess = last + step * min(gap / float(np.abs(step[axis])), 2.0)
        guess[axis] = corner.place[axis]
        away = float(np.linalg.norm(corner.place - guess))
        if 0.0 < gap <= passed and away < rules.chain.drift * gap + rules.chain.slack:
            found.append((away, i))
    return outlines[min(found)[1]] if found else None


def _next_line(last: FloatArray, axis: int, way: float, parts: Sequence[PieceFeatures]) -> float:
    """Give how far it is to the next line across an axis, m; infinite if there is none."""
    ahead = [
        way * (part.line.offset - last[axis]) for part in parts if AXES[part.line.group] == axis
    ]
    return min((each for each in ahead if each > _SAME), default=np.inf)


_STEPS = 2.0
"""A knuckle line is led on to the stem by no more than so many steps from line to line."""


def _stem_ahead(
    places: FloatArray,
    parts: Sequence[PieceFeatures],
    profile: Sequence[tuple[str, SplineBatch]],
    rules: FeatureRules,
) -> OutlineCorner | None:
    """Give the place of the profile that a knuckle line leads to, with no line between.

    It is led on along the parabola through its last three places, or straight from two.
    """
    last, step = places[-1], places[-1] - places[-2]
    way, reach = float(np.sign(step[0])), _STEPS * float(np.abs(step[0]))
    if reach <= _SAME:
        return None
    known = places[-3:] if (np.diff(places[-3:, 0]) * way > 0.0).all() else places[-2:]
    # From the last place on: powers of large coordinates would lose digits.
    course = polyfit(known[:, 0] - last[0], known, len(known) - 1)
    most = min(_next_line(last, 0, way, parts), reach)

    def led(place: FloatArray) -> FloatArray:
        return np.asarray(polyval(place[..., 0] - last[0], course).T)

    best, least = None, rules.chain.slack
    for name, spline in profile:
        place = np.asarray(sample(spline, _PROFILE)[1]).reshape(-1, 3)
        gap = way * (place[:, 0] - last[0])
        away = np.linalg.norm(led(place) - place, axis=1)
        away[(gap <= 0.0) | (gap > most)] = np.inf
        near = place[int(away.argmin())]
        if away.min() < least:
            near = closest_points_each(spline, np.zeros(1, np.int64), led(near)[None])[1][0]
            best, least = OutlineCorner(name, near), float(away.min())
    return best


_PROFILE = 64
"""Places between two points of the profile at which a knuckle line is looked for."""


def _plane_with(
    plane: tuple[FloatArray, float] | None, place: FloatArray
) -> tuple[FloatArray, float] | None:
    """Give the plane of a border if a place lies in it too."""
    near = plane is not None and abs(float(place @ plane[0]) - plane[1]) <= 1e-9
    return plane if near else None


def _split_on(
    spline: SplineBatch,
    parts: list[PieceFeatures],
    course: BoundaryMarks,
    rules: FeatureRules,
    tolerance: float,
) -> tuple[list[PieceFeatures], int, int]:
    """Let the lines that cross a knuckle line have their corner there.

    Gives the pieces, how many corners lie on it now, and how many lines that show no mark of it
    pass it by: turns of facets in a row make no knuckle line if most others pass them by, and a
    line that others pass without an intersection would leave the net open.
    """
    out, taken, missed = list(parts), 0, 0
    for i, part in enumerate(parts):
        for place in plane_intersections(spline, part):
            # Where a line runs along it nobody can tell where it crosses: by the doubt there.
            told = _sine(spline, place, part) >= _doubt_at(course, place) / (2.0 * rules.onset)
            split = _split(out[i], place, tolerance) if told else None
            if split is not None:
                out[i] = split
                taken += 1
            elif part.line.name not in course.lines:
                missed += 1
    return out, taken, missed


def _known(line: KnuckleTrace, rules: FeatureRules) -> list[KnuckleTrace]:
    """Give the parts of a knuckle line whose places are known as well as is asked for.

    On a coarse mesh a corner may lie a metre off, which would move the lines by decimetres.
    """
    return [
        KnuckleTrace(line.group, line.lines[a:b], line.places[a:b].copy(),
                    line.turn_deg[a:b].copy(), line.doubt[a:b].copy())
        for a, b in runs_where(line.doubt < 2.0 * rules.onset).tolist()
        if b - a >= rules.chain.lines
    ]  # fmt: skip


def _knuckle_courses(knuckles: list[KnuckleTrace], tolerance: float) -> list[BoundaryMarks]:
    """Put together what sections, waterlines and buttocks show of one knuckle line."""
    groups: list[list[KnuckleTrace]] = []
    for line in sorted(knuckles, key=lambda each: -len(each.lines)):
        same = [mine for mine in groups if any(_is_near(line, other) for other in mine)]
        if same:
            same[0].append(line)
        else:
            groups.append([line])
    return [_course(mine, tolerance) for mine in groups]


def _is_near(line: KnuckleTrace, other: KnuckleTrace) -> bool:
    """Tell whether a point of one knuckle line lies on a chord between two points of another."""
    start, step = other.places[:-1], np.diff(other.places, axis=0)
    away = line.places[:, None, :] - start
    part = (away * step).sum(axis=2) / (step * step).sum(axis=1)
    foot = start + np.clip(part, 0.0, 1.0)[:, :, None] * step
    gap = np.sqrt(((line.places[:, None, :] - foot) ** 2).sum(axis=2))
    # A chord lies off the knuckle line itself by a part of its length.
    near = np.maximum(_SAME, line.doubt)[:, None] + 0.02 * np.sqrt((step * step).sum(axis=1))
    return bool((gap <= near).any())


def _course(mine: list[KnuckleTrace], tolerance: float) -> BoundaryMarks:
    """Put the marks of one knuckle line in order, with its plane where it lies in one."""
    names = [name for line in mine for name in line.lines]
    places = np.concatenate([line.places for line in mine])
    doubt = np.maximum(np.concatenate([line.doubt for line in mine]), _LEAST_DOUBT)
    path = order_places(places, doubt, range(len(mine[0].lines)))
    normal, offset, off = fit_plane(places[path], 0.1 * tolerance)
    flat = 1.0 in normal.tolist() and off <= 0.1 * tolerance
    plane = (normal, round(offset, 4) + 0.0) if flat else None
    return BoundaryMarks(tuple(names[i] for i in path), places[path], doubt[path], plane)


def _split(part: PieceFeatures, place: FloatArray, tolerance: float) -> PieceFeatures | None:
    """Give a piece with its corner at a place of a knuckle line, None where it has none."""
    if part.piece.closed or part.points.shape[1] != 2:
        return None
    here = place[plane_columns(part.line.group)]
    at = cumulative_lengths(part.points)
    foot, away = project_on_polyline(part.points, at, here)
    sine = float(np.interp(foot, at, part.sine))
    if not _APART < foot < at[-1] - _APART:
        return None
    near = [corner for corner in (*part.corners, *part.suggested) if abs(corner.at - foot) < _APART]
    if not near and away > max(tolerance, 3.0 * part.noise) / sine:
        return None
    old = min(near, key=lambda each: abs(each.at - foot)) if near else None
    new = _turning(part, foot, here) if old is None else attrs.evolve(old, at=foot, place=here)
    kept = [corner for corner in part.corners if corner is not old]
    rest = tuple(corner for corner in part.suggested if corner is not old)
    corners = tuple(sorted([*kept, new], key=lambda corner: corner.at))
    return attrs.evolve(part, corners=corners, suggested=rest)


def _doubt_at(course: BoundaryMarks, place: FloatArray) -> float:
    """Give the larger doubt (m) of the two marks between which a place lies."""
    start, step = course.places[:-1], np.diff(course.places, axis=0)
    along = ((place - start) * step).sum(axis=1) / (step * step).sum(axis=1)
    foot = start + np.clip(along, 0.0, 1.0)[:, None] * step
    near = int(np.argmin(((place - foot) ** 2).sum(axis=1)))
    return float(course.doubt[near : near + 2].max())


def _sine(spline: SplineBatch, place: FloatArray, part: PieceFeatures) -> float:
    """Give the sine of the angle between a knuckle line and the plane of a piece."""
    at = closest_points(spline, 0, place[None])[0]
    slope = derivative(spline, np.array([0]), at)[0]
    return abs(float(slope[AXES[part.line.group]])) / float(np.sqrt(slope @ slope))


def _turning(part: PieceFeatures, foot: float, here: FloatArray) -> Corner:
    """Give a corner where the piece shows none of its own, with the turn of its chords there."""
    chain = resample(part.points, foot + _APART * np.array([-1.0, 0.0, 1.0]))
    before, after = np.diff(chain, axis=0)
    cross = before[0] * after[1] - before[1] * after[0]
    turn = abs(float(np.rad2deg(np.arctan2(cross, before @ after))))
    return Corner(foot, here.copy(), turn, np.nan, 2.0 * _APART, np.nan)


# --------------------------------------------------------------------------------------
# Borders of flats, drawn from the ends of straight runs that are known well enough and chain over
# neighbouring lines. A run then ends where the border crosses the plane of its line, in a direction
# that lies in the flat, unless its points leave the flat before.

_NEAR = 0.3
"""How much farther (m) than its doubt the end of a run may lie from a border that takes it."""


def draw_borders(
    parts: list[PieceFeatures],
    knuckles: list[KnuckleTrace],
    rules: FeatureRules,
    tolerance: float,
    outlines: KnuckleEnds | None = None,
) -> tuple[list[PieceFeatures], list[LineSource], list[BoundaryCurve]]:
    """Draw knuckle lines and the borders of flats; lines have their corners and tangents there.

    As `draw_knuckles`; the pieces come back with their straight runs.
    """
    parts = [_measured_again(part) for part in parts]
    parts, sources, borders = draw_knuckles(parts, knuckles, rules, tolerance, outlines)
    parts = [attrs.evolve(part, runs=runs_of(part, rules)) for part in parts]
    parts, more, flats = draw_flats(parts, rules, tolerance)
    return parts, sources + more, borders + flats


def _measured_again(part: PieceFeatures) -> PieceFeatures:
    """Find the corners of a piece again along it, where its end was moved."""
    if part.moved == 0.0 or not part.corners:
        return part
    at = cumulative_lengths(part.points)
    corners = [
        attrs.evolve(corner, at=project_on_polyline(part.points, at, corner.place)[0])
        for corner in part.corners
    ]
    return attrs.evolve(part, corners=tuple(corners))


def draw_flats(
    parts: list[PieceFeatures], rules: FeatureRules, tolerance: float
) -> tuple[list[PieceFeatures], list[LineSource], list[BoundaryCurve]]:
    """Draw the borders of flats, and let the runs of the flats end on them; as `draw_knuckles`."""
    out = list(parts)
    sources: list[LineSource] = []
    borders: list[BoundaryCurve] = []
    for flat in find_flats(parts, rules):
        for course in _rim_courses(flat, parts):
            source, border = draw_boundary_curve(
                flat.name, BoundaryKind.FLAT, course, rules, tolerance
            )
            if _folds(source):
                continue  # its marks are of no one border: lines end on the flat each for itself
            taken = _take(out, flat, loft_source(source))
            sources.append(source)
            borders.append(attrs.evolve(border, taken=taken))
    return out, sources, borders


def _folds(source: LineSource) -> bool:
    """Tell whether a border turns by more than a right angle other than at a knuckle."""
    step = np.diff(source.points, axis=0)
    back = (step[:-1] * step[1:]).sum(axis=1) < 0.0
    return bool((back & (source.kind[1:-1] != PointKind.KNUCKLE)).any())


def _rim_courses(flat: FlatFound, parts: list[PieceFeatures]) -> Iterator[BoundaryMarks]:
    """Give the chained marks of a flat in order along its rim, split where they do not go on."""
    marks = [mark for mark in flat.marks if mark.chain is not None]
    chains = sorted({mark.chain for mark in marks if mark.chain is not None})
    members = [[i for i, mark in enumerate(marks) if mark.chain == chain] for chain in chains]
    doubt = _across(flat, marks, members, parts)
    places = np.array([mark.place for mark in marks]).reshape(-1, 3)
    plane = flat.normal, flat.offset
    while members:
        # The chain that is known best leads; what its path cannot reach starts a course of its own.
        first = min(members, key=lambda each: (float(np.median(doubt[each])), each))
        rest = sorted(i for each in members for i in each)
        order = order_places(places[rest], doubt[rest], [rest.index(i) for i in first])
        path = _unbroken([rest[k] for k in order], first, marks, places)
        lines = tuple(parts[marks[i].part].line.name for i in path)
        yield BoundaryMarks(lines, places[path], doubt[path], plane)
        members = [each for each in members if set(path).isdisjoint(each)]


def _across(
    flat: FlatFound, marks: list[RimMark], members: list[list[int]], parts: list[PieceFeatures]
) -> FloatArray:
    """Give how far each mark may lie off the border, from its doubt along the run, (n,), m."""
    out = np.array([mark.doubt for mark in marks])
    for mine in members:
        along = np.gradient(np.array([marks[i].place for i in mine]), axis=0)
        along = along / np.sqrt((along * along).sum(axis=1))[:, None]
        way = np.array([_ahead(flat, parts[marks[i].part]) for i in mine])
        cosine = (along * way).sum(axis=1)
        # Where a line runs along the border, doubt along the line moves a mark little off it.
        out[mine] *= np.sqrt(np.maximum(1.0 - cosine * cosine, 0.05**2))
    return np.asarray(np.maximum(out, _LEAST_DOUBT))


def _ahead(flat: FlatFound, part: PieceFeatures) -> FloatArray:
    """Give the direction of a line that lies in a flat."""
    way = np.cross(np.eye(3)[AXES[part.line.group]], flat.normal)
    return np.asarray(way / np.sqrt(way @ way))


def _unbroken(
    path: list[int], first: list[int], marks: list[RimMark], places: FloatArray
) -> list[int]:
    """Give the part of a path around its first marks in which no gap is wider than usual."""
    numbers = [path.index(i) for i in first]
    gaps = [
        marks[i].chain != marks[j].chain
        and float(np.linalg.norm(places[i] - places[j]))
        > 2.0 * max(marks[i].spacing, marks[j].spacing)
        for i, j in pairwise(path)
    ]
    begin = max([k + 1 for k in range(min(numbers)) if gaps[k]], default=0)
    end = min([k for k in range(max(numbers), len(gaps)) if gaps[k]], default=len(path) - 1)
    return path[begin : end + 1]


def _take(parts: list[PieceFeatures], flat: FlatFound, spline: SplineBatch) -> int:
    """Let the runs of a flat end on its border; give how many do."""
    count = 0
    for mark in flat.marks:
        part = parts[mark.part]
        met = plane_intersections(spline, part)
        if not len(met):
            continue
        along = np.abs((met - mark.place) @ _ahead(flat, part))
        place = met[int(np.argmin(along))]
        near = along.min() <= max(1.5 * mark.doubt, _NEAR)
        if near and _is_flat(part, mark, place, flat):
            parts[mark.part] = _held(part, mark, place, flat)
            count += 1
    return count


def _is_flat(part: PieceFeatures, mark: RimMark, place: FloatArray, flat: FlatFound) -> bool:
    """Tell whether the points of a run lie on the flat up to a place, as near as is smoothed."""
    at, xyz = cumulative_lengths(part.points), in_space(part, part.points)
    run = (part.runs or ())[mark.run]
    middle = 0.5 * (run.begin + run.end)
    foot = float(at[np.argmin(((xyz - place) ** 2).sum(axis=1))])
    inside = (at >= min(foot, middle)) & (at <= max(foot, middle))
    off = np.abs(xyz[inside] @ flat.normal - flat.offset)
    return bool((off > part.allowed[inside]).sum() <= 0.05 * len(off))


def _held(part: PieceFeatures, mark: RimMark, place: FloatArray, flat: FlatFound) -> PieceFeatures:
    """Let a run begin or end at a place on a border, in a direction that lies in the flat."""
    columns = plane_columns(part.line.group)
    runs = list(part.runs or ())
    run = runs[mark.run]
    ahead = _ahead(flat, part)[columns]
    ahead = ahead if ahead @ run.direction > 0.0 else -ahead
    old = run.after if mark.side else run.before
    at = old.at + float((place - mark.place)[columns] @ ahead)
    kind = old.kind if old.kind == "arc" else "border"
    new = Onset(kind, at, place[columns], old.radius, old.uncertainty)
    run = attrs.evolve(run, direction=ahead + 0.0)
    runs[mark.run] = attrs.evolve(run, after=new) if mark.side else attrs.evolve(run, before=new)
    return attrs.evolve(part, runs=tuple(runs))
