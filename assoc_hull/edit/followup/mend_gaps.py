"""Mending a watched gap: one curve gets a point where the other passes.

The curve of higher rank gives way, unless a crossing or a border holds it just there. One that
comes from definitions never does.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.edit.followup.adopted_points import ride_links
from assoc_hull.edit.followup.thread import thread
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.model.generated import attached
from assoc_hull.model.kinds import Sort
from assoc_hull.model.make_objects import Maker, PointSpec

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
        The curve that is to give way at each; the one of higher rank, else the other, if None.

    Returns
    -------
    curves, points : (c,) int, (p,) int
        Curves whose recipe changed, and points that were moved.
    """
    state, curves, moved = maker.state, set[int](), set[int]()
    giving = state.rows.curve.data[rows, 1] if on is None else on
    for row, curve in zip(rows.tolist(), giving.tolist(), strict=True):
        pair: list[int] = state.rows.curve.data[row].tolist()
        # Where a fixed point beside the crossing holds one curve, the other gives way.
        other = pair[1 - pair.index(curve)]
        for yielding in (curve,) if on is not None else (curve, other):
            place = state.rows.spot.data[row, 1 - pair.index(yielding)].copy()
            point = _hold(maker, yielding, place)
            if point is not None:
                curves.add(yielding)
                moved |= {point} - {-1}
                break
    touched = np.array(sorted(curves), np.int64)
    ride_links(state, touched, maker.journal)
    return touched, np.array(sorted(moved), np.int64)


def _hold(maker: Maker, curve: int, place: FloatArray) -> int | None:
    """Lead a curve through a place: give the point moved there, -1 for a new one, None if held."""
    state = maker.state
    if curve in attached(state):
        return None
    defining: IntArray = state.curves.rows.data[curve]
    away = np.sqrt(((state.rows.xyz.data[defining] - place) ** 2).sum(axis=1))
    nearest = int(away.argmin())
    if away[nearest] >= _NEAR:
        point = maker.points([PointSpec(curve, place, Sort.ADOPTED)])[0]
        thread(maker, curve, int(point))
        return -1
    if state.rows.sort.data[defining[nearest]] != Sort.ADOPTED:
        return None
    maker.journal.put(state.rows.xyz, [defining[nearest]], [place])
    return int(defining[nearest])
