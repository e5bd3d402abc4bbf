"""How a line through given points passes each of them: straight runs stay straight.

Examples
--------
>>> from assoc_hull.creation.classical.runs import kinds_along
>>> kinds, _ = kinds_along([[0, 0, 5], [10, 0, 1], [20, 0, 0], [30, 0, 0], [40, 0, 0]], corner=30.0)
>>> kinds.tolist()  # tangent where the level keel begins
[0, 0, 1, 0, 0]
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.geometry.curves import FloatArray, IntArray, PointKind

__all__ = ["kinds_along"]

_STRAIGHT = 1e-7
"""Neighbouring chords that differ by this angle, rad, are one straight run."""


def kinds_along(points: ArrayLike, corner: float) -> tuple[IntArray, FloatArray]:
    """Give a `PointKind` per point, and the directions at those that are tangent.

    Three points in a row on a straight line are a straight run. Where a run goes over into a curve,
    the curve is tangent to it; where two runs meet, or chords turn sharply, there is a knuckle.

    Parameters
    ----------
    points : (n, 3), m
        No two neighbours the same.
    corner : float, degrees
        A sharper turn from chord to chord is a knuckle.

    Returns
    -------
    (n,) int, (n, 3)
        Kinds; directions, nil where none is given.
    """
    at = np.asarray(points, np.float64)
    step = np.diff(at, axis=0)
    way = step / np.linalg.norm(step, axis=1)[:, None]
    kind = np.full(len(at), int(PointKind.SMOOTH), np.int64)
    direction = np.zeros_like(at)
    if len(at) < 3:
        return kind, direction
    turn = np.arctan2(
        np.linalg.norm(np.cross(way[:-1], way[1:]), axis=1), (way[:-1] * way[1:]).sum(axis=1)
    )
    level = turn <= _STRAIGHT
    straight = np.zeros(len(way), bool)
    straight[:-1] |= level
    straight[1:] |= level
    inner = np.arange(1, len(at) - 1)
    before, after = straight[:-1], straight[1:]
    sharp = (turn > np.radians(corner)) | (before & after & ~level)
    tangent = (before ^ after) & ~sharp
    kind[inner[sharp]] = int(PointKind.KNUCKLE)
    kind[inner[tangent]] = int(PointKind.TANGENT)
    along = np.where(before[:, None], way[:-1], way[1:])
    direction[inner[tangent]] = along[tangent]
    return kind, direction
