"""Which marks a new line must be made through, beside those that the role rule chooses.

A line through those alone may pass another mark too far off, or never come to the plane of
the mark's line near it. Then the crossing there would be lost, though both lines pass: it
would die, and be born again farther on, with the hull's shape the same all the way.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.edit.followup.births_and_deaths import ONE_PLACE
from assoc_hull.edit.newline.plane_marks import Marks
from assoc_hull.geometry.curves import CurveData, FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.splines.closest import closest
from assoc_hull.geometry.splines.evaluation import derivative
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.plane_intersections import Meetings, meet_planes
from assoc_hull.model.gaps import crossing_normals, tangents
from assoc_hull.model.roles import BoolArray
from assoc_hull.model.state import HullState

__all__ = ["hold"]


def hold(
    state: HullState,
    marks: Marks,
    kind: np.typing.NDArray[np.int8],
    direction: FloatArray,
    ruled: BoolArray,
) -> BoolArray:
    """Add the marks that a line through those of the rule alone would pass too far off.

    Without them a short piece between two ends would be straight, and its crossings lost.

    Parameters
    ----------
    state : HullState
        The tables.
    marks : Marks
        Where the line passes, in order along it, with guides.
    kind, direction : (k,) int8, (k, 3)
        Of the line at its marks.
    ruled : (k,) bool
        What the rule chooses.

    Returns
    -------
    (k,) bool
        The marks that the line is to be made through. It meets the planes of all others
        near them; those it is cut from it passes within the tolerance of adoption.
    """
    picked = ruled.copy()
    while not picked.all():
        spline = loft(CurveData.single(marks.xyz[picked], kind[picked], direction[picked]))
        rest = np.flatnonzero(~picked)
        away = closest(spline, 0, marks.xyz[rest])[2]
        far = (away > state.tolerances.adoption) & ~marks.guide[rest]
        far |= _unmet(state, marks, spline)[rest]
        if not far.any():
            break
        picked[rest[int(np.where(far, away, -1.0).argmax())]] = True
    return picked


def _unmet(state: HullState, marks: Marks, spline: SplineBatch) -> BoolArray:
    """Tell at which marks of plane lines a line does not meet their planes at one place."""
    lines = state.curves.line.data[marks.curve]
    planar = state.lines.planar.data[lines] & (marks.boundary < 0)
    unmet: BoolArray = planar.copy()
    for normal in sorted({tuple(row) for row in state.lines.normal.data[lines[planar]].tolist()}):
        mine = np.flatnonzero(planar & (state.lines.normal.data[lines] == normal).all(axis=1))
        offsets, plane = np.unique(state.lines.offset.data[lines[mine]], return_inverse=True)
        met = meet_planes(spline, np.array(normal), offsets)
        unmet[mine[_paired(state, marks.take(mine), plane, spline, met)]] = False
    return unmet


def _paired(
    state: HullState, marks: Marks, plane: IntArray, spline: SplineBatch, met: Meetings
) -> IntArray:
    """Give the marks that have a meeting of their own, the nearest pairs first."""
    mark, root = np.nonzero(plane[:, None] == met.plane[None, :])
    step = marks.xyz[mark] - met.xyz[root]
    apart = np.sqrt((step * step).sum(axis=1))
    theirs = tangents(state, marks.curve, marks.at)[mark]
    slope = derivative(spline, np.zeros(len(root), np.int64), met.t[root])
    own = slope / np.sqrt((slope * slope).sum(axis=1))[:, None]
    gap = np.abs((step * crossing_normals(own, theirs)).sum(axis=1))
    near = (apart <= ONE_PLACE) & (gap <= state.tolerances.adoption)
    taken: tuple[set[int], set[int]] = set(), set()
    for i in np.flatnonzero(near)[np.argsort(apart[near], kind="stable")].tolist():
        one, other = int(mark[i]), int(root[i])
        if one not in taken[0] and other not in taken[1]:
            taken[0].add(one)
            taken[1].add(other)
    return np.array(sorted(taken[0]), np.int64)
