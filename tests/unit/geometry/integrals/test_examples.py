"""What the parts of `geometry.integrals` give, one small example of each."""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import CurveData
from assoc_hull.geometry.integrals.chains import area_along, clip_cubics
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.segments import power_coefficients


def test_parts_of_curves_on_one_side_of_planes() -> None:
    """Parts of curves on one side of planes, and what they enclose."""
    flare = loft(CurveData.single(np.array([[0.0, 0, 0], [0, 4, 8]])))
    # z <= 6
    below = clip_cubics(power_coefficients(flare), np.array([0.0, 0.0, 1.0]), 6.0)
    # y dz
    assert round(area_along(below, (1, 2)), 12) == 9.0
