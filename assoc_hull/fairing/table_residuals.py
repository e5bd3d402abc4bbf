"""What is odd in a table of offsets: batten residuals, and rules on lone and doubled values.

A table is a field of numbers over stations x and waterlines z. Every five neighbouring cells of a
row or a column that are checked make a window; its residual r is how far a batten through them
springs (`assoc_hull.geometry.fairness.criteria`). Expected value e and scale s of a residual come
from the same window on the nearest lines on either side, so a bilge or a shoulder, which they have
too, is expected there. What one wrong number does to the windows that hold it is told by the
likelihood of all its residuals, each distributed as Cauchy's:

    score = sum log(1 + ((r - e) / s)^2)  -  the least such sum that another number in the cell has

What no batten finds in a table of offsets: lone values, shared factors, values typed twice.

Each rule looks at the numbers alone, and says what may have happened; none has a score.
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.fairness.criteria import WINDOW, batten_coefficients

__all__ = [
    "EQUAL",
    "LONE",
    "SHARED",
    "CellWindows",
    "TableMisfits",
    "TableRemark",
    "TableWindows",
    "best_change",
    "equal_neighbours",
    "lone_values",
    "multiplied_lines",
    "robust_scale",
    "shared_factors",
]

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


LONE, SHARED, EQUAL = "lone value", "shared factor", "equal neighbours"
"""The kinds of remarks."""


@attrs.frozen
class TableRemark:
    """What a rule says of a cell or a line of a table.

    Attributes
    ----------
    kind : str
        "lone value", "shared factor" or "equal neighbours".
    where : str
        Station and waterline.
    what : str
        A sentence with the numbers.
    amount : float
        The number that stands alone or twice, in the unit of the table; the factor.
    """

    kind: str
    where: str
    what: str
    amount: float

    def __str__(self) -> str:
        return f"{self.kind}: {self.where}: {self.what}"


_FEW = 5
"""Of fewer stations, or different numbers, no rule tells anything."""


def lone_values(y: FloatArray) -> tuple[tuple[int, int], ...]:
    """Find values above 0 between zeros or blanks, above and below or fore and aft; not at borders.

    Of y (s, w). Above and below one of the two must be a zero: between blanks a section is a point,
    as at the end of a bulb. Fore and aft both must be zeros, and the table have five stations.
    """
    zero, wide = y == 0.0, np.nan_to_num(y) > 0.0
    found = np.zeros(y.shape, bool)
    low, high = ~wide[:, :-2], ~wide[:, 2:]
    found[:, 1:-1] = wide[:, 1:-1] & low & high & (zero[:, :-2] & zero[:, 2:])
    blank_too = wide[:, 1:-1] & low & high & (zero[:, :-2] | zero[:, 2:])
    along = np.zeros(y.shape, bool)
    along[1:-1] = ~wide[:-2] & ~wide[2:]
    found[:, 1:-1] |= blank_too & along[:, 1:-1]
    if len(y) >= _FEW:
        found[1:-1] |= wide[1:-1] & zero[:-2] & zero[2:]
    return _cells(found)


_BY_CHANCE = 1e-4
"""A factor is told where so many numbers would share it by chance in fewer tables than this."""

_BY_HAND = (1, 2, 5, 10, 20, 25, 50, 100)
"""What a hand doubles by, or reads to; other factors come of formulas."""

_LINES = 0.1
"""And where at most this part of the rows, or of the columns, have one, but always one of them."""


def shared_factors(whole: FloatArray) -> tuple[tuple[int, int, int], ...]:
    """Find rows and columns all of whose numbers are multiples of one that those of others are not.

    `whole` (s, w): the numbers in units of their last digit, nan for blanks. Gives axis (0 a row),
    number of the line, and factor. A flat's number, which repeats, counts once.
    """
    found = []
    general = _factor(np.unique(whole[whole > 0.0]))
    for axis, lines in enumerate((whole, whole.T)):
        alike = []
        for k, line in enumerate(lines):
            others = np.delete(lines, k, axis=0)
            numbers = np.unique(line[line > 0.0])
            factor = max(each for each in _BY_HAND if _factor(numbers) % each == 0)
            likely = float(factor) ** -len(numbers) * len(lines)
            if len(numbers) >= _FEW and factor > general and likely < _BY_CHANCE:
                rest = others[others > 0.0]
                # A coarser unit of some lines is how a table is printed, not a slip.
                if np.mean(np.mod(rest, factor) == 0.0) < 0.5:
                    alike.append((axis, k, factor))
        # Many lines with factors of their own are numbers of a formula.
        found += alike if len(alike) <= max(1.0, _LINES * len(lines)) else []
    return tuple(found)


def _factor(numbers: FloatArray) -> int:
    """Give the greatest common divisor of whole numbers, 1 of none."""
    return int(np.gcd.reduce(np.round(numbers).astype(np.int64))) if len(numbers) else 1


_TIMES, _EVEN, _NUMBERS = np.log(1.3), 0.1, 4
"""A line is told if at least so many numbers of it are larger or smaller than the lines beside ask
for by more than this, and by the same within a tenth in the median: logarithms of ratios."""


def multiplied_lines(windows: TableWindows, y: FloatArray) -> tuple[tuple[int, int, float], ...]:
    """Find rows and columns all of whose numbers are some times what the lines beside ask for.

    `y` is the flattened table. Gives axis (0 a row), number of the line, and how many times; of
    lines near one another that which is farthest off, as it makes the others seem so.
    """
    residual = (y[windows.cells] * windows.coefficients).sum(axis=1)
    centre = windows.cells[:, WINDOW // 2]
    wanted = y[centre] - residual / windows.coefficients[:, WINDOW // 2]
    good = (wanted > 0.0) & (y[centre] > 0.0)
    ratio = np.log(np.where(good, y[centre], 1.0) / np.where(good, wanted, 1.0))
    lines = np.array(np.divmod(centre, windows.shape[1]))
    found = []
    for axis in (0, 1):
        off = np.zeros(windows.shape[axis])
        for k in range(len(off)):
            own = ratio[good & (windows.along == axis) & (lines[axis] == k)]
            middle = float(np.median(own)) if len(own) >= _NUMBERS else 0.0
            even = float(np.median(np.abs(own - middle))) < _EVEN if len(own) else False
            off[k] = middle if even and abs(middle) > _TIMES else 0.0
        for k in np.argsort(-np.abs(off), kind="stable").tolist():
            if off[k] != 0.0:
                found.append((axis, k, float(np.exp(off[k]))))
                off[max(k - 2, 0) : k + 3] = 0.0
    return tuple(found)


_DIFFERENT = 0.01
"""Part of the largest number by which the cells beside two equal ones must differ."""


def equal_neighbours(
    y: FloatArray, unit: FloatArray, checked: NDArray[np.bool_]
) -> tuple[tuple[int, int, int], ...]:
    """Find equal numbers next to each other where those of the lines beside differ.

    Of y (s, w), rounded to `unit` (w,), and cells that are `checked`. Gives axis (0: the next is
    the next station), station and waterline of the first of the two.
    """
    least = max(_DIFFERENT * float(np.nanmax(y, initial=0.0)), 10.0 * float(unit.max(initial=0.0)))
    found = []
    for axis, (numbers, there) in enumerate(((y, checked), (y.T, checked.T))):
        pair = there[:-1] & there[1:]
        step = np.where(pair, np.diff(numbers, axis=0), np.nan)
        same = step[:, 1:-1] == 0.0
        one, other = step[:, :-2], step[:, 2:]
        differ = (np.minimum(np.abs(one), np.abs(other)) > least) & (one * other > 0.0)
        for i, j in _cells(same & differ):
            found.append((axis, i, j + 1) if axis == 0 else (axis, j + 1, i))
    return tuple(found)


def _cells(found: NDArray[np.bool_]) -> tuple[tuple[int, int], ...]:
    return tuple((int(i), int(j)) for i, j in np.argwhere(found))
