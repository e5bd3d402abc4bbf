"""Waterlines of bodies that are known by formulas."""

import numpy as np
import pytest
from numpy.polynomial import Polynomial

from assoc_hull.geometry.curves import Strips
from assoc_hull.geometry.floating.immersed_strips import prepare_strips
from assoc_hull.geometry.floating.immersion import FloatingPlanes
from assoc_hull.geometry.floating.raked_strips import strip_spans
from assoc_hull.geometry.floating.waterlines import (
    OuterLine,
    WaterlineArcs,
    outer_line,
    waterline_arcs,
)
from tests.exact_hulls import FormStrips, box, ellipsoid, wigley


def arcs(strips: Strips, height: float, trim: float = 0.0) -> WaterlineArcs:
    """The waterline at a height, upright."""
    plane = FloatingPlanes(np.array([height]), np.array([trim]), np.zeros(1))
    return waterline_arcs(strip_spans(prepare_strips(strips)), plane)


def bow_of(strips: Strips, height: float, trim: float = 0.0) -> OuterLine:
    """Its main piece, forward of the greatest breadth."""
    found = outer_line(arcs(strips, height, trim), forward=True)
    assert found is not None
    return found


def test_the_bow_of_wigleys_hull_has_the_angle_and_bluntness_of_its_parabola() -> None:
    """atan(2 B/L) at the stem; 1 - ln(1 + k^2) / k^2 of B/2 with k = 2 B/L; to rounding."""
    line, k = bow_of(wigley(), 6.25), 0.2
    assert line.end == pytest.approx((100.0, 0.0), abs=1e-12)
    assert line.angle[-1, -1] == pytest.approx(np.arctan(k), rel=1e-12)
    assert line.bluntness() == pytest.approx(5.0 * (1.0 - np.log1p(k * k) / (k * k)), rel=1e-12)


def test_the_bow_of_an_ellipse_has_the_bluntness_of_its_formula() -> None:
    """(1 + 1/e) atan(sqrt e) / sqrt e - 1/e of b, e = (a^2 - b^2) / b^2; it meets y = 0 across."""
    line, e = bow_of(ellipsoid(points=160), 6.0), (50.0**2 - 8.0**2) / 8.0**2
    wanted = 8.0 * ((1.0 + 1.0 / e) * np.arctan(np.sqrt(e)) / np.sqrt(e) - 1.0 / e)
    assert line.bluntness() == pytest.approx(wanted, rel=1e-8)
    assert line.angle[-1, -1] == pytest.approx(0.5 * np.pi, abs=1e-6)


def test_the_angle_of_entrance_of_an_ellipse_is_where_it_turns_half_as_fast() -> None:
    """By lengths of 0.16 m along the formula; with no nose so small it ends at 90 deg."""
    line, a, b = bow_of(ellipsoid(points=160), 6.0), 50.0, 8.0
    t = np.linspace(0.0, 0.5, 400_001)  # x = a cos t
    along = np.append(0.0, np.cumsum(np.hypot(np.diff(a * np.cos(t)), np.diff(b * np.sin(t)))))
    angle = np.arctan2(b * np.cos(t), a * np.sin(t))
    behind = np.interp(along + 0.16, along, angle)
    turn = angle - behind
    half = int((turn <= 0.5 * turn[0]).argmax())
    assert line.entrance(1.6, 0.16) == pytest.approx(behind[half], rel=1e-3)
    assert line.entrance(1.2, 0.16) == pytest.approx(0.5 * np.pi, abs=1e-6)


@pytest.mark.parametrize("degrees", [12.0, 35.0, 60.0])
def test_behind_a_round_stem_the_angle_is_that_of_the_tangent(degrees: float) -> None:
    """A straight side that runs into a circle of 0.3 m about the centre line."""
    angle, radius = np.radians(degrees), 0.3
    t = 0.5 - 0.5 * np.cos(np.linspace(0.0, np.pi, 8))
    turn = angle + (0.5 * np.pi - angle) * t
    bow = radius * np.stack([np.sin(turn), np.cos(turn)], axis=1)
    way = np.array([np.cos(angle), -np.sin(angle)])
    side = bow[0] + (t[:, None] - 1.0) * 5.0 * way
    ahead = np.stack([np.cos(turn), -np.sin(turn)], axis=1)
    both = WaterlineArcs(
        np.stack([side, bow]),
        np.stack([np.tile(5.0 * way, (8, 1)), radius * (0.5 * np.pi - angle) * ahead]),
        np.full(8, 0.125),
    )
    line = outer_line(both, forward=True)
    assert line is not None
    assert line.entrance(1.0, 0.1) == pytest.approx(angle, rel=1e-9)


def test_a_flat_face_is_as_blunt_as_can_be() -> None:
    """A box: the line runs along its side and ends at a corner."""
    line = bow_of(box(), 6.0)
    assert line.end == pytest.approx((100.0, 10.0), abs=1e-12)
    assert line.bluntness() == pytest.approx(10.0, rel=1e-12)


def test_the_stern_of_wigleys_hull_mirrors_its_bow() -> None:
    """The line that runs aft has the same bluntness and ends at AP."""
    line = outer_line(arcs(wigley(), 4.0), forward=False)
    assert line is not None
    assert line.end == pytest.approx((0.0, 0.0), abs=1e-12)
    assert line.bluntness() == pytest.approx(bow_of(wigley(), 4.0).bluntness(), rel=1e-12)


@pytest.mark.parametrize("trim", [-0.01, 0.0, 0.008])
def test_arcs_enclose_the_waterplane(trim: float) -> None:
    """Of raked strips, at a trim too: as the integration has it, to 1e-8."""
    body = FormStrips(
        breadth=Polynomial([5.2, 0.0, 6.0, -6.0]), keel=Polynomial([1.0, -1.5, 1.2]),
        height=Polynomial([8.0, 1.0]), rake=Polynomial([-6.0, 8.0, 5.0]),
    )  # fmt: skip
    found = arcs(body, 5.0, trim)
    fine = arcs(in_strips(body, 40), 5.0, trim)
    area, finer = (
        float(((each.point[..., 1] * each.slope[..., 0]) @ each.weight).sum())
        for each in (found, fine)
    )
    assert area == pytest.approx(finer, rel=1e-10)


def in_strips(body: FormStrips, strips: int) -> FormStrips:
    """The same body in more strips."""
    parts = body.breadth, body.keel, body.height, body.rake
    return FormStrips(*parts, strips=strips)


def test_where_the_water_does_not_reach_there_is_no_line() -> None:
    """Below the keel."""
    assert outer_line(arcs(wigley(), -1.0), forward=True) is None
    assert arcs(wigley(), -1.0).count == 0


def test_a_line_that_begins_inside_a_strip_ends_there() -> None:
    """The ellipsoid just afloat: an ellipse that reaches the centre plane between curves."""
    height = 1.0
    k = np.sqrt(1.0 - ((6.0 - height) / 6.0) ** 2)
    found = arcs(ellipsoid(), height)
    line = outer_line(found, forward=True)
    assert line is not None
    assert line.end == pytest.approx((50.0 + 50.0 * k, 0.0), abs=1e-4)
    area = 2.0 * float(((found.point[..., 1] * found.slope[..., 0]) @ found.weight).sum())
    assert area == pytest.approx(np.pi * 50.0 * 8.0 * k * k, rel=1e-8)


def test_pieces_of_a_waterline_are_told_apart() -> None:
    """An island ahead of the ship, such as the top of a bulb, is no part of its bow."""
    ship, t = arcs(box(), 6.0), np.linspace(0.0, 1.0, 8)
    island = np.stack([110.0 + 4.0 * t, 4.0 * t * (1.0 - t)], axis=1)[None]
    slope = np.stack([4.0 + 0.0 * t, 4.0 - 8.0 * t], axis=1)[None]
    points, slopes = np.concatenate([ship.point, island]), np.concatenate([ship.slope, slope])
    both = WaterlineArcs(points, slopes, ship.weight.copy())
    line = outer_line(both, forward=True)
    assert line is not None
    assert line.end == pytest.approx((100.0, 10.0), abs=1e-12)
