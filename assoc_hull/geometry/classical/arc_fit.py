"""Fit plane curves by few arcs within a tolerance, with tangents that do not break.

Curves are cut at corners and straight runs into pieces, pieces become chains (both in
`arc_chain_search`), chains become arc records (`ArcLinks`), and the distance between arcs and
curves is measured both ways on ten times as many places as the search used. A piece that does not
keep the tolerance there is searched again with more places.
"""

from __future__ import annotations

from typing import Self

import attrs
import numpy as np

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.arc_chain_search import (
    ArcChain,
    ArcLimits,
    FitPieces,
    search_chains,
)
from assoc_hull.geometry.classical.biarc_family import biarcs_by_ratio
from assoc_hull.geometry.classical.checked_input import digits, finite_array, wrap_angle
from assoc_hull.geometry.classical.circular_arcs import PlaneArcs, sinc
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze

__all__ = [
    "ArcDeviation",
    "ArcFit",
    "ArcLinks",
    "fit_arcs",
    "measure_deviation",
    "merge_arcs",
]

# --------------------------------------------------------------------------------------
# Links: what a chain is made of, a straight line, an arc or a biarc over a stretch of a piece.

_SAME = 1e-10
"""m, rad: arcs that one arc replaces may leave it, and turn from it, by no more."""

_STRAIGHT_TURN = 1e-11
"""rad: an arc that turns by less is a straight line."""

_MOST_TURN = 3.0
"""rad: the ends of a longer arc determine it poorly."""


@attrs.frozen(eq=False)
class ArcLinks:
    """Links of many pieces, in order.

    Attributes
    ----------
    piece : (n,) int
        The piece of each.
    low, high : (n,)
        Parameters of the piece.
    arcs : PlaneArcs
        Their arcs.
    arc : (n, 2) int
        First and last arc of each, the same one but for biarcs.
    """

    piece: IntArray
    low: FloatArray
    high: FloatArray
    arcs: PlaneArcs
    arc: IntArray

    def __attrs_post_init__(self) -> None:
        freeze(self.piece, self.low, self.high, self.arc)

    @classmethod
    def of(cls, pieces: FitPieces, chains: dict[int, ArcChain]) -> Self:
        """Make the records of chains by piece; straight pieces need none.

        Pieces that are neither straight nor in `chains` are left out.
        """
        rows = [i for i in range(len(pieces)) if pieces.straight[i] or i in chains]
        parts = [chains[i] if i in chains else _line(pieces, i) for i in rows]
        piece = np.repeat(np.array(rows, np.int64), [len(each.ratio) for each in parts])
        cut = {
            "low": [each.w[:-1] for each in parts], "high": [each.w[1:] for each in parts],
            "begin": [each.angle[:-1] for each in parts],
            "end": [each.angle[1:] for each in parts], "ratio": [each.ratio for each in parts],
        }  # fmt: skip
        low, high, begin, end, ratio = (
            np.concatenate([*each, np.zeros(0)]) for each in cut.values()
        )
        arcs, arc = _records(pieces, piece, (low, high), (begin, end), ratio)
        return cls(piece, low, high, arcs, arc)


def _line(pieces: FitPieces, row: int) -> ArcChain:
    ends = np.array([pieces.first[row], pieces.stop[row]], np.float64)
    return ArcChain(ends, pieces.angle[row].copy(), np.array([np.nan]))


def _records(
    pieces: FitPieces, piece: IntArray, w: tuple[FloatArray, FloatArray],
    angle: tuple[FloatArray, FloatArray], ratio: FloatArray,
) -> tuple[PlaneArcs, IntArray]:  # fmt: skip
    """Give the arcs of links, and the first and last of each."""
    begin, end = (pieces.at(piece, each) for each in w)
    step = end - begin
    chord, course = np.hypot(step[:, 0], step[:, 1]), np.arctan2(step[:, 1], step[:, 0])
    alpha, beta = (wrap_angle(each - course) for each in angle)
    pair = np.isfinite(ratio)
    count = np.where(pair, 2, 1)
    last = np.cumsum(count) - 1
    first = last - count + 1
    start = np.empty((int(count.sum()), 2))
    way, bend, length = (np.empty(len(start)) for _ in range(3))
    one = first[~pair]
    start[one], way[one] = begin[~pair], angle[0][~pair]
    bend[one] = -2.0 * np.sin(alpha[~pair]) / chord[~pair]
    length[one] = chord[~pair] / sinc(alpha[~pair])
    made = biarcs_by_ratio(chord[pair], alpha[pair], beta[pair], ratio[pair])
    cosine, sine = np.cos(course[pair]), np.sin(course[pair])
    x, y = made.join
    join = begin[pair] + np.stack([cosine * x - sine * y, sine * x + cosine * y], axis=1)
    for arc, place, direction, k in (
        (first[pair], begin[pair], angle[0][pair], 0),
        (last[pair], join, course[pair] + made.tau, 1),
    ):
        start[arc], way[arc], bend[arc], length[arc] = (
            place, direction, made.bend[k], made.length[k]
        )  # fmt: skip
    bend[np.abs(bend * length) < _STRAIGHT_TURN] = 0.0
    return PlaneArcs(start, wrap_angle(way), bend, length), np.stack([first, last], axis=1)


def merge_arcs(arcs: PlaneArcs, group: IntArray) -> tuple[PlaneArcs, IntArray]:
    """Join neighbours that lie on one circle or line; arcs of different groups (n,) stay apart.

    Gives the arcs, and the first of the given arcs in each, (k,).

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.classical.arc_fit import merge_arcs
    >>> from assoc_hull.geometry.classical.circular_arcs import PlaneArcs
    >>> one = PlaneArcs.make([[0, 0]], [0.0], [0.5], [2.0])
    >>> join = one.at(np.array([0]), [0.5])[0]
    >>> both = PlaneArcs.make([[0, 0], join], [0, 0.25], [0.5, 0.5], [0.5, 1.5])
    >>> len(merge_arcs(both, np.zeros(2, int))[0])
    1
    """
    if not len(arcs):
        return arcs, np.zeros(0, np.int64)
    ends, turned = arcs.ends(), arcs.end_angles()
    both = arcs.length[:-1] + arcs.length[1:]
    step = np.abs(np.diff(arcs.curvature)) * both
    # A step of curvature k over the length l leaves the middle by k l^2 / 8.
    same = (np.diff(group) == 0) & (step < _SAME) & (step * both < 8.0 * _SAME)
    same &= np.abs(wrap_angle(turned[:-1] - arcs.angle[1:])) < _SAME
    first = np.flatnonzero(np.append(True, ~same))
    turn = np.add.reduceat(arcs.curvature * arcs.length, first)
    if (np.abs(turn) > _MOST_TURN).any():
        # A circle that closes: every arc of it stays as it is.
        wide = np.repeat(np.abs(turn) > _MOST_TURN, np.diff(np.append(first, len(arcs))))
        first = np.flatnonzero(np.append(True, ~same | wide[1:]))
        turn = np.add.reduceat(arcs.curvature * arcs.length, first)
    last = np.append(first[1:], len(arcs)) - 1
    alone = first == last
    chord_step = ends[last] - arcs.start[first]
    chord = np.hypot(chord_step[:, 0], chord_step[:, 1])
    course = np.arctan2(chord_step[:, 1], chord_step[:, 0])
    angle, bend, length = course - 0.5 * turn, 2.0 * np.sin(0.5 * turn) / chord, chord
    length = length / sinc(0.5 * turn)
    return (
        PlaneArcs(
            arcs.start[first],
            np.where(alone, arcs.angle[first], wrap_angle(angle)),
            np.where(alone, arcs.curvature[first], bend),
            np.where(alone, arcs.length[first], length),
        ),
        first,
    )


# --------------------------------------------------------------------------------------
# Deviation of arcs and curves, both ways, densely sampled. What is given is never too small: the
# distance to a link is that to its own arcs, and a place on an arc is as far from the curve as from
# the foot that was found.

_STEPS = 4
"""Steps of Newton's rule towards the foot on the curve."""


@attrs.frozen(eq=False)
class ArcDeviation:
    """Largest distances per link.

    Attributes
    ----------
    curve : (n,), m
        Of places on the curve from the arcs.
    arcs : (n,), m
        Of places on the arcs from the curve.
    w : (n,)
        The place on the curve that is farthest.
    """

    curve: FloatArray
    arcs: FloatArray
    w: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.curve, self.arcs, self.w)

    @property
    def most(self) -> FloatArray:
        """The larger of both, (n,), m."""
        return np.asarray(np.maximum(self.curve, self.arcs))


def measure_deviation(pieces: FitPieces, links: ArcLinks, samples: int) -> ArcDeviation:
    """Measure links against their stretches of the curves, at `samples` places each way."""
    if not len(links.piece):
        return ArcDeviation(np.zeros(0), np.zeros(0), np.zeros(0))
    w = _link_parameters(links, samples)
    piece = links.piece[:, None]
    places = pieces.at(piece, w)
    off = _from_arcs(links, places)
    row, worst = np.arange(len(w)), np.argmax(off, axis=1)
    return ArcDeviation(off[row, worst], _from_curve(pieces, links, w, places), w[row, worst])


def _link_parameters(links: ArcLinks, samples: int) -> FloatArray:
    """Give parameters along the links, (n, samples), points of the curves among them.

    Cubics may be of very different lengths: what lies between two parameters belongs to one.
    """
    step = (links.high - links.low)[:, None] / (samples - 1)
    w = links.low[:, None] + step * np.arange(samples)
    w[:, -1] = links.high
    whole = np.round(w)
    near = np.abs(w - whole) <= 0.5 * step
    near[:, [0, -1]] = False
    w[near] = whole[near]
    # The ends stay; a point of the curve beside one takes the place next to it.
    for end, beside, point in ((0, 1, np.ceil(w[:, 0])), (-1, -2, np.floor(w[:, -1]))):
        gap = np.abs(point - w[:, end])
        close = (gap > 0.0) & (gap <= 0.5 * step[:, 0])
        w[close, beside] = point[close]
    return w


def _from_arcs(links: ArcLinks, places: FloatArray) -> FloatArray:
    """Give the distances of places, (n, k, 2), from the arcs of their links, (n, k)."""
    flat = places.reshape(-1, 2)
    found = [
        links.arcs.distance(np.repeat(links.arc[:, end], places.shape[1]), flat) for end in (0, 1)
    ]
    return np.asarray(np.minimum(*found).reshape(places.shape[:2]))


def _from_curve(
    pieces: FitPieces, links: ArcLinks, w: FloatArray, places: FloatArray
) -> FloatArray:
    """Give the largest distance of places on the arcs of each link from its curve, (n,), m."""
    count = w.shape[1]
    length = links.arcs.length
    first, last = links.arc.T
    whole = np.where(first == last, length[first], length[first] + length[last])
    t = whole[:, None] * np.linspace(0.0, 1.0, count)
    behind = (t > length[first][:, None]) & (first != last)[:, None]
    arc = np.where(behind, last[:, None], first[:, None])
    on = np.where(behind, t - length[first][:, None], t)
    q = links.arcs.at(arc.ravel(), on.ravel()).reshape(*t.shape, 2)
    # Arcs and curve run side by side: the same part of the way is a good guess of the foot.
    step = np.diff(places, axis=1)
    run = np.concatenate(
        [np.zeros((len(w), 1)), np.cumsum(np.hypot(step[..., 0], step[..., 1]), axis=1)], axis=1
    )
    run /= run[:, -1:]
    # Shifted by 2 for each link, so that one call serves all of them.
    shift = 2.0 * np.arange(len(w))[:, None]
    part = (t / whole[:, None] + shift).ravel()
    foot = np.interp(part, (run + shift).ravel(), w.ravel()).reshape(t.shape)
    # From there by no more than a place to either side: beyond a point all is of another length.
    number = np.searchsorted((run + shift).ravel(), part, "right") - 1
    own = number.reshape(t.shape) - count * np.arange(len(w))[:, None]
    low, high = (np.take_along_axis(w, np.clip(own + by, 0, count - 1), axis=1) for by in (-1, 2))
    piece = np.broadcast_to(links.piece[:, None], t.shape)
    least = np.full(t.shape, np.inf)
    for step_number in range(_STEPS + 1):
        away = pieces.at(piece, foot) - q
        least = np.minimum(least, np.hypot(away[..., 0], away[..., 1]))
        if step_number == _STEPS:
            break
        slope = pieces.slope(piece, foot)
        gain = (away * slope).sum(axis=-1) / np.maximum((slope * slope).sum(axis=-1), 1e-300)
        foot = np.clip(foot - gain, low, high)
    return np.asarray(least.max(axis=1))


# --------------------------------------------------------------------------------------
# The fit.

_SAMPLES = 24
"""Places along a candidate in the first search."""

_DENSER = 10
"""Places of the measurement for each of the search."""

_MARGIN = 0.98
"""The search keeps this part of the tolerance; the rest is for what lies between its places."""

_FLAT = 0.002
"""A straight run leaves its chord by no more than this part of the tolerance,"""

_FLATTEST = 1e-5
"""and m: what is straight does not depend on how coarse arcs may be."""

_AGAIN = 4
"""So many times a piece is searched; what is too far off then is reported as it is."""


@attrs.frozen(eq=False)
class ArcFit:
    """Chains of arcs.

    Attributes
    ----------
    arcs : PlaneArcs
        Of all curves, in order.
    start : (m + 1,) int
        Where those of each curve begin.
    smooth : (n,) bool
        Whether an arc begins in the direction in which the one before it ends; false at the
        beginning of a curve and at corners.
    deviation : (m, 2), m
        Largest distance of the curve from its arcs, and of the arcs from their curve.
    place : (m, 2), m
        The place on each curve that is farthest.
    stuck : (m,) bool
        Curves of which no arcs could be made within the limits; these have none.
    sharpest : (m, 3)
        Where a curve is bent most, of such curves: the place (m) and the radius (m); else nan.
    """

    arcs: PlaneArcs
    start: IntArray
    smooth: np.typing.NDArray[np.bool_]
    deviation: FloatArray
    place: FloatArray
    stuck: np.typing.NDArray[np.bool_]
    sharpest: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.start, self.smooth, self.deviation, self.place, self.stuck, self.sharpest)

    def of(self, curve: int) -> PlaneArcs:
        """Give the arcs of one curve."""
        own = slice(int(self.start[curve]), int(self.start[curve + 1]))
        arcs = self.arcs
        return PlaneArcs(arcs.start[own], arcs.angle[own], arcs.curvature[own], arcs.length[own])


def fit_arcs(
    cubic: FloatArray, start: IntArray, within: float, least_radius: float = 0.0
) -> ArcFit:
    """Make chains of arcs of plane curves.

    Parameters
    ----------
    cubic : (p, 4, 2), m
        Cubics of all curves, in order, one beginning where the one before ends: coefficients
        of 1, u, u^2, u^3, u from 0 to 1.
    start : (m + 1,) int
        Where the cubics of each curve begin.
    within : float, m
        How far arcs may lie from their curve, and it from them.
    least_radius : float, m
        Of all arcs; 0 leaves them free.

    Raises
    ------
    GeometryError
        Arrays of other shapes, numbers that are not finite, a tolerance that is not above 0, a
        cubic that is a point.
    """
    cubic, start = _checked_cubics(cubic, start)
    within, least_radius = (
        _positive_length(within, "within"),
        _positive_length(least_radius, "least_radius"),
    )
    if within == 0.0:
        raise GeometryError("arcs: within is 0", "give a tolerance above 0, m", {"within": 0.0})
    pieces = FitPieces.of(cubic, start, min(_FLAT * within, _FLATTEST))
    # An arc of the least radius itself must not be refused by rounding.
    bend = np.inf if least_radius <= 0.0 else (1.0 + 1e-12) / least_radius
    made, links, off = _searched_links(pieces, ArcLimits(_MARGIN * within, bend, _SAMPLES), within)
    curve = pieces.curve[links.piece]
    count = len(start) - 1
    stuck = np.ones(count, bool)
    stuck[curve] = False
    lost = [i for i in range(len(pieces)) if not pieces.straight[i] and i not in made]
    stuck[pieces.curve[lost]] = True
    deviation, place = _largest(pieces, links, off, count)
    deviation[stuck] = np.nan
    keep = ~stuck[curve]
    arcs, smooth, starts = _joined(pieces, links, keep, count)
    sharpest = np.full((count, 3), np.nan)
    for each in np.flatnonzero(stuck).tolist():
        sharpest[each] = _sharpest(pieces, [i for i in lost if pieces.curve[i] == each])
    return ArcFit(arcs, starts, smooth, deviation, place, stuck, sharpest)


def _checked_cubics(cubic: FloatArray, start: IntArray) -> tuple[FloatArray, IntArray]:
    """Take cubics and where those of each curve begin."""
    found = finite_array(cubic, "arcs", (None, 4, 2))
    starts = finite_array(start, "arcs", (None,))
    whole = starts.astype(np.int64)
    fits = len(whole) > 0 and whole[0] == 0 and whole[-1] == len(found)
    if not fits or (whole != starts).any() or (np.diff(whole) < 1).any():
        raise GeometryError(
            f"arcs: the beginnings of curves do not part {len(found)} cubics",
            "give rising numbers from 0 to their count", {"cubics": len(found)},
        )  # fmt: skip
    still = np.flatnonzero(np.abs(found[:, 1:]).max(axis=(1, 2)) == 0.0)
    if len(still):
        index = int(still[0])
        raise GeometryError(f"arcs: cubic {index} is a point", "leave it out", {"index": index})
    return found, whole


def _positive_length(value: float, name: str) -> float:
    """Take a length, m, 0 or more; `name` stands in the message."""
    found = float(finite_array(value, f"arcs: {name}", ()))
    if found < 0.0:
        raise GeometryError(f"arcs: {name} is {digits(found)}", "give a length in m", {name: found})
    return found


def _searched_links(
    pieces: FitPieces, limits: ArcLimits, within: float
) -> tuple[dict[int, ArcChain], ArcLinks, ArcDeviation]:
    """Search all pieces, measure them, and search those again that are too far off."""
    made: dict[int, ArcChain] = {}
    rows = np.flatnonzero(~pieces.straight)
    samples = _DENSER * limits.samples
    for _ in range(_AGAIN):
        found = search_chains(pieces, rows, limits)
        made |= {
            row: each for row, each in zip(rows.tolist(), found, strict=True)
            if isinstance(each, ArcChain)
        }  # fmt: skip
        links = ArcLinks.of(pieces, made)
        off = measure_deviation(pieces, links, samples)
        far = np.unique(links.piece[off.most > within])
        rows = far[~pieces.straight[far]]
        if not len(rows):
            return made, links, off
        for row in rows.tolist():
            del made[row]
        limits = attrs.evolve(limits, within=0.95 * limits.within, samples=2 * limits.samples)
    links = ArcLinks.of(pieces, made)
    return made, links, measure_deviation(pieces, links, samples)


def _largest(
    pieces: FitPieces, links: ArcLinks, off: ArcDeviation, count: int
) -> tuple[FloatArray, FloatArray]:
    """Give deviations (count, 2), m, and farthest places (count, 2), m, of whole curves."""
    deviation, place = np.zeros((count, 2)), np.full((count, 2), np.nan)
    curve = pieces.curve[links.piece]
    np.maximum.at(deviation[:, 0], curve, off.curve)
    np.maximum.at(deviation[:, 1], curve, off.arcs)
    order = np.lexsort((-off.curve, curve))
    first = order[np.unique(curve[order], return_index=True)[1]]
    place[curve[first]] = pieces.at(links.piece[first], off.w[first])
    return deviation, place


def _joined(
    pieces: FitPieces, links: ArcLinks, keep: np.typing.NDArray[np.bool_], count: int
) -> tuple[PlaneArcs, np.typing.NDArray[np.bool_], IntArray]:
    """Give the arcs of curves, neighbours of one circle as one, and which go on smoothly."""
    first, last = links.arc[keep].T
    numbers = np.concatenate([first, last[last != first]])
    curve = pieces.curve[links.piece[keep]]
    curves = np.concatenate([curve, curve[last != first]])
    order = np.argsort(numbers, kind="stable")
    numbers, curves = numbers[order], curves[order]
    # Groups end at corners between pieces and at ends of curves.
    old = links.arcs
    ends = old.end_angles()
    turned = np.abs(np.angle(np.exp(1j * (old.angle[numbers[1:]] - ends[numbers[:-1]]))))
    cut = (turned > 1e-9) | (np.diff(curves) != 0)
    group = np.concatenate([[0], np.cumsum(cut)]) if len(numbers) else np.zeros(0, np.int64)
    arcs = PlaneArcs(*(each[numbers] for each in (old.start, old.angle, old.curvature, old.length)))
    arcs, begin = merge_arcs(arcs, group)
    smooth = np.append(False, np.diff(group[begin]) == 0)[: len(begin)]
    return arcs, smooth, np.searchsorted(curves[begin], np.arange(count + 1))


def _sharpest(pieces: FitPieces, rows: list[int]) -> FloatArray:
    """Give the place (m) and the radius (m) where some pieces are bent most, (3,)."""
    best = np.array([np.nan, np.nan, np.inf])
    for row in rows:
        w = np.linspace(
            pieces.first[row], pieces.stop[row], 200 * int(pieces.stop[row] - pieces.first[row]) + 1
        )
        piece = np.full(len(w), row)
        with np.errstate(divide="ignore", invalid="ignore"):
            radius = 1.0 / np.abs(pieces.curvature(piece, w))
        at = int(np.nanargmin(radius))
        if radius[at] < best[2]:
            best = np.append(pieces.at(piece[at], w[at : at + 1])[0], radius[at])
    return best
