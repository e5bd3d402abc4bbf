"""Straight runs: where they end, in what, and how surely that is known."""

import numpy as np
import pytest

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.polylines.noise import point_scatter
from assoc_hull.geometry.polylines.straight_runs import StraightRunRule, find_straight_runs
from assoc_hull.shipped.wigley import wigley_half_breadth
from tests.unit.geometry.planted import NOISE, Planted

SEEDS = 200


def test_a_flat_of_side_that_ends_in_an_arc_is_found() -> None:
    """A flat ending in a radius of 3 m, 200 seeds: onset within 50 mm, radius within 1 % at p95.

    An onset that is reported without a place counts as missed.
    """
    curve = Planted(13.0, lambda s: np.where(s > 8.0, 1 / 3.0, 0.0))
    truth = curve.at(8.0)
    off, radius = [], []
    for seed in range(SEEDS):
        points = curve.digitised(seed)
        [run] = find_straight_runs(points, point_scatter(points))
        arc = run.after.kind == "arc"
        off.append(float(np.linalg.norm(run.after.place - truth)) if arc else np.inf)
        radius.append(abs(run.after.radius / 3.0 - 1.0) if arc else np.inf)
    print(
        f"\nflat ending in 3 m radius, {SEEDS} seeds: onset p95 "
        f"{1e3 * np.percentile(off, 95):.1f}, max {1e3 * max(off):.1f} mm; radius p95 "
        f"{100 * np.percentile(radius, 95):.2f} %"
    )
    assert np.percentile(off, 95, method="higher") < 0.05
    assert np.percentile(radius, 95, method="higher") < 0.01


@pytest.mark.parametrize(
    ("power", "size"),
    [pytest.param(1, 0.04, id="curvature grows evenly"),
     pytest.param(2, 0.03, id="curvature grows as a square")],
)  # fmt: skip
def test_a_gradual_onset_has_no_place(power: int, size: float) -> None:
    """Curvature that grows from nil, 200 seeds: no place and no radius, but how sure it is.

    It begins within the doubt that is stated.
    """
    curve = Planted(14.0, lambda s: size * np.clip(s - 8.0, 0.0, None) ** power)
    kinds, off, doubt = [], [], []
    for seed in range(SEEDS):
        points = curve.digitised(seed)
        [run] = find_straight_runs(points, point_scatter(points))
        kinds.append(run.after.kind)
        off.append(abs(run.after.at - 8.0))
        doubt.append(run.after.uncertainty)
        assert np.isnan(run.after.place).all()
        assert np.isnan(run.after.radius)
    inside = int((np.array(off) < np.array(doubt)).sum())
    print(
        f"\nonset whose curvature grows with the power {power}, {SEEDS} seeds: "
        f"{kinds.count('gradual')} without a place, known to +-{np.median(doubt):.2f} m (median); "
        f"it begins within that in {inside}"
    )
    assert kinds.count("gradual") == SEEDS
    assert inside >= 0.95 * SEEDS


def ellipse() -> FloatArray:
    """A section of an ellipsoid, half-axes 5 m and 6 m, in steps of about 0.1 m."""
    t = np.linspace(0.0, 0.5 * np.pi, 90)
    return np.column_stack([5.0 * np.sin(t), 6.0 - 6.0 * np.cos(t)])


def parabola() -> FloatArray:
    """A waterline of the Wigley hull."""
    x = np.linspace(0.0, 100.0, 201)
    return np.column_stack([x, wigley_half_breadth(x, np.full(201, 5.0), 100.0, 10.0, 6.25)])


@pytest.mark.parametrize(
    "line", [pytest.param(ellipse(), id="ellipsoid"), pytest.param(parabola(), id="Wigley")]
)
def test_smooth_hulls_have_no_straight_run(line: FloatArray) -> None:
    """Lines of smooth analytic hulls, bare and with 1 mm noise, have no run.

    All lines of two such hulls, with 200 seeds: `tests/cases/test_analytic_hulls_are_smooth.py`.
    """
    assert find_straight_runs(line, 0.0) == []
    for seed in range(SEEDS // 4):
        noisy = line + np.random.default_rng(seed).normal(0.0, NOISE, line.shape)
        assert find_straight_runs(noisy, point_scatter(noisy)) == []


def test_what_counts_as_a_run_is_settable() -> None:
    """A flat of 2 m is a run, unless runs of 3 m and more are asked for."""
    curve = Planted(8.0, lambda s: np.where(abs(s - 4.0) > 1.0, 0.5, 0.0))
    points = curve.digitised(1, 0.05)
    assert len(find_straight_runs(points, NOISE)) == 1
    assert find_straight_runs(points, NOISE, StraightRunRule(least=3.0)) == []


def test_a_line_that_is_straight_throughout_is_one_run() -> None:
    """A straight line with noise is one run from end to end."""
    points = Planted(10.0, lambda s: 0.0 * s).digitised(3)
    [run] = find_straight_runs(points, point_scatter(points))
    assert (run.before.kind, run.after.kind) == ("end", "end")
    assert run.end - run.begin > 9.7
