"""From tables to splines: what a batch of curves is made from, and the lofting of it."""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import CurveData, IntArray, SplineBatch
from assoc_hull.geometry.spline import loft
from assoc_hull.model.state import HullState

__all__ = ["curve_data", "loft_curves"]


def curve_data(state: HullState, curves: IntArray) -> CurveData:
    """Gather the defining points, kinds and end conditions of curves.

    Parameters
    ----------
    state : HullState
        The tables.
    curves : (m,) int
        Numbers of the curves.

    Returns
    -------
    CurveData
        The curves in the order given.
    """
    numbers = curves.tolist()
    parts = [state.curves.rows.data[curve] for curve in numbers]
    rows = np.concatenate(parts)
    side = np.concatenate([state.curves.side.data[curve] for curve in numbers])
    start = np.zeros(len(parts) + 1, np.int64)
    np.cumsum([len(part) for part in parts], out=start[1:])
    ends = [state.curves.ends.data[curve] for curve in numbers]
    return CurveData(
        start,
        state.rows.xyz.data[rows],
        state.rows.kind.data[rows, side],
        state.rows.direction.data[rows, side],
        np.array([end.kind for end in ends], np.int8),
        np.array([end.vector for end in ends], np.float64),
    )


def loft_curves(state: HullState, curves: IntArray) -> SplineBatch:
    """Loft curves from their defining points, in one batch.

    Raises
    ------
    TooFewPointsError, CoincidentPointsError, BadInputError
        Naming the curve.
    """
    names = [str(state.curves.key.data[curve]) for curve in curves.tolist()]
    return loft(curve_data(state, curves), names)
