"""A design to start from: a plain cargo ship of 120 m, with few definitions and round numbers.

Examples
--------
>>> from assoc_hull.shipped.plain_ship import plain_ship_design
>>> from assoc_hull.model.forms.closure import coefficients
>>> design = plain_ship_design()
>>> found = coefficients(design.definition("sectional_area"), design.particulars)
>>> round(found.block, 12), round(found.centroid, 12)
(0.68, -0.6)
"""

from __future__ import annotations

import math

from assoc_hull.creation.design import Design
from assoc_hull.creation.form_definitions import course, design_waterline, sectional_area
from assoc_hull.model.form_definition import FormDefinition
from assoc_hull.model.tables import Particulars

__all__ = ["plain_ship_design"]

SHIP = Particulars("Plain ship", 120.0, 18.0, 10.5, 7.2)
BILGE = 1.8

_RUN, _ENTRANCE = 54.0, 69.0
"""The parallel middle body lies between these x: where the curve of areas is full."""

_SIDE_AFT, _SIDE_FORE = 33.6, 84.0
"""Between these x the waterline at the design draught is full."""

_DECK_AFT, _DECK_FORE = 26.0, 89.0
"""Between these x the deck edge is."""

_POST = -77.0
"""Angle of the stern post, from the arch of the aperture down to the heel."""


def plain_ship_design() -> Design:
    """Give the design of a cargo ship of 120 m: CB 0.68, LCB 0.6 m abaft midship.

    Returns
    -------
    Design
    """
    return Design(
        SHIP,
        [_areas(), _waterline(), *_boundary(), *_angles(), *_flats()],
        stations=(
            -0.4, 0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 4.5, 5.0, 5.5, 6.0, 6.5, 7.0, 8.0, 9.0,
            10.0, 11.0, 12.0, 12.5, 13.0, 13.5, 14.0, 14.5, 15.0, 15.5, 16.0, 17.0, 18.0, 18.5,
            19.0, 19.5, 20.0,
        ),
        waterlines=(0.4, 0.9, 1.8, 2.7, 3.6, 4.5, 5.4, 6.3, 7.2, 8.1, 9.0, 9.9),
        buttocks=(1.5, 3.0, 4.5, 6.0, 7.5),
        transom=-3.5,
    )  # fmt: skip


def _areas() -> FormDefinition:
    # The parallel middle body has flats and a bilge of a radius: its area follows.
    midship = 1.0 - (2.0 - 0.5 * math.pi) * BILGE**2 / (SHIP.breadth * SHIP.draught)
    return sectional_area(
        SHIP, cm=midship, cb=0.68, lcb=-0.6,
        run_start_ordinate=0.018, run_start_angle_deg=26.0, run_area=0.598, run_centroid=-0.424,
        run_start_tangent=0.13, run_end_tangent=0.25,
        run_end=-0.1, entrance_start=0.15, entrance_end_angle_deg=-40.0,
        entrance_start_tangent=0.12,
    )  # fmt: skip


def _waterline() -> FormDefinition:
    # It begins where the contour leaves the water, 3 m abaft AP.
    return design_waterline(
        SHIP, cw=0.8, run_start=-1.05, run_start_angle_deg=71.0, run_end=-0.44,
        entrance_start=0.4, entrance_end_angle_deg=-66.0,
    )  # fmt: skip


def _boundary() -> list[FormDefinition]:
    contour = {
        "transom": {"x": -3.5, "y": 7.45, "angle_deg": -38.0},
        "counter": {"x": -3.0, "y": 7.2, "angle_deg": -31.0},
        "arch": {"x": 3.5, "y": 3.95, "angle_deg": -30.0, "leave_angle_deg": _POST},
        "heel": {"x": 4.4, "y": 0.0, "angle_deg": _POST, "leave_angle_deg": 0.0},
        "forefoot": {"x": 117.0, "y": 0.0, "angle_deg": 0.0, "tangent": 0.9},
        "stem": {"x": 120.0, "y": 7.2, "angle_deg": 82.0, "tangent": 0.6},
        "top": {"x": 123.0, "y": 12.0, "angle_deg": 57.0},
    }
    side = {
        "transom": (-3.5, 4.2, 21.0),
        "quarter": (_DECK_AFT, 9.0, 0.0),
        "shoulder": (_DECK_FORE, 9.0, 0.0),
        "stem": (123.0, 0.0, -39.5),
    }
    sheer = {
        "aft": (-3.5, 10.9, -0.8), "waist": (27.0, 10.5, 0.0), "fore": (87.0, 10.5, 0.0),
        "stem": (123.0, 12.0, 5.0),
    }  # fmt: skip
    return [
        course("profile", contour),
        course("deck_side", side),
        course("deck_height", sheer),
    ]


def _angles() -> list[FormDefinition]:
    keel = {
        "transom": (-3.5, 46.0), "AP": (0.0, 48.0), "arch": (3.3, 40.0), "post": (4.7, 12.0),
        "ST 1": (6.0, 12.0), "ST 1.5": (9.0, 33.0), "ST 2": (12.0, 68.0),
        "bottom aft": (17.0, 90.0), "bottom fore": (100.0, 90.0), "entrance": (108.0, 64.0),
        "ST 19": (114.0, 34.0), "FP": (120.0, 12.0), "stem": (123.0, 18.0),
    }  # fmt: skip
    flare = {
        "AP": (0.0, 37.0), "ST 1": (6.0, 32.0), "ST 2": (12.0, 26.0), "ST 3": (18.0, 16.0),
        "ST 4": (24.0, 9.0), "side aft": (_SIDE_AFT, 0.0), "side fore": (_SIDE_FORE, 0.0),
        "ST 17": (102.0, 6.0), "ST 19": (114.0, 12.0), "FP": (120.0, 16.0),
    }  # fmt: skip
    return [
        course("keel_angle", keel, rule="monotone"),
        course("waterline_angle", flare, rule="monotone"),
    ]


def _flats() -> list[FormDefinition]:
    flat = 0.5 * SHIP.breadth - BILGE
    bottom = {
        "aft": (17.0, 0.0, 9.0), "bilge aft": (_RUN, flat, 0.0),
        "bilge fore": (_ENTRANCE, flat, 0.0), "fore": (100.0, 0.0, -9.0),
    }  # fmt: skip
    side = {
        "deck aft": (_DECK_AFT, 10.5, -30.0), "draught aft": (_SIDE_AFT, 7.2, -20.0),
        "bilge aft": (_RUN, BILGE, 0.0), "bilge fore": (_ENTRANCE, BILGE, 0.0),
        "draught fore": (_SIDE_FORE, 7.2, 20.0), "deck fore": (_DECK_FORE, 10.6, 38.0),
    }  # fmt: skip
    return [
        course("flat_of_bottom", bottom),
        course("flat_of_side", side),
        course("bilge_radius", {"body": (60.0, BILGE)}),
    ]
