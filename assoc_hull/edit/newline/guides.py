"""Where lines of higher rank pass the plane of a new line, which is not cut from them.

Those lines were fitted to the hull too. So where the new line, made through its marks, would
pass them far off, or not come to their planes at all, they know better between its marks.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.edit.followup.births_and_deaths import ONE_PLACE
from assoc_hull.edit.newline.plane_marks import Marks, find_guides
from assoc_hull.geometry.curves import CurveData, FloatArray, SplineBatch
from assoc_hull.geometry.splines.closest import closest
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.model.state import HullState

__all__ = ["with_guides"]


def with_guides(state: HullState, line: int, pieces: list[Marks]) -> list[Marks]:
    """Put the places where lines of higher rank pass a new line's plane among its marks.

    Parameters
    ----------
    state : HullState
        The tables.
    line : int
        The new line.
    pieces : list of Marks
        What it is cut from, each piece in order along it.

    Returns
    -------
    list of Marks
        The pieces; each guide stands between the marks of the nearest one, in order. One
        that is not at one place with any piece is left out.
    """
    normal, offset = state.lines.normal.data[line].copy(), float(state.lines.offset.data[line])
    guides = find_guides(state, int(state.lines.group.data[line]), normal, offset)
    if not len(guides.curve) or not pieces:
        return pieces
    shapes = SplineBatch.join([loft(CurveData.single(piece.xyz)) for piece in pieces])
    feet = [closest(shapes, i, guides.xyz) for i in range(len(pieces))]
    away = np.array([foot[2] for foot in feet])
    nearest = np.where(away.min(axis=0) <= ONE_PLACE, away.argmin(axis=0), -1)
    found: list[Marks] = []
    for i, piece in enumerate(pieces):
        mine = np.flatnonzero(nearest == i)
        knots = shapes.knot[shapes.start[i] : shapes.start[i + 1]]
        at = np.concatenate([knots, _between(feet[i][0][mine], knots)])
        found.append(piece.join(guides.take(mine)).take(np.argsort(at, kind="stable")))
    return found


def _between(at: FloatArray, knots: FloatArray) -> FloatArray:
    """Keep parameters off the ends of a piece: these are boundary curves' and stay the ends."""
    found: FloatArray = np.clip(at, np.nextafter(knots[0], np.inf), np.nextafter(knots[-1], 0.0))
    return found
