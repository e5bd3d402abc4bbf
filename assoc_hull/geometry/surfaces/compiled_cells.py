"""Cells of a Coons surface put on splines, compiled: same operations in the same order, same bits.

It is what `shape_paths`, `cut_cells` of the layout of a net and `CoonsStrips.on` do, in one go, for
a surface of which only the places have changed. All constants come in as arguments.

Examples
--------
>>> from assoc_hull.geometry.surfaces.compiled_cells import set_cells, set_paths
>>> callable(set_cells) and callable(set_paths)
True
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.geometry.numeric.jit import jit, jit_part, was_loaded
from assoc_hull.geometry.splines.paths import Paths, PathShapes
from assoc_hull.geometry.surfaces.coons import CoonsCells, CoonsStrips

__all__ = ["CellStructure", "PutCells", "put_cells", "set_cells", "set_paths", "warm"]

Flags = NDArray[np.bool_]


@jit
def set_paths(
    path_start: IntArray, segment_knot: IntArray, crossing: IntArray, part: FloatArray,
    place: FloatArray, knot: FloatArray, xyz: FloatArray, leave: FloatArray, arrive: FloatArray,
    ends: FloatArray, cubic: FloatArray, begin: FloatArray, finish: FloatArray, length: FloatArray,
) -> bool:  # fmt: skip
    """Give paths their shapes; False if a place has left its segment.

    Parameters
    ----------
    path_start : (p + 1,) int
        Where the bits of each path begin.
    segment_knot : (b,) int
        The knot at which the segment of each bit begins.
    crossing : (2, b) int; part : (2, b)
        Where each begins and ends: one of `place`, or a part of its segment if that is -1.
    place : (k,), m
        Places of crossings on their curves.
    knot : (n,); xyz, leave, arrive : (3, n)
        The splines.
    ends : (2, b); cubic : (b, 4, 3); begin, finish : (b,)
        Get parts of segments, and the fields of `PathShapes`.
    length : (p,), m
        Gets the chord lengths of paths.
    """
    bits = len(segment_knot)
    for b in range(bits):
        f = segment_knot[b]
        first = knot[f]
        size = knot[f + 1] - first
        for side in range(2):
            at = crossing[side, b]
            u = (place[at] - first) / size if at >= 0 else part[side, b]
            if not 0.0 <= u <= 1.0:
                return False
            ends[side, b] = u
        a, h = ends[0, b], ends[1, b] - ends[0, b]
        for c in range(3):
            chord = xyz[c, f + 1] - xyz[c, f]
            c0, c1, last = xyz[c, f], leave[c, f] * size, arrive[c, f + 1] * size
            c2 = 3.0 * (chord - c1) + (c1 - last)
            c3 = (c1 - chord) + (last - chord)
            cubic[b, 0, c] = ((c3 * a + c2) * a + c1) * a + c0
            cubic[b, 1, c] = ((3.0 * c3 * a + 2.0 * c2) * a + c1) * h
            cubic[b, 2, c] = (3.0 * c3 * a + c2) * (h * h)
            cubic[b, 3, c] = c3 * (h * h * h)
    total = 0.0
    for p in range(len(path_start) - 1):
        base = total
        whole = 0.0
        for b in range(path_start[p], path_start[p + 1]):
            f, way = segment_knot[b], ends[1, b] - ends[0, b]
            way = (knot[f + 1] - knot[f]) * (-way if way < 0.0 else way)
            begin[b] = total - base
            total = total + way
            finish[b] = total - base
            whole += way
        length[p] = whole
        whole = total - base
        for b in range(path_start[p], path_start[p + 1]):
            # A path that is a point has one bit, from 0 to 1 like any other.
            begin[b] = begin[b] / (1.0 if whole == 0.0 else whole)
            finish[b] = 1.0 if whole == 0.0 else finish[b] / whole
    return True


@jit_part
def _set_heights(
    cell: int, count: int, rails: IntArray, length: FloatArray, up: FloatArray
) -> None:
    """Set how far up its strip each of its anchors lies, from 0 to 1."""
    total_aft, total_fore = 0.0, 0.0
    for k in range(count):
        total_aft += length[rails[cell + k, 0]]
        total_fore += length[rails[cell + k, 1]]
    aft, fore = 0.0, 0.0
    for k in range(count + 1):
        one = aft / total_aft if total_aft > 0.0 else 0.0
        other = fore / total_fore if total_fore > 0.0 else 0.0
        if total_aft == 0.0:
            one = other
        if total_fore == 0.0:
            other = one
        up[k] = 0.5 * (one + other)
        if k < count:
            aft += length[rails[cell + k, 0]]
            fore += length[rails[cell + k, 1]]


@jit_part
def _set_slope(k: int, count: int, up: FloatArray, at: IntArray, weight: FloatArray) -> None:
    """Set of which three anchors the slope at one is made, and their weights."""
    if count == 2:
        at[0], at[1], at[2] = 0, 1, -1
        weight[0], weight[1], weight[2] = -1.0 / (up[1] - up[0]), 1.0 / (up[1] - up[0]), 0.0
        return
    middle = min(max(k, 1), max(count - 2, 1))
    for i in range(3):
        at[i] = middle - 1 + i
    for i in range(3):
        one, two, three = up[at[i]], up[at[(i + 1) % 3]], up[at[(i + 2) % 3]]
        weight[i] = (2.0 * up[k] - two - three) / ((one - two) * (one - three))


@jit_part
def _set_blend(
    k: int, count: int, anchor: int, up: FloatArray, flat: Flags, knuckle: Flags, at: IntArray,
    weight: FloatArray, blend: FloatArray,
) -> int:  # fmt: skip
    """Set how the cell above an anchor carries on between its anchors; give the first of these."""
    first = min(max(k - 1, 0), max(count - 4, 0))
    _set_slope(k, count, up, at[0], weight[0])
    _set_slope(k + 1, count, up, at[1], weight[1])
    width = up[k + 1] - up[k]
    for j in range(4):
        column, inside = first + j, 1.0 if first + j < count else 0.0
        begin, end = (1.0 if column == k else 0.0), (1.0 if column == k + 1 else 0.0)
        begin, end = begin * inside, end * inside
        leave, arrive = 0.0, 0.0
        for i in range(3):
            if at[0, i] == column and not flat[anchor + k]:
                leave = weight[0, i]
            if at[1, i] == column and not flat[anchor + k + 1]:
                arrive = weight[1, i]
        leave, arrive = leave * width * inside, arrive * width * inside
        rise = end - begin
        if knuckle[anchor + k]:
            leave = rise
        if knuckle[anchor + k + 1]:
            arrive = rise
        blend[0, j], blend[1, j] = begin, leave
        blend[2, j] = 3.0 * rise - 2.0 * leave - arrive
        blend[3, j] = leave + arrive - 2.0 * rise
    return first


@jit_part
def _knots(
    aft: int, fore: int, path_start: IntArray, begin: FloatArray, sliver: float, bit: IntArray,
    value: FloatArray,
) -> int:  # fmt: skip
    """Set where the tiles of a cell begin, and the bits that do; give how many there are."""
    bit[0], value[0] = -1, 0.0
    count: int = path_start[0] + 1
    one, other = path_start[aft] + 1, path_start[fore] + 1
    last = 0.0
    while True:
        more, also = one < path_start[aft + 1], other < path_start[fore + 1]
        if not (more or also):
            return count
        take_one = more
        if more and also:
            take_one = begin[one] < begin[other] or (begin[one] == begin[other] and one <= other)
        at = one if take_one else other
        if take_one:
            one += 1
        else:
            other += 1
        # Tiles of a smaller part of a cell are not made.
        if begin[at] - last > sliver:
            last = begin[at]
            if last < 1.0 - sliver:
                bit[count], value[count] = at, last
                count += 1


@jit_part
def _restrict(
    number: int, t: int, source: FloatArray, low: float, high: float, column: int,
    target: FloatArray,
) -> None:  # fmt: skip
    """Set a cubic on a stretch of it, as `restrict_cubics`: rows `column` + 0 to 3 of tile t."""
    h = high - low
    c0, c1, c2, c3 = source[0, number], source[1, number], source[2, number], source[3, number]
    target[column, t] = ((c3 * low + c2) * low + c1) * low + c0
    target[column + 1, t] = ((3.0 * c3 * low + 2.0 * c2) * low + c1) * h
    target[column + 2, t] = (3.0 * c3 * low + c2) * (h * h)
    target[column + 3, t] = c3 * (h * h * h)


@jit
def set_cells(
    path_start: IntArray, cubic: FloatArray, begin: FloatArray, finish: FloatArray,
    length: FloatArray, anchor_start: IntArray, cell_start: IntArray, rails: IntArray, flat: Flags,
    knuckle: Flags, covered: Flags, sliver: float,
    tile_start: IntArray, whole: IntArray, cell_blend: FloatArray, deck: Flags,
    aft: FloatArray, span: FloatArray, blend: FloatArray, edge: IntArray,
) -> int:  # fmt: skip
    """Cut cells into tiles and give these their shapes; give how many there are.

    Parameters
    ----------
    path_start, cubic, begin, finish, length
        From `set_paths`.
    anchor_start, cell_start, rails, flat, knuckle, covered
        Of the layout; `covered` (n,): a strip has a deck.
    sliver : float
        Tiles of a smaller part of a cell are not made.
    tile_start : (n + 1,); whole : (6, t) int; cell_blend : (c, 4, 4); deck : (t,)
        Get the fields of `CoonsCells`; the rows of `whole` are first, aft, fore, low, high, and
        the cell of each tile. There is room for more tiles than there are.
    aft, span : (12, t); blend : (16, t); edge : (n,) int
        Get the shapes: see `compiled_strips.integrate_curves_of_strips`.
    """
    strips, most, deep = len(anchor_start) - 1, len(begin) - len(begin), len(begin) - len(begin)
    for i in range(strips):
        most = max(most, anchor_start[i + 1] - anchor_start[i])
    for p in range(len(path_start) - 1):
        deep = max(deep, path_start[p + 1] - path_start[p])
    up, at, weight = np.empty(most + 1), np.empty((2, 3), np.int64), np.empty((2, 3))
    bit, value = np.empty(2 * deep + 2, np.int64), np.empty(2 * deep + 2)
    tile = most - most
    for strip in range(strips):
        tile_start[strip], edge[strip] = tile, -1
        anchor, cell = anchor_start[strip], cell_start[strip]
        count = anchor_start[strip + 1] - anchor
        _set_heights(cell, count - 1, rails, length, up)
        for k in range(count - 1):
            own = cell_blend[cell + k]
            first = _set_blend(k, count, anchor, up, flat, knuckle, at, weight, own)
            one, other = rails[cell + k, 0], rails[cell + k, 1]
            knots = _knots(one, other, path_start, begin, sliver, bit, value)
            above, under = path_start[one], path_start[other]
            lid = 1 if covered[strip] and k == count - 2 else 0
            for i in range(knots + lid):
                low, high, codes = 1.0, 1.0, (-2, -1)
                if i < knots:
                    inner = i + 1 < knots
                    low, high = value[i], value[i + 1] if inner else 1.0
                    codes = (bit[i], bit[i + 1] if inner else -1)
                    middle = 0.5 * (low + high)
                    while above + 1 < path_start[one + 1] and begin[above + 1] <= middle:
                        above += 1
                    while under + 1 < path_start[other + 1] and begin[under + 1] <= middle:
                        under += 1
                whole[0, tile], whole[1, tile], whole[2, tile] = first, above, under
                whole[3, tile], whole[4, tile], whole[5, tile] = codes[0], codes[1], cell + k
                deck[tile] = i == knots
                if i == knots:
                    edge[strip] = tile - tile_start[strip]
                one_low = (low - begin[above]) / (finish[above] - begin[above])
                one_high = (high - begin[above]) / (finish[above] - begin[above])
                other_low = (low - begin[under]) / (finish[under] - begin[under])
                other_high = (high - begin[under]) / (finish[under] - begin[under])
                for c in range(3):
                    _restrict(c, tile, cubic[above], one_low, one_high, 4 * c, aft)
                    _restrict(c, tile, cubic[under], other_low, other_high, 4 * c, span)
                    for j in range(4):
                        span[4 * c + j, tile] = span[4 * c + j, tile] - aft[4 * c + j, tile]
                h = high - low
                for j in range(4):
                    c0, c1, c2, c3 = own[0, j], own[1, j], own[2, j], own[3, j]
                    blend[j, tile] = ((c3 * low + c2) * low + c1) * low + c0
                    blend[4 + j, tile] = ((3.0 * c3 * low + 2.0 * c2) * low + c1) * h
                    blend[8 + j, tile] = (3.0 * c3 * low + c2) * (h * h)
                    blend[12 + j, tile] = c3 * (h * h * h)
                tile += 1
    tile_start[strips] = tile
    return tile


# --------------------------------------------------------------------------------------
# The same for who calls it.

_set_paths: Callable[..., bool] = set_paths
_set_cells: Callable[..., int] = set_cells
"""They are called with the arrays of a structure, in the order above."""


@attrs.frozen(eq=False)
class CellStructure:
    """What of a surface does not depend on where its lines are.

    Attributes
    ----------
    cells : CoonsCells
        The cells as they were laid out.
    knot : (b,) int
        The knot at which the segment of each bit begins.
    crossing : (2, b) int; part : (2, b)
        Where bits begin and end: see `set_paths`.
    cell_start, rails, flat, knuckle, covered
        Of the layout.
    sliver : float
        Tiles of a smaller part of a cell are not made.
    """

    cells: CoonsCells
    knot: IntArray
    crossing: IntArray
    part: FloatArray
    cell_start: IntArray
    rails: IntArray
    flat: Flags
    knuckle: Flags
    covered: Flags
    sliver: float

    def __attrs_post_init__(self) -> None:
        freeze(*attrs.astuple(self, recurse=False)[1:-1])

    @cached_property
    def room(self) -> int:
        """More tiles than there can be."""
        start = self.cells.paths.start
        knots = int((start[self.rails + 1] - start[self.rails] - 1).sum())
        return len(self.rails) + knots + int(self.covered.sum()) + 1


@attrs.frozen(eq=False)
class PutCells:
    """Cells on other splines, as arrays; `tiles` is how many tiles there are.

    The names of arrays are those of `set_paths` and `set_cells`; there is room for more tiles.
    """

    structure: CellStructure
    tiles: int
    ends: FloatArray
    cubic: FloatArray
    begin: FloatArray
    finish: FloatArray
    tile_start: IntArray
    whole: IntArray
    cell_blend: FloatArray
    deck: Flags
    aft: FloatArray
    span: FloatArray
    blend: FloatArray
    edge: IntArray

    @property
    def cell(self) -> IntArray:
        """The cell of each tile, (t,)."""
        return self.whole[5, : self.tiles]

    @cached_property
    def cells(self) -> CoonsCells:
        """The cells."""
        was, first, blend = self.structure.cells, self.whole[0, : self.tiles], self.cell_blend
        paths = Paths(was.paths.start, was.paths.segment, self.ends[0], self.ends[1])
        aft, fore, low, high = (row[: self.tiles].copy() for row in self.whole[1:5])
        return CoonsCells(
            paths, was.anchor_start, was.anchor, self.tile_start, first.copy(), blend[self.cell],
            aft, fore, low, high, was.plane, self.deck[: self.tiles].copy(), was.order,
        )  # fmt: skip

    @cached_property
    def strips(self) -> CoonsStrips:
        """The surface."""
        walked = PathShapes(self.cells.paths, self.cubic, self.begin, self.finish)
        aft, span = (
            np.ascontiguousarray(each[:, : self.tiles].reshape(3, 4, -1).transpose(2, 1, 0))
            for each in (self.aft, self.span)
        )
        blend = self.blend[:, : self.tiles].reshape(4, 4, -1).transpose(2, 0, 1)
        return CoonsStrips(self.cells, walked, aft, span, np.ascontiguousarray(blend))


def put_cells(structure: CellStructure, batch: SplineBatch, place: FloatArray) -> PutCells | None:
    """Put cells on splines, with crossings at `place` (k, 2), m; None if one has left its segment.

    The bits are those of numpy.
    """
    cells, bits, room = structure.cells, len(structure.knot), structure.room
    paths, strips = cells.paths.start, len(cells.plane)
    ends, cubic = np.empty((2, bits)), np.empty((bits, 4, 3))
    begin, finish, length = np.empty(bits), np.empty(bits), np.empty(len(paths) - 1)
    vectors = (_plain(each.T) for each in (batch.xyz, batch.leave, batch.arrive))
    if not _set_paths(
        paths, structure.knot, structure.crossing, structure.part, _plain(place.ravel()),
        _plain(batch.knot), *vectors, ends, cubic, begin, finish, length,
    ):  # fmt: skip
        return None
    tile_start, edge = np.empty(strips + 1, np.int64), np.empty(strips, np.int64)
    whole, blends = np.empty((6, room), np.int64), np.empty((len(structure.rails), 4, 4))
    deck, shapes = np.empty(room, np.bool_), np.empty((40, room))
    aft, span, blend = shapes[:12], shapes[12:24], shapes[24:]
    freeze(ends, cubic, begin, finish, length)
    tiles: int = _set_cells(
        paths, cubic, begin, finish, length, cells.anchor_start, structure.cell_start,
        structure.rails, structure.flat, structure.knuckle, structure.covered, structure.sliver,
        tile_start, whole, blends, deck, aft, span, blend, edge,
    )  # fmt: skip
    freeze(tile_start, whole, blends, deck, aft, span, blend, edge)
    return PutCells(
        structure, tiles, ends, cubic, begin, finish, tile_start, whole, blends, deck, aft, span,
        blend, edge,
    )  # fmt: skip


def _plain(array: FloatArray) -> FloatArray:
    """Give a contiguous read-only view: one version is compiled."""
    found = np.ascontiguousarray(array).view()
    found.setflags(write=False)
    return found


def warm() -> bool:
    """Compile all, or load what was compiled; tell whether it was loaded."""
    start, none, flag = np.array([0, 1, 2]), np.zeros(2, np.int64), np.zeros(1, np.bool_)
    paths = Paths(start, none, np.zeros(2), np.ones(2))
    one = np.array([0, 2])
    cells = CoonsCells(
        paths, one, none - 1, one[:1], none, np.zeros((0, 4, 4)), none, none, none, none, flag,
        flag[:0], none,
    )  # fmt: skip
    structure = CellStructure(
        cells, none.copy(), np.full((2, 2), -1), np.array([[0.0, 0], [1, 1]]), np.array([0, 1]),
        np.array([[0, 1]]), np.zeros(2, np.bool_), np.zeros(2, np.bool_), flag.copy(), 1e-10,
    )  # fmt: skip
    wide = np.zeros((2, 3))
    batch = SplineBatch(one, np.array([0.0, 1.0]), wide, wide.copy(), wide.copy())
    put_cells(structure, batch, np.zeros((1, 2)))
    return was_loaded(set_paths) and was_loaded(set_cells)
