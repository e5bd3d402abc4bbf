"""The body plan before and after an edit, with the lines that moved tinted."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np

from assoc_hull.plot.lines_plan.drawing import Drawing, DrawnLine, Sketchable, drawing
from assoc_hull.plot.lines_plan.layout import BLOCK, place_body
from assoc_hull.plot.lines_plan.movement import LEAST, LineMovement, moved_parts, movements, same
from assoc_hull.plot.lines_plan.views import Views, body_halves
from assoc_hull.plot.sheet.paper import MARGIN, PaperName, Pen
from assoc_hull.plot.sheet.pens import BEFORE, TINT
from assoc_hull.plot.sheet.sheet import Path_, Sheet, save
from assoc_hull.plot.sheet.title_block import caption, frame, title_block
from assoc_hull.plot.sheet.view import View, scale_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["before_after", "overlay", "pairs_of", "snapshot"]

_SIDE = 38.0  # mm at A3, for the words at the arrow
_ABOVE, _BELOW = 16.0, 20.0
_TOLD = 12
"""At most so many movements are listed."""

_AFTER = Pen(0.22, TINT, over=3.0)
_ARROW = Pen(0.2, TINT, over=4.0)

Pair = tuple[DrawnLine | None, DrawnLine | None]


def snapshot(hull: Sketchable) -> Drawing:
    """Keep the lines of a hull as they are now, for `before_after`."""
    return drawing(hull)


def before_after(
    before: Sketchable,
    after: Sketchable,
    path: Path_ | None = None,
    *,
    paper: PaperName = "A3",
    title: str | None = None,
    half_breadth: bool = False,
) -> Figure:
    """Draw the body plan before and after an edit.

    Lines are tinted where they moved, over what they were, in grey. The largest movement is
    named where it is. It is that along the hull's normal: neither a point that slides along
    the hull counts, nor that a small change moves a line of a grazing plane far.

    Parameters
    ----------
    before, after : Hull, HullState or Drawing
        A hull before (see `snapshot`) and after.
    path : path, optional
        Where to write it; the ending says whether PDF, SVG or PNG.
    paper : "A3", "A1" or "A4"
        Size of the sheet, landscape.
    title : str, optional
        Instead of the name of the ship.
    half_breadth : bool
        Whether to draw the half-breadth plan below.

    Returns
    -------
    matplotlib.figure.Figure
        The picture.

    Raises
    ------
    MissingExtraError
        Matplotlib is not installed.
    BadInputError
        An unknown paper or ending.

    Examples
    --------
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.plot import before_after, snapshot
    >>> hull = wigley()
    >>> figure = before_after(snapshot(hull), hull)
    """
    old, new = drawing(before), drawing(after)
    moved = movements(old, new)
    sheet = Sheet(paper)
    frame(sheet, MARGIN * sheet.paper.factor)
    _block(sheet, title or new.particulars.name, old, new, moved)
    low, high = (np.stack([old.bounds, new.bounds])).transpose(1, 0, 2)
    views = Views(sheet, new, np.minimum(low.min(axis=0), 0.0), high.max(axis=0))
    base = _half(views, old) if half_breadth else MARGIN * sheet.paper.factor
    _body(views, old, base, moved)
    if path is not None:
        save(sheet.figure, path)
    return sheet.figure


def _block(
    sheet: Sheet, title: str, old: Drawing, new: Drawing, moved: Sequence[LineMovement]
) -> None:
    """Write what moved, the farthest first."""
    factor = sheet.paper.factor
    corner = (sheet.paper.width - MARGIN * factor, sheet.paper.height - MARGIN * factor)
    rows = [(each.line, _amount(each)) for each in moved[:_TOLD]]
    if len(moved) > _TOLD:
        rows.append((f"and {len(moved) - _TOLD} more", ""))
    gone = sorted({line.name for line in old.lines} - {line.name for line in new.lines})
    notes = [
        f"{len(moved)} of {len(new.lines)} lines moved, by these amounts along the hull's normal.",
        f"Red: where by more than {1e3 * LEAST:g} mm. Grey: before.",
    ]
    notes += [f"Removed: {', '.join(gone[:4])}{' ...' if len(gone) > 4 else ''}"] if gone else []
    title_block(sheet, corner, BLOCK * factor, title, rows, notes)


def _amount(moved: LineMovement) -> str:
    return "new" if np.isnan(moved.distance) else f"{1e3 * moved.distance:.1f} mm"


def _half(views: Views, old: Drawing) -> float:
    """Draw the half-breadth plan at the foot of the sheet; give the height it ends at, mm."""
    paper, (low, high) = views.sheet.paper, (views.low, views.high)
    factor = paper.factor
    length = float(high[0] - low[0])
    scale = scale_of(length, paper.width - 2.0 * (MARGIN + 17.0) * factor)
    x = 0.5 * (paper.width - 1e3 / scale * length) - 1e3 / scale * float(low[0])
    view = View("half-breadth", (0, 1), scale, (x, (MARGIN + 20.0) * factor))
    views.half_breadth(view)
    overlay(views.sheet, view, pairs_of(old.of("waterlines"), views.drawing.of("waterlines")))
    words = f"HALF-BREADTH PLAN  1:{scale:g}"
    caption(views.sheet, (view.across(views.middle), view.up(0.0) - 11.0 * factor), words)
    return view.up(float(high[1])) + 12.0 * factor


def pairs_of(old: Sequence[DrawnLine], new: Sequence[DrawnLine]) -> Iterator[Pair]:
    """Give lines before and after by name, each once; None where there is none."""
    was, now = ({line.name: line for line in lines} for lines in (old, new))
    yield from ((was.get(name), now.get(name)) for name in dict.fromkeys((*was, *now)))


def overlay(sheet: Sheet, view: View, pairs: Iterable[Pair], pen: Pen = BEFORE) -> None:
    """Draw lines as they were, in grey or another pen, and in red where they moved."""
    for was, now in pairs:
        if was is not None and now is not None and same(was, now):
            continue
        if was is not None:
            for points in was.polylines:
                sheet.line(view.on_paper(points), pen, f"{view.name}/before/{was.name}")
        if now is not None:
            for part in moved_parts(was, now):
                sheet.line(view.on_paper(part), _AFTER, f"{view.name}/moved/{now.name}")


def _body(views: Views, old: Drawing, base: float, moved: Sequence[LineMovement]) -> None:
    paper, (low, high) = views.sheet.paper, (views.low, views.high)
    factor = paper.factor
    width = paper.width - (2.0 * MARGIN + BLOCK + 2.0 * _SIDE) * factor
    room = paper.height - MARGIN * factor - base - (_ABOVE + _BELOW) * factor
    height = float(high[2] - low[2])
    scale = place_body(float(high[1]), height, (width, room))
    spare = room - height * 1e3 / scale
    up = base + _BELOW * factor + 0.5 * spare - float(low[2]) * 1e3 / scale
    view = View("body", (1, 2), scale, (0.5 * (paper.width - BLOCK * factor), up))
    views.body(view)
    sections = Views(views.sheet, old, low, high).sections
    halves = (body_halves(lines, views.middle) for lines in (sections, views.sections))
    for half, was, now in zip((view.mirrored(), view), *halves, strict=True):
        overlay(views.sheet, half, pairs_of(was, now))
    foot = view.up(float(low[2])) - 9.0 * factor
    caption(views.sheet, (view.across(0.0), foot), f"BODY PLAN  1:{scale:g}")
    if moved and not np.isnan((largest := moved[0]).distance):
        _arrow(views, view, largest)


def _arrow(views: Views, view: View, largest: LineMovement) -> None:
    """Name the largest movement beside the body plan, with an arrow to its place."""
    sheet, factor = views.sheet, views.sheet.paper.factor
    aft = largest.place[0] < views.middle
    half = view.mirrored() if aft else view
    tip = half.on_paper(np.array([largest.place]))[0]
    edge = half.across(float(views.high[1])) + half.sign * 19.0 * factor
    x, y, z = largest.place
    amount = f"{1e3 * largest.distance:.1f} mm"
    # One coordinate a line: the words stand between the view and the frame of the sheet.
    words = f"{amount}\n{largest.line}\nx {x:.3f} m\ny {y:.3f} m\nz {z:.3f} m"
    middle = 0.5 * float(views.low[2] + views.high[2])
    level = float(tip[1]) + (7.0 if z < middle else -7.0) * factor
    text = sheet.text(
        (edge, level), words, across="right" if aft else "left", colour=TINT, name="label/largest"
    )
    sheet.take(text)
    start = (edge - half.sign * 1.0 * factor, level)
    sheet.arrow(start, (float(tip[0]), float(tip[1])), _ARROW, "arrow/largest")
