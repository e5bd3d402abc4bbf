"""Put frames and anchors together to the cells of a Coons surface."""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.analysis.net.anchors import Spot, anchors, spans, steady
from assoc_hull.analysis.net.gather import Net, Part, walk
from assoc_hull.analysis.net.loops import Frame, Unbounded, frames
from assoc_hull.analysis.net.slabs import arcs, planes
from assoc_hull.geometry.coons import Cells
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.paths import Bit, Paths, PathShapes, shapes

__all__ = ["Layout", "lay_out"]

_ORDER, _END_ORDER = 4, 8
"""Gauss points along a strip between sections, and along one at an end of the ship, where
lines are steeper."""

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
    """

    cells: Cells
    frames: tuple[Frame, ...]
    lost: tuple[Unbounded, ...]


@attrs.define(eq=False)
class _Draft:
    """Cells in the making: lists that grow strip by strip."""

    net: Net
    paths: list[list[Bit]] = attrs.field(factory=list)
    anchor_start: list[int] = attrs.field(factory=lambda: [0])
    anchor: list[int] = attrs.field(factory=list)
    near: list[IntArray] = attrs.field(factory=list)
    lean: list[FloatArray] = attrs.field(factory=list)
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
    draft = _Draft(net)
    for i, given in enumerate(found):
        found[i], run = anchors(given, every)
        for anchor in run:
            draft.anchor.append(draft.add(anchor.parts) if anchor.parts else -1)
        near, lean = leans(np.array([0.5 * (each.low + each.high) for each in run]))
        draft.near.append(near + len(draft.anchor) - len(run))
        draft.lean.append(lean)
        for j, (below, above) in enumerate(itertools.pairwise(run)):
            aft = draft.add(_between(found[i].aft, below.aft, above.aft))
            fore = draft.add(_between(found[i].fore, below.fore, above.fore))
            draft.cell.append((len(draft.anchor) - len(run) + j, aft, fore))
        draft.anchor_start.append(len(draft.anchor))
        draft.cell_start.append(len(draft.cell))
    paths = Paths.of(draft.paths)
    cells = _cells(net, draft, found, shapes(paths, net.batch), closed)
    return Layout(cells, tuple(found), tuple(lost))


def leans(height: FloatArray) -> tuple[IntArray, FloatArray]:
    """Give by which weights slopes follow from values: of the parabola through three.

    Parameters
    ----------
    height : (a,)
        Where the values lie, ascending, a >= 2.

    Returns
    -------
    near : (a, 2, 3) int
        Which three values, for the interval below and the one above.
    lean : (a, 2, 3)
        The weights; slopes are for the whole interval as unit of length.
    """
    count = len(height)
    near = np.zeros((count, 2, 3), np.int64)
    lean = np.zeros((count, 2, 3))
    width = np.diff(height)
    if count == 2:
        near[:, :] = 0, 1, 1
        lean[:, :] = -1.0, 1.0, 0.0
        return near, lean
    at = np.arange(count)
    middle = np.clip(at, 1, count - 2)
    three = middle[:, None] + np.array([-1, 0, 1])
    p = height[three]
    x = height[:, None]
    weight = np.stack(
        [
            (2 * x - p[:, 1:2] - p[:, 2:3]) / ((p[:, 0:1] - p[:, 1:2]) * (p[:, 0:1] - p[:, 2:3])),
            (2 * x - p[:, 0:1] - p[:, 2:3]) / ((p[:, 1:2] - p[:, 0:1]) * (p[:, 1:2] - p[:, 2:3])),
            (2 * x - p[:, 0:1] - p[:, 1:2]) / ((p[:, 2:3] - p[:, 0:1]) * (p[:, 2:3] - p[:, 1:2])),
        ],
        axis=2,
    )[:, 0]
    near[:] = three[:, None]
    lean[1:, 0] = weight[1:] * width[:, None]
    lean[:-1, 1] = weight[:-1] * width[:, None]
    return near, lean


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


def _cells(net: Net, draft: _Draft, found: list[Frame], walked: PathShapes, closed: bool) -> Cells:
    tiles: list[tuple[int, int, int, int, int]] = []
    tile_start = [0]
    for i in range(len(found)):
        for lower, aft, fore in draft.cell[draft.cell_start[i] : draft.cell_start[i + 1]]:
            tiles += [(lower, *tile) for tile in _tiles(walked, aft, fore)]
        tile_start.append(len(tiles))
    table = np.array(tiles, np.int64).reshape(-1, 5)
    anchor_start = np.array(draft.anchor_start, np.int64)
    anchor = np.array(draft.anchor, np.int64)
    plane = np.array(
        [frame.plane and all(steady(net, frame.keel + frame.deck)) for frame in found],
        np.bool_,
    )
    deck = np.array([closed and _is_deck(net, frame) for frame in found], np.bool_)
    column = [table[:, i].copy() for i in range(5)]
    return Cells(
        walked.paths,
        anchor_start,
        anchor,
        np.concatenate(draft.near),
        np.concatenate(draft.lean),
        np.array(tile_start, np.int64),
        column[0],
        column[1],
        column[2],
        column[3],
        column[4],
        plane,
        deck,
        np.where(plane, _ORDER, _END_ORDER).astype(np.int64),
    )


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


def _is_deck(net: Net, frame: Frame) -> bool:
    """Tell whether the upper side of a strip is a deck edge, not the centre plane."""
    if not frame.deck:
        return not all(net.centre[part[0]] for part in frame.aft + frame.fore) and _open_top(
            net, frame
        )
    return not all(net.centre[part[0]] for part in frame.deck)


def _open_top(net: Net, frame: Frame) -> bool:
    """Tell whether a strip without a side above ends off the centre plane."""
    from assoc_hull.geometry.evaluation import evaluate

    last = [rail[-1] for rail in (frame.aft, frame.fore)]
    place = evaluate(net.batch, np.array([p[0] for p in last]), np.array([p[2] for p in last]))
    return bool(np.abs(place[:, 1]).max() > 1e-6)
