"""Biarcs drawn at random over all that is allowed: closure, tangents, radii, rules."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from assoc_hull.geometry.classical.biarc_family import one_bend_limit, one_bend_radii, ratio_radii
from assoc_hull.geometry.classical.biarcs import BiarcRule, Biarcs, biarcs
from assoc_hull.geometry.classical.checked_input import wrap_angle
from assoc_hull.geometry.curves import FloatArray

COUNT = 20_000
RULES: tuple[BiarcRule, ...] = ("inverse", "as_printed", "min_jump", "equal_chord")

Drawn = tuple[FloatArray, FloatArray, FloatArray, FloatArray]


def drawn_angles(rng: np.random.Generator, count: int) -> tuple[FloatArray, FloatArray]:
    """End angles to 1.5 rad; half of them special, a tenth each of five kinds."""
    alpha, beta = rng.uniform(-1.5, 1.5, (2, count))
    some = [slice(k * count // 10, (k + 1) * count // 10) for k in range(5)]
    beta[some[0]] = alpha[some[0]]
    beta[some[1]] = -alpha[some[1]]
    nothing = rng.integers(0, 3, count)[some[2]]
    alpha[some[2]] *= nothing == 1
    beta[some[2]] *= nothing == 2
    tiny = 1e-8 * rng.choice([-1.0, 1.0], (2, count))
    which = rng.random(count) < 0.5
    alpha[some[3]] = np.where(which, tiny[0], alpha)[some[3]]
    beta[some[3]] = np.where(which, beta, tiny[1])[some[3]]
    small = 10.0 ** rng.uniform(-9.0, -3.0, (2, count))
    alpha[some[4]] = (np.sign(alpha) * small[0])[some[4]]
    beta[some[4]] = (np.sign(beta) * small[1])[some[4]]
    return alpha, beta


def drawn(seed: int, count: int) -> tuple[Drawn, FloatArray]:
    """Points and directions, in all directions; chords from 0.01 to 1000, evenly by logarithm."""
    rng = np.random.default_rng(seed)
    chord, way = 10.0 ** rng.uniform(-2.0, 3.0, count), rng.uniform(-np.pi, np.pi, count)
    first = rng.uniform(-1.0, 1.0, (count, 2)) * chord[:, None]
    last = first + chord[:, None] * np.stack([np.cos(way), np.sin(way)], axis=1)
    alpha, beta = drawn_angles(rng, count)
    return (first, wrap_angle(way + alpha), last, wrap_angle(way + beta)), chord


def closure(found: Biarcs, last: FloatArray) -> FloatArray:
    """How far the arcs miss the join and the last point, m, the larger."""
    ends = found.arcs.ends()
    misses = np.stack([ends[::2] - found.joins, ends[1::2] - last])
    return np.asarray(np.hypot(misses[..., 0], misses[..., 1]).max(axis=0))


def tangency(found: Biarcs, given: Drawn) -> FloatArray:
    """How far the directions miss at start, join and end, rad, the largest."""
    arcs, ends = found.arcs, found.arcs.end_angles()
    misses = [arcs.angle[::2] - given[1], ends[::2] - found.directions, ends[1::2] - given[3]]
    return np.asarray(np.abs(wrap_angle(np.array(misses))).max(axis=0))


@pytest.mark.parametrize("rule", RULES)
def test_20_000_biarcs_close_and_are_tangent(rule: BiarcRule) -> None:
    """All over the range, special angles too: within 1e-11 of the chord and 1e-11 rad."""
    given, chord = drawn(1, COUNT)
    found = biarcs(*given, rule=rule)
    off, turned = (
        float((closure(found, given[2]) / chord).max()),
        float(tangency(found, given).max()),
    )
    print(f"{rule}: ends within {off:.2g} of the chord, tangents within {turned:.2g} rad")
    assert len(found) == COUNT
    assert set(found.kind.tolist()) == {"line", "circle", "C", "S"}
    assert off < 1e-11
    assert turned < 1e-11
    assert (found.arcs.length > 0.0).all()


@pytest.mark.parametrize("rule", RULES)
def test_4_000_least_radii_are_kept(rule: BiarcRule) -> None:
    """Any radius within its limit: no arc is sharper, the sharper one has it where need was."""
    every, chord = drawn(2, 5000)
    free = biarcs(*every, rule=rule)
    rows = np.flatnonzero(np.isin(free.kind, ("C", "S")))
    given: Drawn = (every[0][rows], every[1][rows], every[2][rows], every[3][rows])
    chord, bent = chord[rows], free.kind[rows] == "C"
    step = given[2] - given[0]
    a, b = np.abs(wrap_angle(np.stack(given[1::2]) - np.arctan2(step[:, 1], step[:, 0])))
    balanced = ratio_radii(chord, a, b, np.ones_like(a))[0]
    limit = np.where(bent, one_bend_limit(chord, a, b), balanced)
    least = limit * np.random.default_rng(5).uniform(0.01, 0.999, len(limit))
    found = biarcs(*given, rule=rule, least_radius=least)
    sharpest = 1.0 / np.abs(found.curvatures).max(axis=1) / least
    assert len(rows) > 4000
    assert sharpest.min() > 1.0 - 1e-9
    assert_allclose(sharpest[found.repaired], 1.0, rtol=1e-9)
    assert found.repaired.any()
    assert not found.fallback.any()
    assert (closure(found, given[2]) / chord).max() < 1e-11
    assert tangency(found, given).max() < 1e-11


def jumps(a: FloatArray, b: FloatArray, q: FloatArray) -> FloatArray:
    """The jump of curvature of biarcs with an inflection over a chord of 1, by ratio of radii."""
    first, second = ratio_radii(np.ones_like(a), a, b, q)
    return np.asarray(1.0 / first + 1.0 / second)


def test_the_inverse_ratio_never_jumps_more_than_the_printed_one() -> None:
    """5,000 inflections: jumps by the least one, as they were found by others on their own draw."""
    a, b = np.random.default_rng(6).uniform(0.02, 1.4, (2, 5000))
    least = 2.0 * (np.sin(a) + np.sin(b) + 2.0 * np.sin(0.5 * (a + b)))
    inverse, printed, equal = (jumps(a, b, q) / least for q in (a / b, b / a, np.ones_like(a)))
    assert (inverse <= printed * (1.0 + 1e-12)).all()
    assert min(each.min() for each in (inverse, printed, equal)) >= 1.0 - 1e-12
    for found, median, high in (
        (inverse, 1.041195594, 1.553612362),
        (printed, 1.216950611, 6.278207279),
        (equal, 1.015061087, 1.127432621),
    ):
        assert_allclose(np.median(found), median, rtol=0.01)
        assert_allclose(np.percentile(found, 95), high, rtol=0.1)


def test_the_least_jump_is_the_least_of_a_grid() -> None:
    """No share of the chords has a smaller jump, and the closed form is what the arcs have."""
    a, b = np.random.default_rng(7).uniform(0.01, 1.4, (2, 300))
    q = 10.0 ** np.linspace(-4.0, 4.0, 401)
    best = 2.0 * (np.sin(a) + np.sin(b) + 2.0 * np.sin(0.5 * (a + b)))
    grid = jumps(np.repeat(a, 401), np.repeat(b, 401), np.tile(q, 300)).reshape(300, 401)
    assert (grid >= best[:, None] * (1.0 - 1e-12)).all()
    assert_allclose(grid.min(axis=1), best, rtol=1e-3)
    found = biarcs(np.zeros((300, 2)), a, np.tile([1.0, 0.0], (300, 1)), b, rule="min_jump")
    assert_allclose(np.diff(found.curvatures)[:, 0], best, rtol=1e-13)


def test_the_stationary_biarc_is_the_least_without_loops() -> None:
    """1,400 pairs of angles: no join direction gives a smaller difference of positive radii."""
    rng = np.random.default_rng(8)
    b = rng.uniform(0.02, 1.4, 1400)
    a = np.clip(b * 3.0 ** rng.uniform(-0.99, 0.99, 1400), 0.0, 1.5)
    chord, one = np.ones(1400), np.minimum(a, b)
    ratio = np.maximum(a, b) / one
    a, b, chord, one = (each[ratio < 2.99] for each in (a, b, chord, one))
    least = np.abs(np.subtract(*one_bend_radii(chord, a, b, 0.5 * (a - b))))
    for part in np.linspace(-0.999, 0.999, 400):
        first, second = one_bend_radii(chord, a, b, part * one)
        assert first.min() > 0.0
        assert second.min() > 0.0
        assert (np.abs(first - second) >= least - 1e-12).all()


def test_rotating_and_scaling_changes_nothing_else() -> None:
    """Arcs of a rotated, mirrored, scaled figure are the arcs rotated, mirrored, scaled."""
    (first, one, last, two), _ = drawn(9, 500)
    turn, scale = 0.7, 3.5
    rotation = scale * np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    mirror = np.array([1.0, -1.0])
    plain = biarcs(first, one, last, two)
    moved = biarcs(first @ rotation, one + turn, last @ rotation, two + turn)
    flipped = biarcs(first * mirror, -one, last * mirror, -two)
    assert_allclose(moved.arcs.length, scale * plain.arcs.length, rtol=1e-6)
    assert_allclose(moved.joins, plain.joins @ rotation, atol=1e-5)
    assert_allclose(flipped.joins, plain.joins * mirror, atol=1e-10)
    assert_allclose(flipped.curvatures, -plain.curvatures, rtol=1e-9, atol=1e-12)
