"""Entries of stem, bulb and fore body."""

from __future__ import annotations

from assoc_hull.analysis.form.floating_shape import FloatingShape
from assoc_hull.analysis.form.half_section import section_at
from assoc_hull.analysis.form.longitudinal_parts import ship_slices
from assoc_hull.analysis.form.parameter import (
    HOLTROP,
    KRACHT,
    SHAPE,
    TABLE_3,
    TABLE_4,
    Absent,
    MeasuredValue,
    entries_in,
    parameter,
)
from assoc_hull.analysis.form.profile import area_before_fp, bulb_tip
from assoc_hull.analysis.net.curve_net import ON_CENTRE
from assoc_hull.tolerance import length_factor

__all__ = ["BOW"]

_TIP = (
    "foremost place of the profile before FP and below the design draught, from which it runs "
    "back upward and downward"
)


@parameter(
    "BL", name="length of the bulb", unit="m", table="hull form",
    definition=f"x - Lpp at the bulb's tip: the {_TIP}", datum="from FP, + forward",
    source=TABLE_4,
)  # fmt: skip
def bulb_length(shape: FloatingShape) -> MeasuredValue:
    tip = shape.take(bulb_tip)
    return tip if isinstance(tip, Absent) else float(tip[0]) - shape.length


@parameter(
    "BH", name="height of the bulb's tip", unit="m", table="hull form",
    definition=f"z of the bulb's tip: the {_TIP}", datum="from the base line, up",
    source=TABLE_4,
)  # fmt: skip
def bulb_height(shape: FloatingShape) -> MeasuredValue:
    tip = shape.take(bulb_tip)
    return tip if isinstance(tip, Absent) else float(tip[2])


@parameter(
    "BW", name="breadth of the section at FP", unit="m", table="hull form",
    definition="greatest full breadth of the section at FP below the design draught",
    datum="both sides", source=TABLE_4,
)  # fmt: skip
def bulb_breadth(shape: FloatingShape) -> MeasuredValue:
    section = section_at(shape, shape.length)
    half = None if section is None else section.greatest_below(shape.header.draught)
    if half is None or half <= length_factor(shape.length) * ON_CENTRE:
        return Absent("no section at FP below the design draught")
    return 2.0 * half


@parameter(
    "Abulb", name="area of the section at FP", unit="m2", table="hull form",
    definition="A_FP of a ship with a bulb: the whole section, of what stands above it, too",
    datum="both sides", source=TABLE_4, needs=("BL", "A_FP"),
)  # fmt: skip
def bulb_area(bulb: float, area: float) -> float:
    return area


@parameter(
    "LBA", name="lateral area of the bulb", unit="m2", table="hull form",
    definition="area of the profile before FP and below the design draught",
    datum="in the centre plane", source=TABLE_4, needs=(SHAPE, "BL"),
)  # fmt: skip
def lateral_area(shape: FloatingShape, bulb: float) -> float:
    return area_before_fp(shape, shape.header.draught, 0.0)


@parameter(
    "LIBA", name="immersed lateral area of the bulb", unit="m2", table="hydrostatic",
    definition="area of the profile before FP and below the floating plane",
    datum="in the centre plane", source=TABLE_3, needs=(SHAPE, "BL"),
)  # fmt: skip
def immersed_lateral_area(shape: FloatingShape, bulb: float) -> float:
    rise = -shape.position.trim_by_stern / shape.length
    return area_before_fp(shape, shape.position.draught_aft, rise)


# Measures of Kracht and Holtrop.


@parameter(
    "Z_B", name="height of the bulb's foremost place", unit="m", table="measures",
    definition="BH", datum="from the base line, up", source=KRACHT, needs=("BH",),
)  # fmt: skip
def kracht_height(height: float) -> float:
    return height


@parameter(
    "L_PR", name="protruding length of the bulb", unit="m", table="measures",
    definition="BL", datum="from FP, + forward", source=KRACHT, needs=("BL",),
)  # fmt: skip
def kracht_length(length: float) -> float:
    return length


@parameter(
    "B_B", name="greatest breadth of the bulb at FP", unit="m", table="measures",
    definition="BW of a ship with a bulb", datum="both sides", source=KRACHT,
    needs=("BL", "BW"),
)  # fmt: skip
def kracht_breadth(length: float, breadth: float) -> float:
    return breadth


@parameter(
    "A_BT", name="cross section of the bulb at FP", unit="m2", table="measures",
    definition="Abulb", datum="both sides", source=KRACHT, needs=("Abulb",),
)  # fmt: skip
def kracht_across(area: float) -> float:
    return area


@parameter(
    "A_BL", name="lateral area of the bulb before FP", unit="m2", table="measures",
    definition="LBA", datum="in the centre plane", source=KRACHT, needs=("LBA",),
)  # fmt: skip
def kracht_along(area: float) -> float:
    return area


@parameter(
    "V_PR", name="volume of the protruding part of the bulb", unit="m3", table="measures",
    definition="V forward of FP, of a ship with a bulb", datum="both sides", source=KRACHT,
    needs=(SHAPE, "BL"), digits=2,
)  # fmt: skip
def kracht_volume(shape: FloatingShape, length: float) -> float:
    return shape.take(ship_slices).forward_of(shape.length).volume


@parameter(
    "h_B", name="Holtrop's height of the bulb's section", unit="m", table="bulb and resistance",
    definition="z of the centre of A_BT", datum="from the base line, up", source=HOLTROP,
    needs=(SHAPE, "A_BT"),
)  # fmt: skip
def holtrop_height(shape: FloatingShape, area: float) -> float:
    return shape.take(ship_slices).centre(shape.length)


BOW = entries_in(vars())
"""The entries of this module, in order."""
