"""Who drives whom in a hull, pair by pair of curves."""

from __future__ import annotations

from collections.abc import Iterator

import attrs

from assoc_hull.hull import Hull
from assoc_hull.model.address import AddressBook
from assoc_hull.model.state import HullState
from assoc_hull.plot.lines_plan.drawing import state_of

__all__ = ["Link", "Node", "links"]


@attrs.frozen
class Node:
    """A curve in the network: its name, the family, and where its plane lies (m)."""

    name: str
    family: str
    offset: float


@attrs.frozen
class Link:
    """That one curve makes another through some crossings.

    Attributes
    ----------
    tail, head : Node
        What drives, and what is made from it.
    driven, shared : int
        Crossings at which the tail drives the head, and those that define both.
    """

    tail: Node
    head: Node
    driven: int
    shared: int


def links(hull: Hull | HullState) -> tuple[Link, ...]:
    """Give who drives whom, by crossings; a pair with shared crossings comes once each way."""
    state = state_of(hull)
    book = AddressBook(state)
    node: dict[int, Node] = {}
    for curve in state.live("curves").tolist():
        line = state.line_of(curve)
        offset = float(state.lines.offset.data[line])
        node[curve] = Node(book.curve_name(curve), state.family(line).name, offset)
    counts: dict[tuple[int, int], list[int]] = {}
    for tail, head, shared in _links(state):
        counts.setdefault((tail, head), [0, 0])[shared] += 1
    return tuple(Link(node[a], node[b], *count) for (a, b), count in sorted(counts.items()))


def _links(state: HullState) -> Iterator[tuple[int, int, int]]:
    """Give tail, head, and whether the crossing is shared, for each crossing that counts."""
    table = state.rows
    for row in state.live("rows").tolist():
        driver = int(table.driver.data[row])
        readers = table.reader.data[row][table.reader.data[row] >= 0].tolist()
        if driver >= 0:
            yield from ((driver, reader, 0) for reader in readers)
        elif len(readers) == 2:
            first, second = readers
            yield first, second, 1
            yield second, first, 1
