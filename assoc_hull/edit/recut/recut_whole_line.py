"""Followers that come to end elsewhere on boundary curves: cut wholly anew, as a shifted line.

Such a line is taken out while the others are carried and cut; when they are lofted, its
plane is met with them, and crossings with drivers that are still there keep their identity.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

import numpy as np

from assoc_hull.edit.followup.tangencies import Touch, clear, with_touches
from assoc_hull.edit.newline.kept_runs import NO_STAYS, Stays, rest
from assoc_hull.edit.newline.plane_intersections import strike_line
from assoc_hull.edit.newline.plane_marks import find_marks
from assoc_hull.edit.newline.shift_line import cut_anew, rows_of
from assoc_hull.edit.recut.carried_points import Carried
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import NoMeetingError
from assoc_hull.geometry.splines.plane_intersections import meet_planes
from assoc_hull.model.kinds import BoundaryKind, Role
from assoc_hull.model.state import HullState

__all__ = ["bring_back", "take_out"]


def take_out(edit: Transaction, work: Carried, *, may_go: bool = False) -> None:
    """Take lines that are cut anew out of the net, and note that they come back.

    Those that the hull does not reach any more go for good where they may.
    """
    state, put = edit.state, edit.journal.put
    keys = state.lines.key.data
    # Those of lower rank come back first, as the others are cut from them too.
    for line in sorted(work.anew, key=lambda each: (state.family(each).rank, str(keys[each]))):
        mine = np.array(state.lines.curves.data[line], np.int64)
        stays = work.stays[line]
        crossings, placed = (np.setdiff1d(rows, stays.rows()) for rows in rows_of(state, mine))
        edit.maker.roles(crossings, np.full(len(crossings), int(Role.WATCHED)))
        rest(edit.maker, stays)
        strike_line(edit, line)
        put(state.rows.xyz, placed, work.image[placed])
        put(state.curves.alive, mine, False)
        put(state.lines.alive, [line], False)
        touches = work.touched(line)
        known = work.anew[line]
        edit.pending.after.append(
            partial(bring_back, edit, line, known, touches, stays, may_go=may_go)
        )


def bring_back(
    edit: Transaction,
    line: int,
    known: dict[tuple[int, int], int],
    touches: Sequence[Touch] = (),
    stays: Stays = NO_STAYS,
    *,
    may_go: bool = False,
) -> None:
    """Cut a line that was taken out from the others as they are now; what stays joins the cut.

    Where the hull does not reach its plane any more the line goes if it may, and the report says
    so.

    Raises
    ------
    NoMeetingError
        So it is, and the line may not go, or the designer has placed points on it.
    """
    state, put = edit.state, edit.journal.put
    edit.document.refresh()
    normal, offset = state.lines.normal.data[line].copy(), float(state.lines.offset.data[line])
    try:
        marks = find_marks(state, int(state.lines.group.data[line]), normal, offset)
    except NoMeetingError as error:
        if not may_go:
            raise
        _let_go(edit, line, error)
        return
    if touches:
        every = set(zip(marks.curve.tolist(), marks.root.tolist(), strict=True))
        marks = with_touches(state, marks, line, touches)
        clear(edit.maker, [each for each in touches if _bounds(state, each)])
        left = set(zip(marks.curve.tolist(), marks.root.tolist(), strict=True))
        known = {mark: row for mark, row in known.items() if mark not in every - left}
    put(state.lines.alive, [line], True)
    put(state.curves.alive, state.lines.curves.data[line], True)
    cut_anew(edit, line, marks, _still_there(edit, line, known), stays)


def _let_go(edit: Transaction, line: int, error: NoMeetingError) -> None:
    """Remove a line that was taken out for good, unless it holds what the designer placed."""
    state = edit.state
    mine = np.array(state.lines.curves.data[line], np.int64)
    crossings, placed = rows_of(state, mine)
    if len(placed):
        raise error
    on = state.rows.alive.data & np.isin(state.rows.curve.data, mine).any(axis=1)
    edit.pending.gone += sorted(str(state.rows.key.data[row]) for row in crossings.tolist())
    edit.maker.remove_rows(np.flatnonzero(on))
    edit.pending.curves -= set(mine.tolist())
    edit.pending.notes.append(f"{state.lines.name.data[line]} is gone: {error}")


def _bounds(state: HullState, touch: Touch) -> bool:
    """Tell whether a touch is of a boundary curve that lines end on."""
    kind = state.lines.boundary.data[state.line_of(touch.curve)]
    return bool(kind == BoundaryKind.END)


def _still_there(
    edit: Transaction, line: int, known: dict[tuple[int, int], int]
) -> dict[tuple[int, int], int]:
    """Leave out crossings with curves that, lofted, meet the plane otherwise than their image."""
    table = edit.state.lines
    plane = table.normal.data[line].copy(), table.offset.data[[line]].copy()
    count = {curve: meet_planes(edit.state.spline(curve), *plane).count for curve, _ in known}
    rows = edit.state.rows
    return {
        (curve, root): row for (curve, root), row in known.items()
        if root < count[curve] and rows.alive.data[row]
    }  # fmt: skip
