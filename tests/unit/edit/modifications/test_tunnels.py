"""Tunnels that a hull holds: kept, changed, carried, refused; files, history and names."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import cast

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.edit.session import Edit
from assoc_hull.errors import (
    BadInputError,
    NameTakenError,
    OutOfRangeError,
    RefusedEditError,
    UnknownNameError,
    WrongTypeError,
)
from assoc_hull.model.definition.records import definition
from assoc_hull.model.definition.restore import from_definition
from tests.taken_back import taken_back

BOW = {"x": 88.0, "z": 3.0, "radius": 0.8}


@pytest.fixture(scope="module")
def shared() -> ah.Hull:
    """A Wigley hull; every test takes back what it does."""
    return ah.examples.wigley()


@pytest.fixture
def hull(shared: ah.Hull) -> Iterator[ah.Hull]:
    """The same with a tunnel."""
    with taken_back(shared) as found:
        with found.edit("thruster") as edit:
            edit.tunnel("bow thruster", **BOW)
        yield found


def place(hull: ah.Hull, name: str = "bow thruster") -> tuple[float, float, float]:
    """Give x, z and radius of a tunnel."""
    found = hull.tunnels[name]
    return found.x, found.z, found.radius


def test_a_tunnel_is_an_object_of_the_hull(hull: ah.Hull) -> None:
    """It is listed, found by its name however that is written, and measured as before."""
    assert list(hull.tunnels) == ["bow thruster"]
    assert "Bow Thruster" in hull
    found, measured = hull["bow thruster"], hull.tunnel("t", **BOW)
    assert isinstance(found, ah.hydro.Tunnel)
    assert found.volume == measured.volume
    assert (found.mouth == measured.mouth).all()
    assert hull.check() == ()
    assert hull.verify() == ()


def test_undo_and_removal_give_the_hull_of_before_to_the_bit(shared: ah.Hull) -> None:
    """Fingerprint and numbers; redo gives those with the tunnel."""
    before, bare = shared.fingerprint, shared.hydrostatics(draught=5.0).volume
    with taken_back(shared):
        with shared.edit("thruster") as edit:
            edit.tunnel("bow thruster", **BOW)
        held, less = shared.fingerprint, shared.hydrostatics(draught=5.0).volume
        assert held != before
        assert less < bare
        shared.undo()
        assert (shared.fingerprint, shared.hydrostatics(draught=5.0).volume) == (before, bare)
        shared.redo()
        assert (shared.fingerprint, shared.hydrostatics(draught=5.0).volume) == (held, less)
        with shared.edit("away") as edit:
            edit.remove_tunnel("bow thruster")
        assert (shared.fingerprint, shared.hydrostatics(draught=5.0).volume) == (before, bare)


def test_the_order_in_which_tunnels_are_made_plays_no_part(shared: ah.Hull) -> None:
    """Nor does it whether one edit makes them, or two."""
    prints = set()
    for order in (("fore", "aft"), ("aft", "fore")):
        for together in (True, False):
            with taken_back(shared):
                at = {"fore": 80.0, "aft": 20.0}
                for names in [order] if together else [(each,) for each in order]:
                    with shared.edit("tunnels") as edit:
                        for each in names:
                            edit.tunnel(each, x=at[each], z=3.0, radius=0.5)
                prints.add(shared.fingerprint)
    assert len(prints) == 1


def test_hull_files_and_texts_hold_tunnels_with_their_history(
    hull: ah.Hull, tmp_path: Path
) -> None:
    """Opened again it has the fingerprint, and undoes to the hull without."""
    for name in ("ship.hull", "ship.hull.json"):
        copy = hull.snapshot()
        copy.save(tmp_path / name)
        again = ah.open(tmp_path / name)
        assert (again.fingerprint, place(again)) == (hull.fingerprint, place(hull))
        again.close()
    path = tmp_path / "kept.hull"
    ship = ah.examples.wigley()
    bare = ship.fingerprint
    ship.save(path)
    with ship.edit("thruster") as edit:
        edit.tunnel("bow thruster", **BOW)
    held = ship.fingerprint
    ship.close()
    again = ah.open(path)
    assert again.fingerprint == held
    assert again.verify() == ()
    again.undo()
    assert again.fingerprint == bare
    assert not again.tunnels
    again.redo()
    assert again.fingerprint == held
    again.close()


def test_a_hull_text_with_a_tunnel_twice_is_refused(hull: ah.Hull, tmp_path: Path) -> None:
    """The error names it."""
    path = tmp_path / "ship.hull.json"
    hull.snapshot().save(path)
    told = json.loads(path.read_text("utf-8"))
    told["definition"]["tunnels"] *= 2
    path.write_text(json.dumps(told), "utf-8")
    with pytest.raises(BadInputError, match="'bow thruster' stands there twice"):
        ah.open(path)


def test_the_mouth_follows_an_edit_of_the_shell(hull: ah.Hull) -> None:
    """Axis and radius stay; the mouth lies on the shell as it has become."""
    before = hull.tunnels["bow thruster"]
    with hull.edit("fuller") as edit:
        edit.pull("WL 2.5 x ST 17", d=0.05, radius=(20.0, 4.0))
    after = hull.tunnels["bow thruster"]
    assert place(hull) == (before.x, before.z, before.radius)
    assert after.volume > before.volume
    for x, y, z in after.mouth[::16].tolist():
        assert hull.half_breadth(x, z) == pytest.approx(y, abs=1e-9)


def test_a_variation_carries_the_middle_of_the_axis(hull: ah.Hull) -> None:
    """Length by a tenth: x by a tenth, z and radius stay; undone, all is as it was."""
    longer = hull.vary(set={"length": 110.0}).hull
    assert place(longer) == pytest.approx((96.8, 3.0, 0.8), abs=1e-9)
    before = hull.fingerprint
    hull.vary(set={"draught": 6.875}, in_place=True)
    assert place(hull) == pytest.approx((88.0, 3.3, 0.8), abs=1e-9)
    hull.undo()
    assert hull.fingerprint == before


def test_targets_of_a_variation_are_of_the_moulded_hull_and_that_is_told(hull: ah.Hull) -> None:
    """The tunnel goes with the map that was found, within the small moves at its end."""
    varied = hull.vary(reach={"volume": 2850.0}, free=["length"])
    found = varied.hull.tunnels["bow thruster"]
    length = varied.hull.particulars.length
    assert length > 102.0
    assert found.x == pytest.approx(0.88 * length, abs=2e-3)
    assert any("without its tunnels (bow thruster)" in each for each in varied.report.notes)
    whole = varied.hull.hydrostatics().volume + found.volume
    assert whole == pytest.approx(2850.0, abs=1e-3)
    assert any("'bow thruster' went along" in each for each in varied.report.edit.notes)


def test_a_transformation_carries_it_as_well(hull: ah.Hull) -> None:
    """A scale about the origin and a shift, by a mapping given as numbers."""
    with hull.edit("wider and forward") as edit:
        edit.transform(drivers=["sections", "profile"], scale=[1.0, 1.1, 1.0], shift=[2.0, 0, 0])
    assert place(hull) == pytest.approx((90.0, 3.0, 0.8), abs=1e-12)


def test_it_can_be_given_another_axis_radius_and_name(hull: ah.Hull) -> None:
    """What is not given stays."""
    with hull.edit("aft a little, wider") as edit:
        edit.set_tunnel("Bow thruster", x=87.0, radius=0.9)
        edit.rename("bow thruster", "fore thruster")
    assert place(hull, "fore thruster") == (87.0, 3.0, 0.9)
    assert "bow thruster" not in hull


@pytest.mark.parametrize(
    ("asked", "error", "told"),
    [
        ({"x": 120.0}, OutOfRangeError, "x of 120 m lies outside the ship.*from 0 to 100 m"),
        ({"radius": 0.0}, BadInputError, "radius is 0.0.*above 0"),
        ({"radius": -1.0}, BadInputError, "radius is -1.0.*above 0"),
        ({"x": float("nan")}, BadInputError, "x is nan"),
        ({"z": 0.5, "radius": 1.0}, BadInputError, r"leaves the hull .* m below its profile"),
        ({"z": 12.0, "radius": 1.0}, BadInputError, r"leaves the hull .* m above its deck edge"),
        ({"x": 99.5}, BadInputError, r"leaves the hull .* m ahead of its end"),
        ({"z": 3.4}, BadInputError, "0.4 m apart, and their radii are 1.6 m together"),
    ],
    ids=["outside the ship", "no radius", "below nil", "no number", "through the bottom",
         "through the deck", "through the stem", "meets another"],
)  # fmt: skip
def test_what_cannot_be_is_refused_with_numbers(
    hull: ah.Hull, asked: dict[str, float], error: type[Exception], told: str
) -> None:
    """And the hull is unchanged."""
    before, steps = hull.fingerprint, len(hull.history)
    with pytest.raises(error, match=told), hull.edit("another") as edit:
        edit.tunnel("another", **{"x": 88.0, "z": 3.0, "radius": 0.8, **asked})
    assert (hull.fingerprint, len(hull.history)) == (before, steps)


@pytest.mark.parametrize("name", ["WL 2.5", "wl 2,5", "sections", "BOW thruster"])
def test_no_two_things_have_one_name(hull: ah.Hull, name: str) -> None:
    """Lines, groups and tunnels share theirs, however they are written."""
    with pytest.raises(NameTakenError), hull.edit("taken") as edit:
        edit.tunnel(name, x=20.0, z=3.0, radius=0.5)
    acts: list[Callable[[Edit], object]] = [
        lambda edit: edit.add_line("sections", 51.0, "bow thruster"),
        lambda edit: edit.rename("ST 5", "bow thruster"),
        lambda edit: edit.group("bow thruster", ["ST 5"]),
        lambda edit: edit.rename("ST 5 x WL 2.5", "bow thruster"),
    ]
    for act in acts:
        with pytest.raises(NameTakenError), hull.edit("taken") as edit:
            act(edit)


@pytest.mark.parametrize("ask", [
    lambda edit: edit.remove_line("Bow Thruster"), lambda edit: edit.move("bow thruster", y=1.0),
    lambda edit: edit.group("stern", ["bow thruster"]),
])  # fmt: skip
def test_what_takes_lines_and_points_says_that_it_is_a_tunnel(
    hull: ah.Hull, ask: Callable[[Edit], object]
) -> None:
    """It is there, and the edits that change it are named."""
    before = hull.fingerprint
    with (
        pytest.raises(WrongTypeError, match=r"is a tunnel.*remove_tunnel"),
        hull.edit("no") as edit,
    ):
        ask(edit)
    assert hull.fingerprint == before


def test_an_unknown_tunnel_is_refused_with_the_names_there_are(hull: ah.Hull) -> None:
    """To set, to remove and to look up."""
    acts: list[Callable[[Edit], object]] = [
        lambda edit: edit.set_tunnel("stern thruster", x=3.0),
        lambda edit: edit.remove_tunnel("stern thruster"),
    ]
    for act in acts:
        with pytest.raises(UnknownNameError, match="bow thruster"), hull.edit("no") as edit:
            act(edit)
    with pytest.raises(BadInputError, match="give x, z or radius"), hull.edit("no") as edit:
        edit.set_tunnel("bow thruster")
    with pytest.raises(UnknownNameError):
        hull["stern thruster"]


def test_an_edit_after_which_a_tunnel_leaves_the_hull_is_refused(hull: ah.Hull) -> None:
    """The reason says where, and what to do; a variation is refused so as well."""
    with hull.edit("lower") as edit:
        edit.set_tunnel("bow thruster", z=8.4)
    before = hull.fingerprint
    with (
        pytest.raises(RefusedEditError, match=r"'bow thruster' leaves the hull .* above"),
        hull.edit("sunken") as edit,
    ):
        edit.transform(lambda p: p + _sunk(p), drivers=["sections", "profile"], planes="follow")
    assert hull.fingerprint == before


def _sunk(xyz: np.ndarray) -> np.ndarray:
    """Lower the deck beside the centre plane, where the mouths are and the axis is not."""
    found = np.zeros_like(xyz)
    found[:, 2] = -np.clip(xyz[:, 1], 0.0, 1.0) * np.clip(xyz[:, 2] - 5.0, 0.0, None) * 0.9
    return found


def test_edits_of_tunnels_are_replayed_on_another_hull(hull: ah.Hull) -> None:
    """By their names, as scripts and the command line ask for them."""
    other = ah.examples.wigley()
    made = other.replay(hull)
    assert [str(each) for each in made] == ["thruster: made again"]
    assert place(other) == place(hull)
    other.apply("away", [{"op": "remove_tunnel", "name": "bow thruster"}])
    assert not other.tunnels


def test_a_preview_and_a_comparison_tell_what_a_tunnel_takes(shared: ah.Hull) -> None:
    """No line would change, and the volume is less by that of the tunnel."""
    asked = [{"op": "tunnel", "name": "bow thruster", **BOW}]
    seen = shared.preview(asked)
    less = shared.tunnel("t", **BOW).volume
    assert seen.lines == ()
    assert seen.volume_change == pytest.approx(-less, rel=1e-9)
    assert not shared.tunnels


def test_an_export_of_lines_tells_that_tunnels_are_left_out(hull: ah.Hull, tmp_path: Path) -> None:
    """Once; a hull without any has no such line."""
    for name in ("ship.csv", "ship.dxf"):
        told = [each for each in hull.export(tmp_path / name).left_out if each.kind == "tunnels"]
        assert len(told) == 1
        assert "bow thruster" in str(told[0])
    hull.undo()
    assert "tunnels" not in {each.kind for each in hull.export(tmp_path / "bare.csv").left_out}
    hull.redo()


def test_a_check_finds_tunnels_that_are_wrong_in_a_definition(hull: ah.Hull) -> None:
    """One that leaves the hull, and two that meet; hydrostatics refuse the first."""
    told = definition(hull.state)
    held = cast("list[dict[str, object]]", told["tunnels"])
    held += [
        {"name": "low", "x": 50.0, "z": 0.2, "radius": 0.5},
        {"name": "near", "x": 88.0, "z": 3.2, "radius": 0.3},
    ]
    wrong = ah.Hull(from_definition(told))
    found = [(each.kind, each.object) for each in wrong.check()]
    assert found == [("tunnel", "bow thruster"), ("tunnel", "low")]
    assert "0.3 m below its profile" in str(wrong.check()[1])
    with pytest.raises(BadInputError, match="'low' leaves the hull"):
        wrong.hydrostatics()
    with wrong.edit("mended") as edit:
        edit.remove_tunnel("low")
        edit.remove_tunnel("near")
    assert wrong.fingerprint == hull.fingerprint


def test_quick_edits_and_branches_keep_it(hull: ah.Hull) -> None:
    """After edits by the program it is measured anew; going back to a checkpoint brings it back."""
    for _ in range(5):
        with hull.edit("fuller") as edit:
            edit.move("WL 2.5 x ST 17", by=(0.0, 0.005, 0.0))
    found = hull.tunnels["bow thruster"]
    assert found.volume == hull.tunnel("t", **BOW).volume
    hull.checkpoint("with")
    held = hull.fingerprint
    with hull.edit("away") as edit:
        edit.remove_tunnel("bow thruster")
    assert hull.diff("with").numbers["tunnels"] == (1.0, 0.0)
    hull.go("with")
    assert hull.fingerprint == held
    assert hull.tunnels["bow thruster"].volume == found.volume
