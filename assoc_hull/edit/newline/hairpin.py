"""Rounding the turns of a new line that runs into a facet and back out of it.

Where a line turns back between two neighbouring lines of the net, its two marks there lie
abreast and a curve through them would fold. The hull's normals at the marks tell how the
line runs on from each, so the outermost point of the turn follows.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import CurveData, FloatArray, PointKind
from assoc_hull.geometry.splines.curve_order import folds
from assoc_hull.geometry.splines.loft import loft

__all__ = ["closing_point", "turning_points"]

_ROUNDS = 3
"""A turn that is halved three times bends by a few degrees from point to point."""

_TURN = 0.87
"""Cosine of the least turn between two points that is given another one."""


def turning_points(data: CurveData, heading: FloatArray) -> list[tuple[int, FloatArray]]:
    """Give the points to be added to the turns at which a curve would fold.

    Parameters
    ----------
    data : CurveData
        One curve.
    heading : (n, 3)
        Unit vectors along or against the curve at its n points; nil where not known.

    Returns
    -------
    list of (int, (3,) m)
        Before which point each belongs, and its place: the middle of an arc of a circle
        that turns by the angle between the headings on either side. In order.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.edit.newline.hairpin import turning_points
    >>> from assoc_hull.geometry.curves import CurveData
    >>> bend = np.array([[3.0, 0, 0.2], [0, 0, 0], [0, 0, 2], [3, 0, 1.8]])
    >>> way = np.array([[-1.0, 0, 0], [-1, 0, 0], [1, 0, 0], [1, 0, 0]])
    >>> [(at, place.tolist()) for at, place in turning_points(CurveData.single(bend), way)]
    [(2, [-1.0, 0.0, 1.0])]
    """
    heading, own = _along(data.xyz, heading), np.arange(len(data.xyz))
    added: list[tuple[int, FloatArray]] = []
    for _ in range(_ROUNDS):
        turns = _turns(data.xyz, heading, folds(loft(data)).knot.tolist())
        if not turns:
            break
        added += [(int(own[at]), place) for at, place, _ in turns]
        before = [at for at, _, _ in turns]
        places = np.array([place for _, place, _ in turns])
        heading = np.insert(heading, before, [way for _, _, way in turns], axis=0)
        own = np.insert(own, before, own[before])
        data = CurveData.single(
            np.insert(data.xyz, before, places, axis=0),
            np.insert(data.kind, before, PointKind.SMOOTH),
            np.insert(data.direction, before, 0.0, axis=0),
        )
    order = {place.tobytes(): i for i, place in enumerate(data.xyz)}
    return sorted(added, key=lambda item: order[item[1].tobytes()])


def _turns(
    xyz: FloatArray, heading: FloatArray, folded: list[int]
) -> list[tuple[int, FloatArray, FloatArray]]:
    """Give the turns beside points at which a curve folds: before which, where, which way."""
    found: list[tuple[int, FloatArray, FloatArray]] = []
    for first in sorted({max(knot - side, 0) for knot in folded for side in (0, 1)}):
        pair = slice(first, first + 2)
        if first + 1 < len(xyz) and float((heading[first] * heading[first + 1]).sum()) < _TURN:
            place = _outermost(xyz[pair], heading[pair])
            if place is not None:
                chord = xyz[first + 1] - xyz[first]
                way = chord / np.sqrt((chord * chord).sum())
                found.append((first + 1, place, way))
    return found


def closing_point(xyz: FloatArray, heading: FloatArray) -> FloatArray:
    """Give the place, (3,) m, at which a ring through points begins and ends.

    Parameters
    ----------
    xyz : (n, 3), m
        Points in order; the place lies between the last and the first.
    heading : (n, 3)
        As for `turning_points`.
    """
    ends, way = xyz[[-1, 0]], _along(xyz, heading)[[-1, 0]]
    place = _outermost(ends, way)
    middle: FloatArray = 0.5 * (ends[0] + ends[1])
    return middle if place is None else place


def _along(xyz: FloatArray, heading: FloatArray) -> FloatArray:
    """Turn headings the way the points follow one another."""
    chord = np.diff(xyz, axis=0)
    against = float((chord * (heading[:-1] + heading[1:])).sum()) < 0.0
    return -heading if against else heading


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
