"""The least change of a net that keeps its curvature within bounds.

With residuals A d + b of a net, d the displacements of points along the normal, and curvatures
k_0 + K d of its lines that are not to pass bounds k,

    E(d) = sum over residuals i of v_i (A d)_i^2 / (s^2 + b_i^2)
         + sum over points j of (d_j / T_j)^2
         + sum over bounds l of w_l max(0, (k_0 + K d - k)_l)^2

is least within how far each point may go. As in `least_change` it is the change of the residuals
that is small, weighed by what was there; what is asked for is not a place but the sign of a
curvature. [own]: fairing by a noise, or towards the residuals of another hull, adds sign changes.
"""

from __future__ import annotations

import attrs
import numpy as np
from scipy.sparse import csr_array, diags_array

from assoc_hull.analysis.fairness.batten_problem import BattenProblem
from assoc_hull.analysis.fairness.box_solver import solve_in_box
from assoc_hull.geometry.curves import FloatArray

__all__ = ["KeptSigns"]

_SETS = 12
"""Sets of passed bounds that are tried: they may come in turns."""


@attrs.frozen(eq=False)
class KeptSigns:
    """Points that may move, and what their moves cost by themselves.

    Attributes
    ----------
    problem : BattenProblem
        The residuals of the net as it is.
    scale : float, m
        s.
    tether : (k,), m
        T of each point.
    low, high : (k,), m
        How far each may go.
    """

    problem: BattenProblem
    scale: float
    tether: FloatArray
    low: FloatArray
    high: FloatArray

    def answer(
        self, stiffer: FloatArray, rate: csr_array, beyond: FloatArray, weight: FloatArray,
        start: FloatArray,
    ) -> FloatArray:  # fmt: skip
        """Give the displacements (k,), m, found from those at the start.

        Parameters
        ----------
        stiffer : (r,)
            v: by what the residuals weigh more.
        rate : (l, k) sparse, 1/m2
            K: how curvatures change with displacements.
        beyond : (l,), 1/m
            By how much they pass their bounds without any; negative where they keep them.
        weight : (l,), m2
            What it costs to pass them.
        start : (k,), m
            Displacements that tell which are passed at first.
        """
        problem = self.problem
        a, was = problem.matrix, problem.residual
        stiff = diags_array(stiffer / (self.scale * self.scale + was * was))
        tether = diags_array(1.0 / (self.tether * self.tether))
        alone = csr_array(a.T @ (stiff @ a) + tether)
        found, before, side = start, None, None
        for _ in range(_SETS):
            passed = np.flatnonzero(rate @ found + beyond > 0.0)
            if before is not None and np.array_equal(passed, before):
                break
            before, k = passed, csr_array(rate[passed])
            matrix = csr_array(alone + k.T @ (diags_array(weight[passed]) @ k))
            gradient = k.T @ (weight[passed] * beyond[passed])
            solved = solve_in_box(matrix, gradient, self.low, self.high, side)
            found, side = solved.values, solved.side
        return found
