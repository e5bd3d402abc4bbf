"""Resistance of hulls as they float: where inputs come from, the output that studies rank by."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.errors import BadInputError, OutOfRangeError, UnknownNameError
from assoc_hull.hydro import HoltropShip, Resistance, holtrop
from tests.cases.test_hydrostatics_refused import opened, spoilt_wigley

SERVICE = {
    "bulk_carrier": 14.0, "dtc": 20.0, "series60_60": 16.0, "series60_70": 15.0,
    "container_ship": 20.0,
}  # fmt: skip
"""Ships, and a speed at which each may run, kn."""

SYMBOLS = {"L": "LWL", "B": "B", "T_F": "T_F", "T_A": "T_A", "V": "V", "lcb": "LCB_WL",
           "C_M": "C_M", "S": "WSA"}  # fmt: skip


@pytest.fixture(scope="module")
def hulls(
    shipped: Callable[[str], ah.Hull], bulk_carrier: ah.Hull, dtc: ah.Hull,
    series60_60: ah.Hull, series60_70: ah.Hull,
) -> dict[str, ah.Hull]:  # fmt: skip
    """The hulls; nobody edits them here."""
    return {
        "bulk_carrier": bulk_carrier, "dtc": dtc, "series60_60": series60_60,
        "series60_70": series60_70, "container_ship": shipped("container_ship_225m"),
    }  # fmt: skip


@pytest.fixture(scope="module")
def small() -> ah.Hull:
    """A hull of few lines; no test changes it."""
    return ah.examples.wigley(stations=9, waterlines=6)


def inputs(found: Resistance) -> dict[str, tuple[float, str, str]]:
    """Value, source and note by symbol."""
    return {each.symbol: (each.value, each.source, each.note) for each in found.inputs}


# --------------------------------------------------------------------------------------
# Where numbers come from.


@pytest.mark.parametrize("name", SERVICE)
def test_inputs_are_the_form_parameters_of_the_hull(hulls: dict[str, ah.Hull], name: str) -> None:
    """To the bit, each with its source; what she lacks is nil with the reason."""
    hull = hulls[name]
    found = inputs(hull.resistance(SERVICE[name]))
    values = hull.form_parameters()
    for symbol, entry in SYMBOLS.items():
        assert found[symbol][0] == values[entry].number
    assert {found[symbol][1] for symbol in ("L", "V", "lcb", "C_M", "C_WP", "S")} == {"measured"}
    assert found["B"][1] == found["T_A"][1] == "particulars"
    plane, length, breadth = (values[each].number or 0.0 for each in ("Aw", "LWL", "B"))
    assert found["C_WP"][0] == plane / (length * breadth)
    assert found["i_E"][1] == "regression"
    assert f"{values['iE'].number:.6g} measured" in found["i_E"][2]
    for symbol, entry in (("A_BT", "A_BT"), ("h_B", "h_B"), ("A_T", "A_T")):
        number = values[entry].number
        assert found[symbol][:2] == (number or 0.0, "measured")
        assert number is not None or found[symbol][2] in ("no bulb", "no transom")
    assert found["C_stern"][:2] == (0.0, "default")


def test_the_centre_of_buoyancy_counts_from_the_middle_of_the_waterline(
    series60_70: ah.Hull,
) -> None:
    """Which ends at FP, and abaft AP: so it is not that of Lpp."""
    record = series60_70.hydrostatics(estimate=False)
    fore = series60_70.particulars.length
    middle = fore - 0.5 * record.lwl
    found = inputs(series60_70.resistance(15.0))["lcb"][0]
    assert found == pytest.approx(100.0 * (record.lcb - middle) / record.lwl, rel=1e-9)
    assert found - record.lcb_percent > 0.5


@pytest.mark.parametrize("name", SERVICE)
def test_ships_need_what_such_ships_need(hulls: dict[str, ah.Hull], name: str) -> None:
    """At a usual speed 400 to 1100 of the Admiralty's coefficient, on effective power.

    That is D^(2/3) V^3 / P, in t, kn and kW: of brake power it is 300 to 800.
    """
    hull, speed = hulls[name], SERVICE[name]
    found = hull.resistance([0.8 * speed, speed])
    weight = hull.hydrostatics(estimate=False).displacement
    assert 400.0 < weight ** (2.0 / 3.0) * speed**3 / found.power[1] < 1100.0
    assert found.total[1] > found.total[0] > 0.0
    assert found.warnings == ()


def test_draughts_are_those_she_floats_at(bulk_carrier: ah.Hull) -> None:
    """Fore and aft; the bulb is nearer to the surface then, and its height is capped and told."""
    found = bulk_carrier.resistance(13.0, draughts=(9.5, 7.2))
    told = inputs(found)
    assert told["T_A"][:2] == (9.5, "given")
    assert told["T_F"][:2] == (7.2, "given")
    assert told["C_M"][0] < 1.0
    assert any("0.6 T_F, 4.320 m, is taken" in each for each in found.warnings)
    assert any("B/T" in each for each in found.warnings)
    level = bulk_carrier.resistance(13.0, draught=9.0)
    assert inputs(level)["T_F"][:2] == (9.0, "given")


def test_an_immersed_transom_is_the_one_at_rest(bulk_carrier: ah.Hull) -> None:
    """Dry at her draught, wet at 20 m: then it resists, and takes off what waves take."""
    dry, wet = (bulk_carrier.resistance(14.0, draught=each) for each in (18.0, 20.0))
    area = bulk_carrier.form_parameters(draught=20.0, only=["ATT"])["ATT"].number
    assert inputs(dry)["A_T"][0] == dry.transom[0] == 0.0
    assert inputs(wet)["A_T"][0] == area
    assert wet.coefficients["c5"] < 1.0 == dry.coefficients["c5"]


STATED = {
    "c_stern": 10.0, "appendage_area": 12.0, "appendage_factor": 1.5, "thruster_diameter": 1.0,
    "thruster_coefficient": 0.004, "wetted_surface": 1500.0, "entrance_deg": 9.0,
    "bulb_area": 2.0, "bulb_height": 2.5, "transom_area": 1.5, "rho": 1.0, "nu": 1.14e-6,
    "roughness": 2e-4,
}  # fmt: skip


@pytest.mark.parametrize("method", ["1984", "1982"])
def test_what_is_stated_stands_in_the_place_of_what_is_measured(
    small: ah.Hull, method: Any
) -> None:
    """Each is told as given; the numbers are those of a ship with them."""
    found = small.resistance([8.0, 16.0], method=method, **STATED)  # type: ignore[arg-type]
    told = {each.name: (each.value, each.source) for each in found.inputs}
    for name, value in STATED.items():
        assert told[name] == (value, "given")
    sure = {name: value for name, (value, _) in told.items()}
    again = holtrop(HoltropShip(**sure), [8.0, 16.0], method)
    assert np.array_equal(again.as_array(), found.as_array())
    assert "the regression gives" in inputs(found)["S"][2]


def test_a_bulb_may_be_left_out(bulk_carrier: ah.Hull) -> None:
    """By an area of nil alone; what was measured is told beside it."""
    found = bulk_carrier.resistance(14.0, bulb_area=0.0)
    assert found.bulb[0] == 0.0
    assert inputs(found)["h_B"] == (0.0, "given", "no bulb")
    assert "115.918 measured" in inputs(found)["A_BT"][2]


def test_the_same_call_gives_the_same_bits(small: ah.Hull) -> None:
    """Whatever was asked before."""
    first = small.resistance([8, 16], c_stern=10)
    small.resistance([3.0], draught=5.0)
    again = small.resistance([8.0, 16.0], c_stern=10.0)
    assert str(first) == str(again)
    assert np.array_equal(first.as_array(), again.as_array())


# --------------------------------------------------------------------------------------
# Refusals.


@pytest.mark.parametrize(
    ("given", "error", "words"),
    [
        ({"speeds": 0.0}, BadInputError, "speeds is 0.0"),
        ({"speeds": [10.0, float("nan")]}, BadInputError, "speeds is"),
        ({"speeds": ["8", "16"]}, BadInputError, "give numbers, not text"),
        ({"method": "Holtrop"}, BadInputError, "use 1984 or 1982"),
        ({"draught": 40.0}, OutOfRangeError, "draught of 40 m"),
        ({"draught": 0.0}, OutOfRangeError, "draught of 0 m"),
        ({"draught": 5.0, "draughts": (5.0, 5.0)}, BadInputError, "draught"),
        ({"appendage_area": 20.0}, BadInputError, "without appendage_factor"),
        ({"bulb_area": 2.0}, BadInputError, "without bulb_height"),
        ({"rho": 1025.0}, OutOfRangeError, "rho of 1025"),
    ],
)
def test_what_cannot_be_used_is_refused(
    small: ah.Hull, given: dict[str, Any], error: type[ah.AssocHullError], words: str
) -> None:
    """With the number and what would do."""
    with pytest.raises(error, match=words):
        small.resistance(**{"speeds": 10.0, **given})


def test_a_doubtful_hull_is_refused_by_its_line() -> None:
    """As by hydrostatics."""
    with pytest.raises(BadInputError, match="ST 7 is open"):
        spoilt_wigley(opened).resistance(10.0, draught=5.5)


# --------------------------------------------------------------------------------------
# As an output.


def test_a_study_tells_the_resistance_of_each_variant(small: ah.Hull) -> None:
    """That of the hull itself, at its own draught; and comes to one that is asked for."""
    names = ["R 12 kn", "R 15.5 kn"]
    found = small.study(set={"breadth": [9.8, 10.2], "draught": [6.0, 6.3]}, outputs=names)
    table = found.table()
    for i in range(2):
        wanted = found.hull(i).resistance([12.0, 15.5]).total
        np.testing.assert_allclose([table[name][i] for name in names], wanted, rtol=1e-12)
    assert found.run.units["R 12 kn"] == "kN"
    aim = float(small.resistance(12.0).total[0]) * 1.02
    met = small.study(reach={"R 12 kn": aim}, free=["breadth"])
    assert met.table()["R 12 kn"][0] == pytest.approx(aim, rel=1e-9)


def test_a_variation_comes_to_a_resistance(small: ah.Hull) -> None:
    """Measured on the hull that it makes."""
    aim = float(small.resistance(14.0).total[0]) * 0.98
    met = small.vary(reach={"R 14 kn": aim}, free=["breadth"])
    assert met.hull.resistance(14.0).total[0] == pytest.approx(aim, rel=1e-8)


@pytest.mark.parametrize("parameter", ["breadth", "draught"])
def test_its_derivative_is_that_of_hulls_beside_it(small: ah.Hull, parameter: str) -> None:
    """By breadth and design draught, against hulls that `vary` makes; marked as a difference."""
    found = small.sensitivities(["R 15 kn", "volume"], [parameter])
    assert found.exact.tolist() == [False, True]
    now, step = small.measure()[parameter], 0.02
    sides = [
        small.vary(set={parameter: now + by}).hull.resistance(15.0).total[0] for by in (step, -step)
    ]
    slope = (sides[0] - sides[1]) / (2.0 * step)
    assert found.of("R 15 kn", parameter) == pytest.approx(slope, rel=1e-4)


@pytest.mark.parametrize(
    ("name", "error", "words"),
    [
        ("R 0 kn", BadInputError, "give speeds above 0"),
        ("R nan kn", BadInputError, "speed in 'R nan kn'"),
        ("R fast kn", BadInputError, "up to 1e[+]06 kn"),
        ("R 14", UnknownNameError, "'R 14 kn'"),
    ],
)
def test_a_name_that_tells_no_speed_is_refused(
    small: ah.Hull, name: str, error: type[ah.AssocHullError], words: str
) -> None:
    """With what is wrong, or the form that it has."""
    with pytest.raises(error, match=words):
        small.sensitivities([name], ["breadth"])
