"""Overriding the role of a crossing."""

from __future__ import annotations

import pytest

import assoc_hull as ah
from assoc_hull.edit.session import Edit
from assoc_hull.errors import BadInputError, PointRoleError, RingError
from assoc_hull.model.objects import Crossing
from tests.independent import trouble
from tests.net_strategies import fresh, refused

SHARED = "WL 3.343 x ST 3"
WATCHED = "BTK 1.712 x WL 3.343"


@pytest.fixture
def hull() -> ah.Hull:
    """A net of three families of its own."""
    return fresh(2)


def set_role(hull: ah.Hull, name: str, role: str | None) -> Crossing:
    """Set a role in an edit of its own."""
    with hull.edit("role", gaps="report") as edit:
        edit.set_role(name, role)
    crossing = hull.points[name].crossing
    assert crossing is not None
    return crossing


@pytest.mark.parametrize("name", [SHARED, "BTK 1.712 x ST 4", WATCHED])
@pytest.mark.parametrize("role", ["shared", "drives a", "drives b", "watched"])
def test_every_crossing_takes_every_role(hull: ah.Hull, name: str, role: str) -> None:
    """The role, the override and the curves that are made through it follow."""
    crossing = set_role(hull, name, role)
    assert (crossing.role, crossing.override) == (role, role)
    defined = {"shared": (True, True), "drives a": (True, False), "drives b": (False, True)}
    points = crossing.points
    found = tuple(point in point.container_curve.defining for point in points)
    assert found == defined.get(role, (False, False))
    assert list(trouble(hull)) == []
    assert hull.verify() == ()
    assert {finding.kind for finding in hull.check()} <= {"gap"}


def test_a_driven_value_is_that_of_its_driver_at_once(hull: ah.Hull) -> None:
    """A watched crossing that comes to be driven by the curve of higher rank."""
    crossing = set_role(hull, WATCHED, "drives a")
    driver = crossing.b
    assert crossing.points[0].driver == driver
    assert driver.closest(crossing.points[0].position)[2] < 1e-9


def test_a_crossing_that_stops_defining_leaves_the_shape(hull: ah.Hull) -> None:
    """Both curves stay within the tolerance of pruning, by a stand-in if need be."""
    point = hull.points[SHARED]
    curves = [each.container_curve for each in (point, point.friend_point) if each is not None]
    before = [curve.polyline(16) for curve in curves]
    set_role(hull, SHARED, "watched")
    for curve, places in zip(curves, before, strict=True):
        away = max(curve.closest(place)[2] for place in places)
        assert away <= hull.state.tolerances.prune + 1e-9


def test_there_and_back_leaves_no_stand_in(hull: ah.Hull) -> None:
    """A shared crossing made watched and shared again; the curves have no more points."""
    point = hull.points[SHARED]
    count = len(point.container_curve.defining)
    set_role(hull, SHARED, "watched")
    set_role(hull, SHARED, "shared")
    assert len(point.container_curve.defining) == count


def test_none_gives_the_crossing_back_to_the_rule(hull: ah.Hull) -> None:
    """The override is gone."""
    set_role(hull, SHARED, "watched")
    crossing = set_role(hull, SHARED, None)
    assert crossing.override is None
    assert crossing.role == "shared"


def test_a_role_may_be_set_through_the_crossing(hull: ah.Hull) -> None:
    """As well as through either of its points."""
    crossing = hull.points[SHARED].crossing
    assert crossing is not None
    for handle in (crossing, *crossing.points):
        with hull.edit("role") as edit:
            edit.set_role(handle, "shared")
        assert crossing.override == "shared"


def test_a_watched_crossing_has_a_limit_and_a_shared_one_has_none(hull: ah.Hull) -> None:
    """Absolute, and stored."""
    crossing = set_role(hull, SHARED, "watched")
    assert crossing.limit is not None
    assert crossing.gap is not None
    assert crossing.gap <= crossing.limit
    set_role(hull, SHARED, "shared")
    left: list[float | None] = [crossing.gap, crossing.limit]
    assert left == [None, None]


@pytest.mark.parametrize(
    ("name", "role", "error", "word"),
    [
        pytest.param(SHARED, "leads", BadInputError, "shared, drives a", id="unknown"),
        pytest.param("WL 3.343 x profile", "watched", PointRoleError, "boundary", id="contact"),
        pytest.param("WL 3.343 x profile", "drives a", PointRoleError, "drives b", id="upward"),
        pytest.param(
            "BTK 3.423 @ adopted 2", "shared", PointRoleError, "crossings", id="no crossing"
        ),
    ],
)
def test_bad_roles(
    hull: ah.Hull, name: str, role: str, error: type[ah.AssocHullError], word: str
) -> None:
    """Each says what may be done instead."""
    assert word in refused(hull, lambda edit: edit.set_role(name, role), error)


def test_a_ring_is_refused_with_its_path(hull: ah.Hull) -> None:
    """The first crossing of a pair is to drive one way and the second the other."""

    def act(edit: Edit) -> None:
        edit.set_role(WATCHED, "drives a")
        edit.set_role(f"{WATCHED} #2", "drives b")

    assert refused(hull, act, RingError).count("->") == 2


def test_a_batch_that_cures_its_own_ring_passes(hull: ah.Hull) -> None:
    """Rings are looked for when the edit ends."""
    with hull.edit("turn", gaps="report") as edit:
        edit.set_role(WATCHED, "drives a")
        edit.set_role(f"{WATCHED} #2", "drives b")
        edit.set_role(f"{WATCHED} #2", "drives a")
    assert hull.verify() == ()


def test_a_point_is_not_moved_and_given_a_role_in_one_edit(hull: ah.Hull) -> None:
    """It would have two values."""

    def act(edit: Edit) -> None:
        edit.move(SHARED, y=2.93)
        edit.set_role(SHARED, "drives b")

    assert "one transaction" in refused(hull, act, BadInputError)


def test_a_driven_curve_follows_from_then_on(hull: ah.Hull) -> None:
    """Shared becomes driven: the driver moves, the other goes along."""
    crossing = hull.points["BTK 1.712 x ST 2"].crossing
    assert crossing is not None
    assert (crossing.role, crossing.a.name) == ("shared", "ST 2")
    set_role(hull, "BTK 1.712 x ST 2", "drives b")
    stand_in = [p for p in crossing.a.defining if p.sort == "adopted"]
    before = crossing.points[1].z
    with hull.edit("move", gaps="report") as edit:
        for point in stand_in:
            edit.delete(point)
        edit.move("ST 2 x WL 1.671", y=hull.points["ST 2 x WL 1.671"].y + 0.02)
    assert crossing.points[1].z != before
    for curve in (crossing.a, crossing.b):
        assert curve.closest(crossing.points[1].position)[2] < 1e-9
