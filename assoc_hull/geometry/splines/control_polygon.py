"""The composite spline of the kernel as a cubic B-spline, which other programs know.

Both are the same curve with the same parameter, chord length. A knot is single where the second
derivative is continuous, double where the direction is, threefold at a knuckle. The control points
are blossoms: with three knots x, y, z side by side, the control point is the value of the
symmetric function of three parameters, linear in each, that gives the cubic where all are equal
(L. Ramshaw, "Blossoms are polar forms", Computer Aided Geometric Design 6, 1989).

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.splines.control_polygon import control_polygon
>>> from assoc_hull.geometry.curves import CurveData
>>> from assoc_hull.geometry.splines.loft import loft
>>> data = CurveData.single(np.array([[0.0, 0, 0], [2, 0, 0], [3, 0, 0]]))
>>> straight = control_polygon(loft(data))
>>> straight.knots.tolist()
[0.0, 0.0, 0.0, 0.0, 2.0, 3.0, 3.0, 3.0, 3.0]
>>> straight.points[:, 0].round(9).tolist()
[0.0, 0.666666667, 1.666666667, 2.666666667, 3.0]
"""

from __future__ import annotations

import itertools

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze

__all__ = ["ControlPolygon", "control_polygon"]

_SMOOTH = 1e-10
"""A knot is single if that moves the curve by no more than about this (m)."""


@attrs.frozen(eq=False)
class ControlPolygon:
    """A cubic B-spline.

    Attributes
    ----------
    knots : (n + 4,), m
        Not falling; the first four are equal, and the last four.
    points : (n, 3), m
        The control points.
    """

    knots: FloatArray
    points: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.knots, self.points)


def control_polygon(spline: SplineBatch) -> ControlPolygon:
    """Give one curve as a B-spline.

    Parameters
    ----------
    spline : SplineBatch
        A batch of one curve.

    Returns
    -------
    ControlPolygon
        The same curve, to rounding (1e-12 m on a ship of 300 m).
    """
    many = _multiplicities(spline)
    knots = np.repeat(spline.knot, many)
    owner = np.repeat(np.arange(len(many)), many)
    # Control point j belongs to the knots j + 1, j + 2, j + 3.
    at = np.stack([knots[1:-3], knots[2:-2], knots[3:-1]])
    segment = _segment(spline, owner)
    return ControlPolygon(knots, _blossoms(spline, segment, at))


def _multiplicities(spline: SplineBatch) -> IntArray:
    """Say how often each knot stands, (n,)."""
    step = np.diff(spline.knot)[:, None]
    slope = np.diff(spline.xyz, axis=0) / step
    leave, arrive = spline.leave[:-1], spline.arrive[1:]
    begin = (6.0 * slope - 4.0 * leave - 2.0 * arrive) / step
    end = (2.0 * leave + 4.0 * arrive - 6.0 * slope) / step
    jump = np.abs(begin[1:] - end[:-1]).max(axis=1, initial=0.0)
    longer = np.maximum(step[1:, 0], step[:-1, 0])
    knuckle = (spline.leave != spline.arrive).any(axis=1)[1:-1]
    inner = np.where(knuckle, 3, np.where(jump * longer**2 > _SMOOTH, 2, 1))
    return np.concatenate([[4], inner, [4]]).astype(np.int64)


def _segment(spline: SplineBatch, owner: IntArray) -> IntArray:
    """Choose the segment of which each control point is a blossom: the longer one of two.

    So no parameter lies farther outside the segment than it is long, and rounding stays small.
    """
    step = np.append(np.diff(spline.knot), 0.0)
    first, middle, last = owner[1:-3], owner[2:-2], owner[3:-1]
    before = np.where(first < middle, step[first], -1.0)
    behind = np.where(middle < last, step[middle], -1.0)
    # All three are one knot: the control point is the point of the curve there.
    alone = np.minimum(middle, len(step) - 2)
    return np.where(first == last, alone, np.where(before > behind, first, middle))


def _blossoms(spline: SplineBatch, segment: IntArray, at: FloatArray) -> FloatArray:
    """Give the blossoms of segments at three parameters each, (3, k); (k, 3)."""
    begin = spline.knot[segment]
    step = spline.knot[segment + 1] - begin
    third = (step / 3.0)[:, None]
    near, far = spline.xyz[segment], spline.xyz[segment + 1]
    polygon = [
        near, near + third * spline.leave[segment], far - third * spline.arrive[segment + 1], far
    ]  # fmt: skip
    for parameter in at:
        share = ((parameter - begin) / step)[:, None]
        polygon = [
            (1.0 - share) * one + share * other for one, other in itertools.pairwise(polygon)
        ]
    return polygon[0]
