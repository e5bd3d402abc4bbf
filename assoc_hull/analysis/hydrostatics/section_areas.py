"""Areas of sections: of stations, anywhere along the hull, as a curve over x, over the draught.

Areas at any x are those of the surface there, not of a curve laid through the stations: inside a
parallel body they stay what they are. `area_curve` runs from the aftmost wet point to the foremost;
`bonjean` gives the stations up to level planes. Areas are of both sides, m2.
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.analysis.hydrostatics.floating_body import (
    FloatingBody,
    FloatingPosition,
    StationAreas,
    require_afloat,
)
from assoc_hull.analysis.hydrostatics.flotation import Flotation, body_of, flotation
from assoc_hull.analysis.hydrostatics.tunnel import TunnelledBody
from assoc_hull.analysis.net.curve_net import flat_ends_below, station_planes
from assoc_hull.analysis.net.surface_layout import areas_between, strip_extents
from assoc_hull.arguments import integer, numbers, shown
from assoc_hull.errors import BadInputError, OutOfRangeError, WrongTypeError
from assoc_hull.geometry.curves import FloatArray, IntArray, IsoCurves, Strips, freeze
from assoc_hull.geometry.floating.immersed_strips import prepare_strips
from assoc_hull.geometry.floating.immersion import (
    FloatingPlanes,
    ImmersedIntegrals,
    integrate_immersed,
)
from assoc_hull.geometry.numeric.polynomials import differentiate, horner, unit_roots
from assoc_hull.geometry.splines.segments import power_coefficients
from assoc_hull.model.tables import HasState, state_of

__all__ = [
    "AreaCurve",
    "Bonjean",
    "area_curve",
    "between_stations",
    "bonjean",
    "section_areas",
    "sectional_area_course",
    "sectional_areas",
    "wet_extent",
]

# --------------------------------------------------------------------------------------
# Areas at any x, and integrals between two stations.

_ON_STATION = 1e-6
"""A place this near to a station (m) is on it."""


@attrs.frozen(eq=False)
class _ChosenStrips:
    """Chosen strips of a body; implements `Strips`."""

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


def between_stations(
    body: Flotation, aft: float, fore: float, planes: FloatingPlanes
) -> ImmersedIntegrals:
    """Integrate the part of a hull that lies between two stations.

    Parameters
    ----------
    body : Flotation
        The hull.
    aft, fore : float, m
        x of the stations, such as those at AP and FP; infinite for an end of the hull.
    planes : FloatingPlanes
        d planes.

    Returns
    -------
    ImmersedIntegrals
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
    >>> from assoc_hull.geometry.floating.immersion import FloatingPlanes
    >>> planes = FloatingPlanes(np.array([6.25]), np.zeros(1), np.zeros(1))
    >>> part = between_stations(flotation(wigley()), 25.0, 75.0, planes)
    >>> round(float(part.volume[0]))  # 11/16 of 4/9 L B T
    1910
    """
    x = station_planes(body.net)
    first, last = _station(x, aft), _station(x, fore)
    slab = np.array([frame.slab for frame in body.layout.frames], np.int64)
    chosen = np.flatnonzero((slab > first) & (slab <= last))
    return integrate_immersed(prepare_strips(_ChosenStrips(body.strips, chosen)), planes)


def _station(x: FloatArray, place: float) -> int:
    if np.isinf(place):
        return -1 if place < 0.0 else len(x)
    near = int(np.abs(x - place).argmin())
    if not abs(x[near] - place) <= _ON_STATION:
        what = f"no station stands at x {place:g} m"
        raise BadInputError(what, "in hydrostatics", f"the nearest is at {x[near]:g} m")
    return near


def section_areas(body: Flotation, x: FloatArray, planes: FloatingPlanes) -> FloatArray:
    """Give the areas of sections anywhere along a hull.

    Parameters
    ----------
    body : Flotation
        The hull.
    x : (n,), m
        Where.
    planes : FloatingPlanes
        d planes.

    Returns
    -------
    (d, n), m2
        Of both sides; zero beyond the ends of the hull, nan between an end of the hull (a raked
        stem, a piece that begins) and the next station, where no curve of the surface lies in
        a plane across the ship.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.analysis.hydrostatics.flotation import flotation
    >>> from assoc_hull.analysis.hydrostatics.section_areas import section_areas
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.geometry.floating.immersion import FloatingPlanes
    >>> planes = FloatingPlanes(np.array([6.25]), np.zeros(1), np.zeros(1))
    >>> section_areas(flotation(wigley()), np.array([-5.0, 37.5, 50.0]), planes).round(2).tolist()
    [[0.0, 39.06, 41.66]]
    """
    station = station_planes(body.net)
    slab = np.searchsorted(station, x, side="left")
    on = np.abs(station[np.minimum(slab, len(station) - 1)] - x) <= _ON_STATION
    found = np.full((len(planes.height), len(x)), np.nan)
    found[:, (x < body.net.batch.xyz[:, 0].min()) | (x > body.net.batch.xyz[:, 0].max())] = 0.0
    own = body.stations(planes)
    for i in np.flatnonzero(on).tolist():
        found[:, i] = own.area[:, np.abs(own.x - x[i]).argmin()]
    off = np.flatnonzero(~on)
    areas = areas_between(body.layout, body.strips, station, x[off], planes)
    found[:, off] = np.where(np.isnan(areas), found[:, off], areas)
    freeze(found)
    return found


# --------------------------------------------------------------------------------------
# The sectional-area curve as a function of x.

_ON_END = 1e-9  # m above the water is on it
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
    _planes: FloatingPlanes
    _slabs: tuple[_Slab, ...]

    def at(self, x: FloatArray) -> FloatArray:
        """Give the areas at x (n,), m2; zero beyond the ends."""
        found = np.zeros(len(x))
        rest = (x >= self.low) & (x <= self.high)
        for slab in self._slabs:
            here = rest & (x >= slab.low) & (x <= slab.high)
            found[here] = slab.at(x[here])
            rest &= ~here
        found[rest] = section_areas(self._body, x[rest], self._planes)[0]
        freeze(found)
        return found


def area_curve(body: Flotation, planes: FloatingPlanes) -> AreaCurve:
    """Give the sectional-area curve below one plane.

    Between stations the areas are those of the surface. Where no curve of the surface lies in a
    plane across the ship (before a raked stem, say) it is a parabola between the areas at both
    ends, at the end of the hull that of a transom or other flat end there, else zero, with the
    volume of the surface below it.

    Parameters
    ----------
    body : Flotation
        The hull.
    planes : FloatingPlanes
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
    >>> from assoc_hull.analysis.hydrostatics.section_areas import area_curve
    >>> from assoc_hull.analysis.hydrostatics.flotation import flotation
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.geometry.floating.immersion import FloatingPlanes
    >>> planes = FloatingPlanes(np.array([6.25]), np.zeros(1), np.zeros(1))
    >>> curve = area_curve(flotation(wigley()), planes)
    >>> curve.low, curve.high, curve.at(np.array([2.0, 50.0])).round(1).tolist()
    (0.0, 100.0, [3.3, 41.7])
    """
    low, high = wet_extent(body, planes)
    stations = _inside(station_planes(body.net), low, high)
    edges = np.concatenate([[low], stations, [high]])
    middle = 0.5 * (edges[1:] + edges[:-1])
    unknown = np.flatnonzero(np.isnan(section_areas(body, middle, planes)[0]))
    slabs = tuple(_slab(body, planes, *edges[i : i + 2].tolist()) for i in unknown.tolist())
    largest = float(body.stations(planes).area.max())
    plane = np.flatnonzero(body.layout.cells.plane)
    breaks = np.concatenate([stations, strip_extents(body.strips, plane).ravel()])
    return AreaCurve(low, high, _inside(breaks, low, high), largest, body, planes, slabs)


def _inside(x: FloatArray, low: float, high: float) -> FloatArray:
    """Give places between two, each once, ascending."""
    every = np.sort(x[(x > low + _SAME) & (x < high - _SAME)])
    found: FloatArray = every[np.diff(every, prepend=-np.inf) > _SAME]
    return found


def _slab(body: Flotation, planes: FloatingPlanes, low: float, high: float) -> _Slab:
    """Give the parabola of a part in which sections are not known.

    Its mean is the volume there over the length, so that the curve integrates to the volume.
    """
    stations = station_planes(body.net)
    near = [np.abs(stations - x).min() <= 1e-6 for x in (low, high)]
    aft, fore = low if near[0] else -np.inf, high if near[1] else np.inf
    areas = section_areas(body, np.array([low, high]), planes)[0]
    first, last = (
        float(area) if on else float(flat_ends_below(body.net, body.closed, planes, x)[0])
        for area, on, x in zip(areas, near, (low, high), strict=True)
    )
    volume = float(between_stations(body, aft, fore, planes).volume[0])
    return _Slab(low, high, first, last, volume / (high - low))


def wet_extent(body: Flotation, planes: FloatingPlanes) -> tuple[float, float]:
    """Give the least and the largest x (m) of a hull below one plane, a bulb included.

    Raises
    ------
    BadInputError
        Nothing is wet.
    """
    cubic = power_coefficients(body.net.batch)
    height, trim, heel = (
        float(each[0]) for each in (planes.height, planes.tan_trim, planes.tan_heel)
    )
    # Of port and starboard the deeper side counts. Extremes lie at ends, turns in x, or the water.
    over = cubic[:, :, 2] - trim * cubic[:, :, 0] - abs(heel) * cubic[:, :, 1]
    over[:, 0] -= height
    end = np.ones((len(cubic), 1))
    t = np.concatenate(
        [0.0 * end, unit_roots(differentiate(cubic[:, :, 0])), unit_roots(over), end], axis=1
    )
    x = horner(cubic[:, :, 0], t)[horner(over, t) <= _ON_END]
    if not len(x):
        raise BadInputError(
            "nothing is under water", "in a sectional-area curve", "give more draught"
        )
    return float(x.min()), float(x.max())


# --------------------------------------------------------------------------------------
# Areas of stations: at one floating position, and over the draught (Bonjean curves). Source: E.V.
# Lewis, ed., Principles of Naval Architecture, vol. I, SNAME 1988, ch. I.

_WHERE = "in Bonjean curves"


@attrs.frozen(eq=False)
class Bonjean:
    """Areas of the stations up to level planes, and their moments.

    Attributes
    ----------
    z : (k,), m
        Heights of the planes above base.
    stations : StationAreas
        Below each of them.
    moment : (k, n), m3
        Of these areas about the base line: the integral of z dA.
    """

    z: FloatArray
    stations: StationAreas
    moment: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.z, self.moment)


def sectional_areas(hull: HasState, position: FloatingPosition) -> StationAreas:
    """Give the areas of the stations at a floating position, (1, n).

    Parameters
    ----------
    hull : Hull
        The hull.
    position : FloatingPosition
        Where it floats, moulded.

    Raises
    ------
    OutOfRangeError
        It does not float there.
    """
    body, planes = _afloat(hull, position)
    return body.stations(planes)


def _afloat(hull: HasState, position: FloatingPosition) -> tuple[FloatingBody, FloatingPlanes]:
    """Give what is measured of a hull, and the plane that it floats at."""
    body = body_of(hull)
    return body, require_afloat([position], body.limits, hull.state.particulars.length)


_COURSE = 400
"""So many places are a curve of areas that is drawn."""


def sectional_area_course(hull: HasState, position: FloatingPosition) -> FloatArray | None:
    """Give places (n, 2), m and m2, of the sectional-area curve, from one end to the other.

    It ends at no area: where a transom stands in the water, upright from the area of that. None
    where tunnels are cut out of the hull, whose areas are known at stations.

    Parameters
    ----------
    hull : Hull
        The hull.
    position : FloatingPosition
        Where it floats, moulded.

    Raises
    ------
    OutOfRangeError
        It does not float there.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> from assoc_hull.analysis.hydrostatics.floating_body import FloatingPosition
    >>> from assoc_hull.analysis.hydrostatics.section_areas import sectional_area_course
    >>> course = sectional_area_course(ah.examples.wigley(), FloatingPosition(6.25, 6.25))
    >>> course[[0, -1]].round(6).tolist()
    [[0.0, 0.0], [100.0, 0.0]]
    """
    body, planes = _afloat(hull, position)
    if not isinstance(body, Flotation):
        return None
    curve = area_curve(body, planes)
    # Beside each break, as the curve may jump there.
    near = np.concatenate([curve.breaks - _SAME, curve.breaks + _SAME])
    every = np.linspace(curve.low, curve.high, _COURSE)
    x = np.unique(np.clip(np.concatenate([every, near]), curve.low, curve.high))
    area = curve.at(x)
    known = np.isfinite(area)
    found = np.column_stack([x[known], area[known]])
    freeze(course := np.concatenate([[[curve.low, 0.0]], found, [[curve.high, 0.0]]]))
    return course


def bonjean(hull: HasState, levels: int | ArrayLike = 41) -> Bonjean:
    """Give the Bonjean curves of a hull, from the keel to the deck edge.

    The arguments and what is raised are those of `Hull.bonjean`.
    """
    body = flotation(state_of(hull))
    level = FloatingPlanes(np.zeros(1), np.zeros(1), np.zeros(1))
    low, high = body.limits.mean_draughts(level, hull.state.particulars.length)
    z = _heights(levels, float(low[0]), float(high[0]))
    planes = FloatingPlanes(z.copy(), np.zeros(len(z)), np.zeros(len(z)))
    stations, moment = body.stations_and_moments(planes)
    whole = body_of(hull)
    if isinstance(whole, TunnelledBody):
        area, turned = whole.holes(stations.x, planes)
        stations, moment = attrs.evolve(stations, area=stations.area - area), moment - turned
    return Bonjean(z, stations, moment)


def _heights(levels: int | ArrayLike, low: float, high: float) -> FloatArray:
    """Give the heights that are asked for, (n,), m, or so many from end to end."""
    several = (
        levels.ndim > 0
        if isinstance(levels, np.ndarray)
        else isinstance(levels, list | tuple | range)
    )
    if not several:
        if not isinstance(levels, int | np.integer):
            remedy = "give a whole number of levels, or their heights in m as a list"
            raise WrongTypeError(f"levels is {shown(levels)}", _WHERE, remedy)
        return np.linspace(low, high, integer(levels, "levels", _WHERE, least=2, most=1000))
    z = np.array(numbers(levels, "levels", _WHERE))
    if not len(z) or (np.diff(z) <= 0.0).any():
        raise BadInputError("levels do not rise", _WHERE, "give heights in m, from below")
    for each in (z[0], z[-1]):
        if not low <= each <= high:
            why = "lies outside the hull, or above its open deck"
            raise OutOfRangeError("a level", float(each), _WHERE, why, low, high, "m")
    return z
