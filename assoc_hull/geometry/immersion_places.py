"""Where along strips the immersed part changes its kind: bracketed, many at once."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.immersion_critical import critical
from assoc_hull.geometry.immersion_roots import Tilted, mixed, tilt
from assoc_hull.geometry.immersion_roots import brackets as changes
from assoc_hull.geometry.immersion_tiles import Tiles, from_curves
from assoc_hull.geometry.isocurves import Strips

__all__ = ["CLOSE", "Brackets", "joined", "places", "states", "states_at"]

CLOSE = 1e-12
"""Of a strip: how exactly a place is wanted, and the least distance between two."""

_TRIALS = 60
_SEVERAL = 6  # changes between two neighbouring curves, at most
_DECK, _KEEL, _CUT, _EDGE = 1, 2, 4, 1024


@attrs.frozen(eq=False)
class Brackets:
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

    def take(self, rows: IntArray) -> Brackets:
        """Take some."""
        return Brackets(*(each[rows] for each in attrs.astuple(self, recurse=False)))


def places(strips: Strips, trim: FloatArray, heel: FloatArray, brackets: Brackets) -> Brackets:
    """Find all places at which the state changes.

    Parameters
    ----------
    strips : Strips
        The body.
    trim, heel : (1,)
        Inclination of the planes, plain.
    brackets : Brackets
        Where to look.

    Returns
    -------
    Brackets
        As close as `CLOSE`; more of them than were given where several changes lie
        between two curves.
    """
    found = []
    for _ in range(_SEVERAL):
        if not len(brackets):
            break
        close = _closed(strips, trim, heel, brackets)
        found.append(close)
        more = np.flatnonzero((close.above != brackets.above) & (close.high < brackets.high))
        brackets = attrs.evolve(brackets.take(more), low=close.high[more], below=close.above[more])
    return joined(*found) if found else brackets


def joined(*several: Brackets) -> Brackets:
    """Put brackets behind one another."""
    fields = zip(*(attrs.astuple(each, recurse=False) for each in several), strict=True)
    return Brackets(*(np.concatenate(parts) for parts in fields))


def states_at(
    strips: Strips,
    inclination: tuple[FloatArray, FloatArray],
    strip: IntArray,
    v: FloatArray,
    level: FloatArray,
) -> IntArray:
    """Tell the states of curves across strips.

    Parameters
    ----------
    strips : Strips
        The body.
    inclination : (1,), (1,)
        Tangents of trim and heel, plain.
    strip, v : (k,) int, (k,)
        Which curves.
    level : (k,), m
        Height of the plane for each.

    Returns
    -------
    (k,) int
        Their `states`.
    """
    tiles = from_curves(strips.curves(strip, v))
    return _seen(tiles, tilt(tiles, *inclination), level)


def _seen(tiles: Tiles, tilted: Tilted, level: FloatArray) -> IntArray:
    """Tell the state of each curve, for a level of its own."""
    ground = level[tiles.curve]
    tile = mixed(tilted, ground)
    found = changes(tilted, tile, ground[tile])
    curve = tiles.curve[tile[found.pair]]
    state: IntArray = states(tiles, tilted, level[None], 0 * curve, curve)[0]
    return state


def _closed(strips: Strips, trim: FloatArray, heel: FloatArray, brackets: Brackets) -> Brackets:
    """Close each bracket on the first change of state that is seen."""
    kind = np.where(brackets.below != brackets.above, brackets.below ^ brackets.above, 0)
    low, high, above = brackets.low.copy(), brackets.high.copy(), brackets.above.copy()
    ends = np.stack([low, high], axis=1)
    row = np.repeat(np.arange(len(low)), 2)
    _, miss = _look(strips, trim, heel, brackets.take(row), kind[row], ends.ravel())
    miss = miss.reshape(-1, 2)
    for _ in range(_TRIALS):
        alive = np.flatnonzero(high - low > CLOSE)
        if not len(alive):
            break
        trial = _trials(low[alive], high[alive], miss[alive])
        row = np.repeat(alive, 3)
        seen, off = _look(strips, trim, heel, brackets.take(row), kind[row], trial.ravel())
        same = seen.reshape(-1, 3) == brackets.below[alive, None]
        kept = np.cumprod(same, axis=1).sum(axis=1)
        edges = np.concatenate([low[alive, None], trial, high[alive, None]], axis=1)
        kinds = np.concatenate([seen.reshape(-1, 3), above[alive, None]], axis=1)
        misses = np.concatenate([miss[alive, :1], off.reshape(-1, 3), miss[alive, 1:]], axis=1)
        each = np.arange(len(alive))
        low[alive], high[alive] = edges[each, kept], edges[each, kept + 1]
        above[alive] = kinds[each, kept]
        miss[alive] = np.stack([misses[each, kept], misses[each, kept + 1]], axis=1)
    return attrs.evolve(brackets, low=low, high=high, above=above)


def _trials(low: FloatArray, high: FloatArray, miss: FloatArray) -> FloatArray:
    """Give three places in each bracket: two about where the chord says, one far from it.

    The chord errs by the square of the bracket's length; so if the two enclose the place,
    the digits double. Without a chord, quarters.
    """
    length = high - low
    one, other = miss[:, 0], miss[:, 1]
    chord = one * other < 0.0
    share = np.where(chord, one / np.where(chord, one - other, 1.0), 0.5)
    half_width = np.where(chord, np.minimum(0.25, 0.25 * length + 0.3 * CLOSE / length), 0.25)
    before = np.clip(share - half_width, 0.25 * share, None)
    after = np.clip(share + half_width, None, share + 0.75 * (1.0 - share))
    far = np.where(share > 0.5, 0.5 * before, 0.5 * (1.0 + after))
    far = np.where(chord, far, 0.5)
    inside = np.sort(np.stack([before, after, far], axis=1), axis=1)
    trial: FloatArray = low[:, None] + length[:, None] * inside
    return trial


def _look(
    strips: Strips,
    trim: FloatArray,
    heel: FloatArray,
    brackets: Brackets,
    kind: IntArray,
    v: FloatArray,
) -> tuple[IntArray, FloatArray]:
    """Tell the state of one curve for each bracket, and by what height it misses a change."""
    tiles = from_curves(strips.curves(brackets.strip, v))
    tilted = tilt(tiles, trim, heel)
    state = _seen(tiles, tilted, brackets.level)
    return state, _miss(tiles, tilted, brackets.level, kind)


def _miss(tiles: Tiles, tilted: Tilted, level: FloatArray, kind: IntArray) -> FloatArray:
    """Give the height over the plane of the point at which the state is about to change."""
    keel = tilted.control[0][tiles.start[:-1]] - level
    deck = tilted.control[3][tiles.start[1:] - 1] - level
    miss: FloatArray = np.where(kind & _KEEL, keel, deck)
    inner = (kind & (_KEEL | _DECK)) == 0
    if not inner.any():
        return miss
    points = critical(tiles, tilted)
    over = points.height - level[points.curve]
    nearest = np.lexsort((np.abs(over), points.curve))
    first = np.searchsorted(points.curve[nearest], np.arange(tiles.curves))
    miss = np.where(inner, over[nearest[first]], miss)
    return miss


def states(
    tiles: Tiles, tilted: Tilted, level: FloatArray, row: IntArray, curve: IntArray
) -> IntArray:
    """Tell of what kind the immersed part of each curve is.

    Parameters
    ----------
    tiles, tilted : Tiles, Tilted
        k curves.
    level : (r, 1) or (r, k), m
        Levels.
    row, curve : (c,) int
        Level and curve of each cut.

    Returns
    -------
    (r, k) int
        A number made of how often the curve is cut, whether keel and deck end are wet, and
        the deck's edge is.
    """
    rows, count = len(level), tiles.curves
    times = np.bincount(row * count + curve, minlength=rows * count).reshape(rows, count)
    keel = tilted.control[0][tiles.start[:-1]] <= level
    deck = tilted.control[3][tiles.start[1:] - 1] <= level
    state: IntArray = _CUT * times + _KEEL * keel + _DECK * deck
    if len(tiles.edge):
        owner = tiles.curve[tiles.edge]
        at = level[:, owner] if level.shape[1] > 1 else level
        one, edge = np.nonzero(tilted.control[0][tiles.edge] <= at)
        wet = np.bincount(one * count + owner[edge], minlength=rows * count)
        state = state + _EDGE * wet.reshape(rows, count)
    return state
