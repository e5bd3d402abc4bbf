"""Curvature against closed forms and its own invariances."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, SplineBatch
from assoc_hull.geometry.splines.segments import curvature

UP = np.array([0.0, 0.0, 1.0])


def circle(radius: float, count: int, turn: float = np.pi / 2) -> SplineBatch:
    """An arc about the z axis by Hermite segments of exact points and unit tangents."""
    angle = np.linspace(0.0, turn, count)
    xyz = radius * np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
    slope = np.stack([-np.sin(angle), np.cos(angle), 0 * angle], axis=1)
    return SplineBatch(np.array([0, count]), radius * angle, xyz, slope, slope.copy())


def parabola() -> SplineBatch:
    """The curve y = x^2 from x = -1 to 1, parameter x + 1."""
    xyz = np.array([[-1, 1, 0], [1, 1, 0.0]])
    return SplineBatch(
        np.array([0, 2]),
        np.array([0.0, 2.0]),
        xyz,
        np.array([[1, -2, 0]] * 2, float),
        np.array([[1, 2, 0]] * 2, float),
    )


@given(st.floats(-1.0, 1.0))
def test_parabola(x: float) -> None:
    """A parabola is a cubic segment; its curvature is 2 / (1 + 4 x^2)^1.5, to the left."""
    expected = 2.0 / (1.0 + 4.0 * x * x) ** 1.5
    found = curvature(parabola(), UP, ([0], [x + 1.0]))[0]
    assert found == pytest.approx(expected, rel=1e-12)


@given(st.floats(0.1, 100.0), st.floats(0.0, 1.0))
def test_circle(radius: float, part: float) -> None:
    """On a fine polygon of Hermite segments a circle has curvature 1 / radius everywhere."""
    arc = circle(radius, 65)
    at = ([0], [part * arc.knot[-1]])
    assert curvature(arc, UP, at)[0] == pytest.approx(1.0 / radius, rel=1e-4)
    vector = curvature(arc, at=at)[0]
    angle = part * np.pi / 2
    inward = -np.array([np.cos(angle), np.sin(angle), 0.0]) / radius
    assert vector == pytest.approx(inward, rel=1e-3, abs=2e-4 / radius)


def test_the_sign_follows_the_normal() -> None:
    """Seen from the other side the curve turns the other way."""
    arc = circle(2.0, 5)
    at = ([0, 0], [0.3, 1.2])
    assert curvature(arc, -UP, at) == pytest.approx(-curvature(arc, UP, at), rel=1e-14)


def test_one_normal_per_place() -> None:
    """Normals may differ from place to place."""
    found = curvature(circle(2.0, 5), np.array([UP, -UP]), ([0, 0], [1.0, 1.0]))
    assert found[0] == -found[1] > 0.0


@given(st.floats(-1.4, 1.4))
def test_projection(slope: float) -> None:
    """Out of its plane it is the curvature of the shadow: a helix casts a circle."""
    arc = circle(2.0, 33)
    lift = np.array([0.0, 0.0, np.tan(slope)])
    helix = SplineBatch(
        arc.start.copy(),
        arc.knot.copy(),
        arc.xyz + lift * arc.knot[:, None],
        arc.leave + lift,
        arc.arrive + lift,
    )
    at = ([0, 0], [0.4, 2.0])
    assert curvature(helix, UP, at) == pytest.approx(curvature(arc, UP, at), rel=1e-9)


@given(st.lists(st.floats(-5, 5), min_size=9, max_size=9), st.floats(0.0, 1.0))
def test_vector_is_square_to_the_tangent(numbers: list[float], part: float) -> None:
    """The curvature vector has no component along the curve."""
    end, leave, arrive = np.array(numbers).reshape(3, 3) + [[9.0, 0, 0]] * 3
    curve = SplineBatch(
        np.array([0, 2]),
        np.array([0.0, 1.0]),
        np.array([np.zeros(3), end]),
        np.array([leave, leave]),
        np.array([arrive, arrive]),
    )
    u = part
    tangent = (
        end * (6 * u - 6 * u * u) + leave * (1 - 4 * u + 3 * u * u) + arrive * (3 * u * u - 2 * u)
    )
    assume(float(tangent @ tangent) > 1.0)
    vector = curvature(curve, at=([0], [u]))[0]
    assert abs(float(tangent @ vector)) <= 1e-10


def test_default_places_are_the_knots() -> None:
    """Without places there is one value per knot, and the end counts from within."""
    arc = circle(1.0, 4)
    everywhere = curvature(arc, UP)
    assert everywhere.shape == (4,)
    assert everywhere == pytest.approx(everywhere[::-1], rel=1e-12)


def test_a_straight_line_is_straight() -> None:
    """Nil is nil, as vector and as number."""
    along = np.array([[0.6, 0.8, 0]] * 2)
    line = SplineBatch(
        np.array([0, 2]),
        np.array([0.0, 5]),
        np.array([[0, 0, 0], [3, 4, 0.0]]),
        along,
        along.copy(),
    )
    assert np.abs(curvature(line, at=([0], [2.0]))).max() < 1e-15
    assert abs(curvature(line, UP, ([0], [2.0]))[0]) < 1e-15


def test_a_cusp_has_no_curvature() -> None:
    """Where the curve has no direction the result is nan, without a warning."""
    nil = np.zeros((2, 3))
    rest = SplineBatch(
        np.array([0, 2]), np.array([0.0, 1]), np.array([[0, 0, 0], [1, 0, 0.0]]), nil, nil.copy()
    )
    assert np.isnan(curvature(rest, at=([0], [0.0]))).all()
    assert np.isnan(curvature(rest, UP, ([0], [0.0]))).all()


@pytest.mark.parametrize(
    "normal",
    [
        pytest.param(np.array([0.0, 0, 2]), id="not of unit length"),
        pytest.param(np.zeros(3), id="nil"),
        pytest.param(np.array([0.0, 1]), id="two numbers"),
        pytest.param(np.array([np.nan, 0, 1]), id="partly nan"),
        pytest.param(np.zeros((5, 3)), id="wrong count"),
    ],
)
def test_bad_normals_are_refused(normal: FloatArray) -> None:
    """A normal that is no unit vector is an error of the package."""
    with pytest.raises(BadInputError):
        curvature(parabola(), normal, ([0], [1.0]))
