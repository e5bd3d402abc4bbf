"""Check the arguments of classical curves; every refusal is a GeometryError.

The functions take what a caller gave and give back an array, a number, a word or a list.
Each takes the name of the curve, with which its message begins. `arguments` checks what users
hand to a hull; here input may be any array, and its shape and size are what matters.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TypeVar

import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import shown
from assoc_hull.errors import GeometryError
from assoc_hull.geometry.curves import FloatArray

__all__ = [
    "LEAST_EXTENT",
    "MOST_EXTENT",
    "argument_text",
    "bounded_height",
    "broadcast_numbers",
    "check_magnitude",
    "checked_list",
    "checked_mapping",
    "digits",
    "finite_array",
    "number",
    "number_array",
    "numbers",
    "one_of",
    "positive_weights",
    "require_broadcast",
    "whole_number",
    "within_range",
    "wrap_angle",
]


def argument_text(name: object) -> str:
    """Write what was handed in for a name, for a message of one line.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.checked_input import argument_text
    >>> argument_text("cubic"), argument_text([1, 2])
    ("'cubic'", 'a list')
    """
    return repr(name) if isinstance(name, str) else f"a {type(name).__name__}"


def digits(value: float) -> str:
    """Write a number for a message: up to ten digits, no trailing zeros.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.checked_input import digits
    >>> digits(14.306497441074546), digits(2.0)
    ('14.30649744', '2')
    """
    return f"{float(value) + 0.0:.10g}"


def finite_array(values: ArrayLike, name: str, shape: tuple[int | None, ...] | None) -> FloatArray:
    """Take finite numbers of a shape as a writeable copy; None in the shape stands for any size.

    Raises GeometryError, which begins with the `name` of the curve, for another shape (None as the
    whole shape allows any) and for numbers that are not finite.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.checked_input import finite_array
    >>> finite_array([0, float("nan")], "sheer", (None,))
    Traceback (most recent call last):
    ...
    assoc_hull.errors.GeometryError: sheer: non-finite value at index 1; give a number
    """
    each = ["..."] if shape is None else ["n" if size is None else str(size) for size in shape]
    wanted = f"({', '.join(each)})"
    found = _numbers(values, name, wanted)
    fits = shape is None or (
        found.ndim == len(shape)
        and all(size is None or size == has for size, has in zip(shape, found.shape, strict=True))
    )
    if not fits:
        raise GeometryError(
            f"{name}: expected shape {wanted}, got {found.shape}", "give an array of this shape",
            {"expected": wanted, "got": found.shape},
        )  # fmt: skip
    bad = np.argwhere(~np.isfinite(found))
    if len(bad):
        place = tuple(bad[0].tolist()) or (0,)
        index: object = place if found.ndim > 1 else place[0]
        raise GeometryError(
            f"{name}: non-finite value at index {index}", "give a number", {"index": index}
        )
    return found


def _numbers(values: ArrayLike, name: str, wanted: str) -> FloatArray:
    """Take real numbers of any shape, as a copy."""
    try:
        found = np.array(values)
        if found.dtype.kind in "cmM":  # numpy would only warn
            raise TypeError
        return found.astype(np.float64)
    except (TypeError, ValueError, OverflowError):
        raise GeometryError(
            f"{name}: expected shape {wanted}, got no array of numbers", "give numbers",
            {"expected": wanted},
        ) from None  # fmt: skip


def within_range(
    x: ArrayLike, name: str, least: float, most: float, slack: float = 0.0
) -> FloatArray:
    """Take places (m) of any shape within a range of definition; nothing is extrapolated.

    What lies no more than `slack` (m) outside counts as the end. Raises GeometryError for a place
    outside, and for values that are no finite numbers.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.checked_input import within_range
    >>> within_range(11.0, "camber", 0.0, 10.0)
    Traceback (most recent call last):
    ...
    assoc_hull.errors.GeometryError: camber: x=11 outside [0, 10]; ask between these
    """
    found = finite_array(x, name, None)
    outside = (found < least - slack) | (found > most + slack)
    if outside.any():
        first = float(found[outside].flat[0])
        raise GeometryError(
            f"{name}: x={digits(first)} outside [{digits(least)}, {digits(most)}]",
            "ask between these", {"x": first, "least": least, "most": most},
        )  # fmt: skip
    return np.clip(found, least, most)


def require_broadcast(name: str, first: FloatArray, second: FloatArray) -> None:
    """Check that two arrays of places fit one another, as they stand or broadcast.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.classical.checked_input import require_broadcast
    >>> require_broadcast("deck", np.zeros((4, 1)), np.zeros(3))
    """
    try:
        np.broadcast_shapes(first.shape, second.shape)
    except ValueError:
        raise GeometryError(
            f"{name}: expected shape {first.shape}, got {second.shape}",
            "give as many of both, or one", {"expected": first.shape, "got": second.shape},
        ) from None  # fmt: skip


def wrap_angle(angle: ArrayLike) -> FloatArray:
    """Map angles (rad) to [-pi, pi); nothing is lost where they lie there already.

    Examples
    --------
    >>> import math
    >>> from assoc_hull.geometry.classical.checked_input import wrap_angle
    >>> wrap_angle([0.25, math.pi, -math.pi]).tolist()
    [0.25, -3.141592653589793, -3.141592653589793]
    """
    found = np.asarray(angle, np.float64)
    turned = np.mod(found + np.pi, 2.0 * np.pi) - np.pi
    return np.where((found >= -np.pi) & (found < np.pi), found, turned)


# --------------------------------------------------------------------------------------
# Words and heights.

Choice = TypeVar("Choice", str, int)

_HIGHEST = 1e6
"""m: no hull reaches up or down to here."""


def bounded_height(value: object, name: str) -> float:
    """Take a height, m; one beyond any hull counts as a million metres."""
    found = float(finite_array(value, name, ()))  # type: ignore[arg-type]
    return min(max(found, -_HIGHEST), _HIGHEST)


def one_of(value: object, known: Sequence[Choice], what: str) -> Choice:
    """Take one of a few words or whole numbers; `what` begins the message.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.checked_input import one_of
    >>> one_of("z", ("x", "y"), "spline: no axis")
    Traceback (most recent call last):
    ...
    assoc_hull.errors.GeometryError: spline: no axis 'z'; there are x, y
    """
    if isinstance(value, str | int | float):
        for each in known:
            if value == each and isinstance(value, str) == isinstance(each, str):
                return each
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    raise GeometryError(
        f"{what} {shown(value) if is_number else argument_text(value)}",
        f"there are {', '.join(map(str, known))}",
        {"given": shown(value)},
    )


# --------------------------------------------------------------------------------------
# Numbers of a size that arithmetic can bear, whole numbers, lists and mappings.

_MOST, _LEAST = 1e30, 1e-30
"""Beyond the first a number is no measure of a ship, and its powers overflow; below the other it is
taken as 0, since quotients would overflow."""

LEAST_EXTENT, MOST_EXTENT = 1e-50, 1e50
"""m: between an atom and the universe with room to spare."""

Item = TypeVar("Item")


def numbers(values: ArrayLike, name: str, shape: tuple[int | None, ...]) -> FloatArray:
    """Take numbers of a shape; None in it stands for any size.

    Raises GeometryError as `finite_array`, and for a number beyond 1e30; tiny ones become 0.
    """
    return _measured(finite_array(values, name, shape), name)


def number(value: ArrayLike, name: str) -> float:
    """Take one number; raises as `numbers`."""
    return float(numbers(value, name, ()))


def number_array(values: ArrayLike, name: str) -> FloatArray:
    """Take numbers of any shape; raises as `numbers`."""
    return _measured(within_range(values, name, -np.inf, np.inf), name)


def broadcast_numbers(values: Iterable[ArrayLike], name: str) -> tuple[FloatArray, ...]:
    """Take arrays that broadcast to one shape; raises as `numbers`."""
    given = [number_array(each, name) for each in values]
    try:
        return tuple(np.broadcast_arrays(*given))
    except ValueError:
        told = ", ".join(str(each.shape) for each in given)
        raise GeometryError(f"{name}: shapes {told}", "give arrays of one shape") from None


def check_magnitude(values: FloatArray, name: str) -> FloatArray:
    """Take coordinates of any shape, m, whose squares and cubes are numbers; all may be 0.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.classical.checked_input import check_magnitude
    >>> check_magnitude(np.array([0.0, 1e200]), "circle")
    Traceback (most recent call last):
    ...
    assoc_hull.errors.GeometryError: circle: a coordinate of 1e+200 m; give lengths in m
    """
    size = float(np.abs(values).max(initial=0.0))
    if size and not LEAST_EXTENT <= size <= MOST_EXTENT:
        raise GeometryError(
            f"{name}: a coordinate of {digits(size)} m", "give lengths in m", {"size": size}
        )
    return values


def whole_number(value: object, name: str, least: int, most: int) -> int:
    """Take a whole number from `least` to `most`; bool is none."""
    if isinstance(value, bool) or not isinstance(value, int) or not least <= value <= most:
        shown = str(value) if isinstance(value, int) and abs(value) < 1e9 else argument_text(value)
        raise GeometryError(f"{name} {shown}", f"give a whole number from {least} to {most}")
    return value


def checked_mapping(value: object, name: str) -> Mapping[object, object]:
    """Take a mapping; raises GeometryError for anything else."""
    if not isinstance(value, Mapping):
        raise GeometryError(f"{name}: {argument_text(value)}", "give a mapping of names")
    return value


def checked_list(value: Iterable[Item], name: str) -> list[Item]:
    """Take a sequence as a list; raises GeometryError for text and what cannot be gone through."""
    if isinstance(value, str | bytes) or not isinstance(value, Iterable):
        raise GeometryError(f"{name}: {argument_text(value)}", "give a list")
    try:
        return list(value)
    except TypeError:  # an array of no dimension says that it can be gone through
        raise GeometryError(f"{name}: {argument_text(value)}", "give a list") from None


def positive_weights(weights: ArrayLike | None, count: int, name: str) -> FloatArray:
    """Take weights above 0, (count,); ones if None."""
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
    """Refuse numbers that are too large, and take tiny ones as 0."""
    size = np.abs(found)
    if size.size and size.max() > _MOST:
        value = float(found.flat[int(size.argmax())])
        raise GeometryError(
            f"{name}: {digits(value)} is beyond measure", "give metres", {"value": value}
        )
    return np.where(size < _LEAST, 0.0, found)
