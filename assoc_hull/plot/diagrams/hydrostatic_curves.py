"""Hydrostatic curves: everything over the draught, each kind on an axis of its own."""

from __future__ import annotations

from typing import TYPE_CHECKING

import attrs
import numpy as np

from assoc_hull.analysis.hydrostatics.hydrostatic_table import HydrostaticTable
from assoc_hull.analysis.hydrostatics.record_fields import FIELDS
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.plot.sheet.chart import Chart, Scale, block_of, chart_on, levels, scale_to, smooth
from assoc_hull.plot.sheet.labels import Lettered, label_above, label_lines
from assoc_hull.plot.sheet.paper import PaperName, Pen
from assoc_hull.plot.sheet.pens import GRID
from assoc_hull.plot.sheet.sheet import Path_, Sheet, save

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["hydrostatic_curves"]

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
    scale: Scale
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
    levels(chart, scale, "T, m", table.header.draught)
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
    chart: Chart, names: tuple[str, ...], colour: str, values: dict[str, FloatArray], up: Scale
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
    chart: Chart, draught: FloatArray, value: FloatArray, scale: Scale, up: Scale
) -> FloatArray:
    """Give a curve on paper, as far as it lies in the field."""
    course = smooth(draught, value)
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
    block_of(sheet, table, title, rows)


def _curves(chart: Chart, axes: list[_Axis]) -> None:
    """Draw the curves, and write on each what it is."""
    sheet, lines = chart.sheet, []
    for axis in axes:
        for dash, name, points in zip(_DASHES, axis.names, axis.curves, strict=False):
            sheet.line(points, Pen(0.3, axis.colour, dash, 3.0), f"curve/{name}")
            if len(points) > 2:
                lines.append(Lettered(FIELDS[name].symbol, points, FIELDS[name].symbol))
    edge = 4.0 * sheet.paper.factor
    written = label_lines(
        sheet, lines, chart.low + edge, chart.top - edge, axis=1, name="label/curve"
    )
    missing = {line.label for line in lines} - written
    label_above(sheet, lines, missing, chart.top + 1.0 * sheet.paper.factor, "label/curve")
