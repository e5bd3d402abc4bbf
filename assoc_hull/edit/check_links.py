"""Findings on links: roles against readers and drivers, orphans, twins, associations."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from assoc_hull.edit.finding import Finding, row_finding
from assoc_hull.edit.topology import generates
from assoc_hull.geometry.curves import IntArray
from assoc_hull.model.address import AddressBook
from assoc_hull.model.family import Role, Sort
from assoc_hull.model.state import HullState

__all__ = ["expected_links", "find_links"]


def find_links(state: HullState, book: AddressBook) -> Iterator[Finding]:
    """Give all findings on links between points, curves, lines and associations.

    Examples
    --------
    >>> from assoc_hull.edit.check_links import find_links
    >>> from assoc_hull.examples.wigley import wigley
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
    yield from _undeclared(state, book)


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
        role = Role(int(state.rows.role.data[row])).text
        crossing = state.rows.sort.data[row] == Sort.CROSSING
        what = f"is {role}" if crossing else f"is {_sort(state, row)}"
        text = f"{what}, and its links say otherwise: set its role again"
        yield row_finding(state, book, row, "links", text)


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
                text = f"defines {book.curve_name(curve)} and is not linked to it"
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
        for curve in state.rows.reader.data[row].tolist():
            if curve >= 0 and row not in state.curves.rows.data[curve]:
                text = f"should define {book.curve_name(curve)}, which does not know it"
                yield row_finding(state, book, row, "orphan", text)


def _orphan_curves(state: HullState, book: AddressBook) -> Iterator[Finding]:
    for curve in state.live("curves").tolist():
        line = state.line_of(curve)
        if line < 0 or not state.lines.alive.data[line]:
            key = state.curves.key.data[curve]
            yield Finding("orphan", key, None, None, "belongs to no line that exists")
        elif curve not in state.lines.curves.data[line]:
            text = f"is not among the curves of {book.line_name(line)}"
            yield Finding("orphan", state.curves.key.data[curve], None, None, text)


def _orphan_lines(state: HullState, book: AddressBook) -> Iterator[Finding]:
    for line in state.live("lines").tolist():
        group = int(state.lines.group.data[line])
        if group < 0 or not state.groups.alive.data[group]:
            key = state.lines.key.data[line]
            yield Finding("orphan", key, None, None, "belongs to no group that exists")
        elif not any(state.curves.alive.data[curve] for curve in state.lines.curves.data[line]):
            yield Finding("orphan", book.line_name(line), None, None, "has no curves: remove it")


def _twins(state: HullState, book: AddressBook) -> Iterator[Finding]:
    """Crossings that only one of the two curves knows of."""
    known = {
        curve: set(state.curves.meets.data[curve].row.tolist())
        for curve in state.live("curves").tolist()
    }
    for row in _crossings(state):
        contact = bool(state.rows.contact.data[row])
        for side, curve in enumerate(state.rows.curve.data[row].tolist()):
            if curve not in known or (contact and side == 1):
                continue
            reads = bool((state.rows.reader.data[row] == curve).any())
            if row not in known[curve] and not (contact and reads):
                text = f"is not among the meetings of {book.curve_name(curve)}: its twin is missing"
                yield row_finding(state, book, row, "twin", text)


def _crossings(state: HullState) -> list[int]:
    rows = state.live("rows")
    found: list[int] = rows[state.rows.sort.data[rows] == Sort.CROSSING].tolist()
    return found


def _undeclared(state: HullState, book: AddressBook) -> Iterator[Finding]:
    """Crossings of lines that are not associated, or driven against the association."""
    declared: dict[tuple[int, int], tuple[bool, bool]] = {}
    for row in _crossings(state):
        curves = state.rows.curve.data[row].tolist()
        lines = (state.line_of(curves[0]), state.line_of(curves[1]))
        groups = tuple(int(state.lines.group.data[line]) for line in lines)
        pair = (groups[0], groups[1])
        if pair not in declared:
            declared[pair] = generates(state, *lines)
        text = _against(declared[pair], Role(int(state.rows.role.data[row])))
        if text and (declared[pair] == (False, False) or state.rows.override.data[row] < 0):
            yield row_finding(state, book, row, "association", text)


def _against(generating: tuple[bool, bool], role: Role) -> str:
    """Say how a role goes against what is declared; empty if it does not."""
    if generating == (False, False):
        return "joins groups that are not associated: associate them, or remove the crossing"
    allowed = {
        (True, True): set(Role),
        (True, False): {Role.DRIVES_B, Role.WATCHED},
        (False, True): {Role.DRIVES_A, Role.WATCHED},
    }[generating]
    if role in allowed:
        return ""
    return f"is {role.text} against a one-way association: set its role, or associate two-way"
