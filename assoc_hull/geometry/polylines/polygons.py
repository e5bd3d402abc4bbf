"""Polylines that are polygons: straight sides, and corners that no smooth curve is meant by.

A plane cuts a mesh with flat sides, a barge or a deck, in a few long straight sides. Where so few
points lie on a line, its corners would be taken for the facets of a curve.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.polylines.operations import cumulative_lengths, resample

__all__ = ["PolygonRule", "filled_polygon", "polygon_corners"]

_MOST, _FEW = 6, 3
"""A polygon has so many corners at most; so many, where they may turn little."""


@attrs.frozen
class PolygonRule:
    """What counts as a polygon.

    Attributes
    ----------
    off : float, m
        Points this near to the line between two corners lie on it.
    least : float, m
        Length of a side, at least.
    turn_deg : float
        What a corner turns by, at least.
    long, slight_deg : float, m and degrees
        The same of few long sides, which may turn less: the rakes of a barge.
    close, reach, spaced : float, m
        Points that fill a side stand so close up to so far from its corners, else so far apart.
    """

    off: float = 1e-4
    least: float = 0.3
    turn_deg: float = 10.0
    long: float = 3.0
    slight_deg: float = 4.0
    close: float = 0.1
    reach: float = 1.5
    spaced: float = 2.0


def polygon_corners(points: FloatArray, rule: PolygonRule) -> IntArray | None:
    """Give the corners (k,) of a polyline (n, d), m, that is a polygon, its ends not among them.

    None where it is none: a curve, or without a corner.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.polylines.polygons import PolygonRule, polygon_corners
    >>> bent = np.array([[0.0, 0.0], [3.0, 0.0], [6.0, 0.0], [6.0, 4.0]])
    >>> polygon_corners(bent, PolygonRule()).tolist()
    [2]
    """
    kept = np.array(_chorded(points, rule.off), np.int64)
    if not 3 <= len(kept) <= _MOST + 2:
        return None
    side = np.diff(points[kept], axis=0)
    length = np.sqrt((side * side).sum(axis=1))
    if length.min() < rule.least:
        return None
    unit = side / length[:, None]
    turn = np.arccos(np.clip((unit[1:] * unit[:-1]).sum(axis=1), -1.0, 1.0))
    few = length.min() >= rule.long and len(turn) <= _FEW
    least = np.deg2rad(rule.slight_deg if few else rule.turn_deg)
    return kept[1:-1] if turn.min() >= least else None


def _chorded(points: FloatArray, within: float) -> list[int]:
    """Give the points between which the chords pass all others within a distance, m."""
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
        if away[far] > within:
            open_ends.append(low + far)
        else:
            kept.append(open_ends.pop())
    return kept


def filled_polygon(
    points: FloatArray, corners: IntArray, values: FloatArray, rule: PolygonRule
) -> tuple[FloatArray, FloatArray]:
    """Put points on the sides of a polygon, closer near its corners; with values (n,) at each."""
    at = cumulative_lengths(points)
    edges = at[[0, *corners.tolist(), len(points) - 1]]
    near = rule.close * np.arange(1.0, np.rint(rule.reach / rule.close) + 1.0)
    found = [at, np.arange(rule.spaced, at[-1], rule.spaced)]
    found += [edge + sign * near for edge in edges.tolist() for sign in (-1.0, 1.0)]
    wanted = np.sort(np.concatenate(found))
    wanted = wanted[(wanted >= 0.0) & (wanted <= at[-1])]
    # Given points stay to the bit; what would crowd them is left out.
    gap = np.abs(wanted[:, None] - at).min(axis=1)
    extra = wanted[gap > 0.5 * rule.close]
    extra = extra[np.diff(extra, prepend=-np.inf) > 0.5 * rule.close]
    places = np.concatenate([at, extra])
    order = np.argsort(places, kind="stable")
    every = np.concatenate([points, resample(points, extra)])
    return every[order], np.concatenate([values, np.interp(extra, at, values)])[order]
