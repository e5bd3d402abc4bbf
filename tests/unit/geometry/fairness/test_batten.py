"""The batten residual of five points."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from assoc_hull.geometry.fairness.criteria import batten_coefficients

_steps = st.lists(st.floats(0.1, 10.0), min_size=4, max_size=4)


@given(_steps, st.lists(st.floats(-5.0, 5.0), min_size=4, max_size=4))
def test_a_cubic_has_no_residual(steps: list[float], cubic: list[float]) -> None:
    """The residual of a cubic is rounding, at any spacing."""
    nodes = np.concatenate([[0.0], np.cumsum(steps)])[None]
    values = np.polynomial.polynomial.polyval(nodes / nodes[0, -1], cubic)
    assert abs((batten_coefficients(nodes) * values).sum()) < 1e-12


@given(_steps)
def test_the_residual_is_a_length(steps: list[float]) -> None:
    """The largest coefficient is 1, and a scale of the parameters changes none."""
    nodes = np.concatenate([[0.0], np.cumsum(steps)])[None]
    found = batten_coefficients(nodes)
    assert np.abs(found).max() == 1.0
    assert np.allclose(batten_coefficients(7.0 * nodes), found, rtol=1e-10)


def test_equal_steps_give_the_fourth_difference() -> None:
    """At equal steps the coefficients are 1, -4, 6, -4, 1 over 6."""
    found = batten_coefficients(np.arange(5.0)[None])[0]
    assert np.allclose(found, np.array([1.0, -4.0, 6.0, -4.0, 1.0]) / 6.0, atol=1e-15)
