"""Sections of Wigley's hull: parabolas, of which every measure has a closed form."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.analysis.form.parameter import FormValue
from tests.nets import wigley_net

DRAUGHT, SHAFT, DIAMETER = 6.25, 2.5, 2.5
SCREW = ah.form.Screw(height=SHAFT, diameter=DIAMETER)


@pytest.fixture(scope="module")
def found() -> Mapping[str, FormValue]:
    """Form parameters of a net of 41 stations and 9 waterlines, whose splines are off by 1e-6."""
    return ah.Hull(wigley_net(41, 9)).form_parameters(screw=SCREW)


def number(found: Mapping[str, FormValue], symbol: str) -> float:
    """The number of an entry, which must be there."""
    value = found[symbol]
    assert value.number is not None, value.reason
    return value.number


def half(station: float, z: float = DRAUGHT) -> float:
    """Half-breadth of the formula."""
    x, t = station / 10.0 - 1.0, z / DRAUGHT
    return 5.0 * (1.0 - x * x) * (2.0 * t - t * t)


def radius(station: float) -> float:
    """Circle through three places: a b c / (4 area)."""
    places = np.array([[half(station, q * DRAUGHT), q * DRAUGHT] for q in (0.25, 0.5, 0.75)])
    a, b, c = (np.hypot(*(places[i] - places[j])) for i, j in ((0, 1), (1, 2), (0, 2)))
    (p, q), (r, s) = places[1] - places[0], places[2] - places[0]
    return float(a * b * c / (2.0 * abs(p * s - q * r)))


def test_breadths_at_the_shaft(found: Mapping[str, FormValue]) -> None:
    """BCL, B07, Tau at station 2."""
    shaft, blade = half(2.0, SHAFT), half(2.0, SHAFT + 0.35 * DIAMETER)
    assert number(found, "BCL") == pytest.approx(shaft, abs=1e-5)
    assert number(found, "B07") == pytest.approx(blade, abs=1e-5)
    tau = np.degrees(np.arctan2(half(2.0) - shaft, DRAUGHT - SHAFT))
    assert number(found, "Tau") == pytest.approx(tau, abs=1e-4)


@pytest.mark.parametrize(("symbol", "station"), [("S3", 1.5), ("S3'", 1.0)])
def test_the_stern_area_ratio(found: Mapping[str, FormValue], symbol: str, station: float) -> None:
    """Above SCH the parabola stands off its chord by b (t - t^2); its area is 2/3 b T."""
    low, whole = SHAFT / DRAUGHT, half(station) * DRAUGHT
    outside = whole * ((1.0 - low**2) / 2.0 - (1.0 - low**3) / 3.0)
    assert number(found, f"{symbol}.A1") == pytest.approx(outside, rel=1e-5)
    assert number(found, f"{symbol}.A2") == pytest.approx(2.0 / 3.0 * whole, rel=1e-5)
    assert number(found, symbol) == pytest.approx(1.5 * outside / whole, rel=1e-5)


@pytest.mark.parametrize(("symbol", "station"), [("Rfwd", 19.5), ("Raft", 1.5)])
def test_the_radius_of_sections(
    found: Mapping[str, FormValue], symbol: str, station: float
) -> None:
    """Convex."""
    assert number(found, symbol) == pytest.approx(radius(station), rel=1e-5)


def test_the_diagonal_is_cut_in_the_golden_section(found: Mapping[str, FormValue]) -> None:
    """Where 2 t - t^2 = 1 - t; the section of a third of the area has 1 - x^2 = 1/3."""
    golden = 0.5 * (np.sqrt(5.0) - 1.0)
    diagonal = np.hypot(DRAUGHT, 5.0 / 3.0)
    assert number(found, "x_third") == pytest.approx(50.0 + 50.0 * np.sqrt(2.0 / 3.0), abs=5e-4)
    assert number(found, "Ldiag") == pytest.approx(diagonal, abs=1e-5)
    assert number(found, "L") == pytest.approx(golden * diagonal, abs=1e-5)
    assert number(found, "L/Ldiag") == pytest.approx(golden, abs=1e-6)
