"""The shapes of many curves as one batch, for pictures and measures that look at all of them."""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.geometry.curves import IntArray, SplineBatch, freeze
from assoc_hull.model.tables import HullState

__all__ = ["Shapes", "joined", "lofted_curves", "shapes_of"]


@attrs.frozen(eq=False)
class Shapes:
    """Curves of a hull as one batch.

    Attributes
    ----------
    curves : (m,) int
        Their numbers, ascending.
    spline : SplineBatch
        Their splines, in that order.
    """

    curves: IntArray
    spline: SplineBatch


def shapes_of(state: HullState) -> Shapes:
    """Give all curves that have a shape."""
    curves = lofted_curves(state)
    freeze(curves)
    return Shapes(curves, joined([state.spline(curve) for curve in curves.tolist()]))


def lofted_curves(state: HullState) -> IntArray:
    """Give the curves that have a shape, ascending."""
    held = state.curves.spline.data
    return np.array([each for each in state.live("curves").tolist() if held[each] is not None], int)


def joined(splines: Sequence[SplineBatch]) -> SplineBatch:
    """Put curves into one batch; there may be none."""
    if splines:
        return SplineBatch.join(list(splines))
    nowhere = np.zeros((0, 3))
    return SplineBatch(np.zeros(1, np.int64), np.zeros(0), nowhere, nowhere.copy(), nowhere.copy())
