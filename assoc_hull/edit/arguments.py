"""Checking what is handed to an edit: numbers, places, radii, names."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.state import HullState

__all__ = ["direction_in", "line_name", "number", "pair", "place", "places", "word"]

_LARGEST = 1e6
"""No coordinate of a ship exceeds this (m); beyond, sums of squares lose all meaning."""


def number(value: object, name: str) -> float:
    """Take a finite number of at most 1e6 m, or say which argument is none.

    Raises
    ------
    BadInputError
        Anything else.

    Examples
    --------
    >>> from assoc_hull.edit.arguments import number
    >>> number("3.5", "y")
    3.5
    """
    try:
        found = float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError, OverflowError):
        found = float("nan")
    if not abs(found) <= _LARGEST:
        raise BadInputError(
            f"{name} is {value!r}", "in an edit", f"give a finite number up to {_LARGEST:g} m"
        )
    return found


def places(values: object, name: str) -> FloatArray:
    """Take places, (k, 3), m; one place may come without the leading axis.

    Raises
    ------
    BadInputError
        Another shape, no place at all, or a number that is not finite or too large.
    """
    try:
        found = np.atleast_2d(np.array(values, np.float64)) + 0.0
    except (TypeError, ValueError, OverflowError):
        found = np.zeros((0, 0))
    if found.ndim != 2 or found.shape[1:] != (3,) or not len(found):
        raise BadInputError(f"{name} is no list of places", "in an edit", "give (x, y, z) each, m")
    if not (np.abs(found) <= _LARGEST).all():
        raise BadInputError(
            f"{name} holds a number that is not finite or above {_LARGEST:g} m",
            "in an edit",
            "give metres",
        )
    return found


def place(value: object, name: str) -> FloatArray:
    """Take one place, (3,), m; raises as `places`."""
    found = places(value, name)
    if len(found) != 1:
        raise BadInputError(f"{name} holds {len(found)} places", "in an edit", "give one")
    one: FloatArray = found[0]
    return one


def pair(values: ArrayLike, name: str, *, positive: bool) -> tuple[float, float]:
    """Take two numbers: radii above 0, or a span whose second number is the larger.

    Raises
    ------
    BadInputError
        Anything else.

    Examples
    --------
    >>> from assoc_hull.edit.arguments import pair
    >>> pair([20, 8], "radius", positive=True)
    (20.0, 8.0)
    """
    try:
        found = np.array(values, np.float64)
    except (TypeError, ValueError, OverflowError):
        found = np.zeros(0)
    if found.shape != (2,) or not (np.abs(found) <= _LARGEST).all():
        raise BadInputError(f"{name} is {values!r}", "in an edit", "give two finite numbers, m")
    first, second = found.tolist()
    if positive and not (first > 0.0 and second > 0.0):
        raise BadInputError(f"{name} is {values!r}", "in an edit", "give two radii above 0, m")
    if not positive and not first < second:
        raise BadInputError(f"{name} is {values!r}", "in an edit", "give (lower, upper), m")
    return first, second


def line_name(name: object) -> str:
    """Take a name for a line: text that no address could be read from.

    Raises
    ------
    BadInputError
        No text, blanks at its ends, or what addresses are made with: `` x ``, `` @ ``, ``#``,
        ``/``, ``[``.
    """
    taken = (" x ", " @ ", "#", "/", "[", "]", ":")
    if not isinstance(name, str) or name != name.strip() or not name.isprintable() or not name:
        raise BadInputError(
            f"the name {name!r}", "in an edit", "give printable text without outer blanks"
        )
    if any(part in name for part in taken):
        raise BadInputError(
            f"the name {name!r} could be read as an address", "in an edit",
            "leave out ' x ', ' @ ', '#', '/', '[' and ']'",
        )  # fmt: skip
    return name


def word(value: object, name: str) -> str:
    """Take text, or say which argument is none.

    Raises
    ------
    BadInputError
        Anything else.
    """
    if not isinstance(value, str):
        raise BadInputError(f"{name} is {value!r}", "in an edit", "give text")
    return value


def direction_in(state: HullState, curve: int, value: object, name: str) -> FloatArray:
    """Take a vector in the plane of a curve, (3,); any length but nil.

    Raises
    ------
    BadInputError
        No vector, one without length, or one that leaves the plane.
    """
    found = place(value, name)
    length = float(np.sqrt((found * found).sum()))
    if length == 0.0:
        raise BadInputError(f"{name} has no length", "in an edit", "give a direction")
    line = state.line_of(curve)
    if state.lines.planar.data[line]:
        off = float((found * state.lines.normal.data[line]).sum()) / length
        if abs(off) > 1e-9:
            raise BadInputError(
                f"{name} leaves the plane of {state.lines.name.data[line]} (sine {off:.3g})",
                "in an edit",
                "give a vector in that plane",
            )
    return found
