"""The designs of three examples, with courses that are solved for fair sections along the ship.

The courses that shape sections are splines of few nodes here, and their values those that
`assoc_hull.creation.fair_courses` found, rounded. Areas, waterline, contour, flats and deck are
those of the examples. Ships from six numbers are carried from these designs.

Examples
--------
>>> from assoc_hull.shipped.fair_designs import fair_bulk_carrier_design
>>> fair_bulk_carrier_design().definition("keel_angle").rule
'spline'
"""

from __future__ import annotations

from collections.abc import Mapping

from assoc_hull.creation.design import Design
from assoc_hull.creation.form_definitions import course
from assoc_hull.shipped import bulk_carrier_180m, container_ship_225m, plain_ship

__all__ = ["fair_bulk_carrier_design", "fair_container_ship_design", "fair_plain_ship_design"]

Node = tuple[float, ...] | Mapping[str, float | None]


def _having(design: Design, courses: Mapping[str, Mapping[str, Node]]) -> Design:
    """Give a design with courses by the rule ``spline``."""
    return design.having(*(course(use, nodes, rule="spline") for use, nodes in courses.items()))


def fair_bulk_carrier_design() -> Design:
    """Give the bulk carrier of 180 m with solved courses."""
    return _having(bulk_carrier_180m.bulk_carrier_180m_design(), _BULK_CARRIER)


def fair_container_ship_design() -> Design:
    """Give the container ship of 225 m with solved courses, flats and bulb."""
    return _having(container_ship_225m.container_ship_225m_design(), _CONTAINER_SHIP)


def fair_plain_ship_design() -> Design:
    """Give the plain ship of 120 m with solved courses."""
    return _having(plain_ship.plain_ship_design(), _PLAIN_SHIP)


# --------------------------------------------------------------------------------------
# Nodes: x (m from AP) and ordinate. One with an angle is held when a ship is solved; where a node
# leaves anew, the stern post parts the course.

_BULK_BEND = -1.0 / bulk_carrier_180m.BILGE
_BOX_BILGE = container_ship_225m.BILGE
_BOX_BEND = -1.0 / _BOX_BILGE
_PLAIN_BEND = -1.0 / plain_ship.BILGE
"""Bilges of the parallel middle bodies, m, and their curvatures, 1/m."""

_BULB = container_ship_225m.BULB * container_ship_225m.FULL
"""m2, at FP."""

_BULK_CARRIER: Mapping[str, Mapping[str, Node]] = {
    "keel_angle": {
        "transom": (-5.0, 60.171), "AP": (0.0, 27.347),
        "arch": {"x": 5.2, "y": 3.981, "leave_angle_deg": 0.0},
        "heel": {"x": 6.5, "y": 1.0, "leave_angle_deg": 0.0}, "ST 1.1": (10.0, 10.594),
        "ST 1.6": (14.5, 33.429), "ST 2.2": (20.0, 77.29), "bottom aft": (26.0, 90.0, 0.0),
        "bottom fore": (167.5, 90.0, 0.0), "ST 19": (171.0, 69.269),
        "ST 19.5": (175.5, 18.298), "FP": (180.0, 8.186), "head": (184.5, 68.933),
    },
    "keel_curvature": {
        "transom": (-5.0, 0.0), "arch": {"x": 5.2, "y": 0.0, "leave_angle_deg": 0.0},
        "heel": {"x": 6.5, "y": 0.0, "leave_angle_deg": 0.0}, "ST 1.4": (13.0, 0.0),
        "bottom aft": (26.0, 0.0), "ST 4.2": (38.0, -0.0033), "side aft": (50.4, -0.0843),
        "ST 6.8": (61.0, -0.3396), "body aft": (71.28, _BULK_BEND, 0.0),
        "body fore": (120.6, _BULK_BEND, 0.0), "ST 14.3": (129.0, -0.6247),
        "side fore": (136.8, -0.3212), "ST 16.9": (152.0, -0.1301),
        "bottom fore": (167.5, -0.078), "FP": (180.0, -0.0872),
    },
    "keel_tangent": {
        "transom": (-5.0, 0.339), "arch": {"x": 5.2, "y": 0.41, "leave_angle_deg": 0.0},
        "heel": {"x": 6.5, "y": 1.101, "leave_angle_deg": 0.0}, "ST 1.4": (13.0, 0.544),
        "bottom aft": (26.0, 0.505), "ST 4.2": (38.0, 1.044), "side aft": (50.4, 1.044),
        "ST 6.8": (61.0, 1.265), "body aft": (71.28, 1.11, 0.0),
        "body fore": (120.6, 1.11, 0.0), "ST 14.3": (129.0, 1.241),
        "side fore": (136.8, 0.842), "ST 16.9": (152.0, 1.4),
        "bottom fore": (167.5, 0.367), "FP": (180.0, 0.786),
    },
    "waterline_angle": {
        "transom": (-5.0, 61.807), "AP": (0.0, 41.548), "ST 0.6": (5.0, 37.704),
        "ST 1.2": (11.0, 32.532), "ST 2": (18.0, 26.659), "ST 3": (27.0, 20.625),
        "ST 4.2": (38.0, 12.335), "side aft": (50.4, 0.0, 0.0),
        "side fore": (136.8, 0.0, 0.0), "ST 16.3": (147.0, 7.687),
        "ST 17.6": (158.0, 3.965), "ST 18.8": (169.0, 0.0), "FP": (180.0, 3.051),
    },
    "waterline_curvature": {
        "transom": (-5.0, 0.0), "ST 0.3": (3.0, 0.0), "ST 1.2": (11.0, 0.0),
        "bottom aft": (26.0, 0.0), "ST 4.2": (38.0, -0.0123), "side aft": (50.4, -0.0063),
        "ST 6.8": (61.0, -0.0897), "body aft": (71.28, _BULK_BEND, 0.0),
        "body fore": (120.6, _BULK_BEND, 0.0), "ST 14.3": (129.0, -0.1065),
        "side fore": (136.8, 0.0), "ST 16.9": (152.0, 0.0), "ST 18.4": (166.0, 0.0),
        "FP": (180.0, 0.0),
    },
    "waterline_tangent": {
        "transom": (-5.0, 0.825), "arch": {"x": 5.2, "y": 1.4, "leave_angle_deg": 0.0},
        "heel": {"x": 6.5, "y": 1.4, "leave_angle_deg": 0.0}, "ST 1.4": (13.0, 1.15),
        "bottom aft": (26.0, 1.4), "ST 4.2": (38.0, 1.4), "side aft": (50.4, 1.1),
        "ST 6.8": (61.0, 0.976), "body aft": (71.28, 1.11, 0.0),
        "body fore": (120.6, 1.11, 0.0), "ST 14.3": (129.0, 0.911),
        "side fore": (136.8, 1.102), "ST 16.9": (152.0, 1.068),
        "bottom fore": (167.5, 0.737), "FP": (180.0, 0.648),
    },
    "deck_angle": {
        "transom": (-5.0, 32.702), "ST 0.4": (4.0, 48.421), "ST 1.4": (13.0, 56.102),
        "ST 2.4": (22.0, 47.887), "ST 3.6": (32.0, 21.384), "full aft": (42.0, 0.0, 0.0),
        "full fore": (142.0, 0.0, 0.0), "ST 16.9": (152.0, 23.857),
        "ST 18.1": (163.0, 48.196), "ST 19.3": (174.0, 50.418), "head": (184.5, 41.531),
    },
}  # fmt: skip

_CONTAINER_SHIP: Mapping[str, Mapping[str, Node]] = {
    "flat_of_side": {
        "full aft": (36.0, 19.6), "ST 4.4": (50.0, 15.2), "side aft": (66.375, 10.8),
        "ST 7.6": (85.0, 5.7), "body aft": (105.75, _BOX_BILGE, 0.0),
        "body fore": (114.75, _BOX_BILGE, 0.0), "ST 11.6": (131.0, 5.607),
        "side fore": (147.375, 10.8), "ST 14": (158.0, 14.8), "full fore": (172.0, 19.6),
    },
    "flat_of_bottom": {
        "bottom aft": (42.0, 0.0), "ST 5": (56.0, 3.2), "ST 6.7": (75.0, 8.3),
        "body aft": (105.75, 16.0 - _BOX_BILGE, 0.0), "body fore": (114.75, 16.0 - _BOX_BILGE, 0.0),
        "ST 12.2": (137.0, 9.2), "ST 14.2": (160.0, 3.6), "ST 15.6": (175.0, 1.1),
        "bottom fore": (190.0, 0.0),
    },
    "keel_angle": {
        "transom": (-4.2, 73.181), "AP": (0.0, 83.009), "ST 0.4": (4.0, 79.149),
        "ST 0.8": (8.5, 16.734), "heel": (13.5, 4.951), "ST 1.8": (20.0, 23.932),
        "ST 2.5": (28.0, 47.954), "ST 3.1": (35.0, 72.569),
        "bottom aft": (42.0, 90.0, 0.0), "neck": (198.0, 90.0, 0.0), "FP": (225.0, 23.954),
        "ST 20.4": (229.0, 40.988), "bow": (233.5, 50.673),
    },
    "keel_curvature": {
        "transom": (-4.2, 0.1905), "ST 0.4": (4.0, 0.1266), "heel": (13.5, 0.0),
        "ST 2.3": (26.0, 0.0), "bottom aft": (42.0, 0.0), "ST 4.8": (54.0, -0.0484),
        "side aft": (66.375, -0.0782), "ST 7.6": (86.0, -0.1263),
        "body aft": (105.75, _BOX_BEND, 0.0), "body fore": (114.75, _BOX_BEND, 0.0),
        "ST 11.6": (131.0, -0.1691), "side fore": (147.375, -0.1021),
        "ST 14.7": (165.0, -0.0816), "ST 16.2": (182.0, -0.0697), "neck": (198.0, -0.1566),
    },
    "keel_tangent": {
        "transom": (-4.2, 1.4), "ST 0.4": (4.0, 0.248), "heel": (13.5, 0.52),
        "ST 2.3": (26.0, 0.31), "bottom aft": (42.0, 0.391), "ST 4.8": (54.0, 0.857),
        "side aft": (66.375, 1.233), "ST 7.6": (86.0, 1.244),
        "body aft": (105.75, 1.11, 0.0), "body fore": (114.75, 1.11, 0.0),
        "ST 11.6": (131.0, 1.218), "side fore": (147.375, 1.253),
        "ST 14.7": (165.0, 0.956), "ST 16.2": (182.0, 0.737), "neck": (198.0, 0.814),
    },
    "waterline_angle": {
        "transom": (-4.2, 85.49), "AP": (0.0, 78.171), "ST 0.5": (6.0, 72.767),
        "ST 1.2": (14.0, 64.491), "ST 2.2": (25.0, 43.007), "ST 3.6": (40.0, 20.214),
        "ST 4.6": (52.0, 6.457), "side aft": (66.375, 0.0, 0.0),
        "side fore": (147.375, 0.0, 0.0), "ST 14": (158.0, 5.984),
        "full fore": (172.0, 19.781), "ST 16.6": (187.0, 27.852),
        "ST 17.8": (200.0, 29.855), "ST 18.9": (213.0, 27.313), "FP": (225.0, 23.307),
    },
    "waterline_curvature": {
        "transom": (-4.2, -0.2011), "ST 0.5": (6.0, -0.1062), "ST 1.8": (20.0, -0.1644),
        "bottom aft": (42.0, -0.1045), "ST 4.8": (54.0, -0.0593),
        "side aft": (66.375, 0.0), "ST 7.6": (86.0, -0.0948),
        "body aft": (105.75, _BOX_BEND, 0.0), "body fore": (114.75, _BOX_BEND, 0.0),
        "ST 11.6": (131.0, -0.0675), "side fore": (147.375, 0.0),
        "ST 14.7": (165.0, -0.0161), "ST 16.2": (182.0, -0.0313), "neck": (198.0, 0.0),
        "ST 18.8": (212.0, 0.0), "FP": (225.0, -0.0545),
    },
    "waterline_tangent": {
        "transom": (-4.2, 0.2), "ST 0.4": (4.0, 1.101), "heel": (13.5, 1.054),
        "ST 2.3": (26.0, 0.727), "bottom aft": (42.0, 0.564), "ST 4.8": (54.0, 0.758),
        "side aft": (66.375, 1.081), "ST 7.6": (86.0, 1.114),
        "body aft": (105.75, 1.11, 0.0), "body fore": (114.75, 1.11, 0.0),
        "ST 11.6": (131.0, 1.131), "side fore": (147.375, 1.079),
        "ST 14.7": (165.0, 0.788), "ST 16.2": (182.0, 0.772), "neck": (198.0, 0.913),
        "ST 18.8": (212.0, 0.467), "FP": (225.0, 0.518),
    },
    "deck_angle": {
        "transom": (-4.2, 4.597), "ST 0.7": (8.0, 2.35), "ST 1.8": (20.0, 6.167),
        "full aft": (36.0, 0.0, 0.0), "full fore": (172.0, 0.0, 0.0),
        "ST 16": (180.0, 16.817), "bottom fore": (190.0, 39.991), "ST 18": (203.0, 56.581),
        "ST 19.4": (218.0, 66.452), "ST 20.7": (233.0, 68.551),
    },
    "bulb_area": {
        "neck": (197.9, 12.976), "ST 18.1": (204.0, 17.64), "ST 18.8": (211.0, 26.615),
        "ST 19.4": (218.0, 33.19), "FP": (225.0, _BULB), "ST 20.3": (228.0, 21.7),
        "tip": (230.6, 0.0),
    },
    "bulb_height": {
        "neck": (197.9, 2.578), "ST 18.1": (204.0, 3.683), "ST 18.8": (211.0, 5.854),
        "ST 19.4": (218.0, 8.261), "FP": (225.0, 9.617),
    },
    "bulb_neck": {
        "neck": (197.9, 3.334), "ST 18.1": (204.0, 3.035), "ST 18.8": (211.0, 2.495),
        "ST 19.4": (218.0, 1.358), "FP": (225.0, 0.063),
    },
    "bulb_neck_angle": {
        "neck": (197.9, 22.263), "ST 18.1": (204.0, 7.95), "ST 18.8": (211.0, -7.245),
        "ST 19.4": (218.0, -29.244), "ST 20": (224.5, -68.234),
    },
}  # fmt: skip

_PLAIN_SHIP: Mapping[str, Mapping[str, Node]] = {
    "keel_angle": {
        "transom": (-3.5, 36.276), "AP": (0.0, 64.671),
        "arch": {"x": 3.45, "y": 1.0, "leave_angle_deg": 0.0},
        "heel": {"x": 4.4, "y": 2.492, "leave_angle_deg": 0.0}, "ST 1.2": (7.0, 4.717),
        "ST 1.7": (10.0, 23.546), "ST 2.2": (13.0, 64.808),
        "bottom aft": (17.0, 90.0, 0.0), "bottom fore": (100.0, 90.0, 0.0),
        "ST 17.5": (105.0, 81.391), "ST 18.7": (112.0, 33.88), "FP": (120.0, 7.056),
        "stem": (123.0, 17.758),
    },
    "waterline_angle": {
        "transom": (-3.5, 35.31), "AP": (0.0, 41.411), "ST 0.7": (4.0, 43.332),
        "ST 1.3": (8.0, 38.654), "ST 2.2": (13.0, 30.295), "ST 3.2": (19.0, 23.101),
        "full aft": (26.0, 11.719), "side aft": (33.6, 0.0, 0.0),
        "side fore": (84.0, 0.0, 0.0), "ST 15.3": (92.0, 13.217),
        "ST 16.8": (101.0, 20.34), "ST 18.5": (111.0, 20.997), "FP": (120.0, 11.273),
    },
    "keel_curvature": {
        "transom": (-3.5, 0.2315), "arch": {"x": 3.45, "y": 0.0, "leave_angle_deg": 0.0},
        "heel": {"x": 4.4, "y": 0.0, "leave_angle_deg": 0.0}, "ST 1.5": (9.0, 0.0),
        "bottom aft": (17.0, -0.0138), "ST 4.2": (25.0, -0.0478),
        "side aft": (33.6, -0.2043), "ST 7.3": (44.0, -0.4156),
        "body aft": (54.0, _PLAIN_BEND, 0.0), "body fore": (69.0, _PLAIN_BEND, 0.0),
        "ST 12.7": (76.0, -0.5332), "side fore": (84.0, -0.2507),
        "ST 15.5": (93.0, -0.0385), "bottom fore": (100.0, 0.0),
        "ST 18.3": (110.0, -0.0971), "FP": (120.0, -0.3366),
    },
    "keel_tangent": {
        "transom": (-3.5, 1.4), "arch": {"x": 3.45, "y": 0.378, "leave_angle_deg": 0.0},
        "heel": {"x": 4.4, "y": 0.931, "leave_angle_deg": 0.0}, "ST 1.5": (9.0, 0.457),
        "bottom aft": (17.0, 0.497), "ST 4.2": (25.0, 0.935), "side aft": (33.6, 1.104),
        "ST 7.3": (44.0, 1.018), "body aft": (54.0, 1.11, 0.0),
        "body fore": (69.0, 1.11, 0.0), "ST 12.7": (76.0, 0.74),
        "side fore": (84.0, 1.059), "ST 15.5": (93.0, 0.911),
        "bottom fore": (100.0, 0.756), "ST 18.3": (110.0, 0.75), "FP": (120.0, 0.628),
    },
    "waterline_tangent": {
        "transom": (-3.5, 0.2), "arch": {"x": 3.45, "y": 0.2, "leave_angle_deg": 0.0},
        "heel": {"x": 4.4, "y": 1.021, "leave_angle_deg": 0.0}, "ST 1.5": (9.0, 1.046),
        "bottom aft": (17.0, 1.241), "ST 4.2": (25.0, 0.823), "side aft": (33.6, 0.8),
        "ST 7.3": (44.0, 1.146), "body aft": (54.0, 1.11, 0.0),
        "body fore": (69.0, 1.11, 0.0), "ST 12.7": (76.0, 1.321),
        "side fore": (84.0, 0.803), "ST 15.5": (93.0, 1.133), "bottom fore": (100.0, 1.4),
        "ST 18.3": (110.0, 0.524), "FP": (120.0, 0.2),
    },
    "waterline_curvature": {
        "transom": (-3.5, 0.0), "ST 0.5": (3.0, 0.0), "ST 1.5": (9.0, 0.0),
        "bottom aft": (17.0, -0.0044), "ST 4.2": (25.0, -0.0045), "side aft": (33.6, 0.0),
        "ST 7.3": (44.0, -0.1103), "body aft": (54.0, _PLAIN_BEND, 0.0),
        "body fore": (69.0, _PLAIN_BEND, 0.0), "ST 12.7": (76.0, -0.0851),
        "side fore": (84.0, 0.0), "ST 16": (96.0, -0.0381), "ST 18": (108.0, 0.0),
        "FP": (120.0, 0.0),
    },
    "deck_angle": {
        "transom": (-3.5, 34.182), "ST 0.5": (3.0, 43.238), "ST 1.5": (9.0, 50.929),
        "ST 2.5": (15.0, 43.275), "ST 3.5": (21.0, 15.488), "full aft": (26.0, 0.0, 0.0),
        "full fore": (89.0, 0.0, 0.0), "ST 16.2": (97.0, 13.864),
        "ST 17.7": (106.0, 44.234), "ST 19.2": (115.0, 54.105), "stem": (123.0, 39.506),
    },
}  # fmt: skip
