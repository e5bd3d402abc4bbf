"""How far one biarc reaches along a curve: the best ratio of a candidate, and the search.

Many pieces are searched at once, each with several candidates a round: first ends around the reach
of the biarc before, then ends between the farthest that will do and the next that will not.
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.classical.arc_pieces import Pieces
from assoc_hull.geometry.classical.arc_ratio import biarcs_by_ratio
from assoc_hull.geometry.classical.checks import wrap
from assoc_hull.geometry.curves import FloatArray, IntArray

__all__ = ["Limits", "Trials", "trials"]

_WIDEST = 1.5
"""rad: an end of a candidate turns no farther from its chord."""
_RATIOS = np.linspace(0.14, 0.86, 7)
_CLOSER = np.linspace(-0.09, 0.09, 6)
"""Parts of the first chord that are tried, and how far around the best of them then."""
_FIRST = np.array([0.3, 0.55, 0.8, 1.0, 1.25, 1.8])
"""First ends that are tried, as multiples of the reach before."""
_ENDS = 6
_CLOSE = 0.01
"""The search ends when what is open is this part of the reach."""
_ROUNDS = 24


@attrs.frozen
class Limits:
    """What arcs have to keep.

    Attributes
    ----------
    within : float, m
        How far they may leave the curve.
    bend : float, 1/m
        Greatest curvature, infinite if any will do.
    samples : int
        Places along a candidate at which it is measured.
    """

    within: float
    bend: float
    samples: int


@attrs.frozen(eq=False)
class Trials:
    """Candidates: one biarc each.

    Attributes
    ----------
    ratio : (c,)
        The part that the chord of the first arc has, for the least deviation.
    off : (c,), m
        The deviation; infinite where no biarc keeps the limits.
    """

    ratio: FloatArray
    off: FloatArray


def trials(
    pieces: Pieces, piece: IntArray, low: FloatArray, high: FloatArray, angle: FloatArray,
    limits: Limits,
) -> Trials:  # fmt: skip
    """Find for stretches of curves, (c,), the biarcs that leave them least.

    Parameters
    ----------
    pieces : Pieces
        The curves.
    piece : (c,) int
        The piece of each stretch.
    low, high : (c,)
        Its parameters.
    limits : Limits
        Curvature and samples.
    """
    part = np.linspace(0.0, 1.0, limits.samples + 2)
    w = low[:, None] + (high - low)[:, None] * part
    w[:, -1] = high
    places = pieces.at(piece[:, None], w)
    begin = places[:, 0]
    step = places[:, -1] - begin
    chord, way = np.hypot(step[:, 0], step[:, 1]), np.arctan2(step[:, 1], step[:, 0])
    alpha, beta = wrap(angle - way), wrap(pieces.direction(piece, high) - way)
    ok = (np.abs(alpha) < _WIDEST) & (np.abs(beta) < _WIDEST) & (chord > 0.0)
    off, ratio = np.full(len(piece), np.inf), np.full(len(piece), 0.5)
    if ok.any():
        away = places[ok, 1:-1] - begin[ok, None]
        cosine, sine = np.cos(way[ok])[:, None], np.sin(way[ok])[:, None]
        x = cosine * away[..., 0] + sine * away[..., 1]
        y = cosine * away[..., 1] - sine * away[..., 0]
        ratio[ok], off[ok] = _best(x, y, chord[ok], alpha[ok], beta[ok], limits.bend)
    return Trials(ratio, off)


def _best(
    x: FloatArray, y: FloatArray, chord: FloatArray, alpha: FloatArray, beta: FloatArray,
    bend: float,
) -> tuple[FloatArray, FloatArray]:  # fmt: skip
    """Give ratio and deviation (m) of the best of many biarcs to each row of places."""
    cosines, sines = (np.stack([f(alpha), f(beta)])[:, :, None] for f in (np.cos, np.sin))
    ahead = np.stack([x, x - chord[:, None]])
    # Of the two circles, in axes of the tangents at the ends: twice the way left, the square.
    left = 2.0 * (cosines * y - sines * ahead)
    square = ahead * ahead + y * y
    seen = x, y, left, square
    row = np.arange(len(chord))
    ratio = np.broadcast_to(_RATIOS, (len(chord), len(_RATIOS)))
    off = _off(seen, chord, alpha, beta, ratio, bend)
    best = np.argmin(off, axis=1)
    found, least = ratio[row, best], off[row, best]
    closer = found[:, None] + _CLOSER
    off = _off(seen, chord, alpha, beta, closer, bend)
    best = np.argmin(off, axis=1)
    better = off[row, best] < least
    return (
        np.where(better, closer[row, best], found),
        np.where(better, off[row, best], least),
    )


def _off(
    seen: tuple[FloatArray, ...], chord: FloatArray, alpha: FloatArray, beta: FloatArray,
    ratio: FloatArray, bend: float,
) -> FloatArray:  # fmt: skip
    """Give the largest distance (m) of places from biarcs, (c, r)."""
    x, y, left, square = seen
    made = biarcs_by_ratio(chord[:, None], alpha[:, None], beta[:, None], ratio)
    curved = made.bend[..., None]
    across = curved * square[:, :, None] - left[:, :, None]
    # The way off a circle without its centre, as in `Arcs.distance`.
    off = np.abs(across) / (1.0 + np.sqrt(np.maximum(1.0 + curved * across, 0.0)))
    cosine, sine = np.cos(made.tau)[..., None], np.sin(made.tau)[..., None]
    before = cosine * (x[:, None] - made.join[0][..., None]) < sine * (
        made.join[1][..., None] - y[:, None]
    )
    most = np.where(before, off[0], off[1]).max(axis=-1)
    good = np.isfinite(made.bend).all(axis=0) & (np.abs(made.bend).max(axis=0) <= bend)
    return np.asarray(np.where(good, most, np.inf))
