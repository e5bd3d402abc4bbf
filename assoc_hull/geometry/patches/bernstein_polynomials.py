"""Polynomials of two parameters in Bernstein form: algebra, error bounds, sign changes.

Coefficients are arrays (..., m + 1, n + 1), one batch for many patches.
`BoundedPolynomial` carries error bounds through every operation, also of uncertain control points.
`sign_change_roots` solves many polynomials of one parameter at a time, each with one sign change.
"""

from __future__ import annotations

import math
from functools import cache
from typing import Self

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = [
    "EPS",
    "BoundedPolynomial",
    "add_polynomials",
    "binomials",
    "cross_polynomials",
    "degrees",
    "dot_polynomials",
    "elevated",
    "elevation",
    "integral",
    "lowered",
    "multiply",
    "power_table",
    "restriction_matrices",
    "sign_change_roots",
    "subtract",
    "transform_coefficients",
    "u_derivative",
    "v_derivative",
]

# With B_i(u) = C(m, i) u**i (1 - u)**(m - i), coefficients a of degrees (m, n) are the polynomial
# sum over i, j of a[i, j] B_i(u) B_j(v) on the unit square, which lies between the least and the
# greatest of them. Leading axes are a batch and broadcast; vectors have their components third from
# the end. What is found for one polynomial does not depend on the rest of the batch, to the bit.


@cache
def binomials(degree: int) -> FloatArray:
    """Give the binomial coefficients of a degree, (degree + 1,).

    Examples
    --------
    >>> from assoc_hull.geometry.patches.bernstein_polynomials import binomials
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
    """Multiply polynomials: convolutions of coefficients times binomials, summed term by term.

    A fast Fourier transform would spread the rounding of the largest coefficients over small ones.

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
    >>> from assoc_hull.geometry.patches.bernstein_polynomials import elevation
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


def transform_coefficients(left: FloatArray, a: FloatArray, right: FloatArray) -> FloatArray:
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
    >>> from assoc_hull.geometry.patches.bernstein_polynomials import elevated
    >>> elevated(np.array([[0.0, 2.0]]), 0, 2)
    array([[0., 1., 2.]])
    """
    p, q = degrees(a)
    if (p, q) == (m, n):
        return a
    return transform_coefficients(elevation(p, m - p), a, elevation(q, n - q))


def _alike(a: FloatArray, b: FloatArray) -> tuple[FloatArray, FloatArray]:
    (m, n), (p, q) = degrees(a), degrees(b)
    return elevated(a, max(m, p), max(n, q)), elevated(b, max(m, p), max(n, q))


def add_polynomials(a: FloatArray, b: FloatArray) -> FloatArray:
    """Add polynomials; the lower degrees are raised."""
    a, b = _alike(a, b)
    return a + b


def subtract(a: FloatArray, b: FloatArray) -> FloatArray:
    """Subtract polynomials; the lower degrees are raised."""
    a, b = _alike(a, b)
    return a - b


def u_derivative(a: FloatArray) -> FloatArray:
    """Differentiate with respect to u; a constant gives zero, of degree 0."""
    m = a.shape[-2] - 1
    if m == 0:
        return np.zeros_like(a)
    found: FloatArray = m * (a[..., 1:, :] - a[..., :-1, :])
    return found


def v_derivative(a: FloatArray) -> FloatArray:
    """Differentiate with respect to v; a constant gives zero, of degree 0."""
    n = a.shape[-1] - 1
    if n == 0:
        return np.zeros_like(a)
    found: FloatArray = n * (a[..., 1:] - a[..., :-1])
    return found


def dot_polynomials(a: FloatArray, b: FloatArray) -> FloatArray:
    """Give the scalar product of vectors (..., d, m + 1, n + 1), added in one order."""
    found = multiply(a, b)
    total = found[..., 0, :, :]
    for i in range(1, found.shape[-3]):
        total = total + found[..., i, :, :]
    return np.asarray(total)


def cross_polynomials(a: FloatArray, b: FloatArray) -> FloatArray:
    """Give the vector product of vectors (..., 3, m + 1, n + 1)."""
    after, last = [1, 2, 0], [2, 0, 1]
    first = multiply(a[..., after, :, :], b[..., last, :, :])
    return first - multiply(a[..., last, :, :], b[..., after, :, :])


def integral(a: FloatArray) -> FloatArray:
    """Integrate over the unit square: the mean of the coefficients.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.patches.bernstein_polynomials import integral
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
    >>> from assoc_hull.geometry.patches.bernstein_polynomials import lowered
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
def restriction_matrices(degree: int, at: float) -> tuple[FloatArray, FloatArray]:
    """Give the matrices that restrict coefficients to [0, at] and to [at, 1].

    Examples
    --------
    >>> from assoc_hull.geometry.patches.bernstein_polynomials import restriction_matrices
    >>> restriction_matrices(1, 0.25)[0]
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


# --------------------------------------------------------------------------------------
# Error bounds. With a true a' within e of the computed a, coefficient by coefficient, and b' within
# f of b, the product is off by at most |a| f + e (|b| + f), and by its own roundings: (number of
# terms + 6) x 2**-53 x |a| |b|. Sizes are those of the computed coefficients, after all that
# cancelled in them, so these bounds stay close where a small sum has large terms.

EPS = 2.0**-53

_MARGIN = 1.01
"""For the roundings of the bounds themselves, which are as many, and of products of them."""


@attrs.frozen(eq=False)
class BoundedPolynomial:
    """Coefficients, and what each may be off by.

    Attributes
    ----------
    b, err : (..., m + 1, n + 1)
        Both; vectors have their components as the third axis from the end.
    """

    b: FloatArray
    err: FloatArray

    def __getitem__(self, components: list[int] | slice) -> Self:
        """Take some components of vectors (k, d, m + 1, n + 1)."""
        return type(self)(self.b[:, components], self.err[:, components])

    def times(self, other: BoundedPolynomial) -> Self:
        """Multiply."""
        (m, n), (p, q) = degrees(self.b), degrees(other.b)
        steps = _MARGIN * EPS * ((min(m, p) + 1) * (min(n, q) + 1) + 6)
        size, others = np.abs(self.b), np.abs(other.b)
        err = multiply(size, other.err + steps * others)
        err = err + multiply(self.err, others + other.err)
        return type(self)(multiply(self.b, other.b), _MARGIN * err)

    def plus(self, other: BoundedPolynomial, sign: float = 1.0) -> Self:
        """Add what is of the same degrees; subtract it with the sign -1."""
        found = self.b + sign * other.b
        return type(self)(found, self.err + other.err + EPS * np.abs(found))

    def dot(self, other: BoundedPolynomial) -> Self:
        """Multiply vectors and add their components, in one order."""
        found = self.times(other)
        total = type(self)(found.b[:, 0], found.err[:, 0])
        for i in range(1, found.b.shape[1]):
            total = total.plus(type(self)(found.b[:, i], found.err[:, i]))
        return total

    def derivative(self, axis: int) -> Self:
        """Differentiate with respect to u (axis -2) or v (-1); the degree is 1 at least."""
        degree = self.b.shape[axis] - 1
        low, high = (self.err.take(np.arange(degree) + i, axis) for i in (0, 1))
        found = degree * np.diff(self.b, axis=axis)
        return type(self)(found, degree * (low + high) + 2.0 * EPS * np.abs(found))


# --------------------------------------------------------------------------------------
# Roots, by Newton steps kept in a bracket.

# How far a bracket reaches over both ends: a root at an end may lie beyond by rounding.
_BEYOND = 1e-9
_STOP, _LATE_STOP = 2e-15, 1e-13
_EARLY, _MOST = 8, 120
# An error that the last two steps promise for the next one, if it falls as Newton's does.
_PROMISED = 1e-17
# Rows at a time, so that the powers stay in the cache.
_BLOCK = 1024


def sign_change_roots(
    b: FloatArray, rising: NDArray[np.bool_], start: FloatArray | None = None
) -> FloatArray:
    """Find where each polynomial changes sign.

    With s = t / (1 - t) and d the degree,

        p(t) = (1 - t)**d q(s),    q(s) = sum C(d, i) b_i s**i

    has the terms of the Bernstein form, so it is as exact; a root beyond 1/2 is looked for from the
    other end, so that s stays below 1. A row takes its own steps: its root does not depend on the
    other rows, to the last bit.

    Parameters
    ----------
    b : (r, d + 1)
        Bernstein coefficients on [0, 1], each row with one change of sign; coefficients at the
        ends may be zero, or off by rounding.
    rising : (r,) bool
        Whether a polynomial goes from negative to positive.
    start : (r,) float, optional
        Where to begin, if the roots are known roughly; any number will do.

    Returns
    -------
    (r,) float
        The roots, in [0, 1]; of a row that has no change of sign, the end nearest to one.
    """
    found = np.empty(len(b))
    for first in range(0, len(b), _BLOCK):
        rows = slice(first, first + _BLOCK)
        found[rows] = _block(b[rows], rising[rows], None if start is None else start[rows])
    return found


def _block(b: FloatArray, rising: NDArray[np.bool_], start: FloatArray | None) -> FloatArray:
    degree = b.shape[1] - 1
    if degree == 0 or len(b) == 0:
        return np.zeros(len(b))
    signed = np.where(rising, b.T, -b.T)
    scaled = signed * binomials(degree)[:, None]
    middle = _summed(scaled.copy()) * 0.5**degree
    far = middle < 0.0
    scaled = np.where(far, -scaled[::-1], scaled)
    if start is None:
        start = _start(np.where(far, -signed[-1], signed[0]), np.abs(middle))
    else:
        start = np.clip(np.where(far, 1.0 - start, start), 0.0, 0.5)
    x = _roots(scaled, start)
    return np.where(far, 1.0 - x, x)


def _start(low: FloatArray, high: FloatArray) -> FloatArray:
    """Take the line between the values at 0 and 1/2; where these do not differ in sign, 1/4."""
    rise = high - low
    crossed = (low < 0.0) & (rise > 0.0)
    return np.where(crossed, -0.5 * low / np.where(crossed, rise, 1.0), 0.25)


def _summed(terms: FloatArray) -> FloatArray:
    """Add along the next to last axis, in an order that the number of terms decides; overwrites."""
    count = terms.shape[-2]
    while count > 1:
        half = (count + 1) // 2
        terms[..., : count - half, :] += terms[..., half:count, :]
        count = half
    return terms[..., 0, :]


def power_table(s: FloatArray, count: int) -> FloatArray:
    """Give s (r,) to the powers 0, 1, ..., count - 1, at least two: (count, r)."""
    table = np.empty((count, len(s)))
    table[0], table[1] = 1.0, s
    done = 2
    while done < count:
        more = min(done - 1, count - done)
        np.multiply(table[1 : more + 1], table[done - 1], out=table[done : done + more])
        done += more
    return table


@attrs.define(eq=False)
class _Search:
    """Rows whose roots are not known yet: polynomials q and q', bracket, place.

    The last step is kept too, zero where it was none of Newton's.
    """

    row: NDArray[np.intp]
    pair: FloatArray
    low: FloatArray
    high: FloatArray
    x: FloatArray
    step: FloatArray

    def keep(self, kept: NDArray[np.bool_]) -> None:
        """Drop the rows whose roots are found."""
        self.row, self.pair = self.row[kept], self.pair[..., kept]
        self.low, self.high = self.low[kept], self.high[kept]
        self.x, self.step = self.x[kept], self.step[kept]

    def advance(self, late: bool, halve: bool) -> NDArray[np.bool_]:
        """Take a step; tell which rows are done."""
        x, degree = self.x, self.pair.shape[1] - 1
        ratio = 1.0 / (1.0 - x)
        value, slope = _summed(self.pair * power_table(x * ratio, degree + 1))
        # p' / (1 - t)**d from q and q'; the factor drops out of value / slope.
        slope = (slope * ratio - degree * value) * ratio
        np.copyto(self.low, x, where=value < 0.0)
        np.copyto(self.high, x, where=value > 0.0)
        steep = slope > 0.0
        place = x - value / np.where(steep, slope, 1.0)
        trusted = steep & (place >= self.low) & (place <= self.high)
        # Every other late step halves the bracket, unless Newton's is below the tolerance already.
        if halve:
            trusted &= np.abs(place - x) < _LATE_STOP
        place = np.where(trusted, place, 0.5 * (self.low + self.high))
        step = np.abs(place - x)
        # Newton's steps fall quadratically: the next one is about step**3 / (last step)**2.
        promised = step**3 < _PROMISED * self.step**2
        done = (step < (_LATE_STOP if late else _STOP)) | (promised & trusted & (step < 1e-5))
        self.x, self.step = place, np.where(trusted, step, 0.0)
        return np.asarray(done | (value == 0.0))


def _roots(scaled: FloatArray, start: FloatArray) -> FloatArray:
    """Find the roots in [0, 1/2] of polynomials q, rising; coefficients (d + 1, r)."""
    count, rows = scaled.shape
    slopes = np.zeros_like(scaled)
    slopes[:-1] = scaled[1:] * np.arange(1.0, count)[:, None]
    search = _Search(
        np.arange(rows), np.stack([scaled, slopes]),
        np.full(rows, -_BEYOND), np.full(rows, 0.5 + _BEYOND), start, np.zeros(rows),
    )  # fmt: skip
    found = np.empty(rows)
    for turn in range(_MOST):
        done = search.advance(turn >= _EARLY, turn >= _EARLY and turn % 2 == 1)
        found[search.row] = search.x
        if done.any():
            search.keep(~done)
            if not len(search.row):
                break
    return np.clip(found, 0.0, 0.5)
