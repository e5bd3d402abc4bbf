"""Entries of single sections: midship, fore body, after body.

All are measured of half sections (`assoc_hull.analysis.form.half_section`), to port, m: bilge
radius, diagonal and fullness of the section with a third of the largest area, half-breadths at the
screw, U or V. Definitions stand in the entries; their order is that of the catalogue.
"""

from __future__ import annotations

import itertools
import math

import numpy as np

from assoc_hull.analysis.form.floating_shape import FloatingShape
from assoc_hull.analysis.form.half_section import HalfSection, radius_of_three, section_at
from assoc_hull.analysis.form.parameter import (
    SHAPE,
    TABLE_4,
    Absent,
    MeasuredValue,
    Warned,
    entries_in,
    parameter,
)
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.floating.immersion import FloatingPlanes
from assoc_hull.geometry.numeric.polynomials import brent_root
from assoc_hull.geometry.polylines.circular_arcs import CircularArc, find_arcs
from assoc_hull.geometry.splines.plane_intersections import coordinate_turns, points_on_plane
from assoc_hull.geometry.splines.segments import sample

__all__ = [
    "AFTER_SECTION",
    "FORE_SECTION",
    "MIDSHIP",
    "radius_from_area",
]

# --------------------------------------------------------------------------------------
# Midship.

_LEAST_TURN = 60.0
"""An arc of the section that turns by less (degrees) is no bilge."""

_NOISE = 1e-5
"""Splines through points on a circle lie off it by less (m)."""

_FLAT = 1e-3
"""A section that comes this near (m) to the base line and to B/2 has a flat bottom and side."""

_CHORDS = 16
"""Chords of each segment of a section among which arcs are looked for."""


@parameter(
    "BR", name="bilge radius", unit="m", table="hull form",
    definition="of the circular arc of the midship section that turns most, by 60 degrees or more; "
    "where there is none, from its area A below T: sqrt((B T - A) / (2 (1 - pi / 4))), if "
    "bottom and side are flat and the bottom does not rise",
    source=TABLE_4,
)  # fmt: skip
def bilge_radius(shape: FloatingShape) -> MeasuredValue:
    section = section_at(shape, 0.5 * shape.length)
    if section is None:
        return Absent("no midship section")
    arcs = [arc for arc in _arcs(section) if arc.turn_deg >= _LEAST_TURN]
    if arcs:
        return max(arcs, key=lambda arc: arc.turn_deg).radius
    return _from_area(shape, section)


def _arcs(section: HalfSection) -> list[CircularArc]:
    """Give the arcs of a section, looked for between its corners."""
    start, xyz = sample(section.curves, _CHORDS)
    found = []
    for first, last in zip(start[:-1].tolist(), start[1:].tolist(), strict=True):
        for run in _smooth_runs(xyz[first:last, 1:]):
            found += find_arcs(run, _NOISE)
    return found


def _smooth_runs(points: FloatArray) -> list[FloatArray]:
    """Split a polyline (n, 2), m, at its corners: turns of more than 20 degrees."""
    step = np.diff(points, axis=0)
    angle = np.unwrap(np.arctan2(step[:, 1], step[:, 0]))
    corner = np.flatnonzero(np.abs(np.diff(angle)) > math.radians(20.0)) + 1
    bounds = [0, *corner.tolist(), len(points) - 1]
    return [points[a : b + 1] for a, b in itertools.pairwise(bounds)]


def radius_from_area(area: float, breadth: float, draught: float) -> float:
    """Give the radius (m) of two round bilges that leave an area (m2) of the rectangle B T."""
    return math.sqrt((breadth * draught - area) / (2.0 * (1.0 - 0.25 * math.pi)))


def _from_area(shape: FloatingShape, section: HalfSection) -> MeasuredValue:
    """Give the radius of the circle that leaves the area of the section."""
    half = 0.5 * shape.breadth
    places = np.concatenate(coordinate_turns(section.curves, 2))
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


MIDSHIP = entries_in(vars())
"""The entries of this module, in order."""


# --------------------------------------------------------------------------------------
# Fore body, and the section that has a third of the largest area.


@parameter(
    "Rfwd", name="radius of the section at station 19.5", unit="m", table="hull form",
    definition="circle through the places of the half section (outer skin) at station 19.5 at "
    "T/4, T/2 and 3T/4", datum="+ if convex", source=TABLE_4, digits=2,
)  # fmt: skip
def fore_radius(shape: FloatingShape) -> MeasuredValue:
    return radius_of_three(section_at(shape, shape.x_of(19.5)), shape.draught)


# Diagonal of the fore body.


@parameter(
    "x_third", name="place of the fore section of a third of the area", unit="m",
    table="measures",
    definition="foremost x at which the area of the section below T is Amax / 3",
    datum="from AP, + forward", source=TABLE_4, needs=(SHAPE, "Amax"),
)  # fmt: skip
def third_place(shape: FloatingShape, greatest: float) -> MeasuredValue:
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
    return brent_root(excess, low, high, xtol=1e-9)


def _level(height: float) -> FloatingPlanes:
    return FloatingPlanes(np.array([height]), np.zeros(1), np.zeros(1))


@parameter(
    "Ldiag", name="diagonal of the fore section", unit="m", table="hull form",
    definition="sqrt(T^2 + b^2), b the half-breadth at T of the foremost section of the area "
    "Amax / 3", source=TABLE_4, needs=(SHAPE, "x_third"),
)  # fmt: skip
def diagonal(shape: FloatingShape, x: float) -> MeasuredValue:
    breadth = _waterline_breadth(shape, x)
    return Absent("no waterline there") if breadth is None else math.hypot(shape.draught, breadth)


def _waterline_breadth(shape: FloatingShape, x: float) -> float | None:
    section = section_at(shape, x)
    return None if section is None else section.half_breadth(shape.draught)


@parameter(
    "L", name="length on the diagonal of the fore section", unit="m", table="hull form",
    definition="from (0, T) along the line to (b, 0) to the half section of Ldiag", source=TABLE_4,
    datum="from the centre line at T, downward", needs=(SHAPE, "x_third"),
)  # fmt: skip
def on_diagonal(shape: FloatingShape, x: float) -> MeasuredValue:
    section, breadth = section_at(shape, x), _waterline_breadth(shape, x)
    if section is None or breadth is None:
        return Absent("no waterline there")
    away = _on_diagonal(section, breadth, shape.draught)
    return float(away.min()) if len(away) else Absent("the diagonal misses the section")


def _on_diagonal(section: HalfSection, breadth: float, draught: float) -> FloatArray:
    """Give how far from its upper end a diagonal cuts a half section, (k,), m."""
    size = math.hypot(draught, breadth)
    normal = np.array([0.0, draught, breadth]) / size
    found = points_on_plane(section.curves, normal, breadth * draught / size).xyz
    away: FloatArray = np.hypot(found[:, 1], draught - found[:, 2])
    return away[(found[:, 2] <= draught) & (away > 0.0)]


@parameter(
    "L/Ldiag", name="fullness of the fore section on its diagonal", unit="-", table="hull form",
    definition="L / Ldiag", datum="0.5 for a V, 1 for a box", source=TABLE_4,
    needs=("L", "Ldiag"),
)  # fmt: skip
def diagonal_ratio(length: float, whole: float) -> float:
    return length / whole


FORE_SECTION = entries_in(vars())[len(MIDSHIP) :]
"""The entries of this module, in order."""


# --------------------------------------------------------------------------------------
# After body: half-breadths at the screw, U or V, fullness, radius.

_CHORD = (
    "between the outer skin of the half section and the chord from its lowest place to the "
    "waterline at T, above SCH; + outside the chord"
)
_HALF = "of the half section below T"


def _half_breadth(shape: FloatingShape, station: float, height: float) -> MeasuredValue:
    section = section_at(shape, shape.x_of(station))
    half = None if section is None else section.half_breadth(height)
    if half is None:
        return Absent(f"no section at station {station:g} at the height {height:.3f} m")
    return half


@parameter(
    "BCL", name="half-breadth at the shaft", unit="m", table="hull form",
    definition="of the outer skin at station 2, at the height SCH", datum="from the centre line",
    source=TABLE_4, needs=(SHAPE, "SCH"),
)  # fmt: skip
def at_shaft(shape: FloatingShape, height: float) -> MeasuredValue:
    return _half_breadth(shape, 2.0, height)


@parameter(
    "B07", name="half-breadth at 0.7 of the screw's radius", unit="m", table="hull form",
    definition="of the outer skin at station 2, at the height SCH + 0.35 D_p",
    datum="from the centre line", source=TABLE_4, needs=(SHAPE, "SCH", "D_p"),
)  # fmt: skip
def at_blade(shape: FloatingShape, height: float, diameter: float) -> MeasuredValue:
    return _half_breadth(shape, 2.0, height + 0.35 * diameter)


@parameter(
    "Tau", name="inclination of the section at station 2", unit="deg", table="hull form",
    definition="of the line through the places of the half section (outer skin) at station 2 at "
    "the heights SCH and T", datum="from the vertical, + if its upper end lies farther out",
    source=TABLE_4, needs=(SHAPE, "SCH", "BCL"),
)  # fmt: skip
def inclination(shape: FloatingShape, height: float, at_height: float) -> MeasuredValue:
    if shape.draught <= height:
        return Absent("the shaft is not below the waterline")
    top = _half_breadth(shape, 2.0, shape.draught)
    if not isinstance(top, float):
        return top
    return math.degrees(math.atan2(top - at_height, shape.draught - height))


def _off_chord(shape: FloatingShape, station: float, height: float) -> MeasuredValue:
    """Give the area (m2) between outer skin and chord, from `height` to T; + outside the chord."""
    section = section_at(shape, shape.x_of(station))
    if section is None:
        return Absent(f"no section at station {station:g}")
    y, z = float(section.lowest[1]), float(section.lowest[2])
    half = section.half_breadth(shape.draught)
    low = max(height, z)
    if half is None or low >= shape.draught:
        return Absent(f"no section at station {station:g} between shaft and waterline")
    at_low = y + (half - y) * (low - z) / (shape.draught - z)
    chord = 0.5 * (at_low + half) * (shape.draught - low)
    return section.outside(low, shape.draught) - chord


def _half_area(shape: FloatingShape, station: float) -> MeasuredValue:
    section = section_at(shape, shape.x_of(station))
    area = 0.0 if section is None else 0.5 * section.area_below(shape.draught)
    return area if area > 0.0 else Absent(f"no section at station {station:g} below the waterline")


@parameter(
    "S3.A1", name="area outside the chord at station 1.5", unit="m2", table="hull form",
    definition=f"at station 1.5, {_CHORD}", datum="port side", source=TABLE_4,
    needs=(SHAPE, "SCH"),
)  # fmt: skip
def off_chord_fore(shape: FloatingShape, height: float) -> MeasuredValue:
    return _off_chord(shape, 1.5, height)


@parameter(
    "S3.A2", name="area of the half section at station 1.5", unit="m2", table="hull form",
    definition=_HALF, datum="port side", source=TABLE_4,
)  # fmt: skip
def half_area_fore(shape: FloatingShape) -> MeasuredValue:
    return _half_area(shape, 1.5)


@parameter(
    "S3", name="stern area ratio at station 1.5", unit="-", table="hull form",
    definition="S3.A1 / S3.A2", datum="+ for U, - for V", source=TABLE_4,
    needs=("S3.A1", "S3.A2"),
)  # fmt: skip
def stern_ratio_fore(outside: float, whole: float) -> float:
    return outside / whole


@parameter(
    "S3'.A1", name="area outside the chord at station 1", unit="m2", table="hull form",
    definition=f"at station 1, {_CHORD}", datum="port side", source=TABLE_4,
    needs=(SHAPE, "SCH"),
)  # fmt: skip
def off_chord_aft(shape: FloatingShape, height: float) -> MeasuredValue:
    return _off_chord(shape, 1.0, height)


@parameter(
    "S3'.A2", name="area of the half section at station 1", unit="m2", table="hull form",
    definition=_HALF, datum="port side", source=TABLE_4,
)  # fmt: skip
def half_area_aft(shape: FloatingShape) -> MeasuredValue:
    return _half_area(shape, 1.0)


@parameter(
    "S3'", name="stern area ratio at station 1", unit="-", table="hull form",
    definition="S3'.A1 / S3'.A2", datum="+ for U, - for V", source=TABLE_4,
    needs=("S3'.A1", "S3'.A2"),
)  # fmt: skip
def stern_ratio_aft(outside: float, whole: float) -> float:
    return outside / whole


@parameter(
    "Raft", name="radius of the section at station 1.5", unit="m", table="hull form",
    definition="circle through the places of the half section (outer skin) at station 1.5 at "
    "T/4, T/2 and 3T/4", datum="+ if convex", source=TABLE_4, digits=2,
)  # fmt: skip
def after_radius(shape: FloatingShape) -> MeasuredValue:
    return radius_of_three(section_at(shape, shape.x_of(1.5)), shape.draught)


AFTER_SECTION = entries_in(vars())[len(MIDSHIP) + len(FORE_SECTION) :]
"""The entries of this module, in order."""
