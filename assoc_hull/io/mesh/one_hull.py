"""One hull out of a mesh: which half, which parts are appendages, what is left beside it.

The mesh is placed in ship axes first, as if it were one hull, and cut into sections, which tell how
many there are. The one that is meant is cut out of the mesh as the file has it, and placed anew; of
a mesh of one hull nothing is changed.

What stands on the deck or hangs from a hull and is none of it: told, and left out.

A deck house, a rudder or a fin is a closed part beside a closed hull, or walls that rise out of the
deck: without its level faces they hang together with nothing. Where a house ends at the ship's side
its walls are those of the hull, as of a raised deck, and stay.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.polylines.operations import self_crossings
from assoc_hull.geometry.surfaces.triangles import Triangles, boundary_edges, sheet_labels
from assoc_hull.io.lines.several_hulls import (
    FoundHulls,
    HullChoice,
    Section,
    find_hulls,
    largest_difference,
    refuse_asymmetric,
    refuse_missing,
    refuse_several,
    sections_within,
    tell_which,
    top_below_bridge,
    water_levels,
)
from assoc_hull.io.mesh.frame import AxisChange, half_side, mirror_error
from assoc_hull.io.mesh.repair import facet_depth, tell_branches, tell_parts
from assoc_hull.io.mesh.shell import cut_faces
from assoc_hull.io.reports import Notebook

__all__ = ["mesh_sections", "place_one_hull", "without_appendages"]

_WHERE = "the mesh"
_BoolArray = NDArray[np.bool_]

_LONG = 0.75
"""The hull reaches over this part of the length of all, or it is in several pieces itself; a part
that reaches over as much of the hull is another hull."""

_LEVEL, _DECK = 0.9, 0.05
"""Faces whose normal is steeper are level; in parts of this share of the plan they are a deck."""

_ROUNDING_OF_PARTS = 1e-6
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
    slack = _ROUNDING_OF_PARTS * float(np.ptp(mesh.xyz[:, 0]))
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
    slack = _ROUNDING_OF_PARTS * float(np.ptp(mesh.xyz[:, 0]))
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


_SECTIONS = 60
"""Sections between the ends that tell how many hulls there are."""

_ROUNDING = 1e-4
"""Halves that differ by this part of the length differ by the rounding of their files."""

_DECIMALS = 6
"""Of a metre, in a centre plane that is told."""

Place = Callable[[Triangles, Notebook], Triangles]


def place_one_hull(
    mesh: Triangles,
    place: Place,
    choice: HullChoice,
    factor: float,
    book: Notebook,
    *,
    turned: bool = False,
) -> tuple[Triangles, Triangles]:
    """Give the mesh of one hull in axes of the file, m, and placed in ship axes.

    `place` does the latter; `factor` is m at full scale over the unit of the file; `turned` says
    that its axes were given and not found.

    Raises
    ------
    BadInputError
        Several hulls and none is chosen; a chosen one that is not symmetric about its centre
        plane, or from which the bridge deck is not cut off.
    """
    notes = Notebook()
    placed = place(mesh, notes)
    motion = AxisChange.between(mesh.xyz, placed.xyz)
    if turned:
        _refuse_across(placed)
        _refuse_on_side(mesh, motion)
    sections = mesh_sections(placed)
    low, high = float(placed.xyz[:, 2].min()), float(placed.xyz[:, 2].max())
    found = find_hulls(sections, water_levels(low, high, choice), oriented=True)
    centre = choice.place(factor)
    if centre is None:
        if found.count > 1:
            _refuse_crossing(placed, motion, factor)
        refuse_several(found, f"{_in_file(motion, found.centre, factor):.7g}", low, f"in {_WHERE}")
        bare = without_appendages(
            mesh, placed, place, book, turned="upside down" in notes.report().kinds("repairs")
        )
        if bare is not None:
            mesh, placed, notes = bare
            sections = mesh_sections(placed)
        _refuse_found_centre(mesh, placed, sections, notes, factor)
        for mine, theirs in zip(attrs.astuple(book, recurse=False),
                                attrs.astuple(notes, recurse=False), strict=True):  # fmt: skip
            mine += theirs
        return mesh, placed
    picked = _picked(mesh, placed, motion, sections, found, centre, factor, choice, book)
    return picked, place(picked, book)


def _refuse_found_centre(
    mesh: Triangles, placed: Triangles, sections: list[Section], notes: Notebook, factor: float
) -> None:
    """Hold a centre plane halfway between the sides to the test of one that was given.

    Where the sides differ the keel tells the centre plane, and it is that which is named.
    """
    report = notes.report()
    whole = any(
        each.kind == "half or whole" and "whole" in each.what for each in report.assumptions
    )
    noise = max(2.0 * facet_depth(placed), _ROUNDING * float(np.ptp(placed.xyz, axis=0).max()))
    worst = largest_difference(sections, 0.0, np.inf)
    if "centre plane" not in report.kinds("repairs") or not whole or worst.amount <= noise:
        return
    if any(len(self_crossings(cut[:, 0], cut[:, 1])) for _, cut in sections):
        return  # a fold is told by itself, and no side is right there
    keel = float(np.median([_lowest(part) for _, part in sections]))
    worst = largest_difference(sections, keel, np.inf)
    motion = AxisChange.between(mesh.xyz, placed.xyz)
    column, _, _ = _axis_in_file(motion)
    centre = round(_in_file(motion, keel, 1.0), _DECIMALS) / factor + 0.0
    if worst.amount <= noise:
        raise BadInputError(
            f"halfway between its sides the hull is not symmetric, but about {'xyz'[column]} = "
            f"{centre:.7g} of the file, where the keel lies", f"in {_WHERE}",
            f"give centre={centre:.7g}, and look for what stands out at one side",
        )  # fmt: skip
    place = motion.back(np.array([[worst.x, keel, worst.z]]))[0] / factor
    at = ", ".join(f"{'xyz'[i]} = {place[i]:.4g}" for i in range(3) if i != column)
    raise BadInputError(
        f"the sides of the hull differ by up to {1e3 * worst.amount:.4g} mm, at {at} of the file, "
        f"about {'xyz'[column]} = {centre:.7g}, where the keel lies", f"in {_WHERE}",
        "export the half that is right, alone, or mend the other; if the keel lies elsewhere give "
        "its place as centre=",
    )  # fmt: skip


def _lowest(part: FloatArray) -> float:
    """Give y of the lowest place of a section, of a flat bottom its middle."""
    y, z = part.reshape(-1, 2).T
    low = y[z <= z.min() + 1e-6 * np.ptp(z)]
    return 0.5 * float(low.min() + low.max())


def _refuse_crossing(placed: Triangles, motion: AxisChange, factor: float) -> None:
    """Refuse a sheet that passes through itself: where it does, sections look like several hulls.

    Two hulls are two sheets, which may well pass through one another.
    """
    sheet = sheet_labels(placed)
    for number in np.unique(sheet).tolist():
        found = [
            (x, place)
            for x, cut in mesh_sections(placed.part(sheet == number))
            for place in self_crossings(cut[:, 0], cut[:, 1])[:1]
        ]
        if not found:
            continue
        at, (y, z) = found[len(found) // 2]
        place = motion.back(np.array([[at, y, z]]))[0] / factor
        words = ", ".join(f"{letter} = {v:.4g}" for letter, v in zip("xyz", place, strict=True))
        raise BadInputError(
            f"the surface crosses itself in {len(found)} of {_SECTIONS} sections, as at {words} of "
            "the file", f"in {_WHERE}",
            "mend the fold there, or unite its parts where it was made; if it is several hulls "
            "give the centre= of one",
        )  # fmt: skip


def mesh_sections(mesh: Triangles) -> list[Section]:
    """Cut a mesh in ship axes into sections of straight pieces, not chained.

    Each runs with the outside to its right where y points to the right and z up.
    """
    x = mesh.xyz[:, 0]
    edges = np.linspace(float(x.min()), float(x.max()), _SECTIONS + 1)
    corner = x[mesh.face]
    low, high = corner.min(axis=1), corner.max(axis=1)
    outward = mesh.area_vectors()
    found: list[Section] = []
    for at in (0.5 * (edges[1:] + edges[:-1])).tolist():
        rows = np.flatnonzero((low < at) & (high >= at))
        face = mesh.face[rows]
        above = x[face] >= at
        lone = np.argmax(above != (above.sum(axis=1) > 1)[:, None], axis=1)
        a, b, c = (face[np.arange(len(face)), (lone + i) % 3] for i in range(3))
        ends = []
        for other in (b, c):
            share = ((at - x[a]) / (x[other] - x[a]))[:, None]
            ends.append(mesh.xyz[a, 1:] + share * (mesh.xyz[other, 1:] - mesh.xyz[a, 1:]))
        if len(face):
            part = np.stack(ends, axis=1)
            (y, z), normal = (part[:, 1] - part[:, 0]).T, outward[rows]
            back = normal[:, 1] * z - normal[:, 2] * y < 0.0
            part[back] = part[back, ::-1]
            found.append((at, part))
    return found


def _axis_in_file(motion: AxisChange) -> tuple[int, float, float]:
    """Give column, sign and shift: y of the ship is sign * column of the file + shift, m."""
    column = int(np.abs(motion.turn[:, 1]).argmax())
    return column, float(motion.turn[column, 1]), float(motion.shift[1])


def _in_file(motion: AxisChange, y: float, factor: float) -> float:
    """Give where y of the ship (m) lies in the file, in its unit."""
    _, sign, shift = _axis_in_file(motion)
    return sign * (y - shift) / factor + 0.0


def _picked(
    mesh: Triangles,
    placed: Triangles,
    motion: AxisChange,
    sections: list[Section],
    found: FoundHulls,
    centre: float,
    factor: float,
    choice: HullChoice,
    book: Notebook,
) -> Triangles:
    """Cut the hull at a centre plane (m, in the file) out of a mesh."""
    _, sign, shift = _axis_in_file(motion)
    middle = sign * centre + shift
    low = float(placed.xyz[:, 2].min())
    limits = found.limits(middle)
    top = top_below_bridge(found, low, choice, _WHERE, book)
    part = _clipped(mesh, placed, motion, 2, top, -1.0)
    for bound, side in zip(limits, (1.0, -1.0), strict=True):
        _refuse_bridge(part, bound, low, top)
        part = _clipped(*part, motion, 1, bound, side)
    picked, there = part
    if not len(picked.face):
        refuse_missing(centre / factor, _in_file(motion, found.centre, factor), _WHERE)
    half = half_side(there, 1)
    if half is None:
        size = float(np.ptp(mesh.xyz, axis=0).max())
        noise = max(2.0 * facet_depth(there), _ROUNDING * size)
        scale = (sign / factor, -sign * shift / factor)
        refuse_asymmetric(
            sections_within(sections, limits), middle, top, noise, scale, f"in {_WHERE}"
        )
    elif abs(half - middle) > _ROUNDING * float(np.ptp(mesh.xyz, axis=0).max()):
        raise BadInputError(
            f"half a hull is cut at {_in_file(motion, half, factor):.7g}, not at its centre="
            f"{centre / factor:.7g}", f"in {_WHERE}", "leave centre out, or give that place",
        )  # fmt: skip
    tell_which(found, centre / factor, centre, _WHERE, book)
    if found.count > 1:
        # What was told of parts that touch nowhere held for all hulls together.
        book.suspicions[:] = [note for note in book.suspicions if note.kind != "parts"]
        tell_parts(picked, book)
    return picked


def _refuse_bridge(part: tuple[Triangles, Triangles], bound: float, low: float, top: float) -> None:
    """Refuse a bridge deck that hangs lower than where it is cut off."""
    _, there = part
    y = there.corners[:, :, 1]
    across = (y.min(axis=1) < bound) & (y.max(axis=1) > bound)
    if not across.any():
        return
    height = float(there.corners[across][:, :, 2].min()) - low
    remedy = f"give depth={height:.4g} or less"
    if height < 0.2 * (top - low):
        remedy = "this is one hull with a long tunnel, or centre= is that of the ship"
    raise BadInputError(
        f"the bridge deck hangs down to {height:.4g} m, and depth is {top - low:.4g} m",
        f"in {_WHERE}", remedy,
    )  # fmt: skip


def _clipped(
    mesh: Triangles, placed: Triangles, motion: AxisChange, axis: int, bound: float, side: float
) -> tuple[Triangles, Triangles]:
    """Keep what lies on one side of a plane of the ship, as in the file and placed.

    Vertices that stay keep their bits; those of the cut are carried back.
    """
    if not np.isfinite(bound):
        return mesh, placed
    off = side * (placed.xyz[:, axis] - bound)
    off[np.abs(off) < 1e-9 * float(np.ptp(placed.xyz, axis=0).max())] = 0.0
    sign = np.sign(off)[placed.face]
    whole = (sign >= 0).all(axis=1) & (sign > 0).any(axis=1)
    across = (sign > 0).any(axis=1) & (sign < 0).any(axis=1)
    # `cut_faces` cuts at y = 0: the distance from the plane stands there.
    others = [each for each in range(3) if each != axis]
    turned = np.column_stack([placed.xyz[:, others[0]], off, placed.xyz[:, others[1]]])
    cut, extra, parent = cut_faces(turned, placed.face[across])
    new = np.empty_like(extra)
    new[:, others[0]], new[:, others[1]], new[:, axis] = extra[:, 0], extra[:, 2], bound
    face = np.concatenate([placed.face[whole], cut])
    origin = placed.origin
    if origin is not None:
        origin = np.concatenate([origin[whole], origin[across][parent]])
    used, number = np.unique(face, return_inverse=True)
    number = number.reshape(-1, 3)
    in_file = np.concatenate([mesh.xyz, motion.back(new)])[used]
    # Where axes are mirrored, triangles run the other way round in the file.
    run = number if np.linalg.det(motion.turn) > 0.0 else number[:, ::-1].copy()
    there = Triangles(np.concatenate([placed.xyz, new])[used], number.copy(), origin)
    return Triangles(in_file, run, origin), there


def _refuse_across(placed: Triangles) -> None:
    """Refuse axes by which the hull is longer across or upward than forward."""
    long, broad, tall = np.ptp(placed.xyz, axis=0).tolist()
    if long < max(broad, tall):
        raise BadInputError(
            f"as axes= has it the hull is {long:.4g} m long, {broad:.4g} m broad and {tall:.4g} m "
            "tall", f"in {_WHERE}", "leave axes= out, or give axes= with the longest side first",
        )  # fmt: skip


def _refuse_on_side(mesh: Triangles, motion: AxisChange) -> None:
    """Refuse a hull that lies on its side as its axes were given."""
    across, up = (int(np.abs(motion.turn[:, axis]).argmax()) for axis in (1, 2))
    size = np.ptp(mesh.xyz, axis=0)
    side = half_side(mesh, across)
    middle = 0.5 * float(mesh.xyz[:, up].min() + mesh.xyz[:, up].max())
    # Half of a hull that is alike above and below mirrors in its height, too.
    half = side is not None and not (abs(side) > 1e-3 * size.max() > abs(middle))
    off = {axis: mirror_error(mesh, axis) * size.max() / size[axis] for axis in (across, up)}
    if half or off[across] <= 0.02 or off[up] > 0.02:
        return
    letters = "xyz"[up], "xyz"[across]
    raise BadInputError(
        f"the hull lies on its side: it mirrors along {letters[0]}, not along {letters[1]}",
        f"in {_WHERE}", "leave axes= out, or exchange the two",
    )  # fmt: skip
