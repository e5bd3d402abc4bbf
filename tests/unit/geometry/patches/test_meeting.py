"""Points brought into planes on a surface, and triangles of surfaces that belong together."""

from __future__ import annotations

import numpy as np
import pytest

from assoc_hull.geometry.patches.plane_intersection import intersect_plane, surface_derivatives
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.geometry.patches.triangulation import (
    Facets,
    facets_of,
    joined_facets,
    outward_parts,
    stitch_facets,
)
from assoc_hull.geometry.surfaces.triangles import boundary_edges
from tests import cad_hulls
from tests.unit.io.slicing.test_surface_slices import wigley


def test_slopes_are_those_of_the_surface() -> None:
    """By differences, also of a rational surface in several spans."""
    rng = np.random.default_rng(3)
    ku, kv = np.array([0, 0, 0, 0.3, 0.7, 1, 1, 1]), np.array([0, 0, 0, 0, 0.5, 1, 1, 1, 1])
    net, weights = rng.normal(size=(5, 5, 3)), rng.uniform(0.5, 2.0, (5, 5))
    surface = SplineSurface("any", (2, 3), ku, kv, net, weights)
    uv = rng.uniform(0.02, 0.98, (40, 2))
    r, ru, rv = surface_derivatives(surface, uv)
    assert np.abs(r - surface.at(*uv.T)).max() < 1e-12
    for slope, way in ((ru, [1e-6, 0.0]), (rv, [0.0, 1e-6])):
        ahead, back = surface.at(*(uv + way).T), surface.at(*(uv - way).T)
        assert np.abs(slope - (ahead - back) / 2e-6).max() < 1e-7 * np.abs(ru).max()


def test_a_point_on_a_border_stays_there() -> None:
    """The end of a station on the deck edge is found along the deck edge."""
    surface = cad_hulls.side()
    found = intersect_plane(surface, [[0.7, 0.0], [0.7, 0.1]], [0, 0], [60.0, 60.0])
    assert np.abs(found.xyz[:, 0] - 60.0).max() < 1e-9
    assert found.uv[0, 1] == 0.0
    assert abs(found.uv[1, 1] - 0.1) > 1e-3


def test_a_point_can_be_asked_into_two_planes() -> None:
    """Both are met, by Newton's method in both parameters."""
    found = intersect_plane(wigley(), [[0.4, 0.3]], [0], [45.0], ([True], 2, 3.0))
    assert np.abs(found.xyz[0, [0, 2]] - [45.0, 3.0]).max() < 1e-12


def test_a_plane_that_misses_is_told() -> None:
    """The point stays in the domain, and how far it is off is given."""
    found = intersect_plane(wigley(), [[0.9, 0.3]], [0], [110.0])
    assert found.off[0] == pytest.approx(10.0)
    assert found.uv[0, 0] == 1.0


def plate(y: float, *, turned: bool = False) -> SplineSurface:
    """A level strip of 10 m x 1 m, or upside down."""
    net = np.zeros((2, 2, 3))
    net[..., 0], net[..., 1] = np.mgrid[0:20:10, y : y + 2 : 1][:, :2, :2]
    return SplineSurface.bezier(net[::-1].copy() if turned else net)


def test_parts_that_touch_nowhere_face_away_from_the_middle() -> None:
    """Whichever way a file has them."""
    high = [
        SplineSurface.bezier(plate(0.0, turned=turn).net + np.array([0, 0, 5]))
        for turn in (False, True)
    ]
    for one in high:
        found = outward_parts(facets_of([one, plate(0.0)], 0.01, 2.0))
        up = found.mesh.area_vectors()[:, 2]
        assert (up[found.surface == 0] > 0.0).all()
        assert (up[found.surface == 1] < 0.0).all()
        corners = [one, plate(0.0)]
        for number, surface in enumerate(corners):
            uv = found.uv[found.surface == number]
            there = surface.at(uv[..., 0], uv[..., 1])
            assert np.abs(there - found.mesh.corners[found.surface == number]).max() < 1e-12


@pytest.mark.parametrize(("gap", "sewn"), [(0.0, True), (0.9e-3, True), (1.2e-3, False)])
def test_borders_are_sewn_within_reach(gap: float, sewn: bool) -> None:
    """However each was parted; a wider gap stays open, and no triangle is lost."""
    coarse = facets_of([plate(0.0)], 0.01, 4.0)
    both = facets_of([plate(0.0), plate(1.0 + gap)], 0.01, 4.0)
    fine = facets_of([plate(1.0 + gap)], 0.01, 1.7)
    assert len(fine.mesh.face) > len(coarse.mesh.face)
    for facets in (both, _together(coarse, fine)):
        found = stitch_facets(facets, 1e-3)
        edges = found.mesh.xyz[boundary_edges(found.mesh)]
        inner = np.abs(edges[:, :, 1] - 1.0).max(axis=1) < 2e-3
        assert bool(inner.any()) != sewn
        area = np.linalg.norm(found.mesh.area_vectors(), axis=1).sum()
        assert area == pytest.approx(20.0, abs=0.02)


def _together(one: Facets, other: Facets) -> Facets:
    """Triangles of two surfaces, each parted in its own way."""
    parts = []
    for facets in (one, other):
        corner = facets.mesh.corners.reshape(-1, 3)
        parts.append((corner, np.arange(len(corner)).reshape(-1, 3), facets.uv.reshape(-1, 2)))
    return joined_facets(parts)
