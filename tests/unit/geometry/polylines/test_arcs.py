"""Circular arcs of digitised lines: found with their radius, and not where there is none."""

import numpy as np
import pytest

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.numeric.circle_fit import fit_circle
from assoc_hull.geometry.polylines.circular_arcs import ArcRule, find_arcs
from assoc_hull.geometry.polylines.noise import point_scatter
from tests.unit.geometry.planted import NOISE, Planted
from tests.unit.geometry.polylines.test_straight import ellipse, parabola

SEEDS = 200


def planted(radius: float, turn: float, beside: float = 0.0, length: float = 12.0) -> Planted:
    """An arc that begins 4 m along a line of the curvature `beside`."""
    end = 4.0 + radius * turn
    return Planted(length, lambda s: np.where((s > 4.0) & (s < end), 1.0 / radius, beside))


@pytest.mark.parametrize(
    ("radius", "turn", "beside", "spacing"),
    [
        pytest.param(2.4, np.pi / 2, 0.0, 0.1, id="bilge of 2.4 m"),
        pytest.param(3.0, np.pi / 2, 0.03, 0.1, id="bilge of 3 m between curved sides"),
        pytest.param(0.725, np.pi, 0.0, 0.05, id="bossing end of 0.725 m"),
    ],
)
def test_a_planted_arc_is_found(radius: float, turn: float, beside: float, spacing: float) -> None:
    """At 1 mm noise, 200 seeds: one arc, its radius within 1 % and as sure as it says."""
    curve = planted(radius, turn, beside)
    ends = curve.at(np.array([4.0, 4.0 + radius * turn]))
    off, doubt, away = [], [], []
    for seed in range(SEEDS):
        points = curve.digitised(seed, spacing)
        [arc] = find_arcs(points, point_scatter(points))
        off.append(arc.radius / radius - 1.0)
        doubt.append(arc.uncertainty / radius)
        places = [each.place for each in (arc.before, arc.after) if each.kind == "arc"]
        known = [i for i, each in enumerate((arc.before, arc.after)) if each.kind == "arc"]
        away += [float(np.linalg.norm(p - ends[i])) for p, i in zip(places, known, strict=True)]
        assert np.degrees(turn) == pytest.approx(arc.turn_deg, abs=10.0)
    print(
        f"\narc of {radius} m, {SEEDS} seeds: radius within {100 * np.abs(off).max():.2f} % (p95 "
        f"{100 * np.percentile(np.abs(off), 95):.2f} %, stated one sigma {100 * np.mean(doubt):.2f}"
        f" %); {len(away)} of {2 * SEEDS} ends, p95 {1e3 * np.percentile(away, 95):.0f} mm off"
    )
    assert np.abs(off).max() < 0.01
    assert np.mean(doubt) == pytest.approx(np.std(off), rel=0.3)
    assert len(away) >= 0.9 * 2 * SEEDS
    assert np.percentile(away, 95) < 0.1


@pytest.mark.parametrize(
    "line", [pytest.param(ellipse(), id="ellipsoid"), pytest.param(parabola(), id="Wigley")]
)
def test_smooth_hulls_have_no_arc(line: FloatArray) -> None:
    """Lines whose curvature changes all along, bare and with 1 mm noise of 200 seeds: no arc."""
    assert find_arcs(line, 0.0) == []
    for seed in range(SEEDS):
        noisy = line + np.random.default_rng(seed).normal(0.0, NOISE, line.shape)
        assert find_arcs(noisy, point_scatter(noisy)) == []


def test_a_section_of_a_body_of_revolution_is_an_arc() -> None:
    """A circle from end to end is one arc: there it is true."""
    angle = np.linspace(0.0, np.pi / 2, 60)
    points = 5.0 * np.column_stack([np.sin(angle), -np.cos(angle)])
    points += np.random.default_rng(1).normal(0.0, NOISE, points.shape)
    [arc] = find_arcs(points, point_scatter(points))
    assert (arc.before.kind, arc.after.kind) == ("end", "end")
    assert arc.radius == pytest.approx(5.0, rel=2e-3)
    assert np.abs(arc.centre).max() < 0.02


def test_a_straight_line_is_no_arc() -> None:
    """A straight line with noise holds no arc."""
    points = Planted(10.0, lambda s: 0.0 * s).digitised(3)
    assert find_arcs(points, point_scatter(points)) == []


def test_an_arc_is_found_either_way_round() -> None:
    """A line turned round has the same arc, its ends counted from the other end."""
    points = planted(2.4, np.pi / 2).digitised(5)
    [one], [other] = find_arcs(points, NOISE), find_arcs(points[::-1].copy(), NOISE)
    assert other.radius == pytest.approx(one.radius, rel=1e-6)
    assert np.abs(other.centre - one.centre).max() < 1e-5
    assert np.linalg.norm(other.before.place - one.after.place) < 0.02


def test_what_counts_as_an_arc_is_settable() -> None:
    """An arc of 40 degrees is found by default, not by a rule that asks for 60."""
    points = planted(5.0, np.deg2rad(40.0)).digitised(1)
    assert len(find_arcs(points, NOISE)) == 1
    assert find_arcs(points, NOISE, ArcRule(least_deg=60.0)) == []


def test_a_circle_is_fitted_by_distances() -> None:
    """The centre of exact points far from the origin comes back, the radius with it."""
    angle = np.linspace(0.2, 0.9, 12)
    points = np.array([300.0, 20.0]) + 2.4 * np.column_stack([np.cos(angle), np.sin(angle)])
    circle = fit_circle(points)
    assert np.abs(circle.centre - [300.0, 20.0]).max() < 1e-9
    assert abs(circle.radius - 2.4) < 1e-9
