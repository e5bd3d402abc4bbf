"""Regions, corners, bends and slopes: what a layout is made of."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from assoc_hull.analysis.net.curve_net import gather_net
from assoc_hull.errors import BadInputError
from assoc_hull.hull import Hull
from assoc_hull.surface.blocks.block_layout import slopes_along
from assoc_hull.surface.blocks.block_plan import block_plans, four_corners
from assoc_hull.surface.blocks.cell_regions import (
    BorderCourse,
    CellRegion,
    border_course,
    border_turns,
    find_inward_bends,
)
from assoc_hull.surface.cells.net_faces import NetCells, find_cells
from assoc_hull.surface.cells.net_graph import net_graph
from tests.nets import wigley_net


@pytest.fixture(scope="module")
def small() -> NetCells:
    """The cells of a Wigley hull of few lines."""
    return find_cells(net_graph(gather_net(wigley_net(7, 4))))


def test_a_chord_parts_a_disc_in_two_discs(small: NetCells) -> None:
    """Each section runs from border to border; its left half-edges lie on one side of it."""
    whole = CellRegion.whole(small)
    sections = [i for i, name in enumerate(small.graph.net.family) if name == "sections"]
    for curve in sections:
        (chord,) = whole.chords(curve)
        parts = whole.parted([chord.half])
        assert [part.is_disc for part in parts] == [True, True]
        assert sum(int(part.inside.sum()) for part in parts) == small.count
        left = whole.with_half([chord.half], int(chord.half[0]))
        right = whole.with_half([chord.half], int(chord.half[0]) ^ 1)
        assert left is not None
        assert right is not None
        assert not (left.inside & right.inside).any()
        assert left.left[chord.half].all()
        back = chord.reversed()
        assert (back.first, back.last) == (chord.last, chord.first)


def test_the_outline_goes_round_with_the_hull_to_its_left(small: NetCells) -> None:
    """The deck forward, the keel aft: in the side view a way clockwise."""
    found = border_course(CellRegion.whole(small))
    x, _, z = found.place.T
    assert 0.5 * (x[:-1] * z[1:] - x[1:] * z[:-1]).sum() < 0.0
    np.testing.assert_allclose(found.at(np.array([0.0])), found.at(np.array([found.length])))


def test_a_region_with_a_hole_is_no_disc(small: NetCells) -> None:
    """It has two loops, of which the longer one goes round it."""
    whole = CellRegion.whole(small)
    inner = np.flatnonzero([not whole.on_loop[small.nodes(c)].any() for c in range(small.count)])
    holed = whole.inside.copy()
    holed[inner[0]] = False
    found = CellRegion(small, holed)
    assert len(found.loops) == 2
    assert not found.is_disc
    assert np.array_equal(np.sort(found.loop), np.sort(whole.loop))


def test_cells_that_are_no_disc_are_refused(
    small: NetCells, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The error says so, and by how many loops."""
    whole = CellRegion.whole(small)
    inner = np.flatnonzero([not whole.on_loop[small.nodes(c)].any() for c in range(small.count)])
    holed = whole.inside.copy()
    holed[inner[0]] = False
    monkeypatch.setattr(CellRegion, "whole", classmethod(lambda cls, given: cls(given, holed)))
    with pytest.raises(BadInputError, match=r"the half hull is no disc: its border has 2 loops"):
        block_plans(small, 100.0)


def test_bends_into_the_ship_are_found_and_no_others(
    small: NetCells, series60_70: Hull, bulk_carrier: Hull
) -> None:
    """None on a wall-sided hull; the top of a stern post; an aperture, and a stem above a bulb."""
    assert find_inward_bends(border_course(CellRegion.whole(small)), 100.0) == ()
    (post,) = bends_of(series60_70)
    assert post.turn > 70.0
    np.testing.assert_allclose(post.place, [0.0, 0.0, 6.0], atol=0.7)
    aperture, stem, boss = bends_of(bulk_carrier)
    assert aperture.turn > 100.0 > 60.0 > stem.turn > boss.turn > 40.0
    np.testing.assert_allclose(aperture.place, [8.8, 0.0, 7.3], atol=0.6)
    np.testing.assert_allclose(stem.place, [299.8, 0.0, 16.4], atol=0.5)


def test_a_border_turns_only_where_it_turns_inward() -> None:
    """Round an L, five corners of 90 degrees; at the hollow one nil, if normals are given."""
    corner = np.array([[0, 0, 0], [2, 0, 0], [2, 1, 0], [1, 1, 0], [1, 2, 0], [0, 2, 0], [0, 0, 0]])
    place = np.array(corner, np.float64)
    start = np.append(0.0, np.cumsum(np.abs(np.diff(place, axis=0)).sum(axis=1)))
    found = BorderCourse(np.arange(6), start, start.copy(), place, np.zeros(7, np.bool_))
    up = np.tile([0.0, 0.0, 1.0], (6, 1))
    np.testing.assert_allclose(border_turns(found, start[:-1], 0.2), 90.0)
    inward = border_turns(found, start[:-1], 0.2, up)
    np.testing.assert_allclose(inward, [90.0, 90.0, 90.0, 0.0, 90.0, 90.0], atol=1e-9)


def test_corners_that_must_be_are_and_those_that_must_not_are_not(small: NetCells) -> None:
    """A node on a straight side can be asked for; a sharp one can be ruled out."""
    whole = CellRegion.whole(small)
    nodes = whole.begin(whole.loop)
    place = small.graph.place[nodes]
    sharp, _ = four_corners(whole, 100.0, ())
    np.testing.assert_allclose(np.ptp(small.graph.place[list(sharp)], axis=0), [100.0, 0.0, 9.375])
    deck = int(nodes[np.abs(place - [50.0, place[:, 1].max(), 9.375]).max(axis=1).argmin()])
    asked, turn = four_corners(whole, 100.0, [deck])
    assert deck in asked
    assert len(turn) == 4
    without, _ = four_corners(whole, 100.0, (), (), [sharp[0]])
    assert sharp[0] not in without


def bends_of(hull: Hull) -> tuple:  # type: ignore[type-arg]
    """Bends of the profile of a hull, from 35 degrees on."""
    whole = CellRegion.whole(find_cells(net_graph(gather_net(hull.state))))
    return find_inward_bends(border_course(whole), hull.particulars.length, 35.0)


@given(st.lists(st.tuples(st.floats(0.1, 9.0), st.floats(0.0, 9.0)), min_size=2, max_size=8))
def test_parameters_between_nodes_never_overshoot(steps: list[tuple[float, float]]) -> None:
    """Rising parameters at nodes rise all the way between them; even ones run straight."""
    length, rise = np.array(steps).T
    value = np.append(0.0, np.cumsum(rise))
    count = len(length)
    edge = np.column_stack([np.arange(count), np.arange(count) + 1])
    begin = np.append(0.0, np.cumsum(length))[:-1]
    ends = np.stack([value[:-1], value[1:]], axis=1)[:, :, None]
    curve, free = np.zeros(count, np.int64), np.zeros(count, np.bool_)
    leave, arrive = slopes_along(curve, edge, begin, length, ends, free)
    p = np.linspace(0.0, 1.0, 21)[:, None]
    q = 1.0 - p
    da, db = leave[:, 0] * length, arrive[:, 0] * length
    found = value[:-1] + rise * p * p * (3.0 - 2.0 * p) + p * q * (q * da - p * db)
    assert (np.diff(found, axis=0) >= -1e-9).all()
    np.testing.assert_array_equal(arrive[:-1], leave[1:])
    even = (length * 0.5)[:, None]
    straight = np.stack([begin[:, None] * 0.5, begin[:, None] * 0.5 + even], axis=1)
    leave, arrive = slopes_along(curve, edge, begin, length, straight, free)
    np.testing.assert_allclose([leave, arrive], 0.5, rtol=1e-9)
