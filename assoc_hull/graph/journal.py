"""The journal: columns are only written through it, so that every write can be taken back.

The journal of one transaction *is* its undo step: the same entries are run backward by
undo and forward by redo. Nothing is ever computed again.

Examples
--------
>>> from assoc_hull.graph.journal import Journal
>>> from assoc_hull.graph.table import NumberColumn, Table, numbers
>>> @attrs.frozen(eq=False)
... class Towers(Table):
...     height: NumberColumn[np.float64] = numbers(np.float64)
>>> table, journal = Towers(), Journal()
>>> journal.grow(table, 2)
array([0, 1])
>>> journal.put(table.height, [0, 1], [3.0, 4.0])
>>> journal.put(table.height, [1], [5.0])
>>> journal.undo(keep=2)
>>> table.height.data.tolist()
[3.0, 4.0]
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from functools import partial
from typing import Generic, Protocol, TypeVar, overload

import attrs
import numpy as np
from numpy.typing import ArrayLike, NDArray

from assoc_hull.graph.table import AnyColumn, Column, Table, ValueColumn, put_rows

__all__ = [
    "ArrayChange",
    "Journal",
    "PickedRows",
    "ValueChange",
    "both_parts",
    "distinct",
    "each_once",
    "same_value",
]

S = TypeVar("S", bound=np.generic, covariant=True)
V = TypeVar("V")


@attrs.frozen(eq=False)
class ArrayChange(Generic[S]):
    """What a journal did to one column of numbers, all its writes taken together.

    Attributes
    ----------
    rows : (k,) int
        The rows that were written, ascending, each once.
    old, new : array (k, ...)
        What stood there before the first write, and after the last; rows that the table did
        not have held its fill value.
    """

    rows: NDArray[np.int64]
    old: NDArray[S]
    new: NDArray[S]


@attrs.frozen(eq=False)
class ValueChange(Generic[V]):
    """The same of a column of values."""

    rows: NDArray[np.int64]
    old: list[V]
    new: list[V]


class _Entry(Protocol):
    def undo(self) -> None: ...

    def redo(self) -> None: ...

    def idle(self) -> bool: ...

    def restamp(self) -> None:
        """Bring back the numbers of the writes before this one, which has just been undone."""


@attrs.frozen(eq=False)
class _ArrayEntry:
    column: Column[np.generic]
    index: NDArray[np.int64]
    old: NDArray[np.generic]
    new: NDArray[np.generic]
    was: int

    def restamp(self) -> None:
        self.column.writes = self.was

    def undo(self) -> None:
        self.column.put(self.index, self.old)

    def redo(self) -> None:
        self.column.put(self.index, self.new)

    def idle(self) -> bool:
        return self.old.tobytes() == self.new.tobytes()


@attrs.frozen(eq=False)
class PickedRows:
    """Some rows of a frozen array that others hold as well; all rows if `pick` is None."""

    whole: NDArray[np.generic]
    pick: NDArray[np.int64] | None = None

    def values(self) -> NDArray[np.generic]:
        """Give what was picked."""
        return self.whole if self.pick is None else self.whole.take(self.pick, axis=0)


@attrs.frozen(eq=False)
class _PartEntry:
    """Writes to parts of rows; the arrays may be shared with whoever wrote them."""

    column: Column[np.generic]
    part: NDArray[np.int64]
    old: PickedRows
    new: PickedRows
    was: int

    def restamp(self) -> None:
        self.column.writes = self.was

    def undo(self) -> None:
        self.column.put_parts(self.part, self.old.values())

    def redo(self) -> None:
        self.column.put_parts(self.part, self.new.values())

    def idle(self) -> bool:
        return self.old.values().tobytes() == self.new.values().tobytes()


@attrs.frozen(eq=False)
class _ListEntry(Generic[V]):
    column: ValueColumn[V]
    index: Sequence[int]
    old: Sequence[V]
    new: Sequence[V]
    was: int

    def undo(self) -> None:
        self.column.put(self.index, self.old)

    def redo(self) -> None:
        self.column.put(self.index, self.new)

    def restamp(self) -> None:
        self.column.writes = self.was

    def idle(self) -> bool:
        return all(same_value(old, new) for old, new in zip(self.old, self.new, strict=True))


@attrs.frozen(eq=False)
class _GrowEntry:
    table: Table
    old: int
    new: int
    was: Mapping[str, int]

    def restamp(self) -> None:
        self.table.restamp(self.was)

    def undo(self) -> None:
        self.table.resize(self.old)

    def redo(self) -> None:
        self.table.resize(self.new)

    def idle(self) -> bool:
        return self.old == self.new


def distinct(numbers: NDArray[np.int64]) -> NDArray[np.int64]:
    """Give each number once, ascending.

    As `numpy.unique`, which takes four times as long over the few of a drag.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.graph.journal import distinct
    >>> distinct(np.array([5, 2, 5])).tolist()
    [2, 5]
    """
    ordered = np.sort(numbers)
    first = np.ones(len(ordered), np.bool_)
    np.not_equal(ordered[1:], ordered[:-1], out=first[1:])
    return ordered[first]


def each_once(parts: Sequence[NDArray[np.int64]]) -> NDArray[np.int64]:
    """Give the numbers of arrays, each of them ascending, once: as `distinct` of all, of one as is.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.graph.journal import each_once
    >>> each_once([np.array([2, 5]), np.array([1, 5])]).tolist()
    [1, 2, 5]
    """
    return parts[0] if len(parts) == 1 else distinct(np.concatenate(parts))


def same_value(old: object, new: object) -> bool:
    """Tell whether two values of a list column are the same, arrays by what they hold."""
    if isinstance(old, np.ndarray) and isinstance(new, np.ndarray):
        return np.array_equal(old, new)
    return old is new or bool(old == new)


def both_parts(rows: NDArray[np.int64]) -> NDArray[np.int64]:
    """Give the parts of rows of a column of pairs."""
    found: NDArray[np.int64] = np.repeat(2 * rows, 2)
    found[1::2] += 1
    return found


def _net_array(column: Column[S], entries: Sequence[_ArrayEntry | _PartEntry]) -> ArrayChange[S]:
    """Run the writes to an array backward over a copy of what they touched."""
    width = column.shape[0] if column.shape else 1
    if len(entries) == 1 and isinstance(entry := entries[0], _ArrayEntry):
        rows, old = entry.index, entry.old
        if len(rows) < 2 or bool((rows[1:] > rows[:-1]).all()):
            return ArrayChange(rows, old, column.take(rows))  # type: ignore[arg-type]
    parts = [e.index if isinstance(e, _ArrayEntry) else e.part // width for e in entries]
    rows = distinct(np.concatenate([np.zeros(0, np.int64), *parts]))
    new = column.take(rows)
    old = new.copy()
    flat = old.reshape(-1, *old.shape[2:])
    for entry in reversed(entries):
        if isinstance(entry, _ArrayEntry):
            old[np.searchsorted(rows, entry.index)] = entry.old
        else:
            row = entry.part // width
            put_rows(flat, np.searchsorted(rows, row) * width + entry.part - row * width,
                     entry.old.values())  # fmt: skip
    return ArrayChange(rows, old, new)


def _net_list(column: ValueColumn[V], entries: Sequence[_ListEntry[V]]) -> ValueChange[V]:
    old: dict[int, V] = {}
    for entry in reversed(entries):
        old.update(zip(entry.index, entry.old, strict=True))
    rows = np.array(sorted(old), np.int64)
    numbers = rows.tolist()
    return ValueChange(rows, [old[row] for row in numbers], [column.data[row] for row in numbers])


@attrs.define(eq=False)
class Journal:
    """All writes of one transaction, in order."""

    entries: list[_Entry] = attrs.field(factory=list)

    def put(self, column: Column[np.generic], index: ArrayLike, values: ArrayLike) -> None:
        """Write `values` to the rows `index` (each named once) of an array column."""
        rows = np.asarray(index, np.int64)
        if not len(rows):
            return
        new = np.array(values, column.dtype)
        if new.shape != (len(rows), *column.shape):
            new = np.broadcast_to(new, (len(rows), *column.shape)).copy()
        old = column.take(rows)
        self.entries.append(_ArrayEntry(column, rows, old, new, column.writes))
        column.put(rows, new)

    def put_parts(
        self,
        column: Column[np.generic],
        part: NDArray[np.int64],
        new: PickedRows,
    ) -> None:
        """Write to parts of rows, as `Column.parts` numbers them, each named once."""
        if not len(part):
            return
        old = PickedRows(column.take_parts(part))
        self.entries.append(_PartEntry(column, part, old, new, column.writes))
        column.put_parts(part, new.values())

    def set(self, column: ValueColumn[V], index: Iterable[int], values: Iterable[V]) -> None:
        """Write one object each to the rows `index` of a list column."""
        rows, new = tuple(index), tuple(values)
        data = column.data
        old = tuple([data[row] for row in rows])
        entry = _ListEntry(column, rows, old, new, column.writes)
        self.entries.append(entry)
        entry.redo()

    def grow(self, table: Table, count: int) -> NDArray[np.int64]:
        """Add rows to a table and give their numbers."""
        entry = _GrowEntry(table, table.count, table.count + count, table.stamps())
        self.entries.append(entry)
        entry.redo()
        return np.arange(entry.old, entry.new)

    def before(self, column: Column[S]) -> tuple[NDArray[np.int64], NDArray[S]]:
        """Give the rows of a column that `put` wrote, ascending, and what stood there first."""
        mine = [
            entry
            for entry in self.entries
            if isinstance(entry, _ArrayEntry) and entry.column is column
        ]
        rows = np.unique(np.concatenate([np.zeros(0, np.int64), *(entry.index for entry in mine)]))
        old = column.take(rows)
        for entry in reversed(mine):
            old[np.searchsorted(rows, entry.index)] = entry.old
        return rows, old

    @overload
    def net(self, column: Column[S]) -> ArrayChange[S]: ...

    @overload
    def net(self, column: ValueColumn[V]) -> ValueChange[V]: ...

    def net(self, column: Column[S] | ValueColumn[V]) -> ArrayChange[S] | ValueChange[V]:
        """Give what all writes to a column did together; true until the next write to it.

        Examples
        --------
        >>> from assoc_hull.graph.journal import Journal
        >>> from assoc_hull.graph.table import NumberColumn, Table, numbers
        >>> @attrs.frozen(eq=False)
        ... class Towers(Table):
        ...     height: NumberColumn[np.float64] = numbers(np.float64)
        >>> table, journal = Towers(), Journal()
        >>> table.resize(2)
        >>> journal.put(table.height, [1], [5.0])
        >>> journal.put(table.height, [1], [7.0])
        >>> net = journal.net(table.height)
        >>> net.rows.tolist(), net.old.tolist(), net.new.tolist()
        ([1], [0.0], [7.0])
        """
        mine = [each for each in self.entries if getattr(each, "column", None) is column]
        if isinstance(column, ValueColumn):
            return _net_list(column, [each for each in mine if isinstance(each, _ListEntry)])
        written = [each for each in mine if isinstance(each, _ArrayEntry | _PartEntry)]
        return _net_array(column, written)

    def parts(self, column: Column[np.generic]) -> NDArray[np.int64]:
        """Give the parts of rows of a column of pairs that were written, as often as they were."""
        found = [np.zeros(0, np.int64)]
        for entry in self.entries:
            if isinstance(entry, _PartEntry) and entry.column is column:
                found.append(entry.part)
            elif isinstance(entry, _ArrayEntry) and entry.column is column:
                found.append(both_parts(entry.index))
        return np.concatenate(found)

    def restore(
        self, column: Column[S], part: NDArray[np.int64], values: NDArray[np.generic]
    ) -> None:
        """Overlay values of parts of rows of a column of pairs, as they are, by what they were."""
        order = np.argsort(part, kind="stable")
        known = part[order]
        for entry in reversed(self.entries if len(part) else ()):
            if not isinstance(entry, _PartEntry | _ArrayEntry) or entry.column is not column:
                continue
            if isinstance(entry, _PartEntry):
                written, old = entry.part, entry.old.values
            else:
                written = both_parts(entry.index)
                old = partial(entry.old.reshape, -1, *entry.old.shape[2:])
            place = np.minimum(np.searchsorted(known, written), len(known) - 1)
            hit = known[place] == written
            if hit.any():
                values[order[place[hit]]] = old()[hit]

    def sizes(self, table: Table) -> tuple[int, int]:
        """Give how many rows a table had before, and has now."""
        grown = [e for e in self.entries if isinstance(e, _GrowEntry) and e.table is table]
        return (grown[0].old if grown else table.count), table.count

    def columns(self) -> list[AnyColumn]:
        """Give every column that was written, each once, in the order of the first writes."""
        # by identity, as columns have no order of their own; the order is that of the entries
        found: dict[int, AnyColumn] = {}
        for entry in self.entries:
            column = getattr(entry, "column", None)
            if column is not None:
                found.setdefault(id(column), column)
        return list(found.values())

    def idle(self) -> bool:
        """Tell whether every write put what stood there already.

        Examples
        --------
        >>> from assoc_hull.graph.journal import Journal
        >>> from assoc_hull.graph.table import NumberColumn, Table, numbers
        >>> @attrs.frozen(eq=False)
        ... class Towers(Table):
        ...     height: NumberColumn[np.float64] = numbers(np.float64, 2.0)
        >>> table, journal = Towers(), Journal()
        >>> table.resize(1)
        >>> journal.put(table.height, [0], [2.0])
        >>> journal.idle()
        True
        """
        return all(entry.idle() for entry in self.entries)

    def undo(self, keep: int = 0) -> None:
        """Take back every entry after the first `keep`, and forget it.

        What was derived from the tables before is true again: they are as they were.
        """
        back = self._as_before(keep)
        while len(self.entries) > keep:
            # An entry goes when it has been taken back: one broken off is taken back once more.
            entry = self.entries[-1]
            column = getattr(entry, "column", None)
            if id(column) not in back:
                entry.undo()
                entry.restamp()
            self.entries.pop()

    def _as_before(self, keep: int) -> list[int]:
        """Bring columns back at once that still have the array of before; tell which, by `id`."""
        first = dict[int, _ArrayEntry | _PartEntry | _ListEntry[object]]()
        for entry in self.entries[keep:]:
            if isinstance(entry, _ArrayEntry | _PartEntry | _ListEntry):
                first.setdefault(id(entry.column), entry)
            else:
                return []  # arrays of before have another length
        return [key for key, entry in first.items() if entry.column.take_back(entry.was)]

    def back(self) -> None:
        """Run the entries backward, keeping them."""
        for entry in reversed(self.entries):
            entry.undo()

    def forth(self) -> None:
        """Run the entries forward again."""
        for entry in self.entries:
            entry.redo()
