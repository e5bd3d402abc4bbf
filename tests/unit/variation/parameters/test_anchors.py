"""Named parameters measured on drawn curves: values, places, what is absent and why."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from types import SimpleNamespace
from typing import cast

import attrs
import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.errors import (
    AbsentParameterError,
    AssocHullError,
    BadInputError,
    UnknownNameError,
    WrongTypeError,
)
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.splines.segments import sample
from assoc_hull.model.tables import HullState, copy_state
from assoc_hull.shipped import bulk_carrier_207k_form as form
from assoc_hull.variation.fields.bounded_functions import BlendChain
from assoc_hull.variation.fields.layers import CornerLayer
from assoc_hull.variation.parameters.measurement import DrawnCurves, MeasuredParameter, Measures
from assoc_hull.variation.parameters.midship_measures import _level_run
from assoc_hull.variation.parameters.parameter_measures import (
    AMPLITUDES,
    MEASURES,
    measure,
    measure_all,
)
from tests.cases.test_box_with_bilges import BILGE, DEPTH, DRAUGHT, HALF, LENGTH, round_box
from tests.conftest import Shipped
from tests.taken_back import taken_back

Map = Callable[[FloatArray], FloatArray]

NO_BULB = "no profile forward of FP below z={:.3f}"


@pytest.fixture(scope="module")
def carrier(bulk_carrier: ah.Hull) -> Measures:
    """What is measured of the carrier."""
    return measure(bulk_carrier)


@pytest.fixture
def box() -> ah.Hull:
    """A box with circular bilges, without borders of flats."""
    return round_box()


def mapped(hull: ah.Hull, mapping: Map, *drivers: str) -> HullState:
    """The tables of a hull after a map of its sections or others; the hull is as before."""
    with taken_back(hull):
        with hull.edit("map") as edit:
            edit.transform(mapping, drivers=drivers or ["sections"])
        return copy_state(hull.state)


def through(layer: CornerLayer, xyz: FloatArray) -> FloatArray:
    """Places mapped by one layer."""
    return xyz + layer.displacement(xyz)


# Values.


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("length", form.LENGTH),
        ("breadth", form.BREADTH),
        ("draught", form.DRAUGHT),
        ("depth", form.DEPTH),
        ("deck_height", form.DEPTH),
        ("shaft_height", form.SHAFT),
        ("bossing_radius", form.BOSS),
        ("transom_height", form.TRANSOM_LOW),
        ("transom_half_breadth", float(form.carrier_half_breadth(form.TRANSOM, form.DEPTH))),
        ("bilge_radius", form.BILGE),
        ("deadrise_deg", 0.0),
        ("flat_of_bottom", form.BREADTH / 2.0 - form.BILGE),
        ("parallel_body_start", float(form.aft_shoulder(0.0))),
        ("parallel_body_end", float(form.fore_shoulder(0.0))),
        ("stem_rake_deg", float(np.degrees(np.arctan(
            (form.fore_end(form.DEPTH) - form.LENGTH) / (form.DEPTH - form.DRAUGHT))))),
        ("fore_shift", 0.0),
        ("aft_shift", 0.0),
    ],
)  # fmt: skip
def test_the_carrier_measures_what_its_formulas_say(
    carrier: Measures, name: str, value: float
) -> None:
    """Where the formula's own places are drawn, the measured value is theirs to 1e-6."""
    assert carrier[name] == pytest.approx(value, abs=1e-6)


def test_the_bulb_is_that_of_the_drawn_curves(bulk_carrier: ah.Hull, carrier: Measures) -> None:
    """The tip is the foremost place of the spline, not of its points; FP's section is the form's.

    The splines come to within 2 mm of the formulas, whose nose is at a defining point.
    """
    drawn = DrawnCurves(bulk_carrier.state)
    profile = sample(drawn.some(drawn.profile), 400)[1]
    foremost = profile[:, 0].max()
    tip = carrier.anchors["bulb_length"].places[0]
    assert foremost <= tip[0] <= foremost + 1e-6
    assert tip[0] > drawn.some(drawn.profile).xyz[:, 0].max() + 1e-5
    assert carrier["bulb_length"] == tip[0] - form.LENGTH
    assert carrier["bulb_height"] == tip[2]
    z = np.linspace(1.5, 15.5, 4001)
    assert carrier["bulb_half_breadth"] == pytest.approx(
        form.carrier_half_breadth(form.LENGTH, z).max(), abs=2e-3
    )


def test_measures_agree_with_form_parameters(bulk_carrier: ah.Hull, carrier: Measures) -> None:
    """What the catalogue of form parameters measures as well has one value."""
    other = bulk_carrier.form_parameters(only=["BL", "BH", "TH", "SCH", "BW"])
    pairs = {
        "BL": "bulb_length",
        "BH": "bulb_height",
        "TH": "transom_height",
        "SCH": "shaft_height",
    }
    for symbol, name in pairs.items():
        assert other[symbol].number == pytest.approx(carrier[name], abs=1e-6)
    # The surface between two stations, and a section cut from waterlines.
    assert other["BW"].number == pytest.approx(2.0 * carrier["bulb_half_breadth"], abs=1e-3)


def test_a_section_added_at_fp_is_the_section_that_was_measured(
    bulk_carrier: ah.Hull, carrier: Measures
) -> None:
    """Without a section at FP the half-breadth there is that of the one the net would be given."""
    with taken_back(bulk_carrier) as hull:
        with hull.edit("station at FP") as edit:
            edit.add_line("sections", form.LENGTH, name="ST 20")
        there = measure(hull, only="bulb_half_breadth")
    anchor = there.anchors["bulb_half_breadth"]
    assert anchor.how == "greatest y of the section at FP"
    assert anchor.value == pytest.approx(carrier["bulb_half_breadth"], abs=1e-3)


def test_anchors_lie_on_the_curves_they_name(bulk_carrier: ah.Hull, carrier: Measures) -> None:
    """Keys are those of live curves, and places of extremes lie on them."""
    keys = set(bulk_carrier.state.curves.key.data)
    drawn = DrawnCurves(bulk_carrier.state)
    for name in ("transom_height", "transom_half_breadth", "bulb_length", "flat_of_bottom"):
        anchor = carrier.anchors[name]
        assert anchor.curves
        assert set(anchor.curves) <= keys
        number = [i for i in range(drawn.net.batch.count) if drawn.keys([i])[0] in anchor.curves]
        near = sample(drawn.some(number), 200)[1]
        assert np.sqrt(((near - anchor.places[0]) ** 2).sum(axis=1)).min() < 0.1


def test_a_layout_is_told_what_it_needs(carrier: Measures) -> None:
    """The numbers beside the values: ends of the bilge, the bulb at FP, the transom's place."""
    bilge = carrier.anchors["bilge_radius"].numbers
    wanted = {"low_y": 22.6, "low_z": 0.0, "high_y": 25.0, "high_z": 2.4, "yc": 22.6, "zc": 2.4,
              "corner_y": 25.0, "corner_z": 0.0, "rise_deg": 0.0}  # fmt: skip
    assert {name: bilge[name] for name in wanted} == pytest.approx(wanted, abs=1e-6)
    bulb = carrier.anchors["bulb_height"].numbers
    assert form.fore_end([bulb["low"], bulb["top"]]) == pytest.approx(form.LENGTH, abs=1e-2)
    assert carrier.anchors["bossing_radius"].numbers == pytest.approx(
        {"x": form.BOSS_AFT, "h": form.SHAFT}, abs=1e-6
    )
    assert carrier.anchors["transom_half_breadth"].numbers == {
        "x": form.TRANSOM, "z": form.DEPTH, "foot": form.TRANSOM_LOW
    }  # fmt: skip
    assert carrier.anchors["length"].numbers["stem"] == pytest.approx(form.LENGTH, abs=1e-6)


# Maps.


def test_a_hull_of_another_size_measures_in_proportion(
    bulk_carrier: ah.Hull, carrier: Measures
) -> None:
    """A similarity multiplies every length by its factor and leaves angles, to 1e-9."""
    k, ship = 1.1, bulk_carrier.particulars
    sizes = {name: k * getattr(ship, name) for name in ("length", "breadth", "depth", "draught")}
    with taken_back(bulk_carrier) as hull:
        with hull.edit("larger") as edit:
            edit.transform(scale=(k, k, k), drivers=["sections", "waterlines", "buttocks"])
        state = copy_state(hull.state)
    state.settings.particulars.data[0] = attrs.evolve(ship, **sizes)
    found = measure_all(state)
    assert list(found) == list(carrier)
    for name, value in carrier.items():
        factor = {"m": k, "m2": k * k}.get(carrier.anchors[name].unit, 1.0)
        assert found[name] == pytest.approx(factor * value, abs=1e-9), name


def test_a_broader_hull_has_the_same_heights_and_no_bossing_circle(
    bulk_carrier: ah.Hull, carrier: Measures
) -> None:
    """Breadths follow a ratio of y; an ellipse is no bossing circle, but has a height.

    The breadth of the ship is that of her particulars; beside it stands how broad she is drawn.
    """
    state = mapped(bulk_carrier, lambda p: p * [1.0, 1.03, 1.0])
    found = measure_all(state)
    assert found.absent == {"bossing_radius": "parent has no bossing circle"}
    exact = ("transom_half_breadth", "flat_of_bottom")
    for name in exact:
        assert found[name] == pytest.approx(1.03 * carrier[name], abs=1e-6)
    assert found["breadth"] == bulk_carrier.particulars.breadth
    assert found.anchors["breadth"].numbers["drawn"] == pytest.approx(1.03 * 50.0, abs=1e-6)
    assert found["bulb_half_breadth"] == pytest.approx(
        1.03 * carrier["bulb_half_breadth"], abs=2e-3
    )
    same = ("shaft_height", "transom_height", "bulb_height", "bulb_length", "depth",
            "parallel_body_start", "parallel_body_end", "deadrise_deg", "stem_rake_deg",
            )  # fmt: skip
    for name in same:
        assert found[name] == pytest.approx(carrier[name], abs=1e-6), name


def broader(amplitude: float, xyz: FloatArray) -> FloatArray:
    """Places moved athwart and along the ship; what stands across it stays so."""
    along = amplitude * np.sin(xyz[:, 0] / 40.0 + 1.0)
    out = 0.04 * amplitude * np.cos(xyz[:, 2] / 9.0) * xyz[:, 1]
    return xyz + np.column_stack([along, out, 0.0 * along])


def higher(amplitude: float, xyz: FloatArray) -> FloatArray:
    """Places moved up and down, all along the ship alike."""
    return xyz + amplitude * np.cos(xyz[:, 2:] / 9.0) * [0.0, 0.0, 1.0]


@pytest.mark.parametrize(
    ("mapping", "drivers"), [(broader, ["sections"]), (higher, ["sections", "buttocks"])]
)
def test_values_follow_a_map_evenly(
    bulk_carrier: ah.Hull,
    carrier: Measures,
    mapping: Callable[[float, FloatArray], FloatArray],
    drivers: list[str],
) -> None:
    """Steps of a map by 2e-7 m change each value by as little, and twice as much in two steps.

    So a value can be brought to 1e-6 m. None is lost but the circle, of which nothing is left.
    """
    zero, one, two = (
        measure_all(mapped(bulk_carrier, partial(mapping, size), *drivers))
        for size in (1e-2, 1e-2 + 2e-7, 1e-2 + 4e-7)
    )
    assert list(zero) == [name for name in carrier if name != "bossing_radius"]
    for name, value in zero.items():
        # an area, m2, changes by as many metres as it is high
        per = 10.0 if zero.anchors[name].unit == "m2" else 1.0
        step = (one[name] - value) / per
        assert abs(step) <= 2e-6, name
        assert (two[name] - one[name]) / per == pytest.approx(step, abs=1e-8), name


def test_a_bilge_stretched_about_its_corner_is_measured_larger(box: ah.Hull) -> None:
    """An arc stays one: ratio 1.25 makes its radius 1.25 times as large, its flat narrower."""
    fade = BlendChain.through([BILGE, 4.0 * BILGE], [1.0, 0.0])
    layer = CornerLayer("bilge", BlendChain.constant(1.0), HALF, 0.0, 0.0, 1.25, 1.25, fade)
    state = mapped(box, partial(through, layer))
    found = measure_all(state, ["bilge_radius", "flat_of_bottom"])
    assert found["bilge_radius"] == pytest.approx(1.25 * BILGE, abs=1e-9)
    assert found["flat_of_bottom"] == pytest.approx(HALF - 1.25 * BILGE, abs=1e-9)


def test_a_bilge_that_is_no_arc_grows_with_a_stretch_about_its_corner(box: ah.Hull) -> None:
    """Through three places the radius of an elliptic bilge is homogeneous in its size."""
    radius = []
    for by in (1.0, 1.2):
        fade = BlendChain.through([1.3 * BILGE, 4.0 * BILGE], [1.0, 0.0])
        layer = CornerLayer("bilge", BlendChain.constant(1.0), HALF, 0.0, 0.0, by, 1.3 * by, fade)
        state = mapped(box, partial(through, layer))
        found = measure_all(state, ["bilge_radius"]).anchors["bilge_radius"]
        assert found.value is not None
        assert "half-way between" in found.how
        radius.append(found.value)
    assert radius[1] == pytest.approx(1.2 * radius[0], rel=1e-4)


@pytest.mark.parametrize("slope", [0.4, 5.0])
def test_the_deadrise_is_the_slope_of_the_bottom(box: ah.Hull, slope: float) -> None:
    """A shear of the whole section by tan(beta) y is a deadrise of beta degrees."""
    q = np.tan(np.radians(slope))
    state = mapped(box, lambda p: p + p[:, 1:2] * [0.0, 0.0, q])
    found = measure_all(state, ["deadrise_deg", "bilge_radius"])
    assert found["deadrise_deg"] == pytest.approx(slope, abs=1e-9)
    corner = found.anchors["bilge_radius"].numbers
    assert (corner["corner_y"], corner["corner_z"]) == pytest.approx((HALF, q * HALF), abs=1e-9)


# What a hull does not have.


def test_wigley_has_neither_bulb_nor_transom_nor_bilge() -> None:
    """Each absent parameter has a reason; the others are there."""
    found = measure(ah.examples.wigley())
    no_bulb = NO_BULB.format(6.25)
    assert dict(found.absent) == {
        "shaft_height": "parent has no bossing end, and its stern profile no hub below the draught",
        "bossing_radius": "parent has no bossing circle",
        "transom_height": "parent has no transom across the ship",
        "transom_half_breadth": "parent has no transom across the ship",
        "bulb_height": no_bulb,
        "bulb_half_breadth": no_bulb,
        "bulb_length": no_bulb,
        "bulb_area": no_bulb,
        "bulb_section_height": no_bulb,
        "bilge_radius": "parent has no bilge between a flat bottom and a flat side amidships",
        "flat_of_bottom": "parent has no flat of bottom amidships",
        "parallel_body_start": "parent has no parallel middle body",
        "parallel_body_end": "parent has no parallel middle body",
        "parallel_body_length": "parent has no parallel middle body",
    }
    assert found["breadth"] == pytest.approx(10.0, abs=1e-9)
    assert found["stem_rake_deg"] == 0.0
    # y = B/2 (1 - (1 - z/T)^2): at the keel dz/dy = T / B.
    assert found["deadrise_deg"] == pytest.approx(np.degrees(np.arctan(6.25 / 10.0)), abs=1.0)


def test_series_60_has_a_bilge_and_a_flat_bottom(series60_70: ah.Hull) -> None:
    """A merchant form without bulb, transom and drawn boss."""
    found = measure(series60_70)
    assert {"bulb_length", "transom_height", "bossing_radius"} <= set(found.absent)
    assert found["flat_of_bottom"] + found["bilge_radius"] == pytest.approx(
        0.5 * found["breadth"], abs=0.02
    )


def test_a_box_is_parallel_from_end_to_end(box: ah.Hull) -> None:
    """Without borders of flats, sections that are alike make the parallel body."""
    found = measure(box)
    ends = found["parallel_body_start"], found["parallel_body_end"]
    assert ends == pytest.approx((0.0, LENGTH), abs=1e-6)
    assert found["bilge_radius"] == pytest.approx(BILGE, abs=1e-9)
    assert found["flat_of_bottom"] == pytest.approx(HALF - BILGE, abs=1e-9)
    assert (found["depth"], found["draught"]) == (DEPTH, DRAUGHT)
    assert found.absent["stem_rake_deg"] == f"no profile forward at z={DRAUGHT:.3f}"


@pytest.mark.parametrize(
    ("adoption", "ends"),
    [(0.002, None), (0.005, None), (0.01, (101.25, 112.5))],
    ids=["sections differ", "a buttock swells between them", "both within"],
)
def test_sections_are_equal_as_far_as_adoption_knows_them(
    shipped: Shipped, adoption: float, ends: tuple[float, float] | None
) -> None:
    """Two are 3.1 mm apart, and a buttock between them 9.2 mm off."""
    state = copy_state(shipped("container_ship_225m").state)
    state.tolerances = attrs.evolve(state.tolerances, adoption=adoption)
    found = measure_all(state, ["parallel_body_start", "parallel_body_end"])
    assert (tuple(found.values()) or None) == ends


@pytest.mark.parametrize("radius", [2.3, 2.37, 2.6])
def test_another_bilge_radius_leaves_the_parallel_body(
    bulk_carrier: ah.Hull, radius: float
) -> None:
    """Beyond it the border of the side is off its level, by a tenth of a millimetre and more."""
    before, varied = bulk_carrier.measure(), bulk_carrier.vary(set={"bilge_radius": radius})
    after = varied.hull.measure()
    for name in ("parallel_body_start", "parallel_body_end", "parallel_body_length"):
        assert after[name] == before[name]


def test_many_small_steps_of_a_border_are_no_level_run() -> None:
    """Each is within the tolerance, all together are not."""
    xyz = np.zeros((12, 3))
    xyz[:, 0] = np.arange(12.0)
    xyz[4:, 2] = 6e-4 * np.arange(8.0)
    for way in (xyz, xyz[::-1]):
        hull = cast("DrawnCurves", SimpleNamespace(one=lambda _, way=way: SimpleNamespace(xyz=way)))
        assert _level_run(hull, 0, 2, 7e-4).ends == (0.0, 5.0)


def test_the_dtc_is_measured_at_its_own_length(dtc: ah.Hull) -> None:
    """A rounded hub has a height but no circle; with Lpp 355 m the bulb lies before FP.

    On her mesh the body is parallel from x = 155 to 183 m, as far as facets go: the two stations in
    it are its ends, though adoption has left them 6.6 mm apart.
    """
    state = copy_state(dtc.state)
    state.settings.particulars.data[0] = attrs.evolve(state.particulars, length=355.0)
    found = measure_all(state)
    assert dict(found.absent) == {"bossing_radius": "parent has no bossing circle"}
    ends = found["parallel_body_start"], found["parallel_body_end"]
    assert 154.0 < ends[0] < ends[1] < 184.0
    assert found["parallel_body_length"] == ends[1] - ends[0]
    assert "within 14.1 mm" in found.anchors["parallel_body_start"].how
    assert found["shaft_height"] == pytest.approx(5.0, abs=0.05)
    assert found["bulb_length"] == pytest.approx(11.07, abs=0.02)
    assert found["transom_height"] == pytest.approx(15.3, abs=0.01)
    assert found["bilge_radius"] == pytest.approx(4.71, abs=0.02)
    assert found["flat_of_bottom"] == pytest.approx(20.85, abs=0.1)


# The mapping.


def test_names_and_units_are_those_of_the_catalogue(carrier: Measures) -> None:
    """Twenty-eight measures and two amplitudes; angles end in _deg."""
    assert len(MEASURES) == 28
    assert tuple(carrier.anchors) == (*MEASURES, *AMPLITUDES)
    for name, anchor in carrier.anchors.items():
        assert anchor.name == name
        other = {"waterline_fullness": "-", "bulb_area": "m2"}
        assert anchor.unit == ("deg" if name.endswith("_deg") else other.get(name, "m"))


def test_only_what_was_asked_for_is_measured(bulk_carrier: ah.Hull, carrier: Measures) -> None:
    """One name may come alone, several in any order, and the values are the same."""
    assert dict(measure(bulk_carrier, only="depth")) == {"depth": carrier["depth"]}
    two = measure(bulk_carrier, only=["flat_of_bottom", "breadth"])
    assert list(two) == ["flat_of_bottom", "breadth"]
    assert two["breadth"] == carrier["breadth"]


def test_what_is_absent_is_no_key_and_says_why() -> None:
    """Asked for nevertheless, the error has the reason; `get` and `in` work as for any mapping."""
    found = measure(ah.examples.wigley(), only=["bulb_length", "breadth"])
    assert list(found) == ["breadth"]
    assert "bulb_length" not in found
    assert found.get("bulb_length") is None
    with pytest.raises(AbsentParameterError) as caught:
        found["bulb_length"]
    assert str(caught.value).startswith(f"cannot measure 'bulb_length': {NO_BULB.format(6.25)}")


@pytest.mark.parametrize(
    ("only", "error"),
    [(["breadht"], UnknownNameError), ([3], WrongTypeError), (7, WrongTypeError)],
)
def test_bad_names_are_refused(box: ah.Hull, only: object, error: type[AssocHullError]) -> None:
    """A name that is none of a parameter, or no name."""
    with pytest.raises(error):
        measure(box, only=only)  # type: ignore[arg-type]


def test_something_else_than_a_hull_is_refused() -> None:
    """Tables alone are no hull."""
    with pytest.raises(WrongTypeError):
        measure(3)  # type: ignore[arg-type]


def test_an_anchor_has_a_value_or_a_reason() -> None:
    """Neither and both are mistakes; places and numbers are frozen."""
    with pytest.raises(BadInputError):
        MeasuredParameter("breadth", "m", None)
    with pytest.raises(BadInputError):
        MeasuredParameter("breadth", "m", 3.0, reason="none")
    anchor = MeasuredParameter("breadth", "m", 3.0, places=[[0.0, 1.5, 0.0]], numbers={"x": 0.0})
    assert not anchor.places.flags.writeable
    with pytest.raises(TypeError):
        anchor.numbers["x"] = 1.0  # type: ignore[index]
