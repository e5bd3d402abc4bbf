"""The farthest of all nearest places of two curves, both ways round."""

import numpy as np
import pytest

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import CurveData, SplineBatch
from assoc_hull.geometry.splines.distance import OwnedCurves, farthest_points
from assoc_hull.geometry.splines.loft import loft


def through(*places: tuple[float, float]) -> SplineBatch:
    """A spline in the plane z = 0."""
    return loft(CurveData.single(np.array([[x, y, 0.0] for x, y in places])))


LEVEL = through((0, 0), (10, 0))


def test_a_summit_between_knots_is_found() -> None:
    """The top of a parabola over a straight line, which lies at no knot and no even step."""
    # Two segments of y = x (10 - x) / 10 itself, over x.
    x = np.array([0.0, 3.7, 10.0])
    slope = np.stack([np.ones(3), 1.0 - 0.2 * x, np.zeros(3)], axis=1)
    places = np.stack([x, 0.1 * x * (10.0 - x), np.zeros(3)], axis=1)
    hump = SplineBatch(np.array([0, 3]), x, places, slope, slope.copy())
    found = farthest_points(OwnedCurves.of([[LEVEL]]), OwnedCurves.of([[hump]]))
    assert found.distance[0] == pytest.approx(2.5, abs=1e-6)
    assert found.other[0] == pytest.approx([5.0, 2.5, 0.0], abs=2e-3)
    assert found.one[0] == pytest.approx([5.0, 0.0, 0.0], abs=2e-3)


def test_what_one_curve_lacks_counts_either_way() -> None:
    """A longer curve lies as far from a shorter one as the shorter from it; the sense turns."""
    longer = through((-3, 0), (10, 0))
    there = farthest_points(OwnedCurves.of([[LEVEL]]), OwnedCurves.of([[longer]]))
    back = farthest_points(OwnedCurves.of([[longer]]), OwnedCurves.of([[LEVEL]]))
    assert there.distance.tolist() == back.distance.tolist() == [3.0]
    assert (there.one.tolist(), there.other.tolist()) == ([[0, 0, 0]], [[-3, 0, 0]])
    assert (back.one.tolist(), back.other.tolist()) == ([[-3, 0, 0]], [[0, 0, 0]])


def test_things_of_several_curves_are_compared_as_wholes() -> None:
    """A line in two pieces is that in one; things beside one another do not know each other."""
    halves = [through((0, 0), (4, 0)), through((4, 0), (10, 0))]
    raised = through((0, 1), (10, 1))
    found = farthest_points(OwnedCurves.of([halves, [LEVEL]]), OwnedCurves.of([[LEVEL], [raised]]))
    assert found.distance == pytest.approx([0.0, 1.0], abs=1e-12)


def test_nothing_has_no_distance() -> None:
    """No things give no rows."""
    assert len(farthest_points(OwnedCurves.of([]), OwnedCurves.of([])).distance) == 0


def test_partners_that_are_missing_are_refused() -> None:
    """Both sides have the same things; the message says which."""
    with pytest.raises(BadInputError, match=r"owners \[0\] and \[0, 1\]"):
        farthest_points(OwnedCurves.of([[LEVEL]]), OwnedCurves.of([[LEVEL], [LEVEL]]))
    with pytest.raises(BadInputError, match="ascending"):
        OwnedCurves(LEVEL, np.array([0, 1]))
