"""Bodies beside the net by edits: put there, moved, renamed, taken away, refused, compared."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TypedDict

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.edit.session import Edit
from assoc_hull.errors import (
    AssocHullError,
    BadInputError,
    NameTakenError,
    UnknownNameError,
    WrongTypeError,
)
from assoc_hull.model.attached_body import AttachedBody
from tests.taken_back import taken_back


class Box(TypedDict):
    """From where to where a box reaches, m."""

    x: tuple[float, float]
    y: tuple[float, float]
    z: tuple[float, float]


HATCH: Box = {"x": (40.0, 52.0), "y": (-3.0, 3.0), "z": (10.0, 11.2)}
WEDGE: list[list[list[float]]] = [
    [[20.0, -2, 10], [20, 2, 10], [20, 0, 12]],
    [[26.0, -2, 10], [26, 2, 10], [26, 0, 10.5]],
]
STEPS = np.arange(40_000)[:, None, None] * np.array([1e-3, 0.0, 0.0])
ASIDE = np.array([0.0, 5.0, 0.0])


@pytest.fixture(scope="module")
def shared() -> ah.Hull:
    """A Wigley hull; every test takes back what it does."""
    return ah.examples.wigley()


@pytest.fixture
def hull(shared: ah.Hull) -> Iterator[ah.Hull]:
    """The same with a hatch."""
    with taken_back(shared) as found:
        with found.edit("hatch") as edit:
            edit.body("hatch 1", "hatches", **HATCH)
        yield found


def test_a_body_is_an_object_of_the_hull(hull: ah.Hull) -> None:
    """Listed, found by its name however that is written; net and hydrostatics are as without."""
    assert list(hull.bodies) == ["hatch 1"]
    assert "Hatch 1" in hull
    found = hull["HATCH 1"]
    assert isinstance(found, AttachedBody)
    assert found.volume == pytest.approx(12.0 * 6.0 * 1.2, rel=1e-12)
    assert str(found) == "hatch 1: hatches, x 40 to 52, y -3 to 3, z 10 to 11.2 m, 86.4 m3"
    assert hull.check() == ()
    assert hull.verify() == ()


def test_undo_and_removal_give_the_hull_of_before_to_the_bit(shared: ah.Hull) -> None:
    """And redo the one with it; the order in which two are made plays no part."""
    before, prints = shared.fingerprint, set()
    for order in (["hatch 1", "house"], ["house", "hatch 1"]):
        with taken_back(shared):
            for name in order:
                with shared.edit(name) as edit:
                    edit.body(name, "blocks", **HATCH)
            prints.add(shared.fingerprint)
            shared.undo(2)
            assert shared.fingerprint == before
            shared.redo(2)
            prints.add(shared.fingerprint)
            with shared.edit("away") as edit:
                for name in order:
                    edit.remove_body(name)
            assert shared.fingerprint == before
    assert len(prints) == 1
    assert before not in prints


def test_a_body_is_moved_stretched_and_given_another_shape(hull: ah.Hull) -> None:
    """What is not given stays; a box keeps the very numbers that are asked for."""
    with hull.edit("forward and up") as edit:
        edit.set_body("Hatch 1", by=(2.0, 0.0, 0.1))
    assert hull.bodies["hatch 1"].points[:, 0].tolist() == [[42.0, -3.0, 10.1], [54.0, -3.0, 10.1]]
    with hull.edit("longer") as edit:
        edit.set_body("hatch 1", x=(41.3, 55.7), group="covers")
        edit.rename("hatch 1", "hatch A")
    found = hull.bodies["hatch A"]
    assert (found.points[0, 0, 0], found.points[1, 0, 0], found.group) == (41.3, 55.7, "covers")
    assert "hatch 1" not in hull
    with hull.edit("a wedge on both sides") as edit:
        edit.set_body("hatch A", sections=np.array(WEDGE) + ASIDE, both=True, corners=[2])
    found = hull.bodies["hatch A"]
    assert (found.corners, found.both) == ((2,), True)
    assert found.volume == pytest.approx(2 * 6.0 * 0.5 * (4.0 + 1.0), rel=1e-12)


def test_setting_what_is_there_is_no_step(hull: ah.Hull) -> None:
    """Of a body and of a tunnel, and a name that it has."""
    with hull.edit("thruster") as edit:
        edit.tunnel("thruster", x=88.0, z=3.0, radius=0.8)
    before, steps = hull.fingerprint, len(hull.history)
    asked: list[Callable[[Edit], object]] = [
        lambda edit: edit.set_body("hatch 1", **HATCH),
        lambda edit: edit.set_body("hatch 1", by=(0.0, 0.0, 0.0)),
        lambda edit: edit.set_body("hatch 1", group="hatches", both=False, sign=1),
        lambda edit: edit.rename("hatch 1", "hatch 1"),
        lambda edit: edit.set_tunnel("thruster", x=88.0, radius=0.8),
    ]
    for each in asked:
        with hull.edit("the same") as edit:
            each(edit)
        assert (hull.fingerprint, len(hull.history)) == (before, steps)


@pytest.mark.parametrize(
    ("asked", "told"),
    [
        ({}, r"'b' has no shape.*x, y and z, or sections"),
        ({"x": (1.0, 2.0), "y": (0.0, 1.0)}, "has no shape"),
        ({**HATCH, "x": (52.0, 40.0)}, r"x is \(52.0, 40.0\).*\(lower, upper\)"),
        ({**HATCH, "z": (10.0, float("nan"))}, "two finite numbers"),
        ({**HATCH, "sections": WEDGE}, "both sections and x, y, z are given"),
        ({"sections": WEDGE[::-1]}, "lies at x 20 m, behind 26 m.*from aft forward"),
        ({"sections": WEDGE[:1]}, "two or more from aft forward"),
        ({"sections": "no"}, "sections are 'no'"),
        ({"sections": [[[0, 0, 0]] * 3, [[1, 0, 0]] * 3]}, "'b' encloses 0 m3"),
        ({"sections": [[[0, 0, float("inf")]] * 3, [[1, 0, 0]] * 3]}, "not finite"),
        ({"sections": np.zeros((2, 1001, 3))}, "1001 points each.*at most 1000"),
        ({"sections": np.tile(WEDGE[0], (40_000, 1, 1)) + STEPS}, "120000 points.*at most 100000"),
        ({**HATCH, "both": True}, "its mirror image is in it"),
        ({**HATCH, "both": "maybe"}, "both"),
        ({**HATCH, "sign": 2}, "sign is 2.*1 for what stands"),
        ({**HATCH, "sign": "no"}, "sign"),
        ({**HATCH, "corners": [4]}, r"corners are \[4\].*0 to 3"),
        ({**HATCH, "corners": [0.5]}, "corners are"),
        ({**HATCH, "corners": "no"}, "corners is 'no'"),
    ],
)
def test_what_cannot_be_is_refused(hull: ah.Hull, asked: dict[str, object], told: str) -> None:
    """With what is wrong and what to do; the hull is unchanged."""
    before, steps = hull.fingerprint, len(hull.history)
    with pytest.raises(AssocHullError, match=f"(?s){told}"), hull.edit("no") as edit:
        edit.body("b", "boxes", **asked)  # type: ignore[arg-type]
    assert (hull.fingerprint, len(hull.history)) == (before, steps)


def test_no_two_things_have_one_name(hull: ah.Hull) -> None:
    """Lines, groups, points, tunnels and bodies share theirs, however they are written."""
    for name in ("WL 2.5", "sections", "HATCH 1"):
        with pytest.raises(NameTakenError), hull.edit("taken") as edit:
            edit.body(name, "boxes", **HATCH)
    acts: list[Callable[[Edit], object]] = [
        lambda edit: edit.tunnel("hatch 1", x=20.0, z=3.0, radius=0.5),
        lambda edit: edit.add_line("sections", 51.0, "hatch 1"),
        lambda edit: edit.rename("ST 5", "hatch 1"),
        lambda edit: edit.group("hatch 1", ["ST 5"]),
        lambda edit: edit.rename("ST 5 x WL 2.5", "hatch 1"),
        lambda edit: edit.rename("hatch 1", "sections"),
    ]
    for act in acts:
        with pytest.raises(NameTakenError), hull.edit("taken") as edit:
            act(edit)


def test_what_is_not_there_is_refused_with_the_names_there_are(hull: ah.Hull) -> None:
    """To set and to remove; a tunnel is no body, and a body no line and no tunnel."""
    acts: list[Callable[[Edit], object]] = [
        lambda edit: edit.set_body("hatch 2", by=(1.0, 0.0, 0.0)),
        lambda edit: edit.remove_body("hatch 2"),
    ]
    for act in acts:
        with pytest.raises(UnknownNameError, match="hatch 1"), hull.edit("no") as edit:
            act(edit)
    with pytest.raises(UnknownNameError, match="tunnel"), hull.edit("no") as edit:
        edit.remove_tunnel("hatch 1")
    with pytest.raises(BadInputError, match="nothing is given"), hull.edit("no") as edit:
        edit.set_body("hatch 1")
    with pytest.raises(BadInputError, match="both by and a new place"), hull.edit("no") as edit:
        edit.set_body("hatch 1", by=(1.0, 0.0, 0.0), x=(1.0, 2.0))
    with pytest.raises(WrongTypeError, match=r"is a body.*remove_body"), hull.edit("no") as edit:
        edit.remove_line("hatch 1")


def test_files_and_replay_keep_bodies_with_their_history(tmp_path: Path) -> None:
    """Opened again it has the fingerprint and undoes to the hull without; a script makes it."""
    path, ship = tmp_path / "ship.hull", ah.examples.wigley()
    bare = ship.fingerprint
    ship.save(path)
    with ship.edit("hatch") as edit:
        edit.body("hatch 1", "hatches", sections=WEDGE, corners=[0, 1])
    with ship.edit("hatch") as edit:
        edit.set_body("hatch 1", by=[1, 0, 0])
    held = ship.fingerprint
    other = ah.examples.wigley()
    other.replay(ship)
    assert other.fingerprint == held
    ship.close()
    again = ah.open(path)
    assert again.fingerprint == held
    assert again.verify() == ()
    again.undo(2)
    assert (again.fingerprint, dict(again.bodies)) == (bare, {})
    again.redo(2)
    assert again.fingerprint == held
    again.close()
    other.apply("away", [{"op": "remove_body", "name": "hatch 1"}])
    assert other.fingerprint == bare
    told = json.loads(json.dumps([{"op": "body", "name": "b", "group": "g", "sections": WEDGE}]))
    assert other.preview(told).lines == ()


def test_a_comparison_tells_of_bodies_and_tunnels(hull: ah.Hull) -> None:
    """What came, what went, what has another name or place; counts stand among the numbers."""
    with hull.edit("more") as edit:
        edit.body("house", "deck houses", x=(10, 20), y=(-4, 4), z=(10, 14))
        edit.body("mast", "masts", x=(30, 31), y=(-0.5, 0.5), z=(10, 24))
        edit.tunnel("thruster", x=88.0, z=3.0, radius=0.8)
    hull.checkpoint("with")
    with hull.edit("less") as edit:
        edit.rename("mast", "fore mast")
        edit.set_body("hatch 1", by=(1.0, 0.0, 0.0))
        edit.remove_body("house")
        edit.set_tunnel("thruster", x=87.0)
        edit.body("skeg", "skegs", x=(1, 3), y=(-0.2, 0.2), z=(0.5, 1))
    found = hull.diff("with")
    assert [(each.kind, each.name, each.what) for each in found.beside] == [
        ("tunnel", "thruster", "changed"), ("body", "mast -> fore mast", "renamed"),
        ("body", "hatch 1", "changed"), ("body", "skeg", "added"), ("body", "house", "removed"),
    ]  # fmt: skip
    assert "bodies" not in found.numbers
    assert "the tunnel thruster: changed: 1.6 m across at x 88, z 3 m -> " in str(found)
    assert "0 lines differ" in str(found)
    with pytest.raises(WrongTypeError, match=r"ah.variation.compare\(hull, other\)"):
        hull.diff(hull)  # type: ignore[arg-type]


def test_a_variation_carries_bodies(hull: ah.Hull) -> None:
    """Length by a tenth moves a hatch by a tenth of its place; in place alike, and undone."""
    longer = hull.vary(set={"length": 110.0})
    np.testing.assert_allclose(
        longer.hull.bodies["hatch 1"].points[:, 0, 0], [44.0, 57.2], atol=1e-9
    )
    assert any("went along: hatch 1" in each for each in longer.report.edit.notes)
    before = hull.fingerprint
    hull.vary(set={"length": 110.0}, in_place=True)
    assert hull.bodies["hatch 1"] == longer.hull.bodies["hatch 1"]
    hull.undo()
    assert hull.fingerprint == before


BOW_TIE = [[[x, -2.0, 10.0], [x, 2.0, 12.0], [x, 2.0, 10.0], [x, -1.0, 12.0]] for x in (20.0, 26.0)]


def test_a_section_that_crosses_itself_is_refused(hull: ah.Hull) -> None:
    """Which section, which sides, and where; nothing is put there."""
    with (
        pytest.raises(BadInputError, match=r"section 1 of 'fin' crosses itself: .* near \(20, "),
        hull.edit("fin") as edit,
    ):
        edit.body("fin", "fins", sections=BOW_TIE)
    assert "fin" not in hull.bodies


def test_a_body_as_thin_as_nothing_is_refused(hull: ah.Hull) -> None:
    """A plate of a nanometre would break the mesh of the whole ship; a millimetre is a plate."""
    with pytest.raises(BadInputError, match="is 1e-06 mm thick"), hull.edit("plate") as edit:
        edit.body("plate", "plates", x=(40.0, 42.0), y=(-1.0, 1.0), z=(12.0, 12.0 + 1e-9))
    with hull.edit("plate") as edit:
        edit.body("plate", "plates", x=(40.0, 42.0), y=(-1.0, 1.0), z=(12.0, 12.001))
    assert "plate" in hull.bodies
