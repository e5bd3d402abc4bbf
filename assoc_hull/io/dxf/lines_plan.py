"""The lines plan as a DXF drawing: its views, what stands on its sheet, each line a spline.

A line in a plane is drawn in the view that shows its true shape, and a curve in space in profile
and half-breadth plan. Extended data tell name, family and view, where the origin of the view
lies and where the plane of the line: these move and grow with the entity in any program, so that
the drawing can be read back.

Views of a lines plan: which coordinates each shows, where it lies, how large letters are.

A drawing has the size of the ship, in m here; the scale counts for letters only. Profile and
half-breadth plan lie one above the other with the bow to the right, the body plan above them. The
views serve both the writer (`io.dxf.lines_plan`) and the reader (`io.dxf.read_lines_plan`).

What is drawn on the sheet of a lines plan: splines, the grid, names of lines, the title.

`PlanSheet` takes lengths in m and writes them in the unit of the drawing. `draw_grid` draws the
straight lines of the views, `label_lines` names each line where the others leave most room.

Examples
--------
>>> from assoc_hull.shipped.wigley import wigley
>>> from assoc_hull.io.reports import ExportBook
>>> from assoc_hull.io.dxf.lines_plan import plan_drawing
>>> plan_drawing(wigley(), ExportBook(9)).count("AcDbSpline")
33
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from types import MappingProxyType
from typing import Any, Literal

import attrs
import numpy as np

from assoc_hull.arguments import positive
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.numeric.interval_spacing import space_intervals
from assoc_hull.geometry.patches.knots import bezier_pieces
from assoc_hull.geometry.splines.control_polygon import ControlPolygon
from assoc_hull.io.dxf.lines import (
    NAMES,
    DxfLayer,
    SplineLine,
    drawing_text,
    layer_name,
    spline_lines,
)
from assoc_hull.io.lines.line_points import lines_as_points
from assoc_hull.io.reports import ExportBook
from assoc_hull.model.tables import HullState

__all__ = [
    "CHAIN",
    "PLACE",
    "VIEW_AXES",
    "VIEW_ORIGIN",
    "PlanLayout",
    "PlanSheet",
    "PlanView",
    "Side",
    "ViewAxes",
    "draw_grid",
    "label_lines",
    "lay_out",
    "plan_drawing",
    "views_of_line",
]

# --------------------------------------------------------------------------------------
# Views.


@attrs.frozen
class ViewAxes:
    """What a view shows: two coordinates, to the right and up, and which one not.

    Attributes
    ----------
    right, up, hidden : int
        The coordinates.
    sign : float
        -1 where the first one is counted to the left.
    """

    right: int
    up: int
    hidden: int
    sign: float = 1.0


VIEW_AXES: Mapping[str, ViewAxes] = MappingProxyType({
    "profile": ViewAxes(0, 2, 1),
    "half-breadth": ViewAxes(0, 1, 2),
    "fore body": ViewAxes(1, 2, 0),
    "aft body": ViewAxes(1, 2, 0, -1.0),
})  # fmt: skip
"""The views by name: bow to the right, fore body on the right."""


@attrs.frozen
class PlanView:
    """A view in its place.

    Attributes
    ----------
    name : str
        A key of `VIEW_AXES`.
    origin : (float, float)
        Where its origin lies in the drawing: base line, centre line, after perpendicular.
    """

    name: str
    origin: tuple[float, float]

    @property
    def shown(self) -> ViewAxes:
        """What it shows."""
        return VIEW_AXES[self.name]

    def flat(self, points: FloatArray) -> FloatArray:
        """Give points in the drawing, (n, 2), of points in space, (n, 3)."""
        shown = self.shown
        return np.column_stack([
            self.origin[0] + shown.sign * points[:, shown.right],
            self.origin[1] + points[:, shown.up],
        ])  # fmt: skip

    def in_space(self, flat: FloatArray, place: float | FloatArray) -> FloatArray:
        """Give points in space, (n, 3), of points in the drawing and the hidden coordinate."""
        shown, found = self.shown, np.empty((len(flat), 3))
        found[:, shown.right] = shown.sign * (flat[:, 0] - self.origin[0])
        found[:, shown.up] = flat[:, 1] - self.origin[1]
        found[:, shown.hidden] = place
        return found + 0.0


def views_of_line(axis: int | None, place: float, middle: float) -> tuple[str, ...]:
    """Give the views from which a line can be read: the one in true shape, or two.

    `axis` is the coordinate that is constant on it, None for curves in space, `place` (m) its
    value; aft and fore body join at `middle` (m).
    """
    if axis is None:
        return ("profile", "half-breadth")
    return ("aft body" if place < middle else "fore body", "profile", "half-breadth")[axis:][:1]


# --------------------------------------------------------------------------------------
# Layout.

_SCALES = (5, 10, 20, 25, 50, 75, 100, 150, 200, 250, 300, 400, 500, 750, 1000)
_WIDTH = 0.82
"""Room across a sheet of A1 inside its frame, m."""

_LETTER = 2.5e-3
"""Height of letters on paper, m."""

_ROOM = 14.0
"""Letters that fit between two views, one above the other, and between a view and the frame."""


@attrs.frozen(eq=False)
class PlanLayout:
    """A drawing of three views; all lengths in m at full size.

    Attributes
    ----------
    low, high : (3,), m
        Extent of the hull and the base line; y of one side.
    middle : float, m
        Half the length between perpendiculars.
    depth : float, m
        How far diagonals reach below the centre line.
    scale : float
        At which it is meant to be printed.
    """

    low: FloatArray
    high: FloatArray
    middle: float
    depth: float
    scale: float

    @property
    def letter(self) -> float:
        """Height of letters, m."""
        return _LETTER * self.scale

    @property
    def room(self) -> float:
        """Between views, m."""
        return _ROOM * self.letter

    @cached_property
    def views(self) -> tuple[PlanView, ...]:
        """The views: the profile lies at its true coordinates."""
        half = float(self.low[2] - self.room - self.high[1])
        body = (self.middle, float(self.high[2] + 1.5 * self.room - self.low[2]))
        return (
            PlanView("profile", (0.0, 0.0)), PlanView("half-breadth", (0.0, half)),
            PlanView("fore body", body), PlanView("aft body", body),
        )  # fmt: skip

    def view(self, name: str) -> PlanView:
        """Give a view by its name."""
        return next(each for each in self.views if each.name == name)

    @property
    def frame(self) -> FloatArray:
        """Lower left and upper right corner of the frame, (2, 2), m."""
        half, body = self.view("half-breadth").origin[1], self.view("fore body").origin[1]
        lower = [self.low[0] - self.room, half - self.depth - self.room]
        upper = [self.high[0] + self.room, body + self.high[2] + self.room]
        return np.array([lower, upper])


def lay_out(bounds: FloatArray, middle: float, depth: float, scale: float | None) -> PlanLayout:
    """Lay out a plan of lines between `bounds` (2, 3), m; `middle` is Lpp / 2.

    Diagonals reach `depth` (m) below the centre line. `scale` is a denominator, such as 200; None
    chooses one for a sheet of A1.

    Raises
    ------
    BadInputError
        A scale that is not positive.
    """
    low, high = np.minimum(bounds[0], 0.0), np.asarray(bounds[1])
    if scale is None:
        width = float(high[0] - low[0])
        fits = (each for each in _SCALES if width + 2.0 * _ROOM * _LETTER * each <= _WIDTH * each)
        scale = next(fits, _SCALES[-1])
    return PlanLayout(low, high, middle, depth, positive(scale, "scale", "in a lines plan"))


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


_COLOURS = {"boundary": 7, "sections": 5, "frames": 5, "waterlines": 94, "buttocks": 1}
_GRID = (DxfLayer("grid", 9, 9), DxfLayer("axes", 8, 13), DxfLayer("frame", 7, 35))
_WORDS = (DxfLayer("labels", 7, 13), DxfLayer("title", 7, 18))
_SMALLEST = 1e-6
"""A curve that looks no larger than this (m) in a view is not drawn there."""


@attrs.frozen(eq=False)
class _Drawn:
    """A curve in a view: its control points there, (n, 2), m, and whether it is read from it."""

    line: SplineLine
    curve: ControlPolygon
    view: PlanView
    flat: FloatArray
    home: bool

    @property
    def layer(self) -> str:
        """Its layer: view and group."""
        return layer_name(f"{self.view.name} {self.line.group}")


def plan_drawing(state: HullState, book: ExportBook, scale: float | None = None) -> str:
    """Give the text of a drawing with profile, half-breadth plan and body plan.

    Parameters
    ----------
    state : HullState
        The hull.
    book : ExportBook
        Tells the unit, "m" or "mm", and takes what was written.
    scale : float or None
        Denominator of the scale at which it is to be printed, such as 200; it changes letters,
        not lines. None fits a sheet of A1.

    Returns
    -------
    str
        DXF, R2000, at full size: a layer per view and group, grid, labels and title beside.

    Raises
    ------
    BadInputError, MissingExtraError
        A curve has failed, the hull has no lines, or the scale is not positive; ezdxf is not
        installed.
    """
    lines = spline_lines(state)
    plan = _layout(state, lines, scale)
    drawn = [each for line in lines for each in _in_views(line, plan)]
    book.lines, book.curves = len(lines), sum(len(line.curves) for line in lines)
    book.points = sum(len(each.flat) for each in drawn)
    body = list(_borders(state, plan))
    layers = {each.layer: each.line.family for each in drawn}
    layers |= {layer_name(f"{view.name} boundary"): "boundary" for view, _, _ in body}

    def draw(space: Any) -> None:
        sheet = PlanSheet(space, book.scale, plan.letter)
        sheet.begin()
        draw_grid(sheet, state, lines, plan)
        for view, name, flat in body:
            # Each half of the body plan shows half of a boundary curve: a cut polyline, no spline.
            sheet.polyline(flat, layer_name(f"{view.name} boundary"), name, "boundary")
        for each in drawn:
            added = sheet.spline(each.line, each.curve, each.flat, each.layer)
            # Only the view that a line is read back from tells where its plane lies.
            if each.home:
                sheet.place(added, each.line, each.view)
        label_lines(sheet, [(each.line, each.view, each.curve, each.flat) for each in drawn])

    looks = [
        DxfLayer(name, _COLOURS.get(family, 6), 30 if family == "boundary" else 18)
        for name, family in layers.items()
    ]
    return drawing_text([*_GRID, *_WORDS, *looks], draw, book.unit)


def _layout(state: HullState, lines: list[SplineLine], scale: float | None) -> PlanLayout:
    """Lay out the views around the lines: control points tell their extent, well enough."""
    every = np.concatenate([np.zeros((1, 3)), *(c.points for line in lines for c in line.curves)])
    depth = max(
        (float(_along_diagonal(line, curve.points).max()) for line in lines
         if line.family == "diagonals" for curve in line.curves), default=0.0,
    )  # fmt: skip
    bounds = np.stack([every.min(axis=0), every.max(axis=0)])
    return lay_out(bounds, 0.5 * state.particulars.length, depth, scale)


def _in_views(line: SplineLine, plan: PlanLayout) -> Iterator[_Drawn]:
    """Give the curves of a line in all views that show them as curves."""
    homes = () if line.family == "diagonals" else views_of_line(line.axis, line.place, plan.middle)
    for name in _shown_in(line, plan):
        view = plan.view(name)
        for curve in line.curves:
            flat = view.flat(curve.points)
            if line.family == "diagonals" and name == "half-breadth":
                flat[:, 1] = view.origin[1] - _along_diagonal(line, curve.points)
            if np.ptp(flat, axis=0).max() > _SMALLEST:
                yield _Drawn(line, curve, view, flat, name in homes)


def _shown_in(line: SplineLine, plan: PlanLayout) -> tuple[str, ...]:
    """Name the views of a line."""
    homes = views_of_line(line.axis, line.place, plan.middle)
    if line.family == "boundary" and line.axis != 1:
        return tuple(dict.fromkeys(("profile", "half-breadth", *homes)))
    if line.family == "diagonals":
        return ("half-breadth", "fore body", "aft body")
    if line.axis == 0 and line.place == plan.middle:
        return ("aft body", "fore body")
    return homes


def _along_diagonal(line: SplineLine, points: FloatArray) -> FloatArray:
    """Give the true breadth of a diagonal, along its plane from the centre line, (n,), m."""
    _, y, z = line.normal.tolist()
    start = line.offset / z if z else 0.0
    size = np.hypot(y, z) * (1.0 if z > 0.0 else -1.0)
    return np.asarray((points[:, 1] * z - (points[:, 2] - start) * y) / size)


def _borders(state: HullState, plan: PlanLayout) -> Iterator[tuple[PlanView, str, FloatArray]]:
    """Give boundary curves in the body plan: each half shows its half of the ship."""
    for line in lines_as_points(state, ("boundary",)):
        for piece in line.pieces:
            if np.ptp(piece.points[:, 1]) <= _SMALLEST or np.ptp(piece.points[:, 0]) <= _SMALLEST:
                continue
            for name, sign in (("aft body", -1.0), ("fore body", 1.0)):
                part = _clip(piece.points, plan.middle, sign)
                if len(part) > 1:
                    view = plan.view(name)
                    yield view, line.name, view.flat(part)


def _clip(points: FloatArray, middle: float, sign: float) -> FloatArray:
    """Give the part of a polyline before (sign 1) or abaft (-1) a station, in one run."""
    ahead = sign * (points[:, 0] - middle)
    crosses = np.flatnonzero(ahead[:-1] * ahead[1:] < 0.0)
    share = (ahead[crosses] / (ahead[crosses] - ahead[crosses + 1]))[:, None]
    cut = points[crosses] + share * (points[crosses + 1] - points[crosses])
    every = np.insert(points, crosses + 1, cut, axis=0)
    return every[np.insert(ahead >= 0.0, crosses + 1, True)]
