"""The least of a quadratic function within bounds, for sparse matrices.

A set of unknowns stands at its bounds, the others are solved for, and forces and bounds say which
set is next (Hintermueller, Ito & Kunisch, SIAM J. Optim. 13 (2002), pp. 865-888: the primal-dual
active set). Two to five factorisations were needed on nets of ships.
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


def factorise(matrix: csr_array, order: Order = "MMD_AT_PLUS_A") -> SuperLU:
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
    diagonal = matrix.diagonal()
    side = np.zeros(len(gradient), np.int64) if side is None else side
    for _ in range(sets):
        free = np.flatnonzero(side == 0)
        found = np.where(side < 0, low, np.where(side > 0, high, 0.0))
        factors = factorise(matrix[free][:, free], order) if len(free) else None
        if factors is not None:
            found[free] = factors.solve(-(gradient[free] + (matrix @ found)[free]))
        aim = found - (matrix @ found + gradient) / diagonal
        new = np.where(aim > high, 1, np.where(aim < low, -1, 0)).astype(np.int64)
        if np.array_equal(new, side):
            break
        side = new
    return BoxSolution(np.clip(found, low, high), side, factors, free)
