"""Named parameters laid out together: all anchors are met by one map."""

import numpy as np
import pytest

from assoc_hull.errors import AssocHullError, BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.parameters.catalogue import CATALOGUE, NAMES
from assoc_hull.variation.parameters.compose_map import compose_map, conflicts
from assoc_hull.variation.parameters.field_layout import Layout
from assoc_hull.variation.parameters.parent import Parent
from tests.unit.variation.conftest import at


def rake_deg(foot: FloatArray, top: FloatArray) -> float:
    """The angle of a chord of the stem from the vertical."""
    return float(np.degrees(np.arctan2(top[0] - foot[0], top[2] - foot[2])))


ASKED = {
    "length": 306.0, "breadth": 51.5, "draught": 18.9, "depth": 28.5, "shaft_height": 6.0,
    "bossing_radius": 1.0, "transom_height": 19.9, "transom_half_breadth": 21.5,
    "bulb_height": 7.8, "bulb_half_breadth": 6.4, "bulb_length": 7.4, "bilge_radius": 3.0,
    "parallel_body_start": 125.0, "parallel_body_end": 200.0, "stem_rake_deg": 22.0,
    "fore_shift": 2.0, "aft_shift": -1.0,
}  # fmt: skip


def test_all_anchors_are_met_together(ship: Parent) -> None:
    """Many parameters in one map; each anchor lies where it was asked for."""
    vmap = compose_map(ship, ASKED, Layout())
    here = {name: vmap(place[None, :])[0] for name, place in ship.places.items()}
    found = {
        "shaft_height": here["boss"][2], "bossing_radius": here["boss side"][1],
        "transom_height": here["transom"][2], "transom_half_breadth": here["transom side"][1],
        "bulb_height": here["bulb tip"][2], "bulb_half_breadth": here["bulb side"][1],
        "bulb_length": here["bulb tip"][0] - 306.0, "depth": here["deck"][2],
        "bilge_radius": here["bilge high"][2],
        "parallel_body_start": here["body start"][0], "parallel_body_end": here["body end"][0],
    }  # fmt: skip
    for name, value in found.items():
        assert value == pytest.approx(ASKED[name], abs=1e-12), name
    assert here["corner"][1] == pytest.approx(25.75, abs=1e-12)
    assert rake_deg(here["stem"], here["stem top"]) == pytest.approx(22.0, abs=1e-12)


def test_a_rake_turns_the_chord_of_the_stem(ship: Parent) -> None:
    """Its top moves, the fore perpendicular stays."""
    vmap = compose_map(ship, {"stem_rake_deg": 22.0}, Layout())
    foot, top = vmap(np.array([ship.places["stem"], ship.places["stem top"]]))
    assert rake_deg(foot, top) == pytest.approx(22.0)
    assert (foot == ship.places["stem"]).all()


def test_a_shaft_is_raised_as_a_whole(ship: Parent) -> None:
    """The map is level at its height, so that the bossing keeps its radius; the base stays."""
    vmap = compose_map(ship, {"shaft_height": 6.0}, Layout())
    boss = ship.places["boss"][None]
    assert np.abs(vmap.jacobian(boss)[0] - np.eye(3)).max() < 1e-14
    assert (vmap(boss * [1.0, 1.0, 0.0]) == boss * [1.0, 1.0, 0.0]).all()
    assert vmap(boss)[0, 2] == 6.0


def test_a_larger_bossing_stays_a_circle(ship: Parent) -> None:
    """All round its end, to rounding; six radii ahead its height is the hull's, its breadth fades.

    Twelve radii ahead nothing is left of it.
    """
    vmap = compose_map(ship, {"bossing_radius": 1.0}, Layout())
    angle = np.linspace(-0.5 * np.pi, 0.5 * np.pi, 91)
    end = np.column_stack([np.full(91, 6.0), 0.725 * np.cos(angle), 5 + 0.725 * np.sin(angle)])
    _, y, z = vmap(end).T
    assert np.abs(np.hypot(y, z - 5.0) - 1.0).max() < 1e-14
    ahead = end + np.array([6 * 0.725, 0.0, 0.0])
    assert (vmap(ahead)[:, 2] == ahead[:, 2]).all()
    assert (vmap(ahead)[1:-1, 1] > ahead[1:-1, 1] * 1.1).all()
    beyond = end + np.array([12 * 0.725 + 1e-9, 0.0, 0.0])
    assert (vmap(beyond) == beyond).all()


def test_a_rigid_shaft_moves_its_bossing_by_one_amount(ship: Parent) -> None:
    """Where the layout says so: from its lower to its upper side."""
    vmap = compose_map(ship, {"shaft_height": 6.0}, Layout(rigid=True))
    z = np.linspace(4.275, 5.725, 51)
    places = np.column_stack([np.full(51, 6.0), np.zeros(51), z])
    assert np.abs(vmap(places)[:, 2] - z - 1.0).max() < 1e-14


@pytest.mark.parametrize("deck", [{"depth": 30.0}, {"deck_height": 25.5}])
def test_a_rake_holds_on_a_stem_that_the_deck_made_longer(
    ship: Parent, deck: dict[str, float]
) -> None:
    """The angle is that of the stem as it comes to be, by one map."""
    vmap = compose_map(ship, {"stem_rake_deg": 22.0, **deck}, Layout())
    foot, top = vmap(np.array([ship.places["stem"], ship.places["stem top"]]))
    assert rake_deg(foot, top) == pytest.approx(22.0, abs=1e-12)


def test_a_deck_raised_at_the_bow_goes_with_a_depth(ship: Parent) -> None:
    """They contradict each other amidships only."""
    vmap = compose_map(ship, {"depth": 28.0, "deck_height": 29.0}, Layout(deck="fore"))
    here = vmap(np.array([ship.places["deck"], ship.places["deck fore"]]))
    assert here[:, 2] == pytest.approx([28.0, 29.0], abs=1e-12)


@pytest.mark.parametrize("name", [each for each in NAMES if each not in ("draught", "length")])
def test_a_parameter_alone_leaves_the_rest_of_the_ship_to_the_bit(ship: Parent, name: str) -> None:
    """Outside its regions no place moves, and the Jacobian is the unit matrix."""
    now = {"breadth": 50.0, "depth": 27.0, "deck_height": 27.0, "shaft_height": 5.0,
           "bossing_radius": 0.725, "transom_height": 18.4, "transom_half_breadth": 20.0,
           "bulb_height": 7.0, "bulb_half_breadth": 6.0, "bulb_length": 6.4, "bilge_radius": 2.4,
           "deadrise_deg": 0.0, "flat_of_bottom": 22.6, "parallel_body_start": 115.0,
           "parallel_body_end": 205.5, "stem_rake_deg": 18.43, "fore_shift": 0.0,
           "aft_shift": 0.0, "parallel_body_length": 90.5, "sheer_fore": 0.0,
           "sheer_aft": 0.0, "fore_frame_height": 8.9, "aft_frame_height": 8.9,
           "entrance_deg": 47.0, "run_deg": 30.0, "waterline_fullness": 0.85,
           "bulb_area": 100.0, "bulb_section_height": 7.0}  # fmt: skip
    vmap = compose_map(ship, {name: now[name] + 0.2}, Layout())
    random = np.random.default_rng(7)
    xyz = random.uniform([-5, 0, 0], [306, 25, 27], (4000, 3))
    outside = np.ones(len(xyz), bool)
    for region in vmap.regions():
        (left, right), (low, high) = region.x, region.z
        inside = (xyz[:, 0] > left) & (xyz[:, 0] < right) & (xyz[:, 2] > low) & (xyz[:, 2] < high)
        outside &= ~inside
    assert (vmap(xyz)[outside] == xyz[outside]).all()
    assert (vmap.jacobian(xyz)[outside] == np.eye(3)).all()
    assert (vmap(xyz) != xyz).any()


@pytest.mark.parametrize("end", ["parallel_body_start", "parallel_body_end"])
@pytest.mark.parametrize("moves", [(1.0, -1.0), (1.0, 0.5), (-2.0, 3.0), (0.3, 0.3), (0.0, 0.4)])
def test_a_length_of_the_parallel_body_beside_an_end_moves_the_other_end(
    ship: Parent, end: str, moves: tuple[float, float]
) -> None:
    """Nothing moves farther than the ends do: by halves each end would undo the other's."""
    before = np.array([ship.places["body start"][0], ship.places["body end"][0]])
    after = before + moves
    asked = {
        end: float(after[int(end == "parallel_body_end")]),
        "parallel_body_length": float(after[1] - after[0]),
    }
    vmap = compose_map(ship, asked, Layout())
    x = np.linspace(0.0, ship.length, 301)
    moved = vmap(np.column_stack([x, np.zeros(301), np.full(301, 9.0)]))[:, 0] - x
    ends = vmap(np.array([[before[0], 0.0, 9.0], [before[1], 0.0, 9.0]]))[:, 0]
    assert ends == pytest.approx(after, abs=1e-9)
    assert np.abs(moved).max() <= max(map(abs, moves)) + 1e-9


@pytest.mark.parametrize(("one", "other"), [("depth", "deck_height"),
                                            ("bilge_radius", "flat_of_bottom"),
                                            ("bilge_radius", "deadrise_deg"),
                                            ("bulb_area", "bulb_half_breadth")])  # fmt: skip
def test_parameters_that_contradict_each_other_are_both_named(
    ship: Parent, one: str, other: str
) -> None:
    """Whatever their values are."""
    with pytest.raises(BadInputError, match=f"'{one}' and '{other}'"):
        compose_map(ship, {one: 3.0, other: 2.0}, Layout())
    assert other in conflicts(one)
    assert one in conflicts(other)


def test_two_changes_of_one_place_are_refused(ship: Parent) -> None:
    """A hub that is the transom's foot as well: which of both is to be had is not for us to say."""
    both = {**ship.places, "transom": at(6, 0, 5.0), "boss": at(6, 0, 5.0)}
    del both["boss top"]
    parent = Parent(300, 50, 27, 18, 27, both)
    with pytest.raises(BadInputError, match="different changes of the same place"):
        compose_map(parent, {"shaft_height": 5.4, "transom_height": 6.0}, Layout())


def test_a_ratio_needs_a_grip(ship: Parent) -> None:
    """What the parent has not is told by its reason."""
    parent = Parent(300, 50, 27, 18, 27, {}, {"bossing_radius": "parent has no bossing circle"})
    with pytest.raises(BadInputError, match="parent has no bossing circle"):
        compose_map(parent, {"bossing_radius": 1.0}, Layout())


@pytest.mark.parametrize("layout", [{"stern": -1.0}, {"sten": 0.2}, {"rigid": 1}, {"blend": "b3"}])
def test_a_layout_takes_only_what_it_knows(layout: dict[str, object]) -> None:
    """Unknown names and meaningless reaches are refused."""
    with pytest.raises(AssocHullError):
        Layout.of(layout)


def test_the_catalogue_names_all() -> None:
    """Twenty-eight measured ones and two amplitudes; one name everywhere."""
    assert len(NAMES) == 30
    assert [name for name in NAMES if CATALOGUE[name].amplitude] == ["fore_shift", "aft_shift"]
