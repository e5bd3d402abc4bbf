"""Righting levers of hulls that are known by formula, against the reference table and the laws."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.testing import assert_allclose

from assoc_hull.analysis.hydrostatics.floating_body import Appendage
from assoc_hull.analysis.stability.condition import ConditionRequest, case_of, condition_of
from assoc_hull.analysis.stability.cross_curves import cross_curves_of
from assoc_hull.analysis.stability.righting_lever import HeeledShip, TrimRule, float_at_heels
from assoc_hull.analysis.stability.stability_report import Stability, stability_of
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.floating.immersion import FloatingPlanes
from tests.floating_bodies import StripBody, box_body, ellipsoid_body, head, wigley_body

Made = Callable[[], StripBody]

WIGLEY_VOLUME = 25000.0 / 9.0
ELLIPSOID_VOLUME = 3781.5467126543804


def found(
    body: StripBody, asked: ConditionRequest, heels: list[float], trim: TrimRule = "fixed"
) -> Stability:
    """Stability in fresh water, so that tonnes are cubic metres."""
    header = head(100.0, 10.0, 6.25, rho=1.0, kg=asked.kg)
    return stability_of(body, header, asked, trim, np.array(heels))


def floated(
    body: StripBody,
    asked: ConditionRequest,
    heels: list[float],
    trim: TrimRule = "fixed",
    **given: object,
) -> HeeledShip:
    """The heels alone, without curve and criteria."""
    terms: dict[str, object] = {"rho": 1.0, "kg": asked.kg, **given}
    header = head(100.0, 10.0, 6.25, **terms)
    case = case_of(body, header, [condition_of(body, header, asked)], trim)
    return float_at_heels(case, np.array(heels))


def wigley(heels: list[float], trim: TrimRule = "free", lcg: float = 51.0) -> HeeledShip:
    """The Wigley hull of the reference table."""
    return floated(
        wigley_body(), ConditionRequest(weight=WIGLEY_VOLUME, lcg=lcg, kg=4.0), heels, trim
    )


@pytest.mark.parametrize("trim", ["fixed", "free"])
def test_kn_of_the_wigley_hull_has_the_reference_values(trim: TrimRule) -> None:
    """At even keel, to all ten printed digits; the ship stays at even keel by its symmetry."""
    at = wigley([5.0, 10.0, 20.0, 30.0], trim, lcg=50.0)
    assert_allclose(at.kn, [0.4602009129, 0.9182480482, 1.8200848130, 2.6937178386], atol=5e-11)
    heights = [6.2497832764, 6.2482493821, 6.2354083063, 6.1968273782]
    assert_allclose(at.mean, heights, atol=5.1e-11)


def test_kn_of_the_ellipsoid_has_the_reference_values() -> None:
    """To the printed digits; the strips follow the ellipsoid to 1e-10."""
    asked = ConditionRequest(weight=ELLIPSOID_VOLUME, kg=4.0)
    at = floated(ellipsoid_body(), asked, [10.0, 30.0, 60.0])
    assert_allclose(at.kn, [1.4135588768, 3.8711384448, 5.9527831604], atol=6e-11)
    assert_allclose(at.mean, [4.9727350625, 4.7380203676, 3.4833885216], atol=3e-10)


@pytest.mark.parametrize("trim", ["fixed", "free"])
def test_kn_of_the_box_has_the_reference_values(trim: TrimRule) -> None:
    """To all printed digits, with deck and bilge crossing the water at 40 degrees."""
    asked = ConditionRequest(weight=12000.0, kg=4.0)
    at = floated(box_body(), asked, [10.0, 20.0, 30.0, 40.0], trim)
    assert_allclose(at.kn, [1.5006536615, 3.0520303646, 4.7407407407, 6.1148975320], atol=5e-11)


def test_free_trim_has_the_reference_values() -> None:
    """Draughts to 5e-9 and levers to 5e-10 m, half of their last printed digits."""
    at = wigley([0.0, 10.0, 20.0, 30.0])
    lift = 50.0 * at.slope
    assert (at.mean - lift)[0] == pytest.approx(5.8328504991, abs=5e-11)
    assert (at.mean + lift)[0] == pytest.approx(6.6670720589, abs=5e-11)
    assert_allclose((at.mean - lift)[1:], [5.82942667, 5.81174616, 5.76462459], atol=5e-9)
    assert_allclose((at.mean + lift)[1:], [6.66662470, 6.65818200, 6.62769033], atol=5e-9)
    assert_allclose(at.gz[1:], [0.224205034, 0.453095450, 0.695330033], atol=5.1e-10)


def ellipsoid_kn(heel_deg: FloatArray) -> FloatArray:
    """KN of the ellipsoid by the cap of a sphere: depth of the cap from its volume, then back."""
    n = np.stack([np.sin(np.radians(heel_deg)), np.cos(np.radians(heel_deg))], axis=1)
    axes = np.array([8.0, 6.0])
    whole = np.pi * 50.0 * 8.0 * 6.0
    roots = np.roots([-1.0 / 3.0, 0.0, 1.0, 2.0 / 3.0 - ELLIPSOID_VOLUME / whole])
    h = float(next(each.real for each in roots if abs(each) < 1.0))
    depth = -0.25 * np.pi * (1.0 - h * h) ** 2 / (ELLIPSOID_VOLUME / (50.0 * 48.0))
    b = depth * axes**2 * n / np.linalg.norm(axes * n, axis=1)[:, None]
    across = np.stack([np.cos(np.radians(heel_deg)), -np.sin(np.radians(heel_deg))], axis=1)
    kn: FloatArray = -((b + np.array([0.0, 6.0])) * across).sum(axis=1)
    return kn


def test_a_ship_on_her_side_has_the_lever_of_the_closed_form() -> None:
    """At 85 and 89.75 degrees to 2e-10, at 89.9 and 90, which are read from a cubic, to 1e-8 m."""
    heels = [-90.0, 85.0, 89.75, 89.9, 90.0]
    at = floated(ellipsoid_body(), ConditionRequest(weight=ELLIPSOID_VOLUME, kg=4.0), heels)
    off = np.abs(at.kn - ellipsoid_kn(np.array(heels)))
    assert (off[1:3] <= 2e-10).all()
    assert (off[[0, 3, 4]] <= 1e-8).all()
    assert np.isnan(at.mean[[0, 4]]).all()
    box = floated(box_body(), ConditionRequest(weight=12000.0, kg=4.0), [90.0])
    assert box.kn[0] == pytest.approx(6.0, abs=1e-8)  # the middle of its depth


@pytest.mark.parametrize("trim", ["fixed", "free"])
@pytest.mark.parametrize("lcg", [50.0, 51.0])
def test_levers_to_port_are_those_to_starboard(trim: TrimRule, lcg: float) -> None:
    """GZ(-phi) = -GZ(phi) for G in the centre plane."""
    at = wigley([-30.0, -17.0, 17.0, 30.0], trim, lcg=lcg)
    assert_allclose(at.gz, -at.gz[::-1], atol=1e-12)
    assert_allclose(at.growth, at.growth[::-1], atol=1e-9)


@pytest.mark.parametrize("kg", [1.0, 4.0, 9.0])
def test_kn_does_not_depend_on_kg(kg: float) -> None:
    """And GZ = KN - KG sin(heel), at a trim that stays nil."""
    heels = [10.0, 25.0, 40.0, 70.0]
    at = floated(box_body(), ConditionRequest(weight=12000.0, kg=kg), heels)
    asked = [ConditionRequest(weight=12000.0)]
    head_ = head(100.0, 20.0, 6.0, rho=1.0)
    cross = cross_curves_of(box_body(), head_, asked, "fixed", np.array(heels))
    assert_allclose(at.kn, cross.kn[0], atol=1e-11)
    assert_allclose(at.gz, at.kn - kg * np.sin(np.radians(heels)), atol=1e-12)


def test_a_centre_of_gravity_off_the_centre_plane_adds_its_cosine() -> None:
    """GZ grows by y_G cos(heel): it heels the ship to its side."""
    heels = [-20.0, 0.0, 20.0, 60.0]
    plain, off = (
        found(box_body(), ConditionRequest(weight=12000.0, kg=4.0, tcg=y), heels)
        for y in (0.0, 0.3)
    )
    assert_allclose(off.gz - plain.gz, 0.3 * np.cos(np.radians(heels)), atol=1e-11)
    assert (plain.side, off.side) == ("starboard", "port")


@pytest.mark.parametrize("trim", ["fixed", "free"])
def test_the_curve_begins_with_the_slope_gm(trim: TrimRule) -> None:
    """GM = KB + I_T / V - KG of the Wigley hull: 3.90625 + 3809.5238 / 2777.7778 - 4."""
    whole = found(wigley_body(), ConditionRequest(weight=WIGLEY_VOLUME, kg=4.0), [0.0, 1e-3], trim)
    gm = 3.90625 + 80000.0 / 21.0 / WIGLEY_VOLUME - 4.0
    assert whole.gm == pytest.approx(gm, abs=1e-9)
    assert whole.gz[1] / np.radians(1e-3) == pytest.approx(gm, abs=1e-6)


@pytest.mark.parametrize(
    ("body", "asked", "trim"),
    [
        (wigley_body, ConditionRequest(weight=WIGLEY_VOLUME, lcg=51.0, kg=4.0), "free"),
        (wigley_body, ConditionRequest(weight=WIGLEY_VOLUME, lcg=48.0, kg=3.0, tcg=0.2), "free"),
        (wigley_body, ConditionRequest(draughts=(5.5, 6.5), kg=4.0), "fixed"),
        (ellipsoid_body, ConditionRequest(draughts=(5.0, 6.0), kg=5.0), "fixed"),
        (box_body, ConditionRequest(draughts=(5.0, 7.0), kg=5.0), "free"),
    ],
)
def test_slopes_are_those_of_the_levers(
    body: Callable[[], StripBody], asked: ConditionRequest, trim: TrimRule
) -> None:
    """dGZ/dphi against central differences, with trim and G off the centre plane."""
    step = 1e-3
    middle = np.array([-21.0, -4.0, 3.0, 11.0, 24.0])
    ends = np.sort(np.concatenate([middle - step, middle, middle + step]))
    at = floated(body(), asked, ends.tolist(), trim)
    slope = (at.gz[2::3] - at.gz[::3]) / np.radians(2.0 * step)
    assert_allclose(at.growth[1::3], slope, atol=1e-7)


@pytest.mark.parametrize("body", [ellipsoid_body, box_body])
def test_the_work_of_heeling_is_the_rise_of_gravity_over_buoyancy(
    body: Callable[[], StripBody],
) -> None:
    """Integral of GZ = (G - B).n less the same upright; to 3e-6 m rad with the refined curve."""
    heels = [20.0, 40.0, 55.0]
    whole = found(body(), ConditionRequest(weight=3781.0, kg=7.0), [0.0, *heels])
    work = whole.heels.energy[1:] - whole.heels.energy[0]
    assert_allclose(whole.columns["arm"][1:], work, atol=3e-6)


@pytest.mark.parametrize("heel", [-25.0, 0.0, 10.0, 30.0])
def test_free_trim_is_an_equilibrium_lengthwise(heel: float) -> None:
    """The volume is that of the weight, and (B - G).e1 = 0, measured anew; with an appendage."""
    fin = Appendage("fin", 20.0, (20.0, 0.0, 1.0))
    asked = ConditionRequest(weight=WIGLEY_VOLUME, lcg=51.0, kg=4.0)
    at = floated(wigley_body(), asked, [heel], "free", appendages=(fin,))
    planes = FloatingPlanes(at.mean - 50.0 * at.slope, at.slope, np.tan(np.radians([heel])))
    bare = wigley_body().measure(planes)
    volume = bare.volume[0] + 20.0
    assert volume == pytest.approx(WIGLEY_VOLUME, rel=1e-11)
    x = (bare.moment_x[0] + 400.0) / volume
    z = (bare.moment_z[0] + 20.0) / volume
    assert (x - 51.0) + (z - 4.0) * at.slope[0] == pytest.approx(0.0, abs=1e-9)
