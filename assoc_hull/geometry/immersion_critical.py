"""Critical points of curves: where, as a plane rises, a piece of a section appears or ends."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.bernstein import value
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.immersion_roots import Tilted, turns
from assoc_hull.geometry.immersion_tiles import Tiles

__all__ = ["Critical", "critical"]


@attrs.frozen(eq=False)
class Critical:
    """Points of curves at which the height over inclined planes is least or greatest, (n,).

    Attributes
    ----------
    curve : int
        The curve.
    height : m
        How high the point is: q.
    change : m
        q_v, the change of that height along the strip.
    """

    curve: IntArray
    height: FloatArray
    change: FloatArray


def critical(tiles: Tiles, tilted: Tilted) -> Critical:
    """Find the ends of curves, the deck's edge, and where they turn from up to down or back.

    Parameters
    ----------
    tiles, tilted : Tiles, Tilted
        The curves.

    Returns
    -------
    Critical
        Their critical points.
    """
    tile, u = _where(tiles, tilted)
    origin, first, second, third = np.take(tilted.height, tile, axis=1)
    across = np.take(tiles.coefficients[3:], tile, axis=2)
    x_v, y_v, z_v = value(across[:, 0], across[:, 1], across[:, 2], across[:, 3], u)
    change = z_v - tilted.trim * x_v + tilted.heel * y_v
    return Critical(tiles.curve[tile], value(origin, first, second, third, u), change)


def _where(tiles: Tiles, tilted: Tilted) -> tuple[IntArray, FloatArray]:
    """Give tile and u of the critical points."""
    control = tilted.control
    into, out = control[3, :-1] - control[2, :-1], control[1, 1:] - control[0, 1:]
    turn = np.flatnonzero((into * out < 0.0) & (tiles.curve[1:] == tiles.curve[:-1])) + 1
    wave = np.flatnonzero(tilted.wavy)
    lower, upper = turns(tilted, wave)
    low, high = lower > 0.0, upper < 1.0
    begin, end = tiles.start[:-1], tiles.start[1:] - 1
    knots = np.concatenate([begin, tiles.edge[tiles.edge >= 0], turn])
    tile = np.concatenate([knots, end, wave[low], wave[high]])
    u = [np.zeros(len(knots)), np.ones(len(end)), lower[low], upper[high]]
    return tile, np.concatenate(u)
