"""Roots of any continuous functions in brackets, all at once, without derivatives.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.numeric.false_position import false_position
>>> square = lambda rows, at: at * at - 2.0
>>> low, high = np.array([1.0]), np.array([2.0])
>>> root = false_position(square, low, high, np.array([-1.0]), np.array([2.0]))
>>> abs(float(root[0]) - 2.0**0.5) < 1e-13
True
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.geometry.curves import FloatArray, IntArray

__all__ = ["Heights", "false_position"]

Heights = Callable[[IntArray, FloatArray], FloatArray]
"""Takes rows (k,) of the brackets and places (k,) in them, and gives the values there, (k,)."""

_ROUNDS = 80
"""Steps of a bracketed root, seldom more than ten."""


def false_position(
    give: Heights,
    low: FloatArray,
    high: FloatArray,
    at_low: FloatArray,
    at_high: FloatArray,
    enough: ArrayLike = 1e-13,
) -> FloatArray:
    """Find one root in every bracket by the Illinois rule.

    Parameters
    ----------
    give : callable
        The functions.
    low, high : (k,)
        The brackets; `high` may be below `low`.
    at_low, at_high : (k,)
        Values there, of which one is negative and the other is not.
    enough : (k,) or float
        A root is found where the value or the bracket is as small as this.

    Returns
    -------
    (k,)
        The places with the smallest values that were met.
    """
    a, b, fa, fb = low.copy(), high.copy(), at_low.copy(), at_high.copy()
    enough = np.broadcast_to(np.asarray(enough, np.float64), a.shape)
    best = np.where(np.abs(fa) <= np.abs(fb), a, b)
    least = np.minimum(np.abs(fa), np.abs(fb))
    for _ in range(_ROUNDS):
        open_ = np.flatnonzero((least > enough) & (np.abs(b - a) > enough))
        if not len(open_):
            break
        x, y, fx, fy = a[open_], b[open_], fa[open_], fb[open_]
        mid = x - fx * (y - x) / (fy - fx)
        mid = np.where((mid > np.minimum(x, y)) & (mid < np.maximum(x, y)), mid, 0.5 * (x + y))
        value = give(open_, mid)
        good = np.abs(value) < least[open_]
        best[open_] = np.where(good, mid, best[open_])
        least[open_] = np.where(good, np.abs(value), least[open_])
        same = (value >= 0.0) == (fy >= 0.0)
        a[open_], fa[open_] = np.where(same, x, y), np.where(same, 0.5 * fx, fy)
        b[open_], fb[open_] = mid, value
    return best
