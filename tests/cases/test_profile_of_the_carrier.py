"""Measures of profile, bulb and stern of the 207k carrier against the formulas of its form."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import minimize_scalar

import assoc_hull as ah
from assoc_hull.analysis.form.value import Value
from assoc_hull.examples import carrier_form as form

FP, DRAUGHT = form.LENGTH, form.DRAUGHT
BULB_LOW, BULB_HIGH = form.pieces(FP)[0]


@pytest.fixture(scope="module")
def carrier() -> ah.Hull:
    """The carrier as drawn; tests only read it."""
    return ah.examples.bulk_carrier_207k()


@pytest.fixture(scope="module")
def found(carrier: ah.Hull) -> Mapping[str, Value]:
    """Its form parameters at the design draught, with a screw."""
    return ah.form_parameters(carrier)


def number(found: Mapping[str, Value], symbol: str) -> float:
    """The number of an entry, which must be there."""
    value = found[symbol]
    assert value.number is not None, value.reason
    return value.number


def before_fp(top: float) -> float:
    """Lateral area of the formula's contour before FP, up to a height."""
    high = min(BULB_HIGH, top)
    return quad(lambda z: float(form.fore_end(z)) - FP, BULB_LOW, high, limit=200)[0]


def test_the_bulb_is_as_long_as_its_formula(found: Mapping[str, Value]) -> None:
    """BL, L_PR: the nose stands at x = 306.4; the drawn line passes it within its tolerance."""
    assert number(found, "BL") == pytest.approx(6.4, abs=1e-4)
    assert number(found, "L_PR") == number(found, "BL")


def test_the_tip_is_where_the_contour_turns(found: Mapping[str, Value]) -> None:
    """BH, Z_B: z = 7.0; so blunt a nose is 0.02 m high for 1e-5 m of x."""
    assert number(found, "BH") == pytest.approx(7.0, abs=0.02)
    assert number(found, "Z_B") == number(found, "BH")


def test_the_section_at_fp_is_that_of_the_form(found: Mapping[str, Value]) -> None:
    """BW, B_B, Abulb, A_BT: no station stands at FP; the surface there is within 0.06 %."""
    widest = minimize_scalar(
        lambda z: -float(form.half_breadth(FP, z)), bounds=(BULB_LOW, BULB_HIGH), method="bounded"
    )
    area = 2.0 * quad(lambda z: float(form.half_breadth(FP, z)), BULB_LOW, BULB_HIGH, limit=500)[0]
    assert number(found, "BW") == pytest.approx(-2.0 * widest.fun, abs=1e-3)
    assert number(found, "Abulb") == pytest.approx(area, rel=6e-4)
    assert number(found, "B_B") == number(found, "BW")
    assert number(found, "A_BT") == number(found, "Abulb")


def test_the_lateral_area_is_the_contours(found: Mapping[str, Value]) -> None:
    """LBA, LIBA, A_BL: all of the bulb is below the design draught."""
    assert number(found, "LBA") == pytest.approx(before_fp(DRAUGHT), rel=2e-6)
    assert number(found, "LIBA") == number(found, "A_BL") == number(found, "LBA")


def test_an_emerging_bulb_is_immersed_in_part(carrier: ah.Hull) -> None:
    """LIBA follows the floating plane, trimmed too; LBA is that of the design."""
    part = ah.form_parameters(carrier, draught=10.0, only=["LIBA", "LBA"])
    assert number(part, "LIBA") == pytest.approx(before_fp(10.0), rel=2e-5)
    assert number(part, "LBA") == pytest.approx(before_fp(DRAUGHT), rel=2e-6)
    aft, fore = 12.0, 9.0
    trimmed = ah.form_parameters(carrier, draughts=(aft, fore), only=["LIBA"])
    z = np.linspace(BULB_LOW, BULB_HIGH, 200_001)
    reach = np.minimum(form.fore_end(z), (z - aft) / (fore - aft) * FP)
    area = np.trapezoid(np.maximum(reach - FP, 0.0), z)
    assert number(trimmed, "LIBA") == pytest.approx(area, rel=1e-4)
    dry = ah.form_parameters(carrier, draughts=(12.0, 1.0), only=["LIBA"])
    assert number(dry, "LIBA") == 0.0
