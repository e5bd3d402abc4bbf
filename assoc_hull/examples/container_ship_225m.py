"""A container ship of 225 m from form parameters: bulbous bow, flared forebody, flat transom.

Lpp 225 m, B 32 m, T 10.8 m and CB 0.65 are those of the container ship of S.Y. Kim, S.W. Kang, "Ship
Lines Creation by B-Spline Form Parameter Method", Trans. SNAK 29(2), 1992. They print no more of
it: all other numbers, and the way a bulb is made, are our own.
"""

from __future__ import annotations

from assoc_hull.creation.courses import course, design_waterline, sectional_area
from assoc_hull.creation.design import Design
from assoc_hull.creation.net import build_net
from assoc_hull.model.forms.definition import FormDefinition
from assoc_hull.model.state import HullState, Particulars

__all__ = ["container_ship_225m", "container_ship_225m_design"]

_SHIP = Particulars("Container ship 225 m", 225.0, 32.0, 19.6, 10.8, "open")
_CM = 0.975
_RADIUS = 4.486711
"""Of the bilge, m: that of a midship section with the coefficient above."""

_STATIONS = (
    -0.2, 0.0, 0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 11.0, 12.0, 13.0,
    14.0, 15.0, 16.0, 17.0, 17.5, 18.0, 18.5, 19.0, 19.25, 19.5, 19.75, 20.0, 20.2, 20.35, 20.45,
)
_WATERLINES = (0.6, 1.5, 3.0, 4.5, 6.0, 7.5, 9.0, 10.8, 12.5, 14.5, 16.5, 18.5)
_BUTTOCKS = (2.0, 4.0, 6.0, 8.0, 10.0, 12.0, 14.0)


def _definitions() -> list[FormDefinition]:
    return [
        sectional_area(
            _SHIP, cm=_CM, cb=0.65, lcb=-0.0125 * 225.0,
            run_start_ordinate=.0088, run_start_angle_deg=47, run_start_tangent=0.17,
            run_end=-0.06, run_end_tangent=0.34, run_area=0.637, run_centroid=-0.404,
            entrance_start=0.02, entrance_start_tangent=0.33, entrance_end_ordinate=0.091,
            entrance_end_angle_deg=-21.0, entrance_end_tangent=0.15,
        ),
        design_waterline(
            _SHIP, run_start_ordinate=.51, run_start_angle_deg=57, run_start_tangent=0.18,
            run_end=-0.41, run_end_tangent=0.18, entrance_start=0.31, entrance_start_tangent=0.18,
            entrance_end_angle_deg=-57.0, entrance_end_tangent=0.18, entrance_area=0.426,
        ),
        course("profile", {
            "transom": (-4.2, 11.1, -7.0),
            "counter": (2.0, 9.85, -20.0),
            "post": {"x": 8.8, "y": 5.0, "angle_deg": -75.0, "tangent": 0.8},
            "heel": {"x": 13.5, "y": 0.0, "angle_deg": 0.0, "tangent": 0.8, "leave_tangent": 1.0},
            "forefoot": {"x": 214.0, "y": 0.0, "angle_deg": 0.0, "leave_tangent": 1.25},
            "tip": {"x": 230.6, "y": 6.4, "angle_deg": 90.0, "curvature": 0.15, "tangent": 1.0, "leave_tangent": 1.0},
            "top": {"x": 225.8, "y": 8.9, "angle_deg": 175.0, "tangent": 1.2, "leave_tangent": 1.0},
            "neck": (224.5, 9.7, 80.0),
            "stem": (225.0, 10.8, 62.0),
            "bow": (233.5, 21.2, 48.0),
        }),
        course("deck_side", {
            "transom": (-4.2, 14.3), "poop": (5.0, 15.3), "full": (30.0, 16.0, 0.0), "break": (172.0, 16.0, 0.0), "a": (182.0, 15.9),
            "b": (192.0, 15.4), "c": (203.0, 14.2), "d": (212.0, 12.4), "e": (220.0, 9.8), "f": (227.0, 6.5), "g": (231.0, 3.4), "bow": (233.5, 0.0),
        }, rule="monotone"),
        course("deck_height", {"aft": (-4.2, 19.6, 0.0), "sheer": (175.0, 19.6, 0.0), "bow": (233.5, 21.2)}, rule="monotone"),
        course("bilge_radius", {"body": (112.5, _RADIUS)}),
        course("flat_of_side", {
            "deck_aft": (36.0, 19.6), "aft": (50.0, 15.2), "draught_aft": (66.375, 10.8), "a": (75.0, 7.7), "b": (85.0, 5.6), "c": (95.0, 4.62),
            "body_aft": (105.75, _RADIUS, 0.0), "body_fore": (114.75, _RADIUS, 0.0), "d": (125.0, 4.77), "e": (135.0, 6.5), "f": (141.0, 8.4),
            "draught_fore": (147.375, 10.8), "fore": (158.0, 14.8), "deck_fore": (172.0, 19.6),
        }, rule="monotone"),
        course("flat_of_bottom", {"n1": (42, 0), "n2": (48, 1.0), "n3": (56, 3.2), "n4": (65.25, 6.2), "n5": (75, 8.3), "n6": (85, 9.95), "n7": (95, 11.05),
            "body_aft": (105.75, 16.0 - _RADIUS, 0.0), "body_fore": (114.75, 16.0 - _RADIUS, 0.0), "g": (125.0, 11.0), "h": (137.0, 9.2),
            "i": (149.625, 6.2), "j": (160.0, 3.6), "k": (170.0, 1.7), "l": (180.0, 0.6), "fore": (190.0, 0.0),
        }, rule="monotone"),
        course("keel_angle", {"n1": (-4.2, 89.5), "n2": (-0.3, 89), "n3": (0, 88), "n4": (5, 86), "n5": (9, 35), "n6": (12, 10), "n7": (20, 14), "n8": (26, 28), "n9": (32, 48), "n10": (38, 80), "n11": (42, 90), "n12": (198, 90), "stem": (225.0, 22.0), "b1": (228.0, 38.0), "b2": (231.0, 55.0), "bow": (233.5, 75.0)}, rule="monotone"),
        course("keel_curvature", {"aft": (80.0, 0.0), "body_aft": (105.75, -1 / _RADIUS), "body_fore": (114.75, -1 / _RADIUS), "fore": (140.0, 0.0)}, rule="monotone"),
        course("keel_tangent", {"n1": (-4.2, 1.7), "n2": (-0.3, 1.7), "n3": (0, 0.6), "n4": (12, 0.5), "n5": (20, 0.4), "n6": (30, 0.35), "n7": (40, 0.4), "n8": (50, 0.55), "n9": (60, 0.6), "n10": (66.375, 1.11), "n11": (147.375, 1.11), "n12": (152, 0.6), "n13": (180, 0.6), "n14": (195, 0.72)}, rule="monotone"),
        course("waterline_angle", {"n1": (-4.2, 85), "n2": (0, 80), "n3": (10, 62), "n4": (25, 38), "n5": (40, 13), "n6": (45, 8), "n7": (50, 5), "n8": (56.25, 2.4), "n9": (66.375, 0), "n10": (147.375, 0), "n11": (158, 3.5), "n12": (163, 9), "n13": (168.75, 15), "n14": (180, 20), "n15": (190, 26), "n16": (200, 29.5), "n17": (208, 27.5), "n18": (215, 23), "n19": (220, 21), "n20": (225, 22)}, rule="monotone"),
        course("waterline_curvature", {"aft": (66.375, 0.0), "a": (85.0, -0.08), "body_aft": (105.75, -1 / _RADIUS), "body_fore": (114.75, -1 / _RADIUS), "b": (132.0, -0.08), "fore": (147.375, 0.0)}, rule="monotone"),
        course("waterline_tangent", {"aft": (60.0, 0.6), "side": (66.375, 1.11), "side_fore": (147.375, 1.11), "fore": (152.0, 0.6)}, rule="monotone"),
        course("deck_angle", {
            "transom": (-4.2, 3.0), "aft": (30.0, 0.0), "side": (172.0, 0.0), "a": (175.0, 12.0), "b": (180.0, 23.0), "c": (190.0, 41.0), "d": (203.0, 54.0), "e": (215.0, 62.0), "bow": (233.0, 68.0),
        }, rule="monotone"),
        course("bulb_area", {"n1": (197.9, 13.6), "n2": (201, 16.7), "n3": (204, 18.75), "n4": (206.5, 21.3), "n5": (209, 23.8), "n6": (211.4, 26.1), "n7": (213.75, 28.8), "n8": (216, 31.75), "n9": (218, 33.2), "n10": (220, 33.32), "n11": (221.5, 32.8), "n12": (223.3, 31.82), "FP": (225.0, 30.66336), "b1": (228.0, 21.7), "b2": (229.5, 11.0), "tip": (230.6, 0.0)}, rule="monotone"),
        course("bulb_height", {"n1": (197.9, 2.5), "n2": (202.5, 3.45), "n3": (208, 4.85), "n4": (213.75, 6.7), "n5": (217, 8.0), "n6": (219.5, 8.8), "n7": (221.5, 9.12), "n8": (223.5, 9.35), "n9": (225, 9.5)}, rule="monotone"),
        course("bulb_neck", {"n1": (197.9, 3.1), "n2": (202.5, 3.07), "n3": (208, 2.67), "n4": (213.75, 2.17), "n5": (217, 1.56), "n6": (219.5, 1.07), "n7": (221.5, 0.7), "n8": (223.5, 0.36), "n9": (225, 0.15)}, rule="monotone"),
        course("bulb_neck_angle", {"n1": (197.9, 25), "n2": (202.5, 2), "n3": (208, -7), "n4": (213.75, -14), "n5": (217, -24), "n6": (219.5, -33), "n7": (221.5, -41), "n8": (223.5, -50), "n9": (224.5, -60)}, rule="monotone"),
    ]  # fmt: skip


def container_ship_225m_design() -> Design:
    """Give the design of which the ship is created."""
    return Design(
        _SHIP, _definitions(), _STATIONS, _WATERLINES, _BUTTOCKS, transom=-4.2,
    )


def container_ship_225m() -> HullState:
    """Make the net of the container ship."""
    return build_net(container_ship_225m_design())[0]
