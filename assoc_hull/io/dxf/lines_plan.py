"""The lines plan as a DXF drawing: three views at full size, each line a spline in its view.

A line in a plane is drawn in the view that shows its true shape, and a curve in space in profile
and half-breadth plan. Extended data tell name, family and view, where the origin of the view
lies and where the plane of the line: these move and grow with the entity in any program, so that
the drawing can be read back.

Examples
--------
>>> from assoc_hull.shipped.wigley import wigley
>>> from assoc_hull.io.reports import ExportBook
>>> from assoc_hull.io.dxf.lines_plan import plan_drawing
>>> plan_drawing(wigley(), ExportBook(9)).count("AcDbSpline")
33
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.splines.control_polygon import ControlPolygon
from assoc_hull.io.dxf.document import DxfLayer, drawing_text, layer_name
from assoc_hull.io.dxf.lines import SplineLine, spline_lines
from assoc_hull.io.dxf.plan_layout import PlanLayout, PlanView, lay_out, views_of_line
from assoc_hull.io.dxf.plan_sheet import PlanSheet, draw_grid, label_lines
from assoc_hull.io.lines.line_points import lines_as_points
from assoc_hull.io.reports import ExportBook
from assoc_hull.model.tables import HullState

__all__ = ["plan_drawing"]

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
        (float(_along(line, curve.points).max()) for line in lines
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
                flat[:, 1] = view.origin[1] - _along(line, curve.points)
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


def _along(line: SplineLine, points: FloatArray) -> FloatArray:
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
