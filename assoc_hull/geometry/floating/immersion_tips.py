"""Where waterplanes end inside a strip: the points of events.

An event is a critical point of a curve that lies in the plane. The place along v is found
among plain numbers; one Newton step from there has the point's derivatives, too.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.floating.immersion_critical import Critical, critical, nearest
from assoc_hull.geometry.floating.immersion_extents import extent
from assoc_hull.geometry.floating.immersion_places import Brackets
from assoc_hull.geometry.floating.immersion_roots import Tilted, tilt
from assoc_hull.geometry.floating.immersion_states import times_cut
from assoc_hull.geometry.floating.tiles import from_curves
from assoc_hull.geometry.numeric.dual import real
from assoc_hull.geometry.surfaces.isocurves import Strips

__all__ = ["tips"]

_FLAT = 1e-9  # m per strip: a point that changes its height by less has no place of its own


def tips(strips: Strips, inclined: Tilted, levels: FloatArray, found: Brackets) -> FloatArray:
    """Give the extents of the points of events.

    Parameters
    ----------
    strips : Strips
        The body.
    inclined : Tilted
        Its inclination.
    levels : (d,), m
        Heights of the planes.
    found : Brackets
        The places of events; the planes are their `row` by the number of strips.

    Returns
    -------
    (4, d), m
        As in `extent`.
    """
    # Where no curve is cut on either side, no waterplane ends.
    some = np.flatnonzero((times_cut(found.below) > 0) | (times_cut(found.above) > 0))
    plane, v = found.row[some] // strips.count, 0.5 * (found.low + found.high)[some]
    tiles = from_curves(strips.curves(found.strip[some], v))
    points = critical(tiles, tilt(tiles, inclined.trim, inclined.heel))
    passing = nearest(points, found.level[some], tiles.curves)
    x, y = _moved(points, passing, np.take(levels, plane))
    return extent(x, y, plane, len(levels))


def _moved(points: Critical, point: IntArray, level: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Give x and y of points where they pass their levels, one Newton step away."""
    change = np.take(points.change, point)
    steep = np.abs(real(change)) > _FLAT
    step = (level - np.take(points.height, point)) / np.where(steep, change, 1.0)
    step = np.where(steep, step, 0.0)
    place, rate = np.take(points.place, point, axis=1), np.take(points.rate, point, axis=1)
    moved = place + rate * step
    return moved[0], moved[1]
