"""From slices to a net: features, smooth lines, boundary curves, adoption.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.io.slicing.mesh import slice_mesh
>>> from assoc_hull.geometry.surfaces.triangles import grid_triangles
>>> from assoc_hull.io.slicing.net import net_from_slices
>>> x, z = np.meshgrid(np.linspace(0, 100, 201), np.linspace(0, 6.25, 41), indexing="ij")
>>> y = 5.0 * (1.0 - (x / 50.0 - 1.0) ** 2) * (1.0 - (1.0 - z / 6.25) ** 2)
>>> mesh = grid_triangles(np.stack([x, y, z], axis=2))
>>> slices = slice_mesh(mesh, stations=9, waterlines=5, buttocks=2)
>>> state, report = net_from_slices(slices)
>>> len(report.adoption.lines), report.adoption.inflections
(18, (0, 0))
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.arguments import positive
from assoc_hull.edit.adoption.adopt import adopt, source_order
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import SplineBatch
from assoc_hull.io.lines.slices import Piece, Slices
from assoc_hull.io.offset_report import Note, OffsetReport
from assoc_hull.io.offsets.net import ASSOCIATIONS
from assoc_hull.io.progress import Tell, silent
from assoc_hull.io.slicing.borders import draw_borders
from assoc_hull.io.slicing.curves import Border, loft_source
from assoc_hull.io.slicing.features import FeatureRules, KnuckleLine, find_features
from assoc_hull.io.slicing.joint import join_plans
from assoc_hull.io.slicing.plan import plan_piece
from assoc_hull.io.slicing.report import SliceReport
from assoc_hull.io.slicing.runs import with_arcs
from assoc_hull.io.slicing.sources import SmoothReport, make_source, snap_ends
from assoc_hull.model.line_source import LineSource
from assoc_hull.model.state import Association, HullState, Particulars
from assoc_hull.tolerance import Tolerances

__all__ = ["SliceReport", "net_from_slices", "sources_from_slices"]

_CRUMB = 0.1
"""Pieces shorter than this (m) are not adopted."""

_NAMES = 5
"""So many lines are named in a note."""


def sources_from_slices(
    slices: Slices, tolerance: float | None = None, rules: FeatureRules | None = None
) -> tuple[list[LineSource], list[SmoothReport], list[KnuckleLine], float, list[Border]]:
    """Make smooth lines of all pieces, split at their features.

    Parameters
    ----------
    slices : Slices
        From a mesh or digitised.
    tolerance : float or None, m
        How far an adopted curve may pass its smooth line; by default 3 times the median noise
        of the pieces, but at least 5 mm, of a mesh 10 mm.
    rules : FeatureRules or None
        Defaults if None.

    Returns
    -------
    sources, reports, knuckle lines, tolerance in m, borders
        The last sources are the boundary curves drawn as borders, without a report of their own.

    Raises
    ------
    BadInputError
        A tolerance that is no number above 0, or no piece long enough to be adopted.
    """
    wanted = rules or FeatureRules()
    if tolerance is not None:
        tolerance = _checked(tolerance, slices)
    parts, knuckles = find_features(slices, wanted)
    parts = [part for part in parts if _is_useful(part.piece, facets=slices.facets)]
    if not parts:
        raise BadInputError(
            f"all pieces of all lines are shorter than {_CRUMB:g} m", f"in {slices.name}",
            "give lines of two or more points, or another unit or scale",
        )  # fmt: skip
    parts = [with_arcs(part, wanted) for part in parts]
    noise = float(np.median([part.noise for part in parts]))
    least = wanted.adopt_least_facets if slices.facets else wanted.adopt_least
    allowed = max(least, wanted.adopt_times * noise) if tolerance is None else tolerance
    rims = [
        make_source(plan_piece(part, wanted), allowed)
        for part in parts if part.line.group == "boundary"
    ]  # fmt: skip
    borders: dict[str, list[SplineBatch]] = {}
    for source, _ in rims:
        borders.setdefault(source.name, []).append(loft_source(source))
    parts = [snap_ends(p, borders, 0.5 * allowed) for p in parts if p.line.group != "boundary"]
    parts, curves, drawn = draw_borders(parts, knuckles, wanted, allowed)
    if not parts:
        raise BadInputError(
            "no section, waterline or buttock is left to be adopted", f"in {slices.name}",
            "check unit, scale and axes, or ask for more planes",
        )  # fmt: skip
    plans = [plan_piece(part, wanted) for part in parts]
    links = _links({plan.part.line.group for plan in plans})
    joined = join_plans(plans, links, max(wanted.near_least, wanted.near_times * noise))
    made = [*(make_source(plan, allowed) for plan in joined), *rims]
    sources = [*(source for source, _ in made), *curves]
    reports = [each for _, each in made]
    reports += [_report_border(each, curve) for each, curve in zip(drawn, curves, strict=True)]
    return sources, reports, knuckles, allowed, drawn


def _links(groups: set[str]) -> list[Association]:
    """Give the associations between groups that are there."""
    return [each for each in ASSOCIATIONS if {each.a, each.b} <= groups]


def _checked(tolerance: object, slices: Slices) -> float:
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


def _is_useful(piece: Piece, *, facets: bool) -> bool:
    """Leave out crumbs: pieces shorter than a hand, and of a mesh those of one facet."""
    long = float(np.ptp(piece.points, axis=0).max()) > _CRUMB
    return long and len(piece.points) > (2 if facets else 1)


def _tell_crumbs(slices: Slices) -> OffsetReport:
    """Give the report of the slices with the pieces that are not adopted."""
    left = [
        line.name
        for line in (*slices.lines, *slices.boundaries)
        for piece in line.pieces
        if not _is_useful(piece, facets=slices.facets)
    ]
    if not left:
        return slices.report
    names = list(dict.fromkeys(left))
    told = ", ".join(names[:_NAMES]) + (" and others" if len(names) > _NAMES else "")
    what = f"{len(left)} pieces shorter than {_CRUMB:g} m or of one facet left out, of {told}"
    note = Note("crumbs", "the lines", what, len(left))
    return attrs.evolve(slices.report, suspicions=(*slices.report.suspicions, note))


def net_from_slices(
    slices: Slices,
    particulars: Particulars | None = None,
    tolerance: float | None = None,
    rules: FeatureRules | None = None,
    tell: Tell = silent,
) -> tuple[HullState, SliceReport]:
    """Adopt slices as a net.

    Parameters
    ----------
    slices : Slices
        From a mesh or digitised.
    particulars : Particulars or None
        By default from the extent of the hull, the draught at half its depth.
    tolerance, rules
        As for `sources_from_slices`.
    tell : callable
        Hears what is being done.

    Returns
    -------
    HullState, SliceReport

    Raises
    ------
    BadInputError
        Slices with fewer than two lines, or as for `sources_from_slices`.
    """
    if len(slices.lines) < 2:
        raise BadInputError(
            f"{len(slices.lines)} line(s)", f"in {slices.name}", "give two or more lines"
        )
    wanted = rules or FeatureRules()
    tell("finding features and smoothing", 0, 0)
    sources, smoothing, knuckles, allowed, borders = sources_from_slices(slices, tolerance, wanted)
    size = slices.high - slices.low
    ship = particulars or Particulars(
        slices.name, float(size[0]), 2.0 * float(slices.high[1]), float(size[2]),
        0.5 * float(size[2]),
    )  # fmt: skip
    # Reports of pieces stand in the order of the curves that are made of them.
    pairs = sorted(zip(sources, smoothing, strict=True), key=lambda each: source_order(each[0]))
    links = _links({source.group for source in sources})
    tell("adopting", 0, 0)
    state, adoption = adopt(sources, ship, links, Tolerances(adoption=allowed))
    report = SliceReport(
        _tell_crumbs(slices), slices.joins, slices.gaps, wanted, state.tolerances,
        float(np.median([each.noise for each in smoothing])), slices.depth,
        tuple(each for _, each in pairs), tuple(knuckles), tuple(borders), adoption,
    )  # fmt: skip
    return state, report


def _report_border(border: Border, source: LineSource) -> SmoothReport:
    """Report a boundary curve drawn through marks as if it were a piece."""
    doubt = float(border.doubt.max())
    return SmoothReport(
        border.name, len(border.lines), len(source.points), float(0.5 * np.median(border.doubt)),
        border.residual + doubt, border.residual, 0, 0, (),
    )  # fmt: skip
