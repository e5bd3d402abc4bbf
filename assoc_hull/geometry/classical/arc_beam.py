"""Chains of few arcs: a search along pieces of curves, of all pieces at once.

Each arc begins where the one before ends, in its direction, and ends on the curve: its end says
all of it. What an end leaves free is how far the direction there is tilted from that of the curve,
and the tilt decides how far the next arc reaches. So from each of a few states (place and
direction, of different tilts) ends are tried in order of length; of all that keep within the
tolerance the farthest for each range of tilts go on. A piece is done when from one of its states
two arcs reach its end, and the direction there.
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.classical.arc_pieces import Pieces
from assoc_hull.geometry.classical.arc_trials import Limits, trials
from assoc_hull.geometry.classical.checks import wrap
from assoc_hull.geometry.curves import FloatArray, IntArray

__all__ = ["Chain", "chains"]

_WIDEST = 1.5
_STATES = 16
_TILT = 12.0
_LAG = 1.0
_SHORTER = 10
_IDLE = 20
_LADDER = 2.2 ** np.linspace(-2.0, 1.6, 12)
_FINE = np.array([0.35, 0.5, 0.62, 0.74, 0.84, 0.92, 0.97, 1.03, 1.07, 1.12, 1.17, 1.23])


@attrs.frozen(eq=False)
class Chain:
    """The arcs of one piece.

    Attributes
    ----------
    w : (k + 1,)
        Parameters of the joints on the curve: the ends of the arcs but for the last two.
    angle : (k + 1,), rad
        Directions there.
    ratio : float
        Of the biarc from the last joint to the end of the piece.
    """

    w: FloatArray
    angle: FloatArray
    ratio: float


@attrs.frozen(eq=False)
class _States:
    """States of active pieces, (a, s); those that are none have w of -inf."""

    w: FloatArray
    angle: FloatArray
    way: FloatArray
    parent: IntArray


def chains(pieces: Pieces, rows: IntArray, limits: Limits) -> list[Chain | float]:
    """Give the chain of each of some pieces, or the parameter beyond which none was found."""
    span = np.zeros(len(pieces.cubic) + 1)
    step = pieces.cubic.sum(axis=1) - pieces.cubic[:, 0]
    span[1:] = np.cumsum(np.hypot(step[:, 0], step[:, 1]))
    found: list[Chain | float] = [0.0] * len(rows)
    first = pieces.first[rows].astype(np.float64)
    live, idle, far = np.arange(len(rows)), np.zeros(len(rows), np.int64), first.copy()
    state = _States(
        first[:, None], pieces.angle[rows, 0][:, None],
        (span[pieces.stop[rows]] - span[pieces.first[rows]])[:, None],
        np.zeros((len(rows), 1), np.int64),
    )  # fmt: skip
    trail: list[tuple[IntArray, _States]] = []
    while len(live):
        trail.append((live, state))
        done, best, ratio = _finish(pieces, rows[live], state, span, limits)
        for i in np.flatnonzero(done).tolist():
            found[int(live[i])] = _back(trail, int(live[i]), int(best[i]), float(ratio[i]))
        keep = np.flatnonzero(~done)
        state = _States(*(each[keep] for each in attrs.astuple(state)))
        live = live[keep]
        if not len(live):
            break
        state = _advance(pieces, rows[live], state, span, limits)
        now = state.w.max(axis=1)
        idle[live] = np.where(now > far[live], 0, idle[live] + 1)
        far[live] = np.maximum(now, far[live])
        stuck = idle[live] > _IDLE
        for i in np.flatnonzero(stuck).tolist():
            found[int(live[i])] = float(far[live[i]])
        state = _States(*(each[~stuck] for each in attrs.astuple(state)))
        live = live[~stuck]
    return found


def _back(trail: list[tuple[IntArray, _States]], row: int, state: int, ratio: float) -> Chain:
    """Follow the parents of a state to the beginning of its piece."""
    w, angle = [], []
    for live, states in reversed(trail):
        i = int(np.searchsorted(live, row))
        w.append(states.w[i, state])
        angle.append(states.angle[i, state])
        state = int(states.parent[i, state])
    return Chain(np.array(w[::-1]), np.array(angle[::-1]), ratio)


def _finish(
    pieces: Pieces, rows: IntArray, state: _States, span: FloatArray, limits: Limits
) -> tuple[NDArray[np.bool_], IntArray, FloatArray]:
    """Tell which pieces two more arcs finish, from which state and how."""
    a, s = state.w.shape
    stop = pieces.stop[rows]
    left = span[stop][:, None] - _span_at(span, state.w)
    near = np.isfinite(state.w) & (left < 3.0 * state.way) 
    off, ratio = np.full((a, s), np.inf), np.zeros((a, s))
    i, j = np.nonzero(near)
    made = trials(pieces, rows[i], state.w[i, j], stop[i].astype(np.float64), state.angle[i, j], limits)
    off[i, j], ratio[i, j] = made.off, made.ratio
    best = np.argmin(off, axis=1)
    row = np.arange(a)
    return off[row, best] <= limits.within, best, ratio[row, best]


def _span_at(span: FloatArray, w: FloatArray) -> FloatArray:
    return np.asarray(np.interp(w, np.arange(len(span)), span))


def _advance(
    pieces: Pieces, rows: IntArray, state: _States, span: FloatArray, limits: Limits
) -> _States:
    """Give the states an arc further; where no arc will do, ever shorter ones are tried."""
    found = _once(pieces, rows, state, span, limits)
    for _ in range(_SHORTER):
        none = np.flatnonzero(~np.isfinite(found.w).any(axis=1))
        if not len(none):
            break
        old = [each[none] for each in attrs.astuple(state)]
        old[2] = old[2] / 8.0
        state.way[none] /= 8.0
        again = _once(pieces, rows[none], _States(*old), span, limits)
        for mine, new in zip(attrs.astuple(found), attrs.astuple(again), strict=True):
            mine[none] = new
    return found


def _once(
    pieces: Pieces, rows: IntArray, state: _States, span: FloatArray, limits: Limits
) -> _States:
    """Try single arcs from all states; keep the farthest of each range of tilts."""
    stop = pieces.stop[rows].astype(np.float64)
    t0 = _span_at(span, state.w)
    rough = state.way[..., None] * _LADDER
    w1, angle1, good1 = _arcs(pieces, rows, state, t0, rough, span, stop, limits)
    most = np.where(good1, rough, 0.0).max(axis=-1)
    none = most == 0.0
    most = np.where(none, rough[..., 0] * 0.3, most)
    fine = most[..., None] * _FINE
    w2, angle2, good2 = _arcs(pieces, rows, state, t0, fine, span, stop, limits)
    w, angle, good, way = (
        np.concatenate(each, axis=-1)
        for each in ((w1, w2), (angle1, angle2), (good1, good2), (rough, fine))
    )
    a, s, c = w.shape
    parent = np.broadcast_to(np.arange(s)[:, None], (s, c)).ravel()
    flat = [each.reshape(a, s * c) for each in (w, angle, way)]
    return _choose(pieces, rows, flat, good.reshape(a, s * c), parent, span, limits.within)


def _arcs(
    pieces: Pieces, rows: IntArray, state: _States, t0: FloatArray, ways: FloatArray,
    span: FloatArray, stop: FloatArray, limits: Limits,
) -> tuple[FloatArray, FloatArray, NDArray[np.bool_]]:  # fmt: skip
    """Give where arcs end, their directions there, and which keep the limits, (a, s, c)."""
    w1 = np.interp(t0[..., None] + ways, span, np.arange(len(span), dtype=np.float64))
    real = np.isfinite(state.w)[..., None] & (w1 < stop[:, None, None]) 
    i, j, k = np.nonzero(real)
    piece, w0, angle = rows[i], state.w[i, j], state.angle[i, j]
    end = w1[i, j, k]
    part = np.linspace(0.0, 1.0, limits.samples + 2)
    w = w0[:, None] + (end - w0)[:, None] * part
    w[:, -1] = end
    places = pieces.at(piece[:, None], w)
    step = places[:, -1] - places[:, 0]
    chord, course = np.hypot(step[:, 0], step[:, 1]), np.arctan2(step[:, 1], step[:, 0])
    alpha = wrap(angle - course)
    with np.errstate(divide="ignore", invalid="ignore"):
        bend = -2.0 * np.sin(alpha) / chord
        x, y = (places[:, 1:-1, axis] - places[:, :1, axis] for axis in (0, 1))
        left = 2.0 * (np.cos(angle)[:, None] * y - np.sin(angle)[:, None] * x)
        across = bend[:, None] * (x * x + y * y) - left
        off = np.abs(across) / (1.0 + np.sqrt(np.maximum(1.0 + bend[:, None] * across, 0.0)))
    fits = (off.max(axis=1) <= limits.within) & (np.abs(bend) <= limits.bend)
    fits &= (np.abs(alpha) < _WIDEST) & (chord > 0.0)
    good, angles = np.zeros(w1.shape, bool), np.zeros(w1.shape)
    good[i, j, k] = fits
    angles[i, j, k] = course - alpha
    return w1, angles, good


def _choose(
    pieces: Pieces, rows: IntArray, flat: list[FloatArray], good: NDArray[np.bool_],
    parent: IntArray, span: FloatArray, within: float,
) -> _States:  # fmt: skip
    """Keep for each range of tilts the state that is farthest."""
    w, angle, way = flat
    place = np.where(good, w, pieces.first[rows][:, None])
    tilt = wrap(angle - pieces.direction(np.broadcast_to(rows[:, None], w.shape), place))
    far = np.where(good, w, -np.inf)
    long = np.where(good, way, 1e-300).max(axis=1, keepdims=True)
    most = _TILT * within / long
    good = good & (np.abs(tilt) <= most)
    next_ = np.minimum(long, 4.0 * within / np.maximum(np.abs(tilt), 1e-12))
    t = np.where(good, _span_at(span, place) + next_, -np.inf)
    good &= t >= t.max(axis=1, keepdims=True) - _LAG * long
    far = np.where(good, w, -np.inf)
    part = np.where(good, (tilt / most + 1.0) * 0.5 * _STATES, 0.0)
    number = np.minimum(part.astype(np.int64), _STATES - 1)
    best = np.stack(
        [np.argmax(np.where(number == b, far, -np.inf), axis=1) for b in range(_STATES)], axis=1
    )
    row = np.arange(len(rows))[:, None]
    same = number[row, best] == np.arange(_STATES)
    return _States(
        np.where(same, far[row, best], -np.inf), angle[row, best], way[row, best], parent[best]
    )
