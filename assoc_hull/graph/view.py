"""Filters and text forms of an exported graph.

The live structure is arrays; a networkx graph is only a view of it for people and tools.
Nodes carry ``kind`` and ``name``, edges ``kind``; anything else is passed through.
"""

from __future__ import annotations

import json
from collections.abc import Collection, Iterable, Mapping
from typing import TYPE_CHECKING, Any, TypeVar

from assoc_hull.errors import BadInputError, UnknownNameError

if TYPE_CHECKING:
    import networkx

    Any_Graph = networkx.DiGraph[str]

__all__ = ["FORMATS", "around", "export", "only", "two_way"]

G = TypeVar("G", bound="Any_Graph")

FORMATS = ("graphml", "dot", "mermaid", "json")


def around(graph: G, node: str, up: int = 1, down: int = 1) -> G:
    """Keep what lies within some hops of a node.

    Parameters
    ----------
    graph : networkx.DiGraph or MultiDiGraph
        The graph.
    node : str
        The node.
    up, down : int
        Most hops against and along the edges.

    Returns
    -------
    graph
        A graph of its own, of the same class.

    Raises
    ------
    UnknownNameError
        No such node.

    Examples
    --------
    >>> import networkx
    >>> from assoc_hull.graph.view import around
    >>> sorted(around(networkx.DiGraph([("a", "b"), ("b", "c"), ("c", "d")]), "b", up=1, down=1))
    ['a', 'b', 'c']
    """
    if node not in graph:
        raise UnknownNameError("node", node, tuple(graph))
    kept = {node}
    for hops, step in ((up, graph.predecessors), (down, graph.successors)):
        front = {node}
        for _ in range(hops):
            front = {found for each in front for found in step(each)} - kept
            kept |= front
    return only(graph, kept)


def only(graph: G, nodes: Collection[str]) -> G:
    """Keep these nodes and the edges among them; names that are no nodes are passed over."""
    return graph.subgraph([node for node in graph if node in nodes]).copy()


def two_way(graph: G, kind: str | None = None) -> G:
    """Keep the edges that run both ways, and their nodes.

    Parameters
    ----------
    graph : networkx.DiGraph or MultiDiGraph
        The graph.
    kind : str or None
        Only edges of this kind.

    Examples
    --------
    >>> import networkx
    >>> from assoc_hull.graph.view import two_way
    >>> sorted(two_way(networkx.DiGraph([("a", "b"), ("b", "a"), ("b", "c")])).edges)
    [('a', 'b'), ('b', 'a')]
    """
    edges = [
        (tail, head, data) for tail, head, data in graph.edges(data=True)
        if kind is None or data.get("kind") == kind
    ]  # fmt: skip
    known = {(tail, head, data.get("kind")) for tail, head, data in edges}
    kept = [each for each in edges if (each[1], each[0], each[2].get("kind")) in known]
    names = {name for tail, head, _ in kept for name in (tail, head)}
    found = only(graph, names)
    found.remove_edges_from(list(found.edges))
    found.add_edges_from(kept)
    return found


def export(graph: Any_Graph, form: str) -> str:
    """Write a graph as text.

    Parameters
    ----------
    graph : networkx.DiGraph or MultiDiGraph
        The graph.
    form : {"graphml", "dot", "mermaid", "json"}
        The form; json is the node-link form of networkx.

    Returns
    -------
    str
        Nodes and edges in the order of the graph; ends with a newline.

    Raises
    ------
    BadInputError
        An unknown form.

    Examples
    --------
    >>> import networkx
    >>> from assoc_hull.graph.view import export
    >>> graph = networkx.DiGraph()
    >>> graph.add_edge("ST 7", "WL 1", kind="touch")
    >>> print(export(graph, "mermaid"), end="")
    flowchart LR
      n0["ST 7"]
      n1["WL 1"]
      n0 -->|touch| n1
    """
    writers = {"graphml": _graphml, "dot": _dot, "mermaid": _mermaid, "json": _json}
    if form not in writers:
        raise BadInputError(
            f"the form {form!r} was asked", "in export", f"use one of {', '.join(FORMATS)}"
        )
    return "\n".join([*writers[form](graph), ""])


def _graphml(graph: Any_Graph) -> Iterable[str]:
    import networkx

    plain = graph.__class__()
    plain.add_nodes_from((node, _plain(data)) for node, data in graph.nodes(data=True))
    plain.add_edges_from((tail, head, _plain(data)) for tail, head, data in graph.edges(data=True))
    return networkx.generate_graphml(plain)


def _plain(data: Mapping[str, Any]) -> dict[str, Any]:
    """Keep what GraphML can say: texts, numbers and truth values; no value is left out."""
    return {
        name: value if isinstance(value, (str, int, float, bool)) else json.dumps(value)
        for name, value in data.items()
        if value is not None
    }


def _json(graph: Any_Graph) -> Iterable[str]:
    import networkx

    data = networkx.node_link_data(graph, edges="edges")
    return [json.dumps(data, ensure_ascii=False, indent=1)]


def _dot(graph: Any_Graph) -> Iterable[str]:
    yield "digraph hull {"
    for node, data in graph.nodes(data=True):
        title, shape = _quoted(data.get("name", node)), _SHAPES.get(data.get("kind", ""), "ellipse")
        yield f"  {_quoted(node)} [label={title}, shape={shape}];"
    for tail, head, data in graph.edges(data=True):
        yield f"  {_quoted(tail)} -> {_quoted(head)} [label={_quoted(data.get('kind', ''))}];"
    yield "}"


_SHAPES = {"group": "folder", "line": "box", "curve": "ellipse", "point": "point"}


def _quoted(text: str) -> str:
    return '"' + str(text).replace("\\", "\\\\").replace('"', '\\"') + '"'


def _mermaid(graph: Any_Graph) -> Iterable[str]:
    number = {node: f"n{i}" for i, node in enumerate(graph)}
    yield "flowchart LR"
    for node, data in graph.nodes(data=True):
        title = str(data.get("name", node)).replace('"', "#quot;")
        yield f'  {number[node]}["{title}"]'
    for tail, head, data in graph.edges(data=True):
        mark = f"|{data['kind']}|" if data.get("kind") else ""
        yield f"  {number[tail]} -->{mark} {number[head]}"
