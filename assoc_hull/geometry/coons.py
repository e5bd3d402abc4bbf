"""A surface through a net of curves: Coons cells, strip by strip.

Between two *rails* (curves across the ship: sections, a stem) run *anchors* (curves along it:
waterlines, keel, deck edge). Two neighbouring anchors and the rails bound a cell, and the
cell is the bilinear Coons patch in the form

    P(u, v) = (1 - v) R0(u) + v R1(u) + D(f, v)

with D(f, v) the way by which the anchors leave their own chords, carried on between them by
cubics in f, the place up the cell from 0 to 1. So rails and anchors lie in the surface exactly
and neighbouring cells join without a gap. Straight lines in f in place of cubics would be
Coons's bilinear patch.

Source: S.A. Coons, "Surfaces for computer-aided design of space forms", MIT Project MAC
TR-41 (1967).
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.geometry.dual import is_plain
from assoc_hull.geometry.isocurves import IsoCurves
from assoc_hull.geometry.paths import Paths, PathShapes, shapes, stretch
from assoc_hull.geometry.tile_sums import nil

__all__ = ["Cells", "CoonsStrips"]


@attrs.frozen(eq=False)
class Cells:
    """How strips are put together from paths: all but the shape.

    Attributes
    ----------
    paths : Paths
        Anchors and the parts of rails between them.
    anchor_start : (n + 1,) int
        Where the anchors of each strip begin; from keel to deck.
    anchor : (a,) int
        The path of each anchor; -1 for a straight one.
    tile_start : (n + 1,) int
        Where the tiles of each strip begin; from keel to deck.
    first : (t,) int
        The first of the four anchors, counted within the strip, that shape each tile.
    blend : (t, 4, 4)
        By which weights: the coefficient of f^i of D is the sum over j of ``blend[:, i, j]``
        times what anchor `first` + j leaves its chord by. Weights of anchors that a strip does
        not have are nil.
    aft, fore : (t,) int
        The bit of `paths` that each tile takes from the rail with v = 0 and v = 1.
    low, high : (t,) int
        The bit at whose beginning the tile begins and ends, on its own rail; -1 for the
        beginning of the cell at `low`, for its end at `high`; -2 for the end at `low` too.
    plane : (n,) bool
        Both rails are sections: anchors are walked by x, so that all curves are sections.
    deck : (t,) bool
        The tile joins the last anchor straight to the centre plane: a closed deck.
    order : (n,) int
        Gauss points along v.
    """

    paths: Paths
    anchor_start: IntArray
    anchor: IntArray
    tile_start: IntArray
    first: IntArray
    blend: FloatArray
    aft: IntArray
    fore: IntArray
    low: IntArray
    high: IntArray
    plane: NDArray[np.bool_]
    deck: NDArray[np.bool_]
    order: IntArray

    def __attrs_post_init__(self) -> None:
        freeze(*attrs.astuple(self, recurse=False)[1:])


@attrs.frozen(eq=False)
class CoonsStrips:
    """Cells on given splines; implements `assoc_hull.geometry.isocurves.Strips`.

    Attributes
    ----------
    cells : Cells
        The cells.
    walked : PathShapes
        Their paths.
    aft, span : (t, 4, 3), m
        The part of each tile on the rail with v = 0, and from there to that with v = 1.
    blend : (t, 4, 4)
        As that of the cells, but in u, from 0 to 1 along each tile.
    """

    cells: Cells
    walked: PathShapes
    aft: FloatArray
    span: FloatArray
    blend: FloatArray

    @classmethod
    def on(cls, cells: Cells, batch: SplineBatch) -> CoonsStrips:
        """Put cells on splines."""
        walked = shapes(cells.paths, batch)
        low = np.where(cells.low < 0, np.where(cells.low < -1, 1.0, 0.0), walked.begin[cells.low])
        high = np.where(cells.high < 0, 1.0, walked.begin[cells.high])
        rails = []
        for bit in (cells.aft, cells.fore):
            begin, span = walked.begin[bit], walked.finish[bit] - walked.begin[bit]
            rails.append(stretch(walked.cubic[bit], (low - begin) / span, (high - begin) / span))
        return cls(cells, walked, rails[0], rails[1] - rails[0], stretch(cells.blend, low, high))

    @property
    def count(self) -> int:
        """Number of strips."""
        return len(self.cells.plane)

    @property
    def order(self) -> IntArray:
        """How many Gauss points along v each strip wants, (count,)."""
        return self.cells.order

    def curves(self, strip: IntArray, v: FloatArray) -> IsoCurves:
        """Give one curve for each pair of a strip and a v, (k,) each."""
        cells = self.cells
        curve, tile = _spread(cells.tile_start, strip)
        start = _starts(cells.tile_start, strip)
        bow = self._bows(strip, v)
        anchor = _starts(cells.anchor_start, strip)[curve] + cells.first[tile]
        rise = _combined(self.blend[tile], bow, anchor)
        span = self.span[tile]
        point = self.aft[tile] + v[curve][:, None, None] * span + rise[:, :, :3]
        across = span + rise[:, :, 3:]
        deck = cells.deck[tile]
        for shape in (point, across):
            shape[deck, 1, 1] = -shape[deck, 0, 1]
        return IsoCurves(start, point, across, deck)

    def _bows(self, strip: IntArray, v: FloatArray) -> FloatArray:
        """Give by how much each anchor of each strip leaves its chord, and the derivative by v.

        (b, 6), with three rows of nil behind, so that four can be taken from any.
        """
        cells = self.cells
        curve, anchor = _spread(cells.anchor_start, strip)
        path = cells.anchor[anchor]
        at, plane = v[curve], cells.plane[strip[curve]]
        first, last = self.walked.ends
        bow = nil((len(path) + 3, 6), v, first)
        for chosen, walk in (
            (np.flatnonzero((path >= 0) & plane), self.walked.at_part),
            (np.flatnonzero((path >= 0) & ~plane), self.walked.at),
        ):
            if not len(chosen):
                continue
            which, w = path[chosen], at[chosen][:, None]
            place, slope = walk(which, at[chosen])
            begin, chord = first[which], (last - first)[which]
            bow[chosen, :3] = place - (begin + w * chord)
            bow[chosen, 3:] = slope - chord
        return bow


def _starts(start: IntArray, strip: IntArray) -> IntArray:
    """Give where the parts of each chosen strip begin when put one behind the other."""
    found = np.zeros(len(strip) + 1, np.int64)
    np.cumsum(start[strip + 1] - start[strip], out=found[1:])
    return found


def _spread(start: IntArray, strip: IntArray) -> tuple[IntArray, IntArray]:
    """Give, for all parts of the chosen strips, which choice it is of, and its number."""
    count = start[strip + 1] - start[strip]
    curve = np.arange(len(strip)).repeat(count)
    first = np.cumsum(count) - count
    return curve, np.arange(len(curve)) - first[curve] + start[strip][curve]


def _combined(blend: FloatArray, bow: FloatArray, first: IntArray) -> FloatArray:
    """Give the sums of four rows of `bow` each, (s, 4, 6), by the weights `blend` (s, 4, 4)."""
    if is_plain(blend) and is_plain(bow):
        four: FloatArray = np.matmul(blend, bow[first[:, None] + np.arange(4)])
        return four
    total = blend[:, :, 0, None] * bow[first][:, None]
    for j in (1, 2, 3):
        total = total + blend[:, :, j, None] * bow[first + j][:, None]
    return total
