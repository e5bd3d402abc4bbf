"""Plates as a table (CSV) or a document (JSON), its schemas, and flat plates as CSV.

Names and units are those of the Python objects. Plates of single surfaces and those of a hull have
columns of their own, so documents of two forms, whose schemas ship as ``plates.schema.json`` and
``hull_plates.schema.json``.

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
from collections.abc import Iterable, Sequence
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
from assoc_hull.surface.plating.hull_plates import HullPlateTable
from assoc_hull.surface.plating.hull_seams import AXES
from assoc_hull.surface.plating.plate import Plate
from assoc_hull.surface.plating.plate_class import CAVEAT, KINDS
from assoc_hull.surface.plating.plate_table import COLUMNS, HULL_COLUMNS, PlateColumn, PlateTable
from assoc_hull.surface.regions.level_lines import RegionAreas
from assoc_hull.surface.regions.options import MODES
from assoc_hull.surface.regions.result import RegionResult

__all__ = [
    "FORMAT",
    "HULL_FORMAT",
    "SCHEMA",
    "development_csv",
    "hull_plates_schema",
    "plates_csv",
    "plates_document",
    "plates_json",
    "plates_schema",
    "write_plates",
]

# --------------------------------------------------------------------------------------
# Tables and documents.

FORMAT, HULL_FORMAT, SCHEMA = "assoc-hull plates", "assoc-hull hull plates", 1

_ENDINGS = {".csv": "csv", ".json": "json"}
_FLAT = ("plate", "row", "column", "u", "v", "x", "y", "z", "flat_x", "flat_y", "along", "across")
_FLAT_UNITS = ("", "", "", "", "", "m", "m", "m", "m", "m", "", "")


def write_plates(plates: PlateTable, path: str | os.PathLike[str], form: str | None = None) -> None:
    """Write plates as a table or a document, by the ending of the name.

    Parameters
    ----------
    plates : PlateTable
        The plates, of single surfaces or of a hull.
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
    return rows_csv(plates.columns, plates.table())


def plates_json(plates: PlateTable) -> str:
    """Lay out plates as JSON text; it ends with a newline."""
    return json.dumps(plates_document(plates), indent=1, allow_nan=False) + "\n"


def plates_document(plates: PlateTable) -> dict[str, Any]:
    """Give plates as JSON says it; null where a plate has no such number."""
    hull = plates if isinstance(plates, HullPlateTable) else None
    options = {
        field.name: json_value(getattr(plates.options, field.name))
        for field in attrs.fields(type(plates.options))
        if field.name != "suggestions"
    }
    rows = zip(plates, plates.table(), strict=True)
    return {
        "format": HULL_FORMAT if hull else FORMAT,
        "schema": SCHEMA,
        "units": {column.name: column.unit for column in plates.columns},
        **({"seams": _seams(hull)} if hull else {}),
        "search": _search(plates.results[0], hull is None),
        "options": options,
        **(_fits(hull) if hull else {}),
        "plates": [_document(plate, row) for plate, row in rows],
        "notes": list(plates.notes),
        "caveat": CAVEAT,
    }


def _seams(hull: HullPlateTable) -> dict[str, Any]:
    """Give what cuts a hull."""
    places = {axis: list(getattr(hull.seams, axis)) for axis in AXES}
    return {**places, "inside": hull.seams.inside}


def _fits(hull: HullPlateTable) -> dict[str, Any]:
    """Give with how many fits curvature was compared, and on how many patches."""
    return {
        "fits": hull.fits,
        "patches": {"all": hull.regions.count, "computed": hull.computed},
    }


def _search(result: RegionResult, own: bool) -> dict[str, Any]:
    """Give what counted as no curvature, and the limits of a search with `own` limits."""
    band = {"zero": result.band.mode, "strain_tol": result.band.strain_tol}
    if not own:
        return {**band, "k0": result.band.k0}
    return {
        **band, "delta": result.band.delta, "area_tol": result.options.area_tol,
        "depth": result.options.depth, "budget": result.options.budget,
    }  # fmt: skip


def _document(plate: Plate, row: dict[str, Any]) -> dict[str, Any]:
    """Give one plate: its row, its areas or its place on a hull, and the axis in space."""
    direction = None if plate.roll_direction is None else plate.roll_direction.tolist()
    found = {name: json_value(value) for name, value in row.items()}
    more: dict[str, Any]
    if plate.extent is None:
        areas = attrs.asdict(plate.areas)
        more = {"areas": {name: json_value(value) for name, value in areas.items()}}
    else:
        ends = {axis: getattr(plate.extent.range, axis) for axis in AXES}
        more = {
            "ranges": {axis: [json_value(end) for end in each] for axis, each in ends.items()},
            "blocks": list(plate.blocks),
            "axes": plate.axes.tolist(),
        }
    return {**found, **more, "roll_direction": direction, "notes": list(plate.notes)}


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
# The schemas, which ship beside this module; ``assoc-hull schema --of plates`` prints one of them,
# ``--of hull-plates`` the other.

_WHOLE: Schema = {"type": "integer", "minimum": 0}
_MAYBE: Schema = {"type": ["number", "null"]}

_OTHER: dict[str, Schema] = {
    "name": TEXT.schema, "range": NAME.schema, "kind": one_of(KINDS).schema,
    "order": one_of((1, 2, 3)).schema, "lines": _WHOLE, "rollable": TRUTH.schema,
    "heating": TRUTH.schema, "suggestion": NAME.schema, "dk": _MAYBE, "roll_axis": _MAYBE,
    "coherence": _MAYBE, "least_radius": _MAYBE, "largest_radius": _MAYBE,
}  # fmt: skip
"""Columns that are more, or less, than a number."""

_HULL_OTHER = _OTHER | {
    "kind": or_none(one_of(KINDS)).schema, "order": or_none(one_of((1, 2, 3))).schema,
}  # fmt: skip
"""A plate of a hull may have no class."""

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

_HULL_TOLD = _TOLD | dict.fromkeys(("least_radius", "largest_radius", "area_error"), "") | {
    "dk": "what K changes by between fits, on 95 % of the plate; null: no other fit",
    "unresolved": "part of the area beside borders of blocks",
    "contested": "part of the area with K0/2 <= |K| <= 2 K0",
    "changed": "part of the area that another fit tells otherwise",
    "kind": "of the fitted surface, in doubt where contested + changed > 20 %; null: unresolved",
    "order": "1 flat, 2 bent one way, 3 bent both ways; null: no class",
}  # fmt: skip


def plates_schema() -> Schema:
    """Give the JSON Schema (draft 2020-12) of plates of single surfaces.

    Examples
    --------
    >>> from assoc_hull.io.tables.plates import plates_schema
    >>> plates_schema()["required"][:5]
    ['format', 'schema', 'units', 'search', 'options']
    """
    areas = closed_object(
        {field.name: with_description("m2", NUMBER) for field in attrs.fields(RegionAreas)}
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
    breadth = with_description("m; null: that of each plate", or_none(POSITIVE).schema)
    parts = {
        "units": _units(COLUMNS),
        "search": search,
        "options": _options(breadth),
        **_plates(_columns(COLUMNS, _OTHER, _TOLD), {"areas": areas}),
    }
    return document_schema(FORMAT, SCHEMA, "Plates of a shell, by their curvature", parts)


def hull_plates_schema() -> Schema:
    """Give the JSON Schema (draft 2020-12) of plates of a hull.

    Examples
    --------
    >>> from assoc_hull.io.tables.plates import hull_plates_schema
    >>> hull_plates_schema()["required"][:4]
    ['format', 'schema', 'units', 'seams']
    """
    ends: Schema = {"type": "array", "minItems": 2, "maxItems": 2, "items": _MAYBE}
    places = with_description("m; null: no seam there", ends)
    axes: Schema = {"type": "array", "items": list_of(REAL, 3, 3).schema}
    more = {
        "ranges": closed_object(dict.fromkeys(AXES, places)),
        "blocks": with_description("of the surface", list_of(NAME).schema),
        "axes": with_description("e1, e2, e3 as rows", axes),
    }
    seams = dict.fromkeys(AXES, with_description("m", list_of(REAL).schema))
    modes = one_of(("strain", "absolute")).schema
    search = closed_object(
        {
            "zero": with_description("how the band was given", modes),
            "strain_tol": or_none(POSITIVE).schema,
            "k0": with_description("1/m2", POSITIVE.schema),
        }
    )
    patches = closed_object({"all": _WHOLE, "computed": _WHOLE})
    parts = {
        "units": _units(HULL_COLUMNS),
        "seams": closed_object({**seams, "inside": TRUTH.schema}),
        "search": search,
        "options": _options(with_description("m", POSITIVE.schema)),
        "fits": with_description("with so many other fits curvature was compared", _WHOLE),
        "patches": with_description("Bezier patches", patches),
        **_plates(_columns(HULL_COLUMNS, _HULL_OTHER, _HULL_TOLD), more),
    }
    return document_schema(HULL_FORMAT, SCHEMA, "Plates of a hull, by their curvature", parts)


def _units(columns: Sequence[PlateColumn]) -> Schema:
    return closed_object({column.name: {"const": column.unit} for column in columns})


def _options(breadth: Schema) -> Schema:
    """Give the schema of the options, by that of the breadth."""
    part = "part of its area that makes the class of a plate"
    return closed_object(
        {
            "breadth": breadth,
            "sagitta_tol": with_description("m", POSITIVE.schema),
            "sagitta_length": with_description("m; null: the breadth", or_none(POSITIVE).schema),
            "share": with_description(part, POSITIVE.schema),
        }
    )


def _columns(
    columns: Sequence[PlateColumn], other: dict[str, Schema], told: dict[str, str]
) -> dict[str, Schema]:
    """Give the schema of each column, with its unit."""
    found = {}
    for column in columns:
        words = ", ".join(word for word in (told.get(column.name, ""), column.unit) if word)
        schema = other.get(column.name, NUMBER)
        found[column.name] = with_description(words, schema) if words else schema
    return found


def _plates(columns: dict[str, Schema], more: dict[str, Schema]) -> dict[str, Schema]:
    """Give the schemas of plates, which have columns and more, of notes and of the caveat."""
    direction = or_none(list_of(REAL, 3, 3)).schema
    plate = closed_object(
        {
            **columns,
            **more,
            "roll_direction": with_description("a unit vector; null: there is none", direction),
            "notes": list_of(NAME).schema,
        }
    )
    return {
        "plates": {"type": "array", "minItems": 1, "items": plate},
        "notes": list_of(NAME).schema,
        "caveat": NAME.schema,
    }
