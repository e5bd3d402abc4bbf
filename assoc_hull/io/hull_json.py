"""The canonical text of a hull, `.hull.json`, and its JSON Schema.

The same hull gives the same bytes, so that texts can be compared line by line: every group, line,
curve and point stands on a line of its own, sorted by key, and floats are the shortest decimals
that read back to the same bits. Reading puts the stored values back and compares the fingerprint;
nothing is recomputed. The schema ships as ``hull_json.schema.json``.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, NoReturn

from assoc_hull.arguments import once, regular_file, shown
from assoc_hull.errors import AssocHullError, BadInputError
from assoc_hull.io.tables.json_schema import DIALECT, FINGERPRINT, dumps_schema
from assoc_hull.io.write_file import write_whole
from assoc_hull.model.definition.fingerprint import fingerprint
from assoc_hull.model.definition.records import DEFINITION, PUBLISHED, definition, published
from assoc_hull.model.definition.restore import from_definition
from assoc_hull.model.tables import HullState

__all__ = [
    "FORMAT",
    "SCHEMA",
    "dumps_hull_json",
    "dumps_hull_schema",
    "hull_json_schema",
    "read_hull_json",
    "readable_text",
    "write_hull_json",
]

# --------------------------------------------------------------------------------------
# The text: one JSON document, UTF-8, with these keys in this order::
#
#     format       "assoc-hull"
#     schema       version of this form, a whole number; this module reads and writes 1
#     fingerprint  SHA-256 of definition and published values
#     definition   see `assoc_hull.model.definition.records.definition`
#     published    see `assoc_hull.model.definition.records.published`

SCHEMA = 1
"""Version of the form that is written and read."""

FORMAT = "assoc-hull"
"""What the document says it is."""

_KEYS = ("format", "schema", "fingerprint", "definition", "published")
_AGAIN = "take the file from where it was written, or write it anew"


def dumps_hull_json(state: HullState) -> str:
    """Give the canonical text of a hull; it ends with a newline.

    Raises
    ------
    BadInputError
        If the hull holds a number that is not finite, or a name that is no text.
    """
    document = {
        "format": FORMAT,
        "schema": SCHEMA,
        "fingerprint": fingerprint(state),
        "definition": definition(state),
        "published": published(state),
    }
    try:
        text = "".join(_lines(document, 0, 2)) + "\n"
        text.encode()
    except UnicodeEncodeError as error:
        raise BadInputError(
            f"a name holds {error.object[error.start]!r}, which is no character",
            f"in the hull {state.particulars.name!r}",
            "choose another name",
        ) from error
    except ValueError as error:
        raise BadInputError(
            "a number is not finite", f"in the hull {state.particulars.name!r}", "verify the hull"
        ) from error
    return text


def _lines(value: object, depth: int, opened: int) -> Iterator[str]:
    """Lay out a value: containers are opened to lines down to a depth, then stay on one."""
    pad = "\n" + " " * (depth + 1)
    if isinstance(value, Mapping) and depth < opened:
        for index, (key, item) in enumerate(value.items()):
            inner = opened + 1 if key in ("curves", "points") and depth == 1 else opened
            yield f"{',' if index else '{'}{pad}{_compact(key)}: "
            yield from _lines(item, depth + 1, inner)
        yield "\n" + " " * depth + "}" if value else "{}"
    elif isinstance(value, list) and depth <= opened and any(map(_large, value)):
        for index, item in enumerate(value):
            yield f"{',' if index else '['}{pad}{_compact(item)}"
        yield "\n" + " " * depth + "]"
    else:
        yield _compact(value)


def _large(value: object) -> bool:
    return isinstance(value, (dict, list))


def _compact(value: object) -> str:
    return json.dumps(value, ensure_ascii=False, allow_nan=False, separators=(", ", ": "))


def write_hull_json(state: HullState, path: str | os.PathLike[str]) -> None:
    """Write the canonical text of a hull; the file is replaced whole or not at all.

    Parameters
    ----------
    state : HullState
        The hull.
    path : path
        The file; its folder must exist.

    Raises
    ------
    BadInputError
        If the file cannot be written, or the hull holds a number that is not finite.
    """
    write_whole(path, readable_text(state).encode())


def readable_text(state: HullState) -> str:
    """Give the canonical text of a hull, which has been read back.

    Raises
    ------
    BadInputError
        The tables contradict one another, as those of a file that was changed by other hands
        may, so that no text of theirs can be read.
    """
    text = dumps_hull_json(state)
    try:
        _read(text, "the text")
    except BadInputError as error:
        where = f"in the hull {state.particulars.name!r}: {error.where}"
        raise BadInputError(error.what, where, "check the hull, and undo what is wrong") from error
    return text


def read_hull_json(source: str | os.PathLike[str]) -> HullState:
    """Read a hull back; nothing is recomputed, and the fingerprint must agree.

    Parameters
    ----------
    source : path or str
        A file, or the text itself: a string that begins with a brace.

    Returns
    -------
    HullState

    Raises
    ------
    BadInputError
        With file, place, what is wrong and the remedy.
    """
    if isinstance(source, str) and source.lstrip()[:1] == "{":
        return _read(source, "the text")
    path = Path(source)
    return _read(_text(path), str(path))


def _text(path: Path) -> str:
    """Read a file as text."""
    if path.is_dir():
        raise BadInputError("this is a folder", f"at {path}", "give the name of a .hull.json file")
    try:
        return regular_file(path).read_bytes().decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise BadInputError(
            f"byte {error.start} is no UTF-8 text", f"in {path}", "give a .hull.json file"
        ) from error
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise BadInputError(
            f"the file cannot be read ({reason})", f"at {path}", "check name and permissions"
        ) from error


def _read(text: str, name: str) -> HullState:
    document = _parse(text, name)
    _check_head(document, name)
    try:
        state = from_definition(document["definition"], document["published"])
    except BadInputError as error:
        raise BadInputError(error.what, f"{error.where} of {name}", error.remedy) from error
    except AssocHullError as error:
        raise BadInputError(str(error), f"in {name}", _AGAIN) from error
    found = fingerprint(state)
    if found != document["fingerprint"]:
        raise BadInputError(
            f"the content has the fingerprint {found[:12]}, the file says "
            f"{str(document['fingerprint'])[:12]}",
            f"in {name}, at 'fingerprint'",
            "it was changed after it was written: " + _AGAIN,
        )
    return state


def _parse(text: str, name: str) -> dict[str, Any]:
    try:
        found = json.loads(text, object_pairs_hook=once, parse_constant=_not_finite)
    except json.JSONDecodeError as error:
        where = f"in {name}, line {error.lineno}, column {error.colno}"
        raise BadInputError(f"this is no JSON ({error.msg})", where, _AGAIN) from error
    except (ValueError, RecursionError) as error:
        raise BadInputError(f"this is no hull ({error})", f"in {name}", _AGAIN) from error
    if not isinstance(found, dict):
        raise BadInputError("this is no JSON object", f"in {name}", "give a .hull.json file")
    return found


def _not_finite(text: str) -> NoReturn:
    raise ValueError(f"{text} is no finite number")


def _check_head(document: dict[str, Any], name: str) -> None:
    """Check format, version and the keys of the top level."""
    if document.get("format") != FORMAT:
        raise BadInputError(
            f"'format' is {shown(document.get('format'))}, not {FORMAT!r}", f"in {name}", _AGAIN
        )
    schema = document.get("schema")
    if type(schema) is not int or schema != SCHEMA:
        raise BadInputError(
            f"'schema' is {shown(schema)}, and this version reads {SCHEMA}",
            f"in {name}",
            "open it with the version of assoc-hull that wrote it",
        )
    for key in (*_KEYS, *document):
        if key not in document or key not in _KEYS:
            state = "missing" if key in _KEYS else "unknown"
            raise BadInputError(f"the key {key!r} is {state}", f"in {name}", _AGAIN)
    for key in ("definition", "published"):
        if not isinstance(document[key], dict):
            raise BadInputError(f"{key!r} is no JSON object", f"in {name}", _AGAIN)


# --------------------------------------------------------------------------------------
# The schema, made of the tables by which the reader checks a hull. What it cannot say, the reader
# still checks: that the fingerprint agrees, that keys refer to something and come once, that lists
# of one curve are of one length, and that 1.0 is no whole number. ``assoc-hull schema`` prints it.


def hull_json_schema() -> dict[str, Any]:
    """Give the JSON Schema (draft 2020-12) of the canonical text of a hull.

    Examples
    --------
    >>> from assoc_hull.io.hull_json import hull_json_schema
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


def dumps_hull_schema() -> str:
    """Give the JSON Schema of a hull as text; it ends with a newline."""
    return dumps_schema(hull_json_schema())
