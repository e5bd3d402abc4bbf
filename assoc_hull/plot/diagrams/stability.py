"""Stability: the curve of righting levers with what criteria look at, and cross curves.

`lever_picture` draws GZ and the dynamic arm over the heel, with the areas that criteria look at.
`cross_curve_picture` draws KN over the displacement, a curve for each heel. `plot_stability`
draws the one that fits what it is handed.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from assoc_hull.analysis.stability.criteria import Criterion
from assoc_hull.analysis.stability.cross_curves import CrossCurves
from assoc_hull.analysis.stability.stability_report import Stability
from assoc_hull.arguments import instance
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.plot.sheet.chart import (
    Chart,
    ChartScale,
    chart_block,
    chart_on,
    level_grid,
    scale_to,
    smooth_course,
    upright_grid,
)
from assoc_hull.plot.sheet.labels import LabelledLine, label_above, label_lines, label_row
from assoc_hull.plot.sheet.paper import AXIS, HEAVY, TINT, PaperName, Pen
from assoc_hull.plot.sheet.sheet_figure import Path_, Sheet, save

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = [
    "cross_curve_picture",
    "lever_picture",
    "plot_stability",
]

# --------------------------------------------------------------------------------------
# Cross curves of stability: KN over the displacement, a curve for each heel.

_WHERE = "in a picture of cross curves"
_COLOURS = ("#0b3c6f", "#c8102e", "#0a7d55", "#7a3b9a", "#a8570f", "#2a7f9e")


def cross_curve_picture(
    found: CrossCurves, path: Path_ | None = None, *, paper: PaperName = "A3"
) -> Figure:
    """Draw KN over the displacement, a curve for each heel.

    Parameters
    ----------
    found : CrossCurves
        Two displacements or more.
    path : path, optional
        Where to write it; the ending says whether PDF, SVG or PNG.
    paper : "A3", "A1" or "A4"
        Size of the sheet, landscape.

    Raises
    ------
    BadInputError
        A single displacement, an unknown paper or ending.
    MissingExtraError
        Matplotlib is not installed.
    """
    instance(found, CrossCurves, "found", _WHERE)
    if len(found.conditions) < 2 or not np.isfinite(found.kn).any():
        what = f"{len(found.conditions)} displacement(s)"
        raise BadInputError(what, _WHERE, "give two or more at which she floats heeled")
    sheet = Sheet(paper)
    chart, weight = chart_on(sheet, 14.0), found.displacement
    along = scale_to(float(weight[0]), float(weight[-1]), chart.left, chart.wide, 14, whole=False)
    low, high = float(np.nanmin(found.kn)), float(np.nanmax(found.kn))
    up = scale_to(min(low, 0.0), max(high, 1e-3), chart.low, chart.tall, 20)
    level_grid(chart, up, "KN, m")
    upright_grid(chart, along, "displacement, t")
    chart.border()
    lines = []
    for k, (heel, kn) in enumerate(zip(found.heel_deg.tolist(), found.kn.T, strict=True)):
        known = np.isfinite(kn)
        if known.sum() < 2:
            continue
        course = smooth_course(weight[known], kn[known])
        points = np.column_stack([along.at(course[:, 0]), up.at(course[:, 1])])
        sheet.line(points, Pen(0.3, _COLOURS[k % len(_COLOURS)], over=3.0), f"curve/{heel:g}")
        lines.append(LabelledLine(f"{heel:g}°", points, f"{heel:g}°"))
    chart_block(sheet, found, "CROSS CURVES OF STABILITY", _rows(found))
    edge = 4.0 * sheet.paper.factor
    ends = chart.left + edge, chart.right - edge
    written = label_lines(sheet, lines, *ends, axis=0, name="label/curve")
    missing = {line.label for line in lines} - written
    label_above(sheet, lines, missing, chart.top + 1.0 * sheet.paper.factor, "label/curve")
    if path is not None:
        save(sheet.figure, path)
    return sheet.figure


def _rows(found: CrossCurves) -> list[tuple[str, str]]:
    draughts = found.draught
    trim = found.conditions[0].upright.trim_by_stern + 0.0
    kg = found.header.kg
    rows = [
        ("Trim as she heels", found.trim),
        ("Trim upright, + by the stern", f"{trim:.3f} m"),
        ("Mean draughts upright", f"{draughts[0]:.3f} to {draughts[-1]:.3f} m"),
        ("Curves", "KN for heels in degrees"),
        ("GZ at no trim", "KN - KG sin(heel)"),
    ]
    if found.trim == "free":
        high = "that of the centre of buoyancy" if kg is None else f"{kg:g} m"
        rows.append(("KG for the trim", high))
    return rows


# --------------------------------------------------------------------------------------
# The curve of righting levers: what criteria look at, and the work it takes to heel the ship.

_GZ = Pen(0.4, "#0b3c6f", over=3.0)
_ARM = Pen(0.28, "#0a7d55", (3.0, 1.0), 2.8)
_TANGENT = Pen(0.2, "#7a3b9a", (1.5, 0.8), 2.6)
_MARK = Pen(0.18, TINT, (2.0, 0.8), 2.4)
_AREAS = ("#cfe0f2", "#9dbfe2")
_COUNT = 400
_RADIAN = float(np.degrees(1.0))


def plot_stability(
    found: Stability | CrossCurves, path: Path_ | None = None, *, paper: PaperName = "A3"
) -> Figure:
    """Draw righting levers or cross curves; see `lever_picture` and `cross_curve_picture`."""
    if isinstance(found, CrossCurves):
        return cross_curve_picture(found, path, paper=paper)
    return lever_picture(found, path, paper=paper)


def lever_picture(
    found: Stability, path: Path_ | None = None, *, paper: PaperName = "A3"
) -> Figure:
    """Draw GZ and the dynamic arm over the heel, with the areas that criteria look at.

    Parameters
    ----------
    found : Stability
        Of a ship; heels are to the side on which she is judged.
    path : path, optional
        Where to write it; the ending says whether PDF, SVG or PNG.
    paper : "A3", "A1" or "A4"
        Size of the sheet, landscape.

    Raises
    ------
    BadInputError
        An unknown paper or ending.
    MissingExtraError
        Matplotlib is not installed.
    """
    instance(found, Stability, "found", "in a picture of stability")
    sheet = Sheet(paper)
    chart, heel = chart_on(sheet, 14.0), _heels(found)
    side = found.curve.side
    gz = side * found.curve.gz(side * heel)
    along = scale_to(float(heel[0]), float(heel[-1]), chart.left, chart.wide, 18, whole=False)
    high = max(1.05 * float(gz.max()), 0.05)
    # All that the table has: levers below nought tell how she goes over.
    up = scale_to(min(float(gz.min()), 0.0), high, chart.low, chart.tall, 16)
    level_grid(chart, up, "GZ, m")
    upright_grid(chart, along, f"heel to {found.side}, degrees")
    _areas(chart, found, along, up)
    chart.border()
    chart.level(float(up.at(0.0)), HEAVY, "nought")
    levers = _within(chart, np.column_stack([along.at(heel), up.at(gz)]))
    sheet.line(levers, _GZ, "curve/gz")
    named = [
        LabelledLine("GZ", _shown(levers)),
        LabelledLine("e", _shown(_arm(chart, found, along, up, heel))),
        LabelledLine(f"GM {found.gm:.3f} m", _tangent(chart, found, along, up)),
    ]
    spots = np.column_stack([along.at(side * found.heel_deg), up.at(side * found.gz)])
    sheet.dots(_shown(_within(chart, spots)), _GZ.colour, 1.0, "heels")
    title = f"RIGHTING LEVERS   {found.trim} trim, {found.condition.upright}"
    chart_block(sheet, found, title, [*_facts(found), *map(_judged, found.criteria)])
    _marks(chart, found, along, up)
    edge = 4.0 * sheet.paper.factor
    label_lines(sheet, named, chart.low + edge, chart.top - edge, axis=1, name="label/curve")
    if path is not None:
        save(sheet.figure, path)
    return sheet.figure


def _heels(found: Stability) -> FloatArray:
    """Give heels along the curve, degrees, to the side judged."""
    known = np.sort(found.curve.side * found.curve.heels.heel_deg)
    return np.union1d(np.linspace(known[0], known[-1], _COUNT), known)


def _within(chart: Chart, points: FloatArray) -> FloatArray:
    """Give points with nan in the place of those outside the field, where lines break off."""
    x, y = points.T
    inside = (x >= chart.left - 1e-6) & (x <= chart.right + 1e-6)
    inside &= (y >= chart.low - 1e-6) & (y <= chart.top + 1e-6)
    return np.where(inside[:, None], points, np.nan)


def _shown(points: FloatArray) -> FloatArray:
    """Give the points that are none of these."""
    found: FloatArray = points[np.isfinite(points).all(axis=1)]
    return found


def _areas(chart: Chart, found: Stability, along: ChartScale, up: ChartScale) -> None:
    """Tint what counts from 0 to 30 degrees, and from there to 40 or to down-flooding."""
    flooding, side = found.angles.flooding, found.curve.side
    limit = min(40.0, found.curve.end, 40.0 if flooding is None else flooding)
    for (low, high), colour in zip(((0.0, 30.0), (30.0, 40.0)), _AREAS, strict=True):
        heel = np.linspace(low, min(high, limit), 120)
        if heel[-1] <= low:
            continue
        gz = side * found.curve.gz(side * heel)
        x, y = along.at(heel), up.at(gz)
        floor = float(up.at(0.0))
        chart.sheet.axes.fill(
            np.append(x, [x[-1], x[0]]), np.append(y, [floor, floor]),
            color=colour, linewidth=0.0, zorder=0.5,
        )  # fmt: skip


def _tangent(chart: Chart, found: Stability, along: ChartScale, up: ChartScale) -> FloatArray:
    """Draw the slope upright: it reaches GM at one radian, and is cut where the field ends."""
    gm = found.gm
    end = min(_RADIAN, along.high)
    bound = up.high if gm > 0.0 else up.low
    if abs(gm) * end / _RADIAN > abs(bound):
        end = _RADIAN * bound / gm
    ends = np.array([[0.0, 0.0], [end, gm * end / _RADIAN]])
    points = np.column_stack([along.at(ends[:, 0]), up.at(ends[:, 1])])
    chart.sheet.line(points, _TANGENT, "tangent")
    if end == _RADIAN:
        x, y = points[1].tolist()
        chart.sheet.rule((x, float(up.at(0.0))), (x, y), _TANGENT, "tangent/radian")
    return points


def _arm(
    chart: Chart, found: Stability, along: ChartScale, up: ChartScale, heel: FloatArray
) -> FloatArray:
    """Draw the dynamic arm, with its own scale to the right and the same nought."""
    sheet, factor, side = chart.sheet, chart.sheet.paper.factor, found.curve.side
    arm = found.curve.arm(side * heel)
    most = max(float(arm.max()), -0.2 * float(arm.min()), 1e-3)
    own = scale_to(0.0, most, 0.0, 1.0, 8)
    floor = float(up.at(0.0))
    unit = (chart.top - floor) / (1.02 * own.high)
    points = np.column_stack([along.at(heel), floor + unit * arm])
    points = _within(chart, points)
    sheet.line(points, _ARM, "curve/arm")
    for value in own.marks.tolist():
        y = floor + unit * value
        sheet.rule((chart.right - 1.2 * factor, y), (chart.right, y), _ARM, "tick")
        place = (chart.right + 1.0 * factor, y)
        sheet.take(sheet.text(place, own.word(value), across="left", colour=_ARM.colour, size=0.85,
                              name="label/arm"))  # fmt: skip
    place = (chart.right + 7.0 * factor, chart.top + 3.9 * factor)
    sheet.take(sheet.text(place, "e, m rad", across="right", up="bottom", bold=True,
                          colour=_ARM.colour, name="label/arm"))  # fmt: skip
    return points


def _marks(chart: Chart, found: Stability, along: ChartScale, up: ChartScale) -> None:
    """Draw heels at which something happens, named above the field."""
    sheet, factor, angles = chart.sheet, chart.sheet.paper.factor, found.angles
    flooding = "down-flooding"
    named = [
        ("equilibrium", angles.equilibrium or None), ("deck edge", angles.deck_edge),
        (flooding, angles.flooding), ("GZ vanishes", angles.vanishing),
        ("largest GZ", angles.largest),
    ]  # fmt: skip
    shown = sorted((heel, name) for name, heel in named if heel is not None)
    shown = [(heel, name) for heel, name in shown if heel <= along.high + 1e-3]
    for heel, name in shown:
        x = float(along.at(heel))
        top = float(up.at(found.gz_max)) if name == "largest GZ" else chart.top
        pen = _MARK if name == flooding else AXIS
        sheet.rule((x, float(up.at(0.0))), (x, top), pen, f"mark/{name}")
        if top < chart.top:
            sheet.dots(np.array([[x, top]]), TINT, 1.4, "mark/top")
    if shown:
        ends = np.array([[float(along.at(heel)), chart.top] for heel, _ in shown])
        words = [f"{name} {heel:.1f}" for heel, name in shown]
        label_row(sheet, ends, words, "above", chart.top + 1.0 * factor, name="label/mark")


def _facts(found: Stability) -> list[tuple[str, str]]:
    ship, angles = found.condition, found.angles

    def at(heel: float | None) -> str:
        return f"beyond {found.curve.end:.4g} deg" if heel is None else f"{heel:.2f} deg"

    return [
        ("Displacement", f"{ship.weight:,.2f} t"),
        ("LCG, TCG, KG", f"{ship.lcg:.3f}, {ship.tcg:g}, {ship.kg:g} m"),
        ("Initial metacentric height", f"{found.gm:.3f} m"),
        ("Largest lever", f"{found.gz_max:.3f} m at {angles.largest:.2f} deg"),
        ("Levers vanish at", at(angles.vanishing)),
        ("Deck edge under at", at(angles.deck_edge)),
        ("Down-flooding at", "not given" if not found.floodings else at(angles.flooding)),
    ]


def _judged(criterion: Criterion) -> tuple[str, str]:
    """Give a criterion as a line of the block."""
    title = f"A {criterion.code} {criterion.name}"
    if criterion.value is None or criterion.passed is None:
        return title, "not evaluated"
    word = "passed" if criterion.passed else "FAILED"
    return title, f"{criterion.value:.3f} of {criterion.required:g} {criterion.unit}, {word}"
