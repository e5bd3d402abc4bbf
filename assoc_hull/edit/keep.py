"""Would a curve keep its shape with one more defining point on it?"""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.closest import closest
from assoc_hull.geometry.curves import CurveData, FloatArray, IntArray, PointKind, SplineBatch
from assoc_hull.geometry.spline import loft, sample
from assoc_hull.model.recipe import curve_data
from assoc_hull.model.state import HullState

__all__ = ["deviation", "deviation_with"]


def deviation(old: SplineBatch, new: SplineBatch) -> FloatArray:
    """Give the largest distance of each new curve from the old one, (m,), m."""
    start, places = sample(new, 6)
    return np.array(
        [closest(old, i, places[start[i] : start[i + 1]])[2].max() for i in range(new.count)]
    )


def deviation_with(
    state: HullState, curves: IntArray, at: FloatArray, xyz: FloatArray
) -> FloatArray:
    """Say how far each curve would move if it were also made through one point on it.

    Parameters
    ----------
    state : HullState
        The tables.
    curves : (m,) int
        Each curve once or more, one trial an entry.
    at : (m,), m
        Parameter of the point on the curve's spline.
    xyz : (m, 3), m
        The point.

    Returns
    -------
    (m,), m
        inf where the point would coincide with one that defines the curve already.
    """
    if not len(curves):
        return np.zeros(0)
    old = SplineBatch.join([state.spline(curve) for curve in curves.tolist()])
    data = curve_data(state, curves)
    where = np.array(
        [np.searchsorted(old.knot[a:b], t) for a, b, t in zip(old.start[:-1], old.start[1:], at, strict=True)]
    )
    near = np.array(
        [
            np.abs(old.xyz[a:b] - place).max(axis=1).min()
            for a, b, place in zip(old.start[:-1], old.start[1:], xyz, strict=True)
        ]
    )
    counts = np.diff(old.start)
    fits = (near > 1e-3) & (where > 0) & (where < counts)
    position = data.start[:-1] + np.clip(where, 1, counts - 1)
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
    return np.where(fits, deviation(old, trial), np.inf)
