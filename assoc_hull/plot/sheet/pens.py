"""The pens of the drawing office: line weights, dashes and tints."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from assoc_hull.model.kinds import BoundaryKind
from assoc_hull.plot.lines_plan.drawing import DrawnLine
from assoc_hull.plot.sheet.paper import Pen

__all__ = [
    "AXIS", "BEFORE", "FAMILY_COLOURS", "FRAME", "GRID", "HEAVY", "LINE", "TINT", "WATER", "pen_of",
]  # fmt: skip

TINT = "#c8102e"
"""Colour of lines that are to be noticed."""

LINE = Pen(0.13)
HEAVY = Pen(0.25, over=2.5)
FRAME = Pen(0.35)
GRID = Pen(0.08, "0.62", over=1.0)
AXIS = Pen(0.14, "0.15", (4.0, 0.8, 0.8, 0.8), 1.2)
WATER = Pen(0.16, "0.15", (3.0, 1.0), 1.2)
BEFORE = Pen(0.13, "0.6", over=1.8)

_BOUNDARY = {
    BoundaryKind.END: HEAVY,
    BoundaryKind.FLAT: Pen(0.16, "black", (2.0, 0.7, 0.4, 0.7), 2.2),
    BoundaryKind.KNUCKLE: Pen(0.22, over=2.4),
}

FAMILY_COLOURS: Mapping[str, str] = MappingProxyType(
    {
        "boundary": "#444444",
        "sections": "#0b5fa5",
        "waterlines": "#0a7d55",
        "buttocks": "#a8570f",
        "diagonals": "#7a3b9a",
        "frames": "#5b7fa0",
    }
)


def pen_of(line: DrawnLine, tinted: bool = False) -> Pen:
    """Give the pen of a line: heavy for the ends of the hull, dashed for borders of flats."""
    pen = LINE if line.boundary is None else _BOUNDARY[line.boundary]
    if tinted:
        return Pen(max(pen.width, 0.26), TINT, pen.dash, 3.0)
    return pen
