"""Arcs and biarcs tried on stretches of curves: how far they leave them.

Distances come without centres, so that radii of any size lose no digits.
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.classical.arc_pieces import Pieces
from assoc_hull.geometry.classical.arc_ratio import biarcs_by_ratio
from assoc_hull.geometry.classical.checks import wrap
from assoc_hull.geometry.curves import FloatArray, IntArray

__all__ = ["Limits", "Trials", "single_arcs", "trials"]

_WIDEST = 1.5
"""rad: an end of a candidate turns no farther from its chord."""
_RATIOS = np.linspace(0.14, 0.86, 7)
_CLOSER = np.linspace(-0.09, 0.09, 6)
"""Parts of the first chord that are tried, and how far around the best of them then."""


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
    places = _places(pieces, piece, low, high, limits.samples)
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
    off = _off_circle(curved, square[:, :, None], left[:, :, None])
    cosine, sine = np.cos(made.tau)[..., None], np.sin(made.tau)[..., None]
    before = cosine * (x[:, None] - made.join[0][..., None]) < sine * (
        made.join[1][..., None] - y[:, None]
    )
    most = np.where(before, off[0], off[1]).max(axis=-1)
    good = np.isfinite(made.bend).all(axis=0) & (np.abs(made.bend).max(axis=0) <= bend)
    return np.asarray(np.where(good, most, np.inf))


def single_arcs(
    pieces: Pieces, piece: IntArray, low: FloatArray, high: FloatArray, angle: FloatArray,
    limits: Limits,
) -> tuple[FloatArray, NDArray[np.bool_]]:  # fmt: skip
    """Lay single arcs through the ends of stretches, (c,), in given directions.

    Parameters
    ----------
    pieces, piece, low, high, limits
        As for `trials`.
    angle : (c,), rad
        Directions at the beginnings.

    Returns
    -------
    (c,), rad
        Directions at the ends.
    (c,) bool
        Which keep the limits.
    """
    places = _places(pieces, piece, low, high, limits.samples)
    step = places[:, -1] - places[:, 0]
    chord, course = np.hypot(step[:, 0], step[:, 1]), np.arctan2(step[:, 1], step[:, 0])
    alpha = wrap(angle - course)
    fits = (np.abs(alpha) < _WIDEST) & (chord > 0.0)
    bend = -2.0 * np.sin(alpha) / np.where(chord > 0.0, chord, 1.0)
    x, y = (places[:, 1:-1, axis] - places[:, :1, axis] for axis in (0, 1))
    left = 2.0 * (np.cos(angle)[:, None] * y - np.sin(angle)[:, None] * x)
    off = _off_circle(bend[:, None], x * x + y * y, left)
    fits &= (off.max(axis=1) <= limits.within) & (np.abs(bend) <= limits.bend)
    return course - alpha, fits


def _places(
    pieces: Pieces, piece: IntArray, low: FloatArray, high: FloatArray, samples: int
) -> FloatArray:
    """Give places along stretches, (c, samples + 2, 2), m; the ends are exact."""
    part = np.linspace(0.0, 1.0, samples + 2)
    w = low[:, None] + (high - low)[:, None] * part
    w[:, -1] = high
    return pieces.at(piece[:, None], w)


def _off_circle(bend: FloatArray, square: FloatArray, left: FloatArray) -> FloatArray:
    """Give the way (m) off circles, by squared way from a point of theirs, twice that to the left.

    As in `Arcs.distance`, on the whole circle.
    """
    across = bend * square - left
    found: FloatArray = np.abs(across) / (1.0 + np.sqrt(np.maximum(1.0 + bend * across, 0.0)))
    return found
