"""Where polynomials in Bernstein form change sign once: many at a time.

Newton steps kept in a bracket. With s = t / (1 - t) and d the degree,

    p(t) = (1 - t)**d q(s),    q(s) = sum C(d, i) b_i s**i

has the terms of the Bernstein form, so it is as exact; a root beyond 1/2 is looked for from the
other end, so s stays below 1. Value and slope come from one table of powers. A row takes its own
steps: its root does not depend on the other rows, to the last bit.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.roots import crossing
>>> crossing(np.array([[-1.0, -0.5, 3.0]]), np.array([True]))
array([0.4])
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.algebra import binomials

__all__ = ["crossing", "powers"]

# How far a bracket reaches over both ends: a root at an end may lie beyond by rounding.
_BEYOND = 1e-9
_STOP, _LATE_STOP = 2e-15, 1e-13
_EARLY, _MOST = 8, 120
# An error that the last two steps promise for the next one, if it falls as Newton's does.
_PROMISED = 1e-17
# Rows at a time, so that the powers stay in the cache.
_BLOCK = 1024


def crossing(
    b: FloatArray, rising: NDArray[np.bool_], start: FloatArray | None = None
) -> FloatArray:
    """Find where each polynomial changes sign.

    Parameters
    ----------
    b : (r, d + 1)
        Bernstein coefficients on [0, 1], each row with one change of sign; coefficients at the
        ends may be nil, or off by rounding.
    rising : (r,) bool
        Whether a polynomial goes from negative to positive.
    start : (r,) float, optional
        Where to begin, if the roots are known roughly; any number will do.

    Returns
    -------
    (r,) float
        The roots, in [0, 1]; of a row that has no change of sign, the end nearest to one.
    """
    found = np.empty(len(b))
    for first in range(0, len(b), _BLOCK):
        rows = slice(first, first + _BLOCK)
        found[rows] = _block(b[rows], rising[rows], None if start is None else start[rows])
    return found


def _block(b: FloatArray, rising: NDArray[np.bool_], start: FloatArray | None) -> FloatArray:
    degree = b.shape[1] - 1
    if degree == 0 or len(b) == 0:
        return np.zeros(len(b))
    signed = np.where(rising, b.T, -b.T)
    scaled = signed * binomials(degree)[:, None]
    middle = _summed(scaled.copy()) * 0.5**degree
    far = middle < 0.0
    scaled = np.where(far, -scaled[::-1], scaled)
    if start is None:
        start = _start(np.where(far, -signed[-1], signed[0]), np.abs(middle))
    else:
        start = np.clip(np.where(far, 1.0 - start, start), 0.0, 0.5)
    x = _roots(scaled, start)
    return np.where(far, 1.0 - x, x)


def _start(low: FloatArray, high: FloatArray) -> FloatArray:
    """Take the line between the values at 0 and 1/2; where these do not differ in sign, 1/4."""
    rise = high - low
    crossed = (low < 0.0) & (rise > 0.0)
    return np.where(crossed, -0.5 * low / np.where(crossed, rise, 1.0), 0.25)


def _summed(terms: FloatArray) -> FloatArray:
    """Add along the next to last axis, in an order that the number of terms decides; overwrites."""
    count = terms.shape[-2]
    while count > 1:
        half = (count + 1) // 2
        terms[..., : count - half, :] += terms[..., half:count, :]
        count = half
    return terms[..., 0, :]


def powers(s: FloatArray, count: int) -> FloatArray:
    """Give s (r,) to the powers 0, 1, ..., count - 1, at least two: (count, r)."""
    table = np.empty((count, len(s)))
    table[0], table[1] = 1.0, s
    done = 2
    while done < count:
        more = min(done - 1, count - done)
        np.multiply(table[1 : more + 1], table[done - 1], out=table[done : done + more])
        done += more
    return table


@attrs.define(eq=False)
class _Search:
    """Rows whose roots are not known yet: polynomials q and q', bracket, place.

    The last step is kept too, nil where it was none of Newton's.
    """

    row: NDArray[np.intp]
    pair: FloatArray
    low: FloatArray
    high: FloatArray
    x: FloatArray
    step: FloatArray

    def keep(self, kept: NDArray[np.bool_]) -> None:
        """Drop the rows whose roots are found."""
        self.row, self.pair = self.row[kept], self.pair[..., kept]
        self.low, self.high = self.low[kept], self.high[kept]
        self.x, self.step = self.x[kept], self.step[kept]

    def advance(self, late: bool, halve: bool) -> NDArray[np.bool_]:
        """Take a step; tell which rows are done."""
        x, degree = self.x, self.pair.shape[1] - 1
        ratio = 1.0 / (1.0 - x)
        value, slope = _summed(self.pair * powers(x * ratio, degree + 1))
        slope = (slope * ratio - degree * value) * ratio
        np.copyto(self.low, x, where=value < 0.0)
        np.copyto(self.high, x, where=value > 0.0)
        steep = slope > 0.0
        place = x - value / np.where(steep, slope, 1.0)
        trusted = steep & (place >= self.low) & (place <= self.high)
        if halve:
            trusted &= np.abs(place - x) < _LATE_STOP
        place = np.where(trusted, place, 0.5 * (self.low + self.high))
        step = np.abs(place - x)
        promised = step**3 < _PROMISED * self.step**2
        done = (step < (_LATE_STOP if late else _STOP)) | (promised & trusted & (step < 1e-5))
        self.x, self.step = place, np.where(trusted, step, 0.0)
        return np.asarray(done | (value == 0.0))


def _roots(scaled: FloatArray, start: FloatArray) -> FloatArray:
    """Find the roots in [0, 1/2] of polynomials q, rising; coefficients (d + 1, r)."""
    count, rows = scaled.shape
    slopes = np.zeros_like(scaled)
    slopes[:-1] = scaled[1:] * np.arange(1.0, count)[:, None]
    search = _Search(
        np.arange(rows), np.stack([scaled, slopes]),
        np.full(rows, -_BEYOND), np.full(rows, 0.5 + _BEYOND), start, np.zeros(rows),
    )  # fmt: skip
    found = np.empty(rows)
    for turn in range(_MOST):
        done = search.advance(turn >= _EARLY, turn >= _EARLY and turn % 2 == 1)
        found[search.row] = search.x
        if done.any():
            search.keep(~done)
            if not len(search.row):
                break
    return np.clip(found, 0.0, 0.5)
