"""Entries that the record of hydrostatics holds."""

from __future__ import annotations

import numpy as np

from assoc_hull.analysis.form.literature import LEWIS, TABLE_3
from assoc_hull.analysis.form.parameter import entries_in, parameter
from assoc_hull.analysis.form.shape import Shape
from assoc_hull.analysis.form.value import Absent, Found

__all__ = ["PARAMETERS", "of_waterplane"]


def of_waterplane(number: float | None) -> Found:
    """Give a number of the record that it lacks, or has as nan, where there is no waterplane."""
    if number is None or np.isnan(number):
        return Absent("no waterplane: the deck is in the water")
    return number


@parameter(
    "V", name="displacement volume", unit="m3", table="hydrostatic", ittc="∇",
    definition="moulded, with stern overhang and bulb, without appendages",
    source=TABLE_3, digits=2,
)  # fmt: skip
def volume(shape: Shape) -> float:
    return shape.record.volume


@parameter(
    "Disp", name="displacement", unit="t", table="hydrostatic", ittc="Δ",
    definition="rho V shell_factor", source=TABLE_3, digits=2,
)  # fmt: skip
def displacement(shape: Shape) -> float:
    return shape.record.displacement


@parameter(
    "LCB", name="centre of buoyancy", unit="% Lpp", table="hydrostatic", ittc="X_B",
    definition="100 (x_B - Lpp/2) / Lpp", datum="from midship, + forward", source=TABLE_3,
)  # fmt: skip
def buoyancy_ahead(shape: Shape) -> float:
    return shape.record.lcb_percent


@parameter(
    "VCB", name="centre of buoyancy above base", unit="m", table="hydrostatic", ittc="KB",
    definition="integral of z dV / V", datum="from the base line, up", source=TABLE_3,
)  # fmt: skip
def buoyancy_above(shape: Shape) -> float:
    return shape.record.kb


@parameter(
    "LWL", name="length of the waterline", unit="m", table="hydrostatic", ittc="L_WL",
    definition="from the aftmost to the foremost place of the waterline, transom included",
    datum="along x", source=TABLE_3, digits=3,
)  # fmt: skip
def waterline_length(shape: Shape) -> Found:
    return of_waterplane(shape.record.lwl)


@parameter(
    "Aw", name="area of the waterplane", unit="m2", table="measures", ittc="A_W",
    definition="in plan", source=TABLE_3, digits=2,
)  # fmt: skip
def waterplane_area(shape: Shape) -> float:
    return shape.record.waterplane_area_proj


@parameter(
    "LCF", name="centre of flotation", unit="m", table="hydrostatic", ittc="X_F",
    definition="integral of x dA / A_W", datum="from AP, + forward", source=TABLE_3,
)  # fmt: skip
def flotation_ahead(shape: Shape) -> Found:
    return of_waterplane(shape.record.lcf)


@parameter(
    "WSA", name="wetted surface", unit="m2", table="hydrostatic", ittc="S",
    definition="integral of the true surface element; an immersed transom counts if asked for",
    source=TABLE_3, digits=2,
)  # fmt: skip
def wetted_surface(shape: Shape) -> float:
    return shape.record.wetted_surface


@parameter(
    "KMT", name="transverse metacentre above base", unit="m", table="hydrostatic", ittc="KM_T",
    definition="KB + I_T / V", datum="from the base line, up", source=TABLE_3,
)  # fmt: skip
def metacentre(shape: Shape) -> Found:
    return of_waterplane(shape.record.kmt)


@parameter(
    "TPC", name="tons per centimetre of immersion", unit="t/cm", table="hydrostatic",
    definition="rho A_W / 100", source=LEWIS,
)  # fmt: skip
def immersion(shape: Shape) -> float:
    return shape.record.tpc


@parameter(
    "MTC", name="moment to trim one centimetre", unit="t m/cm", table="hydrostatic",
    definition="rho V BM_L / (100 Lpp): no KG is given", source=LEWIS, digits=2,
)  # fmt: skip
def trimming(shape: Shape) -> float:
    return shape.record.mtc


@parameter(
    "DCT", name="displacement per centimetre of trim by the stern", unit="t/cm",
    table="hydrostatic", definition="TPC (Lpp/2 - LCF) / Lpp, at a fixed draught midships",
    datum="+ where the displacement grows", source=LEWIS, needs=("TPC", "Lpp", "LCF"),
)  # fmt: skip
def trim_displacement(tons: float, length: float, flotation: float) -> float:
    return tons * (0.5 * length - flotation) / length


PARAMETERS = entries_in(vars())
"""The entries of this module, in order."""
