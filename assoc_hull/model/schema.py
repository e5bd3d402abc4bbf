"""The form of a definition and of published values: which keys, which types, which numbers.

A check is a function that takes a value and raises if it does not fit; checks of lists and
records are made of those of their parts. Only the form is checked here; whether names refer
to something is found when the tables are made.

Examples
--------
>>> from assoc_hull.model.schema import check_definition
>>> check_definition({"particulars": {"name": "S"}})
Traceback (most recent call last):
...
assoc_hull.errors.BadInputError: the key 'tolerances' is missing, in the definition; ...
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Mapping
from typing import cast

import attrs

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import EndKind, PointKind
from assoc_hull.model.definition import words
from assoc_hull.model.family import FAMILIES, BoundaryKind, Role, Sort, State
from assoc_hull.model.state import Particulars
from assoc_hull.tolerance import Tolerances

__all__ = ["check_definition", "check_published"]

Check = Callable[[object], None]

_REMEDY = "take the file from where it was written, or write it anew"
_TEXT = 120
_LARGEST_COUNT = 2**53


class _WrongError(Exception):
    """What is wrong, and the way to it, innermost step last."""

    def __init__(self, what: str) -> None:
        self.what = what
        self.path: list[str] = []


def _shown(value: object) -> str:
    text = repr(value)
    return text if len(text) <= _TEXT else text[:_TEXT] + " ..."


def _text(value: object) -> None:
    if not isinstance(value, str):
        raise _WrongError(f"{_shown(value)} is no text")


def _name(value: object) -> None:
    _text(value)
    if not value:
        raise _WrongError("the text is empty")


def _truth(value: object) -> None:
    if not isinstance(value, bool):
        raise _WrongError(f"{_shown(value)} is neither true nor false")


def _real(value: object) -> None:
    if type(value) is not float and type(value) is not int:
        raise _WrongError(f"{_shown(value)} is no number")
    try:
        finite = math.isfinite(value)
    except OverflowError:
        finite = False
    if not finite:
        raise _WrongError(f"{_shown(value)} is not a finite number")


def _count(value: object) -> None:
    if type(value) is not int or not 1 <= value <= _LARGEST_COUNT:
        raise _WrongError(f"{_shown(value)} is no whole number from 1 up")


def _one_of(values: Collection[object]) -> Check:
    def check(value: object) -> None:
        if isinstance(value, (list, dict)) or value not in values or isinstance(value, bool):
            raise _WrongError(f"{_shown(value)} is none of {', '.join(map(str, values))}")

    return check


def _or_none(inner: Check) -> Check:
    def check(value: object) -> None:
        if value is not None:
            inner(value)

    return check


def _listed(inner: Check, least: int = 0, most: int | None = None) -> Check:
    def check(value: object) -> None:
        if not isinstance(value, list):
            raise _WrongError(f"{_shown(value)} is no list")
        if len(value) < least or (most is not None and len(value) > most):
            wanted = (
                f"{least}"
                if least == most
                else f"{least} or more"
                if most is None
                else f"{least} to {most}"
            )
            raise _WrongError(f"the list holds {len(value)} items, not {wanted}")
        for index, item in enumerate(value):
            try:
                inner(item)
            except _WrongError as wrong:
                wrong.path.append(f"[{index}]")
                raise

    return check


def _tuple(*inner: Check) -> Check:
    whole = _listed(lambda _: None, len(inner), len(inner))

    def check(value: object) -> None:
        whole(value)
        for index, (item, each) in enumerate(zip(cast("list[object]", value), inner, strict=True)):
            try:
                each(item)
            except _WrongError as wrong:
                wrong.path.append(f"[{index}]")
                raise

    return check


def _mapped(inner: Check) -> Check:
    def check(value: object) -> None:
        if not isinstance(value, dict):
            raise _WrongError(f"{_shown(value)} is no mapping")
        for key, item in value.items():
            try:
                _text(key)
                inner(item)
            except _WrongError as wrong:
                wrong.path.append(f"[{_shown(key)}]")
                raise

    return check


def _record(required: Mapping[str, Check], optional: Mapping[str, Check] | None = None) -> Check:
    known = {**required, **(optional or {})}

    def check(value: object) -> None:
        if not isinstance(value, dict):
            raise _WrongError(f"{_shown(value)} is no mapping")
        for key in value:
            if key not in known:
                raise _WrongError(f"the key {_shown(key)} is unknown")
        for key in required:
            if key not in value:
                raise _WrongError(f"the key {key!r} is missing")
        for key, item in value.items():
            try:
                known[key](item)
            except _WrongError as wrong:
                wrong.path.append(f".{key}")
                raise

    return check


_VECTOR = _listed(_real, 3, 3)
_MEETS = _mapped(_listed(_tuple(_real, _real, _real, _real)))
_SHAPE = {"knot": _listed(_real, 2), "leave": _listed(_VECTOR, 2), "arrive": _listed(_VECTOR, 2)}
_END = _record({"kind": _one_of(words(EndKind)), "vector": _VECTOR})
_STATE = _one_of(words(State)[1:])

_LINE = _record(
    {"key": _name, "name": _name, "group": _text},
    {"normal": _VECTOR, "offset": _real, "boundary": _one_of(words(BoundaryKind)), "note": _name},
)
_CURVE = _record(
    {
        "key": _name,
        "line": _text,
        "points": _listed(_text, 2),
        "meets": _mapped(_listed(_tuple(_one_of((1, -1)), _or_none(_text)), 1)),
    },
    {
        "start": _END,
        "finish": _END,
        "kept": _record({"state": _STATE, **_SHAPE, "xyz": _listed(_VECTOR, 2), "meets": _MEETS}),
    },
)
_RIDING = _record(
    {
        "anchors": _tuple(_or_none(_text), _or_none(_text)),
        "base": _VECTOR,
        "from": _tuple(_VECTOR, _VECTOR),
        "weight": _real,
    }
)
_POINT = _record(
    {"key": _name, "sort": _one_of(words(Sort)), "curves": _listed(_text, 1, 2)},
    {
        "role": _one_of(words(Role)),
        "birth": _count,
        "contact": _truth,
        "sign": _one_of((1, -1)),
        "label": _name,
        "override": _one_of(words(Role)),
        "kinds": _listed(_one_of(words(PointKind)), 1, 2),
        "directions": _listed(_VECTOR, 1, 2),
        "limit": _real,
        "riding": _RIDING,
        "value": _VECTOR,
        "state": _STATE,
    },
)


def _fields(cls: type) -> Mapping[str, Check]:
    """Check an attrs class of numbers, and perhaps a name."""
    texts = {"name"}
    return {field.name: _text if field.name in texts else _real for field in attrs.fields(cls)}


_DEFINITION = _record(
    {
        "particulars": _record(_fields(Particulars)),
        "tolerances": _record(_fields(Tolerances)),
        "groups": _listed(_record({"name": _name, "family": _one_of(tuple(FAMILIES))})),
        "associations": _listed(_record({"a": _text, "b": _text, "two_way": _truth})),
        "lines": _listed(_LINE),
        "curves": _listed(_CURVE),
        "points": _listed(_POINT),
        "births": _listed(_tuple(_text, _text, _count)),
        "retired": _record(dict.fromkeys(("lines", "curves", "points"), _listed(_name))),
    }
)
_PUBLISHED = _record(
    {
        "curves": _mapped(_record({**_SHAPE, "meets": _MEETS})),
        "points": _mapped(_record({}, {"value": _VECTOR, "gap": _real})),
    }
)


def check_definition(value: object) -> None:
    """Check the form of a definition.

    Raises
    ------
    BadInputError
        With the way to what is wrong, the value and the remedy.
    """
    _check(_DEFINITION, value, "the definition")


def check_published(value: object) -> None:
    """Check the form of published values.

    Raises
    ------
    BadInputError
        With the way to what is wrong, the value and the remedy.
    """
    _check(_PUBLISHED, value, "the published values")


def _check(check: Check, value: object, name: str) -> None:
    try:
        check(value)
    except _WrongError as wrong:
        path = "".join(reversed(wrong.path)).lstrip(".")
        where = f"in {name}" + (f", at {path}" if path else "")
        raise BadInputError(wrong.what, where, _REMEDY) from None
