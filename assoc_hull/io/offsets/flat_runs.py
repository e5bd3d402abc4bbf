"""Straight runs of sections and waterlines where a table prints one greatest value again and again.

A smooth curve through 7.96, 8.00, 8.00 passes 8.00 between them. Two or more neighbouring offsets
that are the greatest, to the unit of rounding, are a flat: the line comes onto it tangent, at the
place that the offsets before it tell, and runs straight along it.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.io.offsets.flat_runs import straight_runs_of
>>> y, z = np.array([5.0, 7.1, 7.775, 8.0, 8.0]), np.array([0.0, 2.0, 3.0, 5.0, 6.0])
>>> found = straight_runs_of(z, y, 0.01, 0.2)
>>> found.place.round(6).tolist(), found.tangent.tolist()
([0.0, 2.0, 3.0, 4.0, 5.0, 6.0], [False, False, False, True, False, False])
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.polylines.operations import runs_where

__all__ = ["StraightRuns", "straight_runs_of"]

_CLEARLY_OFF = 3.0
"""An offset is clearly off the flat by more than this many times half its rounding."""


@attrs.frozen(eq=False)
class StraightRuns:
    """The points of a line, with those that were put in where it comes onto a flat.

    Attributes
    ----------
    place, y : (n,), m
    given : (n,) bool
        Whether the table has the point.
    tangent : (n,) bool
        Whether the line is straight along the flat there.
    """

    place: FloatArray
    y: FloatArray
    given: NDArray[np.bool_]
    tangent: NDArray[np.bool_]


def straight_runs_of(
    place: FloatArray, y: FloatArray, unit: float, spacing: float,
    corner: NDArray[np.bool_] | None = None,
) -> StraightRuns:  # fmt: skip
    """Find where a line is straight at its greatest offset.

    Parameters
    ----------
    place : (n,), m
        Along the line, ascending.
    y : (n,), m
        Half-breadths.
    unit : float, m
        One unit of the last printed digit.
    spacing : float, m
        Points closer to one another than this are one.
    corner : (n,) bool or None
        Where the line is known to turn: it comes onto a flat there at an angle.
    """
    on = y >= y.max() - unit
    beside = np.zeros(len(y), np.bool_)
    beside[1:] |= on[:-1]
    beside[:-1] |= on[1:]
    run = on & beside
    tangent = np.zeros(len(y), np.bool_)
    more: list[tuple[float, float]] = []
    for first, stop in runs_where(run).tolist():
        for edge, before in ((first, slice(first - 1, None, -1)), (stop - 1, slice(stop, None))):
            if (edge == first and not first) or (edge != first and stop == len(y)):
                continue  # it is the end of the line: points in a row are straight as they are
            if corner is not None and corner[edge]:
                continue
            at = _entry(place[before], y[edge] - y[before], float(place[edge]), 0.5 * unit, spacing)
            if at is None:
                tangent[edge] = True
            else:
                more.append((at, float(y[edge])))
    extra = np.array(more).reshape(-1, 2)
    places = np.append(place, extra[:, 0])
    order = np.argsort(places)
    new = np.ones(len(extra), np.bool_)
    return StraightRuns(
        places[order], np.append(y, extra[:, 1])[order],
        np.append(np.ones(len(y), np.bool_), ~new)[order], np.append(tangent, new)[order],
    )  # fmt: skip


def _entry(
    place: FloatArray, off: FloatArray, edge: float, rounding: float, spacing: float
) -> float | None:
    """Give where a line comes onto a flat before its first offset on it; None if that tells it.

    `place` and `off` (m) of the offsets before it, the nearest first. Near a flat the distance from
    it grows with the square of the distance along the line.
    """
    clear = np.flatnonzero(off > _CLEARLY_OFF * rounding)[:2]
    gap = edge - float(place[0])
    if len(clear) < 2 or abs(gap) < 2.1 * spacing:
        return None
    (v, u), (q, p) = place[clear], np.sqrt(off[clear])
    if not p > q:
        return None
    # As a part of the gap, clear of the points at both its ends.
    part = (v + (v - u) * q / (p - q) - float(place[0])) / gap
    least = 1.05 * spacing / abs(gap)
    if part > 1.0 - least:
        return None
    return float(place[0] + max(part, least, 0.1) * gap)
