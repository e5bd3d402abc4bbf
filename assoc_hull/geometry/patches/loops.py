"""Directed pieces joined into loops.

Where several loops touch in a point, each turns there so that it keeps to its own side: a piece is
followed by the one that bounds the same sector.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.loops import followers
>>> corners = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]])
>>> pieces = np.stack([corners, np.roll(corners, -1, axis=0)], axis=1)
>>> followers(pieces, pieces[:, 1] - pieces[:, 0], pieces[:, 1] - pieces[:, 0])
array([1, 2, 0])
"""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.patches.cell_borders import SHORT
from assoc_hull.geometry.patches.joints import joints_of

__all__ = ["followers"]


def followers(pieces: FloatArray, leaving: FloatArray, arriving: FloatArray) -> IntArray:
    """Tell which piece follows each.

    Parameters
    ----------
    pieces : (p, 2, 2)
        Where pieces begin and end; what they bound lies on their left.
    leaving, arriving : (p, 2)
        Their directions at the beginning and at the end.

    Returns
    -------
    (p,) int
        The piece that begins where each ends, or -1 where there is none.
    """
    tail, head = joints_of(pieces, SHORT).joint.T
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
