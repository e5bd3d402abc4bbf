"""Circles drawn anew: angles, radii, tangent planes, and points that are enough."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.interpolate import BPoly, CubicSpline

from assoc_hull.edit.space_map import affine
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import CurveData, EndKind, FloatArray
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.segments import sample
from assoc_hull.variation.features.redrawn_circles import (
    SpaceCircle,
    redraw_circle,
    tangent_point,
)

BOSS = SpaceCircle.of([6.0, 0.0, 5.0], 0.725, [1.0, 0.0, 0.0])
UNIT = SpaceCircle.of([0.0, 0.0, 0.0], 1.0, [1.0, 0.0, 0.0])


def half(count: int) -> FloatArray:
    """Give the directions of points of half a circle, from below to above."""
    angle = np.linspace(-np.pi / 2.0, np.pi / 2.0, count)
    return np.column_stack([0.0 * angle, np.cos(angle), np.sin(angle)])


@pytest.mark.parametrize(
    ("count", "error"), [(9, "1.4e-04"), (17, "8.8e-06"), (33, "5.5e-07"), (65, "3.5e-08")]
)
def test_a_clamped_half_circle_is_as_round_as_its_points_make_it(count: int, error: str) -> None:
    """Largest error of the radius, r = 1, ends clamped with the exact tangents."""
    ends = np.array([[0.0, 1.0, 0.0], [0.0, -1.0, 0.0]])
    clamped = CurveData.single(
        half(count), end_kind=(EndKind.TANGENT, EndKind.TANGENT), end_vector=ends
    )
    worst = abs(np.hypot(*sample(loft(clamped), 100)[1][:, 1:].T) - 1.0).max()
    assert f"{worst:.1e}" == error


@pytest.mark.parametrize(
    ("count", "error"), [(9, "6.5e-04"), (17, "4.2e-05"), (33, "2.6e-06"), (65, "1.6e-07")]
)
def test_without_clamps_even_a_not_a_knot_spline_misses_the_micrometre(
    count: int, error: str
) -> None:
    """So 33 points are enough only with clamps."""
    angle = np.linspace(-np.pi / 2.0, np.pi / 2.0, count)
    curve = CubicSpline(angle, np.column_stack([np.cos(angle), np.sin(angle)]))
    fine = curve(np.linspace(angle[0], angle[-1], 40_001))
    assert f"{abs(np.hypot(*fine.T) - 1.0).max():.1e}" == error


@pytest.mark.parametrize(("count", "error"), [(1, "1.8e-02"), (2, "2.7e-04"), (4, "4.2e-06")])
def test_bezier_arcs_need_eight_for_the_micrometre(count: int, error: str) -> None:
    """A half circle by 1, 2 and 4 cubics; 8 are within 1e-6."""
    assert f"{_bezier(count):.1e}" == error
    assert _bezier(8) < 1e-6


def _bezier(count: int) -> float:
    """Give the largest error of the radius of half a circle by Bezier cubics."""
    step = np.pi / count
    arm = 4.0 / 3.0 * np.tan(step / 4.0)
    corner = np.array([[1.0, 0.0], [1.0, arm]])
    end = np.array([np.cos(step), np.sin(step)])
    points = np.vstack([corner, end + arm * np.array([end[1], -end[0]]), end])
    fine = BPoly(points[:, None, :], [0.0, 1.0])(np.linspace(0.0, 1.0, 2001))
    return float(abs(np.hypot(*fine.T) - 1.0).max())


def test_the_centre_is_the_image_and_the_radius_keeps_the_area() -> None:
    """Where none is asked: r sqrt|det J| in the plane of the circle."""
    wide = affine([1.0, 1.05, 1.2], [0.0, 0.0, 0.4])
    after = redraw_circle("boss", BOSS, wide, wide.jacobian).after
    assert after.centre.tolist() == [6.0, 0.0, 1.2 * 5.0 + 0.4]
    assert after.radius == pytest.approx(0.725 * np.sqrt(1.05 * 1.2), rel=1e-15)


def test_asked_radius_and_centre_are_taken_as_they_are() -> None:
    """To the last bit."""
    up = affine(None, [0.0, 0.0, 0.98])
    after = redraw_circle("boss", BOSS, up, up.jacobian, radius=0.75, centre=[6.0, 0.0, 6.0]).after
    assert (after.centre.tolist(), after.radius) == ([6.0, 0.0, 6.0], 0.75)


def test_only_what_nothing_is_asked_of_is_idle() -> None:
    """A map that leaves a circle alone leaves work all the same where a radius is asked for."""
    still = affine(None, [0.0, 0.0, 0.0])
    assert redraw_circle("boss", BOSS, still, still.jacobian).idle
    assert not redraw_circle("boss", BOSS, still, still.jacobian, radius=0.75).idle
    up = affine(None, [0.0, 0.0, 0.98])
    assert not redraw_circle("boss", BOSS, up, up.jacobian).idle


def test_angles_are_kept() -> None:
    """Each place of the circle goes to C + r (cos, sin) of its old angle, axes to the bit."""
    up = affine(None, [0.0, 0.0, 1.0])
    drawn = redraw_circle("boss", BOSS, up, up.jacobian, radius=0.75)
    units, old = half(5), BOSS.at(half(5))
    assert np.abs(BOSS.unit(old)[0] - units).max() < 1e-15
    assert drawn.after.at(units)[2].tolist() == [6.0, 0.75, 6.0]


def test_a_map_that_differs_too_much_is_refused() -> None:
    """More than a tenth of the radius: the region is too small for what is asked."""
    still = affine([1.0, 1.0, 1.0], None)
    with pytest.raises(
        BadInputError, match=r"feature 'boss' differs 0\.14 m from the varied curve"
    ):
        redraw_circle("boss", BOSS, still, still.jacobian, radius=0.865)


@pytest.mark.parametrize("near", [0.0, 9e-7, -9e-7])
def test_a_plane_within_a_micrometre_of_tangent_touches_at_one_place(near: float) -> None:
    """At the circle's own place, in the plane to the bit."""
    boss = SpaceCircle.of([6.0, 0.0, 6.0], 1.0, [1.0, 0.0, 0.0])
    found = tangent_point(boss, [0.0, 1.0, 0.0], 1.0 + near)
    assert found is not None
    assert found.tolist() == [6.0, 1.0 + near, 6.0]
    below = tangent_point(boss, [0.0, 0.0, 1.0], 5.0 + near)
    assert below is not None
    assert below.tolist() == [6.0, 0.0, 5.0 + near]


@pytest.mark.parametrize("offset", [1.0 + 2e-6, 1.0 - 2e-6, 0.5, 0.0])
def test_other_planes_do_not_touch(offset: float) -> None:
    """They pass by, or cut the circle twice; its own plane never touches it."""
    boss = SpaceCircle.of([6.0, 0.0, 6.0], 1.0, [1.0, 0.0, 0.0])
    assert tangent_point(boss, [0.0, 1.0, 0.0], offset) is None
    assert tangent_point(boss, [1.0, 0.0, 0.0], 6.0) is None


def test_a_sampled_curve_may_miss_a_tangent_plane() -> None:
    """Which is why touching is decided by the circle: 33 points between the widest place."""
    angle = np.linspace(-np.pi / 2.0, np.pi / 2.0, 34)
    assert np.cos(angle).max() < 1.0
