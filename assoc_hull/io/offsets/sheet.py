"""One block of an offset table: its columns, its numbers as printed, and it all for the doctor.

Columns are recognised by the header alone. Rows are checked, doubles dropped and printed digits
counted; unit and order stay those of the file.

A table of half-breadths as it is printed, for the doctor of offsets: texts, digits, places.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from decimal import Decimal
from itertools import pairwise

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.fairing.offsets_doctor import PrintedOffsets
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.io.offsets.hints import OffsetHints
from assoc_hull.io.reports import Notebook
from assoc_hull.io.tables.column_names import (
    BLANKS,
    EIGHTH,
    ColumnName,
    cell_value,
    column_name,
    is_eighths,
    label_number,
    number_like,
    station_label,
)
from assoc_hull.io.tables.table_blocks import TableBlock, cell_number

__all__ = [
    "OffsetColumn",
    "OffsetColumns",
    "OffsetSheet",
    "classify_columns",
    "eighths",
    "printed_offsets",
    "read_sheet",
    "rows_in_order",
]

# --------------------------------------------------------------------------------------
# Columns, by `assoc_hull.io.tables.column_names.column_name`. A blank corner is the stations'.

_STATIONS = 42
"""No hull has more stations by number; places under a blank corner that run farther are x."""


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
        "m", "mm", "cm", "ft" or "in" where the name, the row under it or the cells say so, "t" for
        a waterline in draughts.
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
        By kind: "station", "x", "keel", "deck height", "deck half-breadth", and "beam" and
        "area", which are no geometry and serve as a check of each station.
    waterlines, buttocks : tuple of OffsetColumn
        Upward and outward, whatever the order of the file.
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
        repeat or are in several units.
    """
    single: dict[str, OffsetColumn] = {}
    families: dict[str, list[OffsetColumn]] = {"waterline": [], "buttock": []}
    left: list[OffsetColumn] = []
    for index, label in enumerate(block.header):
        name = column_name(label) if label else None
        unit = block.units[index] if block.units else None
        if name is None and index == 0 and _is_corner(block):
            name = ColumnName(_corner(block, book))
        if name is None:
            left.append(OffsetColumn(index, label, unit))
        elif name.kind in families:
            column = OffsetColumn(index, label, name.unit or unit, name.value)
            families[name.kind].append(column)
        else:
            _put(single, block, name.kind, OffsetColumn(index, label, name.unit or unit))
    if "station" not in single and "x" not in single:
        raise BadInputError(
            "there is neither a station nor an x column",
            f"{block.source}, header {','.join(block.header)[:60]!r}",
            "name one column 'station', or by its unit 'x_m', 'x_mm' or 'x_ft'",
        )
    _tell_left(left, families["waterline"], block, book)
    ordered = [_ascending(family, block, book) for family in families.values()]
    return OffsetColumns(single, *ordered)


def _is_corner(block: TableBlock) -> bool:
    """Tell whether the first column, without a known name, holds the stations."""
    label = block.header[0]
    said = label == "" or "\\" in label or "/" in label
    return said and not any(
        (name := column_name(each)) and name.kind in ("station", "x") for each in block.header[1:]
    )


def _corner(block: TableBlock, book: Notebook) -> str:
    """Say whether the places under a blank corner are numbers of stations, or x."""
    places = [label_number(row[0]) for row in block.rows]
    known = np.array([each for each in places if each is not None], np.float64)
    whole = bool(np.all(known * 4.0 == np.round(known * 4.0)))
    kind = "station" if not len(known) or (whole and known.max() <= _STATIONS) else "x"
    what = "the corner says nothing: the first column is read as "
    book.assume("corner", block.source, what + ("stations" if kind == "station" else "x"))
    return kind


def _put(
    single: dict[str, OffsetColumn], block: TableBlock, kind: str, column: OffsetColumn
) -> None:
    if kind in single:
        raise BadInputError(
            f"columns {single[kind].label!r} and {column.label!r} both hold the {kind}",
            block.source,
            "leave one of them out",
        )
    single[kind] = column


def _tell_left(
    left: list[OffsetColumn], waterlines: list[OffsetColumn], block: TableBlock, book: Notebook
) -> None:
    """Note columns that were not read; numbers between waterlines are a suspicion."""
    among = [column.index for column in waterlines]
    for column in left:
        cells = [row[column.index] for row in block.rows]
        numbers = sum(number_like(cell) and cell not in BLANKS for cell in cells)
        if not column.label and not numbers:
            continue
        inside = among and min(among) < column.index < max(among) and 2 * numbers > len(cells)
        name = repr(column.label) if column.label else f"{column.index + 1}, without a name,"
        if inside:
            what = "it stands among waterlines and its name says no height: it was not read"
            book.suspect("column ignored", f"column {name}", what)
        else:
            book.assume("column ignored", f"column {name}", "it is no offset and was not read")


def _ascending(
    columns: list[OffsetColumn], block: TableBlock, book: Notebook
) -> tuple[OffsetColumn, ...]:
    # The base line lies at 0 in any unit.
    if len({column.unit for column in columns if column.value != 0.0}) > 1:
        raise BadInputError(
            f"columns {columns[0].label!r} to {columns[-1].label!r} are in several units",
            block.source,
            "give all of them in one unit",
        )
    found = sorted(columns, key=lambda column: column.value)
    for before, after in pairwise(found):
        if after.value == before.value:
            raise BadInputError(
                f"column {after.label!r} repeats column {before.label!r}",
                block.source,
                "give each waterline and each buttock once",
            )
    if found != columns:
        what = f"from {columns[0].label!r} to {columns[-1].label!r}; put in order"
        book.repair("column order", block.source, what)
    return tuple(found)


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
    printed_unit : str or None
        "ft" where half-breadths are printed in feet-inches-eighths.
    zero : str or None
        "ap" or "fp" where a row is named so and its number would be 0.
    beams : (w,) or None
        What a row such as "MaxBm" says of each waterline.
    """

    block: TableBlock
    columns: OffsetColumns
    labels: tuple[str, ...]
    stations: FloatArray
    x: FloatArray | None
    offsets: FloatArray
    heights: FloatArray
    half_unit: FloatArray
    printed_unit: str | None = None
    zero: str | None = None
    beams: FloatArray | None = None

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
    block, beams = _without_beams(block, columns)
    block = _without_doubles(block, columns, book)
    x = _places(block, columns.single.get("x"))
    stations, zero = _stations(block, columns.single.get("station"), x is None)
    name = columns.single.get("station", columns.single.get("x"))
    labels = tuple(row[name.index] if name else "" for row in block.rows)
    eighths = _in_eighths(block, columns.waterlines)
    half = eighths or _half_units(block, columns.waterlines, book)
    sheet = OffsetSheet(
        block,
        _with_units(block, columns),
        labels,
        stations,
        x,
        _read(block, columns.waterlines),
        _read(block, columns.buttocks),
        np.full(len(columns.waterlines), half) if eighths else np.asarray(half),
        "ft" if eighths else None,
        zero,
        beams,
    )
    _in_order(sheet)
    return sheet


def _without_beams(
    block: TableBlock, columns: OffsetColumns
) -> tuple[TableBlock, FloatArray | None]:
    """Take off a row named as the largest beam of each waterline; give its numbers, (w,)."""
    name = columns.single.get("station") or columns.single["x"]
    kinds = [column_name(row[name.index]) for row in block.rows]
    rows = [k for k, kind in enumerate(kinds) if kind is not None and kind.kind == "beam"]
    if not rows:
        return block, None
    beams = _read(block, columns.waterlines)[rows[0]]
    keep = [k for k in range(len(block.rows)) if k not in rows]
    kept = attrs.evolve(
        block,
        rows=tuple(block.rows[k] for k in keep),
        lines=tuple(block.lines[k] for k in keep),
    )
    return kept, beams


def _in_eighths(block: TableBlock, columns: tuple[OffsetColumn, ...]) -> float:
    """Give half the unit of cells in feet-inches-eighths, ft; 0 where they are decimals.

    Raises
    ------
    BadInputError
        Some are and some are not.
    """
    places = [(row, c.index) for row in range(len(block.rows)) for c in columns]
    found = [block.rows[row][k] for row, k in places if is_eighths(block.rows[row][k])]
    if not found:
        return 0.0
    for row, k in places:
        cell = block.rows[row][k]
        if not is_eighths(cell) and cell not in BLANKS and cell_number(block, row, k) != 0.0:
            raise BadInputError(
                f"{cell!r} stands among cells in feet-inches-eighths such as {found[0]!r}",
                block.where(row, k),
                "write all half-breadths in one form",
            )
    finer = any(cell[-1] in "+-" for cell in found)
    return 0.5 * EIGHTH / (2.0 if finer else 1.0)


def _with_units(block: TableBlock, columns: OffsetColumns) -> OffsetColumns:
    """Put feet on single columns whose cells are in feet-inches-eighths."""
    single = {
        kind: attrs.evolve(column, unit="ft")
        if any(is_eighths(row[column.index]) for row in block.rows) else column
        for kind, column in columns.single.items()
    }  # fmt: skip
    return attrs.evolve(columns, single=single)


def _read(block: TableBlock, columns: tuple[OffsetColumn, ...]) -> FloatArray:
    cells = [[cell_number(block, row, c.index) for c in columns] for row in range(len(block.rows))]
    return np.array(cells, np.float64).reshape(len(block.rows), len(columns))


def _places(block: TableBlock, column: OffsetColumn | None) -> FloatArray | None:
    if column is None:
        return None
    x = _read(block, (column,))[:, 0]
    _refuse_blank(block, column, x)
    return x


_ENDS = {"ap": "ap", "a.p": "ap", "a.p.": "ap", "fp": "fp", "f.p": "fp", "f.p.": "fp"}


def _stations(
    block: TableBlock, column: OffsetColumn | None, needed: bool
) -> tuple[FloatArray, str | None]:
    """Give the numbers of the stations, nan for names, and which end 0 is if a name says so."""
    if column is None:
        return np.full(len(block.rows), np.nan), None
    names = [row[column.index] for row in block.rows]
    stations = np.array([_station_number(name) for name in names], np.float64)
    zero = None
    for k, beside, next_but_one in ((0, 1, 2), (-1, -2, -3)):
        end = _ENDS.get(names[k].lower()) if len(names) > 2 else None
        if end and np.isfinite(stations[[beside, next_but_one]]).all():
            stations[k] = _end_number(stations[beside], stations[next_but_one])
            zero = end if stations[k] == 0.0 else zero
    if needed:
        for row in np.flatnonzero(np.isnan(stations)):
            cell_number(block, int(row), column.index)
        _refuse_blank(block, column, stations)
    return stations, zero


def _end_number(beside: float, next_but_one: float) -> float:
    """Give the number of a perpendicular: 0, or the next of 10, 20 and 40."""
    if beside < next_but_one:
        return 0.0
    return min((full for full in (10.0, 20.0, 40.0) if full > beside), default=np.nan)


def _station_number(name: str) -> float:
    """Give the number of a station, with or without a word before it; nan if it has none."""
    found = label_number(re.sub(r"^[A-Za-z]+\.?[ _]*", "", name) if station_label(name) else name)
    return np.nan if found is None or abs(found) > 1e7 else found


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
        what = f"{block.row(k)} repeats {block.row(first)} and was dropped"
        book.repair("repeated station", f"station {row[column.index]}", what, block.lines[k])
    rows, lines = [block.rows[k] for k in keep], [block.lines[k] for k in keep]
    return attrs.evolve(block, rows=tuple(rows), lines=tuple(lines))


def _refuse_different(block: TableBlock, first: int, second: int) -> None:
    for column in range(len(block.header)):
        one, other = block.rows[first][column], block.rows[second][column]
        if one != other and not _number_or_nan(one) == _number_or_nan(other):
            raise BadInputError(
                f"the station occurs twice with different numbers: {other or 'blank'} here and "
                f"{one or 'blank'} in {block.row(first)}",
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
            f"{sheet.block.source}, {sheet.block.row(k)}",
            "correct the number, or put the rows in order along the ship",
        )


def _half_units(block: TableBlock, columns: tuple[OffsetColumn, ...], book: Notebook) -> FloatArray:
    """Give half of the last printed digit of each column, (k,), in its unit."""
    cells = [[row[c.index] for row in block.rows] for c in columns]
    # Workbooks and many programs drop zeros at the end: few numbers do not tell the digits then.
    dropped = any(len({_places_of(n) for n in _numbers_in(column) if n}) > 1 for column in cells)
    printed = [_decimals(column, dropped=dropped) for column in cells]
    most = max([digits for digits, _ in printed if digits >= 0], default=-1)
    if most < 0:
        most = max([0, *(_places_of(n) for column in cells for n in _numbers_in(column))])
    padded = [c.label for c, (_, zeros) in zip(columns, printed, strict=True) if zeros]
    if padded:
        what = "every number ends in 0; the last digit counted is the one before the zeros"
        book.assume("printed digits", ", ".join(padded), what)
    known = [digits if digits >= 0 else most for digits, _ in printed]
    return np.array([0.5 * 10.0**-digits for digits in known], np.float64)


def _numbers_in(cells: list[str]) -> list[Decimal]:
    """Give the numbers among cells."""
    return [Decimal(cell) for cell in cells if not np.isnan(_number_or_nan(cell))]


def _places_of(number: Decimal) -> int:
    """Give the decimals of a number as printed, less than 0 of 4e3."""
    return -int(number.as_tuple().exponent)


def _decimals(cells: list[str], *, dropped: bool) -> tuple[int, int]:
    """Give the decimals that count and those that are padding; -1 where the column tells none.

    `dropped`: zeros at the end of numbers are not printed.
    """
    numbers = _numbers_in(cells)
    places = max([0, *map(_places_of, numbers)])
    nonzero = [n for n in numbers if n]
    if not nonzero and places == 0:
        return -1, 0  # "0" is what every program prints, to however many digits
    # Numbers that repeat, as along parallel middle body, end in 0 together by chance.
    if len(set(nonzero)) < _ENOUGH:
        return (-1 if dropped else places), 0
    needed = max(0, *(-int(n.normalize().as_tuple().exponent) for n in nonzero), 0)
    return min(places, needed), max(0, places - needed)


def rows_in_order(sheet: OffsetSheet) -> list[int]:
    """Give the rows of a sheet by ascending place."""
    found: list[int] = np.argsort(sheet.place, kind="stable").tolist()
    return found


def printed_offsets(sheet: OffsetSheet, hints: OffsetHints, name: str) -> PrintedOffsets:
    """Give the half-breadths of a sheet in its own unit, stations by ascending place."""
    rows = rows_in_order(sheet)
    columns = sheet.columns.waterlines
    text = tuple(
        tuple(sheet.block.rows[row][column.index].lstrip("-") for column in columns)
        for row in rows
    )  # fmt: skip
    half, worth = _digits(sheet, hints)
    in_eighths = sheet.printed_unit == "ft"
    # As many decimals as the waterline has, and no 0 before the point where it has none.
    lines = tuple(zip(*text, strict=True))
    decimals = [max(len(cell.partition(".")[2]) for cell in each) for each in lines]
    bare = [any(cell.startswith(".") for cell in each) for each in lines]

    def write(value: float, j: int) -> str:
        if in_eighths:
            return eighths(value)
        shown = f"{value:.{decimals[j]}f}"
        return shown.removeprefix("0") if bare[j] and "." in shown else shown

    places = sheet.place[rows]
    names = [sheet.labels[row] for row in rows]
    return PrintedOffsets(
        name=name,
        unit=sheet.printed_unit or hints.units.y or "",
        stations=tuple(
            label or f"x = {place:g}" for label, place in zip(names, places.tolist(), strict=True)
        ),
        waterlines=tuple(str(column.value).removesuffix(".0") for column in columns),
        x=places,
        z=np.array([column.value for column in columns]),
        y=sheet.offsets[rows],
        step=2.0 * half,
        worth=worth,
        text=text,
        read=cell_value,
        write=write,
    )


def _digits(sheet: OffsetSheet, hints: OffsetHints) -> tuple[FloatArray, FloatArray]:
    """Give half of the last digit and what a printed unit is worth, (w,) each, in units of y."""
    columns = sheet.columns.waterlines
    worth = np.ones(len(columns))
    for j, column in enumerate(columns):
        cells = np.array([abs(cell_value(row[column.index]) or 0.0) for row in sheet.block.rows])
        known = np.isfinite(cells) & (cells > 0.0) & (sheet.offsets[:, j] > 0.0)
        # Waterlines printed as parts of their largest value have been multiplied by it.
        if sheet.beams is not None and known.any():
            worth[j] = float(np.median(sheet.offsets[known, j] / cells[known]))
    if len(hints.rounding) != len(columns):
        return sheet.half_unit, worth
    half = np.empty(len(columns))
    half[np.argsort([column.index for column in columns])] = hints.rounding
    return half, worth


def eighths(feet: float) -> str:
    """Write feet as feet-inches-eighths.

    Examples
    --------
    >>> from assoc_hull.io.offsets.sheet import eighths
    >>> eighths(12.53125)
    '12-6-3'
    """
    inches, parts = divmod(round(96.0 * abs(feet)), 8)
    return f"{'-' if feet < 0.0 else ''}{inches // 12}-{inches % 12}-{parts}"
