"""What samples tell of cells in which the sign of the polynomial is not decided.

Examples
--------
>>> from assoc_hull.geometry.patches.undecided import SAMPLES
>>> SAMPLES
16
"""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.patches.algebra import across
from assoc_hull.geometry.patches.area_elements import bernstein_values
from assoc_hull.geometry.patches.cells import Cells

__all__ = ["SAMPLES", "sampled_signs"]

SAMPLES = 16
"""Samples in each parameter."""

# Cells at a time, so that the values stay in the cache.
_BLOCK = 256


def sampled_signs(cells: Cells, rows: IntArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Give the shares of samples of each sign.

    Parameters
    ----------
    cells : Cells
        The cells.
    rows : (c,) int
        Those wanted, of which the polynomial is kept.

    Returns
    -------
    (c,), (c,), (c,) float
        Shares of positive and of negative samples, and of those in doubt: nil to the error of the
        polynomial, or beside one of another sign. A sample that is nil to the error counts as the
        others of its cell do if these are of one sign, as beside a line without change of sign;
        else by its value, as the error is a bound far above what rounding does.
    """
    found = np.empty((3, len(rows)))
    for first in range(0, len(rows), _BLOCK):
        part = slice(first, first + _BLOCK)
        found[:, part] = _shares(*(a[cells.row[rows[part]]] for a in (cells.b, cells.err)))
    return found[0], found[1], found[2]


def _shares(b: FloatArray, err: FloatArray) -> FloatArray:
    places = (np.arange(SAMPLES) + 0.5) / SAMPLES
    in_u, in_v = (bernstein_values(size - 1, places).T for size in b.shape[1:])
    value, error = across(in_u, b, in_v), across(in_u, err, in_v)
    sign = np.where(value > error, 1, np.where(value < -error, -1, 0))
    doubt = sign == 0
    differ = sign[:, 1:] != sign[:, :-1]
    doubt[:, 1:] |= differ
    doubt[:, :-1] |= differ
    differ = sign[..., 1:] != sign[..., :-1]
    doubt[..., 1:] |= differ
    doubt[..., :-1] |= differ
    above, below = ((sign == side).any(axis=(1, 2))[:, None, None] for side in (1, -1))
    positive = np.where(above == below, value > 0.0, above)
    negative = np.where(above == below, value < 0.0, below)
    return np.array([part.mean(axis=(1, 2)) for part in (positive, negative, doubt)])
