"""Entries of parts of the ship: volumes, waterplanes and sections aft and forward of a place."""

from __future__ import annotations

from assoc_hull.analysis.form.floating_shape import FloatingShape
from assoc_hull.analysis.form.longitudinal_parts import (
    LargestSection,
    ShipSlices,
    largest_section,
    parallel_body,
    ship_slices,
)
from assoc_hull.analysis.form.parameter import (
    TABLE_3,
    TABLE_4,
    Absent,
    MeasuredValue,
    Warned,
    entries_in,
    parameter,
)
from assoc_hull.geometry.floating.sections import SliceIntegrals

__all__ = ["SHIP_PARTS"]

_AP = "from AP, + forward"

_LEAST = 1e-9
"""Of B T: a section of less is none."""

_NO_BODY = "no parallel middle body"


@parameter(
    "Amax", name="area of the largest section", unit="m2", table="hydrostatic", ittc="A_X",
    definition="greatest A(x) of all sections of the surface, also between stations",
    source=TABLE_3,
)  # fmt: skip
def largest(shape: FloatingShape) -> float:
    return shape.take(largest_section).largest


@parameter(
    "x_Amax", name="place of the largest section", unit="m", table="measures",
    definition="where A(x) is greatest; of several places that nearest to midship",
    datum=_AP, source=TABLE_3,
)  # fmt: skip
def place_of_largest(shape: FloatingShape) -> float:
    return shape.take(largest_section).x_largest


@parameter(
    "V_a", name="volume of the after half", unit="m3", table="measures",
    definition="V aft of Lpp/2, with the overhang", source=TABLE_3, digits=2,
)  # fmt: skip
def volume_aft(shape: FloatingShape) -> float:
    return _aft(shape, 10.0).volume


@parameter(
    "V_f", name="volume of the forward half", unit="m3", table="measures",
    definition="V forward of Lpp/2, with the bulb", source=TABLE_3, digits=2,
)  # fmt: skip
def volume_forward(shape: FloatingShape) -> float:
    return _forward(shape).volume


@parameter(
    "LCBa", name="centre of the after half of the volume", unit="m", table="hydrostatic",
    definition="integral of x dV / V_a aft of Lpp/2", datum=_AP, source=TABLE_3,
)  # fmt: skip
def buoyancy_aft(shape: FloatingShape) -> MeasuredValue:
    part = _aft(shape, 10.0)
    return _mean(part.moment_x, part.volume, "nothing is immersed aft of midship")


@parameter(
    "LCBf", name="centre of the forward half of the volume", unit="m", table="hydrostatic",
    definition="integral of x dV / V_f forward of Lpp/2", datum=_AP, source=TABLE_3,
)  # fmt: skip
def buoyancy_forward(shape: FloatingShape) -> MeasuredValue:
    part = _forward(shape)
    return _mean(part.moment_x, part.volume, "nothing is immersed forward of midship")


@parameter(
    "V_st4", name="volume aft of station 4", unit="m3", table="measures",
    definition="V aft of 0.2 Lpp, with the overhang", source=TABLE_3, digits=2,
)  # fmt: skip
def volume_to_4(shape: FloatingShape) -> float:
    return _aft(shape, 4.0).volume


@parameter(
    "V_st5", name="volume aft of station 5", unit="m3", table="measures",
    definition="V aft of 0.25 Lpp, with the overhang", source=TABLE_3, digits=2,
)  # fmt: skip
def volume_to_5(shape: FloatingShape) -> float:
    return _aft(shape, 5.0).volume


@parameter(
    "A_st3", name="area of the section at station 3", unit="m2", table="measures",
    definition="immersed section of the surface at 0.15 Lpp", source=TABLE_3,
)  # fmt: skip
def section_at_3(shape: FloatingShape) -> MeasuredValue:
    return _section(shape, shape.x_of(3.0), "station 3")


@parameter(
    "A_st5", name="area of the section at station 5", unit="m2", table="measures",
    definition="immersed section of the surface at 0.25 Lpp", source=TABLE_3,
)  # fmt: skip
def section_at_5(shape: FloatingShape) -> MeasuredValue:
    return _section(shape, shape.x_of(5.0), "station 5")


@parameter(
    "A_FP", name="area of the section at FP", unit="m2", table="measures",
    definition="immersed section of the surface at Lpp, of bulb and hull above it; traced "
    "through the raked strips there to 1e-7 of their breadth",
    source=TABLE_3,
)  # fmt: skip
def section_at_fore_perpendicular(shape: FloatingShape) -> MeasuredValue:
    return _section(shape, shape.length, "FP")


@parameter(
    "PMBs", name="beginning of the parallel middle body", unit="st", table="hull form",
    definition="first place with A(x) >= (1 - 1e-4) Amax, at even keel at the mean draught; "
    "there is a parallel middle body if these reach over 2 % of Lpp or more, and over a quarter "
    "or more of the places with A(x) >= 0.99 Amax (a rounded top has a tenth)",
    datum="stations: 0 at AP, 20 at FP", source=TABLE_4,
)  # fmt: skip
def parallel_from(shape: FloatingShape) -> MeasuredValue:
    level = shape.take(parallel_body).level
    return Absent(_NO_BODY) if level is None else shape.station_of(level[0])


@parameter(
    "PMBe", name="end of the parallel middle body", unit="st", table="hull form",
    definition="last place with A(x) >= (1 - 1e-4) Amax, at even keel at the mean draught; "
    "see PMBs",
    datum="stations: 0 at AP, 20 at FP", source=TABLE_4,
)  # fmt: skip
def parallel_to(shape: FloatingShape) -> MeasuredValue:
    level = shape.take(parallel_body).level
    return Absent(_NO_BODY) if level is None else shape.station_of(level[1])


@parameter(
    "L_R", name="length of the run", unit="m", table="bulb and resistance", ittc="L_R",
    definition="from AP to PMBs; without a parallel middle body, to the largest section",
    source=TABLE_3, digits=3,
)  # fmt: skip
def run(shape: FloatingShape) -> MeasuredValue:
    curve = shape.take(parallel_body)
    return _parted(curve, curve.run, _part_of(curve.run, "run"))


@parameter(
    "L_E", name="length of the entrance", unit="m", table="bulb and resistance", ittc="L_E",
    definition="from PMBe to FP; without a parallel middle body, from the largest section",
    source=TABLE_3, digits=3,
)  # fmt: skip
def entrance(shape: FloatingShape) -> MeasuredValue:
    curve = shape.take(parallel_body)
    length = shape.length - curve.entrance
    return _parted(curve, length, _part_of(length, "entrance"))


@parameter(
    "V_R", name="volume of the run", unit="m3", table="measures",
    definition="V aft of where L_R ends, with the overhang", source=TABLE_3, digits=2,
)  # fmt: skip
def volume_of_run(shape: FloatingShape) -> MeasuredValue:
    curve = shape.take(parallel_body)
    missing = _part_of(curve.run, "run")
    return missing or _parted(curve, shape.take(ship_slices).aft_of(curve.run).volume)


@parameter(
    "V_E", name="volume of the entrance", unit="m3", table="measures",
    definition="V forward of where L_E begins, with the bulb", source=TABLE_3, digits=2,
)  # fmt: skip
def volume_of_entrance(shape: FloatingShape) -> MeasuredValue:
    curve = shape.take(parallel_body)
    missing = _part_of(shape.length - curve.entrance, "entrance")
    return missing or _parted(curve, shape.take(ship_slices).forward_of(curve.entrance).volume)


@parameter(
    "Aw_a", name="waterplane of the after half", unit="m2", table="measures",
    definition="area in plan aft of Lpp/2", source=TABLE_3, digits=2,
)  # fmt: skip
def waterplane_aft(shape: FloatingShape) -> float:
    return _aft(shape, 10.0).area


@parameter(
    "Aw_f", name="waterplane of the forward half", unit="m2", table="measures",
    definition="area in plan forward of Lpp/2", source=TABLE_3, digits=2,
)  # fmt: skip
def waterplane_forward(shape: FloatingShape) -> float:
    return _forward(shape).area


@parameter(
    "LCFa", name="centroid of the after half of the waterplane", unit="m", table="hydrostatic",
    definition="integral of x dA / Aw_a aft of Lpp/2", datum=_AP, source=TABLE_3,
)  # fmt: skip
def flotation_aft(shape: FloatingShape) -> MeasuredValue:
    part = _aft(shape, 10.0)
    return _mean(part.area_x, part.area, "no waterplane aft of midship")


@parameter(
    "LCFf", name="centroid of the forward half of the waterplane", unit="m",
    table="hydrostatic", definition="integral of x dA / Aw_f forward of Lpp/2",
    datum=_AP, source=TABLE_3,
)  # fmt: skip
def flotation_forward(shape: FloatingShape) -> MeasuredValue:
    part = _forward(shape)
    return _mean(part.area_x, part.area, "no waterplane forward of midship")


@parameter(
    "Aw_st5", name="waterplane aft of station 5", unit="m2", table="measures",
    definition="area in plan aft of 0.25 Lpp", source=TABLE_3, digits=2,
)  # fmt: skip
def waterplane_to_5(shape: FloatingShape) -> float:
    return _aft(shape, 5.0).area


def _aft(shape: FloatingShape, station: float) -> SliceIntegrals:
    return shape.take(ship_slices).aft_of(shape.x_of(station))


def _forward(shape: FloatingShape) -> SliceIntegrals:
    return shape.take(ship_slices).forward_of(shape.x_of(10.0))


def _mean(moment: float, amount: float, missing: str) -> MeasuredValue:
    return moment / amount if amount > 0.0 else Absent(missing)


def _section(shape: FloatingShape, x: float, where: str) -> MeasuredValue:
    """Give the area of a section; a reason where there is none or it cannot be told."""
    parts: ShipSlices = shape.take(ship_slices)
    if parts.runs_back(x):
        return Absent(f"the surface runs back at {where}")
    area = parts.area(x)
    if area <= _LEAST * shape.breadth * shape.draught:
        return Absent(f"no section at {where}")
    return area


def _part_of(length: float, name: str) -> Absent | None:
    """Say that the parallel middle body, or the largest section, leaves no such part."""
    return None if length > 0.0 else Absent(f"no {name}")


def _parted(curve: LargestSection, number: float, missing: Absent | None = None) -> MeasuredValue:
    """Give a number of a part that the parallel middle body ends, or the largest section."""
    if missing is not None:
        return missing
    if curve.level is None:
        return Warned(number, f"{_NO_BODY}: parted at the largest section")
    return number


SHIP_PARTS = entries_in(vars())
"""The entries of this module, in order."""
