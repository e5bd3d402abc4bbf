"""Tiles of curvature regions: they fill a patch, and none lies across a border."""

from __future__ import annotations

import numpy as np
import pytest

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.bezier_patches import Patches, curvatures
from assoc_hull.geometry.patches.cell_subdivision import subdivide_patches
from assoc_hull.geometry.patches.cells import CellKind
from assoc_hull.geometry.patches.curvature_functions import gauss_function
from assoc_hull.plot.plates.plate_picture import CurvatureTiles, tiles_of
from tests.curved_patches import patch

NAMES = ("P03_circle_loop", "P08_wavy_plate", "P20_five_arcs")


def sizes(tiles: CurvatureTiles) -> FloatArray:
    """Areas of tiles in parameters, with the sign of the way they go round."""
    first, second = (tiles.uv[:, k + 2] - tiles.uv[:, k] for k in (0, 1))
    return np.asarray(0.5 * (first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]))


@pytest.fixture(scope="module", params=[0.0, 1.28e-3], ids=["K = 0", "K = K0"])
def cut(request: pytest.FixtureRequest) -> tuple[Patches, float, CurvatureTiles]:
    """Tiles of three patches that lines of this level cut, both ways round."""
    patches = Patches(
        np.stack([patch(name) for name in NAMES]), np.tile([[0.0, 1.0]], (3, 2, 1)), np.arange(3)
    )
    cells = subdivide_patches(gauss_function(patches, request.param))
    assert {CellKind.U_SIMPLE, CellKind.V_SIMPLE} <= set(cells.kind.tolist())
    return patches, request.param, tiles_of(cells, 40)


def test_tiles_fill_each_patch_once(cut: tuple[Patches, float, CurvatureTiles]) -> None:
    """They go round anticlockwise, and their areas add up to that of the unit square."""
    patches, _, tiles = cut
    found = sizes(tiles)
    assert found.min() > 0.0
    assert np.bincount(tiles.patch, found) == pytest.approx(np.ones(len(patches)), abs=1e-9)
    assert tiles.uv.min() >= 0.0
    assert tiles.uv.max() <= 1.0


def test_no_tile_lies_across_a_border(cut: tuple[Patches, float, CurvatureTiles]) -> None:
    """K at its middle and on the way to its corners is on the side that it tells.

    But for the chord between two places on a line: a tile has straight sides.
    """
    patches, level, tiles = cut
    middle = tiles.uv.mean(axis=1, keepdims=True)
    for share, most in ((0.0, 1e-5), (0.8, 1e-4)):
        looked = (middle + share * (tiles.uv - middle)).reshape(-1, 2)
        gauss = curvatures(patches, np.repeat(tiles.patch, 4), looked).gauss.reshape(-1, 4)
        wrong = ((gauss - level) * tiles.sign[:, None] < -1e-12).any(axis=1)
        assert sizes(tiles)[wrong].sum() <= most * len(patches)
    looked = tiles.uv.reshape(-1, 2)
    gauss = curvatures(patches, np.repeat(tiles.patch, 4), looked).gauss
    beyond = (gauss - level) * np.repeat(tiles.sign, 4)
    assert beyond.min() > -1e-12 * np.abs(gauss).max()


def test_zero_and_unresolved_cells() -> None:
    """A plane is one zero cell, parted into tiles; what is unresolved gets none."""
    plane = Patches.single(patch("P13_plane"))
    tiles = tiles_of(subdivide_patches(gauss_function(plane, 0.0, 1e-9)), 4)
    assert (len(tiles), set(tiles.sign.tolist())) == (16, {0})
    monkey = subdivide_patches(gauss_function(Patches.single(patch("P02_monkey")), 0.0), depth=6)
    box = monkey.box[monkey.kind == CellKind.UNRESOLVED]
    assert len(box)
    lost = np.prod(box[..., 1] - box[..., 0], axis=1).sum()
    assert sizes(tiles_of(monkey, 4)).sum() == pytest.approx(1.0 - lost, abs=1e-12)
