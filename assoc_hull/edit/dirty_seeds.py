"""What an open edit has reached so far: all that an update would have to evaluate if it ran now.

It starts from the points, curves and definitions that were asked for, each with the words of what
asked for it, and goes on to all that is made from these. That is an upper bound: an update stops
where something comes out as it was. Curves that only a mended gap, a new crossing or a
feature that is drawn anew would make it loft are told beside.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from assoc_hull.edit.asked_words import asked_words
from assoc_hull.edit.document import Document
from assoc_hull.edit.followup.redraw_features import redrawable_points
from assoc_hull.edit.modification import Extent, Pending
from assoc_hull.edit.recording import Said
from assoc_hull.geometry.curves import IntArray
from assoc_hull.graph.network import closure, spread
from assoc_hull.model.dirty_nodes import DirtyNodes
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.links import latent_curves
from assoc_hull.model.network import HullNetwork
from assoc_hull.model.node import Node
from assoc_hull.model.tables import HullState

__all__ = ["dirty_nodes"]

_NONE: IntArray = np.zeros(0, np.int64)


def dirty_nodes(
    document: Document, pending: Pending, script: Sequence[Mapping[str, Said]],
    extents: Sequence[Extent], done: IntArray, name: str,
) -> DirtyNodes:  # fmt: skip
    """Give what is dirty.

    Parameters
    ----------
    document : Document
        The hull.
    pending : Pending
        What is asked for and not yet carried out.
    script, extents : sequence of dict, sequence of Extent
        The modifications in their order, and how much was pending after each.
    done : (k,) int
        Nodes that stages of the edit have changed already.
    name : str
        The edit, for what nothing else asked for.
    """
    state = document.state
    network = HullNetwork(state, document.index_of(state))
    words, by = [asked_words(each) for each in script], dict[int, int]()
    marks = list(zip(words, extents, strict=True))
    for asking, nodes in _seeds(state, pending, marks, done, name):
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
    state: HullState, pending: Pending, asked: list[tuple[str, Extent]], done: IntArray, name: str
) -> Iterator[tuple[str, IntArray]]:
    """Give the nodes that were asked for, with the words of what asked first."""
    edit = f"the edit {name!r}"
    last = asked[-1][0] if asked else edit
    yield edit, done
    if pending.alone:
        every = Node.curve(state.live("curves")), Node.point(state.live("rows"))
        yield last, np.concatenate(every)
        return
    rows = list(pending.values)
    fields = {kind: each.reached(state) for kind, each in pending.modifications.items()}
    before = Extent()
    for words, each in [*asked, (edit, pending.extent())]:
        chosen = [row for row in rows[before.values : each.values] if _moves(state, pending, row)]
        yield words, Node.point(np.array(chosen, np.int64))
        yield words, Node.curve(_sorted(each.curves - before.curves))
        yield words, Node.point(_sorted(each.computed - before.computed))
        for kind, found in fields.items():
            for more in found[before.fields.get(kind, 0) : each.fields.get(kind, 0)]:
                yield words, more
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
    """Give the curves that mended gaps, new crossings and features drawn anew may make dirty."""
    state = network.state
    alive = curves[state.curves.alive[curves]]
    table = state.rows
    watched = table.alive.data & (table.sort.data == Sort.CROSSING)
    pairs = table.curve.data[watched & (table.role.data == Role.WATCHED)]
    beside = pairs[np.isin(pairs, alive).any(axis=1)].ravel()
    latent = [latent_curves(state, curve) for curve in alive.tolist()]
    others = np.unique(np.concatenate([beside, *latent, _NONE]))
    every, found = alive, Node.curve(others)
    while True:
        # a feature on a line that changed may be drawn anew, and bend the one beside it
        drawn = redrawable_points(state, every)
        found = closure(network, np.concatenate([found, Node.curve(every), Node.point(drawn)]))
        more: IntArray = Node.number(found[Node.is_curve(found)])
        if len(more) == len(every):
            break
        every = more
    return frozenset(every[state.curves.alive[every]].tolist()) - set(curves.tolist())
