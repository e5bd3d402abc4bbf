"""Entries that follow from others by a formula, whichever way these were found."""

from __future__ import annotations

import math

from assoc_hull.analysis.form.parameter import entries_in, parameter

__all__ = ["PARAMETERS"]

_SOURCE = "Son and Kim, J. CAD/CAM (Korea) 13(6), 2008, Table 3"


@parameter(
    "Cb", name="block coefficient", unit="-", table="hydrostatic", ittc="C_B",
    definition="V / (Lpp B T)", source=_SOURCE, needs=("V", "Lpp", "B", "T"),
)  # fmt: skip
def block(volume: float, length: float, breadth: float, draught: float) -> float:
    return volume / (length * breadth * draught)


@parameter(
    "B'", name="reduced breadth", unit="m", table="hydrostatic",
    definition="sqrt(B^2 / 4 + T^2)", source=_SOURCE, needs=("B", "T"),
)  # fmt: skip
def reduced_breadth(breadth: float, draught: float) -> float:
    return math.hypot(0.5 * breadth, draught)


PARAMETERS = entries_in(vars())
"""The entries of this module, in order."""
