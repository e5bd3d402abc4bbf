"""Gaps of thinned curves that need another point."""

import numpy as np

from assoc_hull.edit.adoption.match_crossings import LineIntersection
from assoc_hull.edit.adoption.thinned_deviations import wide_gaps
from assoc_hull.geometry.curves import CurveData, SplineBatch
from assoc_hull.geometry.splines.loft import loft


def _lines(lift: float, drop: float) -> tuple[SplineBatch, SplineBatch, list[LineIntersection]]:
    """A line along x and one along y that meet at (5, 5, 0), and both off along z."""
    x = np.array([[0.0, 5, 0], [5, 5, 0], [10, 5, 0]])
    y = x[:, [1, 0, 2]]
    up = np.array([0.0, 0.0, 1.0])

    def both(a: float, b: float) -> SplineBatch:
        return SplineBatch.join([loft(CurveData.single(line)) for line in (x + a * up, y + b * up)])

    spot = x[1].copy()
    meeting = LineIntersection(0, 1, (5.0, 5.0), (90.0, 90.0), (spot, spot), 0.0, 1)
    return both(0.0, 0.0), both(lift, drop), [meeting]


def test_the_curve_farther_off_its_own_line_comes_first() -> None:
    """3 mm up and 2 mm down make a gap of 5 mm; the first curve is to be mended."""
    assert wide_gaps(*_lines(3e-3, -2e-3), 4e-3) == [(0, 5.0), (1, 5.0)]
    assert wide_gaps(*_lines(2e-3, -3e-3), 4e-3) == [(1, 5.0), (0, 5.0)]


def test_curves_off_to_the_same_side_make_no_gap() -> None:
    """3 mm up both: they still meet."""
    assert wide_gaps(*_lines(3e-3, 3e-3), 1e-3) == []


def test_gaps_up_to_the_limit_are_left() -> None:
    """5 mm where 5.1 mm are allowed, and no meetings at all."""
    assert wide_gaps(*_lines(3e-3, -2e-3), 5.1e-3) == []
    reference, trial, _ = _lines(1.0, 0.0)
    assert wide_gaps(reference, trial, [], 1e-3) == []
