"""What an open edit has reached so far: all that an update would have to evaluate if it ran now.

It starts from the points, curves and definitions that were asked for, each with the words of what
asked for it, and goes on to all that is made from these. That is an upper bound: an update stops
where something comes out as it was. Curves that only a mended gap or a new crossing would make it
loft are told beside.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import attrs
import numpy as np

from assoc_hull.edit.document import Document
from assoc_hull.edit.modification import Modification, Pending
from assoc_hull.geometry.curves import IntArray
from assoc_hull.graph.network import spread
from assoc_hull.model.dirty_nodes import DirtyNodes
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.links import latent_curves
from assoc_hull.model.network import HullNetwork
from assoc_hull.model.node import Node
from assoc_hull.model.tables import HullState

__all__ = ["Extent", "dirty_nodes"]

_NONE: IntArray = np.zeros(0, np.int64)


@attrs.frozen
class Extent:
    """How much an edit had been asked for at some time: what came later is more than that.

    Attributes
    ----------
    words : str
        What was asked last, in words.
    values : int
        How many points had places.
    fields : dict of type to int
        By kind of modification, how many things were asked of it.
    curves, computed : frozenset of int
        Curves with another recipe, and crossings computed from another curve.
    """

    words: str
    values: int = 0
    fields: dict[type[Modification], int] = attrs.field(factory=dict)
    curves: frozenset[int] = frozenset()
    computed: frozenset[int] = frozenset()

    @classmethod
    def of(cls, words: str, pending: Pending) -> Extent:
        """Take it of what is pending now."""
        fields = {kind: each.asked_for for kind, each in pending.modifications.items()}
        curves = frozenset(pending.curves | set(pending.fresh))
        return cls(words, len(pending.values), fields, curves, frozenset(pending.computed))


def dirty_nodes(
    document: Document, pending: Pending, asked: Sequence[Extent], done: IntArray, name: str
) -> DirtyNodes:
    """Give what is dirty.

    Parameters
    ----------
    document : Document
        The hull.
    pending : Pending
        What is asked for and not yet carried out.
    asked : sequence of Extent
        What had been asked for after each modification, in their order.
    done : (k,) int
        Nodes that stages of the edit have changed already.
    name : str
        The edit, for what nothing else asked for.
    """
    state = document.state
    network = HullNetwork(state, document.index_of(state))
    words, by = [each.words for each in asked], dict[int, int]()
    for asking, nodes in _seeds(state, pending, asked, done, name):
        if len(nodes) and asking not in words:
            words.append(asking)
        for node in nodes.tolist():
            by.setdefault(node, words.index(asking))
    pairs = spread(network, np.array(sorted(by), np.int64))
    source = dict(zip(pairs.reader.tolist(), pairs.source.tolist(), strict=True))
    for node, other in source.items():
        by.setdefault(node, by[other])
    reached = pairs.reader[Node.is_curve(pairs.reader)]
    return DirtyNodes(tuple(words), by, source, _perhaps(network, np.sort(Node.number(reached))))


def _seeds(
    state: HullState, pending: Pending, asked: Sequence[Extent], done: IntArray, name: str
) -> Iterator[tuple[str, IntArray]]:
    """Give the nodes that were asked for, with the words of what asked first."""
    edit = f"the edit {name!r}"
    last = asked[-1].words if asked else edit
    yield edit, done
    if pending.alone:
        every = Node.curve(state.live("curves")), Node.point(state.live("rows"))
        yield last, np.concatenate(every)
        return
    rows = list(pending.values)
    fields = {kind: each.reached(state) for kind, each in pending.modifications.items()}
    before = Extent("")
    for each in [*asked, Extent.of(edit, pending)]:
        chosen = [row for row in rows[before.values : each.values] if _moves(state, pending, row)]
        yield each.words, Node.point(np.array(chosen, np.int64))
        yield each.words, Node.curve(_sorted(each.curves - before.curves))
        yield each.words, Node.point(_sorted(each.computed - before.computed))
        for kind, found in fields.items():
            for more in found[before.fields.get(kind, 0) : each.fields.get(kind, 0)]:
                yield each.words, more
        before = each
    if pending.answer is not None:
        yield from pending.answer.reached()


def _moves(state: HullState, pending: Pending, row: int) -> bool:
    """Tell whether a point is asked to be elsewhere than it is."""
    table = state.rows
    return bool(table.alive[row] and (table.xyz[row] != pending.values[row] + 0.0).any())


def _sorted(numbers: frozenset[int]) -> IntArray:
    return np.array(sorted(numbers), np.int64)


def _perhaps(network: HullNetwork, curves: IntArray) -> frozenset[int]:
    """Give the curves that mended gaps and new crossings may make dirty beside some curves."""
    state = network.state
    alive = curves[state.curves.alive[curves]]
    table = state.rows
    watched = table.alive.data & (table.sort.data == Sort.CROSSING)
    pairs = table.curve.data[watched & (table.role.data == Role.WATCHED)]
    beside = pairs[np.isin(pairs, alive).any(axis=1)].ravel()
    latent = [latent_curves(state, curve) for curve in alive.tolist()]
    others = np.unique(np.concatenate([beside, *latent, _NONE]))
    reached = spread(network, Node.curve(others)).reader
    every: IntArray = Node.number(reached[Node.is_curve(reached)])
    return frozenset(every[state.curves.alive[every]].tolist()) - set(curves.tolist())
