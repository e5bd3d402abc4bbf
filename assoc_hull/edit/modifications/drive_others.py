"""Letting a curve that comes from definitions drive the lines that it crosses.

A line that was cut, or shifted, passes the others where these lie: it may be watched there, or
even driven. Once it comes from definitions it gives the value, and points that the other lines
adopted close by, in its place, go.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.edit.followup.births_and_deaths import generates
from assoc_hull.edit.modifications.set_role import change_role
from assoc_hull.edit.transaction import Transaction
from assoc_hull.geometry.curves import IntArray
from assoc_hull.model.generated import kept_rows
from assoc_hull.model.kinds import Role, Sort

__all__ = ["drive_others"]


def drive_others(edit: Transaction, curve: int) -> None:
    """Let a curve drive those on which its group alone generates points.

    Parameters
    ----------
    edit : Transaction
        The edit.
    curve : int
        A curve. Crossings whose role was set by hand keep it; so do those with a point that the
        other curve cannot do without close by, which are watched.
    """
    state, table = edit.state, edit.state.rows
    mine = table.alive.data & (table.sort.data == Sort.CROSSING) & ~table.contact.data
    mine &= (table.curve.data[:, 0] == curve) & (table.override.data < 0)
    for row in np.flatnonzero(mine).tolist():
        other = int(table.curve.data[row, 1])
        one_way = generates(state, state.line_of(curve), state.line_of(other)) == (True, False)
        if one_way and table.role.data[row] != Role.DRIVES_B:
            room = _make_room(edit, other, row)
            change_role(edit, row, Role.DRIVES_B if room else Role.WATCHED)


def _make_room(edit: Transaction, curve: int, row: int) -> bool:
    """Take out what a curve adopted beside a crossing; tell whether nothing else is too close."""
    state = edit.state
    rows: IntArray = state.curves.rows.data[curve]
    if row in rows.tolist():
        return True
    step = np.diff(state.rows.xyz.data[rows], axis=0)
    least = state.tolerances.spacing * float(np.median(np.sqrt((step * step).sum(axis=1))))
    away = state.rows.xyz.data[rows] - state.rows.spot.data[row, 0]
    near = np.sqrt((away * away).sum(axis=1)) < least
    adopted = (state.rows.sort.data[rows] == Sort.ADOPTED) & ~np.isin(rows, kept_rows(state))
    gone = rows[near & adopted]
    if len(gone):
        edit.maker.define(curve, rows[~np.isin(rows, gone)])
        edit.maker.remove_rows(gone)
        edit.pending.curves.add(curve)
    return not (near & ~adopted).any()
