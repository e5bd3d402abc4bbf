"""Taylor, Benson, Chapman, Weinblum, Lackenby, series, draft functions, smooth tables."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, cast

import numpy as np
import pytest
from numpy.polynomial import chebyshev
from numpy.polynomial.polynomial import polyder, polyint, polyval
from scipy.interpolate import BPoly

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.lackenby_shift import lackenby_shift, one_minus_prismatic
from assoc_hull.geometry.classical.linear_least_squares import (
    bounded_fit,
    held_fit,
    linear_fit,
    orthogonal_fit,
)
from assoc_hull.geometry.classical.polynomial_hulls import (
    DraftFunctions,
    chapman_parabola,
    fit_polynomial_hull,
    fit_series,
    fit_series_hull,
    form_polynomial,
    product_hull,
    series_columns,
    taylor_quintic,
)
from assoc_hull.geometry.classical.smooth_offsets import smooth_offsets, smooth_table
from assoc_hull.shipped.wigley import wigley_half_breadth
from assoc_hull.variation.shifts.lackenby import HalfBody
from tests.piece_values import PIECES

X = np.linspace(-1.0, 1.0, 21)
CURVE = (1.0 - X**2) * (1.0 + 0.2 * X)


def test_taylors_quintic() -> None:
    """The test values; every condition holds for a batch of drawn parameters."""
    wanted = [0.0, 1.8, *(PIECES[f"Ty.{k}"] for k in "abcd")]
    np.testing.assert_allclose(taylor_quintic(1.8, -2.2, 0.7), wanted, rtol=1e-12, atol=1e-12)
    assert float(polyval(0.5, taylor_quintic(1.8, -2.2, 0.7))) == pytest.approx(PIECES["Ty.y5"])
    rng = np.random.default_rng(2)
    t, p, c = rng.uniform(0, 3, (4, 5)), rng.uniform(-4, 0, (4, 5)), rng.uniform(0.4, 0.9, (4, 5))
    found = np.moveaxis(taylor_quintic(t, p, c), -1, 0)
    assert found.shape == (6, 4, 5)
    for value, got in (
        (1.0, polyval(1.0, found)), (0.0, polyval(1.0, polyder(found))),
        (p, polyval(1.0, polyder(found, 2))), (c, polyval(1.0, polyint(found))), (t, found[1]),
    ):  # fmt: skip
        np.testing.assert_allclose(got, np.broadcast_to(value, (4, 5)), atol=1e-11)


def test_form_parameters_make_polynomials() -> None:
    """Taylor's conditions make Taylor's quintic; others are met as they stand."""
    conditions: list[Any] = [("value", 0, 0), ("slope", 0, 1.8), ("value", 1, 1), ("slope", 1, 0)]
    conditions += [("bend", 1, -2.2), ("area", 1, 0.7)]
    found = form_polynomial(range(6), conditions)
    np.testing.assert_allclose(found, taylor_quintic(1.8, -2.2, 0.7), atol=1e-12)
    other = form_polynomial([0, 2, 5], [("value", 0.5, 0.4), ("moment", 1, 0.3), ("area", 1, 0.5)])
    assert np.flatnonzero(other).tolist() == [0, 2, 5]
    assert float(polyval(0.5, other)) == pytest.approx(0.4)
    half = form_polynomial([0, 1], [("area", 0.5, 0.3), ("moment", 0.5, 0.06)])
    assert float(polyval(0.5, polyint(half))) == pytest.approx(0.3)
    assert float(polyval(0.5, polyint(np.append(0.0, half)))) == pytest.approx(0.06)
    assert float(polyval(1.0, polyint(other))) == pytest.approx(0.5)
    assert float(polyval(1.0, polyint(np.append(0.0, other)))) == pytest.approx(0.3)


def test_parabolas_and_products() -> None:
    """Chapman's test value; Wigley's hull is a product of two."""
    assert float(chapman_parabola(0.4)) == pytest.approx(PIECES["Cp.y"], rel=1e-14)
    assert chapman_parabola([0.0, 1.0], 3.5).tolist() == [1.0, 0.0]
    x, z = np.meshgrid(np.linspace(0.0, 100.0, 9), np.linspace(0.0, 6.25, 5))
    mine = 5.0 * product_hull(x / 50.0 - 1.0, 1.0 - z / 6.25, [0, 1], [0, 1])
    np.testing.assert_allclose(mine, wigley_half_breadth(x, z, 100.0, 10.0, 6.25), atol=1e-13)


def test_bezier_curves_are_bpoly() -> None:
    """The test value, by scipy alone."""
    curve = BPoly(np.array([[0, 0], [1, 2], [3, 2], [4, 0]], float)[:, None, :], [0.0, 1.0])
    np.testing.assert_allclose(curve(0.3), [PIECES["Bz.x"], PIECES["Bz.y"]], rtol=1e-14)


def _areas(x: np.ndarray) -> np.ndarray:
    return np.where(x < 0.3, 1.0, 1.0 - (np.maximum(x - 0.3, 0.0) / 0.7) ** 2)


def _half() -> tuple[float, float]:
    """Phi and xb of these areas, by hand."""
    phi = 0.3 + 1.4 / 3.0
    rest = 0.3 * 1.4 / 3.0 + 0.49 / 4.0
    return phi, (0.045 + rest) / phi


def test_lackenbys_shift_meets_its_test_values() -> None:
    """A, both movements at 0.6; phi and p come out exactly, by a rule over moved sections."""
    phi, centre = _half()
    spread = phi * (1 - 2 * centre) - 0.3 * (1 - phi)
    assert spread == pytest.approx(PIECES["Lk.A"], rel=1e-12)
    move = lackenby_shift(0.6, phi, centre, 0.02, 0.3, 0.03)
    assert float(move) == pytest.approx(PIECES["Lk.dx6"], rel=1e-12)
    assert float(one_minus_prismatic(0.6, phi, 0.02)) == pytest.approx(PIECES["Lk.omp6"], rel=1e-12)
    x = np.linspace(0.3, 1.0, 200_001)
    moved = x + lackenby_shift(x, phi, centre, 0.02, 0.3, 0.03)
    assert moved[0] == pytest.approx(0.33, rel=1e-14)
    new = 0.33 + float(np.trapezoid(_areas(x), moved))
    assert new == pytest.approx(PIECES["Lk.phi"], abs=1e-10)


def test_lackenbys_shift_is_that_of_the_hull_shifts() -> None:
    """The formula of `shift_sections`' reports, which was written on its own."""
    phi, centre = _half()
    x = np.linspace(0.3, 1.0, 15)
    peer = HalfBody(phi, centre, 0.0, 0.3)
    mine = lackenby_shift(x, phi, centre, 0.02, 0.3, 0.03)
    np.testing.assert_allclose(mine, peer.lackenby(x, 0.02, 0.03), rtol=1e-13)
    other = one_minus_prismatic(x, phi, 0.02)
    np.testing.assert_allclose(other, peer.one_minus_cp(x, 0.02), rtol=1e-13)


def test_series_in_one_variable() -> None:
    """The test values of degree 3, Legendre and Chebyshev."""
    legendre = fit_series(X, CURVE, 3)
    assert legendre[2] == pytest.approx(PIECES["Lg.c2"], rel=1e-12)
    found = fit_series(X, CURVE, 3, "chebyshev")
    assert found[2] == pytest.approx(PIECES["Ch.c2"], rel=1e-12)
    np.testing.assert_allclose(found, chebyshev.chebfit(X, CURVE, 3), atol=1e-13)
    wide = fit_series(50.0 * (X + 1.0), CURVE, 3, span=(0.0, 100.0))
    np.testing.assert_allclose(wide, legendre, atol=1e-13)


@pytest.mark.parametrize("basis", ["legendre", "chebyshev"])
def test_series_in_two_variables_are_surfaces(basis: Any) -> None:
    """Wigley's hull is a polynomial and comes back whole from scattered offsets."""
    rng = np.random.default_rng(1)
    x, z = rng.uniform(0.0, 100.0, 60), rng.uniform(0.0, 6.25, 60)
    y = wigley_half_breadth(x, z, 100.0, 10.0, 6.25)
    hull = fit_series_hull(x, z, y, (2, 2), (0.0, 100.0), (0.0, 6.25), basis=basis)
    assert hull.rms < 1e-12
    at = np.meshgrid(np.linspace(0.0, 100.0, 5), np.linspace(0.0, 6.25, 4))
    np.testing.assert_allclose(
        hull.at(*at), wigley_half_breadth(*at, 100.0, 10.0, 6.25), atol=1e-11
    )


def test_further_columns_take_what_polynomials_cannot() -> None:
    """A round end: with the root as a column the fit is exact, without it is not."""

    def root(x: np.ndarray, z: np.ndarray) -> np.ndarray:
        return np.asarray(np.sqrt(100.0 - x) * (1.0 + 0.0 * z))

    x, z = (e.ravel() for e in np.meshgrid(np.linspace(0, 100, 11), np.linspace(0, 5, 5)))
    y = 0.5 * np.sqrt(100.0 - x) + 0.02 * z
    spans: tuple[Any, ...] = ((0.0, 100.0), (0.0, 5.0))
    plain = fit_series_hull(x, z, y, (3, 1), *spans)
    rounded = fit_series_hull(x, z, y, (3, 1), *spans, columns=[root])
    assert plain.rms > 1e-2
    assert rounded.rms < 1e-12
    assert rounded.extra[0] == pytest.approx(0.5, rel=1e-10)
    assert float(rounded.at(64.0, 5.0)) == pytest.approx(3.1, rel=1e-10)


def test_orthogonal_columns_need_no_second_fit() -> None:
    """Leaving out the last terms gives the fit of lower degree; all terms give that of lstsq."""
    rows = series_columns(X, 6)
    fit = orthogonal_fit(rows, np.cos(2.0 * X))
    whole = linear_fit(rows, np.cos(2.0 * X)).coefficients
    np.testing.assert_allclose(fit.lower(7), whole, atol=1e-12)
    for terms in (2, 4):
        lower = linear_fit(rows[:, :terms], np.cos(2.0 * X)).coefficients
        np.testing.assert_allclose(fit.lower(terms), lower, atol=1e-12)


def test_edges_of_a_patch_are_held() -> None:
    """As by Lagrange's equations; the edge is exact, data are not."""
    rng = np.random.default_rng(6)
    x, z = rng.uniform(-1, 1, (2, 80))
    rows = chebyshev.chebvander2d(x, z, [3, 3])
    y = np.cos(x) * np.exp(0.3 * z)
    edge = chebyshev.chebvander2d(np.full(4, -1.0), np.linspace(-1, 1, 4), [3, 3])
    wanted = np.array([0.4, 0.5, 0.7, 0.6])
    fit = held_fit(rows, y, edge, wanted)
    np.testing.assert_allclose(edge @ fit.coefficients, wanted, atol=1e-12)
    system = np.block([[rows.T @ rows, edge.T], [edge, np.zeros((4, 4))]])
    peer = np.linalg.solve(system, np.concatenate([rows.T @ y, wanted]))[:16]
    np.testing.assert_allclose(fit.coefficients, peer, atol=1e-9)
    assert fit.rms > 1e-3


def test_bounds_of_coefficients_hold() -> None:
    """Where they bind the bound is met exactly; where they do not, it is the free fit."""
    rows = series_columns(X, 3)
    free = linear_fit(rows, CURVE).coefficients
    np.testing.assert_allclose(bounded_fit(rows, CURVE, -9.0, 9.0).coefficients, free, atol=1e-9)
    bound = bounded_fit(rows, CURVE, [-9, 0, -0.5, -9], 9.0)
    assert bound.coefficients[2] == -0.5
    assert bound.rms > 1e-3


def test_draft_functions_make_a_hull_of_waterlines() -> None:
    """Taylor's quintics whose parameters change with draught; a table of polynomials."""
    z = np.linspace(0.0, 8.0, 5)
    lines = taylor_quintic(1.0 + 0.1 * z, -2.0 - 0.05 * z, 0.6 + 0.02 * z)
    functions = DraftFunctions.make(z, lines)
    np.testing.assert_allclose(functions.at(z), lines, atol=1e-12)
    # Coefficients are linear in the parameters, which are linear in z: so it is exact between.
    np.testing.assert_allclose(functions.at(3.0), taylor_quintic(1.3, -2.15, 0.66), atol=1e-12)
    assert functions.at([[1.0, 2.0]]).shape == (1, 2, 6)
    assert "not the same as fitting a surface" in functions.notes[0]
    x = np.linspace(-1.0, 1.0, 11)
    table = np.outer(z / 8.0, 1.0 - x**4)
    hull = fit_polynomial_hull(x, z, table, 4, 1)
    assert hull.rms.max() < 1e-12
    assert float(hull.at(0.5, 3.3)) == pytest.approx(3.3 / 8.0 * (1 - 0.5**4), rel=1e-10)


def test_sections_of_polynomials_have_coefficients_in_x() -> None:
    """The same with stations as levels: Wigley's sections."""
    stations, heights = np.linspace(0.0, 100.0, 9), np.linspace(0.0, 6.25, 6)
    grid = np.meshgrid(heights, stations)
    table = wigley_half_breadth(grid[1], grid[0], 100.0, 10.0, 6.25)
    hull = fit_polynomial_hull(heights / 6.25, stations, table, 2, 2)
    found = float(hull.at(2.0 / 6.25, 33.0))
    assert found == pytest.approx(
        float(wigley_half_breadth(np.array(33.0), np.array(2.0), 100.0, 10.0, 6.25)), rel=1e-10
    )


def test_third_differences_are_penalised() -> None:
    """The equations of least squares themselves; stiff ones give the parabola of least squares."""
    y = np.sin(np.linspace(0.0, 3.0, 12)) + 0.05 * np.cos(9.0 * np.arange(12))
    third = np.diff(np.eye(12), 3, axis=0)
    w = np.linspace(1.0, 2.0, 12)
    peer = np.linalg.solve(np.diag(w) + 4.0 * third.T @ third, w * y)
    np.testing.assert_allclose(smooth_offsets(y, 4.0, w), peer, atol=1e-12)
    np.testing.assert_allclose(smooth_offsets(y, 0.0), y, atol=1e-15)
    at = np.arange(12.0)
    parabola = np.polyval(np.polyfit(at, y, 2), at)
    np.testing.assert_allclose(smooth_offsets(y, 1e9), parabola, atol=1e-5)
    both = smooth_offsets(np.column_stack([y, 2.0 * y]), 4.0, w)
    np.testing.assert_allclose(both[:, 1], 2.0 * both[:, 0], atol=1e-12)


def test_a_table_is_smoothed_both_ways() -> None:
    """A dent goes down by most of its depth, the rest stays; the last round changes little."""
    x, z = np.linspace(0.0, 100.0, 15), np.linspace(0.0, 6.0, 9)
    true = np.outer(0.3 + 0.05 * z, np.sin(np.pi * (0.1 + 0.8 * x / 100.0)))
    dented = true.copy()
    dented[4, 7] -= 0.02
    found = smooth_table(x, z, dented, 1e-6, tolerance=1e-4)
    assert found.change <= 1e-4
    assert 0.01 < found.moved < 0.02
    assert float(np.abs(found.y - true).max()) < 0.01


def _fit(**other: Any) -> object:
    given: dict[str, Any] = {"x": X, "y": CURVE, "degree": 3, **other}
    return fit_series(**given)


REFUSED: dict[str, tuple[str, Callable[[], object]]] = {
    "sections cross": (
        "Lackenby: sections cross", lambda: lackenby_shift(0.6, *_half(), 0.15, 0.3)
    ),
    "sections cross with the parallel part": (
        "Lackenby: sections cross", lambda: lackenby_shift(0.6, *_half(), 0.0, 0.3, 0.65)
    ),
    "sections cross, one minus prismatic": (
        "Lackenby: sections cross", lambda: one_minus_prismatic(0.6, 0.77, 0.25)
    ),
    "within the parallel part": (
        r"Lackenby: x=0.1 outside \[0.3, 1\]", lambda: lackenby_shift(0.1, *_half(), 0.02, 0.3)
    ),
    "no half body": ("Lackenby: A = -", lambda: lackenby_shift(0.6, 0.7, 0.6, 0.02)),
    "phi": ("Lackenby: phi 1.2", lambda: lackenby_shift(0.6, 1.2, 0.3, 0.02)),
    "parallel part of less than nothing": (
        "Lackenby: parallel part -0.3", lambda: lackenby_shift(0.6, *_half(), 0.0, 0.3, -0.6)
    ),
    "parallel part": ("Lackenby: parallel part 1", lambda: lackenby_shift(1, 0.7, 0.3, 0.02, 1.0)),
    "Taylor of text": (
        "Taylor quintic: expected shape", lambda: taylor_quintic(cast("Any", "a"), 1, 1)
    ),
    "counts": (
        "form polynomial: 2 powers, 1 cond", lambda: form_polynomial([0, 1], [("value", 0, 1)])
    ),
    "half powers": (
        "form polynomial: powers are not whole",
        lambda: form_polynomial(cast("Any", [0.5]), [("value", 1, 1)]),
    ),
    "one condition twice": (
        "form polynomial: the conditions do not make one polynomial",
        lambda: form_polynomial([0, 1], [("value", 0, 1), ("value", 0, 2)]),
    ),
    "unknown condition": (
        "form polynomial: no condition is called 'girth'",
        lambda: form_polynomial([0], [cast("Any", ("girth", 0, 1))]),
    ),
    "condition of two": (
        "form polynomial: condition", lambda: form_polynomial([0], [cast("Any", ("value", 0))])
    ),
    "Chapman outside": (r"Chapman parabola: x=2 outside \[0, 1\]", lambda: chapman_parabola(2.0)),
    "Chapman power": ("Chapman parabola: power 0", lambda: chapman_parabola(0.5, 0.0)),
    "product outside": (r"product hull: x=2 outside", lambda: product_hull(2, 0, [1], [1])),
    "product of shapes": (
        "product hull: shapes", lambda: product_hull([0, 0], [0, 0, 0], [1], [1])
    ),
    "series of few points": (
        r"series: rank-deficient \(points too close together\)", lambda: _fit(degree=30)
    ),
    "series outside": (r"series: x=-1 outside \[0, 1\]", lambda: _fit(span=(0.0, 1.0))),
    "series span": ("series: span from 1 to 0", lambda: _fit(span=(1.0, 0.0))),
    "series degree": ("series: degree -1; give a whole number from 0", lambda: _fit(degree=-1)),
    "series basis": ("series: no basis is called 'sine'", lambda: _fit(basis="sine")),
    "surface shapes": (
        "series: shapes",
        lambda: fit_series_hull(X, X, X, (1, 0), (-1, 1), (-1, 1)).at([0, 0], [0, 0, 0]),
    ),
    "levels that fall": (
        "draft functions: 2 levels that do not all rise",
        lambda: DraftFunctions.make([1, 0], [[1], [2]]),
    ),
    "level outside": (
        r"draft functions: x=3 outside \[0, 1\]",
        lambda: DraftFunctions.make([0, 1], [[1], [2]]).at(3.0),
    ),
    "draft degree": (
        "draft functions: degree 2; give", lambda: DraftFunctions.make([0, 1], [[1], [2]], 2)
    ),
    "waterline degree": (
        "polynomial hull: degree 9", lambda: fit_polynomial_hull([0, 1], [0, 1], np.eye(2), 9)
    ),
    "hull shapes": (
        "polynomial hull: x of shape",
        lambda: fit_polynomial_hull([0, 1], [0, 1], np.eye(2), 1).at([0.0, 1.0], 0.5),
    ),
    "weights": (
        "fit: weights must be positive", lambda: linear_fit(np.ones((2, 1)), [1, 2], [1, -1])
    ),
    "held that contradict": (
        "fit: the equations to be held contradict one another",
        lambda: held_fit(np.eye(2), [1, 2], [[1, 0], [1, 0]], [0, 1]),
    ),
    "bounds": ("fit: bounds 2 to 1 of coefficient 0", lambda: bounded_fit(np.eye(2), [1, 2], 2, 1)),
    "bounds without data": (
        "fit: rank-deficient", lambda: bounded_fit(np.zeros((0, 2)), [], 0, 1)
    ),
    "count of bounds": (
        "fit: bounds of 2 coefficients", lambda: bounded_fit(np.eye(2), [1, 2], [0, 0, 0], 1)
    ),
    "orthogonal": ("fit: rank-deficient", lambda: orthogonal_fit(np.ones((3, 2)), [1, 2, 3])),
    "three offsets": ("offsets: 3 values, stiffness 1", lambda: smooth_offsets([1, 2, 3], 1.0)),
    "stiffness": ("offsets: 4 values, stiffness -1", lambda: smooth_offsets([1, 2, 3, 4], -1.0)),
    "small table": (
        "offsets: 2 places", lambda: smooth_table([0, 1], np.arange(5), np.ones((5, 2)), 1.0)
    ),
    "weight of a table": (
        "offsets: weight -1", lambda: smooth_table(np.arange(5), np.arange(5), np.eye(5), -1.0)
    ),
}  # fmt: skip


@pytest.mark.parametrize(("message", "call"), REFUSED.values(), ids=REFUSED)
def test_what_makes_no_formula_is_refused(message: str, call: Callable[[], object]) -> None:
    """With the numbers and what to do."""
    with pytest.raises(GeometryError, match=message):
        call()
