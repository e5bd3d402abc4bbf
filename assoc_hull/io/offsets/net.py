"""A net from a table of offsets: sections, waterlines and boundary curves, adopted.

`net_from_offsets` closes the hull with profile, ends and flats that the caller gives
(`Completion`); `net_of_lines` takes what the table says and no more, and leaves these open. Offsets
are half-breadths (s, w), m, by station and waterline; nan where the table is blank.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.analysis.net.surface_layout import BROAD_END
from assoc_hull.edit.adoption.adopt_lines import AdoptionReport, adopt
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import CurveData, FloatArray, PointKind, freeze
from assoc_hull.geometry.polylines.operations import runs_where
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.plane_intersections import intersect_planes
from assoc_hull.geometry.splines.segments import derivative, sample
from assoc_hull.io.lines.raw_lines import plane_name
from assoc_hull.io.lines.slices import ASSOCIATIONS
from assoc_hull.io.offsets.flat_runs import straight_runs_of
from assoc_hull.io.offsets.knuckles import knuckles_of_table
from assoc_hull.io.offsets.table import OffsetTable, half_section_areas
from assoc_hull.model.kinds import BoundaryKind
from assoc_hull.model.line_source import LineSource
from assoc_hull.model.tables import HullState, Particulars
from assoc_hull.tolerance import Tolerances, length_factor

__all__ = [
    "BOW_END",
    "TRANSOM",
    "Completion",
    "adopt_completed",
    "at_full_size",
    "flat_ends",
    "held_up",
    "lines_of_table",
    "net_from_offsets",
    "net_of_lines",
]


@attrs.frozen(eq=False)
class Completion:
    """What a table of offsets leaves open and a net needs.

    Attributes
    ----------
    profile : (n, 3), m
        Centre-line profile, from the stern at the deck round to the stem at the deck.
    profile_kind : (n,) int8
        A `PointKind` per point.
    stern, stem : (w,), m
        Where each waterline of the table ends.
    bottom : (n, 3), m, or None
        Border of the flat of bottom, from aft.
    side : (n, 3), m, or None
        Border of the flat of side, from the deck aft round to the deck forward.
    """

    profile: FloatArray
    profile_kind: np.typing.NDArray[np.int8]
    stern: FloatArray
    stem: FloatArray
    bottom: FloatArray | None
    side: FloatArray | None

    def scaled(self, factor: float) -> Completion:
        """Give the completion with every length times a factor."""
        ends = (self.bottom, self.side)
        bottom, side = (None if each is None else factor * each for each in ends)
        return Completion(
            factor * self.profile, self.profile_kind, factor * self.stern, factor * self.stem,
            bottom, side,
        )  # fmt: skip


def particulars_of_table(table: OffsetTable, deck: str = "open") -> Particulars:
    """Give the particulars that a table tells, and the deck ("open" or "closed"), which none tells.

    Depth and draught are the highest waterline where it tells none.

    Raises
    ------
    BadInputError
        Another word for the deck, or dimensions that are not positive.
    """
    top = float(table.z[-1])
    return Particulars(
        table.name, table.length, table.breadth, table.depth or top, table.draught or top, deck
    )


def net_from_offsets(
    table: OffsetTable,
    completion: Completion,
    particulars: Particulars | None = None,
    tolerances: Tolerances | None = None,
) -> tuple[HullState, AdoptionReport]:
    """Adopt a table of offsets as a net of sections, waterlines and boundary curves.

    The highest waterline of the table becomes the deck edge, the lowest, at the base line, the
    border of the flat of bottom: their planes touch the hull and cut nothing.

    Raises
    ------
    BadInputError
        A table without a waterline between the lowest and the highest.
    """
    if len(table.z) < 3:
        raise BadInputError(
            f"{len(table.z)} waterlines", f"table {table.name!r}", "give three or more"
        )
    ship = particulars or particulars_of_table(table)
    factor = length_factor(table.length)
    whole = completion if factor == 1.0 else completion.scaled(1.0 / factor)
    return adopt_completed(table, whole, ship, tolerances)


def adopt_completed(
    table: OffsetTable, completion: Completion, ship: Particulars, tolerances: Tolerances | None,
    *, imported: bool = False,
) -> tuple[HullState, AdoptionReport]:  # fmt: skip
    """Adopt a table with its completion at full size, as of `at_full_size`.

    `imported`: lines off the flats run straight, too, where they have one greatest offset, and
    sections turn where they have a knuckle. Lines are named as the table names them.
    """
    factor, full = length_factor(table.length), at_full_size(table)
    flats = _FlatBorder(completion.side, full)
    sources = _boundaries(full, completion, flats)
    wet = [i for i in range(len(full.x)) if (full.half_breadth[i, 1:] > 0.0).any()]
    stations, levels = _names(table)
    sources += [_closed_section(full, completion, flats, i, factor, stations[i]) for i in wet]
    inner = range(1, len(full.z) - 1)
    sources += [_closed_waterline(full, completion, flats, j, levels[j]) for j in inner]
    if imported:
        corners = knuckles_of_table(full)
        sources = [_with_knuckles(each, full, corners) for each in sources]
        sources = [_straight_at_greatest(each, full) for each in sources]
    held = {"sections": 2, "flat of bottom": 1}
    sources = [
        each if axis is None else held_up(each, axis)
        for each in sources
        for axis in (held.get(each.group, held.get(each.name)),)
    ]
    own = sources if factor == 1.0 else _brought_back(sources, full, table, factor)
    state, report = adopt(
        own, ship, ASSOCIATIONS, tolerances or Tolerances().scaled(factor),
        None if tolerances else sources,
    )  # fmt: skip
    bare = [i for i in range(len(table.x)) if i not in wet]
    notes = tuple(f"station at x = {table.x[i]:g} m: no breadth, no section made" for i in bare)
    return state, attrs.evolve(report, notes=(*_printed(table), *notes, *report.notes))


def _names(table: OffsetTable) -> tuple[list[str], list[str]]:
    """Name sections and waterlines by the numbers that the table prints, else by their places."""
    stations = _as_printed("sections", table.station, table.x)
    return stations, _as_printed("waterlines", table.level, table.z)


def _as_printed(group: str, printed: FloatArray | None, places: FloatArray) -> list[str]:
    numbers = places if printed is None else np.where(np.isfinite(printed), printed, places)
    # A place that reads as the number of another line would give two lines one name.
    shown = [plane_name(group, each) for each in numbers.tolist()]
    if len({*shown}) < len(shown):
        shown = [plane_name(group, each) for each in places.tolist()]
    return shown


def _with_knuckles(line: LineSource, table: OffsetTable, knuckles: NDArray[np.bool_]) -> LineSource:
    """Let a section turn at the offsets that are knuckles, also where a flat begins there."""
    row = np.flatnonzero(table.x == line.points[0, 0])
    if line.group != "sections" or not len(row):
        return line
    corner = _corners(line.points, table, knuckles, int(row[0]))
    if not corner.any():
        return line
    kind, direction = line.kind.copy(), line.direction.copy()
    kind[corner], direction[corner] = int(PointKind.KNUCKLE), 0.0
    freeze(kind, direction)
    return attrs.evolve(line, kind=kind, direction=direction)


def _corners(
    points: FloatArray, table: OffsetTable, knuckles: NDArray[np.bool_], i: int
) -> NDArray[np.bool_]:
    """Tell which points (n, 3) of the section at station i are knuckles of the table; no end is."""
    found = np.isin(points[:, 2], table.z[knuckles[i]]) & (points[:, 1] > 0.0)
    found[[0, -1]] = False
    return np.asarray(found)


def _straight_at_greatest(line: LineSource, table: OffsetTable) -> LineSource:
    """Let a line that is on no flat of side run straight between neighbours of its greatest offset.

    What ends on the border of a flat is straight there already.
    """
    along = {"sections": 2, "waterlines": 0}.get(line.group, -1)
    if along < 0 or (np.abs(line.direction[:, along]) > 0.0).any():
        return line
    unit = float(table.rounding.max())
    if along == 0:
        unit = float(table.rounding[int(np.abs(table.z - line.points[0, 2]).argmin())])
    corner = line.kind == PointKind.KNUCKLE
    points, tangent = _on_runs(line.points, along, 2.0 * unit * (1.0 + 1e-6), 1.0, corner)
    if not tangent.any():
        return line
    given = (points[:, None] == line.points[None]).all(axis=2)
    kind = np.full(len(points), int(PointKind.TANGENT))
    direction = np.tile(np.eye(3)[along], (len(points), 1))
    for k in np.flatnonzero(~tangent).tolist():
        own = int(given[k].argmax())
        kind[k], direction[k] = line.kind[own], line.direction[own]
    kind, points = kind.astype(line.kind.dtype), np.array(points)
    freeze(points, kind, direction)
    return attrs.evolve(line, points=points, kind=kind, direction=direction)


def at_full_size(table: OffsetTable) -> OffsetTable:
    """Give a table of a hull under 100 m at the length for which lengths in the code hold."""
    factor = length_factor(table.length)
    return table if factor == 1.0 else table.at_full_length(factor)


def _brought_back(
    sources: list[LineSource], full: OffsetTable, table: OffsetTable, factor: float
) -> list[LineSource]:
    """Give the lines of a table at full size at its own, each in the very plane that it gives."""
    stations = dict(zip(full.x.tolist(), table.x.tolist(), strict=True))
    levels = dict(zip(full.z.tolist(), table.z.tolist(), strict=True))
    # Of deck edge and flat of side too: points a last bit out of the plane are a fault.
    places = (stations, {full.breadth / 2.0: table.breadth / 2.0}, levels)
    back = [each.scaled(factor, _own_place(each, places)) for each in sources]
    return [
        _at_own_places(one, each.points, stations, levels)
        for one, each in zip(back, sources, strict=True)
    ]


def _own_place(line: LineSource, places: tuple[dict[float, float], ...]) -> float | None:
    """Give where the plane of a line, across x, y or z, stands at the hull's own size."""
    for axis, known in enumerate(places):
        if line.normal is not None and line.normal[axis] == 1.0:
            return known.get(line.offset)
    return None


def _at_own_places(
    line: LineSource, full: FloatArray, stations: dict[float, float], levels: dict[float, float]
) -> LineSource:
    """Put points that stand on a station or at a level into its very plane, as they do at 100 m.

    A section that begins a last bit below a waterline would cross it where it only touches it.
    """
    points = line.points.copy()
    for axis, places in ((0, stations), (2, levels)):
        own = zip(full[:, axis].tolist(), points[:, axis].tolist(), strict=True)
        points[:, axis] = [places.get(at, now) for at, now in own]
    freeze(points)
    return attrs.evolve(line, points=points)


def _printed(table: OffsetTable) -> list[str]:
    """Say how coarsely the offsets are printed."""
    ratio = table.z / (table.draught or 1.0)
    unit = "T" if table.draught else "m"
    found: list[str] = []
    digit = 1e-9 * length_factor(table.length)
    for value in np.unique(np.round(table.rounding / digit)).tolist():
        mine = ratio[np.abs(table.rounding - value * digit) < digit]
        value *= digit
        heights = ", ".join(f"{each:.4g}" for each in mine)
        found.append(f"offsets at {heights} {unit} are printed to +-{1e3 * value:.2g} mm")
    return found


class _FlatBorder:
    """Where lines enter and leave the flat of side, taken from its border curve."""

    def __init__(self, side: FloatArray | None, table: OffsetTable) -> None:
        self.side = side
        self.half = table.breadth / 2.0
        if side is not None:
            self.border = loft(CurveData.single(side, _border_kinds(side)))

    def meet(self, axis: int, offset: float) -> FloatArray:
        """Give the points where the border passes a plane across an axis, (k, 3), m."""
        if self.side is None:
            return np.zeros((0, 3))
        return intersect_planes(self.border, np.eye(3)[axis], np.array([offset])).xyz


_SAG = 0.5
"""A smooth border that sinks by more (m) below its lowest point swings: those of Series 60 sink by
.12 and .27 m between the stations that bound them."""


def _border_kinds(side: FloatArray) -> list[int]:
    """Give the kinds of a border's points: smooth where the smooth curve passes levels once a side.

    Else knuckles: a smooth curve through uneven points may turn back and pass a waterline twice, or
    sink between two corners of a level lower side and put sections on a flat where they have none.
    """
    smooth, knuckles = ([int(kind)] * len(side) for kind in (PointKind.SMOOTH, PointKind.KNUCKLE))
    # Clear of the lower side, which is nearly level, and of the ends at the deck.
    low, high = float(side[:, 2].min()) + 0.1, float(side[:, 2].max()) - 0.02
    if low >= high:  # too low a flat to tell
        return knuckles
    levels = np.linspace(low, high, 40)
    spline = loft(CurveData.single(side, smooth))
    if float(side[:, 2].min() - sample(spline, _FINE)[1][:, 2].min()) > _SAG:
        return knuckles
    met = intersect_planes(spline, np.eye(3)[2], levels)
    once = np.bincount(met.plane, minlength=len(levels)) == 2
    return smooth if once.all() else knuckles


def _boundaries(table: OffsetTable, completion: Completion, flats: _FlatBorder) -> list[LineSource]:
    """Give profile and deck edge as ends of the hull, and the borders of the flats there are."""
    top = float(table.z[-1])
    deck = _closed_waterline(table, completion, flats, len(table.z) - 1, "deck edge")
    found = [
        LineSource.make(
            "boundary", "profile", completion.profile, plane=((0, 1, 0), 0.0),
            boundary=BoundaryKind.END, kind=completion.profile_kind.tolist(),
        ),
        LineSource.make(
            "boundary", "deck edge", deck.points, plane=((0, 0, 1), top),
            boundary=BoundaryKind.END, kind=deck.kind.tolist(), direction=deck.direction,
        ),
    ]  # fmt: skip
    if completion.bottom is not None:
        found.append(
            LineSource.make(
                "boundary", "flat of bottom", completion.bottom, plane=((0, 0, 1), 0.0),
                boundary=BoundaryKind.FLAT,
            )
        )  # fmt: skip
    if completion.side is not None:
        found.append(
            LineSource.make(
                "boundary", "flat of side", completion.side,
                plane=((0, 1, 0), table.breadth / 2.0), boundary=BoundaryKind.FLAT,
                kind=_border_kinds(completion.side),
            )
        )  # fmt: skip
    return found


def _in_order(
    points: list[FloatArray], tangents: FloatArray, along: FloatArray, axis: int
) -> tuple[FloatArray, list[int], FloatArray]:
    """Put points in order along an axis, those on a flat's border as tangent points.

    Gives the points, their kinds and directions. Of two within 0.1 mm one stays, the tangent point
    if there is one.
    """
    xyz = np.array([*points, *tangents])
    tangent = np.arange(len(xyz)) >= len(points)
    order = np.lexsort((~tangent, xyz[:, axis]))
    xyz, tangent = xyz[order], tangent[order]
    step = np.abs(np.diff(xyz, axis=0)).max(axis=1)
    near = step <= 1e-4
    drop = np.concatenate([[False], near & (~tangent[1:] | tangent[:-1])])
    drop[:-1] |= near & tangent[1:] & ~tangent[:-1]
    xyz, tangent = xyz[~drop], tangent[~drop]
    kind = np.where(tangent, int(PointKind.TANGENT), int(PointKind.SMOOTH))
    return xyz, kind.tolist(), np.where(tangent[:, None], along, 0.0)


def _closed_section(
    table: OffsetTable, completion: Completion, flats: _FlatBorder, i: int, factor: float, name: str
) -> LineSource:
    x = float(table.x[i])
    y, z = table.half_breadth[i], table.z
    wet = np.isfinite(y) & (y > 0.0)
    wet[0] = False
    start = _foot(completion, x, float(z[wet][0]), factor)
    points = [np.array([x, b, h]) for b, h in zip(y[wet], z[wet], strict=True)]
    side = flats.meet(0, x)
    side = side[(side[:, 2] > 1e-6) & (side[:, 2] < z[-1] - 1e-6)]
    # One alone is a section, too, as of a counter that reaches the deck alone at her last station.
    xyz, kinds, directions = _in_order(points, side, np.array([0.0, 0.0, 1.0]), 2)
    foot = [start]
    kind, direction = [int(PointKind.SMOOTH)], [np.zeros(3)]
    if y[0] > 0.0 and start[2] == 0.0 and completion.bottom is not None:
        foot.append(np.array([x, y[0], 0.0]))
        kind.append(int(PointKind.TANGENT))
        direction.append(np.array([0.0, 1.0, 0.0]))
    return LineSource.make(
        "sections", name, np.concatenate([foot, xyz]),
        kind=kind + kinds, direction=np.concatenate([direction, directions]),
    )  # fmt: skip


def _foot(completion: Completion, x: float, below: float, factor: float) -> FloatArray:
    """Give the point of the profile at a station from which its section begins.

    That is the highest below its first offset: above a bulb or a rising keel there may be several.
    `factor` brings lengths of a message back from full size.
    """
    p = completion.profile
    heights = [float(h) for h in p[np.abs(p[:, 0] - x) < 1e-6, 2] if h < below]
    spline = loft(CurveData.single(p, completion.profile_kind.tolist()), ["the profile"])
    met = intersect_planes(spline, np.eye(3)[0], np.array([x])).xyz
    heights += [float(h) for h in met[:, 2] if h < below]
    if not heights:
        raise BadInputError(
            f"the station at x = {factor * x:.6g} m has its lowest half-breadth at "
            f"{factor * below:.6g} m, and no keel, stem or stern lies below it",
            "the table", "correct the half-breadths of that station, or give a column keel",
        )  # fmt: skip
    return np.array([x, 0.0, max(heights)])


def _closed_waterline(
    table: OffsetTable, completion: Completion, flats: _FlatBorder, j: int, name: str
) -> LineSource:
    z = float(table.z[j])
    y = table.half_breadth[:, j]
    inside = (table.x > completion.stern[j] + 1e-6) & (table.x < completion.stem[j] - 1e-6)
    wet = np.isfinite(y) & (y > 0.0) & inside
    points = [np.array([x, b, z]) for x, b in zip(table.x[wet], y[wet], strict=True)]
    points += [np.array([completion.stern[j], 0.0, z]), np.array([completion.stem[j], 0.0, z])]
    side = flats.meet(2, z) if j < len(table.z) - 1 else _deck_flat(flats, z)
    xyz, kind, direction = _in_order(points, side, np.array([1.0, 0.0, 0.0]), 0)
    return LineSource.make("waterlines", name, xyz, kind=kind, direction=direction)


def _deck_flat(flats: _FlatBorder, z: float) -> FloatArray:
    """Give the ends of the flat of side's border, in the deck's plane."""
    if flats.side is None:
        return np.zeros((0, 3))
    ends = flats.side[[0, -1]]
    return ends[np.abs(ends[:, 2] - z) < 1e-9]


# --------------------------------------------------------------------------------------
# A table as lines, for hulls that no rule completes.

_TOLERANCE = 1e-3
"""How far (m) a curve may pass the points of a table, of a short hull less in proportion."""

_SAME = 1e-9
_APART = 0.2
"""Points of adoption stand no closer (m), of a short hull less in proportion."""

_LEVEL = 1e-6
"""As much less in proportion: the plane of a waterline this close (m) to the base line touches a
flat bottom."""


def net_of_lines(
    table: OffsetTable,
    particulars: Particulars | None = None,
    tolerances: Tolerances | None = None,
    ends: tuple[FloatArray, FloatArray] | None = None,
) -> tuple[HullState, AdoptionReport]:
    """Adopt the lines of a table; flats are left open, and what `lines_of_table` does not close.

    Raises
    ------
    BadInputError
        A table whose lines do not make a net.
    """
    factor = length_factor(table.length)
    lines = lines_of_table(table, ends)
    groups = {line.group for line in lines}
    links = [each for each in ASSOCIATIONS if {each.a, each.b} <= groups]
    ship = particulars or particulars_of_table(table)
    return adopt(lines, ship, links, tolerances or Tolerances().scaled(factor))


def lines_of_table(
    table: OffsetTable, ends: tuple[FloatArray, FloatArray] | None = None
) -> list[LineSource]:
    """Give sections, waterlines, the deck edge and, through heights of the keel, the profile.

    A blank between two numbers ends a curve; of zeros in a row those count that lie next to a
    half-breadth. Heights of buttocks are points of the sections. The deck edge is what the table
    calls so, else its highest waterline. `ends`: where waterlines end aft and forward, (w,) m each,
    for a profile with a known keel that the last stations leave open.
    """
    factor = length_factor(table.length)
    profile = _keel_profile(table, ends)
    knuckles = knuckles_of_table(table)
    near = factor * _TOLERANCE
    stations, heights = _names(table)
    found = [
        _straightened(
            table,
            "sections",
            points,
            x,
            near,
            stations[i],
            corner=_corners(points, table, knuckles, i),
        )
        for i, x in enumerate(table.x.tolist())
        for points in _open_sections(table, i)
    ]
    levels = len(table.z) - (table.deck_height is None)
    found += [
        _straightened(table, "waterlines", points, z, near, heights[j], j)
        for j, z in enumerate(table.z[:levels].tolist())
        if z > factor * _LEVEL
        for points in _open_waterlines(table, j, profile)
    ]
    if profile is not None:
        found = [_edge_of_end(line, profile, table, near) for line in found]
        found.append(profile)
    found += [_deck_edge(table, points, near) for points in _deck(table, profile)]
    return found


TRANSOM, BOW_END = "transom", "bow end"
"""Names of the edges of flat ends, aft and forward."""


_FLAT_AREA = 0.25
"""A last section with more than this part of the greatest area is no stern that was cut off."""


def flat_ends(table: OffsetTable) -> tuple[bool, bool]:
    """Tell whether the ship ends flat in her aftmost station, and in her foremost one.

    No waterline goes on beyond a flat end. The keel has to end there, in a section that is large
    below the draught, or broad next to it.
    """
    if table.keel is None:
        return False, False
    y = np.nan_to_num(table.half_breadth)
    under = table.z <= (table.draught or table.z[-1])
    area = half_section_areas(y, table.z, table.draught)
    beam = y[:, under][:, -1] if under.any() else np.zeros(len(y))
    known = np.isfinite(table.keel)
    broad = (beam > 0.0) & (beam >= BROAD_END * beam.max())
    flat = known & ((area > _FLAT_AREA * area.max()) | broad)
    return bool(flat[0]), bool(flat[-1])


def _edge_of_end(
    line: LineSource, profile: LineSource, table: OffsetTable, near: float
) -> LineSource:
    """Let the last section, at whose foot the profile ends, be the edge of a flat end.

    Waterlines and the deck edge end on it, as on any boundary; on a section they would only end.
    """
    if line.group != "sections":
        return line
    foot = line.points[0]
    broad = float(line.points[:, 1].max()) >= BROAD_END * np.nanmax(table.half_breadth)
    aft, fore = (
        (flat or broad)
        and foot[0] == table.x[end]
        and np.abs(foot - profile.points[end]).max() <= near
        for flat, end in zip(flat_ends(table), (0, -1), strict=True)
    )
    if not (aft or fore):
        return line
    return attrs.evolve(
        line, group="boundary", family="boundary", name=TRANSOM if aft else BOW_END,
        boundary=BoundaryKind.END,
    )  # fmt: skip


def _deck_edge(table: OffsetTable, points: FloatArray, near: float) -> LineSource:
    """Make the deck edge, which runs straight in plan along its greatest breadth as waterlines do.

    Sheer or not: it is tangent there to the heights of the smooth curve through its points.
    """
    factor = length_factor(table.length)
    unit = 2.0 * float(table.rounding[-1]) * (1.0 + 1e-6)
    runs = straight_runs_of(points[:, 0], points[:, 1], unit, factor * _APART)
    smooth = loft(CurveData.single(points))
    at = intersect_planes(smooth, np.eye(3)[0], runs.place[~runs.given])
    first = np.unique(at.plane, return_index=True)[1]  # a curve may meet a plane again
    knot, places = np.zeros(len(runs.y)), np.zeros((len(runs.y), 3))
    knot[runs.given], places[runs.given] = smooth.knot, points
    knot[~runs.given], places[~runs.given] = at.t[first], at.xyz[first]
    places[:, 1] = runs.y
    way = derivative(smooth, np.zeros(len(knot), np.int64), knot) * (1.0, 0.0, 1.0)
    level = float(points[0, 2]) if np.ptp(points[:, 2]) < factor * _SAME else None
    return LineSource.make(
        "boundary", "deck edge", places,
        plane=None if level is None else ((0.0, 0.0, 1.0), level), boundary=BoundaryKind.END,
        kind=np.where(runs.tangent, int(PointKind.TANGENT), int(PointKind.SMOOTH)).tolist(),
        direction=np.where(runs.tangent[:, None], way, 0.0), tolerance=near,
    )  # fmt: skip


def _straightened(
    table: OffsetTable, group: str, points: FloatArray, place: float, near: float, name: str,
    j: int = -1, *, corner: NDArray[np.bool_] | None = None,
) -> LineSource:  # fmt: skip
    """Make a section or waterline that runs straight on the flats, and leaves them tangent.

    It turns at its corners, (n,) of the points.

    It is on a flat of side where neighbouring offsets are the greatest, to a unit of their
    rounding, as of `straight_runs_of`; on a flat of bottom up to an offset at the keel's height.
    """
    axis, along = (0, 2) if group == "sections" else (2, 0)
    unit = 2.0 * float(table.rounding.max() if j < 0 else table.rounding[j]) * (1.0 + 1e-6)
    factor = length_factor(table.length)
    corners = points[np.zeros(len(points), np.bool_) if corner is None else corner]
    points, tangent = _on_runs(points, along, unit, factor, corner)
    direction = np.where(tangent[:, None], np.eye(3)[along], 0.0)
    same, y = factor * _SAME, points[:, 1]
    if group == "sections" and y[0] == 0.0 and y[1] > 0.0 and abs(np.diff(points[:2, 2])[0]) < same:
        tangent[1], direction[1] = True, (0.0, 1.0, 0.0)
    tangent[[0, -1]], direction[[0, -1]] = False, 0.0
    kind = np.where(tangent, int(PointKind.TANGENT), int(PointKind.SMOOTH))
    turns = (points[:, None] == corners[None]).all(axis=2).any(axis=1)
    kind[turns], direction[turns] = int(PointKind.KNUCKLE), 0.0
    if group == "sections" and _has_chine(points, same):
        kind[1], direction[1] = int(PointKind.KNUCKLE), 0.0
    line = LineSource.make(
        group, name, points, plane=(tuple(np.eye(3)[axis].tolist()), place),
        kind=kind.tolist(), direction=direction, tolerance=near,
    )  # fmt: skip
    return held_up(line, 2, near) if group == "sections" else line


_FINE = 16
"""Places on each segment of a line at which it is looked at."""


def held_up(line: LineSource, axis: int, near: float = _TOLERANCE) -> LineSource:
    """Let no part of a line lie lower along an axis than its lowest point, by more than near (m).

    A smooth curve sinks where points are few, as between keel and first offset: there it turns at
    the lower end of the segment, and where that is not enough at the upper one too, and is straight
    between the two.
    """
    kind, direction = line.kind.copy(), line.direction.copy()
    floor, last = float(line.points[:, axis].min()), len(line.points) - 1
    while True:
        spline = loft(CurveData.single(line.points, kind.tolist(), direction))
        under = floor - sample(spline, _FINE)[1][:-1, axis]
        low = int(under.argmax()) // _FINE
        free = [k for k in (low, low + 1) if 0 < k < last and kind[k] != PointKind.KNUCKLE]
        if under.max() <= near or not free:
            break
        kind[free[0]], direction[free[0]] = int(PointKind.KNUCKLE), 0.0
    if (kind == line.kind).all():
        return line
    freeze(kind, direction)
    return attrs.evolve(line, kind=kind, direction=direction)


_UPRIGHT_SIDE = 0.1
"""A side that widens by less than this part of its height stands upright."""


def _has_chine(points: FloatArray, same: float) -> bool:
    """Tell whether a flat bottom ends at an upright side: a bilge lies between two offsets."""
    if len(points) < 3:
        return False
    bottom, side = np.diff(points[:3, 1:], axis=0)
    flat = points[0, 1] == 0.0 and bottom[0] > 0.0 and abs(bottom[1]) < same
    return bool(flat and abs(side[0]) <= _UPRIGHT_SIDE * side[1])


def _on_runs(
    points: FloatArray, along: int, unit: float, factor: float,
    corner: NDArray[np.bool_] | None = None,
) -> tuple[FloatArray, NDArray[np.bool_]]:  # fmt: skip
    """Put points in where a line (n, 3), m, comes onto its greatest offset; and tell those.

    At a corner, (n,), it comes onto it there and nowhere before.
    """
    if (np.diff(points[:, along]) < 0.0).any():  # it turns back: no heights tell a flat there
        return points, np.zeros(len(points), np.bool_)
    runs = straight_runs_of(points[:, along], points[:, 1], unit, factor * _APART, corner)
    found = np.zeros((len(runs.y), 3))
    found[runs.given] = points
    new = ~runs.given
    across = 2 - along
    found[new, along], found[new, 1] = runs.place[new], runs.y[new]
    found[new, across] = points[0, across]
    return found, runs.tangent.copy()


def _open_sections(table: OffsetTable, i: int) -> Iterator[FloatArray]:
    """Give the curves of a station, each (n, 3), m, from the keel to the deck edge if given."""
    same = length_factor(table.length) * _SAME
    runs: list[FloatArray] = [
        np.column_stack([y, z]) for y, z in _runs(table.half_breadth[i], table.z)
    ]
    if not runs:
        return
    keel = _foot_of_blanks(table, i) if table.keel is None else float(table.keel[i])
    first = runs[0][0]
    if np.isfinite(keel) and (keel, 0.0) < (first[1], first[0]) and first[0] > 0.0:
        runs[0] = np.vstack([[0.0, keel], runs[0]])
    if table.deck_height is not None and table.deck_half_breadth is not None:
        edge = np.array([table.deck_half_breadth[i], table.deck_height[i]])
        if np.isfinite(edge).all() and edge[1] > runs[-1][-1, 1] + same:
            runs[-1] = np.vstack([runs[-1], edge])
    runs[0] = _with_buttocks(runs[0], table, i)
    for run in runs:
        if len(run) > 1:
            yield np.column_stack([np.full(len(run), table.x[i]), run])


def _foot_of_blanks(table: OffsetTable, i: int) -> float:
    """Give the height of the keel of a station without a column of it: where the table is blank.

    It lies between the last blank and the first half-breadth over it: where the straight line
    through the lowest two comes to the centre plane, else at the blank.
    """
    y, z = table.half_breadth[i], table.z
    known = np.flatnonzero(np.isfinite(y))
    first = int(known[0]) if len(known) else 0
    if not first:
        return 0.0
    foot = float(z[first - 1])
    if len(known) > 1 and y[known[1]] > y[first]:
        rise = float((z[known[1]] - z[first]) / (y[known[1]] - y[first]))
        foot = max(foot, float(z[first] - y[first] * rise))
    return foot


def _with_buttocks(run: FloatArray, table: OffsetTable, i: int) -> FloatArray:
    """Put heights of buttocks among the points of the lowest run, below its largest breadth."""
    if table.buttock_height is None:
        return run
    heights, factor = table.buttock_height[i], length_factor(table.length)
    widest = run[int(run[:, 0].argmax())]
    wanted = (heights < widest[1] - factor * _SAME) & (table.buttock_y < widest[0])
    wanted &= (heights >= run[0, 1]) & (table.buttock_y > run[0, 0] + factor * _SAME)
    every = np.vstack([run, np.column_stack([table.buttock_y, heights])[wanted]])
    # Upward, or outward where that way is shorter: over a flat counter heights hardly tell.
    low = every[:, 1] <= widest[1]
    lower, upper = every[low], every[~low]
    orders = [np.lexsort((lower[:, 0], lower[:, 1])), np.lexsort((lower[:, 1], lower[:, 0]))]
    lower = min((lower[each] for each in orders), key=_way)
    every = np.vstack([lower, upper[np.argsort(upper[:, 1], kind="stable")]])
    kept = np.append(True, np.linalg.norm(np.diff(every, axis=0), axis=1) > factor * 1e-3)
    return np.asarray(every[kept])


def _way(points: FloatArray) -> float:
    """Give the length of the way through points, m."""
    return float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())


def _open_waterlines(
    table: OffsetTable, j: int, profile: LineSource | None = None
) -> Iterator[FloatArray]:
    """Give the curves of a waterline, each (n, 3), from aft; they run out on the profile if any."""
    z = float(table.z[j])
    ends = np.zeros(0) if profile is None else _crossings(profile, z)
    for y, x in _runs(table.half_breadth[:, j], table.x):
        points = np.column_stack([x, y, np.full(len(x), z)])
        first, last = np.searchsorted(table.x, x[[0, -1]]).tolist()
        # Blank at the next station: there the keel is higher, and the line ends between the two.
        low = table.x[first - 1] if first else -np.inf
        high = table.x[last + 1] if last + 1 < len(table.x) else np.inf
        aft = ends[(ends >= low) & (ends < x[0])] if y[0] > 0.0 else ends[:0]
        fore = ends[(ends > x[-1]) & (ends <= high)] if y[-1] > 0.0 else ends[:0]
        if len(aft):
            points = np.vstack([[aft[-1], 0.0, z], points])
        if len(fore):
            points = np.vstack([points, [fore[0], 0.0, z]])
        if len(points) > 1:
            yield points


def _crossings(profile: LineSource, z: float) -> FloatArray:
    """Give where the profile passes a level, (k,) m, ascending."""
    spline = loft(CurveData.single(profile.points, profile.kind.tolist()))
    met = intersect_planes(spline, np.eye(3)[2], np.array([z])).xyz[:, 0]
    # Where it ends at the deck it only touches that level.
    last = profile.points[[0, -1]]
    return np.unique(np.concatenate([met, last[np.abs(last[:, 2] - z) < _SAME, 0]]))


_TURN = 20.0
"""A keel that turns by more degrees at a station has a knuckle there, as at a skeg or a cut-up: a
smooth curve through heights so far apart would swing."""


def _above_keel(
    table: OffsetTable, keel: FloatArray, side: int, ends: tuple[FloatArray, FloatArray] | None
) -> tuple[int, FloatArray, int | None]:
    """Give how the profile goes on above an end of the keel, aft (side 0) or forward (-1).

    That is up a post, where the half-breadths of a station are 0, and where the table has no
    station beyond it and waterlines still have breadth along their `ends`, (w,) m. Gives the
    station, the points (x, z), (n, 2), from the keel up, and which of them is a corner.
    """
    none = np.zeros((0, 2))
    outer = int(np.flatnonzero(np.isfinite(keel))[side])
    up = _post(table, outer, keel)
    if up is not None:
        return outer, np.column_stack([np.full(len(up), table.x[outer]), up]), None
    wide = np.nan_to_num(table.half_breadth) > 0.0
    i = int(np.flatnonzero(wide.any(axis=1))[side])
    if table.keel is None or not np.isfinite(keel[i]):
        return outer, none, None
    first = int(np.flatnonzero(wide[i])[0])
    zero = (table.half_breadth[i, :first] == 0.0) & (table.z[:first] > keel[i] + _SAME)
    post = table.z[:first][zero]
    beyond = keel[:i] if side == 0 else keel[i + 1 :]
    beyond = beyond[np.isfinite(beyond)]
    if len(post) and not (beyond >= post[-1] - _SAME).all():
        return outer, none, None  # breadth is 0 there in the plane of a skeg, not at an end
    points = np.column_stack([np.full(len(post), table.x[i]), post])
    if i != (0, len(table.x) - 1)[side] or table.deck_height is not None or ends is None:
        return i, points, len(post) - 1 if len(post) else None
    contour = np.column_stack([ends[side], table.z])[first:]
    out = (contour[:, 0] - table.x[i]) * (1.0 if side else -1.0)
    if not (out > _SAME).all():
        return i, points, None
    return i, np.concatenate([points, contour]), len(post) - 1 if len(post) else None


def _keel_profile(
    table: OffsetTable, ends: tuple[FloatArray, FloatArray] | None = None
) -> LineSource | None:
    """Give the profile through the heights of the keel; posts run up from it, and `ends`."""
    keel = _level_keel(table) if table.keel is None else table.keel
    known = np.isfinite(keel)
    if known.sum() < 3:
        return None
    x, z = table.x[known], keel[known]
    turn = np.abs(np.diff(np.degrees(np.arctan2(np.diff(z), np.diff(x)))))
    kind = np.full(len(x), int(PointKind.SMOOTH))
    kind[1:-1][turn > _TURN] = int(PointKind.KNUCKLE)
    for side in (-1, 0):  # what is put in aft moves the places forward of it
        at, points, corner = _above_keel(table, keel, side, ends)
        if not len(points):
            continue
        # Aft the profile runs down the post, forward up.
        points = points if side else points[::-1]
        place = int(known[:at].sum()) + (1 if side else 0)
        kind[place - 1 if side else place] = int(PointKind.KNUCKLE)
        x, z = np.insert(x, place, points[:, 0]), np.insert(z, place, points[:, 1])
        new = np.full(len(points), int(PointKind.SMOOTH))
        if corner is not None:
            new[corner if side else len(new) - 1 - corner] = int(PointKind.KNUCKLE)
        kind = np.insert(kind, place, new)
    line = LineSource.make(
        "boundary", "profile", np.column_stack([x, np.zeros(len(x)), z]),
        plane=((0.0, 1.0, 0.0), 0.0), boundary=BoundaryKind.END, kind=kind.tolist(),
        tolerance=length_factor(table.length) * _TOLERANCE,
    )  # fmt: skip
    return held_up(line, 2, line.tolerance if isinstance(line.tolerance, float) else _TOLERANCE)


def _level_keel(table: OffsetTable) -> FloatArray:
    """Give the lowest level as the keel where no station has a breadth there, nan elsewhere.

    So is the table of a hull whose bottom is an edge; of one that has a bottom it is not known.
    """
    low, next_up = table.half_breadth[:, 0], table.half_breadth[:, 1]
    edge = not (np.nan_to_num(low) > 0.0).any()
    sharp = (low == 0.0) & ((next_up > 0.0) | _is_post(table))
    return np.where(edge & sharp, table.z[0], np.nan)


def _is_post(table: OffsetTable) -> np.typing.NDArray[np.bool_]:
    """Tell which stations are printed as zeros from the lowest level to the highest."""
    return np.asarray((table.half_breadth == 0.0).all(axis=1))


def _post(table: OffsetTable, i: int, keel: FloatArray) -> FloatArray | None:
    """Give heights up a plumb end above its keel, None where the station is none."""
    if i not in (0, len(table.x) - 1) or not _is_post(table)[i]:
        return None
    above = table.z[table.z > keel[i] + _SAME]
    return above if len(above) else None


def _deck(table: OffsetTable, profile: LineSource | None) -> Iterator[FloatArray]:
    """Give the deck edge: its own columns, else the highest waterline."""
    if table.deck_height is None or table.deck_half_breadth is None:
        yield from _open_waterlines(table, len(table.z) - 1, profile)
        return
    known = np.isfinite(table.deck_height) & np.isfinite(table.deck_half_breadth)
    if known.sum() > 1:
        points = np.column_stack([table.x, table.deck_half_breadth, table.deck_height])
        yield points[known]


def _runs(y: FloatArray, at: FloatArray) -> Iterator[tuple[FloatArray, FloatArray]]:
    """Give the runs of numbers, with one zero at either end where there is one.

    A zero between two numbers, as between bulb and stem, ends one run and begins the next: a smooth
    curve through it would pass the centre plane.
    """
    wide = np.nan_to_num(y) > 0.0
    known = np.isfinite(y)
    near = np.zeros(len(y), np.bool_)
    near[1:] |= wide[:-1]
    near[:-1] |= wide[1:]
    keep = known & (wide | near)
    for first, stop in runs_where(keep).tolist():
        touches = first + 1 + np.flatnonzero(y[first + 1 : stop - 1] == 0.0)
        ends = [first, *touches.tolist(), stop - 1]
        for begin, end in pairwise(ends):
            if wide[begin : end + 1].any():
                yield y[begin : end + 1], at[begin : end + 1]
