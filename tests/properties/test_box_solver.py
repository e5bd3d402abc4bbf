"""The least of a quadratic function within bounds meets its conditions, rings of sets or not."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.sparse import csr_array

from assoc_hull.analysis.fairness import fair_solution
from assoc_hull.analysis.fairness.fair_solution import solve_in_box
from assoc_hull.geometry.curves import FloatArray


@given(seed=st.integers(0, 2**32 - 1), size=st.integers(1, 160), width=st.floats(0.05, 3.0))
def test_forces_at_the_least_press_against_the_bounds(seed: int, size: int, width: float) -> None:
    """Free unknowns feel none; stiff battens, whose inverses have both signs, make sets ring."""
    rng = np.random.default_rng(seed)
    stiff = 10.0 ** rng.uniform(-1.5, 1.5, (size, 1))
    second = np.diff(np.eye(size + 2), 2, axis=0)[:, 1:-1] * stiff
    dense = second.T @ second + np.diag(rng.uniform(1e-3, 0.1, size))
    gradient = dense @ rng.normal(0.0, 1.0, size)
    low, high = -width * rng.uniform(0.1, 1.0, size), width * rng.uniform(0.1, 1.0, size)
    # some have a bound on one side only, some on none, some no room at all
    low[rng.random(size) < 0.1], high[rng.random(size) < 0.1] = -np.inf, np.inf
    closed = (rng.random(size) < 0.1) & np.isfinite(low)
    high[closed] = low[closed]
    found = solve_in_box(csr_array(dense), gradient, low, high)
    assert (found.values >= low).all()
    assert (found.values <= high).all()
    force = dense @ found.values + gradient
    near = 1e-9 * (np.abs(dense) @ np.abs(found.values) + np.abs(gradient))
    free = found.side == 0
    assert (np.abs(force[free]) <= near[free]).all()
    assert (force[found.side > 0] <= near[found.side > 0]).all()
    assert (force[found.side < 0] >= -near[found.side < 0]).all()
    assert (found.values[found.side > 0] == high[found.side > 0]).all()
    assert (found.values[found.side < 0] == low[found.side < 0]).all()


@given(seed=st.integers(0, 2**32 - 1), size=st.integers(2, 40))
def test_where_one_begins_changes_no_bit(seed: int, size: int) -> None:
    """A set that is known beforehand, right or wrong, saves time only."""
    rng = np.random.default_rng(seed)
    second = np.diff(np.eye(size + 2), 2, axis=0)[:, 1:-1]
    dense = second.T @ second + 1e-2 * np.eye(size)
    gradient, bound = rng.normal(0.0, 1.0, size), np.full(size, 0.3)
    plain = solve_in_box(csr_array(dense), gradient, -bound, bound)
    side = rng.integers(-1, 2, size)
    other = solve_in_box(csr_array(dense), gradient, -bound, bound, side)
    assert (plain.values == other.values).all()


@given(
    seed=st.integers(0, 2**32 - 1), size=st.integers(2, 60), sets=st.integers(1, 3),
    patience=st.integers(1, 3), steps=st.sampled_from([0, 1, 3, 60]),
)  # fmt: skip
def test_what_is_given_where_sets_run_out_belongs_together(
    seed: int, size: int, sets: int, patience: int, steps: int
) -> None:
    """Sides, values and factors are of one set; from within comes the least, if it gets there."""
    rng = np.random.default_rng(seed)
    stiff = 10.0 ** rng.uniform(-1.5, 1.5, (size, 1))
    second = np.diff(np.eye(size + 2), 2, axis=0)[:, 1:-1] * stiff
    dense = second.T @ second + np.diag(rng.uniform(1e-3, 0.1, size))
    gradient = dense @ rng.normal(0.0, 1.0, size)
    bound = rng.uniform(0.05, 1.0, size) * (rng.random(size) > 0.1)
    with pytest.MonkeyPatch.context() as patch:
        for name, value in (("_ACTIVE_SETS", sets), ("_PATIENCE", patience), ("_STEPS", steps)):
            patch.setattr(fair_solution, name, value)
        found = solve_in_box(csr_array(dense), gradient, -bound, bound, rng.integers(-1, 2, size))
    assert (np.abs(found.values) <= bound).all()
    assert (found.values == found.side * bound)[found.side != 0].all()
    assert (found.free == np.flatnonzero(found.side == 0)).all()
    assert (found.factors is None) == (len(found.free) == 0)
    if found.factors is not None:
        part = dense[np.ix_(found.free, found.free)]
        ones = found.factors.solve(part @ np.ones(len(part)))
        assert np.allclose(ones, 1.0, atol=1e-6)
    if steps == 60:
        least = solve_in_box(csr_array(dense), gradient, -bound, bound)
        assert np.allclose(found.values, least.values, atol=1e-5)


@pytest.mark.parametrize("sets", [1, 2], ids=["one set", "two sets"])
def test_sets_that_run_out_without_a_ring_are_followed_by_the_way_from_within(sets: int) -> None:
    """Two sets are too few for this problem; patience has not run out."""
    second = np.diff(np.eye(42), 2, axis=0)[:, 1:-1]
    dense = second.T @ second + 1e-3 * np.eye(40)
    gradient, bound = np.sin(np.arange(40.0)), np.full(40, 0.3)
    least = solve_in_box(csr_array(dense), gradient, -bound, bound)
    came, within = list[int](), fair_solution._Box.from_within

    def counted(box: fair_solution._Box) -> FloatArray:
        came.append(1)
        return within(box)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(fair_solution, "_ACTIVE_SETS", sets)
        patch.setattr(fair_solution._Box, "from_within", counted)
        found = solve_in_box(csr_array(dense), gradient, -bound, bound)
    assert came == [1]
    assert (found.values == least.values).all()
    assert (found.side == least.side).all()
