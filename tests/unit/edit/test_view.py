"""The exported graph shows all objects and links; filters and text forms."""

from __future__ import annotations

import json

import networkx
import numpy as np
import pytest

from assoc_hull.edit.document import Document
from assoc_hull.edit.transaction import Transaction
from assoc_hull.edit.view import changed_by, graph_of
from assoc_hull.errors import BadInputError, UnknownNameError
from assoc_hull.examples.wigley import wigley
from assoc_hull.graph.journal import Journal
from assoc_hull.graph.view import FORMATS, around, export, two_way
from assoc_hull.model.address import resolve
from assoc_hull.model.family import Role
from assoc_hull.model.make import Maker
from assoc_hull.model.state import Association
from assoc_hull.model.view import dependencies, graph, point_id


@pytest.fixture
def document() -> Document:
    """A hull of its own."""
    return Document(wigley())


def kinds(found: networkx.MultiDiGraph[str]) -> dict[str, int]:
    """How many edges there are of each kind."""
    names = [data["kind"] for _, _, data in found.edges(data=True)]
    return {name: names.count(name) for name in set(names)}


def test_every_object_is_a_node(document: Document) -> None:
    """Groups, lines, curves, and a point on each curve of a crossing."""
    state, found = document.state, graph(document.state)
    points = int((state.rows.curve.data[state.live("rows")] >= 0).sum())
    count = sum(len(state.live(name)) for name in ("groups", "lines", "curves"))
    assert found.number_of_nodes() == count + points
    assert all({"kind", "name"} <= set(data) for _, data in found.nodes(data=True))


def test_links_are_those_of_the_tables(document: Document) -> None:
    """Each point has one container; each crossing two friends, two parents, two touches."""
    state = document.state
    crossings = int((state.rows.curve.data[state.live("rows"), 1] >= 0).sum())
    own = len(state.live("rows")) - crossings
    found = kinds(graph(state))
    assert found["container"] == 2 * crossings + own
    assert found["friend"] == found["parent"] == found["touch actual"] == 2 * crossings


def test_attributes_tell_state_role_and_revision(document: Document) -> None:
    """They are those of the handles."""
    place = resolve(document.state, "WL 2.5 x ST 7")
    document.state.revision_row[place.row] = 4
    data = graph(document.state).nodes[point_id(document.state, place.row, place.side)]
    assert (data["name"], data["role"], data["state"]) == ("WL 2.5 x ST 7", "defining", "clean")
    assert (data["crossing_role"], data["revision"]) == ("shared", 4)


def test_dependencies_are_acyclic_and_follow_roles(document: Document) -> None:
    """An edge for each driver; with points the graph the update follows."""
    state = document.state
    row = resolve(state, "WL 5 x ST 7").row
    before = dependencies(state).number_of_edges()
    Maker(state, Journal()).roles(np.array([row]), np.array([Role.DRIVES_B]))
    found = dependencies(state)
    assert found.number_of_edges() == before + 1
    edge = found.edges["sections:35.000000/1", "waterlines:5.000000/1"]
    assert edge == {"kind": "drives", "through": [state.rows.key.data[row]]}
    assert networkx.is_directed_acyclic_graph(found)
    whole = dependencies(state, points=True)
    assert networkx.is_directed_acyclic_graph(whole)
    assert networkx.has_path(whole, "sections:35.000000/1", "waterlines:5.000000/1")


def test_around_keeps_hops_up_and_down() -> None:
    """Hops are counted on each side alone."""
    chain = networkx.DiGraph([("a", "b"), ("b", "c"), ("c", "d"), ("d", "e")])
    assert sorted(around(chain, "c", up=2, down=1)) == ["a", "b", "c", "d"]
    assert sorted(around(chain, "c", up=0, down=0)) == ["c"]
    with pytest.raises(UnknownNameError):
        around(chain, "z")


def test_two_way_keeps_what_has_a_twin() -> None:
    """By kind of edge."""
    found: networkx.MultiDiGraph[str] = networkx.MultiDiGraph()
    found.add_edge("a", "b", kind="touch")
    found.add_edge("b", "a", kind="parent")
    found.add_edge("b", "c", kind="touch")
    found.add_edge("c", "b", kind="touch")
    assert sorted(two_way(found).nodes) == ["b", "c"]
    assert two_way(found, "parent").number_of_nodes() == 0


def test_only_two_way_pairs_of_a_hull(document: Document) -> None:
    """A one-way association drops out."""
    whole = graph_of(document, two_way=True)
    section = resolve(document.state, "WL 2.5 x ST 7")
    node = point_id(document.state, section.row, 0)
    assert node in whole
    Maker(document.state, Journal()).associate(Association("sections", "waterlines", False))
    left = graph_of(document, two_way=True)
    assert node not in left
    assert "sections:35.000000/1" in left


def test_only_what_an_edit_changed(document: Document) -> None:
    """The point that was moved and its two curves."""
    row = resolve(document.state, "WL 2.5 x ST 7").row
    value = document.state.rows.xyz.data[[row]] + [[0.0, 0.01, 0.0]]
    with Transaction(document, "move") as edit:
        edit.write(np.array([row]), value, "move")
    found = graph_of(document, edit=-1)
    points = {point_id(document.state, row, side) for side in (0, 1)}
    assert set(found) == points | {"sections:35.000000/1", "waterlines:2.500000/1"}
    assert changed_by(document, 1) == changed_by(document, -1)
    with pytest.raises(BadInputError):
        changed_by(document, 2)


@pytest.mark.parametrize("form", FORMATS)
def test_every_form_tells_all_nodes_and_edges(document: Document, form: str) -> None:
    """Written for the objects and for the dependencies; ends with one newline."""
    for found in (graph_of(document, "WL 2.5 x ST 7"), dependencies(document.state)):
        text = export(found, form)
        assert text.endswith("\n")
        if form == "json":
            data = json.loads(text)
            assert (len(data["nodes"]), len(data["edges"])) == (len(found), found.number_of_edges())
        elif form == "graphml":
            back = networkx.parse_graphml(text)
            assert sorted(back.nodes) == sorted(found.nodes)
            assert back.number_of_edges() == found.number_of_edges()
        else:
            mark = " -> " if form == "dot" else " -->"
            assert text.count(mark) == found.number_of_edges()


def test_an_unknown_form_is_refused(document: Document) -> None:
    """The known ones are named."""
    with pytest.raises(BadInputError, match="mermaid"):
        export(dependencies(document.state), "png")


def test_names_are_quoted(document: Document) -> None:
    """Quotes in names do not break the forms."""
    found: networkx.DiGraph[str] = networkx.DiGraph()
    found.add_node('a "b"', name='a "b"')
    assert r"\"b\"" in export(found, "dot")
    assert "#quot;b#quot;" in export(found, "mermaid")
