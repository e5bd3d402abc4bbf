"""The parallel body: between which neighbouring sections the hull only runs on.

Lines through stations that are equal, and then are not, swing a little past them: by 1 or 2 cm
on a ship of 120 m, over the length of a station's distance. The area of the sections would swell
there beyond that of the largest, which no parallel body does. Where two neighbouring sections
of a hull with flats are both as large as the largest, the surface runs straight between them.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.analysis.net.gather import Net
from assoc_hull.geometry.curves import FloatArray, SplineBatch
from assoc_hull.geometry.integrals.area_moments import section_area

__all__ = ["parallel_slabs"]

_EQUAL = 1e-4
"""Areas of sections of the parallel body differ by less, in parts of the largest."""


def parallel_slabs(net: Net, x: FloatArray) -> frozenset[int]:
    """Give the slabs between sections of the parallel body; none for a hull without flats.

    Parameters
    ----------
    net : Net
        The curves.
    x : (n,), m
        Where sections stand, ascending.
    """
    curves = np.flatnonzero(np.isfinite(net.x) & ~net.end)
    if not net.flat.any() or len(x) < 2:
        return frozenset()
    batch = SplineBatch.join([net.batch.part(i, i + 1) for i in curves.tolist()])
    station = np.abs(net.x[curves][:, None] - x).argmin(axis=1)
    top = np.full(len(x), -np.inf)
    np.maximum.at(top, station, np.maximum.reduceat(batch.xyz[:, 2], batch.start[:-1]))
    found = []
    for slab in range(1, len(x)):
        level = min(top[slab - 1], top[slab])
        area = np.bincount(station, section_area(batch, level), len(x))
        if area[slab - 1 : slab + 1].min() >= (1.0 - _EQUAL) * area.max():
            found.append(slab)
    return frozenset(found)
