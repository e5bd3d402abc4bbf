"""Watched crossings whose curves, thinned, pass each other too far off.

Two densely drawn lines that meet may each keep within its tolerance, one on this side and one
on the other; the gap between them is then twice as large. Where it exceeds a part of the
adoption tolerance, the curve that passes its own line farther there needs another point.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from assoc_hull.edit.adoption.match_crossings import Meeting
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.splines.closest import closest_each
from assoc_hull.geometry.splines.evaluation import derivative
from assoc_hull.model.gaps import crossing_normals

__all__ = ["wide_gaps"]


def wide_gaps(
    reference: SplineBatch, trial: SplineBatch, meetings: Sequence[Meeting], limit: float
) -> list[tuple[int, float]]:
    """Find the curves that need another point because of gaps, the widest first.

    Parameters
    ----------
    reference : SplineBatch
        The lines as given.
    trial : SplineBatch
        The curves as they are thinned so far.
    meetings : sequence of Meeting
        Crossings that define neither curve.
    limit : float, m
        How wide a gap may be.

    Returns
    -------
    list of (int, float)
        A curve and the parameter (m) of the crossing on its reference; the curve that passes
        its own line farther off comes first, the other of the pair after it.
    """
    if not meetings:
        return []
    curve, at, normal = _places(reference, meetings)
    off = _off(trial, meetings, normal)
    apart = np.array([float((each.spots[0] - each.spots[1]) @ n)
                      for each, n in zip(meetings, normal, strict=True)])  # fmt: skip
    gap = np.abs(off[:, 0] - off[:, 1] + apart)
    found: list[tuple[int, float]] = []
    for i in np.argsort(-gap, kind="stable")[: int((gap > limit).sum())].tolist():
        first = int(abs(off[i, 1]) >= abs(off[i, 0]))
        found += [(int(curve[i, j]), float(at[i, j])) for j in (first, 1 - first)]
    return found


def _places(
    reference: SplineBatch, meetings: Sequence[Meeting]
) -> tuple[IntArray, FloatArray, FloatArray]:
    """Give curves and parameters, (k, 2), and normals of the hull, (k, 3), of meetings."""
    curve = np.array([[each.a, each.b] for each in meetings])
    at = np.array([each.at for each in meetings])
    one, other = (_tangents(reference, curve[:, i], at[:, i]) for i in (0, 1))
    return curve, at, crossing_normals(one, other)


def _tangents(reference: SplineBatch, curve: IntArray, at: FloatArray) -> FloatArray:
    slope = derivative(reference, curve, at)
    return np.asarray(slope / np.sqrt((slope * slope).sum(axis=1))[:, None])


def _off(trial: SplineBatch, meetings: Sequence[Meeting], normal: FloatArray) -> FloatArray:
    """Give how far each of the two curves lies off its own line along the normal, (k, 2), m."""
    sides = [[each.a, each.b] for each in meetings]
    spots = np.array([each.spots for each in meetings]).reshape(-1, 3)
    foot = closest_each(trial, np.array(sides, np.int64).ravel(), spots)[1]
    away = (foot - spots).reshape(-1, 2, 3)
    return np.asarray((away * normal[:, None]).sum(axis=2))
