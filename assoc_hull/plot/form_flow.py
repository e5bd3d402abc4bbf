"""Cells that flow in two columns down upright pages, below headings."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Protocol

import attrs

from assoc_hull.plot.paper import Paper, Pen
from assoc_hull.plot.sheet import Sheet

__all__ = ["COLUMN", "LEFT", "PAGE", "RIGHT", "Cell", "Flow", "wrapped"]

PAGE = Paper("A4 upright", 210.0, 297.0, 6.6, 200)
LEFT, RIGHT = 16.0, 198.0
"""Of what is printed, mm; there is more room at the left, where pages are bound."""

_TOP, _LOW = 284.0, 22.0
_GAP = 6.0
COLUMN = 0.5 * (RIGHT - LEFT - _GAP)
"""Width of a column, mm."""

_HEADING = 6.4
_LEAST = 3  # rows that may stand alone below a heading
_HAIR = Pen(0.05, "0.72", over=1.0)
_BAR = "0.9"


class Cell(Protocol):
    """What stands in a column: so tall, mm, and able to draw itself below a place."""

    @property
    def tall(self) -> float:
        """Height, mm."""
        ...

    def draw(self, sheet: Sheet, x: float, top: float) -> None:
        """Draw with the left upper corner at a place, mm."""
        ...


@attrs.define
class Flow:
    """Pages that fill from the top.

    Attributes
    ----------
    begin : callable
        Draws what stands at the top of a new page; gives where it ends, mm.
    pages : list of Sheet
        So far.
    y : float, mm
        Where the next thing stands on the last page.
    """

    begin: Callable[[Sheet, bool], float]
    pages: list[Sheet] = attrs.field(factory=list)
    y: float = 0.0

    @property
    def sheet(self) -> Sheet:
        """The last page."""
        return self.pages[-1]

    def turn(self) -> None:
        """Begin a page."""
        self.pages.append(Sheet(PAGE))
        self.y = self.begin(self.sheet, len(self.pages) == 1)

    def part(self, title: str, cells: Sequence[Cell], *, ruled: bool = True) -> None:
        """Draw a heading and cells in two columns, on as many pages as they need."""
        rest, words = list(cells), title
        while rest:
            count = self._count(rest)
            if count < min(2 * _LEAST, len(rest)):
                self.turn()
                count = max(self._count(rest), 1)
            self._heading(words)
            self._columns(rest[:count], ruled)
            rest, words = rest[count:], f"{title} (continued)"
        self.y -= 0.4 * _HEADING

    def _count(self, cells: Sequence[Cell]) -> int:
        """Give how many of the cells have room on this page, below a heading."""
        room = self.y - _LOW - _HEADING
        return next((n for n in range(len(cells), 0, -1) if sum(_talls(cells[:n])) <= room), 0)

    def _heading(self, title: str) -> None:
        low = self.y - _HEADING + 1.4
        self.sheet.axes.fill(
            [LEFT, RIGHT, RIGHT, LEFT], [low, low, self.y, self.y], color=_BAR, linewidth=0.0,
            zorder=0.5,
        )  # fmt: skip
        place = (LEFT + 1.5, 0.5 * (low + self.y))
        self.sheet.text(place, title, size=1.1, across="left", bold=True, name="label/heading")
        self.y -= _HEADING

    def _columns(self, cells: Sequence[Cell], ruled: bool) -> None:
        middle = (len(cells) + 1) // 2
        top = self.y
        for k, tall in enumerate(_talls(cells)):
            cells[k].draw(self.sheet, LEFT, self.y)
            if middle + k < len(cells):
                cells[middle + k].draw(self.sheet, LEFT + COLUMN + _GAP, self.y)
            self.y -= tall
            if ruled:
                self.sheet.rule((LEFT, self.y), (RIGHT, self.y), _HAIR, "row")
        if ruled:
            x = 0.5 * (LEFT + RIGHT)
            self.sheet.rule((x, top), (x, self.y), _HAIR, "between")


def _talls(cells: Sequence[Cell]) -> list[float]:
    """Give the heights of lines of two cells."""
    middle = (len(cells) + 1) // 2
    right = [each.tall for each in cells[middle:]] + [0.0]
    return [max(each.tall, right[min(k, len(right) - 1)]) for k, each in enumerate(cells[:middle])]


def wrapped(sheet: Sheet, words: str, room: float, size: float) -> list[str]:
    """Part words into lines that are no wider than the room, mm; a long word may be."""
    lines = [""]
    for word in words.split():
        longer = f"{lines[-1]} {word}".strip()
        if lines[-1] and sheet.width(longer, size=size) > room:
            lines.append(word)
        else:
            lines[-1] = longer
    return lines
