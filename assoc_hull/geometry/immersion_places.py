"""Where along strips the immersed part changes its kind: bracketed, many at once."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.immersion_roots import Tilted, cuts, tilt
from assoc_hull.geometry.immersion_tiles import Tiles, from_curves
from assoc_hull.geometry.isocurves import Strips

__all__ = ["CLOSE", "Brackets", "places", "states"]

CLOSE = 1e-11
"""Of a strip: how exactly a place is wanted, and the least distance between two."""

_TRIALS = 60
_SEVERAL = 6  # changes between two neighbouring curves, at most
_CUT, _KEEL, _KNUCKLE = 4, 2, 1024


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
    merged = zip(*(attrs.astuple(each, recurse=False) for each in found), strict=True)
    return Brackets(*(np.concatenate(parts) for parts in merged)) if found else brackets


def _closed(strips: Strips, trim: FloatArray, heel: FloatArray, brackets: Brackets) -> Brackets:
    """Close each bracket on the first change of state that is seen."""
    low, high, above = brackets.low.copy(), brackets.high.copy(), brackets.above.copy()
    quarters = np.array([0.25, 0.5, 0.75])
    for _ in range(_TRIALS):
        alive = np.flatnonzero(high - low > CLOSE)
        if not len(alive):
            break
        begin, end = low[alive, None], high[alive, None]
        trial = begin + (end - begin) * quarters
        some = brackets.take(np.repeat(alive, 3))
        seen = _state_at(strips, trim, heel, some, trial.ravel()).reshape(-1, 3)
        kept = np.cumprod(seen == brackets.below[alive, None], axis=1).sum(axis=1)
        edges = np.concatenate([begin, trial, end], axis=1)
        kinds = np.concatenate([seen, above[alive, None]], axis=1)
        row = np.arange(len(alive))
        low[alive], high[alive] = edges[row, kept], edges[row, kept + 1]
        above[alive] = kinds[row, kept]
    return attrs.evolve(brackets, low=low, high=high, above=above)


def _state_at(
    strips: Strips, trim: FloatArray, heel: FloatArray, brackets: Brackets, v: FloatArray
) -> IntArray:
    """Tell the state of one curve for each bracket."""
    tiles = from_curves(strips.curves(brackets.strip, v))
    tilted = tilt(tiles, trim, heel)
    ground = brackets.level[tiles.curve]
    tile = np.flatnonzero((tilted.low <= ground) & (tilted.high > ground))
    found = cuts(tilted, tile, ground[tile])
    curve = tiles.curve[tile[found.pair]]
    state: IntArray = states(tiles, tilted, brackets.level[None], 0 * curve, curve)[0]
    return state


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
        how many knuckles are.
    """
    rows, count = len(level), tiles.curves
    times = np.bincount(row * count + curve, minlength=rows * count).reshape(rows, count)
    keel = tilted.control[0][tiles.start[:-1]] <= level
    deck = tilted.control[3][tiles.start[1:] - 1] <= level
    state: IntArray = _CUT * times + _KEEL * keel + deck
    if len(tiles.knuckle):
        owner = tiles.curve[tiles.knuckle]
        at = level[:, owner] if level.shape[1] > 1 else level
        one, knuckle = np.nonzero(tilted.control[0][tiles.knuckle] <= at)
        wet = np.bincount(one * count + owner[knuckle], minlength=rows * count)
        state = state + _KNUCKLE * wet.reshape(rows, count)
    return state
