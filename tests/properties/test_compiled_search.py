"""The compiled search for the least of polynomials finds what numpy finds, to the bit."""

from __future__ import annotations

from unittest import mock

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.certificate.minor_search import LeastMinor, Minor, find_least_minor
from tests.long_forms import draws

pytest.importorskip("numba")

IS_QUICK = "assoc_hull.variation.certificate.minor_search.is_compiled"


def polynomial(shape: tuple[int, ...], seed: int, *, flat: bool) -> Minor:
    """Random numbers as coefficients of powers, on two boxes beside one another."""
    spread = np.random.default_rng(seed)
    powers = np.array(list(np.ndindex(*(n + 1 for n in shape))))
    factors = spread.normal(size=len(powers)) * (0.0 if flat else 1.0)
    factors[0] = 0.3

    def at(parameters: FloatArray) -> FloatArray:
        return np.asarray((factors * (parameters[:, None, :] ** powers).prod(axis=2)).sum(axis=1))

    lower = np.zeros((2, len(shape)))
    lower[1, 0] = 0.5
    upper = np.ones((2, len(shape)))
    upper[0, 0] = 0.5
    return Minor("m", lower, upper, shape, at, lambda parameters: np.resize(parameters, (1, 3)))


def both(minor: Minor, enough: float) -> tuple[LeastMinor, LeastMinor]:
    """By compiled code, and by numpy."""
    found = []
    for quick in (True, False):
        with mock.patch(IS_QUICK, return_value=quick):
            found.append(find_least_minor(minor, enough))
    return found[0], found[1]


@settings(max_examples=draws(60), deadline=None)
@given(
    st.lists(st.integers(0, 4), min_size=1, max_size=3), st.integers(0, 10**6), st.booleans(),
    st.sampled_from([0.05, -5.0, 5.0]),
)  # fmt: skip
def test_the_compiled_search_has_the_bits_of_numpy(
    degrees: list[int], seed: int, flat: bool, enough: float
) -> None:
    """Least value, bound, place, and how many boxes it took; also where all values are equal."""
    quick, usual = both(polynomial(tuple(degrees), seed, flat=flat), enough)
    assert quick == usual


def test_the_least_of_a_parabola_is_found() -> None:
    """Of 0.3 + (t - 0.4)^2 in one parameter."""

    def at(parameters: FloatArray) -> FloatArray:
        return np.asarray(0.3 + (parameters[:, 0] - 0.4) ** 2)

    one = Minor("m", np.zeros((1, 1)), np.ones((1, 1)), (2,), at, lambda t: np.resize(t, (1, 3)))
    for found in both(one, 0.05):
        assert found.least == pytest.approx(0.3, abs=1e-9)
        assert 0.3 - 2e-9 <= found.bound <= found.least
