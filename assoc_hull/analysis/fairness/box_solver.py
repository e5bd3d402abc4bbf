"""The least of a quadratic function within bounds, for sparse matrices.

A set of unknowns stands at its bounds, the others are solved for, and forces and bounds say which
set is next (Hintermueller, Ito & Kunisch, SIAM J. Optim. 13 (2002), pp. 865-888: the primal-dual
active set). Two to five factorisations were needed on nets of ships. Where sets go round in a ring,
a Newton method that goes down along the bounds finds the set (Bertsekas, SIAM J. Control Optim. 20
(1982), pp. 221-246).
"""

from __future__ import annotations

from typing import Literal

import attrs
import numpy as np
from scipy.sparse import csc_array, csr_array
from scipy.sparse.linalg import SuperLU, splu

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze

__all__ = ["BoxSolution", "factorise", "solve_in_box"]

_SETS = 30
"""Sets that are tried."""

_PATIENCE = 3
"""So many sets may have no fewer unknowns on the wrong side than the best one before them."""

_ENOUGH, _HALVINGS = 1e-4, 30
"""A step goes down by this part of what its slope promises, after so many halvings at most."""


@attrs.frozen(eq=False)
class BoxSolution:
    """What makes a quadratic function least.

    Attributes
    ----------
    values : (n,)
        The unknowns.
    side : (n,) int
        1 or -1 where one stands at its upper or lower bound, else 0.
    factors : SuperLU or None
        Of the rows and columns of those that stand at none: `free` (k,) int; None without any.
    """

    values: FloatArray
    side: IntArray
    factors: SuperLU | None
    free: IntArray

    def __attrs_post_init__(self) -> None:
        freeze(self.values, self.side, self.free)


Order = Literal["NATURAL", "MMD_AT_PLUS_A"]
"""In which unknowns are eliminated: as they stand, or so that the factors stay sparse."""


def factorise(matrix: csr_array | csc_array, order: Order = "MMD_AT_PLUS_A") -> SuperLU:
    """Factorise a symmetric positive matrix."""
    found: SuperLU = splu(
        csc_array(matrix), permc_spec=order, diag_pivot_thresh=0.0, options={"SymmetricMode": True}
    )
    return found


def solve_in_box(
    matrix: csr_array, gradient: FloatArray, low: FloatArray, high: FloatArray,
    side: IntArray | None = None, order: Order = "MMD_AT_PLUS_A", sets: int = _SETS,
) -> BoxSolution:  # fmt: skip
    """Make x H x / 2 + g x least for low <= x <= high; H is symmetric and positive.

    `side` (n,) says where unknowns stood in a problem like this one: that set is tried first. No
    more than `sets` are: then what is found keeps the bounds and is nearly the least.
    """
    problem = _Box(matrix, gradient, low, high, order)
    diagonal = matrix.diagonal()
    side = np.zeros(len(gradient), np.int64) if side is None else side
    fewest, patience = len(gradient) + 1, _PATIENCE
    for _ in range(sets):
        free = np.flatnonzero(side == 0)
        found = np.where(side < 0, low, np.where(side > 0, high, 0.0))
        factors = problem.factors(free) if len(free) else None
        if factors is not None:
            found[free] = factors.solve(-(gradient[free] + (matrix @ found)[free]))
        aim = found - (matrix @ found + gradient) / diagonal
        new = np.where(aim > high, 1, np.where(aim < low, -1, 0)).astype(np.int64)
        wrong = int((new != side).sum())
        if not wrong:
            break
        fewest, patience = (wrong, patience) if wrong < fewest else (fewest, patience - 1)
        # a ring of sets: what goes down all the time finds the set, which is tried next
        side = problem.descend(np.clip(found, low, high), sets) if patience == 0 else new
    return BoxSolution(np.clip(found, low, high), side, factors, free)


@attrs.frozen(eq=False)
class _Box:
    """A problem of `solve_in_box`."""

    matrix: csr_array
    gradient: FloatArray
    low: FloatArray
    high: FloatArray
    order: Order
    columns: csc_array = attrs.field(init=False)

    @columns.default
    def _columns(self) -> csc_array:
        return csc_array(self.matrix)

    def factors(self, free: IntArray) -> SuperLU:
        """Factorise the rows and columns of some unknowns, ascending."""
        every, count = self.columns, len(self.gradient)
        mine = np.zeros(count, np.bool_)
        mine[free] = True
        column = np.repeat(np.arange(count), np.diff(every.indptr))
        kept = mine[every.indices] & mine[column]
        height = np.bincount(column[kept], minlength=count)[free]
        number = np.cumsum(mine) - 1
        part = csc_array(
            (every.data[kept], number[every.indices[kept]], np.append(0, np.cumsum(height))),
            (len(free), len(free)),
        )
        return factorise(part, self.order)

    def descend(self, found: FloatArray, steps: int) -> IntArray:
        """Go down from what lies within the bounds; give where unknowns stand at the least."""
        at = self._sides(found)
        for _ in range(steps):
            free = np.flatnonzero(at == 0)
            if not len(free):
                break
            slope, value = self.matrix @ found + self.gradient, self._value(found)
            step, part, more = self.factors(free).solve(-slope[free]), 1.0, found
            for _ in range(_HALVINGS):
                aim = found[free] + part * step
                more = found.copy()
                more[free] = np.clip(aim, self.low[free], self.high[free])
                if value - self._value(more) >= _ENOUGH * float((slope * (found - more)).sum()):
                    break
                part *= 0.5
            new = self._sides(more)
            if np.array_equal(new, at) and part == 1.0 and np.array_equal(more[free], aim):
                break
            if np.array_equal(more, found):
                break  # rounding stands in the way
            at, found = new, more
        return at

    def _sides(self, found: FloatArray) -> IntArray:
        """Tell which unknowns are pressed against a bound."""
        slope = self.matrix @ found + self.gradient
        upper, lower = (found >= self.high) & (slope < 0.0), (found <= self.low) & (slope > 0.0)
        sides: IntArray = upper.astype(np.int64) - lower
        return sides

    def _value(self, found: FloatArray) -> float:
        return float((found * (0.5 * (self.matrix @ found) + self.gradient)).sum())
