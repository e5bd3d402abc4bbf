"""Notes on roles: crossings for which the role rule would choose otherwise today.

An edit of shape never changes a role. So after many edits a crossing may have one that the
rule would not give it any more; it is noted only with 3 degrees or a fifth of the spacing to
spare.
"""

from __future__ import annotations

from collections.abc import Iterator

import attrs
import numpy as np

from assoc_hull.edit.finding import Finding, row_finding
from assoc_hull.edit.topology import generates
from assoc_hull.model.address import AddressBook
from assoc_hull.model.family import Role, Sort
from assoc_hull.model.gaps import tangents
from assoc_hull.model.place import OnCurve, points_on
from assoc_hull.model.roles import Candidates, choose, role_of
from assoc_hull.model.state import HullState
from assoc_hull.tolerance import Tolerances

__all__ = ["find_roles"]

_ANGLE = 3.0
_PART = 0.2


def find_roles(state: HullState, book: AddressBook) -> Iterator[Finding]:
    """Give a note for each crossing whose role the rule would no longer choose.

    Examples
    --------
    >>> from assoc_hull.edit.check_roles import find_roles
    >>> from assoc_hull.examples.wigley import wigley
    >>> from assoc_hull.model.address import AddressBook
    >>> state = wigley()
    >>> sum(note.kind == "role" for note in find_roles(state, AddressBook(state))) < 10
    True
    """
    may = _may_define(state)
    rows = state.live("rows")
    free = (state.rows.sort.data[rows] == Sort.CROSSING) & ~state.rows.contact.data[rows]
    free &= state.rows.override.data[rows] < 0
    for row in rows[free].tolist():
        a, b = state.rows.curve.data[row].tolist()
        links = generates(state, state.line_of(a), state.line_of(b))
        role = Role(int(state.rows.role.data[row]))
        ways = {
            role_of(first, second, links)
            for first in may.get((row, a), {False, True})
            for second in may.get((row, b), {False, True})
        }
        if role not in ways:
            wanted = " or ".join(sorted(each.text for each in ways))
            text = f"is {role.text}; by the role rule it would now be {wanted}"
            yield row_finding(state, book, row, "role", text)


def _may_define(state: HullState) -> dict[tuple[int, int], set[bool]]:
    """Say for each crossing and curve what the rule may choose, within the margins."""
    strict, loose = _margin(state.tolerances, 1.0), _margin(state.tolerances, -1.0)
    found: dict[tuple[int, int], set[bool]] = {}
    for curve in state.live("curves").tolist():
        on = points_on(state, curve)
        if len(on.row) < 2:
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


def _candidates(state: HullState, curve: int, on: OnCurve) -> Candidates:
    """Give the crossings of a curve as the role rule sees them."""
    other = state.rows.curve.data[on.row, 1 - on.side]
    crossing = other >= 0
    fixed = (state.rows.sort.data[on.row] == Sort.PLACED) | state.rows.contact.data[on.row]
    fixed |= state.rows.kind.data[on.row, on.side] != 0
    fixed[[0, -1]] = True
    tangent = tangents(state, np.full(len(on.row), curve), on.parameter)
    lines = state.curves.line.data[np.where(crossing, other, 0)]
    sine = np.abs((tangent * state.lines.normal.data[lines]).sum(axis=1))
    angle = np.degrees(np.arcsin(np.minimum(sine, 1.0)))
    keep = crossing | fixed
    return Candidates(on.parameter, np.where(keep, angle, 0.0), tangent, fixed)
