"""A bulk carrier of 180 m, created from form parameters: no line of it is drawn by hand.

See `assoc_hull.shipped.bulk_carrier_180m_form` for the definitions and where they come from.
"""

from __future__ import annotations

from assoc_hull.creation.design import Design
from assoc_hull.creation.net import build_net
from assoc_hull.edit.adoption.report import AdoptionReport
from assoc_hull.model.state import HullState
from assoc_hull.shipped.bulk_carrier_180m_form import SHIP, definitions

__all__ = ["bulk_carrier_180m", "bulk_carrier_180m_design", "bulk_carrier_180m_net"]

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
    return Design(SHIP, definitions(), _STATIONS, _WATERLINES, _BUTTOCKS, transom=-5.0)


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
