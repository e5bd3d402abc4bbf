"""The lines plan of an edit that is open: the lines that it has reached are tinted."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from assoc_hull.edit.dirty_objects import Dirty
from assoc_hull.model.tables import HasState
from assoc_hull.plot.lines_plan.drawing import drawing, tables_of
from assoc_hull.plot.lines_plan.plan import captions, plan_block
from assoc_hull.plot.lines_plan.three_views import Views, lay_out_views
from assoc_hull.plot.lines_plan.zoom_window import zoomed
from assoc_hull.plot.sheet.paper import MARGIN, TINT, PaperName
from assoc_hull.plot.sheet.sheet_figure import Path_, Sheet, save
from assoc_hull.plot.sheet.title_block import frame

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["dirty_plan"]

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
