"""The JSON Schema of plates of a shell.

The same text ships beside this module as ``plates.schema.json``; ``assoc-hull schema --of plates``
prints it.
"""

from __future__ import annotations

import attrs

from assoc_hull.io.tables.json_schema import NUMBER, Schema, closed, document, told_as
from assoc_hull.io.tables.plates_file import FORMAT, SCHEMA
from assoc_hull.model.value_schema import (
    NAME,
    NOT_NEGATIVE,
    POSITIVE,
    REAL,
    TEXT,
    TRUTH,
    listed,
    one_of,
    or_none,
)
from assoc_hull.surface.plates.plate_class import KINDS
from assoc_hull.surface.plates.plate_table import COLUMNS
from assoc_hull.surface.regions.region_areas import RegionAreas
from assoc_hull.surface.regions.zero_band import MODES

__all__ = ["plates_schema"]

_WHOLE: Schema = {"type": "integer", "minimum": 0}
_MAYBE: Schema = {"type": ["number", "null"]}
_SHARE: Schema = {"type": ["number", "null"]}

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
        found[column.name] = told_as(told, schema) if told else schema
    return found


def plates_schema() -> Schema:
    """Give the JSON Schema (draft 2020-12) of plates of a shell.

    Examples
    --------
    >>> from assoc_hull.io.tables.plates_schema import plates_schema
    >>> plates_schema()["required"][:5]
    ['format', 'schema', 'units', 'search', 'options']
    """
    areas = closed({field.name: told_as("m2", NUMBER) for field in attrs.fields(RegionAreas)})
    plate = closed(
        {
            **_columns(),
            "areas": areas,
            "roll_direction": told_as(
                "a unit vector; null: there is none", or_none(listed(REAL, 3, 3)).schema
            ),
            "notes": listed(NAME).schema,
        }
    )
    search = closed(
        {
            "zero": told_as("how the band was given", one_of(MODES).schema),
            "strain_tol": or_none(POSITIVE).schema,
            "delta": told_as("of control points, m", or_none(NOT_NEGATIVE).schema),
            "area_tol": POSITIVE.schema,
            "depth": _WHOLE,
            "budget": _WHOLE,
        }
    )
    options = closed(
        {
            "breadth": told_as("m; null: that of each plate", or_none(POSITIVE).schema),
            "sagitta_tol": told_as("m", POSITIVE.schema),
            "sagitta_length": told_as("m; null: the breadth", or_none(POSITIVE).schema),
            "share": told_as("part of its area that makes the class of a plate", POSITIVE.schema),
        }
    )
    units = closed({column.name: {"const": column.unit} for column in COLUMNS})
    parts = {
        "units": units,
        "search": search,
        "options": options,
        "plates": {"type": "array", "minItems": 1, "items": plate},
        "notes": listed(NAME).schema,
        "caveat": NAME.schema,
    }
    return document(FORMAT, SCHEMA, "Plates of a shell, by their curvature", parts)
