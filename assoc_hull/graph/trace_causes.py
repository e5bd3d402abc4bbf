"""Why a node changed: from the pushes of an update back to what set it off."""

from __future__ import annotations

from collections.abc import Iterator

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.graph.network import Readers

__all__ = ["CauseTracer", "CauseTree", "cause_chain"]


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
    >>> from assoc_hull.graph.trace_causes import cause_chain, CauseTracer
    >>> from assoc_hull.graph.network import Readers
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
