"""Entries that are given, not measured: principal dimensions and draughts."""

from __future__ import annotations

from assoc_hull.analysis.form.literature import ITTC
from assoc_hull.analysis.form.parameter import entries_in, parameter
from assoc_hull.analysis.form.shape import Shape

__all__ = ["PARAMETERS"]


@parameter(
    "Lpp", name="length between perpendiculars", unit="m", table="particulars", ittc="L_PP",
    definition="as given", datum="from AP to FP", source=ITTC, digits=3,
)  # fmt: skip
def length(shape: Shape) -> float:
    return shape.length


@parameter(
    "B", name="moulded breadth", unit="m", table="particulars", ittc="B",
    definition="as given", datum="both sides", source=ITTC, digits=3,
)  # fmt: skip
def breadth(shape: Shape) -> float:
    return shape.breadth


@parameter(
    "D", name="moulded depth", unit="m", table="particulars", ittc="D",
    definition="as given", datum="from the base line, up", source=ITTC, digits=3,
)  # fmt: skip
def depth(shape: Shape) -> float:
    return shape.depth


@parameter(
    "T_A", name="draught at AP", unit="m", table="particulars", ittc="T_A",
    definition="as given, on the centre line", datum="from the base line, up", source=ITTC,
    digits=3,
)  # fmt: skip
def draught_aft(shape: Shape) -> float:
    return shape.position.draught_aft


@parameter(
    "T_F", name="draught at FP", unit="m", table="particulars", ittc="T_F",
    definition="as given, on the centre line", datum="from the base line, up", source=ITTC,
    digits=3,
)  # fmt: skip
def draught_fore(shape: Shape) -> float:
    return shape.position.draught_fore


@parameter(
    "T", name="mean draught", unit="m", table="particulars", ittc="T",
    definition="(T_A + T_F) / 2", datum="from the base line, up", source=ITTC,
    needs=("T_A", "T_F"), digits=3,
)  # fmt: skip
def draught(aft: float, fore: float) -> float:
    return 0.5 * (aft + fore)


PARAMETERS = entries_in(vars())
"""The entries of this module, in order."""
