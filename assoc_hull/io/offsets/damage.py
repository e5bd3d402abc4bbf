"""Damage to whole rows and columns of a table of offsets, named by its place.

A wild value sticks out along its row and its column; a row that was shifted, doubled or exchanged
sticks out along the ship only, and a column along the height only. Rows are judged by the areas of
their sections, columns by how they stand to the two beside them. What the file says of each
station besides its offsets (largest beam, sectional area) is compared.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.polylines.operations import runs_where
from assoc_hull.io.offsets.suspicions import ExaminedTable, predicted_values
from assoc_hull.io.offsets.table import half_section_areas
from assoc_hull.io.reports import Notebook

__all__ = ["compare_areas", "compare_beams", "examine_lines"]


def examine_lines(patient: ExaminedTable, book: Notebook) -> None:
    """Note rows and columns that do not fit those beside them; nothing is changed."""
    _doubled(patient, book)
    _doubled_columns(patient, book)
    _misfits(patient, book)
    _steps(patient, book)
    _gaps(patient, book)
    _cut_off(patient, book)
    _columns(patient, book)


# --------------------------------------------------------------------------------------
# Rows.

_MISFIT, _USUAL = 0.035, 20.0
"""A section this part of the greatest area off its neighbours is told; more of fewer stations."""

_SHARE = 0.25
"""So much of what the areas are off may be left when one is put right; of a shoulder more is."""


def _doubled(patient: ExaminedTable, book: Notebook) -> None:
    """Note stations with the same numbers where the hull changes on either side of them."""
    y, half = np.nan_to_num(patient.y), patient.breadth / 2.0
    step = np.abs(np.diff(y, axis=0))
    same = (step <= 0.2 * patient.rounding).all(axis=1) & (y[1:].max(axis=1) > 0.0)
    change, area = step.mean(axis=1), half_section_areas(patient.y, patient.z)
    empty = (patient.y == 0.0).all(axis=1)
    for i in np.flatnonzero(empty[1:] & empty[:-1]):
        names = f"stations {patient.stations[i]} and {patient.stations[i + 1]}"
        book.suspect("doubled station", names, "both have nothing but zeros: one end too many")
    for i in np.flatnonzero(same):
        # Parallel middle body repeats a section; a run or an entrance does not, nor a fine end.
        if 0 < i < len(area) - 2:
            within = (area[i] - area[i - 1]) * (area[i + 2] - area[i + 1]) > 0.0
        else:
            within = area[i] < 0.5 * area.max()
        beside = [change[k] for k in (i - 1, i + 1) if 0 <= k < len(change)]
        if within and max(beside, default=0.0) > 0.02 * half:
            names = f"stations {patient.stations[i]} and {patient.stations[i + 1]}"
            what = "all their half-breadths are the same, and the hull changes beside them"
            book.suspect("doubled station", names, what, float(patient.x[i + 1] - patient.x[i]))


_CHANGE = 5e-3
"""Part of the half-breadth by which columns beside two of the same numbers must differ."""


def _doubled_columns(patient: ExaminedTable, book: Notebook) -> None:
    """Note waterlines with the same numbers at all stations, where those beside them differ.

    Of a hull with upright sides those above or below are the same too.
    """
    y = np.nan_to_num(patient.y)
    step = np.abs(np.diff(y, axis=1))
    same = (step <= 0.2 * patient.rounding[:-1]).all(axis=0) & (y[:, 1:].max(axis=0) > 0.0)
    change, half = step.mean(axis=0), patient.breadth / 2.0
    least = np.maximum(_CHANGE * half, 5.0 * patient.rounding[:-1])
    for j in np.flatnonzero(same[1:-1]) + 1:
        if min(change[j - 1], change[j + 1]) > least[j]:
            names = f"waterlines at {patient.z[j]:.6g} and {patient.z[j + 1]:.6g} m"
            what = "all their half-breadths are the same, and the hull changes beside them"
            book.suspect("doubled waterline", names, what, float(patient.z[j + 1] - patient.z[j]))


def _misfits(patient: ExaminedTable, book: Notebook) -> None:
    """Note stations whose area does not fit those beside them, the worst first."""
    x, area, first = _along_hull(patient)
    if len(area) < 7:
        return
    limit = _MISFIT * max(1.0, _USUAL / len(area)) ** 1.5
    for _ in range(3):
        wanted = predicted_values(x, area)
        off = area - wanted
        before = _unevenness(x, area)
        best, left = -1, 1.0
        for i in np.flatnonzero(np.abs(np.nan_to_num(off)) > limit):
            tried = area.copy()
            tried[i] = wanted[i]
            part = _unevenness(x, tried) / before
            if part < left:
                best, left = int(i), part
        if best < 0 or left > _SHARE:
            return
        what = (
            f"its section is {100.0 * abs(off[best]):.2g} % of the greatest area too "
            f"{'full' if off[best] > 0 else 'fine'} for its neighbours: another station's numbers, "
            "another unit, or another place?"
        )
        where = f"station {patient.stations[first + best]}"
        book.suspect("station misfit", where, what, float(off[best]))
        area[best] = wanted[best]


def _along_hull(patient: ExaminedTable) -> tuple[FloatArray, FloatArray, int]:
    """Give x and areas over the greatest, with one nil at either end, and the first station."""
    area = half_section_areas(patient.y, patient.z)
    wet = np.flatnonzero(area > 0.0)
    if not len(wet):
        return patient.x[:0], area[:0], 0
    first, last = max(int(wet[0]) - 1, 0), min(int(wet[-1]) + 2, len(area))
    return patient.x[first:last], area[first:last] / float(area.max()), first


_STEP = 0.012
"""Part of the greatest area that a section is off its neighbours where a step is looked for."""


def _steps(patient: ExaminedTable, book: Notebook) -> None:
    """Note an interval across which the areas fit if it is wider: rows that were moved up."""
    x, area, first = _along_hull(patient)
    best = _moved_from(x, area, _STEP) if len(area) > 8 else -1
    if best >= 0:
        best += first
        names = f"between stations {patient.stations[best]} and {patient.stations[best + 1]}"
        what = "the sections change as over twice the distance: is a row missing, others moved up?"
        book.suspect("shifted stations", names, what, float(patient.x[best + 1] - patient.x[best]))


def _moved_from(x: FloatArray, value: FloatArray, least: float) -> int:
    """Give the interval across which values fit if it is twice as wide; -1 if there is none."""
    off = np.abs(np.nan_to_num(value - predicted_values(x, value)))
    before = _unevenness(x, value)
    best, left = -1, _SHARE
    for i in np.flatnonzero(np.minimum(off[:-1], off[1:]) > least):
        moved = np.where(np.arange(len(x)) > i, x + (x[i + 1] - x[i]), x)
        part = _unevenness(moved, value) / before
        if part < left:
            best, left = int(i), part
    return best


def _unevenness(x: FloatArray, value: FloatArray) -> float:
    """Give the sum of squares of what values are off their neighbours, along x."""
    off = np.nan_to_num(value - predicted_values(x, value))
    return float(np.sum(off**2)) + 1e-12


def _gaps(patient: ExaminedTable, book: Notebook) -> None:
    """Note a lone interval longer than both beside it: a station that is missing."""
    step = np.diff(patient.x)
    for i in range(1, len(step) - 1):
        beside = max(step[i - 1], step[i + 1])
        if step[i] > 1.4 * beside:
            names = f"between stations {patient.stations[i]} and {patient.stations[i + 1]}"
            what = f"{step[i]:.4g} m apart, those beside them {beside:.4g} m: is one missing?"
            book.suspect("missing station", names, what, float(step[i]))


_END = 0.06
"""A stem has no larger part of the greatest section below the draught than this."""

_FLAT = 0.5
"""Nothing but a flat end has as large a part as this."""

_SHORT = 0.01
"""So large a part of it may be left where a table ends short of a perpendicular."""


def _cut_off(patient: ExaminedTable, book: Notebook) -> None:
    """Note a table that ends in a section short of the perpendicular."""
    area = half_section_areas(patient.y, patient.z, patient.draught)
    largest = float(area.max())
    if len(area) < 5 or largest <= 0.0:
        return
    ends = (
        (0, patient.x[0], patient.x[1] - patient.x[0], "aft"),
        (-1, patient.length - patient.x[-1], patient.x[-1] - patient.x[-2], "forward"),
    )
    for i, short, step, name in ends:
        part = float(area[i]) / largest
        reached = short < 0.4 * step
        blunt = name == "forward" and part > _END and patient.draught is not None
        blunt = blunt or part > _FLAT
        if (not reached and part > _SHORT) or blunt:
            where = f"{name} of station {patient.stations[i]}"
            share = f"{100 * part:.{3 if part >= 0.1 else 2}g} %"
            what = f"the table ends in a section of {share} of the greatest"
            gap = f", {short:.4g} m from the perpendicular" if not reached else ""
            asks = "is a station missing?"
            if part > _FLAT:
                end = "transom" if i == 0 else "bow end"
                asks += (
                    " If she ends flat there, a column keel that ends there makes it the edge "
                    f"'{end}'; without one give her as lines with that end as a curve '{end}'"
                )
            book.suspect("missing station", where, f"{what}{gap}: {asks}", part)


# --------------------------------------------------------------------------------------
# Columns.

_STANDS_OUT = 0.01
"""Part of B/2 by which a cell passes both beside it, up and down, to count against a column."""

_MANY = 0.3
"""Part of the stations at which a column must stand out: bulbs and tumblehome are at fewer."""

_FAR_OUT, _RUN = 2.0, 4
"""Or so many stations in a row, by so many times as much."""


def _columns(patient: ExaminedTable, book: Notebook) -> None:
    """Note waterlines that are wider, or narrower, than both beside them at many stations."""
    y, half = patient.y, patient.breadth / 2.0
    count = y.shape[1]
    if count < 3 or y.shape[0] < 5:
        return
    for j in range(count):
        beside = [k for k in (j - 1, j + 1) if 0 <= k < count]
        over = np.min([y[:, j] - y[:, k] for k in beside], axis=0)
        under = np.min([y[:, k] - y[:, j] for k in beside], axis=0)
        known = np.isfinite(over)
        total = max(int(known.sum()), 1)
        words = [("wider", over)] if j < count - 1 else [("wider", _many_times(y, j))]
        words += [("narrower", under)] if j > 0 else []
        for word, off in words:
            limit = _STANDS_OUT * half + 3.0 * patient.rounding[j]
            # The highest waterline has one beside it only, and some hulls tumble home.
            limit = limit if j < count - 1 else 6.0 * limit
            out = known & (off > limit)
            if out.sum() > max(_MANY * total, 2) or _runs(known & (off > _FAR_OUT * limit)):
                _tell_column(patient, j, word, float(np.median(off[out])), int(out.sum()), book)


def _many_times(y: FloatArray, j: int) -> FloatArray:
    """Give what a waterline is wider than three times the one below it; nan where that is nil."""
    below = np.where(y[:, j - 1] > 0.0, y[:, j - 1], np.nan)
    return np.asarray(y[:, j] - 3.0 * below)


def _runs(out: NDArray[np.bool_]) -> bool:
    """Tell whether so many stations in a row stand out."""
    return bool((np.diff(runs_where(out), axis=1) >= _RUN).any())


def _tell_column(
    patient: ExaminedTable, j: int, word: str, off: float, count: int, book: Notebook
) -> None:
    names = " and ".join(
        patient.waterlines[k] for k in (j - 1, j + 1) if 0 <= k < len(patient.waterlines)
    )
    what = (
        f"{word} than {names} at {count} stations, by {off:.3g} m in the median: are columns "
        "exchanged, or in another unit?"
    )
    book.suspect("waterline misfit", f"waterline {patient.waterlines[j]}", what, off)


# --------------------------------------------------------------------------------------
# What the file says of each station.

_AREA = 0.025
"""Ratios of areas agree within this: those of a table are by other rules than trapezoids."""


def compare_areas(patient: ExaminedTable, told: FloatArray | None, book: Notebook) -> None:
    """Compare a column of sectional areas, or of their ratios, with the sections."""
    if told is None or not np.isfinite(told).any() or np.nanmax(told) <= 0.0:
        return
    area = half_section_areas(patient.y, patient.z, patient.draught)
    found = area / max(float(area.max()), 1e-300)
    wanted = told / np.nanmax(told)
    off = found - wanted
    book.assume("check", "sectional areas", "a column of them was compared, and is no geometry")
    for i in np.flatnonzero(np.abs(np.nan_to_num(off)) > _AREA):
        what = f"its area is {found[i]:.3f} of the greatest, the column says {wanted[i]:.3f}"
        book.suspect("sectional area", f"station {patient.stations[i]}", what, float(off[i]))


def compare_beams(patient: ExaminedTable, told: FloatArray | None, book: Notebook) -> None:
    """Compare a column of the largest beam of each station, or half of it, with the offsets."""
    if told is None:
        return
    largest = np.nanmax(np.nan_to_num(patient.y), axis=1)
    known = np.isfinite(told) & (told > 0.0) & (largest > 0.0)
    if known.sum() < 3:
        return
    book.assume("check", "largest beam", "a column of it was compared, and is no geometry")
    # One factor for all, whatever its unit and whether it is half of the beam.
    factor = float(np.median(largest[known] / told[known]))
    off = np.where(known, largest - factor * told, 0.0)
    for i in np.flatnonzero(np.abs(off) > 0.01 * patient.breadth / 2.0):
        what = f"its largest half-breadth is {largest[i]:.6g} m, the column says "
        what += f"{factor * told[i]:.6g} m"
        book.suspect("largest beam", f"station {patient.stations[i]}", what, float(off[i]))


# --------------------------------------------------------------------------------------
# What a table leaves open between the keel and the lowest half-breadth of a station.

_OPEN_BOTTOM = 3e-3
"""Told where more than this part of V hangs on it."""


def examine_bottom(patient: ExaminedTable, book: Notebook) -> None:
    """Tell where the keel has a height and the next half-breadth over it is wide already.

    Between the two a section may be flat or sharp: it is drawn straight, and half of what lies
    between these two may be wrong.
    """
    if len(patient.x) < 3:
        return
    y, z = np.nan_to_num(patient.y), patient.z
    rows = np.arange(len(y))
    wide = y > 0.0
    first = np.argmax(wide, axis=1)
    # Without heights of the keel the last blank below a half-breadth tells how low it may be.
    under = np.maximum(first - 1, 0)
    blank = np.isnan(patient.y[rows, under]) & (first > 0)
    keel = np.where(blank, z[under], z[first]) if patient.keel is None else patient.keel
    gap = np.where(wide.any(axis=1), z[first] - keel, 0.0)
    gap = np.nan_to_num(np.where(gap > 0.0, gap, 0.0))
    # As the lowest two half-breadths run on, so broad is the bottom at the keel, if at all.
    above = np.minimum(first + 1, y.shape[1] - 1)
    rise = np.maximum(z[above] - z[first], 1e-300)
    slope = np.where(above > first, (y[rows, above] - y[rows, first]) / rise, 0.0)
    flat = np.clip(y[rows, first] - gap * np.maximum(slope, 0.0), 0.0, None)
    open_area = flat * gap  # both sides, between a straight line and a flat bottom
    area = 2.0 * half_section_areas(patient.y, patient.z, patient.draught)
    volume, doubt = (float(np.trapezoid(each, patient.x)) for each in (area, open_area))
    # Sections of no area are told elsewhere: of nothing no part can be missing.
    if not volume > 0.0 or not doubt > _OPEN_BOTTOM * volume:
        return
    large = np.flatnonzero(open_area > 0.25 * open_area.max())
    names = ", ".join(patient.stations[i] for i in large[:_NAMED].tolist())
    worst = int(open_area.argmax())
    what = (
        f"between the keel and the lowest half-breadth the table says nothing, at station "
        f"{patient.stations[worst]} over {gap[worst]:.3g} m below {y[worst, first[worst]]:.4g} m: "
        f"drawn straight; if the bottom is flat there V is {100.0 * doubt / volume:.2g} % too "
        "small: give waterlines nearer to the keel, or a half-breadth of the bottom at its height"
    )
    book.suspect("open bottom", f"stations {names}", what, doubt / volume)


_NAMED = 12
