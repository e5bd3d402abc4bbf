"""Panels of hulls that are known by formula: how volume, area and centre come right."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from assoc_hull.analysis.panels.assemble_mesh import DivisionChoices, assemble_mesh, axes_of
from assoc_hull.analysis.panels.wet_sheets import Waterplane, bands_of_strips
from assoc_hull.geometry.curves import Strips
from assoc_hull.geometry.surfaces.panel_mesh import PanelMesh
from tests.exact_hulls import box, ellipsoid, wigley

EXACT = 4.0 / 9.0 * 100.0 * 10.0 * 6.25
"""Volume of the Wigley hull of 100 x 10 x 6.25 m."""


def divided(
    surface: Strips, plane: Waterplane, columns: int, rows: int, half: bool = False
) -> PanelMesh:
    """A hull of 100 m in columns of equal length, with points on its knuckles."""
    x = np.linspace(0.0, 100.0, columns + 1)
    every = bands_of_strips(surface, plane)
    axes = axes_of(plane, 50.0)
    chosen = DivisionChoices(rows, True, half, True, 30.0)
    return PanelMesh(*assemble_mesh(every, plane, x, chosen, 100.0, axes), mirror_y=half)


def dry_free_edges(mesh: PanelMesh) -> int:
    """Number of free edges of the whole that do not lie in the water surface."""
    whole = mesh.whole()
    return int((whole.xyz[whole.free_edges(), 2] != 0.0).any(axis=1).sum())


@pytest.mark.parametrize("half", [True, False], ids=["half", "full"])
def test_the_volume_of_the_wigley_hull_falls_right_at_second_order(half: bool) -> None:
    """With 500, 2,000 and 8,000 panels the error is a quarter each time, of 4/9 L B T."""
    errors = []
    for columns, rows in [(50, 10), (100, 20), (200, 40)]:
        mesh = divided(wigley(), Waterplane(6.25), columns, rows if half else rows // 2, half)
        assert mesh.count == columns * rows
        assert np.ptp(mesh.volumes) <= 1e-9 * EXACT
        assert dry_free_edges(mesh) == 0
        errors.append(float(mesh.volumes[0]) / EXACT - 1.0)
    print("\nvolume errors", errors, "ratios", errors[0] / errors[1], errors[1] / errors[2])
    assert errors[0] / errors[1] == pytest.approx(4.0, abs=0.1)
    assert errors[1] / errors[2] == pytest.approx(4.0, abs=0.03)


# T0, tan trim, heel; V, LCB, TCB, KB, S
REFERENCE = [
    ("W", 6.25, 0.0, 0.0, 2777.777778, 50.0, 0.0, 3.90625, 1487.906310),
    ("W", 5.75, 0.01, 10.0, 2779.14863, 51.19442708, -0.239568614, 3.934394081, 1488.460423),
    ("W", 5.0, 0.0, 20.0, 1995.705439, 50.0, -0.5894296404, 3.323434436, 1246.0485),
    ("E", 5.0, 0.0, 0.0, 3781.546713, 50.0, 0.0, 3.173076923, 1539.562361),
    ("E", 4.0, 0.02, 10.0, 3829.376232, 53.74196224, -0.8445553974, 3.305787185, 1537.571084),
    ("B", 5.0, 0.02, 0.0, 12000.0, 52.77777778, 0.0, 3.027777778, 3440.0),
    ("B", 6.0, 0.0, 20.0, 12000.0, 50.0, -2.022056857, 3.367984254, 3440.0),
    ("B", 8.0, 0.0, 40.0, 14860.20862, 50.0, -3.120100503, 4.845154051, 3973.905609),
]


@pytest.mark.parametrize("row", REFERENCE)
def test_at_any_position_panels_have_the_volume_of_the_reference(
    row: tuple[str, float, float, float, float, float, float, float, float],
) -> None:
    """Trimmed, heeled, with a wet deck: volume, centre and area within a few parts in 1e4.

    The box has its ends closed by panels; the ellipsoid's sections shrink to points.
    """
    name, height, trim, heel, volume, lcb, tcb, kb, area = row
    plane = Waterplane(height, trim, float(np.tan(np.radians(heel))))
    surface: Strips = {"W": wigley(), "E": ellipsoid(tiles=60), "B": box()}[name]
    mesh = divided(surface, plane, 130, 48)
    assert dry_free_edges(mesh) == 0
    assert_allclose(mesh.volumes, volume, rtol=8e-4)
    centre = axes_of(plane, 50.0).of_ship(np.array([[lcb, tcb, kb]]))[0]
    assert_allclose(mesh.buoyancy, centre, rtol=0.0, atol=6e-3)
    assert mesh.area == pytest.approx(area, rel=3e-3)


def test_the_box_is_exact() -> None:
    """Flat sides and ends: 100 x 20 x 6 m by any number of panels that finds the corners."""
    plane = Waterplane(6.0)
    every = bands_of_strips(box(), plane)
    chosen = DivisionChoices(8, True, True, True, 30.0)
    x = np.linspace(0.0, 100.0, 11)
    mesh = PanelMesh(
        *assemble_mesh(every, plane, x, chosen, 100.0, axes_of(plane, 0.0)), mirror_y=True
    )
    assert_allclose(mesh.volumes, 12000.0, rtol=1e-12)
    assert mesh.area == pytest.approx(3440.0, rel=1e-12)
    assert_allclose(mesh.buoyancy, [50.0, 0.0, -3.0], atol=1e-9)


def test_ends_may_stay_open() -> None:
    """Without panels over its ends the box is open there, and the fluxes of x tell."""
    plane = Waterplane(6.0)
    every = bands_of_strips(box(), plane)
    chosen = DivisionChoices(8, True, False, False, 30.0)
    x = np.linspace(0.0, 100.0, 11)
    mesh = PanelMesh(*assemble_mesh(every, plane, x, chosen, 100.0, axes_of(plane, 0.0)))
    assert dry_free_edges(mesh) == 32
    assert mesh.area == pytest.approx(3200.0, rel=1e-12)
    assert_allclose(mesh.volumes, [0.0, 12000.0, 12000.0], atol=1e-8)


def test_the_ends_of_the_ellipsoid_are_triangles() -> None:
    """A section that is a point is one vertex: as many triangles as rows meet there."""
    mesh = divided(ellipsoid(tiles=60), Waterplane(6.0), 20, 9, half=True)
    assert mesh.triangle.sum() == 2 * 9
    assert mesh.count == 20 * 9
