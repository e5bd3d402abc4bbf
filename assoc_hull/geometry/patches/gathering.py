"""Cells and arcs of chosen patches, out of one batch or of several, in the order asked for.

What is found for a patch does not depend on its neighbours in the batch; so results of several
batches may be put together as if they had been one.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.gathering import rows_of
>>> rows_of(np.array([2, 0, 3]), np.array([2, 0]))
(array([2, 3, 4, 0, 1]), array([0, 0, 0, 1, 1]))
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.geometry.curves import IntArray
from assoc_hull.geometry.patches.cells import Arcs, Cells

__all__ = ["gathered", "rows_of"]


def rows_of(counts: IntArray, chosen: IntArray) -> tuple[IntArray, IntArray]:
    """Give the rows of chosen groups, of groups that lie one behind the other.

    Parameters
    ----------
    counts : (g,) int
        How many rows each group has.
    chosen : (k,) int
        Which groups, in which order; one may be chosen several times.

    Returns
    -------
    rows, owner : (r,) int
        The rows, and for each the place of its group in `chosen`.
    """
    start = np.cumsum(counts) - counts
    sizes = counts[chosen]
    owner = np.repeat(np.arange(len(chosen)), sizes)
    within = np.arange(len(owner)) - np.repeat(np.cumsum(sizes) - sizes, sizes)
    return start[chosen][owner] + within, owner


def gathered(cells: Sequence[Cells], arcs: Sequence[Arcs], chosen: IntArray) -> tuple[Cells, Arcs]:
    """Give cells and arcs of chosen patches.

    Parameters
    ----------
    cells : sequence of Cells
        Batches for polynomials of one degree; the cells of each in the order of their patches.
    arcs : sequence of Arcs
        The arcs of each batch, in the order of their cells.
    chosen : (k,) int
        Patches, numbered through all batches, in the order they are wanted.

    Returns
    -------
    cells : Cells
        Patch ``i`` is ``chosen[i]``; polynomials lie in the order of their cells.
    arcs : Arcs
        Their arcs.
    """
    many, lines = _one_behind_the_other(cells, arcs)
    counts = np.bincount(many.patch, minlength=len(many.stopped))
    rows, owner = rows_of(counts, chosen)
    polynomial = many.row[rows]
    held = polynomial >= 0
    row = np.where(held, np.cumsum(held) - 1, -1)
    used = polynomial[held]
    found = Cells(
        owner, many.box[rows], many.level[rows], many.kind[rows], row,
        many.b[used], many.err[used], many.stopped[chosen],
    )  # fmt: skip
    return found, _gathered_arcs(lines, many, chosen, counts)


def _gathered_arcs(arcs: Arcs, cells: Cells, chosen: IntArray, cell_counts: IntArray) -> Arcs:
    """Give the arcs of chosen patches, with the rows their cells have come to."""
    patch = cells.patch[arcs.cell]
    rows, owner = rows_of(np.bincount(patch, minlength=len(cells.stopped)), chosen)
    before = np.cumsum(cell_counts) - cell_counts
    after = np.cumsum(cell_counts[chosen]) - cell_counts[chosen]
    cell = arcs.cell[rows] - before[patch[rows]] + after[owner]
    return Arcs(cell, arcs.across[rows], arcs.span[rows], arcs.ends[rows], arcs.rising[rows])


def _one_behind_the_other(cells: Sequence[Cells], arcs: Sequence[Arcs]) -> tuple[Cells, Arcs]:
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
    return Cells(*_joined(moved)), Arcs(*_joined(lines))


def _joined(tables: Sequence[Cells] | Sequence[Arcs]) -> list[np.ndarray]:
    """Put the columns of tables one behind the other."""
    columns = zip(*(attrs.astuple(each, recurse=False) for each in tables), strict=True)
    return [np.concatenate(column) for column in columns]
