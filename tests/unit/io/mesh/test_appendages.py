"""Deck houses, rudders and fins on a mesh are no hull; a hull heeled in its file is turned."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.surfaces.triangles import (
    Triangles,
    boundary_edges,
    grid_triangles,
    merge_vertices,
)
from assoc_hull.io.lines.slices import HullSlices
from assoc_hull.io.mesh.frame import refuse_tilt
from assoc_hull.io.slicing.mesh_lines import slice_mesh
from tests import meshes

CUTS: dict[str, Any] = {"stations": [25.0, 50.0, 75.0], "waterlines": [2.0, 4.0], "buttocks": [2.0]}


def together(*parts: Triangles) -> Triangles:
    """Several meshes as one."""
    start = np.cumsum([0, *(len(part.xyz) for part in parts)])
    face = np.concatenate([part.face + n for part, n in zip(parts, start, strict=False)])
    return merge_vertices(np.concatenate([part.xyz for part in parts]), face)


def block(*ends: tuple[float, float]) -> Triangles:
    """A closed box from place to place along x, y and z."""
    return meshes.box(*(np.array(end) for end in ends))


def housed(first: float, last: float, height: float) -> Triangles:
    """A closed Wigley hull with a house that is one surface with its deck."""
    hull = meshes.closed_wigley()
    centre = hull.corners.mean(axis=1)
    flat = (hull.corners[:, :, 2] == meshes.T).all(axis=1)
    under = flat & (first < centre[:, 0]) & (centre[:, 0] < last) & (np.abs(centre[:, 1]) < 2.0)
    plate = hull.part(under)
    roof = plate.moved(plate.xyz + np.array([0.0, 0.0, height]))
    walls = [
        grid_triangles(np.array([[roof.xyz[i], roof.xyz[j]], [hull.xyz[i], hull.xyz[j]]]))
        for i, j in boundary_edges(plate).tolist()
    ]
    return together(hull.part(~under), roof, *walls)


def same_lines(found: HullSlices, hull: HullSlices) -> None:
    """All lines lie where those of the bare hull do, within 1 mm."""
    for one, other in zip(found.lines, hull.lines, strict=True):
        assert (one.name, len(one.pieces)) == (other.name, len(other.pieces))
        for mine, theirs in zip(one.pieces, other.pieces, strict=True):
            mine_ends, their_ends = mine.points[[0, -1]], theirs.points[[0, -1]]
            np.testing.assert_allclose(mine_ends, their_ends, rtol=0.0, atol=1e-3)
    np.testing.assert_allclose(found.low, hull.low, rtol=0.0, atol=1e-3)
    np.testing.assert_allclose(found.high, hull.high, rtol=0.0, atol=1e-3)


def port_half(mesh: Triangles) -> Triangles:
    """What is left of a mesh without the triangles in the centre plane."""
    return mesh.part((mesh.corners[:, :, 1] != 0.0).any(axis=1))


HULL = meshes.closed_wigley()
HOUSES: dict[str, Callable[[], Triangles]] = {
    "house, a part of its own": lambda: together(
        HULL, block((80.0, 88.0), (-1.0, 1.0), (6.25, 16.0))
    ),
    "house of one surface with the deck": lambda: housed(60.0, 85.0, 4.0),
    "house that holds more than the hull": lambda: housed(20.0, 80.0, 14.0),
    "half a hull with half a house": lambda: together(
        meshes.wigley_half(), port_half(block((80.0, 88.0), (0.0, 1.0), (6.25, 16.0)))
    ),
}


@pytest.mark.parametrize("name", HOUSES)
def test_a_house_is_left_out_and_told(name: str) -> None:
    """Lines, ends and bow are those of the bare hull, and a repair tells where the house stands."""
    found = slice_mesh(HOUSES[name](), **CUTS)
    same_lines(found, slice_mesh(HULL, **CUTS))
    (note,) = (each for each in found.report.repairs if each.kind == "superstructure")
    assert "of the file on the deck left out" in note.what
    assert "upside down" not in found.report.kinds("repairs")
    assert found.report.suspicions == ()


def test_rudder_and_bilge_keels_are_left_out_under_suspicion() -> None:
    """Lines are those of the bare hull; what may have been of the hull is told with its place."""
    keel = block((40.0, 60.0), (4.0, 5.5), (2.0, 2.1))
    other = meshes.moved(keel, lambda xyz: xyz * np.array([1.0, -1.0, 1.0]))
    rudder = block((-1.0, 1.0), (-0.2, 0.2), (0.5, 5.0))
    found = slice_mesh(together(HULL, keel, other, rudder), **CUTS)
    same_lines(found, slice_mesh(HULL, **CUTS))
    (note,) = found.report.suspicions
    assert note.kind == "appendage"
    assert "3 parts" in note.what
    assert "from (-1, -0.2, 0.5) to (1, 0.2, 5)" in note.what


def test_patches_of_one_hull_are_no_appendages() -> None:
    """Open parts beside an open hull stay: a hull exported patch by patch."""
    half = meshes.wigley_half()
    low = half.corners.mean(axis=1)[:, 2] < 1.0
    gap = half.part(~low).moved(half.xyz + np.array([0.0, 0.0, 0.002]))
    report = slice_mesh(together(half.part(low), gap), **CUTS).report
    assert "appendage" not in report.kinds()


def rolled(degrees: float, axis: int) -> Callable[[FloatArray], FloatArray]:
    """Turn points about an axis of the file."""
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    one, other = [each for each in range(3) if each != axis]
    turn = np.eye(3)
    turn[one, one] = turn[other, other] = c
    turn[one, other], turn[other, one] = -s, s
    return lambda xyz: np.asarray(xyz @ turn.T)


@pytest.mark.parametrize(
    ("degrees", "axis", "words"),
    [
        (2.0, 0, "heeled by 2 degrees"),
        (0.3, 0, "heeled by 0.3 degrees"),
        (2.0, 2, "yawed by 2 deg"),
    ],
)
def test_a_tilted_hull_is_turned_upright(degrees: float, axis: int, words: str) -> None:
    """A whole hull heeled or yawed is turned by its plane of symmetry, and the angle is told."""
    tilted = meshes.moved(HULL, rolled(degrees, axis))
    found = slice_mesh(tilted, **CUTS)
    same_lines(found, slice_mesh(HULL, **CUTS))
    (note,) = (each for each in found.report.repairs if each.kind == "tilt")
    assert words in note.what


def test_tilted_surfaces_are_refused_by_the_angle() -> None:
    """Surfaces are not turned: what to do is said, and an upright hull is not refused."""
    refuse_tilt(HULL, "the surfaces")
    with pytest.raises(BadInputError, match=r"heeled by 2 degrees.*turn it upright"):
        refuse_tilt(meshes.moved(HULL, rolled(2.0, 0)), "the surfaces")
