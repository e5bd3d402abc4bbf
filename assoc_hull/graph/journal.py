"""Columns that are only written through a journal, so that every write can be taken back.

The journal of one transaction *is* its undo step: the same entries are run backward by
undo and forward by redo. Nothing is ever computed again.

Examples
--------
>>> from assoc_hull.graph.journal import Journal, Table
>>> table = Table(height=(float, ()))
>>> journal = Journal()
>>> journal.grow(table, 2)
array([0, 1])
>>> journal.put(table.height, [0, 1], [3.0, 4.0])
>>> journal.put(table.height, [1], [5.0])
>>> journal.undo(keep=2)
>>> table.height.data.tolist()
[3.0, 4.0]
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any, Protocol

import attrs
import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

__all__ = ["ArrayColumn", "Journal", "ListColumn", "Picked", "Table"]


class _Entry(Protocol):
    def undo(self) -> None: ...

    def redo(self) -> None: ...

    def idle(self) -> bool: ...


class ArrayColumn:
    """A growing numpy array, one entry a row; `data` is a read-only view of the rows in use.

    `writes` rises whenever anything is written: what was derived from the column is true as
    long as it stands.
    """

    def __init__(self, dtype: DTypeLike, shape: tuple[int, ...], fill: float | bool = 0) -> None:
        self.store: NDArray[Any] = np.full((16, *shape), fill, dtype)
        self.fill = fill
        self.data = self.store[:0]
        self.writes = 0

    def resize(self, count: int) -> None:
        """Bring the column to `count` rows; new ones hold the fill value."""
        old = len(self.data)
        if count > len(self.store):
            grown = np.full((max(count, 2 * len(self.store)), *self.store.shape[1:]), self.fill)
            store = grown.astype(self.store.dtype)
            store[:old] = self.store[:old]
            self.store = store
        if count > old:
            self.store[old:count] = self.fill
        self.data = self.store[:count]
        self.data.setflags(write=False)
        self.writes += 1

    def parts(self) -> NDArray[Any]:
        """Give the first two axes as one, to be written to: row r, part p is at r * parts + p."""
        return self.store.reshape(-1, *self.store.shape[2:])


class ListColumn:
    """A growing list of immutable objects, one entry a row."""

    def __init__(self, fill: object = None) -> None:
        self.data: list[Any] = []
        self.fill = fill

    def resize(self, count: int) -> None:
        """Bring the column to `count` rows; new ones hold the fill value."""
        del self.data[count:]
        self.data.extend([self.fill] * (count - len(self.data)))


class Table:
    """Columns of one length, by name.

    Parameters
    ----------
    **columns : (dtype, shape), (dtype, shape, fill), or (object, fill)
        What each column holds per row.
    """

    def __init__(self, **columns: tuple[Any, ...]) -> None:
        self.count = 0
        self.columns: dict[str, ArrayColumn | ListColumn] = {}
        for name, spec in columns.items():
            column = ListColumn(spec[1]) if spec[0] is object else ArrayColumn(*spec)
            self.columns[name] = column
            setattr(self, name, column)

    def __getattr__(self, name: str) -> Any:
        raise AttributeError(f"this table has no column {name!r}")

    def resize(self, count: int) -> None:
        """Bring every column to `count` rows."""
        self.count = count
        for column in self.columns.values():
            column.resize(count)


@attrs.frozen(eq=False)
class _ArrayEntry:
    column: ArrayColumn
    index: NDArray[np.int64]
    old: NDArray[Any]
    new: NDArray[Any]

    def undo(self) -> None:
        self.column.store[self.index] = self.old
        self.column.writes += 1

    def redo(self) -> None:
        self.column.store[self.index] = self.new
        self.column.writes += 1

    def idle(self) -> bool:
        return self.old.tobytes() == self.new.tobytes()


@attrs.define(eq=False)
class Picked:
    """Some rows of a frozen array that others hold as well; of all rows if `pick` is None.

    What was picked is at hand as long as it is `taken`, and is picked again when it is not.
    """

    whole: NDArray[Any]
    pick: NDArray[np.int64] | None = None
    taken: NDArray[Any] | None = None

    def values(self) -> NDArray[Any]:
        """Give what was picked."""
        if self.taken is not None:
            return self.taken
        return self.whole if self.pick is None else self.whole.take(self.pick, axis=0)

    def take(self) -> None:
        """Keep what is picked at hand."""
        self.taken = self.values()

    def release(self) -> None:
        """Let go of what was picked."""
        self.taken = None


@attrs.frozen(eq=False)
class _PartEntry:
    """Writes to parts of rows; the arrays may be shared with whoever wrote them."""

    column: ArrayColumn
    part: NDArray[np.int64]
    old: Picked
    new: Picked

    def undo(self) -> None:
        _scatter(self.column.parts(), self.part, self.old.values())
        self.column.writes += 1

    def redo(self) -> None:
        _scatter(self.column.parts(), self.part, self.new.values())
        self.column.writes += 1

    def idle(self) -> bool:
        return self.old.values().tobytes() == self.new.values().tobytes()


@attrs.frozen(eq=False)
class _ListEntry:
    column: ListColumn
    index: Sequence[int]
    old: Sequence[object]
    new: Sequence[object]

    def undo(self) -> None:
        for index, value in zip(self.index, self.old, strict=True):
            self.column.data[index] = value

    def redo(self) -> None:
        for index, value in zip(self.index, self.new, strict=True):
            self.column.data[index] = value

    def idle(self) -> bool:
        return all(_equal(old, new) for old, new in zip(self.old, self.new, strict=True))


@attrs.frozen(eq=False)
class _GrowEntry:
    table: Table
    old: int
    new: int

    def undo(self) -> None:
        self.table.resize(self.old)

    def redo(self) -> None:
        self.table.resize(self.new)

    def idle(self) -> bool:
        return self.old == self.new


def _equal(old: object, new: object) -> bool:
    """Tell whether two values of a list column are the same, arrays by what they hold."""
    if isinstance(old, np.ndarray) and isinstance(new, np.ndarray):
        return np.array_equal(old, new)
    return old is new or bool(old == new)


def _scatter(parts: NDArray[Any], part: NDArray[np.int64], values: NDArray[Any]) -> None:
    """Write rows; whole rows are moved in one piece, which numpy does three times as fast."""
    if parts.ndim == 1:
        parts[part] = values
        return
    row = np.dtype((np.void, parts.itemsize * parts.shape[1]))
    parts.view(row)[:, 0][part] = values.view(row)[:, 0]


def _same_bits(one: NDArray[Any], other: NDArray[Any]) -> bool:
    """Tell whether two contiguous arrays of floats or whole numbers agree to the last bit."""
    return one.shape == other.shape and bool((one.view(np.int64) == other.view(np.int64)).all())


@attrs.define(eq=False)
class Journal:
    """All writes of one transaction, in order."""

    entries: list[_Entry] = attrs.field(factory=list)

    def put(self, column: ArrayColumn, index: ArrayLike, values: ArrayLike) -> None:
        """Write `values` to the rows `index` (each named once) of an array column."""
        rows = np.asarray(index, np.int64)
        if not len(rows):
            return
        new = np.array(values, column.store.dtype)
        if new.shape != (len(rows), *column.store.shape[1:]):
            new = np.broadcast_to(new, (len(rows), *column.store.shape[1:])).copy()
        self.entries.append(_ArrayEntry(column, rows, column.store.take(rows, axis=0), new))
        column.store[rows] = new
        column.writes += 1

    def put_parts(
        self, column: ArrayColumn, part: NDArray[np.int64], new: Picked, before: Picked | None
    ) -> None:
        """Write to parts of rows, as `ArrayColumn.parts` numbers them, each named once.

        `before` may be what is thought to stand there now: if it does, to the last bit, it is
        kept for going back, not a copy.
        """
        if not len(part):
            return
        parts = column.parts()
        there = parts.take(part, axis=0)
        if before is None or not _same_bits(before.values(), there):
            before = Picked(there)
        self.entries.append(_PartEntry(column, part, before, new))
        _scatter(parts, part, new.values())
        column.writes += 1

    def set(self, column: ListColumn, index: Iterable[int], values: Iterable[object]) -> None:
        """Write one object each to the rows `index` of a list column."""
        rows, new = tuple(index), tuple(values)
        data = column.data
        old = tuple([data[row] for row in rows])
        entry = _ListEntry(column, rows, old, new)
        self.entries.append(entry)
        entry.redo()

    def grow(self, table: Table, count: int) -> NDArray[np.int64]:
        """Add rows to a table and give their numbers."""
        entry = _GrowEntry(table, table.count, table.count + count)
        self.entries.append(entry)
        entry.redo()
        return np.arange(entry.old, entry.new)

    def before(self, column: ArrayColumn) -> tuple[NDArray[np.int64], NDArray[Any]]:
        """Give the rows of a column that `put` wrote, ascending, and what stood there first."""
        mine = [
            entry
            for entry in self.entries
            if isinstance(entry, _ArrayEntry) and entry.column is column
        ]
        index = np.concatenate([np.zeros(0, np.int64), *(entry.index for entry in mine)])
        old = np.concatenate([column.store[:0], *(entry.old for entry in mine)])
        rows, first = np.unique(index, return_index=True)
        return rows, old[first]

    def idle(self) -> bool:
        """Tell whether every write put what stood there already.

        Examples
        --------
        >>> from assoc_hull.graph.journal import Journal, Table
        >>> table, journal = Table(height=(float, (), 2.0)), Journal()
        >>> table.resize(1)
        >>> journal.put(table.height, [0], [2.0])
        >>> journal.idle()
        True
        """
        return all(entry.idle() for entry in self.entries)

    def undo(self, keep: int = 0) -> None:
        """Take back every entry after the first `keep`, and forget it."""
        while len(self.entries) > keep:
            self.entries.pop().undo()

    def back(self) -> None:
        """Run the entries backward, keeping them."""
        for entry in reversed(self.entries):
            entry.undo()

    def forth(self) -> None:
        """Run the entries forward again."""
        for entry in self.entries:
            entry.redo()
