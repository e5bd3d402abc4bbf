"""Body plan, half-breadth plan and profile with the curvature combs of all their lines."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.fairness.combs import combs
from assoc_hull.geometry.fairness.inflections import inflections
from assoc_hull.geometry.splines.evaluation import evaluate
from assoc_hull.plot.lines_plan.drawing import Drawing, DrawnLine, Sketchable, drawing
from assoc_hull.plot.lines_plan.layout import BLOCK, lay_out
from assoc_hull.plot.lines_plan.views import body_halves
from assoc_hull.plot.sheet.paper import MARGIN, PaperName, Pen
from assoc_hull.plot.sheet.pens import LINE, TINT
from assoc_hull.plot.sheet.sheet import Path_, Sheet, save
from assoc_hull.plot.sheet.title_block import caption, frame, title_block
from assoc_hull.plot.sheet.view import View

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["combs_plan"]

_TEETH = 6
_USUAL, _CUT = 6.0, 12.0  # mm at A3: a tooth longer than 19 of 20, and the longest that is drawn
_TOOTH = Pen(0.04, "#9cc0de", over=1.5)
_TIPS = Pen(0.09, "#0b5fa5", over=1.8)
_COURSE = Pen(0.13, over=2.5)


def combs_plan(
    hull: Sketchable, path: Path_ | None = None, *, paper: PaperName = "A3",
    title: str | None = None,
) -> Figure:  # fmt: skip
    """Draw all lines with their curvature combs, each family in the view that shows it true.

    Teeth stand on the outside, dots are inflections. Each view has its own scale of curvature,
    such that 19 of 20 teeth are at most 6 mm long (at A3); teeth of more than 12 mm are cut.

    Parameters
    ----------
    hull : Hull, HullState or Drawing
        The hull; `assoc_hull.plot.lines_plan.given.given_lines` makes a drawing of it before
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
    factor, layout = sheet.paper.factor, lay_out(plan, sheet.paper)
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
class _Comb:
    """One curve in a view: foot of each tooth (k, 2), mm, and tooth (k, 2), 1/m."""

    line: DrawnLine
    course: FloatArray
    foot: FloatArray
    tooth: FloatArray
    bends: FloatArray


def _view(sheet: Sheet, shown: Sequence[tuple[View, Sequence[DrawnLine]]]) -> tuple[int, float]:
    """Draw lines with combs; give their inflections and the curvature of a tooth of 10 mm."""
    factor = sheet.paper.factor
    found = [comb for view, lines in shown for line in lines for comb in _combs(view, line)]
    if not found:
        return 0, 0.0
    size = np.concatenate([np.hypot(*comb.tooth.T) for comb in found])
    high = _USUAL * factor / max(float(np.percentile(size, 95.0)), 1e-9)
    for comb in found:
        length = high * np.hypot(*comb.tooth.T)
        short = np.minimum(1.0, _CUT * factor / np.maximum(length, 1e-12))
        tip = comb.foot + high * short[:, None] * comb.tooth
        teeth = np.full((3 * len(tip), 2), np.nan)
        teeth[0::3], teeth[1::3] = comb.foot, tip
        name = comb.line.name
        sheet.line(teeth, _TOOTH, f"teeth/{name}")
        sheet.line(tip, _TIPS, f"tips/{name}")
        sheet.line(comb.course, _COURSE, f"line/{name}")
        sheet.dots(comb.bends, TINT, 0.9, f"inflections/{name}")
    return sum(len(comb.bends) for comb in found), 10.0 * factor / high


def _combs(view: View, line: DrawnLine) -> list[_Comb]:
    """Take the curvature of each curve of a line onto paper."""
    found = []
    for spline, points in zip(line.splines, line.polylines, strict=True):
        foot, tip = (each.reshape(-1, 3) for each in combs(spline, line.normal, _TEETH, -1.0))
        tooth = np.nan_to_num(tip - foot)[:, list(view.axes)] * (view.sign, 1.0)
        places = inflections(spline, line.normal)[1]
        bends = view.on_paper(evaluate(spline, places.curve, places.t))
        found.append(_Comb(line, view.on_paper(points), view.on_paper(foot), tooth, bends))
    return found
