"""Lines of constant curvature as polylines: joined, sampled, in the order of levels and surfaces.

Examples
--------
>>> import assoc_hull as ah
>>> import numpy as np
>>> u, v = np.mgrid[0:4, 0:4] / 3.0
>>> wave = np.array([0.0, -0.5, -0.5, 0.8])[:, None]
>>> net = np.stack([2 * u, v, wave + 0.1 * v * (v > 0.5)], axis=-1)
>>> [(piece.kind, piece.level) for piece in ah.curvature_regions(net, zero="exact").components]
[('open', 0.0)]
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.patches.components import Component as Joined
from assoc_hull.geometry.patches.components import ComponentKind
from assoc_hull.geometry.patches.gathering import rows_of
from assoc_hull.geometry.patches.joining import joined
from assoc_hull.geometry.patches.patches import Patches
from assoc_hull.geometry.patches.points import points
from assoc_hull.geometry.patches.touching import clusters
from assoc_hull.surface.regions.edge_polylines import edge_polyline
from assoc_hull.surface.regions.region_component import Component
from assoc_hull.surface.regions.region_options import RegionOptions
from assoc_hull.surface.regions.region_parts import RegionPart, Solution

__all__ = ["components_of"]

_SAME = 1e-9
"""In parameters of a patch: ends of arcs that are nearer are one point."""


def components_of(parts: Sequence[RegionPart], options: RegionOptions) -> tuple[Component, ...]:
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


def _pieces(part: RegionPart, solution: Solution, chord_tol: float) -> list[Component]:
    """Give the components of one level of one part."""
    patches = part.patches
    lines = joined(patches, solution.cells, solution.arcs, solution.edges)
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
    def of(cls, patches: Patches, solution: Solution) -> _Samples:
        """Put the points of arcs on their surface."""
        found = solution.points
        patch = np.repeat(solution.cells.patch[solution.arcs.cell], found.count)
        return cls(found.count, patches.parameters(patch, found.place), found.xyz)

    def chain(self, arcs: IntArray, loop: bool) -> tuple[FloatArray, FloatArray]:
        """Give the polyline along some arcs; points that two of them share once."""
        rows, arc = rows_of(self.count, arcs)
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
    part: RegionPart, solution: Solution, samples: _Samples, line: Joined, chord_tol: float
) -> Component:
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
    return Component(
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


def _sides(line: Joined) -> list[tuple[int, int]]:
    """Give patch and side of the borders of an edge line."""
    return [(patch, side) for patch, side in line.edges.tolist()]


def _ends(line: Joined) -> int:
    """Count the ends of lines at a junction, or of an open line."""
    return line.meetings if line.kind is ComponentKind.JUNCTION else len(line.end_kinds)


def _spots(patches: Patches, solution: Solution, rows: IntArray) -> tuple[FloatArray, FloatArray]:
    """Give a point for each group of cells that touch: the middle of the one most in the middle."""
    if not len(rows):
        return np.zeros((0, 2)), np.zeros((0, 3))
    patch, box = solution.cells.patch[rows], solution.cells.box[rows]
    low, high = (patches.parameters(patch, box[:, :, end]) for end in (0, 1))
    group = clusters(low, high, _SAME)
    middle = (low + high) / 2.0
    sums = [np.bincount(group, middle[:, axis]) for axis in (0, 1)]
    means = np.stack(sums, axis=1) / np.bincount(group)[:, None]
    order = np.lexsort((np.linalg.norm(middle - means[group], axis=1), group))
    best = order[np.unique(group[order], return_index=True)[1]]
    place = box[best].mean(axis=2)
    return patches.parameters(patch[best], place), points(patches, patch[best], place)
