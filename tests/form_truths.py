"""Form parameters of hulls that are known by formula, in closed form or by another route.

Wigley's hull and an ellipsoid afloat at its equator: every number here is a fraction or a
formula of its own, none follows the definitions of the catalogue. The carrier is integrated by
`tests.carrier_truth`; its coefficients are put together here.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from assoc_hull.shipped import bulk_carrier_207k_form as form
from tests import carrier_ends, carrier_truth

__all__ = [
    "SCREW",
    "SCREW_AT",
    "SHAFT",
    "box",
    "carrier",
    "deep_carrier",
    "ellipsoid",
    "parted",
    "wigley",
]

# Of 1 - s^2 from the end of a half length to a place: to stations 3 and 4, 5 and 10 of 20.
AT_3, TO_4, AT_5, TO_5 = 0.51, 0.416 / 3.0, 0.75, 0.625 / 3.0

SHAFT, SCREW, SCREW_AT = form.SHAFT, 9.0, 4.0
"""Height of the carrier's shaft, diameter and place of a screw; m."""

SAME_BOTH_ENDS = {"LCB": 0.0, "LCF": 50.0, "LCF-LCB": 0.0, "LWL": 100.0, "LCB_WL": 0.0}


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
        "Cb": 4.0 / 9.0, "Cm": 2.0 / 3.0, "C_M": 2.0 / 3.0,
        "Cp": 2.0 / 3.0, "Cpa": 2.0 / 3.0, "Cpf": 2.0 / 3.0,
        "Ea": 10.0 / 3.0, "Ef": 10.0 / 3.0, "Ea'": length / 3.0 / reduced, "B'": reduced,
        "As": 0.05 * math.sqrt(2.5), "Cb/(L/B)": 2.0 / 45.0, "Cb4": 0.208 / 0.9,
        "Br03": AT_3, "Cpa'": 5.0 / 9.0, "Cwa'": 5.0 / 9.0, "Cw": 2.0 / 3.0, "Cwa": 2.0 / 3.0,
        "Cwf": 2.0 / 3.0, "Sigma_a": 1.0, "Sigma_f": 1.0, "Sigma_a'": 1.0,
        "Cvpa'": 2.0 / 3.0, "Cvp": 2.0 / 3.0, "C_IT": 16.0 / 35.0, "C_IL": 0.4,
        "BMT": 48.0 / 35.0, "BML": 120.0, "KMT": 3.90625 + 48.0 / 35.0, "KML": 123.90625,
        "TPC": 1.025 * 20.0 / 3.0, "MTC": 1.025 * 100.0 / 3.0,
        "L/B": 10.0, "B/T": 1.6, "L/T": 16.0, "M": 100.0 * (2777.0 + 7.0 / 9.0) ** (-1.0 / 3.0),
        "V/L^3": 1.0 / 360.0, "C_S": wetted * math.sqrt(3.6e-6),
        "Eangle": math.degrees(math.atan(0.2)),
        "Bluntness": 25.0 * (0.04 - math.log(1.04)),
    }  # fmt: skip
    return found | SAME_BOTH_ENDS | _wigley_sections(draught)


def _wigley_sections(draught: float) -> dict[str, float]:
    """All half sections are parabolas with a vertical top: y = b (2 t - t^2), t = z / T."""
    low, tip = 0.32, 0.488  # 2 m and 3.05 m, of the draught
    ahead = 1.5 * (1.0 / 6.0 - low**2 / 2.0 + low**3 / 3.0)  # outside the chord, of the whole
    golden = 0.5 * (math.sqrt(5.0) - 1.0)
    breadth = {"aft": 1.3875, "aftmost": 0.95, "fore": 0.4875}
    inner = 1.8 * (2.0 * low - low**2)
    return {
        "SCH": 2.0, "PI": 2.75, "BCL": inner, "B07": 1.8 * (2.0 * tip - tip**2),
        "Tau": math.degrees(math.atan((1.8 - inner) / 4.25)),
        "S3.A2": 2.0 / 3.0 * breadth["aft"] * draught, "S3": ahead,
        "S3'.A2": 2.0 / 3.0 * breadth["aftmost"] * draught, "S3'": ahead,
        "S3.A1": ahead * 2.0 / 3.0 * breadth["aft"] * draught,
        "S3'.A1": ahead * 2.0 / 3.0 * breadth["aftmost"] * draught,
        "Ldiag": math.hypot(5.0 / 3.0, draught), "L": golden * math.hypot(5.0 / 3.0, draught),
        "L/Ldiag": golden, "x_third": 50.0 + 50.0 * math.sqrt(2.0 / 3.0),
        "L_R Holtrop": 100.0 / 3.0, "Raft": _through_three(breadth["aft"], draught),
        "Rfwd": _through_three(breadth["fore"], draught), "SO": 0.0, "Hap": 0.0,
    }  # fmt: skip


def _through_three(breadth: float, draught: float) -> float:
    """Radius of the circle through the parabola at a quarter, a half and three quarters of T.

    With sides of 5, 3 and 8 sixteenths of b across, the triangle's area is b T / 64.
    """
    sides = [
        math.hypot(across * breadth / 16.0, along * draught / 4.0)
        for across, along in ((5.0, 1.0), (3.0, 1.0), (8.0, 2.0))
    ]
    return math.prod(sides) * 16.0 / (breadth * draught)


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
        "Cb": pi / 6.0, "Cm": pi / 4.0, "C_M": pi / 4.0,
        "Cp": 2.0 / 3.0, "Cpa": 2.0 / 3.0, "Cpf": 2.0 / 3.0,
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


def box() -> dict[str, float]:
    """100 x 20 x 12 m at 6 m, both ends flat; a screw of 3 m on a shaft at 2 m."""
    ones = ("Cb", "Cm", "C_M", "Cp", "Cpa", "Cpf", "BAR", "Cb4", "Br03", "Cpa'", "Cw", "Cwa", "Cwf",
            "Cwa'", "Cvpa'", "Cvp", "C_IT", "C_IL", "TRAR")  # fmt: skip
    found = {
        "V": 12000.0, "Disp": 12300.0, "VCB": 3.0, "Aw": 2000.0, "WSA": 3200.0, "Amax": 120.0,
        "V_a": 6000.0, "V_f": 6000.0, "LCBa": 25.0, "LCBf": 75.0, "V_st4": 2400.0,
        "V_st5": 3000.0, "A_st3": 120.0, "A_st5": 120.0, "A_FP": 120.0, "PMBs": 0.0,
        "PMBe": 20.0, "Aw_a": 1000.0, "Aw_f": 1000.0, "LCFa": 25.0, "LCFf": 75.0,
        "Aw_st5": 500.0, "b_st5": 10.0, "I_T": 2e5 / 3.0, "I_L": 5e6 / 3.0, "BMT": 50.0 / 9.0,
        "BML": 1250.0 / 9.0, "KMT": 3.0 + 50.0 / 9.0, "KML": 3.0 + 1250.0 / 9.0,
        "Ea": 0.0, "Ef": 0.0, "Ea'": 0.0, "B'": math.sqrt(136.0), "Cb/(L/B)": 0.2,
        "As": 0.2 * math.sqrt(0.3), "BW": 20.0, "ATT": 120.0, "A_T": 120.0, "B_tr": 20.0,
        "TRAR_paper": 1.0 / 6.0, "TH": 0.0, "TRZ": 6.0, "SO": 0.0, "PI": 2.5, "BCL": 10.0,
        "B07": 10.0, "Tau": 0.0, "S3.A1": 40.0 / 3.0, "S3.A2": 60.0, "S3": 2.0 / 9.0,
        "S3'.A1": 40.0 / 3.0, "S3'.A2": 60.0, "S3'": 2.0 / 9.0,
    }  # fmt: skip
    return found | SAME_BOTH_ENDS | dict.fromkeys(ones, 1.0)


def deep_carrier() -> dict[str, float]:
    """The carrier at 20 m: her transom, which begins at 18.4 m, is wet."""
    area, breadth = carrier_ends.transom_below(20.0)
    greatest = carrier_truth.area_of(150.0) + 100.0
    return {
        "ATT": area, "A_T": area, "B_tr": breadth, "TRZ": 20.0 - form.TRANSOM_LOW,
        "TRHL": breadth / 50.0 * 60.0, "TRAR": area / greatest,
        "TRAR_paper": area / greatest / 20.0, "Amax": greatest, "SO": 5.0,
    }  # fmt: skip


def carrier() -> dict[str, float]:
    """Lpp 300, B 50, T 18: measures by the route of waterlines, and what is made of them."""
    found = _carrier_measures()
    return found | _coefficients(found)


def _carrier_measures() -> dict[str, float]:
    return _volumes() | _waterplanes() | _ends() | _sections()


def _volumes() -> dict[str, float]:
    whole = carrier_truth.volumes()
    aft, fore = carrier_truth.volumes(fore=150.0), carrier_truth.volumes(aft=150.0)
    return {
        "V": whole.amount, "LCB": whole.x / 3.0 - 50.0, "VCB": whole.z,
        "V_a": aft.amount, "V_f": fore.amount, "LCBa": aft.x, "LCBf": fore.x,
        "V_st4": carrier_truth.volumes(fore=60.0).amount,
        "V_st5": carrier_truth.volumes(fore=75.0).amount,
        "V_PR": carrier_truth.volumes(aft=300.0).amount,
    }  # fmt: skip


def _waterplanes() -> dict[str, float]:
    plane, (across, along) = carrier_truth.flotation_of(), carrier_truth.inertias()
    aft, fore = carrier_truth.flotation_of(fore=150.0), carrier_truth.flotation_of(aft=150.0)
    return {
        "Aw": plane.amount, "LCF": plane.x, "I_T": across, "I_L": along,
        "Aw_a": aft.amount, "Aw_f": fore.amount, "LCFa": aft.x, "LCFf": fore.x,
        "Aw_st5": carrier_truth.flotation_of(fore=75.0).amount,
        "b_st5": float(form.carrier_half_breadth(75.0, 18.0)), "LWL": 300.0 - form.aft_end(18.0)[0],
        "Bluntness": carrier_ends.bluntness(),
    }  # fmt: skip


def _sections() -> dict[str, float]:
    area, third = (
        carrier_truth.area_of(150.0),
        carrier_ends.foremost(carrier_truth.area_of(150.0) / 3.0),
    )
    part, whole = third.diagonal()
    second, after, aftmost = (carrier_ends.HalfSection(x) for x in (30.0, 22.5, 15.0))
    outside, farther = after.off_chord(SHAFT), aftmost.off_chord(SHAFT)
    return {
        "Amax": area, "A_FP": carrier_truth.area_of(300.0), "A_st3": carrier_truth.area_of(45.0),
        "A_st5": carrier_truth.area_of(75.0), "L": part, "Ldiag": whole, "L/Ldiag": part / whole,
        "x_third": third.x,
        "BCL": second.at(SHAFT), "B07": second.at(SHAFT + 0.35 * SCREW),
        "Tau": second.inclination(SHAFT), "S3.A1": outside, "S3.A2": after.area,
        "S3": outside / after.area, "S3'.A1": farther, "S3'.A2": aftmost.area,
        "S3'": farther / aftmost.area, "Raft": after.radius(),
        "Rfwd": carrier_ends.HalfSection(292.5).radius(), "BR": form.BILGE,
    }  # fmt: skip


def _ends() -> dict[str, float]:
    area, lateral = carrier_truth.area_of(300.0), carrier_ends.bulb_area()
    z = np.linspace(0.0, 18.0, 180001)
    breadth = 2.0 * float(
        np.where(form.fore_end(z) > 300.0, form.carrier_half_breadth(300.0, z), 0.0).max()
    )
    return {
        "BL": 6.4, "BLR": 6.4 / 300.0, "BH": 7.0, "BW": breadth, "Abulb": area, "LBA": lateral,
        "LIBA": lateral, "L_PR": 6.4, "Z_B": 7.0, "B_B": breadth, "A_BT": area, "A_BL": lateral,
        "C_LPR": 6.4 / 300.0, "C_ZB": 7.0 / 18.0, "C_BB": breadth / 50.0,
        "f_BL": lateral / 5400.0, "SO": 5.0, "TH": form.TRANSOM_LOW, "ATT": 0.0, "TRAR": 0.0,
        "TRAR_paper": 0.0, "A_T": 0.0, "TRZ": 18.0 - form.TRANSOM_LOW,
        "Hap": carrier_ends.overhang(0.0),
        "StemA": carrier_ends.slope_at_ap(), "SCH": SHAFT, "PI": 18.0 - SHAFT - 0.5 * SCREW,
        "PTC": 100.0 * (carrier_ends.overhang(SCREW_AT) - SHAFT - 0.5 * SCREW) / SCREW,
        "SA": form.BOSS_FORE, "SBx": form.BOSS_AFT, "SBD": 2.0 * form.BOSS,
    }  # fmt: skip


def parted(run: float, entrance: float) -> dict[str, float]:
    """Of the carrier, what depends on where her parallel body begins and ends, m from AP."""
    area = carrier_truth.area_of(150.0)
    aft, fore = carrier_truth.volumes(fore=run), carrier_truth.volumes(aft=entrance)
    return {
        "PMBs": run / 15.0, "PMBe": entrance / 15.0, "L_R": run, "L_E": 300.0 - entrance,
        "V_R": aft.amount, "V_E": fore.amount, "CPR": aft.amount / (area * run),
        "CPE": fore.amount / (area * (300.0 - entrance)),
        "Rangle": carrier_ends.run_angle(run),
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
        "TPC": 1.025 * of["Aw"] / 100.0, "MTC": 1.025 * of["I_L"] / 30000.0,
        "DCT": 1.025 * of["Aw"] / 100.0 * (150.0 - of["LCF"]) / 300.0,
        "LCF-LCB": of["LCF"] - 3.0 * (50.0 + of["LCB"]), "C_VPR": of["V_PR"] / volume,
        "C_M": area / 900.0, "LCB_WL": _percent_of_waterline(of),
        "L_R Holtrop": _holtrop_run(volume / area, of["LWL"], _percent_of_waterline(of)),
        "C_ABT": of["A_BT"] / area, "C_ABL": of["A_BL"] / area,
    }  # fmt: skip


def _percent_of_waterline(of: Mapping[str, float]) -> float:
    """Where buoyancy acts, in percent of a waterline that ends at FP, forward of its middle."""
    ahead = 150.0 + 3.0 * of["LCB"] - (300.0 - 0.5 * of["LWL"])
    return 100.0 * ahead / of["LWL"]


def _holtrop_run(prism: float, length: float, percent: float) -> float:
    """Length of the run by Holtrop and Mennen (1982), of the prism's length in their terms."""
    cp = prism / length
    return length * (1.0 - cp) + 0.06 * prism * percent / (4.0 * cp - 1.0)
