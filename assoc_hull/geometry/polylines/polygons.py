"""Polylines that are polygons: straight sides, and corners that no smooth curve is meant by.

A plane cuts a mesh with flat sides, a barge or a deck, in a few long straight sides. Where so few
points lie on a line, its corners would be taken for the facets of a curve.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.polylines.operations import cumulative_lengths, resample

__all__ = ["filled_polygon", "polygon_corners"]

_OFF = 1e-4
"""Points this near (m) to the line between two corners lie on it."""

_LEAST, _TURN, _MOST = 0.3, np.deg2rad(10.0), 6
"""Sides are this long (m) at least, corners turn by this much, and there are so many at most."""

_LONG, _SLIGHT, _FEW = 3.0, np.deg2rad(4.0), 3
"""The same of few long sides, which may turn less: the rakes of a barge."""

_CLOSE, _REACH, _SPACED = 0.1, 1.5, 2.0
"""Points that fill a side stand so close (m) up to so far from its corners, else so far apart."""


def polygon_corners(points: FloatArray) -> IntArray | None:
    """Give the corners (k,) of a polyline (n, d), m, that is a polygon, its ends not among them.

    None where it is none: a curve, or without a corner.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.polylines.polygons import polygon_corners
    >>> polygon_corners(np.array([[0.0, 0.0], [3.0, 0.0], [6.0, 0.0], [6.0, 4.0]])).tolist()
    [2]
    """
    kept = np.array(_chorded(points), np.int64)
    if not 3 <= len(kept) <= _MOST + 2:
        return None
    side = np.diff(points[kept], axis=0)
    length = np.sqrt((side * side).sum(axis=1))
    if length.min() < _LEAST:
        return None
    unit = side / length[:, None]
    turn = np.arccos(np.clip((unit[1:] * unit[:-1]).sum(axis=1), -1.0, 1.0))
    few = length.min() >= _LONG and len(turn) <= _FEW
    return kept[1:-1] if turn.min() >= (_SLIGHT if few else _TURN) else None


def _chorded(points: FloatArray) -> list[int]:
    """Give the points between which the chords pass all others within `_OFF`."""
    kept, open_ends = [0], [len(points) - 1]
    while open_ends:
        if len(kept) > _MOST + 2:
            return kept
        low, high = kept[-1], open_ends[-1]
        along = points[high] - points[low]
        size = max(float(along @ along), 1e-300)
        off = points[low : high + 1] - points[low]
        part = np.clip(off @ along / size, 0.0, 1.0)
        away = off - part[:, None] * along
        away = np.sqrt((away * away).sum(axis=1))
        far = int(away.argmax())
        if away[far] > _OFF:
            open_ends.append(low + far)
        else:
            kept.append(open_ends.pop())
    return kept


def filled_polygon(points: FloatArray, values: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Put points on the sides of a polygon, closer near its corners; with values (n,) at each."""
    corners = polygon_corners(points)
    inner = np.zeros(0, np.int64) if corners is None else corners
    at = cumulative_lengths(points)
    edges = at[[0, *inner.tolist(), len(points) - 1]]
    near = np.arange(_CLOSE, _REACH + _CLOSE, _CLOSE)
    found = [at, np.arange(_SPACED, at[-1], _SPACED)]
    found += [edge + sign * near for edge in edges.tolist() for sign in (-1.0, 1.0)]
    wanted = np.sort(np.concatenate(found))
    wanted = wanted[(wanted >= 0.0) & (wanted <= at[-1])]
    # Given points stay to the bit; what would crowd them is left out.
    gap = np.abs(wanted[:, None] - at).min(axis=1)
    extra = wanted[gap > 0.5 * _CLOSE]
    extra = extra[np.diff(extra, prepend=-1.0) > 0.5 * _CLOSE]
    places = np.concatenate([at, extra])
    order = np.argsort(places, kind="stable")
    every = np.concatenate([points, resample(points, extra)])
    return every[order], np.concatenate([values, np.interp(extra, at, values)])[order]
