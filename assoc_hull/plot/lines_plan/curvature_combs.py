"""Curvature combs of lines: a few lines each in its own plane, or all lines in the three views.

Teeth stand on the outside of a curve, as long as the curvature times a
length that is chosen so that usual teeth are well seen; longer ones are cut. Inflections are
marked.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.fairness.combs import comb_teeth
from assoc_hull.geometry.fairness.inflections import inflections
from assoc_hull.geometry.splines.evaluation import evaluate
from assoc_hull.plot.lines_plan.drawing import Drawable, Drawing, PlotLine, drawing
from assoc_hull.plot.lines_plan.three_views import body_halves, lay_out_views
from assoc_hull.plot.sheet.paper import HEAVY, LINE, MARGIN, TINT, PaperName, Pen
from assoc_hull.plot.sheet.sheet_figure import Path_, Sheet, save
from assoc_hull.plot.sheet.title_block import BLOCK, caption, frame, title_block
from assoc_hull.plot.sheet.view import View, scale_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = [
    "combs_plan",
    "curvature_combs",
]

# --------------------------------------------------------------------------------------
# Curvature combs of lines, each in its own plane, with the inflections marked.

_TEETH = 8
_HIGH = 0.2  # part of a panel's height that a usual tooth takes
_CUT = 1.6  # times that: the longest tooth
_USUAL = 95.0  # per cent of the teeth are no longer than that
_MARGIN, _HEAD = 12.0, 11.0  # mm at A3

_TOOTH = Pen(0.06, "#4a86b8", over=1.5)
_TIPS = Pen(0.12, "#0b5fa5", over=1.8)
_STEPS = (1.0, 2.0, 5.0, 10.0)


@attrs.frozen(eq=False)
class _Comb:
    """A line with its comb in axes of its plane: m, teeth in 1/m along them, (., 2)."""

    line: PlotLine
    courses: tuple[FloatArray, ...]
    base: FloatArray
    tooth: FloatArray
    inflections: FloatArray

    @property
    def size(self) -> FloatArray:
        """Extent in both axes, m."""
        found: FloatArray = np.ptp(np.concatenate(self.courses), axis=0)
        return found


def curvature_combs(
    hull: Drawable,
    lines: Sequence[str],
    path: Path_ | None = None,
    *,
    scale: float | None = None,
    paper: PaperName = "A3",
) -> Figure:
    """Draw curvature combs: the teeth stand on the outside of the curve.

    Parameters
    ----------
    hull : Hull, HullState or Drawing
        The hull.
    lines : sequence of str
        Names of the lines; one panel each, one below the other.
    path : path, optional
        Where to write it; the ending says whether PDF, SVG or PNG.
    scale : float, optional
        Curvature (1/m) that a tooth of 10 mm on paper stands for, at all lines; by default
        chosen line by line so that 95 % of the teeth fit; how many longer ones are cut is told.
    paper : "A3", "A1" or "A4"
        Size of the sheet, landscape.

    Returns
    -------
    matplotlib.figure.Figure
        The picture; scales are stated at each panel.

    Raises
    ------
    BadInputError
        No line, a line that lies in no plane, a scale that is not positive.
    UnknownNameError
        A line that does not exist.
    MissingExtraError
        Matplotlib is not installed.

    Examples
    --------
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.plot.lines_plan.curvature_combs import curvature_combs
    >>> figure = curvature_combs(wigley(), ["WL 2.5", "ST 7"])
    """
    if not lines or not (scale is None or scale > 0.0):
        raise BadInputError(
            f"{len(lines)} lines and a scale of {scale}", "in curvature combs",
            "name a line or more, and give a scale above 0",
        )  # fmt: skip
    plan = drawing(hull)
    found = [_comb(plan.line(name)) for name in lines]
    sheet = Sheet(paper)
    tall = (sheet.paper.height - 2.0 * _MARGIN * sheet.paper.factor) / len(found)
    for i, comb in enumerate(found):
        top = sheet.paper.height - _MARGIN * sheet.paper.factor - i * tall
        _panel(sheet, comb, top, tall, scale)
    if path is not None:
        save(sheet.figure, path)
    return sheet.figure


def _comb(line: PlotLine) -> _Comb:
    """Take the curvature of a line, in axes of its plane: along the ship first, then up."""
    if np.isnan(line.normal).any():
        raise BadInputError("a space curve has no comb in a plane", line.name, "choose plane lines")
    axes = _axes(line.normal)
    base, tooth, bends = [], [], []
    for spline in line.splines:
        foot, tip = comb_teeth(spline, line.normal, _TEETH, -1.0)
        base.append(foot.reshape(-1, 3) @ axes)
        tooth.append(np.nan_to_num((tip - foot).reshape(-1, 3) @ axes))
        places = inflections(spline, line.normal)[1]
        bends.append(evaluate(spline, places.curve, places.t) @ axes)
    courses = tuple(points @ axes for points in line.polylines)
    return _Comb(line, courses, *(np.concatenate(each) for each in (base, tooth, bends)))


def _axes(normal: FloatArray) -> FloatArray:
    """Give two unit vectors of a plane, (3, 2): forward or outward, and across to it."""
    first = np.array([1.0, 0.0, 0.0]) if abs(normal[0]) < 0.9 else np.array([0.0, 1.0, 0.0])
    first = first - (first @ normal) * normal
    first /= np.sqrt(first @ first)
    second = np.cross(normal, first)
    upward = second[2] if abs(second[2]) > 1e-9 else second[1]
    return np.column_stack([first, second if upward > 0.0 else -second])


def _panel(sheet: Sheet, comb: _Comb, top: float, tall: float, given: float | None) -> None:
    """Draw one comb; the curve and its teeth have scales of their own, both stated."""
    factor = sheet.paper.factor
    wide = sheet.paper.width - 2.0 * _MARGIN * factor
    room = tall - _HEAD * factor
    denominator = max(
        scale_of(float(comb.size[0]), wide - 2.0 * _HIGH * room),
        scale_of(float(comb.size[1]), (1.0 - 2.0 * _HIGH) * room),
    )
    length = np.sqrt((comb.tooth * comb.tooth).sum(axis=1))
    per_ten = given or _round(10.0 * float(np.percentile(length, _USUAL)) / (_HIGH * room))
    unit, high = 1e3 / denominator, 10.0 / per_ten
    low = np.concatenate(comb.courses).min(axis=0)
    centre = np.array([0.5 * sheet.paper.width, top - _HEAD * factor - 0.5 * room])
    origin = centre - unit * (low + 0.5 * comb.size)
    cut = _draw(sheet, comb, origin, unit, high, _CUT * _HIGH * room)
    bends = len(comb.inflections)
    words = (
        f"1:{denominator:g};  tooth of 10 mm: curvature {per_ten:g} 1/m, "
        f"radius {1.0 / per_ten:.4g} m;  {bends} inflection{'' if bends == 1 else 's'} (dots)"
        + (f";  {cut} longer teeth are cut" if cut else "")
    )
    left = _MARGIN * factor
    name = comb.line.name
    title = sheet.text(
        (left, top - 2.0 * factor),
        name,
        size=1.5,
        bold=True,
        across="left",
        up="top",
        name=f"label/{name}",
    )
    beside = sheet.box(title)[2] + 4.0 * factor
    sheet.text(
        (beside, top - 2.6 * factor),
        words,
        size=1.1,
        across="left",
        up="top",
        name=f"label/scale/{name}",
    )


def _round(value: float) -> float:
    """Give the next 1, 2 or 5 times a power of ten above a value; 1 for nil."""
    if value <= 0.0:
        return 1.0
    power = 10.0 ** np.floor(np.log10(value))
    return float(f"{next(step for step in _STEPS if step * power >= value) * power:.6g}")


def _draw(
    sheet: Sheet, comb: _Comb, origin: FloatArray, unit: float, high: float, most: float
) -> int:
    """Draw curve, teeth and their tips; give how many teeth were cut at `most` mm."""
    name = comb.line.name
    base = origin + unit * comb.base
    length = high * np.sqrt((comb.tooth * comb.tooth).sum(axis=1))
    long = length > most
    short = np.where(long, most / np.where(long, length, 1.0), 1.0)
    tip = base + high * short[:, None] * comb.tooth
    teeth = np.full((3 * len(base), 2), np.nan)
    teeth[0::3], teeth[1::3] = base, tip
    sheet.line(teeth, _TOOTH, f"teeth/{name}")
    edge, count = np.where(long[:, None], np.nan, tip), 0
    for spline in comb.line.splines:
        size = (len(spline.knot) - 1) * _TEETH
        sheet.line(edge[count : count + size], _TIPS, f"tips/{name}")
        count += size
    for course in comb.courses:
        sheet.line(origin + unit * course, HEAVY, f"line/{name}")
    sheet.dots(origin + unit * comb.inflections, TINT, 1.3, f"inflections/{name}")
    return int(long.sum())


# --------------------------------------------------------------------------------------
# Body plan, half-breadth plan and profile with the curvature combs of all their lines.

_COMB_PLAN_TEETH = 6
_COMB_PLAN_USUAL, _COMB_PLAN_CUT = (
    6.0,
    12.0,
)  # mm at A3: a tooth longer than 19 of 20, and the longest that is drawn
_COMB_PLAN_TOOTH = Pen(0.04, "#9cc0de", over=1.5)
_COMB_PLAN_TIPS = Pen(0.09, "#0b5fa5", over=1.8)
_COURSE = Pen(0.13, over=2.5)


def combs_plan(
    hull: Drawable, path: Path_ | None = None, *, paper: PaperName = "A3",
    title: str | None = None,
) -> Figure:  # fmt: skip
    """Draw all lines with their curvature combs, each family in the view that shows it true.

    Teeth stand on the outside, dots are inflections. Each view has its own scale of curvature,
    such that 19 of 20 teeth are at most 6 mm long (at A3); teeth of more than 12 mm are cut.

    Parameters
    ----------
    hull : Hull, HullState or Drawing
        The hull; `assoc_hull.plot.lines_plan.drawing.given_lines` makes a drawing of it before
        adoption.
    path : path, optional
        Where to write it; the ending says whether PDF, SVG or PNG.
    paper : "A3", "A1" or "A4"
        Size of the sheet, landscape.
    title : str, optional
        Instead of the name of the ship.

    Returns
    -------
    matplotlib.figure.Figure
        The picture; scales are stated below each view.

    Raises
    ------
    BadInputError
        An unknown paper or ending.
    MissingExtraError
        Matplotlib is not installed.

    Examples
    --------
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.plot import combs_plan
    >>> figure = combs_plan(wigley())
    """
    plan = drawing(hull)
    sheet = Sheet(paper)
    factor, layout = sheet.paper.factor, lay_out_views(plan, sheet.paper)
    frame(sheet, MARGIN * factor)
    middle = 0.5 * plan.particulars.length
    aft, fore = body_halves(plan.of("sections"), middle)
    body, across = layout.body, 0.5 * float(layout.low[0] + layout.high[0])
    rows = []
    for view, shown, centre, words in (
        (layout.profile, ((layout.profile, plan.of("buttocks")),), across, "PROFILE"),
        (layout.half, ((layout.half, plan.of("waterlines")),), across, "HALF-BREADTH PLAN"),
        (body, ((body.mirrored(), aft), (body, fore)), 0.0, "BODY PLAN"),
    ):
        bends, curvature = _view(sheet, shown)
        low = float(layout.low[2]) if view.axes[1] == 2 else 0.0
        told = f"{words}  1:{view.denominator:g};  tooth of 10 mm: {curvature:.3g} 1/m"
        caption(sheet, (view.across(centre), view.up(low) - 13.0 * factor), told)
        rows.append((f"Inflections, {words.lower()}", f"{bends}"))
    _boundaries(sheet, plan, (layout.profile, layout.half))
    notes = ["Combs stand on the outside; dots are inflections between lobes of 0.2 degrees."]
    title_block(sheet, layout.corner, BLOCK * factor, title or plan.particulars.name, rows, notes)
    if path is not None:
        save(sheet.figure, path)
    return sheet.figure


def _boundaries(sheet: Sheet, plan: Drawing, views: Sequence[View]) -> None:
    for view in views:
        for line in plan.of("boundary"):
            for points in line.polylines:
                sheet.line(view.on_paper(points), LINE, f"{view.name}/boundary/{line.name}")


@attrs.frozen(eq=False)
class _CombPlanComb:
    """One curve in a view: foot of each tooth (k, 2), mm, and tooth (k, 2), 1/m."""

    line: PlotLine
    course: FloatArray
    foot: FloatArray
    tooth: FloatArray
    bends: FloatArray


def _view(sheet: Sheet, shown: Sequence[tuple[View, Sequence[PlotLine]]]) -> tuple[int, float]:
    """Draw lines with combs; give their inflections and the curvature of a tooth of 10 mm."""
    factor = sheet.paper.factor
    found = [comb for view, lines in shown for line in lines for comb in _combs(view, line)]
    if not found:
        return 0, 0.0
    size = np.concatenate([np.hypot(*comb.tooth.T) for comb in found])
    high = _COMB_PLAN_USUAL * factor / max(float(np.percentile(size, 95.0)), 1e-9)
    for comb in found:
        length = high * np.hypot(*comb.tooth.T)
        short = np.minimum(1.0, _COMB_PLAN_CUT * factor / np.maximum(length, 1e-12))
        tip = comb.foot + high * short[:, None] * comb.tooth
        teeth = np.full((3 * len(tip), 2), np.nan)
        teeth[0::3], teeth[1::3] = comb.foot, tip
        name = comb.line.name
        sheet.line(teeth, _COMB_PLAN_TOOTH, f"teeth/{name}")
        sheet.line(tip, _COMB_PLAN_TIPS, f"tips/{name}")
        sheet.line(comb.course, _COURSE, f"line/{name}")
        sheet.dots(comb.bends, TINT, 0.9, f"inflections/{name}")
    return sum(len(comb.bends) for comb in found), 10.0 * factor / high


def _combs(view: View, line: PlotLine) -> list[_CombPlanComb]:
    """Take the curvature of each curve of a line onto paper."""
    found = []
    for spline, points in zip(line.splines, line.polylines, strict=True):
        foot, tip = (
            each.reshape(-1, 3) for each in comb_teeth(spline, line.normal, _COMB_PLAN_TEETH, -1.0)
        )
        tooth = np.nan_to_num(tip - foot)[:, list(view.axes)] * (view.sign, 1.0)
        places = inflections(spline, line.normal)[1]
        bends = view.on_paper(evaluate(spline, places.curve, places.t))
        found.append(_CombPlanComb(line, view.on_paper(points), view.on_paper(foot), tooth, bends))
    return found
