"""Plates of a hull as a table (CSV) or a document (JSON), and its schema.

Names and units are those of the Python objects. The schema ships as ``hull_plates.schema.json``.
Plates of single surfaces are in `assoc_hull.io.tables.plates`.
"""

from __future__ import annotations

import json
import os
from typing import Any

from assoc_hull.arguments import instance
from assoc_hull.io.tables.json_schema import (
    NUMBER,
    Schema,
    closed_object,
    document_schema,
    with_description,
)
from assoc_hull.io.tables.spreadsheets import json_value, rows_csv
from assoc_hull.io.write_file import form_by_ending, write_whole
from assoc_hull.model.value_schema import (
    NAME,
    POSITIVE,
    REAL,
    TEXT,
    TRUTH,
    list_of,
    one_of,
    or_none,
)
from assoc_hull.surface.plating.hull_plate import HullPlate
from assoc_hull.surface.plating.hull_plates import COLUMNS, HullPlateTable
from assoc_hull.surface.plating.hull_seams import AXES
from assoc_hull.surface.plating.plate_class import CAVEAT, KINDS

__all__ = [
    "FORMAT",
    "SCHEMA",
    "hull_plates_csv",
    "hull_plates_document",
    "hull_plates_schema",
    "write_hull_plates",
]

# --------------------------------------------------------------------------------------
# Tables and documents.

FORMAT, SCHEMA = "assoc-hull hull plates", 1

_ENDINGS = {".csv": "csv", ".json": "json"}


def write_hull_plates(
    plates: HullPlateTable, path: str | os.PathLike[str], form: str | None = None
) -> None:
    """Write plates of a hull as a table or a document, by the ending of the name.

    Parameters
    ----------
    plates : HullPlateTable
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
    where = "in write_hull_plates"
    instance(plates, HullPlateTable, "plates", where)
    chosen = form_by_ending(path, form, tuple(_ENDINGS.values()), _ENDINGS, where)
    if chosen == "csv":
        text = hull_plates_csv(plates)
    else:
        text = json.dumps(hull_plates_document(plates), indent=1, allow_nan=False) + "\n"
    write_whole(path, text.encode())


def hull_plates_csv(plates: HullPlateTable) -> str:
    """Lay out plates as comma-separated text: a row of names, a row of units, a row a plate.

    Numbers have all digits; what a plate does not have is blank.
    """
    return rows_csv(COLUMNS, plates.table())


def hull_plates_document(plates: HullPlateTable) -> dict[str, Any]:
    """Give plates of a hull as JSON says it; null where a plate has no such number."""
    band, options = plates.regions.band, plates.options
    return {
        "format": FORMAT,
        "schema": SCHEMA,
        "units": {column.name: column.unit for column in COLUMNS},
        "seams": {
            **{axis: list(getattr(plates.seams, axis)) for axis in AXES},
            "inside": plates.seams.inside,
        },
        "search": {"zero": band.mode, "strain_tol": band.strain_tol, "k0": band.k0},
        "options": {
            "breadth": options.breadth, "sagitta_tol": options.sagitta_tol,
            "sagitta_length": options.sagitta_length, "share": options.share,
        },
        "fits": plates.fits,
        "patches": {"all": plates.regions.count, "computed": plates.computed},
        "plates": [
            _document(plate, row) for plate, row in zip(plates, plates.table(), strict=True)
        ],
        "notes": list(plates.notes),
        "caveat": CAVEAT,
    }  # fmt: skip


def _document(plate: HullPlate, row: dict[str, Any]) -> dict[str, Any]:
    """Give one plate: its row, its ranges, and the axis in space."""
    direction = None if plate.roll_direction is None else plate.roll_direction.tolist()
    found = {name: json_value(value) for name, value in row.items()}
    ranges = {axis: [json_value(end) for end in getattr(plate.range, axis)] for axis in AXES}
    return {
        **found, "ranges": ranges, "blocks": list(plate.blocks),
        "axes": plate.axes.tolist(), "roll_direction": direction, "notes": list(plate.notes),
    }  # fmt: skip


# --------------------------------------------------------------------------------------
# The schema, which ships beside this module; ``assoc-hull schema --of hull-plates`` prints it.

_WHOLE: Schema = {"type": "integer", "minimum": 0}
_MAYBE: Schema = {"type": ["number", "null"]}

_OTHER: dict[str, Schema] = {
    "name": TEXT.schema, "range": NAME.schema, "kind": or_none(one_of(KINDS)).schema,
    "order": or_none(one_of((1, 2, 3))).schema, "rollable": TRUTH.schema,
    "suggestion": NAME.schema, "dk": _MAYBE, "roll_axis": _MAYBE,
    "coherence": _MAYBE, "least_radius": _MAYBE, "largest_radius": _MAYBE,
}  # fmt: skip
"""Columns that are more, or less, than a number."""

_TOLD = {
    "k0": "half the width of the band of Gaussian curvatures that count as none",
    "dk": "what K changes by between fits, on 95 % of the plate; null: no other fit",
    "convex": "part of the area", "saddle": "part of the area", "cylinder": "part of the area",
    "flat": "part of the area", "unresolved": "part of the area beside borders of blocks",
    "contested": "part of the area with K0/2 <= |K| <= 2 K0",
    "changed": "part of the area that another fit tells otherwise",
    "kind": "of the fitted surface, in doubt where contested + changed > 20 %; null: unresolved",
    "order": "1 flat, 2 bent one way, 3 bent both ways; null: no class",
    "roll_axis": "from the long axis towards the short one; null: there is none",
    "total_curvature": "integral of |K| dA", "mean_strain": "|K| b**2 / 8, b the breadth",
    "largest_strain": "|K| b**2 / 8", "suggestion": "advice, no instruction",
}  # fmt: skip


def _columns() -> dict[str, Schema]:
    """Give the schema of each column, with its unit."""
    found = {}
    for column in COLUMNS:
        told = ", ".join(word for word in (_TOLD.get(column.name, ""), column.unit) if word)
        schema = _OTHER.get(column.name, NUMBER)
        found[column.name] = with_description(told, schema) if told else schema
    return found


def hull_plates_schema() -> Schema:
    """Give the JSON Schema (draft 2020-12) of plates of a hull.

    Examples
    --------
    >>> from assoc_hull.io.tables.hull_plates import hull_plates_schema
    >>> hull_plates_schema()["required"][:4]
    ['format', 'schema', 'units', 'seams']
    """
    ends: Schema = {"type": "array", "minItems": 2, "maxItems": 2, "items": _MAYBE}
    vector = list_of(REAL, 3, 3)
    plate = closed_object(
        {
            **_columns(),
            "ranges": closed_object(
                {axis: with_description("m; null: no seam there", ends) for axis in AXES}
            ),
            "blocks": with_description("of the surface", list_of(NAME).schema),
            "axes": with_description(
                "e1, e2, e3 as rows", {"type": "array", "items": vector.schema}
            ),
            "roll_direction": with_description(
                "a unit vector; null: there is none", or_none(vector).schema
            ),
            "notes": list_of(NAME).schema,
        }
    )
    seams = {axis: with_description("m", list_of(REAL).schema) for axis in AXES}
    options = closed_object(
        {
            "breadth": with_description("m", POSITIVE.schema),
            "sagitta_tol": with_description("m", POSITIVE.schema),
            "sagitta_length": with_description("m; null: the breadth", or_none(POSITIVE).schema),
            "share": with_description(
                "part of its area that makes the class of a plate", POSITIVE.schema
            ),
        }
    )
    search = closed_object(
        {
            "zero": with_description(
                "how the band was given", one_of(("strain", "absolute")).schema
            ),
            "strain_tol": or_none(POSITIVE).schema,
            "k0": with_description("1/m2", POSITIVE.schema),
        }
    )
    parts = {
        "units": closed_object({column.name: {"const": column.unit} for column in COLUMNS}),
        "seams": closed_object({**seams, "inside": TRUTH.schema}),
        "search": search,
        "options": options,
        "fits": with_description("with so many other fits curvature was compared", _WHOLE),
        "patches": with_description(
            "Bezier patches", closed_object({"all": _WHOLE, "computed": _WHOLE})
        ),
        "plates": {"type": "array", "minItems": 1, "items": plate},
        "notes": list_of(NAME).schema,
        "caveat": NAME.schema,
    }
    return document_schema(FORMAT, SCHEMA, "Plates of a hull, by their curvature", parts)
