"""Least values along form-parameter curves: one may fold back, or fall below an axis.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.form_curves.chain import straight_vertices
>>> from assoc_hull.geometry.form_curves.extremes import least_coordinate, least_rate
>>> line = straight_vertices((0.0, 1.0), (4.0, 3.0))[None]
>>> least_rate(line, 0).round(12).tolist(), least_coordinate(line, 1).round(12).tolist()
([1.0], [1.0])
"""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.form_curves.integrals import power_form

__all__ = ["least_coordinate", "least_rate"]


def least_rate(vertices: FloatArray, axis: int) -> FloatArray:
    """Give the least derivative by t of a coordinate along curves.

    Parameters
    ----------
    vertices : (n, 7, 2)
        One curve a row.
    axis : int
        0 for the abscissa, 1 for the ordinate.

    Returns
    -------
    (n,)
    """
    power = power_form(vertices)[..., axis]
    a, b, c = power[..., 1], 2.0 * power[..., 2], 3.0 * power[..., 3]
    with np.errstate(divide="ignore", invalid="ignore"):
        turn = -b / (2.0 * c)
    turn = np.where((turn > 0.0) & (turn < 1.0), turn, 0.0)
    found = np.minimum(np.minimum(a, a + b + c), a + turn * (b + turn * c))
    return np.asarray(found.min(axis=1))


def least_coordinate(vertices: FloatArray, axis: int) -> FloatArray:
    """Give the least value of a coordinate along curves; arguments as of `least_rate`."""
    power = power_form(vertices)[..., axis]
    a, b, c = power[..., 1], 2.0 * power[..., 2], 3.0 * power[..., 3]
    found = np.minimum(power[..., 0], power.sum(axis=-1))
    with np.errstate(divide="ignore", invalid="ignore"):
        half = -0.5 * (b + np.copysign(np.sqrt(b * b - 4.0 * a * c), b))
        for root in (half / c, a / half):
            u = np.where((root > 0.0) & (root < 1.0), root, 0.0)
            at = power[..., 0] + u * (power[..., 1] + u * (power[..., 2] + u * power[..., 3]))
            found = np.minimum(found, at)
    return np.asarray(found.min(axis=1))
