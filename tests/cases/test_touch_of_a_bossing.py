"""The bossing of the bulk carrier made larger, until the 1.0 m buttock touches its end.

Varied by a map alone: gaps between lines cut again are reported, not refused. What is held here
is the touch itself; the acceptance story has the rest.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.edit.recording import Settings
from assoc_hull.edit.transaction import Transaction
from assoc_hull.geometry.splines.plane_intersections import intersect_planes
from assoc_hull.model.tables import copy_state
from assoc_hull.variation.carrying.carry_hull import apply_map
from tests.boss_map import boss_map
from tests.taken_back import taken_back

FORE = 7.5
"""Up to here the bossing is a cylinder."""

PLACE = [6.0, 1.0, 6.0]


def varied(hull: ah.Hull, shaft: tuple[float, float], radius: tuple[float, float]) -> None:
    """Vary the bossing of a hull in place."""
    with Transaction(hull.document, "bossing", Settings(refuse_gaps=False)) as edit:
        apply_map(edit, boss_map(FORE, shaft, radius))


@pytest.fixture(scope="module")
def touched(bulk_carrier: ah.Hull) -> ah.Hull:
    """The shaft at 6 m and a radius of 1 m."""
    hull = ah.Hull(copy_state(bulk_carrier.state))
    varied(hull, (5.0, 6.0), (0.725, 1.0))
    return hull


def touch(hull: ah.Hull) -> ah.Point:
    """Give the crossing of the buttock with the end of the bossing."""
    return hull.points["BTK 1 x bossing end"]


def test_the_buttock_missed_the_bossing_before(bulk_carrier: ah.Hull) -> None:
    """It passes forward of it in one smooth turn."""
    assert "BTK 1 x bossing end" not in bulk_carrier.points
    assert not any(point.kind == "knuckle" for point in bulk_carrier.lines["BTK 1"].points)


def test_touched_it_turns_in_a_knuckle_at_the_place_of_the_circle(touched: ah.Hull) -> None:
    """One shared crossing with the bits of the feature, on both lines."""
    point = touch(touched)
    assert point.position.tolist() == PLACE
    assert (point.crossing_role, point.kind) == ("shared", "knuckle")
    (curve,) = touched.lines["BTK 1"].curves
    for spline in (curve.spline, touched.lines["bossing end"].curves[0].spline):
        assert PLACE in spline.xyz.tolist()


def test_it_comes_along_one_branch_and_leaves_along_the_other(touched: ah.Hull) -> None:
    """From above the shaft to below it; at the knuckle both run along the cylinder."""
    (curve,) = touched.lines["BTK 1"].curves
    spline = curve.spline
    knot = spline.xyz.tolist().index(PLACE)
    arrive, leave = spline.arrive[knot], spline.leave[knot]
    assert arrive[0] < 0.0 < leave[0]
    assert abs(arrive[2] / arrive[0]) < 0.02
    assert abs(leave[2] / leave[0]) < 0.02
    above, below = spline.xyz[knot - 1], spline.xyz[knot + 1]
    assert above[0] == below[0] == FORE
    assert spline.xyz[knot - 2, 0] == spline.xyz[knot + 2, 0] == 9.3
    assert spline.xyz[knot - 2, 2] > 6.4
    assert spline.xyz[knot + 2, 2] < 5.8


def test_between_knuckle_and_the_next_station_it_is_on_the_hull(touched: ah.Hull) -> None:
    """Along the cylinder, where the plane touches, to 1 micrometre of the circle."""
    (curve,) = touched.lines["BTK 1"].curves
    for x in (6.4, 6.75, 7.1, FORE):
        met = intersect_planes(curve.spline, np.array([1.0, 0.0, 0.0]), np.array([x])).xyz
        z = met[met[:, 2] < 8.0, 2]
        assert len(z) == 2
        assert np.hypot(1.0, z - 6.0).max() - 1.0 < 1e-6


def test_the_circle_is_round_to_a_micrometre_and_its_feature_says_so(touched: ah.Hull) -> None:
    """Points enough, ends clamped; centre and radius are the asked ones to the bit."""
    feature = touched.features["bossing end"]
    assert feature.parameters["centre"] == (6.0, 0.0, 6.0)
    assert feature.parameters["radius"] == 1.0
    x, y, z = touched.lines["bossing end"].curves[0].polyline(32).T
    assert np.abs(np.hypot(y, z - 6.0) - 1.0).max() <= 1e-6
    assert (x == 6.0).all()


def test_stations_of_the_cylinder_touch_the_plane_and_do_not_cross_it(touched: ah.Hull) -> None:
    """Rounding has no say: no crossing there, though their splines may meet the plane."""
    names = {point.name for point in touched.lines["BTK 1"].points if point.x < 9.0}
    assert not names & {f"BTK 1 x ST {each}" for each in ("0.45 #2", "0.5 #2", "0.45 #3", "0.5 #3")}


def test_waterlines_end_on_the_raised_bossing(touched: ah.Hull) -> None:
    """The one at the shaft's new height at its widest place, the one at the old on the profile."""
    ends = {name: touched.lines[name].curves[0].points[0] for name in ("WL 5", "WL 6", "WL 7")}
    assert ends["WL 6"].position.tolist() == PLACE
    assert ends["WL 6"].name == "WL 6 x bossing end"
    assert ends["WL 5"].position.tolist() == pytest.approx([7.5, 0.0, 5.0], abs=1e-9)
    assert ends["WL 7"].position.tolist() == pytest.approx([6.0, 0.0, 7.0], abs=1e-9)


def test_the_hull_is_sound_and_kept_in_files(touched: ah.Hull, tmp_path: Path) -> None:
    """Rebuilt from its definition it is the same; the text and undo give the same fingerprint."""
    assert touched.verify() == ()
    assert {each.kind for each in touched.check()} <= {"gap"}
    touched.save(tmp_path / "boss.hull.json")
    assert ah.open(tmp_path / "boss.hull.json").fingerprint == touched.fingerprint
    after = touched.fingerprint
    touched.undo()
    touched.redo()
    assert touched.fingerprint == after


def test_a_touch_that_stays_is_the_same_crossing(touched: ah.Hull) -> None:
    """Raised by 0.1 m more it goes along; made smaller again, the buttock passes forward."""
    with taken_back(touched):
        key = touch(touched).id
        varied(touched, (6.0, 6.1), (1.0, 1.0))
        assert touch(touched).id == key
        assert touch(touched).position.tolist() == [6.0, 1.0, 6.1]
        varied(touched, (6.1, 6.1), (1.0, 0.9))
        assert "BTK 1 x bossing end" not in touched.points
        buttock = touched.lines["BTK 1"].points
        assert min(point.x for point in buttock if point.z < 8.0) > 9.0
        assert not any(point.kind == "knuckle" for point in buttock)
        assert touched.verify() == ()


def test_an_end_that_grows_over_its_touch_ends_two_branches(touched: ah.Hull) -> None:
    """The plane of the buttock meets the circle twice then; one knuckle would be wrong."""
    with taken_back(touched):
        varied(touched, (6.0, 6.0), (1.0, 1.2))
        ends = [point for point in touched.lines["BTK 1"].points if "bossing end" in point.name]
        away = np.sqrt(1.2**2 - 1.0)
        heights = sorted(point.z for point in ends)
        assert heights == pytest.approx([6.0 - away, 6.0 + away], abs=1e-6)
        assert not any(point.kind == "knuckle" for point in ends)
        assert len(touched.lines["BTK 1"].curves) == 2
