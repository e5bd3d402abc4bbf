"""What the parts of `surface.regions` give, one small example of each."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_array_equal

import assoc_hull as ah
from assoc_hull.geometry.patches.bezier_patches import Patches
from assoc_hull.surface.regions.curvature_regions import (
    KNOWN_TO,
    band_areas,
    keys_of,
    list_in_words,
)
from assoc_hull.surface.regions.level_lines import (
    AREAS,
    ArcPoints,
    LevelLine,
    RegionAreas,
    edge_polyline,
)
from assoc_hull.surface.regions.options import region_options, zero_band


def test_areas_of_regions_of_one_surface_or_of_many() -> None:
    """Areas of regions, of one surface or of many."""
    areas = RegionAreas(2.0, 1.0, 1.0, 0.0, 2.0, 1.0, 1e-9, 4.0)
    assert areas.positive_share == 0.5


def test_points_along_the_arcs_of_patches_kept() -> None:
    """Points along the arcs of patches, kept with what else is known of each patch."""
    place = np.array([[0.0, 0.5], [1.0, 0.5], [0.5, 0.0], [0.5, 1.0]])
    points = ArcPoints(np.array([2, 2]), place, np.zeros((4, 3)))
    chosen = ArcPoints.gathered([points], np.array([0, 1]), np.array([1]))
    assert (chosen.count.tolist(), chosen.place.tolist()) == ([2], [[0.5, 0.0], [0.5, 1.0]])


def test_what_is_kept_of_each_patch_cells_and_arcs() -> None:
    """What is kept of each patch: cells and arcs by level, areas; chosen and put in another
    order."""
    assert AREAS[:3] == ("positive", "negative", "zero")


def test_areas_inside_and_outside_a_band_from_the_areas() -> None:
    """Areas inside and outside a band, from the areas above and below each of its two limits."""
    above = np.array([[2.0, 3.0, 0, 0, 2, 3, 0, 5]])
    below = np.array([[4.0, 1.0, 0, 0, 4, 1, 0, 5]])
    assert_array_equal(band_areas(above, below)[0, :4], [2.0, 1.0, 2.0, 0.0])


def test_one_batch_of_patches_solved_polynomials_cells_arcs() -> None:
    """One batch of patches solved: polynomials, cells, arcs for each level, areas."""
    assert KNOWN_TO == 1e-09


def test_patches_taken_from_an_earlier_result_where_their_nets() -> None:
    """Patches taken from an earlier result, where their nets and the options are the same."""
    net = np.zeros((2, 2, 3))
    assert keys_of(Patches.single(net)) == keys_of(Patches.single(net.copy()))


def test_what_is_to_be_known_of_regions_searches() -> None:
    """What is to be known of regions: searches that ended early, spots, knots, borders."""
    assert list_in_words([1, 2, 3, 4, 5, 6, 7]) == "1, 2, 3, 4, 5 and 2 more"


def test_regions_of_gaussian_curvature_of_surfaces_the_face() -> None:
    """Regions of Gaussian curvature of surfaces: the face of what finds, keeps and joins them."""
    x, y = np.mgrid[0:4, 0:4] / 3.0
    net = np.stack([6 * x, 2 * y, np.zeros_like(x)], axis=-1)
    assert ah.surface.curvature_regions(net).zero == pytest.approx(12.0, abs=0.1)


def test_one_connected_piece_of_the_lines_along() -> None:
    """One connected piece of the lines along which the Gaussian curvature has a value."""
    line = np.array([[0.0, 0.0, 0.0], [3.0, 4.0, 0.0]])
    piece = LevelLine("open", 0.0, 0, (0,), (line[:, :2],), (line,), 2, ())
    assert (piece.length, piece.singular) == (5.0, False)


def test_sides_of_patches_as_polylines() -> None:
    """Sides of patches as polylines."""
    net = np.zeros((2, 2, 3))
    net[1, :, 0] = net[:, 1, 1] = 1.0
    assert_array_equal(edge_polyline(Patches.single(net), 0, 1, 0.001)[0], [[1.0, 0.0], [1.0, 1.0]])


def test_lines_of_constant_curvature_as_polylines_joined_sampled() -> None:
    """Lines of constant curvature as polylines: joined, sampled, in the order of levels and
    surfaces."""
    u, v = np.mgrid[0:4, 0:4] / 3.0
    wave = np.array([0.0, -0.5, -0.5, 0.8])[:, None]
    net = np.stack([2 * u, v, wave + 0.1 * v * (v > 0.5)], axis=-1)
    assert [
        (piece.kind, piece.level)
        for piece in ah.surface.curvature_regions(net, zero="exact").components
    ] == [("open", 0.0)]


def test_what_counts_as_no_gaussian_curvature_a_band() -> None:
    """What counts as no Gaussian curvature: a band by strain, a band as such, or nil itself."""
    assert zero_band("strain", strain_tol=1e-3, breadth=2.5).k0 == 0.00128


def test_how_finely_regions_are_searched_for_tolerances_each() -> None:
    """How finely regions are searched for: tolerances, each for one thing, none for another."""
    assert region_options(area_tol=1e-8).area_tol == 1e-08


def test_outlines_of_the_regions_of_a_surface_over() -> None:
    """Outlines of the regions of a surface, over the borders of its patches, for export."""
    u, v = np.mgrid[0:4, 0:4] / 3.0
    wave = np.array([0.0, -0.5, -0.5, 0.8])[:, None]
    net = np.stack([2 * u, v, wave + 0.1 * v * (v > 0.5)], axis=-1)
    result = ah.surface.curvature_regions(net, zero="exact")
    assert [len(result.outlines(region)) for region in ("positive", "negative", "zero")] == [
        1,
        1,
        0,
    ]
