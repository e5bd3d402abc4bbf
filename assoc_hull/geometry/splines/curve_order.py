"""Order along a curve: where it turns back on itself.

The decision rests on signs of sums of products, so it is the same for a curve whatever
else is in the batch and on whatever machine.
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.geometry.numeric.vectors import dot
from assoc_hull.geometry.splines.segments import segment_start

__all__ = ["CurveFolds", "curve_folds"]


@attrs.frozen(eq=False)
class CurveFolds:
    """Places where curves turn back on themselves, in the order of the curves.

    Attributes
    ----------
    curve : (f,) int
        The curve.
    knot : (f,) int
        The defining point, counted from 0 along the curve.
    cosine : (f,)
        Cosine of the worst angle found there; zero or less. Zero also where the tangent or a
        chord has no length.
    """

    curve: IntArray
    knot: IntArray
    cosine: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.curve, self.knot, self.cosine)

    def __len__(self) -> int:
        return len(self.curve)


def curve_folds(batch: SplineBatch) -> CurveFolds:
    """Find the places where curves turn back on themselves.

    A curve folds at a point that is no knuckle where two consecutive chords make more than
    90 degrees, and at an end of a segment where its tangent makes 90 degrees or more with
    the segment's chord. A knuckle may be as sharp as it likes.

    Parameters
    ----------
    batch : SplineBatch
        The curves.

    Returns
    -------
    CurveFolds
        One entry for each point at which a curve folds; none if all is well.

    Raises
    ------
    TooFewPointsError
        A curve has fewer than two points.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.curves import SplineBatch
    >>> from assoc_hull.geometry.splines.curve_order import curve_folds
    >>> xyz = np.array([[0.0, 0, 0], [3, 0, 0], [2, 1, 0]])
    >>> slope = np.array([[1.0, 0, 0], [0.0, 1, 0], [0, 1, 0]])
    >>> hook = SplineBatch(np.array([0, 3]), np.array([0.0, 3, 4.4]), xyz, slope, slope.copy())
    >>> curve_folds(hook).knot.tolist()
    [1]
    """
    inside = np.zeros(max(len(batch.knot) - 1, 0), np.bool_)
    inside[segment_start(batch)] = True
    # Between two curves of the batch there are chords too; `inside` leaves them out.
    chord, worst = np.diff(batch.xyz, axis=0), np.full(len(batch.knot), np.inf)
    leave, arrive = batch.leave, batch.arrive
    smooth = inside[:-1] & inside[1:]
    for axis in range(3):
        smooth &= leave[1:-1, axis] == arrive[1:-1, axis]
    back = ~(dot(chord[:-1], chord[1:]) >= 0.0)
    _note(worst[1:-1], chord[:-1], chord[1:], smooth & back)
    _note(worst[:-1], leave[:-1], chord, inside & ~(dot(leave[:-1], chord) > 0.0))
    _note(worst[1:], arrive[1:], chord, inside & ~(dot(arrive[1:], chord) > 0.0))
    row = np.flatnonzero(worst < np.inf)
    curve = np.searchsorted(batch.start, row, side="right") - 1
    return CurveFolds(curve, row - batch.start[curve], worst[row])


def _note(worst: FloatArray, left: FloatArray, right: FloatArray, bad: NDArray[np.bool_]) -> None:
    """Lower `worst` to the cosine between the rows `left` and `right` where they are bad."""
    if not bad.any():
        return
    one, other = left[bad], right[bad]
    size = np.sqrt(dot(one, one)) * np.sqrt(dot(other, other))
    cosine = dot(one, other) / np.where(size > 0.0, size, 1.0)
    worst[bad] = np.fmin(worst[bad], cosine)
