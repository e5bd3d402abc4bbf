"""A container ship of 225 m, created from form parameters: bulbous bow, flare, flat transom.

The definitions come first. `container_ship_225m_design` makes the design of them and
`container_ship_225m_net` the net with its stations, waterlines and buttocks.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from assoc_hull.creation.design import Design
from assoc_hull.creation.design_net import build_net
from assoc_hull.creation.form_definitions import course, design_waterline, sectional_area
from assoc_hull.edit.adoption.adopt_lines import AdoptionReport
from assoc_hull.model.form_definition import FormDefinition
from assoc_hull.model.tables import HullState, Particulars

__all__ = [
    "CB",
    "FULL",
    "LCB",
    "SHIP",
    "container_ship_225m",
    "container_ship_225m_definitions",
    "container_ship_225m_design",
    "container_ship_225m_net",
]

# --------------------------------------------------------------------------------------
# The definitions of the 225 m container ship.
#
# Length, breadth, draught and block coefficient are those that S.Y. Kim and S.W. Kang, "Ship Lines
# Creation by B-Spline Form Parameter Method", Trans. SNAK 29(2), 1992, print of their second ship.
# They print no more of it. All else is ours: the curves of areas and of the waterline, the contour
# with its bulb, flats, deck, and what shapes the sections. The entrance of the curve of areas
# closes it to the block coefficient and to a centre of buoyancy 1.25 % of the length abaft midship.
#
# Lengths in metres, x from AP, z from the base line; angles in degrees.

SHIP = Particulars("Container ship 225 m", 225.0, 32.0, 19.6, 10.8, "open")

CB, CM, LCB = 0.65, 0.975, -0.0125 * 225.0
"""Block and midship section coefficients; centre of buoyancy (m) forward of midship."""

FULL = CM * 32.0 * 10.8
"""Area (m2) of the midship section."""

BILGE = 4.486711
"""Radius (m) of the bilge that a midship section of this coefficient has."""

BULB = 0.091
"""Area of the bulb at FP, in parts of the midship section."""

AREAS: Mapping[str, Any] = {
    "run_start_ordinate": 0.0088,
    "run_start_angle_deg": 47.0,
    "run_start_tangent": 0.17,
    "run_end": -0.06,
    "run_end_tangent": 0.34,
    "run_area": 0.637,
    "run_centroid": -0.404,
    "entrance_start": 0.02,
    "entrance_start_tangent": 0.14,
    "entrance_end_ordinate": BULB,
    "entrance_end_angle_deg": -21.0,
    "entrance_end_tangent": 0.213,
}
"""The curve of areas, in the frame of the ship: -1 at AP, 1 at FP, 1 the midship section. It
ends with the area of the bulb at FP."""

WATERLINE: Mapping[str, Any] = {
    "run_start_ordinate": 0.51,
    "run_start_angle_deg": 57.0,
    "run_start_tangent": 0.18,
    "run_end": -0.41,
    "run_end_tangent": 0.18,
    "entrance_start": 0.31,
    "entrance_start_tangent": 0.18,
    "entrance_end_angle_deg": -57.0,
    "entrance_end_tangent": 0.18,
    "entrance_area": 0.426,
}
"""The waterline at the design draught, 1 half the breadth. What is not given comes out fairest."""

_RUN, _ENTRANCE = 105.75, 114.75
"""The parallel middle body lies between these x: where the curve of areas is full."""

_SIDE_AFT, _SIDE_FORE = 66.375, 147.375
"""Between these x the waterline at the design draught is full."""

PROFILE = {
    "transom": {"x": -4.2, "y": 11.1, "angle_deg": -7.0},
    "counter": {"x": 2.0, "y": 9.85, "angle_deg": -20.0},
    "post": {"x": 8.8, "y": 5.0, "angle_deg": -75.0, "tangent": 0.8},
    "heel": {"x": 13.5, "y": 0.0, "angle_deg": 0.0, "tangent": 0.8, "leave_tangent": 1.0},
    "forefoot": {"x": 214.0, "y": 0.0, "angle_deg": 0.0, "leave_tangent": 1.25},
    "tip": {"x": 230.6, "y": 6.4, "angle_deg": 90.0, "curvature": 0.15},
    "top": {"x": 225.8, "y": 8.9, "angle_deg": 175.0, "tangent": 1.2, "leave_tangent": 1.0},
    "neck": {"x": 224.5, "y": 9.7, "angle_deg": 80.0},
    "FP": {"x": 225.0, "y": 10.8, "angle_deg": 62.0},
    "bow": {"x": 233.5, "y": 21.2, "angle_deg": 48.0},
}
"""Transom, counter and skeg, keel, the bulb with its tip 5.6 m ahead of FP, stem."""

Node = tuple[float, ...]


def _at(values: Mapping[float, float]) -> dict[str, Node]:
    """Name nodes by their x."""
    return {f"x {x:g}": (x, y) for x, y in values.items()}


_BODY_LOW = {"body aft": (_RUN, BILGE), "body fore": (_ENTRANCE, BILGE)}
_BODY_WIDE = {"body aft": (_RUN, 16.0 - BILGE), "body fore": (_ENTRANCE, 16.0 - BILGE)}
_BODY_BEND = {"body aft": (_RUN, -1.0 / BILGE), "body fore": (_ENTRANCE, -1.0 / BILGE)}

FLAT_OF_SIDE = {
    **_at({36.0: 19.6, 50.0: 15.2}), "draught aft": (_SIDE_AFT, 10.8),
    **_at({75.0: 7.7, 85.0: 5.6, 95.0: 4.68}), **_BODY_LOW,
    **_at({125.0: 4.77, 135.0: 6.5, 141.0: 8.4}), "draught fore": (_SIDE_FORE, 10.8),
    **_at({158.0: 14.8, 172.0: 19.6}),
}  # fmt: skip
"""z of its lower border."""

FLAT_OF_BOTTOM = {
    **_at({42.0: 0.0, 48.0: 1.0, 56.0: 3.2, 65.25: 6.2, 75.0: 8.3, 85.0: 9.95, 95.0: 11.35}),
    **_BODY_WIDE,
    **_at({125.0: 11.0, 137.0: 9.2, 149.625: 6.2, 160.0: 3.6, 170.0: 1.7, 180.0: 0.6, 190.0: 0.0}),
}
"""Its half-breadth."""

KEEL_ANGLE = _at({
    -4.2: 89.5, -0.3: 89.0, 0.0: 88.0, 5.0: 86.0, 9.0: 12.0, 12.0: 4.0, 20.0: 12.0, 26.0: 28.0,
    32.0: 48.0, 38.0: 80.0, 42.0: 90.0, 198.0: 90.0, 225.0: 22.0, 228.0: 38.0, 231.0: 55.0,
    233.5: 75.0,
})  # fmt: skip
"""0 where the section leaves the contour upright, 90 level; ahead of FP it is the stem's."""

KEEL_CURVATURE = {"x 80": (80.0, 0.0), **_BODY_BEND, "x 140": (140.0, 0.0)}
"""At the parallel middle body the curves are to leave the flats as its bilge does."""

KEEL_TANGENT = _at({
    -4.2: 1.7, -0.3: 1.7, 0.0: 0.6, 12.0: 0.25, 20.0: 0.4, 30.0: 0.35, 40.0: 0.4, 50.0: 0.55,
    60.0: 0.6, _SIDE_AFT: 1.11, _SIDE_FORE: 1.11, 152.0: 0.6, 180.0: 0.6, 195.0: 0.72,
})  # fmt: skip

WATERLINE_ANGLE = _at({
    -4.2: 85.0, 0.0: 80.0, 10.0: 66.0, 25.0: 38.0, 40.0: 12.5, 45.0: 7.0, 50.0: 5.0, 56.25: 2.4,
    62.0: 0.4, 64.6: 0.05, _SIDE_AFT: 0.0, _SIDE_FORE: 0.0, 158.0: 3.1, 163.0: 8.0, 168.75: 13.4,
    180.0: 20.0, 190.0: 26.5, 200.0: 30.5, 208.0: 27.7, 215.0: 23.0, 220.0: 21.0, 225.0: 22.0,
})  # fmt: skip
"""Flare at the design draught."""

WATERLINE_CURVATURE = {
    "draught aft": (_SIDE_AFT, 0.0), "x 85": (85.0, -0.08), **_BODY_BEND,
    "x 132": (132.0, -0.08), "draught fore": (_SIDE_FORE, 0.0),
}  # fmt: skip

WATERLINE_TANGENT = _at({60.0: 0.6, _SIDE_AFT: 1.11, _SIDE_FORE: 1.11, 152.0: 0.6})

DECK_SIDE: dict[str, Node] = {
    **_at({-4.2: 14.3, 5.0: 15.3}), "full aft": (30.0, 16.0, 0.0), "full fore": (172.0, 16.0, 0.0),
    **_at({
        182.0: 15.9, 192.0: 15.4, 203.0: 14.2, 212.0: 12.4, 220.0: 9.8, 227.0: 6.5, 231.0: 3.4,
        233.5: 0.0,
    }),
}  # fmt: skip

DECK_HEIGHT = {
    "transom": (-4.2, 19.6, 0.0), "sheer": (175.0, 19.6, 0.0), "bow": (233.5, 21.2),
}  # fmt: skip

DECK_ANGLE = _at({
    -4.2: 8.0, 30.0: 2.5, 36.0: 0.0, 172.0: 0.0, 175.0: 12.0, 180.0: 23.0, 190.0: 41.0, 203.0: 54.0,
    215.0: 62.0, 233.0: 68.0,
})  # fmt: skip
"""Flare at the deck edge."""

BULB_AREA = {
    **_at({
        197.9: 13.6, 201.0: 16.7, 204.0: 18.75, 206.5: 21.7, 209.0: 24.3, 211.4: 26.55,
        213.75: 28.95, 216.0: 31.85, 218.0: 33.25, 220.0: 33.38, 221.5: 32.8, 223.3: 31.82,
    }),
    "FP": (225.0, BULB * FULL),
    **_at({228.0: 21.7, 229.5: 11.0}), "tip": (230.6, 0.0),
}  # fmt: skip
"""Of both sides: up to the neck abaft the stem, where the upper curve is then nearly its fairest;
of the whole bulb ahead of it."""

BULB_HEIGHT = _at({
    197.9: 2.5, 202.5: 3.45, 208.0: 4.85, 213.75: 6.7, 217.0: 8.0, 219.5: 8.8, 221.5: 9.12,
    223.5: 9.35, 225.0: 9.5,
})  # fmt: skip
"""z of the neck."""

BULB_NECK = _at({
    197.9: 3.1, 202.5: 3.07, 208.0: 2.67, 213.75: 2.17, 217.0: 1.56, 219.5: 1.07, 221.5: 0.7,
    223.5: 0.36, 225.0: 0.15,
})  # fmt: skip
"""Half-breadth there."""

BULB_NECK_ANGLE = _at({
    197.9: 25.0, 202.5: 2.0, 208.0: -7.0, 213.75: -14.0, 217.0: -24.0, 219.5: -33.0,
    221.5: -41.0, 223.5: -50.0, 224.5: -60.0,
})  # fmt: skip
"""Of the section there."""


def container_ship_225m_definitions() -> list[FormDefinition]:
    """Give the definitions, the curve of areas first.

    Returns
    -------
    list of FormDefinition
    """
    smooth: dict[str, Mapping[str, Node]] = {
        "flat_of_side": FLAT_OF_SIDE, "flat_of_bottom": FLAT_OF_BOTTOM, "keel_angle": KEEL_ANGLE,
        "keel_curvature": KEEL_CURVATURE, "keel_tangent": KEEL_TANGENT,
        "waterline_angle": WATERLINE_ANGLE, "waterline_curvature": WATERLINE_CURVATURE,
        "waterline_tangent": WATERLINE_TANGENT, "deck_side": DECK_SIDE,
        "deck_height": DECK_HEIGHT, "deck_angle": DECK_ANGLE, "bulb_area": BULB_AREA,
        "bulb_height": BULB_HEIGHT, "bulb_neck": BULB_NECK, "bulb_neck_angle": BULB_NECK_ANGLE,
    }  # fmt: skip
    return [
        sectional_area(SHIP, cm=CM, cb=CB, lcb=LCB, **AREAS),
        design_waterline(SHIP, **WATERLINE),
        course("profile", PROFILE),
        course("bilge_radius", {"body": (112.5, BILGE)}),
        *(course(use, nodes, rule="monotone") for use, nodes in smooth.items()),
    ]


# --------------------------------------------------------------------------------------
# A container ship of 225 m, created from form parameters: bulbous bow, flare, flat transom.
#
# See `assoc_hull.shipped.container_ship_225m` for the definitions and where they come from.

_STATIONS = (
    -0.2, 0.0, 0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 4.5, 5.0, 5.5, 5.75, 6.0,
    6.5, 7.0, 7.5, 8.0, 9.0, 10.0, 11.0, 12.0, 12.5, 12.75, 13.0, 13.5, 14.0, 14.5, 14.75, 15.0,
    16.0, 17.0, 17.5, 18.0, 18.5, 19.0, 19.25, 19.5, 19.75, 20.0, 20.2, 20.35, 20.45,
)  # fmt: skip
"""Closer together where lines leave the flats: between stations they are splines."""

_WATERLINES = (0.6, 1.5, 3.0, 4.5, 6.0, 7.5, 9.0, 10.8, 12.5, 14.5, 16.5, 18.5)
_BUTTOCKS = (2.0, 4.0, 6.0, 8.0, 10.0, 12.0, 14.0)


def container_ship_225m_design() -> Design:
    """Give the design: main dimensions, definitions, and where the lines stand.

    Returns
    -------
    Design

    Examples
    --------
    >>> from assoc_hull.shipped.container_ship_225m import container_ship_225m_design
    >>> areas = container_ship_225m_design().definition("sectional_area")
    >>> round(areas.value("entrance_area"), 9), round(areas.value("entrance_centroid"), 9)
    (0.616333333, 0.366059492)
    """
    return Design(
        SHIP, container_ship_225m_definitions(), _STATIONS, _WATERLINES, _BUTTOCKS, transom=-4.2
    )


def container_ship_225m() -> HullState:
    """Make the net of 47 stations, 12 waterlines and 7 buttocks.

    Lpp 225 m, B 32 m, T 10.8 m, depth 19.6 m, block coefficient 0.65, centre of buoyancy
    2.8125 m abaft midship. The bulb has 9.1 % of the area of the midship section at FP; its tip
    lies 5.6 m ahead of it. Sections are named by station (AP = 0, FP = 20).

    Returns
    -------
    HullState
    """
    return container_ship_225m_net()[0]


def container_ship_225m_net() -> tuple[HullState, AdoptionReport]:
    """Make the net of `container_ship_225m`, with the report of how its lines were adopted.

    Returns
    -------
    HullState, AdoptionReport
    """
    return build_net(container_ship_225m_design())
