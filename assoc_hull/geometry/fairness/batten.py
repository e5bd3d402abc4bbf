"""The batten residual: how far a batten springs off a point that it is lifted from.

The loftsman lifts the batten off one nail and lets it run through the two points on either side:
the distance it springs is the residual of the point. For five neighbouring points at parameters t
it is their divided difference of order four,

    c_j = prod over k != j of 1 / (t_j - t_k),  scaled so that the largest |c_j| is 1,
    residual = sum over j of c_j P_j

so it is a length, and every cubic has none.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray

__all__ = ["WINDOW", "batten_coefficients"]

WINDOW = 5
"""Points of a window: the one that is asked about, and two on either side."""


def batten_coefficients(nodes: FloatArray) -> FloatArray:
    """Give the coefficients of the residual of windows, (n, 5), for their parameters, (n, 5).

    The parameters of a window rise; the largest coefficient of each is 1 in size.
    """
    apart = nodes[:, :, None] - nodes[:, None, :]
    apart[:, np.arange(WINDOW), np.arange(WINDOW)] = 1.0
    found: FloatArray = 1.0 / apart.prod(axis=2)
    found /= np.abs(found).max(axis=1, keepdims=True)
    return found
