"""The transaction: one step or nothing."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

import assoc_hull as ah
from assoc_hull.edit.session import Edit
from assoc_hull.errors import BadInputError, PointRoleError, RefusedEditError
from tests.net_strategies import fresh, refused

ONE, OTHER = "WL 3.343 x ST 3", "WL 5.014 x ST 4"


@pytest.fixture
def hull() -> ah.Hull:
    """A net of three families of its own."""
    return fresh(2)


def up(edit: Edit, hull: ah.Hull, name: str = ONE, by: float = 0.004) -> None:
    """Move a crossing a little."""
    edit.move(name, y=hull.points[name].y + by)


def test_modifications_read_the_state_before_the_edit(hull: ah.Hull) -> None:
    """Nothing moves until the block ends; then all at once, in one step."""
    before = hull.points[ONE].y
    with hull.edit("two") as edit:
        up(edit, hull)
        assert hull.points[ONE].y == before
        up(edit, hull, OTHER)
    assert hull.points[ONE].y == before + 0.004
    assert [report.name for report in hull.history] == ["two"]


def test_the_order_of_modifications_says_nothing(hull: ah.Hull) -> None:
    """Where they touch different points, fields and points included."""
    other = fresh(2)
    acts: list[Callable[[Any, ah.Hull], object]] = [
        lambda edit, on: up(edit, on),
        lambda edit, on: up(edit, on, OTHER),
        lambda edit, on: edit.set_role("BTK 3.423 x ST 3", "drives b"),
        lambda edit, on: edit.set_end("ST 1", "finish", tangent=(0.0, 0.2, 1.0)),
        lambda edit, on: edit.insert("WL 1.671", on.lines["WL 1.671"].curves[0].at(33.0)),
    ]
    for on, order in ((hull, acts), (other, acts[::-1])):
        with on.edit("all") as edit:
            for act in order:
                act(edit, on)
    assert hull.fingerprint == other.fingerprint


def test_nested_edits_join_into_one_step(hull: ah.Hull) -> None:
    """Under the name of the outer one."""
    with hull.edit("outer") as outer:
        with hull.edit("inner") as inner:
            up(inner, hull)
        assert not len(hull.history)
        up(outer, hull, OTHER)
    names: list[str] = [step.name for step in hull.document.history]
    assert names == ["outer"]


def test_a_new_edit_leaves_what_was_undone_on_a_branch(hull: ah.Hull) -> None:
    """There is nothing to redo after it, but a name leads there; a refused one changes nothing."""
    with hull.edit("first") as edit:
        up(edit, hull)
    hull.undo()
    refused(hull, lambda edit: edit.move(ONE, y=-40.0), RefusedEditError)
    assert len(hull.undone) == 1
    with hull.edit("second") as edit:
        up(edit, hull, OTHER)
    assert len(hull.undone) == 0
    with pytest.raises(BadInputError, match="nothing to redo"):
        hull.redo()
    hull.go("branch 1")
    assert [report.name for report in hull.history] == ["first"]


def test_an_empty_edit_is_a_step_that_changes_nothing(hull: ah.Hull) -> None:
    """Its report says so."""
    before = hull.fingerprint
    with hull.edit("nothing") as edit:
        pass
    assert edit.report is not None
    assert (edit.report.relofted, hull.fingerprint) == ((), before)


def use_after(hull: ah.Hull) -> None:
    """Use an edit that has ended."""
    with hull.edit("over") as edit:
        up(edit, hull)
    edit.insert("WL 1.671", hull.lines["WL 1.671"].curves[0].at(33.0))


def use_before(hull: ah.Hull) -> None:
    """Use an edit that was not entered."""
    hull.edit("early").add_line("waterlines", 4.0)


def enter_again(hull: ah.Hull) -> None:
    """Enter an edit that has ended."""
    with hull.edit("over") as edit:
        up(edit, hull)
    with edit:
        up(edit, hull, OTHER)


def enter_two(hull: ah.Hull) -> None:
    """Open two edits of one hull at a time."""
    one, other = hull.edit("one"), hull.edit("other")
    with one, other:
        up(one, hull)


@pytest.mark.parametrize(
    ("act", "steps"),
    [
        pytest.param(use_after, 1, id="used after its end"),
        pytest.param(use_before, 0, id="used before its beginning"),
        pytest.param(enter_again, 1, id="entered again"),
        pytest.param(enter_two, 0, id="two at a time"),
    ],
)
def test_an_edit_is_used_once_and_alone(hull: ah.Hull, act: object, steps: int) -> None:
    """Anything else is an error, and nothing is written outside a transaction."""
    assert callable(act)
    with pytest.raises(BadInputError):
        act(hull)
    assert len(hull.history) == steps
    assert hull.verify() == ()
    with hull.edit("after") as edit:
        up(edit, hull, OTHER)
    assert len(hull.history) == steps + 1
    assert hull.verify() == ()


def test_no_undo_while_an_edit_is_open(hull: ah.Hull) -> None:
    """It would pull the ground from under it."""
    with hull.edit("first") as edit:
        up(edit, hull)
    after = hull.fingerprint
    with hull.edit("second") as edit:
        with pytest.raises(BadInputError, match="open"):
            hull.undo()
        with pytest.raises(BadInputError, match="open"):
            hull.redo()
    assert hull.fingerprint == after


def test_an_error_in_the_block_leaves_nothing_behind(hull: ah.Hull) -> None:
    """Neither values nor structure asked for before it."""

    def act(edit: Edit) -> None:
        up(edit, hull)
        edit.add_line("waterlines", 4.1)
        edit.remove_line("BTK 1.712")
        edit.move("BTK 3.423 x WL 6.685", x=20.0)

    assert "drive" in refused(hull, act, PointRoleError)


def test_a_refused_edit_names_curve_place_and_number(hull: ah.Hull) -> None:
    """All findings, not the first only."""
    with pytest.raises(RefusedEditError) as caught, hull.edit("too far") as edit:
        edit.move(ONE, y=30.0)
    assert caught.value.edit == "too far"
    assert len(caught.value.findings) >= 2
    assert all("at (" in text and ")" in text for text in caught.value.findings)
    assert "more)" in str(caught.value)


def test_gaps_are_kept_when_asked_and_named_by_the_check() -> None:
    """What refuses an edit by default is a defect of the hull then."""
    hull = fresh(10)

    def act(edit: Edit) -> None:
        up(edit, hull, "WL 3.234 x ST 1", 0.1)

    text = refused(hull, act, RefusedEditError)
    assert "BTK 7.293 x WL 2.156 #2: the two curves pass" in text
    assert "over the limit of 10.0 mm" in text
    with hull.edit("keep", gaps="report") as edit:
        act(edit)
    found = [finding for finding in hull.check() if finding.kind == "gap"]
    assert [finding.object for finding in found] == ["BTK 7.293 x WL 2.156 #2"]
    assert edit.report is not None
    assert found[0].amount == edit.report.largest_gap > 0.010


def test_a_preview_of_a_refused_edit_is_refused(hull: ah.Hull) -> None:
    """It tells the same reasons, and nothing is published."""
    before = hull.fingerprint
    found = hull.preview([{"op": "move", "point": ONE, "y": 30.0}])
    with pytest.raises(ah.errors.RefusedEditError) as caught, hull.edit("far") as edit:
        edit.move(ONE, y=30.0)
    assert found.report is None
    assert found.refused == caught.value.findings
    assert any("folds back on itself" in reason for reason in found.refused)
    assert any("passes in the sense of this crossing" in reason for reason in found.refused)
    assert (hull.fingerprint, len(hull.history)) == (before, 0)
    with hull.edit("after") as edit:
        up(edit, hull)


def _say_again(hull: ah.Hull) -> dict[str, Callable[[Edit], object]]:
    """Give modifications that ask for what is so."""
    point, line = hull.points[ONE], hull.lines["ST 2"]
    curve, place = line.curves[0], {axis: getattr(point, axis) for axis in point.free}
    link = next(each for each in hull.state.associations if each.a != "boundary")
    return {
        "nothing": lambda edit: None,
        "move": lambda edit: edit.move(point, lead=False, **place),
        "pull": lambda edit: edit.pull(point, 0.0),
        "set_end": lambda edit: edit.set_end(curve, "start"),
        "set_kind": lambda edit: edit.set_kind(point, "smooth"),
        "set_role": lambda edit: edit.set_role(point, None),
        "rename": lambda edit: edit.rename(line, line.name),
        "associate": lambda edit: edit.associate(link.a, link.b, two_way=link.two_way),
        "all": lambda edit: (
            edit.move(point, lead=False, **place),
            edit.set_end(curve, "finish"),
            edit.set_kind(point, "smooth"),
        ),
    }


SAID = ("nothing", "move", "pull", "set_end", "set_kind", "set_role", "rename", "associate", "all")


@pytest.mark.parametrize("name", SAID)
def test_an_edit_that_changes_nothing_adds_no_step(hull: ah.Hull, name: str) -> None:
    """It lofts nothing and says so; what can be undone and made again stays as it is."""
    with hull.edit("first") as edit:
        up(edit, hull)
    with hull.edit("second") as edit:
        edit.set_end(hull.lines["ST 3"].curves[0], "start", tangent=(0.0, 1.0, 0.5))
    hull.undo()
    before = hull.fingerprint, hull.history, hull.undone, dict(hull.state.revision_curve)
    with hull.edit("again") as edit:
        _say_again(hull)[name](edit)
    after = hull.fingerprint, hull.history, hull.undone, dict(hull.state.revision_curve)
    assert after == before
    assert edit.report is not None
    assert (edit.report.changed, edit.report.relofted) == (False, ())
    assert str(edit.report) == "again: nothing changed, no step was added"
    assert "nothing was changed" in edit.report.notes[-1]
    hull.redo()
    hull.undo(2)


def test_what_is_said_again_is_not_done_again(hull: ah.Hull) -> None:
    """Ends and kinds: the second time the same vector, or no direction where one was given."""
    curve, point = hull.lines["ST 3"].curves[0], hull.points[ONE]
    changes: list[Callable[[Edit], object]] = [
        lambda edit: edit.set_end(curve, "start", tangent=(0.0, 1.0, 0.5)),
        lambda edit: edit.set_end(curve, "finish", curvature=(0.0, 0.01, 0.0)),
        lambda edit: edit.set_kind(point, "tangent"),
        lambda edit: edit.set_kind(point, "knuckle"),
    ]
    for change in changes:
        for changed in (True, False):
            with hull.edit("say", gaps="report") as edit:
                change(edit)
            assert edit.report is not None
            assert edit.report.changed is changed
            assert bool(edit.report.relofted) is changed
    assert len(hull.history) == 4


def test_a_preview_of_nothing_says_so(hull: ah.Hull) -> None:
    """No change of volume, no step."""
    found = hull.preview([{"op": "set_end", "curve": "ST 2", "end": "start"}])
    assert found.report is not None
    assert not found.report.changed
    assert (found.volume_change, len(hull.history)) == (0.0, 0)
