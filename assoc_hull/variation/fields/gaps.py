"""The least gap between two boundary curves, by bounds that cannot miss it.

Both curves give exact bounds of value and slope on any interval. An interval whose lower bound
lies above the least gap met so far is put aside, every other one is halved.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.fields.piecewise_linear import Course

__all__ = ["check_gaps", "least_gap"]

_NEAR = 1e-9
"""The least gap is known to so many m."""

_ROUNDS = 60


def least_gap(lower: Course, upper: Course) -> tuple[float, float]:
    """Give where one curve comes nearest to the one above it, and how near.

    Parameters
    ----------
    lower, upper : Course
        Heights, m, over x.

    Returns
    -------
    x, gap : float, m
        The least gap to 1e-9 m; negative where the curves cross.

    Examples
    --------
    >>> from assoc_hull.variation.fields.piecewise_linear import Chain
    >>> from assoc_hull.variation.fields.gaps import least_gap
    >>> x, gap = least_gap(Chain.constant(4.0), Chain.through([0, 10, 20], [6, 4.5, 7]))
    >>> round(x, 6), round(gap, 9)
    (10.0, 0.5)
    """
    nodes = np.unique(np.concatenate([lower.nodes, upper.nodes]))
    gaps = upper.at(nodes) - lower.at(nodes)
    first = int(np.argmin(gaps))
    place, least = float(nodes[first]), float(gaps[first])
    begin, end = nodes[:-1], nodes[1:]
    for _ in range(_ROUNDS):
        bound, middle, value = _bound(lower, upper, begin, end)
        if len(value) and value.min() < least:
            place, least = float(middle[value.argmin()]), float(value.min())
        left = bound < least - _NEAR
        if not left.any():
            break
        begin, middle, end = begin[left], middle[left], end[left]
        begin, end = np.concatenate([begin, middle]), np.concatenate([middle, end])
    return place, least


def _bound(
    lower: Course, upper: Course, begin: FloatArray, end: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Give the lower bound of the gap on intervals, their middles, and the gap there."""
    middle = 0.5 * (begin + end)
    value = upper.at(middle) - lower.at(middle)
    plain = upper.bounds(begin, end)[0] - lower.bounds(begin, end)[1]
    rise, fall = upper.slope_bounds(begin, end), lower.slope_bounds(begin, end)
    steepest = np.maximum(rise[1] - fall[0], fall[1] - rise[0])
    return np.maximum(plain, value - 0.5 * (end - begin) * steepest), middle, value


def check_gaps(field: str, stack: Sequence[tuple[str, Course]]) -> None:
    """Refuse boundary curves of a field that touch or cross anywhere.

    Raises
    ------
    BadInputError
        With both names, the place and the gap there.
    """
    for (below, lower), (above, upper) in pairwise(stack):
        x, gap = least_gap(lower, upper)
        if not gap > _NEAR:
            raise BadInputError(
                f"boundary curves '{below}' and '{above}' of field '{field}' touch at x={x:.3f} "
                f"(gap {gap:.3g} m)", "in vary", "move one or reduce the range",
            )  # fmt: skip
