"""Polynomials in power form, many at once: values and derivatives.

Rows stand for polynomials, ascending powers along the second axis. The result of one row is
the same to the last bit whatever the other rows are. Coefficients and parameters may be
complex or carry tangents (`assoc_hull.geometry.numeric.dual.Dual`); so then do the results.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = [
    "cubic_values",
    "differentiate",
    "hermite",
    "horner",
    "stationary_fractions",
]


def cubic_values(
    origin: FloatArray,
    first: FloatArray,
    second: FloatArray,
    third: FloatArray,
    fraction: FloatArray,
) -> FloatArray:
    """Evaluate cubics given by their powers, by Horner's rule.

    Parameters
    ----------
    origin, first, second, third : (k,), any unit
        Coefficients of 1, u, u**2, u**3.
    fraction : (k,)
        The arguments u.

    Returns
    -------
    (k,), the unit of the coefficients
        The values.

    Examples
    --------
    >>> cubic_values(*np.array([[1.0], [1.0], [0.0], [2.0]]), np.array([0.5]))
    array([1.75])
    """
    result = third * fraction
    result += second
    result *= fraction
    result += first
    result *= fraction
    result += origin
    return result


def stationary_fractions(
    first: FloatArray, second: FloatArray, third: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Cut cubics into three parts that are monotone.

    Parameters
    ----------
    first, second, third : (k,), any unit
        Coefficients of u, u**2, u**3.

    Returns
    -------
    lower, upper : (k,)
        Fractions ``0 <= lower <= upper <= 1`` where the derivative is zero; a fraction that
        is not needed is 0 or 1.

    Examples
    --------
    >>> stationary_fractions(np.array([3.0]), np.array([-8.0]), np.array([4.0]))
    (array([0.]), array([0.2257]))
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        # Sum of equal signs only, so that neither root loses digits.
        root = np.sqrt(second * second - 3.0 * (third * first))
        sum_ = -(second + np.copysign(root, second))
        one, other = sum_ / (3.0 * third), first / sum_
    one = np.where((one > 0.0) & (one < 1.0), one, 0.0)
    other = np.where((other > 0.0) & (other < 1.0), other, 0.0)
    lower, upper = np.minimum(one, other), np.maximum(one, other)
    return lower, np.where(upper > 0.0, upper, 1.0)


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
