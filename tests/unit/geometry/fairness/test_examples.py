"""What the parts of `geometry.fairness` give, one small example of each."""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import SplineBatch
from assoc_hull.geometry.fairness.combs import curvature_sign_changes


def test_how_unfair_curves_are_curvature_that_changes_its_sign() -> None:
    """How unfair curves are: curvature that changes its sign, and how fast curvature changes."""
    xyz = np.array([[0.0, 0, 0], [4, 2, 0]])
    flat = np.array([[1.0, 0, 0], [1, 0, 0]])
    s_shape = SplineBatch(np.array([0, 2]), np.array([0.0, 4]), xyz, flat, flat.copy())
    assert curvature_sign_changes(s_shape, [0, 0, 1], band=2e-3).tolist() == [1]
