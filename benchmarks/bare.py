"""The edit of one section without objects: what the arithmetic alone costs.

The yardstick of the whole engine. It lofts the section, meets the planes of the 70 lines,
moves 70 knots, lofts the 70 lines, meets all planes of their partners and measures the gaps
at the watched crossings, with the kernels of `assoc_hull.geometry` on arrays that are laid
out once. It knows no identity, no order, no journal and no cause.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import CurveData, FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.plane_intersections import PlaneIntersections, intersect_planes
from benchmarks.shape import BUTTOCKS, SECTIONS, WATERLINES, Shape, batch_of

__all__ = ["Bare"]

X, Y, Z = np.eye(3)


class Bare:
    """The net as bare arrays, ready for edits of one section.

    Parameters
    ----------
    shape : Shape
        The lines.
    number : int
        The section that is edited.
    """

    def __init__(self, shape: Shape, number: int) -> None:
        self.section = batch_of(shape.sections[number : number + 1])
        self.lines = batch_of(shape.waterlines + shape.buttocks)
        self.waterlines = len(shape.waterlines)
        self.at = float(SECTIONS[number])
        on_section = np.flatnonzero(self.lines.xyz[:, 0] == self.at)
        self.places = self.lines.xyz.copy()
        self.knots = on_section
        self.watched: tuple[IntArray, IntArray] | None = None
        self.watched = self._pairs(*self._meet(loft(self.lines)))

    def edit(
        self, points: FloatArray
    ) -> tuple[SplineBatch, tuple[PlaneIntersections, ...], FloatArray]:
        """Put the section's points where they are asked, and bring all up to date.

        Parameters
        ----------
        points : (40, 3), m
            The points of the section.

        Returns
        -------
        SplineBatch, tuple of Meetings, (w,) m
            The 70 lines, their meetings with all planes, and the watched gaps.
        """
        section = loft(_moved(self.section, points))
        up, out = intersect_planes(section, Z, WATERLINES), intersect_planes(section, Y, BUTTOCKS)
        places = self.places.copy()
        places[self.knots[: up.count]], places[self.knots[up.count :]] = up.xyz, out.xyz
        batch = loft(_moved(self.lines, places))
        found = self._meet(batch)
        return batch, (up, out, *found), self._gaps(batch, found[1], found[3])

    def _meet(
        self, batch: SplineBatch
    ) -> tuple[PlaneIntersections, PlaneIntersections, PlaneIntersections, PlaneIntersections]:
        """Meet waterlines with sections and buttocks, buttocks with sections and waterlines."""
        level, upright = batch.part(0, self.waterlines), batch.part(self.waterlines, batch.count)
        return (
            intersect_planes(level, X, SECTIONS),
            intersect_planes(level, Y, BUTTOCKS),
            intersect_planes(upright, X, SECTIONS),
            intersect_planes(upright, Z, WATERLINES),
        )

    def _pairs(self, *found: PlaneIntersections) -> tuple[IntArray, IntArray]:
        """Match the meetings of waterlines and buttocks, once, by line, line and sense."""
        one, other = found[1], found[3]
        # A buttock falls through a waterline where, from aft, it enters it.
        left = {key: i for i, key in enumerate(zip(one.curve, one.plane, one.sign, strict=True))}
        right = zip(other.plane, other.curve, -other.sign, strict=True)
        pairs = [(left[key], i) for i, key in enumerate(right) if key in left]
        first, second = np.array(pairs).T.copy()
        return first, second

    def _gaps(
        self, batch: SplineBatch, one: PlaneIntersections, other: PlaneIntersections
    ) -> FloatArray:
        """Give the gaps along the normal, from the tangents of both curves."""
        assert self.watched is not None
        first, second = self.watched
        shift = int(batch.start[self.waterlines])
        segment = np.concatenate([one.segment.take(first), other.segment.take(second) + shift])
        tangent = _tangents(
            batch, segment, np.concatenate([one.t.take(first), other.t.take(second)])
        )
        a, b = tangent[:, : len(first)], tangent[:, len(first) :]
        normal = np.empty_like(a)
        for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
            np.multiply(a[j], b[k], out=normal[i])
            normal[i] -= a[k] * b[j]
        offset = one.xyz.T.take(first, axis=1) - other.xyz.T.take(second, axis=1)
        product, square = offset * normal, normal * normal
        along = np.abs(product[0] + product[1] + product[2])
        gap: FloatArray = along / np.sqrt(square[0] + square[1] + square[2])
        return gap


def _moved(data: CurveData, xyz: FloatArray) -> CurveData:
    return CurveData(data.start, xyz, data.kind, data.direction, data.end_kind, data.end_vector)


def _tangents(batch: SplineBatch, segment: IntArray, t: FloatArray) -> FloatArray:
    """Give unit tangents (3, k) at parameters whose segments are known."""
    after = segment + 1
    begin = batch.knot.take(segment)
    length = batch.knot.take(after) - begin
    step = batch.xyz.T.take(after, axis=1) - batch.xyz.T.take(segment, axis=1)
    first = batch.leave.T.take(segment, axis=1) * length
    last = batch.arrive.T.take(after, axis=1) * length
    fraction = (t - begin) / length
    bend = 3.0 * step - 2.0 * first - last
    third = first + last - 2.0 * step
    slope = first + fraction * (2.0 * bend + fraction * (3.0 * third))
    square = slope * slope
    slope /= np.sqrt(square[0] + square[1] + square[2])
    return slope
