"""Corners of digitised lines: found where they were planted, and nowhere else."""

import numpy as np
import pytest

from assoc_hull.geometry.polylines.corners import CornerRule, find_corners, join_corners
from assoc_hull.geometry.polylines.noise import facet_depth, point_scatter
from tests.unit.geometry.planted import NOISE, Planted

SEEDS = 200


def test_a_planted_knuckle_line_is_found() -> None:
    """12 degrees at 1 mm noise over three lines, 200 seeds: within 50 mm and 0.5 degree."""
    curves = [Planted(8.0, lambda s: 0.04 + 0 * s, ((4.1 + 0.2 * i, 12.0),)) for i in range(3)]
    truth = np.array([curve.at(4.1 + 0.2 * i) for i, curve in enumerate(curves)])
    off, turn, doubt = [], [], []
    for seed in range(SEEDS):
        drawn = [curve.digitised(3 * seed + i) for i, curve in enumerate(curves)]
        corners = [find_corners(points, point_scatter(points)) for points in drawn]
        [chain] = join_corners(np.array([0.0, 5.0, 10.0]), corners)
        mine = [corners[i][j] for i, j in chain]
        places = np.array([each.place for each in mine])
        off.append(np.linalg.norm(places - truth, axis=1))
        turn.append(abs(np.mean([each.turn_deg for each in mine]) - 12.0))
        doubt.append([each.uncertainty for each in mine])
    away = np.array(off)
    print(
        f"\nknuckle line of 12 degrees, {SEEDS} seeds: place p95 "
        f"{1e3 * np.percentile(away, 95):.1f}, max {1e3 * away.max():.1f} mm (stated: one sigma "
        f"{1e3 * np.mean(doubt):.1f} mm); turn p95 {np.percentile(turn, 95):.2f}, max "
        f"{max(turn):.2f} degree"
    )
    assert away.max() < 0.05
    assert max(turn) < 0.5
    # What is stated is what is.
    assert np.mean(doubt) == pytest.approx(np.sqrt((away * away).mean()), rel=0.3)


@pytest.mark.parametrize(
    "curve",
    [
        pytest.param(Planted(12.0, lambda s: 0.02 + 0.1 * np.sin(s / 5.0) ** 2), id="ellipse-like"),
        pytest.param(Planted(12.0, lambda s: np.where(abs(s - 6.0) < 2.3, 1 / 3.0, 0.0)),
                     id="bilge of 3 m"),
        pytest.param(Planted(12.0, lambda s: np.where(abs(s - 6.0) < 0.8, 1.0, 0.0)),
                     id="bilge of 1 m"),
    ],
)  # fmt: skip
def test_a_bend_is_no_corner(curve: Planted) -> None:
    """Smooth bends at 1 mm noise, 200 seeds: no corner is found."""
    for seed in range(SEEDS):
        points = curve.digitised(seed, 0.15)
        assert find_corners(points, point_scatter(points)) == []


def test_facets_of_a_bend_are_no_corners() -> None:
    """A circle of 3 m in facets of 0.5 m, 9.5 degrees each, has no corner."""
    angle = np.arange(0.0, 3.0, 0.5 / 3.0)
    facets = 3.0 * np.column_stack([np.cos(angle), np.sin(angle)])
    assert find_corners(facets, facet_depth(facets) / 2.0) == []


def test_a_corner_beside_one_long_step_is_found() -> None:
    """A stern frame of many points that meets a keel of two: the corner is the point itself."""
    post = np.column_stack([np.linspace(3.0, 3.7, 9), np.linspace(3.3, 0.0, 9)])
    points = np.concatenate([post, [[40.0, 0.0], [41.0, 0.0]]])
    [corner] = find_corners(points, 1e-5)
    assert corner.place.tolist() == [3.7, 0.0]
    assert corner.turn_deg == pytest.approx(np.degrees(np.arctan2(3.3, 0.7)))


def test_a_corner_near_an_end_with_dense_points_on_one_side_is_found() -> None:
    """A waterline turns by 60 degrees across a flat bottom: dense there, wide apart along the side.

    Some scales see one side of the corner only, and speak neither for nor against it.
    """
    way = np.deg2rad(150.0)
    side = np.arange(0.0, 60.0, 1.3)[::-1, None] * [np.cos(way), np.sin(way)]
    bottom = np.column_stack([np.zeros(12), -np.linspace(0.25, 3.0, 12)])
    [corner] = find_corners(np.concatenate([side, bottom]), 5e-4)
    assert corner.place.tolist() == [0.0, 0.0]
    assert corner.turn_deg == pytest.approx(60.0)


def test_a_chine_between_facets_is_the_point_itself() -> None:
    """A section that turns by 22 degrees at one point, its facets by .2: no side is fitted.

    Points lie wide apart above and in pairs below, as a plane cuts two triangles a cell.
    """
    turn = np.deg2rad([*[33.0, 33.2] * 5, *np.arange(55.2, 56.3, 0.2)])
    step = np.array([*[0.9, 0.12] * 5, 0.25, 1.2, 1.3, 0.1, 1.2, 1.3])
    move = step[:, None] * np.column_stack([np.cos(turn), np.sin(turn)])
    points = np.concatenate([[[0.0, 0.0]], np.cumsum(move, axis=0)])
    [corner] = find_corners(points, 1e-3)
    assert corner.place.tolist() == points[10].tolist()
    assert corner.turn_deg == pytest.approx(22.0)
    assert 0.0 < corner.uncertainty <= 1e-3


@pytest.mark.parametrize("count", [3, 4, 6])
def test_a_bilge_of_few_points_between_long_steps_has_no_corner(count: int) -> None:
    """Each of its points turns, none by most of it: bottom and side are drawn by their ends."""
    angle = np.linspace(0.0, 0.5 * np.pi, count)
    bilge = np.column_stack([8.0 + 2.0 * np.sin(angle), 2.0 - 2.0 * np.cos(angle)])
    points = np.concatenate([[[0.0, 0.0]], bilge, [[10.0, 20.0]]])
    assert find_corners(points, 1e-5) == []


def test_the_least_turn_is_settable() -> None:
    """A corner of 6 degrees is seen by default, and not by a rule that asks for 10."""
    points = Planted(8.0, lambda s: 0.0 * s, ((4.0, 6.0),)).digitised(1, 0.05)
    assert len(find_corners(points, NOISE)) == 1
    assert find_corners(points, NOISE, CornerRule(least_deg=10.0)) == []


def test_scatter_is_estimated() -> None:
    """The scatter of noisy points on a bend is found within a tenth, in the mean of seeds."""
    curve = Planted(12.0, lambda s: 0.2 + 0 * s)
    found = [point_scatter(curve.digitised(seed)) for seed in range(50)]
    assert np.mean(found) == pytest.approx(NOISE, rel=0.1)


def test_corners_that_do_not_line_up_are_not_joined() -> None:
    """Corners a metre apart to and fro on lines 0.5 m apart make no knuckle line."""
    lines = []
    for i in range(5):
        curve = Planted(8.0, lambda s: 0.0 * s, ((3.0 + 2.0 * (i % 2), 12.0),))
        lines.append(find_corners(curve.digitised(i), NOISE))
    assert [len(each) for each in lines] == [1] * 5
    assert join_corners(0.5 * np.arange(5.0), lines) == []


def test_both_feet_of_plumb_ends_on_one_chord_of_keel_are_corners() -> None:
    """Four points draw the profile of a hull between plumb ends: each turns by a right angle."""
    points = np.array([[0.0, 9.0], [0.0, 0.0], [100.0, 0.0], [100.0, 9.0]])
    found = find_corners(points, 0.0)
    assert [corner.place.tolist() for corner in found] == [[0.0, 0.0], [100.0, 0.0]]
