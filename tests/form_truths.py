"""Form parameters of hulls that are known by formula, in closed form or by another route.

Wigley's hull and an ellipsoid afloat at its equator: every number here is a fraction or a
formula of its own, none follows the definitions of the catalogue. The carrier is integrated by
`tests.carrier_truth`; its coefficients are put together here.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

from tests import carrier_truth

__all__ = ["carrier", "ellipsoid", "wigley"]

# Of 1 - s^2 from the end of a half length to a place: to stations 3 and 4, 5 and 10 of 20.
AT_3, TO_4, AT_5, TO_5 = 0.51, 0.416 / 3.0, 0.75, 0.625 / 3.0

SAME_BOTH_ENDS = {"LCB": 0.0, "LCF": 50.0, "LCF-LCB": 0.0, "LWL": 100.0}


def wigley() -> dict[str, float]:
    """Lpp 100, B 10, T 6.25: half-breadth B/2 (1 - s^2)(1 - t^2), a product of parabolas."""
    length, breadth, draught = 100.0, 10.0, 6.25
    volume, plane = 4.0 / 9.0 * length * breadth * draught, 2.0 / 3.0 * length * breadth
    section, reduced = 2.0 / 3.0 * breadth * draught, math.sqrt(25.0 + draught**2)
    wetted = 1487.9063104957786
    found = {
        "Lpp": length, "B": breadth, "T": draught, "V": volume, "Disp": 1.025 * volume,
        "VCB": 0.625 * draught, "Aw": plane, "WSA": wetted, "Amax": section, "x_Amax": 50.0,
        "V_a": 0.5 * volume, "V_f": 0.5 * volume, "LCBa": 31.25, "LCBf": 68.75,
        "V_st4": section * 50.0 * TO_4, "V_st5": section * 50.0 * TO_5,
        "A_st3": AT_3 * section, "A_st5": AT_5 * section,
        "Aw_a": 0.5 * plane, "Aw_f": 0.5 * plane, "LCFa": 31.25, "LCFf": 68.75,
        "Aw_st5": breadth * 50.0 * TO_5, "b_st5": AT_5 * 5.0,
        "I_T": 16.0 / 35.0 * breadth**3 * length / 12.0, "I_L": breadth * length**3 / 30.0,
        "Cb": 4.0 / 9.0, "Cm": 2.0 / 3.0, "Cp": 2.0 / 3.0, "Cpa": 2.0 / 3.0, "Cpf": 2.0 / 3.0,
        "Ea": 10.0 / 3.0, "Ef": 10.0 / 3.0, "Ea'": length / 3.0 / reduced, "B'": reduced,
        "As": 0.05 * math.sqrt(2.5), "Cb/(L/B)": 2.0 / 45.0, "Cb4": 0.208 / 0.9,
        "Br03": AT_3, "Cpa'": 5.0 / 9.0, "Cwa'": 5.0 / 9.0, "Cw": 2.0 / 3.0, "Cwa": 2.0 / 3.0,
        "Cwf": 2.0 / 3.0, "Sigma_a": 1.0, "Sigma_f": 1.0, "Sigma_a'": 1.0,
        "Cvpa'": 2.0 / 3.0, "Cvp": 2.0 / 3.0, "C_IT": 16.0 / 35.0, "C_IL": 0.4,
        "BMT": 48.0 / 35.0, "BML": 120.0, "KMT": 3.90625 + 48.0 / 35.0, "KML": 123.90625,
        "L/B": 10.0, "B/T": 1.6, "L/T": 16.0, "M": 100.0 * (2777.0 + 7.0 / 9.0) ** (-1.0 / 3.0),
        "V/L^3": 1.0 / 360.0, "C_S": wetted * math.sqrt(3.6e-6),
        "Eangle": math.degrees(math.atan(0.2)),
        "Bluntness": 25.0 * (0.04 - math.log(1.04)),
    }  # fmt: skip
    return found | SAME_BOTH_ENDS


def ellipsoid() -> dict[str, float]:
    """Semi-axes 50, 8 and 6 about (50, 0, 6), afloat at z = 6: half of it is under water."""
    pi, root = math.pi, math.sqrt(3.0)
    volume, plane, section = 1600.0 * pi, 400.0 * pi, 24.0 * pi
    cap = 0.5 * (pi / 3.0 - 0.25 * root)  # half a disc of radius 1 beyond half its radius
    centroid = 200.0 / (3.0 * pi)
    found = {
        "V": volume, "Disp": 1.025 * volume, "VCB": 3.75, "Aw": plane,
        "WSA": 1750.613101721683, "Amax": section, "x_Amax": 50.0,
        "V_a": 800.0 * pi, "V_f": 800.0 * pi, "LCBa": 31.25, "LCBf": 68.75,
        "V_st4": section * 50.0 * TO_4, "V_st5": section * 50.0 * TO_5,
        "A_st3": AT_3 * section, "A_st5": AT_5 * section,
        "Aw_a": 200.0 * pi, "Aw_f": 200.0 * pi, "LCFa": 50.0 - centroid, "LCFf": 50.0 + centroid,
        "Aw_st5": 800.0 * cap, "b_st5": 4.0 * root,
        "I_T": 6400.0 * pi, "I_L": 250000.0 * pi,
        "Cb": pi / 6.0, "Cm": pi / 4.0, "Cp": 2.0 / 3.0, "Cpa": 2.0 / 3.0, "Cpf": 2.0 / 3.0,
        "Ea": 25.0 / 12.0, "Ef": 25.0 / 12.0, "Ea'": 10.0 / 3.0, "B'": 10.0,
        "As": 0.04 * pi / math.sqrt(pi / 2.25), "Cb/(L/B)": 0.08 * pi / 3.0,
        "Cb4": pi / 4.0 * 0.104 * 10.0 / 3.0, "Br03": AT_3, "Cpa'": 5.0 / 9.0,
        "Cwa'": 4.0 * cap / root, "Cw": pi / 4.0, "Cwa": pi / 4.0, "Cwf": pi / 4.0,
        "Sigma_a": 3.0 - 0.75 * pi, "Sigma_f": 3.0 - 0.75 * pi,
        "Sigma_a'": (1.0 - 4.0 * cap / root) * 2.25, "Cvpa'": 2.0 / 3.0, "Cvp": 2.0 / 3.0,
        "C_IT": 3.0 * pi / 16.0, "C_IL": 3.0 * pi / 16.0, "BMT": 4.0, "BML": 156.25,
        "KMT": 7.75, "KML": 160.0,
    }  # fmt: skip
    return found | SAME_BOTH_ENDS


def carrier() -> dict[str, float]:
    """Lpp 300, B 50, T 18: measures by the route of waterlines, and what is made of them."""
    found = _carrier_measures()
    return found | _coefficients(found)


def _carrier_measures() -> dict[str, float]:
    whole, plane = carrier_truth.volumes(), carrier_truth.flotation_of()
    aft, fore = carrier_truth.volumes(fore=150.0), carrier_truth.volumes(aft=150.0)
    plane_aft, plane_fore = (
        carrier_truth.flotation_of(fore=150.0),
        carrier_truth.flotation_of(150.0),
    )
    across, along = carrier_truth.inertias()
    return {
        "V": whole.amount, "LCB": whole.x / 3.0 - 50.0, "VCB": whole.z,
        "Aw": plane.amount, "LCF": plane.x, "I_T": across, "I_L": along,
        "Amax": carrier_truth.area_of(150.0), "A_FP": carrier_truth.area_of(300.0),
        "A_st3": carrier_truth.area_of(45.0), "A_st5": carrier_truth.area_of(75.0),
        "V_a": aft.amount, "V_f": fore.amount, "LCBa": aft.x, "LCBf": fore.x,
        "V_st4": carrier_truth.volumes(fore=60.0).amount,
        "V_st5": carrier_truth.volumes(fore=75.0).amount,
        "Aw_a": plane_aft.amount, "Aw_f": plane_fore.amount,
        "LCFa": plane_aft.x, "LCFf": plane_fore.x,
        "Aw_st5": carrier_truth.flotation_of(fore=75.0).amount,
        "b_st5": carrier_truth.half_breadth(75.0),
        "LWL": 300.0 - carrier_truth.aft_end(), "V_PR": carrier_truth.volumes(aft=300.0).amount,
    }  # fmt: skip


def _coefficients(of: Mapping[str, float]) -> dict[str, float]:
    """On boxes and rectangles of 300 m, 150 m, 75 m and 60 m by 50 m by 18 m."""
    volume, area = of["V"], of["Amax"]
    return {
        "Cb": volume / 270000.0, "Cm": area / 900.0, "Cp": volume / (300.0 * area),
        "Cpa": of["V_a"] / (150.0 * area), "Cpf": of["V_f"] / (150.0 * area),
        "Ea": 6.0 - of["V_a"] / (25.0 * area), "Ef": 6.0 - of["V_f"] / (25.0 * area),
        "BAR": of["A_FP"] / area, "Cb4": of["V_st4"] / 54000.0, "Br03": of["A_st3"] / area,
        "Cpa'": of["V_st5"] / (75.0 * of["A_st5"]), "Cw": of["Aw"] / 15000.0,
        "Cwa": of["Aw_a"] / 7500.0, "Cwf": of["Aw_f"] / 7500.0,
        "Cwa'": of["Aw_st5"] / (150.0 * of["b_st5"]),
        "Sigma_a": (1.0 - of["Aw_a"] / 7500.0) / (1.0 - of["V_a"] / (150.0 * area)),
        "Sigma_f": (1.0 - of["Aw_f"] / 7500.0) / (1.0 - of["V_f"] / (150.0 * area)),
        "Cvpa'": of["V_a"] / (18.0 * of["Aw_a"]), "Cvp": volume / (18.0 * of["Aw"]),
        "C_IT": of["I_T"] / 3125000.0, "C_IL": of["I_L"] / 112500000.0,
        "BMT": of["I_T"] / volume, "BML": of["I_L"] / volume,
        "KMT": of["VCB"] + of["I_T"] / volume, "KML": of["VCB"] + of["I_L"] / volume,
        "LCF-LCB": of["LCF"] - 3.0 * (50.0 + of["LCB"]), "C_VPR": of["V_PR"] / volume,
    }  # fmt: skip
