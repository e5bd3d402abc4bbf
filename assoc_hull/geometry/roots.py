"""Roots of many cubics at once, each with the same bits as when found alone.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.roots import bracketed_roots
>>> cubic = np.array([[-0.5], [1.0], [0.0], [0.0]])
>>> bracketed_roots(cubic, np.zeros(1), np.ones(1), np.array([-0.5]), np.array([0.5]))
array([0.5])
"""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.bernstein import value
from assoc_hull.geometry.curves import FloatArray

__all__ = ["FLOOR", "MOST_TRIALS", "RELATIVE", "STEPS", "bracketed_roots"]

STEPS = 3
"""From the secant, three steps of Halley's rule reach the last bits of nearly all roots."""

FLOOR, RELATIVE = 1e-14, 1e-15
MOST_TRIALS = 200


def bracketed_roots(
    cubic: FloatArray,
    lower: FloatArray,
    upper: FloatArray,
    at_lower: FloatArray,
    at_upper: FloatArray,
) -> FloatArray:
    """Find the one root of each cubic in a bracket in which it changes sign once.

    Parameters
    ----------
    cubic : (4, k), m
        Coefficients of 1, u, u**2, u**3.
    lower, upper : (k,)
        The brackets.
    at_lower, at_upper : (k,), m
        Values there; one is negative, the other is not. They decide the sign, whatever
        rounding makes of the cubic itself.

    Returns
    -------
    (k,)
        The roots; exactly the end of the bracket if the value there is nil.

    Notes
    -----
    Every cubic takes the same fixed steps; the few whose residual is not yet at rounding
    level, or that left their bracket, start again with bisection as a safeguard. Either
    way a root depends on its own cubic only.

    Examples
    --------
    >>> cubic = np.array([[-0.125], [0.0], [0.0], [1.0]])
    >>> bracketed_roots(cubic, np.zeros(1), np.ones(1), np.array([-0.125]), np.array([0.875]))
    array([0.5])
    """
    origin, first, second, third = cubic
    limit = FLOOR + RELATIVE * (np.abs(at_lower) + np.abs(at_upper))
    root = lower + (upper - lower) * (at_lower / (at_lower - at_upper))
    with np.errstate(all="ignore"):
        steep = 3.0 * third
        for _ in range(STEPS):
            root -= _halley(origin, first, second, third, steep, root)
        residual = np.abs(value(origin, first, second, third, root))
        good = (residual <= limit) & (root >= lower) & (root <= upper)
    at_begin, at_end = at_lower == 0.0, at_upper == 0.0
    # Many meetings lie on knots: those are known, whatever the steps have made of them.
    bad = np.flatnonzero(~(good | at_begin | at_end))
    if len(bad):
        rising = at_lower[bad] < 0.0
        root[bad] = _safe_roots(cubic[:, bad], lower[bad], upper[bad], rising, limit[bad])
    np.copyto(root, lower, where=at_begin)
    np.copyto(root, upper, where=at_end)
    return root


def _halley(
    origin: FloatArray,
    first: FloatArray,
    second: FloatArray,
    third: FloatArray,
    steep: FloatArray,
    root: FloatArray,
) -> FloatArray:
    """Give the step f f' / (f'**2 - f f'' / 2)."""
    height = value(origin, first, second, third, root)
    bend = steep * root
    bend += second
    slope = bend + second
    slope *= root
    slope += first
    bend *= height
    height *= slope
    slope *= slope
    slope -= bend
    height /= slope
    return height


def _safe_roots(
    cubic: FloatArray,
    lower: FloatArray,
    upper: FloatArray,
    rising: np.typing.NDArray[np.bool_],
    limit: FloatArray,
) -> FloatArray:
    """Find roots by Newton's rule, every third trial and whenever it fails by bisection."""
    result = 0.5 * (lower + upper)
    active = np.arange(len(result))
    for trial in range(MOST_TRIALS):
        root = result[active]
        origin, first, second, third = cubic[:, active]
        height = value(origin, first, second, third, root)
        above = (height >= 0.0) == rising[active]
        upper[active] = np.where(above, root, upper[active])
        lower[active] = np.where(above, lower[active], root)
        low, high = lower[active], upper[active]
        middle = 0.5 * (low + high)
        with np.errstate(all="ignore"):
            slope = first + root * (2.0 * second + root * (3.0 * third))
            newton = root - height / slope
        bisect = ~((newton > low) & (newton < high)) | (trial % 3 == 2)
        more = (np.abs(height) > limit[active]) & (middle > low) & (middle < high)
        result[active] = np.where(more, np.where(bisect, middle, newton), root)
        active = active[more]
        if not len(active):
            break
    return result
