"""The layout of a surface made the long way, strip by strip and cell by cell: to compare with.

It says what `assoc_hull.analysis.net` computes for all strips at once, in loops that can be read
one line after the other. Strips themselves, and which have a deck edge, are not made here.
"""

from __future__ import annotations

import itertools
from bisect import bisect_left, bisect_right
from collections.abc import Sequence

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.analysis.net.curve_net import CurveNet, CurvePart, station_planes
from assoc_hull.analysis.net.strip_boundaries import (
    StripBoundary,
    boundary_arcs,
    strip_boundaries,
)
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.integrals.area_moments import section_area
from assoc_hull.geometry.numeric.polynomials import hermite
from assoc_hull.geometry.splines.paths import Bit, Paths, shape_paths
from assoc_hull.geometry.splines.segments import derivative, evaluate, segment_start

__all__ = ["plain_layout", "plain_parallel_slabs"]

_PLACES = ("boundary", "waterlines", "buttocks", "diagonals", "frames")
_APART, _STEADY, _SAME, _CORNER, _SNAP, _SLIVER, _EQUAL = 1e-5, 0.02, 1e-6, 1e-4, 1e-9, 1e-10, 1e-4
_SAMPLES = np.linspace(1e-6, 1.0 - 1e-6, 9)


def plain_layout(
    net: CurveNet, length: float, deck: NDArray[np.bool_]
) -> tuple[list[StripBoundary], dict[str, NDArray[np.generic]]]:
    """Give strips, and all arrays of the layout by name; `deck`: strips with a closed deck."""
    x = station_planes(net)
    found, _ = strip_boundaries(net, boundary_arcs(net, x), len(x), length)
    every, parallel, draft = line_spans(net), plain_parallel_slabs(net, x), _Draft(net)
    for i, given in enumerate(found):
        found[i], run = strip_anchors(given, every)
        if given.plane and given.slab in parallel:
            run = [attrs.evolve(each, parts=()) for each in (run[0], run[-1])]
        for anchor in run:
            draft.anchor.append(draft.add(anchor.parts) if anchor.parts else -1)
        flat = [_side(each, net.flat) for each in run]
        knuckle = [_side(each, net.knuckle) for each in run]
        draft.flat += flat
        draft.knuckle += knuckle
        rails = [
            (
                draft.add(_between(found[i].aft, below.aft, above.aft)),
                draft.add(_between(found[i].fore, below.fore, above.fore)),
            )
            for below, above in itertools.pairwise(run)
        ]
        first, blend = blend_cubics(_anchor_heights(net, draft, rails), flat, knuckle)
        for j, (aft, fore) in enumerate(rails):
            draft.cell.append((int(first[j]), aft, fore))
            draft.blend.append(blend[j])
        draft.anchor_start.append(len(draft.anchor))
        draft.cell_start.append(len(draft.cell))
    return found, _arrays(net, draft, found, deck)


def _anchor_heights(net: CurveNet, draft: _Draft, rails: list[tuple[int, int]]) -> FloatArray:
    """Give how far up a strip each anchor lies, from 0 to 1: the mean of both rails."""
    knot, first, sides = net.batch.knot.tolist(), segment_start(net.batch).tolist(), []
    for side in (0, 1):
        up = [0.0]
        for rail in rails:
            whole = 0.0
            for segment, low, high in draft.paths[rail[side]]:
                at = first[segment]
                whole += (knot[at + 1] - knot[at]) * abs(high - low)
            up.append(up[-1] + whole)
        sides.append([each / up[-1] for each in up] if up[-1] > 0.0 else [])
    aft, fore = sides[0] or sides[1], sides[1] or sides[0]
    return np.array([0.5 * (one + other) for one, other in zip(aft, fore, strict=True)])


def _arrays(
    net: CurveNet, draft: _Draft, found: list[StripBoundary], deck: NDArray[np.bool_]
) -> dict[str, NDArray[np.generic]]:
    paths = Paths.of(draft.paths)
    walked = shape_paths(paths, net.batch)
    tiles: list[tuple[int, int, int, int, int]] = []
    tile_start, cell = [0], list[int]()
    start, begin = walked.paths.start.tolist(), walked.begin.tolist()
    for i in range(len(found)):
        for j in range(draft.cell_start[i], draft.cell_start[i + 1]):
            first, aft, fore = draft.cell[j]
            tiles += [(first, *tile) for tile in _tiles(start, begin, aft, fore)]
            cell += [j] * (len(tiles) - len(cell))
        if deck[i]:
            tiles.append((*tiles[-1][:3], -2, -1))
            cell.append(cell[-1])
        tile_start.append(len(tiles))
    columns = np.array(tiles, np.int64).reshape(-1, 5).T
    plane = [frame.plane and all(runs_monotonic(net, frame.keel + frame.deck)) for frame in found]
    return {
        "start": paths.start, "segment": paths.segment, "path low": paths.low,
        "path high": paths.high, "anchor_start": np.array(draft.anchor_start),
        "anchor": np.array(draft.anchor, np.int64), "tile_start": np.array(tile_start),
        "blend": np.array(draft.blend, np.float64).reshape(-1, 4, 4)[np.array(cell, np.int64)],
        **dict(zip(("first", "aft", "fore", "low", "high"), columns, strict=True)),
        "plane": np.array(plane, np.bool_), "cell": np.array(cell, np.int64),
        "cell_start": np.array(draft.cell_start), "flat": np.array(draft.flat, np.bool_),
        "rails": np.array([each[1:] for each in draft.cell], np.int64).reshape(-1, 2),
        "knuckle": np.array(draft.knuckle, np.bool_),
    }  # fmt: skip


def plain_parallel_slabs(net: CurveNet, x: FloatArray) -> frozenset[int]:
    """Give the slabs of the parallel body: every section is held against every other."""
    curves = np.flatnonzero(np.isfinite(net.x) & ~net.end)
    if not net.flat.any() or len(x) < 2:
        return frozenset()
    batch = SplineBatch.join([net.batch.part(i, i + 1) for i in curves.tolist()])
    station = np.abs(net.x[curves][:, None] - x).argmin(axis=1)
    top = np.full(len(x), -np.inf)
    np.maximum.at(top, station, np.maximum.reduceat(batch.xyz[:, 2], batch.start[:-1]))
    found = []
    for slab in range(1, len(x)):
        level = float(min(top[slab - 1], top[slab]))
        area = np.bincount(station, section_area(batch, level), len(x))
        if area[slab - 1 : slab + 1].min() >= (1.0 - _EQUAL) * area.max():
            found.append(slab)
    return frozenset(found)


CurvePlace = tuple[int, float]
"""A part of a rail by its number, and the parameter (m) on its curve."""


@attrs.frozen
class StripAnchor:
    """A line along a strip, from aft forward; how far up the rails it lies; five places."""

    parts: tuple[CurvePart, ...]
    aft: CurvePlace
    fore: CurvePlace
    low: float
    high: float
    course: FloatArray | None = attrs.field(default=None, eq=False)


@attrs.frozen
class LineSpans:
    """Stretches of lines: part, from where, to where, rank; which run between two curves."""

    span: tuple[tuple[CurvePart, CurvePlace, CurvePlace, int], ...]
    steady: tuple[bool, ...]
    of: dict[tuple[int, int], tuple[int, ...]]
    course: FloatArray
    same: float = _SAME


def line_spans(net: CurveNet) -> LineSpans:
    """Cut all lines along the ship at sections and ends."""
    passed = net.ends_on_transom
    rail = (net.end | np.isfinite(net.x)) & ~passed
    found: list[tuple[CurvePart, CurvePlace, CurvePlace, int]] = []
    marks: dict[int, list[tuple[float, int, float]]] = {}
    for both, place in zip(net.meets.tolist(), net.place.tolist(), strict=True):
        for own, other in ((0, 1), (1, 0)):
            if rail[both[other]] and not (rail[both[own]] or passed[both[own]]):
                marks.setdefault(both[own], []).append((place[own], both[other], place[other]))
    for curve in sorted(marks):
        order = sorted(marks[curve])
        rank = len(_PLACES) if net.flat[curve] else _PLACES.index(net.family[curve])
        for (t0, c0, s0), (t1, c1, s1) in itertools.pairwise(order):
            if t1 > t0:
                found.append(((curve, t0, t1), (c0, s0), (c1, s1), rank))
    of: dict[tuple[int, int], tuple[int, ...]] = {}
    for i, (_, (c0, _s0), (c1, _s1), _) in enumerate(found):
        key = (min(c0, c1), max(c0, c1))
        of[key] = (*of.get(key, ()), i)
    parts = [each[0] for each in found]
    return LineSpans(tuple(found), runs_monotonic(net, parts), of, _courses(net, parts),
                     net.factor * _SAME)  # fmt: skip


def runs_monotonic(net: CurveNet, parts: Sequence[CurvePart]) -> tuple[bool, ...]:
    """Tell along which parts of curves x only grows, or only falls, and nowhere hardly at all."""
    curve, t = _sampled(parts)
    slope = derivative(net.batch, curve.repeat(t.shape[1]), t.ravel())[:, 0].reshape(t.shape)
    ends = evaluate(net.batch, np.tile(curve, 2), np.concatenate([t[:, 0], t[:, -1]]))[:, 0]
    mean = (ends[len(curve) :] - ends[: len(curve)])[:, None] / (t[:, -1:] - t[:, :1])
    return tuple(
        ((slope * np.sign(mean) > _STEADY * np.abs(mean)) & (mean != 0.0)).all(axis=1).tolist()
    )


def _courses(net: CurveNet, parts: Sequence[CurvePart]) -> FloatArray:
    """Give ends of parts of curves and the places at 1/4, 1/2 and 3/4 of their length, (n, 5, 3).

    The length is that along the ship; places lie on straight lines between samples.
    """
    curve, t = _sampled(parts)
    flat: FloatArray = evaluate(net.batch, curve.repeat(t.shape[1]), t.ravel())
    place = flat.reshape(*t.shape, 3)
    ahead = np.where((place[:, -1:, :1] >= place[:, :1, :1]), place, place[:, ::-1])
    x, rows = ahead[..., 0], np.arange(len(place))[:, None]
    at = place[:, :1, 0] + (place[:, -1:, 0] - place[:, :1, 0]) * np.array([0.25, 0.5, 0.75])
    after = np.clip((x[:, None, :] <= at[..., None]).sum(axis=2), 1, x.shape[1] - 1)
    low, high = ahead[rows, after - 1], ahead[rows, after]
    width = high[..., 0] - low[..., 0]
    part = np.divide(at - low[..., 0], width, out=np.zeros_like(width), where=width > 0.0)
    between = low + (high - low) * np.clip(part, 0.0, 1.0)[..., None]
    return np.concatenate([place[:, :1], between, place[:, -1:]], axis=1)


def _sampled(parts: Sequence[CurvePart]) -> tuple[IntArray, FloatArray]:
    """Give the curves of parts, (n,), and parameters along them, (n, k), m."""
    begin, finish = (np.array([part[i] for part in parts], np.float64)[:, None] for i in (1, 2))
    return np.array([part[0] for part in parts], np.int64), begin + (finish - begin) * _SAMPLES


def strip_anchors(
    frame: StripBoundary, every: LineSpans
) -> tuple[StripBoundary, list[StripAnchor]]:
    """Give the anchors of a strip from keel to deck, its sides included.

    Where lines cross between the rails those of the family that stands first stay; the others
    go through the rails' points all the same. Where all lines run to one point of a rail (the
    tip of an ellipsoid) the rail is that point, and what lay on either side of it becomes a
    side: the frame is given back as it is then.
    """
    found = _found(frame, every)
    pointed = _pointed(frame, [anchor for _, anchor in found], every.same)
    if pointed is not None:
        frame = pointed
        found = _found(frame, every)
    aft, fore = _rails(frame, every.same)
    keel = StripAnchor(frame.keel, aft.begin, fore.begin, 0.0, 0.0)
    deck = StripAnchor(frame.deck, aft.finish, fore.finish, 1.0, 1.0)
    return frame, _in_order(keel, deck, found)


def _rails(frame: StripBoundary, same: float) -> tuple[_Rail, _Rail]:
    return (
        _Rail.of(frame.aft, frame.keel[:1], frame.deck[:1], 1, same),
        _Rail.of(frame.fore, frame.keel[-1:], frame.deck[-1:], 2, same),
    )


def _found(frame: StripBoundary, every: LineSpans) -> list[tuple[int, StripAnchor]]:
    """Find the stretches of lines from one rail to the other."""
    aft, fore = _rails(frame, every.same)
    found: list[tuple[int, StripAnchor]] = []
    for i in (
        i
        for a in aft.curves
        for f in fore.curves
        for i in every.of.get((min(a, f), max(a, f)), ())
        # A line that sets off almost athwartships, as over the bottom of a flat run, would skew
        # the surface between sections and transoms.
        if every.steady[i] or not frame.across
    ):
        part, begin, finish, rank = every.span[i]
        course = every.course[i]
        for one, other, way, run in (
            (begin, finish, part, course),
            (finish, begin, _turned(part), course[::-1]),
        ):
            low, high = aft.spot(one), fore.spot(other)
            if low is not None and high is not None:
                at = aft.height(low), fore.height(high)
                at = (at[1] if aft.is_point else at[0], at[0] if fore.is_point else at[1])
                found.append((rank, StripAnchor((way,), low, high, *at, run)))
                break
    return found


def _pointed(frame: StripBoundary, run: Sequence[StripAnchor], same: float) -> StripBoundary | None:
    """Give the frame with a rail that is a point, if all anchors run to one within `same`, m."""
    if frame.plane or len(run) < 2:
        return None
    if len(frame.fore) == 1 and np.ptp([each.fore[1] for each in run]) <= same:
        (curve, t0, t1), tip = frame.fore[0], run[0].fore[1]
        return attrs.evolve(
            frame,
            fore=((curve, tip, tip),),
            keel=(*frame.keel, (curve, t0, tip)),
            deck=(*frame.deck, (curve, t1, tip)),
        )
    if len(frame.aft) == 1 and np.ptp([each.aft[1] for each in run]) <= same:
        (curve, t0, t1), tip = frame.aft[0], run[0].aft[1]
        return attrs.evolve(
            frame,
            aft=((curve, tip, tip),),
            keel=((curve, tip, t0), *frame.keel),
            deck=((curve, tip, t1), *frame.deck),
        )
    return None


def _in_order(
    keel: StripAnchor, deck: StripAnchor, found: Sequence[tuple[int, StripAnchor]]
) -> list[StripAnchor]:
    """Take anchors one after the other that do not cross those taken."""
    taken = [keel, deck]
    for _, anchor in sorted(found, key=lambda each: (each[0], each[1].low, each[1].high)):
        place = sum(other.low + other.high <= anchor.low + anchor.high for other in taken[:-1])
        below, above = taken[place - 1], taken[place]
        if _fits(below, anchor) and _fits(anchor, above):
            taken.insert(place, anchor)
    return taken


def _fits(below: StripAnchor, above: StripAnchor) -> bool:
    """Tell whether one anchor lies above another: apart on both rails, or joined at one end.

    A waterline that begins at the keel of a section makes a cell of three sides.
    """
    low, high = above.low - below.low, above.high - below.high
    corner = (below.low == below.high == 0.0) or (above.low == above.high == 1.0)
    least, most = min(low, high), max(low, high)
    apart = most > _APART and (least > _APART or (corner and least >= -_APART))
    return apart and not _cross(below, above)


def _cross(below: StripAnchor, above: StripAnchor) -> bool:
    """Tell whether two anchors change places on their way: there the surface would fold.

    Looked at is at which side one lies of the other, at three places between the rails.
    """
    if below.course is None or above.course is None:
        return False
    apart = above.course - below.course
    return bool((apart[1:-1] @ (apart[0] + apart[-1]) <= 0.0).any())


def _turned(part: CurvePart) -> CurvePart:
    return part[0], part[2], part[1]


@attrs.frozen
class _Rail:
    """A rail, to find places on it."""

    parts: tuple[CurvePart, ...]
    base: tuple[float, ...]
    length: float
    corner: tuple[tuple[CurvePlace, CurvePlace], ...]
    """Places on the sides at which the rail begins and ends, and where on the rail that is."""
    same: float
    """Places on one curve so near to one another (m) are one."""

    @classmethod
    def of(
        cls,
        parts: tuple[CurvePart, ...],
        keel: Sequence[CurvePart],
        deck: Sequence[CurvePart],
        end: int,
        same: float,
    ) -> _Rail:
        """Make a rail; `end` says which end of the sides it joins: 1 their begin, 2 their end."""
        sizes = [abs(part[2] - part[1]) for part in parts]
        base = tuple(float(sum(sizes[:i])) for i in range(len(sizes)))
        begin, finish = (0, parts[0][1]), (len(parts) - 1, parts[-1][2])
        corner = [((part[0], part[end]), begin) for part in keel]
        corner += [((part[0], part[end]), finish) for part in deck]
        return cls(parts, base, float(sum(sizes)), tuple(corner), same)

    @property
    def curves(self) -> list[int]:
        every = [part[0] for part in self.parts] + [place[0] for place, _ in self.corner]
        return list(dict.fromkeys(every))

    @property
    def is_point(self) -> bool:
        return self.length == 0.0

    @property
    def begin(self) -> CurvePlace:
        return 0, self.parts[0][1]

    @property
    def finish(self) -> CurvePlace:
        return len(self.parts) - 1, self.parts[-1][2]

    def spot(self, place: CurvePlace) -> CurvePlace | None:
        """Find a place on a curve on the rail, None if it is not there."""
        curve, t = place
        for i, (c, t0, t1) in enumerate(self.parts):
            if c == curve and min(t0, t1) - self.same <= t <= max(t0, t1) + self.same:
                return i, min(max(t, min(t0, t1)), max(t0, t1))
        for (c, at), spot in self.corner:
            if c == curve and abs(at - t) <= max(self.same, _CORNER * self.length):
                return spot
        return None

    def height(self, spot: CurvePlace) -> float:
        """Say how far up the rail a place is, from 0 to 1."""
        if self.is_point:
            return 0.0
        if spot == self.finish:
            return 1.0
        return (self.base[spot[0]] + abs(spot[1] - self.parts[spot[0]][1])) / self.length


@attrs.define(eq=False)
class _Draft:
    """Cells in the making: lists that grow strip by strip."""

    net: CurveNet
    paths: list[list[Bit]] = attrs.field(factory=list)
    anchor_start: list[int] = attrs.field(factory=lambda: [0])
    anchor: list[int] = attrs.field(factory=list)
    blend: list[FloatArray] = attrs.field(factory=list)
    flat: list[bool] = attrs.field(factory=list)
    knuckle: list[bool] = attrs.field(factory=list)
    cell: list[tuple[int, int, int]] = attrs.field(factory=list)
    cell_start: list[int] = attrs.field(factory=lambda: [0])

    def add(self, parts: Sequence[CurvePart]) -> int:
        """Add a path; give its number."""
        self.paths.append([bit for part in parts for bit in segments_of_part(self.net, part)])
        return len(self.paths) - 1


def _side(anchor: StripAnchor, which: NDArray[np.bool_]) -> bool:
    """Tell whether an anchor runs along curves of a kind."""
    return any(which[part[0]] for part in anchor.parts)


def blend_cubics(
    height: FloatArray,
    flat: Sequence[bool] | NDArray[np.bool_] = (),
    knuckle: Sequence[bool] | NDArray[np.bool_] = (),
) -> tuple[IntArray, FloatArray]:
    """Give how the cells of a strip carry on between anchors at ascending heights (a,), as cubics.

    Each cubic has the values of the two anchors at its ends, and there the slopes of the parabolas
    through three neighbouring anchors. At the border of a flat, to which the hull is tangent, the
    slope is zero; at a knuckle each side has its own, that of the straight line. `first` (a - 1,)
    is the first of the four anchors that have weight in a cell, `cubic` (a - 1, 4, 4) the weights:
    ``sum_j cubic[:, i, j] value[first + j]`` is the coefficient of f^i.
    """
    count = len(height)
    slope = _slopes(height)
    slope[np.flatnonzero(flat)] = 0.0
    first = np.clip(np.arange(count - 1) - 1, 0, max(count - 4, 0))
    column = first[:, None] + np.arange(4)
    inside = column < count
    column = np.minimum(column, count - 1)
    cell = np.arange(count - 1)
    one = np.eye(count)
    below, above = (one[(cell + k)[:, None], column] * inside for k in (0, 1))
    width = np.diff(height)[:, None]
    leave, arrive = (slope[(cell + k)[:, None], column] * width * inside for k in (0, 1))
    step = above - below
    sharp = np.zeros(count, np.bool_)
    sharp[np.flatnonzero(knuckle)] = True
    leave = np.where(sharp[:-1, None], step, leave)
    arrive = np.where(sharp[1:, None], step, arrive)
    return first, np.stack(hermite(below, above, leave, arrive), axis=1)


def _slopes(height: FloatArray) -> FloatArray:
    """Give the weights (a, a) by which slopes at anchors follow from values there."""
    count = len(height)
    if count == 2:
        both: FloatArray = np.array([[-1.0, 1.0], [-1.0, 1.0]]) / (height[1] - height[0])
        return both
    found: FloatArray = np.zeros((count, count))
    at = np.arange(count)
    three = np.clip(at, 1, count - 2)[:, None] + np.array([-1, 0, 1])
    p = height[three]
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        weight = (2.0 * height - p[:, j] - p[:, k]) / ((p[:, i] - p[:, j]) * (p[:, i] - p[:, k]))
        found[at, three[:, i]] = weight
    return found


def _between(rail: tuple[CurvePart, ...], low: CurvePlace, high: CurvePlace) -> list[CurvePart]:
    """Give the parts of a rail between two points on it."""
    if low[0] == high[0]:
        return [(rail[low[0]][0], low[1], high[1])]
    first, last = rail[low[0]], rail[high[0]]
    parts = [
        (first[0], low[1], first[2]),
        *rail[low[0] + 1 : high[0]],
        (last[0], last[1], high[1]),
    ]
    return [part for part in parts if part[1] != part[2]] or parts[:1]


def _tiles(
    start: list[int], begin: list[float], aft: int, fore: int
) -> list[tuple[int, int, int, int]]:
    """Cut a cell at the knots of both rails: bits aft and fore, and what begins and ends it.

    `start` and `begin` say where the bits of each path begin, in all bits and along the path.
    """
    knots = [(0.0, -1)]
    for path in (aft, fore):
        knots += [(begin[bit], bit) for bit in range(start[path] + 1, start[path + 1])]
    knots.sort()
    kept = knots[:1]
    for knot in knots[1:]:
        if knot[0] - kept[-1][0] > _SLIVER and knot[0] < 1.0 - _SLIVER:
            kept.append(knot)
    tiles = []
    for i, (low, bit) in enumerate(kept):
        high, end = kept[i + 1] if i + 1 < len(kept) else (1.0, -1)
        middle = 0.5 * (low + high)
        one, other = (
            bisect_right(begin, middle, start[path], start[path + 1]) - 1 for path in (aft, fore)
        )
        tiles.append((one, other, bit, end))
    return tiles


def segments_of_part(net: CurveNet, part: CurvePart) -> list[Bit]:
    """Give the bits of segments that a part of a curve consists of; backward where it runs so."""
    curve, begin, finish = part
    knot = net.knots[curve]
    low, high = (
        _snapped(knot, t, net.factor * _SNAP) for t in (min(begin, finish), max(begin, finish))
    )
    first = min(bisect_right(knot, low), len(knot) - 1) - 1
    last = max(bisect_left(knot, high), first + 1) - 1
    base = int(net.batch.start[curve]) - curve
    bits = []
    for i in range(first, last + 1):
        length = knot[i + 1] - knot[i]
        a = max((low - knot[i]) / length, 0.0)
        b = 1.0 if i < last else min((high - knot[i]) / length, 1.0)
        bits.append((base + i, a, b))
    return bits if begin <= finish else [(s, b, a) for s, a, b in reversed(bits)]


def _snapped(knot: list[float], t: float, near: float) -> float:
    """Give the knot for a parameter that is within `near`, m, of one."""
    i = bisect_left(knot, t)
    for each in knot[max(i - 1, 0) : i + 1]:
        if abs(each - t) <= near:
            return each
    return t
