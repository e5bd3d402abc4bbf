r"""The polylines and splines of a DXF drawing as digitised pieces; what else it draws is told.

Examples
--------
>>> from assoc_hull.io.digitised.dxf import parse_dxf
>>> from assoc_hull.io.reports import Notebook
>>> rows = "0 SECTION 2 ENTITIES 0 LINE 8 WL_1 10 0 20 2 30 1 11 9 21 0 31 1 0 EOF".split()
>>> (piece,) = parse_dxf("\n".join(rows), "text", Notebook()).pieces
>>> piece.line, piece.points.tolist()
('WL_1', [[0.0, 2.0, 1.0], [9.0, 0.0, 1.0]])
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.io.dxf.entities import (
    DrawingEntity,
    RawCurve,
    RawSpline,
    drawing_entities,
    drawing_unit,
    drawn_spline,
)
from assoc_hull.io.dxf.read_lines_plan import names_of, plan_curves
from assoc_hull.io.lines.raw_lines import RawLines, boundary_name, read_number
from assoc_hull.io.reports import Notebook

__all__ = ["drawn_curves", "parse_dxf", "tell_oddities"]

_AXES = {10: 0, 20: 1, 30: 2}
_CURVED = ("ARC", "CIRCLE", "ELLIPSE", "HELIX", "MLINE", "INSERT")
_CLOSED, _CONTROL, _MESH = 1, 16, 16 | 64
_EXPLODE = "explode it to polylines in the drawing program and read it again"
_MEANINGS = {
    "curve": "is no polyline and left out",
    "fit points": "has no control points, which its curve needs, and is left out",
    "mesh": "is a mesh and left out",
    "bulge": "has arcs between its points, read as straight",
    "extrusion": "stands in coordinates of its own (extrusion), read as if in those of the ship",
}

_CHORD = 1e-6
"""Points of a spline are this close, as a part of the drawing's size: .3 mm on 300 m."""


def parse_dxf(text: str, source: str, book: Notebook) -> RawLines:
    """Read SPLINE, POLYLINE, LWPOLYLINE and LINE entities of an ASCII DXF.

    Parameters
    ----------
    text : str
        The drawing. An entity belongs to the line that its extended data name, as in drawings of
        ours; else its layer names its line. Of a lines plan of ours the views are put together.
    source : str
        Name of the file, for messages.
    book : Notebook
        Takes what the drawing holds and polylines do not.

    Returns
    -------
    RawLines
        With the unit of the header.

    Raises
    ------
    BadInputError
        A group code or a coordinate that is none, or a spline that is none.
    """
    entities = drawing_entities(text, source)
    drawn = drawn_curves(entities)
    tell_oddities(entities, book)
    found = [
        attrs.evolve(curve, line=name)
        for name, family, curve in plan_curves(drawn, book) or _curves(drawn)
        if not _has_no_place(name, family)
    ]
    _tell_left_out([names_of(entity) for entity, _ in drawn], book)
    chord = _CHORD * _size(found)
    return RawLines([each.piece(chord) for each in found], drawing_unit(entities), told=False)


def drawn_curves(entities: list[DrawingEntity]) -> list[tuple[DrawingEntity, RawCurve]]:
    """Give what entities draw as lines; raises as `parse_dxf`."""
    return [
        (each, RawCurve("", each.where, shape))
        for i, each in enumerate(entities)
        if (shape := _shape(each, entities, i)) is not None
    ]


def _tell_left_out(named: list[tuple[str, str]], book: Notebook) -> None:
    """Tell of lines of ours that digitised lines have not, by family."""
    left: dict[str, dict[str, None]] = {}
    for name, family in named:
        if _has_no_place(name, family):
            left.setdefault(family, {})[name] = None
    for family, names in left.items():
        what = f"{', '.join(names)}: left out, its like is found anew or cut again"
        book.suspect("lines", family, what, len(names))


def _curves(drawn: list[tuple[DrawingEntity, RawCurve]]) -> list[tuple[str, str, RawCurve]]:
    """Give name and family of curves in space: as a drawing of ours tells them, or by the layer."""
    found = []
    for entity, curve in drawn:
        name, family = names_of(entity)
        found.append((name or entity.word(8), family, curve))
    return found


def tell_oddities(
    entities: list[DrawingEntity], book: Notebook, without: tuple[str, ...] = ()
) -> None:
    """Suspect what entities draw that polylines do not show, but for some kinds of it."""
    odd: dict[tuple[str, str], list[str]] = {}
    for each in entities:
        for kind in [kind for kind in _oddities(each) if kind not in without]:
            owner = "POLYLINE" if each.kind == "VERTEX" else each.kind
            odd.setdefault((kind, owner), []).append(each.where)
    for (kind, owner), places in odd.items():
        count = f"{owner} {_MEANINGS[kind]}; {len(places)} such, the first at {places[0]}"
        book.suspect(kind, "the drawing", f"{count}: {_EXPLODE}", len(places))


def _size(curves: list[RawCurve]) -> float:
    every = np.concatenate([np.zeros((0, 3)), *(each.corners for each in curves)])
    return float(np.ptp(every, axis=0).max()) if len(every) else 0.0


def _has_no_place(name: str, family: str) -> bool:
    """Whether a line of ours is of a kind that digitised lines have not: its like is found anew."""
    return family == "diagonals" or (family == "boundary" and boundary_name(name) is None)


def _flags(entity: DrawingEntity) -> int:
    return int(entity.number(70))


def _oddities(entity: DrawingEntity) -> list[str]:
    """Say what of an entity a polyline does not show."""
    if entity.kind in _CURVED:
        return ["curve"]
    if entity.kind == "SPLINE":
        return [] if entity.number(73) else ["fit points"]
    if entity.kind not in ("POLYLINE", "LWPOLYLINE", "VERTEX", "LINE"):
        return []
    found = []
    if entity.kind == "POLYLINE" and _flags(entity) & _MESH:
        found.append("mesh")
    if entity.kind != "LINE" and any(entity.numbers(42)):
        found.append("bulge")
    axis = entity.place(210, 1.0)
    if entity.kind in ("POLYLINE", "LWPOLYLINE") and axis != [0.0, 0.0, 1.0]:
        found.append("extrusion")
    return found


def _shape(
    entity: DrawingEntity, entities: list[DrawingEntity], at: int
) -> FloatArray | RawSpline | None:
    """Give what an entity draws, None if it is no line."""
    if entity.kind == "SPLINE":
        return drawn_spline(entity) if entity.number(73) else None
    points = _points(entity, entities, at)
    return np.array(points) if len(points) > 1 else None


def _points(entity: DrawingEntity, entities: list[DrawingEntity], at: int) -> list[list[float]]:
    """Give the points of an entity, none if it is no polyline."""
    if entity.kind == "LINE":
        return [entity.place(10), entity.place(11)]
    if entity.kind == "LWPOLYLINE":
        points = _light(entity)
    elif entity.kind == "POLYLINE" and not _flags(entity) & _MESH:
        points = _vertices(entity, entities, at)
    else:
        return []
    if points and _flags(entity) & _CLOSED and points[0] != points[-1]:
        points.append(list(points[0]))
    return points


def _light(entity: DrawingEntity) -> list[list[float]]:
    points: list[list[float]] = []
    height = entity.number(38)
    for code, value, where in entity.codes:
        if code == 10:
            points.append([0.0, 0.0, height])
        if code in _AXES:
            if not points:
                raise BadInputError(
                    f"an LWPOLYLINE has group code {code} before its first 10", where,
                    "save the drawing again as ASCII DXF",
                )  # fmt: skip
            points[-1][_AXES[code]] = read_number(value, where)
    return points


def _vertices(entity: DrawingEntity, entities: list[DrawingEntity], at: int) -> list[list[float]]:
    """Give the vertices that follow a POLYLINE, without the control points of a fitted curve."""
    height = entity.number(30)
    points = []
    for each in entities[at + 1 :]:
        if each.kind != "VERTEX":
            break
        if not _flags(each) & _CONTROL:
            points.append(each.place(10, height))
    return points
