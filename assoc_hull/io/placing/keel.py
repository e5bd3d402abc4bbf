"""The bottom of a hull on the centre line: its lowest place, its rake, and what hangs below it.

The base line goes by the bottom between .3 and .7 of the waterline's length: domes and bulbs lie
before that stretch, skegs and bossings behind it, and a fin on it is told by its steep ends.
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.io.placing.outline import HullOutline

__all__ = ["Keel", "measure_keel"]

_STRETCH = (0.3, 0.7)
_SAMPLES = 81

_FIN = 0.1
"""What hangs by more than this part of the depth below a bottom on both sides of it is a fin."""

_STEEP = 0.15
"""The ends of a fin rise by more than this; no bottom amidships does."""

_RAKE = 2e-3
"""A keel that rises by less than this part of Lpp is level."""

_STRAIGHT = 0.1
"""A raked keel leaves a straight line by at most this part of its rise; else it is curved."""


@attrs.frozen
class Keel:
    """The bottom of a hull amidships.

    Attributes
    ----------
    low : float, m
        Its lowest height.
    at : float, m
        Where that is.
    rise : float
        Rise forward in m per m of a straight keel; 0 of a level or a curved one.
    fin : float or None, m
        How deep a fin on the stretch hangs below it.
    """

    low: float
    at: float
    rise: float = 0.0
    fin: float | None = None


def measure_keel(outline: HullOutline, aft: float, fore: float) -> Keel:
    """Measure the bottom between .3 and .7 of a waterline from `aft` to `fore`, m."""
    first, last = (aft + part * (fore - aft) for part in _STRETCH)
    x = np.linspace(first, last, _SAMPLES)
    z = outline.bottom(x)
    known = np.isfinite(z)
    if not known.any():
        return _without_contour(outline, first, last)
    x, z = x[known], z[known]
    depth = float(np.ptp(outline.xyz[:, 2]))
    fin = _fins(x, z, depth)
    deepest = float(z.min())
    hull_x, hull_z = _vertices(outline, first, last)
    if fin.any():
        x, z = x[~fin], z[~fin]
    elif len(hull_z):  # ends of segments are lower than what lies between samples
        x, z = np.append(x, hull_x), np.append(z, np.maximum(hull_z, deepest - 0.05 * depth))
    row = int(z.argmin())
    low = float(z[row])
    return Keel(low, float(x[row]), _rise(x, z, fore - aft), low - deepest if fin.any() else None)


def _without_contour(outline: HullOutline, first: float, last: float) -> Keel:
    """Take the lowest point there of a hull that does not reach its centre plane."""
    x = outline.xyz[:, 0]
    on = (first <= x) & (x <= last)
    places = outline.xyz[on] if on.any() else outline.xyz
    row = int(places[:, 2].argmin())
    return Keel(float(places[row, 2]), float(places[row, 0]))


def _vertices(outline: HullOutline, first: float, last: float) -> tuple[FloatArray, FloatArray]:
    """Give the lowest corner of the contour on the stretch, as arrays of one, or of none."""
    corner = outline.centre.reshape(-1, 2)
    on = corner[(first <= corner[:, 0]) & (corner[:, 0] <= last)]
    if not len(on):
        return np.zeros(0), np.zeros(0)
    lowest = on[int(on[:, 1].argmin())]
    return lowest[:1], lowest[1:]


def _fins(x: FloatArray, z: FloatArray, depth: float) -> NDArray[np.bool_]:
    """Mark samples that hang below the bottom before and behind them: of a fin, or a drop keel."""
    ahead = np.maximum.accumulate(z[::-1])[::-1]
    behind = np.maximum.accumulate(z)
    fin = z < np.minimum(ahead, behind) - _FIN * depth
    if not fin.any():
        return fin
    # Its ends go up to the bottom as long as they are steep: the bottom itself is not.
    steep = np.abs(np.diff(z)) > _STEEP * np.diff(x)
    last = len(z) - 1
    for i in range(1, last + 1):
        fin[i] |= fin[i - 1] and steep[i - 1]
    for i in range(last - 1, -1, -1):
        fin[i] |= fin[i + 1] and steep[i]
    dropped = float(np.abs(np.diff(z)).max()) > 0.5 * _FIN * depth
    # A deep belly fills the stretch and drops nowhere at once.
    return fin if dropped and fin.mean() < 0.5 else np.zeros(len(z), np.bool_)


def _rise(x: FloatArray, z: FloatArray, length: float) -> float:
    """Give the rise per length of a keel that is straight and not level."""
    middle = float(x.mean())
    off = x - middle
    slope = float((off * z).sum() / max(float((off * off).sum()), 1e-300))
    left = float(np.abs(z - z.mean() - slope * off).max())
    rise = abs(slope) * length
    straight = left <= _STRAIGHT * abs(slope) * float(np.ptp(x))
    return slope if rise > _RAKE * length and straight else 0.0
