"""The surfaces of ships as CAD programs get them: whole hulls of one shell, to the micrometre.

Series 60 always; the DTC, with bulb and stern bulb, and the carrier with `make test-long`.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.errors import NotSoundError
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.hull import Hull
from assoc_hull.io.cad.check_file import area_of, volume_of
from assoc_hull.io.cad.faces import sew_surfaces
from assoc_hull.io.cad.kernel import quiet_kernel
from assoc_hull.io.cad.write import CadReport, both_sides, cad_bytes, closed_solid
from assoc_hull.io.slicing.surface_lines import faces_of_file
from tests.long_forms import LONG, long_form

SHIPS = {
    # Edges that join two faces, and free ones: deck edge, rim of the transom.
    "series60_70": (7, 4),
    **({"dtc": (19, 8), "bulk_carrier": (13, 10)} if LONG else {}),
}


@pytest.mark.parametrize("name", SHIPS)
def test_the_whole_hull_is_one_shell_and_a_solid(name: str, request: pytest.FixtureRequest) -> None:
    """Both sides of all blocks are joined, also where three of them meet on the centre plane.

    Seams that are open, units, names and normals: the file would be refused. The solid is closed by
    deck and transom, sound to OpenCASCADE as it is read back, and holds what the lines enclose.
    """
    hull: Hull = request.getfixturevalue(name)
    surface = hull.surface()
    patches = surface.patches
    _, found = cad_bytes(patches, "step", unit="mm")
    assert (found.faces, found.shells) == (2 * len(patches), 1)
    assert (found.joined_edges, found.free_edges) == SHIPS[name]
    assert found.control_point_error < 1e-8
    assert found.area == pytest.approx(2.0 * sum(map(area_of, patches)), rel=1e-6)
    # Ruled caps have no share in the flux of (0, y, 0): twice the half is the solid to rounding.
    above = hull.particulars.depth * 2.0
    assert found.volume == pytest.approx(2.0 * surface.below(above).volume, rel=1e-7)
    off = sum(block.fitted.largest * area_of(block.surface) for block in surface.blocks)
    assert found.volume == pytest.approx(hull.mesh(points=16).volume, abs=2.0 * off)


def test_a_solid_beside_its_shell_is_written_once_and_read_as_the_shell(tmp_path: Path) -> None:
    """Of the flat-decked Wigley hull, within the largest residual of its lines; a half has none."""
    hull, path = ah.examples.wigley(), tmp_path / "hull.step"
    surface = hull.surface()
    report = surface.write(path)
    assert isinstance(report, CadReport)
    truth = hull.hydrostatics(draught=hull.particulars.depth).volume
    off = surface.blocks[0].fitted.largest * report.area
    assert report.volume == pytest.approx(truth, abs=off)
    assert off < 1e-3 * truth
    text = path.read_text()
    assert (text.count("MANIFOLD_SOLID_BREP("), text.count("SHELL_BASED_SURFACE_MODEL(")) == (1, 1)
    assert len(faces_of_file(path).surfaces) == 2
    half = surface.write(path, half=True)
    assert (half.volume, path.read_text().count("MANIFOLD_SOLID_BREP(")) == (None, 0)


def test_an_end_that_leaves_the_centre_plane_is_closed_where_it_does() -> None:
    """An edge in the centre plane that runs round a plate, as a bossing ends: the solid is whole.

    With x = 4 v and z a polyline in u the volume of both sides is twice that of trapezes, 6 m3.
    """
    aft = [[0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 1.5], [0.0, 0.0, 2.0]]
    amidst = [[2.0, 0.0, 0.0], [2.0, 1.0, 1.0], [2.0, 2.0, 1.5], [2.0, 0.0, 2.0]]
    stem = [[4.0, 0.0, 0.0], [4.0, 0.0, 1.0], [4.0, 0.0, 1.5], [4.0, 0.0, 2.0]]
    knots = np.array([0.0, 0.0, 2.0, 2.5, 3.0, 3.0]), np.repeat([0.0, 1.0], 3)
    side = SplineSurface("side", (1, 2), *knots, np.stack([aft, amidst, stem], axis=1))
    with quiet_kernel():
        solid = closed_solid(sew_surfaces(both_sides([side])))
        assert solid is not None
        assert volume_of(solid) == pytest.approx(6.0, rel=1e-9)


def test_a_surface_that_leaves_its_limits_is_written_if_it_is_accepted(tmp_path: Path) -> None:
    """A tolerance no fit can keep: refused with the block, both sizes and the place."""
    hull, path = ah.examples.wigley(stations=9, waterlines=6), tmp_path / "hull.igs"
    found = hull.surface(tolerance=1e-6)
    with pytest.raises(NotSoundError, match=r"body: 95 % .* over the limit of 0\.0 mm; .* at \("):
        found.write(path, "iges-surfaces")
    assert not path.exists()
    found.write(path, "iges-surfaces", accept=True)
    assert path.exists()


@long_form
def test_halves_that_cross_are_left_out_of_a_rhino_file(
    shipped: Callable[[str], ah.Hull], tmp_path: Path
) -> None:
    """The lines and the mesh are written; the report says where the surface is not sound.

    That such a surface is written only if it is accepted, the command line is tested for always.
    """
    pytest.importorskip("rhino3dm")
    report = shipped("plain_ship").export(tmp_path / "hull.3dm")
    (note,) = (each for each in report.left_out if each.kind == "surface")
    assert "waves across the centre plane by 6.24 mm at (2.96, -0.01, 4.28)" in str(note)
    assert "accept=True" in str(note)
