"""Ordinary questions have a public call: where a line meets a plane, which points lead."""

from collections.abc import Callable

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.errors import AssocHullError, BadInputError, ForeignPointError, WrongTypeError


@pytest.fixture(scope="module")
def hull() -> ah.Hull:
    """A hull whose half-breadths are those of a formula."""
    return ah.examples.wigley(stations=9, waterlines=5)


def test_a_line_meets_a_plane_where_its_neighbours_would_cross_it(hull: ah.Hull) -> None:
    """At a crossing of the net it is that place; a line in the plane, or beside it, meets none."""
    crossing = hull.points["WL 3.125 x ST 3"]
    met = hull.meet("wl 3.125", x=crossing.x)
    np.testing.assert_allclose(met, [crossing.position], atol=1e-9)
    assert np.array_equal(met, hull.meet(hull.lines["WL 3.125"], ah.Plane.across("x", crossing.x)))
    (curve,) = hull.lines["WL 3.125"].curves
    assert np.array_equal(met, hull.meet(curve, ((1.0, 0.0, 0.0), crossing.x)))
    assert hull.meet("WL 3.125", z=3.125).shape == (0, 3)
    assert hull.meet("WL 3.125", x=-50.0).shape == (0, 3)


@pytest.mark.parametrize("line", ["WL 3.125", "deck edge", "profile"])
def test_a_line_ends_on_a_plane_aft_as_it_does_forward(hull: ah.Hull, line: str) -> None:
    """An end on the plane is a place, whichever end; of a stem along it its two ends count."""
    aft, forward = hull.meet(line, x=0.0), hull.meet(line, x=100.0)
    assert len(aft) == len(forward) == (2 if line == "profile" else 1)
    assert sorted(aft[:, 2]) == sorted(forward[:, 2])


def test_a_touch_is_one_place(hull: ah.Hull) -> None:
    """The waterline at its greatest breadth, a section at its lowest point."""
    np.testing.assert_allclose(hull.meet("WL 6.25", y=5.0), [[50.0, 5.0, 6.25]], atol=1e-9)
    assert hull.meet("ST 4", z=0.0).shape == (1, 3)


@pytest.mark.parametrize(
    ("ask", "error", "word"),
    [
        (lambda hull: hull.meet("WL 3.125"), BadInputError, "no plane is given"),
        (lambda hull: hull.meet("WL 3.125", x=1.0, z=2.0), BadInputError, "several planes"),
        (lambda hull: hull.meet("WL 3.125", x=float("nan")), BadInputError, "nan"),
        (lambda hull: hull.meet("waterlines", x=1.0), WrongTypeError, "a line or a curve"),
        (lambda hull: hull.meet("WL 77", x=1.0), AssocHullError, "WL 77"),
        (lambda hull: hull.meet(ah.examples.wigley()["WL 2.5"], x=1.0), ForeignPointError, "line"),
    ],
    ids=["none", "two", "nan", "group", "unknown", "of another hull"],
)  # fmt: skip
def test_what_cannot_be_asked_is_refused(
    hull: ah.Hull, ask: Callable[[ah.Hull], object], error: type[Exception], word: str
) -> None:
    """In one line that says what to give."""
    with pytest.raises(error, match=word):
        ask(hull)


def test_points_by_role_are_all_points_once(series60_70: ah.Hull) -> None:
    """Driven ones have a driver, shared ones none; the others are what they are called."""
    found = series60_70.points.by_role()
    assert list(found) == ["shared", "driven", "watched", "pinned", "adopted"]
    every = [point.id for points in found.values() for point in points]
    assert sorted(every) == sorted(point.id for point in series60_70.points.values())
    assert all(point.driver is not None for point in found["driven"])
    assert {point.crossing_role for point in found["watched"]} == {"watched"}
    assert all(point.driver is None for point in found["shared"])
    assert {point.sort for point in found["adopted"]} == {"adopted"}


def test_a_pinned_point_is_among_the_pinned() -> None:
    """From the edit that pins it."""
    hull = ah.examples.wigley(stations=9, waterlines=5)
    (first, *_) = hull.points.by_role()["adopted"]
    with hull.edit("pin") as edit:
        edit.pin(first)
    assert [point.id for point in hull.points.by_role()["pinned"]] == [first.id]
