"""Lines of arcs as files: a DXF drawing through ezdxf, or a table as CSV.

A curve is one LWPOLYLINE in its own plane in space; a round segment is given by its ends and its
bulge, the tangent of a quarter of its turn, so that segments join to the last digit and an arc of a
radius of a thousand kilometres is as exact as one of a metre. Lengths are in m.
"""

from __future__ import annotations

import csv
import io
import os
from typing import Any

import numpy as np

from assoc_hull.analysis.production_arcs import ArcLine, ArcLines
from assoc_hull.arguments import choice, file_path
from assoc_hull.errors import BadInputError
from assoc_hull.io.dxf.lines import drawing_text, layer_name, tag_entity
from assoc_hull.io.write_file import write_whole

__all__ = [
    "ENTITIES",
    "arc_drawing",
    "arc_form",
    "arc_table",
    "write_arcs",
]

# --------------------------------------------------------------------------------------
# Drawings. Machines that read no polylines are given ARC and LINE entities. An ARC has centre,
# radius and angles; its ends are differences of large numbers, so that arcs join to some digits of
# the radius.

ENTITIES = ("polylines", "arcs")
"""What a curve may be drawn as."""

_FLAT = 1e-9
"""An arc that turns by less (rad) is a LINE: over 100 m it is 12 nm deep."""


def arc_drawing(arcs: ArcLines, entities: str = "polylines") -> str:
    """Give the text of a DXF file (R2000), in metres; the same arcs give the same text.

    Parameters
    ----------
    arcs : ArcLines
        The curves.
    entities : {"polylines", "arcs"}
        One LWPOLYLINE a curve, or an ARC or a LINE for each of its arcs.

    Raises
    ------
    BadInputError
        Other entities.
    MissingExtraError
        ezdxf is not installed.
    """
    add = _add_arcs if choice(entities, "entities", ENTITIES, "in a drawing") == "arcs" else _add

    def draw(space: Any) -> None:
        for line in arcs.lines:
            add(space, line, layer_name(line.group))

    return drawing_text((layer_name(line.group) for line in arcs.lines), draw, metric=False)


def _add(space: Any, line: ArcLine, layer: str) -> None:
    """Add a curve."""
    places = np.concatenate([line.arcs.start, line.arcs.ends()[-1:]]) + 0.0
    bulge = np.append(np.tan(0.25 * line.arcs.curvature * line.arcs.length), 0.0)
    vertices = np.concatenate([places, bulge[:, None]], axis=1).tolist()
    polyline = space.add_lwpolyline(
        vertices, format="xyb",
        dxfattribs={
            "layer": layer, "extrusion": tuple(line.axes[2].tolist()), "elevation": line.height,
        },
    )  # fmt: skip
    tag_entity(polyline, line.name)


def _add_arcs(space: Any, line: ArcLine, layer: str) -> None:
    """Add the arcs of a curve one by one, in their order."""
    arcs = line.arcs
    turn = arcs.curvature * arcs.length
    begin, end = line.in_space(arcs.start), line.in_space(arcs.ends())
    # An ARC runs counter-clockwise about its extrusion, so a right turn is given from its end.
    first = np.where(turn > 0.0, arcs.angle - 0.5 * np.pi, arcs.angle + turn + 0.5 * np.pi)
    first, last = (np.rad2deg(each).tolist() for each in (first, first + np.abs(turn)))
    centres = arcs.centres().tolist()
    look = {"layer": layer, "extrusion": tuple(line.axes[2].tolist())}
    for k in range(len(arcs)):
        if abs(turn[k]) < _FLAT:
            added = space.add_line(begin[k].tolist(), end[k].tolist(), {"layer": layer})
        else:
            centre, radius = (*centres[k], line.height), 1.0 / abs(float(arcs.curvature[k]))
            added = space.add_arc(centre, radius, first[k], last[k], dxfattribs=look)
        tag_entity(added, line.name)


# --------------------------------------------------------------------------------------
# Files.

_HEAD = (
    "group", "line", "number", "x", "y", "z", "dx", "dy", "dz", "nx", "ny", "nz", "curvature",
    "length", "cx", "cy", "cz", "radius",
)  # fmt: skip
_ENDINGS = {".dxf": "dxf", ".csv": "csv"}


def arc_form(path: str | os.PathLike[str]) -> str:
    """Tell by its ending what a file of arcs is to be: ``"dxf"`` or ``"csv"``.

    Raises
    ------
    BadInputError
        Neither.

    Examples
    --------
    >>> from assoc_hull.io.export.arcs import arc_form
    >>> arc_form("lines.DXF")
    'dxf'
    """
    name = os.path.basename(file_path(path, "in the arcs")).lower()
    for ending, form in _ENDINGS.items():
        if name.endswith(ending):
            return form
    what = "the ending of the name tells no form of arcs"
    raise BadInputError(what, f"at {os.fspath(path)}", f"end it in {' or '.join(_ENDINGS)}")


def write_arcs(arcs: ArcLines, path: str | os.PathLike[str], entities: str = "polylines") -> None:
    """Write a drawing or a table, by the ending of the name.

    Parameters
    ----------
    arcs : ArcLines
        The curves.
    path : path
        The file.
    entities : {"polylines", "arcs"}
        Of a drawing, see `assoc_hull.io.export.arcs.arc_drawing`; a table is the same with both.

    Raises
    ------
    BadInputError, MissingExtraError
        Another ending, other entities, a file that cannot be written, or no ezdxf for a drawing.
    """
    form, kind = arc_form(path), choice(entities, "entities", ENTITIES, "in save")
    text = arc_drawing(arcs, kind) if form == "dxf" else arc_table(arcs)
    write_whole(path, text.encode())


def arc_table(arcs: ArcLines) -> str:
    """Give all arcs as comma-separated text, all digits.

    Per arc: group and line, its number; where it begins (m); a unit vector along it there; the
    normal of its plane, about which positive curvature turns by the right hand; curvature (1/m);
    length (m); centre (m) and radius (m), blank for straight lines.
    """
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(_HEAD)
    for line in arcs.lines:
        writer.writerows(_rows(line))
    return out.getvalue()


def _rows(line: ArcLine) -> list[list[str]]:
    bend = line.arcs.curvature
    with np.errstate(divide="ignore"):
        radius = np.where(bend == 0.0, np.nan, 1.0 / np.abs(bend))
    normal = np.broadcast_to(line.axes[2], (len(bend), 3))
    table = np.concatenate(
        [line.starts(), line.directions(), normal, bend[:, None], line.arcs.length[:, None],
         line.centres(), radius[:, None]], axis=1,
    )  # fmt: skip
    return [
        [line.group, line.name, str(number), *("" if v != v else repr(v + 0.0) for v in row)]
        for number, row in enumerate(table.tolist(), start=1)
    ]
