"""Bodies beside the net in a closed mesh: groups of their own, closed each, and in its files."""

from __future__ import annotations

from pathlib import Path

import attrs
import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.analysis.net.curve_net import gather_net
from assoc_hull.creation.classical.bodies_beside import put_bodies
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import BadInputError, UnknownNameError
from assoc_hull.io.mesh.closed_mesh import write_mesh
from assoc_hull.model.attached_body import AttachedBody
from assoc_hull.surface.cells.closed_mesh import ClosedMesh, mesh_of_net
from assoc_hull.surface.cells.meshed_bodies import surfaces_of

RING = np.array([[20.0, -3, 10], [20, 3, 10], [20, 3, 12], [20, -3, 12]])
FORWARD, ACROSS, UP = np.eye(3)
HATCH = AttachedBody("hold", "hatches", [RING, RING + 8 * FORWARD], range(4), False, 1)
HOUSE = attrs.evolve(HATCH, name="bridge", sections=HATCH.points + 2 * UP)
SMALL = 0.1 * RING + 40 * FORWARD + 4 * ACROSS
CHEST = AttachedBody("chest", "boxes", [SMALL, SMALL + 2 * FORWARD], range(4), True, -1)
SIDE = RING + 3 * ACROSS
KEELS = AttachedBody("bilge keel", "appendages", [SIDE, SIDE + 9 * FORWARD], range(4), True, 1)
EVERY = (HATCH, HOUSE, CHEST, KEELS)


@pytest.fixture(scope="module")
def bare() -> ah.Hull:
    """A Wigley hull."""
    return ah.examples.wigley()


@pytest.fixture(scope="module")
def mesh(bare: ah.Hull) -> ClosedMesh:
    """Its mesh with four bodies."""
    return mesh_of_net(gather_net(bare.state), points=2, bodies=EVERY)


def test_the_hull_in_a_mesh_with_bodies_keeps_its_bits(bare: ah.Hull, mesh: ClosedMesh) -> None:
    """Vertices and triangles come first; volume, area and what is below a draught are its own."""
    alone = bare.mesh(points=2)
    count = alone.report.triangles
    np.testing.assert_array_equal(mesh.triangle[:count], alone.triangle)
    np.testing.assert_array_equal(mesh.xyz[: len(alone.xyz)], alone.xyz)
    assert (mesh.volume, mesh.area) == (alone.volume, alone.area)
    assert mesh.below(5.0) == alone.below(5.0)
    assert (mesh.cell[count:] == -1).all()


def test_each_body_is_a_group_of_closed_surfaces(mesh: ClosedMesh) -> None:
    """Those that touch share no vertex; both sides stand there; what is taken off faces inward."""
    assert mesh.names == ("shell", "deck", "hold", "bridge", "chest", "bilge keel")
    assert [each.name for each in mesh.bodies] == [
        "hold", "bridge", "chest", "chest", "bilge keel", "bilge keel",
    ]  # fmt: skip
    for each in mesh.bodies:
        part = mesh.triangle[each.first : each.last]
        assert each.report.sound
        assert len(np.unique(part)) == each.report.vertices
        corner = mesh.xyz[part]
        flux = (corner[:, 0] * np.cross(corner[:, 1], corner[:, 2])).sum() / 6.0
        held = next(body for body in EVERY if body.name == each.name)
        assert flux == pytest.approx(held.sign * held.volume / (2 if held.both else 1), rel=1e-9)
    assert "each closed: hold 96.000 m3" in str(mesh)


def test_a_half_has_what_stands_to_port(bare: ah.Hull) -> None:
    """Open in the centre plane alone; one that touches the plane has its face there left off."""
    half = mesh_of_net(gather_net(bare.state), points=2, bodies=EVERY, half=True)
    assert (half.xyz[:, 1] >= 0.0).all()
    for each in half.bodies:
        assert each.report.off_centre == 0
    assert [bool(each.report.open_edges) for each in half.bodies] == [True, True, False, True]
    area = {each.name: each.report.area for each in half.bodies}
    assert area["hold"] == pytest.approx(2 * 3.0 * 2 + 2 * 3.0 * 8 + 2.0 * 8, rel=1e-12)
    starboard = attrs.evolve(CHEST, sections=CHEST.points * [1, -1, 1], both=False)
    assert list(surfaces_of([starboard], half=True)) == []


@pytest.mark.parametrize("form", ["stl", "stl-text", "obj", "ply"])
@pytest.mark.parametrize("half", [False, True])
def test_files_hold_bodies(bare: ah.Hull, tmp_path: Path, form: str, half: bool) -> None:
    """All triangles, though some bodies touch; the report tells the names."""
    made = mesh_of_net(gather_net(bare.state), points=2, bodies=EVERY, half=half)
    report = write_mesh(made, tmp_path / "ship", form)
    assert report.triangles == len(made.triangle)
    assert report.bodies == ("hold", "bridge", "chest", "bilge keel")
    assert report.volume == (None if half else made.volume)


def test_a_body_without_volume_is_left_out_and_noted(bare: ah.Hull) -> None:
    """The mesh of the hull is made all the same."""
    flat = attrs.evolve(HATCH, name="plate", sections=HATCH.points * [1, 1, 0])
    found = mesh_of_net(gather_net(bare.state), points=2, bodies=[flat])
    assert found.bodies == ()
    assert "'plate' encloses nothing" in found.notes[0]
    point = attrs.evolve(HATCH, name="point", sections=0.0 * HATCH.points + 1.0)
    for half in (True, False):
        found = mesh_of_net(gather_net(bare.state), points=2, bodies=[point], half=half)
        assert "'point' encloses nothing" in found.notes[0]


def test_a_body_called_as_a_cover_is_a_group_of_its_own(bare: ah.Hull) -> None:
    """Its name is told from that by the group of the body."""
    deck = attrs.evolve(HATCH, name="deck")
    found = mesh_of_net(gather_net(bare.state), points=2, bodies=[deck])
    assert found.names == ("shell", "deck", "deck (hatches)")


def test_an_export_leaves_out_what_it_is_asked_to(tmp_path: Path) -> None:
    """Bodies by name, all of them as hull.bodies; only a mesh has any; a name must be there."""
    ship, out = ah.examples.wigley(), tmp_path / "ship.obj"
    with Transaction(ship.document, "bodies") as edit:
        put_bodies(edit, EVERY)
    assert ship.export(out).bodies == ("bilge keel", "bridge", "chest", "hold")
    assert ship.export(out, leave_out=["hold"]).bodies == ("bilge keel", "bridge", "chest")
    assert ship.export(out, leave_out=ship.bodies).groups == ship.mesh(leave_out=ship.bodies).names
    with pytest.raises(UnknownNameError, match="funnel"):
        ship.export(out, leave_out=["funnel"])
    with pytest.raises(BadInputError, match="leave_out is for meshes"):
        ship.export(tmp_path / "ship.dxf", leave_out=["hold"])
