"""The exported graph shows all objects and links; filters and text forms."""

from __future__ import annotations

import json

import networkx
import numpy as np
import pytest

from assoc_hull.edit.document import Document
from assoc_hull.edit.explain.hull_graph import changed_by, graph_of, nodes_within
from assoc_hull.edit.session import Edit
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import BadInputError, UnknownNameError
from assoc_hull.graph.graph_text import FORMATS, graph_text
from assoc_hull.graph.journal import Journal
from assoc_hull.model.address import resolve_address
from assoc_hull.model.definition.records import definition, published
from assoc_hull.model.definition.restore import from_definition
from assoc_hull.model.kinds import Role
from assoc_hull.model.make_objects import Maker
from assoc_hull.model.object_graph import dependencies, object_graph, point_id
from assoc_hull.model.objects import Crossing, Curve, handle
from assoc_hull.model.tables import Association
from assoc_hull.shipped.wigley import wigley
from tests.unit.edit.planted_defects import DEFECTS, planted, sound


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
    state, found = document.state, object_graph(document.state)
    points = int((state.rows.curve[state.live("rows")] >= 0).sum())
    count = sum(len(state.live(name)) for name in ("groups", "lines", "curves"))
    assert found.number_of_nodes() == count + points
    assert all({"kind", "name"} <= set(data) for _, data in found.nodes(data=True))


def test_links_are_those_of_the_tables(document: Document) -> None:
    """Each point has one container; each crossing two friends, two parents, two touches."""
    state = document.state
    crossings = int((state.rows.curve[state.live("rows"), 1] >= 0).sum())
    own = len(state.live("rows")) - crossings
    found = kinds(object_graph(state))
    assert found["container"] == 2 * crossings + own
    assert found["friend"] == found["parent"] == found["touch actual"] == 2 * crossings


def test_attributes_tell_state_role_and_revision(document: Document) -> None:
    """They are those of the handles."""
    place = resolve_address(document.state, "WL 2.5 x ST 7")
    document.state.revision_row[place.row] = 4
    data = object_graph(document.state).nodes[point_id(document.state, place.row, place.side)]
    assert (data["name"], data["role"], data["state"]) == ("WL 2.5 x ST 7", "defining", "clean")
    assert (data["crossing_role"], data["revision"]) == ("shared", 4)


def test_dependencies_are_acyclic_and_follow_roles(document: Document) -> None:
    """An edge for each driver; with points the graph the update follows."""
    state = document.state
    row = resolve_address(state, "WL 5 x ST 7").row
    before = dependencies(state).number_of_edges()
    Maker(state, Journal()).roles(np.array([row]), np.array([Role.DRIVES_B]))
    found = dependencies(state)
    assert found.number_of_edges() == before + 1
    edge = found.edges["sections:35.000000/1", "waterlines:5.000000/1"]
    assert edge == {"kind": "drives", "through": [state.rows.key[row]]}
    assert networkx.is_directed_acyclic_graph(found)
    whole = dependencies(state, points=True)
    assert networkx.is_directed_acyclic_graph(whole)
    assert networkx.has_path(whole, "sections:35.000000/1", "waterlines:5.000000/1")


def test_around_keeps_hops_up_and_down() -> None:
    """Hops are counted on each side alone; more than there are end at the ends."""
    chain = networkx.DiGraph([("a", "b"), ("b", "c"), ("c", "d"), ("d", "e")])
    assert sorted(nodes_within(chain, ["c"], up=2, down=1)) == ["a", "b", "c", "d"]
    assert sorted(nodes_within(chain, ["c"], up=0, down=0)) == ["c"]
    assert len(nodes_within(chain, ["c"], up=10**12, down=10**12)) == 5
    with pytest.raises(UnknownNameError):
        nodes_within(chain, ["z"])


def test_what_is_reached_against_the_links_is_reached_along_them_too() -> None:
    """Two nodes that point at one another are each other's hop, up as down."""
    pair = networkx.DiGraph([("a", "b"), ("b", "a"), ("b", "c")])
    assert sorted(nodes_within(pair, ["a"], up=1, down=2)) == ["a", "b", "c"]


def test_around_a_line_means_around_its_curves_too(document: Document) -> None:
    """One hop from a line are the points on it and those it has generated."""
    line, curve = handle(document.state, "WL 2.5"), handle(document.state, "WL 2.5 [1]")
    found = graph_of(document, "WL 2.5", (1, 1))
    assert set(found) == set(graph_of(document, line, (1, 1)))
    assert {line.id, curve.id, "waterlines"} < set(found)
    assert set(graph_of(document, curve, (1, 1))) < set(found)


def test_around_a_crossing_means_around_both_points(document: Document) -> None:
    """Given as a handle; the node of a point, as the text forms write it, is taken too."""
    row = resolve_address(document.state, "WL 2.5 x ST 7").row
    nodes = {point_id(document.state, row, side) for side in (0, 1)}
    assert set(graph_of(document, Crossing.of(document.state, row), (0, 0))) == nodes
    for node in nodes:
        assert set(graph_of(document, node, (0, 0))) == {node}


def turn_one_way(document: Document) -> None:
    """Let sections generate on waterlines, and no longer the other way."""
    Maker(document.state, Journal()).associate(Association("sections", "waterlines", False))


def ways(found: networkx.MultiDiGraph[str]) -> set[tuple[str, str]]:
    """The kinds and ways of the links that have a way."""
    return {(data["kind"], data["way"]) for _, _, data in found.edges(data=True) if "way" in data}


def test_touches_and_associations_tell_their_way(document: Document) -> None:
    """Two-way where both sides generate; one association changed, one way changes."""
    assert {way for _, way in ways(object_graph(document.state))} == {"two-way"}
    turn_one_way(document)
    found = object_graph(document.state)
    one_way = [each for each in found.edges(data=True) if each[2].get("way") == "one-way"]
    assert {data["kind"] for _, _, data in one_way} == {"association", "touch actual"}
    assert all(tail.startswith("sections") for tail, _, _ in one_way)


def test_only_two_way_and_only_one_way_part_the_links(document: Document) -> None:
    """Each touch and association is in one of the two; crossings bring curves and friends."""
    assert len(graph_of(document, only="one-way")) == 0
    turn_one_way(document)
    place = resolve_address(document.state, "WL 2.5 x ST 7")
    friends = {point_id(document.state, place.row, side) for side in (0, 1)}
    both, one = graph_of(document, only="two-way"), graph_of(document, only="one-way")
    assert {way for _, way in ways(both)} == {"two-way"}
    assert {way for _, way in ways(one)} == {"one-way"}
    assert friends | {"sections:35.000000/1", "waterlines:2.500000/1"} <= set(one)
    assert not friends & set(both)
    assert "sections:35.000000/1" in both, "it has other links"
    whole = [data for _, _, data in object_graph(document.state).edges(data=True) if "way" in data]
    told = [data for part in (both, one) for _, _, data in part.edges(data=True) if "way" in data]
    assert len(told) == len(whole)


def test_only_latent_keeps_curves_that_may_come_to_meet(document: Document) -> None:
    """As the handles list them; nothing else is left. A buttock far out misses the ends."""
    with Edit(document, "add") as edit:
        edit.add_line("buttocks", 4.0)
    found = graph_of(document, only="latent")
    told = {(tail, head) for tail, head in found.edges()}
    listed = {
        (curve.id, other.id)
        for curve in (Curve.of(document.state, i) for i in document.state.live("curves").tolist())
        for other in curve.touch_objects.latent
    }
    assert told == listed
    assert {kind for kind, _ in ways(found)} == {"touch latent"}
    assert set(found) == {each for pair in listed for each in pair}


def test_a_filter_of_links_looks_at_the_whole_hull(document: Document) -> None:
    """A link at the border of what is near is not taken for one-way as its twin lies outside."""
    point = "WL 2.5 x ST 7"
    assert len(graph_of(document, point, (0, 0), only="one-way")) == 0
    assert len(graph_of(document, point, (0, 0), only="two-way")) == 1
    turn_one_way(document)
    near = graph_of(document, point, (1, 1), only="one-way")
    assert ways(near) == {("touch actual", "one-way")}
    assert set(near) <= set(graph_of(document, point, (1, 1)))


def move(document: Document, address: str = "WL 2.5 x ST 7") -> int:
    """Move a point by 10 mm; give its row."""
    row = resolve_address(document.state, address).row
    value = document.state.rows.xyz[[row]] + [[0.0, 0.01, 0.0]]
    with Transaction(document, "move") as edit:
        edit.write(np.array([row]), value, "move")
    return row


def test_only_what_an_edit_changed(document: Document) -> None:
    """The point that was moved and its two curves; the last edit where none is named."""
    row = move(document)
    found = graph_of(document, step=-1)
    points = {point_id(document.state, row, side) for side in (0, 1)}
    assert set(found) == points | {"sections:35.000000/1", "waterlines:2.500000/1"}
    assert changed_by(document, 1) == changed_by(document, -1)
    move(document, "WL 5 x ST 15")
    assert set(graph_of(document, only="changed", step=1)) == set(found)
    assert not set(graph_of(document, only="changed")) & set(found)
    with pytest.raises(BadInputError, match="from 1 to 2"):
        changed_by(document, 3)


def test_without_history_nothing_can_have_changed(document: Document) -> None:
    """That is said."""
    with pytest.raises(BadInputError, match="make an edit first"):
        graph_of(document, only="changed")


def test_an_unknown_filter_is_refused(document: Document) -> None:
    """The known ones are named."""
    with pytest.raises(BadInputError, match="latent"):
        graph_of(document, only="both")  # type: ignore[arg-type]


def test_the_order_is_that_of_the_keys(document: Document) -> None:
    """Whatever the order in which the rows were made."""
    state = document.state
    again = from_definition(definition(state), published(state))
    for found, other in (
        (object_graph(state), object_graph(again)),
        (dependencies(state, True), dependencies(again, True)),
        (graph_of(document, "WL 5"), graph_of(Document(again), "WL 5")),
    ):
        assert graph_text(found, "json") == graph_text(other, "json")
    lines = [node for node, data in object_graph(state).nodes(data=True) if data["kind"] == "line"]
    assert lines == sorted(lines)


@pytest.mark.parametrize("form", FORMATS)
def test_every_form_tells_all_nodes_and_edges(document: Document, form: str) -> None:
    """Written for the objects and for the dependencies; ends with one newline."""
    for found in (graph_of(document, "WL 2.5 x ST 7"), dependencies(document.state)):
        text = graph_text(found, form)
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


@pytest.mark.parametrize(
    "name", [name for name, defect in DEFECTS.items() if defect.kind != "tables"]
)
def test_a_spoilt_hull_has_a_graph(name: str) -> None:
    """It is wanted most then: orphans and lone crossings are shown as far as they are linked."""
    state = sound()
    planted(name, state)
    found = object_graph(state)
    assert min(len(graph_text(found, form)) for form in FORMATS) > 1000
