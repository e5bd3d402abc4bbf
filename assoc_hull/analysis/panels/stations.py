"""Where along the ship panels begin and end."""

from __future__ import annotations

import math

import numpy as np

from assoc_hull.analysis.panels.bands import Band, Waterplane
from assoc_hull.geometry.curves import FloatArray

__all__ = ["Extent", "columns_and_rows", "extent", "spaced"]

_SAMPLES = 8
"""Curves per strip on which the waterline is looked at."""

_ASPECT = 2.0
"""A panel is by so much longer than high where number and shape are left to us."""

Extent = tuple[FloatArray, FloatArray, float]
"""x (k,) and half breadth (k,) along the waterline, and the greatest girth of a half; m."""


def extent(every: list[Band], plane: Waterplane) -> Extent:
    """Find how far the wet part reaches, the waterline upright, and the greatest girth."""
    level = Waterplane(plane.height, plane.tan_trim)
    x, y, girth = [], [], 0.0
    for band in every:
        q = np.linspace(0.0, float(band.count), _SAMPLES * band.count + 1)
        wet = band.wet(q, level)
        if not len(wet.curve):
            continue
        girth = max(girth, float(wet.chains.length.max()))
        afloat = ~wet.top
        x.append(wet.chains.ends[1][afloat, 0])
        y.append(np.abs(wet.chains.ends[1][afloat, 1]))
        # A bulb reaches beyond the waterline: there its breadth is nil.
        reach = np.array([wet.chains.cubic[:, 0, 0].min(), wet.chains.cubic[:, 0, 0].max()])
        ends = wet.chains.cubic.sum(axis=1)[:, 0]
        reach = np.array([min(reach[0], ends.min()), max(reach[1], ends.max())])
        x.append(reach)
        y.append(np.full(2, np.nan))
    if not x:
        return np.zeros(0), np.zeros(0), 0.0
    return *_waterline(np.concatenate(x), np.concatenate(y)), girth


def _waterline(x: FloatArray, y: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Put places of waterlines in order; ends of the wet part get the breadth there, or none."""
    known = np.isfinite(y)
    if not known.any():
        ends = np.array([x.min(), x.max()])
        return ends, np.zeros(2)
    order = np.argsort(x[known], kind="stable")
    line, breadth = x[known][order], y[known][order]
    low, high = float(x.min()), float(x.max())
    if low < line[0]:
        line, breadth = np.append(low, line), np.append(breadth[0], breadth)
    if high > line[-1]:
        line, breadth = np.append(line, high), np.append(breadth, breadth[-1])
    return line, breadth


def spaced(found: Extent, columns: int, spacing: str) -> FloatArray:
    """Give places along the ship that part it into columns, (columns + 1,), m.

    Parameters
    ----------
    found : Extent
        The waterline.
    columns : int
        How many.
    spacing : "arc" or "cosine"
        Equal lengths along the waterline, or close together at both ends.
    """
    x, y, _ = found
    if spacing == "cosine":
        half = 0.5 * (x[-1] - x[0])
        places: FloatArray = x[0] + half * (1.0 - np.cos(np.linspace(0.0, np.pi, columns + 1)))
        return places
    s = np.append(0.0, np.cumsum(np.hypot(np.diff(x), np.diff(y))))
    return np.asarray(np.interp(np.linspace(0.0, s[-1], columns + 1), s, x))


def columns_and_rows(found: Extent, count: int) -> tuple[int, int]:
    """Choose how many columns and rows give so many panels of a pleasing shape on one half."""
    x, y, girth = found
    length = float(np.hypot(np.diff(x), np.diff(y)).sum())
    ideal = math.sqrt(count * _ASPECT * girth / length)
    rows = np.arange(max(2, math.floor(0.8 * ideal)), max(3, math.ceil(1.25 * ideal)) + 1)
    columns = np.maximum(np.round(count / rows), 2.0)
    # As many panels as were asked for comes before the shape.
    off = np.abs(columns * rows - count) / count + 0.002 * np.abs(np.log(rows / ideal))
    best = int(off.argmin())
    return int(columns[best]), int(rows[best])
