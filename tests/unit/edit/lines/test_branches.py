"""Following the meetings of a curve with a plane that is shifted."""

from __future__ import annotations

import numpy as np
import pytest

from assoc_hull.edit.lines.shift_line import track_intersections
from assoc_hull.geometry.curves import CurveData, PointKind, SplineBatch
from assoc_hull.geometry.splines.loft import loft

UP = np.array([0.0, 0.0, 1.0])


def course(*heights: float) -> SplineBatch:
    """Make a curve through heights (m) one metre apart."""
    return loft(CurveData.single(np.array([[float(i), 0.0, z] for i, z in enumerate(heights)])))


def test_a_death_and_a_birth_in_one_shift_are_not_one_meeting() -> None:
    """Before and after the plane is met once, rising, but on different slopes."""
    hill = course(0.0, 2.0, 1.96, 4.0)
    assert track_intersections(hill, UP, 1.0, 3.0) == {}


def test_a_meeting_that_lasts_is_followed_past_others_that_come_and_go() -> None:
    """Two are born beside it: it is the third then."""
    hill = course(0.0, 2.0, 1.0, 4.0)
    assert track_intersections(hill, UP, 3.0, 1.5) == {0: 2}
    assert track_intersections(hill, UP, 1.5, 3.0) == {2: 0}


@pytest.mark.parametrize("start", [0.5, 1.5])
def test_a_plane_that_stays_keeps_every_meeting(start: float) -> None:
    """Whatever their number."""
    found = track_intersections(course(0.0, 2.0, 1.0, 4.0), UP, start, start)
    assert found == {i: i for i in range(len(found))}
    assert found


@pytest.mark.parametrize(("low", "followed"), [(0.99999, [0]), (0.9992, [0]), (0.9988, [])])
def test_a_height_that_hardly_goes_back_does_not_part_a_slope(
    low: float, followed: list[int]
) -> None:
    """No line is known within a millimetre: what goes back by less is no pair of meetings."""
    at = np.array([[0.0, 0, 0], [1, 0, 1], [2, 0, low], [3, 0, 2]])
    slope = loft(CurveData.single(at, np.full(4, PointKind.KNUCKLE, np.int8)))
    assert list(track_intersections(slope, UP, 0.5, 1.5)) == followed
