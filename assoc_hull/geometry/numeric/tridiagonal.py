"""Many small tridiagonal systems solved at once, each with the same bits as when solved alone.

Systems of different lengths lie one behind the other in slots of a power of two (`Slots`).
`solve_tridiagonal` reduces them cyclically, so that a neighbour in the batch changes no bit.
`Workspace` hands out the scratch memory of the solver and of the loft: getting large arrays from
the operating system costs half the time of a loft. Its arrays must not outlive the with block.

Examples
--------
>>> from assoc_hull.geometry.numeric.tridiagonal import Workspace
>>> with Workspace() as workspace:
...     workspace.array(3, 4).shape
(3, 4)

>>> import numpy as np
>>> from assoc_hull.geometry.numeric.tridiagonal import slots_of, solve_tridiagonal
>>> from assoc_hull.geometry.numeric.tridiagonal import Workspace
>>> slots = slots_of(np.array([0, 3]))
>>> rows = np.zeros((5, 4))
>>> rows[:, :3] = [[0, -0.25, 0], [1, 2, 3], [0, 0, 0], [0, 0, 0], [0, -0.25, 0]]
>>> with Workspace() as workspace:
...     solve_tridiagonal(slots, rows, workspace)[0].tolist()
[1.0, 1.0, 3.0]
"""

from __future__ import annotations

from functools import lru_cache
from math import prod
from types import TracebackType
from typing import Self

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze

__all__ = [
    "MOST_LEVELS",
    "Slots",
    "Workspace",
    "running_sums",
    "slots_of",
    "solve_tridiagonal",
]

# --------------------------------------------------------------------------------------
# Scratch memory that is kept from one call to the next.
#
# A workspace hands out pieces of one block, and the block goes back to a small pool afterwards.
# Taking from and returning to the pool are single list operations, so threads never share a block.

_FIRST_SIZE = 1 << 15
_MOST_KEPT = 1 << 20
"""Numbers, 8 MB: the loft of 29,000 points. What the few larger lofts need, of whole hulls that
are opened or transformed, is not held for the rest of the session."""
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


# --------------------------------------------------------------------------------------
# Systems in slots.
#
# Systems of different lengths lie one behind the other. Each is given a slot whose length is a
# power of two, the longest slots first, so that every slot starts at a multiple of its own length.
# Cyclic reduction then couples rows of one slot only, in an order that depends on nothing but the
# place of a row in its own system. (BLAS products and padded sums do change the last bit.)

MOST_LEVELS = 6
"""After so many reductions the couplings of a spline are below 2**-64: no bit sees them."""


@attrs.frozen(eq=False)
class Slots:
    """Where each system of a batch lies in the slotted layout.

    Attributes
    ----------
    home : (n,) int
        Slotted place of each flat row.
    source : (total + 1,) int
        Flat row at each slotted place; n where the slot is empty.
    curve : (n,) int
        The system that each flat row belongs to.
    first, last : (m,) int
        First and last flat row of each system.
    is_first, is_last : (n,) bool
        Whether a flat row is one of these.
    shortest : int
        Rows of the shortest system.
    blocks : tuple of (int, int, int)
        Begin, end and slot length of each run of equally long slots.
    levels : int
        Number of reductions needed.
    """

    home: IntArray
    source: IntArray
    curve: IntArray
    first: IntArray
    last: IntArray
    is_first: NDArray[np.bool_]
    is_last: NDArray[np.bool_]
    shortest: int
    blocks: tuple[tuple[int, int, int], ...]
    levels: int


def slots_of(start: IntArray) -> Slots:
    """Give the slotted layout of a ragged batch; `start` (m + 1,) ends with the number of rows.

    The latest few are remembered, as a hull re-lofts the same batches.

    Examples
    --------
    >>> slots_of(np.array([0, 2, 7])).home
    array([8, 9, 0, 1, 2, 3, 4])
    """
    return _slots(np.ascontiguousarray(start, np.int64).tobytes())


@lru_cache(maxsize=64)
def _slots(packed: bytes) -> Slots:
    start = np.frombuffer(packed, np.int64)
    count = np.diff(start)
    bits = np.array([max(int(rows) - 1, 0).bit_length() for rows in count], np.int64)
    order = np.argsort(-bits, kind="stable")
    width = np.int64(1) << bits[order]
    begin = np.zeros(len(count), np.int64)
    begin[order] = np.cumsum(width) - width
    levels = min(MOST_LEVELS, int(bits.max(initial=0)))
    total = -(-int(width.sum()) >> levels) << levels
    return _layout(start, count, begin, total, levels, _blocks(width))


def _layout(
    start: IntArray,
    count: IntArray,
    begin: IntArray,
    total: int,
    levels: int,
    blocks: tuple[tuple[int, int, int], ...],
) -> Slots:
    rows = int(start[-1])
    curve = np.repeat(np.arange(len(count)), count)
    home = np.arange(rows) + np.repeat(begin - start[:-1], count)
    source = np.full(total + 1, rows, np.int64)
    source[home] = np.arange(rows)
    first, last = start[:-1].copy(), start[1:] - 1
    is_first, is_last = np.zeros(rows, np.bool_), np.zeros(rows, np.bool_)
    occupied = count > 0
    is_first[first[occupied]] = True
    is_last[last[occupied]] = True
    freeze(home, source, curve, first, last, is_first, is_last)
    shortest = int(count.min(initial=np.iinfo(np.int64).max))
    return Slots(home, source, curve, first, last, is_first, is_last, shortest, blocks, levels)


def _blocks(width: IntArray) -> tuple[tuple[int, int, int], ...]:
    blocks, end = [], 0
    for size in sorted({int(one) for one in width}, reverse=True):
        begin, end = end, end + size * int(np.count_nonzero(width == size))
        blocks.append((begin, end, size))
    return tuple(blocks)


def running_sums(slots: Slots, steps: FloatArray) -> FloatArray:
    """Sum steps along each system, strictly one after the other: (..., n + 1) to (..., n).

    A step leads to its row; it is zero at the first row of a system, and the last entry is ignored
    and should be zero. A running sum over the flat array minus its value at the start has other
    bits.

    Examples
    --------
    >>> running_sums(slots_of(np.array([0, 2, 5])), np.array([0.0, 1, 0, 2, 3, 0]))
    array([0., 1., 0., 2., 5.])
    """
    slotted = steps.take(slots.source, axis=-1)
    for begin, end, size in slots.blocks:
        table = slotted[..., begin:end].reshape(*steps.shape[:-1], (end - begin) // size, size)
        np.add.accumulate(table, axis=-1, out=table)
    return slotted.take(slots.home, axis=-1)


def solve_tridiagonal(slots: Slots, rows: FloatArray, workspace: Workspace) -> FloatArray:
    """Solve ``d[i] = right[i] + before[i] * d[i-1] + after[i] * d[i+1]`` for every system, (r, n).

    `rows` (2 + r, n + 1) are ``before, right (r of them), after``; column n must be zero. The sum
    of the magnitudes of `before` and `after` must not exceed one half, and neither may reach out of
    its system. The solutions lie in scratch memory.

    Cyclic reduction: rows of even place are eliminated level by level. The couplings s of a level
    shrink to s * s at least, so six levels are enough for any length.
    Source: R.W. Hockney, J. ACM 12 (1965) 95-113.

    Examples
    --------
    >>> slots = slots_of(np.array([0, 2]))
    >>> rows = np.array([[0, 0.5, 0], [3, 0, 0], [0, 0, 0], [0, 0, 0], [0.5, 0, 0.0]])
    >>> with Workspace() as workspace:
    ...     solve_tridiagonal(slots, rows, workspace)[0].tolist()
    [4.0, 2.0]
    """
    slotted = workspace.array(len(rows), len(slots.source))
    levels = [rows.take(slots.source, axis=1, out=slotted, mode="clip")]
    for _ in range(slots.levels):
        levels.append(_reduced(levels[-1], workspace))
    solution = levels.pop()[1:-1, :-1]
    while levels:
        solution = _restored(levels.pop(), solution, workspace)
    result = workspace.array(len(rows) - 2, len(slots.home))
    return solution.take(slots.home, axis=1, out=result, mode="clip")


def _reduced(rows: FloatArray, workspace: Workspace) -> FloatArray:
    """Eliminate the rows of even place; the last column is zero and stands for no row."""
    kept, left, right = rows[:, 1::2], rows[:, :-1:2], rows[:, 2::2]
    size = kept.shape[1]
    fewer = workspace.array(len(rows), size + 1)
    fewer[:, size] = 0.0
    result = fewer[:, :size]
    np.multiply(kept[0], left, out=result)
    from_right = np.multiply(kept[-1], right, out=workspace.array(len(rows), size))
    scale = result[-1]
    scale += from_right[0]
    scale = 1.0 / (1.0 - scale)
    inner = result[1:-1]
    inner += kept[1:-1]
    inner += from_right[1:-1]
    result[-1] = from_right[-1]
    result *= scale
    return fewer


def _restored(rows: FloatArray, solution: FloatArray, workspace: Workspace) -> FloatArray:
    """Put the eliminated rows back between those already solved."""
    size = solution.shape[1]
    full = workspace.array(len(solution), 2 * size)
    full[:, 1::2] = solution
    even = full[:, ::2]
    np.multiply(rows[-1, :-1:2], solution, out=even)
    even += rows[1:-1, :-1:2]
    from_left = workspace.array(len(solution), size - 1)
    even[:, 1:] += np.multiply(rows[0, 2:-1:2], solution[:, :-1], out=from_left)
    return full
