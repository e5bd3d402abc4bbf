"""Entries that compare volumes and section areas with boxes and prisms about them.

Prisms have the greatest section, A_max, unless the definition says otherwise.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.analysis.form.literature import TABLE_3
from assoc_hull.analysis.form.parameter import entries_in, parameter
from assoc_hull.analysis.form.value import Found, Warned

__all__ = ["PARAMETERS"]

_ROUNDING = 1e-6
"""By so much a coefficient may pass 1: a box has one of 1."""


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
def greatest_section(area: float, breadth: float, draught: float) -> Found:
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


PARAMETERS = entries_in(vars())
"""The entries of this module, in order."""
