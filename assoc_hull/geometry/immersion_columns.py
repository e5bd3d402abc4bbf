"""What the cuts of tiles by planes contribute to the integrals of one side of a body.

A tile that ends wet counts whole; at a cut where it leaves the water the part from its
beginning to the cut is added, at a cut where it goes in that part is taken off. With the
same sign the cut is a point of the waterline, whose line integrals (Green) give the plane:
``dx/dv = x_v - x_u q_v / q_u`` along it.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.immersion_roots import Cuts, Tilted
from assoc_hull.geometry.immersion_tiles import COLUMNS, Tiles, integrals, powers
from assoc_hull.geometry.tile_sums import real

__all__ = ["PLANE", "WATERLINE", "Waterline", "along"]

PLANE = 6
"""Columns of a waterline: integrals of 1, x, y, x x, x y, y y over the plane, in plan."""

WATERLINE = COLUMNS + PLANE
"""Columns of `along`: those of the tiles, then those of the plane."""

_CHUNK = 2048  # cuts of which the work stays in the processor's cache
_FLAT = 1e-12  # of a slope: less is rounding


@attrs.frozen(eq=False)
class Waterline:
    """Cuts as points of waterlines.

    Attributes
    ----------
    columns : (13, k)
        Share of each in the integrals (`WATERLINE`), per unit of v.
    point : (3, k), m
        x, y and z.
    """

    columns: FloatArray
    point: FloatArray


def along(tiles: Tiles, tilted: Tilted, tile: IntArray, found: Cuts) -> Waterline:
    """Integrate the parts of tiles below their cuts.

    Parameters
    ----------
    tiles, tilted : Tiles, Tilted
        The tiles.
    tile : (k,) int
        The tile of each cut.
    found : Cuts
        The cuts.

    Returns
    -------
    Waterline
        One column per cut.
    """
    if len(tile) <= _CHUNK:
        return _along(tiles, tilted, tile, found.u, found.sign)
    pieces = [
        _along(tiles, tilted, tile[part], found.u[part], found.sign[part])
        for part in (slice(i, i + _CHUNK) for i in range(0, len(tile), _CHUNK))
    ]
    return Waterline(
        np.concatenate([piece.columns for piece in pieces], axis=1),
        np.concatenate([piece.point for piece in pieces], axis=1),
    )


def _along(
    tiles: Tiles, tilted: Tilted, tile: IntArray, u: FloatArray, sign: FloatArray
) -> Waterline:
    powered = np.take(tiles.coefficients, tile, axis=2) * powers(u)
    solid = integrals(powered, tiles.deck[tile])
    both = powered[:, 0] + powered[:, 1] + powered[:, 2] + powered[:, 3]
    slope = _slopes(np.take(tiles.coefficients[:3], tile, axis=2), u)
    x, y = both[0], both[1]
    forward = both[3] - slope[0] * _ratio(tilted, slope, both[3:])
    area = y * forward
    half = 0.5 * y * area
    plane = [area, x * area, half, x * x * area, x * half, (2.0 / 3.0) * y * half]
    return Waterline(sign * np.concatenate([solid, np.stack(plane)]), both[:3])


def _slopes(point: FloatArray, u: FloatArray) -> FloatArray:
    """Give P_u of cubics (3, 4, k) at one place each, (3, k)."""
    slope: FloatArray = point[:, 1] + u * (2.0 * point[:, 2] + u * (3.0 * point[:, 3]))
    return slope


def _ratio(tilted: Tilted, slope: FloatArray, across: FloatArray) -> FloatArray:
    """Give q_v / q_u; nil where the plane touches the curve, as nothing passes there."""
    steep = slope[2] - tilted.trim * slope[0] + tilted.heel * slope[1]
    climb = across[2] - tilted.trim * across[0] + tilted.heel * across[1]
    flat = np.abs(real(steep)) <= _FLAT * np.abs(real(slope)).sum(axis=0)
    ratio: FloatArray = np.where(flat, 0.0, climb / np.where(flat, 1.0, steep))
    return ratio
