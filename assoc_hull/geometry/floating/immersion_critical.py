"""Critical points of curves: where, as a plane rises, a piece of a section appears or ends."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.floating.immersion_roots import Tilted, turns
from assoc_hull.geometry.floating.tiles import Tiles, powers
from assoc_hull.geometry.numeric.dual import is_plain, real
from assoc_hull.geometry.splines.bernstein import value

_LEVEL = 1e-9
"""m: a height that bends less along a tile has no turn that could be told to move."""

__all__ = ["Critical", "critical", "critical_at", "nearest"]


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
    place, rate : (2, n), m
        x and y of the point, and x_v and y_v.
    """

    curve: IntArray
    height: FloatArray
    change: FloatArray
    place: FloatArray
    rate: FloatArray

    def take(self, rows: IntArray) -> Critical:
        """Take some of the points."""
        return Critical(
            self.curve[rows],
            np.take(self.height, rows),
            np.take(self.change, rows),
            np.take(self.place, rows, axis=1),
            np.take(self.rate, rows, axis=1),
        )


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
    return critical_at(tiles, tilted, *_where(tiles, tilted))


def critical_at(tiles: Tiles, tilted: Tilted, tile: IntArray, u: FloatArray) -> Critical:
    """Give points of tiles, tile and u (n,) each, as critical ones."""
    origin, first, second, third = np.take(tilted.height, tile, axis=1)
    height = value(origin, first, second, third, u)
    both = (np.take(tiles.coefficients, tile, axis=2) * powers(u)).sum(axis=1)
    change = both[5] - tilted.trim * both[3] + tilted.heel * both[4]
    return Critical(tiles.curve[tile], height, change, both[:2], both[3:5])


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
    inner = np.concatenate([lower[low], upper[high]])
    turns_at = _moved(tilted, tile[len(knots) + len(end) :], inner)
    return tile, np.concatenate([np.zeros(len(knots)), np.ones(len(end)), turns_at])


def _moved(tilted: Tilted, tile: IntArray, u: FloatArray) -> FloatArray:
    """Carry derivatives through turns that were found among plain numbers."""
    if is_plain(tilted.height):
        return u
    _, first, second, third = np.take(tilted.height, tile, axis=1)
    slope = first + u * (2.0 * second + u * (3.0 * third))
    bend = real(2.0 * second + 6.0 * u * third)
    clear = np.abs(bend) > _LEVEL
    return u - np.where(clear, (slope - real(slope)) / np.where(clear, bend, 1.0), 0.0)


def nearest(points: Critical, level: FloatArray, curves: int) -> IntArray:
    """Give which of its critical points lies nearest to the level of each curve.

    Parameters
    ----------
    points : Critical
        Of so many curves.
    level : (curves,), m
        Plain.
    curves : int
        Number of curves.

    Returns
    -------
    (curves,) int
        Of the points.
    """
    over = np.abs(real(points.height) - level[points.curve])
    order = np.lexsort((over, points.curve))
    found: IntArray = order[np.searchsorted(points.curve[order], np.arange(curves))]
    return found
