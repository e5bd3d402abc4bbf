"""The JSON Schema of a comparison of two hulls.

The same text ships beside this module as ``comparison.schema.json``; ``assoc-hull schema --of
comparison`` prints it. What a schema cannot say holds good besides: differences are those of the
numbers beside them.
"""

from __future__ import annotations

from assoc_hull.io.hull_schema import FINGERPRINT
from assoc_hull.io.tables.json_schema import NOTHING, NUMBER, Schema, closed, document, told_as
from assoc_hull.model.features import FEATURE_KINDS
from assoc_hull.model.kinds import Sort
from assoc_hull.model.value_schema import (
    NAME,
    NOT_NEGATIVE,
    POSITIVE,
    REAL,
    TEXT,
    listed,
    mapped,
    one_of,
    or_none,
    tuple_of,
)
from assoc_hull.variation.comparing.json import COMPARISON_FORMAT, SCHEMA

__all__ = ["comparison_schema"]

_MAYBE = or_none(NAME).schema
_COUNT: Schema = {"type": "integer", "minimum": 0}
_DIGITS: Schema = {"type": "integer", "minimum": 0, "maximum": 12}
_PLACE = tuple_of(REAL, REAL, REAL)

_HULL = closed(
    {
        "name": told_as("of the ship", TEXT.schema),
        "length": told_as("between perpendiculars, m", POSITIVE.schema),
        "breadth": told_as("moulded, m", POSITIVE.schema),
        "depth": told_as("moulded, m", POSITIVE.schema),
        "draught": told_as("moulded, of the design, m", POSITIVE.schema),
        "deck": one_of(("open", "closed")).schema,
        "fingerprint": FINGERPRINT,
        "at_draught": told_as("moulded, even keel, at which it was measured, m", REAL.schema),
        "doubts": told_as("what makes its numbers doubtful", listed(NAME).schema),
    }
)

_SHIFT = closed(
    {
        "before": told_as("place on the parent's line, m", _PLACE.schema),
        "after": told_as("place on the variant's, m", _PLACE.schema),
        "plane": told_as(
            "how far the plane went along its normal, m; null: no plane, or turned",
            or_none(REAL).schema,
        ),
        "course": told_as("distance within the plane, or in space, m", NOT_NEGATIVE.schema),
        "vector": told_as("from before to after, m: forward, out, up", _PLACE.schema),
        "length": told_as("of the vector, m", NOT_NEGATIVE.schema),
        "direction": told_as("in words; a dash: not moved", NAME.schema),
    }
)

_FAIRNESS = closed(
    {
        "points": told_as("that define the line", _COUNT),
        "sign_changes": told_as("of its curvature, beyond a dead band", _COUNT),
        "comb": told_as("integral of (dk/ds)^2 ds, 1/m3", {**NUMBER, "minimum": 0}),
    }
)


def _maybe(schema: Schema) -> Schema:
    return {"anyOf": [NOTHING, schema]}


_LINE = closed(
    {
        "name": told_as("in the variant; of a line that went, in the parent", NAME.schema),
        "was": told_as("name in the parent; null: it came", _MAYBE),
        "group": told_as("of lines", NAME.schema),
        "what": one_of(("same", "moved", "came", "went")).schema,
        "shift": told_as("the largest; null: in one of both only", _maybe(_SHIFT)),
        "before": told_as("in the parent", _maybe(_FAIRNESS)),
        "after": told_as("in the variant, seen in the parent's planes", _maybe(_FAIRNESS)),
        "comb_ratio": told_as(
            "comb after / before; null: straight both times, or straight before", _maybe(NUMBER)
        ),
    }
)


def _number(before: Schema, after: Schema, difference: Schema, reason: Schema) -> Schema:
    return closed(
        {
            "symbol": NAME.schema,
            "title": told_as("in words", NAME.schema),
            "unit": told_as("a dash where there is none", NAME.schema),
            "digits": told_as("after the point", _DIGITS),
            "before": told_as("of the parent", before),
            "after": told_as("of the variant", after),
            "reason": told_as("why one, or both, are missing", reason),
            "difference": told_as("after less before, in the unit", difference),
            "percent": told_as("of the parent's; null: that is nil, or missing", _maybe(NUMBER)),
        }
    )


_NUMBER: Schema = {
    "anyOf": [
        _number(NUMBER, NUMBER, NUMBER, NOTHING),
        _number(NOTHING, _maybe(NUMBER), NOTHING, NAME.schema),
        _number(NUMBER, NOTHING, NOTHING, NAME.schema),
    ]
}
"""Both hulls have the number, or there is a reason."""

_COUNTS = closed({each.name.lower(): _COUNT for each in Sort})

_POINTS = closed(
    {
        "before": told_as("how many the parent has", _COUNTS),
        "after": told_as("how many the variant has", _COUNTS),
        "came": told_as("addresses in the variant", listed(NAME).schema),
        "went": told_as("addresses in the parent", listed(NAME).schema),
    }
)

_PARAMETERS = mapped(REAL).schema | {"additionalProperties": {"anyOf": [NUMBER, _PLACE.schema]}}

_FEATURE = closed(
    {
        "name": NAME.schema,
        "kind": one_of(FEATURE_KINDS).schema,
        "what": one_of(("same", "changed", "came", "went")).schema,
        "before": told_as("parameters in the parent, m", _maybe(_PARAMETERS)),
        "after": told_as("parameters in the variant, m", _maybe(_PARAMETERS)),
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
        "lines": told_as("every line of either", _list(_LINE)),
        "hydrostatics": told_as("by the names of the record", _list(_NUMBER)),
        "parameters": told_as("form parameters", _list(_NUMBER)),
        "points": _POINTS,
        "features": told_as("every feature of either", _list(_FEATURE)),
    }
    return document(COMPARISON_FORMAT, SCHEMA, "A parent hull and a variant of it", parts)
