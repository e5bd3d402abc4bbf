"""Biarcs by the ratio of their two chords: every biarc between two points and directions, once.

Two directions and two points leave one freedom. With the direction of the join as the free number
the parallel case is singular; with the part r that the chord of the first arc has of both it is
not: for any directions less than a half turn from the chord every r between 0 and 1 gives one
biarc without a loop, and r = 1/2 the one of equal chords. `biarc_family` has the equations.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.classical.arc_ratio import biarcs_by_ratio
>>> quarter = biarcs_by_ratio(np.array([2.0]), np.array([0.7]), np.array([-0.7]), np.array([0.5]))
>>> bool(abs(quarter.bend[0, 0] - quarter.bend[1, 0]) < 1e-15), quarter.tau.round(12) + 0.0
(True, array([0.]))
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.classical.arcs import sinc
from assoc_hull.geometry.classical.biarc_family import spanned
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
    tau, first, chords, half = spanned(chord, alpha, beta, ratio, 1.0 - ratio)
    join = chords[0] * np.stack([np.cos(first), np.sin(first)])
    return RatioBiarcs(tau, join, 2.0 * np.sin(half) / chords, chords / sinc(half))
