"""Elastica: closed forms against the differential equation, and all closures of a fit."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.chord_spline import ChordSpline
from assoc_hull.geometry.classical.elastica import (
    FREE_MODULUS,
    Elastica,
    Family,
    fit_amplitudes,
    fit_elastica,
    least_modulus,
)
from assoc_hull.geometry.numeric.quadrature import gauss


def test_an_inflecting_segment_is_that_of_the_reference() -> None:
    """k = .6 from -.4 to 1.9: place, length and direction, all digits."""
    rod = Elastica.make(0.6, -0.4, 1.9)
    assert rod.frame_point(1.9) == pytest.approx(
        (1.5984965751448272, 1.4932206730396662), abs=1e-12
    )
    assert rod.length == pytest.approx(2.5620867092989132, abs=1e-12)
    assert float(rod.direction(rod.length)) == pytest.approx(1.2076130910088294, abs=1e-12)


def test_a_segment_without_inflections_is_that_of_the_reference() -> None:
    """p = .8, B = 1.1 from -.3 to 1.2: place and length, all digits."""
    rod = Elastica.make(0.8, -0.3, 1.2, 1.1, family="not inflecting")
    assert rod.frame_point(1.2) == pytest.approx(
        (0.5251193742983551, 0.8673100006611688), abs=1e-12
    )
    assert rod.length == pytest.approx(1.5476573687597042, abs=1e-12)


@pytest.mark.parametrize("family", ["inflecting", "not inflecting"])
@pytest.mark.parametrize(("k", "phi0", "phi1"), [(0.3, -0.4, 1.9), (0.6, -3.0, 2.0), (0.95, 1, 7)])
def test_the_closed_form_solves_the_differential_equation(
    family: Family, k: float, phi0: float, phi1: float
) -> None:
    """The second derivative of the direction is -beta^2 sin psi: integrated, to 1e-9."""
    rod = Elastica.make(k, phi0, phi1, 1.3, start=(2.0, -1.0), rotation=0.4, family=family)
    force = (1.3 if family == "inflecting" else 1.3 * k) ** 2

    def rates(_: float, state: Any) -> list[float]:
        x, y, psi, bend = state
        del x, y
        return [np.cos(psi + 0.4), np.sin(psi + 0.4), bend, -force * np.sin(psi)]

    begin = [2.0, -1.0, float(rod.direction(0.0)) - 0.4, float(rod.curvature(0.0))]
    s = np.linspace(0.0, rod.length, 20)
    truth = solve_ivp(rates, (0.0, rod.length), begin, "DOP853", s, rtol=1e-12, atol=1e-12).y
    assert rod.at(s) == pytest.approx(truth[:2].T, abs=1e-9)
    assert rod.direction(s) == pytest.approx(truth[2] + 0.4, abs=1e-9)
    assert rod.curvature(s) == pytest.approx(truth[3], abs=1e-9)
    assert rod.curvature_rate(s) == pytest.approx(-force * np.sin(truth[2]), abs=1e-8)
    nodes, weights = gauss(40)
    bend = rod.curvature(nodes * rod.length)
    assert rod.energy == pytest.approx(float((bend**2) @ weights) * rod.length, rel=1e-8)


def test_a_free_length_is_that_of_the_reference() -> None:
    """Unit chord, .5 and -.3 rad: amplitudes, rotation, rate, length, energy, curvatures."""
    rod = fit_elastica([0, 0], [1, 0], 0.5, -0.3)
    found = rod.phi0, rod.phi1, rod.rotation, rod.rate, rod.length, rod.energy
    wanted = (
        -2.591861067512622, -1.6893806370413393, 1.256799423186047, 1.0919272935619764,
        1.02855651850994, 0.7365169176703344,
    )  # fmt: skip
    assert found == pytest.approx(wanted, abs=1e-11)
    ends = rod.curvature([0.0, rod.length])
    assert ends == pytest.approx((-1.3167006439672841, -0.1826911943405266), abs=1e-11)
    middle = rod.phi0 + 0.5 * (rod.phi1 - rod.phi0)
    local = rod.frame_point(middle)
    cosine, sine = np.cos(rod.rotation), np.sin(rod.rotation)
    place = (cosine * local[0] - sine * local[1], sine * local[0] + cosine * local[1])
    assert place == pytest.approx((0.46006914609745897, 0.10347000307394225), abs=1e-11)


def test_it_bends_less_than_the_cubic_of_small_deflections() -> None:
    """The chord cubic between the same tangents has the energy .742958544, the elastica less."""
    cubic = ChordSpline.through([(0, 0), (1, 0)], 0.5, -0.3)
    nodes, weights = gauss(24)
    speed = 1.0 / np.cos(cubic.direction(nodes))
    energy = float((cubic.curvature(nodes) ** 2 * speed) @ weights)
    assert energy == pytest.approx(0.7429585440485763, abs=1e-12)
    assert fit_elastica([0, 0], [1, 0], 0.5, -0.3).energy < energy


def test_a_given_length_has_the_modulus_of_the_reference() -> None:
    """1.03 on a unit chord: k and energy, all digits; the length is met."""
    rod = fit_elastica([0, 0], [1, 0], 0.5, -0.3, length=1.03)
    assert rod.k == pytest.approx(0.4239988985438447, abs=1e-10)
    assert rod.energy == pytest.approx(0.7384395031488763, abs=1e-10)
    assert rod.length == pytest.approx(1.03, abs=1e-13)


def test_bending_energy_is_stationary_at_the_free_length() -> None:
    """A little shorter or longer costs energy of second order only."""
    free = fit_elastica([0, 0], [1, 0], 0.5, -0.3)
    gains = [
        fit_elastica([0, 0], [1, 0], 0.5, -0.3, length=free.length + step).energy - free.energy
        for step in (-1e-4, 1e-4)
    ]
    assert min(gains) > 0.0
    assert max(gains) < 1e-5


def test_2000_pairs_of_end_angles_within_1_rad_are_all_solved() -> None:
    """Free length: both directions and the end of the chord are met to 1e-9."""
    alpha, beta = np.random.default_rng(8).uniform(-1.0, 1.0, (2, 2000))
    phi0, span, found = fit_amplitudes(alpha, beta, FREE_MODULUS)
    assert found.all()
    for i in range(0, 2000, 100):
        rod = fit_elastica([3, 1], [1, 6], alpha[i], beta[i])
        assert (rod.phi0, rod.phi1 - rod.phi0) == pytest.approx((phi0[i], span[i]), abs=1e-9)
    worst = 0.0
    for a, b, low, wide in zip(alpha, beta, phi0, span, strict=True):
        rod = Elastica.make(FREE_MODULUS, low, low + wide)
        end = rod.frame_point(low + wide)
        chord = np.arctan2(end[1], end[0])
        off = rod.direction([0.0, rod.length]) - chord - [a, b]
        worst = max(worst, float(np.abs(np.sin(off)).max()))
    assert worst < 1e-9


@pytest.mark.parametrize("part", [0.05, 0.5, 0.95])
@pytest.mark.parametrize(("alpha", "beta"), [(0.5, -0.5), (0.9, 0.2), (0.0, 0.4), (1.0, -1.0)])
def test_any_length_within_the_attainable_range_is_reached(
    alpha: float, beta: float, part: float
) -> None:
    """Lengths between the two that the refusal names: ends, tangents and length are met."""
    with pytest.raises(GeometryError) as refused:
        fit_elastica([1, 1], [3, 2], alpha, beta, length=50.0)
    low, high = (float(refused.value.values[name]) for name in ("least", "most"))  # type: ignore[arg-type]
    length = low + part * (high - low)
    rod = fit_elastica([1, 1], [3, 2], alpha, beta, length=length)
    assert rod.length == pytest.approx(length, rel=1e-12)
    assert rod.at(rod.length) == pytest.approx((3.0, 2.0), abs=1e-12)
    off = rod.direction([0.0, rod.length]) - np.arctan2(1.0, 2.0) - [alpha, beta]
    assert np.abs(np.sin(0.5 * off)).max() < 1e-10


def test_no_angles_give_the_straight_line() -> None:
    """Both end angles nil: the chord, of no curvature and no energy."""
    line = fit_elastica([1, 1], [4, 5], 0.0, 0.0)
    assert line.is_straight
    assert (line.length, line.energy) == (5.0, 0.0)
    assert line.at([0.0, 2.5, 5.0]).tolist() == [[1.0, 1.0], [2.5, 3.0], [4.0, 5.0]]
    assert line.curvature([1.0, 2.0]).tolist() == [0.0, 0.0]


def test_end_angles_need_a_least_modulus() -> None:
    """Below sin(|alpha - beta| / 4) there is none; the refusal names it."""
    assert least_modulus(0.5, -0.3) == pytest.approx(np.sin(0.2))
    with pytest.raises(GeometryError, match=r"modulus well above 0\.198669"):
        fit_elastica([0, 0], [1, 0], 0.5, -0.3, k=0.1)


REFUSED: dict[str, tuple[Callable[[], object], str]] = {
    "a modulus of 1": (
        lambda: Elastica.make(1.0, 0, 1), "elastica: modulus k must lie in (0,1), not 1"
    ),
    "a modulus of nil": (
        lambda: fit_elastica([0, 0], [1, 0], 0.1, 0.1, k=0),
        "elastica: modulus k must lie in (0,1), not 0",
    ),
    "tangents run back": (
        lambda: fit_elastica([0, 0], [1, 0], 2.5, -2.5),
        "elastica: no solution found for end angles (2.5,-2.5); give end angles up to 1 rad",
    ),
    "too long": (
        lambda: fit_elastica([0, 0], [1, 0], 0.5, -0.3, length=2),
        "elastica: length 2 outside the attainable range [1.02624",
    ),
    "too short": (
        lambda: fit_elastica([0, 0], [1, 0], 0.5, -0.3, length=1.01),
        "elastica: length 1.01 outside the attainable range [1.02624",
    ),
    "straight and longer than its chord": (
        lambda: fit_elastica([0, 0], [1, 0], 0, 0, length=1.5),
        "elastica: length 1.5 outside the attainable range [1,1]",
    ),
    "length of no solution": (
        lambda: fit_elastica([0, 0], [1, 0], 2.5, -2.5, length=1.5),
        "elastica: no solution found for end angles (2.5,-2.5)",
    ),
    "beyond its end": (
        lambda: Elastica.make(0.6, 0, 1).at(2), "elastica: x=2 outside [0, 1.05"
    ),
    "amplitudes that fall": (
        lambda: Elastica.make(0.6, 1, 0), "elastica: amplitudes 1 to 0 at a rate of 1"
    ),
    "one point": (
        lambda: fit_elastica([1, 1], [1, 1], 0.1, 0.1), "elastica: coincident points"
    ),
    "length and modulus": (
        lambda: fit_elastica([0, 0], [1, 0], 0.1, 0.1, k=0.5, length=1.1),
        "elastica: both a length and a modulus are given",
    ),
    "an angle that is none": (
        lambda: fit_elastica([0, 0], [1, 0], float("nan"), 0.1),
        "elastica: non-finite value at index 0",
    ),
}  # fmt: skip


@pytest.mark.parametrize(("call", "message"), REFUSED.values(), ids=REFUSED)
def test_what_is_no_elastica_is_refused(call: Callable[[], object], message: str) -> None:
    """One line that names the numbers."""
    with pytest.raises(GeometryError) as refused:
        call()
    assert str(refused.value).startswith(message)
