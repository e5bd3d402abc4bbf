"""What the parts of `geometry.splines` give, one small example of each."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_array_equal

from assoc_hull.geometry.curves import CurveData
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.loft_tangents import loft_tangents
from assoc_hull.geometry.splines.plane_heights import PlaneHeights, heights_over_plane, nodes_of
from assoc_hull.geometry.splines.plane_intersections import intersect_planes, points_on_plane
from assoc_hull.geometry.splines.segments import derivative


def test_the_height_of_curves_over_a_plane_segment() -> None:
    """The height of curves over a plane, segment by segment, in Bernstein form."""
    line = loft(CurveData.single(np.array([[0.0, 0, 1], [0, 3, 1], [0, 3, 5]])))
    assert_array_equal(heights_over_plane(line, np.array([0.0, 0.0, 1.0])).rise, [0.0, 4.0])


def test_parts_of_curves_whose_height_over_a_family() -> None:
    """Parts of curves whose height over a family of planes is monotone."""
    hill = PlaneHeights(np.zeros(2), np.zeros(1), np.ones(1), -np.ones(1))
    assert_array_equal(nodes_of(hill, np.array([0]))[0].ravel(), [0.0, 0.0, 0.5, 1.0])


def test_points_derivatives_and_polylines_of_cubic_composite_splines() -> None:
    """Points, derivatives and polylines of cubic composite splines."""
    spline = loft(CurveData.single(np.array([[0.0, 0, 0], [3, 4, 0]])))
    assert_array_equal(derivative(spline, np.array([0]), np.array([1.0])), [[0.6, 0.8, 0.0]])


def test_how_lofted_curves_change_when_their_points_move() -> None:
    """How lofted curves change when their points move: the loft itself, differentiated
    exactly."""
    line = CurveData.single(np.array([[0.0, 0, 0], [2, 0, 0]]))
    # one tangent: the second point, forward
    stretched = np.array([[[0.0, 0, 0], [1, 0, 0]]])
    assert loft_tangents(line, stretched).knot.dot.tolist() == [[0.0, 1.0]]


def test_where_curves_meet_families_of_parallel_planes_all_meetings() -> None:
    """Where curves meet families of parallel planes: all meetings, their signs in alternation."""
    line = loft(CurveData.single(np.array([[0.0, 0, 0], [0, 0, 4]])))
    assert_array_equal(
        intersect_planes(line, np.array([0.0, 0.0, 1.0]), np.array([1.0, 2.0])).t, [1.0, 2.0]
    )


def test_places_on_curves_that_measures_of_a_form_start() -> None:
    """Places on curves that measures of a form start from: where they reach a plane, where
    they turn."""
    stem = loft(CurveData.single(np.array([[98.0, 0, 0], [100, 0, 5], [102, 0, 10]])))
    assert points_on_plane(stem, np.array([0.0, 0.0, 1.0]), 5.0).xyz.tolist() == [[100.0, 0.0, 5.0]]
