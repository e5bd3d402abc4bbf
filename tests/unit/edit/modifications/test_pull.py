"""A pull puts its point where it was asked, or says by how much it failed to."""

from __future__ import annotations

import random

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import assoc_hull as ah
from assoc_hull.edit.hull_normals import hull_normals
from assoc_hull.edit.step import EditReport
from assoc_hull.errors import RefusedEditError
from assoc_hull.geometry.curves import FloatArray
from tests.independent import trouble
from tests.long_forms import draws
from tests.net_strategies import POOL, fresh, live_points, refused

RADIUS = (25.0, 6.0)


def place_of(hull: ah.Hull, point: ah.Point) -> FloatArray:
    """Where a point lies; a watched crossing where its first curve passes."""
    rows = hull.state.rows
    watched = point.crossing_role == "watched"
    return np.array(rows.spot[point.row, 0] if watched else rows.xyz[point.row])


def pulled(
    hull: ah.Hull, point: ah.Point, amount: float, radius: tuple[float, float] | None = RADIUS
) -> tuple[EditReport, float]:
    """Pull a point; gives the report, and how far it came along the normal of before, m."""
    normal, before = hull_normals(hull.state)[point.row], place_of(hull, point)
    with hull.edit("pull", gaps="report") as edit:
        edit.pull(point, amount, radius)
    assert edit.report is not None
    return edit.report, float((place_of(hull, point) - before) @ normal)


@pytest.mark.parametrize("amount", [0.02, 0.1, 0.4, -0.4])
@pytest.mark.parametrize("name", ["WL 2.305 x ST 3", "WL 2.305 x ST 4"])
def test_a_driven_crossing_comes_where_it_is_pulled(name: str, amount: float) -> None:
    """Its driver, a section without a point for 2 m, came a quarter of the way only.

    It is given an adopted point there, and says so.
    """
    hull = fresh(4)
    point = hull.points[name]
    assert point.crossing_role == "drives b"
    report, reached = pulled(hull, point, amount)
    assert reached == pytest.approx(amount, rel=0.01)
    assert any("was adopted, to be pulled there" in note for note in report.notes)
    assert list(trouble(hull, kept=True)) == []
    assert hull.verify() == ()


def test_a_second_pull_adopts_no_second_point() -> None:
    """The point that is there is pulled."""
    hull = fresh(4)
    point = hull.points["WL 2.305 x ST 3"]
    pulled(hull, point, 0.05)
    count = len(live_points(hull, "adopted"))
    assert pulled(hull, point, 0.05)[1] == pytest.approx(0.05, rel=0.01)
    assert len(live_points(hull, "adopted")) == count
    hull.undo(2)
    assert len(live_points(hull, "adopted")) == count - 1


@settings(max_examples=draws(40))
@given(
    st.integers(0, POOL - 1),
    st.integers(0, 2**16),
    st.sampled_from([-0.3, -0.05, 0.004, 0.05, 0.3]),
    st.sampled_from([None, RADIUS, (8.0, 2.0)]),
)
def test_an_accepted_pull_reaches_what_it_asked(
    number: int, which: int, amount: float, radius: tuple[float, float] | None
) -> None:
    """Along the normal, within 1 %, at shared, driven and watched crossings."""
    hull = fresh(number)
    points = live_points(hull, "crossing")
    try:
        reached = pulled(hull, points[which % len(points)], amount, radius)[1]
    except ah.AssocHullError:
        return
    assert reached == pytest.approx(amount, rel=0.01)


def test_a_pull_that_cannot_reach_is_refused_with_both_numbers() -> None:
    """A point that the designer placed on the driver holds it."""
    hull = fresh(4)
    point = hull.points["WL 2.305 x ST 3"]
    with hull.edit("hold") as edit:
        edit.insert(hull.lines["ST 3"].curves[0], point.position, lead=False)
    message = refused(
        hull, lambda edit: edit.pull(point, 0.05, RADIUS), ah.errors.RefusedEditError, "report"
    )
    assert "WL 2.305 x ST 3 came 0.0 mm along the normal where 50.0 mm were asked" in message
    assert "ST 3 drives it" in message


def test_a_pull_of_a_point_that_slides_along_the_hull_says_so() -> None:
    """A waterline and a buttock made to cross amidships by a role; watched, it can be pulled."""
    hull = fresh(2)
    point = hull.crossings["BTK 1.712 x WL 5.014 #2"].points[0]
    with hull.edit("role") as edit:
        edit.set_role(point, "shared")
    message = refused(
        hull, lambda edit: edit.pull(point, 0.02, RADIUS), ah.errors.RefusedEditError, "report"
    )
    assert "came 0.0 mm along the normal where 20.0 mm were asked" in message
    assert "it is free almost along the hull only" in message
    assert "edit.set_role" in message
    with hull.edit("role") as edit:
        edit.set_role(point, "watched")
    assert pulled(hull, point, 0.02)[1] == pytest.approx(0.02, rel=0.01)


def test_two_large_pulls_far_apart_go_all_the_way_in_one_edit() -> None:
    """Each sub-step takes an equal part of both: nobody looks where one of several has come."""
    hull = ah.examples.wigley()
    points = [hull.points[name] for name in ("WL 2.5 x ST 4", "WL 2.5 x ST 14")]
    normals = hull_normals(hull.state)[[point.row for point in points]]
    before = np.array([place_of(hull, point) for point in points])
    assert hull.state.tolerances.substep < 0.3 / 2.0
    with hull.edit("both", gaps="report") as edit:
        for point in points:
            edit.pull(point, 0.3, (12.0, 3.0))
    moved = np.array([place_of(hull, point) for point in points]) - before
    # The normal turns on the way, and the field of each goes with it.
    assert (moved * normals).sum(axis=1) == pytest.approx([0.3, 0.3], rel=0.02)


def test_pulls_of_several_points_add() -> None:
    """Where two fields overlap neither point is asked to be where one of them alone pulls."""
    hull = fresh(4)
    points = [hull.points[name] for name in ("WL 2.305 x ST 3", "WL 2.305 x ST 4")]
    before = [point.y for point in points]
    with hull.edit("both", gaps="report") as edit:
        for point in points:
            edit.pull(point, 0.02, RADIUS)
    assert all(point.y > old + 0.02 for point, old in zip(points, before, strict=True))


def test_driven_crossings_of_series_60_come_where_they_are_pulled(series60_70: ah.Hull) -> None:
    """With the radius that is chosen for them; before, half of them came 60 % of the way."""
    hull, done, rng = series60_70, 0, random.Random(7)
    points = [p for p in live_points(hull, "crossing") if p.crossing_role == "drives b"]
    for point in rng.sample(points, 30):
        try:
            reached = pulled(hull, point, 0.02, None)[1]
        except (ah.errors.RefusedEditError, ah.errors.PointRoleError):
            continue
        assert reached == pytest.approx(0.02, rel=0.01)
        hull.undo()
        done += 1
    assert done >= 15


def test_a_pull_on_a_flat_is_refused_by_the_name_that_was_given(series60_70: ah.Hull) -> None:
    """No key of the tables: the crossing as a person calls it, and what to do."""
    with pytest.raises(ah.errors.PointRoleError) as caught, series60_70.edit("on the flat") as edit:
        edit.pull("WL 1 x ST 10", d=0.05, radius=(20.0, 8.0))
    assert str(caught.value).startswith("WL 1 x ST 10 is on a flat")
    assert "across_flats=True" in str(caught.value)
    assert ":" not in str(caught.value)


def test_a_line_moved_as_far_as_its_points_also_in_several_sub_steps(
    fresh_series60_70: ah.Hull,
) -> None:
    """A large pull is carried out in steps; what is told of a line is the whole of them."""
    hull = fresh_series60_70
    with hull.edit("a large pull") as edit:
        edit.pull("WL 0.5 x ST 16", 0.05, radius=(20.0, 8.0))
    found = hull.why("ST 16")
    assert found.moved is not None
    far = [cause.moved for cause in found.causes if cause.moved is not None]
    assert found.moved == pytest.approx(max(far), rel=1e-12)


def test_a_pull_too_far_names_the_point_that_would_move_most() -> None:
    """Not the one in hand, mostly: one that lies nearly along the hull slides much farther."""
    hull = ah.examples.wigley()
    with (
        pytest.raises(RefusedEditError, match=r"move by up to [0-9.]+ m, at \S+ \S+ x \S+ \S+"),
        hull.edit("far") as edit,
    ):
        edit.pull("WL 5 x ST 12", 20.0, radius=(15.0, 5.0))
