"""Tunnels in a closed mesh: mouths cut out of the shell, walls between, nothing left open."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.errors import UnknownNameError
from assoc_hull.surface.cells.tunnel_walls import cut_mouth, wall_of
from tests.cases.test_box_with_bilges import HALF, round_box

NAMES = ["bow thruster", "stern thruster"]


@pytest.fixture(scope="module")
def hull() -> ah.Hull:
    """A Wigley hull with two tunnels."""
    found = ah.examples.wigley()
    with found.edit("thrusters") as edit:
        edit.tunnel(NAMES[0], x=88.0, z=3.0, radius=0.8)
        edit.tunnel(NAMES[1], x=20.0, z=3.0, radius=0.5)
    return found


@pytest.mark.parametrize("points", [2, 4])
def test_a_mesh_with_tunnels_is_closed_and_has_their_holes(hull: ah.Hull, points: int) -> None:
    """Euler's number is 2 less for each; what it encloses is less by their volumes.

    A prism of n sides is sin(2 pi / n) n / (2 pi) of its cylinder.
    """
    mesh, bare = hull.mesh(points=points), hull.mesh(points=points, leave_out=NAMES)
    assert (mesh.report.euler, bare.report.euler) == (-2, 2)
    assert mesh.report.sound
    assert mesh.report.open_edges == 0
    assert mesh.report.nil == 0
    assert mesh.names == ("shell", "deck", *NAMES)
    turn = 2.0 * np.pi / (16 * points)
    less = sum(each.volume for each in hull.tunnels.values()) * np.sin(turn) / turn
    assert bare.volume - mesh.volume == pytest.approx(less, rel=2e-3)
    for name in NAMES:
        assert mesh.areas[name] == pytest.approx(hull.tunnels[name].wall, rel=1e-2)


def test_hydrostatics_and_mesh_agree_on_a_tunnel_that_is_immersed_in_part(hull: ah.Hull) -> None:
    """Two routes that share the lines alone."""
    meshes = hull.mesh(points=8), hull.mesh(points=8, leave_out=NAMES)
    bare = ah.examples.wigley()
    for draught in (2.8, 3.0, 3.5):
        less = [each.below(draught).volume for each in meshes]
        volumes = [each.hydrostatics(draught=draught).volume for each in (hull, bare)]
        assert less[1] - less[0] == pytest.approx(volumes[1] - volumes[0], rel=3e-3)


def test_a_half_is_open_in_the_centre_plane_only(hull: ah.Hull) -> None:
    """The walls end there."""
    report = hull.mesh(half=True, points=2).report
    assert report.open_edges > 0
    assert report.off_centre == 0


def test_a_tunnel_through_a_box_is_a_prism(tmp_path: Path) -> None:
    """Above the bilge its wall and volume are exact; an exported mesh has it."""
    box = round_box()
    with box.edit("thruster") as edit:
        edit.tunnel("thruster", x=60.0, z=9.0, radius=1.5)
    mesh, bare, turn = box.mesh(), box.mesh(leave_out=["thruster"]), np.pi / 64.0
    area = 32.0 * 1.5**2 * np.sin(2.0 * turn)
    assert bare.volume - mesh.volume == pytest.approx(2.0 * HALF * area, rel=1e-10)
    around = 64.0 * 2.0 * 1.5 * np.sin(turn)
    assert mesh.areas["thruster"] == pytest.approx(2.0 * HALF * around, rel=1e-12)
    box.export(tmp_path / "box.stl", points=4, accept=True)
    assert (tmp_path / "box.stl").stat().st_size == 84 + 50 * len(mesh.triangle)


def test_a_name_that_is_neither_line_nor_tunnel_is_refused(hull: ah.Hull) -> None:
    """To leave out."""
    with pytest.raises(UnknownNameError, match="side thruster"):
        hull.mesh(leave_out=["side thruster"])


def test_an_edge_that_is_open_elsewhere_stays_open() -> None:
    """The wall begins at the mouth alone."""
    xyz = np.array([[0.0, 5, 0], [10, 5, 0], [10, 5, 10], [0, 5, 10]])
    cut = cut_mouth(xyz, np.array([[0, 1, 2], [0, 2, 3]]), (5.2, 4.9), 1.0, 32)
    area = cut.xyz[cut.triangle]
    size = np.linalg.norm(np.cross(area[:, 1] - area[:, 0], area[:, 2] - area[:, 0]), axis=1)
    assert 0.5 * size.sum() == pytest.approx(100.0 - 16.0 * np.sin(np.pi / 16.0), rel=1e-12)
    every, wall, foot = wall_of(cut.xyz, cut.triangle, (5.2, 4.9), 1.0)
    away = np.hypot(every[wall][:, :, 0] - 5.2, every[wall][:, :, 2] - 4.9)
    assert away.max() <= 1.0 + 1e-9
    assert len(foot) >= 32
    assert (every[foot, 1] == 0.0).all()
