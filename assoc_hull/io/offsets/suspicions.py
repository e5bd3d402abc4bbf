"""Suspicions on a table of offsets: slips of the hand, blanks, sizes that no ship has.

Nothing is changed; every suspicion is noted with its place. Single numbers are the business of
`assoc_hull.fairing.offsets_doctor`.
"""

from __future__ import annotations

from collections.abc import Iterator

import attrs
import numpy as np

from assoc_hull.fairing.offsets_doctor import PrintedOffsets, examine
from assoc_hull.fairing.table_residuals import SHARED
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.io.offsets.sheet import eighths
from assoc_hull.io.reports import Notebook
from assoc_hull.tolerance import length_factor

__all__ = [
    "BLANK_INSIDE",
    "ExaminedTable",
    "examine_offsets",
    "most_half_breadth",
    "predicted_values",
]

BLANK_INSIDE = "blank between numbers"
"""How a cell without a number is told that parts a section in two."""

_DIGITS = 5e-4
"""A breadth of four digits is told to this part of itself."""


def most_half_breadth(half: float, rounding: FloatArray) -> FloatArray:
    """Give what a half-breadth may be beside B/2, (w,), m, by what both are rounded to."""
    return np.asarray(half + np.maximum(rounding * (1.0 + 1e-6), _DIGITS * half))


def predicted_values(place: FloatArray, value: FloatArray) -> FloatArray:
    """Give each value as its neighbours would have it: at ascending places (n,), all finite.

    It makes the sum of squared third divided differences least, all others held; nan for the first
    and the last, and where n < 5.
    """
    count = len(place)
    out = np.full(count, np.nan)
    if count < 5:
        return out
    window = np.arange(count - 3)[:, None] + np.arange(4)
    u = place[window]
    gap = u[:, :, None] - u[:, None, :] + np.eye(4)
    weight = 6.0 * ((u[:, -1] - u[:, 0]) / 3.0)[:, None] ** 3 / np.prod(gap, axis=2)
    rows = np.zeros((count - 3, count))
    np.put_along_axis(rows, window, weight, axis=1)
    out[:] = value - (rows.T @ (rows @ value)) / np.sum(rows**2, axis=0)
    out[[0, -1]] = np.nan
    return out


# --------------------------------------------------------------------------------------
# All suspicions on a table in ship axes.


@attrs.frozen(eq=False)
class ExaminedTable:
    """A table in ship axes with the names of its rows and columns.

    Attributes
    ----------
    stations, waterlines : tuple of str
        Names as printed.
    x : (s,), m
    z : (w,), m
    y : (s, w), m
        Half-breadths, nan for blanks.
    keel, deck : (s,) or None, m
        Local heights.
    rounding : (w,), m
    length, breadth : float, m
    draught : float or None, m
    printed : float
        Metres to one unit of the printed half-breadths.
    eighths : bool
        Half-breadths are printed in feet-inches-eighths.
    """

    stations: tuple[str, ...]
    waterlines: tuple[str, ...]
    x: FloatArray
    z: FloatArray
    y: FloatArray
    keel: FloatArray | None
    deck: FloatArray | None
    rounding: FloatArray
    length: float
    breadth: float
    draught: float | None
    printed: float
    eighths: bool = False

    def where(self, i: int, j: int) -> str:
        """Name a cell."""
        return f"station {self.stations[i]}, waterline {self.waterlines[j]}"

    def says(self, value: float) -> str:
        """Write a half-breadth in m, and as printed where that differs."""
        if self.printed == 1.0:
            return f"{value:.6g} m"
        number = value / self.printed
        return f"{value:.6g} m (printed {eighths(number) if self.eighths else f'{number:.6g}'})"

    def amidships(self) -> Iterator[int]:
        """Give the stations within a tenth of the length from amidships."""
        yield from map(int, np.flatnonzero(np.abs(self.x / self.length - 0.5) <= 0.1))


def examine_offsets(patient: ExaminedTable, printed: PrintedOffsets, book: Notebook) -> None:
    """Note every suspicion on a table, also as it is printed; nothing is changed."""
    _values(patient, printed, book)
    _blanks(patient, book)
    _beyond(patient, book)
    _per_waterline(patient, book)
    _sizes(patient, book)
    _narrowing(patient, book)
    _bottom(patient, book)
    _ends(patient, book)


def _values(patient: ExaminedTable, printed: PrintedOffsets, book: Notebook) -> None:
    """Note what the doctor of offsets calls a slip, and what its rules say."""
    told = examine(printed, top=0)
    for remark in told.remarks:
        # Lines are read coarser than others for many reasons; one that is doubled is a misfit.
        if remark.kind != SHARED:
            book.suspect(remark.kind, remark.where, remark.what, remark.amount)
    for slip in told.alarms:
        off = slip.off * float(printed.worth[slip.column]) * patient.printed
        value = float(printed.y[slip.row, slip.column]) * patient.printed
        what = (
            f"{patient.says(value)} is {off:+.3g} m off its neighbours, which say "
            f"{patient.says(value - off)}"
        )
        what += "".join(f"; {each.text}: {each.slip}?" for each in slip.numbers[:1])
        where = f"station {slip.station}, waterline {slip.waterline}"
        book.suspect("outlier", where, what, off)


_LEVEL = 1e-3
"""m: heights that differ by less are one."""


def _keel_at_deck(patient: ExaminedTable, i: int) -> bool:
    """Tell whether a first or last station is a point: its keel is as high as the deck."""
    if patient.keel is None or i not in (0, len(patient.y) - 1):
        return False
    deck = patient.z[-1] if patient.deck is None else np.fmin(patient.deck[i], patient.z[-1])
    return bool(patient.keel[i] >= deck - _LEVEL)


def _blanks(patient: ExaminedTable, book: Notebook) -> None:
    for i, row in enumerate(patient.y):
        known = np.flatnonzero(np.isfinite(row))
        if not len(known):
            if _keel_at_deck(patient, i):
                continue  # there the stem or stern meets the deck: no half-breadth is left
            book.suspect("blank", f"station {patient.stations[i]}", "the station has no offset")
            continue
        _outer_blanks(patient, i, int(known[0]), int(known[-1]), book)
        inner = np.arange(int(known[0]), int(known[-1]))
        blank = inner[np.isnan(row[inner])]
        ended = [j for j in blank if _ended(patient.y[:, j], i) and not _among_zeros(row, int(j))]
        if ended:
            what = f"{len(ended)} blanks between numbers, and none farther out: the hull ended"
            book.assume("blank", f"station {patient.stations[i]}", what, float(len(ended)))
        for j in blank:
            if j not in ended:
                book.suspect("blank", patient.where(i, int(j)), f"{BLANK_INSIDE}: fill the cell")


def _among_zeros(row: FloatArray, j: int) -> bool:
    """Tell whether the numbers next to a blank, below and above, are zeros."""
    known = np.flatnonzero(np.isfinite(row))
    return bool(row[known[known < j][-1]] == 0.0 and row[known[known > j][0]] == 0.0)


def _ended(line: FloatArray, i: int) -> bool:
    """Tell whether a waterline has no half-breadth from a station on to one of its ends."""
    return not (np.nan_to_num(line[:i]).any() and np.nan_to_num(line[i:]).any())


def _outer_blanks(patient: ExaminedTable, i: int, first: int, last: int, book: Notebook) -> None:
    # Of a hull of 100 m and more.
    slack = 1e-3 * length_factor(patient.length)
    if first and patient.keel is None:
        what = f"blanks below waterline {patient.waterlines[first]} read as below the local keel"
        book.assume("blank", f"station {patient.stations[i]}", what, float(patient.z[first]))
    if last + 1 < len(patient.z) and patient.deck is None:
        what = f"blanks above waterline {patient.waterlines[last]} read as above the deck"
        book.assume("blank", f"station {patient.stations[i]}", what, float(patient.z[last]))
    keel = -np.inf if patient.keel is None else patient.keel[i]
    deck = np.inf if patient.deck is None else patient.deck[i]
    for j, z in enumerate(patient.z):
        # Where keel or deck is not known, a blank has been read as beyond it.
        if (j < first and z > keel + slack and np.isfinite(keel)) or (
            j > last and z < deck - slack and np.isfinite(deck)
        ):
            what = f"blank, though {z:.6g} m is between keel {keel:.6g} m and deck {deck:.6g} m"
            book.suspect("blank", patient.where(i, j), what, float(z))
        # A zero says of a place outside what a blank says.
        elif first <= j <= last and patient.y[i, j] > 0 and not keel - slack <= z <= deck + slack:
            what = f"a number, though {z:.6g} m is outside keel {keel:.6g} m to deck {deck:.6g} m"
            book.suspect("blank", patient.where(i, j), what, float(z))


def _beyond(patient: ExaminedTable, book: Notebook) -> None:
    half = patient.breadth / 2.0
    # What is beyond B/2 by more than its rounding is a fault, and told with its cell.
    within = most_half_breadth(half, patient.rounding)
    above = (patient.y > half * (1.0 + 1e-12)) & (patient.y <= within)
    if above.any():
        most = float(patient.y[above].max()) - half
        what = f"{int(above.sum())} are above B/2 = {half:.6g} m by up to {most:.3g} m, as rounded"
        book.assume("above B/2", "half-breadths", what, most)
    largest = float(np.nanmax(patient.y, initial=0.0))
    if largest < 0.9 * half:
        what = f"the largest half-breadth {largest:.6g} m is far below B/2 = {half:.6g} m"
        book.suspect("unit", "the table", what, largest - half)


def _per_waterline(patient: ExaminedTable, book: Notebook) -> None:
    known = np.isfinite(patient.y).any(axis=0)
    if known.sum() < 3 or patient.z[known][0] > 0.2 * patient.z[-1]:
        return
    largest = np.nanmax(patient.y[:, known], axis=0)
    if np.all(np.abs(largest - largest[0]) <= patient.rounding[known]) and largest[0] > 0:
        what = f"each waterline, the lowest too, has the same largest value {largest[0]:.6g} m"
        book.suspect("normalised per waterline", "the table", what, float(largest[0]))


_NO_SHIP = 4.0
"""Beyond the bounds of ships by this factor a unit is wrong, not the ship unusual."""


def _sizes(patient: ExaminedTable, book: Notebook) -> None:
    spread = float(patient.x[-1] - patient.x[0]) / patient.length
    ratios = [
        ("length to breadth", patient.length / patient.breadth, 2.0, 20.0),
        ("height of the table to breadth", float(patient.z[-1]) / patient.breadth, 0.03, 1.25),
        ("span of the stations to length", spread, 0.3, 1.3),
    ]
    if patient.draught:
        ratios.append(("breadth to draught", patient.breadth / patient.draught, 0.8, 20.0))
        ratios.append(("height to draught", float(patient.z[-1]) / patient.draught, 0.98, 10.0))
    for name, ratio, low, high in ratios:
        if not low / _NO_SHIP <= ratio <= high * _NO_SHIP:
            what = f"{name} is {ratio:.4g}, and no ship has it: give unit=, or correct the numbers"
            book.fault("unit", "the table", what, ratio)
        elif not low <= ratio <= high:
            what = f"{name} is {ratio:.4g}, outside {low:g} to {high:g}: is it the right unit?"
            book.suspect("unit", "the table", what, ratio)


def _narrowing(patient: ExaminedTable, book: Notebook) -> None:
    limit = patient.draught if patient.draught is not None else 0.5 * float(patient.z[-1])
    for i in patient.amidships():
        for j in range(1, len(patient.z)):
            drop = float(patient.y[i, j - 1] - patient.y[i, j])
            if patient.z[j] <= limit * (1 + 1e-9) and drop > 2.5 * patient.rounding[j]:
                what = f"{drop:.4g} m narrower than the waterline below, amidships"
                book.suspect("decreasing with height", patient.where(i, j), what, drop)


def _bottom(patient: ExaminedTable, book: Notebook) -> None:
    half = patient.breadth / 2.0
    for i in patient.amidships():
        row = patient.y[i]
        known = np.flatnonzero(row > 0)
        if not len(known) or (patient.keel is not None and known[0] > 0):
            continue
        j = int(known[0])
        low = patient.z[j] <= 0.6 * patient.z[-1]
        if patient.z[j] > 1e-9 and low and row[j] > 0.5 * half:
            what = f"the lowest offset is {patient.says(float(row[j]))} at {patient.z[j]:.4g} m"
            where = f"station {patient.stations[i]}"
            book.suspect("flat bottom missing", where, what, float(row[j]))


def _ends(patient: ExaminedTable, book: Notebook) -> None:
    top = np.nan_to_num(patient.y[:, -1])
    if not top.any():
        return
    third = patient.x <= patient.x[0] + (patient.x[-1] - patient.x[0]) / 4.0
    other = patient.x >= patient.x[-1] - (patient.x[-1] - patient.x[0]) / 4.0
    aft, forward = float(np.mean(top[third])), float(np.mean(top[other]))
    if forward > 1.05 * aft:
        what = (
            f"the highest waterline is fuller forward ({forward:.4g} m on average over the last "
            f"quarter) than aft ({aft:.4g} m): is station 0 at the other end?"
        )
        book.suspect("frame", "the table", what, forward - aft)
