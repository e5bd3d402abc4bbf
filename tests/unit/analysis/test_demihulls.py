"""A ship of two demihulls: her numbers follow from those of one, by hand and by a mesh of both."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.analysis.hydrostatics.mesh_flotation import mesh_flotation
from assoc_hull.cli import main
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.floating.immersion import FloatingPlanes
from tests import several_hulls

APART = 16.0


@pytest.fixture(scope="module")
def hull() -> ah.Hull:
    """One Wigley hull, 100 m by 10 m."""
    return ah.examples.wigley()


def test_sums_are_twice_and_the_inertia_has_its_transfer_term(hull: ah.Hull) -> None:
    """V, S, A_W, sections, TPC twice; I_T = 2 (i + (s/2)^2 A); KM_T = KB + I_T / V."""
    one = hull.hydrostatics(draught=4.0, kg=5.0)
    ship = hull.hydrostatics(draught=4.0, kg=5.0, demihulls=2, separation=APART)
    for name in ("volume", "displacement", "waterplane_area", "wetted_surface", "i_l", "a_max",
                 "a_midship", "tpc", "mtc", "wetted_surface_girth"):  # fmt: skip
        assert getattr(ship, name) == pytest.approx(2.0 * getattr(one, name), rel=1e-12), name
    for name in ("lcb", "kb", "lcf", "kml", "lwl", "cb", "cm", "cx", "cp", "cw", "cvp", "cb_lwl",
                 "cp_lwl", "tcb", "tcf"):  # fmt: skip
        assert getattr(ship, name) == pytest.approx(getattr(one, name), rel=1e-12, abs=1e-12), name
    i_t = 2.0 * (one.i_t + 0.25 * APART**2 * one.waterplane_area)
    assert ship.i_t == pytest.approx(i_t, rel=1e-12)
    assert ship.kmt == pytest.approx(one.kb + i_t / ship.volume, rel=1e-12)
    assert ship.bwl == pytest.approx(one.bwl + APART, rel=1e-12)
    off, own = ship.error["volume"], one.error["volume"]
    assert off is not None
    assert own is not None
    assert off == pytest.approx(2.0 * own, rel=1e-9)


@pytest.mark.parametrize(("draught", "heel"), [(4.0, 0.0), (3.0, 8.0), (1.0, -12.0)])
def test_she_floats_as_the_mesh_of_both(hull: ah.Hull, draught: float, heel: float) -> None:
    """Heeled too, and with one demihull out of the water at 12 degrees."""
    mesh = several_hulls.catamaran(deck=False)
    plane = FloatingPlanes(np.array([draught]), np.zeros(1), np.tan(np.radians(np.array([heel]))))
    truth = mesh_flotation(mesh.xyz, mesh.face).measure(plane)
    ship = hull.hydrostatics(
        draught=draught, heel_deg=heel, demihulls=2, separation=2.0 * several_hulls.OFF
    )
    assert ship.volume == pytest.approx(float(truth.volume[0]), rel=2e-3)
    assert ship.tcb == pytest.approx(float(truth.moment_y[0] / truth.volume[0]), abs=5e-3)
    assert ship.kb == pytest.approx(float(truth.moment_z[0] / truth.volume[0]), abs=5e-3)
    assert ship.waterplane_area_proj == pytest.approx(float(truth.area[0]), rel=2e-3)
    inertia = float(truth.area_yy[0] - truth.area_y[0] ** 2 / truth.area[0])
    assert ship.i_t_proj == pytest.approx(inertia, rel=3e-3)
    if heel == 0.0:
        kmt = float((truth.moment_z[0] + inertia) / truth.volume[0])
        assert ship.kmt == pytest.approx(kmt, rel=3e-3)


def test_the_header_names_what_the_numbers_are_of(hull: ah.Hull) -> None:
    """In the table, for who reads it alone; of one hull it says nothing."""
    table = hull.hydrostatic_table([2.0, 4.0], demihulls=2, separation=APART)
    words = " ".join(text for _, text in table.header.lines())
    assert "of two demihulls, centre planes 16 m apart" in words
    assert "demihull" not in str(list(hull.hydrostatic_table([2.0]).header.lines()))
    ship = hull.hydrostatics(draught=4.0, demihulls=2, separation=APART)
    assert table[1].kmt == pytest.approx(ship.kmt, rel=1e-12)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"demihulls": 2}, "no separation"),
        ({"separation": 16.0}, "separation is given for one hull"),
        ({"demihulls": 3, "separation": 16.0}, "demihulls"),
        ({"demihulls": True, "separation": 16.0}, "demihulls"),
        ({"demihulls": 2, "separation": 9.0}, "separation is 9 m, and each demihull is 10 m broad"),
        ({"demihulls": 2, "separation": float("nan")}, "separation"),
    ],
)
def test_what_makes_no_ship_is_refused(hull: ah.Hull, options: dict[str, Any], words: str) -> None:
    """One of the two options without the other, other counts, demihulls that overlap."""
    with pytest.raises(BadInputError, match=words):
        hull.hydrostatics(draught=4.0, **options)


def test_her_deck_edge_is_that_of_the_outer_side(hull: ah.Hull) -> None:
    """13 m off her centre plane, not 5 m, and to the side that goes down."""
    (found,) = hull.hydrostatic_table(
        [4.0], heel_deg=12.0, demihulls=2, separation=APART
    ).freeboards
    slope = np.tan(np.radians(12.0))
    least = (hull.particulars.depth - 4.0 - 13.0 * slope) * np.cos(np.radians(12.0))
    assert found.least == pytest.approx(least, abs=1e-9)
    assert found.place[1] == pytest.approx(-13.0)


def test_the_command_tells_the_ship(tmp_path: Any, capsys: pytest.CaptureFixture[str]) -> None:
    """With freeboard and angle of the deck edge; by weight each demihull carries half of it."""
    path = str(tmp_path / "demi.hull")
    ah.examples.wigley().save(path)
    ship = ["hydrostatics", path, "--no-estimate", "--demihulls", "2", "--separation", "16"]
    assert main([*ship, "--draught", "4"]) == 0
    words = capsys.readouterr().out
    assert "two demihulls" in words
    one = ah.open(path).hydrostatics(draught=4.0)
    assert f"{2.0 * one.volume:.2f}" in words
    angle = float(words.split("goes under at ")[1].split()[0])
    height = 9.375 - 13.0 * float(np.tan(np.radians(angle)))
    heeled = ah.open(path).hydrostatics(
        draught=height, heel_deg=angle, demihulls=2, separation=APART, estimate=False
    )
    assert heeled.volume == pytest.approx(2.0 * one.volume, rel=1e-3)
    assert main([*ship, "--weight", f"{2.0 * one.displacement}"]) == 0
    assert "4.0000" in capsys.readouterr().out
    assert main([*ship, "--draught", "4", "--plot", str(tmp_path / "p.png")]) == 2
    assert "--demihulls 2" in capsys.readouterr().err
