"""Drags of one section: the same moves for the engine and for the bare arithmetic."""

from __future__ import annotations

import numpy as np

from assoc_hull.edit.document import Document
from assoc_hull.edit.step import EditReport
from assoc_hull.edit.transaction import Transaction
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.tables import HullState
from benchmarks.net import section_rows

__all__ = ["MOVED", "Dragging", "places"]

MOVED = (10, 20, 30)
"""The points of the section that a drag moves; so many that every line feels it."""

_REACH = 1e-3


def places(start: FloatArray, number: int) -> FloatArray:
    """Give where drag `number` puts the moved points, (3, 3), m, from where they began."""
    turn = 0.1 * number + np.arange(len(start))
    found = start.copy()
    found[:, 1] += _REACH * np.sin(turn)
    found[:, 2] -= _REACH * np.cos(turn)
    return found


class Dragging:
    """A hull with its history, one of whose sections is dragged to and fro.

    Parameters
    ----------
    state : HullState
        The net, alone or the first of its copies.
    """

    def __init__(self, state: HullState) -> None:
        self.document = Document(state)
        self.rows = section_rows(state)[list(MOVED)]
        self.start = state.rows.xyz[self.rows].copy()
        self.count = 0

    def __call__(self) -> EditReport:
        """Drag once, with alignment, checks, journal, causes and report."""
        with Transaction(self.document, "drag") as edit:
            edit.write(self.rows, places(self.start, self.count), "the drag")
        self.count += 1
        assert edit.report is not None
        return edit.report

    def forget(self) -> None:
        """Let go of the history."""
        self.document.history.clear()
        self.document.steps.clear()
