"""What an edit asks for, and the update that carries it out, as those see it who take part.

Most modifications ask for places of points and recipes of curves, which `Pending` notes. What takes
more is a `Modification`: its kind says what is done at which stage of an update. A new kind is a
class, and a line in the table of `assoc_hull.edit.update`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from copy import copy
from typing import Protocol, TypeVar, cast

import attrs
import numpy as np

from assoc_hull.edit.checks.update_findings import WideGaps, ends_at_risk, note_new_ends
from assoc_hull.edit.crossings.adopted_points import link_adopted_points
from assoc_hull.edit.crossings.settle_crossings import (
    latent_intersections,
    rejoin_crossings,
    settle_crossings,
)
from assoc_hull.edit.document import Document
from assoc_hull.edit.recording import Settings
from assoc_hull.edit.space_map import CarriedFeatures
from assoc_hull.errors import RefusedEditError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.graph.journal import Journal
from assoc_hull.graph.run_update import UpdatePass, run_update
from assoc_hull.model.change import TableChange
from assoc_hull.model.kinds import State
from assoc_hull.model.make_objects import Maker
from assoc_hull.model.network import HullNetwork
from assoc_hull.model.node import Node
from assoc_hull.model.tables import HullState

__all__ = ["ROUNDS", "Extent", "LateAnswer", "Modification", "Pending", "TriedNumbers", "Work"]

_NONE: IntArray = np.zeros(0, np.int64)

ROUNDS = 6
"""Crossings that come make others come, seldom more than twice."""


class Modification:
    """What an edit asks for that takes more than places of points and recipes of curves.

    An update calls its methods in the order in which they stand here; each kind overrides those
    that it needs. One of a kind stands in an edit, however often it is asked for.
    """

    @classmethod
    def concerns(cls, state: HullState) -> bool:
        """Tell whether every edit of such a hull has one of this kind."""
        return False

    @property
    def idle(self) -> bool:
        """Whether nothing is asked of it."""
        return False

    @property
    def displaces(self) -> bool:
        """Whether it moves points that were not asked for one by one."""
        return False

    @property
    def strict(self) -> bool:
        """Whether nothing but its own points may move: no gap is mended, each is reported."""
        return False

    def landing(self) -> Iterable[tuple[IntArray, FloatArray]]:
        """Give points (k,) that it puts to given places, and these, (k, 3), m."""
        return ()

    @property
    def asked_for(self) -> int:
        """How many things it was asked for so far."""
        return 0

    def reached(self, state: HullState) -> Sequence[IntArray]:
        """Give the nodes (k,) that each of these things may set, in the order of asking."""
        return ()

    def plan(self, work: Work) -> None:
        """Write the structure that it needs; places that were asked for are not there yet."""

    def run(
        self, work: Work, rows: IntArray, origin: FloatArray
    ) -> tuple[IntArray, FloatArray] | None:
        """Carry out the main pass; None to leave that to the update.

        `rows` (k,) are points that were set, `origin` (n, 3), m, is where all lay before. Given
        are all points that were set, and how far they lie from there, m.
        """
        return None

    def arrange(self, work: Work) -> None:
        """Change what the main pass has shown to be needed, before crossings come and go."""

    def follow(self, work: Work) -> None:
        """Do what waits until they have come."""

    def refine(self, work: Work) -> None:
        """Do what waits until all has its shape."""

    def allow(self, work: Work, wide: WideGaps) -> bool:
        """Tell whether limits of gaps were set anew that could not be mended."""
        return False

    def check(self, work: Work) -> Iterable[str]:
        """Say what does not hold of what was asked for."""
        return ()

    def finish(self, work: Work) -> bool:
        """Do what is done to a sound hull; tell whether it has to be checked again."""
        return False


M = TypeVar("M", bound=Modification)


class TriedNumbers(Protocol):
    """Numbers of a program that an edit was carried out with."""

    def change(self) -> TableChange:
        """Give what the edit has changed."""

    def publish(self) -> None:
        """Keep them: they are those of the tables, which have just been published."""

    def take_back(self) -> None:
        """Put those of before back."""


class LateAnswer(Protocol):
    """What an edit asks for that waits until all else has been carried out."""

    @property
    def idle(self) -> bool:
        """Whether all that is asked for is so already."""

    def reached(self) -> Iterable[tuple[str, IntArray]]:
        """Give in words each thing that is asked for, and the nodes (k,) that it may set."""

    def goals(self) -> Mapping[int, FloatArray]:
        """Give the places, (3,), m, to which points are to come, by row."""

    def carry_out(self) -> None:
        """Carry it out, as stages of the edit."""


@attrs.frozen
class Extent:
    """How much was pending at some time: what came later is more than that.

    Attributes
    ----------
    values : int
        How many points had places.
    fields : dict of type to int
        By kind of modification, how many things were asked of it.
    curves, computed : frozenset of int
        Curves with another recipe, and crossings computed from another curve.
    """

    values: int = 0
    fields: dict[type[Modification], int] = attrs.field(factory=dict)
    curves: frozenset[int] = frozenset()
    computed: frozenset[int] = frozenset()


@attrs.define(eq=False)
class Pending:
    """What the modifications of a transaction ask for.

    Attributes
    ----------
    values : dict of int to (3,), m
        New places of points.
    curves : set of int
        Curves whose recipe changed.
    computed : set of int
        Crossings that have come to be computed from another curve than before, or from one.
    held : set of int
        Adopted points that a field moves: they do not ride in this update.
    structural : bool
        Whether lines, points, roles or associations came or went.
    moved_curves : set of int
        Curves that the designer edited: births take their value from these.
    born, gone : list of str
        Keys of curves and crossings that the modifications made or unmade.
    fresh : list of int
        Curves that were made in this transaction.
    notes : list of str
        What was left alone, and why.
    alone : bool
        Whether a modification is there that no other may stand beside.
    carried, cut_again : list of str
        Keys of the lines that a mapping carried, and of those that followed it.
    by_hand : set of (int, int)
        Points that were inserted, taken out or given another kind, each with the curve.
    features : CarriedFeatures or None
        The features as a mapping carried them; as they are in the tables if None.
    detached : list of int
        Curves that have left their definitions in this transaction.
    numbers : TriedNumbers or None
        The numbers of the tables when all has run, where a program has made them.
    modifications : dict of type to Modification
        What takes more than all that, by its kind.
    answer : LateAnswer or None
        What is carried out after all that.
    stopped : callable
        Tells whether somebody has asked to end the update; looked at before every pass.
    """

    values: dict[int, FloatArray] = attrs.field(factory=dict)
    curves: set[int] = attrs.field(factory=set)
    computed: set[int] = attrs.field(factory=set)
    held: set[int] = attrs.field(factory=set)
    structural: bool = False
    moved_curves: set[int] = attrs.field(factory=set)
    born: list[str] = attrs.field(factory=list)
    gone: list[str] = attrs.field(factory=list)
    fresh: list[int] = attrs.field(factory=list)
    notes: list[str] = attrs.field(factory=list)
    alone: bool = False
    carried: list[str] = attrs.field(factory=list)
    cut_again: list[str] = attrs.field(factory=list)
    by_hand: set[tuple[int, int]] = attrs.field(factory=set)
    features: CarriedFeatures | None = None
    detached: list[int] = attrs.field(factory=list)
    numbers: TriedNumbers | None = None
    modifications: dict[type[Modification], Modification] = attrs.field(factory=dict)
    answer: LateAnswer | None = None
    stopped: Callable[[], bool] = bool

    def ask(self, kind: type[M]) -> M:
        """Give the modification of a kind, to ask it for more."""
        found = self.asked(kind)
        if found is None:
            found = self.modifications[kind] = kind()
        return found

    def asked(self, kind: type[M]) -> M | None:
        """Give the modification of a kind; None if nothing of it is asked for."""
        # Each stands under its own kind.
        return cast("M | None", self.modifications.get(kind))

    def extent(self) -> Extent:
        """Tell how much is pending."""
        fields = {kind: each.asked_for for kind, each in self.modifications.items()}
        curves = frozenset(self.curves.union(self.fresh))
        return Extent(len(self.values), fields, curves, frozenset(self.computed))

    def copied(self) -> Pending:
        """Give a copy that has collections of its own; the modifications in it are the same."""
        found = copy(self)
        for each in attrs.fields(Pending):
            value = getattr(self, each.name)
            if isinstance(value, set | list | dict):
                setattr(found, each.name, copy(value))
        return found

    @property
    def empty(self) -> bool:
        """Whether no modification is there that takes more than places and recipes."""
        late = self.answer is None or self.answer.idle
        return late and all(each.idle for each in self.modifications.values())

    @property
    def displaces(self) -> bool:
        """Whether a modification moves points that were not asked for one by one."""
        return self.answer is not None or any(
            each.displaces for each in self.modifications.values()
        )

    @staticmethod
    def not_alone(name: str) -> tuple[str, str, str]:
        """Say that a transformation stands beside something else: what, where, remedy."""
        what = "a transformation and another modification in one edit"
        remedy = "use two edits: a transformation reads the whole hull and sets it anew"
        return what, f"in the edit {name!r}", remedy


# --------------------------------------------------------------------------------------
# The update under way.


@attrs.define(eq=False)
class Work:
    """One update while it runs.

    Attributes
    ----------
    document, name, journal, pending, settings : Document, str, Journal, Pending, Settings
        What is updated, and how.
    network : HullNetwork
        The hull as the engine sees it.
    forms : (k,) int
        Nodes of the definitions that the edit set; the first pass starts from them as well.
    passes : list of UpdatePass
        Those that have run.
    born, gone, mended : list of str
        Keys of crossings that came or went, and of curves that were given a point.
    ends : list of (int, int)
        Ends of lines that an alignment put at risk.
    seconds : dict of str to float
        Time per phase.
    failed : dict of int to str
        Nodes that could not be made, and why.
    wide : WideGaps or None
        Gaps over their limit, when they have been measured.
    planned : int
        Curves that could at most be lofted in the main pass.
    """

    document: Document
    name: str
    journal: Journal
    pending: Pending
    settings: Settings
    network: HullNetwork
    passes: list[UpdatePass] = attrs.field(factory=list)
    born: list[str] = attrs.field(factory=list)
    gone: list[str] = attrs.field(factory=list)
    mended: list[str] = attrs.field(factory=list)
    ends: list[tuple[int, int]] = attrs.field(factory=list)
    seconds: dict[str, float] = attrs.field(factory=dict)
    failed: dict[int, str] = attrs.field(factory=dict)
    wide: WideGaps | None = None
    planned: int = 0
    forms: IntArray = attrs.field(factory=lambda: _NONE)

    @property
    def state(self) -> HullState:
        """The tables."""
        return self.document.state

    def evaluated(self) -> IntArray:
        """Curves evaluated in any pass, in order, each once."""
        nodes = np.concatenate([_NONE, *(part.evaluated for part in self.passes)])
        curves = Node.number(nodes[Node.is_curve(nodes)])
        if len(self.passes) == 1:
            return curves  # in one pass no node stands twice
        once: IntArray = curves[np.sort(np.unique(curves, return_index=True)[1])]
        return once

    def changed_points(self) -> IntArray:
        """Points that changed in any pass; one may stand more than once."""
        changed = np.concatenate([_NONE, *(part.changed for part in self.passes)])
        return Node.number(changed[Node.is_point(changed)])

    def touched(self) -> IntArray:
        """Curves evaluated in any pass or made in this edit, but for those removed since."""
        fresh = np.array(self.pending.fresh, np.int64)
        curves = np.concatenate([self.evaluated(), fresh]) if len(fresh) else self.evaluated()
        alive: IntArray = curves[self.state.curves.alive[curves]]
        return alive

    def go(self, rows: IntArray, curves: IntArray) -> None:
        """Run one pass from points that were set and curves whose recipe changed."""
        if self.pending.stopped():
            raise RefusedEditError(self.name, ("it was stopped",))
        seeds = Node.point(rows)
        if not self.passes:
            seeds = np.concatenate([seeds, self.forms])
            self.planned = self.network.reached(np.concatenate([seeds, Node.curve(curves)]))
        carried = np.array(sorted(self.pending.held), np.int64)
        held = Node.point(carried)
        blocked = _blocked_nodes(self.network, self.state.failed)
        # What was blocked until now may be so no more, where this edit has made it of other things.
        freed = np.union1d(blocked, _marked_nodes(self.state))
        result = run_update(
            self.network, seeds, self.journal, self.settings.policy,
            also=self._also(curves), held=np.concatenate([held, blocked]),
        )  # fmt: skip
        self.passes.append(result)
        self.failed |= result.failed
        self._refuse_unmade(result)
        _note_states(self.network, result, self.journal)
        if len(freed):
            freed = np.setdiff1d(freed, _blocked_nodes(self.network, self.state.failed))
        if len(freed):
            self.passes.append(
                run_update(
                    self.network, _NONE, self.journal, self.settings.policy, also=freed, held=held
                )
            )

    def _refuse_unmade(self, result: UpdatePass) -> None:
        """Points that no definition can give refuse the edit: they have no last good place.

        What the tables held would be neither what the definitions say nor what was drawn.
        """
        for node, why in result.failed.items():
            if not Node.is_curve(node):
                raise RefusedEditError(self.name, (why,))

    def _also(self, curves: IntArray) -> IntArray:
        """Give the nodes to evaluate although nothing they read has changed; each only once."""
        rows, table = np.array(sorted(self.pending.computed), np.int64), self.state.rows
        self.pending.computed.clear()
        rows = rows[table.alive[rows] & (table.driver[rows] >= 0)]
        return np.concatenate([Node.curve(curves), Node.point(rows)])

    def settle(self) -> None:
        """Let crossings come and go until every meeting has its place."""
        for _ in range(ROUNDS):
            alignments, self.network.realigned = self.network.realigned, []
            maker = Maker(self.state, self.journal)
            rejoin_crossings(maker, alignments)
            latent = latent_intersections(self.state, self.touched())
            if not alignments and not latent:
                return
            self.ends += ends_at_risk(self.state, alignments)
            change = settle_crossings(maker, alignments, latent, self.pending.moved_curves)
            self.pending.notes += note_new_ends(self.state, alignments)
            self.born += change.born
            self.gone += change.gone
            curves = np.array(change.curves, np.int64)
            if change.born or change.gone:
                link_adopted_points(self.state, curves, self.journal)
                self.renew()
            if not len(curves):
                return
            self.go(_NONE, curves)

    def link_riders(self) -> None:
        """Link adopted points of changed curves to their neighbours, which may be others now."""
        pending, alive = self.pending, self.state.curves.alive
        curves = np.array(sorted(pending.curves | set(pending.fresh)), np.int64)
        link_adopted_points(self.state, curves[alive[curves]], self.journal)

    def renew(self) -> None:
        """Derive the look-ups anew after crossings or points came or went."""
        self.pending.structural = True
        self.document.refresh()
        self.network.index = self.document.index


# --------------------------------------------------------------------------------------
# Failed and blocked objects, when an edit was told to go on past a curve that fails. A failed curve
# keeps its last good shape; what is made from it is blocked, over later edits too, until the curve
# can be lofted again.


def _blocked_nodes(network: HullNetwork, failed: tuple[int, ...]) -> IntArray:
    """Give all nodes made from failed curves, at any distance, ascending."""
    found = np.zeros(0, np.int64)
    front = Node.curve(np.array(failed, np.int64))
    while len(front):
        front = np.setdiff1d(network.readers(front).reader, found)
        found = np.union1d(found, front)
    return found


def _marked_nodes(state: HullState) -> IntArray:
    """Give all nodes that the tables call blocked, ascending; there are none where none failed."""
    if not state.failed:
        return _NONE
    curves, rows = (
        np.flatnonzero((table.state.data == State.BLOCKED) & table.alive.data)
        for table in (state.curves, state.rows)
    )
    return np.sort(np.concatenate([Node.curve(curves), Node.point(rows)]))


def _note_states(network: HullNetwork, result: UpdatePass, journal: Journal) -> None:
    """Write which curves have failed, which are well again, and what is blocked now."""
    state = network.state
    broken = {Node.number(node) for node in result.failed if Node.is_curve(node)}
    curves = result.evaluated[Node.is_curve(result.evaluated)]
    mended = set(Node.number(curves).tolist()) - broken
    # A curve that was removed with its line has failed no more.
    there = [curve for curve in set(state.failed) | broken if state.curves.alive[curve]]
    failed = tuple(sorted(set(there) - mended))
    # An edit of the structure also blocks what it makes of blocked things, and frees what it
    # makes of others.
    before, after = _marked_nodes(state), _blocked_nodes(network, failed)
    if failed == state.failed and np.array_equal(before, after):
        return
    journal.set(state.settings.failed, [0], [failed])
    journal.put(state.curves.state, sorted(mended), int(State.CLEAN))
    for nodes, value in ((np.setdiff1d(before, after), State.CLEAN), (after, State.BLOCKED)):
        odd = Node.is_curve(nodes)
        journal.put(state.curves.state, Node.number(nodes[odd]), int(value))
        journal.put(state.rows.state, Node.number(nodes[~odd]), int(value))
    journal.put(state.curves.state, sorted(broken), int(State.FAILED))
