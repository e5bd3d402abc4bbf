"""Circles in true lengths."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.circular_arcs import (
    circle_by_tangent,
    circle_through,
    fitted_circle,
    tangent_curvature,
)

SCATTERED = [(0, 0), (1, 0.95), (2, 1.35), (3, 1.05), (4, 0.1)]


def test_three_points_give_the_circle_of_the_reference() -> None:
    """Centre and signed curvature, all digits; turned round, the sign changes."""
    circle = circle_through((0, 0), (4, 3), (10, 4))
    assert circle.centre == pytest.approx((8.857142857142858, -7.642857142857143), abs=1e-12)
    assert circle.curvature == pytest.approx(-0.0854787515221729, abs=1e-14)
    back = circle_through((10, 4), (4, 3), (0, 0))
    assert back.curvature == pytest.approx(-circle.curvature, abs=1e-15)


def test_a_point_with_its_tangent_and_another_give_the_arc_of_the_reference() -> None:
    """Its curvature, all digits; the circle passes both and is tangent."""
    assert tangent_curvature((0, 0), (1, 0), (4, 1)) == pytest.approx(
        0.11764705882352941, abs=1e-15
    )
    circle = circle_by_tangent((0, 0), (3, 0), (4, 1))
    assert circle.centre == pytest.approx((0.0, 8.5))
    assert np.hypot(*(circle.centre - [4, 1])) == pytest.approx(circle.radius)


def test_the_least_squares_circle_is_that_of_the_reference() -> None:
    """Centre and radius, all digits."""
    circle = fitted_circle(SCATTERED)
    assert circle.centre == pytest.approx((2.038742748618785, -0.924758287292818), abs=1e-11)
    assert circle.radius == pytest.approx(2.213672362151041, abs=1e-11)
    assert circle.curvature < 0.0


def test_polishing_brings_the_points_closer() -> None:
    """Distances of points from the polished circle are least; both meet an exact arc."""
    rough, best = fitted_circle(SCATTERED), fitted_circle(SCATTERED, polish=True)
    assert best.residual < rough.residual
    turn = np.linspace(0.0, 0.5, 9)
    exact = np.column_stack([5.0 * np.cos(turn) + 100.0, 5.0 * np.sin(turn)])
    for polish in (False, True):
        assert fitted_circle(exact, polish=polish).curvature == pytest.approx(0.2, rel=1e-9)


REFUSED: dict[str, tuple[Callable[[], object], str]] = {
    "three on a line": (
        lambda: circle_through((0, 0), (1, 1), (3, 3)), "circle: points are collinear"
    ),
    "one point twice": (
        lambda: circle_through((0, 0), (1, 1), (1, 1)), "circle: points are collinear"
    ),
    "straight ahead": (
        lambda: circle_by_tangent((0, 0), (1, 1), (3, 3)), "circle: points are collinear"
    ),
    "fitted to a line": (
        lambda: fitted_circle([(0, 0), (1, 1), (2, 2), (5, 5)]), "circle: points are collinear"
    ),
    "fitted to two": (lambda: fitted_circle([(0, 0), (1, 1)]), "circle: at least 3 points"),
    "no direction": (
        lambda: tangent_curvature((0, 0), (0, 0), (1, 1)), "circle: no direction, or one point"
    ),
    "not finite": (
        lambda: circle_through((0, 0), (1, float("inf")), (1, 1)),
        "circle: non-finite value at index 1",
    ),
}  # fmt: skip


@pytest.mark.parametrize(("call", "message"), REFUSED.values(), ids=REFUSED)
def test_what_is_no_circle_is_refused(call: Callable[[], object], message: str) -> None:
    """One line that says what is wrong."""
    with pytest.raises(GeometryError) as refused:
        call()
    assert str(refused.value).startswith(message)
