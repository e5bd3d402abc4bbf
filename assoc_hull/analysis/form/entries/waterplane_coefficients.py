"""Entries that compare areas and inertias of the waterplane with the rectangle about it."""

from __future__ import annotations

from assoc_hull.analysis.form.literature import ITTC, TABLE_3
from assoc_hull.analysis.form.parameter import entries_in, parameter
from assoc_hull.analysis.form.value import Absent, Found

__all__ = ["PARAMETERS"]

_LEAST = 1e-6
"""Of a prism: what sections leave of it must be more, or a ratio to it is one of roundings."""


def _against(plane: float, prismatic: float) -> Found:
    """Give what the waterplane leaves of its rectangle by what the sections leave of a prism."""
    if abs(1.0 - prismatic) < _LEAST:
        return Absent("the sections leave nothing of a prism")
    return (1.0 - plane) / (1.0 - prismatic)


@parameter(
    "Cw", name="coefficient of the waterplane", unit="-", table="hydrostatic", ittc="C_WP",
    definition="Aw / (Lpp B)", source=TABLE_3, needs=("Aw", "Lpp", "B"),
)  # fmt: skip
def waterplane(area: float, length: float, breadth: float) -> float:
    return area / (length * breadth)


@parameter(
    "Cwa", name="coefficient of the waterplane aft", unit="-", table="hydrostatic", ittc="C_WA",
    definition="Aw_a / (B Lpp/2)", datum="abaft midship, overhang included", source=TABLE_3,
    needs=("Aw_a", "Lpp", "B"),
)  # fmt: skip
def waterplane_aft(area: float, length: float, breadth: float) -> float:
    return area / (0.5 * length * breadth)


@parameter(
    "Cwf", name="coefficient of the waterplane forward", unit="-", table="hydrostatic",
    ittc="C_WF", definition="Aw_f / (B Lpp/2)", datum="forward of midship", source=TABLE_3,
    needs=("Aw_f", "Lpp", "B"),
)  # fmt: skip
def waterplane_fore(area: float, length: float, breadth: float) -> float:
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
def plane_against_sections_aft(plane: float, prismatic: float) -> Found:
    return _against(plane, prismatic)


@parameter(
    "Sigma_f", name="waterplane against sections, fore body", unit="-", table="hydrostatic",
    definition="(1 - Cwf) / (1 - Cpf)", source=TABLE_3, needs=("Cwf", "Cpf"),
)  # fmt: skip
def plane_against_sections_fore(plane: float, prismatic: float) -> Found:
    return _against(plane, prismatic)


@parameter(
    "Sigma_a'", name="waterplane against sections abaft station 5", unit="-",
    table="hydrostatic", definition="(1 - Cwa') / (1 - Cpa')", source=TABLE_3,
    needs=("Cwa'", "Cpa'"),
)  # fmt: skip
def plane_against_sections_abaft_station_5(plane: float, prismatic: float) -> Found:
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


PARAMETERS = entries_in(vars())
"""The entries of this module, in order."""
