"""Which way a new line runs at each of its marks, its fuller side always on the same hand.

The hull's normal is the cross product of the tangents of two curves; which way is outward
follows from the sense of the families: sections run upward, other lines forward.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.edit.newline.plane_marks import Marks
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.model.gaps import crossing_normals, tangents
from assoc_hull.model.state import HullState, Meets

__all__ = ["forward", "headings"]


def forward(state: HullState, curves: IntArray) -> IntArray:
    """Give +1 for curves that run as their family should, -1 for others, (k,) int."""
    found = np.ones(len(curves), np.int64)
    for i, curve in enumerate(curves.tolist()):
        axis = 2 if state.family(state.line_of(curve)).axis == 0 else 0
        ends = state.spline(curve).xyz[[0, -1], axis]
        found[i] = -1 if ends[1] < ends[0] else 1
    return found


def headings(state: HullState, marks: Marks, normal: FloatArray) -> FloatArray:
    """Give the direction of a new line at its marks.

    Parameters
    ----------
    state : HullState
        The tables.
    marks : Marks
        Where its plane meets the net.
    normal : (3,)
        Unit normal of the plane.

    Returns
    -------
    (k, 3)
        Unit vectors in the plane; nil where a curve has no crossing that tells.
    """
    outward = np.zeros((len(marks.curve), 3))
    for curve in np.unique(marks.curve[marks.boundary < 0]).tolist():
        at, known = _normals(state, curve)
        mine = np.flatnonzero(marks.curve == curve)
        for axis in range(3 if len(at) else 0):
            outward[mine, axis] = np.interp(marks.at[mine], at, known[:, axis])
    ahead = np.cross(normal, outward)
    length = np.sqrt((ahead * ahead).sum(axis=1))
    found: FloatArray = ahead / np.where(length > 0.0, length, 1.0)[:, None]
    return found


def _normals(state: HullState, curve: int) -> tuple[FloatArray, FloatArray]:
    """Give the hull's outward normal at a curve's crossings with other lines, along it."""
    meets: Meets = state.curves.meets.data[curve]
    known = meets.row >= 0
    known[known] = ~state.rows.contact.data[meets.row[known]]
    rows, at = meets.row[known], meets.parameter[known]
    if not len(rows):
        return at, np.zeros((0, 3))
    side = (state.rows.curve.data[rows, 0] == curve).astype(np.int64)
    others = state.rows.curve.data[rows, side]
    own = tangents(state, np.full(len(rows), curve), at)
    theirs = tangents(state, others, state.rows.parameter.data[rows, side])
    across = crossing_normals(own, theirs)
    outward = np.cross(_left_of(state, curve), own)
    inward = (across * outward).sum(axis=1) < 0.0
    order = np.argsort(at, kind="stable")
    return at[order], np.where(inward[:, None], -across, across)[order]


def _left_of(state: HullState, curve: int) -> FloatArray:
    """Give the vector whose cross product with a curve's tangent points out of the hull."""
    line = state.line_of(curve)
    sense = float(forward(state, np.array([curve]))[0])
    upward = state.family(line).axis == 0
    found: FloatArray = state.lines.normal.data[line] * (-sense if upward else sense)
    return found
