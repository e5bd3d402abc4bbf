"""Biarcs between points with directions: published figures, degenerate ones, refusals."""

from collections.abc import Callable
from typing import cast

import numpy as np
import pytest
from numpy.testing import assert_allclose

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.biarc_family import (
    BiarcChords,
    directions_to_shares,
    one_bend_limit,
    one_bend_radii,
    one_sided_shares,
    ratio_radii,
)
from assoc_hull.geometry.classical.biarcs import BiarcRule, Biarcs, biarcs, free_biarcs
from assoc_hull.geometry.curves import FloatArray

CHORD = 10.0


def over_ten(alpha: float, beta: float, rule: BiarcRule = "inverse", least: float = 0.0) -> Biarcs:
    """A biarc over a chord of 10 along the first axis; angles in degrees."""
    one, two = np.radians([alpha]), np.radians([beta])
    return biarcs([[0, 0]], one, [[CHORD, 0]], two, rule=rule, least_radius=least)


def radii(found: Biarcs) -> FloatArray:
    """Both radii of one biarc."""
    return np.asarray(1.0 / np.abs(found.curvatures[0]))


def jump(found: Biarcs) -> float:
    """The jump of curvature at the join."""
    return float(np.abs(np.diff(found.curvatures[0]))[0])


def ends_rightly(found: Biarcs, end: tuple[float, float] = (CHORD, 0.0)) -> bool:
    """Whether both arcs meet, and the second ends where it must."""
    ends = found.arcs.ends()
    return bool(np.abs(ends - [found.joins[0], end]).max() <= 1e-14 * CHORD)


def test_one_bend_of_60_and_30_degrees() -> None:
    """Radii, direction and place of the join, length, difference of radii: all digits."""
    found = over_ten(60.0, -30.0)
    assert found.kind.tolist() == ["C"]
    assert_allclose(radii(found), [2.4118095489747926, 11.248444488869593], rtol=1e-14)
    assert_allclose(found.tau, [0.2617993877991494], rtol=1e-14)
    assert_allclose(radii(found) @ [1.0, -1.0], -8.8366349398948, rtol=1e-14)
    assert_allclose(found.joins, [[1.4644660940672625, 1.123724356957945]], rtol=1e-14)
    assert_allclose(found.lengths, [10.728738432865557], rtol=1e-14)
    assert ends_rightly(found)


def test_the_root_that_runs_through_a_loop_is_not_taken() -> None:
    """Both roots fulfil the condition of tangency; the smaller difference is the other's."""
    a, b = np.radians([60.0, 30.0])
    roots = np.array([radii(over_ten(60.0, -30.0)), [7.588190451025209, 6.07206358681918]])
    first, second = roots.T
    bracket = np.sin(a) * np.sin(b) - np.cos(a) * np.cos(b) + 1.0
    left = CHORD**2 - 2 * CHORD * (first * np.sin(a) + second * np.sin(b))
    assert_allclose(left + 2 * bracket * first * second, 0.0, atol=1e-12)
    assert np.abs(first - second).argmin() == 1


@pytest.mark.parametrize("mirrored", [1.0, -1.0], ids=["to the left", "mirrored"])
def test_a_ratio_of_four_is_repaired_or_falls_back(mirrored: float) -> None:
    """60 and 15 degrees: stationary radii below nil, the limit, radius 1, equal chords."""
    a, b = np.radians([[60.0], [15.0]])
    chord = np.array([CHORD])
    assert_allclose(
        np.ravel(one_bend_radii(chord, a, b, (a - b) / 2)),
        [-1.6711760663049158, 16.847556968355335], rtol=1e-13,
    )  # fmt: skip
    assert_allclose(one_bend_limit(chord, a, b), [3.4919818620854994], rtol=1e-14)

    least = over_ten(60.0 * mirrored, -15.0 * mirrored, least=1.0)
    assert_allclose(radii(least), [1.0, 22.381988857569368], rtol=1e-13)
    assert_allclose(least.tau, [0.15690015597881957 * mirrored], rtol=1e-13)
    assert (least.repaired.tolist(), least.fallback.tolist()) == ([True], [False])
    assert "least radius 1 " in least.notes[0]

    for rule in ("inverse", "equal_chord"):
        equal = over_ten(60.0 * mirrored, -15.0 * mirrored, rule)
        bends = np.array([-0.24974176722990568, 0.024772877452513806])
        assert_allclose(equal.curvatures[0], bends * mirrored, rtol=1e-13)
        assert_allclose(equal.lengths, [11.049534246781555], rtol=1e-14)
        assert equal.fallback.tolist() == [rule == "inverse"]
        assert bool(equal.notes) == (rule == "inverse")
        assert all(note.startswith("biarc: fallback to equal chords, ") for note in equal.notes)
        assert ends_rightly(equal)


@pytest.mark.parametrize(
    ("rule", "wanted", "tau", "jumped"),
    [
        pytest.param(
            "inverse", [3.6474478962124435, 7.294895792424887], -0.49111005412048486,
            0.4112464503077944, id="inversely proportional to the angles",
        ),
        pytest.param(
            "as_printed", [6.0101888218542285, 3.0050944109271143], -0.6024898747396066,
            0.49915237090245984, id="as printed",
        ),
        pytest.param(
            "min_jump", [4.375266197864601, 5.938100221987382], -0.5235987755982988,
            0.39696155060244154, id="least jump",
        ),
    ],
)  # fmt: skip
def test_an_inflection_of_40_and_20_degrees(
    rule: BiarcRule, wanted: list[float], tau: float, jumped: float
) -> None:
    """Radii, join direction and jump of curvature of each rule: all digits."""
    found = over_ten(40.0, 20.0, rule)
    assert found.kind.tolist() == ["S"]
    assert_allclose(radii(found), wanted, rtol=1e-14)
    assert_allclose(found.tau, [tau], rtol=1e-14)
    assert_allclose(jump(found), jumped, rtol=1e-14)
    assert ends_rightly(found)


@pytest.mark.parametrize("rule", ["inverse", "as_printed", "min_jump", "equal_chord"])
def test_parallel_tangents_join_in_the_middle(rule: BiarcRule) -> None:
    """25 degrees at both ends: equal radii, the join in the middle of the chord, by every rule."""
    found = over_ten(25.0, 25.0, rule)
    assert_allclose(radii(found), [5.9155039578812465] * 2, rtol=1e-14)
    assert_allclose(found.tau, [-0.43633231299858244], rtol=1e-14)
    assert_allclose(found.joins, [[5.0, 0.0]], atol=1e-14)


def test_one_angle_of_none_takes_the_least_jump() -> None:
    """0 and 0.5 rad: both curvatures, the join on -0.25, the end exact, by every rule."""
    for rule in ("inverse", "as_printed", "min_jump"):
        found = biarcs([[0, 0]], [0.0], [[CHORD, 0]], [0.5], rule=rule)
        assert found.kind.tolist() == ["S"]
        bends = [[-0.049480791850904586, 0.1453658995717452]]
        assert_allclose(found.curvatures, bends, rtol=1e-14)
        assert_allclose(found.tau, -0.25, rtol=1e-15)
        assert ends_rightly(found)


def test_no_angles_give_a_line_in_two_halves() -> None:
    """Angles below 1e-11 are none: no curvature at all, both halves equal."""
    found = biarcs([[1, 2]], [np.pi / 2 + 3e-12], [[1, 8]], [np.pi / 2 - 9e-12])
    assert found.kind.tolist() == ["line"]
    assert found.curvatures.tolist() == [[0.0, 0.0]]
    assert found.arcs.length.tolist() == [3.0, 3.0]


def test_opposite_angles_give_one_circle() -> None:
    """R = P / (2 sin a), split at its middle."""
    found = over_ten(70.0, -70.0)
    assert found.kind.tolist() == ["circle"]
    assert_allclose(radii(found), CHORD / (2 * np.sin(np.radians(70.0))), rtol=1e-15)
    assert_allclose(np.diff(found.arcs.length), 0.0, atol=1e-15)


def test_tiny_angles_keep_their_digits() -> None:
    """1e-8 and 2e-8 rad: radii near 1e9 chords, and the end within 1e-15 of the chord."""
    found = biarcs([[0, 0], [0, 0]], [1e-8, 1e-8], [[CHORD, 0]] * 2, [-2e-8, 2e-8])
    a, b = 1e-8, 2e-8
    inflected = CHORD / (a + a / b * b + np.sqrt((2 * a) ** 2 + (a - b) ** 2 / 2))
    assert_allclose(1.0 / -found.curvatures[1, 0], inflected, rtol=1e-8)
    assert_allclose(found.arcs.ends()[1::2], [[CHORD, 0.0]] * 2, atol=1e-14)


def test_a_least_radius_of_an_inflection_keeps_both_arcs_tangent() -> None:
    """The smaller radius is the one asked for, up to where both are equal; the end stays."""
    limit = radii(over_ten(40.0, 20.0, "inverse"))[0]
    for least in (3.7, 4.5, 4.92):
        found = over_ten(40.0, 20.0, least=least)
        assert limit < least
        assert_allclose(radii(found).min(), least, rtol=1e-13)
        assert ends_rightly(found)
    same = over_ten(40.0, 20.0, least=limit)
    assert not same.repaired.any()


def test_the_rule_holds_up_to_a_ratio_of_three() -> None:
    """59.9 to 20 degrees bends one way; 60 to 20 needs a radius of nil, and has equal chords."""
    below, at = over_ten(59.9, -20.0), over_ten(60.0, -20.0)
    assert (below.fallback.tolist(), at.fallback.tolist()) == ([False], [True])
    assert 0.0 < radii(below).min() < 0.02
    assert np.abs(at.curvatures).max() < 1.0


def test_an_angle_of_1e_10_is_one() -> None:
    """Beside it 1e-12 is none: a line, a circle, the least jump take its place."""
    none, some = 1e-12, 1e-10
    one = [none, some, none, some, 0.3, 0.3]
    other = [none, some, -0.2, -0.2, -0.3 - none, -0.3 - some]
    found = biarcs([[0, 0]] * 6, one, [[1, 0]] * 6, other)
    assert found.kind.tolist() == ["line", "S", "S", "C", "circle", "C"]


def test_a_radius_that_is_there_already_changes_nothing() -> None:
    """To ask for the sharper radius, to rounding, is to ask for nothing, of circles, too."""
    rng = np.random.default_rng(11)
    one, two = rng.uniform(-1.2, 1.2, (2, 300))
    two[:100] = -one[:100]
    span = ([[0, 0]] * 300, one, [[1, 0]] * 300, two)
    free = biarcs(*span, rule="equal_chord")
    sharper = (1.0 + 1e-13) / np.abs(free.curvatures).max(axis=1)
    kept = biarcs(*span, rule="equal_chord", least_radius=sharper)
    assert not kept.repaired.any()
    assert np.array_equal(kept.arcs.length, free.arcs.length)


def test_the_limits_of_radii_are_sharp() -> None:
    """The limit itself: out of reach of one bend, reached by both arcs of an inflection."""
    a, b = np.radians([[60.0], [15.0]])
    limit = float(one_bend_limit(np.array([CHORD]), a, b)[0])
    with pytest.raises(GeometryError):
        over_ten(60.0, -15.0, least=limit)
    assert over_ten(60.0, -15.0, least=limit * (1.0 - 1e-9)).repaired.all()
    a, b = np.radians([40.0]), np.radians([20.0])
    even = float(ratio_radii(np.array([CHORD]), a, b, np.ones(1))[0][0])
    assert_allclose(radii(over_ten(40.0, 20.0, least=even)), even, rtol=1e-12)


def test_equal_chords_may_be_repaired_too() -> None:
    """Equal chords have no limit where they hold the radius; below it the family's biarc stands."""
    free = over_ten(60.0, -15.0, "equal_chord", least=4.0)
    assert (free.repaired.tolist(), free.notes) == ([False], ())
    bent = over_ten(60.0, -30.0, "equal_chord", least=4.7)
    assert_allclose(radii(bent).min(), 4.7, rtol=1e-13)


def test_the_join_is_free_within_its_bounds() -> None:
    """Directions below the smaller angle are met by shares; just there both arcs bend one way."""
    chords = BiarcChords.of([[0, 0]] * 2, [0.9, 0.4], [[CHORD, 0]] * 2, [-0.4, -0.9])
    least, most = one_sided_shares(chords)
    for part in (-0.1, 0.001, 0.3, 0.7, 0.999, 1.1):
        share = least + part * (most - least)
        if ((share <= 0.0) | (share >= 1.0)).any():
            share = np.clip(share, 0.01, 0.99)
        found = free_biarcs([[0, 0]] * 2, [0.9, 0.4], [[CHORD, 0]] * 2, [-0.4, -0.9], share)
        assert_allclose(directions_to_shares(chords, found.tau), share, rtol=1e-12)
        one_way = (found.curvatures < 0.0).all(axis=1)
        assert_allclose(one_way, (share > least) & (share < most))
        assert_allclose(one_way, np.abs(found.tau) < 0.4)


def test_angles_of_up_to_3_rad_are_only_noted() -> None:
    """Beyond 90 degrees the arcs still close and are tangent, by every rule."""
    rng = np.random.default_rng(3)
    alpha, beta = rng.uniform(-3.0, 3.0, (2, 500))
    first, last = np.zeros((500, 2)), np.tile([1.0, 0.0], (500, 1))
    for rule in ("inverse", "as_printed", "min_jump", "equal_chord"):
        found = biarcs(first, alpha, last, beta, rule=rule)
        assert_allclose(found.arcs.ends()[1::2], last, atol=1e-13)
        turned = np.exp(1j * (found.arcs.end_angles()[1::2] - beta))
        assert_allclose(turned, 1.0, atol=1e-14)
        assert any("exceeds 90 deg" in note for note in found.notes)


def test_a_biarc_has_the_same_bits_in_any_batch() -> None:
    """What one interval becomes does not depend on its neighbours."""
    rng = np.random.default_rng(4)
    first, last = rng.uniform(-5, 5, (2, 40, 2))
    one, two = rng.uniform(-1.0, 1.0, (2, 40))
    way = np.arctan2(*(last - first).T[::-1])
    whole = biarcs(first, way + one, last, way + two)
    alone = [
        biarcs(first[k : k + 1], way[k : k + 1] + one[k], last[k : k + 1], way[k : k + 1] + two[k])
        for k in range(40)
    ]
    for name in ("start", "angle", "curvature", "length"):
        parts = np.concatenate([getattr(each.arcs, name) for each in alone])
        assert np.array_equal(getattr(whole.arcs, name), parts)


def test_what_is_handed_out_cannot_be_written_to() -> None:
    """All arrays of the result are frozen."""
    found = over_ten(40.0, 20.0)
    parts = (found.tau, found.kind, found.fallback, found.repaired, found.arcs.start, found.joins)
    assert not any(each.flags.writeable for each in parts)


WRONG: dict[str, tuple[Callable[[], object], str]] = {
    "no chord": (lambda: biarcs([[1, 1]], [0.0], [[1, 1]], [0.0]), "biarc: zero chord; give two"),
    "no chord, by rounding": (
        lambda: biarcs([[0.0, 0.0], [1e9, 1.0]], [0, 0], [[1.0, 0.0], [1e9 + 1e-7, 1.0]], [0, 0]),
        "biarc: zero chord, interval 1; ",
    ),
    "straight back": (
        lambda: over_ten(180.0, 0.0), "biarc: end angle 180 deg to the chord exceeds 90 deg; ",
    ),
    "radius above the limit of one bend": (
        lambda: over_ten(60.0, -15.0, least=3.5),
        "biarc: r_min=3.5 not attainable, limit 3.491981862; ",
    ),
    "radius of a circle": (
        lambda: over_ten(30.0, -30.0, least=11.0), "biarc: r_min=11 not attainable, limit 10",
    ),
    "radius above the limit of an inflection": (
        lambda: over_ten(40.0, 20.0, least=5.2), "biarc: r_min=5.2 not attainable, limit 4.92839",
    ),
    "least radius below nil": (
        lambda: over_ten(40.0, 20.0, least=-1.0), "biarc: least radius -1 is below 0; ",
    ),
    "least radius of words": (
        lambda: biarcs([[0, 0]], [0], [[1, 0]], [0], least_radius="wide"),
        "biarc: expected shape (), got no array of numbers; ",
    ),
    "no such rule": (
        lambda: over_ten(1.0, 1.0, cast(BiarcRule, "fair")),
        "biarc: no rule is called 'fair'; there are inverse, as_printed, min_jump, equal_chord",
    ),
    "least radii of other counts": (
        lambda: biarcs([[0, 0]], [0.1], [[1, 0]], [0.2], least_radius=[1, 2]),
        "biarc: expected shape (1), got (2,); ",
    ),
    "complex directions": (
        lambda: biarcs([[0, 0]], np.array([1j]), [[1, 0]], [0.2]),
        "biarc: expected shape (1), got no array of numbers; ",
    ),
    "least radius of nothing": (
        lambda: over_ten(60.0, -15.0, least=1e-300),
        "biarc: least radius 1e-300 is none beside the chord; give 0 for none",
    ),
    "rule of several words": (
        lambda: over_ten(1.0, 1.0, cast(BiarcRule, np.array(["inverse", "fair"]))),
        "biarc: no rule is called a ndarray; there are ",
    ),
    "beyond all measure": (
        lambda: biarcs([[0, 0]], [0], [[1, -1e300]], [0]),
        "biarc: coordinate -1e+300 at index (0, 1); give metres",
    ),
    "a chord of next to nothing": (
        lambda: biarcs([[0, 0]], [0.1], [[1e-300, 0]], [0]), "biarc: zero chord; ",
    ),
    "not finite": (
        lambda: biarcs([[0, np.nan]], [0], [[1, 0]], [0]),
        "biarc: non-finite value at index (0, 1); ",
    ),
    "other counts": (
        lambda: biarcs([[0, 0]], [0], [[1, 0], [2, 0]], [0]),
        "biarc: expected shape (1, 2), got (2, 2); ",
    ),
    "angles of another shape": (
        lambda: biarcs([[0, 0]], 0.0, [[1, 0]], [0]), "biarc: expected shape (1), got (); ",
    ),
    "share of all": (
        lambda: free_biarcs([[0, 0]], [0], [[1, 0]], [0.1], [1.0]),
        "biarc: share 1 of the first chord; give one between 0 and 1, each by 1e-12",
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", WRONG)
def test_what_cannot_be_is_refused(case: str) -> None:
    """One line: what is wrong with its numbers, and what to do."""
    call, message = WRONG[case]
    with pytest.raises(GeometryError) as caught:
        call()
    assert str(caught.value).startswith(message)


def test_beyond_90_degrees_is_noted() -> None:
    """The note tells the largest angle, the first interval and how many more."""
    found = biarcs([[0, 0]] * 3, [0.1, 2.0, 1.6], [[1, 0]] * 3, [0.1, 0.2, 0.1])
    note = "biarc: end angle 114.591559 deg to the chord exceeds 90 deg (interval 1 and 1 more)."
    assert found.notes == (note,)
