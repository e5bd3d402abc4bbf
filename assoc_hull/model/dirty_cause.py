"""Because of what an object is dirty: what was asked for, and through which objects it came."""

from __future__ import annotations

import attrs

from assoc_hull.model.address import AddressBook
from assoc_hull.model.dirty_nodes import DirtyNodes
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.node import Node
from assoc_hull.model.tables import HullState

__all__ = ["DirtyCause", "cause_of", "node_name"]

_TOLD = 4
"""Of more objects on the way the first and the last are named."""


@attrs.frozen
class DirtyCause:
    """Because of what an object is dirty.

    Attributes
    ----------
    asked : str
        What was asked for.
    through : tuple of str
        The objects through which that comes to this one, in order; none where it was asked of
        this one.
    """

    asked: str
    through: tuple[str, ...] = ()

    def __str__(self) -> str:
        way = list(self.through)
        if len(way) > _TOLD:
            way[2:-2] = ["..."]
        return f"because of {self.asked}" + (f", through {', '.join(way)}" if way else "")


def cause_of(
    state: HullState, dirty: DirtyNodes, node: int, book: AddressBook | None = None
) -> DirtyCause | None:
    """Give because of what a node is dirty; None where it is clean.

    A watched crossing has no value of its own: it lies where its curves pass.
    """
    if node not in dirty.by:
        curves = _watched_curves(state, node)
        node = next((each for each in curves if each in dirty.by), node)
        if node not in dirty.by:
            return None
        way = dirty.way(node)
    else:
        way = dirty.way(node)[:-1]
    names = AddressBook(state) if book is None else book
    through = tuple(node_name(names, each) for each in way)
    return DirtyCause(dirty.asked[dirty.by[node]], through)


def node_name(book: AddressBook, node: int) -> str:
    """Name a node as an address would, or a definition by its name."""
    if Node.is_form(node):
        return str(book.state.formed.definition[Node.form_number(node)].name)
    number = Node.number(node)
    return book.curve_name(number) if Node.is_curve(node) else book.address(number)


def _watched_curves(state: HullState, node: int) -> list[int]:
    """Give the nodes of the curves of a watched crossing; of no other node."""
    if not Node.is_point(node):
        return []
    table, row = state.rows, Node.number(node)
    if table.sort[row] != Sort.CROSSING or table.role[row] != Role.WATCHED:
        return []
    return [Node.curve(curve) for curve in table.curve[row].tolist()]
