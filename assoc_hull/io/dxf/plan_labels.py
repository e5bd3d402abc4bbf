"""Names on the lines of a lines plan, where other lines leave them most room."""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.knots import pieces
from assoc_hull.geometry.splines.control_polygon import ControlPolygon
from assoc_hull.io.dxf.lines import SplineLine
from assoc_hull.io.dxf.plan_sheet import PlanSheet
from assoc_hull.io.dxf.plan_views import PlanView

__all__ = ["label_lines"]

_SMALL = 0.7
"""Size of letters on lines."""

_PLACES = 160
"""So many places of a line are looked at."""

_WIDE = 0.75
"""Width of a letter, as a part of its height, with the space behind it."""

_NEIGHBOURS = 24
_CROWD = 3.0
"""More room than so many letters is no gain."""


@attrs.frozen(eq=False)
class _Course:
    """A line of a view at places along it, (n, 2), m, and its name."""

    words: str
    places: FloatArray


def label_lines(
    sheet: PlanSheet,
    drawn: Sequence[tuple[SplineLine, PlanView, ControlPolygon, FloatArray]],
) -> None:
    """Write the names of all lines, view by view.

    Parameters
    ----------
    sheet : PlanSheet
        Where to write.
    drawn : sequence of (SplineLine, PlanView, ControlPolygon, (n, 2))
        Curves, each with its control points in its view.
    """
    views: dict[str, list[_Course]] = {}
    for line, view, curve, flat in drawn:
        course = _Course(line.name, _along(curve, flat))
        views.setdefault(view.name, []).append(course)
    for name, courses in views.items():
        _label(sheet, courses, 0.6 * _SMALL if name.endswith("body") else _SMALL)


def _along(curve: ControlPolygon, flat: FloatArray) -> FloatArray:
    """Give places along a curve, about equally far apart."""
    polygons = pieces(flat, curve.knots, 3)
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
        angle = (float(np.degrees(np.arctan2(step[1], step[0]))) + 89.0) % 180.0 - 89.0
        up = np.radians(angle + 90.0)
        place = places[best] + 0.2 * letter * np.array([np.cos(up), np.sin(up)])
        sheet.text(place.tolist(), courses[i].words, "above", size=size, angle=angle)
        taken = np.concatenate([taken, [[*place, reach]]])


def _rooms(courses: list[_Course], most: float) -> list[FloatArray]:
    """Give the distance from each place of each line to the nearest other line, m."""
    from scipy.spatial import cKDTree

    every = np.concatenate([each.places for each in courses])
    owner = np.repeat(np.arange(len(courses)), _PLACES)
    near = min(_NEIGHBOURS, len(every))
    found, index = cKDTree(every).query(every, k=[*range(1, near + 1)])
    distance = np.asarray(found)
    distance[owner[index] == owner[:, None]] = np.inf
    return np.split(np.minimum(distance.min(axis=1), most), len(courses))
