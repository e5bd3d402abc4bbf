"""Entries that compare the principal dimensions and the volume with one another."""

from __future__ import annotations

import numpy as np

from assoc_hull.analysis.form.literature import ITTC, TABLE_3
from assoc_hull.analysis.form.parameter import entries_in, parameter
from assoc_hull.analysis.form.value import Absent, Found

__all__ = ["PARAMETERS"]


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
) -> Found:
    if overhang <= 0.0:
        return Absent("no overhang abaft AP")
    return (transom / breadth) / (overhang / length)


PARAMETERS = entries_in(vars())
"""The entries of this module, in order."""
