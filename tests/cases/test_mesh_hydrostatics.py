"""Published meshes measured below their published planes."""

import gzip
from pathlib import Path

import numpy as np
import pytest

from assoc_hull.analysis.hydrostatics.mesh_flotation import mesh_flotation
from assoc_hull.geometry.floating.immersion import FloatingPlanes
from assoc_hull.geometry.surfaces.triangles import Triangles
from assoc_hull.io.mesh.read import read_triangles


def test_the_container_ship_clipped_directly_has_the_published_values(data_folder: Path) -> None:
    """Duisburg Test Case, 1:59.407, 14.5 m above its lowest point: V, LCB and S to 1e-6."""
    mesh = read_triangles(data_folder / "dtc" / "DTC-scaled.stl.gz")
    hull = mesh_flotation(59.407 * mesh.xyz, mesh.face)
    found = hull.measure(FloatingPlanes(np.array([14.5]), np.zeros(1), np.zeros(1)))
    assert found.volume[0] == pytest.approx(173398.1, rel=1e-6)
    assert found.moment_x[0] / found.volume[0] == pytest.approx(174.0565, rel=1e-6)
    assert found.shell[0] == pytest.approx(22044.3, rel=1e-6)


def read_panels(path: Path) -> Triangles:
    """Read the quadrilaterals of a Nemoh file as two triangles each: places, then numbers."""
    rows = [line.split() for line in gzip.decompress(path.read_bytes()).decode().splitlines()[1:]]
    end = next(i for i, row in enumerate(rows) if row[0] == "0")
    xyz = np.array([row[1:] for row in rows[:end]], np.float64)
    quads = np.array(rows[end + 1 : -1]).astype(np.int64) - 1
    return Triangles(xyz, np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]]))


def test_a_boat_of_panels_has_its_published_volume(data_folder: Path) -> None:
    """500 panels with masts and houses above water, open where these stand: 933.77 m3."""
    mesh = read_panels(data_folder / "panels" / "capytaine_boat_200.mar.gz")
    hull = mesh_flotation(mesh.xyz, mesh.face)
    found = hull.measure(FloatingPlanes(np.zeros(1), np.zeros(1), np.zeros(1)))
    assert found.volume[0] == pytest.approx(933.77, abs=5e-3)
