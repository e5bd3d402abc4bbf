"""Arc length by Gauss-Legendre rules of eight points, segments halved until they agree.

Source: H.J. Son, H.C. Kim, "hull form parameter modules for performance analysis", J. of
CAD/CAM (Korea) 13(6), 2008; the control of the error by halving is our own.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.geometry.numeric.polynomials import differentiate
from assoc_hull.geometry.numeric.roots import unit_roots
from assoc_hull.geometry.numeric.vectors import dot
from assoc_hull.geometry.splines.segments import locate, power, segment_curve, sum_per_curve

__all__ = ["arc_length", "length_at", "length_until", "segment_length"]

_ROOTS, _WEIGHTS = np.polynomial.legendre.leggauss(8)
_NODES, _WEIGHTS = 0.5 + 0.5 * _ROOTS, 0.5 * _WEIGHTS
_AGREEMENT = 1e-12  # of the length of the segment
_HALVINGS = 40  # parts of 1e-12 of a segment
_SLOW = 0.05  # of the greatest speed: where it all but vanishes, rules agree by chance
_NEAR = np.concatenate([[0.0], *([-step, step] for step in 0.5 ** np.arange(1, 31))])


def segment_length(batch: SplineBatch) -> FloatArray:
    """Give the arc length of each segment.

    Parameters
    ----------
    batch : SplineBatch
        The curves.

    Returns
    -------
    (s,), m
        Lengths, segment by segment; relative error 1e-12.

    Raises
    ------
    TooFewPointsError
        A curve has fewer than two points.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.curves import SplineBatch
    >>> from assoc_hull.geometry.splines.length import segment_length
    >>> xyz = np.array([[0.0, 0, 0], [3, 4, 0]])
    >>> along = np.array([[0.6, 0.8, 0], [0.6, 0.8, 0]])
    >>> line = SplineBatch(np.array([0, 2]), np.array([0.0, 5]), xyz, along, along.copy())
    >>> segment_length(line).round(12).tolist()
    [5.0]
    """
    slopes = differentiate(power(batch))
    lengths = _adaptive(slopes, np.ones(len(slopes)))
    freeze(lengths)
    return lengths


def arc_length(batch: SplineBatch) -> FloatArray:
    """Give the arc length of each curve.

    Parameters
    ----------
    batch : SplineBatch
        The curves.

    Returns
    -------
    (m,), m
        Lengths; relative error 1e-12.

    Raises
    ------
    TooFewPointsError
        A curve has fewer than two points.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.curves import SplineBatch
    >>> from assoc_hull.geometry.splines.length import arc_length
    >>> xyz = np.array([[0.0, 0, 0], [3, 4, 0]])
    >>> along = np.array([[0.6, 0.8, 0], [0.6, 0.8, 0]])
    >>> line = SplineBatch(np.array([0, 2]), np.array([0.0, 5]), xyz, along, along.copy())
    >>> arc_length(line).round(12).tolist()
    [5.0]
    """
    return sum_per_curve(batch, segment_length(batch))


def length_at(batch: SplineBatch, curve: ArrayLike, t: ArrayLike) -> FloatArray:
    """Give the arc length from the beginning of a curve to given parameters.

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
    (k,), m
        Lengths; error 1e-12 of the length of the curve.

    Raises
    ------
    BadInputError
        There is no such curve, or a parameter lies off its curve.
    TooFewPointsError
        A curve has fewer than two points.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.curves import SplineBatch
    >>> from assoc_hull.geometry.splines.length import length_at
    >>> xyz = np.array([[0.0, 0, 0], [3, 4, 0]])
    >>> along = np.array([[0.6, 0.8, 0], [0.6, 0.8, 0]])
    >>> line = SplineBatch(np.array([0, 2]), np.array([0.0, 5]), xyz, along, along.copy())
    >>> length_at(line, [0, 0], [1.0, 5.0]).round(12).tolist()
    [1.0, 5.0]
    """
    segment, u = locate(batch, curve, t)
    slopes = differentiate(power(batch))
    lengths = _before(batch)[segment] + _adaptive(slopes[segment], u)
    freeze(lengths)
    return lengths


def length_until(slopes: FloatArray, u: FloatArray) -> FloatArray:
    """Give the arc length of cubics from their beginning to given parameters.

    Parameters
    ----------
    slopes : (p, 3, 3), m
        Coefficients of the derivative of each cubic, in 1, u, u^2.
    u : (p,)
        From 0 to 1.

    Returns
    -------
    (p,), m
        Lengths; relative error 1e-12.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.splines.length import length_until
    >>> straight = np.zeros((1, 3, 3))
    >>> straight[0, 0] = [3.0, 4.0, 0.0]
    >>> length_until(straight, np.array([0.5])).round(12).tolist()
    [2.5]
    """
    lengths = _adaptive(slopes, u)
    freeze(lengths)
    return lengths


def _before(batch: SplineBatch) -> FloatArray:
    """Give the length of each curve before each of its segments, (s,)."""
    owner = segment_curve(batch)
    place = np.arange(len(owner)) - (batch.start[:-1] - np.arange(batch.count))[owner]
    # One row per curve, so that no curve's sums carry the rounding of another's.
    table = np.zeros((batch.count, int(place.max(initial=0)) + 2))
    table[owner, place + 1] = segment_length(batch)
    sums: FloatArray = np.cumsum(table, axis=1)[owner, place]
    return sums


def _gauss(slopes: FloatArray, low: FloatArray, high: FloatArray) -> FloatArray:
    """Integrate the speed over the parts [low, high] of segments, (p,)."""
    integral: FloatArray = (_speed(slopes, low, high) * _WEIGHTS).sum(axis=1) * (high - low)
    return integral


def _speed(slopes: FloatArray, low: FloatArray, high: FloatArray) -> FloatArray:
    """Give the speed at the nodes of the rule on the parts [low, high], (p, 8)."""
    u = low[:, None] + (high - low)[:, None] * _NODES
    squared = np.zeros_like(u)
    for axis in range(3):
        constant, linear, square = (slopes[:, row, axis, None] for row in range(3))
        speed = (square * u + linear) * u + constant
        squared += speed * speed
    found: FloatArray = np.sqrt(squared)
    return found


def _adaptive(slopes: FloatArray, until: FloatArray) -> FloatArray:
    """Give the lengths of segments from u = 0 to `until`, (p,)."""
    begin = np.zeros(len(until))
    speed = _speed(slopes, begin, until)
    whole = (speed * _WEIGHTS).sum(axis=1) * until
    halves = _gauss(slopes, begin, 0.5 * until) + _gauss(slopes, 0.5 * until, until)
    agree = np.abs(halves - whole) <= _AGREEMENT * halves
    hard = np.flatnonzero(~agree | (speed.min(axis=1) < _SLOW * speed.max(axis=1)))
    if len(hard):
        edge = _graded(_slowest(slopes[hard]), until[hard])
        item = np.repeat(np.arange(len(hard)), edge.shape[1] - 1)
        low, high = edge[:, :-1].ravel(), edge[:, 1:].ravel()
        halves[hard] = _halved(slopes[hard], item, low, high, _AGREEMENT * halves[hard])
    return halves


def _graded(slowest: FloatArray, until: FloatArray) -> FloatArray:
    """Give where to cut segments: at those places, and ever closer to them, (p, k)."""
    near = (slowest[:, :, None] + _NEAR).reshape(len(until), -1)
    return np.asarray(np.sort(np.clip(near, 0.0, until[:, None]), axis=1))


def _slowest(slopes: FloatArray) -> FloatArray:
    """Give 0, the places where the speed is least or greatest, and 1, (p, 5).

    At a cusp the speed has a corner, at which a rule agrees with its halves by chance.
    """
    gain = np.zeros((len(slopes), 4))
    second = differentiate(slopes)
    for i in range(3):
        for j in range(2):
            gain[:, i + j] += dot(slopes[:, i], second[:, j])
    end = np.ones((len(slopes), 1))
    return np.concatenate([0.0 * end, unit_roots(gain), end], axis=1)


def _halved(
    slopes: FloatArray, item: IntArray, low: FloatArray, high: FloatArray, limit: FloatArray
) -> FloatArray:
    """Add up the lengths of parts per item, each halved until it agrees with its halves."""
    total = np.zeros(len(limit))
    whole = _gauss(slopes[item], low, high)
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        left = _gauss(slopes[item], low, middle)
        right = _gauss(slopes[item], middle, high)
        wide = ~(np.abs(left + right - whole) <= limit[item])
        np.add.at(total, item[~wide], (left + right)[~wide])
        if not wide.any():
            return total
        item = np.tile(item[wide], 2)
        low = np.concatenate([low[wide], middle[wide]])
        high = np.concatenate([middle[wide], high[wide]])
        whole = np.concatenate([left[wide], right[wide]])
    np.add.at(total, item, whole)
    return total
