"""Chebyshev and sine series of functions: printed references, closed forms, and their laws."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.polynomial import chebyshev as powers
from numpy.testing import assert_allclose

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.integrals.series import (
    chebyshev_of_function,
    composite_rule,
    evaluate_series,
    piece_edges,
    rule_on_pieces,
    series_function,
    sine_of_function,
    truncation,
)

COEFFICIENTS = arrays(np.float64, st.integers(1, 9), elements=st.floats(-10.0, 10.0))
BREAKS = st.lists(st.floats(-1.0, 1.0), max_size=4)
PRINTED = 6e-11  # half a unit of the tenth decimal, and some rounding


def parabola(xi: FloatArray) -> FloatArray:
    """A waterline of the Wigley hull."""
    return 1.0 - xi**2


def ship(xi: FloatArray) -> FloatArray:
    """A run, a parallel body from -0.2 to 0.3, and an entrance."""
    run = 1.0 - ((xi + 0.2) / 0.8) ** 2
    entrance = 1.0 - ((xi - 0.3) / 0.7) ** 2
    return np.where(xi < -0.2, run, np.where(xi > 0.3, entrance, 1.0))


def polynomial(c: FloatArray) -> Callable[[FloatArray], FloatArray]:
    """The sum of c_k T_k, by the recurrence of another library."""
    return lambda xi: np.asarray(powers.chebval(xi, c), np.float64)


SHIP_C = [0.5719973783, 0.0203516183, -0.5225251706, -0.0170827289, -0.0650055330, -0.0061602011,
          0.0212125375]  # fmt: skip
SHIP_B = [1.1321403451, -0.0266906611, 0.1315498687, -0.0128345167, 0.0024675933, 0.0023406880]


def test_the_parabola_has_its_closed_form() -> None:
    """c = (1/2, 0, -1/2, 0, ...); b_k = 32 / (pi k)^3 for odd k, else nil."""
    assert_allclose(chebyshev_of_function(parabola, 5), [0.5, 0, -0.5, 0, 0], atol=1e-14)
    k = np.arange(1, 8)
    assert_allclose(
        sine_of_function(parabola, 7), np.where(k % 2, 32.0 / (np.pi * k) ** 3, 0.0), atol=1e-14
    )
    assert sine_of_function(parabola, 3)[[0, 2]] == pytest.approx(
        [1.0320491019, 0.0382240408], abs=PRINTED
    )


def test_a_curve_of_three_pieces_to_its_printed_digits() -> None:
    """The piecewise curve of the reference: c_0 to c_6 and b_1 to b_6."""
    assert_allclose(chebyshev_of_function(ship, 7, [-0.2, 0.3]), SHIP_C, rtol=0.0, atol=PRINTED)
    assert_allclose(sine_of_function(ship, 6, [0.3, -0.2]), SHIP_B, rtol=0.0, atol=PRINTED)


def test_gauss_chebyshev_nodes_agree_where_there_are_no_breaks() -> None:
    """The classical rule of 256 nodes gives the same of a smooth function."""
    theta = (np.arange(256) + 0.5) * np.pi / 256
    k = np.arange(20)
    smooth = np.exp(np.cos(theta)) * np.sin(3.0 * np.cos(theta))
    classical = (2.0 - (k == 0)) / 256 * (np.cos(np.outer(k, theta)) * smooth).sum(axis=1)
    found = chebyshev_of_function(lambda xi: np.exp(xi) * np.sin(3.0 * xi), 20)
    assert_allclose(found, classical, atol=1e-13)


def test_a_jump_has_its_closed_form() -> None:
    """A step at nil: c_k = 2 / (pi k) (-1)^((k - 1) / 2) for odd k, c_0 = 1/2."""
    k = np.arange(1, 60)
    wanted = np.where(k % 2, 2.0 / (np.pi * k) * (-1.0) ** ((k - 1) // 2), 0.0)
    found = chebyshev_of_function(lambda xi: np.where(xi > 0.0, 1.0, 0.0), 60, [0.0])
    assert_allclose(found, [0.5, *wanted], atol=1e-13)


def test_a_break_that_was_not_given_is_told() -> None:
    """The coefficients of a step do not stand still: that is said, with what to do."""
    with pytest.raises(BadInputError, match=r"still change by .* as breaks"):
        chebyshev_of_function(lambda xi: np.where(xi > 0.123456, 1.0, 0.0), 8)


@given(COEFFICIENTS, BREAKS)
def test_a_polynomial_reproduces_its_coefficients(c: FloatArray, breaks: list[float]) -> None:
    """Each T_k is itself, wherever the rule is cut into pieces."""
    found = chebyshev_of_function(polynomial(c), len(c) + 2, breaks)
    assert_allclose(found, [*c, 0.0, 0.0], atol=1e-11)


@given(COEFFICIENTS)
def test_a_sum_of_sines_reproduces_its_coefficients(b: FloatArray) -> None:
    """The functions are orthonormal on -1 to 1: the series gives back what it was made of."""
    found = sine_of_function(lambda xi: evaluate_series("sine", b, xi), len(b) + 2)
    assert_allclose(found, [*b, 0.0, 0.0], atol=1e-11)


@given(COEFFICIENTS)
def test_squares_add_up(c: FloatArray) -> None:
    """Parseval: the integral of y^2 / sqrt(1 - xi^2) is pi (c_0^2 + 1/2 sum c_k^2)."""
    theta = (np.arange(64) + 0.5) * np.pi / 64
    integral = np.pi / 64 * (powers.chebval(np.cos(theta), c) ** 2).sum()
    found = chebyshev_of_function(polynomial(c), len(c))
    assert np.pi * (found[0] ** 2 + 0.5 * (found[1:] ** 2).sum()) == pytest.approx(integral)


def test_squares_of_sines_close_in_on_the_mean_square() -> None:
    """Parseval for b: what the first terms lack is the square of what they leave of the curve."""
    b = sine_of_function(ship, 40, [-0.2, 0.3])
    xi, weights = rule_on_pieces(piece_edges([-0.2, 0.3]), *composite_rule(8))
    rest = truncation("sine", b, xi, ship(xi), weights)
    whole = (weights * ship(xi) ** 2).sum()
    assert_allclose(whole - np.cumsum(b**2), 2.0 * rest.rms**2, atol=1e-13)
    assert (np.diff(rest.rms) <= 1e-15).all()


@given(COEFFICIENTS, COEFFICIENTS, st.floats(-3.0, 3.0))
def test_both_series_are_linear(a: FloatArray, b: FloatArray, factor: float) -> None:
    """Of y + f z they are those of y plus f times those of z; several curves go at once."""
    for make in (chebyshev_of_function, sine_of_function):
        both = make(lambda xi: np.stack([polynomial(a)(xi), polynomial(b)(xi)]), 6, (0.1,))
        mixed = make(lambda xi: polynomial(a)(xi) + factor * polynomial(b)(xi), 6, (0.1,))
        assert_allclose(mixed, both[0] + factor * both[1], atol=1e-10)
        assert_allclose(both[0], make(polynomial(a), 6, (0.1,)), atol=1e-11)


@given(COEFFICIENTS)
def test_a_mirrored_curve_changes_the_sign_of_every_other_term(c: FloatArray) -> None:
    """y(-xi): odd Chebyshev and even sine coefficients change their sign."""
    k = np.arange(7)
    for make, sign in ((chebyshev_of_function, (-1.0) ** k), (sine_of_function, (-1.0) ** k)):
        there = make(polynomial(c), 7)
        back = make(lambda xi: polynomial(c)(-xi), 7)
        assert_allclose(back, sign * there, atol=1e-11)


def test_the_series_comes_back_to_the_curve() -> None:
    """Evaluated with many terms it is the curve, by what `truncation` says is left."""
    c = chebyshev_of_function(ship, 200, [-0.2, 0.3])
    xi, weights = rule_on_pieces(piece_edges([-0.2, 0.3]), *composite_rule(8))
    rest = truncation("chebyshev", c, xi, ship(xi), weights)
    off = np.abs(evaluate_series("chebyshev", c, xi) - ship(xi))
    assert rest.largest[-1] == pytest.approx(off.max(), rel=1e-9)
    assert rest.rms[-1] == pytest.approx(np.sqrt(0.5 * (weights * off**2).sum()), rel=1e-9)
    assert rest.largest[-1] < 1e-4 < rest.largest[20]
    assert not rest.rms.flags.writeable


def test_functions_of_the_series_are_those_of_the_books() -> None:
    """T_3 = 4 xi^3 - 3 xi; the first sine is half a wave, nil at both ends."""
    xi = np.linspace(-1.0, 1.0, 11)
    assert_allclose(series_function("chebyshev", 3, xi), 4.0 * xi**3 - 3.0 * xi, atol=1e-14)
    assert_allclose(series_function("sine", 0, xi), np.cos(0.5 * np.pi * xi), atol=1e-14)


@pytest.mark.parametrize(
    ("terms", "breaks", "tolerance"),
    [(0, (), 1e-9), (501, (), 1e-9), (2.5, (), 1e-9), (4, (1.5,), 1e-9), (4, (np.nan,), 1e-9),
     (4, (), 0.0)],
)  # fmt: skip
def test_what_cannot_be_used_is_refused(terms: int, breaks: object, tolerance: float) -> None:
    """Numbers of terms, breaks outside the range, a tolerance of nil."""
    for make in (chebyshev_of_function, sine_of_function):
        with pytest.raises(BadInputError):
            make(parabola, terms, breaks, tolerance)  # type: ignore[arg-type]


def test_values_that_are_no_values_are_refused() -> None:
    """One number for all places, or one that is not finite."""
    with pytest.raises(BadInputError, match="give a function of an array"):
        chebyshev_of_function(lambda xi: np.ones(1), 3)
    with pytest.raises(BadInputError, match="not finite"):
        sine_of_function(lambda xi: xi * np.nan, 3)
    with pytest.raises(BadInputError, match="outside"):
        evaluate_series("sine", np.ones(3), [1.1])
