"""Findings on the tables themselves: references that lead nowhere, codes without a meaning.

A hull made and edited here has none. A file may have been changed by other hands; other
looks may then stumble, and these findings say over what.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from assoc_hull.edit.finding import Finding
from assoc_hull.geometry.curves import PointKind
from assoc_hull.model.address import AddressBook
from assoc_hull.model.family import FAMILIES, BoundaryKind, Role, Sort, State
from assoc_hull.model.state import HullState

__all__ = ["REMEDY", "find_tables"]

REMEDY = "undo the edit, or take the hull from a copy"

_REFERENCES = (
    ("rows", "curve", "curves"),
    ("rows", "reader", "curves"),
    ("rows", "driver", "curves"),
    ("rows", "anchor", "rows"),
    ("curves", "line", "lines"),
    ("curves", "rows", "rows"),
    ("lines", "group", "groups"),
    ("lines", "curves", "curves"),
)
_CODES: tuple[tuple[str, str, tuple[int, ...]], ...] = (
    ("rows", "sort", tuple(Sort)),
    ("rows", "role", tuple(Role)),
    ("rows", "override", (-1, *Role)),
    ("rows", "kind", tuple(PointKind)),
    ("rows", "state", tuple(State)),
    ("curves", "state", tuple(State)),
    ("lines", "boundary", (-1, *BoundaryKind)),
)


def find_tables(state: HullState, _: AddressBook) -> Iterator[Finding]:
    """Give all findings on the form of the tables.

    Examples
    --------
    >>> from assoc_hull.edit.check_tables import find_tables
    >>> from assoc_hull.examples.wigley import wigley
    >>> from assoc_hull.model.address import AddressBook
    >>> state = wigley()
    >>> list(find_tables(state, AddressBook(state)))
    []
    """
    for table, column, target in _REFERENCES:
        count = getattr(state, target).count
        for number, values in _cells(state, table, column):
            yield from _beyond(state, table, number, column, values, target, count)
    for number, meets in _cells(state, "curves", "meets"):
        for column, values, target in (("row", meets.row, "rows"), ("line", meets.line, "lines")):
            count = getattr(state, target).count
            yield from _beyond(state, "curves", number, f"meets.{column}", values, target, count)
    for table, column, known in _CODES:
        for number, values in _cells(state, table, column):
            for value in np.setdiff1d(values, known).tolist():
                text = f"its {column!r} is {value}, which means nothing: {REMEDY}"
                yield Finding("tables", _key(state, table, number), None, float(value), text)
    yield from _families(state)
    yield from _keys(state)


def _cells(state: HullState, table: str, column: str) -> Iterator[tuple[int, Any]]:
    """Give the number and the value of a column of each live object."""
    data = getattr(getattr(state, table), column).data
    for number in state.live(table).tolist():
        yield number, data[number]


def _key(state: HullState, table: str, number: int) -> str:
    found = getattr(state, table)
    return str((found.name if table == "groups" else found.key).data[number])


def _beyond(
    state: HullState, table: str, number: int, column: str, values: Any, target: str, count: int
) -> Iterator[Finding]:
    """Tell numbers that no row of the target has; -1 stands for none."""
    flat = np.atleast_1d(np.asarray(values, np.int64)).ravel()
    for value in flat[(flat < -1) | (flat >= count)].tolist():
        text = f"its {column!r} leads to number {value} of {count} {target}: {REMEDY}"
        yield Finding("tables", _key(state, table, number), None, float(value), text)


def _families(state: HullState) -> Iterator[Finding]:
    for group, family in _cells(state, "groups", "family"):
        if family not in FAMILIES:
            text = f"is of the family {family!r}, which does not exist: {REMEDY}"
            yield Finding("tables", _key(state, "groups", group), None, None, text)


def _keys(state: HullState) -> Iterator[Finding]:
    """Tell keys that two live objects have."""
    for table in ("rows", "curves", "lines", "groups"):
        seen = set[str]()
        for number in state.live(table).tolist():
            key = _key(state, table, number)
            if key in seen:
                text = f"is the key of more than one of the {table}: {REMEDY}"
                yield Finding("tables", key, None, None, text)
            seen.add(key)
