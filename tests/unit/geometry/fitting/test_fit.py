"""Surfaces fitted to points: equations, penalty, what is held, parameters."""

from typing import Any

import numpy as np
import pytest
from scipy.interpolate import BSpline

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.fitting.basis import basis_rows, clamped_knots
from assoc_hull.geometry.fitting.fit_input import HeldControls, Samples
from assoc_hull.geometry.fitting.fit_surface import (
    SurfaceFit,
    bending,
    even_breaks,
    fit_surface,
    solve_controls,
    solve_once,
)
from assoc_hull.geometry.fitting.foot_points import derivatives, distances, foot_points
from assoc_hull.geometry.patches.spline_surface import SplineSurface

UNEVEN = np.array([0.0, 0.4, 1.0, 1.0, 2.5, 3.0, 4.0])
SHORT = np.array([0.0, 0.7, 1.5, 2.0])


def a_surface(
    breaks_u: FloatArray = UNEVEN, breaks_v: FloatArray = SHORT, bulge: float = 0.2
) -> SplineSurface:
    """A smooth surface over its parameters, with control points moved about a little."""
    knots = clamped_knots(breaks_u), clamped_knots(breaks_v)
    own = [np.mean([each[i : i + len(each) - 4] for i in (1, 2, 3)], axis=0) for each in knots]
    u, v = np.meshgrid(*own, indexing="ij")
    moved = np.random.default_rng(2).normal(0.0, 0.02, (*u.shape, 3))
    net = np.stack([u, v + 0.1 * u, bulge * (u - 2.0) ** 2 + 0.3 * v**2], axis=-1) + moved
    return SplineSurface("given", (3, 3), *knots, net)


def some_places(surface: SplineSurface, count: int, seed: int = 0) -> FloatArray:
    """Parameters all over the domain."""
    (u0, u1), (v0, v1) = surface.domain
    share = np.random.default_rng(seed).random((count, 2))
    return np.asarray([u0, v0] + share * [u1 - u0, v1 - v0], np.float64)


def samples_of(surface: SplineSurface, count: int = 1500, **more: Any) -> Samples:
    """Points of a surface, with weights that differ."""
    uv = some_places(surface, count)
    weight = 0.5 + np.random.default_rng(9).random(count)
    return Samples.of(uv, surface.at(*uv.T), weight, **more)


def full_rows(knots: FloatArray, at: FloatArray) -> FloatArray:
    """All B-splines at parameters, from another library."""
    return np.array(BSpline.design_matrix(at, knots, 3).toarray(), np.float64)


def plate_energy(knots_u: FloatArray, knots_v: FloatArray) -> FloatArray:
    """The matrix of the penalty by quadrature of many points, from another library, dense."""
    node, size = np.polynomial.legendre.leggauss(6)
    grams = []
    for knots in (knots_u, knots_v):
        ends = np.unique(knots)
        half, middle = 0.5 * np.diff(ends), 0.5 * (ends[1:] + ends[:-1])
        at, weight = (middle[:, None] + half[:, None] * node).ravel(), np.outer(half, size).ravel()
        one = BSpline(knots, np.eye(len(knots) - 4), 3)
        grams.append([(one(at, d) * weight[:, None]).T @ one(at, d) for d in range(3)])
    (u0, u1, u2), (v0, v1, v2) = grams
    return np.asarray(np.kron(u2, v0) + 2.0 * np.kron(u1, v1) + np.kron(u0, v2))


@pytest.mark.parametrize("order", [0, 1, 2])
def test_rows_are_those_of_another_library(order: int) -> None:
    """Values and derivatives of the four splines agree with scipy's, repeated knots among them."""
    knots = clamped_knots(UNEVEN)
    at = np.concatenate([UNEVEN, np.linspace(0.0, 4.0, 57)])
    first, rows = basis_rows(knots, at, order)
    found = np.zeros((len(at), len(knots) - 4))
    np.put_along_axis(found, first[:, None] + np.arange(4), rows[order], axis=1)
    expected = BSpline(knots, np.eye(len(knots) - 4), 3)(at, order)
    assert found == pytest.approx(expected, abs=1e-11)


@pytest.mark.parametrize(
    "turned", [pytest.param(False, id="longer in u"), pytest.param(True, id="longer in v")]
)
@pytest.mark.parametrize(
    "hold", [pytest.param(False, id="free"), pytest.param(True, id="some coordinates held")]
)
def test_controls_solve_the_dense_equations(turned: bool, hold: bool) -> None:
    """The banded equations are those of dense least squares with the penalty by quadrature."""
    surface = a_surface(*((SHORT, UNEVEN) if turned else (UNEVEN, SHORT)))
    samples, smoothing = samples_of(surface, 300), 0.3
    knots, shape = (surface.knots_u, surface.knots_v), surface.net.shape[:2]
    held = HeldControls.none(shape)
    if hold:
        held = held.on("v0", 0.25, axes=(1,)).on("u1", surface.net[-2] + 0.1, depth=1)
    found = solve_controls(samples, *knots, smoothing, held)
    along, across = (full_rows(k, t) for k, t in zip(knots, samples.uv.T, strict=True))
    rows = (along[:, :, None] * across[:, None, :]).reshape(len(samples), -1)
    matrix = (rows * samples.weight[:, None]).T @ rows + smoothing * plate_energy(*knots)
    right = (rows * samples.weight[:, None]).T @ samples.point
    for axis in range(3):
        given, value = held.mask[..., axis].ravel(), held.value[..., axis].ravel()
        expected = np.where(given, value, 0.0)
        rest = (right[:, axis] - matrix @ expected)[~given]
        expected[~given] = np.linalg.solve(matrix[np.ix_(~given, ~given)], rest)
        assert found[..., axis].ravel() == pytest.approx(expected, abs=1e-9)
        assert (found[..., axis].ravel()[given] == value[given]).all()


def test_the_surface_that_points_come_from_is_found_again() -> None:
    """With its knots and hardly any penalty, control points return to 1e-10 m."""
    surface = a_surface()
    found = solve_once("again", samples_of(surface), (UNEVEN, SHORT), 1e-15)
    assert np.abs(found.surface.net - surface.net).max() < 1e-10


def test_the_penalty_is_the_bending_of_a_formula() -> None:
    """x^3 + x^2 y^2 on [0, 4] x [0, 2] bends as its integral by hand says."""
    knots = clamped_knots(even_breaks(0.0, 4.0, 5)), clamped_knots(even_breaks(0.0, 2.0, 2))
    uv = some_places(SplineSurface("", (3, 3), *knots, np.zeros((8, 5, 3))), 400)
    x, y = uv.T
    values = np.column_stack([x**3 + x**2 * y**2, x, y])
    net = solve_controls(Samples.of(uv, values), *knots, 0.0)[..., 0]
    stencil, bent = bending(*knots), 0.0
    for a in range(4):
        for b in range(-3, 4):
            rows, columns = range(net.shape[0] - a), range(max(0, -b), net.shape[1] - max(0, b))
            own = np.ix_(rows, columns)
            other = np.ix_([i + a for i in rows], [j + b for j in columns])
            twice = 2.0 if a else 1.0
            bent += twice * float((stencil[a, b + 3][own] * net[own] * net[other]).sum())
    # The square of 6 x + 2 y^2, twice that of 4 x y, that of 2 x^2.
    expected = 36 * 64 / 3 * 2 + 24 * 8 * 8 / 3 + 4 * 4 * 32 / 5
    expected += 2 * 16 * 64 / 3 * 8 / 3 + 4 * 1024 / 5 * 2
    assert bent == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("smoothing", [1e-6, 1.0, 1e4])
def test_a_plane_is_exact_at_any_penalty(smoothing: float) -> None:
    """A plane with affine parameters does not bend, so that no penalty moves it."""
    uv = some_places(a_surface(), 400)
    plane = uv @ np.array([[1.0, 0.2, 0.1], [0.0, 0.9, -0.3]]) + [5.0, 1.0, 2.0]
    found = fit_surface("plane", Samples.of(uv, plane), UNEVEN, SHORT, smoothing)
    assert found.residual.max() < 1e-9


def test_what_is_held_is_met_to_the_bit_after_all_rounds() -> None:
    """A border row and the one behind it, and y = 0 along another side, stay as given."""
    surface = a_surface()
    held = HeldControls.none((9, 6)).on("u0", surface.net[0] / 3.0)
    held = held.on("u0", surface.net[1] / 3.0, depth=1).on("v0", 0.0, axes=(1,))
    net = fit_surface("held", samples_of(surface), UNEVEN, SHORT, 1e-4, held=held).surface.net
    assert (net[:2] == surface.net[:2] / 3.0).all()
    assert (net[2:, 0, 1] == 0.0).all()
    assert np.abs(net[2:, 0, 0]).min() > 0.1


@pytest.fixture(scope="module")
def wrong_start() -> tuple[SurfaceFit, SplineSurface, Samples]:
    """A surface found from points whose parameters are wrong by up to 0.1 m, held on one border."""
    surface = a_surface(even_breaks(0.0, 4.0, 6), even_breaks(0.0, 2.0, 3))
    uv = some_places(surface, 2500)
    uv[:100, 0] = 0.0
    held = np.zeros((2500, 2), np.bool_)
    held[:100, 0] = True
    wrong = uv + np.random.default_rng(1).uniform(-0.1, 0.1, uv.shape) * ~held
    start = Samples.of(np.clip(wrong, [0, 0], [4, 2]), surface.at(*uv.T), held=held)
    breaks = even_breaks(0.0, 4.0, 6), even_breaks(0.0, 2.0, 3)
    return fit_surface("found", start, *breaks, 1e-7, rounds=6), surface, start


def test_wrong_parameters_are_corrected(
    wrong_start: tuple[SurfaceFit, SplineSurface, Samples],
) -> None:
    """Foot points bring 95 % of the residuals below 2 mm; held and outermost ones stay inside."""
    found, _, start = wrong_start
    before = solve_once(
        "before", start, (even_breaks(0.0, 4.0, 6), even_breaks(0.0, 2.0, 3)), 1e-7, steps=0
    )
    assert np.percentile(before.residual, 95) > 0.05
    assert np.percentile(found.residual, 95) < 2e-3
    uv = found.samples.uv
    assert (uv[:100, 0] == 0.0).all()
    assert uv.min() >= 0.0
    assert (uv.max(axis=0) <= [4.0, 2.0]).all()
    assert found.samples.point is start.point


def test_residuals_are_distances_of_the_foot_points(
    wrong_start: tuple[SurfaceFit, SplineSurface, Samples],
) -> None:
    """A residual is the distance of a point from the surface at its parameters."""
    found = wrong_start[0]
    away = np.linalg.norm(found.surface.at(*found.samples.uv.T) - found.samples.point, axis=1)
    assert away == pytest.approx(found.residual, abs=1e-14)


def test_the_same_points_give_the_same_bits() -> None:
    """A fit is a function of its points: nothing in it depends on order in memory."""
    surface = a_surface()
    once, twice = (fit_surface("a", samples_of(surface), UNEVEN, SHORT, 1e-4) for _ in range(2))
    assert once.surface.net.tobytes() == twice.surface.net.tobytes()
    assert once.samples.uv.tobytes() == twice.samples.uv.tobytes()


def test_foot_points_are_where_the_miss_is_normal() -> None:
    """From near starts, points off the surface get the foot of the normal and its length."""
    surface = a_surface(even_breaks(0.0, 4.0, 4), even_breaks(0.0, 2.0, 2))
    uv = 0.3 + 0.8 * some_places(surface, 200) * [0.8, 0.6]
    point, along, across = derivatives(surface, uv)
    normal = np.cross(along, across)
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    off = point + 0.02 * normal
    found, away = foot_points(surface, off, uv + 0.03, steps=6)
    assert found == pytest.approx(uv, abs=1e-8)
    assert away == pytest.approx(np.full(200, 0.02), abs=1e-12)
    assert distances(surface, off, uv + 0.03) == pytest.approx(away, abs=1e-12)


def test_the_first_rounds_are_stiffer_and_the_last_is_not() -> None:
    """Two rounds: a solution with 30 times the penalty, and one of the corrected parameters."""
    surface = a_surface()
    samples, breaks = samples_of(surface, 400), (UNEVEN, SHORT)
    first = solve_once("fit", samples, breaks, 30 * 0.01)
    found = fit_surface("fit", samples, *breaks, 0.01, rounds=2)
    assert (
        found.surface.net.tobytes()
        == solve_once("fit", first.samples, breaks, 0.01).surface.net.tobytes()
    )


def test_a_step_of_foot_points_is_no_longer_than_a_part_of_the_domain() -> None:
    """From a start far away parameters move by 1/40 of the domain a step, no more."""
    surface = a_surface(even_breaks(0.0, 4.0, 4), even_breaks(0.0, 2.0, 2))
    start = np.array([[1.0, 0.5]])
    found, _ = foot_points(surface, surface.at([2.5], [1.5]), start, steps=1)
    assert np.abs(found - start) == pytest.approx(np.array([[0.1, 0.05]]))


def test_derivatives_are_those_of_differences() -> None:
    """S_u and S_v agree with differences of points of the surface."""
    surface, step = a_surface(), 1e-6
    uv = some_places(surface, 100) * 0.9 + 0.05
    point, *slopes = derivatives(surface, uv)
    assert point == pytest.approx(surface.at(*uv.T), abs=1e-13)
    for axis, slope in enumerate(slopes):
        move = np.eye(2)[axis] * step
        ahead, back = surface.at(*(uv + move).T), surface.at(*(uv - move).T)
        assert slope == pytest.approx((ahead - back) / (2.0 * step), abs=1e-7)


@pytest.mark.parametrize(
    ("breaks", "smoothing", "uv", "fault"),
    [
        pytest.param([0.0, 0.0, 1.0], 1.0, 0.5, "a span of breaks_u is 0 m", id="end repeated"),
        pytest.param([0.0, 2.0, 1.0], 1.0, 0.5, "a span of breaks_u is -1 m", id="falling"),
        pytest.param([0.0], 1.0, 0.5, "breaks_u is of shape", id="one place"),
        pytest.param([0.0, 1.0], -1.0, 0.5, "smoothing is -1", id="penalty below nil"),
        pytest.param([0.0, 1.0], 1.0, 1.5, "u of a point is 1.5", id="point beyond the ends"),
        pytest.param([0.0, 1.0], 1.0, np.nan, "u of a point is nan", id="no parameter"),
        pytest.param([0.0, 1.0], 0.0, 0.5, "do not determine", id="nothing to hold it"),
    ],
)
def test_a_fit_that_cannot_be_is_refused(
    breaks: list[float], smoothing: float, uv: float, fault: str
) -> None:
    """Each fault is named; no error of numpy comes through."""
    samples = Samples.of(np.full((5, 2), uv), np.zeros((5, 3)))
    with pytest.raises(BadInputError, match=fault):
        fit_surface("bad", samples, np.array(breaks), np.array([0.0, 2.0]), smoothing)
