"""Linear interpolation along many curves at once; slopes of the polynomial through values.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.numeric.interpolation import interpolate_linear
>>> curve, at = np.array([0, 0, 2]), np.array([0.0, 2.0, 1.0])
>>> value = np.array([[0.0], [4.0], [7.0]])
>>> found, told = interpolate_linear(
...     curve, at, value, np.array([0, 1, 2]), np.array([0.5, 0.5, 0.5])
... )
>>> found[:, 0].tolist(), told.tolist()
([1.0, 7.0], [True, False, True])
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray

__all__ = ["differentiation_matrix", "interpolate_linear"]


def interpolate_linear(
    curve: IntArray, at: FloatArray, value: FloatArray, wanted: IntArray, place: FloatArray
) -> tuple[FloatArray, NDArray[np.bool_]]:
    """Interpolate linearly along each of many curves, to the bits of `numpy.interp`.

    Parameters
    ----------
    curve, at, value : (k,) int, (k,) m, (k, d)
        Where values are known: on which curve, at which of its parameters; in any order.
    wanted, place : (n,) int, (n,) m
        Curve and parameter of the places where they are wanted.

    Returns
    -------
    found : (t, d)
        Values at the places whose curve has a known value; beyond the outermost, that one.
    told : (n,) bool
        Which places these are.
    """
    told = np.isin(wanted, curve)
    wanted, place = wanted[told], place[told]
    # Sorted together, known before wanted: each place follows the known one at or before it.
    order = np.lexsort((np.concatenate([at, place]), np.concatenate([curve, wanted])))
    known = order < len(at)
    low = np.empty(len(wanted), np.int64)
    low[order[~known] - len(at)] = np.cumsum(known)[~known] - 1
    curve, at, value = curve[order[known]], at[order[known]], value[order[known]]
    low = np.maximum(low, np.searchsorted(curve, wanted))
    high = np.minimum(low + 1, np.searchsorted(curve, wanted, side="right") - 1)
    between = (low < high) & (place > at[low])
    step = np.where(between, at[high] - at[low], 1.0)
    slope = (value[high] - value[low]) / step[:, None]
    blend = slope * (place - at[low])[:, None] + value[low]
    return np.where(between[:, None], blend, value[low]), told


def differentiation_matrix(t: FloatArray) -> FloatArray:
    """Give the matrix that takes values to slopes of the polynomial through them.

    Parameters
    ----------
    t : (n,)
        Where values are known, apart from one another.

    Returns
    -------
    (n, n)
        Slopes are the matrix times the values.

    Examples
    --------
    >>> import numpy as np
    >>> t = np.array([0.0, 0.5, 1.0])
    >>> (differentiation_matrix(t) @ t**2).round(12).tolist()
    [0.0, 1.0, 2.0]
    """
    apart = t[:, None] - t[None]
    np.fill_diagonal(apart, 1.0)
    weight = 1.0 / apart.prod(axis=1)
    matrix: FloatArray = weight[None] / weight[:, None] / apart
    np.fill_diagonal(matrix, 0.0)
    np.fill_diagonal(matrix, -matrix.sum(axis=1))
    return matrix
