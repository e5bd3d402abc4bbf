"""What every classical curve asks of its input: finite numbers, in the shape that is wanted.

Examples
--------
>>> from assoc_hull.geometry.classical.checks import finite
>>> finite([[0, 1], [2, 3]], "biarc", (None, 2)).shape
(2, 2)
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.curves import FloatArray

__all__ = ["called", "figure", "finite", "inside", "require_together", "wrap"]


def called(name: object) -> str:
    """Write what was handed in for a name, for a message of one line.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.checks import called
    >>> called("cubic"), called([1, 2])
    ("'cubic'", 'a list')
    """
    return repr(name) if isinstance(name, str) else f"a {type(name).__name__}"


def figure(value: float) -> str:
    """Write a number for a message: up to ten digits, no trailing noughts.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.checks import figure
    >>> figure(14.306497441074546), figure(2.0)
    ('14.30649744', '2')
    """
    return f"{float(value) + 0.0:.10g}"


def finite(values: ArrayLike, name: str, shape: tuple[int | None, ...] | None) -> FloatArray:
    """Take finite numbers of a shape; None in the shape stands for any size.

    Parameters
    ----------
    values : array_like
        As handed in.
    name : str
        Of the curve, for the message.
    shape : tuple of (int or None), or None
        Wanted; None is any shape.

    Returns
    -------
    array of the shape
        A copy, writeable.

    Raises
    ------
    GeometryError
        ``"{name}: expected shape {s}, got {t}"``, ``"{name}: non-finite value at index {i}"``.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.checks import finite
    >>> finite([0, float("nan")], "sheer", (None,))
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


def inside(x: ArrayLike, name: str, least: float, most: float, slack: float = 0.0) -> FloatArray:
    """Take places within a range of definition; nothing is extrapolated.

    Parameters
    ----------
    x : array_like, m
        Of any shape.
    name : str
        Of the curve, for the message.
    least, most : float, m
        The range.
    slack : float, m
        So far outside counts as the end, by rounding.

    Raises
    ------
    GeometryError
        ``"{name}: x={x} outside [{a}, {b}]"``; or a value that is no finite number.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.checks import inside
    >>> inside(11.0, "camber", 0.0, 10.0)
    Traceback (most recent call last):
    ...
    assoc_hull.errors.GeometryError: camber: x=11 outside [0, 10]; ask between these
    """
    found = finite(x, name, None)
    outside = (found < least - slack) | (found > most + slack)
    if outside.any():
        first = float(found[outside].flat[0])
        raise GeometryError(
            f"{name}: x={figure(first)} outside [{figure(least)}, {figure(most)}]",
            "ask between these", {"x": first, "least": least, "most": most},
        )  # fmt: skip
    return np.clip(found, least, most)


def require_together(name: str, first: FloatArray, second: FloatArray) -> None:
    """Check that two arrays of places fit one another, as they stand or broadcast.

    Parameters
    ----------
    name : str
        Of the curve, for the message.
    first, second : array
        Of any shapes.

    Raises
    ------
    GeometryError
        ``"{name}: expected shape {s}, got {t}"``.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.classical.checks import require_together
    >>> require_together("deck", np.zeros((4, 1)), np.zeros(3))
    """
    try:
        np.broadcast_shapes(first.shape, second.shape)
    except ValueError:
        raise GeometryError(
            f"{name}: expected shape {first.shape}, got {second.shape}",
            "give as many of both, or one", {"expected": first.shape, "got": second.shape},
        ) from None  # fmt: skip


def wrap(angle: ArrayLike) -> FloatArray:
    """Map angles (rad) to [-pi, pi); nothing is lost where they lie there already.

    Examples
    --------
    >>> import math
    >>> from assoc_hull.geometry.classical.checks import wrap
    >>> wrap([0.25, math.pi, -math.pi]).tolist()
    [0.25, -3.141592653589793, -3.141592653589793]
    """
    found = np.asarray(angle, np.float64)
    turned = np.mod(found + np.pi, 2.0 * np.pi) - np.pi
    return np.where((found >= -np.pi) & (found < np.pi), found, turned)
