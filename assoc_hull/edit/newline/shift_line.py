"""Shifting a line to another position of its plane: no change of shape.

The line is cut anew from the hull as it is. Its crossings keep their identity as long as
they can be followed along the other curves; what they held at the old place stays behind on
those curves as adopted points. Placed points go along to the new plane.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.edit.followup.births_and_deaths import unmeet
from assoc_hull.edit.followup.tangencies import NO_ROOT
from assoc_hull.edit.followup.thread import thread
from assoc_hull.edit.newline.add_line import make_piece, pieces_of
from assoc_hull.edit.newline.branches_of_plane import track_each
from assoc_hull.edit.newline.kept_runs import (
    NO_STAYS,
    Stays,
    come_back,
    compute,
    give_up,
    settle_runs,
)
from assoc_hull.edit.newline.line_planes import shifted_plane
from assoc_hull.edit.newline.pieces import gather, match_pieces
from assoc_hull.edit.newline.plane_intersections import enter_line, strike_line
from assoc_hull.edit.newline.plane_marks import Marks, find_marks, spread
from assoc_hull.edit.newline.remove_line import leave_behind
from assoc_hull.edit.transaction import Transaction
from assoc_hull.geometry.curves import IntArray, SplineBatch
from assoc_hull.geometry.splines.closest import closest
from assoc_hull.geometry.splines.plane_intersections import meet_planes
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.state import HullState, Meets

__all__ = ["cut_anew", "rows_of", "shift_line"]


def shift_line(edit: Transaction, line: int, position: float) -> None:
    """Shift a line.

    Parameters
    ----------
    edit : Transaction
        The edit.
    line : int
        A line of a plane family.
    position : float, m
        New place of its plane along the family's axis; of a diagonal, which keeps its angle,
        the height at the centre plane.

    Raises
    ------
    BadInputError
        No parallel plane, a number that is not finite, or a plane that is taken.
    NoMeetingError
        The new plane meets fewer than two places.
    """
    state = edit.state
    cut = shifted_plane(state, line, position)
    position = cut.offset
    if position == float(state.lines.offset.data[line]):
        return
    marks = find_marks(state, cut.group, cut.normal, position)
    mine = np.array(state.lines.curves.data[line], np.int64)
    crossings, placed = rows_of(state, mine)
    known = _followed(state, line, crossings, position)
    edit.refuse_moved(placed)
    edit.pending.structural = True
    leave_behind(edit, crossings, mine)
    strike_line(edit, line)
    edit.journal.put(state.lines.offset, [line], [position])
    cut_anew(edit, line, marks, known)


def cut_anew(
    edit: Transaction,
    line: int,
    marks: Marks,
    known: dict[tuple[int, int], int],
    stays: Stays = NO_STAYS,
) -> None:
    """Cut a line again where its plane now meets the hull; nothing else may read it.

    Parameters
    ----------
    edit : Transaction
        The edit.
    line : int
        The line; its plane stands in the tables, and no meeting of other curves names it.
    marks : Marks
        Where its plane meets the lines it is cut from.
    known : dict of (int, int) to int
        Crossings that keep their identity, by the other curve and the meeting, counted
        along it.
    stays : Stays
        Runs of the line that stay as they are.
    """
    state = edit.state
    mine = np.array(state.lines.curves.data[line], np.int64)
    every, placed = rows_of(state, mine)
    parts = pieces_of(edit, line, marks)
    left = stays.on(state, [spread(part) for part in parts])
    edit.pending.curves |= give_up(edit.maker, stays, left)
    crossings, placed = (np.setdiff1d(rows, left.rows()) for rows in (every, placed))
    edit.maker.roles(crossings, np.full(len(crossings), int(Role.WATCHED)))
    _drop_adopted(edit, mine, left.rows())
    pieces = match_pieces(edit, line, parts, known)
    settle_runs(edit.maker, left, pieces)
    for curve, piece in pieces:
        make_piece(edit, line, spread(piece), state.tolerances.keep, curve, known, left)
    come_back(edit.maker, left)
    kept = set(known.values())
    edit.maker.remove_rows([row for row in crossings.tolist() if row not in kept])
    _bring_along(edit, line, known)
    gather(edit, line, pieces, known)
    enter_line(edit, line, left.rows())
    edit.pending.curves |= compute(edit.maker, left)
    _carry(edit, np.array([curve for curve, _ in pieces]), placed)
    _drop_lost(edit, np.array([curve for curve, _ in pieces]), np.array(sorted(kept), np.int64))
    _tell(edit, every, np.array([curve for curve, _ in pieces]))


def _tell(edit: Transaction, before: IntArray, curves: IntArray) -> None:
    """Put the crossings that came and went on the way into the report."""
    keys = edit.state.rows.key.data
    after = rows_of(edit.state, curves)[0]
    edit.pending.born += sorted(keys[row] for row in np.setdiff1d(after, before).tolist())
    edit.pending.gone += sorted(keys[row] for row in np.setdiff1d(before, after).tolist())


def _drop_adopted(edit: Transaction, mine: IntArray, stay: IntArray) -> None:
    """Take the line's own adopted points out: they held the shape of another place."""
    table = edit.state.rows
    own = table.alive.data & np.isin(table.curve.data[:, 0], mine)
    own = np.flatnonzero(own & (table.sort.data == Sort.ADOPTED))
    edit.maker.remove_rows(np.setdiff1d(own, stay))


def rows_of(state: HullState, mine: IntArray) -> tuple[IntArray, IntArray]:
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
    others = _partners_of(state, line, crossings)
    batch = SplineBatch.join([state.spline(curve) for curve in others])
    known: dict[tuple[int, int], int] = {}
    for other, path in zip(others, track_each(batch, normal, start, position), strict=True):
        meets: Meets = state.curves.meets.data[other]
        rows = meets.row[meets.line == line].tolist()
        known |= {(other, new): rows[old] for old, new in path.items() if rows[old] >= 0}
    return known


def _partners_of(state: HullState, line: int, crossings: IntArray) -> list[int]:
    """Give the curves on the other side of a line's crossings, ascending."""
    pairs = state.rows.curve.data[crossings]
    mine = state.curves.line.data[pairs] == line
    return sorted(set(pairs[~mine].tolist()))


def _bring_along(edit: Transaction, line: int, known: dict[tuple[int, int], int]) -> None:
    """Note where followed crossings have come to, so that both curves find them there."""
    if not known:
        return
    state = edit.state
    plane = state.lines.normal.data[line], state.lines.offset.data[[line]]
    others = sorted({other for other, _ in known})
    met = meet_planes(SplineBatch.join([state.spline(curve) for curve in others]), *plane)
    first = np.searchsorted(met.curve, np.arange(len(others))).tolist()
    start = dict(zip(others, first, strict=True))
    for (other, root), row in sorted(known.items()):
        if root == NO_ROOT:
            continue
        place = met.xyz[start[other] + root]
        edit.journal.put(state.rows.spot, [row], [[place, place]])


def _carry(edit: Transaction, curves: IntArray, placed: IntArray) -> None:
    """Carry placed points along the hull into the new plane, each to the nearest piece."""
    state = edit.state
    batch = SplineBatch.join([state.spline(curve) for curve in curves.tolist()])
    for row in placed.tolist():
        exact = state.lines.normal.data[state.line_of(int(curves[0]))] == 1.0
        start = state.rows.xyz.data[row].copy()
        start[exact] = state.lines.offset.data[state.line_of(int(curves[0]))]
        feet = [closest(batch, i, start[None]) for i in range(batch.count)]
        best = int(np.argmin([float(foot[2][0]) for foot in feet]))
        place, curve = feet[best][1][0].copy(), int(curves[best])
        place[exact] = start[exact]
        edit.journal.put(state.rows.xyz, [row], [place])
        edit.journal.put(state.rows.curve, [row], [(curve, -1)])
        edit.journal.put(state.rows.reader, [row], [(curve, -1)])
        thread(edit.maker, curve, row)
        edit.pending.curves.add(curve)


def _drop_lost(edit: Transaction, mine: IntArray, kept: IntArray) -> None:
    """Remove crossings that were followed, but that the new curve does not reach."""
    state = edit.state
    met = [state.curves.meets.data[curve].row for curve in mine.tolist()]
    made = [state.curves.rows.data[curve] for curve in mine.tolist()]
    lost = np.setdiff1d(kept, np.concatenate([*met, *made]))
    for row in lost.tolist():
        for curve in state.rows.curve.data[row].tolist():
            unmeet(edit.maker, curve, row)
    edit.maker.remove_rows(lost)
