"""Defects of a mesh: each found, named, and mended where that is safe."""

from __future__ import annotations

import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.surfaces.triangles import (
    Triangles,
    boundary_edges,
    check_mesh,
    inconsistent_triangles,
    part_contents,
    part_labels,
    turn_triangles,
    weld_edges,
)
from assoc_hull.io.reports import Notebook

__all__ = [
    "boundary_edges",
    "check_mesh",
    "facet_depth",
    "mend_mesh",
    "tell_branches",
    "tell_parts",
]

_WHERE = "the mesh"
_ROUNDING = 1e-6
"""Vertices this part of the size of the mesh apart are one, but for rounding."""

_PART = 0.01
"""Separate parts are told of from this part of the surface on."""


def mend_mesh(mesh: Triangles, book: Notebook) -> Triangles:
    """Drop repeated and degenerate triangles, weld cracks, turn all triangles one way.

    Parameters
    ----------
    mesh : Triangles
        As read, in m.
    book : Notebook
        Takes what was mended and what looks wrong.

    Raises
    ------
    BadInputError
        No triangle is left, or an edge is shared by so many triangles that there is no surface.
    """
    mesh = _drop_degenerate(mesh, book)
    mesh = _drop_duplicates(mesh, book)
    mesh = _weld(mesh, book)
    tell_branches(mesh, book)
    mesh = _wind(mesh, book)
    _tell_open(mesh, book)
    tell_parts(mesh, book)
    return mesh


def _size(mesh: Triangles) -> float:
    return float(np.ptp(mesh.xyz, axis=0).max())


def _drop_degenerate(mesh: Triangles, book: Notebook) -> Triangles:
    i, j, k = mesh.face.T
    good = (i != j) & (j != k) & (k != i)
    if not good.any():
        raise BadInputError("every triangle has nil area", f"in {_WHERE}", "export the mesh again")
    bad = int((~good).sum())
    if bad:
        book.repair("degenerate", _WHERE, f"{bad} triangles of two corners left out", bad)
    return mesh.part(good) if bad else mesh


def _drop_duplicates(mesh: Triangles, book: Notebook) -> Triangles:
    """Keep each triangle once, also where its copy differs by rounding."""
    i, j, k = np.sort(_labels(mesh)[mesh.face], axis=1).T
    order = np.lexsort((k, j, i))
    same = np.stack([np.diff(each[order]) == 0 for each in (i, j, k)]).all(axis=0)
    # Slivers within rounding have two labels that are one: these are no copies.
    same &= ((i < j) & (j < k))[order[1:]]
    first = order[np.append(True, ~same)]
    twice = len(mesh.face) - len(first)
    if not twice:
        return mesh
    book.repair("duplicate", _WHERE, f"{twice} triangles occur twice; each is kept once", twice)
    return mesh.part(np.sort(first))


def _labels(mesh: Triangles) -> IntArray:
    """Give each vertex a number; those that differ by rounding have one."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components
    from scipy.spatial import cKDTree

    pairs = cKDTree(mesh.xyz).query_pairs(_ROUNDING * _size(mesh), output_type="ndarray")
    count = len(mesh.xyz)
    if not len(pairs):
        return np.arange(count)
    graph = coo_array((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(count, count))
    return np.asarray(connected_components(graph, directed=False)[1], np.int64)


def _weld(mesh: Triangles, book: Notebook) -> Triangles:
    """Make vertices on open edges one that differ by rounding."""
    reach = _ROUNDING * _size(mesh)
    welded, count = weld_edges(mesh, reach)
    if not count:
        return mesh
    what = f"{count} vertices at most {1e3 * reach:.3g} mm off another joined to it"
    book.repair("weld", _WHERE, what, reach)
    return _drop_degenerate(welded, Notebook())


def tell_branches(mesh: Triangles, book: Notebook) -> None:
    """Tell of edges with three triangles or more.

    Raises
    ------
    BadInputError
        They are so many that there is no surface.
    """
    edges, count = np.unique(mesh.edge_keys(), return_counts=True)
    bad = edges[count > 2]
    if not len(bad):
        return
    place = _words(mesh.xyz[list(divmod(int(bad[0]), len(mesh.xyz)))].mean(axis=0))
    if len(bad) > 0.02 * len(edges):
        raise BadInputError(
            f"{len(bad)} of {len(edges)} edges have three triangles or more, first {place}",
            f"in {_WHERE}",
            "leave out appendages, decks inside and repeated parts",
        )
    what = f"{len(bad)} edges have three triangles or more, first {place}; lines may branch there"
    book.suspect("branch", _WHERE, what, len(bad))


def _wind(mesh: Triangles, book: Notebook) -> Triangles:
    """Turn neighbours the same way round, part by part, and each part outward."""
    flip = inconsistent_triangles(mesh)
    count = int(flip.sum())
    if count:
        what = f"{count} of {len(mesh.face)} triangles run against their neighbours; turned round"
        book.repair("winding", _WHERE, what, count)
        mesh = turn_triangles(mesh, flip)
    if part_contents(mesh, np.zeros(len(mesh.face), np.int64)).sum() < 0.0:
        book.repair("inside-out", _WHERE, "all normals pointed inward; turned round")
        mesh = turn_triangles(mesh, np.ones(len(mesh.face), np.bool_))
    return mesh


def facet_depth(mesh: Triangles, corner_deg: float = 15.0) -> float:
    """Estimate how deep (m) the facets of a mesh lie inside the surface, for 19 edges of 20.

    Two triangles of height h that meet at an angle t stand for an arc; it rises 3 t h / 16
    above them. Sharper edges than `corner_deg` are taken for knuckles.
    """
    keys = mesh.edge_keys()
    order = np.argsort(keys, kind="stable")
    first = np.flatnonzero(keys[order][1:] == keys[order][:-1])
    if not len(first):
        return 0.0
    owner = np.tile(np.arange(len(mesh.face)), 3)
    a, b = order[first], order[first + 1]
    vectors = mesh.area_vectors()
    area = np.maximum(np.linalg.norm(vectors, axis=1), 1e-300)
    unit = vectors / area[:, None]
    cosine = (unit[owner[a]] * unit[owner[b]]).sum(axis=1)
    angle = np.arccos(np.clip(cosine, -1.0, 1.0))
    ends = mesh.xyz[mesh.edges()[a]]
    length = np.maximum(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1), 1e-300)
    height = (area[owner[a]] + area[owner[b]]) / length
    depth = 3.0 / 16.0 * angle * height
    smooth = angle < np.deg2rad(corner_deg)
    if not smooth.any():
        return 0.0
    weight = (area[owner[a]] + area[owner[b]])[smooth]
    rank = np.argsort(depth[smooth])
    share = np.cumsum(weight[rank])
    return float(depth[smooth][rank][np.searchsorted(share, 0.95 * share[-1])])


def _tell_open(mesh: Triangles, book: Notebook) -> None:
    rim = boundary_edges(mesh)
    if len(rim):
        low, high = mesh.xyz[rim].min(axis=(0, 1)), mesh.xyz[rim].max(axis=(0, 1))
        what = (
            f"open: {len(rim)} edges have one triangle only, from {_words(low)} to {_words(high)}"
        )
        book.assume("open", _WHERE, what, len(rim))


def tell_parts(mesh: Triangles, book: Notebook) -> None:
    """Tell of large parts that touch nowhere: appendages, a second hull, patches not sewn."""
    label = part_labels(mesh)
    area = np.bincount(label, np.linalg.norm(mesh.area_vectors(), axis=1))
    large = np.flatnonzero(area > _PART * area.sum())
    if len(large) < 2:
        return
    corners = mesh.corners[label == large[1]].reshape(-1, 3)
    what = (
        f"{len(large)} parts that touch nowhere, the second from {_words(corners.min(axis=0))} to "
        f"{_words(corners.max(axis=0))}; all are cut: leave out what is no hull, or sew the patches"
    )
    book.suspect("parts", _WHERE, what, len(large))


def _words(place: FloatArray) -> str:
    x, y, z = place.tolist()
    return f"({x:.4g}, {y:.4g}, {z:.4g})"
