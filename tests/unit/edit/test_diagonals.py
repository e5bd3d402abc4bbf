"""Diagonals: lines in planes that are inclined to the base."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.plot.lines_plan.plan import lines_plan
from tests.independent import lost_meetings, trouble

PLACES = ((4.0, 30.0), (6.0, 45.0), (2.0, -10.0))


@pytest.fixture(params=["wigley", "series60_70"], ids=["wigley", "series60"])
def hull(request: pytest.FixtureRequest, shipped: Callable[[str], ah.Hull]) -> ah.Hull:
    """A hull of its own, with three diagonals."""
    hull = shipped(request.param)
    for place in PLACES:
        with hull.edit("diagonal") as edit:
            edit.add_line("diagonals", place)
    return hull


def assert_sound(hull: ah.Hull) -> None:
    """Consistent by the splines alone, and to the kernel's own checks."""
    assert list(trouble(hull)) == []
    assert hull.check() == ()
    assert hull.verify() == ()


def test_a_diagonal_is_cut_by_height_and_angle(hull: ah.Hull) -> None:
    """Its plane meets the centre plane at the height and falls outward by the angle."""
    line = hull.lines["DIA 4 30"]
    assert line.plane is not None
    across = np.array([0.0, np.cos(np.radians(30.0)), -np.sin(np.radians(30.0))])
    assert abs(float(line.plane.normal @ across)) < 1e-15
    assert line.plane.height(np.array([[50.0, 0.0, 4.0]])) == pytest.approx(0.0, abs=1e-14)
    assert line.curves[0].ends[:, 2] == pytest.approx(4.0, abs=1e-12)
    assert line.group.lines.keys() == {"DIA 4 30", "DIA 6 45", "DIA 2 -10"}
    assert_sound(hull)
    assert list(lost_meetings(hull)) == []


def test_the_sections_keep_their_shape(hull: ah.Hull) -> None:
    """Adding a diagonal moves no curve by more than `Tolerances.keep`."""
    section = hull.find("ST 7 [1]")
    assert isinstance(section, ah.Curve)
    before = section.polyline()
    with hull.edit("one more") as edit:
        edit.add_line("diagonals", (5.0, 35.0))
    away = max(section.closest(place)[2] for place in before[::7])
    assert away <= hull.state.tolerances.keep


def test_a_crossing_moves_along_the_oblique_line(hull: ah.Hull) -> None:
    """One coordinate is given, the other follows the plane; both curves pass the place."""
    shared = [point for point in hull.lines["DIA 4 30"].points if point.crossing_role == "shared"]
    point = next(each for each in shared if each.free == ("y",) and each.y > 1.0)
    place = point.position
    with hull.edit("move") as edit:
        edit.move(point, y=place[1] + 0.01)
    expected = place + np.array([0.0, 0.01, -0.01 * np.tan(np.radians(30.0))])
    assert point.position == pytest.approx(expected, abs=1e-12)
    assert point.y == place[1] + 0.01
    assert point.parent_curve is not None
    assert point.parent_curve.closest(point.position)[2] < 1e-9
    assert_sound(hull)
    with pytest.raises(ah.errors.FreedomError), hull.edit("wrong") as edit:
        edit.move(point, z=1.0)


def test_a_diagonal_is_addressed_like_any_line(hull: ah.Hull) -> None:
    """Both ways, and by the key of the line."""
    point = hull.points["DIA 6 45 x ST 7"]
    assert point.friend_point == hull.points["ST 7 x DIA 6 45"]
    assert hull.find("diagonals:6.000000 at 45.000000 deg") == hull.lines["DIA 6 45"]
    assert point.name == "DIA 6 45 x ST 7"


def test_undo_takes_diagonals_and_their_group_back(
    hull: ah.Hull, shipped: Callable[[str], ah.Hull]
) -> None:
    """To the bit, back and forth."""
    after = hull.fingerprint
    hull.undo(3)
    assert "diagonals" not in hull.groups
    fresh = shipped("wigley" if hull.particulars.length == 100.0 else "series60_70")
    assert hull.fingerprint == fresh.fingerprint
    hull.redo(3)
    assert hull.fingerprint == after


def test_the_order_of_creation_shows_nowhere() -> None:
    """Two diagonals through one height, made in either order, have the same bits."""
    prints = set()
    for places in (((3.0, 20.0), (3.0, -20.0)), ((3.0, -20.0), (3.0, 20.0))):
        hull = ah.examples.wigley()
        with hull.edit("both") as edit:
            for place in places:
                edit.add_line("diagonals", place)
        prints.add(hull.fingerprint)
    assert len(prints) == 1


def test_a_diagonal_shifts_is_pulled_and_goes(hull: ah.Hull) -> None:
    """It keeps its angle, follows the hull, and leaves a sound hull behind."""
    normal = hull.lines["DIA 4 30"].plane.normal  # type: ignore[union-attr]
    with hull.edit("shift") as edit:
        edit.shift_line("DIA 4 30", 4.3)
    plane = hull.lines["DIA 4 30"].plane
    assert plane is not None
    assert plane.normal.tolist() == normal.tolist()
    assert plane.offset == 4.3 * normal[2]
    assert_sound(hull)
    revision = hull.lines["DIA 4 30"].curves[0].revision
    with hull.edit("pull") as edit:
        edit.pull("DIA 4 30 x ST 7", 0.02, (20.0, 5.0))
    assert hull.lines["DIA 4 30"].curves[0].revision > revision
    assert_sound(hull)
    with hull.edit("remove") as edit:
        edit.remove_line("DIA 4 30")
    assert_sound(hull)


def test_a_diagonal_survives_saving(hull: ah.Hull, tmp_path: Path) -> None:
    """Opened again it has the same fingerprint."""
    hull.save(tmp_path / "ship.hull.json")
    assert ah.open(tmp_path / "ship.hull.json").fingerprint == hull.fingerprint


def test_the_lines_plan_shows_diagonals(hull: ah.Hull, tmp_path: Path) -> None:
    """In the half-breadth plan and in the body plan."""
    figure = lines_plan(hull, tmp_path / "plan.svg")
    drawn = {str(each.get_gid()) for each in figure.axes[0].lines}
    assert {name.partition("/")[0] for name in drawn if "DIA 4 30" in name} >= {
        "half-breadth",
        "body",
    }


@pytest.mark.parametrize(
    "position",
    [
        pytest.param(4.0, id="a height alone"),
        pytest.param((4.0,), id="one number"),
        pytest.param((4.0, 0.0), id="level"),
        pytest.param((4.0, 90.0), id="upright"),
        pytest.param((float("nan"), 30.0), id="nan"),
        pytest.param(("a", "b"), id="text"),
        pytest.param((4.0, 30.0), id="taken"),
        pytest.param((400.0, 30.0), id="above the hull"),
        pytest.param(None, id="nothing"),
        pytest.param(np.zeros((2, 2)), id="array"),
    ],
)
def test_what_is_no_diagonal_is_refused(position: Any) -> None:
    """An error of the family, and no group is left behind."""
    hull = ah.examples.wigley(stations=9, waterlines=6)
    if isinstance(position, tuple) and position == (4.0, 30.0):
        with hull.edit("first") as edit:
            edit.add_line("diagonals", position)
    before = hull.fingerprint
    with pytest.raises(ah.AssocHullError), hull.edit("try") as edit:
        edit.add_line("diagonals", position)
    assert hull.fingerprint == before


def test_a_number_where_the_group_is_unknown_names_those_there_are() -> None:
    """The groups of the hull, and the one that could be made."""
    hull = ah.examples.wigley(stations=9, waterlines=6)
    with pytest.raises(ah.errors.UnknownNameError, match="diagonals"), hull.edit("try") as edit:
        edit.add_line("diagonal", (4.0, 30.0))
