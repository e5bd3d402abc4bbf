"""Pinned edits of single points: what they do, and what they refuse."""

from __future__ import annotations

import math

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.edit.session import Edit
from assoc_hull.errors import (
    BadInputError,
    CoincidentPointsError,
    ForeignPointError,
    FreedomError,
    PointRoleError,
    RefusedEditError,
    UnknownNameError,
)
from assoc_hull.model.objects import Curve, Point
from tests.net_strategies import fresh, refused

SHARED = "WL 3.343 x ST 3"
DRIVEN = "BTK 3.423 x WL 6.685"
WATCHED = "BTK 1.712 x WL 3.343"
ADOPTED = "BTK 3.423 @ adopted 3"


@pytest.fixture
def hull() -> ah.Hull:
    """A net of three families of its own."""
    return fresh(2)


def curve_of(hull: ah.Hull, name: str) -> Curve:
    """The one curve of a line."""
    return hull.lines[name].curves[0]


def place_on(hull: ah.Hull, name: str, part: float) -> list[float]:
    """A place on a curve."""
    curve = curve_of(hull, name)
    return [float(value) for value in curve.at(part * curve.span)]


def insert(hull: ah.Hull, name: str = "WL 3.343", part: float = 0.41) -> Point:
    """Insert a point in an edit of its own."""
    with hull.edit("insert") as edit:
        point = edit.insert(name, place_on(hull, name, part))
    return point


def test_a_moved_crossing_is_where_it_was_put_on_both_curves(hull: ah.Hull) -> None:
    """To the last bit; it stays a crossing, and shared."""
    point = hull.points[SHARED]
    with hull.edit("move") as edit:
        edit.move(SHARED, y=2.93)
    friend = point.friend_point
    assert friend is not None
    assert (point.y, friend.y, point.sort, point.crossing_role) == (
        2.93,
        2.93,
        "crossing",
        "shared",
    )
    for curve in (point.container_curve, friend.container_curve):
        assert (curve.spline.xyz == point.position).all(axis=1).any()


def test_all_other_points_keep_their_values(hull: ah.Hull) -> None:
    """Pinned: only what is driven moves along."""
    before = {p.id: p.position for p in hull.points.values()}
    with hull.edit("move") as edit:
        edit.move(SHARED, y=2.93)
    moved = {
        p.id for p in hull.points.values() if p.position.tobytes() != before[p.id].tobytes()
    } - {hull.points[SHARED].id}
    assert all(hull.points[key].crossing_role in ("drives b", "watched") for key in moved)


def test_a_moved_adopted_point_is_placed_from_then_on(hull: ah.Hull) -> None:
    """And no longer moved by an update."""
    point = hull.points[ADOPTED]
    with hull.edit("move") as edit:
        edit.move(point, x=point.x, z=point.z + 0.01)
    assert point.sort == "placed"


def test_an_inserted_point_is_placed_between_its_neighbours(hull: ah.Hull) -> None:
    """Where it was put, on the curve, in order."""
    place = place_on(hull, "WL 3.343", 0.41)
    place[1] += 0.01
    with hull.edit("insert") as edit:
        point = edit.insert("WL 3.343", place)
    assert (point.sort, point.role, point.parent_curve) == ("placed", "defining", None)
    assert point.position.tolist() == place
    xs = [each.x for each in point.container_curve.defining]
    assert xs == sorted(xs)
    assert hull.find("WL 3.343 @ placed 1") == point


def test_a_deleted_point_is_gone(hull: ah.Hull) -> None:
    """Its handle says so; undo brings it back."""
    point = insert(hull)
    with hull.edit("delete") as edit:
        edit.delete(point)
    assert not point.alive
    assert "does not exist" in refused(hull, lambda edit: edit.delete(point), ForeignPointError)
    hull.undo()
    assert point.alive


def test_a_key_is_not_used_again(hull: ah.Hull) -> None:
    """A point inserted where a deleted one was is another point."""
    first = insert(hull)
    with hull.edit("delete") as edit:
        edit.delete(first)
    second = insert(hull)
    assert first.id != second.id
    assert not first.alive


def test_pins(hull: ah.Hull) -> None:
    """Adopted to placed and back; nothing moves."""
    point, before = hull.points[ADOPTED], hull.points[ADOPTED].position.tobytes()
    with hull.edit("pin") as edit:
        edit.pin(point)
    assert point.sort == "placed"
    with hull.edit("unpin") as edit:
        edit.unpin(point)
    assert (point.sort, point.position.tobytes()) == ("adopted", before)
    assert "only placed" in refused(hull, lambda edit: edit.unpin(point), PointRoleError)
    assert "only adopted" in refused(hull, lambda edit: edit.pin(SHARED), PointRoleError)


def test_kinds(hull: ah.Hull) -> None:
    """A knuckle on one curve is none on the other; a tangent keeps the direction it has."""
    point = hull.points[SHARED]
    with hull.edit("knuckle") as edit:
        edit.set_kind(point, "knuckle")
    friend = point.friend_point
    assert friend is not None
    assert (point.kind, friend.kind) == ("knuckle", "smooth")
    curve = friend.container_curve
    knot = int(np.flatnonzero((curve.spline.xyz == friend.position).all(axis=1))[0])
    before = curve.spline.leave[knot]
    with hull.edit("tangent") as edit:
        edit.set_kind(friend, "tangent")
    after = curve.spline.leave[knot]
    assert friend.kind == "tangent"
    assert np.cross(before, after) == pytest.approx(np.zeros(3), abs=1e-12)


def test_a_point_just_inserted_takes_the_direction_of_the_curve_there(hull: ah.Hull) -> None:
    """Also in the same edit, when the published curve does not know it."""
    curve, place = curve_of(hull, "WL 3.343"), place_on(hull, "WL 3.343", 0.41)
    slope = curve.tangent(curve.closest(place)[0])
    with hull.edit("tangent point") as edit:
        point = edit.insert(curve, place)
        edit.set_kind(point, "tangent")
    knot = int(np.flatnonzero((curve.spline.xyz == point.position).all(axis=1))[0])
    found = curve.spline.leave[knot]
    assert found / np.linalg.norm(found) == pytest.approx(slope, abs=1e-9)


@pytest.mark.parametrize(
    ("point", "driver"),
    [pytest.param(DRIVEN, "WL 6.685", id="driven"), pytest.param(WATCHED, None, id="watched")],
)
def test_a_computed_point_names_its_driver_and_three_ways_out(
    hull: ah.Hull, point: str, driver: str | None
) -> None:
    """Moving it would be undone at once."""
    text = refused(hull, lambda edit: edit.move(point, x=20.0), PointRoleError)
    assert ("computed from" in text) == (driver is not None)
    assert driver is None or driver in text
    assert all(way in text for way in ("move the driver", "edit.pull", "edit.set_role"))


@pytest.mark.parametrize(
    ("to", "error", "word"),
    [
        pytest.param({"y": math.nan}, BadInputError, "nan", id="not a number"),
        pytest.param({"y": math.inf}, BadInputError, "inf", id="infinite"),
        pytest.param({"y": "far"}, BadInputError, "far", id="a word"),
        pytest.param({"y": 1e9}, BadInputError, "1e", id="not on earth"),
        pytest.param({"x": 3.0}, FreedomError, "free along y", id="a fixed axis"),
        pytest.param({"x": 3.0, "y": 2.0}, FreedomError, "x", id="one axis too many"),
        pytest.param({}, FreedomError, "free along y", id="nothing"),
    ],
)
def test_bad_moves(
    hull: ah.Hull, to: dict[str, float], error: type[ah.AssocHullError], word: str
) -> None:
    """The free coordinates are named, the number is told."""
    assert word in refused(hull, lambda edit: edit.move(SHARED, lead=False, **to), error)


@pytest.mark.parametrize(
    ("act", "error", "word"),
    [
        pytest.param(lambda e: e.move("WL 9 x ST 3", y=1), UnknownNameError, "WL 9", id="line"),
        pytest.param(lambda e: e.move("WL 3.343", y=1), UnknownNameError, "point", id="a line"),
        pytest.param(lambda e: e.move(7, y=1), BadInputError, "7", id="a number"),
        pytest.param(lambda e: e.insert("ST 33", (1, 2, 3)), UnknownNameError, "ST 3", id="curve"),
        pytest.param(lambda e: e.delete(SHARED), PointRoleError, "remove the line", id="crossing"),
        pytest.param(lambda e: e.delete(DRIVEN), PointRoleError, "association", id="driven"),
        pytest.param(lambda e: e.set_kind(SHARED, "sharp"), BadInputError, "sharp", id="kind"),
        pytest.param(
            lambda e: e.set_kind(SHARED, "tangent", direction=(0, 0, 0)),
            BadInputError,
            "length",
            id="nil",
        ),
        pytest.param(
            lambda e: e.set_kind(WATCHED, "knuckle"), BadInputError, "does not define", id="watched"
        ),
    ],
)
def test_bad_points(hull: ah.Hull, act: object, error: type[ah.AssocHullError], word: str) -> None:
    """Each is an error of the family that names what is wrong."""
    assert callable(act)
    assert word in refused(hull, act, error)


@pytest.mark.parametrize(
    ("place", "word"),
    [
        pytest.param((40.0, 2.9, 3.3), "off the plane", id="off the plane"),
        pytest.param((40.0, 2.9), "WL 3.343", id="two numbers"),
        pytest.param((40.0, math.nan, 3.342), "WL 3.343", id="not a number"),
        pytest.param("there", "WL 3.343", id="a word"),
    ],
)
def test_bad_places(hull: ah.Hull, place: object, word: str) -> None:
    """A point off the curve's plane, and things that are no place."""

    def act(edit: Edit) -> None:
        edit.insert("WL 3.343", place)  # type: ignore[arg-type]

    text = refused(hull, act, BadInputError)
    assert word in text or "place" in text


def test_two_points_at_one_place(hull: ah.Hull) -> None:
    """The place and the distance are told, for an inserted and for a moved point."""
    at = hull.points[SHARED].position
    text = refused(hull, lambda edit: edit.insert("WL 3.343", at), CoincidentPointsError)
    assert "WL 3.343" in text
    assert "46.5234" in text
    first = insert(hull)
    second = insert(hull, part=0.43)
    text = refused(
        hull, lambda edit: edit.move(second, x=first.x, y=first.y + 1e-8), RefusedEditError
    )
    assert "closer than 1e-06" in text


def test_a_fold_is_refused_with_place_and_number(hull: ah.Hull) -> None:
    """A point dragged past its neighbours."""
    point = insert(hull)
    text = refused(
        hull, lambda edit: edit.move(point, x=point.x + 30.0, y=0.3, lead=False), RefusedEditError
    )
    assert "folds back on itself at (" in text
    assert "cosine" in text
    assert "WL 3.343" in text or "waterlines:3.342" in text


def test_an_end_is_not_deleted(hull: ah.Hull) -> None:
    """A curve without its end would be another curve; and it keeps two points at least."""
    text = refused(hull, lambda edit: edit.delete("deck edge @ adopted 1"), PointRoleError)
    assert "an end of its curve" in text


def test_handles_of_another_hull_are_foreign(hull: ah.Hull) -> None:
    """Points, curves and lines alike, even of an equal hull."""
    other = fresh(2)
    for act in (
        lambda edit: edit.move(other.points[SHARED], y=2.9),
        lambda edit: edit.insert(curve_of(other, "WL 3.343"), (40.0, 2.9, 3.343)),
        lambda edit: edit.remove_line(other.lines["ST 3"]),
    ):
        assert "look it up again" in refused(hull, act, ForeignPointError)


def test_one_point_cannot_be_written_twice_in_one_edit(hull: ah.Hull) -> None:
    """Through whichever handle; what was asked for is not the sum of two."""

    def twice(edit: Edit) -> None:
        edit.move(SHARED, y=2.93)
        edit.move("ST 3 x WL 3.343", y=2.94)

    assert "written twice" in refused(hull, twice, BadInputError)
