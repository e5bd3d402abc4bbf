"""Forms of plain values: each checks a value, and says the same as a JSON Schema.

Forms of lists and records are made of those of their parts. As check and schema of a form are
made side by side, a document that a program validates is one that the reader takes.

Examples
--------
>>> from assoc_hull.model.value_schema import list_of, REAL
>>> list_of(REAL, 1).schema["minItems"]
1
>>> list_of(REAL, 1).check([])
Traceback (most recent call last):
...
assoc_hull.model.value_schema.WrongValueError: the list holds 0 items, not 1 or more
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Mapping
from typing import cast

import attrs

from assoc_hull.arguments import shown

__all__ = [
    "COUNT",
    "INDEX",
    "NAME",
    "NOT_NEGATIVE",
    "POSITIVE",
    "REAL",
    "TEXT",
    "TRUTH",
    "ValueSchema",
    "WrongValueError",
    "described",
    "list_of",
    "mapping_of",
    "one_of",
    "or_none",
    "record",
    "tuple_of",
]

Schema = dict[str, object]

_LARGEST_COUNT = 2**53
_LARGEST = 1e12
"""No number of a hull is larger (m, or a slope); its squares must not leave the floats."""
_LARGEST_SIZE = 1e6
"""No dimension or tolerance of a hull is larger, m."""


class WrongValueError(Exception):
    """What is wrong, and the way to it, innermost step last."""

    def __init__(self, what: str) -> None:
        super().__init__(what)
        self.what = what
        self.path: list[str] = []


@attrs.frozen(eq=False)
class ValueSchema:
    """What a value may be.

    Attributes
    ----------
    check : callable
        Takes a value and raises `WrongValueError` if it does not fit.
    schema : dict
        The same as a JSON Schema.
    """

    check: Callable[[object], None]
    schema: Schema


def _text(value: object) -> None:
    if not isinstance(value, str):
        raise WrongValueError(f"{shown(value)} is no text")


def _name(value: object) -> None:
    _text(value)
    if not value:
        raise WrongValueError("the text is empty")


def _truth(value: object) -> None:
    if not isinstance(value, bool):
        raise WrongValueError(f"{shown(value)} is neither true nor false")


def _real(value: object) -> None:
    if type(value) is float and -_LARGEST <= value <= _LARGEST:
        return  # at once: a hull has many thousands of these
    if type(value) is not float and type(value) is not int:
        raise WrongValueError(f"{shown(value)} is no number")
    try:
        finite = math.isfinite(value)
    except OverflowError:
        finite = False
    if not finite:
        raise WrongValueError(f"{shown(value)} is not a finite number")
    if abs(value) > _LARGEST:
        raise WrongValueError(f"{shown(value)} is larger than any number of a hull")


def _not_negative(value: object) -> None:
    _real(value)
    if not 0.0 <= cast(float, value) <= _LARGEST_SIZE:
        raise WrongValueError(f"{shown(value)} is not from 0 to {_LARGEST_SIZE:g}")


def _positive(value: object) -> None:
    _not_negative(value)
    if not cast(float, value) > 0.0:
        raise WrongValueError(f"{shown(value)} is not above 0")


def _count(value: object) -> None:
    if type(value) is not int or not 1 <= value <= _LARGEST_COUNT:
        raise WrongValueError(f"{shown(value)} is no whole number from 1 up")


def _index(value: object) -> None:
    if type(value) is not int or not 0 <= value <= _LARGEST_COUNT:
        raise WrongValueError(f"{shown(value)} is no whole number from 0 up")


TEXT = ValueSchema(_text, {"type": "string"})
NAME = ValueSchema(_name, {"type": "string", "minLength": 1})
TRUTH = ValueSchema(_truth, {"type": "boolean"})
REAL = ValueSchema(_real, {"type": "number", "minimum": -_LARGEST, "maximum": _LARGEST})
NOT_NEGATIVE = ValueSchema(
    _not_negative, {"type": "number", "minimum": 0, "maximum": _LARGEST_SIZE}
)
POSITIVE = ValueSchema(
    _positive, {"type": "number", "exclusiveMinimum": 0, "maximum": _LARGEST_SIZE}
)
COUNT = ValueSchema(_count, {"type": "integer", "minimum": 1, "maximum": _LARGEST_COUNT})
INDEX = ValueSchema(_index, {"type": "integer", "minimum": 0, "maximum": _LARGEST_COUNT})


def described(form: ValueSchema, description: str) -> ValueSchema:
    """Give a form with a description in its schema."""
    return attrs.evolve(form, schema={"description": description, **form.schema})


def one_of(values: Collection[object]) -> ValueSchema:
    """Give the form of a value that is one of some words or numbers."""

    def check(value: object) -> None:
        if isinstance(value, (list, dict)) or value not in values or isinstance(value, bool):
            raise WrongValueError(f"{shown(value)} is none of {', '.join(map(str, values))}")

    return ValueSchema(check, {"enum": list(values)})


def or_none(inner: ValueSchema) -> ValueSchema:
    """Give the form of a value that may be missing."""

    def check(value: object) -> None:
        if value is not None:
            inner.check(value)

    return ValueSchema(check, {"anyOf": [{"type": "null"}, inner.schema]})


def list_of(inner: ValueSchema, least: int = 0, most: int | None = None) -> ValueSchema:
    """Give the form of a list of so many items."""
    each = inner.check

    def check(value: object) -> None:
        _long(value, least, most)
        index = 0
        try:
            for index, item in enumerate(cast("list[object]", value)):  # noqa: B007
                each(item)
        except WrongValueError as wrong:
            wrong.path.append(f"[{index}]")
            raise

    schema: Schema = {"type": "array", "items": inner.schema}
    if least:
        schema["minItems"] = least
    if most is not None:
        schema["maxItems"] = most
    return ValueSchema(check, schema)


def _long(value: object, least: int, most: int | None) -> None:
    """Check that a value is a list of so many items."""
    if not isinstance(value, list):
        raise WrongValueError(f"{shown(value)} is no list")
    if len(value) < least or (most is not None and len(value) > most):
        wanted = f"{least} or more" if most is None else f"{least} to {most}"
        wanted = f"{least}" if least == most else wanted
        raise WrongValueError(f"the list holds {len(value)} items, not {wanted}")


def tuple_of(*inner: ValueSchema) -> ValueSchema:
    """Give the form of a list with a form for each of its items."""
    checks = [each.check for each in inner]

    def check(value: object) -> None:
        _long(value, len(checks), len(checks))
        index = 0
        try:
            for index, item in enumerate(cast("list[object]", value)):
                checks[index](item)
        except WrongValueError as wrong:
            wrong.path.append(f"[{index}]")
            raise

    parts = [each.schema for each in inner]
    size = {"minItems": len(inner), "maxItems": len(inner)}
    return ValueSchema(check, {"type": "array", "prefixItems": parts, **size})


def mapping_of(inner: ValueSchema) -> ValueSchema:
    """Give the form of a mapping from any text."""

    def check(value: object) -> None:
        if not isinstance(value, dict):
            raise WrongValueError(f"{shown(value)} is no mapping")
        for key, item in value.items():
            _text(key)
            try:
                inner.check(item)
            except WrongValueError as wrong:
                wrong.path.append(f"[{shown(key)}]")
                raise

    return ValueSchema(check, {"type": "object", "additionalProperties": inner.schema})


def record(
    required: Mapping[str, ValueSchema], optional: Mapping[str, ValueSchema] | None = None
) -> ValueSchema:
    """Give the form of a mapping with given keys."""
    known = {**required, **(optional or {})}
    checks = {key: each.check for key, each in known.items()}

    def check(value: object) -> None:
        if not isinstance(value, dict):
            raise WrongValueError(f"{shown(value)} is no mapping")
        for key in value:
            if key not in known:
                raise WrongValueError(f"the key {shown(key)} is unknown")
        for key in required:
            if key not in value:
                raise WrongValueError(f"the key {key!r} is missing")
        key = ""
        try:
            for key, item in value.items():
                checks[key](item)
        except WrongValueError as wrong:
            wrong.path.append(f".{key}")
            raise

    schema: Schema = {
        "type": "object",
        "properties": {key: each.schema for key, each in known.items()},
        "required": list(required),
        "additionalProperties": False,
    }
    return ValueSchema(check, schema)
