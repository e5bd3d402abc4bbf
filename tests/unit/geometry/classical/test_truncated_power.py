"""Truncated powers: the coefficients, and why they are not solved for directly."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from scipy.interpolate import BSpline, CubicSpline

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.truncated_power_spline import (
    TruncatedPower,
    power_columns,
    solve_truncated_powers,
)
from assoc_hull.geometry.curves import FloatArray

X, Y = [0.0, 2.0, 4.0, 7.0, 9.0], [0.0, 1.0, 1.5, 1.2, 0.0]


def test_the_coefficients_are_those_of_the_reference() -> None:
    """Quadratic, jumps of the third derivative and a value, all digits."""
    spline = TruncatedPower.through(X, Y)
    assert (spline.a, spline.b, spline.c) == pytest.approx(
        (0.0, 0.5545058139534885, 0.0), abs=1e-14
    )
    wanted = [-0.013626453488372119, 0.01925872093023269, -0.015370639534883945, 0.03234011627907]
    assert spline.jumps == pytest.approx(wanted, abs=1e-13)
    assert float(spline.at(5.0)) == pytest.approx(1.5738372093023256, abs=1e-13)


def test_the_sum_of_powers_is_the_cubic_spline() -> None:
    """50 drawn sets: the printed sum, summed, is scipy's natural spline to 1e-12."""
    rng = np.random.default_rng(5)
    for _ in range(50):
        n = int(rng.integers(3, 12))
        x = np.concatenate([[3.0], 3.0 + np.cumsum(rng.uniform(0.3, 2.0, n - 1))])
        y = rng.uniform(-1.0, 1.0, n)
        spline, at = TruncatedPower.through(x, y), np.linspace(x[0], x[-1], 101)
        truth = CubicSpline(x, y, bc_type="natural")(at)
        u = at - x[0]
        total = spline.a + spline.b * u + spline.c * u**2
        beyond = np.maximum(at[:, None] - x[None, :-1], 0.0) ** 3
        assert np.abs(total + beyond @ spline.jumps - truth).max() < 1e-10
        assert np.abs(spline.at(at) - truth).max() < 1e-12


def b_spline_system(x: FloatArray) -> FloatArray:
    """The same square system in B-splines, the rows of y'' in units of the spacing."""
    knots = np.concatenate([[x[0]] * 3, x, [x[-1]] * 3])
    values = BSpline.design_matrix(x, knots, 3).toarray()
    basis = BSpline(knots, np.eye(values.shape[1]), 3)
    return np.vstack([values, basis(x[[0, -1]], 2) * (x[1] - x[0]) ** 2])


@pytest.mark.parametrize(
    ("count", "powers", "splines"),
    [
        pytest.param(5, 7501160.331255057, 28.791254387418096, id="5 intervals"),
        pytest.param(10, 5623517.052266665, 32.22093646706913, id="10 intervals"),
        pytest.param(20, 5130172.166734215, 33.31471006257069, id="20 intervals"),
        pytest.param(40, 7651466.80907501, 33.61161251210345, id="40 intervals"),
    ],
)
def test_the_columns_are_nearly_parallel(count: int, powers: float, splines: float) -> None:
    """Condition numbers of both systems on 0 to 100 m, all digits that rounding leaves."""
    x = np.linspace(0.0, 100.0, count + 1)
    assert np.linalg.cond(power_columns(x)) == pytest.approx(powers, rel=1e-9)
    assert np.linalg.cond(b_spline_system(x)) == pytest.approx(splines, rel=1e-12)


def test_more_points_and_a_far_origin_make_it_worse() -> None:
    """With 200 intervals, and between 1000 and 1100 m, where the matrix is singular to rounding."""
    many = np.linalg.cond(power_columns(np.linspace(0.0, 100.0, 201)))
    assert many == pytest.approx(1739856296.3, rel=1e-8)
    far = np.linalg.cond(power_columns(np.linspace(1000.0, 1100.0, 41)))
    assert far == pytest.approx(7.403523241e17, rel=0.02)


@pytest.mark.parametrize(
    ("origin", "least", "most"),
    [
        pytest.param(0.0, 0.0, 1e-13, id="from the first point"),
        pytest.param(1000.0, 1e-11, 1e-9, id="from 1000 m away"),
    ],
)
def test_digits_are_lost_where_x_is_far_from_nil(origin: float, least: float, most: float) -> None:
    """One wave on 100 m: solved directly it errs by 1e-14, or by 1e-10."""
    x = np.linspace(origin, origin + 100.0, 41)
    y = np.sin(2.0 * np.pi * (x - origin) / 100.0)
    away = np.abs(power_columns(x)[:-2] @ solve_truncated_powers(x, y) - y).max()
    assert least <= away < most
    assert np.abs(TruncatedPower.through(x, y).at(x) - y).max() < 1e-15


def test_the_unfairness_is_the_root_of_squared_jumps() -> None:
    """Support forces: 6 sqrt(sum A_j^2) at inner points."""
    y = [0, 1, 1.8, 2.45, 2.85, 3.1, 3.2]
    found = TruncatedPower.through(np.arange(7.0), y).unfairness
    assert found == pytest.approx(0.9759219582728202, abs=1e-12)


REFUSED: dict[str, tuple[Callable[[], object], str]] = {
    "x going back": (
        lambda: TruncatedPower.through([0, 2, 1], [0, 0, 0]),
        "spline: x not strictly increasing at 2",
    ),
    "x twice": (
        lambda: TruncatedPower.through([0, 1, 1], [0, 0, 0]),
        "spline: x not strictly increasing at 2",
    ),
    "two points": (lambda: TruncatedPower.through([0, 1], [0, 0]), "spline: at least 3 points"),
    "other counts": (
        lambda: TruncatedPower.through([0, 1, 2], [0, 0]),
        "spline: expected shape (3), got (2,)",
    ),
    "infinite": (
        lambda: TruncatedPower.through([0, 1, float("inf")], [0, 0, 0]),
        "spline: non-finite value at index 2",
    ),
    "beyond its end": (
        lambda: TruncatedPower.through(X, Y).at([1, 9.5]), "spline: x=9.5 outside [0, 9]"
    ),
}  # fmt: skip


@pytest.mark.parametrize(("call", "message"), REFUSED.values(), ids=REFUSED)
def test_what_has_no_spline_is_refused(call: Callable[[], object], message: str) -> None:
    """One line that names the place and the number."""
    with pytest.raises(GeometryError) as refused:
        call()
    assert str(refused.value).startswith(message)
