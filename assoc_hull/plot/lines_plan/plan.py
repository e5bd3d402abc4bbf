"""The lines plan on one sheet, bow to the right; and that of an edit that is open.

The lines plan of an edit that is open: the lines that it has reached are tinted.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from typing import TYPE_CHECKING

import attrs
import numpy as np

from assoc_hull.edit.dirty_objects import Dirty
from assoc_hull.model.tables import HasState
from assoc_hull.plot.lines_plan.batten_heat import HeatName, batten_heat
from assoc_hull.plot.lines_plan.drawing import (
    Drawable,
    Drawing,
    drawing,
    particulars_of,
    tables_of,
    zoomed,
)
from assoc_hull.plot.lines_plan.three_views import (
    ViewLayout,
    Views,
    body_sides,
    lay_out_views,
)
from assoc_hull.plot.sheet.paper import MARGIN, TINT, PaperName, View
from assoc_hull.plot.sheet.sheet_figure import Path_, Sheet, save
from assoc_hull.plot.sheet.title_block import (
    BLOCK,
    caption,
    frame,
    scale_bar,
    title_block,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["captions", "dirty_plan", "lines_plan", "plan_block", "window_rows"]


def lines_plan(
    hull: Drawable,
    path: Path_ | None = None,
    *,
    paper: PaperName = "A3",
    title: str | None = None,
    highlight: Collection[str] | None = None,
    heat: HeatName | None = None,
    x: tuple[float, float] | None = None,
) -> Figure:
    """Draw the three-view lines plan.

    The profile with the buttocks lies above the half-breadth plan with the waterlines, both
    on one scale and aligned, bow to the right. The body plan has a scale of its own, aft
    body on the left, fore body on the right; the section at half length is on both.

    Parameters
    ----------
    hull : Hull, HullState or Drawing
        The hull.
    path : path, optional
        Where to write it; the ending says whether PDF, SVG or PNG.
    paper : "A3", "A1" or "A4"
        Size of the sheet, landscape.
    title : str, optional
        Instead of the name of the ship.
    highlight : collection of str, optional
        Names of lines to be tinted.
    heat : "residual" or "ratio", optional
        Colour lines by how far a batten springs off each point, mm; or by how far from those of
        the lines beside, over what is usual there, of which more than 3 is unfair.
    x : (float, float), m, optional
        Draw only what lies between these stations, larger.

    Returns
    -------
    matplotlib.figure.Figure
        The picture; every line has an id ``view/family/name``.

    Raises
    ------
    MissingExtraError
        Matplotlib is not installed.
    UnknownNameError
        A line to be tinted does not exist.
    BadInputError
        An unknown paper or ending; no line between the stations; heat of a snapshot.

    Examples
    --------
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.plot.lines_plan.plan import lines_plan
    >>> figure = lines_plan(wigley(), highlight=["WL 2.5"])
    """
    whole = drawing(hull)
    plan = zoomed(whole, x)
    tinted = [whole.line(name).name for name in highlight or ()]
    colours = None if heat is None else batten_heat(hull, heat)
    sheet = Sheet(paper)
    layout = lay_out_views(plan, sheet.paper)
    frame(sheet, MARGIN * sheet.paper.factor)
    below = plan_block(sheet, whole, layout, title or plan.particulars.name, plan.window)
    captions(sheet, plan, layout)
    views = Views(sheet, plan, layout.low, layout.high, tinted)
    views.profile(layout.profile)
    views.half_breadth(layout.half)
    views.body(layout.body)
    if colours is not None:
        views.heat(layout, colours)
        colours.legend(sheet, below)
    if path is not None:
        save(sheet.figure, path)
    return sheet.figure


def plan_block(
    sheet: Sheet, plan: Drawing, layout: ViewLayout, title: str,
    window: tuple[float, float] | None, more: Sequence[tuple[str, str]] = (),
) -> tuple[float, float]:  # fmt: skip
    """Write the particulars, `more` rows, the scales below; give the place below these, mm."""
    factor = sheet.paper.factor
    width = BLOCK * factor
    profile, body = layout.profile, layout.body
    scales = f"1:{profile.denominator:g}, body plan 1:{body.denominator:g}, {sheet.paper.name}"
    notes = (
        "Moulded lines, m; x forward from AP, z upward from the base line.",
        "Aft body left, fore body right. Dash-dotted: borders of the flats.",
    )
    rows = [*particulars_of(plan), ("Scale", scales), *window_rows(window), *more]
    lower = title_block(sheet, layout.corner, width, title, rows, notes)
    x = layout.corner[0] - width + 4.0 * factor
    bars = ((profile, "Profile, half-breadth plan"), (body, "Body plan"))
    for i, (view, name) in enumerate(bars):
        words = f"{name}  1:{view.denominator:g}"
        place = (x, lower - (9.0 + 12.0 * i) * factor)
        scale_bar(sheet, view, place, width - 14.0 * factor, words)
    return x, lower - 31.0 * factor


def window_rows(window: tuple[float, float] | None) -> list[tuple[str, str]]:
    """Give the row of a block that tells what stretch is drawn; none of a whole hull."""
    return [] if window is None else [("Drawn, x from and to", f"{window[0]:g}, {window[1]:g} m")]


def captions(
    sheet: Sheet, plan: Drawing, layout: ViewLayout, more: Callable[[View], str] = lambda _: ""
) -> None:
    """Write the names of the views below them, and what else there is to say of each."""
    factor = sheet.paper.factor
    middle, low = plan.middle, layout.low[2]
    body, sides = layout.body, body_sides(plan)
    across = 0.5 * float(layout.high[1]) * sum(sides)
    rows = (
        (layout.profile, middle, low, 11.0, "PROFILE"),
        (layout.half, middle, -layout.depth, 11.0, "HALF-BREADTH PLAN"),
        (body, across, low, 9.0, "BODY PLAN"),
    )
    for view, along, up, drop, words in rows:
        place = (view.across(along), view.up(up) - drop * factor)
        caption(sheet, place, words + more(view))
    if more(body) or len(sides) == 1:
        return  # the words take the room
    for sign, words in zip(sides, ("AFT BODY", "FORE BODY"), strict=True):
        half = attrs.evolve(body, sign=sign)
        place = (half.across(0.5 * layout.high[1]), body.up(low) - 9.0 * factor)
        caption(sheet, place, words)


_DOT = 0.7
"""Diameter of a dirty point, mm at A3."""

_WORDS = 44
"""Letters of a row of the block."""


def dirty_plan(
    hull: HasState,
    path: Path_ | None = None,
    *,
    paper: PaperName = "A3",
    title: str | None = None,
    x: tuple[float, float] | None = None,
) -> Figure:
    """Draw the lines as they are published, those that are dirty here tinted.

    Parameters
    ----------
    hull : Hull
        The hull, in an edit that is open.
    path, paper, title, x
        As for `lines_plan`. Dirty points are dots in the body plan.

    Returns
    -------
    matplotlib.figure.Figure
        The picture; lines have the ids that `lines_plan` gives them.

    Raises
    ------
    BadInputError
        No line lies between the stations.
    """
    state = tables_of(hull)
    live = state.live_tables
    dirty = Dirty(live, live.dirty_here())
    whole = drawing(hull)
    plan = zoomed(whole, x)
    sheet = Sheet(paper)
    layout = lay_out_views(plan, sheet.paper)
    frame(sheet, MARGIN * sheet.paper.factor)
    asked = ", ".join(dirty.asked) or "nothing"
    short = asked if len(asked) <= _WORDS else f"{asked[: _WORDS - 3]}..."
    lines = {each.line.name for each in dirty.curves if each.line.alive}
    count = f"{len(lines)} lines, {len(dirty.points)} points"
    rows = [("Dirty because of", short), ("Dirty", count)]
    plan_block(sheet, whole, layout, title or plan.particulars.name, plan.window, rows)
    captions(sheet, plan, layout)
    views = Views(sheet, plan, layout.low, layout.high, lines)
    views.profile(layout.profile)
    views.half_breadth(layout.half)
    views.body(layout.body)
    places = np.array([each.position for each in dirty.points]).reshape(-1, 3)
    aft = places[:, 0] < views.middle
    for view, mine in ((layout.body.mirrored(), aft), (layout.body, ~aft)):
        seen = mine & np.array([plan.shows(at) for at in places[:, 0].tolist()], np.bool_)
        sheet.dots(view.on_paper(places[seen]), TINT, _DOT, "dirty points")
    if path is not None:
        save(sheet.figure, path)
    return sheet.figure
