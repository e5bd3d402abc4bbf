"""Names: of lines, points and the hull; what cannot have another says so."""

from __future__ import annotations

from collections.abc import Callable

import pytest

import assoc_hull as ah

POINT = "WL 2.5 x ST 3"


@pytest.fixture
def hull() -> ah.Hull:
    """A small net of its own."""
    return ah.examples.wigley(stations=9, waterlines=6)


def renamed(hull: ah.Hull, thing: object, name: str) -> None:
    """Rename in an edit of its own."""
    with hull.edit("rename") as edit:
        edit.rename(thing, name)


@pytest.mark.parametrize(
    "find",
    [
        pytest.param(lambda hull: "WL 2.5", id="address"),
        pytest.param(lambda hull: hull.lines["WL 2.5"], id="line"),
        pytest.param(lambda hull: hull.lines["WL 2.5"].curves[0], id="its only curve"),
    ],
)
def test_a_line_has_another_name(hull: ah.Hull, find: Callable[[ah.Hull], object]) -> None:
    """Its key stays; undo gives the old name back."""
    before, line = hull.fingerprint, hull.lines["WL 2.5"]
    renamed(hull, find(hull), "low")
    assert hull.lines["low"] == line
    assert hull.points["low x ST 3"].container_curve.line == line
    hull.undo()
    assert hull.fingerprint == before


def test_a_point_has_a_name(hull: ah.Hull) -> None:
    """Both friends of a crossing; it is an address, and outlives saving."""
    point = hull.points[POINT]
    renamed(hull, point, "shoulder")
    assert point.name == "shoulder"
    assert hull.points["shoulder"].id == point.id
    assert point.friend_point is not None
    assert point.friend_point.name == "shoulder"
    assert hull.points[POINT] == point
    renamed(hull, hull.crossings[POINT], "turn")
    assert point.name == "turn"


def test_the_hull_has_another_name(hull: ah.Hull) -> None:
    """In its particulars; undo gives the old one back."""
    before, name = hull.fingerprint, hull.particulars.name
    renamed(hull, hull, "Ship 2")
    assert hull.particulars.name == "Ship 2"
    assert hull.fingerprint != before
    assert hull.verify() == ()
    hull.undo()
    assert (hull.particulars.name, hull.fingerprint) == (name, before)
    hull.redo()
    assert hull.particulars.name == "Ship 2"


@pytest.mark.parametrize(
    ("thing", "name", "error", "remedy"),
    [
        pytest.param("sections", "frames", ah.errors.BadInputError, "rename its lines", id="group"),
        pytest.param(POINT, "WL 2.5", ah.AssocHullError, "another name", id="name of a line"),
        pytest.param(POINT, "a x b", ah.errors.BadInputError, "leave out", id="like an address"),
        pytest.param("nothing", "a", ah.errors.UnknownNameError, "nothing", id="unknown"),
    ],
)
def test_what_keeps_its_name_says_so(
    hull: ah.Hull, thing: str, name: str, error: type[Exception], remedy: str
) -> None:
    """With the remedy; nothing changes."""
    before = hull.fingerprint
    with pytest.raises(error, match=remedy):
        renamed(hull, thing, name)
    assert hull.fingerprint == before


def test_two_points_have_two_names(hull: ah.Hull) -> None:
    """A name is taken once; that of a point is none for a line."""
    renamed(hull, POINT, "shoulder")
    with pytest.raises(ah.AssocHullError, match="another name"):
        renamed(hull, "WL 2.5 x ST 4", "shoulder")
    with pytest.raises(ah.AssocHullError, match="another name"):
        renamed(hull, "WL 2.5", "shoulder")


def test_another_hulls_things_are_refused(hull: ah.Hull) -> None:
    """A handle on, or the whole of, another hull; a crossing in set_role too."""
    other = ah.examples.wigley(stations=9, waterlines=6)
    for thing in (other.lines["WL 2.5"], other.crossings[POINT], other.groups["sections"], other):
        with pytest.raises(ah.AssocHullError):
            renamed(hull, thing, "a")
    with pytest.raises(ah.errors.ForeignPointError), hull.edit("role") as edit:
        edit.set_role(other.crossings[POINT], "watched")


def test_lines_are_associated_by_their_groups(hull: ah.Hull) -> None:
    """The error names the group to say."""
    with pytest.raises(ah.errors.BadInputError, match="say 'waterlines'"), hull.edit("try") as edit:
        edit.associate("WL 2.5", "sections")
    with pytest.raises(ah.errors.BadInputError, match="say 'sections'"), hull.edit("try") as edit:
        edit.dissociate("waterlines", hull.lines["ST 3"])  # type: ignore[arg-type]


def test_a_point_is_no_line(hull: ah.Hull) -> None:
    """To remove the line of a point, name the line."""
    for address in (POINT, "ST 3 [1]"):
        with pytest.raises(ah.errors.UnknownNameError), hull.edit("try") as edit:
            edit.remove_line(address)
