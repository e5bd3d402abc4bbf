"""Arc length against closed forms, a graded quadrature, and itself."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.integrate import quad

from assoc_hull.errors import BadInputError, TooFewPointsError
from assoc_hull.geometry.curves import FloatArray, SplineBatch
from assoc_hull.geometry.splines.arc_length import arc_length, length_at, segment_length

COORDINATE = st.floats(-10.0, 10.0)


def bezier(points: FloatArray) -> SplineBatch:
    """One Bezier cubic as a spline of one segment whose chord is its knot span."""
    span = float(np.linalg.norm(points[3] - points[0])) or 1.0
    leave, arrive = 3.0 * (points[1] - points[0]) / span, 3.0 * (points[3] - points[2]) / span
    return SplineBatch(
        np.array([0, 2]),
        np.array([0.0, span]),
        points[[0, 3]],
        np.array([leave, leave]),
        np.array([arrive, arrive]),
    )


def reference() -> SplineBatch:
    """The cubic whose integrals are known to 12 places."""
    return bezier(np.array([[0, 0, 0], [1, 2, 0], [3, 2.5, 0], [4, 0, 0.0]]))


def test_reference_cubic() -> None:
    """The length of the reference cubic is right in every printed digit."""
    assert arc_length(reference())[0] == pytest.approx(5.538648436292, rel=1e-12)


def test_straight_line_however_it_is_run_through() -> None:
    """A straight segment is as long as its chord, even if its parameter is not even."""
    line = bezier(np.array([[0, 0, 0], [0.3, 0.4, 0], [0.6, 0.8, 0], [3, 4, 0.0]]))
    assert arc_length(line)[0] == pytest.approx(5.0, rel=1e-13)


def test_cusp() -> None:
    """Halving reaches a cusp: u^2 (1, 0, 0) + u^3 (0, 1, 0) has the length (13^1.5 - 8) / 27."""
    cusp = bezier(np.array([[0, 0, 0], [0, 0, 0], [1 / 3, 0, 0], [1, 1, 0.0]]))
    assert arc_length(cusp)[0] == pytest.approx((13.0**1.5 - 8.0) / 27.0, rel=1e-12)


def test_cusp_inside_a_segment() -> None:
    """A line run forth and back counts both ways: 3 u (1 - u) runs 3/4 out and 3/4 home."""
    there_and_back = bezier(np.array([[0, 0, 0], [1, 0, 0], [1, 0, 0], [0, 0, 0.0]]))
    assert arc_length(there_and_back)[0] == pytest.approx(1.5, rel=1e-12)


@given(st.lists(st.integers(-9, 9), min_size=4, max_size=4))
def test_cusps_of_a_line_run_forth_and_back(values: list[int]) -> None:
    """On a straight line the length is what x goes up and down, turning at its cusps."""
    points = np.zeros((4, 3))
    points[:, 0] = values
    a, b, c = np.diff(values)
    turns = np.roots([a - 2 * b + c, 2 * (b - a), a])
    u = np.sort([0.0, 1.0, *(r.real for r in turns if r.imag == 0.0 and 0.0 < r.real < 1.0)])
    x = (1 - u) ** 3 * values[0] + u**3 * values[3]
    x = x + 3 * u * (1 - u) * ((1 - u) * values[1] + u * values[2])
    expected = np.abs(np.diff(x)).sum()
    assert arc_length(bezier(points))[0] == pytest.approx(expected, rel=1e-12, abs=1e-13)


@given(arrays(np.float64, (4, 3), elements=COORDINATE))
def test_agrees_with_quadrature(points: FloatArray) -> None:
    """The length of any cubic is that of a quadrature refined where it all but stands still.

    Below 1e-150 m squares of lengths are no numbers any more.
    """
    size = np.abs(np.diff(points, axis=0)).sum()
    assert arc_length(bezier(points))[0] == pytest.approx(
        graded_length(points), rel=1e-10, abs=1e-12 * size + 1e-150
    )


def graded_length(points: FloatArray) -> float:
    """Gauss sums over intervals that halve towards each place of least speed.

    The speed is the root of a quartic; near a place where that all but vanishes it turns as
    |u - u0| does, which no quadrature over wide intervals follows.
    """
    b = 3.0 * np.diff(points, axis=0)
    slope = np.array([b[0] - 2 * b[1] + b[2], 2 * (b[1] - b[0]), b[0]])
    square = sum(np.convolve(slope[:, axis], slope[:, axis]) for axis in range(3))
    least = np.roots(np.trim_zeros(np.asarray(square), "f")).real
    halves = 0.5 ** np.arange(50)
    places = np.concatenate(
        [[0.0, 1.0], *([c] for c in least), *(c + s * halves for c in least for s in (-1, 1))]
    )
    knots = np.unique(np.clip(places, 0.0, 1.0))
    node, weight = np.polynomial.legendre.leggauss(24)
    u = knots[:-1, None] + 0.5 * np.diff(knots)[:, None] * (node + 1.0)
    slopes = (slope[0] * u[..., None] + slope[1]) * u[..., None] + slope[2]
    speed = np.sqrt((slopes * slopes).sum(axis=-1))
    return float((0.5 * np.diff(knots)[:, None] * weight * speed).sum())


def test_length_at_adds_up_over_segments() -> None:
    """Length runs from 0 through the sums of the segments to the length of the curve."""
    first = reference()
    batch = SplineBatch.join([first, two_pieces(), first])
    lengths = segment_length(batch)
    ends = batch.knot[batch.start[1] : batch.start[2]]
    found = length_at(batch, [1, 1, 1, 2], [*ends, first.knot[1]])
    expected = [0.0, lengths[1], lengths[1] + lengths[2], lengths[3]]
    assert found == pytest.approx(expected, rel=1e-14)


def two_pieces() -> SplineBatch:
    """A curve of two different segments."""
    xyz = np.array([[0, 0, 0], [1, 1, 0], [3, 1, 1.0]])
    slope = np.array([[0, 1, 0], [0.8, 0.6, 0], [1, 0, 0.5]])
    return SplineBatch(np.array([0, 3]), np.array([0.0, 1.5, 4.0]), xyz, slope, slope.copy())


@given(st.floats(0.0, 4.0))
def test_length_at_agrees_with_quadrature(t: float) -> None:
    """The length to any parameter is the integral of the speed up to it."""
    curve = reference()

    def speed(u: float) -> float:
        steps = 3.0 * np.array([[1, 2], [2, 0.5], [1, -2.5]])
        slope = (1 - u) ** 2 * steps[0] + 2 * u * (1 - u) * steps[1] + u**2 * steps[2]
        return float(np.hypot(*slope))

    expected = quad(speed, 0.0, t / 4.0, epsabs=1e-13, epsrel=1e-13)[0]
    assert length_at(curve, [0], [t])[0] == pytest.approx(expected, rel=1e-11, abs=1e-12)


def test_the_rest_of_the_batch_does_not_matter() -> None:
    """A curve has the same length to the last bit alone and in a batch."""
    alone, company = two_pieces(), SplineBatch.join([reference(), two_pieces(), reference()])
    assert arc_length(company)[1] == arc_length(alone)[0]
    assert length_at(company, [1], [2.5])[0] == length_at(alone, [0], [2.5])[0]


def test_results_are_frozen() -> None:
    """Nobody can change a result that another may hold."""
    batch = reference()
    assert not arc_length(batch).flags.writeable
    assert not length_at(batch, [0], [1.0]).flags.writeable


@pytest.mark.parametrize(
    ("curve", "t"),
    [
        pytest.param([0], [4.1], id="beyond the end"),
        pytest.param([0], [-0.1], id="before the beginning"),
        pytest.param([0], [np.nan], id="no number"),
        pytest.param([1], [1.0], id="no such curve"),
        pytest.param([-1], [1.0], id="negative curve"),
        pytest.param([0.5], [1.0], id="broken curve"),
        pytest.param([0, 0], [1.0], id="shapes differ"),
    ],
)
def test_places_off_the_curve_are_refused(curve: list[int], t: list[float]) -> None:
    """A place that is on no curve is an error of the package."""
    with pytest.raises(BadInputError):
        length_at(reference(), curve, t)


def test_a_curve_of_one_point_is_refused() -> None:
    """A curve needs two points, and the error names the curve that has less."""
    point = SplineBatch(np.array([0, 1]), np.zeros(1), *np.zeros((3, 1, 3)))
    with pytest.raises(TooFewPointsError, match="curve 1 of the batch"):
        arc_length(SplineBatch.join([reference(), point]))


def test_an_empty_batch_has_no_lengths() -> None:
    """No curves, no lengths, no error."""
    empty = SplineBatch(np.array([0]), np.zeros(0), *np.zeros((3, 0, 3)))
    assert arc_length(empty).shape == (0,)
