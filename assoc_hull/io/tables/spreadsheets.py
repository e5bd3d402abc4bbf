"""Tables as CSV and XLSX: workbooks, columns with a head, rows with units.

Workbooks come from openpyxl (extra ``xlsx``), with a fixed date, so that the same cells give the
same bytes. `columns_csv` and `columns_xlsx` lay out columns of numbers; `rows_csv` lays out rows
of mixed cells. What is nan or missing is blank.

Examples
--------
>>> from types import SimpleNamespace
>>> from assoc_hull.io.tables.spreadsheets import rows_csv
>>> columns = [SimpleNamespace(name="area", unit="m2"), SimpleNamespace(name="kind", unit="")]
>>> print(rows_csv(columns, [{"area": 2.5, "kind": None}]), end="")
area,kind
m2,
2.5,
"""

from __future__ import annotations

import csv
import datetime
import io
import math
import re
import zipfile
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

import attrs
import numpy as np

from assoc_hull.errors import MissingExtraError
from assoc_hull.geometry.curves import FloatArray

__all__ = [
    "TableColumn",
    "columns_csv",
    "columns_xlsx",
    "head_on",
    "json_value",
    "openpyxl_module",
    "rows_csv",
    "table_cell",
    "workbook_bytes",
]

# --------------------------------------------------------------------------------------
# Workbooks.

_DAY = datetime.datetime(2000, 1, 1)
"""A workbook bears a date; one that never changes gives the same bytes for the same cells."""


def openpyxl_module() -> Any:
    """Give openpyxl.

    Raises
    ------
    MissingExtraError
        It is not installed.
    """
    try:
        import openpyxl
    except ImportError:
        raise MissingExtraError("openpyxl", "xlsx") from None
    return openpyxl


def head_on(sheet: Any, lines: Iterable[tuple[str, str]]) -> None:
    """Write the head of a table: pairs of a title and words, a row each."""
    for title, words in lines:
        sheet.append([f"# {title}", " ".join(words.split())])
        sheet.cell(sheet.max_row, 2).data_type = "s"  # a name that begins with = is no formula


def workbook_bytes(book: Any) -> bytes:
    """Give the file of a workbook, with a fixed date."""
    book.properties.created = book.properties.modified = _DAY
    out = io.BytesIO()
    book.save(out)
    return _settled(out.getvalue())


def _settled(data: bytes) -> bytes:
    """Put a fixed date on the members of an archive."""
    out = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(data)) as old, zipfile.ZipFile(out, "w") as new:
        for name in old.namelist():
            content = old.read(name)
            if name == "docProps/core.xml":
                content = re.sub(rb"(<dcterms:modified[^>]*>)[^<]*", rb"\g<1>2000-01-01T00:00:00Z",
                                 content)  # fmt: skip
            member = zipfile.ZipInfo(name, _DAY.timetuple()[:6])
            new.writestr(member, content, zipfile.ZIP_DEFLATED)
    return out.getvalue()


# --------------------------------------------------------------------------------------
# Tables of columns: the head, a line each, behind ``#`` in a CSV; a row of names, a row of units,
# and the rows.

Head = Iterable[tuple[str, str]]


@attrs.frozen(eq=False)
class TableColumn:
    """A column: its name, unit, digits after the point, and numbers (d,)."""

    name: str
    unit: str
    digits: int
    values: FloatArray


def columns_csv(head: Head, columns: Sequence[TableColumn]) -> str:
    """Lay out a table as comma-separated text.

    Numbers have twelve digits, which is more than is known of any of them.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.io.tables.spreadsheets import columns_csv, TableColumn
    >>> columns = [
    ...     TableColumn("t", "m", 3, np.ones(2)),
    ...     TableColumn("v", "m3", 1, np.array([7, np.nan])),
    ... ]
    >>> print(columns_csv([("ship", "A")], columns), end="")
    # ship: A
    t,v
    m,m3
    1,7
    1,
    """
    out = io.StringIO()
    out.writelines(f"# {title}: {' '.join(words.split())}\n" for title, words in head)
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow([each.name for each in columns])
    writer.writerow([each.unit for each in columns])
    for row in _rows(columns):
        writer.writerow(["" if math.isnan(value) else f"{value:.12g}" for value in row])
    return out.getvalue()


def columns_xlsx(title: str, head: Head, columns: Sequence[TableColumn], first: int) -> bytes:
    """Lay out a table as a workbook: unrounded numbers, shown with the digits of a table.

    `title` is that of the sheet; the first `first` columns stay in sight.

    Raises
    ------
    MissingExtraError
        openpyxl is not installed.
    """
    book = openpyxl_module().Workbook()
    sheet = book.active
    sheet.title = title
    head_on(sheet, head)
    top = sheet.max_row + 1
    sheet.append([each.name for each in columns])
    sheet.append([each.unit for each in columns])
    for row in _rows(columns):
        sheet.append([None if math.isnan(value) else value for value in row])
    for cells, column in zip(sheet.iter_cols(min_row=top + 2), columns, strict=True):
        for cell in cells:
            cell.number_format = "0." + "0" * column.digits if column.digits else "0"
    sheet.freeze_panes = sheet.cell(top + 2, first + 1)
    return workbook_bytes(book)


def _rows(columns: Sequence[TableColumn]) -> Iterator[tuple[float, ...]]:
    return zip(*(each.values.tolist() for each in columns), strict=True)


# --------------------------------------------------------------------------------------
# Rows of mixed cells, and values for documents.


def rows_csv(columns: Sequence[Any], rows: Iterable[Mapping[str, object]]) -> str:
    """Lay out rows as comma-separated text: a row of names, a row of units, then each row.

    Columns have `name` and `unit`; values come in their order. Numbers have all digits; what a row
    does not have is blank.
    """
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow([column.name for column in columns])
    writer.writerow([column.unit for column in columns])
    for row in rows:
        writer.writerow([table_cell(value) for value in row.values()])
    return out.getvalue()


def table_cell(value: object) -> str:
    """Give what stands in a cell."""
    found = json_value(value)
    if found is None:
        return ""
    if isinstance(found, bool):
        return "true" if found else "false"
    return repr(found + 0.0) if isinstance(found, float) else str(found)


def json_value(value: object) -> object:
    """Give a value as JSON says it: a number that is not finite becomes null."""
    if isinstance(value, np.generic):
        value = value.item()
    return None if isinstance(value, float) and not math.isfinite(value) else value
