"""The quintic of least squares: published numbers, a solver with multipliers, refusals."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.combined_waterline import Quintic, fit_quintic
from tests.piece_values import PIECES

U, Y = (0.1, 0.25, 0.4, 0.55, 0.7, 0.85), (7.93, 7.58, 6.94, 6.0, 4.7, 2.95)


@pytest.fixture(scope="module")
def fit() -> Quintic:
    """The waterline of the test values."""
    return fit_quintic(U, Y, 8.0, 1.0, 0.0, -14.0)


def test_the_test_values_are_met(fit: Quintic) -> None:
    """All coefficients, the middle and the residual, to the digits of the computed values."""
    wanted = [PIECES[f"Q.a{k}"] for k in range(6)]
    np.testing.assert_allclose(fit.coefficients, wanted, rtol=1e-11, atol=1e-12)
    assert float(fit.at(0.5)) == pytest.approx(PIECES["Q.y05"], rel=1e-12)
    assert fit.rms == pytest.approx(PIECES["Q.rms"], rel=1e-10)
    printed = (-7.55823146, 5.468012298, -9.261330217, 4.351549379)
    np.testing.assert_allclose(fit.coefficients[2:], printed, rtol=5e-10)


def test_the_printed_formula_of_a4_is_wrong(fit: Quintic) -> None:
    """A product T3 T4 in place of the difference T3 - T4 gives 160; corrected, it is the fit."""
    u, y = np.array(U), np.array(Y)
    first = u**2 * (1 - u) ** 2
    second = first * (u + 2)
    base = 8.0 + (3 * -7.0 + 14.0) * u**2 + (-14.0 + 14.0) * u**3
    t1, t2, t3, t4 = (float(first @ each) for each in (first, second, y, base))
    t6, t7, t8 = (float(second @ each) for each in (second, y, base))
    a5 = (t1 * (t7 - t8) - t2 * (t3 - t4)) / (t1 * t6 - t2**2)
    a4 = (t3 - t4 - a5 * t2) / t1
    assert (t3 * t4 - a5 * t2) / t1 == pytest.approx(PIECES["Q.badA4"], rel=1e-10)
    # The basis q (u + 2) leaves a4 u^4 with a4 (first) and a5 u^5 with a5 (second).
    assert a5 == pytest.approx(fit.coefficients[5], rel=1e-9)
    assert a4 == pytest.approx(fit.coefficients[4], rel=1e-9)


def test_ends_and_end_slopes_are_exact_and_the_data_are_not(fit: Quintic) -> None:
    """Whatever the data are; and derivatives are those of the polynomial."""
    np.testing.assert_allclose(fit.at([0.0, 1.0]), [8.0, 1.0], rtol=1e-14)
    np.testing.assert_allclose(fit.at([0.0, 1.0], 1), [0.0, -14.0], atol=1e-13)
    assert 0.005 < float(np.abs(fit.at(U) - np.array(Y)).max()) < 0.05
    assert fit.at(0.5).shape == ()
    assert fit.at([[0.1, 0.2]]).shape == (1, 2)


def _by_multipliers(u: np.ndarray, y: np.ndarray, w: np.ndarray, ends: np.ndarray) -> np.ndarray:
    """All six coefficients from Lagrange's equations, in Chebyshev's basis."""
    basis = np.polynomial.chebyshev.chebvander
    columns = basis(2 * u - 1, 5) * np.sqrt(w)[:, None]
    rows = basis(np.array([-1.0, 1.0]), 5)
    slopes = np.stack([2.0 * k * k * np.array([(-1.0) ** (k + 1), 1.0]) for k in range(6)], axis=1)
    held = np.vstack([rows, slopes])
    system = np.block([[columns.T @ columns, held.T], [held, np.zeros((4, 4))]])
    right = np.concatenate([columns.T @ (np.sqrt(w) * y), ends])
    found: np.ndarray = np.linalg.solve(system, right)[:6]
    return found


def test_it_is_the_constrained_least_squares() -> None:
    """2,000 random sets, weighted: values as by Lagrange's equations, to 1e-10 of the largest."""
    rng = np.random.default_rng(5)
    at = np.linspace(0.0, 1.0, 21)
    worst = 0.0
    for _ in range(2000):
        count = int(rng.integers(6, 16))
        u = (np.arange(count) + rng.uniform(0.1, 0.9, count)) / count
        y, w = rng.uniform(0.0, 10.0, count), rng.uniform(0.5, 2.0, count)
        ends = rng.uniform(-10.0, 10.0, 4)
        mine = fit_quintic(u, y, ends[0], ends[1], ends[2], ends[3], w).at(at)
        peer = np.polynomial.chebyshev.chebval(2 * at - 1, _by_multipliers(u, y, w, ends))
        worst = max(worst, float(np.abs(mine - peer).max() / np.abs(peer).max()))
    assert worst < 1e-10


@pytest.mark.parametrize(
    ("d0", "d1"), [(None, -14.0), (0.0, None), (None, None)], ids=["start", "end", "both"]
)
def test_a_slope_that_is_not_given_is_left_to_the_data(
    d0: float | None, d1: float | None, fit: Quintic
) -> None:
    """A quintic's own data give that quintic back, with either slope left out."""
    u = np.linspace(0.05, 0.95, 9)
    again = fit_quintic(u, fit.at(u), 8.0, 1.0, d0, d1)
    np.testing.assert_allclose(again.coefficients, fit.coefficients, atol=1e-9)


def test_weights_draw_the_curve() -> None:
    """A point of great weight is met; equal weights change nothing."""
    heavy = fit_quintic(U, Y, 8.0, 1.0, 0.0, -14.0, [1, 1, 1, 1e9, 1, 1])
    assert float(heavy.at(0.55)) == pytest.approx(6.0, abs=1e-6)
    plain = fit_quintic(U, Y, 8.0, 1.0, 0.0, -14.0, [3.0] * 6)
    assert float(plain.at(0.5)) == pytest.approx(PIECES["Q.y05"], rel=1e-12)


REFUSED: dict[str, tuple[str, Callable[[], object]]] = {
    "data outside": (
        r"quintic: u=1.2 outside \[0,1\]",
        lambda: fit_quintic([0.2, 1.2], [1, 1], 0, 1, 0, 0),
    ),
    "asked outside": (
        r"quintic: u=-0.1 outside \[0,1\]",
        lambda: fit_quintic(U, Y, 8, 1, 0, 0).at(-0.1),
    ),
    "one place twice": (
        "quintic: needs 2 distinct interior u, got 1",
        lambda: fit_quintic([0.3, 0.3, 1.0], [1, 1, 1], 0, 1, 0, 0),
    ),
    "three for two": (
        "quintic: needs 3 distinct interior u, got 2",
        lambda: fit_quintic([0.3, 0.4], [1, 1], 0, 1, 0, None),
    ),
    "points too near": (
        r"quintic: rank-deficient \(points too close together\)",
        lambda: fit_quintic([0.5, 0.5 + 2e-16], [1, 1], 0, 1, 0, 0),
    ),
    "weight of nil": (
        "quintic: weights must be positive",
        lambda: fit_quintic(U, Y, 8, 1, 0, 0, [1, 1, 0, 1, 1, 1]),
    ),
    "no number": (
        "quintic: non-finite value at index 1",
        lambda: fit_quintic([0.2, np.nan], [1, 1], 0, 1, 0, 0),
    ),
    "other count": (
        r"quintic: expected shape \(2\), got \(3,\)",
        lambda: fit_quintic([0.2, 0.4], [1, 1, 1], 0, 1, 0, 0),
    ),
}


@pytest.mark.parametrize(("message", "call"), REFUSED.values(), ids=REFUSED)
def test_what_makes_no_quintic_is_refused(message: str, call: Callable[[], object]) -> None:
    """With the numbers and what to do."""
    with pytest.raises(GeometryError, match=message):
        call()
