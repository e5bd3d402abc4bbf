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

from functools import cached_property

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, IsoCurves, SplineBatch, freeze
from assoc_hull.geometry.numeric.dual import common_zeros, is_plain
from assoc_hull.geometry.splines.backend import compiled
from assoc_hull.geometry.splines.paths import (
    Paths,
    PathShapes,
    StripTiles,
    restrict_cubics,
    shape_paths,
)

__all__ = [
    "CoonsCells",
    "CoonsStrips",
]

_KEPT = 4
"""So many answers are kept: the rule along the strips asks the same after each edit."""


@attrs.frozen(eq=False)
class CoonsCells:
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
        not have are zero.
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
    _known: dict[bytes, StripTiles] = attrs.field(factory=dict, init=False, repr=False)

    def __attrs_post_init__(self) -> None:
        freeze(*attrs.astuple(self, recurse=False)[1:-1])

    @cached_property
    def rail(self) -> IntArray:
        """The bits of all tiles on the rails aft, then on those forward, (2 t,)."""
        return np.concatenate([self.aft, self.fore])

    def places(self, strip: IntArray) -> StripTiles:
        """Find what curves across strips (k,) consist of; the last answers are kept."""
        key = strip.tobytes()
        if key not in self._known:
            if len(self._known) >= _KEPT:
                self._known.clear()
            self._known[key] = self._places(strip)
        return self._known[key]

    def _places(self, strip: IntArray) -> StripTiles:
        curve, tile = _spread(self.tile_start, strip)
        whose, anchor = _spread(self.anchor_start, strip)
        path, flat = self.anchor[anchor], self.plane[strip[whose]]
        by_x, by_length = np.flatnonzero((path >= 0) & flat), np.flatnonzero((path >= 0) & ~flat)
        return StripTiles(
            _starts(self.tile_start, strip),
            curve,
            tile,
            _starts(self.anchor_start, strip)[curve] + self.first[tile],
            self.deck[tile],
            len(path),
            (by_x, path[by_x], whose[by_x]),
            (by_length, path[by_length], whose[by_length]),
        )


@attrs.frozen(eq=False)
class CoonsStrips:
    """Cells on given splines; implements `assoc_hull.geometry.curves.Strips`.

    Attributes
    ----------
    cells : CoonsCells
        The cells.
    walked : PathShapes
        Their paths.
    aft, span : (t, 4, 3), m
        The part of each tile on the rail with v = 0, and from there to that with v = 1.
    blend : (t, 4, 4)
        As that of the cells, but in u, from 0 to 1 along each tile.
    """

    cells: CoonsCells
    walked: PathShapes
    aft: FloatArray
    span: FloatArray
    blend: FloatArray

    @classmethod
    def on(
        cls, cells: CoonsCells, batch: SplineBatch, walked: PathShapes | None = None
    ) -> CoonsStrips:
        """Put cells on splines; `walked` are their paths if these have shapes already."""
        walked = shape_paths(cells.paths, batch) if walked is None else walked
        low = np.where(cells.low < 0, np.where(cells.low < -1, 1.0, 0.0), walked.begin[cells.low])
        high = np.where(cells.high < 0, 1.0, walked.begin[cells.high])
        bit, count = cells.rail, len(cells.aft)
        begin, finish = walked.begin[bit], walked.finish[bit]
        both = np.stack([low, low, high, high]).reshape(2, -1)
        part = (both - begin) / (finish - begin)
        rails = restrict_cubics(walked.cubic[bit], part[0], part[1])
        aft, fore = rails[:count], rails[count:]
        return cls(cells, walked, aft, fore - aft, restrict_cubics(cells.blend, low, high))

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
        where = cells.places(strip)
        done = self._compiled(where, v)
        if done is not None:
            return IsoCurves(where.start, *done, where.deck)
        rise = _combined(self.blend[where.tile], self._bows(where, v), where.first)
        span = self.span[where.tile]
        point = self.aft[where.tile] + v[where.curve][:, None, None] * span + rise[:, :, :3]
        across = span + rise[:, :, 3:]
        _lay_decks(where.deck, point, across)
        return IsoCurves(where.start, point, across, where.deck)

    def _compiled(self, where: StripTiles, v: FloatArray) -> tuple[FloatArray, FloatArray] | None:
        """Let compiled code do it, if there is any, for plain numbers; None if it cannot."""
        kernels = compiled()
        if kernels is None or len(where.other[0]) or not (is_plain(v) and is_plain(self.aft)):
            return None
        bow = np.zeros((where.anchors + 3, 6))
        done = kernels.tiles(where, v, self.walked, (self.aft, self.span, self.blend), bow)
        if done is not None:
            _lay_decks(where.deck, *done)
        found: tuple[FloatArray, FloatArray] | None = done
        return found

    def _bows(self, where: StripTiles, v: FloatArray) -> FloatArray:
        """Give by how much each anchor of each strip leaves its chord, and the derivative by v.

        (b, 6), with three rows of zeros behind, so that four can be taken from any.
        """
        first, last = self.walked.ends
        bow = common_zeros((where.anchors + 3, 6), v, first)
        for chosen, path, of, walk in (
            (*where.plane, self.walked.at_part),
            (*where.other, self.walked.at),
        ):
            if not len(chosen):
                continue
            at = v[of]
            place, slope = walk(path, at)
            begin = first[path]
            chord = last[path] - begin
            bow[chosen, :3] = place - (begin + at[:, None] * chord)
            bow[chosen, 3:] = slope - chord
        return bow


def _lay_decks(deck: NDArray[np.bool_], point: FloatArray, across: FloatArray) -> None:
    """Let the tiles of decks run in from where they begin, to the centre plane."""
    if deck.any():
        for shape in (point, across):
            shape[deck, 1, 1] = -shape[deck, 0, 1]


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
