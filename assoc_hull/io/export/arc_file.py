"""Arcs of lines as files: a drawing for machines and drawing programs, or a table.

Examples
--------
>>> from assoc_hull.analysis.production_arcs import arc_lines
>>> from assoc_hull.shipped.wigley import wigley
>>> from assoc_hull.io.export.arc_file import arc_table
>>> print(arc_table(arc_lines(wigley(), "WL 5", 0.01, 0.0)).splitlines()[0])
group,line,number,x,y,z,dx,dy,dz,nx,ny,nz,curvature,length,cx,cy,cz,radius
"""

from __future__ import annotations

import csv
import io
import os

import numpy as np

from assoc_hull.analysis.arc_lines import ArcLine, ArcLines
from assoc_hull.arguments import choice, file_path
from assoc_hull.errors import BadInputError
from assoc_hull.io.export.arc_dxf import ENTITIES, arc_drawing
from assoc_hull.io.write_file import write_whole

__all__ = ["arc_form", "arc_table", "write_arcs"]

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
    >>> from assoc_hull.io.export.arc_file import arc_form
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
        Of a drawing, see `assoc_hull.io.export.arc_dxf.arc_drawing`; a table is the same with both.

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
