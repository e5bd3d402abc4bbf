"""One committed edit: what undo and redo run, and what tells why things are as they are."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Protocol, TypeVar

import attrs

from assoc_hull.edit.recording import Script
from assoc_hull.edit.report import EditReport
from assoc_hull.errors import DamagedFileError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.graph.gate import Gate
from assoc_hull.graph.network import Readers, distinct
from assoc_hull.model.change import TableChange, apply_change
from assoc_hull.model.node import Node
from assoc_hull.model.tables import HullState

__all__ = ["Notes", "Past", "Rerun", "Step", "StepBody", "Writes"]

B = TypeVar("B")
T = TypeVar("T")

_GATE = Gate()
"""For steps that one thread lets go of while another one makes their body."""


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
            remedy = (
                "it is as it was; take it from another copy, or, if it is a copy, make it again "
                "while nobody edits, or by hull.save(other)"
            )
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


class Past(Protocol):
    """Finds again how the tables were."""

    def tell(
        self, number: int, before: Callable[[HullState], B], after: Callable[[HullState, B], T]
    ) -> T:
        """Tell of a step from the tables before it and after it."""


class Notes(Protocol):
    """What makes the body of a step."""

    @property
    def lasting(self) -> bool:
        """Whether it holds nothing of this process alone."""

    def body(self) -> StepBody:
        """Make it."""

    def packed(self, past: Past, step: Step, writes: Writes) -> Notes:
        """Give notes that hold nothing which `past` finds again; `writes` are those of the step."""


@attrs.frozen(eq=False)
class _ToldLater:
    """What the history needs of a step whose body has not been asked for, and what makes that."""

    writes: Writes
    rows: IntArray
    curves: IntArray
    notes: Notes


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
    change : TableChange or None
        What it changed, of a hull in memory.
    """

    name: str
    structural: bool
    number: int = 0
    parent: int = 0
    script: Script = attrs.field(factory=Script)
    fingerprint: str = ""
    load: Callable[[], StepBody] | None = None
    tell: Callable[[], EditReport] | None = None
    change: TableChange | None = None
    _body: StepBody | None = None
    _later: _ToldLater | None = None
    _entry: tuple[str, str] | None = attrs.field(default=None, init=False)

    @classmethod
    def told_later(
        cls, name: str, writes: Writes, rows: IntArray, curves: IntArray, notes: Notes
    ) -> Step:
        """Give a step that keeps the structure, of which the body is made when it is asked for.

        `rows` and `curves` are the points and curves that changed, ascending.
        """
        return cls(name, structural=False, later=_ToldLater(writes, rows, curves, notes))

    def __getstate__(self) -> dict[str, object]:
        # What looks at the net of this process tells the body now.
        if self._later is not None and not self._later.notes.lasting:
            self.replace(self.body)
        return {each.name: getattr(self, each.name) for each in attrs.fields(Step)}

    def __setstate__(self, state: dict[str, object]) -> None:
        for name, value in state.items():
            setattr(self, name, value)

    @property
    def body(self) -> StepBody:
        """The large part; made or loaded where it is not held."""
        body, later = self._body, self._later
        if body is None:
            if later is not None:
                body = self._entered(later.notes.body())
                _GATE.alone(partial(self._hold, body, later))
            else:
                assert self.load is not None, "a step holds its body, or can load it"
                body = self.load()
                self.replace(body)
        return body

    def _hold(self, body: StepBody, later: _ToldLater) -> None:
        """Hold a body, unless what made it has been let go of meanwhile."""
        if self._later is later:
            self._body, self._later = body, None

    def replace(self, body: StepBody) -> None:
        """Hold another body."""
        # What is known besides goes last: another thread may be asking.
        self._body, self._later = self._entered(body), None

    def release(self) -> None:
        """Let go of the body, if it can be loaded again."""
        if self.load is not None:
            self._body, self._later, self.change = None, None, None

    @property
    def notes(self) -> Notes | None:
        """What makes the body, where that has not been asked for."""
        return None if self._later is None else self._later.notes

    def let_go(self, writes: Writes, notes: Notes) -> None:
        """Hold writes that run as those it has, and what makes the body anew, and no more."""
        later = _ToldLater(writes, self.rows, self.curves, notes)
        _GATE.alone(partial(self._let_go, later))

    def _let_go(self, later: _ToldLater) -> None:
        # What is known besides goes last: another thread may be asking.
        self._later, self._body, self.change = later, None, None

    def enter(self, number: int, parent: int, author: str, time: str) -> None:
        """Note under which number it enters the history, and who made it when."""
        self.number, self.parent, self._entry = number, parent, (author, time)
        if self._body is not None:
            self._body = self._entered(self._body)

    def _entered(self, body: StepBody) -> StepBody:
        """Give a body whose report says what was noted."""
        if self._entry is None:
            return body
        author, time = self._entry
        report = attrs.evolve(body.report, number=self.number, author=author, time=time)
        return attrs.evolve(body, report=report)

    @property
    def author(self) -> str:
        """Who made the edit."""
        return self.report.author if self._entry is None else self._entry[0]

    @property
    def report(self) -> EditReport:
        """The report."""
        if self._body is None and self.tell is not None:
            return self.tell()
        return self.body.report

    @property
    def journal(self) -> Writes:
        """All writes."""
        later = self._later
        return self.body.journal if later is None else later.writes

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
        later = self._later
        if later is not None:
            return later.rows
        return distinct(Node.number(self.changed[Node.is_point(self.changed)]))

    @property
    def forms(self) -> IntArray:
        """Numbers of the definitions that the edit set."""
        return Node.form_number(distinct(self.seeds[Node.is_form(self.seeds)]))

    @property
    def curves(self) -> IntArray:
        """Curves that changed."""
        later = self._later
        if later is not None:
            return later.curves
        return distinct(Node.number(self.changed[Node.is_curve(self.changed)]))
