"""Volumes and centres of a hull of sections: exact areas, parabolas along the ship.

Examples
--------
>>> from assoc_hull.creation.classical.prelikon_sums import along_ship
>>> found = along_ship([0.0, 8.0, 16.0, 24.0, 32.0], [120.0, 160.0, 185.0, 190.0, 178.0])
>>> round(found.total, 6), round(found.moment / found.total, 8)
(5514.666667, 16.91295938)
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np
from numpy.typing import ArrayLike
from scipy.integrate import simpson
from scipy.interpolate import PchipInterpolator

from assoc_hull.creation.classical.prelikon_profile import Profile
from assoc_hull.creation.classical.prelikon_stations import AT, Station
from assoc_hull.geometry.classical.checks import finite
from assoc_hull.geometry.classical.deck_surface import Deck
from assoc_hull.geometry.curves import FloatArray

__all__ = ["Along", "Sum", "above_side", "along_ship", "volume_below", "volume_to_deck"]

_ABOVE = 1e6
"""A height (m) above all hulls."""


@attrs.frozen
class Along:
    """An integral along the ship.

    Attributes
    ----------
    total, moment : float
        Integrals of f and of x f.
    error : float
        How far `total` may be off: three times what another interpolation of the same values
        differs by, or half of what every second station gives, if that is more; no bound.
    """

    total: float
    moment: float
    error: float


@attrs.frozen
class Sum:
    """A volume, both sides.

    Attributes
    ----------
    volume : float, m3
        Of it.
    x, z : float, m
        Its centre, from AP or wherever x is counted from, and from the base line.
    error : float, m3
        How far the volume may be off by the rule of integration.
    """

    volume: float
    x: float
    z: float
    error: float


def along_ship(x: ArrayLike, values: ArrayLike) -> Along:
    """Integrate values at stations by parabolas through each three of them.

    With an odd number of stations at equal distances this is Simpson's first rule; where
    distances differ the parabolas are those through unequal steps, and an even number of stations
    has its last interval under the parabola of the last three. Two stations make a trapezium.

    Parameters
    ----------
    x, values : (m,)
        Two stations or more, x increasing.
    """
    at, given = finite(x, "stations", (None,)), finite(values, "stations", (None,))
    total = float(simpson(given, x=at))
    other = float(PchipInterpolator(at, given).integrate(at[0], at[-1]))
    error = 3.0 * abs(total - other)
    if len(at) > 4:
        some = np.append(np.arange(0, len(at) - 1, 2), len(at) - 1)
        error = max(error, 0.5 * abs(total - float(simpson(given[some], x=at[some]))))
    return Along(total, float(simpson(at * given, x=at)), error)


def above_side(station: Station, deck: Deck, level: float = np.inf) -> tuple[float, float]:
    """Give area (m2) and moment (m3, about z = 0) between deck and the level of the deck edge.

    One side; the station is cut off at the deck. Above `level` (m) nothing counts.
    """
    y, z = station.curve.arcs.ends()[-1].tolist()
    if y <= 0.0 or level <= z:
        return 0.0, 0.0
    nodes, weights = np.polynomial.legendre.leggauss(32)
    breaks = deck.camber.y
    scale = y / deck.camber.half_breadth if deck.camber.scale == "local" else 1.0
    inner = breaks[1:-1] * scale
    ends = np.concatenate([[0.0], inner[inner < y], [y]])
    half = 0.5 * np.diff(ends)
    at = (ends[:-1, None] + half[:, None] * (1.0 + nodes)).ravel()
    weight = (half[:, None] * weights).ravel()
    top = np.minimum(deck.at(station.x, at, np.full(len(at), y)), level)
    return float((weight * (top - z)).sum()), float((weight * 0.5 * (top**2 - z**2)).sum())


def volume_below(stations: Sequence[Station], profile: Profile, draught: float) -> Sum:
    """Give what lies below a height (m): exact areas, parabolas along the ship.

    The integral runs between the places where the profile is farthest out below that height; areas
    go to nil there, unless the hull ends flat.
    """
    area, moment = np.array([_below(each, draught) for each in stations]).T
    return _summed(stations, profile, draught, area, moment)


def volume_to_deck(stations: Sequence[Station], profile: Profile, deck: Deck | None) -> Sum:
    """Give all of the hull, the space under the camber included."""
    found = []
    for each in stations:
        area, moment = _below(each, np.inf)
        more, above = (0.0, 0.0) if deck is None else above_side(each, deck)
        found.append((area + more, moment + above))
    area, moment = np.array(found).T
    return _summed(stations, profile, np.inf, area, moment)


def _below(station: Station, level: float) -> tuple[float, float]:
    """Give area and moment of half a section below a level: what is open above is closed there."""
    area, _, moment = station.curve.moments_below(level)
    return area, moment


def _summed(
    stations: Sequence[Station], profile: Profile, draught: float, area: FloatArray,
    moment: FloatArray,
) -> Sum:  # fmt: skip
    x = np.array([each.x for each in stations])
    level = min(draught, _ABOVE)
    after, fore = profile.aftermost(level), profile.foremost(level)
    within = (x > after + AT) & (x < fore - AT)
    ends = [np.abs(x - place) <= AT for place in (after, fore)]
    sides = [np.concatenate([area[at][:1], np.zeros(1)])[0] for at in ends]
    tops = [np.concatenate([moment[at][:1], np.zeros(1)])[0] for at in ends]
    x = np.concatenate([[after], x[within], [fore]])
    area = np.concatenate([sides[:1], area[within], sides[1:]])
    moment = np.concatenate([tops[:1], moment[within], tops[1:]])
    if len(x) < 3 and not area.any():
        return Sum(0.0, float(x.mean()), draught, 0.0)
    volume, height = along_ship(x, 2.0 * area), along_ship(x, 2.0 * moment)
    if volume.total == 0.0:
        return Sum(0.0, float(x.mean()), draught, 0.0)
    return Sum(
        volume.total, volume.moment / volume.total, height.total / volume.total, volume.error
    )
