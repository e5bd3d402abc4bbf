"""What signs of coefficients prove of a cell, and what they do not."""

from fractions import Fraction
from math import comb

import numpy as np
import pytest
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.cell_subdivision import (
    cell_kinds,
    count_sign_changes,
    first_and_last,
    signs,
    subdivide_patches,
)
from assoc_hull.geometry.patches.cells import CellKind
from assoc_hull.geometry.patches.curvature_functions import IsoFunction

INNER, OUTER = np.zeros((1, 2, 2), bool), np.ones((1, 2, 2), bool)
WAVE = np.array([-1.0, -2.0, 3.0, 1.0])


def kind(b: FloatArray, err: float, outer: NDArray[np.bool_] = INNER) -> CellKind:
    """What is proved of one cell."""
    return CellKind(int(cell_kinds(b[None], np.full((1, *b.shape), err), outer)[0]))


@pytest.mark.parametrize(
    ("step", "found"),
    [(0.0, 4), (1.5e-9, 4), (2.5e-9, 2), (-1.5e-9, 4), (-2.5e-9, 2)],
    ids=["none", "below both errors", "above both errors", "falling, below", "falling, above"],
)
def test_differences_must_exceed_the_errors_of_both_ends(step: float, found: int) -> None:
    """A slope that rounding could have made is no proof that lines meet the zero set once."""
    assert kind(np.stack([WAVE, WAVE + step]), 1e-9) == found


def test_an_edge_that_changes_sign_twice_proves_nothing() -> None:
    """Lines meet the zero set once, but there may be two arcs."""
    edge = np.array([-1.0, 2.0, -1.0])
    assert kind(np.stack([edge - 2.0, edge]), 1e-9) == CellKind.UNRESOLVED
    assert kind(np.stack([edge, edge + 2.0]), 1e-9) == CellKind.UNRESOLVED


@pytest.mark.parametrize("value", [0.0, 5e-10, -5e-10])
def test_a_shared_edge_must_have_signs(value: float) -> None:
    """A coefficient in the dead band on an edge with a neighbour leaves the cell undecided."""
    b = np.ones((4, 4))
    b[1, 1] = value
    assert kind(b, 1e-9) == CellKind.POSITIVE
    b[0, 1] = value
    assert kind(b, 1e-9) == CellKind.UNRESOLVED
    assert kind(b, 1e-9, OUTER) == CellKind.POSITIVE
    only = INNER.copy()
    only[0, 0, 0] = True
    assert kind(b, 1e-9, only) == CellKind.POSITIVE
    assert kind(b.T, 1e-9, only) == CellKind.UNRESOLVED


@pytest.mark.parametrize("corner", [(0, 0), (0, -1), (-1, 0), (-1, -1)])
def test_a_shared_corner_must_have_a_sign(corner: tuple[int, int]) -> None:
    """An arc that may or may not cut the corner of a cell leaves it undecided, but at a patch's."""
    u, v = np.mgrid[0:3, 0:3] - 1.0
    b = u + 0.5 * v + 0.05
    b -= b[corner]
    b[corner] = 1e-10
    far = INNER.copy()
    far[0, 0, corner[0]] = far[0, 1, corner[1]] = True
    assert kind(b, 1e-9) == CellKind.UNRESOLVED
    assert kind(b, 1e-9, far) != CellKind.UNRESOLVED
    far[0, 1] = False
    assert kind(b, 1e-9, far) == CellKind.UNRESOLVED


def test_the_dead_band_is_passed_over() -> None:
    """Coefficients without a sign neither make a change nor hide one."""
    b = np.array([[0.0, 1.0, 0.0, 2.0, 0.0], [0.0, 1.0, 0.0, -2.0, 0.0], [0.0] * 5])
    s = signs(b, np.full(b.shape, 0.5))
    assert count_sign_changes(s).tolist() == [0, 1, 0]
    first, last = first_and_last(s)
    assert (first.tolist(), last.tolist()) == ([1, 1, 0], [1, -1, 0])


def exactly(b: FloatArray, low: float, high: float) -> list[list[Fraction]]:
    """The rows of coefficients on [low, high], in whole numbers."""
    start, end = Fraction(low), Fraction(high)
    whole = [[Fraction(value) for value in row] for row in b.tolist()]
    for at, kept in ((end, 0), (start / end, 1)):
        degree = len(whole) - 1
        parts = []
        for i in range(degree + 1):
            order, first = (i, 0) if kept == 0 else (degree - i, i)
            weight = [comb(order, j) * at**j * (1 - at) ** (order - j) for j in range(order + 1)]
            columns = range(len(whole[0]))
            parts.append(
                [sum((w * whole[first + j][c] for j, w in enumerate(weight)), Fraction())
                 for c in columns]
            )  # fmt: skip
        whole = parts
    return whole


def test_errors_of_cells_cover_what_cutting_rounds() -> None:
    """Coefficients in small cells, against whole numbers, are off by less than is told, not nil."""
    b = np.random.default_rng(2).normal(size=(1, 8, 1))
    b = b * np.ones((1, 8, 4)) + np.random.default_rng(3).normal(size=(1, 8, 4))
    cells = subdivide_patches(IsoFunction(b, np.zeros_like(b)), depth=6)
    rows = np.flatnonzero(cells.row >= 0)[::5]
    worst = 0.0
    for row in rows.tolist():
        (u, v), found = cells.box[row], cells.b[cells.row[row]]
        part = exactly(b[0], *u)
        exact = exactly(np.array(part, object).T, *v)
        off = np.array([[float(x) for x in line] for line in exact]).T - found
        err = cells.err[cells.row[row]]
        assert (np.abs(off) <= err).all()
        worst = max(worst, float(np.abs(off).max()))
    assert 0.0 < worst < 1e-14
