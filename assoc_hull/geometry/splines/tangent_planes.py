"""Where curves touch planes without crossing them, and where they lie in them.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.splines.tangent_planes import lies_in
>>> from assoc_hull.geometry.curves import CurveData
>>> from assoc_hull.geometry.splines.loft import loft
>>> line = loft(CurveData.single(np.array([[0.0, 0, 2], [3, 0, 2]])))
>>> lies_in(line, np.array([0.0, 0.0, 1.0]), 2.0)
(array([0]), array([0.]), array([3.]))
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.geometry.numeric.tridiagonal import slots_of
from assoc_hull.geometry.splines.bernstein import Heights, heights
from assoc_hull.geometry.splines.evaluation import positions
from assoc_hull.geometry.splines.monotone import (
    CONTACT,
    checked_planes,
    nodes_of,
    planes_containing,
)
from assoc_hull.geometry.splines.plane_intersections import Meetings
from assoc_hull.geometry.splines.segments import segment_start

__all__ = ["lies_in", "touches"]


def lies_in(
    batch: SplineBatch, normal: FloatArray, offset: float
) -> tuple[IntArray, FloatArray, FloatArray]:
    """Find the stretches of curves that lie in a plane within 1e-9 m.

    Parameters
    ----------
    batch : SplineBatch
        The curves.
    normal : (3,)
        Unit normal of the plane.
    offset : float, m
        Offset of the plane.

    Returns
    -------
    curve : (k,) int
        Index of the curve.
    begin, end : (k,), m
        Chord-length parameters between which it lies in the plane: whole segments, joined
        where they follow one another. All frozen.

    Raises
    ------
    BadInputError
        If the normal is not a unit vector.

    Examples
    --------
    >>> from assoc_hull.geometry.splines.loft import loft
    >>> from assoc_hull.geometry.curves import CurveData
    >>> line = loft(CurveData.single(np.array([[0.0, 0, 2], [3, 0, 2]])))
    >>> lies_in(line, np.array([0.0, 0.0, 1.0]), 1.0)[0]
    array([], dtype=int64)
    """
    normal, offsets = checked_planes(normal, np.array([offset]))
    segment = segment_start(batch)
    first, behind = planes_containing(heights(batch, normal), offsets, segment)
    lying = segment[first < behind]
    curve = slots_of(batch.start).curve[lying]
    # Segments of two curves never follow one another: the last knot of a curve starts none.
    joined = lying[1:] == lying[:-1] + 1
    opens, closes = np.append(True, ~joined), np.append(~joined, True)
    if not len(lying):
        opens = closes = np.zeros(0, np.bool_)
    result = curve[opens], batch.knot[lying[opens]], batch.knot[lying[closes] + 1]
    freeze(*result)
    return result


def touches(batch: SplineBatch, normal: FloatArray, offsets: FloatArray) -> Meetings:
    """Find where curves come within 1e-9 m of planes and turn back on the same side.

    Parameters
    ----------
    batch : SplineBatch
        The curves.
    normal : (3,)
        Unit normal of all planes.
    offsets : (p,), m
        Offsets of the planes, ascending.

    Returns
    -------
    Meetings
        Places where the height over the plane is stationary, and knots (the ends of a
        curve among them), all of sign 0; sorted by curve, plane and parameter. The points
        are those of the curve, not moved into the plane. Where a curve lies in a plane it
        does not touch it.

    Raises
    ------
    BadInputError
        If the normal is not a unit vector or the offsets descend anywhere.

    Examples
    --------
    >>> from assoc_hull.geometry.splines.loft import loft
    >>> from assoc_hull.geometry.curves import CurveData
    >>> line = loft(CurveData.single(np.array([[0.0, 0, 2], [0, 0, 3]])))
    >>> touches(line, np.array([0.0, 0.0, 1.0]), np.array([2.0])).t
    array([0.])
    """
    normal, offsets = checked_planes(normal, offsets)
    course = heights(batch, normal)
    segment, fraction, height, curve = _nodes(batch, course)
    low = np.searchsorted(offsets, height - CONTACT, side="right")
    count = np.maximum(np.searchsorted(offsets, height + CONTACT, side="left") - low, 0)
    node = np.repeat(np.arange(len(height)), count)
    plane = np.arange(len(node)) + np.repeat(low - (np.cumsum(count) - count), count)
    turns = _turns_back(height, curve, node, offsets[plane])
    turns &= ~_lying_at(batch, course, offsets, segment[node], fraction[node], plane)
    node, plane = node[turns], plane[turns]
    order = np.lexsort((node, plane, curve[node]))
    return _as_meetings(batch, segment, fraction, curve, node[order], plane[order])


def _nodes(
    batch: SplineBatch, course: Heights
) -> tuple[IntArray, FloatArray, FloatArray, IntArray]:
    """Give all knots and stationary places in order: segment, fraction, height, curve."""
    segment = segment_start(batch)
    fraction, height = nodes_of(course, segment)
    slots = slots_of(batch.start)
    keep = np.ones(fraction.shape, np.bool_)
    keep[1] = fraction[1] > 0.0
    keep[2] = fraction[2] < 1.0
    keep[3] = slots.is_last[segment + 1]
    chosen = keep.T
    owner = np.broadcast_to(segment[:, None], chosen.shape)[chosen]
    return owner, fraction.T[chosen], height.T[chosen], slots.curve[owner]


def _turns_back(
    height: FloatArray, curve: IntArray, node: IntArray, offset: FloatArray
) -> NDArray[np.bool_]:
    """Say whether both neighbours of a node lie farther from the plane, on its own side."""
    result = np.ones(len(node), np.bool_)
    here = height[node] - offset
    for step in (-1, 1):
        other = np.clip(node + step, 0, len(height) - 1)
        there = height[other] - offset
        # Of two equally near neighbours the later one is taken.
        farther = (np.abs(there) > np.abs(here)) | ((step < 0) & (np.abs(there) == np.abs(here)))
        alone = (other == node) | (curve[other] != curve[node])
        result &= alone | (farther & ((there >= 0.0) == (here >= 0.0)))
    return result


def _lying_at(
    batch: SplineBatch,
    course: Heights,
    offsets: FloatArray,
    segment: IntArray,
    fraction: FloatArray,
    plane: IntArray,
) -> NDArray[np.bool_]:
    """Say whether a segment that holds or ends at a node lies in the plane."""
    is_first = slots_of(batch.start).is_first
    before = np.where((fraction == 0.0) & ~is_first[segment], segment - 1, segment)
    result = np.zeros(len(segment), np.bool_)
    for one in (before, segment):
        first, behind = planes_containing(course, offsets, one)
        result |= (first <= plane) & (plane < behind)
    return result


def _as_meetings(
    batch: SplineBatch,
    segment: IntArray,
    fraction: FloatArray,
    curve: IntArray,
    node: IntArray,
    plane: IntArray,
) -> Meetings:
    where, part = segment[node], fraction[node]
    begin, end = batch.knot[where], batch.knot[where + 1]
    t = np.where(part == 1.0, end, begin + (end - begin) * part)
    xyz = positions(batch, where, part).T
    count = len(node)
    sign, tangential = np.zeros(count, np.int8), np.ones(count, np.bool_)
    return Meetings(curve[node], plane, where, t, xyz, sign, tangential)
