"""The sectional-area curve of one floating position, and the Bonjean curves of a hull."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from assoc_hull.analysis.hydrostatics.bonjean import Bonjean
from assoc_hull.analysis.hydrostatics.floating_body import StationAreas
from assoc_hull.analysis.hydrostatics.hydrostatic_table import HydrostaticTable
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.plot.lines_plan.drawing import Sketchable, drawing
from assoc_hull.plot.sheet.chart import Chart, Scale, block_of, chart_on, levels, scale_to, smooth
from assoc_hull.plot.sheet.paper import PaperName, Pen
from assoc_hull.plot.sheet.pens import AXIS, GRID, HEAVY, TINT
from assoc_hull.plot.sheet.rails import rail
from assoc_hull.plot.sheet.sheet import Path_, Sheet, save

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["bonjean_curves", "sectional_area_curve"]

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
    paper: PaperName = "A3",
) -> Figure:
    """Draw the areas of the sections along the ship, with volume and centre of buoyancy.

    Parameters
    ----------
    areas : StationAreas
        At the first position of the table; the curve goes through them.
    table : HydrostaticTable
        Of that position.
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
    _require_two(areas)
    sheet = Sheet(paper)
    chart, head = chart_on(sheet, 14.0), table.header
    area, found = areas.area[0], table[0]
    ends = min(float(areas.x[0]), 0.0), max(float(areas.x[-1]), head.length)
    along = scale_to(*ends, chart.left, chart.wide, 20, whole=False)
    up = scale_to(0.0, 1.08 * float(area.max()), chart.low, chart.tall, 16)
    levels(chart, up, "A, m2")
    chart.border()
    _stations(chart, areas, along)
    _perpendiculars(chart, along, head.length)
    course = smooth(areas.x, area)
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
    block_of(sheet, table, f"SECTIONAL AREAS   {position}", rows)
    _mark(chart, float(along.at(found.lcb)), f"LCB {found.lcb:.3f} m")
    if path is not None:
        save(sheet.figure, path)
    return sheet.figure


def bonjean_curves(
    hull: Sketchable,
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
    levels(chart, up, "z, m", head.draught)
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
    block_of(sheet, table, "BONJEAN CURVES", rows)
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


def _stations(chart: Chart, stations: StationAreas, along: Scale) -> None:
    """Draw the stations as upright lines, named below."""
    sheet, factor = chart.sheet, chart.sheet.paper.factor
    at = along.at(stations.x)
    for x, name in zip(at.tolist(), stations.names, strict=True):
        sheet.rule((x, chart.low), (x, chart.top), GRID, f"station/{name}")
    ends = np.column_stack([at, np.full(len(at), chart.low)])
    words = [name.removeprefix("ST ") for name in stations.names]
    rail(sheet, ends, words, "below", chart.low - 2.0 * factor, heading="ST", sparse=True,
         name="label/station")  # fmt: skip


def _perpendiculars(chart: Chart, along: Scale, length: float) -> None:
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


def _profile(chart: Chart, hull: Sketchable, along: Scale, up: Scale) -> None:
    """Draw the boundary in the centre plane, stretched as the field is."""
    line = drawing(hull).profile
    for points in () if line is None else line.polylines:
        course: FloatArray = np.column_stack([along.at(points[:, 0]), up.at(points[:, 2])])
        chart.sheet.line(course, HEAVY, "profile")
