"""Plates of a shell as a table (CSV) or a document (JSON), and plates laid flat as a table.

Names and units are those of the Python objects. The document has a JSON Schema, see
`assoc_hull.io.tables.plates_schema`.

Examples
--------
>>> import assoc_hull as ah
>>> from assoc_hull.io.tables.plates_file import plates_csv
>>> found = ah.plates(ah.examples.typical_plates()[0])
>>> for line in plates_csv(found).splitlines():
...     print(",".join(line.split(",")[:4]))
name,area,length,breadth
,m2,m,m
flat of side,19.2,8.0,2.4
"""

from __future__ import annotations

import csv
import io
import json
import os
from collections.abc import Iterable
from typing import Any

import attrs
import numpy as np

from assoc_hull.arguments import all_of, instance
from assoc_hull.io.tables.plate_cells import cell, plain, rows_csv
from assoc_hull.io.write_file import form_by_ending, write_whole
from assoc_hull.surface.plates.development import LABEL, Development
from assoc_hull.surface.plates.plate import Plate
from assoc_hull.surface.plates.plate_table import COLUMNS, Plates
from assoc_hull.surface.plates.suggestions import CAVEAT
from assoc_hull.surface.regions.region_result import RegionResult

__all__ = [
    "FORMAT", "SCHEMA", "development_csv", "plates_csv", "plates_document", "plates_json",
    "write_plates",
]  # fmt: skip

FORMAT, SCHEMA = "assoc-hull plates", 1

_ENDINGS = {".csv": "csv", ".json": "json"}
_FLAT = ("plate", "row", "column", "u", "v", "x", "y", "z", "flat_x", "flat_y", "along", "across")
_FLAT_UNITS = ("", "", "", "", "", "m", "m", "m", "m", "m", "", "")


def write_plates(plates: Plates, path: str | os.PathLike[str], form: str | None = None) -> None:
    """Write plates as a table or a document, by the ending of the name.

    Parameters
    ----------
    plates : Plates
        The plates.
    path : path
        The file; what was there is replaced by the whole of it, or stays.
    form : {"csv", "json"} or None
        None: by the ending.

    Raises
    ------
    BadInputError
        Another form, or a file that cannot be written.
    """
    instance(plates, Plates, "plates", "in write_plates")
    chosen = form_by_ending(path, form, tuple(_ENDINGS.values()), _ENDINGS, "in write_plates")
    text = plates_csv(plates) if chosen == "csv" else plates_json(plates)
    write_whole(path, text.encode())


def plates_csv(plates: Plates) -> str:
    """Lay out plates as comma-separated text: a row of names, a row of units, a row a plate.

    Numbers have all digits; what a plate does not have is blank.
    """
    return rows_csv(COLUMNS, plates.table())


def plates_json(plates: Plates) -> str:
    """Lay out plates as JSON text; it ends with a newline."""
    return json.dumps(plates_document(plates), indent=1, allow_nan=False) + "\n"


def plates_document(plates: Plates) -> dict[str, Any]:
    """Give plates as JSON says it; null where a plate has no such number."""
    options = {
        field.name: plain(getattr(plates.options, field.name))
        for field in attrs.fields(type(plates.options))
        if field.name != "suggestions"
    }
    return {
        "format": FORMAT,
        "schema": SCHEMA,
        "units": {column.name: column.unit for column in COLUMNS},
        "search": _search(plates.results[0]),
        "options": options,
        "plates": [
            _document(plate, row) for plate, row in zip(plates, plates.table(), strict=True)
        ],
        "notes": list(plates.notes),
        "caveat": CAVEAT,
    }


def _search(result: RegionResult) -> dict[str, Any]:
    """Give what counted as no curvature, and the limits of the search."""
    return {
        "zero": result.band.mode, "strain_tol": result.band.strain_tol,
        "delta": result.band.delta, "area_tol": result.options.area_tol,
        "depth": result.options.depth, "budget": result.options.budget,
    }  # fmt: skip


def _document(plate: Plate, row: dict[str, Any]) -> dict[str, Any]:
    """Give one plate: its row, its areas, and the axis in space."""
    direction = None if plate.roll_direction is None else plate.roll_direction.tolist()
    areas = {name: plain(value) for name, value in attrs.asdict(plate.areas).items()}
    found = {name: plain(value) for name, value in row.items()}
    return {**found, "areas": areas, "roll_direction": direction, "notes": list(plate.notes)}


def development_csv(developments: Iterable[Development]) -> str:
    """Lay out plates that were laid flat: a row a node of the grid, strains to the next node.

    Parameters
    ----------
    developments : iterable of Development
        Of `Plate.development`.

    Returns
    -------
    str
        Comma-separated: a comment that says what it is, names, units, and rows by plate, place
        along and place across; the strain is blank where there is no next node.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> from assoc_hull.io.tables.plates_file import development_csv
    >>> (plate,) = ah.plates(ah.examples.typical_plates()[0])
    >>> print(development_csv([plate.development((3, 3))]).splitlines()[1])
    plate,row,column,u,v,x,y,z,flat_x,flat_y,along,across
    """
    out = io.StringIO()
    out.write(f"# {LABEL}\n")
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(_FLAT)
    writer.writerow(_FLAT_UNITS)
    for each in all_of(developments, Development, "developments", "in development_csv"):
        rows, columns = each.u.shape
        along, across = np.full((2, rows, columns), np.nan)
        along[:-1], across[:, :-1] = each.longitudinal, each.transverse
        table = np.dstack([each.u, each.v, each.place, each.flat, along, across])
        for i, j in np.ndindex(rows, columns):
            writer.writerow([each.name, i, j, *(cell(value) for value in table[i, j].tolist())])
    return out.getvalue()
