"""Ends of arcs that coincide, arcs in a row, and pieces joined into loops.

Arcs are walked with the positive side on the left, so an end of one begins the next.
Where several loops touch in a point, each keeps to its own side.
"""

from __future__ import annotations

from typing import Self

import attrs
import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.patches.adjacency import connected_labels
from assoc_hull.geometry.patches.cell_borders import SHORT
from assoc_hull.geometry.patches.cells import ZeroSetArcs

__all__ = [
    "ArcChains",
    "ArcJoints",
    "chain_arcs",
    "directed_ends",
    "find_joints",
    "next_pieces",
    "positive_on_left",
]


@attrs.frozen(eq=False)
class ArcJoints:
    """Points where arcs begin and end.

    Attributes
    ----------
    joint : (a, 2) int
        Where each arc begins and where it ends.
    first : (j,) int
        The first end of each joint: arc * 2 for a beginning, arc * 2 + 1 for an end.
    heads, tails : (j,) int
        How many arcs end and begin there. An arc that is shorter than the tolerance, so that
        both its ends are one joint, does neither.
    """

    joint: IntArray
    first: IntArray
    heads: IntArray
    tails: IntArray

    def __attrs_post_init__(self) -> None:
        freeze(self.joint, self.first, self.heads, self.tails)

    @classmethod
    def numbered(cls, joint: IntArray) -> Self:
        """Count what meets where, of the numbers of joints at both ends (a, 2)."""
        flat, count = joint.reshape(-1), int(joint.max(initial=-1)) + 1
        first = np.full(count, len(flat))
        np.minimum.at(first, flat, np.arange(len(flat)))
        long = joint[joint[:, 0] != joint[:, 1]]
        heads = np.bincount(long[:, 1], minlength=count)
        return cls(joint, first, heads, np.bincount(long[:, 0], minlength=count))

    def __len__(self) -> int:
        """Count the joints."""
        return len(self.first)

    @property
    def through(self) -> NDArray[np.bool_]:
        """Where one arc ends and one begins, (j,)."""
        return np.asarray((self.heads == 1) & (self.tails == 1))

    @property
    def free(self) -> NDArray[np.bool_]:
        """Where a single arc ends or begins, (j,)."""
        return np.asarray(self.heads + self.tails == 1)

    @property
    def short(self) -> NDArray[np.bool_]:
        """Which arcs (a,) are shorter than the tolerance."""
        return np.asarray(self.joint[:, 0] == self.joint[:, 1])

    @property
    def meeting(self) -> NDArray[np.bool_]:
        """Where arcs meet that are not each other's continuation, (j,)."""
        return np.asarray((self.heads + self.tails > 1) & ~self.through)


def find_joints(places: FloatArray, tolerance: float = 1e-9) -> ArcJoints:
    """Find which ends coincide, within `tolerance` in each parameter, by their places (a, 2, 2).

    Joints are numbered by their first ends.
    """
    ends = places.reshape(-1, 2)
    pairs = cKDTree(ends).query_pairs(tolerance, p=np.inf, output_type="ndarray")
    return ArcJoints.numbered(connected_labels(len(ends), pairs).reshape(-1, 2))


@attrs.frozen(eq=False)
class ArcChains:
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


def positive_on_left(arcs: ZeroSetArcs) -> NDArray[np.bool_]:
    """Tell which arcs (a,) have the positive side on the left as they run.

    With u to the right and v upward, an arc u = g(v) runs upward, and the larger u lie on its
    right; an arc v = g(u) runs to the right, and the larger v lie on its left.
    """
    return np.asarray(np.where(arcs.across == 0, ~arcs.rising, arcs.rising))


def directed_ends(arcs: ZeroSetArcs) -> FloatArray:
    """Give the ends (a, 2, 2) of arcs in the order in which they are walked."""
    return np.where(positive_on_left(arcs)[:, None, None], arcs.ends, arcs.ends[:, ::-1])


def chain_arcs(following: IntArray) -> ArcChains:
    """Put arcs in order, by the arc after each, (a,), or -1; none follows two.

    Chains come in the order of their least arcs; a closed one begins with its least arc.
    """
    count = len(following)
    arcs = np.arange(count)
    before = np.full(count, -1)
    has = following >= 0
    before[following[has]] = arcs[has]
    chain = connected_labels(count, np.stack([arcs[has], following[has]], axis=1))
    least = np.unique(chain, return_index=True)[1]
    closed = np.bincount(chain[before < 0], minlength=len(least)) == 0
    before[least[closed]] = -1
    order = np.lexsort([_ranks(before), chain])
    start = np.searchsorted(chain[order], np.arange(len(least) + 1))
    return ArcChains(order, start, closed)


def _ranks(before: IntArray) -> IntArray:
    """Count the arcs that come before each, up to the one that has none.

    By doubling: in log2(n) passes over all arcs at once.
    """
    rank = (before >= 0).astype(np.intp)
    jump = np.where(before >= 0, before, np.arange(len(before)))
    while True:
        further = rank[jump]
        if not further.any():
            return rank
        rank = rank + further
        jump = jump[jump]


def next_pieces(pieces: FloatArray, leaving: FloatArray, arriving: FloatArray) -> IntArray:
    """Give the piece (p,) that begins where each of some pieces (p, 2, 2) ends, or -1.

    What pieces bound lies on their left; `leaving`, `arriving` (p, 2) are the directions at the
    beginning and at the end. Where several loops touch in a point, a piece is followed by the one
    that bounds the same sector.
    """
    tail, head = find_joints(pieces, SHORT).joint.T
    count, rows = len(pieces), np.arange(len(pieces))
    # Round each point, counter-clockwise: the sector between a piece that leaves and the next
    # that arrives is what both bound.
    out = np.arctan2(leaving[:, 1], leaving[:, 0])
    back = np.arctan2(-arriving[:, 1], -arriving[:, 0])
    joint, angle = np.concatenate([tail, head]), np.concatenate([out, back])
    arrives = np.repeat([0, 1], count)
    order = np.lexsort([1 - arrives, angle, joint])
    joint, piece, arrives = joint[order], np.tile(rows, 2)[order], arrives[order]
    starts = np.searchsorted(joint, joint)
    stops = np.searchsorted(joint, joint, side="right")
    here = np.arange(2 * count)
    before = np.where(here > starts, here - 1, stops - 1)
    found = np.full(count, -1)
    paired = (arrives == 1) & (arrives[before] == 0)
    found[piece[paired]] = piece[before[paired]]
    return _matched(found, piece, arrives, joint)


def _matched(found: IntArray, piece: IntArray, arrives: IntArray, joint: IntArray) -> IntArray:
    """Match what angles left over, point by point, in order."""
    taken = np.zeros(len(found), bool)
    taken[found[found >= 0]] = True
    late = (arrives == 1) & (found[piece] < 0)
    free = (arrives == 0) & ~taken[piece]
    both = np.intersect1d(joint[late], joint[free])
    for one in both.tolist():
        ends, begins = piece[late & (joint == one)], piece[free & (joint == one)]
        pairs = min(len(ends), len(begins))
        found[ends[:pairs]] = begins[:pairs]
    return found
