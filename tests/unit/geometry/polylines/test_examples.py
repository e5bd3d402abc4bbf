"""What the parts of `geometry.polylines` give, one small example of each."""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.polylines.corners import Corner, find_corners, join_corners
from assoc_hull.geometry.polylines.smoothing import FitTie, fit_polyline, join_fits, smooth_polyline
from assoc_hull.geometry.polylines.straight_runs import find_straight_runs, fit_onset


def test_corners_of_plane_polylines_told_from_tight_bends() -> None:
    """Corners of plane polylines, told from tight bends by looking at two scales."""
    t = np.linspace(-5.0, 5.0, 101)
    bent = np.column_stack([t, np.where(t > 0.03, np.tan(np.deg2rad(12.0)) * (t - 0.03), 0.0)])
    [corner] = find_corners(bent, 1e-4)
    assert (round(corner.turn_deg, 2), round(float(corner.place[0]), 3)) == (12.0, 0.03)


def test_corners_of_neighbouring_lines_joined_to_knuckle_lines() -> None:
    """Corners of neighbouring lines joined to knuckle lines."""
    lines = [[Corner(1.0, np.array([5.0, 2.0 + 0.1 * i]), 6.0, 0.9, 0.6)] for i in range(4)]
    assert join_corners(np.array([0.0, 2.0, 4.0, 6.0]), lines) == [((0, 0), (1, 0), (2, 0), (3, 0))]


def test_the_smoothest_curve_within_a_tolerance_of_a_polyline() -> None:
    """The smoothest curve within a tolerance of a polyline."""
    t = np.linspace(0.0, 3.0, 200)
    noise = np.random.default_rng(1).normal(0.0, 1e-3, (200, 2))
    fit = smooth_polyline(10.0 * np.column_stack([np.cos(t), np.sin(t)]) + noise, 3e-3)
    radius = np.sqrt((fit.points**2).sum(axis=1))
    assert (bool(np.abs(radius - 10.0).max() < 3e-3), bool(fit.residual < 6e-3)) == (True, True)


def test_smooth_curves_that_meet_the_penalised_fits_of_many() -> None:
    """Smooth curves that meet: the penalised fits of many polylines, solved as one."""
    x = np.linspace(0.0, 10.0, 40)
    one = fit_polyline(np.column_stack([x, np.sin(0.3 * x)]), 5e-3)
    other = fit_polyline(np.column_stack([x, np.sin(0.3 * x) + 2e-3]), 5e-3)
    up = np.array([0.0, 1.0])
    assert one is not None
    assert other is not None
    ties = [FitTie(0, place, up, 1, place, up, 0.0) for place in (3.0, 5.0, 7.0)]
    low, high = (fit.draw().points for fit in join_fits([one, other], ties, 1e-4))
    assert bool(np.abs(np.interp(5.0, *low.T) - np.interp(5.0, *high.T)) < 3e-4)


def test_where_a_curve_leaves_a_straight_line_the_zero() -> None:
    """Where a curve leaves a straight line: the zero of sqrt(deviation), as a fit."""
    t = np.linspace(0.0, 12.0, 121)
    u = np.where(t > 10.0, 3.0 - np.sqrt(9.0 - np.clip(t - 10.0, 0.0, 2.0) ** 2), 0.0)
    found = fit_onset(t, u, 101, 1e-3, 1e-4, 6.0)
    assert found.radius is not None
    assert (round(found.zero, 3), round(found.radius, 3)) == (10.0, 3.0)


def test_straight_runs_of_plane_polylines_and_where_a_curve() -> None:
    """Straight runs of plane polylines, and where a curve leaves them."""
    t = np.linspace(0.0, 13.0, 131)
    angle = np.clip(t - 10.0, 0.0, None) / 3.0
    x = np.where(t < 10.0, t, 10.0 + 3.0 * np.sin(angle))
    line = np.column_stack([x, 3.0 * (1.0 - np.cos(angle))])
    [run] = find_straight_runs(line, 1e-4)
    assert (run.after.kind, round(float(run.after.place[0]), 2), round(run.after.radius, 2)) == (
        "arc",
        10.0,
        3.0,
    )
