"""Strips made ready for floating planes: the curves of the rule along v, integrated."""

from __future__ import annotations

from functools import cached_property

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.floating.tile_intersections import (
    CriticalPoints,
    TiltedTiles,
    find_critical_points,
    tilt_tiles,
)
from assoc_hull.geometry.floating.tiles import (
    CurveTiles,
    integrate_tiles,
    tiles_of_curves,
    tiles_subset,
)
from assoc_hull.geometry.numeric.dual import real
from assoc_hull.geometry.numeric.quadrature import lobatto
from assoc_hull.geometry.surfaces.isocurves import Strips

__all__ = ["LEVEL", "PreparedStrips", "prepare_strips"]

LEVEL = 1e-9
"""Of a strip's depth: so much is no slope."""

_POINT = 1e-9
"""m: a strip that is not higher is but a point, such as a part right at the end of a ship."""

_MORE = 6  # points of the rule where something happens, beyond those where nothing does


@attrs.frozen(eq=False)
class PreparedStrips:
    """Strips with the curves on which they are integrated.

    Attributes
    ----------
    strips : Strips
        The body.
    fine : (strips,) int
        How many curves each part of a strip gets in which something happens.
    strip : (k,) int
        The strip of each curve, ascending.
    v, weight : (k,)
        Where it lies, and its share in the integral along v. The first and the last curve
        of a strip lie at v = 0 and 1.
    tiles : Tiles
        The curves.
    plain : Strips
        The body in plain numbers, for decisions.
    """

    strips: Strips
    fine: IntArray
    strip: IntArray
    v: FloatArray
    weight: FloatArray
    tiles: CurveTiles
    plain: Strips
    _whole: FloatArray

    def weighted(self, heeled: bool) -> FloatArray:
        """Integrals of the tiles, by the weights of their curves: (7, s), with heel (11, s)."""
        return self._heeled if heeled else self._whole

    @cached_property
    def _heeled(self) -> FloatArray:
        return _weighted(self.tiles, self.weight, heeled=True)

    @cached_property
    def upright(self) -> TiltedTiles:
        """Heights over the planes of no trim and no heel."""
        return tilt_tiles(self.tiles, np.zeros(1), np.zeros(1))

    @cached_property
    def depth(self) -> FloatArray:
        """Height of each strip, m, (strips,); 1 where it is but a point."""
        low, high = self.upright.low, self.upright.high
        begin = self.tiles.start[np.searchsorted(self.strip, np.arange(self.strips.count))]
        depth = np.maximum.reduceat(high, begin) - np.minimum.reduceat(low, begin)
        return np.where(depth > _POINT, depth, 1.0)

    @cached_property
    def ends(self) -> tuple[IntArray, CurveTiles]:
        """Curves at v = 0 and 1 of all strips: which they are, and their tiles."""
        end = np.flatnonzero((self.v == 0.0) | (self.v == 1.0))
        return end, tiles_subset(self.tiles, end)

    @cached_property
    def upright_ends(self) -> CriticalPoints:
        """Critical points of these curves, for no trim and no heel."""
        return self._ends_critical(self.upright)

    def critical(self, tilted: TiltedTiles) -> CriticalPoints:
        """Critical points of the curves at both ends of all strips, but for level edges."""
        return self.upright_ends if tilted is self.upright else self._ends_critical(tilted)

    def _ends_critical(self, inclined: TiltedTiles) -> CriticalPoints:
        curve, tiles = self.ends
        found = find_critical_points(tiles, tilt_tiles(tiles, inclined.trim, inclined.heel))
        moves = np.flatnonzero(~self._level(found))
        return attrs.evolve(found, curve=curve[found.curve]).take(moves)

    def _level(self, found: CriticalPoints) -> NDArray[np.bool_]:
        """Tell which points belong to an edge that is level along the strip, as most keels are.

        Such an edge comes out of the water all at once: nothing comes into the strip with it.
        """
        end = self.ends[0][found.curve]
        strip, fore = self.strip[end], self.v[end] == 1.0
        least = LEVEL * self.depth[strip]
        step = np.rint(real(found.height) / least).astype(np.int64)
        _, which = np.unique(strip + self.strips.count * step, return_inverse=True)
        both = (np.bincount(which, fore) > 0.0) & (np.bincount(which, ~fore) > 0.0)
        level: NDArray[np.bool_] = both[which] & (np.abs(real(found.change)) <= least)
        return level


def prepare_strips(strips: Strips, factor: int = 1, plain: Strips | None = None) -> PreparedStrips:
    """Integrate the tiles of a body's curves.

    Parameters
    ----------
    strips : Strips
        The body. A strip of order n gets Lobatto's rule of n + 1 points, exact to the same
        degree as Gauss's of n.
    factor : int
        By how much to raise the order along v: two orders tell the error of one.
    plain : Strips or None
        The body in plain numbers, if `strips` gives others: decisions look at these.

    Returns
    -------
    Prepared
        What `immersed` cuts.

    Raises
    ------
    BadInputError
        The factor is not positive.
    """
    if factor < 1:
        raise BadInputError(f"factor {factor}", "for an order along v", "give 1 or more")
    order = np.asarray(strips.order, np.int64) * factor
    strip = np.repeat(np.arange(strips.count), order + 1)
    rules = [lobatto(int(points) + 1) for points in order]
    nodes = [np.concatenate(parts) for parts in zip(*rules, strict=True)]
    v, weight = nodes if nodes else (np.zeros(0), np.zeros(0))
    tiles = tiles_of_curves(strips.curves(strip, v))
    fine = order + _MORE
    whole = _weighted(tiles, weight, heeled=False)
    known = strips if plain is None else plain
    return PreparedStrips(strips, fine, strip, v, weight, tiles, known, whole)


def _weighted(tiles: CurveTiles, weight: FloatArray, heeled: bool) -> FloatArray:
    whole = integrate_tiles(tiles.coefficients, tiles.deck, tiles.lean, heeled)
    return whole * np.take(weight, tiles.curve)
