"""The JSON Schemas of the catalogue of form parameters and of the values of a hull.

The same texts ship beside this module as ``form_catalogue.schema.json`` and
``form_parameters.schema.json``; ``assoc-hull schema --of form-catalogue`` prints one. What a
schema cannot say holds good besides: a symbol stands once, and what an entry needs is there.
"""

from __future__ import annotations

from typing import Any

from assoc_hull.analysis.form.tables import TABLES
from assoc_hull.io.form_json import CATALOGUE_FORMAT, SCHEMA, VALUES_FORMAT
from assoc_hull.io.hull_schema import DIALECT, FINGERPRINT
from assoc_hull.model.form import (
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

Schema = dict[str, Any]

_NOTHING: Schema = {"type": "null"}
_NUMBER: Schema = {"type": "number"}
_MAYBE = or_none(NAME).schema


def _told(description: str, schema: Schema) -> Schema:
    return {"description": description, **schema}


def _object(properties: dict[str, Schema], optional: tuple[str, ...] = ()) -> Schema:
    """Give the schema of a mapping with these keys and no others."""
    required = [key for key in properties if key not in optional]
    kind = {"type": "object", "properties": properties, "required": required}
    return {**kind, "additionalProperties": False}


_ENTRY = _object(
    {
        "symbol": _told("under which the catalogue holds it", NAME.schema),
        "ittc": _told("symbol in the ITTC's list, where it has one", _MAYBE),
        "name": _told("in words", NAME.schema),
        "unit": _told("a dash where there is none", NAME.schema),
        "table": _told("part of the catalogue", one_of(TABLES).schema),
        "definition": _told("how it is measured or computed", NAME.schema),
        "datum": _told("from where it counts, which way is plus; a dash: none", NAME.schema),
        "source": _told("paper, book or standard", NAME.schema),
        "needs": _told("symbols; shape: it is measured on the hull", listed(NAME).schema),
        "digits": _told("after the point", {"type": "integer", "minimum": 0, "maximum": 12}),
    }
)

_HEADER = _object(
    {
        "ship": _told("name", TEXT.schema),
        "length": _told("between perpendiculars, m", POSITIVE.schema),
        "breadth": _told("moulded, m", POSITIVE.schema),
        "draught": _told("moulded, of the design, m", POSITIVE.schema),
        "rho": _told("density of the water, t/m3", POSITIVE.schema),
        "shell_factor": _told("displacement over that of the moulded volume", POSITIVE.schema),
        "transom": _told("an immersed transom counts as wetted surface", TRUTH.schema),
        "deck": one_of(("open", "closed")).schema,
        "fingerprint": FINGERPRINT,
        "date": _told("as the caller gave it", _MAYBE),
    }
)

_POSITION = _object(
    {
        "draught_aft": _told("T_A, moulded, m", REAL.schema),
        "draught_fore": _told("T_F, moulded, m", REAL.schema),
        "heel_deg": _told("of an upright ship", {"const": 0}),
    }
)

_SCREW = _object(
    {
        "height": _told("of the shaft above the base line, m", REAL.schema),
        "diameter": _told("m", POSITIVE.schema),
        "x": _told("plane of the screw, from AP, + forward, m", or_none(REAL).schema),
        "spacing": _told("between two shafts, m; 0: one screw", NOT_NEGATIVE.schema),
        "boss_diameter": _told("m", or_none(POSITIVE).schema),
        "boss_x": _told("aft face of the boss, from AP, + forward, m", or_none(REAL).schema),
    }
)


def _value(number: Schema, reason: Schema) -> Schema:
    return _object(
        {
            "number": _told("in the unit", number),
            "unit": _told("a dash where there is none", NAME.schema),
            "definition": _told("symbol of the entry of the catalogue", NAME.schema),
            "reason": _told("why there is no number", reason),
            "warning": _told("what to mind about the number", _MAYBE),
        }
    )


_VALUE: Schema = {"anyOf": [_value(_NUMBER, _NOTHING), _value(_NOTHING, NAME.schema)]}
"""A value has a number, or a reason why there is none."""


def catalogue_schema() -> Schema:
    """Give the JSON Schema (draft 2020-12) of the catalogue.

    Examples
    --------
    >>> from assoc_hull.io.form_schema import catalogue_schema
    >>> catalogue_schema()["required"]
    ['format', 'schema', 'entries']
    """
    entries = {"type": "array", "minItems": 1, "items": _ENTRY}
    about = "Definitions of form parameters of ship hulls"
    return _document(CATALOGUE_FORMAT, about, {"entries": entries})


def form_schema() -> Schema:
    """Give the JSON Schema (draft 2020-12) of the form parameters of a hull.

    Examples
    --------
    >>> from assoc_hull.io.form_schema import form_schema
    >>> form_schema()["required"]
    ['format', 'schema', 'header', 'position', 'even_keel', 'screw', 'doubts', 'values']
    """
    parts = {
        "header": _HEADER,
        "position": _POSITION,
        "even_keel": _told("T_A and T_F are equal; if not, T is their mean", TRUTH.schema),
        "screw": _told("null: not given", {"anyOf": [_NOTHING, _SCREW]}),
        "doubts": _told("what makes the integrals doubtful", listed(NAME).schema),
        "values": _told("by symbol", {"type": "object", "additionalProperties": _VALUE}),
    }
    return _document(VALUES_FORMAT, "Form parameters of a ship hull", parts)


def _document(name: str, about: str, parts: dict[str, Schema]) -> Schema:
    """Give the schema of a document, whose `saved` need not be there."""
    version = _told("version of this form", {"const": SCHEMA})
    saved = _told("files that the command wrote which printed this", listed(NAME).schema)
    keys = {"format": {"const": name}, "schema": version, **parts, "saved": saved}
    whole = _object(keys, optional=("saved",))
    return {"$schema": DIALECT, "title": name, "description": about, **whole}
