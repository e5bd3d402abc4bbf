"""Tables of offsets as XLSX workbooks, through openpyxl (extra ``xlsx``): the cells of the CSV.

Examples
--------
>>> from assoc_hull.io.export.offset_out import Offsets
>>> from assoc_hull.io.offset_report import Notebook
>>> from assoc_hull.io.tables.offset_xlsx import text_of_xlsx, xlsx_bytes
>>> table = Offsets(("unit: m",), [[["x_m", "wl_0"], ["0", "0.50"], ["9", ""]]])
>>> text_of_xlsx(xlsx_bytes(table), "a.xlsx", Notebook()).splitlines()
['# unit: m', 'x_m,wl_0', '0,0.5', '9,']
"""

from __future__ import annotations

import csv
import datetime
import io
import re
import warnings
import zipfile
from typing import Any

from assoc_hull.errors import BadInputError
from assoc_hull.io.export.offset_out import Offsets
from assoc_hull.io.offset_report import Notebook
from assoc_hull.io.tables.offset_text import opens_block
from assoc_hull.io.tables.workbook import openpyxl_module, workbook_bytes

__all__ = ["text_of_xlsx", "xlsx_bytes"]

_NAMES = ("half-breadths", "heights of buttocks")
_MOST_BYTES = 50_000_000
_MOST_ROWS, _MOST_COLUMNS = 5_000, 1_000
_TAKE = "give a sheet of offsets, or save it as CSV"


def xlsx_bytes(offsets: Offsets) -> bytes:
    """Lay out a table as a workbook: a sheet a block, comments above the first.

    Numbers are numbers, shown with as many digits as the CSV has.

    Raises
    ------
    MissingExtraError
        openpyxl is not installed.
    """
    book = openpyxl_module().Workbook()
    book.remove(book.active)
    for k, block in enumerate(offsets.blocks):
        sheet = book.create_sheet(_NAMES[k])
        top = list(offsets.comments) if k == 0 else []
        for comment in top:
            sheet.append([f"# {comment}"])
        for row in block:
            sheet.append([_value(cell) for cell in row])
        _dress(sheet, len(top) + 1, block)
    return workbook_bytes(book)


def _value(cell: str) -> float | str | None:
    """Give a cell as a number, if it is one."""
    if re.fullmatch(r"-?[0-9]+(\.[0-9]+)?(e-?[0-9]+)?", cell):
        return float(cell)
    return cell or None


def _dress(sheet: Any, head: int, block: list[list[str]]) -> None:
    """Show the digits that were written, and keep the header and the stations in sight."""
    first = next(k for k, name in enumerate(block[0]) if name == "x_m") + 1
    for row, cells in zip(sheet.iter_rows(min_row=head + 1), block[1:], strict=True):
        for cell, text in list(zip(row, cells, strict=True))[first:]:
            cell.number_format = "0." + "0" * len(text.partition(".")[2]) if "." in text else "0"
    sheet.freeze_panes = sheet.cell(head + 1, first + 1)


def text_of_xlsx(data: bytes, source: str, notes: Notebook) -> str:
    """Give the sheets of a workbook as comma-separated text, one after the other.

    Of the sheets behind the first those are read that begin as a table does.

    Parameters
    ----------
    data : bytes
        The workbook. Of formulas the values count that were stored with them.
    source : str
        Name of the file, for messages.
    notes : Notebook
        Takes the sheets that are not read.

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
            sheets = [(sheet.title, _rows(sheet, source)) for sheet in book.worksheets]
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


def _rows(sheet: Any, source: str) -> list[list[str]]:
    """Give the rows of a sheet as text, blank ones and blank ends left out."""
    sheet.reset_dimensions()  # what the file says of them may be anything
    found = []
    for number, row in enumerate(sheet.iter_rows(values_only=True), start=1):
        where = f"in sheet {sheet.title!r} of {source}, row {number}"
        if number > _MOST_ROWS or len(row) > _MOST_COLUMNS:
            raise BadInputError("the sheet is larger than any table of offsets", where, _TAKE)
        cells = [_text(cell, where) for cell in row]
        while cells and not cells[-1]:
            cells.pop()
        if cells:
            found.append(cells)
    return found


def _text(value: object, where: str) -> str:
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
