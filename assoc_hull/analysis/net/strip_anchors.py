"""The lines that run along the strips of a surface: from a place on one rail to one on the other.

`line_spans` cuts all lines along the ship where they cross sections and ends; `strip_anchors` finds
which stretches run along which strip, and takes those that do not cross one another. All strips are
looked at together, in arrays; only the order within a strip is found one anchor after the other.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.analysis.net.curve_net import CurveNet, CurvePart
from assoc_hull.analysis.net.strip_boundaries import StripBoundary
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.splines.segments import derivative, locate_by_knots, positions

__all__ = [
    "DECK",
    "KEEL",
    "LineSpans",
    "StripAnchors",
    "StripRails",
    "line_spans",
    "runs_monotonic",
    "strip_anchors",
]

_PLACES = ("boundary", "waterlines", "buttocks", "diagonals", "frames")
"""Where two lines cross one another between sections, the family that stands first is taken.

Borders of flats come last: a waterline that leaves the flat between two sections says more of
the hull there than the border, along which nothing bends.
"""

_APART = 1e-5
"""Anchors lie so far apart on both rails, in lengths of the rail."""

_SAMPLES = np.linspace(1e-6, 1.0 - 1e-6, 9)  # a knuckle at the end belongs to what follows
_STEADY = 0.02
"""Along an anchor x grows everywhere by this part of its mean growth at least."""

_SAME = 1e-6
"""Places on one curve so near to one another (m, of a short hull less) are one."""

_CORNER = 1e-4
"""A line that ends on a side this near to the rail, in lengths of the rail, ends at its corner.

Three curves of digitised lines that run to one place miss it by the rounding of their points.
"""

KEEL, DECK = -1, -2
"""In the place of a stretch: the anchor is the lower or the upper side of its strip."""

# --------------------------------------------------------------------------------------
# Lines along the ship, cut at sections and ends.


@attrs.frozen(eq=False)
class LineSpans:
    """Stretches of lines between neighbouring crossings with sections or ends of the hull.

    Attributes
    ----------
    curve : (n,) int
        The curve of each stretch.
    part : (n, 2), m
        The parameters between which it runs.
    rail : (n, 2) int
        The curves that it comes from and goes to.
    place : (n, 2), m
        Where on these.
    rank : (n,) int
        The place of its family.
    steady : (n,) bool
        Along the stretch x only grows, or only falls.
    course : (n, 5, 3), m
        The ends of each stretch and three places between, evenly spaced in x.
    same : float, m
        Places on one curve so near to one another are one.
    """

    curve: IntArray
    part: FloatArray
    rail: IntArray
    place: FloatArray
    rank: IntArray
    steady: NDArray[np.bool_]
    course: FloatArray
    same: float = _SAME


def line_spans(net: CurveNet) -> LineSpans:
    """Cut all lines along the ship at sections and ends."""
    passed = net.ends_on_transom
    rail = (net.end | np.isfinite(net.x)) & ~passed
    other, there = net.meets[:, ::-1], net.place[:, ::-1]
    marks = rail[other] & ~(rail | passed)[net.meets]
    order = np.lexsort((there[marks], other[marks], net.place[marks], net.meets[marks]))
    curve, crossed = net.meets[marks][order], other[marks][order]
    t, s = net.place[marks][order], there[marks][order]
    rank = np.zeros(net.batch.count, np.int64)
    for each in np.unique(curve).tolist():
        rank[each] = len(_PLACES) if net.flat[each] else _place(net, each)
    begin = np.flatnonzero((curve[1:] == curve[:-1]) & (t[1:] > t[:-1]))
    both = np.stack([begin, begin + 1], axis=1)
    own, part = curve[begin], t[both]
    steady, course = _walk(net.batch, own, part)
    return LineSpans(
        own, part, crossed[both], s[both], rank[own], steady, course, net.factor * _SAME
    )


def _place(net: CurveNet, curve: int) -> int:
    """Give the place of a line's family among those that run along the ship."""
    family = net.family[curve]
    if family not in _PLACES:
        raise BadInputError(
            f"{net.name[curve]} of the {family} is a curve in space, in no plane across the ship",
            "in the surface through the lines", "replace it by lines that lie in planes",
        )  # fmt: skip
    return _PLACES.index(family)


def runs_monotonic(net: CurveNet, parts: Sequence[CurvePart]) -> NDArray[np.bool_]:
    """Tell along which parts of curves x only grows, or only falls, and nowhere hardly at all."""
    curve = np.array([part[0] for part in parts], np.int64)
    ends = np.array([part[1:] for part in parts], np.float64).reshape(-1, 2)
    return _walk(net.batch, curve, ends)[0]


def _walk(
    batch: SplineBatch, curve: IntArray, part: FloatArray
) -> tuple[NDArray[np.bool_], FloatArray]:
    """Tell along which parts (n, 2), m, of curves x only grows, or falls; give their courses."""
    t = part[:, :1] + (part[:, 1:] - part[:, :1]) * _SAMPLES
    which = curve.repeat(t.shape[1])
    segment, fraction, _ = locate_by_knots(batch, which, t.ravel())
    place = positions(batch, segment, fraction).T.reshape(*t.shape, 3)
    guess = segment - batch.start.take(which)
    slope = derivative(batch, which, t.ravel(), guess=guess)[:, 0].reshape(t.shape)
    mean = (place[:, -1, 0] - place[:, 0, 0])[:, None] / (t[:, -1:] - t[:, :1])
    steady = ((slope * np.sign(mean) > _STEADY * np.abs(mean)) & (mean != 0.0)).all(axis=1)
    return steady, _courses(place)


def _courses(place: FloatArray) -> FloatArray:
    """Give ends of stretches and the places at 1/4, 1/2 and 3/4 of their length, (n, 5, 3).

    The length is that along the ship; places lie on straight lines between samples (n, k, 3).
    """
    ahead = np.where((place[:, -1:, :1] >= place[:, :1, :1]), place, place[:, ::-1])
    x, rows = ahead[..., 0], np.arange(len(place))[:, None]
    at = place[:, :1, 0] + (place[:, -1:, 0] - place[:, :1, 0]) * np.array([0.25, 0.5, 0.75])
    after = np.clip((x[:, None, :] <= at[..., None]).sum(axis=2), 1, x.shape[1] - 1)
    low, high = ahead[rows, after - 1], ahead[rows, after]
    width = high[..., 0] - low[..., 0]
    part = np.divide(at - low[..., 0], width, out=np.zeros_like(width), where=width > 0.0)
    between = low + (high - low) * np.clip(part, 0.0, 1.0)[..., None]
    return np.concatenate([place[:, :1], between, place[:, -1:]], axis=1)


# --------------------------------------------------------------------------------------
# Rails, and the stretches that run from one to the other.


@attrs.frozen(eq=False)
class StripRails:
    """The rails of s strips, to find places on them: the aft one of strip i is 2 i, then the other.

    Attributes
    ----------
    start : (2 s + 1,) int
        Where the parts of each rail begin.
    curve : (p,) int
        The curve of each part.
    ends : (p, 2), m
        The parameters between which it runs.
    base : (p,), m
        What of the rail lies before it.
    length : (2 s,), m
        Of the rails; zero for one that is a point.
    """

    start: IntArray
    curve: IntArray
    ends: FloatArray
    base: FloatArray
    length: FloatArray

    @classmethod
    def of(cls, frames: Sequence[StripBoundary]) -> StripRails:
        """Take the rails of strips."""
        rails = [rail for frame in frames for rail in (frame.aft, frame.fore)]
        base, length = list[float](), list[float]()
        for rail in rails:
            total = 0.0
            for _, t0, t1 in rail:
                base.append(total)
                total += abs(t1 - t0)
            length.append(total)
        parts = [part for rail in rails for part in rail]
        return cls(
            np.cumsum([0, *map(len, rails)]),
            np.array([part[0] for part in parts], np.int64),
            np.array([part[1:] for part in parts], np.float64).reshape(-1, 2),
            np.array(base, np.float64),
            np.array(length, np.float64),
        )

    @property
    def tips(self) -> tuple[IntArray, FloatArray]:
        """Where rails begin and end, as spots: parts (2 s, 2), m on them (2 s, 2)."""
        last = np.diff(self.start) - 1
        part = np.stack([np.zeros_like(last), last], axis=1)
        first = self.start[:-1]
        return part, np.stack([self.ends[first, 0], self.ends[first + last, 1]], axis=1)

    def height(self, rail: IntArray, part: IntArray, t: FloatArray) -> FloatArray:
        """Say how far up rails places on them are, (k,), from 0 to 1; 0 on a point."""
        at = self.start[rail] + part
        length = self.length[rail]
        up = self.base[at] + np.abs(t - self.ends[at, 0])
        found = np.divide(up, length, out=np.zeros(len(up)), where=length != 0.0)
        top = (at == self.start[rail + 1] - 1) & (t == self.ends[at, 1]) & (length != 0.0)
        return np.where(top, 1.0, found)


@attrs.frozen(eq=False)
class _Spots:
    """Where ends of stretches lie on rails: end 2 i is where stretch i comes from, then the other.

    `rail`, `end`, `part` (h,) int and `t` (h,), m; each pair of a rail and an end once.
    """

    rail: IntArray
    end: IntArray
    part: IntArray
    t: FloatArray


def _spots(frames: Sequence[StripBoundary], rails: StripRails, every: LineSpans) -> _Spots:
    """Find all ends of stretches on rails, and at corners, where a side joins its rail."""
    size = np.diff(rails.start)
    corners = _corners(frames)
    where, curve, at, upper = (np.array([each[i] for each in corners]) for i in range(4))
    where, curve, upper = where.astype(np.int64), curve.astype(np.int64), upper.astype(np.int64)
    part, tip = rails.tips
    # One list of all places on which a line may end: parts of rails, then corners.
    rail = np.concatenate([np.arange(len(size)).repeat(size), where])
    own = np.concatenate([rails.curve, curve])
    number = np.arange(len(rails.curve)) - rails.start[:-1].repeat(size)
    number = np.concatenate([number, part[where, upper]])
    low = np.concatenate([rails.ends.min(axis=1), at])
    high = np.concatenate([rails.ends.max(axis=1), at])
    spot = np.concatenate([np.full(len(rails.curve), np.nan), tip[where, upper]])
    near = np.maximum(every.same, _CORNER * rails.length[where])
    place, end = _matching(own, every.rail.ravel())
    t = every.place.ravel()[end]
    count = len(rails.curve)
    good = (low[place] - every.same <= t) & (t <= high[place] + every.same)
    corner = place >= count
    good[corner] = np.abs(low[place[corner]] - t[corner]) <= near[place[corner] - count]
    place, end, t = place[good], end[good], t[good]
    # Of several places of one rail the first counts.
    order = np.lexsort((place, end, rail[place]))
    place, end, t = place[order], end[order], t[order]
    new = np.ones(len(place), np.bool_)
    new[1:] = (np.diff(end) != 0) | (np.diff(rail[place]) != 0)
    place, end, t = place[new], end[new], t[new]
    inside = np.minimum(np.maximum(t, low[place]), high[place])
    t = np.where(np.isnan(spot[place]), inside, spot[place])
    return _Spots(rail[place], end, number[place], t)


def _corners(frames: Sequence[StripBoundary]) -> list[tuple[int, int, float, int]]:
    """Give where sides join rails: the rail, the curve of the side, m on it, and 1 for the top."""
    found = list[tuple[int, int, float, int]]()
    for i, frame in enumerate(frames):
        for rail, end, at in ((2 * i, 1, 0), (2 * i + 1, 2, -1)):
            for upper, side in ((0, frame.keel), (1, frame.deck)):
                if side:
                    found.append((rail, side[at][0], side[at][end], upper))
    return found


def _matching(own: IntArray, wanted: IntArray) -> tuple[IntArray, IntArray]:
    """Give all pairs of an `own` and a `wanted` that are the same number."""
    order = np.argsort(own, kind="stable")
    begin, finish = (np.searchsorted(own[order], wanted, side) for side in ("left", "right"))
    count = finish - begin
    which = np.arange(len(wanted)).repeat(count)
    step = np.arange(len(which)) - (np.cumsum(count) - count)[which]
    return order[begin[which] + step], which


@attrs.frozen(eq=False)
class _Candidates:
    """Stretches that run along strips.

    `strip`, `span` (k,) int; `turned` (k,) bool: it comes from the forward rail; `part` (k, 2) int
    and `t` (k, 2), m: where on both rails; `low`, `high` (k,): how far up these, from 0 to 1.
    """

    strip: IntArray
    span: IntArray
    turned: NDArray[np.bool_]
    part: IntArray
    t: FloatArray
    low: FloatArray
    high: FloatArray

    def take(self, rows: IntArray | NDArray[np.bool_]) -> _Candidates:
        """Give some of them."""
        return _Candidates(*(each[rows] for each in attrs.astuple(self, recurse=False)))


def _candidates(
    frames: Sequence[StripBoundary], rails: StripRails, every: LineSpans
) -> _Candidates:
    """Find the stretches of lines from one rail to the other."""
    found, ends = _spots(frames, rails, every), 2 * len(every.curve)
    strip, fore = found.rail // 2, found.rail % 2 == 1
    # What ends on the aft rail must end with its other end on the forward one.
    key = strip * ends + np.where(fore, found.end ^ 1, found.end)
    _, aft_at, fore_at = np.intersect1d(
        key[~fore], key[fore], assume_unique=True, return_indices=True
    )
    aft, ahead = np.flatnonzero(~fore)[aft_at], np.flatnonzero(fore)[fore_at]
    both = np.stack([aft, ahead], axis=1)
    span, turned = found.end[aft] // 2, found.end[aft] % 2 == 1
    part, t = found.part[both], found.t[both]
    up = [rails.height(found.rail[at], found.part[at], found.t[at]) for at in (aft, ahead)]
    point = rails.length[found.rail[both]] == 0.0
    low, high = np.where(point[:, 0], up[1], up[0]), np.where(point[:, 1], up[0], up[1])
    each = _Candidates(strip[aft], span, turned, part, t, low, high)
    # A line that sets off almost athwartships, as over the bottom of a flat run, would skew
    # the surface between sections and transoms.
    across = np.array([frame.across for frame in frames], np.bool_)
    good = every.steady[span] | ~across[each.strip]
    # A line that could run both ways is taken as it is drawn.
    good[1:] &= (np.diff(span) != 0) | (np.diff(each.strip) != 0) | ~good[:-1]
    return each.take(good)


def _pointed(frame: StripBoundary, t: FloatArray, same: float) -> StripBoundary | None:
    """Give the frame with a rail that is a point, if all anchors run to one within `same`, m.

    They are at t (k, 2), m, on both rails.
    """
    if frame.plane or len(t) < 2:
        return None
    if len(frame.fore) == 1 and np.ptp(t[:, 1]) <= same:
        (curve, t0, t1), tip = frame.fore[0], float(t[0, 1])
        return attrs.evolve(
            frame,
            fore=((curve, tip, tip),),
            keel=(*frame.keel, (curve, t0, tip)),
            deck=(*frame.deck, (curve, t1, tip)),
        )
    if len(frame.aft) == 1 and np.ptp(t[:, 0]) <= same:
        (curve, t0, t1), tip = frame.aft[0], float(t[0, 0])
        return attrs.evolve(
            frame,
            aft=((curve, tip, tip),),
            keel=((curve, tip, t0), *frame.keel),
            deck=((curve, tip, t1), *frame.deck),
        )
    return None


# --------------------------------------------------------------------------------------
# Anchors from keel to deck.


@attrs.frozen(eq=False)
class StripAnchors:
    """The anchors of strips, from keel to deck, their sides included.

    Attributes
    ----------
    rails : StripRails
        The rails they lie on.
    start : (s + 1,) int
        Where the anchors of each strip begin.
    span : (a,) int
        The stretch of each; `KEEL` and `DECK` for the sides.
    turned : (a,) bool
        It is walked against the sense in which it is drawn.
    part : (a, 2) int
        The parts of the rails aft and forward on which it ends.
    t : (a, 2), m
        Where on these.
    height : (a,)
        How far up the strip it lies, from 0 to 1: it may pass the rails at different heights.
    """

    rails: StripRails
    start: IntArray
    span: IntArray
    turned: NDArray[np.bool_]
    part: IntArray
    t: FloatArray
    height: FloatArray


def strip_anchors(
    frames: Sequence[StripBoundary], every: LineSpans, straight: NDArray[np.bool_] | None = None
) -> tuple[list[StripBoundary], StripAnchors]:
    """Give the anchors of strips; those chosen by `straight` (s,) have none but their sides.

    Where lines cross between the rails those of the family that stands first stay; the others
    go through the rails' points all the same. Where all lines run to one point of a rail (the
    tip of an ellipsoid) the rail is that point, and what lay on either side of it becomes a
    side: the frame is given back as it is then.
    """
    kept = list(frames)
    rails = StripRails.of(kept)
    found = _candidates(kept, rails, every)
    pointed = False
    for i, frame in enumerate(kept):
        if not frame.plane:
            tip = _pointed(frame, found.t[found.strip == i], every.same)
            kept[i], pointed = (frame, pointed) if tip is None else (tip, True)
    if pointed:
        rails = StripRails.of(kept)
        found = _candidates(kept, rails, every)
    if straight is not None:
        found = found.take(~straight[found.strip])
    order = np.lexsort((found.span, found.high, found.low, every.rank[found.span], found.strip))
    return kept, _anchors(rails, found.take(order), every)


def _anchors(rails: StripRails, found: _Candidates, every: LineSpans) -> StripAnchors:
    """Take candidates, sorted by strip and by what comes first, and put the sides round them."""
    count = len(rails.length) // 2
    taken = _taken(count, found, every)
    start = np.cumsum([0, *map(len, taken)])
    at = np.array([each for one in taken for each in one], np.int64)
    side = at < 0
    strip = np.arange(count).repeat(np.diff(start))
    upper, own = (at == DECK).astype(np.int64), np.where(side, 0, at)
    rail = 2 * strip[side][:, None] + np.arange(2)
    part, t = np.zeros((len(at), 2), np.int64), np.zeros((len(at), 2))
    part[side], t[side] = (each[rail, upper[side][:, None]] for each in rails.tips)
    part[~side], t[~side] = found.part[at[~side]], found.t[at[~side]]
    height = 1.0 * upper
    height[~side] = 0.5 * (found.low + found.high)[at[~side]]
    span, turned = at.copy(), np.zeros(len(at), np.bool_)
    span[~side], turned[~side] = found.span[own[~side]], found.turned[own[~side]]
    return StripAnchors(rails, start, span, turned, part, t, height)


def _taken(count: int, found: _Candidates, every: LineSpans) -> list[list[int]]:
    """Give the candidates that each strip takes, from `KEEL` to `DECK`.

    First as if none crossed another on its way; where some do, which is seldom, once more.
    """
    low, high = found.low.tolist(), found.high.tolist()
    edge = np.searchsorted(found.strip, np.arange(count + 1)).tolist()
    every_one, pairs, owner = list[list[int]](), list[tuple[int, int]](), list[int]()
    for i in range(count):
        order, beside = _in_order(range(edge[i], edge[i + 1]), low, high, None)
        every_one.append(order)
        pairs += beside
        owner += [i] * len(beside)
    pair = np.array(pairs, np.int64).reshape(-1, 2)
    course = every.course[found.span]
    course[found.turned] = course[found.turned, ::-1]
    crossed = _crossed(course[pair[:, 0]], course[pair[:, 1]])
    for i in np.unique(np.array(owner, np.int64)[crossed]).tolist():
        own = course[edge[i] : edge[i + 1]]
        known = _crossed(own[:, None], own[None])
        every_one[i] = _in_order(range(edge[i], edge[i + 1]), low, high, known)[0]
    return every_one


def _in_order(
    chosen: range, low: list[float], high: list[float], crossed: NDArray[np.bool_] | None
) -> tuple[list[int], list[tuple[int, int]]]:
    """Take anchors one after the other that do not cross those taken.

    Also gives all pairs of candidates, the lower first, that were neighbours meanwhile.
    """
    taken, sums, beside = [KEEL, DECK], [0.0], list[tuple[int, int]]()
    first = chosen.start
    for i in chosen:
        aft, fore = low[i], high[i]
        place = bisect_right(sums, aft + fore)
        below, above = taken[place - 1], taken[place]
        if below < 0:
            apart = _leaves(aft, fore)
        else:
            apart = aft - low[below] > _APART and fore - high[below] > _APART
        if apart and above < 0:
            apart = _leaves(1.0 - aft, 1.0 - fore)
        elif apart:
            apart = low[above] - aft > _APART and high[above] - fore > _APART
        if not apart:
            continue
        new = [pair for pair in ((below, i), (i, above)) if pair[0] >= 0 <= pair[1]]
        if crossed is not None and any(crossed[j - first, k - first] for j, k in new):
            continue
        taken.insert(place, i)
        sums.insert(place, aft + fore)
        beside += new
    return taken, beside


def _leaves(aft: float, fore: float) -> bool:
    """Tell whether an anchor lies apart from a side on one rail at least, and joins it at most.

    A waterline that begins at the keel of a section makes a cell of three sides.
    """
    return max(aft, fore) > _APART and min(aft, fore) >= -_APART


def _crossed(below: FloatArray, above: FloatArray) -> NDArray[np.bool_]:
    """Tell which anchors change places with others on their way: there the surface would fold.

    Looked at is at which side one lies of the other, at three places between the rails; courses
    are (..., 5, 3), m.
    """
    apart = above - below
    ends = (apart[..., 0, :] + apart[..., -1, :])[..., None, :]
    # Term by term: sums of products by other ways depend on how many there are.
    x, y, z = np.moveaxis(apart[..., 1:-1, :] * ends, -1, 0)
    crossed: NDArray[np.bool_] = (x + y + z <= 0.0).any(axis=-1)
    return crossed
