"""Areas, moments and station integrals against exact values."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, SplineBatch
from assoc_hull.geometry.integrals.area_moments import line_integral, plane_integrals, section_area
from assoc_hull.geometry.integrals.stations import integrate_by_simpson

COORDINATE = st.floats(-10.0, 10.0)


def bezier(points: FloatArray) -> SplineBatch:
    """One Bezier cubic as a spline of one segment of unit knot span."""
    leave, arrive = 3.0 * (points[1] - points[0]), 3.0 * (points[3] - points[2])
    return SplineBatch(
        np.array([0, 2]),
        np.array([0.0, 1.0]),
        points[[0, 3]],
        np.array([leave, leave]),
        np.array([arrive, arrive]),
    )


def polygon(corners: list[tuple[float, float]], axes: tuple[int, int] = (0, 1)) -> SplineBatch:
    """A polyline as a spline of straight segments."""
    xyz = np.zeros((len(corners), 3))
    xyz[:, list(axes)] = corners
    chord = np.diff(xyz, axis=0)
    length = np.linalg.norm(chord, axis=1)
    unit = chord / length[:, None]
    knot = np.concatenate([[0.0], np.cumsum(length)])
    leave, arrive = np.concatenate([unit, unit[-1:]]), np.concatenate([unit[:1], unit])
    return SplineBatch(np.array([0, len(corners)]), knot, xyz, leave, arrive)


def reference() -> SplineBatch:
    """The cubic whose integrals are known to 12 places."""
    return bezier(np.array([[0, 0, 0], [1, 2, 0], [3, 2.5, 0], [4, 0, 0.0]]))


@pytest.mark.parametrize(
    ("exponents", "factor", "expected"),
    [
        pytest.param((0, 1), 1.0, 4.725, id="area"),
        pytest.param((0, 2), 1 / 2, 3.259821428571, id="moment about x"),
        pytest.param((1, 1), 1.0, 9.657142857143, id="moment about y"),
        pytest.param((0, 3), 1 / 3, 3.185430194805, id="second moment about x"),
        pytest.param((2, 1), 1.0, 23.736201298701, id="second moment about y"),
        pytest.param((1, 2), 1 / 2, 6.728936688312, id="mixed moment"),
    ],
)
def test_reference_cubic(exponents: tuple[int, int], factor: float, expected: float) -> None:
    """The integrals of the reference cubic are right in every printed digit."""
    found = factor * line_integral(reference(), exponents)[0]
    assert found == pytest.approx(expected, rel=1e-12, abs=5e-13)


def test_reference_cubic_closed() -> None:
    """Closed along the x axis, clockwise, the region has the same moments with the sign of area."""
    found = plane_integrals(reference(), close=True)
    values = [found.area, found.moment_v, found.moment_u]
    values += [found.second_vv, found.second_uu, found.second_uv]
    expected = [4.725, 3.259821428571, 9.657142857143, 3.185430194805, 23.736201298701]
    expected += [6.728936688312]
    assert [-float(value[0]) for value in values] == pytest.approx(expected, rel=1e-12, abs=5e-13)


@given(arrays(np.float64, (4, 3), elements=COORDINATE), st.integers(0, 3), st.integers(0, 3))
def test_total_differentials(points: FloatArray, p: int, q: int) -> None:
    """d(u^(p+1) v^(q+1)) integrates to the difference of its ends, at any degree."""
    curve = bezier(points)
    by_first = (p + 1) * line_integral(curve, (p, q + 1), along=0)[0]
    by_second = (q + 1) * line_integral(curve, (p + 1, q), along=1)[0]
    ends = points[[0, 3], 0] ** (p + 1) * points[[0, 3], 1] ** (q + 1)
    scale = (1.0 + 3 * np.abs(points).max()) ** (p + q + 2)
    assert by_first + by_second == pytest.approx(ends[1] - ends[0], abs=1e-12 * scale)


@pytest.mark.parametrize("axes", [(0, 1), (1, 2), (2, 0)])
def test_rectangle(axes: tuple[int, int]) -> None:
    """A rectangle of 4 by 2 with its corner at (1, 3) has the moments of the textbook."""
    corners = [(1.0, 3.0), (5, 3), (5, 5), (1, 5)]
    found = plane_integrals(polygon(corners, axes), axes, close=True)
    assert found.area[0] == pytest.approx(8.0, rel=1e-14)
    assert found.centroid[0] == pytest.approx([3.0, 4.0], rel=1e-14)
    assert found.second_uu[0] == pytest.approx(2 * (5**3 - 1) / 3, rel=1e-14)
    assert found.second_vv[0] == pytest.approx(4 * (5**3 - 3**3) / 3, rel=1e-14)
    assert found.second_uv[0] == pytest.approx(8 * 12.0, rel=1e-14)


def test_pieces_of_a_loop_add_up() -> None:
    """Open pieces sweep sectors from the origin, so a loop is the sum of its pieces."""
    whole = plane_integrals(polygon([(1, 3), (5, 3), (5, 5), (1, 5), (1, 3)]))
    pieces = SplineBatch.join(
        [polygon([(1, 3), (5, 3), (5, 5)]), polygon([(5, 5), (1, 5), (1, 3)])]
    )
    parts = plane_integrals(pieces)
    assert parts.area.sum() == pytest.approx(whole.area[0], rel=1e-13)
    assert parts.second_uv.sum() == pytest.approx(whole.second_uv[0], rel=1e-13)


def test_no_area_no_centroid() -> None:
    """The centroid of nothing is nan, without a warning."""
    assert np.isnan(plane_integrals(polygon([(0, 0), (1, 1)]), close=True).centroid).all()


@pytest.mark.parametrize(
    ("level", "expected"),
    [
        pytest.param(-1.0, 0.0, id="dry"),
        pytest.param(0.0, 0.0, id="touching the keel"),
        pytest.param(1.0, 3.5, id="in the bilge"),
        pytest.param(3.0, 11.5, id="wall side"),
        pytest.param(5.0, 19.5, id="at the deck"),
        pytest.param(9.0, 19.5, id="above the deck"),
    ],
)
def test_section_of_straight_lines(level: float, expected: float) -> None:
    """Flat of bottom to y = 3, a bilge to (4, 1), a wall side to z = 5: in either direction."""
    corners = [(0.0, 0.0), (3, 0), (4, 1), (4, 5)]
    both = [polygon(corners, (1, 2)), polygon(corners[::-1], (1, 2))]
    assert section_area(SplineBatch.join(both), level) == pytest.approx([expected] * 2, rel=1e-13)


@pytest.mark.parametrize(
    ("level", "expected"),
    [
        pytest.param(1.0, 1.0, id="the skeg alone"),
        pytest.param(2.0, 2.0, id="at the top of the tunnel"),
        pytest.param(3.0, 2.0 + 4.0, id="above the tunnel"),
    ],
)
def test_section_that_goes_down_and_up(level: float, expected: float) -> None:
    """A twin skeg: tunnel top at z = 2, skeg between y = 3 and y = 4 down to z = 0."""
    corners = [(0.0, 2.0), (3, 2), (3, 0), (4, 0), (4, 4)]
    assert section_area(polygon(corners, (1, 2)), level)[0] == pytest.approx(expected, rel=1e-13)


@given(st.floats(-0.5, 1.5))
def test_section_of_one_cubic(level: float) -> None:
    """Cut anywhere, a section z = y^3 of unit size has 3/4 level^(4/3) below the level."""
    curve = bezier(np.array([[0, 0, 0], [0, 1 / 3, 0], [0, 2 / 3, 0], [0, 1, 1.0]]))
    expected = 0.75 * min(max(level, 0.0), 1.0) ** (4 / 3)
    assert section_area(curve, level)[0] == pytest.approx(expected, rel=1e-12, abs=1e-15)


def test_section_that_waves() -> None:
    """A section that crosses the level three times counts every part below it."""
    wave = bezier(np.array([[0, 1, 0], [0, 1, 4], [0, 1, -3], [0, 1, 1.0]]))
    # With y = 1 the integral of dz is the sum of the rises of the parts below the level.
    assert section_area(wave, 0.5)[0] == pytest.approx(0.5, rel=1e-12)


def test_one_level_per_section() -> None:
    """A trimmed plane has another level at every section."""
    two = SplineBatch.join([polygon([(2, 0), (2, 4)], (1, 2))] * 2)
    assert section_area(two, np.array([1.0, 3.0])) == pytest.approx([2.0, 6.0], rel=1e-14)


@pytest.mark.parametrize(
    ("x", "values"),
    [
        pytest.param([0.0], [1.0], id="one station"),
        pytest.param([0.0, 2.0, 1.0], [1.0, 1, 1], id="not ascending"),
        pytest.param([0.0, 1.0, 1.0], [1.0, 1, 1], id="repeated"),
        pytest.param([0.0, 1.0], [1.0, 1, 1], id="counts differ"),
        pytest.param([0.0, 1.0], [1.0, np.nan], id="not finite"),
        pytest.param([0.0, 1.0], 3.0, id="no rows"),
    ],
)
def test_bad_stations_are_refused(x: list[float], values: list[float]) -> None:
    """Stations that cannot be integrated over are an error of the package."""
    with pytest.raises(BadInputError):
        integrate_by_simpson(x, values)


def test_bad_axes_levels_and_exponents_are_refused() -> None:
    """Wrong arguments are errors of the package, not of numpy."""
    curve = reference()
    with pytest.raises(BadInputError):
        plane_integrals(curve, (1, 1))
    with pytest.raises(BadInputError):
        line_integral(curve, (0, 1), (0, 3))
    with pytest.raises(BadInputError):
        line_integral(curve, (-1, 1))
    with pytest.raises(BadInputError):
        line_integral(curve, (0, 1), along=2)
    with pytest.raises(BadInputError):
        section_area(curve, np.array([1.0, 2.0]))
    with pytest.raises(BadInputError):
        section_area(curve, np.nan)
