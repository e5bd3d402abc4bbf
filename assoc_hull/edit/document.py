"""A hull with its history: one writer, one transaction at a time, undo and redo.

Undo and redo run the journal of a step backward and forward; they never compute anything.
"""

from __future__ import annotations

import operator

import attrs
import numpy as np

from assoc_hull.arguments import shown
from assoc_hull.edit.report import Step
from assoc_hull.errors import BadInputError
from assoc_hull.model.index import Index, build_index
from assoc_hull.model.state import HullState

__all__ = ["Document"]


@attrs.define(eq=False)
class Document:
    """A hull's tables, the look-ups derived from them, and the steps that made them.

    Attributes
    ----------
    state : HullState
        The published tables.
    history, undone : list of Step
        Committed steps, oldest first; steps taken back, the last one taken back last.
    writer : object
        The transaction that is open; None if none is.
    """

    state: HullState
    history: list[Step] = attrs.field(factory=list)
    undone: list[Step] = attrs.field(factory=list)
    writer: object = attrs.field(default=None, init=False)
    _index: Index | None = attrs.field(default=None, init=False)

    @property
    def index(self) -> Index:
        """Look-ups derived from the tables, when they are first needed.

        So a hull whose links run in a ring can be opened, and be told what is wrong.
        """
        if self._index is None:
            self._index = build_index(self.state)
        return self._index

    def refresh(self) -> None:
        """Derive the look-ups anew, after the structure changed."""
        self._index = build_index(self.state)

    def commit(self, step: Step) -> None:
        """Take a finished step into the history; what can fail comes first."""
        self._revise(step)
        self.undone.clear()
        self.history.append(step)

    def undo(self, count: int = 1) -> list[Step]:
        """Take back the last steps.

        Raises
        ------
        BadInputError
            If there are not so many, or an edit is open.
        """
        self._enough(self.history, count, "undo")
        return [self._turn(self.history, self.undone, forward=False) for _ in range(count)]

    def redo(self, count: int = 1) -> list[Step]:
        """Make steps that were taken back again.

        Raises
        ------
        BadInputError
            If there are not so many, or an edit is open.
        """
        self._enough(self.undone, count, "redo")
        return [self._turn(self.undone, self.history, forward=True) for _ in range(count)]

    def _enough(self, steps: list[Step], count: int, act: str) -> None:
        if self.writer is not None:
            raise BadInputError("an edit is open", f"in {act}", "end it first")
        try:
            wanted = operator.index(count)
        except TypeError:
            wanted = 0
        if not 1 <= wanted <= len(steps):
            raise BadInputError(
                f"{shown(count)} steps were asked and there are {len(steps)} to {act}",
                f"in {act}",
                f"give a number from 1 to {len(steps)}" if steps else f"there is nothing to {act}",
            )

    def _turn(self, take: list[Step], give: list[Step], *, forward: bool) -> Step:
        step = take.pop()
        if forward:
            step.journal.forth()
        else:
            step.journal.back()
        give.append(step)
        if step.structural:
            self.refresh()
        self._revise(step)
        return step

    def _revise(self, step: Step) -> None:
        """Raise the revision of everything whose geometry changed."""
        for numbers, revisions in (
            (step.rows, self.state.revision_row),
            (step.curves, self.state.revision_curve),
        ):
            for number in numbers.tolist():
                revisions[number] = revisions.get(number, 0) + 1

    def last_change(self, node: int) -> Step | None:
        """Give the last committed step that changed a node, None if none did."""
        for step in reversed(self.history):
            if np.isin(node, step.changed):
                return step
        return None
