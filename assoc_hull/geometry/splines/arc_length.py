"""Arc length of curves, and points at given lengths along them.

Lengths are integrated by Gauss's rule on segments that are halved until they agree. `CubicChains`
are cubics that follow one another without a gap, of one curve or of several; the length along
them is inverted, so that many chains are parted into equal lengths at once.

Source: H.J. Son, H.C. Kim, "hull form parameter modules for performance analysis", J. of
CAD/CAM (Korea) 13(6), 2008; the control of the error by halving is our own, and where they divide
a table of chords the length itself is inverted here.
"""

from __future__ import annotations

from functools import cached_property

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.geometry.numeric.polynomials import differentiate, unit_roots
from assoc_hull.geometry.numeric.vectors import dot
from assoc_hull.geometry.splines.segments import (
    locate_parameters,
    power_coefficients,
    segment_curve,
    sum_per_curve,
)

__all__ = [
    "CubicChains",
    "arc_length",
    "length_at",
    "length_until",
    "segment_length",
    "share_by_length",
]

_ROOTS, _WEIGHTS = np.polynomial.legendre.leggauss(8)
_NODES, _WEIGHTS = 0.5 + 0.5 * _ROOTS, 0.5 * _WEIGHTS
_AGREEMENT = 1e-12  # of the length of the segment
_HALVINGS = 40  # parts of 1e-12 of a segment
_SLOW = 0.05  # of the greatest speed: where it all but vanishes, rules agree by chance
_NEAR = np.concatenate([[0.0], *([-step, step] for step in 0.5 ** np.arange(1, 31))])


def segment_length(batch: SplineBatch) -> FloatArray:
    """Give the arc length of each segment.

    Parameters
    ----------
    batch : SplineBatch
        The curves.

    Returns
    -------
    (s,), m
        Lengths, segment by segment; relative error 1e-12.

    Raises
    ------
    TooFewPointsError
        A curve has fewer than two points.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.curves import SplineBatch
    >>> from assoc_hull.geometry.splines.arc_length import segment_length
    >>> xyz = np.array([[0.0, 0, 0], [3, 4, 0]])
    >>> along = np.array([[0.6, 0.8, 0], [0.6, 0.8, 0]])
    >>> line = SplineBatch(np.array([0, 2]), np.array([0.0, 5]), xyz, along, along.copy())
    >>> segment_length(line).round(12).tolist()
    [5.0]
    """
    slopes = differentiate(power_coefficients(batch))
    lengths = _adaptive(slopes, np.ones(len(slopes)))
    freeze(lengths)
    return lengths


def arc_length(batch: SplineBatch) -> FloatArray:
    """Give the arc length of each curve.

    Parameters
    ----------
    batch : SplineBatch
        The curves.

    Returns
    -------
    (m,), m
        Lengths; relative error 1e-12.

    Raises
    ------
    TooFewPointsError
        A curve has fewer than two points.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.curves import SplineBatch
    >>> from assoc_hull.geometry.splines.arc_length import arc_length
    >>> xyz = np.array([[0.0, 0, 0], [3, 4, 0]])
    >>> along = np.array([[0.6, 0.8, 0], [0.6, 0.8, 0]])
    >>> line = SplineBatch(np.array([0, 2]), np.array([0.0, 5]), xyz, along, along.copy())
    >>> arc_length(line).round(12).tolist()
    [5.0]
    """
    return sum_per_curve(batch, segment_length(batch))


def length_at(batch: SplineBatch, curve: ArrayLike, t: ArrayLike) -> FloatArray:
    """Give the arc length from the beginning of a curve to given parameters.

    Parameters
    ----------
    batch : SplineBatch
        The curves.
    curve : (k,) int
        The curve of each parameter.
    t : (k,), m
        Chord-length parameters.

    Returns
    -------
    (k,), m
        Lengths; error 1e-12 of the length of the curve.

    Raises
    ------
    BadInputError
        There is no such curve, or a parameter lies off its curve.
    TooFewPointsError
        A curve has fewer than two points.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.curves import SplineBatch
    >>> from assoc_hull.geometry.splines.arc_length import length_at
    >>> xyz = np.array([[0.0, 0, 0], [3, 4, 0]])
    >>> along = np.array([[0.6, 0.8, 0], [0.6, 0.8, 0]])
    >>> line = SplineBatch(np.array([0, 2]), np.array([0.0, 5]), xyz, along, along.copy())
    >>> length_at(line, [0, 0], [1.0, 5.0]).round(12).tolist()
    [1.0, 5.0]
    """
    segment, u = locate_parameters(batch, curve, t)
    slopes = differentiate(power_coefficients(batch))
    lengths = _before(batch)[segment] + _adaptive(slopes[segment], u)
    freeze(lengths)
    return lengths


def length_until(slopes: FloatArray, u: FloatArray) -> FloatArray:
    """Give the arc length of cubics from u = 0 to given u (p,), from 0 to 1; relative error 1e-12.

    `slopes` (p, 3, 3), m, are coefficients of the derivative of each cubic, in 1, u, u^2.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.splines.arc_length import length_until
    >>> straight = np.zeros((1, 3, 3))
    >>> straight[0, 0] = [3.0, 4.0, 0.0]
    >>> length_until(straight, np.array([0.5])).round(12).tolist()
    [2.5]
    """
    lengths = _adaptive(slopes, u)
    freeze(lengths)
    return lengths


def _before(batch: SplineBatch) -> FloatArray:
    """Give the length of each curve before each of its segments, (s,)."""
    owner = segment_curve(batch)
    place = np.arange(len(owner)) - (batch.start[:-1] - np.arange(batch.count))[owner]
    # One row per curve, so that no curve's sums carry the rounding of another's.
    table = np.zeros((batch.count, int(place.max(initial=0)) + 2))
    table[owner, place + 1] = segment_length(batch)
    sums: FloatArray = np.cumsum(table, axis=1)[owner, place]
    return sums


def _gauss(slopes: FloatArray, low: FloatArray, high: FloatArray) -> FloatArray:
    """Integrate the speed over the parts [low, high] of segments, (p,)."""
    integral: FloatArray = (_speed(slopes, low, high) * _WEIGHTS).sum(axis=1) * (high - low)
    return integral


def _speed(slopes: FloatArray, low: FloatArray, high: FloatArray) -> FloatArray:
    """Give the speed at the nodes of the rule on the parts [low, high], (p, 8)."""
    u = low[:, None] + (high - low)[:, None] * _NODES
    squared = np.zeros_like(u)
    for axis in range(3):
        constant, linear, square = (slopes[:, row, axis, None] for row in range(3))
        speed = (square * u + linear) * u + constant
        squared += speed * speed
    found: FloatArray = np.sqrt(squared)
    return found


def _adaptive(slopes: FloatArray, until: FloatArray) -> FloatArray:
    """Give the lengths of segments from u = 0 to `until`, (p,)."""
    begin = np.zeros(len(until))
    speed = _speed(slopes, begin, until)
    whole = (speed * _WEIGHTS).sum(axis=1) * until
    halves = _gauss(slopes, begin, 0.5 * until) + _gauss(slopes, 0.5 * until, until)
    agree = np.abs(halves - whole) <= _AGREEMENT * halves
    hard = np.flatnonzero(~agree | (speed.min(axis=1) < _SLOW * speed.max(axis=1)))
    if len(hard):
        edge = _graded(_slowest(slopes[hard]), until[hard])
        item = np.repeat(np.arange(len(hard)), edge.shape[1] - 1)
        low, high = edge[:, :-1].ravel(), edge[:, 1:].ravel()
        halves[hard] = _halved(slopes[hard], item, low, high, _AGREEMENT * halves[hard])
    return halves


def _graded(slowest: FloatArray, until: FloatArray) -> FloatArray:
    """Give where to cut segments: at those places, and ever closer to them, (p, k)."""
    near = (slowest[:, :, None] + _NEAR).reshape(len(until), -1)
    return np.asarray(np.sort(np.clip(near, 0.0, until[:, None]), axis=1))


def _slowest(slopes: FloatArray) -> FloatArray:
    """Give 0, the places where the speed is least or greatest, and 1, (p, 5).

    At a cusp the speed has a corner, at which a rule agrees with its halves by chance.
    """
    gain = np.zeros((len(slopes), 4))
    second = differentiate(slopes)
    for i in range(3):
        for j in range(2):
            gain[:, i + j] += dot(slopes[:, i], second[:, j])
    end = np.ones((len(slopes), 1))
    return np.concatenate([0.0 * end, unit_roots(gain), end], axis=1)


def _halved(
    slopes: FloatArray, item: IntArray, low: FloatArray, high: FloatArray, limit: FloatArray
) -> FloatArray:
    """Add up the lengths of parts per item, each halved until it agrees with its halves."""
    total = np.zeros(len(limit))
    whole = _gauss(slopes[item], low, high)
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        left = _gauss(slopes[item], low, middle)
        right = _gauss(slopes[item], middle, high)
        wide = ~(np.abs(left + right - whole) <= limit[item])
        np.add.at(total, item[~wide], (left + right)[~wide])
        if not wide.any():
            return total
        item = np.tile(item[wide], 2)
        low = np.concatenate([low[wide], middle[wide]])
        high = np.concatenate([middle[wide], high[wide]])
        whole = np.concatenate([left[wide], right[wide]])
    np.add.at(total, item, whole)
    return total


# --------------------------------------------------------------------------------------
# Points at given lengths along chains of cubics.
#
# The length s(u) of a cubic is inverted by Newton's rule, whose derivative is the speed; where a
# step leaves its bracket the bracket is halved instead.

_STEPS = 60
_DONE = 1e-13
"""A step this small, as a part of its chain, ends the search; 1e-10 is what is promised."""


@attrs.frozen(eq=False)
class CubicChains:
    """Curves put together from cubics.

    Attributes
    ----------
    start : (k + 1,) int
        Where the cubics of each chain begin.
    cubic : (s, 4, 3), m
        Coefficients of 1, u, u^2, u^3, with u from 0 to 1 along each cubic.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.splines.arc_length import CubicChains
    >>> corner = np.zeros((2, 4, 3))
    >>> corner[0, 1] = [0.0, 3.0, 0.0]  # 3 m to port, then 1 m up
    >>> corner[1, :2] = [[0.0, 3.0, 0.0], [0.0, 0.0, 1.0]]
    >>> CubicChains(np.array([0, 2]), corner).equal(3).tolist()
    [[[0.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 3.0, 1.0]]]
    """

    start: IntArray
    cubic: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.start, self.cubic)

    @property
    def count(self) -> int:
        """Number of chains."""
        return len(self.start) - 1

    def take(self, chosen: IntArray) -> CubicChains:
        """Give some of the chains, (n,) int, in that order."""
        size = np.diff(self.start)[chosen]
        start = np.append(0, np.cumsum(size)).astype(np.int64)
        first = np.repeat(self.start[chosen] - start[:-1], size)
        return CubicChains(start, self.cubic[np.arange(len(first)) + first])

    @cached_property
    def ends(self) -> tuple[FloatArray, FloatArray]:
        """The first and the last place of each chain, (k, 3) each, m."""
        return self.cubic[self.start[:-1], 0], self.cubic[self.start[1:] - 1].sum(axis=1)

    @cached_property
    def _slopes(self) -> FloatArray:
        return differentiate(self.cubic)

    @cached_property
    def _lengths(self) -> FloatArray:
        return length_until(self._slopes, np.ones(len(self.cubic)))

    @cached_property
    def before(self) -> FloatArray:
        """The length of each chain before each of its cubics, (s,), m."""
        return self._edges[0]

    @cached_property
    def length(self) -> FloatArray:
        """The length of each chain, (k,), m."""
        return self._edges[1]

    @cached_property
    def _edges(self) -> tuple[FloatArray, FloatArray]:
        owner = np.arange(self.count).repeat(np.diff(self.start))
        place = np.arange(len(owner)) - self.start[:-1][owner]
        # One row per chain, so that no chain's sums carry the rounding of another's.
        table = np.zeros((self.count, int(place.max(initial=0)) + 2))
        table[owner, place + 1] = self._lengths
        sums = np.cumsum(table, axis=1)
        return sums[owner, place], sums[:, -1].copy()

    def at_lengths(self, chain: IntArray, length: FloatArray) -> FloatArray:
        """Give the places (m, 3), m, at lengths (m,) from the beginning of chains (m,).

        The error of the length is below 1e-10 of that of the chain.
        """
        cubic, rest = self._located(chain, length)
        u = self._inverted(cubic, rest, _DONE * self.length[chain])
        return self._place(cubic, u)

    def equal(self, points: int) -> FloatArray:
        """Give points that part each chain into equal lengths, (k, points, 3), m."""
        part = np.arange(points) / (points - 1)
        chain = np.arange(self.count).repeat(points)
        found = self.at_lengths(chain, (self.length[:, None] * part).ravel())
        return found.reshape(self.count, points, 3)

    def _located(self, chain: IntArray, length: FloatArray) -> tuple[IntArray, FloatArray]:
        """Find the cubic on which each length ends, and how much of it is left there."""
        whole = np.where(self.length > 0.0, self.length, 1.0)
        owner = np.arange(self.count).repeat(np.diff(self.start))
        # The keys of one chain lie between twice its number and the next.
        key = 2.0 * owner + np.clip(self.before / whole[owner], 0.0, 1.0)
        wanted = 2.0 * chain + np.clip(length / whole[chain], 0.0, 1.0)
        cubic = np.searchsorted(key, wanted, side="right") - 1
        cubic = np.clip(cubic, self.start[chain], self.start[chain + 1] - 1)
        return cubic, np.clip(length - self.before[cubic], 0.0, self._lengths[cubic])

    def _inverted(self, cubic: IntArray, rest: FloatArray, done: FloatArray) -> FloatArray:
        """Find where cubics have given lengths behind them."""
        whole = self._lengths[cubic]
        u = np.divide(rest, whole, out=np.zeros_like(rest), where=whole > 0.0)
        low, high = np.zeros_like(u), np.ones_like(u)
        open_ = np.flatnonzero((u > 0.0) & (u < 1.0))
        u[u >= 1.0] = 1.0
        for _ in range(_STEPS):
            if not len(open_):
                break
            slopes = self._slopes[cubic[open_]]
            at = u[open_]
            missed = length_until(slopes, at) - rest[open_]
            high[open_] = np.where(missed > 0.0, at, high[open_])
            low[open_] = np.where(missed > 0.0, low[open_], at)
            speed = np.sqrt((_along(slopes, at) ** 2).sum(axis=1))
            with np.errstate(divide="ignore", invalid="ignore"):
                new = at - missed / speed
            inside = (new >= low[open_]) & (new <= high[open_])
            u[open_] = np.where(inside, new, 0.5 * (low[open_] + high[open_]))
            open_ = open_[~(np.abs(missed) <= done[open_])]
        return u

    def _place(self, cubic: IntArray, u: FloatArray) -> FloatArray:
        c, at = self.cubic[cubic], u[:, None]
        found: FloatArray = ((c[:, 3] * at + c[:, 2]) * at + c[:, 1]) * at + c[:, 0]
        return found


def _along(slopes: FloatArray, u: FloatArray) -> FloatArray:
    """Give derivatives, (p, 3)."""
    at = u[:, None]
    found: FloatArray = (slopes[:, 2] * at + slopes[:, 1]) * at + slopes[:, 0]
    return found


def share_by_length(lengths: FloatArray, total: int, least: IntArray | int = 1) -> IntArray:
    """Share whole parts out by length: the largest remainders get what rounding leaves over.

    Parameters
    ----------
    lengths : (k,)
        Of the pieces.
    total : int
        Of all parts, unless the least ones are more.
    least : (k,) int, or int
        What every piece gets at least.

    Returns
    -------
    (k,) int
        Parts of each piece.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.splines.arc_length import share_by_length
    >>> share_by_length(np.array([12.0, 3.14, 8.5]), 19).tolist()
    [10, 2, 7]
    """
    size = np.maximum(np.asarray(lengths, np.float64), 0.0)
    whole = float(size.sum())
    wish = size * total / whole if whole > 0.0 else np.full(len(size), total / len(size))
    floor = np.broadcast_to(np.asarray(least, np.int64), size.shape)
    found = np.maximum(np.floor(wish).astype(np.int64), floor)
    # Pieces that were given more than their wish have no remainder left.
    order = np.argsort(found - wish, kind="stable")
    found[order[: max(total - int(found.sum()), 0)]] += 1
    while found.sum() > total and (found > floor).any():
        found[int(np.argmax(np.where(found > floor, found - wish, -np.inf)))] -= 1
    return found
