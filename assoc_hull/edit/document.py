"""A hull with its history: one writer, one transaction at a time, undo, redo, branches.

Undo and redo run what a step wrote backward and forward; they never compute anything. The
steps form a tree. The present state lies on one path through it: the steps up to it are
`history`, those beyond it that were taken back are `undone`. An edit made in the place of
undone steps begins another path, and the old one gets a name; nothing is ever thrown away.

A keeper, which a hull file is, keeps the steps beyond the life of the process. It is asked before a
step counts as committed, so that what is told to be committed is kept. Where it fails the edit is
taken back; where an act is broken off behind that, memory follows what is kept: see `settle`.
"""

from __future__ import annotations

import contextlib
import itertools
import operator
from collections.abc import Callable, Iterator, Sequence
from contextvars import ContextVar
from datetime import UTC, datetime
from functools import partial
from itertools import repeat
from typing import Protocol

import attrs
import numpy as np

from assoc_hull.arguments import integer, shown, shown_name, text
from assoc_hull.edit.past_states import PastStates, pack_step, run_together, steps_together
from assoc_hull.edit.published_program import KeptProgram
from assoc_hull.edit.recording import VariedValues
from assoc_hull.edit.step import Step
from assoc_hull.edit.write_lock import PATIENCE, WriteLock
from assoc_hull.errors import AssocHullError, BadInputError, NameTakenError, UnknownNameError
from assoc_hull.geometry.curves import IntArray, freeze
from assoc_hull.graph.journal import Journal
from assoc_hull.graph.run_update import distinct
from assoc_hull.model.change import change_of
from assoc_hull.model.index import Index, build_index, index_columns
from assoc_hull.model.tables import HasState, HullState, copy_into

__all__ = ["SIGNED", "STOPPED", "Changed", "Document", "HasDocument", "Keeper", "Label",
           "end_if_stopped"]  # fmt: skip

SIGNED: ContextVar[str] = ContextVar("signed", default="")
"""In whose name this thread or task works on hulls; "" for the author of each hull."""

STOPPED: ContextVar[Callable[[], bool]] = ContextVar("stopped", default=bool)
"""Tells whether what this task does is not wanted any more: a variation ends then as by Ctrl+C."""


def end_if_stopped() -> None:
    """End what this task does, as Ctrl+C would, if it is not wanted any more (`STOPPED`)."""
    if STOPPED.get()():
        raise KeyboardInterrupt


_HELD = 16
"""So many steps are held in full where a keeper has them all."""

_HELD_IN_MEMORY = 32
"""So many are where nobody else has them: those behind take longer to run, and a fiftieth."""


@attrs.frozen
class Label:
    """A name for a state of the hull.

    Attributes
    ----------
    name : str
        The name.
    step : int
        Number of the step after which the hull is in this state; 0 as it came.
    branch : bool
        Whether it was given to undone steps when another edit was made in their place; else a
        checkpoint, that somebody asked for.
    author, time : str
        Who gave the name, and when: ISO 8601, UTC.
    """

    name: str
    step: int
    branch: bool = False
    author: str = attrs.field(default="", eq=False)
    time: str = attrs.field(default="", eq=False)


class Keeper(Protocol):
    """Keeps what is committed; every method raises, and keeps nothing of it, if it cannot."""

    def begin(self) -> None:
        """Take the right to write; nobody else has it until `end`."""

    def commit(self, step: Step, branch: Label | None) -> None:
        """Keep a step that was just made, and a name for the steps that it takes the place of."""

    def move(self, head: int, tip: int, steps: Sequence[Step], branch: Label | None) -> None:
        """Keep that the hull is now as after step `head`, where these steps were run."""

    def label(self, label: Label) -> None:
        """Keep a name."""

    def agree(self, steps: int) -> None:
        """Take note that what was kept last is in memory as well, where there are so many steps."""

    def end(self) -> None:
        """Give the right to write back; what was not kept by now is not kept."""

    def refresh(self, document: Document) -> None:
        """Bring a document to what is kept."""


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


@attrs.frozen(eq=False)
class _Reached:
    """A state that was published: the steps that were run to reach it, and the last one made."""

    steps: tuple[Step, ...]
    head: int


def _live_tables(state: HullState) -> HullState:
    """Give the tables that a published state is one of."""
    return state.live_tables


@attrs.define(eq=False, on_setattr=attrs.setters.NO_OP)
class Document:
    """A hull's tables, the look-ups derived from them, and the steps that made them.

    Attributes
    ----------
    state : HullState
        The tables, which whoever holds `lock` writes to; others read what is published of them.
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
    program : KeptProgram
        The program of its net, as far as it has been asked for.
    lock : WriteLock
        Who may write the tables.
    unsettled : bool
        Whether something was being kept when it was broken off: the keeper may be ahead of memory.
    varied_before : VariedValues
        What variations had given the hull that this one was copied from.
    when_published : callable or None
        What is still to be done with a step that was committed, as soon as it is published. It has
        kept the structure: look-ups of the state before are those of the one after it.
    """

    state: HullState = attrs.field(converter=_live_tables, on_setattr=attrs.setters.convert)
    history: list[Step] = attrs.field(factory=list)
    undone: list[Step] = attrs.field(factory=list)
    steps: dict[int, Step] = attrs.field(factory=dict)
    labels: dict[str, Label] = attrs.field(factory=dict)
    keeper: Keeper | None = None
    author: str = ""
    start: str = ""
    writer: object = attrs.field(default=None, init=False)
    known_index: Index | None = attrs.field(default=None, init=False)
    unsettled: bool = attrs.field(default=False, init=False)
    when_published: Callable[[], None] | None = attrs.field(default=None, init=False)
    varied_before: VariedValues = attrs.field(factory=VariedValues, init=False)
    _states: list[_Reached] = attrs.field(factory=list, init=False)
    _origin: int = attrs.field(default=0, init=False)
    _past: PastStates | None = attrs.field(default=None, init=False)
    program: KeptProgram = attrs.field(factory=KeptProgram, init=False)
    lock: WriteLock = attrs.field(factory=WriteLock, init=False)

    def __repr__(self) -> str:
        return f"<Document {self.state.particulars.name}, {len(self.history)} edits>"

    def __attrs_post_init__(self) -> None:
        self._origin = self.head
        self.state.number = 0  # edits of another document, that made the tables, are not told here

    def __getstate__(self) -> dict[str, object]:
        # In another process, or in a copy, the tables begin with state 0, which is this one.
        held = {each.name: getattr(self, each.name) for each in attrs.fields(Document)}
        return held | {"_states": [], "_origin": self.head}

    def __setstate__(self, state: dict[str, object]) -> None:
        for name, value in state.items():
            object.__setattr__(self, name, value)

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

    def index_of(self, state: HullState, known: Index | None = None) -> Index:
        """Give the look-ups of a published state; `known` may be those of just that one."""
        make = partial(build_index, state) if known is None else lambda: known
        return state.derived(("look-ups",), index_columns(state), make, most=2)

    @property
    def state_number(self) -> int:
        """Number of the published state: it rises with commit, undo, redo, go and refresh."""
        return self.state.published().number

    def since(self, number: int) -> Changed:
        """Tell what has changed since the state with a number.

        Raises
        ------
        BadInputError
            There was no such state.
        """
        state = self.state.published()
        first = integer(number, "the state", "in since", least=0, most=state.number)
        steps = [step for each in self._states[first : state.number] for step in each.steps]
        none = np.zeros(0, np.int64)
        curves = distinct(np.concatenate([none, *(step.curves for step in steps)]))
        rows = distinct(np.concatenate([none, *(step.rows for step in steps)]))
        curves = curves[curves < state.curves.count]  # those of steps taken back are no more
        rows = rows[rows < state.rows.count]
        lines = distinct(state.curves.line[curves])
        freeze(curves, rows, lines)
        return Changed(curves, rows, lines, any(step.structural for step in steps))

    @property
    def head(self) -> int:
        """Number of the step that led to the present state; 0 as the hull came."""
        return self.history[-1].number if self.history else 0

    def head_of(self, state: HullState) -> int:
        """Give the number of the step that led to a published state."""
        return self._states[state.number - 1].head if state.number else self._origin

    @property
    def tip(self) -> int:
        """Number of the step that redoing all undone ones would lead to."""
        return self.undone[0].number if self.undone else self.head

    def begin(
        self,
        holder: object,
        what: str,
        author: str | None = None,
        *,
        where: str,
        keep: bool = True,
        wait: float = PATIENCE,
    ) -> None:
        """Take the right to write the tables, and what keeps them unless nothing is to be kept.

        `what` and `author` are told to whoever comes meanwhile; `wait` is as `WriteLock.take`.

        Raises
        ------
        BadInputError
            This task has it already.
        HullBusyError
            Another thread or task has it.
        """
        author = self.signature if author is None else author
        try:
            self.lock.take(holder, what, author, where=where, wait=wait)
            self.state.begin_writing(self._written_here)
            if keep and self.keeper is not None:
                self.settle()
                self.keeper.begin()
                # What came back from there, or from another process, is what the edit reads.
                self.state.end_writing()
                self.state.begin_writing(self._written_here)
        except BaseException:
            self.end(holder, keep=keep)
            raise

    def end(self, holder: object, *, keep: bool = True) -> None:
        """Give it back, if this is who has it."""
        if not self.lock.held_by(holder):
            return
        try:
            if keep and self.keeper is not None:
                self.keeper.end()
        finally:
            self.state.end_writing()
            act, self.when_published = self.when_published, None
            if self.known_index is not None and act is None:
                self.index_of(self.state.published(), self.known_index)
            try:
                if act is not None:
                    act()
            finally:
                self.lock.give_back(holder)

    def _written_here(self) -> bool:
        return self.lock.held_here

    @contextlib.contextmanager
    def held(self, act: str, *, keep: bool = True, wait: float = PATIENCE) -> Iterator[None]:
        """Have the right to write for as long as a block runs; as `begin`."""
        holder = object()
        try:
            try:
                self.begin(holder, act, where=f"in {act}", keep=keep, wait=wait)
                yield
            finally:
                self.end(holder, keep=keep)
        finally:  # once more, should an interrupt come just there: it may be done twice
            self.end(holder, keep=keep)

    def settle(self) -> None:
        """Bring memory to what its keeper holds, where something was broken off while it was kept.

        An interrupt may come between the moment from which a step is kept and the one from which
        memory knows: the step counts, since nothing that is kept is ever lost.
        """
        if self.unsettled and self.keeper is not None:
            self.keeper.refresh(self)
            self.unsettled = False

    @property
    def signature(self) -> str:
        """Who signs what this task does: who it is done for (`SIGNED`), else the author."""
        return SIGNED.get() or self.author

    def commit(self, step: Step, author: str | None = None) -> None:
        """Take a finished step into the history; whatever fails, it is not in it."""
        author = self.signature if author is None else author
        branch = self._branch(self.tip if self.undone else None)
        if self.keeper is None and step.change is None:
            # The tables tell it now, and never again.
            journal = step.journal
            assert isinstance(journal, Journal), "a step that was just made holds its journal"
            step.change = change_of(self.state, journal)
        step.enter(len(self.steps) + 1, self.head, author, _now())
        revised, places = self._revisions(step), (len(self.history), len(self._states))
        undone = list(self.undone)
        try:
            self._revise(revised)
            if self.keeper is not None:
                self.unsettled = True
                self.keeper.commit(step, branch)
            self._name(branch)
            self.undone.clear()
            self.history.append(step)
            self.steps[step.number] = step
            self._note_state((step,))
            self._agree()
        except BaseException:
            # What the keeper holds of it by then comes back with `settle`.
            del self.history[places[0] :], self._states[places[1] :]
            self.state.number = len(self._states)
            self.undone[:] = undone
            self.steps.pop(step.number, None)
            if branch is not None:
                self.labels.pop(branch.name, None)
            _forget(revised)
            raise
        if self.keeper is not None:
            if len(self.history) > _HELD:
                self.history[-1 - _HELD].release()
        elif (old := self.steps.get(step.number - _HELD_IN_MEMORY)) is not None:
            # By number: steps that were undone and left grow old as well.
            if self._past is None:
                self._past = PastStates(self)
            pack_step(old, self._past)

    def forget_past(self) -> None:
        """Let go of what finds past states again: a keeper has all steps."""
        self._past = None

    def undo(self, count: int = 1, author: str | None = None) -> list[Step]:
        """Take back the last steps; of one author if one is named, and only if they are his.

        Raises
        ------
        BadInputError
            If there are not so many, or an edit is open; or steps of others lie above.
        HullBusyError
            Somebody else is at work.
        """
        self.require_ended("undo")
        with self._writing("undo"):
            if author is not None:
                self._require_own(count, author)
            self._enough(self.history, count, "undo")
            return self._run([(step, False) for step in self.history[-count:][::-1]], None)

    def _require_own(self, count: int, author: str) -> None:
        """Refuse to take back steps of one author from under those of others."""
        above = list[Step]()
        left = integer(count, "the number of steps", "in undo", least=1)
        for step in self.history[::-1]:
            if step.author != author:
                above.append(step)
            elif left := left - 1:
                continue
            else:
                break
        where = f"in undo of {author!r}"
        if left:
            have = count - left
            remedy = "see history for who made what"
            raise BadInputError(f"there are {have} steps of theirs to undo, and {count} were asked",
                                where, remedy)  # fmt: skip
        if above:
            names = ", ".join(f"{step.name!r} of {step.author!r}" for step in above[:5])
            rest = f" and {len(above) - 5} more" if len(above) > 5 else ""
            remedy = "undo those first, or make an edit that sets back what this one did"
            raise BadInputError(f"above it lie {names}{rest}", where, remedy)

    def redo(self, count: int = 1) -> list[Step]:
        """Make steps that were taken back again.

        Raises
        ------
        BadInputError
            If there are not so many, or an edit is open.
        HullBusyError
            Somebody else is at work.
        """
        self.require_ended("redo")
        with self._writing("redo"):
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
        with self._writing("go"):
            return self._go_to(self.labelled(name))

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
        with self._writing("go"):
            return self._go_to(number)

    def _go_to(self, number: int) -> list[Step]:
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
        if not self._states:
            self._origin = head
        self.undone[:] = self.path(tip)[len(self.history) :][::-1]

    def follow(self, head: int, tip: int) -> None:
        """Bring the tables to where somebody else has brought the hull, and keep nothing."""
        self.require_ended("refresh")
        moves = self._moves(head)
        for step, forward in moves:
            self._turn((step,), forward)
        self.stand(head, tip)
        if moves:
            self._note_state(tuple(step for step, _ in moves))

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
        text(name, "the name", "in checkpoint")
        with self._writing("checkpoint"):
            if name in self.labels:
                raise NameTakenError("checkpoint or branch", name)
            label = Label(name, self.head, author=self.signature, time=_now())
            if self.keeper is not None:
                self.unsettled = True
                self.keeper.label(label)
            self.labels[name] = label
            self._agree()
        return label

    @contextlib.contextmanager
    def _writing(self, act: str) -> Iterator[None]:
        try:
            with self.held(act):
                yield
        finally:
            self.try_to_settle()

    def try_to_settle(self) -> None:
        """Settle where that can be done now; else the next act that writes does, or says why not.

        For the way out of an act that failed: what it failed with is what is told.
        """
        if not self.unsettled:
            return
        with contextlib.suppress(AssocHullError), self.held("the hull", keep=False, wait=0.0):
            self.settle()

    @contextlib.contextmanager
    def unharmed(
        self, turned: Sequence[tuple[Step, bool]] = (), *, copy: bool = True
    ) -> Iterator[None]:
        """Bring tables and history back to what they were, if what is done meanwhile fails.

        `turned` are the steps that have been run by then, or half run; `copy` is for steps that
        cannot be run from the middle, as changes cannot: the tables as they were are kept.
        """
        was = self.state.as_written() if copy else None
        before = list(self.history), list(self.undone)
        try:
            yield
        except BaseException:
            if was is not None:
                copy_into(self.state, was)
            else:
                # Half run in whatever way, a journal can be run forward from its beginning.
                for step, forward in reversed(turned):
                    step.journal.forth()
                    if forward:
                        step.journal.back()
            self.refresh()
            self.history[:], self.undone[:] = before
            raise

    def _run(
        self, moves: list[tuple[Step, bool]], branch: Label | None, leaves: bool = False
    ) -> list[Step]:
        """Run steps backward or forward, and keep that; if it fails, all is as it was.

        Only with the right to write.
        """
        steps, turned = [step for step, _ in moves], list[tuple[Step, bool]]()
        whole = self.keeper is None and all(isinstance(step.journal, Journal) for step in steps)
        with self.unharmed(turned, copy=not whole):
            for forward, group in itertools.groupby(moves, operator.itemgetter(1)):
                for run in steps_together([step for step, _ in group]):
                    turned += [(step, forward) for step in run]
                    self._turn(run, forward)
            if leaves:
                self.undone.clear()
            if self.keeper is not None:
                self.unsettled = True
                self.keeper.move(self.head, self.tip, steps, branch)
        self._name(branch)
        self._note_state(tuple(steps))
        self._agree()
        return steps

    def _turn(self, steps: Sequence[Step], forward: bool) -> None:
        """Run steps that can be run as one."""
        run_together(steps, forward=forward)
        for step in steps:
            if not forward:
                self.undone.append(self.history.pop())
            else:
                if self.undone and self.undone[-1] is step:
                    self.undone.pop()
                self.history.append(step)
            if step.structural:
                self.refresh()
            self._revise(self._revisions(step))

    def _note_state(self, steps: tuple[Step, ...]) -> None:
        """Note that steps were run; what is published next has another number."""
        self._states.append(_Reached(steps, self.head))
        self.state.number = len(self._states)

    def _branch(self, tip: int | None) -> Label | None:
        """Give a name for steps that are left, unless they can be reached by one already."""
        if tip is None or any(label.step == tip for label in self.labels.values()):
            return None
        number = 1
        while f"branch {number}" in self.labels:
            number += 1
        return Label(f"branch {number}", tip, True, self.signature, _now())

    def _agree(self) -> None:
        """Tell the keeper that memory holds what it keeps."""
        if self.keeper is not None:
            self.keeper.agree(len(self.steps))
        self.unsettled = False

    def _name(self, label: Label | None) -> None:
        if label is not None:
            self.labels[label.name] = label

    def require_ended(self, act: str) -> None:
        """Refuse while an edit of this thread and task is open.

        Raises
        ------
        BadInputError
            One is.
        """
        if self.writer is not None and self.lock.held_here:
            raise BadInputError("an edit is open", f"in {act}", "end it first")

    def _enough(self, steps: list[Step], count: int, act: str) -> None:
        try:
            wanted = operator.index(count)
        except TypeError:
            wanted = 0
        if not 1 <= wanted <= len(steps):
            there = f"there {'is' if len(steps) == 1 else 'are'} {len(steps)} to {act}"
            # An array has no one truth: the number is asked, not what was given.
            asked = "1 step was" if wanted == 1 else f"{shown(count)} steps were"
            what = f"{asked} asked and {there}"
            remedy = (
                f"give a number from 1 to {len(steps)}" if steps else f"there is nothing to {act}"
            )
            if wanted < 1 and steps:
                what, remedy = f"{shown(count)} steps were asked", "give 1 or more"
            raise BadInputError(what, f"in {act}", remedy)

    def _revisions(self, step: Step) -> _Revisions:
        """Give the revisions of everything whose geometry a step changes, as they are."""
        found = list[tuple[dict[int, int], dict[int, int]]]()
        for changed, revisions in (
            (step.rows, self.state.revision_row), (step.curves, self.state.revision_curve),
        ):  # fmt: skip
            numbers = changed.tolist()
            was = zip(numbers, map(revisions.get, numbers, repeat(0)), strict=True)
            found.append((revisions, dict(was)))
        return found

    def _revise(self, revised: _Revisions) -> None:
        """Raise those revisions."""
        for revisions, was in revised:
            # At once: an interrupt finds all of them raised or none.
            revisions.update(dict(zip(was, map((1).__add__, was.values()), strict=True)))


_Revisions = list[tuple[dict[int, int], dict[int, int]]]


def _forget(revised: _Revisions) -> None:
    """Lower revisions to what they were; those that never were go."""
    for revisions, was in revised:
        for number, before in was.items():
            if before:
                revisions[number] = before
            else:
                revisions.pop(number, None)


def _now() -> str:
    """Give the time for the record; nothing is computed from it."""
    return datetime.now(UTC).isoformat(timespec="seconds")


class HasDocument(HasState, Protocol):
    """A hull, as far as a function asks of it: tables, and the history they belong to."""

    @property
    def document(self) -> Document:
        """Tables with their history."""
        ...
