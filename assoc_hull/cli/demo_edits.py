"""The edits of the demo: what a designer would ask, and what to look at afterwards."""

from __future__ import annotations

from collections.abc import Callable

import attrs
import numpy as np

from assoc_hull.edit.report import EditReport
from assoc_hull.edit.session import Edit
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.hull import Hull
from assoc_hull.model.curve import Curve
from assoc_hull.model.point import Point

__all__ = ["EDITS", "DemoEdit", "Outcome", "carry_out"]


@attrs.frozen
class Outcome:
    """What came of one edit.

    Attributes
    ----------
    name : str
        Name of the edit.
    asked, reached : float, m
        How far a point was asked to go, and how far it went: along its freedom in a drag,
        along the hull's normal in a pull, the largest change of the line in a re-shape.
    report : EditReport
        The report of the edit.
    """

    name: str
    asked: float
    reached: float
    report: EditReport


@attrs.frozen
class DemoEdit:
    """One edit of the demo.

    Attributes
    ----------
    name : str
        Name of the edit.
    asked : float, m
        See `Outcome`.
    change : callable
        Makes the modifications.
    place : callable
        Gives the places (k, 3), m, by which the result is measured.
    along : callable
        Gives the unit directions (k, 3) in which it is measured, before the edit.
    """

    name: str
    asked: float
    change: Callable[[Hull, Edit], object]
    place: Callable[[Hull], FloatArray]
    along: Callable[[Hull], FloatArray]


def carry_out(hull: Hull, wish: DemoEdit) -> Outcome:
    """Carry out one edit, and measure how far it came."""
    before, along = wish.place(hull), wish.along(hull)
    with hull.edit(wish.name) as edit:
        wish.change(hull, edit)
    assert edit.report is not None, "an edit without an error has a report"
    gone = ((wish.place(hull) - before) * along).sum(axis=1)
    reached = float(gone[int(np.argmax(np.abs(gone)))])
    return Outcome(wish.name, wish.asked, reached, edit.report)


def _drag(address: str, distance: float) -> DemoEdit:
    """Drag a shared crossing along its one freedom: the two lines take it with them."""

    def change(hull: Hull, edit: Edit) -> None:
        point = hull.points[address]
        (axis,) = point.free
        edit.move(point, **{axis: getattr(point, axis) + distance})

    def along(hull: Hull) -> FloatArray:
        return np.eye(3)[["xyz".index(axis) for axis in hull.points[address].free]]

    name = f"drag {address} by {1e3 * distance:g} mm"
    return DemoEdit(name, distance, change, _place_of(address), along)


def _pull(address: str, distance: float, radius: tuple[float, float]) -> DemoEdit:
    """Pull the hull at a point, fading along the length and along the girth."""

    def change(hull: Hull, edit: Edit) -> None:
        edit.pull(hull.points[address], d=distance, radius=radius)

    name = (
        f"pull at {address} by {1e3 * distance:g} mm, fading over {radius[0]:g} x {radius[1]:g} m"
    )
    return DemoEdit(
        name, distance, change, _place_of(address), lambda hull: _normal(hull.points[address])[None]
    )


def _reshape(
    line: str, span: tuple[float, float], largest: float, fade: tuple[float, float]
) -> DemoEdit:
    """Give a stretch of a waterline a new shape: its points at the sections, moved by a bell."""

    def change(hull: Hull, edit: Edit) -> None:
        edit.reshape(_curve(hull, line), _bulged(hull, line, span, largest), span=span, fade=fade)

    def along(hull: Hull) -> FloatArray:
        return np.array([[0.0, 1.0, 0.0]])

    name = f"re-shape {line} from x {span[0]:g} to {span[1]:g} m by up to {1e3 * largest:g} mm"
    return DemoEdit(name, largest, change, lambda hull: _stretch(hull, line, span), along)


def _place_of(address: str) -> Callable[[Hull], FloatArray]:
    return lambda hull: hull.points[address].position[None]


def _curve(hull: Hull, line: str) -> Curve:
    return hull.lines[line].curves[0]


def _stretch(hull: Hull, line: str, span: tuple[float, float]) -> FloatArray:
    """Give the points of a line at the sections that define it within a span, (k, 3), m."""
    found = [
        point.position
        for point in _curve(hull, line).defining
        if span[0] < point.x < span[1] and _generator(point) == "sections"
    ]
    return np.array(found)


def _generator(point: Point) -> str | None:
    parent = point.parent_curve
    return None if parent is None else parent.line.group.family


def _bulged(hull: Hull, line: str, span: tuple[float, float], largest: float) -> FloatArray:
    points = _stretch(hull, line, span)
    part = (points[:, 0] - span[0]) / (span[1] - span[0])
    bell = 1.0 - np.cos(2.0 * np.pi * part)
    points[:, 1] += largest * bell / bell.max()
    return points


def _normal(point: Point) -> FloatArray:
    """Give the outward unit normal of the hull at a crossing, (3,)."""
    friend = point.friend_point
    if friend is None:
        raise BadInputError(f"{point.name} is no crossing", "in a pull", "name a crossing")
    tangent = [
        each.container_curve.tangent(each.container_curve.closest(each.position)[0])
        for each in (point, friend)
    ]
    normal = np.cross(tangent[0], tangent[1])
    normal = normal / np.linalg.norm(normal)
    return np.asarray(normal if normal[1] > 0.0 else -normal)


EDITS = (
    _drag("WL 0.5 x ST 16", 0.005),
    _pull("WL 0.5 x ST 17", 0.020, (20.0, 8.0)),
    _drag("BTK 0.68 x ST 4", 0.010),
    _reshape("WL 0.75", (12.0, 36.0), 0.025, (20.0, 8.0)),
)
"""A waterline in the entrance, by hand and softly; a buttock in the run, the other direction;
a stretch of a waterline in the run."""
