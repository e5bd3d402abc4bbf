"""Curvature at knots, its rates, and the least change that keeps it within bounds."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.sparse import csr_array

from assoc_hull.analysis.fairness.batten_problem import BentCurves, end_curvatures
from assoc_hull.analysis.fairness.fair_solution import KeptSigns
from assoc_hull.edit.net_battens import net_battens
from assoc_hull.geometry.curves import CurveData
from assoc_hull.geometry.splines.loft import loft
from tests.conftest import Shipped


@pytest.fixture(scope="module")
def bent(shipped: Shipped) -> BentCurves:
    """The sections of a Wigley hull, with all points that may be faired."""
    state = shipped("wigley").state
    lines = [line for line in state.live("lines").tolist() if state.family(line).name == "sections"]
    curves = np.array([curve for line in lines for curve in state.curves_of(line)], np.int64)
    normals = np.tile([1.0, 0.0, 0.0], (len(curves), 1))
    return BentCurves.of(state, net_battens(state), curves, normals)


def test_the_curvature_of_a_circle_is_that_of_its_radius() -> None:
    """At both ends of each segment, away from the free ends, which a spline bends by itself."""
    angle = np.linspace(0.0, np.pi, 65)
    xyz = np.stack([5.0 * np.cos(angle), 5.0 * np.sin(angle), 0.0 * angle], axis=1)
    start, end = end_curvatures(loft(CurveData.single(xyz)), np.array([[0.0, 0.0, 1.0]]))
    inner = slice(8, -8)
    assert np.abs(np.concatenate([start[inner], end[inner]]) - 0.2).max() < 1e-4


def test_rates_are_the_slopes_of_curvature(bent: BentCurves) -> None:
    """Against differences of lofted curves, wherever a point moves."""
    count = len(bent.problem.rows)
    chosen = np.zeros(count)
    chosen[::17] = 1.0
    found, step = bent.rates(np.zeros(count)), 1e-6
    ends = [
        np.concatenate(end_curvatures(bent.lofted(side * step * chosen), bent.normals))
        for side in (1.0, -1.0)
    ]
    slopes = (ends[0] - ends[1]) / (2.0 * step)
    assert np.abs(slopes).max() > 0.01
    assert np.abs(found.rate @ chosen - slopes).max() < 1e-3 * np.abs(slopes).max()


def test_what_passes_a_bound_is_brought_back_by_the_least_change(bent: BentCurves) -> None:
    """Within the limits of the points; where nothing passes one, nothing moves."""
    count = len(bent.problem.rows)
    ones, none = np.ones(len(bent.problem.residual)), np.zeros(count)
    kept = KeptSigns(
        bent.problem, 1e-3, np.full(count, 0.02), np.full(count, -0.02), np.full(count, 0.02)
    )
    rates = bent.rates(none)
    felt = np.flatnonzero(np.diff(rates.rate.indptr) > 0)
    most = felt[np.argmax(rates.value[felt])]
    rate = csr_array(rates.rate[[most]])
    idle = kept.answer(ones, rate, np.array([-1e-3]), np.array([1e8]), none)
    assert (idle == 0.0).all()
    beyond = np.array([1e-4])
    moved = kept.answer(ones, rate, beyond, np.array([1e12]), none)
    assert abs(float((rate @ moved + beyond)[0])) < 1e-6
    assert 0.0 < np.abs(moved).max() <= 0.02
