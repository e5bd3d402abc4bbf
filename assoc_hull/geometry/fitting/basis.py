"""Cubic B-splines at parameters: the four that are not nil there, and their derivatives.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.fitting.basis import basis_rows, clamped_knots
>>> first, rows = basis_rows(clamped_knots(np.array([0.0, 1.0, 2.0])), np.array([0.0, 1.5]), 1)
>>> first.tolist(), rows[0].sum(axis=1).tolist(), rows[1].sum(axis=1).tolist()
([0, 1], [1.0, 1.0], [0.0, 0.0])
"""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.patches.knots import span_at

__all__ = ["DEGREE", "basis_rows", "clamped_knots"]

DEGREE = 3


def clamped_knots(breaks: FloatArray) -> FloatArray:
    """Give the knots of a cubic spline: its ends four times, what is between as it stands.

    Parameters
    ----------
    breaks : (b,), m
        Where spans meet, with both ends, not falling. One given twice leaves a jump of curvature
        open, one given three times a knuckle.

    Returns
    -------
    (b + 6,), m
        The knots, of b + 2 control points.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.fitting.basis import clamped_knots
    >>> clamped_knots(np.array([0.0, 1.0, 4.0])).tolist()
    [0.0, 0.0, 0.0, 0.0, 1.0, 4.0, 4.0, 4.0, 4.0]
    """
    return np.concatenate([np.repeat(breaks[:1], DEGREE), breaks, np.repeat(breaks[-1:], DEGREE)])


def basis_rows(knots: FloatArray, at: FloatArray, order: int = 0) -> tuple[IntArray, FloatArray]:
    """Give the B-splines that are not nil at parameters, and their derivatives.

    Parameters
    ----------
    knots : (count + 4,), m
        Knots of a cubic spline, each within at most three times.
    at : (k,), m
        Parameters in the domain.
    order : int
        The highest derivative, 0 to 2.

    Returns
    -------
    first : (k,) int
        The number of the first of the four.
    rows : (order + 1, k, 4), 1/m**order
        Values, slopes, second derivatives.

    Notes
    -----
    The recurrence of de Boor and Cox, upwards: a spline of one degree less has a share in two of
    the next (C. de Boor, A Practical Guide to Splines, Springer 1978, chapter X).

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.fitting.basis import basis_rows, clamped_knots
    >>> basis_rows(clamped_knots(np.array([0.0, 2.0])), np.array([1.0]))[1].tolist()
    [[[0.125, 0.375, 0.375, 0.125]]]
    """
    span = span_at(knots, DEGREE, at)
    degrees = [np.ones((len(at), 1))]
    for degree in range(1, DEGREE + 1):
        degrees.append(_raised(degrees[-1], knots, span, at, degree))
    rows = [degrees[DEGREE]]
    for derivative in range(1, order + 1):
        found = degrees[DEGREE - derivative]
        for degree in range(DEGREE - derivative + 1, DEGREE + 1):
            found = _differed(found, knots, span, degree)
        rows.append(found)
    return span - DEGREE, np.stack(rows)


def _widths(knots: FloatArray, span: IntArray, degree: int) -> tuple[FloatArray, FloatArray]:
    """Give where splines of degree - 1 begin, and how wide they are, (k, degree)."""
    left = span[:, None] + np.arange(1 - degree, 1)
    low = knots[left]
    return low, knots[left + degree] - low


def _raised(
    lower: FloatArray, knots: FloatArray, span: IntArray, at: FloatArray, degree: int
) -> FloatArray:
    """Give splines of a degree from those of the degree below."""
    low, width = _widths(knots, span, degree)
    share = (at[:, None] - low) / width * lower
    found = np.zeros((len(at), degree + 1))
    found[:, 1:] = share
    found[:, :-1] += lower - share
    return found


def _differed(lower: FloatArray, knots: FloatArray, span: IntArray, degree: int) -> FloatArray:
    """Give slopes of splines of a degree from values of the degree below."""
    share = degree * lower / _widths(knots, span, degree)[1]
    found = np.zeros((len(span), degree + 1))
    found[:, 1:] = share
    found[:, :-1] -= share
    return found
