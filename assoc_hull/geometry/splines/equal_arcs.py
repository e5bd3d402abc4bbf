"""Points at given lengths along chains of cubics: equal parts of many curves at once.

A chain is a run of cubics that follow one another without a gap. The length s(u) of a cubic is
inverted by Newton's rule, whose derivative is the speed; where a step leaves its bracket the
bracket is halved instead.

Source: H.J. Son, H.C. Kim, "hull form parameter modules for performance analysis", J. of
CAD/CAM (Korea) 13(6), 2008, who divide a table of chords; here the length itself is inverted.
"""

from __future__ import annotations

from functools import cached_property

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.numeric.polynomials import differentiate
from assoc_hull.geometry.splines.length import length_until

__all__ = ["Chains", "shares"]

_STEPS = 60
_DONE = 1e-13
"""A step this small, as a part of its chain, ends the search; 1e-10 is what is promised."""


@attrs.frozen(eq=False)
class Chains:
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
    >>> from assoc_hull.geometry.splines.equal_arcs import Chains
    >>> corner = np.zeros((2, 4, 3))
    >>> corner[0, 1] = [0.0, 3.0, 0.0]  # 3 m to port, then 1 m up
    >>> corner[1, :2] = [[0.0, 3.0, 0.0], [0.0, 0.0, 1.0]]
    >>> Chains(np.array([0, 2]), corner).equal(3).tolist()
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

    def take(self, chosen: IntArray) -> Chains:
        """Give some of the chains, (n,) int, in that order."""
        size = np.diff(self.start)[chosen]
        start = np.append(0, np.cumsum(size)).astype(np.int64)
        first = np.repeat(self.start[chosen] - start[:-1], size)
        return Chains(start, self.cubic[np.arange(len(first)) + first])

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
        """Give the places at lengths along chains.

        Parameters
        ----------
        chain : (m,) int
            The chain of each.
        length : (m,), m
            From its beginning.

        Returns
        -------
        (m, 3), m
            Places; the error of the length is below 1e-10 of that of the chain.
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


def shares(lengths: FloatArray, total: int, least: IntArray | int = 1) -> IntArray:
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
    >>> from assoc_hull.geometry.splines.equal_arcs import shares
    >>> shares(np.array([12.0, 3.14, 8.5]), 19).tolist()
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
