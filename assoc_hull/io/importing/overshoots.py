"""Lines of a table that swing: a smooth curve leaves the box of two offsets between which it rises.

Where offsets only rise, or only fall, a fair line lies between neighbours of them. One that does
not most often has a knuckle there, beside which a smooth curve swings.
"""

from __future__ import annotations

from collections.abc import Iterator

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.polylines.operations import runs_where
from assoc_hull.geometry.splines.evaluation import sample
from assoc_hull.io.importing.verdict import Findings
from assoc_hull.io.offsets.knuckles import points_of_station
from assoc_hull.io.offsets.table import OffsetTable
from assoc_hull.model.address import AddressBook
from assoc_hull.model.tables import HullState

__all__ = ["examine_overshoots", "greatest_overshoot"]

_FINE = 32
"""Places on each segment of a curve that are looked at."""

_TIMES = 2.0
"""A swing is told beyond so many times what the file and adoption leave open."""

_ROW = 3
"""So many neighbouring stations must swing: single ones do at the ends of good coarse tables."""


def greatest_overshoot(
    given: FloatArray, places: FloatArray, noise: float
) -> tuple[float, int] | None:
    """Find by how much (m) a curve leaves the box of two given points, and after which of them.

    `given` (n, 2), m, and `places` (k, 2) along the curve; neighbours of which a third turns back
    by more than `noise` (m) tell no box, as at a greatest breadth.
    """
    away = np.abs(given[:, None] - places[None]).sum(axis=2)
    at = away.argmin(axis=1)
    if (np.diff(at) <= 0).any():
        return None
    found: list[tuple[float, int]] = []
    for k in range(len(given) - 1):
        step = np.diff(given[max(k - 1, 0) : k + 3], axis=0)
        monotone = ~((step > noise).any(axis=0) & (step < -noise).any(axis=0))
        box, part = given[k : k + 2], places[at[k] + 1 : at[k + 1]]
        if not len(part):
            continue
        # Between them: the place nearest to a given point may lie beyond it.
        over = np.maximum(part - box.max(axis=0), box.min(axis=0) - part).max(axis=0)
        found.append((float(over[monotone].max(initial=0.0)), k))
    return max(found, default=None)


def examine_overshoots(state: HullState, table: OffsetTable, found: Findings) -> None:
    """Suspect sections that swing between given points, side by side between the same heights."""
    noise = 2.0 * float(table.rounding.max())
    least = _TIMES * max(noise, state.tolerances.adoption)
    alike: dict[tuple[float, float], list[_Swing]] = {}
    for each in _swings(state, table, noise):
        if each.over > least:
            alike.setdefault(each.heights, []).append(each)
    for (below, above), swings in alike.items():
        stations = np.zeros(len(table.x), np.bool_)
        stations[[each.row for each in swings]] = True
        if int(np.diff(runs_where(stations), axis=1).max()) < _ROW:
            continue
        worst = max(swings, key=lambda each: each.over)
        others = f" and {len(swings) - 1} more" if len(swings) > 1 else ""
        what = (
            f"swings {1e3 * worst.over:.3g} mm out between the given heights {below:.6g} and "
            f"{above:.6g} m, where its offsets only rise or fall: a knuckle may stand at one of "
            "these; it is found where a waterline lies on it and two more on either side of it, "
            "straight to the last digit: else give more waterlines there, or the lines with a "
            "knuckle line"
        )
        found.suspect("overshoot", f"{worst.name}{others}", what, worst.over)


@attrs.frozen
class _Swing:
    """The greatest swing of a section, m, its name, station, and between which heights it is."""

    over: float
    name: str
    row: int
    heights: tuple[float, float]


def _swings(state: HullState, table: OffsetTable, noise: float) -> Iterator[_Swing]:
    """Give the greatest swing of each section."""
    book = AddressBook(state)
    for curve in state.live("curves").tolist():
        if state.family(state.line_of(curve)).name != "sections":
            continue
        spline = state.spline(curve)
        row = int(np.abs(table.x - spline.xyz[0, 0]).argmin())
        given = _given(table, row, spline.xyz)
        if len(given) < _ROW:
            continue
        over = greatest_overshoot(given, sample(spline, _FINE)[1][:, 1:], noise)
        if over is not None:
            below, above = given[over[1] : over[1] + 2, 1].tolist()
            yield _Swing(over[0], book.curve_name(curve), row, (below, above))


def _given(table: OffsetTable, row: int, points: FloatArray) -> FloatArray:
    """Give the offsets (n, 2), m, of a station that lie on a curve, with the place it begins at."""
    at = points_of_station(table, row)
    y = np.column_stack([table.half_breadth[row, at], table.z[at]])
    inside: NDArray[np.bool_] = (y[:, 1] >= points[0, 2] - 1e-9) & (y[:, 1] <= points[-1, 2] + 1e-9)
    first = points[:1, 1:]
    rest = y[inside & (np.abs(y - first).sum(axis=1) > 1e-6)]
    return np.concatenate([first, rest])
