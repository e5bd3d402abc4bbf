"""What is drawn on the sheet of a lines plan: splines, the grid, names of lines, the title.

`PlanSheet` takes lengths in m and writes them in the unit of the drawing. `draw_grid` draws the
straight lines of the views, `label_lines` names each line where the others leave most room.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Literal

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.numeric.interval_spacing import space_intervals
from assoc_hull.geometry.patches.knots import bezier_pieces
from assoc_hull.geometry.splines.control_polygon import ControlPolygon
from assoc_hull.io.dxf.document import NAMES
from assoc_hull.io.dxf.lines import SplineLine
from assoc_hull.io.dxf.plan_layout import PlanLayout, PlanView
from assoc_hull.model.tables import HullState

__all__ = [
    "CHAIN",
    "PLACE",
    "VIEW_ORIGIN",
    "PlanSheet",
    "Side",
    "draw_grid",
    "label_lines",
]

# --------------------------------------------------------------------------------------
# The sheet.

VIEW_ORIGIN, PLACE = 1011, 1041
"""Codes of extended data that move, and grow, with their entity."""

CHAIN = "CHAIN"
"""Line type of axes: dash, dot."""

Side = Literal["left", "right", "middle", "above", "below"]
"""Where words lie beside the point they belong to."""


@attrs.frozen
class PlanSheet:
    """A drawing that is being made.

    Attributes
    ----------
    space : ezdxf model space
        Takes the entities.
    scale : float
        Units of the drawing in a metre.
    letter : float, m
        Height of letters.
    """

    space: Any
    scale: float
    letter: float

    def begin(self) -> None:
        """Define the line type of axes."""
        dash = self.letter * self.scale
        pattern = [6.0 * dash, 4.0 * dash, -0.8 * dash, 0.4 * dash, -0.8 * dash]
        self.space.doc.linetypes.add(CHAIN, pattern=pattern, description="long dash, short dash")

    def spline(self, line: SplineLine, curve: ControlPolygon, flat: FloatArray, layer: str) -> Any:
        """Add a curve by its control points in the drawing, (n, 2), m; named as its line."""
        spline = self.space.add_spline(degree=3, dxfattribs={"layer": layer})
        points = np.column_stack([flat * self.scale + 0.0, np.zeros(len(flat))])
        spline.control_points = points.tolist()
        spline.knots = curve.knots.tolist()
        spline.set_xdata(NAMES, [(1000, line.name), (1000, line.family)])
        return spline

    def place(self, entity: Any, line: SplineLine, view: PlanView) -> None:
        """Record with a curve from which view it can be read, and the place of its plane."""
        x, y = (float(each) * self.scale for each in view.origin)
        words: list[tuple[int, Any]] = [(1000, line.name), (1000, line.family), (1000, view.name)]
        words.append((VIEW_ORIGIN, (x, y, 0.0)))
        if line.axis is not None:
            words.append((PLACE, line.place * self.scale))
        entity.set_xdata(NAMES, words)

    def polyline(self, flat: FloatArray, layer: str, name: str = "", family: str = "") -> None:
        """Add straight lines between places, (n, 2), m."""
        added = self.space.add_lwpolyline(
            (flat * self.scale + 0.0).tolist(), dxfattribs={"layer": layer}
        )
        if name:
            added.set_xdata(NAMES, [(1000, name), (1000, family)])

    def rule(
        self, start: Sequence[float], end: Sequence[float], layer: str, *, chain: bool = False
    ) -> None:
        """Add a straight line between two places, m."""
        ends = [tuple(float(each) * self.scale + 0.0 for each in place) for place in (start, end)]
        look = {"layer": layer, "linetype": CHAIN} if chain else {"layer": layer}
        self.space.add_line(*ends, dxfattribs=look)

    def text(
        self,
        place: Sequence[float],
        words: str,
        side: Side = "middle",
        *,
        size: float = 1.0,
        angle: float = 0.0,
        layer: str = "labels",
    ) -> None:
        """Add words at a place, m; their height in letters, their angle in degrees."""
        from ezdxf.enums import TextEntityAlignment as Align

        aligned = {
            "left": Align.MIDDLE_RIGHT, "right": Align.MIDDLE_LEFT, "middle": Align.MIDDLE_CENTER,
            "above": Align.BOTTOM_CENTER, "below": Align.TOP_CENTER,
        }[side]  # fmt: skip
        look = {"layer": layer, "height": size * self.letter * self.scale, "rotation": angle}
        x, y = (float(each) * self.scale + 0.0 for each in place)
        self.space.add_text(words, dxfattribs=look).set_placement((x, y), align=aligned)


# --------------------------------------------------------------------------------------
# The grid, the title and the frame.

_OVER = 1.5
"""By how many letters straight lines leave the views."""

_PITCH = 1.25
"""Least distance of names in a row, in letters."""

_CAPTIONS = {"profile": "PROFILE", "half-breadth": "HALF-BREADTH PLAN", "fore body": "BODY PLAN"}
_HALVES = (("AFT BODY", -0.5), ("FORE BODY", 0.5))

_DROP = 9.0
"""How many letters captions lie below their views, below the names of straight lines."""

Mark = tuple[str, float]
"""A name and the place that it marks, m."""


def draw_grid(
    sheet: PlanSheet, state: HullState, lines: Sequence[SplineLine], plan: PlanLayout
) -> None:
    """Draw stations, waterlines and buttocks where they are straight, axes, names and title."""
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
        return list(zip(names, space_intervals(wanted, pitch).tolist(), strict=True))

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


# --------------------------------------------------------------------------------------
# Names of lines.

_SMALL = 0.7
"""Size of letters on lines."""

_PLACES = 160
"""Number of points of a line that are looked at."""

_WIDE = 0.75
"""Width of a letter, as a part of its height, with the space behind it."""

_NEIGHBOURS = 24
_CROWD = 3.0
"""More room than this many letters is no gain."""


@attrs.frozen(eq=False)
class _Course:
    """A line of a view at places along it, (n, 2), m, and its name."""

    words: str
    places: FloatArray


def label_lines(
    sheet: PlanSheet,
    drawn: Sequence[tuple[SplineLine, PlanView, ControlPolygon, FloatArray]],
) -> None:
    """Write the names of all lines, view by view; curves have control points (n, 2) there."""
    views: dict[str, list[_Course]] = {}
    for line, view, curve, flat in drawn:
        course = _Course(line.name, _along(curve, flat))
        views.setdefault(view.name, []).append(course)
    for name, courses in views.items():
        _label(sheet, courses, 0.6 * _SMALL if name.endswith("body") else _SMALL)


def _along(curve: ControlPolygon, flat: FloatArray) -> FloatArray:
    """Give places along a curve, about equally far apart."""
    polygons = bezier_pieces(flat, curve.knots, 3)
    share = np.linspace(0.0, 1.0, 9)[:, None, None, None]
    places = np.broadcast_to(polygons, (9, *polygons.shape))
    for _ in range(3):
        places = (1.0 - share) * places[:, :, :-1] + share * places[:, :, 1:]
    dense = places[:, :, 0].swapaxes(0, 1).reshape(-1, 2)
    way = np.append(0.0, np.cumsum(np.linalg.norm(np.diff(dense, axis=0), axis=1)))
    at = np.linspace(0.0, way[-1], _PLACES)
    return np.column_stack([np.interp(at, way, dense[:, i]) for i in range(2)])


def _label(sheet: PlanSheet, courses: list[_Course], size: float) -> None:
    """Write the names of one view: those with the least room first, each clear of the others."""
    letter = size * sheet.letter
    room = _rooms(courses, _CROWD * letter)
    taken = np.zeros((0, 3))
    order = sorted(range(len(courses)), key=lambda i: float(room[i].max()))
    for i in order:
        places, reach = courses[i].places, 0.5 * _WIDE * letter * (len(courses[i].words) + 1)
        apart = np.linalg.norm(places[:, None] - taken[None, :, :2], axis=2) - taken[:, 2] - reach
        clear = np.minimum(apart.min(axis=1, initial=np.inf), 0.0)
        # The middle of a line is preferred where there is room everywhere.
        off = np.abs(np.linspace(-1.0, 1.0, len(places))) * 0.2 * letter
        inner = slice(4, -4)
        best = int(np.argmax((room[i] + 3.0 * clear - off)[inner])) + 4
        step = places[best + 2] - places[best - 2]
        # Words are read from the left or, upright, from the right: -89 to 91 degrees.
        angle = (float(np.degrees(np.arctan2(step[1], step[0]))) + 89.0) % 180.0 - 89.0
        up = np.radians(angle + 90.0)
        place = places[best] + 0.2 * letter * np.array([np.cos(up), np.sin(up)])
        sheet.text(place.tolist(), courses[i].words, "above", size=size, angle=angle)
        taken = np.concatenate([taken, [[*place, reach]]])


def _rooms(courses: list[_Course], most: float) -> list[FloatArray]:
    """Give the distance from each point of each line to the nearest other line, m, up to `most`."""
    from scipy.spatial import cKDTree

    every = np.concatenate([each.places for each in courses])
    owner = np.repeat(np.arange(len(courses)), _PLACES)
    near = min(_NEIGHBOURS, len(every))
    found, index = cKDTree(every).query(every, k=[*range(1, near + 1)])
    distance = np.asarray(found)
    distance[owner[index] == owner[:, None]] = np.inf
    return np.split(np.minimum(distance.min(axis=1), most), len(courses))
