"""Reading a table of offsets: half-breadths by station and waterline, heights of buttocks.

`read_offsets` takes comma-, semicolon- or tab-separated text or a workbook in metres, millimetres
or normalised form (y/(B/2), z/T), and gives a table in ship axes (m, x from the AP) with a report
of all that it assumed, repaired and found suspicious. What it cannot settle it refuses.
"""

from __future__ import annotations

from pathlib import Path

import attrs
import numpy as np

from assoc_hull.arguments import number
from assoc_hull.errors import BadInputError
from assoc_hull.fairing.offsets_doctor import PrintedOffsets, examine
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.io.offsets.damage import (
    compare_areas,
    compare_beams,
    examine_bottom,
    examine_lines,
)
from assoc_hull.io.offsets.hints import OffsetHints, read_hints
from assoc_hull.io.offsets.scale import (
    OffsetScale,
    PrintedSizes,
    column_scale,
    compare_spacing,
    find_scale,
    given_places,
    given_spacing,
    settle_zero,
    station_places,
)
from assoc_hull.io.offsets.sheet import (
    OffsetColumn,
    OffsetSheet,
    printed_offsets,
    read_sheet,
    rows_in_order,
)
from assoc_hull.io.offsets.suspicions import (
    ExaminedTable,
    examine_offsets,
    most_half_breadth,
)
from assoc_hull.io.offsets.table import OffsetTable
from assoc_hull.io.reports import Notebook, OffsetReport
from assoc_hull.io.tables.column_names import column_name
from assoc_hull.io.tables.table_blocks import split_blocks
from assoc_hull.io.tables.table_text import read_text, refuse_long
from assoc_hull.io.units import check_particular
from assoc_hull.tolerance import length_factor

__all__ = [
    "build_table",
    "read_offsets",
    "read_printed",
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
    _refuse_wide(sheet, half_breadth, rounding, scale, book)
    x, length = _places(sheet, scale, hints, station_zero, book)
    order = slice(None) if x[0] < x[-1] else slice(None, None, -1)
    if x[0] > x[-1]:
        what = f"the file runs from forward (station {sheet.labels[0]}) aft; turned round"
        book.repair("station order", "the table", what)
    buttock_y, buttock_height = _buttocks(sheet, extra, scale, book)
    z = np.array([_height(sheet, column, scale, hints) for column in sheet.columns.waterlines])
    _at_draught(z, scale.draught, book)
    top = 3.0 * max(abs(float(z[0])), float(z[-1]))
    deck = _column(sheet, "deck height", (scale.z, scale.y), top, order, book)
    table = OffsetTable(
        name="",
        x=x[order].copy(),
        z=z,
        half_breadth=half_breadth[order].copy(),
        keel=_keel(_column(sheet, "keel", (scale.z, scale.y), top, order, book), length, book),
        deck_height=deck,
        deck_half_breadth=_column(
            sheet, "deck half-breadth", (scale.y, scale.z), scale.breadth, order, book
        ),
        buttock_y=buttock_y,
        buttock_height=None if buttock_height is None else buttock_height[order].copy(),
        length=length,
        breadth=scale.breadth,
        draught=scale.draught,
        depth=_depth(x[order], deck, length),
        rounding=rounding,
        station=sheet.stations[order].copy(),
        level=_levels(sheet, scale, hints),
        stated=hints.stated(),
    )
    table = _with_plumb_ends(table, _named(sheet)[order], book)
    _refuse_size(table, sheet.block.source)
    _examine(table, sheet, hints, scale, order, book)
    return table


_RUNS_OUT = 0.15
"""Waterlines run out at a blank station where the parabola through their last three offsets comes
to the centre plane there, within this part of the last of them."""


def _with_plumb_ends(table: OffsetTable, names: tuple[str, ...], book: Notebook) -> OffsetTable:
    """Read a blank first or last station as zeros where all waterlines run out there, and tell it.

    A raked or overhanging end, or one with heights of a keel, is left as it is.
    """
    count = len(table.x)
    if count < 5 or table.keel is not None:
        return table
    y = table.half_breadth.copy()
    for end, beside in ((0, (1, 2, 3)), (count - 1, (count - 2, count - 3, count - 4))):
        open_end = np.isnan(y[end]).any() and not (np.nan_to_num(y[end]) > 0.0).any()
        if not open_end or not _run_out_at(table, end, beside):
            continue
        y[end] = 0.0
        what = (
            "without a half-breadth, and all waterlines run out there: blanks read as zeros, a "
            f"plumb end at x = {table.x[end]:.6g} m"
        )
        book.assume("plumb end", f"station {names[end]}", what, float(table.x[end]))
    if _reaches_lowest(table.z, y):
        y[:, 0] = 0.0
        what = "blank, and all sections run down to it: read as zeros, the edge of the keel"
        book.assume("keel", "the lowest waterline", what, float(table.z[0]))
    return attrs.evolve(table, half_breadth=y)


def _reaches_lowest(z: FloatArray, y: FloatArray) -> bool:
    """Tell whether a lowest waterline without a half-breadth, of blanks, is the edge of a keel.

    So it is where the straight line through the lowest two offsets of no station ends above it.
    """
    low, one, two = y[:, 0], y[:, 1], y[:, 2] if len(z) > 2 else y[:, 1]
    hull = (np.nan_to_num(y) > 0.0).any(axis=1)
    if not np.isnan(low[hull]).all() or not (one[hull] > 0.0).all() or not hull.any():
        return False
    rise = (two - one)[hull]
    return bool((one[hull] * (z[min(2, len(z) - 1)] - z[1]) >= rise * (z[1] - z[0])).all())


def _run_out_at(table: OffsetTable, end: int, beside: tuple[int, int, int]) -> bool:
    """Tell whether all waterlines of the three stations beside an end come to 0 at it."""
    y, x = table.half_breadth[list(beside)], table.x[list(beside)]
    wide = np.asarray((np.nan_to_num(y) > 0.0).all(axis=0))
    # From the lowest that has a breadth on, each goes on.
    first = int(np.argmax(wide))
    if first > 1 or not wide[first:].all():
        return False
    a, b, c = x - table.x[end]
    left = (
        y[0] * b * c / ((a - b) * (a - c))
        + y[1] * a * c / ((b - a) * (b - c))
        + y[2] * a * b / ((c - a) * (c - b))
    )
    return bool((np.abs(left[wide]) <= _RUNS_OUT * y[0, wide]).all())


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


def _height(
    sheet: OffsetSheet, column: OffsetColumn, scale: OffsetScale, hints: OffsetHints
) -> float:
    if _are_numbered(sheet, hints):
        assert hints.level_spacing is not None
        return column.value * hints.level_spacing
    if column.unit != "t":
        return column.value * column_scale(scale.z, column.unit)
    if scale.draught is None:
        raise BadInputError(
            f"column {column.label!r} is in draughts and the draught is not known",
            sheet.block.source,
            "give draught= in m",
        )
    return column.value * scale.draught


def _are_numbered(sheet: OffsetSheet, hints: OffsetHints) -> bool:
    """Tell whether waterlines go by number: whole ones, and halves and quarters at the bottom."""
    columns = sheet.columns.waterlines
    numbered = all(each.unit is None and (4.0 * each.value).is_integer() for each in columns)
    return bool(hints.level_spacing) and numbered


def _levels(sheet: OffsetSheet, scale: OffsetScale, hints: OffsetHints) -> FloatArray | None:
    """Give the waterlines as printed, (w,), where these are no heights; else None."""
    columns = sheet.columns.waterlines
    # At a draught of 1 m parts and heights are the same numbers.
    parts = (
        each.unit == "t" or column_scale(scale.z, each.unit) == scale.draught for each in columns
    )
    if not _are_numbered(sheet, hints) and not all(parts):
        return None
    return np.array([each.value for each in columns])


_CONVERTED = 2e-4
"""A highest waterline below the draught by no more of it is the draught in another unit."""


def _at_draught(z: FloatArray, draught: float | None, book: Notebook) -> None:
    """Put the highest waterline at the draught where only its printed digits keep it below."""
    if draught is not None and 0.0 < draught - z[-1] <= _CONVERTED * draught:
        below = draught - float(z[-1])
        if below > 1e-9 * draught:
            what = f"{1e3 * below:.2g} mm below the draught as printed: taken at {draught:.6g} m"
            book.assume("draught", "the highest waterline", what, below)
        z[-1] = draught


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
    places = np.argsort([column.index for column in sheet.columns.waterlines])
    rounding = np.empty(len(places))
    rounding[places] = hints.rounding
    return rounding * scale.y


_PLAINLY = 1.01
"""Beyond so many times B/2 four digits tell it."""

_LONE = 0.02
"""Part of the cells that may be beyond B/2 and count as wrong numbers, not as a wrong unit."""


def _refuse_wide(
    sheet: OffsetSheet,
    half_breadth: FloatArray,
    rounding: FloatArray,
    scale: OffsetScale,
    book: Notebook,
) -> None:
    """Refuse half-breadths beyond B/2; a few among many are faults of the table."""
    half = scale.breadth / 2.0
    wide = np.argwhere(half_breadth > most_half_breadth(half, rounding))
    lone = len(wide) <= max(1.0, _LONE * half_breadth.size)
    for i, j in wide:
        column = sheet.columns.waterlines[j]
        times = half_breadth[i, j] / half
        told = f"{times:.4g}" if times > _PLAINLY else f"{times:.6g}"
        what = (
            f"the half-breadth {sheet.offsets[i, j]:g} is {half_breadth[i, j]:.6g} m, {told} "
            f"times B/2 = {half:.6g} m"
        )
        remedy = "correct the number, or give breadth= or unit='mm'"
        if not lone:
            raise BadInputError(what, sheet.where(int(i), column), remedy)
        near = _neighbours(half_breadth, int(i), int(j))
        says = f", beside {near / scale.y:.4g} on average" if near else ""
        amount = float(half_breadth[i, j]) - half
        book.fault("outlier", sheet.where(int(i), column), f"{what}{says}: {remedy}", amount)


def _neighbours(y: FloatArray, i: int, j: int) -> float:
    """Give the mean of the cells beside one, along station and waterline."""
    beside = [(i - 1, j), (i + 1, j), (i, j - 1), (i, j + 1)]
    known = [y[a, b] for a, b in beside if 0 <= a < y.shape[0] and 0 <= b < y.shape[1]]
    known = [value for value in known if np.isfinite(value)]
    return float(np.mean(known)) if known else 0.0


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


def _column(
    sheet: OffsetSheet,
    kind: str,
    scales: tuple[float, float],
    most: float,
    order: slice,
    book: Notebook,
) -> FloatArray | None:
    """Give a column, m; by its own unit, else by the first of `scales` that keeps below `most`."""
    values = sheet.single(kind)
    if values is None:
        return None
    column = sheet.columns.single[kind]
    largest = float(np.nanmax(np.abs(values), initial=0.0))
    fitting = [scale for scale in scales if largest * scale < most]
    scale = (fitting or scales)[0]
    if scale != scales[0] and column.unit is None:
        what = f"in another unit than the rest: up to {largest:g}, read as {largest * scale:.6g} m"
        book.assume("unit", f"column {column.label!r}", what, largest * scale)
    return np.array(values[order] * column_scale(scale, column.unit))


_LEVEL = 1e-6
"""A keel nearer than this (m, of a hull of 100 m and more) to the base line lies in it."""


def _keel(keel: FloatArray | None, length: float, book: Notebook) -> FloatArray | None:
    """Leave a keel out that is the base line all along: it says what no column says."""
    if keel is None or not (np.abs(keel) <= _LEVEL * length_factor(length)).all():
        return keel
    book.assume("keel", "the table", "level at the base line at every station, as without a column")
    return None


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
    table: OffsetTable, sheet: OffsetSheet, hints: OffsetHints, scale: OffsetScale, order: slice,
    book: Notebook,
) -> None:  # fmt: skip
    heights = (str(column.value) for column in sheet.columns.waterlines)
    patient = ExaminedTable(
        _named(sheet)[order],
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
        sheet.printed_unit == "ft",
    )
    examine_offsets(patient, printed_offsets(sheet, hints, ""), book)
    examine_lines(patient, book)
    examine_bottom(patient, book)
    areas, beams = sheet.single("area"), sheet.single("beam")
    compare_areas(patient, None if areas is None else areas[order], book)
    compare_beams(patient, None if beams is None else beams[order], book)


def _named(sheet: OffsetSheet) -> tuple[str, ...]:
    """Give the names of the stations, x where a name is blank."""
    if sheet.x is None:
        return sheet.labels
    return tuple(
        name or f"x = {x:g}" for name, x in zip(sheet.labels, sheet.x.tolist(), strict=True)
    )


# --------------------------------------------------------------------------------------
# A table of one of two hulls, of which half-breadths are counted from the ship's centre plane. It
# has the outer side alone: at both ends all waterlines come in to the centre plane of the demihull,
# not to 0. It is refused with that place, and read with ``centre=`` so that they are half-breadths
# of the demihull.

_ONE_END = 1e-3
"""Ends this part of the greatest half-breadth apart are one place."""

_OFF_CENTRE, _FULLER = 0.05, 1.05
"""The centre plane is this part of the greatest half-breadth off; the ship is this much broader."""


def _about_centre(
    sheet: OffsetSheet, centre: float | str | None, source: str, book: Notebook
) -> OffsetSheet:
    """Count half-breadths from a centre plane, in the unit of the table, or find that they must be.

    Raises
    ------
    BadInputError
        Half-breadths of one of two hulls and no centre; a centre with a unit, or inside of which
        half-breadths lie.
    """
    if centre is None:
        place = _common_end(sheet)
        if place is not None:
            raise BadInputError(
                f"there are two hulls side by side: at both ends all half-breadths come in to "
                f"{place:g}, not to 0", source,
                f"give one demihull with centre={place:g}; if this is one hull with blunt ends, "
                "centre=0",
            )  # fmt: skip
        return sheet
    off = _in_unit(centre)
    if off == 0.0:
        return sheet
    # Digits as printed, so that offsets on a flat stay equal.
    y = np.round(sheet.offsets - off, 10)
    slack = _ONE_END * float(np.nanmax(sheet.offsets, initial=0.0))
    if float(np.nanmin(y, initial=0.0)) < -slack:
        i, j = np.unravel_index(int(np.nanargmin(y)), y.shape)
        label = sheet.columns.waterlines[int(j)].label
        raise BadInputError(
            f"the half-breadth {sheet.offsets[i, j]:g} lies inside centre={off:g}",
            f"{source}, station {sheet.labels[int(i)]}, column {label!r}",
            "give the centre plane of the demihull, to whose outer side half-breadths go",
        )  # fmt: skip
    what = (
        f"half-breadths are counted from y = {off:g} of the table, the centre plane of one of two "
        "hulls; its inner side is the image of the outer"
    )
    book.assume("one hull", "the table", what, off)
    y = np.maximum(y, 0.0)
    # A waterline that is all in the centre plane tells no digits: it has those of the others.
    digits, none = sheet.half_unit.copy(), ~(np.nan_to_num(y) > 0.0).any(axis=0)
    if none.any() and not none.all():
        digits[none] = digits[~none].min()
    return attrs.evolve(sheet, offsets=y, half_unit=digits)


def _deck_about_centre(table: OffsetTable, off: float) -> OffsetTable:
    """Count half-breadths of the deck edge from a centre plane, m."""
    if table.deck_half_breadth is None or off == 0.0:
        return table
    return attrs.evolve(table, deck_half_breadth=table.deck_half_breadth - off)


def _in_unit(centre: float | str) -> float:
    if isinstance(centre, str):
        try:
            return float(centre)
        except ValueError:
            raise BadInputError(
                f"centre is {centre!r}", "for a table of offsets",
                "give a number in the unit of its half-breadths",
            ) from None  # fmt: skip
    return number(centre, "centre", "as an argument")


def _common_end(sheet: OffsetSheet) -> float | None:
    """Give the half-breadth to which all waterlines come in at both ends, if it is one above 0."""
    y = sheet.offsets[np.argsort(sheet.place, kind="stable")]
    known = y[np.isfinite(y).any(axis=1)]
    if len(known) < 5:
        return None
    ends: FloatArray = np.concatenate([known[0], known[-1]])
    ends = ends[np.isfinite(ends)]
    most, place = float(np.nanmax(y)), float(np.median(ends))
    apart = max(_ONE_END * most, 2.0 * float(sheet.half_unit.max()))
    same = bool((np.abs(ends - place) <= apart).all())
    outside = float(np.nanmin(y)) >= place - apart
    off = place > _OFF_CENTRE * most and most > _FULLER * place
    return place if same and outside and off else None


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
    station_spacings: int | None = None,
    frame_spacing: float | None = None,
    name: str | None = None,
    buttocks: str | Path | None = None,
    centre: float | str | None = None,
) -> tuple[OffsetTable, OffsetReport]:
    """Read a table of offsets.

    Parameters
    ----------
    path_or_text : str or Path
        A file, or the text itself (a string with a line break).
    length, breadth, draught : float or None
        Lpp, moulded breadth and design draught, m; they override what the comments say.
    unit : str
        "m", "mm", "cm", "ft", "in" or "normalised", which is y/(B/2), z/T, x/Lpp; with commas, as
        "mm,m", of half-breadths, heights and lengths; "auto": as the file says, or as the sizes
        leave no doubt.
    station_zero : {"auto", "ap", "fp"}
        Perpendicular of station 0, or of x = 0 where the file gives x.
    station_spacings : int or None
        Station spacings between the perpendiculars, which the comments may tell too.
    frame_spacing : float or None, m
        The stations are numbers of frames, this far apart.
    name : str or None
        Name of the table; by default the name of the file without its ending.
    buttocks : str, Path or None
        A second file or text with columns ``bt_<y>`` for the same stations; such a block may
        also follow the waterlines in the first.
    centre : float, str or None
        From where half-breadths of one of two hulls are counted: its centre plane, in their unit.

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
    sheets = _read_sheets(path_or_text, book, buttocks, station_spacings, frame_spacing, centre)
    source, main, extra, hints = sheets.source, sheets.main, sheets.extra, sheets.hints
    hints = _with_header(main, hints)
    if hints.full:
        what = f"the comments say {hints.full!r}, and half-breadths are read: give half of each"
        book.suspect("full breadths", source, what)
    scale = find_scale(unit, _sizes(main), hints, length, breadth, draught, book, source)
    if main.zero and not hints.station_zero:
        hints = attrs.evolve(hints, station_zero=main.zero)
    table = build_table(main, extra, scale, hints, station_zero, book)
    spacing = frame_spacing or (station_spacings and table.length / station_spacings)
    if spacing and main.x is not None:
        places = main.x * column_scale(scale.x, main.columns.single["x"].unit)
        name = "station_spacings" if frame_spacing is None else "frame_spacing"
        compare_spacing(name, spacing, main.stations, places, source, book)
    if centre is not None:
        table = _deck_about_centre(table, scale.y * float(centre))
    default = Path(source).stem if source != "text" else "offsets"
    return attrs.evolve(table, name=default if name is None else name), book.report()


@attrs.frozen(eq=False)
class _Sheets:
    """A file as printed: half-breadths, buttocks of a block of their own, and its comments."""

    source: str
    main: OffsetSheet
    extra: OffsetSheet | None
    hints: OffsetHints


def _read_sheets(
    path_or_text: str | Path,
    book: Notebook,
    buttocks: str | Path | None = None,
    station_spacings: int | None = None,
    frame_spacing: float | None = None,
    centre: float | str | None = None,
) -> _Sheets:
    """Read what is printed, before any unit or place is settled; as for `read_offsets`."""
    text, source = read_text(path_or_text, book)
    refuse_long(text, source)
    comments, blocks = split_blocks(text, source, book)
    hints = given_spacing(read_hints(comments), station_spacings, frame_spacing, book)
    if buttocks is not None:
        blocks += split_blocks(*read_text(buttocks, book), book)[1]
    sheets = [read_sheet(block, book) for block in blocks]
    if frame_spacing or station_spacings:
        sheets = [_by_number(sheet, book) for sheet in sheets]
    main, extra = _sort_out(sheets, source)
    main = _to_port(main, book)
    main = _by_beams(main, book)
    if extra is not None and centre is not None:
        what = "buttocks cannot be read with centre"
        raise BadInputError(what, source, "leave out the block of buttocks")
    return _Sheets(source, _about_centre(main, centre, source, book), extra, hints)


def read_printed(
    path_or_text: str | Path, centre: float | str | None = None
) -> tuple[OffsetSheet, PrintedOffsets]:
    """Read the half-breadths of a table as printed, of which neither unit nor length need be known.

    Raises
    ------
    BadInputError
        As for `read_offsets`, but for what it needs besides the numbers.
    """
    found = _read_sheets(path_or_text, Notebook(), centre=centre)
    name = Path(found.source).name if found.source != "text" else "offsets"
    return found.main, printed_offsets(found.main, found.hints, name)


def _by_number(sheet: OffsetSheet, book: Notebook) -> OffsetSheet:
    """Take places under a corner without a name for numbers: a spacing was given for them."""
    column = sheet.columns.single.get("x")
    if sheet.x is None or column is None or column_name(column.label) is not None:
        return sheet
    what = "numbers of stations or frames, since their spacing was given"
    book.assume("corner", sheet.block.source, what)
    others = {kind: each for kind, each in sheet.columns.single.items() if kind != "x"}
    columns = attrs.evolve(sheet.columns, single={**others, "station": column})
    return attrs.evolve(sheet, columns=columns, stations=sheet.x, x=None)


def _sort_out(sheets: list[OffsetSheet], source: str) -> tuple[OffsetSheet, OffsetSheet | None]:
    mains = [sheet for sheet in sheets if sheet.columns.waterlines]
    extras = [sheet for sheet in sheets if not sheet.columns.waterlines]
    if not mains:
        raise _no_waterlines(extras, source)
    if len(mains) != 1 or len(extras) > 1:
        raise BadInputError(
            f"{_blocks(len(mains))} waterlines and {len(extras)} none",
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


def _blocks(count: int) -> str:
    return "1 block holds" if count == 1 else f"{count} blocks hold"


_NAMED = 4
"""So many names of columns that are not understood are quoted."""


def _no_waterlines(sheets: list[OffsetSheet], source: str) -> BadInputError:
    """Give the error of a table without waterlines: which names of columns say nothing known."""
    heads = [each for sheet in sheets for each in sheet.block.header[1:]]
    strange = [each for each in heads if each and column_name(each) is None]
    what = "no column is named as a waterline"
    if strange:
        quoted = ", ".join(map(repr, strange[:_NAMED]))
        more = f" and {len(strange) - _NAMED} more" if len(strange) > _NAMED else ""
        what += f", and these names are not understood: {quoted}{more}"
    remedy = "call each waterline wl_ and its height, as wl_0.5, or give its bare height as 0.5 m"
    return BadInputError(what, source, remedy)


def _to_port(sheet: OffsetSheet, book: Notebook) -> OffsetSheet:
    """Mirror half-breadths to starboard, which have a minus, to port.

    Raises
    ------
    BadInputError
        Single cells have a minus: a slip, or a wrong number.
    """
    y = sheet.offsets
    minus, plus = y < 0.0, y > 0.0
    if not minus.any():
        return sheet
    if not plus.any():
        book.repair("port and starboard", "the table", "all half-breadths have a minus: mirrored")
        return attrs.evolve(sheet, offsets=np.abs(y))
    rows = minus.any(axis=1) & ~plus.any(axis=1)
    columns = minus.any(axis=0) & ~plus.any(axis=0)
    whole = np.logical_or.outer(rows, columns)
    for i, j in np.argwhere(np.logical_and(minus, np.logical_not(whole))):
        column = sheet.columns.waterlines[j]
        raise BadInputError(
            f"the half-breadth {y[i, j]:g} is negative",
            sheet.where(int(i), column),
            "give half-breadths to port, 0 or more; leave the cell empty below the keel",
        )
    lines = [f"station {sheet.labels[i]}" for i in np.flatnonzero(rows)]
    lines += [f"waterline {sheet.columns.waterlines[j].label}" for j in np.flatnonzero(columns)]
    for line in lines:
        what = "all its half-breadths have a minus, those of other lines have none: mirrored"
        book.suspect("port and starboard", line, what)
    return attrs.evolve(sheet, offsets=np.abs(y))


def _by_beams(sheet: OffsetSheet, book: Notebook) -> OffsetSheet:
    """Multiply waterlines that are printed as parts of their own largest value, or check them."""
    beams = sheet.beams
    if beams is None or not np.isfinite(beams).all():
        return sheet
    largest = np.nanmax(sheet.offsets, axis=0)
    if np.allclose(largest, 1.0, atol=2.0 * float(sheet.half_unit.max())) and beams.max() <= 1.0:
        what = "each waterline is printed as parts of its largest value: multiplied by it"
        book.repair("largest beam", "row MaxBm", what)
        return attrs.evolve(sheet, offsets=sheet.offsets * beams, half_unit=sheet.half_unit * beams)
    times = np.median(largest / beams)
    times = 1.0 if times > 0.75 else 0.5  # a row of half-breadths, or of breadths
    for j in np.flatnonzero(np.abs(largest - times * beams) > 0.01 * largest.max()):
        what = f"its largest half-breadth is {largest[j]:g}, the row says {times * beams[j]:g}"
        where = f"waterline {sheet.columns.waterlines[j].label}"
        book.suspect("largest beam", where, what, float(largest[j] - times * beams[j]))
    return sheet


def _with_header(sheet: OffsetSheet, hints: OffsetHints) -> OffsetHints:
    """Take the unit of heights from the names of columns where the comments tell none."""
    single = [sheet.columns.single.get(kind) for kind in ("keel", "deck height")]
    heights = [*sheet.columns.waterlines, *(column for column in single if column is not None)]
    units = {column.unit for column in heights if column.unit}
    if hints.units.z or len(units) != 1:
        return hints
    return attrs.evolve(hints, units=attrs.evolve(hints.units, z=units.pop()))


def _sizes(sheet: OffsetSheet) -> PrintedSizes:
    """Give the sizes by which units are told."""
    waterlines = sheet.columns.waterlines
    bare = all(column.unit is None for column in waterlines)
    top = max(abs(waterlines[0].value), abs(waterlines[-1].value)) if bare else np.nan
    along = None if sheet.x is None else sheet.columns.single["x"].unit
    return PrintedSizes(
        _borne_out(sheet),
        float(np.nanpercentile(sheet.offsets, 95)),
        top,
        float(np.ptp(sheet.x)) if along is None and sheet.x is not None else np.nan,
        sheet.printed_unit,
        along,
    )


_SLIP = 1.5
"""A number is no slip where another, not beside it, is larger than it over this."""


_FAR = 1.05
"""A wild value nearer than this to what its neighbours say may set B as well as another."""


def _borne_out(sheet: OffsetSheet) -> float:
    """Give the largest half-breadth as printed that is no slip: not 15.2 where all say 1.52."""
    y = sheet.offsets.copy()
    for _ in range(3):
        i, j = np.unravel_index(int(np.nanargmax(y)), y.shape)
        rest = y.copy()
        rest[i, j] = np.nan
        other = float(np.nanmax(rest, initial=0.0))
        few = min(y.shape) < 4
        if few or float(y[i, j]) <= _SLIP * other or other == 0.0:
            break
        y[i, j] = np.nan
    return _without_wild(sheet, y)


def _without_wild(sheet: OffsetSheet, y: FloatArray) -> float:
    """Leave a wild value out where it is the largest of all."""
    rows = rows_in_order(sheet)
    told = examine(printed_offsets(sheet, OffsetHints(), ""), top=0)
    for slip in told.alarms:
        i, j = rows[slip.row], slip.column
        better = float(sheet.offsets[i, j]) - slip.off
        if y[i, j] == np.nanmax(y) and better * _FAR < y[i, j]:
            y[i, j] = np.nan
    return float(np.nanmax(y, initial=0.0))
