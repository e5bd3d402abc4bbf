"""Associations that are switched, rulings by regions, and groups of one's own."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

import assoc_hull as ah
from assoc_hull.edit.session import Edit
from assoc_hull.errors import AssocHullError, BadInputError, NameTakenError, PointRoleError
from tests.independent import trouble
from tests.net_strategies import fresh, refused


@pytest.fixture
def hull() -> ah.Hull:
    """Wigley."""
    return ah.examples.wigley()


def shapes(hull: ah.Hull) -> dict[str, bytes]:
    """The splines of all curves."""
    state = hull.state
    found = {}
    for curve in state.live("curves").tolist():
        each = state.spline(curve)
        parts = (each.knot, each.xyz, each.leave, each.arrive)
        found[state.curves.key[curve]] = b"".join(part.tobytes() for part in parts)
    return found


def switch(hull: ah.Hull, a: str, b: str, *, two_way: bool = False) -> None:
    """Associate two groups in an edit of its own."""
    with hull.edit("switch", gaps="report") as edit:
        edit.associate(a, b, two_way=two_way)


def roles(hull: ah.Hull) -> list[tuple[str, str, str]]:
    """The roles of all crossings, by the names of the lines."""
    return sorted((e.a.line.name, e.b.line.name, e.role) for e in hull.crossings.values())


@pytest.mark.parametrize("pair", [("sections", "waterlines"), ("waterlines", "sections")])
@pytest.mark.parametrize("number", [None, 2])
def test_a_switch_moves_no_bit_and_goes_back_to_the_first_fingerprint(
    number: int | None, pair: tuple[str, str]
) -> None:
    """One-way in both directions, and back; parted and joined, the roles are the same."""
    hull = ah.examples.wigley() if number is None else fresh(number)
    first, before = hull.fingerprint, shapes(hull)
    switch(hull, *pair)
    assert shapes(hull) == before
    assert hull.verify() == ()
    found = roles(hull)
    switch(hull, *pair, two_way=True)
    assert hull.fingerprint == first
    hull.undo(2)
    with hull.edit("part") as edit:
        edit.dissociate(*pair)
    assert shapes(hull) == before
    switch(hull, *pair)
    assert (roles(hull), shapes(hull)) == (found, before)
    assert hull.verify() == ()


def test_the_driver_leads_and_the_driven_refuses(hull: ah.Hull) -> None:
    """The sections pass the led waterline; a section names the waterline beside the place."""
    switch(hull, "waterlines", "sections")
    x, y, z = hull.points["WL 2.5 x ST 7"].position
    with hull.edit("lead") as edit:
        edit.lead("WL 2.5", [("WL 2.5 x ST 7", (x, y + 0.005, z))])
    assert abs(hull.points["WL 2.5 x ST 7"].y - y - 0.005) < 1e-9
    assert list(trouble(hull, kept=True)) == []
    assert hull.verify() == ()
    text = refused(hull, lambda e: e.lead("ST 7", [(x, y + 0.1, z + 0.3)]), PointRoleError)
    assert "WL 2.5" in text


def test_waterlines_rule_the_stern(hull: ah.Hull, tmp_path: Path) -> None:
    """On a border the box below holds; files keep it, and an empty statement takes it back."""
    first, before = hull.fingerprint, shapes(hull)
    with hull.edit("rule") as edit:
        edit.rule(
            "waterlines", "sections",
            [("waterlines", {"x": (None, 40.0)}), ("sections", {"x": (40.0, None)})],
        )  # fmt: skip
    assert shapes(hull) == before
    assert hull.crossings["WL 2.5 x ST 8"].role == "drives a"
    assert hull.crossings["WL 2.5 x ST 9"].role == "drives b"
    hull.save(tmp_path / "ship.hull")
    again = ah.open(tmp_path / "ship.hull")
    assert again.fingerprint == hull.fingerprint
    assert again.verify() == ()
    assert again.check() == ()
    with hull.edit("take back") as edit:
        edit.rule("waterlines", "sections", [])
    assert hull.fingerprint == first


def test_a_group_of_ones_own_holds_lines_and_groups(hull: ah.Hull, tmp_path: Path) -> None:
    """It is listed, kept in files, rules, and is left by a line that is removed."""
    with hull.edit("groups") as edit:
        edit.group("stern lines", ["ST 1", "ST 2"])
        edit.group("aft", ["stern lines", "ST 3"])
        edit.rule("aft", "waterlines", [("aft", {})])
    assert list(hull.groups["aft"].lines) == ["ST 1", "ST 2", "ST 3"]
    assert hull.lines["ST 1"].container.name == "sections"
    assert [each.name for each in hull.lines["ST 1"].holders] == ["stern lines"]
    assert hull.crossings["WL 2.5 x ST 3"].role == "drives b"
    hull.save(tmp_path / "ship.hull")
    again = ah.open(tmp_path / "ship.hull")
    assert again.fingerprint == hull.fingerprint
    with again.edit("less") as edit:
        edit.remove_line("ST 2")
    assert [each.name for each in again.groups["stern lines"].members] == ["ST 1"]
    again.undo()
    assert again.fingerprint == hull.fingerprint


@pytest.mark.parametrize(
    ("act", "error", "word"),
    [
        (lambda e: e.regroup("inner", ["outer"]), BadInputError, "inner -> outer -> inner"),
        (lambda e: e.group("Outer", ["ST 1"]), NameTakenError, "Outer"),
        (lambda e: e.group("", ["ST 1"]), BadInputError, "''"),
        (lambda e: e.group("empty", []), BadInputError, "nothing"),
        (lambda e: e.ungroup("sections"), BadInputError, "family"),
        (lambda e: e.associate("outer", "waterlines"), BadInputError, "edit.rule"),
        (lambda e: e.rule("outer", "sections", []), BadInputError, "of both"),
        (lambda e: e.rule("waterlines", "sections", [("outer", {})]), BadInputError, "neither"),
    ],
)  # fmt: skip
def test_bad_groups_and_rulings(
    hull: ah.Hull, act: Callable[[Edit], object], error: type[AssocHullError], word: str
) -> None:
    """What is wrong is named."""
    with hull.edit("groups") as edit:
        edit.group("inner", ["ST 1"])
        edit.group("outer", ["inner"])
    assert word in refused(hull, act, error)


def test_no_line_takes_the_name_of_a_group_of_ones_own(hull: ah.Hull) -> None:
    """Neither a new one nor a renamed one, in any spelling: the name would mean two things."""
    with hull.edit("group") as edit:
        edit.group("fore", ["ST 15", "ST 16"])
    first = hull.fingerprint
    changes: tuple[Callable[[Edit], object], ...] = (
        lambda edit: edit.add_line("waterlines", 3.33, "fore"),
        lambda edit: edit.add_line("waterlines", 3.33, "FORE"),
        lambda edit: edit.rename("ST 15", "fore"),
    )
    for change in changes:
        with pytest.raises(NameTakenError, match=r"a group.* named"), hull.edit("no") as edit:
            change(edit)
    with (
        pytest.raises(BadInputError, match="'ST 15' is named twice"),
        hull.edit("twice") as edit,
    ):
        edit.group("aft", ["ST 15", "ST 15"])
    assert hull.fingerprint == first
