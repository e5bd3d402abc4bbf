"""Roots of many functions of one variable at once, each within a bracket of its own.

`bracketed_newton` takes rising functions given with their slopes; `sign_changes` takes values only.
Functions are vectorised: they take places (k,) and the numbers (k,) of the functions asked. Each
root has the same bits whichever others are looked for beside it.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray

__all__ = [
    "Rising",
    "bracketed_newton",
    "sign_changes",
]

# --------------------------------------------------------------------------------------
# Rising functions with slopes: Newton's rule.

Rising = Callable[[FloatArray, IntArray], tuple[FloatArray, FloatArray]]
"""Takes places (k,) and the numbers of their functions (k,); gives values and slopes there."""

_NEWTON_TRIALS = 100
_NEWTON_FINE = 1e-13
"""Where steps are this part of the range, the rounding of the values is all that is left."""

_NEWTON_SMALL = 1e-7
"""Steps of this part of the range that no longer shrink are those of what rounds integrals."""


def bracketed_newton(
    value: Rising,
    start: FloatArray,
    low: FloatArray,
    high: FloatArray,
    fine: float = _NEWTON_FINE,
) -> FloatArray:
    """Find the root of each of n rising functions, given with its slope, in its bracket, (n,).

    A root is found when steps are no more than rounding, or small and no longer shrink; `fine` is
    the last step as a part of the bracket, and what is left is of the order of its square. The
    bracket is halved wherever the rule leaves it, and now and then anyway. Where a function does
    not change its sign, an end of the bracket is given.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.analysis.hydrostatics.bracketed_roots import bracketed_newton
    >>> want = np.array([4.0, 9.0])
    >>> def square(x, rows):
    ...     return x * x - want[rows], 2.0 * x
    >>> bracketed_newton(square, np.full(2, 5.0), np.zeros(2), np.full(2, 10.0)).round(12).tolist()
    [2.0, 3.0]
    """
    root, low, high = start.copy(), low.copy(), high.copy()
    least, small = fine * (high - low), _NEWTON_SMALL * (high - low)
    last = np.full(len(root), np.inf)
    rows = np.arange(len(root))
    for trial in range(1, _NEWTON_TRIALS):
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
    """Give Newton's steps; infinite ones, which halve the bracket, where nothing rises."""
    rises = (slope > 0.0) & np.isfinite(height)
    step: FloatArray = np.where(rises, -height / np.where(rises, slope, 1.0), np.inf)
    return step


# --------------------------------------------------------------------------------------
# Values only: Chandrupatla's rule.

_SIGN_TRIALS = 80
_SIGN_FINE = 1e-10
"""Degrees."""


def sign_changes(
    value: Callable[[FloatArray, IntArray], FloatArray], low: FloatArray, high: FloatArray
) -> FloatArray:
    """Find where each of n functions changes its sign between two places, (n,), to 1e-10.

    Inverse quadratic interpolation where it can be trusted, else halving; a bracket stays a
    bracket, infinite values only halve it. Source: T.R. Chandrupatla, Advances in Engineering
    Software 28 (1997) 145-149.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.analysis.hydrostatics.bracketed_roots import sign_changes
    >>> square = lambda x, rows: x * x - np.array([4.0, 9.0])[rows]
    >>> sign_changes(square, np.zeros(2), np.full(2, 8.0)).round(9).tolist()
    [2.0, 3.0]
    """
    rows = np.arange(len(low))
    if not len(rows):
        return low.copy()
    one, other = high.copy(), low.copy()
    f_one, f_other = value(one, rows), value(other, rows)
    third, f_third = other.copy(), f_other.copy()
    part = np.full(len(low), 0.5)
    for _ in range(_SIGN_TRIALS):
        x = one + part * (other - one)
        f = value(x, rows)
        same = np.sign(f) == np.sign(f_one)
        third, f_third = np.where(same, one, other), np.where(same, f_one, f_other)
        other, f_other = np.where(same, other, one), np.where(same, f_other, f_one)
        one, f_one = x, f
        wide = np.abs(other - one)
        if ((wide <= _SIGN_FINE) | (f == 0.0)).all():
            break
        least = 0.4 * _SIGN_FINE / np.maximum(wide, _SIGN_FINE)
        part = np.clip(_part((one, other, third), (f_one, f_other, f_third)), least, 1.0 - least)
        part[f == 0.0] = 0.0
    return np.where(np.abs(f_one) <= np.abs(f_other), one, other)


def _part(
    x: tuple[FloatArray, FloatArray, FloatArray], f: tuple[FloatArray, FloatArray, FloatArray]
) -> FloatArray:
    """Give the part of the way from the first place to the second; 0.5 where not trusted."""
    (a, b, c), (fa, fb, fc) = x, f
    with np.errstate(all="ignore"):
        xi, phi = (a - b) / (c - b), (fa - fb) / (fc - fb)
        trusted = (1.0 - np.sqrt(1.0 - xi) < phi) & (phi < np.sqrt(xi))
        part = fa / (fb - fa) * fc / (fb - fc)
        part = part + (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb)
        found: FloatArray = np.where(trusted & np.isfinite(part), part, 0.5)
    return found
