"""Batten residuals along the rows and columns of a table, and what the lines beside say of them.

A table is a field of numbers over stations x and waterlines z. Every five neighbouring cells of a
row or a column that are checked make a window; its residual r is how far a batten through them
springs (`assoc_hull.geometry.fairness.batten`). Expected value e and scale s of a residual come
from the same window on the nearest lines on either side, so a bilge or a shoulder, which they have
too, is expected there. What one wrong number does to the windows that hold it is told by the
likelihood of all its residuals, each distributed as Cauchy's:

    score = sum log(1 + ((r - e) / s)^2)  -  the least such sum that another number in the cell has
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.fairness.batten import WINDOW, batten_coefficients

__all__ = ["CellWindows", "TableMisfits", "TableWindows", "best_change", "robust_scale"]

_BESIDE = np.array([-1, 1, -2, 2, -3, 3])
"""The lines that are asked for a residual, nearest first; four of them for its expected value."""

_FOUR, _ENOUGH = 4, 3
"""Fewer lines than this have no say: the residual is expected to be 0."""

_SPREAD, _ROUNDED = 1.5, 1.4
"""A scale is this many times the median deviation, and at least so many units of rounding."""

_WEIGHTY = 0.2
"""A window with a smaller coefficient of a cell does not tell what the number in it should be."""


@attrs.frozen(eq=False)
class CellWindows:
    """The windows that hold each cell, (cells, k): their numbers, -1 for none, and coefficients."""

    window: IntArray
    coefficient: FloatArray


@attrs.frozen(eq=False)
class TableMisfits:
    """What each cell of a table is off, all (cells,), in the unit of the table.

    Attributes
    ----------
    score : array
        How much likelier all residuals become with another number in the cell.
    change : array
        What is to be added to the number in it to that end.
    off, scale, coefficient : (cells, k)
        r - e and s of the windows of each cell, 0 and 1 where there is none; its coefficients.
    """

    score: FloatArray
    change: FloatArray
    off: FloatArray
    scale: FloatArray
    coefficient: FloatArray

    def left(self, cell: int, changes: FloatArray) -> FloatArray:
        """Give the sum that is left of one cell with changes (n,) of its number, (n,)."""
        moved = self.off[cell] + changes[:, None] * self.coefficient[cell]
        found: FloatArray = np.log1p((moved / self.scale[cell]) ** 2).sum(axis=1)
        return found


@attrs.frozen(eq=False)
class TableWindows:
    """All windows of a table.

    Attributes
    ----------
    shape : (int, int)
        Stations and waterlines.
    cells : (n, 5)
        The cells of each window, by their number in the flattened table.
    coefficients : (n, 5)
    along : (n,)
        0 for a window along x, 1 for one along z.
    beside : (n, 6)
        The same window on the lines beside it, -1 where there is none.
    unit : (n,)
        The coarsest rounding among the cells of each window.
    """

    shape: tuple[int, int]
    cells: IntArray
    coefficients: FloatArray
    along: IntArray
    beside: IntArray
    unit: FloatArray

    @classmethod
    def of(
        cls, x: FloatArray, z: FloatArray, checked: NDArray[np.bool_], unit: FloatArray
    ) -> TableWindows:
        """Find the windows of a table whose cells are `checked` (s, w) and rounded to `unit` (w,).

        Stations x (s,) and waterlines z (w,) ascend, in any unit.
        """
        number = np.arange(checked.size).reshape(checked.shape)
        found: list[tuple[IntArray, ...]] = []
        coefficients: list[FloatArray] = []
        count = 0
        for along, (places, inside, cell) in enumerate(
            ((x, checked, number), (z, checked.T, number.T))
        ):
            if len(places) < WINDOW:
                continue
            whole = np.asarray(sliding_window_view(inside, WINDOW, axis=0).all(axis=2))
            start, line = np.nonzero(whole)
            own = np.full((whole.shape[0], whole.shape[1] + 6), -1)
            own[start, line + 3] = count + np.arange(len(start))
            cells = cell[start[:, None] + np.arange(WINDOW), line[:, None]]
            beside = own[start[:, None], line[:, None] + 3 + _BESIDE]
            found.append((cells, np.full(len(start), along), beside))
            coefficients.append(batten_coefficients(sliding_window_view(places, WINDOW))[start])
            count += len(start)
        none = (np.zeros((0, WINDOW), int), np.zeros(0, int), np.zeros((0, len(_BESIDE)), int))
        cells, along_of, beside = (np.concatenate(each) for each in zip(none, *found, strict=True))
        rounded = np.broadcast_to(unit, checked.shape).ravel()[cells].max(axis=1, initial=0.0)
        weights = np.concatenate([np.zeros((0, WINDOW)), *coefficients])
        return cls((checked.shape[0], checked.shape[1]), cells, weights, along_of, beside, rounded)

    def of_cells(self) -> CellWindows:
        """Turn the windows round: give those that hold each cell."""
        size = self.shape[0] * self.shape[1]
        flat = self.cells.ravel()
        order = np.argsort(flat, kind="stable")
        first = np.searchsorted(flat[order], np.arange(size))
        place = np.arange(len(flat)) - first[flat[order]]
        window = np.full((size, 2 * WINDOW), -1)
        coefficient = np.zeros((size, 2 * WINDOW))
        window[flat[order], place] = order // WINDOW
        coefficient[flat[order], place] = self.coefficients.ravel()[order]
        return CellWindows(window, coefficient)

    def directions(self, held: CellWindows) -> NDArray[np.bool_]:
        """Tell of each cell whether windows along x and along z tell its number, (cells, 2)."""
        if not len(self.along):
            return np.zeros((len(held.window), 2), bool)
        telling = (held.window >= 0) & (np.abs(held.coefficient) > _WEIGHTY)
        along = self.along[held.window]
        return np.column_stack([(telling & (along == each)).any(axis=1) for each in (0, 1)])

    def off(self, y: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give what residuals are off what is expected of them, and their scales, (n,) each.

        `y` is the flattened table; what stands in cells that are not checked is not looked at.
        """
        residual = (y[self.cells] * self.coefficients).sum(axis=1)
        expected, scale = robust_scale(residual, self.beside, self.unit)
        return residual - expected, scale

    def misfits(self, y: FloatArray, held: CellWindows) -> TableMisfits:
        """Give what every cell of a flattened table (cells,) is off, and the change it wants."""
        size = len(held.window)
        if not len(self.cells):
            none = np.zeros((size, 1))
            return TableMisfits(none[:, 0], none[:, 0], none, none + 1.0, none)
        r, s = self.off(y)
        there = held.window >= 0
        off = np.where(there, r[held.window], 0.0)
        scale = np.where(there, s[held.window], 1.0)
        score, change = best_change(off, scale, held.coefficient)
        return TableMisfits(score, change, off, scale, held.coefficient)


def robust_scale(
    residual: FloatArray, beside: IntArray, unit: FloatArray | float
) -> tuple[FloatArray, FloatArray]:
    """Give what is expected of residuals (r,) and their scales, by those beside each, (r, 6).

    `beside` holds them nearest first, -1 for none; `unit` is the rounding of each.
    """
    there = beside >= 0
    near = np.where(there, residual[beside], np.nan)
    told = (there.sum(axis=1) >= _ENOUGH) & there[:, :_FOUR].any(axis=1)
    # Where fewer lines are told, 0 is expected, and the size of their residuals is the scale.
    expected = np.where(told, _median(np.where(told[:, None], near[:, :_FOUR], 0.0)), 0.0)
    some = np.asarray(there.any(axis=1))
    deviation = np.abs(near - expected[:, None])
    spread = _SPREAD * _median(np.where(some[:, None], deviation, 0.0))
    spread = np.where(some, spread, spread.max(initial=0.0))
    return expected, np.hypot(spread, _ROUNDED * unit)


_AT_ONCE = 1_000_000
"""So many residuals are tried with all changes at once: 8 MB of numbers."""


_TRIED = 12
"""Changes that are tried: those that put the residuals with the largest coefficients right."""


def best_change(
    off: FloatArray, scale: FloatArray, coefficient: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Give score and change of points, (n,) each: the best of those that put one residual right.

    Of (n, k) residuals of each point: what they are off, their scales, and their coefficients of
    the point's change, 0 for none.
    """
    step = max(_AT_ONCE // (_TRIED * coefficient.shape[1]), 1)
    parts = [
        _best_of(off[part], scale[part], coefficient[part])
        for part in (slice(k, k + step) for k in range(0, len(off), step))
    ]
    score, change = (np.concatenate(each) for each in zip(*parts, strict=True))
    return score, change


def _best_of(
    off: FloatArray, scale: FloatArray, coefficient: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Give score and change of some points, all their residuals with all changes at once."""
    count = min(_TRIED, coefficient.shape[1])
    weightiest = np.argsort(-np.abs(coefficient), axis=1, kind="stable")[:, :count]
    weight = np.take_along_axis(coefficient, weightiest, axis=1)
    telling = np.abs(weight) > _WEIGHTY
    wanted = -np.take_along_axis(off, weightiest, axis=1) / np.where(telling, weight, np.inf)
    moved = off[:, None, :] + wanted[:, :, None] * coefficient[:, None, :]
    left = np.log1p((moved / scale[:, None, :]) ** 2).sum(axis=2)
    left = np.where(telling, left, np.inf)
    best = left.argmin(axis=1)
    rows = np.arange(len(off))
    least = left[rows, best]
    told = np.isfinite(least)
    whole = np.log1p((off / scale) ** 2).sum(axis=1)
    score = np.where(told, whole - np.where(told, least, 0.0), 0.0)
    return score, np.where(told, wanted[rows, best], 0.0)


def _median(rows: FloatArray) -> FloatArray:
    """Give the median of each row of (n, k), nan left out; at least one is no nan.

    As `numpy.nanmedian`, in a fifth of its time for rows this short.
    """
    ordered = np.sort(rows, axis=1)  # nan last
    count = np.count_nonzero(np.isfinite(ordered), axis=1)
    at = np.arange(len(rows))
    found: FloatArray = 0.5 * (ordered[at, (count - 1) // 2] + ordered[at, count // 2])
    return found
