"""The text of a table from a file: CSV or XLSX in, blocks of cells out.

`read_text` takes a path or a text and gives text, that of a workbook as comma-separated rows.
`split_blocks` finds comments (``#``; unit and frame often stand there), separators and header rows;
a second header row opens a second block. `cell_number` makes a number of a cell, nan of a blank.
"""

from __future__ import annotations

import csv
import datetime
import io
import math
import re
import warnings
import zipfile
from pathlib import Path
from typing import Any

import attrs

from assoc_hull.errors import BadInputError
from assoc_hull.io.reports import Notebook
from assoc_hull.io.tables.spreadsheets import openpyxl_module

__all__ = [
    "TableBlock",
    "cell_number",
    "opens_block",
    "read_text",
    "split_blocks",
    "text_of_xlsx",
]

# --------------------------------------------------------------------------------------
# Text to blocks of cells.

_NUMBER = re.compile(r"[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]{1,3})?")
_BLANKS = frozenset({"", "-", "--", "\N{EN DASH}", "\N{EM DASH}"})
_OPENING = re.compile(r"(stations?|stn|sta|st|frame|no|x[ _\[(]*(mm?)?[\])]?)\.?", re.IGNORECASE)
_LARGEST = 1e7  # of any number in a table, in its unit
_ARCHIVE = b"PK\x03\x04"
"""What a workbook begins with."""


@attrs.frozen
class TableBlock:
    """One header row and the rows under it, as text.

    Attributes
    ----------
    source : str
        The file, or "text".
    header : tuple of str
        The column names.
    rows : tuple of tuple of str
        The cells, stripped; every row is as long as the header.
    lines : tuple of int
        The line of the file on which each row ends, from 1.
    """

    source: str
    header: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    lines: tuple[int, ...]

    def where(self, row: int, column: int) -> str:
        """Say where a cell stands."""
        station = f" (station {self.rows[row][0]})" if self.rows[row][0] else ""
        return f"{self.source}, row {self.lines[row]}{station}, column {self.header[column]!r}"


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
    return text, source


def _read_file(path: str | Path, book: Notebook) -> tuple[str, str]:
    if not str(path).strip():
        raise BadInputError("the name is empty", "path_or_text", "give a file or a text")
    try:
        raw = Path(path).read_bytes()
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise BadInputError(
            f"the file cannot be read ({reason})", str(path), "check the path"
        ) from None
    if raw.startswith(_ARCHIVE):
        return text_of_xlsx(raw, str(path), book), str(path)
    try:
        return raw.decode("utf-8-sig"), str(path)
    except UnicodeDecodeError:
        book.repair("encoding", str(path), "not UTF-8, read as Latin-1")
        return raw.decode("latin-1"), str(path)


def split_blocks(
    text: str, source: str, book: Notebook
) -> tuple[tuple[str, ...], tuple[TableBlock, ...]]:
    """Split a text into comments and blocks.

    Raises
    ------
    BadInputError
        Ragged rows, a quotation that is never closed, no header, no rows.
    """
    lines = text.lstrip("\N{ZERO WIDTH NO-BREAK SPACE}").splitlines()
    comments = tuple(line.strip().strip(",;\t")[1:].strip() for line in lines if _comment(line))
    kept = [(k + 1, line) for k, line in enumerate(lines) if line.strip() and not _comment(line)]
    rows = _cells(kept, source, book)
    rows = [(k, row) for k, row in rows if any(row)]
    if not rows:
        raise BadInputError("there is no row besides comments", source, "give a table of offsets")
    starts = [i for i, (_, row) in enumerate(rows) if i == 0 or opens_block(row[0])]
    ends = [*starts[1:], len(rows)]
    return comments, tuple(
        _block(source, rows[a:b], book) for a, b in zip(starts, ends, strict=True)
    )


def opens_block(cell: str) -> bool:
    """Tell whether a row that begins with this cell is the header of a table."""
    return _OPENING.fullmatch(cell) is not None


def _comment(line: str) -> bool:
    return line.lstrip(' \t"').startswith("#")


def _cells(
    lines: list[tuple[int, str]], source: str, book: Notebook
) -> list[tuple[int, tuple[str, ...]]]:
    """Split rows by the mark that stands most often in the first one."""
    first = lines[0][1] if lines else ""
    mark = max("\t;,", key=first.count)
    try:
        rows = [(k, _split(line, mark)) for k, line in lines]
    except csv.Error as error:
        raise BadInputError(
            f"a row is no {mark!r}-separated text ({error})", source, "mend the quotation marks"
        ) from None
    return rows if mark == "," else _decimal_points(rows, source, book)


def _split(line: str, mark: str) -> tuple[str, ...]:
    return tuple(cell.strip() for cell in next(csv.reader([line], delimiter=mark, strict=True)))


def _decimal_points(
    rows: list[tuple[int, tuple[str, ...]]], source: str, book: Notebook
) -> list[tuple[int, tuple[str, ...]]]:
    """Turn decimal commas into points: where cells are parted by another mark, a comma is one."""
    comma = re.compile(r"(?<=[0-9]),(?=[0-9]+$)")
    mended = [(k, tuple(comma.sub(".", cell) for cell in row)) for k, row in rows]
    count = sum(
        a != b
        for (_, x), (_, y) in zip(rows, mended, strict=True)
        for a, b in zip(x, y, strict=True)
    )
    if count:
        book.repair("decimal comma", source, f"{count} cells had a decimal comma", float(count))
    return mended


def _block(source: str, rows: list[tuple[int, tuple[str, ...]]], book: Notebook) -> TableBlock:
    line, header = rows[0]
    header = header[: max((k + 1 for k, cell in enumerate(header) if cell), default=0)]
    if all(number_like(cell) for cell in header):
        raise BadInputError(
            "the first row holds numbers only",
            f"{source}, row {line}",
            "put a header such as 'station,wl_0,wl_0.25' above it",
        )
    body = tuple(_fit(source, k, row, len(header), book) for k, row in rows[1:])
    return TableBlock(source, header, body, tuple(k for k, _ in rows[1:]))


def _fit(
    source: str, line: int, row: tuple[str, ...], width: int, book: Notebook
) -> tuple[str, ...]:
    """Give a row of the width of the header; surplus cells are dropped if blank."""
    if len(row) > width and not any(row[width:]):
        surplus = len(row) - width
        book.repair("surplus cells", f"row {line}", f"{surplus} empty cells dropped", surplus)
        row = row[:width]
    if len(row) != width:
        raise BadInputError(
            f"the row has {len(row)} cells and the header {width}",
            f"{source}, row {line} (station {row[0]})",
            "give every row one cell per column; leave a cell empty where there is no offset",
        )
    return row


def number_like(cell: str) -> bool:
    """Say whether a cell is blank or a number."""
    return cell in _BLANKS or _NUMBER.fullmatch(cell) is not None


def cell_number(block: TableBlock, row: int, column: int) -> float:
    """Give the number in a cell, nan for a blank.

    Raises
    ------
    BadInputError
        The cell holds something else, or a number no ship has.
    """
    cell = block.rows[row][column]
    if cell in _BLANKS:
        return math.nan
    if not _NUMBER.fullmatch(cell):
        raise BadInputError(
            f"{cell!r} is not a number",
            block.where(row, column),
            "write a plain number, or leave the cell empty where there is no offset",
        )
    value = float(cell)
    if abs(value) > _LARGEST:
        raise BadInputError(
            f"{cell} is beyond any ship", block.where(row, column), "correct the number"
        )
    return value


# --------------------------------------------------------------------------------------
# Workbooks, through openpyxl (extra ``xlsx``): the cells of the CSV.

_MOST_BYTES = 50_000_000
_MOST_ROWS, _MOST_COLUMNS = 5_000, 1_000
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
        head = next((row for row in rows if not row[0].startswith("#")), [""])
        if k and not opens_block(head[0]):
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
