"""A design to start from: a plain cargo ship of 120 m, with few definitions and round numbers.

Examples
--------
>>> from assoc_hull.examples.plain_ship import plain_ship_design
>>> from assoc_hull.model.forms.closure import coefficients
>>> design = plain_ship_design()
>>> found = coefficients(design.definition("sectional_area"), design.particulars)
>>> round(found.block, 12), round(found.centroid, 12)
(0.68, -0.6)
"""

from __future__ import annotations

import math

from assoc_hull.creation.courses import course, design_waterline, sectional_area
from assoc_hull.creation.design import Design
from assoc_hull.model.forms.definition import FormDefinition
from assoc_hull.model.state import Particulars

__all__ = ["plain_ship_design"]

SHIP = Particulars("Plain ship", 120.0, 18.0, 10.5, 7.2)
BILGE = 1.8


def plain_ship_design() -> Design:
    """Give the design of a cargo ship of 120 m: CB 0.68, LCB 0.6 m abaft midship.

    Returns
    -------
    Design
    """
    return Design(
        SHIP,
        [_areas(), _waterline(), *_boundary(), *_angles()],
        stations=(
            -0.3, 0.0, 0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0,
            11.0, 12.0, 13.0, 14.0, 15.0, 16.0, 17.0, 18.0, 18.5, 19.0, 19.25, 19.5, 19.75,
        ),
        waterlines=(0.4, 0.9, 1.8, 2.7, 3.6, 4.5, 5.4, 6.3, 7.2, 8.1, 9.0, 9.9),
        buttocks=(1.5, 3.0, 4.5, 6.0, 7.5),
        transom=-4.0,
    )  # fmt: skip


def _areas() -> FormDefinition:
    # The parallel middle body has flats and a bilge of a radius: its area follows.
    midship = 1.0 - (2.0 - 0.5 * math.pi) * BILGE**2 / (SHIP.breadth * SHIP.draught)
    return sectional_area(
        SHIP, cm=midship, cb=0.68, lcb=-0.6,
        run_start_ordinate=0.045, run_start_angle_deg=22.0, run_area=0.598, run_centroid=-0.424,
        run_start_tangent=0.13, run_end_tangent=0.25,
        run_end=-0.1, entrance_start=0.15, entrance_end_angle_deg=-40.0,
        entrance_start_tangent=0.12,
    )  # fmt: skip


def _waterline() -> FormDefinition:
    return design_waterline(
        SHIP, cw=0.82, run_start=-1.0667, run_start_ordinate=0.3, run_start_angle_deg=50.0,
        run_end=-0.35, entrance_start=0.4, entrance_end_angle_deg=-60.0,
    )  # fmt: skip


def _boundary() -> list[FormDefinition]:
    contour = {
        "transom": (-4.0, 6.8, -12.0),
        "counter": (2.0, 5.2, -25.0),
        "heel": (7.0, 0.0, 0.0),
        "forefoot": (113.0, 0.0, 0.0),
        "stem": (120.0, 7.2, 75.0),
        "top": (121.8, 12.0, 68.0),
    }
    side = {
        "transom": (-4.0, 7.0, 6.0),
        "quarter": (30.0, 9.0, 0.0),
        "shoulder": (84.0, 9.0, 0.0),
        "flare": (108.0, 7.8, -6.5),
        "stem": (121.8, 0.0, -60.0),
    }
    sheer = {
        "aft": (-4.0, 11.0), "waist": (35.0, 10.5, 0.0), "fore": (80.0, 10.5, 0.0),
        "stem": (121.8, 12.0),
    }  # fmt: skip
    return [
        course("profile", contour),
        course("deck_side", side),
        course("deck_height", sheer, rule="monotone"),
    ]


def _angles() -> list[FormDefinition]:
    keel = {
        "transom": (-4.0, 80.0), "counter": (0.0, 40.0), "heel": (7.0, 4.0), "run": (25.0, 60.0),
        "aft": (54.0, 90.0, 0.0), "fore": (69.0, 90.0, 0.0), "entrance": (100.0, 65.0),
        "stem": (121.8, 15.0),
    }  # fmt: skip
    flare = {
        "transom": (-4.0, 40.0), "run": (15.0, 25.0), "aft": (45.0, 0.0, 0.0),
        "fore": (80.0, 0.0, 0.0), "stem": (121.8, 22.0),
    }  # fmt: skip
    flat = 0.5 * SHIP.breadth - BILGE
    bottom = {
        "run": (20.0, 0.0), "quarter": (38.0, 6.4), "aft": (54.0, flat, 0.0),
        "fore": (69.0, flat, 0.0), "shoulder": (78.0, 6.2), "entrance": (100.0, 0.0),
    }  # fmt: skip
    side = {
        "run": (35.0, 8.5), "quarter": (42.0, 3.4), "aft": (54.0, BILGE, 0.0),
        "fore": (69.0, BILGE, 0.0), "shoulder": (78.0, 2.8), "entrance": (87.0, 9.0),
    }  # fmt: skip
    return [
        course("keel_angle", keel, rule="monotone"),
        course("waterline_angle", flare, rule="monotone"),
        course("flat_of_bottom", bottom, rule="monotone"),
        course("flat_of_side", side, rule="monotone"),
        course("bilge_radius", {"body": (60.0, BILGE)}),
    ]
