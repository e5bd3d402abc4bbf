"""What the parts of `io.slicing` give, one small example of each."""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.geometry.surfaces.triangles import grid_triangles
from assoc_hull.io.cad.faces import HullFaces
from assoc_hull.io.lines.slices import LinePiece, SliceLine
from assoc_hull.io.reports import Notebook
from assoc_hull.io.slicing.mesh_lines import report_bottom, slice_mesh
from assoc_hull.io.slicing.net import net_from_slices
from assoc_hull.io.slicing.surface_lines import AxisChange, slice_surfaces


def test_a_hull_whose_bottom_is_missing_its_sections_begin() -> None:
    """A hull whose bottom is missing: its sections begin far from the centre plane, on no
    boundary."""
    piece = LinePiece(np.array([[5.0, 3, 0], [5, 4, 2]]), ("loose", "deck edge"))
    book = Notebook()
    report_bottom([SliceLine("sections", "ST 5", 5.0, (piece,))], 4.0, book)
    assert (
        str(book.report().suspicions[0])
        == "bottom missing: the sections: 1 of 1 begin off the centre plane, by up to 3 m (ST 5)"
    )


def test_from_slices_to_a_net_features_smooth_lines_boundary() -> None:
    """From slices to a net: features, smooth lines, boundary curves, adoption."""
    x, z = np.meshgrid(np.linspace(0, 100, 201), np.linspace(0, 6.25, 41), indexing="ij")
    y = 5.0 * (1.0 - (x / 50.0 - 1.0) ** 2) * (1.0 - (1.0 - z / 6.25) ** 2)
    mesh = grid_triangles(np.stack([x, y, z], axis=2))
    slices = slice_mesh(mesh, stations=9, waterlines=5, buttocks=2)
    _state, report = net_from_slices(slices)
    assert (len(report.adoption.lines), report.adoption.inflections) == (18, (0, 0))


def test_points_cut_from_triangles_of_surfaces_put() -> None:
    """Points cut from triangles of surfaces, put on the surfaces themselves, each in its
    plane."""
    xyz = np.random.default_rng(1).random((9, 3))
    assert AxisChange.between(xyz, xyz[:, [1, 0, 2]] * [1, 1, -1] + 2.0).turn.tolist() == [
        [0.0, 1.0, 0.0],
        [1.0, 0.0, 0.0],
        [0.0, 0.0, -1.0],
    ]


def test_spline_surfaces_of_a_hull_cut_into_lines_whose() -> None:
    """Spline surfaces of a hull cut into lines, whose points lie on the surfaces themselves."""
    u, v = np.mgrid[0:1:3j, 0:1:3j]
    net = np.stack([100.0 * u, 5.0 * 2.0 * (u == 0.5) * (v > 0.0), 6.25 * v], axis=2)
    faces = HullFaces.of([SplineSurface.bezier(net, "wigley")], "m")
    slices = slice_surfaces(faces, stations=[25.0, 50.0], waterlines=[1.5625], buttocks=1)
    x, y, z = slices["WL 1.5625"].pieces[0].points.T
    assert bool(np.abs(y - 5.0 * (1 - (x / 50 - 1) ** 2) * (1 - (1 - z / 6.25) ** 2)).max() < 1e-9)
