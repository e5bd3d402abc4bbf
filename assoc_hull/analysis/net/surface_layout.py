"""How the surface through a net is put together: strips and anchors become Coons cells.

`lay_out_surface` decides the structure, which is kept while lines only move; the cells themselves
are `assoc_hull.geometry` values. Slabs of the parallel body run straight. Between two stations the
surface gives the areas of sections anywhere (`areas_between`).
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.analysis.net.curve_net import (
    ON_CENTRE,
    CurveNet,
    CurvePart,
    segments_of_part,
    station_planes,
)
from assoc_hull.analysis.net.strip_anchors import (
    CurvePlace,
    StripAnchor,
    line_spans,
    runs_monotonic,
    strip_anchors,
)
from assoc_hull.analysis.net.strip_boundaries import (
    StripBoundary,
    UnboundedCurves,
    boundary_arcs,
    strip_boundaries,
)
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.geometry.floating.immersion import FloatingPlanes
from assoc_hull.geometry.floating.sections import sections_below
from assoc_hull.geometry.integrals.area_moments import section_area
from assoc_hull.geometry.numeric.generic_sums import common_zeros
from assoc_hull.geometry.numeric.polynomials import hermite
from assoc_hull.geometry.splines.evaluation import evaluate
from assoc_hull.geometry.splines.paths import Bit, Paths, PathShapes, shape_paths
from assoc_hull.geometry.surfaces.coons import CoonsCells
from assoc_hull.geometry.surfaces.isocurves import Strips

__all__ = [
    "SurfaceLayout",
    "areas_between",
    "blend_cubics",
    "lay_out_surface",
    "parallel_slabs",
    "strip_extents",
]

# --------------------------------------------------------------------------------------
# The parallel body: between which neighbouring sections the hull only runs on.
#
# Lines through stations that are equal, and then are not, swing a little past them: by 1 or 2 cm
# on a ship of 120 m, over the length of a station's distance. The area of the sections would swell
# there beyond that of the largest, which no parallel body does. Where two neighbouring sections
# of a hull with flats are both as large as the largest, the surface runs straight between them.

_EQUAL = 1e-4
"""Areas of sections of the parallel body differ by less, in parts of the largest."""


def parallel_slabs(net: CurveNet, x: FloatArray) -> frozenset[int]:
    """Give the slabs between sections of the parallel body; none for a hull without flats.

    Parameters
    ----------
    net : Net
        The curves.
    x : (n,), m
        Where sections stand, ascending.
    """
    curves = np.flatnonzero(np.isfinite(net.x) & ~net.end)
    if not net.flat.any() or len(x) < 2:
        return frozenset()
    batch = SplineBatch.join([net.batch.part(i, i + 1) for i in curves.tolist()])
    station = np.abs(net.x[curves][:, None] - x).argmin(axis=1)
    top = np.full(len(x), -np.inf)
    np.maximum.at(top, station, np.maximum.reduceat(batch.xyz[:, 2], batch.start[:-1]))
    found = []
    for slab in range(1, len(x)):
        level = min(top[slab - 1], top[slab])
        area = np.bincount(station, section_area(batch, level), len(x))
        if area[slab - 1 : slab + 1].min() >= (1.0 - _EQUAL) * area.max():
            found.append(slab)
    return frozenset(found)


# --------------------------------------------------------------------------------------
# Put frames and anchors together to the cells of a Coons surface.

_ORDER, _END_ORDER = 4, 6
"""Gauss points along a strip between sections, and along one at an end of the ship, where
lines are steeper."""

_PLACES = 5
"""Places on a part of the deck edge at which it is looked at."""

_SLIVER = 1e-10
"""Tiles of a smaller part of a cell are not made."""


@attrs.frozen(eq=False)
class SurfaceLayout:
    """How the surface through a net is put together.

    Attributes
    ----------
    cells : Cells
        The cells.
    frames : tuple of Frame
        The strips, in the order of the cells.
    lost : tuple of Unbounded
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
    frames: tuple[StripBoundary, ...]
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
        """Give places along the deck edge, (k, 3), m; the top of the hull if it has none."""
        parts = [
            part
            for frame, edge in zip(self.frames, self.edge.tolist(), strict=True)
            if edge
            for part in _top(frame)
        ]
        if not parts:
            return net.batch.xyz[[int(net.batch.xyz[:, 2].argmax())]]
        curve = np.array([part[0] for part in parts]).repeat(_PLACES)
        t = np.concatenate([np.linspace(part[1], part[2], _PLACES) for part in parts])
        found: FloatArray = evaluate(net.batch, curve, t)
        return found


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


def lay_out_surface(net: CurveNet, length: float, closed: bool) -> SurfaceLayout:
    """Find the strips and cells of a net.

    Parameters
    ----------
    net : Net
        The curves.
    length : float, m
        Of the ship.
    closed : bool
        A deck joins the deck edges.
    """
    x = station_planes(net)
    found, lost = strip_boundaries(net, boundary_arcs(net, x), len(x), length)
    every = line_spans(net)
    parallel = parallel_slabs(net, x)
    draft = _Draft(net)
    for i, given in enumerate(found):
        found[i], run = strip_anchors(given, every)
        if given.plane and given.slab in parallel:
            run = [attrs.evolve(each, parts=()) for each in (run[0], run[-1])]
        for anchor in run:
            draft.anchor.append(draft.add(anchor.parts) if anchor.parts else -1)
        flat = [_side(net, each, net.flat) for each in run]
        knuckle = [_side(net, each, net.knuckle) for each in run]
        draft.flat += flat
        draft.knuckle += knuckle
        height = np.array([0.5 * (each.low + each.high) for each in run])
        first, blend = blend_cubics(height, flat, knuckle)
        for j, (below, above) in enumerate(itertools.pairwise(run)):
            aft = draft.add(_between(found[i].aft, below.aft, above.aft))
            fore = draft.add(_between(found[i].fore, below.fore, above.fore))
            draft.cell.append((int(first[j]), aft, fore))
            draft.blend.append(blend[j])
        draft.anchor_start.append(len(draft.anchor))
        draft.cell_start.append(len(draft.cell))
    paths = Paths.of(draft.paths)
    edge = np.array([_is_edge(net, frame, found) for frame in found], np.bool_)
    cells, cell = _cells(net, draft, found, shape_paths(paths, net.batch), edge & closed)
    rails = np.array([each[1:] for each in draft.cell], np.int64).reshape(-1, 2)
    start = np.array(draft.cell_start, np.int64)
    sides = np.array(draft.flat, np.bool_), np.array(draft.knuckle, np.bool_)
    return SurfaceLayout(cells, tuple(found), tuple(lost), edge, start, rails, cell, *sides)


def _top(frame: StripBoundary) -> list[CurvePart]:
    """Give the upper side of a strip; the ends of the rails if nothing is drawn there."""
    if frame.deck:
        return list(frame.deck)
    return [(rail[-1][0], rail[-1][2], rail[-1][2]) for rail in (frame.aft, frame.fore)]


def _side(net: CurveNet, anchor: StripAnchor, which: NDArray[np.bool_]) -> bool:
    """Tell whether an anchor runs along curves of a kind."""
    return any(which[part[0]] for part in anchor.parts)


def blend_cubics(
    height: FloatArray,
    flat: Sequence[bool] | NDArray[np.bool_] = (),
    knuckle: Sequence[bool] | NDArray[np.bool_] = (),
) -> tuple[IntArray, FloatArray]:
    """Give how the cells of a strip carry on between the anchors, as cubics.

    Each cubic has the values of the two anchors at its ends, and there the slopes of the
    parabolas through three neighbouring anchors. At the border of a flat, to which the hull is
    tangent, the slope is nil; at a knuckle each side has its own, that of the straight line.

    Parameters
    ----------
    height : (a,)
        Where the anchors lie, ascending, a >= 2.
    flat, knuckle : sequence of bool
        Which anchors are borders of flats, and knuckles; none if not given.

    Returns
    -------
    first : (a - 1,) int
        The first of the four anchors that have a say in each cell.
    cubic : (a - 1, 4, 4)
        By which weights: ``sum_j cubic[:, i, j] value[first + j]`` is the coefficient of f^i.
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
    """Give by which weights slopes at places follow from values there, (a, a)."""
    count = len(height)
    if count == 2:
        both: FloatArray = np.array([[-1.0, 1.0], [-1.0, 1.0]]) / (height[1] - height[0])
        return both
    found: FloatArray = common_zeros((count, count), height)
    at = np.arange(count)
    three = np.clip(at, 1, count - 2)[:, None] + np.array([-1, 0, 1])
    p = height[three]
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        weight = (2.0 * height - p[:, j] - p[:, k]) / ((p[:, i] - p[:, j]) * (p[:, i] - p[:, k]))
        found[at, three[:, i]] = weight
    return found


def _between(rail: tuple[CurvePart, ...], low: CurvePlace, high: CurvePlace) -> list[CurvePart]:
    """Give the parts of a rail between two places on it."""
    if low[0] == high[0]:
        return [(rail[low[0]][0], low[1], high[1])]
    first, last = rail[low[0]], rail[high[0]]
    parts = [
        (first[0], low[1], first[2]),
        *rail[low[0] + 1 : high[0]],
        (last[0], last[1], high[1]),
    ]
    return [part for part in parts if part[1] != part[2]] or parts[:1]


def _cells(
    net: CurveNet,
    draft: _Draft,
    found: list[StripBoundary],
    walked: PathShapes,
    deck: NDArray[np.bool_],
) -> tuple[CoonsCells, IntArray]:
    """Cut the cells into tiles; also give the cell of each tile."""
    tiles: list[tuple[int, int, int, int, int]] = []
    tile_start, cell = [0], list[int]()
    for i in range(len(found)):
        for j in range(draft.cell_start[i], draft.cell_start[i + 1]):
            first, aft, fore = draft.cell[j]
            tiles += [(first, *tile) for tile in _tiles(walked, aft, fore)]
            cell += [j] * (len(tiles) - len(cell))
        if deck[i]:
            tiles.append((*tiles[-1][:3], -2, -1))
            cell.append(cell[-1])
        tile_start.append(len(tiles))
    table = np.array(tiles, np.int64).reshape(-1, 5)
    anchor_start = np.array(draft.anchor_start, np.int64)
    anchor = np.array(draft.anchor, np.int64)
    plane = np.array(
        [frame.plane and all(runs_monotonic(net, frame.keel + frame.deck)) for frame in found],
        np.bool_,
    )
    column = [table[:, i].copy() for i in range(5)]
    cells = CoonsCells(
        walked.paths,
        anchor_start,
        anchor,
        np.array(tile_start, np.int64),
        column[0],
        np.array(draft.blend, np.float64).reshape(-1, 4, 4)[cell],
        column[1],
        column[2],
        column[3],
        column[4],
        plane,
        column[3] == -2,
        np.where(plane, _ORDER, _END_ORDER).astype(np.int64),
    )
    return cells, np.array(cell, np.int64)


def _tiles(walked: PathShapes, aft: int, fore: int) -> list[tuple[int, int, int, int]]:
    """Cut a cell at the knots of both rails: bits aft and fore, and what begins and ends it."""
    start = walked.paths.start
    knots = [(0.0, -1)]
    for path in (aft, fore):
        bits = range(int(start[path]) + 1, int(start[path + 1]))
        knots += [(float(walked.begin[bit]), bit) for bit in bits]
    knots.sort()
    kept = knots[:1]
    for knot in knots[1:]:
        if knot[0] - kept[-1][0] > _SLIVER and knot[0] < 1.0 - _SLIVER:
            kept.append(knot)
    tiles = []
    for i, (low, bit) in enumerate(kept):
        high, end = kept[i + 1] if i + 1 < len(kept) else (1.0, -1)
        middle = 0.5 * (low + high)
        pair = [_bit_at(walked, path, middle) for path in (aft, fore)]
        tiles.append((pair[0], pair[1], bit, end))
    return tiles


def _bit_at(walked: PathShapes, path: int, w: float) -> int:
    first, last = int(walked.paths.start[path]), int(walked.paths.start[path + 1])
    return first + int(np.searchsorted(walked.begin[first:last], w, side="right")) - 1


def _is_edge(net: CurveNet, frame: StripBoundary, every: Sequence[StripBoundary]) -> bool:
    """Tell whether the upper side of a strip is a deck edge, not the centre plane.

    Where no side is drawn only the uppermost strip of a slab has one: below it lie a bulb or a
    bossing that nothing closes.
    """
    if frame.deck:
        return not all(net.centre[part[0]] for part in frame.deck)
    place = _tops(net, frame)
    if float(np.abs(place[:, 1]).max()) <= ON_CENTRE:
        return False
    others = [_tops(net, each) for each in every if each.slab == frame.slab]
    return float(place[:, 2].max()) >= max(float(each[:, 2].max()) for each in others)


def _tops(net: CurveNet, frame: StripBoundary) -> FloatArray:
    """Give the upper ends of the rails of a strip, (2, 3), m."""
    parts = [rail[-1] for rail in (frame.aft, frame.fore)]
    curve = np.array([part[0] for part in parts])
    found: FloatArray = evaluate(net.batch, curve, np.array([part[2] for part in parts]))
    return found


# --------------------------------------------------------------------------------------
# Sections anywhere between two stations, as the surface through a net has them.


def areas_between(
    layout: SurfaceLayout,
    strips: Strips,
    station: FloatArray,
    x: FloatArray,
    planes: FloatingPlanes,
) -> FloatArray | None:
    """Give the areas of sections between two neighbouring stations.

    Parameters
    ----------
    layout : Layout
        How the surface is put together.
    strips : Strips
        The surface.
    station : (k,), m
        Where the stations are, ascending.
    x : (n,), m
        Where the sections are, all between the same two stations.
    planes : Planes
        d planes.

    Returns
    -------
    (d, n), m2, or None
        Of both sides; None beyond the last stations, and where a strip begins or ends at a
        raked line between the two, so that no curve of it lies in a plane across the ship.
    """
    slab = int(np.searchsorted(station, x[0]))
    strip = np.array([i for i, each in enumerate(layout.frames) if each.slab == slab], np.int64)
    if not (0 < slab < len(station) and len(strip) and layout.cells.plane[strip].all()):
        return None
    reach = strip_extents(strips, strip)
    v = (x[:, None] - reach[:, 0]) / (reach[:, 1] - reach[:, 0])
    place, which = np.nonzero((v >= 0.0) & (v <= 1.0))
    total = np.zeros((len(planes.height), len(x)))
    if len(place):
        curves = strips.curves(strip[which], v[place, which])
        np.add.at(total.T, place, sections_below(curves, planes).T)
    return total


def strip_extents(strips: Strips, strip: IntArray) -> FloatArray:
    """Give from where to where strips between stations run: some begin or end between two.

    Parameters
    ----------
    strips : Strips
        The surface.
    strip : (k,) int
        Strips whose curves lie in planes across the ship.

    Returns
    -------
    (k, 2), m
        x of both ends.
    """
    curves = strips.curves(np.repeat(strip, 2), np.tile([0.0, 1.0], len(strip)))
    found: FloatArray = curves.point[curves.start[:-1], 0, 0].reshape(-1, 2)
    return found
