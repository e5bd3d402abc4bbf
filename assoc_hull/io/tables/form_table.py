"""Form parameters as CSV and XLSX: a row per entry, below the head.

The head stands above, a line each, behind ``#`` in a CSV; then a row of names, and a row per
entry. What a hull does not have is blank, and its reason stands beside it.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator
from typing import Any

from assoc_hull.analysis.form.report import FormReport, Row
from assoc_hull.io.tables.workbook import head_on, openpyxl_module, workbook_bytes

__all__ = ["COLUMNS", "csv_text", "xlsx_bytes"]

COLUMNS = (
    "symbol", "number", "unit", "name", "table", "reason", "warning", "definition", "datum",
    "ittc", "source",
)  # fmt: skip
"""What stands in a row."""

_NUMBER = COLUMNS.index("number")


def csv_text(report: FormReport) -> str:
    """Lay out form parameters as comma-separated text; numbers have twelve digits.

    Examples
    --------
    >>> from assoc_hull.analysis.form.report import form_report
    >>> from assoc_hull.io.tables.form_table import csv_text
    >>> from assoc_hull.sources import examples
    >>> text = csv_text(form_report(examples.wigley(), draught=6.25, only=["B'"]))
    >>> text.splitlines()[-1].split(",")[:4]
    ["B'", '8.00390529679', 'm', 'reduced breadth']
    """
    out = io.StringIO()
    out.writelines(f"# {title}: {' '.join(words.split())}\n" for title, words in report.lines())
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(COLUMNS)
    for row in _rows(report):
        number = row.value.number
        cells = _cells(row)
        cells[_NUMBER] = "" if number is None else f"{number:.12g}"
        writer.writerow(["" if cell is None else cell for cell in cells])
    return out.getvalue()


def xlsx_bytes(report: FormReport) -> bytes:
    """Lay out form parameters as a workbook; numbers are whole, shown with their digits.

    Raises
    ------
    MissingExtraError
        openpyxl is not installed.
    """
    book = openpyxl_module().Workbook()
    sheet = book.active
    sheet.title = "form parameters"
    head_on(sheet, report.lines())
    sheet.append(COLUMNS)
    top = sheet.max_row + 1
    for row in _rows(report):
        sheet.append(_cells(row))
        for cell in sheet[sheet.max_row]:
            if isinstance(cell.value, str):
                cell.data_type = "s"  # words that begin with = are no formula
        shown = sheet.cell(sheet.max_row, _NUMBER + 1)
        shown.number_format = "0." + "0" * row.entry.digits if row.entry.digits else "0"
    sheet.freeze_panes = sheet.cell(top, _NUMBER + 1)
    return workbook_bytes(book)


def _rows(report: FormReport) -> Iterator[Row]:
    for part in report.parts:
        yield from part.rows


def _cells(row: Row) -> list[Any]:
    """Give the cells of a row; None: blank."""
    entry, value = row.entry, row.value
    return [
        entry.symbol, value.number, value.unit, entry.name, entry.table, value.reason,
        value.warning, entry.definition, entry.datum, entry.ittc, entry.source,
    ]  # fmt: skip
