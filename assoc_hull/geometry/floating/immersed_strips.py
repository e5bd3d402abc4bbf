"""Strips made ready for floating planes, and which part of each of their curves is immersed.

The curves of the rule along v are integrated once (`prepare_strips`); a plane then only adds tiles
and cuts. The state of a curve says whether keel, end and deck's edge are wet and how often it is
cut; where it changes between two curves of a strip, the place is bracketed, many at once.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, Strips
from assoc_hull.geometry.floating.tiles import (
    CriticalPoints,
    CurveTiles,
    TiltedTiles,
    bracket_cuts,
    find_critical_points,
    integrate_tiles,
    tile_rows,
    tiles_of_curves,
    tiles_subset,
    tilt_tiles,
)
from assoc_hull.geometry.numeric.dual import is_plain, real
from assoc_hull.geometry.numeric.quadrature import lobatto

__all__ = [
    "DECK",
    "KEEL",
    "LEVEL",
    "CurveStates",
    "Inclination",
    "PreparedStrips",
    "StateBrackets",
    "curve_batches",
    "curve_states",
    "cut_counts",
    "find_state_changes",
    "inspect_strips",
    "join_brackets",
    "prepare_strips",
    "rounding_flickers",
    "strip_states",
]

# --------------------------------------------------------------------------------------
# Strips made ready for floating planes: the curves of the rule along v, integrated.

LEVEL = 1e-9
"""Of a strip's depth: so much is no slope."""

POINT = 1e-9
"""m: a strip that is not higher is but a point, such as a part right at the end of a ship."""

MORE = 6  # points of the rule where something happens, beyond those where nothing does


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
    tiles : CurveTiles
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
        return np.where(depth > POINT, depth, 1.0)

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
        """Say which points belong to an edge that is level along the strip, as most keels are.

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
        By how much to raise the order along v: results of two orders show the error of one.
    plain : Strips or None
        The body in plain numbers, if `strips` gives others: decisions look at these.

    Returns
    -------
    PreparedStrips
        What `integrate_immersed` cuts.

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
    fine = order + MORE
    whole = _weighted(tiles, weight, heeled=False)
    known = strips if plain is None else plain
    return PreparedStrips(strips, fine, strip, v, weight, tiles, known, whole)


def _weighted(tiles: CurveTiles, weight: FloatArray, heeled: bool) -> FloatArray:
    whole = integrate_tiles(tiles.coefficients, tiles.deck, tiles.lean, heeled)
    return whole * np.take(weight, tiles.curve)


# --------------------------------------------------------------------------------------
# Of what kind the immersed part of a curve is, and where along a strip the kind changes.
#
# A state is a number made of whether keel, end and deck's edge are wet and how often the curve is
# cut. It is found for the curves of the plain rule, and for curves anywhere along a strip. Between
# two curves of different states the place of the change is bracketed, many at once. Decisions are
# taken on plain numbers.

Inclination = tuple[FloatArray, FloatArray]
"""Tangents of trim and heel, (1,) each, plain."""

# Parts of a state: deck and keel are wet; the number of cuts, below 256; the deck's edge is wet.
DECK, KEEL, _CUT, _EDGE = 1, 2, 4, 1024

_CURVES = 256  # at a time: memory that stays in the processor's cache is several times faster
POINTS = 14  # of a curve that are looked at


@attrs.frozen(eq=False)
class CurveStates:
    """Curves as seen from planes, all of n.

    Attributes
    ----------
    state : (n,) int
        As from `curve_states`.
    over : (n, 14), m
        Heights over the plane: of the beginning, the end, and all critical points of the
        curve by height; infinite where there are no more.
    """

    state: IntArray
    over: FloatArray


def curve_states(
    tiles: CurveTiles, tilted: TiltedTiles, curve: IntArray, level: FloatArray, times: IntArray
) -> IntArray:
    """Give the state of each curve below its level (m), given how often it is cut there.

    All are of one shape. A state holds that number, and whether keel, end and deck's edge are wet.
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
    """Say of neighbouring curves, pair (2, n), whether their states differ only by rounding, (n,).

    So it is where keel, end or deck's edge of both lie within `least` (m) of the plane, and no
    other bit of `change` is set but for the cuts that come with them.
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
    """Give from states how often curves are cut."""
    return state % _EDGE // _CUT


def curve_batches(
    strips: Strips, strip: IntArray, v: FloatArray, plain: bool = False
) -> Iterator[tuple[IntArray, IntArray, CurveTiles]]:
    """Yield tiles of the curves asked for, each curve once, not too many at a time.

    With them go the rows of the n questions that they answer, and for each of these rows which
    curve of the tiles it is. With `plain` the curves lose their derivatives: for decisions.
    """
    if is_plain(v):
        # v is 1 at most, so the keys of two strips never agree.
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
    """Give the states of curves anywhere: strip and v (n,), below levels (n,), m."""
    state = np.zeros(len(v), np.int64)
    for rows, curve, tiles in curve_batches(strips, strip, v, plain=True):
        state[rows] = _state(tiles, tilt_tiles(tiles, *inclination), curve, level[rows])
    return state


def inspect_strips(
    strips: Strips, inclination: Inclination, strip: IntArray, v: FloatArray, level: FloatArray
) -> CurveStates:
    """Do as `strip_states`, and give how far the points that decide are from the planes."""
    state, over = np.zeros(len(v), np.int64), np.full((len(v), POINTS), np.inf)
    for rows, curve, tiles in curve_batches(strips, strip, v, plain=True):
        tilted = tilt_tiles(tiles, *inclination)
        state[rows] = _state(tiles, tilted, curve, level[rows])
        over[rows] = _heights(tiles, tilted)[curve] - level[rows, None]
    return CurveStates(state, over)


def _state(tiles: CurveTiles, tilted: TiltedTiles, curve: IntArray, level: FloatArray) -> IntArray:
    """Give the states of pairs of a curve and a level."""
    tile, row = tile_rows(tiles, curve)
    at = level[row]
    hit = np.flatnonzero((tilted.low[tile] <= at) & (tilted.high[tile] > at))
    found = bracket_cuts(tilted, tile[hit], at[hit])
    times = np.bincount(row[hit[found.pair]], minlength=len(curve))
    return curve_states(tiles, tilted, curve, level, times)


def _heights(tiles: CurveTiles, tilted: TiltedTiles) -> FloatArray:
    """Give the heights of the points of `CurveStates.over`, (k, 14)."""
    points = find_critical_points(tiles, tilted)
    order = np.lexsort((points.height, points.curve))
    curve = points.curve[order]
    rank = np.arange(len(order)) - np.searchsorted(curve, curve) + 2
    kept = np.flatnonzero(rank < POINTS)
    height = np.full((tiles.curves, POINTS), np.inf)
    height[:, 0] = tilted.control[0][tiles.start[:-1]]
    height[:, 1] = tilted.control[3][tiles.start[1:] - 1]
    height[curve[kept], rank[kept]] = points.height[order[kept]]
    return height


# --------------------------------------------------------------------------------------
# Where along strips the immersed part changes its kind: bracketed, many at once.

CLOSE = 1e-10  # of a strip: integrals go with its power 3/2, extents with its square
TRIALS = 60
SEVERAL = 6  # changes between two neighbouring curves, at most


@attrs.frozen(eq=False)
class StateBrackets:
    """Pairs of places on a strip at which the immersed part is of two kinds, all (n,).

    Attributes
    ----------
    row : int
        The caller's key.
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
    """Find all places in brackets at which the state changes; they come closed but for rounding.

    There are more of them than were given where several changes lie between two curves.
    """
    found = [brackets.take(np.zeros(0, np.int64))]
    for _ in range(SEVERAL):
        if not len(brackets):
            break
        close = _close_brackets(strips, inclination, brackets)
        found.append(close)
        more = np.flatnonzero((close.above != brackets.above) & (close.high < brackets.high))
        brackets = attrs.evolve(brackets.take(more), low=close.high[more], below=close.above[more])
    return join_brackets(*found)


def _close_brackets(
    strips: Strips, inclination: Inclination, brackets: StateBrackets
) -> StateBrackets:
    """Close each bracket on the first change of state that is seen."""
    v = np.stack([brackets.low, brackets.high], axis=1)
    above = brackets.above.copy()
    strip, level = np.repeat(brackets.strip, 2), np.repeat(brackets.level, 2)
    over = inspect_strips(strips, inclination, strip, v.ravel(), level).over.reshape(len(v), 2, -1)
    for _ in range(TRIALS):
        alive = np.flatnonzero(v[:, 1] - v[:, 0] > CLOSE)
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
    half_width = np.where(chord, np.minimum(0.25, 0.25 * length + 0.3 * CLOSE / length), 0.25)
    before = np.clip(share - half_width, 0.25 * share, None)
    after = np.clip(share + half_width, None, share + 0.75 * (1.0 - share))
    far = np.where(share > 0.5, 0.5 * before, 0.5 * (1.0 + after))
    far = np.where(chord, far, 0.5)
    inside = np.sort(np.stack([before, after, far], axis=1), axis=1)
    trial: FloatArray = v[:, :1] + length[:, None] * inside
    return trial
