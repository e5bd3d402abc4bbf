"""Outlines of regions: arcs, pieces of borders, and holes as loops of their own.

The outline of the positive region is made of the arcs, walked with it on the left, and of borders
of cells that are left over when what two of its cells share is cancelled: pieces of the border of
the patch, and sides of undecided cells. So areas that outlines enclose add up to that of the patch.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.zero_set_arcs import arcs_of
>>> from assoc_hull.geometry.patches.cells import CellKind
>>> from assoc_hull.geometry.patches.curvature_functions import IsoFunction
>>> from assoc_hull.geometry.patches.outlines import outlines_of_region, SignRegion
>>> from assoc_hull.geometry.patches.bezier_patches import Patches
>>> from assoc_hull.geometry.patches.cell_subdivision import subdivide_patches
>>> patches = Patches.single(np.zeros((2, 2, 3)))
>>> b = np.array([[[-1.0, -1.0], [3.0, 3.0]]])  # 4 u - 1
>>> cells = subdivide_patches(IsoFunction(b, 1e-15 + 0.0 * b))
>>> found = outlines_of_region(patches, SignRegion(cells, arcs_of(cells), CellKind.POSITIVE))
>>> found.loop(0).tolist(), found.enclosed.tolist()
([[0.25, 1.0], [0.25, 0.0], [1.0, 0.0], [1.0, 1.0]], [0.75])
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.patches.bezier_patches import Patches
from assoc_hull.geometry.patches.cells import (
    SHORT,
    CellKind,
    Lattice,
    SignCells,
    ZeroSetArcs,
    cancel_opposite_walks,
    region_borders,
    rows_of_groups,
)
from assoc_hull.geometry.patches.line_ends import (
    ArcChains,
    chain_arcs,
    directed_ends,
    find_joints,
    next_pieces,
    positive_on_left,
)

__all__ = ["Outlines", "SignRegion", "outlines_of_region", "outlines_of_rest"]


@attrs.frozen(eq=False)
class Outlines:
    """Closed polygons, with the region on the left: holes run the other way round.

    Attributes
    ----------
    uv : (p, 2)
        Corners, in parameters of the surface; the last leads to the first.
    start : (n + 1,) int
        Loop i has the corners ``uv[start[i] : start[i + 1]]``.
    patch : (n,) int
        The patch of each loop; of one that runs over several, one of them.
    """

    uv: FloatArray
    start: IntArray
    patch: IntArray

    def __attrs_post_init__(self) -> None:
        freeze(self.uv, self.start, self.patch)

    def __len__(self) -> int:
        """Count the loops."""
        return len(self.patch)

    def loop(self, number: int) -> FloatArray:
        """Give the corners (k, 2) of one loop."""
        return self.uv[self.start[number] : self.start[number + 1]]

    def chosen(self, rows: IntArray) -> Outlines:
        """Give some of the loops, in another order."""
        counts = np.diff(self.start)
        start = np.concatenate([[0], np.cumsum(counts[rows])])
        return Outlines(self.uv[rows_of_groups(counts, rows)[0]], start, self.patch[rows])

    @property
    def enclosed(self) -> FloatArray:
        """What each loop encloses, in parameters, (n,); negative for a hole."""
        after = np.arange(1, len(self.uv) + 1)
        after[self.start[1:] - 1] = self.start[:-1]
        # About the first corner of each loop, so that far places cost no digits.
        origin = np.repeat(self.uv[self.start[:-1]], np.diff(self.start), axis=0)
        a, b = self.uv - origin, self.uv[after] - origin
        areas = 0.5 * (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])
        return np.asarray(np.add.reduceat(areas, self.start[:-1])) if len(self) else np.zeros(0)


@attrs.frozen(eq=False)
class SignRegion:
    """Part of patches: cells of one kind, with their share of the cells that arcs cut.

    Attributes
    ----------
    cells, arcs : SignCells, ZeroSetArcs
        The cells of all patches, the arcs in these.
    kind : CellKind
        POSITIVE, NEGATIVE, ZERO (the polynomial is nil in whole cells) or UNRESOLVED.
    samples : (a + 1,) int and (p, 2), optional
        Points of arcs, in parameters of patches, as `sampling.sampled` gives them; without them
        arcs are straight.
    """

    cells: SignCells
    arcs: ZeroSetArcs
    kind: CellKind
    samples: tuple[IntArray, FloatArray] | None = None


def outlines_of_region(patches: Patches, region: SignRegion, across: bool = False) -> Outlines:
    """Give the outlines of a region.

    Parameters
    ----------
    patches : Patches
        The patches.
    region : SignRegion
        What of them.
    across : bool
        Whether regions of one surface are merged across the borders of patches.

    Returns
    -------
    Outlines
        In the order of patches, if they are not merged; holes behind what they are holes of.
    """
    lattice = _lattice(patches, across)
    pieces, lines = _bounds(lattice, region)
    return _looped(patches, lattice, _Lines.of(lattice, cancel_opposite_walks(pieces), [lines]))


def outlines_of_rest(
    patches: Patches, regions: Sequence[SignRegion], across: bool = False
) -> Outlines:
    """Give the outlines of what regions that do not overlap leave of their patches.

    Parameters
    ----------
    patches : Patches
        The patches.
    regions : sequence of SignRegion
        What is taken from them; each may be of another polynomial.
    across : bool
        As for `outlines`.

    Returns
    -------
    Outlines
        As those of a region.
    """
    lattice = _lattice(patches, across)
    taken = [_bounds(lattice, region) for region in regions]
    squares = lattice.squares().reshape(-1, 2, 2)
    pieces = np.concatenate([squares, *(pieces[:, ::-1] for pieces, _ in taken)])
    lines = [each.reversed() for _, each in taken]
    return _looped(patches, lattice, _Lines.of(lattice, cancel_opposite_walks(pieces), lines))


def _lattice(patches: Patches, across: bool) -> Lattice:
    """Lay out patches: side by side, or apart."""
    return Lattice.of(patches.surface, patches.box) if across else Lattice.apart(len(patches))


def _looped(patches: Patches, lattice: Lattice, lines: _Lines) -> Outlines:
    """Join lines into loops."""
    chains = chain_arcs(next_pieces(lines.ends, *lines.directions()))
    corners, start = lines.along(chains)
    patch = lines.patch[chains.firsts]
    found = Outlines(lattice.on_surface(patches.box, corners), start, patch)
    kept = np.flatnonzero(np.diff(start) > 2)
    return found.chosen(kept[np.lexsort([found.enclosed[kept] < 0.0, patch[kept]])])


@attrs.frozen(eq=False)
class _Lines:
    """Directed lines with a region on their left.

    Attributes
    ----------
    points : (p, 2)
        Points of all lines, in the lattice.
    start : (n + 1,) int
        Where the points of each line begin.
    patch : (n,) int
        The patch of each.
    """

    points: FloatArray
    start: IntArray
    patch: IntArray

    @classmethod
    def of(cls, lattice: Lattice, pieces: FloatArray, lines: Sequence[_Lines]) -> _Lines:
        """Put lines behind each other, straight pieces (n, 2, 2) last."""
        straight = cls(
            pieces.reshape(-1, 2),
            2 * np.arange(len(pieces) + 1),
            lattice.patch_at(pieces.mean(axis=1)),
        )
        every = [*lines, straight]
        counts = np.concatenate([np.diff(each.start) for each in every])
        return cls(
            np.concatenate([each.points for each in every]),
            np.concatenate([[0], np.cumsum(counts)]),
            np.concatenate([each.patch for each in every]),
        )

    def reversed(self) -> _Lines:
        """Give the same lines, walked from their ends, in the opposite order."""
        return _Lines(self.points[::-1], self.start[-1] - self.start[::-1], self.patch[::-1])

    @property
    def ends(self) -> FloatArray:
        """Where each line begins and ends, (n, 2, 2)."""
        return np.stack([self.points[self.start[:-1]], self.points[self.start[1:] - 1]], axis=1)

    def directions(self) -> tuple[FloatArray, FloatArray]:
        """Give the directions (n, 2) in which lines leave and arrive."""
        first, last = self.start[:-1], self.start[1:] - 1
        leave = self.points[np.minimum(first + 1, last)] - self.points[first]
        return leave, self.points[last] - self.points[np.maximum(last - 1, first)]

    def along(self, chains: ArcChains) -> tuple[FloatArray, IntArray]:
        """Give the corners of chains of lines, and where those of each begin."""
        counts = np.diff(self.start)
        rows, line = rows_of_groups(counts, chains.arcs)
        # The last point of a line is the first of the next.
        kept = rows != self.start[chains.arcs + 1][line] - 1
        ends = np.cumsum((counts - 1)[chains.arcs])
        return self.points[rows[kept]], np.concatenate([[0], ends])[chains.start]


def _bounds(lattice: Lattice, region: SignRegion) -> tuple[FloatArray, _Lines]:
    """Give the pieces (n, 2, 2) of borders of the cells of a region, and its arcs."""
    cells, arcs, kind = region.cells, region.arcs, region.kind
    patch = cells.patch[arcs.cell]
    ends = lattice.place(np.repeat(patch, 2), directed_ends(arcs).reshape(-1, 2))
    joints = find_joints(ends.reshape(-1, 2, 2))
    # Both arcs that meet in a point have the same one, to the last bit.
    ends = ends[joints.first][joints.joint]
    arc_of = np.full(len(cells), -1)
    arc_of[arcs.cell] = np.arange(len(arcs))
    pieces = region_borders(cells, lattice, kind, arc_of, ends)
    used = np.flatnonzero(np.abs(ends[:, 1] - ends[:, 0]).max(axis=1) > SHORT)
    if kind not in (CellKind.POSITIVE, CellKind.NEGATIVE):
        used = used[:0]
    positive = kind is CellKind.POSITIVE
    start, points = _sampled(lattice, patch, arcs, region.samples)
    points, start = _turned(points, start, used, positive_on_left(arcs)[used] != positive)
    ends = (ends if positive else ends[:, ::-1])[used]
    points[start[:-1]], points[start[1:] - 1] = ends[:, 0], ends[:, 1]
    return pieces, _Lines(points, start, patch[used])


def _sampled(
    lattice: Lattice,
    patch: IntArray,
    arcs: ZeroSetArcs,
    samples: tuple[IntArray, FloatArray] | None,
) -> tuple[IntArray, FloatArray]:
    """Give where the points of arcs begin, and the points in the lattice."""
    start, uv = samples or (2 * np.arange(len(arcs) + 1), arcs.ends.reshape(-1, 2))
    return start, lattice.place(np.repeat(patch, np.diff(start)), uv)


def _turned(
    points: FloatArray, start: IntArray, used: IntArray, turned: np.ndarray
) -> tuple[FloatArray, IntArray]:
    """Take the points of some arcs, some of them in reverse."""
    counts = np.diff(start)
    rows, arc = rows_of_groups(counts, used)
    ends = start[used] + start[used + 1] - 1
    rows = np.where(turned[arc], ends[arc] - rows, rows)
    return points[rows], np.concatenate([[0], np.cumsum(counts[used])])
