"""Findings on links: roles, readers and drivers, associations of groups.

What the tables say twice has to agree: the role of a crossing with who reads and drives it, the
crossings with the associations that are declared. Notes name crossings that define a curve and
that the role rule would not choose today; they are no faults, as an edit of shape never changes
a role.
"""

from __future__ import annotations

from collections.abc import Iterator

import attrs
import numpy as np

from assoc_hull.edit.checks.finding import Finding, row_finding
from assoc_hull.edit.checks.update_findings import bounded
from assoc_hull.edit.crossings.adopted_points import runs_along_tangency
from assoc_hull.geometry.curves import IntArray
from assoc_hull.model.address import AddressBook
from assoc_hull.model.gaps import tangents
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.links import PointsOnCurve, crossing_ways, generates, points_on
from assoc_hull.model.roles import Candidates, choose
from assoc_hull.model.tables import HullState
from assoc_hull.tolerance import Tolerances

__all__ = [
    "crossings_of",
    "expected_links",
    "find_associations",
    "find_links",
    "find_roles",
    "role_words",
]


def find_links(state: HullState, book: AddressBook) -> Iterator[Finding]:
    """Give all findings on links between points, curves, lines and groups.

    Examples
    --------
    >>> from assoc_hull.edit.checks.link_findings import find_links
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
    """Give the readers (k, 2) and drivers (k,), curves, that follow from the roles; -1 for none."""
    curve, role = state.rows.curve[rows], state.rows.role[rows]
    crossing = state.rows.sort[rows] == Sort.CROSSING
    first = ~crossing | (role == Role.SHARED) | (role == Role.DRIVES_A)
    second = crossing & ((role == Role.SHARED) | (role == Role.DRIVES_B))
    reader = np.where(np.column_stack([first, second]), curve, -1)
    driver = np.where(crossing & (role == Role.DRIVES_B), curve[:, 0], -1)
    return reader, np.where(crossing & (role == Role.DRIVES_A), curve[:, 1], driver)


def _roles(state: HullState, book: AddressBook) -> Iterator[Finding]:
    """Friends that disagree: readers and driver are not what the role says."""
    rows = state.live("rows")
    reader, driver = expected_links(state, rows)
    wrong = (state.rows.reader[rows] != reader).any(axis=1)
    wrong |= state.rows.driver[rows] != driver
    for row in rows[wrong].tolist():
        crossing = state.rows.sort[row] == Sort.CROSSING
        role = Role(int(state.rows.role[row]))
        what = role_words(role) if crossing else f"is {_sort(state, row)}"
        text = f"{what}, and its links say otherwise: set its role again"
        yield row_finding(state, book, row, "links", text)


def role_words(role: Role) -> str:
    """Say what role a crossing has."""
    return role.text if role in (Role.DRIVES_A, Role.DRIVES_B) else f"is {role.text}"


def _sort(state: HullState, row: int) -> str:
    return Sort(int(state.rows.sort[row])).name.lower()


def _listed(state: HullState, book: AddressBook) -> Iterator[Finding]:
    """Points that a curve is made through and that do not say so, or are gone."""
    reader = state.rows.reader.data
    for curve in state.live("curves").tolist():
        for row in state.curves.rows[curve].tolist():
            if not state.rows.alive[row]:
                key = state.rows.key[row]
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
        curves = state.rows.curve[row].tolist()
        if curves[0] < 0 or not all(alive[curve] for curve in curves if curve >= 0):
            key = state.rows.key[row]
            yield Finding("orphan", key, None, None, "lies on no curve that exists: delete it")
            continue
        for anchor in state.rows.anchor[row].tolist():
            if anchor >= 0 and not state.rows.alive[anchor]:
                text = f"rides with {state.rows.key[anchor]}, which has gone: undo the edit"
                yield row_finding(state, book, row, "orphan", text)
        for curve in state.rows.reader[row].tolist():
            if curve >= 0 and row not in state.curves.rows[curve]:
                text = (
                    f"should define {book.curve_name(curve)}, which does not know it: undo the edit"
                )
                yield row_finding(state, book, row, "orphan", text)


def _orphan_curves(state: HullState, book: AddressBook) -> Iterator[Finding]:
    for curve in state.live("curves").tolist():
        line = state.line_of(curve)
        if line < 0 or not state.lines.alive[line]:
            key = state.curves.key[curve]
            text = "belongs to no line that exists: undo the edit"
            yield Finding("orphan", key, None, None, text)
        elif curve not in state.lines.curves[line]:
            text = f"is not among the curves of {book.line_name(line)}: undo the edit"
            yield Finding("orphan", state.curves.key[curve], None, None, text)


def _orphan_lines(state: HullState, book: AddressBook) -> Iterator[Finding]:
    for line in state.live("lines").tolist():
        group = int(state.lines.group[line])
        if group < 0 or not state.groups.alive[group]:
            key = state.lines.key[line]
            text = "belongs to no group that exists: undo the edit"
            yield Finding("orphan", key, None, None, text)
        elif not any(state.curves.alive[curve] for curve in state.lines.curves[line]):
            yield Finding("orphan", book.line_name(line), None, None, "has no curves: remove it")


def _twins(state: HullState, book: AddressBook) -> Iterator[Finding]:
    """Crossings that only one of the two curves knows of."""
    known = {
        curve: set(state.curves.meets[curve].row.tolist())
        for curve in state.live("curves").tolist()
    }
    for row in crossings_of(state):
        contact = bool(state.rows.contact[row])
        for side, curve in enumerate(state.rows.curve[row].tolist()):
            if curve not in known or (contact and side == 1):
                continue  # a contact is no intersection of the line that ends there
            reads = bool((state.rows.reader[row] == curve).any())
            if row not in known[curve] and not (contact and reads):
                name = book.curve_name(curve)
                text = f"is not among the meetings of {name}, its twin is missing: undo the edit"
                yield row_finding(state, book, row, "twin", text)


def crossings_of(state: HullState) -> list[int]:
    """Give the crossings that lie on two curves of lines."""
    rows = state.live("rows")
    curves = state.rows.curve[rows]
    both = (curves >= 0).all(axis=1) & (state.curves.line[curves] >= 0).all(axis=1)
    found: list[int] = rows[both & (state.rows.sort[rows] == Sort.CROSSING)].tolist()
    return found


def _alone(state: HullState, book: AddressBook) -> Iterator[Finding]:
    """Crossings that lie on one curve only."""
    table = state.rows
    for row in state.live("rows").tolist():
        a, b = table.curve[row].tolist()
        if table.sort[row] == Sort.CROSSING and a >= 0 and b < 0:
            text = f"crosses {book.curve_name(a)} and no other curve: its twin is missing"
            yield row_finding(state, book, row, "twin", f"{text}: undo the edit")


def _foreign(state: HullState, book: AddressBook) -> Iterator[Finding]:
    """Meetings of curves that are crossings which have gone, or lie elsewhere."""
    table = state.rows
    for curve in state.live("curves").tolist():
        rows, name = state.curves.meets[curve].row, book.curve_name(curve)
        for row in rows[rows >= 0].tolist():
            if not table.alive[row]:
                text = f"meets a curve at {table.key[row]}, which has gone: undo the edit"
                yield Finding("twin", name, None, None, text)
            elif not (table.curve[row] == curve).any():
                text = f"is among the meetings of {name} and does not lie on it: undo the edit"
                yield row_finding(state, book, row, "twin", text)


# --------------------------------------------------------------------------------------
# Associations: whether their groups exist, and whether crossings agree with them.


def find_associations(state: HullState, book: AddressBook) -> Iterator[Finding]:
    """Give all findings on associations.

    Examples
    --------
    >>> from assoc_hull.edit.checks.link_findings import find_associations
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
    groups = {state.groups.name[group] for group in state.live("groups").tolist()}
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
    """Crossings of lines that are not associated, or with a role against what is said of them."""
    rows = np.array(crossings_of(state), np.int64)
    said = crossing_ways(state, rows)
    held = _held_by_placed(state) if state.rulings else set[str]()
    declared: dict[tuple[int, int], tuple[bool, bool]] = {}
    for row, ways in zip(rows.tolist(), said.tolist(), strict=True):
        curves = state.rows.curve[row].tolist()
        lines = (state.line_of(curves[0]), state.line_of(curves[1]))
        groups = tuple(int(state.lines.group[line]) for line in lines)
        pair = (groups[0], groups[1])
        if pair not in declared:
            declared[pair] = generates(state, *lines)
        override = state.rows.override[row] >= 0
        if not any(declared[pair]):
            yield row_finding(state, book, row, "association", _PARTED)
        elif not state.rulings or state.rows.contact[row]:
            text = _against(declared[pair], Role(int(state.rows.role[row])))
            if text and not override:
                yield row_finding(state, book, row, "association", text)
        elif not override and (text := _against_ruling(state, row, ways, held)):
            yield row_finding(state, book, row, "ruling", text)


_PARTED = "joins groups that are not associated: associate them, or remove the crossing"


def _against_ruling(state: HullState, row: int, ways: tuple[bool, bool], held: set[str]) -> str:
    """Say how a role goes against who rules where the crossing lies; empty if it does not."""
    role, ways = Role(int(state.rows.role[row])), (ways[0], ways[1])
    if all(ways):
        if state.rows.first_role[row] < 0 or state.rows.key[row] in held:
            return ""
        what = "as where one line rules, and lies where none does"
    elif not _against(ways, role):
        return ""
    else:
        lines = [state.line_of(curve) for curve in state.rows.curve[row].tolist()]
        what = f"and lies where {state.lines.name[lines[0 if ways[0] else 1]]} rules"
    return f"{role_words(role)} {what}: say again who rules where, by edit.rule"


def _held_by_placed(state: HullState) -> set[str]:
    """Give the keys of crossings whose stand-in a designer has placed: these are not switched."""
    table = state.rows
    return {
        table.stands_for[row]
        for row in table.stands_for.data.given
        if table.alive[row] and table.sort[row] == Sort.PLACED
    }


def _against(generating: tuple[bool, bool], role: Role) -> str:
    """Say how a role goes against what is declared; empty if it does not."""
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
    """Curves of associated groups that meet and have no crossing there.

    Along a touch there is none to be made: where the two pass one another rounding would say.
    """
    open_, seen = _latent_meetings(state), set[tuple[int, int]]()
    for (curve, line), spots in sorted(open_.items()):
        for other in state.lines.curves[line]:
            back = open_.get((other, state.line_of(curve)))
            pair = (min(curve, other), max(curve, other))
            if back is None or pair in seen:
                continue
            seen.add(pair)
            places, theirs = (
                state.curves.meets[each].xyz[some] for each, some in ((curve, spots), (other, back))
            )
            away = np.abs(places[:, None, :] - theirs[None, :, :]).max(axis=2)
            for i in np.flatnonzero(away.min(axis=1) <= state.tolerances.coincident).tolist():
                there = int(back[away[i].argmin()])
                if runs_along_tangency(state, curve, int(spots[i])) or runs_along_tangency(
                    state, other, there
                ):
                    continue
                x, y, z = places[i].tolist()
                name = f"{book.curve_name(pair[0])} x {book.curve_name(pair[1])}"
                text = "they meet there and have no crossing: dissociate, and associate again"
                yield Finding("association", name, (x, y, z), None, text)


def _latent_meetings(state: HullState) -> dict[tuple[int, int], IntArray]:
    """Give the intersections of curves with planes of lines that are of no crossing, by number."""
    found: dict[tuple[int, int], IntArray] = {}
    for curve in state.live("curves").tolist():
        meets = state.curves.meets[curve]
        latent = (meets.row < 0) & np.isfinite(meets.xyz).all(axis=1)
        for line in np.unique(meets.line[latent]).tolist():
            found[curve, line] = np.flatnonzero(latent & (meets.line == line))
    return found


# --------------------------------------------------------------------------------------
# Notes on roles. After many edits a crossing may define a curve that it now crosses too flatly,
# or too near to another one. The other way round says nothing: a crossing that could define a
# curve may have been left out because the curve would have moved.

_ANGLE = 3.0
"""Degrees below the least angle of the role rule before a crossing is noted."""

_PART = 0.2
"""Part of the least spacing of the role rule, likewise."""


def find_roles(state: HullState, book: AddressBook) -> Iterator[Finding]:
    """Give a note for each curve and crossing that should not define it any more.

    Examples
    --------
    >>> from assoc_hull.edit.checks.link_findings import find_roles
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.model.address import AddressBook
    >>> state = wigley()
    >>> sum(note.kind == "role" for note in find_roles(state, AddressBook(state))) < 10
    True
    """
    may = _may_define(state)
    rows = state.live("rows")
    free = (state.rows.sort[rows] == Sort.CROSSING) & ~state.rows.contact[rows]
    free &= state.rows.override[rows] < 0
    for row in rows[free].tolist():
        for curve in state.rows.reader[row].tolist():
            if may.get((row, curve)) == {False}:
                text = (
                    f"defines {book.curve_name(curve)}, and the role rule would not choose it "
                    "any more: renew the roles of its lines if the curve looks pinched"
                )
                yield row_finding(state, book, row, "role", text)


def _may_define(state: HullState) -> dict[tuple[int, int], set[bool]]:
    """Say for each crossing and curve what the rule chooses with stricter and looser limits.

    ``{False}``: it is left out even within the margins.
    """
    strict, loose = _margin(state.tolerances, 1.0), _margin(state.tolerances, -1.0)
    found: dict[tuple[int, int], set[bool]] = {}
    for curve in state.live("curves").tolist():
        on = points_on(state, curve)
        if len(on.row) < 2 or not bounded(state.curves.spline[curve]):
            continue
        candidates = _candidates(state, curve, on)
        for row, sure, likely in zip(
            on.row.tolist(), choose(candidates, strict), choose(candidates, loose), strict=True
        ):
            found[row, curve] = {bool(sure), bool(likely)}
    return found


def _margin(tolerances: Tolerances, sense: float) -> Tolerances:
    return attrs.evolve(
        tolerances,
        transversal_deg=tolerances.transversal_deg + sense * _ANGLE,
        spacing=tolerances.spacing * (1.0 + sense * _PART),
    )


def _candidates(state: HullState, curve: int, on: PointsOnCurve) -> Candidates:
    """Give the points of a curve as the role rule sees them; angles in degrees.

    An adopted point that is not fixed gets angle 0, so the rule never chooses it.
    """
    other = state.rows.curve[on.row, 1 - on.side]
    crossing = other >= 0
    fixed = (state.rows.sort[on.row] == Sort.PLACED) | state.rows.contact[on.row]
    fixed |= state.rows.kind[on.row, on.side] != 0
    fixed[[0, -1]] = True
    tangent = tangents(state, np.full(len(on.row), curve), on.parameter)
    lines = state.curves.line[np.where(crossing, other, 0)]
    sine = np.abs((tangent * state.lines.normal[lines]).sum(axis=1))
    angle = np.degrees(np.arcsin(np.minimum(sine, 1.0)))
    keep = crossing | fixed
    return Candidates(on.parameter, np.where(keep, angle, 0.0), tangent, fixed)
