"""Where floating planes cut tiles.

Over planes of one inclination the height of a tile, ``q = z - tan_trim x + tan_heel y``, is
one cubic; a plane is a level of q. The level at which a tile ends is, to the last bit, the
one at which the next tile of the curve begins: so two neighbours never disagree whether the
point they share is wet, and a plane through a row of them is counted once. A point *on* the
plane is wet: every integral is the limit for a level that comes down from above.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.bernstein import stationary, value
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.immersion_tiles import Tiles
from assoc_hull.geometry.roots import bracketed_roots
from assoc_hull.geometry.tile_sums import is_plain, real

__all__ = ["Cuts", "Tilted", "candidates", "cuts", "tilt"]


@attrs.frozen(eq=False)
class Tilted:
    """Heights of tiles over the planes of one inclination.

    Attributes
    ----------
    trim, heel : (1,)
        Tangents of the inclination.
    height : (4, s), m
        Power coefficients of q.
    control : (4, s), m
        Bernstein coefficients of q as plain numbers; the last is the first of the next tile.
    low, high : (s,), m
        Least and greatest of these.
    """

    trim: FloatArray
    heel: FloatArray
    height: FloatArray
    control: FloatArray
    low: FloatArray
    high: FloatArray


@attrs.frozen(eq=False)
class Cuts:
    """Points at which a tile passes from one side of a plane to the other.

    Attributes
    ----------
    pair : (k,) int
        Of the pairs of a tile and a level that were asked.
    u : (k,)
        Where on the tile.
    sign : (k,)
        1 where the tile leaves the water with growing u, -1 where it goes in.
    """

    pair: IntArray
    u: FloatArray
    sign: FloatArray


def tilt(tiles: Tiles, trim: FloatArray, heel: FloatArray) -> Tilted:
    """Measure tiles over the planes of an inclination.

    Parameters
    ----------
    tiles : Tiles
        The tiles.
    trim, heel : (1,)
        Tangents of the inclination.

    Returns
    -------
    Tilted
        Their heights.
    """
    x, y, z = tiles.coefficients[:3]
    height = z
    if real(trim)[0] != 0.0 or not is_plain(trim):
        height = height - trim * x
    if real(heel)[0] != 0.0 or not is_plain(heel):
        height = height + heel * y
    first, second, third, fourth = real(height)
    control = np.empty((4, len(first)))
    control[0] = first
    np.add(first, second / 3.0, out=control[1])
    np.add(control[1], (second + third) / 3.0, out=control[2])
    control[3, :-1] = first[1:]
    last = tiles.start[1:] - 1
    control[3, last] = first[last] + second[last] + third[last] + fourth[last]
    low = np.minimum(np.minimum(control[0], control[1]), np.minimum(control[2], control[3]))
    high = np.maximum(np.maximum(control[0], control[1]), np.maximum(control[2], control[3]))
    return Tilted(trim, heel, height, control, low, high)


def candidates(tilted: Tilted, levels: FloatArray) -> tuple[IntArray, IntArray]:
    """Find pairs of a tile and a level that may meet.

    Parameters
    ----------
    tilted : Tilted
        The tiles.
    levels : (d,), m
        Ascending.

    Returns
    -------
    (p,) int, (p,) int
        Tiles and levels.
    """
    if len(levels) == 1:
        tile = np.flatnonzero((tilted.low <= levels[0]) & (tilted.high > levels[0]))
        return tile, np.zeros(len(tile), np.int64)
    first = np.searchsorted(levels, tilted.low)
    count = np.searchsorted(levels, tilted.high) - first
    tile = np.repeat(np.arange(len(count)), count)
    before = np.cumsum(count) - count
    return tile, np.arange(len(tile)) + (first - before)[tile]


def cuts(tilted: Tilted, tile: IntArray, level: FloatArray) -> Cuts:
    """Cut tiles at levels.

    Parameters
    ----------
    tilted : Tilted
        The tiles.
    tile : (p,) int
        Which tile,
    level : (p,), m
        and where; any arithmetic.

    Returns
    -------
    Cuts
        Every change of sign, each in the arithmetic of the heights.
    """
    ground = real(level)
    control = np.take(tilted.control, tile, axis=1) - ground
    cubic = np.take(real(tilted.height), tile, axis=1)
    cubic[0] -= ground
    step = control[1:] - control[:-1]
    plain = (step >= 0.0).all(axis=0) | (step <= 0.0).all(axis=0)
    wet = control[0] <= 0.0
    through = np.flatnonzero(plain & (wet != (control[3] <= 0.0)))
    ends = np.zeros(len(through)), np.ones(len(through)), control[0][through], control[3][through]
    brackets: tuple[FloatArray, ...] = ends
    pair = through
    rest = np.flatnonzero(~plain)
    if len(rest):
        row, *others = _split(cubic[:, rest], control[0, rest], control[3, rest])
        pair = np.concatenate([pair, rest[row]])
        brackets = tuple(np.concatenate(both) for both in zip(brackets, others, strict=True))
    low, high, at_low, at_high = brackets
    u = bracketed_roots(cubic[:, pair], low, high, at_low, at_high)
    sign = np.where(at_low <= 0.0, 1.0, -1.0)
    return Cuts(pair, _polished(tilted, tile[pair], level[pair], u), sign)


def _split(
    cubic: FloatArray, begin: FloatArray, end: FloatArray
) -> tuple[IntArray, FloatArray, FloatArray, FloatArray, FloatArray]:
    """Give all brackets with one root: row, both parameters, both values."""
    origin, first, second, third = cubic
    lower, upper = stationary(first, second, third)
    at_lower = np.where(lower > 0.0, value(origin, first, second, third, lower), begin)
    at_upper = np.where(upper < 1.0, value(origin, first, second, third, upper), end)
    edge = np.stack([0.0 * lower, lower, upper, 0.0 * lower + 1.0])
    height = np.stack([begin, at_lower, at_upper, end])
    wet = height <= 0.0
    row, part = np.nonzero((wet[1:] != wet[:-1]).T)
    return row, edge[part, row], edge[part + 1, row], height[part, row], height[part + 1, row]


def _polished(tilted: Tilted, tile: IntArray, level: FloatArray, u: FloatArray) -> FloatArray:
    """Carry derivatives through roots that were found among plain numbers."""
    height = tilted.height
    if is_plain(height) and is_plain(level):
        return u
    first, second, third, fourth = np.take(height, tile, axis=1)
    above = value(first - level, second, third, fourth, u)
    slope = second + u * (2.0 * third + u * (3.0 * fourth))
    # What is left of the residual is rounding: only its derivative is wanted.
    steep = np.abs(real(slope)) > 0.0
    change = (above - real(above)) / np.where(steep, slope, 1.0)
    return u - np.where(steep, change, 0.0)
