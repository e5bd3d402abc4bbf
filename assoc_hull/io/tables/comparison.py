"""The JSON Schema of a comparison of two hulls.

The same text ships beside this module as ``comparison.schema.json``; ``assoc-hull schema --of
comparison`` prints it. What a schema cannot say holds good besides: differences are those of the
numbers beside them.
"""

from __future__ import annotations

from assoc_hull.io.tables.json_schema import (
    FINGERPRINT,
    NULL,
    NUMBER,
    Schema,
    closed_object,
    document_schema,
    with_description,
)
from assoc_hull.model.features import FEATURE_KINDS
from assoc_hull.model.kinds import Sort
from assoc_hull.model.value_schema import (
    NAME,
    NOT_NEGATIVE,
    POSITIVE,
    REAL,
    TEXT,
    list_of,
    mapping_of,
    one_of,
    or_none,
    tuple_of,
)
from assoc_hull.variation.comparing.comparison import COMPARISON_FORMAT, SCHEMA

__all__ = ["comparison_schema"]

_MAYBE = or_none(NAME).schema
_COUNT: Schema = {"type": "integer", "minimum": 0}
_DIGITS: Schema = {"type": "integer", "minimum": 0, "maximum": 12}
_PLACE = tuple_of(REAL, REAL, REAL)

_HULL = closed_object(
    {
        "name": with_description("of the ship", TEXT.schema),
        "length": with_description("between perpendiculars, m", POSITIVE.schema),
        "breadth": with_description("moulded, m", POSITIVE.schema),
        "depth": with_description("moulded, m", POSITIVE.schema),
        "draught": with_description("moulded, of the design, m", POSITIVE.schema),
        "deck": one_of(("open", "closed")).schema,
        "fingerprint": FINGERPRINT,
        "at_draught": with_description(
            "moulded, even keel, at which it was measured, m", REAL.schema
        ),
        "doubts": with_description("what makes its numbers doubtful", list_of(NAME).schema),
    }
)

_SHIFT = closed_object(
    {
        "before": with_description("place on the parent's line, m", _PLACE.schema),
        "after": with_description("place on the variant's, m", _PLACE.schema),
        "plane": with_description(
            "how far the plane went along its normal, m; null: no plane, or turned",
            or_none(REAL).schema,
        ),
        "course": with_description(
            "distance within the plane, or in space, m", NOT_NEGATIVE.schema
        ),
        "vector": with_description("from before to after, m: forward, out, up", _PLACE.schema),
        "length": with_description("of the vector, m", NOT_NEGATIVE.schema),
        "direction": with_description("in words; a dash: not moved", NAME.schema),
    }
)

_FAIRNESS = closed_object(
    {
        "points": with_description("that define the line", _COUNT),
        "sign_changes": with_description("of its curvature, beyond a dead band", _COUNT),
        "comb": with_description("integral of (dk/ds)^2 ds, 1/m3", {**NUMBER, "minimum": 0}),
    }
)


def _maybe(schema: Schema) -> Schema:
    return {"anyOf": [NULL, schema]}


_LINE = closed_object(
    {
        "name": with_description("in the variant; of a line that went, in the parent", NAME.schema),
        "was": with_description("name in the parent; null: it came", _MAYBE),
        "group": with_description("of lines", NAME.schema),
        "what": one_of(("same", "moved", "came", "went")).schema,
        "shift": with_description("the largest; null: in one of both only", _maybe(_SHIFT)),
        "before": with_description("in the parent", _maybe(_FAIRNESS)),
        "after": with_description("in the variant, seen in the parent's planes", _maybe(_FAIRNESS)),
        "comb_ratio": with_description(
            "comb after / before; null: straight both times, or straight before", _maybe(NUMBER)
        ),
    }
)


def _number(before: Schema, after: Schema, difference: Schema, reason: Schema) -> Schema:
    return closed_object(
        {
            "symbol": NAME.schema,
            "title": with_description("in words", NAME.schema),
            "unit": with_description("a dash where there is none", NAME.schema),
            "digits": with_description("after the point", _DIGITS),
            "before": with_description("of the parent", before),
            "after": with_description("of the variant", after),
            "reason": with_description("why one, or both, are missing", reason),
            "difference": with_description("after less before, in the unit", difference),
            "percent": with_description(
                "of the parent's; null: that is nil, or missing", _maybe(NUMBER)
            ),
        }
    )


_NUMBER: Schema = {
    "anyOf": [
        _number(NUMBER, NUMBER, NUMBER, NULL),
        _number(NULL, _maybe(NUMBER), NULL, NAME.schema),
        _number(NUMBER, NULL, NULL, NAME.schema),
    ]
}
"""Both hulls have the number, or there is a reason."""

_COUNTS = closed_object({each.name.lower(): _COUNT for each in Sort})

_POINTS = closed_object(
    {
        "before": with_description("how many the parent has", _COUNTS),
        "after": with_description("how many the variant has", _COUNTS),
        "came": with_description("addresses in the variant", list_of(NAME).schema),
        "went": with_description("addresses in the parent", list_of(NAME).schema),
    }
)

_PARAMETERS = mapping_of(REAL).schema | {"additionalProperties": {"anyOf": [NUMBER, _PLACE.schema]}}

_FEATURE = closed_object(
    {
        "name": NAME.schema,
        "kind": one_of(FEATURE_KINDS).schema,
        "what": one_of(("same", "changed", "came", "went")).schema,
        "before": with_description("parameters in the parent, m", _maybe(_PARAMETERS)),
        "after": with_description("parameters in the variant, m", _maybe(_PARAMETERS)),
    }
)


def _list(items: Schema) -> Schema:
    return {"type": "array", "items": items}


def comparison_schema() -> Schema:
    """Give the JSON Schema (draft 2020-12) of a comparison.

    Examples
    --------
    >>> from assoc_hull.io.tables.comparison import comparison_schema
    >>> comparison_schema()["required"][2:5]
    ['parent', 'variant', 'lines']
    """
    parts = {
        "parent": _HULL,
        "variant": _HULL,
        "lines": with_description("every line of either", _list(_LINE)),
        "hydrostatics": with_description("by the names of the record", _list(_NUMBER)),
        "parameters": with_description("form parameters", _list(_NUMBER)),
        "points": _POINTS,
        "features": with_description("every feature of either", _list(_FEATURE)),
    }
    return document_schema(COMPARISON_FORMAT, SCHEMA, "A parent hull and a variant of it", parts)
