"""Knuckles of a table: offsets at which neighbouring stations turn sharply between straight runs.

A smooth curve through straight bottom and side swings at the knuckle between them. Where two
straight runs of a section, each of three offsets within their rounding, meet in one given point,
no round bilge can stand there: its offset would lie inside of the corner.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.io.offsets.knuckles import corners_of_section
>>> y, z = np.array([0.0, 2.0, 4.0, 4.5, 5.0]), np.array([0.0, 0.2, 0.4, 0.8, 1.2])
>>> corners_of_section(y, z, 0.0005)[0].tolist()
[False, False, True, False, False]
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.polylines.operations import runs_where
from assoc_hull.io.offsets.table import OffsetTable
from assoc_hull.io.reports import Note

__all__ = ["corners_of_section", "knuckle_notes", "knuckles_of_table", "points_of_station"]

_STRONG, _LEAST = 20.0, 4.0
"""A corner stands off the chord beside it by more times half a printed unit: a sure one by the
first, one in a row with sure ones by the second."""

_TURN = 10.0
"""A sure corner turns by so many degrees or more."""

_ROW = 3
"""So many neighbouring stations must agree."""

_BOTTOM = 4
"""So many offsets from the edge of a flat bottom on must be straight: few might be of a bilge."""


def corners_of_section(
    y: FloatArray, z: FloatArray, rounding: float, *, bottom: bool = False
) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Find the offsets (n,), m, at which a station turns between straight runs; and the sure ones.

    `rounding` (m) is half a printed unit; `bottom`: the first offset is the edge of a flat bottom.
    """
    found, sure = np.zeros(len(y), np.bool_), np.zeros(len(y), np.bool_)
    if len(y) < _BOTTOM:
        return found, sure
    # A middle of three is off their chord by no more than its own rounding and that of the ends.
    bend = _off_chord(y, z)
    straight = np.abs(bend) <= 2.0 * rounding * (1.0 + 1e-6)
    angle = np.degrees(np.arctan2(np.diff(y), np.diff(z)))
    turn = np.abs(np.diff(angle))
    inner = np.arange(2, len(y) - 2)
    between = straight[inner - 1] & straight[inner + 1] & ~straight[inner]
    found[inner] = between & (np.abs(bend[inner]) > _LEAST * rounding)
    sharp = (np.abs(bend[inner]) > _STRONG * rounding) & (turn[inner - 1] >= _TURN)
    sure[inner] = found[inner] & sharp
    if bottom and y[0] > 0.0 and straight[1 : _BOTTOM - 1].all():
        found[0] = sure[0] = 90.0 - angle[0] >= _TURN
    return found, sure


def _off_chord(y: FloatArray, z: FloatArray) -> FloatArray:
    """Give how far each offset (n,), m, is off the chord through its neighbours; 0 at both ends."""
    found = np.zeros(len(y))
    part = (z[1:-1] - z[:-2]) / (z[2:] - z[:-2])
    found[1:-1] = y[1:-1] - (y[:-2] + part * (y[2:] - y[:-2]))
    return found


def points_of_station(table: OffsetTable, i: int) -> NDArray[np.int64]:
    """Give the waterlines of the lowest run of half-breadths of a station, with a zero below it."""
    row = table.half_breadth[i]
    wide = np.nan_to_num(row) > 0.0
    runs = runs_where(wide)
    if not len(runs):
        return np.empty(0, np.int64)
    first, stop = runs[0].tolist()
    return np.arange(first - (first > 0 and row[first - 1] == 0.0), stop)


def knuckles_of_table(table: OffsetTable) -> NDArray[np.bool_]:
    """Tell which offsets, (s, w), are knuckles: several stations side by side turn there."""
    found = np.zeros(table.half_breadth.shape, np.bool_)
    sure = found.copy()
    for i in range(len(table.x)):
        at = points_of_station(table, i)
        if not len(at):
            continue
        # The keel ends a flat bottom only where it lies in it.
        keel = 0.0 if table.keel is None else float(table.keel[i])
        bottom = bool(at[0] == 0 and abs(table.z[0] - keel) <= 1e-9)
        y, z = table.half_breadth[i, at], table.z[at]
        rounding = float(table.rounding[at].max())
        found[i, at], sure[i, at] = corners_of_section(y, z, rounding, bottom=bottom)
    for j in range(len(table.z)):
        for first, stop in runs_where(found[:, j]).tolist():
            rows = runs_where(sure[first:stop, j])
            if not len(rows) or int(np.diff(rows, axis=1).max()) < _ROW:
                found[first:stop, j] = False
    return found


def knuckle_notes(table: OffsetTable) -> Iterator[Note]:
    """Tell each knuckle that was found, with its evidence."""
    knuckles = knuckles_of_table(table)
    for j in np.flatnonzero(knuckles.any(axis=0)).tolist():
        x = table.x[knuckles[:, j]]
        what = (
            f"a knuckle at z = {table.z[j]:.6g} m, at {len(x)} stations from x = {x[0]:.6g} to "
            f"{x[-1]:.6g} m: below and above it their offsets lie on straight lines, within their "
            "printed digits"
        )
        yield Note("knuckle", "the table", what, float(table.z[j]))
