"""What an open edit has reached: nodes to evaluate, and objects by address with their causes.

What an open edit has reached so far: all that an update would have to evaluate if it ran now.

It starts from the points, curves and definitions that were asked for, each with the words of what
asked for it, and goes on to all that is made from these. That is an upper bound: an update stops
where something comes out as it was. Curves that only a mended gap, a new crossing or a
feature that is drawn anew would make it loft are told beside.

Examples
--------
>>> import assoc_hull as ah
>>> hull = ah.examples.wigley()
>>> with hull.edit("fuller") as edit:
...     edit.move("WL 2.5 x ST 7", y=2.95)
...     print(hull.dirty)
...     print(hull["ST 7"].dirty)
dirty because of the move of WL 2.5 x ST 7: 3 curves, 2 points
because of the move of WL 2.5 x ST 7, through WL 2.5 x ST 7
>>> len(hull.dirty)
0
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property

import numpy as np

from assoc_hull.display import ShownAsText, counted
from assoc_hull.edit.document import Document
from assoc_hull.edit.followup.redraw_features import redrawable_points
from assoc_hull.edit.modification import Extent, Pending
from assoc_hull.edit.recording import Said, asked_words, joined_words
from assoc_hull.geometry.curves import IntArray
from assoc_hull.graph.run_update import closure, spread
from assoc_hull.model.address import AddressBook
from assoc_hull.model.dirty_cause import DirtyCause, cause_of, node_name
from assoc_hull.model.dirty_nodes import DirtyNodes
from assoc_hull.model.form_definition import FormDefinition
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.links import latent_curves
from assoc_hull.model.named_mapping import NamedMapping
from assoc_hull.model.network import HullNetwork
from assoc_hull.model.node import Node
from assoc_hull.model.objects import Curve, Point
from assoc_hull.model.tables import HullState

__all__ = ["Dirty", "dirty_nodes"]


class Dirty(ShownAsText, Mapping[str, DirtyCause]):
    """Dirty curves, points and definitions by address, each with because of what it is that.

    It holds all that is made from what was asked for: the update evaluates no other, but for the
    curves of `perhaps`, and stops where something comes out with the bits that it had.

    Parameters
    ----------
    state : HullState
        The tables of the edit; what is told later is how they are now.
    nodes : DirtyNodes
        What it has reached.
    """

    def __init__(self, state: HullState, nodes: DirtyNodes) -> None:
        self._home, self._nodes = state, nodes
        self._state = state.as_written() if nodes.by else state.published()

    @cached_property
    def _book(self) -> AddressBook:
        return AddressBook(self._state)

    @cached_property
    def _by_name(self) -> NamedMapping[int]:
        """Nodes by name: curves, then points and definitions, by number."""
        curves, rows = self._state.curves.alive, self._state.rows.alive
        order = sorted(self._nodes.by, key=lambda node: (not Node.is_curve(node), node))
        alive = [
            node for node in order
            if Node.is_form(node)
            or (curves if Node.is_curve(node) else rows)[Node.number(node)]
        ]  # fmt: skip
        names = {node_name(self._book, node): node for node in alive}
        return NamedMapping("dirty object", names, spoken=True)

    @property
    def asked(self) -> tuple[str, ...]:
        """What was asked for so far, in words."""
        return self._nodes.asked

    @property
    def curves(self) -> tuple[Curve, ...]:
        """The dirty curves, by number."""
        return self._curves(n for n in self._by_name.values() if Node.is_curve(n))

    @property
    def points(self) -> tuple[Point, ...]:
        """The dirty points, by number; a crossing once."""
        every = [Node.number(n) for n in self._by_name.values() if Node.is_point(n)]
        key = self._state.rows.key
        return tuple(
            Point(self._home, row, str(key[row]), self._book.usual_side(row)) for row in every
        )

    @property
    def definitions(self) -> tuple[FormDefinition, ...]:
        """The definitions with other values."""
        forms = [Node.form_number(n) for n in self._by_name.values() if Node.is_form(n)]
        return tuple(self._state.formed.definition[each] for each in forms)

    @property
    def perhaps(self) -> tuple[Curve, ...]:
        """Curves that a mended gap, a new crossing or a feature drawn anew would make dirty."""
        return self._curves(map(Node.curve, sorted(self._nodes.perhaps)))

    def _curves(self, nodes: Iterator[int]) -> tuple[Curve, ...]:
        key, numbers = self._state.curves.key, map(Node.number, nodes)
        return tuple(Curve(self._home, number, str(key[number])) for number in numbers)

    def __getitem__(self, address: str) -> DirtyCause:
        found = cause_of(self._state, self._nodes, self._by_name[address], self._book)
        assert found is not None, "it is one of those that are dirty"
        return found

    def __iter__(self) -> Iterator[str]:
        return iter(self._by_name)

    def __len__(self) -> int:
        return len(self._by_name)

    def __str__(self) -> str:
        if not self:
            return "nothing is dirty"
        curves, points = (
            sum(map(kind, self._by_name.values())) for kind in (Node.is_curve, Node.is_point)
        )
        counts = [counted(curves, "curve"), counted(points, "point")]
        if more := len(self._by_name) - curves - points:
            counts.append(counted(more, "definition"))
        found = f"dirty because of {joined_words(self.asked)}: {', '.join(counts)}"
        if rest := len(self._nodes.perhaps):
            found += f"; {counted(rest, 'more curve')} if a gap opens or a feature bends"
        return found

    def __repr__(self) -> str:
        return f"<Dirty: {self}>"


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
