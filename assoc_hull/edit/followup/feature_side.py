"""On which side of its points a feature lies, seen against the normal of its plane.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.edit.followup.feature_side import circle_side
>>> arc = np.array([[0.0, 1.0, 0.0], [0.0, 0.8, 0.6], [0.0, 0.0, 1.0]])
>>> circle_side(arc, np.zeros(3), np.array([1.0, 0.0, 0.0]))
1
"""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.numeric.vectors import dot
from assoc_hull.model.feature_geometry import ROUNDING
from assoc_hull.model.state import HullState

__all__ = ["circle_side", "flat_side"]


def circle_side(xyz: FloatArray, centre: FloatArray, normal: FloatArray) -> int:
    """Tell whether the centre lies left of an arc, 1, or right of it, -1.

    Parameters
    ----------
    xyz : (n, 3), m
        Its points in order.
    centre, normal : (3,)
        Centre, m, and unit normal.
    """
    left = np.cross(normal, xyz[1] - xyz[0])
    return 1 if float((left * (centre - xyz[0])).sum()) > 0.0 else -1


def flat_side(state: HullState, edge: IntArray, normal: FloatArray, offset: float) -> int:
    """Tell on which side of its edge a flat lies, by the other points of the hull in its plane.

    Parameters
    ----------
    state : HullState
        The tables.
    edge : (n,) int
        The points of the edge in order.
    normal, offset : (3,), float
        The plane, normal . place = offset, m.

    Returns
    -------
    int
        1 left, -1 right; 0 where no point lies in the plane, or as many on either side.
    """
    rows = np.setdiff1d(state.live("rows"), edge)
    xyz = state.rows.xyz.data
    inside = rows[np.abs(dot(xyz[rows], normal) - offset) <= ROUNDING]
    along = np.diff(xyz[edge], axis=0)
    middle = xyz[edge[:-1]] + 0.5 * along
    away = xyz[inside][:, None] - middle
    nearest = np.argmin(dot(away, away), axis=1) if len(inside) else np.zeros(0, np.int64)
    left = np.cross(normal, along[nearest])
    sides = np.sign(dot(left, away[np.arange(len(inside)), nearest]))
    return int(np.sign(sides.sum()))
