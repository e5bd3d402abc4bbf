"""Triangulated surfaces: what they are, and where they are open."""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze

__all__ = [
    "Triangles",
    "boundary_edges",
    "check_mesh",
    "grid_triangles",
    "merge_vertices",
    "unmatched_edges",
    "weld_edges",
]

_WHERE = "the mesh"


@attrs.frozen(eq=False)
class Triangles:
    """A triangulated surface.

    Attributes
    ----------
    xyz : (v, 3)
        Places of the vertices.
    face : (f, 3) int
        Vertices of each triangle.
    origin : (f,) int or None
        Which triangle of another surface each is a part of, where that matters.
    """

    xyz: FloatArray
    face: IntArray
    origin: IntArray | None = None

    def __attrs_post_init__(self) -> None:
        freeze(self.xyz, self.face)
        if self.origin is not None:
            freeze(self.origin)

    def moved(self, xyz: FloatArray) -> Triangles:
        """Give the same triangles of vertices elsewhere, (v, 3)."""
        return Triangles(xyz, self.face, self.origin)

    def part(self, rows: IntArray | NDArray[np.bool_]) -> Triangles:
        """Give some of the triangles, by their numbers or a mask, of the same vertices."""
        origin = None if self.origin is None else self.origin[rows]
        return Triangles(self.xyz, self.face[rows], origin)

    @property
    def corners(self) -> FloatArray:
        """The corners of each triangle, (f, 3, 3)."""
        return self.corners_of(self.face)

    def corners_of(self, face: IntArray) -> FloatArray:
        """Give the corners of some triangles, (k, 3, 3)."""
        return np.asarray(self.xyz[face])

    def area_vectors(self) -> FloatArray:
        """Give half the cross product of two sides of each triangle, (f, 3)."""
        corner = self.corners
        return np.asarray(0.5 * np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]))

    def edges(self) -> IntArray:
        """Give the directed edges, (3 f, 2): all first ones, all second, all third."""
        return np.concatenate([self.face[:, [0, 1]], self.face[:, [1, 2]], self.face[:, [2, 0]]])

    def edge_keys(self) -> IntArray:
        """Give a number for each of the `edges`, the same for both directions."""
        low, high = np.sort(self.edges(), axis=1).T
        return np.asarray(low * len(self.xyz) + high)

    def volume(self) -> float:
        """Give the signed volume, positive for a closed surface with outward normals."""
        a, b, c = (self.corners[:, i] for i in range(3))
        return float((a * np.cross(b, c)).sum() / 6.0)


def merge_vertices(xyz: FloatArray, face: IntArray, origin: IntArray | None = None) -> Triangles:
    """Make equal places one vertex; the order of the vertices is that of their places."""
    places = xyz + 0.0
    order = np.lexsort(places.T[::-1])
    new = np.append(True, (np.diff(places[order], axis=0) != 0.0).any(axis=1))
    number = np.empty(len(places), np.int64)
    number[order] = np.cumsum(new) - 1
    return Triangles(places[order[new]], number[face], origin)


def grid_triangles(grid: FloatArray) -> Triangles:
    """Make two triangles of each cell of a grid of places, (m, n, 3); nil ones are left out.

    Outward where the first direction of the grid points forward, the second upward and the
    places lie to port.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.surfaces.triangles import grid_triangles
    >>> x, z = np.meshgrid([0.0, 1, 2], [0.0, 1], indexing="ij")
    >>> grid_triangles(np.stack([x, 0 * x, z], axis=2)).face.shape
    (4, 3)
    """
    number = np.arange(grid.shape[0] * grid.shape[1]).reshape(grid.shape[:2])
    a, b, c, d = number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]
    first = np.stack([a, c, b], axis=2).reshape(-1, 3)
    second = np.stack([a, d, c], axis=2).reshape(-1, 3)
    merged = merge_vertices(grid.reshape(-1, 3), np.concatenate([first, second]))
    i, j, k = merged.face.T
    return Triangles(merged.xyz, merged.face[(i != j) & (j != k) & (k != i)])


def check_mesh(mesh: Triangles) -> None:
    """Refuse triangles that are no surface in space.

    Raises
    ------
    BadInputError
        No triangle, one of a vertex that is not there, a vertex that is not finite, or all in
        one plane.
    """
    face, xyz = mesh.face, mesh.xyz
    if face.ndim != 2 or face.shape[1:] != (3,) or xyz.ndim != 2 or xyz.shape[1:] != (3,):
        shapes = f"xyz has shape {xyz.shape}, face {face.shape}"
        raise BadInputError(shapes, f"in {_WHERE}", "give (v, 3) places and (f, 3) numbers")
    if not len(face):
        raise BadInputError("there are no triangles", f"in {_WHERE}", "give the surface")
    outside = (face < 0) | (face >= len(xyz))
    if outside.any():
        bad = int(np.flatnonzero(outside.any(axis=1))[0])
        raise BadInputError(
            f"triangle {bad} has the vertices {face[bad].tolist()}", f"in {_WHERE}",
            f"give numbers from 0 to {len(xyz) - 1}",
        )  # fmt: skip
    wrong = np.flatnonzero(~np.isfinite(xyz).all(axis=1))
    if len(wrong):
        x, y, z = xyz[wrong[0]].tolist()
        raise BadInputError(
            f"vertex {wrong[0]} is not finite: ({x:g}, {y:g}, {z:g})", f"in {_WHERE}",
            "export it again, or leave out its triangles",
        )  # fmt: skip
    _refuse_flat(xyz)


def _refuse_flat(xyz: FloatArray) -> None:
    """Refuse a mesh without breadth or depth: nothing can be cut from it."""
    spread = np.linalg.svd(xyz - xyz.mean(axis=0), compute_uv=False)
    if len(spread) == 3 and spread[2] > 1e-6 * spread[0]:
        return
    kind = "on one line" if len(spread) < 2 or spread[1] <= 1e-6 * spread[0] else "in one plane"
    raise BadInputError(
        f"the mesh lies {kind}", f"in {_WHERE}", "export the surface, not a drawing"
    )


def boundary_edges(mesh: Triangles) -> IntArray:
    """Give the edges with one triangle only, as that triangle runs along them, (e, 2)."""
    keys = mesh.edge_keys()
    order = np.argsort(keys, kind="stable")
    new = np.append(True, np.diff(keys[order]) != 0)
    alone = order[new & np.append(new[1:], True)]
    return np.asarray(mesh.edges()[np.sort(alone)])


def unmatched_edges(mesh: Triangles) -> IntArray:
    """Give the edges that run one way more often than the other, (e, 2), as often as they do.

    These are the open edges; an edge of three triangles or more is among them if not every
    triangle has its counterpart. Without any, the triangles enclose what they seem to.
    """
    ends, keys = mesh.edges(), mesh.edge_keys()
    order = np.argsort(keys, kind="stable")
    first = np.flatnonzero(np.append(True, np.diff(keys[order]) != 0))
    net = np.add.reduceat(np.where(ends[order, 0] < ends[order, 1], 1, -1), first)
    left = np.flatnonzero(net)
    pair = np.sort(ends[order[first[left]]], axis=1)
    pair = np.where(net[left, None] > 0, pair, pair[:, ::-1])
    return np.asarray(np.repeat(pair, np.abs(net[left]), axis=0), np.int64)


def weld_edges(mesh: Triangles, reach: float) -> tuple[Triangles, int]:
    """Make vertices on open edges one that are at most so far apart, m; and count them.

    Triangles may lose a corner by it.
    """
    from scipy.spatial import cKDTree

    rim = np.unique(boundary_edges(mesh))
    pairs = cKDTree(mesh.xyz[rim]).query_pairs(reach, output_type="ndarray")
    xyz, pairs = mesh.xyz.copy(), rim[pairs]
    low, high = pairs.min(axis=1), pairs.max(axis=1)
    order = np.argsort(-low, kind="stable")
    xyz[high[order]] = mesh.xyz[low[order]]
    return merge_vertices(xyz, mesh.face, mesh.origin), len(np.unique(high))
