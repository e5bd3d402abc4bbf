"""The JSON Schema of `.hull.json`, made of the tables by which the reader checks a hull.

It says all that can be said of the form. What it cannot say, the reader still checks: that the
fingerprint agrees, that keys refer to something and come once, that lists of one curve are of
one length, and that 1.0 is no whole number.

The same text ships beside this module as ``hull_json.schema.json``, for programs that take a
file; ``assoc-hull schema`` prints it.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

from assoc_hull.io.hull_json import FORMAT, SCHEMA
from assoc_hull.model.definition.schema import DEFINITION, PUBLISHED

__all__ = ["DIALECT", "FINGERPRINT", "dumps_hull_schema", "dumps_schema", "hull_json_schema"]

DIALECT = "https://json-schema.org/draft/2020-12/schema"

FINGERPRINT = {
    "description": "SHA-256 of definition and published values",
    "type": "string",
    "pattern": "^[0-9a-f]{64}$",
}
"""The schema of a fingerprint."""


def hull_json_schema() -> dict[str, Any]:
    """Give the JSON Schema (draft 2020-12) of the canonical text of a hull.

    Examples
    --------
    >>> from assoc_hull.io.hull_schema import hull_json_schema
    >>> hull_json_schema()["required"]
    ['format', 'schema', 'fingerprint', 'definition', 'published']
    """
    parts = {
        "format": {"const": FORMAT},
        "schema": {"const": SCHEMA, "description": "version of this form"},
        "fingerprint": FINGERPRINT,
        "definition": {"description": "what the designer decided", **DEFINITION.schema},
        "published": {"description": "what was made of it, by key", **PUBLISHED.schema},
    }
    return {
        "$schema": DIALECT,
        "title": "assoc-hull hull",
        "description": "The canonical text of a ship hull, .hull.json",
        "type": "object",
        "properties": parts,
        "required": list(parts),
        "additionalProperties": False,
    }


def dumps_schema(schema: Mapping[str, Any]) -> str:
    """Give a JSON Schema as text; it ends with a newline."""
    return json.dumps(schema, indent=1) + "\n"


def dumps_hull_schema() -> str:
    """Give the JSON Schema of a hull as text; it ends with a newline."""
    return dumps_schema(hull_json_schema())
