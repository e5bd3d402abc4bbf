"""Plates of a hull on sheets: the map, then the table, then notes; one PDF."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, TypeVar

from assoc_hull.arguments import instance, text
from assoc_hull.io.write_file import form_by_ending, write_whole
from assoc_hull.plot.plates.hull_map import map_sheet
from assoc_hull.plot.sheet.form_flow import wrapped
from assoc_hull.plot.sheet.pages import pdf_of
from assoc_hull.plot.sheet.paper import MARGIN, PaperName
from assoc_hull.plot.sheet.pens import LINE
from assoc_hull.plot.sheet.sheet import Path_, Sheet
from assoc_hull.plot.sheet.title_block import frame
from assoc_hull.surface.plates.hull_plate_table import COLUMNS, HullPlates
from assoc_hull.surface.plates.suggestions import CAVEAT

if TYPE_CHECKING:
    from assoc_hull.surface.plates.hull_plate import HullPlate

__all__ = ["hull_sheet"]

_ROWS, _STEP = 62, 3.9
"""Plates on a page, and the height of a row, mm at A3."""

_LINES = 64
"""Of notes on a page."""


Item = TypeVar("Item")


def hull_sheet(
    found: HullPlates,
    path: Path_,
    *,
    title: str = "Curvature of the shell",
    paper: PaperName = "A3",
) -> None:
    """Write plates of a hull as a PDF: the map, the table with advice, notes.

    Parameters
    ----------
    found : HullPlates
        Of `plates` with `HullSeams`.
    path : path
        A ``.pdf`` file; what was there is replaced by the whole of it, or stays.
    title : str
        Stands on every page.
    paper : "A3", "A1" or "A4"
        Size of the sheets, landscape.

    Raises
    ------
    BadInputError, WrongTypeError
        No plates of a hull, another ending, a file that cannot be written.
    MissingExtraError
        Matplotlib is not installed.
    """
    where = "in hull_sheet"
    instance(found, HullPlates, "found", where)
    named = text(title, "title", where)
    form_by_ending(path, None, ("pdf",), {".pdf": "pdf"}, where)
    sheets = [map_sheet(found, named, paper)]
    sheets += [_table(rows, named, paper) for rows in _parts(found.rows, _ROWS)]
    sheets += [
        _notes(lines, named, paper)
        for lines in _parts(_wrapped((*found.notes, CAVEAT), paper), _LINES)
    ]
    write_whole(path, pdf_of(sheets, named))


def _parts(items: Sequence[Item], size: int) -> Iterator[Sequence[Item]]:
    for first in range(0, len(items), size):
        yield items[first : first + size]


def _page(title: str, paper: PaperName) -> tuple[Sheet, float]:
    """Begin a page; give the height below its title, mm."""
    sheet = Sheet(paper)
    factor = sheet.paper.factor
    frame(sheet, MARGIN * factor)
    top = sheet.paper.height - (MARGIN + 8.0) * factor
    left = (MARGIN + 5.0) * factor
    sheet.text((left, top), title, size=2.2, bold=True, across="left", name="label/title")
    return sheet, top - 9.0 * factor


def _table(rows: Sequence[HullPlate], title: str, paper: PaperName) -> Sheet:
    """Write some rows of the table."""
    sheet, top = _page(title, paper)
    factor = sheet.paper.factor
    x = (MARGIN + 5.0) * factor
    advice = ("advice", "", [plate.suggestion.partition(":")[0] for plate in rows])
    seen = [
        (each.head, each.unit, [each.printed(plate) for plate in rows])
        for each in COLUMNS
        if each.head
    ]
    for number, (head, unit, body) in enumerate([*seen, advice]):
        wide = max(sheet.width(words) for words in (head, unit, *body))
        first = number in (0, len(seen))
        place = x if first else x + wide
        for row, words in enumerate((head, unit, *body)):
            y = top - (row + (0.4 if row > 1 else 0.0)) * _STEP * factor
            if words:
                sheet.text((place, y), words, across="left" if first else "right", bold=row == 0,
                           name=f"table/{head}")  # fmt: skip
        x += wide + 4.0 * factor
    rule = top - 1.7 * _STEP * factor
    sheet.rule((MARGIN * factor, rule), (sheet.paper.width - MARGIN * factor, rule), LINE, "table")
    return sheet


def _wrapped(words: Sequence[str], paper: PaperName) -> list[str]:
    """Break notes into lines of a page."""
    sheet = Sheet(paper)
    room = sheet.paper.width - 2.0 * (MARGIN + 5.0) * sheet.paper.factor
    return [line for each in words for line in wrapped(sheet, each, room, 1.15)]


def _notes(lines: Sequence[str], title: str, paper: PaperName) -> Sheet:
    """Write lines of notes."""
    sheet, top = _page(title, paper)
    factor = sheet.paper.factor
    for number, line in enumerate(lines):
        place = ((MARGIN + 5.0) * factor, top - number * _STEP * factor)
        sheet.text(place, line, size=1.15, across="left", name="label/note")
    return sheet
