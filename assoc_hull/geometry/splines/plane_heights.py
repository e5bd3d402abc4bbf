"""Heights of curves over a family of parallel planes, and the parts on which a height is monotone.

Along a segment the height is a cubic. Its four Bernstein coefficients enclose its range, and if
their three differences have one sign, it is monotone; else it is cut where it is stationary. A
monotone part intersects a plane just where the signs at its two ends differ. The cuts do not
depend on the planes that are asked for. `plane_intersections` and the compiled kernels build on
these parts, so both see the same ones.
"""

from __future__ import annotations

from math import isfinite

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.numeric.polynomials import cubic_values, stationary_fractions
from assoc_hull.geometry.numeric.tridiagonal import slots_of
from assoc_hull.geometry.plane import unit_normal

__all__ = [
    "CONTACT",
    "MonotoneParts",
    "PlaneHeights",
    "PlaneRoots",
    "checked_planes",
    "find_monotone_parts",
    "heights_over_plane",
    "nodes_of",
    "planes_containing",
]


@attrs.frozen(eq=False)
class PlaneHeights:
    """Height of a batch of splines over a plane through the origin.

    Segment i runs from knot i to knot i + 1; those that run from one curve to the next are
    there but mean nothing.

    Attributes
    ----------
    knot : (n,), m
        Height at each knot.
    rise : (n - 1,), m
        Height gained over each segment.
    first, last : (n - 1,), m
        Derivative with respect to the fraction of the segment, at its start and its end.
    """

    knot: FloatArray
    rise: FloatArray
    first: FloatArray
    last: FloatArray

    def powers(self, segment: IntArray) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """Give the coefficients of 1, u, u**2, u**3 of segments (k,), each (k,), m.

        Examples
        --------
        >>> one = np.array([1.0])
        >>> PlaneHeights(np.array([0.0, 1.0]), one, one, one).powers(np.array([0]))[1]
        array([1.])
        """
        first = self.first.take(segment)
        rise = self.rise.take(segment)
        both = first + self.last.take(segment)
        return self.knot.take(segment), first, (3.0 * rise - first) - both, both - 2.0 * rise


def heights_over_plane(batch: SplineBatch, normal: FloatArray) -> PlaneHeights:
    """Give the height of curves over the plane through the origin with a unit normal (3,).

    Examples
    --------
    >>> from assoc_hull.geometry.splines.loft import loft
    >>> from assoc_hull.geometry.curves import CurveData
    >>> line = loft(CurveData.single(np.array([[0.0, 0, 1], [0, 3, 1]])))
    >>> heights_over_plane(line, np.array([0.0, 0.0, 1.0])).knot
    array([1., 1.])
    """
    length = batch.knot[1:] - batch.knot[:-1]
    knot = _along(batch.xyz, normal)
    first = _along(batch.leave, normal)[:-1] * length
    last = _along(batch.arrive, normal)[1:] * length
    return PlaneHeights(knot, knot[1:] - knot[:-1], first, last)


def _along(vectors: FloatArray, normal: FloatArray) -> FloatArray:
    """Give the component of vectors along the normal, in one fixed order of operations."""
    parts = normal.tolist()
    if parts.count(0.0) == 2 and 1.0 in parts:
        return np.ascontiguousarray(vectors[:, parts.index(1.0)])
    result: FloatArray = vectors[:, 0] * normal[0]
    result += vectors[:, 1] * normal[1]
    result += vectors[:, 2] * normal[2]
    return result


# --------------------------------------------------------------------------------------
# Monotone parts.

CONTACT = 1e-9
"""Closer than this (m) a curve touches a plane, or lies in it."""


@attrs.frozen(eq=False)
class MonotoneParts:
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
class PlaneRoots:
    """All intersections of curves with planes, sorted by curve, plane and parameter.

    Attributes
    ----------
    parts : MonotoneParts
        Monotone parts of segments.
    owner, plane : (k,) int
        The part and the plane of each intersection.
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

    parts: MonotoneParts
    owner: IntArray
    plane: IntArray
    segment: IntArray
    curve: IntArray
    sign: NDArray[np.int8]
    t: FloatArray
    points: FloatArray
    near: bool


def checked_planes(normal: FloatArray, offsets: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Check the planes of a family: a unit normal (3,), and offsets (p,), m, that ascend.

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


def find_monotone_parts(
    batch: SplineBatch, course: PlaneHeights, offsets: FloatArray
) -> MonotoneParts:
    """Find the monotone parts of segments that pass planes with offsets (p,), m, ascending.

    Whole segments come first, then parts of segments; `order` has the place of each.

    Examples
    --------
    >>> from assoc_hull.geometry.splines.plane_heights import heights_over_plane
    >>> from assoc_hull.geometry.splines.loft import loft
    >>> from assoc_hull.geometry.curves import CurveData
    >>> line = loft(CurveData.single(np.array([[0.0, 0, 0], [0, 0, 4]])))
    >>> course = heights_over_plane(line, np.array([0.0, 0.0, 1.0]))
    >>> find_monotone_parts(line, course, np.array([1.0, 2.0])).below_end
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


def _bent_and_flat(batch: SplineBatch, course: PlaneHeights) -> tuple[IntArray, IntArray]:
    """Find the segments whose height may not be monotone, and the level ones."""
    # The three are differences of Bernstein coefficients, times 3.
    middle = 3.0 * course.rise
    middle -= course.first
    middle -= course.last
    most = np.maximum(np.maximum(course.first, course.last), middle)
    least = np.minimum(np.minimum(course.first, course.last), middle)
    between = slots_of(batch.start).last[:-1]
    # What runs from one curve to the next is neither bent nor level.
    most[between] = np.inf
    least[between] = 1.0
    bent = np.flatnonzero((least < 0.0) & (most > 0.0))
    flat = np.flatnonzero(most - least <= 12.0 * CONTACT)
    return bent, flat


def planes_containing(
    course: PlaneHeights, offsets: FloatArray, segment: IntArray
) -> tuple[IntArray, IntArray]:
    """Find the planes in which segments (k,) lie, within 1e-9 m: begin and end of a range for each.

    A range is empty where ``begin >= end``.

    Examples
    --------
    >>> nil = np.zeros(1)
    >>> level = PlaneHeights(np.zeros(2), nil, nil, nil)
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
    course: PlaneHeights, offsets: FloatArray, flat: IntArray, bent: IntArray, below: IntArray
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
    course: PlaneHeights, offsets: FloatArray, whole: IntArray, bent: IntArray, below: IntArray
) -> MonotoneParts:
    """Put whole segments and the parts of bent ones into one table."""
    fraction, height = nodes_of(course, bent)
    rank = np.searchsorted(offsets, height, side="right")
    rank[0], rank[3] = below[bent], below[bent + 1]
    crossed = np.nonzero(rank[1:] != rank[:-1])
    after = crossed[0] + 1, crossed[1]
    segment = bent[crossed[1]]
    whole_end = whole + 1
    return MonotoneParts(
        np.concatenate([whole, segment]),
        np.concatenate([3 * whole, 3 * segment + crossed[0]]),
        np.concatenate([np.zeros(len(whole)), fraction[crossed]]),
        np.concatenate([np.ones(len(whole)), fraction[after]]),
        np.concatenate([course.knot[whole], height[crossed]]),
        np.concatenate([course.knot[whole_end], height[after]]),
        np.concatenate([below[whole], rank[crossed]]),
        np.concatenate([below[whole_end], rank[after]]),
    )


def nodes_of(course: PlaneHeights, segment: IntArray) -> tuple[FloatArray, FloatArray]:
    """Give the ends and the stationary places of segments (k,): fractions and heights (m), (4, k).

    Fractions ascend from 0 to 1.

    Examples
    --------
    >>> one = np.ones(1)
    >>> nodes_of(PlaneHeights(np.array([0.0, 1.0]), one, one, one), np.array([0]))[0].ravel()
    array([0., 0., 1., 1.])
    """
    origin, first, second, third = course.powers(segment)
    lower, upper = stationary_fractions(first, second, third)
    fraction, height = np.zeros((4, len(segment))), np.empty((4, len(segment)))
    fraction[1], fraction[2], fraction[3] = lower, upper, 1.0
    height[0], height[3] = origin, course.knot[segment + 1]
    height[1] = cubic_values(origin, first, second, third, lower)
    height[2] = np.where(upper == 1.0, height[3], cubic_values(origin, first, second, third, upper))
    return fraction, height
