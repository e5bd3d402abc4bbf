"""Resistance as text, CSV, XLSX and JSON.

The table has a row per speed; inputs, coefficients and warnings stand in the head of CSV and XLSX.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import attrs

from assoc_hull.analysis.resistance.calm_water_resistance import Resistance
from assoc_hull.errors import BadInputError
from assoc_hull.io.tables.spreadsheets import TableColumn, columns_csv, columns_xlsx
from assoc_hull.io.write_file import write_whole

__all__ = ["ENDINGS", "FORMAT", "SCHEMA", "resistance_document", "write_resistance"]

FORMAT, SCHEMA = "assoc-hull resistance", 1
"""Name and version of the document."""

ENDINGS = (".txt", ".csv", ".xlsx", ".json")

_UNITS = {"V": "kn", "Fn": "-", "PE": "kW"}


def resistance_document(found: Resistance) -> dict[str, Any]:
    """Give resistance as JSON says it: columns as they are printed, in kn, kN and kW.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> from assoc_hull.io.tables.resistance import resistance_document
    >>> found = resistance_document(ah.examples.wigley().resistance([10.0, 12.0]))
    >>> list(found)[3:]
    ['method', 'columns', 'inputs', 'coefficients', 'by_speed', 'warnings']
    """
    return {
        "format": FORMAT,
        "schema": SCHEMA,
        "ship": found.name,
        "method": found.method,
        "columns": {head: column.tolist() for head, column in found.table().items()},
        "inputs": [attrs.asdict(each) for each in found.inputs],
        "coefficients": dict(found.coefficients),
        "by_speed": {name: column.tolist() for name, column in found.by_speed.items()},
        "warnings": list(found.warnings),
    }


def write_resistance(found: Resistance, path: str | os.PathLike[str]) -> None:
    """Write resistance; the ending tells the form.

    Raises
    ------
    BadInputError
        Another ending, or a file that cannot be written.
    MissingExtraError
        A workbook was asked, and openpyxl is not installed.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> import assoc_hull as ah
    >>> from assoc_hull.io.tables.resistance import write_resistance
    >>> found = ah.examples.wigley().resistance([10.0, 12.0])
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     write_resistance(found, Path(folder, "r.csv"))
    ...     Path(folder, "r.csv").read_text().splitlines()[-4]
    'V,Fn,RF,form,RAPP,RW,RB,RTR,RA,R,PE'
    """
    ending = Path(path).suffix.lower()
    head = list(_head(found))
    if ending == ".txt":
        write_whole(path, f"{found}\n".encode())
    elif ending == ".csv":
        write_whole(path, columns_csv(head, list(_columns(found))).encode())
    elif ending == ".xlsx":
        write_whole(path, columns_xlsx("resistance", head, list(_columns(found)), 1))
    elif ending == ".json":
        text = json.dumps(resistance_document(found), indent=1, allow_nan=False)
        write_whole(path, f"{text}\n".encode())
    else:
        known = ", ".join(ENDINGS)
        raise BadInputError("the form is unknown", f"at {path}", f"end the name in one of {known}")


def _head(found: Resistance) -> Iterator[tuple[str, str]]:
    yield "ship", found.name
    yield "method", f"Holtrop {found.method}"
    for each in found.inputs:
        unit = "" if each.unit == "-" else f" {each.unit}"
        note = f": {each.note}" if each.note else ""
        yield each.symbol, f"{each.value:.12g}{unit}, {each.source}{note}"
    for name, value in found.coefficients.items():
        yield name, f"{value:.12g}"
    yield from (("warning", each) for each in found.warnings)


def _columns(found: Resistance) -> Iterator[TableColumn]:
    for head, column in found.table().items():
        digits = {"V": 2, "Fn": 4, "PE": 0}.get(head, 1)
        yield TableColumn(head, _UNITS.get(head, "kN"), digits, column)
