"""Holtrop's regression: the papers' own examples, laws that any resistance keeps, refusals."""

from __future__ import annotations

import contextlib
import math
import warnings
from typing import Any

import attrs
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import assoc_hull as ah
from assoc_hull.analysis.resistance.holtrop import TYPES, Method, holtrop, types_of
from assoc_hull.analysis.resistance.holtrop_ship import HoltropShip
from assoc_hull.errors import AssocHullError, BadInputError, OutOfRangeError
from tests.unit.test_bad_arguments import spoilt

SHIP_1982 = HoltropShip(
    length=205.0, breadth=32.0, draught_fore=10.0, draught_aft=10.0, volume=37500.0, lcb=-0.75,
    cm=0.98, cwp=0.75, bulb_area=20.0, bulb_height=4.0, transom_area=16.0, c_stern=10.0,
    appendage_area=50.0, appendage_factor=1.5,
)  # fmt: skip
"""The container ship of the paper of 1982."""

SHIP_1984 = HoltropShip(
    length=50.0, breadth=12.0, draught_fore=3.1, draught_aft=3.3, volume=900.0, lcb=-4.5,
    cm=0.78, cwp=0.80, transom_area=10.0, appendage_area=50.0, appendage_factor=3.0,
    entrance_deg=25.0,
)  # fmt: skip
"""The fast ship of the paper of 1984, which has the wetted surface of the regression."""

PARTS = ("friction", "form", "appendages", "waves", "bulb", "transom", "correlation")

PRINTED_1982 = {
    "S": (7381.45, 2), "LR": (81.385, 3), "1+k1": (1.156, 3), "iE": (12.08, 2), "c1": (1.398, 3),
    "c2": (0.7595, 4), "c3": (0.02119, 5), "c5": (0.9592, 4), "m1": (-2.1274, 4),
    "lambda": (0.6513, 4), "CA": (0.000352, 6), "c15": (-1.69385, 5),
}  # fmt: skip
"""As printed, with the digits after the point; the paper leaves out the sign of c15."""

PRINTED_1984 = {"S": (584.9, 1), "1+k1": (1.297, 3), "c5": (0.7329, 4), "c17": (1.4133, 4),
                "m3": (-2.0298, 4), "lambda": (0.7440, 4)}  # fmt: skip

TABLE_1984 = np.array(
    [[25, 475, 21, 25, 662], [27, 512, 24, 16, 715], [29, 539, 28, 2, 756],
     [31, 564, 31, 0, 807], [33, 590, 35, 0, 864], [35, 618, 39, 0, 925]], np.float64
)  # fmt: skip
"""Speed (kn), RW, RAPP, RTR and the total (kN), as printed."""


# --------------------------------------------------------------------------------------
# What the papers print.


@pytest.mark.parametrize("name", PRINTED_1982)
def test_a_coefficient_of_1982_is_that_of_the_paper(name: str) -> None:
    """To all digits that it prints."""
    value, digits = PRINTED_1982[name]
    assert round(holtrop(SHIP_1982, 25.0, "1982").coefficients[name], digits) == value


@pytest.mark.parametrize(("name", "value", "digits"), [("m2", -0.17087, 5), ("CF", 0.001390, 6)])
def test_a_coefficient_of_1982_by_speed_is_that_of_the_paper(
    name: str, value: float, digits: int
) -> None:
    """To all digits that it prints, at 25 kn."""
    found = holtrop(SHIP_1982, 25.0, "1982").by_speed[name]
    assert round(float(found[0]), digits) == value


def test_the_resistance_of_1982_is_that_of_the_paper() -> None:
    """RF, RAPP, RB and RTR to 0.01 kN and the digits; RW and the total to 0.1 %; RA to 0.7 %."""
    found = holtrop(SHIP_1982, 25.0, "1982")
    parts = {name: float(getattr(found, name)[0]) for name in PARTS}
    assert parts["friction"] == pytest.approx(869.63, abs=0.011)
    assert parts["appendages"] == pytest.approx(8.83, abs=0.011)
    assert round(parts["bulb"], 3) == 0.049
    assert parts["transom"] == 0.0
    assert parts["waves"] == pytest.approx(557.11, rel=1e-3)
    assert parts["correlation"] == pytest.approx(221.98, rel=7e-3)
    assert float(found.total[0]) == pytest.approx(1793.26, rel=1e-3)


@pytest.mark.parametrize("name", PRINTED_1984)
def test_a_coefficient_of_1984_is_that_of_the_paper(name: str) -> None:
    """To all digits that it prints."""
    value, digits = PRINTED_1984[name]
    assert round(holtrop(SHIP_1984, 25.0).coefficients[name], digits) == value


def test_the_resistance_of_1984_is_that_of_the_paper() -> None:
    """At six speeds: RW, RAPP and RTR within 1 kN, the total within 1 %."""
    found = holtrop(SHIP_1984, TABLE_1984[:, 0])
    parts = np.column_stack([found.waves, found.appendages, found.transom])
    assert np.abs(parts - TABLE_1984[:, 1:4]).max() < 1.0
    np.testing.assert_allclose(found.total, TABLE_1984[:, 4], rtol=0.01)


def test_the_methods_differ_by_form_factor_and_humps_alone() -> None:
    """On the ship of 1982 by 1.2 % of the total."""
    old, new = (holtrop(SHIP_1982, 25.0, method) for method in ("1982", "1984"))
    assert float(new.total[0] / old.total[0]) == pytest.approx(1.012, abs=5e-4)
    for name in ("friction", "appendages", "bulb", "transom", "correlation"):
        assert np.array_equal(getattr(new, name), getattr(old, name))


# --------------------------------------------------------------------------------------
# Laws.

METHODS: tuple[Method, ...] = ("1984", "1982")
SHIPS = {"1982": SHIP_1982, "1984": SHIP_1984}
SPEEDS = st.lists(st.floats(0.5, 45.0), min_size=1, max_size=40)


@given(st.sampled_from(list(SHIPS.values())), st.sampled_from(METHODS), SPEEDS)
def test_each_speed_alone_has_the_same_bits(
    ship: HoltropShip, method: Method, speeds: list[float]
) -> None:
    """Whatever others stand beside it; and the total is the sum of the parts."""
    whole = holtrop(ship, speeds, method)
    assert len(whole) == len(speeds)
    for i, speed in enumerate(speeds):
        alone = holtrop(ship, speed, method)
        assert alone.as_array()[0] == whole.as_array()[i]
    parts = [getattr(whole, name) for name in PARTS]
    np.testing.assert_allclose(whole.total, np.sum(parts, axis=0), rtol=1e-14)
    assert all((part >= 0.0).all() for part in parts)
    np.testing.assert_allclose(
        whole.power, whole.total * whole.speeds / 1.9438444924406, rtol=1e-12
    )


@given(st.sampled_from(list(SHIPS.values())), st.floats(0.9, 1.2))
def test_forces_grow_with_the_density(ship: HoltropShip, rho: float) -> None:
    """All of them by the same factor, at the same viscosity."""
    speeds = [8.0, 16.0, 24.0]
    heavy = holtrop(attrs.evolve(ship, rho=rho), speeds)
    plain = holtrop(ship, speeds)
    for name in PARTS:
        wanted = getattr(plain, name) * (rho / ship.rho)
        np.testing.assert_allclose(getattr(heavy, name), wanted, rtol=1e-13)


@given(st.sampled_from(list(SHIPS.values())), st.sampled_from(METHODS), st.floats(0.5, 1.5))
def test_what_makes_waves_follows_froude(ship: HoltropShip, method: Method, size: float) -> None:
    """At equal Froude numbers RW, RB and RTR of similar ships go with the cube of their size."""
    power = {"length": 1, "breadth": 1, "draught_fore": 1, "draught_aft": 1, "volume": 3,
             "bulb_area": 2, "bulb_height": 1, "transom_area": 2}  # fmt: skip
    scaled = {name: getattr(ship, name) * size**each for name, each in power.items()}
    speeds = np.array([6.0, 14.0, 22.0, 30.0])
    small = holtrop(ship, speeds, method)
    large = holtrop(attrs.evolve(ship, **scaled), speeds * math.sqrt(size), method)
    np.testing.assert_allclose(large.froude, small.froude, rtol=1e-13)
    for name in ("waves", "bulb", "transom"):
        wanted = getattr(small, name) * size**3
        np.testing.assert_allclose(getattr(large, name), wanted, rtol=1e-9, atol=1e-300)


@pytest.mark.parametrize("ship", SHIPS.values(), ids=SHIPS)
def test_friction_and_allowance_rise_with_speed(ship: HoltropShip) -> None:
    """So do appendages, and a bulb; waves have humps and hollows."""
    found = holtrop(ship, np.linspace(1.0, 30.0, 400))
    for name in ("friction", "form", "appendages", "correlation"):
        assert (np.diff(getattr(found, name)) > 0.0).all()
    assert (np.diff(found.bulb) >= 0.0).all()


def test_what_is_stated_adds_what_it_should() -> None:
    """Surface, appendages and a thruster in proportion; a rough shell to the allowance alone."""
    plain = holtrop(SHIP_1982, [10.0, 20.0])
    surface = plain.coefficients["S"]
    wet = holtrop(attrs.evolve(SHIP_1982, wetted_surface=2.0 * surface), [10.0, 20.0])
    for name in ("friction", "form", "correlation"):
        np.testing.assert_allclose(getattr(wet, name), 2.0 * getattr(plain, name), rtol=1e-14)
    bare = holtrop(attrs.evolve(SHIP_1982, appendage_area=0.0, appendage_factor=None), [10.0, 20.0])
    assert (bare.appendages == 0.0).all()
    bored = attrs.evolve(SHIP_1982, thruster_diameter=2.0, thruster_coefficient=0.005)
    more = holtrop(bored, [10.0, 20.0]).appendages - plain.appendages
    speed = np.array([10.0, 20.0]) * 1852.0 / 3600.0
    np.testing.assert_allclose(more, 1.025 * speed**2 * math.pi * 4.0 * 0.005, rtol=1e-12)
    rough = holtrop(attrs.evolve(SHIP_1982, roughness=300e-6), [10.0, 20.0])
    added = (0.105 * 300e-6 ** (1.0 / 3.0) - 0.005579) / 205.0 ** (1.0 / 3.0)
    assert rough.coefficients["CA"] - plain.coefficients["CA"] == pytest.approx(added, rel=1e-9)
    assert np.array_equal(rough.waves, plain.waves)


def test_a_transom_that_runs_clear_resists_no_more() -> None:
    """Up to a Froude number of 5 on its immersion, V / sqrt(2 g A_T / (B + B C_WP))."""
    clear = 5.0 * math.sqrt(2.0 * 9.81 * 10.0 / (12.0 * 1.8)) * 3600.0 / 1852.0
    found = holtrop(SHIP_1984, [0.99 * clear, clear + 1e-9, 1.2 * clear]).transom
    assert found[0] > 0.0
    assert found[1:].tolist() == [0.0, 0.0]


@pytest.mark.parametrize("froude", [0.4, 0.55])
def test_the_two_formulas_of_waves_join(froude: float) -> None:
    """The resistance of 1984 has no jump where it goes from one to the other, and back."""
    speed = froude * math.sqrt(9.81 * 205.0) * 3600.0 / 1852.0
    slow, fast = holtrop(SHIP_1982, [speed * (1.0 - 1e-9), speed * (1.0 + 1e-9)]).waves
    assert fast == pytest.approx(slow, rel=1e-7)


def test_between_the_formulas_the_resistance_goes_straight() -> None:
    """Over the Froude number, from 0.4 to 0.55."""
    froude = np.linspace(0.4, 0.55, 7)[1:-1]
    found = holtrop(SHIP_1982, froude * math.sqrt(9.81 * 205.0) * 3600.0 / 1852.0)
    assert np.abs(np.diff(found.waves, 2)).max() < 1e-8 * found.waves.max()


def test_without_a_bulb_there_is_none_of_it() -> None:
    """Neither its resistance, nor what it takes off the waves."""
    found = holtrop(attrs.evolve(SHIP_1982, bulb_area=0.0, bulb_height=0.0), [10.0, 25.0])
    assert found.coefficients["c2"] == 1.0
    assert "PB" not in found.coefficients
    assert (found.bulb == 0.0).all()


# --------------------------------------------------------------------------------------
# The result.


def test_a_result_is_frozen_and_has_its_table() -> None:
    """As arrays by the heads, and as one structured array with the same numbers."""
    found = holtrop(SHIP_1984, [25.0, 30.0])
    table, rows = found.table(), found.as_array()
    assert tuple(table) == rows.dtype.names
    assert list(table) == ["V", "Fn", "RF", "form", "RAPP", "RW", "RB", "RTR", "RA", "R", "PE"]
    for head, column in table.items():
        assert np.array_equal(rows[head], column)
    for array in (found.speeds, found.friction, found.waves, found.by_speed["CF"]):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0.0
    with pytest.raises(attrs.exceptions.FrozenInstanceError):
        setattr(found, "method", "1982")  # noqa: B010 - the type checker knows that it is frozen


def test_it_prints_parts_inputs_coefficients_and_warnings() -> None:
    """A row a speed, a line an input with its source, and what to mind at last."""
    lines = str(holtrop(SHIP_1984, [25.0, 30.0], name="Fast")).splitlines()
    assert lines[0] == "Fast: Resistance by Holtrop 1984; V in kn, R in kN, PE in kW"
    assert lines[2].split()[:4] == ["25.00", "0.5807", "82.0", "24.4"]
    rows = [line.split() for line in lines]
    assert ["S", "584.906", "m2", "regression"] in rows
    assert ["i_E", "25", "deg", "given:", "the", "regression", "gives", "26.3979"] in rows
    assert any("1+k1 1.297" in line for line in lines)
    assert lines[-1].startswith("warning: outside the ranges of all types")


def test_ranges_are_told_by_type() -> None:
    """The ship of 1982 lies within three; a broad one is told of the nearest, and in what."""
    assert types_of(SHIP_1982, 0.287) == tuple(TYPES[i].name for i in (2, 3, 4))
    assert holtrop(SHIP_1982, 25.0).warnings == ()
    (told,) = holtrop(attrs.evolve(SHIP_1982, breadth=42.0, volume=49000.0), 15.0).warnings
    assert "nearest are" in told
    assert "B/T 4.2 is above 4" in told


def test_the_fastest_speed_decides_about_ranges() -> None:
    """A table that leaves the range at its end is told so."""
    assert holtrop(SHIP_1982, [20.0, 25.0]).warnings == ()
    (told,) = holtrop(SHIP_1982, [20.0, 42.0]).warnings
    assert "Fn 0.482 is above 0.45" in told


def test_a_high_bulb_counts_as_the_papers_ask() -> None:
    """Its centre at 0.6 T_F, which is told."""
    high, most = (holtrop(attrs.evolve(SHIP_1982, bulb_height=z), 20.0) for z in (7.0, 6.0))
    assert np.array_equal(high.bulb, most.bulb)
    assert any(
        "7.000 m above the base line; 0.6 T_F, 6.000 m, is taken" in w for w in high.warnings
    )


def test_fresh_water_with_the_viscosity_of_salt_water_is_told() -> None:
    """Until both are given."""
    fresh = attrs.evolve(SHIP_1982, rho=1.0)
    assert any("nu" in each for each in holtrop(fresh, 20.0).warnings)
    assert holtrop(attrs.evolve(fresh, nu=1.139e-6), 20.0).warnings == ()


# --------------------------------------------------------------------------------------
# Refusals.


@pytest.mark.parametrize(
    ("change", "error", "words"),
    [
        ({"volume": 0.0}, BadInputError, r"volume is 0\.0, .*above 0"),
        ({"length": -205.0}, BadInputError, r"length is -205\.0"),
        ({"lcb": math.nan}, BadInputError, r"lcb is nan"),
        ({"volume": 70000.0}, OutOfRangeError, r"volume / \(length breadth draught cm\) of 1\.08"),
        ({"lcb": 40.0}, OutOfRangeError, r"lcb of 40 % of L .*from -25 to 25"),
        ({"c_stern": 25.0}, OutOfRangeError, r"c_stern of 25 .*from -25 to 10"),
        ({"roughness": 150.0}, OutOfRangeError, r"roughness of 150 m .*0\.00015 to 0\.005 m"),
        ({"rho": 1025.0}, OutOfRangeError, r"rho of 1025 t/m3 .*0\.9 to 1\.2"),
        ({"entrance_deg": 90.0}, OutOfRangeError, r"entrance_deg of 90 deg"),
        ({"transom_area": 400.0}, OutOfRangeError, r"transom_area of 400 m2"),
        ({"bulb_area": 600.0}, OutOfRangeError, r"bulb_area of 600 m2"),
        ({"bulb_area": 0.0}, BadInputError, r"bulb_height is given without bulb_area"),
        ({"bulb_height": 0.0}, BadInputError, r"bulb_area is given without bulb_height"),
        ({"appendage_area": 0.0}, BadInputError, r"appendage_factor is given without"),
        ({"appendage_factor": None}, BadInputError, r"appendage_area is given without"),
        ({"appendage_factor": 0.5}, OutOfRangeError, r"appendage_factor of 0\.5 is too small"),
        ({"thruster_diameter": 2.0}, BadInputError, r"given without thruster_coefficient"),
    ],
)
def test_a_ship_that_is_none_is_refused(
    change: dict[str, Any], error: type[AssocHullError], words: str
) -> None:
    """By the name of the number, with the number and what would do."""
    with pytest.raises(error, match=words):
        attrs.evolve(SHIP_1982, **change)


def test_a_draught_with_which_waves_would_grow_as_she_slows_is_refused() -> None:
    """They came to 1e22 kN; the ratio that is told is taken."""
    flat = attrs.evolve(
        SHIP_1982, draught_fore=1.0, draught_aft=1.0, volume=3750.0, bulb_area=0.0,
        bulb_height=0.0, transom_area=0.0,
    )  # fmt: skip
    with pytest.raises(OutOfRangeError, match="waves would grow as she slows down") as caught:
        holtrop(flat, 10.0)
    draught = 1.0001 * flat.length / caught.value.most
    deeper = attrs.evolve(flat, draught_fore=draught, draught_aft=draught)
    assert np.isfinite(holtrop(deeper, 10.0).total).all()


def test_a_bulb_near_the_surface_is_told() -> None:
    """Though its centre lies below 0.6 T_F."""
    high = attrs.evolve(SHIP_1982, bulb_height=5.99, bulb_area=60.0)
    (told,) = [each for each in holtrop(high, 12.0).warnings if each.startswith("RB is up to")]
    found = holtrop(high, 12.0)
    assert f"{100.0 * (found.bulb / found.total)[0]:.0f} %" in told
    assert not any(each.startswith("RB is") for each in holtrop(SHIP_1982, [5.0, 25.0]).warnings)


MASKED = np.ma.MaskedArray([10.0, 12.0], [False, True])
DATE = np.datetime64("2020-01-01")


@pytest.mark.parametrize(
    "speeds", [MASKED, DATE, 0.0, -1.0, [10.0, 0.0], [], math.nan, [math.inf], "fast", None]
)
def test_a_speed_that_is_none_is_refused(speeds: Any) -> None:
    """As what was given."""
    with pytest.raises(BadInputError, match="speeds is"):
        holtrop(SHIP_1982, speeds)


def test_a_speed_without_a_line_of_friction_is_refused() -> None:
    """With the least that has one, which then is taken."""
    with pytest.raises(OutOfRangeError, match="line of the ITTC") as caught:
        holtrop(SHIP_1982, [10.0, 1e-4])
    assert holtrop(SHIP_1982, caught.value.least * (1.0 + 1e-9)).total[0] > 0.0


@pytest.mark.parametrize("method", ["1978", 1984, None])
def test_another_method_is_refused(method: Any) -> None:
    """With those that there are."""
    with pytest.raises(BadInputError, match="use 1984 or 1982"):
        holtrop(SHIP_1982, 20.0, method)


def test_what_the_regression_cannot_tell_is_refused_with_a_way_out() -> None:
    """A short ship that is fast, a full waterplane, a full ship of 1982; and the way works."""
    short = attrs.evolve(SHIP_1984, breadth=26.0, draught_fore=1.5, draught_aft=1.5)
    with pytest.raises(OutOfRangeError, match=r"length / breadth .*method='1982'"):
        holtrop(short, 20.0)
    assert holtrop(short, 20.0, "1982").total[0] > 0.0
    assert holtrop(short, 10.0).total[0] > 0.0
    box = attrs.evolve(SHIP_1982, cwp=1.0)
    with pytest.raises(BadInputError, match="give entrance_deg"):
        holtrop(box, 20.0)
    assert holtrop(attrs.evolve(box, entrance_deg=40.0), 20.0).total[0] > 0.0
    full = attrs.evolve(SHIP_1982, volume=62000.0, lcb=0.0)
    with pytest.raises(OutOfRangeError, match=r"CP of 0\.964.*method='1984'"):
        holtrop(full, 12.0, "1982")
    assert holtrop(full, 12.0).total[0] > 0.0


@pytest.mark.parametrize("name", attrs.fields_dict(HoltropShip))
def test_a_ship_takes_nothing_amiss(name: str) -> None:
    """An error of the family, or a ship whose resistance is a number."""
    for trial in spoilt({}, name):
        with trial as bad, warnings.catch_warnings():
            warnings.simplefilter("error")
            with contextlib.suppress(AssocHullError):
                ship = attrs.evolve(SHIP_1982, **bad)
                assert np.isfinite(holtrop(ship, [10.0, 25.0]).total).all()


def test_what_is_no_ship_is_refused() -> None:
    """By its type."""
    with pytest.raises(TypeError, match="give a HoltropShip"):
        ah.hydro.holtrop({}, 10.0)  # type: ignore[arg-type]
