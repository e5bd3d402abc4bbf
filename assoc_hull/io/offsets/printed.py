"""A table of half-breadths as it is printed, for the doctor of offsets: texts, digits, places."""

from __future__ import annotations

import numpy as np

from assoc_hull.fairing.offsets_doctor import PrintedOffsets
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.io.offsets.hints import OffsetHints
from assoc_hull.io.offsets.sheet import OffsetSheet
from assoc_hull.io.tables.cell_numbers import cell_value

__all__ = ["eighths", "printed_offsets", "rows_in_order"]


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
    >>> from assoc_hull.io.offsets.printed import eighths
    >>> eighths(12.53125)
    '12-6-3'
    """
    inches, parts = divmod(round(96.0 * abs(feet)), 8)
    return f"{'-' if feet < 0.0 else ''}{inches // 12}-{inches % 12}-{parts}"
