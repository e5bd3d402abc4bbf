"""Arcs of lines as a DXF drawing, through ezdxf.

A curve is one polyline of straight and round segments (LWPOLYLINE) in its own plane in space. A
round segment is told by its ends and its bulge, the tangent of a quarter of its turn: so segments
join to the last digit, and an arc of a radius of a thousand kilometres is as exact as one of a
metre. An ARC entity tells centre, radius and angles; there its ends are differences of large
numbers. Drawing programs turn a polyline into ARC and LINE by one command.
"""

from __future__ import annotations

import io
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np

from assoc_hull.analysis.arc_lines import ArcLine, ArcLines
from assoc_hull.errors import MissingExtraError

__all__ = ["NAMES", "arc_drawing"]

NAMES = "ASSOC_HULL"
"""Application name of the extended data that hold the name of the line."""
_COLOURS = 7


def arc_drawing(arcs: ArcLines) -> str:
    """Give the text of a DXF file (R2000), in metres; the same arcs give the same text.

    Raises
    ------
    MissingExtraError
        ezdxf is not installed.
    """
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
            _add(space, line, layers[line.group])
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
