"""The form of the 207,000 TDW bulk carrier: half-breadths and centre-line profile, as formulas.

The main body is drawn by waterlines, each full over the flat of side and closing towards its
ends as ``(1 - t^p)^q``; where it begins to close depends on the height like the quarter of an
ellipse, which gives the bottom and the bilge their turn. Amidships that leaves the exact
section: flat bottom, a bilge circle, flat side. A lobe is laid on at either end: about the
shaft, where it runs out as the cylinder of the bossing end, and for the bulbous bow.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.optimize import brentq

from assoc_hull.geometry.curves import FloatArray

__all__ = [
    "BILGE", "BOSS", "BREADTH", "DEPTH", "DRAUGHT", "LENGTH", "SHAFT", "TRANSOM", "aft_shoulder",
    "bulb_bottom", "contour_aft", "contour_forward", "fore_shoulder", "half_breadth", "intervals",
    "skeg_bottom",
]  # fmt: skip

LENGTH, BREADTH, DRAUGHT, DEPTH = 300.0, 50.0, 18.0, 27.0
BILGE = 2.4
SHAFT, BOSS = 5.0, 0.725
BOSS_AFT, BOSS_FORE = 6.0, 7.5
TRANSOM = (-5.0, 18.4)
"""x of the transom, and z of its lowest point."""

KEEL_AFT, KEEL_FORE = 14.0, 289.0
NOSE = (306.4, 7.0)


def smooth(s: FloatArray) -> FloatArray:
    """Go from 0 at s = 0 to 1 at s = 1 with nil slope and curvature at both."""
    s = np.clip(s, 0.0, 1.0)
    return np.asarray(s * s * s * (10.0 - 15.0 * s + 6.0 * s * s))


def turn(z: FloatArray, height: float) -> FloatArray:
    """Rise like the quarter of an ellipse: upright at z = 0, level at the height."""
    down = np.clip(1.0 - z / height, 0.0, 1.0)
    return np.asarray(np.sqrt(1.0 - down * down))


def midship(z: FloatArray) -> FloatArray:
    """Give the half-breadth of the midship section."""
    return BREADTH / 2.0 - BILGE + BILGE * turn(z, BILGE)


def invert(
    function: Callable[[FloatArray], FloatArray], low: float, high: float, value: FloatArray
) -> FloatArray:
    """Find where a function that is monotone between two places takes each value."""
    a, b = np.full_like(value, low), np.full_like(value, high)
    sense = float(np.sign(function(np.array(high)) - function(np.array(low))))
    for _ in range(60):
        middle = 0.5 * (a + b)
        below = sense * (function(middle) - value) < 0.0
        a, b = np.where(below, middle, a), np.where(below, b, middle)
    return 0.5 * (a + b)


# The after body.

_OVERHANG = CubicSpline(
    [0.0, 4.0, 8.0, 9.6, 11.2, 13.8, TRANSOM[1], DEPTH],
    [16.0, 11.0, 8.6, 7.7, 6.0, 2.2, TRANSOM[0], -17.0],
)
_LOBE_TOP, _LOBE_LENGTH = 4.6, 3.2


def _lobe_top(x: FloatArray) -> FloatArray:
    """Give how far the lobe of the bossing reaches above the shaft."""
    ahead = np.maximum(x - BOSS_FORE, 0.0)
    return np.asarray(BOSS + _LOBE_TOP * (1.0 - np.exp(-ahead / _LOBE_LENGTH)))


def _lobe_end(z: FloatArray) -> FloatArray:
    """Give where the lobe begins at a height above the cylinder."""
    part = np.clip((z - SHAFT - BOSS) / _LOBE_TOP, 0.0, 0.999)
    return np.asarray(BOSS_FORE - _LOBE_LENGTH * np.log(1.0 - part))


def _corner() -> float:
    """Give the height of the fore corner of the propeller's aperture."""
    return float(brentq(lambda z: _lobe_end(z) - _OVERHANG(z), SHAFT + BOSS, 9.0))


CORNER = _corner()
_CORNER_X = float(_OVERHANG(CORNER))


def skeg_bottom(x: FloatArray) -> FloatArray:
    """Give the height of the contour from the cylinder of the bossing down to the keel."""
    return (SHAFT - BOSS) * (1.0 - smooth((x - BOSS_FORE) / (KEEL_AFT - BOSS_FORE)))


def contour_aft(z: FloatArray) -> FloatArray:
    """Give x of the contour above the bossing, up to the transom."""
    return np.asarray(np.minimum(_lobe_end(z), _OVERHANG(z)))


def aft_shoulder(z: FloatArray) -> FloatArray:
    """Give where each waterline leaves the flat of side, aft."""
    return 115.0 - 64.0 * turn(z, DEPTH)


def _lobe_aft(x: FloatArray, z: FloatArray) -> FloatArray:
    ahead = np.maximum(x, BOSS_FORE)
    past = smooth((ahead - BOSS_FORE) / 3.6)
    below = z < SHAFT
    s = np.where(below, (SHAFT - z) / (SHAFT - skeg_bottom(ahead)), (z - SHAFT) / _lobe_top(x))
    power = np.where(below, 0.5 + 0.5 * past, 0.5 + 1.2 * past)
    away = (ahead - BOSS_FORE) / 12.0
    size = BOSS + 1.2 * (1.0 - 1.0 / (1.0 + away * away))
    size = size * (1.0 - smooth((x - 10.0) / 14.0))
    return np.asarray(size * np.maximum(1.0 - s * s, 0.0) ** power * (x >= BOSS_AFT))


def _aft(x: FloatArray, z: FloatArray) -> FloatArray:
    end, begin, full = _OVERHANG(z), aft_shoulder(z), midship(z)
    t = np.clip((begin - x) / (begin - end), 0.0, 1.0)
    up = smooth((z + 1.0) / 21.0)
    power = 2.0 - 1.25 * up
    main = np.where(x < end, 0.0, full * (1.0 - t ** (2.15 + 0.25 * up)) ** power)
    return np.asarray(main + _lobe_aft(x, z) * (1.0 - main / full))


# The fore body.


_RAKE = (LENGTH - NOSE[0] + 8.8 * (1.0 - (1.0 - (11.0 / 12.0) ** 2) ** 3)) / 121.0


def _contour_upper(z: FloatArray) -> FloatArray:
    up = z - NOSE[1]
    stem = NOSE[0] - 8.8 + _RAKE * up * up
    return np.asarray(stem + 8.8 * np.maximum(1.0 - (up / 12.0) ** 2, 0.0) ** 3)


def _hollow() -> float:
    z = np.linspace(NOSE[1], DRAUGHT, 4001)
    return float(z[np.argmin(_contour_upper(z))])


_ROOT = _hollow()
_ROOT_X = float(_contour_upper(np.array(_ROOT)))


def contour_forward(z: FloatArray) -> FloatArray:
    """Give x of the contour from the nose of the bulb up to the deck."""
    return np.asarray(_contour_upper(z))


def bulb_bottom(x: FloatArray) -> FloatArray:
    """Give the height of the contour from the keel up to the nose of the bulb."""
    s = np.clip((x - KEEL_FORE) / (NOSE[0] - KEEL_FORE), 0.0, 1.0)
    return NOSE[1] * (1.0 - np.sqrt(1.0 - s**2.6))


def _bulb_top(x: FloatArray) -> FloatArray:
    inside = np.clip(x, _ROOT_X, NOSE[0])
    return invert(_contour_upper, NOSE[1], _ROOT, inside)


def fore_shoulder(z: FloatArray) -> FloatArray:
    """Give where each waterline leaves the flat of side, forward."""
    return 205.5 + 46.5 * turn(z, 27.0) ** 1.5


def bottom_end(z: FloatArray) -> FloatArray:
    """Give x of the contour from the keel up to the nose of the bulb."""
    up = np.clip(1.0 - z / NOSE[1], 0.0, 1.0)
    return KEEL_FORE + (NOSE[0] - KEEL_FORE) * (1.0 - up * up) ** (1.0 / 2.6)


def _fore(x: FloatArray, z: FloatArray) -> FloatArray:
    begin = fore_shoulder(z)
    end = np.where(z < NOSE[1], bottom_end(z), _contour_upper(z))
    t = np.clip((x - begin) / (end - begin), 0.0, 1.0)
    up = smooth((z - 3.0) / 16.0)
    return midship(z) * (1.0 - t ** (2.0 + 0.5 * up)) ** (0.85 - 0.09 * up)


def half_breadth(x: FloatArray, z: FloatArray) -> FloatArray:
    """Give the half-breadth (m) at x and z, inside the contour."""
    x, z = np.broadcast_arrays(np.asarray(x, np.float64), np.asarray(z, np.float64))
    return np.where(x < 0.5 * LENGTH, _aft(x, z), _fore(x, z))


def intervals(x: float) -> list[tuple[float, float]]:
    """Give the heights between which the hull reaches at a station, piece by piece (m)."""
    at = np.array(x)
    if x < BOSS_AFT:
        return [(_height(_OVERHANG, CORNER, DEPTH, at), DEPTH)]
    if x < _CORNER_X:
        lobe = float(skeg_bottom(at)), SHAFT + float(_lobe_top(at))
        return [lobe, (_height(_OVERHANG, CORNER, DEPTH, at), DEPTH)]
    if x < 0.5 * LENGTH:
        return [(float(skeg_bottom(at)), DEPTH)]
    low = float(bulb_bottom(at))
    if x < _ROOT_X:
        return [(low, DEPTH)]
    pieces = [(low, float(_bulb_top(at)))] if x < NOSE[0] else []
    if x < float(_contour_upper(np.array(DEPTH))):
        pieces.append((_height(_contour_upper, _ROOT, DEPTH, at), DEPTH))
    return pieces


def _height(
    contour: Callable[[FloatArray], FloatArray], low: float, high: float, x: FloatArray
) -> float:
    return float(invert(contour, low, high, x))
