"""Points that stand in for crossings which define their line no more, or never did.

Where a crossing is watched, an adopted point may lie at its place and define the line instead.
When a mapping carries the drivers, such a point goes where the crossing goes.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.edit.recut.carried_points import Carried
from assoc_hull.geometry.curves import IntArray
from assoc_hull.model.kinds import Sort
from assoc_hull.model.state import Meets

__all__ = ["settle_stand_ins"]

_SAME = 1e-3
"""A point as near as this (m) to a crossing stands in for it."""


def settle_stand_ins(work: Carried) -> None:
    """Give stand-ins of followers the places that their crossings with drivers have come to."""
    state = work.state
    for curve in state.live("curves").tolist():
        if work.drives(curve) or state.line_of(curve) in work.anew:
            continue
        own, crossing = _own(work, curve), _settled(work, curve)
        if not len(own) or not len(crossing):
            continue
        side = (state.rows.curve.data[crossing, 0] != curve).astype(np.int64)
        spot = state.rows.spot.data[crossing, side]
        away = np.sqrt(((state.rows.xyz.data[own][:, None] - spot[None]) ** 2).sum(axis=2))
        near = away.argmin(axis=1)
        mine = away.min(axis=1) <= _SAME
        work.value[own[mine]] = work.value[crossing[near[mine]]]
        work.known[own[mine]] = True


def _own(work: Carried, curve: int) -> IntArray:
    """Give the adopted points of a follower that are not settled, and that the mapping moves."""
    rows: IntArray = work.state.curves.rows.data[curve]
    adopted = work.state.rows.sort.data[rows] == Sort.ADOPTED
    found: IntArray = rows[adopted & ~work.known[rows] & ~work.still[rows]]
    return found


def _settled(work: Carried, curve: int) -> IntArray:
    """Give the crossings on a follower that do not define it and have come to their places."""
    meets: Meets = work.state.curves.meets.data[curve]
    rows = meets.row[meets.row >= 0]
    rows = rows[work.known[rows] & ~(work.state.rows.reader.data[rows] == curve).any(axis=1)]
    return np.array([row for row in rows.tolist() if row not in work.gone], np.int64)
