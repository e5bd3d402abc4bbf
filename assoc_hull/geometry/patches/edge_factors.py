"""Divide polynomials by what makes them nil along edges of the square.

Along an edge that is drawn together in one point, S = O(u) and A = O(u**3); rounding there has
both signs, and would be cut without end. Where the first k rows of coefficients lie in the dead
band, the polynomial is u**k times another, which has the same sign inside:

    q_i = p_(i + k) C(n, i + k) / C(n - k, i)

This is written with the degree n again, so patches with and without such edges stay one batch.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.edge_factors import without_edge_lines
>>> b = np.array([[0.0, 0.0], [3.0, 3.0]])  # 3 u
>>> without_edge_lines(np.stack([b, 1e-15 + 0 * b])[None])[0, 0]
array([[3., 3.],
       [3., 3.]])
"""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.patches.algebra import binomials, elevation
from assoc_hull.geometry.patches.signs import signs

__all__ = ["without_edge_lines"]

_EPS = 2.0**-53


@cache
def _quotients(degree: int) -> FloatArray:
    """Give the matrices that divide by u**k, for k = 0 ... degree: (degree + 1,) * 3."""
    found = np.zeros((degree + 1, degree + 1, degree + 1))
    for k in range(degree + 1):
        scale = binomials(degree)[k:] / binomials(degree - k)
        found[k, :, k:] = elevation(degree - k, k) * scale
    freeze(found)
    return found


def _leading(dead: NDArray[np.bool_]) -> NDArray[np.intp]:
    """Count the leading true values of each row; none where all are true."""
    return np.asarray(np.argmin(dead, axis=1))


def without_edge_lines(pair: FloatArray) -> FloatArray:
    """Divide by u**k, (1 - u)**k, v**k and (1 - v)**k where a polynomial is nil along an edge.

    Parameters
    ----------
    pair : (c, layers, M + 1, N + 1)
        Coefficients and their errors, of which the last tells what is nil.

    Returns
    -------
    (c, layers, M + 1, N + 1)
        The same of the quotients; a polynomial that is nil everywhere stays as it is.
    """
    for axis in (2, 3):
        for flipped in (False, True):
            pair = _divided(pair, axis, flipped)
    return pair


def _divided(pair: FloatArray, axis: int, flipped: bool) -> FloatArray:
    """Divide by the factor of one edge."""
    dead = signs(pair[:, 0], pair[:, -1]) == 0
    lines = dead.all(axis=2 if axis == 2 else 1)
    order = _leading(lines[:, ::-1] if flipped else lines)
    rows = np.flatnonzero(order)
    if not len(rows):
        return pair
    part = pair[rows] if axis == 2 else pair[rows].swapaxes(2, 3)
    if flipped:
        part = part[:, :, ::-1]
    part = part.copy()
    degree = part.shape[2] - 1
    part[:, 1:] += 16 * degree * _EPS * np.abs(part[:, :1])
    part = _quotients(degree)[order[rows], None] @ part
    if flipped:
        part = part[:, :, ::-1]
    found = pair.copy()
    found[rows] = part if axis == 2 else part.swapaxes(2, 3)
    return found
