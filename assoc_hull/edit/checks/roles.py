"""Notes on roles: crossings that define a curve and that the role rule would not choose today.

An edit of shape never changes a role. So after many edits a crossing may define a curve
that it now crosses too flatly, or too near to another one; it is noted only with 3 degrees
or a fifth of the spacing to spare. The other way round says nothing: a crossing that could
define a curve may have been left out because the curve would have moved.
"""

from __future__ import annotations

from collections.abc import Iterator

import attrs
import numpy as np

from assoc_hull.edit.checks.finding import Finding, row_finding
from assoc_hull.edit.checks.shape import bounded
from assoc_hull.model.address import AddressBook
from assoc_hull.model.gaps import tangents
from assoc_hull.model.kinds import Sort
from assoc_hull.model.links import OnCurve, points_on
from assoc_hull.model.roles import Candidates, choose
from assoc_hull.model.state import HullState
from assoc_hull.tolerance import Tolerances

__all__ = ["find_roles"]

_ANGLE = 3.0
_PART = 0.2


def find_roles(state: HullState, book: AddressBook) -> Iterator[Finding]:
    """Give a note for each curve and crossing that should not define it any more.

    Examples
    --------
    >>> from assoc_hull.edit.checks.roles import find_roles
    >>> from assoc_hull.shipped.wigley import wigley
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
        for curve in state.rows.reader.data[row].tolist():
            if may.get((row, curve)) == {False}:
                text = (
                    f"defines {book.curve_name(curve)}, and the role rule would not choose it "
                    "any more: renew the roles of its lines if the curve looks pinched"
                )
                yield row_finding(state, book, row, "role", text)


def _may_define(state: HullState) -> dict[tuple[int, int], set[bool]]:
    """Say for each crossing and curve what the rule may choose, within the margins."""
    strict, loose = _margin(state.tolerances, 1.0), _margin(state.tolerances, -1.0)
    found: dict[tuple[int, int], set[bool]] = {}
    for curve in state.live("curves").tolist():
        on = points_on(state, curve)
        if len(on.row) < 2 or not bounded(state.curves.spline.data[curve]):
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
