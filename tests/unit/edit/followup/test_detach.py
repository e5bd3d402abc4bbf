"""A line that is edited by hand leaves its definitions, keeps its shape, and can return to them."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.edit.session import Edit
from assoc_hull.model.generated_curves import attached_curves
from assoc_hull.model.tables import HullState, copy_state
from tests.formed import formed

Act = Callable[[Edit, ah.Hull], object]


@pytest.fixture(scope="module")
def made() -> HullState:
    """Give the net, made once."""
    return formed()


@pytest.fixture
def hull(made: HullState) -> ah.Hull:
    """Give a hull of its own for each test."""
    return ah.Hull(copy_state(made))


def moved(edit: Edit, hull: ah.Hull, name: str, **by: float) -> None:
    """Move a point of a section by some metres."""
    point = hull.points[name]
    to = {axis: getattr(point, axis) + by.get(axis, 0.0) for axis in point.free}
    edit.move(point, lead=False, **to)


def off(hull: ah.Hull) -> set[str]:
    """Name the lines that check finds detached."""
    return {each.object for each in hull.check() if each.kind == "detached"}


def shape(hull: ah.Hull, line: str) -> list[bytes]:
    """Give the bits of the splines of a line."""
    state = hull.state
    number = next(i for i in state.live("lines").tolist() if state.lines.name[i] == line)
    return [state.spline(curve).xyz.tobytes() for curve in state.curves_of(number)]


ACTS: dict[str, tuple[Act, set[str]]] = {
    "move": (lambda e, h: moved(e, h, "ST 35 @ adopted 9", y=0.03), {"ST 35"}),
    "insert": (lambda e, h: e.insert("ST 35", (35.0, 7.995, 5.2), lead=False), {"ST 35"}),
    "delete": (lambda e, h: e.delete("ST 35 @ adopted 5"), {"ST 35"}),
    "pin": (lambda e, h: e.pin("ST 35 @ adopted 5"), {"ST 35"}),
    "kind": (lambda e, h: e.set_kind("ST 35 @ adopted 5", "knuckle"), {"ST 35"}),
    "end": (lambda e, h: e.set_end("ST 35", "start", tangent=(0, 1, 0)), {"ST 35"}),
    "role": (lambda e, h: e.set_role("WL 3 x ST 35", "shared"), {"ST 35"}),
    "pull": (lambda e, h: e.pull("WL 3 x ST 35", 0.05), {"ST 35"}),
    "shift": (lambda e, h: e.shift_line("ST 35", 36.0), {"ST 35"}),
    "deck edge": (lambda e, h: moved(e, h, "deck edge @ adopted 10", z=0.1), {"deck edge"}),
    "transform": (
        lambda e, h: e.transform(scale=[1, 1.05, 1], drivers=["sections"]),
        {"deck edge", *(f"ST {x}" for x in range(15, 86, 10))},
    ),
}


@pytest.mark.parametrize("name", ACTS)
def test_what_is_edited_is_detached_and_survives_definitions(hull: ah.Hull, name: str) -> None:
    """A note names it, check lists it, verify holds; definitions leave it alone; undo is exact."""
    act, lines = ACTS[name]
    before = hull.fingerprint
    with hull.edit(name) as edit:
        act(edit, hull)
    assert edit.report is not None
    assert sum("detached from the definitions" in note for note in edit.report.notes) == 1
    assert off(hull) == lines
    assert hull.verify() == ()
    kept = {line: shape(hull, line) for line in lines}
    with hull.edit("fuller") as edit:
        edit.set_form("areas", run_area=0.512)
    assert {line: shape(hull, line) for line in lines} == kept
    assert hull.verify() == ()
    hull.undo(2)
    assert hull.fingerprint == before


RETURN = ["move", "delete", "pin", "kind", "end", "shift", "deck edge"]


@pytest.mark.parametrize("name", RETURN)
def test_a_line_returns_to_its_definitions(hull: ah.Hull, name: str) -> None:
    """It is then as if it had never been edited, where nothing else was changed with it."""
    act, lines = ACTS[name]
    (line,) = lines
    before = shape(hull, line)
    with hull.edit(name) as edit:
        act(edit, hull)
    detached = hull.fingerprint
    with hull.edit("back") as edit:
        edit.reattach(line)
    assert off(hull) == set()
    assert hull.verify() == ()
    assert {each for each in hull.check() if each.kind != "gap"} == set()
    if name != "shift":
        assert shape(hull, line) == before
    with hull.edit("fuller") as edit:
        edit.set_form("areas", run_area=0.512)
    assert (shape(hull, line) != before) == (line != "deck edge")
    hull.undo(2)
    assert hull.fingerprint == detached


def test_points_that_the_definitions_do_not_know_keep_a_line(hull: ah.Hull) -> None:
    """A placed one, a crossing that defines it: both are named."""
    with hull.edit("insert") as edit:
        edit.insert("ST 35", (35.0, 7.995, 5.2), lead=False)
    with pytest.raises(ah.errors.BadInputError, match="ST 35 @ placed 1 was placed there"):
        hull.apply("back", [{"op": "reattach", "line": "ST 35"}])
    with hull.edit("unpin") as edit:
        edit.unpin("ST 35 @ placed 1")
    hull.apply("back", [{"op": "reattach", "line": "ST 35"}])
    assert hull.check() == ()
    hull.apply("role", [{"op": "set_role", "crossing": "WL 3 x ST 35", "role": "shared"}])
    with pytest.raises(ah.errors.BadInputError, match="WL 3 x ST 35 defines the line"):
        hull.apply("back", [{"op": "reattach", "line": "ST 35"}])


def test_a_section_that_was_cut_by_hand_can_be_attached(hull: ah.Hull) -> None:
    """It takes its shape from the definitions, and the waterlines follow it."""
    with hull.edit("one more") as edit:
        edit.add_line("sections", 50.0)
    assert len(attached_curves(hull.state)) == 9
    with hull.edit("attach") as edit:
        edit.reattach("ST 50")
    assert len(attached_curves(hull.state)) == 10
    assert hull.verify() == () == hull.check()
    with hull.edit("slimmer") as edit:
        edit.set_form("areas", full=93.9)
    assert edit.report is not None
    assert {"sections:50.000000/1", "waterlines:3.000000/1"} <= set(edit.report.relofted)
    book = hull.crossings["WL 3 x ST 50"]
    assert book.role == "drives b"
    assert hull.verify() == ()


def test_by_hand_and_by_definition_in_one_edit(hull: ah.Hull) -> None:
    """What is moved keeps its place; all other sections take the new definition."""
    to = hull.points["ST 25 @ adopted 9"].y + 0.02
    with hull.edit("both") as edit:
        moved(edit, hull, "ST 25 @ adopted 9", y=0.02)
        edit.set_form("areas", run_area=0.512)
    assert off(hull) == {"ST 25"}
    assert hull.points["ST 25 @ placed 1"].y == to
    assert "sections:15.000000/1" in edit.report.relofted  # type: ignore[union-attr]
    assert hull.verify() == ()


def test_both_ways_in_one_edit_are_refused(hull: ah.Hull) -> None:
    """A point is moved, and its line returned."""
    with hull.edit("move") as edit:
        moved(edit, hull, "ST 25 @ adopted 9", y=0.02)
    before = hull.fingerprint
    place = hull.points["ST 25 @ placed 1"]
    move = {"op": "move", "point": place.id, "y": place.y + 0.02, "z": place.z}
    back = {"op": "reattach", "line": "ST 25"}
    orders: list[list[dict[str, Any]]] = [[move, back], [back, move]]
    for both in orders:
        with pytest.raises(ah.AssocHullError):
            hull.apply("both", both)
        assert hull.fingerprint == before


def test_lines_without_definitions_cannot_return(hull: ah.Hull) -> None:
    """A waterline that no definition makes; one that is attached is left as it is."""
    with pytest.raises(ah.errors.BadInputError, match="no definition makes WL 3"):
        hull.apply("back", [{"op": "reattach", "line": "WL 3"}])
    hull.apply("back", [{"op": "reattach", "line": "ST 35"}])
    assert not hull.history


def test_a_section_that_is_removed_is_forgotten(hull: ah.Hull) -> None:
    """Neither check nor a definition speaks of it, and undo brings it back."""
    before = hull.fingerprint
    with hull.edit("remove") as edit:
        edit.remove_line("ST 35")
    assert len(hull.state.generated) == 8
    assert hull.check() == () == hull.verify()
    hull.undo()
    assert hull.fingerprint == before


def test_many_lines_are_one_finding(made: HullState) -> None:
    """More than ten are told at once, with their number."""
    hull = ah.Hull(formed(tuple(np.linspace(15.0, 85.0, 12).tolist())))
    with hull.edit("wider") as edit:
        edit.transform(scale=[1, 1.05, 1], drivers=["sections"])
    (found,) = [each for each in hull.check() if each.kind == "detached"]
    assert found.amount == 13.0
    assert "12 other lines" in found.message
