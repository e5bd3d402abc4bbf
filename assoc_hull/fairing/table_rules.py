"""What no batten finds in a table of offsets: lone values, shared factors, values typed twice.

Each rule looks at the numbers alone, and says what may have happened; none has a score.
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.fairing.table_residuals import TableWindows
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.fairness.batten import WINDOW

__all__ = [
    "EQUAL",
    "LONE",
    "SHARED",
    "TableRemark",
    "equal_neighbours",
    "lone_values",
    "multiplied_lines",
    "shared_factors",
]


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
