"""The graph of a hull, and the parts of it that are asked for: around an object, by one edit."""

from __future__ import annotations

from typing import TYPE_CHECKING

from assoc_hull.arguments import integer, shown
from assoc_hull.edit.document import Document
from assoc_hull.edit.explain import Thing
from assoc_hull.errors import BadInputError, ForeignPointError, WrongTypeError
from assoc_hull.graph import view as filters
from assoc_hull.model.handles import Point, handle
from assoc_hull.model.state import HullState
from assoc_hull.model.view import graph, point_id

if TYPE_CHECKING:
    import networkx

__all__ = ["changed_by", "graph_of"]


def graph_of(
    document: Document,
    around: Thing | str | None = None,
    hops: tuple[int, int] = (1, 1),
    two_way: bool = False,
    edit: int | None = None,
) -> networkx.MultiDiGraph[str]:
    """Give objects and links as a graph, see `assoc_hull.model.view.graph`, or a part of it.

    Parameters
    ----------
    document : Document
        The hull with its history.
    around : object, address or None
        Only what lies within some hops of this object.
    hops : (int, int)
        Most hops against and along the links.
    two_way : bool
        Only pairs of curves each of which generates, or may generate, on the other.
    edit : int or None
        Only what this edit changed: 1 is the first, -1 the last.

    Examples
    --------
    >>> from assoc_hull.edit.document import Document
    >>> from assoc_hull.edit.view import graph_of
    >>> from assoc_hull.examples.wigley import wigley
    >>> sorted(graph_of(Document(wigley()), "WL 2.5 x ST 7", (0, 1)).nodes)[-1]
    'waterlines:2.500000/1'
    """
    found = graph(document.state)
    if around is not None:
        found = filters.around(found, _node(document.state, around), *hops)
    if two_way:
        found = _two_way(found)
    return found if edit is None else filters.only(found, changed_by(document, edit))


def _two_way(found: networkx.MultiDiGraph[str]) -> networkx.MultiDiGraph[str]:
    """Keep crossings whose two points were both generated, and latent pairs, with their curves."""
    touches = [each for each in found.edges(data=True) if each[2]["kind"] == "touch actual"]
    made = {head for _, head, _ in touches}
    friends = filters.two_way(found, "friend")
    points = {node for node in friends if node in made and made.issuperset(friends[node])}
    curves = {tail for tail, head, _ in touches if head in points}
    latent = filters.two_way(found, "touch latent")
    kept = filters.only(found, points | curves | set(latent))
    one_way = [
        (tail, head, key)
        for tail, head, key, data in kept.edges(keys=True, data=True)
        if data["kind"] == "touch latent" and not latent.has_edge(tail, head)
    ]
    kept.remove_edges_from(one_way)
    return kept


def _node(state: HullState, thing: Thing | str) -> str:
    found = handle(state, thing) if isinstance(thing, str) else thing
    if not isinstance(found, Thing):
        what = f"the object is {shown(found)}"
        raise WrongTypeError(what, "in graph", "give a handle or an address")
    if found.tables is not state:
        raise ForeignPointError(f"{type(found).__name__.lower()} {found.id!r}")
    return point_id(state, found.row, found.side) if isinstance(found, Point) else found.id


def changed_by(document: Document, number: int) -> frozenset[str]:
    """Name what an edit changed, as nodes of the graphs of `assoc_hull.model.view`.

    Parameters
    ----------
    document : Document
        The hull with its history.
    number : int
        Number of the edit, from 1; -1 is the last one.

    Returns
    -------
    frozenset of str
        Keys of curves, and of points with and without the curve they lie on.

    Raises
    ------
    BadInputError
        No such edit.

    Examples
    --------
    >>> from assoc_hull.edit.document import Document
    >>> from assoc_hull.edit.view import changed_by
    >>> from assoc_hull.examples.wigley import wigley
    >>> changed_by(Document(wigley()), 1)
    Traceback (most recent call last):
    ...
    assoc_hull.errors.BadInputError: edit 1 was asked, in a history of 0; give a number from 1
    """
    count = len(document.history)
    integer(number, "edit", "in graph", least=-(10**6))
    if not (1 <= number <= count or -count <= number <= -1):
        raise BadInputError(
            f"edit {number} was asked", f"in a history of {count}", "give a number from 1"
        )
    step = document.history[number - 1 if number > 0 else number]
    state = document.state
    curves = {str(state.curves.key.data[curve]) for curve in step.curves.tolist()}
    return frozenset(curves.union(*(_names(state, row) for row in step.rows.tolist())))


def _names(state: HullState, row: int) -> set[str]:
    sides = [side for side in (0, 1) if state.rows.curve.data[row, side] >= 0]
    return {str(state.rows.key.data[row])} | {point_id(state, row, side) for side in sides}
