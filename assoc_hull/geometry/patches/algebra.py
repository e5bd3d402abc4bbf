"""Polynomials of two parameters in Bernstein form: sums, products, derivatives, parts.

A polynomial of degrees (m, n) on the unit square is

    p(u, v) = sum over i, j of  a[i, j] C(m, i) u**i (1 - u)**(m - i) C(n, j) v**j (1 - v)**(n - j)

It lies between its least and its greatest coefficient. Coefficients are arrays (..., m + 1, n + 1);
the first of the last two axes is u. Leading axes are a batch and broadcast, as in numpy. A degree
is always a length less one. Vectors have their components as the third axis from the end:
(..., 3, m + 1, n + 1). What is found for one polynomial does not depend on the rest of the batch,
to the last bit.

Products are convolutions of coefficients times binomials, summed term by term: a fast Fourier
transform would spread the rounding of the largest coefficients over the small ones.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.algebra import multiply
>>> u, v = np.array([[0.0], [1.0]]), np.array([[0.0, 1.0]])
>>> multiply(u, v)
array([[0., 0.],
       [0., 1.]])
"""

from __future__ import annotations

import math
from functools import cache

import numpy as np

from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = [
    "across", "add", "binomials", "cross", "degrees", "dot", "elevated", "elevation", "halves",
    "integral", "lowered", "multiply", "split", "subtract", "u_derivative", "v_derivative",
]  # fmt: skip


@cache
def binomials(degree: int) -> FloatArray:
    """Give the binomial coefficients of a degree, (degree + 1,).

    Examples
    --------
    >>> from assoc_hull.geometry.patches.algebra import binomials
    >>> binomials(3)
    array([1., 3., 3., 1.])
    """
    found = np.array([math.comb(degree, i) for i in range(degree + 1)], np.float64)
    freeze(found)
    return found


@cache
def _weights(m: int, n: int) -> FloatArray:
    """Give the products of binomial coefficients of a bidegree."""
    found = np.outer(binomials(m), binomials(n))
    freeze(found)
    return found


def degrees(a: FloatArray) -> tuple[int, int]:
    """Give the degrees in u and v of coefficients (..., m + 1, n + 1)."""
    return a.shape[-2] - 1, a.shape[-1] - 1


def _batch_last(a: FloatArray) -> FloatArray:
    """Give coefficients (..., m + 1, n + 1) times binomials, as (m + 1, n + 1, ...)."""
    return np.ascontiguousarray(np.moveaxis(a * _weights(*degrees(a)), (-2, -1), (0, 1)))


def multiply(a: FloatArray, b: FloatArray) -> FloatArray:
    """Multiply polynomials.

    Parameters
    ----------
    a, b : (..., m + 1, n + 1) and (..., p + 1, q + 1)
        Coefficients; vectors times scalars and the like broadcast.

    Returns
    -------
    (..., m + p + 1, n + q + 1)
        Coefficients of the product, each a sum of at most as many terms as the smaller factor has
        coefficients.
    """
    if a.shape[-2] * a.shape[-1] > b.shape[-2] * b.shape[-1]:
        return multiply(b, a)
    (m, n), (p, q) = degrees(a), degrees(b)
    axes = max(a.ndim, b.ndim)
    a, b = (_batch_last(each.reshape((1,) * (axes - each.ndim) + each.shape)) for each in (a, b))
    batch = np.broadcast_shapes(a.shape[2:], b.shape[2:])
    found, part = np.zeros((m + p + 1, n + q + 1, *batch)), np.empty((*b.shape[:2], *batch))
    for i in range(m + 1):
        for j in range(n + 1):
            found[i : i + p + 1, j : j + q + 1] += np.multiply(a[i, j], b, out=part)
    found = np.moveaxis(found, (0, 1), (-2, -1))
    found /= _weights(m + p, n + q)
    return found


@cache
def elevation(degree: int, by: int) -> FloatArray:
    """Give the matrix (degree + by + 1, degree + 1) that raises a degree.

    Examples
    --------
    >>> from assoc_hull.geometry.patches.algebra import elevation
    >>> elevation(1, 1)
    array([[1. , 0. ],
           [0.5, 0.5],
           [0. , 1. ]])
    """
    found = np.zeros((degree + by + 1, degree + 1))
    for i in range(degree + by + 1):
        for j in range(max(0, i - by), min(degree, i) + 1):
            found[i, j] = math.comb(degree, j) * math.comb(by, i - j) / math.comb(degree + by, i)
    freeze(found)
    return found


def across(left: FloatArray, a: FloatArray, right: FloatArray) -> FloatArray:
    """Apply one matrix to the rows (u) and another to the columns (v) of coefficients.

    Parameters
    ----------
    left, right : (p, m + 1) and (q, n + 1)
        The matrices.
    a : (..., m + 1, n + 1)
        Coefficients.

    Returns
    -------
    (..., p, q)
        ``left @ a @ right.T``. Coefficients are laid one behind the other first: only then has a
        matrix product the same bits for one polynomial, alone or in a batch.
    """
    found: FloatArray = left @ np.ascontiguousarray(a) @ right.T
    return found


def elevated(a: FloatArray, m: int, n: int) -> FloatArray:
    """Write polynomials with degrees m and n, none below their own.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.patches.algebra import elevated
    >>> elevated(np.array([[0.0, 2.0]]), 0, 2)
    array([[0., 1., 2.]])
    """
    p, q = degrees(a)
    if (p, q) == (m, n):
        return a
    return across(elevation(p, m - p), a, elevation(q, n - q))


def _alike(a: FloatArray, b: FloatArray) -> tuple[FloatArray, FloatArray]:
    (m, n), (p, q) = degrees(a), degrees(b)
    return elevated(a, max(m, p), max(n, q)), elevated(b, max(m, p), max(n, q))


def add(a: FloatArray, b: FloatArray) -> FloatArray:
    """Add polynomials; the lower degrees are raised."""
    a, b = _alike(a, b)
    return a + b


def subtract(a: FloatArray, b: FloatArray) -> FloatArray:
    """Subtract polynomials; the lower degrees are raised."""
    a, b = _alike(a, b)
    return a - b


def u_derivative(a: FloatArray) -> FloatArray:
    """Differentiate with respect to u; a constant gives nil, of degree 0."""
    m = a.shape[-2] - 1
    if m == 0:
        return np.zeros_like(a)
    found: FloatArray = m * (a[..., 1:, :] - a[..., :-1, :])
    return found


def v_derivative(a: FloatArray) -> FloatArray:
    """Differentiate with respect to v; a constant gives nil, of degree 0."""
    n = a.shape[-1] - 1
    if n == 0:
        return np.zeros_like(a)
    found: FloatArray = n * (a[..., 1:] - a[..., :-1])
    return found


def dot(a: FloatArray, b: FloatArray) -> FloatArray:
    """Give the scalar product of vectors (..., d, m + 1, n + 1), added in one order."""
    found = multiply(a, b)
    total = found[..., 0, :, :]
    for i in range(1, found.shape[-3]):
        total = total + found[..., i, :, :]
    return np.asarray(total)


def cross(a: FloatArray, b: FloatArray) -> FloatArray:
    """Give the vector product of vectors (..., 3, m + 1, n + 1)."""
    after, last = [1, 2, 0], [2, 0, 1]
    first = multiply(a[..., after, :, :], b[..., last, :, :])
    return first - multiply(a[..., last, :, :], b[..., after, :, :])


def integral(a: FloatArray) -> FloatArray:
    """Integrate over the unit square: the mean of the coefficients.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.patches.algebra import integral
    >>> integral(np.array([[0.0, 1.0], [2.0, 3.0]])).item()
    1.5
    """
    rows = np.ascontiguousarray(a).reshape(*a.shape[:-2], -1)
    return np.asarray(rows.sum(axis=-1) / rows.shape[-1])


def lowered(a: FloatArray, axis: int) -> FloatArray:
    """Write polynomials with a degree less, whose highest power is known to have no share.

    Parameters
    ----------
    a : (..., m + 1, n + 1)
        Coefficients of degree 1 or more along the axis.
    axis : int
        -2 for u, -1 for v.

    Returns
    -------
    (..., m, n + 1) or (..., m + 1, n)
        Coefficients. Those of the lower half are found from the start, the others from the end,
        so that rounding does not grow.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.patches.algebra import lowered
    >>> lowered(np.array([[0.0, 1.0, 2.0]]), -1)
    array([[0., 2.]])
    """
    a = np.moveaxis(a, axis, 0)
    n = len(a) - 1
    found, middle = np.empty((n, *a.shape[1:])), (n + 1) // 2
    for i in range(middle):
        found[i] = n * a[i] - i * found[i - 1] if i else n * a[0]
        found[i] /= n - i
    for i in range(n - 1, middle - 1, -1):
        found[i] = n * a[i + 1] - (n - 1 - i) * found[i + 1] if i < n - 1 else n * a[n]
        found[i] /= i + 1
    return np.moveaxis(found, 0, axis)


@cache
def split(degree: int, at: float) -> tuple[FloatArray, FloatArray]:
    """Give the matrices that restrict coefficients to [0, at] and to [at, 1].

    Examples
    --------
    >>> from assoc_hull.geometry.patches.algebra import split
    >>> split(1, 0.25)[0]
    array([[1.  , 0.  ],
           [0.75, 0.25]])
    """
    lower = np.zeros((degree + 1, degree + 1))
    upper = np.zeros((degree + 1, degree + 1))
    for i in range(degree + 1):
        for j in range(i + 1):
            lower[i, j] = math.comb(i, j) * at**j * (1.0 - at) ** (i - j)
        for j in range(degree - i + 1):
            rest = degree - i
            upper[i, i + j] = math.comb(rest, j) * at**j * (1.0 - at) ** (rest - j)
    freeze(lower, upper)
    return lower, upper


def halves(a: FloatArray, u: float, v: float) -> tuple[FloatArray, ...]:
    """Cut the square at u and v: low-low, low-high, high-low and high-high coefficients."""
    m, n = degrees(a)
    return tuple(across(rows, a, columns) for rows in split(m, u) for columns in split(n, v))
