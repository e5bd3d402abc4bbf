"""Entries of the midship section."""

from __future__ import annotations

import itertools
import math

import numpy as np

from assoc_hull.analysis.form.literature import TABLE_4
from assoc_hull.analysis.form.parameter import entries_in, parameter
from assoc_hull.analysis.form.section_shape import Section, section_at
from assoc_hull.analysis.form.shape import Shape
from assoc_hull.analysis.form.value import Absent, Found, Warned
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.polylines.circular_arcs import Arc, find_arcs
from assoc_hull.geometry.splines.evaluation import sample
from assoc_hull.geometry.splines.plane_places import turning_places

__all__ = ["PARAMETERS", "radius_from_area"]

_LEAST_TURN = 60.0
"""An arc of the section that turns by less (degrees) is no bilge."""

_NOISE = 1e-5
"""Splines through points on a circle lie off it by less (m)."""

_FLAT = 1e-3
"""A section that comes so near (m) to the base line and to B/2 has a flat bottom and side."""

_CHORDS = 16
"""Chords of each segment of a section among which arcs are looked for."""


@parameter(
    "BR", name="bilge radius", unit="m", table="hull form",
    definition="of the circular arc of the midship section that turns most, by 60 degrees or more; "
    "where there is none, from its area A below T: sqrt((B T - A) / (2 (1 - pi / 4))), if "
    "bottom and side are flat and the bottom does not rise",
    source=TABLE_4,
)  # fmt: skip
def bilge_radius(shape: Shape) -> Found:
    section = section_at(shape, 0.5 * shape.length)
    if section is None:
        return Absent("no midship section")
    arcs = [arc for arc in _arcs(section) if arc.turn_deg >= _LEAST_TURN]
    if arcs:
        return max(arcs, key=lambda arc: arc.turn_deg).radius
    return _from_area(shape, section)


def _arcs(section: Section) -> list[Arc]:
    """Give the arcs of a section, looked for between its corners."""
    start, xyz = sample(section.curves, _CHORDS)
    found = []
    for first, last in zip(start[:-1].tolist(), start[1:].tolist(), strict=True):
        for run in _smooth_runs(xyz[first:last, 1:]):
            found += find_arcs(run, _NOISE)
    return found


def _smooth_runs(points: FloatArray) -> list[FloatArray]:
    """Part a polyline at its corners, (n, 2)."""
    step = np.diff(points, axis=0)
    angle = np.unwrap(np.arctan2(step[:, 1], step[:, 0]))
    corner = np.flatnonzero(np.abs(np.diff(angle)) > math.radians(20.0)) + 1
    bounds = [0, *corner.tolist(), len(points) - 1]
    return [points[a : b + 1] for a, b in itertools.pairwise(bounds)]


def radius_from_area(area: float, breadth: float, draught: float) -> float:
    """Give the radius (m) of two round bilges that leave an area (m2) of the rectangle B T."""
    return math.sqrt((breadth * draught - area) / (2.0 * (1.0 - 0.25 * math.pi)))


def _from_area(shape: Shape, section: Section) -> Found:
    """Give the radius of the circle that leaves the area of the section."""
    half = 0.5 * shape.breadth
    places = np.concatenate(turning_places(section.curves, 2))
    side = section.half_breadth(shape.draught)
    flat = np.abs(places[:, 2]).min() <= _FLAT and side is not None and abs(side - half) <= _FLAT
    bottom = places[np.abs(places[:, 2]) <= _FLAT, 1]
    if not flat or bottom.max() <= 0.5 * half:
        return Absent("no circular bilge, bottom or side not flat")
    area = section.area_below(shape.draught)
    if shape.breadth * shape.draught - area <= _FLAT * _FLAT:
        return Absent("the bilge is a corner")
    radius = radius_from_area(area, shape.breadth, shape.draught)
    return Warned(radius, "no arc fits the bilge: from the area of the section")


PARAMETERS = entries_in(vars())
"""The entries of this module, in order."""
