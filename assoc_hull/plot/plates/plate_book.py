"""A book of plates as a PDF: the table, advice and notes, then maps of all plates, to one scale."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

import attrs

from assoc_hull.arguments import file_path, flag, instance, text
from assoc_hull.errors import BadInputError
from assoc_hull.io.write_file import write_whole
from assoc_hull.plot.plates.colour_legend import legend_strip
from assoc_hull.plot.plates.development import development_sheet
from assoc_hull.plot.plates.hull_map import hull_sheets
from assoc_hull.plot.plates.plate_layout import SheetArea
from assoc_hull.plot.plates.plate_panels import draw_plates, regions
from assoc_hull.plot.plates.plate_picture import picture_of
from assoc_hull.plot.sheet.labels import wrap_words
from assoc_hull.plot.sheet.paper import FRAME, LINE, Pen
from assoc_hull.plot.sheet.report_pages import GREY
from assoc_hull.plot.sheet.sheet_figure import Path_, Sheet, pdf_of, require_matplotlib
from assoc_hull.surface.plating.hull_plates import HullPlateTable
from assoc_hull.surface.plating.plate import Plate
from assoc_hull.surface.plating.plate_class import CAVEAT
from assoc_hull.surface.plating.plate_table import PlateColumn, PlateTable

__all__ = ["plate_pdf", "plate_sheet", "plate_sheets"]

_LEFT, _RIGHT, _TOP, _LOW = 15.0, 282.0, 199.0, 16.0  # mm, of A4 across
_ROW, _WORDS = 4.6, 3.4  # height of a row of the table, and of a line of words, mm
_PLATES = 6  # on a page of maps
_HAIR = Pen(0.05, "0.72", over=1.0)
_WHERE = "in plate_sheet"


def plate_sheet(
    plates: PlateTable, path: Path_, *, title: str = "Shell plates", developments: bool = False
) -> None:
    """Write a book of plates as a PDF; the file is written whole or not at all.

    Parameters
    ----------
    plates : Plates or HullPlates
        The plates; of a hull the pages are those of `assoc_hull.plot.plates.hull_map.hull_sheet`.
    path : path
        Of the file; it ends in .pdf.
    title : str
        Stands at the head of each page.
    developments : bool
        Whether a page for each plate follows, which shows it laid flat; not of a hull.

    Raises
    ------
    BadInputError, WrongTypeError
        No plates, another ending, a file that cannot be written.
    MissingExtraError
        Matplotlib is not installed.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> import numpy as np
    >>> import assoc_hull as ah
    >>> from assoc_hull.plot.plates.plate_book import plate_sheet
    >>> x, y = np.mgrid[-1:1:3j, -1:1:3j]
    >>> found = ah.surface.plates(np.stack([3 * x, y, 0.1 * x * y], axis=-1))
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     plate_sheet(found, Path(folder) / "plates.pdf")
    """
    instance(plates, PlateTable, "plates", _WHERE)
    name = file_path(path, _WHERE)
    if Path(name).suffix.lower() != ".pdf":
        raise BadInputError("a book of plates is a PDF", f"at {path}", "end the name in .pdf")
    write_whole(name, plate_pdf(plates, title=title, developments=developments))


def plate_pdf(
    plates: PlateTable, *, title: str = "Shell plates", developments: bool = False
) -> bytes:
    """Give the book as bytes, the same each time; arguments and errors as of `plate_sheet`."""
    return pdf_of(plate_sheets(plates, title=title, developments=developments), title)


def plate_sheets(
    plates: PlateTable, *, title: str = "Shell plates", developments: bool = False
) -> list[Sheet]:
    """Give the pages of the book; arguments and errors as of `plate_sheet`."""
    instance(plates, PlateTable, "plates", _WHERE)
    text(title, "title", _WHERE)
    require_matplotlib()
    # First, as it is refused where plates have no surface of their own.
    laid_flat = flag(developments, "developments", _WHERE)
    flat = [development_sheet(plate.development()) for plate in plates] if laid_flat else []
    if isinstance(plates, HullPlateTable):
        return hull_sheets(plates, title)
    book = _Book(title)
    book.turn()
    _table(book, plates)
    _words(book, "Advice", [f"{plate.name}: {plate.suggestion}." for plate in plates])
    _words(book, "What the table holds good for", list(_conditions(plates)))
    _maps(book, plates)
    pages = [*book.pages, *flat]
    for number, page in enumerate(pages, 1):
        place = (_RIGHT, 4.5)
        page.text(place, f"{number} / {len(pages)}", across="right", name="label/page")
    return pages


@attrs.define
class _Book:
    """Pages that fill from the top."""

    title: str
    pages: list[Sheet] = attrs.field(factory=list)
    y: float = 0.0

    @property
    def sheet(self) -> Sheet:
        return self.pages[-1]

    def turn(self) -> None:
        """Begin a page."""
        self.pages.append(Sheet("A4"))
        self.sheet.text((_LEFT, _TOP), self.title, size=1.8, bold=True, across="left",
                        up="baseline", name="label/title")  # fmt: skip
        self.sheet.rule((_LEFT, _TOP - 2.5), (_RIGHT, _TOP - 2.5), FRAME, "head")
        self.y = _TOP - 7.0

    def room(self, tall: float) -> bool:
        """Make sure that so much fits on the page; tell whether a page was begun for it."""
        full = self.y - tall < _LOW
        if full:
            self.turn()
        return full


def _table(book: _Book, plates: PlateTable) -> None:
    """Write the table; its head stands on each page that it reaches."""
    columns = [each for each in plates.columns if each.head]
    rows = [[_cell(each, plate) for each in columns] for plate in plates]
    heads = [[each.head for each in columns], [each.unit for each in columns]]
    wide = [
        max(book.sheet.width(word) for word in words) for words in zip(*heads, *rows, strict=True)
    ]
    wide[0] = min(wide[0], 45.0)
    gap = (_RIGHT - _LEFT - sum(wide)) / (len(wide) - 1)
    ends = [_LEFT + sum(wide[: k + 1]) + k * gap for k in range(len(wide))]
    _heads(book, heads, ends)
    for row in rows:
        if book.room(_ROW):
            _heads(book, heads, ends)
        _line(book, row, ends, "cell", _fitting(book.sheet, row[0], wide[0]))
        book.sheet.rule((_LEFT, book.y + 1.4), (_RIGHT, book.y + 1.4), _HAIR, "row")
    book.y -= 3.0


def _cell(column: PlateColumn, plate: Plate) -> str:
    """Write a value as in the table of text, with signs of print: a minus, a dash for none."""
    words = column.printed(plate)
    if column.style == "s":
        return words
    return "–" if words == "-" else words.replace("-", "−")


def _fitting(sheet: Sheet, words: str, room: float) -> str:
    """Cut a name that is too long."""
    while len(words) > 4 and sheet.width(words) > room + 1e-6:
        words = words[:-2].rstrip("…") + "…"
    return words


def _heads(book: _Book, heads: Sequence[Sequence[str]], ends: Sequence[float]) -> None:
    """Write names and units over the columns."""
    for words in heads:
        _line(book, words, ends, "head", words[0])
    book.sheet.rule((_LEFT, book.y + 1.4), (_RIGHT, book.y + 1.4), LINE, "heads")


def _line(book: _Book, words: Sequence[str], ends: Sequence[float], name: str, first: str) -> None:
    """Write a row: the first cell from the left edge, the others up to the end of their column."""
    bold = name == "head"
    y = book.y - 2.0
    book.sheet.text((_LEFT, y), first, across="left", up="baseline", bold=bold,
                    name=f"label/{name}")  # fmt: skip
    for word, end in zip(words[1:], ends[1:], strict=True):
        book.sheet.text((end, y), word, across="right", up="baseline", bold=bold,
                        name=f"label/{name}")  # fmt: skip
    book.y -= _ROW


def _conditions(plates: PlateTable) -> Iterator[str]:
    """Say what the numbers are, and what was noted."""
    yield CAVEAT
    for band in dict.fromkeys(str(each.band) for each in plates.results):
        yield f"Developable: |K| up to {band}."
    yield (
        "a, b: extents; axis: of rolling, from the long side; coh.: coherence of the bending "
        "directions; R least: 1 / the larger principal curvature; int |K|: integral over the area; "
        "strain: mean |K| b²/8."
    )
    yield from plates.notes


def _words(book: _Book, title: str, sentences: Sequence[str]) -> None:
    """Write sentences below a title."""
    book.room(3.0 * _WORDS)
    book.sheet.text((_LEFT, book.y), title, size=1.15, bold=True, across="left", up="top",
                    name="label/part")  # fmt: skip
    book.y -= 1.5 * _WORDS
    for words in sentences:
        for line in wrap_words(book.sheet, words, _RIGHT - _LEFT - 4.0, 1.0):
            book.room(_WORDS)
            book.sheet.text((_LEFT, book.y), line, across="left", up="top", name="label/words")
            book.y -= _WORDS
        book.y -= 0.6
    book.y -= 3.0


def _maps(book: _Book, plates: PlateTable) -> None:
    """Draw the plates, some on a page, with the colours explained at its foot."""
    picture = picture_of(plates)
    for first in range(0, len(picture.entries), _PLATES):
        book.turn()
        entries = picture.entries[first : first + _PLATES]
        field = SheetArea(_LEFT, _LOW, _RIGHT, _TOP - 4.0)
        draw_plates(book.sheet, entries, field, ("plan", "space"), regions)
        legend_strip(book.sheet, picture, (_LEFT, 7.0), GREY)
