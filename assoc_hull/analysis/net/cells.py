"""Put frames and anchors together to the cells of a Coons surface."""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.analysis.net.gather import Net, Part, walk
from assoc_hull.analysis.net.loops import Frame, Unbounded, frames
from assoc_hull.analysis.net.parallel import parallel_slabs
from assoc_hull.analysis.net.sections import CENTRE
from assoc_hull.analysis.net.slabs import arcs, planes
from assoc_hull.analysis.net.strip_anchors import Anchor, Spot, anchors, spans, steady
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.numeric.generic_sums import nil
from assoc_hull.geometry.numeric.polynomials import hermite
from assoc_hull.geometry.splines.evaluation import evaluate
from assoc_hull.geometry.splines.paths import Bit, Paths, PathShapes, shapes
from assoc_hull.geometry.surfaces.coons import Cells

__all__ = ["Layout", "blends", "lay_out"]

_ORDER, _END_ORDER = 4, 6
"""Gauss points along a strip between sections, and along one at an end of the ship, where
lines are steeper."""

_PLACES = 5
"""Places on a part of the deck edge at which it is looked at."""

_SLIVER = 1e-10
"""Tiles of a smaller part of a cell are not made."""


@attrs.frozen(eq=False)
class Layout:
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

    cells: Cells
    frames: tuple[Frame, ...]
    lost: tuple[Unbounded, ...]
    edge: NDArray[np.bool_]
    cell_start: IntArray
    rails: IntArray
    cell: IntArray
    flat: NDArray[np.bool_]
    knuckle: NDArray[np.bool_]

    def __attrs_post_init__(self) -> None:
        freeze(self.edge, self.cell_start, self.rails, self.cell, self.flat, self.knuckle)

    def deck_edge(self, net: Net) -> FloatArray:
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

    net: Net
    paths: list[list[Bit]] = attrs.field(factory=list)
    anchor_start: list[int] = attrs.field(factory=lambda: [0])
    anchor: list[int] = attrs.field(factory=list)
    blend: list[FloatArray] = attrs.field(factory=list)
    flat: list[bool] = attrs.field(factory=list)
    knuckle: list[bool] = attrs.field(factory=list)
    cell: list[tuple[int, int, int]] = attrs.field(factory=list)
    cell_start: list[int] = attrs.field(factory=lambda: [0])

    def add(self, parts: Sequence[Part]) -> int:
        """Add a path; give its number."""
        self.paths.append([bit for part in parts for bit in walk(self.net, part)])
        return len(self.paths) - 1


def lay_out(net: Net, length: float, closed: bool) -> Layout:
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
    x = planes(net)
    found, lost = frames(net, arcs(net, x), len(x), length)
    every = spans(net)
    parallel = parallel_slabs(net, x)
    draft = _Draft(net)
    for i, given in enumerate(found):
        found[i], run = anchors(given, every)
        if given.plane and given.slab in parallel:
            run = [attrs.evolve(each, parts=()) for each in (run[0], run[-1])]
        for anchor in run:
            draft.anchor.append(draft.add(anchor.parts) if anchor.parts else -1)
        flat = [_side(net, each, net.flat) for each in run]
        knuckle = [_side(net, each, net.knuckle) for each in run]
        draft.flat += flat
        draft.knuckle += knuckle
        height = np.array([0.5 * (each.low + each.high) for each in run])
        first, blend = blends(height, flat, knuckle)
        for j, (below, above) in enumerate(itertools.pairwise(run)):
            aft = draft.add(_between(found[i].aft, below.aft, above.aft))
            fore = draft.add(_between(found[i].fore, below.fore, above.fore))
            draft.cell.append((int(first[j]), aft, fore))
            draft.blend.append(blend[j])
        draft.anchor_start.append(len(draft.anchor))
        draft.cell_start.append(len(draft.cell))
    paths = Paths.of(draft.paths)
    edge = np.array([_is_edge(net, frame, found) for frame in found], np.bool_)
    cells, cell = _cells(net, draft, found, shapes(paths, net.batch), edge & closed)
    rails = np.array([each[1:] for each in draft.cell], np.int64).reshape(-1, 2)
    start = np.array(draft.cell_start, np.int64)
    sides = np.array(draft.flat, np.bool_), np.array(draft.knuckle, np.bool_)
    return Layout(cells, tuple(found), tuple(lost), edge, start, rails, cell, *sides)


def _top(frame: Frame) -> list[Part]:
    """Give the upper side of a strip; the ends of the rails if nothing is drawn there."""
    if frame.deck:
        return list(frame.deck)
    return [(rail[-1][0], rail[-1][2], rail[-1][2]) for rail in (frame.aft, frame.fore)]


def _side(net: Net, anchor: Anchor, which: NDArray[np.bool_]) -> bool:
    """Tell whether an anchor runs along curves of a kind."""
    return any(which[part[0]] for part in anchor.parts)


def blends(
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
    found: FloatArray = nil((count, count), height)
    at = np.arange(count)
    three = np.clip(at, 1, count - 2)[:, None] + np.array([-1, 0, 1])
    p = height[three]
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        weight = (2.0 * height - p[:, j] - p[:, k]) / ((p[:, i] - p[:, j]) * (p[:, i] - p[:, k]))
        found[at, three[:, i]] = weight
    return found


def _between(rail: tuple[Part, ...], low: Spot, high: Spot) -> list[Part]:
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
    net: Net, draft: _Draft, found: list[Frame], walked: PathShapes, deck: NDArray[np.bool_]
) -> tuple[Cells, IntArray]:
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
        [frame.plane and all(steady(net, frame.keel + frame.deck)) for frame in found],
        np.bool_,
    )
    column = [table[:, i].copy() for i in range(5)]
    cells = Cells(
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


def _is_edge(net: Net, frame: Frame, every: Sequence[Frame]) -> bool:
    """Tell whether the upper side of a strip is a deck edge, not the centre plane.

    Where no side is drawn only the uppermost strip of a slab has one: below it lie a bulb or a
    bossing that nothing closes.
    """
    if frame.deck:
        return not all(net.centre[part[0]] for part in frame.deck)
    place = _tops(net, frame)
    if float(np.abs(place[:, 1]).max()) <= CENTRE:
        return False
    others = [_tops(net, each) for each in every if each.slab == frame.slab]
    return float(place[:, 2].max()) >= max(float(each[:, 2].max()) for each in others)


def _tops(net: Net, frame: Frame) -> FloatArray:
    """Give the upper ends of the rails of a strip, (2, 3), m."""
    parts = [rail[-1] for rail in (frame.aft, frame.fore)]
    curve = np.array([part[0] for part in parts])
    found: FloatArray = evaluate(net.batch, curve, np.array([part[2] for part in parts]))
    return found
