"""A hull of Lewis sections: its net has the areas that were asked for."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.polynomial.polynomial import polyval

import assoc_hull as ah
from assoc_hull.analysis.hydrostatics.flotation import flotation
from assoc_hull.analysis.hydrostatics.section_areas import area_curve
from assoc_hull.creation.classical.classical_net import classical_net
from assoc_hull.creation.classical.lewis_hull import LewisHull
from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.polynomial_hulls import taylor_quintic
from assoc_hull.geometry.floating.immersion import FloatingPlanes

X = np.linspace(0.0, 120.0, 21)
ALONG = 1.0 - np.abs(X / 60.0 - 1.0)


def ship(**other: Any) -> LewisHull:
    """120 m, waterlines and area coefficients by Taylor's quintic."""
    given: dict[str, Any] = {
        "x": X,
        "half_breadth": np.maximum(9.0 * polyval(ALONG, taylor_quintic(2.4, -0.2, 0.72)), 0.0),
        "coefficient": 0.62 + 0.31 * polyval(ALONG, taylor_quintic(1.8, -2.2, 0.7)),
        "draught": 7.0,
        "depth": 10.0,
        "levels": [0.5, 1, 2, 3, 4, 5, 6],
    }
    return LewisHull.make(**{**given, **other})


@pytest.fixture(scope="module")
def hull() -> ah.Hull:
    """The net of it."""
    return ah.Hull(classical_net(ship())[0])


def test_the_net_is_whole_and_has_the_areas(hull: ah.Hull) -> None:
    """No findings; areas of sections within 1e-4 of sigma B T, volume within 1e-4 of theirs."""
    assert hull.check() == ()
    made = ship()
    curve = area_curve(
        flotation(hull.state), FloatingPlanes(np.array([7.0]), np.zeros(1), np.zeros(1))
    )
    np.testing.assert_allclose(curve.at(X[1:-1]), made.areas[1:-1], rtol=1e-4)
    report = made.report(hull.state)
    volume = report.figure("volume")
    assert volume.net == pytest.approx(volume.value, rel=1e-4)
    assert hull.hydrostatics().volume == pytest.approx(volume.value, rel=1e-4)
    assert report.figure("centre of volume, x").net == pytest.approx(60.0, abs=1e-6)
    worst = report.worst
    assert worst is not None
    assert worst.distance < 1.5e-3


def test_waterlines_lie_on_the_sections() -> None:
    """The half-breadth at a level is that of the image there."""
    made = ship()
    y = made.at_level(3.0)[1:-1]
    t = np.linspace(0.0, 0.5 * np.pi, 20_001)
    for section, found in zip(made.sections.at(t), y, strict=True):
        assert np.interp(3.0, 7.0 - section[:, 1], section[:, 0]) == pytest.approx(found, abs=1e-6)
    np.testing.assert_allclose(made.at_level(7.0), made.half_breadth, atol=1e-12)


REFUSED: dict[str, tuple[str, Callable[[], object]]] = {
    "stations": ("Lewis hull: 21 stations that do not all rise", lambda: ship(x=X[::-1])),
    "ends": (
        "Lewis hull: half-breadths 1, 1 at the ends", lambda: ship(half_breadth=np.ones(21))
    ),
    "levels": (r"Lewis hull: draught 7, depth 10, levels \[8.0\]", lambda: ship(levels=[8])),
    "swells": (
        r"Lewis hull: section at x=\d+ swells 0\.\d+ m below the base",
        lambda: ship(coefficient=np.full(21, 0.96)),
    ),
    "folded": (
        "conformal section: not simple", lambda: ship(coefficient=np.full(21, 0.3))
    ),
    "other counts": (r"Lewis hull: expected shape \(21\)", lambda: ship(coefficient=[0.9])),
}  # fmt: skip


@pytest.mark.parametrize(("message", "call"), REFUSED.values(), ids=REFUSED)
def test_what_makes_no_lewis_hull_is_refused(message: str, call: Callable[[], object]) -> None:
    """With the place and what to do."""
    with pytest.raises(GeometryError, match=message):
        call()
