"""What a switch has changed can be taken back, whatever came between; nothing asked for is lost."""

from collections.abc import Callable

import pytest

import assoc_hull as ah
from assoc_hull.errors import BadInputError, NameTakenError
from tests.conftest import Shipped

POINT = "WL 2.5 x ST 7"


@pytest.fixture
def hull(shipped: Shipped) -> ah.Hull:
    """A Wigley hull of one's own."""
    return shipped("wigley")


def knots(hull: ah.Hull) -> dict[str, bytes]:
    """The bits of all curves."""
    state = hull.state
    splines = {str(state.curves.key[each]): state.spline(each) for each in state.live("curves")}
    return {
        key: b"".join(part.tobytes() for part in (each.knot, each.xyz, each.leave, each.arrive))
        for key, each in splines.items()
    }


def roles(hull: ah.Hull, line: str) -> set[str]:
    """The roles of the crossings of a waterline with inner sections."""
    return {hull.crossings[f"{line} x ST {number}"].role for number in range(2, 19)}


def test_a_crossing_that_an_edit_carries_out_of_its_box_comes_back(hull: ah.Hull) -> None:
    """It keeps what it was switched to, until a statement of its pair finds it elsewhere."""
    x, y, z = hull.points[POINT].position
    with hull.edit("rule") as edit:
        edit.rule("waterlines", "sections", [("waterlines", {"y": (None, y + 1e-4)})])
    assert hull.crossings[POINT].role == "drives a"
    with hull.edit("lead") as edit:
        edit.lead("WL 2.5", [(POINT, (x, y + 0.02, z))])
    assert hull.crossings[POINT].role == "drives a"
    with hull.edit("nothing rules") as edit:
        edit.rule("waterlines", "sections", [])
    assert hull.crossings[POINT].role == "shared"
    assert (hull.check(), hull.verify()) == ((), ())


@pytest.mark.parametrize("how", ["regroup", "ungroup"])
def test_lines_that_leave_a_group_that_rules_are_switched_back(hull: ah.Hull, how: str) -> None:
    """At once, by a group or by one that it holds; and no curve moves by a bit."""
    with hull.edit("groups") as edit:
        edit.group("low", ["WL 2.5"])
        edit.group("ruler", ["low", "WL 5"])
    with hull.edit("rule") as edit:
        edit.rule("ruler", "sections", [("ruler", {})])
    places = knots(hull)
    assert roles(hull, "WL 2.5") == roles(hull, "WL 5") == {"drives a"}
    with hull.edit(how) as edit:
        edit.regroup("ruler", ["WL 5"]) if how == "regroup" else edit.ungroup("low")
    assert roles(hull, "WL 2.5") == {"shared"}
    assert roles(hull, "WL 5") == {"drives a"}
    assert knots(hull) == places
    with hull.edit("back") as edit:
        edit.rule("ruler", "sections", [])
    assert roles(hull, "WL 5") == {"shared"}
    assert (hull.check(), hull.verify()) == ((), ())


def test_a_line_that_joins_a_group_that_rules_rules_too(hull: ah.Hull) -> None:
    """There and back is the first fingerprint."""
    with hull.edit("group") as edit:
        edit.group("ruler", ["WL 5"])
    with hull.edit("rule") as edit:
        edit.rule("ruler", "sections", [("ruler", {})])
    before = hull.fingerprint
    with hull.edit("more") as edit:
        edit.regroup("ruler", ["WL 5", "WL 2.5"])
    assert roles(hull, "WL 2.5") == {"drives a"}
    with hull.edit("less") as edit:
        edit.regroup("ruler", ["WL 5"])
    assert hull.fingerprint == before


@pytest.mark.parametrize("first", ["lead", "move"])
def test_a_point_that_is_led_and_moved_in_one_edit_is_refused(hull: ah.Hull, first: str) -> None:
    """In either order, as the lead would come last and win; to one place both may ask."""
    x, y, z = hull.points[POINT].position
    start = hull.fingerprint

    def both(away: float) -> None:
        with hull.edit("both") as edit:
            acts: dict[str, Callable[[], object]] = {
                "lead": lambda: edit.lead("WL 2.5", [(POINT, (x, y + 0.01, z))]),
                "move": lambda: edit.move(POINT, y=y + away),
            }
            acts.pop(first)()
            acts.popitem()[1]()

    with pytest.raises(BadInputError, match="in two places"):
        both(0.02)
    assert hull.fingerprint == start
    both(0.01)
    assert hull.points[POINT].y == pytest.approx(y + 0.01, abs=1e-9)


def test_no_line_takes_the_name_of_a_group_in_another_case(hull: ah.Hull) -> None:
    """As no group takes that of a line."""
    with hull.edit("names") as edit:
        edit.group("zz", ["ST 1"])
        with pytest.raises(NameTakenError):
            edit.rename("ST 2", "ZZ")
