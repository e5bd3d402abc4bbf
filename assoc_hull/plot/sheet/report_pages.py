"""Upright pages of a report: cells that flow in columns below headings, a head and a foot.

A `PageFlow` fills pages from the top and begins a new one where the rest has no room; a heading
is never left alone. What stands in a column knows its height (mm) and draws itself.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Literal, Protocol

import attrs

from assoc_hull.plot.sheet.paper import FRAME, LINE, Paper, Pen
from assoc_hull.plot.sheet.sheet_figure import Sheet

__all__ = [
    "COLUMN",
    "GREY",
    "LEFT",
    "PAGE",
    "RIGHT",
    "PageCell",
    "PageFlow",
    "page_foot",
    "page_head",
]

# --------------------------------------------------------------------------------------
# Cells that flow in one or two columns down upright pages, below headings.

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


class PageCell(Protocol):
    """What stands in a column: so tall, mm, and able to draw itself below a place."""

    @property
    def tall(self) -> float:
        """Height, mm."""
        ...

    def draw(self, sheet: Sheet, x: float, top: float) -> None:
        """Draw with the left upper corner at a place, mm."""
        ...


@attrs.define
class PageFlow:
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

    def part(
        self,
        title: str,
        cells: Sequence[PageCell],
        *,
        ruled: bool = True,
        columns: Literal[1, 2] = 2,
        head: PageCell | None = None,
    ) -> None:
        """Draw a heading and cells below it, on as many pages as they need.

        Parameters
        ----------
        title : str
            The heading; it is said again where a page begins.
        cells : sequence of Cell
            What stands below it.
        ruled : bool
            Whether a hairline parts the rows.
        columns : 1 or 2
            In how many columns cells stand.
        head : Cell or None
            Stands below the heading on every page.
        """
        rest, words = list(cells), title
        top = 0.0 if head is None else head.tall
        while rest:
            count = self._count(rest, columns, top)
            if count < min(columns * _LEAST, len(rest)):
                self.turn()
                count = max(self._count(rest, columns, top), 1)
            self._heading(words)
            if head is not None:
                self._columns([head], ruled, 1)
            self._columns(rest[:count], ruled, columns)
            rest, words = rest[count:], f"{title} (continued)"
        self.y -= 0.4 * _HEADING

    def _count(self, cells: Sequence[PageCell], columns: int, top: float) -> int:
        """Give how many of the cells have room on this page, below a heading and a head."""
        room = self.y - _LOW - _HEADING - top
        counts = range(len(cells), 0, -1)
        return next((n for n in counts if sum(_talls(cells[:n], columns)) <= room), 0)

    def _heading(self, title: str) -> None:
        low = self.y - _HEADING + 1.4
        self.sheet.axes.fill(
            [LEFT, RIGHT, RIGHT, LEFT], [low, low, self.y, self.y], color=_BAR, linewidth=0.0,
            zorder=0.5,
        )  # fmt: skip
        place = (LEFT + 1.5, 0.5 * (low + self.y))
        self.sheet.text(place, title, size=1.1, across="left", bold=True, name="label/heading")
        self.y -= _HEADING

    def _columns(self, cells: Sequence[PageCell], ruled: bool, columns: int) -> None:
        middle = _rows(cells, columns)
        top = self.y
        for k, tall in enumerate(_talls(cells, columns)):
            cells[k].draw(self.sheet, LEFT, self.y)
            if middle + k < len(cells):
                cells[middle + k].draw(self.sheet, LEFT + COLUMN + _GAP, self.y)
            self.y -= tall
            if ruled:
                self.sheet.rule((LEFT, self.y), (RIGHT, self.y), _HAIR, "row")
        if ruled and columns > 1:
            x = 0.5 * (LEFT + RIGHT)
            self.sheet.rule((x, top), (x, self.y), _HAIR, "between")


def _rows(cells: Sequence[PageCell], columns: int) -> int:
    """Give how many cells stand below one another."""
    return -(-len(cells) // columns)


def _talls(cells: Sequence[PageCell], columns: int) -> list[float]:
    """Give the heights of lines of one or two cells."""
    middle = _rows(cells, columns)
    right = [each.tall for each in cells[middle:]] + [0.0]
    return [max(each.tall, right[min(k, len(right) - 1)]) for k, each in enumerate(cells[:middle])]


# --------------------------------------------------------------------------------------
# What stands at the top and at the foot of upright pages.

GREY = "0.3"
"""Colour of words that matter less."""

_PAGE_ENDS_TOP, _PAGE_ENDS_LOW = 285.0, 17.0  # mm


def page_head(sheet: Sheet, ship: str, title: str, *, first: bool) -> float:
    """Write ship and title over a rule, larger on the first page; give its height, mm."""
    size, y = (2.3, _PAGE_ENDS_TOP - 7.0) if first else (1.3, _PAGE_ENDS_TOP - 4.0)
    name = " ".join(ship.split())
    room = RIGHT - LEFT - sheet.width(title, size=0.75 * size) - 6.0
    wide = sheet.width(name, size=size, bold=True)
    sheet.text((LEFT, y), name, size=size * min(1.0, room / max(wide, 1.0)), across="left",
               up="baseline", bold=True, name="label/ship")  # fmt: skip
    sheet.text((RIGHT, y), title, size=0.75 * size, across="right", up="baseline",
               name="label/form")  # fmt: skip
    y -= 2.6
    sheet.rule((LEFT, y), (RIGHT, y), FRAME, "head")
    return y


def page_foot(sheet: Sheet, lines: Sequence[str], number: str) -> None:
    """Write lines below a rule, and the number of the page."""
    sheet.rule((LEFT, _PAGE_ENDS_LOW), (RIGHT, _PAGE_ENDS_LOW), LINE, "foot")
    for k, line in enumerate(lines):
        sheet.text((LEFT, _PAGE_ENDS_LOW - 3.2 - 2.5 * k), line, size=0.72, across="left",
                   up="baseline", colour=GREY, name="label/foot")  # fmt: skip
    sheet.text(
        (RIGHT, _PAGE_ENDS_LOW - 3.2), number, across="right", up="baseline", name="label/page"
    )
