"""Panels of the immersed hull for seakeeping codes, and points along its sections.

`panels` takes a hull, a position and how fine panels shall be; it chooses where columns stand along
the ship and the number of rows across, and gives a `PanelMesh`. x is from the AP, m.

Points at equal lengths along immersed half sections.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Literal

import attrs
import numpy as np

from assoc_hull.analysis.hydrostatics.floating_body import (
    FloatingPosition,
    kept_dry,
    require_afloat,
    require_numbers,
)
from assoc_hull.analysis.hydrostatics.flotation import Flotation, flotation, header_of
from assoc_hull.analysis.hydrostatics.hull_hydrostatics import position_of
from assoc_hull.analysis.net.curve_net import flat_ends_below
from assoc_hull.analysis.panels.assemble_mesh import (
    DivisionChoices,
    MeshAxes,
    assemble_mesh,
    axes_of,
)
from assoc_hull.analysis.panels.wet_sheets import Band, Waterplane, bands
from assoc_hull.arguments import (
    choice,
    flag,
    integer,
    number,
    numbers,
    positive,
    shown,
)
from assoc_hull.errors import BadInputError, OutOfRangeError
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.floating.immersion import FloatingPlanes, ImmersedIntegrals
from assoc_hull.geometry.splines.arc_length import CubicChains
from assoc_hull.geometry.surfaces.panel_mesh import PanelMesh, PanelOrigin
from assoc_hull.model.tables import HasState, state_of

__all__ = [
    "ImmersedExtent",
    "Side",
    "Spacing",
    "column_places",
    "columns_and_rows",
    "immersed_extent",
    "panels",
    "section_points",
]

_IN_SECTION_POINTS = "in section_points"
_MOST_A_SECTION = 2_000


def section_points(
    hull: HasState,
    x: object,
    *,
    points: int = 20,
    draught: float | None = None,
    draughts: tuple[float, float] | None = None,
) -> FloatArray:
    """Part immersed half sections of an upright hull into equal lengths.

    The arguments and what is raised are those of `Hull.section_points`.
    """
    state = state_of(hull)
    body = flotation(state)
    terms: dict[str, object] = {"rho": 1.0, "shell_factor": 1.0, "appendages": ()}
    header = header_of(hull, body, terms | {"fingerprint": ""})
    require_numbers(draughts if draught is None else draught, body.limits)
    position = position_of(header, draught, draughts, 0.0, "moulded")
    planes = require_afloat([position], body.limits, header.length)
    plane = Waterplane(*(float(each[0]) for each in attrs.astuple(planes)))
    where = np.atleast_1d(numbers(x, "x", _IN_SECTION_POINTS))
    count = integer(points, "points", _IN_SECTION_POINTS, least=2, most=_MOST_A_SECTION)
    found = np.full((len(where), count, 3), np.nan)
    sections = _sections(bands(body, plane), plane, where)
    wet = [i for i, cubics in enumerate(sections) if len(cubics)]
    if wet:
        start = np.append(0, np.cumsum([len(sections[i]) for i in wet])).astype(np.int64)
        found[wet] = CubicChains(start, np.concatenate([sections[i] for i in wet])).equal(count)
    freeze(found)
    return found


def _sections(every: list[Band], plane: Waterplane, x: FloatArray) -> list[FloatArray]:
    """Give what is wet of each section as cubics (s, 4, 3), its pieces from below."""
    pieces: list[list[FloatArray]] = [[] for _ in x]
    for band in every:
        # A place at which two bands meet belongs to the one forward.
        inside = np.flatnonzero((x >= band.x[0]) & ((x < band.x[-1]) | _last(every, band, x)))
        q = np.interp(x[inside], band.x, np.arange(band.count + 1.0))
        wet = band.wet(q, plane)
        for run, curve in enumerate(wet.curve.tolist()):
            cubics = wet.chains.cubic[wet.chains.start[run] : wet.chains.start[run + 1]]
            pieces[int(inside[curve])].append(cubics)
    ordered = [sorted(each, key=lambda cubics: float(cubics[0, 0, 2])) for each in pieces]
    return [np.concatenate(each) if each else np.zeros((0, 4, 3)) for each in ordered]


def _last(every: list[Band], band: Band, x: FloatArray) -> np.typing.NDArray[np.bool_]:
    """Tell which places lie at the fore end of a band that no other goes on from."""
    followed = any(other.x[0] == band.x[-1] for other in every)
    found: np.typing.NDArray[np.bool_] = (x == band.x[-1]) & (not followed)
    return found


# --------------------------------------------------------------------------------------
# Columns and rows.

_SAMPLES = 8
"""Curves per strip on which the waterline is looked at."""

_ASPECT = 2.0
"""Length over height of a panel where number and shape are left to us."""

ImmersedExtent = tuple[FloatArray, FloatArray, float]
"""x (k,) and half breadth (k,) along the waterline, and the greatest girth of a half; m."""


def immersed_extent(every: list[Band], plane: Waterplane) -> ImmersedExtent:
    """Find how far the wet part reaches, the waterline upright, and the greatest girth."""
    level = Waterplane(plane.height, plane.tan_trim)
    x, y, girth = [], [], 0.0
    for band in every:
        q = np.linspace(0.0, float(band.count), _SAMPLES * band.count + 1)
        wet = band.wet(q, level)
        if not len(wet.curve):
            continue
        girth = max(girth, float(wet.chains.length.max()))
        afloat = ~wet.top
        x.append(wet.chains.ends[1][afloat, 0])
        y.append(np.abs(wet.chains.ends[1][afloat, 1]))
        # A bulb reaches beyond the waterline: there no breadth is known.
        reach = np.array([wet.chains.cubic[:, 0, 0].min(), wet.chains.cubic[:, 0, 0].max()])
        ends = wet.chains.cubic.sum(axis=1)[:, 0]
        reach = np.array([min(reach[0], ends.min()), max(reach[1], ends.max())])
        x.append(reach)
        y.append(np.full(2, np.nan))
    if not x:
        return np.zeros(0), np.zeros(0), 0.0
    return *_waterline(np.concatenate(x), np.concatenate(y)), girth


def _waterline(x: FloatArray, y: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Put points of waterlines in order of x; ends of the wet part beyond get the end breadth."""
    known = np.isfinite(y)
    if not known.any():
        ends = np.array([x.min(), x.max()])
        return ends, np.zeros(2)
    order = np.argsort(x[known], kind="stable")
    line, breadth = x[known][order], y[known][order]
    low, high = float(x.min()), float(x.max())
    if low < line[0]:
        line, breadth = np.append(low, line), np.append(breadth[0], breadth)
    if high > line[-1]:
        line, breadth = np.append(line, high), np.append(breadth, breadth[-1])
    return line, breadth


def column_places(found: ImmersedExtent, columns: int, spacing: str) -> FloatArray:
    """Give x (columns + 1,), m, between columns.

    "arc": at equal lengths along the waterline; "cosine": close together at both ends.
    """
    x, y, _ = found
    if spacing == "cosine":
        half = 0.5 * (x[-1] - x[0])
        places: FloatArray = x[0] + half * (1.0 - np.cos(np.linspace(0.0, np.pi, columns + 1)))
        return places
    s = np.append(0.0, np.cumsum(np.hypot(np.diff(x), np.diff(y))))
    return np.asarray(np.interp(np.linspace(0.0, s[-1], columns + 1), s, x))


def columns_and_rows(found: ImmersedExtent, count: int) -> tuple[int, int]:
    """Choose columns and rows for `count` panels of a pleasing shape on one half."""
    x, y, girth = found
    length = float(np.hypot(np.diff(x), np.diff(y)).sum())
    ideal = math.sqrt(count * _ASPECT * girth / length)
    rows = np.arange(max(2, math.floor(0.8 * ideal)), max(3, math.ceil(1.25 * ideal)) + 1)
    columns = np.maximum(np.round(count / rows), 2.0)
    # As many panels as were asked for comes before the shape.
    off = np.abs(columns * rows - count) / count + 0.002 * np.abs(np.log(rows / ideal))
    best = int(off.argmin())
    return int(columns[best]), int(rows[best])


# --------------------------------------------------------------------------------------
# The panels of a hull.

Spacing = Literal["arc", "cosine"]
Side = Literal["half", "full"]

_WHERE = "in panels"
_POINTS, _MOST, _MOST_POINTS = 20, 200_000, 2_000
_OFF = 1e-6
"""A station this far (m) beyond the end of what is wet stands at its end."""

_LEAST = 8
_HEADER: dict[str, object] = {
    "rho": 1.025, "shell_factor": 1.0, "appendages": (), "fingerprint": ""
}  # fmt: skip


def panels(
    hull: HasState,
    *,
    draught: float | None = None,
    draughts: tuple[float, float] | None = None,
    heel_deg: float = 0.0,
    count: int | None = None,
    stations: int | Sequence[float] | None = None,
    points: int | None = None,
    spacing: Spacing = "arc",
    side: Side | None = None,
    knuckle_deg: float | None = None,
    transom: bool = True,
    origin: float | None = None,
    on_error: Literal["refuse", "report"] = "refuse",
) -> PanelMesh:
    """Divide the immersed hull into panels, for seakeeping codes.

    The arguments and what is raised are those of `Hull.panels`.
    """
    state = state_of(hull)
    body = flotation(state)
    header = header_of(hull, body, _HEADER)
    require_numbers(draughts if draught is None else draught, body.limits)
    position = position_of(header, draught, draughts, heel_deg, "moulded")
    told: tuple[str, ...] = ()
    if choice(on_error, "on_error", ("refuse", "report"), _WHERE) == "report":
        (position,), told = kept_dry([position], body.limits, header.length)
    planes = require_afloat([position], body.limits, header.length)
    _require_sound(body, planes, on_error)
    plane = Waterplane(*(float(each[0]) for each in attrs.astuple(planes)))
    half = _half(side, plane)
    every = bands(body, plane)
    x, rows = _places(every, plane, count, stations, points, spacing, half)
    turn = None if knuckle_deg is None else positive(knuckle_deg, "knuckle_deg", _WHERE)
    given = stations is not None and not isinstance(stations, int | np.integer)
    chosen = DivisionChoices(rows, given, half, flag(transom, "transom", _WHERE), turn)
    start = 0.5 * header.length if origin is None else number(origin, "origin", _WHERE)
    axes = axes_of(plane, start)
    xyz, panel = assemble_mesh(every, plane, x, chosen, header.length, axes)
    if not len(panel):
        raise BadInputError("nothing of the hull is wet", _WHERE, "give a deeper draught")
    source = _origin(header.ship, position, start, body, planes, axes, chosen.ends)
    title = f"{header.ship}, T_A {position.draught_aft:g} m, T_F {position.draught_fore:g} m"
    if heel_deg:
        title += f", heel {position.heel_deg:g} deg"
    if told:
        title += ", up to the edge of the open deck"
    return PanelMesh(xyz, panel, mirror_y=half, title=title, origin=source)


def _require_sound(body: Flotation, planes: FloatingPlanes, on_error: str) -> None:
    """Refuse a hull whose lines do not bound a surface."""
    doubts = body.doubts(planes, numbers=False)
    if doubts and on_error == "refuse":
        more = f" (and {len(doubts) - 1} more)" if len(doubts) > 1 else ""
        remedy = "mend the hull, or take what comes with on_error='report' (--on-error report)"
        raise BadInputError(doubts[0] + more, _WHERE, remedy)


def _half(side: object, plane: Waterplane) -> bool:
    """Take which sides are wanted: a heeled hull has no half."""
    upright = plane.tan_heel == 0.0
    if side is None:
        return upright
    half = choice(side, "side", ("half", "full"), _WHERE) == "half"
    if half and not upright:
        raise BadInputError("half of a heeled hull is asked for", _WHERE, "use side='full'")
    return half


def _places(
    every: list[Band],
    plane: Waterplane,
    count: int | None,
    stations: int | Sequence[float] | None,
    points: int | None,
    spacing: str,
    half: bool,
) -> tuple[FloatArray, int]:
    """Choose the places of sections (k,), m, and the number of panels along each."""
    choice(spacing, "spacing", ("arc", "cosine"), _WHERE)
    found = immersed_extent(every, plane)
    if not len(found[0]):
        raise BadInputError("nothing of the hull is wet", _WHERE, "give a deeper draught")
    # Points count both ends, so there is one panel less.
    rows = None if points is None else integer(points, "points", _WHERE, least=3,
                                               most=_MOST_POINTS) - 1  # fmt: skip
    wanted = None
    if count is not None:
        whole = integer(count, "count", _WHERE, least=_LEAST, most=_MOST)
        # Columns and rows are chosen on one half.
        wanted = whole if half else (whole + 1) // 2
    if stations is not None and not isinstance(stations, int | np.integer):
        x = _given(stations, found[0])
        rows = _rows(rows, wanted, len(x) - 1)
        return x, rows
    columns = None
    if stations is not None:
        columns = integer(stations, "stations", _WHERE, least=3, most=_MOST_POINTS) - 1
    if columns is None and rows is None and wanted is not None:
        columns, rows = columns_and_rows(found, wanted)
    elif columns is None:
        rows = _POINTS - 1 if rows is None else rows
        # Two at least: three stations are the fewest that may be asked for.
        columns = _columns(found, rows) if wanted is None else max(2, round(wanted / rows))
    else:
        rows = _rows(rows, wanted, columns)
    return column_places(found, columns, spacing), int(rows or _POINTS - 1)


def _rows(rows: int | None, wanted: int | None, columns: int) -> int:
    """Give the number of panels along a section where that of sections is known."""
    if rows is not None and wanted is not None:
        what = "count, stations and points are all given"
        raise BadInputError(what, _WHERE, "give two of them")
    if rows is not None:
        return rows
    return _POINTS - 1 if wanted is None else max(2, round(wanted / max(columns, 1)))


def _given(stations: object, wet: FloatArray) -> FloatArray:
    """Take the places of sections: ascending, each once, on what is wet of the hull."""
    found = np.atleast_1d(numbers(stations, "stations", _WHERE))
    if len(found) < 2 or (np.diff(found) <= 0.0).any():
        what = f"stations are {shown(stations)}"
        raise BadInputError(what, _WHERE, "give two or more, ascending, m from AP")
    low, high = float(wet.min()), float(wet.max())
    for x in found.tolist():
        if not low - _OFF <= x <= high + _OFF:
            raise OutOfRangeError("a station", x, _WHERE, "meets no wet hull", low, high, "m")
    return found


def _columns(found: tuple[FloatArray, FloatArray, float], rows: int) -> int:
    """Give the number of columns that makes panels of the shape that `columns_and_rows` aims at."""
    x, y, girth = found
    length = float(np.hypot(np.diff(x), np.diff(y)).sum())
    return max(2, round(0.5 * length * rows / girth))


def _origin(
    ship: str,
    position: FloatingPosition,
    x: float,
    body: Flotation,
    planes: FloatingPlanes,
    axes: MeshAxes,
    ends: bool,
) -> PanelOrigin:
    """Measure the hull that is divided."""
    exact: ImmersedIntegrals = body.measure(planes)
    volume = float(exact.volume[0])
    moment = np.array([exact.moment_x[0], exact.moment_y[0], exact.moment_z[0]], np.float64)
    centre = axes.of_ship((moment / volume)[None])[0]
    # Panels cover the ends of bossings too, which are no transoms.
    flat = float(flat_ends_below(body.net, body.closed, planes)[0]) if ends else 0.0
    # And a closed deck that is under water, which is no shell.
    area = float(exact.shell[0]) + float(exact.wet_deck[0]) + flat
    return PanelOrigin(
        ship, position.draught_aft, position.draught_fore, position.heel_deg, x, volume, area,
        np.asarray(centre),
    )  # fmt: skip
