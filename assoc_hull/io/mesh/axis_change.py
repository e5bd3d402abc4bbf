"""The change of axes from a file to the ship: axes exchanged or mirrored, and a shift."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray

__all__ = ["AxisChange"]


@attrs.frozen(eq=False)
class AxisChange:
    """From the file to the ship: ``xyz @ turn + shift``; `turn` exchanges and mirrors axes."""

    turn: FloatArray
    shift: FloatArray

    @classmethod
    def between(cls, before: FloatArray, after: FloatArray) -> AxisChange:
        """Find the change that took vertices (n, 3), m, from one place to another."""
        middle = before.mean(axis=0)
        # Turns are by right angles, so that entries are -1, 0 or 1 but for rounding.
        turn = np.rint(np.linalg.lstsq(before - middle, after - after.mean(axis=0))[0])
        return cls(turn + 0.0, np.median(after - before @ turn, axis=0))

    def back(self, xyz: FloatArray) -> FloatArray:
        """Give points in ship axes, (n, 3), m, in axes of the file."""
        return np.asarray((xyz - self.shift) @ self.turn.T)

    def ahead(self, xyz: FloatArray) -> FloatArray:
        """Give points in axes of the file, (n, 3), m, in ship axes."""
        return np.asarray(xyz @ self.turn + self.shift)

    def plane(self, axis: IntArray, offset: FloatArray) -> tuple[IntArray, FloatArray]:
        """Give axis and offset (m) in the file of planes across axes of the ship."""
        column = np.abs(self.turn).argmax(axis=0)
        sign = self.turn[column, np.arange(3)]
        return column[axis], (offset - self.shift[axis]) * sign[axis]
