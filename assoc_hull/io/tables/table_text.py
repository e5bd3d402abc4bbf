"""The text of a table from a file, CSV or XLSX: `read_text`.

It takes a path or a text and gives text, that of a workbook as comma-separated rows;
`assoc_hull.io.tables.table_blocks` finds the cells in it.
"""

from __future__ import annotations

import csv
import datetime
import io
import re
import warnings
import zipfile
from pathlib import Path
from typing import Any

from assoc_hull.arguments import regular_file
from assoc_hull.errors import BadInputError
from assoc_hull.io.read_file import as_utf8
from assoc_hull.io.reports import Notebook
from assoc_hull.io.tables.spreadsheets import openpyxl_module
from assoc_hull.io.tables.table_blocks import opens_block

__all__ = [
    "read_text",
    "refuse_long",
    "text_of_xlsx",
]

_ARCHIVE = b"PK\x03\x04"
"""What a workbook begins with."""


_MINUS = re.compile(r"[\N{EN DASH}\N{MINUS SIGN}](?=[0-9.])")
"""What word processors print for the minus of a keyboard."""


def read_text(path_or_text: str | Path, book: Notebook) -> tuple[str, str]:
    """Give the text of a table and the name of its source; a string with a line break is the text.

    `book` takes a note when the file is not UTF-8.

    Raises
    ------
    BadInputError
        The file is missing, unreadable, binary or empty.
    """
    if isinstance(path_or_text, str) and ("\n" in path_or_text or "\r" in path_or_text):
        text, source = path_or_text, "text"
    else:
        text, source = _read_file(path_or_text, book)
    if re.search(r"[\x00-\x08\x0e-\x1f]", text):
        raise BadInputError("the content is binary", source, "give a CSV or TSV text file")
    if not text.strip():
        raise BadInputError("there is nothing in it", source, "give a table of offsets")
    return _MINUS.sub("-", text), source


_MOST_LETTERS, _MOST_CELLS = 5_000_000, 200_000
"""Of 500 stations by 400 waterlines; each cell is looked at several times."""


def refuse_long(text: str, source: str) -> None:
    """Refuse a text that no table of offsets is as large as, before its cells are parted.

    Raises
    ------
    BadInputError
        It holds more than 5 MB, or more than 200,000 cells.
    """
    few = len(text) <= _MOST_LETTERS
    cells = max(sum(map(text.count, ",;\t\n")), len(text.split())) if few else 0
    if few and cells <= _MOST_CELLS:
        return
    size = f"{cells} cells, more than {_MOST_CELLS}" if few else f"{len(text) / 1e6:.1f} MB of text"
    remedy = "give the offsets only; of points of lines begin it with 'line,x,y,z'"
    raise BadInputError(f"the table holds {size}", source, remedy)


def _read_file(path: str | Path, book: Notebook) -> tuple[str, str]:
    if not str(path).strip():
        raise BadInputError("the name is empty", "path_or_text", "give a file or a text")
    try:
        raw = regular_file(Path(path)).read_bytes()
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise BadInputError(
            f"the file cannot be read ({reason})", str(path), "check the path"
        ) from None
    if raw.startswith(_ARCHIVE):
        return text_of_xlsx(raw, str(path), book), str(path)
    for head, (what, remedy) in _FOREIGN.items():
        if raw.startswith(head):
            raise BadInputError(f"this is {what}, which is not read", str(path), remedy)
    try:
        plain = as_utf8(raw)
        if plain is not raw:
            book.repair("encoding", str(path), "UTF-16, as of 'Unicode text', read as such")
        return plain.decode("utf-8-sig"), str(path)
    except UnicodeDecodeError:
        book.repair("encoding", str(path), "not UTF-8, read as Latin-1")
        return raw.decode("latin-1"), str(path)


_FOREIGN = {
    b"glTF": ("a scene of glTF", "export the mesh as .stl, .obj or .ply"),
    b"AC10": ("a DWG drawing", "save it as .dxf"),
    b"%PDF": ("a PDF", "export the lines as .dxf, or the offsets as .csv"),
}
"""Files that are often handed in and hold no hull that can be read, by how they begin."""


# --------------------------------------------------------------------------------------
# Workbooks, through openpyxl (extra ``xlsx``): the cells of the CSV.

_MOST_BYTES = 50_000_000
_MOST_ROWS, _MOST_COLUMNS = 5_000, 1_000
_HEADS = 4  # the header of a later sheet stands among these rows, titles first
_TAKE = "give a sheet of offsets, or save it as CSV"


def text_of_xlsx(data: bytes, source: str, notes: Notebook) -> str:
    """Give the sheets of a workbook as comma-separated text, one after the other.

    Of the sheets behind the first those are read that begin as a table does; `notes` takes the
    others. Of formulas the values count that were stored with them.

    Raises
    ------
    MissingExtraError
        openpyxl is not installed.
    BadInputError
        It is no workbook, too large, or holds errors in its cells.
    """
    openpyxl = openpyxl_module()
    _refuse_large(data, source)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of styles and the like, which are not read
            book = openpyxl.load_workbook(io.BytesIO(data), read_only=True, data_only=True)
            sheets = [(sheet.title, _sheet_rows(sheet, source)) for sheet in book.worksheets]
    except BadInputError:
        raise
    except Exception as error:  # whatever a damaged archive makes its readers raise
        what = f"this is no workbook that can be read ({type(error).__name__})"
        raise BadInputError(what, f"at {source}", _TAKE) from error
    return "".join(_chosen([each for each in sheets if each[1]], source, notes))


def _chosen(sheets: list[tuple[str, list[list[str]]]], source: str, notes: Notebook) -> list[str]:
    """Lay out the first sheet, and what of the others is a table."""
    found = []
    for k, (title, rows) in enumerate(sheets):
        heads = [tuple(row) for row in rows if not row[0].startswith("#")][:_HEADS]
        if k and not any(map(opens_block, heads)):
            notes.assume("sheet", f"{title!r} of {source}", "it begins as no table and is not read")
        else:
            found.append(_laid_out(rows))
    return found


def _laid_out(rows: list[list[str]]) -> str:
    """Lay out a sheet; rows are as long as the longest, comments stand as they are."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    width = max(len(row) for row in rows)
    for row in rows:
        if row[0].startswith("#"):
            out.write(" ".join(row) + "\n")
        else:
            writer.writerow([*row, *[""] * (width - len(row))])
    return out.getvalue()


def _refuse_large(data: bytes, source: str) -> None:
    """Refuse an archive that unpacks to more than any table of offsets."""
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            size = sum(member.file_size for member in archive.infolist())
    except Exception as error:  # a damaged directory makes zipfile raise one of many
        what = f"this is no workbook ({error})"
        raise BadInputError(what, f"at {source}", _TAKE) from None
    if size > _MOST_BYTES:
        raise BadInputError(f"the workbook unpacks to {size / 1e6:.0f} MB", f"at {source}", _TAKE)


def _sheet_rows(sheet: Any, source: str) -> list[list[str]]:
    """Give the rows of a sheet as text, blank ones and blank ends left out."""
    sheet.reset_dimensions()  # what the file says of them may be anything
    found = []
    for number, row in enumerate(sheet.iter_rows(values_only=True), start=1):
        where = f"in sheet {sheet.title!r} of {source}, row {number}"
        if number > _MOST_ROWS or len(row) > _MOST_COLUMNS:
            raise BadInputError("the sheet is larger than any table of offsets", where, _TAKE)
        cells = [_cell_text(cell, where) for cell in row]
        while cells and not cells[-1]:
            cells.pop()
        if cells:
            found.append(cells)
    return found


def _cell_text(value: object, where: str) -> str:
    """Give a cell as the text that stands in a CSV."""
    if value is None:
        return ""
    if isinstance(value, bool | datetime.date | datetime.time | datetime.timedelta):
        raise BadInputError(f"{value} is no offset", where, "give numbers, or leave the cell empty")
    if isinstance(value, float):
        return repr(value).removesuffix(".0")
    text = str(value)
    if text.startswith("#") and text.endswith(("!", "?", "/A")):
        raise BadInputError(f"a formula gives {text}", where, "mend the formula")
    return " ".join(text.split())
