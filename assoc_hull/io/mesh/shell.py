"""The shell of a hull, and the lines that planes cut from it.

The shell is half of the mesh without deck, transom and the flat end of a bossing. Lines cut from it
end on the profile, the deck edge or the edges of the ends, which are its open edges (`RimKind`).
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.polylines.operations import distinct_points, order_paths
from assoc_hull.geometry.surfaces.triangles import Triangles, boundary_edges
from assoc_hull.io.lines.mend_lines import SAME_POINT
from assoc_hull.io.lines.slices import LinePiece
from assoc_hull.io.reports import Notebook

__all__ = [
    "MeshShell",
    "RimKind",
    "cut_faces",
    "cut_shell",
    "make_shell",
    "rim_pieces",
]


def cut_shell(shell: MeshShell, axis: int, offset: float) -> list[LinePiece]:
    """Cut a shell with a plane; pieces as they come, not joined yet.

    Parameters
    ----------
    shell : MeshShell
        Half a hull.
    axis : int
        The plane is where this coordinate equals `offset`.
    offset : float, m
    """
    mesh = shell.mesh
    height = mesh.xyz[:, axis] - offset
    above = height >= 0.0  # a vertex in the plane counts as above, for all its triangles
    side = above[mesh.face]
    cut = side.any(axis=1) & ~side.all(axis=1)
    face = mesh.face[cut]
    if not len(face):
        return []
    side = above[face]
    lone = np.argmax(side != (side.sum(axis=1) > 1)[:, None], axis=1)
    a, b, c = (face[np.arange(len(face)), (lone + i) % 3] for i in range(3))
    ends = np.sort(np.concatenate([np.column_stack([a, b]), np.column_stack([a, c])]), axis=1)
    keys, number = np.unique(ends[:, 0] * len(mesh.xyz) + ends[:, 1], return_inverse=True)
    pairs = np.column_stack(np.divmod(keys, len(mesh.xyz)))
    places = _edge_intersections(mesh.xyz, height, pairs, axis, offset)
    kinds = _rim_kinds(shell, pairs)
    links = number.reshape(2, -1).T
    sine = _plane_sines(mesh.corners_of(face), number.reshape(2, -1), len(pairs), axis)
    owner = None if mesh.origin is None else _first_owners(mesh.origin[cut], number)
    return _cut_pieces(order_paths(links, len(pairs)), places, kinds, sine, owner)


def _first_owners(origin: IntArray, number: IntArray) -> IntArray:
    """Give the origin of one of the triangles around each place: the first."""
    every = np.tile(origin, 2)
    return np.asarray(every[np.unique(number.ravel(), return_index=True)[1]])


def _plane_sines(corner: FloatArray, number: IntArray, count: int, axis: int) -> FloatArray:
    """Give the sine of the angle between the plane and the triangles around each place."""
    vectors = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
    sums = np.zeros((count, 3))
    for side in number:
        np.add.at(sums, side, vectors)
    length = np.maximum(np.sqrt((sums * sums).sum(axis=1)), 1e-300)
    cosine = np.abs(sums[:, axis]) / length
    return np.asarray(np.sqrt(np.maximum(1.0 - cosine * cosine, 0.0)))


def _edge_intersections(
    xyz: FloatArray, height: FloatArray, pairs: IntArray, axis: int, offset: float
) -> FloatArray:
    low, high = height[pairs[:, 0]], height[pairs[:, 1]]
    part = (low / (low - high))[:, None]
    places: FloatArray = xyz[pairs[:, 0]] + part * (xyz[pairs[:, 1]] - xyz[pairs[:, 0]])
    places[:, axis] = offset
    in_centre = (xyz[pairs, 1] == 0.0).all(axis=1)
    places[in_centre, 1] = 0.0
    return places


def _rim_kinds(shell: MeshShell, pairs: IntArray) -> IntArray:
    """Say on what each cut edge lies: an open edge, or none (loose if a line ends there)."""
    count = len(shell.mesh.xyz)
    rim = np.sort(shell.rim, axis=1)
    key = rim[:, 0] * count + rim[:, 1]
    order = np.argsort(key)
    mine = pairs[:, 0] * count + pairs[:, 1]
    at = np.minimum(np.searchsorted(key[order], mine), max(len(key) - 1, 0))
    if not len(key):
        return np.full(len(pairs), RimKind.LOOSE)
    found = key[order][at] == mine
    return np.where(found, shell.sort[order][at], RimKind.LOOSE)


def _cut_pieces(
    paths: list[tuple[IntArray, bool]],
    places: FloatArray,
    kinds: IntArray,
    sine: FloatArray,
    owner: IntArray | None,
) -> list[LinePiece]:
    found: list[LinePiece] = []
    for path, closed in paths:
        ring = np.append(path, path[0]) if closed else path
        kept = ring[distinct_points(places[ring], SAME_POINT)]
        points = places[kept]
        if len(points) < 2:
            continue
        ends = (RimKind.NAMES[kinds[path[0]]], RimKind.NAMES[kinds[path[-1]]])
        ends = ("loose", "loose") if closed else ends
        mine = None if owner is None else owner[kept]
        found.append(LinePiece(points, ends, closed, sine[kept], mine))
    return found


def rim_pieces(shell: MeshShell, sort: int) -> list[LinePiece]:
    """Give the open edges of one sort as polylines, the longest first."""
    mesh = shell.mesh
    chosen = shell.rim[shell.sort == sort]
    paths = order_paths(chosen, len(mesh.xyz))
    owner: IntArray | None = None
    if mesh.origin is not None:
        owner = np.zeros(len(mesh.xyz), np.int64)
        owner[mesh.face] = mesh.origin[:, None]
    found: list[LinePiece] = []
    for path, closed in paths:
        ring = np.append(path, path[0]) if closed else path
        kept = ring[distinct_points(mesh.xyz[ring], SAME_POINT)]
        found.append(LinePiece(mesh.xyz[kept], owner=None if owner is None else owner[kept]))
    length = [float(np.linalg.norm(np.diff(each.points, axis=0), axis=1).sum()) for each in found]
    return [found[i] for i in np.argsort(length)[::-1].tolist() if len(found[i].points) > 1]


_BoolArray = np.typing.NDArray[np.bool_]
_WHERE = "the mesh"
_PLANE = 1e-6
"""A vertex this part of the length off the centre plane lies in it."""


class RimKind:
    """What an open edge of the shell is."""

    PROFILE, DECK, TRANSOM, BOSSING, BOW, LOOSE = range(6)
    NAMES = ("profile", "deck edge", "transom", "bossing end", "bow end", "loose")


@attrs.frozen(eq=False)
class MeshShell:
    """Half a hull, y >= 0, without caps.

    Attributes
    ----------
    mesh : Triangles
        The shell, m.
    rim : (e, 2) int
        Its open edges.
    sort : (e,) int
        What each of them is, a number of `RimKind`.
    """

    mesh: Triangles
    rim: IntArray
    sort: IntArray


def make_shell(mesh: Triangles, book: Notebook) -> MeshShell:
    """Cut a mesh in ship axes at the centre plane and take deck and transom off.

    Parameters
    ----------
    mesh : Triangles
        In ship axes, m, outward.
    book : Notebook
        Takes what was found.

    Raises
    ------
    BadInputError
        No triangle lies at y > 0.
    """
    mesh = _half(mesh)
    deck, transom = _find_deck(mesh), _find_transom(mesh)
    deck &= ~transom
    bossing = _find_bossing_end(mesh) & ~transom
    bow = _find_transom(mesh, forward=True) & ~deck
    _tell_caps(mesh, deck, transom, book)
    _tell_flat_bow(mesh, bow, book)
    shell = mesh.part(~(deck | transom | bossing | bow))
    rim = boundary_edges(shell)
    caps = {RimKind.DECK: deck, RimKind.TRANSOM: transom, RimKind.BOW: bow}
    sort = _sort(mesh, rim, {kind: mesh.face[chosen] for kind, chosen in caps.items()})
    sort[_around_bossing(mesh, rim, sort)] = RimKind.BOSSING
    if (sort == RimKind.BOSSING).any():
        ends = mesh.xyz[rim[sort == RimKind.BOSSING]]
        x, z = float(ends[..., 0].mean()), ends[..., 2]
        what = f"flat across the ship at x = {x:.6g} m, z = {z.min():.6g} to {z.max():.6g} m"
        book.assume("bossing end", _WHERE, what, x)
    loose = int((sort == RimKind.LOOSE).sum())
    if loose:
        low = mesh.xyz[rim[sort == RimKind.LOOSE]][:, :, 2].min()
        what = f"{loose} open edges are no deck edge, transom or profile; the lowest at {low:.4g} m"
        book.suspect("hole", _WHERE, what, loose)
    return MeshShell(shell, rim, sort)


def _half(mesh: Triangles) -> Triangles:
    """Keep y >= 0; triangles across the plane are cut at it."""
    size = float(np.ptp(mesh.xyz, axis=0).max())
    xyz = mesh.xyz.copy()
    xyz[np.abs(xyz[:, 1]) < _PLANE * size, 1] = 0.0
    side = np.sign(xyz[:, 1])[mesh.face]
    whole = (side >= 0).all(axis=1) & (side > 0).any(axis=1)
    flat = (side == 0).all(axis=1)
    area = np.linalg.norm(mesh.area_vectors(), axis=1)
    if area[flat].sum() < 0.01 * area[whole].sum():
        # No cap on the centre plane, but corners of the hull whose three corners lie in it.
        whole |= flat
    across = (side > 0).any(axis=1) & (side < 0).any(axis=1)
    cut, extra, parent = cut_faces(xyz, mesh.face[across])
    face = np.concatenate([mesh.face[whole], cut])
    origin = mesh.origin
    if origin is not None:
        origin = np.concatenate([origin[whole], origin[across][parent]])
    if not len(face):
        raise BadInputError("nothing lies at positive y", f"in {_WHERE}", "give axes=")
    used, number = np.unique(face, return_inverse=True)
    return Triangles(np.concatenate([xyz, extra])[used], number.reshape(-1, 3), origin)


def cut_faces(xyz: FloatArray, face: IntArray) -> tuple[IntArray, FloatArray, IntArray]:
    """Give the parts at y >= 0 of triangles across the plane, the vertices they need, and whose."""
    keep = xyz[:, 1] >= 0.0
    lone = np.argmax(keep[face] != (keep[face].sum(axis=1) > 1)[:, None], axis=1)
    a, b, c = (face[np.arange(len(face)), (lone + i) % 3] for i in range(3))
    pairs, number = np.unique(
        np.sort(np.concatenate([np.column_stack([a, b]), np.column_stack([a, c])]), axis=1),
        axis=0, return_inverse=True,
    )  # fmt: skip
    low, high = xyz[pairs[:, 0]], xyz[pairs[:, 1]]
    places = low + (low[:, 1] / (low[:, 1] - high[:, 1]))[:, None] * (high - low)
    places[:, 1] = 0.0
    # An edge that ends in the plane is cut at its end.
    name = len(xyz) + np.arange(len(pairs))
    name = np.where(low[:, 1] == 0.0, pairs[:, 0], np.where(high[:, 1] == 0.0, pairs[:, 1], name))
    on_b, on_c = name[number.reshape(2, -1)]
    tip = keep[a]
    parts = [
        np.column_stack([a, on_b, on_c])[tip],
        np.column_stack([on_b, b, c])[~tip],
        np.column_stack([on_b, c, on_c])[~tip],
    ]
    found = np.concatenate(parts)
    every = np.arange(len(face))
    parent = np.concatenate([every[tip], every[~tip], every[~tip]])
    i, j, k = found.T
    good = (i != j) & (j != k) & (k != i)
    return found[good], places, parent[good]


def _find_deck(mesh: Triangles) -> _BoolArray:
    """Find level faces that look up, in large parts in the upper half of the hull."""
    vectors = mesh.area_vectors()
    area = np.linalg.norm(vectors, axis=1)
    low, high = mesh.xyz.min(axis=0), mesh.xyz.max(axis=0)
    up = vectors[:, 2] > 0.9 * area
    high_up = mesh.corners[:, :, 2].mean(axis=1) > 0.5 * (low[2] + high[2])
    plan = float((high[0] - low[0]) * (high[1] - low[1]))
    return _large_parts(mesh, up & high_up, area, 0.05 * plan)


def _find_transom(mesh: Triangles, *, forward: bool = False) -> _BoolArray:
    """Find a flat part that looks aft, at the aft end; or that of a barge's bow, forward."""
    vectors = mesh.area_vectors()
    area = np.linalg.norm(vectors, axis=1)
    low, high = mesh.xyz.min(axis=0), mesh.xyz.max(axis=0)
    x, size = mesh.corners[:, :, 0].mean(axis=1), float(high[0] - low[0])
    aft: _BoolArray = (vectors[:, 0] < -0.7 * area) & (x < low[0] + 0.1 * size)
    if forward:
        # A stem may be flat over its breadth and raked; the end plate of a barge is square to her.
        aft = (vectors[:, 0] > 0.99999 * area) & (x > high[0] - 0.1 * size)
    if not aft.any():
        return aft
    heart = int(np.argmax(np.where(aft, area, 0.0)))
    normal = vectors[aft].sum(axis=0)
    normal /= np.linalg.norm(normal)
    offset = float(mesh.corners[heart].mean(axis=0) @ normal)
    # A nose that is nearly flat is none: all its faces must look the same way.
    aft &= vectors @ normal > 0.9995 * area
    flat = aft & (np.abs(mesh.corners @ normal - offset).max(axis=1) < 2e-4 * (high[0] - low[0]))
    end = float((high[1] - low[1]) * (high[2] - low[2]))
    return _large_parts(mesh, flat, area, 0.005 * end)


_DISC = 2e-4
"""The least flat end of a bossing, as a part of breadth times depth of the half."""

_FLAT = 0.1
"""So far the edge of an end is off a plane across the ship, in parts of its size."""


def _find_bossing_end(mesh: Triangles) -> _BoolArray:
    """Find small flat parts square to the ship that look aft, as the end of a bossing or skeg."""
    vectors = mesh.area_vectors()
    area = np.linalg.norm(vectors, axis=1)
    low, high = mesh.xyz.min(axis=0), mesh.xyz.max(axis=0)
    aft = (vectors[:, 0] < -0.99999 * area) & (
        mesh.corners[:, :, 0].mean(axis=1) < 0.5 * (low[0] + high[0])
    )
    least = _DISC * float((high[1] - low[1]) * (high[2] - low[2]))
    return _large_parts(mesh, aft, area, least)


def _around_bossing(mesh: Triangles, rim: IntArray, sort: IntArray) -> _BoolArray:
    """Tell which loose edges go around an end that is flat across the ship, abaft midships."""
    loose = np.flatnonzero(sort == RimKind.LOOSE)
    out = np.zeros(len(rim), np.bool_)
    if not len(loose):
        return out
    middle = 0.5 * float(mesh.xyz[:, 0].min() + mesh.xyz[:, 0].max())
    number = np.full(len(mesh.xyz), -1)
    for i, (path, closed) in enumerate(order_paths(rim[loose], len(mesh.xyz))):
        size = np.ptp(mesh.xyz[path], axis=0)
        flat = size[0] <= _FLAT * min(size[1:])
        on_centre = closed or (mesh.xyz[path[[0, -1]], 1] == 0.0).all()
        if flat and on_centre and mesh.xyz[path, 0].max() < middle:
            number[path] = i
    edge = number[rim[loose]]
    out[loose] = (edge[:, 0] >= 0) & (edge[:, 0] == edge[:, 1])
    return out


def _large_parts(mesh: Triangles, chosen: _BoolArray, area: FloatArray, least: float) -> _BoolArray:
    """Keep of the chosen triangles those whose connected part has at least an area (m2)."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    number = np.flatnonzero(chosen)
    if not len(number):
        return chosen
    face = mesh.face[number]
    rows = np.repeat(np.arange(len(face)), 3)
    link = coo_array((np.ones(face.size), (rows, face.ravel())), shape=(len(face), len(mesh.xyz)))
    _, label = connected_components(link.tocsr() @ link.tocsr().T, directed=False)
    weight = np.bincount(label, area[number])
    out = np.zeros(len(chosen), np.bool_)
    out[number[weight[label] >= least]] = True
    return out


def _tell_caps(mesh: Triangles, deck: _BoolArray, transom: _BoolArray, book: Notebook) -> None:
    for name, chosen, axis in (("deck", deck, 2), ("transom", transom, 0)):
        if chosen.any():
            places = mesh.corners[chosen].reshape(-1, 3)[:, axis]
            low, high = float(places.min()), float(places.max())
            letter = "xyz"[axis]
            what = (
                f"{int(chosen.sum())} triangles at {letter} = {low:.6g} to {high:.6g} m taken off"
            )
            book.assume(name, _WHERE, what, low)
        else:
            book.assume(name, _WHERE, f"no {name} among the triangles")


def _tell_flat_bow(mesh: Triangles, bow: _BoolArray, book: Notebook) -> None:
    """Say that a hull ends forward in a plate, as a barge: lines end on its edge."""
    if bow.any():
        x = float(mesh.corners[bow][..., 0].mean())
        area = float(np.linalg.norm(mesh.area_vectors()[bow], axis=1).sum())
        what = f"a flat of {2.0 * area:.4g} m2 across the ship at x = {x:.6g} m taken off"
        book.assume("bow end", _WHERE, what, x)


def _sort(mesh: Triangles, rim: IntArray, caps: dict[int, IntArray]) -> IntArray:
    """Say what each open edge is; `caps` are the faces taken off by the sort of their edges."""
    sort = np.full(len(rim), RimKind.LOOSE)
    ends = mesh.xyz[rim]
    low, high = mesh.xyz.min(axis=0), mesh.xyz.max(axis=0)
    step = np.abs(ends[:, 1] - ends[:, 0])
    middle = ends.mean(axis=1)
    aft = middle[:, 0] < low[0] + 0.03 * (high[0] - low[0])
    centre = (ends[:, :, 1] == 0.0).all(axis=1)
    open_end = aft & ~centre & (step[:, 0] < 0.5 * np.linalg.norm(step, axis=1))
    top = _top(mesh, middle[:, 0]) - 0.05 * (high[2] - low[2])
    sort[middle[:, 2] > top] = RimKind.DECK
    # An open transom reaches far below the deck edge; one that is level there is the deck.
    if open_end.any() and np.ptp(ends[open_end][:, :, 2]) > 0.02 * (high[2] - low[2]):
        sort[open_end] = RimKind.TRANSOM
    keys = np.sort(rim, axis=1)
    for kind, faces in caps.items():
        around = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), 1)
        sort[_among(keys, around, len(mesh.xyz))] = kind
    sort[centre] = RimKind.PROFILE
    return sort


def _top(mesh: Triangles, x: FloatArray) -> FloatArray:
    """Give the height of the highest vertex near each x, m."""
    edges = np.linspace(mesh.xyz[:, 0].min(), mesh.xyz[:, 0].max(), 65)
    part = np.clip(np.searchsorted(edges, mesh.xyz[:, 0]) - 1, 0, 63)
    top = np.full(64, -np.inf)
    np.maximum.at(top, part, mesh.xyz[:, 2])
    known = np.flatnonzero(np.isfinite(top))  # a coarse mesh has no vertex in some parts
    top = np.interp(np.arange(64), known, top[known])
    return np.asarray(top[np.clip(np.searchsorted(edges, x) - 1, 0, 63)])


def _among(keys: IntArray, others: IntArray, count: int) -> _BoolArray:
    return np.asarray(np.isin(keys[:, 0] * count + keys[:, 1], others[:, 0] * count + others[:, 1]))
