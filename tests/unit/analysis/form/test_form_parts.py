"""Form parameters of parts of the ship and of its waterline, on nets of hulls with a formula."""

from __future__ import annotations

import math

import attrs
import pytest
from numpy.polynomial import Polynomial

from assoc_hull.analysis.form.form_parameters import form_parameters
from assoc_hull.analysis.form.parameter import FormValue
from assoc_hull.model.tables import HullState
from tests.cases.test_hydrostatics_of_a_box import box_net
from tests.nets import ellipsoid_net, wigley_net

LENGTH, BREADTH, DRAUGHT = 100.0, 10.0, 6.25
NO_BODY = "no parallel middle body"


@attrs.frozen
class Hull:
    """Tables as a hull."""

    state: HullState


@pytest.fixture(scope="module")
def wigley() -> Hull:
    """Wigley's hull with 21 stations."""
    return Hull(wigley_net(21, 9))


@pytest.fixture(scope="module")
def egg() -> Hull:
    """The ellipsoid with 41 rings, afloat at half its height."""
    return Hull(ellipsoid_net(41, 11))


@pytest.fixture(scope="module")
def block() -> dict[str, FormValue]:
    """Of a box of 100 x 20 m with a draught of 6 m."""
    return dict(form_parameters(box_net(), draught=6.0))


def of_wigley(draught: float) -> dict[str, float]:
    """All closed forms of Wigley's hull below a draught.

    A(x) = section s and b(x) = breadth/2 s, with s = 1 - (2 x/L - 1)^2.
    """
    q = draught / DRAUGHT
    section, breadth = BREADTH * DRAUGHT * (q * q - q**3 / 3.0), BREADTH * (2.0 * q - q * q)
    s = 1.0 - Polynomial([-1.0, 2.0 / LENGTH]) ** 2
    amount, moment = s.integ(), (Polynomial([0.0, 1.0]) * s).integ()
    half, first = amount(50.0), moment(50.0)
    aft, fore = first / half, (moment(100.0) - first) / half
    k = 2.0 * breadth / LENGTH
    broad = BREADTH * (q - 0.25 * q * q)  # of the waterline at half the draught
    return {
        "Amax": section, "x_Amax": 50.0, "V_a": section * half, "V_f": section * half,
        "LCBa": aft, "LCBf": fore, "V_st4": section * amount(20.0),
        "V_st5": section * amount(25.0), "A_st3": section * s(15.0), "A_st5": section * s(25.0),
        "L_R": 50.0, "L_E": 50.0, "V_R": section * half, "V_E": section * half,
        "Aw_a": breadth * half, "Aw_f": breadth * half, "LCFa": aft, "LCFf": fore,
        "Aw_st5": breadth * amount(25.0), "b_st5": 0.5 * breadth * s(25.0),
        "Eangle": math.degrees(math.atan(k)),
        "Bluntness": breadth / BREADTH * (1.0 - math.log1p(k * k) / (k * k)),
        "Rangle": math.degrees(math.atan(0.5 * broad / 50.0)),
        "I_T": 16.0 / 35.0 * breadth**3 * LENGTH / 12.0, "I_L": breadth * LENGTH**3 / 30.0,
    }  # fmt: skip


@pytest.mark.parametrize("draught", [6.25, 5.0])
def test_parts_of_wigleys_hull_are_those_of_its_polynomials(wigley: Hull, draught: float) -> None:
    """All 25 to 3e-5, which is what the net of 21 stations differs from the formula by."""
    wanted = of_wigley(draught)
    found = form_parameters(wigley, draught=draught, only=wanted)
    assert {symbol: value.number for symbol, value in found.items()} == pytest.approx(
        wanted, rel=3e-5
    )


def test_parts_of_the_ellipsoid_are_those_of_its_formulas(egg: Hull) -> None:
    """Caps, segments and ends that meet the centre plane across; to 2e-5, bluntness to 1e-3."""
    a, b, c = 50.0, 8.0, 6.0
    section, e = 0.5 * math.pi * b * c, (a * a - b * b) / (b * b)

    def cap(x: float) -> float:
        t = x / a - 1.0
        return section * a * (t - t**3 / 3.0 + 2.0 / 3.0)

    wanted = {
        "Amax": section, "V_a": cap(50.0), "V_f": cap(50.0), "LCBa": a - 3.0 / 8.0 * a,
        "LCBf": a + 3.0 / 8.0 * a, "V_st4": cap(20.0), "V_st5": cap(25.0),
        "A_st3": section * 0.51, "A_st5": section * 0.75, "Aw_a": 0.5 * math.pi * a * b,
        "LCFa": a - 4.0 * a / (3.0 * math.pi), "LCFf": a + 4.0 * a / (3.0 * math.pi),
        "Aw_st5": a * b * (math.acos(0.5) - 0.5 * math.sqrt(0.75)), "b_st5": b * math.sqrt(0.75),
        "I_T": 0.25 * math.pi * a * b**3, "I_L": 0.25 * math.pi * b * a**3,
    }  # fmt: skip
    found = form_parameters(egg, draught=6.0, only=[*wanted, "Bluntness"])
    blunt = (1.0 + 1.0 / e) * math.atan(math.sqrt(e)) / math.sqrt(e) - 1.0 / e
    assert found["Bluntness"].number == pytest.approx(blunt, rel=1e-3)
    assert {symbol: found[symbol].number for symbol in wanted} == pytest.approx(wanted, rel=2e-5)


def test_a_rounded_top_of_the_area_curve_is_no_parallel_body(wigley: Hull, egg: Hull) -> None:
    """Reasons for its ends; what is parted at the largest section says so."""
    for hull in (wigley, egg):
        found = form_parameters(hull, draught=6.0)
        assert {found[symbol].reason for symbol in ("PMBs", "PMBe")} == {NO_BODY}
        for symbol in ("L_R", "L_E", "V_R", "V_E", "Rangle"):
            assert NO_BODY in (found[symbol].warning or "")


def test_a_box_is_parallel_body_from_end_to_end(block: dict[str, FormValue]) -> None:
    """From AP to FP; it has neither run nor entrance, and a bow as blunt as can be."""
    numbers = {
        "PMBs": 0.0, "PMBe": 20.0, "Amax": 120.0, "x_Amax": 50.0, "A_FP": 120.0, "V_a": 6000.0,
        "V_f": 6000.0, "LCBa": 25.0, "LCBf": 75.0, "V_st4": 2400.0, "V_st5": 3000.0,
        "A_st3": 120.0, "A_st5": 120.0, "Aw_a": 1000.0, "Aw_f": 1000.0, "LCFa": 25.0,
        "LCFf": 75.0, "Aw_st5": 500.0, "b_st5": 10.0, "Bluntness": 1.0, "I_T": 2e5 / 3.0,
        "I_L": 5e6 / 3.0,
    }  # fmt: skip
    found = {symbol: block[symbol].number for symbol in numbers}
    assert found == pytest.approx(numbers, rel=1e-12, abs=1e-12)
    reasons = {symbol: block[symbol].reason for symbol in ("L_R", "L_E", "V_R", "V_E", "Rangle")}
    assert set(reasons.values()) == {"no run", "no entrance"}
    assert block["Eangle"].reason == "the waterline ends in a flat face"


def test_a_sharp_stem_at_fp_has_no_section_there(wigley: Hull) -> None:
    """A reason, not a zero."""
    assert form_parameters(wigley, draught=6.25)["A_FP"].reason == "no section at FP"
