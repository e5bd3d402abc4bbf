"""Polynomials in power form, many at once: values, derivatives, and roots in [0, 1].

Rows stand for polynomials, ascending powers along the second axis. The result of one row is
the same to the last bit whatever the other rows are.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = ["differentiate", "horner", "quadratic_roots", "unit_roots"]

_ROUNDING = 4e-16  # a step below this changes nothing in [0, 1]
_HALVINGS = 80  # more than bisection alone needs


def differentiate(coefficients: FloatArray) -> FloatArray:
    """Differentiate polynomials in power form.

    Parameters
    ----------
    coefficients : (s, d + 1, ...)
        Ascending powers along the second axis.

    Returns
    -------
    (s, d, ...)
        The coefficients of the derivatives.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.polynomials import differentiate
    >>> differentiate(np.array([[5.0, 1.0, 4.0]]))
    array([[1., 8.]])
    """
    factors = np.arange(1.0, coefficients.shape[1])
    slopes: FloatArray = coefficients[:, 1:] * factors.reshape(-1, *(1,) * (coefficients.ndim - 2))
    freeze(slopes)
    return slopes


def horner(coefficients: FloatArray, u: FloatArray) -> FloatArray:
    """Evaluate polynomials in power form.

    Parameters
    ----------
    coefficients : (s, d + 1) or (s, d + 1, 3)
        Ascending powers along the second axis.
    u : (s, k)
        Parameters, k for each polynomial.

    Returns
    -------
    (s, k) or (s, k, 3)
        The values.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.polynomials import horner
    >>> horner(np.array([[1.0, 0.0, 2.0]]), np.array([[0.0, 0.5, 1.0]]))
    array([[1. , 1.5, 3. ]])
    """
    at = u[..., None] if coefficients.ndim == 3 else u
    value = coefficients[:, -1, None] + 0.0 * at
    for column in range(coefficients.shape[1] - 2, -1, -1):
        value = value * at + coefficients[:, column, None]
    result: FloatArray = value
    freeze(result)
    return result


def quadratic_roots(constant: FloatArray, linear: FloatArray, square: FloatArray) -> FloatArray:
    """Give the real roots of ``constant + linear u + square u^2``.

    Parameters
    ----------
    constant, linear, square : (p,)
        The coefficients.

    Returns
    -------
    (p, 2)
        The roots in ascending order; nan where there are none, and infinite or nan where
        the degree is less than two.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.polynomials import quadratic_roots
    >>> quadratic_roots(np.array([2.0, 1.0]), np.array([-3.0, 0.0]), np.array([1.0, 1.0]))
    array([[ 1.,  2.],
           [nan, nan]])
    """
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        discriminant = linear * linear - 4.0 * constant * square
        # Adding numbers of one sign keeps the digits that the textbook formula loses.
        larger = -0.5 * (linear + np.copysign(np.sqrt(discriminant), linear))
        pair = np.stack([larger / square, constant / larger], axis=-1)
    # 0 / 0 with a root at nil: both roots are nil there.
    pair[..., 1] = np.where(larger == 0.0, pair[..., 0], pair[..., 1])
    roots: FloatArray = np.sort(pair, axis=-1)
    freeze(roots)
    return roots


def unit_roots(coefficients: FloatArray) -> FloatArray:
    """Split [0, 1] so that each polynomial keeps its sign on every part.

    Between neighbouring roots of its derivative a polynomial is monotone and has one root at
    most, which bisection with Newton steps cannot miss. No coefficient is divided by, so a
    polynomial of lower degree than its row is as good as any.

    Parameters
    ----------
    coefficients : (p, d + 1), d >= 2
        Ascending powers.

    Returns
    -------
    (p, d)
        Ascending parameters in [0, 1]: every root at which the sign changes, and harmless
        repetitions or other places in the room that is left.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.polynomials import unit_roots
    >>> cubic = np.array([[-0.09375, 0.6875, -1.5, 1.0]])  # (u - 1/4) (u - 1/2) (u - 3/4)
    >>> [round(float(u), 12) for u in unit_roots(cubic)[0]]
    [0.25, 0.5, 0.75]
    """
    count, degree = coefficients.shape[0], coefficients.shape[1] - 1
    if degree == 2:
        roots = quadratic_roots(coefficients[:, 0], coefficients[:, 1], coefficients[:, 2])
        clipped = np.sort(np.clip(np.where(np.isnan(roots), 0.0, roots), 0.0, 1.0), axis=1)
        freeze(clipped)
        return clipped
    inner = unit_roots(differentiate(coefficients))
    edge = np.concatenate([np.zeros((count, 1)), inner, np.ones((count, 1))], axis=1)
    negative = horner(coefficients, edge) < 0.0
    row, column = np.nonzero(negative[:, :-1] != negative[:, 1:])
    found = edge[:, :-1].copy()
    found[row, column] = _bracketed(
        coefficients[row], edge[row, column], edge[row, column + 1], negative[row, column]
    )
    freeze(found)
    return found


def _bracketed(
    coefficients: FloatArray, low: FloatArray, high: FloatArray, rising: NDArray[np.bool_]
) -> FloatArray:
    """Find the one root in each bracket: Newton steps where they halve, else bisection."""
    slopes = differentiate(coefficients)
    at, last = 0.5 * (low + high), high - low
    alive = np.ones(len(at), bool)
    for _ in range(_HALVINGS):
        if not alive.any():
            break
        value = horner(coefficients, at[:, None])[:, 0]
        right = (value < 0.0) == rising
        low, high = np.where(right, at, low), np.where(right, high, at)
        with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
            aim = at - value / horner(slopes, at[:, None])[:, 0]
            good = (aim >= low) & (aim <= high) & (np.abs(aim - at) <= 0.5 * last)
        aim = np.where(value == 0.0, at, np.where(good, aim, 0.5 * (low + high)))
        last = np.abs(aim - at)
        # A root that has settled stays: its last bit must not depend on the others.
        at = np.where(alive, aim, at)
        alive &= last > _ROUNDING
    return at
