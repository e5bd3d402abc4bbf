"""Clean tables of offsets, slips of the hand planted in them, and what the doctor says of each.

Three tables are tried in full: both of Series 60 as printed, and the 207k carrier by its formula,
41 stations by 20 waterlines in mm. Ten more are slices of hulls of the program, in mm.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cache
from importlib.resources import files
from itertools import pairwise

import attrs
import numpy as np
from numpy.typing import NDArray

import assoc_hull as ah
from assoc_hull.errors import NoMeetingError
from assoc_hull.fairing.offsets_doctor import (
    ALARM,
    PrintedOffsets,
    checked_directions,
    examine,
)
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.io.offsets.read import read_printed
from assoc_hull.shipped import bulk_carrier_207k_form as form
from assoc_hull.shipped.series60 import todd_table

Random = np.random.Generator

SHIPS = ("wigley", "series60", "bulk_carrier_207k", "bulk_carrier_180m", "container_ship_225m")
SIZES = ((0.005, 0.020), (0.020, 0.050), (0.050, 0.200), (0.200, 100.0))
"""Of planted errors, m: from and below."""


@attrs.frozen(eq=False)
class TrialTable:
    """A table as printed, and metres to one of its units."""

    printed: PrintedOffsets
    metres: float


def table_text(x: FloatArray, z: FloatArray, y: FloatArray, write: Callable[[float], str]) -> str:
    """A table with stations by x."""
    rows = [
        f"{a:.9g}," + ",".join("" if np.isnan(each) else write(each) for each in row)
        for a, row in zip(x.tolist(), y.tolist(), strict=True)
    ]  # fmt: skip
    return "\n".join(["x_m," + ",".join(f"wl_{each:.9g}" for each in z.tolist()), *rows]) + "\n"


def in_mm(value: float) -> str:
    """A half-breadth, m, in whole millimetres."""
    return f"{1000.0 * value:.0f}"


@cache
def trial_tables() -> dict[str, TrialTable]:
    """The tables that slips are planted in."""
    found = {}
    for cb in (0.60, 0.70):
        data = files("assoc_hull.shipped") / "data" / f"series60_{round(100 * cb):03}.csv"
        printed = read_printed(data.read_text("utf-8"))[1]
        found[f"Series 60 {cb:.2f}"] = TrialTable(printed, todd_table(cb)[0].breadth / 2.0)
    x, z = np.linspace(0.0, 300.0, 41), np.linspace(0.0, 27.0, 20)
    y = form.carrier_half_breadth(*np.meshgrid(x, z, indexing="ij"))
    found["carrier"] = TrialTable(read_printed(table_text(x, z, y, in_mm))[1], 1e-3)
    return found


@cache
def slices() -> dict[str, PrintedOffsets]:
    """Ten clean tables: five hulls of the program, at 21 by 10 and at 41 by 16 places."""
    found = {}
    for ship in SHIPS:
        hull = getattr(ah.examples, ship)()
        sizes = hull.particulars
        for s, w in ((21, 10), (41, 16)):
            x = np.linspace(0.0, sizes.length, s)
            z = np.linspace(0.0, min(sizes.depth, 1.4 * sizes.draught), w)
            y = np.array([[half_breadth(hull, a, b) for b in z.tolist()] for a in x.tolist()])
            found[f"{ship} {s} x {w}"] = read_printed(table_text(x, z, y, in_mm))[1]
    return found


def half_breadth(hull: ah.Hull, x: float, z: float) -> float:
    """The half-breadth, nan where the hull does not come."""
    try:
        return hull.half_breadth(x, z)
    except NoMeetingError:
        return float("nan")


# --------------------------------------------------------------------------------------
# Slips.


@attrs.frozen
class Planted:
    """A slip: its cell, what was done, the wrong number as printed, and its size in m."""

    row: int
    column: int
    kind: str
    text: str
    size: float


KINDS = ("swap", "digit", "next cell")


def slip(table: PrintedOffsets, i: int, j: int, kind: str, random: Random) -> str | None:
    """The number of a cell after a slip, None where there is none of this kind."""
    text = table.text[i][j]
    digits = [k for k, letter in enumerate(text) if letter.isdigit()]
    letters = list(text)
    if kind == "swap":
        pairs = [(a, b) for a, b in pairwise(digits) if text[a] != text[b]]
        if not pairs:
            return None
        a, b = pairs[random.integers(len(pairs))]
        letters[a], letters[b] = letters[b], letters[a]
        return "".join(letters)
    if kind == "digit":
        a = digits[random.integers(len(digits))]
        letters[a] = str((int(text[a]) + int(random.integers(1, 10))) % 10)
        return "".join(letters)
    beside = [table.text[i][k] for k in (j - 1, j + 1) if 0 <= k < len(table.z)]
    other = [each for each in beside if (table.read(each) or 0.0) > 0.0 and each != text]
    return other[random.integers(len(other))] if other else None


def planted(
    table: TrialTable, cells: NDArray[np.int64], count: int, random: Random,
    size: tuple[float, float], kinds: tuple[str, ...] = KINDS,
) -> Iterator[Planted]:  # fmt: skip
    """Slips of some size, one at a time, in some of the cells (n, 2), each kind as often."""
    printed, done = table.printed, 0
    for _ in range(2000 * count):
        i, j = cells[random.integers(len(cells))].tolist()
        kind = kinds[random.integers(len(kinds))]
        text = slip(printed, i, j, kind, random)
        value = None if text is None else printed.read(text)
        if text is None or value is None or value <= 0.0:
            continue
        off = abs(value - (printed.read(printed.text[i][j]) or 0.0)) * table.metres
        if size[0] <= off < size[1]:
            done += 1
            yield Planted(i, j, kind, text, off)
        if done == count:
            return


def with_slips(table: PrintedOffsets, slips: tuple[Planted, ...]) -> PrintedOffsets:
    """The table with wrong numbers."""
    y, text = table.y.copy(), [list(row) for row in table.text]
    for each in slips:
        text[each.row][each.column] = each.text
        y[each.row, each.column] = (table.read(each.text) or 0.0) * table.worth[each.column]
    return attrs.evolve(table, y=y, text=tuple(map(tuple, text)))


@attrs.frozen
class Outcome:
    """What the doctor says of a slip: its place in the list, from 0; 99: it is not there."""

    slip: Planted
    place: int
    score: float
    within: float
    first: bool
    named: bool


def outcome(table: TrialTable, each: Planted) -> Outcome:
    """Plant one slip and look; `within`: how far the number that is proposed is off, m."""
    report = examine(with_slips(table.printed, (each,)))
    for place, found in enumerate(report.findings):
        if (found.row, found.column) == (each.row, each.column):
            right = table.printed.text[each.row][each.column]
            meant = table.printed.read(right) or 0.0
            off = abs((table.printed.read(found.proposed) or 0.0) - meant) * table.metres
            numbers = [number.text for number in found.numbers]
            return Outcome(
                each, place, found.score, off, numbers[:1] == [right], right in numbers
            )  # fmt: skip
    return Outcome(each, 99, 0.0, np.inf, False, False)


def cells_seen(table: PrintedOffsets) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Cells that are checked in both directions, (n, 2), and those that are in one."""
    told = checked_directions(table)
    both = told.all(axis=2)
    return np.argwhere(both), np.argwhere(told.any(axis=2) & ~both)


@attrs.frozen
class Rates:
    """Parts, in percent, of slips that are found, called and mended."""

    count: int
    first: float
    five: float
    called: float
    within: float
    numbers: float

    @classmethod
    def of(cls, found: list[Outcome]) -> Rates:
        """Rates of outcomes."""

        def part(told: list[bool]) -> float:
            return 100.0 * float(np.mean(told)) if told else float("nan")

        return cls(
            len(found),
            part([each.place == 0 for each in found]),
            part([each.place < 5 for each in found]),
            part([each.score > ALARM for each in found]),
            part([each.within <= 0.010 for each in found]),
            part([each.first for each in found if each.score > ALARM]),
        )


def trial(
    table: TrialTable, count: int, seed: int, size: tuple[float, float] = (0.005, 100.0),
    *, edge: bool = False, kinds: tuple[str, ...] = KINDS,
) -> list[Outcome]:  # fmt: skip
    """Plant slips one at a time, in cells seen from both directions or from one."""
    cells = cells_seen(table.printed)[int(edge)]
    random = np.random.default_rng(seed)
    return [outcome(table, each) for each in planted(table, cells, count, random, size, kinds)]
