"""A fair border for the flat of side.

A table tells only between which two stations a waterline comes onto the flat. Within these
bounds the border is laid as a fair curve: least squares of its second differences and, with
a small weight, of its distance from the estimates; never narrower upward.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.io.offsets.table import OffsetTable

__all__ = ["fair_border"]

_ESTIMATE = 0.2
"""Weight of the estimates against fairness."""

_WIDENS = 0.15
"""The flat widens upward by at least this (m) from one waterline to the next, so that every
plane passes its border cleanly."""

_PINNED = 1e-6
"""Freedom (m) of the border where the flat reaches the last station of the table."""

_CLEAR = 0.05
"""Part of the interval between two stations that the border keeps clear of either."""


def fair_border(table: OffsetTable, border: FloatArray) -> FloatArray:
    """Fair the border of the flat of side.

    Parameters
    ----------
    table : OffsetTable
        The offsets.
    border : (n, 3), m
        From the highest waterline aft, down, forward along the lower side, up again; see
        `assoc_hull.io.offsets.flats.flat_of_side`.

    Returns
    -------
    (n, 3), m
        Its points on waterlines moved along these, those between on stations kept.

    Examples
    --------
    >>> from assoc_hull.io.offsets.border import fair_border
    >>> from assoc_hull.io.offsets.flats import flat_of_side
    >>> from assoc_hull.shipped.series60_table import todd_table
    >>> table = todd_table(0.60)[0]
    >>> rough = flat_of_side(table).border
    >>> fair_border(table, rough).shape == rough.shape
    True
    """
    out = np.array(border)
    flat = [j for j, z in enumerate(table.z) if (np.abs(border[:, 2] - z) < 1e-9).any()]
    count = len(flat)
    for ends, sign in ((slice(count - 1, None, -1), -1.0), (slice(len(out) - count, None), 1.0)):
        part = out[:count][::-1] if sign < 0.0 else out[ends]
        low, high = _bounds(table, flat, sign)
        part[:, 0] = _fair(part[:, 0], low, high, sign)
    return out


def _bounds(table: OffsetTable, flat: list[int], sign: float) -> tuple[FloatArray, FloatArray]:
    """Give the interval in which each waterline comes onto the flat, aft (-1) or forward."""
    low, high = np.zeros(len(flat)), np.zeros(len(flat))
    half = table.breadth / 2.0
    for i, j in enumerate(flat):
        on = np.flatnonzero(table.half_breadth[:, j] >= half - table.rounding[j] * (1 + 1e-6))
        inside = int(on[0] if sign < 0.0 else on[-1])
        outside = int(np.clip(inside + sign, 0, len(table.x) - 1))
        first, last = sorted((float(table.x[inside]), float(table.x[outside])))
        clear = _CLEAR * (last - first)
        low[i], high[i] = first + clear, max(last - clear, first + _PINNED)
    return low, high


def _fair(x: FloatArray, low: FloatArray, high: FloatArray, sign: float) -> FloatArray:
    """Lay places from the lowest waterline up, within their bounds, as a fair curve."""
    from scipy.optimize import lsq_linear

    count = len(x)
    bend = np.diff(np.eye(count), 2, axis=0) if count > 2 else np.zeros((0, count))
    rows = np.concatenate([bend, _ESTIMATE * np.eye(count)])
    goal = np.concatenate([np.zeros(len(bend)), _ESTIMATE * np.clip(x, low, high)])
    found = np.clip(lsq_linear(rows, goal, (low, high)).x, low, high)
    for i in range(1, count):
        found[i] = sign * max(sign * found[i], sign * found[i - 1] + _WIDENS)
    return found
