"""Gaps at watched crossings: how far two curves pass each other, along the hull's normal.

A crossing that defines neither of its curves has no value of its own: each curve passes
the other's plane at a place of its own. Along the free axis a distance between the two
places means nothing; along the normal it is the gap a builder would see.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.splines.segments import derivative
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.tables import HullState

__all__ = [
    "along_normal",
    "crossing_normals",
    "gap_at",
    "numbered",
    "sides_held",
    "tangents",
    "tangents_of",
    "watched_on",
]


def watched_on(state: HullState, curves: IntArray) -> IntArray:
    """Give the watched crossings of curves, (k,) int, ascending."""
    if not len(curves):
        return np.zeros(0, np.int64)
    met = state.curves.meets.data
    rows = np.concatenate([met[curve].row for curve in curves.tolist()])
    table = state.rows
    # An intersection without a crossing, -1, reads some row and is then left out.
    watched = table.role.data.take(rows) == Role.WATCHED
    watched &= rows >= 0
    rows = np.sort(rows[watched])
    first = np.ones(len(rows), np.bool_)
    np.not_equal(rows[1:], rows[:-1], out=first[1:])
    rows = rows[first]
    found: IntArray = rows[(table.sort[rows] == Sort.CROSSING) & table.alive[rows]]
    return found


def tangents(
    state: HullState,
    curves: IntArray,
    parameters: FloatArray,
    guess: np.typing.NDArray[np.integer] | None = None,
) -> FloatArray:
    """Give unit tangents of curves at chord parameters, (k, 3).

    `guess` may say in which segment of its curve each parameter is thought to lie.
    """
    if not len(curves):
        return np.zeros((0, 3))
    numbers, local = numbered(curves)
    return _tangents([state.spline(curve) for curve in numbers], local, parameters, guess)


def tangents_of(
    spline: Mapping[int, SplineBatch], curves: IntArray, parameters: FloatArray
) -> FloatArray:
    """Give unit tangents of curves at chord parameters, (k, 3), of splines by number of curve."""
    if not len(curves):
        return np.zeros((0, 3))
    numbers, local = numbered(curves)
    return _tangents([spline[curve] for curve in numbers], local, parameters, None)


def _tangents(
    splines: Sequence[SplineBatch],
    local: IntArray,
    parameters: FloatArray,
    guess: np.typing.NDArray[np.integer] | None,
) -> FloatArray:
    batch = SplineBatch.join(splines)
    slope = derivative(batch, local, parameters, guess=guess)
    found: FloatArray = (slope.T / _length(slope)).T
    return found


def numbered(items: IntArray) -> tuple[list[int], IntArray]:
    """Give the items that occur, ascending, and for each item its place among these."""
    lowest = int(items.min())
    offset = items - lowest
    occurs = np.zeros(int(offset.max()) + 1, np.bool_)
    occurs[offset] = True
    place = np.cumsum(occurs) - 1
    return (np.flatnonzero(occurs) + lowest).tolist(), place.take(offset)


def _length(vectors: FloatArray) -> FloatArray:
    x, y, z = vectors[:, 0], vectors[:, 1], vectors[:, 2]
    found: FloatArray = np.sqrt(x * x + y * y + z * z)
    return found


def crossing_normals(first: FloatArray, second: FloatArray) -> FloatArray:
    """Give unit normals of the hull, (k, 3), from the unit tangents of two curves.

    The sense is arbitrary; zero where the tangents are parallel.
    """
    normal = np.empty((3, len(first)))
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        np.multiply(first[:, j], second[:, k], out=normal[i])
        normal[i] -= first[:, k] * second[:, j]
    length = _length(normal.T)
    parallel = ~(length > 1e-12)
    length[parallel] = 1.0
    normal /= length
    normal[:, parallel] = 0.0
    return normal.T


def sides_held(
    curve: IntArray, parameter: FloatArray, spline: Mapping[int, SplineBatch]
) -> np.typing.NDArray[np.bool_]:
    """Tell on which of their two curves points have a place, (k, 2): these have a shape there."""
    known = [each in spline for each in curve.ravel().tolist()]
    held: np.typing.NDArray[np.bool_] = np.isfinite(parameter)
    held &= np.array(known, np.bool_).reshape(-1, 2)
    return held


def along_normal(
    curve: IntArray,
    parameter: FloatArray,
    held: np.typing.NDArray[np.bool_],
    spline: Mapping[int, SplineBatch],
    away: FloatArray,
) -> FloatArray:
    """Give how far movements (k, 3), m, of points lead along the normal of the hull, (k,), m.

    That is the normal of their two curves. Of a point on one curve, or where two are tangent, it
    is what leads across the curve; nan for a point whose curves are not there.

    Parameters
    ----------
    curve, parameter : (k, 2) int, (k, 2) m
        The curves of the points, and where on them.
    held : (k, 2) bool
        Whether a point has a place on a curve, as `sides_held` gives it.
    spline : mapping of int to SplineBatch
        The curves.
    away : (k, 3), m
        The movements.
    """
    found, tangent = np.full(len(curve), np.nan), np.zeros((len(curve), 2, 3))
    one, two = np.nonzero(held)
    tangent[one, two] = tangents_of(spline, curve[one, two], parameter[one, two])
    normal = crossing_normals(tangent[:, 0], tangent[:, 1])
    crossing = held.all(axis=1) & (normal != 0.0).any(axis=1)
    found[crossing] = np.abs((away[crossing] * normal[crossing]).sum(axis=1))
    alone = held.any(axis=1) & ~crossing
    along = tangent[alone, np.argmax(held[alone], axis=1)]
    across = away[alone] - (away[alone] * along).sum(axis=1)[:, None] * along
    found[alone] = np.sqrt((across * across).sum(axis=1))
    return found


def gap_at(
    state: HullState, rows: IntArray, guess: np.typing.NDArray[np.integer] | None = None
) -> FloatArray:
    """Measure the gap at crossings from their places on the two curves, (k,), m.

    `guess`, (rows of the table, 2) int, may say in which segments of its two curves each
    crossing is thought to lie.
    """
    table = state.rows
    curve, at = table.curve.data.take(rows, axis=0), table.parameter.data.take(rows, axis=0)
    thought = None if guess is None else guess.take(rows, axis=0).T.ravel()
    both = tangents(state, curve.T.ravel(), at.T.ravel(), thought)
    normal = crossing_normals(both[: len(rows)], both[len(rows) :])
    # Coordinate by coordinate: long rows are worked on several times as fast as short ones.
    spot = np.ascontiguousarray(table.spot.data.reshape(-1, 6).take(rows, axis=0).T)
    product = (spot[:3] - spot[3:]) * normal.T
    gap: FloatArray = np.abs(product[0] + product[1] + product[2])
    return gap
