"""Form-parameter curves: a cubic B-spline of 7 vertices from what its ends and its area are to be.

A curve runs in a plane, t from 0 to 4, over uniform knots; it does not pass through its first
and last vertex. Its 7 vertices are 14 numbers: at both ends a point, an angle, a curvature, the
length of the tangent vector and its *stretch* (second derivative along the tangent); then the area
under the curve and the abscissa of the centroid of that area. So the first three vertices follow
from the start, the last three from the finish, the middle one from area and centroid.

All functions take batches and work elementwise: a curve has the same bits alone and in a batch.
Angles are radians from the positive abscissa, a curvature is positive where the curve turns left.

S.Y. Kim, S.W. Kang, "Ship Lines Creation by B-Spline Form Parameter Method", Trans. SNAK 29(2),
1992; the method goes back to Creutz 1977. Which of the two middle vertices is taken, and the
vertices without area, are our decisions.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.form_curves.curve import form_vertices, FormEnd
>>> from assoc_hull.geometry.form_curves.integrals import form_integrals
>>> run = FormEnd.of(-1.0, 0.0, np.radians(60.0), -2.0, 0.1525819451966713)
>>> body = FormEnd.of(-0.3, 1.0, 0.0, 0.0, 0.1525819451966713)
>>> vertices = form_vertices(run, body, area=np.array([0.55]), centroid=np.array([-0.59]))
>>> vertices[0, 3].round(9).tolist()
[-0.92217359, 0.787861836]
>>> form_integrals(vertices).area.round(12).tolist()
[0.55]
"""

from __future__ import annotations

import math
from typing import Self

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.form_curves.integrals import FormIntegrals, form_integrals, power_form
from assoc_hull.geometry.form_curves.middle import (
    area_vertex,
    fair_vertex,
    middle_vertex,
    with_middle,
)

__all__ = [
    "FormEnd", "FormIntegrals", "area_vertex", "end_vertices", "fair_vertex", "form_at",
    "form_integrals", "form_vertices", "middle_vertex", "power_form",
]  # fmt: skip


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
    """Give points of curves, or a derivative by t.

    Parameters
    ----------
    vertices : (n, 7, 2)
        One curve a row.
    t : (n,)
        A parameter each, within [0, 4].
    order : int
        0 for the point, 1, 2, 3 for the derivative.

    Returns
    -------
    (n, 2)
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

    Parameters
    ----------
    start, finish : FormEnd
        The ends.
    area : (n,) or None
        int y dx; nan, or None for all: as it comes out fairest.
    centroid : (n,) or None
        int x y dx / area; nan, or None for all: as it comes out fairest with that area.

    Returns
    -------
    (n, 7, 2)
        nan in the middle vertex where area and centroid cannot both be met.
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
