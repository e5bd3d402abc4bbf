"""Layouts of single parameters: what each moves, how far it reaches, and what it refuses."""

from __future__ import annotations

import math

import attrs
import numpy as np
import pytest

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.fields.bounded_functions import BlendChain
from assoc_hull.variation.fields.field import AffinePiece, StackedField, level_boundaries
from assoc_hull.variation.parameters.catalogue import CATALOGUE
from assoc_hull.variation.parameters.compose_map import compose_map, solve_field_sizes
from assoc_hull.variation.parameters.field_layout import Layout, Share
from assoc_hull.variation.parameters.parent import Parent
from assoc_hull.variation.parameters.value_limits import value_bounds
from tests.unit.variation.conftest import at

LOCAL = {
    "depth": 28.0, "deck_height": 28.0, "shaft_height": 6.0, "bossing_radius": 1.0,
    "transom_height": 19.0, "transom_half_breadth": 21.0, "bulb_height": 7.5,
    "bulb_half_breadth": 6.5, "bulb_length": 7.4, "parallel_body_start": 120.0,
    "parallel_body_end": 200.0, "stem_rake_deg": 22.0, "fore_shift": 1.5, "aft_shift": -1.5,
    "parallel_body_length": 95.0, "sheer_fore": 0.7, "sheer_aft": -0.4,
    "fore_frame_height": 9.4, "aft_frame_height": 9.2, "entrance_deg": 40.0, "run_deg": 20.0,
    "waterline_fullness": 0.86, "bulb_area": 110.0, "bulb_section_height": 7.2,
}  # fmt: skip


def moved(
    parent: Parent, asked: dict[str, float], place: FloatArray, **layout: object
) -> list[float]:
    """Where a place comes to."""
    found: list[float] = compose_map(parent, asked, Layout.of(layout))(place[None])[0].tolist()
    return found


@pytest.mark.parametrize("name", LOCAL)
@pytest.mark.parametrize("above", [0.0, 2.0])
def test_a_share_alone_gives_its_change(ship: Parent, name: str, above: float) -> None:
    """No help by what solves for all together; also where the bulb is widest above its tip."""
    widest = ship.places["bulb side"] + [0.0, 0.0, above]
    parent = attrs.evolve(ship, places={**ship.places, "bulb side": widest})
    lays = CATALOGUE[name].lays
    assert lays is not None
    share = lays(parent, LOCAL[name], Layout())
    assert isinstance(share, Share)
    assert share.effect(share) == pytest.approx(share.change, abs=1e-12)
    assert share.change != 0.0


def share(name: str, change: float, at_own: float, others: dict[float, float]) -> Share:
    """A share whose field lifts heights by chosen parts of its change, at stations 10 m apart."""
    x = sorted({at_own: 1.0, **others})
    part = BlendChain.through(x, [{**others, at_own: 1.0}[each] for each in x])
    piece = AffinePiece.along(part, 0.0, change)
    field = StackedField(name, "z", level_boundaries(["base"], [0.0]), (piece,))
    return Share.at(name, "z", change, at(at_own, 0.0, 1.0), field)


def test_shares_that_see_each_other_are_met_together() -> None:
    """The sizes are those of the linear equations."""
    one, two = share("one", 1.0, 10.0, {20.0: 0.4}), share("two", -0.5, 20.0, {10.0: 0.3})
    fields = solve_field_sizes([one, two])
    places = np.concatenate([one.places, two.places])
    lift = sum(field.displacement(places) for field in fields)
    assert lift == pytest.approx([1.0, -0.5], abs=1e-14)


@pytest.mark.parametrize(
    ("near", "change"), [pytest.param(0.98, 0.99, id="condition"),
                         pytest.param(0.94, -1.0, id="size")]
)  # fmt: skip
def test_what_asks_for_one_place_is_refused_with_both_names(near: float, change: float) -> None:
    """Nearly equal equations, even if the sizes are usual; or sizes far above what is asked.

    A third, which moves one of them far more, is not blamed.
    """
    shares = [
        share("aside", 5.0, 10.0, {20.0: 3.0, 30.0: 0.0}),
        share("one", 1.0, 20.0, {10.0: 0.0, 30.0: near}),
        share("two", change, 30.0, {10.0: 0.0, 20.0: near}),
    ]
    alone = solve_field_sizes(shares[:2])
    assert len(alone) == 2
    with pytest.raises(BadInputError, match="'one' and 'two' ask different changes"):
        solve_field_sizes(shares[1:])
    with pytest.raises(BadInputError, match="'one' and 'two' ask different changes"):
        solve_field_sizes(shares)


def test_what_is_asked_of_depth_in_nearly_the_ratio_of_the_draught_is_no_similarity(
    ship: Parent,
) -> None:
    """Only the very ratio scales what lies above the draught; else it is shifted, then raised."""
    even = moved(ship, {"draught": 18.9, "depth": 1.05 * 27.0}, at(150, 20, 40.0))
    near = moved(ship, {"draught": 18.9, "depth": 1.049 * 27.0}, at(150, 20, 40.0))
    assert even == pytest.approx([150.0, 20.0, 42.0], abs=1e-12)
    deck = compose_map(ship, {"draught": 18.9}, Layout())(ship.places["deck"][None])[0, 2]
    assert near != pytest.approx([150.0, 20.0, 1.049 * 40.0], abs=0.02)
    assert deck == pytest.approx(27.9, abs=1e-12)


def test_the_transom_foot_bends_the_hull_above_it_only(ship: Parent) -> None:
    """Under the foot of the field nothing moves but by its window; the deck goes along whole."""
    foot = Layout().transom_low * ship.draught
    gap = 18.4 - foot
    assert moved(ship, {"transom_height": 19.0}, at(-5, 5, foot - 0.31 * gap)) == [
        -5.0, 5.0, foot - 0.31 * gap
    ]  # fmt: skip
    assert moved(ship, {"transom_height": 19.0}, at(-5, 5, 27.7)) == pytest.approx(
        [-5.0, 5.0, 28.3], abs=1e-12
    )


@pytest.mark.parametrize("turn", np.linspace(-0.5, 0.5, 5).tolist())
def test_the_bossing_is_widened_as_a_circle(ship: Parent, turn: float) -> None:
    """From its lower to its upper side each point goes outward by the ratio of the radii."""
    side, up = math.cos(turn * math.pi), math.sin(turn * math.pi)
    place = at(6, 0.725 * side, 5 + 0.725 * up)
    found = moved(ship, {"bossing_radius": 1.0}, place)
    assert found == pytest.approx([6.0, side, 5.0 + up], abs=1e-12)


def test_a_transom_is_widened_in_full_from_its_lowest_point_up(ship: Parent) -> None:
    """Half-way up from half the draught it is widened by half, below that nothing is."""
    foot = Layout().transom_side * ship.draught
    at_foot = moved(ship, {"transom_half_breadth": 22.0}, at(-5, 10, foot))
    assert at_foot == [-5.0, 10.0, foot]
    half = moved(ship, {"transom_half_breadth": 22.0}, at(-5, 10, 0.5 * (foot + 18.4)))
    assert half == pytest.approx([-5.0, 10.5, 0.5 * (foot + 18.4)], abs=1e-12)


@pytest.mark.parametrize(("now", "most"), [(20.0, 25.0), (24.99, math.inf)])
def test_a_transom_stays_within_the_breadth_unless_it_makes_it(
    ship: Parent, now: float, most: float
) -> None:
    """One as broad as the ship widens her."""
    assert value_bounds("transom_half_breadth", ship, now, Layout()).high == most


def test_a_slender_transom_is_widened_and_the_ship_is_not(ship: Parent) -> None:
    """What lies at the ship's side keeps its bits: the breadth and the flat of side stay."""
    places = {**ship.places, "transom side": at(-5, 12, 27)}
    vmap = compose_map(attrs.evolve(ship, places=places), {"transom_half_breadth": 15.0}, Layout())
    here = vmap(np.array([[-5.0, 12.0, 27.0], [30.0, 25.0, 20.0], [-5.0, 6.0, 20.0]]))
    assert here[0].tolist() == [-5.0, 15.0, 27.0]
    assert here[1].tolist() == [30.0, 25.0, 20.0]
    assert here[2].tolist() == [-5.0, 7.5, 20.0]


def test_a_rake_is_straight_above_the_middle_of_the_stem(ship: Parent) -> None:
    """It bends from the draught up to half the height over it, and goes on straight."""
    z = np.array([18.0, 22.5, 24.75, 27.0])
    stem = np.column_stack([np.full(4, 303.0), np.zeros(4), z])
    shift = (compose_map(ship, {"stem_rake_deg": 25.0}, Layout())(stem) - stem)[:, 0]
    slope = np.diff(shift) / np.diff(z)
    assert slope[2] == pytest.approx(slope[1], rel=1e-12)
    assert shift[1] == pytest.approx(0.5 * 4.5 * slope[2], rel=1e-12)
    assert shift[0] == 0.0


@pytest.mark.parametrize(("name", "inner", "outer"), [("fore_shift", 205.5, 289.0),
                                                      ("aft_shift", 115.0, 14.0)])  # fmt: skip
@pytest.mark.parametrize(("shape", "part"), [("end", 1 / 3), ("half", 2 / 3), ("c2", 1 / 2)])
def test_a_shift_is_largest_where_its_shape_is(
    ship: Parent, name: str, inner: float, outer: float, shape: str, part: float
) -> None:
    """Counted from the parallel body to where the profile rises; both terminals stay."""
    full = inner + part * (outer - inner)
    assert moved(ship, {name: 1.5}, at(full, 3, 4), shift=shape) == pytest.approx(
        [full + 1.5, 3.0, 4.0], abs=1e-12
    )
    for place in (inner, outer):
        assert moved(ship, {name: 1.5}, at(place, 3, 4), shift=shape) == [place, 3.0, 4.0]


def test_a_bilge_with_rise_of_floor_gets_its_radius(ship: Parent) -> None:
    """Both tangents are as long as those of a circle of the asked radius between the lines."""
    rise, radius = math.radians(5.0), 3.0
    now = 2.4 * math.tan(0.25 * math.pi - 0.5 * rise)
    low = at(150, 25 - now * math.cos(rise), 2.0 - now * math.sin(rise))
    places = {**ship.places, "corner": at(150, 25, 2), "bilge low": low,
              "bilge high": at(150, 25, 2 + now)}  # fmt: skip
    vmap = compose_map(attrs.evolve(ship, places=places), {"bilge_radius": radius}, Layout())
    corner, down, up = vmap(
        np.array([places[key] for key in ("corner", "bilge low", "bilge high")])
    )
    tangent = radius * math.tan(0.25 * math.pi - 0.5 * rise)
    assert math.dist(corner, down) == pytest.approx(tangent, abs=1e-12)
    assert math.dist(corner, up) == pytest.approx(tangent, abs=1e-12)
    assert math.atan2(corner[2] - down[2], corner[1] - down[1]) == pytest.approx(rise, abs=1e-12)


def test_a_bilge_leaves_the_keel_and_the_deck(ship: Parent) -> None:
    """However far its field may reach: the centre plane and the deck keep their bits."""
    for place in (at(150, 0, 0), at(150, 25, 27)):
        assert moved(ship, {"bilge_radius": 3.0}, place, bilge=40.0) == place.tolist()
    assert moved(ship, {"bilge_radius": 3.0}, at(150, 4, 0), bilge=40.0) != [150.0, 4.0, 0.0]
