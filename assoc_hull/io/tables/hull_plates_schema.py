"""The JSON Schema of plates of a hull.

The same text ships beside this module as ``hull_plates.schema.json``; ``assoc-hull schema --of
hull-plates`` prints it.
"""

from __future__ import annotations

from assoc_hull.io.tables.hull_plates_file import FORMAT, SCHEMA
from assoc_hull.io.tables.json_schema import NUMBER, Schema, closed, document, told_as
from assoc_hull.model.value_schema import NAME, POSITIVE, REAL, TEXT, TRUTH, listed, one_of, or_none
from assoc_hull.surface.plates.hull_plate_table import COLUMNS
from assoc_hull.surface.plates.hull_seams import AXES
from assoc_hull.surface.plates.plate_class import KINDS

__all__ = ["hull_plates_schema"]

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
    "kind": "null: net too coarse for regions, or unresolved",
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
        found[column.name] = told_as(told, schema) if told else schema
    return found


def hull_plates_schema() -> Schema:
    """Give the JSON Schema (draft 2020-12) of plates of a hull.

    Examples
    --------
    >>> from assoc_hull.io.tables.hull_plates_schema import hull_plates_schema
    >>> hull_plates_schema()["required"][:4]
    ['format', 'schema', 'units', 'seams']
    """
    ends: Schema = {"type": "array", "minItems": 2, "maxItems": 2, "items": _MAYBE}
    vector = listed(REAL, 3, 3)
    plate = closed(
        {
            **_columns(),
            "ranges": closed({axis: told_as("m; null: no seam there", ends) for axis in AXES}),
            "blocks": told_as("of the surface", listed(NAME).schema),
            "axes": told_as("e1, e2, e3 as rows", {"type": "array", "items": vector.schema}),
            "roll_direction": told_as("a unit vector; null: there is none", or_none(vector).schema),
            "notes": listed(NAME).schema,
        }
    )
    seams = {axis: told_as("m", listed(REAL).schema) for axis in AXES}
    options = closed(
        {
            "breadth": told_as("m", POSITIVE.schema),
            "sagitta_tol": told_as("m", POSITIVE.schema),
            "sagitta_length": told_as("m; null: the breadth", or_none(POSITIVE).schema),
            "share": told_as("part of its area that makes the class of a plate", POSITIVE.schema),
        }
    )
    search = closed(
        {
            "zero": told_as("how the band was given", one_of(("strain", "absolute")).schema),
            "strain_tol": or_none(POSITIVE).schema,
            "k0": told_as("1/m2", POSITIVE.schema),
        }
    )
    parts = {
        "units": closed({column.name: {"const": column.unit} for column in COLUMNS}),
        "seams": closed({**seams, "inside": TRUTH.schema}),
        "search": search,
        "options": options,
        "fits": told_as("with so many other fits curvature was compared", _WHOLE),
        "patches": told_as("Bezier patches", closed({"all": _WHOLE, "computed": _WHOLE})),
        "plates": {"type": "array", "minItems": 1, "items": plate},
        "notes": listed(NAME).schema,
        "caveat": NAME.schema,
    }
    return document(FORMAT, SCHEMA, "Plates of a hull, by their curvature", parts)
