"""Parts of curves whose height over a family of planes is monotone.

Between knots a cubic is cut where its height is stationary. In each part the height is
monotone, so the part meets a plane just where the signs at its two ends differ. The cuts
do not depend on the planes that are asked for.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.splines.bernstein import Heights
>>> from assoc_hull.geometry.splines.monotone import nodes_of
>>> hill = Heights(np.zeros(2), np.zeros(1), np.ones(1), -np.ones(1))
>>> nodes_of(hill, np.array([0]))[0].ravel()
array([0. , 0. , 0.5, 1. ])
"""

from __future__ import annotations

from math import isfinite

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.numeric.tridiagonal import slots_of
from assoc_hull.geometry.plane import unit_normal
from assoc_hull.geometry.splines.bernstein import Heights, stationary, value

__all__ = [
    "CONTACT",
    "Parts",
    "Roots",
    "checked_planes",
    "find_parts",
    "nodes_of",
    "planes_containing",
]

CONTACT = 1e-9
"""Closer than this (m) a curve touches a plane, or lies in it."""


@attrs.frozen(eq=False)
class Parts:
    """Parts of segments in which the height is monotone and passes at least one plane.

    Attributes
    ----------
    segment, order : (q,) int
        The segment, and the place of the part among all parts along the curves.
    lower, upper : (q,)
        Fractions of the segment where the part begins and ends.
    begin, end : (q,), m
        Height there.
    below_begin, below_end : (q,) int
        Number of planes not above these heights.
    """

    segment: IntArray
    order: IntArray
    lower: FloatArray
    upper: FloatArray
    begin: FloatArray
    end: FloatArray
    below_begin: IntArray
    below_end: IntArray


@attrs.frozen(eq=False)
class Roots:
    """All meetings of curves with planes, sorted by curve, plane and parameter.

    Attributes
    ----------
    parts : Parts
        Monotone parts of segments.
    owner, plane : (k,) int
        The part and the plane of each meeting.
    segment, curve : (k,) int
        Its segment and its curve.
    sign : (k,) int8
        +1 where the curve rises through the plane, -1 where it falls.
    t : (k,), m
        Its chord-length parameter.
    points : (3, k), m
        The point.
    near : bool
        Whether two neighbours may be one contact; False only if none are.
    """

    parts: Parts
    owner: IntArray
    plane: IntArray
    segment: IntArray
    curve: IntArray
    sign: NDArray[np.int8]
    t: FloatArray
    points: FloatArray
    near: bool


def checked_planes(normal: FloatArray, offsets: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Check the planes of a family.

    Parameters
    ----------
    normal : (3,)
        Unit normal.
    offsets : (p,), m
        Offsets, ascending.

    Returns
    -------
    normal, offsets : (3,) and (p,)
        The same numbers.

    Raises
    ------
    BadInputError
        If the normal is not a unit vector or the offsets do not ascend.

    Examples
    --------
    >>> checked_planes(np.array([0.0, 0.0, 1.0]), np.array([1.0, 2.0]))[1]
    array([1., 2.])
    """
    offsets = np.ascontiguousarray(offsets, np.float64)
    # Of numbers that ascend none is infinite or not a number but the first or the last.
    ascend = offsets.ndim == 1 and bool((offsets[1:] >= offsets[:-1]).all())
    if not ascend or not all(isfinite(end) for end in offsets[[0, -1][: len(offsets)]].tolist()):
        raise BadInputError(
            "the offsets do not ascend or are not finite",
            "in a family of planes",
            "give them sorted, in a flat array",
        )
    return unit_normal(normal), offsets


def find_parts(batch: SplineBatch, course: Heights, offsets: FloatArray) -> Parts:
    """Find the monotone parts of segments that pass planes.

    Parameters
    ----------
    batch : SplineBatch
        The curves.
    course : Heights
        Their height along the normal of the planes.
    offsets : (p,), m
        Offsets of the planes, ascending.

    Returns
    -------
    Parts
        Whole segments first, then parts of segments; `order` tells the place of each.

    Examples
    --------
    >>> from assoc_hull.geometry.splines.bernstein import heights
    >>> from assoc_hull.geometry.splines.loft import loft
    >>> from assoc_hull.geometry.curves import CurveData
    >>> line = loft(CurveData.single(np.array([[0.0, 0, 0], [0, 0, 4]])))
    >>> course = heights(line, np.array([0.0, 0.0, 1.0]))
    >>> find_parts(line, course, np.array([1.0, 2.0])).below_end
    array([2])
    """
    below = np.searchsorted(offsets, course.knot, side="right")
    bent, flat = _bent_and_flat(batch, course)
    if len(flat):
        bent = _count_flat(course, offsets, flat, bent, below)
    change = below[1:] != below[:-1]
    change[slots_of(batch.start).last[:-1]] = False
    change[bent] = False
    whole = np.flatnonzero(change)
    return _joined(course, offsets, whole, bent, below)


def _bent_and_flat(batch: SplineBatch, course: Heights) -> tuple[IntArray, IntArray]:
    """Find the segments whose height may not be monotone, and the level ones."""
    middle = 3.0 * course.rise
    middle -= course.first
    middle -= course.last
    most = np.maximum(np.maximum(course.first, course.last), middle)
    least = np.minimum(np.minimum(course.first, course.last), middle)
    between = slots_of(batch.start).last[:-1]
    most[between] = np.inf
    least[between] = 1.0
    bent = np.flatnonzero((least < 0.0) & (most > 0.0))
    flat = np.flatnonzero(most - least <= 12.0 * CONTACT)
    return bent, flat


def planes_containing(
    course: Heights, offsets: FloatArray, segment: IntArray
) -> tuple[IntArray, IntArray]:
    """Find the planes in which segments lie, within 1e-9 m.

    Parameters
    ----------
    course : Heights
        Height of the curves along the normal of the planes.
    offsets : (p,), m
        Offsets of the planes, ascending.
    segment : (k,) int
        The segments.

    Returns
    -------
    begin, end : (k,) int
        The range of planes; empty where ``begin >= end``.

    Examples
    --------
    >>> nil = np.zeros(1)
    >>> level = Heights(np.zeros(2), nil, nil, nil)
    >>> planes_containing(level, np.array([0.0, 1.0]), np.array([0]))
    (array([0]), array([1]))
    """
    begin, end = course.knot[segment], course.knot[segment + 1]
    inner = begin + course.first[segment] / 3.0, end - course.last[segment] / 3.0
    most = np.maximum(np.maximum(begin, end), np.maximum(*inner))
    least = np.minimum(np.minimum(begin, end), np.minimum(*inner))
    return (
        np.searchsorted(offsets, most - CONTACT, side="left"),
        np.searchsorted(offsets, least + CONTACT, side="right"),
    )


def _count_flat(
    course: Heights, offsets: FloatArray, flat: IntArray, bent: IntArray, below: IntArray
) -> IntArray:
    """Let the knots of segments that lie in a plane count as on it; such do not bend."""
    begin, end = planes_containing(course, offsets, flat)
    lying = flat[begin < end]
    planes = end[begin < end]
    below[lying] = np.maximum(below[lying], planes)
    below[lying + 1] = np.maximum(below[lying + 1], planes)
    result: IntArray = np.setdiff1d(bent, lying, assume_unique=True)
    return result


def _joined(
    course: Heights, offsets: FloatArray, whole: IntArray, bent: IntArray, below: IntArray
) -> Parts:
    """Put whole segments and the parts of bent ones into one table."""
    fraction, height = nodes_of(course, bent)
    rank = np.searchsorted(offsets, height, side="right")
    rank[0], rank[3] = below[bent], below[bent + 1]
    crossed = np.nonzero(rank[1:] != rank[:-1])
    after = crossed[0] + 1, crossed[1]
    segment = bent[crossed[1]]
    whole_end = whole + 1
    return Parts(
        np.concatenate([whole, segment]),
        np.concatenate([3 * whole, 3 * segment + crossed[0]]),
        np.concatenate([np.zeros(len(whole)), fraction[crossed]]),
        np.concatenate([np.ones(len(whole)), fraction[after]]),
        np.concatenate([course.knot[whole], height[crossed]]),
        np.concatenate([course.knot[whole_end], height[after]]),
        np.concatenate([below[whole], rank[crossed]]),
        np.concatenate([below[whole_end], rank[after]]),
    )


def nodes_of(course: Heights, segment: IntArray) -> tuple[FloatArray, FloatArray]:
    """Give the ends and the stationary places of segments.

    Parameters
    ----------
    course : Heights
        Height of the curves.
    segment : (k,) int
        The segments.

    Returns
    -------
    fraction, height : (4, k)
        Ascending fractions from 0 to 1, and the height (m) there.

    Examples
    --------
    >>> one = np.ones(1)
    >>> nodes_of(Heights(np.array([0.0, 1.0]), one, one, one), np.array([0]))[0].ravel()
    array([0., 0., 1., 1.])
    """
    origin, first, second, third = course.powers(segment)
    lower, upper = stationary(first, second, third)
    fraction, height = np.zeros((4, len(segment))), np.empty((4, len(segment)))
    fraction[1], fraction[2], fraction[3] = lower, upper, 1.0
    height[0], height[3] = origin, course.knot[segment + 1]
    height[1] = value(origin, first, second, third, lower)
    height[2] = np.where(upper == 1.0, height[3], value(origin, first, second, third, upper))
    return fraction, height
