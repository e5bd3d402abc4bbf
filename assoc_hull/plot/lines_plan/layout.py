"""Where the three views lie on a sheet, and at which scales."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.plot.lines_plan.drawing import Drawing
from assoc_hull.plot.sheet.paper import MARGIN, Paper
from assoc_hull.plot.sheet.view import View, scale_of

__all__ = ["Layout", "lay_out", "place_body"]

BLOCK = 92.0
"""Width of the block of particulars, mm at A3; so are the other lengths."""

_SIDE = 17.0  # for labels left and right of a view
_ABOVE, _BELOW, _CAPTION = 9.0, 9.0, 7.0
_ABOVE_HALF = 6.5
_BODY_ABOVE, _BODY_BELOW = 15.0, 12.0


@attrs.frozen
class Layout:
    """The views, and the block of particulars: its right upper corner, mm.

    Attributes
    ----------
    profile, half, body : View
        The body view is that of the fore body; mirrored it is that of the aft body.
    low, high : (3,), m
        Least and greatest coordinates of the hull; y is counted to one side.
    depth : float, m
        How far diagonals reach below the centre line of the half-breadth plan.
    corner : (float, float), mm
        Right upper corner of the frame.
    """

    profile: View
    half: View
    body: View
    low: FloatArray
    high: FloatArray
    depth: float
    corner: tuple[float, float]


def lay_out(drawing: Drawing, paper: Paper) -> Layout:
    """Choose scales and places for a lines plan.

    The half-breadth plan lies below the profile on the same scale, aligned in x; above both
    lies the body plan on its own, larger scale, beside the block of particulars.
    """
    factor = paper.factor
    low, high = drawing.bounds
    low = np.minimum(low, [0.0, 0.0, 0.0])
    length, breadth, height = (high - low).tolist()
    depth = _diagonal_reach(drawing)
    frame = MARGIN * factor
    scale = scale_of(length, paper.width - 2.0 * frame - 2.0 * _SIDE * factor)
    unit = 1e3 / scale
    bands = (_ABOVE_HALF + _ABOVE + 2.0 * (_BELOW + _CAPTION)) * factor
    lower = unit * (height + breadth + depth) + bands
    room = paper.height - 2.0 * frame - lower
    body_room = (
        paper.width - 2.0 * frame - BLOCK * factor - 2.0 * _SIDE * factor,
        room - (_BODY_ABOVE + _BODY_BELOW + _CAPTION) * factor,
    )
    body_scale = min(scale, place_body(breadth, height, body_room))
    spare = room - height * 1e3 / body_scale - (_BODY_ABOVE + _BODY_BELOW + _CAPTION) * factor
    gap = max(spare, 0.0) / 4.0
    x = 0.5 * (paper.width - unit * length) - unit * low[0]
    y = frame + gap + (_CAPTION + _BELOW) * factor + unit * depth
    z = y + unit * breadth + gap + (_ABOVE_HALF + _CAPTION + _BELOW) * factor - unit * low[2]
    top = z + unit * high[2] + _ABOVE * factor
    middle = 0.5 * (paper.width - BLOCK * factor)
    base = top + gap + (_CAPTION + _BODY_BELOW) * factor - low[2] * 1e3 / body_scale
    return Layout(
        View("profile", (0, 2), scale, (x, z)),
        View("half-breadth", (0, 1), scale, (x, y)),
        View("body", (1, 2), body_scale, (middle, base)),
        low, high, depth, (paper.width - frame, paper.height - frame),
    )  # fmt: skip


def place_body(breadth: float, height: float, room: tuple[float, float]) -> float:
    """Give the scale of a body plan: both halves side by side, within a width and height, mm."""
    return max(scale_of(2.0 * breadth, room[0]), scale_of(height, max(room[1], 1.0)))


def _diagonal_reach(drawing: Drawing) -> float:
    """Give the greatest breadth along the diagonals' planes, m."""
    reach = [0.0]
    for line in drawing.of("diagonals"):
        points = line.points
        if len(points):
            start = line.offset / line.normal[2] if line.normal[2] else 0.0
            reach.append(float(np.hypot(points[:, 1], points[:, 2] - start).max()))
    return max(reach)
