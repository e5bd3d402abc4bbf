"""Hydrostatic curves, the sectional-area curve of one floating position, and Bonjean curves.

Hydrostatic curves have everything over the draught, each kind on an axis of its own.
`plot_hydrostatics` draws any of the three by its name for a hull and its table. The block of
each says which water, shell factor and appendages the numbers hold good for.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import attrs
import numpy as np

from assoc_hull.analysis.hydrostatics.floating_body import StationAreas
from assoc_hull.analysis.hydrostatics.record import FIELDS, HydrostaticTable
from assoc_hull.analysis.hydrostatics.section_areas import (
    Bonjean,
    bonjean,
    sectional_area_course,
    sectional_areas,
)
from assoc_hull.arguments import choice
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.tables import HasState
from assoc_hull.plot.lines_plan.drawing import Drawable, drawing
from assoc_hull.plot.sheet.chart import (
    Chart,
    ChartScale,
    chart_block,
    chart_on,
    level_grid,
    scale_to,
    smooth_course,
)
from assoc_hull.plot.sheet.labels import LabelledLine, label_above, label_lines, label_row
from assoc_hull.plot.sheet.paper import AXIS, GRID, HEAVY, TINT, PaperName, Pen
from assoc_hull.plot.sheet.sheet_figure import Path_, Sheet, save

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = [
    "PICTURES",
    "bonjean_curves",
    "hydrostatic_curves",
    "plot_hydrostatics",
    "sectional_area_curve",
]

# --------------------------------------------------------------------------------------
# Hydrostatic curves: everything over the draught, each kind on an axis of its own.

_AXES = (
    (("volume", "displacement"), "#0b3c6f"),
    (("waterplane_area", "wetted_surface"), "#0a7d55"),
    (("lcb", "lcf"), "#c8102e"),
    (("kb", "kmt"), "#7a3b9a"),
    (("kml",), "#a8570f"),
    (("tpc",), "#2a7f9e"),
    (("mtc",), "#6b6b00"),
    (("cb", "cm", "cp", "cw"), "#444444"),
)
_NAMES = {
    "volume": "Displacement volume", "displacement": "Displacement", "waterplane_area":
    "Waterplane area", "wetted_surface": "Wetted surface", "lcb": "Centre of buoyancy, from AP",
    "lcf": "Centre of flotation, from AP", "kb": "Centre of buoyancy above base",
    "kmt": "Transverse metacentre above base", "kml": "Longitudinal metacentre above base",
    "tpc": "Weight to immerse by 1 cm", "mtc": "Moment to trim by 1 cm",
    "cb": "Block coefficient", "cm": "Midship coefficient", "cp": "Prismatic coefficient",
    "cw": "Waterplane coefficient",
}  # fmt: skip
_PITCH = 7.0  # between two axes, mm at A3
_FROM_ZERO = frozenset({"volume", "waterplane_area", "kb"})
_LEAST = 0.02  # an axis spans at least this part of its values
_DASHES = ((), (3.0, 0.9), (0.9, 0.9), (3.0, 0.9, 0.9, 0.9))


@attrs.frozen
class _Axis:
    """An axis below the field, and the curves on it with the points of each."""

    names: tuple[str, ...]
    colour: str
    scale: ChartScale
    curves: tuple[FloatArray, ...]


def hydrostatic_curves(
    table: HydrostaticTable,
    path: Path_ | None = None,
    *,
    trim: int = 0,
    paper: PaperName = "A3",
) -> Figure:
    """Draw hydrostatic curves: the draught upward, values to the right on axes of their own.

    Parameters
    ----------
    table : HydrostaticTable
        Two draughts or more.
    path : path, optional
        Where to write it; the ending says whether PDF, SVG or PNG.
    trim : int
        Which of the table's trims.
    paper : "A3", "A1" or "A4"
        Size of the sheet, landscape.

    Raises
    ------
    BadInputError
        A single draught, a trim that the table does not have, an unknown paper or ending.
    MissingExtraError
        Matplotlib is not installed.
    """
    draughts, trims = table.shape
    if draughts < 2 or not 0 <= trim < trims:
        what = f"{draughts} draught(s), trim {trim} of {trims}"
        raise BadInputError(what, "in hydrostatic curves", "give two draughts or more")
    sheet = Sheet(paper)
    chart = chart_on(sheet, _PITCH * len(_AXES) + 2.0)
    rows = np.arange(draughts) * trims + trim
    values = {name: each[rows] for name, each in table.columns.items()}
    up = values["draught_mean"]
    scale = scale_to(float(up[0]), float(up[-1]), chart.low, chart.tall, 24)
    level_grid(chart, scale, "T, m", table.header.draught)
    axes = [
        _axis(chart, names, colour, values, scale)
        for names, colour in _AXES
        if not any(np.isnan(values[name]).all() for name in names)
    ]
    for k, axis in enumerate(axes):
        _draw_axis(chart, axis, chart.low - (_PITCH * (k + 0.35)) * sheet.paper.factor)
    chart.border()
    _uprights(chart)
    _block(sheet, table, axes, trim)
    _curves(chart, axes)
    if path is not None:
        save(sheet.figure, path)
    return sheet.figure


def _axis(
    chart: Chart, names: tuple[str, ...], colour: str, values: dict[str, FloatArray], up: ChartScale
) -> _Axis:
    """Choose the scale of an axis; what grows beyond measure at the least draughts is cut."""
    draught = values["draught_mean"]
    upper = draught >= draught[0] + 0.2 * (draught[-1] - draught[0])
    both = np.concatenate([values[name][upper] for name in names])
    low, high = float(np.nanmin(both)), float(np.nanmax(both))
    every = np.concatenate([values[name] for name in names])
    if float(np.nanmax(every)) < 1.5 * high:
        low, high = float(np.nanmin(every)), float(np.nanmax(every))
    if names[0] in _FROM_ZERO:
        low = min(low, 0.0)
    wider = max(_LEAST * max(abs(low), abs(high)) - (high - low), 0.0)  # what does not change
    low, high = low - 0.5 * wider, high + 0.5 * wider
    scale = scale_to(low, high, chart.left, chart.wide, 14)
    curves = [_points(chart, draught, values[name], scale, up) for name in names]
    return _Axis(names, colour, scale, tuple(curves))


def _points(
    chart: Chart, draught: FloatArray, value: FloatArray, scale: ChartScale, up: ChartScale
) -> FloatArray:
    """Give a curve on paper, as far as it lies in the field."""
    course = smooth_course(draught, value)
    found = np.column_stack([scale.at(course[:, 1]), up.at(course[:, 0])])
    inside = (found[:, 0] >= chart.left - 1e-6) & (found[:, 0] <= chart.right + 1e-6)
    return found[inside]


def _draw_axis(chart: Chart, axis: _Axis, y: float) -> None:
    """Draw an axis below the field, numbers under it, symbols at its end."""
    sheet, factor = chart.sheet, chart.sheet.paper.factor
    pen = Pen(0.18, axis.colour)
    chart.level(y, pen, f"axis/{axis.names[0]}")
    for value in axis.scale.marks.tolist():
        x = float(axis.scale.at(value))
        sheet.rule((x, y), (x, y + 1.2 * factor), pen, "tick")
        text = sheet.text((x, y - 0.5 * factor), axis.scale.word(value), size=0.85, up="top",
                          colour=axis.colour, name="label/tick")  # fmt: skip
        sheet.take(text)
    units = dict.fromkeys(FIELDS[name].unit for name in axis.names)
    if len(units) == 1:
        words = ", ".join(FIELDS[name].symbol for name in axis.names) + f"  {units.popitem()[0]}"
    else:
        words = ",  ".join(f"{FIELDS[name].symbol} {FIELDS[name].unit}" for name in axis.names)
    place = (chart.right + 4.0 * factor, y)
    sheet.take(sheet.text(place, words.removesuffix("  -"), across="left", colour=axis.colour,
                          bold=True, name="label/axis"))  # fmt: skip


def _uprights(chart: Chart) -> None:
    """Draw upright lines a centimetre apart, to measure by."""
    step = 10.0 * chart.sheet.paper.factor
    for x in np.arange(chart.left + step, chart.right - 1e-6, step).tolist():
        chart.sheet.rule((x, chart.low), (x, chart.top), GRID, "upright")


def _block(sheet: Sheet, table: HydrostaticTable, axes: list[_Axis], trim: int) -> None:
    position = table.positions[trim]
    rows = [(_NAMES[name], FIELDS[name].symbol) for axis in axes for name in axis.names]
    title = (
        f"HYDROSTATIC CURVES   trim {position.trim_by_stern + 0.0:.3g} m by the stern, heel "
        f"{position.heel_deg:g} deg"
    )
    chart_block(sheet, table, title, rows)


def _curves(chart: Chart, axes: list[_Axis]) -> None:
    """Draw the curves, and write on each what it is."""
    sheet, lines = chart.sheet, []
    for axis in axes:
        for dash, name, points in zip(_DASHES, axis.names, axis.curves, strict=False):
            sheet.line(points, Pen(0.3, axis.colour, dash, 3.0), f"curve/{name}")
            if len(points) > 2:
                lines.append(LabelledLine(FIELDS[name].symbol, points, FIELDS[name].symbol))
    edge = 4.0 * sheet.paper.factor
    written = label_lines(
        sheet, lines, chart.low + edge, chart.top - edge, axis=1, name="label/curve"
    )
    missing = {line.label for line in lines} - written
    label_above(sheet, lines, missing, chart.top + 1.0 * sheet.paper.factor, "label/curve")


# --------------------------------------------------------------------------------------
# The sectional-area curve of one floating position, and the Bonjean curves of a hull.

_CURVE = Pen(0.35, "#0b3c6f", over=3.0)
_BONJEAN = Pen(0.25, "#0b3c6f", over=3.0)
_MARK = Pen(0.2, TINT, (3.0, 1.0), 2.5)
_MOST = 25
"""So many Bonjean curves have room on a sheet."""


def sectional_area_curve(
    areas: StationAreas,
    table: HydrostaticTable,
    path: Path_ | None = None,
    *,
    course: FloatArray | None = None,
    paper: PaperName = "A3",
) -> Figure:
    """Draw the areas of the sections along the ship, with volume and centre of buoyancy.

    Parameters
    ----------
    areas : StationAreas
        At the first position of the table.
    table : HydrostaticTable
        Of that position.
    path : path, optional
        Where to write it; the ending says whether PDF, SVG or PNG.
    course : (n, 2), m and m2, or None
        The curve, as `sectional_area_course` gives it; None: a smooth one through the stations,
        which ends at the last of them.
    paper : "A3", "A1" or "A4"
        Size of the sheet, landscape.

    Raises
    ------
    BadInputError
        Fewer than two stations, an unknown paper or ending.
    MissingExtraError
        Matplotlib is not installed.
    """
    _require_two(areas)
    sheet = Sheet(paper)
    chart, head = chart_on(sheet, 14.0), table.header
    area, found = areas.area[0], table[0]
    course = smooth_course(areas.x, area) if course is None else course
    x = np.concatenate([areas.x, course[:, 0]])
    ends = min(float(x.min()), 0.0), max(float(x.max()), head.length)
    along = scale_to(*ends, chart.left, chart.wide, 20, whole=False)
    most = max(float(area.max()), float(course[:, 1].max()))
    up = scale_to(0.0, 1.08 * most, chart.low, chart.tall, 16)
    level_grid(chart, up, "A, m2")
    chart.border()
    _stations(chart, areas, along)
    _perpendiculars(chart, along, head.length)
    points = np.column_stack([along.at(course[:, 0]), up.at(course[:, 1])])
    sheet.line(points, _CURVE, "curve/areas")
    spots = np.column_stack([along.at(areas.x), up.at(area)])
    sheet.dots(spots, _CURVE.colour, 1.0, "stations")
    rows = [
        ("Displacement volume", f"{found.volume:,.2f} m3"),
        ("Displacement", f"{found.displacement:,.2f} t"),
        ("Centre of buoyancy, from AP", f"{found.lcb:.3f} m"),
        ("from midship, + forward", f"{found.lcb_percent:+.3f} % Lpp"),
        ("Largest station", f"{found.a_max:.3f} m2 at {found.x_a_max:.3f} m"),
        ("Block, prismatic coefficient", f"{found.cb:.4f}, {found.cp:.4f}"),
    ]
    position = str(table.positions[0])
    chart_block(sheet, table, f"SECTIONAL AREAS   {position}", rows)
    _mark(chart, float(along.at(found.lcb)), f"LCB {found.lcb:.3f} m")
    if path is not None:
        save(sheet.figure, path)
    return sheet.figure


def bonjean_curves(
    hull: Drawable,
    curves: Bonjean,
    table: HydrostaticTable,
    path: Path_ | None = None,
    *,
    paper: PaperName = "A3",
) -> Figure:
    """Draw the area of each station up to every height, at its station over the profile.

    Heights are not to the scale of the length: the profile is drawn as the curves are.

    Parameters
    ----------
    hull : Hull, HullState or Drawing
        Whose profile is drawn.
    curves : Bonjean
        The areas; of more than 25 stations some are left out, evenly.
    table : HydrostaticTable
        For the head.
    path : path, optional
        Where to write it; the ending says whether PDF, SVG or PNG.
    paper : "A3", "A1" or "A4"
        Size of the sheet, landscape.

    Raises
    ------
    BadInputError
        Fewer than two stations, an unknown paper or ending.
    MissingExtraError
        Matplotlib is not installed.
    """
    _require_two(curves.stations)
    sheet = Sheet(paper)
    chart, head, plan = chart_on(sheet, 14.0), table.header, drawing(hull)
    low, high = plan.bounds
    shown = _shown(curves.stations)
    unit = _area_unit(shown, chart, float(high[0] - low[0]))
    room = unit * float(shown.area[:, -1].max())  # m of the length that the last curve needs
    ends = float(min(low[0], 0.0)), float(max(high[0], head.length, shown.x[-1] + room))
    along = scale_to(*ends, chart.left, chart.wide, 20, whole=False)
    up = scale_to(float(low[2]), float(high[2]), chart.low, chart.tall, 20)
    level_grid(chart, up, "z, m", head.draught)
    chart.border()
    _stations(chart, shown, along)
    _perpendiculars(chart, along, head.length)
    _profile(chart, hull, along, up)
    for x, area, name in zip(shown.x.tolist(), shown.area.T, shown.names, strict=True):
        points = np.column_stack([along.at(x + unit * area), up.at(curves.z)])
        sheet.line(points, _BONJEAN, f"bonjean/{name}")
    per_cm = 10.0 * sheet.paper.factor / (unit * along.size / (along.high - along.low))
    rows = [
        ("Areas, to the right of each station", f"1 cm = {per_cm:.4g} m2"),
        ("Length", f"1 cm = {10 * sheet.paper.factor * (ends[1] - ends[0]) / along.size:.4g} m"),
        ("Height", f"1 cm = {10 * sheet.paper.factor * (up.high - up.low) / up.size:.4g} m"),
        ("Stations drawn", f"{len(shown.x)} of {len(curves.stations.x)}"),
    ]
    chart_block(sheet, table, "BONJEAN CURVES", rows)
    if path is not None:
        save(sheet.figure, path)
    return sheet.figure


def _require_two(areas: StationAreas) -> None:
    if len(areas.x) < 2:
        what = f"{len(areas.x)} station(s)"
        raise BadInputError(what, "in a picture of section areas", "give two stations or more")


def _shown(stations: StationAreas) -> StationAreas:
    """Leave stations out, evenly, where there are more than have room."""
    every = -(-len(stations.x) // _MOST)
    return StationAreas(
        stations.x[::every], stations.area[:, ::every], tuple(stations.names[::every])
    )


def _area_unit(stations: StationAreas, chart: Chart, length: float) -> float:
    """Give how many metres of the length a square metre is drawn as: a round length on paper."""
    step = 2.2 * length / max(len(stations.x) - 1, 1)
    most = max(float(stations.area.max()), 1e-9)
    per_mm = scale_to(0.0, most / (step * chart.wide / length), 0.0, 1.0, 1).step
    return length / chart.wide / per_mm


def _stations(chart: Chart, stations: StationAreas, along: ChartScale) -> None:
    """Draw the stations as upright lines, named below."""
    sheet, factor = chart.sheet, chart.sheet.paper.factor
    at = along.at(stations.x)
    for x, name in zip(at.tolist(), stations.names, strict=True):
        sheet.rule((x, chart.low), (x, chart.top), GRID, f"station/{name}")
    ends = np.column_stack([at, np.full(len(at), chart.low)])
    words = [name.removeprefix("ST ") for name in stations.names]
    label_row(sheet, ends, words, "below", chart.low - 2.0 * factor, heading="ST", sparse=True,
         name="label/station")  # fmt: skip


def _perpendiculars(chart: Chart, along: ChartScale, length: float) -> None:
    """Draw AP, midship and FP, named above."""
    sheet, factor = chart.sheet, chart.sheet.paper.factor
    for value, name in ((0.0, "AP"), (0.5 * length, "Lpp/2"), (length, "FP")):
        x = float(along.at(value))
        sheet.rule((x, chart.low), (x, chart.top + 1.0 * factor), AXIS, name)
        place = (x, chart.top + 1.4 * factor)
        sheet.take(sheet.text(place, name, up="bottom", name=f"label/{name}"))


def _mark(chart: Chart, x: float, words: str) -> None:
    """Draw where the centre of buoyancy is."""
    sheet, factor = chart.sheet, chart.sheet.paper.factor
    sheet.rule((x, chart.low), (x, chart.top), _MARK, "LCB")
    place = (x + 1.5 * factor, chart.low + 0.35 * chart.tall)
    sheet.take(sheet.text(place, words, size=1.3, across="left", colour=TINT, halo=True, bold=True,
                          name="label/LCB"))  # fmt: skip


def _profile(chart: Chart, hull: Drawable, along: ChartScale, up: ChartScale) -> None:
    """Draw the boundary in the centre plane, stretched as the field is."""
    line = drawing(hull).profile
    for points in () if line is None else line.polylines:
        course: FloatArray = np.column_stack([along.at(points[:, 0]), up.at(points[:, 2])])
        chart.sheet.line(course, HEAVY, "profile")


# --------------------------------------------------------------------------------------
# The pictures that go with hydrostatics, by name.

PICTURES = ("curves", "areas", "bonjean")


def plot_hydrostatics(
    hull: HasState, table: HydrostaticTable, picture: str, path: Path_ | None = None
) -> Figure:
    """Draw one of the pictures that go with a table of hydrostatics.

    Parameters
    ----------
    hull : Hull
        The hull.
    table : HydrostaticTable
        Of it.
    picture : "curves", "areas" or "bonjean"
        Hydrostatic curves, the sectional-area curve of the first position, or Bonjean curves.
    path : path, optional
        Where to write it; the ending says whether PDF, SVG or PNG.

    Raises
    ------
    BadInputError
        Another picture; one draught for curves; what `save` raises.
    """
    if choice(picture, "picture", PICTURES) == "curves":
        return hydrostatic_curves(table, path)
    if picture == "areas":
        position = table.positions[0]
        course = sectional_area_course(hull, position)
        return sectional_area_curve(sectional_areas(hull, position), table, path, course=course)
    return bonjean_curves(hull, bonjean(hull), table, path)
