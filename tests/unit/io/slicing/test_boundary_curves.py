"""Borders drawn through marks: not where the marks turn back."""

import numpy as np
import pytest

from assoc_hull.geometry.curves import PointKind
from assoc_hull.io.slicing.boundary_curves import BoundaryMarks, _folds, draw_boundary_curve
from assoc_hull.io.slicing.features import FeatureRules
from assoc_hull.model.kinds import BoundaryKind
from assoc_hull.model.line_source import LineSource

TURNING = np.array([[0.0, 8, 2], [5, 8, 2], [10, 8, 2], [6, 8, 2.5], [12, 8, 3]])


@pytest.mark.parametrize(
    ("knuckles", "folds"), [((), True), ((2,), True), ((2, 3), False)], ids=str
)
def test_a_border_that_turns_back_is_told(knuckles: tuple[int, ...], folds: bool) -> None:
    """It turns at its third point, and forward again at the fourth: both may be knuckles only."""
    kind = [int(PointKind.KNUCKLE if i in knuckles else PointKind.SMOOTH) for i in range(5)]
    assert _folds(LineSource.make("boundary", "flat of side", TURNING, kind=kind)) is folds


def test_a_border_of_marks_in_order_is_led_on_at_both_ends() -> None:
    """By a part of its last step, so that the lines of its first and last mark cross it."""
    x = np.linspace(20.0, 80.0, 13)
    places = np.column_stack([x, np.full(13, 8.0), 3.0 + 0.002 * (x - 50.0) ** 2])
    marks = BoundaryMarks(
        tuple(f"ST {each:g}" for each in x), places, np.full(13, 0.02), (np.eye(3)[1], 8.0)
    )
    source, border = draw_boundary_curve(
        "flat of side", BoundaryKind.FLAT, marks, FeatureRules(), 0.01
    )
    assert not _folds(source)
    assert source.points[:, 1].tolist() == [8.0] * len(source.points)
    assert border.residual < 0.02
    for end, mark in ((0, 0), (-1, -1)):
        beyond = abs(float(source.points[end, 0] - places[mark, 0]))
        assert 0.05 * 5.0 - 1e-9 <= beyond <= 0.25 * 5.0 + 0.05


def test_a_border_is_not_led_on_through_the_centre_plane() -> None:
    """A knuckle that runs into the stem: its last mark lies .11 m off, and the next step is .62."""
    x = np.array([101.0, 103.0, 104.5, 106.0, 107.0, 108.0, 109.0])
    y = np.array([4.306, 3.422, 2.69, 1.895, 1.329, 0.735, 0.111])
    places = np.column_stack([x, y, np.full(7, 8.7)])
    marks = BoundaryMarks(
        tuple(f"ST {each:g}" for each in x), places, np.full(7, 0.005), (np.eye(3)[2], 8.7)
    )
    source, _ = draw_boundary_curve("knuckle 1", BoundaryKind.KNUCKLE, marks, FeatureRules(), 0.01)
    assert source.points[-1, 0] > 109.0
    assert source.points[:, 1].min() > 0.05
