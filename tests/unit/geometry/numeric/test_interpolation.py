"""Interpolation along many curves at once is that of numpy, curve by curve."""

from __future__ import annotations

import numpy as np
import pytest

from assoc_hull.geometry.numeric.interpolation import interpolate_linear


@pytest.mark.parametrize("seed", range(20))
def test_each_curve_gets_the_bits_of_numpy(seed: int) -> None:
    """In any order, with places at, between and beyond the known ones, some known twice."""
    rng = np.random.default_rng(seed)
    curve, wanted = rng.integers(0, 6, 40), rng.integers(0, 8, 60)
    at, place = rng.integers(0, 9, 40) / 7.0, rng.integers(-2, 22, 60) / 14.0
    value = rng.normal(size=(40, 3))
    found, told = interpolate_linear(curve, at, value, wanted, place)
    assert told.tolist() == np.isin(wanted, curve).tolist()
    for number in set(wanted[told].tolist()):
        mine = np.flatnonzero(curve == number)
        mine = mine[np.argsort(at[mine], kind="stable")]
        here = wanted[told] == number
        for axis in range(3):
            truth = np.interp(place[told][here], at[mine], value[mine, axis])
            assert truth.tobytes() == found[here, axis].tobytes()


def test_nothing_known_tells_nothing() -> None:
    """No place has a value then, and no place wants none."""
    none, nowhere = np.zeros(0, np.int64), np.zeros(0)
    found, told = interpolate_linear(
        none, nowhere, np.zeros((0, 3)), np.array([1]), np.array([0.5])
    )
    assert (found.shape, told.tolist()) == ((0, 3), [False])
    found, told = interpolate_linear(np.array([1]), np.array([0.5]), np.ones((1, 3)), none, nowhere)
    assert (found.shape, told.shape) == ((0, 3), (0,))
