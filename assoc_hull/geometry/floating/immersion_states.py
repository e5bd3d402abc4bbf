"""Of what kind the immersed part of a curve is: for curves of the plain rule, and anywhere.

Curves that many planes ask for are given once, and not too many at a time: memory that does
not leave the processor's cache is several times faster.
"""

from __future__ import annotations

from collections.abc import Iterator

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.floating.immersion_critical import critical
from assoc_hull.geometry.floating.immersion_roots import Tilted, brackets, tilt
from assoc_hull.geometry.floating.tiles import Tiles, expand, from_curves
from assoc_hull.geometry.numeric.dual import is_plain, real
from assoc_hull.geometry.surfaces.isocurves import Strips

__all__ = [
    "DECK",
    "KEEL",
    "Inclination",
    "Look",
    "batches",
    "flickers",
    "look",
    "states",
    "states_at",
    "times_cut",
]

Inclination = tuple[FloatArray, FloatArray]
"""Tangents of trim and heel, (1,) each, plain."""

DECK, KEEL, _CUT, _EDGE = 1, 2, 4, 1024

_CURVES = 256  # at a time
_POINTS = 14  # of a curve that are looked at


@attrs.frozen(eq=False)
class Look:
    """Curves as seen from planes, all of n.

    Attributes
    ----------
    state : (n,) int
        Their `states`.
    over : (n, 14), m
        Heights over the plane: of the beginning, the end, and all critical points of the
        curve by height; infinite where there are no more.
    """

    state: IntArray
    over: FloatArray


def states(
    tiles: Tiles, tilted: Tilted, curve: IntArray, level: FloatArray, times: IntArray
) -> IntArray:
    """Tell of what kind the immersed part of each curve is.

    Parameters
    ----------
    tiles, tilted : Tiles, Tilted
        The tiles.
    curve : (...) int
        Which curve,
    level : (...), m
        below which level,
    times : (...) int
        and how often it is cut there.

    Returns
    -------
    (...) int
        A number made of how often the curve is cut, and whether keel, end and deck's edge
        are wet.
    """
    keel = tilted.control[0][tiles.start[curve]] <= level
    deck = tilted.control[3][tiles.start[curve + 1] - 1] <= level
    edge = tiles.edge[curve]
    wet = (edge >= 0) & (tilted.control[0][edge] <= level)
    state: IntArray = _CUT * times + KEEL * keel + DECK * deck + _EDGE * wet
    return state


def flickers(
    tiles: Tiles,
    tilted: Tilted,
    pair: IntArray,
    level: FloatArray,
    change: IntArray,
    least: FloatArray,
) -> NDArray[np.bool_]:
    """Tell where states of neighbouring curves differ only by rounding.

    Parameters
    ----------
    tiles, tilted : Tiles, Tilted
        The tiles.
    pair : (2, n) int
        The neighbours.
    level : (n,), m
        The plane's height.
    change : (n,) int
        In which bits their states differ.
    least : (n,), m
        What is closer to the plane lies in it.

    Returns
    -------
    (n,) bool
        Keel, end or deck's edge of both lie in the plane, and no other than these differ but
        for the cuts that come with them.
    """
    edge = tiles.edge[pair]
    heights = (
        (KEEL, tilted.control[0][tiles.start[pair]]),
        (DECK, tilted.control[3][tiles.start[pair + 1] - 1]),
        (_EDGE, np.where(edge >= 0, tilted.control[0][edge], np.inf)),
    )
    some, all_in = np.zeros(len(change), bool), np.ones(len(change), bool)
    for bit, height in heights:
        differs = (change & bit) != 0
        within = (np.abs(height - level) <= least).all(axis=0)
        some, all_in = some | differs, all_in & (within | ~differs)
    flicker: NDArray[np.bool_] = some & all_in
    return flicker


def times_cut(state: IntArray) -> IntArray:
    """Tell from states how often curves are cut."""
    return state % _EDGE // _CUT


def batches(
    strips: Strips, strip: IntArray, v: FloatArray, plain: bool = False
) -> Iterator[tuple[IntArray, IntArray, Tiles]]:
    """Give curves, each but once.

    Parameters
    ----------
    strips : Strips
        The body.
    strip, v : (n,) int, (n,)
        Which curves are asked for.
    plain : bool
        Only decisions are to be taken: without what derivatives the curves carry.

    Yields
    ------
    (m,) int
        For which of the n,
    (m,) int
        which of the curves,
    Tiles
        of these.
    """
    if is_plain(v):
        _, first, which = np.unique(2.0 * strip + v, return_index=True, return_inverse=True)
    else:
        # Equal places may move differently.
        first = which = np.arange(len(strip))
    order = np.argsort(which, kind="stable")
    for begin in range(0, len(first), _CURVES):
        some = first[begin : begin + _CURVES]
        low, high = np.searchsorted(which[order], [begin, begin + len(some)])
        rows = order[low:high]
        curves = strips.curves(strip[some], v[some])
        if plain and not is_plain(curves.point):
            curves = attrs.evolve(curves, point=real(curves.point), across=real(curves.across))
        yield rows, which[rows] - begin, from_curves(curves)


def states_at(
    strips: Strips, inclination: Inclination, strip: IntArray, v: FloatArray, level: FloatArray
) -> IntArray:
    """Tell the states of curves anywhere.

    Parameters
    ----------
    strips : Strips
        The body.
    inclination : Inclination
        Of the planes.
    strip, v : (n,) int, (n,)
        Which curves.
    level : (n,), m
        Height of the plane for each.

    Returns
    -------
    (n,) int
        Their `states`.
    """
    state = np.zeros(len(v), np.int64)
    for rows, curve, tiles in batches(strips, strip, v, plain=True):
        state[rows] = _state(tiles, tilt(tiles, *inclination), curve, level[rows])
    return state


def look(
    strips: Strips, inclination: Inclination, strip: IntArray, v: FloatArray, level: FloatArray
) -> Look:
    """Look at curves anywhere; the arguments are those of `states_at`.

    Returns
    -------
    Look
        States, and how far the points that decide about them are from the planes.
    """
    state, over = np.zeros(len(v), np.int64), np.full((len(v), _POINTS), np.inf)
    for rows, curve, tiles in batches(strips, strip, v, plain=True):
        tilted = tilt(tiles, *inclination)
        state[rows] = _state(tiles, tilted, curve, level[rows])
        over[rows] = _heights(tiles, tilted)[curve] - level[rows, None]
    return Look(state, over)


def _state(tiles: Tiles, tilted: Tilted, curve: IntArray, level: FloatArray) -> IntArray:
    """Tell the states of pairs of a curve and a level."""
    tile, row = expand(tiles, curve)
    at = level[row]
    hit = np.flatnonzero((tilted.low[tile] <= at) & (tilted.high[tile] > at))
    found = brackets(tilted, tile[hit], at[hit])
    times = np.bincount(row[hit[found.pair]], minlength=len(curve))
    return states(tiles, tilted, curve, level, times)


def _heights(tiles: Tiles, tilted: Tilted) -> FloatArray:
    """Give the heights of the points of `Look.over`, (k, 14)."""
    points = critical(tiles, tilted)
    order = np.lexsort((points.height, points.curve))
    curve = points.curve[order]
    rank = np.arange(len(order)) - np.searchsorted(curve, curve) + 2
    kept = np.flatnonzero(rank < _POINTS)
    height = np.full((tiles.curves, _POINTS), np.inf)
    height[:, 0] = tilted.control[0][tiles.start[:-1]]
    height[:, 1] = tilted.control[3][tiles.start[1:] - 1]
    height[curve[kept], rank[kept]] = points.height[order[kept]]
    return height
