"""What curves cut by planes contribute to the integrals of one side of a body.

A tile that ends wet counts whole; at a cut where it leaves the water the part from its
beginning to the cut is added, at a cut where it goes in that part is taken off. With the
same sign the cut is a point of the waterline, whose line integrals (Green) give the plane:
``dx/dv = x_v - x_u q_v / q_u`` along it.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.floating.immersion_extents import (
    Places,
    extent,
    slopes,
    waterline_rate,
    wider,
)
from assoc_hull.geometry.floating.immersion_roots import Tilted, cuts
from assoc_hull.geometry.floating.tiles import CHUNK, Tiles, integrals, powers
from assoc_hull.geometry.numeric.dual import real
from assoc_hull.geometry.numeric.generic_sums import sum_by

__all__ = ["Cross", "Half", "add_solid", "cross"]


@attrs.frozen(eq=False)
class Half:
    """Integrals of one side below d planes, and extents of its waterplane.

    Attributes
    ----------
    columns : (13, d) or (17, d)
        Sums of the rows of `integrals`, and the integrals of 1, x, y, x x, x y, y y over the
        plane, in plan.
    extent : (4, d), m
        Least and greatest x, least and greatest y; infinite where there is no waterplane.
    """

    columns: FloatArray
    extent: FloatArray


@attrs.frozen(eq=False)
class Cross:
    """Shares of cuts in a half, and where the cuts are.

    Attributes
    ----------
    half : Half
        What the parts of tiles below cuts add to it, and the waterlines.
    plane, tile : (k,) int
        Of each cut.
    u, y : (k,)
        Where on the tile it is, and its half breadth, m.
    """

    half: Half
    plane: IntArray
    tile: IntArray
    u: FloatArray
    y: FloatArray

    @property
    def places(self) -> Places:
        """The cuts, for the breadth between curves."""
        return Places(self.plane, self.tile, self.u, self.y, real(self.half.extent[3]))


def cross(
    tiles: Tiles,
    tilted: Tilted,
    pairs: tuple[IntArray, IntArray],
    level: FloatArray,
    weight: FloatArray,
) -> Cross:
    """Cut tiles by planes and integrate up to the cuts.

    Parameters
    ----------
    tiles, tilted : Tiles, Tilted
        The tiles.
    pairs : (p,) int, (p,) int
        A tile and a plane that may meet.
    level : (d,), m
        Heights of the planes.
    weight : (p,)
        Shares of the pairs in the integrals along v.

    Returns
    -------
    Cross
        The sums over all cuts.
    """
    tile, plane = pairs
    if len(tile) <= CHUNK:
        return _cross(tiles, tilted, tile, plane, level, weight)
    parts = [
        _cross(tiles, tilted, tile[some], plane[some], level, weight[some])
        for some in (slice(i, i + CHUNK) for i in range(0, len(tile), CHUNK))
    ]
    half = parts[0].half
    for part in parts[1:]:
        columns = half.columns + part.half.columns
        half = Half(columns, wider(half.extent, part.half.extent))
    names = ("plane", "tile", "u", "y")
    return Cross(half, *(np.concatenate([getattr(part, n) for part in parts]) for n in names))


def add_solid(half: Half, solid: FloatArray) -> Half:
    """Add whole tiles, (7, d) or (11, d), to a half."""
    rows = len(solid)
    columns = np.concatenate([half.columns[:rows] + solid, half.columns[rows:]])
    return Half(columns, half.extent)


def _cross(
    tiles: Tiles,
    tilted: Tilted,
    tile: IntArray,
    plane: IntArray,
    level: FloatArray,
    weight: FloatArray,
) -> Cross:
    """Do what `cross` does with pairs that fit the processor's cache."""
    found = cuts(tilted, tile, np.take(level, plane))
    tile, plane = tile[found.pair], plane[found.pair]
    lean = tiles.lean[tile]
    coefficients = np.take(tiles.coefficients, tile, axis=2)
    part = coefficients * powers(found.u)
    solid = integrals(part, tiles.deck[tile], lean, tilted.heeled)
    point = part[:, 0] + part[:, 1] + part[:, 2] + part[:, 3]
    x, y, forward = point[0], point[1], point[3]
    if lean.any():
        slope = slopes(coefficients[:3], found.u)
        forward = forward - slope[0] * waterline_rate(tilted, slope, point[3:])
    columns = np.concatenate([solid, _green(x, y, forward)])
    columns = columns * (found.sign * np.take(weight, found.pair))
    half = Half(sum_by(columns, plane, len(level)), extent(x, y, plane, len(level)))
    return Cross(half, plane, tile, found.u, y)


def _green(x: FloatArray, y: FloatArray, forward: FloatArray) -> FloatArray:
    """Give the integrands along v of area and moments of the plane, (6, k)."""
    area = y * forward
    half = 0.5 * y * area
    along = x * area
    return np.stack([area, along, half, x * along, x * half, (2.0 / 3.0) * y * half])
