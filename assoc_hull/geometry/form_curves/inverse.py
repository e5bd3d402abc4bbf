"""From the vertices of a form-parameter curve back to its parameters.

The first three vertices give point, tangent and second derivative at the start, the last three
those at the finish; area and centroid are integrals. With the stretch of both ends these are 14
numbers, as many as the vertices have, so a curve that was changed by hand is had again from them.
Without the stretches it is not.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.form_curves.curve import end_vertices, FormEnd
>>> from assoc_hull.geometry.form_curves.inverse import end_of
>>> found = end_of(end_vertices(FormEnd.of(1.0, 2.0, 0.5, -0.25, 0.75, 0.125)))
>>> [round(float(each[0]), 12) for each in (found.angle, found.curvature, found.stretch)]
[0.5, -0.25, 0.125]
"""

from __future__ import annotations

import math

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.form_curves.curve import FormEnd
from assoc_hull.geometry.form_curves.integrals import form_integrals

__all__ = ["FormValues", "end_of", "form_values"]

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
        Of each curve. Where the tangent is nil the angle is that which was handed in, else nan;
        the curvature is nan.
    area, centroid, moment : (n,)
        int y dx, int x y dx / area and int x y dx. Where the area is nil the centroid is nan.
    """

    start: FormEnd
    finish: FormEnd
    area: FloatArray
    centroid: FloatArray
    moment: FloatArray


def end_of(vertices: FloatArray, angle: FloatArray | None = None) -> FormEnd:
    """Give the ends that three vertices each make.

    Parameters
    ----------
    vertices : (n, 3, 2)
        In the order of t.
    angle : (n,) or None, rad
        What the angle is taken for where the tangent is nil.
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
    """Give the parameters of curves.

    Parameters
    ----------
    vertices : (n, 7, 2)
        One curve a row.
    angles : two of (n,) or None, rad
        What the angles at both ends are taken for where a tangent is nil.
    """
    given = (None, None) if angles is None else angles
    found = form_integrals(vertices)
    size = np.ptp(vertices, axis=1).max(axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        empty = np.abs(found.area) <= _EMPTY * size * size
        centroid = np.where(empty, np.nan, found.moment / found.area)
    start, finish = end_of(vertices[:, :3], given[0]), end_of(vertices[:, 4:], given[1])
    return FormValues(start, finish, found.area, centroid, found.moment)
