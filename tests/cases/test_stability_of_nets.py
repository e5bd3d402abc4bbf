"""Stability of hulls as nets of lines: references of the formulas, real ships, refusals."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.analysis.stability.cross_curves import cross_curves
from assoc_hull.analysis.stability.equilibrium import equilibrium
from assoc_hull.analysis.stability.flooding import FloodingPoint
from assoc_hull.analysis.stability.stability_report import stability
from assoc_hull.errors import AssocHullError, BadInputError, OutOfRangeError
from tests.cases.test_hydrostatics_of_a_box import box_net
from tests.nets import ellipsoid_net, wigley_net

VOLUME = 25000.0 / 9.0


def test_kn_of_a_box_has_the_reference_values() -> None:
    """To all printed digits, at 40 degrees with a wet deck and a dry bilge; 6 m on her side."""
    heels = [10.0, 20.0, 30.0, 40.0, 90.0]
    found = cross_curves(box_net(), weights=[12000.0], rho=1.0, heels=heels)
    want = [1.5006536615, 3.0520303646, 4.7407407407, 6.1148975320]
    np.testing.assert_allclose(found.kn[0, :4], want, atol=1e-9)
    assert found.kn[0, 4] == pytest.approx(6.0, abs=1e-7)


@pytest.mark.parametrize(("size", "bound"), [((21, 11), 2e-5), ((41, 21), 2.5e-6)])
def test_kn_and_gz_of_a_wigley_net_converge_to_the_reference(
    size: tuple[int, int], bound: float
) -> None:
    """To 2e-5 m with 21 x 11 lines, to 2.5e-6 m with 41 x 21: KN, free-trim GZ, and draughts."""
    hull = ah.Hull(wigley_net(*size))
    kn = cross_curves(hull, weights=[VOLUME], rho=1.0, heels=[5.0, 10.0, 20.0, 30.0]).kn[0]
    want = [0.4602009129, 0.9182480482, 1.8200848130, 2.6937178386]
    np.testing.assert_allclose(kn, want, atol=bound)
    gz = stability(
        hull, weight=VOLUME, lcg=51.0, kg=4.0, rho=1.0, trim="free", heels=[10.0, 20.0, 30.0]
    ).gz
    np.testing.assert_allclose(gz, [0.224205034, 0.453095450, 0.695330033], atol=bound)
    at = equilibrium(hull, VOLUME, lcg=51.0, kg=4.0, rho=1.0).position
    draughts = [at.draught_aft, at.draught_fore]
    np.testing.assert_allclose(draughts, [5.8328504991, 6.6670720589], atol=bound)


def test_kn_of_an_ellipsoid_net_is_near_to_the_reference() -> None:
    """To 5e-6 m with 21 x 11 lines, at 60 degrees too."""
    hull = ah.Hull(ellipsoid_net(21, 11))
    found = cross_curves(hull, weights=[3781.5467126543804], rho=1.0, heels=[10.0, 30.0, 60.0])
    np.testing.assert_allclose(found.kn[0], [1.4135588768, 3.8711384448, 5.9527831604], atol=5e-6)


@pytest.fixture(scope="module")
def wigley() -> ah.Hull:
    """A small net, closed."""
    return ah.examples.wigley(stations=11, waterlines=7)


@pytest.mark.parametrize("trim", ["fixed", "free"])
def test_gm_of_a_curve_is_that_of_hydrostatics(wigley: ah.Hull, trim: Any) -> None:
    """The slope at no heel, and GM of the record at the same draught."""
    found = stability(wigley, draught=6.0, kg=4.0, trim=trim, heels=[0.0, 30.0])
    record = wigley.hydrostatics(draught=6.0, kg=4.0)
    assert found.gm == pytest.approx(record.gmt, abs=1e-9)
    assert found.condition.weight == pytest.approx(record.displacement, rel=1e-12)


def test_a_real_ship_does_work_as_its_levers_say(series60_70: ah.Hull) -> None:
    """Series 60, fixed and free trim: the arm at 40 degrees is the rise of G over B.

    To 2e-5 m rad at even keel; the trim that is found does some of the work, below 1e-3.
    """
    for trim, bound in (("fixed", 2e-5), ("free", 1e-3)):
        found = stability(series60_70, kg=6.0, trim=trim, heels=[0.0, 40.0])  # type: ignore[arg-type]
        work = found.heels.energy[1] - found.heels.energy[0]
        assert found.columns["arm"][1] == pytest.approx(work, abs=bound)


def test_a_ship_that_fails_names_criterion_and_margin(wigley: ah.Hull) -> None:
    """KG 5.2 m: GM is too small, and the report says by how much, and that the deck is closed."""
    vent = FloodingPoint("vent", (50.0, 4.0, 8.5))
    found = stability(wigley, kg=5.2, flooding=[vent], heels=[0.0, 20.0, 40.0])
    assert found.passed is False
    assert [each.code for each in found.failed if each.unit == "m"][-1] == "2.2.4"
    words = dict(found.lines())
    assert f"2.2.4 initial metacentric height ({found.gm - 0.15:+.4f})" in words["in all"]
    assert words["deck"] == "closed"
    assert "vent" in words["opening"]


BAD: dict[str, tuple[dict[str, object], type[Exception]]] = {
    "no kg": ({"kg": None}, BadInputError),
    "kg nan": ({"kg": float("nan")}, BadInputError),
    "weight too large": ({"weight": 1e9}, OutOfRangeError),
    "weight endless": ({"weight": float("inf")}, OutOfRangeError),
    "weight negative": ({"weight": -5.0}, OutOfRangeError),
    "weight in words": ({"weight": "much"}, BadInputError),
    "weight and draught": ({"weight": 100.0, "draught": 2.0}, BadInputError),
    "draught too large": ({"draught": 40.0}, OutOfRangeError),
    "three draughts": ({"draughts": (1.0, 2.0, 3.0)}, BadInputError),
    "lcg nan": ({"weight": 1000.0, "lcg": float("nan")}, BadInputError),
    "lcg beyond": ({"weight": 1000.0, "lcg": 400.0}, BadInputError),
    "tcg in words": ({"tcg": "port"}, BadInputError),
    "tcg endless": ({"tcg": float("inf")}, BadInputError),
    "trim unknown": ({"trim": "loose"}, BadInputError),
    "heels falling": ({"heels": [10.0, 5.0]}, BadInputError),
    "heels nan": ({"heels": [float("nan")]}, BadInputError),
    "heels over": ({"heels": [0.0, 120.0]}, OutOfRangeError),
    "no heels": ({"heels": []}, BadInputError),
    "a point as numbers": ({"flooding": [(1.0, 2.0, 3.0)]}, BadInputError),
    "no points": ({"flooding": 3}, BadInputError),
    "rho nil": ({"rho": 0.0}, BadInputError),
    "on_error": ({"on_error": "ignore"}, BadInputError),
}


@pytest.mark.parametrize("case", BAD)
def test_what_cannot_be_is_refused(wigley: ah.Hull, case: str) -> None:
    """With an error of the family, before much is computed."""
    given, error = BAD[case]
    with pytest.raises(error) as caught:
        stability(wigley, **{"kg": 4.0, "heels": [0.0], **given})  # type: ignore[arg-type]
    assert isinstance(caught.value, AssocHullError)


@pytest.mark.parametrize(
    "given",
    [
        {"name": "", "place": (1.0, 2.0, 3.0)},
        {"name": "vent", "place": (1.0, 2.0)},
        {"name": "vent", "place": (1.0, float("nan"), 3.0)},
        {"name": "vent", "place": (1.0, 2.0, 3.0), "both_sides": "yes"},
    ],
)
def test_an_opening_that_cannot_be_is_refused(given: dict[str, Any]) -> None:
    """A name, three finite numbers, a truth value."""
    with pytest.raises(BadInputError):
        FloodingPoint(**given)


def test_what_is_no_hull_is_refused() -> None:
    """By all three."""
    for call in (
        lambda: stability(3, kg=1.0),  # type: ignore[arg-type]
        lambda: cross_curves("hull", draughts=[1.0]),  # type: ignore[arg-type]
        lambda: equilibrium(None, 5.0, lcg=1.0, kg=1.0),  # type: ignore[arg-type]
    ):
        with pytest.raises(AssocHullError):
            call()
