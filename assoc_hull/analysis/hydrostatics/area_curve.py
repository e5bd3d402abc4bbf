"""The sectional-area curve as a function of x, from the aftmost wet place to the foremost."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.analysis.hydrostatics.flotation import Flotation
from assoc_hull.analysis.hydrostatics.section_areas import between_stations, section_areas
from assoc_hull.analysis.net.between import reaches
from assoc_hull.analysis.net.slabs import planes as stands
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.floating.immersed import Planes
from assoc_hull.geometry.numeric.polynomials import differentiate, horner
from assoc_hull.geometry.numeric.roots import unit_roots
from assoc_hull.geometry.splines.segments import power

__all__ = ["AreaCurve", "area_curve", "wet_reach"]

_ON = 1e-9  # m above the water is on it
_SAME = 1e-6  # m between two places along the ship


@attrs.frozen(eq=False)
class _Slab:
    """A part between x `low` and `high` in which the area is a parabola: two ends and the mean."""

    low: float
    high: float
    first: float
    last: float
    mean: float

    def at(self, x: FloatArray) -> FloatArray:
        t = (x - self.low) / (self.high - self.low)
        bulge = 6.0 * self.mean - 3.0 * (self.first + self.last)
        found: FloatArray = self.first * (1.0 - t) + self.last * t + bulge * t * (1.0 - t)
        return found


@attrs.frozen(eq=False)
class AreaCurve:
    """Areas of sections over x, below one plane.

    Attributes
    ----------
    low, high : float, m
        Aftmost and foremost wet place.
    breaks : (b,), m
        Stations between the two, and ends of parts: there the curve may bend or jump.
    largest : float, m2
        Area of the largest station.
    """

    low: float
    high: float
    breaks: FloatArray
    largest: float
    _body: Flotation
    _planes: Planes
    _slabs: tuple[_Slab, ...]

    def at(self, x: FloatArray) -> FloatArray:
        """Give the areas at x (n,), m2; nil beyond the ends."""
        found = np.zeros(len(x))
        rest = (x >= self.low) & (x <= self.high)
        for slab in self._slabs:
            here = rest & (x >= slab.low) & (x <= slab.high)
            found[here] = slab.at(x[here])
            rest &= ~here
        found[rest] = section_areas(self._body, x[rest], self._planes)[0]
        freeze(found)
        return found


def area_curve(body: Flotation, planes: Planes) -> AreaCurve:
    """Give the sectional-area curve below one plane.

    Between stations the areas are those of the surface. Where no curve of the surface lies in a
    plane across the ship (before a raked stem, say) it is a parabola between the areas at both
    ends, nil at the end of the hull, with the volume of the surface below it.

    Parameters
    ----------
    body : Flotation
        The hull.
    planes : Planes
        One plane.

    Returns
    -------
    AreaCurve
        The curve.

    Raises
    ------
    BadInputError
        Nothing is wet.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.analysis.hydrostatics.area_curve import area_curve
    >>> from assoc_hull.analysis.hydrostatics.flotation import flotation
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.geometry.floating.immersed import Planes
    >>> planes = Planes(np.array([6.25]), np.zeros(1), np.zeros(1))
    >>> curve = area_curve(flotation(wigley()), planes)
    >>> curve.low, curve.high, curve.at(np.array([2.0, 50.0])).round(1).tolist()
    (0.0, 100.0, [3.3, 41.7])
    """
    low, high = wet_reach(body, planes)
    stations = _inside(stands(body.net), low, high)
    edges = np.concatenate([[low], stations, [high]])
    middle = 0.5 * (edges[1:] + edges[:-1])
    unknown = np.flatnonzero(np.isnan(section_areas(body, middle, planes)[0]))
    slabs = tuple(_slab(body, planes, *edges[i : i + 2].tolist()) for i in unknown.tolist())
    largest = float(body.stations(planes).area.max())
    plane = np.flatnonzero(body.layout.cells.plane)
    breaks = np.concatenate([stations, reaches(body.strips, plane).ravel()])
    return AreaCurve(low, high, _inside(breaks, low, high), largest, body, planes, slabs)


def _inside(x: FloatArray, low: float, high: float) -> FloatArray:
    """Give places between two, each once, ascending."""
    every = np.sort(x[(x > low + _SAME) & (x < high - _SAME)])
    found: FloatArray = every[np.diff(every, prepend=-np.inf) > _SAME]
    return found


def _slab(body: Flotation, planes: Planes, low: float, high: float) -> _Slab:
    """Give the parabola of a part in which sections are not known."""
    stations = stands(body.net)
    near = [np.abs(stations - x).min() <= 1e-6 for x in (low, high)]
    aft, fore = low if near[0] else -np.inf, high if near[1] else np.inf
    areas = section_areas(body, np.array([low, high]), planes)[0]
    first, last = (float(a) if on else 0.0 for a, on in zip(areas, near, strict=True))
    volume = float(between_stations(body, aft, fore, planes).volume[0])
    return _Slab(low, high, first, last, volume / (high - low))


def wet_reach(body: Flotation, planes: Planes) -> tuple[float, float]:
    """Give the least and the largest x (m) of a hull below one plane, a bulb included.

    Raises
    ------
    BadInputError
        Nothing is wet.
    """
    cubic = power(body.net.batch)
    height, trim, heel = (
        float(each[0]) for each in (planes.height, planes.tan_trim, planes.tan_heel)
    )
    over = cubic[:, :, 2] - trim * cubic[:, :, 0] - abs(heel) * cubic[:, :, 1]
    over[:, 0] -= height
    end = np.ones((len(cubic), 1))
    t = np.concatenate(
        [0.0 * end, unit_roots(differentiate(cubic[:, :, 0])), unit_roots(over), end], axis=1
    )
    x = horner(cubic[:, :, 0], t)[horner(over, t) <= _ON]
    if not len(x):
        raise BadInputError(
            "nothing is under water", "in a sectional-area curve", "give more draught"
        )
    return float(x.min()), float(x.max())
