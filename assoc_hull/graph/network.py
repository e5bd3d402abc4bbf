"""What the update engine knows of the thing it updates: numbered nodes that read one another.

A *node* is an integer. A node is evaluated from the nodes it reads; each has a level, above
that of all it reads. The engine decides which nodes are evaluated, when, and why; the
network holds the values and does the arithmetic, many nodes at a time.
"""

from __future__ import annotations

from typing import Protocol

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.graph.journal import Journal, distinct

__all__ = [
    "Evaluation",
    "Network",
    "Readers",
    "closure",
    "distinct",
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
