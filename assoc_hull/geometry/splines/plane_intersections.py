"""Intersections of curves with planes.

`intersect_planes` finds where curves pass planes of one family, with alternating signs along each
curve. `points_on_plane`, `points_at_coordinate` and `coordinate_turns` are the simple questions
for measures of a form: they take curve ends in, too. A plane is a unit normal and an offset,
``normal . P = offset``, m.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.splines.plane_intersections import intersect_planes
>>> from assoc_hull.geometry.curves import CurveData
>>> from assoc_hull.geometry.splines.loft import loft
>>> line = loft(CurveData.single(np.array([[0.0, 0, 1], [3, 0, 2]])))
>>> intersect_planes(line, np.array([0.0, 0.0, 1.0]), np.array([1.5])).xyz.tolist()
[[1.5, 0.0, 1.5]]
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.geometry.numeric.polynomials import (
    bracketed_roots,
    differentiate,
    horner,
    unit_roots,
)
from assoc_hull.geometry.numeric.tridiagonal import slots_of
from assoc_hull.geometry.splines.backend import compiled
from assoc_hull.geometry.splines.plane_heights import (
    CONTACT,
    MonotoneParts,
    PlaneHeights,
    PlaneRoots,
    checked_planes,
    find_monotone_parts,
    heights_over_plane,
    nodes_of,
)
from assoc_hull.geometry.splines.segments import (
    derivative,
    positions,
    power_coefficients,
    segment_curve,
)

__all__ = [
    "PlaneIntersections",
    "PointsOnCurves",
    "coordinate_turns",
    "intersect_planes",
    "on_plane",
    "points_at_coordinate",
    "points_on_plane",
]

# --------------------------------------------------------------------------------------
# All intersections with a family of parallel planes.
#
# One sign is decided at every knot and shared by both its segments, so an intersection at a knot is
# found once and signs alternate along a curve whatever rounding does. How many planes lie below
# each end of a monotone part is one sorted search: the cost grows with segments plus intersections.


@attrs.frozen(eq=False)
class PlaneIntersections:
    """Intersections of curves with planes, sorted by curve, plane and parameter.

    Attributes
    ----------
    curve, plane : (k,) int
        Which curve of the batch intersects which plane of the family.
    segment : (k,) int
        Index of the knot where the segment starts that holds the intersection.
    t : (k,), m
        Chord-length parameter.
    xyz : (k, 3), m
        The points.
    sign : (k,) int8
        +1 where the curve rises through the plane along the normal, -1 where it falls,
        0 where it touches only.
    tangential : (k,) bool
        One of two neighbouring intersections between which the curve stays within 1e-9 m of
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
        """Number of intersections."""
        return len(self.t)


def intersect_planes(
    batch: SplineBatch,
    normal: FloatArray,
    offsets: FloatArray,
    factor: float = 1.0,
    tell_tangential: bool = True,
) -> PlaneIntersections:
    """Find all intersections of every curve with every plane ``normal . P = offset``.

    Parameters
    ----------
    batch : SplineBatch
        The curves.
    normal : (3,)
        Unit normal of all planes.
    offsets : (p,), m
        Offsets of the planes, ascending.
    factor : float
        Of lengths, by the size of the hull: how near a root is found to its plane.
    tell_tangential : bool
        Whether to look for tangential intersections; none is marked otherwise.

    Returns
    -------
    PlaneIntersections
        Sorted by curve, plane and parameter. For a normal along a coordinate axis that
        coordinate of a point is exactly the offset.

    Raises
    ------
    BadInputError
        If the normal is not a unit vector or the offsets descend anywhere.

    Notes
    -----
    A knot on a plane counts as above it: touching from above is no intersection,
    touching from below are two. A segment that lies in a plane within 1e-9 m
    holds no intersection inside; its knots count as on the plane.

    Examples
    --------
    >>> from assoc_hull.geometry.splines.loft import loft
    >>> from assoc_hull.geometry.curves import CurveData
    >>> line = loft(CurveData.single(np.array([[0.0, 0, 0], [0, 0, 4]])))
    >>> intersect_planes(line, np.array([0.0, 0.0, 1.0]), np.array([3.0])).xyz
    array([[0., 0., 3.]])
    """
    normal, offsets = checked_planes(normal, offsets)
    kernels = compiled()
    find = _find if kernels is None else kernels.meet
    found = find(batch, normal, offsets, factor)
    axis = _coordinate_axis(normal)
    if axis is not None:
        np.multiply(offsets.take(found.plane), normal[axis], out=found.points[axis])
    if tell_tangential:
        tangential = _tangential(batch, normal, found, offsets)
    else:
        tangential = np.zeros(len(found.owner), np.bool_)
    return PlaneIntersections(
        found.curve, found.plane, found.segment, found.t, found.points.T, found.sign, tangential
    )


def _find(batch: SplineBatch, normal: FloatArray, offsets: FloatArray, factor: float) -> PlaneRoots:
    """Find all intersections with numpy."""
    course = heights_over_plane(batch, normal)
    parts = find_monotone_parts(batch, course, offsets)
    owner, plane = _expand(batch, parts, len(offsets))
    segment = parts.segment.take(owner)
    fraction = _fractions(course, parts, owner, offsets.take(plane), factor)
    t = _parameters(batch, segment, fraction)
    curve = slots_of(batch.start).curve.take(segment)
    falls = parts.below_end < parts.below_begin
    sign = np.where(falls, np.int8(-1), np.int8(1)).take(owner)
    points = positions(batch, segment, fraction)
    return PlaneRoots(parts, owner, plane, segment, curve, sign, t, points, near=True)


def _coordinate_axis(normal: FloatArray) -> int | None:
    """Give the axis along which or against which a normal points, None if it is askew."""
    sizes = [abs(part) for part in normal.tolist()]
    return sizes.index(1.0) if sizes.count(0.0) == 2 and 1.0 in sizes else None


def _parameters(batch: SplineBatch, segment: IntArray, fraction: FloatArray) -> FloatArray:
    """Give chord-length parameters, exactly those of the knots at fractions 0 and 1."""
    begin, end = batch.knot.take(segment), batch.knot.take(segment + 1)
    result = (end - begin) * fraction
    result += begin
    np.copyto(result, end, where=fraction == 1.0)
    return np.minimum(result, end, out=result)


def _expand(batch: SplineBatch, parts: MonotoneParts, planes: int) -> tuple[IntArray, IntArray]:
    """Give part and plane of every intersection, sorted by curve, plane and parameter."""
    least = np.minimum(parts.below_begin, parts.below_end)
    count = np.abs(parts.below_end - parts.below_begin)
    before = np.cumsum(count)
    total = int(before[-1]) if len(before) else 0
    owner = np.repeat(np.arange(len(count)), count)
    before -= count
    plane = np.arange(total) + (least - before).take(owner)
    # One key per intersection, no two alike: any sorting rule gives the same order.
    width = 3 * len(batch.knot)
    base = slots_of(batch.start).curve.take(parts.segment) * (planes * width) + parts.order
    order = np.argsort(plane * width + base.take(owner))
    return owner.take(order), plane.take(order)


def _fractions(
    course: PlaneHeights,
    parts: MonotoneParts,
    owner: IntArray,
    offset: FloatArray,
    factor: float,
) -> FloatArray:
    """Find where in its segment each intersection lies."""
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
    return bracketed_roots(cubic, lower, upper, at_lower, at_upper, factor=factor)


def _tangential(
    batch: SplineBatch, normal: FloatArray, found: PlaneRoots, offsets: FloatArray
) -> NDArray[np.bool_]:
    """Mark neighbouring intersections between which the curve hardly leaves the plane."""
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
    course = heights_over_plane(batch, normal)
    for pair in pairs[near].tolist():
        if _excursion(course, parts, owner[pair : pair + 2], offsets[plane[pair]]) < CONTACT:
            result[pair : pair + 2] = True
    return result


def _excursion(course: PlaneHeights, parts: MonotoneParts, pair: IntArray, offset: float) -> float:
    """Give the largest distance from the plane between two intersections; such pairs are rare."""
    one, other = pair
    segment = np.arange(parts.segment[one], parts.segment[other] + 1)
    _, height = nodes_of(course, segment)
    order = 3 * segment + np.arange(4)[:, None]
    after = 3 * segment[0] + 3 if parts.upper[one] == 1.0 else parts.order[one] + 1
    between = (order >= after) & (order <= parts.order[other])
    return float(np.abs(height[between] - offset).max())


# --------------------------------------------------------------------------------------
# Where curves touch planes without crossing them, and where they lie in them.


# --------------------------------------------------------------------------------------
# Places that measures of a form start from: where curves reach a plane, and where they turn.

_ON = 1e-6
"""A knot so near to a plane (m) is on it."""


@attrs.frozen(eq=False)
class PointsOnCurves:
    """Places on curves, in order along each.

    Attributes
    ----------
    curve : (k,) int
        The curve of each.
    t : (k,), m
        Chord parameter.
    xyz : (k, 3), m
        Where.
    along : (k, 3)
        Derivative with respect to chord length; after the place, where the curve has a corner.
    """

    curve: IntArray
    t: FloatArray
    xyz: FloatArray
    along: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.curve, self.t, self.xyz, self.along)


def points_on_plane(batch: SplineBatch, normal: FloatArray, offset: float) -> PointsOnCurves:
    """Find where curves pass, touch or end on a plane, in order along each; a place counts once.

    A knot within 1e-6 m of the plane is on it. `normal` is a unit vector, `offset` in m.
    """
    found = intersect_planes(batch, normal, np.array([offset]))
    owner = np.repeat(np.arange(batch.count), np.diff(batch.start))
    on = on_plane(batch, normal, offset)
    curve = np.concatenate([owner[on], found.curve])
    t = np.concatenate([batch.knot[on], found.t])
    xyz = np.concatenate([batch.xyz[on], found.xyz])
    order = np.lexsort((t, curve))
    curve, t, xyz = curve[order], t[order], xyz[order]
    new = np.ones(len(t), np.bool_)
    new[1:] = (np.diff(curve) != 0) | (np.diff(t) > _ON)
    curve, t, xyz = curve[new], t[new], xyz[new]
    return PointsOnCurves(curve, t, xyz, derivative(batch, curve, t))


def on_plane(batch: SplineBatch, normal: FloatArray, offset: float) -> NDArray[np.bool_]:
    """Tell which knots lie within 1e-6 m of a plane, (n,)."""
    found: NDArray[np.bool_] = np.abs(batch.xyz @ normal - offset) <= _ON
    return found


def points_at_coordinate(batch: SplineBatch, axis: int, value: float) -> PointsOnCurves:
    """Find where curves pass or touch the plane on which a coordinate (0, 1, 2) has a value, m."""
    return points_on_plane(batch, np.eye(3)[axis], value)


def coordinate_turns(batch: SplineBatch, axis: int) -> tuple[FloatArray, ...]:
    """Give places of each curve between which a coordinate (0, 1, 2) only rises or only falls.

    For each curve (k, 3), m, in order: knots, and where the derivative of the coordinate is zero.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.curves import SplineBatch
    >>> from assoc_hull.geometry.splines.plane_intersections import coordinate_turns
    >>> xyz = np.array([[0.0, 0, 0], [2, 0, 0]])
    >>> leave, arrive = np.array([[1.0, 2, 0]] * 2), np.array([[1.0, -2, 0]] * 2)
    >>> parabola = SplineBatch(np.array([0, 2]), np.array([0.0, 2]), xyz, leave, arrive)
    >>> round(float(coordinate_turns(parabola, 1)[0][:, 1].max()), 12)
    1.0
    """
    cubic = power_coefficients(batch)
    inner = unit_roots(differentiate(cubic)[:, :, axis])
    place = horner(cubic, np.concatenate([np.zeros((len(cubic), 1)), inner], axis=1))
    owner = segment_curve(batch)
    last = batch.xyz[batch.start[1:] - 1]
    found = tuple(
        np.concatenate([place[owner == i].reshape(-1, 3), last[i : i + 1]])
        for i in range(batch.count)
    )
    freeze(*found)
    return found
