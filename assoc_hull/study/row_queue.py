"""The rows that are still to be made, handed out in batches that take about as long as is wanted.

A batch is what one process makes without being asked: long ones save messages, short ones are lost
less of when a process dies, and are shared out more evenly. So the first has one row, and each that
comes back says how long the next may be.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import IntArray

__all__ = ["MOST_ROWS", "RowQueue"]

MOST_ROWS = 64
"""Rows of a batch."""


@attrs.define(eq=False)
class RowQueue:
    """Rows that are to be made.

    Attributes
    ----------
    left : (n,) int
        Their numbers, rising.
    sharers : int
        Processes that make them.
    seconds : float
        How long a batch is to take.
    """

    left: IntArray
    sharers: int = 1
    seconds: float = 0.5
    _size: int = 1
    _next: int = 0
    _back: list[tuple[int, ...]] = attrs.field(factory=list)

    def take(self) -> tuple[int, ...]:
        """Give the numbers of the next batch; empty if there is none."""
        if self._back:
            return self._back.pop()
        share = -(-(len(self.left) - self._next) // (2 * self.sharers))
        size = max(1, min(self._size, MOST_ROWS, share))
        found = tuple(self.left[self._next : self._next + size].tolist())
        self._next += len(found)
        return found

    def give_back(self, numbers: tuple[int, ...]) -> None:
        """Hand in a batch that was not made."""
        self._back.append(numbers)

    def learn(self, rows: int, seconds: float) -> None:
        """Hear how long a batch has taken; the next ones are at most twice as long as that was."""
        fit = self.seconds * rows / max(seconds, 1e-9)
        self._size = int(np.clip(fit, 1, min(2 * max(rows, self._size), MOST_ROWS)))
