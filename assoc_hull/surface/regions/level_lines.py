"""What is kept of each patch, and lines along which the Gaussian curvature has a value.

Arcs of patches are joined over their borders; sides of patches with that curvature count as well.
They come in the order of levels and surfaces.

What is kept of each patch: cells and arcs by level, points along arcs, areas by sign.

All of it depends on the control net of the patch and the options only, to the last bit.
So a patch with the same net may be taken from an earlier result.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import Self

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.patches.bezier_patches import Patches, patch_points
from assoc_hull.geometry.patches.cells import (
    SIDES,
    SignCells,
    ZeroSetArcs,
    box_clusters,
    rows_of_groups,
)
from assoc_hull.geometry.patches.components import ComponentKind, ZeroSetComponent, join_arcs
from assoc_hull.geometry.patches.line_ends import positive_on_left
from assoc_hull.geometry.patches.zero_set_arcs import sample_arcs
from assoc_hull.surface.regions.options import RegionOptions

__all__ = [
    "AREAS",
    "ArcPoints",
    "LevelLine",
    "LevelSolution",
    "RegionAreas",
    "RegionPart",
    "edge_polyline",
    "level_lines_of",
]


@attrs.frozen
class RegionAreas:
    """Areas of regions, m2; the first four add up to the total, within the tolerance.

    Attributes
    ----------
    positive : float, m2
        Where K > K0 for certain.
    negative : float, m2
        Where K < -K0 for certain.
    zero : float, m2
        Where |K| <= K0; without a band, where K is zero to what the control points are known to.
    unresolved : float, m2
        Where the search ended; it may belong to any region.
    positive_estimate, negative_estimate : float, m2
        The areas with what samples give of the unresolved part; they need not lie within the
        error estimate.
    error_estimate : float, m2
        What quadrature may be off by, in any of the areas.
    total : float, m2
        The whole area, found by itself.
    """

    positive: float
    negative: float
    zero: float
    unresolved: float
    positive_estimate: float
    negative_estimate: float
    error_estimate: float
    total: float

    @classmethod
    def added(cls, rows: Iterable[Iterable[float]]) -> Self:
        """Add up rows of these eight numbers, exactly rounded: the order does not matter."""
        return cls(*(math.fsum(column) for column in zip(*rows, strict=True)))

    @property
    def positive_share(self) -> float:
        """The part of the total where K > K0, nan of no area."""
        return self._share(self.positive)

    @property
    def negative_share(self) -> float:
        """The part of the total where K < -K0, nan of no area."""
        return self._share(self.negative)

    @property
    def zero_share(self) -> float:
        """The part of the total where |K| <= K0, nan of no area."""
        return self._share(self.zero)

    @property
    def unresolved_share(self) -> float:
        """The part of the total that is not resolved, nan of no area."""
        return self._share(self.unresolved)

    def _share(self, area: float) -> float:
        return area / self.total if self.total > 0.0 else np.nan

    def __str__(self) -> str:
        """Give shares and the total in a line."""
        return (
            f"{self.total:.6g} m2: {100 * self.positive_share:.4g} % convex, "
            f"{100 * self.negative_share:.4g} % saddle, {100 * self.zero_share:.4g} % developable, "
            f"{100 * self.unresolved_share:.2g} % unresolved"
        )


_MIDDLE = 0.8
"""Of the tolerance: chords are judged by a point near their middle, not by the farthest one."""


@attrs.frozen(eq=False)
class ArcPoints:
    """Points of arcs, those of each in the direction of a walk with the greater K on the left.

    Attributes
    ----------
    count : (a,) int
        How many points each arc has; they lie one behind the other.
    place : (p, 2)
        Parameters of the patch, 0 to 1.
    xyz : (p, 3), m
        The points in space.
    """

    count: IntArray
    place: FloatArray
    xyz: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.count, self.place, self.xyz)

    @classmethod
    def of(cls, patches: Patches, cells: SignCells, arcs: ZeroSetArcs, chord_tol: float) -> Self:
        """Sample arcs as finely as a chord tolerance (m) wants."""
        start, place = sample_arcs(patches, cells, arcs, _MIDDLE * chord_tol)
        count = np.diff(start)
        rows, arc = rows_of_groups(count, np.arange(len(arcs)))
        last = start[arc] + start[arc + 1] - 1
        place = place[np.where(positive_on_left(arcs)[arc], rows, last - rows)]
        return cls(count, place, patch_points(patches, cells.patch[arcs.cell][arc], place))

    @classmethod
    def gathered(cls, tables: Sequence[Self], patch: IntArray, chosen: IntArray) -> Self:
        """Give the points of chosen patches, in their order, out of several batches.

        `patch` (a,) is the patch of each arc, rising; patches are numbered through all batches.
        """
        count = np.concatenate([each.count for each in tables])
        most = int(max(patch.max(initial=-1), chosen.max(initial=-1))) + 1
        arcs, _ = rows_of_groups(np.bincount(patch, minlength=most), chosen)
        rows, _ = rows_of_groups(count, arcs)
        place, xyz = (
            np.concatenate([getattr(t, name) for t in tables]) for name in ("place", "xyz")
        )
        return cls(count[arcs], place[rows], xyz[rows])


AREAS = tuple(field.name for field in attrs.fields(RegionAreas))
"""Names of the columns of areas."""


@attrs.frozen(eq=False)
class LevelSolution:
    """Cells and arcs of all patches of a part, for one level.

    Attributes
    ----------
    level : float, 1/m2
        The Gaussian curvature.
    cells : SignCells
        Where K exceeds the level, where it is below, where neither is known.
    arcs : ZeroSetArcs
        Where it has this value.
    points : ArcPoints
        Points along the arcs.
    edges : (k, 4) bool
        Along which sides of each patch (u = 0, u = 1, v = 0, v = 1) it has this value.
    """

    level: float
    cells: SignCells
    arcs: ZeroSetArcs
    points: ArcPoints
    edges: NDArray[np.bool_]

    def __attrs_post_init__(self) -> None:
        freeze(self.edges)


@attrs.frozen(eq=False)
class RegionPart:
    """What is known of all patches of one bidegree.

    Attributes
    ----------
    patches : Patches
        The patches; `Patches.surface` numbers the surfaces of the result.
    number : (k,) int
        The numbers of the patches, counted through all surfaces of the result.
    solutions : tuple of LevelSolution
        By level: those of the band, then the further ones.
    areas : (k, 8), m2
        Of each patch; the columns are `AREAS`.
    delta : (k,), m
        What a coordinate of a control point was taken to be off by.
    """

    patches: Patches
    number: IntArray
    solutions: tuple[LevelSolution, ...]
    areas: FloatArray
    delta: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.number, self.areas, self.delta)

    def __len__(self) -> int:
        """Count the patches."""
        return len(self.number)


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
