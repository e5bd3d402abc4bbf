"""Of what kind the immersed part of a curve is, and where along a strip the kind changes.

A state says whether keel and deck edge are wet and how often the curve is cut. It is found for the
curves of the rule, and for curves anywhere along a strip; between two curves of different states
the place of the change is bracketed by bisection, many at once.
"""

from __future__ import annotations

from collections.abc import Iterator

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.floating.tile_intersections import (
    TiltedTiles,
    bracket_cuts,
    find_critical_points,
    tilt_tiles,
)
from assoc_hull.geometry.floating.tiles import CurveTiles, tile_rows, tiles_of_curves
from assoc_hull.geometry.numeric.dual import is_plain, real
from assoc_hull.geometry.surfaces.isocurves import Strips

__all__ = [
    "DECK",
    "KEEL",
    "CurveStates",
    "Inclination",
    "StateBrackets",
    "curve_batches",
    "curve_states",
    "cut_counts",
    "find_state_changes",
    "inspect_strips",
    "join_brackets",
    "rounding_flickers",
    "strip_states",
]

# --------------------------------------------------------------------------------------
# Of what kind the immersed part of a curve is: for curves of the plain rule, and anywhere.
#
# Curves that many planes ask for are given once, and not too many at a time: memory that does
# not leave the processor's cache is several times faster.

Inclination = tuple[FloatArray, FloatArray]
"""Tangents of trim and heel, (1,) each, plain."""

DECK, KEEL, _CUT, _EDGE = 1, 2, 4, 1024

_CURVES = 256  # at a time
_POINTS = 14  # of a curve that are looked at


@attrs.frozen(eq=False)
class CurveStates:
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


def curve_states(
    tiles: CurveTiles, tilted: TiltedTiles, curve: IntArray, level: FloatArray, times: IntArray
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


def rounding_flickers(
    tiles: CurveTiles,
    tilted: TiltedTiles,
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


def cut_counts(state: IntArray) -> IntArray:
    """Tell from states how often curves are cut."""
    return state % _EDGE // _CUT


def curve_batches(
    strips: Strips, strip: IntArray, v: FloatArray, plain: bool = False
) -> Iterator[tuple[IntArray, IntArray, CurveTiles]]:
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
        yield rows, which[rows] - begin, tiles_of_curves(curves)


def strip_states(
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
    for rows, curve, tiles in curve_batches(strips, strip, v, plain=True):
        state[rows] = _state(tiles, tilt_tiles(tiles, *inclination), curve, level[rows])
    return state


def inspect_strips(
    strips: Strips, inclination: Inclination, strip: IntArray, v: FloatArray, level: FloatArray
) -> CurveStates:
    """Look at curves anywhere; the arguments are those of `states_at`.

    Returns
    -------
    Look
        States, and how far the points that decide about them are from the planes.
    """
    state, over = np.zeros(len(v), np.int64), np.full((len(v), _POINTS), np.inf)
    for rows, curve, tiles in curve_batches(strips, strip, v, plain=True):
        tilted = tilt_tiles(tiles, *inclination)
        state[rows] = _state(tiles, tilted, curve, level[rows])
        over[rows] = _heights(tiles, tilted)[curve] - level[rows, None]
    return CurveStates(state, over)


def _state(tiles: CurveTiles, tilted: TiltedTiles, curve: IntArray, level: FloatArray) -> IntArray:
    """Tell the states of pairs of a curve and a level."""
    tile, row = tile_rows(tiles, curve)
    at = level[row]
    hit = np.flatnonzero((tilted.low[tile] <= at) & (tilted.high[tile] > at))
    found = bracket_cuts(tilted, tile[hit], at[hit])
    times = np.bincount(row[hit[found.pair]], minlength=len(curve))
    return curve_states(tiles, tilted, curve, level, times)


def _heights(tiles: CurveTiles, tilted: TiltedTiles) -> FloatArray:
    """Give the heights of the points of `Look.over`, (k, 14)."""
    points = find_critical_points(tiles, tilted)
    order = np.lexsort((points.height, points.curve))
    curve = points.curve[order]
    rank = np.arange(len(order)) - np.searchsorted(curve, curve) + 2
    kept = np.flatnonzero(rank < _POINTS)
    height = np.full((tiles.curves, _POINTS), np.inf)
    height[:, 0] = tilted.control[0][tiles.start[:-1]]
    height[:, 1] = tilted.control[3][tiles.start[1:] - 1]
    height[curve[kept], rank[kept]] = points.height[order[kept]]
    return height


# --------------------------------------------------------------------------------------
# Where along strips the immersed part changes its kind: bracketed, many at once.

_CLOSE = 1e-10  # of a strip: integrals go with its power 3/2, extents with its square
_TRIALS = 60
_SEVERAL = 6  # changes between two neighbouring curves, at most


@attrs.frozen(eq=False)
class StateBrackets:
    """Pairs of places on a strip at which the immersed part is of two kinds, all (n,).

    Attributes
    ----------
    row : int
        Which of the caller's questions it belongs to.
    strip : int
        The strip.
    level : m
        The plane's height.
    low, high : places along v
    below, above : int
        The states there.
    """

    row: IntArray
    strip: IntArray
    level: FloatArray
    low: FloatArray
    high: FloatArray
    below: IntArray
    above: IntArray

    def __len__(self) -> int:
        return len(self.row)

    def take(self, rows: IntArray) -> StateBrackets:
        """Take some."""
        return StateBrackets(*(each[rows] for each in attrs.astuple(self, recurse=False)))


def join_brackets(*several: StateBrackets) -> StateBrackets:
    """Put brackets behind one another."""
    fields = zip(*(attrs.astuple(each, recurse=False) for each in several), strict=True)
    return StateBrackets(*(np.concatenate(parts) for parts in fields))


def find_state_changes(
    strips: Strips, inclination: Inclination, brackets: StateBrackets
) -> StateBrackets:
    """Find all places at which the state changes.

    Parameters
    ----------
    strips : Strips
        The body.
    inclination : (1,), (1,)
        Tangents of trim and heel, plain.
    brackets : Brackets
        Where to look.

    Returns
    -------
    Brackets
        Closed but for rounding; more of them than were given where several changes lie
        between two curves.
    """
    found = [brackets.take(np.zeros(0, np.int64))]
    for _ in range(_SEVERAL):
        if not len(brackets):
            break
        close = _closed(strips, inclination, brackets)
        found.append(close)
        more = np.flatnonzero((close.above != brackets.above) & (close.high < brackets.high))
        brackets = attrs.evolve(brackets.take(more), low=close.high[more], below=close.above[more])
    return join_brackets(*found)


def _closed(strips: Strips, inclination: Inclination, brackets: StateBrackets) -> StateBrackets:
    """Close each bracket on the first change of state that is seen."""
    v = np.stack([brackets.low, brackets.high], axis=1)
    above = brackets.above.copy()
    strip, level = np.repeat(brackets.strip, 2), np.repeat(brackets.level, 2)
    over = inspect_strips(strips, inclination, strip, v.ravel(), level).over.reshape(len(v), 2, -1)
    for _ in range(_TRIALS):
        alive = np.flatnonzero(v[:, 1] - v[:, 0] > _CLOSE)
        if not len(alive):
            break
        below = brackets.below[alive, None]
        trial = _trials(v[alive], _misses(over[alive], below[:, 0] ^ above[alive]))
        some = np.repeat(alive, 3)
        seen = inspect_strips(
            strips, inclination, brackets.strip[some], trial.ravel(), brackets.level[some]
        )
        state = seen.state.reshape(-1, 3)
        kept = np.cumprod(state == below, axis=1).sum(axis=1)
        row, ends = np.arange(len(alive))[:, None], np.stack([kept, kept + 1], axis=1)
        v[alive] = np.concatenate([v[alive, :1], trial, v[alive, 1:]], axis=1)[row, ends]
        between = seen.over.reshape(len(alive), 3, -1)
        rungs = np.concatenate([over[alive, :1], between, over[alive, 1:]], axis=1)
        over[alive] = rungs[row, ends]
        above[alive] = np.concatenate([state, above[alive, None]], axis=1)[row[:, 0], kept]
    return attrs.evolve(brackets, low=v[:, 0].copy(), high=v[:, 1].copy(), above=above)


def _misses(over: FloatArray, change: IntArray) -> FloatArray:
    """Give by how much, at both ends, the point is off the plane that passes it, (n, 2).

    If neither end of the curve does, it is the critical point up to which, counted from the
    lowest, the wetter of both is wet.
    """
    wet = (over[:, :, 2:] <= 0.0).sum(axis=2).max(axis=1)
    point = np.where(change & KEEL, 0, np.where(change & DECK, 1, wet + 1))
    point = np.minimum(point, over.shape[2] - 1)
    return np.take_along_axis(over, point[:, None, None], axis=2)[:, :, 0]


def _trials(v: FloatArray, miss: FloatArray) -> FloatArray:
    """Give three places in each bracket: two about where the chord says, one far from it.

    The chord errs by the square of the bracket's length; so if the two enclose the place,
    the digits double. Without a chord, quarters.
    """
    length = v[:, 1] - v[:, 0]
    one, other = miss[:, 0], miss[:, 1]
    with np.errstate(over="ignore", invalid="ignore"):
        chord = np.isfinite(one - other) & (one * other < 0.0)
        share = np.where(chord, one / np.where(chord, one - other, 1.0), 0.5)
    half_width = np.where(chord, np.minimum(0.25, 0.25 * length + 0.3 * _CLOSE / length), 0.25)
    before = np.clip(share - half_width, 0.25 * share, None)
    after = np.clip(share + half_width, None, share + 0.75 * (1.0 - share))
    far = np.where(share > 0.5, 0.5 * before, 0.5 * (1.0 + after))
    far = np.where(chord, far, 0.5)
    inside = np.sort(np.stack([before, after, far], axis=1), axis=1)
    trial: FloatArray = v[:, :1] + length[:, None] * inside
    return trial
