"""The hull as it was after any step, beside the hull as it is.

Examples
--------
>>> from assoc_hull.edit.document import Document
>>> from assoc_hull.edit.session import Edit
>>> from assoc_hull.edit.explain.states import diff
>>> from assoc_hull.shipped.wigley import wigley
>>> document = Document(wigley())
>>> _ = document.label("as it came")
>>> with Edit(document, "fuller") as edit:
...     edit.move("WL 2.5 x ST 7", y=2.95)
>>> diff(document, "as it came", None).lines[0].line
'WL 2.5'
"""

from __future__ import annotations

import contextlib
from collections.abc import Iterator

from assoc_hull.edit.document import Document
from assoc_hull.edit.explain.compare import Comparison, compare
from assoc_hull.edit.step import Step
from assoc_hull.model.copy import copy_of
from assoc_hull.model.state import HullState

__all__ = ["PRESENT", "Walk", "diff", "state_at", "walking"]

PRESENT = "the present state"


class Walk:
    """Brings the tables of a hull from one state to another; the document learns nothing of it."""

    def __init__(self, document: Document) -> None:
        self.document = document
        self.way: list[Step] = list(document.history)

    def go(self, number: int) -> None:
        """Go to the state after the step with a number, 0 for the hull as it came."""
        target = self.document.path(number)
        there = {step.number for step in target}
        while self.way and self.way[-1].number not in there:
            self.way.pop().journal.back()
        for step in target[len(self.way) :]:
            step.journal.forth()
            self.way.append(step)


@contextlib.contextmanager
def walking(document: Document) -> Iterator[Walk]:
    """Walk through the history; at the end the tables are as they were, whatever happens.

    Raises
    ------
    BadInputError
        An edit is open.
    """
    document.require_ended("the history")
    document.begin(keep=False)
    walk = Walk(document)
    try:
        yield walk
    finally:
        walk.go(document.head)
        document.end(keep=False)


def state_at(document: Document, number: int) -> HullState:
    """Give a copy of the tables as they were after a step, 0 for the hull as it came."""
    with walking(document) as walk:
        walk.go(number)
        return copy_of(document.state)


def diff(document: Document, before: str, after: str | None = None) -> Comparison:
    """Compare two named states, or one with the present state if `after` is None.

    Raises
    ------
    UnknownNameError
        There is no such checkpoint or branch.
    """
    old = state_at(document, document.labelled(before))
    if after is None:
        return compare(old, document.state, (before, PRESENT))
    return compare(old, state_at(document, document.labelled(after)), (before, after))
