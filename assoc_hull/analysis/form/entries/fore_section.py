"""Entries of the section of the fore body, and of the one that has a third of the largest area."""

from __future__ import annotations

import math

import numpy as np
from scipy.optimize import brentq

from assoc_hull.analysis.form.literature import TABLE_4
from assoc_hull.analysis.form.parameter import SHAPE, entries_in, parameter
from assoc_hull.analysis.form.section_shape import Section, radius_of_three, section_at
from assoc_hull.analysis.form.shape import Shape
from assoc_hull.analysis.form.value import Absent, Found
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.floating.immersed import Planes
from assoc_hull.geometry.splines.plane_places import places_on

__all__ = ["PARAMETERS"]


@parameter(
    "Rfwd", name="radius of the section at station 19.5", unit="m", table="hull form",
    definition="circle through the places of the half section (outer skin) at station 19.5 at "
    "T/4, T/2 and 3T/4", datum="+ if convex", source=TABLE_4, digits=2,
)  # fmt: skip
def fore_radius(shape: Shape) -> Found:
    return radius_of_three(section_at(shape, shape.x_of(19.5)), shape.draught)


# Diagonal of the fore body.


@parameter(
    "x_third", name="place of the fore section of a third of the area", unit="m",
    table="measures",
    definition="foremost x at which the area of the section below T is Amax / 3",
    datum="from AP, + forward", source=TABLE_4, needs=(SHAPE, "Amax"),
)  # fmt: skip
def third_place(shape: Shape, greatest: float) -> Found:
    stations = shape.body.stations(_level(shape.draught))
    place = np.append(stations.x, shape.body.net.batch.xyz[:, 0].max())
    above = np.append(stations.area[0], 0.0) >= greatest / 3.0
    if not above.any():
        return Absent("no section has a third of the largest area")
    last = int(np.flatnonzero(above)[-1])
    if place[last] <= 0.5 * shape.length:
        return Absent("no section of the fore body has a third of the largest area")

    def excess(x: float) -> float:
        section = section_at(shape, x)
        return (0.0 if section is None else section.area_below(shape.draught)) - greatest / 3.0

    low, high = float(place[last]), float(place[last + 1])
    if excess(low) * excess(high) > 0.0:
        return Absent("the hull ends in a section of more than a third of the largest area")
    return float(brentq(excess, low, high, xtol=1e-9))


def _level(height: float) -> Planes:
    return Planes(np.array([height]), np.zeros(1), np.zeros(1))


@parameter(
    "Ldiag", name="diagonal of the fore section", unit="m", table="hull form",
    definition="sqrt(T^2 + b^2), b the half-breadth at T of the foremost section of the area "
    "Amax / 3", source=TABLE_4, needs=(SHAPE, "x_third"),
)  # fmt: skip
def diagonal(shape: Shape, x: float) -> Found:
    breadth = _waterline_breadth(shape, x)
    return Absent("no waterline there") if breadth is None else math.hypot(shape.draught, breadth)


def _waterline_breadth(shape: Shape, x: float) -> float | None:
    section = section_at(shape, x)
    return None if section is None else section.half_breadth(shape.draught)


@parameter(
    "L", name="length on the diagonal of the fore section", unit="m", table="hull form",
    definition="from (0, T) along the line to (b, 0) to the half section of Ldiag", source=TABLE_4,
    datum="from the centre line at T, downward", needs=(SHAPE, "x_third"),
)  # fmt: skip
def on_diagonal(shape: Shape, x: float) -> Found:
    section, breadth = section_at(shape, x), _waterline_breadth(shape, x)
    if section is None or breadth is None:
        return Absent("no waterline there")
    away = _on_diagonal(section, breadth, shape.draught)
    return float(away.min()) if len(away) else Absent("the diagonal misses the section")


def _on_diagonal(section: Section, breadth: float, draught: float) -> FloatArray:
    """Give how far from its upper end a diagonal meets a half section, m."""
    size = math.hypot(draught, breadth)
    normal = np.array([0.0, draught, breadth]) / size
    found = places_on(section.curves, normal, breadth * draught / size).xyz
    away: FloatArray = np.hypot(found[:, 1], draught - found[:, 2])
    return away[(found[:, 2] <= draught) & (away > 0.0)]


@parameter(
    "L/Ldiag", name="fullness of the fore section on its diagonal", unit="-", table="hull form",
    definition="L / Ldiag", datum="0.5 for a V, 1 for a box", source=TABLE_4,
    needs=("L", "Ldiag"),
)  # fmt: skip
def diagonal_ratio(length: float, whole: float) -> float:
    return length / whole


PARAMETERS = entries_in(vars())
"""The entries of this module, in order."""
