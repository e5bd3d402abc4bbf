"""Places and the planes of the lines they are given for: one rule for all modifications."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

import assoc_hull as ah
from assoc_hull.tolerance import IN_PLANE

Give = Callable[[Any, float], object]

WAYS = pytest.mark.parametrize(
    "give",
    [
        pytest.param(lambda edit, z: edit.insert("WL 2.5", (40.0, 2.6, z)), id="insert"),
        pytest.param(
            lambda edit, z: edit.reshape("WL 2.5", [(40.0, 2.99, z)], span=(30.0, 60.0)),
            id="reshape",
        ),
    ],
)


@pytest.fixture
def hull() -> ah.Hull:
    """A small net of its own."""
    return ah.examples.wigley(stations=9, waterlines=6)


@WAYS
def test_a_place_near_the_plane_is_put_into_it(hull: ah.Hull, give: Give) -> None:
    """What is nearer than `IN_PLANE` is meant to lie there: exactly there it is put."""
    with hull.edit("near") as edit:
        give(edit, 2.5 + 0.5 * IN_PLANE)
    placed = [point for point in hull.lines["WL 2.5"].points if point.sort == "placed"]
    assert [point.z for point in placed] == [2.5]
    assert hull.check() == ()


@WAYS
def test_a_place_off_the_plane_is_refused(hull: ah.Hull, give: Give) -> None:
    """With the distance, the line and the remedy."""
    before = hull.fingerprint
    with (
        pytest.raises(ah.errors.BadInputError, match=r"off the plane of WL 2\.5.*give a place in"),
        hull.edit("off") as edit,
    ):
        give(edit, 2.5 + 2.0 * IN_PLANE)
    assert hull.fingerprint == before


def test_a_place_near_an_inclined_plane_is_put_into_it(hull: ah.Hull) -> None:
    """Along the plane's normal, as exactly as rounding allows."""
    with hull.edit("diagonal") as edit:
        edit.add_line("diagonals", (3.0, 30.0))
    line = hull.lines["DIA 3 30"]
    assert line.plane is not None
    curve = line.curves[0]
    place = curve.at(0.31 * curve.span) + 0.5 * IN_PLANE * line.plane.normal
    with hull.edit("near") as edit:
        point = edit.insert(curve, place)
    assert abs(float(line.plane.height(point.position))) < 1e-12
    assert hull.check() == ()


def test_a_placed_point_of_a_diagonal_moves_in_its_plane(hull: ah.Hull) -> None:
    """Two coordinates are given, the third follows."""
    with hull.edit("diagonal") as edit:
        edit.add_line("diagonals", (3.0, 30.0))
    line = hull.lines["DIA 3 30"]
    assert line.plane is not None
    curve = line.curves[0]
    with hull.edit("insert") as edit:
        point = edit.insert(curve, curve.at(0.31 * curve.span))
    assert point.free == ("x", "y")
    x, y = point.x + 0.1, point.y + 0.002
    with hull.edit("move") as edit:
        edit.move(point, x=x, y=y)
    assert (point.x, point.y) == (x, y)
    assert abs(float(line.plane.height(point.position))) < 1e-12
