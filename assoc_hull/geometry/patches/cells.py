"""Cells of patches in which a sign is known, or changes along one arc; and a choice of them.

`SignCells` cover all patches of a batch, `ZeroSetArcs` are the arcs within them.
`select_patches` takes the cells and arcs of some patches out of one batch or of several.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.cells import rows_of_groups
>>> rows_of_groups(np.array([2, 0, 3]), np.array([2, 0]))
(array([2, 3, 4, 0, 1]), array([0, 0, 0, 1, 1]))
"""

from __future__ import annotations

from collections.abc import Sequence
from enum import IntEnum

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze

__all__ = [
    "CellKind",
    "SignCells",
    "ZeroSetArcs",
    "rows_of_groups",
    "select_patches",
]


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
        """Whether the polynomial has one sign, or is zero, in the whole cell."""
        return -1 <= self.value <= 1


@attrs.frozen(eq=False)
class SignCells:
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
class ZeroSetArcs:
    """Arcs of the zero set, one a row, each in one simple cell.

    Attributes
    ----------
    cell : (a,) int
        The row of `SignCells`.
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


def rows_of_groups(counts: IntArray, chosen: IntArray) -> tuple[IntArray, IntArray]:
    """Give the rows (r,) of chosen groups, which lie one behind the other with `counts` rows (g,).

    Also, for each row, the place of its group in `chosen`, (r,); one may be chosen several times.
    """
    start = np.cumsum(counts) - counts
    sizes = counts[chosen]
    owner = np.repeat(np.arange(len(chosen)), sizes)
    within = np.arange(len(owner)) - np.repeat(np.cumsum(sizes) - sizes, sizes)
    return start[chosen][owner] + within, owner


def select_patches(
    cells: Sequence[SignCells], arcs: Sequence[ZeroSetArcs], chosen: IntArray
) -> tuple[SignCells, ZeroSetArcs]:
    """Give cells and arcs of chosen patches.

    What is found for a patch does not depend on its neighbours in the batch; so results of several
    batches may be put together as if they had been one.

    Parameters
    ----------
    cells : sequence of SignCells
        Batches for polynomials of one degree; the cells of each in the order of their patches.
    arcs : sequence of ZeroSetArcs
        The arcs of each batch, in the order of their cells.
    chosen : (k,) int
        Patches, numbered through all batches, in the order they are wanted.

    Returns
    -------
    cells : SignCells
        Patch ``i`` is ``chosen[i]``; polynomials lie in the order of their cells.
    arcs : ZeroSetArcs
        Their arcs.
    """
    many, lines = _one_behind_the_other(cells, arcs)
    counts = np.bincount(many.patch, minlength=len(many.stopped))
    rows, owner = rows_of_groups(counts, chosen)
    polynomial = many.row[rows]
    held = polynomial >= 0
    row = np.where(held, np.cumsum(held) - 1, -1)
    used = polynomial[held]
    found = SignCells(
        owner, many.box[rows], many.level[rows], many.kind[rows], row,
        many.b[used], many.err[used], many.stopped[chosen],
    )  # fmt: skip
    return found, _gathered_arcs(lines, many, chosen, counts)


def _gathered_arcs(
    arcs: ZeroSetArcs, cells: SignCells, chosen: IntArray, cell_counts: IntArray
) -> ZeroSetArcs:
    """Give the arcs of chosen patches, with the rows their cells have come to."""
    patch = cells.patch[arcs.cell]
    rows, owner = rows_of_groups(np.bincount(patch, minlength=len(cells.stopped)), chosen)
    before = np.cumsum(cell_counts) - cell_counts
    after = np.cumsum(cell_counts[chosen]) - cell_counts[chosen]
    cell = arcs.cell[rows] - before[patch[rows]] + after[owner]
    return ZeroSetArcs(cell, arcs.across[rows], arcs.span[rows], arcs.ends[rows], arcs.rising[rows])


def _one_behind_the_other(
    cells: Sequence[SignCells], arcs: Sequence[ZeroSetArcs]
) -> tuple[SignCells, ZeroSetArcs]:
    """Make one batch of several."""
    if len(cells) == 1:
        return cells[0], arcs[0]
    patches = np.cumsum([0, *(len(each.stopped) for each in cells[:-1])])
    rows = np.cumsum([0, *(len(each.b) for each in cells[:-1])])
    counts = np.cumsum([0, *(len(each) for each in cells[:-1])])
    moved = [
        attrs.evolve(each, patch=each.patch + p, row=np.where(each.row >= 0, each.row + r, -1))
        for each, p, r in zip(cells, patches, rows, strict=True)
    ]
    lines = [attrs.evolve(each, cell=each.cell + c) for each, c in zip(arcs, counts, strict=True)]
    return SignCells(*_joined(moved)), ZeroSetArcs(*_joined(lines))


def _joined(tables: Sequence[SignCells] | Sequence[ZeroSetArcs]) -> list[np.ndarray]:
    """Put the columns of tables one behind the other."""
    columns = zip(*(attrs.astuple(each, recurse=False) for each in tables), strict=True)
    return [np.concatenate(column) for column in columns]
