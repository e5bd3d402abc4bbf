"""A booklet as pages: title, contents, then each part; tables on upright A4, pictures on A3.

`book_pages` gives the figures in order, numbered. A table that is too wide goes on below, with its
first columns said again; words are parted into lines where a column is narrow.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import attrs
import numpy as np

from assoc_hull.analysis.hydrostatics.record import FIELDS, HydrostaticTable
from assoc_hull.io.reports import Tell, no_progress
from assoc_hull.model.tables import HasState
from assoc_hull.plot.booklet.parts import (
    BookColumn,
    BookPart,
    BookTable,
    Cell,
    Rounded,
)
from assoc_hull.plot.lines_plan.drawing import Drawing, drawing, pen_of
from assoc_hull.plot.lines_plan.three_views import body_halves, extent
from assoc_hull.plot.sheet.labels import wrap_words
from assoc_hull.plot.sheet.paper import LINE, WATER, View
from assoc_hull.plot.sheet.pdf_outline import Bookmark
from assoc_hull.plot.sheet.report_pages import (
    GREY,
    LEFT,
    PAGE,
    RIGHT,
    PageCell,
    PageFlow,
    page_foot,
    page_head,
)
from assoc_hull.plot.sheet.sheet_figure import Sheet, printable

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["book_pages", "cell_text"]

_ROOM = RIGHT - LEFT
_LINE, _PAD = 2.9, 1.3  # height of a line of words, and what is free around a row, mm
_SIZE = 0.92
_GAP = 2.6  # between two columns, mm, at least
_NARROWEST = 22.0  # of a column of words, mm
_ACROSS = 8
"""Rows of a turned table side by side."""


def cell_text(cell: Cell, digits: int | None) -> str:
    """Write a cell as it is printed, with a true minus."""
    if cell is None:
        return "–"
    if isinstance(cell, str):
        return cell
    value, places = (cell.value, cell.digits) if isinstance(cell, Rounded) else (cell, digits or 0)
    return f"{round(value, places) + 0.0:.{places}f}".replace("-", "−")


# --------------------------------------------------------------------------------------
# Tables on paper.


@attrs.frozen
class _Place:
    """A column on paper: its edges, mm, and whether it holds words, which stand at the left."""

    left: float
    right: float
    words: bool


@attrs.frozen
class _Row:
    """A row of a table; cells are lines of words."""

    cells: tuple[tuple[str, ...], ...]
    places: tuple[_Place, ...]
    bold: bool = False

    @property
    def tall(self) -> float:
        return _PAD + _LINE * max(map(len, self.cells))

    def draw(self, sheet: Sheet, x: float, top: float) -> None:
        for lines, place in zip(self.cells, self.places, strict=True):
            for k, words in enumerate(lines):
                y = top - 0.5 * _PAD - 0.8 * _LINE - k * _LINE
                at = place.left if place.words else place.right
                sheet.text((x + at, y), words, size=_SIZE, up="baseline", bold=self.bold,
                           across="left" if place.words else "right", name="cell")  # fmt: skip


@attrs.frozen
class _Printed:
    """A table as words: its columns, whether they hold words, and rows."""

    heads: tuple[str, ...]
    units: tuple[str, ...]
    words: tuple[bool, ...]
    rows: tuple[tuple[str, ...], ...]
    lead: int


def _printed(table: BookTable) -> Iterator[_Printed]:
    """Give a table as words; a turned one in pieces of some rows side by side."""
    texts = [
        tuple(cell_text(cell, column.digits) for cell, column in
              zip(row, table.columns, strict=True))
        for row in table.rows
    ]  # fmt: skip
    if not table.turned:
        yield _Printed(
            tuple(each.name for each in table.columns), tuple(each.unit for each in table.columns),
            tuple(each.digits is None for each in table.columns), tuple(texts), table.lead,
        )  # fmt: skip
        return
    # Nine draughts are five and four, not eight and one.
    across = -(-len(texts) // -(-len(texts) // _ACROSS))
    for first in range(0, len(texts), across):
        part = texts[first : first + across]
        rows = [(column.name, column.unit, *(row[k] for row in part))
                for k, column in enumerate(table.columns)]  # fmt: skip
        # The first column of the table is what stands over the columns on paper.
        head = rows[0]
        yield _Printed(
            (head[0], head[1], *head[2:]), ("",) * len(head),
            (True, True, *(False for _ in part)), tuple(rows[1:]), 2,
        )  # fmt: skip


def _pieces(sheet: Sheet, table: _Printed) -> Iterator[tuple[_Row, list[_Row]]]:
    """Lay out a table that may be wider than the page: head and rows of each piece."""
    natural = [
        max(sheet.width(words, size=_SIZE, bold=k < 2) for k, words in
            enumerate((head, unit, *(row[i] for row in table.rows))))
        for i, (head, unit) in enumerate(zip(table.heads, table.units, strict=True))
    ]  # fmt: skip
    least = [min(wide, _NARROWEST) if word else wide
             for wide, word in zip(natural, table.words, strict=True)]  # fmt: skip
    for chosen in _groups(least, table.lead):
        yield _laid_out(sheet, table, chosen, natural, least)


def _groups(least: Sequence[float], lead: int) -> Iterator[list[int]]:
    """Choose which columns stand in each piece: about as many in all, the first ones in each."""
    head, rest = list(range(lead)), list(range(lead, len(least)))
    used = sum(least[k] + _GAP for k in head)
    pieces: list[list[int]] = []
    while rest:
        wide, count = used, 0
        while count < len(rest) and (not count or wide + least[rest[count]] <= _ROOM):
            wide += least[rest[count]] + _GAP
            count += 1
        pieces.append(rest[:count])
        rest = rest[count:]
    if len(pieces) > 1:
        # A last piece of one column would look like a mistake.
        every = [k for piece in pieces for k in piece]
        size = -(-len(every) // len(pieces))
        even = [every[k : k + size] for k in range(0, len(every), size)]
        if all(used + sum(least[k] + _GAP for k in piece) <= _ROOM + _GAP for piece in even):
            pieces = even
    for piece in pieces or [[]]:
        yield [*head, *piece]


def _laid_out(
    sheet: Sheet, table: _Printed, chosen: Sequence[int], natural: Sequence[float],
    least: Sequence[float],
) -> tuple[_Row, list[_Row]]:  # fmt: skip
    """Give head and rows of some columns: words share what numbers leave."""
    spare = _ROOM - 2.0 - sum(least[k] + _GAP for k in chosen)
    wish = sum(natural[k] - least[k] for k in chosen)
    share = min(1.0, max(spare, 0.0) / wish) if wish > 0.0 else 0.0
    wide = {k: least[k] + share * (natural[k] - least[k]) for k in chosen}
    loose = max(spare - wish, 0.0) / len(chosen)
    places, x = [], 1.0
    for k in chosen:
        # Numbers drift apart no farther than an eye follows.
        room = wide[k] + min(loose, 9.0)
        places.append(_Place(x, x + (wide[k] if table.words[k] else room), table.words[k]))
        x += room + _GAP

    def row(words: Sequence[str], bold: bool) -> _Row:
        cells = tuple(
            tuple(wrap_words(sheet, words[k], wide[k] + 0.3, _SIZE)) if table.words[k] and not bold
            else (words[k],)
            for k in chosen
        )  # fmt: skip
        return _Row(cells, tuple(places), bold)

    head = tuple(
        (table.heads[k], table.units[k]) if any(table.units) else (table.heads[k],) for k in chosen
    )
    return _Row(head, tuple(places), True), [row(each, False) for each in table.rows]


@attrs.frozen
class _Fact:
    """A title and words beside it."""

    title: str
    words: tuple[str, ...]
    indent: float

    @classmethod
    def of(cls, sheet: Sheet, title: str, words: str, indent: float = 34.0) -> _Fact:
        """Part the words into lines."""
        return cls(title, tuple(wrap_words(sheet, words, _ROOM - indent - 2.0, _SIZE)), indent)

    @property
    def tall(self) -> float:
        return 0.5 * _PAD + _LINE * max(len(self.words), 1)

    def draw(self, sheet: Sheet, x: float, top: float) -> None:
        y = top - 0.25 * _PAD - 0.8 * _LINE
        sheet.text((x + 1.0, y), self.title, size=_SIZE, across="left", up="baseline",
                   colour=GREY, name="fact")  # fmt: skip
        for k, words in enumerate(self.words):
            sheet.text((x + self.indent, y - k * _LINE), words, size=_SIZE, across="left",
                       up="baseline", name="fact")  # fmt: skip


# --------------------------------------------------------------------------------------
# The pages.


@attrs.define
class _Entry:
    """A line of the contents: its words, how deep it stands, and the page it points to."""

    words: str
    depth: int
    page: int


def book_pages(
    hull: HasState, parts: Sequence[BookPart], design: HydrostaticTable, title: str,
    tell: Tell = no_progress,
) -> tuple[list[Figure], list[Bookmark]]:  # fmt: skip
    """Lay out a booklet: title, contents, parts; all pages numbered. Gives its bookmarks, too.

    Parameters
    ----------
    hull : Hull
        The hull.
    parts : sequence of BookPart
        What stands in it.
    design : HydrostaticTable
        At the design draught, for the title page.
    title : str
        Of the booklet.
    tell : callable
        Hears which part is drawn.
    """
    ship, entries = design.header.ship, list[_Entry]()
    pages: list[Sheet | Figure] = []
    for k, part in enumerate(parts):
        tell(f"drawing {part.name}", len(parts) + k, 2 * len(parts))
        entries.append(_Entry(part.title, 0, len(pages)))
        pages += _part_pages(ship, part, entries, len(pages))
    front: list[Sheet] = [_title_page(hull, design, title)]
    # What stands before the parts moves them back, and may itself be several pages.
    front += _contents(design, title, entries, 1 + len(_contents(design, title, entries, 0)))
    every = [*front, *pages]
    hull_words = f"hull {design.header.fingerprint}"
    for k, page in enumerate(every, 1):
        number = f"{k} / {len(every)}"
        if isinstance(page, Sheet):
            if page.paper is PAGE:
                page_foot(page, [hull_words], number)
        else:
            _number_picture(page, f"{ship}   {number}")
    marks = [Bookmark("Title page", 0, 1), Bookmark("Contents", 0, 2)]
    marks += [Bookmark(each.words, each.depth, each.page + len(front) + 1) for each in entries]
    # A table that has the name of its part stands where that leads already.
    marks = [mark for k, mark in enumerate(marks) if not k or mark.title != marks[k - 1].title]
    return [page.figure if isinstance(page, Sheet) else page for page in every], marks


def _part_pages(
    ship: str, part: BookPart, entries: list[_Entry], before: int
) -> list[Sheet | Figure]:
    """Make the pages of a part; its tables and pictures join the contents."""
    found: list[Sheet | Figure] = []
    if part.facts or part.tables or part.notes:
        flow = PageFlow(lambda sheet, first: page_head(sheet, ship, part.title, first=False) - 4.0)
        flow.turn()
        if part.facts:
            cells = [_Fact.of(flow.sheet, *each) for each in part.facts]
            flow.part("What the numbers hold good for", cells, ruled=False, columns=1)
        for table in part.tables:
            _flow_table(flow, table)
            first = next(k for k, sheet in enumerate(flow.pages) if _says(sheet, table.title))
            entries.append(_Entry(table.title, 1, before + first))
        if part.notes:
            notes = [_Fact.of(flow.sheet, "", each, 2.0) for each in part.notes]
            flow.part("Notes", notes, ruled=False, columns=1)
        found += flow.pages
    for picture in part.pictures:
        if picture.title != part.title:
            entries.append(_Entry(picture.title, 1, before + len(found)))
        found.append(picture.draw())
    return found


def _says(sheet: Sheet, heading: str) -> bool:
    """Tell whether a heading stands on a page."""
    return any(text.get_text() == printable(heading) for text in sheet.axes.texts)


def _flow_table(flow: PageFlow, table: BookTable) -> None:
    """Let a table flow down the pages, in as many pieces as it needs."""
    title = table.title
    for printed in _printed(table):
        for head, rows in _pieces(flow.sheet, printed):
            cells: Sequence[PageCell] = rows
            flow.part(title, cells, columns=1, head=head)
            title = f"{table.title}, further columns"


def _number_picture(figure: Figure, words: str) -> None:
    """Write the number of a page that has a frame of its own, below the frame."""
    wide, tall = (25.4 * side for side in figure.get_size_inches().tolist())
    figure.text(
        (wide - 9.0) / wide, 3.2 / tall, printable(words), ha="right", va="baseline", fontsize=6.6,
        fontfamily="DejaVu Sans", gid="page", parse_math=False,
    )  # fmt: skip


def _contents(
    design: HydrostaticTable, title: str, entries: Sequence[_Entry], before: int
) -> list[Sheet]:
    """Make the pages of contents, and of what all numbers hold good for."""
    head = design.header
    flow = PageFlow(lambda sheet, first: page_head(sheet, head.ship, title, first=False) - 4.0)
    flow.turn()
    lines = [_Line(each.words, each.depth, str(each.page + before + 1)) for each in entries]
    flow.part("Contents", lines, ruled=False, columns=1)
    cells = [_Fact.of(flow.sheet, *each) for each in head.lines()]
    flow.part("What the numbers hold good for", cells, ruled=False, columns=1)
    return flow.pages


@attrs.frozen
class _Line:
    """A line of the contents: words, dots, the page."""

    words: str
    depth: int
    page: str

    @property
    def tall(self) -> float:
        return _LINE + (_PAD if self.depth else 1.8 * _PAD)

    def draw(self, sheet: Sheet, x: float, top: float) -> None:
        y = top - self.tall + 0.9
        at, bold = x + 1.0 + 6.0 * self.depth, not self.depth
        sheet.text((at, y), self.words, size=1.0, across="left", up="baseline", bold=bold,
                   name="contents")  # fmt: skip
        sheet.text((RIGHT - 1.0, y), self.page, size=1.0, across="right", up="baseline",
                   bold=bold, name="contents/page")  # fmt: skip
        start = at + sheet.width(self.words, size=1.0, bold=bold) + 2.0
        sheet.rule((start, y + 0.2), (RIGHT - 8.0, y + 0.2), attrs.evolve(LINE, dash=(0.2, 1.4)))


# --------------------------------------------------------------------------------------
# The title page.

_SHOWN = ("volume", "displacement", "lcb", "kb", "kmt", "wetted_surface", "waterplane_area", "lcf",
          "cb", "cm", "cp", "cw")  # fmt: skip


def _title_page(hull: HasState, design: HydrostaticTable, title: str) -> Sheet:
    """Draw the name of the ship, two views, the particulars, the fingerprint."""
    sheet, ship = Sheet(PAGE), hull.state.particulars
    name = " ".join(ship.name.split()) or "Hull"
    wide = sheet.width(name, size=3.4, bold=True)
    sheet.text((LEFT, 262.0), name, size=3.4 * min(1.0, _ROOM / max(wide, 1.0)), across="left",
               up="baseline", bold=True, name="label/ship")  # fmt: skip
    sheet.text((LEFT, 253.0), title, size=1.7, across="left", up="baseline", name="label/title")
    if design.header.date is not None:
        sheet.text((RIGHT, 253.0), design.header.date, size=1.2, across="right", up="baseline",
                   name="label/date")  # fmt: skip
    sheet.rule((LEFT, 249.0), (RIGHT, 249.0), LINE, "head")
    low = _views(sheet, drawing(hull), 243.0)
    rows: list[tuple[str, str, str]] = [
        ("Length between perpendiculars", "Lpp", f"{ship.length:.3f} m"),
        ("Breadth, moulded", "B", f"{ship.breadth:.3f} m"),
        ("Depth, moulded", "D", f"{ship.depth:.3f} m"),
        ("Design draught, moulded", "T", f"{ship.draught:.3f} m"),
    ]
    for each in _SHOWN:
        field, value = FIELDS[each], float(design.columns[each][0])
        if not np.isnan(value):
            unit = "" if field.unit == "-" else f" {field.unit}"
            rows.append((_capital(field.title), field.symbol,
                         f"{cell_text(value, field.digits)}{unit}"))  # fmt: skip
    at = design.positions[0].draught_mean
    heading = f"Principal particulars, at a draught of {at:.3f} m"
    columns = (BookColumn(heading), BookColumn("symbol"), BookColumn("value"))
    printed = next(_printed(BookTable("", columns, tuple(rows))))
    head, lines = next(_pieces(sheet, printed))
    y = low - 6.0
    for row in (head, *lines):
        row.draw(sheet, LEFT, y)
        y -= row.tall
        sheet.rule((LEFT, y), (RIGHT, y), attrs.evolve(LINE, width=0.05, colour="0.72"), "row")
    return sheet


def _capital(words: str) -> str:
    return words[:1].upper() + words[1:]


_BODY_TALL, _BETWEEN = 62.0, 7.0  # mm


def _views(sheet: Sheet, plan: Drawing, top: float) -> float:
    """Draw the profile over the body plan; give where they end, mm."""
    least, most = extent(plan)
    length, breadth, height = (most - least).tolist()
    unit = _ROOM / length
    z = top - unit * float(most[2])
    profile = View("profile", (0, 2), 1e3 / unit, (LEFT - unit * float(least[0]), z))
    for family in ("boundary", "buttocks"):
        for line in plan.of(family):
            for points in line.polylines:
                sheet.line(profile.on_paper(points), pen_of(line, False), "profile")
    level = plan.particulars.draught
    sheet.rule((LEFT, profile.up(level)), (RIGHT, profile.up(level)), WATER, "profile/T")
    below = profile.up(float(least[2])) - _BETWEEN
    unit = min(_BODY_TALL / height, 0.5 * _ROOM / (float(most[1]) or breadth))
    base = below - unit * float(most[2])
    body = View("body", (1, 2), 1e3 / unit, (0.5 * (LEFT + RIGHT), base))
    sections = plan.of("sections") or plan.of("frames")
    halves = body_halves(sections, 0.5 * plan.particulars.length)
    for view, lines in zip((body.mirrored(), body), halves, strict=True):
        for line in lines:
            for points in line.polylines:
                sheet.line(view.on_paper(points), pen_of(line, False), "body")
    side = unit * float(most[1])
    middle = 0.5 * (LEFT + RIGHT)
    sheet.rule((middle - side, body.up(level)), (middle + side, body.up(level)), WATER, "body/T")
    return body.up(float(least[2]))
