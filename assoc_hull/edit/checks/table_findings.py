"""Findings on the tables themselves: references that lead nowhere, codes without a meaning.

A hull made and edited here has none. A file may have been changed by other hands; other
looks may then stumble, and these findings say over what.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from assoc_hull.edit.checks.finding import Finding
from assoc_hull.geometry.curves import IntArray, PointKind
from assoc_hull.model.address import AddressBook
from assoc_hull.model.kinds import FAMILIES, OWN, BoundaryKind, Role, Sort, State
from assoc_hull.model.tables import HullState

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
    >>> from assoc_hull.edit.checks.table_findings import find_tables
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.model.address import AddressBook
    >>> state = wigley()
    >>> list(find_tables(state, AddressBook(state)))
    []
    """
    for table, column, target in _REFERENCES:
        yield from _beyond(state, table, column, _flat(state, table, column), target)
    live = state.live("curves").tolist()
    for part, target in (("row", "rows"), ("line", "lines")):
        meets = [getattr(state.curves.meets[number], part) for number in live]
        yield from _beyond(state, "curves", f"meets.{part}", _joined(live, meets), target)
    for table, column, known in _CODES:
        numbers, values = _flat(state, table, column)
        wrong = ~np.isin(values, known)
        pairs = zip(numbers[wrong].tolist(), values[wrong].tolist(), strict=True)
        for number, value in sorted(set(pairs)):
            text = f"its {column!r} is {value}, which means nothing: {REMEDY}"
            yield Finding("tables", _key(state, table, number), None, float(value), text)
    yield from _families(state)
    yield from _keys(state)
    yield from _generated(state)


def _flat(state: HullState, table: str, column: str) -> tuple[IntArray, IntArray]:
    """Give all values in a column of the live objects, and the number of each one's object."""
    live, data = state.live(table), getattr(getattr(state, table), column).data
    if not isinstance(data, np.ndarray):
        return _joined(live.tolist(), [data[number] for number in live.tolist()])
    values = data[live].reshape(len(live), -1)
    return np.repeat(live, values.shape[1]), np.asarray(values.ravel(), np.int64)


def _joined(numbers: list[int], cells: Sequence[object]) -> tuple[IntArray, IntArray]:
    flat = [np.atleast_1d(np.asarray(cell, np.int64)).ravel() for cell in cells]
    sizes = [len(each) for each in flat]
    none = np.zeros(0, np.int64)
    return np.repeat(np.array(numbers, np.int64), sizes), np.concatenate([none, *flat])


def _key(state: HullState, table: str, number: int) -> str:
    found = getattr(state, table)
    return str((found.name if table == "groups" else found.key).data[number])


def _beyond(
    state: HullState, table: str, column: str, found: tuple[IntArray, IntArray], target: str
) -> Iterator[Finding]:
    """Tell numbers that no row of the target has; -1 stands for none."""
    numbers, values = found
    count = getattr(state, target).count
    wrong = (values < -1) | (values >= count)
    for number, value in zip(numbers[wrong].tolist(), values[wrong].tolist(), strict=True):
        text = f"its {column!r} leads to number {value} of {count} {target}: {REMEDY}"
        yield Finding("tables", _key(state, table, number), None, float(value), text)


def _families(state: HullState) -> Iterator[Finding]:
    for group in state.live("groups").tolist():
        family = state.groups.family[group]
        if family not in FAMILIES and family != OWN:
            text = f"is of the family {family!r}, which does not exist: {REMEDY}"
            yield Finding("tables", _key(state, "groups", group), None, None, text)


def _generated(state: HullState) -> Iterator[Finding]:
    """Tell generated curves that are not there, or lack points."""
    curves, rows = set(state.live("curves").tolist()), set(state.live("rows").tolist())
    for made in state.generated:
        there = made.curve in curves and state.curves.key[made.curve] == made.key
        if not there or (made.attached and not rows.issuperset(made.rows)):
            text = f"comes from definitions, but it or a point of it is not there: {REMEDY}"
            yield Finding("tables", made.key, None, None, text)


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
