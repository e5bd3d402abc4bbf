"""What the parts of `geometry.fitting` give, one small example of each."""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.fitting.fit_input import HeldControls, Samples
from assoc_hull.geometry.fitting.fit_surface import (
    even_breaks,
    fit_refined,
    fit_surface,
    subdivide_bays,
)
from assoc_hull.geometry.fitting.surface_joints import strip_of
from assoc_hull.geometry.patches.spline_surface import SplineSurface


def test_where_spans_of_a_fitted_surface_meet_from_given() -> None:
    """Where spans of a fitted surface meet: from given places, and more where it does not
    follow."""
    assert subdivide_bays(np.array([0.0, 1.0, 4.0]), np.array([1, 3])).tolist() == [
        0.0,
        1.0,
        2.0,
        3.0,
        4.0,
    ]


def test_a_smooth_surface_through_points_of_lines_solve_correct() -> None:
    """A smooth surface through points of lines: solve, correct the parameters, and again."""
    uv = np.stack(np.meshgrid(np.linspace(0, 4, 30), np.linspace(0, 2, 30)), axis=-1)
    x, y = uv.reshape(-1, 2).T
    samples = Samples.of(np.column_stack([x, y]), np.column_stack([x, y, 0.1 * x**2]))
    found = fit_surface("trough", samples, even_breaks(0, 4, 8), even_breaks(0, 2, 4), 1e-9)
    assert (bool(found.residual.max() < 1e-6), found.surface.net.shape) == (True, (11, 7, 3))


def test_more_knots_where_a_fitted_surface_does_not_follow() -> None:
    """More knots where a fitted surface does not follow its points."""
    x, y = (each.ravel() for each in np.meshgrid(np.linspace(0, 8, 81), np.linspace(0, 2, 9)))
    wave = np.where(x > 6, 0.3 * np.sin(1.5 * (x - 6)) ** 3, 0.0)
    samples = Samples.of(np.column_stack([x, y]), np.column_stack([x, y, wave]))
    found = fit_refined("wave", samples, even_breaks(0, 8, 4), even_breaks(0, 2, 1), 1e-9, 0.01)
    assert (found.spans[0] > 6, bool(np.percentile(found.residual, 95) < 0.01)) == (True, True)


def test_points_that_a_surface_is_fitted() -> None:
    """Points that a surface is fitted to, with the parameters they are thought to have."""
    uv = np.array([[0.0, 0.0], [1.0, 0.5]])
    found = Samples.of(uv, np.zeros((2, 3)), weight=0.6)
    assert (len(found), found.held.tolist()) == (2, [[False, False], [False, False]])


def test_coordinates_of_control_points_that_a_fit_may_not() -> None:
    """Coordinates of control points that a fit may not change."""
    keel = HeldControls.none((5, 4)).on("v0", 0.0, axes=(1,))
    assert int(keel.mask.sum()) == 5


def test_what_one_surface_hands_to_another_at_a_border() -> None:
    """What one surface hands to another at a border: its row, and how it goes on across it."""
    net = np.zeros((4, 4, 3))
    net[..., 0], net[..., 1] = np.mgrid[0:4, 0:4]
    knots = np.repeat([0.0, 3.0], 4)
    strip = strip_of(SplineSurface("plane", (3, 3), knots, knots, net), "u1")
    assert (strip.row[0].tolist(), strip.across[0].tolist()) == ([3.0, 0.0, 0.0], [1.0, 0.0, 0.0])
