"""What each value of a hydrostatics record is: symbol, unit, datum, sign, formula.

Symbols are those of the ITTC's list (ITTC Symbols and Terminology List, version 2021, 2.2.1
and 2.2.3), where it has one. Formulas are those of the ship's text books (E.V. Lewis, ed.,
Principles of Naval Architecture, vol. I, SNAME 1988, ch. I), for a floating plane that may be
trimmed and heeled. L is Lpp, B the moulded breadth, T the mean draught; tt and th are the
tangents of trim and heel and ``s = sqrt(1 + tt^2 + th^2)``, ``c = sqrt(1 + tt^2)``.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

import attrs

__all__ = ["FIELDS", "Field"]


@attrs.frozen
class Field:
    """What a value is.

    Attributes
    ----------
    name, symbol, unit : str
        As in the record; as on paper; a dash where there is none.
    title : str
        In words, with datum and sign.
    formula : str
        How it follows from the integrals.
    digits : int
        After the point, in a table for people.
    """

    name: str
    symbol: str
    unit: str
    title: str
    formula: str
    digits: int


_FIELDS = (
    Field("volume", "∇", "m3", "displacement volume, moulded, with appendages",
          "integral of dV below the plane", 2),
    Field("displacement", "Δ", "t", "displacement mass", "rho V shell_factor", 2),
    Field("lcb", "LCB", "m", "centre of buoyancy, from AP, + forward", "integral of x dV / V", 4),
    Field("lcb_percent", "LCB%", "% L", "centre of buoyancy from midship, + forward",
          "100 (LCB - L/2) / L", 4),
    Field("tcb", "TCB", "m", "centre of buoyancy from the centre plane, + to port",
          "integral of y dV / V", 4),
    Field("kb", "KB", "m", "centre of buoyancy above the base line: its z, also when heeled",
          "integral of z dV / V", 4),
    Field("waterplane_area", "A_W", "m2", "area of the true, inclined waterplane", "s A_proj", 2),
    Field("lcf", "LCF", "m", "centre of flotation, from AP, + forward", "integral of x dA / A", 4),
    Field("tcf", "TCF", "m", "centre of flotation from the centre plane, + to port",
          "integral of y dA / A", 4),
    Field("i_t", "I_T", "m4", "transverse second moment of the true waterplane, about its "
          "longitudinal axis through its centroid", "(s^3 / c^2) I_T_proj", 1),
    Field("i_l", "I_L", "m4", "longitudinal second moment of the true waterplane, about its "
          "transverse axis through its centroid",
          "s (c^2 I_L_proj - 2 tt th I_LT_proj + (tt th / c)^2 I_T_proj)", 0),
    Field("i_lt", "I_LT", "m4", "product of inertia of the true waterplane about these axes",
          "s^2 (I_LT_proj - tt th I_T_proj / c^2)", 1),
    Field("bmt", "BM_T", "m", "transverse metacentric radius", "I_T / V", 4),
    Field("bml", "BM_L", "m", "longitudinal metacentric radius", "I_L / V", 3),
    Field("kmt", "KM_T", "m", "transverse metacentre above the base line; none when heeled",
          "KB + BM_T", 4),
    Field("kml", "KM_L", "m", "longitudinal metacentre above the base line; none when heeled",
          "KB + BM_L", 3),
    Field("gmt", "GM_T", "m", "transverse metacentric height; none without KG, or heeled",
          "KM_T - KG", 4),
    Field("gml", "GM_L", "m", "longitudinal metacentric height; none without KG, or heeled",
          "KM_L - KG", 3),
    Field("tpc", "TPC", "t/cm", "weight that immerses by 1 cm", "rho A_W / 100", 3),
    Field("mtc", "MTC", "t m/cm", "moment that trims by 1 cm between the perpendiculars",
          "rho V GM_L / (100 L); with BM_L for GM_L where GM_L is none", 3),
    Field("wetted_surface", "S", "m2", "wetted surface, by the true surface element, with "
          "appendages; the transom if asked for", "integral of dS", 2),
    Field("wetted_surface_girth", "S_G", "m2", "girths of the sections integrated over the "
          "length; bare hull; less than S, named for comparison with published values",
          "integral of girth dx", 2),
    Field("transom_area", "A_T", "m2", "immersed area of the transom", "in its own plane", 3),
    Field("lwl", "L_WL", "m", "length of the waterplane along x", "x_most - x_least", 3),
    Field("bwl", "B_WL", "m", "breadth of the waterplane along y", "y_most - y_least", 3),
    Field("a_max", "A_X", "m2", "area of the largest station", "largest A(x)", 3),
    Field("x_a_max", "x_X", "m", "where the largest station is, from AP, + forward", "x of A_X", 3),
    Field("a_midship", "A_M", "m2", "area of the section at L/2", "A(L/2)", 3),
    Field("cb", "C_B", "-", "block coefficient", "V / (L B T)", 5),
    Field("cm", "C_M", "-", "midship section coefficient", "A_M / (B T)", 5),
    Field("cx", "C_X", "-", "coefficient of the largest section", "A_X / (B T)", 5),
    Field("cp", "C_P", "-", "prismatic coefficient, on the largest section", "V / (A_X L)", 5),
    Field("cvp", "C_VP", "-", "vertical prismatic coefficient", "C_B / C_W", 5),
    Field("cw", "C_W", "-", "waterplane coefficient", "A_W / (L B)", 5),
    Field("cb_lwl", "C_B,WL", "-", "block coefficient on the waterplane's dimensions",
          "V / (L_WL B_WL T)", 5),
    Field("cp_lwl", "C_P,WL", "-", "prismatic coefficient on the waterplane's length",
          "V / (A_X L_WL)", 5),
    Field("draught_mean", "T", "m", "mean of the draughts at AP and FP, moulded",
          "(T_A + T_F) / 2", 4),
    Field("trim_by_stern", "t", "m", "trim, + by the stern", "T_A - T_F", 4),
    Field("waterplane_area_proj", "A_proj", "m2", "area of the waterplane in plan",
          "integral of dx dy", 2),
    Field("i_t_proj", "I_T_proj", "m4", "transverse second moment in plan, about the centroid",
          "integral of (y - TCF)^2 dx dy", 1),
    Field("i_l_proj", "I_L_proj", "m4", "longitudinal second moment in plan, about the centroid",
          "integral of (x - LCF)^2 dx dy", 0),
    Field("i_lt_proj", "I_LT_proj", "m4", "product of inertia in plan, about the centroid",
          "integral of (x - LCF)(y - TCF) dx dy", 1),
)  # fmt: skip

FIELDS: Mapping[str, Field] = MappingProxyType({each.name: each for each in _FIELDS})
"""The values of a record by name, in their order."""
