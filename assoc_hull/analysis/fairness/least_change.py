"""The least change of batten residuals that some asked displacements make.

With residuals A d + b of a net, d the displacements of its free points along the normal, those
that are asked for are held, and all others answer so that

    E(d) = sum over residuals i of v_i (A d)_i^2 / (s^2 + b_i^2)
         + sum over points k of (d_k / (T D F_k))^2,      D = the largest |d| that is asked

is least within bounds. It is the *change* of the residual that is small, weighed by what was there:
a bilge bends freely, a straight run does not. F fades with the distance from what is asked; the
second term is a tether, without which the answer swings on beyond it as a batten does, and so are
the bounds: nothing goes farther than a tenth more than is asked, nor more than a tenth the other
way. [own], measured on three hulls: the residual itself in place of its change fairs what nobody
asked for, and fairing after a dent leaves it, for a dent is signal and no noise.
"""

from __future__ import annotations

import attrs
import numpy as np
from scipy.sparse import csr_array, diags_array

from assoc_hull.analysis.fairness.batten_problem import BattenProblem
from assoc_hull.analysis.fairness.box_solver import solve_in_box
from assoc_hull.geometry.curves import FloatArray, IntArray

__all__ = ["LeastChange"]

_TETHER = 0.3
"""Times the largest displacement asked for: what a free point goes at the price of one."""

_BEYOND = 0.1
"""Times the same: how far one goes beyond what is asked, and how far the other way."""

_OUT = 1e-3
"""Where the fade is less, points stay."""


@attrs.frozen(eq=False)
class LeastChange:
    """Displacements that are asked of a net.

    Attributes
    ----------
    problem : BattenProblem
        The residuals of the net as it is.
    asked : (p,) int
        Which of its unknowns are asked for.
    amount : (p,), m
        How far, along the normal.
    """

    problem: BattenProblem
    asked: IntArray
    amount: FloatArray

    def answer(
        self, fade: FloatArray, scale: float, weight: FloatArray, side: IntArray | None = None
    ) -> tuple[FloatArray, IntArray]:
        """Give the displacements of all unknowns, (n,), m, and at which bounds they stand, (n,).

        `fade` (n,) is how far each may go, of 1; `scale` s, m; `weight` (r,) the v of residuals;
        `side` (n,) the bounds of an answer with the same fade, to begin with.
        """
        problem, largest = self.problem, float(np.abs(self.amount).max())
        held = np.zeros(len(fade))
        held[self.asked] = self.amount
        free = fade > _OUT
        free[self.asked] = False
        points = np.flatnonzero(free)
        bounds = np.zeros(len(fade), np.int64)
        if not len(points):
            return held, bounds
        # Rows of residuals that no free point has a part in change as they must.
        part = csr_array(problem.matrix[:, points])
        touched = np.flatnonzero(np.diff(part.indptr) > 0)
        part = part[touched]
        was = problem.residual[touched]
        stiff = weight[touched] / (scale * scale + was * was)
        forced = (problem.matrix @ held)[touched]
        slack = 1.0 / (_TETHER * largest * fade[points]) ** 2
        matrix = csr_array(part.T @ (diags_array(stiff) @ part) + diags_array(slack))
        low, high = (np.full(len(points), bound) for bound in _bounds(self.amount, largest))
        start = None if side is None else side[points]
        found = solve_in_box(matrix, part.T @ (stiff * forced), low, high, start)
        held[points], bounds[points] = found.values, found.side
        return held, bounds


def _bounds(amount: FloatArray, largest: float) -> tuple[float, float]:
    """Give how far points may go inwards and outwards, m."""
    beyond, other = 1.0 + _BEYOND, _BEYOND * largest
    # What is asked for the other way by a hair is no bound.
    return min(beyond * float(amount.min()), -other), max(beyond * float(amount.max()), other)
