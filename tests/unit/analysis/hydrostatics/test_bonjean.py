"""Bonjean curves: areas of stations and their moments over the draught."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.analysis.hydrostatics.flotation import flotation
from assoc_hull.analysis.hydrostatics.section_areas import bonjean, section_areas
from assoc_hull.errors import WrongTypeError
from assoc_hull.geometry.curves import IsoCurves
from assoc_hull.geometry.floating.immersion import FloatingPlanes
from assoc_hull.geometry.floating.sections import sections_and_moments_below


@pytest.mark.parametrize("name", ["wigley", "series60_70", "bulk_carrier"])
def test_areas_and_moments_never_fall(name: str, shipped: Callable[[str], ah.Hull]) -> None:
    """As the water rises, and the centroid of what comes lies between the two planes."""
    curves = bonjean(shipped(name), 33)
    more, turn = np.diff(curves.stations.area, axis=0), np.diff(curves.moment, axis=0)
    assert (more >= 0.0).all()
    assert np.abs(curves.stations.area[0]).max() == 0.0 == np.abs(curves.moment[0]).max()
    slack = 1e-9 * curves.moment.max()
    assert (turn >= curves.z[:-1, None] * more - slack).all()
    assert (turn <= curves.z[1:, None] * more + slack).all()


def test_moments_of_a_parabola_are_those_of_its_formula() -> None:
    """y = b (2 s - s^2), z = T s is one cubic: closed forms hold to rounding."""
    half, draught = 5.0, 6.25
    cubic = np.zeros((1, 4, 3))
    cubic[0, 1] = [0.0, 2.0 * half, draught]
    cubic[0, 2] = [0.0, -half, 0.0]
    curve = IsoCurves(np.array([0, 1]), cubic, np.zeros((1, 4, 3)), np.array([False]))
    z = np.linspace(0.0, draught, 14)
    area, moment = sections_and_moments_below(curve, FloatingPlanes(z, 0.0 * z, 0.0 * z))
    s = z / draught
    assert area[:, 0] == pytest.approx(2.0 * half * draught * (s**2 - s**3 / 3.0), abs=1e-12)
    exact = 2.0 * half * draught**2 * (2.0 * s**3 / 3.0 - s**4 / 4.0)
    assert moment[:, 0] == pytest.approx(exact, abs=1e-12)


def test_moments_of_a_heeled_rectangle_are_those_of_its_corners() -> None:
    """The water takes a trapezium from a rectangle: a polygon's area and moment."""
    half, height, slope = 10.0, 6.0, np.tan(np.radians(15.0))
    cubic = np.zeros((2, 4, 3))
    cubic[0, 1] = [0.0, half, 0.0]
    cubic[1, 0] = [0.0, half, 0.0]
    cubic[1, 1] = [0.0, 0.0, 12.0]
    curve = IsoCurves(np.array([0, 2]), cubic, np.zeros((2, 4, 3)), np.zeros(2, np.bool_))
    planes = FloatingPlanes(np.array([height]), np.zeros(1), np.array([slope]))
    area, moment = sections_and_moments_below(curve, planes)
    assert area[0, 0] == pytest.approx(2.0 * half * height, rel=1e-14)
    exact = half * height**2 + half**3 * slope**2 / 3.0
    assert moment[0, 0] == pytest.approx(exact, rel=1e-14)


def test_moments_under_heel_are_those_of_slices(series60_70: ah.Hull) -> None:
    """The moment below an inclined plane is the sum of those of slices parallel to it."""
    body = flotation(series60_70.state)
    slope = np.tan(np.radians(12.0))

    def planes(height: np.ndarray) -> FloatingPlanes:
        return FloatingPlanes(height, np.full_like(height, 0.01), np.full_like(height, slope))

    edge = np.linspace(-8.0, 6.0, 1201)
    area, moment = body.stations_and_moments(planes(edge))
    assert area.area[0] == pytest.approx(0.0, abs=1e-12)
    more = np.diff(moment, axis=0)
    # Where the slice is thin, z of its centroid lies within what the section spans at all.
    low, high = body.limits.bottom[:, 2].min(), body.limits.deck[:, 2].max()
    assert (more >= low * np.diff(area.area, axis=0) - 1e-9).all()
    assert (more <= high * np.diff(area.area, axis=0) + 1e-9).all()
    assert (section_areas(body, area.x, planes(edge[-1:])) == area.area[-1:]).all()


def test_heights_that_are_given_are_those_of_the_curves() -> None:
    """As they are, and nothing else: areas are those of so many levels."""
    hull = ah.examples.wigley()
    some, many = hull.bonjean([2.5, 5.0, 7.5]), hull.bonjean(16)
    assert some.z.tolist() == [2.5, 5.0, 7.5]
    assert some.stations.area == pytest.approx(many.stations.area[[4, 8, 12]], abs=1e-12)
    for wrong in ([5.0, 2.5], [], [2.5, 2.5], [-1.0, 2.0], [2.0, 40.0], [np.nan]):
        with pytest.raises(ah.AssocHullError):
            hull.bonjean(wrong)


def test_a_number_that_counts_no_levels_is_told_that_heights_may_be_listed() -> None:
    """A height alone is no count; a range of heights is a list."""
    hull = ah.examples.wigley()
    with pytest.raises(WrongTypeError, match="or their heights in m as a list"):
        hull.bonjean(3.0)
    curves = hull.bonjean(range(1, 5))
    assert curves.z.tolist() == [1.0, 2.0, 3.0, 4.0]
