"""Scratch memory that is kept from one call to the next.

Large temporary arrays cost more to get from the operating system, page by page, than to
fill: half the time of a loft. A workspace hands out pieces of one block, and the block
goes back to a small pool afterwards. Taking from and returning to the pool are single
list operations, so threads never share a block.

Examples
--------
>>> from assoc_hull.geometry.numeric.workspace import Workspace
>>> with Workspace() as workspace:
...     workspace.array(3, 4).shape
(3, 4)
"""

from __future__ import annotations

from math import prod
from types import TracebackType
from typing import Self

import numpy as np

from assoc_hull.geometry.curves import FloatArray

__all__ = ["Workspace"]

_FIRST_SIZE = 1 << 15
_MOST_KEPT = 1 << 23
_ALIGNMENT = 8
_pool: list[FloatArray] = []

_KEPT_FREE = 1 << 24
"""Bytes. Up to twice as much freed memory stays with the process."""


def _keep_freed_memory() -> None:
    """Let the allocator keep what is freed between two lofts, not give it back each time.

    glibc gives the top of its heap back as soon as twice the largest block is free that it
    ever had to ask the operating system for singly. After a few arrays of half a megabyte
    that is one re-loft's worth: each loft then paid 190 page faults, a third of its time.
    Nothing is written to the block, so no memory is taken; elsewhere this does nothing.
    """
    np.empty(_KEPT_FREE, np.int8)


_keep_freed_memory()


class Workspace:
    """Scratch arrays for the length of a ``with`` block; they must not outlive it.

    Examples
    --------
    >>> with Workspace() as workspace:
    ...     total = workspace.array(4)
    ...     total[:] = 1.0
    ...     float(total.sum())
    4.0
    """

    def __enter__(self) -> Self:
        """Take a block of memory from the pool."""
        try:
            self._memory = _pool.pop()
        except IndexError:
            self._memory = np.empty(_FIRST_SIZE)
        self._used = 0
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Give the block back, a larger one if it was too small."""
        if self._used > len(self._memory):
            self._memory = np.empty(self._used + self._used // 4)
        if len(self._memory) <= _MOST_KEPT:
            _pool.append(self._memory)
        del self._memory

    def array(self, *shape: int) -> FloatArray:
        """Give an array of this shape; its values are arbitrary.

        Parameters
        ----------
        *shape : int
            Its extent along each axis.

        Returns
        -------
        array of float
            Scratch memory.

        Examples
        --------
        >>> with Workspace() as workspace:
        ...     workspace.array(2).shape
        (2,)
        """
        begin = self._used
        size = prod(shape)
        self._used = begin + size + -size % _ALIGNMENT
        if self._used > len(self._memory):
            return np.empty(shape)
        return self._memory[begin : begin + size].reshape(shape)
