"""The report of an adoption as a picture: deviations line by line, and where the worst lie."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from assoc_hull.edit.adoption.adopt_lines import AdoptionReport, LineReport
from assoc_hull.errors import BadInputError
from assoc_hull.plot.lines_plan.drawing import Drawable, Drawing, PlotLine, drawing
from assoc_hull.plot.lines_plan.three_views import body_halves, scale_of_body
from assoc_hull.plot.sheet.labels import overlaps
from assoc_hull.plot.sheet.paper import (
    FAMILY_COLOURS,
    GRID,
    LINE,
    MARGIN,
    TINT,
    PaperName,
    Pen,
    View,
    scale_of,
)
from assoc_hull.plot.sheet.sheet_figure import Path_, Sheet, save
from assoc_hull.plot.sheet.title_block import BLOCK, caption, frame, title_block

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["adoption_deviations"]

_LIST = 128.0  # width of the list of lines, mm at A3; so are the other lengths
_NAME, _TAIL = 27.0, 15.0  # of it, for names and inflections
_HEAD, _BELOW = 17.0, 14.0  # above the list, and below each view
_PITCH = (2.2, 4.4)  # least and greatest distance of two rows
_NAMED = 12
"""So many of the worst places are named in the views."""

_SPAN = Pen(0.5, "0.75", over=1.5)
_LIMIT = Pen(0.25, "black", over=2.2)
_COURSE = Pen(0.07, "0.6", over=1.5)


def adoption_deviations(
    hull: Drawable,
    report: AdoptionReport | None = None,
    path: Path_ | None = None,
    *,
    paper: PaperName = "A3",
    title: str | None = None,
) -> Figure:
    """Draw how far each adopted curve passes the line it was made of, and where.

    On the left each curve has a row: median and largest deviation (dots) and p95 (a bar from
    the median), the tolerance at the farthest place (an upright stroke), and its inflections
    before and after. On the right the largest deviations stand in the views of the hull.

    Parameters
    ----------
    hull : Hull, HullState or Drawing
        The hull, as it was adopted.
    report : AdoptionReport, optional
        Of its adoption; by default ``hull.adoption``.
    path : path, optional
        Where to write it; the ending says whether PDF, SVG or PNG.
    paper : "A3", "A1" or "A4"
        Size of the sheet, landscape; what has no room in the list is left out, and counted.
    title : str, optional
        Instead of the name of the ship.

    Returns
    -------
    matplotlib.figure.Figure
        The picture.

    Raises
    ------
    BadInputError
        No report, an unknown paper or ending.
    MissingExtraError
        Matplotlib is not installed.

    Examples
    --------
    >>> from assoc_hull.shipped.series60 import series60_adopted
    >>> from assoc_hull.plot.lines_plan.adoption_deviations import adoption_deviations
    >>> figure = adoption_deviations(*series60_adopted(0.70))
    """
    made = report or getattr(hull, "adoption", None)
    if made is None or not made.lines:
        raise BadInputError(
            "there is no report of an adoption", "for this picture",
            "give report=, or a hull that was read from lines",
        )  # fmt: skip
    plan = drawing(hull)
    sheet = Sheet(paper)
    margin = MARGIN * sheet.paper.factor
    frame(sheet, margin)
    _rows(sheet, made.lines)
    _words(sheet, plan, made, title)
    _views(sheet, plan, made.lines)
    if path is not None:
        save(sheet.figure, path)
    return sheet.figure


def _words(sheet: Sheet, plan: Drawing, made: AdoptionReport, title: str | None) -> None:
    """Write the totals."""
    given, more = made.inflections
    worst, points = made.worst, sum(each.defining for each in made.lines)
    rows = [
        ("Curves", f"{len(made.lines)}"),
        ("Defining points, adopted among them", f"{points}, {made.own_points}"),
        ("Inflections of the given lines, excess of the net", f"{given}, {more}"),
        ("Largest deviation", f"{1e3 * worst.deviation:.2f} mm, {worst.line}"),
        ("at", "({:.2f}, {:.2f}, {:.2f}) m".format(*worst.place)),
    ]
    notes = [
        "Deviation: of points of the given line from the adopted curve. Dots: median and",
        "largest, red over the tolerance; bar: to p95; stroke: tolerance at the largest.",
        f"In the views: the largest of each curve, mm; the {_NAMED} worst are named.",
    ]
    margin = MARGIN * sheet.paper.factor
    corner = (sheet.paper.width - margin, sheet.paper.height - margin)
    name = title or plan.particulars.name
    title_block(sheet, corner, BLOCK * sheet.paper.factor, name, rows, notes)


def _rows(sheet: Sheet, lines: Sequence[LineReport]) -> None:
    """Draw a row per curve over a logarithmic scale of millimetres."""
    factor, margin = sheet.paper.factor, MARGIN * sheet.paper.factor
    left = margin + _NAME * factor
    wide = (_LIST - _NAME - _TAIL) * factor
    top = sheet.paper.height - margin - _HEAD * factor
    room = top - margin - 4.0 * factor
    shown = lines
    most = int(room / (_PITCH[0] * factor))
    if len(lines) > most:
        shown = sorted(lines, key=lambda each: -each.deviation)[:most]
        shown = [each for each in lines if each in shown]
    pitch = min(_PITCH[1] * factor, room / len(shown))
    first, last = _decades(shown)
    _scale(sheet, (left, top + 1.5 * factor), (wide, pitch * len(shown)), first, last)
    head = "deviation of each curve, mm"
    head += "" if shown is lines else f" (the {len(shown)} worst of {len(lines)})"
    place = (left + 0.5 * wide, top + 8.5 * factor)
    sheet.take(sheet.text(place, head, size=1.1, bold=True, name="label/head"))
    side = (left + wide + 0.5 * _TAIL * factor, top + 6.0 * factor)
    sheet.take(sheet.text(side, "inflections\nbefore > after", size=0.9, name="label/inflections"))
    for i, line in enumerate(shown):
        y = top - (i + 0.5) * pitch
        at = [
            left + wide * (np.log10(max(1e3 * value, 10.0**first)) - first) / (last - first)
            for value in (line.deviation_median, line.deviation_p95, line.deviation, line.tolerance)
        ]
        _row(sheet, line, y, [min(each, left + wide) for each in at], (left, left + wide))


_LEAST_DECADE = 0
"""The scale reaches 1 mm at least: what is below a thousandth of that is the last bit."""


def _decades(lines: Sequence[LineReport]) -> tuple[int, int]:
    """Give the powers of ten (mm) between which deviations and tolerances are drawn."""
    most = max(max(each.deviation, 1e-9) for each in lines)
    last = max(int(np.ceil(np.log10(1e3 * most) + 1e-9)), _LEAST_DECADE)
    return last - 4, last


def _scale(
    sheet: Sheet, corner: tuple[float, float], size: tuple[float, float], first: int, last: int
) -> None:
    (left, top), (wide, tall) = corner, size
    for power in range(first, last + 1):
        x = left + wide * (power - first) / (last - first)
        sheet.rule((x, top), (x, top - tall - 2.0 * sheet.paper.factor), GRID, "scale")
        sheet.take(sheet.text((x, top), f"{10.0**power:g}", up="bottom", name="label/scale"))


def _row(
    sheet: Sheet, line: LineReport, y: float, at: Sequence[float], ends: tuple[float, float]
) -> None:
    factor = sheet.paper.factor
    colour = FAMILY_COLOURS.get(line.group, "#444444")
    median, p95, most, allowed = at
    sheet.text((ends[0] - 1.0 * factor, y), line.line, size=0.9, across="right", name="label/row")
    sheet.rule((median, y), (p95, y), Pen(0.6, colour, over=1.8), f"p95/{line.curve}")
    sheet.rule((p95, y), (most, y), _SPAN, f"span/{line.curve}")
    sheet.dots(np.array([[median, y]]), colour, 0.9, f"median/{line.curve}")
    over = line.deviation > line.tolerance
    sheet.dots(np.array([[most, y]]), TINT if over else colour, 1.3, f"max/{line.curve}")
    sheet.rule((allowed, y - 0.8 * factor), (allowed, y + 0.8 * factor), _LIMIT, "allowed")
    more = line.inflections > line.inflections_given
    if line.inflections or line.inflections_given:
        words = f"{line.inflections_given} > {line.inflections}"
        place = (ends[1] + 0.5 * _TAIL * factor, y)
        sheet.text(place, words, size=0.9, colour=TINT if more else "black", name="label/bends")


def _views(sheet: Sheet, plan: Drawing, lines: Sequence[LineReport]) -> None:
    """Draw half-breadth plan, profile and, beside the block, body plan with the deviations."""
    factor = sheet.paper.factor
    low, high = plan.bounds
    size, left = high - low, (MARGIN + _LIST + 6.0) * factor
    wide = sheet.paper.width - (MARGIN + 6.0) * factor - left
    scale = scale_of(float(size[0]), wide)
    unit = 1e3 / scale
    x = left + 0.5 * (wide - unit * float(size[0])) - unit * float(low[0])
    base = (MARGIN + _BELOW) * factor
    half = View("half-breadth", (0, 1), scale, (x, base))
    base += unit * float(high[1]) + _BELOW * factor
    profile = View("profile", (0, 2), scale, (x, base - unit * float(low[2])))
    base += unit * float(size[2]) + _BELOW * factor
    room = (wide - (BLOCK + 6.0) * factor, sheet.paper.height - (MARGIN + 6.0) * factor - base)
    body = min(scale, scale_of_body(float(high[1]), float(size[2]), room))
    up = base - float(low[2]) * 1e3 / body
    both = View("body", (1, 2), body, (left + 0.5 * room[0], up))
    middle = 0.5 * plan.particulars.length
    most = max(max(each.deviation for each in lines), 1e-12)
    for view, family in ((half, "waterlines"), (profile, "buttocks")):
        _courses(sheet, view, [*plan.of("boundary"), *plan.of(family)])
        place = (view.across(middle), view.up(low[2] if view is profile else 0.0) - 2.0 * factor)
        caption(sheet, place, f"{view.name.upper()}  1:{scale:g}")
        _spots(sheet, view, lines, most)
    words = f"BODY PLAN  1:{body:g}"
    caption(sheet, (both.across(0.0), both.up(float(low[2])) - 2.0 * factor), words)
    halves = (both.mirrored(), both)
    for i, (view, sections) in enumerate(zip(halves, body_halves(plan.of("sections"), middle),
                                             strict=True)):  # fmt: skip
        _courses(sheet, view, sections)
        mine = [each for each in lines if (each.place[0] < middle) == (i == 0)]
        _spots(sheet, view, mine, most)


def _courses(sheet: Sheet, view: View, lines: Sequence[PlotLine]) -> None:
    for line in lines:
        pen = LINE if line.boundary is not None else _COURSE
        for points in line.polylines:
            sheet.line(view.on_paper(points), pen, f"{view.name}/{line.name}")


_SEEN = 1e-7
"""What lies within this (m) of its line has no name beside its dot."""


def _spots(sheet: Sheet, view: View, lines: Sequence[LineReport], most: float) -> None:
    """Draw the largest deviation of each curve as a dot, as large as its root; name the worst."""
    factor = sheet.paper.factor
    order = sorted(lines, key=lambda each: -each.deviation)
    for each in order:
        spot = view.on_paper(np.array([each.place]))
        wide = max(0.4, 2.4 * float(np.sqrt(each.deviation / most)))
        sheet.dots(spot, FAMILY_COLOURS.get(each.group, "#444444"), wide, f"spot/{each.curve}")
    for each in [line for line in order if line.deviation > _SEEN][:_NAMED]:
        x, y = view.on_paper(np.array([each.place]))[0].tolist()
        words = f"{each.line} {1e3 * each.deviation:.3g}"
        for off in (2.0, -2.0, 4.0, -4.0, 6.0, -6.0):
            text = sheet.text(
                (x, y + off * factor), words, size=0.8, halo=True, name=f"label/{view.name}"
            )
            if not overlaps(sheet.box(text), sheet.taken):
                sheet.take(text)
                break
            text.remove()
