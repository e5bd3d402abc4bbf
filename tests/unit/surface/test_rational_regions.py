"""Regions of rational surfaces whose areas are known: torus, sphere, cone."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import assoc_hull as ah
from tests.rational_surfaces import circle, turned


def torus() -> ah.surface.SplineSurface:
    """R = 3 m, r = 1 m: 16 patches."""
    points, weights, knots = circle()
    return turned(points + np.array([3.0, 0.0]), weights, knots, 2, "torus")


def test_regions_of_a_torus_turned_far_away() -> None:
    """2 pi r (pi R + 2 r) of it is convex, 2 pi r (pi R - 2 r) a saddle, to 1e-13 of the total.

    The circles where K = 0 are borders of patches: two lines, closed but for the seam.
    """
    there = Rotation.from_euler("xyz", [0.3, 0.5, 0.7]).as_matrix().T
    plain = torus()
    moved = ah.surface.SplineSurface(
        "torus", plain.degrees, plain.knots_u, plain.knots_v,
        plain.net @ there + [100.0, 0.0, 5.0], plain.weights,
    )  # fmt: skip
    for surface in (plain, moved):
        found = ah.surface.curvature_regions(surface, zero="exact", area_tol=1e-10)
        assert found.positive == pytest.approx(2 * np.pi * (3 * np.pi + 2), rel=1e-13)
        assert found.negative == pytest.approx(2 * np.pi * (3 * np.pi - 2), rel=1e-13)
        assert found.zero == found.unresolved == 0.0
        assert [each.kind for each in found.components] == ["edge_line"] * 2


def test_a_band_on_a_torus() -> None:
    """Beyond K = 0.1 1/m2 lies what the closed form says; four circles bound it."""
    found = ah.surface.curvature_regions(torus(), zero="absolute", k0=0.1, area_tol=1e-10)
    above, below = (2 * (3 * a + np.sin(a)) for a in (np.arccos(0.3 / 0.9), np.arccos(-0.3 / 1.1)))
    assert found.positive == pytest.approx(2 * np.pi * above, rel=1e-13)
    assert found.negative == pytest.approx(2 * np.pi * (6 * np.pi - below), rel=1e-13)
    assert len(found.components) == 4


@pytest.mark.parametrize(("k0", "positive"), [(0.24, 1.0), (0.25, 0.0), (0.26, 0.0)])
def test_a_sphere_is_all_of_one_kind(k0: float, positive: float) -> None:
    """With both poles, K = 1 / r**2 everywhere: at that level nothing lies above the band."""
    curve = 2.0 * np.array([(0, -1), (1, -1), (1, 0), (1, 1), (0, 1)])
    weights, knots = circle()[1][:5], np.array([0.0, 0, 0, 1, 1, 2, 2, 2])
    sphere = turned(curve, weights, knots, 2, "sphere")
    found = ah.surface.curvature_regions(sphere, zero="absolute", k0=k0, area_tol=1e-10)
    assert found.positive == pytest.approx(positive * 16 * np.pi, rel=1e-13)
    assert found.zero == pytest.approx((1.0 - positive) * 16 * np.pi, rel=1e-13)
    assert found.components == ()


def test_a_cone_is_developable() -> None:
    """Exactly, with no band: its area is pi (r1 + r2) times the length of its rulings."""
    cone = turned(np.array([[1.0, 0], [0.3, 5]]), np.array([1.0, 2]), np.repeat([0.0, 1], 2), 1, "")
    found = ah.surface.curvature_regions(cone, zero="exact", area_tol=1e-10)
    assert found.zero == pytest.approx(np.pi * 1.3 * np.hypot(0.7, 5.0), rel=1e-13)
    assert found.positive == found.negative == 0.0
