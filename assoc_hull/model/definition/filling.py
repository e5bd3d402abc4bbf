"""Adding live rows to the tables of a hull, and looking up numbers by key.

Examples
--------
>>> from assoc_hull.model.definition.filling import Keys
>>> Keys({"sections": 0}, {}, {}, {}).find("groups", "sections", "an association")
0
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import IntArray
from assoc_hull.graph.journal import Journal
from assoc_hull.graph.table import Table

__all__ = ["Keys", "fill", "wrong"]


def wrong(what: str, where: str) -> BadInputError:
    """Give the error for a definition that contradicts itself."""
    return BadInputError(what, where, "take the file from where it was written, or write it anew")


@attrs.frozen
class Keys:
    """Numbers of groups, lines, curves and points, by name or key."""

    groups: dict[str, int]
    lines: dict[str, int]
    curves: dict[str, int]
    points: dict[str, int]

    def find(self, kind: str, key: str, where: str) -> int:
        """Give the number of an object that is named somewhere.

        Raises
        ------
        BadInputError
            If there is none.
        """
        table: dict[str, int] = getattr(self, kind)
        if key not in table:
            raise wrong(f"there is no {kind[:-1]} {key!r}", f"named at {where!r}")
        return table[key]


def fill(table: Table, journal: Journal, count: int, **columns: Sequence[object]) -> IntArray:
    """Add live rows to a table, column by column; lists for columns of objects."""
    rows = journal.grow(table, count)
    numbers = rows.tolist()
    for name, values in columns.items():
        column: Any = table.columns[name]
        if isinstance(column.data, list):
            journal.set(column, numbers, values)
        elif count:
            journal.put(column, rows, np.array(values))
    if count:
        journal.put(table.alive, rows, True)
    return rows
