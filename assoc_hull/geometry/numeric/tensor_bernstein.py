"""Polynomials of several parameters on boxes, in Bernstein form.

A polynomial over the unit box lies between the least and the greatest of its Bernstein
coefficients; those at the corners are its values there. The coefficients are found from values
at nodes inside the box, so that a polynomial need not be known by its formula; halving a box
gives those of both halves.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.numeric.tensor_bernstein import bernstein_coefficients, bernstein_nodes
>>> s = bernstein_nodes((2,))
>>> bernstein_coefficients((s[:, 0] ** 2)[None, :], (2,))[0].round(12) + 0.0
array([[0., 0., 1.]])
"""

from __future__ import annotations

import math
from functools import cache
from itertools import product

import numpy as np

from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = [
    "bernstein_basis",
    "bernstein_coefficients",
    "bernstein_nodes",
    "corner_coefficients",
    "halve_boxes",
]

Degrees = tuple[int, ...]

_ROUNDING = 64.0 * float(np.finfo(np.float64).eps)


def bernstein_basis(degree: int, t: FloatArray) -> FloatArray:
    """Give the values of the Bernstein polynomials at parameters (n,), as (n, degree + 1)."""
    i = np.arange(degree + 1)
    times = np.array([math.comb(degree, int(k)) for k in i], np.float64)
    power = np.asarray(t, np.float64)[:, None]
    found: FloatArray = times * power**i * (1.0 - power) ** (degree - i)
    return found


@cache
def _line(degree: int) -> FloatArray:
    """Give the nodes of one parameter: those of Chebyshev, none at an end."""
    found = np.pi * (np.arange(degree + 1, dtype=np.float64) + 0.5) / (degree + 1)
    found = np.asarray(0.5 - 0.5 * np.cos(found), np.float64)
    freeze(found)
    return found


@cache
def _inverse(degree: int) -> FloatArray:
    """Give what makes values at the nodes the coefficients."""
    found = np.asarray(np.linalg.inv(bernstein_basis(degree, _line(degree))), np.float64)
    freeze(found)
    return found


@cache
def bernstein_nodes(degrees: Degrees) -> FloatArray:
    """Give the parameters, (n, k), at which values determine a polynomial of these degrees."""
    found = np.array(list(product(*(_line(degree).tolist() for degree in degrees))))
    found = found.reshape(-1, len(degrees))
    freeze(found)
    return found


def bernstein_coefficients(values: FloatArray, degrees: Degrees) -> tuple[FloatArray, FloatArray]:
    """Give the Bernstein coefficients of polynomials known at the nodes.

    Parameters
    ----------
    values : (m, n)
        Of m polynomials, at the n nodes of `bernstein_nodes`.
    degrees : tuple of int
        In each of the k parameters.

    Returns
    -------
    coefficients : (m, d_1 + 1, .., d_k + 1)
    slack : (m,)
        What rounding may have added to any of them.
    """
    shape = (len(values), *(degree + 1 for degree in degrees))
    found, size = values.reshape(shape), np.abs(values).reshape(shape)
    for axis, degree in enumerate(degrees):
        found = _along(_inverse(degree), found, axis)
        size = _along(np.abs(_inverse(degree)), size, axis)
    inner = tuple(range(1, len(shape)))
    return found, _ROUNDING * size.max(axis=inner, initial=0.0)


def _along(matrix: FloatArray, values: FloatArray, axis: int) -> FloatArray:
    """Apply a matrix along one parameter of many polynomials."""
    if len(matrix) == 1:
        return values
    there, back = _orders(values.ndim, axis + 1)
    product: FloatArray = values.transpose(there) @ matrix.T
    return product.transpose(back)


@cache
def _orders(count: int, axis: int) -> tuple[tuple[int, ...], tuple[int, ...]]:
    """Give the orders of axes that bring one to the end, and back to its place."""
    others = [each for each in range(count) if each != axis]
    back = list(range(count - 1))
    back.insert(axis, count - 1)
    return (*others, axis), tuple(back)


def halve_boxes(found: FloatArray, axis: int) -> tuple[FloatArray, FloatArray]:
    """Give the coefficients on the lower and the upper half of one parameter, by de Casteljau."""
    row = np.moveaxis(found, axis + 1, -1)
    first, last = np.empty(row.shape), np.empty(row.shape)
    for k in range(row.shape[-1]):
        first[..., k], last[..., -1 - k] = row[..., 0], row[..., -1]
        row = 0.5 * (row[..., :-1] + row[..., 1:])
    return np.moveaxis(first, -1, axis + 1), np.moveaxis(last, -1, axis + 1)


def corner_coefficients(found: FloatArray) -> FloatArray:
    """Give the coefficients at the corners, which are values: (m, 2, 2, ..)."""
    for axis in range(1, found.ndim):
        found = found.take([0, found.shape[axis] - 1], axis=axis)
    return found
