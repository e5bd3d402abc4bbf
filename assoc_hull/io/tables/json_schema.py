"""What the JSON Schemas of documents are put together from."""

from __future__ import annotations

from typing import Any

from assoc_hull.io.hull_schema import DIALECT
from assoc_hull.model.value_schema import NAME, listed

__all__ = ["NOTHING", "NUMBER", "Schema", "closed", "document", "told_as"]

Schema = dict[str, Any]

NOTHING: Schema = {"type": "null"}
NUMBER: Schema = {"type": "number"}


def told_as(description: str, schema: Schema) -> Schema:
    """Give a schema with words about what it describes.

    Examples
    --------
    >>> from assoc_hull.io.tables.json_schema import NUMBER, told_as
    >>> told_as("m", NUMBER)
    {'description': 'm', 'type': 'number'}
    """
    return {"description": description, **schema}


def closed(properties: dict[str, Schema], optional: tuple[str, ...] = ()) -> Schema:
    """Give the schema of a mapping with these keys and no others.

    Parameters
    ----------
    properties : mapping of str to Schema
        What stands under each key.
    optional : tuple of str
        Keys that need not be there.

    Examples
    --------
    >>> from assoc_hull.io.tables.json_schema import closed, NUMBER
    >>> closed({"x": NUMBER})["required"]
    ['x']
    """
    required = [key for key in properties if key not in optional]
    kind = {"type": "object", "properties": properties, "required": required}
    return {**kind, "additionalProperties": False}


def document(name: str, version: int, about: str, parts: dict[str, Schema]) -> Schema:
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
    >>> from assoc_hull.io.tables.json_schema import document, NUMBER
    >>> document("a number", 1, "One number", {"number": NUMBER})["required"]
    ['format', 'schema', 'number']
    """
    form = told_as("version of this form", {"const": version})
    saved = told_as("files that the command wrote which printed this", listed(NAME).schema)
    keys = {"format": {"const": name}, "schema": form, **parts, "saved": saved}
    whole = closed(keys, optional=("saved",))
    return {"$schema": DIALECT, "title": name, "description": about, **whole}
