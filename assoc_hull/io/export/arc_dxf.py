"""Arcs of lines as a DXF drawing, through ezdxf.

A curve is one polyline of straight and round segments (LWPOLYLINE) in its own plane in space. A
round segment is told by its ends and its bulge, the tangent of a quarter of its turn: so segments
join to the last digit, and an arc of a radius of a thousand kilometres is as exact as one of a
metre. An ARC entity tells centre, radius and angles; there its ends are differences of large
numbers. Machines that read no polylines are given ARC and LINE entities, which then meet to
some digits of the radius.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from assoc_hull.analysis.arc_lines import ArcLine, ArcLines
from assoc_hull.arguments import choice
from assoc_hull.io.dxf.document import drawing_text, layer_name, tagged

__all__ = ["ENTITIES", "arc_drawing"]

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
    tagged(polyline, line.name)


def _add_arcs(space: Any, line: ArcLine, layer: str) -> None:
    """Add the arcs of a curve one by one, in their order."""
    arcs = line.arcs
    turn = arcs.curvature * arcs.length
    begin, end = line.in_space(arcs.start), line.in_space(arcs.ends())
    # An ARC runs counter-clockwise about its extrusion, so a right turn is told from its end.
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
        tagged(added, line.name)
