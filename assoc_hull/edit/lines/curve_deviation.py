"""How far a curve moves when one defining point comes or goes."""

from __future__ import annotations

import numpy as np

from assoc_hull.edit.crossings.adopted_points import insertion_index
from assoc_hull.geometry.curves import CurveData, FloatArray, IntArray, PointKind, SplineBatch
from assoc_hull.geometry.splines.distance import closest_points
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.segments import derivative, evaluate, sample, segment_start
from assoc_hull.model.network import curve_data
from assoc_hull.model.tables import HullState

__all__ = ["deviation", "deviation_with", "quick_deviation"]

_SAMPLES = 6
"""Places a segment at which two curves are compared."""

_NEWTON = 6
"""Steps to the foot of a point on a segment: it lies on the curve, so they converge fast."""

_COINCIDENT = 1e-3
"""A point nearer to a defining one than this part of the spacing adds nothing."""


def deviation(old: SplineBatch, new: SplineBatch) -> FloatArray:
    """Give the largest distance of each new curve from the old one, (m,), m."""
    start, places = sample(new, 6)
    return np.array(
        [closest_points(old, i, places[start[i] : start[i + 1]])[2].max() for i in range(new.count)]
    )


def quick_deviation(old: SplineBatch, new: SplineBatch, at: FloatArray) -> FloatArray:
    """Give the largest distance of each new curve from the old one, quickly.

    Parameters
    ----------
    old, new : SplineBatch
        As many curves each, through mostly the same points.
    at : (n,), m
        Parameter on the old curve of every knot of the new one.

    Returns
    -------
    (m,), m
        Between places of the same part of a segment, across the old curve: what is left
        out is of second order.
    """
    first = segment_start(new)
    curve = np.searchsorted(new.start, first, side="right") - 1
    part = (np.arange(_SAMPLES) + 0.5) / _SAMPLES
    many = np.repeat(curve, _SAMPLES)
    here = _between(new.knot, first, part)
    there = np.minimum(_between(at, first, part), old.knot[old.start[1:] - 1][many])
    step = evaluate(new, many, here) - evaluate(old, many, there)
    slope = derivative(old, many, there)
    along = (step * slope).sum(axis=1) / (slope * slope).sum(axis=1)
    across = step - along[:, None] * slope
    away = np.sqrt((across * across).sum(axis=1))
    return np.maximum.reduceat(away, np.searchsorted(many, np.arange(new.count)))


def _between(values: FloatArray, first: IntArray, part: FloatArray) -> FloatArray:
    low, high = values[first][:, None], values[first + 1][:, None]
    found: FloatArray = (low + (high - low) * part[None, :]).ravel()
    return found


def _feet(batch: SplineBatch, xyz: FloatArray) -> FloatArray:
    """Give the parameter of the foot of one point on each curve, by Newton's method."""
    curve = np.arange(batch.count)
    low, high = np.zeros(batch.count), np.zeros(batch.count)
    for i in range(batch.count):
        part = slice(int(batch.start[i]), int(batch.start[i + 1]))
        index = insertion_index(batch.xyz[part], xyz[i])
        low[i], high[i] = batch.knot[part][index - 1 : index + 1]
    at = 0.5 * (low + high)
    for _ in range(_NEWTON):
        slope = derivative(batch, curve, at)
        step = ((xyz - evaluate(batch, curve, at)) * slope).sum(axis=1)
        at = np.clip(at + step / (slope * slope).sum(axis=1), low, high)
    return at


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
    at = _feet(old, xyz)
    room, position = np.zeros(len(curves)), np.zeros(len(curves), np.int64)
    for i in range(len(curves)):
        knots = old.knot[old.start[i] : old.start[i + 1]]
        room[i] = float(np.abs(knots - at[i]).min()) / float(np.median(np.diff(knots)))
        position[i] = old.start[i] + np.clip(np.searchsorted(knots, at[i]), 1, len(knots) - 1)
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
    moved = quick_deviation(old, trial, np.insert(old.knot, position, at))
    return np.where(fits, moved, np.inf), room
