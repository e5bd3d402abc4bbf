"""Which meeting is which while a plane moves along its normal, however far.

The curve itself keeps its shape; so the meetings with the moving plane slide along the
stretches on which its height over the plane rises or falls. Where the height turns, two
stretches meet: there a pair of meetings is born or dies. A meeting before and one after are
the same just if they lie on one stretch. Ordinals along the curve were measured to be wrong
at every birth and death, and steps of whatever length leap over a death and a birth at once.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.splines.bernstein import heights
from assoc_hull.geometry.splines.monotone import nodes_of
from assoc_hull.geometry.splines.plane_intersections import Meetings, meet_planes
from assoc_hull.geometry.splines.segments import segment_start
from assoc_hull.model.align_intersections import align_roots

__all__ = ["track", "track_each"]

_LEAST = 1e-3
"""The height turns only where it goes back by more than this (m): a pair of meetings whose
excursion is less is none, as no line is known more closely."""


def track(spline: SplineBatch, normal: FloatArray, start: float, stop: float) -> dict[int, int]:
    """Follow the meetings of a curve with a plane that is shifted along its normal.

    Parameters
    ----------
    spline : SplineBatch
        One curve.
    normal : (3,)
        Unit normal of the plane.
    start, stop : float, m
        Offsets of the plane.

    Returns
    -------
    dict of int to int
        For a meeting at the start, counted along the curve, the meeting at the stop that it
        becomes; one that has gone on the way is missing.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.edit.newline.branches_of_plane import track
    >>> from assoc_hull.geometry.curves import CurveData
    >>> from assoc_hull.geometry.splines.loft import loft
    >>> hill = np.array([[0.0, 0, 0], [1, 0, 2], [2, 0, 1], [3, 0, 3]])
    >>> curve = loft(CurveData.single(hill))
    >>> track(curve, np.array([0.0, 0, 1]), 1.5, 2.6)
    {2: 0}
    """
    return track_each(spline, normal, start, stop)[0]


def track_each(
    batch: SplineBatch, normal: FloatArray, start: float, stop: float
) -> list[dict[int, int]]:
    """Follow the meetings of many curves with a plane that is shifted: `track` for each.

    Parameters
    ----------
    batch : SplineBatch
        The curves.
    normal : (3,)
        Unit normal of the plane.
    start, stop : float, m
        Offsets of the plane.
    """
    before, after = (meet_planes(batch, normal, np.array([at])) for at in (start, stop))
    found: list[dict[int, int]] = []
    for curve, turns in enumerate(_turns(batch, normal)):
        mine = [np.flatnonzero(met.curve == curve) for met in (before, after)]
        here, there = (
            np.searchsorted(turns, before.t[mine[0]]),
            np.searchsorted(turns, after.t[mine[1]]),
        )
        path: dict[int, int] = {}
        for stretch in np.intersect1d(here, there).tolist():
            first, second = mine[0][here == stretch], mine[1][there == stretch]
            path |= _paired(before, first, after, second)
        found.append({one - int(mine[0][0]): two - int(mine[1][0]) for one, two in path.items()})
    return found


def _paired(before: Meetings, first: IntArray, after: Meetings, second: IntArray) -> dict[int, int]:
    """Pair the meetings on one stretch: one each, but where the height hardly goes back."""
    pairs = align_roots(
        before.sign[first], before.xyz[first], after.sign[second], after.xyz[second]
    )
    return {int(first[i]): int(second[j]) for i, j in pairs}


def _turns(batch: SplineBatch, normal: FloatArray) -> list[FloatArray]:
    """Give the parameters at which the height of each curve turns, ascending, m."""
    segments = segment_start(batch)
    fraction, height = nodes_of(heights(batch, normal), segments)
    begin, end = batch.knot[segments], batch.knot[segments + 1]
    at = (begin + (end - begin) * fraction).T
    found: list[FloatArray] = []
    for first, last in pairwise(np.searchsorted(segments, batch.start).tolist()):
        kept = _extremes(height.T[first:last].ravel().tolist())
        found.append(at[first:last].ravel()[np.array(kept[1:-1], np.int64)])
    return found


def _extremes(height: list[float]) -> list[int]:
    """Give the first place, those where the height turns for good, and the last."""
    kept, sense = [0], 0
    best = 0
    for i in range(1, len(height)):
        step = height[i] - height[best]
        if sense == 0:
            if abs(step) > _LEAST:
                sense, best = (1 if step > 0.0 else -1), i
        elif step * sense >= 0.0:
            best = i
        elif abs(step) > _LEAST:
            kept.append(best)
            sense, best = -sense, i
    return [*kept, len(height) - 1]
