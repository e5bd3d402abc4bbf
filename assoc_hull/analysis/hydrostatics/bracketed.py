"""Roots of many rising functions at once, each by Newton's rule within a bracket of its own."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray

__all__ = ["Rising", "newton"]

Rising = Callable[[FloatArray, IntArray], tuple[FloatArray, FloatArray]]
"""Of places (k,) and of which functions they are, (k,): the values there, and the slopes."""

_TRIALS = 100
_FINE = 1e-13
"""Where steps are this part of the range, the rounding of the values is all that is left."""

_SMALL = 1e-7
"""Steps of this part of the range that no longer shrink are those of what rounds integrals."""


def newton(
    value: Rising,
    start: FloatArray,
    low: FloatArray,
    high: FloatArray,
    fine: float = _FINE,
) -> FloatArray:
    """Find the root of each of n rising functions, given with its slope, in its bracket.

    A root is found when steps are no more than rounding, or small and no longer shrink. The
    bracket is halved wherever the rule leaves it, and now and then anyway.

    Parameters
    ----------
    value : callable
        Values and slopes of some of the functions; only those not yet done are asked.
    start, low, high : (n,)
        First trials and brackets.
    fine : float
        The last step is this part of the bracket, or less; what is left is of the order of its
        square.

    Returns
    -------
    (n,)
        The roots; an end of the bracket where the function does not change its sign.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.analysis.hydrostatics.bracketed import newton
    >>> want = np.array([4.0, 9.0])
    >>> def square(x, rows):
    ...     return x * x - want[rows], 2.0 * x
    >>> newton(square, np.full(2, 5.0), np.zeros(2), np.full(2, 10.0)).round(12).tolist()
    [2.0, 3.0]
    """
    root, low, high = start.copy(), low.copy(), high.copy()
    least, small = fine * (high - low), _SMALL * (high - low)
    last = np.full(len(root), np.inf)
    rows = np.arange(len(root))
    for trial in range(1, _TRIALS):
        if not len(rows):
            break
        x = root[rows]
        height, slope = value(x, rows)
        below = height < 0.0
        low[rows], high[rows] = np.where(below, x, low[rows]), np.where(below, high[rows], x)
        step = _step(height, slope)
        size = np.abs(step)
        done = (size <= least[rows]) | ((size <= small[rows]) & (size >= 0.5 * last[rows]))
        new = x + step
        inside = (low[rows] < new) & (new < high[rows]) & bool(trial % 8)
        root[rows] = np.where(done | inside, new, 0.5 * (low[rows] + high[rows]))
        last[rows] = size
        rows = rows[~done & (high[rows] - low[rows] > least[rows])]
    return root


def _step(height: FloatArray, slope: FloatArray) -> FloatArray:
    """Give Newton's steps; endless ones where the function does not rise."""
    rises = (slope > 0.0) & np.isfinite(height)
    step: FloatArray = np.where(rises, -height / np.where(rises, slope, 1.0), np.inf)
    return step
