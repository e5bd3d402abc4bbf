"""Lines digitised by few points: what lies between them is curved, not their chords."""

from __future__ import annotations

import numpy as np
import pytest

from assoc_hull.geometry.curves import CurveData
from assoc_hull.geometry.polylines.smoothing import fit_polyline
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.segments import sample


def _area(points: np.ndarray) -> float:
    """Give the area between a polyline and the corner (0, 10) of its quarter circle."""
    x, y = (np.vstack([points, [0.0, 10.0]])).T
    return 0.5 * abs(float(x @ np.roll(y, -1) - y @ np.roll(x, -1)))


@pytest.mark.parametrize("count", [7, 9, 13])
def test_a_coarse_quarter_circle_keeps_its_area(count: int) -> None:
    """Its area is off by an eighth of what chords lose at most, the line by a third of their sag.

    Beside the ends, beyond which nothing is known, the line is farthest off.
    """
    angle = np.linspace(0.0, 0.5 * np.pi, count)
    points = 10.0 * np.column_stack([np.sin(angle), 1.0 - np.cos(angle)])
    sag = 10.0 * (1.0 - np.cos(0.25 * np.pi / (count - 1)))
    truth = 25.0 * np.pi
    fitted = fit_polyline(points, 1e-3, curved=True)
    assert fitted is not None
    drawn = sample(loft(CurveData.single(_flat(fitted.draw().points))), 8)[1][:, :2]
    off = np.abs(np.hypot(drawn[:, 0], drawn[:, 1] - 10.0) - 10.0)
    assert off.max() < sag / 3.0
    assert abs(_area(drawn) - truth) < 0.125 * abs(_area(points) - truth)


def _flat(points: np.ndarray) -> np.ndarray:
    return np.column_stack([points, np.zeros(len(points))])


def test_a_straight_run_beside_a_bend_stays_straight() -> None:
    """Flat of bottom by few points, bilge by many: the flat does not dip."""
    angle = np.linspace(0.0, 0.5 * np.pi, 13)[1:]
    flat = np.column_stack([np.linspace(0.0, 8.0, 5), np.zeros(5)])
    bilge = np.column_stack([8.0 + 2.0 * np.sin(angle), 2.0 - 2.0 * np.cos(angle)])
    fitted = fit_polyline(np.concatenate([flat, bilge]), 1e-3, curved=True)
    assert fitted is not None
    drawn = fitted.draw().points
    assert np.abs(drawn[drawn[:, 0] < 7.5, 1]).max() < 2e-3


@pytest.mark.parametrize("turned", [False, True], ids=["at the start", "at the end"])
def test_a_flat_given_by_its_ends_stays_straight(turned: bool) -> None:
    """Flat of bottom as one step from the centre line to a bilge of many: it does not dip."""
    angle = np.linspace(0.0, 0.5 * np.pi, 17)
    bilge = np.column_stack([8.0 + 2.0 * np.sin(angle), 2.0 - 2.0 * np.cos(angle)])
    points = np.concatenate([[[0.0, 0.0]], bilge, [[10.0, 8.0]]])
    fitted = fit_polyline(points[::-1] if turned else points, 1e-3, curved=True)
    assert fitted is not None
    drawn = fitted.draw().points
    assert np.abs(drawn[drawn[:, 0] < 7.5, 1]).max() < 2e-3
