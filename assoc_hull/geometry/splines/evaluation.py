"""Points, derivatives, polylines and curvature of the kernel's cubic composite splines.

A place is a curve and a chord-length parameter, or a segment and a fraction of it. The search for
the segment is in `segments`; here its cubic is evaluated. The curvature is a vector in space, or a
signed value in a plane, positive where the curve turns left as seen from the tip of the normal.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.geometry.numeric.polynomials import differentiate, horner
from assoc_hull.geometry.numeric.vectors import check_normals, dot
from assoc_hull.geometry.splines.segments import (
    locate_by_knots,
    locate_parameters,
    power_coefficients,
    segment_start,
)

__all__ = [
    "curvature",
    "derivative",
    "evaluate",
    "plane_curvature",
    "positions",
    "sample",
    "space_curvature",
]

# --------------------------------------------------------------------------------------
# Points, derivatives and polylines.


def positions(batch: SplineBatch, segment: IntArray, fraction: FloatArray) -> FloatArray:
    """Give the points at fractions (k,) of the parameter interval of segments (k,): (3, k), m.

    A segment is the index of the knot where it starts. At fractions 0 and 1 the points are exactly
    those of the knots. Not frozen.

    Examples
    --------
    >>> from assoc_hull.geometry.splines.loft import loft
    >>> from assoc_hull.geometry.curves import CurveData
    >>> line = loft(CurveData.single(np.array([[0.0, 0, 0], [2, 0, 0]])))
    >>> positions(line, np.array([0]), np.array([0.25])).T
    array([[0.5, 0. , 0. ]])
    """
    origin, first, second, third = _powers(batch, segment)
    third *= fraction
    third += second
    third *= fraction
    third += first
    third *= fraction
    third += origin
    _put_ends(batch, segment, fraction, third)
    return third


def _put_ends(
    batch: SplineBatch, segment: IntArray, fraction: FloatArray, points: FloatArray
) -> None:
    """Make the points at fraction 1 exactly those of the knots."""
    at_end = np.flatnonzero(fraction == 1.0)
    if len(at_end):
        points[:, at_end] = batch.xyz[segment[at_end] + 1].T


def _powers(
    batch: SplineBatch, segment: IntArray
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Give the coefficients (3, k) of 1, u, u**2, u**3 of segments, u running from 0 to 1."""
    after = segment + 1
    length = batch.knot.take(after) - batch.knot.take(segment)
    xyz = np.ascontiguousarray(batch.xyz.T)
    origin = xyz.take(segment, axis=1)
    step = xyz.take(after, axis=1)
    step -= origin
    first = np.ascontiguousarray(batch.leave.T).take(segment, axis=1)
    first *= length
    last = np.ascontiguousarray(batch.arrive.T).take(after, axis=1)
    last *= length
    both = first + last
    second = 3.0 * step
    second -= first
    second -= both
    step *= 2.0
    both -= step
    return origin, first, second, both


def evaluate(batch: SplineBatch, curve: IntArray, t: FloatArray) -> FloatArray:
    """Give points on curves of a batch.

    Parameters
    ----------
    batch : SplineBatch
        The curves.
    curve : (k,) int
        Index of the curve, for each point.
    t : (k,), m
        Chord-length parameter on that curve.

    Returns
    -------
    (k, 3), m
        The points; at a knot exactly the defining point. Frozen.

    Raises
    ------
    BadInputError
        If a curve does not exist or a parameter lies outside its curve.

    Examples
    --------
    >>> from assoc_hull.geometry.splines.loft import loft
    >>> from assoc_hull.geometry.curves import CurveData
    >>> line = loft(CurveData.single(np.array([[0.0, 0, 0], [2, 0, 0]])))
    >>> evaluate(line, np.array([0, 0]), np.array([0.5, 2.0]))
    array([[0.5, 0. , 0. ],
           [2. , 0. , 0. ]])
    """
    segment, fraction, _ = locate_by_knots(batch, curve, t)
    result = positions(batch, segment, fraction).T
    freeze(result)
    return result


def derivative(
    batch: SplineBatch,
    curve: IntArray,
    t: FloatArray,
    order: int = 1,
    guess: NDArray[np.integer] | None = None,
) -> FloatArray:
    """Give derivatives with respect to chord length.

    Parameters
    ----------
    batch : SplineBatch
        The curves.
    curve : (k,) int
        Index of the curve, for each point.
    t : (k,), m
        Chord-length parameter on that curve; at a knot the derivative after it is given,
        at the last knot the one before it.
    order : int
        1, 2 or 3.
    guess : (k,) int or None
        Where each segment is thought to be, as number of its first knot along its curve; a
        right guess saves the search, a wrong one does no harm.

    Returns
    -------
    (k, 3), m per m to the power of `order`
        The derivatives; frozen.

    Raises
    ------
    BadInputError
        If a curve does not exist, a parameter lies outside its curve, or the order is
        none of 1, 2, 3.

    Examples
    --------
    >>> from assoc_hull.geometry.splines.loft import loft
    >>> from assoc_hull.geometry.curves import CurveData
    >>> line = loft(CurveData.single(np.array([[0.0, 0, 0], [2, 0, 0]])))
    >>> derivative(line, np.array([0]), np.array([0.5]), order=1)
    array([[1., 0., 0.]])
    """
    if order not in (1, 2, 3):
        raise BadInputError(f"order {order} was asked", "in derivative", "ask for 1, 2 or 3")
    segment, fraction, length = locate_by_knots(batch, curve, t, guess)
    _, first, second, third = _powers(batch, segment)
    if order == 1:
        value = first + fraction * (2.0 * second + fraction * (3.0 * third))
    elif order == 2:
        value = 2.0 * second + fraction * (6.0 * third)
    else:
        value = 6.0 * third
    for _ in range(order):
        value /= length
    result: FloatArray = value.T
    freeze(result)
    return result


def sample(batch: SplineBatch, per_segment: int = 8) -> tuple[IntArray, FloatArray]:
    """Give polylines for drawing.

    Parameters
    ----------
    batch : SplineBatch
        The curves.
    per_segment : int
        Number of chords that stand for one segment.

    Returns
    -------
    start : (m + 1,) int
        Where each polyline begins.
    xyz : (k, 3), m
        The points, defining points included; both frozen.

    Raises
    ------
    BadInputError
        If `per_segment` is less than 1.

    Examples
    --------
    >>> from assoc_hull.geometry.splines.loft import loft
    >>> from assoc_hull.geometry.curves import CurveData
    >>> line = loft(CurveData.single(np.array([[0.0, 0, 0], [2, 0, 0]])))
    >>> sample(line, per_segment=2)[1][:, 0]
    array([0., 1., 2.])
    """
    if per_segment < 1:
        raise BadInputError(f"{per_segment} chords were asked", "in sample", "ask for 1 or more")
    begins = segment_start(batch)
    fraction = np.tile(np.arange(per_segment) / per_segment, len(begins))
    inner = positions(batch, np.repeat(begins, per_segment), fraction)
    counts = np.diff(batch.start)
    start = np.zeros(len(counts) + 1, np.int64)
    np.cumsum((counts - 1) * per_segment + 1, out=start[1:])
    last = np.zeros(int(start[-1]), np.bool_)
    last[start[1:] - 1] = True
    xyz = np.empty((3, len(last)))
    xyz[:, ~last] = inner
    xyz[:, last] = batch.xyz[batch.start[1:] - 1].T
    result = xyz.T
    freeze(start, result)
    return start, result


# --------------------------------------------------------------------------------------
# Curvature: the vector in space, or the signed value of the projection on a plane.
#
# For a curve that lies in the plane the amount of the signed value is the length of the vector.


def curvature(
    batch: SplineBatch,
    normal: ArrayLike | None = None,
    at: tuple[ArrayLike, ArrayLike] | None = None,
) -> FloatArray:
    """Give the curvature at places on curves.

    At a knuckle it is the curvature after the knot; at the end of a curve, before it.

    Parameters
    ----------
    batch : SplineBatch
        The curves.
    normal : (3,) or (k, 3), optional
        Unit normal of the plane, one for all places or one for each. Without it the
        curvature vector is given.
    at : ((k,) int, (k,) m), optional
        Curve index and chord-length parameter of each place; every knot by default.

    Returns
    -------
    (k, 3) or (k,), 1/m
        The vector, which points to the centre of curvature, or the signed value. It is nan
        where the curve has no direction (a cusp).

    Raises
    ------
    BadInputError
        There is no such curve, a parameter lies off its curve, or a normal is not of unit
        length.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.splines.evaluation import curvature
    >>> from assoc_hull.geometry.curves import SplineBatch
    >>> xyz = np.array([[0.0, 0, 0], [2, 0, 0]])
    >>> leave, arrive = np.array([[1.0, -2, 0]] * 2), np.array([[1.0, 2, 0]] * 2)
    >>> parabola = SplineBatch(np.array([0, 2]), np.array([0.0, 2]), xyz, leave, arrive)
    >>> curvature(parabola, normal=[0, 0, 1], at=([0], [1.0]))
    array([2.])
    """
    if at is None:
        at = np.repeat(np.arange(batch.count), np.diff(batch.start)), batch.knot
    segment, u = locate_parameters(batch, *at)
    slopes = differentiate(power_coefficients(batch)[segment])
    first = horner(slopes, u[:, None])[:, 0]
    second = horner(differentiate(slopes), u[:, None])[:, 0]
    if normal is None:
        return space_curvature(first, second)
    return plane_curvature(first, second, check_normals(normal, len(u)))


def space_curvature(first: FloatArray, second: FloatArray) -> FloatArray:
    """Give the curvature vector (..., 3), 1/m, from two derivatives by any parameter, (..., 3).

    It is nan where the first derivative is zero.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.splines.evaluation import space_curvature
    >>> space_curvature(np.array([2.0, 0, 0]), np.array([1.0, 4.0, 0])).tolist()
    [0.0, 1.0, 0.0]
    """
    squared = dot(first, first)[..., None]
    with np.errstate(invalid="ignore", divide="ignore"):
        along = dot(first, second)[..., None] / squared
        vector: FloatArray = (second - along * first) / squared
    freeze(vector)
    return vector


def plane_curvature(first: FloatArray, second: FloatArray, normal: FloatArray) -> FloatArray:
    """Give the signed curvature (...), 1/m, of the projection on a plane, from two derivatives.

    These are (..., 3), by any parameter, as are the unit normals. It is nan where the projection
    has no direction or the normal is nan.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.splines.evaluation import plane_curvature
    >>> up = np.array([0.0, 0, 1])
    >>> float(plane_curvature(np.array([2.0, 0, 0]), np.array([1.0, 4.0, 0]), up))
    1.0
    """
    flat = first - dot(first, normal)[..., None] * normal
    speed = np.sqrt(dot(flat, flat))
    with np.errstate(invalid="ignore", divide="ignore"):
        value = np.asarray(dot(normal, np.cross(first, second)) / speed**3)
    freeze(value)
    return value
