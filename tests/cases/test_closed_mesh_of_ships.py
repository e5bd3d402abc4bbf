"""The closed meshes of ships against trimesh and against hydrostatics on the splines."""

import numpy as np
import pytest
import trimesh

import assoc_hull as ah
from assoc_hull.surface.cells.closed_mesh import ClosedMesh

SHIPS = {
    "dtc": ("shell", "deck", "transom"),
    "series60_70": ("shell", "deck"),
    "bulk_carrier": ("shell", "bossing end", "deck", "transom"),
}


@pytest.fixture(scope="module", params=SHIPS)
def ship(request: pytest.FixtureRequest) -> tuple[ah.Hull, ClosedMesh, tuple[str, ...]]:
    """A hull, its mesh with 4 points to an edge, and what closes it."""
    hull = request.getfixturevalue(request.param)
    return hull, ah.closed_mesh(hull), SHIPS[request.param]


def test_trimesh_finds_it_closed(ship: tuple[ah.Hull, ClosedMesh, tuple[str, ...]]) -> None:
    """Watertight, wound one way, Euler 2, outward; also when places that coincide are merged."""
    _, mesh, names = ship
    assert mesh.names == names
    assert mesh.report.sound
    other = trimesh.Trimesh(mesh.xyz, mesh.triangle, process=True)
    assert len(other.faces) == mesh.report.triangles
    assert other.is_watertight
    assert other.is_winding_consistent
    assert other.euler_number == 2 == mesh.report.euler
    assert other.volume == pytest.approx(mesh.volume, rel=1e-12)


def test_volume_and_centre_are_those_of_the_splines(
    ship: tuple[ah.Hull, ClosedMesh, tuple[str, ...]],
) -> None:
    """Below the design draught 0.03 % and 0.001 % of Lpp, where 0.15 % and 0.01 % are asked."""
    hull, mesh, _ = ship
    draught, length = hull.particulars.draught, hull.particulars.length
    found, wanted = mesh.below(draught), ah.hydrostatics(hull, draught=draught)
    asked = 2e-4 + 1.5e-3 * 1600 / mesh.cells
    assert abs(found.volume - wanted.volume) < min(3e-4, asked) * wanted.volume
    assert abs(found.lcb - wanted.lcb) < 1e-5 * length


def test_triangles_face_as_their_cells_do(
    ship: tuple[ah.Hull, ClosedMesh, tuple[str, ...]],
) -> None:
    """None has nil area; of 57,000 of a side at most 15 fold, in cells that are not convex."""
    _, mesh, _ = ship
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
    mesh = ah.closed_mesh(dtc, points=2)
    deck = mesh.triangle[mesh.group == mesh.names.index("deck")]
    assert np.ptp(mesh.xyz[deck, 2]) < 1e-3
    hull = np.unique(mesh.triangle[mesh.group == 0])
    assert mesh.xyz[hull, 2].max() == pytest.approx(mesh.xyz[deck, 2].max())
