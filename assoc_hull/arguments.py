"""Checking what is handed in: numbers, places, flags, text. One error says which, and where.

Every function takes the value, the name of the argument, and where it was given (``"in
move"``, ``"at WL 1"``).

Examples
--------
>>> from assoc_hull.arguments import integer
>>> integer(3, "n", "in undo", least=0)
3
"""

from __future__ import annotations

import os
import re
import reprlib
from collections.abc import Callable, Collection, Iterable
from enum import Enum
from pathlib import Path
from typing import Any, TypeVar, cast

import attrs
import numpy as np

from assoc_hull.errors import BadInputError, WrongTypeError

__all__ = [
    "all_of",
    "checked",
    "choice",
    "file_path",
    "flag",
    "instance",
    "integer",
    "no_member",
    "not_negative",
    "number",
    "numbers",
    "once",
    "pair",
    "place",
    "places",
    "plain",
    "plain_name",
    "positive",
    "regular_file",
    "shown",
    "shown_name",
    "small_length",
    "text",
    "word",
]

Floats = np.typing.NDArray[np.float64]
Kind = TypeVar("Kind")

_LARGEST = 1e6
"""No coordinate of a ship exceeds this (m); beyond, sums of squares lose all meaning."""

_LONGEST = 200
"""A value nested in many ways is shown by so many letters."""

_CALL = "in the call"
_FAILS = (TypeError, ValueError, OverflowError)
_TRUTH = (bool, np.bool_)


class _PlainRepr(reprlib.Repr):
    """Short texts of values, in which numbers of numpy stand as Python's do."""

    def repr1(self, x: object, level: int) -> str:
        return super().repr1(x.item() if isinstance(x, np.generic) else x, level)


_SHORT = _PlainRepr()


def shown(value: object) -> str:
    """Give a value as it may stand in a message: in one line, and short.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.arguments import shown
    >>> shown(list(range(100)))
    '[0, 1, 2, 3, 4, 5, ...]'
    >>> shown((np.float64(1.5), np.int64(2)))
    '(1.5, 2)'
    """
    text = " ".join(_SHORT.repr(value).split())
    return text if len(text) <= _LONGEST else text[:_LONGEST] + " ..."


def shown_name(value: object) -> str:
    """Give what was asked for as a name, short if it is none."""
    return value if isinstance(value, str) and len(value) < 100 else shown(value)


_NUMBER = re.compile(r"(\d+)(?:[.,](\d+))?|(?<!\d)[.,](\d+)")
_GAP = re.compile(r"(?<![\d\s])\s+|\s+(?![\d\s])")


def plain_name(name: str) -> str:
    """Give a name as it is compared with others where none is found as it was written.

    Spaces, upper and lower case, a comma for the point and zeros at the end do not matter.

    Examples
    --------
    >>> from assoc_hull.arguments import plain_name
    >>> plain_name("wl .50 X  ST07") == plain_name("WL 0,5 x ST 7")
    True
    """

    def digits(found: re.Match[str]) -> str:
        part = (found[2] or found[3] or "").rstrip("0")
        return f"{(found[1] or '').lstrip('0') or '0'}{'.' * bool(part)}{part}"

    return _NUMBER.sub(digits, _GAP.sub("", name.casefold()))


def _array(values: object) -> Floats:
    """Give numbers as an array; one nan where they are none: True is no 1, a text no number."""
    each = values if isinstance(values, list | tuple) else [values]
    kinds = (getattr(getattr(value, "dtype", None), "kind", "") for value in each)
    hidden = isinstance(values, np.ma.MaskedArray) and np.ma.is_masked(values)
    # numpy takes the text "2" for a number, and whoever wrote it meant something else.
    words = any(isinstance(value, bool | str | bytes) for value in each)
    if hidden or words or {"b", "M", "m", "U", "S"} & {*kinds}:
        return np.full(1, np.nan)
    try:
        return np.array(values, np.float64)
    except _FAILS:
        return np.full(1, np.nan)


def _refuse_texts(given: object, values: object, name: str, where: str) -> None:
    """Refuse texts in the place of numbers: "3,5" and "3.5 m" would have to be guessed.

    Raises
    ------
    BadInputError
        One of the values is text.
    """
    each = values if isinstance(values, list | tuple) else [values]
    if not any(_is_text(value) for value in each):
        return
    remedy = "give numbers, not text: without quotes"
    raise BadInputError(f"{name} is {shown(given)}", where, remedy)


def _is_text(value: object) -> bool:
    """Tell whether a value is text, or an array of texts."""
    kind = getattr(getattr(value, "dtype", None), "kind", "")
    return isinstance(value, str | bytes) or kind in ("U", "S")


def number(value: object, name: str, where: str = _CALL, *, unit: str = "m") -> float:
    """Take a finite number of at most 1e6 m, or of another unit, or say which argument is none.

    Raises
    ------
    BadInputError
        Anything else.

    Examples
    --------
    >>> from assoc_hull.arguments import number
    >>> number(3, "y")
    3.0
    """
    if type(value) is float and abs(value) <= _LARGEST:
        return value
    _refuse_texts(value, [value], name, where)
    try:
        found = float(value) if np.ndim(value) == 0 else float("nan")  # type: ignore[arg-type]
    except _FAILS:
        found = float("nan")
    if isinstance(value, _TRUTH) or not abs(found) <= _LARGEST:
        raise BadInputError(
            f"{name} is {shown(value)}", where, f"give a finite number up to {_LARGEST:g} {unit}"
        )
    return found


def positive(value: object, name: str, where: str = _CALL) -> float:
    """Take a finite number above 0.

    Raises
    ------
    BadInputError
        Anything else.
    """
    found = number(value, name, where)
    if not found > 0.0:
        raise BadInputError(f"{name} is {shown(value)}", where, "give a number above 0")
    return found


def small_length(value: object, name: str, where: str, length: float) -> float:
    """Take a length (m) above 0 that is small beside a ship's `length`: noise, a tolerance.

    Raises
    ------
    BadInputError
        Anything else; more than a thousandth of the length: it was meant in mm.
    """
    found, most = positive(value, name, where), _SMALL_PART * length
    if found > most:
        raise BadInputError(
            f"{name} is {found:g} m, more than a thousandth of the length ({most:.3g} m)", where,
            f"lengths are in m: give {found / 1e3:g} for {found:g} mm",
        )  # fmt: skip
    return found


_SMALL_PART = 1e-3 * (1.0 + 1e-9)


def not_negative(value: object, name: str, where: str = _CALL, *, unit: str = "m") -> float:
    """Take a finite number of 0 or more.

    Raises
    ------
    BadInputError
        Anything else.
    """
    found = number(value, name, where, unit=unit)
    if found < 0.0:
        raise BadInputError(f"{name} is {shown(value)}", where, "give 0 or more")
    return found


def integer(value: object, name: str, where: str = _CALL, *, least: int, most: int = 10**6) -> int:
    """Take a whole number within limits.

    Raises
    ------
    BadInputError
        Anything else; truth values too.
    """
    if not isinstance(value, int | np.integer) or isinstance(value, bool):
        remedy = "give a whole number"
        raise WrongTypeError(f"{name} is {shown(value)}", where, remedy)
    if not least <= value <= most:
        remedy = f"give a whole number from {least} to {most}"
        raise BadInputError(f"{name} is {shown(value)}", where, remedy)
    return int(value)


def numbers(values: object, name: str, where: str = _CALL, *, most: float = _LARGEST) -> Floats:
    """Take one number or some, (k,): finite, of at most 1e6 m unless it is said.

    Raises
    ------
    BadInputError
        Anything else.
    """
    _refuse_texts(values, values, name, where)
    found = _array(values)
    if found.ndim > 1 or not (np.isfinite(found) & (np.abs(found) <= most)).all():
        limit = f" up to {most:g}" if np.isfinite(most) else ""
        raise BadInputError(
            f"{name} is {shown(values)}", where, f"give one finite number{limit}, or a list of such"
        )
    return found


def places(values: object, name: str, where: str = _CALL) -> Floats:
    """Take places, (k, 3), m; one place may come without the leading axis.

    Raises
    ------
    BadInputError
        Another shape, no place at all, or a number that is not finite or too large.
    """
    _refuse_texts(values, values, name, where)
    found = np.atleast_2d(_array(values)) + 0.0
    if found.ndim != 2 or found.shape[1:] != (3,) or not len(found):
        raise BadInputError(f"{name} is no list of places", where, "give (x, y, z) each, m")
    if not (np.abs(found) <= _LARGEST).all():
        raise BadInputError(
            f"{name} holds a number that is not finite or above {_LARGEST:g} m",
            where,
            "give metres",
        )
    return found


def place(value: object, name: str, where: str = _CALL) -> Floats:
    """Take one place, (3,), m; raises as `places`."""
    found = places(value, name, where)
    if len(found) != 1:
        raise BadInputError(f"{name} holds {len(found)} places", where, "give one")
    one: Floats = found[0]
    return one


def pair(values: object, name: str, where: str = _CALL, *, positive: bool) -> tuple[float, float]:
    """Take two numbers: radii above 0, or a span whose second number is the larger.

    Raises
    ------
    BadInputError
        Anything else.

    Examples
    --------
    >>> from assoc_hull.arguments import pair
    >>> pair([20, 8], "radius", positive=True)
    (20.0, 8.0)
    """
    given = f"{name} is {shown(values)}"
    _refuse_texts(values, values, name, where)
    found = _array(values)
    if found.shape != (2,) or not (np.abs(found) <= _LARGEST).all():
        raise BadInputError(given, where, "give two finite numbers, m")
    first, second = found.tolist()
    if positive and not (first > 0.0 and second > 0.0):
        raise BadInputError(given, where, "give two radii above 0, m")
    if not positive and not first < second:
        raise BadInputError(given, where, "give (lower, upper), m")
    return first, second


def word(value: object, name: str, where: str = _CALL) -> str:
    """Take text, or say which argument is none.

    Raises
    ------
    WrongTypeError
        Anything else.
    """
    if not isinstance(value, str):
        raise WrongTypeError(f"{name} is {shown(value)}", where, "give text")
    return value


def text(value: object, name: str, where: str = _CALL) -> str:
    """Take text that can be printed in one line and is not empty.

    Raises
    ------
    BadInputError
        Anything else.
    """
    found = word(value, name, where)
    if not found.strip() or not found.isprintable():
        remedy = "give printable text in one line"
        raise BadInputError(f"{name} is {shown(value)}", where, remedy)
    return found


def choice(value: object, name: str, known: Collection[str], where: str = _CALL) -> str:
    """Take one of some words.

    Raises
    ------
    BadInputError
        Anything else.
    """
    if not isinstance(value, str) or value not in known:
        raise BadInputError(f"{name} is {shown(value)}", where, f"use {' or '.join(known)}")
    return value


def flag(value: object, name: str, where: str = _CALL) -> bool:
    """Take a truth value.

    Raises
    ------
    WrongTypeError
        Anything else: what merely counts as true may be a mistake.
    """
    if not isinstance(value, _TRUTH):
        raise WrongTypeError(f"{name} is {shown(value)}", where, "give True or False")
    return bool(value)


def instance(value: object, kind: type[Kind], name: str, where: str = _CALL) -> Kind:
    """Take an object of a class.

    Raises
    ------
    WrongTypeError
        Anything else.
    """
    if not isinstance(value, kind):
        raise WrongTypeError(f"{name} is {shown(value)}", where, f"give a {kind.__name__}")
    return value


def all_of(values: object, kind: type[Kind], name: str, where: str = _CALL) -> list[Kind]:
    """Take some objects of a class, in any collection but a text.

    Raises
    ------
    WrongTypeError
        Anything else.
    """
    single = isinstance(values, str | bytes) or getattr(values, "ndim", 1) == 0
    if single or not isinstance(values, Iterable):
        remedy = "give a list" if kind is object else f"give a list of {kind.__name__}"
        raise WrongTypeError(f"{name} is {shown(values)}", where, remedy)
    given = cast("Iterable[object]", values)
    return [instance(each, kind, f"an item of {name}", where) for each in given]


def file_path(value: object, where: str = _CALL) -> str:
    """Take the name of a file.

    Raises
    ------
    BadInputError
        Anything else.
    """
    if not isinstance(value, str | os.PathLike):
        raise WrongTypeError(f"the path is {shown(value)}", where, "give the name of a file")
    found = os.fspath(value)
    if not isinstance(found, str) or not found or "\0" in found:
        raise BadInputError(f"the path is {shown(value)}", where, "give the name of a file")
    return found


def regular_file(path: Path) -> Path:
    """Take a file that is to be read: opening a pipe waits for ever, a device has no end.

    That there is none, or a folder, is left to whoever opens it.

    Raises
    ------
    BadInputError
        A pipe, a device or a socket.
    """
    if path.exists() and not (path.is_file() or path.is_dir()):
        kind = "a pipe" if path.is_fifo() else "a socket" if path.is_socket() else "a device"
        remedy = "give the name of a regular file; what comes through a pipe, save it first"
        raise BadInputError(f"this is {kind} and no regular file", f"at {path}", remedy)
    return path


def no_member(kind: type[Enum], value: object) -> BadInputError:
    """Give the error for a value that no member of an enumeration has."""
    known = " or ".join(f"{kind.__name__}.{each.name}" for each in kind)
    return BadInputError(f"there is no {kind.__name__} {shown(value)}", _CALL, f"use {known}")


def checked(check: Callable[[object, str, str], object], where: str) -> Callable[..., Any]:
    """Give a check as a validator of an attrs field, which is named as the argument is.

    Examples
    --------
    >>> import attrs
    >>> from assoc_hull.arguments import checked, word
    >>> name = attrs.field(validator=checked(word, "in a ship"))
    """

    def validator(_: object, field: attrs.Attribute[Any], value: object) -> None:
        check(value, field.name, where)

    return validator


def plain(value: float) -> float:
    """Give a number that comes as an int or a numpy scalar as a float; all else, texts too, as is.

    A converter of attrs fields, whose check comes after: what `number` takes is kept as one.

    Examples
    --------
    >>> from assoc_hull.arguments import plain
    >>> plain(3), plain("3.5")
    (3.0, '3.5')
    """
    if isinstance(value, _TRUTH) or _is_text(value):
        return value
    try:
        return value if np.ndim(value) else float(value)
    except _FAILS:
        return value


def once(pairs: Iterable[tuple[str, Any]]) -> dict[str, Any]:
    """Take the entries of a JSON object; given to its reader, none of them comes twice.

    Raises
    ------
    ValueError
        A key that is there twice: for who reads the file to say in which.

    Examples
    --------
    >>> import json
    >>> from assoc_hull.arguments import once
    >>> json.loads('{"T": 7.0}', object_pairs_hook=once)
    {'T': 7.0}
    """
    found = dict[str, Any]()
    for key, value in pairs:
        if key in found:
            raise ValueError(f"{key!r} is given twice")
        found[key] = value
    return found
