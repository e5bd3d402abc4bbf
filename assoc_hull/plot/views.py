"""The contents of the three views: lines, straight grid, and the labels of both."""

from __future__ import annotations

from collections.abc import Collection, Sequence

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.plot.drawing import Drawing, DrawnLine
from assoc_hull.plot.labels import Lettered, Side, label_above, label_lines, rail
from assoc_hull.plot.pens import AXIS, GRID, HEAVY, WATER, pen_of
from assoc_hull.plot.sheet import Pen, Sheet
from assoc_hull.plot.view import View

__all__ = ["Views", "body_halves"]

_OVER = 1.6
"""How far grid lines reach beyond the hull, mm at A3."""

_NEAR = 1e-6
"""Planes within this distance (m) are the same."""


@attrs.frozen
class Views:
    """Draws the views of one hull.

    Attributes
    ----------
    sheet : Sheet
        Where to draw.
    drawing : Drawing
        The hull.
    low, high : (3,), m
        Least and greatest coordinates; y of one side.
    tinted : collection of str
        Names of lines that are to be noticed.
    """

    sheet: Sheet
    drawing: Drawing
    low: FloatArray
    high: FloatArray
    tinted: Collection[str] = ()

    @property
    def over(self) -> float:
        """How far grid lines reach beyond the hull, mm."""
        return _OVER * self.sheet.paper.factor

    @property
    def sections(self) -> tuple[DrawnLine, ...]:
        """The sections; the frames of a hull that has no sections."""
        return self.drawing.of("sections") or self.drawing.of("frames")

    @property
    def middle(self) -> float:
        """Half the length between perpendiculars, m."""
        return 0.5 * self.drawing.particulars.length

    def draw(self, view: View, line: DrawnLine, pen: Pen | None = None) -> list[FloatArray]:
        """Draw a line in a view; give its polylines on the sheet."""
        used = pen or pen_of(line, line.name in self.tinted)
        found = [view.on_paper(points) for points in line.polylines]
        for points in found:
            self.sheet.line(points, used, f"{view.name}/{line.family}/{line.name}")
        return found

    def profile(self, view: View) -> None:
        """Draw the sheer plan: buttocks and boundaries over stations and waterlines."""
        self._stations(view, self.low[2], self.high[2])
        self._levels(view, self.low[0], self.high[0])
        self._perpendiculars(view, self.low[2], self.high[2])
        for line in self.drawing.of("boundary"):
            self.draw(view, line)
        ends, words = [], []
        for line in self.drawing.of("buttocks"):
            for points in self.draw(view, line):
                tops = [
                    end for end in (points[0], points[-1]) if end[1] > view.up(self.middle_height)
                ]
                ends += tops
                words += [line.label] * len(tops)
        top = view.up(self.high[2]) + 3.2 * self.sheet.paper.factor
        above = np.array(ends).reshape(-1, 2)
        rail(
            self.sheet, above, words, "above", top,
            upright=True, heading="BTK", name="label/profile/buttocks",
        )  # fmt: skip

    @property
    def middle_height(self) -> float:
        """Half the height of the hull, m."""
        return float(0.5 * (self.low[2] + self.high[2]))

    def half_breadth(self, view: View) -> None:
        """Draw the half-breadth plan: waterlines and boundaries; diagonals below the centre line."""
        self._stations(view, 0.0, self.high[1])
        self._lanes(view, self.low[0], self.high[0])
        self._perpendiculars(view, 0.0, self.high[1])
        lettered = []
        for line in (*self.drawing.of("boundary"), *self.drawing.of("waterlines")):
            if line is self.drawing.profile:
                continue
            label = line.label if line.family == "waterlines" else line.name
            found = self.draw(view, line)
            if not self._along_grid(line):
                lettered += [Lettered(label, points, line.name) for points in found]
        self._diagonals(view)
        start, end, middle = (view.across(x) for x in (self.low[0], self.high[0], self.middle))
        wanted = {line.label for line in lettered}
        for low, high, part in ((start, middle, "aft"), (middle, end, "fore")):
            wanted -= label_lines(
                self.sheet, lettered, low, high, name=f"label/half-breadth/{part}"
            )
        top = view.up(self.high[1]) + 3.2 * self.sheet.paper.factor
        label_above(self.sheet, lettered, wanted, top, "label/half-breadth/above")

    def _along_grid(self, line: DrawnLine) -> bool:
        """Whether a line is straight along the ship when seen from above."""
        return abs(line.normal[1]) == 1.0

    def _diagonals(self, view: View) -> None:
        """Draw diagonals in true breadth along their planes, mirrored below."""
        for line in self.drawing.of("diagonals"):
            start = line.offset / line.normal[2] if line.normal[2] else 0.0
            for points in line.polylines:
                true = points.copy()
                true[:, 1] = -np.hypot(points[:, 1], points[:, 2] - start)
                pen = pen_of(line, line.name in self.tinted)
                name = f"{view.name}/{line.family}/{line.name}"
                self.sheet.line(view.on_paper(true), pen, name)

    def body(self, view: View) -> None:
        """Draw the body plan: aft body on the left, fore body on the right."""
        self._body_grid(view)
        for mirrored in (True, False):
            half = view.mirrored() if mirrored else view
            self._half_body(half, body_halves(self.sections, self.middle)[0 if mirrored else 1])
            for line in self.drawing.of("boundary"):
                if line is not self.drawing.profile:
                    self._half_boundary(half, line)
            for line in self.drawing.of("diagonals"):
                self.draw(half, line)

    def _half_body(self, view: View, sections: Sequence[DrawnLine]) -> None:
        """Draw the sections of one half, labelled above the deck and on the lines."""
        tops, words, lettered = [], [], []
        for line in sections:
            for points in self.draw(view, line):
                lettered.append(Lettered(line.label, points))
                tops.append(points[np.argmax(points[:, 1])])
                words.append(line.label)
        edge = view.up(self.high[2])
        part = "aft" if view.sign < 0.0 else "fore"
        order = sorted(
            range(len(tops)), key=lambda i: self._outward(view, tops[i], sections, words[i])
        )
        factor = self.sheet.paper.factor
        rail(
            self.sheet, np.array([tops[i] for i in order]).reshape(-1, 2), [words[i] for i in order],
            "above", edge + 5.5 * factor, upright=True, heading="ST" if part == "aft" else "",
            name=f"label/body/{part}",
        )  # fmt: skip
        low = view.up(self.low[2])
        label_lines(self.sheet, lettered, low, edge, axis=1, name=f"label/body/on {part}")

    def _outward(
        self, view: View, top: FloatArray, sections: Sequence[DrawnLine], label: str
    ) -> tuple[float, float]:
        """Sort sections across the sheet; those that end at one place, midship outermost."""
        offset = next(line.offset for line in sections if line.label == label)
        return (round(float(top[0]), 2), -view.sign * abs(offset - self.middle))

    def _half_boundary(self, view: View, line: DrawnLine) -> None:
        """Draw what of a boundary lies abaft (mirrored) or before the middle."""
        pen = pen_of(line, line.name in self.tinted)
        for points in line.polylines:
            part = _clip(points, self.middle, view.sign)
            if len(part) > 1:
                self.sheet.line(view.on_paper(part), pen, f"body/boundary/{line.name}")

    def _body_grid(self, view: View) -> None:
        factor, breadth = self.sheet.paper.factor, self.high[1]
        left, right = view.across(-breadth) - self.over, view.across(breadth) + self.over
        for side, end in (("left", left), ("right", right)):
            self._level_labels(view, side, end)
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

    def _stations(self, view: View, low: float, high: float) -> None:
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
            heading="ST", name=f"label/{view.name}/sections",
        )  # fmt: skip

    def _levels(self, view: View, low: float, high: float) -> None:
        """Draw the waterlines as level straight lines, labelled at both ends."""
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
        rail(self.sheet, ends, words, side, end + off, name=f"label/{view.name}/{side}")

    def _lanes(self, view: View, low: float, high: float) -> None:
        """Draw the buttocks as straight lines along the ship, labelled on the left."""
        left, right = view.across(low) - self.over, view.across(high) + self.over
        lines = self.drawing.of("buttocks")
        for line in lines:
            y = view.up(line.offset)
            self.sheet.rule((left, y), (right, y), GRID, f"{view.name}/grid/{line.name}")
        self.sheet.rule((left, view.up(0.0)), (right, view.up(0.0)), AXIS, f"{view.name}/grid/CL")
        marks = [(0.0, "CL"), *((line.offset, line.name) for line in lines)]
        ends = np.array([(left, view.up(offset)) for offset, _ in marks])
        at = left - 2.5 * self.sheet.paper.factor
        rail(
            self.sheet,
            ends,
            [name for _, name in marks],
            "left",
            at,
            name=f"label/{view.name}/left",
        )

    def _perpendiculars(self, view: View, low: float, high: float) -> None:
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


def body_halves(
    sections: Sequence[DrawnLine], middle: float
) -> tuple[tuple[DrawnLine, ...], tuple[DrawnLine, ...]]:
    """Divide sections into aft and fore body; the one at the middle belongs to both."""
    aft = tuple(line for line in sections if line.offset <= middle + _NEAR)
    fore = tuple(line for line in sections if line.offset >= middle - _NEAR)
    return aft, fore


def _clip(points: FloatArray, middle: float, sign: float) -> FloatArray:
    """Give the part of a polyline before (sign 1) or abaft (-1) a station."""
    ahead = sign * (points[:, 0] - middle)
    found = []
    for i in range(len(points)):
        if i and ahead[i - 1] * ahead[i] < 0.0:
            part = ahead[i - 1] / (ahead[i - 1] - ahead[i])
            found.append(points[i - 1] + part * (points[i] - points[i - 1]))
        if ahead[i] >= 0.0:
            found.append(points[i])
    return np.array(found).reshape(-1, 3)
