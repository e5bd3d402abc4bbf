"""Tables of columns of one length; they are written through a journal only.

Examples
--------
>>> from assoc_hull.graph.table import Table
>>> table = Table(height=(float, ()), name=(object, ""))
>>> table.resize(2)
>>> table.height.data.tolist(), table.name.data
([0.0, 0.0], ['', ''])
"""

from __future__ import annotations

import itertools
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import DTypeLike, NDArray

__all__ = ["ArrayColumn", "ListColumn", "Table"]

_WRITES = itertools.count(1)
"""No two writes of any column have one number, so a number may come back with its content."""


class ArrayColumn:
    """A growing numpy array, one entry a row; `data` is a read-only view of the rows in use.

    `writes` is the number of the last write: what was derived from the column is true as long as
    it stands. A journal that takes everything back brings back the number as well.
    """

    def __init__(self, dtype: DTypeLike, shape: tuple[int, ...], fill: float | bool = 0) -> None:
        self.store: NDArray[Any] = np.full((16, *shape), fill, dtype)
        self.fill = fill
        self.data = self.store[:0]
        self.writes = 0

    def written(self) -> None:
        """Say that something was written."""
        self.writes = next(_WRITES)

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
        self.written()

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

    def stamps(self) -> dict[str, int]:
        """Give the number of the last write of every array column."""
        return {
            name: each.writes
            for name, each in self.columns.items()
            if isinstance(each, ArrayColumn)
        }

    def restamp(self, stamps: Mapping[str, int]) -> None:
        """Say that the columns are again as they were when they had these numbers."""
        for name, each in stamps.items():
            column = self.columns[name]
            assert isinstance(column, ArrayColumn)
            column.writes = each

    def resize(self, count: int) -> None:
        """Bring every column to `count` rows."""
        self.count = count
        for column in self.columns.values():
            column.resize(count)
