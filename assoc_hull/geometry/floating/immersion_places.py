"""Where along strips the immersed part changes its kind: bracketed, many at once."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.floating.immersion_states import DECK, KEEL, Inclination, look
from assoc_hull.geometry.surfaces.isocurves import Strips

__all__ = ["Brackets", "joined", "places"]

_CLOSE = 1e-10  # of a strip: integrals go with its power 3/2, extents with its square
_TRIALS = 60
_SEVERAL = 6  # changes between two neighbouring curves, at most


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


def joined(*several: Brackets) -> Brackets:
    """Put brackets behind one another."""
    fields = zip(*(attrs.astuple(each, recurse=False) for each in several), strict=True)
    return Brackets(*(np.concatenate(parts) for parts in fields))


def places(strips: Strips, inclination: Inclination, brackets: Brackets) -> Brackets:
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
    return joined(*found)


def _closed(strips: Strips, inclination: Inclination, brackets: Brackets) -> Brackets:
    """Close each bracket on the first change of state that is seen."""
    v = np.stack([brackets.low, brackets.high], axis=1)
    above = brackets.above.copy()
    strip, level = np.repeat(brackets.strip, 2), np.repeat(brackets.level, 2)
    over = look(strips, inclination, strip, v.ravel(), level).over.reshape(len(v), 2, -1)
    for _ in range(_TRIALS):
        alive = np.flatnonzero(v[:, 1] - v[:, 0] > _CLOSE)
        if not len(alive):
            break
        below = brackets.below[alive, None]
        trial = _trials(v[alive], _misses(over[alive], below[:, 0] ^ above[alive]))
        some = np.repeat(alive, 3)
        seen = look(strips, inclination, brackets.strip[some], trial.ravel(), brackets.level[some])
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
