"""Polynomials in power form, many at once: values and derivatives.

Rows stand for polynomials, ascending powers along the second axis. The result of one row is
the same to the last bit whatever the other rows are. Coefficients and parameters may be
complex or carry tangents (`assoc_hull.geometry.numeric.dual.Dual`); so then do the results.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.numeric.dual import is_plain, real

__all__ = ["differentiate", "hermite", "horner", "varied_roots"]


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
    >>> from assoc_hull.geometry.numeric.polynomials import differentiate
    >>> differentiate(np.array([[5.0, 1.0, 4.0]]))
    array([[1., 8.]])
    """
    factors = np.arange(1.0, coefficients.shape[1])
    slopes: FloatArray = coefficients[:, 1:] * factors.reshape(-1, *(1,) * (coefficients.ndim - 2))
    freeze(slopes)
    return slopes


def hermite(
    begin: FloatArray, end: FloatArray, leave: FloatArray, arrive: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Give cubics from 0 to 1 by values and slopes at both ends.

    Parameters
    ----------
    begin, end : any shape
        Values at 0 and 1.
    leave, arrive : the same shape
        Derivatives there.

    Returns
    -------
    four arrays of that shape
        The coefficients of 1, u, u^2 and u^3.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.numeric.polynomials import hermite
    >>> [float(each[0]) for each in hermite(*np.array([[0.0], [1.0], [0.0], [0.0]]))]
    [0.0, 0.0, 3.0, -2.0]
    """
    rise = end - begin
    return begin, leave, 3.0 * rise - 2.0 * leave - arrive, leave + arrive - 2.0 * rise


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
    >>> from assoc_hull.geometry.numeric.polynomials import horner
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


def varied_roots(coefficients: FloatArray, u: FloatArray, simple: NDArray[np.bool_]) -> FloatArray:
    """Let roots vary with the coefficients of their polynomials, as ``p(u) = 0`` wants.

    Parameters
    ----------
    coefficients : (s, d + 1)
        Ascending powers along the second axis.
    u : (s, k)
        Roots for the plain values of the coefficients, k for each polynomial.
    simple : (s, k) bool
        Which of them are to vary: simple roots; other places stay.

    Returns
    -------
    (s, k)
        The same values; with tangents or an imaginary part if the coefficients have any.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.numeric.dual import Dual
    >>> from assoc_hull.geometry.numeric.polynomials import varied_roots
    >>> square = Dual([[-4.0, 0.0, 1.0]], [[[-1.0, 0.0, 0.0]]])  # u^2 = 4 + e, u = 2 + e / 4
    >>> varied_roots(square, np.array([[2.0]]), np.array([[True]])).dot.tolist()
    [[[0.25]]]
    """
    if is_plain(coefficients):
        return u
    left = horner(coefficients, u)
    slope = np.where(simple, horner(differentiate(real(coefficients)), u), np.inf)
    roots: FloatArray = u - (left - real(left)) / slope
    return roots
