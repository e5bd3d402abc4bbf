"""The shell of a hull: half of the mesh, without deck and transom, and the edges they leave.

Lines cut from the shell end by themselves on the profile, the deck edge or the edge of the
transom.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.surfaces.triangles import Triangles, boundary_edges
from assoc_hull.io.offset_report import Notebook

__all__ = ["Rim", "Shell", "make_shell"]

_BoolArray = np.typing.NDArray[np.bool_]
_WHERE = "the mesh"
_PLANE = 1e-6
"""A vertex this part of the length off the centre plane lies in it."""


class Rim:
    """What an open edge of the shell is."""

    PROFILE, DECK, TRANSOM, LOOSE = range(4)
    NAMES = ("profile", "deck edge", "transom", "loose")


@attrs.frozen(eq=False)
class Shell:
    """Half a hull, y >= 0, without caps.

    Attributes
    ----------
    mesh : Triangles
        The shell, m.
    rim : (e, 2) int
        Its open edges.
    sort : (e,) int
        What each of them is, a number of `Rim`.
    """

    mesh: Triangles
    rim: IntArray
    sort: IntArray


def make_shell(mesh: Triangles, book: Notebook) -> Shell:
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
    _tell_caps(mesh, deck, transom, book)
    shell = mesh.part(~(deck | transom))
    rim = boundary_edges(shell)
    sort = _sort(mesh, rim, mesh.face[deck], mesh.face[transom])
    loose = int((sort == Rim.LOOSE).sum())
    if loose:
        low = mesh.xyz[rim[sort == Rim.LOOSE]][:, :, 2].min()
        what = f"{loose} open edges are no deck edge, transom or profile; the lowest at {low:.4g} m"
        book.suspect("hole", _WHERE, what, loose)
    return Shell(shell, rim, sort)


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
    cut, extra, parent = _cut_faces(xyz, mesh.face[across])
    face = np.concatenate([mesh.face[whole], cut])
    origin = mesh.origin
    if origin is not None:
        origin = np.concatenate([origin[whole], origin[across][parent]])
    if not len(face):
        raise BadInputError("nothing lies at positive y", f"in {_WHERE}", "give axes=")
    used, number = np.unique(face, return_inverse=True)
    return Triangles(np.concatenate([xyz, extra])[used], number.reshape(-1, 3), origin)


def _cut_faces(xyz: FloatArray, face: IntArray) -> tuple[IntArray, FloatArray, IntArray]:
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


def _find_transom(mesh: Triangles) -> _BoolArray:
    """Find a flat part that looks aft, at the aft end."""
    vectors = mesh.area_vectors()
    area = np.linalg.norm(vectors, axis=1)
    low, high = mesh.xyz.min(axis=0), mesh.xyz.max(axis=0)
    aft: _BoolArray = (vectors[:, 0] < -0.7 * area) & (
        mesh.corners[:, :, 0].mean(axis=1) < low[0] + 0.1 * (high[0] - low[0])
    )
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


def _sort(mesh: Triangles, rim: IntArray, deck: IntArray, transom: IntArray) -> IntArray:
    """Say what each open edge is."""
    sort = np.full(len(rim), Rim.LOOSE)
    ends = mesh.xyz[rim]
    low, high = mesh.xyz.min(axis=0), mesh.xyz.max(axis=0)
    step = np.abs(ends[:, 1] - ends[:, 0])
    middle = ends.mean(axis=1)
    aft = middle[:, 0] < low[0] + 0.03 * (high[0] - low[0])
    centre = (ends[:, :, 1] == 0.0).all(axis=1)
    open_end = aft & ~centre & (step[:, 0] < 0.5 * np.linalg.norm(step, axis=1))
    top = _top(mesh, middle[:, 0]) - 0.05 * (high[2] - low[2])
    sort[middle[:, 2] > top] = Rim.DECK
    # An open transom reaches far below the deck edge; one that is level there is the deck.
    if open_end.any() and np.ptp(ends[open_end][:, :, 2]) > 0.02 * (high[2] - low[2]):
        sort[open_end] = Rim.TRANSOM
    keys = np.sort(rim, axis=1)
    for faces, kind in ((deck, Rim.DECK), (transom, Rim.TRANSOM)):
        around = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), 1)
        sort[_among(keys, around, len(mesh.xyz))] = kind
    sort[centre] = Rim.PROFILE
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
