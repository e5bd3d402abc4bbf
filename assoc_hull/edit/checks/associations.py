"""Findings on associations: whether they are of groups there are, and crossings agree with them."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from assoc_hull.edit.checks.finding import Finding, row_finding
from assoc_hull.edit.checks.links import crossings_of, role_words
from assoc_hull.edit.followup.births_and_deaths import generates
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.address import AddressBook
from assoc_hull.model.kinds import Role
from assoc_hull.model.state import HullState

__all__ = ["find_associations"]


def find_associations(state: HullState, book: AddressBook) -> Iterator[Finding]:
    """Give all findings on associations.

    Examples
    --------
    >>> from assoc_hull.edit.checks.associations import find_associations
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.model.address import AddressBook
    >>> state = wigley()
    >>> list(find_associations(state, AddressBook(state)))
    []
    """
    yield from _declared(state)
    yield from _undeclared(state, book)
    yield from _unmade(state, book)


def _declared(state: HullState) -> Iterator[Finding]:
    """Associations of groups that do not exist, of one with itself, or declared twice."""
    groups = {state.groups.name.data[group] for group in state.live("groups").tolist()}
    seen = set[frozenset[str]]()
    for link in state.associations:
        name, pair = f"{link.a} - {link.b}", frozenset((link.a, link.b))
        for lost in sorted(pair - groups):
            text = f"associates {lost!r}, a group that does not exist: undo the edit"
            yield Finding("association", name, None, None, text)
        if len(pair) == 1 or pair in seen:
            what = "associates a group with itself" if len(pair) == 1 else "is declared twice"
            yield Finding("association", name, None, None, f"{what}: undo the edit")
        seen.add(pair)


def _undeclared(state: HullState, book: AddressBook) -> Iterator[Finding]:
    """Crossings of lines that are not associated, or driven against the association."""
    declared: dict[tuple[int, int], tuple[bool, bool]] = {}
    for row in crossings_of(state):
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
    words = role_words(role)
    return f"{words} against a one-way association: set its role, or associate two-way"


def _unmade(state: HullState, book: AddressBook) -> Iterator[Finding]:
    """Curves of associated groups that meet and have no crossing there."""
    open_, seen = _latent_meetings(state), set[tuple[int, int]]()
    for (curve, line), places in sorted(open_.items()):
        for other in state.lines.curves.data[line]:
            back = open_.get((other, state.line_of(curve)))
            pair = (min(curve, other), max(curve, other))
            if back is None or pair in seen:
                continue
            seen.add(pair)
            away = np.abs(places[:, None, :] - back[None, :, :]).max(axis=2)
            for i in np.flatnonzero(away.min(axis=1) <= state.tolerances.coincident).tolist():
                x, y, z = places[i].tolist()
                name = f"{book.curve_name(pair[0])} x {book.curve_name(pair[1])}"
                text = "they meet there and have no crossing: dissociate, and associate again"
                yield Finding("association", name, (x, y, z), None, text)


def _latent_meetings(state: HullState) -> dict[tuple[int, int], FloatArray]:
    """Give the places (k, 3), m, at which curves meet planes of lines without a crossing."""
    found: dict[tuple[int, int], FloatArray] = {}
    for curve in state.live("curves").tolist():
        meets = state.curves.meets.data[curve]
        latent = (meets.row < 0) & np.isfinite(meets.xyz).all(axis=1)
        for line in np.unique(meets.line[latent]).tolist():
            found[curve, line] = meets.xyz[latent & (meets.line == line)]
    return found
