"""Rounding the turns of a new line that runs into a facet and back out of it.

Where a line turns back between two neighbouring lines of the net, its two marks there lie
abreast and a curve through them would fold. The hull's normals at the marks tell how the
line runs on from each, so the outermost point of the turn follows.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray, SplineBatch
from assoc_hull.geometry.order import folds

__all__ = ["turning_points"]


def turning_points(spline: SplineBatch, heading: FloatArray) -> list[tuple[int, FloatArray]]:
    """Give a point to be added to every turn at which a curve folds.

    Parameters
    ----------
    spline : SplineBatch
        One curve.
    heading : (n, 3)
        Unit vectors along or against the curve at its n points; nil where not known.

    Returns
    -------
    list of (int, (3,) m)
        Before which point each belongs, and its place: the middle of an arc of a circle
        that turns by the angle between the two headings.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.edit.hairpin import turning_points
    >>> from assoc_hull.geometry.curves import CurveData
    >>> from assoc_hull.geometry.spline import loft
    >>> bend = np.array([[3.0, 0, 0.2], [0, 0, 0], [0, 0, 2], [3, 0, 1.8]])
    >>> way = np.array([[-1.0, 0, 0], [-1, 0, 0], [1, 0, 0], [1, 0, 0]])
    >>> [(at, place.tolist()) for at, place in turning_points(loft(CurveData.single(bend)), way)]
    [(2, [-1.0, 0.0, 1.0])]
    """
    folded = folds(spline).knot.tolist()
    chord = np.diff(spline.xyz, axis=0)
    if float((chord * (heading[:-1] + heading[1:])).sum()) < 0.0:
        heading = -heading
    found: list[tuple[int, FloatArray]] = []
    for first in sorted({max(knot - side, 0) for knot in folded for side in (0, 1)}):
        if first + 1 < len(heading) and float((heading[first] * heading[first + 1]).sum()) < 0.5:
            place = _outermost(spline.xyz[first : first + 2], heading[first : first + 2])
            if place is not None:
                found.append((first + 1, place))
    return found


def _outermost(ends: FloatArray, heading: FloatArray) -> FloatArray | None:
    """Give the middle of an arc between two points; None where they turn to no side."""
    chord = ends[1] - ends[0]
    length = float(np.sqrt((chord * chord).sum()))
    side = heading[0] - heading[1]
    side = side - chord * float((side * chord).sum()) / length**2
    size = float(np.sqrt((side * side).sum()))
    if size < 1e-6:
        return None
    turn = float(np.arccos(np.clip((heading[0] * heading[1]).sum(), -1.0, 1.0)))
    away = 0.5 * length * np.tan(0.25 * turn)
    found: FloatArray = 0.5 * (ends[0] + ends[1]) + side / size * away
    return found
