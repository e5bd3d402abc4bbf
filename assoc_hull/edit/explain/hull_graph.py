"""The graph of a hull: what is computed from what, whole or around some of its objects.

Filters of an exported graph: nodes within some steps, and some of the nodes.

The live structure is arrays; a networkx graph is only a view of it for people and tools.
What is kept stays in the order of the graph it is taken from. The text forms of a graph
stand in `assoc_hull.graph.graph_text`.
"""

from __future__ import annotations

from collections.abc import (
    Callable,
    Collection,
    Iterable,
    Mapping,
)
from typing import TYPE_CHECKING, Literal, TypeVar

from assoc_hull.arguments import choice, shown
from assoc_hull.edit.dirty_objects import Dirty
from assoc_hull.edit.document import Document
from assoc_hull.edit.explain.causes import Thing, step_numbered
from assoc_hull.edit.modifications.definitions import definition_meant
from assoc_hull.errors import ForeignPointError, UnknownNameError, WrongTypeError
from assoc_hull.model.form_definition import FormDefinition
from assoc_hull.model.object_graph import object_graph, point_id
from assoc_hull.model.objects import (
    Crossing,
    Line,
    Point,
    handle,
)
from assoc_hull.model.tables import HullState

if TYPE_CHECKING:
    import networkx

__all__ = [
    "ONLY",
    "Any_Graph",
    "G",
    "OnlyName",
    "changed_by",
    "graph_of",
    "nodes_within",
    "subgraph",
]

if TYPE_CHECKING:
    import networkx

    Any_Graph = networkx.DiGraph[str]

__all__ = ["nodes_within", "subgraph"]

G = TypeVar("G", bound="Any_Graph")


def nodes_within(
    graph: Any_Graph, nodes: Iterable[str], up: int = 1, down: int = 1
) -> frozenset[str]:
    """Name the nodes within some hops of any of some nodes, these among them.

    Parameters
    ----------
    graph : networkx.DiGraph or MultiDiGraph
        The graph.
    nodes : iterable of str
        Where to begin.
    up, down : int
        Most hops against and along the edges; a way does not turn round.

    Raises
    ------
    UnknownNameError
        No such node.
    """
    start = frozenset(nodes)
    for node in sorted(start):
        if node not in graph:
            raise UnknownNameError("node", node, tuple(graph))
    kept = set(start)
    for hops, step in ((up, graph.predecessors), (down, graph.successors)):
        reached, front = set(start), set(start)
        while front and hops > 0:
            front = {found for each in front for found in step(each)} - reached
            reached |= front
            hops -= 1
        kept |= reached
    return frozenset(kept)


def subgraph(
    graph: G,
    nodes: Collection[str],
    edge: Callable[[Mapping[str, object]], bool] | None = None,
) -> G:
    """Keep these nodes and the edges among them; names that are no nodes are passed over.

    Parameters
    ----------
    graph : networkx.DiGraph or MultiDiGraph
        The graph.
    nodes : collection of str
        The nodes.
    edge : callable or None
        Tells by its attributes whether an edge is kept; None keeps all.

    Examples
    --------
    >>> import networkx
    >>> from assoc_hull.edit.explain.hull_graph import subgraph
    >>> list(subgraph(networkx.DiGraph([("a", "b"), ("b", "c")]), {"c", "b"}))
    ['b', 'c']
    """
    found = graph.__class__()
    found.add_nodes_from((node, data) for node, data in graph.nodes(data=True) if node in nodes)
    found.add_edges_from(
        (tail, head, data)
        for tail, head, data in graph.edges(data=True)
        if tail in found and head in found and (edge is None or edge(data))
    )
    return found


OnlyName = Literal["two-way", "one-way", "latent", "changed", "dirty"]
ONLY: tuple[OnlyName, ...] = ("two-way", "one-way", "latent", "changed", "dirty")


def graph_of(
    document: Document,
    around: Thing | FormDefinition | str | None = None,
    hops: tuple[int, int] = (1, 1),
    only: OnlyName | None = None,
    step: int | None = None,
) -> networkx.MultiDiGraph[str]:
    """Give objects and links as a graph (`model.object_graph`), or a part of it.

    Parameters
    ----------
    document : Document
        The hull with its history.
    around : object, definition, address, node or None
        Only what lies within some hops of this object; of a line, of its curves too.
    hops : (int, int)
        Most hops against and along the links, counted in the whole graph.
    only : {"two-way", "one-way", "latent", "changed", "dirty"} or None
        Links of this kind and what they join: curves (and groups) each of which generates,
        or may generate, on the other; those of which only one does; curves that may come to
        meet and do not; what an edit changed; or what the edit that is open here has reached.
    step : int or None
        Only what the edit of this number changed, as the history counts; -1 is the last. None
        with "changed" means the last.

    Returns
    -------
    networkx.MultiDiGraph
        What passes every filter that was given. Inside an edit, what it has reached has a
        ``dirty`` that says because of what.

    Raises
    ------
    UnknownNameError, ForeignPointError, WrongTypeError, BadInputError
        No such object, filter or edit.

    Examples
    --------
    >>> from assoc_hull.edit.document import Document
    >>> from assoc_hull.edit.explain.hull_graph import graph_of
    >>> from assoc_hull.shipped.wigley import wigley
    >>> sorted(graph_of(Document(wigley()), "WL 2.5 x ST 7", (0, 1)).nodes)[-1]
    'waterlines:2.500000/1'
    """
    if only is not None:
        choice(only, "only", ONLY, "in graph")
    number = -1 if only == "changed" and step is None else step
    changed = None if number is None else changed_by(document, number)
    found = object_graph(document.state.published())
    dirty = _dirty(document)
    for node, cause in dirty.items():
        if node in found:
            found.nodes[node]["dirty"] = cause
    kept = set(found) if only != "dirty" else set(found) & dirty.keys()
    if around is not None:
        kept &= nodes_within(found, _nodes(document.state.published(), around, found), *hops)
    if changed is not None:
        kept &= changed
    if only in ("two-way", "one-way", "latent"):
        found = _linked(found, only)
    return subgraph(found, kept) if len(kept) < len(found) else found


def _dirty(document: Document) -> dict[str, str]:
    """Give because of what nodes of the graph are dirty in the edit that is open here."""
    reached = document.state.dirty_here()
    if not reached.by:
        return {}
    was, found = document.state.published(), dict[str, str]()
    causes = Dirty(document.state, reached)
    for curve in causes.curves:
        found[curve.id] = str(curve.dirty)
    for point in causes.points:
        if point.number < was.rows.count and was.rows.alive[point.number]:
            found |= dict.fromkeys(_names(was, point.number), str(point.dirty))
    for each in causes.definitions:
        found[each.key] = str(causes[each.name])
    return found


def _linked(found: networkx.MultiDiGraph[str], kind: OnlyName) -> networkx.MultiDiGraph[str]:
    """Keep links of one kind, what they join, and for crossings both curves and friends."""

    def chosen(data: Mapping[str, object]) -> bool:
        return data["kind"] == "touch latent" if kind == "latent" else data.get("way") == kind

    def kept(data: Mapping[str, object]) -> bool:
        return "way" not in data or chosen(data)

    nodes = set[str]()
    for tail, head, data in found.edges(data=True):
        if chosen(data):
            nodes |= {tail, head}
            if data["kind"] == "touch actual":
                nodes.update(found.successors(head))
    return subgraph(found, nodes, kept)


def _nodes(
    state: HullState, thing: Thing | FormDefinition | str, found: networkx.MultiDiGraph[str]
) -> list[str]:
    """Give the nodes of an object; a line lies no nearer to its curves than they themselves."""
    if isinstance(thing, str) and thing in found and found.nodes[thing].get("kind") == "point":
        return [thing]
    definition = definition_meant(state, thing)
    if definition is not None:
        return [definition.key]
    given = handle(state, thing) if isinstance(thing, str) else thing
    if not isinstance(given, Thing):
        what = f"the object is {shown(given)}"
        raise WrongTypeError(what, "in graph", "give a handle or an address")
    if given.home is not state.live_tables:
        raise ForeignPointError(f"{type(given).__name__.lower()} {given.id!r}")
    if isinstance(given, Crossing):
        return [point_id(state, given.row, side) for side in (0, 1)]
    if isinstance(given, Point):
        return [point_id(state, given.row, given.side)]
    return [given.id, *(each.id for each in (given.curves if isinstance(given, Line) else ()))]


def changed_by(document: Document, number: int) -> frozenset[str]:
    """Name what an edit changed, as nodes of the graphs of `assoc_hull.model.object_graph`.

    Parameters
    ----------
    document : Document
        The hull with its history.
    number : int
        Number of the edit, as the history and `why` tell it; -1 is the last one.

    Returns
    -------
    frozenset of str
        Keys of curves and definitions, and of points with and without the curve they lie on.

    Raises
    ------
    BadInputError
        No such edit.

    Examples
    --------
    >>> from assoc_hull.edit.document import Document
    >>> from assoc_hull.edit.explain.hull_graph import changed_by
    >>> from assoc_hull.shipped.wigley import wigley
    >>> changed_by(Document(wigley()), 1)
    Traceback (most recent call last):
    ...
    assoc_hull.errors.BadInputError: edit 1 was asked, in a history of 0; make an edit first
    """
    step = step_numbered(document, number, "in graph")
    state = document.state.published()
    curves = {str(state.curves.key[curve]) for curve in step.curves.tolist()}
    curves |= {str(state.formed.definition[form].key) for form in step.forms.tolist()}
    return frozenset(curves.union(*(_names(state, row) for row in step.rows.tolist())))


def _names(state: HullState, row: int) -> set[str]:
    sides = [side for side in (0, 1) if state.rows.curve[row, side] >= 0]
    return {str(state.rows.key[row])} | {point_id(state, row, side) for side in sides}
