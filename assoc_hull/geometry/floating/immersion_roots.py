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
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.floating.tiles import Tiles
from assoc_hull.geometry.numeric.dual import is_plain, real
from assoc_hull.geometry.numeric.roots import bracketed_roots
from assoc_hull.geometry.splines.bernstein import stationary, value

__all__ = ["Cuts", "Tilted", "brackets", "candidates", "cuts", "tilt", "turns"]

_LEAST = 1e-8
"""Cuts with derivatives are kept so far from the beginning of a tile: the area of the part up to
them is the root of a square, which at nil has no derivative, though the area has one."""


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
    wavy : (s,) bool
        By these the tile may run up and down.
    """

    trim: FloatArray
    heel: FloatArray
    height: FloatArray
    control: FloatArray
    low: FloatArray
    high: FloatArray
    wavy: NDArray[np.bool_]

    @property
    def heeled(self) -> bool:
        """There is heel, or a derivative by it is wanted."""
        return not is_plain(self.heel) or bool(self.heel[0] != 0.0)


@attrs.frozen(eq=False)
class Changes:
    """Parts of tiles with one change of sign each, all (k,).

    Attributes
    ----------
    pair : int
        Of the pairs of a tile and a level that were asked.
    low, high : from 0 to 1
        Ends of the part on the tile.
    at_low, at_high : m
        Heights over the level there; one is positive, the other is not.
    """

    pair: IntArray
    low: FloatArray
    high: FloatArray
    at_low: FloatArray
    at_high: FloatArray


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
    one, two, three = control[1:] - control[:-1]
    falls, rises = (
        (one < 0.0) | (two < 0.0) | (three < 0.0),
        (one > 0.0) | (two > 0.0) | (three > 0.0),
    )
    return Tilted(trim, heel, height, control, low, high, falls & rises)


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


def turns(tilted: Tilted, tile: IntArray) -> tuple[FloatArray, FloatArray]:
    """Say where tiles may have their least or greatest height inside.

    Parameters
    ----------
    tilted : Tilted
        The tiles.
    tile : (p,) int
        Which.

    Returns
    -------
    lower, upper : (p,)
        As in `stationary`: 0 and 1 stand for nowhere.
    """
    _, first, second, third = np.take(real(tilted.height), tile, axis=1)
    return stationary(first, second, third)


def brackets(tilted: Tilted, tile: IntArray, level: FloatArray) -> Changes:
    """Bracket all changes of sign.

    Parameters
    ----------
    tilted : Tilted
        The tiles.
    tile : (p,) int
        Which tile,
    level : (p,), m
        and where; plain.

    Returns
    -------
    Changes
        The brackets, in each of which a tile runs up or down only.
    """
    control = np.take(tilted.control, tile, axis=1) - level
    wave = tilted.wavy[tile]
    through = np.flatnonzero(~wave & ((control[0] <= 0.0) != (control[3] <= 0.0)))
    none = np.zeros(len(through))
    plain = Changes(through, none, none + 1.0, control[0][through], control[3][through])
    rest = np.flatnonzero(wave)
    if not len(rest):
        return plain
    split = _split(tilted, tile[rest], level[rest], control[:, rest])
    others = (rest[split.pair], split.low, split.high, split.at_low, split.at_high)
    both = zip(attrs.astuple(plain, recurse=False), others, strict=True)
    return Changes(*(np.concatenate(each) for each in both))


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
        Every change of sign, in the arithmetic of the heights.
    """
    found = brackets(tilted, tile, real(level))
    tile, level = tile[found.pair], np.take(level, found.pair)
    cubic = np.take(real(tilted.height), tile, axis=1)
    cubic[0] -= real(level)
    start = _parabola(cubic, found)
    u = bracketed_roots(cubic, found.low, found.high, found.at_low, found.at_high, start)
    sign = np.where(found.at_low <= 0.0, 1.0, -1.0)
    return Cuts(found.pair, _polished(tilted, tile, level, u), sign)


def _split(tilted: Tilted, tile: IntArray, level: FloatArray, control: FloatArray) -> Changes:
    """Bracket changes of sign between the turns of tiles."""
    origin, first, second, third = np.take(real(tilted.height), tile, axis=1)
    lower, upper = stationary(first, second, third)
    below = origin - level
    at_lower = np.where(lower > 0.0, value(below, first, second, third, lower), control[0])
    at_upper = np.where(upper < 1.0, value(below, first, second, third, upper), control[3])
    edge = np.stack([0.0 * lower, lower, upper, 0.0 * lower + 1.0])
    height = np.stack([control[0], at_lower, at_upper, control[3]])
    wet = height <= 0.0
    pair, part = np.nonzero((wet[1:] != wet[:-1]).T)
    return Changes(
        pair, edge[part, pair], edge[part + 1, pair], height[part, pair], height[part + 1, pair]
    )


def _parabola(cubic: FloatArray, found: Changes) -> FloatArray:
    """Start at the root of the parabola through both ends and the middle.

    Tiles that begin level, as most do at the keel, have nearly parabolas for heights: from a
    chord the steps would take long.
    """
    origin, first, second, third = cubic
    length = found.high - found.low
    middle = value(origin, first, second, third, found.low + 0.5 * length)
    rise = found.at_high - found.at_low
    bend = 2.0 * (found.at_low + found.at_high - 2.0 * middle)
    begin = rise - bend
    under = np.sqrt(np.maximum(begin * begin - 4.0 * bend * found.at_low, 0.0))
    slope = begin + np.copysign(under, rise)
    steep = slope * rise > 0.0
    share = np.where(steep, -2.0 * found.at_low / np.where(steep, slope, 1.0), 0.5)
    start: FloatArray = found.low + length * np.clip(share, 0.0, 1.0)
    return start


def _polished(tilted: Tilted, tile: IntArray, level: FloatArray, u: FloatArray) -> FloatArray:
    """Carry derivatives through roots that were found among plain numbers."""
    height = tilted.height
    if is_plain(height) and is_plain(level):
        return u
    first, second, third, fourth = np.take(height, tile, axis=1)
    above = first - level + u * (second + u * (third + u * fourth))
    slope = second + u * (2.0 * third + u * (3.0 * fourth))
    # What is left of the residual is rounding: only its derivative is wanted.
    steep = np.abs(real(slope)) > 0.0
    change = (above - real(above)) / np.where(steep, slope, 1.0)
    return np.where(u < _LEAST, _LEAST, u) - np.where(steep, change, 0.0)
