"""Tables of hydrostatics as CSV and XLSX, with the head that says what they hold good for.

Above stands the head, a line each, behind ``#`` in a CSV; then a row of names, a row of units,
and a row per floating position: draughts, the values, the least freeboard, what appendages add,
and ``error_`` columns where it was estimated how far values may be off. Names and units are those
of the record.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from assoc_hull.analysis.hydrostatics.record import FIELDS, HydrostaticTable
from assoc_hull.errors import BadInputError
from assoc_hull.io.tables.spreadsheets import TableColumn, columns_csv, columns_xlsx
from assoc_hull.io.write_file import write_whole

__all__ = ["TABLE_ENDINGS", "hydrostatic_csv", "hydrostatic_xlsx", "write_hydrostatic_table"]

TABLE_ENDINGS = (".csv", ".xlsx")

_UNITS = {"heel_deg": "deg"}
_FIRST = 2  # columns that stay in sight: the draughts


def write_hydrostatic_table(table: HydrostaticTable, path: str | os.PathLike[str]) -> None:
    """Write a table; the ending tells the form, ``.csv`` or ``.xlsx``.

    Raises
    ------
    BadInputError
        Another ending, or a file that cannot be written.
    MissingExtraError
        A workbook was asked, and openpyxl is not installed.
    """
    ending = Path(path).suffix.lower()
    if ending == ".csv":
        write_whole(path, hydrostatic_csv(table).encode())
    elif ending == ".xlsx":
        write_whole(path, hydrostatic_xlsx(table))
    else:
        known = " or ".join(TABLE_ENDINGS)
        raise BadInputError("the form is unknown", f"at {path}", f"end the name in {known}")


def hydrostatic_csv(table: HydrostaticTable) -> str:
    """Lay out a table as comma-separated text; what a position does not have is blank."""
    return columns_csv(_head(table), list(_columns(table)))


def hydrostatic_xlsx(table: HydrostaticTable) -> bytes:
    """Lay out a table as a workbook; numbers are whole, and shown with the digits of a table.

    Raises
    ------
    MissingExtraError
        openpyxl is not installed.
    """
    return columns_xlsx("hydrostatics", _head(table), list(_columns(table)), _FIRST)


def _head(table: HydrostaticTable) -> Iterator[tuple[str, str]]:
    """Give the head, what the appendages add where most of them are wet, and the notes."""
    yield from table.header.lines()
    for share in table.shares:
        most = share.percent[abs(share.percent).argmax()]
        yield "share", f"{share.appendage.name}: up to {most:.4g} % of the volume"
    for note in table.notes:
        yield "note", note


def _columns(table: HydrostaticTable) -> Iterator[TableColumn]:
    """Give draughts, values, freeboard, what each appendage adds, and errors."""
    for name, values in table.draughts.items():
        yield TableColumn(name, _UNITS.get(name, "m"), 4, values)
    for name, values in table.columns.items():
        yield TableColumn(name, FIELDS[name].unit, FIELDS[name].digits, values)
    free = np.array([each.least for each in table.freeboards])
    yield TableColumn("freeboard", "m", 4, free)
    for share in table.shares:
        name = share.appendage.name
        yield TableColumn(f"volume of {name}", "m3", 3, share.volume)
        yield TableColumn(f"area of {name}", "m2", 3, share.area)
    for name, values in table.errors.items():
        yield TableColumn(f"error_{name}", FIELDS[name].unit, FIELDS[name].digits + 3, values)
