"""Which entities of an IGES file are surfaces, what they belong to, and what cannot be read.

Examples
--------
>>> from assoc_hull.geometry.patches.spline_surface import SplineSurface
>>> from assoc_hull.io.iges.file import IgesFile
>>> from assoc_hull.io.iges.surface_entities import surface_entities
>>> from assoc_hull.io.iges.write import iges_text
>>> plate = SplineSurface.bezier([[[0, 0, 0], [0, 1, 0]], [[2, 0, 0], [2, 1, 0]]], "plate")
>>> [part.surface for part in surface_entities(IgesFile.of_text(iges_text([plate]), "plate.igs"))]
[1]
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable

import attrs

from assoc_hull.errors import BadInputError, NeedsCadError
from assoc_hull.io.iges.file import DirectoryEntry, IgesFile

__all__ = ["KINDS", "SILENT", "TRIMMED", "SurfaceEntity", "surface_entities", "unread_notes"]

SPLINE, TRIMMED = 128, (143, 144, 510)
_SHELLS = (514, 186)
_HOLDS_SURFACES = {SPLINE, *TRIMMED, *_SHELLS}

KINDS = {
    100: "circular arc", 102: "chain of curves", 104: "conic", 106: "polyline", 108: "plane",
    110: "line", 112: "parametric spline curve", 114: "parametric spline surface", 116: "point",
    118: "ruled surface", 120: "surface of revolution", 122: "tabulated cylinder",
    123: "direction", 126: "spline curve", 128: "spline surface", 130: "offset curve",
    140: "offset surface", 143: "bounded surface", 144: "trimmed surface",
    186: "solid with a border of faces", 190: "plane surface", 192: "cylinder", 194: "cone",
    196: "sphere", 198: "torus", 308: "subfigure", 408: "copy of a subfigure",
    430: "copy of a solid", 510: "face", 514: "shell of faces",
}  # fmt: skip
"""Names of the commoner entities."""

_OTHER_SURFACES = frozenset({114, 118, 120, 122, 140, 190, 192, 194, 196, 198, 430})
_SOLIDS = frozenset(range(150, 185)) - {182, 184}
SILENT = frozenset({0, 124, 314, 402, 404, 406, 410, 416})
"""Nothing to see: transformations, colours, groups, drawings, views, properties."""


@attrs.frozen
class SurfaceEntity:
    """A surface, and the face that it belongs to.

    Attributes
    ----------
    surface : int
        Number of the entity 128.
    face : int
        Number of the trimmed or bounded surface or the face; 0 if it stands alone.
    chain : tuple of int
        The surface and what it belongs to, from the inside out.
    hidden : bool
        Whether it is blanked, or what it belongs to.
    """

    surface: int
    face: int
    chain: tuple[int, ...]
    hidden: bool


def surface_entities(file: IgesFile) -> list[SurfaceEntity]:
    """Find the surfaces, in the order of the file.

    Raises
    ------
    BadInputError
        There are surfaces of another kind that are not hidden; a face of something else.
    """
    owners = _owners(file)
    _require_known(file)
    found = [_part(file, entry, owners) for entry in file.entries.values()]
    return [part for part in found if part is not None]


def _owners(file: IgesFile) -> dict[int, list[int]]:
    """Tell of surfaces, faces and shells which entities they are a part of."""
    found: dict[int, list[int]] = {}
    for entry in file.entries.values():
        for child in _children(file, entry):
            found.setdefault(child, []).append(entry.number)
    return found


def _children(file: IgesFile, entry: DirectoryEntry) -> Iterable[int]:
    """Give the surfaces, faces or shells that an entity is made of."""
    if entry.kind not in (*TRIMMED, *_SHELLS):
        return ()
    record = file.record(entry.number)
    match entry.kind:
        case 514:
            count = record.count(1, "the number of faces", len(file.entries))
            return record.pointers(2, 2 * count, "the faces")[::2]
        case 186:
            count = record.count(3, "the number of holes", len(file.entries))
            holes = record.pointers(4, 2 * count, "the holes")[::2]
            return (*record.pointers(1, 1, "the shell"), *holes)
        case 143:
            return record.pointers(2, 1, "the surface")
        case _:
            return record.pointers(1, 1, "the surface")


def _require_known(file: IgesFile) -> None:
    """Refuse surfaces of other kinds: nothing of a hull may be lost unseen."""
    for entry in file.entries.values():
        bounded = entry.kind == 108 and entry.form != 0
        other = entry.kind in _OTHER_SURFACES or entry.kind in _SOLIDS or bounded
        if other and not entry.blanked:
            name = KINDS.get(entry.kind, "solid")
            what = f"this is a {name}, and only spline surfaces (128) are read"
            raise NeedsCadError(
                what, file.where(entry),
                "convert it to a spline surface, or blank it; hulls are read with the extra 'cad'",
            )  # fmt: skip
        if entry.kind in (308, 320):
            _require_no_surfaces(file, entry)


def _require_no_surfaces(file: IgesFile, entry: DirectoryEntry) -> None:
    """Refuse a subfigure with surfaces: its copies may stand at many places."""
    record = file.record(entry.number)
    count = record.count(3, "the number of members", len(file.entries))
    members = record.pointers(4, count, "the members")
    if any(file.entries[each].kind in _HOLDS_SURFACES for each in members if each in file.entries):
        what = "this subfigure holds surfaces, and copies of subfigures are not read"
        raise NeedsCadError(what, record.where, "explode it to single surfaces")


def _part(
    file: IgesFile, entry: DirectoryEntry, owners: dict[int, list[int]]
) -> SurfaceEntity | None:
    """Give the surface of a face, or one that stands alone."""
    if entry.kind == SPLINE and entry.number not in owners:
        return SurfaceEntity(entry.number, 0, (entry.number,), entry.blanked)
    if entry.kind not in TRIMMED:
        return None
    (surface,) = _children(file, entry)
    if surface not in file.entries or file.entries[surface].kind != SPLINE:
        what = f"its surface, D{surface}, is no spline surface (128)"
        raise NeedsCadError(what, file.where(entry), "convert it to a spline surface")
    chain = (surface, *_upward(file, entry.number, owners))
    hidden = any(file.entries[each].blanked for each in chain[1:])
    return SurfaceEntity(surface, entry.number, chain, hidden)


def _upward(file: IgesFile, number: int, owners: dict[int, list[int]]) -> tuple[int, ...]:
    """Give an entity and what it belongs to, from the inside out."""
    found = [number]
    while number in owners:
        number = owners[number][0]
        if number in found:
            where = f"in {file.source}, at D{number}"
            raise BadInputError("faces are parts of themselves", where, "export the file again")
        found.append(number)
    return tuple(found)


def unread_notes(file: IgesFile, parts: list[SurfaceEntity]) -> tuple[str, ...]:
    """Tell what of a file is not read: entities that are no surfaces, hidden surfaces."""
    taken = {number for part in parts for number in part.chain}
    count = Counter(
        entry.kind for entry in file.entries.values()
        if entry.number not in taken and not entry.dependent and entry.kind not in SILENT
    )  # fmt: skip
    notes = []
    if count:
        words = ", ".join(
            f"{many} of type {kind}{f' ({KINDS[kind]})' if kind in KINDS else ''}"
            for kind, many in sorted(count.items())
        )
        notes.append(f"Of {file.source} only surfaces are read; left out are {words}.")
    hidden = sum(part.hidden for part in parts)
    if hidden:
        notes.append(f"{hidden} of {len(parts)} surfaces are blanked in the file and left out.")
    return tuple(notes)
