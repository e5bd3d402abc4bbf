"""Curves through points are pulled, and lines of a net with them."""

import itertools
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

from assoc_hull.errors import BadInputError, WrongTypeError
from assoc_hull.geometry.curves import CurveData, EndKind, FloatArray
from assoc_hull.geometry.splines.distance import closest_points
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.segments import evaluate
from assoc_hull.hull import Hull
from assoc_hull.hull.sources import examples
from assoc_hull.model.objects import Curve, Line
from assoc_hull.variation.direct.pull_curve_through import (
    HeldPlace,
    all_free,
    pass_places,
    pass_through,
    pull_through,
)
from tests.complex_loft import complex_loft
from tests.taken_back import taken_back

POINTS = np.array(
    [(0, 0, 0), (1, 2, 0), (2.5, 3, 0), (4, 3, 0), (5.5, 2, 0), (6.5, 1, 0), (7, 0, 0)], np.float64
)
CURVE = CurveData.single(POINTS)
PLACE = (2, 0.4)
"""Segment and fraction that are held."""


@pytest.fixture(scope="module")
def wigley() -> Hull:
    """The Wigley hull."""
    return examples.wigley()


@pytest.fixture
def hull(wigley: Hull) -> Iterator[Hull]:
    """The Wigley hull, to be edited at will."""
    with taken_back(wigley) as copy:
        yield copy


def held_place(data: CurveData, segment: int, fraction: float) -> FloatArray:
    """Where a place of a curve lies."""
    spline = loft(data)
    t = spline.knot[segment] + fraction * (spline.knot[segment + 1] - spline.knot[segment])
    place: FloatArray = evaluate(spline, np.array([0]), np.array([t]))[0]
    return place


def curve_of(hull: Hull, name: str) -> Curve:
    """The only curve of a line."""
    line = hull.find(name)
    assert isinstance(line, Line)
    return line.curves[0]


def test_what_is_left_is_squared_from_step_to_step() -> None:
    """Newton with exact derivatives: from 0.3 m to rounding in three steps, each squaring."""
    asked = held_place(CURVE, *PLACE) + np.array([0.0, 0.3, 0.0])
    left = pass_through(CURVE, [HeldPlace(*PLACE, asked)]).residuals
    assert left[0] == pytest.approx(0.3, abs=1e-12)
    assert len(left) == 4
    assert left[1] < 5e-3
    assert left[2] < 1e-6
    assert left[3] < 2e-15
    for before, after in itertools.pairwise(left):
        assert after < 0.2 * before**2 + 2e-15


def test_the_place_is_met_with_segment_and_fraction_held() -> None:
    """The new curve passes through what was asked at the same fraction of the same segment."""
    asked = held_place(CURVE, *PLACE) + np.array([0.1, 0.3, 0.2])
    moved = CurveData.single(pass_through(CURVE, [HeldPlace(*PLACE, asked)]).xyz)
    assert held_place(moved, *PLACE) == pytest.approx(asked, abs=1e-13)


def test_the_derivatives_are_those_of_the_loft() -> None:
    """A small step is the least one by derivatives of a complex step through the whole loft."""
    size, h = 1e-6, 1e-30
    rows = np.zeros((2, 14))
    for i in range(14):
        xyz = POINTS.astype(complex)
        xyz[i // 2, i % 2] += 1j * h
        curve = complex_loft(xyz, [0] * 7, np.zeros((7, 3)), (0, 0), np.zeros((2, 3)))
        segment, u = PLACE
        width = curve.knot[segment + 1] - curve.knot[segment]
        start, end = curve.xyz[segment], curve.xyz[segment + 1]
        leave, arrive = width * curve.leave[segment], width * curve.arrive[segment + 1]
        place = (
            start * (1 - u) ** 2 * (1 + 2 * u) + end * u**2 * (3 - 2 * u)
            + leave * u * (1 - u) ** 2 - arrive * u**2 * (1 - u)
        )  # fmt: skip
        rows[:, i] = place.imag[:2] / h
    step = rows.T @ np.linalg.solve(rows @ rows.T, [0.0, size])
    asked = held_place(CURVE, *PLACE) + np.array([0.0, size, 0.0])
    change = pass_through(CURVE, [HeldPlace(*PLACE, asked)]).xyz - POINTS
    assert change[:, :2].ravel() == pytest.approx(step, abs=1e-4 * size)
    assert np.abs(change[:, 2]).max() < 1e-12


def test_pins_and_fixed_points_stay() -> None:
    """A place that is asked to stay does, a fixed point keeps its bits."""
    pin = held_place(CURVE, 4, 0.5)
    asked = held_place(CURVE, *PLACE) + np.array([0.0, 0.2, 0.0])
    free = all_free(CURVE, fixed=[0, 6])
    passed = pass_through(CURVE, [HeldPlace(*PLACE, asked), HeldPlace(4, 0.5, pin)], free)
    moved = CurveData.single(passed.xyz)
    assert held_place(moved, *PLACE) == pytest.approx(asked, abs=1e-13)
    assert held_place(moved, 4, 0.5) == pytest.approx(pin, abs=1e-13)
    assert passed.xyz[[0, 6]].tobytes() == POINTS[[0, 6]].tobytes()


def test_a_place_may_slide_along_the_curve() -> None:
    """Points free in y only bring the curve through a place, wherever along it that comes."""
    free = all_free(CURVE)[1::3]
    asked = np.array([[3.0, 3.4, 0.0], [5.0, 2.2, 0.0]])
    passed = pass_places(CURVE, asked, free)
    distance = closest_points(loft(CurveData.single(passed.xyz)), 0, asked)[2]
    assert distance.max() < 1e-12
    assert (passed.xyz[:, [0, 2]] == POINTS[:, [0, 2]]).all()


def test_knuckles_and_end_tangents_are_kept() -> None:
    """A curve with a knuckle and a given end direction passes through what is asked as well."""
    data = CurveData.single(
        POINTS,
        [0, 0, 0, 2, 0, 0, 0],
        end_kind=(EndKind.TANGENT, EndKind.FREE),
        end_vector=np.array([[0.0, 1, 0], [0, 0, 0]]),
    )
    asked = held_place(data, *PLACE) + np.array([0.0, 0.2, 0.0])
    passed = pass_through(data, [HeldPlace(*PLACE, asked)])
    assert passed.residuals[-1] < 1e-12
    assert np.abs(passed.xyz[4:] - POINTS[4:]).max() == 0.0


@pytest.mark.parametrize(
    ("targets", "message"),
    [
        ([HeldPlace(6, 0.5, POINTS[0])], "segment is 6"),
        ([HeldPlace(2, 1.5, POINTS[0])], "fraction is 1.5"),
        ([HeldPlace(2, 0.5, np.array([1.0, np.nan, 0]))], "place"),
        ([], "1 curves and 0 targets"),
        ([HeldPlace(2, 0.5, POINTS[2]), HeldPlace(2, 0.5, POINTS[3])], "2 targets on one point"),
    ],
)
def test_what_cannot_be_asked_is_refused(targets: list[HeldPlace], message: str) -> None:
    """Each refusal is an error of the family and says what is wrong."""
    with pytest.raises(BadInputError, match=message):
        pass_through(CURVE, targets)


def test_a_place_out_of_reach_is_refused() -> None:
    """Points that move in one plane bring no curve to a place outside it."""
    with pytest.raises(BadInputError, match="that no point can move"):
        pass_places(CURVE, np.array([[3.0, 3.4, 0.1]]), all_free(CURVE)[1::3])


def test_a_waterline_is_pulled_through_a_place(hull: Hull) -> None:
    """The edited line passes through target and pin; fixed points and other heights stay."""
    curve = curve_of(hull, "WL 2.5")
    ends = curve.defining[0], curve.defining[-1]
    before = hull.half_breadth(52.0, 5.0)
    target = [52.0, hull.half_breadth(52.0, 2.5) + 0.02, 2.5]
    pin = [66.0, hull.half_breadth(66.0, 2.5), 2.5]
    with hull.edit("fuller") as edit:
        moved = pull_through(edit, curve, [target], pins=[pin], fixed=ends)
    found = [hull.half_breadth(x, 2.5) for x in (52.0, 66.0)]
    assert found == pytest.approx([target[1], pin[1]], abs=1e-9)
    assert not {point.id for point in moved} & {point.id for point in ends}
    assert hull.half_breadth(52.0, 5.0) == pytest.approx(before, abs=5e-3)


def test_a_station_takes_its_points_along_their_planes(hull: Hull) -> None:
    """Crossings of a station with waterlines move athwart only, and the station passes."""
    curve = curve_of(hull, "ST 10")
    athwart = [point for point in curve.defining if point.free == ("y",)]
    heights = [point.z for point in athwart]
    target = np.array([[50.0, hull.half_breadth(50.0, 3.1) + 0.03, 3.1]])
    with hull.edit("fuller station") as edit:
        pull_through(edit, curve, target, fixed=(curve.defining[0], curve.defining[-1]))
    assert closest_points(curve.spline, 0, target)[2][0] < 1e-9
    assert len(athwart) > 5
    assert [point.z for point in athwart] == heights


def test_a_place_off_the_plane_of_the_line_is_refused(hull: Hull) -> None:
    """The hull is as it was."""
    before = hull.fingerprint
    with pytest.raises(BadInputError, match="in the plane of the curve"), hull.edit("off") as edit:
        pull_through(edit, curve_of(hull, "ST 10"), [[50.1, 3.0, 3.1]])
    assert hull.fingerprint == before


def test_a_curve_with_nothing_free_is_refused(hull: Hull) -> None:
    """All points fixed leave nothing to move."""
    curve = curve_of(hull, "ST 10")
    with pytest.raises(BadInputError, match="no point that may move"), hull.edit("none") as edit:
        pull_through(edit, curve, [[50.0, 3.0, 3.1]], fixed=curve.defining)


def test_fixed_points_are_points(hull: Hull) -> None:
    """A name does not do; the hull is as it was."""
    before = hull.fingerprint
    names: Any = ["ST 10"]
    with pytest.raises(WrongTypeError, match="an item of fixed is 'ST 10'"), hull.edit("f") as edit:
        pull_through(edit, curve_of(hull, "ST 10"), [[50.0, 3.0, 3.1]], fixed=names)
    assert hull.fingerprint == before
