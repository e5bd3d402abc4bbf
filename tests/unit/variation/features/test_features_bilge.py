"""Bilge arcs with rise of floor: as they are drawn, and drawn anew after a map."""

from __future__ import annotations

import attrs
import numpy as np
import pytest

from assoc_hull import Hull
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.features.redrawn_bilges import BilgeArc, BilgeMap, bilge_map, fillet_bilge
from assoc_hull.variation.fields.bounded_functions import BlendChain
from assoc_hull.variation.fields.layers import DeadriseLayer
from assoc_hull.variation.fields.space_map import VariationMap
from assoc_hull.variation.parameters.compose_map import compose_map
from assoc_hull.variation.parameters.field_layout import Layout
from assoc_hull.variation.parameters.parent import Parent

RISE = np.tan(np.radians(2.0))
DEADRISE = DeadriseLayer(
    "deadrise", BlendChain.through([60, 115, 205, 265], [0, 1, 1, 0]), RISE, 1.0, 0.0,
    BlendChain.through([2.4, 14.4], [1, 0]),
)  # fmt: skip
TURNED = VariationMap((DEADRISE,))
"""Turns a level bottom about a keel plate of half-width 1 m by 2 degrees."""


def drawn(x: float) -> BilgeArc:
    """Draw the bilge of the section at x again."""
    new = fillet_bilge(25.0, 2.4, deadrise_deg=2.0, keel=1.0)
    old = fillet_bilge(25.0, 2.4, keel=1.0)
    return BilgeArc(f"{x:g}", f"arc {x:g}", x, old, new, (14.4, 14.4), TURNED, TURNED.jacobian)


BILGES = BilgeMap(TURNED, TURNED.jacobian, (drawn(120.0), drawn(150.0), drawn(180.0)))


def section(x: float, yz: FloatArray) -> FloatArray:
    """Give places (n, 3) of a section."""
    return np.column_stack([np.full(len(yz), x), yz])


def off_circle(xyz: FloatArray) -> float:
    """Give the farthest that places of a section lie off the new arc, m."""
    new = drawn(0.0).after
    return float(np.abs(np.hypot(xyz[:, 1] - new.y, xyz[:, 2] - new.z) - new.radius).max())


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
    arc = fillet_bilge(25.0, 2.4, deadrise_deg=beta, keel=1.0)
    assert f"{arc.z:.10f}" == z
    assert [f"{each:.10f}" for each in arc.floor] == floor
    assert arc.side.tolist() == [25.0, arc.z]


@pytest.mark.parametrize("beta", [-1.0, 0.0, 2.0, 5.0])
def test_the_arc_is_tangent_to_floor_and_side(beta: float) -> None:
    """And round in between: its places lie at the radius, its ends are the tangent points."""
    arc = fillet_bilge(25.0, 2.4, deadrise_deg=beta, keel=1.0)
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
        fillet_bilge(25.0, 9.0, keel=17.0)


@pytest.mark.parametrize("beta", [-90.0, 90.0, np.nan])
def test_a_floor_that_is_none_is_refused(beta: float) -> None:
    """Upright, or no number."""
    with pytest.raises(BadInputError):
        fillet_bilge(25.0, 2.4, deadrise_deg=beta)


@pytest.mark.parametrize("x", [120.0, 137.0, 150.0, 180.0])
def test_after_the_map_an_arc_lies_between_the_new_bottom_and_the_side(x: float) -> None:
    """On the sections that have one and between them; its ends are the tangent points."""
    old, new = drawn(x).before, drawn(x).after
    found = BILGES(section(x, old.at(np.linspace(0.0, 1.0, 17))))
    assert off_circle(TURNED(section(x, old.at(np.array([0.0, 0.5, 1.0]))))) > 0.03
    assert off_circle(found) < 1e-13
    assert np.abs(found[[0, -1], 1:] - [new.floor, new.side]).max() < 1e-14
    assert found[-1, 1] == 25.0


def test_bottom_and_side_stay_straight_beside_the_arc() -> None:
    """What moves on them moves along them: on the side, y keeps its bits."""
    along = np.linspace(0.0, 14.0, 15)
    floor = section(150.0, np.column_stack([22.6 - along, 0.0 * along]))
    found = BILGES(floor)
    assert np.abs(found[:, 2] - RISE * (found[:, 1] - 1.0)).max() < 1e-14
    side = BILGES(section(150.0, np.column_stack([25.0 + 0.0 * along, 2.4 + along])))
    assert (side[:, 1] == 25.0).all()
    assert (np.diff(side[:, 2]) > 0.5).all()


def test_places_on_the_drawn_curve_come_onto_the_arc() -> None:
    """A spline through points of an arc leaves it by up to 1e-4 radii; its image does not."""
    old = drawn(150.0).before
    angle = np.linspace(old.first, 0.0, 9)[1:-1]
    rough = [old.y, old.z] + (old.radius + 8e-5) * np.column_stack([np.cos(angle), np.sin(angle)])
    assert off_circle(BILGES(section(150.0, rough))) < 1e-13


def test_the_slopes_of_the_map_are_its_derivatives() -> None:
    """Against central differences, to port and starboard, and it folds nowhere."""
    rng = np.random.default_rng(11)
    low, high = np.array([107.0, 12.0, -1.0]), np.array([193.0, 26.0, 14.0])
    places = low + (high - low) * rng.random((400, 3))
    places[::2, 1] *= -1.0
    slope, step = BILGES.jacobian(places), 1e-6
    for axis in range(3):
        by = step * np.eye(3)[axis]
        found = (BILGES(places + by) - BILGES(places - by)) / (2.0 * step)
        # The slopes jump where arc, bottom and side meet; hardly a place is so near.
        assert np.quantile(np.abs(slope[:, :, axis] - found).max(axis=1), 0.98) < 1e-8
    assert np.linalg.det(slope).min() > 0.5


def test_beyond_the_arcs_the_map_keeps_its_bits() -> None:
    """Farther fore and aft, inboard and up than the correction fades."""
    far = np.array([[195.0, 25.0, 2.4], [150.0, 8.0, 0.0], [150.0, 25.0, 17.0], [150.0, 20.0, 4.0]])
    assert np.array_equal(BILGES(far), TURNED(far))
    assert np.array_equal(BILGES.jacobian(far), TURNED.jacobian(far))


@pytest.mark.parametrize(
    ("name", "value", "radius"),
    [
        ("deadrise_deg", 0.4, 2.4),
        ("bilge_radius", 3.0, 3.0),
        ("flat_of_bottom", 22.148, 2.852),
    ],
)
def test_the_bilges_of_a_varied_ship_are_arcs(
    bulk_carrier: Hull, name: str, value: float, radius: float
) -> None:
    """Measured on the net, known as features, and taken back by undo."""
    hull = bulk_carrier.vary(set={name: value}).hull
    found = hull.measure(only=["bilge_radius"]).anchors["bilge_radius"]
    assert found.value == pytest.approx(radius, abs=1e-9)
    assert found.how == "circle through the bilge amidships"
    for each in ("ST 8 arc", "ST 10 arc", "ST 12 arc"):
        assert hull.features[each].parameters["radius"] == pytest.approx(radius, abs=1e-9)
    assert ("flat of bottom" in hull.features) == (name != "deadrise_deg")
    assert not hull.check()
    assert not hull.verify()
    hull.undo()
    assert hull.fingerprint == bulk_carrier.fingerprint


def test_ratios_of_the_whole_hull_keep_the_exact_image(bulk_carrier: Hull) -> None:
    """No arc is drawn, though an oval is none: the block coefficient counts for more."""
    ship, state = Parent(300, 50, 27, 18, 27, {}), bulk_carrier.state
    for asked in ({"breadth": 51.0}, {"draught": 18.5}, {"length": 310.0, "breadth": 49.0}):
        assert bilge_map(state, compose_map(ship, asked, Layout())).arcs == ()


@pytest.mark.parametrize("q", [0.01, -0.01])
def test_a_turned_bottom_has_all_bilges_drawn_anew(bulk_carrier: Hull, q: float) -> None:
    """Rising or falling outward, with the radius they had."""
    turned = VariationMap((attrs.evolve(DEADRISE, q=q, keel=0.0),))
    arcs = bilge_map(bulk_carrier.state, turned).arcs
    assert [arc.x for arc in arcs] == [120.0, 150.0, 180.0]
    assert [arc.after.radius for arc in arcs] == [2.4, 2.4, 2.4]
    assert all((arc.after.floor[1] > 0.0) == (q > 0.0) for arc in arcs)
