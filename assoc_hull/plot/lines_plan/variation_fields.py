"""The fields of a variation over the profile: boundary curves, displacements, regions."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import attrs
import numpy as np

from assoc_hull.arguments import instance
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.plot.lines_plan.drawing import Drawable, Drawing, drawing, pen_of
from assoc_hull.plot.sheet.chart import Chart, ChartScale, level_grid, scale_to, upright_grid
from assoc_hull.plot.sheet.paper import MARGIN, TINT, PaperName, Pen, paper_of
from assoc_hull.plot.sheet.sheet_figure import Path_, Sheet, save
from assoc_hull.plot.sheet.title_block import caption, frame
from assoc_hull.variation.fields.field import Axis, StackedField
from assoc_hull.variation.fields.layers import FieldLayer, Rake

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["variation_fields"]

_TALL, _APART, _HEAD = 46.0, 20.0, 7.0  # a panel, between two, above the uppermost, mm
_SIDE, _LEGEND = 16.0, 27.0  # for letters left of a panel, and for its tints right of it, mm
_BOUNDARY = Pen(0.16, "#0b3c6f", (2.0, 0.8), 2.6)
_REGION = Pen(0.2, TINT, (4.0, 0.8, 0.8, 0.8), 2.8)
_STEPS, _GRID = 14, (601, 201)  # tints, and places at which a field is sampled
_PITCH, _LETTER = 1.9, 0.75  # between two names, mm, and their size
_TITLES = {
    "x": "Displacement along the ship, m",
    "y": "Displacement across, % of the half-breadth",
    "z": "Displacement upward, m",
}


def variation_fields(
    hull: Drawable, layer: FieldLayer, path: Path_ | None = None, *, paper: PaperName = "A4"
) -> Figure:
    """Draw the fields of a layer over the profile, a panel for each coordinate that moves.

    Each panel shows the sum of the fields as tints, and of every field the boundary curves and
    the box outside which it moves nothing. Heights are not to the scale of the length.

    Parameters
    ----------
    hull : Hull, HullState or Drawing
        The parent.
    layer : FieldLayer
        The fields.
    path : path, optional
        Where to write it; the ending says whether PDF, SVG or PNG.
    paper : "A3", "A1" or "A4"
        Width of the sheet; its height is that of the panels.

    Raises
    ------
    BadInputError
        A layer without fields, an unknown paper or ending.
    MissingExtraError
        Matplotlib is not installed.
    """
    instance(layer, FieldLayer, "layer", "in a picture of fields")
    moved: list[Axis] = [axis for axis in ("x", "y", "z") if _of(layer, axis)]
    if not moved:
        raise BadInputError(
            f"layer '{layer.name}' has no fields", "in a picture of fields", "give one with fields"
        )
    size, plan = paper_of(paper), drawing(hull)
    unit = size.factor
    tall = (2.0 * MARGIN + _HEAD + len(moved) * (_TALL + _APART) - 6.0) * unit
    sheet = Sheet(paper, tall)
    frame(sheet, MARGIN * unit)
    left = (MARGIN + _SIDE) * unit
    wide = size.width - left - (MARGIN + _LEGEND) * unit
    for k, axis in enumerate(moved):
        low = tall - (MARGIN + _HEAD + _TALL + k * (_TALL + _APART)) * unit
        _panel(Chart(sheet, left, low, wide, _TALL * unit), plan, _of(layer, axis), axis)
    if path is not None:
        save(sheet.figure, path)
    return sheet.figure


def _of(layer: FieldLayer, axis: str) -> tuple[StackedField | Rake, ...]:
    return tuple(field for field in layer.fields if field.axis == axis)


@attrs.frozen(eq=False)
class _Profile:
    """A panel: a chart over x and z."""

    chart: Chart
    along: ChartScale
    up: ChartScale

    @property
    def box(self) -> tuple[float, float, float, float]:
        """Least and greatest x, least and greatest z, m."""
        return self.along.low, self.along.high, self.up.low, self.up.high

    def on(self, x: FloatArray, z: FloatArray) -> FloatArray:
        """Give places on paper, (n, 2), mm."""
        return np.column_stack([self.along.at(x), self.up.at(z)])


def _panel(chart: Chart, plan: Drawing, fields: Sequence[StackedField | Rake], axis: Axis) -> None:
    """Draw the fields of one coordinate."""
    low, high = plan.bounds
    room, head = 0.02 * float(high[0] - low[0]), 0.1 * float(high[2] - low[2])
    profile = _Profile(
        chart,
        scale_to(low[0] - room, high[0] + room, chart.left, chart.wide, 16, whole=False),
        scale_to(low[2] - head, high[2] + head, chart.low, chart.tall, 8, whole=False),
    )
    _tints(profile, fields, axis)
    level_grid(chart, profile.up, "z, m", plan.particulars.draught)
    upright_grid(chart, profile.along, "x, m")
    place = (chart.left + 0.5 * chart.wide, chart.top + 5.2 * chart.sheet.paper.factor)
    caption(chart.sheet, place, _TITLES[axis])
    for line in plan.of("boundary"):
        for points in line.polylines:
            chart.sheet.line(
                profile.on(points[:, 0], points[:, 2]), pen_of(line), f"hull/{line.name}"
            )
    names = list[tuple[float, float, str]]()
    for field in fields:
        _region(profile, field)
        names += _boundaries(profile, field)
    _name(profile, names)
    chart.border()


def _tints(profile: _Profile, fields: Sequence[StackedField | Rake], axis: Axis) -> None:
    """Fill what moves: red forward, out or up, blue the other way; what stays is white."""
    x0, x1, z0, z1 = profile.box
    x, z = np.linspace(x0, x1, _GRID[0]), np.linspace(z0, z1, _GRID[1])
    wide, tall = np.meshgrid(x, z)
    y = np.full(wide.size, 1e-6 if axis == "y" else 0.0)
    places = np.column_stack([wide.ravel(), y, tall.ravel()])
    moved = np.sum([field.displacement(places) for field in fields], axis=0)
    moved = (moved / y * 100.0 if axis == "y" else moved).reshape(wide.shape)
    most = max(float(np.abs(moved).max()), 1e-9)
    steps = scale_to(-most, most, 0.0, 1.0, _STEPS).marks
    colours = _colours(steps)
    middle = np.ma.masked_equal(np.clip(moved, steps[0], steps[-1]), 0.0)
    filled = profile.chart.sheet.axes.contourf(
        profile.along.at(x), profile.up.at(z), middle, levels=steps, colors=colours, zorder=0.5
    )
    filled.set_gid("displacement")
    _legend(profile.chart, steps, colours, float(moved.min()), float(moved.max()))


def _colours(steps: FloatArray) -> list[tuple[float, float, float]]:
    """Give a tint for every step: the paler, the nearer to nil."""
    middle = 0.5 * (steps[1:] + steps[:-1])
    part = 0.08 + 0.92 * np.abs(middle) / np.abs(steps).max()
    full = np.where(middle[:, None] > 0.0, [0.80, 0.22, 0.16], [0.10, 0.32, 0.66])
    tints = 1.0 - 0.85 * part[:, None] * (1.0 - full)
    return [tuple(each) for each in tints.tolist()]


def _legend(
    chart: Chart, steps: FloatArray, colours: Sequence[tuple[float, float, float]], least: float,
    most: float,
) -> None:  # fmt: skip
    """Draw the tints that occur beside the panel, with their limits."""
    sheet, unit = chart.sheet, chart.sheet.paper.factor
    shown = np.flatnonzero((steps[1:] > least + 1e-9) & (steps[:-1] < most - 1e-9))
    tall, left = min(4.0 * unit, chart.tall / max(len(shown), 1)), chart.right + 10.0 * unit
    scale = ChartScale(0.0, 1.0, float(steps[1] - steps[0]), 0.0, 1.0)
    for k, step in enumerate(shown.tolist()):
        low = chart.low + k * tall
        sheet.axes.fill(
            [left, left + 4.0 * unit, left + 4.0 * unit, left], [low, low, low + tall, low + tall],
            facecolor=colours[step], edgecolor="0.6", linewidth=0.3, zorder=2.0,
        )  # fmt: skip
    for k, step in enumerate([*shown.tolist(), shown[-1] + 1]):
        place = (left + 5.2 * unit, chart.low + k * tall)
        words = sheet.text(
            place, scale.word(float(steps[step])), size=0.9, across="left", name="label/tint"
        )
        sheet.take(words)


def _ends(profile: _Profile, field: StackedField | Rake) -> tuple[float, float, float, float]:
    """Give the box of a field's region within the panel."""
    region, (x0, x1, z0, z1) = field.region(), profile.box
    ends = (max(region.x[0], x0), min(region.x[1], x1), max(region.z[0], z0), min(region.z[1], z1))
    return ends


def _region(profile: _Profile, field: StackedField | Rake) -> None:
    """Draw the box outside which a field moves nothing."""
    x0, x1, z0, z1 = _ends(profile, field)
    corners = np.array([[x0, z0], [x1, z0], [x1, z1], [x0, z1], [x0, z0]])
    profile.chart.sheet.line(
        profile.on(corners[:, 0], corners[:, 1]), _REGION, f"region/{field.name}"
    )


def _boundaries(profile: _Profile, field: StackedField | Rake) -> list[tuple[float, float, str]]:
    """Draw a field's boundary curves; give x, z and words of their names."""
    x0, x1, _, _ = _ends(profile, field)
    x = np.linspace(x0, x1, 200)
    curves = (
        [("foot", np.full(200, field.z0)), ("straight", np.full(200, field.z0 + field.w))]
        if isinstance(field, Rake)
        else [(each.name, each.height.at(x)) for each in field.boundaries]
    )
    _, _, low, high = profile.box
    names, inward = [], 0.5 * (profile.box[0] + profile.box[1])
    side = -1 if abs(x1 - inward) < abs(x0 - inward) else 0
    for name, z in curves:
        if low < z.min() and z.max() < high:
            line = profile.on(x, z)
            profile.chart.sheet.line(line, _BOUNDARY, f"boundary/{field.name}/{name}")
            names.append((float(x[side]), float(z[side]), f"{field.name}: {name}"))
    return names


def _name(profile: _Profile, names: Sequence[tuple[float, float, str]]) -> None:
    """Write the names of boundaries beside their regions, each clear of those below."""
    sheet, unit = profile.chart.sheet, profile.chart.sheet.paper.factor
    middle = 0.5 * (profile.box[0] + profile.box[1])
    for aft in (True, False):
        last = profile.chart.low + (1.2 - _PITCH) * unit
        for x, z, words in sorted((each for each in names if (each[0] < middle) == aft),
                                  key=lambda each: each[1]):  # fmt: skip
            place = profile.on(np.array([x]), np.array([z]))[0]
            last = max(float(place[1]), last + _PITCH * unit)
            aside = float(place[0]) + (1.0 if aft else -1.0) * unit
            written = sheet.text(
                (aside, last), words, size=_LETTER, across="left" if aft else "right",
                colour=_BOUNDARY.colour, halo=True, name=f"label/boundary/{words}",
            )  # fmt: skip
            sheet.take(written)
