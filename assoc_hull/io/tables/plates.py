"""Plates of a shell as a table (CSV) or a document (JSON), its schema, and flat plates as CSV.

Names and units are those of the Python objects. The schema ships as ``plates.schema.json``. Plates
of a whole hull are in `assoc_hull.io.tables.hull_plates`.

Examples
--------
>>> import assoc_hull as ah
>>> from assoc_hull.io.tables.plates import plates_csv
>>> found = ah.surface.plates(ah.examples.typical_plates()[0])
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
from assoc_hull.io.tables.json_schema import (
    NUMBER,
    Schema,
    closed_object,
    document_schema,
    with_description,
)
from assoc_hull.io.tables.spreadsheets import json_value, rows_csv, table_cell
from assoc_hull.io.write_file import form_by_ending, write_whole
from assoc_hull.model.value_schema import (
    NAME,
    NOT_NEGATIVE,
    POSITIVE,
    REAL,
    TEXT,
    TRUTH,
    list_of,
    one_of,
    or_none,
)
from assoc_hull.surface.plating.development import LABEL, Development
from assoc_hull.surface.plating.plate import Plate
from assoc_hull.surface.plating.plate_class import CAVEAT, KINDS
from assoc_hull.surface.plating.surface_plates import COLUMNS, PlateTable
from assoc_hull.surface.regions.level_lines import RegionAreas
from assoc_hull.surface.regions.options import MODES
from assoc_hull.surface.regions.result import RegionResult

__all__ = [
    "FORMAT",
    "SCHEMA",
    "development_csv",
    "plates_csv",
    "plates_document",
    "plates_json",
    "plates_schema",
    "write_plates",
]

# --------------------------------------------------------------------------------------
# Tables and documents.

FORMAT, SCHEMA = "assoc-hull plates", 1

_ENDINGS = {".csv": "csv", ".json": "json"}
_FLAT = ("plate", "row", "column", "u", "v", "x", "y", "z", "flat_x", "flat_y", "along", "across")
_FLAT_UNITS = ("", "", "", "", "", "m", "m", "m", "m", "m", "", "")


def write_plates(plates: PlateTable, path: str | os.PathLike[str], form: str | None = None) -> None:
    """Write plates as a table or a document, by the ending of the name.

    Parameters
    ----------
    plates : PlateTable
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
    instance(plates, PlateTable, "plates", "in write_plates")
    chosen = form_by_ending(path, form, tuple(_ENDINGS.values()), _ENDINGS, "in write_plates")
    text = plates_csv(plates) if chosen == "csv" else plates_json(plates)
    write_whole(path, text.encode())


def plates_csv(plates: PlateTable) -> str:
    """Lay out plates as comma-separated text: a row of names, a row of units, a row a plate.

    Numbers have all digits; what a plate does not have is blank.
    """
    return rows_csv(COLUMNS, plates.table())


def plates_json(plates: PlateTable) -> str:
    """Lay out plates as JSON text; it ends with a newline."""
    return json.dumps(plates_document(plates), indent=1, allow_nan=False) + "\n"


def plates_document(plates: PlateTable) -> dict[str, Any]:
    """Give plates as JSON says it; null where a plate has no such number."""
    options = {
        field.name: json_value(getattr(plates.options, field.name))
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
    areas = {name: json_value(value) for name, value in attrs.asdict(plate.areas).items()}
    found = {name: json_value(value) for name, value in row.items()}
    return {**found, "areas": areas, "roll_direction": direction, "notes": list(plate.notes)}


def development_csv(developments: Iterable[Development]) -> str:
    """Lay out plates that were laid flat: a row a node of the grid, strains to the next node.

    A comment says what it is; names, units, and rows by plate, place along and place across follow.
    The strain is blank where there is no next node.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> from assoc_hull.io.tables.plates import development_csv
    >>> (plate,) = ah.surface.plates(ah.examples.typical_plates()[0])
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
            writer.writerow(
                [each.name, i, j, *(table_cell(value) for value in table[i, j].tolist())]
            )
    return out.getvalue()


# --------------------------------------------------------------------------------------
# The schema, which ships beside this module; ``assoc-hull schema --of plates`` prints it.

_WHOLE: Schema = {"type": "integer", "minimum": 0}
_MAYBE: Schema = {"type": ["number", "null"]}

_OTHER: dict[str, Schema] = {
    "name": TEXT.schema, "kind": one_of(KINDS).schema, "order": one_of((1, 2, 3)).schema,
    "lines": _WHOLE, "rollable": TRUTH.schema, "heating": TRUTH.schema, "suggestion": NAME.schema,
    "roll_axis": _MAYBE, "coherence": _MAYBE, "least_radius": _MAYBE, "largest_radius": _MAYBE,
}  # fmt: skip
"""Columns that are more, or less, than a number."""

_TOLD = {
    "k0": "half the width of the band of Gaussian curvatures that count as none",
    "convex": "part of the area", "saddle": "part of the area", "cylinder": "part of the area",
    "flat": "part of the area", "unresolved": "part of the area",
    "developable": "cylinder and flat", "order": "1 flat, 2 bent one way, 3 bent both ways",
    "roll_axis": "from the long axis towards the short one; null: there is none",
    "least_radius": "null: not bent", "largest_radius": "null: not bent",
    "total_curvature": "integral of |K| dA", "mean_strain": "|K| b**2 / 8, b the breadth",
    "largest_strain": "|K| b**2 / 8", "area_error": "what quadrature may be off by",
    "suggestion": "advice, no instruction",
}  # fmt: skip


def _columns() -> dict[str, Schema]:
    """Give the schema of each column, with its unit."""
    found = {}
    for column in COLUMNS:
        words = [_TOLD.get(column.name, ""), column.unit]
        told = ", ".join(word for word in words if word)
        schema = _OTHER.get(column.name, NUMBER)
        found[column.name] = with_description(told, schema) if told else schema
    return found


def plates_schema() -> Schema:
    """Give the JSON Schema (draft 2020-12) of plates of a shell.

    Examples
    --------
    >>> from assoc_hull.io.tables.plates import plates_schema
    >>> plates_schema()["required"][:5]
    ['format', 'schema', 'units', 'search', 'options']
    """
    areas = closed_object(
        {field.name: with_description("m2", NUMBER) for field in attrs.fields(RegionAreas)}
    )
    plate = closed_object(
        {
            **_columns(),
            "areas": areas,
            "roll_direction": with_description(
                "a unit vector; null: there is none", or_none(list_of(REAL, 3, 3)).schema
            ),
            "notes": list_of(NAME).schema,
        }
    )
    search = closed_object(
        {
            "zero": with_description("how the band was given", one_of(MODES).schema),
            "strain_tol": or_none(POSITIVE).schema,
            "delta": with_description("of control points, m", or_none(NOT_NEGATIVE).schema),
            "area_tol": POSITIVE.schema,
            "depth": _WHOLE,
            "budget": _WHOLE,
        }
    )
    options = closed_object(
        {
            "breadth": with_description("m; null: that of each plate", or_none(POSITIVE).schema),
            "sagitta_tol": with_description("m", POSITIVE.schema),
            "sagitta_length": with_description("m; null: the breadth", or_none(POSITIVE).schema),
            "share": with_description(
                "part of its area that makes the class of a plate", POSITIVE.schema
            ),
        }
    )
    units = closed_object({column.name: {"const": column.unit} for column in COLUMNS})
    parts = {
        "units": units,
        "search": search,
        "options": options,
        "plates": {"type": "array", "minItems": 1, "items": plate},
        "notes": list_of(NAME).schema,
        "caveat": NAME.schema,
    }
    return document_schema(FORMAT, SCHEMA, "Plates of a shell, by their curvature", parts)
