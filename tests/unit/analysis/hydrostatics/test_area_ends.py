"""The sectional-area curve starts at the area of a transom or plumb end, not at nothing."""

from pathlib import Path

import numpy as np
import pytest

from assoc_hull.analysis.hydrostatics.floating_body import FloatingPosition
from assoc_hull.analysis.hydrostatics.section_areas import sectional_area_course
from tests.drawn_hulls import HALF, LENGTH, box_barge, transom_boat


def test_the_area_curve_of_a_box_is_a_level_line(tmp_path: Path) -> None:
    """30 m2 from end to end of 12 x 2.5 m, and a step at each end."""
    course = sectional_area_course(box_barge(tmp_path), FloatingPosition(2.5, 2.5))
    assert course is not None
    assert course[[0, -1]].tolist() == [[0.0, 0.0], [LENGTH, 0.0]]
    assert course[1:-1, 1] == pytest.approx(2.0 * HALF * 2.5, rel=1e-6)


def test_the_area_curve_of_a_boat_starts_at_her_transom(tmp_path: Path) -> None:
    """By hand: from a keel at 0 up to the chine at 2.6, .7 m, then .3 m out in 1.9 m; V as well."""
    hull = transom_boat(tmp_path)
    course = sectional_area_course(hull, FloatingPosition(1.0, 1.0))
    assert course is not None
    foot = 2.0 * (0.5 * 0.7 * 2.6 + 0.3 * (2.6 + 0.5 * 0.3 * 0.3 / 1.9))
    assert course[1] == pytest.approx(np.array([0.0, foot]), rel=1e-3)
    volume = hull.hydrostatics(on_error="report", estimate=False).volume
    assert np.trapezoid(course[:, 1], course[:, 0]) == pytest.approx(volume, rel=1e-4)
