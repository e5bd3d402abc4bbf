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

from assoc_hull.display import counted
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, SplineBatch
from assoc_hull.geometry.fairness.combs import comb_teeth
from assoc_hull.geometry.fairness.inflections import inflections
from assoc_hull.geometry.splines.segments import evaluate
from assoc_hull.plot.lines_plan.batten_heat import HeatName, batten_heat
from assoc_hull.plot.lines_plan.drawing import Drawable, Drawing, PlotLine, drawing, zoomed
from assoc_hull.plot.lines_plan.plan import window_rows
from assoc_hull.plot.lines_plan.three_views import Views, body_halves, body_sides, lay_out_views
from assoc_hull.plot.sheet.labels import label_row
from assoc_hull.plot.sheet.paper import GRID, HEAVY, MARGIN, TINT, PaperName, Pen, View, scale_of
from assoc_hull.plot.sheet.sheet_figure import Path_, Sheet, save
from assoc_hull.plot.sheet.title_block import BLOCK, caption, frame, title_block

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
_MARGIN, _HEAD, _STATIONS, _LEGEND = 12.0, 11.0, 6.0, 14.0  # mm at A3

_PENS = Pen(0.06, "#4a86b8", over=1.5), Pen(0.12, "#0b5fa5", over=1.8)
_GREY_PENS = Pen(0.06, "0.75", over=1.5), Pen(0.12, "0.45", over=1.8)
"""Of teeth and their tips; grey ones beside lines that are coloured."""

_STEPS = (1.0, 2.0, 5.0, 10.0)


@attrs.frozen(eq=False)
class _Comb:
    """A line with its comb in axes (3, 2) of its plane: m, teeth in 1/m along them, (., 2).

    Teeth outside the drawing's window are nan.
    """

    line: PlotLine
    axes: FloatArray
    courses: tuple[FloatArray, ...]
    base: FloatArray
    tooth: FloatArray
    inflections: FloatArray

    @property
    def splines(self) -> tuple[SplineBatch, ...]:
        """Its curves, each once: a window may cut one into pieces."""
        return tuple(dict.fromkeys(self.line.splines))

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
    heat: HeatName | None = None,
    x: tuple[float, float] | None = None,
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
    heat : "residual" or "ratio", optional
        Colour the lines as `lines_plan` does.
    x : (float, float), m, optional
        Draw only what lies between these stations, larger.

    Returns
    -------
    matplotlib.figure.Figure
        The picture; scales are stated at each panel.

    Raises
    ------
    BadInputError
        No line, a line that lies in no plane or outside the stretch, a scale that is not
        positive, heat of a snapshot.
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
    whole = drawing(hull)
    plan = zoomed(whole, x)
    found = [_comb(_shown(whole, plan, name), plan.window) for name in lines]
    colours = None if heat is None else batten_heat(hull, heat)
    sheet = Sheet(paper)
    factor = sheet.paper.factor
    foot = _MARGIN * factor + (0.0 if colours is None else _LEGEND * factor)
    tall = (sheet.paper.height - _MARGIN * factor - foot) / len(found)
    for i, comb in enumerate(found):
        top = sheet.paper.height - _MARGIN * factor - i * tall
        pens = _PENS if colours is None else _GREY_PENS
        panel = _panel(sheet, comb, (top, tall), scale, plan, pens)
        if colours is not None:
            colours.draw(sheet, panel, comb.line, plan)
    if colours is not None:
        colours.legend(sheet, (_MARGIN * factor, foot))
    if path is not None:
        save(sheet.figure, path)
    return sheet.figure


def _shown(whole: Drawing, plan: Drawing, name: str) -> PlotLine:
    """Give the line of a name within the window."""
    line = whole.line(name)
    for each in plan.lines:
        if each.name == line.name:
            return each
    low, high = line.points[:, 0].min(), line.points[:, 0].max()
    raise BadInputError(
        f"{line.name} lies between x = {low:.2f} and {high:.2f} m", "outside the stretch drawn",
        "leave it out, or draw another stretch",
    )  # fmt: skip


def _comb(line: PlotLine, window: tuple[float, float] | None) -> _Comb:
    """Take the curvature of a line, in axes of its plane: along the ship first, then up."""
    if np.isnan(line.normal).any():
        raise BadInputError("a space curve has no comb in a plane", line.name, "choose plane lines")
    axes = _axes(line.normal)
    base, tooth, bends = [], [], []
    for spline in dict.fromkeys(line.splines):
        foot, along, places = _teeth(spline, line, _TEETH, window)
        base.append(foot @ axes)
        tooth.append(along @ axes)
        bends.append(places @ axes)
    courses = tuple(points @ axes for points in line.polylines)
    return _Comb(line, axes, courses, *(np.concatenate(each) for each in (base, tooth, bends)))


def _teeth(
    spline: SplineBatch, line: PlotLine, count: int, window: tuple[float, float] | None
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Give feet (k, 3), m, of so many teeth a segment, teeth (k, 3), 1/m, and inflections.

    Outside a window teeth are nan, and inflections left out.
    """
    foot, tip = (each.reshape(-1, 3) for each in comb_teeth(spline, line.normal, count, -1.0))
    tooth = np.nan_to_num(tip - foot)
    places = inflections(spline, line.normal)[1]
    bends = evaluate(spline, places.curve, places.t)
    if window is not None:
        low, high = window
        tooth[(foot[:, 0] < low) | (foot[:, 0] > high)] = np.nan
        bends = bends[(bends[:, 0] >= low) & (bends[:, 0] <= high)]
    return foot, tooth, bends


def _axes(normal: FloatArray) -> FloatArray:
    """Give two unit vectors of a plane, (3, 2): forward or outward, and across to it."""
    first = np.array([1.0, 0.0, 0.0]) if abs(normal[0]) < 0.9 else np.array([0.0, 1.0, 0.0])
    first = first - (first @ normal) * normal
    first /= np.sqrt(first @ first)
    second = np.cross(normal, first)
    upward = second[2] if abs(second[2]) > 1e-9 else second[1]
    return np.column_stack([first, second if upward > 0.0 else -second])


@attrs.frozen(eq=False)
class _Panel:
    """Where a line lies on the sheet: its axes (3, 2), its origin, mm, and mm for a metre."""

    name: str
    axes: FloatArray
    origin: FloatArray
    unit: float

    def on_paper(self, xyz: FloatArray) -> FloatArray:
        """Give points (k, 3), m, on the sheet, (k, 2), mm."""
        found: FloatArray = self.origin + self.unit * (xyz @ self.axes)
        return found


def _panel(
    sheet: Sheet, comb: _Comb, band: tuple[float, float], given: float | None, plan: Drawing,
    pens: tuple[Pen, Pen],
) -> _Panel:  # fmt: skip
    """Draw one comb; the curve and its teeth have scales of their own, both stated.

    `band` is the upper edge and the height of the panel, mm.
    """
    factor, (top, tall) = sheet.paper.factor, band
    wide = sheet.paper.width - 2.0 * _MARGIN * factor
    along = abs(comb.axes[0, 0]) == 1.0
    room = tall - (_HEAD + (_STATIONS if along else 0.0)) * factor
    denominator = max(
        scale_of(float(comb.size[0]), wide - 2.0 * _HIGH * room),
        scale_of(float(comb.size[1]), (1.0 - 2.0 * _HIGH) * room),
    )
    length = np.sqrt((comb.tooth * comb.tooth).sum(axis=1))
    per_ten = given or _round(10.0 * _usual(length) / (_HIGH * room))
    unit, high = 1e3 / denominator, 10.0 / per_ten
    low = np.concatenate(comb.courses).min(axis=0)
    centre = np.array([0.5 * sheet.paper.width, top - _HEAD * factor - 0.5 * room])
    panel = _Panel(comb.line.name, comb.axes, centre - unit * (low + 0.5 * comb.size), unit)
    if along:
        _stations(sheet, panel, comb, plan, (top - _HEAD * factor, room))
    cut = _draw(sheet, comb, panel, high, _CUT * _HIGH * room, pens)
    bends = len(comb.inflections)
    words = (
        f"1:{denominator:g};  tooth of 10 mm: curvature {per_ten:g} 1/m, "
        f"radius {1.0 / per_ten:.4g} m;  {counted(bends, 'inflection')} (dots)"
        + (f";  {cut} longer teeth are cut" if cut else "")
    )
    place = (_MARGIN * factor, top - 2.0 * factor)
    name = f"label/{panel.name}"
    title = sheet.text(place, panel.name, size=1.5, bold=True, across="left", up="top", name=name)
    beside = (sheet.box(title)[2] + 4.0 * factor, top - 2.6 * factor)
    sheet.text(beside, words, size=1.1, across="left", up="top", name=f"label/scale/{panel.name}")
    return panel


def _stations(
    sheet: Sheet, panel: _Panel, comb: _Comb, plan: Drawing, band: tuple[float, float]
) -> None:
    """Draw the sections along a line as upright lines, named below; `band` is top and height."""
    factor, (top, room) = sheet.paper.factor, band
    every = np.concatenate(comb.courses)[:, 0]
    sections = [
        each for each in plan.of("sections") or plan.of("frames")
        if every.min() - 1e-6 <= each.offset <= every.max() + 1e-6
    ]  # fmt: skip
    places = [float(panel.origin[0] + panel.unit * each.offset) for each in sections]
    for line, at in zip(sections, places, strict=True):
        sheet.rule((at, top - room), (at, top), GRID, f"stations/{panel.name}/{line.name}")
    ends = np.column_stack([places, np.full(len(places), top - room)])
    below, name = top - room - 1.2 * factor, f"label/{panel.name}/stations"
    words = [line.label for line in sections]
    label_row(sheet, ends, words, "below", below, heading="ST", sparse=True, name=name)


def _usual(length: FloatArray) -> float:
    """Give the length that few teeth exceed, 1/m; 0 where a window holds none."""
    known = length[np.isfinite(length)]
    return float(np.percentile(known, _USUAL)) if len(known) else 0.0


def _round(value: float) -> float:
    """Give the next 1, 2 or 5 times a power of ten above a value; 1 for nil."""
    if value <= 0.0:
        return 1.0
    power = 10.0 ** np.floor(np.log10(value))
    return float(f"{next(step for step in _STEPS if step * power >= value) * power:.6g}")


def _draw(
    sheet: Sheet, comb: _Comb, panel: _Panel, high: float, most: float, pens: tuple[Pen, Pen]
) -> int:
    """Draw curve, teeth and their tips; give how many teeth were cut at `most` mm."""
    name, origin, unit = panel.name, panel.origin, panel.unit
    base = origin + unit * comb.base
    length = high * np.sqrt((comb.tooth * comb.tooth).sum(axis=1))
    long = length > most
    short = np.where(long, most / np.where(long, length, 1.0), 1.0)
    tip = base + high * short[:, None] * comb.tooth
    teeth = np.full((3 * len(base), 2), np.nan)
    teeth[0::3], teeth[1::3] = base, tip
    sheet.line(teeth, pens[0], f"teeth/{name}")
    edge, count = np.where(long[:, None], np.nan, tip), 0
    for spline in comb.splines:
        size = (len(spline.knot) - 1) * _TEETH
        sheet.line(edge[count : count + size], pens[1], f"tips/{name}")
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
)  # mm at A3: about the tooth longer than 19 of 20, and the longest that is drawn
_COMB_PLAN_PENS = Pen(0.04, "#9cc0de", over=1.5), Pen(0.09, "#0b5fa5", over=1.8)
_GREY_PLAN_PENS = Pen(0.04, "0.8", over=1.5), Pen(0.09, "0.5", over=1.8)
_COURSE = Pen(0.13, over=2.5)


def combs_plan(
    hull: Drawable, path: Path_ | None = None, *, paper: PaperName = "A3",
    title: str | None = None, heat: HeatName | None = None,
    x: tuple[float, float] | None = None,
) -> Figure:  # fmt: skip
    """Draw all lines with their curvature combs, each family in the view that shows it true.

    Teeth stand on the outside, dots are inflections. Each view has its own scale of curvature,
    stated for a tooth of 10 mm on paper: a number of one digit, such that 19 of 20 teeth are at
    most 4 to 9 mm long (at A3). Teeth of more than 12 mm are cut.

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
    heat : "residual" or "ratio", optional
        Colour the lines as `lines_plan` does.
    x : (float, float), m, optional
        Draw only what lies between these stations, larger.

    Returns
    -------
    matplotlib.figure.Figure
        The picture; scales are stated below each view.

    Raises
    ------
    BadInputError
        An unknown paper or ending; no line between the stations; heat of a snapshot.
    MissingExtraError
        Matplotlib is not installed.

    Examples
    --------
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.plot import combs_plan
    >>> figure = combs_plan(wigley())
    """
    plan = zoomed(drawing(hull), x)
    colours = None if heat is None else batten_heat(hull, heat)
    sheet = Sheet(paper)
    factor, layout = sheet.paper.factor, lay_out_views(plan, sheet.paper)
    frame(sheet, MARGIN * factor)
    views = Views(sheet, plan, layout.low, layout.high)
    aft, fore = body_halves(views.sections, views.middle)
    body, across = layout.body, 0.5 * float(layout.low[0] + layout.high[0])
    rows, told, pens = [], [], _COMB_PLAN_PENS if colours is None else _GREY_PLAN_PENS
    centre = 0.5 * float(layout.high[1]) * sum(body_sides(plan))
    for view, shown, middle, words in (
        (layout.profile, ((layout.profile, plan.of("buttocks")),), across, "PROFILE"),
        (layout.half, ((layout.half, plan.of("waterlines")),), across, "HALF-BREADTH PLAN"),
        (body, ((body.mirrored(), aft), (body, fore)), centre, "BODY PLAN"),
    ):
        bends, curvature = _view(sheet, shown, plan.window, pens)
        low = float(layout.low[2]) if view.axes[1] == 2 else 0.0
        told.append((
            (view.across(middle), view.up(low) - 13.0 * factor),
            f"{words}  1:{view.denominator:g};  tooth of 10 mm: {curvature:g} 1/m",
        ))  # fmt: skip
        rows.append((f"Inflections, {words.lower()}", f"{bends}"))
    notes = ["Combs stand on the outside; dots are inflections between lobes of 0.2 degrees."]
    rows += window_rows(plan.window)
    name = title or plan.particulars.name
    lower = title_block(sheet, layout.corner, BLOCK * factor, name, rows, notes)
    for place, words in told:
        caption(sheet, place, words)
    views.profile(layout.profile)
    views.half_breadth(layout.half)
    views.body(layout.body)
    if colours is not None:
        views.heat(layout, colours)
        left = layout.corner[0] - (BLOCK - 4.0) * factor
        colours.legend(sheet, (left, lower - 5.0 * factor))
    if path is not None:
        save(sheet.figure, path)
    return sheet.figure


@attrs.frozen(eq=False)
class _CombPlanComb:
    """One curve in a view: foot of each tooth (k, 2), mm, and tooth (k, 2), 1/m."""

    line: PlotLine
    foot: FloatArray
    tooth: FloatArray
    bends: FloatArray


def _view(
    sheet: Sheet, shown: Sequence[tuple[View, Sequence[PlotLine]]],
    window: tuple[float, float] | None, pens: tuple[Pen, Pen],
) -> tuple[int, float]:  # fmt: skip
    """Draw lines with combs; give their inflections and the curvature of a tooth of 10 mm."""
    factor = sheet.paper.factor
    found = [comb for view, lines in shown for line in lines for comb in _combs(view, line, window)]
    if not found:
        return 0, 0.0
    size = np.concatenate([np.hypot(*comb.tooth.T) for comb in found])
    usual = max(_usual(size), 1e-9)
    per_ten = float(f"{10.0 * usual / (_COMB_PLAN_USUAL * factor):.1g}")  # one that is easily read
    high = 10.0 / per_ten
    for view, lines in shown:
        for line in lines:
            for points in line.polylines:
                sheet.line(view.on_paper(points), _COURSE, f"line/{line.name}")
    for comb in found:
        length = high * np.hypot(*comb.tooth.T)
        short = np.minimum(1.0, _COMB_PLAN_CUT * factor / np.maximum(length, 1e-12))
        tip = comb.foot + high * short[:, None] * comb.tooth
        teeth = np.full((3 * len(tip), 2), np.nan)
        teeth[0::3], teeth[1::3] = comb.foot, tip
        name = comb.line.name
        sheet.line(teeth, pens[0], f"teeth/{name}")
        sheet.line(tip, pens[1], f"tips/{name}")
        sheet.dots(comb.bends, TINT, 0.9, f"inflections/{name}")
    return sum(len(comb.bends) for comb in found), per_ten


def _combs(view: View, line: PlotLine, window: tuple[float, float] | None) -> list[_CombPlanComb]:
    """Take the curvature of each curve of a line onto paper."""
    found = []
    for spline in dict.fromkeys(line.splines):
        foot, along, places = _teeth(spline, line, _COMB_PLAN_TEETH, window)
        tooth = along[:, list(view.axes)] * (view.sign, 1.0)
        found.append(_CombPlanComb(line, view.on_paper(foot), tooth, view.on_paper(places)))
    return found
