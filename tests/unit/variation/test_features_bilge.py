"""Bilge arcs with rise of floor, flats, and straight runs."""

from __future__ import annotations

import numpy as np
import pytest

from assoc_hull.errors import BadInputError
from assoc_hull.variation.features_bilge import bilge, on_chord, onto_plane


@pytest.mark.parametrize(
    ("beta", "z", "floor"),
    [
        (2.0, "3.1557515273", ["22.6837587921", "0.7572135425"]),
        (5.0, "4.2989227423", ["22.8091737826", "1.9080554668"]),
        (0.0, "2.4000000000", ["22.6000000000", "0.0000000000"]),
    ],
)
def test_centre_and_tangent_points_by_rise_of_floor(beta: float, z: str, floor: list[str]) -> None:
    """B/2 = 25 m, keel half-width 1 m, radius 2.4 m: the digits of the derivation."""
    arc = bilge(25.0, 2.4, deadrise_deg=beta, keel=1.0)
    assert f"{arc.z:.10f}" == z
    assert [f"{each:.10f}" for each in arc.floor] == floor
    assert arc.side.tolist() == [25.0, arc.z]


@pytest.mark.parametrize("beta", [0.0, 2.0, 5.0])
def test_the_arc_is_tangent_to_floor_and_side(beta: float) -> None:
    """And round in between: its places lie at the radius, its ends are the tangent points."""
    arc = bilge(25.0, 2.4, deadrise_deg=beta, keel=1.0)
    places = arc.at(np.linspace(0.0, 1.0, 9))
    assert places[0].tolist() == arc.floor.tolist()
    assert places[-1].tolist() == arc.side.tolist()
    assert np.abs(np.hypot(places[:, 0] - arc.y, places[:, 1] - arc.z) - 2.4).max() < 1e-14
    slope = np.tan(np.radians(beta))
    assert arc.floor[1] == pytest.approx(slope * (arc.floor[0] - 1.0), abs=1e-14)
    radius = (arc.floor - [arc.y, arc.z]) / 2.4
    assert abs(radius @ [np.cos(np.radians(beta)), np.sin(np.radians(beta))]) < 1e-14


def test_a_radius_that_leaves_no_bottom_is_refused() -> None:
    """The keel's half-width is named."""
    words = r"bilge: radius 9\.0 m leaves no bottom \(keel half-width 17\.0\)"
    with pytest.raises(BadInputError, match=words):
        bilge(25.0, 9.0, keel=17.0)


@pytest.mark.parametrize("beta", [-1.0, 90.0, np.nan])
def test_a_floor_that_is_none_is_refused(beta: float) -> None:
    """Below level, upright, or no number."""
    with pytest.raises(BadInputError):
        bilge(25.0, 2.4, deadrise_deg=beta)


def test_points_of_a_flat_get_its_coordinate_to_the_bit() -> None:
    """By assignment; on an oblique flat by the shortest way."""
    rough = np.array([[3.0, 25.0 + 3e-16, 9.0], [4.0, 24.999999999999996, 8.0]])
    assert onto_plane(rough, [0.0, 1.0, 0.0], 25.0)[:, 1].tolist() == [25.0, 25.0]
    normal = np.array([0.0, 0.6, 0.8])
    assert np.abs(onto_plane(rough, normal, 5.0) @ normal - 5.0).max() < 1e-14


def test_a_straight_run_keeps_its_length_fractions() -> None:
    """On the new chord; a coordinate the ends share is theirs to the bit."""
    old = np.array([[0.0, 25.0, 2.4], [3.0, 25.0, 2.4], [10.0, 25.0, 2.4]])
    new = on_chord(old, [0.0, 25.1, 2.7], [20.0, 25.1, 2.7])
    assert new.tolist() == [[0.0, 25.1, 2.7], [6.0, 25.1, 2.7], [20.0, 25.1, 2.7]]
    with pytest.raises(BadInputError, match="ends are one place"):
        on_chord(old[[0, 0]], [0.0, 0.0, 0.0], [1.0, 0.0, 0.0])
