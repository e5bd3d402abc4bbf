"""How places along strips at which something happens move with what the numbers carry along.

They are found among plain numbers. The point that passes the plane there has the height q(v)
over planes of the inclination, so a change of q - level moves the place by -1/q_v times that.
Where a bend becomes a knuckle no plane is needed: there it is the angle that passes a limit.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.immersion_critical import critical, critical_at, nearest
from assoc_hull.geometry.immersion_places import DECK, KEEL, Brackets
from assoc_hull.geometry.immersion_roots import Tilted, tilt
from assoc_hull.geometry.immersion_strips import Prepared
from assoc_hull.geometry.immersion_tiles import Tiles, bends, from_curves
from assoc_hull.geometry.tile_sums import is_plain, real

__all__ = ["followed"]

_FLAT = 1e-9
"""m along a whole strip: what rises less lies level, and has no place to move to."""

_NEAR = 1e-7
"""m: if no point is so near to the plane, none passes it. Then a bend becomes a knuckle there."""


def followed(prepared: Prepared, tilted: Tilted, levels: FloatArray, found: Brackets) -> Brackets:
    """Carry derivatives through places that were found among plain numbers.

    Parameters
    ----------
    prepared : Prepared
        The body, in any arithmetic.
    tilted : Tilted
        The inclination of the planes.
    levels : (d,), m
        Their heights.
    found : Brackets
        The places; their `row` is the plane times the number of strips, plus the strip.

    Returns
    -------
    Brackets
        With `low` and `high` in the arithmetic that results; as they were if it is plain.
    """
    numbers = (prepared.tiles.coefficients, levels, tilted.trim, tilted.heel)
    if not len(found) or all(map(is_plain, numbers)):
        return found
    strips = prepared.strips
    tiles = from_curves(strips.curves(found.strip, 0.5 * (found.low + found.high)))
    height, change = _passing(tiles, tilt(tiles, tilted.trim, tilted.heel), found)
    over = height - np.take(levels, found.row // strips.count)
    move = np.where(np.abs(real(over)) < _NEAR, _step(over, change), _step(*_bending(tiles)))
    return attrs.evolve(found, low=found.low + move, high=found.high + move)


def _step(over: FloatArray, change: FloatArray) -> FloatArray:
    """Give by what places move at which something is nil, from its value and its change by v.

    What is left of the values is rounding: only their derivatives are wanted.
    """
    clear = (np.abs(real(change)) > _FLAT) & (np.abs(real(over)) < _NEAR)
    return np.where(clear, (real(over) - over) / np.where(clear, real(change), 1.0), 0.0)


def _bending(tiles: Tiles) -> tuple[FloatArray, FloatArray]:
    """Give of each curve the bend that is nearest to a knuckle, as `bends` does."""
    over, change = bends(tiles)
    inside = np.flatnonzero(np.diff(tiles.curve) == 0)
    order = inside[np.lexsort((np.abs(real(over)[inside]), tiles.curve[inside]))]
    first = np.searchsorted(tiles.curve[order], np.arange(tiles.curves))
    some = np.bincount(tiles.curve[inside], minlength=tiles.curves) > 0
    chosen = order[np.where(some, first, 0)] if len(order) else np.zeros(tiles.curves, np.int64)
    return np.where(some, np.take(over, chosen), np.inf), np.take(change, chosen)


def _passing(tiles: Tiles, tilted: Tilted, found: Brackets) -> tuple[FloatArray, FloatArray]:
    """Give height and q_v of the point of each curve that passes the plane."""
    kind = found.below ^ found.above
    points = critical(tiles, tilted)
    inner = nearest(points, found.level, tiles.curves)
    height, change = np.take(points.height, inner), np.take(points.change, inner)
    for bit, tile, u in ((DECK, tiles.start[1:] - 1, 1.0), (KEEL, tiles.start[:-1], 0.0)):
        end = critical_at(tiles, tilted, tile, np.full(tiles.curves, u))
        chosen = (kind & bit) > 0
        height = np.where(chosen, end.height, height)
        change = np.where(chosen, end.change, change)
    return height, change
