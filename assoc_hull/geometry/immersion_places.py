"""Where along strips the immersed part changes its kind: bracketed, many at once."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.immersion_states import DECK, KEEL, Inclination, Look, look
from assoc_hull.geometry.isocurves import Strips

__all__ = ["Brackets", "joined", "places"]

_CLOSE = 1e-12  # of a strip: how exactly a place is wanted
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
    low, high, above = brackets.low.copy(), brackets.high.copy(), brackets.above.copy()
    ends = [look(strips, inclination, brackets.strip, v, brackets.level) for v in (low, high)]
    point = _deciding(brackets, *ends)
    row = np.arange(len(low))
    miss = np.stack([each.over[row, point] for each in ends], axis=1)
    for _ in range(_TRIALS):
        alive = np.flatnonzero(high - low > _CLOSE)
        if not len(alive):
            break
        trial = _trials(low[alive], high[alive], miss[alive])
        some = np.repeat(alive, 3)
        seen = look(strips, inclination, brackets.strip[some], trial.ravel(), brackets.level[some])
        kind, off = seen.state.reshape(-1, 3), seen.over[np.arange(len(some)), point[some]]
        kept = np.cumprod(kind == brackets.below[alive, None], axis=1).sum(axis=1)
        each = np.arange(len(alive))
        edges = np.concatenate([low[alive, None], trial, high[alive, None]], axis=1)
        kinds = np.concatenate([kind, above[alive, None]], axis=1)
        misses = np.concatenate([miss[alive, :1], off.reshape(-1, 3), miss[alive, 1:]], axis=1)
        low[alive], high[alive] = edges[each, kept], edges[each, kept + 1]
        above[alive] = kinds[each, kept]
        miss[alive] = np.stack([misses[each, kept], misses[each, kept + 1]], axis=1)
    return attrs.evolve(brackets, low=low, high=high, above=above)


def _deciding(brackets: Brackets, low: Look, high: Look) -> IntArray:
    """Say which of the points of `Look.over` passes the plane in each bracket.

    If neither end of the curve does, it is the critical point up to which, counted from the
    lowest, the wetter of both ends is wet.
    """
    inner = np.maximum(low.wet, high.wet) + 1
    kind = brackets.below ^ brackets.above
    point = np.where(kind & KEEL, 0, np.where(kind & DECK, 1, inner))
    return np.clip(point, 0, low.over.shape[1] - 1)


def _trials(low: FloatArray, high: FloatArray, miss: FloatArray) -> FloatArray:
    """Give three places in each bracket: two about where the chord says, one far from it.

    The chord errs by the square of the bracket's length; so if the two enclose the place,
    the digits double. Without a chord, quarters.
    """
    length = high - low
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
    trial: FloatArray = low[:, None] + length[:, None] * inside
    return trial
