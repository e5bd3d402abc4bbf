"""Biarcs by the ratio of their two chords: every biarc between two points and directions, once.

Two directions and two points leave one freedom. With the direction of the join as the free number
the parallel case is singular; with the part r that the chord of the first arc has of both it is
not: for any directions less than a half turn from the chord every r between 0 and 1 gives one
biarc without a loop, and r = 1/2 the one of equal chords. With alpha and beta the directions at
the ends and tau that of the join, all from the chord P, the chords of the arcs lie at
(alpha + tau) / 2 and (tau + beta) / 2, and their sum across the chord is nil::

    tan(tau / 2) = - ((1 - r) sin(beta / 2) + r sin(alpha / 2))
                   / ((1 - r) cos(beta / 2) + r cos(alpha / 2))

Arcs turn by tau - alpha and beta - tau, so that all three directions are kept to rounding.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.classical.arc_ratio import biarcs_by_ratio
>>> quarter = biarcs_by_ratio(np.array([2.0]), np.array([0.7]), np.array([-0.7]), np.array([0.5]))
>>> bool(abs(quarter.bend[0, 0] - quarter.bend[1, 0]) < 1e-15), quarter.tau[0] + 0.0
(True, 0.0)
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.classical.arcs import sinc
from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = ["RatioBiarcs", "biarcs_by_ratio"]


@attrs.frozen(eq=False)
class RatioBiarcs:
    """Biarcs in the axes of their chords: from the origin to (chord, 0).

    Attributes
    ----------
    tau : (...), rad
        Direction at the join.
    join : (2, ...), m
        The join, along and left of the chord.
    bend : (2, ...), 1/m
        Curvatures of the two arcs, positive to the left.
    length : (2, ...), m
        Their lengths.
    """

    tau: FloatArray
    join: FloatArray
    bend: FloatArray
    length: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.tau, self.join, self.bend, self.length)


def biarcs_by_ratio(
    chord: FloatArray, alpha: FloatArray, beta: FloatArray, ratio: FloatArray
) -> RatioBiarcs:
    """Give biarcs; the arguments are broadcast.

    Parameters
    ----------
    chord : (...), m
        Distance of the two points, above 0.
    alpha, beta : (...), rad
        Directions at the first and the last point, from the chord to the left, less than pi.
    ratio : (...)
        The part of the first chord, between 0 and 1.

    Returns
    -------
    RatioBiarcs
        Where no such biarc is, curvatures are not finite.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.classical.arc_ratio import biarcs_by_ratio
    >>> found = biarcs_by_ratio(np.array(10.0), np.array(0.0), np.array(0.5), np.array(0.5))
    >>> found.bend.round(8).tolist(), round(float(found.tau), 12)
    ([-0.04948079, 0.1453659], -0.25)
    """
    rest = 1.0 - ratio
    sine = rest * np.sin(0.5 * beta) + ratio * np.sin(0.5 * alpha)
    cosine = rest * np.cos(0.5 * beta) + ratio * np.cos(0.5 * alpha)
    tau = -2.0 * np.arctan(sine / cosine)
    first, last = 0.5 * (alpha + tau), 0.5 * (tau + beta)
    both = chord / (ratio * np.cos(first) + rest * np.cos(last))
    chords = np.stack([ratio * both, rest * both])
    half = 0.5 * np.stack([tau - alpha, beta - tau])
    join = chords[0] * np.stack([np.cos(first), np.sin(first)])
    return RatioBiarcs(tau, join, 2.0 * np.sin(half) / chords, chords / sinc(half))
