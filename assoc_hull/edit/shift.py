"""Shifting a line to another position of its plane: no change of shape.

The line is cut anew from the hull as it is. Its crossings keep their identity as long as
they can be followed along the other curves; what they held at the old place stays behind on
those curves as adopted points. Placed points go along to the new plane.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.edit.branches import track
from assoc_hull.edit.cut import make_piece, new_plane, pieces_of
from assoc_hull.edit.lines import leave_behind
from assoc_hull.edit.marks import find_marks
from assoc_hull.edit.remeet import enter_line, strike_line
from assoc_hull.edit.thread import thread
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import RefusedEditError
from assoc_hull.geometry.closest import closest
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.model.family import Role, Sort
from assoc_hull.model.state import HullState, Meets

__all__ = ["shift_line"]


def shift_line(edit: Transaction, line: int, position: float) -> None:
    """Shift a line.

    Parameters
    ----------
    edit : Transaction
        The edit.
    line : int
        A line of a plane family.
    position : float, m
        New place of its plane along the family's axis.

    Raises
    ------
    BadInputError
        No parallel plane, a number that is not finite, or a plane that is taken.
    NoMeetingError
        The new plane meets fewer than two places.
    RefusedEditError
        The line would have another number of curves there.
    """
    state = edit.state
    group = state.groups.name.data[int(state.lines.group.data[line])]
    number, normal = new_plane(state, group, position)
    marks = find_marks(state, number, normal, position)
    mine = np.array(state.lines.curves.data[line], np.int64)
    crossings, placed = _rows(state, mine)
    known = _followed(state, line, crossings, position)
    pieces = pieces_of(state, line, marks)
    if len(pieces) != len(mine):
        reason = (
            f"{state.lines.name.data[line]} has {len(mine)} curves, at {position:g} m {len(pieces)}"
        )
        raise RefusedEditError(edit.name, (f"{reason}; add a line there instead",))
    edit.pending.structural = True
    leave_behind(edit, crossings, mine)
    edit.maker.roles(crossings, np.full(len(crossings), int(Role.WATCHED)))
    strike_line(edit, line)
    own = np.flatnonzero(state.rows.alive.data & np.isin(state.rows.curve.data[:, 0], mine))
    own = own[state.rows.sort.data[own] == Sort.ADOPTED]
    edit.maker.remove_rows(own)
    edit.journal.put(state.lines.offset, [line], [position])
    for curve, piece in zip(mine.tolist(), pieces, strict=True):
        make_piece(edit, line, piece, state.tolerances.keep, curve, known)
    kept = set(known.values())
    edit.maker.remove_rows([row for row in crossings.tolist() if row not in kept])
    _move_spots(state, edit, marks.xyz, marks.curve, marks.root, known)
    enter_line(edit, line)
    _carry(edit, placed)
    _drop_lost(edit, mine, np.array(sorted(kept), np.int64))


def _rows(state: HullState, mine: IntArray) -> tuple[IntArray, IntArray]:
    """Give the crossings of the line's curves, and their placed points."""
    table = state.rows
    on = table.alive.data & np.isin(table.curve.data, mine).any(axis=1)
    crossings = np.flatnonzero(on & (table.sort.data == Sort.CROSSING))
    return crossings, np.flatnonzero(on & (table.sort.data == Sort.PLACED))


def _followed(
    state: HullState, line: int, crossings: IntArray, position: float
) -> dict[tuple[int, int], int]:
    """Follow each crossing along the other curve; give it by that curve and its new root."""
    normal, start = state.lines.normal.data[line].copy(), float(state.lines.offset.data[line])
    paths: dict[int, dict[int, int]] = {}
    known: dict[tuple[int, int], int] = {}
    for row in crossings.tolist():
        pair = state.rows.curve.data[row].tolist()
        other = pair[0] if state.line_of(pair[1]) == line else pair[1]
        meets: Meets = state.curves.meets.data[other]
        roots = np.flatnonzero(meets.line == line)
        at = np.flatnonzero(meets.row[roots] == row)
        if not len(at):
            continue
        if other not in paths:
            paths[other] = track(state.spline(other), normal, start, position)
        root = paths[other].get(int(at[0]))
        if root is not None:
            known[other, root] = row
    return known


def _move_spots(
    state: HullState,
    edit: Transaction,
    xyz: FloatArray,
    curve: IntArray,
    root: IntArray,
    known: dict[tuple[int, int], int],
) -> None:
    """Tell crossings that the line is not made through where to look for their meetings."""
    for place, mark in zip(xyz, zip(curve.tolist(), root.tolist(), strict=True), strict=True):
        row = known.get(mark)
        if row is not None:
            edit.journal.put(state.rows.spot, [row], [(place, place)])


def _carry(edit: Transaction, placed: IntArray) -> None:
    """Carry placed points along the hull into the new plane."""
    state = edit.state
    for row in placed.tolist():
        curve = int(state.rows.curve.data[row, 0])
        line = state.line_of(curve)
        start = state.rows.xyz.data[row].copy()
        exact = state.lines.normal.data[line] == 1.0
        start[exact] = state.lines.offset.data[line]
        place = closest(state.spline(curve), 0, start[None])[1][0].copy()
        place[exact] = state.lines.offset.data[line]
        edit.journal.put(state.rows.xyz, [row], [place])
        thread(edit.maker, curve, row)
        edit.pending.curves.add(curve)


def _drop_lost(edit: Transaction, mine: IntArray, kept: IntArray) -> None:
    """Remove crossings that were followed, but that the new curve does not reach."""
    state = edit.state
    met = [state.curves.meets.data[curve].row for curve in mine.tolist()]
    made = [state.curves.rows.data[curve] for curve in mine.tolist()]
    lost = np.setdiff1d(kept, np.concatenate([*met, *made]))
    edit.maker.remove_rows(lost)
