"""The objects that an open edit has reached, by address, each with because of what.

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

from collections.abc import Iterator, Mapping
from functools import cached_property

from assoc_hull.display import ShownAsText
from assoc_hull.edit.asked_words import joined_words
from assoc_hull.model.address import AddressBook
from assoc_hull.model.dirty_cause import DirtyCause, cause_of, node_name
from assoc_hull.model.dirty_nodes import DirtyNodes
from assoc_hull.model.form_definition import FormDefinition
from assoc_hull.model.named_mapping import NamedMapping
from assoc_hull.model.node import Node
from assoc_hull.model.objects import Curve, Point
from assoc_hull.model.tables import HullState

__all__ = ["Dirty"]


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
        counts = [_counted(curves, "curve"), _counted(points, "point")]
        if more := len(self._by_name) - curves - points:
            counts.append(_counted(more, "definition"))
        found = f"dirty because of {joined_words(self.asked)}: {', '.join(counts)}"
        if rest := len(self._nodes.perhaps):
            found += f"; {_counted(rest, 'more curve')} if a gap opens or a feature bends"
        return found

    def __repr__(self) -> str:
        return f"<Dirty: {self}>"


def _counted(count: int, what: str) -> str:
    return f"{count} {what}{'' if count == 1 else 's'}"
