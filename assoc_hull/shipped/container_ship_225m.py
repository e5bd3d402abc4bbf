"""A container ship of 225 m, created from form parameters: bulbous bow, flare, flat transom.

See `assoc_hull.shipped.container_ship_225m_form` for the definitions and where they come from.
"""

from __future__ import annotations

from assoc_hull.creation.design import Design
from assoc_hull.creation.net import build_net
from assoc_hull.edit.adoption.report import AdoptionReport
from assoc_hull.model.state import HullState
from assoc_hull.shipped.container_ship_225m_form import SHIP, definitions

__all__ = ["container_ship_225m", "container_ship_225m_design", "container_ship_225m_net"]

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
    return Design(SHIP, definitions(), _STATIONS, _WATERLINES, _BUTTOCKS, transom=-4.2)


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
