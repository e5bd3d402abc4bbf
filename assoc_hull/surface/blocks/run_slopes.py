"""How fast parameters change along lines whose nodes have them: monotone cubics.

Fritsch, F.N., Carlson, R.E.: Monotone piecewise cubic interpolation. SIAM Journal on Numerical
Analysis 17 (1980); the weighted harmonic mean is that of Fritsch and Butland (1984).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray

__all__ = ["slopes_along"]

_TINY = 1e-200
"""Slopes whose product is less count as nil: their inverse may have no number."""


def slopes_along(
    curve: IntArray,
    edge: IntArray,
    begin: FloatArray,
    length: FloatArray,
    value: FloatArray,
    straight: NDArray[np.bool_],
) -> tuple[FloatArray, FloatArray]:
    """Give the slopes at both ends of each edge.

    Parameters
    ----------
    curve : (e,) int
        The curve of each edge.
    edge : (e, 2) int
        Its nodes.
    begin : (e,), m
        Where on the curve it begins.
    length : (e,), m
        Its length.
    value : (e, 2, d)
        Values at its ends.
    straight : (e,) bool
        Edges along which values run straight: those beside take over their slope.

    Returns
    -------
    leave, arrive : (e, d)
        Slopes a metre; neighbouring edges of a curve share theirs, and no value overshoots.
    """
    order = np.lexsort((begin, curve))
    size = np.maximum(length, 1e-12)[:, None]
    step = (value[:, 1] - value[:, 0]) / size
    leave, arrive = step.copy(), step.copy()
    a, b = order[:-1], order[1:]
    joined = (curve[a] == curve[b]) & (edge[a, 1] == edge[b, 0]) & ~straight[a] & ~straight[b]
    a, b = a[joined], b[joined]
    weight = 2.0 * size[b] + size[a], size[b] + 2.0 * size[a]
    same = step[a] * step[b] > _TINY
    down = np.where(same, weight[0] / np.where(same, step[a], 1.0), 1.0)
    down = down + np.where(same, weight[1] / np.where(same, step[b], 1.0), 0.0)
    slope = np.where(same, (weight[0] + weight[1]) / down, 0.0)
    arrive[a] = slope
    leave[b] = slope
    return leave, arrive
