"""The twin-skeg ship: her skegs and stern are measured as they were constructed."""

from __future__ import annotations

import itertools
from collections.abc import Mapping

import numpy as np
import pytest
from scipy.integrate import quad

from assoc_hull.analysis.form.parameter import FormValue
from assoc_hull.analysis.hydrostatics.flotation import flotation
from assoc_hull.analysis.hydrostatics.section_areas import between_stations, section_areas
from assoc_hull.geometry.floating.immersion import FloatingPlanes
from assoc_hull.io.lines.several_hulls import HullChoice, find_hulls, water_levels
from assoc_hull.io.mesh.one_hull import mesh_sections
from tests import twin_skeg as ship

STATION = ship.LENGTH / 20.0
CORNER = (1.0 - np.pi / 4.0) * ship.BILGE**2
"""What a bilge leaves of a corner."""

SLOPE = np.degrees(np.arctan(ship.RISE))


@pytest.fixture(scope="module")
def found() -> Mapping[str, FormValue]:
    """Her form parameters, with her screws."""
    return ship.twin_skeg_ship().form_parameters(screw=ship.SCREW)


def number(found: Mapping[str, FormValue], symbol: str) -> float:
    """The number of an entry, which must be there."""
    value = found[symbol]
    assert value.number is not None, value.reason
    return value.number


def deep(x: float) -> float:
    """How deep the skeg hangs below the roof."""
    return float(ship.roof(x) - ship.edge(x)) if ship.AFT < x < ship.FORE else 0.0


def half_area(x: float, z: float) -> float:
    """Area of half a section of the after body below z, in closed form.

    The skeg's inclination is a shear, which leaves areas as they are.
    """
    top, depth = float(ship.roof(x)), deep(x)
    if z >= top + ship.BILGE:
        skeg = 16.0 / 15.0 * depth * ship.WIDTH
        return float(ship.breadth(x)) * (z - top) - CORNER + skeg
    # Only the skeg is immersed, up to t where the bump is as high as the water.
    assert z <= top
    if depth <= top - z:
        return 0.0
    t = float(np.sqrt(1.0 - np.sqrt((top - z) / depth)))
    return 2.0 * ship.WIDTH * (depth * (t - 2.0 / 3.0 * t**3 + 0.2 * t**5) - (top - z) * t)


def test_she_has_all_parameters(found: Mapping[str, FormValue]) -> None:
    """Every entry has a number, but the one that people choose by eye."""
    assert [symbol for symbol, value in found.items() if value.number is None] == ["C_stern"]


def test_her_profile_is_that_of_the_construction(found: Mapping[str, FormValue]) -> None:
    """TwTTL, TTLS, StemA, Hap, HSKEG, TH, TRZ, SO: the roof is a straight line."""
    assert number(found, "TwTTL") == pytest.approx(ship.FORE / STATION, abs=1e-9)
    assert number(found, "TTLS") == pytest.approx(SLOPE, abs=1e-9)
    assert number(found, "StemA") == pytest.approx(SLOPE, abs=1e-9)
    assert number(found, "Hap") == pytest.approx(ship.RISE * ship.FORE, abs=1e-9)
    assert number(found, "HSKEG") == number(found, "Hap")
    assert number(found, "TH") == pytest.approx(float(ship.roof(ship.TRANSOM)), abs=1e-9)
    assert number(found, "TRZ") == pytest.approx(ship.DRAUGHT - number(found, "TH"), abs=1e-9)
    assert number(found, "SO") == -ship.TRANSOM


def test_her_transom_is_immersed(found: Mapping[str, FormValue]) -> None:
    """ATT, B_tr: a box with bilges."""
    area = 2.0 * half_area(ship.TRANSOM, ship.DRAUGHT)
    assert number(found, "ATT") == pytest.approx(area, abs=1e-4)
    assert number(found, "B_tr") == pytest.approx(40.0, abs=1e-9)


def test_a_skeg_from_the_side_is_an_arc_below_a_line(found: Mapping[str, FormValue]) -> None:
    """LSKEG, ASKEG, XSKEG, RSKEG: chord and arc of a circle in closed form."""
    radius, half = ship.EDGE, np.arctan(ship.RISE)
    segment = radius**2 * (half - np.sin(half) * np.cos(half))
    centre = quad(lambda x: x * deep(x), ship.AFT, ship.FORE)[0] / segment
    assert number(found, "LSKEG") == pytest.approx(ship.FORE - ship.AFT, abs=1e-3)
    assert number(found, "ASKEG") == pytest.approx(segment, rel=3e-5)
    assert number(found, "XSKEG") == pytest.approx(0.5 * ship.LENGTH - centre, abs=1e-3)
    assert number(found, "RSKEG") == pytest.approx(radius, rel=3e-5)


def test_her_skegs_stand_as_inclined_as_they_were_put(found: Mapping[str, FormValue]) -> None:
    """TwVSA, TwLSA: the centre plane is a plane."""
    assert number(found, "TwVSA") == pytest.approx(14.0, abs=1e-3)
    assert number(found, "TwLSA") == pytest.approx(2.5, abs=1e-3)


def test_screw_and_shaft_are_as_given(found: Mapping[str, FormValue]) -> None:
    """TwDS, SCH, PI, SBx, SBD; SA where the arc is as high as the shaft."""
    high = ship.SCREW.height
    reach = np.sqrt(2.0 * ship.EDGE * high - high * high)
    assert number(found, "TwDS") == pytest.approx(34.0, abs=1e-9)
    assert number(found, "SCH") == high
    assert number(found, "PI") == pytest.approx(ship.DRAUGHT - high - 3.0, abs=1e-12)
    assert (number(found, "SBx"), number(found, "SBD")) == (13.0, 1.2)
    assert number(found, "SA") == pytest.approx(ship.FORE - reach, abs=1e-5)


def test_the_tip_is_as_far_from_the_hull_as_constructed(found: Mapping[str, FormValue]) -> None:
    """PTC: the skin of the bump over the shaft, 8.5 m off the centre line, at x = 12."""
    x, y = 12.0, 8.5
    top, depth = float(ship.roof(x)), deep(x)
    t = np.linspace(-0.6, 0.6, 400_001)
    z = top - depth * ship.bump(t)
    skin = float(np.interp(y, ship.middle(x, z) + ship.WIDTH * t, z))
    assert number(found, "PTC") == pytest.approx((skin - 4.25 - 3.0) / 0.06, abs=5e-3)


@pytest.mark.parametrize(("symbol", "station"), [("S3", 1.5), ("S3'", 1.0)])
def test_the_stern_area_ratio_is_that_of_the_construction(
    found: Mapping[str, FormValue], symbol: str, station: float
) -> None:
    """The chord starts at the skeg's lowest place, the outer skin goes up from it.

    The foot of the skeg is so blunt that its lowest place lies within 2e-4 m, across the ship,
    of that of the formula; the area moves by 7 m times that.
    """
    x = station * STATION
    skin, (top, side) = ship.lower_skin(x), (float(ship.roof(x)), float(ship.breadth(x)))
    t = np.linspace(0.0, 1.0, 400_001)
    z = top - deep(x) * ship.bump(t)
    y = ship.middle(x, z) + ship.WIDTH * t
    shaft = max(ship.SCREW.height, float(z[0]))
    kept = z >= shaft
    # From the skeg to the roof, along it, and round the bilge.
    outside = float(np.trapezoid(y[kept], z[kept]))
    outside += side * (ship.DRAUGHT - top) - CORNER
    at = y[0] + (side - y[0]) * (shaft - z[0]) / (ship.DRAUGHT - z[0])
    chord = 0.5 * (at + side) * (ship.DRAUGHT - shaft)
    assert number(found, f"{symbol}.A1") == pytest.approx(outside - chord, abs=2e-3)
    assert number(found, f"{symbol}.A2") == pytest.approx(half_area(x, ship.DRAUGHT), rel=2e-6)
    assert skin[:, 1].min() == pytest.approx(float(z[0]), abs=1e-9)


def test_breadths_are_those_of_the_outer_skin(found: Mapping[str, FormValue]) -> None:
    """BCL, B07, Tau at station 2, not those of the tunnel."""
    x = 2.0 * STATION
    t = np.linspace(0.0, 1.0, 400_001)
    z = float(ship.roof(x)) - deep(x) * ship.bump(t)
    at_shaft = float(np.interp(4.25, z, ship.middle(x, z) + ship.WIDTH * t))
    side = float(ship.breadth(x))
    up = 1.0 - (4.25 + 2.1 - float(ship.roof(x))) / ship.BILGE
    assert number(found, "BCL") == pytest.approx(at_shaft, abs=1e-3)
    bilge = side - ship.BILGE * (1.0 - np.sqrt(1.0 - up * up))
    assert number(found, "B07") == pytest.approx(bilge, abs=1e-4)
    tau = np.degrees(np.arctan2(side - at_shaft, ship.DRAUGHT - 4.25))
    assert number(found, "Tau") == pytest.approx(tau, abs=5e-3)


def test_her_bilge_and_bulb_are_the_carriers(found: Mapping[str, FormValue]) -> None:
    """BR, BL: the radius amidships is 2.4 m, the nose stands 6.4 m before FP."""
    assert number(found, "BR") == pytest.approx(ship.BILGE, abs=1e-5)
    assert number(found, "BL") == pytest.approx(6.4, abs=1e-4)


# Hydrostatics.


@pytest.mark.parametrize("draught", [18.0, 8.0])
def test_sections_have_the_areas_of_the_construction(draught: float) -> None:
    """At 8 m the tunnel's roof is dry abaft x = 20.7 and the skegs are immersed by themselves."""
    body = flotation(ship.twin_skeg_ship().state)
    x = np.array([3.0, 6.0, 7.0, 12.0, 15.0, 19.4, 45.0, 85.0])
    planes = FloatingPlanes(np.array([draught]), np.zeros(1), np.zeros(1))
    exact = [2.0 * half_area(each, draught) for each in x.tolist()]
    assert section_areas(body, x, planes)[0] == pytest.approx(exact, rel=2e-4, abs=2e-3)


def test_the_after_body_has_the_volume_of_the_construction() -> None:
    """From AP to midship at the design draught; stations stand 1.5 m apart at the skegs."""
    body = flotation(ship.twin_skeg_ship().state)
    planes = FloatingPlanes(np.array([ship.DRAUGHT]), np.zeros(1), np.zeros(1))
    volume = float(between_stations(body, 0.0, 150.0, planes).volume[0])
    bounds = [0.0, ship.AFT, ship.FORE, 150.0]
    exact = sum(
        quad(lambda x: 2.0 * half_area(x, ship.DRAUGHT), low, high)[0]
        for low, high in itertools.pairwise(bounds)
    )
    assert volume == pytest.approx(exact, rel=2e-5)


@pytest.mark.parametrize("draughts", [(18.0, 18.0), (8.0, 8.0), (14.0, 9.0)])
def test_hydrostatics_take_her(draughts: tuple[float, float]) -> None:
    """No line is doubtful, and the number is good, where pieces are immersed apart, too."""
    found = ship.twin_skeg_ship().hydrostatics(draughts=draughts)
    # At trim a coefficient may exceed 1, which is told and no doubt of a line.
    assert [note for note in found.notes if "may exceed 1 at trim" not in note] == []


@pytest.mark.parametrize("draught", [None, 18.0, 5.0])
def test_her_mesh_is_that_of_one_hull(draught: float | None) -> None:
    """Contours part abaft x = 54 m of 300, at every draught: she is no catamaran."""
    mesh = ship.twin_skeg_ship().mesh().triangles
    levels = water_levels(0.0, ship.DEPTH, HullChoice(draught=draught))
    assert find_hulls(mesh_sections(mesh), levels, oriented=True).count == 1
