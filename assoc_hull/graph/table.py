"""Tables of columns of one length; they are written through a journal only.

A table is a frozen attrs class, and its columns are declared in the body of the class: what each
holds, how many to a row, and what a new row has. `column[row]` reads; `column.data` is all of it.

Examples
--------
>>> import attrs
>>> import numpy as np
>>> from assoc_hull.graph.table import NumberColumn, Table, ValueColumn, numbers, values
>>> @attrs.frozen(eq=False)
... class Towers(Table):
...     height: NumberColumn[np.float64] = numbers(np.float64)
...     name: ValueColumn[str] = values("")
>>> table = Towers()
>>> table.resize(2)
>>> table.height.data.tolist(), table.name[0]
([0.0, 0.0], '')
"""

from __future__ import annotations

import itertools
import math
import sys
from collections.abc import Mapping, Sequence
from functools import lru_cache
from operator import attrgetter, eq, is_
from types import EllipsisType
from typing import TYPE_CHECKING, Generic, Self, SupportsIndex, TypeVar, overload

import attrs
import numpy as np
from numpy.typing import NDArray

__all__ = [
    "BLOCK",
    "AnyColumn",
    "Column",
    "MatrixColumn",
    "NumberColumn",
    "SparseColumn",
    "SparseMatrices",
    "SparseNumbers",
    "SparseVectors",
    "Table",
    "ValueColumn",
    "VectorColumn",
    "matrices",
    "numbers",
    "put_rows",
    "values",
    "values_given",
    "vectors",
    "writes_begun",
]

_WRITES = itertools.count(1)
"""No two writes of any column have one number, so a number may come back with its content."""

_TOUCHED = [0]
"""How often columns, of all tables, have been given out or asked to be written to."""

_SINGLY = 16
"""A row by itself takes longer to copy than so many in one piece."""

# As an array is, a column of numbers is one of more general numbers as well.
S = TypeVar("S", bound=np.generic, covariant=True)
V = TypeVar("V")

BLOCK = 512
"""So many rows of a column share one note of their last write."""

_Row = int | np.integer
_Several = slice | Sequence[int] | NDArray[np.generic] | EllipsisType | None
"""What names one row; and several: a slice, their numbers, or a mask."""

_Part = tuple[_Row | _Several, ...]


class Column(Generic[S]):
    """A growing numpy array, one entry a row; `data` is a read-only view of the rows in use.

    `writes` is the number of the last write: what was derived from the column is true as long as
    it stands. A journal that takes everything back brings back the number as well. Two columns may
    share their numbers, see `share`: the one that is written to first takes an array of its own.
    That is the one it had before, if nobody else has it any more, and then few rows are copied.

    `blocks` has the number of the last write to each `BLOCK` of rows: what was derived block by
    block needs a look at those alone whose number is another. It does not come back.
    """

    def __init__(self, dtype: type[S] | np.dtype[S], shape: tuple[int, ...], fill: float) -> None:
        self._store: NDArray[S] = np.full((16, *shape), fill, dtype)
        self._shared = False
        self.fill = fill
        self.data = self._store[:0]
        self.writes = 0
        self.blocks = _blocks(16, 0)
        self._forget()

    def __getstate__(self) -> tuple[NDArray[S], float]:
        return self.data.copy(), self.fill

    def __setstate__(self, state: tuple[NDArray[S], float]) -> None:
        self._store, self.fill = state
        self._shared = False
        # Numbers of writes count in one process: in another they stand for other content.
        self.writes = next(_WRITES)
        self.blocks = _blocks(len(self._store), self.writes)
        self._forget()
        self._show(len(self._store))

    def _forget(self) -> None:
        """Know of no earlier array."""
        self._spare: NDArray[S] | None = None
        self._spare_writes = -1
        self._differ: list[NDArray[np.int64]] | None = None
        self._differing = 0

    @property
    def store(self) -> NDArray[S]:
        """The array, to be written to; nobody else has it from now on."""
        self._own()
        self._differ = None  # nobody tells which rows are written
        self.blocks = _blocks(len(self._store), next(_WRITES))
        _TOUCHED[0] += 1
        return self._store

    def put(self, rows: NDArray[np.int64], values: NDArray[np.generic]) -> None:
        """Write to rows, each named once."""
        self._own()
        self._note(rows)
        self.written()  # first: whoever breaks in leaves no other content under the number
        store = self._store
        if store.ndim > 1 and values.dtype == store.dtype and values.size:
            put_rows(store.reshape(len(store), -1), rows, values)
        else:
            store[rows] = values

    def put_parts(self, part: NDArray[np.int64], values: NDArray[np.generic]) -> None:
        """Write to parts of rows: row r, part p is r * parts + p."""
        self._own()
        self._note(part // self._store.shape[1])
        self.written()
        put_rows(self._store.reshape(-1, *self._store.shape[2:]), part, values)

    def _own(self) -> None:
        """Have an array that nobody else has."""
        if not self._shared:
            return
        ours, old = self._references() == _ALONE, self._store
        if ours and self._spare is not None and self._differ is not None:
            spare = self._spare
            self._spare_writes = -1  # broken off on its way, it is no state of the column
            if _SINGLY * self._differing > len(old):
                np.copyto(spare, old)
            else:
                size = len(old)
                for rows in self._differ:
                    put_rows(spare.reshape(size, -1), rows, old.take(rows, axis=0))
        else:
            spare = old.copy()
        shown = spare[: len(self.data)]
        shown.setflags(write=False)
        # Whatever line an interrupt comes at: the array that is written to is the one that is
        # shown, and what is said to differ from the earlier one is at least what does.
        self._store, self.data, self._spare, self._spare_writes = spare, shown, old, self.writes
        self._differ, self._differing = [], 0
        self._shared = False

    def take_back(self, writes: int) -> bool:
        """Be again what the column was at an earlier write, if that array is still at hand.

        Nothing is copied, however long the column is: the arrays change places.
        """
        if self.writes == writes:
            return True
        if self._spare is None or self._spare_writes != writes:
            return False
        shown = self._spare[: len(self.data)]
        shown.setflags(write=False)
        if self._differ is None:
            self.blocks = _blocks(len(self._store), next(_WRITES))
        else:
            self._mark(np.concatenate([np.zeros(0, np.int64), *self._differ]))
        self._shared = True  # before the array comes that others may have
        self._store, self.data, self._spare, self._spare_writes, self.writes = (
            self._spare, shown, self._store, self.writes, writes,
        )  # fmt: skip
        _TOUCHED[0] += 1
        return True

    def _references(self) -> int:
        """Give how many references there are to the earlier array.

        Where it is as many as a column alone has, nobody has it or a view of it, and nobody can
        come to have it: who takes it takes it of somebody who has it.
        """
        return sys.getrefcount(self._spare)

    def _note(self, rows: NDArray[np.int64]) -> None:
        """Note rows that are about to be written, and to differ from the earlier array."""
        self._mark(rows)
        if self._differ is None:
            return
        self._differing += len(rows)
        if self._differing > len(self._store):
            self._forget()
        else:
            self._differ.append(rows)

    def _mark(self, rows: NDArray[np.int64]) -> None:
        """Note a write to the blocks of rows; columns that share the notes keep theirs."""
        blocks = self.blocks.copy()
        blocks[rows // BLOCK] = next(_WRITES)
        self.blocks = blocks

    def share(self, before: object = None) -> Self:
        """Give another column with the same content, as it is now, whatever is written later.

        `before`, which was given earlier, if nothing has been written since.
        """
        if (
            isinstance(before, type(self))
            and before._store is self._store
            and before.writes == self.writes
            and len(before.data) == len(self.data)
        ):
            return before
        found = object.__new__(type(self))
        found._store, found.fill, found.data = self._store, self.fill, self.data
        found.writes, found.blocks = self.writes, self.blocks
        found._forget()
        found._shared = self._shared = True
        return found

    def equals(self, other: object) -> bool:
        """Tell whether another column has the same numbers, as it is known without a look at them.

        They are the very same, or all that was written since has been taken back.
        """
        if not isinstance(other, Column) or len(other.data) != len(self.data):
            return False
        known = self._differ is not None  # every write has left its number
        return other._store is self._store or (known and other.writes == self.writes)

    def differing(self, other: Column[S]) -> NDArray[np.int64]:
        """Give rows, ascending, among which are all that differ from those of another column.

        As the notes of writes to blocks have it: the other one is an earlier state of this.
        """
        # Arrays that have grown have more blocks than are in use.
        used = -(-len(self.data) // BLOCK)
        blocks = np.flatnonzero(self.blocks[:used] != other.blocks[:used])
        rows = (blocks[:, None] * BLOCK + np.arange(BLOCK)).reshape(-1)
        return rows[rows < len(self.data)]

    def _show(self, count: int) -> None:
        self.data = self._store[:count]
        self.data.setflags(write=False)

    def written(self) -> None:
        """Say that something was written."""
        self.writes = next(_WRITES)
        _TOUCHED[0] += 1

    def resize(self, count: int) -> None:
        """Bring the column to `count` rows; new ones hold the fill value."""
        old = len(self.data)
        if count > len(self._store):
            grown = np.full((max(count, 2 * len(self._store)), *self._store.shape[1:]), self.fill)
            store = grown.astype(self._store.dtype)
            store[:old] = self._store[:old]
            self._store = store
            self._shared = False
            self._forget()
        if count > old:
            self.store[old:count] = self.fill
        self._show(count)
        self.written()
        self.blocks = _blocks(len(self._store), self.writes)

    def parts(self) -> NDArray[S]:
        """Give the first two axes as one: row r, part p is at r * parts + p."""
        return self.data.reshape(-1, *self.data.shape[2:])

    @property
    def dtype(self) -> np.dtype[S]:
        """Of the numbers."""
        return self.data.dtype

    @property
    def shape(self) -> tuple[int, ...]:
        """Of one row."""
        return self.data.shape[1:]

    def take(self, rows: NDArray[np.int64]) -> NDArray[S]:
        """Give a copy of rows (k,)."""
        return self.data.take(rows, axis=0)

    def take_parts(self, part: NDArray[np.int64]) -> NDArray[S]:
        """Give a copy of parts of rows, as `parts` numbers them."""
        return self.parts().take(part, axis=0)

    def take_over(self, other: Column[S]) -> None:
        """Become a copy of a column of as many rows."""
        self.store[: len(other.data)] = other.data
        self.written()

    def __getitem__(self, rows: _Several | _Part) -> NDArray[S]:
        return self.data[rows]


def _blocks(rows: int, writes: int) -> NDArray[np.int64]:
    """Say of all blocks of rows that they were written."""
    return np.full(-(-rows // BLOCK), writes, np.int64)


@lru_cache
def _bytes_of(count: int) -> np.dtype[np.void]:
    return np.dtype((np.void, count))


def put_rows(
    array: NDArray[np.generic], rows: NDArray[np.int64], values: NDArray[np.generic]
) -> None:
    """Write rows of an array in one piece each, which numpy does three times as fast."""
    if array.ndim == 1 or array.shape[1] == 1 or len(rows) < _SINGLY:
        array[rows] = values.reshape(len(rows), *array.shape[1:])
        return
    row = _bytes_of(array.itemsize * array.shape[1])
    whole = np.ascontiguousarray(values).reshape(len(rows), array.shape[1])
    array.view(row)[:, 0][rows] = whole.view(row)[:, 0]


def _alone() -> int:
    """Give how many references a column counts to an array that nobody else has."""
    column = Column(np.float64, (), 0.0)
    column._spare = np.zeros(1)
    return column._references()


_ALONE = _alone()


class NumberColumn(Column[S]):
    """One number a row."""

    @overload
    def __getitem__(self, rows: _Row) -> S: ...

    @overload
    def __getitem__(self, rows: _Several | _Part) -> NDArray[S]: ...

    def __getitem__(self, rows: _Row | _Several | _Part) -> S | NDArray[S]:
        return self.data[rows]


class VectorColumn(Column[S]):
    """Several numbers a row: the coordinates of a place, or one for each side."""

    @overload
    def __getitem__(self, rows: tuple[_Row, _Row]) -> S: ...  # type: ignore[overload-overlap]  # all numbers

    @overload
    def __getitem__(self, rows: _Row | _Several | _Part) -> NDArray[S]: ...

    def __getitem__(self, rows: _Row | _Several | _Part) -> S | NDArray[S]:
        return self.data[rows]


class MatrixColumn(Column[S]):
    """Several vectors a row."""

    @overload
    def __getitem__(self, rows: tuple[_Row, _Row, _Row]) -> S: ...  # type: ignore[overload-overlap]  # same

    @overload
    def __getitem__(self, rows: _Row | _Several | _Part) -> NDArray[S]: ...

    def __getitem__(self, rows: _Row | _Several | _Part) -> S | NDArray[S]:
        return self.data[rows]


# --------------------------------------------------------------------------------------
# Columns of which few rows hold anything.


class SparseColumn(Column[S]):
    """A column of which only those rows take memory that hold anything but the fill value.

    What is held is never written to, but made anew with every write; so columns that share it need
    no copies. `data` is made whenever it is asked for: `take` and `column[rows]` are for few rows.
    A row that held something once is held on until the table gets shorter.
    """

    def __init__(self, dtype: type[S] | np.dtype[S], shape: tuple[int, ...], fill: float) -> None:
        self._store: _Held[S] = _Held(  # type: ignore[assignment]  # an array of dense columns
            np.zeros(0, np.int64), np.full((1, *shape), fill, dtype)
        )
        self._count = 0
        self.fill = fill
        self.writes = 0

    def __setstate__(self, state: tuple[NDArray[S], float]) -> None:
        whole, self.fill = state
        blank: NDArray[S] = np.full((1, *whole.shape[1:]), self.fill, whole.dtype)
        self._store, self._count = _Held(np.zeros(0, np.int64), blank), len(whole)
        self.put(np.arange(len(whole)), whole)

    @property
    def data(self) -> NDArray[S]:  # type: ignore[override]  # an attribute of dense columns
        """All rows, as an array of one's own that cannot be written to."""
        held = self._store
        found: NDArray[S] = np.full((self._count, *self.shape), self.fill, self.dtype)
        found[held.rows] = held.values[:-1]
        found.setflags(write=False)
        return found

    @property
    def store(self) -> NDArray[S]:
        """The rows are written by `put`: there is no array of them all."""
        raise TypeError("the rows of this column are written by put")

    @property
    def dtype(self) -> np.dtype[S]:
        """Of the numbers."""
        return self._store.values.dtype

    @property
    def shape(self) -> tuple[int, ...]:
        """Of one row."""
        return self._store.values.shape[1:]

    def put(self, rows: NDArray[np.int64], values: NDArray[np.generic]) -> None:
        """Write to rows, each named once."""
        held, at = self._store, self._store.find(rows)
        given = np.asarray(values, self.dtype)
        order, place, fresh = held.rows, held.place, at < 0
        written = held.values.copy()
        if not fresh.any():
            # Riders that are carried on: the rows stay the same.
            written[at] = given
        else:
            given = np.broadcast_to(given, (len(rows), *self.shape))
            written[at[~fresh]] = given[~fresh]
            some = given[fresh]
            # By bits: -0.0 is not what a new row holds.
            odd = (_words(some) != _words(held.values[-1:])).any(axis=1)
            if odd.any():
                every = np.concatenate([held.rows, rows[fresh][odd]])
                turn = np.argsort(every, kind="stable")
                mine = np.concatenate([written[:-1], some[odd]])[turn]
                order, place = every[turn], None
                written = np.concatenate([mine, held.values[-1:]])
        self.written()
        self._store = _Held(order, written, place)

    def put_parts(self, part: NDArray[np.int64], values: NDArray[np.generic]) -> None:
        """Write to parts of rows: row r, part p is r * parts + p."""
        row, which = np.divmod(part, self.shape[0])
        rows = np.unique(row)
        whole = self.take(rows)
        whole[np.searchsorted(rows, row), which] = values
        self.put(rows, whole)

    def take_over(self, other: Column[S]) -> None:
        """Become a copy of a column of as many rows."""
        assert isinstance(other, SparseColumn)
        self._store, self._count = other._store, other._count
        self.written()

    def share(self, before: object = None) -> Self:
        """Give another column with the same content, as it is now; see `Column.share`."""
        if isinstance(before, type(self)) and self._same(before) and before.writes == self.writes:
            return before
        found = object.__new__(type(self))
        found._store, found._count, found.fill = self._store, self._count, self.fill
        found.writes = self.writes
        return found

    def equals(self, other: object) -> bool:
        """Tell whether another column has the same numbers; see `Column.equals`."""
        return isinstance(other, SparseColumn) and (
            self._same(other) or other.writes == self.writes
        )

    def take_back(self, writes: int) -> bool:
        """Tell whether the column is what it was at a write; what is held is small to write."""
        return self.writes == writes

    def differing(self, other: Column[S]) -> NDArray[np.int64]:
        """Give the rows, ascending, that hold other bits than those of another column."""
        assert isinstance(other, SparseColumn)
        if self._same(other):
            return np.zeros(0, np.int64)
        rows = self._store.rows
        if not np.array_equal(rows, other._store.rows):
            rows = np.union1d(rows, other._store.rows)
        odd: NDArray[np.bool_] = (_words(self.take(rows)) != _words(other.take(rows))).any(axis=1)
        return rows[odd]

    def _same(self, other: SparseColumn[np.generic]) -> bool:
        return other._store is self._store and other._count == self._count

    def resize(self, count: int) -> None:
        """Bring the column to `count` rows; new ones hold the fill value."""
        held = self._store
        if len(held.rows) and held.rows[-1] >= count:
            kept = int(np.searchsorted(held.rows, count))
            mine = np.concatenate([held.values[:kept], held.values[-1:]])
            self._store = _Held(held.rows[:kept].copy(), mine)
        self._count = count
        self.written()

    def take(self, rows: NDArray[np.int64]) -> NDArray[S]:
        """Give a copy of rows (k,)."""
        return self._store.values.take(self._store.find(rows), axis=0)

    def take_parts(self, part: NDArray[np.int64]) -> NDArray[S]:
        """Give a copy of parts of rows, as `parts` numbers them."""
        held, parts = self._store, self.shape[0]
        if not len(held.rows):
            return np.full((len(part), *self.shape[1:]), self.fill, self.dtype)
        row = part // parts
        # From the end where a row is not held: there stands the fill value.
        flat = parts * (held.find(row) - row) + part
        return held.values.reshape(-1, *self.shape[1:]).take(flat, axis=0)

    if not TYPE_CHECKING:  # the overloads of the kinds of columns hold here, too

        def __getitem__(self, rows):
            if isinstance(rows, int | np.integer):
                return self._one(int(rows))
            if isinstance(rows, np.ndarray) and rows.dtype.kind == "i":
                return self._several(rows)
            if isinstance(rows, tuple):
                first, rest = rows[0], rows[1:]
                if isinstance(first, int | np.integer):
                    return self._one(int(first))[rest]
                if isinstance(first, np.ndarray) and first.ndim == 1:
                    found = self[first]
                    paired = any(isinstance(each, np.ndarray) for each in rest)
                    return found[(np.arange(len(found)) if paired else slice(None), *rest)]
            elif isinstance(rows, np.ndarray) and rows.dtype == np.bool_ and rows.ndim == 1:
                return self.take(np.flatnonzero(rows))
            return self.data[rows]

    def _one(self, row: int) -> NDArray[S]:
        """Give one row."""
        row = row + self._count if row < 0 else row
        if not 0 <= row < self._count:
            raise IndexError(f"row {row} is none of {self._count}")
        held = self._store
        at = int(held.rows.searchsorted(row))
        there = at < len(held.rows) and held.rows[at] == row
        found: NDArray[S] = held.values[at if there else -1]
        return found

    def _several(self, rows: NDArray[np.int64]) -> NDArray[S]:
        """Give rows by an array of any shape, from the end where numbers are negative."""
        if rows.size:
            low, high = int(rows.min()), int(rows.max())
            if low < -self._count or high >= self._count:
                raise IndexError(f"row {high if low >= 0 else low} is none of {self._count}")
            rows = np.where(rows < 0, rows + self._count, rows) if low < 0 else rows
        if rows.ndim == 1:
            return self.take(rows)
        return self.take(rows.reshape(-1)).reshape(*rows.shape, *self.shape)


class _Held(Generic[S]):
    """The rows of a sparse column, ascending, and what they hold; last, what other rows hold."""

    def __init__(
        self, rows: NDArray[np.int64], values: NDArray[S], place: NDArray[np.int32] | None = None
    ) -> None:
        rows.setflags(write=False)
        values.setflags(write=False)
        self.rows, self.values, self.place = rows, values, place

    def find(self, rows: NDArray[np.int64]) -> NDArray[np.int64]:
        """Give where rows (k,), of any order, stand here; -1 where they are not held."""
        if not len(self.rows):
            return np.full(len(rows), -1)
        if self.place is None:
            if len(rows) <= _FEW_ROWS:
                at = self.rows.searchsorted(rows)
                return np.where(self.rows.take(at, mode="clip") == rows, at, -1)
            # A search for each of many rows takes ten times as long.
            place = np.full(int(self.rows[-1]) + 2, -1, np.int32)
            place[self.rows] = np.arange(len(self.rows))
            self.place = place
        return self.place.take(rows, mode="clip").astype(np.int64)


_FEW_ROWS = 32


def _words(values: NDArray[np.generic]) -> NDArray[np.generic]:
    """Give rows as the bits of their numbers, (k, n)."""
    whole = np.ascontiguousarray(values).view(f"u{values.itemsize}")
    return whole.reshape(len(values), math.prod(values.shape[1:]))


class SparseNumbers(SparseColumn[S], NumberColumn[S]):
    """One number a row, of few rows."""


class SparseVectors(SparseColumn[S], VectorColumn[S]):
    """Several numbers a row, of few rows."""


class SparseMatrices(SparseColumn[S], MatrixColumn[S]):
    """Several vectors a row, of few rows."""


class ValueColumn(Generic[V]):
    """A growing list of values that never change, one entry a row.

    Without a fill value, a new row is written before anyone reads it. Two columns may share their
    list, and `writes` tells of the last write, as those of numbers do.
    """

    _store = None  # there is no write to the list that has no number of its own

    def __init__(self, fill: V | None) -> None:
        self.data: list[V] = []
        self.fill = fill
        self.writes = 0
        self._shared = False
        self._forget()

    def __getstate__(self) -> tuple[list[V], V | None]:
        return list(self.data), self.fill

    def __setstate__(self, state: tuple[list[V], V | None]) -> None:
        self.data, self.fill = state
        self._shared = False
        self.writes = next(_WRITES)  # as for numbers
        self._forget()

    def _forget(self) -> None:
        """Know of no earlier list."""
        self._spare: list[V] | None = None
        self._spare_writes = -1
        self._differ: list[int] | None = None

    @property
    def store(self) -> list[V]:
        """The list, to be written to at once; nobody else has it from now on."""
        self._own()
        self._differ = None  # nobody tells which rows are written
        self._written()
        return self.data

    def put(self, rows: Sequence[int], values: Sequence[V]) -> None:
        """Write to rows, each named once."""
        self._own()
        if self._differ is not None:
            self._differ += rows
            if len(self._differ) > len(self.data):
                self._forget()
        self._written()
        data = self.data
        for row, value in zip(rows, values, strict=True):
            data[row] = value

    def _own(self) -> None:
        """Have a list that nobody else has: the earlier one, as for numbers, or a copy."""
        if not self._shared:
            return
        old, spare = self.data, None
        if self._differ is not None and self._references() == _ALONE:
            spare = self._spare
        if spare is None or self._differ is None:
            spare = old.copy()
        else:
            self._spare_writes = -1
            for row in self._differ:
                spare[row] = old[row]
        self.data, self._spare, self._spare_writes = spare, old, self.writes
        self._differ, self._shared = [], False

    def _references(self) -> int:
        """Give how many references there are to the earlier list, as for numbers."""
        return sys.getrefcount(self._spare)

    def take_back(self, writes: int) -> bool:
        """Be again what the column was at an earlier write, as that of numbers."""
        if self.writes == writes:
            return True
        if self._spare is None or self._spare_writes != writes:
            return False
        self._shared = True
        self.data, self._spare, self._spare_writes, self.writes = (
            self._spare, self.data, self.writes, writes,
        )  # fmt: skip
        _TOUCHED[0] += 1
        return True

    def _written(self) -> None:
        self.writes = next(_WRITES)
        _TOUCHED[0] += 1

    def share(self, before: object = None) -> Self:
        """Give another column with the same content; as that of numbers does."""
        if (
            isinstance(before, type(self))
            and before.data is self.data
            and before.writes == self.writes
        ):
            return before
        found = object.__new__(type(self))
        found.data, found.fill, found.writes = self.data, self.fill, self.writes
        found._forget()
        found._shared = self._shared = True
        return found

    def equals(self, other: object) -> bool:
        """Tell whether another column has the same values, as that of numbers does."""
        return isinstance(other, ValueColumn) and other.writes == self.writes

    def resize(self, count: int) -> None:
        """Bring the column to `count` rows; new ones hold the fill value."""
        if count == len(self.data):
            return
        store = self.store
        del store[count:]
        fresh = [self.fill] * (count - len(store))
        store.extend(fresh)  # type: ignore[arg-type]  # None stands where nothing is written yet

    @overload
    def __getitem__(self, row: SupportsIndex) -> V: ...

    @overload
    def __getitem__(self, row: slice) -> list[V]: ...

    def __getitem__(self, row: SupportsIndex | slice) -> V | list[V]:
        return self.data[row]


AnyColumn = Column[np.generic] | ValueColumn[object]
"""A column taken by its name, which does not tell what it holds."""


_content_of, _writes_of = attrgetter("_store"), attrgetter("writes")


def writes_begun() -> int:
    """Tell how often any column of any table was to be written to: unchanged, none was."""
    return _TOUCHED[0]


# --------------------------------------------------------------------------------------
# How columns are declared.


def numbers(dtype: type[S], fill: float = 0, *, sparse: bool = False) -> NumberColumn[S]:
    """Declare a column of one number a row; `sparse` if few rows hold anything but the fill."""
    kind = SparseNumbers if sparse else NumberColumn
    return attrs.field(factory=lambda: kind(dtype, (), fill), init=False)


def vectors(dtype: type[S], size: int, fill: float = 0, *, sparse: bool = False) -> VectorColumn[S]:
    """Declare a column of `size` numbers a row; `sparse` as for `numbers`."""
    kind = SparseVectors if sparse else VectorColumn
    return attrs.field(factory=lambda: kind(dtype, (size,), fill), init=False)


def matrices(
    dtype: type[S], shape: tuple[int, int], fill: float = 0, *, sparse: bool = False
) -> MatrixColumn[S]:
    """Declare a column of vectors, as many and as long as `shape` says; `sparse` as before."""
    kind = SparseMatrices if sparse else MatrixColumn
    return attrs.field(factory=lambda: kind(dtype, shape, fill), init=False)


def values(fill: V) -> ValueColumn[V]:
    """Declare a column of values; new rows hold `fill`."""
    return attrs.field(factory=lambda: ValueColumn(fill), init=False)


def values_given() -> ValueColumn[V]:
    """Declare a column of values that have to be given for every new row."""
    return attrs.field(factory=lambda: ValueColumn[V](None), init=False)


@attrs.frozen(eq=False)
class Table:
    """Columns of one length.

    Attributes
    ----------
    columns : dict of str to column
        The columns by their names, in the order of their declaration.
    """

    columns: dict[str, AnyColumn] = attrs.field(factory=dict, init=False, repr=False)

    def __attrs_post_init__(self) -> None:
        names = [each.name for each in attrs.fields(type(self)) if each.name != "columns"]
        self.columns.update((name, getattr(self, name)) for name in names)

    def share(self, before: Self | None = None) -> Self:
        """Give a table with the same content, as it is now, whatever is written later.

        What has not been written to since `before` was given is taken from that.
        """
        if before is None:
            columns = {name: each.share() for name, each in self.columns.items()}
        elif self._as_in(before):
            return before
        else:
            columns, theirs = before.columns.copy(), before.columns.values()
            pairs = zip(self.columns.items(), theirs, strict=True)
            columns |= {
                name: each.share(known) for (name, each), known in pairs
                if each.writes != known.writes or each._store is not known._store
            }  # fmt: skip
            if all(map(is_, columns.values(), theirs)):
                return before
        found = object.__new__(type(self))
        for name, each in columns.items():
            object.__setattr__(found, name, each)  # as attrs does for a frozen class
        object.__setattr__(found, "columns", columns)
        return found

    def _as_in(self, other: Table) -> bool:
        """Tell whether another table of the kind has the very arrays, and no write since."""
        mine, theirs = self.columns.values(), other.columns.values()
        if not all(map(eq, map(_writes_of, mine), map(_writes_of, theirs))):
            return False
        return all(map(is_, map(_content_of, mine), map(_content_of, theirs)))

    def equals(self, other: Table) -> bool:
        """Tell whether another table of the kind is known to have the same content."""
        return self._as_in(other) or all(
            each.equals(other.columns[name]) for name, each in self.columns.items()
        )

    @property
    def count(self) -> int:
        """How many rows there are."""
        return len(next(iter(self.columns.values())).data)

    def stamps(self) -> dict[str, int]:
        """Give the number of the last write of every column."""
        return {name: each.writes for name, each in self.columns.items()}

    def restamp(self, stamps: Mapping[str, int]) -> None:
        """Say that the columns are again as they were when they had these numbers."""
        for name, each in stamps.items():
            self.columns[name].writes = each

    def resize(self, count: int) -> None:
        """Bring every column to `count` rows."""
        for column in self.columns.values():
            column.resize(count)
