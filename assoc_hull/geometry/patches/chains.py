"""Arcs in a row: each follows the one that ends where it begins.

Arcs are walked with the positive side on the left, so that an end of one is the beginning of the
next. Ranks are found by doubling: in log2(n) passes over all arcs at once.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.chains import chained
>>> following = np.array([2, -1, 1, 4, 3])
>>> chained(following).arcs
array([0, 2, 1, 3, 4])
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.patches.cells import Arcs
from assoc_hull.geometry.patches.touching import connected

__all__ = ["Chains", "chained", "directed", "forward"]


@attrs.frozen(eq=False)
class Chains:
    """Chains of arcs, one after the other.

    Attributes
    ----------
    arcs : (a,) int
        The arcs in the order in which they are walked, chain by chain.
    start : (c + 1,) int
        Chain i is ``arcs[start[i] : start[i + 1]]``.
    closed : (c,) bool
        Whether the last arc of a chain leads to its first.
    """

    arcs: IntArray
    start: IntArray
    closed: NDArray[np.bool_]

    def __attrs_post_init__(self) -> None:
        freeze(self.arcs, self.start, self.closed)

    def __len__(self) -> int:
        """Count the chains."""
        return len(self.closed)

    @property
    def firsts(self) -> IntArray:
        """The first arc of each chain."""
        return np.asarray(self.arcs[self.start[:-1]])

    @property
    def lasts(self) -> IntArray:
        """The last arc of each chain."""
        return np.asarray(self.arcs[self.start[1:] - 1])

    def of(self, chain: int) -> IntArray:
        """Give the arcs of one chain."""
        return self.arcs[self.start[chain] : self.start[chain + 1]]


def forward(arcs: Arcs) -> NDArray[np.bool_]:
    """Tell which arcs (a,) have the positive side on the left as they run.

    With u to the right and v upward, an arc u = g(v) runs upward, and the larger u lie on its
    right; an arc v = g(u) runs to the right, and the larger v lie on its left.
    """
    return np.asarray(np.where(arcs.across == 0, ~arcs.rising, arcs.rising))


def directed(arcs: Arcs) -> FloatArray:
    """Give the ends (a, 2, 2) of arcs in the order in which they are walked."""
    return np.where(forward(arcs)[:, None, None], arcs.ends, arcs.ends[:, ::-1])


def chained(following: IntArray) -> Chains:
    """Put arcs in order.

    Parameters
    ----------
    following : (a,) int
        The arc after each, or -1; none follows two.

    Returns
    -------
    Chains
        In the order of the least arc of each; a closed chain begins with its least arc.
    """
    count = len(following)
    arcs = np.arange(count)
    before = np.full(count, -1)
    has = following >= 0
    before[following[has]] = arcs[has]
    chain = connected(count, np.stack([arcs[has], following[has]], axis=1))
    least = np.unique(chain, return_index=True)[1]
    closed = np.bincount(chain[before < 0], minlength=len(least)) == 0
    before[least[closed]] = -1
    order = np.lexsort([_ranks(before), chain])
    start = np.searchsorted(chain[order], np.arange(len(least) + 1))
    return Chains(order, start, closed)


def _ranks(before: IntArray) -> IntArray:
    """Count the arcs that come before each, up to the one that has none."""
    rank = (before >= 0).astype(np.intp)
    jump = np.where(before >= 0, before, np.arange(len(before)))
    while True:
        further = rank[jump]
        if not further.any():
            return rank
        rank = rank + further
        jump = jump[jump]
