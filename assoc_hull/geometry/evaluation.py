"""Points, derivatives, polylines and Bezier points of cubic composite splines.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.curves import CurveData
>>> from assoc_hull.geometry.spline import loft
>>> from assoc_hull.geometry.evaluation import derivative
>>> spline = loft(CurveData.single(np.array([[0.0, 0, 0], [3, 4, 0]])))
>>> derivative(spline, np.array([0]), np.array([1.0]))
array([[0.6, 0.8, 0. ]])
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.geometry.tridiagonal import slots_of

__all__ = ["control_points", "derivative", "evaluate", "positions", "sample", "segments"]

_SLACK = 1e-9
"""A parameter may lie this far (m) outside its curve and is then taken as the end."""


def segments(batch: SplineBatch) -> IntArray:
    """Give the knot index where each segment starts.

    Parameters
    ----------
    batch : SplineBatch
        The curves.

    Returns
    -------
    (s,) int
        Ascending; frozen.

    Examples
    --------
    >>> from assoc_hull.geometry.spline import loft
    >>> from assoc_hull.geometry.curves import CurveData
    >>> line = loft(CurveData.single(np.array([[0.0, 0, 0], [1, 0, 0], [2, 0, 0]])))
    >>> segments(SplineBatch.join([line, line]))
    array([0, 1, 3, 4])
    """
    result: IntArray = np.flatnonzero(~slots_of(batch.start).is_last)
    freeze(result)
    return result


def positions(batch: SplineBatch, segment: IntArray, fraction: FloatArray) -> FloatArray:
    """Give the points at a fraction of the parameter interval of given segments.

    Parameters
    ----------
    batch : SplineBatch
        The curves.
    segment : (k,) int
        Knot index where the segment starts.
    fraction : (k,)
        0 at the start and 1 at the end of the segment: exactly the knots.

    Returns
    -------
    (3, k), m
        The points, coordinate by coordinate; not frozen.

    Examples
    --------
    >>> from assoc_hull.geometry.spline import loft
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
    >>> from assoc_hull.geometry.spline import loft
    >>> from assoc_hull.geometry.curves import CurveData
    >>> line = loft(CurveData.single(np.array([[0.0, 0, 0], [2, 0, 0]])))
    >>> evaluate(line, np.array([0, 0]), np.array([0.5, 2.0]))
    array([[0.5, 0. , 0. ],
           [2. , 0. , 0. ]])
    """
    segment, fraction, _ = _locate(batch, curve, t)
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
    >>> from assoc_hull.geometry.spline import loft
    >>> from assoc_hull.geometry.curves import CurveData
    >>> line = loft(CurveData.single(np.array([[0.0, 0, 0], [2, 0, 0]])))
    >>> derivative(line, np.array([0]), np.array([0.5]), order=1)
    array([[1., 0., 0.]])
    """
    if order not in (1, 2, 3):
        raise BadInputError(f"order {order} was asked", "in derivative", "ask for 1, 2 or 3")
    segment, fraction, length = _locate(batch, curve, t, guess)
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


def _locate(
    batch: SplineBatch, curve: IntArray, t: FloatArray, guess: NDArray[np.integer] | None = None
) -> tuple[IntArray, FloatArray, FloatArray]:
    """Find segment, fraction and segment length; the search is exact in the knots' bits."""
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
        segment = _search(batch, low, last - 1, t)
        begin, end = batch.knot.take(segment), batch.knot.take(segment + 1)
    else:
        segment = low + guess
        begin, end = (batch.knot.take(at, mode="clip") for at in (segment, segment + 1))
        right = (begin <= t) & (t < end) & (segment >= low) & (segment < last)
        rest = np.flatnonzero(~right)
        if len(rest):
            t = t.copy()
            t[rest] = _inside(t[rest], batch.knot.take(last[rest]), rest)
            segment[rest] = _search(batch, low[rest], last[rest] - 1, t[rest])
            begin[rest], end[rest] = batch.knot[segment[rest]], batch.knot[segment[rest] + 1]
    length = end - begin
    fraction = np.where(t == end, 1.0, (t - begin) / length)
    return segment, fraction, length


def _search(batch: SplineBatch, low: IntArray, high: IntArray, t: FloatArray) -> IntArray:
    """Find the last knot not above each parameter, between given ones."""
    while (high > low).any():
        middle = (low + high + 1) // 2
        reached = batch.knot[middle] <= t
        low = np.where(reached, middle, low)
        high = np.where(reached, high, middle - 1)
    return low


def _inside(t: FloatArray, end: FloatArray, place: IntArray | None = None) -> FloatArray:
    outside = ~((t >= -_SLACK) & (t <= end + _SLACK))
    if outside.any():
        worst = int(np.flatnonzero(outside)[0])
        raise BadInputError(
            f"parameter {t[worst]} lies outside 0 to {end[worst]} m",
            f"at place {worst if place is None else place[worst]} of the parameters",
            "ask within the curve",
        )
    result: FloatArray = np.clip(t, 0.0, end)
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
    >>> from assoc_hull.geometry.spline import loft
    >>> from assoc_hull.geometry.curves import CurveData
    >>> line = loft(CurveData.single(np.array([[0.0, 0, 0], [2, 0, 0]])))
    >>> sample(line, per_segment=2)[1][:, 0]
    array([0., 1., 2.])
    """
    if per_segment < 1:
        raise BadInputError(f"{per_segment} chords were asked", "in sample", "ask for 1 or more")
    begins = segments(batch)
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


def control_points(batch: SplineBatch) -> tuple[IntArray, FloatArray]:
    """Give the Bezier points of every segment.

    Parameters
    ----------
    batch : SplineBatch
        The curves.

    Returns
    -------
    segment : (s,) int
        Knot index where each segment starts.
    points : (s, 4, 3), m
        Its Bezier points; both frozen.

    Examples
    --------
    >>> from assoc_hull.geometry.spline import loft
    >>> from assoc_hull.geometry.curves import CurveData
    >>> line = loft(CurveData.single(np.array([[0.0, 0, 0], [3, 0, 0]])))
    >>> control_points(line)[1][0, :, 0]
    array([0., 1., 2., 3.])
    """
    segment = segments(batch)
    after = segment + 1
    third = ((batch.knot[after] - batch.knot[segment]) / 3.0)[:, None]
    points = np.empty((len(segment), 4, 3))
    points[:, 0] = batch.xyz[segment]
    points[:, 1] = points[:, 0] + third * batch.leave[segment]
    points[:, 3] = batch.xyz[after]
    points[:, 2] = points[:, 3] - third * batch.arrive[after]
    freeze(points)
    return segment, points
