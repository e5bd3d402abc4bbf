"""Would a curve keep its shape with one more defining point on it?"""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.closest import closest
from assoc_hull.geometry.curves import CurveData, FloatArray, IntArray, PointKind, SplineBatch
from assoc_hull.geometry.spline import loft, sample
from assoc_hull.model.recipe import curve_data
from assoc_hull.model.state import HullState

__all__ = ["deviation", "deviation_with"]

_COINCIDENT = 1e-3
"""A point nearer to a defining one than this part of the spacing adds nothing."""


def deviation(old: SplineBatch, new: SplineBatch) -> FloatArray:
    """Give the largest distance of each new curve from the old one, (m,), m."""
    start, places = sample(new, 6)
    return np.array(
        [closest(old, i, places[start[i] : start[i + 1]])[2].max() for i in range(new.count)]
    )


def deviation_with(
    state: HullState, curves: IntArray, xyz: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Say how far each curve would move if it were also made through one point on it.

    The curves are taken as their defining points make them now, which in the middle of a
    transaction may be more than the published splines hold.

    Parameters
    ----------
    state : HullState
        The tables.
    curves : (m,) int
        Each curve once or more, one trial an entry.
    xyz : (m, 3), m
        The point.

    Returns
    -------
    moved : (m,), m
        inf where the point would coincide with one that defines the curve already.
    room : (m,)
        Distance along the curve to the nearest defining point, as a part of the median
        spacing of the defining points.
    """
    if not len(curves):
        return np.zeros(0), np.zeros(0)
    data = curve_data(state, curves)
    old = loft(data)
    room, position = np.zeros(len(curves)), np.zeros(len(curves), np.int64)
    for i in range(len(curves)):
        knots = old.knot[old.start[i] : old.start[i + 1]]
        at = float(closest(old, i, xyz[i][None])[0][0])
        room[i] = float(np.abs(knots - at).min()) / float(np.median(np.diff(knots)))
        position[i] = old.start[i] + np.clip(np.searchsorted(knots, at), 1, len(knots) - 1)
    fits = room > _COINCIDENT
    safe = np.where(fits[:, None], xyz, 0.5 * (data.xyz[position - 1] + data.xyz[position]))
    trial = loft(
        CurveData(
            data.start + np.arange(len(data.start)),
            np.insert(data.xyz, position, safe, axis=0),
            np.insert(data.kind, position, PointKind.SMOOTH),
            np.insert(data.direction, position, 0.0, axis=0),
            data.end_kind.copy(),
            data.end_vector.copy(),
        )
    )
    return np.where(fits, deviation(old, trial), np.inf), room
