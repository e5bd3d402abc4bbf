"""Associations declared and taken back."""

from __future__ import annotations

from collections import Counter

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.edit.session import Edit
from assoc_hull.errors import BadInputError, RingError, UnknownNameError
from assoc_hull.geometry.splines.segments import evaluate
from tests.independent import lost_meetings, trouble
from tests.net_strategies import fresh, refused


@pytest.fixture
def hull() -> ah.Hull:
    """A net of three families of its own."""
    return fresh(2)


def between(hull: ah.Hull, a: str, b: str) -> list[ah.Crossing]:
    """The crossings of two groups."""
    return [
        each
        for each in hull.crossings.values()
        if {each.a.line.group.name, each.b.line.group.name} == {a, b}
    ]


def test_a_one_way_association_drives_one_way_only(hull: ah.Hull) -> None:
    """Whatever the ranks: every crossing of the pair defines the one group, or neither."""
    with hull.edit("one way", gaps="report") as edit:
        edit.associate("sections", "waterlines", two_way=False)
    roles = {each.role for each in between(hull, "sections", "waterlines")}
    assert roles <= {"drives b", "watched"}
    assert "drives b" in roles
    assert list(trouble(hull, kept=True)) == []
    assert hull.verify() == ()
    assert {finding.kind for finding in hull.check()} <= {"gap"}


def test_the_other_way_goes_up_the_ranks() -> None:
    """Waterlines generate on sections."""
    hull = fresh(11)
    with hull.edit("upward", gaps="report") as edit:
        edit.associate("waterlines", "sections", two_way=False)
    assert {each.role for each in between(hull, "sections", "waterlines")} <= {
        "drives a",
        "watched",
    }
    assert hull.verify() == ()


def test_dissociated_groups_know_nothing_of_one_another(hull: ah.Hull) -> None:
    """No crossings left; their places stay behind as adopted points, the shape with them."""
    before = {line.id: line.curves[0].polyline(12) for line in hull.lines.values()}
    with hull.edit("part") as edit:
        edit.dissociate("waterlines", "buttocks")
    assert between(hull, "waterlines", "buttocks") == []
    for line in hull.lines.values():
        away = max(line.curves[0].closest(place)[2] for place in before[line.id])
        assert away <= 3.0 * hull.state.tolerances.prune
    with hull.edit("move", gaps="report") as edit:
        edit.move("WL 3.343 x ST 3", y=2.95)
    assert edit.report is not None
    curves = {hull.lines[name].curves[0].id for name in ("ST 3", "WL 3.343")}
    assert curves <= set(edit.report.relofted)
    assert list(trouble(hull, kept=True)) == []


def test_associating_again_finds_the_meetings(hull: ah.Hull) -> None:
    """They take the roles of before, none is missing, and the ids are new."""
    roles = Counter(each.role for each in between(hull, "waterlines", "buttocks"))
    old = {each.id for each in between(hull, "waterlines", "buttocks")}
    with hull.edit("part") as edit:
        edit.dissociate("waterlines", "buttocks")
    with hull.edit("join", gaps="report") as edit:
        edit.associate("waterlines", "buttocks")
    new = between(hull, "waterlines", "buttocks")
    assert new
    assert Counter(each.role for each in new) == roles
    assert not old & {each.id for each in new}
    assert list(lost_meetings(hull)) == []
    assert hull.verify() == ()
    hull.undo(2)
    assert {each.id for each in between(hull, "waterlines", "buttocks")} == old


@pytest.mark.parametrize(
    ("pair", "error", "word"),
    [
        pytest.param(("sections", "masts"), UnknownNameError, "masts", id="unknown"),
        pytest.param(("sections", "sections"), BadInputError, "itself", id="with itself"),
    ],
)
def test_bad_associations(
    hull: ah.Hull, pair: tuple[str, str], error: type[ah.AssocHullError], word: str
) -> None:
    """Named in the message."""
    assert word in refused(hull, lambda edit: edit.associate(*pair), error)


@pytest.mark.parametrize("pair", [("sections", "masts"), ("deck", "sections")])
def test_what_is_not_associated_cannot_be_parted(hull: ah.Hull, pair: tuple[str, str]) -> None:
    """The two names are told."""
    assert pair[0] in refused(hull, lambda edit: edit.dissociate(*pair), BadInputError)


def test_a_cycle_of_one_way_associations_is_refused(hull: ah.Hull) -> None:
    """Sections drive waterlines, these buttocks, these sections; the path is told."""

    def cycle(edit: Edit) -> None:
        edit.associate("sections", "waterlines", two_way=False)
        edit.associate("waterlines", "buttocks", two_way=False)
        edit.associate("buttocks", "sections", two_way=False)

    text = refused(hull, cycle, RingError, "report")
    assert "ring" in text
    assert text.count("->") >= 2


def test_a_re_shaped_curve_moves_no_line_that_takes_nothing_from_it() -> None:
    """Sections follow a waterline by the field of its new shape, but not against a one-way link."""
    followed = []
    for two_way in (True, False):
        hull = ah.examples.wigley()
        with hull.edit("links") as edit:
            edit.associate("sections", "waterlines", two_way=two_way)
        spline = hull.lines["WL 2.5"].curves[0].spline
        place = evaluate(spline, np.array([0]), np.array([0.37 * spline.knot[-1]]))[0]
        place = place + np.array([0.0, 0.004, 0.0])
        with hull.edit("shape") as edit:
            edit.reshape("WL 2.5", [place], span=(20.0, 55.0))
        assert edit.report is not None
        followed.append({key.split(":")[0] for key in edit.report.relofted})
        assert hull.check() == ()
    assert "sections" in followed[0]
    assert "sections" not in followed[1]
