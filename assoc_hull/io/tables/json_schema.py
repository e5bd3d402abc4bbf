"""Parts of which the JSON Schemas of all our documents are made, and their text.

Each document says its ``format`` and ``schema`` (a version); mappings are closed. The dialect is
draft 2020-12.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

from assoc_hull.model.value_schema import NAME, list_of

__all__ = [
    "DIALECT",
    "FINGERPRINT",
    "NULL",
    "NUMBER",
    "Schema",
    "closed_object",
    "document_schema",
    "dumps_schema",
    "with_description",
]

DIALECT = "https://json-schema.org/draft/2020-12/schema"

FINGERPRINT = {
    "description": "SHA-256 of definition and published values",
    "type": "string",
    "pattern": "^[0-9a-f]{64}$",
}
"""The schema of a fingerprint."""


def dumps_schema(schema: Mapping[str, Any]) -> str:
    """Give a JSON Schema as text; it ends with a newline."""
    return json.dumps(schema, indent=1) + "\n"


Schema = dict[str, Any]

NULL: Schema = {"type": "null"}
NUMBER: Schema = {"type": "number"}


def with_description(description: str, schema: Schema) -> Schema:
    """Give a schema with words about what it describes.

    Examples
    --------
    >>> from assoc_hull.io.tables.json_schema import NUMBER, with_description
    >>> with_description("m", NUMBER)
    {'description': 'm', 'type': 'number'}
    """
    return {"description": description, **schema}


def closed_object(properties: dict[str, Schema], optional: tuple[str, ...] = ()) -> Schema:
    """Give the schema of a mapping with these keys and no others.

    Parameters
    ----------
    properties : mapping of str to Schema
        What stands under each key.
    optional : tuple of str
        Keys that need not be there.

    Examples
    --------
    >>> from assoc_hull.io.tables.json_schema import closed_object, NUMBER
    >>> closed_object({"x": NUMBER})["required"]
    ['x']
    """
    required = [key for key in properties if key not in optional]
    kind = {"type": "object", "properties": properties, "required": required}
    return {**kind, "additionalProperties": False}


def document_schema(name: str, version: int, about: str, parts: dict[str, Schema]) -> Schema:
    """Give the schema of a document, whose `saved` need not be there.

    Parameters
    ----------
    name : str
        Its `format`.
    version : int
        Its `schema`.
    about : str
        What it is, in words.
    parts : mapping of str to Schema
        What it holds besides.

    Examples
    --------
    >>> from assoc_hull.io.tables.json_schema import document_schema, NUMBER
    >>> document_schema("a number", 1, "One number", {"number": NUMBER})["required"]
    ['format', 'schema', 'number']
    """
    form = with_description("version of this form", {"const": version})
    saved = with_description(
        "files that the command wrote which printed this", list_of(NAME).schema
    )
    keys = {"format": {"const": name}, "schema": form, **parts, "saved": saved}
    whole = closed_object(keys, optional=("saved",))
    return {"$schema": DIALECT, "title": name, "description": about, **whole}
