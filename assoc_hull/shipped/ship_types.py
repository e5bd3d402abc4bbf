"""Types of ships that can be made from six numbers: the design of each, and its ranges of use.

Ranges are those over which ships were drawn and made (`python -m benchmarks six_numbers`).
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from assoc_hull.creation.six_numbers import ShipType
from assoc_hull.errors import UnknownNameError
from assoc_hull.shipped.fair_designs import (
    fair_bulk_carrier_design,
    fair_container_ship_design,
    fair_plain_ship_design,
)
from assoc_hull.shipped.trawler_design import draw_trawler, trawler_design
from assoc_hull.shipped.yacht_design import draw_yacht, yacht_design

__all__ = ["SHIP_TYPES", "ship_type"]


def _ratios(
    slender: tuple[float, float], beam: tuple[float, float], depth: tuple[float, float],
    cb: tuple[float, float], lcb: tuple[float, float],
) -> Mapping[str, tuple[float, float]]:  # fmt: skip
    found = {"L/B": slender, "B/T": beam, "D/T": depth, "cb": cb, "lcb": lcb}
    return MappingProxyType(found)


_FULL = _ratios((5.5, 7.0), (2.2, 3.2), (1.3, 1.65), (0.72, 0.85), (0.0, 3.5))
_STERN = -0.9

SHIP_TYPES: Mapping[str, ShipType] = MappingProxyType({
    each.name: each for each in (
        ShipType("bulk carrier", fair_bulk_carrier_design, (100.0, 320.0), _FULL, _STERN),
        ShipType("tanker", fair_bulk_carrier_design, (100.0, 320.0), _FULL, _STERN),
        ShipType(
            "container ship", fair_container_ship_design, (120.0, 360.0),
            _ratios((6.0, 8.2), (2.4, 3.6), (1.5, 2.1), (0.58, 0.72), (-3.0, 0.0)), -0.88,
        ),
        ShipType(
            "general cargo", fair_plain_ship_design, (70.0, 160.0),
            _ratios((5.5, 7.2), (2.2, 2.9), (1.3, 1.7), (0.62, 0.80), (-1.5, 2.0)), _STERN,
        ),
        ShipType(
            "ro-ro", fair_container_ship_design, (100.0, 220.0),
            _ratios((5.5, 7.5), (3.0, 4.5), (1.8, 2.6), (0.52, 0.68), (-4.0, -1.0)), -0.88,
            remark="a single skeg; no twin skeg is drawn",
        ),
        ShipType(
            "trawler", trawler_design, (20.0, 70.0),
            _ratios((3.2, 5.0), (2.0, 2.8), (1.25, 2.0), (0.50, 0.62), (-4.0, -0.5)), -1.0,
            draw=draw_trawler,
        ),
        ShipType(
            "yacht canoe body", yacht_design, (8.0, 30.0),
            _ratios((2.9, 4.2), (4.0, 8.0), (2.2, 5.0), (0.36, 0.43), (-6.0, -2.0)), -1.0,
            draw=draw_yacht,
        ),
    )
})  # fmt: skip
"""By name."""


def ship_type(name: str) -> ShipType:
    """Give a type by its name, in any case.

    Raises UnknownNameError.
    """
    name = " ".join(name.lower().split())
    name = "yacht canoe body" if name in ("yacht", "canoe body") else name
    if name not in SHIP_TYPES:
        raise UnknownNameError("type of ship", name, tuple(SHIP_TYPES))
    return SHIP_TYPES[name]
