"""The acceptance story on the bulk carrier: waterlines and buttocks of the stern re-shaped."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.edit.step import EditReport
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.splines.distance import closest_points
from assoc_hull.geometry.splines.plane_intersections import intersect_planes
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.objects import Curve
from tests.independent import trouble

NAMES = {"BTK 0.5": (10.0, 0.4), "BTK 1": (10.0, 2.5)}
"""The buttocks, and how the change of each fades: of the first within the next one."""

WATERLINES = ("WL 18", "WL 16.5", "WL 15", "WL 13.5", "WL 12")
SPAN = (-4.8, 6.6)
REACH = 2.5


def counter(hull: ah.Hull, name: str) -> Curve:
    """Give the piece of a buttock that begins at the transom."""
    return next(each for each in hull.lines[name].curves if each.points[0].x < -4.9)


def aft(hull: ah.Hull, wl: str, name: str) -> ah.Point:
    """Give the crossing of a waterline and a buttock on the counter."""
    return next(
        point
        for point in hull.lines[wl].points
        if point.x < 9.0 and point.parent_curve is not None and point.parent_curve.line.name == name
    )


def bits(hull: ah.Hull) -> dict[str, str]:
    """Give a hash of the splines of every line."""
    found: dict[str, str] = {}
    for name, line in hull.lines.items():
        mixed = hashlib.sha256()
        for curve in line.curves:
            for part in (curve.spline.xyz, curve.spline.leave, curve.spline.arrive):
                mixed.update(part.tobytes())
        found[name] = mixed.hexdigest()
    return found


def changed(before: dict[str, str], hull: ah.Hull) -> set[str]:
    """Name the lines whose bits differ."""
    after = bits(hull)
    return {name for name in before if before[name] != after[name]}


def given(hull: ah.Hull, name: str) -> tuple[FloatArray, FloatArray]:
    """Give A, the crossing with station 0 raised by 20 mm, and B, half-way, raised by 25 mm."""
    curve = counter(hull, name)
    middle = intersect_planes(curve.spline, np.array([1.0, 0.0, 0.0]), np.array([2.2])).xyz
    station = next(p for p in curve.points if p.x == 0.0)
    b = middle[np.argmax(middle[:, 2])]
    return station.position + np.array([0.0, 0.0, 0.020]), b + np.array([0.0, 0.0, 0.025])


def raise_stern(hull: ah.Hull) -> tuple[EditReport, dict[str, FloatArray], list[ah.Point]]:
    """Re-shape the aft stretch of both buttocks; give the report, each B, and its point."""
    goals: dict[str, FloatArray] = {}
    placed: list[ah.Point] = []
    with hull.edit("raise the counter") as edit:
        for name, fade in NAMES.items():
            a, goals[name] = given(hull, name)
            placed += edit.reshape(
                counter(hull, name), points=[a, goals[name]], span=SPAN, fade=fade
            )
    assert edit.report is not None
    return edit.report, goals, placed


@pytest.fixture
def hull(bulk_carrier: ah.Hull) -> Iterator[ah.Hull]:
    """The hull as it was built; whatever a test does to it is undone."""
    before = bulk_carrier.fingerprint
    yield bulk_carrier
    bulk_carrier.undo(len(bulk_carrier.history))
    assert bulk_carrier.fingerprint == before


def consistent(hull: ah.Hull) -> None:
    """Crossings lie on both curves within 1e-9 m, watched gaps are within their limits."""
    assert list(trouble(hull)) == []
    assert hull.check() == ()
    assert hull.verify() == ()
    rows = hull.state.rows
    watched = rows.alive.data & (rows.sort.data == Sort.CROSSING) & (rows.role.data == Role.WATCHED)
    assert (rows.gap[watched] <= rows.limit[watched]).all()


def test_step_1_all_lines_that_cross_a_re_shaped_waterline_follow(hull: ah.Hull) -> None:
    """One point of the 0.5 m waterline moved by 30 mm: each crossing on the stretch moves along."""
    old = {point.name: point.position for point in hull.lines["WL 0.5"].points}
    goal = hull.points["WL 0.5 x ST 1.75"].position + np.array([0.0, 0.030, 0.0])
    with hull.edit("fuller at 0.5 m") as edit:
        edit.reshape("WL 0.5", [goal], span=(16.0, 45.0))
    report = edit.report
    assert report is not None
    assert np.abs(hull.points["WL 0.5 x ST 1.75"].position - goal).max() < 1e-9
    spline = hull.lines["WL 0.5"].curves[0].spline
    followed = []
    for point in hull.lines["WL 0.5"].points:
        if not 17.0 < point.x < 44.0 or point.parent_curve is None:
            continue
        assert np.abs(point.position - old[point.name]).max() > 1e-5, point.name
        if point.crossing_role != "watched":
            assert closest_points(spline, 0, point.position[None])[2][0] < 1e-9
            assert closest_points(point.parent_curve.spline, 0, point.position[None])[2][0] < 1e-9
        followed.append(point.parent_curve.line.name)
    print(f"\n{len(report.relofted)} curves followed, crossed on the stretch: {followed}")
    assert {"ST 1.25", "ST 1.5", "ST 1.75", "ST 2", "BTK 0.5", "BTK 1"} <= set(followed)
    consistent(hull)


def test_step_2_every_waterline_passes_through_the_re_shaped_buttocks(hull: ah.Hull) -> None:
    """Five waterlines cross the stretch; at their shared crossings they follow, within 1e-9 m."""
    old = {(wl, name): aft(hull, wl, name).x for wl in WATERLINES for name in NAMES}
    report, _, _ = raise_stern(hull)
    for (wl, name), before in old.items():
        point = aft(hull, wl, name)
        assert point.crossing_role == "shared"
        assert abs(point.x - before) > 1e-4
        for curve in (hull.lines[wl].curves[0], counter(hull, name)):
            assert closest_points(curve.spline, 0, point.position[None])[2][0] < 1e-9
    largest = max(abs(aft(hull, wl, name).x - x) for (wl, name), x in old.items())
    print(f"\n{report}; a waterline's crossing moved {1e3 * largest:.1f} mm at most")
    assert largest >= 0.020
    consistent(hull)


def test_step_2_b_is_a_placed_point_where_it_was_put(hull: ah.Hull) -> None:
    """To the last bit, on both buttocks."""
    _, goals, placed = raise_stern(hull)
    assert [point.sort for point in placed] == ["placed", "placed"]
    for name, point in zip(NAMES, placed, strict=True):
        assert np.array_equal(point.position, goals[name])
        assert closest_points(counter(hull, name).spline, 0, goals[name][None])[2][0] < 1e-9


def test_step_2_lines_farther_off_than_the_fade_keep_their_bits(hull: ah.Hull) -> None:
    """Stations, waterlines and boundary curves out of reach; buttocks are driven by waterlines."""
    before = bits(hull)
    far = {name for name, line in hull.lines.items() if _far(hull, line)}
    raise_stern(hull)
    moved = changed(before, hull)
    buttocks = set(hull.groups["buttocks"].lines)
    assert len(far) > 40
    assert far & moved <= buttocks
    assert set(WATERLINES) | set(NAMES) <= moved
    assert moved.isdisjoint(hull.groups["boundary"].lines)


def _far(hull: ah.Hull, line: ah.Line) -> bool:
    """Tell whether a line stays farther from the stretch, seen along x, than the fade reaches."""
    points = np.concatenate([curve.polyline(12) for curve in line.curves])
    points = points[(points[:, 0] > SPAN[0]) & (points[:, 0] < SPAN[1])]
    for name in NAMES:
        spline = counter(hull, name).spline
        for place in points:
            met = intersect_planes(spline, np.array([1.0, 0.0, 0.0]), place[:1].copy()).xyz
            if len(met) and np.hypot(*(met - place)[:, 1:].T).min() < REACH:
                return False
    return True


def test_step_2_undo_brings_the_old_hull_back(hull: ah.Hull) -> None:
    """The old fingerprint; redo gives the new one again."""
    before = hull.fingerprint
    raise_stern(hull)
    after = hull.fingerprint
    hull.undo()
    assert hull.fingerprint == before
    hull.redo()
    assert hull.fingerprint == after


def test_step_2_why_a_waterlines_end_moved_names_the_buttock_first(hull: ah.Hull) -> None:
    """And ends at the edit."""
    raise_stern(hull)
    for wl in WATERLINES:
        words = str(hull.why(aft(hull, wl, "BTK 0.5"))).splitlines()
        assert "'raise the counter'" in words[0]
        assert words[1].startswith("BTK 0.5")
        assert "set by the edit" in words[-1]


def test_step_2_waterlines_do_not_follow_against_a_one_way_association(hull: ah.Hull) -> None:
    """With waterlines -> buttocks declared, the same script moves no waterline by a bit."""
    with hull.edit("one way") as edit:
        edit.associate("waterlines", "buttocks", two_way=False)
    before = bits(hull)
    raise_stern(hull)
    moved = changed(before, hull)
    assert set(NAMES) <= moved
    assert moved.isdisjoint(hull.groups["waterlines"].lines)
    consistent(hull)
