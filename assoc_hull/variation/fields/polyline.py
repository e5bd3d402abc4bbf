"""Straight lines from node to node, level outside: the classical shift by 1 - CP."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = ["Polyline"]


@attrs.frozen(eq=False)
class Polyline:
    """A course of straight lines; its slope jumps at the nodes.

    Attributes
    ----------
    x : (k,), m
        Nodes, rising.
    v : (k,)
        Values there.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.variation.fields.polyline import Polyline
    >>> Polyline(np.array([0.0, 10.0]), np.array([1.0, 0.0])).at(np.array([-1.0, 4.0])).tolist()
    [1.0, 0.6]
    """

    x: FloatArray
    v: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.x, self.v)

    @property
    def nodes(self) -> FloatArray:
        """Where lines join, rising."""
        return self.x

    @property
    def degree(self) -> int:
        """That of straight lines."""
        return 1

    def scaled(self, factor: float) -> Polyline:
        """Give the course times a factor."""
        return Polyline(self.x.copy(), self.v * factor)

    def _piece(self, x: FloatArray) -> np.typing.NDArray[np.int64]:
        return np.clip(np.searchsorted(self.x, x, side="right") - 1, 0, len(self.x) - 2)

    def at(self, x: FloatArray) -> FloatArray:
        """Give values; those of the ends outside, to the last bit."""
        i = self._piece(x)
        within = np.clip(x, self.x[0], self.x[-1])
        inner = self.v[i] + (within - self.x[i]) * self._slopes[i]
        below = np.where(x <= self.x[0], self.v[0], inner)
        return np.where(x >= self.x[-1], self.v[-1], below)

    @property
    def _slopes(self) -> FloatArray:
        return np.asarray(np.diff(self.v) / np.diff(self.x))

    def slope(self, x: FloatArray) -> FloatArray:
        """Give first derivatives, at a node that of the line forward of it; nil outside."""
        inside = (x >= self.x[0]) & (x < self.x[-1])
        return np.where(inside, self._slopes[self._piece(x)], 0.0)

    def bounds(self, low: FloatArray, high: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give least and greatest value on intervals: of both ends and the nodes between."""
        return self._within(low, high, self.at(low), self.at(high), self.x, self.x, self.v)

    def slope_bounds(self, low: FloatArray, high: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give least and greatest slope on intervals: of all lines that they meet."""
        ends = self.slope(np.asarray(low)), self.slope(np.asarray(high))
        return self._within(low, high, *ends, self.x[:-1], self.x[1:], self._slopes)

    def _within(
        self, low: FloatArray, high: FloatArray, first: FloatArray, last: FloatArray,
        begin: FloatArray, end: FloatArray, values: FloatArray,
    ) -> tuple[FloatArray, FloatArray]:  # fmt: skip
        low, high = np.asarray(low, np.float64), np.asarray(high, np.float64)
        least, most = np.minimum(first, last), np.maximum(first, last)
        for i, value in enumerate(values.tolist()):
            met = (low <= end[i]) & (begin[i] <= high)
            least = np.where(met, np.minimum(least, value), least)
            most = np.where(met, np.maximum(most, value), most)
        return least, most
