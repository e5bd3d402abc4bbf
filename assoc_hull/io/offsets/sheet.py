"""The numbers of one block as printed: rows checked, doubles dropped, digits counted.

Examples
--------
>>> from assoc_hull.io.offset_report import Notebook
>>> from assoc_hull.io.offsets.sheet import read_sheet
>>> from assoc_hull.io.tables.offset_text import Block
>>> rows = (("0", "0.10"), ("1", "0.25"))
>>> block = Block("text", ("station", "wl_0"), rows, (2, 3))
>>> sheet = read_sheet(block, Notebook())
>>> sheet.offsets.tolist(), sheet.half_unit.tolist()
([[0.1], [0.25]], [0.005])
"""

from __future__ import annotations

from decimal import Decimal

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.io.offset_report import Notebook
from assoc_hull.io.offsets.columns import Column, Columns, classify
from assoc_hull.io.tables.offset_text import Block, number

__all__ = ["Sheet", "read_sheet"]

_ENOUGH = 6


@attrs.frozen(eq=False)
class Sheet:
    """One block in its own unit and order.

    Attributes
    ----------
    block : Block
        The text, doubles dropped.
    columns : Columns
        Which column is which.
    labels : tuple of str
        Station names as printed (x where there is no station column).
    stations : (s,)
        Station numbers, nan where the name is no number.
    x : (s,) or None
        Place of the stations as printed.
    offsets : (s, w)
        Half-breadths as printed, nan for blanks.
    heights : (s, b)
        Buttock heights as printed, nan for blanks.
    half_unit : (w,)
        Half of the last printed digit of each waterline.
    """

    block: Block
    columns: Columns
    labels: tuple[str, ...]
    stations: FloatArray
    x: FloatArray | None
    offsets: FloatArray
    heights: FloatArray
    half_unit: FloatArray

    @property
    def place(self) -> FloatArray:
        """(s,): what orders the stations: x where the file has it, else the number."""
        return self.stations if self.x is None else self.x

    def where(self, row: int, column: Column) -> str:
        """Say where a cell stands."""
        return self.block.where(row, column.index)

    def single(self, kind: str) -> FloatArray | None:
        """Give a column such as "keel", (s,), as printed, or None where the file has none."""
        column = self.columns.single.get(kind)
        return None if column is None else _read(self.block, (column,))[:, 0]


def read_sheet(block: Block, book: Notebook) -> Sheet:
    """Read the numbers of a block.

    Raises
    ------
    BadInputError
        A cell is no number, a station lacks its number or place, one station has two rows
        with different numbers, the stations are out of order.
    """
    columns = classify(block, book)
    block = _without_doubles(block, columns, book)
    x = _places(block, columns.single.get("x"))
    stations = _stations(block, columns.single.get("station"), x is None)
    name = columns.single.get("station", columns.single.get("x"))
    labels = tuple(row[name.index] if name else "" for row in block.rows)
    sheet = Sheet(
        block,
        columns,
        labels,
        stations,
        x,
        _read(block, columns.waterlines),
        _read(block, columns.buttocks),
        _half_units(block, columns.waterlines, book),
    )
    _in_order(sheet)
    return sheet


def _read(block: Block, columns: tuple[Column, ...]) -> FloatArray:
    cells = [[number(block, row, c.index) for c in columns] for row in range(len(block.rows))]
    return np.array(cells, np.float64).reshape(len(block.rows), len(columns))


def _places(block: Block, column: Column | None) -> FloatArray | None:
    if column is None:
        return None
    x = _read(block, (column,))[:, 0]
    _refuse_blank(block, column, x)
    return x


def _stations(block: Block, column: Column | None, needed: bool) -> FloatArray:
    if column is None:
        return np.full(len(block.rows), np.nan)
    if needed:
        stations = _read(block, (column,))[:, 0]
        _refuse_blank(block, column, stations)
        return stations
    return np.array([_loose(row[column.index]) for row in block.rows], np.float64)


def _loose(cell: str) -> float:
    try:
        return float(Decimal(cell)) if abs(Decimal(cell)) < 1e7 else np.nan
    except ArithmeticError:
        return np.nan


def _refuse_blank(block: Block, column: Column, values: FloatArray) -> None:
    for row in np.flatnonzero(np.isnan(values)):
        raise BadInputError(
            "the cell is empty", block.where(int(row), column.index), "say where the station lies"
        )


def _without_doubles(block: Block, columns: Columns, book: Notebook) -> Block:
    column = columns.single.get("station") or columns.single["x"]
    seen: dict[str, int] = {}
    keep = []
    for k, row in enumerate(block.rows):
        loose = _loose(row[column.index])
        key = row[column.index] if np.isnan(loose) else repr(loose + 0.0)
        first = seen.setdefault(key, k)
        if first == k or not row[column.index]:
            keep.append(k)
            continue
        _refuse_different(block, first, k)
        what = f"row {block.lines[k]} repeats row {block.lines[first]} and was dropped"
        book.repair("repeated station", f"station {row[column.index]}", what, block.lines[k])
    rows, lines = [block.rows[k] for k in keep], [block.lines[k] for k in keep]
    return attrs.evolve(block, rows=tuple(rows), lines=tuple(lines))


def _refuse_different(block: Block, first: int, second: int) -> None:
    for column in range(len(block.header)):
        one, other = block.rows[first][column], block.rows[second][column]
        if one != other and not _loose(one) == _loose(other):
            raise BadInputError(
                f"the station occurs twice with different numbers: {other or 'blank'} here and "
                f"{one or 'blank'} in row {block.lines[first]}",
                block.where(second, column),
                "delete one of the two rows",
            )


def _in_order(sheet: Sheet) -> None:
    step = np.diff(sheet.place)
    if not len(step):
        return
    sense = 1.0 if np.sum(step > 0) >= np.sum(step < 0) else -1.0
    for row in np.flatnonzero(step * sense <= 0):
        k = int(row) + 1
        raise BadInputError(
            f"station {sheet.labels[k]} at {sheet.place[k]:g} follows station "
            f"{sheet.labels[k - 1]} at {sheet.place[k - 1]:g} against the order of the others",
            f"{sheet.block.source}, row {sheet.block.lines[k]}",
            "correct the number, or put the rows in order along the ship",
        )


def _half_units(block: Block, columns: tuple[Column, ...], book: Notebook) -> FloatArray:
    printed = [_decimals([row[c.index] for row in block.rows]) for c in columns]
    most = max((digits for digits, _ in printed), default=0)
    padded = [c.label for c, (_, zeros) in zip(columns, printed, strict=True) if zeros]
    if padded:
        what = "every number ends in 0; the last digit counted is the one before the zeros"
        book.assume("printed digits", ", ".join(padded), what)
    known = [digits if digits >= 0 else most for digits, _ in printed]
    return np.array([0.5 * 10.0**-digits for digits in known], np.float64)


def _decimals(cells: list[str]) -> tuple[int, int]:
    numbers = [Decimal(cell) for cell in cells if not np.isnan(_loose(cell))]
    if not numbers:
        return -1, 0
    places = max(0, *(-int(n.as_tuple().exponent) for n in numbers), 0)
    nonzero = [n for n in numbers if n]
    if len(nonzero) < _ENOUGH:
        return places, 0
    needed = max(0, *(-int(n.normalize().as_tuple().exponent) for n in nonzero), 0)
    return min(places, needed), max(0, places - needed)
