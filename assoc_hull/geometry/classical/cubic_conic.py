"""A conic with one more term: it joins what is before it with the same curvature.

    (y - A)^2 = b1 v + b2 v^2 + b3 v^3,      v from 0 at the end to 1 at the join.

Height Y1 = y - A, slope s and second derivative c by v at the join give, with
z = Y1^2, z' = 2 Y1 s, z'' = 2 (s^2 + Y1 c):

    b3 = z - z' + z''/2,    b2 = z''/2 - 3 b3,    b1 = z - b2 - b3.

Source: Kim & Chang, "Some Representations of Ship Hulls by Mathematical Method for Design and
Production", J. SNAK.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checked_input import number, numbers, together
from assoc_hull.geometry.classical.checks import figure
from assoc_hull.geometry.classical.linear_least_squares import held_fit, linear_fit
from assoc_hull.geometry.classical.pieces import Piece
from assoc_hull.geometry.curves import FloatArray

__all__ = ["cubic_conic", "cubic_conic_coefficients", "fit_cubic_conic"]


def cubic_conic_coefficients(height: ArrayLike, slope: ArrayLike, bend: ArrayLike) -> FloatArray:
    """Give b1, b2, b3 of many cubic conics.

    Parameters
    ----------
    height : (...), m
        Y1 = y - A at the join.
    slope, bend : (...), m
        dy/dv and d2y/dv2 there; d2y/dv2 is d2y/dx2 times the square of the length.

    Returns
    -------
    (..., 3), m2

    Examples
    --------
    >>> from assoc_hull.geometry.classical.cubic_conic import cubic_conic_coefficients
    >>> cubic_conic_coefficients(2.0, 1.0, -0.5).tolist()
    [4.0, 0.0, 0.0]
    """
    y, s, c = together((height, slope, bend), "cubic conic")
    z, first, half = y * y, 2.0 * y * s, s * s + y * c
    b3 = z - first + half
    b2 = half - 3.0 * b3
    return np.stack([z - b2 - b3, b2, b3], axis=-1)


def cubic_conic(
    first: float, last: float, y: float, slope: float, second: float, end: float = 0.0
) -> Piece:
    """Make the cubic conic that goes on from a curve with value, slope and second derivative.

    Parameters
    ----------
    first, last : float, m
        The join, and the end, where the tangent is upright.
    y, slope, second : float, m, 1, 1/m
        y, dy/dx and d2y/dx2 at `first`.
    end : float, m
        A, half-breadth at `last`.

    Returns
    -------
    Piece
        Joins with continuous second derivative.

    Raises
    ------
    GeometryError
        ``"cubic conic: b1 <= 0 at the end"``, ``"cubic conic: radicand negative at v={v}"``.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.cubic_conic import cubic_conic
    >>> piece = cubic_conic(60.0, 75.0, 6.5, -0.2628518890, -0.0042571462)
    >>> piece.coefficients[1:].round(6).tolist(), float(piece.at(67.5).round(6))
    ([33.557188, 8.379506, 0.313306], 4.348866)
    """
    given = numbers([first, last, y, slope, second, end], "cubic conic", (6,))
    begin, finish, value, rise, bend, level = given.tolist()
    if not begin < finish:
        what = f"cubic conic: from x={figure(begin)} to x={figure(finish)}"
        raise GeometryError(what, "let it end beyond its beginning")
    length = finish - begin
    b = cubic_conic_coefficients(value - level, -rise * length, bend * length**2)
    return _checked(begin, finish, b, level)


def fit_cubic_conic(
    x: ArrayLike,
    y: ArrayLike,
    first: float,
    last: float,
    end: float = 0.0,
    value: float | None = None,
    slope: float | None = None,
) -> Piece:
    """Fit a cubic conic to offsets.

    Squares of heights are fitted, weighted by 1/(2 (y - A))^2, so that to first order the sum of
    squares of distances in y is least.

    Parameters
    ----------
    x, y : (n,), m
        Offsets; y above `end`.
    first, last : float, m
        Where it begins and ends.
    end : float, m
        A, half-breadth at `last`.
    value, slope : float or None, m and 1
        y and dy/dx at `first`, held where given; a slope only beside a value.

    Raises
    ------
    GeometryError
        As `cubic_conic`; offsets outside the piece or not above `end`, too few of them.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.classical.cubic_conic import fit_cubic_conic
    >>> x = np.array([1.0, 4.0, 7.0, 9.5])
    >>> fit_cubic_conic(x, np.sqrt(4.0 * (10.0 - x)), 0.0, 10.0).coefficients.round(9).tolist()
    [0.0, 40.0, 0.0, 0.0]
    """
    limits = numbers([first, last, end], "cubic conic", (3,)).tolist()
    begin, finish, level = limits
    if not begin < finish:
        what = f"cubic conic: from x={figure(begin)} to x={figure(finish)}"
        raise GeometryError(what, "let it end beyond its beginning")
    places = numbers(x, "cubic conic", (None,))
    heights = numbers(y, "cubic conic", (len(places),)) - level
    v = (finish - places) / (finish - begin)
    bad = np.flatnonzero((v <= 0.0) | (v > 1.0) | (heights <= 0.0))
    if len(bad):
        what = f"cubic conic: offset at x={figure(places[bad[0]])} outside the piece"
        raise GeometryError(what, "leave it out", {"x": float(places[bad[0]])})
    columns = np.stack([v, v * v, v**3], axis=1)
    weights = 1.0 / (2.0 * heights) ** 2
    held, values = _held(value, slope, level, finish - begin)
    if len(held):
        fit = held_fit(columns, heights**2, held, values, weights, "cubic conic")
    else:
        fit = linear_fit(columns, heights**2, weights, "cubic conic")
    return _checked(begin, finish, fit.coefficients, level)


def _held(
    value: float | None, slope: float | None, level: float, length: float
) -> tuple[list[list[float]], list[float]]:
    """Give the equations of b1, b2, b3 at v = 1."""
    if value is None:
        if slope is not None:
            raise GeometryError("cubic conic: a slope without a value", "give both, or neither")
        return [], []
    height = number(value, "cubic conic") - level
    held, values = [[1.0, 1.0, 1.0]], [height * height]
    if slope is not None:
        rise = -number(slope, "cubic conic") * length
        held.append([1.0, 2.0, 3.0])
        values.append(2.0 * height * rise)
    return held, values


def _checked(first: float, last: float, b: FloatArray, level: float) -> Piece:
    b1, b2, b3 = b.tolist()
    if b1 <= 0.0:
        what = f"cubic conic: b1 <= 0 at the end (b1 = {figure(b1)})"
        raise GeometryError(what, "move the join, or take less slope or bend", {"b1": b1})
    # The radicand is v times b1 + b2 v + b3 v^2: where that is least decides.
    places = [1.0]
    if b3 != 0.0 and 0.0 < -b2 / (2.0 * b3) < 1.0:
        places.append(-b2 / (2.0 * b3))
    for v in places:
        if b1 + b2 * v + b3 * v * v < 0.0:
            what = f"cubic conic: radicand negative at v={figure(v)}"
            raise GeometryError(what, "move the join, or take less slope or bend", {"v": v})
    return Piece("cubic conic", first, last, np.array([0.0, b1, b2, b3]), level)
