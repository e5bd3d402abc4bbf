"""The cubic composite spline."""

from collections.abc import Iterator

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from assoc_hull.errors import BadInputError, CoincidentPointsError, TooFewPointsError
from assoc_hull.geometry.curves import CurveData, EndKind, FloatArray, PointKind, SplineBatch
from assoc_hull.geometry.splines.backend import backend, set_backend
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.segments import (
    bezier_points,
    derivative,
    evaluate,
    sample,
    segment_start,
)

WAVE = np.array([[0, 0, 0], [1, 0.8, 0.1], [2.5, 1, 0.3], [3, 0.2, 0.2], [4.4, -0.5, 0], [6, 0, 1]])
GIVEN = (EndKind.TANGENT, EndKind.TANGENT)
ENDS = np.array([[1.0, 2.0, 0.5], [3.0, 0.0, -1.0]])


@pytest.fixture(autouse=True, scope="module", params=["numpy", "numba"])
def backend_in_use(request: pytest.FixtureRequest) -> Iterator[None]:
    """Every test of this file holds for both backends."""
    if request.param == "numba":
        pytest.importorskip("numba")
    before = backend()
    set_backend(request.param)
    yield
    set_backend(before)


def unit(vector: FloatArray) -> FloatArray:
    """The direction of a vector."""
    result: FloatArray = vector / np.sqrt((vector**2).sum())
    return result


def second_derivatives(spline: SplineBatch, segment: int) -> tuple[FloatArray, FloatArray]:
    """Second derivative at the start and the end of a segment, from its Bezier points."""
    index, points = segment_start(spline), bezier_points(spline)
    one = points[int(np.flatnonzero(index == segment)[0])]
    scale = 6.0 / (spline.knot[segment + 1] - spline.knot[segment]) ** 2
    return scale * (one[0] - 2 * one[1] + one[2]), scale * (one[1] - 2 * one[2] + one[3])


def with_kind(place: int, kind: PointKind) -> SplineBatch:
    """The wave with one special point."""
    kinds = [PointKind.SMOOTH] * len(WAVE)
    kinds[place] = kind
    direction = np.zeros(WAVE.shape)
    direction[place] = [5.0, -1.0, 0.0]
    return loft(CurveData.single(WAVE, kinds, direction, GIVEN, ENDS))


def test_the_knots_are_chord_lengths_and_the_curve_meets_its_points() -> None:
    """At the chord-length parameters the curve has exactly the defining points."""
    spline = loft(CurveData.single(WAVE))
    chords = np.sqrt((np.diff(WAVE, axis=0) ** 2).sum(axis=1))
    np.testing.assert_allclose(spline.knot, [0, *np.cumsum(chords)], rtol=1e-15)
    index = np.zeros(len(WAVE), np.int64)
    assert evaluate(spline, index, spline.knot).tobytes() == WAVE.tobytes()


def test_given_ends_give_the_clamped_spline() -> None:
    """With given end tangents, of unit length, the curve is the clamped cubic spline."""
    spline = loft(CurveData.single(WAVE, end_kind=GIVEN, end_vector=ENDS))
    first, last = unit(ENDS[0]), unit(ENDS[1])
    clamped = CubicSpline(spline.knot, WAVE, bc_type=((1, first), (1, last)))
    t = np.linspace(0, spline.knot[-1], 200)
    index = np.zeros(200, np.int64)
    np.testing.assert_allclose(evaluate(spline, index, t), clamped(t), rtol=0, atol=1e-12)
    for order in (1, 2, 3):
        got = derivative(spline, index[1:-1], t[1:-1], order)
        np.testing.assert_allclose(got, clamped(t[1:-1], order), rtol=0, atol=1e-10)


@pytest.mark.parametrize("count", [2, 3, 6])
def test_given_end_curvature_is_met(count: int) -> None:
    """The second derivative at the ends is the given one, for pieces of any length."""
    curved = (EndKind.CURVATURE, EndKind.CURVATURE)
    vectors = np.array([[0.1, 0.2, 0.3], [-0.2, 0.0, 0.1]])
    spline = loft(CurveData.single(WAVE[:count], end_kind=curved, end_vector=vectors))
    np.testing.assert_allclose(second_derivatives(spline, 0)[0], vectors[0], atol=1e-13)
    np.testing.assert_allclose(second_derivatives(spline, count - 2)[1], vectors[1], atol=1e-13)


@pytest.mark.parametrize("last", list(EndKind))
@pytest.mark.parametrize("first", list(EndKind))
@pytest.mark.parametrize("count", [2, 3, 6])
def test_short_pieces_stand_all_end_kinds(count: int, first: EndKind, last: EndKind) -> None:
    """A piece of 2 or 3 points has finite derivatives and holds what is given at its ends."""
    data = CurveData.single(WAVE[:count], end_kind=(first, last), end_vector=ENDS)
    spline = loft(data)
    assert np.isfinite(spline.leave).all()
    for kind, place, given, side in ((first, 0, ENDS[0], 0), (last, count - 1, ENDS[1], 1)):
        if kind == EndKind.TANGENT:
            np.testing.assert_allclose(spline.leave[place], unit(given), rtol=1e-15)
        if kind == EndKind.CURVATURE:
            segment = 0 if side == 0 else count - 2
            np.testing.assert_allclose(second_derivatives(spline, segment)[side], given, atol=1e-12)


def test_the_second_derivative_is_continuous_inside_a_piece() -> None:
    """At smooth points the curve has one second derivative."""
    spline = loft(CurveData.single(WAVE))
    for knot in range(1, len(WAVE) - 1):
        before, after = second_derivatives(spline, knot - 1)[1], second_derivatives(spline, knot)[0]
        np.testing.assert_allclose(before, after, rtol=0, atol=1e-13)


@pytest.mark.parametrize("place", [1, 2, 3, 4])
def test_a_tangent_point_has_the_given_direction(place: int) -> None:
    """The curve passes smoothly, along the given direction, with unit derivative."""
    spline = with_kind(place, PointKind.TANGENT)
    np.testing.assert_allclose(spline.leave[place], unit(np.array([5.0, -1.0, 0.0])), rtol=1e-15)
    assert spline.leave.tobytes() == spline.arrive.tobytes()


@pytest.mark.parametrize("place", [1, 2, 3, 4])
def test_a_knuckle_is_a_corner_and_cuts_the_curve(place: int) -> None:
    """Both sides of a knuckle are the curves they would be alone, with a free end there."""
    spline = with_kind(place, PointKind.KNUCKLE)
    assert not np.allclose(spline.leave[place], spline.arrive[place])
    before = CurveData.single(
        WAVE[: place + 1], end_kind=(EndKind.TANGENT, EndKind.FREE), end_vector=ENDS
    )
    after = CurveData.single(
        WAVE[place:], end_kind=(EndKind.FREE, EndKind.TANGENT), end_vector=ENDS
    )
    np.testing.assert_allclose(
        loft(before).arrive[1:], spline.arrive[1 : place + 1], rtol=0, atol=1e-14
    )
    np.testing.assert_allclose(loft(after).leave[:-1], spline.leave[place:-1], rtol=0, atol=1e-14)


def test_the_knuckle_rule_has_its_reference_value() -> None:
    """Knuckle (0, 0), neighbour (3, 1), 40 degrees there: derivative and energy (eq. 1-2)."""
    angle = np.deg2rad(40.0)
    points = np.array([[0.0, 0, 0], [3, 1, 0]])
    vectors = np.array([np.zeros(3), [np.cos(angle), np.sin(angle), 0.0]])
    ends = (EndKind.FREE, EndKind.TANGENT)
    spline = loft(CurveData.single(points, end_kind=ends, end_vector=vectors))
    by_unit_interval = spline.leave[0] * spline.knot[1]
    np.testing.assert_allclose(by_unit_interval[:2], [3.3735619285, 0.5548062297], atol=1e-10)


def test_the_knuckle_rule_minimises_its_energy() -> None:
    """With the length of the neighbour's vector free, the energy is the reference value."""
    angle = np.deg2rad(40.0)
    towards, chord = np.array([np.cos(angle), np.sin(angle)]), np.array([3.0, 1.0])
    third = chord - (chord @ towards) / 3.0 * towards
    second = np.array([3.3735619285, 0.5548062297]) / 3.0
    one, other = third - 2 * second, second - 2 * third + chord
    energy = 12.0 * (one @ one + one @ other + other @ other)
    assert energy == pytest.approx(4.0529520909, abs=1e-9)


def test_the_rule_does_not_fold_back() -> None:
    """Where the neighbour points away from the chord the end derivative stays moderate."""
    points = np.array([[0.0, 0, 0], [1, 0, 0]])
    vectors = np.array([np.zeros(3), [-1.0, 0.1, 0.0]])
    ends = (EndKind.FREE, EndKind.TANGENT)
    spline = loft(CurveData.single(points, end_kind=ends, end_vector=vectors))
    expected = (3.0 * np.array([1.0, 0, 0]) - unit(vectors[1])) / 2.0
    np.testing.assert_allclose(spline.leave[0], expected, rtol=1e-15)


def test_a_curve_that_returns_on_itself_has_a_straight_end() -> None:
    """Where the parabola has no direction the chord stands in."""
    spline = loft(CurveData.single(np.array([[0.0, 0, 0], [1, 0, 0], [0, 0, 0]])))
    np.testing.assert_array_equal(spline.leave[0], [1.0, 0.0, 0.0])


def test_reversal_reverses_the_curve() -> None:
    """The curve through the points in reverse order is the same curve."""
    one, other = loft(CurveData.single(WAVE)), loft(CurveData.single(WAVE[::-1].copy()))
    np.testing.assert_allclose(one.leave, -other.arrive[::-1], rtol=0, atol=1e-14)


def test_two_points_make_a_straight_line() -> None:
    """Nothing given: derivative along the chord, of unit length."""
    spline = loft(CurveData.single(np.array([[0.0, 0, 0], [3, 4, 0]])))
    np.testing.assert_array_equal(spline.leave, [[0.6, 0.8, 0], [0.6, 0.8, 0]])


def test_too_few_points_are_refused_by_name() -> None:
    """A curve of one point is named in the error."""
    data = CurveData.single(WAVE[:1])
    with pytest.raises(TooFewPointsError, match="curve 0 of the batch has 1"):
        loft(data)
    with pytest.raises(TooFewPointsError, match="WL 3 has 1"):
        loft(data, names=["WL 3"])


def test_coincident_points_are_refused() -> None:
    """Neighbours nearer than 1e-6 m are named with place and distance."""
    points = WAVE.copy()
    points[3] = points[2] + [5e-7, 0, 0]
    with pytest.raises(CoincidentPointsError, match=r"WL 3 at \(2.5000, 1.0000, 0.3000\)"):
        loft(CurveData.single(points), names=["WL 3"])


def test_end_of_one_curve_may_be_the_start_of_the_next() -> None:
    """Only neighbours on one curve may not coincide."""
    line = CurveData.single(WAVE[:2])
    both = CurveData(
        np.array([0, 2, 4]),
        np.vstack([WAVE[:2], WAVE[1:3]]),
        np.zeros(4, np.int8),
        np.zeros((4, 3)),
        np.zeros((2, 2), np.int8),
        np.zeros((2, 2, 3)),
    )
    assert loft(both).curve(0).leave.tobytes() == loft(line).leave.tobytes()


@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_numbers_that_are_not_finite_are_refused(value: float) -> None:
    """Points, directions and curvatures must be finite."""
    points, vectors = WAVE.copy(), np.zeros((2, 3))
    points[2, 1] = vectors[1, 1] = value
    with pytest.raises(BadInputError, match="point 2"):
        loft(CurveData.single(points))
    for kind in (EndKind.TANGENT, EndKind.CURVATURE):
        with pytest.raises(BadInputError, match="not finite"):
            loft(CurveData.single(WAVE, end_kind=(kind, kind), end_vector=vectors))


def test_what_is_not_asked_need_not_be_finite() -> None:
    """Directions at smooth points are ignored, whatever they are."""
    spline = loft(CurveData.single(WAVE, direction=np.full(WAVE.shape, np.nan)))
    assert spline.leave.tobytes() == loft(CurveData.single(WAVE)).leave.tobytes()


def test_a_nil_direction_and_an_unknown_kind_are_refused() -> None:
    """A tangent point needs a direction, a kind must exist."""
    with pytest.raises(BadInputError, match="direction"):
        loft(CurveData.single(WAVE, [0, 1, 0, 0, 0, 0]))
    with pytest.raises(BadInputError, match="kind"):
        loft(CurveData.single(WAVE, [0, 3, 0, 0, 0, 0]))


def test_results_are_frozen() -> None:
    """No array of a result can be written to."""
    spline = loft(CurveData.single(WAVE))
    start, xyz = sample(spline)
    arrays = (spline.knot, spline.xyz, spline.leave, spline.arrive, start, xyz)
    assert not any(array.flags.writeable for array in arrays)


def test_samples_pass_through_the_knots() -> None:
    """A polyline holds the defining points, and points of the curve between them."""
    one = loft(CurveData.single(WAVE))
    start, xyz = sample(SplineBatch.join([one, one]), per_segment=4)
    assert start.tolist() == [0, 21, 42]
    assert xyz[:21:4].tobytes() == WAVE.tobytes()
    assert xyz[21:].tobytes() == xyz[:21].tobytes()
    t = one.knot[0] + 0.25 * (one.knot[1] - one.knot[0])
    np.testing.assert_allclose(xyz[1], evaluate(one, np.array([0]), np.array([t]))[0], atol=1e-15)


def test_evaluation_outside_a_curve_is_refused() -> None:
    """A parameter outside its curve, a curve outside the batch, an order outside 1 to 3."""
    spline = loft(CurveData.single(WAVE))
    zero = np.array([0])
    for t in (-0.1, float(spline.knot[-1]) + 0.1, np.nan):
        with pytest.raises(BadInputError, match="outside"):
            evaluate(spline, zero, np.array([t]))
    with pytest.raises(BadInputError, match="batch of 1"):
        evaluate(spline, np.array([1]), np.array([0.0]))
    with pytest.raises(BadInputError, match="order"):
        derivative(spline, zero, np.array([0.0]), order=4)
