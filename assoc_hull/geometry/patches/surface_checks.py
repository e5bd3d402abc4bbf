"""Checks of what a surface is made of, and of parameters on it.

Examples
--------
>>> from assoc_hull.geometry.patches.surface_checks import checked_net
>>> checked_net([[[0, 0, 0], [0, 1, 0]], [[1, 0, 0], [1, 1, 1]]], "in a surface").shape
(2, 2, 3)
"""

from __future__ import annotations

import numpy as np

from assoc_hull.arguments import integer, shown, word
from assoc_hull.errors import BadInputError, WrongTypeError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.knots import checked_knots

__all__ = [
    "HIGHEST_DEGREE", "checked_degrees", "checked_name", "checked_net", "checked_parameters",
    "checked_part", "checked_surface_knots", "checked_weights",
]  # fmt: skip

HIGHEST_DEGREE = 7
"""The highest degree of a surface: |S|**4 is of degree 8 m - 4 then, and the binomials of 52 are
the last that floating-point numbers hold exactly. Surfaces of ships are of degree 3, rarely 5."""

_FARTHEST = 1e6

_WIDEST = 1e4
"""Weights differ by this factor at most: bounds of errors grow with a power of it."""

_SAME = 1e-12

Limits = tuple[float, float]


def checked_name(value: object) -> str:
    """Take the name of a surface: text of one line, which may be empty."""
    found = word(value, "name", "in a surface")
    if not found.isprintable():
        raise BadInputError(
            f"name is {shown(value)}", "in a surface", "give printable text in one line"
        )
    return found


def _array(value: object, name: str, where: str, remedy: str) -> FloatArray:
    """Give numbers as an array of their own, or say that they are none."""
    try:
        given = np.asarray(value)
        if given.dtype.kind not in "iuf":
            raise TypeError(given.dtype)
        return np.array(given, np.float64) + 0.0
    except (TypeError, ValueError, OverflowError):
        raise WrongTypeError(f"{name} is {shown(value)}", where, remedy) from None


def checked_net(value: object, where: str) -> FloatArray:
    """Take a control net (nu, nv, 3), m, of at least two points each way.

    Raises
    ------
    BadInputError
        Another shape, or a number that is not finite or above 1e6 m.
    """
    remedy = "give an array (nu, nv, 3), m, with at least two points each way"
    net = _array(value, "net", where, remedy)
    if net.ndim != 3 or net.shape[2] != 3 or min(net.shape) < 2:
        raise BadInputError(f"net is of shape {net.shape}", where, remedy)
    bad = np.argwhere(~(np.abs(net) <= _FARTHEST))
    if len(bad):
        i, j, axis = (int(each) for each in bad[0])
        raise BadInputError(
            f"{'xyz'[axis]} of the control point {i}, {j} is {net[i, j, axis]:g}",
            where, f"give finite numbers up to {_FARTHEST:g} m",
        )  # fmt: skip
    return net


def checked_degrees(value: object, net: FloatArray, where: str) -> tuple[int, int]:
    """Take the degrees in u and v of a net (nu, nv, 3).

    Raises
    ------
    BadInputError
        No pair of whole numbers from 1 to 7, or fewer points than a degree needs.
    """
    if not isinstance(value, tuple | list) or len(value) != 2:
        raise WrongTypeError(f"degrees is {shown(value)}", where, "give a pair of whole numbers")
    most = HIGHEST_DEGREE
    m, n = (integer(each, "a degree", where, least=1, most=most) for each in value)
    for degree, count, axis in zip((m, n), net.shape, "uv", strict=False):
        if count <= degree:
            raise BadInputError(
                f"net has {count} control points in {axis} for degree {degree}",
                where, f"give at least {degree + 1}",
            )  # fmt: skip
    return m, n


def checked_surface_knots(
    values: tuple[object, object], degrees: tuple[int, int], net: FloatArray, where: str
) -> tuple[FloatArray, FloatArray]:
    """Take the knots in u and v of a net (nu, nv, 3); raises as `checked_knots`."""
    (m, n), (nu, nv) = degrees, net.shape[:2]
    return (
        checked_knots(values[0], m, nu, "knots_u", where),
        checked_knots(values[1], n, nv, "knots_v", where),
    )


def checked_weights(value: object, net: FloatArray, where: str) -> FloatArray | None:
    """Take weights (nu, nv) of a net (nu, nv, 3); None if there are none, or all are equal.

    Raises
    ------
    BadInputError
        Another shape, a weight that is not above 0, or weights of very different size.
    """
    if value is None:
        return None
    remedy = f"give a number above 0 for each control point, an array {net.shape[:2]}"
    weights = _array(value, "weights", where, remedy)
    if weights.shape != net.shape[:2]:
        raise BadInputError(f"weights is of shape {weights.shape}", where, remedy)
    bad = np.argwhere(~((weights > 0.0) & (weights < np.inf)))
    if len(bad):
        i, j = (int(each) for each in bad[0])
        raise BadInputError(
            f"the weight of the control point {i}, {j} is {weights[i, j]:g}", where, remedy
        )
    least, most = float(weights.min()), float(weights.max())
    if most > _WIDEST * least:
        raise BadInputError(
            f"weights lie between {least:g} and {most:g}",
            where, f"the greatest may be {_WIDEST:g} times the least",
        )  # fmt: skip
    return None if least == most else weights


def _inside(t: FloatArray, limits: Limits, axis: str, where: str) -> None:
    """Refuse parameters outside the domain."""
    bad = t[~((t >= limits[0]) & (t <= limits[1]))]
    if len(bad):
        raise BadInputError(
            f"{axis} is {bad[0]:g}", where, f"give {axis} from {limits[0]:g} to {limits[1]:g}"
        )


def checked_parameters(
    u: object, v: object, domain: tuple[Limits, Limits], where: str
) -> tuple[FloatArray, FloatArray]:
    """Take parameters in the domain of a surface, numbers or arrays, broadcast.

    Raises
    ------
    BadInputError
        No numbers, outside the domain, or arrays that do not fit each other.
    """
    found = [_array(each, axis, where, "give numbers") for each, axis in ((u, "u"), (v, "v"))]
    for t, limits, axis in zip(found, domain, "uv", strict=True):
        _inside(t.ravel(), limits, axis, where)
    try:
        first, second = np.broadcast_arrays(*found)
    except ValueError:
        shapes = " and ".join(str(each.shape) for each in found)
        raise BadInputError(
            f"u and v are of shapes {shapes}", where, "give arrays that broadcast"
        ) from None
    return first, second


def _between(value: object, limits: Limits, axis: str, where: str) -> Limits:
    """Take two rising parameters; those within rounding of an end are the end."""
    given = _array(value, axis, where, "give (low, high)")
    if given.shape != (2,):
        raise WrongTypeError(f"{axis} is {shown(value)}", where, "give (low, high)")
    room = _SAME * max(abs(limits[0]), abs(limits[1]))
    ends = [next((end for end in limits if abs(t - end) <= room), t) for t in given.tolist()]
    _inside(np.array(ends), limits, axis, where)
    if not ends[1] - ends[0] > room:
        raise BadInputError(f"{axis} is {shown(value)}", where, "give (low, high), rising")
    return ends[0], ends[1]


def checked_part(
    u: object, v: object, domain: tuple[Limits, Limits], where: str
) -> tuple[Limits, Limits]:
    """Take a part of the domain of a surface: two rising parameters each way.

    Raises
    ------
    BadInputError
        Anything else.
    """
    return _between(u, domain[0], "u", where), _between(v, domain[1], "v", where)
