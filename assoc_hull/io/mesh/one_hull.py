"""One hull of a mesh that may hold several side by side: counted, refused or taken out.

The mesh is placed in ship axes first, as if it were one hull, and cut into sections, which tell how
many there are. The one that is meant is cut out of the mesh as the file has it, and placed anew; of
a mesh of one hull nothing is changed.
"""

from __future__ import annotations

from collections.abc import Callable

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.polylines.operations import self_crossings
from assoc_hull.geometry.surfaces.triangles import Triangles, sheet_labels
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
from assoc_hull.io.mesh.appendages import without_appendages
from assoc_hull.io.mesh.frame import AxisChange, half_side, mirror_error
from assoc_hull.io.mesh.repair import facet_depth, tell_parts
from assoc_hull.io.mesh.shell import cut_faces
from assoc_hull.io.reports import Notebook

__all__ = ["mesh_sections", "place_one_hull"]

_WHERE = "the mesh"

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
