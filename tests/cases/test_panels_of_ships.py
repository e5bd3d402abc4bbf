"""Panels of nets: closed but for the water surface, with normals out of the hull, anywhere."""

from __future__ import annotations

from typing import Any

import attrs
import numpy as np
import pytest
from numpy.testing import assert_allclose

from assoc_hull.analysis.panels.hull_panels import panels, section_points
from assoc_hull.analysis.panels.mesh_quality import panel_report
from assoc_hull.errors import AssocHullError, OutOfRangeError
from assoc_hull.hull import Hull
from assoc_hull.hull.sources import examples
from assoc_hull.model.tables import HullState
from tests.nets import wigley_net
from tests.twin_skeg import twin_skeg_ship


@attrs.frozen
class Bare:
    """Tables as what has some."""

    state: HullState


@pytest.fixture(scope="module")
def ships(series60_70: Hull, bulk_carrier: Hull) -> dict[str, Hull]:
    """The hulls that are shipped."""
    return {"wigley": examples.wigley(), "series60": series60_70, "carrier": bulk_carrier}


# Multiples of the design draught aft and forward, heel, further words
POSITIONS: list[tuple[float, float, float, dict[str, Any]]] = [
    (1.0, 1.0, 0.0, {}),
    (1.0, 1.0, 0.0, {"side": "full", "spacing": "cosine"}),
    (1.25, 0.8, 0.0, {"knuckle_deg": 10.0}),  # the transom of the carrier goes under
    (0.5, 0.9, 0.0, {"count": 600}),  # her bulb comes out, and the bossing
    (1.0, 1.0, 10.0, {}),
    (1.1, 0.9, -20.0, {"points": 13, "stations": 60}),
    (0.45, 0.45, -24.0, {"count": 1000}),
    (0.6, 0.6, 70.0, {"knuckle_deg": 10.0}),  # the deck is wet, the keel dry
]


@pytest.mark.parametrize("name", ["wigley", "series60", "carrier"])
@pytest.mark.parametrize("position", POSITIONS, ids=lambda each: "{}, {}, {} deg".format(*each))
def test_the_mesh_is_closed_at_any_position(
    name: str, position: tuple[float, float, float, dict[str, Any]], ships: dict[str, Hull]
) -> None:
    """Free edges lie in the water surface, all three volumes are one, normals point outward."""
    aft, fore, heel, words = position
    hull = ships[name]
    draught = hull.particulars.draught
    mesh = panels(hull, draughts=(aft * draught, fore * draught), heel_deg=heel, **words)
    report = panel_report(mesh)
    assert report.watertight
    assert report.outward
    assert report.degenerate == 0
    assert report.above == 0
    assert np.ptp(mesh.volumes) <= 1e-9 * report.volume[0]
    assert mesh.mirror_y == (heel == 0.0 and words.get("side") != "full")
    assert abs(report.volume_error or 1.0) < 0.02
    assert abs(report.area_error or 1.0) < 0.03
    assert (report.centre_error or 0.0) < 0.01 * draught
    whole = mesh.whole()
    free = whole.xyz[whole.free_edges()]
    assert len(free)
    assert (free[:, :, 2] == 0.0).all()


@pytest.mark.parametrize("draughts", [(6.5024, 6.5024), (5.52, 6.73), (7.25, 7.74)])
def test_lines_that_miss_the_centre_plane_leave_no_gap(
    series60_60: Hull, draughts: tuple[float, float]
) -> None:
    """The foremost section begins a seventh of a millimetre off the stem: that is no opening."""
    report = panel_report(panels(series60_60, draughts=draughts, count=800))
    assert report.outward
    assert report.aspect.most < 100.0


def test_twin_skegs_are_divided_too() -> None:
    """A tunnel between skegs, in the water and out of it, heeled as well."""
    hull = twin_skeg_ship()
    for draught, heel in ((18.0, 0.0), (7.0, 0.0), (12.0, 15.0)):
        report = panel_report(panels(hull, draught=draught, heel_deg=heel, count=900))
        assert report.outward
        assert abs(report.volume_error or 1.0) < 0.01


def test_half_and_full_are_one_mesh(bulk_carrier: Hull) -> None:
    """The half with its image has the panels of the full mesh, corner by corner."""
    half = panels(bulk_carrier, count=600)
    full = panels(bulk_carrier, count=1200, side="full")
    assert half.images == 2
    assert full.images == 1
    assert half.whole().count == full.count
    corners = [
        np.sort(np.round(mesh.centre, 6).view([("", float)] * 3).ravel())
        for mesh in (half.whole(), full)
    ]
    assert (corners[0] == corners[1]).all()


def test_the_error_of_the_net_falls_at_second_order() -> None:
    """Wigley's hull as a net: 500, 2,000 and 8,000 panels, against 4/9 L B T.

    The net itself is off by 4e-6 of the volume, a fiftieth of the last error.
    """
    hull = Bare(wigley_net(21, 9))
    exact = 4.0 / 9.0 * 100.0 * 10.0 * 6.25
    errors = []
    for count in (500, 2000, 8000):
        mesh = panels(hull, count=count)
        assert mesh.count == count
        assert panel_report(mesh).outward
        errors.append(float(mesh.volumes[0]) / exact - 1.0)
    print("\nvolume errors", errors)
    assert errors[0] / errors[1] == pytest.approx(4.0, abs=0.15)
    assert errors[1] / errors[2] == pytest.approx(4.0, abs=0.15)


def test_the_origin_is_where_it_is_wanted(ships: dict[str, Hull]) -> None:
    """In the water surface at the x that was named; midship if none was."""
    middle = panels(ships["wigley"], count=200)
    after = panels(ships["wigley"], count=200, origin=0.0)
    assert_allclose(after.xyz - middle.xyz, np.tile([50.0, 0.0, 0.0], (len(after.xyz), 1)))
    assert middle.xyz[:, 0].min() == pytest.approx(-50.0)
    assert middle.xyz[:, 2].min() == pytest.approx(-6.25)
    assert middle.origin is not None
    assert middle.origin.x == 50.0


def test_stations_stand_where_they_are_given(ships: dict[str, Hull]) -> None:
    """Every x that was named has a section of the mesh, the ends of the hull besides."""
    wanted = [10.0, 25.0, 47.5, 70.0, 90.0]
    mesh = panels(ships["wigley"], stations=wanted, points=6, origin=0.0)
    assert_allclose(np.unique(np.round(mesh.xyz[:, 0], 9)), [0.0, *wanted, 100.0], atol=1e-9)
    assert mesh.count == 6 * 5


def test_points_of_the_midship_section_are_those_of_flat_arc_and_side(bulk_carrier: Hull) -> None:
    """B 50 m, T 18 m, bilge radius 2.4 m, within the net's own error of a millimetre."""
    found = section_points(bulk_carrier, [120.0, 150.0], points=21)
    flat, turn = 25.0 - 2.4, 2.4 * 0.5 * np.pi
    s = (flat + turn + 18.0 - 2.4) * np.arange(21) / 20.0
    angle = np.clip((s - flat) / 2.4, 0.0, 0.5 * np.pi)
    y = np.minimum(s, flat) + 2.4 * np.sin(angle)
    z = 2.4 - 2.4 * np.cos(angle) + np.maximum(s - flat - turn, 0.0)
    for section in found:
        assert_allclose(section[:, 1:], np.column_stack([y, z]), atol=1e-3)


def test_all_pieces_of_a_section_are_one_length(bulk_carrier: Hull) -> None:
    """At x = 302 m a bulb lies below the overhanging stem; a dry section has no points."""
    deep, dry = section_points(bulk_carrier, [302.0, 400.0], points=30, draught=23.0)
    assert np.isnan(dry).all()
    assert_allclose(deep[:, 0], 302.0, atol=1e-9)
    assert (deep[0, 1], deep[0, 2] < 3.0) == (0.0, True)
    assert deep[-1, 2] == pytest.approx(23.0, abs=1e-9)
    gap = np.diff(deep[:, 2])
    assert gap.max() > 5.0  # from the top of the bulb to the stem
    step = np.sqrt((np.diff(deep, axis=0) ** 2).sum(axis=1))
    assert np.sort(step)[-2] < 1.05 * np.median(step)


def test_an_open_transom_is_told(bulk_carrier: Hull) -> None:
    """Without panels over it the mesh is open below the water, and the report says so."""
    closed, opened = (
        panel_report(panels(bulk_carrier, draughts=(22.0, 18.0), count=800, transom=each))
        for each in (True, False)
    )
    assert closed.watertight
    assert not opened.watertight
    assert opened.edges.below > 0
    assert "no: the mesh is open" in str(opened)
    assert closed.area > opened.area


@pytest.mark.parametrize(
    ("words", "told"),
    [
        ({"side": "half", "heel_deg": 5.0}, "half of a heeled hull"),
        ({"count": 4}, "count is 4"),
        ({"points": 2}, "points is 2"),
        ({"stations": [3.0, 1.0]}, "stations are"),
        ({"stations": [1.0, float("nan")]}, "stations is"),
        ({"stations": 20, "points": 5, "count": 100}, "all given"),
        ({"spacing": "equal"}, "spacing"),
        ({"draught": 30.0}, "mean draught"),
        ({"draught": float("nan")}, "draught"),
        ({"origin": "bow"}, "origin"),
        ({"knuckle_deg": -1.0}, "knuckle_deg"),
        ({"transom": 1}, "transom"),
        ({"side": "port"}, "side"),
    ],
)
def test_what_cannot_be_is_refused(
    words: dict[str, Any], told: str, ships: dict[str, Hull]
) -> None:
    """With the name of the argument, before anything is divided."""
    with pytest.raises(AssocHullError, match=told):
        panels(ships["wigley"], **words)


@pytest.mark.parametrize("stations", [[-300.0, -200.0], [-500.0, 50.0, 80.0], [20.0, 400.0]])
def test_stations_off_the_wet_hull_are_refused_with_its_extent(
    ships: dict[str, Hull], stations: list[float]
) -> None:
    """None is left out in silence, and a deeper draught is no remedy."""
    with pytest.raises(OutOfRangeError, match=r"meets no wet hull, in panels; give one from"):
        panels(ships["wigley"], stations=stations)
