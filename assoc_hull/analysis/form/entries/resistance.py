"""Entries that methods of resistance take: Kracht's numbers of a bulb, Holtrop's of the ends."""

from __future__ import annotations

from assoc_hull.analysis.form.floating_shape import FloatingShape
from assoc_hull.analysis.form.parameter import (
    HOLTROP,
    ITTC,
    KRACHT,
    SHAPE,
    TABLE_3,
    Absent,
    MeasuredValue,
    entries_in,
    parameter,
)

__all__ = ["RESISTANCE"]


@parameter(
    "C_LPR", name="Kracht's length of the bulb", unit="-", table="bulb and resistance",
    definition="L_PR / Lpp", source=KRACHT, needs=("L_PR", "Lpp"),
)  # fmt: skip
def bulb_length_ratio(protruding: float, length: float) -> float:
    return protruding / length


@parameter(
    "C_BB", name="Kracht's breadth of the bulb", unit="-", table="bulb and resistance",
    definition="B_B / B", datum="at FP", source=KRACHT, needs=("B_B", "B"),
)  # fmt: skip
def bulb_breadth_ratio(bulb: float, breadth: float) -> float:
    return bulb / breadth


@parameter(
    "C_ZB", name="Kracht's depth of the bulb", unit="-", table="bulb and resistance",
    definition="Z_B / T_F", datum="foremost point of the bulb, from the base line", source=KRACHT,
    needs=("Z_B", "T_F"),
)  # fmt: skip
def bulb_height_ratio(height: float, draught: float) -> float:
    return height / draught


@parameter(
    "C_ABT", name="Kracht's cross section of the bulb", unit="-", table="bulb and resistance",
    definition="A_BT / Amax", datum="at FP", source=KRACHT, needs=("A_BT", "Amax"),
)  # fmt: skip
def bulb_across(area: float, greatest: float) -> float:
    return area / greatest


@parameter(
    "C_ABL", name="Kracht's lateral area of the bulb", unit="-", table="bulb and resistance",
    definition="A_BL / Amax", datum="forward of FP", source=KRACHT, needs=("A_BL", "Amax"),
)  # fmt: skip
def bulb_along(area: float, greatest: float) -> float:
    return area / greatest


@parameter(
    "C_VPR", name="Kracht's volume of the bulb", unit="-", table="bulb and resistance",
    definition="V_PR / V", datum="forward of FP", source=KRACHT, needs=("V_PR", "V"), digits=6,
)  # fmt: skip
def bulb_volume(protruding: float, volume: float) -> float:
    return protruding / volume


@parameter(
    "f_BL", name="lateral area of the bulb over length by draught", unit="-",
    table="bulb and resistance", ittc="f_BL", definition="A_BL / (Lpp T)",
    datum="forward of FP", source=ITTC, needs=("A_BL", "Lpp", "T"), digits=6,
)  # fmt: skip
def bulb_along_plane(area: float, length: float, draught: float) -> float:
    return area / (length * draught)


@parameter(
    "TRAR", name="transom against the largest section", unit="-", table="hydrostatic", ittc="f_T",
    definition="ATT / Amax", source=TABLE_3, needs=("ATT", "Amax"),
)  # fmt: skip
def transom_area_ratio(area: float, greatest: float) -> float:
    return area / greatest


@parameter(
    "TRAR_paper", name="the same as its source prints it", unit="1/m",
    table="hydrostatic", definition="ATT / (Amax T)",
    datum="the source means a ratio, but divides by the draught too", source=TABLE_3,
    needs=("ATT", "Amax", "T"),
)  # fmt: skip
def transom_area_as_printed(area: float, greatest: float, draught: float) -> float:
    return area / (greatest * draught)


@parameter(
    "A_T", name="Holtrop's area of the transom", unit="m2", table="bulb and resistance",
    ittc="A_T", definition="ATT", datum="immersed, the ship at rest", source=HOLTROP,
    needs=("ATT",),
)  # fmt: skip
def holtrop_transom(area: float) -> float:
    return area


@parameter(
    "iE", name="Holtrop's half angle of entrance", unit="deg", table="bulb and resistance",
    ittc="i_E", definition="Eangle", datum="from the centre line", source=HOLTROP,
    needs=("Eangle",),
)  # fmt: skip
def holtrop_entrance(angle: float) -> float:
    return angle


@parameter(
    "C_M", name="Holtrop's coefficient of the midship section", unit="-",
    table="bulb and resistance", ittc="C_M", definition="A_M / (B T), A_M the section at Lpp / 2",
    datum="Cm is that of the greatest section", source=HOLTROP,
)  # fmt: skip
def midship_section(shape: FloatingShape) -> float:
    return shape.record.cm


@parameter(
    "LCB_WL", name="Holtrop's centre of buoyancy", unit="% LWL", table="bulb and resistance",
    definition="100 (x_B - x_M) / LWL, x_M halfway between the ends of the waterline",
    datum="from the middle of LWL, + forward", source=HOLTROP, needs=(SHAPE, "LCB", "Lpp", "LWL"),
)  # fmt: skip
def buoyancy_on_waterline(
    shape: FloatingShape, percent: float, length: float, waterline: float
) -> float:
    ends = shape.body.measure(shape.planes)
    middle = 0.5 * float(ends.x_least[0] + ends.x_most[0])
    return 100.0 * ((0.5 + 0.01 * percent) * length - middle) / waterline


@parameter(
    "L_R Holtrop", name="Holtrop's length of the run", unit="m", table="bulb and resistance",
    definition="LWL (1 - C + 0.06 C l / (4 C - 1)), C = V / (LWL B T C_M), l = LCB_WL",
    datum="an estimate; L_R is measured", source=HOLTROP,
    needs=("V", "B", "T", "C_M", "LWL", "LCB_WL"), digits=3,
)  # fmt: skip
def estimated_run(
    volume: float, breadth: float, draught: float, midship: float, length: float, percent: float
) -> float:
    prismatic = volume / (length * breadth * draught * midship)
    return length * (1.0 - prismatic + 0.06 * prismatic * percent / (4.0 * prismatic - 1.0))


@parameter(
    "C_stern", name="Holtrop's number of the stern", unit="-", table="bulb and resistance",
    definition="-25 pram with gondola, -10 V-shaped, 0 normal, 10 U-shaped sections",
    datum="the after body, looked at", source=HOLTROP, needs=(), digits=0,
)  # fmt: skip
def holtrop_stern() -> MeasuredValue:
    return Absent("chosen by eye from the shape of the stern's sections")


RESISTANCE = entries_in(vars())
"""The entries of this module, in order."""
