"""One committed edit: what undo and redo run, and what tells why things are as they are."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

import attrs

from assoc_hull.edit.recording import Script
from assoc_hull.edit.report import EditReport
from assoc_hull.errors import DamagedFileError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.graph.network import Readers, distinct
from assoc_hull.model.change import TableChange, apply_change
from assoc_hull.model.node import Node
from assoc_hull.model.tables import HullState

__all__ = ["Rerun", "Step", "StepBody", "Writes"]


class Writes(Protocol):
    """All that an edit wrote, to be run backward and forward."""

    def back(self) -> None:
        """Take it back."""

    def forth(self) -> None:
        """Make it again."""


@attrs.frozen(eq=False)
class Rerun:
    """A change together with the tables that it runs over."""

    state: HullState
    change: TableChange

    def back(self) -> None:
        """Take it back."""
        self._run(forward=False)

    def forth(self) -> None:
        """Make it again."""
        self._run(forward=True)

    def _run(self, *, forward: bool) -> None:
        try:
            apply_change(self.state, self.change, forward=forward)
        except (ValueError, TypeError, LookupError, ArithmeticError, AttributeError) as error:
            what = f"the change of a step does not fit the hull ({type(error).__name__}: {error})"
            remedy = "take the hull from a copy; it is as it was"
            raise DamagedFileError(what, "in the history", remedy) from error


@attrs.frozen(eq=False)
class StepBody:
    """The large part of a step.

    Attributes
    ----------
    journal : Writes
        All writes.
    cause : Readers
        Which node was evaluated because of which.
    changed : (k,) int
        Nodes that changed.
    moved : (k,) float, m
        By how much; nan for what the edit itself set.
    seeds : (s,) int
        Nodes that the edit set.
    report : EditReport
        The report.
    """

    journal: Writes
    cause: Readers
    changed: IntArray
    moved: FloatArray
    seeds: IntArray
    report: EditReport


@attrs.define(eq=False)
class Step:
    """One committed edit.

    Attributes
    ----------
    name : str
        Name of the edit.
    structural : bool
        Whether lines, points or roles came or went.
    number, parent : int
        Number of the step, and of the one it was made upon; 0 is the hull as it came. A step
        keeps its number, whatever is undone.
    script : Script
        What was asked for, so that it can be asked for again.
    fingerprint : str
        That of the hull after the step; empty where it has not been taken.
    load : callable or None
        Gives the body; the step then need not hold it.
    tell : callable or None
        Gives the report alone, which is a small part of the body.
    """

    name: str
    structural: bool
    number: int = 0
    parent: int = 0
    script: Script = attrs.field(factory=Script)
    fingerprint: str = ""
    load: Callable[[], StepBody] | None = None
    tell: Callable[[], EditReport] | None = None
    _body: StepBody | None = None

    @property
    def body(self) -> StepBody:
        """The large part; loaded where it is not held."""
        if self._body is None:
            assert self.load is not None, "a step holds its body, or can load it"
            self._body = self.load()
        return self._body

    def replace(self, body: StepBody) -> None:
        """Hold another body."""
        self._body = body

    def release(self) -> None:
        """Let go of the body, if it can be loaded again."""
        if self.load is not None:
            self._body = None

    @property
    def report(self) -> EditReport:
        """The report."""
        if self._body is None and self.tell is not None:
            return self.tell()
        return self.body.report

    @property
    def journal(self) -> Writes:
        """All writes."""
        return self.body.journal

    @property
    def cause(self) -> Readers:
        """Which node was evaluated because of which."""
        return self.body.cause

    @property
    def changed(self) -> IntArray:
        """Nodes that changed."""
        return self.body.changed

    @property
    def moved(self) -> FloatArray:
        """By how much the nodes changed (m); nan for what the edit itself set."""
        return self.body.moved

    @property
    def seeds(self) -> IntArray:
        """Nodes that the edit set."""
        return self.body.seeds

    @property
    def rows(self) -> IntArray:
        """Points that changed."""
        return distinct(Node.number(self.changed[Node.is_point(self.changed)]))

    @property
    def forms(self) -> IntArray:
        """Numbers of the definitions that the edit set."""
        return Node.form_number(distinct(self.seeds[Node.is_form(self.seeds)]))

    @property
    def curves(self) -> IntArray:
        """Curves that changed."""
        return distinct(Node.number(self.changed[Node.is_curve(self.changed)]))
