"""States of a search for chains of arcs: places on curves, the directions there, how they came.

Arrays are (a, s): s states of each of a pieces. One that is none lies at -inf.
"""

from __future__ import annotations

from typing import Self

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray

__all__ = ["Found", "States"]

_COUNT = 24
_MOST_TILT = 24.0
"""Widest tilt that is kept, in units of the tolerance over the longest arc now."""
_LAG = 1.0
"""How far behind the best a state may lie, in units of the longest arc now."""


@attrs.frozen(eq=False)
class States:
    """States after so many arcs.

    Attributes
    ----------
    w : (a, s)
        Parameters on the pieces.
    angle : (a, s), rad
        Directions of the chains there.
    way : (a, s), m
        Length of the last arc, about.
    parent : (a, s) int
        The state it came from: of one arc before, or of two where `ratio` is a number.
    ratio : (a, s)
        Of the biarc that led here; nan where one arc did.
    hope : (a, s), m
        How far it lies along the curves, and about what the next arc will add.
    """

    w: FloatArray
    angle: FloatArray
    way: FloatArray
    parent: IntArray
    ratio: FloatArray
    hope: FloatArray

    @classmethod
    def begin(cls, w: FloatArray, angle: FloatArray, way: FloatArray) -> Self:
        """Give the one state of each piece at its beginning; all (a,)."""
        shape = (len(w), 1)
        return cls(
            w[:, None], angle[:, None], way[:, None], np.zeros(shape, np.int64),
            np.full(shape, np.nan), np.zeros(shape),
        )  # fmt: skip

    def of(self, rows: IntArray | NDArray[np.bool_]) -> States:
        """Give the states of some pieces."""
        return States(*(each[rows] for each in attrs.astuple(self, recurse=False)))

    def put(self, rows: IntArray, other: States) -> States:
        """Give these states, with those of some pieces taken from others."""
        columns = [each.copy() for each in attrs.astuple(self, recurse=False)]
        for mine, new in zip(columns, attrs.astuple(other, recurse=False), strict=True):
            mine[rows] = new
        return States(*columns)

    @property
    def some(self) -> NDArray[np.bool_]:
        """Which pieces have a state, (a,)."""
        return np.asarray(np.isfinite(self.w).any(axis=1))


@attrs.frozen(eq=False)
class Found:
    """Ends that were tried, (a, n): as in `States`, and whether they keep the limits.

    Attributes
    ----------
    t : (a, n), m
        How far they lie along the curves.
    tilt : (a, n), rad
        From the direction of the curve.
    """

    w: FloatArray
    angle: FloatArray
    way: FloatArray
    parent: IntArray
    ratio: FloatArray
    t: FloatArray
    tilt: FloatArray
    good: NDArray[np.bool_]

    def join(self, other: Found) -> Found:
        """Give both."""
        pairs = zip(attrs.astuple(self, recurse=False), attrs.astuple(other, recurse=False),
                    strict=True)  # fmt: skip
        return Found(*(np.concatenate(pair, axis=1) for pair in pairs))

    def choose(self, within: float) -> States:
        """Keep for each range of tilts the end that is farthest; `within` in m.

        A wide tilt makes the next arcs short, and no single arc makes it less. So ranges are finer
        about nil, and what lags behind with all that may be hoped for is left out.
        """
        long = np.where(self.good, self.way, 1e-300).max(axis=1, keepdims=True)
        most = _MOST_TILT * within / long
        size = np.abs(self.tilt)
        hope = self.t + np.minimum(long, 4.0 * within / np.maximum(size, 1e-12))
        good = self.good & (size <= most)
        best = np.where(good, hope, -np.inf).max(axis=1, keepdims=True)
        good &= hope >= best - _LAG * long
        part = 1.0 + np.sign(self.tilt) * np.sqrt(np.minimum(size / most, 1.0))
        number = np.where(good, np.minimum((part * 0.5 * _COUNT).astype(np.int64), _COUNT - 1), -1)
        far = np.where(good, self.t, -np.inf)
        column = np.stack(
            [np.argmax(np.where(number == b, far, -np.inf), axis=1) for b in range(_COUNT)], axis=1
        )
        row = np.arange(len(far))[:, None]
        real = number[row, column] == np.arange(_COUNT)
        w, angle, way, parent, ratio = (
            each[row, column] for each in (self.w, self.angle, self.way, self.parent, self.ratio)
        )
        return States(
            np.where(real, w, -np.inf), angle, way, parent, ratio,
            np.where(real, hope[row, column], -np.inf),
        )  # fmt: skip
