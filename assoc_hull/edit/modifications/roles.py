"""Change what crossings define: by the designer's word, or by the role rule again.

An edit of shape never changes a role, so after many edits the rule might choose otherwise; applying
it again is a modification of its own. Where a crossing stops defining a curve, an adopted point
holds the shape in its place; where it starts, one that stood in for it goes.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from assoc_hull.arguments import word
from assoc_hull.edit.crossings.adopted_points import insert_defining_point, link_adopted_points
from assoc_hull.edit.crossings.settle_crossings import role_by_rule
from assoc_hull.edit.lines.remove_line import prune_points
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import BadInputError, PointRoleError
from assoc_hull.geometry.curves import IntArray
from assoc_hull.model.address import address
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.make_objects import PointSpec
from assoc_hull.model.tables import HullState

__all__ = [
    "change_role",
    "renew_roles",
    "set_role",
]

_SAME = 1e-3
"""Times `Tolerances.factor`: an adopted point as near as this (m) stood in for the
crossing that now defines."""


def set_role(edit: Transaction, row: int, role: str | None) -> None:
    """Override the role of a crossing, or give it back to the rule.

    Parameters
    ----------
    edit : Transaction
        The edit.
    row : int
        The crossing.
    role : {"shared", "drives a", "drives b", "watched"} or None
        What it is to define; None: what the role rule says.

    Raises
    ------
    PointRoleError
        The point is no crossing, or a contact that its line must be made through.
    BadInputError
        An unknown role, or a crossing that the same edit moves.
    """
    state = edit.state
    if state.rows.sort[row] != Sort.CROSSING:
        raise PointRoleError(address(state, row), "no crossing", None, "only crossings have roles")
    known = {each.text: each for each in Role}
    if role is not None and word(role, "role") not in known:
        raise BadInputError(
            f"the role {role!r}", f"at {address(state, row)}", f"use one of {', '.join(known)}"
        )
    if row in edit.pending.values:
        raise BadInputError(
            "a point is moved and given a role in one transaction",
            f"{address(state, row)}, in set_role",
            "leave one of the two out, or use two transactions",
        )
    new = role_by_rule(state, row) if role is None else known[role]
    contact = bool(state.rows.contact[row])
    if contact and new in (Role.DRIVES_A, Role.WATCHED):
        raise PointRoleError(
            address(state, row), "a contact with a boundary curve", None,
            "its line is always made through it: use 'shared' or 'drives b'",
        )  # fmt: skip
    edit.journal.put(state.rows.override, [row], -1 if role is None else int(new))
    change_role(edit, row, new)


def change_role(edit: Transaction, row: int, new: Role) -> None:
    """Give a crossing another role, with the points of its curves that follow from it."""
    state = edit.state
    old = Role(int(state.rows.role[row]))
    if new is old:
        return
    edit.refuse_moved(np.array([row]))
    if old is Role.WATCHED:
        # its curves pass it in two places: the value is that of the curve that gives it now
        side = int(new is Role.DRIVES_A)
        edit.journal.put(state.rows.xyz, [row], state.rows.spot[row, side][None])
    edit.maker.roles(np.array([row]), np.array([int(new)]))
    reader = state.rows.reader[row]
    for side, curve in enumerate(state.rows.curve[row].tolist()):
        rows: IntArray = state.curves.rows[curve]
        inside = row in rows.tolist()
        if reader[side] == curve and not inside:
            _drop_stand_in(edit, curve, row)
            insert_defining_point(edit.maker, curve, row)
        elif reader[side] != curve and inside:
            _leave_stand_in(edit, curve, row)
        link_adopted_points(state, np.array([curve]), edit.journal)
        if (reader[side] == curve) != inside:
            edit.pending.curves.add(curve)
    if new in (Role.DRIVES_A, Role.DRIVES_B):
        edit.pending.computed.add(row)
    if new is Role.WATCHED:
        limit = 2.0 * state.tolerances.adoption
        edit.journal.put(state.rows.limit, [row], [limit])
    else:
        edit.journal.put(state.rows.limit, [row], [np.nan])
        edit.journal.put(state.rows.gap, [row], [np.nan])
    edit.pending.structural = True


def _leave_stand_in(edit: Transaction, curve: int, row: int) -> None:
    """Let an adopted point hold the shape where the crossing did, if the curve needs it."""
    place = edit.state.rows.xyz[row].copy()
    point = int(edit.maker.points([PointSpec(curve, place, Sort.ADOPTED)])[0])
    rows: IntArray = edit.state.curves.rows[curve]
    edit.maker.define(curve, np.where(rows == row, point, rows))
    prune_points(edit, curve, np.array([point]))


def _drop_stand_in(edit: Transaction, curve: int, row: int) -> None:
    """Take out an adopted point that held the shape where the crossing now does."""
    state: HullState = edit.state
    rows: IntArray = state.curves.rows[curve]
    step = state.rows.xyz[rows] - state.rows.xyz[row]
    near = np.sqrt((step * step).sum(axis=1)) < state.tolerances.factor * _SAME
    gone = rows[near & (state.rows.sort[rows] == Sort.ADOPTED)]
    if len(gone):
        edit.maker.define(curve, rows[~np.isin(rows, gone)])
        edit.maker.remove_rows(gone)


def renew_roles(edit: Transaction, lines: Sequence[int]) -> int:
    """Give the crossings of lines the roles that the rule would choose now.

    An edit of shape never changes a role; this does. Overridden crossings keep theirs.
    Where a curve would move by more than 1 mm because a crossing no longer defines it, an
    adopted point stays in its place.

    Parameters
    ----------
    edit : Transaction
        The edit.
    lines : sequence of int
        The lines.

    Returns
    -------
    int
        How many roles changed.
    """
    state = edit.state
    curves = [curve for line in lines for curve in state.lines.curves[line]]
    table = state.rows
    mine = table.alive.data & (table.sort.data == Sort.CROSSING) & (table.override.data < 0)
    mine &= np.isin(table.curve.data, curves).any(axis=1)
    rows = sorted(np.flatnonzero(mine).tolist(), key=lambda row: str(table.key[row]))
    new = {row: role_by_rule(state, row) for row in rows}
    changed = [row for row in rows if int(new[row]) != int(table.role[row])]
    for row in changed:
        change_role(edit, row, new[row])
    return len(changed)
