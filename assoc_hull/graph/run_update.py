"""The update: what an edit reaches, level by level, each node at most once, and what caused it.

A node is evaluated when something it reads has changed by a bit; a node whose new value has
the bits of the published one passes nothing on (*early cut-off*). Each change is pushed to
its readers together with its cause, so the report can say why a node moved.

Policies: `ALL_OR_NOTHING` lets the first failure out, for the transaction to take
everything back. `KEEP_GOING` leaves a node that cannot be evaluated at its last value as
*failed*, and does not evaluate what is made from it (*blocked*).

What the update engine knows of the thing it updates: numbered nodes that read one another.

A *node* is an integer. A node is evaluated from the nodes it reads; each has a level, above
that of all it reads. The engine decides which nodes are evaluated, when, and why; the
network holds the values and does the arithmetic, many nodes at a time.

Levels of a directed graph by longest path, and the ring that forbids them.

Why a node changed: from the pushes of an update back to what set it off.

Examples
--------
>>> from assoc_hull.graph.run_update import levels
>>> levels(4, [0, 1, 0], [1, 2, 2], str).tolist()
[0, 1, 2, 0]
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterator
from enum import Enum
from typing import Protocol

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.errors import AssocHullError, RingError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.graph.journal import Journal, distinct

__all__ = [
    "CauseTracer",
    "CauseTree",
    "Evaluation",
    "FailurePolicy",
    "Network",
    "Readers",
    "UpdatePass",
    "cause_chain",
    "closure",
    "distinct",
    "find_ring",
    "levels",
    "run_update",
    "spread",
]


@attrs.frozen(eq=False)
class Evaluation:
    """What came of evaluating a batch of nodes.

    Attributes
    ----------
    changed : (k,) int
        The nodes whose value now differs from the published one by a bit.
    moved : (k,) float
        By how much, in the unit of the network (m for a hull).
    """

    changed: IntArray
    moved: FloatArray


@attrs.frozen(eq=False)
class Readers:
    """Pairs of a node and one that reads it.

    Attributes
    ----------
    reader, source : (k,) int
        `reader[i]` is made from `source[i]`.
    """

    reader: IntArray
    source: IntArray

    @classmethod
    def none(cls) -> Readers:
        """Give no pairs at all."""
        return cls(np.zeros(0, np.int64), np.zeros(0, np.int64))


class Network(Protocol):
    """The thing that is updated."""

    def level(self, nodes: IntArray) -> IntArray:
        """Give the level of each node, (k,) int; a reader's is above its sources'."""

    def readers(self, nodes: IntArray) -> Readers:
        """Give all pairs whose source is among `nodes`."""

    def evaluate(self, nodes: IntArray, journal: Journal) -> Evaluation:
        """Make the values of nodes of one level anew, from what they read.

        Writes go through the journal. A node's value must not depend on what else is in
        the batch. An `AssocHullError` or `ArithmeticError` says that a node of the batch
        cannot be evaluated.
        """

    def name(self, node: int) -> str:
        """Name a node for a message."""


def closure(network: Network, seeds: IntArray) -> IntArray:
    """Give all nodes that are made from the seeds (k,), at any distance, and the seeds; ascending.

    This is an upper bound: no run from these seeds evaluates any other node in its main pass.
    """
    found = front = distinct(seeds)
    while len(front):
        reached = distinct(network.readers(front).reader)
        place = found.searchsorted(reached)
        front = reached[found.take(place, mode="clip") != reached]
        found = distinct(np.concatenate([found, front]))
    return found


def spread(network: Network, seeds: IntArray) -> Readers:
    """Give the closure of seeds (k,), each node with the one through which it is reached first.

    A seed is reached through itself. Nodes come in the order of their distance, then ascending; of
    several that reach a node at one distance the least is given.
    """
    found = front = distinct(seeds)
    pairs = [Readers(front, front)]
    while len(front):
        links = network.readers(front)
        order = np.lexsort((links.source, links.reader))
        reader, source = links.reader[order], links.source[order]
        fresh = ~np.isin(reader, found)
        fresh[1:] &= reader[1:] != reader[:-1]
        front = reader[fresh]
        pairs.append(Readers(front, source[fresh]))
        found = distinct(np.concatenate([found, front]))
    return Readers(
        np.concatenate([each.reader for each in pairs]),
        np.concatenate([each.source for each in pairs]),
    )


def levels(
    count: int, source: ArrayLike, reader: ArrayLike, name: Callable[[int], str]
) -> IntArray:
    """Give each node the length of the longest path that leads to it.

    Parameters
    ----------
    count : int
        Number of nodes.
    source, reader : (e,) int
        The edges: `reader[i]` is made from `source[i]`.
    name : callable
        Names a node, for the error.

    Returns
    -------
    (count,) int
        0 for a node that reads nothing. Kahn's algorithm, one level a round.

    Raises
    ------
    RingError
        With the path of a ring, beginning at its lowest node.
    """
    edges = np.unique(np.column_stack([source, reader]).astype(np.int64).reshape(-1, 2), axis=0)
    tails, heads = edges[:, 0], edges[:, 1]
    level = np.zeros(count, np.int64)
    waiting = np.bincount(heads, minlength=count)
    ready = np.flatnonzero(waiting == 0)
    first = np.searchsorted(tails, np.arange(count + 1))
    done = 0
    while len(ready):
        done += len(ready)
        spans = [np.arange(first[node], first[node + 1]) for node in ready]
        out = np.concatenate(spans) if spans else np.zeros(0, np.int64)
        np.maximum.at(level, heads[out], level[tails[out]] + 1)
        freed, times = np.unique(heads[out], return_counts=True)
        waiting[freed] -= times
        ready = freed[waiting[freed] == 0]
    if done < count:
        stuck = waiting > 0
        raise RingError(tuple(name(node) for node in find_ring(tails, heads, stuck)))
    return level


def find_ring(tails: IntArray, heads: IntArray, stuck: np.typing.NDArray[np.bool_]) -> list[int]:
    """Walk backward among the stuck nodes, lowest first, until one comes again."""
    inside = stuck[tails] & stuck[heads]
    before: dict[int, int] = {}
    for tail, head in zip(tails[inside].tolist(), heads[inside].tolist(), strict=True):
        before[head] = min(tail, before.get(head, tail))
    node = min(before)
    walk: list[int] = []
    while node not in walk:
        walk.append(node)
        node = before[node]
    ring = walk[walk.index(node) :][::-1]
    turn = ring.index(min(ring))
    ring = ring[turn:] + ring[:turn]
    return [*ring, ring[0]]


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


@attrs.frozen
class CauseTree:
    """One node of the tree of causes.

    Attributes
    ----------
    node : int
        The node.
    moved : float
        By how much it changed; nan where the edit itself set it, 0 where it did not change.
    seed : bool
        Whether the edit set it.
    causes : tuple of CauseTree
        The nodes whose change made it be evaluated, the one that moved most first. None for
        a seed, and for a node whose recipe was changed.
    """

    node: int
    moved: float
    seed: bool
    causes: tuple[CauseTree, ...]


class CauseTracer:
    """Answers questions about one update.

    Parameters
    ----------
    cause : Readers
        Every push: `reader` was evaluated because `source` had changed.
    changed : (k,) int
        Nodes that changed; one may stand more than once.
    moved : (k,) float
        By how much; nan for what the edit set.
    seeds : (s,) int
        Nodes that the edit set.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.graph.run_update import cause_chain, CauseTracer
    >>> from assoc_hull.graph.run_update import Readers
    >>> pushes = Readers(np.array([3, 5, 7]), np.array([2, 3, 5]))
    >>> moved = np.array([np.nan, 0.2, 0.1])
    >>> tracer = CauseTracer(pushes, np.array([2, 3, 5]), moved, np.array([2]))
    >>> cause_chain(tracer.trace(5)), tracer.cut_off(5)
    ([5, 3, 2], (7,))
    """

    def __init__(
        self, cause: Readers, changed: IntArray, moved: FloatArray, seeds: IntArray
    ) -> None:
        self.cause = cause
        self.seeds = frozenset(seeds.tolist())
        self.moved: dict[int, float] = {}
        for node, amount in zip(changed.tolist(), moved.tolist(), strict=True):
            self.moved[node] = _more(amount, self.moved.get(node, 0.0))
        self._done: dict[int, CauseTree] = {}

    def knows(self, node: int) -> bool:
        """Tell whether the update changed or evaluated a node."""
        return node in self.moved or bool((self.cause.reader == node).any())

    def trace(self, node: int) -> CauseTree:
        """Give the tree of causes of a node; equal parts of it are one object."""
        return self._trace(node, ())

    def cut_off(self, node: int) -> tuple[int, ...]:
        """Give the nodes that read this one, were evaluated, and came out as they were."""
        readers = np.unique(self.cause.reader[self.cause.source == node])
        return tuple(reader for reader in readers.tolist() if reader not in self.moved)

    def _trace(self, node: int, path: tuple[int, ...]) -> CauseTree:
        if node in self._done:
            return self._done[node]
        here = (*path, node)
        seed = node in self.seeds
        sources = [] if seed else [each for each in self._sources(node) if each not in here]
        causes = tuple(self._trace(each, here) for each in sources)
        found = CauseTree(node, self.moved.get(node, 0.0), seed, causes)
        self._done[node] = found
        return found

    def _sources(self, node: int) -> list[int]:
        """Give what made a node be evaluated; not what went there and came back meanwhile."""
        every = np.unique(self.cause.source[self.cause.reader == node]).tolist()
        found = [each for each in every if each in self.moved] or every
        return sorted(found, key=lambda each: (-_size(self.moved.get(each, 0.0)), each))


def _more(one: float, other: float) -> float:
    """Give the larger of two amounts; nan, set by the edit, goes before all."""
    return one if _size(one) >= _size(other) else other


def _size(amount: float) -> float:
    return float("inf") if np.isnan(amount) else amount


def cause_chain(trace: CauseTree) -> list[int]:
    """Give the nodes from one back to what set it off, always by the cause that moved most."""
    return [each.node for each in _links(trace)]


def _links(trace: CauseTree) -> Iterator[CauseTree]:
    yield trace
    while trace.causes:
        trace = trace.causes[0]
        yield trace
