"""Meetings of curves and planes."""

from collections.abc import Iterator

import numpy as np
import pytest
from scipy.interpolate import PPoly

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import CurveData, FloatArray, SplineBatch
from assoc_hull.geometry.plane import Plane
from assoc_hull.geometry.splines.backend import backend, set_backend
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.plane_intersections import (
    PlaneIntersections,
    intersect_planes,
)
from assoc_hull.geometry.splines.segments import bezier_points, evaluate

UP = np.array([0.0, 0.0, 1.0])
SKEW = np.array([0.48, 0.6, 0.64])


@pytest.fixture(autouse=True, scope="module", params=["numpy", "numba"])
def backend_in_use(request: pytest.FixtureRequest) -> Iterator[None]:
    """Every test of this file holds for both backends."""
    if request.param == "numba":
        pytest.importorskip("numba")
    before = backend()
    set_backend(request.param)
    yield
    set_backend(before)


def hermite(z: list[float], leave: list[float], arrive: list[float]) -> SplineBatch:
    """A curve with knots one apart along x, of these heights and slopes."""
    count = len(z)
    column = np.arange(count, dtype=float)
    one, nil = np.ones(count), np.zeros(count)
    return SplineBatch(
        np.array([0, count]),
        column,
        np.column_stack([column, nil, z]),
        np.column_stack([one, nil, leave]),
        np.column_stack([one, nil, arrive]),
    )


def random_batch(seed: int, curves: int = 12) -> SplineBatch:
    """Wild curves of 2 to 20 points in a box of 10 m."""
    rng = np.random.default_rng(seed)
    parts = [
        loft(CurveData.single(rng.uniform(-5, 5, (int(rng.integers(2, 20)), 3))))
        for _ in range(curves)
    ]
    return SplineBatch.join(parts)


def reference_roots(
    batch: SplineBatch, curve: int, normal: FloatArray, offset: float
) -> FloatArray:
    """The roots that scipy finds."""
    one = batch.curve(curve)
    points = bezier_points(one)
    b0, b1, b2, b3 = (points @ normal).T
    step = np.diff(one.knot)
    powers = [
        (b3 - 3 * b2 + 3 * b1 - b0) / step**3,
        3 * (b0 - 2 * b1 + b2) / step**2,
        3 * (b1 - b0) / step,
        b0,
    ]
    roots: FloatArray = PPoly(np.array(powers), one.knot).solve(offset, extrapolate=False)
    return np.sort(roots)


def heights_of(meetings: PlaneIntersections, normal: FloatArray, offsets: FloatArray) -> FloatArray:
    """Distance of the points from their planes."""
    result: FloatArray = meetings.xyz @ normal - offsets[meetings.plane]
    return result


@pytest.mark.parametrize("normal", [*np.eye(3), -UP, SKEW], ids=["x", "y", "z", "-z", "skew"])
@pytest.mark.parametrize("seed", range(3))
def test_all_roots_are_found(seed: int, normal: FloatArray) -> None:
    """Every root that scipy finds is met, in order, once, with the right point."""
    batch, offsets = random_batch(seed), np.linspace(-4.9, 4.7, 23)
    meetings = intersect_planes(batch, normal, offsets)
    for curve in range(batch.count):
        for plane, offset in enumerate(offsets):
            mine = meetings.t[(meetings.curve == curve) & (meetings.plane == plane)]
            expected = reference_roots(batch, curve, normal, offset)
            assert len(mine) == len(expected)
            np.testing.assert_allclose(mine, expected, rtol=0, atol=1e-7)
    assert np.abs(heights_of(meetings, normal, offsets)).max() < 1e-13
    again = evaluate(batch, meetings.curve, meetings.t)
    np.testing.assert_allclose(again, meetings.xyz, rtol=0, atol=1e-12)


@pytest.mark.parametrize("seed", range(3))
def test_signs_alternate_and_the_order_is_curve_plane_parameter(seed: int) -> None:
    """Along one curve and one plane signs alternate; meetings are sorted."""
    batch, offsets = random_batch(seed), np.linspace(-4.9, 4.7, 23)
    meetings = intersect_planes(batch, SKEW, offsets)
    keys = list(zip(meetings.curve, meetings.plane, meetings.t, strict=True))
    assert keys == sorted(keys)
    same = (np.diff(meetings.curve) == 0) & (np.diff(meetings.plane) == 0)
    assert (meetings.sign[1:][same] == -meetings.sign[:-1][same]).all()
    inside = meetings.segment >= batch.start[meetings.curve]
    assert (inside & (meetings.segment + 1 < batch.start[meetings.curve + 1])).all()


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_meetings_with_planes_through_knots_are_exact(axis: int) -> None:
    """A plane through a knot is met there once, with exactly its parameter and point."""
    batch = random_batch(7)
    normal = np.eye(3)[axis]
    offsets = np.unique(batch.xyz[:, axis])
    meetings = intersect_planes(batch, normal, offsets)
    at_knot = 0
    for curve in range(batch.count):
        for knot in range(batch.start[curve] + 1, batch.start[curve + 1] - 1):
            mine = (meetings.curve == curve) & (
                meetings.plane == np.searchsorted(offsets, batch.xyz[knot, axis])
            )
            exact = mine & (meetings.t == batch.knot[knot])
            near = mine & (np.abs(meetings.t - batch.knot[knot]) < 1e-9)
            if batch.leave[knot, axis] * batch.arrive[knot, axis] > 0.0:
                assert exact.sum() == near.sum() == 1
                assert meetings.xyz[exact][0].tobytes() == batch.xyz[knot].tobytes()
                at_knot += 1
    assert at_knot > 50
    assert (meetings.xyz[:, axis] == offsets[meetings.plane]).all()


def test_three_roots_in_one_segment() -> None:
    """A wiggle between two knots meets the plane three times."""
    wiggle = hermite([-0.1, 0.1], [4.0, 0.0], [0.0, 4.0])
    meetings = intersect_planes(wiggle, UP, np.array([0.0]))
    assert meetings.sign.tolist() == [1, -1, 1]
    assert meetings.t[1] == pytest.approx(0.5, abs=1e-15)
    assert not meetings.tangential.any()


def test_a_second_plane_changes_no_bit() -> None:
    """The meetings with a plane do not depend on which other planes are asked."""
    batch, offsets = random_batch(5), np.linspace(-4.9, 4.7, 23)
    together = intersect_planes(batch, SKEW, offsets)
    for plane, offset in enumerate(offsets):
        alone = intersect_planes(batch, SKEW, np.array([offset]))
        mine = together.plane == plane
        assert alone.xyz.tobytes() == together.xyz[mine].tobytes()
        assert alone.t.tobytes() == together.t[mine].tobytes()


def test_nearly_touching_from_below_are_two_tangential_meetings() -> None:
    """Two meetings with less than 1e-9 m between them and the plane are marked."""
    hill = hermite([-1.0, 0.0, -1.0], [1.0, 0.0, -1.0], [1.0, 0.0, -1.0])
    for lift, marked in ((0.0, True), (5e-10, True), (1e-6, False)):
        meetings = intersect_planes(hill, UP, np.array([-lift]))
        assert meetings.sign.tolist() == [1, -1]
        assert meetings.tangential.tolist() == [marked, marked]


def test_a_touch_from_above_is_no_meeting() -> None:
    """A valley that reaches the plane between knots, or at one."""
    between = hermite([1.0, 1.0], [-4.0, 4.0], [-4.0, 4.0])
    at_knot = hermite([1.0, 0.0, 1.0], [-1.0, 0.0, 1.0], [-1.0, 0.0, 1.0])
    for valley in (between, at_knot):
        assert intersect_planes(valley, UP, np.array([0.0])).count == 0


def test_a_knot_next_to_a_meeting_is_no_second_one() -> None:
    """Nor where it lies closer to the plane than rounding."""
    rising = hermite([-1.0, 1e-10, 1.0], [1.0, 1.0, 1.0], [1.0, 1.0, 1.0])
    assert intersect_planes(rising, UP, np.array([0.0])).count == 1


@pytest.mark.parametrize("noise", [0.0, 3e-10, -3e-10])
def test_a_curve_that_lies_in_the_plane_for_a_while(noise: float) -> None:
    """No meeting lies inside the level stretch, one where the curve leaves it downwards."""
    level = hermite([1.0, noise, -noise, -1.0], [0.0, 0.0, 0.0, -1.0], [-1.0, 0.0, 0.0, -1.0])
    meetings = intersect_planes(level, UP, np.array([0.0]))
    assert meetings.sign.tolist() == [-1]
    assert meetings.t[0] == pytest.approx(2.0, abs=1e-4)
    assert meetings.t[0] >= 2.0


@pytest.mark.parametrize("noise", [0.0, 3e-10, -3e-10])
def test_a_curve_that_rises_into_the_plane(noise: float) -> None:
    """Coming from below it meets the plane where the level stretch begins."""
    level = hermite([-1.0, noise, -noise, 1.0], [1.0, 0.0, 0.0, 1.0], [1.0, 0.0, 0.0, 1.0])
    meetings = intersect_planes(level, UP, np.array([0.0]))
    assert meetings.sign.tolist() == [1]
    assert meetings.t[0] == pytest.approx(1.0, abs=1e-4)
    assert meetings.t[0] <= 1.0


def test_a_triple_root_is_found() -> None:
    """A curve that grazes and crosses at once meets the plane once."""
    cubic = hermite([-0.125, 0.125], [0.75, 0.0], [0.0, 0.75])
    meetings = intersect_planes(cubic, UP, np.array([0.0]))
    assert meetings.sign.tolist() == [1]
    assert np.abs(meetings.t - 0.5).max() < 1e-4


def test_no_plane_and_no_meeting() -> None:
    """An empty family, and planes out of reach, give empty results."""
    batch = random_batch(1)
    assert intersect_planes(batch, UP, np.zeros(0)).count == 0
    assert intersect_planes(batch, UP, np.array([100.0])).xyz.shape == (0, 3)


def test_bad_planes_are_refused() -> None:
    """The normal must have length one and the offsets must ascend."""
    batch = random_batch(1, 2)
    for normal in (np.array([0.0, 0, 2]), np.array([np.nan, 0, 1]), np.array([1.0, 0])):
        with pytest.raises(BadInputError, match="unit"):
            intersect_planes(batch, normal, np.array([0.0]))
    for offsets in ([1.0, 0.0], [np.nan], [0.0, np.inf]):
        with pytest.raises(BadInputError, match="ascend"):
            intersect_planes(batch, UP, np.array(offsets))


def test_results_are_frozen() -> None:
    """No array of the result can be written to."""
    meetings = intersect_planes(random_batch(1), UP, np.array([0.0]))
    arrays = (meetings.curve, meetings.plane, meetings.segment, meetings.t, meetings.xyz)
    assert not any(array.flags.writeable for array in (*arrays, meetings.sign, meetings.tangential))


def test_a_plane_knows_its_axis_and_heights() -> None:
    """Planes across an axis say so, others do not."""
    assert Plane.across("y", 2.0).axis == "y"
    assert Plane(SKEW, 0.0).axis is None
    assert Plane(-UP, 0.0).axis is None
    heights = Plane(SKEW, 1.0).height(np.array([SKEW, -SKEW]))
    np.testing.assert_allclose(heights, [0.0, -2.0], atol=1e-15)
    with pytest.raises(BadInputError, match="unit"):
        Plane(np.array([1.0, 1.0, 0.0]), 0.0)
