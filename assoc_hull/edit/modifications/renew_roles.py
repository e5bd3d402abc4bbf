"""Applying the role rule again, as a modification of its own."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from assoc_hull.edit.followup.births_and_deaths import role_by_rule
from assoc_hull.edit.modifications.set_role import change_role
from assoc_hull.edit.transaction import Transaction
from assoc_hull.model.kinds import Sort

__all__ = ["renew_roles"]


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
    curves = [curve for line in lines for curve in state.lines.curves.data[line]]
    table = state.rows
    mine = table.alive.data & (table.sort.data == Sort.CROSSING) & (table.override.data < 0)
    mine &= np.isin(table.curve.data, curves).any(axis=1)
    rows = sorted(np.flatnonzero(mine).tolist(), key=lambda row: str(table.key.data[row]))
    new = {row: role_by_rule(state, row) for row in rows}
    changed = [row for row in rows if int(new[row]) != int(table.role.data[row])]
    for row in changed:
        change_role(edit, row, new[row])
    return len(changed)
