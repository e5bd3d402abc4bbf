"""The transaction: modifications are collected, then one update runs, is checked, published.

All modifications read the state before the transaction; two that write one point are an
error. Whatever goes wrong, the journal takes every write back, to the last bit.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from types import TracebackType
from typing import Self

import attrs
import numpy as np

from assoc_hull.edit.dirty_objects import dirty_nodes
from assoc_hull.edit.document import Document
from assoc_hull.edit.garbage_collection import PausedCollector
from assoc_hull.edit.modification import Extent, Pending
from assoc_hull.edit.outcome import joined_step
from assoc_hull.edit.recording import Said, Script, Settings, VariedValues
from assoc_hull.edit.step import EditReport, Led, Step
from assoc_hull.edit.update import update
from assoc_hull.edit.write_lock import PATIENCE
from assoc_hull.errors import BadInputError, RefusedEditError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.graph.derived import Marked
from assoc_hull.graph.journal import Journal
from assoc_hull.model.address import AddressBook
from assoc_hull.model.dirty_nodes import DirtyNodes
from assoc_hull.model.index import Index
from assoc_hull.model.make_objects import Maker
from assoc_hull.model.node import Node
from assoc_hull.model.tables import HullState, Particulars

__all__ = ["Transaction"]

_NO_NODES: IntArray = np.zeros(0, np.int64)

_IDLE = "nothing was changed: all that was asked for is so already; there is no step to undo"


@attrs.frozen(eq=False)
class _Stage:
    """A part of an edit that has been carried out: its writes, and the look-ups after it."""

    journal: Journal
    step: Step
    index: Index | None


class Transaction:
    """One edit of a hull, to be used in a ``with`` statement.

    Parameters
    ----------
    document : Document
        The hull.
    name : str
        Name of the edit, for the history.
    settings : Settings
        Policy and treatment of gaps.
    look : callable or None
        For a preview: called with the step, or None if nothing changed, when the update has
        run; then everything is taken back.
    author : str or None
        Who edits; None for who does at this hull.
    wait : float, s
        For how long another thread may be at work before this one is refused.
    """

    led: tuple[Led, ...] = ()
    """The lines that led."""

    followed: tuple[tuple[str, float], ...] = ()
    """Keys of the lines that followed, and how far, m."""

    def __init__(
        self,
        document: Document,
        name: str,
        settings: Settings | None = None,
        look: Callable[[Step | None], None] | None = None,
        *,
        author: str | None = None,
        wait: float = PATIENCE,
    ) -> None:
        self.document = document
        self.name = name
        self.settings = settings or Settings()
        self.look = look
        self.author = author
        self.wait = wait
        self.face: object = None  # the edit that a designer has of it
        self.journal = Journal()
        self.pending = Pending()
        self.script: list[dict[str, Said]] = []
        self._extents: list[Extent] = []
        self._dirty: tuple[tuple[int, int, int], DirtyNodes] | None = None
        self.varied = self.varied_before = VariedValues()
        self.variation: Mapping[str, object] | None = None  # as a script has it
        self._told: EditReport | None = None
        self._step: Step | None = None
        self._depth = 0
        self._broken = False
        self._over = False
        self._index: Index | None = None
        self._known: Marked = {}
        self._begun = self._taken_back = False
        self._stages: list[_Stage] = []
        self.notes: list[str] = []  # what is said of its stages together
        self._sized: Particulars | None = None  # as before lines were carried

    @property
    def report(self) -> EditReport | None:
        """What it did, made when it is first asked for; None before the update has run."""
        return self._told if self._step is None else self._step.report

    @property
    def active(self) -> bool:
        """Whether a ``with`` block is open."""
        return self._depth > 0 and not self._over

    @property
    def state(self) -> HullState:
        """The tables."""
        return self.document.state

    def note(self, change: dict[str, Said]) -> None:
        """Keep a modification that was asked for, as data."""
        self.script.append(change)
        self._extents.append(self.pending.extent())

    def dirty(self) -> DirtyNodes:
        """Give what has been reached by what was asked for so far."""
        at = len(self.script), len(self._stages), len(self.journal.entries)
        if self._dirty is None or self._dirty[0] != at or not self.script:
            bodies = [each.step.body for each in self._stages]
            done = np.unique(np.concatenate([_NO_NODES, *(each.changed for each in bodies)]))
            found = dirty_nodes(
                self.document, self.pending, self.script, self._extents, done, self.name
            )
            self._dirty = at, found
        return self._dirty[1]

    @property
    def maker(self) -> Maker:
        """Writes structure through this transaction's journal."""
        return Maker(self.state, self.journal)

    @property
    def changes(self) -> bool:
        """Whether what was asked so far changes anything."""
        return bool(self._stages) or not self._idle()

    def end_stage(self) -> None:
        """Carry out what is pending, so that what comes next finds the hull that comes of it.

        All stages are one step, refused as a whole. Who looks from elsewhere sees none of them.

        Raises
        ------
        RefusedEditError
            As at the end of the edit; the stage may be taken back with all before it.
        """
        with PausedCollector():
            if not self._idle():
                # The program knows the published hull, not what stages have made of it.
                step = update(self.document, self.name, self.journal, self.pending, self.settings,
                              by_program=False)  # fmt: skip
                self._stages.append(_Stage(self.journal, step, self.document.known_index))
                self.journal = Journal()
        self.pending = Pending(stopped=self.pending.stopped)

    def resized(self) -> None:
        """Let the report say what the particulars are at the end: lines are carried now."""
        self._sized = self._sized or self.state.particulars

    def _sizes(self) -> list[str]:
        """Say what the particulars are after all stages, if lines were carried."""
        if (before := self._sized) is None:
            return []
        size = self.state.particulars
        said = "stay as they are" if attrs.evolve(size, name=before.name) == before else "are now"
        return [
            f"the particulars {said}: length {size.length:g}, breadth {size.breadth:g}, "
            f"depth {size.depth:g}, draught {size.draught:g} m"
        ]

    @property
    def stages(self) -> int:
        """How many stages have ended."""
        return len(self._stages)

    @property
    def steps(self) -> tuple[Step, ...]:
        """What each stage that has ended did: the very objects, as long as it stands."""
        return tuple(each.step for each in self._stages)

    def lofted(self, first: int = 0) -> IntArray:
        """Give the curves that stages lofted or made, from one on, ascending, as far as alive."""
        bodies = [each.step.body for each in self._stages[first:]]
        nodes = np.concatenate([np.zeros(0, np.int64), *(body.changed for body in bodies)])
        curves = np.unique(Node.number(nodes[Node.is_curve(nodes)]))
        alive: IntArray = curves[self.state.curves.alive[curves]]
        return alive

    def take_back(self, keep: int = 0) -> None:
        """Take back all after the first `keep` stages, to try something else."""
        gone = self._stages[keep:]
        structural = self.pending.structural or any(each.step.structural for each in gone)
        self.journal.undo()
        for each in reversed(gone):
            each.journal.undo()
        if self.pending.numbers is not None:
            self.pending.numbers.take_back()
        # What is true of the hull as it is now is kept.
        self.state.memory.restore(self._known)
        if structural:
            self.document.known_index = self._stages[keep - 1].index if keep else self._index
        self.pending = Pending(stopped=self.pending.stopped)
        del self._stages[keep:]

    @contextmanager
    def whole(self) -> Iterator[Self]:
        """Take a modification whole, or leave no trace of it where it is refused half-way."""
        kept, index = len(self.journal.entries), self.document.known_index
        before = self.pending.copied()
        try:
            yield self
        except BaseException:
            self.journal.undo(keep=kept)
            self.pending, self.document.known_index = before, index
            raise

    def write(self, rows: IntArray, values: FloatArray, what: str | Callable[[], str]) -> None:
        """Set the places of points; they are written when the transaction ends.

        `what` is told, or tells, in errors.

        Raises
        ------
        BadInputError
            If a point is written twice, or a number is not finite.
        """
        if not np.isfinite(values).all():
            where = f"in {what if isinstance(what, str) else what()}"
            raise BadInputError("a coordinate is not finite", where, "give finite numbers")
        written = set(self.pending.values)
        for row in rows.tolist():
            if row in written:
                name = AddressBook(self.state).address(row)
                raise BadInputError(
                    "a point is written twice in one transaction",
                    f"{name}, in {what if isinstance(what, str) else what()}",
                    "leave one of the two out, or use two transactions",
                )
            written.add(row)
        self.pending.values |= zip(rows.tolist(), values, strict=True)

    def refuse_moved(self, rows: IntArray) -> None:
        """Refuse to change what points are, that this transaction has moved already.

        Raises
        ------
        BadInputError
            Naming the first such point.
        """
        moved = set(self.pending.values)
        for modification in self.pending.modifications.values():
            for set_by, place in modification.landing():
                moved |= set(set_by[(place != self.state.rows.xyz[set_by]).any(axis=1)].tolist())
        for row in rows.tolist():
            if row in moved:
                raise BadInputError(
                    "a point is moved and its line or role is changed in one transaction",
                    str(self.state.rows.key[row]),
                    "use two transactions",
                )

    def __enter__(self) -> Self:
        return self.enter(self.wait)

    def enter(self, wait: float) -> Self:
        """Open it, or join it where it is open; `wait` is as `WriteLock.take`."""
        before = self._depth
        try:
            if not before:
                self._begin(wait)
            else:
                self.document.lock.refuse_others(f"in the edit {self.name!r}")
            self._depth += 1
            return self
        except BaseException:
            # Broken off: there will be no exit.
            self._depth = before
            if not before:
                self._end()
            raise

    def _begin(self, wait: float) -> None:
        """Take the right to write."""
        where = f"in the edit {self.name!r}"
        if self._over:
            raise BadInputError("it has ended", where, "begin another one")
        keep, what = self.look is None, f"the edit {self.name!r}"
        self.document.begin(self, what, self.author, where=where, keep=keep, wait=wait)
        self._index, self._known = self.document.known_index, self.state.memory.mark()
        self._begun = True
        self.document.writer = self
        self.state.tell_dirty(self.dirty)

    def _end(self) -> None:
        """Give the right to write back, and bring memory to what is kept if that is ahead.

        What was being taken back when it was broken off is taken back first: else it would be
        published. An edit that is in the history stays.
        """
        left = self.journal.entries or self._stages or not self._taken_back
        if self._begun and left and not self._committed:
            self._restore()
        self._begun = False
        if self.document.writer is self:
            self.document.writer = None
        try:
            self.document.end(self, keep=self.look is None)
        finally:
            self.document.try_to_settle()

    @property
    def _committed(self) -> bool:
        """Whether its step is in the history."""
        step = self._step
        return step is not None and self.document.steps.get(step.number) is step

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        # The depth is counted down last: an interrupt at any line here must find it as it was.
        try:
            try:
                if error is not None:
                    self._broken = True
                    self._restore()
                elif self._depth == 1:
                    self._over, self.document.writer = True, None
                    with PausedCollector():
                        self._finish()
            finally:
                if self._depth == 1:
                    self._over, self.face = True, None  # else a ring would keep the hull open
                    self._end()
        finally:  # once more, should an interrupt come just there: it may be done twice
            if self._depth == 1:
                self._end()
            self._depth -= 1

    def _finish(self) -> None:
        """Run the update and publish it; whatever goes wrong before, the hull is as it was."""
        try:
            if self._broken:
                reason = "an edit nested in it failed, so all of it was taken back"
                raise RefusedEditError(self.name, (reason,))
            if self._idle() and not self._stages:
                self._tell_idle()
            else:
                self._publish()
        except BaseException:
            # Behind the commit nothing is taken back: the step is in the history, and kept.
            if not self._committed:
                self._restore()
                self._step = None
            raise
        if self.look is not None:
            try:
                self.look(self._step)
            finally:
                self._restore()

    def _tell_idle(self) -> None:
        """End without a step, and say that nothing was changed."""
        notes = (*self.notes, *self.pending.notes, _IDLE)
        self._told = EditReport(self.name, changed=False, notes=notes)
        self._restore()

    def _idle(self) -> bool:
        """Tell whether all that was asked for is so already: then there is nothing to undo."""
        pending, xyz = self.pending, self.state.rows.xyz.data
        if pending.curves or pending.computed or not pending.empty:
            return False
        asked = [
            xyz[row].tobytes() == (value + 0.0).tobytes() for row, value in pending.values.items()
        ]
        return all(asked) and self.journal.idle()

    def _publish(self) -> None:
        """Run the update, and take its step into the history unless it is only looked at."""
        answer, self.pending.answer = self.pending.answer, None
        if answer is not None:
            answer.carry_out()
            if self._idle() and not self._stages:
                self._tell_idle()
                return
        if self._stages:
            self.end_stage()
            self.notes += self._sizes()
            stages = [each.step for each in self._stages]
            step = joined_step(
                self.state, self.name, stages,
                notes=tuple(self.notes), led=self.led, followed=self.followed,
            )  # fmt: skip
        else:
            self.pending.notes += self._sizes()
            step = update(self.document, self.name, self.journal, self.pending, self.settings)
        self._refuse_lost_tunnels()
        step.script = Script.of(
            self.script, self.settings, self.varied, self.varied_before, self.variation
        )
        if self.look is None:
            if (known := self.pending.numbers) is not None:
                step.change = known.change()
            # Known before it is committed: behind that nothing is taken back.
            self._step = step
            self.document.commit(step, self.author)
            if known is not None:
                self.document.when_published = known.publish
        self._step = step

    def _refuse_lost_tunnels(self) -> None:
        """Refuse an edit after which a tunnel leaves the hull or meets another."""
        if not self.state.tunnels:
            return
        from assoc_hull.edit.checks.tunnel_findings import tunnel_findings

        if findings := tunnel_findings(self.state):
            raise RefusedEditError(self.name, findings)

    def _restore(self) -> None:
        """Take everything back; what was derived from the tables before is true again.

        Broken off at any line, it may be run again.
        """
        self.take_back()
        self.pending = Pending()  # who may stop it holds a drag, and that holds this edit
        self._taken_back = True
