"""What tiles cut by floating planes add to integrals of one side, and how far the plane reaches.

A tile that ends wet counts whole; where it leaves the water the part up to the cut is added, where
it goes in that part is taken off. With the same sign the cut is a point of the waterline, whose
line integrals (Green) give the waterplane: ``dx/dv = x_v - x_u q_v / q_u`` along it. The greatest
half breadth usually lies between two curves: there a cubic through both cuts is taken.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.floating.tiles import (
    CHUNK,
    CurveTiles,
    TiltedTiles,
    cubic_powers,
    cut_tiles,
    integrate_tiles,
)
from assoc_hull.geometry.numeric.dual import is_plain, real, safe_sqrt, sum_columns_by

__all__ = [
    "CutIntegrals",
    "HalfIntegrals",
    "WaterlineCuts",
    "add_whole_tiles",
    "greatest_breadths",
    "integrate_cuts",
    "join_extents",
    "point_extents",
    "tile_slopes",
    "waterline_rate",
]

# --------------------------------------------------------------------------------------
# Extents of waterplanes.
#
# Between two curves the cubic through both cuts has the slopes of the waterline at them: the error
# of the breadth goes with the fourth power of the distance of the curves.

FLAT = 1e-12  # of a slope: less is rounding
TIE = 1e-9  # m: cuts of one point on two strips are as far out as each other


@attrs.frozen(eq=False)
class WaterlineCuts:
    """Cuts of curves by d planes, all (k,) but `most`.

    Attributes
    ----------
    plane, tile : int
        Which plane cuts which tile,
    u : from 0 to 1
        and where on it.
    y : m
        Half breadth there.
    most : (d,), m
        The greatest half breadth of each plane, plain.
    """

    plane: IntArray
    tile: IntArray
    u: FloatArray
    y: FloatArray
    most: FloatArray


def point_extents(x: FloatArray, y: FloatArray, plane: IntArray, count: int) -> FloatArray:
    """Give the extents of points x, y (k,), m, per plane, (4, count), m.

    Least and greatest x, least and greatest y; infinite where there is no point. `plane` runs
    from 0 to count - 1.
    """
    rows = [-greatest_per_plane(-x, plane, count), greatest_per_plane(x, plane, count)]
    return np.stack(
        [*rows, -greatest_per_plane(-y, plane, count), greatest_per_plane(y, plane, count)]
    )


def join_extents(one: FloatArray, other: FloatArray) -> FloatArray:
    """Join extents (4, d)."""
    sign = np.array([[-1.0], [1.0], [-1.0], [1.0]])
    joined: FloatArray = np.where(real(one) * sign >= real(other) * sign, one, other)
    return joined


def tile_slopes(point: FloatArray, u: FloatArray) -> FloatArray:
    """Give P_u of cubics (3, 4, k) at one place each, (3, k)."""
    slope: FloatArray = point[:, 1] + u * (2.0 * point[:, 2] + u * (3.0 * point[:, 3]))
    return slope


def waterline_rate(tilted: TiltedTiles, slope: FloatArray, across: FloatArray) -> FloatArray:
    """Give -du/dv along the waterline, q_v / q_u, of P_u and P_v (3, k).

    It is zero where the plane touches the curve, as nothing passes there.
    """
    steep = slope[2] - tilted.trim * slope[0] + tilted.heel * slope[1]
    climb = across[2] - tilted.trim * across[0] + tilted.heel * across[1]
    flat = np.abs(real(steep)) <= FLAT * np.abs(real(slope)).sum(axis=0)
    rate: FloatArray = np.where(flat, 0.0, climb / np.where(flat, 1.0, steep))
    return rate


def greatest_breadths(
    tiles: CurveTiles, tilted: TiltedTiles, cuts: WaterlineCuts, v: FloatArray, strip: IntArray
) -> FloatArray:
    """Give the greatest half breadths between curves, where they exceed those at curves, (d,), m.

    `cuts` are all cuts of the curves, which lie at `v` on `strip`, (c,) each. Minus infinity where
    there is none between curves.
    """
    times, where = _cut_table(tiles, cuts)
    outer = np.flatnonzero(real(cuts.y) >= cuts.most[cuts.plane] - TIE)
    rate = _breadth_rate(tiles, tilted, cuts, outer)
    curve = tiles.curve[cuts.tile[outer]]
    # The neighbour toward which the breadth grows; only where both curves are cut just once is it
    # clear which cuts belong together.
    beside = np.clip(curve + np.where(real(rate) > 0.0, 1, -1), 0, tiles.curves - 1)
    row = cuts.plane[outer]
    fit = (strip[beside] == strip[curve]) & (times[row, beside] == 1) & (times[row, curve] == 1)
    fit = np.flatnonzero(fit)
    beside, outer = beside[fit], outer[fit]
    other, length = where[row[fit], beside], v[beside] - v[curve[fit]]
    out, into = np.take(rate, fit) * length, _breadth_rate(tiles, tilted, cuts, other) * length
    best = _first_maximum(np.take(cuts.y, outer), np.take(cuts.y, other), out, into)
    return greatest_per_plane(best, cuts.plane[outer], len(cuts.most))


def _cut_table(tiles: CurveTiles, cuts: WaterlineCuts) -> tuple[IntArray, IntArray]:
    """Say for planes and curves how often they are cut, and which cut is the last."""
    planes = len(cuts.most)
    key = cuts.plane * tiles.curves + tiles.curve[cuts.tile]
    times = np.bincount(key, minlength=planes * tiles.curves)
    where = np.zeros(planes * tiles.curves, np.int64)
    where[key] = np.arange(len(key))
    return times.reshape(planes, -1), where.reshape(planes, -1)


def _breadth_rate(
    tiles: CurveTiles, tilted: TiltedTiles, cuts: WaterlineCuts, rows: IntArray
) -> FloatArray:
    """Give dy/dv along the waterline at some cuts."""
    u = np.take(cuts.u, rows)
    coefficients = np.take(tiles.coefficients, cuts.tile[rows], axis=2)
    slope, across = (
        tile_slopes(coefficients[:3], u),
        (coefficients[3:] * cubic_powers(u)).sum(axis=1),
    )
    rate: FloatArray = across[1] - slope[1] * waterline_rate(tilted, slope, across)
    return rate


def _first_maximum(
    begin: FloatArray, end: FloatArray, out: FloatArray, into: FloatArray
) -> FloatArray:
    """Give the first greatest value of cubics from 0 to 1 that begin upward."""
    rise = end - begin
    second, third = 3.0 * rise - 2.0 * out - into, out + into - 2.0 * rise
    under = second * second - 3.0 * third * out
    below = safe_sqrt(np.where(real(under) > 0.0, under, 0.0)) - second
    some = real(below) > 0.0
    t = np.where(some, out / np.where(some, below, 1.0), 0.0)
    t = np.where(real(t) < 1.0, t, 0.0)
    summit: FloatArray = begin + t * (out + t * (second + t * third))
    return summit


def greatest_per_plane(values: FloatArray, plane: IntArray, count: int) -> FloatArray:
    """Give the greatest value of each plane, minus infinity where there is none."""
    most = np.full(count, -np.inf)
    if is_plain(values):
        if count == 1:
            most[0] = values.max(initial=-np.inf)
        else:
            np.maximum.at(most, plane, values)
        return most
    if not len(plane):
        return most
    order = np.lexsort((real(values), plane))
    last = np.searchsorted(plane[order], np.arange(count), "right") - 1
    some = np.bincount(plane, minlength=count) > 0
    return np.where(some, np.take(values, order[np.maximum(last, 0)]), most)


# --------------------------------------------------------------------------------------
# Integrals up to the cuts.


@attrs.frozen(eq=False)
class HalfIntegrals:
    """Integrals of one side below d planes, and extents of its waterplane.

    Attributes
    ----------
    columns : (13, d) or (17, d)
        Sums of the rows of `integrate_tiles`, and the integrals of 1, x, y, x x, x y, y y over the
        plane, in plan.
    extent : (4, d), m
        Least and greatest x, least and greatest y; infinite where there is no waterplane.
    """

    columns: FloatArray
    extent: FloatArray


@attrs.frozen(eq=False)
class CutIntegrals:
    """Shares of cuts in a half, and where the cuts are.

    Attributes
    ----------
    half : HalfIntegrals
        What the parts of tiles below cuts add to it, and the waterlines.
    plane, tile : (k,) int
        Of each cut.
    u, y : (k,)
        Where on the tile it is, and its half breadth, m.
    """

    half: HalfIntegrals
    plane: IntArray
    tile: IntArray
    u: FloatArray
    y: FloatArray

    @property
    def places(self) -> WaterlineCuts:
        """The cuts, for the breadth between curves."""
        return WaterlineCuts(self.plane, self.tile, self.u, self.y, real(self.half.extent[3]))


def integrate_cuts(
    tiles: CurveTiles,
    tilted: TiltedTiles,
    pairs: tuple[IntArray, IntArray],
    level: FloatArray,
    weight: FloatArray,
) -> CutIntegrals:
    """Cut pairs of a tile and a plane, (p,) each, that may intersect, and integrate up to the cuts.

    Levels of the planes are (d,), m; a weight (p,) is the share of a pair in the integral along v.
    """
    tile, plane = pairs
    if len(tile) <= CHUNK:
        return _integrate_chunk(tiles, tilted, tile, plane, level, weight)
    parts = [
        _integrate_chunk(tiles, tilted, tile[some], plane[some], level, weight[some])
        for some in (slice(i, i + CHUNK) for i in range(0, len(tile), CHUNK))
    ]
    half = parts[0].half
    for part in parts[1:]:
        columns = half.columns + part.half.columns
        half = HalfIntegrals(columns, join_extents(half.extent, part.half.extent))
    names = ("plane", "tile", "u", "y")
    return CutIntegrals(
        half, *(np.concatenate([getattr(part, n) for part in parts]) for n in names)
    )


def add_whole_tiles(half: HalfIntegrals, solid: FloatArray) -> HalfIntegrals:
    """Add whole tiles, (7, d) or (11, d), to a half."""
    rows = len(solid)
    columns = np.concatenate([half.columns[:rows] + solid, half.columns[rows:]])
    return HalfIntegrals(columns, half.extent)


def _integrate_chunk(
    tiles: CurveTiles,
    tilted: TiltedTiles,
    tile: IntArray,
    plane: IntArray,
    level: FloatArray,
    weight: FloatArray,
) -> CutIntegrals:
    """Do what `integrate_cuts` does, with pairs that fit the processor's cache."""
    found = cut_tiles(tilted, tile, np.take(level, plane))
    tile, plane = tile[found.pair], plane[found.pair]
    lean = tiles.lean[tile]
    coefficients = np.take(tiles.coefficients, tile, axis=2)
    part = coefficients * cubic_powers(found.u)
    solid = integrate_tiles(part, tiles.deck[tile], lean, tilted.heeled)
    point = part[:, 0] + part[:, 1] + part[:, 2] + part[:, 3]
    x, y, forward = point[0], point[1], point[3]
    if lean.any():
        slope = tile_slopes(coefficients[:3], found.u)
        forward = forward - slope[0] * waterline_rate(tilted, slope, point[3:])
    columns = np.concatenate([solid, _green(x, y, forward)])
    columns = columns * (found.sign * np.take(weight, found.pair))
    half = HalfIntegrals(
        sum_columns_by(columns, plane, len(level)), point_extents(x, y, plane, len(level))
    )
    return CutIntegrals(half, plane, tile, found.u, y)


def _green(x: FloatArray, y: FloatArray, forward: FloatArray) -> FloatArray:
    """Give the integrands along v of area and moments of the plane, (6, k)."""
    area = y * forward
    half = 0.5 * y * area
    along = x * area
    return np.stack([area, along, half, x * along, x * half, (2.0 / 3.0) * y * half])
