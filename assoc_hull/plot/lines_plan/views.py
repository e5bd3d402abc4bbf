"""The lines of the three views, and their labels."""

from __future__ import annotations

from collections.abc import Collection, Sequence

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.plot.lines_plan.drawing import Drawing, DrawnLine
from assoc_hull.plot.lines_plan.grid import Grid
from assoc_hull.plot.sheet.labels import Lettered, label_above, label_lines
from assoc_hull.plot.sheet.paper import Pen
from assoc_hull.plot.sheet.pens import pen_of
from assoc_hull.plot.sheet.rails import rail
from assoc_hull.plot.sheet.sheet import Sheet
from assoc_hull.plot.sheet.view import View

__all__ = ["Views", "body_halves"]

_NEAR = 1e-6
"""Planes within this distance (m) are the same."""


@attrs.frozen(eq=False)
class _Top:
    """Where a section ends at the head of the body plan: label, place (2,), mm, and rank."""

    label: str
    place: FloatArray
    order: tuple[float, float]


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
    def grid(self) -> Grid:
        """Draws the straight lines."""
        return Grid(self.sheet, self.drawing, self.low, self.high)

    @property
    def sections(self) -> tuple[DrawnLine, ...]:
        """The sections; the frames of a hull that has no sections."""
        return self.grid.sections

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
        self.grid.stations(view, self.low[2], self.high[2])
        self.grid.perpendiculars(view, self.low[2], self.high[2])
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
        self.grid.levels(view, self.low[0], self.high[0])

    @property
    def middle_height(self) -> float:
        """Half the height of the hull, m."""
        return float(0.5 * (self.low[2] + self.high[2]))

    def half_breadth(self, view: View) -> None:
        """Draw the half-breadth plan: waterlines, boundaries; diagonals below the centre line."""
        self.grid.stations(view, 0.0, self.high[1])
        self.grid.perpendiculars(view, 0.0, self.high[1])
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
        top = view.up(self.high[1]) + 3.5 * self.sheet.paper.factor
        label_above(self.sheet, lettered, wanted, top, "label/half-breadth/above")
        self.grid.lanes(view, self.low[0], self.high[0])

    def _along_grid(self, line: DrawnLine) -> bool:
        """Whether a line is straight along the ship when seen from above."""
        return bool(abs(line.normal[1]) == 1.0)

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
        tops: list[_Top] = []
        for half, sections in zip(
            (view.mirrored(), view), body_halves(self.sections, self.middle), strict=True
        ):
            tops += self._half_body(half, sections)
            for line in self.drawing.of("boundary"):
                if line is not self.drawing.profile:
                    self._half_boundary(half, line)
            for line in self.drawing.of("diagonals"):
                self.draw(half, line)
        tops.sort(key=lambda top: top.order)
        above = view.up(self.high[2]) + 5.5 * self.sheet.paper.factor
        rail(
            self.sheet, np.array([top.place for top in tops]).reshape(-1, 2),
            [top.label for top in tops], "above", above, upright=True,
            heading="ST", name="label/body/top",
        )  # fmt: skip
        self.grid.body(view)

    def _half_body(self, view: View, sections: Sequence[DrawnLine]) -> list[_Top]:
        """Draw the sections of one half, labelled on the lines; give their tops."""
        tops, lettered = [], []
        for line in sections:
            found = [points for points in self.draw(view, line) if len(points)]
            lettered += [Lettered(line.label, points) for points in found]
            if found:
                # Of a section in several pieces the highest reaches the deck.
                every = np.concatenate(found)
                place = every[np.argmax(every[:, 1])]
                # Those that end at one place: midship outermost.
                inward = -view.sign * abs(line.offset - self.middle)
                tops.append(_Top(line.label, place, (round(float(place[0]), 2), inward)))
        low, edge = view.up(self.low[2]), view.up(self.high[2])
        part = "aft" if view.sign < 0.0 else "fore"
        label_lines(self.sheet, lettered, low, edge, axis=1, name=f"label/body/on {part}")
        return tops

    def _half_boundary(self, view: View, line: DrawnLine) -> None:
        """Draw what of a boundary lies abaft (mirrored) or before the middle."""
        pen = pen_of(line, line.name in self.tinted)
        for points in line.polylines:
            part = _clip(points, self.middle, view.sign)
            if len(part) > 1:
                self.sheet.line(view.on_paper(part), pen, f"body/boundary/{line.name}")


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
