"""What adoption made of given lines: per curve how closely, with how many points, how fair.

Examples
--------
>>> from assoc_hull.shipped.series60 import series60_adopted
>>> report = series60_adopted(0.70)[1]
>>> worst = report.worst
>>> worst.line, round(1e3 * worst.deviation, 2)
('profile', 0.25)
>>> report.own_points, report.inflections
(17, (64, 0))
"""

from __future__ import annotations

from collections import defaultdict

import attrs
import numpy as np

from assoc_hull.edit.adoption.thinning_state import Net
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.fairness.inflections import inflections
from assoc_hull.geometry.splines.closest import closest_each
from assoc_hull.geometry.splines.evaluation import evaluate
from assoc_hull.model.kinds import Sort
from assoc_hull.model.state import HullState

__all__ = ["AdoptionReport", "LineReport", "report_lines"]


@attrs.frozen
class LineReport:
    """How one curve was adopted.

    Attributes
    ----------
    curve : str
        Key of the curve.
    group, line : str
        The line it belongs to; a line in several pieces has several curves.
    given, defining : int
        Points given, and points that define the curve.
    crossings, adopted, placed : int
        The defining points by sort; together they are `defining`.
    deviation : float, m
        Largest distance of a given point from the curve; of a densely drawn line, of a place
        half-way between two points, too.
    deviation_median, deviation_p95 : float, m
        Half, and 19 of 20, of the given points lie this close.
    place : (float, float, float), m
        The given point that lies farthest off.
    tolerance : float, m
        How far the curve may pass that point.
    tolerance_used : float
        The largest part of what is allowed, at any place: up to 1 the curve is within.
    inflections_given, inflections : int
        Of the given line and of the curve; nil for a space curve, whose curvature has no sign.
    """

    curve: str
    group: str
    line: str
    given: int
    defining: int
    crossings: int
    adopted: int
    placed: int
    deviation: float
    deviation_median: float
    deviation_p95: float
    place: tuple[float, float, float]
    tolerance: float
    tolerance_used: float
    inflections_given: int
    inflections: int


@attrs.frozen
class AdoptionReport:
    """What adoption made of the given lines; notes say what was assumed or left out."""

    lines: tuple[LineReport, ...]
    notes: tuple[str, ...]

    @property
    def worst(self) -> LineReport:
        """The curve with the largest deviation."""
        return max(self.lines, key=lambda each: each.deviation)

    @property
    def own_points(self) -> int:
        """Adopted points: those that define a curve and that no crossing holds."""
        return sum(each.adopted for each in self.lines)

    @property
    def inflections(self) -> tuple[int, int]:
        """Inflections of the given lines in all, and those that the net has more, by line."""
        lines: dict[tuple[str, str], list[LineReport]] = defaultdict(list)
        for each in self.lines:
            lines[each.group, each.line].append(each)
        more = (
            sum(each.inflections - each.inflections_given for each in mine)
            for mine in lines.values()
        )
        given = sum(each.inflections_given for each in self.lines)
        return given, sum(max(0, count) for count in more)


def report_lines(net: Net) -> tuple[LineReport, ...]:
    """Compare the curves of a net with the lines it was adopted from.

    Parameters
    ----------
    net : Net
        The given lines, their references, and the net that was made of them.
    """
    curves = net.state.curves
    splines = SplineBatch.join([curves.spline.data[i] for i in range(len(net.sources))])
    normals = np.array(
        [np.full(3, np.nan) if each.normal is None else each.normal for each in net.sources]
    )
    bends = (inflections(batch, normals)[0] for batch in (net.reference, splines))
    given, found = bends
    away = _away(net, splines)
    return tuple(
        _line(net, i, away[i], int(given[i]), int(found[i])) for i in range(len(net.sources))
    )


def _away(net: Net, splines: SplineBatch) -> list[FloatArray]:
    """Give how far each curve passes the points it is measured at, m."""
    points = [_measured(net, i)[0] for i in range(len(net.sources))]
    sizes = [len(each) for each in points]
    curve = np.repeat(np.arange(len(points)), sizes)
    away = closest_each(splines, curve, np.concatenate(points))[2]
    return np.split(away, np.cumsum(sizes)[:-1])


def _line(net: Net, number: int, away: FloatArray, given: int, found: int) -> LineReport:
    state, source = net.state, net.sources[number]
    crossings, adopted, placed = _sorts(state, state.curves.rows.data[number])
    points, tolerance = _measured(net, number)
    worst = int(np.argmax(away))
    x, y, z = points[worst].tolist()
    return LineReport(
        state.curves.key.data[number], source.group, source.name, len(source.points),
        crossings + adopted + placed, crossings, adopted, placed, float(away[worst]),
        float(np.median(away)), float(np.percentile(away, 95.0)), (x, y, z),
        float(tolerance[worst]), float((away / tolerance).max()), given, found,
    )  # fmt: skip


def _measured(net: Net, number: int) -> tuple[FloatArray, FloatArray]:
    """Give places of a line and how far they may be passed: of a dense one, between points too."""
    source = net.sources[number]
    tolerance = np.broadcast_to(source.tolerance, len(source.points)).astype(np.float64)
    if not source.dense:
        return source.points, tolerance
    knot = net.reference.curve(number).knot
    at = np.sort(np.concatenate([knot, 0.5 * (knot[1:] + knot[:-1])]))
    points = evaluate(net.reference, np.full(len(at), number), at)
    return points, np.interp(at, knot, tolerance)


def _sorts(state: HullState, rows: IntArray) -> tuple[int, int, int]:
    """Count the points of a curve: crossings, adopted and placed ones."""
    sort = state.rows.sort.data[rows]
    adopted, placed = int((sort == Sort.ADOPTED).sum()), int((sort == Sort.PLACED).sum())
    return len(rows) - adopted - placed, adopted, placed
