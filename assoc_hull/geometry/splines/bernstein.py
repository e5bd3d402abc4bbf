"""The height of curves over a plane, segment by segment, in Bernstein form.

Along a segment the height is a cubic. Its four Bernstein coefficients enclose its range,
and if their three differences have one sign, the height is monotone.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.splines.bernstein import heights
>>> from assoc_hull.geometry.curves import CurveData
>>> from assoc_hull.geometry.splines.loft import loft
>>> line = loft(CurveData.single(np.array([[0.0, 0, 1], [0, 3, 1], [0, 3, 5]])))
>>> heights(line, np.array([0.0, 0.0, 1.0])).rise
array([0., 4.])
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch

__all__ = ["Heights", "heights", "stationary", "value"]


@attrs.frozen(eq=False)
class Heights:
    """Height of a batch of splines over a plane through the origin.

    Segment i runs from knot i to knot i + 1; those that run from one curve to the next are
    there but mean nothing.

    Attributes
    ----------
    knot : (n,), m
        Height at each knot.
    rise : (n - 1,), m
        Height gained over each segment.
    first, last : (n - 1,), m
        Derivative with respect to the fraction of the segment, at its start and its end.
    """

    knot: FloatArray
    rise: FloatArray
    first: FloatArray
    last: FloatArray

    def powers(self, segment: IntArray) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """Give the coefficients of 1, u, u**2, u**3 of some segments.

        Parameters
        ----------
        segment : (k,) int
            The segments.

        Returns
        -------
        four (k,), m
            The coefficients.

        Examples
        --------
        >>> one = np.array([1.0])
        >>> Heights(np.array([0.0, 1.0]), one, one, one).powers(np.array([0]))[1]
        array([1.])
        """
        first = self.first.take(segment)
        rise = self.rise.take(segment)
        both = first + self.last.take(segment)
        return self.knot.take(segment), first, (3.0 * rise - first) - both, both - 2.0 * rise


def heights(batch: SplineBatch, normal: FloatArray) -> Heights:
    """Give the height of curves over the plane through the origin.

    Parameters
    ----------
    batch : SplineBatch
        The curves.
    normal : (3,)
        Unit normal of the plane.

    Returns
    -------
    Heights
        Height of the knots and the derivatives of every segment.

    Examples
    --------
    >>> from assoc_hull.geometry.splines.loft import loft
    >>> from assoc_hull.geometry.curves import CurveData
    >>> line = loft(CurveData.single(np.array([[0.0, 0, 1], [0, 3, 1]])))
    >>> heights(line, np.array([0.0, 0.0, 1.0])).knot
    array([1., 1.])
    """
    length = batch.knot[1:] - batch.knot[:-1]
    knot = _along(batch.xyz, normal)
    first = _along(batch.leave, normal)[:-1] * length
    last = _along(batch.arrive, normal)[1:] * length
    return Heights(knot, knot[1:] - knot[:-1], first, last)


def _along(vectors: FloatArray, normal: FloatArray) -> FloatArray:
    """Give the component of vectors along the normal, in one fixed order of operations."""
    parts = normal.tolist()
    if parts.count(0.0) == 2 and 1.0 in parts:
        return np.ascontiguousarray(vectors[:, parts.index(1.0)])
    result: FloatArray = vectors[:, 0] * normal[0]
    result += vectors[:, 1] * normal[1]
    result += vectors[:, 2] * normal[2]
    return result


def value(
    origin: FloatArray,
    first: FloatArray,
    second: FloatArray,
    third: FloatArray,
    fraction: FloatArray,
) -> FloatArray:
    """Evaluate cubics given by their powers, by Horner's rule.

    Parameters
    ----------
    origin, first, second, third : (k,), any unit
        Coefficients of 1, u, u**2, u**3.
    fraction : (k,)
        The arguments u.

    Returns
    -------
    (k,), the unit of the coefficients
        The values.

    Examples
    --------
    >>> value(*np.array([[1.0], [1.0], [0.0], [2.0]]), np.array([0.5]))
    array([1.75])
    """
    result = third * fraction
    result += second
    result *= fraction
    result += first
    result *= fraction
    result += origin
    return result


def stationary(
    first: FloatArray, second: FloatArray, third: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Cut cubics into three parts that are monotone.

    Parameters
    ----------
    first, second, third : (k,), any unit
        Coefficients of u, u**2, u**3.

    Returns
    -------
    lower, upper : (k,)
        Fractions ``0 <= lower <= upper <= 1`` where the derivative is nil; a fraction that
        is not needed is 0 or 1.

    Examples
    --------
    >>> stationary(np.array([3.0]), np.array([-8.0]), np.array([4.0]))
    (array([0.]), array([0.2257]))
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        # Sum of equal signs only, so that neither root loses digits.
        root = np.sqrt(second * second - 3.0 * (third * first))
        sum_ = -(second + np.copysign(root, second))
        one, other = sum_ / (3.0 * third), first / sum_
    one = np.where((one > 0.0) & (one < 1.0), one, 0.0)
    other = np.where((other > 0.0) & (other < 1.0), other, 0.0)
    lower, upper = np.minimum(one, other), np.maximum(one, other)
    return lower, np.where(upper > 0.0, upper, 1.0)
