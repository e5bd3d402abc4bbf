"""Graphs as text: any name comes back, in every form, and nothing depends on chance."""

import json
import re
from xml.etree import ElementTree

import networkx
import pytest

from assoc_hull.errors import BadInputError
from assoc_hull.graph.graph_text import FORMATS, graph_text

NAMES = {
    "quotes": "a \"b\" 'c'",
    "brackets": "a [b] {c} <d> (e) |f|",
    "marks": "a & b # c ; d % e \\ f ` g $ h",
    "a closing backslash": "a \\",
    "Mermaid's words": "end %%{init: {}}%% --> n0 subgraph",
    "other scripts": "Spant 7½ 船体 é",
    "right to left": "שלום",
    "newlines": "a\nb",
    "line separators": "a\u2028b\x85c\x0bd",
    "HTML": "<br/>&amp;<script>",
}
FORBIDDEN = {"null": "a\0b", "a half character": "a\ud800b", "a return": "a\rb", "bell": "\x07"}


def graph_of(name: str) -> "networkx.MultiDiGraph[str]":
    """Two nodes, one of which has the name, and links between them."""
    found: networkx.MultiDiGraph[str] = networkx.MultiDiGraph()
    found.add_node(name, kind="point", name=name, role="defining", revision=3)
    found.add_node("other", kind="curve", name="WL 1", state="clean")
    found.add_edge(name, "other", kind="container")
    found.add_edge("other", name, kind="touch actual", way="one-way", through=[name])
    return found


def dot_statements(text: str) -> list[tuple[list[str], dict[str, str]]]:
    """The nodes of each statement of a DOT text, and its attributes; all of it is read."""
    quoted = r'"((?:[^"\\]|\\.)*)"'
    lines = text.split("\n")
    assert (lines[0], lines[-2:]) == ("digraph hull {", ["}", ""])
    found = []
    for line in lines[1:-2]:
        match = re.fullmatch(rf"  {quoted}(?: -> {quoted})? \[(.*)\];", line)
        assert match is not None, line
        listed = match[3]
        pairs = re.findall(rf"(\w+)={quoted}(?:, |$)", listed)
        assert ", ".join(f'{name}="{value}"' for name, value in pairs) == listed
        nodes = [unquoted(each) for each in match.group(1, 2) if each is not None]
        found.append((nodes, {name: unquoted(value) for name, value in pairs}))
    return found


def unquoted(text: str) -> str:
    """What a quoted text of DOT means."""
    return re.sub(r"\\(.)", lambda mark: {"n": "\n", "r": "\r"}.get(mark[1], mark[1]), text)


def unescaped(text: str) -> str:
    """What a text of Mermaid means."""
    return re.sub(r"#(\d+);", lambda code: chr(int(code[1])), text)


@pytest.mark.parametrize("name", NAMES.values(), ids=NAMES)
def test_any_name_comes_back_from_json(name: str) -> None:
    """Nodes and edges with their attributes, by networkx."""
    data = json.loads(graph_text(graph_of(name), "json"))
    back = networkx.node_link_graph(data, edges="edges")
    assert networkx.utils.graphs_equal(back, graph_of(name))


@pytest.mark.parametrize("name", NAMES.values(), ids=NAMES)
def test_any_name_comes_back_from_graphml(name: str) -> None:
    """By networkx, and the text is XML; but control characters, which XML cannot hold."""
    name = name.replace("\x0b", "")
    text = graph_text(graph_of(name), "graphml")
    ElementTree.fromstring(text.encode())
    back = networkx.parse_graphml(text, force_multigraph=True)
    assert back.nodes[name] == {"kind": "point", "name": name, "role": "defining", "revision": 3}
    ways = [data.get("way") for _, _, data in back.edges(data=True)]
    assert sorted(map(str, ways)) == ["None", "one-way"]


@pytest.mark.parametrize("name", NAMES.values(), ids=NAMES)
def test_any_name_comes_back_from_dot(name: str) -> None:
    """Each statement on a line, everything quoted, attributes after the label."""
    found = dot_statements(graph_text(graph_of(name), "dot"))
    assert [nodes for nodes, _ in found] == [[name], ["other"], [name, "other"], ["other", name]]
    assert (found[0][1]["label"], found[0][1]["role"], found[0][1]["revision"]) == (
        name, "defining", "3",
    )  # fmt: skip
    assert found[3][1]["label"] == "touch actual, one-way"


@pytest.mark.parametrize("name", NAMES.values(), ids=NAMES)
def test_any_name_comes_back_from_mermaid(name: str) -> None:
    """Nothing that Mermaid or a browser would read as a mark stands in a label."""
    lines = graph_text(graph_of(name), "mermaid").split("\n")
    label = re.fullmatch(r'  n0\["([^"]*)<br/>defining"\]', lines[1])
    assert label is not None, lines
    assert unescaped(label[1]) == name
    assert not set(re.sub(r"#\d+;", "", label[1])) & set('[]{}<>|"`&;#%\\\n')
    assert lines[3:] == ['  n0 -->|"container"| n1', '  n1 -->|"touch actual, one-way"| n0', ""]


@pytest.mark.parametrize("form", FORMATS)
@pytest.mark.parametrize("name", FORBIDDEN.values(), ids=FORBIDDEN)
def test_what_a_form_cannot_hold_breaks_nothing(form: str, name: str) -> None:
    """The text can be written as UTF-8 and read again."""
    text = graph_text(graph_of(name), form)
    assert text.encode().decode() == text
    if form == "graphml":
        assert len(networkx.parse_graphml(text)) == 2
    if form == "json":
        assert len(json.loads(text)["nodes"]) == 2
    if form == "dot":
        assert len(dot_statements(text)) == 4


@pytest.mark.parametrize("form", FORMATS)
def test_an_empty_graph_is_written(form: str) -> None:
    """As a graph without nodes."""
    text = graph_text(networkx.MultiDiGraph(), form)
    assert text.endswith("\n")
    if form == "graphml":
        assert len(networkx.parse_graphml(text)) == 0


def test_an_unknown_form_is_refused() -> None:
    """The known ones are named."""
    with pytest.raises(BadInputError, match="mermaid"):
        graph_text(networkx.MultiDiGraph(), "png")
