"""Places on curves, and parts of them beside planes."""

import numpy as np
import pytest

from assoc_hull.geometry.curves import CurveData, FloatArray, PointKind, SplineBatch
from assoc_hull.geometry.integrals.chains import (
    area_along,
    clip_cubics,
    continuous_runs,
    monotone_cubics,
)
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.plane_intersections import (
    coordinate_turns,
    points_at_coordinate,
    points_on_plane,
)
from assoc_hull.geometry.splines.segments import power_coefficients

UP = np.array([0.0, 0.0, 1.0])


def line(*points: tuple[float, float, float]) -> SplineBatch:
    """Straight from point to point."""
    xyz = np.array(points)
    kind = np.full(len(xyz), int(PointKind.KNUCKLE), np.int8)
    return loft(CurveData.single(xyz, kind))


def parabola() -> SplineBatch:
    """z = x (2 - x) for x from 0 to 2, exactly."""
    xyz = np.array([[0.0, 0.0, 0.0], [2.0, 0.0, 0.0]])
    leave, arrive = np.array([[1.0, 0.0, 2.0]] * 2), np.array([[1.0, 0.0, -2.0]] * 2)
    return SplineBatch(np.array([0, 2]), np.array([0.0, 2.0]), xyz, leave, arrive)


def test_ends_on_a_plane_are_places() -> None:
    """Where a curve only begins or ends on the plane, no crossing tells of it."""
    found = points_at_coordinate(line((0, 0, 1), (4, 0, 3)), 2, 1.0)
    assert found.xyz.tolist() == [[0.0, 0.0, 1.0]]
    assert found.along[0, 2] > 0.0


def test_a_corner_on_a_plane_is_one_place() -> None:
    """Also where the curve turns back there, which is no crossing either."""
    found = points_at_coordinate(line((0, 0, 0), (1, 0, 2), (2, 0, 0)), 2, 2.0)
    assert found.xyz.tolist() == [[1.0, 0.0, 2.0]]


def test_a_level_stretch_gives_its_knots() -> None:
    """A keel on the base line is met at its ends."""
    found = points_at_coordinate(line((-1, 0, 1), (0, 0, 0), (5, 0, 0), (6, 0, 2)), 2, 0.0)
    assert found.xyz[:, 0].tolist() == [0.0, 5.0]


def test_an_inclined_plane_is_met() -> None:
    """x + z = 2 on the parabola: x (3 - x) = 2."""
    found = points_on_plane(parabola(), np.array([1.0, 0.0, 1.0]) / np.sqrt(2.0), np.sqrt(2.0))
    assert found.xyz[:, 0] == pytest.approx([1.0, 2.0], abs=1e-12)


def test_a_curve_turns_where_its_derivative_is_nil() -> None:
    """The parabola's top, between its ends."""
    [found] = coordinate_turns(parabola(), 2)
    top = found[int(found[:, 2].argmax())]
    assert top.tolist() == pytest.approx([1.0, 0.0, 1.0], abs=1e-12)
    assert found[[0, -1], 0].tolist() == [0.0, 2.0]


def test_what_is_beside_a_plane_is_kept_exactly() -> None:
    """Below z = 3/4 lie two parts of the parabola, each half a metre long."""
    low = continuous_runs(clip_cubics(power_coefficients(parabola()), UP, 0.75))
    assert [float(np.ptp([part[0, 0, 0], part[-1].sum(axis=0)[0]])) for part in low] == (
        pytest.approx([0.5, 0.5], abs=1e-12)
    )
    assert continuous_runs(clip_cubics(power_coefficients(parabola()), UP, -1.0)) == []


@pytest.mark.parametrize(
    ("exponents", "value"), [((0, 0), 2.0), ((1, 0), 4.0 / 3.0), ((2, 0), 16.0 / 15.0)]
)
def test_areas_and_moments_along_a_curve_are_exact(
    exponents: tuple[int, int], value: float
) -> None:
    """Integrals of z^p dx under the parabola."""
    assert area_along(power_coefficients(parabola()), (2, 0), exponents) == pytest.approx(
        value, rel=1e-14
    )


def test_a_curve_is_parted_where_it_turns() -> None:
    """And nothing of it is lost."""
    parts: FloatArray = monotone_cubics(power_coefficients(parabola()), 2)
    assert len(parts) == 2
    assert parts[1, 0].tolist() == pytest.approx([1.0, 0.0, 1.0], abs=1e-12)
    assert area_along(parts, (2, 0)) == pytest.approx(4.0 / 3.0, rel=1e-14)
