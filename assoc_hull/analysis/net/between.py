"""Sections anywhere between two stations, as the surface through a net has them."""

from __future__ import annotations

import numpy as np

from assoc_hull.analysis.net.cells import Layout
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.floating.immersed import Planes
from assoc_hull.geometry.floating.immersed_sections import sections_below
from assoc_hull.geometry.surfaces.isocurves import Strips

__all__ = ["areas_between", "reaches"]


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
        Of both sides; None beyond the last stations, and where a strip begins or ends at a
        raked line between the two, so that no curve of it lies in a plane across the ship.
    """
    slab = int(np.searchsorted(station, x[0]))
    strip = np.array([i for i, each in enumerate(layout.frames) if each.slab == slab], np.int64)
    if not (0 < slab < len(station) and len(strip) and layout.cells.plane[strip].all()):
        return None
    reach = reaches(strips, strip)
    v = (x[:, None] - reach[:, 0]) / (reach[:, 1] - reach[:, 0])
    place, which = np.nonzero((v >= 0.0) & (v <= 1.0))
    total = np.zeros((len(planes.height), len(x)))
    if len(place):
        curves = strips.curves(strip[which], v[place, which])
        np.add.at(total.T, place, sections_below(curves, planes).T)
    return total


def reaches(strips: Strips, strip: IntArray) -> FloatArray:
    """Give from where to where strips between stations run: some begin or end between two.

    Parameters
    ----------
    strips : Strips
        The surface.
    strip : (k,) int
        Strips whose curves lie in planes across the ship.

    Returns
    -------
    (k, 2), m
        x of both ends.
    """
    curves = strips.curves(np.repeat(strip, 2), np.tile([0.0, 1.0], len(strip)))
    found: FloatArray = curves.point[curves.start[:-1], 0, 0].reshape(-1, 2)
    return found
