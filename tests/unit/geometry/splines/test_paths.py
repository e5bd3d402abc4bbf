"""Paths over splines: where they lead, and how fast."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from assoc_hull.geometry.curves import CurveData, FloatArray, SplineBatch
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.paths import Paths, shape_paths
from assoc_hull.geometry.splines.segments import evaluate
from tests.long_forms import draws

STEP = 1e-6


def _line(xyz: FloatArray) -> SplineBatch:
    return loft(CurveData.single(xyz))


def _wave() -> SplineBatch:
    x = np.array([0.0, 1.0, 2.5, 4.0, 7.0])
    return _line(np.column_stack([x, np.sin(x), 0.2 * x**2]))


@given(st.floats(0.0, 1.0))
@settings(max_examples=draws(60), deadline=None)
def test_a_path_over_a_whole_curve_is_the_curve(w: float) -> None:
    """Its fraction is the chord parameter divided by the length."""
    batch = _wave()
    path = shape_paths(Paths.of([[(i, 0.0, 1.0) for i in range(4)]]), batch)
    place, slope = path.at(np.array([0]), np.array([w]))
    whole = float(batch.knot[-1])
    expected = evaluate(batch, np.array([0]), np.array([w * whole]))
    assert place == pytest.approx(expected, abs=1e-12)
    inside = np.clip(np.array([w - STEP, w + STEP]), 0.0, 1.0)
    two = evaluate(batch, np.zeros(2, np.int64), inside * whole)
    assert slope[0] == pytest.approx((two[1] - two[0]) / (inside[1] - inside[0]), abs=2e-3)


@given(st.floats(0.0, 1.0))
@settings(max_examples=draws(60), deadline=None)
def test_a_path_walked_back_is_the_same_path(w: float) -> None:
    """Places at 1 - w, derivatives with the other sign."""
    batch = _wave()
    there = [(0, 0.25, 1.0), (1, 0.0, 1.0), (2, 0.0, 0.5)]
    back = [(s, b, a) for s, a, b in reversed(there)]
    both = shape_paths(Paths.of([there, back]), batch)
    one, along = both.at(np.array([0]), np.array([w]))
    other, against = both.at(np.array([1]), np.array([1.0 - w]))
    assert one == pytest.approx(other, abs=1e-12)
    assert along == pytest.approx(-against, abs=1e-8)


@given(st.floats(0.0, 1.0))
@settings(max_examples=draws(60), deadline=None)
def test_a_part_of_the_way_along_x_is_found(part: float) -> None:
    """The place lies by that part between the ends' x; its derivative has the ends' distance."""
    batch = _wave()
    path = shape_paths(
        Paths.of([[(0, 0.5, 1.0), (1, 0.0, 1.0), (2, 0.0, 1.0)], [(3, 0.0, 1.0)]]), batch
    )
    place, slope = path.at_part(np.array([0, 1]), np.array([part, part]))
    first, last = path.ends
    expected = first[:, 0] + part * (last - first)[:, 0]
    assert place[:, 0] == pytest.approx(expected, abs=1e-12)
    assert slope[:, 0] == pytest.approx((last - first)[:, 0], rel=1e-12)
    near = [np.clip(part + sign * STEP, 0.0, 1.0) for sign in (-1, 1)]
    low, high = (path.at_part(np.array([0, 1]), np.full(2, p))[0] for p in near)
    assert slope == pytest.approx((high - low) / (near[1] - near[0]), abs=2e-3)


def test_a_path_that_is_a_point_stays_there() -> None:
    """Rails may shrink to a point: the tip of an ellipsoid."""
    path = shape_paths(Paths.of([[(1, 0.5, 0.5)], [(2, 0.0, 1.0)]]), _wave())
    w = np.linspace(0.0, 1.0, 5)
    place, slope = path.at(np.zeros(5, np.int64), w)
    assert np.ptp(place, axis=0) == pytest.approx(0.0, abs=0.0)
    assert slope == pytest.approx(0.0, abs=0.0)
