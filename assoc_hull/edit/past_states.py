"""What steps of a hull in memory hold once they are old, and the states of the hull between them.

The last steps hold what they wrote as it was written. An older one holds its change packed, which
is a fiftieth of that, and what it is told from. What it looked at is found again where somebody
asks: tables of their own are brought to the state before the step and after it, and stay there for
whoever asks next. So a session of thousands of edits grows by a few kilobytes with each.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from typing import Protocol, TypeVar

import attrs
import numpy as np

from assoc_hull.edit.checks.update_findings import plane_normals
from assoc_hull.edit.step import (
    EditReport,
    Fairness,
    Inflections,
    Notes,
    Past,
    Rerun,
    Step,
    StepBody,
    Writes,
)
from assoc_hull.geometry.curves import SplineBatch
from assoc_hull.graph.derived import Gate
from assoc_hull.graph.journal import Journal
from assoc_hull.graph.run_update import Readers
from assoc_hull.model.change import TableChange, apply_change
from assoc_hull.model.packed_change import (
    PackedArrays,
    PackedChange,
    joined_shapes,
)
from assoc_hull.model.tables import HullState

__all__ = [
    "HasPast",
    "LateFairness",
    "PackedWrites",
    "PastStates",
    "late_report",
    "pack_step",
    "run_together",
    "steps_together",
]

B = TypeVar("B")
T = TypeVar("T")


class HasPast(Protocol):
    """A hull with its history."""

    steps: dict[int, Step]

    @property
    def state(self) -> HullState:
        """The tables."""

    def head_of(self, state: HullState) -> int:
        """Give the number of the step that led to a published state."""


@attrs.frozen(eq=False)
class PackedWrites:
    """All that an edit wrote, packed, together with the tables that it runs over.

    It runs from where the tables are: broken off in the middle it can be run neither way.
    """

    state: HullState
    packed: PackedChange

    @property
    def change(self) -> TableChange:
        """What it changes."""
        return self.packed.unpack()

    def back(self) -> None:
        """Take it back."""
        Rerun(self.state, self.change).back()

    def forth(self) -> None:
        """Make it again."""
        Rerun(self.state, self.change).forth()


def run_together(steps: Sequence[Step], *, forward: bool) -> None:
    """Run steps that `steps_together` gave in one."""
    writes = steps[0].journal
    if len(steps) > 1 and isinstance(writes, PackedWrites):
        every = (step.journal for step in steps)
        changes = (each.change for each in every if isinstance(each, PackedWrites))
        writes = Rerun(writes.state, joined_shapes(writes.state, changes))
    if forward:
        writes.forth()
    else:
        writes.back()


_MOST = 256
"""So many steps are run as one at most."""


def steps_together(steps: Sequence[Step]) -> Iterator[Sequence[Step]]:
    """Divide steps, in the order in which they are to be run, into those that can be run as one."""
    group = list[Step]()
    for step in steps:
        what = step.journal
        apart = not (isinstance(what, PackedWrites) and what.packed.of_shape)
        if group and (apart or len(group) == _MOST):
            yield group
            group = []
        group.append(step)
        if apart:
            yield group
            group = []
    if group:
        yield group


class PastStates:
    """The states of a hull, one at a time, in tables of their own; any thread may ask."""

    def __init__(self, document: HasPast) -> None:
        self.document = document
        self._forget()

    def __getstate__(self) -> HasPast:
        return self.document

    def __setstate__(self, document: HasPast) -> None:
        self.document = document
        self._forget()

    def _forget(self) -> None:
        self._gate = Gate()
        self._at: tuple[HullState, int] | None = None

    def tell(
        self, number: int, before: Callable[[HullState], B], after: Callable[[HullState, B], T]
    ) -> T:
        """Tell of a step from the tables before it and after it, which stay so no longer."""
        return self._gate.alone(partial(self._tell, number, before, after))

    def at(self, number: int) -> HullState:
        """Give tables of their own as they were after a step, 0 for the hull as it came."""
        state, here = self._begin()
        self._walk(state, here, number)
        return state

    def _tell(
        self, number: int, before: Callable[[HullState], B], after: Callable[[HullState, B], T]
    ) -> T:
        # Broken off on the way, the tables are nowhere: the next one begins anew.
        at, self._at = self._at, None
        state, here = self._begin() if at is None else at
        self._walk(state, here, self.document.steps[number].parent)
        was = before(state)
        self._walk(state, self.document.steps[number].parent, number)
        found = after(state, was)
        self._at = state, number
        return found

    def _begin(self) -> tuple[HullState, int]:
        """Give tables of their own with what is published, and after which step that is."""
        published = self.document.state.published()
        return published.snapshot(), self.document.head_of(published)

    def _walk(self, state: HullState, here: int, there: int) -> None:
        """Bring tables from the state after one step to that after another."""
        steps, back, forth = self.document.steps, list[Step](), list[Step]()
        while here != there:  # a step has a higher number than the one before it
            if here > there:
                back.append(steps[here])
                here = back[-1].parent
            else:
                forth.append(steps[there])
                there = forth[-1].parent
        self._run(state, back, forward=False)
        self._run(state, forth[::-1], forward=True)

    def _run(self, state: HullState, steps: Sequence[Step], *, forward: bool) -> None:
        for group in steps_together(steps):
            changes = map(self._change, group)
            change = joined_shapes(state, changes) if len(group) > 1 else next(changes)
            apply_change(state, change, forward=forward)

    def _change(self, step: Step) -> TableChange:
        journal, change = step.journal, step.change
        if change is not None:
            return change
        assert isinstance(journal, Rerun | PackedWrites), "a step of a hull in memory has a change"
        return journal.change


@attrs.frozen(eq=False)
class LateFairness:
    """Counts the inflections of an old step when asked."""

    past: Past
    number: int
    keys: tuple[str, ...]

    def added(self) -> Inflections:
        """Give the curves with more curvature sign changes than before, and how many."""
        return self.past.tell(self.number, _all_splines, self._counted)

    def _counted(self, state: HullState, before: Mapping[int, SplineBatch]) -> Inflections:
        known = {state.curves.key[curve]: curve for curve in state.live("curves").tolist()}
        keys = tuple(key for key in self.keys if key in known)
        curves = np.array([known[key] for key in keys], np.int64)
        after = {curve: state.spline(curve) for curve in curves.tolist()}
        return Fairness(dict(before), after, plane_normals(state, curves), curves, keys).added()


def _all_splines(state: HullState) -> dict[int, SplineBatch]:
    found = ((curve, state.curves.spline[curve]) for curve in state.live("curves").tolist())
    return {curve: spline for curve, spline in found if spline is not None}


def late_report(report: EditReport, past: Past, number: int) -> EditReport:
    """Give a report that holds no splines."""
    told = report.fairness
    if not isinstance(told, Fairness):
        return report
    # A line that was cut anew has none before, whatever the tables had in its place then.
    pairs = zip(told.curves.tolist(), told.keys, strict=True)
    keys = tuple(key for curve, key in pairs if curve in told.before)
    return attrs.evolve(report, fairness=LateFairness(past, number, keys))


@attrs.frozen(eq=False)
class _PackedBody:
    """The large part of a step, packed."""

    report: EditReport
    arrays: PackedArrays
    writes: Writes

    lasting = True

    def body(self) -> StepBody:
        """Unpack it."""
        reader, source, changed, moved, seeds = self.arrays.unpack()
        causes = Readers(reader, source)  # type: ignore[arg-type]  # as they were packed
        return StepBody(self.writes, causes, changed, moved, seeds, self.report)  # type: ignore[arg-type]

    def packed(self, past: Past, step: Step, writes: Writes) -> Notes:
        """Give them as they are."""
        return self


def pack_step(step: Step, past: PastStates) -> None:
    """Let a step hold no more than is needed to run it and to find the rest again."""
    if step.load is not None:  # of a hull that was kept once: it is read from there
        step.release()
        return
    state, journal = past.document.state, step.journal
    if not isinstance(journal, Journal):  # it is packed already
        return
    assert step.change is not None, "a step of a hull in memory has a change"
    writes = PackedWrites(state, PackedChange.of(step.change))
    notes = _packed_body(step, past, writes) if step.notes is None else step.notes
    step.let_go(writes, notes.packed(past, step, writes))


def _packed_body(step: Step, past: PastStates, writes: Writes) -> _PackedBody:
    body = step.body
    cause, report = body.cause, late_report(body.report, past, step.number)
    arrays = PackedArrays.of([cause.reader, cause.source, body.changed, body.moved, body.seeds])
    return _PackedBody(report, arrays, writes)
