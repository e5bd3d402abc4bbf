"""Filters of an exported graph: nodes within some steps, and some of the nodes.

The live structure is arrays; a networkx graph is only a view of it for people and tools.
What is kept stays in the order of the graph it is taken from. The text forms of a graph
stand in `assoc_hull.graph.graph_text`.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping
from typing import TYPE_CHECKING, TypeVar

from assoc_hull.errors import UnknownNameError

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
    >>> from assoc_hull.graph.graph_filter import subgraph
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
