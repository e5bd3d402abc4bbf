"""Body plans as other programs draw them: flat DXF drawings of both halves, made of a hull."""

from __future__ import annotations

import io
from collections.abc import Sequence

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.hull import Hull
from assoc_hull.io.lines.line_points import lines_as_points


def body_plan(
    hull: Hull,
    stations: Sequence[tuple[str, float]],
    scale: float = 1.0,
    unit: str = "m",
    centre: float = 0.0,
    *,
    labels: bool = True,
) -> str:
    """A drawing of sections: by label and place, after body to the left; a grid and words beside.

    Parameters
    ----------
    hull : Hull
        It has sections at the places.
    stations : sequence of (str, float)
        Labels and places, m.
    scale : float
        Of the drawing: 1 over this.
    unit : {"m", "mm"}
        Declared.
    centre : float
        Where the centre line is drawn.
    labels : bool
        Whether sections have labels.
    """
    import ezdxf

    drawing = ezdxf.new("R2000")  # type: ignore[attr-defined]
    drawing.units = {"m": 6, "mm": 4}[unit]
    space = drawing.modelspace()
    per_metre = {"m": 1.0, "mm": 1e3}[unit] / scale
    middle = 0.5 * hull.particulars.length
    lines = {each.offset: each for each in lines_as_points(hull.state, ("sections",))}
    wide = 0.5 * hull.particulars.breadth * per_metre
    for label, x in stations:
        line = lines[min(lines, key=lambda each: abs(each - x))]
        sign = -1.0 if line.offset < middle else 1.0
        for piece in line.pieces:
            flat = _flat(piece.points, sign, per_metre, centre)
            space.add_lwpolyline(flat.tolist(), dxfattribs={"layer": "sections"})
        if labels:
            top = (flat[-1, 0] + sign * 0.01 * wide, flat[-1, 1] + 0.02 * wide)
            text = space.add_text(label, height=0.02 * wide, dxfattribs={"layer": "numbers"})
            text.dxf.insert = top
    for height in (0.0, 0.4 * hull.particulars.depth * per_metre):
        space.add_line((centre - wide, height), (centre + wide, height), {"layer": "grid"})
    space.add_line((centre, 0.0), (centre, wide), {"layer": "grid"})
    space.add_text("BODY PLAN 1:100", height=1.0, dxfattribs={"layer": "title"})
    space.add_circle((centre, -wide), 0.1 * wide, {"layer": "stamp"})
    out = io.StringIO()
    drawing.write(out)
    return out.getvalue()


def _flat(points: FloatArray, sign: float, per_metre: float, centre: float) -> FloatArray:
    return np.column_stack([centre + sign * points[:, 1] * per_metre, points[:, 2] * per_metre])
