"""From cut or digitised lines to a net, short hulls at the size that suits the work.

`net_from_slices` does all of it. Boundary curves come first: the ends of all other lines are moved
onto them, then knuckle lines and borders of flats are drawn, then all lines are fitted so that they
intersect. `SliceReport` holds everything that was assumed, repaired, measured and allowed.

Short hulls worked on at the size for which lengths in the code hold, and brought back.

Finding features and smoothing know dozens of lengths, and fits that are not linear: a hull of 6 m
passes through them as the same hull of 100 m, and comes back by the same factor.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.io.slicing.net import scaled
>>> from assoc_hull.io.lines.slices import GapJoin
>>> scaled(GapJoin("ST 1", (1.0, 2.0, 0.5), 0.06), 0.5).place
(0.5, 1.0, 0.25)
"""

from __future__ import annotations

from typing import Any, TypeVar

import attrs
import numpy as np

from assoc_hull.arguments import positive
from assoc_hull.edit.adoption.adopt_lines import AdoptionReport, adopt, source_order
from assoc_hull.edit.adoption.thinning_state import grown_sources
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import PointKind
from assoc_hull.geometry.polylines.circular_arcs import CircularArc
from assoc_hull.geometry.polylines.straight_runs import Onset
from assoc_hull.io.lines.ship_frame import ShipFrame
from assoc_hull.io.lines.slices import (
    ASSOCIATIONS,
    GapJoin,
    Gaps,
    HullSlices,
    LinePiece,
    SliceLine,
)
from assoc_hull.io.reports import (
    Note,
    OffsetReport,
    Tell,
    no_progress,
)
from assoc_hull.io.slicing.boundary_curves import (
    BoundaryCurve,
    KnuckleEnds,
    OutlineCorner,
    draw_borders,
    loft_source,
)
from assoc_hull.io.slicing.features import (
    FeatureRules,
    KnuckleTrace,
    find_features,
    with_arcs,
)
from assoc_hull.io.slicing.loft_sections import is_bare, loft_sections
from assoc_hull.io.slicing.smooth_lines import (
    Rim,
    SmoothReport,
    join_plans,
    make_source,
    plan_piece,
    snap_ends,
)
from assoc_hull.model.line_source import LineSource
from assoc_hull.model.tables import Association, HullState, Particulars
from assoc_hull.tolerance import Tolerances, at_full_length

__all__ = [
    "LOFTED",
    "SliceReport",
    "grown_slices",
    "net_from_slices",
    "scaled",
    "sources_from_slices",
]

_LENGTHS: dict[type, tuple[str, ...]] = {
    GapJoin: ("place", "gap"),
    Gaps: ("join", "refuse"),
    LinePiece: ("points",),
    SliceLine: ("offset", "pieces"),
    HullSlices: (
        "lines", "boundaries", "joins", "low", "high", "depth", "gaps", "knuckles",
    ),
    Onset: ("at", "place", "radius", "uncertainty"),
    CircularArc: (
        "begin", "end", "centre", "radius", "uncertainty", "residual", "before", "after",
    ),
    KnuckleTrace: ("places", "doubt"),
    SmoothReport: ("noise", "band", "residual", "onsets", "arcs"),
    BoundaryCurve: ("places", "doubt", "residual"),
}  # fmt: skip
"""What of a value is a length, or holds lengths; all else stays."""

Value = TypeVar("Value")


def scaled(value: Value, factor: float) -> Value:
    """Give a value with every length in it times a factor."""
    found: Any = _scaled(value, factor)
    return found  # type: ignore[no-any-return]


def grown_slices(slices: HullSlices) -> HullSlices:
    """Give slices of a short hull at full size; decimals of digitised points stay decimals."""
    factor = slices.factor
    found = scaled(slices, 1.0 / factor)
    if slices.facets:
        return found
    low, high = (at_full_length(each, factor) for each in (slices.low, slices.high))
    widths = at_full_length([slices.gaps.join, slices.gaps.refuse], factor).tolist()
    marks = {name: at_full_length(places, factor) for name, places in slices.knuckles.items()}
    found = attrs.evolve(found, low=low, high=high, gaps=Gaps(*widths), knuckles=marks)
    pairs = [(getattr(found, name), getattr(slices, name)) for name in ("lines", "boundaries")]
    grown = [
        tuple(_settled(new, old, factor) for new, old in zip(*pair, strict=True)) for pair in pairs
    ]
    return attrs.evolve(found, lines=grown[0], boundaries=grown[1])


def _settled(new: SliceLine, old: SliceLine, factor: float) -> SliceLine:
    pieces = tuple(
        attrs.evolve(each, points=at_full_length(given.points, factor))
        for each, given in zip(new.pieces, old.pieces, strict=True)
    )
    return attrs.evolve(new, offset=float(at_full_length(old.offset, factor)), pieces=pieces)


def _scaled(value: Any, factor: float) -> Any:
    if isinstance(value, float | np.ndarray):
        return factor * value
    if isinstance(value, tuple | list):
        return type(value)(_scaled(each, factor) for each in value)
    if isinstance(value, dict):
        return {key: _scaled(each, factor) for key, each in value.items()}
    names = _LENGTHS.get(type(value))
    if names is None:
        return value
    return attrs.evolve(value, **{each: _scaled(getattr(value, each), factor) for each in names})


# --------------------------------------------------------------------------------------
# The report.

_COARSE = 3.0
"""Lines adopted within more than this many times the least tolerance of a mesh are doubtful, and
so is a mesh whose facets are deeper."""


@attrs.frozen(eq=False)
class SliceReport:
    """What became of slices.

    Attributes
    ----------
    slices : OffsetReport
        What was assumed, repaired and found suspicious when they were read.
    joins : tuple of GapJoin
        Every join across a gap.
    gaps : Gaps
        Which gaps were joined.
    rules : FeatureRules
        The thresholds of features and smoothing.
    tolerances : Tolerances
        Those of the net; `tolerances.adoption` is how far, measured across the hull, an adopted
        curve may pass its smooth line.
    noise : float, m
        Median over the pieces.
    facet_depth : float, m
        How deep facets of the mesh lie inside the hull; 0 for digitised lines.
    smoothing : tuple of SmoothReport
        Per piece, in the order of `adoption.lines`.
    knuckles : tuple of KnuckleTrace
        Knuckle lines found.
    borders : tuple of BoundaryCurve
        Boundary curves drawn from knuckles and from the ends of straight runs.
    adoption : AdoptionReport
        Per curve: deviations from the smooth lines, points, inflections.
    frame : ShipFrame or None
        Where the ship lay in its file; None where nobody looked.
    """

    slices: OffsetReport
    joins: tuple[GapJoin, ...]
    gaps: Gaps
    rules: FeatureRules
    tolerances: Tolerances
    noise: float
    facet_depth: float
    smoothing: tuple[SmoothReport, ...]
    knuckles: tuple[KnuckleTrace, ...]
    borders: tuple[BoundaryCurve, ...]
    adoption: AdoptionReport
    frame: ShipFrame | None = None

    @property
    def tolerance(self) -> float:
        """How far (m), measured across the hull, an adopted curve may pass its smooth line."""
        return self.tolerances.adoption

    @property
    def bands(self) -> tuple[float, ...]:
        """How far (m) the hull may lie off each curve, in the order of `adoption.lines`.

        The band of the smooth line, and what the adopted curve passes that by.
        """
        pairs = zip(self.smoothing, self.adoption.lines, strict=True)
        return tuple(piece.band + line.deviation for piece, line in pairs)

    @property
    def adopted(self) -> int:
        """Points that no crossing holds."""
        return self.adoption.own_points

    @property
    def inflections(self) -> tuple[int, int]:
        """Inflections of the smooth lines in all, and what the net has more, line by line."""
        return self.adoption.inflections

    @property
    def suspicions(self) -> tuple[str, ...]:
        """What is doubtful about smoothing and adoption, none for a hull drawn well."""
        most = _COARSE * self.rules.adopt_least_facets
        found: list[str] = []
        if self.tolerance > most:
            near, noise = 1e3 * self.tolerance, 1e3 * self.noise
            found.append(
                f"tolerance: adopted within {near:.3g} mm only, since the lines scatter by "
                f"{noise:.3g} mm; corners that facets or points are too few to show count as "
                "scatter, and are rounded: give a finer mesh, more points, or tolerance="
            )
        if self.facet_depth > most:
            found.append(
                f"coarse mesh: facets lie up to {1e3 * self.facet_depth:.3g} mm inside the "
                "hull that they stand for, and lines may be off by as much: give a finer mesh"
            )
        return tuple(found)


# --------------------------------------------------------------------------------------
# Smoothing and adoption.

_CRUMB = 0.1
"""Pieces shorter than this (m), of a hull under 100 m less in proportion, are not adopted."""

_NAMES = 5
"""At most this many lines are named in a note."""


def sources_from_slices(
    slices: HullSlices, tolerance: float | None = None, rules: FeatureRules | None = None
) -> tuple[list[LineSource], list[SmoothReport], list[KnuckleTrace], float, list[BoundaryCurve]]:
    """Make smooth lines of all pieces, split at their features.

    Gives the sources, their reports, knuckle lines, the tolerance (m) and the boundary curves drawn
    as borders, whose sources come last. `tolerance` is how far an adopted curve may pass its smooth
    line; None: 3 times the median noise of the pieces, but at least 5 mm, of a mesh 10 mm. Of a
    hull under 100 m these, and the lengths of the rules by default, are less in proportion.

    Raises
    ------
    BadInputError
        A tolerance that is no number above 0, or no piece long enough to be adopted.
    """
    found = _sources_at_sizes(slices, tolerance, rules)
    return found.sources, found.reports, found.knuckles, found.tolerance, found.borders


@attrs.frozen(eq=False)
class _SmoothLines:
    """Smooth lines with their reports, and the lines at 100 m that they were made as."""

    sources: list[LineSource]
    reports: list[SmoothReport]
    knuckles: list[KnuckleTrace]
    tolerance: float
    borders: list[BoundaryCurve]
    grown: list[LineSource]


def _sources_at_sizes(
    slices: HullSlices, tolerance: float | None, rules: FeatureRules | None
) -> _SmoothLines:
    if tolerance is not None:
        tolerance = _checked(tolerance, slices)
    factor = slices.factor
    if factor == 1.0:
        found = _full_size_sources(slices, tolerance, rules or FeatureRules())
        return _SmoothLines(*found, found[0])
    limit = None if tolerance is None else tolerance / factor
    wanted = FeatureRules() if rules is None else rules.scaled(1.0 / factor)
    grown, reports, knuckles, allowed, borders = _full_size_sources(
        grown_slices(slices), limit, wanted
    )
    offset = {(line.group, line.name): line.offset for line in slices.lines}
    sources = [each.scaled(factor, offset.get((each.group, each.name))) for each in grown]
    return _SmoothLines(
        sources, scaled(reports, factor), scaled(knuckles, factor), factor * allowed,
        scaled(borders, factor), grown,
    )  # fmt: skip


def _full_size_sources(
    slices: HullSlices, tolerance: float | None, wanted: FeatureRules
) -> tuple[list[LineSource], list[SmoothReport], list[KnuckleTrace], float, list[BoundaryCurve]]:
    """Do so for a hull for which lengths in the code hold: of 100 m or more, or grown to it."""
    parts, knuckles = find_features(slices, wanted)
    parts = [part for part in parts if _is_useful(part.piece, facets=slices.facets)]
    if not parts:
        raise BadInputError(
            f"all pieces of all lines are shorter than {slices.factor * _CRUMB:.3g} m",
            f"in {slices.name}", "give lines of two or more points, or another unit or scale",
        )  # fmt: skip
    parts = [with_arcs(part, wanted) for part in parts]
    noise = float(np.median([part.noise for part in parts]))
    least = wanted.adopt_least_facets if slices.facets else wanted.adopt_least
    allowed = max(least, wanted.adopt_times * noise) if tolerance is None else tolerance
    # Boundary curves first: the ends of all other lines are moved onto them.
    rims = [
        make_source(plan_piece(part, wanted), allowed)
        for part in parts if part.line.group == "boundary"
    ]  # fmt: skip
    borders: dict[str, list[Rim]] = {}
    for source, report in rims:
        borders.setdefault(source.name, []).append(Rim(loft_source(source), report.residual))
    parts = [snap_ends(p, borders, 0.5 * allowed) for p in parts if p.line.group != "boundary"]
    outlines = _knuckle_ends([source for source, _ in rims])
    parts, curves, drawn = draw_borders(parts, knuckles, wanted, allowed, outlines)
    if not parts:
        raise BadInputError(
            "no section, waterline or buttock is left to be adopted", f"in {slices.name}",
            "check unit, scale and axes, or ask for more planes",
        )  # fmt: skip
    plans = [plan_piece(part, wanted) for part in parts]
    links = _links({plan.part.line.group for plan in plans})
    joined = join_plans(plans, links, max(wanted.near_least, wanted.near_times * noise))
    # Boundary curves are not smoothed with the others, which have been moved onto them.
    made = [*(make_source(plan, allowed) for plan in joined), *rims]
    sources = [*(source for source, _ in made), *curves]
    reports = [each for _, each in made]
    # In the order of `sources`: the two are paired.
    reports += [_report_border(each, curve) for each, curve in zip(drawn, curves, strict=True)]
    return sources, reports, knuckles, allowed, drawn


def _knuckle_ends(rims: list[LineSource]) -> KnuckleEnds:
    """Give the places of boundary curves at which a knuckle line may end."""
    corners = [
        OutlineCorner(rim.name, place)
        for rim in rims
        for place in rim.points[1:-1][rim.kind[1:-1] == PointKind.KNUCKLE]
        if place[1] > _CRUMB
    ]
    profile = [
        (rim.name, loft_source(rim)) for rim in rims if np.abs(rim.points[:, 1]).max() <= _CRUMB
    ]
    return KnuckleEnds(corners, profile)


def _links(groups: set[str]) -> list[Association]:
    """Give the associations between groups that are there."""
    return [each for each in ASSOCIATIONS if {each.a, each.b} <= groups]


def _checked(tolerance: object, slices: HullSlices) -> float:
    """Take a tolerance (m) above 0 that is less than the hull itself."""
    where = "in the adoption of slices"
    found = positive(tolerance, "tolerance", where)
    size = float((slices.high - slices.low).max())
    if found >= size:
        raise BadInputError(
            f"tolerance is {found:g} m, the hull itself {size:.4g} m",
            where,
            "give some millimetres, as 0.005",
        )
    return found


def _is_useful(piece: LinePiece, *, facets: bool, factor: float = 1.0) -> bool:
    """Tell pieces from crumbs: those shorter than a hand, and of a mesh those of one facet."""
    long = float(np.ptp(piece.points, axis=0).max()) > factor * _CRUMB
    return long and len(piece.points) > (2 if facets else 1)


def _with_crumbs(slices: HullSlices) -> OffsetReport:
    """Give the report of the slices with the pieces that are not adopted."""
    left = [
        line.name
        for line in (*slices.lines, *slices.boundaries)
        for piece in line.pieces
        if not _is_useful(piece, facets=slices.facets, factor=slices.factor)
    ]
    if not left:
        return slices.report
    names = list(dict.fromkeys(left))
    told = ", ".join(names[:_NAMES]) + (" and others" if len(names) > _NAMES else "")
    least = slices.factor * _CRUMB
    what = f"{len(left)} pieces shorter than {least:.3g} m or of one facet left out, of {told}"
    note = Note("crumbs", "the lines", what, len(left))
    return attrs.evolve(slices.report, suspicions=(*slices.report.suspicions, note))


def net_from_slices(
    slices: HullSlices,
    particulars: Particulars | None = None,
    tolerance: float | None = None,
    rules: FeatureRules | None = None,
    tell: Tell = no_progress,
) -> tuple[HullState, SliceReport]:
    """Adopt slices as a net.

    `particulars` are by default those of the extent of the hull, the draught at half its depth;
    `tolerance` and `rules` as for `sources_from_slices`.

    Raises
    ------
    BadInputError
        Slices with fewer than two lines, or as for `sources_from_slices`.
    """
    if len(slices.lines) < 2:
        raise BadInputError(
            f"{len(slices.lines)} line(s)", f"in {slices.name}", "give two or more lines"
        )
    wanted = rules or FeatureRules().scaled(slices.factor)
    tell("finding features and smoothing", 0, 0)
    made = _sources_at_sizes(slices, tolerance, rules)
    sources, smoothing, allowed = made.sources, made.reports, made.tolerance
    grown: list[LineSource] | None = made.grown
    size = slices.high - slices.low
    ship = particulars or Particulars(
        slices.name, float(size[0]), 2.0 * float(slices.high[1]), float(size[2]),
        0.5 * float(size[2]),
    )  # fmt: skip
    told = _with_crumbs(slices)
    if is_bare(slices):
        draught = None if particulars is None else particulars.draught
        sources, smoothing, told = _with_longitudinals(
            sources, smoothing, told, draught, allowed, slices.factor
        )
        grown = None
    if grown is None:
        grown = list(grown_sources(sources, slices.factor))
    # Reports of pieces stand in the order of the curves that are made of them.
    pairs = sorted(zip(grown, smoothing, strict=True), key=lambda each: source_order(each[0]))
    links = _links({source.group for source in sources})
    tell("adopting", 0, 0)
    tolerances = attrs.evolve(Tolerances().scaled(slices.factor), adoption=allowed)
    state, adoption = adopt(sources, ship, links, tolerances, grown)
    report = SliceReport(
        told, slices.joins, slices.gaps, wanted, state.tolerances,
        float(np.median([each.noise for each in smoothing])), slices.depth,
        tuple(each for _, each in pairs), tuple(made.knuckles), tuple(made.borders), adoption,
        slices.frame,
    )  # fmt: skip
    return state, report


LOFTED = "sections alone"
"""The kind of what is told of profile and deck edge that no file has."""


def _with_longitudinals(
    sources: list[LineSource],
    smoothing: list[SmoothReport],
    told: OffsetReport,
    draught: float | None,
    tolerance: float,
    factor: float,
) -> tuple[list[LineSource], list[SmoothReport], OffsetReport]:
    """Add profile, deck edge and waterlines to a hull given by sections alone, and tell it."""
    lofted = loft_sections(sources, draught, tolerance, factor)
    where = "the sections"
    if lofted is None and any(each.name == "profile" for each in sources):
        return sources, smoothing, told
    if lofted is None:
        what = (
            "no profile, deck edge or waterline is given, and sections in several curves or away "
            "from the centre plane do not tell them: give them"
        )
        note = Note(LOFTED, where, what, len(sources))
        return sources, smoothing, attrs.evolve(told, suspicions=(*told.suspicions, note))
    gone = {*lofted.posts, lofted.transom}
    pairs = [
        (source, report)
        for source, report in zip(sources, smoothing, strict=True)
        if source.name not in gone
    ]
    pairs += [(line, _report_lofted(line)) for line in lofted.lines]
    count = sum(line.group == "waterlines" for line in lofted.lines)
    own = [each for each in sources if each.group == "sections"]
    made = "deck edge" if len(own) < len(sources) else "profile, deck edge"
    what = f"{made} and {count} waterlines are lofted through the {len(own)} given"
    if lofted.transom is not None:
        what += f"; {lofted.transom} is the edge of the transom"
    if lofted.posts:
        what += f"; {' and '.join(lofted.posts)}, in the centre plane, part of the profile"
    note = Note(LOFTED, where, what, len(sources))
    told = attrs.evolve(told, assumptions=(*told.assumptions, note))
    return [source for source, _ in pairs], [report for _, report in pairs], told


def _report_lofted(line: LineSource) -> SmoothReport:
    """Report a line lofted through sections, which it passes by its tolerance at most."""
    band = float(np.max(line.tolerance))
    count = len(line.points)
    tangents = int((line.kind == PointKind.TANGENT).sum())
    knuckles = int((line.kind == PointKind.KNUCKLE).sum())
    return SmoothReport(line.name, count, count, 0.0, band, 0.0, knuckles, tangents, ())


def _report_border(border: BoundaryCurve, source: LineSource) -> SmoothReport:
    """Report a boundary curve drawn through marks as if it were a piece."""
    doubt = float(border.doubt.max())
    return SmoothReport(
        border.name, len(border.lines), len(source.points), float(0.5 * np.median(border.doubt)),
        border.residual + doubt, border.residual, 0, 0, (),
    )  # fmt: skip
