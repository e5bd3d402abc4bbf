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
    """It keeps what it was switched to, until a statement of its pair finds it elsewhere.

    Meanwhile `check` tells of it.
    """
    x, y, z = hull.points[POINT].position
    with hull.edit("rule") as edit:
        edit.rule("waterlines", "sections", [("waterlines", {"y": (None, y + 1e-4)})])
    assert hull.crossings[POINT].role == "drives a"
    with hull.edit("lead") as edit:
        edit.lead("WL 2.5", [(POINT, (x, y + 0.02, z))])
    assert hull.crossings[POINT].role == "drives a"
    (found,) = hull.check()
    assert (found.kind, found.object) == ("ruling", POINT)
    assert "as where one line rules, and lies where none does" in found.message
    with hull.edit("say it again") as edit:
        edit.rule("waterlines", "sections", [("waterlines", {"y": (None, y + 1e-4)})])
    assert hull.crossings[POINT].role == "shared"
    assert hull.check() == ()
    hull.undo()
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


@pytest.mark.parametrize("part", ["rejoin", "switch back"])
def test_kinds_of_points_outlast_a_switch(hull: ah.Hull, part: str) -> None:
    """Of crossings that are born anew, and set at the stand-in while the other line rules."""
    with hull.edit("kind") as edit:
        edit.set_kind("ST 7 x WL 2.5", "knuckle")
    if part == "switch back":
        with hull.edit("one-way") as edit:
            edit.rule("sections", "waterlines", [("sections", {})])
        place = hull.points[POINT].position
        (stand_in,) = (
            each for each in hull.lines["ST 7"].curves[0].defining if (each.position == place).all()
        )
        with hull.edit("kind") as edit:
            edit.set_kind(stand_in, "tangent", direction=(0.0, 0.3, 1.0))
    before = knots(hull)
    with hull.edit(part) as edit:
        if part == "rejoin":
            edit.dissociate("waterlines", "sections")
            edit.associate("waterlines", "sections")
        else:
            edit.rule("sections", "waterlines", [])
    assert knots(hull) == before
    assert (hull.check(), hull.verify()) == ((), ())
    assert hull.points["ST 7 x WL 2.5"].kind == ("knuckle" if part == "rejoin" else "tangent")


def test_a_ruling_whose_group_has_lost_its_lines_can_be_taken_back(hull: ah.Hull) -> None:
    """As the refusal of `ungroup` says; then the group goes."""
    with hull.edit("groups") as edit:
        edit.group("stern lines", ["ST 1", "ST 2"])
        edit.rule("stern lines", "waterlines", [("stern lines", {})])
    with hull.edit("remove", gaps="report") as edit:
        edit.remove_line("ST 1")
        edit.remove_line("ST 2")
    with pytest.raises(BadInputError, match="take that back before"), hull.edit("too soon") as edit:
        edit.ungroup("stern lines")
    with hull.edit("in order") as edit:
        edit.rule("stern lines", "waterlines", [])
        edit.ungroup("stern lines")
    assert "stern lines" not in hull.groups
    assert (hull.check(), hull.verify()) == ((), ())


@pytest.mark.parametrize("cut", [40.0, 42.0, 1e3])
def test_boxes_go_with_the_hull_where_it_is_carried(hull: ah.Hull, cut: float) -> None:
    """Each crossing stays in its box, also on a border; a part that does not move keeps its cut."""
    with hull.edit("rule") as edit:
        edit.rule("waterlines", "sections", [("waterlines", {"x": (None, cut)})])
    before = {key: each.role for key, each in hull.crossings.items()}
    longer = hull.vary(set={"length": 1.1 * hull.particulars.length}).hull
    assert {key: each.role for key, each in longer.crossings.items()} == before
    assert (longer.check(), longer.verify()) == ((), ())
    with longer.edit("again") as edit:
        edit.rule("waterlines", "sections", [("waterlines", {"x": (None, 1.1 * cut)})])
    assert {key: each.role for key, each in longer.crossings.items()} == before
    with hull.edit("the same") as edit:
        edit.transform(lambda p: p, ["sections"])
    assert edit.report is not None
    assert not edit.report.changed


def test_the_report_says_how_far_a_curve_was_off_that_comes_back_to_its_crossings(
    shipped: Shipped,
) -> None:
    """Edits since have left the giver beside the taker; nothing is said where it lies on it."""
    hull = shipped("plain_ship")
    with hull.edit("one-way") as edit:
        edit.associate("buttocks", "waterlines", two_way=False)
    x, y, z = hull.points["WL 2.7 x ST 2.5"].position
    with hull.edit("lead") as edit:
        edit.lead("ST 2.5", [("WL 2.7 x ST 2.5", (x, y + 0.02, z))])
    with hull.edit("both ways") as edit:
        edit.associate("buttocks", "waterlines")
    assert edit.report is not None
    (note,) = edit.report.notes
    assert "BTK 3 x WL 2.7" in note
    assert "mm beside it, passes through it again" in note
    hull.undo(2)
    with hull.edit("both ways, nothing between") as edit:
        edit.associate("buttocks", "waterlines")
    assert edit.report is not None
    assert edit.report.notes == ()
