"""Tables of columns as CSV and XLSX, with the head that says what they hold good for.

Above stands the head, a line each, behind ``#`` in a CSV; then a row of names, a row of units,
and the rows. What is nan is blank.
"""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Iterable, Iterator, Sequence

import attrs

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.io.tables.workbook import head_on, openpyxl_module, workbook_bytes

__all__ = ["Column", "columns_csv", "columns_xlsx"]

Head = Iterable[tuple[str, str]]


@attrs.frozen(eq=False)
class Column:
    """A column: its name, unit, digits after the point, and numbers (d,)."""

    name: str
    unit: str
    digits: int
    values: FloatArray


def columns_csv(head: Head, columns: Sequence[Column]) -> str:
    """Lay out a table as comma-separated text.

    Numbers have twelve digits, which is more than is known of any of them.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.io.tables.column_table import Column, columns_csv
    >>> columns = [Column("t", "m", 3, np.ones(2)), Column("v", "m3", 1, np.array([7, np.nan]))]
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


def columns_xlsx(title: str, head: Head, columns: Sequence[Column], first: int) -> bytes:
    """Lay out a table as a workbook; numbers are whole, and shown with the digits of a table.

    Parameters
    ----------
    title : str
        Of the sheet.
    head : iterable of (str, str)
        What stands above.
    columns : sequence of Column
        The table.
    first : int
        So many columns stay in sight.

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


def _rows(columns: Sequence[Column]) -> Iterator[tuple[float, ...]]:
    return zip(*(each.values.tolist() for each in columns), strict=True)
