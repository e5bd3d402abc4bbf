"""On smooth analytic hulls no feature is found: no corner, no straight run, no arc."""

import numpy as np
import pytest

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.polylines.circular_arcs import find_arcs
from assoc_hull.geometry.polylines.corners import find_corners
from assoc_hull.geometry.polylines.noise import point_scatter
from assoc_hull.geometry.polylines.operations import cumulative_lengths, resample
from assoc_hull.geometry.polylines.straight_runs import find_straight_runs
from assoc_hull.geometry.surfaces.triangles import Triangles
from assoc_hull.io.slicing.features import plane_columns
from assoc_hull.io.slicing.mesh_lines import slice_mesh
from tests import meshes
from tests.long_forms import LONG

SEEDS = 200 if LONG else 17
"""Each of 17 lines comes once, with `make test-long` twelve times."""
NOISE = 1e-3


def lines_of(mesh: Triangles) -> list[FloatArray]:
    """Sections, waterlines and buttocks of a fine mesh in their planes, points 0.2 m apart."""
    slices = slice_mesh(mesh, stations=9, waterlines=5, buttocks=3)
    found = []
    for line in slices.lines:
        points = line.pieces[0].points[:, plane_columns(line.group)]
        length = float(cumulative_lengths(points)[-1])
        found.append(resample(points, np.linspace(0.0, length, max(60, round(length / 0.2)))))
    return found


@pytest.mark.parametrize(
    "mesh",
    [pytest.param(meshes.wigley_half(641, 161), id="Wigley"),
     pytest.param(meshes.ellipsoid_half(641, 193), id="ellipsoid")],
)  # fmt: skip
def test_nothing_false_is_found(mesh: Triangles) -> None:
    """At 1 mm noise, many seeds over 17 lines: nothing is found. No section here is a circle."""
    lines = lines_of(mesh)
    count = {"corners": 0, "runs": 0, "arcs": 0}
    for seed in range(SEEDS):
        line = lines[seed % len(lines)]
        noisy = line + np.random.default_rng(seed).normal(0.0, NOISE, line.shape)
        noise = point_scatter(noisy)
        count["corners"] += len(find_corners(noisy, noise))
        count["runs"] += len(find_straight_runs(noisy, noise))
        count["arcs"] += len(find_arcs(noisy, noise))
    print(f"\n{SEEDS} seeds over {len(lines)} lines: {count}")
    assert count == {"corners": 0, "runs": 0, "arcs": 0}
