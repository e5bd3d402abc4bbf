"""Sections and boundary curves of lines and arcs: printed values, messages, what is reproduced."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.arc_curve import (
    ArcBoundary,
    ArcCurve,
    mean_curvatures,
    round_corners,
    three_point_curvatures,
    through_points,
)
from assoc_hull.geometry.classical.checked_input import wrap_angle

FIVE = [(0, 0), (6, 0.2), (10, 1.5), (12, 4), (12.4, 8)]
CORNER = [(0, 0), (10, 0), (12, 6)]
STEM = ArcBoundary("stem", through_points([(0, 0), (3, 0), (5, 4)], kind="line"))


def arc(radius: Any = None, **more: Any) -> ArcCurve:
    """An arc through two points 10 m apart."""
    return through_points([(0, 0), (10, 0)], radius=radius, **more)


MESSAGES: dict[str, tuple[str, Callable[[], object]]] = {
    "radius too small": (
        "section: radius 4.9 smaller than half the chord 5 at interval 0",
        lambda: arc([4.9]),
    ),
    "radius too small to the right": (
        "section: radius -4.9 smaller than half the chord 5 at interval 0",
        lambda: arc([-4.9]),
    ),
    "no mean circle": (
        "section: mean circle at interval 0 has |K| l/2 >= 1",
        lambda: through_points([(0, 0), (10, 0), (5, 5)]),
    ),
    "coincident": (
        "section: coincident points 1,2",
        lambda: through_points([(0, 0), (1, 0), (1, 0), (2, 1)]),
    ),
    "there and back": (
        "section: coincident points 0,2",
        lambda: through_points([(0, 0), (1, 0), (0, 0)]),
    ),
    "fillets overlap": (
        "section: fillets 1 and 2 overlap",
        lambda: round_corners([(0, 0), (10, 0), (10, 5), (20, 5)], radius=[3.0, -3.0]),
    ),
    "fillet over the end": (
        "section: fillets 1 and 2 overlap",
        lambda: round_corners(CORNER, radius=[9.0]),
    ),
    "fillet to the other side": (
        "section: radius -2 turns against the corner at point 1",
        lambda: round_corners(CORNER, radius=[-2.0]),
    ),
    "polygon turns back": (
        "section: the polygon turns back on itself at point 1",
        lambda: round_corners([(0, 0), (10, 0), (5, 0)]),
    ),
    "one point": ("section: expected shape (n >= 2, 2), got", lambda: through_points([(0, 0)])),
    "not finite": (
        "section: non-finite value at index (0, 1)",
        lambda: through_points([(0, np.inf), (1, 1)]),
    ),
    "no such kind": ("section: kind is 'spline'", lambda: arc(kind="spline")),
    "too many kinds": ("section: kind is ['arc', 'arc']", lambda: arc(kind=["arc", "arc"])),
    "too few radii": ("section: radius is []", lambda: arc([])),
    "radius of nothing": ("section: radius 0 at interval 0", lambda: arc([0.0])),
    "knuckle at no point": ("section: knuckles are [7]", lambda: arc(knuckles=[7])),
    "beyond its length": ("section: s=11 outside [0, 10]", lambda: arc().at([11.0])),
    "no step": ("section: step 0", lambda: arc().sampled(0.0)),
    "too many points": ("section: step 1e-12 for a length of 10", lambda: arc().sampled(1e-12)),
    "kind of no list": ("section: kind is array(5.)", lambda: arc(kind=np.array(5.0))),
    "radius of no list": ("section: radius is array(5.)", lambda: arc(np.array(5.0))),
    "knuckles of no list": ("section: knuckles are array(5.)", lambda: arc(knuckles=np.array(5.0))),
    "third axis": ("section: axis is 2", lambda: arc().where(2, 0.0)),
    "level of no number": (
        "section: non-finite value at index 0",
        lambda: arc().moments_below(float("nan")),
    ),
    "cut before it begins": ("section: nothing lies before its start", lambda: arc().cut(0, 0.0)),
    "cut beyond its end": ("section: no place 11 m along piece 0", lambda: arc().cut(0, 11.0)),
    "moved nowhere": (
        "boundary stem: expected shape (), got",
        lambda: STEM.moved("far"),  # type: ignore[arg-type]
    ),
    "above a boundary": ("boundary stem: does not reach z=4.5", lambda: STEM.x(4.5)),
    "before a boundary": ("boundary stem: does not reach x=-1", lambda: STEM.z(-1.0)),
}


@pytest.mark.parametrize("case", MESSAGES)
def test_what_makes_no_section_is_refused_in_words(case: str) -> None:
    """Each message begins as it is printed, with its numbers, and goes on with a remedy."""
    message, call = MESSAGES[case]
    with pytest.raises(GeometryError) as caught:
        call()
    assert str(caught.value).startswith(message)
    assert caught.value.remedy


def test_a_mean_circle_has_the_printed_values() -> None:
    """Curvatures through three points, and what the arc from the second point to the third is."""
    found = three_point_curvatures(FIVE)
    wanted = [0.054832755346038056, 0.15475629624961104, 0.15699274090214185]
    np.testing.assert_allclose(found, wanted, rtol=1e-13)
    mean = mean_curvatures(FIVE)
    np.testing.assert_allclose(mean[[0, 3]], wanted[::2], rtol=1e-13)
    curve = through_points(FIVE)
    bend, length = float(curve.arcs.curvature[1]), float(curve.arcs.length[1])
    assert bend == pytest.approx(0.10479452579782456, rel=1e-13)
    assert 1.0 / bend == pytest.approx(9.542483182082009, rel=1e-13)
    assert bend * length == pytest.approx(0.444408415553024, rel=1e-13)
    assert length == pytest.approx(4.240759831390444, rel=1e-13)
    np.testing.assert_allclose(
        curve.arcs.centres()[1], [5.123066333426869, 9.702103589455788], rtol=1e-12
    )
    chord = np.hypot(4.0, 1.3)
    middle = curve.arcs.at(np.array([1]), [0.5 * length])[0]
    sagitta = np.cross([4.0, 1.3, 0.0], [*(middle - [6.0, 0.2]), 0.0])[2] / chord
    assert -sagitta == pytest.approx(0.23461096119726088, rel=1e-12)


def test_a_fillet_has_the_printed_values() -> None:
    """Turning, the largest radius, and the circle of a given one."""
    given, largest = (round_corners(CORNER, radius=each) for each in ([2.5], None))
    turn = float(given.arcs.curvature[1] * given.arcs.length[1])
    assert turn == pytest.approx(1.2490457723982544, rel=1e-13)
    assert 1.0 / largest.arcs.curvature[1] == pytest.approx(4.387425886722793, rel=1e-13)
    tangent = 10.0 - float(given.arcs.start[1, 0])
    assert tangent == pytest.approx(1.8018980501403161, rel=1e-13)
    np.testing.assert_allclose(given.arcs.centres()[1], [8.198101949859684, 2.5], rtol=1e-12)


def test_a_boundary_of_lines_has_the_printed_values() -> None:
    """x(2) = 4, one intersection, length 3 + sqrt(20)."""
    assert STEM.x(2.0) == pytest.approx([4.0])
    assert STEM.length == pytest.approx(7.472135954999579, rel=1e-14)
    assert STEM.x(0.0) == pytest.approx([0.0, 3.0])
    assert STEM.moved(60.0).x(2.0) == pytest.approx([64.0])


@pytest.mark.parametrize("clockwise", [False, True], ids=["left", "right"])
def test_circles_and_lines_are_reproduced(clockwise: bool) -> None:
    """Points at random on circles of 1 m to 1e6 m, without a radius: they lie on no other curve."""
    rng = np.random.default_rng(5)
    for radius in (1.0, 30.0, 1e6):
        turn = np.sort(rng.uniform(0.0, 2.0, 12)) * (-1.0 if clockwise else 1.0)
        centre = rng.uniform(-5.0, 5.0, 2)
        points = centre + radius * np.stack([np.cos(turn), np.sin(turn)], axis=1)
        seen = through_points(points).sampled(0.05 * radius) - centre
        np.testing.assert_allclose(np.hypot(*seen.T), radius, rtol=1e-11)
    line = np.outer(np.sort(rng.uniform(0.0, 9.0, 8)), [0.6, 0.8]) + np.array([1.0, 2.0])
    straight = through_points(line)
    assert straight.length == pytest.approx(float(np.hypot(*(line[-1] - line[0]))), rel=1e-14)
    seen = straight.sampled(0.1) - line[0]
    np.testing.assert_allclose(seen @ [0.8, -0.6], 0.0, atol=1e-12)


def test_points_are_kept_and_a_semicircle_is_legal() -> None:
    """Every given point is a joint; a radius of half the chord turns by half a circle."""
    np.testing.assert_allclose(through_points(FIVE).joints(), FIVE, atol=1e-14)
    half = arc([5.0])
    assert half.length == pytest.approx(5.0 * np.pi, rel=1e-14)
    np.testing.assert_allclose(half.at([0.5 * half.length]), [[5.0, -5.0]], atol=1e-12)


def test_a_knuckle_parts_the_mean_circles() -> None:
    """Beyond it lies a line; without it the circle of the far side has its say."""
    points = [(8.0 - 2.0 * np.cos(a), 2.0 - 2.0 * np.sin(a)) for a in (0.0, 0.5, 1.0)]
    points += [(8.0, 6.0), (9.0, 9.0)]
    bend = mean_curvatures(points, knuckles=[2])
    np.testing.assert_allclose(bend[:2], 0.5, rtol=1e-12)
    assert abs(mean_curvatures(points)[1] - 0.5) > 0.09
    assert mean_curvatures(points, knuckles=[2, 3])[2] == 0.0


def _errors(count: int, how: str) -> float:
    """How far arcs through points of an ellipse leave it: x^2/4 + y^2 - 1, in inner intervals."""
    turn = np.linspace(0.1, 1.4, count)
    points = np.stack([2.0 * np.cos(turn), np.sin(turn)], axis=1)
    at = three_point_curvatures(points)
    bend = np.append(at[0], at) if how == "one" else mean_curvatures(points)
    arcs = through_points(points, radius=[float(each) for each in 1.0 / bend]).arcs
    inner = np.repeat(np.arange(1, count - 2), 3)
    x, y = arcs.at(inner, arcs.length[inner] * np.tile([0.25, 0.5, 0.75], count - 3)).T
    return float(np.abs(0.25 * x * x + y * y - 1.0).max())


def test_mean_circles_leave_an_ellipse_by_the_printed_errors() -> None:
    """33 points: 2.755e-6 by mean circles, 1.934e-5 by one neighbour; half the step, an eighth."""
    assert _errors(33, "mean") == pytest.approx(2.754932239668051e-06, rel=1e-8)
    assert _errors(33, "one") == pytest.approx(1.9337522995099832e-05, rel=1e-8)
    for how, order in (("mean", 3.1124035188735095), ("one", 3.018105638393721)):
        assert np.log2(_errors(33, how) / _errors(65, how)) == pytest.approx(order, rel=1e-7)


def test_fillets_have_no_corner_whatever_the_polygon() -> None:
    """300 polygons at random: tangents jump by less than 1e-9 rad, ends are kept."""
    rng = np.random.default_rng(11)
    for _ in range(300):
        turn = np.cumsum(rng.uniform(-1.4, 1.4, rng.integers(2, 7)))
        legs = rng.uniform(0.5, 9.0, len(turn))
        points = np.vstack([[0.0, 0.0], np.cumsum(
            legs[:, None] * np.stack([np.cos(turn), np.sin(turn)], axis=1), axis=0
        )])  # fmt: skip
        curve = round_corners(points)
        ends = curve.joints()
        np.testing.assert_allclose(ends[[0, -1]], points[[0, -1]], atol=1e-10)
        np.testing.assert_allclose(curve.arcs.ends()[:-1], curve.arcs.start[1:], atol=1e-10)
        assert np.abs(wrap_angle(curve.turns())).max(initial=0.0) < 1e-9


def test_a_corner_in_line_needs_no_fillet() -> None:
    """Three points in line stay one straight line."""
    curve = round_corners([(0, 0), (1, 0), (3, 0)])
    assert curve.length == pytest.approx(3.0)
    assert not curve.arcs.curvature.any()


def test_all_places_at_a_height_are_found() -> None:
    """Against 200,000 samples of curves that wind, at heights at random, to 1e-6 m."""
    rng = np.random.default_rng(3)
    for _ in range(20):
        points = np.stack([np.cumsum(rng.uniform(0.5, 2.0, 7)), rng.uniform(0.0, 4.0, 7)], axis=1)
        curve = through_points(points, radius=rng.choice([-9.0, 9.0, 40.0], 6).tolist())
        drawn = curve.sampled(curve.length / 200_000)
        for axis in (0, 1):
            low, high = np.quantile(drawn[:, axis], [0.02, 0.98]).tolist()
            for value in rng.uniform(low, high, 4):
                off = drawn[:, axis] - value
                k = np.flatnonzero(off[:-1] * off[1:] < 0.0)
                part = off[k] / (off[k] - off[k + 1])
                wanted = np.sort(drawn[k, 1 - axis] * (1 - part) + drawn[k + 1, 1 - axis] * part)
                found = curve.where(axis, float(value))
                assert found.shape == (len(wanted), 2)
                np.testing.assert_allclose(found[:, 1 - axis], wanted, atol=1e-6)


def test_what_lies_in_the_level_gives_its_ends_and_a_touch_one_place() -> None:
    """A flat bottom at z = 0; the lowest place of a round one."""
    assert through_points([(0, 0), (4, 0), (6, 3)], kind="line").where(1, 0.0).tolist() == [
        [0.0, 0.0], [4.0, 0.0]
    ]  # fmt: skip
    found = arc([5.0]).where(1, -5.0)
    assert len(found) == 1
    np.testing.assert_allclose(found, [[5.0, -5.0]], atol=1e-6)


def test_areas_and_moments_are_those_with_arcs() -> None:
    """A flat bottom with a bilge of 2 m against the closed form, at the bilge and above it."""
    curve = through_points(
        [(0, 0), (8, 0), (10, 2), (10, 9)], kind=["line", "arc", "line"], radius=[None, 2.0, None]
    )
    lost, z0 = (1.0 - 0.25 * np.pi) * 4.0, 2.0 * (10.0 - 3.0 * np.pi) / (12.0 - 3.0 * np.pi)
    area, half, first = curve.moments_below(7.0)
    assert area == pytest.approx(70.0 - lost, rel=1e-14)
    # The corner that the bilge cuts off: its centroid lies (10 - 3 pi)/(12 - 3 pi) r from both.
    assert first == pytest.approx(245.0 - lost * z0, rel=1e-13)
    assert half == pytest.approx(350.0 - lost * (10.0 - z0), rel=1e-13)
    beside = 2.0 * np.pi / 3.0 - 0.5 * np.sqrt(3.0)
    assert curve.moments_below(1.0)[0] == pytest.approx(8.0 + beside, rel=1e-13)
    assert curve.moments_below(np.inf)[0] == pytest.approx(90.0 - lost, rel=1e-14)


def test_a_tunnel_counts_once_below_a_level() -> None:
    """A curve that goes down again encloses what lies below the level, and no more."""
    tunnel = through_points([(0, 3), (2, 3), (2, 0), (5, 0), (5, 6)], kind="line")
    assert tunnel.moments_below(2.0)[0] == pytest.approx(6.0)
    assert tunnel.moments_below(5.0)[0] == pytest.approx(5.0 * 5.0 - 2.0 * 3.0)
