"""Polynomials on parts of their square, each on its own box."""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.patches.bernstein_polynomials import binomials, power_table
from assoc_hull.geometry.patches.curvature_functions import IsoFunction

_EPS = 2.0**-53


def restricted(function: IsoFunction, patch: IntArray, box: FloatArray) -> IsoFunction:
    """Write polynomials on boxes as if these were the unit square.

    Parameters
    ----------
    function : IsoFunction
        Polynomials of patches.
    patch : (q,) int
        Which to take.
    box : (q, 2, 2)
        ``[[u0, u1], [v0, v1]]`` for each, within the unit square.

    Returns
    -------
    IsoFunction
        One polynomial a box, with errors that hold for the new coefficients.
    """
    m, n = function.b.shape[1] - 1, function.b.shape[2] - 1
    rows, columns = _restriction(m, box[:, 0]), _restriction(n, box[:, 1]).swapaxes(1, 2)
    b = function.b[patch]
    err = function.err[patch] + 32 * (m + n) * _EPS * np.abs(b)
    return IsoFunction(rows @ b @ columns, rows @ err @ columns)


def _restriction(degree: int, span: FloatArray) -> FloatArray:
    """Give matrices (q, degree + 1, degree + 1) to spans (q, 2): to [0, high], then to [low, high].

    All entries are positive, and exact but for a few roundings each.
    """
    low, high = span[:, 0], span[:, 1]
    lower = np.zeros((len(span), degree + 1, degree + 1))
    upper = np.zeros_like(lower)
    for i in range(degree + 1):
        lower[:, i, : i + 1] = _bernstein(i, high, 1.0 - high)
        upper[:, i, i:] = _bernstein(degree - i, low / high, (high - low) / high)
    return upper @ lower


def _bernstein(degree: int, t: FloatArray, rest: FloatArray) -> FloatArray:
    """Give the Bernstein polynomials (q, degree + 1) at places t, of which 1 - t is given too."""
    if degree == 0:
        return np.ones((len(t), 1))
    table = power_table(t, degree + 1) * power_table(rest, degree + 1)[::-1]
    return np.asarray(table.T * binomials(degree))
