"""Text forms of a graph: GraphML, DOT, Mermaid and JSON.

Nodes carry ``kind`` and ``name``, edges ``kind``; all other attributes are passed on, to
Mermaid those that its pictures can show. Nodes and edges come in the order of the graph.
Names may hold any character: each form writes them so that it can be read back, but for
characters that it cannot hold, which become U+FFFD.
"""

from __future__ import annotations

import io
import json
import re
from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING

from assoc_hull.arguments import choice

if TYPE_CHECKING:
    import networkx

    Any_Graph = networkx.DiGraph[str]

__all__ = ["FORMATS", "graph_text"]

FORMATS = ("graphml", "dot", "mermaid", "json")

_NO_TEXT = re.compile("[\ud800-\udfff]")
_NO_XML = re.compile("[^\t\n\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
_NO_MERMAID = re.compile(r"[^\w .,:+/()=@'-]", re.UNICODE)
_SHAPES = {
    "group": "folder", "line": "box", "curve": "box", "point": "ellipse", "definition": "note",
}  # fmt: skip


def graph_text(graph: Any_Graph, form: str) -> str:
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
    >>> from assoc_hull.graph.graph_text import graph_text
    >>> graph = networkx.DiGraph()
    >>> graph.add_edge("ST 7", "WL 1", kind="touch")
    >>> print(graph_text(graph, "mermaid"), end="")
    flowchart LR
      n0["ST 7"]
      n1["WL 1"]
      n0 -->|"touch"| n1
    """
    writers = {"graphml": _graphml, "dot": _dot, "mermaid": _mermaid, "json": _json}
    writer = writers[choice(form, "the form", FORMATS, "in export")]
    return _NO_TEXT.sub("\ufffd", "\n".join([*writer(graph), ""]))


def _graphml(graph: Any_Graph) -> Iterable[str]:
    import networkx

    plain = graph.__class__()
    plain.add_nodes_from((_xml(node), _plain(data)) for node, data in graph.nodes(data=True))
    plain.add_edges_from(
        (_xml(tail), _xml(head), _plain(data)) for tail, head, data in graph.edges(data=True)
    )
    stream = io.BytesIO()
    networkx.write_graphml_xml(plain, stream)
    return [stream.getvalue().decode().rstrip("\n")]


def _plain(data: Mapping[str, object]) -> dict[str, object]:
    """Keep what GraphML can say: texts, numbers and truth values; no value is left out."""
    return {
        name: value if isinstance(value, int | float) else _xml(_worded(value))
        for name, value in data.items()
        if value is not None
    }


def _worded(value: object) -> str:
    return value if isinstance(value, str) else json.dumps(value, ensure_ascii=False)


def _xml(text: str) -> str:
    return _NO_XML.sub("\ufffd", text)


def _json(graph: Any_Graph) -> Iterable[str]:
    import networkx

    data = networkx.node_link_data(graph, edges="edges")
    return [json.dumps(data, ensure_ascii=False, indent=1)]


def _dot(graph: Any_Graph) -> Iterator[str]:
    yield "digraph hull {"
    for node, data in graph.nodes(data=True):
        shape = _SHAPES.get(str(data.get("kind", "")), "ellipse")
        shown = {"label": data.get("name", node), "shape": shape, "style": _style(data)}
        yield f"  {_quoted(node)} [{_listed(shown | dict(data))}];"
    for tail, head, data in graph.edges(data=True):
        shown = {"label": _label(data)}
        yield f"  {_quoted(tail)} -> {_quoted(head)} [{_listed(shown | dict(data))}];"
    yield "}"


def _style(data: Mapping[str, object]) -> str:
    """Dash points through which no curve is made, round the corners of curves."""
    if data.get("kind") == "curve":
        return "rounded"
    return "dashed" if data.get("role") == "derived" else "solid"


def _label(data: Mapping[str, object]) -> str:
    """Say of what kind an edge is, and whether it has a twin that runs back."""
    return ", ".join(str(data[name]) for name in ("kind", "way") if data.get(name))


def _listed(data: Mapping[str, object]) -> str:
    return ", ".join(
        f"{name}={_quoted(_worded(value))}" for name, value in data.items() if value is not None
    )


def _quoted(text: str) -> str:
    """Quote for DOT, on one line."""
    for mark, written in (("\\", "\\\\"), ('"', '\\"'), ("\n", "\\n"), ("\r", "\\r")):
        text = text.replace(mark, written)
    return '"' + text.replace("\0", "\ufffd") + '"'


def _mermaid(graph: Any_Graph) -> Iterator[str]:
    number = {node: f"n{i}" for i, node in enumerate(graph)}
    yield "flowchart LR"
    for node, data in graph.nodes(data=True):
        names = [str(data[name]) for name in ("role", "crossing_role") if data.get(name)]
        told = f"<br/>{_coded(', '.join(names))}" if data.get("kind") == "point" else ""
        yield f'  {number[node]}["{_coded(str(data.get("name", node)))}{told}"]'
    for tail, head, data in graph.edges(data=True):
        label = _label(data)
        mark = f'|"{_coded(label)}"|' if label else ""
        yield f"  {number[tail]} -->{mark} {number[head]}"


def _coded(text: str) -> str:
    """Write whatever Mermaid or a browser might read as a mark by its number."""
    return _NO_MERMAID.sub(lambda found: f"#{ord(found[0])};", text)
