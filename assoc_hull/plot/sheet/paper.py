"""Sizes of paper, scales and millimetres, and the pens of the drawing office.

Lengths are millimetres. A `Pen` has a width at A3, a colour, a dash, and how far it lies above
others; `Paper.factor` scales widths and letters to another size. The named pens (`LINE`,
`HEAVY`, `GRID`, `WATER`, ...) are those that several pictures share.

From metres on the hull to millimetres on paper, and the scales a drawing may have.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Literal

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray

__all__ = [
    "AXIS",
    "BEFORE",
    "FAMILY_COLOURS",
    "FRAME",
    "GRID",
    "HEAVY",
    "LINE",
    "MARGIN",
    "PAPERS",
    "POINT",
    "TINT",
    "WATER",
    "Paper",
    "PaperName",
    "Pen",
    "View",
    "paper_of",
    "scale_of",
]

_STEPS = (1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 5.0, 6.0, 7.5)
"""Drawing offices take one of these, times a power of ten, as the scale's denominator."""


def scale_of(metres: float, millimetres: float) -> float:
    """Give the smallest usual denominator at which a length fits on paper.

    Examples
    --------
    >>> from assoc_hull.plot.sheet.paper import scale_of
    >>> scale_of(121.92, 360.0), scale_of(10.0, 150.0)
    (350.0, 75.0)
    """
    least = max(metres, 1e-9) * 1e3 / millimetres
    power = 10.0 ** np.floor(np.log10(least))
    steps = [step * power for step in (*_STEPS, 10.0) if step * power >= least * (1.0 - 1e-12)]
    return float(f"{steps[0]:.6g}")


@attrs.frozen
class View:
    """A view of the hull at one place of the sheet.

    Attributes
    ----------
    name : str
        Begins the names of everything drawn in it.
    axes : (int, int)
        Coordinates that run to the right and upward.
    denominator : float
        The scale is 1 to this.
    origin : (float, float), mm
        Where the coordinates are nil.
    sign : float
        -1 mirrors the view right to left.
    """

    name: str
    axes: tuple[int, int]
    denominator: float
    origin: tuple[float, float]
    sign: float = 1.0

    @property
    def unit(self) -> float:
        """Millimetres on paper for one metre."""
        return 1e3 / self.denominator

    def across(self, value: float) -> float:
        """Give the place (mm) of a coordinate that runs to the right."""
        return self.origin[0] + self.sign * self.unit * value

    def up(self, value: float) -> float:
        """Give the place (mm) of a coordinate that runs upward."""
        return self.origin[1] + self.unit * value

    def on_paper(self, xyz: FloatArray) -> FloatArray:
        """Project points (k, 3), m, onto the sheet, (k, 2), mm."""
        plane = xyz[:, list(self.axes)]
        return np.asarray(self.origin) + self.unit * plane * (self.sign, 1.0)

    def mirrored(self) -> View:
        """Give the same view, right and left exchanged."""
        return attrs.evolve(self, sign=-self.sign)


# --------------------------------------------------------------------------------------
# Sizes of paper, and the pens that are used on them.

POINT = 25.4 / 72.0
"""Millimetres in a typographic point."""

MARGIN = 8.0
"""Of the frame from the edge of the sheet, mm at A3."""

PaperName = Literal["A1", "A3", "A4"]


@attrs.frozen
class Paper:
    """A size of paper, landscape, mm, and of the letters on it, points.

    Attributes
    ----------
    name : str
        A1, A3, A4.
    width, height : float, mm
        Of the sheet.
    letter : float, points
        Size of the letters of labels.
    dots : int
        Dots per inch of a PNG.
    """

    name: str
    width: float
    height: float
    letter: float
    dots: int

    @property
    def factor(self) -> float:
        """How much wider spaces are than on A3."""
        return self.letter / 5.0


PAPERS = {
    paper.name: paper
    for paper in (
        Paper("A1", 841.0, 594.0, 8.0, 120),
        Paper("A3", 420.0, 297.0, 5.0, 200),
        Paper("A4", 297.0, 210.0, 5.0, 200),
    )
}


@attrs.frozen
class Pen:
    """How a line is drawn.

    Attributes
    ----------
    width : float, mm
        At A3; wider on larger paper.
    colour : str
        As matplotlib names colours.
    dash : tuple of float, mm
        Lengths drawn and left out, in turn; empty for a full line.
    over : float
        Lines of higher numbers lie over those of lower ones.
    """

    width: float
    colour: str = "black"
    dash: tuple[float, ...] = ()
    over: float = 2.0


def paper_of(name: str) -> Paper:
    """Give a size of paper.

    Raises
    ------
    BadInputError
        An unknown name.
    """
    if name not in PAPERS:
        known = ", ".join(PAPERS)
        raise BadInputError(f"the paper {name!r} was asked", "in a picture", f"use one of {known}")
    return PAPERS[name]


# --------------------------------------------------------------------------------------
# The pens of the drawing office: line weights, dashes and tints.

TINT = "#c8102e"
"""Colour of lines that are to be noticed."""

LINE = Pen(0.13)
HEAVY = Pen(0.25, over=2.5)
FRAME = Pen(0.35)
GRID = Pen(0.08, "0.62", over=1.0)
AXIS = Pen(0.14, "0.15", (4.0, 0.8, 0.8, 0.8), 1.2)
WATER = Pen(0.16, "0.15", (3.0, 1.0), 1.2)
BEFORE = Pen(0.13, "0.6", over=1.8)

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
