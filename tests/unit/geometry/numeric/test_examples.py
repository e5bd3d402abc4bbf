"""What the parts of `geometry.numeric` give, one small example of each."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_array_equal

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.numeric.polynomials import bracketed_roots, false_position


def test_roots_of_many_polynomials_at_once_each() -> None:
    """Roots of many polynomials at once, each with the same bits as when found alone."""
    cubic = np.array([[-0.5], [1.0], [0.0], [0.0]])
    assert_array_equal(
        bracketed_roots(cubic, np.zeros(1), np.ones(1), np.array([-0.5]), np.array([0.5])), [0.5]
    )


def test_roots_of_any_continuous_functions_in_brackets_all() -> None:
    """Roots of any continuous functions in brackets, all at once, without derivatives."""

    def square(_rows: IntArray, at: FloatArray) -> FloatArray:
        value: FloatArray = at * at - 2.0
        return value

    low, high = np.array([1.0]), np.array([2.0])
    root = false_position(square, low, high, np.array([-1.0]), np.array([2.0]))
    assert abs(float(root[0]) - 2.0**0.5) < 1e-13
