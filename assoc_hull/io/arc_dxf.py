"""Arcs of lines as a DXF drawing, through ezdxf.

A curve is one polyline of straight and round segments (LWPOLYLINE) in its own plane in space. A
round segment is told by its ends and its bulge, the tangent of a quarter of its turn: so segments
join to the last digit, and an arc of a radius of a thousand kilometres is as exact as one of a
metre. An ARC entity tells centre, radius and angles; there its ends are differences of large
numbers. Machines that read no polylines are given ARC and LINE entities, which then meet to
some digits of the radius.
"""

from __future__ import annotations

import io
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np

from assoc_hull.analysis.arc_lines import ArcLine, ArcLines
from assoc_hull.arguments import choice
from assoc_hull.errors import MissingExtraError

__all__ = ["ENTITIES", "NAMES", "arc_drawing"]

ENTITIES = ("polylines", "arcs")
"""What a curve may be drawn as."""

NAMES = "ASSOC_HULL"
"""Application name of the extended data that hold the name of the line."""
_COLOURS = 7
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
    try:
        import ezdxf
        from ezdxf import units
    except ImportError as error:
        raise MissingExtraError("ezdxf", "dxf") from error
    with _no_times(ezdxf):
        drawing = ezdxf.new("R2000")  # type: ignore[attr-defined]
        drawing.units = units.M
        drawing.appids.add(NAMES)
        space = drawing.modelspace()
        groups = list(dict.fromkeys(line.group for line in arcs.lines))
        layers = {group: _layer(group) for group in groups}
        for number, group in enumerate(groups):
            drawing.layers.add(layers[group], color=number % _COLOURS + 1)
        for line in arcs.lines:
            add(space, line, layers[line.group])
        out = io.StringIO()
        drawing.write(out)
    return out.getvalue()


@contextmanager
def _no_times(ezdxf: Any) -> Iterator[None]:
    """Let ezdxf write no times and no random numbers: one hull, one file."""
    before = ezdxf.options.write_fixed_meta_data_for_testing
    ezdxf.options.write_fixed_meta_data_for_testing = True
    try:
        yield
    finally:
        ezdxf.options.write_fixed_meta_data_for_testing = before


def _layer(group: str) -> str:
    """Give a name of a layer: without the characters that DXF forbids."""
    return "".join("_" if each in '<>/\\":;?*|=`,' else each for each in group) or "lines"


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
    polyline.set_xdata(NAMES, [(1000, line.name)])


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
        added.set_xdata(NAMES, [(1000, line.name)])
