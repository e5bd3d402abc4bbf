"""Points, derivatives and polylines of cubic composite splines.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.curves import CurveData
>>> from assoc_hull.geometry.splines.loft import loft
>>> from assoc_hull.geometry.splines.evaluation import derivative
>>> spline = loft(CurveData.single(np.array([[0.0, 0, 0], [3, 4, 0]])))
>>> derivative(spline, np.array([0]), np.array([1.0]))
array([[0.6, 0.8, 0. ]])
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.geometry.splines.segments import on_knots, segment_start

__all__ = ["derivative", "evaluate", "positions", "sample"]


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
    segment, fraction, _ = on_knots(batch, curve, t)
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
    segment, fraction, length = on_knots(batch, curve, t, guess)
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
