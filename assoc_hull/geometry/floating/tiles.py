"""Tiles of curves across a hull: what each contributes, and where floating planes cut it.

A tile is a cubic P(u) with a cubic P_v(u), u from 0 to 1. With the normal ``N = P_u x P_v``
it contributes to a volume ``int y N_y du``: the divergence theorem with the flux along y,
which neither the centre plane nor a plane without heel sees. Below a plane with heel the flux
runs along the direction (0, 1, -tan_heel) in that plane, which takes integrals with N_z, too:
``int y (N_y - tan_heel N_z) du``. So no integral over the waterplane enters a volume, and the
derivative of a volume by the plane's height is the waterplane's area curve by curve.

Six Gauss points integrate every such product of cubics without error (degree 11), and also
the part of a tile from 0 to a cut. Areas are not polynomial: the same six points are accurate
for them, as tiles are short.

Most curves are sections: x and x_v are the same all along. Then N_y is x_v z_u, and half of
the work can be left out.

Where floating planes cut tiles, and the critical points at which cuts appear or end.

Over planes of one inclination the height of a tile, ``q = z - tan_trim x + tan_heel y``, is one
cubic, and a plane is a level of q. A tile ends at the level at which the next one of its curve
begins, to the last bit: so two tiles never disagree whether the point they share is wet. A point
on a plane is wet: every integral is the limit for a level that comes down from above. As a plane
rises past a critical point of a curve, a piece of its section appears or ends.
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, IsoCurves
from assoc_hull.geometry.numeric.dual import (
    combine_rows,
    differs_from_zero,
    is_plain,
    real,
    safe_sqrt,
)
from assoc_hull.geometry.numeric.polynomials import (
    bracketed_roots,
    cubic_values,
    stationary_fractions,
)
from assoc_hull.geometry.numeric.quadrature import gauss

__all__ = [
    "CHUNK",
    "HEELED",
    "PLAIN",
    "CriticalPoints",
    "CurveTiles",
    "TileCuts",
    "TiltedTiles",
    "bracket_cuts",
    "candidate_pairs",
    "critical_points_at",
    "cubic_powers",
    "cut_tiles",
    "find_critical_points",
    "integrate_tiles",
    "nearest_critical_point",
    "stationary_heights",
    "tile_rows",
    "tiles_of_curves",
    "tiles_subset",
    "tilt_tiles",
]

CHUNK = 2048
"""Tiles or cuts at a time, so that the work on them stays in the processor's cache."""

PLAIN, HEELED = 7, 11
"""Rows of `integrate_tiles`: y N_y, x y N_y, y^2/2 N_y, y z N_y; |N| and girth but on deck, |N| on
deck; with heel the first four once more, with N_z."""

_POINTS = 6  # exact to degree 11

_NODES, _WEIGHTS = gauss(_POINTS)
_VALUE = _NODES[:, None] ** np.arange(4)
_SLOPE = np.arange(4) * _NODES[:, None] ** np.maximum(np.arange(4) - 1, 0)
_BOTH = np.concatenate([_VALUE, _SLOPE])


@attrs.frozen(eq=False)
class CurveTiles:
    """Tiles of k curves, tile by tile from keel to deck, curve by curve.

    Attributes
    ----------
    coefficients : (6, 4, s), m
        Of x, y, z, x_v, y_v, z_v in 1, u, u^2, u^3.
    curve : (s,) int
        The curve of each tile.
    start : (k + 1,) int
        Where the tiles of each curve begin.
    deck : (s,) bool
        The tile is closed deck.
    lean : (s,) bool
        x or x_v are not the same all along the tile.
    edge : (k,) int
        The tile with which the closed deck of each curve begins; -1 where there is none.
    """

    coefficients: FloatArray
    curve: IntArray
    start: IntArray
    deck: NDArray[np.bool_]
    lean: NDArray[np.bool_]
    edge: IntArray

    @property
    def curves(self) -> int:
        """Number of curves."""
        return len(self.start) - 1


def cubic_powers(u: FloatArray) -> FloatArray:
    """Give 1, u, u^2, u^3 as rows, (4, k)."""
    square = u * u
    return np.stack([1.0 + 0.0 * u, u, square, square * u])


def tiles_of_curves(curves: IsoCurves) -> CurveTiles:
    """Lay out the tiles of curves for work on many at once."""
    # Row by row in memory: all that follows runs along rows.
    both = (curves.point, curves.across)
    rows = [each[:, power, axis] for each in both for axis in range(3) for power in range(4)]
    coefficients = np.stack(rows).reshape(6, 4, -1)
    owner = np.repeat(np.arange(curves.count), np.diff(curves.start))
    lean = np.asarray(differs_from_zero(coefficients[0::3, 1:]).any(axis=(0, 1)))
    edge = _edges(curves.deck, owner, curves.count)
    return CurveTiles(coefficients, owner, curves.start, curves.deck, lean, edge)


def tile_rows(tiles: CurveTiles, curve: IntArray) -> tuple[IntArray, IntArray]:
    """List the tiles of curves (n,), which may be repeated, and to which of the n each belongs."""
    sizes = tiles.start[curve + 1] - tiles.start[curve]
    begin = np.cumsum(sizes) - sizes
    row = np.repeat(np.arange(len(curve)), sizes)
    return np.arange(len(row)) + (tiles.start[curve] - begin)[row], row


def tiles_subset(tiles: CurveTiles, curve: IntArray) -> CurveTiles:
    """Give the tiles of curves (n,), in that order."""
    rows, owner = tile_rows(tiles, curve)
    start = np.searchsorted(owner, np.arange(len(curve) + 1))
    deck = tiles.deck[rows]
    return CurveTiles(
        np.take(tiles.coefficients, rows, axis=2),
        owner,
        start,
        deck,
        tiles.lean[rows],
        _edges(deck, owner, len(curve)),
    )


def integrate_tiles(
    coefficients: FloatArray, deck: NDArray[np.bool_], lean: NDArray[np.bool_], heeled: bool
) -> FloatArray:
    """Integrate over tiles, (6, 4, k), or over parts of them that are given as tiles.

    The result is (7, k), or (11, k) if integrals with N_z are wanted (`heeled`): the rows `PLAIN`
    or `HEELED`, per unit of v.
    """
    if len(deck) > CHUNK:
        parts = [slice(i, i + CHUNK) for i in range(0, len(deck), CHUNK)]
        done = [
            integrate_tiles(coefficients[..., some], deck[some], lean[some], heeled)
            for some in parts
        ]
        return np.concatenate(done, axis=1)
    sums = (_general if lean.any() else _sections)(coefficients, heeled)
    # A deck bounds the volume, and is no shell.
    size, girth = sums[4:6]
    return np.stack([*sums[:4], size * ~deck, girth * ~deck, size * deck, *sums[6:]])


def _sections(coefficients: FloatArray, heeled: bool) -> list[FloatArray]:
    """Integrate over tiles of constant x and x_v."""
    (y, z), (y_u, z_u) = _values_slopes(coefficients[1:3])
    y_v, z_v = combine_rows(_VALUE, coefficients[4:])
    x, x_v = coefficients[0, 0], coefficients[3, 0]
    flux, stretch = y * z_u, y_u * y_u + z_u * z_u
    n_x = y_u * z_v - z_u * y_v
    volume = x_v * combine_rows(_WEIGHTS, flux)
    sums = [
        volume,
        x * volume,
        0.5 * x_v * combine_rows(_WEIGHTS, y * flux),
        x_v * combine_rows(_WEIGHTS, z * flux),
        combine_rows(_WEIGHTS, safe_sqrt(n_x * n_x + (x_v * x_v) * stretch)),
        np.where(real(x_v) < 0.0, -x_v, x_v) * combine_rows(_WEIGHTS, safe_sqrt(stretch)),
    ]
    if heeled:
        rise = y * y_u
        volume = -x_v * combine_rows(_WEIGHTS, rise)
        sums += [volume, x * volume, -0.5 * x_v * combine_rows(_WEIGHTS, y * rise)]
        sums.append(-x_v * combine_rows(_WEIGHTS, z * rise))
    return sums


def _general(coefficients: FloatArray, heeled: bool) -> list[FloatArray]:
    """Integrate over any tiles."""
    (x, y, z), (x_u, y_u, z_u) = _values_slopes(coefficients[:3])
    x_v, y_v, z_v = combine_rows(_VALUE, coefficients[3:])
    n_x, n_y, n_z = y_u * z_v - z_u * y_v, z_u * x_v - x_u * z_v, x_u * y_v - y_u * x_v
    flux, round_about = y * n_y, n_y * n_y + n_z * n_z
    size = safe_sqrt(n_x * n_x + round_about)
    values = [flux, x * flux, 0.5 * y * flux, z * flux, size, safe_sqrt(round_about)]
    if heeled:
        flux = y * n_z
        values += [flux, x * flux, 0.5 * y * flux, z * flux]
    return [combine_rows(_WEIGHTS, each) for each in values]


def _values_slopes(point: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Give values and slopes at the Gauss points, (c, 6, k) each, of cubics (c, 4, k)."""
    both = combine_rows(_BOTH, point)
    return both[:, :_POINTS], both[:, _POINTS:]


def _edges(deck: NDArray[np.bool_], curve: IntArray, count: int) -> IntArray:
    """Find the tiles with which decks begin."""
    tile = np.flatnonzero(deck[1:] & ~deck[:-1] & (curve[1:] == curve[:-1])) + 1
    edge = np.full(count, -1)
    edge[curve[tile]] = tile
    return edge


_LEAST = 1e-8
"""Cuts with derivatives are kept so far from the beginning of a tile: the area of the part up to
them is the root of a square, which at zero has no derivative, though the area has one."""


@attrs.frozen(eq=False)
class TiltedTiles:
    """Heights of tiles over the planes of one inclination.

    Attributes
    ----------
    trim, heel : (1,)
        Tangents of the inclination.
    height : (4, s), m
        Power coefficients of q.
    control : (4, s), m
        Bernstein coefficients of q as plain numbers; the last is the first of the next tile.
    low, high : (s,), m
        Least and greatest of these.
    wavy : (s,) bool
        By these the tile may run up and down.
    """

    trim: FloatArray
    heel: FloatArray
    height: FloatArray
    control: FloatArray
    low: FloatArray
    high: FloatArray
    wavy: NDArray[np.bool_]

    @property
    def heeled(self) -> bool:
        """There is heel, or a derivative by it is wanted."""
        return not is_plain(self.heel) or bool(self.heel[0] != 0.0)


@attrs.frozen(eq=False)
class SignChanges:
    """Parts of tiles with one change of sign each, all (k,).

    Attributes
    ----------
    pair : int
        Index into the pairs of a tile and a level that were given.
    low, high : from 0 to 1
        Ends of the part on the tile.
    at_low, at_high : m
        Heights over the level there; one is positive, the other is not.
    """

    pair: IntArray
    low: FloatArray
    high: FloatArray
    at_low: FloatArray
    at_high: FloatArray


@attrs.frozen(eq=False)
class TileCuts:
    """Points at which a tile passes from one side of a plane to the other.

    Attributes
    ----------
    pair : (k,) int
        Index into the pairs of a tile and a level that were given.
    u : (k,)
        Parameter on the tile, from 0 to 1.
    sign : (k,)
        1 where the tile leaves the water with growing u, -1 where it goes in.
    """

    pair: IntArray
    u: FloatArray
    sign: FloatArray


def tilt_tiles(tiles: CurveTiles, trim: FloatArray, heel: FloatArray) -> TiltedTiles:
    """Measure tiles over planes whose tangents of inclination are trim and heel, (1,) each."""
    x, y, z = tiles.coefficients[:3]
    height = z
    if real(trim)[0] != 0.0 or not is_plain(trim):
        height = height - trim * x
    if real(heel)[0] != 0.0 or not is_plain(heel):
        height = height + heel * y
    first, second, third, fourth = real(height)
    control = np.empty((4, len(first)))
    control[0] = first
    np.add(first, second / 3.0, out=control[1])
    np.add(control[1], (second + third) / 3.0, out=control[2])
    # The first of the next tile, not the sum of the own coefficients: neighbours agree to the bit.
    control[3, :-1] = first[1:]
    last = tiles.start[1:] - 1
    control[3, last] = first[last] + second[last] + third[last] + fourth[last]
    low = np.minimum(np.minimum(control[0], control[1]), np.minimum(control[2], control[3]))
    high = np.maximum(np.maximum(control[0], control[1]), np.maximum(control[2], control[3]))
    one, two, three = control[1:] - control[:-1]
    falls, rises = (
        (one < 0.0) | (two < 0.0) | (three < 0.0),
        (one > 0.0) | (two > 0.0) | (three > 0.0),
    )
    return TiltedTiles(trim, heel, height, control, low, high, falls & rises)


def candidate_pairs(tilted: TiltedTiles, levels: FloatArray) -> tuple[IntArray, IntArray]:
    """Find pairs of a tile and a level that may intersect, (p,) each; levels (d,), m, ascend."""
    if len(levels) == 1:
        tile = np.flatnonzero((tilted.low <= levels[0]) & (tilted.high > levels[0]))
        return tile, np.zeros(len(tile), np.int64)
    first = np.searchsorted(levels, tilted.low)
    count = np.searchsorted(levels, tilted.high) - first
    tile = np.repeat(np.arange(len(count)), count)
    before = np.cumsum(count) - count
    return tile, np.arange(len(tile)) + (first - before)[tile]


def stationary_heights(tilted: TiltedTiles, tile: IntArray) -> tuple[FloatArray, FloatArray]:
    """Give u where tiles (p,) may have their least or greatest height inside, lower and upper.

    As in `stationary_fractions`, 0 and 1 stand for nowhere.
    """
    _, first, second, third = np.take(real(tilted.height), tile, axis=1)
    return stationary_fractions(first, second, third)


def bracket_cuts(tilted: TiltedTiles, tile: IntArray, level: FloatArray) -> SignChanges:
    """Bracket all changes of sign of tiles (p,) over levels (p,), m, plain.

    In each bracket the height of the tile only rises or only falls.
    """
    control = np.take(tilted.control, tile, axis=1) - level
    wave = tilted.wavy[tile]
    through = np.flatnonzero(~wave & ((control[0] <= 0.0) != (control[3] <= 0.0)))
    none = np.zeros(len(through))
    plain = SignChanges(through, none, none + 1.0, control[0][through], control[3][through])
    rest = np.flatnonzero(wave)
    if not len(rest):
        return plain
    split = _bracket_wavy(tilted, tile[rest], level[rest], control[:, rest])
    others = (rest[split.pair], split.low, split.high, split.at_low, split.at_high)
    both = zip(attrs.astuple(plain, recurse=False), others, strict=True)
    return SignChanges(*(np.concatenate(each) for each in both))


def cut_tiles(tilted: TiltedTiles, tile: IntArray, level: FloatArray) -> TileCuts:
    """Cut tiles (p,) at levels (p,), m: every change of sign, in the arithmetic of the heights."""
    found = bracket_cuts(tilted, tile, real(level))
    tile, level = tile[found.pair], np.take(level, found.pair)
    cubic = np.take(real(tilted.height), tile, axis=1)
    cubic[0] -= real(level)
    start = _parabola_start(cubic, found)
    u = bracketed_roots(cubic, found.low, found.high, found.at_low, found.at_high, start)
    sign = np.where(found.at_low <= 0.0, 1.0, -1.0)
    return TileCuts(found.pair, _roots_with_derivatives(tilted, tile, level, u), sign)


def _bracket_wavy(
    tilted: TiltedTiles, tile: IntArray, level: FloatArray, control: FloatArray
) -> SignChanges:
    """Bracket changes of sign between the stationary heights of tiles."""
    origin, first, second, third = np.take(real(tilted.height), tile, axis=1)
    lower, upper = stationary_fractions(first, second, third)
    below = origin - level
    at_lower = np.where(lower > 0.0, cubic_values(below, first, second, third, lower), control[0])
    at_upper = np.where(upper < 1.0, cubic_values(below, first, second, third, upper), control[3])
    edge = np.stack([0.0 * lower, lower, upper, 0.0 * lower + 1.0])
    height = np.stack([control[0], at_lower, at_upper, control[3]])
    wet = height <= 0.0
    pair, part = np.nonzero((wet[1:] != wet[:-1]).T)
    return SignChanges(
        pair, edge[part, pair], edge[part + 1, pair], height[part, pair], height[part + 1, pair]
    )


def _parabola_start(cubic: FloatArray, found: SignChanges) -> FloatArray:
    """Start at the root of the parabola through both ends and the middle.

    Tiles that begin level, as most do at the keel, have nearly parabolas for heights: from a
    chord the steps would take long.
    """
    origin, first, second, third = cubic
    length = found.high - found.low
    middle = cubic_values(origin, first, second, third, found.low + 0.5 * length)
    rise = found.at_high - found.at_low
    bend = 2.0 * (found.at_low + found.at_high - 2.0 * middle)
    begin = rise - bend
    under = np.sqrt(np.maximum(begin * begin - 4.0 * bend * found.at_low, 0.0))
    slope = begin + np.copysign(under, rise)
    steep = slope * rise > 0.0
    share = np.where(steep, -2.0 * found.at_low / np.where(steep, slope, 1.0), 0.5)
    start: FloatArray = found.low + length * np.clip(share, 0.0, 1.0)
    return start


def _roots_with_derivatives(
    tilted: TiltedTiles, tile: IntArray, level: FloatArray, u: FloatArray
) -> FloatArray:
    """Carry derivatives through roots that were found among plain numbers."""
    height = tilted.height
    if is_plain(height) and is_plain(level):
        return u
    first, second, third, fourth = np.take(height, tile, axis=1)
    above = first - level + u * (second + u * (third + u * fourth))
    slope = second + u * (2.0 * third + u * (3.0 * fourth))
    # The value of the residual is rounding: only its derivative is wanted.
    steep = np.abs(real(slope)) > 0.0
    change = (above - real(above)) / np.where(steep, slope, 1.0)
    return np.where(u < _LEAST, _LEAST, u) - np.where(steep, change, 0.0)


# --------------------------------------------------------------------------------------
# Critical points of curves: where, as a plane rises, a piece of a section appears or ends.

_LEVEL = 1e-9
"""m: a height that bends less along a tile has no turn whose derivative could be given."""


@attrs.frozen(eq=False)
class CriticalPoints:
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

    def take(self, rows: IntArray) -> CriticalPoints:
        """Take some of the points."""
        return CriticalPoints(
            self.curve[rows],
            np.take(self.height, rows),
            np.take(self.change, rows),
            np.take(self.place, rows, axis=1),
            np.take(self.rate, rows, axis=1),
        )


def find_critical_points(tiles: CurveTiles, tilted: TiltedTiles) -> CriticalPoints:
    """Find ends of curves, the deck's edge, and where heights are stationary along curves."""
    return critical_points_at(tiles, tilted, *_critical_parameters(tiles, tilted))


def critical_points_at(
    tiles: CurveTiles, tilted: TiltedTiles, tile: IntArray, u: FloatArray
) -> CriticalPoints:
    """Give points of tiles, tile and u (n,) each, as critical ones."""
    origin, first, second, third = np.take(tilted.height, tile, axis=1)
    height = cubic_values(origin, first, second, third, u)
    both = (np.take(tiles.coefficients, tile, axis=2) * cubic_powers(u)).sum(axis=1)
    change = both[5] - tilted.trim * both[3] + tilted.heel * both[4]
    return CriticalPoints(tiles.curve[tile], height, change, both[:2], both[3:5])


def _critical_parameters(tiles: CurveTiles, tilted: TiltedTiles) -> tuple[IntArray, FloatArray]:
    """Give tile and u of the critical points."""
    control = tilted.control
    into, out = control[3, :-1] - control[2, :-1], control[1, 1:] - control[0, 1:]
    turn = np.flatnonzero((into * out < 0.0) & (tiles.curve[1:] == tiles.curve[:-1])) + 1
    wave = np.flatnonzero(tilted.wavy)
    lower, upper = stationary_heights(tilted, wave)
    low, high = lower > 0.0, upper < 1.0
    begin, end = tiles.start[:-1], tiles.start[1:] - 1
    knots = np.concatenate([begin, tiles.edge[tiles.edge >= 0], turn])
    tile = np.concatenate([knots, end, wave[low], wave[high]])
    inner = np.concatenate([lower[low], upper[high]])
    turns_at = _turns_with_derivatives(tilted, tile[len(knots) + len(end) :], inner)
    return tile, np.concatenate([np.zeros(len(knots)), np.ones(len(end)), turns_at])


def _turns_with_derivatives(tilted: TiltedTiles, tile: IntArray, u: FloatArray) -> FloatArray:
    """Carry derivatives through stationary parameters that were found among plain numbers."""
    if is_plain(tilted.height):
        return u
    _, first, second, third = np.take(tilted.height, tile, axis=1)
    slope = first + u * (2.0 * second + u * (3.0 * third))
    bend = real(2.0 * second + 6.0 * u * third)
    clear = np.abs(bend) > _LEVEL
    return u - np.where(clear, (slope - real(slope)) / np.where(clear, bend, 1.0), 0.0)


def nearest_critical_point(points: CriticalPoints, level: FloatArray, curves: int) -> IntArray:
    """Give for each of so many curves the index of its critical point nearest to its level.

    Levels are (curves,), m, plain; the result is (curves,) int, into `points`.
    """
    over = np.abs(real(points.height) - level[points.curve])
    order = np.lexsort((over, points.curve))
    found: IntArray = order[np.searchsorted(points.curve[order], np.arange(curves))]
    return found
