"""Frame, title block with the principal particulars, captions and scale bars."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Literal

import numpy as np

from assoc_hull.plot.sheet.paper import FRAME, LINE, View
from assoc_hull.plot.sheet.sheet_figure import Sheet

if TYPE_CHECKING:
    from matplotlib.text import Text

__all__ = [
    "BLOCK",
    "ROW",
    "block_height",
    "caption",
    "frame",
    "scale_bar",
    "title_block",
]

BLOCK = 92.0
"""Width of the block of particulars, mm at A3; so are the other lengths."""


ROW = 4.4
"""Height of a row of a block, mm at A3."""

_BARS = (0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0)


def frame(sheet: Sheet, margin: float) -> None:
    """Draw the frame of a sheet, `margin` (mm) inside its edge."""
    left, low = margin, margin
    right, high = sheet.paper.width - margin, sheet.paper.height - margin
    corners = [(left, low), (right, low), (right, high), (left, high), (left, low)]
    sheet.line(np.array(corners), FRAME, "frame")


def caption(sheet: Sheet, place: tuple[float, float], words: str) -> None:
    """Write the name of a view."""
    sheet.take(
        sheet.text(place, words, size=1.3, bold=True, up="top", name=f"label/caption/{words}")
    )


def block_height(rows: int, notes: int) -> float:
    """Give the height of a block of so many rows and notes, mm at A3."""
    return 12.5 + ROW * (rows + 1.2 + 0.9 * notes)


def title_block(
    sheet: Sheet,
    corner: tuple[float, float],
    width: float,
    title: str,
    rows: Sequence[tuple[str, str]],
    notes: Sequence[str],
) -> float:
    """Draw the block with its right upper corner at a place; give its lower edge, mm."""
    factor = sheet.paper.factor
    right, top = corner
    left, inset, row = right - width, right - width + 3.0 * factor, ROW * factor
    y = top - 8.5 * factor
    sheet.take(
        sheet.text(
            (inset, y), title, size=2.2, bold=True, across="left", up="baseline", name="label/title"
        )
    )
    y -= 4.0 * factor
    sheet.rule((left, y), (right, y), LINE, "block")
    for name, value in rows:
        y -= row
        sheet.take(_words(sheet, (inset, y), name, "left"))
        if value:
            sheet.take(_words(sheet, (right - 3.0 * factor, y), value, "right"))
    y -= 0.6 * row
    sheet.rule((left, y), (right, y), LINE, "block")
    for words in notes:
        y -= 0.9 * row
        sheet.take(
            sheet.text((inset, y), words, across="left", up="baseline", name=f"label/note/{words}")
        )
    y -= 0.6 * row
    edge = np.array([(right, top), (left, top), (left, y), (right, y)])
    sheet.line(edge, FRAME, "block")
    return y


def _words(
    sheet: Sheet, place: tuple[float, float], words: str, across: Literal["left", "right"]
) -> Text:
    return sheet.text(
        place, words, size=1.15, across=across, up="baseline", name=f"label/block/{words}"
    )


def scale_bar(
    sheet: Sheet, view: View, place: tuple[float, float], width: float, words: str
) -> None:
    """Draw a scale bar of at most `width` (mm), with the words to its left upper side."""
    factor = sheet.paper.factor
    step = max(bar for bar in _BARS if 5.0 * bar * view.unit <= width or bar == _BARS[0])
    x, y = place
    tall = 1.1 * factor
    for i in range(5):
        a, b = (x + view.unit * step * k for k in (i, i + 1))
        box = np.array([(a, y), (b, y), (b, y + tall), (a, y + tall), (a, y)])
        sheet.line(box, LINE, "scale bar")
        if i % 2 == 0:
            sheet.axes.fill(box[:, 0], box[:, 1], color="black", linewidth=0.0, zorder=2.0)
    for i in range(6):
        name = f"{step * i:g}" + (" m" if i == 5 else "")
        text = sheet.text(
            (x + view.unit * step * i, y - 0.4 * factor), name, up="top", name="label/bar"
        )
        sheet.take(text)
    above = (x, y + tall + 0.6 * factor)
    sheet.take(sheet.text(above, words, across="left", up="bottom", name=f"label/bar/{words}"))
