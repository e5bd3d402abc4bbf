"""Criteria of intact stability, down-flooding and open decks, on hulls known by formula."""

from __future__ import annotations

import attrs
import numpy as np
import pytest

from assoc_hull.analysis.hydrostatics.floating_body import FloatingPosition, planes_of
from assoc_hull.analysis.stability.condition import ConditionRequest
from assoc_hull.analysis.stability.criteria import Criterion
from assoc_hull.analysis.stability.flooding import FloodingPoint
from assoc_hull.analysis.stability.righting_lever import TrimRule
from assoc_hull.analysis.stability.stability_report import Stability, stability_of
from assoc_hull.errors import BadInputError, OutOfRangeError
from tests.floating_bodies import box_body, head

BREADTH, DRAUGHT = 20.0, 6.0

AREA = 5e-6
"""Areas (m rad) are those of cubics between computed levers, which are refined to 1e-4 m."""


def box(
    kg: float,
    points: tuple[FloodingPoint, ...] = (),
    *,
    draught: float = DRAUGHT,
    trim: TrimRule = "fixed",
    closed: bool = True,
    tcg: float = 0.0,
    most: float = 90.0,
) -> Stability:
    """The box of 100 x 20 x 12 m, 12,000 m3."""
    header = head(100.0, BREADTH, DRAUGHT, kg=kg, deck="closed" if closed else "open")
    heels = np.arange(0.0, most + 1.0, 10.0)
    asked = ConditionRequest(draught=draught, kg=kg, tcg=tcg)
    return stability_of(box_body(closed), header, asked, trim, heels, points)


def wall_sided(heel_deg: float, kg: float, draught: float = DRAUGHT) -> float:
    """GZ of a box whose deck edge is dry, m."""
    phi = np.radians(heel_deg)
    bm = BREADTH**2 / 12.0 / draught
    return float(np.sin(phi) * (draught / 2.0 + bm * (1.0 + np.tan(phi) ** 2 / 2.0) - kg))


def wall_sided_area(heel_deg: float, kg: float, draught: float = DRAUGHT) -> float:
    """Its integral, m rad: sin tan^2 / 2 integrates to (cos + 1 / cos) / 2."""
    c, bm = np.cos(np.radians(heel_deg)), BREADTH**2 / 12.0 / draught
    return float((draught / 2.0 + bm - kg) * (1.0 - c) + bm * (0.5 * (c + 1.0 / c) - 1.0))


def test_a_ship_that_meets_all_criteria_passes() -> None:
    """Six are evaluated; the weather criterion is listed, and is not."""
    found = box(5.0)
    assert found.passed is True
    assert found.failed == ()
    assert [each.code for each in found.criteria] == [
        "2.2.1", "2.2.1", "2.2.1", "2.2.2", "2.2.3", "2.2.4", "2.3",
    ]  # fmt: skip
    weather = found.criteria[-1]
    assert (weather.value, weather.passed) == (None, None)
    assert "not evaluated" in str(weather)
    assert any("A 2.3" in note and "not evaluated" in note for note in found.notes)


def test_a_report_never_says_passed_in_all() -> None:
    """What is not evaluated is named beside what is met, and where none fails but not all is."""
    words = dict(box(5.0).lines())["in all"]
    assert words == "2.2.1 to 2.2.4 are met; not evaluated: 2.3 severe wind and rolling"
    found = box(5.0, closed=False, draught=8.0)
    assert len(found.not_evaluated) == 6
    words = dict(found.lines())["in all"]
    assert words.startswith("no criterion fails, but not all are evaluated: not 2.2.1 area under")
    assert words.endswith("2.3 severe wind and rolling")


def test_a_table_has_no_draughts_that_no_mark_can_show() -> None:
    """On a box of T 8 m and D 12 m the water leaves the centre line by the deck as she heels.

    Levers go on. What stands in the table is on the centre line, within the hull, and gives back
    the displacement.
    """
    found = box(5.0, draught=8.0, most=85.0)
    aft, fore = found.columns["draught_aft"], found.columns["draught_fore"]
    np.testing.assert_array_equal(np.isnan(aft), np.isnan(fore))
    given = np.isfinite(aft)
    assert given[:6].all()
    assert not given[-1]
    assert (aft[given] >= 0.0).all()
    assert (aft[given] <= 12.0).all()
    assert np.isfinite(found.gz).all()
    for heel, draught in zip(found.heel_deg[given].tolist(), aft[given].tolist(), strict=True):
        planes = planes_of([FloatingPosition(draught, draught, heel)], 100.0)
        volume = found.curve.case.afloat.measure(planes).volume[0]
        assert volume == pytest.approx(found.condition.volume, rel=1e-9)
    note = next(each for each in found.notes if "no draughts there" in each)
    assert note.startswith(f"from {found.heel_deg[~given][0]:g} deg on")
    assert not any("no draughts there" in each for each in box(5.0).notes)  # T is D / 2


def test_areas_and_levers_are_those_of_a_wall_sided_ship() -> None:
    """To 30 degrees in closed form; its deck edge goes under at atan(0.6) = 30.96 degrees."""
    found = box(5.0)
    area, _, _, _, _, gm = found.criteria[:6]
    assert area.value == pytest.approx(wall_sided_area(30.0, 5.0), abs=AREA)
    assert gm.value == pytest.approx(3.0 + 400.0 / 72.0 - 5.0, abs=1e-9)
    assert found.gz[2] == pytest.approx(wall_sided(20.0, 5.0), abs=1e-11)
    assert found.angles.deck_edge == pytest.approx(np.degrees(np.arctan(0.6)), abs=1e-8)


def test_areas_beyond_the_deck_edge_are_the_work_done() -> None:
    """0 to 40 and 30 to 40 degrees: the rise of G over B between exact positions."""
    found = box(8.0)
    rise = found.heels.energy - found.heels.energy[0]
    assert found.criteria[1].value == pytest.approx(rise[4], abs=AREA)
    assert found.criteria[2].value == pytest.approx(rise[4] - rise[3], abs=AREA)
    assert found.columns["arm"][6] == pytest.approx(rise[6], abs=AREA)


def test_a_ship_that_fails_names_the_criterion_and_the_margin() -> None:
    """KG 8.5 m leaves GM 0.0556 m: 0.0944 m too little; areas are enough."""
    found = box(8.5)
    assert found.passed is False
    assert "2.2.4" in [each.code for each in found.failed]
    short = found.criteria[5]
    assert short.margin == pytest.approx(3.0 + 400.0 / 72.0 - 8.5 - 0.15, abs=1e-9)
    words = dict(found.lines())["in all"]
    assert words.startswith("FAILED: ")
    assert "2.2.4 initial metacentric height (-0.0944)" in words


def test_without_openings_40_degrees_are_used_and_told() -> None:
    """In the criteria that end at down-flooding, and only there."""
    found = box(5.0)
    notes = [each.note for each in found.criteria[:3]]
    assert notes == ["", "phi_f not given, 40 used", "phi_f not given, 40 used"]


def test_an_opening_goes_under_where_geometry_says() -> None:
    """A point y 8, z 10 of the box at T 6: tan(phi) = 4 / 8, whatever side it is given on."""
    for y in (8.0, -8.0):
        found = box(5.0, (FloodingPoint("hatch", (50.0, y, 10.0)),))
        assert found.angles.flooding == pytest.approx(np.degrees(np.arctan(0.5)), abs=1e-8)
    one = FloodingPoint("vent", (50.0, 8.0, 10.0), both_sides=False)
    found = box(5.0, (one,))  # on the side that rises
    assert found.angles.flooding is None
    assert "stay dry" in found.criteria[1].note


def test_areas_end_where_water_comes_in() -> None:
    """At 35 degrees the areas to 40 are to 35; the first of several openings counts."""
    phi = np.radians(29.0)
    low = FloodingPoint("low", (50.0, 8.0, 6.0 + 8.0 * float(np.tan(phi))))
    high = FloodingPoint("high", (50.0, 8.0, 11.9))
    found = box(5.0, (high, low))
    assert found.angles.flooding == pytest.approx(29.0, abs=1e-8)
    assert (found.floodings[0].heel_deg or 0.0) > 29.0
    to_30, to_40, beyond = (each.value for each in found.criteria[:3])
    assert to_30 == to_40 == pytest.approx(wall_sided_area(29.0, 5.0), abs=AREA)
    assert beyond == 0.0
    assert found.criteria[2].passed is False
    assert "phi_f 29.00 deg: nothing counts beyond" in str(found.criteria[2])


def test_an_opening_that_is_under_water_upright_floods_at_once() -> None:
    """Nothing counts."""
    found = box(5.0, (FloodingPoint("sea chest", (50.0, 0.0, 3.0)),))
    assert found.angles.flooding == 0.0
    assert [each.value for each in found.criteria[:3]] == [0.0, 0.0, 0.0]


@pytest.mark.parametrize("trim", ["fixed", "free"])
def test_an_open_deck_ends_the_curve_at_its_edge(trim: TrimRule) -> None:
    """T 8 m: at atan(0.4) = 21.8 degrees; what needs more is not evaluated, with the reason."""
    found = box(5.0, closed=False, draught=8.0, trim=trim)
    edge = float(np.degrees(np.arctan(0.4)))
    assert found.angles.deck_edge == pytest.approx(edge, abs=1e-7)
    assert found.curve.end == pytest.approx(edge, abs=1e-5)
    assert np.isfinite(found.gz[:3]).all()
    assert np.isnan(found.gz[3:]).all()
    for each in found.criteria[:5]:
        assert each.passed is None
        assert "GZ stops at 21.80 deg, where the edge of the open deck goes under" in str(each)
    assert found.criteria[5].passed is True
    assert found.passed is None
    assert found.notes[0].startswith("the deck is open: GZ stops")


def test_open_and_closed_decks_have_the_same_levers_before_the_edge() -> None:
    """And both say which they are."""
    one, other = box(5.0, most=20.0), box(5.0, closed=False, most=20.0)
    np.testing.assert_allclose(one.gz, other.gz, atol=1e-11)
    assert (one.header.deck, other.header.deck) == ("closed", "open")
    assert one.notes[0] == "the deck is closed"


def test_the_largest_lever_and_the_range_are_found_between_computed_heels() -> None:
    """GZ is stationary at the one, and nil at the other, computed anew."""
    found = box(8.0)
    assert found.angles.range == found.angles.vanishing
    vanishing = found.angles.vanishing
    assert vanishing is not None
    at = found.curve.through([found.angles.largest, vanishing]).heels
    for heel, name in ((found.angles.largest, "growth"), (vanishing, "gz")):
        k = int(np.argmin(np.abs(at.heel_deg - heel)))
        assert getattr(at, name)[k] == pytest.approx(0.0, abs=1e-8)
    assert found.gz_max >= found.curve.heels.gz.max() - 1e-12


def test_a_ship_is_judged_to_the_side_to_which_gravity_heels_her() -> None:
    """G to port or to starboard: the same numbers, the other word."""
    port, starboard = box(5.0, tcg=0.2), box(5.0, tcg=-0.2)
    assert (port.side, starboard.side) == ("port", "starboard")
    for one, other in zip(port.criteria[:6], starboard.criteria[:6], strict=True):
        assert one.value == pytest.approx(other.value, abs=1e-9)
    assert (port.criteria[0].value or 9.0) < (box(5.0).criteria[0].value or 0.0)
    start = port.angles.equilibrium
    assert start == pytest.approx(starboard.angles.equilibrium, abs=1e-8)
    assert start == pytest.approx(np.degrees(0.2 / port.gm), rel=5e-3)


def test_draughts_tell_where_gravity_is() -> None:
    """Trimmed by given draughts, a ship that is free to trim keeps them upright, however high G."""
    header = head(100.0, BREADTH, DRAUGHT, kg=4.0, deck="closed")
    asked = ConditionRequest(draughts=(6.5, 5.5), kg=4.0)
    found = stability_of(box_body(True), header, asked, "free", np.array([0.0, 10.0]))
    at = [found.columns[name][0] for name in ("draught_aft", "draught_fore")]
    assert at == pytest.approx([6.5, 5.5], abs=1e-6)


def test_a_table_of_the_other_side_is_told() -> None:
    """Heels to starboard of a ship that lists to port, and those alone."""
    told = [any("judged heeling to port" in note for note in box(5.0, tcg=t).notes)
            for t in (0.2, 0.0, -0.2)]  # fmt: skip
    assert told == [True, False, False]


def test_just_what_is_required_is_enough() -> None:
    """The least that the code allows passes, with no margin."""
    least = Criterion("2.2.4", "initial metacentric height", 0.15, "m", 0.15)
    assert (least.passed, least.margin) == (True, 0.0)
    assert least.passed != attrs.evolve(least, value=0.15 - 1e-12).passed


def test_a_lever_that_is_never_positive_has_no_range() -> None:
    """KG 20 m: the ship capsizes, and fails."""
    found = box(20.0)
    assert (found.angles.equilibrium, found.angles.vanishing, found.angles.range) == (None,) * 3
    assert found.passed is False


def test_free_trim_says_where_it_ends() -> None:
    """At 85 degrees, if more was asked; what is not there is nan."""
    found = box(5.0, trim="free")
    assert np.isnan(found.gz).tolist() == [False] * 9 + [True]
    assert found.notes[-1] == "at free trim nothing is computed beyond 85 deg"
    assert found.curve.end == 85.0
    assert box(5.0, trim="free", most=80.0).notes[-1] != found.notes[-1]


@pytest.mark.parametrize(
    ("asked", "error", "words"),
    [
        (ConditionRequest(weight=0.0, kg=5.0), OutOfRangeError, "is none"),
        (ConditionRequest(weight=-3.0, kg=5.0), OutOfRangeError, "is none"),
        (ConditionRequest(weight=float("nan"), kg=5.0), OutOfRangeError, "a weight"),
        (
            ConditionRequest(weight=1e5, kg=5.0),
            OutOfRangeError,
            "more than the hull carries.*24600",
        ),
        (ConditionRequest(draught=13.0, kg=5.0), OutOfRangeError, "above the deck"),
        (ConditionRequest(draught=-1.0, kg=5.0), OutOfRangeError, "below the keel"),
        (
            ConditionRequest(draughts=(6.0, float("nan")), kg=5.0),
            OutOfRangeError,
            "no finite number",
        ),
        (ConditionRequest(weight=9e3, draught=6.0, kg=5.0), BadInputError, "more than one"),
        (
            ConditionRequest(draught=6.0, lcg=50.0, kg=5.0),
            BadInputError,
            "lcg is given without a weight",
        ),
        (ConditionRequest(weight=12300.0, lcg=99.0, kg=5.0), BadInputError, "no trim"),
    ],
)
def test_a_condition_that_cannot_be_is_refused(
    asked: ConditionRequest, error: type[Exception], words: str
) -> None:
    """With what is wrong, and the range."""
    with pytest.raises(error, match=words):
        stability_of(box_body(), head(100.0, 20.0, 6.0, kg=5.0), asked, "fixed", np.zeros(1))
