"""Where functions of the heel change their sign, many at once, without their slopes."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray

__all__ = ["crossings"]

_TRIALS = 80
_FINE = 1e-10
"""Degrees."""


def crossings(
    value: Callable[[FloatArray, IntArray], FloatArray], low: FloatArray, high: FloatArray
) -> FloatArray:
    """Find where each of n functions changes its sign between two places.

    Chandrupatla's rule: inverse quadratic interpolation where it can be trusted, else halving;
    a bracket stays a bracket, infinite values only halve it.

    Parameters
    ----------
    value : callable
        Of places (k,) and of which functions they are, (k,): the values there.
    low, high : (n,)
        Places between which the sign changes.

    Returns
    -------
    (n,)
        The places, to 1e-10.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.analysis.hydrostatics.crossings import crossings
    >>> square = lambda x, rows: x * x - np.array([4.0, 9.0])[rows]
    >>> crossings(square, np.zeros(2), np.full(2, 8.0)).round(9).tolist()
    [2.0, 3.0]
    """
    rows = np.arange(len(low))
    if not len(rows):
        return low.copy()
    one, other = high.copy(), low.copy()
    f_one, f_other = value(one, rows), value(other, rows)
    third, f_third = other.copy(), f_other.copy()
    part = np.full(len(low), 0.5)
    for _ in range(_TRIALS):
        x = one + part * (other - one)
        f = value(x, rows)
        same = np.sign(f) == np.sign(f_one)
        third, f_third = np.where(same, one, other), np.where(same, f_one, f_other)
        other, f_other = np.where(same, other, one), np.where(same, f_other, f_one)
        one, f_one = x, f
        wide = np.abs(other - one)
        if ((wide <= _FINE) | (f == 0.0)).all():
            break
        least = 0.4 * _FINE / np.maximum(wide, _FINE)
        part = np.clip(_part((one, other, third), (f_one, f_other, f_third)), least, 1.0 - least)
        part[f == 0.0] = 0.0
    return np.where(np.abs(f_one) <= np.abs(f_other), one, other)


def _part(
    x: tuple[FloatArray, FloatArray, FloatArray], f: tuple[FloatArray, FloatArray, FloatArray]
) -> FloatArray:
    """Give how far to go from the first place to the second."""
    (a, b, c), (fa, fb, fc) = x, f
    with np.errstate(all="ignore"):
        xi, phi = (a - b) / (c - b), (fa - fb) / (fc - fb)
        trusted = (1.0 - np.sqrt(1.0 - xi) < phi) & (phi < np.sqrt(xi))
        part = fa / (fb - fa) * fc / (fb - fc)
        part = part + (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb)
        found: FloatArray = np.where(trusted & np.isfinite(part), part, 0.5)
    return found
