"""Where ships come to rest: upright, with a list, or at an angle of loll."""

from __future__ import annotations

import numpy as np
import pytest

from assoc_hull.analysis.stability.condition import ConditionRequest
from assoc_hull.analysis.stability.equilibrium import Equilibrium, equilibrium_of
from assoc_hull.errors import BadInputError, OutOfRangeError
from assoc_hull.geometry.floating.immersion import FloatingPlanes
from tests.floating_bodies import StripBody, box_body, head, wigley_body

WIGLEY_VOLUME = 25000.0 / 9.0


def rest(body: StripBody, weight: float, lcg: float, tcg: float, kg: float) -> Equilibrium:
    """In fresh water."""
    deck = "closed" if body.limits.closed else "open"
    header = head(100.0, 20.0, 6.0, rho=1.0, kg=kg, deck=deck)
    return equilibrium_of(body, header, ConditionRequest(weight=weight, lcg=lcg, tcg=tcg, kg=kg))


def test_the_wigley_hull_rests_upright_at_the_reference_draughts() -> None:
    """V 2777.777778 m3, LCG 51, KG 4: T_A 5.8328504991, T_F 6.6670720589 m."""
    found = rest(wigley_body(), WIGLEY_VOLUME, 51.0, 0.0, 4.0)
    assert (found.kind, found.position.heel_deg) == ("upright", 0.0)
    assert found.position.draught_aft == pytest.approx(5.8328504991, abs=5e-11)
    assert found.position.draught_fore == pytest.approx(6.6670720589, abs=5e-11)
    assert found.stable_upright
    assert found.gm == found.gm_upright


@pytest.mark.parametrize("tcg", [0.15, -0.15])
@pytest.mark.parametrize("kg", [3.0, 4.0, 5.5])
def test_at_rest_both_equations_hold(tcg: float, kg: float) -> None:
    """Measured anew: the volume, and B upright below G: (G - B) x n = 0."""
    found = rest(wigley_body(), WIGLEY_VOLUME, 51.0, tcg, kg)
    at = found.position
    assert found.kind == "list"
    assert np.sign(at.heel_deg) == -np.sign(tcg)
    slope = (at.draught_fore - at.draught_aft) / 100.0
    th = float(np.tan(np.radians(at.heel_deg)))
    f = wigley_body().measure(FloatingPlanes(*np.array([[at.draught_aft], [slope], [th]])))
    assert f.volume[0] == pytest.approx(WIGLEY_VOLUME, rel=1e-10)
    b = np.array([f.moment_x[0], f.moment_y[0], f.moment_z[0]]) / f.volume[0]
    normal = np.array([-slope, th, 1.0])
    off = np.cross(np.array([51.0, tcg, kg]) - b, normal / np.linalg.norm(normal))
    np.testing.assert_allclose(off, 0.0, atol=2e-9)
    assert found.gm > 0.0


def test_a_small_list_is_that_of_gm() -> None:
    """tan(heel) = y_G / GM for a box but for the third power."""
    found = rest(box_body(), 12000.0, 50.0, -0.01, 5.0)
    gm = 3.0 + 400.0 / 72.0 - 5.0
    assert np.tan(np.radians(found.position.heel_deg)) == pytest.approx(0.01 / gm, rel=1e-4)


def test_an_unstable_ship_comes_to_rest_at_her_angle_of_loll() -> None:
    """A box: tan^2(heel) = -2 GM / BM, in closed form; GM there is -2 GM / cos(heel)."""
    bm, kg = 400.0 / 72.0, 8.8
    gm = 3.0 + bm - kg
    found = rest(box_body(), 12000.0, 50.0, 0.0, kg)
    tangent = np.sqrt(-2.0 * gm / bm)
    assert found.kind == "loll"
    assert not found.stable_upright
    assert found.gm_upright == pytest.approx(gm, abs=1e-9)
    assert np.tan(np.radians(found.position.heel_deg)) == pytest.approx(tangent, rel=1e-8)
    assert found.gm == pytest.approx(-2.0 * gm * np.hypot(1.0, tangent), rel=1e-7)
    assert any("port" in note for note in found.notes)


def test_a_ship_that_does_not_come_to_rest_is_refused() -> None:
    """It capsizes; with an open deck, before its edge goes under."""
    with pytest.raises(BadInputError, match="does not come to rest up to 85 deg"):
        rest(box_body(), 12000.0, 50.0, 0.0, 20.0)
    with pytest.raises(BadInputError, match=r"edge of the open deck goes under at 30\.96"):
        rest(box_body(closed=False), 12000.0, 50.0, -3.0, 5.0)


def test_a_list_just_short_of_the_edge_of_an_open_deck_is_found() -> None:
    """30.5 degrees of 30.96: where y_G cos(heel) is the lever of the wall-sided box."""
    phi, bm = np.radians(30.5), 400.0 / 72.0
    y = np.tan(phi) * (3.0 + bm * (1.0 + np.tan(phi) ** 2 / 2.0) - 5.0)
    found = rest(box_body(closed=False), 12000.0, 50.0, -float(y), 5.0)
    assert found.position.heel_deg == pytest.approx(30.5, abs=1e-8)


@pytest.mark.parametrize("weight", [0.0, -1.0, float("nan"), float("inf"), 24001.0])
def test_a_weight_that_the_hull_does_not_carry_is_refused(weight: float) -> None:
    """With the range."""
    with pytest.raises(OutOfRangeError, match="a weight") as caught:
        rest(box_body(), weight, 50.0, 0.0, 5.0)
    assert caught.value.most == pytest.approx(24000.0, rel=1e-12)
