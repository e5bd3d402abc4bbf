"""Triangles of surfaces sewn where their borders run along each other, however each was cut.

Vertices on open edges that lie close become one; an open edge that passes close to a vertex of
another is split there. What stays open is a border, or a gap wider than asked for.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.facets import facets_of
>>> from assoc_hull.geometry.patches.spline_surface import SplineSurface
>>> from assoc_hull.geometry.patches.stitching import stitched
>>> from assoc_hull.geometry.surfaces.triangles import boundary_edges
>>> def plate(y, count):
...     net = np.zeros((count, 2, 3))
...     net[..., 0], net[..., 1] = np.mgrid[0:1:count * 1j, y:y + 1:2j]
...     return SplineSurface("", (1, 1), [0, *range(count), count - 1], [0, 0, 1, 1], net)
>>> both = facets_of([plate(0.0, 3), plate(1.0, 4)], 0.01, 2.0)
>>> len(boundary_edges(both.mesh)), len(boundary_edges(stitched(both, 1e-3).mesh))
(14, 9)
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.patches.facets import Facets, kept_facets
from assoc_hull.geometry.surfaces.triangles import Triangles, weld_edges
from assoc_hull.geometry.surfaces.winding import against_neighbours, part_labels

__all__ = ["outward_parts", "stitched"]

_PASSES = 6
"""A triangle has three sides; new triangles may have one that is open again."""


def stitched(facets: Facets, reach: float) -> Facets:
    """Sew borders that lie at most so far apart, m."""
    welded, _ = weld_edges(facets.mesh, reach)
    found = kept_facets(welded.xyz, welded.face, facets.surface, facets.uv)
    for _ in range(_PASSES):
        splits = _splits(found.mesh, reach)
        if splits is None:
            break
        found = _split(found, splits)
    return found


@attrs.frozen(eq=False)
class _Splits:
    """Sides of triangles to be split: a row for each new vertex, along each side in order."""

    face: IntArray
    side: IntArray
    vertex: IntArray
    part: FloatArray


def _splits(mesh: Triangles, reach: float) -> _Splits | None:
    """Find the vertices on open edges that lie on other open edges; one side a triangle."""
    from scipy.spatial import cKDTree

    rim = _rim_numbers(mesh)
    if not len(rim):
        return None
    ends = mesh.edges()[rim]
    vertex = np.unique(ends)
    start, step = mesh.xyz[ends[:, 0]], mesh.xyz[ends[:, 1]] - mesh.xyz[ends[:, 0]]
    length = np.sqrt((step * step).sum(axis=1))
    near = cKDTree(mesh.xyz[vertex]).query_ball_point(start + 0.5 * step, 0.5 * length + reach)
    edge = np.repeat(np.arange(len(rim)), [len(each) for each in near])
    if not len(edge):
        return None
    point = vertex[np.concatenate([np.array(each, np.int64) for each in near])]
    own = mesh.face[rim % len(mesh.face)][edge]
    edge, point = (each[(own != point[:, None]).all(axis=1)] for each in (edge, point))
    away = mesh.xyz[point] - start[edge]
    part = (away * step[edge]).sum(axis=1) / np.maximum(length[edge] ** 2, 1e-300)
    off = away - part[:, None] * step[edge]
    least = reach / np.maximum(length[edge], 1e-300)
    inside = (part > least) & (part < 1.0 - least)
    good = inside & ((off * off).sum(axis=1) <= reach * reach)
    if not good.any():
        return None
    edge, point, part = edge[good], point[good], part[good]
    face, side = rim[edge] % len(mesh.face), rim[edge] // len(mesh.face)
    first = np.full(len(mesh.face), 3)
    np.minimum.at(first, face, side)
    chosen = side == first[face]
    order = np.lexsort((part[chosen], face[chosen]))
    return _Splits(*(each[chosen][order] for each in (face, side, point, part)))


def _rim_numbers(mesh: Triangles) -> IntArray:
    """Give the open edges by their numbers among `Triangles.edges`."""
    keys = mesh.edge_keys()
    order = np.argsort(keys, kind="stable")
    new = np.append(True, np.diff(keys[order]) != 0)
    return np.asarray(order[new & np.append(new[1:], True)])


def _split(facets: Facets, splits: _Splits) -> Facets:
    """Part triangles from the corner across from the side that is split."""
    mesh = facets.mesh
    turn = np.arange(3)
    corner = (splits.side[:, None] + turn) % 3  # a, b on the side, c across from it
    a, b, c = (mesh.face[splits.face, corner[:, i]] for i in turn)
    at = [facets.uv[splits.face, corner[:, i]] for i in turn]
    new = at[0] + splits.part[:, None] * (at[1] - at[0])
    first = np.append(True, splits.face[1:] != splits.face[:-1])
    last = np.append(first[1:], True)
    before = np.where(first, a, np.roll(splits.vertex, 1))
    before_uv = np.where(first[:, None], at[0], np.roll(new, 1, axis=0))
    fans = [np.stack([before, splits.vertex, c], axis=1),
            np.stack([splits.vertex, b, c], axis=1)[last]]  # fmt: skip
    fans_uv = [
        np.stack([before_uv, new, at[2]], axis=1),
        np.stack([new, at[1], at[2]], axis=1)[last],
    ]
    kept = np.ones(len(mesh.face), np.bool_)
    kept[splits.face] = False
    owner = np.concatenate([np.flatnonzero(kept), splits.face, splits.face[last]])
    face = np.concatenate([mesh.face[kept], *fans])
    uv = np.concatenate([facets.uv[kept], *fans_uv])
    return kept_facets(mesh.xyz, face, facets.surface[owner], uv)


def outward_parts(facets: Facets) -> Facets:
    """Turn parts that touch nowhere so that each faces away from the middle of all of them.

    Surfaces of a file may face either way; where they are sewn, neighbours tell each other.
    """
    mesh = facets.mesh
    flip = against_neighbours(mesh)
    sign = np.where(flip, -1.0, 1.0)
    middle = 0.5 * (mesh.xyz.min(axis=0) + mesh.xyz.max(axis=0))
    flux = sign * (mesh.area_vectors() * (mesh.corners.mean(axis=1) - middle)).sum(axis=1)
    label = part_labels(mesh)
    flip ^= np.bincount(label, flux)[label] < 0.0
    face = np.where(flip[:, None], mesh.face[:, ::-1], mesh.face)
    uv = np.where(flip[:, None, None], facets.uv[:, ::-1], facets.uv)
    return Facets(Triangles(mesh.xyz, face, mesh.origin), facets.surface, uv)
