"""Ships from six numbers: what was asked for is met, the rest told, contradictions refused."""

from __future__ import annotations

import pytest

import assoc_hull as ah
from assoc_hull.creation.area_swing import half_sums, swing_areas
from assoc_hull.creation.six_numbers import SixNumbers, TypedDesign, design_for
from assoc_hull.creation.six_numbers_net import with_room
from assoc_hull.geometry.splines.segments import sample
from assoc_hull.hull.hull import Hull
from assoc_hull.hull.typed_ship import _nearly_closed
from assoc_hull.model.forms.closure import coefficients
from assoc_hull.model.forms.two_halves import half_number
from assoc_hull.shipped.ship_types import SHIP_TYPES, ship_type

SIX = {"length": 100.0, "breadth": 16.0, "draught": 6.5, "depth": 9.0, "cb": 0.70, "lcb": 0.4}


@pytest.fixture(scope="module")
def cargo() -> Hull:
    """Give a general cargo ship of 100 m."""
    return ah.create(
        length=100.0, breadth=16.0, draught=6.5, depth=9.0, cb=0.70, lcb=0.4, type="general cargo"
    )


def test_hydrostatics_of_the_net_have_the_cb_and_lcb_that_were_asked_for(cargo: Hull) -> None:
    """Within 1e-6, and 1e-6 of the length."""
    found = cargo.hydrostatics()
    assert found.cb == pytest.approx(0.70, abs=1e-6)
    assert found.lcb - 50.0 == pytest.approx(0.4, abs=1e-4)


def test_ship_from_six_numbers_is_sound_and_has_no_history(cargo: Hull) -> None:
    """Nothing to find by check and verify; the last step on CB and LCB is none of the user's."""
    assert not cargo.check()
    assert not cargo.verify()
    assert not cargo.history


def test_courses_are_solved_for_nearly_the_areas_that_the_ship_gets() -> None:
    """A bulb ahead of FP is no part of the curve of areas: it is allowed for before solving."""
    six = SixNumbers(140.0, 20.0, 6.4, 10.4, 0.64, -2.0)
    typed = design_for(SHIP_TYPES["container ship"], six)

    def miss(design: TypedDesign) -> float:
        found = Hull(with_room(design, 3)[2]).hydrostatics(estimate=False)
        return abs(found.cb - six.cb) + abs(found.lcb - 70.0 - six.lcb) / six.length

    assert miss(typed) > 1e-3
    assert miss(_nearly_closed(typed, six)) < 2e-4


def test_values_can_be_read_and_set(cargo: Hull) -> None:
    """The definitions belong to the hull."""
    hull = cargo.snapshot()
    assert hull.definitions["sectional areas"].values["run_end"] is not None
    with hull.edit("fuller bow") as edit:
        edit.set_form("profile", top_y=10.5)
    assert hull.definitions["profile"].values["top_y"] == 10.5


def test_notes_tell_source_range_and_alternatives(cargo: Hull) -> None:
    """Of CM: the formula used, and what the other one gives."""
    notes = {each.name: each for each in cargo.notes}
    assert notes["CM"].value == pytest.approx(1.006 - 0.0056 * 0.70**-3.56)
    assert list(notes["CM"].others.values()) == [pytest.approx(1.0 / (1.0 + 0.3**3.5))]
    assert {"CW", "CP", "bilge radius", "half angle of entrance"} <= set(notes)


@pytest.mark.parametrize("kind", SHIP_TYPES)
def test_design_closes_to_cb_and_lcb_exactly(kind: str) -> None:
    """Also where the fullness of the halves has to give."""
    middle = {name: 0.5 * sum(ends) for name, ends in ship_type(kind).ratios.items()}
    length = 0.5 * sum(ship_type(kind).length)
    breadth = length / middle["L/B"]
    draught, cb, lcb = breadth / middle["B/T"], middle["cb"], 0.01 * middle["lcb"] * length
    six = SixNumbers(length, breadth, draught, draught * middle["D/T"], cb, lcb)
    design = design_for(SHIP_TYPES[kind], six).design
    found = coefficients(design.definition("sectional_area"), design.particulars)
    assert found.block == pytest.approx(cb, abs=1e-12)
    assert found.centroid == pytest.approx(lcb, abs=1e-9)


def test_swing_to_its_own_coefficients_leaves_a_curve_of_areas_as_it_is() -> None:
    """Nothing moves where nothing is asked for."""
    parent = SHIP_TYPES["bulk carrier"].parent()
    areas = parent.definition("sectional_area")
    now = coefficients(areas, parent.particulars)
    found = swing_areas(areas, now.fullness, 2.0 * now.centroid / parent.particulars.length)
    for half in ("run", "entrance"):
        assert half_sums(found.definition, half) == pytest.approx(half_sums(areas, half), abs=1e-9)


def test_cb_and_lcb_that_fight_are_refused_with_an_interval_that_holds() -> None:
    """The error names both, and following it works."""
    six = SIX | {"cb": 0.9, "lcb": 3.0}
    with pytest.raises(ah.errors.OutOfRangeError, match="and lcb of 3 m fight") as no:
        design_for(SHIP_TYPES["general cargo"], SixNumbers(**six))
    six["cb"] = no.value.most
    design_for(SHIP_TYPES["general cargo"], SixNumbers(**six))


def test_number_out_of_its_range_is_told_and_far_out_refused() -> None:
    """A note beside, a refusal far out."""
    kind = SHIP_TYPES["general cargo"]
    notes = design_for(kind, SixNumbers(**(SIX | {"breadth": 19.0}))).notes
    assert any("out of the range of use" in each.remark for each in notes)
    with pytest.raises(ah.errors.OutOfRangeError, match="far out of the range"):
        design_for(kind, SixNumbers(**(SIX | {"length": 400.0})))


@pytest.mark.parametrize(
    ("more", "words"),
    [
        ({"cb": None}, "cb is missing"),
        ({"lcb": None}, "lcb is missing"),
        ({"lcb_percent": 0.2}, "both given"),
        ({"cm": 0.98, "bilge_radius": 2.0}, "both given"),
        ({"type": "submarine"}, "submarine"),
        ({"breadth": -16.0}, "breadth"),
        ({"length": "100"}, "length is the text '100'.*give a number"),
        ({"cw": "0.8"}, "cw is the text"),
    ],
    ids=[
        "no cb",
        "no lcb",
        "two lcb",
        "two bilges",
        "no type",
        "negative",
        "text",
        "text beside",
    ],
)
def test_mistakes_are_named(more: dict[str, object], words: str) -> None:
    """By an error of the family."""
    with pytest.raises(ah.errors.AssocHullError, match=words):
        ah.create(**(SIX | {"type": "general cargo"} | more))  # type: ignore[arg-type]


def test_numbers_beside_a_design_are_refused() -> None:
    """A design has its own."""
    with pytest.raises(ah.errors.BadInputError, match="beside a design"):
        ah.create(SHIP_TYPES["general cargo"].parent(), length=100.0)


def test_a_type_is_found_however_it_is_written() -> None:
    """Upper and lower case and spaces do not matter."""
    assert ship_type(" Container  Ship") is SHIP_TYPES["container ship"]


@pytest.mark.parametrize(
    "six",
    [
        SIX | {"type": "general cargo"},
        {
            "type": "ro-ro", "length": 147.4, "breadth": 20.47, "draught": 4.64, "depth": 10.29,
            "cb": 0.637, "lcb": -1.503,
        },
    ],
    ids=["cargo", "flat ro-ro"],
)  # fmt: skip
def test_no_line_goes_below_the_base_line_by_more_than_a_millimetre(six: dict[str, object]) -> None:
    """Buttocks are straight on the flat of bottom; contours keep their shape when they flatten."""
    hull = ah.create(**six)  # type: ignore[arg-type]
    lowest = min(
        float(sample(hull.state.spline(curve), 64)[1][:, 2].min())
        for curve in hull.state.live("curves").tolist()
    )
    assert lowest > -1e-3
    assert not [each for each in hull.notes if each.name == "lowest place of the net"]
    flats = [each for each in hull.state.generated if each.what == "buttock" and each.rows]
    assert len(flats) >= 4
    for each in flats:
        places = hull.state.rows.xyz[list(each.rows)]
        assert places[:, 2].tolist() == [0.0, 0.0]
        assert places[0, 0] < places[1, 0]


def test_flats_of_buttocks_follow_their_definition(cargo: Hull) -> None:
    """A wider flat of bottom moves the places where buttocks come onto it."""
    hull = cargo.snapshot()
    name = next(each.name for each in hull.state.definitions if each.use == "flat_of_bottom")
    (first,) = [e for e in hull.state.generated if e.what == "buttock" and e.rows][:1]
    before = hull.state.rows.xyz[list(first.rows), 0].copy()
    with hull.edit("longer flat") as edit:
        edit.set_form(name, fore_x=(hull.definitions[name].values["fore_x"] or 0.0) + 1.0)
    after = hull.state.rows.xyz[list(first.rows), 0]
    assert after[1] > before[1]
    assert after[0] == before[0]
    assert not hull.verify()


def test_full_ship_with_its_buoyancy_far_ahead_has_a_short_full_entrance() -> None:
    """Where a fifth of the length leaves no curve of areas, the entrance is shorter."""
    six = SixNumbers(240.0, 40.0, 16.0, 22.0, 0.834, 0.0339 * 240.0)
    design = design_for(SHIP_TYPES["tanker"], six).design
    areas = design.definition("sectional_area")
    assert 0.32 <= 1.0 - half_number(areas, "entrance_start") < 0.4
    found = coefficients(areas, design.particulars)
    assert found.block == pytest.approx(0.834, abs=1e-12)
    assert found.centroid == pytest.approx(0.0339 * 240.0, abs=1e-9)


@pytest.mark.parametrize("asked", [6.0, 20.0])
def test_depths_that_a_refusal_names_are_taken(asked: float) -> None:
    """Both ends of the interval, to the last bit."""
    kind = ship_type("general cargo")
    with pytest.raises(ah.errors.OutOfRangeError) as refusal:
        design_for(kind, SixNumbers(**SIX | {"depth": asked}))
    error = refusal.value
    factor = 1.0 if error.unit == "m" else SIX["draught"]
    for depth in (error.least, error.most):
        design_for(kind, SixNumbers(**SIX | {"depth": factor * depth}))


def test_a_ship_shorter_than_the_error_allows_is_refused() -> None:
    """What the message calls the least is the least that is taken."""
    with pytest.raises(ah.errors.OutOfRangeError, match=r"length of 10 m .* from 17\.5 to"):
        ah.create(
            length=10.0, breadth=1.6, draught=0.65, depth=0.9, cb=0.7, lcb=0.0,
            type="general cargo",
        )  # fmt: skip


def test_a_line_is_not_shifted_below_the_base_line() -> None:
    """The largest bilge that a refusal names does not end in a plane that meets nothing."""
    hull = ah.create(
        length=100.0, breadth=16.0, draught=6.5, depth=9.0, cb=0.7, lcb=0.0,
        type="general cargo", bilge_radius=5.85,
    )  # fmt: skip
    assert hull.hydrostatics().cb == pytest.approx(0.7, abs=1e-6)


def test_values_at_the_bounds_of_a_refusal_are_taken() -> None:
    """Both ends of the interval make a ship, to the digits that are printed."""
    six = SIX | {"type": "general cargo", "cw": 0.7}
    with pytest.raises(ah.errors.OutOfRangeError) as refusal:
        ah.create(**six)  # type: ignore[arg-type]
    error = refusal.value
    assert f"from {error.least:.8g} to {error.most:.8g}" in str(error)
    for value in (error.least, error.most):
        hull = ah.create(**six | {error.name: float(f"{value:.8g}")})  # type: ignore[arg-type]
        assert not hull.check()


def test_refusal_names_the_two_that_fight_and_what_each_may_be() -> None:
    """Both are arguments of `create`, LCB in the unit in which it was given."""
    six = {name: value for name, value in SIX.items() if name != "lcb"} | {"cb": 0.8}
    with pytest.raises(ah.errors.OutOfRangeError) as refusal:
        ah.create(**six, lcb_percent=5.0, type="general cargo")  # type: ignore[arg-type]
    assert "lcb_percent of 5 % and cb of 0.8 fight" in str(refusal.value)
    assert refusal.value.name == "lcb_percent"
    assert -5.0 < refusal.value.least < refusal.value.most < 5.0


def test_a_cw_that_is_asked_for_is_that_of_the_definition() -> None:
    """Both halves of the waterline share in it."""
    six = SixNumbers(**SIX)
    for cw in (0.79, 0.86):
        design = design_for(SHIP_TYPES["general cargo"], six, cw=cw).design
        found = coefficients(design.definition("design_waterline"), design.particulars)
        assert found.fullness == pytest.approx(cw, abs=1e-12)


@pytest.mark.parametrize(
    ("kind", "six"),
    [
        ("general cargo", (100.0, 16.0, 6.5, 9.0, 0.7, 0.0)),
        ("ro-ro", (160.0, 25.0, 6.8, 15.0, 0.58, -2.5)),
    ],
)
def test_no_line_passes_the_side(kind: str, six: tuple[float, ...]) -> None:
    """Points are within a millimetre of half the breadth, lines between them within two."""
    names = ("length", "breadth", "draught", "depth", "cb", "lcb_percent")
    hull = ah.create(**dict(zip(names, six, strict=True)), type=kind)  # type: ignore[arg-type]
    widest = hull.state.rows.xyz[hull.state.live("rows")][:, 1].max()
    assert abs(widest - 0.5 * six[1]) < 1e-3
    told = [note.value for note in hull.notes if note.name == "beyond half the breadth"]
    assert all(value < 2e-3 for value in told)
