"""Boundary curves that come to meet the plane of a line more or fewer times than before.

A line has a piece between every two meetings of its plane with the boundary curves that it
ends on. An edit of such a curve makes and unmakes no pieces: a new pair of meetings stays
latent, and is told; an edit by which a piece would lose its end is refused.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from assoc_hull.edit.checks.after_update import curve_title
from assoc_hull.model.align_intersections import Alignment
from assoc_hull.model.kinds import BoundaryKind
from assoc_hull.model.state import HullState, Meets

__all__ = ["ends_at_risk", "find_endless", "note_new_ends"]


def _bounding(state: HullState, alignments: Sequence[Alignment]) -> list[Alignment]:
    kind = state.lines.boundary.data
    return [each for each in alignments if kind[state.line_of(each.curve)] == BoundaryKind.END]


def ends_at_risk(state: HullState, alignments: Sequence[Alignment]) -> list[tuple[int, int]]:
    """Give the contacts that have no meeting on their boundary curve, with the curves they end."""
    return [
        (row, int(state.rows.curve.data[row, 1]))
        for each in _bounding(state, alignments)
        for row in each.gone.tolist()
        if state.rows.alive.data[row] and state.rows.contact.data[row]
    ]


def find_endless(state: HullState, ends: Sequence[tuple[int, int]]) -> tuple[str, ...]:
    """Say which curves have lost one of the given ends."""
    lost = sorted({curve for row, curve in ends if not state.rows.alive.data[row]})
    return tuple(
        f"{curve_title(state, curve)} has no end any more on the boundary curve that moved away: "
        "make the move smaller, or shift or remove the line first"
        for curve in lost
        if state.curves.alive.data[curve]
    )


def note_new_ends(state: HullState, alignments: Sequence[Alignment]) -> list[str]:
    """Tell where boundary curves have come to meet planes of lines that have no piece there."""
    notes: list[str] = []
    for each in _bounding(state, alignments):
        meets: Meets = state.curves.meets.data[each.curve]
        fresh = each.come[each.come < len(meets.row)]
        for spot in fresh[meets.row[fresh] < 0].tolist():
            x, y, z = np.asarray(meets.xyz[spot]).tolist()
            notes.append(
                f"{curve_title(state, each.curve)} has come to meet the plane of "
                f"{state.lines.name.data[int(meets.line[spot])]} at ({x:.3f}, {y:.3f}, {z:.3f}) m, "
                "where that has no piece: shift it, or remove and add it, to cut it anew"
            )
    return notes
