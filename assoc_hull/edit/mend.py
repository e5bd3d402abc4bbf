"""Mending a watched gap: the curve of higher rank gets a point where the other passes."""

from __future__ import annotations

import numpy as np

from assoc_hull.edit.ride import ride_links
from assoc_hull.edit.thread import thread
from assoc_hull.geometry.curves import IntArray
from assoc_hull.model.family import Sort
from assoc_hull.model.make import Maker, PointSpec

__all__ = ["mend"]

_NEAR = 0.15
"""An adopted point as near as this (m) is moved instead of setting another beside it."""


def mend(maker: Maker, rows: IntArray, on: IntArray | None = None) -> tuple[IntArray, IntArray]:
    """Close gaps over their limit, the widest first on each stretch.

    Parameters
    ----------
    maker : Maker
        Writes the points.
    rows : (k,) int
        Watched crossings, in the order in which they are mended.
    on : (k,) int or None
        The curve that is to give way at each; the one of higher rank if None.

    Returns
    -------
    curves, points : (c,) int, (p,) int
        Curves whose recipe changed, and points that were moved.
    """
    state, curves, moved = maker.state, set[int](), set[int]()
    giving = state.rows.curve.data[rows, 1] if on is None else on
    for row, curve in zip(rows.tolist(), giving.tolist(), strict=True):
        other = int(state.rows.curve.data[row, 0] == curve)
        place = state.rows.spot.data[row, other].copy()
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
        thread(maker, curve, int(point))
        curves.add(curve)
    touched = np.array(sorted(curves), np.int64)
    ride_links(state, touched, maker.journal)
    return touched, np.array(sorted(moved), np.int64)
