"""The update: evaluate what an edit reaches, level by level, each node at most once.

A node is evaluated when something it reads has changed by a bit; a node whose new value has
the bits of the published one passes nothing on (*early cut-off*). Each change is pushed to
its readers together with its cause, so the report can say why a node moved.

Policies: `ALL_OR_NOTHING` lets the first failure out, for the transaction to take
everything back. `KEEP_GOING` leaves a node that cannot be evaluated at its last value as
*failed*, and does not evaluate what is made from it (*blocked*).
"""

from __future__ import annotations

from collections import defaultdict
from enum import Enum

import attrs
import numpy as np

from assoc_hull.errors import AssocHullError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.graph.journal import Journal
from assoc_hull.graph.network import Evaluation, Network, Readers, distinct

__all__ = ["FailurePolicy", "UpdatePass", "run_update"]

_NONE: IntArray = np.zeros(0, np.int64)


class FailurePolicy(Enum):
    """What becomes of the update when a node cannot be evaluated."""

    ALL_OR_NOTHING = "all_or_nothing"
    KEEP_GOING = "keep_going"


@attrs.frozen(eq=False)
class UpdatePass:
    """What one pass of the engine did.

    Attributes
    ----------
    evaluated : (k,) int
        Nodes in the order in which they were evaluated; none stands twice.
    changed : (k,) int
        Nodes whose value changed, the seeds included.
    moved : (k,) float
        By how much each of `changed` changed; nan for the seeds.
    cut_off : (k,) int
        Nodes that came out as they were.
    cause : Readers
        Every push: `reader` was evaluated because `source` had changed.
    failed : dict of int to str
        Nodes that could not be evaluated, with the reason.
    blocked : (k,) int
        Nodes not evaluated because something they are made from failed.
    """

    evaluated: IntArray
    changed: IntArray
    moved: FloatArray
    cut_off: IntArray
    cause: Readers
    failed: dict[int, str]
    blocked: IntArray


@attrs.define(eq=False)
class _Agenda:
    """Readers waiting to be evaluated, by level."""

    network: Network
    waiting: defaultdict[int, list[IntArray]] = attrs.field(factory=lambda: defaultdict(list))
    pushes: list[Readers] = attrs.field(factory=list)

    def push(self, nodes: IntArray) -> None:
        """Put all readers of `nodes` on the agenda."""
        pairs = self.network.readers(nodes)
        if not len(pairs.reader):
            return
        self.pushes.append(pairs)
        self.add(distinct(pairs.reader))

    def add(self, nodes: IntArray) -> None:
        """Put nodes on the agenda."""
        level = self.network.level(nodes)
        lowest, highest = int(level.min()), int(level.max())
        if lowest == highest:
            self.waiting[lowest].append(nodes)
            return
        for value in distinct(level).tolist():
            self.waiting[value].append(nodes[level == value])

    def pop(self) -> IntArray:
        """Take the lowest level off, each node once, in ascending order."""
        parts = self.waiting.pop(min(self.waiting))
        return parts[0] if len(parts) == 1 else distinct(np.concatenate(parts))


def run_update(
    network: Network,
    seeds: IntArray,
    journal: Journal,
    policy: FailurePolicy = FailurePolicy.ALL_OR_NOTHING,
    *,
    also: IntArray = _NONE,
    held: IntArray = _NONE,
) -> UpdatePass:
    """Bring everything made from the seeds up to date.

    Parameters
    ----------
    network : Network
        What to update.
    seeds : (k,) int
        Nodes whose values were set by the edit.
    journal : Journal
        Takes every write.
    policy : FailurePolicy
        What to do when a node cannot be evaluated.
    also : (k,) int
        Nodes to evaluate although nothing they read has changed (their recipe has).
    held : (k,) int
        Nodes that must not be evaluated although something they read changes.

    Returns
    -------
    UpdatePass

    Raises
    ------
    AssocHullError
        Under `ALL_OR_NOTHING`, whatever the evaluation raised.
    """
    agenda = _Agenda(network)
    agenda.push(seeds)
    if len(also):
        agenda.add(distinct(also))
    done: list[IntArray] = []
    results: list[Evaluation] = []
    failed: dict[int, str] = {}
    blocked: set[int] = set()
    while agenda.waiting:
        nodes = _without(agenda.pop(), held, blocked)
        if not len(nodes):
            continue
        result, broken = _evaluate(network, nodes, journal, policy)
        done.append(nodes)
        results.append(result)
        if broken:
            failed |= broken
            blocked |= _downstream(network, list(broken))
        agenda.push(result.changed)
    return _collect(seeds, done, results, agenda.pushes, failed, blocked)


def _without(nodes: IntArray, held: IntArray, blocked: set[int]) -> IntArray:
    if len(held):
        nodes = nodes[~np.isin(nodes, held)]
    if blocked:
        nodes = nodes[~np.isin(nodes, sorted(blocked))]
    return nodes


def _evaluate(
    network: Network, nodes: IntArray, journal: Journal, policy: FailurePolicy
) -> tuple[Evaluation, dict[int, str]]:
    """Evaluate a batch; when going on, find the nodes that fail by taking them singly."""
    if policy is FailurePolicy.ALL_OR_NOTHING:
        return network.evaluate(nodes, journal), {}
    mark = len(journal.entries)
    try:
        return network.evaluate(nodes, journal), {}
    except (AssocHullError, ArithmeticError) as error:
        journal.undo(keep=mark)
        if len(nodes) == 1:
            nothing = Evaluation(_NONE, np.zeros(0))
            return nothing, {int(nodes[0]): str(error)}
    parts: list[Evaluation] = []
    failed: dict[int, str] = {}
    for half in np.array_split(nodes, 2):
        part, broken = _evaluate(network, half, journal, policy)
        parts.append(part)
        failed |= broken
    changed = np.concatenate([part.changed for part in parts])
    return Evaluation(changed, np.concatenate([part.moved for part in parts])), failed


def _downstream(network: Network, nodes: list[int]) -> set[int]:
    """Give all that is made from `nodes`, at any distance."""
    found: set[int] = set()
    front = np.array(sorted(nodes), np.int64)
    while len(front):
        readers = set(network.readers(front).reader.tolist()) - found
        found |= readers
        front = np.array(sorted(readers), np.int64)
    return found


def _collect(
    seeds: IntArray,
    done: list[IntArray],
    results: list[Evaluation],
    pushes: list[Readers],
    failed: dict[int, str],
    blocked: set[int],
) -> UpdatePass:
    evaluated = np.concatenate([*done, _NONE])
    changed = np.concatenate([*(part.changed for part in results), _NONE])
    moved = np.concatenate([*(part.moved for part in results), np.zeros(0)])
    cause = Readers(
        np.concatenate([*(pair.reader for pair in pushes), _NONE]),
        np.concatenate([*(pair.source for pair in pushes), _NONE]),
    )
    quiet = _NONE
    if failed or len(changed) < len(evaluated):
        loud = np.concatenate([changed, np.array(sorted(failed), np.int64)])
        quiet = np.setdiff1d(evaluated, loud)
    return UpdatePass(
        evaluated,
        np.concatenate([seeds, changed]),
        np.concatenate([np.full(len(seeds), np.nan), moved]),
        quiet,
        cause,
        failed,
        np.array(sorted(blocked), np.int64),
    )
