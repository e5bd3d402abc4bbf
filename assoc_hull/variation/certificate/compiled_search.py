"""The search for the least of a polynomial on boxes, compiled: what `find_least_minor` does.

Importing this module imports numba. Boxes are taken in the same order, round by round, and with the
same arithmetic, so that what is found has the same bits.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.variation.certificate.compiled_search import SearchLimits, search_coefficients
>>> limits = SearchLimits(1e-9, 1e-4, 2000, 8000, 60_000, 14, 1e-12)
>>> lower, upper, top = np.zeros((1, 1)), np.ones((1, 1)), np.array([[[[1.0]], [[0.0]], [[1.0]]]])
>>> found = search_coefficients(lower, upper, top, np.zeros(1), 0.0, limits)
>>> round(found.least, 9), found.where.tolist()  # t^2 - t + 1/2, coefficients of which are 1 0 1
(0.5, [0.5])
"""

from __future__ import annotations

from collections.abc import Callable

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.numeric.jit import jit, was_loaded

__all__ = ["FoundLeast", "SearchLimits", "search_coefficients", "warm"]


@attrs.frozen
class SearchLimits:
    """When a search ends.

    Attributes
    ----------
    near, nearly : float
        How sharp the least value is to be, with few boxes and with many.
    sharp, enough, most : int
        How many boxes are many; with how many only what may fail counts; how many are too many.
    depth : int
        Rounds a parameter.
    tie : float
        Values this close are equal.
    """

    near: float
    nearly: float
    sharp: int
    enough: int
    most: int
    depth: int
    tie: float


@attrs.frozen(eq=False)
class FoundLeast:
    """What a search has found: least value, bound, its parameters (k,), its box, and counts."""

    least: float
    bound: float
    where: FloatArray
    home: int
    boxes: int
    splits: int


@jit
def _set_halves(
    values: FloatArray, first: FloatArray, last: FloatArray, n: int, axis: int, low: IntArray
) -> None:
    """Set the coefficients of both halves across a parameter; `low` is the shape (3,)."""
    before, size, behind = 1, low[axis], 1
    for k in range(axis):
        before *= low[k]
    for k in range(axis + 1, 3):
        behind *= low[k]
    row = np.empty(size)
    for i in range(before):
        for j in range(behind):
            at = i * size * behind + j
            for s in range(size):
                row[s] = values[n, at + s * behind]
            for s in range(size):
                first[n, at + s * behind] = row[0]
                last[n, at + (size - 1 - s) * behind] = row[size - 1 - s]
                for r in range(size - 1 - s):
                    row[r] = 0.5 * (row[r] + row[r + 1])


@jit
def _spread(values: FloatArray, n: int, axis: int, shape: IntArray) -> float:
    """Give by how much coefficients of a box differ most along a parameter."""
    before, size, behind = 1, shape[axis], 1
    for k in range(axis):
        before *= shape[k]
    for k in range(axis + 1, 3):
        behind *= shape[k]
    found = 0.0
    for i in range(before):
        for j in range(behind):
            at = i * size * behind + j
            least = most = values[n, at]
            for s in range(1, size):
                value = values[n, at + s * behind]
                least = value if value < least else least
                most = value if value > most else most
            found = most - least if most - least > found else found
    return found


@jit
def _corner(bits: int, sides: int, shape: IntArray) -> int:
    """Give which coefficient is that at a corner; the last parameter is the lowest bit."""
    at = 0
    for k in range(3):
        upper = k < sides and (bits >> (sides - 1 - k)) & 1 == 1
        at = at * shape[k] + (shape[k] - 1 if upper else 0)
    return at


@jit
def search(
    lower: FloatArray, upper: FloatArray, top: FloatArray, shape: IntArray, slack: FloatArray,
    enough: float, numbers: FloatArray, counts: IntArray, where: FloatArray, found: FloatArray,
    told: IntArray,
) -> None:  # fmt: skip
    """Search boxes (m, k) with coefficients (m, n), of `shape` (3,).

    `found` becomes the least value and the bound, `told` the box of the least, and how many boxes
    were searched and halved.
    """
    near, nearly, tie = numbers[0], numbers[1], numbers[2]
    sides, least, bound, count, splits = lower.shape[1], np.inf, np.inf, 0, 0
    home = np.arange(len(lower))
    where[:] = lower[0]
    told[0] = 0
    rounds = counts[3] * sides
    for turn in range(rounds + 1):
        m = len(lower)
        if m == 0:
            break
        count += m
        low = np.empty(m)
        value = np.inf
        for n in range(m):
            low[n] = top[n, 0]
            for j in range(1, top.shape[1]):
                low[n] = top[n, j] if top[n, j] < low[n] else low[n]
            low[n] -= slack[home[n]]
            for bits in range(1 << sides):
                corner = top[n, _corner(bits, sides, shape)]
                value = corner if corner < value else value
        if value < least - tie:
            # of those that are equal the last one is told
            for n in range(m):
                for bits in range(1 << sides):
                    corner = top[n, _corner(bits, sides, shape)]
                    if corner <= value + tie:
                        least, told[0] = corner, home[n]
                        for k in range(sides):
                            up = (bits >> (sides - 1 - k)) & 1 == 1
                            where[k] = upper[n, k] if up else lower[n, k]
        sharp = near if count < counts[0] else nearly
        kept = np.empty(m, np.int64)
        left, rest = 0, np.inf
        for n in range(m):
            more = low[n] < least - sharp
            if count > counts[1]:
                more = more and low[n] < enough and least > 0.0
            if more:
                kept[left] = n
                left += 1
                rest = low[n] if low[n] < rest else rest
            else:
                bound = low[n] if low[n] < bound else bound
        if count + 2 * left > counts[2] or turn == rounds:
            bound = rest if rest < bound else bound
            break
        splits += left
        next_low, next_up = np.empty((2 * left, sides)), np.empty((2 * left, sides))
        next_top, next_home = np.empty((2 * left, top.shape[1])), np.empty(2 * left, np.int64)
        chosen, mine = np.empty(left, np.int64), np.empty((left, top.shape[1]))
        for i in range(left):
            mine[i] = top[kept[i]]
            chosen[i], most = 0, -1.0
            for k in range(sides):
                wide = _spread(mine, i, k, shape)
                if wide > most:
                    chosen[i], most = k, wide
        first, last, at = np.empty(mine.shape), np.empty(mine.shape), 0
        for k in range(sides):
            size = 0
            for i in range(left):
                size += chosen[i] == k
            j = at
            for i in range(left):
                if chosen[i] != k:
                    continue
                _set_halves(mine, first, last, i, k, shape)
                n, middle = kept[i], 0.5 * (lower[kept[i], k] + upper[kept[i], k])
                for row in (j, j + size):
                    next_low[row], next_up[row] = lower[n], upper[n]
                    next_home[row] = home[n]
                next_up[j, k], next_low[j + size, k] = middle, middle
                next_top[j], next_top[j + size] = first[i], last[i]
                j += 1
            at += 2 * size
        lower, upper, top, home = next_low, next_up, next_top, next_home
    found[0], found[1] = least, bound
    told[1], told[2] = count, splits


_search: Callable[..., None] = search


def search_coefficients(
    lower: FloatArray, upper: FloatArray, top: FloatArray, slack: FloatArray, enough: float,
    limits: SearchLimits,
) -> FoundLeast:  # fmt: skip
    """Find the least of polynomials on boxes (m, k) of up to three parameters.

    Parameters
    ----------
    lower, upper : (m, k)
        The boxes.
    top : (m, d_1 + 1, ..)
        Their Bernstein coefficients.
    slack : (m,)
        What rounding may have added to these.
    enough : float
        Above this, sharpness is not worth many boxes.
    limits : SearchLimits
    """
    shape = np.ones(3, np.int64)
    shape[: lower.shape[1]] = top.shape[1 : 1 + lower.shape[1]]
    numbers = np.array([limits.near, limits.nearly, limits.tie])
    counts = np.array([limits.sharp, limits.enough, limits.most, limits.depth], np.int64)
    where, found, told = np.empty(lower.shape[1]), np.empty(2), np.empty(3, np.int64)
    given = (np.array(each, order="C") for each in (lower, upper, top.reshape(len(top), -1)))
    _search(*given, shape, np.array(slack), float(enough), numbers, counts, where, found, told)
    least, bound = found.tolist()
    home, boxes, splits = told.tolist()
    return FoundLeast(least, bound, where, home, boxes, splits)


_FEW = SearchLimits(1e-9, 1e-4, 10, 20, 30, 2, 1e-12)


def warm() -> bool:
    """Compile all, or load what was compiled; tell whether it was loaded."""
    one = np.zeros((1, 1))
    search_coefficients(one, one + 1.0, np.ones((1, 2)), np.zeros(1), 0.0, _FEW)
    return was_loaded(search)
