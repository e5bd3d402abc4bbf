"""Polynomials of two parameters in Bernstein form."""

import math
from collections.abc import Callable

import numpy as np
import pytest

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches import bernstein_polynomials as algebra

U, V = np.random.default_rng(0).uniform(size=(2, 30))
U[:2], V[:2] = (0.0, 1.0), (1.0, 0.0)


def value(a: FloatArray, u: FloatArray = U, v: FloatArray = V) -> FloatArray:
    """Values (..., points) by the formula itself."""
    m, n = algebra.degrees(a)
    rows = [math.comb(m, i) * u**i * (1 - u) ** (m - i) for i in range(m + 1)]
    columns = [math.comb(n, j) * v**j * (1 - v) ** (n - j) for j in range(n + 1)]
    found: FloatArray = np.einsum("...ij,ip,jp->...p", a, np.array(rows), np.array(columns))
    return found


def some(seed: int, *shape: int) -> FloatArray:
    """Random coefficients."""
    return np.random.default_rng(seed).normal(size=shape)


A, B, LONG = some(1, 5, 4, 6), some(2, 5, 7, 3), some(3, 5, 3, 2, 3)
SINGLE, SCALAR, OTHER = some(4, 2, 2), some(5, 5, 1, 4, 4), some(6, 5, 3, 3, 3)


@pytest.mark.parametrize(
    ("found", "truth"),
    [
        pytest.param(algebra.multiply(A, B), value(A) * value(B), id="product"),
        pytest.param(algebra.add_polynomials(A, B), value(A) + value(B), id="sum"),
        pytest.param(algebra.subtract(A, B), value(A) - value(B), id="difference"),
        pytest.param(algebra.elevated(A, 9, 7), value(A), id="higher degrees"),
        pytest.param(algebra.multiply(SINGLE, A), value(SINGLE) * value(A), id="one by many"),
        pytest.param(
            algebra.multiply(LONG, SCALAR), value(LONG) * value(SCALAR), id="vector by scalar"
        ),
        pytest.param(
            algebra.dot_polynomials(LONG, LONG),
            (value(LONG) ** 2).sum(axis=-2),
            id="scalar product",
        ),
        pytest.param(
            algebra.cross_polynomials(LONG, OTHER),
            np.cross(value(LONG), value(OTHER), axis=-2),
            id="vector product",
        ),
    ],
)
def test_operations_hold_everywhere(found: FloatArray, truth: FloatArray) -> None:
    """At points, the result has the value that the operation on values has."""
    assert np.abs(value(found) - truth).max() <= 5e-14


def test_degrees_of_results() -> None:
    """A product has the sum of the degrees, a sum the greater, a derivative one less."""
    assert algebra.degrees(algebra.multiply(A, B)) == (9, 7)
    assert algebra.degrees(algebra.add_polynomials(A, B)) == (6, 5)
    assert algebra.degrees(algebra.u_derivative(A)) == (2, 5)
    assert algebra.degrees(algebra.v_derivative(A)) == (3, 4)
    assert not algebra.u_derivative(some(1, 1, 4)).any()


def test_derivatives() -> None:
    """They are the limits of differences, here of a polynomial of degree 2 without any error."""
    a, h = some(7, 3, 3), 0.25
    u, v = U * 0.5 + h, V * 0.5 + h
    du = (value(a, u + h, v) - value(a, u - h, v)) / (2 * h)
    dv = (value(a, u, v + h) - value(a, u, v - h)) / (2 * h)
    assert np.abs(value(algebra.u_derivative(a), u, v) - du).max() <= 1e-14
    assert np.abs(value(algebra.v_derivative(a), u, v) - dv).max() <= 1e-14


@pytest.mark.parametrize(("axis", "degree"), [(-2, 14), (-1, 20), (-1, 1)])
def test_degrees_come_down_as_they_went_up(axis: int, degree: int) -> None:
    """Lowering undoes elevation to 1e-14, at high degrees too."""
    a = some(8, 6, degree, 3) if axis == -2 else some(8, 6, 3, degree)
    m, n = algebra.degrees(a)
    up = algebra.elevated(a, m + (axis == -2), n + (axis == -1))
    assert np.abs(algebra.lowered(up, axis) - a).max() <= 1e-14


def test_integral() -> None:
    """Over the unit square, as Gauss quadrature gives it."""
    x, w = np.polynomial.legendre.leggauss(6)
    u, v = (each.ravel() for each in np.meshgrid((x + 1) / 2, (x + 1) / 2))
    truth = value(A, u, v) @ np.outer(w, w).ravel() / 4
    assert np.abs(algebra.integral(A) - truth).max() <= 1e-15


ALONE: dict[str, Callable[[FloatArray], FloatArray]] = {
    "product": lambda a: algebra.multiply(a, a[:, :3]),
    "sum": lambda a: algebra.add_polynomials(a, a[:, :3]),
    "after a product": lambda a: algebra.elevated(algebra.multiply(a, a), 15, 16),
    "integral": algebra.integral,
    "lower": lambda a: algebra.lowered(a, -1),
}


@pytest.mark.parametrize("rule", ALONE.values(), ids=ALONE.keys())
def test_a_polynomial_does_not_depend_on_its_batch(
    rule: Callable[[FloatArray], FloatArray],
) -> None:
    """Bits are the same alone and among others."""
    many = some(9, 67, 6, 7)
    together = rule(many)
    for row in (0, 5, 66):
        assert together[row].tobytes() == rule(many[row : row + 1])[0].tobytes()
