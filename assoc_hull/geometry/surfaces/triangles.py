"""Triangulated surfaces: what they are, where they are open, and which way their triangles run.

`Triangles` share vertices; corners go round counter-clockwise as seen from outside. Edges with one
triangle only are open. A triangle runs against its neighbour if both run along their common edge
the same way. A sheet holds together by edges of two triangles, a part by vertices.
"""

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
    "inconsistent_triangles",
    "merge_vertices",
    "part_contents",
    "part_labels",
    "sheet_labels",
    "turn_triangles",
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
    """Make two triangles of each cell of a grid of places, (m, n, 3); those without area go.

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


# --------------------------------------------------------------------------------------
# Which way round triangles run, and which of them belong together.

BoolArray = np.typing.NDArray[np.bool_]


def turn_triangles(mesh: Triangles, flip: BoolArray) -> Triangles:
    """Turn some triangles, (f,) bool, the other way round."""
    face = np.where(flip[:, None], mesh.face[:, ::-1], mesh.face)
    return Triangles(mesh.xyz, face, mesh.origin)


def inconsistent_triangles(mesh: Triangles) -> BoolArray:
    """Say which triangles run against the majority of their connected part."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import breadth_first_order, connected_components

    faces = len(mesh.face)
    one, other, same = _neighbours(mesh)
    flip = np.zeros(faces, np.bool_)
    if not same.any():
        return flip
    weight = np.where(same, 2.0, 1.0)
    graph = coo_array((weight, (one, other)), shape=(faces, faces)).tocsr()
    graph = (graph + graph.T).tocsr()
    parts, label = connected_components(graph, directed=False)
    before = np.arange(faces)
    first = np.unique(label, return_index=True)[1]
    for root in first.tolist():
        path, source = breadth_first_order(graph, root, directed=True)
        before[path[1:]] = source[path[1:]]
    moved = np.flatnonzero(before != np.arange(faces))
    flip[moved] = np.asarray(graph[moved, before[moved]]).ravel() == 2.0
    # How often the way back to the root turns: each pass doubles the steps looked back.
    while (before != before[before]).any():
        flip ^= flip[before]
        before = before[before]
    most = np.bincount(label, flip, parts) > 0.5 * np.bincount(label, minlength=parts)
    return flip ^ most[label]


def _neighbours(mesh: Triangles) -> tuple[IntArray, IntArray, BoolArray]:
    """Give the pairs of triangles that alone share an edge, and whether both run it one way."""
    edges, keys = mesh.edges(), mesh.edge_keys()
    owner = np.tile(np.arange(len(mesh.face)), 3)
    order = np.argsort(keys, kind="stable")
    first = np.flatnonzero(np.append(True, np.diff(keys[order]) != 0))
    two = first[np.diff(np.append(first, len(keys))) == 2]
    a, b = order[two], order[two + 1]
    return owner[a], owner[b], edges[a, 0] == edges[b, 0]


def sheet_labels(mesh: Triangles) -> IntArray:
    """Give each triangle the number of its sheet, (f,): those joined by edges of two triangles."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    one, other, _ = _neighbours(mesh)
    graph = coo_array((np.ones(len(one)), (one, other)), shape=(len(mesh.face),) * 2)
    return np.asarray(connected_components(graph, directed=False)[1], np.int64)


def part_labels(mesh: Triangles) -> IntArray:
    """Give each triangle the number of its part, (f,); parts touch nowhere."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    ends = mesh.edges().T
    graph = coo_array((np.ones(ends.shape[1]), tuple(ends)), shape=(len(mesh.xyz),) * 2)
    label = connected_components(graph, directed=False)[1]
    return np.asarray(label[mesh.face[:, 0]], np.int64)


def part_contents(mesh: Triangles, label: IntArray) -> FloatArray:
    """Give the volume in each part, m3, negative where triangles face inward.

    Exact for closed parts. For others the flux is taken from the middle of the part, which an
    opening in any side falsifies least.
    """
    corner = mesh.corners
    low = np.full((int(label.max()) + 1, 3), np.inf)
    high = -low
    np.minimum.at(low, label, corner.min(axis=1))
    np.maximum.at(high, label, corner.max(axis=1))
    away = corner.mean(axis=1) - 0.5 * (low + high)[label]
    flux = (mesh.area_vectors() * away).sum(axis=1) / 3.0
    return np.asarray(np.bincount(label, flux), np.float64)
