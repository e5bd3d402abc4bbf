"""Findings on links: roles against readers and drivers, orphans, twins."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from assoc_hull.edit.checks.finding import Finding, row_finding
from assoc_hull.geometry.curves import IntArray
from assoc_hull.model.address import AddressBook
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.state import HullState

__all__ = ["crossings_of", "expected_links", "find_links", "role_words"]


def find_links(state: HullState, book: AddressBook) -> Iterator[Finding]:
    """Give all findings on links between points, curves, lines and groups.

    Examples
    --------
    >>> from assoc_hull.edit.checks.links import find_links
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.model.address import AddressBook
    >>> state = wigley()
    >>> list(find_links(state, AddressBook(state)))
    []
    """
    yield from _roles(state, book)
    yield from _listed(state, book)
    yield from _orphan_points(state, book)
    yield from _orphan_curves(state, book)
    yield from _orphan_lines(state, book)
    yield from _twins(state, book)
    yield from _alone(state, book)
    yield from _foreign(state, book)


def expected_links(state: HullState, rows: IntArray) -> tuple[IntArray, IntArray]:
    """Give the readers (k, 2) and drivers (k,) that follow from the roles of points."""
    curve, role = state.rows.curve.data[rows], state.rows.role.data[rows]
    crossing = state.rows.sort.data[rows] == Sort.CROSSING
    first = ~crossing | (role == Role.SHARED) | (role == Role.DRIVES_A)
    second = crossing & ((role == Role.SHARED) | (role == Role.DRIVES_B))
    reader = np.where(np.column_stack([first, second]), curve, -1)
    driver = np.where(crossing & (role == Role.DRIVES_B), curve[:, 0], -1)
    return reader, np.where(crossing & (role == Role.DRIVES_A), curve[:, 1], driver)


def _roles(state: HullState, book: AddressBook) -> Iterator[Finding]:
    """Friends that disagree: readers and driver are not what the role says."""
    rows = state.live("rows")
    reader, driver = expected_links(state, rows)
    wrong = (state.rows.reader.data[rows] != reader).any(axis=1)
    wrong |= state.rows.driver.data[rows] != driver
    for row in rows[wrong].tolist():
        crossing = state.rows.sort.data[row] == Sort.CROSSING
        role = Role(int(state.rows.role.data[row]))
        what = role_words(role) if crossing else f"is {_sort(state, row)}"
        text = f"{what}, and its links say otherwise: set its role again"
        yield row_finding(state, book, row, "links", text)


def role_words(role: Role) -> str:
    """Say what role a crossing has."""
    return role.text if role in (Role.DRIVES_A, Role.DRIVES_B) else f"is {role.text}"


def _sort(state: HullState, row: int) -> str:
    return Sort(int(state.rows.sort.data[row])).name.lower()


def _listed(state: HullState, book: AddressBook) -> Iterator[Finding]:
    """Points that a curve is made through and that do not say so, or are gone."""
    reader = state.rows.reader.data
    for curve in state.live("curves").tolist():
        for row in state.curves.rows.data[curve].tolist():
            if not state.rows.alive.data[row]:
                key = state.rows.key.data[row]
                text = f"is made through {key}, which has gone: undo the edit"
                yield Finding("links", book.curve_name(curve), None, None, text)
            elif not (reader[row] == curve).any():
                name = book.curve_name(curve)
                text = f"defines {name} and is not linked to it: set its role again"
                yield row_finding(state, book, row, "links", text)


def _orphan_points(state: HullState, book: AddressBook) -> Iterator[Finding]:
    """Points on no curve, or on one that is gone or does not know them."""
    alive = state.curves.alive.data
    for row in state.live("rows").tolist():
        curves = state.rows.curve.data[row].tolist()
        if curves[0] < 0 or not all(alive[curve] for curve in curves if curve >= 0):
            key = state.rows.key.data[row]
            yield Finding("orphan", key, None, None, "lies on no curve that exists: delete it")
            continue
        for anchor in state.rows.anchor.data[row].tolist():
            if anchor >= 0 and not state.rows.alive.data[anchor]:
                text = f"rides with {state.rows.key.data[anchor]}, which has gone: undo the edit"
                yield row_finding(state, book, row, "orphan", text)
        for curve in state.rows.reader.data[row].tolist():
            if curve >= 0 and row not in state.curves.rows.data[curve]:
                text = (
                    f"should define {book.curve_name(curve)}, which does not know it: undo the edit"
                )
                yield row_finding(state, book, row, "orphan", text)


def _orphan_curves(state: HullState, book: AddressBook) -> Iterator[Finding]:
    for curve in state.live("curves").tolist():
        line = state.line_of(curve)
        if line < 0 or not state.lines.alive.data[line]:
            key = state.curves.key.data[curve]
            text = "belongs to no line that exists: undo the edit"
            yield Finding("orphan", key, None, None, text)
        elif curve not in state.lines.curves.data[line]:
            text = f"is not among the curves of {book.line_name(line)}: undo the edit"
            yield Finding("orphan", state.curves.key.data[curve], None, None, text)


def _orphan_lines(state: HullState, book: AddressBook) -> Iterator[Finding]:
    for line in state.live("lines").tolist():
        group = int(state.lines.group.data[line])
        if group < 0 or not state.groups.alive.data[group]:
            key = state.lines.key.data[line]
            text = "belongs to no group that exists: undo the edit"
            yield Finding("orphan", key, None, None, text)
        elif not any(state.curves.alive.data[curve] for curve in state.lines.curves.data[line]):
            yield Finding("orphan", book.line_name(line), None, None, "has no curves: remove it")


def _twins(state: HullState, book: AddressBook) -> Iterator[Finding]:
    """Crossings that only one of the two curves knows of."""
    known = {
        curve: set(state.curves.meets.data[curve].row.tolist())
        for curve in state.live("curves").tolist()
    }
    for row in crossings_of(state):
        contact = bool(state.rows.contact.data[row])
        for side, curve in enumerate(state.rows.curve.data[row].tolist()):
            if curve not in known or (contact and side == 1):
                continue
            reads = bool((state.rows.reader.data[row] == curve).any())
            if row not in known[curve] and not (contact and reads):
                name = book.curve_name(curve)
                text = f"is not among the meetings of {name}, its twin is missing: undo the edit"
                yield row_finding(state, book, row, "twin", text)


def crossings_of(state: HullState) -> list[int]:
    """Give the crossings that lie on two curves of lines."""
    rows = state.live("rows")
    curves = state.rows.curve.data[rows]
    both = (curves >= 0).all(axis=1) & (state.curves.line.data[curves] >= 0).all(axis=1)
    found: list[int] = rows[both & (state.rows.sort.data[rows] == Sort.CROSSING)].tolist()
    return found


def _alone(state: HullState, book: AddressBook) -> Iterator[Finding]:
    """Crossings that lie on one curve only."""
    table = state.rows
    for row in state.live("rows").tolist():
        a, b = table.curve.data[row].tolist()
        if table.sort.data[row] == Sort.CROSSING and a >= 0 and b < 0:
            text = f"crosses {book.curve_name(a)} and no other curve: its twin is missing"
            yield row_finding(state, book, row, "twin", f"{text}: undo the edit")


def _foreign(state: HullState, book: AddressBook) -> Iterator[Finding]:
    """Meetings of curves that are crossings which have gone, or lie elsewhere."""
    table = state.rows
    for curve in state.live("curves").tolist():
        rows, name = state.curves.meets.data[curve].row, book.curve_name(curve)
        for row in rows[rows >= 0].tolist():
            if not table.alive.data[row]:
                text = f"meets a curve at {table.key.data[row]}, which has gone: undo the edit"
                yield Finding("twin", name, None, None, text)
            elif not (table.curve.data[row] == curve).any():
                text = f"is among the meetings of {name} and does not lie on it: undo the edit"
                yield row_finding(state, book, row, "twin", text)
