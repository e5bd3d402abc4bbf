"""Chains of few arcs: a search along pieces of curves, of all pieces at once.

Each arc begins where the one before ends, in its direction, and ends on the curve: its end says
all of it. What an end leaves free is how far the direction there is tilted from that of the curve,
and the tilt decides how far the next arc reaches. So from each of a few states (place and
direction, of different tilts) ends are tried in order of length; of all that keep within the
tolerance the farthest for each range of tilts go on. Biarcs that end in the direction of the curve
are tried besides, as nothing else brings a tilt back to nil. A piece is done when from one of its
states a biarc reaches its end, and the direction there.
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.classical.arc_pieces import Pieces
from assoc_hull.geometry.classical.arc_states import Found, States
from assoc_hull.geometry.classical.arc_trials import Limits, single_arcs, trials
from assoc_hull.geometry.curves import FloatArray, IntArray

__all__ = ["Chain", "Stuck", "chains"]

_LADDER = 2.2 ** np.linspace(-2.0, 1.6, 12)
_FINE = np.array([0.35, 0.5, 0.62, 0.74, 0.84, 0.92, 0.97, 1.03, 1.07, 1.12, 1.17, 1.23])
_PAIRS = np.array([0.7, 1.1, 1.4, 1.7, 2.0, 2.3])
_ROOTS = 4
"""States from which biarcs are tried."""
_SHORTER = 10
_IDLE = 20
_NEAR = 3.0


@attrs.frozen(eq=False)
class Chain:
    """The arcs of one piece, as biarcs and single arcs in order.

    Attributes
    ----------
    w : (k + 1,)
        Parameters of the piece at which they begin and end.
    angle : (k + 1,), rad
        Directions of the chain there.
    ratio : (k,)
        Of a biarc; nan for a single arc.
    """

    w: FloatArray
    angle: FloatArray
    ratio: FloatArray


@attrs.frozen
class Stuck:
    """The parameter of a piece beyond which no arc keeps the limits."""

    w: float


_Trail = list[tuple[IntArray, States]]


def chains(pieces: Pieces, rows: IntArray, limits: Limits) -> list[Chain | Stuck]:
    """Give the chain of each of some pieces, or where none goes on.

    Parameters
    ----------
    pieces : Pieces
        The curves.
    rows : (k,) int
        The pieces.
    limits : Limits
        What arcs keep.
    """
    span = _spans(pieces)
    found: list[Chain | Stuck] = [Stuck(0.0)] * len(rows)
    first, stop = (each[rows] for each in (pieces.first, pieces.stop))
    far = first.astype(np.float64)
    live, idle = np.arange(len(rows)), np.zeros(len(rows), np.int64)
    state = States.begin(far.copy(), pieces.angle[rows, 0], span[stop] - span[first])
    older: States | None = None
    trail: _Trail = []
    while len(live):
        trail.append((live, state))
        done, best, ratio = _finish(pieces, rows[live], state, span, limits)
        for i in np.flatnonzero(done).tolist():
            row = int(live[i])
            found[row] = _back(pieces, int(rows[row]), trail, row, int(best[i]), float(ratio[i]))
        live, state = live[~done], state.of(~done)
        older = older.of(~done) if older is not None else None
        if not len(live):
            break
        state, older = _advance(pieces, rows[live], state, older, span, limits), state
        now = state.w.max(axis=1, initial=-np.inf)
        idle[live] = np.where(now > far[live], 0, idle[live] + 1)
        far[live] = np.maximum(now, far[live])
        going = (idle[live] <= _IDLE) & (state.some | older.some)
        for i in live[~going].tolist():
            found[i] = Stuck(float(far[i]))
        live, state, older = live[going], state.of(going), older.of(going)
    return found


def _spans(pieces: Pieces) -> FloatArray:
    """Give how far along all curves each cubic begins, by their chords, (p + 1,), m."""
    step = pieces.cubic.sum(axis=1) - pieces.cubic[:, 0]
    return np.concatenate([[0.0], np.cumsum(np.hypot(step[:, 0], step[:, 1]))])


def _along(span: FloatArray, w: FloatArray) -> FloatArray:
    return np.asarray(np.interp(w, np.arange(len(span)), span))


def _back(pieces: Pieces, piece: int, trail: _Trail, row: int, state: int, ratio: float) -> Chain:
    """Follow the parents of a state to the beginning of its piece."""
    w, angle, ratios = [float(pieces.stop[piece])], [float(pieces.angle[piece, 1])], [ratio]
    step = len(trail) - 1
    while True:
        live, states = trail[step]
        i = int(np.searchsorted(live, row))
        w.append(float(states.w[i, state]))
        angle.append(float(states.angle[i, state]))
        if step == 0:
            break
        ratios.append(float(states.ratio[i, state]))
        step -= 1 if np.isnan(ratios[-1]) else 2
        state = int(states.parent[i, state])
    return Chain(*(np.array(each[::-1]) for each in (w, angle, ratios)))


def _finish(
    pieces: Pieces, rows: IntArray, state: States, span: FloatArray, limits: Limits
) -> tuple[NDArray[np.bool_], IntArray, FloatArray]:
    """Tell which pieces a biarc finishes, from which state and with which ratio."""
    stop = pieces.stop[rows]
    left = span[stop][:, None] - _along(span, state.w)
    i, j = np.nonzero(np.isfinite(state.w) & (left < _NEAR * state.way))
    made = trials(
        pieces, rows[i], state.w[i, j], stop[i].astype(np.float64), state.angle[i, j], limits
    )
    off, ratio = np.full(state.w.shape, np.inf), np.zeros(state.w.shape)
    off[i, j], ratio[i, j] = made.off, made.ratio
    best, row = np.argmin(off, axis=1), np.arange(len(rows))
    return off[row, best] <= limits.within, best, ratio[row, best]


def _advance(
    pieces: Pieces, rows: IntArray, state: States, older: States | None, span: FloatArray,
    limits: Limits,
) -> States:  # fmt: skip
    """Give the states an arc further; where no arc will do, ever shorter ones are tried."""
    found = _singles(pieces, rows, state, span, limits)
    if older is not None:
        found = found.join(_pairs(pieces, rows, older, span, limits))
    next_ = found.choose(limits.within)
    shorter = state
    for _ in range(_SHORTER):
        none = np.flatnonzero(~next_.some)
        if not len(none):
            break
        shorter = attrs.evolve(shorter, way=shorter.way / 8.0)
        again = _singles(pieces, rows[none], shorter.of(none), span, limits)
        next_ = next_.put(none, again.choose(limits.within))
    return next_


def _singles(
    pieces: Pieces, rows: IntArray, state: States, span: FloatArray, limits: Limits
) -> Found:
    """Try single arcs from all states: first of very different lengths, then near the longest."""
    rough = state.way[..., None] * _LADDER
    one = _tried(pieces, rows, state, rough, span, limits)
    good = one.good.reshape(rough.shape)
    most = np.where(good, rough, 0.0).max(axis=-1)
    most = np.where(most == 0.0, 0.3 * rough[..., 0], most)
    return one.join(_tried(pieces, rows, state, most[..., None] * _FINE, span, limits))


def _tried(
    pieces: Pieces, rows: IntArray, state: States, ways: FloatArray, span: FloatArray,
    limits: Limits,
) -> Found:  # fmt: skip
    """Try single arcs of about the lengths `ways`, (a, s, c)."""
    places = np.arange(len(span), dtype=np.float64)
    end = np.interp(_along(span, state.w)[..., None] + ways, span, places)
    stop = pieces.stop[rows][:, None, None]
    real = np.isfinite(state.w)[..., None] & (end < stop)
    i, j, k = np.nonzero(real)
    angle, fits = single_arcs(
        pieces, rows[i], state.w[i, j], end[i, j, k], state.angle[i, j], limits
    )
    parent = np.broadcast_to(np.arange(state.w.shape[1])[:, None], real.shape)
    return _found(pieces, rows, span, (end, ways, parent), (i, j, k), (angle, fits, np.nan))


def _pairs(
    pieces: Pieces, rows: IntArray, state: States, span: FloatArray, limits: Limits
) -> Found:
    """Try biarcs that end in the direction of the curve, from the most hopeful states."""
    parent = np.argsort(-state.hope, axis=1, kind="stable")[:, :_ROOTS]
    w, angle, way = (np.take_along_axis(each, parent, axis=1)
                     for each in (state.w, state.angle, state.way))  # fmt: skip
    ways = way[..., None] * _PAIRS
    places = np.arange(len(span), dtype=np.float64)
    end = np.interp(_along(span, w)[..., None] + ways, span, places)
    i, j, k = np.nonzero(np.isfinite(w)[..., None] & (end < pieces.stop[rows][:, None, None]))
    made = trials(pieces, rows[i], w[i, j], end[i, j, k], angle[i, j], limits)
    own = pieces.direction(rows[i], end[i, j, k])
    parents = np.broadcast_to(parent[..., None], end.shape)
    fits = made.off <= limits.within
    return _found(
        pieces, rows, span, (end, 0.5 * ways, parents), (i, j, k), (own, fits, made.ratio)
    )


def _found(
    pieces: Pieces, rows: IntArray, span: FloatArray,
    tried: tuple[FloatArray, FloatArray, IntArray], at: tuple[IntArray, ...],
    made: tuple[FloatArray, NDArray[np.bool_], FloatArray | float],
) -> Found:  # fmt: skip
    """Put what was tried side by side."""
    end, ways, parent = tried
    angle, ratio, tilt = (np.zeros(end.shape) for _ in range(3))
    good = np.zeros(end.shape, bool)
    angle[at], good[at], ratio[at] = made
    tilt[at] = pieces.tilt(rows[at[0]], end[at], made[0])
    flat = len(rows), int(np.prod(end.shape[1:]))
    t = _along(span, end)
    return Found(
        end.reshape(flat), angle.reshape(flat), ways.reshape(flat), parent.reshape(flat),
        ratio.reshape(flat), t.reshape(flat), tilt.reshape(flat), good.reshape(flat),
    )  # fmt: skip
