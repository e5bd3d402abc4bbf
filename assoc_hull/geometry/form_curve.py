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
>>> from assoc_hull.geometry.form_curve import FormEnd, form_vertices, form_integrals
>>> run = FormEnd.of(-1.0, 0.0, np.radians(60.0), -2.0, 0.1525819451966713)
>>> body = FormEnd.of(-0.3, 1.0, 0.0, 0.0, 0.1525819451966713)
>>> vertices = form_vertices(run, body, area=np.array([0.55]), centroid=np.array([-0.59]))
>>> vertices[0, 3].round(9).tolist()
[-0.92217359, 0.787861836]
>>> form_integrals(vertices).area.round(12).tolist()
[0.55]
"""

from __future__ import annotations

from typing import Self

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.geometry.curves import FloatArray

__all__ = [
    "FormEnd", "FormIntegrals", "area_vertex", "end_vertices", "fair_vertex", "form_at",
    "form_integrals", "form_vertices", "middle_vertex", "power_form",
]  # fmt: skip

_BASIS = np.array([[1, 4, 1, 0], [-3, 0, 3, 0], [3, -6, 3, 0], [-1, 3, -3, 1]]) / 6.0
"""Row p: how the power u^p of a segment is made of its four vertices."""


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


@attrs.frozen(eq=False)
class FormIntegrals:
    """Integrals under curves.

    Attributes
    ----------
    area : (n,)
        int y dx.
    moment : (n,)
        int x y dx.
    moment_y : (n,)
        1/2 int y^2 dx.
    """

    area: FloatArray
    moment: FloatArray
    moment_y: FloatArray


def end_vertices(end: FormEnd) -> FloatArray:
    """Give the three vertices at an end, (n, 3, 2), in the order of t.

    At a knot with the neighbours a, b, c: Q = (a + 4 b + c)/6, Q' = (c - a)/2, Q'' = a - 2 b + c.
    """
    cos, sin = np.cos(end.angle), np.sin(end.angle)
    bend = end.tangent * end.tangent * end.curvature
    found = np.empty((len(end.x), 3, 2))
    for axis, (at, along, across) in enumerate(((end.x, cos, -sin), (end.y, sin, cos))):
        first = end.tangent * along
        second = bend * across + end.stretch * along
        found[:, 0, axis] = at - first + second / 3.0
        found[:, 1, axis] = at - second / 6.0
        found[:, 2, axis] = at + first + second / 3.0
    return found


def power_form(vertices: FloatArray) -> FloatArray:
    """Give the segments in powers of u = t - s: (n, 4 segments, 4 powers, 2)."""
    found = np.zeros((len(vertices), 4, 4, 2))
    for power in range(4):
        for part in range(4):
            weight = _BASIS[power, part]
            if weight:
                found[:, :, power] += weight * vertices[:, part : part + 4]
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


def form_integrals(vertices: FloatArray) -> FormIntegrals:
    """Integrate under curves, exactly: each segment is a cubic."""
    power = power_form(vertices)
    x, y = power[..., 0], power[..., 1]
    area, moment, moment_y = (np.zeros(x.shape[:2]) for _ in range(3))
    for p in range(4):
        for q in range(1, 4):
            area += y[:, :, p] * x[:, :, q] * (q / (p + q))
            for r in range(4):
                weight = q / (p + q + r)
                moment += y[:, :, p] * x[:, :, r] * x[:, :, q] * weight
                moment_y += 0.5 * y[:, :, p] * y[:, :, r] * x[:, :, q] * weight
    return FormIntegrals(*(_total(each) for each in (area, moment, moment_y)))


def _total(parts: FloatArray) -> FloatArray:
    """Add the four segments in their order."""
    return np.asarray(((parts[:, 0] + parts[:, 1]) + parts[:, 2]) + parts[:, 3])


def _with_middle(ends: FloatArray, x: ArrayLike, y: ArrayLike) -> FloatArray:
    """Put a middle vertex between the three of the start and the three of the finish."""
    found = np.empty((len(ends), 7, 2))
    found[:, :3], found[:, 4:] = ends[:, :3], ends[:, 3:]
    found[:, 3, 0], found[:, 3, 1] = x, y
    return found


def _differences(ends: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Give P4 - P2, P5 - P1, P6 - P0."""
    return ends[:, 3] - ends[:, 2], ends[:, 4] - ends[:, 1], ends[:, 5] - ends[:, 0]


def middle_vertex(
    ends: FloatArray, area: FloatArray, centroid: FloatArray, *, other: bool = False
) -> tuple[FloatArray, FloatArray]:
    """Give the middle vertices by which curves have an area and a centroid.

    The area is affine in the vertex, so all with that area lie on a line; on it the moment is
    quadratic. Of its two roots the one nearer to (P2 + P4)/2 is taken, or the other one.

    Parameters
    ----------
    ends : (n, 6, 2)
        P0, P1, P2, P4, P5, P6.
    area : (n,)
        int y dx.
    centroid : (n,)
        int x y dx / area.
    other : bool
        Give the other root; for diagnosis, it is far away and loses digits.

    Returns
    -------
    (n, 2), (n,)
        The vertices, nan where there is none, and the discriminants: negative where area
        and centroid cannot both be met; nan where the area does not depend on the vertex.
    """
    four, five, six = _differences(ends)
    d = 49.0 / 144.0 * four + 7.0 / 90.0 * five + six / 720.0
    c = 5947.0 / 30240.0 * four + 3.0 / 140.0 * five + six / 18144.0
    at, up, along = (
        form_integrals(_with_middle(ends, x, y)) for x, y in ((0.0, 0.0), (0.0, 1.0), (1.0, 0.0))
    )
    m1, m2 = along.moment - at.moment + 0.5 * c[:, 1], up.moment - at.moment
    gx, gy = -d[:, 1], d[:, 0]
    square = gx * gx + gy * gy
    with np.errstate(divide="ignore", invalid="ignore"):
        p = np.stack([gx, gy], axis=1) * ((area - at.area) / square)[:, None]
        c2 = 0.5 * d[:, 0] * (c[:, 0] * d[:, 1] - c[:, 1] * d[:, 0])
        c1 = m1 * d[:, 0] + m2 * d[:, 1] - c[:, 1] * p[:, 0] * d[:, 0]
        c1 = c1 + 0.5 * c[:, 0] * (p[:, 0] * d[:, 1] + d[:, 0] * p[:, 1])
        c0 = m1 * p[:, 0] + m2 * p[:, 1] + at.moment - area * centroid
        c0 = c0 + 0.5 * (c[:, 0] * p[:, 0] * p[:, 1] - c[:, 1] * p[:, 0] * p[:, 0])
        near, far, disc = _roots(c2, c1, c0, 0.5 * (ends[:, 2] + ends[:, 3]) - p, d)
    s = far if other else near
    return p + s[:, None] * d, disc


def _roots(
    c2: FloatArray, c1: FloatArray, c0: FloatArray, want: FloatArray, d: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Solve c2 s^2 + c1 s + c0 = 0; the root whose vertex p + s d lies nearer comes first."""
    disc = c1 * c1 - 4.0 * c2 * c0
    q = -0.5 * (c1 + np.copysign(np.sqrt(disc), c1))
    linear = np.abs(c2) <= 1e-13 * np.maximum(1.0, np.abs(c1))
    one, two = np.where(linear, -c0 / c1, c0 / q), np.where(linear, np.nan, q / c2)
    best = (want[:, 0] * d[:, 0] + want[:, 1] * d[:, 1]) / (d[:, 0] ** 2 + d[:, 1] ** 2)
    swap = np.abs(two - best) < np.abs(one - best)
    return np.where(swap, two, one), np.where(swap, one, two), np.where(linear, c1 * c1, disc)


def fair_vertex(ends: FloatArray, order: int = 3) -> FloatArray:
    """Give the middle vertices of least int |Q''|^2 dt (order 2) or int |Q'''|^2 dt (order 3)."""
    p0, p1, p2, p4, p5, p6 = (ends[:, each] for each in range(6))
    if order == 2:
        return np.asarray((9.0 * (p2 + p4) - (p0 + p6)) / 16.0)
    return np.asarray((p0 + p6 - 6.0 * (p1 + p5) + 15.0 * (p2 + p4)) / 20.0)


def area_vertex(ends: FloatArray, area: FloatArray) -> FloatArray:
    """Give the middle vertices of least int |Q'''|^2 dt with an area."""
    four, five, six = _differences(ends)
    d = 49.0 / 144.0 * four + 7.0 / 90.0 * five + six / 720.0
    g = np.stack([-d[:, 1], d[:, 0]], axis=1)
    free = fair_vertex(ends)
    lack = area - form_integrals(_with_middle(ends, free[:, 0], free[:, 1])).area
    return np.asarray(free + g * (lack / (g[:, 0] * g[:, 0] + g[:, 1] * g[:, 1]))[:, None])


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
    middle = np.where(
        np.isnan(area)[:, None], fair_vertex(ends),
        np.where(
            np.isnan(centroid)[:, None], area_vertex(ends, area),
            middle_vertex(ends, area, centroid)[0],
        ),
    )  # fmt: skip
    return _with_middle(ends, middle[:, 0], middle[:, 1])
