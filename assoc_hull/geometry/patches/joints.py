"""Which ends of arcs coincide.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.joints import joints_of
>>> ends = np.array([[[0.0, 0.0], [0.5, 0.5]], [[0.5, 0.5], [1.0, 0.2]]])
>>> joints_of(ends).joint
array([[0, 1],
       [1, 2]])
"""

from __future__ import annotations

from typing import Self

import attrs
import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.patches.touching import connected

__all__ = ["Joints", "joints_of"]


@attrs.frozen(eq=False)
class Joints:
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


def joints_of(places: FloatArray, tolerance: float = 1e-9) -> Joints:
    """Find which ends coincide.

    Parameters
    ----------
    places : (a, 2, 2)
        Where each arc begins and ends.
    tolerance : float
        Ends so far apart still coincide, in each parameter.

    Returns
    -------
    Joints
        Numbered by their first ends.
    """
    ends = places.reshape(-1, 2)
    pairs = cKDTree(ends).query_pairs(tolerance, p=np.inf, output_type="ndarray")
    return Joints.numbered(connected(len(ends), pairs).reshape(-1, 2))
