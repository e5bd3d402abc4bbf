"""Roots in brackets: found by few calls, at an end too, each as when it is alone."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.numeric.polynomials import false_position

roots = st.lists(st.floats(0.02, 0.98), min_size=1, max_size=8)


def steep(root: FloatArray) -> tuple[FloatArray, FloatArray, list[int]]:
    """Values at 0 and 1 of functions that are flat on one side of their roots, and a counter."""
    return np.expm1(-30.0 * root), np.expm1(30.0 * (1.0 - root)), []


def solved(root: FloatArray, low: float = 0.0, high: float = 1.0) -> tuple[FloatArray, int]:
    """The roots of exp(30 (x - root)) - 1, and how many calls that took."""
    first, last, calls = steep(root)
    if low > high:
        first, last = last, first

    def give(rows: IntArray, at: FloatArray) -> FloatArray:
        calls.append(len(rows))
        return np.asarray(np.expm1(30.0 * (at - root[rows])))

    many = np.full(len(root), low), np.full(len(root), high)
    return false_position(give, *many, first, last, 1e-14), len(calls)


@given(root=roots.map(np.array))
def test_roots_are_found_by_few_calls(root: FloatArray) -> None:
    """Also where the function is ten thousand million times as steep at one end."""
    found, calls = solved(root)
    assert_allclose(found, root, rtol=0, atol=1e-13)
    assert calls <= 60


@given(root=roots.map(np.array))
def test_a_root_is_the_same_alone(root: FloatArray) -> None:
    """To the last bit, whatever other brackets are solved with it."""
    together, _ = solved(root)
    assert [float(solved(root[k : k + 1])[0][0]) for k in range(len(root))] == together.tolist()


def test_a_bracket_may_run_backward() -> None:
    """The same root from the other side."""
    root = np.array([0.3])
    assert_allclose(solved(root, 1.0, 0.0)[0], root, rtol=0, atol=1e-13)


def test_a_root_at_an_end_is_that_end() -> None:
    """Without a call: its value is nil there."""
    ends = np.array([0.0]), np.array([1.0])
    found = false_position(lambda rows, at: 1.0 / np.zeros(0), *ends, np.array([-1.0]), np.zeros(1))
    assert found.tolist() == [1.0]
