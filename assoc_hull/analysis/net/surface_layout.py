"""How the surface through a net is put together: strips and anchors become Coons cells.

A strip lies between two sections, rails aft and forward; anchors, lines along the ship, run across
it from a place on one rail to a place on the other. `lay_out_surface` decides the structure, which
is kept while lines only move; the cells themselves are values of `assoc_hull.geometry`.
`areas_between` gives areas of sections anywhere between two stations.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.analysis.net.curve_net import (
    CurveNet,
    CurvePart,
    bits_of_parts,
    station_planes,
)
from assoc_hull.analysis.net.strip_anchors import (
    LineSpans,
    StripAnchors,
    line_spans,
    runs_monotonic,
    strip_anchors,
)
from assoc_hull.analysis.net.strip_boundaries import (
    StripBoundary,
    UnboundedCurves,
    boundary_arcs,
    closes_end,
    strip_boundaries,
)
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, Strips, freeze
from assoc_hull.geometry.floating.immersion import FloatingPlanes
from assoc_hull.geometry.floating.sections import sections_below
from assoc_hull.geometry.integrals.area_moments import section_area
from assoc_hull.geometry.numeric.dual import common_zeros
from assoc_hull.geometry.numeric.polynomials import hermite
from assoc_hull.geometry.splines.paths import Paths, PathShapes, bit_lengths, shape_paths
from assoc_hull.geometry.splines.segments import (
    bezier_points,
    evaluate,
    last_not_above,
    sum_per_curve,
)
from assoc_hull.geometry.surfaces.coons import CoonsCells

__all__ = [
    "BROAD_END",
    "NEAR_END",
    "OpenEnd",
    "SurfaceLayout",
    "areas_between",
    "blend_cubics",
    "cut_cells",
    "lay_out_surface",
    "open_ends",
    "parallel_slabs",
    "strip_extents",
]

BROAD_END, NEAR_END = 0.4, 0.5
"""Where lines end at this part of the greatest half-breadth the hull ends, too; but not where a
station may be missing: farther than this part of a spacing from the end."""

_LEAST_END = 1e-4
"""Parts of the length: where the extent goes on by less, the section is the end."""

# --------------------------------------------------------------------------------------
# The parallel body. Lines through stations that are equal, and then are not, swing a little past
# them: by 1 or 2 cm on a ship of 120 m, over one station spacing. The area of the sections would
# swell there beyond that of the largest, which no parallel body does. Where two neighbouring
# sections of a hull with flats are both as large as the largest, the surface runs straight between
# them.

_EQUAL = 1e-4
"""Areas of sections of the parallel body differ by less, in parts of the largest."""


def parallel_slabs(net: CurveNet, x: FloatArray) -> frozenset[int]:
    """Give the slabs between sections of the parallel body; none for a hull without flats.

    Sections stand at x (n,), m, ascending; slab i lies between x[i - 1] and x[i].
    """
    curves = np.flatnonzero(np.isfinite(net.x) & ~net.end)
    if not net.flat.any() or len(x) < 2:
        return frozenset()
    batch = SplineBatch.join([net.batch.part(i, i + 1) for i in curves.tolist()])
    station = np.abs(net.x[curves][:, None] - x).argmin(axis=1)
    top = np.full(len(x), -np.inf)
    np.maximum.at(top, station, np.maximum.reduceat(batch.xyz[:, 2], batch.start[:-1]))
    # Below a common level: sheer must not make equal sections differ.
    level = np.minimum(top[:-1], top[1:])
    least, count = float(level.min()), len(x)
    whole = np.bincount(station, section_area(batch, least), count)
    more = np.bincount(station, _most_above(batch, least), count)
    # Which sections may be the largest at any level, or as large; a little more than the limit:
    # what rounding could turn is left to the comparison.
    large = whole + more >= (1.0 - 2.0 * _EQUAL) * float((whole - more).max())
    slab, rows = 1 + np.flatnonzero(large[:-1] & large[1:]), np.flatnonzero(large[station])
    if not len(slab):
        return frozenset()
    some = SplineBatch.join([batch.part(i, i + 1) for i in rows.tolist()])
    below = section_area(SplineBatch.join([some] * len(slab)), level[slab - 1].repeat(len(rows)))
    owner = (np.arange(len(slab)) * count).repeat(len(rows)) + np.tile(station[rows], len(slab))
    area = np.bincount(owner, below, len(slab) * count).reshape(-1, count)
    both = np.minimum(area[np.arange(len(slab)), slab - 1], area[np.arange(len(slab)), slab])
    return frozenset(slab[both >= (1.0 - _EQUAL) * area.max(axis=1)].tolist())


def _most_above(batch: SplineBatch, level: float) -> FloatArray:
    """Give an area that no part of a section (m,) above a level exceeds, m2.

    No curve is broader than its control points, nor goes up and down more than these do.
    """
    control = bezier_points(batch)
    rise = np.abs(np.diff(np.maximum(control[:, :, 2], level), axis=1)).sum(axis=1)
    broad = np.maximum.reduceat(
        np.abs(control[:, :, 1]).max(axis=1), batch.start[:-1] - np.arange(batch.count)
    )
    found: FloatArray = sum_per_curve(batch, rise) * broad
    return found


# --------------------------------------------------------------------------------------
# Cells from strips and anchors.

_ORDER, _END_ORDER = 4, 6
"""Gauss points along a strip between sections, and along one at an end of the ship, where
lines are steeper."""

_BULB = 0.25
"""A bulb is narrower than this part of the ship."""

DECK_PLACES = 5
"""Places on a part of the deck edge at which it is looked at."""

SLIVER = 1e-10
"""Tiles of a smaller part of a cell are not made."""


@attrs.frozen(eq=False)
class SurfaceLayout:
    """How the surface through a net is put together.

    Attributes
    ----------
    cells : CoonsCells
        The cells.
    frames : sequence of StripBoundary
        The strips, in the order of the cells.
    lost : tuple of UnboundedCurves
        What could not be understood.
    edge : (n,) bool
        The upper side of the strip lies off the centre plane: a deck edge.
    cell_start : (n + 1,) int
        Where the cells of each strip begin.
    rails : (c, 2) int
        The paths of each cell along its rails, with v = 0 and 1.
    cell : (t,) int
        The cell of each tile.
    flat, knuckle : (a,) bool
        Anchors that are borders of flats, and knuckles.
    """

    cells: CoonsCells
    frames: Sequence[StripBoundary]
    lost: tuple[UnboundedCurves, ...]
    edge: NDArray[np.bool_]
    cell_start: IntArray
    rails: IntArray
    cell: IntArray
    flat: NDArray[np.bool_]
    knuckle: NDArray[np.bool_]

    def __attrs_post_init__(self) -> None:
        freeze(self.edge, self.cell_start, self.rails, self.cell, self.flat, self.knuckle)

    def deck_edge(self, net: CurveNet) -> FloatArray:
        """Give places along the deck edge, (k, 3), m; the top of the hull if it has none.

        The profile and the transom bound strips above as well, and are no deck edge; nor is the
        top of a section that closes on the centre plane below the deck, as that of a bulb does.
        """
        parts = [
            part
            for frame, edge in zip(self.frames, self.edge.tolist(), strict=True)
            if edge
            for part in _top(net, frame)
        ]
        if not parts:
            return net.batch.xyz[[int(net.batch.xyz[:, 2].argmax())]]
        curve = np.array([part[0] for part in parts]).repeat(DECK_PLACES)
        t = np.concatenate([np.linspace(part[1], part[2], DECK_PLACES) for part in parts])
        found: FloatArray = evaluate(net.batch, curve, t)
        return found


def lay_out_surface(net: CurveNet, length: float, closed: bool) -> SurfaceLayout:
    """Find the strips and cells of a net of a ship of `length` m; `closed`: it has a deck."""
    x = station_planes(net)
    frames, lost = strip_boundaries(net, boundary_arcs(net, x), len(x), length)
    every = line_spans(net)
    parallel = parallel_slabs(net, x)
    straight = np.array([each.plane and each.slab in parallel for each in frames], np.bool_)
    frames, run = strip_anchors(frames, every, straight)
    # Straight: no anchors but keel and deck, and these without curves of their own.
    sides = [
        () if without else side
        for frame, without in zip(frames, straight.tolist(), strict=True)
        for side in (frame.keel, frame.deck)
    ]
    paths, anchor, rails = _paths(net, frames, run, every, sides)
    flat, knuckle = (_along(run, every, sides, which) for which in (net.flat, net.knuckle))
    edge = np.array([_is_edge(net, frame, frames) for frame in frames], np.bool_)
    cell_start = run.start - np.arange(len(run.start))
    # An open ship has a deck edge too, but no deck to be closed by.
    deck, plane = edge & closed, _planes(net, frames)
    ends = AnchorRuns(run.start, anchor, cell_start, rails, flat, knuckle, deck, plane)
    cells, cell = cut_cells(shape_paths(paths, net.batch), net.batch, ends)
    return SurfaceLayout(
        cells, tuple(frames), tuple(lost), edge, cell_start, rails, cell, flat, knuckle
    )


@attrs.frozen(eq=False)
class AnchorRuns:
    """Between which anchors and rails cells lie: see `CoonsCells` and `SurfaceLayout`.

    `deck` (n,) bool: a strip is covered.
    """

    anchor_start: IntArray
    anchor: IntArray
    cell_start: IntArray
    rails: IntArray
    flat: NDArray[np.bool_]
    knuckle: NDArray[np.bool_]
    deck: NDArray[np.bool_]
    plane: NDArray[np.bool_]


def cut_cells(
    walked: PathShapes, batch: SplineBatch, runs: AnchorRuns
) -> tuple[CoonsCells, IntArray]:
    """Cut cells into tiles, and tell how they carry on between anchors; also the cell of each tile.

    This alone of a layout depends on where lines are, and not only on which there are.
    """
    length = bit_lengths(walked.paths, batch)
    height = _anchor_heights(walked.paths, length, runs)
    first, blend = blend_cubics(height, runs.flat, runs.knuckle, runs.anchor_start)
    tiles = _tiles(walked, runs.rails, runs.cell_start, runs.deck)
    cells = CoonsCells(
        walked.paths,
        runs.anchor_start,
        runs.anchor,
        tiles.start,
        first[tiles.cell],
        blend[tiles.cell],
        tiles.aft,
        tiles.fore,
        tiles.low,
        tiles.high,
        runs.plane,
        tiles.low == -2,
        np.where(runs.plane, _ORDER, _END_ORDER).astype(np.int64),
    )
    return cells, tiles.cell


def _anchor_heights(paths: Paths, length: FloatArray, runs: AnchorRuns) -> FloatArray:
    """Give how far up its strip each anchor lies, (a,), from 0 to 1: the mean of both rails.

    `length` is that of bits, m. A rail that is a point says nothing.
    """
    owner = np.arange(paths.count).repeat(np.diff(paths.start))
    whole = np.bincount(owner, length, paths.count)
    count = np.diff(runs.cell_start)
    strip = np.arange(len(count)).repeat(count)
    above = np.arange(len(strip)) - runs.cell_start[strip] + 1
    table = np.zeros((2, len(count), int(count.max(initial=0)) + 1))
    table[:, strip, above] = whole[runs.rails.T]
    up = np.cumsum(table, axis=2)
    most = up[:, np.arange(len(count)), count][..., None]
    up = np.divide(up, most, out=np.zeros_like(up), where=most > 0.0)
    point = most == 0.0
    height = 0.5 * (np.where(point[0], up[1], up[0]) + np.where(point[1], up[0], up[1]))
    found: FloatArray = height[np.arange(table.shape[2]) <= count[:, None]]
    return found


def _paths(
    net: CurveNet,
    frames: Sequence[StripBoundary],
    run: StripAnchors,
    every: LineSpans,
    sides: Sequence[tuple[CurvePart, ...]],
) -> tuple[Paths, IntArray, IntArray]:
    """Give the paths of all anchors and, between these, of rails; which are whose.

    Strip by strip the anchors come first, then the rails of each cell. An anchor of which nothing
    is drawn has no path, -1: it is straight from rail to rail.
    """
    count, line = np.diff(run.start), run.span >= 0
    strip = np.arange(len(count)).repeat(count)
    drawn = line.copy()
    side = np.flatnonzero(~line)
    drawn[side] = [len(each) > 0 for each in sides]
    own = np.bincount(strip, drawn, len(count)).astype(np.int64)
    base = np.cumsum([0, *(own + 2 * (count - 1)).tolist()])
    before: IntArray = np.cumsum(drawn) - drawn
    anchor = np.where(drawn, base[strip] + before - before[run.start[:-1]][strip], -1)
    lower = np.delete(np.arange(len(line)), run.start[1:] - 1)
    cell_strip = strip[lower]
    first = base[cell_strip] + own[cell_strip] + 2 * (lower - run.start[cell_strip])
    rails = np.stack([first, first + 1], axis=1)
    # The parts of curves of each path: of lines, of sides, of rails.
    span = run.span[line]
    ends = np.where(run.turned[line][:, None], every.part[span][:, ::-1], every.part[span])
    lines = _Parts(anchor[line], every.curve[span], ends)
    drawn_sides = [
        (path, part)
        for path, each in zip(anchor[side].tolist(), sides, strict=True)
        for part in each
    ]
    parts = _joined_parts([lines, _Parts.of(drawn_sides), *_rail_parts(frames, run, lower, rails)])
    size, segment, low, high = bits_of_parts(net, parts.curve, parts.ends[:, 0], parts.ends[:, 1])
    start = np.zeros(int(base[-1]) + 1, np.int64)
    np.cumsum(np.bincount(parts.path, size, int(base[-1])).astype(np.int64), out=start[1:])
    return Paths(start, segment, low, high), anchor, rails


@attrs.frozen(eq=False)
class _Parts:
    """Parts of curves of which paths consist: path (k,), curve (k,), parameters (k, 2), m."""

    path: IntArray
    curve: IntArray
    ends: FloatArray

    @classmethod
    def of(cls, found: Sequence[tuple[int, CurvePart]]) -> _Parts:
        """Put some into arrays."""
        return cls(
            np.array([path for path, _ in found], np.int64),
            np.array([part[0] for _, part in found], np.int64),
            np.array([part[1:] for _, part in found], np.float64).reshape(-1, 2),
        )


def _joined_parts(several: Sequence[_Parts]) -> _Parts:
    """Put the parts of each path one behind the other, in their order."""
    path, curve, ends = (
        np.concatenate(each)
        for each in zip(*(attrs.astuple(one, recurse=False) for one in several), strict=True)
    )
    order = np.argsort(path, kind="stable")
    return _Parts(path[order], curve[order], ends[order])


def _rail_parts(
    frames: Sequence[StripBoundary], run: StripAnchors, lower: IntArray, rails: IntArray
) -> Iterator[_Parts]:
    """Give the parts of rails between anchors and those above them, aft and forward."""
    strip = np.searchsorted(run.start, lower, "right") - 1
    for side in (0, 1):
        one, other = run.part[lower, side], run.part[lower + 1, side]
        same = one == other
        ends = np.stack([run.t[lower, side], run.t[lower + 1, side]], axis=1)
        curve = run.rails.curve[run.rails.start[2 * strip + side] + one]
        yield _Parts(rails[same, side], curve[same], ends[same])
        # Seldom: where a section has come apart, and stem or stern are between its pieces.
        found = []
        for k in np.flatnonzero(~same).tolist():
            frame = frames[int(strip[k])]
            low, high = (int(one[k]), float(ends[k, 0])), (int(other[k]), float(ends[k, 1]))
            parts = _between((frame.aft, frame.fore)[side], low, high)
            found += [(int(rails[k, side]), part) for part in parts]
        yield _Parts.of(found)


def _along(
    run: StripAnchors,
    every: LineSpans,
    sides: Sequence[tuple[CurvePart, ...]],
    which: NDArray[np.bool_],
) -> NDArray[np.bool_]:
    """Tell which anchors run along curves of a kind."""
    found = np.zeros(len(run.span), np.bool_)
    line = run.span >= 0
    found[line] = which[every.curve[run.span[line]]]
    found[~line] = [any(which[part[0]] for part in parts) for parts in sides]
    return found


def _planes(net: CurveNet, frames: Sequence[StripBoundary]) -> NDArray[np.bool_]:
    """Tell which strips lie between planes across the ship, with sides that never turn back."""
    plane = np.array([frame.plane for frame in frames], np.bool_)
    sides = [frame.keel + frame.deck for frame in frames]
    owner = np.arange(len(frames)).repeat([len(each) for each in sides])
    steady = runs_monotonic(net, [part for each in sides for part in each])
    plane[owner[~steady]] = False
    return plane


def _top(net: CurveNet, frame: StripBoundary) -> list[CurvePart]:
    """Give the deck edge at the upper side of a strip: what is drawn, or the ends of its rails.

    Of rails, one that ends in the centre plane counts as a stem head if it reaches as high as the
    other; lower, it is the top of a bulb, or the foot of a transom that is not drawn.
    """
    if frame.deck:
        return [part for part in frame.deck if not closes_end(net, part[0])]
    ends = [(rail[-1][0], rail[-1][2], rail[-1][2]) for rail in (frame.aft, frame.fore)]
    place = _tops(net, frame)
    aside = np.abs(place[:, 1]) > net.on_centre
    level = float(place[aside, 2].min())
    high = (aside | (place[:, 2] >= level)).tolist()
    return [end for end, keep in zip(ends, high, strict=True) if keep]


def blend_cubics(
    height: FloatArray,
    flat: NDArray[np.bool_] | None = None,
    knuckle: NDArray[np.bool_] | None = None,
    start: IntArray | None = None,
) -> tuple[IntArray, FloatArray]:
    """Give how the cells of strips carry on between anchors at ascending heights (a,), as cubics.

    The anchors of each strip begin at `start`; without it they are those of one strip. Each cubic
    has the values of the two anchors at its ends, and there the slopes of the parabolas
    through three neighbouring anchors. At the border of a flat, to which the hull is tangent, the
    slope is zero; at a knuckle each side has its own, that of the straight line. `first` (c,)
    is the first of the four anchors of its strip that have weight in a cell, `cubic` (c, 4, 4) the
    weights: ``sum_j cubic[:, i, j] value[first + j]`` is the coefficient of f^i.
    """
    start = np.array([0, len(height)]) if start is None else start
    count = np.diff(start)
    own = np.arange(len(count)).repeat(count)
    at, slope = _slopes(height, start[own], count[own])
    if flat is not None:
        slope[np.flatnonzero(flat)] = 0.0
    # The lower anchors of all cells, in all anchors and along their strips.
    lower = np.delete(np.arange(len(height)), start[1:] - 1)
    strip = own[lower]
    cell = lower - start[strip]
    first = np.clip(cell - 1, 0, np.maximum(count[strip] - 4, 0))
    column = (start[strip] + first)[:, None] + np.arange(4)
    inside = column < start[strip + 1][:, None]
    below, above = (1.0 * (column == (lower + k)[:, None]) * inside for k in (0, 1))
    width = (height[lower + 1] - height[lower])[:, None]
    leave, arrive = (
        _spread(at[lower + k], slope[lower + k], column) * width * inside for k in (0, 1)
    )
    step = above - below
    if knuckle is not None:
        leave = np.where(knuckle[lower][:, None], step, leave)
        arrive = np.where(knuckle[lower + 1][:, None], step, arrive)
    return first, np.stack(hermite(below, above, leave, arrive), axis=1)


def _slopes(height: FloatArray, begin: IntArray, count: IntArray) -> tuple[IntArray, FloatArray]:
    """Give of which three anchors slopes at anchors are made, (a, 3), and the weights of these.

    The anchors of the same strip begin at `begin` (a,); there are `count` (a,) of them. Where
    there are two, the third is -1.
    """
    at = np.arange(len(height)) - begin
    three = np.clip(at, 1, np.maximum(count - 2, 1))[:, None] + np.array([-1, 0, 1])
    two = count == 2
    three += begin[:, None]
    three[two] = np.stack([begin[two], begin[two] + 1, np.full(int(two.sum()), -1)], axis=1)
    p = height[three]
    weight: FloatArray = common_zeros((len(height), 3), height)
    with np.errstate(divide="ignore", invalid="ignore"):
        for i in range(3):
            j, k = (i + 1) % 3, (i + 2) % 3
            weight[:, i] = (2.0 * height - p[:, j] - p[:, k]) / (
                (p[:, i] - p[:, j]) * (p[:, i] - p[:, k])
            )
    both = np.flatnonzero(two)
    weight[both] = np.array([-1.0, 1.0, 0.0]) / (p[both, 1] - p[both, 0])[:, None]
    return three, weight


def _spread(at: IntArray, weight: FloatArray, column: IntArray) -> FloatArray:
    """Give the weights (c, 3) of anchors `at` (c, 3) as weights of those in `column` (c, 4)."""
    found: FloatArray = common_zeros(column.shape, weight)
    for i in range(3):
        row, place = np.nonzero(column == at[:, i, None])
        found[row, place] = weight[row, i]
    return found


def _between(
    rail: tuple[CurvePart, ...], low: tuple[int, float], high: tuple[int, float]
) -> list[CurvePart]:
    """Give the parts of a rail between places (part, m) on two different parts of it."""
    first, last = rail[low[0]], rail[high[0]]
    parts = [
        (first[0], low[1], first[2]),
        *rail[low[0] + 1 : high[0]],
        (last[0], last[1], high[1]),
    ]
    return [part for part in parts if part[1] != part[2]] or parts[:1]


@attrs.frozen(eq=False)
class _Tiles:
    """Tiles as in `CoonsCells`, and the cell (t,) of each."""

    start: IntArray
    cell: IntArray
    aft: IntArray
    fore: IntArray
    low: IntArray
    high: IntArray


def _tiles(
    walked: PathShapes, rails: IntArray, cell_start: IntArray, deck: NDArray[np.bool_]
) -> _Tiles:
    """Cut cells at the knots of both their rails (c, 2); `deck` (s,): a strip has a deck."""
    cell, bit, low, high, end = _knots(walked, rails)
    middle = 0.5 * (low + high)
    start = walked.paths.start
    one, other = (
        last_not_above(walked.begin, start[path], start[path + 1] - 1, middle)
        for path in rails[cell].T
    )
    tile_start = np.searchsorted(cell, cell_start)
    # The deck is one more tile above the last: -2 says so.
    over = tile_start[1:][deck]
    made = [np.insert(each, over, each[over - 1]) for each in (cell, one, other)]
    made += [np.insert(bit, over, -2), np.insert(end, over, -1)]
    return _Tiles(tile_start + np.cumsum([0, *deck.tolist()]), *made)


def _knots(
    walked: PathShapes, rails: IntArray
) -> tuple[IntArray, IntArray, FloatArray, FloatArray, IntArray]:
    """Give the tiles of cells: the cell, the bit that begins there, from where to where, its end.

    Bits are -1 at the beginning and at the end of a cell.
    """
    count, start = len(rails), walked.paths.start
    path = rails.T.ravel()
    size = start[path + 1] - start[path] - 1
    which = np.arange(2 * count).repeat(size)
    bit = start[path[which]] + 1 + np.arange(len(which)) - (np.cumsum(size) - size)[which]
    cell = np.concatenate([np.arange(count), which % max(count, 1)])
    bit = np.concatenate([np.full(count, -1), bit])
    value = np.where(bit < 0, 0.0, walked.begin[bit])
    order = np.lexsort((bit, value, cell))
    cell, bit, value = cell[order], bit[order], value[order]
    near = np.zeros(len(cell), np.bool_)
    near[1:] = (cell[1:] == cell[:-1]) & (value[1:] - value[:-1] <= SLIVER)
    kept = ~near
    for k in np.flatnonzero(near[1:] & near[:-1]).tolist():
        # Three and more in a row: each is held against the last that was kept.
        kept[k + 1] = value[k + 1] - value[k - int(kept[k::-1].argmax())] > SLIVER
    kept &= (value < 1.0 - SLIVER) | (bit < 0)
    cell, bit, value = cell[kept], bit[kept], value[kept]
    high, end = np.ones(len(cell)), np.full(len(cell), -1)
    inner = np.flatnonzero(cell[1:] == cell[:-1])
    high[inner], end[inner] = value[inner + 1], bit[inner + 1]
    return cell, bit, value, high, end


def _is_edge(net: CurveNet, frame: StripBoundary, every: Sequence[StripBoundary]) -> bool:
    """Tell whether the upper side of a strip is a deck edge, not the centre plane.

    Where no side is drawn only the uppermost strip of a slab has one: below it lie a bulb or a
    bossing that nothing closes.
    """
    if frame.deck:
        return not all(closes_end(net, part[0]) for part in frame.deck)
    place = _tops(net, frame)
    if float(np.abs(place[:, 1]).max()) <= net.on_centre or _is_bulb(net, frame, place, every):
        return False
    others = [_tops(net, each) for each in every if each.slab == frame.slab]
    return float(place[:, 2].max()) >= max(float(each[:, 2].max()) for each in others)


def _is_bulb(
    net: CurveNet, frame: StripBoundary, place: FloatArray, every: Sequence[StripBoundary]
) -> bool:
    """Tell whether a strip that nothing is drawn over is a bulb or a bossing beyond the deck's end.

    It is narrow, lies ahead or abaft of all that has a deck edge drawn, and is lower than that. A
    table has no line that closes it.
    """
    decks = [each for each in every if each.deck and not closes_end(net, each.deck[0][0])]
    if not decks:
        return False
    beyond = not min(each.slab for each in decks) <= frame.slab <= max(each.slab for each in decks)
    low = min(float(_tops(net, each)[:, 2].min()) for each in decks)
    half = float(np.abs(net.batch.xyz[:, 1]).max())
    narrow = float(np.abs(place[:, 1]).max()) <= _BULB * half
    return beyond and narrow and float(place[:, 2].max()) < low


def _tops(net: CurveNet, frame: StripBoundary) -> FloatArray:
    """Give the upper ends of the rails of a strip, (2, 3), m."""
    parts = [rail[-1] for rail in (frame.aft, frame.fore)]
    curve = np.array([part[0] for part in parts])
    found: FloatArray = evaluate(net.batch, curve, np.array([part[2] for part in parts]))
    return found


# --------------------------------------------------------------------------------------
# Sections between two stations, as the surface through a net has them.


def areas_between(
    layout: SurfaceLayout,
    strips: Strips,
    station: FloatArray,
    x: FloatArray,
    planes: FloatingPlanes,
) -> FloatArray:
    """Give the areas (d, n), m2, both sides, of sections at x (n,), m, between stations.

    Stations are at `station` (k,), m, ascending. nan beyond the last ones, and where a strip
    begins or ends at a raked line between two of them, so that no curve of it is transverse.
    """
    slab, own = np.searchsorted(station, x), np.array([f.slab for f in layout.frames], np.int64)
    known = np.zeros(len(station) + 1, np.bool_)
    known[own] = True
    known[own[~layout.cells.plane]] = known[0] = known[-1] = False
    total = np.full((len(planes.height), len(x)), np.nan)
    total[:, known[slab]] = 0.0
    inner = np.flatnonzero(known[slab])
    place, strip = np.nonzero(slab[inner][:, None] == own)
    place = inner[place]
    some, which = np.unique(strip, return_inverse=True)
    if not len(some):
        return total
    aft, fore = strip_extents(strips, some)[which].T
    v = (x[place] - aft) / (fore - aft)
    on = (v >= 0.0) & (v <= 1.0)
    if on.any():
        curves = strips.curves(strip[on], v[on])
        np.add.at(total.T, place[on], sections_below(curves, planes).T)
    return total


def strip_extents(strips: Strips, strip: IntArray) -> FloatArray:
    """Give x (k, 2), m, of both ends of transverse strips: some end between two stations."""
    curves = strips.curves(np.repeat(strip, 2), np.tile([0.0, 1.0], len(strip)))
    found: FloatArray = curves.point[curves.start[:-1], 0, 0].reshape(-1, 2)
    return found


# --------------------------------------------------------------------------------------
# Ends that no line closes: a hull given by sections alone has neither profile nor transom.


@attrs.frozen
class OpenEnd:
    """An end that no line closes.

    Attributes
    ----------
    fore : bool
        It is the forward one.
    name : str
        The section beyond which nothing is drawn.
    x, end : float, m
        Where it stands, and where the hull is taken to end.
    source : str
        Whence that is known.
    """

    fore: bool
    name: str
    x: float
    end: float
    source: str

    def __str__(self) -> str:
        return (
            f"no line closes the hull beyond {self.name} (x {self.x:.2f} m): closed by straight "
            f"lines to x {self.end:.2f} m, {self.source}; what that adds is in the errors, too"
        )


def open_ends(net: CurveNet, layout: SurfaceLayout, length: float) -> tuple[OpenEnd, ...]:
    """Find the ends that no line closes; `length` between perpendiculars, m."""
    # Slabs are counted between these: parts of sections that end on a raked transom are none.
    stations = station_planes(net)
    slabs = {frame.slab for frame in layout.frames}
    every = net.batch.xyz[_tells_extent(net), 0]
    ends = []
    for fore in (False, True):
        x = float(stations[-1 if fore else 0])
        drawn = float(every.max() if fore else every.min())
        sign = 1.0 if fore else -1.0
        by_lines = sign * drawn > sign * (length if fore else 0.0)
        end = drawn if by_lines else (length if fore else 0.0)
        covered = net.end & np.isfinite(net.x) & (sign * net.x >= sign * x - net.on_plane)
        closed = (len(stations) if fore else 0) in slabs or covered.any()
        if closed or sign * (end - x) <= _LEAST_END * length:
            continue
        spacing = abs(float(np.diff(stations[-2:] if fore else stations[:2])[0]))
        if sign * (end - x) < NEAR_END * spacing and _is_transom(net, x):
            continue
        source = "where its lines end" if by_lines else "the perpendicular"
        ends.append(OpenEnd(fore, _section_near(net, x), x, end, source))
    return tuple(ends)


def _section_near(net: CurveNet, x: float) -> str:
    """Give the name of the section that stands nearest to a place."""
    sections = np.flatnonzero(np.isfinite(net.x) & ~net.end)
    places = net.x[sections]
    return net.name[int(sections[np.lexsort((places, np.abs(places - x)))[0]])]


def _is_transom(net: CurveNet, x: float) -> bool:
    """Tell whether lines along the ship end broad at its last section: it is a transom.

    Sections alone do not tell: there the hull goes on to the perpendicular.
    """
    last = net.batch.start[1:] - 1
    ends = net.batch.xyz[np.concatenate([net.batch.start[:-1], last])]
    along = np.tile(np.isin(net.family, ("waterlines", "buttocks")), 2)
    here = along & (np.abs(ends[:, 0] - x) <= net.on_plane)
    widest = float(np.abs(net.batch.xyz[:, 1]).max())
    return bool(here.any() and float(np.abs(ends[here, 1]).max()) >= BROAD_END * widest)


def _tells_extent(net: CurveNet) -> NDArray[np.bool_]:
    """Tell which points of the lines say how far the hull reaches.

    A knuckle traced through sections is carried a little beyond the last of them, to cross it:
    only where it ends in the centre plane does the hull end there.
    """
    traced = np.repeat(net.knuckle, np.diff(net.batch.start))
    told: NDArray[np.bool_] = ~traced | (np.abs(net.batch.xyz[:, 1]) <= net.on_centre)
    return told
