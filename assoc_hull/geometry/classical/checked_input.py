"""Input of a size that arithmetic can bear, whole numbers, lists and mappings, or an error.

Examples
--------
>>> from assoc_hull.geometry.classical.checked_input import numbers
>>> numbers([1, 1e-200], "offsets", (None,)).tolist()
[1.0, 0.0]
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TypeVar

import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checks import called, figure, finite, inside
from assoc_hull.geometry.curves import FloatArray

__all__ = [
    "LEAST_EXTENT",
    "MOST_EXTENT",
    "bearable",
    "listed",
    "mapped",
    "number",
    "numbers",
    "places",
    "together",
    "weights_of",
    "whole_number",
]

_MOST, _NIL = 1e30, 1e-30
"""Beyond the first a number is no measure of a ship, and its powers overflow; below the other it is
nil, and quotients do."""

LEAST_EXTENT, MOST_EXTENT = 1e-50, 1e50
"""m: between an atom and the universe with room to spare."""

Item = TypeVar("Item")


def numbers(values: ArrayLike, name: str, shape: tuple[int | None, ...]) -> FloatArray:
    """Take numbers of a shape; None in it stands for any size.

    Raises
    ------
    GeometryError
        As `checks.finite`; ``"{name}: {v} is beyond measure"``.
    """
    return _measured(finite(values, name, shape), name)


def number(value: ArrayLike, name: str) -> float:
    """Take one number; raises as `numbers`."""
    return float(numbers(value, name, ()))


def places(values: ArrayLike, name: str) -> FloatArray:
    """Take numbers of any shape; raises as `numbers`."""
    return _measured(inside(values, name, -np.inf, np.inf), name)


def together(values: Iterable[ArrayLike], name: str) -> tuple[FloatArray, ...]:
    """Take arrays that go together in one shape.

    Raises
    ------
    GeometryError
        As `numbers`; shapes that do not.
    """
    given = [places(each, name) for each in values]
    try:
        return tuple(np.broadcast_arrays(*given))
    except ValueError:
        told = ", ".join(str(each.shape) for each in given)
        raise GeometryError(f"{name}: shapes {told}", "give arrays of one shape") from None


def bearable(values: FloatArray, name: str) -> FloatArray:
    """Take coordinates of any shape, m, whose squares and cubes are numbers.

    Raises
    ------
    GeometryError
        The largest amount is beyond the bounds; points that are all nil pass.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.classical.checked_input import bearable
    >>> bearable(np.array([0.0, 1e200]), "circle")
    Traceback (most recent call last):
    ...
    assoc_hull.errors.GeometryError: circle: a coordinate of 1e+200 m; give lengths in m
    """
    size = float(np.abs(values).max(initial=0.0))
    if size and not LEAST_EXTENT <= size <= MOST_EXTENT:
        raise GeometryError(
            f"{name}: a coordinate of {figure(size)} m", "give lengths in m", {"size": size}
        )
    return values


def whole_number(value: object, name: str, least: int, most: int) -> int:
    """Take a whole number of a range.

    Raises
    ------
    GeometryError
        Anything else.
    """
    if isinstance(value, bool) or not isinstance(value, int) or not least <= value <= most:
        shown = str(value) if isinstance(value, int) and abs(value) < 1e9 else called(value)
        raise GeometryError(f"{name} {shown}", f"give a whole number from {least} to {most}")
    return value


def mapped(value: object, name: str) -> Mapping[object, object]:
    """Take a mapping.

    Raises
    ------
    GeometryError
        Anything else.
    """
    if not isinstance(value, Mapping):
        raise GeometryError(f"{name}: {called(value)}", "give a mapping of names")
    return value


def listed(value: Iterable[Item], name: str) -> list[Item]:
    """Take a sequence as a list.

    Raises
    ------
    GeometryError
        What cannot be gone through, and text.
    """
    if isinstance(value, str | bytes) or not isinstance(value, Iterable):
        raise GeometryError(f"{name}: {called(value)}", "give a list")
    try:
        return list(value)
    except TypeError:  # an array of no dimension says that it can be gone through
        raise GeometryError(f"{name}: {called(value)}", "give a list") from None


def weights_of(weights: ArrayLike | None, count: int, name: str) -> FloatArray:
    """Take weights above 0, (count,); ones if None.

    Raises
    ------
    GeometryError
        ``"{name}: weights must be positive"``.
    """
    if weights is None:
        return np.ones(count)
    found = numbers(weights, name, (count,))
    bad = np.flatnonzero(found <= 0.0)
    if len(bad):
        raise GeometryError(
            f"{name}: weights must be positive", f"weight {bad[0]} is {found[bad[0]]:g}",
            {"index": int(bad[0]), "weight": float(found[bad[0]])},
        )  # fmt: skip
    return found


def _measured(found: FloatArray, name: str) -> FloatArray:
    size = np.abs(found)
    if size.size and size.max() > _MOST:
        value = float(found.flat[int(size.argmax())])
        raise GeometryError(
            f"{name}: {figure(value)} is beyond measure", "give metres", {"value": value}
        )
    return np.where(size < _NIL, 0.0, found)
