"""The JSON Schema of the report of a surface fitted to a hull.

The same text ships beside this module as ``hull_surface.schema.json``; ``assoc-hull schema --of
hull-surface`` prints it.
"""

from __future__ import annotations

from assoc_hull.io.tables.json_schema import NOTHING, NUMBER, Schema, closed, document, told_as
from assoc_hull.model.value_schema import NAME, NOT_NEGATIVE, POSITIVE, REAL, TEXT, listed, one_of
from assoc_hull.surface.blocks.net_report import FORMAT, SCHEMA

__all__ = ["net_surface_schema"]

_WHOLE: Schema = {"type": "integer", "minimum": 0}
_PLACE: Schema = {"anyOf": [NOTHING, listed(REAL, 3, 3).schema]}
_QUANTILES = listed(NOT_NEGATIVE, 3, 3).schema
_OR_NONE: Schema = {"type": ["number", "null"], "minimum": 0}

_SHIP = closed(
    {
        "name": TEXT.schema,
        "length": told_as("between perpendiculars, m", POSITIVE.schema),
        "breadth": told_as("moulded, m", POSITIVE.schema),
        "depth": told_as("m", POSITIVE.schema),
        "draught": told_as("design, m", POSITIVE.schema),
        "deck": one_of(("open", "closed")).schema,
    }
)

_RESIDUALS = closed(
    {
        "kind": one_of(("fitted", "left out")).schema,
        "count": told_as("points of lines", _WHOLE),
        "median": told_as("distance from the surface, m", _OR_NONE),
        "p95": told_as("m", _OR_NONE),
        "p99": told_as("m", _OR_NONE),
        "largest": told_as("m", _OR_NONE),
        "place": told_as("of the largest, m; null: no points", _PLACE),
        "line": told_as("that it is on", TEXT.schema),
    }
)

_BLOCK = closed(
    {
        "name": NAME.schema,
        "kind": one_of(("body", "bow", "stern")).schema,
        "control_points": told_as("in u and in v", {"type": "array", "items": _WHOLE}),
        "spans": told_as("in u and in v", {"type": "array", "items": _WHOLE}),
        "smoothing": told_as("factor of the penalty, m3", NOT_NEGATIVE.schema),
        "limit": told_as("what 95 % of the distances should keep, m", NOT_NEGATIVE.schema),
        "least_element": told_as("least |S_u x S_v|, as a part of the median", NUMBER),
        "singular": told_as(
            "parameters of corners with tangent sides",
            {"type": "array", "items": listed(REAL, 2, 2).schema},
        ),
        "residuals": {"type": "array", "minItems": 1, "items": _RESIDUALS},
        "notes": listed(NAME).schema,
    }
)

_BORDER = closed(
    {
        "names": told_as("the two blocks", listed(NAME, 2, 2).schema),
        "gap": told_as("median, 95 %, largest before joining, m", _QUANTILES),
        "joined_gap": told_as("largest after it, m", NOT_NEGATIVE.schema),
        "angle": told_as("between the normals: median, 95 %, largest, degrees", _QUANTILES),
        "place": told_as("of the largest angle, m", _PLACE),
        "limit": told_as("what the angle should keep, degrees", NOT_NEGATIVE.schema),
    }
)


def net_surface_schema() -> Schema:
    """Give the JSON Schema (draft 2020-12) of the report of a surface.

    Examples
    --------
    >>> from assoc_hull.io.surfaces.net_surface_schema import net_surface_schema
    >>> net_surface_schema()["required"][:4]
    ['format', 'schema', 'ship', 'blocks']
    """
    parts = {
        "ship": _SHIP,
        "blocks": {"type": "array", "minItems": 1, "items": _BLOCK},
        "whole": told_as(
            "all blocks together", {"type": "array", "minItems": 1, "items": _RESIDUALS}
        ),
        "borders": {"type": "array", "items": _BORDER},
        "left_out": told_as("lines that nothing was fitted to", listed(NAME).schema),
        "refitted": told_as("blocks fitted in this call", listed(NAME).schema),
        "notes": listed(NAME).schema,
    }
    return document(FORMAT, SCHEMA, "How a surface fits the lines of a hull", parts)
