"""Mending a watched gap: the curve of higher rank gets a point where the other passes."""

from __future__ import annotations

import numpy as np

from assoc_hull.edit.ride import ride_links
from assoc_hull.geometry.closest import closest
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.model.family import Sort
from assoc_hull.model.make import Maker, PointSpec
from assoc_hull.model.state import HullState

__all__ = ["insert_position", "mend"]

_NEAR = 0.15
"""An adopted point as near as this (m) is moved instead of setting another beside it."""


def insert_position(state: HullState, curve: int, place: FloatArray) -> int:
    """Give the index at which a new point at a place belongs among those of a curve."""
    spline = state.spline(curve)
    at = float(closest(spline, 0, place[None])[0][0])
    return int(np.clip(np.searchsorted(spline.knot, at), 1, len(spline.knot) - 1))


def mend(maker: Maker, rows: IntArray) -> tuple[IntArray, IntArray]:
    """Close gaps over their limit, the widest first on each stretch.

    Parameters
    ----------
    maker : Maker
        Writes the points.
    rows : (k,) int
        Watched crossings, in the order in which they are mended.

    Returns
    -------
    curves, points : (c,) int, (p,) int
        Curves whose recipe changed, and points that were moved.
    """
    state, curves, moved = maker.state, set[int](), set[int]()
    for row in rows.tolist():
        curve = int(state.rows.curve.data[row, 1])
        place = state.rows.spot.data[row, 0].copy()
        defining: IntArray = state.curves.rows.data[curve]
        away = np.sqrt(((state.rows.xyz.data[defining] - place) ** 2).sum(axis=1))
        nearest = int(away.argmin())
        if away[nearest] < _NEAR:
            if state.rows.sort.data[defining[nearest]] == Sort.ADOPTED:
                maker.journal.put(state.rows.xyz, [defining[nearest]], [place])
                curves.add(curve)
                moved.add(int(defining[nearest]))
            continue
        point = maker.points([PointSpec(curve, place, Sort.ADOPTED)])[0]
        position = _position(state, curve, defining, place)
        maker.define(curve, np.insert(defining, position, point))
        curves.add(curve)
    touched = np.array(sorted(curves), np.int64)
    ride_links(state, touched, maker.journal)
    return touched, np.array(sorted(moved), np.int64)


def _position(state: HullState, curve: int, defining: IntArray, place: FloatArray) -> int:
    """Place a point between the two neighbours whose detour through it is least."""
    xyz = state.rows.xyz.data[defining]
    to = np.sqrt(((xyz - place) ** 2).sum(axis=1))
    step = np.sqrt((np.diff(xyz, axis=0) ** 2).sum(axis=1))
    return int((to[:-1] + to[1:] - step).argmin()) + 1
