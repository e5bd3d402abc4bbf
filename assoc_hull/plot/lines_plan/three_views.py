"""The three views of a hull: where they lie on a sheet, their straight lines, curves and labels.

The half-breadth plan lies below the profile on the same scale, aligned in x; above both lies the
body plan on its own, larger scale, beside the block of particulars. The bow is to the right;
the fore body stands right of the centre line of the body plan, the aft body left of it.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.plot.lines_plan.batten_heat import BattenHeat
from assoc_hull.plot.lines_plan.drawing import (
    Drawing,
    PlotLine,
    clipped,
    drawn_outlines,
    outside_mouths,
    pen_of,
)
from assoc_hull.plot.sheet.labels import LabelledLine, Side, label_above, label_lines, label_row
from assoc_hull.plot.sheet.paper import AXIS, GRID, HEAVY, MARGIN, WATER, Paper, Pen, View, scale_of
from assoc_hull.plot.sheet.sheet_figure import Sheet
from assoc_hull.plot.sheet.title_block import BLOCK

__all__ = [
    "Grid",
    "ViewLayout",
    "Views",
    "body_halves",
    "body_sides",
    "extent",
    "lay_out_views",
    "scale_of_body",
]

# --------------------------------------------------------------------------------------
# Where the three views lie on a sheet, and at which scales.

_SIDE = 17.0  # for labels left and right of a view
_ABOVE, _BELOW, _CAPTION = 9.0, 9.0, 7.0
_ABOVE_HALF = 6.5
_BODY_ABOVE, _BODY_BELOW = 15.0, 12.0
_BESIDE = 128.0  # for block, scale bars and legend below the body plan of a stretch


@attrs.frozen
class ViewLayout:
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


def lay_out_views(drawing: Drawing, paper: Paper) -> ViewLayout:
    """Choose scales and places for a lines plan.

    The half-breadth plan lies below the profile on the same scale, aligned in x; above both
    lies the body plan on its own, larger scale, beside the block of particulars.
    """
    if drawing.window is not None:
        return _lay_out_stretch(drawing, paper)
    factor = paper.factor
    low, high = extent(drawing)
    length, breadth, height = (high - low).tolist()
    depth = _diagonal_reach(drawing)
    frame = MARGIN * factor
    bands = (_ABOVE_HALF + _ABOVE + 2.0 * (_BELOW + _CAPTION)) * factor
    scale = scale_of(length, paper.width - 2.0 * frame - 2.0 * _SIDE * factor)
    unit = 1e3 / scale
    lower = unit * (height + breadth + depth) + bands
    room = paper.height - 2.0 * frame - lower
    body_room = (
        paper.width - 2.0 * frame - BLOCK * factor - 2.0 * _SIDE * factor,
        room - (_BODY_ABOVE + _BODY_BELOW + _CAPTION) * factor,
    )
    body_scale = min(scale, scale_of_body(breadth, height, body_room))
    spare = room - height * 1e3 / body_scale - (_BODY_ABOVE + _BODY_BELOW + _CAPTION) * factor
    gap = max(spare, 0.0) / 4.0
    x = 0.5 * (paper.width - unit * length) - unit * low[0]
    y = frame + gap + (_CAPTION + _BELOW) * factor + unit * depth
    z = y + unit * breadth + gap + (_ABOVE_HALF + _CAPTION + _BELOW) * factor - unit * low[2]
    top = z + unit * high[2] + _ABOVE * factor
    middle = 0.5 * (paper.width - BLOCK * factor)
    base = top + gap + (_CAPTION + _BODY_BELOW) * factor - low[2] * 1e3 / body_scale
    return ViewLayout(
        View("profile", (0, 2), scale, (x, z)),
        View("half-breadth", (0, 1), scale, (x, y)),
        View("body", (1, 2), body_scale, (middle, base)),
        low, high, depth, (paper.width - frame, paper.height - frame),
    )  # fmt: skip


def _lay_out_stretch(drawing: Drawing, paper: Paper) -> ViewLayout:
    """Choose scales and places for a stretch of a hull, which is about as long as it is high.

    The body plan stands right of the profile, both on one base; the half-breadth plan below the
    profile. The block has its place below the body plan, or right of it, where more room is left.
    """
    factor, frame = paper.factor, MARGIN * paper.factor
    low, high = extent(drawing)
    length, breadth, height = (high - low).tolist()
    depth, halves = _diagonal_reach(drawing), body_sides(drawing)
    body = len(halves) * breadth
    tall, wide = paper.height - 2.0 * frame, paper.width - 2.0 * frame - 4.0 * _SIDE * factor
    heads = (_BODY_ABOVE + _BODY_BELOW + _CAPTION) * factor
    bands = heads + (_ABOVE_HALF + _BELOW + 2.0 * _CAPTION) * factor
    lower = scale_of(height + breadth + depth, tall - bands)
    below = max(
        scale_of(length + body, wide), lower,
        scale_of(height, max(tall - heads - _BESIDE * factor, 1.0)),
    )  # fmt: skip
    beside = max(scale_of(length + body, wide - BLOCK * factor), lower)
    scale = min(below, beside)
    unit = 1e3 / scale
    gap = (tall - bands - unit * (height + breadth + depth)) / 4.0
    top = paper.height - frame - _BODY_ABOVE * factor - unit * height
    base = top - gap
    if below <= beside:
        base = max(base, frame + _BESIDE * factor + (_BODY_BELOW + _CAPTION) * factor)
        corner = (paper.width - frame, base - (_BODY_BELOW + _CAPTION) * factor)
        room = wide
    else:
        corner = (paper.width - frame, paper.height - frame)
        room = wide - BLOCK * factor
    spare = (room - unit * (length + body)) / 3.0
    left = frame + _SIDE * factor + spare
    right = left + unit * length + 2.0 * _SIDE * factor + spare
    if below <= beside:
        # no wider to the right than the block, which lies below
        right = min(right, corner[0] - _SIDE * factor - unit * body)
    x, z = left - unit * low[0], base - unit * low[2]
    y = base - (bands - heads) - gap - unit * breadth
    middle = right + (unit * breadth if -1.0 in halves else 0.0)
    return ViewLayout(
        View("profile", (0, 2), scale, (x, z)),
        View("half-breadth", (0, 1), scale, (x, y)),
        View("body", (1, 2), scale, (middle, z)),
        low, high, depth, corner,
    )  # fmt: skip


def body_sides(drawing: Drawing) -> tuple[float, ...]:
    """Give the halves of the body plan that a drawing fills: -1 is the aft body, 1 the fore."""
    middle = 0.5 * drawing.particulars.length
    if drawing.window is None:
        return -1.0, 1.0
    aft, fore = drawing.window
    return (*((-1.0,) if aft < middle else ()), *((1.0,) if fore > middle else ()))


def extent(*drawings: Drawing) -> tuple[FloatArray, FloatArray]:
    """Give least and greatest coordinates of drawings of one window, (3,), m.

    The centre plane and the base line are in; where the lines are whole, the AP too.
    """
    low, high = np.stack([each.bounds for each in drawings]).transpose(1, 0, 2)
    whole = drawings[0].window is None
    return np.minimum(low.min(axis=0), [0.0 if whole else np.inf, 0.0, 0.0]), high.max(axis=0)


def scale_of_body(breadth: float, height: float, room: tuple[float, float]) -> float:
    """Give the scale of a body plan: both halves side by side, within a width and height, mm."""
    return max(scale_of(2.0 * breadth, room[0]), scale_of(height, max(room[1], 1.0)))


def _outer_ends(lines: Sequence[PlotLine]) -> dict[str, tuple[float, float, float]]:
    """Give by name the place of each line that is farthest from the centre plane, m."""
    found = dict[str, tuple[float, float, float]]()
    for line in lines:
        if len(line.points):
            x, y, z = line.points[np.argmax(line.points[:, 1])].tolist()
            found[line.name] = (x, y, z)
    return found


def _diagonal_reach(drawing: Drawing) -> float:
    """Give the greatest breadth along the diagonals' planes, m."""
    reach = [0.0]
    for line in drawing.of("diagonals"):
        points = line.points
        if len(points):
            start = line.offset / line.normal[2] if line.normal[2] else 0.0
            reach.append(float(np.hypot(points[:, 1], points[:, 2] - start).max()))
    return max(reach)


# --------------------------------------------------------------------------------------
# The straight lines of the three views, with their labels.

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
    def sections(self) -> tuple[PlotLine, ...]:
        """The sections; the frames of a hull that has no sections."""
        return self.drawing.of("sections") or self.drawing.of("frames")

    def body(self, view: View) -> None:
        """Draw waterlines and buttocks as straight lines, labelled at their ends."""
        factor, breadth = self.sheet.paper.factor, float(self.high[1])
        sides = body_sides(self.drawing)
        ends = [breadth * min(*sides, 0.0), breadth * max(*sides, 0.0)]
        left, right = view.across(ends[0]) - self.over, view.across(ends[1]) + self.over
        self._level_lines(view, left, right)
        low, high = view.up(self.low[2]) - self.over, view.up(self.high[2]) + self.over
        below = low - 2.0 * factor
        feet, words = [], []
        for line in self.drawing.of("buttocks"):
            for half in (attrs.evolve(view, sign=side) for side in reversed(sides)):
                x = half.across(line.offset)
                self.sheet.rule((x, low), (x, high), GRID, f"body/grid/{line.name}")
                feet.append([x, low])
                words.append(line.label)
        label_row(
            self.sheet, np.array(feet).reshape(-1, 2), words, "below", below,
            heading="BTK", name="label/body/buttocks",
        )  # fmt: skip
        self.sheet.rule((view.across(0.0), low), (view.across(0.0), high), AXIS, "body/grid/CL")
        for edge in (each for each in ends if each):
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
        label_row(
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
        """Label waterlines by name on the left; design waterline and base line on the right.

        In the body plan diagonals, too, at their outer ends: on the lines sections leave no room.
        """
        draught = self.drawing.particulars.draught
        marks = [(0.0, "base line"), (draught, "DWL")]
        if side == "left":
            marks = [(line.offset, line.name) for line in self.drawing.of("waterlines")]
        places = [(end, view.up(height)) for height, _ in marks]
        words = [name for _, name in marks]
        if view.name == "body" and (side == "right") == (1.0 in body_sides(self.drawing)):
            half = view if side == "right" else view.mirrored()
            outer = _outer_ends(self.drawing.of("diagonals"))
            places += [(half.across(y), half.up(z)) for _, y, z in outer.values()]
            words += list(outer)
        ends = np.array(places).reshape(-1, 2)
        off = (2.5 if side == "right" else -2.5) * self.sheet.paper.factor
        name, sparse = f"label/{view.name}/{side}", side == "left" and self._sparse(view)
        label_row(self.sheet, ends, words, side, end + off, sparse=sparse, name=name)

    def _sparse(self, view: View) -> bool:
        """Whether names may be left out where they have no room: the body plan has all."""
        return view.name != "body" or self.drawing.window is not None

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
        label_row(self.sheet, ends, words, "left", at, sparse=True, name=f"label/{view.name}/left")

    def perpendiculars(self, view: View, low: float, high: float) -> None:
        """Draw both perpendiculars and the middle between them, named in a row below."""
        factor, length = self.sheet.paper.factor, self.drawing.particulars.length
        bottom, top = view.up(low) - self.over, view.up(high) + self.over
        for x, words in ((0.0, "AP"), (0.5 * length, "Lpp/2"), (length, "FP")):
            if not self.drawing.shows(x):
                continue
            at = view.across(x)
            self.sheet.rule((at, bottom), (at, top), AXIS, f"{view.name}/grid/{words}")
            text = self.sheet.text(
                (at, bottom - 5.2 * factor), words, up="top", name=f"label/{view.name}/{words}"
            )
            self.sheet.take(text)


# --------------------------------------------------------------------------------------
# The lines of the three views, and their labels.

_NEAR = 1e-6
"""Planes within this distance (m) are the same."""

_MOUTH = Pen(0.22, over=2.6)
"""Of the mouth of a tunnel."""

_BODY = Pen(0.18, over=2.5)
"""Of the outlines of a body beside the net."""


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
    def sections(self) -> tuple[PlotLine, ...]:
        """The sections; the frames of a hull that has no sections."""
        return self.grid.sections

    @property
    def middle(self) -> float:
        """Half the length between perpendiculars, m."""
        return 0.5 * self.drawing.particulars.length

    def draw(self, view: View, line: PlotLine, pen: Pen | None = None) -> list[FloatArray]:
        """Draw a line in a view; give its polylines on the sheet, whole where a mouth cuts them."""
        used = pen or pen_of(line, line.name in self.tinted)
        name = f"{view.name}/{line.family}/{line.name}"
        for points in line.polylines:
            self._on_shell(view, line, points, used, name)
        return [view.on_paper(points) for points in line.polylines]

    def _on_shell(
        self, view: View, line: PlotLine, points: FloatArray, pen: Pen, name: str
    ) -> None:
        """Draw a polyline but for what lies in a mouth; the profile is no part of the shell."""
        mouths = () if line is self.drawing.profile else self.drawing.mouths
        for part in outside_mouths(points, mouths):
            self.sheet.line(view.on_paper(part), pen, name)

    def mouths(self, view: View) -> None:
        """Draw the mouths of tunnels; in the profile they have their names."""
        for each in self.drawing.mouths:
            half = view
            if view.name == "body":
                half = view if each.x >= self.middle else view.mirrored()
            lines = [each.points]
            if self.drawing.window is not None:
                lines = [part for part, _ in clipped(each.points, *self.drawing.window)]
            for points in lines:
                self.sheet.line(half.on_paper(points), _MOUTH, f"{view.name}/tunnels/{each.name}")
            if view.name == "profile" and self.drawing.shows(each.x):
                over = view.up(each.z + each.radius) + 0.8 * self.sheet.paper.factor
                self.sheet.text(
                    (view.across(each.x), over), each.name, up="bottom", halo=True,
                    name=f"label/profile/tunnels/{each.name}",
                )  # fmt: skip

    def bodies(self, view: View) -> None:
        """Draw the outlines of bodies beside the net; in the profile they have their names."""
        low, high = self.drawing.window or (-np.inf, np.inf)
        for each in self.drawing.bodies:
            middle = each.points.reshape(-1, 3).mean(axis=0)
            name = f"{each.group}/{each.name}"
            halves = [(view, low, high)]
            if view.name == "body":
                # What stands abaft the middle belongs to the aft body, the rest to the fore body.
                aft, fore = min(high, self.middle), max(low, self.middle)
                halves = [(view.mirrored(), low, aft), (view, fore, high)]
            for points in drawn_outlines(each):
                for half, first, last in halves:
                    for part, _ in clipped(points, first, last):
                        self.sheet.line(half.on_paper(part), _BODY, f"{view.name}/{name}")
            if view.name == "profile" and self.drawing.shows(middle[0]):
                over = view.up(float(each.points[..., 2].max())) + 0.8 * self.sheet.paper.factor
                self.sheet.text(
                    (view.across(middle[0]), over), each.name, up="bottom", halo=True,
                    name=f"label/profile/{name}",
                )  # fmt: skip

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
                # where a stretch cuts a line off, its name stands at the other end, if that is up
                tops = [end for end in tops if not self._cut_off(view, end)] or tops
                ends += tops
                words += [line.label] * len(tops)
        top = view.up(self.high[2]) + 3.2 * self.sheet.paper.factor
        above = np.array(ends).reshape(-1, 2)
        label_row(
            self.sheet, above, words, "above", top,
            upright=True, heading="BTK", name="label/profile/buttocks",
        )  # fmt: skip
        self.grid.levels(view, self.low[0], self.high[0])
        self.mouths(view)
        self.bodies(view)

    def _cut_off(self, view: View, end: FloatArray) -> bool:
        """Whether the window of the drawing ends a line there, mm on paper."""
        return any(abs(end[0] - view.across(x)) < 1e-6 for x in self.drawing.window or ())

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
                lettered += [LabelledLine(label, points, line.name) for points in found]
        self._diagonals(view)
        along = (self.low[0], self.high[0], self.drawing.middle)
        start, end, middle = (view.across(x) for x in along)
        wanted = {line.label for line in lettered}
        for low, high, part in ((start, middle, "aft"), (middle, end, "fore")):
            wanted -= label_lines(
                self.sheet, lettered, low, high, name=f"label/half-breadth/{part}"
            )
        top = view.up(self.high[1]) + 3.5 * self.sheet.paper.factor
        label_above(self.sheet, lettered, wanted, top, "label/half-breadth/above")
        self.grid.lanes(view, self.low[0], self.high[0])
        self.mouths(view)
        self.bodies(view)

    def _along_grid(self, line: PlotLine) -> bool:
        """Whether a line is straight along the ship when seen from above."""
        return bool(abs(line.normal[1]) == 1.0)

    def _diagonals(self, view: View) -> None:
        """Draw diagonals in true breadth along their planes, mirrored below, each with its name."""
        lettered = list[LabelledLine]()
        for line in self.drawing.of("diagonals"):
            start = line.offset / line.normal[2] if line.normal[2] else 0.0
            pen = pen_of(line, line.name in self.tinted)
            name = f"{view.name}/{line.family}/{line.name}"
            whole = (
                part
                for each in line.polylines
                for part in outside_mouths(each, self.drawing.mouths)
            )
            for points in whole:
                true = points.copy()
                true[:, 1] = -np.hypot(points[:, 1], points[:, 2] - start)
                paper_points = view.on_paper(true)
                self.sheet.line(paper_points, pen, name)
                lettered.append(LabelledLine(line.name, paper_points))
        start, end = view.across(self.low[0]), view.across(self.high[0])
        name = "label/half-breadth/diagonals"
        written = label_lines(self.sheet, lettered, start, end, name=name)
        deepest = {each.label: each.points[np.argmin(each.points[:, 1])] for each in lettered}
        left = [label for label in deepest if label not in written]
        below = view.up(-_diagonal_reach(self.drawing)) - 2.5 * self.sheet.paper.factor
        ends = np.array([deepest[label] for label in left]).reshape(-1, 2)
        label_row(self.sheet, ends, left, "below", below, name=name)

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
        label_row(
            self.sheet, np.array([top.place for top in tops]).reshape(-1, 2),
            [top.label for top in tops], "above", above, upright=True,
            heading="ST", name="label/body/top",
        )  # fmt: skip
        self.grid.body(view)
        self.mouths(view)
        self.bodies(view)

    def heat(self, layout: ViewLayout, colours: BattenHeat) -> None:
        """Colour the lines of all three views."""
        for view, families in (
            (layout.profile, ("boundary", "buttocks")),
            (layout.half, ("boundary", "waterlines")),
        ):
            for line in (each for family in families for each in self.drawing.of(family)):
                if view is layout.profile or line is not self.drawing.profile:
                    colours.draw(self.sheet, view, line, self.drawing)
        halves = body_halves(self.sections, self.middle)
        for view, lines in zip((layout.body.mirrored(), layout.body), halves, strict=True):
            for line in lines:
                colours.draw(self.sheet, view, line, self.drawing)

    def _half_body(self, view: View, sections: Sequence[PlotLine]) -> list[_Top]:
        """Draw the sections of one half, labelled on the lines; give their tops."""
        tops, lettered = [], []
        for line in sections:
            found = [points for points in self.draw(view, line) if len(points)]
            lettered += [LabelledLine(line.label, points) for points in found]
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

    def _half_boundary(self, view: View, line: PlotLine) -> None:
        """Draw what of a boundary lies abaft (mirrored) or before the middle."""
        pen = pen_of(line, line.name in self.tinted)
        edges = (self.middle, np.inf) if view.sign > 0.0 else (-np.inf, self.middle)
        for points in line.polylines:
            for part, _ in clipped(points, *edges):
                self._on_shell(view, line, part, pen, f"body/boundary/{line.name}")


def body_halves(
    sections: Sequence[PlotLine], middle: float
) -> tuple[tuple[PlotLine, ...], tuple[PlotLine, ...]]:
    """Divide sections into aft and fore body; the one at the middle belongs to both."""
    aft = tuple(line for line in sections if line.offset <= middle + _NEAR)
    fore = tuple(line for line in sections if line.offset >= middle - _NEAR)
    return aft, fore
