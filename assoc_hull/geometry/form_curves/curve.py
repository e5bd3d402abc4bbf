"""Form-parameter curves: a cubic B-spline of 7 vertices, from its 14 parameters and back to them.

A curve runs in a plane, t from 0 to 4, over uniform knots; it does not pass through its first and
last vertex. `FormEnd` says what an end is to be, `form_vertices` makes the curve; `form_values`
reads the parameters off the vertices, `FormParameters` has those of one curve by name. Functions
take batches and work elementwise: a curve has the same bits alone and in a batch. Angles are
radians from the positive abscissa, a curvature is positive where the curve turns left.

S.Y. Kim, S.W. Kang, "Ship Lines Creation by B-Spline Form Parameter Method", Trans. SNAK 29(2),
1992; the method goes back to Creutz 1977. Which of the two middle vertices is taken, and the
vertices without area, are our decisions.
"""

from __future__ import annotations

import math
from typing import Self

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.form_curves.integrals import (
    area_vertex,
    fair_vertex,
    form_integrals,
    middle_vertex,
    with_middle,
)

__all__ = [
    "NAMES",
    "FormEnd",
    "FormParameters",
    "FormValues",
    "end_of",
    "end_vertices",
    "form_at",
    "form_values",
    "form_vertices",
]

# --------------------------------------------------------------------------------------
# Vertices from parameters.
#
# The 7 vertices are 14 numbers: at both ends a point, an angle, a curvature, the length of the
# tangent vector and its *stretch* (second derivative along the tangent); then the area under the
# curve and the abscissa of the centroid of that area. So the first three vertices follow from the
# start, the last three from the finish, the middle one from area and centroid.


@attrs.frozen(eq=False)
class FormEnd:
    """One end of each curve of a batch.

    Attributes
    ----------
    x, y : (n,)
        The point, in the unit of the plane.
    angle : (n,), rad
        Of the tangent, from the positive abscissa.
    curvature : (n,), 1/unit
        Positive where the curve turns left as t rises.
    tangent : (n,), unit
        Length of the derivative by t, above 0.
    stretch : (n,), unit
        Component of the second derivative along the tangent.
    """

    x: FloatArray
    y: FloatArray
    angle: FloatArray
    curvature: FloatArray
    tangent: FloatArray
    stretch: FloatArray

    @classmethod
    def of(
        cls,
        x: ArrayLike,
        y: ArrayLike,
        angle: ArrayLike,
        curvature: ArrayLike = 0.0,
        tangent: ArrayLike = 1.0,
        stretch: ArrayLike = 0.0,
    ) -> Self:
        """Give ends of single numbers or arrays, which are broadcast together."""
        parts = [
            np.asarray(each, np.float64) for each in (x, y, angle, curvature, tangent, stretch)
        ]
        return cls(*(np.atleast_1d(part) for part in np.broadcast_arrays(*parts)))


def end_vertices(end: FormEnd) -> FloatArray:
    """Give the three vertices at an end, (n, 3, 2), in the order of t.

    At a knot with the neighbours a, b, c: Q = (a + 4 b + c)/6, Q' = (c - a)/2, Q'' = a - 2 b + c.
    """
    # numpy's own cosines may differ in the last bit with the machine and the batch.
    cos = np.array([math.cos(angle) for angle in end.angle.tolist()])
    sin = np.array([math.sin(angle) for angle in end.angle.tolist()])
    bend = end.tangent * end.tangent * end.curvature
    found = np.empty((len(end.x), 3, 2))
    for axis, (at, along, across) in enumerate(((end.x, cos, -sin), (end.y, sin, cos))):
        first = end.tangent * along
        second = bend * across + end.stretch * along
        found[:, 0, axis] = at - first + second / 3.0
        found[:, 1, axis] = at - second / 6.0
        found[:, 2, axis] = at + first + second / 3.0
    return found


def form_at(vertices: FloatArray, t: FloatArray, order: int = 0) -> FloatArray:
    """Give points of curves (n, 7, 2), one at a parameter t in [0, 4] each, or a derivative by t.

    The order is 0 for the point, 1, 2, 3 for the derivative; the result is (n, 2).
    """
    segment = np.clip(np.floor(t), 0.0, 3.0)
    u = (t - segment)[:, None]
    index = segment.astype(np.int64)
    rows = np.arange(len(vertices))
    a, b, c, d = (vertices[rows, index + part] for part in range(4))
    c0, c1 = (a + 4.0 * b + c) / 6.0, (c - a) / 2.0
    c2, c3 = (a - 2.0 * b + c) / 2.0, (d - a + 3.0 * (b - c)) / 6.0
    if order == 0:
        return np.asarray(c0 + u * (c1 + u * (c2 + u * c3)))
    if order == 1:
        return np.asarray(c1 + u * (2.0 * c2 + 3.0 * u * c3))
    if order == 2:
        return np.asarray(2.0 * c2 + 6.0 * u * c3)
    return np.asarray(6.0 * c3 + 0.0 * u)


def form_vertices(
    start: FormEnd,
    finish: FormEnd,
    area: FloatArray | None = None,
    centroid: FloatArray | None = None,
) -> FloatArray:
    """Give the vertices of curves, (n, 7, 2).

    The area is int y dx, the centroid int x y dx / area, (n,) each; nan, or None for all: as they
    come out fairest. The middle vertex is nan where no curve has both the area and the centroid.
    """
    ends = np.concatenate([end_vertices(start), end_vertices(finish)], axis=1)
    none = np.full(len(ends), np.nan)
    area = none if area is None else area
    centroid = none if centroid is None else centroid
    free, loose = np.isnan(area), np.isnan(centroid)
    middle = np.empty((len(ends), 2))
    # Each rule for its own curves only: the last one costs as much as all the rest.
    if free.any():
        middle[free] = fair_vertex(ends[free])
    if (some := ~free & loose).any():
        middle[some] = area_vertex(ends[some], area[some])
    if (some := ~free & ~loose).any():
        middle[some] = middle_vertex(ends[some], area[some], centroid[some])[0]
    return with_middle(ends, middle[:, 0], middle[:, 1])


# --------------------------------------------------------------------------------------
# Parameters from vertices: the other way, so that a curve that was changed by hand can be made
# again from its parameters. Without the stretches it could not.

_STILL = 1e-12
"""Of the size of a curve: a shorter tangent has no direction."""

_TINY = 1e-100
"""A tangent whose square is hardly a number has none either."""

_EMPTY = 1e-12
"""Of the square of the size: a smaller area has no centroid."""


@attrs.frozen(eq=False)
class FormValues:
    """The parameters of curves.

    Attributes
    ----------
    start, finish : FormEnd
        Of each curve. Where the tangent is zero the angle is that which was handed in, else nan;
        the curvature is nan.
    area, centroid, moment : (n,)
        int y dx, int x y dx / area and int x y dx. Where the area is zero the centroid is nan.
    """

    start: FormEnd
    finish: FormEnd
    area: FloatArray
    centroid: FloatArray
    moment: FloatArray


def end_of(vertices: FloatArray, angle: FloatArray | None = None) -> FormEnd:
    """Give the ends that three vertices each, (n, 3, 2), in the order of t, make.

    The angle (n,), rad, is taken where the tangent is zero.
    """
    a, b, c = (vertices[:, each] for each in range(3))
    point, first, second = (a + 4.0 * b + c) / 6.0, (c - a) / 2.0, a - 2.0 * b + c
    tangent = np.array([math.hypot(x, y) for x, y in first.tolist()])
    still = tangent <= np.maximum(_STILL * np.abs(vertices).max(axis=(1, 2)), _TINY)
    turn = np.array([math.atan2(y, x) for x, y in first.tolist()])
    turn = np.where(still, np.nan if angle is None else angle, turn)
    cos = np.array([math.cos(each) for each in turn.tolist()])
    sin = np.array([math.sin(each) for each in turn.tolist()])
    across = second[:, 1] * cos - second[:, 0] * sin
    with np.errstate(divide="ignore", invalid="ignore"):
        curvature = np.where(still, np.nan, across / (tangent * tangent))
    stretch = second[:, 0] * cos + second[:, 1] * sin
    return FormEnd(point[:, 0], point[:, 1], turn, curvature, tangent, stretch)


def form_values(
    vertices: FloatArray, angles: tuple[FloatArray, FloatArray] | None = None
) -> FormValues:
    """Give the parameters of curves (n, 7, 2).

    The angles at both ends, (n,), rad, are taken where a tangent is zero.
    """
    given = (None, None) if angles is None else angles
    found = form_integrals(vertices)
    size = np.ptp(vertices, axis=1).max(axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        empty = np.abs(found.area) <= _EMPTY * size * size
        centroid = np.where(empty, np.nan, found.moment / found.area)
    start, finish = end_of(vertices[:, :3], given[0]), end_of(vertices[:, 4:], given[1])
    return FormValues(start, finish, found.area, centroid, found.moment)


# --------------------------------------------------------------------------------------
# The parameters of one curve, by name.


@attrs.frozen
class FormParameters:
    """The parameters of one curve.

    Attributes
    ----------
    start_x, start_y, finish_x, finish_y : float
        The ends, in the unit of the plane.
    start_angle, finish_angle : float, rad
        Of the tangent, from the positive abscissa to the left.
    start_curvature, finish_curvature : float, 1/unit
        Positive where the curve turns left as t rises.
    start_tangent, finish_tangent : float, unit
        Lengths of the derivative by t, which runs from 0 to 4.
    start_stretch, finish_stretch : float, unit
        Components of the second derivative along the tangent.
    area : float
        int y dx; nan if it is as it comes out.
    centroid : float
        int x y dx / area; nan if it is as it comes out, or if there is no area.
    """

    start_x: float
    start_y: float
    start_angle: float
    start_curvature: float
    start_tangent: float
    start_stretch: float
    finish_x: float
    finish_y: float
    finish_angle: float
    finish_curvature: float
    finish_tangent: float
    finish_stretch: float
    area: float = float("nan")
    centroid: float = float("nan")

    @classmethod
    def of(cls, values: FormValues, row: int = 0) -> Self:
        """Take those of one curve of a batch."""
        found = [
            getattr(end, name)[row]
            for end in (values.start, values.finish)
            for name in ("x", "y", "angle", "curvature", "tangent", "stretch")
        ]
        return cls(*(float(each) for each in (*found, values.area[row], values.centroid[row])))

    def ends(self) -> tuple[FormEnd, FormEnd]:
        """Give both ends, as a batch of one curve."""
        start = (self.start_x, self.start_y, self.start_angle, self.start_curvature)
        finish = (self.finish_x, self.finish_y, self.finish_angle, self.finish_curvature)
        return (
            FormEnd.of(*start, self.start_tangent, self.start_stretch),
            FormEnd.of(*finish, self.finish_tangent, self.finish_stretch),
        )

    def integrals(self) -> tuple[FloatArray, FloatArray]:
        """Give area and centroid, as those of a batch of one curve."""
        return np.array([self.area]), np.array([self.centroid])

    def mirrored(self) -> FormParameters:
        """Give those of the curve mirrored at x = 0 and run backward; curvatures keep their sign.

        A falling curve becomes a rising one.
        """
        return FormParameters(
            -self.finish_x, self.finish_y, -self.finish_angle, self.finish_curvature,
            self.finish_tangent, -self.finish_stretch, -self.start_x, self.start_y,
            -self.start_angle, self.start_curvature, self.start_tangent, -self.start_stretch,
            self.area, -self.centroid,
        )  # fmt: skip

    @property
    def rising(self) -> FormParameters:
        """These, or those mirrored if the curve ends lower than it starts."""
        return self.mirrored() if self.finish_y < self.start_y else self


NAMES = tuple(field.name for field in attrs.fields(FormParameters))
"""Of the parameters, in their order."""
