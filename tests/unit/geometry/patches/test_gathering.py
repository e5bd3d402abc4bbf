"""Cells and arcs of chosen patches: those of each patch alone, in the order asked for."""

import attrs
import numpy as np
import pytest

from assoc_hull.geometry.patches.cells import SignCells, ZeroSetArcs, rows_of_groups, select_patches


def batch(counts: list[int], seed: int) -> tuple[SignCells, ZeroSetArcs]:
    """Cells with made-up contents: so many a patch, every other with a polynomial and an arc."""
    draw = np.random.default_rng(seed)
    patch = np.repeat(np.arange(len(counts)), counts)
    held = np.arange(len(patch)) % 2 == 0
    row = np.where(held, np.cumsum(held) - 1, -1)
    b = draw.normal(size=(held.sum(), 3, 4))
    cells = SignCells(
        patch, draw.random((len(patch), 2, 2)), draw.integers(0, 9, len(patch)),
        np.where(held, 2, 1), row, b, abs(b) * 1e-9, np.arange(len(counts)) % 3 == 0,
    )  # fmt: skip
    cell = np.flatnonzero(held)
    arcs = ZeroSetArcs(
        cell, cell % 2, draw.random((len(cell), 2)), draw.random((len(cell), 2, 2)), cell % 3 == 0
    )
    return cells, arcs


def contents(cells: SignCells, arcs: ZeroSetArcs, patch: int) -> list[object]:
    """All that is known of one patch, free of the numbers of rows."""
    own = np.flatnonzero(cells.patch == patch)
    found: list[object] = [bool(cells.stopped[patch])]
    for cell in own:
        held = cells.row[cell] >= 0
        polynomial = cells.b[cells.row[cell]].tolist() if held else None
        error = cells.err[cells.row[cell]].tolist() if held else None
        lines = [
            [np.asarray(value)[line].tolist() for value in attrs.astuple(arcs, recurse=False)[1:]]
            for line in np.flatnonzero(arcs.cell == cell)
        ]
        row = [cells.box[cell].tolist(), int(cells.level[cell]), int(cells.kind[cell])]
        found.append([*row, polynomial, error, lines])
    return found


@pytest.mark.parametrize(
    "chosen",
    [
        pytest.param([0, 1, 2, 3, 4], id="all as they are"),
        pytest.param([4, 0, 3], id="some in another order"),
        pytest.param([1, 1, 2, 1], id="one several times"),
        pytest.param([2], id="one without cells"),
        pytest.param([], id="none"),
    ],
)
def test_what_is_gathered_is_that_of_each_patch(chosen: list[int]) -> None:
    """Cells, polynomials and arcs of a patch stay together, out of two batches."""
    first, second = batch([3, 5, 0], 1), batch([4, 1], 2)
    cells, arcs = select_patches(
        [first[0], second[0]], [first[1], second[1]], np.array(chosen, np.intp)
    )
    each = [contents(*first, i) for i in range(3)] + [contents(*second, i) for i in range(2)]
    assert [contents(cells, arcs, i) for i in range(len(chosen))] == [each[i] for i in chosen]
    assert (np.diff(cells.patch) >= 0).all()
    assert sorted(set(cells.row.tolist()) - {-1}) == list(range(len(cells.b)))


def test_rows_of_groups_lie_in_the_order_asked_for() -> None:
    """Groups without rows give none."""
    rows, owner = rows_of_groups(np.array([2, 0, 3]), np.array([2, 1, 0, 2]))
    assert rows.tolist() == [2, 3, 4, 0, 1, 2, 3, 4]
    assert owner.tolist() == [0, 0, 0, 2, 2, 3, 3, 3]
