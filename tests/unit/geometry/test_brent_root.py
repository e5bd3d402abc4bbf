"""The root of one function in a bracket: the places tried are those that scipy tries."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest
from scipy.optimize import brentq

from assoc_hull.geometry.numeric.polynomials import brent_root


def _cubic(a: float, b: float, c: float) -> Callable[[float], float]:
    return lambda x: a + x * (1.0 + b * x + c * x * x)


def _growth(a: float, b: float, c: float) -> Callable[[float], float]:
    return lambda x: math.exp(a * x) - 1.0 - b * x + 0.3 * c


def _step(a: float, b: float, c: float) -> Callable[[float], float]:
    return lambda x: math.tanh(20.0 * (x - a)) + 0.01 * b


KINDS = {"cubic": _cubic, "growth": _growth, "step": _step}


@pytest.mark.parametrize("kind", KINDS.values(), ids=KINDS.keys())
def test_every_trial_has_the_bits_of_scipys(kind: Callable[..., Callable[[float], float]]) -> None:
    """Roots found with scipy before, and what was made of them, stay what they were."""
    rng, compared = np.random.default_rng(3), 0
    for trial in range(400):
        give = kind(*rng.normal(size=3).tolist())
        ends = -rng.uniform(0.0, 5.0), rng.uniform(0.0, 5.0)
        low, high = ends if trial % 5 else ends[::-1]
        if give(low) * give(high) >= 0.0:
            continue
        for xtol, rtol in ((1e-8, 4.0 * np.finfo(float).eps), (1e-12, 1e-14)):
            ours, theirs = list[float](), list[float]()
            root = brent_root(_noted(give, ours), low, high, xtol=xtol, rtol=rtol)
            assert root == brentq(_noted(give, theirs), low, high, xtol=xtol, rtol=rtol)
            assert ours == theirs
            compared += 1
    assert compared > 100


def _noted(give: Callable[[float], float], places: list[float]) -> Callable[[float], float]:
    def value(x: float) -> float:
        places.append(float(x))
        return give(x)

    return value


def test_a_root_at_an_end_is_that_end() -> None:
    """Nothing is tried where the bracket has the root already."""
    assert brent_root(lambda x: x - 1.0, 1.0, 2.0, xtol=1e-12) == 1.0
    assert brent_root(lambda x: x - 2.0, 1.0, 2.0, xtol=1e-12) == 2.0


def test_values_of_one_sign_are_refused() -> None:
    """A bracket without a change of sign is a mistake of the caller, not a root."""
    with pytest.raises(ValueError, match="no root between 1 and 2"):
        brent_root(lambda x: x, 1.0, 2.0, xtol=1e-12)
