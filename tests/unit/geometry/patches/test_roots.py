"""Roots of many Bernstein polynomials with one change of sign."""

import numpy as np
import pytest

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.bernstein_polynomials import multiply, sign_change_roots


def monotone(degree: int, count: int, seed: int = 1) -> FloatArray:
    """Rising polynomials with a root in (0, 1)."""
    random = np.random.default_rng(seed)
    b = np.sort(random.normal(size=(count, degree + 1)), axis=1)
    b += 0.3 * random.normal(size=(count, 1))
    return b[(b[:, 0] < 0.0) & (b[:, -1] > 0.0)]


def casteljau(b: FloatArray, t: FloatArray) -> FloatArray:
    """The values at t, one a row, by means of means."""
    at = t[:, None]
    while b.shape[1] > 1:
        b = (1.0 - at) * b[:, :-1] + at * b[:, 1:]
    return b[:, 0]


@pytest.mark.parametrize("degree", [1, 2, 3, 8, 14, 20, 32])
def test_roots_are_exact_to_rounding(degree: int) -> None:
    """A root is within 4e-15 of where the polynomial, by another rule, changes sign."""
    b = monotone(degree, 6000)
    t = sign_change_roots(b, np.ones(len(b), bool))
    slope = casteljau(degree * np.diff(b, axis=1), t) if degree > 1 else np.diff(b)[:, 0]
    assert len(b) > 1000
    assert np.abs(casteljau(b, t) / slope).max() < 4e-15


def test_a_root_does_not_depend_on_other_rows() -> None:
    """Alone, in a batch or in another order, a row has the same root to the last bit."""
    b = monotone(14, 4000)
    rising = np.arange(len(b)) % 3 > 0
    b = np.where(rising[:, None], b, -b)
    t = sign_change_roots(b, rising)
    order = np.random.default_rng(2).permutation(len(b))
    assert np.array_equal(sign_change_roots(b[order], rising[order]), t[order])
    for i in range(0, len(b), 100):
        assert sign_change_roots(b[i : i + 1], rising[i : i + 1])[0] == t[i]


@pytest.mark.parametrize(
    ("b", "rising", "root"),
    [
        ([0.0, 0.0, -1.0, 1.0], True, 0.75),
        ([0.0, -3.0, 1.0, 0.0], True, 0.75),
        ([-1e-20, 0.0, 3.0, -1.0, -1e-20], False, 9 / 11),
        ([-1.0, 0.0, 0.0, 1.0], True, 0.5),
        ([1e-17, 1.0, 2.0], True, 0.0),
        ([-2.0, -1.0, -1e-17], True, 1.0),
        ([1e-300, -1e300], False, 0.0),
        ([-1.0, 1e-300], True, 1.0),
    ],
    ids=[
        "nil at the start", "nil at both ends", "noise at both ends", "in the middle",
        "at the start, off by rounding", "at the end, off by rounding", "huge", "tiny",
    ],
)  # fmt: skip
def test_ends_may_be_nil_or_noise(b: list[float], rising: bool, root: float) -> None:
    """The change of sign is found, not a nil coefficient at an end."""
    found = sign_change_roots(np.array([b]), np.array([rising]))[0]
    assert found == pytest.approx(root, abs=4e-15)


@pytest.mark.parametrize("power", [3, 5])
def test_flat_roots_are_found_as_well_as_they_can_be(power: int) -> None:
    """A root of high order is found to what its flatness allows."""
    b, factor = np.ones((1, 1)), np.array([[-0.3, 0.7]])
    for _ in range(power):
        b = multiply(b, factor)
    t = sign_change_roots(b, np.array([True]))
    assert abs(t[0] - 0.3) < 5.0 * 1e-16 ** (1.0 / power)


def test_rows_without_a_root_give_an_end() -> None:
    """No row runs on for ever, or leaves [0, 1]; no rows give no roots."""
    b = np.array([[1.0, 2.0, 3.0], [-3.0, -2.0, -1.0], [0.0, 0.0, 0.0]])
    t = sign_change_roots(b, np.ones(3, bool))
    assert t[:2].tolist() == [0.0, 1.0]
    assert 0.0 <= t[2] <= 1.0
    assert sign_change_roots(np.zeros((0, 5)), np.zeros(0, bool)).shape == (0,)
    assert sign_change_roots(np.zeros((2, 1)), np.zeros(2, bool)).tolist() == [0.0, 0.0]
