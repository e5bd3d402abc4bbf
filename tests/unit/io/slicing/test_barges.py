"""Barges as meshes: flat sides, square corners and end plates come in exactly."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.geometry.surfaces.triangles import Triangles, grid_triangles, merge_vertices
from tests import meshes
from tests.long_forms import long_form

LENGTH, BREADTH, DEPTH, DRAUGHT = 60.0, 12.0, 4.0, 2.5
CUTS: dict[str, Any] = {"stations": 7, "waterlines": 3, "buttocks": 3}


def barge(rake: float, foot: float, cells: int) -> Triangles:
    """A closed box with rakes of a length at both ends, above plates from `foot` up; m."""
    x = np.interp(
        np.linspace(0.0, 3.0, 3 * cells + 1), range(4), [0.0, rake, LENGTH - rake, LENGTH]
    )
    z = np.interp(x, [0.0, rake, LENGTH - rake, LENGTH], [foot, 0.0, 0.0, foot])
    t = np.linspace(0.0, 1.0, cells + 1)
    along, across = np.meshgrid(x, t, indexing="ij")
    low = np.repeat(z[:, None], cells + 1, axis=1)
    half = np.full_like(along, 0.5 * BREADTH)
    grids = [
        np.stack([along, half * across, low], axis=2),
        np.stack([along, half, low + (DEPTH - low) * across], axis=2),
        np.stack([along, half[:, ::-1] * across[:, ::-1], np.full_like(along, DEPTH)], axis=2),
    ]
    for end, turned in ((0.0, True), (LENGTH, False)):
        y, up = np.meshgrid(0.5 * BREADTH * t, foot + (DEPTH - foot) * t, indexing="ij")
        plate = np.stack([np.full_like(y, end), y, up], axis=2)
        grids.append(plate[:, ::-1] if turned else plate)
    parts = [grid_triangles(grid) for grid in grids]
    start = np.cumsum([0, *(len(part.xyz) for part in parts)])
    face = np.concatenate([part.face + n for part, n in zip(parts, start, strict=False)])
    return meshes.mirrored(merge_vertices(np.concatenate([part.xyz for part in parts]), face))


def volume(rake: float, foot: float) -> float:
    """What a barge displaces at the draught, m3."""
    cut = rake * DRAUGHT / foot if foot > DRAUGHT else rake
    deep = DRAUGHT if foot > DRAUGHT else foot
    under = cut * (DRAUGHT - 0.5 * deep)
    return BREADTH * ((LENGTH - 2.0 * rake) * DRAUGHT + 2.0 * under)


@pytest.mark.parametrize(
    ("rake", "foot", "cells", "cuts"),
    [
        pytest.param(20.0, 0.0, 1, CUTS, id="box of few triangles"),
        pytest.param(20.0, 0.0, 6, CUTS, id="box of many triangles", marks=long_form),
        pytest.param(8.0, 0.8, 1, {}, id="slight rakes", marks=long_form),
        pytest.param(8.0, 3.0, 6, {}, id="rakes through the water", marks=long_form),
    ],
)
def test_a_barge_comes_in_right(
    rake: float, foot: float, cells: int, cuts: dict[str, Any], tmp_path: Path
) -> None:
    """V within .01 %, LCB amidships; CB up to 1 is no fault, and surface and mesh can be made."""
    path = meshes.write(barge(rake, foot, cells), tmp_path / "barge.stl")
    hull = ah.read(path, length=LENGTH, draught=DRAUGHT, **cuts)
    found = hull.hydrostatics()
    assert found.volume == pytest.approx(volume(rake, foot), rel=1e-4)
    assert found.cb <= 1.0 + 1e-6
    assert hull.adoption is not None
    assert any("bow end: the mesh: a flat of" in note for note in hull.adoption.notes)
