"""Spline curves and surfaces of an IGES file: entities 126 and 128, as they stand in the file.

Source: IGES 5.3 (US PRO, 1996), sections 4.23 and 4.24.

Examples
--------
>>> from assoc_hull.io.iges.record import Record
>>> from assoc_hull.io.iges.spline import spline_curve
>>> values = "126,1,1,1,0,1,0,0.,0.,1.,1.,1.,1.,0.,0.,0.,2.,0.,0.,0.,1.".split(",")
>>> spline_curve(Record(values, "here")).points.tolist()
[[0.0, 0.0, 0.0], [2.0, 0.0, 0.0]]
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.io.iges.record import Record

__all__ = ["CurveData", "SurfaceData", "spline_curve", "spline_surface"]

_MOST_POINTS, _MOST_DEGREE = 100_000, 25

_POINT = 1e-9
"""A side of this part of the size of a surface is a point."""


@attrs.frozen(eq=False)
class CurveData:
    """A spline curve.

    Attributes
    ----------
    degree : int
        Of the pieces.
    knots : (k + degree + 1,)
        In order.
    weights : (k,)
        Above 0.
    points : (k, 3)
        In units of the file; before it is moved.
    span : (float, float)
        The parameters where it begins and ends.
    """

    degree: int
    knots: FloatArray
    weights: FloatArray
    points: FloatArray
    span: tuple[float, float]


@attrs.frozen(eq=False)
class SurfaceData:
    """A spline surface.

    Attributes
    ----------
    degrees : (int, int)
        In u and v.
    knots : ((i + m + 1,), (j + n + 1,))
        In u and v, in order.
    weights : (i, j)
        Above 0.
    net : (i, j, 3)
        In units of the file; before it is moved.
    spans : ((float, float), (float, float))
        The parameters u and v that it is bounded by.
    after : int
        How many values of the record it takes: what comes then are pointers to properties.
    """

    degrees: tuple[int, int]
    knots: tuple[FloatArray, FloatArray]
    weights: FloatArray
    net: FloatArray
    spans: tuple[tuple[float, float], tuple[float, float]]
    after: int

    @property
    def points(self) -> NDArray[np.bool_]:
        """Whether it is a point along the sides of least u, greatest u; least v, greatest v.

        Only of surfaces that are not bounded within their knots, which are repeated at the ends.
        """
        size = float(np.ptp(self.net.reshape(-1, 3), axis=0).max())
        rows = ((self.net[0], self.net[-1]), (self.net[:, 0], self.net[:, -1]))
        found = [
            [
                bool(
                    np.ptp(row, axis=0).max() <= _POINT * size
                    and each[0] == each[degree]
                    and each[-1] == each[-1 - degree]
                    and tuple(span) == (each[0], each[-1])
                )
                for row in pair
            ]
            for pair, each, degree, span in zip(
                rows, self.knots, self.degrees, self.spans, strict=True
            )
        ]
        return np.array(found)


def spline_curve(record: Record) -> CurveData:
    """Read an entity 126.

    Raises
    ------
    BadInputError
        Values are missing, or are no spline.
    """
    (count,), (degree,) = _sizes(record, 1)
    at, (knots,) = _knots(record, 7, (count,), (degree,))
    weights = _weights(record, at, count)
    points = record.reals(at + count, 3 * count, "the control points").reshape(count, 3)
    (span,) = _spans(record, at + 4 * count, (knots,), (degree,))
    return CurveData(degree, knots, weights, points, span)


def spline_surface(record: Record) -> SurfaceData:
    """Read an entity 128; u runs fastest in the file, and last in the net.

    Raises
    ------
    BadInputError
        Values are missing, or are no spline.
    """
    (rows, columns), (m, n) = _sizes(record, 2)
    at, knots = _knots(record, 10, (rows, columns), (m, n))
    count = rows * columns
    weights = _weights(record, at, count).reshape(columns, rows).T
    points = record.reals(at + count, 3 * count, "the control points")
    net = points.reshape(columns, rows, 3).swapaxes(0, 1)
    spans = _spans(record, at + 4 * count, knots, (m, n))
    return SurfaceData(
        (m, n), (knots[0], knots[1]), weights.copy(), net.copy(), (spans[0], spans[1]),
        at + 4 * count + 4,
    )  # fmt: skip


def _sizes(record: Record, ways: int) -> tuple[tuple[int, ...], tuple[int, ...]]:
    """Give the numbers of control points and the degrees, one in each direction."""
    names = "uv"[:ways]
    counts = tuple(
        1 + record.count(1 + i, f"the upper index of {name}", _MOST_POINTS - 1)
        for i, name in enumerate(names)
    )
    degrees = tuple(
        record.count(1 + ways + i, f"the degree in {name}", _MOST_DEGREE)
        for i, name in enumerate(names)
    )
    for count, degree in zip(counts, degrees, strict=True):
        if not 1 <= degree < count:
            what = f"the degree is {degree} and there are {count} control points in a row"
            raise BadInputError(what, record.where, "a degree of 1 or more needs one point more")
    wanted = int(np.prod(counts))
    if wanted > len(record):
        what = f"{wanted} control points are announced, and the record has {len(record)} values"
        raise BadInputError(what, record.where, "export the file again")
    return counts, degrees


def _knots(
    record: Record, at: int, counts: tuple[int, ...], degrees: tuple[int, ...]
) -> tuple[int, tuple[FloatArray, ...]]:
    """Give the place behind all knots, and the knots of each direction."""
    found = []
    for count, degree in zip(counts, degrees, strict=True):
        size = count + degree + 1
        knots = record.reals(at, size, "the knots")
        fall = int(np.argmax(np.diff(knots) < 0.0))
        if knots[fall + 1] < knots[fall]:
            what = f"knot {fall + 2} is {knots[fall + 1]:g}, below {knots[fall]:g} before it"
            raise BadInputError(what, record.where, "knots must not fall")
        if not knots[degree] < knots[count]:
            what = f"the knots run from {knots[degree]:g} to {knots[count]:g}"
            raise BadInputError(what, record.where, "knots must rise")
        found.append(knots)
        at += size
    return at, tuple(found)


def _weights(record: Record, at: int, count: int) -> FloatArray:
    weights = record.reals(at, count, "the weights", default=1.0)
    if not (weights > 0.0).all():
        what = f"weight {int(np.argmin(weights)) + 1} is {weights.min():g}"
        raise BadInputError(what, record.where, "weights must be above 0")
    return weights


def _spans(
    record: Record, at: int, knots: tuple[FloatArray, ...], degrees: tuple[int, ...]
) -> list[tuple[float, float]]:
    """Give the parameters that bound it; an end that a digit lost puts outside is taken inside."""
    ends = record.reals(at, 2 * len(knots), "the bounds of the parameters").reshape(-1, 2)
    found = []
    for (low, high), each, degree in zip(ends.tolist(), knots, degrees, strict=True):
        first, last = float(each[degree]), float(each[-degree - 1])
        slack = 1e-6 * (last - first)
        if not (first - slack <= low < high <= last + slack):
            what = f"the parameters are bounded by {low:g} and {high:g}"
            remedy = f"the knots allow {first:g} to {last:g}"
            raise BadInputError(what, record.where, remedy)
        found.append(
            (first if low <= first + slack else low, last if high >= last - slack else high)
        )
    return found
