"""Which of the two senses of a normal points out of the hull.

Told from the way a plane line runs, not from where it lies: near a stern post or in a hollow
the skin may face the centre plane or the deck. A section runs from the keel up, any other
line from aft forward; the hull lies to a known side of it.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.state import HullState

__all__ = ["turn_outward"]

_SHORT = 1e-6
"""Ends nearer than this (m) along a curve's course do not tell its direction."""


def turn_outward(state: HullState, normal: FloatArray, tangent: FloatArray) -> FloatArray:
    """Turn normals out of the hull.

    Parameters
    ----------
    state : HullState
        The tables.
    normal : (rows, 3)
        Unit normals of either sense; nil where it is not known.
    tangent : (rows, 2, 3)
        Unit tangents of the two curves at every point, as the curves are stored.

    Returns
    -------
    (rows, 3)
        The same normals, turned. Where both curves are boundary or space curves, away from
        the line of the deck in the centre plane.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.edit.normals import hull_normals
    >>> from assoc_hull.shipped.wigley import wigley
    >>> normal = hull_normals(wigley())
    >>> bool((normal[:, 1] > -1e-12).all())
    True
    """
    reference = _references(state, tangent)
    cosine = (normal[:, None, :] * reference).sum(axis=2)
    surer = np.abs(cosine[:, 1]) > np.abs(cosine[:, 0])
    away = np.where(surer, cosine[:, 1], cosine[:, 0])
    unknown = ~(reference != 0.0).any(axis=(1, 2))
    away[unknown] = _from_deck(state, normal)[unknown]
    return np.where((away < 0.0)[:, None], -normal, normal)


def _references(state: HullState, tangent: FloatArray) -> FloatArray:
    """Give the direction out of the hull in the plane of each curve, (rows, 2, 3)."""
    curve = state.rows.curve.data
    line = np.where(curve >= 0, state.curves.line.data[np.maximum(curve, 0)], 0)
    told = (curve >= 0) & state.lines.planar.data[line]
    told &= state.lines.boundary.data[line] < 0
    plane = np.where(told[:, :, None], state.lines.normal.data[line], 0.0)
    out = np.cross(plane, tangent)
    sense = np.where(told, _course(state)[np.maximum(curve, 0)], 0.0)
    return np.asarray(out * sense[:, :, None])


def _course(state: HullState) -> FloatArray:
    """Give 1 or -1 by curve, so that plane x tangent points outward with it."""
    found = np.ones(state.curves.count)
    for curve in state.live("curves").tolist():
        line = state.line_of(curve)
        xyz, normal = state.rows.xyz.data[state.curves.rows.data[curve]], state.lines.normal.data
        if not state.lines.planar.data[line] or len(xyz) < 2:
            continue
        across = abs(normal[line, 0]) > 0.5
        run = float(xyz[-1, 2] - xyz[0, 2]) if across else float(xyz[-1, 0] - xyz[0, 0])
        if abs(run) < _SHORT:
            run = _turn(xyz, normal[line]) * (1.0 if across else -1.0)
        found[curve] = np.copysign(1.0, -run if across else run)
    return found


def _turn(xyz: FloatArray, normal: FloatArray) -> float:
    """Give the area a closed curve goes round, counted positive about the normal, m2."""
    areas = 0.5 * np.cross(xyz[:-1] - xyz[0], xyz[1:] - xyz[0]).sum(axis=0)
    return float((areas * normal).sum())


def _from_deck(state: HullState, normal: FloatArray) -> FloatArray:
    """Tell by its sign whether a normal points away from the deck's line in the centre plane."""
    xyz = state.rows.xyz.data
    top = max(state.particulars.depth, float(xyz[state.live("rows"), 2].max(initial=0.0)))
    found: FloatArray = normal[:, 1] * xyz[:, 1] + normal[:, 2] * (xyz[:, 2] - top)
    return found
