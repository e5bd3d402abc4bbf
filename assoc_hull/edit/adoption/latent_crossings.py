"""Crossings that adoption left open: lines that meet where both were to end on a third.

Where a boundary line runs in the plane of a section (a vertical stem at a station), the section
cannot end on it by their intersection. Its end becomes an adopted point; another line that ends at
the same place then meets it, and has no crossing with it. Or both lines were lengthened to the
boundary line, and meet only there.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assoc_hull.edit.crossings.settle_crossings import latent_intersections, make_crossing
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.graph.journal import Journal
from assoc_hull.model.address import AddressBook
from assoc_hull.model.make_objects import Maker
from assoc_hull.model.tables import HullState

__all__ = ["at_ends", "make_latent_crossings"]


def make_latent_crossings(state: HullState) -> tuple[str, ...]:
    """Make the crossings of lines that meet and have none; gives their addresses, sorted.

    The role is what the role rule gives there; the curves stay as they are, since a point of
    their own holds each of them there.
    """
    maker, born = Maker(state, Journal()), list[int]()
    keys = state.curves.key.data
    latent = latent_intersections(state, state.live("curves"))
    for curve, spot in sorted(latent, key=lambda each: (str(keys[each[0]]), each[1])):
        if _meets_at_once(state, curve, spot):
            row = make_crossing(maker, curve, spot, set(), watch=True)
            born += [] if row is None else [row]
    return tuple(sorted(map(AddressBook(state).address, born)))


def _meets_at_once(state: HullState, curve: int, spot: int) -> bool:
    """Tell whether a curve of the other line passes the same place; `check` asks the same.

    Within the tolerance of adoption two places are one, too, but where both lines end: there each
    ends on the third line by itself, and a crossing would leave a sliver of a cell.
    """
    meets = state.curves.meets[curve]
    if meets.row[spot] >= 0:
        return False
    line, place = state.line_of(curve), meets.xyz[spot]
    ending = bool(at_ends(state, curve, place[None])[0])
    for other in state.lines.curves[int(meets.line[spot])]:
        theirs = state.curves.meets[other]
        free = theirs.xyz[(theirs.line == line) & (theirs.row < 0)]
        away = np.abs(free - place).max(axis=1, initial=0.0)
        both_end = ending & at_ends(state, other, free)
        near = np.where(both_end, state.tolerances.coincident, state.tolerances.adoption)
        if (away <= near).any():
            return True
    return False


def at_ends(state: HullState, curve: int, places: FloatArray) -> NDArray[np.bool_]:
    """Tell which of the places (k, 3) on a curve are its ends, within the tolerance of adoption."""
    ends = state.spline(curve).xyz[[0, -1]]
    away = np.sqrt(((places[:, None] - ends[None]) ** 2).sum(axis=2)).min(axis=1)
    near: NDArray[np.bool_] = away <= state.tolerances.adoption
    return near
