"""Lines along which the Gaussian curvature of surfaces has a value, as polylines.

Arcs of patches are joined over their borders; sides of patches with that curvature count as well.
They come in the order of levels and surfaces.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.patches.adjacency import SIDES, box_clusters
from assoc_hull.geometry.patches.bezier_patches import Patches, patch_points
from assoc_hull.geometry.patches.cells import rows_of_groups
from assoc_hull.geometry.patches.components import ComponentKind, ZeroSetComponent, join_arcs
from assoc_hull.surface.regions.options import RegionOptions
from assoc_hull.surface.regions.region_parts import LevelSolution, RegionPart

__all__ = [
    "LevelLine",
    "edge_polyline",
    "level_lines_of",
]


@attrs.frozen(eq=False)
class LevelLine:
    """A piece of the lines K = constant of a surface.

    Attributes
    ----------
    kind : {"closed", "open", "junction", "isolated", "edge_line"}
        A loop; a line from border to border (or to a knot where K jumps); lines that meet in an
        unresolved spot; a spot without lines, which may hold a point contact, a loop that is too
        small, or a double line; a border of a patch along which K has the value.
    level : float, 1/m2
        The value of K.
    surface : int
        The number of the surface, from 0.
    patches : tuple of int
        The numbers of the patches it passes, counted through all surfaces.
    uv : tuple of (n, 2)
        Polylines in parameters of the surface; of a loop the last point is the first again, of an
        isolated spot the only point is its middle.
    xyz : tuple of (n, 3), m
        The same points in space; each lies on the line, the chords stray by no more than the
        tolerance.
    ends : int
        Of a junction, how many lines lead to it; of an open line 2, else 0.
    tags : tuple of str
        "singular": the surface has no tangent plane there, and the piece is none of the shape.
        "knot-line": an end lies on a knot, where K jumps. "tangent": a line was followed through
        cells that were not resolved, and in which it is proven to be one line. "flat": it meets
        cells in which K has the value throughout, within what control points are known to. "gap":
        it was followed where K has the value within rounding.
    spots : (s, 3), m
        Where unresolved cells, or such in which K counts as zero, belong to it: a point for each
        group of cells that touch.
    """

    kind: str
    level: float
    surface: int
    patches: tuple[int, ...]
    uv: tuple[FloatArray, ...] = attrs.field(repr=False)
    xyz: tuple[FloatArray, ...] = attrs.field(repr=False)
    ends: int
    tags: tuple[str, ...]
    spots: FloatArray = attrs.field(factory=lambda: np.zeros((0, 3)), repr=False)

    def __attrs_post_init__(self) -> None:
        freeze(self.spots, *self.uv, *self.xyz)

    @property
    def singular(self) -> bool:
        """Whether it is a spot where the surface has no tangent plane."""
        return "singular" in self.tags

    @property
    def length(self) -> float:
        """The length of its polylines, m."""
        steps = (np.linalg.norm(np.diff(line, axis=0), axis=1).sum() for line in self.xyz)
        return float(sum(steps))


_MOST = 1000
"""A side has so many chords at most."""


def edge_polyline(
    patches: Patches, patch: int, side: int, chord_tol: float
) -> tuple[FloatArray, FloatArray]:
    """Give a polyline along a side of a patch: parameters of the surface (n, 2), points (n, 3), m.

    Side 0 is u = 0, 1 is u = 1, 2 is v = 0, 3 is v = 1; chords stray by `chord_tol` at most, m.
    """
    axis, value = SIDES[side]
    count = _count(patches.net[patch].take(int(value) * -1, axis), chord_tol)
    uv = np.full((count, 2), float(value))
    uv[:, 1 - axis] = np.linspace(0.0, 1.0, count)
    rows = np.full(count, patch)
    return patches.parameters(rows, uv), patch_points(patches, rows, uv)


def _count(control: FloatArray, chord_tol: float) -> int:
    """Give how many points keep chords of a curve of control points (d + 1, 3) to a tolerance."""
    degree = len(control) - 1
    if degree < 2:
        return 2
    bend = degree * (degree - 1) * np.linalg.norm(np.diff(control, 2, axis=0), axis=1).max()
    return 1 + min(max(math.ceil(math.sqrt(bend / (8.0 * chord_tol))), 1), _MOST)


_SAME = 1e-9
"""In parameters of a patch: ends of arcs that are nearer are one point."""


def level_lines_of(parts: Sequence[RegionPart], options: RegionOptions) -> tuple[LevelLine, ...]:
    """Join the arcs of all parts, level by level, surface by surface.

    Raises
    ------
    DanglingArcError
        A line ends where none can.
    """
    found = [
        (order, piece)
        for part in parts
        for order, solution in enumerate(part.solutions)
        for piece in _pieces(part, solution, options.chord_tol)
    ]
    found.sort(key=lambda each: (each[0], each[1].surface))
    return tuple(piece for _, piece in found)


def _pieces(part: RegionPart, solution: LevelSolution, chord_tol: float) -> list[LevelLine]:
    """Give the components of one level of one part."""
    patches = part.patches
    lines = join_arcs(patches, solution.cells, solution.arcs, solution.edges)
    if not lines:
        return []
    samples = _Samples.of(patches, solution)
    return [_component(part, solution, samples, line, chord_tol) for line in lines]


@attrs.frozen(eq=False)
class _Samples:
    """Points of all arcs of a part: how many each has (a,), parameters of the surface, xyz."""

    count: IntArray
    uv: FloatArray
    xyz: FloatArray

    @classmethod
    def of(cls, patches: Patches, solution: LevelSolution) -> _Samples:
        """Put the points of arcs on their surface."""
        found = solution.points
        patch = np.repeat(solution.cells.patch[solution.arcs.cell], found.count)
        return cls(found.count, patches.parameters(patch, found.place), found.xyz)

    def chain(self, arcs: IntArray, loop: bool) -> tuple[FloatArray, FloatArray]:
        """Give the polyline along some arcs; points that two of them share once."""
        rows, arc = rows_of_groups(self.count, arcs)
        uv, xyz = self.uv[rows], self.xyz[rows]
        first = np.flatnonzero(np.diff(arc, prepend=arc[0]))
        same = np.abs(uv[first] - uv[first - 1]).max(axis=1) <= _SAME
        kept = np.ones(len(rows), np.bool_)
        kept[first[same]] = False
        uv, xyz = uv[kept], xyz[kept]
        if not loop:
            return uv, xyz
        end = len(uv) - 1 if np.abs(uv[-1] - uv[0]).max() <= _SAME else len(uv)
        return np.concatenate([uv[:end], uv[:1]]), np.concatenate([xyz[:end], xyz[:1]])


def _component(
    part: RegionPart,
    solution: LevelSolution,
    samples: _Samples,
    line: ZeroSetComponent,
    chord_tol: float,
) -> LevelLine:
    """Give one component with its polylines."""
    patches = part.patches
    spots = _spots(patches, solution, line.cells)
    if line.kind is ComponentKind.ISOLATED:
        drawn = [(spots[0][:1], spots[1][:1])]
    elif line.kind is ComponentKind.EDGE_LINE:
        drawn = [edge_polyline(patches, *side, chord_tol) for side in _sides(line)]
    else:
        pairs = zip(line.chains, line.loops, strict=True)
        drawn = [samples.chain(arcs, loop) for arcs, loop in pairs]
    return LevelLine(
        line.kind.value,
        solution.level,
        int(patches.surface[line.patches[0]]),
        tuple(part.number[line.patches].tolist()),
        tuple(uv for uv, _ in drawn),
        tuple(xyz for _, xyz in drawn),
        _ends(line),
        line.tags,
        spots[1],
    )


def _sides(line: ZeroSetComponent) -> list[tuple[int, int]]:
    """Give patch and side of the borders of an edge line."""
    return [(patch, side) for patch, side in line.edges.tolist()]


def _ends(line: ZeroSetComponent) -> int:
    """Count the ends of lines at a junction, or of an open line."""
    return line.meetings if line.kind is ComponentKind.JUNCTION else len(line.end_kinds)


def _spots(
    patches: Patches, solution: LevelSolution, rows: IntArray
) -> tuple[FloatArray, FloatArray]:
    """Give a point for each group of cells that touch: the middle of the one most in the middle."""
    if not len(rows):
        return np.zeros((0, 2)), np.zeros((0, 3))
    patch, box = solution.cells.patch[rows], solution.cells.box[rows]
    low, high = (patches.parameters(patch, box[:, :, end]) for end in (0, 1))
    group = box_clusters(low, high, _SAME)
    middle = (low + high) / 2.0
    sums = [np.bincount(group, middle[:, axis]) for axis in (0, 1)]
    means = np.stack(sums, axis=1) / np.bincount(group)[:, None]
    order = np.lexsort((np.linalg.norm(middle - means[group], axis=1), group))
    best = order[np.unique(group[order], return_index=True)[1]]
    place = box[best].mean(axis=2)
    return patches.parameters(patch[best], place), patch_points(patches, patch[best], place)
