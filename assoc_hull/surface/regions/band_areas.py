"""Areas inside and outside a band, from the areas above and below each of its two limits.

Of a search for K = K0 come P (K > K0), N (K < K0), Z (K = K0 to rounding) and U (unresolved), of
one for K = -K0 likewise p, n, z, u. Then

    positive = P,  negative = n,  unresolved = U + u,  zero = N + Z - n - u

so that the four add up to P + N + Z + U, which has to be the whole area, found by itself. A spot
that is unresolved in both searches counts twice as such, never as zero.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.surface.regions.band_areas import band_areas
>>> above = np.array([[2.0, 3.0, 0, 0, 2, 3, 0, 5]])
>>> below = np.array([[4.0, 1.0, 0, 0, 4, 1, 0, 5]])
>>> band_areas(above, below)[0, :4]
array([2., 1., 2., 0.])
"""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray

__all__ = ["band_areas"]


def band_areas(upper: FloatArray, lower: FloatArray) -> FloatArray:
    """Give the areas (k, 8) of regions from those of searches for K0 and for -K0, m2.

    Parameters
    ----------
    upper, lower : (k, 8), m2
        Positive, negative, zero, unresolved, both estimates, error estimate and total of each.

    Returns
    -------
    (k, 8), m2
        The same columns for K > K0, K < -K0 and what lies between.
    """
    above, not_above = upper[:, 0], upper[:, 1] + upper[:, 2]
    below = lower[:, 1]
    between = not_above - below - lower[:, 3]
    zero = np.maximum(between, 0.0)
    unresolved = np.maximum(upper[:, 3] + lower[:, 3] + np.minimum(between, 0.0), 0.0)
    return np.column_stack([
        above, below, zero, unresolved, upper[:, 4], lower[:, 5], upper[:, 6] + lower[:, 6],
        upper[:, 7],
    ])  # fmt: skip
