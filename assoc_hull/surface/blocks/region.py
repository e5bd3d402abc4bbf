"""Parts of the half hull: cells that hang together, and the lines that part them.

Lines part a region as they part the hull: nothing is said of coordinates, only of which cells lie
on which side. So a bulb that reaches above its own cut stays in one piece.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.surface.cells.faces import Cells
from assoc_hull.surface.cells.net_graph import NetGraph

__all__ = ["BRIDGE", "Chord", "Region"]

BRIDGE = "bridge"
"""The family of edges that are no lines of the hull: cuts run along them."""


@attrs.frozen(eq=False)
class Chord:
    """A piece of a line through a region, from border to border.

    Attributes
    ----------
    half : (k,) int
        Its half-edges, in the order they are walked.
    curve : int
        The curve of the net.
    first, last : int
        The nodes at its ends.
    """

    half: IntArray
    curve: int
    first: int
    last: int

    def __attrs_post_init__(self) -> None:
        freeze(self.half)

    def reversed(self) -> Chord:
        """Give the same chord walked the other way."""
        return Chord(self.half[::-1] ^ 1, self.curve, self.last, self.first)


@attrs.frozen(eq=False)
class Region:
    """Cells that hang together.

    Attributes
    ----------
    cells : Cells
        All cells of the half hull.
    inside : (c,) bool
        Those of the region.
    """

    cells: Cells
    inside: NDArray[np.bool_]

    def __attrs_post_init__(self) -> None:
        freeze(self.inside)

    @classmethod
    def whole(cls, cells: Cells) -> Region:
        """Give the whole half hull."""
        return cls(cells, np.ones(cells.count, np.bool_))

    @property
    def graph(self) -> NetGraph:
        """The net that the cells are of."""
        return self.cells.graph

    @cached_property
    def left(self) -> NDArray[np.bool_]:
        """Which half-edges have a cell of the region on their left, (2 e,)."""
        of = self.cells.cell_of
        return np.asarray((of >= 0) & self.inside[np.maximum(of, 0)])

    @cached_property
    def interior(self) -> NDArray[np.bool_]:
        """Which edges have the region on both sides, (e,)."""
        return np.asarray(self.left[0::2] & self.left[1::2])

    @cached_property
    def edges(self) -> NDArray[np.bool_]:
        """Which edges have the region on a side, (e,)."""
        return np.asarray(self.left[0::2] | self.left[1::2])

    @cached_property
    def loops(self) -> tuple[IntArray, ...]:
        """The half-edges round the region, it to their left; one loop if it is a disc."""
        border = np.flatnonzero(self.left & ~self.left[np.arange(len(self.left)) ^ 1])
        left, after, found, seen = self.left, _after(self.cells), [], set[int]()
        for first in border.tolist():
            if first in seen:
                continue
            run, at = [], first
            while at not in seen:
                seen.add(at)
                run.append(at)
                at = int(after[at])
                while left[at ^ 1]:
                    at = int(after[at ^ 1])
            found.append(np.array(run, np.int64))
        return tuple(found)

    @cached_property
    def is_disc(self) -> bool:
        """One loop that passes no node twice."""
        if len(self.loops) != 1:
            return False
        nodes = self.begin(self.loops[0])
        return len(np.unique(nodes)) == len(nodes)

    @cached_property
    def loop(self) -> IntArray:
        """The longest of the loops."""
        return max(self.loops, key=lambda each: float(self.graph.length[each >> 1].sum()))

    @cached_property
    def on_loop(self) -> NDArray[np.bool_]:
        """Which nodes lie on the border of the region, (n,)."""
        found = np.zeros(len(self.graph.place), np.bool_)
        for loop in self.loops:
            found[self.begin(loop)] = True
        return found

    def begin(self, half: IntArray) -> IntArray:
        """Give the nodes at which half-edges begin."""
        return np.asarray(self.graph.edge.ravel()[half])

    def end(self, half: IntArray) -> IntArray:
        """Give the nodes at which half-edges end."""
        return np.asarray(self.graph.edge.ravel()[half ^ 1])

    def chords(self, curve: int) -> tuple[Chord, ...]:
        """Give the pieces of a curve that run through the region from border to border."""
        graph = self.graph
        own = np.flatnonzero((graph.curve == curve) & self.interior)
        own = own[np.argsort(graph.t[own, 0], kind="stable")]
        found, run = list[Chord](), list[int]()
        for edge in own.tolist():
            first, last = graph.edge[edge].tolist()
            if run and int(graph.edge[run[-1], 1]) != first:
                run = []
            if not run and not self.on_loop[first]:
                continue
            run.append(edge)
            if self.on_loop[last]:
                half = 2 * np.array(run, np.int64)
                found.append(Chord(half, curve, int(graph.edge[run[0], 0]), last))
                run = []
        return tuple(found)

    def parted(self, cuts: Sequence[IntArray]) -> tuple[Region, ...]:
        """Give the parts left when the region is cut along half-edges, by their least cell."""
        free = self.interior.copy()
        for cut in cuts:
            free[cut >> 1] = False
        pair = self.cells.cell_of.reshape(-1, 2)[free]
        root = _components(self.cells.count, pair)
        names = np.unique(root[self.inside])
        return tuple(Region(self.cells, self.inside & (root == name)) for name in names.tolist())

    def with_half(self, cuts: Sequence[IntArray], half: int) -> Region | None:
        """Give the part, cut along half-edges, that has a half-edge's left; none if outside."""
        cell = int(self.cells.cell_of[half])
        for part in self.parted(cuts):
            if cell >= 0 and part.inside[cell]:
                return part
        return None

    def path(self, half: IntArray, steps: int = 16) -> FloatArray:
        """Give places along half-edges that follow one another, (k * steps + 1, 3), m."""
        pieces = self.graph.pieces.chosen(half >> 1)
        back = (half & 1).astype(np.bool_)
        part = np.linspace(0.0, 1.0, steps + 1)
        found = pieces.points(np.where(back[:, None], part[::-1], part))
        return np.concatenate([found[:, :-1].reshape(-1, 3), found[-1:, -1]])


def _after(cells: Cells) -> IntArray:
    """Give the next half-edge round the cell to the left of each; -1 outside."""
    found = np.full(2 * len(cells.graph.edge), -1, np.int64)
    rank = np.arange(len(cells.half)) + 1
    last = cells.start[1:] - 1
    rank[last] = cells.start[:-1]
    found[cells.half] = cells.half[rank]
    return found


def _components(count: int, pairs: IntArray) -> IntArray:
    """Give each of some cells the least number of those it hangs together with."""
    root = np.arange(count)
    while True:
        low = np.minimum(root[pairs[:, 0]], root[pairs[:, 1]])
        found = root.copy()
        np.minimum.at(found, pairs[:, 0], low)
        np.minimum.at(found, pairs[:, 1], low)
        found = found[found]
        if np.array_equal(found, root):
            return found
        root = found
