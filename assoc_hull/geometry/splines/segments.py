"""Cubic segments of a batch of splines: places, points, derivatives, curvature.

A curve with k points has k - 1 segments; the segments of all curves lie one behind the
other, in the order of the curves. Each has its own parameter u, from 0 to 1. Every result
for one curve is the same to the last bit whatever other curves are in the batch.
`power_coefficients` and `bezier_points` also take arrays that are complex or carry tangents.

Points, derivatives, polylines and curvature of the kernel's cubic composite splines.

A place is a curve and a chord-length parameter, or a segment and a fraction of it. The search for
the segment is in `segments`; here its cubic is evaluated. The curvature is a vector in space, or a
signed value in a plane, positive where the curve turns left as seen from the tip of the normal.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assoc_hull.errors import BadInputError, TooFewPointsError
from assoc_hull.geometry.curves import (
    FloatArray,
    IntArray,
    SplineBatch,
    freeze,
)
from assoc_hull.geometry.numeric.polynomials import differentiate, horner
from assoc_hull.geometry.numeric.vectors import check_normals, dot

__all__ = [
    "bezier_points",
    "curvature",
    "derivative",
    "evaluate",
    "evaluate_with_slope",
    "last_not_above",
    "locate_by_knots",
    "locate_parameters",
    "plane_curvature",
    "positions",
    "power_coefficients",
    "sample",
    "segment_curve",
    "segment_start",
    "space_curvature",
    "sum_per_curve",
]

_OVERSHOOT = 1e-9  # m: by this a parameter may miss the ends of its curve


def segment_start(batch: SplineBatch) -> IntArray:
    """Give the knot at which each segment begins: all knots but the last of each curve.

    Parameters
    ----------
    batch : SplineBatch
        The curves.

    Returns
    -------
    (s,) int
        Rows of ``batch.knot``; the segment ends at the next row.

    Raises
    ------
    TooFewPointsError
        A curve has fewer than two points, so no segment.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.curves import SplineBatch
    >>> from assoc_hull.geometry.splines.segments import segment_start
    >>> start = np.array([0, 3, 5])
    >>> segment_start(SplineBatch(start, np.array([0.0, 1, 2, 0, 1]), *np.zeros((3, 5, 3))))
    array([0, 1, 3])
    """
    counts = np.diff(batch.start)
    if np.any(counts < 2):
        short = int(np.argmax(counts < 2))
        raise TooFewPointsError(f"curve {short} of the batch", int(counts[short]))
    begins = np.ones(len(batch.knot), bool)
    begins[batch.start[1:] - 1] = False
    first = np.flatnonzero(begins).astype(np.int64, copy=False)
    freeze(first)
    return first


def segment_curve(batch: SplineBatch) -> IntArray:
    """Give the curve that each segment belongs to.

    Parameters
    ----------
    batch : SplineBatch
        The curves.

    Returns
    -------
    (s,) int
        Indices of curves.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.curves import SplineBatch
    >>> from assoc_hull.geometry.splines.segments import segment_curve
    >>> start = np.array([0, 3, 5])
    >>> segment_curve(SplineBatch(start, np.array([0.0, 1, 2, 0, 1]), *np.zeros((3, 5, 3))))
    array([0, 0, 1])
    """
    curve = np.repeat(np.arange(batch.count, dtype=np.int64), np.diff(batch.start) - 1)
    freeze(curve)
    return curve


def sum_per_curve(batch: SplineBatch, values: FloatArray) -> FloatArray:
    """Add up the values of the segments of each curve.

    Parameters
    ----------
    batch : SplineBatch
        The curves.
    values : (s, ...)
        One row per segment.

    Returns
    -------
    (m, ...)
        One row per curve.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.curves import SplineBatch
    >>> from assoc_hull.geometry.splines.segments import sum_per_curve
    >>> start = np.array([0, 3, 5])
    >>> batch = SplineBatch(start, np.array([0.0, 1, 2, 0, 1]), *np.zeros((3, 5, 3)))
    >>> sum_per_curve(batch, np.array([1.0, 2, 5]))
    array([3., 5.])
    """
    if batch.count == 0:
        return np.zeros((0, *values.shape[1:]))
    sums: FloatArray = np.add.reduceat(values, batch.start[:-1] - np.arange(batch.count), axis=0)
    freeze(sums)
    return sums


def _ends(batch: SplineBatch) -> tuple[IntArray, FloatArray, FloatArray, FloatArray]:
    """Give the first knot, the chord and the two end derivatives by u of each segment."""
    first = segment_start(batch)
    length = (batch.knot[first + 1] - batch.knot[first])[:, None]
    chord = batch.xyz[first + 1] - batch.xyz[first]
    return first, chord, batch.leave[first] * length, batch.arrive[first + 1] * length


def power_coefficients(batch: SplineBatch) -> FloatArray:
    """Give the power coefficients of each segment in its parameter u.

    Parameters
    ----------
    batch : SplineBatch
        The curves.

    Returns
    -------
    (s, 4, 3), m
        ``P(u) = c[0] + c[1] u + c[2] u^2 + c[3] u^3`` with u in [0, 1].

    Raises
    ------
    TooFewPointsError
        A curve has fewer than two points.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.curves import SplineBatch
    >>> from assoc_hull.geometry.splines.segments import power_coefficients
    >>> xyz = np.array([[0.0, 0, 0], [2, 0, 0]])
    >>> along = np.array([[1.0, 0, 0], [1, 0, 0]])
    >>> line = SplineBatch(np.array([0, 2]), np.array([0.0, 2]), xyz, along, along.copy())
    >>> power_coefficients(line)[0, :, 0]
    array([0., 2., 0., 0.])
    """
    first, chord, leave, arrive = _ends(batch)
    start = batch.xyz[first]
    # 3 (chord - leave) + (leave - arrive) is zero to the last bit on a straight segment.
    square = 3.0 * (chord - leave) + (leave - arrive)
    cube = (leave - chord) + (arrive - chord)
    coefficients = np.stack([start, leave, square, cube], axis=1)
    freeze(coefficients)
    return coefficients


def bezier_points(batch: SplineBatch) -> FloatArray:
    """Give the Bezier points of each segment.

    Parameters
    ----------
    batch : SplineBatch
        The curves.

    Returns
    -------
    (s, 4, 3), m
        The segment lies in the convex hull of its four points.

    Raises
    ------
    TooFewPointsError
        A curve has fewer than two points.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.curves import SplineBatch
    >>> from assoc_hull.geometry.splines.segments import bezier_points
    >>> xyz = np.array([[0.0, 0, 0], [3, 0, 0]])
    >>> along = np.array([[1.0, 0, 0], [1, 0, 0]])
    >>> line = SplineBatch(np.array([0, 2]), np.array([0.0, 3]), xyz, along, along.copy())
    >>> bezier_points(line)[0, :, 0]
    array([0., 1., 2., 3.])
    """
    first, _, leave, arrive = _ends(batch)
    start, end = batch.xyz[first], batch.xyz[first + 1]
    points = np.stack([start, start + leave / 3.0, end - arrive / 3.0, end], axis=1)
    freeze(points)
    return points


def locate_parameters(
    batch: SplineBatch, curve: ArrayLike, t: ArrayLike
) -> tuple[IntArray, FloatArray]:
    """Find the segments on which parameters lie.

    A parameter at a knot belongs to the segment that begins there, at the last knot to the
    last segment; one that misses an end of its curve by rounding is taken as the end.

    Parameters
    ----------
    batch : SplineBatch
        The curves.
    curve : (k,) int
        The curve of each parameter.
    t : (k,), m
        Chord-length parameters.

    Returns
    -------
    segment : (k,) int
        Indices of segments.
    u : (k,)
        Parameters on them, from 0 to 1.

    Raises
    ------
    BadInputError
        There is no such curve, a parameter lies off its curve, or the shapes differ.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.curves import SplineBatch
    >>> from assoc_hull.geometry.splines.segments import locate_parameters
    >>> start = np.array([0, 3, 5])
    >>> batch = SplineBatch(start, np.array([0.0, 1, 3, 0, 4]), *np.zeros((3, 5, 3)))
    >>> segment, u = locate_parameters(batch, [0, 0, 1], [0.25, 2.5, 1.0])
    >>> segment.tolist(), u.tolist()
    ([0, 1, 2], [0.25, 0.75, 0.25])
    """
    segment_start(batch)
    which, at = _checked_places(curve, t)
    first, u, _ = locate_by_knots(batch, which, at)
    segment = first - which
    freeze(segment, u)
    return segment, u


def locate_by_knots(
    batch: SplineBatch, curve: IntArray, t: FloatArray, guess: NDArray[np.integer] | None = None
) -> tuple[IntArray, FloatArray, FloatArray]:
    """Find the segments on which parameters lie; the search is exact in the knots' bits.

    Parameters
    ----------
    batch : SplineBatch
        The curves.
    curve : (k,) int
        The curve of each parameter.
    t : (k,), m
        Chord-length parameters.
    guess : (k,) int or None
        Where each segment is thought to be, as number of its first knot along its curve.

    Returns
    -------
    first : (k,) int
        The knot at which the segment begins.
    u : (k,)
        Parameters on the segments, from 0 to 1.
    length : (k,), m
        Of the segments, in the parameter.

    Raises
    ------
    BadInputError
        If a curve does not exist or a parameter lies outside its curve.
    """
    curve = np.asarray(curve, np.int64).ravel()
    t = np.asarray(t, np.float64).ravel()
    if len(curve) and (int(curve.min()) < 0 or int(curve.max()) >= batch.count):
        raise BadInputError(
            f"curve {int(curve.max())} or {int(curve.min())} was asked",
            f"in a batch of {batch.count} curves",
            "count from 0",
        )
    low, last = batch.start.take(curve), batch.start.take(curve + 1) - 1
    if guess is None:
        t = _inside(t, batch.knot.take(last))
        segment = last_not_above(batch.knot, low, last - 1, t)
        begin, end = batch.knot.take(segment), batch.knot.take(segment + 1)
    else:
        segment = low + guess
        begin, end = (batch.knot.take(at, mode="clip") for at in (segment, segment + 1))
        right = (begin <= t) & (t < end) & (segment >= low) & (segment < last)
        rest = np.flatnonzero(~right)
        if len(rest):
            t = t.copy()
            t[rest] = _inside(t[rest], batch.knot.take(last[rest]), rest)
            segment[rest] = last_not_above(batch.knot, low[rest], last[rest] - 1, t[rest])
            begin[rest], end[rest] = batch.knot[segment[rest]], batch.knot[segment[rest] + 1]
    length = end - begin
    fraction = np.where(t == end, 1.0, (t - begin) / length)
    return segment, fraction, length


def last_not_above(
    values: FloatArray, low: IntArray, high: IntArray, wanted: FloatArray
) -> IntArray:
    """Find the last of ascending values from `low` to `high` that is not above what is `wanted`.

    All (k,); `low` where there is none. The search is exact in the values' bits.
    """
    while (high > low).any():
        middle = (low + high + 1) // 2
        reached = values[middle] <= wanted
        low = np.where(reached, middle, low)
        high = np.where(reached, high, middle - 1)
    return low


def _inside(t: FloatArray, end: FloatArray, place: IntArray | None = None) -> FloatArray:
    outside = ~((t >= -_OVERSHOOT) & (t <= end + _OVERSHOOT))
    if outside.any():
        worst = int(np.flatnonzero(outside)[0])
        raise BadInputError(
            f"parameter {t[worst]} lies outside 0 to {end[worst]} m",
            f"at place {worst if place is None else place[worst]} of the parameters",
            "ask within the curve",
        )
    result: FloatArray = np.clip(t, 0.0, end)
    return result


def _checked_places(curve: ArrayLike, t: ArrayLike) -> tuple[IntArray, FloatArray]:
    """Give curves and parameters as arrays of one shape."""
    which, at = np.asarray(curve), np.asarray(t, np.float64)
    if which.ndim != 1 or which.shape != at.shape:
        raise BadInputError(
            f"curves of shape {which.shape} and parameters of shape {at.shape}",
            "where places on curves were asked",
            "give one curve index and one parameter per place",
        )
    if which.size and (which.dtype.kind not in "iu" or which.min() < 0):
        raise BadInputError(
            f"{which.tolist()[:5]} are not all curve indices",
            "where places on curves were asked",
            "give whole numbers from 0",
        )
    return which.astype(np.int64), at


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


def evaluate_with_slope(
    batch: SplineBatch, curve: IntArray, t: FloatArray, guess: NDArray[np.integer] | None = None
) -> tuple[FloatArray, FloatArray]:
    """Give points (k, 3), m, and first derivatives (k, 3): the bits of `evaluate` and `derivative`.

    Parameters are looked up once; `guess` as for `derivative`. Not frozen.
    """
    segment, fraction, length = locate_by_knots(batch, curve, t, guess)
    origin, first, second, third = _powers(batch, segment)
    slope = (first + fraction * (2.0 * second + fraction * (3.0 * third))) / length
    place = origin + fraction * (first + fraction * (second + fraction * third))
    _put_ends(batch, segment, fraction, place)
    return place.T, slope.T


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
    >>> from assoc_hull.geometry.splines.segments import curvature
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
    >>> from assoc_hull.geometry.splines.segments import space_curvature
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
    >>> from assoc_hull.geometry.splines.segments import plane_curvature
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
