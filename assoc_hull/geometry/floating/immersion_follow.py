"""How places along strips at which something happens move with what the numbers carry along.

They are found among plain numbers. The point that passes the plane there has the height q(v)
over planes of the inclination, so a change of q - level moves the place by -1/q_v times that.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.floating.immersion_critical import critical, critical_at, nearest
from assoc_hull.geometry.floating.immersion_places import Brackets
from assoc_hull.geometry.floating.immersion_roots import Tilted, tilt
from assoc_hull.geometry.floating.immersion_states import DECK, KEEL
from assoc_hull.geometry.floating.prepared_strips import Prepared
from assoc_hull.geometry.floating.tiles import Tiles, from_curves
from assoc_hull.geometry.numeric.dual import is_plain, real

__all__ = ["followed"]

_FLAT = 1e-9
"""m along a whole strip: what rises less lies level, and has no place to move to."""

_NEAR = 1e-7
"""m: if no point is so near to the plane, none passes it: a knuckle begins or ends there, or
two pieces of a section join. The integrands go on smoothly there."""


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
    passes = (np.abs(real(change)) > _FLAT) & (np.abs(real(over)) < _NEAR)
    move = np.where(passes, (real(over) - over) / np.where(passes, real(change), 1.0), 0.0)
    return attrs.evolve(found, low=found.low + move, high=found.high + move)


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
