"""From slices to a net: features, smooth lines, boundary curves, adoption.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.io.mesh import slice_mesh
>>> from assoc_hull.io.mesh_file import grid_triangles
>>> from assoc_hull.io.slice_net import net_from_slices
>>> x, z = np.meshgrid(np.linspace(0, 100, 201), np.linspace(0, 6.25, 41), indexing="ij")
>>> y = 5.0 * (1.0 - (x / 50.0 - 1.0) ** 2) * (1.0 - (1.0 - z / 6.25) ** 2)
>>> mesh = grid_triangles(np.stack([x, y, z], axis=2))
>>> slices = slice_mesh(mesh, stations=9, waterlines=5, buttocks=2)
>>> state, report = net_from_slices(slices)
>>> len(report.adoption.lines), report.inflections
(18, (0, 0))
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.edit.adopt import AdoptionReport, adopt
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import CurveData, SplineBatch
from assoc_hull.geometry.fairness import inflections
from assoc_hull.geometry.spline import loft
from assoc_hull.io.offset_net import ASSOCIATIONS
from assoc_hull.io.offset_report import OffsetReport
from assoc_hull.io.slice_features import (
    FeatureRules,
    KnuckleLine,
    PieceFeatures,
    find_features,
)
from assoc_hull.io.slice_joint import join_plans
from assoc_hull.io.slice_plan import plan_piece
from assoc_hull.io.slice_sources import SmoothReport, make_source, snap_ends
from assoc_hull.io.slice_types import Join, Slices
from assoc_hull.model.source import LineSource
from assoc_hull.model.state import Association, HullState, Particulars
from assoc_hull.tolerance import Tolerances

__all__ = ["SliceReport", "net_from_slices", "sources_from_slices"]


@attrs.frozen(eq=False)
class SliceReport:
    """What became of slices.

    Attributes
    ----------
    slices : OffsetReport
        What was assumed, mended and found suspicious when they were read.
    joins : tuple of Join
        Every join across a gap.
    rules : FeatureRules
        The thresholds.
    tolerance : float, m
        How far an adopted curve may pass its smooth line.
    noise : float, m
        Median over the pieces; of a mesh, the depth of its facets.
    smoothing : tuple of SmoothReport
        Per piece.
    knuckles : tuple of KnuckleLine
        Knuckle lines found.
    adoption : AdoptionReport
        Per curve.
    adopted : int
        Points that no crossing holds.
    inflections : (int, int)
        In all plane curves: of the smooth lines, and what the adopted curves have more.
    """

    slices: OffsetReport
    joins: tuple[Join, ...]
    rules: FeatureRules
    tolerance: float
    noise: float
    smoothing: tuple[SmoothReport, ...]
    knuckles: tuple[KnuckleLine, ...]
    adoption: AdoptionReport
    adopted: int
    inflections: tuple[int, int]


def sources_from_slices(
    slices: Slices, tolerance: float | None = None, rules: FeatureRules | None = None
) -> tuple[list[LineSource], list[SmoothReport], list[KnuckleLine], float]:
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
    sources, reports, knuckle lines, tolerance in m
    """
    wanted = rules or FeatureRules()
    parts, knuckles = find_features(slices, wanted)
    parts = [part for part in parts if _is_useful(part)]
    noise = float(np.median([part.noise for part in parts])) if parts else 0.0
    least = wanted.adopt_least_facets if slices.facets else wanted.adopt_least
    allowed = max(least, wanted.adopt_times * noise) if tolerance is None else tolerance
    rims = [
        make_source(plan_piece(part, wanted), allowed)
        for part in parts if part.line.group == "boundary"
    ]  # fmt: skip
    borders: dict[str, list[SplineBatch]] = {}
    for source, _ in rims:
        borders.setdefault(source.name, []).append(_loft(source))
    plans = [
        plan_piece(snap_ends(part, borders, 0.5 * allowed), wanted)
        for part in parts if part.line.group != "boundary"
    ]  # fmt: skip
    links = _links({plan.part.line.group for plan in plans})
    joined = join_plans(plans, links, max(wanted.near_least, wanted.near_times * noise))
    made = [make_source(plan, allowed) for plan in joined]
    made += rims
    return [source for source, _ in made], [each for _, each in made], knuckles, allowed


def _links(groups: set[str]) -> list[Association]:
    """Give the associations between groups that are there."""
    return [each for each in ASSOCIATIONS if {each.a, each.b} <= groups]


def _is_useful(part: PieceFeatures) -> bool:
    """Leave out crumbs: pieces of two points or shorter than a hand."""
    return len(part.points) > 2 and float(np.ptp(part.points, axis=0).max()) > 0.1


def net_from_slices(
    slices: Slices,
    particulars: Particulars | None = None,
    tolerance: float | None = None,
    rules: FeatureRules | None = None,
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

    Returns
    -------
    HullState, SliceReport

    Raises
    ------
    BadInputError
        Slices with fewer than two lines.
    """
    if len(slices.lines) < 2:
        raise BadInputError(
            f"{len(slices.lines)} line(s)", f"in {slices.name}", "give two or more lines"
        )
    wanted = rules or FeatureRules()
    sources, smoothing, knuckles, allowed = sources_from_slices(slices, tolerance, wanted)
    size = slices.high - slices.low
    ship = particulars or Particulars(
        slices.name, float(size[0]), 2.0 * float(slices.high[1]), float(size[2]),
        0.5 * float(size[2]),
    )  # fmt: skip
    links = _links({source.group for source in sources})
    state, adoption = adopt(sources, ship, links, Tolerances(adoption=allowed))
    report = SliceReport(
        slices.report, slices.joins, wanted, allowed,
        float(np.median([each.noise for each in smoothing])), tuple(smoothing),
        tuple(knuckles), adoption, sum(line.adopted for line in adoption.lines),
        _inflections(state, sources),
    )  # fmt: skip
    return state, report


def _loft(source: LineSource) -> SplineBatch:
    """Loft a line through its own points."""
    return loft(
        CurveData(
            np.array([0, len(source.points)]), source.points, source.kind, source.direction,
            np.array([source.ends.kind], np.int8), np.array([source.ends.vector], np.float64),
        )
    )  # fmt: skip


def _inflections(state: HullState, sources: list[LineSource]) -> tuple[int, int]:
    """Count inflections of the smooth lines, and those that the net has more, line by line."""
    given: dict[tuple[str, str], int] = {}
    for source in sources:
        if source.normal is None:
            continue
        key = (source.group, source.name)
        given[key] = given.get(key, 0) + int(inflections(_loft(source), source.normal)[0][0])
    more = 0
    curves, lines = state.curves, state.lines
    for line in np.flatnonzero(lines.planar.data[: len(lines.name.data)]).tolist():
        numbers = list(lines.curves.data[line])
        batch = SplineBatch.join([curves.spline.data[i] for i in numbers])
        count = int(
            inflections(batch, np.tile(lines.normal.data[line], (len(numbers), 1)))[0].sum()
        )
        group = state.groups.name.data[int(lines.group.data[line])]
        more += max(0, count - given.get((group, lines.name.data[line]), 0))
    return sum(given.values()), more
