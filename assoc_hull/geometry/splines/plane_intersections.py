"""Where curves meet families of parallel planes: all meetings, their signs in alternation.

One sign is decided at every knot and shared by both its segments, so a meeting at a knot is
found once and signs alternate along a curve whatever rounding does. Between knots a cubic
is cut where its height is stationary; each part is monotone and meets a plane just where
the signs at its two ends differ. How many planes lie below each end is one sorted search:
the cost grows with segments plus meetings, not with segments times planes.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.splines.plane_intersections import meet_planes
>>> from assoc_hull.geometry.curves import CurveData
>>> from assoc_hull.geometry.splines.loft import loft
>>> line = loft(CurveData.single(np.array([[0.0, 0, 0], [0, 0, 4]])))
>>> meet_planes(line, np.array([0.0, 0.0, 1.0]), np.array([1.0, 2.0])).t
array([1., 2.])
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.geometry.numeric.roots import bracketed_roots
from assoc_hull.geometry.numeric.tridiagonal import slots_of
from assoc_hull.geometry.splines.backend import compiled
from assoc_hull.geometry.splines.bernstein import Heights, heights
from assoc_hull.geometry.splines.evaluation import positions
from assoc_hull.geometry.splines.monotone import (
    CONTACT,
    Parts,
    Roots,
    checked_planes,
    find_parts,
    nodes_of,
)

__all__ = ["Meetings", "meet_planes"]


@attrs.frozen(eq=False)
class Meetings:
    """Meetings of curves with planes, sorted by curve, plane and parameter.

    Attributes
    ----------
    curve, plane : (k,) int
        Which curve of the batch meets which plane of the family.
    segment : (k,) int
        Index of the knot where the segment starts that holds the meeting.
    t : (k,), m
        Chord-length parameter.
    xyz : (k, 3), m
        The points.
    sign : (k,) int8
        +1 where the curve rises through the plane along the normal, -1 where it falls,
        0 where it touches only.
    tangential : (k,) bool
        One of two neighbouring meetings between which the curve stays within 1e-9 m of
        the plane, or a touch.
    """

    curve: IntArray
    plane: IntArray
    segment: IntArray
    t: FloatArray
    xyz: FloatArray
    sign: NDArray[np.int8]
    tangential: NDArray[np.bool_]

    def __attrs_post_init__(self) -> None:
        freeze(self.curve, self.plane, self.segment, self.t, self.xyz, self.sign, self.tangential)

    @property
    def count(self) -> int:
        """Number of meetings."""
        return len(self.t)


def meet_planes(batch: SplineBatch, normal: FloatArray, offsets: FloatArray) -> Meetings:
    """Find all meetings of every curve with every plane ``normal . P = offset``.

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
        Sorted by curve, plane and parameter. For a normal along a coordinate axis that
        coordinate of a point is exactly the offset.

    Raises
    ------
    BadInputError
        If the normal is not a unit vector or the offsets descend anywhere.

    Notes
    -----
    A knot on a plane counts as above it: touching from above is no meeting (see
    `contact.touches`), touching from below are two. A segment that lies in a plane within
    1e-9 m holds no meeting inside; its knots count as on the plane.

    Examples
    --------
    >>> from assoc_hull.geometry.splines.loft import loft
    >>> from assoc_hull.geometry.curves import CurveData
    >>> line = loft(CurveData.single(np.array([[0.0, 0, 0], [0, 0, 4]])))
    >>> meet_planes(line, np.array([0.0, 0.0, 1.0]), np.array([3.0])).xyz
    array([[0., 0., 3.]])
    """
    normal, offsets = checked_planes(normal, offsets)
    kernels = compiled()
    find = _find if kernels is None else kernels.meet
    found = find(batch, normal, offsets)
    axis = _coordinate_axis(normal)
    if axis is not None:
        np.multiply(offsets.take(found.plane), normal[axis], out=found.points[axis])
    tangential = _tangential(batch, normal, found, offsets)
    return Meetings(
        found.curve, found.plane, found.segment, found.t, found.points.T, found.sign, tangential
    )


def _find(batch: SplineBatch, normal: FloatArray, offsets: FloatArray) -> Roots:
    """Find all meetings with numpy."""
    course = heights(batch, normal)
    parts = find_parts(batch, course, offsets)
    owner, plane = _expand(batch, parts, len(offsets))
    segment = parts.segment.take(owner)
    fraction = _fractions(course, parts, owner, offsets.take(plane))
    t = _parameters(batch, segment, fraction)
    curve = slots_of(batch.start).curve.take(segment)
    falls = parts.below_end < parts.below_begin
    sign = np.where(falls, np.int8(-1), np.int8(1)).take(owner)
    points = positions(batch, segment, fraction)
    return Roots(parts, owner, plane, segment, curve, sign, t, points, near=True)


def _coordinate_axis(normal: FloatArray) -> int | None:
    sizes = [abs(part) for part in normal.tolist()]
    return sizes.index(1.0) if sizes.count(0.0) == 2 and 1.0 in sizes else None


def _parameters(batch: SplineBatch, segment: IntArray, fraction: FloatArray) -> FloatArray:
    """Give chord-length parameters, exactly those of the knots at fractions 0 and 1."""
    begin, end = batch.knot.take(segment), batch.knot.take(segment + 1)
    result = (end - begin) * fraction
    result += begin
    np.copyto(result, end, where=fraction == 1.0)
    return np.minimum(result, end, out=result)


def _expand(batch: SplineBatch, parts: Parts, planes: int) -> tuple[IntArray, IntArray]:
    """Give part and plane of every meeting, sorted by curve, plane and parameter."""
    least = np.minimum(parts.below_begin, parts.below_end)
    count = np.abs(parts.below_end - parts.below_begin)
    before = np.cumsum(count)
    total = int(before[-1]) if len(before) else 0
    owner = np.repeat(np.arange(len(count)), count)
    before -= count
    plane = np.arange(total) + (least - before).take(owner)
    # One key per meeting, no two alike: any sorting rule gives the same order.
    width = 3 * len(batch.knot)
    base = slots_of(batch.start).curve.take(parts.segment) * (planes * width) + parts.order
    order = np.argsort(plane * width + base.take(owner))
    return owner.take(order), plane.take(order)


def _fractions(course: Heights, parts: Parts, owner: IntArray, offset: FloatArray) -> FloatArray:
    """Find where in its segment each meeting lies."""
    falling = (parts.below_end < parts.below_begin).take(owner)
    cubic = np.empty((4, len(owner)))
    for row, power in zip(cubic, course.powers(parts.segment), strict=True):
        power.take(owner, out=row, mode="clip")
    cubic[0] -= offset
    at_lower = parts.begin.take(owner) - offset
    at_upper = parts.end.take(owner) - offset
    # A knot of a segment that lies in the plane counts as on it, whichever side it is on.
    at_lower[(at_lower < 0.0) & falling] = 0.0
    at_upper[(at_upper < 0.0) & ~falling] = 0.0
    lower, upper = parts.lower.take(owner), parts.upper.take(owner)
    return bracketed_roots(cubic, lower, upper, at_lower, at_upper)


def _tangential(
    batch: SplineBatch, normal: FloatArray, found: Roots, offsets: FloatArray
) -> NDArray[np.bool_]:
    """Mark neighbouring meetings between which the curve hardly leaves the plane."""
    parts, owner, curve, plane = found.parts, found.owner, found.curve, found.plane
    result = np.zeros(len(owner), np.bool_)
    if not found.near:
        return result
    same = plane[1:] == plane[:-1]
    same &= curve[1:] == curve[:-1]
    pairs = same.nonzero()[0]
    if not len(pairs):
        return result
    near = np.abs(parts.end.take(owner[pairs]) - offsets.take(plane[pairs])) < CONTACT
    if not near.any():
        return result
    course = heights(batch, normal)
    for pair in pairs[near].tolist():
        if _excursion(course, parts, owner[pair : pair + 2], offsets[plane[pair]]) < CONTACT:
            result[pair : pair + 2] = True
    return result


def _excursion(course: Heights, parts: Parts, pair: IntArray, offset: float) -> float:
    """Give the largest distance from the plane between two meetings; such pairs are rare."""
    one, other = pair
    segment = np.arange(parts.segment[one], parts.segment[other] + 1)
    _, height = nodes_of(course, segment)
    order = 3 * segment + np.arange(4)[:, None]
    after = 3 * segment[0] + 3 if parts.upper[one] == 1.0 else parts.order[one] + 1
    between = (order >= after) & (order <= parts.order[other])
    return float(np.abs(height[between] - offset).max())
