"""Lines coloured by how far a batten springs off their points, and the legend of the colours.

The colour of a point reaches half-way to the points beside it; where no batten is looked at, in
features and at the ends of lines, a line keeps its own pen. Classes are the same for all hulls of
a size, so pictures before and after fairing may be laid side by side.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal, Protocol, get_args

import attrs
import numpy as np

from assoc_hull.analysis.fairness.unfair_places import BattenJudgement, judge_battens
from assoc_hull.arguments import choice
from assoc_hull.edit.net_battens import net_battens
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.splines.segments import sample
from assoc_hull.model.address import AddressBook
from assoc_hull.model.tables import HullState
from assoc_hull.plot.lines_plan.drawing import (
    CHORDS,
    Drawable,
    Drawing,
    PlotLine,
    clipped,
    tables_of,
)
from assoc_hull.plot.sheet.paper import LINE, Pen
from assoc_hull.plot.sheet.sheet_figure import Sheet

__all__ = ["BattenHeat", "HeatName", "OnPaper", "batten_heat"]

HeatName = Literal["residual", "ratio"]
"""How far the batten springs, mm; or how far from the lines beside, over the usual."""

_EDGES = {"residual": (0.3, 1.0, 3.0, 10.0, 30.0), "ratio": (0.5, 1.0, 2.0, 3.0, 6.0)}
"""Between classes: mm for a ship of 100 m and more; times the usual, of which 3 is unfair."""

_COLOURS = ("#a9c4dc", "#5b9bd0", "#2f9e6e", "#e0a100", "#e2571e", "#a3001e")
_WIDTHS = (0.22, 0.3, 0.38, 0.5, 0.62, 0.74)  # wider where it is more: it is read without colours
_TITLES = {
    "residual": "Batten residual (how far it springs off), mm",
    "ratio": "Batten residual against lines beside, over the usual",
}
_FEET = {
    "residual": "Not coloured: not judged (ends, features).",
    "ratio": "More than 3: unfair. Not coloured: too few lines beside.",
}
_WIDE, _TALL = 11.0, 3.2  # of a swatch of the legend, mm at A3


class OnPaper(Protocol):
    """What takes points of a hull onto a sheet: a view, or the panel of one line."""

    @property
    def name(self) -> str:
        """Its name, in ids."""

    def on_paper(self, xyz: FloatArray) -> FloatArray:
        """Give points (k, 3), m, on the sheet, (k, 2), mm."""


@attrs.frozen(eq=False)
class BattenHeat:
    """The class of each chord of lines, by name; and what the classes are.

    Attributes
    ----------
    kind : "residual" or "ratio"
        What is coloured.
    edges : tuple of float
        Between classes, in the order of their colours.
    chords : mapping of str to tuple of (n,) int
        By line, for the polyline of each curve the class of each chord; -1 for none.
    points : mapping of str to tuple of (n, 3), m
        Those polylines.
    """

    kind: HeatName
    edges: tuple[float, ...]
    chords: Mapping[str, tuple[IntArray, ...]]
    points: Mapping[str, tuple[FloatArray, ...]]

    def draw(self, sheet: Sheet, view: OnPaper, line: PlotLine, plan: Drawing) -> None:
        """Draw the colours of a line over it, as far as the drawing's window reaches."""
        low, high = plan.window or (-np.inf, np.inf)
        strokes: list[list[FloatArray]] = [[] for _ in _COLOURS]
        for points, classes in zip(self.points[line.name], self.chords[line.name], strict=True):
            for piece, chord in clipped(points, low, high):
                mine = classes[chord]
                paper = view.on_paper(piece)
                turn = np.flatnonzero(np.diff(mine)) + 1
                for begin, end in zip([0, *turn], [*turn, len(mine)], strict=True):
                    if mine[begin] >= 0:
                        strokes[mine[begin]] += [paper[begin : end + 1], np.full((1, 2), np.nan)]
        for number, found in enumerate(strokes):
            if found:
                pen = Pen(_WIDTHS[number], _COLOURS[number], over=2.8 + 0.1 * number)
                sheet.line(np.concatenate(found), pen, f"heat {number}/{view.name}/{line.name}")

    def legend(self, sheet: Sheet, place: tuple[float, float]) -> None:
        """Draw the colours in a row, with the limits between them; left upper corner, mm."""
        factor, x = sheet.paper.factor, place[0]
        title = sheet.text(place, _TITLES[self.kind], across="left", up="top", name="label/heat")
        sheet.take(title)
        low = sheet.box(title)[1] - (1.2 + _TALL) * factor
        for number, colour in enumerate(_COLOURS):
            left, right = (x + (number + i) * _WIDE * factor for i in (0, 1))
            ring = np.array([(left, low), (right, low), (right, low + _TALL * factor),
                             (left, low + _TALL * factor), (left, low)])  # fmt: skip
            sheet.axes.fill(ring[:, 0], ring[:, 1], color=colour, linewidth=0.0, zorder=1.5)
            sheet.line(ring, LINE, f"legend/heat {number}")
        for number, edge in enumerate(self.edges):
            at = (x + (number + 1) * _WIDE * factor, low - 0.6 * factor)
            sheet.take(sheet.text(at, f"{edge:g}", up="top", name="label/heat/edge"))
        foot = (x, low - 3.6 * factor)
        sheet.take(sheet.text(foot, _FEET[self.kind], across="left", up="top", name="label/heat"))


def batten_heat(hull: Drawable, kind: HeatName) -> BattenHeat:
    """Find the colours of all lines of a hull.

    Raises
    ------
    BadInputError
        Another kind, or a drawing, which keeps no points.
    """
    choice(kind, "heat", get_args(HeatName), "in a picture")
    if isinstance(hull, Drawing):
        what = "a snapshot keeps lines, and not what their points may do"
        raise BadInputError(what, "in a picture with heat", "give the hull, or leave heat out")
    state = tables_of(hull)
    judged = judge_battens(state, net_battens(state))
    unit = 1.0
    value = judged.ratio
    if kind == "residual":
        # of a boat of 10 m a batten springs by a tenth of what it does on a ship of 100 m
        unit = min(1.0, 10.0 ** float(np.floor(np.log10(0.01 * state.particulars.length))))
        value = 1e3 * np.abs(judged.problem.residual)
    edges = tuple(float(f"{unit * each:.3g}") for each in _EDGES[kind])
    number = np.searchsorted(edges, value, side="right")
    if kind == "ratio":
        number = np.where(np.isfinite(judged.usual), number, -1)
    return _laid_out(state, judged, number, kind, edges)


def _laid_out(
    state: HullState, judged: BattenJudgement, number: IntArray, kind: HeatName,
    edges: tuple[float, ...],
) -> BattenHeat:  # fmt: skip
    """Give the classes of residuals (r,) to the chords beside their points."""
    book, problem = AddressBook(state), judged.problem
    chords: dict[str, tuple[IntArray, ...]] = {}
    places: dict[str, tuple[FloatArray, ...]] = {}
    for line in state.live("lines").tolist():
        found, drawn = list[IntArray](), list[FloatArray]()
        for curve in state.curves_of(line):
            rows = state.curves.rows.data[curve]
            mine = np.flatnonzero(problem.curve == curve)
            at, order = np.full(len(rows), -1), np.argsort(rows)
            at[order[np.searchsorted(rows[order], problem.centre[mine])]] = number[mine]
            nearer = np.stack([at[:-1], at[1:]], axis=1)
            found.append(np.repeat(nearer.ravel(), CHORDS // 2))
            drawn.append(sample(state.spline(curve), CHORDS)[1])
        name = book.line_name(line)
        chords[name], places[name] = tuple(found), tuple(drawn)
    return BattenHeat(kind, edges, chords, places)
