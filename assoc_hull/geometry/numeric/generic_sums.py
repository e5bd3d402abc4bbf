"""The few sums of the immersion that are not element by element, and what decisions see.

All other arithmetic of the immersion is written with plain operators, so it runs on real
numbers, on complex ones (derivatives by complex step) and on any array type that overloads
them. The sums below are kept together here, so that one place knows how each type adds up.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.numeric.dual import Dual, as_array, is_plain, real
from assoc_hull.geometry.numeric.dual import sum_by as sum_rows_by

__all__ = ["combine_rows", "common_zeros", "differs_from_zero", "safe_sqrt", "sum_columns_by"]


def differs_from_zero(values: FloatArray) -> NDArray[np.bool_]:
    """Say which numbers are not zero, or have a derivative that is not."""
    if isinstance(values, Dual):
        return np.asarray((values.value != 0.0) | (values.dot != 0.0).any(axis=0))
    return np.asarray(values != 0.0)


def common_zeros(shape: tuple[int, ...], *like: FloatArray) -> FloatArray:
    """Give zeros of the arithmetic that results from all of some numbers."""
    for each in like:
        if isinstance(each, Dual):
            return as_array(Dual.constant(np.zeros(shape), each.count))
    return np.zeros(shape, np.result_type(*like))


_NONE = 1e-22
"""A square of less is rounding about zero, from which a root would take any direction."""


def safe_sqrt(values: FloatArray) -> FloatArray:
    """Give square roots; where there is nothing to take one of, zero and no derivative."""
    if is_plain(values):
        return np.sqrt(values)
    some = real(values) > _NONE
    return np.where(some, np.sqrt(np.where(some, values, 1.0)), 0.0)


def combine_rows(matrix: FloatArray, values: FloatArray) -> FloatArray:
    """Combine rows: ``matrix @ values``, of which the matrix is plain.

    Parameters
    ----------
    matrix : (m, n)
        Real factors.
    values : (..., n, k)
        Any arithmetic.

    Returns
    -------
    (..., m, k)
        The combinations.
    """
    mixed: FloatArray = matrix @ values
    return mixed


def sum_columns_by(values: FloatArray, owner: IntArray, count: int) -> FloatArray:
    """Add up columns by owner.

    Parameters
    ----------
    values : (c, k)
        Any arithmetic.
    owner : (k,) int
        From 0 to count - 1.
    count : int
        Number of owners.

    Returns
    -------
    (c, count)
        The sums, each in the order of its columns.

    Examples
    --------
    >>> import numpy as np
    >>> sum_columns_by(np.array([[1.0, 2.0, 4.0]]), np.array([1, 0, 1]), 3)
    array([[2., 5., 0.]])
    """
    if count == 1:
        alone: FloatArray = values.sum(axis=1)[:, None]
        return alone
    if isinstance(values, Dual):
        dot = values.dot.reshape(values.count * len(values), values.shape[1])
        sums = sum_columns_by(dot, owner, count).reshape(values.count, len(values), count)
        return as_array(Dual(sum_columns_by(values.value, owner, count), sums))
    if not is_plain(values):
        summed: FloatArray = sum_rows_by(values.T, owner, count).T
        return summed
    return np.stack([np.bincount(owner, row, count) for row in values])
