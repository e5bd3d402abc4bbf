"""Parts of patches in which the sign of a polynomial is known, or changes along one arc.

Examples
--------
>>> from assoc_hull.geometry.patches.cells import CellKind
>>> CellKind.POSITIVE.pure, CellKind.U_SIMPLE.pure
(True, False)
"""

from __future__ import annotations

from enum import IntEnum

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze

__all__ = ["Arcs", "CellKind", "Cells"]


class CellKind(IntEnum):
    """What is known of the sign of the polynomial in a cell.

    U_SIMPLE: every line v = constant meets the zero set at most once, and there is at most one
    arc, u = g(v). V_SIMPLE likewise, with v = g(u). UNRESOLVED: the search ended here.
    """

    POSITIVE = 1
    NEGATIVE = -1
    ZERO = 0
    U_SIMPLE = 2
    V_SIMPLE = 3
    UNRESOLVED = 4

    @property
    def pure(self) -> bool:
        """Whether the polynomial has one sign, or is nil, in the whole cell."""
        return -1 <= self.value <= 1


@attrs.frozen(eq=False)
class Cells:
    """Cells that cover all patches of a batch, in the order of patch, level and box.

    Attributes
    ----------
    patch : (c,) int
        The patch of each.
    box : (c, 2, 2)
        ``[[u0, u1], [v0, v1]]`` in parameters of the patch, 0 to 1.
    level : (c,) int
        How often the patch was split to get it.
    kind : (c,) int
        A `CellKind` each.
    row : (c,) int
        For cells that are simple or unresolved, which row of `b` and `err` holds their
        polynomial; else -1.
    b, err : (s, M + 1, N + 1)
        The polynomial restricted to these cells, and the bound of its error.
    stopped : (k,) bool
        Of each patch, whether the budget of cells ended the search.
    """

    patch: IntArray
    box: FloatArray
    level: IntArray
    kind: IntArray
    row: IntArray
    b: FloatArray
    err: FloatArray
    stopped: NDArray[np.bool_]

    def __attrs_post_init__(self) -> None:
        freeze(self.patch, self.box, self.level, self.kind, self.row, self.b, self.err)
        freeze(self.stopped)

    def __len__(self) -> int:
        """Count the cells."""
        return len(self.patch)


@attrs.frozen(eq=False)
class Arcs:
    """Arcs of the zero set, one a row, each in one simple cell.

    Attributes
    ----------
    cell : (a,) int
        The row of `Cells`.
    across : (a,) int
        0 where u = g(v), 1 where v = g(u).
    span : (a, 2)
        The running parameter (v, or u) at both ends, in parameters of the patch.
    ends : (a, 2, 2)
        (u, v) of the start and the end, in parameters of the patch; an end that lies on a
        border of its cell has that parameter to the last bit.
    rising : (a,) bool
        Whether the polynomial is positive on the side of the larger g.
    """

    cell: IntArray
    across: IntArray
    span: FloatArray
    ends: FloatArray
    rising: NDArray[np.bool_]

    def __attrs_post_init__(self) -> None:
        freeze(self.cell, self.across, self.span, self.ends, self.rising)

    def __len__(self) -> int:
        """Count the arcs."""
        return len(self.cell)
