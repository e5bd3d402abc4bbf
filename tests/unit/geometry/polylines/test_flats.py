"""Flats from straight runs, and borders from single places."""

import numpy as np
import pytest

from assoc_hull.geometry.polylines.borders import border_bends, fit_border, order_places
from assoc_hull.geometry.polylines.flats import fit_plane, join_straight_runs


def test_runs_in_one_plane_make_a_flat() -> None:
    """Runs of five lines at y = 16 are one flat; those of a cylinder beside it are none."""
    x = np.repeat(np.arange(5.0) * 6.0, 2)
    y = np.tile([16.0, 3.0], 5) + np.where(np.arange(10) % 2, 0.02 * x * x, 0.0)
    begin, end = np.column_stack([x, y, x * 0 + 2.0]), np.column_stack([x, y, x * 0 + 9.0])
    [flat] = join_straight_runs(np.repeat(np.arange(5), 2), begin, end, 1e-3)
    assert flat.runs == (0, 2, 4, 6, 8)
    assert (flat.normal.tolist(), flat.offset) == ([0.0, 1.0, 0.0], 16.0)


def test_a_rise_of_floor_is_a_flat_too() -> None:
    """Bottoms that rise by 3 degrees lie in one plane, which leans."""
    x, rise = np.arange(4.0) * 5.0, np.tan(np.deg2rad(3.0))
    keel, bilge = np.column_stack([x, 0 * x, 0 * x]), np.column_stack([x, 8 + x, rise * (8 + x)])
    [flat] = join_straight_runs(np.arange(4), keel, bilge, 1e-3)
    assert len(flat.runs) == 4
    assert np.degrees(np.arccos(flat.normal[2])) == pytest.approx(3.0, abs=1e-6)


def wall(count: int) -> tuple[np.ndarray, np.ndarray]:
    """Ends of upright lines of a wall that curves along the ship, radius 150 m, 2 m apart."""
    x = 2.0 * np.arange(count)
    y = 8.0 - 0.2 * x - x * x / 300.0
    return np.column_stack([x, y, x * 0 + 2.0]), np.column_stack([x, y, x * 0 + 9.0])


def test_three_lines_of_a_curved_wall_are_no_flat() -> None:
    """They lie in one plane within 10 mm, but the lines beside them bend off it."""
    begin, end = wall(5)
    middle = 0.5 * (begin + end)
    beyond = np.stack([middle[:3], middle[2:]], axis=1)
    [flat] = join_straight_runs(np.arange(3), begin[1:4], end[1:4], 1e-2)
    assert flat.runs == (0, 1, 2)
    assert join_straight_runs(np.arange(3), begin[1:4], end[1:4], 1e-2, beyond=beyond) == []


def test_a_flat_beside_which_no_line_is_stays() -> None:
    """Three lines from end to end of a ruled side: nothing speaks against them."""
    begin, end = wall(3)
    [flat] = join_straight_runs(
        np.arange(3), begin, end, 1e-2, beyond=np.full((3, 2, 3), np.nan)
    )  # fmt: skip
    assert flat.runs == (0, 1, 2)


def test_runs_are_joined_by_the_scatter_of_their_own_lines() -> None:
    """A line known within a decimetre only does not make a flat of others that bend by less."""
    begin, end = wall(9)
    within = np.full(9, 1e-3)
    assert join_straight_runs(np.arange(9), begin, end, within) == []
    within[-1] = 0.1
    found = join_straight_runs(np.arange(9), begin, end, within)
    assert all(8 in flat.runs for flat in found)


@pytest.mark.parametrize("lines", [[0, 1], [0, 1, 3]], ids=["two lines", "a line between without"])
def test_fewer_than_three_neighbours_make_no_flat(lines: list[int]) -> None:
    """Runs of two lines, or of three that are not neighbours, are no flat."""
    x = 6.0 * np.array(lines)
    begin, end = np.column_stack([x, 0 * x, 0 * x]), np.column_stack([x, 0 * x, 0 * x + 5.0])
    assert join_straight_runs(np.array(lines), begin, end, 1e-3) == []


def test_a_plane_across_an_axis_is_taken_where_it_fits() -> None:
    """Scatter within the tolerance does not tilt a plane."""
    draw = np.random.default_rng(2)
    points = np.column_stack([draw.uniform(0, 50, 40), draw.normal(25, 1e-3, 40), np.arange(40.0)])
    normal, offset, off = fit_plane(points, 5e-3)
    assert normal.tolist() == [0.0, 1.0, 0.0]
    assert abs(offset - 25.0) < 1e-3
    assert off < 5e-3


def border() -> np.ndarray:
    """A border like that of a flat of side: down, along and up again, in its plane."""
    t = np.linspace(-1.0, 1.0, 41)
    return np.column_stack([100.0 * t, 20.0 * t**4])


def test_places_are_put_in_order() -> None:
    """Places handed in at random are put in order from three that are known."""
    places = border()
    number = np.random.default_rng(4).permutation(41)
    back = np.argsort(number)
    path = order_places(places[number], np.full(41, 0.01), back[[19, 20, 21]].tolist())
    assert number[path].tolist() == list(range(41))


def test_a_border_is_smooth_within_the_doubt_of_its_places() -> None:
    """Places that scatter by 0.2 m give a curve nearer to the truth than they are."""
    truth = border()
    noisy = truth + np.random.default_rng(5).normal(0.0, 0.2, truth.shape) * [0.0, 1.0]
    noisy[[0, -1]] = truth[[0, -1]]
    drawn = fit_border(noisy, np.full(41, 0.4))
    before = np.abs(noisy[:, 1] - truth[:, 1])
    after = np.abs(drawn[:, 1] - 20.0 * (drawn[:, 0] / 100.0) ** 4)
    assert after.mean() < 0.85 * before.mean()
    assert np.linalg.norm(drawn - noisy, axis=1).max() <= 0.8


def test_a_border_is_not_bent_by_a_place_that_is_less_sure_than_it_says() -> None:
    """One of 41 lies five times its doubt off: the others count, and it is passed by."""
    truth = border()
    places = truth + np.random.default_rng(6).normal(0.0, 0.01, truth.shape) * [0.0, 1.0]
    places[20, 1] += 0.2
    drawn = fit_border(places, np.full(41, 0.04))
    off = np.abs(drawn[:, 1] - 20.0 * (drawn[:, 0] / 100.0) ** 4)
    assert off.max() <= 0.04


def test_places_too_near_for_a_net_count_as_one() -> None:
    """Two that contradict one another, 0.1 m apart, make no wave of a straight border."""
    x = np.array([0.0, 2.0, 4.0, 6.0, 6.1, 8.0, 10.0, 12.0])
    places = np.column_stack([x, 0.5 * x])
    places[3, 1] -= 0.03
    places[4, 1] += 0.03
    doubt = np.full(8, 0.02)
    apart, alone = (fit_border(places, doubt, apart=size) for size in (0.2, 0.0))
    off = [np.abs(each[:, 1] - 0.5 * each[:, 0]).max() for each in (apart, alone)]
    assert off[0] <= 5e-3 < off[1]


def test_a_border_turns_where_it_surely_does() -> None:
    """A corner is kept, a turn that the doubt of its places explains is none."""
    places = np.array([[0.0, 9.0], [0.0, 6.0], [0.0, 3.0], [4.0, 3.0], [8.0, 3.0]])
    assert border_bends(places, np.full(5, 0.01), 40.0) == [2]
    assert border_bends(places, np.full(5, 1.0), 40.0) == []
    drawn = fit_border(places, np.full(5, 0.01), [2])
    assert np.abs(drawn - places).max() < 0.01


def test_a_vague_last_place_makes_no_hook() -> None:
    """It may lie 1.5 m off; the border goes straight on up there, and turns where it surely does.

    The marks are those of the flat of side of a container ship at her bow.
    """
    places = np.array(
        [[259.0, 22.95], [271.7, 24.65], [283.2, 26.35], [290.12, 28.05], [290.49, 29.75],
         [290.53, 31.45], [289.15, 33.15]]
    )  # fmt: skip
    doubt = np.array([0.06, 0.3, 0.36, 0.01, 0.72, 0.03, 1.48])
    corners = border_bends(places, doubt, 40.0)
    assert corners == [3]
    drawn = fit_border(places, doubt, corners)
    np.testing.assert_array_equal(drawn[3], places[3])
    assert np.ptp(drawn[3:, 0]) < 0.7
    assert (np.sqrt(((drawn - places) ** 2).sum(axis=1)) <= doubt + 1e-9)[[0, 3, 6]].all()
    sure = fit_border(places, np.full(7, 0.01), corners)
    np.testing.assert_array_equal(sure[-1], places[-1])
