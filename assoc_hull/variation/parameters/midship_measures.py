"""Measures of the midship body: bilge, deadrise, flat of bottom, ends of the parallel middle body.

The bilge is sought on the section nearest to midship: between the borders of the flats, or between
the straight runs of bottom and side. The parallel body is where the borders of all flats run
level; without them, where sections are equal in shape. A function's name is that of its
parameter; what it puts into `numbers` stands in its docstring, in m or degrees.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache, partial

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, SplineBatch, freeze
from assoc_hull.geometry.numeric.circle_fit import CircleFit, fit_circle
from assoc_hull.geometry.splines.distance import closest_points
from assoc_hull.geometry.splines.plane_intersections import points_at_coordinate, points_on_plane
from assoc_hull.geometry.splines.segments import derivative, evaluate, sample
from assoc_hull.variation.parameters.measurement import DrawnCurves, MeasuredParameter

__all__ = [
    "SHORTEST_BODY",
    "MeasuredBilge",
    "bilge_radius",
    "deadrise_deg",
    "flat_of_bottom",
    "measure_bilge",
    "parallel_body_end",
    "parallel_body_length",
    "parallel_body_start",
]

# --------------------------------------------------------------------------------------
# The bilge of a section.

_ROUND = 1e-4
"""Defining points of an arc lie as near as this to its circle, in parts of the radius."""

_SAMPLES = 4
"""Places a segment at which sections are compared."""

_STRAIGHT = 1e-6
"""A segment whose unit tangents differ from its chord by no more is straight."""

_TURN = 1.0
"""Bottom and side differ in direction by more than this, radians."""

_CORNER = 1e-3
"""A bilge whose ends are nearer than this (m) is a corner; with a sagitta below this part of its
chord it is not round."""

_KNOT = 1e-9
"""A knot as near as this (m) to an end of the bilge belongs to it."""


@attrs.frozen(eq=False)
class MeasuredBilge:
    """The bilge of a section.

    Attributes
    ----------
    section : int
        The curve of the net.
    low, high : (3,), m
        Where the bottom ends, and where the side begins.
    centre : (2,), m
        y and z of the centre of its circle.
    radius : float, m
        Of the circle.
    off : float, m
        The farthest that a defining point of the bilge lies off the circle.
    arc : bool
        It is an arc; else the circle passes `low`, `high` and the place half-way between.
    """

    section: int
    low: FloatArray
    high: FloatArray
    centre: FloatArray
    radius: float
    off: float
    arc: bool

    def __attrs_post_init__(self) -> None:
        freeze(self.low, self.high, self.centre)


def measure_bilge(hull: DrawnCurves) -> MeasuredBilge | str:
    """Give the bilge of the section nearest to midship, or say why there is none."""
    section = hull.section_amidships
    if section is None:
        return "parent has no section across the ship"
    curve = hull.one(section)
    found = _between_flats(hull, section) or _between_straights(curve)
    if found is None:
        return "parent has no bilge between a flat bottom and a flat side amidships"
    ends = evaluate(curve, np.zeros(2, np.int64), np.array(found))
    if np.abs(ends[1] - ends[0]).max() <= _CORNER:
        return "the bilge of the parent is a corner"
    within = (curve.knot >= min(found) - _KNOT) & (curve.knot <= max(found) + _KNOT)
    knots = np.concatenate([ends, curve.xyz[within]])[:, 1:]
    circle = fit_circle(knots) if within.sum() > 3 else None
    if circle is not None and _off(circle, knots) <= _ROUND * circle.radius:
        return _bilge(section, ends, circle, knots, arc=True)
    three = _through_three(curve, ends, (min(found), max(found)))
    if three is None:
        return "the bilge of the parent is not round"
    return _bilge(section, ends, three, knots, arc=False)


def _bilge(
    section: int, ends: FloatArray, circle: CircleFit, knots: FloatArray, *, arc: bool
) -> MeasuredBilge:
    """Put together a bilge of its ends and circle."""
    low, high = ends[0].copy(), ends[1].copy()
    off = _off(circle, knots)
    return MeasuredBilge(section, low, high, circle.centre.copy(), circle.radius, off, arc)


def _off(circle: CircleFit, places: FloatArray) -> float:
    """Give the farthest that places (n, 2) lie off a circle, m."""
    off = np.sqrt(((places - circle.centre) ** 2).sum(axis=1)) - circle.radius
    return float(np.abs(off).max())


def _between_flats(hull: DrawnCurves, section: int) -> tuple[float, float] | None:
    """Give where a section crosses the flat of bottom's border outermost, and that of side lowest.

    Places along the section, m; None without both.
    """
    bottom = _intersections(hull, section, hull.flats_of_bottom)
    side = _intersections(hull, section, hull.flats_of_side)
    if not len(bottom) or not len(side):
        return None
    curve = hull.one(section)
    at_bottom = evaluate(curve, np.zeros(len(bottom), np.int64), bottom)
    at_side = evaluate(curve, np.zeros(len(side), np.int64), side)
    low, high = int(at_bottom[:, 1].argmax()), int(at_side[:, 2].argmin())
    return float(bottom[low]), float(side[high])


def _intersections(hull: DrawnCurves, section: int, borders: list[int]) -> FloatArray:
    """Give where a section crosses borders of flats, (k,), m along it."""
    meets, place = hull.net.meets, hull.net.place
    found = [
        place[(meets[:, side] == section) & np.isin(meets[:, 1 - side], borders), side]
        for side in (0, 1)
    ]
    return np.concatenate(found)


def _between_straights(curve: SplineBatch) -> tuple[float, float] | None:
    """Give where the straight run from the keel ends, and where the straight side begins.

    Places along the curve, m; None without both.
    """
    chord = np.diff(curve.xyz, axis=0)
    ahead = chord / np.sqrt((chord * chord).sum(axis=1))[:, None]
    straight = np.abs(curve.leave[:-1] - ahead).max(axis=1) <= _STRAIGHT
    straight &= np.abs(curve.arrive[1:] - ahead).max(axis=1) <= _STRAIGHT
    begin, end = curve.knot[:-1], curve.knot[1:]
    # from the keel up, whichever way the curve runs
    if curve.xyz[0, 2] > curve.xyz[-1, 2]:
        straight, ahead = straight[::-1], -ahead[::-1]
        begin, end = end[::-1], begin[::-1]
    if not straight[0]:
        return None
    turn = np.arccos(np.clip(ahead @ ahead[0], -1.0, 1.0))
    bottom = int(np.append(straight & (turn <= _STRAIGHT), False).argmin()) - 1
    side = np.flatnonzero(straight & (turn > _TURN))
    return (float(end[bottom]), float(begin[side[0]])) if len(side) else None


def _through_three(
    curve: SplineBatch, ends: FloatArray, within: tuple[float, float]
) -> CircleFit | None:
    """Give the circle through the ends of a bilge and the place of it above their middle.

    It takes no notice of where the curve has its defining points, and grows with the bilge if
    that is enlarged about the corner of bottom and side.
    """
    chord = ends[1] - ends[0]
    length = float(np.sqrt(chord @ chord))
    ahead, middle = chord / length, 0.5 * (ends[0] + ends[1])
    found = points_on_plane(curve, ahead, float(ahead @ middle))
    inside = (found.t > within[0]) & (found.t < within[1])
    if not inside.any():
        return None
    outward = np.array([0.0, ahead[2], -ahead[1]])
    sagitta = float(((found.xyz[inside] - middle) @ outward).max())
    if sagitta <= _CORNER * length:
        return None
    radius = (0.25 * length * length + sagitta * sagitta) / (2.0 * sagitta)
    centre = middle + (sagitta - radius) * outward
    return CircleFit(centre[1:].copy(), radius, 0.0)


# --------------------------------------------------------------------------------------
# The midship section.

_LEVEL = 1e-6
"""m: the bottom is level as far as it rises no more above its lowest place."""


def bilge_radius(hull: DrawnCurves) -> MeasuredParameter:
    """Give the radius of the bilge at the section nearest to midship.

    `yc`, `zc`: centre; `low_y`, `low_z`, `high_y`, `high_z`: where it leaves bottom and side;
    `rise_deg`: slope of the bottom; `off`: how far its defining points lie off the circle, m;
    `corner_y`, `corner_z`: where bottom and side intersect.
    """
    bilge = hull.take(measure_bilge)
    if isinstance(bilge, str):
        return MeasuredParameter("bilge_radius", "m", None, reason=bilge)
    slope = _slope(hull, bilge)
    how = (
        "circle through the bilge amidships" if bilge.arc
        else "circle through both ends of the bilge amidships and the place half-way between"
    )  # fmt: skip
    low, high = bilge.low, bilge.high
    return MeasuredParameter(
        "bilge_radius", "m", bilge.radius, how, [low, high], hull.keys([bilge.section]),
        {
            "x": float(low[0]), "yc": float(bilge.centre[0]), "zc": float(bilge.centre[1]),
            "low_y": float(low[1]), "low_z": float(low[2]),
            "high_y": float(high[1]), "high_z": float(high[2]),
            "rise_deg": float(np.degrees(np.arctan(slope))), "off": bilge.off,
            "corner_y": float(high[1]),
            "corner_z": float(low[2] + slope * (high[1] - low[1])),
        },
    )  # fmt: skip


def deadrise_deg(hull: DrawnCurves) -> MeasuredParameter:
    """Give the slope of the bottom at the section nearest to midship.

    With a bilge it is that of the chord over the outer half of the bottom, which a level keel
    plate and a rounding beside it do not change; else that of the section at the keel. `keel`:
    half-breadth of the level part at the keel, zero if all is level; `x`; `edge_y`, `edge_z`: where
    the bottom ends.
    """
    bilge = hull.take(measure_bilge)
    if isinstance(bilge, str):
        return _at_keel(hull)
    slope, low = _slope(hull, bilge), bilge.low
    place = low - 0.5 * low[1] * np.array([0.0, 1.0, slope])
    return MeasuredParameter(
        "deadrise_deg", "deg", float(np.degrees(np.arctan(slope))),
        "slope of the outer half of the bottom amidships", np.array([place, low]),
        hull.keys([bilge.section]),
        {"x": float(low[0]), "keel": _keel(hull, bilge), "edge_y": float(low[1]),
         "edge_z": float(low[2])},
    )  # fmt: skip


def _slope(hull: DrawnCurves, bilge: MeasuredBilge) -> float:
    """Give the slope of the bottom over its outer half."""
    curve, low = hull.one(bilge.section), bilge.low
    half = points_at_coordinate(curve, 1, 0.5 * float(low[1])).xyz
    inner = half[int(half[:, 2].argmin())]
    return float((low[2] - inner[2]) / (low[1] - inner[1]))


def _keel(hull: DrawnCurves, bilge: MeasuredBilge) -> float:
    """Give the half-breadth (m) over which the bottom is level at the keel; 0 if all of it is."""
    xyz = hull.one(bilge.section).xyz
    level = xyz[xyz[:, 2] <= xyz[:, 2].min() + _LEVEL, 1].max()
    return 0.0 if level >= bilge.low[1] - _LEVEL else float(level)


def _at_keel(hull: DrawnCurves) -> MeasuredParameter:
    """Give the deadrise at the keel, of a section without a bilge."""
    section = hull.section_amidships
    if section is None:
        reason = "parent has no section across the ship"
        return MeasuredParameter("deadrise_deg", "deg", None, reason=reason)
    curve = hull.one(section)
    end = 0 if curve.xyz[0, 2] <= curve.xyz[-1, 2] else -1
    keel = curve.xyz[end]
    if abs(keel[1]) > hull.net.on_centre:
        reason = "the section amidships does not reach the centre plane"
        return MeasuredParameter("deadrise_deg", "deg", None, reason=reason)
    ahead = derivative(curve, np.zeros(1, np.int64), curve.knot[[end]])[0]
    value = float(np.degrees(np.arctan2(abs(ahead[2]), abs(ahead[1]))))
    return MeasuredParameter(
        "deadrise_deg", "deg", value, "slope of the section amidships at the keel", [keel],
        hull.keys([section]),
        {"x": float(keel[0]), "keel": 0.0, "edge_y": 0.0, "edge_z": float(keel[2])},
    )  # fmt: skip


def flat_of_bottom(hull: DrawnCurves) -> MeasuredParameter:
    """Give the half-breadth of the flat of bottom amidships; `x`, `z`: where its edge is."""
    xyz = hull.across(hull.flats_of_bottom, 0, hull.middle).xyz
    if len(xyz):
        edge = xyz[int(xyz[:, 1].argmax())]
        return _edge(edge, "border of the flat of bottom amidships", hull, hull.flats_of_bottom)
    bilge = hull.take(measure_bilge)
    if isinstance(bilge, str):
        return MeasuredParameter(
            "flat_of_bottom", "m", None, reason="parent has no flat of bottom amidships"
        )
    return _edge(bilge.low, "end of the straight bottom amidships", hull, [bilge.section])


def _edge(place: FloatArray, how: str, hull: DrawnCurves, curves: list[int]) -> MeasuredParameter:
    """Give the measure of the flat of bottom with its edge at a place."""
    return MeasuredParameter(
        "flat_of_bottom", "m", float(place[1]), how, [place], hull.keys(curves),
        {"x": float(place[0]), "z": float(place[2])},
    )  # fmt: skip


# --------------------------------------------------------------------------------------
# The parallel middle body. Ends of level borders are defining points, and equal sections are lines,
# both of which a map carries exactly. Section areas would tell less: they are within 1e-4 of the
# largest over many metres more, and a waterline that is a millimetre off moves the end of that by
# as many, or to the next station.

SHORTEST_BODY = 0.02
"""What is level over less than this part of Lpp is no parallel middle body."""

_EQUAL = 2e-5
"""Sections are equal in shape where they are as near to each other as this part of the breadth."""

_TWO = float(np.sqrt(2.0))
"""Two curves, each adopted within a tolerance of its own, may be so many times that apart."""

_FOR = "curves were adopted no nearer"


@attrs.frozen
class _Ends:
    """First and last x of the parallel body, m, the curves they were taken from, and how."""

    start: float
    end: float
    how: str
    curves: tuple[int, ...] = ()


def parallel_body_start(hull: DrawnCurves) -> MeasuredParameter:
    """Give the first x of the parallel middle body; `start`, `end`: both of its ends."""
    return _parallel_end(hull, "parallel_body_start", 0)


def parallel_body_end(hull: DrawnCurves) -> MeasuredParameter:
    """Give the last x of the parallel middle body; `start`, `end`: both of its ends."""
    return _parallel_end(hull, "parallel_body_end", 1)


def parallel_body_length(hull: DrawnCurves) -> MeasuredParameter:
    """Give the length of the parallel middle body; `start`, `end`: both of its ends."""
    found = hull.take(_ends)
    if isinstance(found, str):
        return MeasuredParameter("parallel_body_length", "m", None, reason=found)
    return MeasuredParameter(
        "parallel_body_length", "m", found.end - found.start, found.how,
        [[found.start, 0.0, 0.0], [found.end, 0.0, 0.0]], hull.keys(found.curves),
        {"start": found.start, "end": found.end},
    )  # fmt: skip


def _parallel_end(hull: DrawnCurves, name: str, end: int) -> MeasuredParameter:
    """Give the measure of one end of the parallel body: 0 the after, 1 the fore one."""
    found = hull.take(_ends)
    if isinstance(found, str):
        return MeasuredParameter(name, "m", None, reason=found)
    x = (found.start, found.end)[end]
    return MeasuredParameter(
        name, "m", x, found.how, [[x, 0.0, 0.0]], hull.keys(found.curves),
        {"start": found.start, "end": found.end},
    )  # fmt: skip


def _ends(hull: DrawnCurves) -> _Ends | str:
    """Give where the parallel body begins and ends, or say why there is none."""
    return hull.take(_of_flats) or _of_sections(hull)


def _of_flats(hull: DrawnCurves) -> _Ends | None:
    """Give the stretch along which the borders of all flats run level."""
    bottoms, sides = hull.flats_of_bottom, hull.flats_of_side
    if not bottoms:
        return None
    within = _TWO * hull.state.tolerances.adoption
    runs = [_level_run(hull, i, 1, within) for i in bottoms]
    runs += [_level_run(hull, i, 2, within) for i in sides]
    start, end = _common_end(hull, runs, 0, within), _common_end(hull, runs, 1, within)
    if end - start < SHORTEST_BODY * hull.length - _LEVEL:
        return None
    how = "where the borders of the flats of bottom and side run level"
    return _Ends(start, end, how, (*bottoms, *sides))


@attrs.frozen(eq=False)
class _LevelRun:
    """Ends in x, m, of the level stretch of a border, and its y (axis 1) or z (axis 2) at both."""

    curve: int
    axis: int
    ends: tuple[float, float]
    level: tuple[float, float]


def _level_run(hull: DrawnCurves, curve: int, axis: int, within: float) -> _LevelRun:
    """Give the longest stretch in x along which y (axis 1) or z (axis 2) of a border stays.

    It need not be the broadest or lowest: a bilge that was made larger is so amidships only. All of
    it lies within a distance (m) of one level: many small steps add up to none.
    """
    xyz = hull.one(curve).xyz
    level, x = xyz[:, axis], xyz[:, 0]
    off = np.abs(level[:, None] - level)
    begin, best = 0, (0, 0)
    for end in range(len(x)):
        while (off[begin : end + 1, end] > within).any():
            begin += 1
        if abs(x[end] - x[begin]) > abs(x[best[1]] - x[best[0]]):
            best = begin, end
    aft, fore = sorted(best, key=lambda i: float(x[i]))
    return _LevelRun(
        curve, axis, (float(x[aft]), float(x[fore])), (float(level[aft]), float(level[fore]))
    )


def _common_end(hull: DrawnCurves, runs: Sequence[_LevelRun], end: int, within: float) -> float:
    """Give the end of what all borders have in common: 0 the after, 1 the fore one.

    It is where one of them leaves its level, as far out as the others are still on theirs: that
    these have no defining point there tells nothing.
    """
    out = sorted({run.ends[end] for run in runs}, reverse=end == 0)
    found = out[0]
    for x in out[1:]:
        inner = [run for run in runs if (run.ends[end] > x) == (end == 0) and run.ends[end] != x]
        between = found + (x - found) * np.array([1.0, 0.5])
        if not all(_still_level(hull, run, end, at, within) for run in inner for at in between):
            break
        found = x
    return found


def _still_level(hull: DrawnCurves, run: _LevelRun, end: int, x: float, within: float) -> bool:
    """Tell whether a border is on its level at a place x beyond its last defining point there."""
    places = hull.across([run.curve], 0, x).xyz
    return bool((np.abs(places[:, run.axis] - run.level[end]) <= within).any())


def _of_sections(hull: DrawnCurves) -> _Ends | str:
    """Give the longest stretch along which sections below the draught are equal in shape.

    Where there is none, sections and what runs along the ship between them are equal as far as
    adoption knows them: the curves of a mesh or of digitised lines tell no more.
    """
    across = np.flatnonzero(np.isfinite(hull.net.x))  # flat ends among them
    x = hull.net.x[across]
    stations = [tuple(across[x == each].tolist()) for each in np.unique(x)]
    if not stations:
        return "parent has no section across the ship"
    apart = cache(partial(_apart, hull))
    found = _longest(hull, stations, apart, _EQUAL * hull.ship.breadth)
    if found is None:
        known = _TWO * hull.state.tolerances.adoption
        found = _longest(hull, stations, apart, known, between=True)
        if found is None:
            return "parent has no parallel middle body"
        found = attrs.evolve(found, how=f"{found.how} within {1e3 * known:.3g} mm, for {_FOR}")
    return found


def _longest(
    hull: DrawnCurves, stations: Sequence[tuple[int, ...]],
    apart: Callable[[tuple[int, ...], tuple[int, ...]], float], within: float, *,
    between: bool = False,
) -> _Ends | None:  # fmt: skip
    """Give the longest run of sections within a distance (m) of the first of the run.

    With `between` what runs along the ship from one to the next is to be as near as that, too.
    """
    runs = [[stations[0]]]
    for station in stations[1:]:
        first, last = runs[-1][0], runs[-1][-1]
        alike = apart(first, station) <= within
        if alike and (not between or _bulge(hull, first, last, station) <= within):
            runs[-1].append(station)
        else:
            runs.append([station])
    found = [(float(hull.net.x[run[0][0]]), float(hull.net.x[run[-1][0]]), run) for run in runs]
    start, end, run = max(found, key=lambda each: each[1] - each[0])
    if end - start < SHORTEST_BODY * hull.length - _LEVEL:
        return None
    curves = tuple(curve for station in run for curve in station)
    return _Ends(start, end, "where sections below the draught are equal in shape", curves)


def _apart(hull: DrawnCurves, one: Sequence[int], other: Sequence[int]) -> float:
    """Give how far two sections are apart below the draught, seen along the ship, m."""
    away = 0.0
    for mine, theirs in ((one, other), (other, one)):
        xyz = sample(hull.some(mine), _SAMPLES)[1]
        xyz = xyz[xyz[:, 2] <= hull.ship.draught]
        away = max(away, _off_section(hull, theirs, xyz) if len(xyz) else np.inf)
    return away


def _bulge(
    hull: DrawnCurves, section: Sequence[int], aft: Sequence[int], fore: Sequence[int]
) -> float:
    """Give how far what runs along the ship between two sections leaves a section's shape, m."""
    along = np.flatnonzero(~np.isfinite(hull.net.x)).tolist()
    xyz = sample(hull.some(along), _SAMPLES)[1] if along else np.zeros((0, 3))
    start, end = hull.net.x[aft[0]], hull.net.x[fore[0]]
    inside = (xyz[:, 0] >= start) & (xyz[:, 0] <= end) & (xyz[:, 2] <= hull.ship.draught)
    return _off_section(hull, section, xyz[inside]) if inside.any() else 0.0


def _off_section(hull: DrawnCurves, section: Sequence[int], xyz: FloatArray) -> float:
    """Give the farthest that places, seen along the ship, lie off a section, m."""
    beside = np.column_stack([np.full(len(xyz), hull.net.x[section[0]]), xyz[:, 1:]])
    curves = hull.some(section)
    off = [closest_points(curves, i, beside)[2] for i in range(len(section))]
    return float(np.min(off, axis=0).max())
