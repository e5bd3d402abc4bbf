"""The JSON Schemas of the catalogue of form parameters and of the values of a hull.

The same texts ship beside this module as ``form_catalogue.schema.json`` and
``form_parameters.schema.json``; ``assoc-hull schema --of form-catalogue`` prints one. What a
schema cannot say holds good besides: a symbol stands once, and what an entry needs is there.
"""

from __future__ import annotations

from assoc_hull.analysis.form.tables import TABLES
from assoc_hull.io.hull_schema import FINGERPRINT
from assoc_hull.io.tables.form_json import CATALOGUE_FORMAT, SCHEMA, VALUES_FORMAT
from assoc_hull.io.tables.json_schema import NOTHING, NUMBER, Schema, closed, document, told_as
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

__all__ = ["catalogue_schema", "form_schema"]

_MAYBE = or_none(NAME).schema

_ENTRY = closed(
    {
        "symbol": told_as("under which the catalogue holds it", NAME.schema),
        "ittc": told_as("symbol in the ITTC's list, where it has one", _MAYBE),
        "name": told_as("in words", NAME.schema),
        "unit": told_as("a dash where there is none", NAME.schema),
        "table": told_as("part of the catalogue", one_of(TABLES).schema),
        "definition": told_as("how it is measured or computed", NAME.schema),
        "datum": told_as("from where it counts, which way is plus; a dash: none", NAME.schema),
        "source": told_as("paper, book or standard", NAME.schema),
        "needs": told_as("symbols; shape: it is measured on the hull", listed(NAME).schema),
        "digits": told_as("after the point", {"type": "integer", "minimum": 0, "maximum": 12}),
    }
)

_HEADER = closed(
    {
        "ship": told_as("name", TEXT.schema),
        "length": told_as("between perpendiculars, m", POSITIVE.schema),
        "breadth": told_as("moulded, m", POSITIVE.schema),
        "draught": told_as("moulded, of the design, m", POSITIVE.schema),
        "rho": told_as("density of the water, t/m3", POSITIVE.schema),
        "shell_factor": told_as("displacement over that of the moulded volume", POSITIVE.schema),
        "transom": told_as("an immersed transom counts as wetted surface", TRUTH.schema),
        "deck": one_of(("open", "closed")).schema,
        "fingerprint": FINGERPRINT,
        "date": told_as("as the caller gave it", _MAYBE),
    }
)

_POSITION = closed(
    {
        "draught_aft": told_as("T_A, moulded, m", REAL.schema),
        "draught_fore": told_as("T_F, moulded, m", REAL.schema),
        "heel_deg": told_as("of an upright ship", {"const": 0}),
    }
)

_SCREW = closed(
    {
        "height": told_as("of the shaft above the base line, m", REAL.schema),
        "diameter": told_as("m", POSITIVE.schema),
        "x": told_as("plane of the screw, from AP, + forward, m", or_none(REAL).schema),
        "spacing": told_as("between two shafts, m; 0: one screw", NOT_NEGATIVE.schema),
        "boss_diameter": told_as("m", or_none(POSITIVE).schema),
        "boss_x": told_as("aft face of the boss, from AP, + forward, m", or_none(REAL).schema),
    }
)


def _value(number: Schema, reason: Schema) -> Schema:
    return closed(
        {
            "number": told_as("in the unit", number),
            "unit": told_as("a dash where there is none", NAME.schema),
            "definition": told_as("symbol of the entry of the catalogue", NAME.schema),
            "reason": told_as("why there is no number", reason),
            "warning": told_as("what to mind about the number", _MAYBE),
        }
    )


_VALUE: Schema = {"anyOf": [_value(NUMBER, NOTHING), _value(NOTHING, NAME.schema)]}
"""A value has a number, or a reason why there is none."""


def catalogue_schema() -> Schema:
    """Give the JSON Schema (draft 2020-12) of the catalogue.

    Examples
    --------
    >>> from assoc_hull.io.tables.form_schema import catalogue_schema
    >>> catalogue_schema()["required"]
    ['format', 'schema', 'entries']
    """
    entries = {"type": "array", "minItems": 1, "items": _ENTRY}
    about = "Definitions of form parameters of ship hulls"
    return document(CATALOGUE_FORMAT, SCHEMA, about, {"entries": entries})


def form_schema() -> Schema:
    """Give the JSON Schema (draft 2020-12) of the form parameters of a hull.

    Examples
    --------
    >>> from assoc_hull.io.tables.form_schema import form_schema
    >>> form_schema()["required"]
    ['format', 'schema', 'header', 'position', 'even_keel', 'screw', 'doubts', 'values']
    """
    parts = {
        "header": _HEADER,
        "position": _POSITION,
        "even_keel": told_as("T_A and T_F are equal; if not, T is their mean", TRUTH.schema),
        "screw": told_as("null: not given", {"anyOf": [NOTHING, _SCREW]}),
        "doubts": told_as("what makes the integrals doubtful", listed(NAME).schema),
        "values": told_as("by symbol", {"type": "object", "additionalProperties": _VALUE}),
    }
    return document(VALUES_FORMAT, SCHEMA, "Form parameters of a ship hull", parts)
