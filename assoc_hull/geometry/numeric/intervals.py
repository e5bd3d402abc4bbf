"""Interval arithmetic, elementwise on arrays, widened for rounding.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.numeric.intervals import interval_product
>>> low, high = interval_product(
...     (np.array([-1.0]), np.array([2.0])), (np.array([3.0]), np.array([4.0]))
... )
>>> low.round(9).tolist(), high.round(9).tolist()
([-4.0], [8.0])
"""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray

__all__ = ["Interval", "interval_difference", "interval_product", "interval_sum", "interval_union"]

Interval = tuple[FloatArray, FloatArray]
"""Least and greatest values."""

_ROUNDING = 64.0 * float(np.finfo(np.float64).eps)


def interval_sum(one: Interval, other: Interval) -> Interval:
    """Give what encloses sums."""
    slack = _ROUNDING * (_size(one) + _size(other))
    return one[0] + other[0] - slack, one[1] + other[1] + slack


def interval_difference(one: Interval, other: Interval) -> Interval:
    """Give what encloses differences."""
    return interval_sum(one, (-other[1], -other[0]))


def interval_product(one: Interval, other: Interval) -> Interval:
    """Give what encloses products."""
    products = [a * b for a in one for b in other]
    low = np.minimum(np.minimum(products[0], products[1]), np.minimum(products[2], products[3]))
    high = np.maximum(np.maximum(products[0], products[1]), np.maximum(products[2], products[3]))
    slack = _ROUNDING * np.maximum(np.abs(low), np.abs(high))
    return low - slack, high + slack


def interval_union(one: Interval, other: Interval) -> Interval:
    """Give what encloses both."""
    return np.minimum(one[0], other[0]), np.maximum(one[1], other[1])


def _size(one: Interval) -> FloatArray:
    return np.maximum(np.abs(one[0]), np.abs(one[1]))
