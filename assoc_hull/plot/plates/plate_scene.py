"""What is drawn of a plate, in metres: tiles, lines between regions, edges, unresolved cells."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.patches.cells import CellKind, Cells
from assoc_hull.geometry.patches.patches import Patches
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.plot.plates.curvature_tiles import tiles_of
from assoc_hull.surface.regions.region_component import Component
from assoc_hull.surface.regions.region_result import RegionResult

__all__ = [
    "STEPS",
    "Chart",
    "Line",
    "Scene",
    "Shape",
    "ground",
    "points_of",
    "scene_of",
    "steps_of",
]

STEPS = 40
"""Tiles along a side of a whole surface, about, where it is the only one of a picture."""

_FEWEST = 4
"""Tiles along a side of a patch at least."""

_ALONG = 64  # points of an edge


Chart = Callable[[FloatArray], FloatArray]
"""From parameters (..., 2) of a surface to where they are drawn, (..., 3), m."""


@attrs.frozen(eq=False)
class Scene:
    """A plate as tiles and lines in its parameters.

    Attributes
    ----------
    surface : SplineSurface
        The plate.
    uv : (k, 4, 2)
        Corners of the tiles, going round.
    tint : (k,) int
        1 convex, 0 developable, -1 saddle.
    under : (k,) bool
        Whether other tiles may lie on it.
    unresolved : (m, 4, 2)
        Corners of cells whose sign is not known.
    lines : tuple of Component
        Borders between regions, lines of further levels, spots.
    levels : tuple of float, 1/m2
        Of the lines, those of these levels are borders between regions.
    """

    surface: SplineSurface
    uv: FloatArray
    tint: IntArray
    under: NDArray[np.bool_]
    unresolved: FloatArray
    lines: tuple[Component, ...]
    levels: tuple[float, ...]

    def __attrs_post_init__(self) -> None:
        freeze(self.uv, self.tint, self.under, self.unresolved)

    @property
    def edges(self) -> tuple[FloatArray, ...]:
        """The four sides of the surface, (n, 2) each."""
        (u0, u1), (v0, v1) = self.surface.domain
        along = np.linspace(0.0, 1.0, _ALONG)
        u, v = u0 + (u1 - u0) * along, v0 + (v1 - v0) * along
        sides = ((u, v0), (u1, v), (u[::-1], v1), (u0, v[::-1]))
        return tuple(np.stack(np.broadcast_arrays(*side), axis=-1) for side in sides)

    def drawn(self, chart: Chart | None = None) -> Shape:
        """Give it in space, or on another chart."""
        at = chart or (lambda uv: points_of(self.surface, uv))
        return Shape(
            at(self.uv), self.tint, self.under, at(self.unresolved),
            tuple(Line(each.level, each.level in self.levels, at(uv))
                  for each in self.lines for uv in each.uv),
            tuple(at(edge) for edge in self.edges),
        )  # fmt: skip


@attrs.frozen(eq=False)
class Line:
    """A line K = level, or a spot of one point.

    Attributes
    ----------
    level : float, 1/m2
        The curvature.
    parting : bool
        Whether it parts regions.
    points : (n, 3), m
        Where it is drawn.
    """

    level: float
    parting: bool
    points: FloatArray


@attrs.frozen(eq=False)
class Shape:
    """A scene in space: points, m, where the scene has parameters.

    Attributes
    ----------
    corner : (k, 4, 3), m
        Of the tiles.
    tint, under : (k,)
        As of the scene.
    unresolved : (m, 4, 3), m
        Cells whose sign is not known.
    lines : tuple of Line
        Lines of constant curvature.
    edges : tuple of (n, 3), m
        Sides of the plate.
    """

    corner: FloatArray
    tint: IntArray
    under: NDArray[np.bool_]
    unresolved: FloatArray
    lines: tuple[Line, ...]
    edges: tuple[FloatArray, ...]

    @property
    def normal(self) -> FloatArray:
        """The normals of the tiles, as long as their areas, (k, 3), m2."""
        first, second = (self.corner[:, k + 2] - self.corner[:, k] for k in (0, 1))
        return np.asarray(0.5 * np.cross(first, second))


def ground(count: int, steps: int) -> tuple[IntArray, FloatArray]:
    """Give a grid of tiles on so many patches: the patch (k,), corners (k, 4, 2) in it."""
    side = np.linspace(0.0, 1.0, steps + 1)
    grid = np.stack(np.meshgrid(side, side, indexing="ij"), axis=-1)
    corner = np.stack([grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:]], axis=2)
    return np.repeat(np.arange(count), steps * steps), np.tile(
        corner.reshape(-1, 4, 2), (count, 1, 1)
    )


def scene_of(result: RegionResult, number: int, steps: int = STEPS) -> Scene:
    """Give what is drawn of one surface of a result.

    Regions are drawn of the cells that were proven to have one sign, and of both sides of the
    arcs in the others: their borders are those of the result, not of a grid. About so many
    tiles (`steps`) lie along a side of the surface.
    """
    surface = result.surfaces[number]
    parts = [_tiles(*search, steps) for search in _searches(result, number)]
    uv, tint, under, unresolved = (np.concatenate(each) for each in zip(*parts, strict=True))
    lines = tuple(each for each in result.components if each.surface == number)
    return Scene(surface, uv, tint, under, unresolved, lines, result.band.levels)


def _tiles(
    patches: Patches, cells: Cells, side: int, steps: int
) -> tuple[FloatArray, IntArray, NDArray[np.bool_], FloatArray]:
    """Give tiles of one search: corners on the surface, tints, which lie below; unresolved cells.

    Above the band (side 1) they lie on ground that is developable all over.
    """
    each = steps_of(patches, steps)
    tiles = tiles_of(cells, each)
    shown = (tiles.sign == side) | (side == 0)
    uv, tint = _on_surface(patches, tiles.patch, tiles.uv)[shown], tiles.sign[shown]
    under = np.zeros(len(uv), np.bool_)
    if side > 0:
        base = _on_surface(patches, *ground(len(patches), each))
        uv = np.concatenate([base, uv])
        tint, under = (
            np.concatenate([np.full(len(base), first, rest.dtype), rest])
            for first, rest in ((0, tint), (1, under))
        )
    return uv, tint, under, _unresolved(patches, cells)


def points_of(surface: SplineSurface, uv: FloatArray) -> FloatArray:
    """Give points (..., 3), m, at parameters (..., 2), which rounding may put outside."""
    if not uv.size:
        return np.zeros((*uv.shape[:-1], 3))
    (u0, u1), (v0, v1) = surface.domain
    return surface.at(np.clip(uv[..., 0], u0, u1), np.clip(uv[..., 1], v0, v1))


def steps_of(patches: Patches, steps: int) -> int:
    """Give how many tiles lie along a side of a patch, of so many for a whole surface."""
    return max(_FEWEST, round(steps / float(np.sqrt(max(len(patches), 1)))))


def _searches(result: RegionResult, number: int) -> Iterator[tuple[Patches, Cells, int]]:
    """Give the searches of a surface by level: 1 above the band, -1 below it, 0 without one."""
    for part in result.parts:
        chosen = np.flatnonzero(part.patches.surface == number)
        if not len(chosen):
            continue
        patches = part.patches[chosen]
        for solution in part.solutions:
            if solution.level in result.band.levels:
                yield patches, _of_patches(solution.cells, chosen), int(np.sign(solution.level))


def _of_patches(cells: Cells, chosen: IntArray) -> Cells:
    """Keep the cells of some patches, and number these anew."""
    place = np.full(len(cells.stopped), -1)
    place[chosen] = np.arange(len(chosen))
    kept = place[cells.patch] >= 0
    return attrs.evolve(
        cells, patch=place[cells.patch][kept], box=cells.box[kept], level=cells.level[kept],
        kind=cells.kind[kept], row=cells.row[kept], stopped=cells.stopped[chosen],
    )  # fmt: skip


def _on_surface(patches: Patches, patch: IntArray, uv: FloatArray) -> FloatArray:
    """Take corners (k, 4, 2) from parameters of patches (k,) to those of the surface."""
    return patches.parameters(np.repeat(patch, 4), uv.reshape(-1, 2)).reshape(-1, 4, 2)


def _unresolved(patches: Patches, cells: Cells) -> FloatArray:
    """Give the corners of unresolved cells in parameters of the surface, (m, 4, 2)."""
    rows = np.flatnonzero(cells.kind == CellKind.UNRESOLVED)
    (u0, u1), (v0, v1) = np.moveaxis(cells.box[rows], 0, -1)
    ring = ((u0, v0), (u1, v0), (u1, v1), (u0, v1))
    uv = np.stack([np.stack(corner, axis=-1) for corner in ring], axis=1)
    return _on_surface(patches, cells.patch[rows], uv)
