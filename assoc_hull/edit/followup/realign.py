"""Watched crossings whose two curves were aligned apart: each by itself, at different branches.

The meetings of a curve are aligned with those it had, curve by curve. Where several come at
once, the least displacements on one curve and on the other may take a crossing to different
places. One of the two curves then passes at the place of the other too, in the same sense and
unclaimed: that is the crossing.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.edit.followup.births_and_deaths import ONE_PLACE, meeting_gap
from assoc_hull.model.align_intersections import Alignment
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.make_objects import Maker
from assoc_hull.model.state import HullState, Meets

__all__ = ["rejoin"]

_Meeting = tuple[int, int]
"""A curve, and the index of a meeting on it."""


def rejoin(maker: Maker, alignments: list[Alignment]) -> None:
    """Put watched crossings of realigned curves back to where both of their curves pass."""
    state = maker.state
    keys = state.rows.key.data
    rows = {row for each in alignments for row in each.row.tolist() if row >= 0}
    for row in sorted(rows, key=lambda each: str(keys[each])):
        watched = state.rows.role.data[row] == Role.WATCHED
        if watched and state.rows.alive.data[row] and state.rows.sort.data[row] == Sort.CROSSING:
            _rejoin(maker, row)


def _rejoin(maker: Maker, row: int) -> None:
    """Move a crossing on one of its curves, if that brings its two places together."""
    state = maker.state
    here = [_meeting_of(state, curve, row) for curve in state.rows.curve.data[row].tolist()]
    if here[0] is None or here[1] is None or _one_place(state, here[0], here[1]) is not None:
        return
    found: list[tuple[float, int, int, int]] = []
    for side, stays in ((0, here[1]), (1, here[0])):
        curve, spot = here[0] if side == 0 else here[1]
        for other in _unclaimed_like(state, curve, spot):
            cost = _one_place(state, (curve, other), stays)
            if cost is not None:
                found.append((cost, side, spot, other))
    if found:
        _, side, spot, other = min(found)
        _attach(maker, row, side, spot, other)


def _meeting_of(state: HullState, curve: int, row: int) -> _Meeting | None:
    spots = np.flatnonzero(state.curves.meets.data[curve].row == row)
    return (curve, int(spots[0])) if len(spots) else None


def _unclaimed_like(state: HullState, curve: int, spot: int) -> list[int]:
    """Give the meetings of a curve with the same plane in the same sense, of no crossing."""
    meets: Meets = state.curves.meets.data[curve]
    like = (meets.line == meets.line[spot]) & (meets.sign == meets.sign[spot]) & (meets.row < 0)
    return list(np.flatnonzero(like).tolist())


def _one_place(state: HullState, one: _Meeting, other: _Meeting) -> float | None:
    """Say how well two meetings fit one another; None if they are not one place."""
    gap, apart = meeting_gap(state, one, other)
    near = gap <= 2.0 * state.tolerances.adoption and apart <= ONE_PLACE
    return gap + 0.01 * apart if near else None


def _attach(maker: Maker, row: int, side: int, spot: int, other: int) -> None:
    """Let another meeting of a curve be the crossing; the one it was becomes latent."""
    table, curve = maker.state.rows, int(maker.state.rows.curve.data[row, side])
    meets: Meets = maker.state.curves.meets.data[curve]
    rows = meets.row.copy()
    rows[spot], rows[other] = -1, row
    maker.journal.set(maker.state.curves.meets, [curve], [attrs.evolve(meets, row=rows)])
    place, at = table.spot.data[[row]].copy(), table.parameter.data[[row]].copy()
    place[0, side], at[0, side] = meets.xyz[other], meets.parameter[other]
    maker.journal.put(table.spot, [row], place)
    maker.journal.put(table.parameter, [row], at)
