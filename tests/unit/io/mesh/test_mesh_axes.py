"""Which axes of a mesh are breadth and height where the hull is open: found, or called doubtful."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.surfaces.triangles import Triangles, grid_triangles
from assoc_hull.io.lines.slices import HullSlices
from assoc_hull.io.mesh.frame import place_mesh
from assoc_hull.io.mesh.shell import make_shell
from assoc_hull.io.reports import Notebook
from assoc_hull.io.slicing.mesh_lines import slice_mesh
from tests import meshes

CUTS: dict[str, Any] = {"stations": [25.0, 50.0, 75.0], "waterlines": [2.0, 4.0], "buttocks": [2.0]}


def check_wigley(slices: HullSlices) -> None:
    """All lines lie on the formula within what the facets of the mesh allow, 10 mm."""
    for line in slices.lines:
        for piece in line.pieces:
            x, y, z = piece.points.T
            assert np.abs(y - meshes.wigley_y(x, z)).max() <= 0.01


def on_its_side(mesh: Triangles) -> Triangles:
    """A hull turned about its length, so that y of the file points up."""
    return meshes.moved(mesh, lambda xyz: xyz[:, [0, 2, 1]] * np.array([1.0, -1.0, 1.0]))


def bottomless() -> Triangles:
    """Half a Wigley hull without what lies below 0.6 m."""
    mesh = meshes.wigley_half()
    return Triangles(mesh.xyz, mesh.face[mesh.corners.mean(axis=1)[:, 2] > 0.6])


def test_a_whole_hull_with_an_open_deck_on_its_side_is_no_half_hull() -> None:
    """Its two sides mirror, so the opening is the deck; the choice is called doubtful."""
    whole = meshes.mirrored(meshes.wigley_half())
    slices = slice_mesh(on_its_side(whole), **CUTS)
    assert "axes" in slices.report.kinds("repairs")
    assert slices.report.kinds("suspicions") == ("axes doubtful",)
    assert slices.high.tolist() == [100.0, 5.0, 6.25]
    check_wigley(slices)


def test_a_whole_hull_with_an_open_deck_is_left_as_it_is() -> None:
    """Upright with its centre plane at y = 0, nothing is mended or suspected."""
    slices = slice_mesh(meshes.mirrored(meshes.wigley_half()), **CUTS)
    assert slices.report.kinds("repairs") == slices.report.kinds("suspicions") == ()
    check_wigley(slices)


def test_half_a_hull_without_a_bottom_stays_upright() -> None:
    """It is not taken for one on its side whose deck is the centre plane, and told doubtful."""
    slices = slice_mesh(bottomless(), **CUTS)
    assert slices.report.kinds("repairs") == ()
    assert "axes doubtful" in slices.report.kinds("suspicions")
    check_wigley(slices)


def test_half_a_hull_alike_above_and_below_stays_upright() -> None:
    """Half a hull cut at y = 0 mirrors in height too; the doubt is told, the axes are kept."""
    cut = on_its_side(meshes.mirrored(meshes.wigley_half()))
    placed = meshes.moved(cut, lambda xyz: xyz + np.array([0.0, 6.25, 5.0]))
    report = slice_mesh(placed, stations=3, waterlines=2, buttocks=0).report
    assert "axes" in report.kinds("assumptions")
    assert "axes doubtful" in report.kinds("suspicions")


@pytest.mark.parametrize(
    ("flat", "words"),
    [([1, 0, 1], "in one plane"), ([1, 1, 0], "in one plane"), ([1, 0, 0], "on one line")],
)
@pytest.mark.parametrize("axes", ["auto", "+x+y+z"])
def test_a_mesh_without_breadth_or_depth_is_refused(flat: list[int], words: str, axes: str) -> None:
    """All places in one plane, or on one line, hold no hull; that is what the error says."""
    mesh = meshes.moved(meshes.wigley_half(21, 11), lambda xyz: xyz * np.array(flat, np.float64))
    with pytest.raises(BadInputError, match=words):
        slice_mesh(mesh, axes=axes, **CUTS)


def test_a_vertex_across_the_centre_plane_does_not_move_the_hull() -> None:
    """Half a hull whose stem waves by 0.9 mm is not shifted by that."""
    mesh = meshes.wigley_half()
    inner = int(np.argmin(np.where(mesh.xyz[:, 1] > 0.0, mesh.xyz[:, 1], np.inf)))
    xyz = mesh.xyz.copy()
    xyz[inner, 1] = -9e-4
    slices = slice_mesh(Triangles(xyz, mesh.face), **CUTS)
    assert not slices.report.repairs
    assert {piece.ends[0] for line in slices.group("sections") for piece in line.pieces} == {
        "profile"
    }


@pytest.mark.parametrize("ship", ["bulk_carrier_180m", "prelikon_ship"])
def test_full_ships_with_sheer_are_turned_only_if_they_lie_keel_up(
    ship: str, shipped: Callable[[str], ah.Hull]
) -> None:
    """Their bow is narrow above and their bottom broad: the volume of the halves tells."""
    hull = shipped(ship)
    mesh = hull.mesh(points=2).triangles
    depth = hull.particulars.depth
    for turn, mended in ((1.0, False), (-1.0, True)):
        book = Notebook()
        xyz = mesh.xyz * np.array([1.0, turn, turn])
        placed = place_mesh(mesh.moved(xyz), "auto", book)
        assert ("upside down" in book.report().kinds("repairs")) == mended
        deck = placed.xyz[np.abs(placed.xyz[:, 0] - 60.0) < 10.0, 2].max()
        assert deck - placed.xyz[:, 2].min() == pytest.approx(depth, abs=0.05 * depth)


def test_a_bow_that_ends_in_a_plate_is_told() -> None:
    """A box of 60 m x 15 m x 4 m: the end aft is its transom, that forward a plate taken off."""
    u, v = np.meshgrid(np.linspace(0.0, 60.0, 13), np.linspace(-1.0, 1.0, 33), indexing="ij")
    y = np.clip(v * 11.5, -7.5, 7.5)
    shell = grid_triangles(np.stack([u, y, np.abs(v * 11.5) - np.abs(y)], axis=2))
    ends = [
        grid_triangles(
            np.array([[[x, y, z] for z in (0.0, 4.0)] for y in np.linspace(-7.5, 7.5, 9) * turn])
        )
        for x, turn in ((0.0, 1.0), (60.0, -1.0))
    ]
    parts = [shell, *ends]
    first = np.cumsum([0, *(len(each.xyz) for each in parts[:-1])])
    book = Notebook()
    make_shell(
        Triangles(
            np.concatenate([each.xyz for each in parts]),
            np.concatenate([each.face + n for each, n in zip(parts, first.tolist(), strict=True)]),
        ),
        book,
    )
    [note] = [each for each in book.report().assumptions if each.kind == "bow end"]
    assert note.amount == pytest.approx(60.0)
    assert "60 m2" in note.what
