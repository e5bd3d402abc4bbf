"""Which entities of an IGES file are surfaces, and untrimmed ones (128) where they belong, in m.

A face whose border is that of its surface counts as untrimmed. Whatever else bounds a face needs
OpenCASCADE, and the error says so.

Source: IGES 5.3 (US PRO, 1996), sections 4.24, 4.33 to 4.35 (141 to 144), 4.145 and 4.147 (508,
510).

Which entities of an IGES file are surfaces, what they belong to, and what cannot be read.

Examples
--------
>>> from assoc_hull.geometry.patches.spline_surface import SplineSurface
>>> from assoc_hull.io.iges.file import IgesFile
>>> from assoc_hull.io.iges.surfaces import surface_entities
>>> from assoc_hull.io.iges.write import iges_text
>>> plate = SplineSurface.bezier([[[0, 0, 0], [0, 1, 0]], [[2, 0, 0], [2, 1, 0]]], "plate")
>>> [part.surface for part in surface_entities(IgesFile.of_text(iges_text([plate]), "plate.igs"))]
[1]
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from itertools import chain

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.errors import BadInputError, NeedsCadError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.io.iges.entities import (
    IDENTITY,
    IgesSurface,
    Transformation,
    name_property,
    readable_name,
    scale_note,
    spline_curve,
    spline_surface,
    transformation_of,
    unit_of,
)
from assoc_hull.io.iges.file import DirectoryEntry, IgesFile, IgesRecord

__all__ = [
    "KINDS",
    "SILENT",
    "TRIMMED",
    "Box",
    "SurfaceEntity",
    "borders_of_face",
    "is_box",
    "parameter_curves",
    "surface_entities",
    "surfaces_of_iges",
    "unread_notes",
]

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


# --------------------------------------------------------------------------------------
# Is the border of a face that of its surface? A border is given as curves in the parameters of the
# surface. The control points of a spline enclose it, so a piece between two knots whose control
# points lie on one side of the box of the parameters lies there as well; and a border on the sides
# of the box that covers all four of them is the box. Nothing is sampled.

Box = tuple[tuple[float, float], tuple[float, float]]

_NEAR = 1e-6
"""Rounding of the file may move a point this far off a side, as a part of the box."""

_MOST = 10_000
_AGAIN = "export the file again"


def is_box(pieces: list[FloatArray], box: Box, points: NDArray[np.bool_] | None = None) -> bool:
    """Tell whether pieces of a closed border, (k, 2) control points each, are the sides of a box.

    `box` is the least and greatest u, and v. `points` (2, 2) says where the surface is a point
    along the side of least u, greatest u, least v, greatest v: a border need not contain such a
    side.
    """
    low, high = (np.array(ends) for ends in zip(*box, strict=True))
    covered = np.zeros((2, 2)) if points is None else points.astype(np.float64)
    for piece in pieces:
        place = (piece - low) / (high - low)
        on = (np.abs(place[:, :, None] - [0.0, 1.0]) < _NEAR).all(axis=0)
        if not (on.any() and (np.abs(place - 0.5) < 0.5 + _NEAR).all()):
            return False
        # A piece on a side of u covers a part of v, and the other way round.
        covered += on * np.abs(place[-1] - place[0])[::-1, None]
    return bool((covered > 1.0 - 10.0 * _NEAR).all())


def parameter_curves(file: IgesFile, number: int, met: tuple[int, ...] = ()) -> list[FloatArray]:
    """Give a curve in the parameters of a surface in pieces, as control points (k, 2) of each.

    It is a line (110), polyline (106), spline (126), or a chain of such (102); empty if another
    kind. `met` are the chains that it is a part of.

    Raises
    ------
    BadInputError
        A damaged curve, or a chain that is a part of itself.
    """
    record = file.record(number)
    if number in met or len(met) > 20:
        raise BadInputError("chains of curves run in a ring", record.where, _AGAIN)
    entry = file.entries[number]
    if entry.kind == 102:
        count = record.count(1, "the number of curves", _MOST)
        parts = record.pointers(2, count, "the curves")
        found: list[FloatArray] = []
        for each in parts:
            more = parameter_curves(file, each, (*met, number))
            if not more:
                return []
            found += more
            if len(found) > _MOST:  # chains of chains grow without end, and no border has so many
                what = f"a border has more than {_MOST} pieces"
                raise BadInputError(what, record.where, _AGAIN)
        return found
    pieces = _pieces(record, entry.kind, entry.form)
    motion = transformation_of(file, entry.transformation)
    return [motion.of(piece)[:, :2] for piece in pieces]


def _pieces(record: IgesRecord, kind: int, form: int) -> list[FloatArray]:
    """Give the pieces (k, 3) of one curve; none if its kind does not tell them."""
    if kind == 110:
        return [record.reals(1, 6, "the line").reshape(2, 3)]
    if kind == 106 and form in (1, 2, 11, 12, 63):
        return _legs(_polyline(record))
    if kind != 126:
        return []
    curve = spline_curve(record)
    d, knots = curve.degree, curve.knots
    first, last = curve.span
    held = [
        i for i in range(d, len(curve.points))
        if knots[i] < knots[i + 1] and knots[i + 1] > first and knots[i] < last
    ]  # fmt: skip
    return [curve.points[i - d : i + 1] for i in held]


def _polyline(record: IgesRecord) -> FloatArray:
    """Give the points (k, 3) of an entity 106: pairs at one height, or triples."""
    kind = record.count(1, "the kind of points", 2)
    count = record.count(2, "the number of points", _MOST)
    if kind == 2:
        return record.reals(3, 3 * count, "the points").reshape(count, 3)
    flat = record.reals(4, 2 * count, "the points").reshape(count, 2)
    return np.column_stack([flat, np.zeros(count)])


def _legs(points: FloatArray) -> list[FloatArray]:
    return [points[i : i + 2] for i in range(len(points) - 1)]


def borders_of_face(file: IgesFile, number: int) -> list[list[int]] | None:
    """Give the borders of a face (144, 143, 510), each as numbers of curves in surface parameters.

    None: the border is said to be that of the surface. Curves that are missing are 0.

    Raises
    ------
    BadInputError
        A damaged entity.
    """
    record = file.record(number)
    match file.entries[number].kind:
        case 144:
            return _of_trimmed(file, record)
        case 143:
            count = record.count(3, "the number of borders", _MOST)
            return [_of_boundary(file, each) for each in record.pointers(4, count, "the borders")]
        case _:
            count = record.count(2, "the number of borders", _MOST)
            return [_of_loop(file, each) for each in record.pointers(4, count, "the borders")]


def _of_trimmed(file: IgesFile, record: IgesRecord) -> list[list[int]] | None:
    """Give the borders of a trimmed surface: curves on it, entities 142."""
    outer = record.whole(2, "the flag of the border", default=0)
    count = record.count(3, "the number of holes", _MOST)
    inner = record.pointers(5, count, "the holes")
    if not outer and not count:
        return None
    ring = record.pointers(4, 1, "the border") if outer else ()
    return [[*file.record(each).pointers(3, 1, "the curve")] for each in (*ring, *inner)]


def _of_boundary(file: IgesFile, number: int) -> list[int]:
    """Give the curves of a boundary, entity 141."""
    record = file.record(number)
    count, at = record.count(4, "the number of curves", _MOST), 5
    found: list[int] = []
    for _ in range(count):
        more = record.count(at + 2, "the number of parameter curves", _MOST)
        found += record.pointers(at + 3, more, "the curves") or (0,)
        at += 3 + more
    return found


def _of_loop(file: IgesFile, number: int) -> list[int]:
    """Give the curves of a loop, entity 508: of each edge one or some, each after a flag."""
    record = file.record(number)
    count, at = record.count(1, "the number of edges", _MOST), 2
    found: list[int] = []
    for _ in range(count):
        more = record.count(at + 4, "the number of parameter curves", _MOST)
        found += record.pointers(at + 5, 2 * more, "the curves")[1::2] or (0,)
        at += 5 + 2 * more
    return found


# --------------------------------------------------------------------------------------
# The surfaces.

Found = tuple[list[SplineSurface], str, tuple[str, ...]]


def surfaces_of_iges(text: str, source: str, unit: str | None = None) -> Found:
    """Read the spline surfaces of an IGES file, m, in its order; its unit; notes.

    `unit` is that of its lengths; None: as the file says. Notes say what was left out or done.

    Raises
    ------
    BadInputError
        The file is damaged, tells no unit, holds no spline surface or surfaces of other kinds, or
        a surface is trimmed.
    """
    file = IgesFile.of_text(text, source)
    name, metres, notes = unit_of(file, unit)
    parts = surface_entities(file)
    shown = [part for part in parts if not part.hidden]
    if not shown:
        raise _nothing(file, parts)
    records = [file.record(part.surface) for part in shown]
    data = [spline_surface(record) for record in records]
    for part, each in zip(shown, data, strict=True):
        _require_untrimmed(file, part, each)
    motions = [_motion(file, part) for part in shown]
    properties = [
        name_property(file, record, each.after) for record, each in zip(records, data, strict=True)
    ]
    names = _names(file, shown, properties)
    found = [
        _surface(each, motion, metres, called)
        for each, motion, called in zip(data, motions, names, strict=True)
    ]
    more = (*scale_note(file), *unread_notes(file, parts), *_stretch_notes(file, shown, motions))
    return found, name, (*notes, *more)


def _nothing(file: IgesFile, parts: list[SurfaceEntity]) -> BadInputError:
    """Give the error for a file without surfaces to see."""
    notes = " ".join(unread_notes(file, parts))
    what = "there is no spline surface (128)" if not parts else "all surfaces are blanked"
    return BadInputError(what, f"in {file.source}", f"export the surfaces. {notes}".strip())


def _require_untrimmed(file: IgesFile, part: SurfaceEntity, data: IgesSurface) -> None:
    """Refuse a face that is not all of its surface."""
    borders = borders_of_face(file, part.face) if part.face else None
    if borders is None:
        return
    entry = file.entries[part.face]
    curves = list(chain.from_iterable(borders))
    if not all(curves):
        what = "its border is not given in the parameters of the surface"
    elif len(borders) > 1:
        what = f"it has {len(borders) - 1} holes"
    else:
        found = [parameter_curves(file, each) for each in curves]
        if all(found) and is_box(list(chain.from_iterable(found)), data.spans, data.points):
            return
        what = "its border is not that of the whole surface"
    raise NeedsCadError(
        f"this surface is trimmed: {what}", file.where(entry),
        "export the surface untrimmed; hulls of trimmed ones are read with the extra 'cad'",
    )  # fmt: skip


def _motion(file: IgesFile, part: SurfaceEntity) -> Transformation:
    """Give where a surface goes: moved by itself and with what it is a part of.

    An entity that is not dependent stands by itself: the chain ends there.
    """
    found = IDENTITY
    for number in part.chain:
        found = found.then(transformation_of(file, file.entries[number].transformation))
        if not file.entries[number].dependent:
            break
    return found


def _stretch_notes(
    file: IgesFile, parts: list[SurfaceEntity], motions: list[Transformation]
) -> tuple[str, ...]:
    return tuple(
        f"{file.source}: the transformation of D{part.surface} stretches by up to "
        f"{100.0 * motion.stretch:.3g} %, where only turns are usual."
        for part, motion in zip(parts, motions, strict=True)
        if motion.stretch
    )


def _surface(data: IgesSurface, motion: Transformation, metres: float, name: str) -> SplineSurface:
    net = motion.of(data.net)
    if metres != 1.0:
        net = net * metres
    found = SplineSurface(name, data.degrees, *data.knots, net, data.weights)
    return found if found.domain == data.spans else found.restricted(*data.spans)


def _names(file: IgesFile, parts: list[SurfaceEntity], properties: list[str]) -> list[str]:
    """Give each surface its name in the file, or a number; none comes twice."""
    found: dict[str, None] = {}
    count: Counter[str] = Counter()
    for place, (part, owned) in enumerate(zip(parts, properties, strict=True), start=1):
        labels = [file.entries[number].label for number in reversed(part.chain[:2])]
        told = (readable_name(word) for word in (owned, *labels))
        first = name = next((word for word in told if word), f"surface {place}")
        while name in found:
            count[first] += 1
            name = f"{first} ({count[first] + 1})"
        found[name] = None
    return list(found)
