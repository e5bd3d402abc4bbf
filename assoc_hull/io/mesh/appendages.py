"""What stands on the deck or hangs from a hull and is none of it: told, and left out.

A deck house, a rudder or a fin is a closed part beside a closed hull, or walls that rise out of the
deck: without its level faces they hang together with nothing. Where a house ends at the ship's side
its walls are those of the hull, as of a raised deck, and stay.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.surfaces.triangles import Triangles, boundary_edges, sheet_labels
from assoc_hull.io.mesh.frame import AxisChange
from assoc_hull.io.mesh.repair import tell_branches, tell_parts
from assoc_hull.io.reports import Notebook

__all__ = ["without_appendages"]

_WHERE = "the mesh"
_BoolArray = NDArray[np.bool_]

_LONG = 0.75
"""The hull reaches over this part of the length of all, or it is in several pieces itself; a part
that reaches over as much of the hull is another hull."""

_LEVEL, _DECK = 0.9, 0.05
"""Faces whose normal is steeper are level; in parts of this share of the plan they are a deck."""

_ROUNDING = 1e-6
"""Heights this part of the length apart are one."""

_CRUMB = 1e-5
"""Less than this share of the surface is a sliver of it, and no part."""

_NAMED = 4
"""So many parts are told by their places."""


def without_appendages(
    mesh: Triangles,
    placed: Triangles,
    place: Callable[[Triangles, Notebook], Triangles],
    book: Notebook,
    *,
    turned: bool,
) -> tuple[Triangles, Triangles, Notebook] | None:
    """Leave out what is no hull: the mesh (m, in the file), placed, and notes of placing it.

    `place` brings a mesh into ship axes, as `placed` is; `turned` says that it lay keel up. None
    where all is hull. What is left out is told in `book`: as a repair where it stands on the deck,
    else as a suspicion.
    """
    found = list(_parts(placed)) or list(_walls(placed))
    # A high house may hold more than its hull, which is then taken to lie keel up.
    over = not found and bool(turned)
    if over:
        found = list(_walls(placed.moved(placed.xyz * np.array([1.0, -1.0, -1.0]))))
    if not found:
        return None
    left = np.any(found, axis=0)
    bare = _compressed(mesh.part(~left))
    notes = Notebook()
    there = place(bare, notes)
    change = AxisChange.between(bare.xyz, there.xyz)
    up = AxisChange.between(mesh.xyz, placed.xyz).turn[:, 2]
    if over and float(change.turn[:, 2] @ up) > 0.0:
        return None  # keel up it is, and these are parts of its bottom
    _tell(mesh, mesh.moved(change.ahead(mesh.xyz)), left, found, book)
    book.suspicions[:] = [note for note in book.suspicions if note.kind not in ("parts", "branch")]
    tell_branches(bare, book)
    tell_parts(bare, book)
    return bare, there, notes


def _compressed(mesh: Triangles) -> Triangles:
    """Leave out vertices that no triangle has."""
    used, number = np.unique(mesh.face, return_inverse=True)
    return Triangles(mesh.xyz[used], number.reshape(-1, 3), mesh.origin)


def _extents(mesh: Triangles, chosen: _BoolArray) -> FloatArray:
    """Give least and greatest coordinates of some triangles, (2, 3)."""
    corner = mesh.xyz[mesh.face[chosen].ravel()]
    return np.stack([corner.min(axis=0), corner.max(axis=0)])


def _parts(mesh: Triangles) -> Iterator[_BoolArray]:
    """Give the closed parts beside the hull, each as a mask (f,); of a closed hull all others.

    Parts that are open beside one that is open are patches of one hull.
    """
    label = sheet_labels(mesh)
    if not label.any():
        return
    area = np.bincount(label, np.linalg.norm(mesh.area_vectors(), axis=1))
    main = int(area.argmax())
    size = np.ptp(_extents(mesh, label == main), axis=0)
    if size[0] < _LONG * np.ptp(mesh.xyz[:, 0]):
        return
    is_open = np.zeros(len(area), np.bool_)
    off = ~_in_centre(mesh, mesh.edges())
    keys, owner = mesh.edge_keys()[off], np.tile(label, 3)[off]
    pairs, count = np.unique(np.column_stack([keys, owner]), axis=0, return_counts=True)
    is_open[pairs[count != 2, 1]] = True
    for number in range(len(area)):
        if number == main or (is_open[main] and is_open[number]):
            continue
        long = np.ptp(_extents(mesh, label == number)[:, 0])
        if area[number] >= _CRUMB * area.sum() and long < _LONG * size[0]:
            yield label == number


def _lengths(mesh: Triangles, label: IntArray) -> FloatArray:
    """Give the extent in x of each part, m, by its number."""
    x = mesh.corners[:, :, 0]
    low = np.full(int(label.max()) + 1, np.inf)
    high = -low
    np.minimum.at(low, label, x.min(axis=1))
    np.maximum.at(high, label, x.max(axis=1))
    return np.asarray(high - low)


def _in_centre(mesh: Triangles, edge: IntArray) -> _BoolArray:
    """Tell which edges (e, 2) lie in the centre plane, where half a hull is open, (e,)."""
    slack = _ROUNDING * float(np.ptp(mesh.xyz[:, 0]))
    return np.asarray((np.abs(mesh.xyz[edge][:, :, 1]) <= slack).all(axis=1))


def _walls(mesh: Triangles) -> Iterator[_BoolArray]:
    """Give what rises out of a deck, each as a mask (f,): walls, and the roofs on them."""
    vectors = mesh.area_vectors()
    area = np.linalg.norm(vectors, axis=1)
    plan = float(np.prod(np.ptp(mesh.xyz[:, :2], axis=0)))
    up = np.flatnonzero(vectors[:, 2] > _LEVEL * area)
    if not len(up):
        return
    label = sheet_labels(mesh.part(up))
    large = np.bincount(label, area[up]) >= _DECK * plan
    level = np.full(len(area), -1)
    level[up] = np.where(large[label], label, -1)
    if (level < 0).all() or (level >= 0).all():
        return  # there is no deck, or nothing but decks
    rest = np.flatnonzero(level < 0)
    wall = np.full(len(area), -1)
    wall[rest] = sheet_labels(mesh.part(rest))
    long = _lengths(mesh.part(rest), wall[rest])
    meets = _neighbours_across(mesh, wall, level)
    at_rim = np.zeros(len(mesh.xyz), np.bool_)
    rim = boundary_edges(mesh)
    at_rim[rim[~_in_centre(mesh, rim)]] = True
    inner = [
        number
        for number in sorted({a for a, _ in meets})
        if long[number] < long.max()
        and _rises(mesh, wall == number, [level == b for a, b in meets if a == number])
        and not at_rim[mesh.face[wall == number]].any()
    ]
    for number in inner:
        yield wall == number
    # A roof that stands on nothing but such walls goes with them.
    for number in np.unique(level[level >= 0]).tolist():
        around = {a for a, b in meets if b == number}
        if around and around <= set(inner):
            yield level == number


def _rises(mesh: Triangles, wall: _BoolArray, level: list[_BoolArray]) -> bool:
    """Tell whether walls stand on one of the level parts that they meet, and hang from none.

    The sides of a hull that lies keel up hang from its bottom.
    """
    foot = min(float(_extents(mesh, each)[0, 2]) for each in level)
    slack = _ROUNDING * float(np.ptp(mesh.xyz[:, 0]))
    return float(_extents(mesh, wall)[0, 2]) >= foot - slack


def _neighbours_across(mesh: Triangles, wall: IntArray, level: IntArray) -> set[tuple[int, int]]:
    """Give which walls share an edge with which level parts."""
    keys, owner = mesh.edge_keys(), np.tile(np.arange(len(mesh.face)), 3)
    order = np.argsort(keys, kind="stable")
    keys, owner = keys[order], owner[order]
    same = np.flatnonzero(keys[1:] == keys[:-1])
    one, other = owner[same], owner[same + 1]
    found: set[tuple[int, int]] = set()
    for a, b in ((one, other), (other, one)):
        on = (wall[a] >= 0) & (level[b] >= 0)
        found |= set(zip(wall[a[on]].tolist(), level[b[on]].tolist(), strict=True))
    return found


def _tell(
    mesh: Triangles, placed: Triangles, left: _BoolArray, found: list[_BoolArray], book: Notebook
) -> None:
    """Tell what is left out, by whether it stands on the deck of the hull."""
    top = float(np.median(_tops(placed, ~left)))
    on_deck = [each for each in found if _extents(placed, each)[:, 2].mean() > top]
    below = [each for each in found if not any(each is other for other in on_deck)]
    if on_deck:
        what = f"{_places(mesh, on_deck)} on the deck left out: the hull ends at its deck"
        book.repair("superstructure", _WHERE, what, len(on_deck))
    if below:
        what = (
            f"{_places(mesh, below)} beside the hull left out, as a rudder, fin or keel; if it is "
            "of the hull, unite them where they were made"
        )
        book.suspect("appendage", _WHERE, what, len(below))


def _tops(mesh: Triangles, chosen: _BoolArray) -> FloatArray:
    """Give the greatest height in each of 40 parts of the length, m."""
    corner = mesh.xyz[mesh.face[chosen].ravel()]
    x = corner[:, 0]
    part = np.clip(40.0 * (x - x.min()) / np.ptp(x), 0, 39).astype(np.int64)
    top = np.full(40, -np.inf)
    np.maximum.at(top, part, corner[:, 2])
    return np.asarray(top[np.isfinite(top)])


def _places(mesh: Triangles, found: list[_BoolArray]) -> str:
    count = "a part" if len(found) == 1 else f"{len(found)} parts"
    told = []
    for each in sorted(found, key=lambda mask: -int(mask.sum()))[:_NAMED]:
        low, high = ("(" + ", ".join(f"{v:.4g}" for v in end) + ")" for end in _extents(mesh, each))
        told.append(f"from {low} to {high}")
    more = " and others" if len(found) > _NAMED else ""
    return f"{count} {'; '.join(told)}{more} m of the file"
