"""Regions of cells on the half hull: the lines that part them, their corners and outline.

A line parts a region as it parts the hull: by which cells lie on which side, not by coordinates.
A quad is a region without holes, with four nodes of its border for corners.
The outline bends where it turns by more than a limit over a stretch short beside the ship.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.numeric.vectors import dot
from assoc_hull.surface.cells.net_faces import NetCells
from assoc_hull.surface.cells.net_graph import NetGraph

__all__ = [
    "BRIDGE",
    "SIDES",
    "BorderCourse",
    "CellRegion",
    "ProfileBend",
    "Quad",
    "RegionChord",
    "border_course",
    "border_turns",
    "find_inward_bends",
]


BRIDGE = "bridge"
"""The family of edges that are no lines of the hull: cuts run along them."""


@attrs.frozen(eq=False)
class RegionChord:
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

    def reversed(self) -> RegionChord:
        """Give the same chord walked the other way."""
        return RegionChord(self.half[::-1] ^ 1, self.curve, self.last, self.first)


@attrs.frozen(eq=False)
class CellRegion:
    """Cells that hang together.

    Attributes
    ----------
    cells : NetCells
        All cells of the half hull.
    inside : (c,) bool
        Those of the region.
    """

    cells: NetCells
    inside: NDArray[np.bool_]

    def __attrs_post_init__(self) -> None:
        freeze(self.inside)

    @classmethod
    def whole(cls, cells: NetCells) -> CellRegion:
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

    def chords(self, curve: int) -> tuple[RegionChord, ...]:
        """Give the pieces of a curve that run through the region from border to border."""
        graph = self.graph
        own = np.flatnonzero((graph.curve == curve) & self.interior)
        own = own[np.argsort(graph.t[own, 0], kind="stable")]
        found, run = list[RegionChord](), list[int]()
        for edge in own.tolist():
            first, last = graph.edge[edge].tolist()
            if run and int(graph.edge[run[-1], 1]) != first:
                run = []
            if not run and not self.on_loop[first]:
                continue
            run.append(edge)
            if self.on_loop[last]:
                half = 2 * np.array(run, np.int64)
                found.append(RegionChord(half, curve, int(graph.edge[run[0], 0]), last))
                run = []
        return tuple(found)

    def parted(self, cuts: Sequence[IntArray]) -> tuple[CellRegion, ...]:
        """Give the parts left when the region is cut along half-edges, by their least cell.

        Only cells count, no coordinates: a bulb that reaches above its own cut stays in one piece.
        """
        free = self.interior.copy()
        for cut in cuts:
            free[cut >> 1] = False
        pair = self.cells.cell_of.reshape(-1, 2)[free]
        root = _components(self.cells.count, pair)
        names = np.unique(root[self.inside])
        return tuple(
            CellRegion(self.cells, self.inside & (root == name)) for name in names.tolist()
        )

    def with_half(self, cuts: Sequence[IntArray], half: int) -> CellRegion | None:
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


def _after(cells: NetCells) -> IntArray:
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


# --------------------------------------------------------------------------------------
# Quads.

SIDES = ("u0", "u1", "v0", "v1")


@attrs.frozen(eq=False)
class Quad:
    """A disc and four nodes of its border.

    Attributes
    ----------
    region : CellRegion
        The disc.
    corner : (int, int, int, int)
        Nodes at (u, v) least and least, greatest and least, both greatest, least and greatest:
        counter-clockwise from outside the hull, u forward and v from the deck down.
    """

    region: CellRegion
    corner: tuple[int, int, int, int]

    def side(self, name: str) -> IntArray:
        """Give the half-edges of a side, towards rising parameters."""
        a, b, c, d = self.corner
        first, last, turned = {
            "v0": (a, b, False), "u1": (b, c, False), "v1": (c, d, True), "u0": (d, a, True),
        }[name]  # fmt: skip
        run = self._run(first, last)
        return run[::-1] ^ 1 if turned else run

    def _run(self, first: int, last: int) -> IntArray:
        loop = self.region.loop
        node = self.region.begin(loop)
        i, j = (int(np.flatnonzero(node == each)[0]) for each in (first, last))
        order = np.arange(i, j if j > i else j + len(loop)) % len(loop)
        return np.asarray(loop[order])

    def nodes(self, name: str) -> IntArray:
        """Give the nodes of a side, towards rising parameters."""
        half = self.side(name)
        return np.append(self.region.begin(half), self.region.end(half[-1:]))

    def along(self, name: str, grid: float = 0.0) -> FloatArray:
        """Give how far along a side its nodes are, m; edges in steps of a grid, one at least."""
        length = self.region.graph.length[self.side(name) >> 1]
        if grid:
            length = np.maximum(np.round(length / grid), 1.0) * grid
        return np.append(0.0, np.cumsum(length))

    def extent(self) -> tuple[float, float]:
        """Give the mean lengths of opposite sides in u and in v, m."""
        u0, u1, v0, v1 = (float(self.along(name)[-1]) for name in SIDES)
        return 0.5 * (v0 + v1), 0.5 * (u0 + u1)


# --------------------------------------------------------------------------------------
# The outline and its bends. A neck between bulb and stem, or an aperture, is no corner on paper: it
# has a radius. What counts is by how much the outline turns over a stretch short beside the ship.

WINDOW = 0.012
"""Over this part of the ship's length the turn of the profile is taken."""

LEAST = 60.0
"""From so many degrees on it is a corner: the radius is below 1.2 % of the length."""

_STEPS = 16
_AWAY = 0.3
"""What turns about an axis this far against the normal turns outward; less is undecided."""


@attrs.frozen(eq=False)
class BorderCourse:
    """Places round the border of a region.

    Attributes
    ----------
    node : (k,) int
        The node at which each half-edge of the border begins.
    start : (k + 1,), m
        How far round the border these are, and the whole length.
    along : (p,), m
        How far places are, rising.
    place : (p, 3), m
        The places.
    centre : (p,) bool
        Which lie on the centreline of the hull.
    """

    node: IntArray
    start: FloatArray
    along: FloatArray
    place: FloatArray
    centre: np.typing.NDArray[np.bool_]

    def __attrs_post_init__(self) -> None:
        freeze(self.node, self.start, self.along, self.place, self.centre)

    @property
    def length(self) -> float:
        """The whole length, m."""
        return float(self.start[-1])

    def at(self, along: FloatArray) -> FloatArray:
        """Give places so far round the border, (k, 3), m; it closes."""
        turned = np.mod(along, self.length)
        return np.stack([np.interp(turned, self.along, c) for c in self.place.T], axis=-1)


@attrs.frozen
class ProfileBend:
    """A place where the profile bends into the ship.

    Attributes
    ----------
    along : float, m
        How far round the outline.
    turn : float, degrees
        By how much it turns over the window.
    place : (float, float, float), m
        Where.
    """

    along: float
    turn: float
    place: tuple[float, float, float]


def border_course(region: CellRegion) -> BorderCourse:
    """Give places round a region, sixteen an edge."""
    loop = region.loop
    place = region.path(loop, _STEPS)
    step = np.diff(place, axis=0)
    along = np.append(0.0, np.cumsum(np.sqrt(dot(step, step))))
    on = region.graph.net.centre[region.graph.curve[loop >> 1]]
    centre = np.append(on.repeat(_STEPS), on[-1])
    return BorderCourse(region.begin(loop), along[::_STEPS].copy(), along, place, centre)


def border_turns(
    found: BorderCourse, along: FloatArray, window: float, normal: FloatArray | None = None
) -> FloatArray:
    """Give by how much a border turns at places `along` it (k,), m: (k,), degrees.

    Chords of half the window, m, before and behind are compared. With outward normals (k, 3), where
    the border turns away from what it goes round, it counts as zero.
    """
    here = found.at(along)
    before, behind = here - found.at(along - 0.5 * window), found.at(along + 0.5 * window) - here
    sine = np.cross(before, behind)
    size = np.sqrt(dot(sine, sine))
    angle: FloatArray = np.degrees(np.arctan2(size, dot(before, behind)))
    if normal is not None:
        angle = np.where(dot(sine, normal) < -_AWAY * size, 0.0, angle)
    return angle


def find_inward_bends(
    found: BorderCourse, length: float, least: float = LEAST
) -> tuple[ProfileBend, ...]:
    """Find where the profile bends into the ship by `least` degrees or more, round the outline.

    The outline runs along the deck forward and along the keel aft; `length`, m, is that of the
    ship.
    """
    half = 0.5 * WINDOW * length
    along = np.arange(0.0, found.length, 0.05 * half)
    index = np.searchsorted(found.along, along, side="right") - 1
    centre = found.centre[np.clip(index, 0, len(found.centre) - 1)]
    tip = 0.2 * half
    ends = [found.at(along + x) for x in (-half - tip, -half, half, half + tip)]
    before, behind = ends[1] - ends[0], ends[3] - ends[2]
    # The outline runs clockwise in the side view: what turns to the left bends into the ship.
    sine = before[:, 0] * behind[:, 2] - before[:, 2] * behind[:, 0]
    turn = np.degrees(np.arctan2(sine, dot(before, behind)))
    flat = np.maximum.reduce([np.abs(each[:, 1]) for each in ends]) <= 1e-4 * length
    good = centre & flat & (turn >= least)
    edges = np.flatnonzero(np.diff(np.concatenate([[False], good, [False]]).astype(np.int8)))
    bends = []
    for low, high in edges.reshape(-1, 2).tolist():
        best = turn[low:high]
        # A round bend turns most on a plateau: its middle, within a degree.
        at = float(along[low:high][best >= best.max() - 1.0].mean())
        x, y, z = found.at(np.array([at]))[0].tolist()
        bends.append(ProfileBend(at, float(best.max()), (x, y, z)))
    return tuple(bends)
