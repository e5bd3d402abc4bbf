"""Writing a booklet: a PDF of pages, or a workbook of the same tables, by the ending of the name.

The same hull and wishes give the same bytes at any time: a date stands in it only if one is given.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from assoc_hull.analysis.hydrostatics.floating_body import Appendage, rising_numbers
from assoc_hull.analysis.hydrostatics.record import SALT, HydrostaticTable
from assoc_hull.analysis.stability.condition import OnError
from assoc_hull.analysis.stability.flooding import FloodingPoint
from assoc_hull.arguments import all_of, choice, file_path, instance, number, positive, text
from assoc_hull.edit.adoption.adopt_lines import AdoptionReport
from assoc_hull.errors import BadInputError
from assoc_hull.io.reports import Tell, no_progress
from assoc_hull.io.tables.spreadsheets import head_on, openpyxl_module, workbook_bytes
from assoc_hull.io.write_file import write_whole
from assoc_hull.model.tables import HasState, state_of
from assoc_hull.plot.booklet.pages import book_pages
from assoc_hull.plot.booklet.parts import (
    PARTS,
    BookPart,
    BookRequest,
    BookTable,
    Cell,
    Rounded,
    hydrostatic_part,
    parts_of,
)
from assoc_hull.plot.sheet.pdf_outline import with_outline
from assoc_hull.plot.sheet.sheet_figure import Path_, pdf_of_figures, require_matplotlib
from assoc_hull.surface.blocks.fitted_surface import FittedSurface
from assoc_hull.surface.plating.hull_plates import HullPlateTable

__all__ = ["BOOK_ENDINGS", "book_workbook", "write_booklet", "write_hydrostatic_book"]

BOOK_ENDINGS = (".pdf", ".xlsx")
_WHERE = "in report"
_TITLE = "Hull report"


def write_booklet(
    hull: HasState,
    path: Path_,
    parts: Iterable[str] | str | None = None,
    *,
    draughts: Sequence[float] | None = None,
    draught: float | None = None,
    kg: float | None = None,
    flooding: Iterable[FloodingPoint] = (),
    rho: float = SALT,
    shell_factor: float = 1.0,
    appendages: Iterable[Appendage] = (),
    on_error: OnError = "refuse",
    surface: FittedSurface | None = None,
    plates: HullPlateTable | None = None,
    adoption: AdoptionReport | None = None,
    title: str = _TITLE,
    date: str | None = None,
    tell: Tell = no_progress,
) -> tuple[str, ...]:
    """Write a booklet; give the names of its parts. Arguments and errors as of `Hull.report`.

    `tell` hears which part is computed or drawn.
    """
    state = state_of(hull, _WHERE)
    form, name = _form(path), text(title, "title", _WHERE)
    if surface is not None:
        instance(surface, FittedSurface, "surface", _WHERE)
    if plates is not None:
        instance(plates, HullPlateTable, "plates", _WHERE)
    given = {"surface": surface is not None, "plates": plates is not None}
    asked = BookRequest(
        _names(parts, given),
        None if draughts is None else tuple(rising_numbers(draughts, "draughts", _WHERE).tolist()),
        state.particulars.draught if draught is None else positive(draught, "draught", _WHERE),
        None if kg is None else number(kg, "kg", _WHERE),
        tuple(all_of(flooding, FloodingPoint, "flooding", _WHERE)),
        positive(rho, "rho", _WHERE), positive(shell_factor, "shell_factor", _WHERE),
        tuple(all_of(appendages, Appendage, "appendages", _WHERE)), on_error, surface, plates,
        adoption, None if date is None else text(date, "date", _WHERE),
    )  # fmt: skip
    _require(form)
    found, design = parts_of(hull, asked, tell)
    _write(hull, path, form, found, design, name, tell)
    return asked.names


def write_hydrostatic_book(hull: HasState, table: HydrostaticTable, path: Path_) -> None:
    """Write a table of hydrostatics as a PDF with title page and curves.

    Raises
    ------
    BadInputError
        A file that cannot be written.
    MissingExtraError
        Matplotlib is not installed.
    """
    _require(".pdf")
    _write(hull, path, ".pdf", (hydrostatic_part(table),), table, "Hydrostatics")


def _form(path: Path_) -> str:
    form = Path(file_path(path, _WHERE)).suffix.lower()
    if form not in BOOK_ENDINGS:
        known = " or ".join(BOOK_ENDINGS)
        raise BadInputError("the form is unknown", f"at {path}", f"end the name in {known}")
    return form


def _require(form: str) -> None:
    """Make sure that what writes the form is installed, before anything is computed."""
    if form == ".pdf":
        require_matplotlib()
    else:
        openpyxl_module()


def _names(parts: Iterable[str] | str | None, given: dict[str, bool]) -> tuple[str, ...]:
    """Take the parts, each once, in their order; all that can be made if none is named."""
    if parts is None:
        return tuple(each for each in PARTS if given.get(each, True))
    some = [parts] if isinstance(parts, str) else all_of(parts, str, "parts", _WHERE)
    chosen = {choice(each, "a part", PARTS, _WHERE) for each in some}
    if not chosen:
        raise BadInputError("no part is named", _WHERE, f"name some of {', '.join(PARTS)}")
    for each in chosen:
        if not given.get(each, True):
            what = f"the part {each!r} is asked, and no {each} given"
            raise BadInputError(what, _WHERE, f"give {each}=, or leave the part out")
    return tuple(each for each in PARTS if each in chosen)


def _write(
    hull: HasState, path: Path_, form: str, parts: Sequence[BookPart], design: HydrostaticTable,
    title: str, tell: Tell = no_progress,
) -> None:  # fmt: skip
    if form == ".pdf":
        pages, marks = book_pages(hull, parts, design, title, tell)
        tell("writing pages", 0, 0)
        data = pdf_of_figures(pages, f"{title}: {design.header.ship}", design.header.date)
        data = with_outline(data, marks)
    else:
        data = book_workbook(parts, design, title)
    write_whole(path, data)


# --------------------------------------------------------------------------------------
# The workbook.

_LONGEST = 31  # letters of the name of a sheet
_FORBIDDEN = re.compile(r"[\[\]:*?/\\]")


def book_workbook(parts: Sequence[BookPart], design: HydrostaticTable, title: str) -> bytes:
    """Give the tables of a booklet as a workbook: a sheet each, behind one that lists them."""
    book = openpyxl_module().Workbook()
    front = book.active
    front.title = "contents"
    head_on(front, [("title", title), *design.header.lines()])
    taken = {"contents"}
    for part in parts:
        head_on(front, [("part", part.title), *part.facts])
        for table in part.tables:
            name = _sheet_name(table.title, taken)
            head_on(front, [("sheet", f"{name}: {table.title}")])
            _fill(book.create_sheet(name), table)
        head_on(front, [("note", each) for each in part.notes])
    return workbook_bytes(book)


def _sheet_name(title: str, taken: set[str]) -> str:
    """Give a name for a sheet that no other has."""
    plain = _FORBIDDEN.sub(" ", title)[:_LONGEST].strip()
    name, k = plain, 1
    while name.lower() in taken:
        k += 1
        name = f"{plain[: _LONGEST - 3]} {k}"
    taken.add(name.lower())
    return name


def _fill(page: Any, table: BookTable) -> None:
    """Write a table into a sheet: names, units, rows; numbers are whole, shown with digits."""
    head_on(page, [("table", table.title)])
    page.append([each.name for each in table.columns])
    page.append([each.unit for each in table.columns])
    top = page.max_row
    for r, row in enumerate(table.rows, top + 1):
        for c, (value, column) in enumerate(zip(row, table.columns, strict=True), 1):
            _cell(page.cell(r, c), value, column.digits)
    page.freeze_panes = page.cell(top + 1, table.lead + 1)


def _cell(place: Any, value: Cell, digits: int | None) -> None:
    if isinstance(value, str):
        place.value = value
        place.data_type = "s"  # what begins with = is no formula
        return
    places = value.digits if isinstance(value, Rounded) else digits or 0
    place.value = value.value if isinstance(value, Rounded) else value
    place.number_format = "0." + "0" * places if places else "0"
