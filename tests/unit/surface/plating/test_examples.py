"""What the parts of `surface.plating` give, one small example of each."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

import assoc_hull as ah
from assoc_hull.geometry.patches.area_integrals import AreaIntegrator
from assoc_hull.geometry.patches.bernstein_polynomials import BoundedPolynomial
from assoc_hull.geometry.patches.bezier_patches import Patches
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.surface.plating.curvature_nodes import curvature_nodes
from assoc_hull.surface.plating.development import development, equal_grid, flatten_grid, springs_of
from assoc_hull.surface.plating.hull_plate import CurvatureDoubt, doubled_band, nodes_in
from assoc_hull.surface.plating.hull_plates import hull_plates
from assoc_hull.surface.plating.hull_seams import HullSeams, PlateRange
from assoc_hull.surface.plating.hull_shell import HullShell, girth_of, margin_patches
from assoc_hull.surface.plating.plate import COARSE, SLIVER, plate_axes, plate_extents, radius_of
from assoc_hull.surface.plating.plate_areas import CutAreas, level_table, levels_about, tallies
from assoc_hull.surface.plating.plate_class import PlateShares, flat_share, suggestions_with
from assoc_hull.surface.plating.plate_table import COLUMNS, HULL_COLUMNS
from assoc_hull.surface.plating.rival_fits import every_second_waterline, rival_curvature
from assoc_hull.surface.plating.surface_plates import Seams, cut_at_seams


def test_areas_of_what_several_functions_bound_together() -> None:
    """Areas of what several functions bound together, from the areas by sign of their
    products."""
    net = np.zeros((2, 2, 3))
    net[1, :, 0], net[:, 1, 1] = 2.0, 3.0
    ground = AreaIntegrator.of(Patches.single(net), 1e-6)
    off = np.full((1, 2, 2), 1e-15)
    # x > 0.5
    right = BoundedPolynomial(net[None, ..., 0] - 0.5, off)
    # y > 1
    above = BoundedPolynomial(net[None, ..., 1] - 1.0, off)
    assert_allclose(CutAreas.of(ground, (right, above)).inside.round(9), [3.0], rtol=0, atol=0.1)


def test_where_the_gaussian_curvature_of_patches_exceeds_levels_areas() -> None:
    """Where the Gaussian curvature of patches exceeds levels: areas, level by level."""
    assert levels_about(1.0) == (1.0, -1.0, 0.5, -0.5, 2.0, -2.0)


def test_what_lies_in_the_ranges_of_plates_whole_patches() -> None:
    """What lies in the ranges of plates: whole patches, parts of patches, areas above levels."""
    x, z = np.mgrid[0:30:4j, 0:3:4j]
    shell = HullShell.of((SplineSurface.bezier(np.stack([x, 1.0 + 0.0 * x, z], axis=-1), "side"),))
    wanted = PlateRange("1", x=(4.0, 10.0))
    (found,) = tallies(shell, (wanted,), (), level_table(shell.patches, ()))
    assert round(found.area, 9) == 18.0


def test_grids_on_a_surface_with_nearly_equal_steps_along() -> None:
    """Grids on a surface with nearly equal steps: along its longer way and across."""
    net = np.zeros((2, 2, 3))
    net[1, :, 0], net[:, 1, 1] = 2.0, 6.0
    grid = equal_grid(SplineSurface.bezier(net))
    assert (grid.shape, grid.place[0, 0].tolist(), grid.place[-1, 0].tolist()) == (
        (49, 17),
        [2.0, 0.0, 0.0],
        [2.0, 6.0, 0.0],
    )


def test_the_approximate_development_of_a_plate_its_outline_laid() -> None:
    """The approximate development of a plate: its outline laid flat, and the strain that
    forming needs."""
    net = np.zeros((4, 2, 3))
    net[:, 0], net[:, 1] = np.array([[0, 0, 0], [1, 1, 0], [2, 1, 0], [3, 0, 0]]), 1.0
    net[:, 1, :2] = net[:, 0, :2]
    flat = development(SplineSurface.bezier(net, "trough"))
    assert (flat.size.round(3).tolist(), bool(flat.largest_strain < 1e-8)) == ([3.443, 1.0], True)


def test_what_other_fits_of_the_same_net_make() -> None:
    """What other fits of the same net make of the curvature of a plate."""
    gauss, area = np.array([0.0, 1.0]), np.ones(2)
    found = CurvatureDoubt.of(gauss, (gauss + 0.25,), area)
    assert (found.dk, found.changed(gauss, area, 0.2, 2.0, 0.5)) == (0.25, 0.5)


def test_the_nodes_that_lie_in_a_plate_and_how() -> None:
    """The nodes that lie in a plate, and how far it reaches along its axes."""
    x, z = np.mgrid[0:30:4j, 0:3:4j]
    shell = HullShell.of((SplineSurface.bezier(np.stack([x, 1.0 + 0.0 * x, z], axis=-1), "side"),))
    found = nodes_in(shell, PlateRange("1", x=(4.0, 10.0)))
    assert np.sort(found.extents(np.eye(3)[[0, 2, 1]])).round(6).tolist() == [3.0, 6.0]


def test_a_plate_of_a_hull_what_is_known() -> None:
    """A plate of a hull: what is known of its shape, and how sure that is."""
    assert COARSE == 0.2


def test_a_plate_of_a_hull_judged_areas() -> None:
    """A plate of a hull judged: areas, what is in doubt, class, axis, strains."""
    assert (doubled_band(1e-3, 5e-4), doubled_band(1e-3, 3e-3), doubled_band(1e-3, None)) == (
        0.001,
        0.004,
        0.001,
    )


def test_what_to_do_with_a_plate_of_a_class() -> None:
    """What to do with a plate of a class: advice, which a yard replaces by its own."""
    assert suggestions_with({"flat": "cut and ship"})["flat"] == "cut and ship"


def test_which_part_of_the_developable_region_of_a_plate() -> None:
    """Which part of the developable region of a plate is flat."""
    x, y = np.mgrid[0:6:4j, -1:1:4j]
    # z = y**3 / 15, curvature 0.4 y
    cubic = np.array([-1.0, 1.0, -1.0, 1.0]) / 15.0
    nodes = curvature_nodes(Patches.single(np.stack([x, y, cubic + 0.0 * x], axis=-1)))
    assert round(flat_share(nodes, 1e-3, 0.04), 2) == pytest.approx(0.1, abs=0.1)


def test_what_kind_of_plate_shares_of_its_area_make() -> None:
    """What kind of plate shares of its area make it: flat, cylinder, saddle, convex or mixed."""
    inflected = PlateShares(convex=0.0, saddle=0.0, cylinder=0.94, flat=0.06, unresolved=0.0)
    assert (inflected.kind(0.95), inflected.rollable(0.95), inflected.order(0.95)) == (
        "mixed",
        True,
        2,
    )


def test_springs_between_neighbours_of_a_grid_on_a_surface() -> None:
    """Springs between neighbours of a grid on a surface: along, across and on both diagonals."""
    fine = np.zeros((5, 3, 3))
    fine[..., 0], fine[..., 1] = np.mgrid[0:5, 0:3] / 2.0
    assert_array_equal(springs_of(fine).along, [[1.0, 1.0], [1.0, 1.0]])


def test_a_grid_of_points_of_a_surface_laid_flat() -> None:
    """A grid of points of a surface, laid flat so that lengths between neighbours change
    least."""
    angle, z = np.meshgrid(np.linspace(0.0, 3.0, 81), np.linspace(0.0, 1.0, 17), indexing="ij")
    flat = flatten_grid(springs_of(np.stack([np.cos(angle), np.sin(angle), z], axis=-1)))
    assert round(float(flat.place[-1, 4, 0] - flat.place[0, 4, 0]), 6) == 3.0


def test_girth_over_the_patches_of_a_hull_how_far() -> None:
    """Girth over the patches of a hull: how far a place lies from the lowest point of its
    section."""
    x, z = np.mgrid[0:30:4j, 0:3:4j]
    side = Patches.single(np.stack([x, 5.0 + 0.0 * x, z], axis=-1))
    assert girth_of(side).b[0, 0].round(9).tolist() == [0.0, 1.0, 2.0, 3.0]


def test_patches_beside_borders_of_blocks_and_tangent_corners_there() -> None:
    """Patches beside borders of blocks and tangent corners: there curvature is that of the
    joint."""
    x, z = np.mgrid[0:3:4j, 0:3:4j]
    net = np.stack([x, 0.0 * x, z], axis=-1)
    apart = net + np.array([3.0, 0.0, 0.0])
    box = np.tile([[0.0, 1.0], [0.0, 1.0]], (2, 1, 1))
    assert margin_patches(Patches(np.stack([net, apart]), box, np.array([0, 1])), ()).tolist() == [
        True,
        True,
    ]


def test_the_surface_of_a_hull_made_ready_to_be() -> None:
    """The surface of a hull made ready to be cut: Bezier patches, places in x, z and girth,
    curvature."""
    x, z = np.mgrid[0:30:4j, 0:3:4j]
    shell = HullShell.of((SplineSurface.bezier(np.stack([x, 1.0 + 0.0 * x, z], axis=-1), "side"),))
    assert (len(shell.patches), float(shell.nodes.area.sum().round(9))) == (1, 90.0)


def test_plates_of_a_hull_as_a_table_names_units() -> None:
    """Plates of a hull as a table: names, units, text."""
    assert [column.name for column in HULL_COLUMNS][:4] == ["name", "range", "area", "length"]


def test_plates_of_a_hull_cut_at_planes_and_lines() -> None:
    """Plates of a hull: cut at planes and lines of girth, judged one by one."""
    x, z = np.mgrid[0:30:3j, 0:9:3j]
    side = SplineSurface.bezier(np.stack([x, 8.0 + 0.5 * z - 0.03 * z * z, z], axis=-1), "body")
    found = hull_plates((side,), HullSeams(x=(10.0, 20.0), z=3.0))
    assert ([plate.name for plate in found], found["2.1"].kind) == (
        ["1.1", "1.2", "2.1", "2.2", "3.1", "3.2"],
        "cylinder",
    )


def test_other_surfaces_of_the_same_hull_by_which_it() -> None:
    """Other surfaces of the same hull, by which it is told what its net leaves open."""
    assert every_second_waterline(ah.examples.wigley().state)[:2] == ("WL 0.625", "WL 1.875")


def test_how_far_gaussian_curvature_changes_when_the_same_lines() -> None:
    """How far Gaussian curvature changes when the same lines are fitted otherwise."""
    x, y = np.mgrid[-3:3:3j, -1:1:3j]
    flat, bowl = (
        SplineSurface.bezier(np.stack([x, y, a * (x * x + y * y)], axis=-1), "bow")
        for a in (0.0, 0.0005)
    )
    found = rival_curvature(HullShell.of((flat,)), ("bow",), (bowl,), ("bow",))
    assert (bool(np.nanmin(found) > 2e-7), int(np.isnan(found).sum())) == (True, 0)


def test_how_long_and_how_broad_a_plate() -> None:
    """How long and how broad a plate is, and the axes that directions on it are told by."""
    net = np.zeros((2, 2, 3))
    net[1, :, 0], net[:, 1, 1] = 6.0, 2.0
    axes = plate_axes(curvature_nodes(Patches.single(net)))
    assert_array_equal(axes.round(12) + 0.0, [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]])
    assert plate_extents(net, axes).round(12).tolist() == [6.0, 2.0]


def test_what_is_to_be_known_of_a_plate_slivers() -> None:
    """What is to be known of a plate: slivers, poles, squares, regions side by side."""
    assert SLIVER == 0.05


def test_one_plate_what_it_measures_which_class_it() -> None:
    """One plate: what it measures, which class it is, how it may be formed."""
    x, y = np.mgrid[0:6:3j, 0:2:3j]
    (plate,) = ah.surface.plates(np.stack([x, y, 0.1 * x * y], axis=-1))
    assert plate.roll_axis is not None
    assert (plate.kind, plate.order, round(plate.roll_axis, 1)) == ("saddle", 3, 135.7)


def test_a_plate_made_of_a_surface_the_regions() -> None:
    """A plate made of a surface, the regions that were found on it, and curvature at nodes."""
    assert (radius_of(0.2), radius_of(1e-12)) == (5.0, None)


def test_seams_lines_of_constant_parameter_that_cut_a_surface() -> None:
    """Seams: lines of constant parameter that cut a surface into plates."""
    net = np.zeros((2, 2, 3))
    net[1, :, 0], net[:, 1, 1] = 6.0, 2.0
    shell = SplineSurface.bezier(net, "shell")
    assert [plate.name for plate in cut_at_seams(shell, Seams(u=(0.25, 0.5)))] == [
        "shell 1",
        "shell 2",
        "shell 3",
    ]


def test_rows_of_plates_as_a_table_names_units_text() -> None:
    """Rows of plates, as a table: names, units, text."""
    assert [column.name for column in COLUMNS][:4] == ["name", "area", "length", "breadth"]


def test_plates_of_a_shell_regions_classes_roll_axes() -> None:
    """Plates of a shell: regions, classes, roll axes and strains of surfaces, one row a plate."""
    x, y = np.mgrid[-3:3:3j, -1:1:3j]
    found = ah.surface.plates(np.stack([x, y, 0.2 * np.abs(y)], axis=-1))
    assert (found[0].kind, found[0].roll_axis, found[0].suggestion) == (
        "cylinder",
        0.0,
        "roll or press-brake about the roll axis, to the radii given",
    )
