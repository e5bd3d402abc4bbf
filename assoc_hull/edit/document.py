"""A hull with its history: one writer, one transaction at a time, undo, redo, branches.

Undo and redo run what a step wrote backward and forward; they never compute anything. The
steps form a tree. The present state lies on one path through it: the steps up to it are
`history`, those beyond it that were taken back are `undone`. An edit made in the place of
undone steps begins another path, and the old one gets a name; nothing is ever thrown away.
"""

from __future__ import annotations

import contextlib
import operator
from collections.abc import Iterator
from datetime import UTC, datetime

import attrs
import numpy as np

from assoc_hull.arguments import integer, shown, shown_name, text
from assoc_hull.edit.step import Step
from assoc_hull.edit.step_storage import Keeper, Label
from assoc_hull.errors import BadInputError, NameTakenError, UnknownNameError
from assoc_hull.geometry.curves import IntArray, freeze
from assoc_hull.graph.network import distinct
from assoc_hull.model.index import Index, build_index
from assoc_hull.model.tables import HullState, copy_into, copy_state

__all__ = ["Changed", "Document"]

_HELD = 16
"""So many steps are held in full where a keeper has them all."""


@attrs.frozen(eq=False)
class Changed:
    """What has changed between two published states.

    Attributes
    ----------
    curves, rows, lines : (k,) int
        Numbers of curves, points and lines, ascending; those that have gone as well, as long as the
        tables hold their numbers.
    structural : bool
        Whether lines, points or roles came or went.
    """

    curves: IntArray
    rows: IntArray
    lines: IntArray
    structural: bool


@attrs.define(eq=False)
class Document:
    """A hull's tables, the look-ups derived from them, and the steps that made them.

    Attributes
    ----------
    state : HullState
        The published tables.
    history, undone : list of Step
        Committed steps, oldest first; steps taken back, the last one taken back last.
    steps : dict of int to Step
        All steps ever committed, by number.
    labels : dict of str to Label
        Names of states.
    keeper : Keeper or None
        Keeps what is committed; None for a hull that lives in memory only.
    author : str
        Who edits.
    start : str
        Fingerprint of the hull as it came; empty where it has not been taken.
    writer : object
        The transaction that is open; None if none is.
    known_index : Index or None
        The look-ups, if they have been derived: see `index`.
    """

    state: HullState
    history: list[Step] = attrs.field(factory=list)
    undone: list[Step] = attrs.field(factory=list)
    steps: dict[int, Step] = attrs.field(factory=dict)
    labels: dict[str, Label] = attrs.field(factory=dict)
    keeper: Keeper | None = None
    author: str = ""
    start: str = ""
    writer: object = attrs.field(default=None, init=False)
    known_index: Index | None = attrs.field(default=None, init=False)
    _states: list[tuple[Step, ...]] = attrs.field(factory=list, init=False)
    _free: list[bool] = attrs.field(factory=lambda: [True], init=False)

    @property
    def index(self) -> Index:
        """Look-ups derived from the tables, when they are first needed.

        So a hull whose links run in a ring can be opened, and be told what is wrong.
        """
        if self.known_index is None:
            self.known_index = build_index(self.state)
        return self.known_index

    def refresh(self) -> None:
        """Derive the look-ups anew, after the structure changed."""
        self.known_index = build_index(self.state)

    @property
    def state_number(self) -> int:
        """Number of the published state: it rises with commit, undo, redo, go and refresh."""
        return len(self._states)

    def since(self, number: int) -> Changed:
        """Tell what has changed since the state with a number.

        Raises
        ------
        BadInputError
            There was no such state.
        """
        first = integer(number, "the state", "in since", least=0, most=self.state_number)
        steps = [step for state in self._states[first:] for step in state]
        none = np.zeros(0, np.int64)
        curves = distinct(np.concatenate([none, *(step.curves for step in steps)]))
        rows = distinct(np.concatenate([none, *(step.rows for step in steps)]))
        curves = curves[curves < self.state.curves.count]  # those of steps taken back are no more
        rows = rows[rows < self.state.rows.count]
        lines = distinct(self.state.curves.line.data[curves])
        freeze(curves, rows, lines)
        return Changed(curves, rows, lines, any(step.structural for step in steps))

    @property
    def head(self) -> int:
        """Number of the step that led to the present state; 0 as the hull came."""
        return self.history[-1].number if self.history else 0

    @property
    def tip(self) -> int:
        """Number of the step that redoing all undone ones would lead to."""
        return self.undone[0].number if self.undone else self.head

    def begin(self, *, keep: bool = True) -> None:
        """Take the right to write the tables, and what keeps them unless nothing is to be kept.

        Raises
        ------
        BadInputError
            Another thread has it.
        """
        try:
            self._free.pop()  # atomic: one thread gets it
        except IndexError:
            what, remedy = "another thread is at work on this hull", "let one edit at a time"
            raise BadInputError(what, "in the hull", remedy) from None
        try:
            if keep and self.keeper is not None:
                self.keeper.begin()
        except BaseException:
            self._free.append(True)
            raise

    def end(self, *, keep: bool = True) -> None:
        """Give it back."""
        try:
            if keep and self.keeper is not None:
                self.keeper.end()
        finally:
            self._free.append(True)

    def commit(self, step: Step) -> None:
        """Take a finished step into the history; whatever fails, it is not in it."""
        step.number, step.parent = len(self.steps) + 1, self.head
        branch = self._branch(self.tip if self.undone else None)
        report = attrs.evolve(step.report, number=step.number, author=self.author, time=_now())
        step.replace(attrs.evolve(step.body, report=report))
        self._revise(step, 1)
        try:
            if self.keeper is not None:
                self.keeper.commit(step, branch)
        except BaseException:
            self._revise(step, -1)
            raise
        self._name(branch)
        self.undone.clear()
        self.history.append(step)
        self.steps[step.number] = step
        self._states.append((step,))
        self._agree()
        if len(self.history) > _HELD:
            self.history[-1 - _HELD].release()

    def undo(self, count: int = 1) -> list[Step]:
        """Take back the last steps.

        Raises
        ------
        BadInputError
            If there are not so many, or an edit is open.
        """
        self._enough(self.history, count, "undo")
        return self._run([(step, False) for step in self.history[-count:][::-1]], None)

    def redo(self, count: int = 1) -> list[Step]:
        """Make steps that were taken back again.

        Raises
        ------
        BadInputError
            If there are not so many, or an edit is open.
        """
        self._enough(self.undone, count, "redo")
        return self._run([(step, True) for step in self.undone[-count:][::-1]], None)

    def go(self, name: str) -> list[Step]:
        """Go to a named state; steps that lie off the way there are kept under a name.

        Returns
        -------
        list of Step
            The steps that were run, backward or forward, in order.

        Raises
        ------
        UnknownNameError, BadInputError
            No such name; an edit is open.
        """
        self.require_ended("go")
        return self.go_to(self.labelled(name))

    def labelled(self, name: object) -> int:
        """Give the number of the step that a name stands for.

        Raises
        ------
        UnknownNameError
            There is no such checkpoint or branch.
        """
        if not isinstance(name, str) or name not in self.labels:
            raise UnknownNameError("checkpoint or branch", shown_name(name), tuple(self.labels))
        return self.labels[name].step

    def go_to(self, number: int) -> list[Step]:
        """Go to the state after the step with a number, 0 for the hull as it came."""
        moves = self._moves(number)
        ahead = {step.number for step in self.undone}
        leaves = any(forward and step.number not in ahead for step, forward in moves)
        return self._run(moves, self._branch(self.tip if leaves else None), leaves) if moves else []

    def _moves(self, number: int) -> list[tuple[Step, bool]]:
        """Give the steps that lead to another state, backward and then forward."""
        target = self.path(number)
        here, there = ({step.number for step in way} for way in (self.history, target))
        back = [(step, False) for step in self.history[::-1] if step.number not in there]
        return back + [(step, True) for step in target if step.number not in here]

    def stand(self, head: int, tip: int) -> None:
        """Say that the tables are as after step `head`, on the way to step `tip`."""
        self.history[:] = self.path(head)
        self.undone[:] = self.path(tip)[len(self.history) :][::-1]

    def follow(self, head: int, tip: int) -> None:
        """Bring the tables to where somebody else has brought the hull, and keep nothing."""
        self.require_ended("refresh")
        moves = self._moves(head)
        for step, forward in moves:
            self._turn(step, forward)
        self.stand(head, tip)
        if moves:
            self._states.append(tuple(step for step, _ in moves))

    def keep_revisions(self, rows: dict[int, int], curves: dict[int, int]) -> None:
        """Raise revisions to those that are known elsewhere; none is lowered."""
        for mine, known in (
            (self.state.revision_row, rows), (self.state.revision_curve, curves),
        ):  # fmt: skip
            mine |= {number: max(mine.get(number, 0), each) for number, each in known.items()}

    def path(self, number: int) -> list[Step]:
        """Give the steps that lead to a step, oldest first, itself included."""
        found: list[Step] = []
        while number:
            found.append(self.steps[number])
            number = found[-1].parent
        return found[::-1]

    def label(self, name: str) -> Label:
        """Name the present state.

        Raises
        ------
        NameTakenError, BadInputError
            The name is in use; an edit is open; it is no name.
        """
        self.require_ended("checkpoint")
        if text(name, "the name", "in checkpoint") in self.labels:
            raise NameTakenError("checkpoint or branch", name)
        label = Label(name, self.head, author=self.author, time=_now())
        with self._writing():
            if self.keeper is not None:
                self.keeper.label(label)
            self.labels[name] = label
            self._agree()
        return label

    @contextlib.contextmanager
    def _writing(self) -> Iterator[None]:
        self.begin()
        try:
            yield
        finally:
            self.end()

    @contextlib.contextmanager
    def unharmed(self) -> Iterator[None]:
        """Bring tables and history back to what they were, if what is done meanwhile fails."""
        was = None if self.keeper is None else copy_state(self.state)  # in memory nothing fails
        before = list(self.history), list(self.undone)
        try:
            yield
        except BaseException:
            if was is not None:
                copy_into(self.state, was)
                self.refresh()
            self.history[:], self.undone[:] = before
            raise

    def _run(
        self, moves: list[tuple[Step, bool]], branch: Label | None, leaves: bool = False
    ) -> list[Step]:
        """Run steps backward or forward, and keep that; if it fails, all is as it was."""
        steps = [step for step, _ in moves]
        with self._writing():
            with self.unharmed():
                for step, forward in moves:
                    self._turn(step, forward)
                if leaves:
                    self.undone.clear()
                if self.keeper is not None:
                    self.keeper.move(self.head, self.tip, steps, branch)
            self._name(branch)
            self._states.append(tuple(steps))
            self._agree()
        return steps

    def _turn(self, step: Step, forward: bool) -> None:
        if forward:
            step.journal.forth()
            if self.undone and self.undone[-1] is step:
                self.undone.pop()
            self.history.append(step)
        else:
            step.journal.back()
            self.undone.append(self.history.pop())
        if step.structural:
            self.refresh()
        self._revise(step, 1)

    def _branch(self, tip: int | None) -> Label | None:
        """Give a name for steps that are left, unless they can be reached by one already."""
        if tip is None or any(label.step == tip for label in self.labels.values()):
            return None
        number = 1
        while f"branch {number}" in self.labels:
            number += 1
        return Label(f"branch {number}", tip, True, self.author, _now())

    def _agree(self) -> None:
        """Tell the keeper that memory holds what it keeps."""
        if self.keeper is not None:
            self.keeper.agree(len(self.steps))

    def _name(self, label: Label | None) -> None:
        if label is not None:
            self.labels[label.name] = label

    def require_ended(self, act: str) -> None:
        """Refuse while an edit is open.

        Raises
        ------
        BadInputError
            One is.
        """
        if self.writer is not None:
            raise BadInputError("an edit is open", f"in {act}", "end it first")

    def _enough(self, steps: list[Step], count: int, act: str) -> None:
        self.require_ended(act)
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

    def _revise(self, step: Step, by: int) -> None:
        """Raise the revision of everything whose geometry changed; lower it if it never did."""
        for numbers, revisions in (
            (step.rows, self.state.revision_row),
            (step.curves, self.state.revision_curve),
        ):
            for number in numbers.tolist():
                revisions[number] = revisions.get(number, 0) + by
                if not revisions[number]:
                    del revisions[number]


def _now() -> str:
    """Give the time for the record; nothing is computed from it."""
    return datetime.now(UTC).isoformat(timespec="seconds")
