"""Gaps at watched crossings: how far two curves pass each other, along the hull's normal.

A crossing that defines neither of its curves has no value of its own: each curve passes
the other's plane at a place of its own. Along the free axis a distance between the two
places means nothing; along the normal it is the gap a builder would see.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.spline import derivative
from assoc_hull.model.family import Role, Sort
from assoc_hull.model.state import HullState

__all__ = ["crossing_normals", "gap_at", "tangents", "watched_on"]


def watched_on(state: HullState, curves: IntArray) -> IntArray:
    """Give the watched crossings of curves, (k,) int, ascending."""
    met = [state.curves.meets.data[curve].row for curve in curves.tolist()]
    rows = np.unique(np.concatenate([*met, np.zeros(0, np.int64)]))
    rows = rows[rows >= 0]
    table = state.rows
    return rows[
        (table.role.data[rows] == Role.WATCHED)
        & (table.sort.data[rows] == Sort.CROSSING)
        & table.alive.data[rows]
    ]


def tangents(state: HullState, curves: IntArray, parameters: FloatArray) -> FloatArray:
    """Give unit tangents of curves at chord parameters, (k, 3)."""
    if not len(curves):
        return np.zeros((0, 3))
    numbers, local = np.unique(curves, return_inverse=True)
    batch = SplineBatch.join([state.spline(curve) for curve in numbers.tolist()])
    slope = derivative(batch, local.astype(np.int64), parameters)
    return slope / _length(slope)[:, None]


def _length(vectors: FloatArray) -> FloatArray:
    x, y, z = vectors[:, 0], vectors[:, 1], vectors[:, 2]
    found: FloatArray = np.sqrt(x * x + y * y + z * z)
    return found


def crossing_normals(first: FloatArray, second: FloatArray) -> FloatArray:
    """Give unit normals of the hull, (k, 3), from the unit tangents of two curves.

    The sense is arbitrary; nil where the tangents are parallel.
    """
    normal = np.cross(first, second)
    length = _length(normal)
    safe = np.where(length > 1e-12, length, 1.0)
    return np.where(length[:, None] > 1e-12, normal / safe[:, None], 0.0)


def gap_at(state: HullState, rows: IntArray) -> FloatArray:
    """Measure the gap at crossings from their places on the two curves, (k,), m."""
    table = state.rows
    curve, at = table.curve.data[rows], table.parameter.data[rows]
    both = tangents(
        state, np.concatenate([curve[:, 0], curve[:, 1]]), np.concatenate([at[:, 0], at[:, 1]])
    )
    normal = crossing_normals(both[: len(rows)], both[len(rows) :])
    offset = table.spot.data[rows, 0] - table.spot.data[rows, 1]
    product = offset * normal
    gap: FloatArray = np.abs(product[:, 0] + product[:, 1] + product[:, 2])
    return gap
