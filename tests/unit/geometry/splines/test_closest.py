"""The closest point against dense sampling and closed forms."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, SplineBatch
from assoc_hull.geometry.numeric.polynomials import horner
from assoc_hull.geometry.splines.distance import closest_points, closest_points_each
from assoc_hull.geometry.splines.segments import power_coefficients

COORDINATE = st.floats(-10.0, 10.0)


def curve_of(xyz: FloatArray, slopes: FloatArray) -> SplineBatch:
    """A curve of unit knot spans through points with given derivatives."""
    return SplineBatch(
        np.array([0, len(xyz)]), np.arange(float(len(xyz))), xyz, slopes, slopes.copy()
    )


def line() -> SplineBatch:
    """Three straight segments along x, from 0 to 3."""
    xyz = np.array([[0, 0, 0], [1, 0, 0], [2, 0, 0], [3, 0, 0.0]])
    return curve_of(xyz, np.array([[1.0, 0, 0]] * 4))


@given(
    arrays(np.float64, (4, 3), elements=COORDINATE),
    arrays(np.float64, (4, 3), elements=COORDINATE),
    arrays(np.float64, (3, 3), elements=COORDINATE),
)
def test_no_sample_is_closer(xyz: FloatArray, slopes: FloatArray, points: FloatArray) -> None:
    """No point of a dense sample is closer, and the nearest sample is hardly farther."""
    curve = curve_of(xyz, slopes)
    _, _, distance = closest_points(curve, 0, points)
    u = np.broadcast_to(np.linspace(0.0, 1.0, 401), (3, 401))
    samples = horner(power_coefficients(curve), u).reshape(-1, 3)
    sampled = np.linalg.norm(samples[None] - points[:, None], axis=2).min(axis=1)
    step = np.linalg.norm(np.diff(samples, axis=0), axis=1).max()
    assert np.all(distance <= sampled + 1e-12)
    assert np.all(sampled <= distance + step)


@given(
    arrays(np.float64, (3, 3), elements=COORDINATE),
    arrays(np.float64, (3, 3), elements=COORDINATE),
    st.floats(0.0, 2.0),
)
def test_a_point_of_the_curve_is_its_own(xyz: FloatArray, slopes: FloatArray, t: float) -> None:
    """A point on the curve is found at distance nil, to rounding."""
    curve = curve_of(xyz, slopes)
    segment = min(int(t), 1)
    point = horner(power_coefficients(curve)[[segment]], np.array([[t - segment]]))[0]
    _, found, distance = closest_points(curve, 0, point)
    assert distance[0] <= 1e-13 * (1.0 + np.abs(xyz).max() + np.abs(slopes).max())
    assert found == pytest.approx(point, abs=1e-12)


@given(st.floats(-1.0, 1.0), st.floats(-0.4, 2.0))
def test_parabola(x: float, side: float) -> None:
    """From a point on the normal of a parabola, short of the focal radius, one gets back."""
    arc = SplineBatch(
        np.array([0, 2]),
        np.array([0.0, 2.0]),
        np.array([[-1, 1, 0], [1, 1, 0.0]]),
        np.array([[1, -2, 0]] * 2, float),
        np.array([[1, 2, 0]] * 2, float),
    )
    normal = np.array([2 * x, -1, 0]) / np.hypot(2 * x, 1)
    t, _, distance = closest_points(arc, 0, [np.array([x, x * x, 0]) + side * normal])
    assert t[0] == pytest.approx(x + 1.0, abs=1e-9)
    assert distance[0] == pytest.approx(abs(side), abs=1e-12)


@pytest.mark.parametrize(
    ("point", "t", "distance"),
    [
        pytest.param([0.25, 3, 4], 0.25, 5.0, id="above"),
        pytest.param([1, 2, 0], 1.0, 2.0, id="above a knot"),
        pytest.param([-3, 4, 0], 0.0, 5.0, id="before the beginning"),
        pytest.param([6, 0, 4], 3.0, 5.0, id="beyond the end"),
        pytest.param([2.5, 0, 0], 2.5, 0.0, id="on the line"),
    ],
)
def test_straight_line(point: list[float], t: float, distance: float) -> None:
    """On a straight line the quintic is of degree one, and all is exact."""
    found = closest_points(line(), 0, [point])
    assert found[0][0] == pytest.approx(t, abs=1e-14)
    assert found[2][0] == pytest.approx(distance, abs=1e-14)


def test_ties_go_to_the_lower_parameter() -> None:
    """Of two places at the same distance the first along the curve is given."""
    xyz = np.array([[0, 0, 0], [2, 2, 0], [4, 0, 0.0]])
    slopes = np.array([[0.5, 2, 0], [2, 0, 0], [0.5, -2, 0]])
    curve = curve_of(xyz, slopes)
    t, _, distance = closest_points(curve, 0, [[2, 0, 0]])
    mirrored, _, again = closest_points(curve_of(xyz[::-1].copy(), -slopes[::-1]), 0, [[2, 0, 0]])
    assert t[0] == pytest.approx(mirrored[0], abs=1e-12)
    assert t[0] < 1.0
    assert distance[0] == pytest.approx(again[0], rel=1e-14)


def test_a_closed_curve_gives_its_beginning() -> None:
    """Where beginning and end coincide, the parameter is 0."""
    xyz = np.array([[0, 0, 0], [4, 2, 0], [0, 0, 0.0]])
    slopes = np.array([[4, -2, 0], [0, 3, 0], [-4, -2, 0.0]])
    assert closest_points(curve_of(xyz, slopes), 0, [[-1, 0, 0]])[0][0] == 0.0


def test_ends_and_knots_are_exact() -> None:
    """At a knot the defining point is given to the last bit, and its parameter."""
    xyz = np.array([[0.1, 0.2, 0.3], [1.1, 0.7, 0.3], [2.3, 0.9, 0.1]])
    slopes = np.array([[1, 0.5, 0], [1.1, 0.3, 0.0], [1, 0.1, -0.3]])
    t, found, _ = closest_points(curve_of(xyz, slopes), 0, [[-5, 0, 0], [9, 2, 0]])
    assert t.tolist() == [0.0, 2.0]
    assert found.tolist() == [xyz[0].tolist(), xyz[2].tolist()]


def test_the_other_points_do_not_matter() -> None:
    """A point has the same result to the last bit alone and among others."""
    xyz = np.array([[0, 0, 0], [1, 3, 0], [4, 2, 1], [5, -2, 0.0]])
    slopes = np.array([[0, 4, 0], [2, 1, 1], [2, -3, 0], [0, -4, 1.0]])
    curve = SplineBatch.join([line(), curve_of(xyz, slopes)])
    points = np.random.default_rng(7).uniform(-6, 6, (200, 3))
    together = closest_points(curve, 1, points)
    for row in (0, 77, 199):
        alone = closest_points(curve, 1, points[[row]])
        assert [part[row].tolist() for part in together] == [part[0].tolist() for part in alone]


def test_each_point_has_its_curve() -> None:
    """Points in any order, each with a curve of its own: what one curve at a time gives."""
    rng = np.random.default_rng(3)
    sizes = (2, 4, 7, 3)
    batch = SplineBatch.join([curve_of(*rng.uniform(-5, 5, (2, size, 3))) for size in sizes])
    curves, points = rng.integers(0, len(sizes), 300), rng.uniform(-6, 6, (300, 3))
    together = closest_points_each(batch, curves, points)
    for curve in range(len(sizes)):
        mine = curves == curve
        alone = closest_points(batch, curve, points[mine])
        assert [part[mine].tolist() for part in together] == [part.tolist() for part in alone]


@pytest.mark.parametrize("most", [1, 7, 100])
def test_portions_do_not_matter(most: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """However few pairs of point and segment are looked at together."""
    rng = np.random.default_rng(4)
    batch = SplineBatch.join([curve_of(*rng.uniform(-5, 5, (2, size, 3))) for size in (5, 2, 6)])
    curves, points = rng.integers(0, 3, 60), rng.uniform(-6, 6, (60, 3))
    whole = closest_points_each(batch, curves, points)
    monkeypatch.setattr("assoc_hull.geometry.splines.distance._PAIRS", most)
    parts = closest_points_each(batch, curves, points)
    assert [part.tolist() for part in whole] == [part.tolist() for part in parts]


@pytest.mark.parametrize("curves", [[2, 0], [-1, 0], [0], [[0, 0]]])
def test_a_curve_that_is_none_is_refused(curves: list[int]) -> None:
    """Each point needs one of the batch."""
    with pytest.raises(BadInputError):
        closest_points_each(line(), np.array(curves), np.zeros((2, 3)))


def test_no_points_no_results() -> None:
    """An empty question has an empty answer, frozen like any other."""
    t, xyz, distance = closest_points(line(), 0, np.zeros((0, 3)))
    assert (t.shape, xyz.shape, distance.shape) == ((0,), (0, 3), (0,))
    assert [part.flags.writeable for part in (t, xyz, distance)] == [False] * 3


@pytest.mark.parametrize(
    ("curve", "points"),
    [
        pytest.param(1, [[0, 0, 0]], id="no such curve"),
        pytest.param(-1, [[0, 0, 0]], id="negative curve"),
        pytest.param(0, [0, 0, 0], id="a point, not rows"),
        pytest.param(0, [[0, 0]], id="two coordinates"),
        pytest.param(0, [[0, np.nan, 0]], id="not finite"),
    ],
)
def test_bad_input_is_refused(curve: int, points: list[list[float]]) -> None:
    """What is no curve or no point is an error of the package."""
    with pytest.raises(BadInputError):
        closest_points(line(), curve, points)
