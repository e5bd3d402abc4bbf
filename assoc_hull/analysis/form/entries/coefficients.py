"""Entries that compare volumes, areas, inertias and dimensions with one another.

All take values of other entries only, never the hull. Prisms have the greatest section, A_max,
unless the definition says otherwise; waterplanes are compared with the rectangle about them. Each
part counts its entries from where the part before ended: the order in this file is that of the
catalogue.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.analysis.form.parameter import (
    ITTC,
    TABLE_3,
    Absent,
    MeasuredValue,
    Warned,
    entries_in,
    parameter,
)

__all__ = [
    "PROPORTIONS",
    "VOLUME_COEFFICIENTS",
    "WATERPLANE_COEFFICIENTS",
]

# --------------------------------------------------------------------------------------
# Volumes and section areas, with boxes and prisms about them.

_ROUNDING = 1e-6
"""Rounding by which a coefficient may pass 1: that of a box is 1."""


@parameter(
    "Cb", name="block coefficient", unit="-", table="hydrostatic", ittc="C_B",
    definition="V / (Lpp B T)", source=TABLE_3, needs=("V", "Lpp", "B", "T"),
)  # fmt: skip
def block(volume: float, length: float, breadth: float, draught: float) -> float:
    return volume / (length * breadth * draught)


@parameter(
    "Cm", name="coefficient of the greatest section", unit="-", table="hydrostatic", ittc="C_X",
    definition="Amax / (B T)", source=TABLE_3, needs=("Amax", "B", "T"),
)  # fmt: skip
def greatest_section(area: float, breadth: float, draught: float) -> MeasuredValue:
    found = area / (breadth * draught)
    if found > 1.0 + _ROUNDING:
        return Warned(found, "above 1, as the largest section lies deeper than the mean draught")
    return found


@parameter(
    "Cp", name="prismatic coefficient", unit="-", table="hydrostatic", ittc="C_P",
    definition="V / (Amax Lpp)", source=TABLE_3, needs=("V", "Amax", "Lpp"),
)  # fmt: skip
def prismatic(volume: float, area: float, length: float) -> float:
    return volume / (area * length)


@parameter(
    "Cpa", name="prismatic coefficient of the after body", unit="-", table="hydrostatic",
    ittc="C_PA", definition="V_a / (Amax Lpp/2)", datum="abaft midship, overhang included",
    source=TABLE_3, needs=("V_a", "Amax", "Lpp"),
)  # fmt: skip
def prismatic_aft(volume: float, area: float, length: float) -> float:
    return volume / (0.5 * area * length)


@parameter(
    "Cpf", name="prismatic coefficient of the fore body", unit="-", table="hydrostatic",
    ittc="C_PF", definition="V_f / (Amax Lpp/2)", datum="forward of midship, bulb included",
    source=TABLE_3, needs=("V_f", "Amax", "Lpp"),
)  # fmt: skip
def prismatic_fore(volume: float, area: float, length: float) -> float:
    return volume / (0.5 * area * length)


@parameter(
    "Ea", name="fineness of the after body", unit="-", table="hydrostatic",
    definition="(Lpp / B) (1 - Cpa)", source=TABLE_3, needs=("Lpp", "B", "Cpa"),
)  # fmt: skip
def fineness_aft(length: float, breadth: float, prismatic: float) -> float:
    return length / breadth * (1.0 - prismatic)


@parameter(
    "Ef", name="fineness of the fore body", unit="-", table="hydrostatic",
    definition="(Lpp / B) (1 - Cpf)", source=TABLE_3, needs=("Lpp", "B", "Cpf"),
)  # fmt: skip
def fineness_fore(length: float, breadth: float, prismatic: float) -> float:
    return length / breadth * (1.0 - prismatic)


@parameter(
    "Ea'", name="fineness of the after body on the reduced breadth", unit="-",
    table="hydrostatic", definition="(Lpp / B') (1 - Cpa)", source=TABLE_3,
    needs=("Lpp", "B'", "Cpa"),
)  # fmt: skip
def fineness_aft_reduced(length: float, reduced: float, prismatic: float) -> float:
    return length / reduced * (1.0 - prismatic)


@parameter(
    "As", name="coefficient of form", unit="-", table="hydrostatic",
    definition="Cm / (L/B) / sqrt((B/T) Cb)", source=TABLE_3, needs=("Cm", "L/B", "B/T", "Cb"),
)  # fmt: skip
def form(section: float, slender: float, wide: float, block: float) -> float:
    found: float = section / slender / np.sqrt(wide * block)
    return found


@parameter(
    "Cb/(L/B)", name="block coefficient over length by breadth", unit="-", table="hydrostatic",
    definition="Cb / (L/B)", source=TABLE_3, needs=("Cb", "L/B"),
)  # fmt: skip
def block_over_slenderness(block: float, slender: float) -> float:
    return block / slender


@parameter(
    "BAR", name="section area at FP", unit="-", table="hydrostatic", ittc="f_BT",
    definition="A_FP / Amax", source=TABLE_3, needs=("A_FP", "Amax"),
)  # fmt: skip
def area_at_fp(area: float, greatest: float) -> float:
    return area / greatest


@parameter(
    "Cb4", name="block coefficient abaft station 4", unit="-", table="hydrostatic",
    definition="V_st4 / (B T Lpp/5)",
    datum="x < 4 of 20 stations, what lies abaft AP included; the source prints station 0.4",
    source=TABLE_3, needs=("V_st4", "B", "T", "Lpp"),
)  # fmt: skip
def block_abaft_station_4(volume: float, breadth: float, draught: float, length: float) -> float:
    return volume / (breadth * draught * 0.2 * length)


@parameter(
    "Br03", name="section area at station 3", unit="-", table="hydrostatic",
    definition="A_st3 / Amax", datum="station 3 of 20 from AP", source=TABLE_3,
    needs=("A_st3", "Amax"),
)  # fmt: skip
def area_at_station_3(area: float, greatest: float) -> float:
    return area / greatest


@parameter(
    "Cpa'", name="prismatic coefficient abaft station 5", unit="-", table="hydrostatic",
    definition="V_st5 / (A_st5 Lpp/4)",
    datum="x < 5 of 20 stations; on its own end section, not the greatest", source=TABLE_3,
    needs=("V_st5", "A_st5", "Lpp"),
)  # fmt: skip
def prismatic_abaft_station_5(volume: float, area: float, length: float) -> float:
    return volume / (area * 0.25 * length)


@parameter(
    "CPR", name="prismatic coefficient of the run", unit="-", table="hydrostatic", ittc="C_PR",
    definition="V_R / (Amax L_R)", datum="abaft the parallel body", source=TABLE_3,
    needs=("V_R", "Amax", "L_R"),
)  # fmt: skip
def prismatic_run(volume: float, area: float, length: float) -> float:
    return volume / (area * length)


@parameter(
    "CPE", name="prismatic coefficient of the entrance", unit="-", table="hydrostatic",
    ittc="C_PE", definition="V_E / (Amax L_E)", datum="forward of the parallel body",
    source=TABLE_3, needs=("V_E", "Amax", "L_E"),
)  # fmt: skip
def prismatic_entrance(volume: float, area: float, length: float) -> float:
    return volume / (area * length)


VOLUME_COEFFICIENTS = entries_in(vars())
"""The entries of this module, in order."""


# --------------------------------------------------------------------------------------
# Areas and inertias of the waterplane, with the rectangle about it.

_LEAST = 1e-6
"""Of a prism: what sections leave of it must be more, or a ratio to it is one of roundings."""


def _against(plane: float, prismatic: float) -> MeasuredValue:
    """Give what the waterplane leaves of its rectangle by what the sections leave of a prism."""
    if abs(1.0 - prismatic) < _LEAST:
        return Absent("the sections leave nothing of a prism")
    return (1.0 - plane) / (1.0 - prismatic)


@parameter(
    "Cw", name="coefficient of the waterplane", unit="-", table="hydrostatic", ittc="C_WP",
    definition="Aw / (Lpp B)", source=TABLE_3, needs=("Aw", "Lpp", "B"),
)  # fmt: skip
def waterplane_coefficient(area: float, length: float, breadth: float) -> float:
    return area / (length * breadth)


@parameter(
    "Cwa", name="coefficient of the waterplane aft", unit="-", table="hydrostatic", ittc="C_WA",
    definition="Aw_a / (B Lpp/2)", datum="abaft midship, overhang included", source=TABLE_3,
    needs=("Aw_a", "Lpp", "B"),
)  # fmt: skip
def waterplane_coefficient_aft(area: float, length: float, breadth: float) -> float:
    return area / (0.5 * length * breadth)


@parameter(
    "Cwf", name="coefficient of the waterplane forward", unit="-", table="hydrostatic",
    ittc="C_WF", definition="Aw_f / (B Lpp/2)", datum="forward of midship", source=TABLE_3,
    needs=("Aw_f", "Lpp", "B"),
)  # fmt: skip
def waterplane_coefficient_fore(area: float, length: float, breadth: float) -> float:
    return area / (0.5 * length * breadth)


@parameter(
    "Cwa'", name="coefficient of the waterplane abaft station 5", unit="-", table="hydrostatic",
    definition="Aw_st5 / (2 b_st5 Lpp/4)",
    datum="x < 5 of 20 stations; on the breadth of the waterline there", source=TABLE_3,
    needs=("Aw_st5", "b_st5", "Lpp"),
)  # fmt: skip
def waterplane_abaft_station_5(area: float, half_breadth: float, length: float) -> float:
    return area / (2.0 * half_breadth * 0.25 * length)


@parameter(
    "Sigma_a", name="waterplane against sections, after body", unit="-", table="hydrostatic",
    definition="(1 - Cwa) / (1 - Cpa)", source=TABLE_3, needs=("Cwa", "Cpa"),
)  # fmt: skip
def plane_against_sections_aft(plane: float, prismatic: float) -> MeasuredValue:
    return _against(plane, prismatic)


@parameter(
    "Sigma_f", name="waterplane against sections, fore body", unit="-", table="hydrostatic",
    definition="(1 - Cwf) / (1 - Cpf)", source=TABLE_3, needs=("Cwf", "Cpf"),
)  # fmt: skip
def plane_against_sections_fore(plane: float, prismatic: float) -> MeasuredValue:
    return _against(plane, prismatic)


@parameter(
    "Sigma_a'", name="waterplane against sections abaft station 5", unit="-",
    table="hydrostatic", definition="(1 - Cwa') / (1 - Cpa')", source=TABLE_3,
    needs=("Cwa'", "Cpa'"),
)  # fmt: skip
def plane_against_sections_abaft_station_5(plane: float, prismatic: float) -> MeasuredValue:
    return _against(plane, prismatic)


@parameter(
    "Cvpa'", name="vertical prismatic coefficient of the after body", unit="-",
    table="hydrostatic", definition="V_a / (Cwa (Lpp/2) B T_A)",
    datum="abaft midship; the source prints the whole displacement", source=TABLE_3,
    needs=("V_a", "Cwa", "Lpp", "B", "T_A"),
)  # fmt: skip
def vertical_prismatic_aft(
    volume: float, plane: float, length: float, breadth: float, draught: float
) -> float:
    return volume / (plane * 0.5 * length * breadth * draught)


@parameter(
    "Cvp", name="vertical prismatic coefficient", unit="-", table="hydrostatic", ittc="C_VP",
    definition="Cb / Cw", source=ITTC, needs=("Cb", "Cw"),
)  # fmt: skip
def vertical_prismatic(block: float, plane: float) -> float:
    return block / plane


@parameter(
    "C_IT", name="coefficient of inertia of the waterplane, transverse", unit="-",
    table="bulb and resistance", ittc="C_IT", definition="12 I_T / (Lpp B^3)",
    datum="about the centre line", source=ITTC, needs=("I_T", "Lpp", "B"),
)  # fmt: skip
def inertia_across(inertia: float, length: float, breadth: float) -> float:
    return 12.0 * inertia / (length * breadth**3)


@parameter(
    "C_IL", name="coefficient of inertia of the waterplane, longitudinal", unit="-",
    table="bulb and resistance", ittc="C_IL", definition="12 I_L / (B Lpp^3)",
    datum="about the centre of flotation", source=ITTC, needs=("I_L", "Lpp", "B"),
)  # fmt: skip
def inertia_along(inertia: float, length: float, breadth: float) -> float:
    return 12.0 * inertia / (breadth * length**3)


@parameter(
    "BMT", name="transverse metacentre above buoyancy", unit="m", table="hydrostatic",
    ittc="BM", definition="I_T / V", datum="from the centre of buoyancy, up", source=ITTC,
    needs=("I_T", "V"),
)  # fmt: skip
def metacentric_radius_across(inertia: float, volume: float) -> float:
    return inertia / volume


@parameter(
    "BML", name="longitudinal metacentre above buoyancy", unit="m", table="hydrostatic",
    ittc="BM_L", definition="I_L / V", datum="from the centre of buoyancy, up", source=ITTC,
    needs=("I_L", "V"), digits=3,
)  # fmt: skip
def metacentric_radius_along(inertia: float, volume: float) -> float:
    return inertia / volume


@parameter(
    "KML", name="longitudinal metacentre above base", unit="m", table="hydrostatic",
    ittc="KM_L", definition="KB + BML", datum="from the base line, up", source=ITTC,
    needs=("VCB", "BML"), digits=3,
)  # fmt: skip
def metacentre_along(buoyancy: float, radius: float) -> float:
    return buoyancy + radius


WATERPLANE_COEFFICIENTS = entries_in(vars())[len(VOLUME_COEFFICIENTS) :]
"""The entries of this module, in order."""


# --------------------------------------------------------------------------------------
# The principal dimensions and the volume.


@parameter(
    "B'", name="reduced breadth", unit="m", table="hydrostatic",
    definition="sqrt(B^2 / 4 + T^2)", datum="from the keel to the waterline at the side",
    source=TABLE_3, needs=("B", "T"),
)  # fmt: skip
def reduced_breadth(breadth: float, draught: float) -> float:
    found: float = np.hypot(0.5 * breadth, draught)
    return found


@parameter(
    "L/B", name="length over breadth", unit="-", table="bulb and resistance",
    definition="Lpp / B", source=ITTC, needs=("Lpp", "B"),
)  # fmt: skip
def length_over_breadth(length: float, breadth: float) -> float:
    return length / breadth


@parameter(
    "B/T", name="breadth over draught", unit="-", table="bulb and resistance",
    definition="B / T", source=ITTC, needs=("B", "T"),
)  # fmt: skip
def breadth_over_draught(breadth: float, draught: float) -> float:
    return breadth / draught


@parameter(
    "L/T", name="length over draught", unit="-", table="bulb and resistance",
    definition="Lpp / T", source=ITTC, needs=("Lpp", "T"),
)  # fmt: skip
def length_over_draught(length: float, draught: float) -> float:
    return length / draught


@parameter(
    "M", name="slenderness", unit="-", table="bulb and resistance",
    definition="Lpp / V^(1/3)", source=ITTC, needs=("Lpp", "V"),
)  # fmt: skip
def slenderness(length: float, volume: float) -> float:
    found: float = length / np.cbrt(volume)
    return found


@parameter(
    "V/L^3", name="volumetric coefficient", unit="-", table="bulb and resistance", ittc="C_∇",
    definition="V / Lpp^3", source=ITTC, needs=("V", "Lpp"), digits=6,
)  # fmt: skip
def volumetric(volume: float, length: float) -> float:
    return volume / length**3


@parameter(
    "C_S", name="coefficient of the wetted surface", unit="-", table="bulb and resistance",
    ittc="C_S", definition="WSA / sqrt(V Lpp)", source=ITTC, needs=("WSA", "V", "Lpp"),
)  # fmt: skip
def surface(wetted: float, volume: float, length: float) -> float:
    found: float = wetted / np.sqrt(volume * length)
    return found


@parameter(
    "LCF-LCB", name="flotation ahead of buoyancy", unit="m", table="bulb and resistance",
    definition="x_F - x_B", datum="+ if the centre of flotation lies forward", source=ITTC,
    needs=("LCF", "LCB", "Lpp"),
)  # fmt: skip
def flotation_ahead_of_buoyancy(flotation: float, percent: float, length: float) -> float:
    return flotation - (0.5 + 0.01 * percent) * length


@parameter(
    "BLR", name="length of the bulb over that of the ship", unit="-", table="hull form",
    definition="BL / Lpp", source=TABLE_3, needs=("BL", "Lpp"),
)  # fmt: skip
def bulb_over_length(bulb: float, length: float) -> float:
    return bulb / length


@parameter(
    "TRHL", name="breadth of the transom against its overhang", unit="-", table="hydrostatic",
    definition="(B_tr / B) / (SO / Lpp)", source=TABLE_3, needs=("B_tr", "B", "SO", "Lpp"),
)  # fmt: skip
def transom_against_overhang(
    transom: float, breadth: float, overhang: float, length: float
) -> MeasuredValue:
    if overhang <= 0.0:
        return Absent("no overhang abaft AP")
    return (transom / breadth) / (overhang / length)


PROPORTIONS = entries_in(vars())[len(VOLUME_COEFFICIENTS) + len(WATERPLANE_COEFFICIENTS) :]
"""The entries of this module, in order."""
