"""Strips cut by planes across the ship."""

import numpy as np
import pytest

from assoc_hull.analysis.half_section import as_spline
from assoc_hull.geometry.integrals import section_area
from assoc_hull.geometry.surface_cut import cut_across
from tests.exact_hulls import ellipsoid, wigley


@pytest.mark.parametrize("x", [3.0, 50.0, 92.5])
def test_a_cut_of_an_ellipsoid_is_an_ellipse(x: float) -> None:
    """Its area below z is pi b c k^2 / 2 for the lower half, k the scale there."""
    scale2 = 1.0 - ((x - 50.0) / 50.0) ** 2
    [piece] = cut_across(ellipsoid(tiles=60), 0, x)
    area = float(section_area(as_spline(piece), 6.0)[0])
    assert area == pytest.approx(0.25 * np.pi * 8.0 * 6.0 * scale2, rel=2e-6)
    assert np.abs(piece[:, 0, 0] - x).max() == 0.0


def test_a_cut_of_wigley_has_its_offsets() -> None:
    """Every place of it is on the formula."""
    [piece] = cut_across(wigley(), 0, 30.0)
    _, y, z = piece.sum(axis=1).T
    up = np.minimum(z, 6.25)
    exact = 5.0 * (1.0 - 0.16) * (1.0 - ((up - 6.25) / 6.25) ** 2)
    assert y == pytest.approx(exact, abs=1e-11)


def test_a_plane_that_misses_cuts_nothing() -> None:
    """Beyond the strip there is no section."""
    assert cut_across(wigley(), 0, 101.0) == []
