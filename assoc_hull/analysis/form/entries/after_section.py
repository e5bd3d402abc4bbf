"""Entries of sections of the after body: half-breadths at the screw, U or V, fullness, radius."""

from __future__ import annotations

import math

from assoc_hull.analysis.form.literature import TABLE_4
from assoc_hull.analysis.form.parameter import SHAPE, entries_in, parameter
from assoc_hull.analysis.form.section_shape import radius_of_three, section_at
from assoc_hull.analysis.form.shape import Shape
from assoc_hull.analysis.form.value import Absent, Found

__all__ = ["PARAMETERS"]

_CHORD = (
    "between the outer skin of the half section and the chord from its lowest place to the "
    "waterline at T, above SCH; + outside the chord"
)
_HALF = "of the half section below T"


def _half_breadth(shape: Shape, station: float, height: float) -> Found:
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
def at_shaft(shape: Shape, height: float) -> Found:
    return _half_breadth(shape, 2.0, height)


@parameter(
    "B07", name="half-breadth at 0.7 of the screw's radius", unit="m", table="hull form",
    definition="of the outer skin at station 2, at the height SCH + 0.35 D_p",
    datum="from the centre line", source=TABLE_4, needs=(SHAPE, "SCH", "D_p"),
)  # fmt: skip
def at_blade(shape: Shape, height: float, diameter: float) -> Found:
    return _half_breadth(shape, 2.0, height + 0.35 * diameter)


@parameter(
    "Tau", name="inclination of the section at station 2", unit="deg", table="hull form",
    definition="of the line through the places of the half section (outer skin) at station 2 at "
    "the heights SCH and T", datum="from the vertical, + if its upper end lies farther out",
    source=TABLE_4, needs=(SHAPE, "SCH", "BCL"),
)  # fmt: skip
def inclination(shape: Shape, height: float, at_height: float) -> Found:
    if shape.draught <= height:
        return Absent("the shaft is not below the waterline")
    top = _half_breadth(shape, 2.0, shape.draught)
    if not isinstance(top, float):
        return top
    return math.degrees(math.atan2(top - at_height, shape.draught - height))


def _off_chord(shape: Shape, station: float, height: float) -> Found:
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


def _half_area(shape: Shape, station: float) -> Found:
    section = section_at(shape, shape.x_of(station))
    area = 0.0 if section is None else 0.5 * section.area_below(shape.draught)
    return area if area > 0.0 else Absent(f"no section at station {station:g} below the waterline")


@parameter(
    "S3.A1", name="area outside the chord at station 1.5", unit="m2", table="hull form",
    definition=f"at station 1.5, {_CHORD}", datum="port side", source=TABLE_4,
    needs=(SHAPE, "SCH"),
)  # fmt: skip
def off_chord_fore(shape: Shape, height: float) -> Found:
    return _off_chord(shape, 1.5, height)


@parameter(
    "S3.A2", name="area of the half section at station 1.5", unit="m2", table="hull form",
    definition=_HALF, datum="port side", source=TABLE_4,
)  # fmt: skip
def half_area_fore(shape: Shape) -> Found:
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
def off_chord_aft(shape: Shape, height: float) -> Found:
    return _off_chord(shape, 1.0, height)


@parameter(
    "S3'.A2", name="area of the half section at station 1", unit="m2", table="hull form",
    definition=_HALF, datum="port side", source=TABLE_4,
)  # fmt: skip
def half_area_aft(shape: Shape) -> Found:
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
def after_radius(shape: Shape) -> Found:
    return radius_of_three(section_at(shape, shape.x_of(1.5)), shape.draught)


PARAMETERS = entries_in(vars())
"""The entries of this module, in order."""
