"""Entries that are given, and those that the record of hydrostatics holds.

Principal dimensions and draughts come from the particulars and the floating position; volume,
centres, waterplane and wetted surface are read from the record, none is computed again.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.analysis.form.floating_shape import FloatingShape
from assoc_hull.analysis.form.parameter import (
    ITTC,
    LEWIS,
    TABLE_3,
    Absent,
    MeasuredValue,
    entries_in,
    parameter,
)

__all__ = [
    "PARTICULARS",
    "RECORD_VALUES",
    "of_waterplane",
]

# --------------------------------------------------------------------------------------
# Given: principal dimensions and draughts.


@parameter(
    "Lpp", name="length between perpendiculars", unit="m", table="particulars", ittc="L_PP",
    definition="as given", datum="from AP to FP", source=ITTC, digits=3,
)  # fmt: skip
def length(shape: FloatingShape) -> float:
    return shape.length


@parameter(
    "B", name="moulded breadth", unit="m", table="particulars", ittc="B",
    definition="as given", datum="both sides", source=ITTC, digits=3,
)  # fmt: skip
def breadth(shape: FloatingShape) -> float:
    return shape.breadth


@parameter(
    "D", name="moulded depth", unit="m", table="particulars", ittc="D",
    definition="as given", datum="from the base line, up", source=ITTC, digits=3,
)  # fmt: skip
def depth(shape: FloatingShape) -> float:
    return shape.depth


@parameter(
    "T_A", name="draught at AP", unit="m", table="particulars", ittc="T_A",
    definition="as given, on the centre line", datum="from the base line, up", source=ITTC,
    digits=3,
)  # fmt: skip
def draught_aft(shape: FloatingShape) -> float:
    return shape.position.draught_aft


@parameter(
    "T_F", name="draught at FP", unit="m", table="particulars", ittc="T_F",
    definition="as given, on the centre line", datum="from the base line, up", source=ITTC,
    digits=3,
)  # fmt: skip
def draught_fore(shape: FloatingShape) -> float:
    return shape.position.draught_fore


@parameter(
    "T", name="mean draught", unit="m", table="particulars", ittc="T",
    definition="(T_A + T_F) / 2", datum="from the base line, up", source=ITTC,
    needs=("T_A", "T_F"), digits=3,
)  # fmt: skip
def draught(aft: float, fore: float) -> float:
    return 0.5 * (aft + fore)


PARTICULARS = entries_in(vars())
"""The entries of this module, in order."""


# --------------------------------------------------------------------------------------
# Held by the record of hydrostatics.


def of_waterplane(number: float | None) -> MeasuredValue:
    """Give a number of the record that it lacks, or has as nan, where there is no waterplane."""
    if number is None or np.isnan(number):
        return Absent("no waterplane: the deck is in the water")
    return number


@parameter(
    "V", name="displacement volume", unit="m3", table="hydrostatic", ittc="∇",
    definition="moulded, with stern overhang and bulb, without appendages",
    source=TABLE_3, digits=2,
)  # fmt: skip
def volume(shape: FloatingShape) -> float:
    return shape.record.volume


@parameter(
    "Disp", name="displacement", unit="t", table="hydrostatic", ittc="Δ",
    definition="rho V shell_factor", source=TABLE_3, digits=2,
)  # fmt: skip
def displacement(shape: FloatingShape) -> float:
    return shape.record.displacement


@parameter(
    "LCB", name="centre of buoyancy", unit="% Lpp", table="hydrostatic", ittc="X_B",
    definition="100 (x_B - Lpp/2) / Lpp", datum="from midship, + forward", source=TABLE_3,
)  # fmt: skip
def buoyancy_ahead(shape: FloatingShape) -> float:
    return shape.record.lcb_percent


@parameter(
    "VCB", name="centre of buoyancy above base", unit="m", table="hydrostatic", ittc="KB",
    definition="integral of z dV / V", datum="from the base line, up", source=TABLE_3,
)  # fmt: skip
def buoyancy_above(shape: FloatingShape) -> float:
    return shape.record.kb


@parameter(
    "LWL", name="length of the waterline", unit="m", table="hydrostatic", ittc="L_WL",
    definition="from the aftmost to the foremost place of the waterline, transom included",
    datum="along x", source=TABLE_3, digits=3,
)  # fmt: skip
def waterline_length(shape: FloatingShape) -> MeasuredValue:
    return of_waterplane(shape.record.lwl)


@parameter(
    "Aw", name="area of the waterplane", unit="m2", table="measures", ittc="A_W",
    definition="in plan", source=TABLE_3, digits=2,
)  # fmt: skip
def waterplane_area(shape: FloatingShape) -> float:
    return shape.record.waterplane_area_proj


@parameter(
    "LCF", name="centre of flotation", unit="m", table="hydrostatic", ittc="X_F",
    definition="integral of x dA / A_W", datum="from AP, + forward", source=TABLE_3,
)  # fmt: skip
def flotation_ahead(shape: FloatingShape) -> MeasuredValue:
    return of_waterplane(shape.record.lcf)


@parameter(
    "WSA", name="wetted surface", unit="m2", table="hydrostatic", ittc="S",
    definition="integral of the true surface element; an immersed transom counts if asked for",
    source=TABLE_3, digits=2,
)  # fmt: skip
def wetted_surface(shape: FloatingShape) -> float:
    return shape.record.wetted_surface


@parameter(
    "KMT", name="transverse metacentre above base", unit="m", table="hydrostatic", ittc="KM_T",
    definition="KB + I_T / V", datum="from the base line, up", source=TABLE_3,
)  # fmt: skip
def metacentre(shape: FloatingShape) -> MeasuredValue:
    return of_waterplane(shape.record.kmt)


@parameter(
    "TPC", name="tons per centimetre of immersion", unit="t/cm", table="hydrostatic",
    definition="rho A_W / 100", source=LEWIS,
)  # fmt: skip
def tons_per_centimetre(shape: FloatingShape) -> float:
    return shape.record.tpc


@parameter(
    "MTC", name="moment to trim one centimetre", unit="t m/cm", table="hydrostatic",
    definition="rho V BM_L / (100 Lpp): no KG is given", source=LEWIS, digits=2,
)  # fmt: skip
def trimming(shape: FloatingShape) -> float:
    return shape.record.mtc


@parameter(
    "DCT", name="displacement per centimetre of trim by the stern", unit="t/cm",
    table="hydrostatic", definition="TPC (Lpp/2 - LCF) / Lpp, at a fixed draught midships",
    datum="+ where the displacement grows", source=LEWIS, needs=("TPC", "Lpp", "LCF"),
)  # fmt: skip
def trim_displacement(tons: float, length: float, flotation: float) -> float:
    return tons * (0.5 * length - flotation) / length


RECORD_VALUES = entries_in(vars())[len(PARTICULARS) :]
"""The entries of this module, in order."""
