"""The graph of a net: nodes from rows, edges between them, normals, cells; what is refused."""

import re
from collections.abc import Callable
from typing import Any

import attrs
import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.analysis.net.curve_net import CurveNet, gather_net
from assoc_hull.edit.adoption.adopt_lines import adopt
from assoc_hull.errors import OpenNetError
from assoc_hull.geometry.curves import PointKind, SplineBatch
from assoc_hull.geometry.splines.arc_length import arc_length
from assoc_hull.model.kinds import BoundaryKind
from assoc_hull.model.line_source import LineSource
from assoc_hull.model.tables import Association, Particulars
from assoc_hull.surface.cells import net_faces
from assoc_hull.surface.cells.net_faces import NetCells, find_cells, sound_cells
from assoc_hull.surface.cells.net_graph import net_graph
from tests.nets import A, B, C, ellipsoid_net


@pytest.fixture(scope="module")
def wigley() -> CurveNet:
    """19 sections, 10 waterlines, profile and deck edge."""
    return gather_net(ah.examples.wigley().state)


def named(net: CurveNet, name: str) -> int:
    """The first curve of a line."""
    return net.name.index(name)


def without_rows(net: CurveNet, gone: np.ndarray) -> CurveNet:
    """The net without some of its crossings."""
    kept = ~gone
    return attrs.evolve(
        net, meets=net.meets[kept], place=net.place[kept], watched=net.watched[kept],
        row=net.row[kept],
    )  # fmt: skip


def rows_of(net: CurveNet, one: str, other: str) -> np.ndarray:
    """Which crossings are those of two lines."""
    names = np.array(net.name)[net.meets]
    return np.asarray((names == one).any(axis=1) & (names == other).any(axis=1))


def joined(one: CurveNet, other: CurveNet) -> CurveNet:
    """Two nets side by side."""
    count = one.batch.count
    both: dict[str, Any] = {
        name: np.concatenate([getattr(one, name), getattr(other, name)])
        for name in ("curve", "end", "flat", "knuckle", "x", "centre", "normal", "watched", "row")
    }
    return CurveNet(
        batch=SplineBatch.join([one.batch, other.batch]),
        name=one.name + other.name, family=one.family + other.family,
        meets=np.concatenate([one.meets, other.meets + count]),
        place=np.concatenate([one.place, other.place]), **both,
    )  # fmt: skip


def moved(net: CurveNet, way: float) -> CurveNet:
    """The net farther forward."""
    xyz = net.batch.xyz + np.array([way, 0.0, 0.0])
    return attrs.evolve(net, batch=attrs.evolve(net.batch, xyz=xyz))


def test_nodes_are_the_crossings_and_edges_the_pieces_between(wigley: CurveNet) -> None:
    """Every row has its node at its place; pieces of a line are as long together as the line."""
    graph = net_graph(wigley)
    hull = ah.examples.wigley()
    row = np.flatnonzero(rows_of(wigley, "WL 2.5", "ST 7"))[0]
    point = hull.find("WL 2.5 x ST 7")
    assert isinstance(point, ah.Point)
    assert graph.place[graph.row_node[row]].tolist() == np.asarray(point.position).tolist()
    assert (graph.row_node >= 0).all()
    total = np.bincount(graph.curve, graph.length, minlength=wigley.batch.count)
    assert total == pytest.approx(arc_length(wigley.batch), rel=2e-4)
    node, t = graph.stops(named(wigley, "WL 2.5"))
    assert len(node) == 21
    assert (np.diff(t) > 0.0).all()
    assert graph.points(4)[:, [0, -1]].tolist() == graph.place[graph.edge].tolist()


def test_points_along_edges_lie_at_equal_steps() -> None:
    """Chords of an edge differ in length by as much as its bend makes them."""
    step = np.diff(net_graph(gather_net(ellipsoid_net(15, 7))).points(8), axis=1)
    size = np.sqrt((step * step).sum(axis=2))
    assert (size.max(axis=1) <= 1.01 * size.min(axis=1)).all()


def test_a_line_that_closes_is_whole_where_nothing_crosses_it() -> None:
    """The profile of an ellipsoid begins and ends on top, where a section is left out."""
    net = gather_net(ellipsoid_net(15, 7))
    top = net.batch.xyz[net.batch.start[named(net, "profile")]]
    without = np.isclose(net.x, top[0])
    found = find_cells(net_graph(net, leave_out=without))
    assert without.sum() == 1
    assert found.count == 12 * 13
    assert len(found.graph.loose) == 0


def test_normals_are_those_of_the_formula() -> None:
    """On an ellipsoid to 1.5 degrees, but at its tips, where all lines run to one point."""
    graph = net_graph(gather_net(ellipsoid_net(31, 13)))
    place = graph.place - [A, 0.0, C]
    true = place / np.array([A, B, C]) ** 2
    true /= np.sqrt((true * true).sum(axis=1))[:, None]
    cosine = (graph.normal * true).sum(axis=1)
    tips = np.abs(place[:, 0]) > A - 1e-6
    assert np.degrees(np.arccos(cosine[~tips].clip(-1.0, 1.0))).max() < 1.5
    assert (cosine[tips] > 0.5).all()


def test_cells_of_a_net_of_two_families() -> None:
    """Between 19 stations, 10 waterlines, profile and deck edge; each node is told from outside."""
    found: NetCells = find_cells(net_graph(gather_net(ah.examples.wigley().state)))
    graph = found.graph
    assert len(graph.place) - len(graph.edge) + found.count + 1 == 2
    assert found.count == 220
    assert (found.sides == 4).all()  # at the foot of stem and sternpost, too: corners are nodes
    assert (found.cell_of[found.outline] == -1).all()
    assert (np.delete(found.cell_of, found.outline) >= 0).all()
    first = graph.place[found.nodes(0)]
    turn = np.cross(first[1] - first[0], first[2] - first[1])
    assert turn @ graph.normal[found.nodes(0)].mean(axis=0) > 0.0


def test_a_line_that_is_left_out_takes_its_nodes_with_it(wigley: CurveNet) -> None:
    """The lines that it crossed go on through: one row of cells less."""
    without = np.array(wigley.name) == "WL 2.5"
    graph = net_graph(wigley, leave_out=without)
    gone = rows_of(wigley, "WL 2.5", "ST 7") | (
        np.array(wigley.name)[wigley.meets] == "WL 2.5"
    ).any(axis=1)
    assert (graph.row_node[gone] == -1).all()
    assert (graph.row_node[~gone] >= 0).all()
    assert find_cells(graph).count == 200


def test_borders_of_flats_meet_lines_that_do_not_know_them(series60_70: ah.Hull) -> None:
    """Rows of a flat bottom and the sections are found again where they lay, to 1 mm."""
    net = gather_net(series60_70.state)
    flat = named(net, "flat of bottom")
    family = np.array(net.family)
    gone = (net.meets == flat).any(axis=1) & (family[net.meets] == "sections").any(axis=1)
    whole, found = net_graph(net), net_graph(without_rows(net, gone))
    assert gone.sum() == 39
    assert len(found.place) == len(whole.place)
    assert len(found.edge) == len(whole.edge)
    assert find_cells(found).count == find_cells(whole).count
    own, other = (graph.place[graph.stops(flat)[0]] for graph in (whole, found))
    assert np.abs(own - other).max() < 1e-3


def test_lines_that_lie_on_one_another_are_one(wigley: CurveNet) -> None:
    """A section drawn twice, once by another name, makes the cells that it makes drawn once."""
    own = named(wigley, "ST 7")
    twice = np.flatnonzero((wigley.meets == own).any(axis=1))
    again = wigley.batch.count
    meets = np.where(wigley.meets[twice] == own, again, wigley.meets[twice])
    keep = np.append(np.arange(again), own)
    doubled = attrs.evolve(
        wigley,
        batch=SplineBatch.join([wigley.batch, wigley.batch.curve(own)]),
        name=(*wigley.name, "ST 7 again"), family=(*wigley.family, "sections"),
        meets=np.concatenate([wigley.meets, meets]),
        place=np.concatenate([wigley.place, wigley.place[twice]]),
        watched=np.concatenate([wigley.watched, wigley.watched[twice]]),
        row=np.concatenate([wigley.row, wigley.row[twice]]),
        **{
            name: getattr(wigley, name)[keep]
            for name in ("curve", "end", "flat", "knuckle", "x", "centre", "normal")
        },
    )  # fmt: skip
    one, two = net_graph(wigley), net_graph(doubled)
    assert len(two.edge) == len(one.edge)
    assert len(two.place) == len(one.place)
    assert find_cells(two).count == 220


def refused(net: CurveNet, leave_out: np.ndarray | None = None) -> str:
    """The message with which the cells of a net are refused."""
    with pytest.raises(OpenNetError) as caught:
        find_cells(net_graph(net, leave_out=leave_out))
    return str(caught.value)


def test_a_crossing_without_a_row_is_named(wigley: CurveNet) -> None:
    """Inside the hull the edges do not fit on it any more; at an end the line ends nowhere."""
    told = refused(without_rows(wigley, rows_of(wigley, "WL 2.5", "ST 7")))
    assert "nodes - edges + faces is 0" in told
    assert "ST 7 x WL 2.5 near (35.000, 2.912, 2.500) m, 0.000 m apart" in told
    told = refused(without_rows(shortened(wigley), rows_of(wigley, "profile", "WL 2.5")))
    assert "lines end on no other line: WL 2.5 at (" in told


def test_a_place_that_a_face_passes_twice_is_named(
    wigley: CurveNet, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Where no pair of lines is found that crosses unlisted, the place of the fault is told."""
    monkeypatch.setattr(net_faces, "missed_crossings", lambda *_: ())
    told = refused(without_rows(wigley, rows_of(wigley, "WL 2.5", "ST 7")))
    # Neighbours of the crossing at (35, 2.912, 2.5) m that is missing.
    assert re.search(r"(ST [68] x WL 2.5|ST 7 x WL (1.875|3.125)) at \(", told)


def test_a_crossing_without_a_row_is_found_where_lines_meet(wigley: CurveNet) -> None:
    """The cells are those of the whole net, and what was done is told; 0.5 m apart it is not."""
    gone = rows_of(wigley, "WL 2.5", "ST 7")
    found, whole = sound_cells(without_rows(wigley, gone)), find_cells(net_graph(wigley))
    assert whole.notes == ()
    assert found.notes == (
        "crossings that the tables do not hold: "
        "ST 7 x WL 2.5 near (35.000, 2.912, 2.500) m, 0.000 m apart",
    )
    assert found.count == whole.count
    apart = without_rows(with_section_aside(wigley, "ST 7", 0.4), gone)
    with pytest.raises(OpenNetError, match=r"ST 7 x WL 2.5 near .* 0\.\d+ m apart"):
        sound_cells(apart)


def with_section_aside(net: CurveNet, name: str, way: float) -> CurveNet:
    """The net with a section that bulges out between its ends."""
    curve = named(net, name)
    rows = np.arange(net.batch.start[curve] + 1, net.batch.start[curve + 1] - 1)
    xyz = net.batch.xyz.copy()
    xyz[rows, 1] += way
    return attrs.evolve(net, batch=attrs.evolve(net.batch, xyz=xyz))


def test_borders_of_flats_that_fit_nothing_are_left_out(series60_70: ah.Hull) -> None:
    """A border 1 m below the lines is named, and the cells are those without it."""
    net = gather_net(series60_70.state)
    flat = named(net, "flat of side")
    rows = np.arange(net.batch.start[flat], net.batch.start[flat + 1])
    xyz = net.batch.xyz.copy()
    xyz[rows, 1:] += [-0.6, -1.0]
    astray = attrs.evolve(net, batch=attrs.evolve(net.batch, xyz=xyz))
    gone = (net.meets == flat).any(axis=1) & (np.arange(len(net.meets)) % 3 == 0)
    found = sound_cells(without_rows(astray, gone))
    assert found.notes == ("left out, as they do not fit the lines: flat of bottom, flat of side",)
    assert found.count == find_cells(net_graph(net, leave_out=net.flat)).count


def shortened(net: CurveNet) -> CurveNet:
    """The net with a waterline that ends 5 cm outside the profile."""
    curve = named(net, "WL 2.5")
    xyz = net.batch.xyz.copy()
    xyz[[net.batch.start[curve], net.batch.start[curve + 1] - 1], 1] = 0.05
    return attrs.evolve(net, batch=attrs.evolve(net.batch, xyz=xyz))


@pytest.mark.parametrize(
    ("change", "told"),
    [
        pytest.param(
            lambda net: (net, np.array(net.name) == "deck edge"),
            "lines end on no other line: profile at (0.000, 0.000, 9.375) m",
            id="no deck edge",
        ),
        pytest.param(
            lambda net: (net, np.array(net.family) != "sections"),
            "they cross nowhere, or enclose nothing",
            id="sections alone",
        ),
        pytest.param(
            lambda net: (joined(net, moved(net, 500.0)), None),
            "they fall into 2 parts that do not meet: deck edge, ",
            id="two nets that do not meet",
        ),
        pytest.param(
            lambda net: (attrs.evolve(net, end=net.end | (np.array(net.name) == "ST 7")), None),
            "more than one outer face; lines at which the hull ends lie within it: ST 7",
            id="an end within the hull",
        ),
    ],
)
def test_lines_that_enclose_no_half_hull_are_refused(
    wigley: CurveNet, change: Callable[[CurveNet], tuple[CurveNet, np.ndarray | None]], told: str
) -> None:
    """With the lines at fault, and what to do."""
    assert told in refused(*change(wigley))


def test_the_corner_of_a_raked_keel_is_no_tangent_plane() -> None:
    """Seen along the normal of the flat keel, the sides lie wrong: they leave 3 degrees off it."""
    length, deck, rake = 20.0, 3.0, 0.05
    x = np.linspace(0.0, length, 9)
    siding = 0.6 * np.sin(np.pi * x / length) ** 0.5
    siding[[0, -1]] = 0.0
    keel = np.column_stack([x, siding, rake * x])
    # In turns a little in and out, as lines of a mesh are.
    top = np.column_stack([x, siding * (1.0 + 0.03 * np.cos(np.pi * np.arange(9))), 0.0 * x + deck])
    ends = np.array([[0, 0, deck], [0, 0, 0], [length, 0, rake * length], [length, 0, deck]], float)
    sharp = [PointKind.SMOOTH, PointKind.KNUCKLE, PointKind.KNUCKLE, PointKind.SMOOTH]
    sources = [
        LineSource.make("boundary", "profile", ends, plane=((0, 1, 0), 0.0), kind=sharp,
                        boundary=BoundaryKind.END),
        LineSource.make("boundary", "deck edge", top, plane=((0, 0, 1), deck),
                        boundary=BoundaryKind.END),
        LineSource.make("boundary", "rabbet", keel, boundary=BoundaryKind.KNUCKLE),
    ]  # fmt: skip
    sources += [
        LineSource.make("sections", f"ST {i}", np.array([keel[i] * [1, 0, 1], keel[i], top[i]]),
                        kind=[PointKind.SMOOTH, PointKind.KNUCKLE, PointKind.SMOOTH])
        for i in range(1, 8)
    ]  # fmt: skip
    links = [Association("boundary", "boundary"), Association("boundary", "sections")]
    net = gather_net(adopt(sources, Particulars("box", length, 1.3, deck, 2.0), links)[0])
    found = sound_cells(net)
    # Between two sections: the flat keel and the side.
    assert found.count == 16
    assert not found.notes
