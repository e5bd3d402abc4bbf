r"""The polylines of a DXF drawing as digitised pieces; what else it draws is told.

Examples
--------
>>> from assoc_hull.io.digitised_dxf import parse_dxf
>>> from assoc_hull.io.offset_report import Notebook
>>> rows = "0 SECTION 2 ENTITIES 0 LINE 8 WL_1 10 0 20 2 30 1 11 9 21 0 31 1 0 EOF".split()
>>> (piece,) = parse_dxf("\n".join(rows), "text", Notebook())
>>> piece.line, piece.points.tolist()
('WL_1', [[0.0, 2.0, 1.0], [9.0, 0.0, 1.0]])
"""

from __future__ import annotations

import re

import attrs
import numpy as np

from assoc_hull.arguments import shown
from assoc_hull.errors import BadInputError
from assoc_hull.io.digitised_piece import RawPiece, read_number
from assoc_hull.io.offset_report import Notebook

__all__ = ["parse_dxf"]

_AXES = {10: 0, 20: 1, 30: 2}
_CURVED = ("SPLINE", "ARC", "CIRCLE", "ELLIPSE", "HELIX", "MLINE", "INSERT")
_CLOSED, _CONTROL, _MESH = 1, 16, 16 | 64
_EXPLODE = "explode it to polylines in the drawing program and read it again"
_MEANINGS = {
    "curve": "is no polyline and left out",
    "mesh": "is a mesh and left out",
    "bulge": "has arcs between its points, read as straight",
    "extrusion": "stands in coordinates of its own (extrusion), read as if in those of the ship",
}


@attrs.define(eq=False)
class _Entity:
    """An entity of a drawing: its kind, where it begins, and its group codes with values."""

    kind: str
    where: str
    codes: list[tuple[int, str, str]] = attrs.field(factory=list)

    def word(self, code: int) -> str:
        """Give the first value of a code, empty if there is none."""
        return next((value for each, value, _ in self.codes if each == code), "")

    def numbers(self, code: int) -> list[float]:
        """Give the values of a code as numbers."""
        return [read_number(value, where) for each, value, where in self.codes if each == code]

    def number(self, code: int) -> float:
        """Give the first value of a code, nil if there is none."""
        return next(iter(self.numbers(code)), 0.0)

    def place(self, first: int = 10, height: float = 0.0) -> list[float]:
        """Give the place that begins with a code."""
        x, y, *z = (self.numbers(first + step)[:1] for step in (0, 10, 20))
        return [*(x or [0.0]), *(y or [0.0]), *(z[0] or [height])]


def parse_dxf(text: str, source: str, book: Notebook) -> list[RawPiece]:
    """Read POLYLINE, LWPOLYLINE and LINE entities of an ASCII DXF.

    Parameters
    ----------
    text : str
        The drawing; the layer of an entity names its line.
    source : str
        Name of the file, for messages.
    book : Notebook
        Takes what the drawing holds and polylines do not.

    Raises
    ------
    BadInputError
        A group code or a coordinate that is none.
    """
    found: list[RawPiece] = []
    odd: dict[tuple[str, str], list[str]] = {}
    entities = _entities(text, source)
    for i, each in enumerate(entities):
        for kind in _oddities(each):
            owner = "POLYLINE" if each.kind == "VERTEX" else each.kind
            odd.setdefault((kind, owner), []).append(each.where)
        points = _points(each, entities, i)
        if len(points) > 1:
            found.append(RawPiece(each.word(8), np.array(points), each.where))
    for (kind, owner), places in odd.items():
        count = f"{owner} {_MEANINGS[kind]}; {len(places)} such, the first at {places[0]}"
        book.suspect(kind, "the drawing", f"{count}: {_EXPLODE}", len(places))
    return found


def _entities(text: str, source: str) -> list[_Entity]:
    rows = text.splitlines()
    found: list[_Entity] = []
    for i in range(0, len(rows) - 1, 2):
        where = f"line {i + 1} of {source}"
        if not re.fullmatch(r"\s*-?[0-9]{1,9}\s*", rows[i]):
            raise BadInputError(f"{shown(rows[i])} is no group code", where, "save it as ASCII DXF")
        code, value = int(rows[i]), rows[i + 1].strip()
        if code == 0:
            found.append(_Entity(value, where))
        elif found:
            found[-1].codes.append((code, value, where))
    return found


def _flags(entity: _Entity) -> int:
    return int(entity.number(70))


def _oddities(entity: _Entity) -> list[str]:
    """Say what of an entity a polyline does not show."""
    if entity.kind in _CURVED:
        return ["curve"]
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


def _points(entity: _Entity, entities: list[_Entity], at: int) -> list[list[float]]:
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


def _light(entity: _Entity) -> list[list[float]]:
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


def _vertices(entity: _Entity, entities: list[_Entity], at: int) -> list[list[float]]:
    """Give the vertices that follow a POLYLINE, without the control points of a fitted curve."""
    height = entity.number(30)
    points = []
    for each in entities[at + 1 :]:
        if each.kind != "VERTEX":
            break
        if not _flags(each) & _CONTROL:
            points.append(each.place(10, height))
    return points
