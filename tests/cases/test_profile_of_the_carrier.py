"""Measures of profile, bulb and stern of the 207k carrier against the formulas of its form."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq, minimize_scalar

import assoc_hull as ah
from assoc_hull.analysis.form.parameter import FormValue
from assoc_hull.shipped import bulk_carrier_207k_form as form

FP, DRAUGHT, STATION = form.LENGTH, form.DRAUGHT, form.LENGTH / 20.0
BULB_LOW, BULB_HIGH = form.height_ranges(FP)[0]
SCREW = ah.form.Screw(height=form.SHAFT, diameter=6.5, x=3.0)


@pytest.fixture(scope="module")
def found(bulk_carrier: ah.Hull) -> Mapping[str, FormValue]:
    """Its form parameters at the design draught, with a screw."""
    return bulk_carrier.form_parameters(screw=SCREW)


def number(found: Mapping[str, FormValue], symbol: str) -> float:
    """The number of an entry, which must be there."""
    value = found[symbol]
    assert value.number is not None, value.reason
    return value.number


def before_fp(top: float) -> float:
    """Lateral area of the formula's contour before FP, up to a height."""
    high = min(BULB_HIGH, top)
    return quad(lambda z: float(form.fore_end(z)) - FP, BULB_LOW, high, limit=200)[0]


def test_the_bulb_is_as_long_as_its_formula(found: Mapping[str, FormValue]) -> None:
    """BL, L_PR: the nose stands at x = 306.4; the drawn line passes it within its tolerance."""
    assert number(found, "BL") == pytest.approx(6.4, abs=1e-4)
    assert number(found, "L_PR") == number(found, "BL")


def test_the_tip_is_where_the_contour_turns(found: Mapping[str, FormValue]) -> None:
    """BH, Z_B: z = 7.0; so blunt a nose is 0.02 m high for 1e-5 m of x."""
    assert number(found, "BH") == pytest.approx(7.0, abs=0.02)
    assert number(found, "Z_B") == number(found, "BH")


def test_the_section_at_fp_is_that_of_the_form(found: Mapping[str, FormValue]) -> None:
    """BW, B_B, Abulb, A_BT: no station stands at FP; the surface there is within 0.06 %."""
    widest = minimize_scalar(
        lambda z: -float(form.carrier_half_breadth(FP, z)),
        bounds=(BULB_LOW, BULB_HIGH),
        method="bounded",
    )
    area = (
        2.0
        * quad(lambda z: float(form.carrier_half_breadth(FP, z)), BULB_LOW, BULB_HIGH, limit=500)[0]
    )
    assert number(found, "BW") == pytest.approx(-2.0 * widest.fun, abs=1e-3)
    assert number(found, "Abulb") == pytest.approx(area, rel=6e-4)
    assert number(found, "B_B") == number(found, "BW")
    assert number(found, "A_BT") == number(found, "Abulb")


def test_the_lateral_area_is_the_contours(found: Mapping[str, FormValue]) -> None:
    """LBA, LIBA, A_BL: all of the bulb is below the design draught."""
    assert number(found, "LBA") == pytest.approx(before_fp(DRAUGHT), rel=2e-6)
    assert number(found, "LIBA") == number(found, "A_BL") == number(found, "LBA")


def test_an_emerging_bulb_is_immersed_in_part(bulk_carrier: ah.Hull) -> None:
    """LIBA follows the floating plane, trimmed too; LBA is that of the design."""
    part = bulk_carrier.form_parameters(draught=10.0, only=["LIBA", "LBA"])
    assert number(part, "LIBA") == pytest.approx(before_fp(10.0), rel=2e-5)
    assert number(part, "LBA") == pytest.approx(before_fp(DRAUGHT), rel=2e-6)
    aft, fore = 12.0, 9.0
    trimmed = bulk_carrier.form_parameters(draughts=(aft, fore), only=["LIBA"])
    z = np.linspace(BULB_LOW, BULB_HIGH, 200_001)
    reach = np.minimum(form.fore_end(z), (z - aft) / (fore - aft) * FP)
    area = np.trapezoid(np.maximum(reach - FP, 0.0), z)
    assert number(trimmed, "LIBA") == pytest.approx(area, rel=1e-4)
    dry = bulk_carrier.form_parameters(draughts=(12.0, 1.0), only=["LIBA"])
    assert number(dry, "LIBA") == 0.0


def formula_area(x: float) -> float:
    """Area of both sides of the formula's section below the design draught."""
    wet = [(low, min(high, DRAUGHT)) for low, high in form.height_ranges(x) if low < DRAUGHT]
    half = [
        quad(lambda z: float(form.carrier_half_breadth(x, z)), *each, limit=200)[0] for each in wet
    ]
    return 2.0 * sum(half)


def test_the_volume_of_the_bulb_is_the_forms(found: Mapping[str, FormValue]) -> None:
    """V_PR by Gauss over x = FP + 6.4 sin^2; four stations draw the bulb, within 0.1 %."""
    node, weight = np.polynomial.legendre.leggauss(12)
    angle = 0.25 * np.pi * (node + 1.0)
    x = FP + 6.4 * np.sin(angle) ** 2
    step = 6.4 * np.sin(2.0 * angle) * 0.25 * np.pi * weight
    volume = sum(formula_area(each) * dx for each, dx in zip(x.tolist(), step, strict=True))
    assert number(found, "V_PR") == pytest.approx(volume, rel=1e-3)


def test_the_diagonal_of_the_fore_section_is_the_forms(found: Mapping[str, FormValue]) -> None:
    """x_third, Ldiag, L, L/Ldiag, the section of a third of the area being solved for anew."""
    greatest = 2.0 * (25.0 * DRAUGHT - (1.0 - np.pi / 4.0) * form.BILGE**2)
    x = brentq(lambda at: formula_area(at) - greatest / 3.0, 290.0, 298.0, xtol=1e-9)
    half = float(form.carrier_half_breadth(x, DRAUGHT))
    z = brentq(
        lambda z: float(form.carrier_half_breadth(x, z)) - half * (1.0 - z / DRAUGHT),
        1.0,
        DRAUGHT - 1.0,
    )
    whole = np.hypot(half, DRAUGHT)
    assert number(found, "x_third") == pytest.approx(x, abs=5e-3)
    assert number(found, "Ldiag") == pytest.approx(whole, abs=5e-3)
    assert number(found, "L") == pytest.approx(whole * (1.0 - z / DRAUGHT), abs=5e-3)
    assert number(found, "L/Ldiag") == pytest.approx(1.0 - z / DRAUGHT, abs=3e-4)


def through_three(x: float) -> float:
    """Radius of the circle through the form's places at quarters of the draught."""
    z = np.array([0.25, 0.5, 0.75]) * DRAUGHT
    y = form.carrier_half_breadth(x, z)
    # (y - a)^2 + (z - b)^2 = r^2 is linear in a, b and r^2 - a^2 - b^2.
    known = np.linalg.solve(np.column_stack([2.0 * y, 2.0 * z, np.ones(3)]), y * y + z * z)
    return float(np.sqrt(known[2] + known[0] ** 2 + known[1] ** 2))


def test_the_fore_section_is_round(found: Mapping[str, FormValue]) -> None:
    """Rfwd: the circle through three places of station 19.5; it is convex."""
    assert number(found, "Rfwd") == pytest.approx(through_three(19.5 * STATION), rel=2e-3)


# The stern.


def test_overhang_and_transom_are_those_of_the_form(found: Mapping[str, FormValue]) -> None:
    """SO, TH, TRZ: the transom stands 5 m abaft AP and 0.4 m above the design draught."""
    assert number(found, "SO") == pytest.approx(5.0, abs=1e-9)
    assert number(found, "TH") == pytest.approx(18.4, abs=1e-9)
    assert number(found, "TRZ") == pytest.approx(-0.4, abs=1e-9)


def test_a_dry_transom_has_no_immersed_area(found: Mapping[str, FormValue]) -> None:
    """ATT is truly nil; a breadth on the waterline there is not."""
    assert number(found, "ATT") == 0.0
    assert found["B_tr"].reason == "transom is dry"


def test_an_immersed_transom_is_measured_in_the_floating_plane(bulk_carrier: ah.Hull) -> None:
    """ATT, B_tr, TRZ at a trim by the stern, against the formula's half-breadths."""
    aft, fore = 22.0, 17.0
    part = bulk_carrier.form_parameters(draughts=(aft, fore), only=["ATT", "B_tr", "TRZ"])
    level = aft - (fore - aft) / FP * 5.0
    half = float(form.carrier_half_breadth(form.TRANSOM, level))
    low = form.TRANSOM_LOW
    area = 2.0 * quad(lambda z: float(form.carrier_half_breadth(form.TRANSOM, z)), low, level)[0]
    assert number(part, "B_tr") == pytest.approx(2.0 * half, abs=2e-3)
    assert number(part, "ATT") == pytest.approx(area, rel=2e-4)
    assert number(part, "TRZ") == pytest.approx(3.6, abs=1e-9)


def test_the_bottom_at_ap_is_the_contours(found: Mapping[str, FormValue]) -> None:
    """Hap, StemA: height and slope of the overhang at AP."""
    z = brentq(lambda z: float(form.contour_over_bossing(z)), 9.0, 18.0, xtol=1e-12)
    step = 1e-5
    run = np.diff(form.contour_over_bossing([z - step, z + step]))[0]
    assert number(found, "Hap") == pytest.approx(z, abs=1e-5)
    assert number(found, "StemA") == pytest.approx(
        np.degrees(np.arctan2(2.0 * step, abs(run))), abs=5e-3
    )


def test_boss_and_aperture_are_those_of_the_form(found: Mapping[str, FormValue]) -> None:
    """SBx, SBD, SA, SCH: a cylinder of 0.725 m from x = 6.0 to 7.5 about the shaft at 5.0 m."""
    assert number(found, "SBx") == form.BOSS_AFT
    assert number(found, "SBD") == pytest.approx(2.0 * form.BOSS, abs=2e-6)
    assert number(found, "SA") == pytest.approx(form.BOSS_FORE, abs=1e-9)
    assert number(found, "SCH") == form.SHAFT


def test_the_screw_is_as_deep_as_the_numbers_say(found: Mapping[str, FormValue]) -> None:
    """PI = 18 - 5 - 3.25; PTC from the overhang at x = 3, drawn within 1e-3 m."""
    z = brentq(lambda z: float(form.contour_over_bossing(z)) - 3.0, 9.0, 18.0, xtol=1e-12)
    assert number(found, "PI") == pytest.approx(9.75, abs=1e-12)
    assert number(found, "PTC") == pytest.approx((z - 8.25) / 0.065, abs=0.02)


# Sections.


def test_breadths_at_the_screw_are_the_forms(found: Mapping[str, FormValue]) -> None:
    """BCL, B07, Tau at station 2."""
    x = 2.0 * STATION
    shaft, blade, water = form.carrier_half_breadth(x, np.array([5.0, 5.0 + 0.7 * 3.25, DRAUGHT]))
    assert number(found, "BCL") == pytest.approx(float(shaft), abs=1e-4)
    assert number(found, "B07") == pytest.approx(float(blade), abs=1e-3)
    tau = np.degrees(np.arctan2(water - shaft, DRAUGHT - 5.0))
    assert number(found, "Tau") == pytest.approx(float(tau), abs=1e-3)


@pytest.mark.parametrize(("symbol", "station"), [("S3", 1.5), ("S3'", 1.0)])
def test_the_stern_area_ratio_is_that_of_the_form(
    found: Mapping[str, FormValue], symbol: str, station: float
) -> None:
    """S3 and S3' with both their areas: V-shaped sections lie inside their chord."""
    x = station * STATION
    low = form.height_ranges(x)[0][0]
    half = float(form.carrier_half_breadth(x, DRAUGHT))

    def outside(z: float) -> float:
        return float(form.carrier_half_breadth(x, z)) - half * (z - low) / (DRAUGHT - low)

    shaft = max(low, form.SHAFT)
    first = quad(outside, shaft, DRAUGHT, limit=200)[0]
    second = quad(lambda z: float(form.carrier_half_breadth(x, z)), low, DRAUGHT, limit=200)[0]
    assert number(found, f"{symbol}.A1") == pytest.approx(first, abs=2e-3)
    assert number(found, f"{symbol}.A2") == pytest.approx(second, rel=2e-5)
    assert number(found, symbol) == pytest.approx(first / second, abs=2e-5)
    assert first < 0.0


def test_the_after_section_is_hollow(found: Mapping[str, FormValue]) -> None:
    """Raft: the circle through three places of station 1.5, by a second formula; - if hollow."""
    radius = through_three(1.5 * STATION)
    assert number(found, "Raft") == pytest.approx(-radius, rel=2e-4)


def test_the_bilge_radius_is_the_forms(found: Mapping[str, FormValue]) -> None:
    """BR: station 10 is drawn within 1e-4 m of its circle."""
    assert number(found, "BR") == pytest.approx(form.BILGE, abs=2e-4)
