"""Polylines of components: their direction, their points, spots and borders."""

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.bezier_patches import Patches
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.surface.regions.level_lines import LevelLine, edge_polyline
from tests.curved_patches import graph_plates, patch


def components(net: FloatArray) -> tuple[LevelLine, ...]:
    """The lines K = 0 of a patch."""
    return ah.surface.curvature_regions(net, zero="exact", delta=1e-14).components


def enclosed(line: FloatArray) -> float:
    """The area that a closed polyline walks round, positive counter-clockwise."""
    (u, v), (s, t) = line[:-1].T, line[1:].T
    return float((u * t - s * v).sum() / 2.0)


@pytest.mark.parametrize(
    ("net", "turn"),
    [
        pytest.param(patch("P03_circle_loop"), 1.0, id="convex within"),
        pytest.param(patch("P03_circle_loop").swapaxes(0, 1), 1.0, id="parameters exchanged"),
        pytest.param(patch("P03_circle_loop")[::-1], 1.0, id="one parameter turned"),
        pytest.param(patch("P08_wavy_plate"), 1.0, id="plate"),
    ],
)
def test_lines_have_the_greater_curvature_on_their_left(net: FloatArray, turn: float) -> None:
    """In the plane of the parameters; so a loop round a convex part runs counter-clockwise."""
    (loop,) = components(net)
    assert np.sign(enclosed(loop.uv[0])) == turn


def test_a_loop_is_walked_once_and_each_point_once() -> None:
    """Points that two arcs share stand once, but for the first, which is the last of a loop."""
    (loop,) = components(patch("P03_circle_loop"))
    (uv,), (xyz,) = loop.uv, loop.xyz
    assert np.array_equal(uv[0], uv[-1])
    assert np.linalg.norm(np.diff(xyz, axis=0), axis=1).min() > 1e-6
    assert np.linalg.norm(np.diff(xyz, axis=0), axis=1).max() < 0.2
    assert loop.length == pytest.approx(np.pi, rel=0.2)
    assert loop.ends == 0


def test_places_agree_in_parameters_and_in_space() -> None:
    """The point of the surface at the parameters is the point in space, over knots as well."""
    draw = np.random.default_rng(5).standard_normal((6, 5, 1))
    place = np.moveaxis(np.mgrid[0:6, 0:5], 0, -1) * [1.0, 0.6]
    net = np.concatenate([place, 0.2 * draw], axis=-1)
    knots = np.array([2.0] * 4 + [3, 3.5] + [5] * 4), np.array([-1.0] * 4 + [0] + [1] * 4)
    surface = SplineSurface("spline", (3, 3), *knots, net)
    result = ah.surface.curvature_regions(surface, zero="exact")
    assert max(len(piece.patches) for piece in result.components) > 1
    for piece in result.components:
        for uv, xyz in zip(piece.uv, piece.xyz, strict=True):
            assert surface.at(*uv.T) == pytest.approx(xyz, abs=1e-13)


def test_an_isolated_spot_is_one_point() -> None:
    """The monkey saddle has K = 0 in its middle alone."""
    (spot,) = components(patch("P02_monkey"))
    assert (spot.kind, spot.ends, spot.length) == ("isolated", 0, 0.0)
    assert spot.xyz[0] == pytest.approx(np.zeros((1, 3)), abs=1e-4)


def test_a_junction_tells_how_many_lines_meet() -> None:
    """Two lines that cross are four that end in one spot."""
    (cross,) = components(patch("P05_cross"))
    assert (cross.kind, cross.ends, len(cross.xyz)) == ("junction", 4, 4)


@pytest.mark.parametrize("side", range(4))
def test_borders_are_drawn_within_the_tolerance(side: int) -> None:
    """From corner to corner of the side, no chord farther from it than was asked for."""
    net = graph_plates(1, 4)
    patches = Patches.single(net[0])
    uv, xyz = edge_polyline(patches, 0, side, 1e-3)
    fine = edge_polyline(patches, 0, side, 1e-7)[1]
    axis, value = divmod(side, 2)
    assert set(uv[:, axis]) == {float(value)}
    assert uv[[0, -1], 1 - axis].tolist() == [0.0, 1.0]
    corners = net[0].take(-value, axis)[[0, -1]]
    assert xyz[[0, -1]] == pytest.approx(corners, abs=1e-15)
    low, step = xyz[:-1], np.diff(xyz, axis=0)
    along = np.clip(((fine[:, None] - low) * step).sum(-1) / (step**2).sum(-1), 0.0, 1.0)
    off = np.linalg.norm(fine[:, None] - low - along[..., None] * step, axis=-1).min(axis=1)
    assert off.max() <= 1e-3


def test_components_stand_in_the_order_of_levels_and_surfaces() -> None:
    """Whatever their degrees; and patches are counted through all surfaces."""
    cubic = patch("P08_wavy_plate")
    raised = graph_plates(2, 4)
    nets = [cubic, raised[0][:, :3], raised[1], raised[1][:, :3]]
    result = ah.surface.curvature_regions([SplineSurface.bezier(net) for net in nets])
    assert len(result.parts) == 2
    order = [(-piece.level, piece.surface) for piece in result.components]
    assert order == sorted(order)
    assert {level for level, _ in order} == {-result.k0, result.k0}
    assert {surface for _, surface in order} == {0, 1, 2, 3}
    assert all(piece.patches == (piece.surface,) for piece in result.components)
