"""The doctor of offsets: which numbers of a table may be slips of the hand, and what was meant.

Every cell is judged by the windows that hold it (`assoc_hull.fairing.table_residuals`); the worst
is put right and the search repeated while scores are above the alarm, so that one wrong number is
told once and hides no other. Beside the number that the lines ask for stand those that one slip
makes of the printed one and that fit them as well.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from itertools import pairwise

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.display import ShownAsText, counted
from assoc_hull.fairing.table_residuals import (
    EQUAL,
    LONE,
    SHARED,
    CellWindows,
    TableMisfits,
    TableRemark,
    TableWindows,
    equal_neighbours,
    lone_values,
    multiplied_lines,
    shared_factors,
)
from assoc_hull.geometry.curves import FloatArray

__all__ = [
    "ALARM",
    "DoctorReport",
    "OffsetFinding",
    "PrintedOffsets",
    "SlipNumber",
    "checked_directions",
    "examine",
    "exchanged_digits",
    "moved_points",
    "other_digits",
    "single_slips",
]

# --------------------------------------------------------------------------------------
# The numbers that one slip of the hand makes of a printed one, or makes it of.
#
# A slip goes both ways: whoever typed 3258 for 3528 exchanged two digits, and exchanging them again
# gives the number that was meant.

SLIPS = ("two digits exchanged", "one digit other", "decimal point", "the cell beside")
"""What may have happened, the commonest first, as it is told."""


def exchanged_digits(text: str) -> tuple[str, ...]:
    """Give the numbers with two neighbouring digits exchanged, the point between them or not."""
    digits = _digits(text)
    found = []
    for a, b in pairwise(digits):
        if text[a] != text[b]:
            found.append(f"{text[:a]}{text[b]}{text[a + 1 : b]}{text[a]}{text[b + 1 :]}")
    return tuple(each for each in found if _natural(each, text))


def other_digits(text: str) -> tuple[str, ...]:
    """Give the numbers with one digit in place of another."""
    found = [
        f"{text[:k]}{digit}{text[k + 1 :]}"
        for k in _digits(text) for digit in "0123456789" if digit != text[k]
    ]  # fmt: skip
    return tuple(each for each in found if _natural(each, text))


_PLACES = 3

_DECIMAL = re.compile(r"(-?)([0-9]*)(?:\.([0-9]*))?")


def moved_points(text: str) -> tuple[str, ...]:
    """Give the numbers with the decimal point up to three places farther left and right.

    A point that was forgotten has moved by as many places as there are decimals.
    """
    found = _DECIMAL.fullmatch(text)
    if found is None or not _digits(text):
        return ()
    sign, whole, part = found[1], found[2], found[3] or ""
    moved = []
    for by in range(1, _PLACES + 1):
        before = whole.rjust(by + 1, "0")
        moved.append(f"{sign}{before[:-by]}.{before[-by:]}{part}")
        after = part.ljust(by, "0")
        right = f"{whole}{after[:by]}".lstrip("0") or "0"
        moved.append(f"{sign}{right}.{after[by:]}" if after[by:] else f"{sign}{right}")
    return tuple(moved)


def single_slips(text: str, beside: tuple[str, ...]) -> tuple[tuple[str, str], ...]:
    """Give every number that one slip makes of a printed one, each with what the slip was.

    `beside` are the numbers in the cells beside. A number that two slips make is that of the
    commoner one.
    """
    every = (exchanged_digits(text), other_digits(text), moved_points(text), beside)
    found: dict[str, str] = {}
    for slip, numbers in zip(SLIPS, every, strict=True):
        for number in numbers:
            if number != text:
                found.setdefault(number, slip)
    return tuple(found.items())


def _digits(text: str) -> list[int]:
    """Give where the digits stand; none of a number with a power of ten, which no hand types."""
    if "e" in text.lower():
        return []
    return [k for k, letter in enumerate(text) if letter.isdigit()]


def _natural(text: str, printed: str) -> bool:
    """Tell whether a number begins as no printed one does: with a 0 before another digit."""
    return not re.match(r"-?0[0-9]", text) or bool(re.match(r"-?0[0-9]", printed))


ALARM = 15.0
"""A score above this is called a slip: no sound table that was tried has one."""

_SOME = 1.0
"""A score below this is rounding."""

_MOST = 50
"""So many slips are called; a table with more has lost whole rows or columns."""

_NUMBERS = 3
"""So many numbers of one slip are told."""

_AS_GOOD, _SHARE = 6.0, 0.4
"""A number fits as well as the best one if its score is less by at most this, and this part."""

_FINEST = 5e-5
"""No lines are fairer than this part of the largest offset, with however many digits printed."""


@attrs.frozen(eq=False)
class PrintedOffsets:
    """A table of half-breadths as it is printed.

    Attributes
    ----------
    name : str
        Of the table or its file.
    unit : str
        Of the numbers, "" where nothing says it.
    stations, waterlines : tuple of str
        Names as printed.
    x : (s,)
    z : (w,)
        Places, both ascending; in any unit.
    y : (s, w)
        Half-breadths, nan for blanks.
    step : (w,)
        What the last printed digit of a waterline is worth in units of `y`.
    worth : (w,)
        Units of `y` to one of the printed numbers.
    text : tuple of tuple of str
        The cells as printed, (s, w).
    read, write : callable
        Number of a cell as printed, None where it is none; and a number, of a waterline, as it is
        printed there.
    """

    name: str
    unit: str
    stations: tuple[str, ...]
    waterlines: tuple[str, ...]
    x: FloatArray
    z: FloatArray
    y: FloatArray
    step: FloatArray
    worth: FloatArray
    text: tuple[tuple[str, ...], ...]
    read: Callable[[str], float | None]
    write: Callable[[float, int], str]

    def where(self, i: int, j: int) -> str:
        """Name a cell."""
        return f"station {self.stations[i]}, waterline {self.waterlines[j]}"


@attrs.frozen
class SlipNumber:
    """A number that was perhaps meant: as it would be printed, and what happened to it."""

    text: str
    slip: str


@attrs.frozen(repr=False)
class OffsetFinding(ShownAsText):
    """A number of a table that its neighbours do not bear out.

    Attributes
    ----------
    station, waterline : str
        Names as printed.
    row, column : int
        The same by number: stations from aft to forward or as they ascend, waterlines upward.
    printed : str
        The cell as printed.
    proposed : str
        The number that its neighbours ask for, as it would be printed.
    off : float
        Printed less proposed, in the unit of the table.
    score : float
        How much likelier all residuals become with another number; above 15 it is called a slip.
    numbers : tuple of SlipNumber
        Up to three numbers that one slip makes of the printed one and that fit; the likeliest slip
        first.
    both : bool
        Whether lines in both directions tell it; False: those along station or waterline only.
    """

    station: str
    waterline: str
    row: int
    column: int
    printed: str
    proposed: str
    off: float
    score: float
    numbers: tuple[SlipNumber, ...]
    both: bool

    @property
    def alarm(self) -> bool:
        """Whether it is called a slip."""
        return self.score > ALARM

    @property
    def mended(self) -> str:
        """The likeliest number: that of the first slip, else the one its neighbours ask for."""
        return self.numbers[0].text if self.numbers else self.proposed

    def __str__(self) -> str:
        text = (
            f"score {self.score:.1f}: station {self.station}, waterline {self.waterline}: printed "
            f"{self.printed}, its neighbours ask for {self.proposed} ({-self.off:+.4g})"
        )
        for number in self.numbers:
            text += f"; {number.text}: {number.slip}"
        return text if self.both else f"{text}; told in one direction only"


@attrs.frozen(repr=False)
class DoctorReport(ShownAsText):
    """What the doctor of offsets found; nothing was changed.

    Attributes
    ----------
    name, unit : str
        Of the table; the unit of its numbers, "" where nothing says it.
    findings : tuple of OffsetFinding
        All that are called slips, and the next highest scores; the worst first, each cell once.
    remarks : tuple of TableRemark
        What rules say: lone values, shared factors, equal neighbours.
    both, single : int
        Cells that were checked in both directions, and in one.
    unchecked : tuple of str
        Cells with a number that no line tells: in corners, beside blanks and zeros.
    written : str
        The mended table, if one was written.
    """

    name: str
    unit: str
    findings: tuple[OffsetFinding, ...]
    remarks: tuple[TableRemark, ...]
    both: int
    single: int
    unchecked: tuple[str, ...]
    written: str = ""

    @property
    def alarms(self) -> tuple[OffsetFinding, ...]:
        """The findings that are called slips."""
        return tuple(each for each in self.findings if each.alarm)

    @property
    def overrun(self) -> bool:
        """Whether so many slips are called, 50, that the search was given up."""
        return len(self.alarms) >= _MOST

    def __str__(self) -> str:
        unit = f" ({self.unit})" if self.unit else ""
        lines = [f"{self.name}{unit}: {counted(len(self.alarms), 'slip')} called (score above 15)"]
        lines += [f"  {each}" for each in self.alarms]
        if self.overrun:
            lines.append("  and more: whole rows or columns are wrong, put them right first")
        if not self.both + self.single:
            lines.append("  no five neighbouring cells hold numbers: nothing could be checked")
        rest = [each for each in self.findings if not each.alarm]
        if rest:
            lines += ["not called, the highest scores", *(f"  {each}" for each in rest)]
        if self.remarks:
            lines += [f"by rule ({len(self.remarks)})", *(f"  {each}" for each in self.remarks)]
        lines.append(
            f"checked: {counted(self.both, 'cell')} in both directions, {self.single} in one; "
            f"not checked: {len(self.unchecked)}"
        )
        if self.unchecked:
            more = len(self.unchecked) - _NAMED
            shown = "; ".join(self.unchecked[:_NAMED])
            lines.append(f"  {shown}" + (f"; and {more} more" if more > 0 else ""))
        if self.written:
            lines.append(f"mended: {self.written}")
            lines += [
                f"  station {each.station}, waterline {each.waterline}: {each.printed} to "
                f"{each.mended}" for each in self.alarms
            ]  # fmt: skip
        return "\n".join(lines)


_NAMED = 4
"""So many cells that were not checked are named in the text."""


def examine(table: PrintedOffsets, top: int = 10) -> DoctorReport:
    """Look for slips of the hand in a table; nothing is changed.

    `top`: so many findings are listed at least, if so many cells have a score; all that are called
    slips are.
    """
    checked, windows, held = _looked_through(table)
    told = windows.directions(held)
    findings = _findings(table, windows, held, told, top)
    single = told.any(axis=1) & ~told.all(axis=1)
    return DoctorReport(
        table.name,
        table.unit,
        findings,
        _remarks(table, checked, windows),
        int(told.all(axis=1).sum()),
        int(single.sum()),
        _unchecked(table, checked, np.asarray(told.any(axis=1)).reshape(checked.shape)),
    )


def checked_directions(table: PrintedOffsets) -> NDArray[np.bool_]:
    """Tell of each cell whether its waterline and its station tell its number, (s, w, 2)."""
    _, windows, held = _looked_through(table)
    return windows.directions(held).reshape((*table.y.shape, 2))


def _looked_through(
    table: PrintedOffsets,
) -> tuple[NDArray[np.bool_], TableWindows, CellWindows]:
    """Give the cells that are checked, (s, w), and the windows through them."""
    checked = _checked(table.y)
    finest = _FINEST * float(np.nanmax(table.y, initial=0.0))
    windows = TableWindows.of(table.x, table.z, checked, np.maximum(table.step, finest))
    return checked, windows, windows.of_cells()


def _checked(y: FloatArray) -> NDArray[np.bool_]:
    """Give the cells that lines run through: above 0, and zeros within the hull."""
    wide = np.nan_to_num(y) > 0.0
    within = np.zeros(y.shape, bool)
    within[1:-1, 1:-1] = wide[:-2, 1:-1] & wide[2:, 1:-1] & wide[1:-1, :-2] & wide[1:-1, 2:]
    found: NDArray[np.bool_] = wide | (within & (y == 0.0))
    return found


def _findings(
    table: PrintedOffsets, windows: TableWindows, held: CellWindows, told: NDArray[np.bool_],
    top: int,
) -> tuple[OffsetFinding, ...]:  # fmt: skip
    """Put the worst cell right while it is called a slip, then list the next highest scores."""
    y = np.nan_to_num(table.y).ravel()
    found: dict[int, OffsetFinding] = {}
    misfits = windows.misfits(y, held)
    while len(found) < _MOST:
        score = misfits.score.copy()
        score[list(found)] = 0.0
        cell = int(score.argmax())
        if score[cell] <= ALARM:
            break
        found[cell], change = _finding(table, misfits, cell, told)
        y[cell] += change
        misfits = windows.misfits(y, held)
    score = misfits.score.copy()
    score[list(found)] = 0.0
    for cell in np.argsort(-score, kind="stable")[: max(top - len(found), 0)].tolist():
        if score[cell] > _SOME:
            found[cell], _ = _finding(table, misfits, cell, told)
    return tuple(found.values())


def _finding(
    table: PrintedOffsets, misfits: TableMisfits, cell: int, told: NDArray[np.bool_]
) -> tuple[OffsetFinding, float]:
    """Give what is to be told of a cell, and what to add to its number so that it is right."""
    i, j = divmod(cell, table.y.shape[1])
    score, change = float(misfits.score[cell]), float(misfits.change[cell])
    printed = table.text[i][j]
    number = table.read(printed) or 0.0
    fitting = _fitting(table, misfits, cell, number)
    wanted = max(number + change / float(table.worth[j]), 0.0)
    proposed = table.write(wanted, j)
    finding = OffsetFinding(
        table.stations[i], table.waterlines[j], i, j, printed, proposed, number - wanted, score,
        tuple(SlipNumber(text, slip) for text, slip, _ in fitting), bool(told[cell].all()),
    )  # fmt: skip
    return finding, fitting[0][2] if fitting else change


def _fitting(
    table: PrintedOffsets, misfits: TableMisfits, cell: int, number: float
) -> list[tuple[str, str, float]]:
    """Give the numbers of one slip that fit as well as the best: text, slip and change of y."""
    i, j = divmod(cell, table.y.shape[1])
    every = single_slips(table.text[i][j], _beside(table, i, j))
    values = [table.read(text) for text, _ in every]
    read = [
        (text, slip, value) for (text, slip), value in zip(every, values, strict=True)
        if value is not None and value > 0.0
    ]  # fmt: skip
    if not read:
        return []
    changes = (np.array([value for *_, value in read]) - number) * float(table.worth[j])
    least = misfits.left(cell, np.array([misfits.change[cell]]))[0]
    left = misfits.left(cell, changes) - least
    score = float(misfits.score[cell])
    kept = [
        (SLIPS.index(slip), float(left[k]), text, slip, float(changes[k]))
        for k, (text, slip, _) in enumerate(read) if left[k] <= min(_AS_GOOD, _SHARE * score)
    ]  # fmt: skip
    return [(text, slip, change) for _, _, text, slip, change in sorted(kept)[:_NUMBERS]]


def _beside(table: PrintedOffsets, i: int, j: int) -> tuple[str, ...]:
    """Give the numbers above, below, aft and forward of a cell, as printed."""
    s, w = table.y.shape
    cells = ((i, j - 1), (i, j + 1), (i - 1, j), (i + 1, j))
    return tuple(table.text[a][b] for a, b in cells if 0 <= a < s and 0 <= b < w)


def _remarks(
    table: PrintedOffsets, checked: NDArray[np.bool_], windows: TableWindows
) -> tuple[TableRemark, ...]:
    found = []
    for axis, k, times in multiplied_lines(windows, np.nan_to_num(table.y).ravel()):
        line = f"waterline {table.waterlines[k]}" if axis else f"station {table.stations[k]}"
        what = f"its numbers are {times:.3g} times what the lines beside ask for: another unit?"
        found.append(TableRemark(SHARED, line, what, times))
    for i, j in lone_values(table.y):
        what = f"{table.text[i][j]} stands between zeros; a 10 typed for 0?"
        found.append(TableRemark(LONE, table.where(i, j), what, float(table.y[i, j])))
    for axis, k, factor in shared_factors(np.round(table.y / table.step)):
        line = f"waterline {table.waterlines[k]}" if axis else f"station {table.stations[k]}"
        digit = (table.step / table.worth)[k : k + 1] if axis else table.step / table.worth
        uneven = float(np.ptp(digit)) > 0.0
        of = f"{factor} last digits" if uneven else f"{factor * float(digit[0]):g}"
        what = f"all its numbers are multiples of {of}, others are not: doubled, or read coarser?"
        found.append(TableRemark(SHARED, line, what, float(factor)))
    for axis, i, j in equal_neighbours(table.y, table.step, checked):
        next_to = table.stations[i + 1] if axis == 0 else table.waterlines[j + 1]
        kind = "station" if axis == 0 else "waterline"
        what = f"{table.text[i][j]} stands at {kind} {next_to} too, where lines beside differ"
        twice = float(table.y[i, j])
        found.append(TableRemark(EQUAL, table.where(i, j), what, twice))
    return tuple(found)


def _unchecked(
    table: PrintedOffsets, checked: NDArray[np.bool_], told: NDArray[np.bool_]
) -> tuple[str, ...]:
    """Name the cells with a number that no window tells, with the reason."""
    s, w = checked.shape
    found = []
    for i, j in np.argwhere(checked & ~told).tolist():
        corner = i in (0, s - 1) and j in (0, w - 1)
        reason = "a corner" if corner else "beside blanks, zeros or the border"
        found.append(f"{table.where(i, j)} ({reason})")
    return tuple(found)
