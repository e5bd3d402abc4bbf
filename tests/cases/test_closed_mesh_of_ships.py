"""The closed meshes of ships against trimesh and against hydrostatics on the splines."""

import numpy as np
import pytest
import trimesh

import assoc_hull as ah
from assoc_hull.analysis.net.curve_net import gather_net
from assoc_hull.geometry.splines.segments import sample
from assoc_hull.surface.cells.closed_mesh import ClosedMesh
from tests.long_forms import LONG

SHIPS = {
    **({"dtc": (("shell", "deck", "transom"), 2.5e-4)} if LONG else {}),
    "series60_70": (("shell", "deck"), 1.2e-4),
    "bulk_carrier": (("shell", "bossing end", "deck", "transom"), 6e-5),
}
"""What closes them, and how near their volumes come to those of the splines."""

Case = tuple[ah.Hull, ClosedMesh, tuple[str, ...], float]


@pytest.fixture(scope="module", params=SHIPS)
def ship(request: pytest.FixtureRequest) -> Case:
    """A hull, its mesh with 4 points to an edge, what closes it, and how good its volume is."""
    hull = request.getfixturevalue(request.param)
    return hull, hull.mesh(), *SHIPS[request.param]


def test_trimesh_finds_it_closed(ship: Case) -> None:
    """Watertight, wound one way, Euler 2, outward; also when places that coincide are merged."""
    _, mesh, names, _ = ship
    assert mesh.names == names
    assert mesh.report.sound
    assert mesh.notes == ()
    other = trimesh.Trimesh(mesh.xyz, mesh.triangle, process=True)
    assert len(other.faces) == mesh.report.triangles
    assert other.is_watertight
    assert other.is_winding_consistent
    assert other.euler_number == 2 == mesh.report.euler
    assert other.volume == pytest.approx(mesh.volume, rel=1e-12)


def test_volume_and_centre_are_those_of_the_splines(
    ship: Case,
) -> None:
    """Below the design draught 0.025 % and 0.001 % of Lpp, where 0.15 % and 0.01 % are asked."""
    hull, mesh, _, near = ship
    draught, length = hull.particulars.draught, hull.particulars.length
    found, wanted = mesh.below(draught), hull.hydrostatics(draught=draught)
    assert near < 2e-4 + 1.5e-3 * 1600 / mesh.cells
    assert abs(found.volume - wanted.volume) < near * wanted.volume
    assert abs(found.lcb - wanted.lcb) < 1e-5 * length


def test_triangles_face_as_their_cells_do(
    ship: Case,
) -> None:
    """None has nil area; of 57,000 of a side at most 15 fold, in cells that are not convex."""
    _, mesh, _, _ = ship
    count = len(mesh.triangle) // 2
    vector = mesh.triangles.area_vectors()[:count]
    cell = mesh.cell[:count]
    shell = cell >= 0
    mean = np.stack([np.bincount(cell[shell], vector[shell, i]) for i in range(3)], axis=1)
    folded = (vector[shell] * mean[cell[shell]]).sum(axis=1) <= 0.0
    assert folded.sum() <= 15
    assert mesh.report.nil == 0


def test_the_deck_of_the_dtc_is_closed_though_its_particulars_say_open(dtc: ah.Hull) -> None:
    """What covers it is a group of its own, which may be left away; it lies in one plane."""
    assert dtc.particulars.deck == "open"
    mesh = dtc.mesh(points=2)
    deck = mesh.triangle[mesh.group == mesh.names.index("deck")]
    assert np.ptp(mesh.xyz[deck, 2]) < 1e-3
    hull = np.unique(mesh.triangle[mesh.group == 0])
    assert mesh.xyz[hull, 2].max() == pytest.approx(mesh.xyz[deck, 2].max())


@pytest.mark.parametrize("name", ["bulk_carrier", "series60_70"])
def test_no_vertex_lies_below_the_bottom_nor_beyond_the_side(
    request: pytest.FixtureRequest, name: str
) -> None:
    """A mesh goes no farther down or out than the lines it is made on, to a tenth of 1 mm.

    Where the carrier leaves her flat of bottom at an angle the fitted heights dipped by 34 mm.
    """
    hull = request.getfixturevalue(name)
    mesh, lines = hull.mesh(), sample(gather_net(hull.state).batch, 32)[1]
    assert mesh.xyz[:, 2].min() >= lines[:, 2].min() - 1e-4
    assert np.abs(mesh.xyz[:, 1]).max() <= lines[:, 1].max() + 1e-4
    if name == "bulk_carrier":
        assert mesh.xyz[:, 2].min() >= -1e-5
