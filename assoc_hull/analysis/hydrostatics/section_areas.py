"""The sectional-area curve between stations, and what lies between two of them.

Areas at any x are those of the surface there, not of a curve laid through the stations: inside
a parallel body they stay what they are.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.analysis.hydrostatics.flotation import Flotation
from assoc_hull.analysis.net.between import areas_between
from assoc_hull.analysis.net.slabs import planes as stands
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.floating.immersed import Immersed, Planes
from assoc_hull.geometry.floating.immersion import immersed
from assoc_hull.geometry.floating.prepared_strips import prepare
from assoc_hull.geometry.surfaces.isocurves import IsoCurves, Strips

__all__ = ["between_stations", "section_areas"]

_ON = 1e-6
"""So near to a station (m) a place is on it."""


@attrs.frozen(eq=False)
class _Some:
    """Some of the strips of a body; implements `Strips`."""

    whole: Strips
    chosen: IntArray

    @property
    def count(self) -> int:
        return len(self.chosen)

    @property
    def order(self) -> IntArray:
        return self.whole.order[self.chosen]

    def curves(self, strip: IntArray, v: FloatArray) -> IsoCurves:
        return self.whole.curves(self.chosen[strip], v)


def between_stations(body: Flotation, aft: float, fore: float, planes: Planes) -> Immersed:
    """Integrate the part of a hull that lies between two stations.

    Parameters
    ----------
    body : Flotation
        The hull.
    aft, fore : float, m
        x of the stations, such as those at AP and FP; infinite for an end of the hull.
    planes : Planes
        d planes.

    Returns
    -------
    Immersed
        Of that part, (d,) each; the two stations are no part of its surface.

    Raises
    ------
    BadInputError
        No station stands there.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.analysis.hydrostatics.flotation import flotation
    >>> from assoc_hull.analysis.hydrostatics.section_areas import between_stations
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.geometry.floating.immersed import Planes
    >>> planes = Planes(np.array([6.25]), np.zeros(1), np.zeros(1))
    >>> part = between_stations(flotation(wigley()), 25.0, 75.0, planes)
    >>> round(float(part.volume[0]))  # 11/16 of 4/9 L B T
    1910
    """
    x = stands(body.net)
    first, last = _station(x, aft), _station(x, fore)
    slab = np.array([frame.slab for frame in body.layout.frames], np.int64)
    chosen = np.flatnonzero((slab > first) & (slab <= last))
    return immersed(prepare(_Some(body.strips, chosen)), planes)


def _station(x: FloatArray, place: float) -> int:
    if np.isinf(place):
        return -1 if place < 0.0 else len(x)
    near = int(np.abs(x - place).argmin())
    if not abs(x[near] - place) <= _ON:
        what = f"no station stands at x {place:g} m"
        raise BadInputError(what, "in hydrostatics", f"the nearest is at {x[near]:g} m")
    return near


def section_areas(body: Flotation, x: FloatArray, planes: Planes) -> FloatArray:
    """Give the areas of sections anywhere along a hull.

    Parameters
    ----------
    body : Flotation
        The hull.
    x : (n,), m
        Where.
    planes : Planes
        d planes.

    Returns
    -------
    (d, n), m2
        Of both sides; nil beyond the ends of the hull, nan between an end of the hull (a raked
        stem, a piece that begins) and the next station, where no curve of the surface lies in
        a plane across the ship.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.analysis.hydrostatics.flotation import flotation
    >>> from assoc_hull.analysis.hydrostatics.section_areas import section_areas
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.geometry.floating.immersed import Planes
    >>> planes = Planes(np.array([6.25]), np.zeros(1), np.zeros(1))
    >>> section_areas(flotation(wigley()), np.array([-5.0, 37.5, 50.0]), planes).round(2).tolist()
    [[0.0, 39.06, 41.66]]
    """
    station = stands(body.net)
    slab = np.searchsorted(station, x, side="left")
    on = np.abs(station[np.minimum(slab, len(station) - 1)] - x) <= _ON
    found = np.full((len(planes.height), len(x)), np.nan)
    found[:, (x < body.net.batch.xyz[:, 0].min()) | (x > body.net.batch.xyz[:, 0].max())] = 0.0
    own = body.stations(planes)
    for i in np.flatnonzero(on).tolist():
        found[:, i] = own.area[:, np.abs(own.x - x[i]).argmin()]
    for s in np.unique(slab[~on]).tolist():
        here = np.flatnonzero((slab == s) & ~on)
        areas = areas_between(body.layout, body.strips, station, x[here], planes)
        if areas is not None:
            found[:, here] = areas
    freeze(found)
    return found
