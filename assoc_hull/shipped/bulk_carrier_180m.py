"""The bulk carrier of 180 m by form parameters, and the published parent it is held against.

The parent is that of A. Versluis 1977, as Table 3 of S.Y. Kim, S.W. Kang, "Ship Lines Creation by
B-Spline Form Parameter Method", Trans. SNAK 29(2), 1992, has it; areas in m2, moments in m3.
Lines of the created ship are chosen by us.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from assoc_hull.creation.design import Design
from assoc_hull.creation.design_net import build_net
from assoc_hull.creation.form_definitions import course, design_waterline, sectional_area
from assoc_hull.edit.adoption.adopt_lines import AdoptionReport
from assoc_hull.model.form_definition import FormDefinition
from assoc_hull.model.tables import HullState, Particulars

__all__ = [
    "CB",
    "LCB",
    "SHIP",
    "VERSLUIS_AREAS",
    "VERSLUIS_BREADTH",
    "VERSLUIS_DRAUGHT",
    "VERSLUIS_LENGTH",
    "VERSLUIS_MOMENTS",
    "VERSLUIS_X",
    "bulk_carrier_180m",
    "bulk_carrier_180m_definitions",
    "bulk_carrier_180m_design",
    "bulk_carrier_180m_net",
]

# --------------------------------------------------------------------------------------
# Section areas and moments of a bulk carrier, as printed: what the created one is held against.
#
# The parent is that of A. Versluis 1977, as Table 3 of S.Y. Kim, S.W. Kang, "Ship Lines Creation by
# B-Spline Form Parameter Method", Trans. SNAK 29(2), 1992, has it. Where the stations are is not
# printed there: half ones at the ends give the block coefficient 0.75 and the centre of buoyancy
# 2.90 m forward of midship that are.

VERSLUIS_LENGTH, VERSLUIS_BREADTH, VERSLUIS_DRAUGHT = 180.0, 28.0, 10.5
"""Main dimensions, m."""

# station (0 = AP), area below the draught in m2, its moment about the base line in m3
_TABLE = np.array([
    ( 0.0,   6.08,   59.0),
    ( 0.5,  16.25,  148.8),
    ( 1.0,  41.96,  313.1),
    ( 1.5,  69.92,  484.6),
    ( 2.0, 100.96,  665.3),
    ( 3.0, 164.84, 1013.1),
    ( 4.0, 221.68, 1289.3),
    ( 5.0, 262.87, 1460.1),
    ( 6.0, 284.36, 1528.1),
    ( 7.0, 291.30, 1541.6),
    ( 8.0, 292.59, 1543.0),
    ( 9.0, 292.58, 1542.9),
    (10.0, 292.59, 1542.9),
    (11.0, 292.59, 1543.0),
    (12.0, 292.58, 1542.9),
    (13.0, 292.63, 1543.0),
    (14.0, 291.95, 1542.3),
    (15.0, 285.60, 1528.7),
    (16.0, 261.94, 1433.4),
    (17.0, 215.92, 1215.1),
    (18.0, 150.47,  873.3),
    (18.5, 112.40,  663.9),
    (19.0,  72.24,  438.5),
    (19.5,  31.69,  205.9),
    (20.0,   0.00,    0.0),
])  # fmt: skip

VERSLUIS_X = _TABLE[:, 0] * VERSLUIS_LENGTH / 20.0
"""Places of the stations from AP, m; half stations at the ends."""

VERSLUIS_AREAS, VERSLUIS_MOMENTS = _TABLE[:, 1], _TABLE[:, 2]
"""Areas, m2, and their moments about the base line, m3, of both sides below the draught."""

VERSLUIS_X.flags.writeable = VERSLUIS_AREAS.flags.writeable = VERSLUIS_MOMENTS.flags.writeable = (
    False
)


# --------------------------------------------------------------------------------------
# A bulk carrier of 180 m, created from form parameters: no line of it is drawn by hand.
#
# The definitions come first: sectional areas and waterline of one parent as printed, all else
# chosen. `bulk_carrier_180m_design` makes the design of them and `bulk_carrier_180m_net` the net
# with its stations, waterlines and buttocks.

# --------------------------------------------------------------------------------------
# The definitions: one parent's areas, all else chosen.
#
# The curve of sectional areas is given: rounded numbers fitted to the areas above. Its entrance
# closes it to CB 0.75 and a centre of buoyancy 2.90 m forward of midship. The midship section, with
# a bilge radius of 1.8125 m, has their area, 292.59 m2.
#
# Waterline, contour, flats, angles, curvatures, tangents and deck are ours. The centroids of the
# sections come out of them; none is given.
#
# Lengths in metres, x from AP, z from the base line; angles in degrees.

SHIP = Particulars("Bulk carrier 180 m", 180.0, 28.0, 15.8, 10.5)

CB, LCB = 0.75, 2.9
"""Block coefficient, and centre of buoyancy (m) forward of midship."""

FULL = 292.59
"""Area (m2) of the midship section."""

BILGE = 1.8125
"""Radius (m) of the bilge amidships."""

AREAS: dict[str, Any] = {
    "run_start_ordinate": 6.08 / FULL,
    "run_start_angle_deg": 25.0,
    "run_start_curvature": 0.0,
    "run_start_tangent": 0.067,
    "run_end": -0.208,
    "run_end_tangent": 0.298,
    "run_area": 0.511,
    "run_centroid": -0.488,
    "entrance_start": 0.34,
    "entrance_start_tangent": 0.222,
    "entrance_end_angle_deg": -54.0,
    "entrance_end_curvature": 0.0,
    "entrance_end_tangent": 0.053,
}
"""The curve of areas, in the frame of the ship: -1 at AP, 1 at FP, 1 the midship section."""

WATERLINE: dict[str, Any] = {
    "run_start": -1.05,
    "run_start_angle_deg": 83.0,
    "run_start_tangent": 0.17,
    "run_end": -0.44,
    "run_end_tangent": 0.156,
    "run_area": 0.3863,
    "run_centroid": -0.664,
    "entrance_start": 0.52,
    "entrance_start_tangent": 0.076,
    "entrance_end_angle_deg": -80.0,
    "entrance_end_tangent": 0.064,
    "entrance_area": 0.3065,
    "entrance_centroid": 0.6946,
}
"""The waterline at the design draught, 1 half the breadth. It begins abaft AP."""

_RUN, _ENTRANCE = 71.28, 120.6
"""The parallel middle body lies between these x: where the curve of areas is full."""

_SIDE_AFT, _SIDE_FORE = 50.4, 136.8
"""Between these x the waterline at the design draught is full."""

_DECK_AFT, _DECK_FORE = 42.0, 142.0
"""Between these x the deck edge is."""

_POST = -77.28
"""Angle of the stern post, from the arch of the aperture down to the heel."""

PROFILE = {
    "transom": {"x": -5.0, "y": 10.85, "angle_deg": -40.0},
    "overhang": {"x": -4.5, "y": 10.5, "angle_deg": -31.0},
    "arch": {"x": 5.2, "y": 5.76, "angle_deg": -30.0, "leave_angle_deg": _POST},
    "heel": {"x": 6.5, "y": 0.0, "angle_deg": _POST, "leave_angle_deg": 0.0},
    "forefoot": {"x": 175.5, "y": 0.0, "angle_deg": 0.0, "tangent": 0.9},
    "FP": {"x": 180.0, "y": 10.5, "angle_deg": 82.0, "tangent": 0.6},
    "head": {"x": 184.5, "y": 18.2, "angle_deg": 57.0},
}

FLAT_OF_SIDE = {
    "deck aft": {"x": _DECK_AFT, "y": 15.8, "angle_deg": -40.0},
    "draught aft": {"x": _SIDE_AFT, "y": 10.5, "angle_deg": -20.6, "tangent": 0.675},
    "bilge aft": {"x": _RUN, "y": BILGE, "angle_deg": 0.0, "tangent": 0.93},
    "bilge fore": {"x": _ENTRANCE, "y": BILGE, "angle_deg": 0.0, "tangent": 1.23},
    "draught fore": {"x": _SIDE_FORE, "y": 10.5, "angle_deg": 21.2, "tangent": 0.51},
    "deck fore": {"x": _DECK_FORE, "y": 15.85, "angle_deg": 50.0},
}
"""z of its lower border."""

_FLAT = 0.5 * 28.0 - BILGE

FLAT_OF_BOTTOM = {
    "aft": {"x": 26.0, "y": 0.0, "angle_deg": 5.6, "tangent": 0.605},
    "bilge aft": {"x": _RUN, "y": _FLAT, "angle_deg": 0.0, "tangent": 1.0},
    "bilge fore": {"x": _ENTRANCE, "y": _FLAT, "angle_deg": 0.0, "tangent": 0.91},
    "fore": {"x": 167.5, "y": 0.0, "angle_deg": -6.2, "tangent": 0.58},
}
"""Its half-breadth."""

KEEL_ANGLE = {
    "transom": (-5.0, 56.0), "AP": (0.0, 43.5), "ST 0.5": (5.0, 47.0), "post": (7.0, 1.5),
    "ST 1": (9.0, 12.0), "ST 1.25": (11.25, 22.0), "ST 1.5": (13.5, 33.0), "ST 2": (18.0, 68.0),
    "bottom aft": (26.0, 90.0), "bottom fore": (167.5, 90.0), "ST 19": (172.0, 72.0),
    "ST 19.5": (176.0, 36.0), "FP": (180.0, 0.0), "head": (184.5, 18.0),
}  # fmt: skip
"""0 where the section leaves the contour upright, 90 level."""

WATERLINE_ANGLE = {
    "overhang": (-4.0, 51.0), "AP": (0.0, 39.5), "ST 0.5": (4.5, 35.5), "ST 1": (9.0, 33.5),
    "ST 2": (18.0, 26.0), "ST 3": (27.0, 16.2), "ST 4": (36.0, 9.0), "ST 4.75": (42.75, 5.8),
    "ST 5": (45.0, 3.6), "side aft": (_SIDE_AFT, 0.0), "side fore": (_SIDE_FORE, 0.0),
    "ST 15.5": (139.5, 1.2), "ST 16": (144.0, 3.7), "ST 17": (153.0, 6.0), "ST 18": (162.0, 7.7),
    "ST 19": (171.0, 12.0), "FP": (180.0, 16.0),
}  # fmt: skip
"""Flare at the design draught."""

_BEND = -1.0 / BILGE

KEEL_CURVATURE = {
    "ST 4": (36.0, 0.0), "ST 7": (63.0, -0.3), "bilge aft": (_RUN, _BEND),
    "bilge fore": (_ENTRANCE, _BEND), "ST 14": (128.6, -0.5), "ST 17": (150.0, 0.0),
}  # fmt: skip
"""At the parallel middle body the curves are to leave the flats as its bilge does."""

WATERLINE_CURVATURE = {
    "side aft": (_SIDE_AFT, 0.0), "ST 7": (63.0, 0.0), "bilge aft": (_RUN, _BEND),
    "bilge fore": (_ENTRANCE, _BEND), "ST 14": (128.6, 0.0), "side fore": (_SIDE_FORE, 0.0),
}  # fmt: skip

KEEL_TANGENT = {
    "transom": (-5.0, 0.35), "AP": (0.0, 0.37), "ST 0.5": (5.0, 0.66), "ST 1": (9.0, 0.36),
    "ST 3": (30.0, 0.35), "bilge aft": (_RUN, 1.11), "bilge fore": (_ENTRANCE, 1.11),
    "ST 17": (150.0, 0.46), "FP": (180.0, 0.3),
}  # fmt: skip

WATERLINE_TANGENT = {
    "transom": (-5.0, 0.53), "AP": (0.0, 0.4), "ST 0.5": (5.0, 0.6), "ST 1": (9.0, 0.71),
    "ST 3": (30.0, 0.935), "bilge aft": (_RUN, 1.11), "bilge fore": (_ENTRANCE, 1.11),
    "ST 17": (150.0, 0.58), "FP": (180.0, 0.3),
}  # fmt: skip

DECK_SIDE = {
    "transom": {"x": -5.0, "y": 6.0, "angle_deg": 21.5, "tangent": 0.74},
    "full aft": {"x": _DECK_AFT, "y": 14.0, "angle_deg": 0.0, "tangent": 0.86},
    "full fore": {"x": _DECK_FORE, "y": 14.0, "angle_deg": 0.0, "tangent": 0.63},
    "head": {"x": 184.5, "y": 0.0, "angle_deg": -39.5},
}

DECK_HEIGHT = {
    "transom": (-5.0, 16.4, -0.8),
    "sheer aft": (40.0, 15.8, 0.0),
    "sheer fore": (130.0, 15.8, 0.0),
    "head": (184.5, 18.2, 5.0),
}

DECK_ANGLE = {
    "transom": (-5.0, 36.5), "AP": (0.0, 44.0), "ST 0.25": (2.25, 47.0), "ST 0.5": (4.5, 49.5),
    "ST 1.5": (13.5, 52.0), "ST 2.5": (22.5, 45.0), "ST 3.5": (31.5, 28.0), "ST 4": (36.0, 16.0),
    "ST 4.5": (40.5, 5.0), "full aft": (_DECK_AFT, 0.0), "full fore": (_DECK_FORE, 0.0),
    "ST 16": (144.0, 4.5), "ST 16.5": (148.5, 15.5), "ST 17.5": (157.5, 38.0),
    "ST 18.5": (166.5, 51.0), "ST 19": (171.0, 51.0), "ST 19.5": (175.5, 46.0),
    "FP": (180.0, 35.0), "head": (184.5, 45.0),
}  # fmt: skip
"""Flare at the deck edge."""


def bulk_carrier_180m_definitions() -> list[FormDefinition]:
    """Give the definitions, the curve of areas first.

    Returns
    -------
    list of FormDefinition
    """
    cm = FULL / (SHIP.breadth * SHIP.draught)
    smooth = {
        "keel_angle": KEEL_ANGLE, "keel_curvature": KEEL_CURVATURE, "keel_tangent": KEEL_TANGENT,
        "waterline_angle": WATERLINE_ANGLE, "waterline_curvature": WATERLINE_CURVATURE,
        "waterline_tangent": WATERLINE_TANGENT, "deck_angle": DECK_ANGLE,
    }  # fmt: skip
    return [
        sectional_area(SHIP, cm=cm, cb=CB, lcb=LCB, **AREAS),
        design_waterline(SHIP, **WATERLINE),
        course("profile", PROFILE),
        course("flat_of_side", FLAT_OF_SIDE),
        course("flat_of_bottom", FLAT_OF_BOTTOM),
        course("bilge_radius", {"body": (90.0, BILGE)}),
        *(course(use, nodes, rule="monotone") for use, nodes in smooth.items()),
        course("deck_side", DECK_SIDE),
        course("deck_height", DECK_HEIGHT),
    ]


# --------------------------------------------------------------------------------------
# The ship of these definitions: no line of it is drawn by hand.

_STATIONS = (
    -0.4, -0.3, -0.2, -0.1, 0.0, 0.25, 0.5, 0.8, 1.0, 1.25, 1.5, 1.75, 2.0, 2.5, 3.0, 3.5, 4.0,
    4.25, 4.5, 4.75, 5.0, 5.25, 5.5, 5.75, 6.0, 6.25, 6.5, 7.0, 7.5, 8.0, 9.0, 10.0, 11.0, 12.0,
    13.0, 14.0, 14.5, 14.75, 15.0, 15.25, 15.5, 15.8, 16.0, 16.25, 16.5, 16.75, 17.0, 17.25, 17.5,
    18.0, 18.25, 18.5, 18.75, 19.0, 19.25, 19.5, 19.65, 19.8, 19.9, 20.1, 20.25,
)  # fmt: skip
"""Closer together where buttocks leave the flat of bottom: between stations they are splines."""

_WATERLINES = (
    0.5, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 10.5, 11.5, 12.5, 13.5, 14.5, 15.5,
)  # fmt: skip
_BUTTOCKS = (2.0, 4.0, 6.0, 8.0, 10.0, 12.0)


def bulk_carrier_180m_design() -> Design:
    """Give the design: main dimensions, definitions, and where the lines stand.

    Returns
    -------
    Design

    Examples
    --------
    >>> from assoc_hull.shipped.bulk_carrier_180m import bulk_carrier_180m_design
    >>> areas = bulk_carrier_180m_design().definition("sectional_area")
    >>> [round(areas.value(f"entrance_{name}"), 12) for name in ("area", "centroid")]
    [0.448228545063, 0.584001746435]
    """
    return Design(
        SHIP, bulk_carrier_180m_definitions(), _STATIONS, _WATERLINES, _BUTTOCKS, transom=-5.0
    )


def bulk_carrier_180m() -> HullState:
    """Make the net of 61 stations, 17 waterlines and 6 buttocks.

    Lpp 180 m, B 28 m, T 10.5 m, depth 15.8 m, block coefficient 0.75, centre of buoyancy
    2.90 m forward of midship. Sections are named by station (AP = 0, FP = 20).

    Returns
    -------
    HullState
    """
    return bulk_carrier_180m_net()[0]


def bulk_carrier_180m_net() -> tuple[HullState, AdoptionReport]:
    """Make the net of `bulk_carrier_180m`, with the report of how its lines were adopted.

    Returns
    -------
    HullState, AdoptionReport
    """
    return build_net(bulk_carrier_180m_design())
