"""The straight lines of the three views, with their labels."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.plot.lines_plan.drawing import Drawing, DrawnLine
from assoc_hull.plot.sheet.pens import AXIS, GRID, HEAVY, WATER
from assoc_hull.plot.sheet.rails import Side, rail
from assoc_hull.plot.sheet.sheet import Sheet
from assoc_hull.plot.sheet.view import View

__all__ = ["Grid"]

_OVER = 1.6
"""How far grid lines reach beyond the hull, mm at A3."""


@attrs.frozen
class Grid:
    """Draws the planes of the lines that a view shows as straight lines.

    Attributes
    ----------
    sheet : Sheet
        Where to draw.
    drawing : Drawing
        The hull.
    low, high : (3,), m
        Least and greatest coordinates; y of one side.
    """

    sheet: Sheet
    drawing: Drawing
    low: FloatArray
    high: FloatArray

    @property
    def over(self) -> float:
        """How far grid lines reach beyond the hull, mm."""
        return _OVER * self.sheet.paper.factor

    @property
    def sections(self) -> tuple[DrawnLine, ...]:
        """The sections; the frames of a hull that has no sections."""
        return self.drawing.of("sections") or self.drawing.of("frames")

    def body(self, view: View) -> None:
        """Draw waterlines and buttocks as straight lines, labelled at their ends."""
        factor, breadth = self.sheet.paper.factor, self.high[1]
        left, right = view.across(-breadth) - self.over, view.across(breadth) + self.over
        self._level_lines(view, left, right)
        low, high = view.up(self.low[2]) - self.over, view.up(self.high[2]) + self.over
        below = low - 2.0 * factor
        ends, words = [], []
        for line in self.drawing.of("buttocks"):
            for half in (view, view.mirrored()):
                x = half.across(line.offset)
                self.sheet.rule((x, low), (x, high), GRID, f"body/grid/{line.name}")
                ends.append([x, low])
                words.append(line.label)
        rail(
            self.sheet, np.array(ends).reshape(-1, 2), words, "below", below,
            heading="BTK", name="label/body/buttocks",
        )  # fmt: skip
        self.sheet.rule((view.across(0.0), low), (view.across(0.0), high), AXIS, "body/grid/CL")
        for edge in (-breadth, breadth):
            self.sheet.rule(
                (view.across(edge), low), (view.across(edge), high), GRID, "body/grid/side"
            )
        self._level_labels(view, "left", left)
        self._level_labels(view, "right", right)

    def stations(self, view: View, low: float, high: float) -> None:
        """Draw the sections as upright straight lines, labelled below."""
        bottom, top = view.up(low) - self.over, view.up(high) + self.over
        ends = [(view.across(line.offset), bottom) for line in self.sections]
        for line, (x, _) in zip(self.sections, ends, strict=True):
            self.sheet.rule((x, bottom), (x, top), GRID, f"{view.name}/grid/{line.name}")
        words = [line.label for line in self.sections]
        below = bottom - 2.0 * self.sheet.paper.factor
        ends_ = np.array(ends).reshape(-1, 2)
        rail(
            self.sheet, ends_, words, "below", below,
            heading="ST", sparse=True, name=f"label/{view.name}/sections",
        )  # fmt: skip

    def levels(self, view: View, low: float, high: float) -> None:
        """Draw the waterlines as level straight lines, labelled at both ends.

        Rows above and below the view are written first: names on the left that would reach into
        them are left out, the body plan has them all.
        """
        left, right = view.across(low) - self.over, view.across(high) + self.over
        self._level_lines(view, left, right)
        self._level_labels(view, "left", left)
        self._level_labels(view, "right", right)

    def _level_lines(self, view: View, left: float, right: float) -> None:
        for line in self.drawing.of("waterlines"):
            z = view.up(line.offset)
            self.sheet.rule((left, z), (right, z), GRID, f"{view.name}/grid/{line.name}")
        for height, pen in ((0.0, HEAVY), (self.drawing.particulars.draught, WATER)):
            z = view.up(height)
            self.sheet.rule(
                (left, z), (right, z), attrs.evolve(pen, width=0.16), f"{view.name}/grid/"
            )

    def _level_labels(self, view: View, side: Side, end: float) -> None:
        """Label waterlines by name on the left; design waterline and base line on the right."""
        draught = self.drawing.particulars.draught
        marks = [(0.0, "base line"), (draught, "DWL")]
        if side == "left":
            marks = [(line.offset, line.name) for line in self.drawing.of("waterlines")]
        ends = np.array([(end, view.up(height)) for height, _ in marks]).reshape(-1, 2)
        off = (2.5 if side == "right" else -2.5) * self.sheet.paper.factor
        words = [name for _, name in marks]
        name, sparse = f"label/{view.name}/{side}", side == "left" and view.name != "body"
        rail(self.sheet, ends, words, side, end + off, sparse=sparse, name=name)

    def lanes(self, view: View, low: float, high: float) -> None:
        """Draw the buttocks as straight lines along the ship, labelled on the left as `levels`."""
        left, right = view.across(low) - self.over, view.across(high) + self.over
        lines = self.drawing.of("buttocks")
        for line in lines:
            y = view.up(line.offset)
            self.sheet.rule((left, y), (right, y), GRID, f"{view.name}/grid/{line.name}")
        self.sheet.rule((left, view.up(0.0)), (right, view.up(0.0)), AXIS, f"{view.name}/grid/CL")
        marks = [(0.0, "CL"), *((line.offset, line.name) for line in lines)]
        ends = np.array([(left, view.up(offset)) for offset, _ in marks])
        at = left - 2.5 * self.sheet.paper.factor
        words = [name for _, name in marks]
        rail(self.sheet, ends, words, "left", at, sparse=True, name=f"label/{view.name}/left")

    def perpendiculars(self, view: View, low: float, high: float) -> None:
        """Draw both perpendiculars and the middle between them, named in a row below."""
        factor, length = self.sheet.paper.factor, self.drawing.particulars.length
        bottom, top = view.up(low) - self.over, view.up(high) + self.over
        for x, words in ((0.0, "AP"), (0.5 * length, "Lpp/2"), (length, "FP")):
            at = view.across(x)
            self.sheet.rule((at, bottom), (at, top), AXIS, f"{view.name}/grid/{words}")
            text = self.sheet.text(
                (at, bottom - 5.2 * factor), words, up="top", name=f"label/{view.name}/{words}"
            )
            self.sheet.take(text)
