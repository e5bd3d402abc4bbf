"""Floating positions: what they mean, and which cannot be."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from assoc_hull.analysis.hydrostatics.floating_body import (
    FloatingPosition,
    WaterplaneLimits,
    planes_of,
    require_afloat,
    rising_numbers,
)
from assoc_hull.errors import BadInputError, OutOfRangeError
from tests.floating_bodies import Box


def test_a_plane_holds_the_draughts_at_the_perpendiculars_and_lowers_starboard() -> None:
    """At x = 0, x = Lpp, and to starboard, where y is below 0, of a ship that heels to it."""
    planes = planes_of([FloatingPosition(6.0, 5.0, 10.0)], 80.0)
    assert planes.height[0] == 6.0
    assert_allclose(planes.height + 80.0 * planes.tan_trim, 5.0)
    assert -planes.tan_heel[0] * -3.0 > 0.0


@pytest.mark.parametrize("values", [(np.nan, 5.0), (5.0, np.inf), (5.0, "deep"), (5.0, True)])
def test_a_draught_that_is_no_number_is_refused(values: tuple[float, float]) -> None:
    """The error names it."""
    with pytest.raises(BadInputError, match="draught_"):
        FloatingPosition(*values)


@pytest.mark.parametrize("heel", [90.0, -90.0, 120.0])
def test_a_heel_of_a_right_angle_is_refused(heel: float) -> None:
    """No such plane has a height at the centre line; the range is told."""
    with pytest.raises(OutOfRangeError, match="heel of") as caught:
        FloatingPosition(5.0, 5.0, heel)
    assert caught.value.value == heel
    assert caught.value.most < 90.0


@pytest.mark.parametrize(
    ("aft", "fore", "heel", "closed", "why", "least", "most"),
    [
        (-1.0, -1.0, 0.0, True, "below the keel", 0.0, 12.0),
        (0.0, 0.0, 0.0, True, "below the keel", 0.0, 12.0),
        (12.5, 12.5, 0.0, True, "above the deck", 0.0, 12.0),
        (12.5, 12.5, 0.0, False, "drowns the open deck", 0.0, 12.0),
        (12.1, 11.1, 0.0, False, "drowns the open deck", -0.5, 11.5),
        (20.0, 20.0, 20.0, True, "above the deck", -3.6397023427, 15.6397023427),
        (9.0, 9.0, 20.0, False, "drowns the open deck", -3.6397023427, 8.3602976573),
        (-4.0, -4.0, 20.0, True, "below the keel", -3.6397023427, 15.6397023427),
    ],
)
def test_a_plane_that_misses_the_ship_is_refused_with_the_range(
    aft: float, fore: float, heel: float, closed: bool, why: str, least: float, most: float
) -> None:
    """The range is that of mean draughts at this trim and heel: from first to last touch."""
    limits = Box(closed=closed).limits
    with pytest.raises(OutOfRangeError, match=why) as caught:
        require_afloat([FloatingPosition(aft, fore, heel)], limits, 100.0)
    assert_allclose([caught.value.least, caught.value.most], [least, most], atol=1e-9)
    assert caught.value.value == 0.5 * (aft + fore)


def test_an_open_deck_that_is_drowned_at_any_draught_is_refused() -> None:
    """There is no range to tell, so the remedy is another."""
    edge = np.array([[0.0, 5.0, 8.0], [100.0, 5.0, 8.0]])
    limits = WaterplaneLimits(edge * [1, 0, 0.0], edge, closed=False)
    with pytest.raises(BadInputError, match="less trim or heel"):
        require_afloat([FloatingPosition(4.0, 4.0, 60.0)], limits, 100.0)


@pytest.mark.parametrize(
    ("values", "words"),
    [([], "empty"), ([4, 3], "3 stands after 4"), ([4, 4], "4 stands after 4"),
     ([4, np.nan], "finite")],
)  # fmt: skip
def test_draughts_of_a_table_rise(values: list[float], words: str) -> None:
    """None, unsorted, double and odd ones are refused by name."""
    with pytest.raises(BadInputError, match=words):
        rising_numbers(values, "draughts", "in a table")
