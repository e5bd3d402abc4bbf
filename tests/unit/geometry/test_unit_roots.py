"""Roots in [0, 1] of polynomials: each with the same bits alone and among many."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.polynomial.polynomial import polyfromroots

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.numeric.polynomials import unit_roots

RNG = np.random.default_rng(5)


def _of_roots(roots: FloatArray) -> FloatArray:
    """Give polynomials by their roots, (p, d + 1)."""
    return np.array([polyfromroots(row) for row in roots])


MANY = {
    "any": RNG.normal(size=(200, 6)),
    "roots inside": _of_roots(RNG.uniform(size=(200, 5))),
    "roots at ends and twice": _of_roots(RNG.integers(0, 5, (200, 5)) / 4.0),
    "of lower degree": RNG.normal(size=(200, 6)) * RNG.integers(0, 2, (200, 6)),
    "huge and tiny": RNG.normal(size=(200, 6)) * 10.0 ** RNG.uniform(-200.0, 200.0, (200, 6)),
}


@pytest.mark.parametrize("polynomials", MANY.values(), ids=MANY.keys())
def test_roots_found_alone_have_the_bits_of_those_found_among_many(
    polynomials: FloatArray,
) -> None:
    """Few are found with plain numbers, many with arrays: no last bit tells which."""
    together = unit_roots(polynomials)
    alone = np.concatenate([unit_roots(row[None]) for row in polynomials])
    tens = np.concatenate([unit_roots(part) for part in np.split(polynomials, 20)])
    assert alone.tobytes() == together.tobytes()
    assert tens.tobytes() == together.tobytes()


def test_every_root_inside_is_found() -> None:
    """Five roots at least 0.1 apart, to 1e-9."""
    roots = np.linspace(0.1, 0.9, 5) + RNG.uniform(-0.05, 0.05, (100, 5))
    assert np.abs(unit_roots(_of_roots(roots)) - roots).max() < 1e-9
