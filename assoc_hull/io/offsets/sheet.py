"""One block of an offset table: which column holds what, and its numbers as printed.

Columns are recognised by the header alone. Rows are checked, doubles dropped and printed digits
counted; unit and order stay those of the file.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from decimal import Decimal
from itertools import pairwise

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.io.reports import Notebook
from assoc_hull.io.tables.table_text import TableBlock, cell_number

__all__ = [
    "OffsetColumn",
    "OffsetColumns",
    "OffsetSheet",
    "classify_columns",
    "read_sheet",
]

# --------------------------------------------------------------------------------------
# Columns. Known names (any case, blanks or underscores, a unit at the end as in ``x_m`` or ``x
# [mm]``): ``station``; ``x``; ``z_keel`` or ``keel``; ``z_sheer``, ``z_deck`` or ``deck``;
# ``y_deck`` or ``deck_half_breadth``; ``wl_0.25`` (a waterline) and ``bt_2.0`` (a buttock).

_NUMBERED = re.compile(
    r"(?P<family>wl|waterline|bt|buttock)_?(?P<value>-?([0-9]+\.?[0-9]*|\.[0-9]+)(e-?[0-9]{1,2})?)"
    r"(_?(?P<unit>mm|m|t))?"
)
_UNIT = re.compile(r"(?P<name>.+)_(?P<unit>mm|m)")
_NAMES = {
    "station": ("station", "stations", "stn", "sta", "st", "frame", "no"),
    "x": ("x",),
    "keel": ("z_keel", "keel", "z_profile", "profile"),
    "deck height": ("z_sheer", "sheer", "z_deck", "deck", "deck_height"),
    "deck half-breadth": ("y_deck", "y_sheer", "deck_half_breadth"),
}
_KIND = {name: kind for kind, names in _NAMES.items() for name in names}


@attrs.frozen
class OffsetColumn:
    """One column.

    Attributes
    ----------
    index : int
        Its place in the row.
    label : str
        Its name as the file prints it.
    unit : str or None
        "m" or "mm" where the name says so, "t" for a waterline in draughts.
    value : float
        Height of a waterline or y of a buttock, in the file's unit; nan for the others.
    """

    index: int
    label: str
    unit: str | None
    value: float = float("nan")


@attrs.frozen
class OffsetColumns:
    """The columns of one block.

    Attributes
    ----------
    single : mapping of str to OffsetColumn
        By kind: "station", "x", "keel", "deck height", "deck half-breadth".
    waterlines, buttocks : tuple of OffsetColumn
        In the file's order, which is upward and outward.
    """

    single: Mapping[str, OffsetColumn]
    waterlines: tuple[OffsetColumn, ...]
    buttocks: tuple[OffsetColumn, ...]


def classify_columns(block: TableBlock, book: Notebook) -> OffsetColumns:
    """Find the columns of a block by their names; unknown ones are noted and left out.

    Raises
    ------
    BadInputError
        No station and no x column, a column that occurs twice, waterlines or buttocks that
        repeat or decrease.
    """
    single: dict[str, OffsetColumn] = {}
    families: dict[str, list[OffsetColumn]] = {"wl": [], "bt": []}
    for index, label in enumerate(block.header):
        name = re.sub(r"[\s_\[\]()=:]+", "_", label.lower()).strip("_.")
        numbered = _NUMBERED.fullmatch(name)
        if numbered:
            column = OffsetColumn(index, label, numbered["unit"], float(numbered["value"]))
            families["wl" if numbered["family"].startswith("w") else "bt"].append(column)
        else:
            _put(single, block, name, index, book)
    if "station" not in single and "x" not in single:
        raise BadInputError(
            "there is neither a station nor an x column",
            f"{block.source}, header {','.join(block.header)[:60]!r}",
            "name one column 'station' or 'x_m'",
        )
    for family in families.values():
        _increasing(family, block)
    return OffsetColumns(single, tuple(families["wl"]), tuple(families["bt"]))


def _put(
    single: dict[str, OffsetColumn], block: TableBlock, name: str, index: int, book: Notebook
) -> None:
    label = block.header[index]
    with_unit = _UNIT.fullmatch(name)
    unit = None
    if name not in _KIND and with_unit:
        name, unit = with_unit["name"], with_unit["unit"]
    kind = _KIND.get(name)
    if kind is None:
        book.assume("column ignored", f"column {label!r}", "it is no offset and was not read")
    elif kind in single:
        raise BadInputError(
            f"columns {single[kind].label!r} and {label!r} both hold the {kind}",
            block.source,
            "leave one of them out",
        )
    else:
        single[kind] = OffsetColumn(index, label, unit)


def _increasing(columns: list[OffsetColumn], block: TableBlock) -> None:
    if len({column.unit for column in columns}) > 1:
        raise BadInputError(
            f"columns {columns[0].label!r} to {columns[-1].label!r} are in several units",
            block.source,
            "give all of them in one unit",
        )
    for before, after in pairwise(columns):
        if after.value <= before.value:
            verb = "repeats" if after.value == before.value else "lies below"
            raise BadInputError(
                f"column {after.label!r} {verb} column {before.label!r}",
                block.source,
                "order the columns upward (waterlines) or outward (buttocks), each once",
            )


# --------------------------------------------------------------------------------------
# Numbers.

_ENOUGH = 6
"""Numbers of a column, other than 0, from which zeros at the end count as padding."""


@attrs.frozen(eq=False)
class OffsetSheet:
    """One block in its own unit and order.

    Attributes
    ----------
    block : TableBlock
        The text, doubles dropped.
    columns : OffsetColumns
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

    block: TableBlock
    columns: OffsetColumns
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

    def where(self, row: int, column: OffsetColumn) -> str:
        """Say where a cell stands."""
        return self.block.where(row, column.index)

    def single(self, kind: str) -> FloatArray | None:
        """Give a column such as "keel", (s,), as printed, or None where the file has none."""
        column = self.columns.single.get(kind)
        return None if column is None else _read(self.block, (column,))[:, 0]


def read_sheet(block: TableBlock, book: Notebook) -> OffsetSheet:
    """Read the numbers of a block.

    Raises
    ------
    BadInputError
        A cell is no number, a station lacks its number or place, one station has two rows
        with different numbers, the stations are out of order.
    """
    columns = classify_columns(block, book)
    block = _without_doubles(block, columns, book)
    x = _places(block, columns.single.get("x"))
    stations = _stations(block, columns.single.get("station"), x is None)
    name = columns.single.get("station", columns.single.get("x"))
    labels = tuple(row[name.index] if name else "" for row in block.rows)
    sheet = OffsetSheet(
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


def _read(block: TableBlock, columns: tuple[OffsetColumn, ...]) -> FloatArray:
    cells = [[cell_number(block, row, c.index) for c in columns] for row in range(len(block.rows))]
    return np.array(cells, np.float64).reshape(len(block.rows), len(columns))


def _places(block: TableBlock, column: OffsetColumn | None) -> FloatArray | None:
    if column is None:
        return None
    x = _read(block, (column,))[:, 0]
    _refuse_blank(block, column, x)
    return x


def _stations(block: TableBlock, column: OffsetColumn | None, needed: bool) -> FloatArray:
    if column is None:
        return np.full(len(block.rows), np.nan)
    if needed:
        stations = _read(block, (column,))[:, 0]
        _refuse_blank(block, column, stations)
        return stations
    return np.array([_number_or_nan(row[column.index]) for row in block.rows], np.float64)


def _number_or_nan(cell: str) -> float:
    """Give the number that a cell shows, nan if it is none or beyond any ship."""
    try:
        return float(Decimal(cell)) if abs(Decimal(cell)) < 1e7 else np.nan
    except ArithmeticError:
        return np.nan


def _refuse_blank(block: TableBlock, column: OffsetColumn, values: FloatArray) -> None:
    for row in np.flatnonzero(np.isnan(values)):
        raise BadInputError(
            "the cell is empty", block.where(int(row), column.index), "say where the station lies"
        )


def _without_doubles(block: TableBlock, columns: OffsetColumns, book: Notebook) -> TableBlock:
    """Drop rows that repeat a station with the same numbers; refuse others."""
    column = columns.single.get("station") or columns.single["x"]
    seen: dict[str, int] = {}
    keep = []
    for k, row in enumerate(block.rows):
        loose = _number_or_nan(row[column.index])
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


def _refuse_different(block: TableBlock, first: int, second: int) -> None:
    for column in range(len(block.header)):
        one, other = block.rows[first][column], block.rows[second][column]
        if one != other and not _number_or_nan(one) == _number_or_nan(other):
            raise BadInputError(
                f"the station occurs twice with different numbers: {other or 'blank'} here and "
                f"{one or 'blank'} in row {block.lines[first]}",
                block.where(second, column),
                "delete one of the two rows",
            )


def _in_order(sheet: OffsetSheet) -> None:
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


def _half_units(block: TableBlock, columns: tuple[OffsetColumn, ...], book: Notebook) -> FloatArray:
    """Give half of the last printed digit of each column, (k,), in its unit."""
    printed = [_decimals([row[c.index] for row in block.rows]) for c in columns]
    most = max((digits for digits, _ in printed), default=0)
    padded = [c.label for c, (_, zeros) in zip(columns, printed, strict=True) if zeros]
    if padded:
        what = "every number ends in 0; the last digit counted is the one before the zeros"
        book.assume("printed digits", ", ".join(padded), what)
    known = [digits if digits >= 0 else most for digits, _ in printed]
    return np.array([0.5 * 10.0**-digits for digits in known], np.float64)


def _decimals(cells: list[str]) -> tuple[int, int]:
    """Give the decimals that count and those that are padding; -1 for a column without numbers."""
    numbers = [Decimal(cell) for cell in cells if not np.isnan(_number_or_nan(cell))]
    if not numbers:
        return -1, 0
    places = max(0, *(-int(n.as_tuple().exponent) for n in numbers), 0)
    nonzero = [n for n in numbers if n]
    if len(nonzero) < _ENOUGH:
        return places, 0
    needed = max(0, *(-int(n.normalize().as_tuple().exponent) for n in nonzero), 0)
    return min(places, needed), max(0, places - needed)
