"""The form of the 207,000 TDW bulk carrier: half-breadths and centre-line contour as formulas.

The main body is drawn by waterlines. Each is full along the flat of side and closes towards
an end as ``(1 - t^p)^q``, t running from the shoulder to the end; shoulder, end, p and q are
smooth functions of the height, and full is what the midship section has there. So amidships
the section is exact: flat bottom, a bilge circle, flat side. Forward the ends lie on the stem
with its bulb. Aft they lie on the overhang, and a lobe about the shaft is laid on, which runs
out as the cylinder of the bossing end.

Lengths in metres; x forward from AP, z up from the base line.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike
from scipy.interpolate import CubicSpline

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.numeric.polynomials import brent_root

__all__ = [
    "aft_end",
    "aft_shoulder",
    "carrier_half_breadth",
    "contour_over_bossing",
    "contour_under_bossing",
    "fore_end",
    "fore_shoulder",
    "height_ranges",
    "midship",
    "reaches",
    "side_height",
    "transom_height",
]  # fmt: skip

LENGTH, BREADTH, DRAUGHT, DEPTH = 300.0, 50.0, 18.0, 27.0
BILGE = 2.4
"""Radius of the bilge amidships."""

SHAFT, BOSS = 5.0, 0.725
"""Height of the shaft, and radius of the bossing end."""

BOSS_AFT, BOSS_FORE = 6.0, 7.5
"""Between these x the bossing is a cylinder."""

TRANSOM, TRANSOM_LOW = -5.0, 18.4
"""x of the transom, and its lowest z: dry at the design draught."""

KEEL_AFT, KEEL_FORE = 14.0, 289.0
"""Between these x the contour is the level keel."""

NOSE = 306.4, 7.0
"""x and z of the foremost point of the bulb."""

_Function = Callable[[FloatArray], FloatArray]


def _smooth(s: ArrayLike) -> FloatArray:
    """Go from 0 at s = 0 to 1 at s = 1, slope and curvature nil at both."""
    s = np.clip(s, 0.0, 1.0)
    return np.asarray(s * s * s * (10.0 - 15.0 * s + 6.0 * s * s))


def _turn(z: FloatArray, height: float) -> FloatArray:
    """Rise from 0 to 1 like a quarter of an ellipse: upright at z = 0, level at the height."""
    down = np.clip(1.0 - z / height, 0.0, 1.0)
    return np.asarray(np.sqrt(1.0 - down * down))


def _invert(function: _Function, low: float, high: float, value: float) -> float:
    """Find where a function that is monotone between two places takes a value."""
    return brent_root(lambda at: float(function(np.array(at))) - value, low, high, xtol=1e-13)


def midship(z: ArrayLike) -> FloatArray:
    """Give the half-breadth (m) of the midship section at the heights z (m).

    Examples
    --------
    >>> from assoc_hull.shipped.bulk_carrier_207k_form import midship
    >>> midship([0.0, 2.4, 18.0]).tolist()
    [22.6, 25.0, 25.0]
    """
    return BREADTH / 2.0 - BILGE + BILGE * _turn(np.asarray(z, np.float64), BILGE)


def aft_shoulder(z: ArrayLike) -> FloatArray:
    """Give x (m) where the waterlines at the heights z (m) leave the parallel body, aft."""
    return 115.0 - 64.0 * _turn(np.asarray(z, np.float64), DEPTH)


def fore_shoulder(z: ArrayLike) -> FloatArray:
    """Give x (m) where the waterlines at the heights z (m) leave the parallel body, forward."""
    return 205.5 + 46.5 * _turn(np.asarray(z, np.float64), DEPTH) ** 1.5


def side_height(x: float) -> float | None:
    """Give the height (m) at which the station at x (m) comes onto the flat of side, if it does.

    Examples
    --------
    >>> from assoc_hull.shipped.bulk_carrier_207k_form import side_height
    >>> side_height(150.0), side_height(285.0)
    (2.4, None)
    """
    for shoulder, sense in ((aft_shoulder, 1.0), (fore_shoulder, -1.0)):
        low, high = float(shoulder(BILGE)), float(shoulder(DEPTH))
        if sense * (x - high) <= 0.0:
            return None
        if sense * (x - low) < 0.0:
            return _invert(shoulder, BILGE, DEPTH, x)
    return BILGE


# The after body: overhang, skeg, and the lobe about the shaft.

_OVERHANG = CubicSpline(
    [0.0, 4.0, 8.0, 9.6, 11.2, 13.8, TRANSOM_LOW, DEPTH],
    [16.0, 11.0, 8.6, 7.7, 6.0, 2.2, TRANSOM, -17.0],
)
"""x where the main body ends. Below the corner of the propeller's aperture it ends inside the
lobe, above the transom's lowest point abaft the transom."""

_LOBE_HEIGHT, _LOBE_LENGTH = 4.6, 3.2


def contour_under_bossing(x: ArrayLike) -> FloatArray:
    """Give z (m) of the contour from the cylinder's lower side down to the keel.

    Examples
    --------
    >>> from assoc_hull.shipped.bulk_carrier_207k_form import contour_under_bossing
    >>> contour_under_bossing([6.0, 7.5, 14.0, 150.0]).tolist()
    [4.275, 4.275, 0.0, 0.0]
    """
    part = (np.asarray(x, np.float64) - BOSS_FORE) / (KEEL_AFT - BOSS_FORE)
    return (SHAFT - BOSS) * (1.0 - _smooth(part))


def _lobe_top(x: FloatArray) -> FloatArray:
    """Give how far the lobe reaches above the shaft."""
    ahead = np.maximum(x - BOSS_FORE, 0.0)
    return np.asarray(BOSS + _LOBE_HEIGHT * (1.0 - np.exp(-ahead / _LOBE_LENGTH)))


def _lobe_end(z: FloatArray) -> FloatArray:
    """Give where the lobe ends above the cylinder."""
    part = np.clip((z - SHAFT - BOSS) / _LOBE_HEIGHT, 0.0, 0.999)
    return np.asarray(BOSS_FORE - _LOBE_LENGTH * np.log(1.0 - part))


CORNER = _invert(lambda z: _lobe_end(z) - _OVERHANG(z), SHAFT + BOSS, 9.0, 0.0)
"""Height of the fore corner of the propeller's aperture, where lobe and overhang meet."""

_CORNER_X = float(_OVERHANG(CORNER))


def contour_over_bossing(z: ArrayLike) -> FloatArray:
    """Give x (m) of the contour from the cylinder's upper side up to the transom.

    Examples
    --------
    >>> from assoc_hull.shipped.bulk_carrier_207k_form import contour_over_bossing
    >>> contour_over_bossing([5.725, 18.4]).round(6).tolist()
    [7.5, -5.0]
    """
    z = np.asarray(z, np.float64)
    return np.asarray(np.minimum(_lobe_end(z), _OVERHANG(z)))


def _lobe(x: FloatArray, z: FloatArray) -> FloatArray:
    """Give the half-breadth of the lobe.

    A circle along the cylinder; forward of it taller, slacker at its ends, and faded out.
    """
    ahead = np.maximum(x, BOSS_FORE)
    past = _smooth((ahead - BOSS_FORE) / 3.6)
    below = z < SHAFT
    depth = SHAFT - contour_under_bossing(ahead)
    s = np.where(below, (SHAFT - z) / depth, (z - SHAFT) / _lobe_top(x))
    power = np.where(below, 0.5 + 0.5 * past, 0.5 + 1.2 * past)
    away = (ahead - BOSS_FORE) / 12.0
    size = BOSS + 1.2 * (1.0 - 1.0 / (1.0 + away * away))
    size = size * (1.0 - _smooth((x - 10.0) / 14.0)) * (x >= BOSS_AFT)
    return np.asarray(size * np.maximum(1.0 - s * s, 0.0) ** power)


def _aft(x: FloatArray, z: FloatArray) -> FloatArray:
    end, shoulder, full = _OVERHANG(z), aft_shoulder(z), midship(z)
    t = np.clip((shoulder - x) / (shoulder - end), 0.0, 1.0)
    up = _smooth((z + 1.0) / 21.0)
    main = full * (1.0 - t ** (2.15 + 0.25 * up)) ** (2.0 - 1.25 * up)
    return np.asarray(main + _lobe(x, z) * (1.0 - main / full))


# The fore body: stem and bulb.

_BULB, _BULB_TOP = 8.8, 12.0
_RAKE = (LENGTH - NOSE[0] + _BULB * (1.0 - (1.0 - (11.0 / _BULB_TOP) ** 2) ** 3)) / 121.0
"""Such that the design waterline ends at the fore perpendicular, 11 m above the nose."""


def _under_nose(z: FloatArray) -> FloatArray:
    down = np.clip(1.0 - z / NOSE[1], 0.0, 1.0)
    return np.asarray(KEEL_FORE + (NOSE[0] - KEEL_FORE) * (1.0 - down * down) ** (1.0 / 2.6))


def _over_nose(z: FloatArray) -> FloatArray:
    up = z - NOSE[1]
    bulb = _BULB * np.maximum(1.0 - (up / _BULB_TOP) ** 2, 0.0) ** 3
    return np.asarray(NOSE[0] - _BULB + _RAKE * up * up + bulb)


def fore_end(z: ArrayLike) -> FloatArray:
    """Give x (m) of the contour forward at the heights z (m), from the keel to the deck.

    Examples
    --------
    >>> from assoc_hull.shipped.bulk_carrier_207k_form import fore_end
    >>> fore_end([0.0, 7.0, 18.0]).round(6).tolist()
    [289.0, 306.4, 300.0]
    """
    z = np.asarray(z, np.float64)
    return np.where(z < NOSE[1], _under_nose(z), _over_nose(z))


def _root() -> float:
    """Give the height at which the contour is hollowest above the bulb."""
    z = np.linspace(NOSE[1], DEPTH, 4001)
    return float(z[np.argmin(_over_nose(z))])


_ROOT = _root()
_ROOT_X = float(_over_nose(np.array(_ROOT)))


def _fore(x: FloatArray, z: FloatArray) -> FloatArray:
    end, shoulder = fore_end(z), fore_shoulder(z)
    t = np.clip((x - shoulder) / (end - shoulder), 0.0, 1.0)
    up = _smooth((z - 3.0) / 16.0)
    return np.asarray(midship(z) * (1.0 - t ** (2.0 + 0.5 * up)) ** (0.85 - 0.09 * up))


# The whole.


def carrier_half_breadth(x: ArrayLike, z: ArrayLike) -> FloatArray:
    """Give the half-breadth (m) at x and z (m), inside the contour.

    Examples
    --------
    >>> from assoc_hull.shipped.bulk_carrier_207k_form import carrier_half_breadth
    >>> carrier_half_breadth([7.0, 150.0, 150.0], [5.0, 0.0, 18.0]).tolist()
    [0.725, 22.6, 25.0]
    """
    x, z = np.broadcast_arrays(np.asarray(x, np.float64), np.asarray(z, np.float64))
    return np.where(x < LENGTH / 2.0, _aft(x, z), _fore(x, z))


def aft_end(z: float) -> tuple[float, float]:
    """Give x and y (m) of the after end of the waterline at the height z (m).

    On the contour, on the circle of the bossing end, or on the edge of the transom.

    Examples
    --------
    >>> from assoc_hull.shipped.bulk_carrier_207k_form import aft_end
    >>> aft_end(5.0), aft_end(20.0)[0]
    ((6.0, 0.725), -5.0)
    """
    if z < SHAFT - BOSS:
        return _invert(contour_under_bossing, BOSS_FORE, KEEL_AFT, z), 0.0
    if z <= SHAFT + BOSS:
        return BOSS_AFT, float(np.sqrt(BOSS * BOSS - (z - SHAFT) ** 2))
    if z < TRANSOM_LOW:
        return float(contour_over_bossing(z)), 0.0
    return TRANSOM, float(carrier_half_breadth(TRANSOM, z))


def transom_height(y: float) -> float:
    """Give z (m) of the transom's edge at the half-breadth y (m).

    Examples
    --------
    >>> from assoc_hull.shipped.bulk_carrier_207k_form import transom_height
    >>> 18.4 < transom_height(0.5) < transom_height(1.0) < 27.0
    True
    """
    return _invert(lambda z: carrier_half_breadth(TRANSOM, z), TRANSOM_LOW, DEPTH, y)


def reaches(y: float, z: float, *, aft: bool) -> float:
    """Give x (m) where the waterline at the height z (m) has the half-breadth y (m).

    Examples
    --------
    >>> from assoc_hull.shipped.bulk_carrier_207k_form import reaches
    >>> 0.0 < reaches(1.0, 16.5, aft=False) - reaches(2.0, 16.5, aft=False) < 1.0
    True
    """
    end = aft_end(z)[0] if aft else float(fore_end(z))
    within = LENGTH / 2.0 - 1.0 if aft else LENGTH / 2.0
    return _invert(lambda x: carrier_half_breadth(x, z), end, within, y)


def height_ranges(x: float) -> list[tuple[float, float]]:
    """Give the heights (m) between which the hull reaches at x (m), a pair for each piece.

    Examples
    --------
    >>> from assoc_hull.shipped.bulk_carrier_207k_form import height_ranges
    >>> height_ranges(7.5)[0], height_ranges(150.0)
    ((4.275, 5.725), [(0.0, 27.0)])
    """
    if x < _CORNER_X:
        over = _invert(_OVERHANG, CORNER, DEPTH, x), DEPTH
        if x < BOSS_AFT:
            return [over]
        return [(float(contour_under_bossing(x)), SHAFT + float(_lobe_top(np.array(x)))), over]
    low = float(contour_under_bossing(x))
    if x > KEEL_FORE:
        low = _invert(_under_nose, 0.0, NOSE[1], min(x, NOSE[0]))
    if x < _ROOT_X:
        return [(low, DEPTH)]
    found = [(low, _invert(_over_nose, NOSE[1], _ROOT, x))] if x < NOSE[0] else []
    if x < float(fore_end(DEPTH)):
        found.append((_invert(_over_nose, _ROOT, DEPTH, x), DEPTH))
    return found
