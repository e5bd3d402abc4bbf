"""The small quadratic problem of a step: against its own conditions, and where there is none."""

import numpy as np
import pytest
from scipy.optimize import nnls

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.aiming.newton_iteration import no_curvature, updated_curvature
from assoc_hull.variation.aiming.quadratic_program import Quadratic, least_squares_step, split


def drawn(rng: np.random.Generator) -> tuple[Quadratic, bool]:
    """A problem, and whether some step is known to meet its equations well within its bounds."""
    k = int(rng.integers(1, 8))
    m = int(rng.integers(0, k + 1))
    root = rng.normal(size=(k, k))
    low, high = -rng.exponential(size=k), rng.exponential(size=k)
    low[rng.random(k) < 0.3], high[rng.random(k) < 0.3] = -np.inf, np.inf
    A, known = rng.normal(size=(m, k)), bool(rng.random() < 0.7)
    within = 0.9 * np.clip(rng.normal(size=k), low, high)
    b = A @ (within if known else rng.normal(size=k) * 3.0)
    return Quadratic(np.eye(k) + 0.5 * root @ root.T, rng.normal(size=k), A, b, low, high), known


def unbalanced(problem: Quadratic, step: FloatArray) -> float:
    """What gradients of equations and inward forces of bounds leave of the cost's gradient."""
    slope = problem.H @ step + problem.g
    out = (step >= problem.high).astype(float) - (step <= problem.low)
    null = split(problem.A)[1].T if len(problem.A) else np.eye(len(step))
    at = out != 0.0
    if not at.any() or not len(null):
        return float(np.linalg.norm(null @ slope))
    return float(nnls(null[:, at] * out[at], -null @ slope)[1])


def test_steps_fulfil_the_conditions_of_the_least_cost() -> None:
    """Every step keeps to bounds and equations, and no smaller cost is near: by Kuhn and Tucker.

    Where a step is known to exist, one is found.
    """
    rng, lost, held = np.random.default_rng(3), 0, 0
    for _ in range(400):
        problem, known = drawn(rng)
        step = problem.step()
        if step is None:
            lost += known
            continue
        assert ((problem.low <= step) & (step <= problem.high)).all()
        assert np.abs(problem.A @ step - problem.b).max(initial=0.0) < 1e-8
        assert unbalanced(problem, step) < 1e-8
        held += bool(((step == problem.low) | (step == problem.high)).any())
    assert lost == 0
    assert held > 100


def test_equations_that_contradict_each_other_have_no_step() -> None:
    """Dependent rows are taken if they agree, and refused if not."""
    A, free = np.array([[1.0, 2.0, 0.0], [2.0, 4.0, 0.0]]), np.full(3, np.inf)
    agreed = Quadratic(np.eye(3), np.zeros(3), A, np.array([5.0, 10.0]), -free, free).step()
    assert agreed == pytest.approx([1.0, 2.0, 0.0], abs=1e-14)
    assert Quadratic(np.eye(3), np.zeros(3), A, np.array([5.0, 9.0]), -free, free).step() is None


def test_least_squares_keep_to_bounds_and_leave_alone_what_has_no_effect() -> None:
    """The nearest step within bounds; a direction without effect gets none, a shut one neither."""
    A = np.array([[1.0, 0.0, 0.0, 1.0], [0.0, 2.0, 0.0, 1.0]])
    low, high = np.array([-1.0, -9.0, -9.0, 0.0]), np.array([1.0, 9.0, 9.0, 0.0])
    step = least_squares_step(A, np.array([3.0, 4.0]), low, high)
    assert step == pytest.approx([1.0, 2.0, 0.0, 0.0], abs=1e-12)


def test_curvature_of_a_quadratic_is_learnt_from_its_gradients() -> None:
    """After steps along every axis the second derivatives are known; a tiny step says nothing."""
    rng = np.random.default_rng(5)
    truth = rng.normal(size=(2, 3, 3))
    truth = truth + truth.transpose(0, 2, 1)
    known = no_curvature(2, 3)
    for _ in range(60):
        step = rng.normal(size=3)
        known = updated_curvature(known, step, truth @ step)
    assert np.abs(known - truth).max() < 1e-9
    assert updated_curvature(known, np.full(3, 1e-9), np.ones((2, 3))) is known
