"""Hydrostatics of published ships, from their nets, against what is published of them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.analysis.hydrostatics.flotation import Flotation, flotation
from assoc_hull.analysis.hydrostatics.section_areas import between_stations, section_areas
from assoc_hull.geometry.floating.immersion import FloatingPlanes
from assoc_hull.shipped.series60 import series60_adopted

TODD = {0.60: (0.614, -1.5), 0.70: (0.710, 0.5)}
"""CP, and LCB in per cent of Lpp from midship, + forward, as published."""

CASES = pytest.mark.parametrize("cb", [0.60, 0.70], ids=["CB .60", "CB .70"])


def level(*heights: float) -> FloatingPlanes:
    """Planes at even keel."""
    return FloatingPlanes(np.array(heights), np.zeros(len(heights)), np.zeros(len(heights)))


@pytest.fixture(scope="module")
def todd() -> dict[float, Flotation]:
    """The published table as nets of 25 stations."""
    return {cb: flotation(series60_adopted(cb)[0]) for cb in TODD}


@CASES
def test_series_60_has_its_prismatic_coefficient_and_centre(
    todd: dict[float, Flotation], cb: float
) -> None:
    """From AP to FP, over the largest station: CP within .0007, LCB within .06 % Lpp."""
    body = todd[cb]
    ship = body.state.particulars
    plane = level(ship.draught)
    assert len(body.sections.x) == 25
    below = between_stations(body, 0.0, ship.length, plane)
    volume, most = float(below.volume[0]), float(body.stations(plane).area.max())
    cp = volume / (most * ship.length)
    lcb = 100.0 * (float(below.moment_x[0]) / volume / ship.length - 0.5)
    print(f"\nSeries 60 CB {cb:.2f}: CP {cp:.5f}, LCB {lcb:+.4f} % Lpp")
    wanted, centre = TODD[cb]
    assert cp == pytest.approx(wanted, abs=7e-4)
    assert lcb == pytest.approx(centre, abs=0.06)


@CASES
def test_series_60_has_its_sectional_areas(
    todd: dict[float, Flotation], cb: float, data_folder: Path
) -> None:
    """Areas of the 25 stations over the largest, within .0015 rms of the published column."""
    body = todd[cb]
    path = data_folder / "series60" / f"s60_cb0{100 * cb:.0f}_offsets.csv"
    rows = [line.split(",") for line in path.read_text("utf-8").splitlines() if line[0].isdigit()]
    table = np.array([(float(row[0]), float(row[-1])) for row in rows])
    table = table[np.argsort(-table[:, 0])]
    found = body.stations(level(body.state.particulars.draught))
    spacing = body.state.particulars.length / 20.0
    np.testing.assert_allclose(found.x, (20.0 - table[:, 0]) * spacing, atol=1e-6)
    off = found.area[0] / found.area.max() - table[:, 1]
    print(f"\nSeries 60 CB {cb:.2f}: rms {np.sqrt((off**2).mean()):.5f}")
    assert np.sqrt((off**2).mean()) <= 1.5e-3


@pytest.mark.parametrize("part", [0.5, 1.0])
def test_areas_do_not_overshoot_in_the_parallel_body(
    todd: dict[float, Flotation], series60_70: ah.Hull, part: float
) -> None:
    """Of CB .70, from ST 10 to ST 12: what is flat stays flat.

    A cubic through the areas of the stations overshoots by .05 %, and so do the waterlines.
    """
    for body in (todd[0.70], flotation(series60_70.state)):
        plane = level(part * body.state.particulars.draught)
        x = np.linspace(10.0, 12.0, 401) * 0.05 * body.state.particulars.length
        area, own = section_areas(body, x, plane)[0], body.stations(plane).area[0]
        over = area.max() / own.max() - 1.0
        print(f"\nSeries 60 CB .70, {len(own)} stations: {over:+.1e} over the largest")
        assert own[body.sections.names.index("ST 10")] == pytest.approx(own.max(), rel=1e-9)
        assert over <= 1e-12
        assert area.min() >= own.max() * (1.0 - 1e-4)


def test_areas_anywhere_are_those_of_the_stations_there(todd: dict[float, Flotation]) -> None:
    """On stations and next to them; nil beyond the ends, nan between an end and a station."""
    body = todd[0.60]
    plane = level(4.0, 6.5)
    own = body.stations(plane)
    x = own.x[1:-1]
    np.testing.assert_array_equal(section_areas(body, x, plane), own.area[:, 1:-1])
    ahead, behind = (section_areas(body, x[1:-1] + step, plane) for step in (1e-4, -1e-4))
    np.testing.assert_allclose(ahead, own.area[:, 2:-2], atol=0.01)
    np.testing.assert_allclose(behind, own.area[:, 2:-2], atol=0.01)
    assert section_areas(body, np.array([-5.0, 130.0]), plane).tolist() == [[0.0, 0.0]] * 2
    assert np.isnan(section_areas(body, np.array([-1.0]), plane)).all()


def test_parts_between_stations_make_up_the_whole() -> None:
    """Of a trimmed and heeled ship: ends and two parts add up to volume and moment."""
    body = flotation(series60_adopted(0.70)[0])
    plane = FloatingPlanes(np.array([6.0]), np.array([0.01]), np.array([0.2]))
    x = body.sections.x
    whole = body.measure(plane)
    inner = between_stations(body, x[0], x[-1], plane)
    parts = [between_stations(body, a, b, plane) for a, b in ((x[0], x[9]), (x[9], x[-1]))]
    for name in ("volume", "moment_x", "moment_z", "area", "shell"):
        total = sum(getattr(part, name)[0] for part in parts)
        assert total == pytest.approx(getattr(inner, name)[0], rel=1e-12)
    assert inner.volume[0] == pytest.approx(whole.volume[0], rel=1e-3)
    assert inner.volume[0] < whole.volume[0]
    with pytest.raises(ah.errors.BadInputError, match=r"no station stands at x 1 m.*nearest"):
        between_stations(body, 1.0, x[-1], plane)


def test_the_adopted_container_ship_displaces_what_its_mesh_does(dtc: ah.Hull) -> None:
    """DTC at 14.5 m: V within .05 %, LCB within .02 % Lpp, S within .3 % of the clipped mesh."""
    found = dtc.hydrostatics(draught=14.5)
    print(f"\nDTC: V {found.volume:.1f} m3, LCB {found.lcb:.4f} m, S {found.wetted_surface:.1f} m2")
    assert len(dtc.groups["sections"].lines) == 41
    assert found.volume == pytest.approx(173398.1, rel=5e-4)
    assert found.lcb == pytest.approx(174.0565, abs=2e-4 * 355.0)
    assert found.wetted_surface == pytest.approx(22044.3, rel=3e-3)
    for name, truth in (("volume", 173398.1), ("lcb", 174.0565), ("wetted_surface", 22044.3)):
        stated = found.error[name]
        assert stated is not None
        print(f"{name}: off by {getattr(found, name) - truth:+.4g}, stated {stated:.4g}")


def test_a_yacht_imported_from_offsets_has_its_published_values(data_folder: Path) -> None:
    """Sysser 1, canoe body, 6.25 times the model: V and Aw within .25 %, LCB within .25 % LWL."""
    hull = ah.read(data_folder / "sysser1" / "sysser01_offsets.csv")
    found = hull.hydrostatics(draught=0.794)
    below = flotation(hull.state).measure(level(0.794))
    middle = 0.5 * float(below.x_least[0] + below.x_most[0])
    print(
        f"\nSysser 1: V {found.volume:.4f} m3, Aw {found.waterplane_area:.3f} m2, "
        f"LCB {found.lcb - middle:+.4f} m, LCF {found.lcf - middle:+.4f} m from mid LWL"
    )
    assert found.volume == pytest.approx(9.1830, rel=2.5e-3)
    assert found.waterplane_area == pytest.approx(21.819, rel=2.5e-3)
    assert found.lcb - middle == pytest.approx(-0.229, abs=2.5e-3 * found.lwl)
