"""Followers that come to end on other boundary curves than before, as often as before.

Each end that is lost is handed over to a meeting that is won, so the line need not be cut anew:
what the mapping leaves still along it keeps its bits.
"""

from __future__ import annotations

from itertools import permutations

import numpy as np

from assoc_hull.edit.recut.carried_points import Carried
from assoc_hull.edit.recut.changed_ends import doubles, pairs_of, runs_along
from assoc_hull.edit.recut.driver_image import Roots
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.model.kinds import BoundaryKind
from assoc_hull.model.state import Meets

__all__ = ["hand_over"]

_FAR = 0.1
"""No end is handed over farther than this part of the piece's length."""

_MOST = 3
"""More ends than this are not told apart."""


def hand_over(work: Carried, curves: IntArray, some: IntArray, line: int, roots: Roots) -> bool:
    """Say which meeting takes the place of which end; tell whether that can be said.

    Parameters
    ----------
    work : Carried
        The transformation; `work.ends` takes the meetings.
    curves : (m,) int
        The drivers.
    some : (k,) int
        Those that are cut with the plane of the line, by place among them.
    line : int
        The follower.
    roots : Roots
        Where their images meet its plane.
    """
    lost, won = list[int](), list[int]()
    for local in some.tolist():
        curve = int(curves[local])
        if work.state.lines.boundary.data[work.state.line_of(curve)] != BoundaryKind.END:
            continue
        meets: Meets = work.state.curves.meets.data[curve]
        if doubles(work.state, curve, line) or any(touched == curve for touched, _ in work.touches):
            return False
        old, new, pairs = pairs_of(work, curve, line, local, roots)
        gained = np.delete(new, [other for _, other in pairs])
        if runs_along(work, curve, line, roots.t[gained]).any():
            return False
        lost += meets.row[np.delete(old, [one for one, _ in pairs])].tolist()
        won += gained.tolist()
    lost = [row for row in lost if row >= 0]
    ends = [_end_of(work, line, row) for row in lost]
    if not lost or len(lost) != len(won) or len(lost) > _MOST or None in ends:
        return False
    order = _nearest(work.image[lost], roots.xyz[won])
    for end, row, root in zip(ends, lost, order, strict=True):
        assert end is not None
        step = roots.xyz[won[root]] - work.image[row]
        length = float(work.state.spline(end[0]).knot[-1])
        if float(np.sqrt((step * step).sum())) > _FAR * length:
            return False
    for end, root in zip(ends, order, strict=True):
        assert end is not None
        work.ends[int(curves[roots.curve[won[root]]]), won[root]] = end
    return True


def _end_of(work: Carried, line: int, row: int) -> tuple[int, int] | None:
    """Give the piece of a line that begins (0) or ends (1) at a crossing; None if none does."""
    for curve in work.state.lines.curves.data[line]:
        rows: IntArray = work.state.curves.rows.data[curve]
        for side in (0, 1):
            if int(rows[-side]) == row:
                return int(curve), side
    return None


def _nearest(before: FloatArray, after: FloatArray) -> tuple[int, ...]:
    """Pair places with the least total distance: the place after of each one before."""
    away = np.sqrt(((before[:, None] - after[None]) ** 2).sum(axis=2))
    every = np.arange(len(before))
    return min(permutations(every.tolist()), key=lambda order: float(away[every, order].sum()))
