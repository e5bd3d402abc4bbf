"""The straight lines of a lines plan, what they are called, the title and the frame."""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.geometry.numeric.interval_spacing import spread
from assoc_hull.io.dxf.lines import SplineLine
from assoc_hull.io.dxf.plan_layout import PlanLayout
from assoc_hull.io.dxf.plan_sheet import PlanSheet
from assoc_hull.model.state import HullState

__all__ = ["draw_grid"]

_OVER = 1.5
"""Straight lines leave the views by so many letters."""

_PITCH = 1.25
"""Least distance of names in a row, in letters."""

_CAPTIONS = {"profile": "PROFILE", "half-breadth": "HALF-BREADTH PLAN", "fore body": "BODY PLAN"}
_HALVES = (("AFT BODY", -0.5), ("FORE BODY", 0.5))

_DROP = 9.0
"""Captions lie so many letters below their views, below the names of straight lines."""

Mark = tuple[str, float]
"""A name and the place that it marks, m."""


def draw_grid(
    sheet: PlanSheet, state: HullState, lines: Sequence[SplineLine], plan: PlanLayout
) -> None:
    """Draw stations, waterlines and buttocks where they are straight, axes, names and title.

    Parameters
    ----------
    sheet : PlanSheet
        Where to draw.
    state : HullState
        Tells the particulars.
    lines : sequence of SplineLine
        The lines of the hull.
    plan : PlanLayout
        Where the views lie.
    """
    stations, buttocks, levels = (_marks(lines, axis) for axis in range(3))
    ship, low, high = state.particulars, plan.low.tolist(), plan.high.tolist()
    along = [("AP", 0.0), ("Lpp/2", plan.middle), ("FP", ship.length)]
    heights = [("base line", 0.0), (f"DWL {ship.draught:g}", ship.draught)]
    grid = _Grid(sheet, plan)
    grid.upright("profile", stations, (low[2], high[2]), along)
    grid.level("profile", levels, (low[0], high[0]), heights)
    grid.upright("half-breadth", stations, (0.0, high[1]), along)
    grid.level("half-breadth", buttocks, (low[0], high[0]), [("centre line", 0.0)])
    sides = [(name, sign * place) for sign in (-1.0, 1.0) for name, place in buttocks]
    grid.upright("fore body", sides, (low[2], high[2]), [("CL", 0.0)])
    grid.level("fore body", levels, (-high[1], high[1]), heights)
    grid.captions()
    grid.title(state)


def _marks(lines: Sequence[SplineLine], axis: int) -> list[Mark]:
    """Give names and places of the lines across an axis, without boundary curves."""
    found = [each for each in lines if each.axis == axis and each.family != "boundary"]
    return [(each.name, each.place) for each in found]


@attrs.frozen
class _Grid:
    """Draws the straight lines of the views."""

    sheet: PlanSheet
    plan: PlanLayout

    def upright(
        self, name: str, marks: Sequence[Mark], reach: tuple[float, float], axes: Sequence[Mark]
    ) -> None:
        """Draw upright lines of a view from low to high, named in a row below; axes above."""
        x, y = self.plan.view(name).origin
        over = _OVER * self.plan.letter
        low, high = y + reach[0] - over, y + reach[1] + over
        for _, place in marks:
            self.sheet.rule((x + place, low), (x + place, high), "grid")
        for words, place in axes:
            self.sheet.rule((x + place, low), (x + place, high), "axes", chain=True)
            self.sheet.text((x + place, high + 0.3 * over), words, "above")
        for words, at in self._row(marks):
            self.sheet.text((x + at, low - 0.3 * over), words, "left", size=0.8, angle=90.0)

    def level(
        self, name: str, marks: Sequence[Mark], reach: tuple[float, float], axes: Sequence[Mark]
    ) -> None:
        """Draw level lines of a view from left to right, named on the left; axes on the right."""
        x, y = self.plan.view(name).origin
        over = _OVER * self.plan.letter
        left, right = x + reach[0] - over, x + reach[1] + over
        for _, place in marks:
            self.sheet.rule((left, y + place), (right, y + place), "grid")
        for _, place in axes:
            self.sheet.rule((left, y + place), (right, y + place), "axes", chain=place == 0.0)
        for words, at in self._row(marks):
            self.sheet.text((left - 0.3 * over, y + at), words, "left", size=0.8)
        for words, at in self._row(axes):
            self.sheet.text((right + 0.3 * over, y + at), words, "right", size=0.8)

    def _row(self, marks: Sequence[Mark]) -> list[Mark]:
        """Give names with places moved apart, as little as possible."""
        wanted = np.array([place for _, place in marks])
        pitch = np.full(len(marks), 0.8 * _PITCH * self.plan.letter)
        names = [words for words, _ in marks]
        return list(zip(names, spread(wanted, pitch).tolist(), strict=True))

    def captions(self) -> None:
        """Write what the views are."""
        drop, (_, breadth, top) = _DROP * self.plan.letter, self.plan.high.tolist()
        for name, words in _CAPTIONS.items():
            x, y = self.plan.view(name).origin
            low = -self.plan.depth if name == "half-breadth" else float(self.plan.low[2])
            place = (x if name == "fore body" else self.plan.middle, y + low - drop)
            self.sheet.text(place, words, size=1.4, layer="title")
        x, y = self.plan.view("fore body").origin
        for words, share in _HALVES:
            place = (x + share * breadth, y + top + 2.0 * self.plan.letter)
            self.sheet.text(place, words, "above", layer="title")

    def title(self, state: HullState) -> None:
        """Write name and particulars to the right of the body plan, and draw the frame."""
        ship, letter = state.particulars, self.plan.letter
        (left, low), (right, high) = self.plan.frame.tolist()
        corners = [(left, low), (right, low), (right, high), (left, high)]
        for start, end in zip(corners, [*corners[1:], corners[0]], strict=True):
            self.sheet.rule(start, end, "frame")
        rows = (
            f"Length between perpendiculars {ship.length:g} m",
            f"Breadth {ship.breadth:g} m", f"Depth {ship.depth:g} m",
            f"Draught {ship.draught:g} m", f"Scale 1:{self.plan.scale:g}",
            "Moulded lines; x forward from AP, z upward from the base line",
        )  # fmt: skip
        x = self.plan.view("fore body").origin[0] + float(self.plan.high[1]) + self.plan.room
        y = high - 3.0 * letter
        self.sheet.text((x, y), ship.name or "Lines plan", "right", size=2.0, layer="title")
        for number, words in enumerate(rows, start=2):
            place = (x, y - 1.8 * number * letter)
            self.sheet.text(place, words, "right", layer="title")
