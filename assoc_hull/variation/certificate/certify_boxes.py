"""The fold check by intervals: for fields whose boundaries run across one another.

Minors are enclosed on boxes of the profile plane. A box on which one may be below the margin is
parted in four.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.numeric.intervals import Interval, minus, plus, times
from assoc_hull.variation.certificate.certify_breadth import breadth_minor, psi_bounds
from assoc_hull.variation.certificate.certify_layer import plane_minor
from assoc_hull.variation.certificate.field_enclosures import enclose
from assoc_hull.variation.certificate.minor_search import Found, Minor
from assoc_hull.variation.fields.field import Field
from assoc_hull.variation.fields.fields_layer import Rake

__all__ = ["box_breadth", "box_minor", "search_boxes"]

_DEPTH = 14
_MOST = 400_000
"""So many boxes, before a map counts as undecided."""

_REFUSED = 20_000
_SHARP = 1e-3
"""What is refused is looked at in so many boxes, to find its least value to so much."""

_ZOOMS = 18
_CLOSER = 0.4
_SAMPLES = {1: 5, 2: 5, 3: 3}
"""A side of a box, by how many sides boxes have: what they miss, halving them finds."""

_Lows = Callable[[FloatArray, FloatArray], FloatArray]
_Values = Callable[[FloatArray], FloatArray]
_Fields = Sequence[Field | Rake]


def search_boxes(
    lows: _Lows, values: _Values, box: tuple[FloatArray, FloatArray], enough: float
) -> tuple[float, float, FloatArray, int, int]:
    """Decide whether a function reaches a margin on boxes.

    Parameters
    ----------
    lows : callable
        Lower bounds on boxes (m, k), (m, k).
    values : callable
        Values at places (m, k).
    box : two (m, k)
        The boxes.
    enough : float
        The margin.

    Returns
    -------
    least, bound : float
        Least value met; lower bound, exact only as far as it decides.
    place : (k,)
        Where the least was met.
    boxes, splits : int
    """
    lower, upper = box
    bound, count, splits = np.inf, 0, 0
    least, where = _first(values, lower, upper)
    for depth in range(_DEPTH + 1):
        count += len(lower)
        low, centre = lows(lower, upper), 0.5 * (lower + upper)
        met = values(centre)
        if met.min() < least:
            best = int(met.argmin())
            least, where = _lowest(values, centre[best], lower[best], upper[best])
        open_ = low < (enough if least >= enough else least - _SHARP)
        bound = min(bound, float(low[~open_].min(initial=np.inf)))
        most = _MOST if least >= enough else _REFUSED
        stop = least <= 0.0 or depth == _DEPTH or count + 4 * int(open_.sum()) > most
        if not open_.any() or stop:
            bound = min(bound, float(low.min()))
            break
        splits += int(open_.sum())
        lower, upper = _quartered(lower[open_], upper[open_])
    return least, bound, where, count, splits


def _first(values: _Values, lower: FloatArray, upper: FloatArray) -> tuple[float, FloatArray]:
    """Find a low value on a grid in each of some boxes."""
    k = lower.shape[1]
    grid = (np.array(list(np.ndindex(*(_SAMPLES[k],) * k))) + 0.5) / _SAMPLES[k]
    places = lower[:, None, :] + grid[None, :, :] * (upper - lower)[:, None, :]
    met = values(places.reshape(-1, k))
    box, place = divmod(int(met.argmin()), len(grid))
    return _lowest(values, places[box, place], lower[box], upper[box])


def _lowest(
    values: _Values, start: FloatArray, lower: FloatArray, upper: FloatArray
) -> tuple[float, FloatArray]:
    """Find the least value near a place, zooming in on the least of a grid."""
    k = len(start)
    grid = np.array(list(np.ndindex(*(7,) * k))) / 6.0 - 0.5
    where, reach = start, upper - lower
    least = float(values(start[None, :])[0])
    for _ in range(_ZOOMS):
        places = np.clip(where + grid * reach, lower, upper)
        met = values(places)
        if met.min() < least:
            least, where = float(met.min()), places[int(met.argmin())]
        reach = _CLOSER * reach
    return least, where


def _quartered(lower: FloatArray, upper: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Halve boxes across every one of their sides."""
    middle = 0.5 * (lower + upper)
    parts = [
        (np.where(bits, middle, lower), np.where(bits, upper, middle))
        for bits in np.ndindex(*(2,) * lower.shape[1])
    ]
    return np.concatenate([each[0] for each in parts]), np.concatenate([each[1] for each in parts])


def box_minor(name: str, along: _Fields, up: _Fields, box: FloatArray, enough: float) -> Found:
    """Decide whether X_x, Z_z or D of fields that move x and z reaches a margin."""

    def lows(lower: FloatArray, upper: FloatArray) -> FloatArray:
        return _enclose_plane(along, up, lower, upper)[0]

    minor = plane_minor(name, along, up, box)
    return _decide(minor, lows, enough)


def box_breadth(fields: _Fields, box: FloatArray, enough: float) -> Found:
    """Decide whether Y_y of y-fields reaches a margin."""

    def lows(lower: FloatArray, upper: FloatArray) -> FloatArray:
        total = _ones(len(lower))
        for field in fields:
            own = enclose(field, lower[:, :2], upper[:, :2]).own
            psi = psi_bounds(field, lower[:, 2], upper[:, 2])
            total = plus(total, times(own, psi))
        return total[0]

    return _decide(breadth_minor(fields, box), lows, enough)


def _decide(minor: Minor, lows: _Lows, enough: float) -> Found:
    least, bound, where, boxes, splits = search_boxes(
        lows, minor.at, (minor.lower, minor.upper), enough
    )
    x, y, z = minor.place(where[None, :])[0].tolist()
    return Found(minor.name, least, bound, (x, y, z), boxes, splits)


def _enclose_plane(along: _Fields, up: _Fields, lower: FloatArray, upper: FloatArray) -> Interval:
    """Enclose X_x Z_z - X_z Z_x; X_x or Z_z if only one of both moves."""
    x_x, x_z = _derivatives(along, lower, upper)
    z_x, z_z = _derivatives(up, lower, upper)
    one = _ones(len(lower))
    if not up or not along:
        return plus(one, x_x if along else z_z)
    return minus(times(plus(one, x_x), plus(one, z_z)), times(x_z, z_x))


def _derivatives(
    fields: _Fields, lower: FloatArray, upper: FloatArray
) -> tuple[Interval, Interval]:
    nil = np.zeros(len(lower))
    by_x, by_z = (nil, nil), (nil, nil)
    for field in fields:
        found = enclose(field, lower, upper)
        by_x, by_z = plus(by_x, found.along), plus(by_z, found.up)
    return by_x, by_z


def _ones(count: int) -> Interval:
    return np.ones(count), np.ones(count)
