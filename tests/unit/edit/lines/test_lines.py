"""Lines that come and go: no change of shape, and what was placed stays."""

from __future__ import annotations

import math

import pytest

import assoc_hull as ah
from assoc_hull.edit.session import Edit
from assoc_hull.errors import BadInputError, NameTakenError, NoMeetingError, UnknownNameError
from tests.independent import lost_meetings, trouble
from tests.net_strategies import fresh, refused


@pytest.fixture
def hull() -> ah.Hull:
    """A net of three families of its own."""
    return fresh(2)


@pytest.mark.parametrize(
    ("group", "position"),
    [
        pytest.param("waterlines", 4.1, id="waterline"),
        pytest.param("sections", 39.0, id="section"),
        pytest.param("buttocks", 2.6, id="buttock"),
    ],
)
def test_a_new_line_is_cut_from_the_hull(hull: ah.Hull, group: str, position: float) -> None:
    """It lies in its plane, meets all it should, and moves the others by 0.1 mm at most."""
    before = {line.id: line.curves[0].polyline(12) for line in hull.lines.values()}
    with hull.edit("add") as edit:
        line = edit.add_line(group, position)
    # Sections count stations, waterlines and buttocks metres.
    assert (
        line.name == {"waterlines": "WL 4.1", "sections": "ST 2.515", "buttocks": "BTK 2.6"}[group]
    )
    assert list(trouble(hull)) == []
    assert list(lost_meetings(hull)) == []
    assert hull.verify() == ()
    for other in hull.lines.values():
        if other.id in before:
            away = max(other.curves[0].closest(place)[2] for place in before[other.id])
            assert away <= 4.0 * hull.state.tolerances.keep
    hull.undo()
    assert not line.alive


def test_removing_a_line_leaves_the_shape(hull: ah.Hull) -> None:
    """Its crossings stay behind as adopted points, pruned where they hold nothing."""
    before = {line.id: line.curves[0].polyline(12) for line in hull.lines.values()}
    line = hull.lines["WL 3.343"]
    with hull.edit("remove") as edit:
        edit.remove_line(line)
    assert not line.alive
    for other in hull.lines.values():
        away = max(other.curves[0].closest(place)[2] for place in before[other.id])
        assert away <= 3.0 * hull.state.tolerances.prune
    assert not any(key.startswith("WL 3.343") or "x WL 3.343" in key for key in hull.points)
    assert list(trouble(hull)) == []
    assert {finding.kind for finding in hull.check()} <= {"fold"}


def test_a_line_removed_and_added_again_is_another_line(hull: ah.Hull) -> None:
    """Keys never come back, names may."""
    old = hull.lines["WL 3.343"]
    position = float(hull.state.lines.offset[old.number])
    with hull.edit("remove") as edit:
        edit.remove_line(old)
    with hull.edit("add") as edit:
        new = edit.add_line("waterlines", position, "WL 3.343")
    assert new.id != old.id
    assert not old.alive
    assert hull.lines["WL 3.343"] == new
    hull.undo(2)
    assert old.alive


def test_renaming_keeps_the_identity(hull: ah.Hull) -> None:
    """Keys of points too; addresses follow the name."""
    key = hull.points["WL 3.343 x ST 3"].id
    with hull.edit("rename") as edit:
        edit.rename("WL 3.343", "design")
    assert hull.points["design x ST 3"].id == key
    assert edit.report is not None
    assert edit.report.relofted == ()
    hull.undo()
    assert hull.points["WL 3.343 x ST 3"].id == key


@pytest.mark.parametrize(
    ("act", "error", "word"),
    [
        pytest.param(lambda e: e.add_line("hatches", 1.0), UnknownNameError, "hatches", id="group"),
        pytest.param(
            lambda e: e.add_line("waterlines", 50.0), NoMeetingError, "50", id="above all"
        ),
        pytest.param(lambda e: e.add_line("sections", -9.0), NoMeetingError, "above", id="abaft"),
        pytest.param(lambda e: e.add_line("waterlines", math.nan), BadInputError, "nan", id="nan"),
        pytest.param(lambda e: e.add_line("boundary", 1.0), BadInputError, "boundary", id="space"),
        pytest.param(
            lambda e: e.add_line("waterlines", 4.0, "WL 3.343"),
            NameTakenError,
            "WL 3.343",
            id="name",
        ),
        pytest.param(
            lambda e: e.remove_line("WL 99"), UnknownNameError, "WL 99", id="unknown line"
        ),
        pytest.param(
            lambda e: e.remove_line("ST 1 x WL 9"), UnknownNameError, "WL 9", id="a point"
        ),
        pytest.param(
            lambda e: e.rename("WL 3.343", "WL 5.014"), NameTakenError, "WL 5.014", id="taken"
        ),
    ],
)
def test_bad_lines(hull: ah.Hull, act: object, error: type[ah.AssocHullError], word: str) -> None:
    """Each names what is wrong, and where a line could lie."""
    assert callable(act)
    assert word in refused(hull, act, error)


def test_a_plane_that_is_taken(hull: ah.Hull) -> None:
    """Two lines of one group in one plane."""
    position = float(hull.state.lines.offset[hull.lines["WL 3.343"].number])
    text = refused(hull, lambda edit: edit.add_line("waterlines", position), BadInputError)
    assert "already" in text


def test_lines_and_points_in_one_edit(hull: ah.Hull) -> None:
    """A new line may be refined before the edit ends; all of it is one step."""
    before = hull.fingerprint

    def act(edit: Edit) -> None:
        line = edit.add_line("waterlines", 4.1)
        edit.rename(line, "new")
        edit.remove_line("BTK 1.712")

    with hull.edit("all") as edit:
        act(edit)
    assert "new" in hull.lines
    assert "BTK 1.712" not in hull.lines
    assert list(trouble(hull)) == []
    hull.undo()
    assert hull.fingerprint == before


def test_every_line_can_go_but_the_last(hull: ah.Hull) -> None:
    """In any number of edits."""
    names = [line.name for line in hull.lines.values() if line.group.family != "boundary"]
    for name in names:
        with hull.edit("remove", gaps="report") as edit:
            edit.remove_line(name)
        assert list(trouble(hull, kept=True)) == []
    assert len(hull.lines) == 2
    hull.undo(len(names))
    assert len(hull.lines) == len(names) + 2


def test_a_line_without_a_name_is_called_in_the_measure_of_its_group() -> None:
    """Waterlines in draughts, sections in stations, buttocks in half-breadths: one on a plan."""
    hull = ah.examples.series60(cb=0.70)
    with hull.edit("add") as edit:
        given = [("waterlines", 3.33), ("sections", 33.0), ("sections", 33.0005), ("buttocks", 2.5)]
        names = [edit.add_line(group, place).name for group, place in given]
    assert names == ["WL 0.478", "ST 5.413", "ST 5.4135", "BTK 0.287"]
    plane = hull.lines["WL 0.478"].plane
    assert plane is not None
    assert plane.offset == 3.33
