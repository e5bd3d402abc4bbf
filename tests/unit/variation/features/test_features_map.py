"""A map that draws circles anew: exact on them, smooth beside them, unchanged beyond."""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.features.redrawn_circles import (
    FeatureMap,
    RedrawnCircle,
    SpaceCircle,
    changed_circles,
    distance_fade,
    redraw_circle,
)
from assoc_hull.variation.fields.anchor_fields import hat_field
from assoc_hull.variation.fields.bounded_functions import BlendChain
from assoc_hull.variation.fields.layers import FieldLayer
from assoc_hull.variation.fields.space_map import VariationMap

SHAFT = hat_field(
    "shaft",
    [("base", 0, 0), ("shaft-r", 4.275, 1), ("shaft+r", 5.725, 1), ("T", 18, 0)],
    BlendChain.through([6, 66], [1, 0]),
)
MAP = VariationMap((FieldLayer("local", (SHAFT,)),))
"""Raises the shaft by 1 m; the window of the hat leaves the end circle no circle."""


def drawn(x: float, radius: float | None) -> RedrawnCircle:
    """Draw the circle at x again."""
    circle = SpaceCircle.of([x, 0.0, 5.0], 0.725, [1.0, 0.0, 0.0])
    return redraw_circle(f"circle at {x:g}", circle, MAP, MAP.jacobian, radius=radius)


CIRCLES = (drawn(6.0, 0.75), drawn(6.75, 0.74), drawn(7.5, None))
FEATURES = FeatureMap(MAP, MAP.jacobian, CIRCLES)


def around(circle: SpaceCircle) -> tuple[FloatArray, FloatArray]:
    """Give places and tangents of half a circle, (n, 3)."""
    angle = np.linspace(-np.pi / 2.0, np.pi / 2.0, 25)
    unit = np.column_stack([0.0 * angle, np.cos(angle), np.sin(angle)])
    return circle.at(unit), np.column_stack([0.0 * angle, -np.sin(angle), np.cos(angle)])


def test_each_circle_comes_to_be_the_one_drawn_for_it() -> None:
    """Though they are nearer to one another than their joins reach: to rounding."""
    for each in CIRCLES:
        places, _ = around(each.before)
        assert np.abs(each.after.foot(FEATURES(places))[1]).max() < 1e-15


def test_the_tangents_are_those_of_the_new_circles() -> None:
    """So what is clamped to the circle stays clamped to it."""
    for each in CIRCLES:
        places, tangents = around(each.before)
        turned = np.einsum("nij,nj->ni", FEATURES.jacobian(places), tangents)
        turned /= np.sqrt((turned * turned).sum(axis=1))[:, None]
        assert np.abs(turned - tangents).max() < 1e-14


def test_the_jacobian_is_the_derivative() -> None:
    """Against central differences at 400 places about the circles, and it never folds there."""
    rng = np.random.default_rng(7)
    low, high = np.array([4.0, 0.05, 0.5]), np.array([12.0, 4.0, 10.0])
    places = rng.uniform(low, high, (400, 3))
    slope, step = FEATURES.jacobian(places), 1e-6
    for axis, unit in enumerate(np.eye(3)):
        found = (FEATURES(places + step * unit) - FEATURES(places - step * unit)) / (2.0 * step)
        assert np.abs(found - slope[:, :, axis]).max() < 1e-8
    assert np.linalg.det(slope).min() > 0.5


def test_between_circles_that_move_alike_the_hull_moves_with_them() -> None:
    """The shares of three add up: a cylinder between them stays straight within 0.01 mm."""
    up = hat_field(
        "shaft", [("base", 0, 0), ("shaft", 5, 0.6), ("T", 18, 0)], BlendChain.constant(1.0)
    )
    vmap = VariationMap((FieldLayer("local", (up,)),))
    circles = tuple(
        redraw_circle(each.name, each.before, vmap, vmap.jacobian, radius=0.75) for each in CIRCLES
    )
    x = np.linspace(6.0, 7.5, 31)
    side = np.column_stack([x, np.full(31, 0.725), np.full(31, 5.0)])
    assert np.abs(circles[0].correction(np.array([[0.0, 1.0, 0.0]]))).max() > 0.01
    found = FeatureMap(vmap, vmap.jacobian, circles)(side)
    assert np.abs(found - found[0] - (side - side[0])).max() < 1e-5


def test_beyond_the_join_places_keep_the_bits_of_the_map() -> None:
    """Six radii from all circles on, in values and slopes."""
    rng = np.random.default_rng(8)
    places = rng.uniform([0.0, 0.0, 0.0], [60.0, 20.0, 18.0], (500, 3))
    away = np.min([each.before.foot(places)[1] for each in CIRCLES], axis=0)
    far = places[away >= 6.0 * 0.725]
    assert len(far) > 300
    assert np.array_equal(FEATURES(far), MAP(far))
    assert np.array_equal(FEATURES.jacobian(far), MAP.jacobian(far))


def test_the_region_holds_every_place_that_a_feature_moves() -> None:
    """Boxes of the profile plane round each circle."""
    rng = np.random.default_rng(9)
    places = rng.uniform([0.0, 0.0, 0.0], [20.0, 6.0, 14.0], (2000, 3))
    moved = (FEATURES(places) != MAP(places)).any(axis=1)
    inside = np.zeros(len(places), bool)
    for each in FEATURES.regions():
        x, z = places[:, 0], places[:, 2]
        inside |= (each.x[0] <= x) & (x <= each.x[1]) & (each.z[0] <= z) & (z <= each.z[1])
    assert moved.any()
    assert not (moved & ~inside).any()


def test_a_fade_over_six_radii_adds_no_sign_change() -> None:
    """Of a correction of .054 r beside a circle on a convex section; over 1.5 radii it does."""
    assert _changes(6.0) == 0
    assert _changes(1.5) > 0


def _changes(reach: float) -> int:
    """Count the sign changes of a flat arc (radius 20 r) that a correction of .054 r fades on."""
    girth = np.linspace(0.0, 12.0, 4001)
    curve = np.column_stack([girth, -girth * girth / 40.0 + 0.054 * distance_fade(girth, reach)])
    first = np.gradient(curve, axis=0)
    second = np.gradient(first, axis=0)
    bend = (first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0])[3:-3]
    sign = np.sign(bend[np.abs(bend) > 1e-9])
    return int((sign[1:] != sign[:-1]).sum())


def test_a_circle_that_stays_is_left_alone() -> None:
    """A map elsewhere adds nothing to it, and its places keep their bits."""
    circle = SpaceCircle.of([80.0, 0.0, 5.0], 0.725, [1.0, 0.0, 0.0])
    far = redraw_circle("far", circle, MAP, MAP.jacobian)
    assert far.idle
    assert changed_circles([*CIRCLES, far]) == CIRCLES


def test_the_centre_of_a_circle_goes_to_the_centre() -> None:
    """To the bit, so that what was measured from it is measured from the new one."""
    for each in CIRCLES:
        assert np.array_equal(FEATURES(each.before.centre[None])[0], each.after.centre)
