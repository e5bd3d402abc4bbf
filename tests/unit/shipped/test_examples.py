"""What the parts of `shipped` give, one small example of each."""

from __future__ import annotations

from assoc_hull.shipped.bulk_carrier_180m import SHIP as CARRIER
from assoc_hull.shipped.bulk_carrier_180m import (
    VERSLUIS_AREAS,
    VERSLUIS_MOMENTS,
    VERSLUIS_X,
    bulk_carrier_180m_definitions,
)
from assoc_hull.shipped.container_ship_225m import FULL, SHIP, container_ship_225m_definitions
from assoc_hull.shipped.series60 import todd_table


def test_the_definitions_of_the_180_m_bulk_carrier_one() -> None:
    """The definitions of the 180 m bulk carrier: one parent's areas, all else chosen."""
    assert (
        CARRIER.length,
        CARRIER.breadth,
        CARRIER.draught,
        len(bulk_carrier_180m_definitions()),
    ) == (
        180.0,
        28.0,
        10.5,
        15,
    )


def test_the_definitions_of_the_225_m_container_ship() -> None:
    """The definitions of the 225 m container ship."""
    assert (SHIP.length, SHIP.breadth, SHIP.draught, len(container_ship_225m_definitions())) == (
        225.0,
        32.0,
        10.8,
        19,
    )
    bulb = next(each for each in container_ship_225m_definitions() if each.use == "bulb_area")
    area = bulb.value("FP_y")
    assert area is not None
    # of the midship section
    assert round(area / FULL, 6) == 0.091


def test_the_offsets_of_two_series_60_parents_as_their() -> None:
    """The offsets of two Series 60 parents, as their author published them."""
    table, _report = todd_table(0.70)
    assert (table.name, table.half_breadth.shape, round(table.breadth, 3)) == (
        "Series 60 CB 0.70",
        (25, 8),
        17.417,
    )


def test_section_areas_and_moments_of_a_bulk_carrier_as_printed() -> None:
    """Section areas and moments of a bulk carrier, as printed."""
    assert (VERSLUIS_X[1], VERSLUIS_AREAS[1]) == (4.5, 16.25)
    assert round(float(VERSLUIS_MOMENTS[1] / VERSLUIS_AREAS[1]), 3) == 9.157
