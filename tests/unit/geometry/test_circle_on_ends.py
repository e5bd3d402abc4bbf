"""Circles through two ends that have moved: exact where one has the tangents of before."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from assoc_hull.geometry.polylines.circular_arcs import circle_on_ends

NORMAL = np.array([1.0, 0.0, 0.0])


def on_circle(radius: float, *angles: float) -> np.typing.NDArray[np.float64]:
    """Places of a circle about the origin in the plane x = 0."""
    return np.array([(0.0, radius * np.cos(a), radius * np.sin(a)) for a in angles])


@given(
    radius=st.floats(0.5, 5.0), scale=st.floats(0.5, 2.0), turn=st.floats(0.2, 3.0),
    begin=st.floats(-3.0, 3.0), side=st.sampled_from([1, -1]),
)  # fmt: skip
def test_scaled_ends_give_the_scaled_circle(
    radius: float, scale: float, turn: float, begin: float, side: int
) -> None:
    """And its tangents are not turned."""
    ends = on_circle(radius, begin, begin + side * turn)
    found = circle_on_ends(np.zeros(3), NORMAL, scale * ends, ends, side=side)
    assert found is not None
    assert found.radius == pytest.approx(scale * radius, rel=1e-9)
    assert np.abs(found.centre).max() < 1e-9 * radius
    assert found.turned < 1e-12


@given(off=st.floats(-0.05, 0.05))
def test_other_ends_turn_both_tangents_alike(off: float) -> None:
    """The circle passes through both ends all the same."""
    ends = on_circle(2.0, 0.0, 1.5)
    moved = ends + np.array([[0.0, off, 0.0], [0.0, 0.0, 0.0]])
    found = circle_on_ends(np.zeros(3), NORMAL, moved, ends, side=1)
    assert found is not None
    away = np.sqrt(((moved - found.centre) ** 2).sum(axis=1))
    assert away == pytest.approx([found.radius, found.radius], rel=1e-12)
    assert found.turned <= abs(off)


def test_ends_that_have_fallen_together_have_no_circle() -> None:
    """None is told, not a division by nothing."""
    ends = on_circle(2.0, 0.0, 1.5)
    assert circle_on_ends(np.zeros(3), NORMAL, ends[[0, 0]], ends, side=1) is None
