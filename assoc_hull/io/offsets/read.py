"""Reading a table of offsets: half-breadths by station and waterline, heights of buttocks.

`read_offsets` takes comma-, semicolon- or tab-separated text or a workbook in metres, millimetres
or normalised form (y/(B/2), z/T), and gives a table in ship axes (m, x from the AP) with a report
of all that it assumed, repaired and found suspicious. What it cannot settle it refuses.
"""

from __future__ import annotations

from pathlib import Path

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.io.offsets.doctor import ExaminedTable, examine_offsets
from assoc_hull.io.offsets.scale import (
    OffsetHints,
    OffsetScale,
    column_scale,
    find_scale,
    given_places,
    read_hints,
    settle_zero,
    station_places,
)
from assoc_hull.io.offsets.sheet import OffsetColumn, OffsetSheet, read_sheet
from assoc_hull.io.offsets.table import OffsetTable
from assoc_hull.io.reports import Notebook, OffsetReport
from assoc_hull.io.tables.table_text import read_text, split_blocks
from assoc_hull.io.units import check_particular

__all__ = [
    "build_table",
    "read_offsets",
]

# --------------------------------------------------------------------------------------
# From numbers as printed to ship axes.

_SIZES = (1e-3, 1e6)
"""Between these (m) lie length, breadth and height of every hull; beyond, a unit is wrong."""


def build_table(
    sheet: OffsetSheet,
    extra: OffsetSheet | None,
    scale: OffsetScale,
    hints: OffsetHints,
    station_zero: str,
    book: Notebook,
) -> OffsetTable:
    """Build a nameless table, and note every suspicion on it.

    `extra` holds the buttocks where they stand in a block of their own; `station_zero` as in
    `read_offsets`; `book` takes assumptions, repairs and suspicions.

    Raises
    ------
    BadInputError
        A half-breadth above B/2, stations whose place is unknown, buttocks that fit no
        station, waterlines in draughts without a draught, a hull of an impossible size.
    """
    rounding = _rounding(sheet, hints, scale, book)
    half_breadth = sheet.offsets * scale.y
    _refuse_wide(sheet, half_breadth, rounding, scale)
    x, length = _places(sheet, scale, hints, station_zero, book)
    order = slice(None) if x[0] < x[-1] else slice(None, None, -1)
    if x[0] > x[-1]:
        what = f"the file runs from forward (station {sheet.labels[0]}) aft; turned round"
        book.repair("station order", "the table", what)
    buttock_y, buttock_height = _buttocks(sheet, extra, scale, book)
    z = np.array([_height(sheet, column, scale) for column in sheet.columns.waterlines])
    deck = _column(sheet, "deck height", scale.z, order)
    table = OffsetTable(
        name="",
        x=x[order].copy(),
        z=z,
        half_breadth=half_breadth[order].copy(),
        keel=_column(sheet, "keel", scale.z, order),
        deck_height=deck,
        deck_half_breadth=_column(sheet, "deck half-breadth", scale.y, order),
        buttock_y=buttock_y,
        buttock_height=None if buttock_height is None else buttock_height[order].copy(),
        length=length,
        breadth=scale.breadth,
        draught=scale.draught,
        depth=_depth(x[order], deck, length),
        rounding=rounding,
        station=sheet.stations[order].copy(),
    )
    _refuse_size(table, sheet.block.source)
    _examine(table, sheet, scale, order, book)
    return table


def _refuse_size(table: OffsetTable, source: str) -> None:
    least, most = _SIZES
    size = {
        "stations": float(table.x[-1] - table.x[0]), "half-breadths": table.breadth / 2.0,
        "waterlines": float(table.z[-1] - table.z[0]),
    }  # fmt: skip
    for name, found in size.items():
        if not least <= found <= most:
            raise BadInputError(
                f"the {name} cover {found:.4g} m", source,
                "correct the numbers or the unit: a hull measures between 1 mm and 1000 km",
            )  # fmt: skip


def _height(sheet: OffsetSheet, column: OffsetColumn, scale: OffsetScale) -> float:
    if column.unit != "t":
        return column.value * column_scale(scale.z, column.unit)
    if scale.draught is None:
        raise BadInputError(
            f"column {column.label!r} is in draughts and the draught is not known",
            sheet.block.source,
            "give draught= in m",
        )
    return column.value * scale.draught


def _rounding(
    sheet: OffsetSheet, hints: OffsetHints, scale: OffsetScale, book: Notebook
) -> FloatArray:
    if not hints.rounding:
        return sheet.half_unit * scale.y
    if len(hints.rounding) != len(sheet.half_unit):
        raise BadInputError(
            f"the comment 'rounding' has {len(hints.rounding)} numbers and the table "
            f"{len(sheet.half_unit)} waterlines",
            sheet.block.source,
            "give one number per waterline",
        )
    book.assume("printed digits", "the comments", "rounding of each waterline as they say")
    return np.array(hints.rounding) * scale.y


def _refuse_wide(
    sheet: OffsetSheet, half_breadth: FloatArray, rounding: FloatArray, scale: OffsetScale
) -> None:
    half = scale.breadth / 2.0
    wide = half_breadth > half + rounding * (1.0 + 1e-6) + 1e-9 * half
    for i, j in np.argwhere(wide):
        column = sheet.columns.waterlines[j]
        times = half_breadth[i, j] / half
        raise BadInputError(
            f"the half-breadth {sheet.offsets[i, j]:g} is {half_breadth[i, j]:.6g} m, {times:.4g} "
            f"times B/2 = {half:.6g} m",
            sheet.where(int(i), column),
            "correct the number, or give breadth= or unit='mm'",
        )


def _places(
    sheet: OffsetSheet, scale: OffsetScale, hints: OffsetHints, station_zero: str, book: Notebook
) -> tuple[FloatArray, float]:
    source = sheet.block.source
    zero = settle_zero(station_zero, hints, book)
    if sheet.x is None:
        x = station_places(sheet.stations, zero, hints, scale.length, book, source)
    else:
        unit = sheet.columns.single["x"].unit
        if zero is not None and station_zero == "auto":
            zero = _zero_of_x(sheet, zero)
        x = given_places(sheet.x * column_scale(scale.x, unit), zero, scale.length, book, source)
    if scale.length is not None:
        return x, scale.length
    length = float(x.max())
    what = f"taken as x of the foremost station, {length:.6g} m"
    book.assume("length", "the table", what, length)
    return x, length


def _zero_of_x(sheet: OffsetSheet, zero: str) -> str:
    """Say where x = 0 is when the comments say where station 0 is: they may be two ends."""
    numbered = np.flatnonzero(np.isfinite(sheet.stations))
    if sheet.x is None or len(numbered) < 2:
        return zero
    first, last = numbered[0], numbered[-1]
    same = (sheet.stations[last] - sheet.stations[first]) * (sheet.x[last] - sheet.x[first]) > 0
    return zero if same else {"ap": "fp", "fp": "ap"}[zero]


def _column(sheet: OffsetSheet, kind: str, scale: float, order: slice) -> FloatArray | None:
    values = sheet.single(kind)
    if values is None:
        return None
    unit = sheet.columns.single[kind].unit
    return np.array(values[order] * column_scale(scale, unit))


def _depth(x: FloatArray, deck: FloatArray | None, length: float) -> float | None:
    if deck is None or not np.isfinite(deck).any():
        return None
    known = np.isfinite(deck)
    return float(np.interp(length / 2.0, x[known], deck[known]))


def _buttocks(
    sheet: OffsetSheet, extra: OffsetSheet | None, scale: OffsetScale, book: Notebook
) -> tuple[FloatArray, FloatArray | None]:
    source = sheet if extra is None else extra
    columns = source.columns.buttocks
    if not columns:
        return np.empty(0), None
    y = np.array([column.value * column_scale(scale.y, column.unit) for column in columns])
    if y[0] < 0 or y[-1] > scale.breadth / 2.0 * (1 + 1e-6):
        raise BadInputError(
            f"the buttocks run from {y[0]:.6g} to {y[-1]:.6g} m, outside 0 to B/2",
            source.block.source,
            "correct the column names, or give breadth= or unit=",
        )
    heights = np.full((len(sheet.labels), len(y)), np.nan)
    own, others = _common(sheet, source)
    for row, place in enumerate(others):
        match = np.flatnonzero(own == place)
        if not len(match):
            raise BadInputError(
                f"station {source.labels[row]} has buttock heights and no half-breadths",
                f"{source.block.source}, row {source.block.lines[row]}",
                "give both blocks the same stations",
            )
        heights[match[0]] = source.heights[row] * scale.z
    missing = int(np.isnan(heights).all(axis=1).sum())
    if missing:
        what = f"{missing} station(s) have no buttock heights"
        book.assume("buttocks", "the table", what, float(missing))
    return y, heights


def _common(one: OffsetSheet, other: OffsetSheet) -> tuple[FloatArray, FloatArray]:
    """Give the stations of two sheets by what both have: numbers if they can, else x."""
    if np.isfinite(one.stations).all() and np.isfinite(other.stations).all():
        return one.stations, other.stations
    if one.x is not None and other.x is not None:
        return one.x, other.x
    raise BadInputError(
        "one block names its stations by number, the other by x",
        other.block.source,
        "give both the same first column",
    )


def _examine(
    table: OffsetTable, sheet: OffsetSheet, scale: OffsetScale, order: slice, book: Notebook
) -> None:
    heights = (str(column.value) for column in sheet.columns.waterlines)
    patient = ExaminedTable(
        sheet.labels[order],
        tuple(text.removesuffix(".0") for text in heights),
        table.x,
        table.z,
        table.half_breadth,
        table.keel,
        table.deck_height,
        table.rounding,
        table.length,
        table.breadth,
        table.draught,
        scale.y,
    )
    examine_offsets(patient, book)


# --------------------------------------------------------------------------------------
# The whole file.


def read_offsets(
    path_or_text: str | Path,
    *,
    length: float | None = None,
    breadth: float | None = None,
    draught: float | None = None,
    unit: str = "auto",
    station_zero: str = "auto",
    name: str | None = None,
    buttocks: str | Path | None = None,
) -> tuple[OffsetTable, OffsetReport]:
    """Read a table of offsets.

    Parameters
    ----------
    path_or_text : str or Path
        A file, or the text itself (a string with a line break).
    length, breadth, draught : float or None
        Lpp, moulded breadth and design draught, m; they override what the comments say.
    unit : {"auto", "m", "mm", "normalised"}
        Unit of half-breadths, waterlines and heights; "normalised" is y/(B/2), z/T, x/Lpp.
    station_zero : {"auto", "ap", "fp"}
        Perpendicular of station 0, or of x = 0 where the file gives x.
    name : str or None
        Name of the table; by default the name of the file without its ending.
    buttocks : str, Path or None
        A second file or text with columns ``bt_<y>`` for the same stations; such a block may
        also follow the waterlines in the first.

    Returns
    -------
    OffsetTable, OffsetReport
        The table in ship axes, and every assumption, repair and suspicion.

    Raises
    ------
    BadInputError
        The input cannot be read, or cannot be read in one way only; the message names row,
        column, number and remedy.
    """
    for key, value in (("length", length), ("breadth", breadth), ("draught", draught)):
        check_particular(key, value)
    book = Notebook()
    text, source = read_text(path_or_text, book)
    comments, blocks = split_blocks(text, source, book)
    hints = read_hints(comments)
    if buttocks is not None:
        blocks += split_blocks(*read_text(buttocks, book), book)[1]
    sheets = [read_sheet(block, book) for block in blocks]
    main, extra = _sort_out(sheets, source)
    _refuse_negative(main)
    largest = float(np.nanmax(main.offsets, initial=0.0))
    broad = float(np.nanpercentile(main.offsets, 95))
    scale = find_scale(unit, largest, broad, hints, length, breadth, draught, book, source)
    table = build_table(main, extra, scale, hints, station_zero, book)
    default = Path(source).stem if source != "text" else "offsets"
    return attrs.evolve(table, name=default if name is None else name), book.report()


def _sort_out(sheets: list[OffsetSheet], source: str) -> tuple[OffsetSheet, OffsetSheet | None]:
    mains = [sheet for sheet in sheets if sheet.columns.waterlines]
    extras = [sheet for sheet in sheets if not sheet.columns.waterlines]
    if len(mains) != 1 or len(extras) > 1:
        raise BadInputError(
            f"{len(mains)} block(s) hold waterlines and {len(extras)} do not",
            source,
            "give one block with columns wl_<height> and at most one with columns bt_<y>",
        )
    shape = mains[0].offsets.shape
    if min(shape) < 2:
        raise BadInputError(
            f"the table has {shape[0]} station(s) and {shape[1]} waterline(s)",
            source,
            "give at least two of each",
        )
    if not np.any(np.nan_to_num(mains[0].offsets) != 0.0):
        raise BadInputError("no half-breadth is above 0", source, "give half-breadths")
    return mains[0], extras[0] if extras else None


def _refuse_negative(sheet: OffsetSheet) -> None:
    for i, j in np.argwhere(sheet.offsets < 0):
        column = sheet.columns.waterlines[j]
        raise BadInputError(
            f"the half-breadth {sheet.offsets[i, j]:g} is negative",
            sheet.where(int(i), column),
            "give half-breadths to port, 0 or more; leave the cell empty below the keel",
        )
