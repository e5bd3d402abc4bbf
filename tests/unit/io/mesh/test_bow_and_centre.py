"""Which end is the bow, and where the centre plane lies: weighed by evidence, told or refused."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from assoc_hull.errors import BadInputError, CoincidentPointsError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.surfaces.triangles import Triangles
from assoc_hull.io.digitised.read import read_lines
from assoc_hull.io.lines.slices import HullSlices
from assoc_hull.io.placing.options import FrameOptions
from assoc_hull.io.reports import Note
from assoc_hull.io.slicing import read
from assoc_hull.io.slicing.mesh_lines import slice_mesh
from tests import meshes

CUTS: dict[str, Any] = {"stations": [25.0, 50.0, 75.0], "waterlines": [2.0, 4.0], "buttocks": [2.0]}
L = meshes.L


def fuller_forward(by: float) -> Triangles:
    """A Wigley hull, x = 0 at the AP, whose half-breadths grow forward by a part of themselves."""
    return meshes.moved(
        meshes.closed_wigley(61, 16), lambda xyz: xyz * np.column_stack(
            [np.ones(len(xyz)), 1.0 + by * (xyz[:, 0] / 50.0 - 1.0), np.ones(len(xyz))]
        ),
    )  # fmt: skip


def backward(mesh: Triangles) -> Triangles:
    """The same with x aft."""
    return meshes.moved(mesh, lambda xyz: xyz * [-1.0, -1.0, 1.0])


def cut(mesh: Triangles, axes: str = "auto", **frame: Any) -> HullSlices:
    """Lines of a mesh, its perpendiculars found from what is given."""
    length = None if "ap" in frame and "fp" in frame else L
    wanted = FrameOptions(length=length, draught=4.0, **frame)
    return slice_mesh(mesh, axes=axes, frame=wanted, **CUTS)


def bow_notes(slices: HullSlices) -> list[Note]:
    """What is suspected of the bow."""
    return [note for note in slices.report.suspicions if note.kind == "bow"]


def fuller_end(slices: HullSlices) -> str:
    """Where the fuller end is now."""
    broad = {line.offset: line.pieces[0].points[:, 1].max() for line in slices.group("sections")}
    return "fore" if broad[75.0] > broad[25.0] else "aft"


def test_ends_that_differ_little_are_no_evidence_against_the_file() -> None:
    """The direction of the file stands, that is suspected, and either axes= settles it."""
    ship = fuller_forward(0.25)
    slices = cut(ship)
    assert fuller_end(slices) == "fore"
    assert "bow at negative x" not in slices.report.kinds("repairs")
    (note,) = bow_notes(slices)
    assert "m at low x" in note.what
    ways = re.findall(r"axes='(\S+)'", note.what)
    assert ways == ["+x+y+z", "-x-y+z"]
    for axes, end in zip(ways, ("fore", "aft"), strict=True):
        settled = cut(ship, axes)
        assert fuller_end(settled) == end
        assert not bow_notes(settled)


def test_the_axes_that_settle_the_bow_are_those_of_the_file() -> None:
    """Of a hull that lies along y of its file as well."""
    ship = meshes.moved(fuller_forward(0.25), lambda xyz: xyz[:, [1, 0, 2]] * [-1.0, 1.0, 1.0])
    (note,) = bow_notes(cut(ship))
    here, there = re.findall(r"axes='(\S+)'", note.what)
    assert fuller_end(cut(ship, here)) == "fore"
    assert fuller_end(cut(ship, there)) == "aft"


def test_a_hull_that_is_turned_is_suspected() -> None:
    """A clearly broader end is a stern; it is turned aft, and how to settle that is told."""
    slices = cut(fuller_forward(0.8))
    assert fuller_end(slices) == "aft"
    assert "bow at negative x" in slices.report.kinds("repairs")
    (note,) = bow_notes(slices)
    assert "turned end for end" in note.what
    assert "axes='+x+y+z' puts the bow at high x, axes='-x-y+z' at low x" in note.what


@pytest.mark.parametrize("by", [0.25, 0.8])
@pytest.mark.parametrize(
    "frame",
    [{"origin": "ap"}, {"ap": 0.0, "fp": L}, {"ap": "0 m", "fp": "100 m"}, {"ap": 0.0}, {"fp": L}],
)
def test_perpendiculars_that_are_given_tell_the_bow(by: float, frame: dict[str, Any]) -> None:
    """However full she is forward: nothing is turned, nothing is suspected."""
    slices = cut(fuller_forward(by), **frame)
    assert fuller_end(slices) == "fore"
    assert slices.report.kinds("suspicions") == ()
    assert slices.report.kinds("repairs") == ()
    assert slices.frame is not None
    assert (slices.frame.ap, slices.frame.fp) == pytest.approx((0.0, L))


@pytest.mark.parametrize("frame", [{"origin": "ap"}, {"ap": 0.0, "fp": -L}])
def test_perpendiculars_that_are_given_turn_a_hull_that_runs_aft(frame: dict[str, Any]) -> None:
    """With the AP at x = 0 and the hull at negative x her bow lies there; that is no suspicion."""
    slices = cut(backward(fuller_forward(0.8)), **frame)
    assert fuller_end(slices) == "fore"
    assert "bow at negative x" in slices.report.kinds("repairs")
    assert slices.report.kinds("suspicions") == ()


def test_the_bow_of_lines_is_told_by_their_perpendiculars_too() -> None:
    """A broader fore end is suspected, but not where origin= says which end is which."""
    rows = [
        f"ST {x:g},{x},{float(meshes.wigley_y(np.array(x), np.array(z))):.6f},{z}"
        for x in np.linspace(2.0, 50.0, 9).tolist() for z in np.linspace(0.0, 6.25, 11).tolist()
    ]  # fmt: skip
    text = "line,x,y,z\n" + "\n".join(rows) + "\n"
    for origin, told in ((None, True), ("ap", False)):
        frame = FrameOptions(draught=4.0, length=50.0, origin=origin)
        assert ("bow" in read_lines(text, frame=frame).report.kinds("suspicions")) == told


def test_a_refusal_that_may_follow_from_the_direction_names_axes() -> None:
    """The AP at x = 0 and the hull before it, but axes= say that she lies abaft."""
    with pytest.raises(BadInputError, match=r"perpendiculars would stand.*axes="):
        cut(fuller_forward(0.25), "-x-y+z", origin="ap")


# --------------------------------------------------------------------------------------
# The centre plane.


def broader_to_port(xyz: FloatArray) -> FloatArray:
    """Make the port side 3 % wider."""
    return np.asarray(np.where((xyz[:, 1] > 0.0)[:, None], xyz * [1.0, 1.03, 1.0], xyz))


@pytest.mark.parametrize(("off", "factor"), [(0.0, 1.0), (2.0, 1.0), (2.0, 1e3)])
def test_sides_that_differ_have_no_centre_plane_between_them(off: float, factor: float) -> None:
    """The keel tells the centre plane; the refusal names place and amount, in the file's unit."""
    ship = meshes.moved(
        meshes.closed_wigley(),
        lambda xyz: factor * (broader_to_port(xyz) + np.array([0.0, off, 0.0])),
    )
    with pytest.raises(BadInputError, match=r"the sides of the hull differ by up to 1[45]\d"
                       r".* mm, at x = .*, z = .* of the file") as found:  # fmt: skip
        slice_mesh(ship, **CUTS)
    assert f"about y = {off * factor:.7g}, where the keel lies" in str(found.value)
    assert "export the half that is right" in str(found.value)


def test_a_vertex_that_stands_out_at_a_side_does_not_shift_the_hull() -> None:
    """The sides are alike about the keel: that place is proposed, and taken."""
    ship = meshes.closed_wigley(241, 11)
    xyz = ship.xyz.copy()
    xyz[int(xyz[:, 1].argmax()), 1] += 0.8
    with pytest.raises(BadInputError, match=r"give centre=0, and look for what stands out"):
        slice_mesh(Triangles(xyz, ship.face), **CUTS)


def test_a_symmetric_hull_off_its_centre_plane_is_moved_as_before() -> None:
    """Triangulated otherwise to starboard, too, within the depth of the facets."""
    ship = meshes.moved(meshes.closed_wigley(41, 16), lambda xyz: xyz + np.array([0.0, 3.0, 0.0]))
    assert "centre plane" in slice_mesh(ship, **CUTS).report.kinds("repairs")


# --------------------------------------------------------------------------------------
# A spike.


def spiked() -> Triangles:
    """A Wigley hull of which one vertex of the keel is pulled 0.9 m to port."""
    ship = meshes.closed_wigley(81, 31)
    keel = np.abs(ship.xyz - [20.0, 0.0, 0.0]).max(axis=1)
    xyz = ship.xyz.copy()
    xyz[int(keel.argmin()), 1:] += [0.9, 0.4]
    return Triangles(xyz, ship.face)


def test_a_spike_is_told_by_its_vertex_in_the_file() -> None:
    """A line that is cut from it doubles back: where, and how far the vertex stands out."""
    mm = meshes.moved(spiked(), lambda xyz: 1e3 * xyz)
    slices = slice_mesh(mm, **CUTS | {"buttocks": [0.3, 0.6], "stations": [19.5, 50.0]})
    (note,) = [each for each in slices.report.suspicions if each.kind == "doubles back"]
    assert "the vertex at (2e+04, 900, 400) of the file lies" in note.what
    assert note.amount == pytest.approx(0.9, abs=0.3)
    whole = slice_mesh(meshes.closed_wigley(), **CUTS)
    assert "doubles back" not in whole.report.kinds("suspicions")


def test_a_line_that_runs_over_itself_is_refused_in_terms_of_the_file(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """No name of a curve of the net, but place, amount and what to do."""

    def fails(*_: object, **__: object) -> None:
        raise CoincidentPointsError("buttocks:0.6/2", (20.0, 0.6, 0.4), 0.0, 1e-6)

    monkeypatch.setattr(read, "net_from_slices", fails)
    cuts = CUTS | {"buttocks": [0.3, 0.6], "stations": [19.5, 50.0]}
    ships = iter([spiked(), meshes.closed_wigley()])
    monkeypatch.setattr(read, "read_mesh", lambda _, **said: slice_mesh(next(ships), **said))
    path = Path("hull.stl")
    with pytest.raises(BadInputError, match=r"the vertex at \(20, 0.9, 0.4\) of the file lies .* mm"
                       r" off .*look at the mesh there, and move that vertex back"):  # fmt: skip
        read.read_slices(path, length=L, draught=4.0, **cuts)
    with pytest.raises(CoincidentPointsError):
        read.read_slices(path, length=L, draught=4.0, **cuts)
