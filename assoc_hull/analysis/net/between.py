"""Sections anywhere between two stations, as the surface through a net has them."""

from __future__ import annotations

import numpy as np

from assoc_hull.analysis.net.cells import Layout
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.immersed import Planes
from assoc_hull.geometry.immersed_sections import sections_below
from assoc_hull.geometry.isocurves import Strips

__all__ = ["areas_between"]


def areas_between(
    layout: Layout, strips: Strips, station: FloatArray, x: FloatArray, planes: Planes
) -> FloatArray | None:
    """Give the areas of sections between two neighbouring stations.

    Parameters
    ----------
    layout : Layout
        How the surface is put together.
    strips : Strips
        The surface.
    station : (k,), m
        Where the stations are, ascending.
    x : (n,), m
        Where the sections are, all between the same two stations.
    planes : Planes
        d planes.

    Returns
    -------
    (d, n), m2, or None
        Of both sides; None beyond the last stations, and where a strip begins or ends between
        the two, so that no curve of the surface lies in a plane across the ship.
    """
    slab = int(np.searchsorted(station, x[0]))
    strip = np.array([i for i, each in enumerate(layout.frames) if each.slab == slab], np.int64)
    if not (0 < slab < len(station) and len(strip) and layout.cells.plane[strip].all()):
        return None
    v = (x - station[slab - 1]) / (station[slab] - station[slab - 1])
    curves = strips.curves(np.tile(strip, len(v)), np.repeat(v, len(strip)))
    area = sections_below(curves, planes).reshape(len(planes.height), len(v), len(strip))
    total: FloatArray = area.sum(axis=2)
    return total
