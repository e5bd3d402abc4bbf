"""Which way round the triangles of a surface run, and which of them belong together."""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.surfaces.triangles import Triangles

__all__ = ["against_neighbours", "part_contents", "part_labels", "sheet_labels", "turned"]

BoolArray = np.typing.NDArray[np.bool_]


def turned(mesh: Triangles, flip: BoolArray) -> Triangles:
    """Turn some triangles, (f,) bool, the other way round."""
    face = np.where(flip[:, None], mesh.face[:, ::-1], mesh.face)
    return Triangles(mesh.xyz, face, mesh.origin)


def against_neighbours(mesh: Triangles) -> BoolArray:
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
