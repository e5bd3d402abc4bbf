"""Search chains of few arcs that keep within a tolerance of plane curves.

Curves are composite cubics, cut at corners and straight runs into `FitPieces`. A parameter w on
them is the number of the cubic and the part of it: 7.25 lies a quarter along the eighth cubic of
the batch. All pieces are searched at once, so arrays have a row per piece. `arc_fit` makes arcs of
the chains that are found, and measures them.
"""

from __future__ import annotations

from typing import Self

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.classical.biarc_family import biarcs_by_ratio
from assoc_hull.geometry.classical.checked_input import wrap_angle
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.numeric.polynomials import differentiate

__all__ = [
    "CORNER",
    "ArcCandidates",
    "ArcChain",
    "ArcLimits",
    "ArcSearchFailure",
    "BiarcTrials",
    "FitPieces",
    "SearchStates",
    "search_chains",
    "try_biarcs",
    "try_single_arcs",
]

# --------------------------------------------------------------------------------------
# Pieces: runs of cubics without a corner, or one straight line each. At a corner the pieces on both
# sides keep their own directions.

_EXACT = 1e-9  # m
CORNER = 1e-10
"""rad: a curve that turns by more at a point has a corner there."""


@attrs.frozen(eq=False)
class FitPieces:
    """Pieces of plane curves, in the order of the curves.

    Attributes
    ----------
    cubic : (p, 4, 2), m
        Coefficients of 1, u, u^2, u^3, u from 0 to 1 along each cubic.
    curve : (k,) int
        The curve of each piece.
    first, stop : (k,) int
        Its first cubic, and the one behind its last.
    angle : (k, 2), rad
        Directions at its two ends.
    straight : (k,) bool
        Whether it is a straight line.
    """

    cubic: FloatArray
    curve: IntArray
    first: IntArray
    stop: IntArray
    angle: FloatArray
    straight: NDArray[np.bool_]
    tables: tuple[FloatArray, ...] = attrs.field(init=False, repr=False)

    def __attrs_post_init__(self) -> None:
        freeze(self.cubic, self.curve, self.first, self.stop, self.angle, self.straight)
        one = differentiate(self.cubic)
        tables = tuple(_table(each) for each in (self.cubic, one, differentiate(one)))
        object.__setattr__(self, "tables", tables)

    def __len__(self) -> int:
        return len(self.curve)

    @classmethod
    def of(cls, cubic: FloatArray, start: IntArray, flat: float) -> Self:
        """Cut curves into pieces, their cubics (p, 4, 2), m, in order; `start` (m + 1,) per curve.

        Cubics that leave their common chord by no more than `flat` (m) are a straight line; what
        goes on smoothly from it begins in the direction of the line.
        """
        leave, arrive = _directions(cubic)
        turn = wrap_angle(leave[1:] - arrive[:-1])
        cuts = np.zeros(len(cubic) + 1, bool)
        cuts[1:-1] = np.abs(turn) > CORNER
        cuts[start] = True
        straight = np.zeros(len(cubic), bool)
        for low, high in straight_cubic_runs(cubic, cuts, flat):
            cuts[[low, high]] = True
            straight[low:high] = True
        edge = np.flatnonzero(cuts)
        first, stop = edge[:-1], edge[1:]
        angle = np.stack([leave[first], arrive[stop - 1]], axis=1)
        line = straight[first]
        step = _ends(cubic)[stop - 1] - cubic[first, 0]
        angle[line] = np.arctan2(step[line, 1], step[line, 0])[:, None]
        _follow_lines(angle, line, np.abs(turn)[first[1:] - 1] <= CORNER, np.isin(first[1:], start))
        curve = np.searchsorted(start, first, "right") - 1
        return cls(cubic, curve, first, stop, angle, line)

    def at(self, piece: IntArray, w: FloatArray) -> FloatArray:
        """Give places at parameters w, (...), of pieces, (...): (..., 2), m."""
        number, u = self._split(piece, w)
        return _value(self.tables[0], number, u)

    def slope(self, piece: IntArray, w: FloatArray) -> FloatArray:
        """Give the derivatives by w, (..., 2), m."""
        number, u = self._split(piece, w)
        return _value(self.tables[1], number, u)

    def direction(self, piece: IntArray, w: FloatArray) -> FloatArray:
        """Give directions (rad) at parameters w; at the ends of a piece those it keeps."""
        slope = self.slope(piece, w)
        found = np.arctan2(slope[..., 1], slope[..., 0])
        found = np.where(w == self.first[piece], self.angle[piece, 0], found)
        return np.where(w == self.stop[piece], self.angle[piece, 1], found)

    def tilt(self, piece: IntArray, w: FloatArray, angle: FloatArray) -> FloatArray:
        """Give how far directions (rad) are turned from those of the curve, to the left."""
        return wrap_angle(angle - self.direction(piece, w))

    def curvature(self, piece: IntArray, w: FloatArray) -> FloatArray:
        """Give the curvature (1/m), positive to the left, at parameters w."""
        number, u = self._split(piece, w)
        first, second = (_value(table, number, u) for table in self.tables[1:])
        cross = first[..., 0] * second[..., 1] - first[..., 1] * second[..., 0]
        return np.asarray(cross / (first * first).sum(axis=-1) ** 1.5)

    def _split(self, piece: IntArray, w: FloatArray) -> tuple[IntArray, FloatArray]:
        # The end of a piece is u = 1 of its last cubic, not u = 0 of the next piece.
        number = np.minimum(np.asarray(w, np.float64).astype(np.int64), self.stop[piece] - 1)
        return number, w - number


def straight_cubic_runs(
    cubic: FloatArray, cuts: NDArray[np.bool_], flat: float
) -> list[tuple[int, int]]:
    """Give (first, stop) of runs of cubics that lie on a straight line.

    One cubic by itself is a run if it is straight to rounding; near an inflection many are nearly
    so, and a line there would only part what is one arc.
    """
    control = _control(cubic)
    near = _control_deviation(control, control[:, 0], control[:, 3]) <= flat
    runs: list[tuple[int, int]] = []
    low = 0
    while low < len(cubic):
        high = low + 1
        if near[low]:
            while high < len(cubic) and near[high] and not cuts[high]:
                line = control[low : high + 1]
                if _control_deviation(line, line[0, 0], line[-1, 3]).max() > flat:
                    break
                high += 1
            alone = _control_deviation(
                control[low : low + 1], control[low, 0], control[low, 3]
            ).max()
            # Two lines that meet without a corner would make one.
            parted = not runs or runs[-1][1] < low or cuts[low]
            if parted and (high - low > 1 or alone <= _EXACT):
                runs.append((low, high))
        low = high
    return runs


def _control_deviation(control: FloatArray, begin: FloatArray, end: FloatArray) -> FloatArray:
    """Give how far the farthest control point of each cubic is off a chord, m."""
    step = end - begin
    away = control - (begin if begin.ndim == 1 else begin[:, None])
    ahead = step if step.ndim == 1 else step[:, None]
    cross = away[..., 0] * ahead[..., 1] - away[..., 1] * ahead[..., 0]
    found: FloatArray = np.abs(cross).max(axis=-1) / np.hypot(step[..., 0], step[..., 1])
    return found


def _control(cubic: FloatArray) -> FloatArray:
    """Give the Bezier points, (p, 4, 2), m."""
    c0, c1, c2, c3 = (cubic[:, i] for i in range(4))
    first = c0 + c1 / 3.0
    return np.stack([c0, first, 2.0 * first - c0 + c2 / 3.0, c0 + c1 + c2 + c3], axis=1)


def _ends(cubic: FloatArray) -> FloatArray:
    found: FloatArray = cubic.sum(axis=1)
    return found


def _directions(cubic: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Give the directions (rad) at the beginning and end of each cubic."""
    leave = cubic[:, 1]
    arrive = cubic[:, 1] + 2.0 * cubic[:, 2] + 3.0 * cubic[:, 3]
    return np.arctan2(leave[:, 1], leave[:, 0]), np.arctan2(arrive[:, 1], arrive[:, 0])


def _follow_lines(
    angle: FloatArray, line: NDArray[np.bool_], smooth: NDArray[np.bool_], new: NDArray[np.bool_]
) -> None:
    """Let what is smooth beside a straight line begin and end in its direction."""
    joined = smooth & ~new
    after = np.flatnonzero(joined & line[:-1] & ~line[1:])
    angle[after + 1, 0] = angle[after, 1]
    before = np.flatnonzero(joined & ~line[:-1] & line[1:])
    angle[before, 1] = angle[before + 1, 0]


def _value(table: FloatArray, number: IntArray, u: FloatArray) -> FloatArray:
    """Give the values of polynomials, (k, 2, p), at parts u of some: (..., 2), parts contiguous."""
    found = np.empty((2, *number.shape))
    term = np.empty(number.shape)
    for axis in (0, 1):
        sums = found[axis, ...]
        np.take(table[-1, axis], number, out=sums, mode="clip")
        for power in range(len(table) - 2, -1, -1):
            sums *= u
            np.take(table[power, axis], number, out=term, mode="clip")
            sums += term
    return np.moveaxis(found, 0, -1)


def _table(cubic: FloatArray) -> FloatArray:
    """Lay coefficients (p, k, 2) out so that those of one power lie side by side, (k, 2, p)."""
    return np.ascontiguousarray(np.moveaxis(cubic, 0, -1))


# --------------------------------------------------------------------------------------
# Arcs and biarcs tried on stretches of curves, and how far they leave them. Distances are taken
# without centres, so that radii of any size lose no digits.

_WIDEST = 1.5
"""rad: an end of a candidate turns no farther from its chord."""

_RATIOS = np.linspace(0.14, 0.86, 7)
"""Parts of the first chord that are tried."""

_CLOSER = np.linspace(-0.09, 0.09, 6)
"""Steps of the ratio around the best of `_RATIOS` that are tried next."""


@attrs.frozen
class ArcLimits:
    """What arcs have to keep.

    Attributes
    ----------
    within : float, m
        How far they may leave the curve.
    bend : float, 1/m
        Greatest curvature, infinite if any will do.
    samples : int
        Places along a candidate at which it is measured.
    """

    within: float
    bend: float
    samples: int


@attrs.frozen(eq=False)
class BiarcTrials:
    """Candidates: one biarc each.

    Attributes
    ----------
    ratio : (c,)
        The part that the chord of the first arc has, for the least deviation.
    off : (c,), m
        The deviation; infinite where no biarc keeps the limits.
    """

    ratio: FloatArray
    off: FloatArray


def try_biarcs(
    pieces: FitPieces, piece: IntArray, low: FloatArray, high: FloatArray, angle: FloatArray,
    limits: ArcLimits,
) -> BiarcTrials:  # fmt: skip
    """Find the biarcs that deviate least from stretches of curves, (c,).

    A stretch runs on its piece from parameter `low` to `high`; a biarc begins in the direction
    `angle` (rad) and ends in that of the curve. `limits.within` is left to the caller.
    """
    places = _sample_stretches(pieces, piece, low, high, limits.samples)
    begin = places[:, 0]
    step = places[:, -1] - begin
    chord, way = np.hypot(step[:, 0], step[:, 1]), np.arctan2(step[:, 1], step[:, 0])
    alpha, beta = wrap_angle(angle - way), wrap_angle(pieces.direction(piece, high) - way)
    ok = (np.abs(alpha) < _WIDEST) & (np.abs(beta) < _WIDEST) & (chord > 0.0)
    off, ratio = np.full(len(piece), np.inf), np.full(len(piece), 0.5)
    if ok.any():
        away = places[ok, 1:-1] - begin[ok, None]
        cosine, sine = np.cos(way[ok])[:, None], np.sin(way[ok])[:, None]
        x = cosine * away[..., 0] + sine * away[..., 1]
        y = cosine * away[..., 1] - sine * away[..., 0]
        ratio[ok], off[ok] = _best_ratio(x, y, chord[ok], alpha[ok], beta[ok], limits.bend)
    return BiarcTrials(ratio, off)


def _best_ratio(
    x: FloatArray, y: FloatArray, chord: FloatArray, alpha: FloatArray, beta: FloatArray,
    bend: float,
) -> tuple[FloatArray, FloatArray]:  # fmt: skip
    """Give ratio and deviation (m) of the best of many biarcs to each row of places."""
    cosines, sines = (np.stack([f(alpha), f(beta)])[:, :, None] for f in (np.cos, np.sin))
    ahead = np.stack([x, x - chord[:, None]])
    # Of the two circles, in axes of the tangents at the ends: twice the offset to the left, and
    # the squared distance from the point of tangency.
    left = 2.0 * (cosines * y - sines * ahead)
    square = ahead * ahead + y * y
    seen = x, y, left, square
    row = np.arange(len(chord))
    ratio = np.broadcast_to(_RATIOS, (len(chord), len(_RATIOS)))
    off = _biarc_deviation(seen, chord, alpha, beta, ratio, bend)
    best = np.argmin(off, axis=1)
    found, least = ratio[row, best], off[row, best]
    closer = found[:, None] + _CLOSER
    off = _biarc_deviation(seen, chord, alpha, beta, closer, bend)
    best = np.argmin(off, axis=1)
    better = off[row, best] < least
    return (
        np.where(better, closer[row, best], found),
        np.where(better, off[row, best], least),
    )


def _biarc_deviation(
    seen: tuple[FloatArray, ...], chord: FloatArray, alpha: FloatArray, beta: FloatArray,
    ratio: FloatArray, bend: float,
) -> FloatArray:  # fmt: skip
    """Give the largest distance (m) of places from biarcs, (c, r)."""
    x, y, left, square = seen
    made = biarcs_by_ratio(chord[:, None], alpha[:, None], beta[:, None], ratio)
    curved = made.bend[..., None]
    off = _circle_deviation(curved, square[:, :, None], left[:, :, None])
    cosine, sine = np.cos(made.tau)[..., None], np.sin(made.tau)[..., None]
    # A place belongs to the first arc as long as it lies behind the normal at the join.
    before = cosine * (x[:, None] - made.join[0][..., None]) < sine * (
        made.join[1][..., None] - y[:, None]
    )
    most = np.where(before, off[0], off[1]).max(axis=-1)
    good = np.isfinite(made.bend).all(axis=0) & (np.abs(made.bend).max(axis=0) <= bend)
    return np.asarray(np.where(good, most, np.inf))


def try_single_arcs(
    pieces: FitPieces, piece: IntArray, low: FloatArray, high: FloatArray, angle: FloatArray,
    limits: ArcLimits,
) -> tuple[FloatArray, NDArray[np.bool_]]:  # fmt: skip
    """Lay single arcs through the ends of stretches, (c,), that begin in directions `angle` (rad).

    Stretches as for `try_biarcs`. Gives the directions at their ends (c,), rad, and which keep the
    limits (c,).
    """
    places = _sample_stretches(pieces, piece, low, high, limits.samples)
    step = places[:, -1] - places[:, 0]
    chord, course = np.hypot(step[:, 0], step[:, 1]), np.arctan2(step[:, 1], step[:, 0])
    alpha = wrap_angle(angle - course)
    fits = (np.abs(alpha) < _WIDEST) & (chord > 0.0)
    bend = -2.0 * np.sin(alpha) / np.where(chord > 0.0, chord, 1.0)
    x, y = (places[:, 1:-1, axis] - places[:, :1, axis] for axis in (0, 1))
    left = 2.0 * (np.cos(angle)[:, None] * y - np.sin(angle)[:, None] * x)
    off = _circle_deviation(bend[:, None], x * x + y * y, left)
    fits &= (off.max(axis=1) <= limits.within) & (np.abs(bend) <= limits.bend)
    return course - alpha, fits


def _sample_stretches(
    pieces: FitPieces, piece: IntArray, low: FloatArray, high: FloatArray, samples: int
) -> FloatArray:
    """Give places along stretches, (c, samples + 2, 2), m; the ends are exact."""
    part = np.linspace(0.0, 1.0, samples + 2)
    w = low[:, None] + (high - low)[:, None] * part
    w[:, -1] = high
    return pieces.at(piece[:, None], w)


def _circle_deviation(bend: FloatArray, square: FloatArray, left: FloatArray) -> FloatArray:
    """Give the distance (m) of points from whole circles of curvature `bend` (1/m).

    `square` is the squared distance from a point of the circle, `left` twice the offset to the
    left of the tangent there; the formula of `PlaneArcs.distance`.
    """
    across = bend * square - left
    found: FloatArray = np.abs(across) / (1.0 + np.sqrt(np.maximum(1.0 + bend * across, 0.0)))
    return found


# --------------------------------------------------------------------------------------
# States of the search: places on curves, the directions there, how they came. Arrays are (a, s):
# s states of each of a pieces; w = -inf marks an empty state.

_COUNT = 24
"""Ranges of tilt, each of which keeps one state."""

_MOST_TILT = 24.0
"""Widest tilt that is kept, in units of the tolerance over the longest arc now."""

_LAG = 1.0
"""How far behind the best a state may lie, in units of the longest arc now."""


@attrs.frozen(eq=False)
class SearchStates:
    """States after so many arcs.

    Attributes
    ----------
    w : (a, s)
        Parameters on the pieces.
    angle : (a, s), rad
        Directions of the chains there.
    way : (a, s), m
        Length of the last arc, about.
    parent : (a, s) int
        The state it came from: of one arc before, or of two where `ratio` is a number.
    ratio : (a, s)
        Of the biarc that led here; nan where one arc did.
    hope : (a, s), m
        How far it lies along the curves, and about what the next arc will add.
    """

    w: FloatArray
    angle: FloatArray
    way: FloatArray
    parent: IntArray
    ratio: FloatArray
    hope: FloatArray

    @classmethod
    def begin(cls, w: FloatArray, angle: FloatArray, way: FloatArray) -> Self:
        """Give the one state of each piece at its beginning; all (a,)."""
        shape = (len(w), 1)
        return cls(
            w[:, None], angle[:, None], way[:, None], np.zeros(shape, np.int64),
            np.full(shape, np.nan), np.zeros(shape),
        )  # fmt: skip

    def of(self, rows: IntArray | NDArray[np.bool_]) -> SearchStates:
        """Give the states of some pieces."""
        return SearchStates(*(each[rows] for each in attrs.astuple(self, recurse=False)))

    def put(self, rows: IntArray, other: SearchStates) -> SearchStates:
        """Give these states, with those of some pieces taken from others."""
        columns = [each.copy() for each in attrs.astuple(self, recurse=False)]
        for mine, new in zip(columns, attrs.astuple(other, recurse=False), strict=True):
            mine[rows] = new
        return SearchStates(*columns)

    @property
    def some(self) -> NDArray[np.bool_]:
        """Which pieces have a state, (a,)."""
        return np.asarray(np.isfinite(self.w).any(axis=1))


@attrs.frozen(eq=False)
class ArcCandidates:
    """Ends that were tried, (a, n): as in `SearchStates`, and whether they keep the limits.

    Attributes
    ----------
    t : (a, n), m
        How far they lie along the curves.
    tilt : (a, n), rad
        From the direction of the curve.
    """

    w: FloatArray
    angle: FloatArray
    way: FloatArray
    parent: IntArray
    ratio: FloatArray
    t: FloatArray
    tilt: FloatArray
    good: NDArray[np.bool_]

    def join(self, other: ArcCandidates) -> ArcCandidates:
        """Give both."""
        pairs = zip(attrs.astuple(self, recurse=False), attrs.astuple(other, recurse=False),
                    strict=True)  # fmt: skip
        return ArcCandidates(*(np.concatenate(pair, axis=1) for pair in pairs))

    def choose(self, within: float) -> SearchStates:
        """Keep for each range of tilts the end that is farthest; `within` in m.

        A wide tilt makes the next arcs short, and no single arc makes it less. So ranges are finer
        about zero, and what lags behind with all that may be hoped for is left out.
        """
        long = np.where(self.good, self.way, 1e-300).max(axis=1, keepdims=True)
        most = _MOST_TILT * within / long
        size = np.abs(self.tilt)
        # A chain that is tilted leaves the tolerance after some within / size: so far, and not
        # farther than the longest arc now, may the next one reach.
        hope = self.t + np.minimum(long, 4.0 * within / np.maximum(size, 1e-12))
        good = self.good & (size <= most)
        best = np.where(good, hope, -np.inf).max(axis=1, keepdims=True)
        good &= hope >= best - _LAG * long
        part = 1.0 + np.sign(self.tilt) * np.sqrt(np.minimum(size / most, 1.0))
        number = np.where(good, np.minimum((part * 0.5 * _COUNT).astype(np.int64), _COUNT - 1), -1)
        far = np.where(good, self.t, -np.inf)
        column = np.stack(
            [np.argmax(np.where(number == b, far, -np.inf), axis=1) for b in range(_COUNT)], axis=1
        )
        row = np.arange(len(far))[:, None]
        # argmax gives 0 where a range is empty: then the column is of another range.
        real = number[row, column] == np.arange(_COUNT)
        w, angle, way, parent, ratio = (
            each[row, column] for each in (self.w, self.angle, self.way, self.parent, self.ratio)
        )
        return SearchStates(
            np.where(real, w, -np.inf), angle, way, parent, ratio,
            np.where(real, hope[row, column], -np.inf),
        )  # fmt: skip


# --------------------------------------------------------------------------------------
# The beam search. Each arc begins where the one before ends, in its direction, and ends on the
# curve, so its end says all of it: the place, and the tilt against the curve, which decides how far
# the next arc reaches. From each state ends are tried in order of length. Only biarcs that end in
# the direction of the curve bring a tilt back to zero.

_LADDER = 2.2 ** np.linspace(-2.0, 1.6, 12)
"""Lengths of arcs that are tried first, over the length of the last one."""

_FINE = np.array([0.35, 0.5, 0.62, 0.74, 0.84, 0.92, 0.97, 1.03, 1.07, 1.12, 1.17, 1.23])
"""Lengths that are tried next, over the longest of `_LADDER` that kept the limits."""

_PAIRS = np.array([0.7, 1.1, 1.4, 1.7, 2.0, 2.3])
"""Lengths of biarcs that are tried, over that of the last arc."""

_ROOTS = 4
"""States from which biarcs are tried."""

_SHORTER = 10
"""So many times arcs of an eighth of the length are tried where none goes on."""

_IDLE = 20
"""A piece that comes no farther in more rounds than this is given up."""

_NEAR = 3.0
"""The end of a piece is tried from states that lie within so many lengths of their last arc."""


@attrs.frozen(eq=False)
class ArcChain:
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
class ArcSearchFailure:
    """The parameter of a piece beyond which no arc keeps the limits."""

    w: float


_Trail = list[tuple[IntArray, SearchStates]]


def search_chains(
    pieces: FitPieces, rows: IntArray, limits: ArcLimits
) -> list[ArcChain | ArcSearchFailure]:
    """Give the chain of each of the pieces `rows`, (k,), or where none goes on.

    A piece is done when a biarc from one of its states reaches its end, and the direction there.
    """
    span = _spans(pieces)
    found: list[ArcChain | ArcSearchFailure] = [ArcSearchFailure(0.0)] * len(rows)
    first, stop = (each[rows] for each in (pieces.first, pieces.stop))
    far = first.astype(np.float64)
    live, idle = np.arange(len(rows)), np.zeros(len(rows), np.int64)
    state = SearchStates.begin(far.copy(), pieces.angle[rows, 0], span[stop] - span[first])
    older: SearchStates | None = None
    trail: _Trail = []
    while len(live):
        trail.append((live, state))
        done, best, ratio = _finish(pieces, rows[live], state, span, limits)
        for i in np.flatnonzero(done).tolist():
            row = int(live[i])
            found[row] = _trace_back(
                pieces, int(rows[row]), trail, row, int(best[i]), float(ratio[i])
            )
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
            found[i] = ArcSearchFailure(float(far[i]))
        live, state, older = live[going], state.of(going), older.of(going)
    return found


def _spans(pieces: FitPieces) -> FloatArray:
    """Give how far along all curves each cubic begins, by their chords, (p + 1,), m."""
    step = pieces.cubic.sum(axis=1) - pieces.cubic[:, 0]
    return np.concatenate([[0.0], np.cumsum(np.hypot(step[:, 0], step[:, 1]))])


def _distance_along(span: FloatArray, w: FloatArray) -> FloatArray:
    return np.asarray(np.interp(w, np.arange(len(span)), span))


def _trace_back(
    pieces: FitPieces, piece: int, trail: _Trail, row: int, state: int, ratio: float
) -> ArcChain:
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
    return ArcChain(*(np.array(each[::-1]) for each in (w, angle, ratios)))


def _finish(
    pieces: FitPieces, rows: IntArray, state: SearchStates, span: FloatArray, limits: ArcLimits
) -> tuple[NDArray[np.bool_], IntArray, FloatArray]:
    """Give which pieces a biarc finishes, from which state and with which ratio."""
    stop = pieces.stop[rows]
    left = span[stop][:, None] - _distance_along(span, state.w)
    i, j = np.nonzero(np.isfinite(state.w) & (left < _NEAR * state.way))
    made = try_biarcs(
        pieces, rows[i], state.w[i, j], stop[i].astype(np.float64), state.angle[i, j], limits
    )
    off, ratio = np.full(state.w.shape, np.inf), np.zeros(state.w.shape)
    off[i, j], ratio[i, j] = made.off, made.ratio
    best, row = np.argmin(off, axis=1), np.arange(len(rows))
    return off[row, best] <= limits.within, best, ratio[row, best]


def _advance(
    pieces: FitPieces,
    rows: IntArray,
    state: SearchStates,
    older: SearchStates | None,
    span: FloatArray,
    limits: ArcLimits,
) -> SearchStates:
    """Give the states an arc further; where no arc will do, ever shorter ones are tried."""
    found = _single_candidates(pieces, rows, state, span, limits)
    if older is not None:
        found = found.join(_biarc_candidates(pieces, rows, older, span, limits))
    next_ = found.choose(limits.within)
    shorter = state
    for _ in range(_SHORTER):
        none = np.flatnonzero(~next_.some)
        if not len(none):
            break
        shorter = attrs.evolve(shorter, way=shorter.way / 8.0)
        again = _single_candidates(pieces, rows[none], shorter.of(none), span, limits)
        next_ = next_.put(none, again.choose(limits.within))
    return next_


def _single_candidates(
    pieces: FitPieces, rows: IntArray, state: SearchStates, span: FloatArray, limits: ArcLimits
) -> ArcCandidates:
    """Try single arcs from all states: first of very different lengths, then near the longest."""
    rough = state.way[..., None] * _LADDER
    one = _try_lengths(pieces, rows, state, rough, span, limits)
    good = one.good.reshape(rough.shape)
    most = np.where(good, rough, 0.0).max(axis=-1)
    most = np.where(most == 0.0, 0.3 * rough[..., 0], most)
    return one.join(_try_lengths(pieces, rows, state, most[..., None] * _FINE, span, limits))


def _try_lengths(
    pieces: FitPieces, rows: IntArray, state: SearchStates, ways: FloatArray, span: FloatArray,
    limits: ArcLimits,
) -> ArcCandidates:  # fmt: skip
    """Try single arcs of about the lengths `ways`, (a, s, c)."""
    places = np.arange(len(span), dtype=np.float64)
    end = np.interp(_distance_along(span, state.w)[..., None] + ways, span, places)
    stop = pieces.stop[rows][:, None, None]
    real = np.isfinite(state.w)[..., None] & (end < stop)
    i, j, k = np.nonzero(real)
    angle, fits = try_single_arcs(
        pieces, rows[i], state.w[i, j], end[i, j, k], state.angle[i, j], limits
    )
    parent = np.broadcast_to(np.arange(state.w.shape[1])[:, None], real.shape)
    return _as_candidates(pieces, rows, span, (end, ways, parent), (i, j, k), (angle, fits, np.nan))


def _biarc_candidates(
    pieces: FitPieces, rows: IntArray, state: SearchStates, span: FloatArray, limits: ArcLimits
) -> ArcCandidates:
    """Try biarcs that end in the direction of the curve, from the most hopeful states."""
    parent = np.argsort(-state.hope, axis=1, kind="stable")[:, :_ROOTS]
    w, angle, way = (np.take_along_axis(each, parent, axis=1)
                     for each in (state.w, state.angle, state.way))  # fmt: skip
    ways = way[..., None] * _PAIRS
    places = np.arange(len(span), dtype=np.float64)
    end = np.interp(_distance_along(span, w)[..., None] + ways, span, places)
    i, j, k = np.nonzero(np.isfinite(w)[..., None] & (end < pieces.stop[rows][:, None, None]))
    made = try_biarcs(pieces, rows[i], w[i, j], end[i, j, k], angle[i, j], limits)
    own = pieces.direction(rows[i], end[i, j, k])
    parents = np.broadcast_to(parent[..., None], end.shape)
    fits = made.off <= limits.within
    # The last arc of a biarc has about half its length.
    return _as_candidates(
        pieces, rows, span, (end, 0.5 * ways, parents), (i, j, k), (own, fits, made.ratio)
    )


def _as_candidates(
    pieces: FitPieces, rows: IntArray, span: FloatArray,
    tried: tuple[FloatArray, FloatArray, IntArray], at: tuple[IntArray, ...],
    made: tuple[FloatArray, NDArray[np.bool_], FloatArray | float],
) -> ArcCandidates:  # fmt: skip
    """Put what was tried side by side."""
    end, ways, parent = tried
    angle, ratio, tilt = (np.zeros(end.shape) for _ in range(3))
    good = np.zeros(end.shape, bool)
    angle[at], good[at], ratio[at] = made
    tilt[at] = pieces.tilt(rows[at[0]], end[at], made[0])
    flat = len(rows), int(np.prod(end.shape[1:]))
    t = _distance_along(span, end)
    return ArcCandidates(
        end.reshape(flat), angle.reshape(flat), ways.reshape(flat), parent.reshape(flat),
        ratio.reshape(flat), t.reshape(flat), tilt.reshape(flat), good.reshape(flat),
    )  # fmt: skip
