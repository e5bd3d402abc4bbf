"""Surfaces of a hull cut into lines: exact points, sewn borders, what a file may have wrong."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.io.cad.faces import HullFaces
from assoc_hull.io.iges.write import iges_text
from assoc_hull.io.lines.slices import HullSlices
from assoc_hull.io.slicing.surface_lines import read_surface_lines, slice_surfaces
from tests import cad_hulls, meshes

CUTS: dict[str, Any] = {"stations": [25.0, 50.0, 75.0], "waterlines": [2.0, 4.0], "buttocks": [2.0]}
FEW: dict[str, Any] = {"stations": 7, "waterlines": [2.0, 5.0], "buttocks": 1}


def wigley() -> SplineSurface:
    """Half the Wigley hull of `meshes`, exactly, normals out of it."""
    x, z = np.meshgrid(np.linspace(0, meshes.L, 3), [meshes.T, meshes.T / 2, 0.0], indexing="ij")
    y = np.zeros((3, 3))
    y[1, :2] = meshes.B
    return SplineSurface.bezier(np.stack([x, y, z], axis=2), "wigley")


def parted() -> list[SplineSurface]:
    """The same in three pieces, of which one meets two others along one side."""
    whole = wigley()
    upper, lower = whole.restricted((0, 1), (0, 0.4)), whole.restricted((0, 1), (0.4, 1))
    return [upper, lower.restricted((0, 0.37), (0.4, 1)), lower.restricted((0.37, 1), (0.4, 1))]


def cut(surfaces: list[SplineSurface], cuts: dict[str, Any] = CUTS, **options: Any) -> HullSlices:
    """Lines of surfaces in metres."""
    return slice_surfaces(HullFaces.of(surfaces, "m"), **cuts, **options)


def check_wigley(slices: HullSlices) -> None:
    """Every line is one piece, lies on the formula to rounding, and is well covered."""
    for line in slices.lines:
        (piece,) = line.pieces
        x, y, z = piece.points.T
        assert np.abs(y - meshes.wigley_y(x, z)).max() < 1e-9
        assert len(piece.points) > 30
        assert not {"loose"} & set(piece.ends)


@pytest.mark.parametrize("surfaces", [[wigley()], parted()], ids=["one surface", "parted"])
def test_points_lie_on_the_surface(surfaces: list[SplineSurface]) -> None:
    """Not on triangles, which lie 1 mm inside; pieces of a hull are one hull."""
    slices = cut(surfaces)
    check_wigley(slices)
    assert not slices.facets
    assert not slices.report.suspicions
    assert [len(each.pieces) for each in slices.boundaries] == [1, 1]


@pytest.mark.parametrize("scale", [1 / 16, 1.0, 2.25], ids=["model", "ship", "long ship"])
def test_chords_between_the_points_of_a_line_lie_close_to_the_surface(scale: float) -> None:
    """What is fitted to the points follows the surface between them, within 2 mm of a ship."""
    shrunk = cad_hulls.moved([wigley()], lambda net: net * scale)
    places = {name: [scale * each for each in places] for name, places in CUTS.items()}
    for line in cut(shrunk, places).lines:
        points = line.pieces[0].points
        x, y, z = 0.5 * (points[1:] + points[:-1]).T / scale
        assert np.abs(y - meshes.wigley_y(x, z)).max() < 2e-3 * min(1.0, 1.0 / scale)


def test_a_hull_in_other_axes_is_cut_exactly() -> None:
    """Turned, moved and at model scale, in every way at once."""
    shrunk = cad_hulls.moved(
        parted(), lambda net: (net * [-1, -1, 1] + [30.0, 0, -4])[..., [0, 2, 1]] / 20.0
    )
    places: dict[str, Any] = {"stations": [-5.0, 45.0], "waterlines": [-2.0], "buttocks": [2.0]}
    slices = cut(shrunk, places, scale=20.0, axes="-x-z+y")
    for line in slices.lines:
        x, y, z = line.pieces[0].points.T
        assert np.abs(y - meshes.wigley_y(x + 30.0, z + 4.0)).max() < 1e-9


def test_a_surface_across_the_centre_plane_is_cut_at_it() -> None:
    """Both halves in one surface: stations begin at y = 0, on the surface, not on a triangle."""
    t, t2 = np.array([-1.0, 0, 1]), np.array([1.0, -1, 1])
    x, y, z = np.linspace(0, 100.0, 3), np.array([0.0, 12, 0]), 6.0 * t2
    net = np.stack(np.broadcast_arrays(x[:, None], y[:, None] * t, z[None]), axis=2)
    slices = cut(
        [SplineSurface.bezier(net, "both")],
        {"stations": [20.0, 50.0], "waterlines": [3.0], "buttocks": [2.0]},
    )
    for line in slices.lines:
        for piece in line.pieces:
            x, y, z = piece.points.T
            breadth = 0.24 * x * (1.0 - x / 100.0)
            assert np.abs(y**2 - breadth**2 * z / 6.0).max() < 1e-9
    for line in slices.group("sections"):
        assert np.abs(line.pieces[0].points[0, 1:]).max() < 1e-12


CHANGES: dict[str, tuple[Callable[[FloatArray], FloatArray], str]] = {
    "bow at negative x": (lambda net: net * [-1, 1, 1], "bow at negative x"),
    "half to starboard": (lambda net: net * [1, -1, 1], "mirrored"),
    "keel up": (lambda net: net * [1, 1, -1], "upside down"),
    "y up": (lambda net: net[..., [0, 2, 1]], "axes"),
    "off its centre plane": (lambda net: net + np.array([0, 3, 0]), "centre plane"),
}


@pytest.fixture(scope="module")
def true_lines() -> HullSlices:
    """Lines of the small ship as it should come."""
    slices = cut(cad_hulls.port(), FEW)
    assert not slices.report.repairs
    assert not slices.report.suspicions
    return slices


def check_same(slices: HullSlices, other: HullSlices) -> None:
    """Both have lines at the same places: every point of one lies on the polyline of the other."""
    for one, two in zip(slices.lines, other.lines, strict=True):
        assert one.name == two.name
        for piece, true in zip(one.pieces, two.pieces, strict=True):
            assert np.abs(np.ptp(piece.points, axis=0) - np.ptp(true.points, axis=0)).max() < 5e-3
            ends = piece.points[[0, -1]] - true.points[[0, -1]]
            assert np.abs(ends).max() < 5e-3


@pytest.mark.parametrize("name", CHANGES)
def test_a_hull_that_lies_otherwise_is_turned_and_told(name: str, true_lines: HullSlices) -> None:
    """The lines are those of the ship as it should come, and the report names what was done."""
    change, kind = CHANGES[name]
    slices = cut(cad_hulls.moved(cad_hulls.port(), change), FEW)
    assert kind in slices.report.kinds("repairs")
    check_same(slices, true_lines)


def test_both_halves_give_the_lines_of_one(true_lines: HullSlices) -> None:
    """The starboard half is seen, and is not cut."""
    slices = cut([*cad_hulls.port(), *cad_hulls.starboard()], FEW)
    (kind,) = (note.what for note in slices.report.assumptions if note.kind == "half or whole")
    assert "whole" in kind
    check_same(slices, true_lines)


def test_a_half_that_is_there_twice_is_taken_once(true_lines: HullSlices) -> None:
    """The report names it."""
    slices = cut([*cad_hulls.port(), *cad_hulls.port()], FEW)
    assert slices.report.kinds("repairs") == ("duplicate",)
    check_same(slices, true_lines)


def written(path: Path, surfaces: list[SplineSurface], unit: str = "m") -> Path:
    """An IGES file of surfaces."""
    path.write_text(iges_text(surfaces, unit))
    return path


@pytest.mark.parametrize(("factor", "message"), [
    pytest.param(1e3, "are these millimetres", id="millimetres"),
    pytest.param(1e-3, "are these metres", id="model of a model"),
])  # fmt: skip
def test_one_unit_taken_for_another_is_refused(tmp_path: Path, factor: float, message: str) -> None:
    """A file that declares metres and holds others makes a ship of no ship's length."""
    surfaces = cad_hulls.moved(cad_hulls.port(), lambda net: net * factor)
    with pytest.raises(BadInputError, match=message):
        ah.read(written(tmp_path / "ship.igs", surfaces))


def test_the_unit_of_the_file_is_used_and_told(tmp_path: Path) -> None:
    """In millimetres, it is the same hull; another unit is refused, and a scale mends the file."""
    path = written(tmp_path / "ship.igs", [wigley()], "mm")
    assert "mm: the hull is 100 m long" in str(read_surface_lines(path, **CUTS).report)
    wrong = cad_hulls.moved([wigley()], lambda net: net * 1e3)
    path = written(tmp_path / "w.igs", wrong, "m")
    with pytest.raises(BadInputError, match=r"says that its unit is 'm'.*scale=0\.001"):
        read_surface_lines(path, unit="mm", **CUTS)
    check_wigley(read_surface_lines(path, scale=0.001, **CUTS))


@pytest.mark.parametrize("form", ["igs", "stl"])
def test_a_hull_without_its_bottom_is_refused(tmp_path: Path, form: str) -> None:
    """How much is missing, and where, is named: a volume of it would be wrong unseen."""
    path = tmp_path / f"ship.{form}"
    if form == "igs":
        written(path, [cad_hulls.side()])
    else:
        from assoc_hull.geometry.patches.triangulation import facets_of

        meshes.write(facets_of([cad_hulls.side()], 0.01, 2.0).mesh, path)
    with pytest.raises(BadInputError, match=r"bottom is missing.* of 7 begin off .* \(ST"):
        ah.read(path, stations=7, waterlines=[3.0], buttocks=0, axes="+x+y+z")


def apart(gap: float) -> list[SplineSurface]:
    """The small ship with its side higher than its bottom."""
    return [
        cad_hulls.bottom(),
        *cad_hulls.moved([cad_hulls.side()], lambda net: net + np.array([0, 0, gap])),
    ]


def test_gaps_between_faces_are_joined_and_tabled() -> None:
    """20 mm: every section is one piece, with its gap in the table."""
    slices = cut(apart(0.02), {"stations": 7, "waterlines": 0, "buttocks": 0})
    assert {len(line.pieces) for line in slices.lines} == {1}
    gaps = {join.line: join.gap for join in slices.joins if join.line.startswith("ST")}
    assert len(gaps) == 6  # one station stands ahead of the bottom
    assert max(gaps.values()) == pytest.approx(0.02, abs=1e-3)
    assert "hole" in slices.report.kinds()
    assert "bottom missing" not in slices.report.kinds()


def test_wide_gaps_are_refused() -> None:
    """150 mm: the line and the place are named."""
    with pytest.raises(BadInputError, match=r"two ends 150 mm apart at .*in ST"):
        cut(apart(0.15), {"stations": 7, "waterlines": 0, "buttocks": 0})


def test_a_model_is_read_as_finely_as_a_ship() -> None:
    """Limits shrink with the hull: the lines of a model of 2.5 m are those of the ship."""
    model = cad_hulls.moved(parted(), lambda net: net / 40.0)
    slices = slice_surfaces(
        HullFaces.of(model, "m"), stations=[0.625, 1.25], waterlines=[0.05], buttocks=0
    )
    assert slices.gaps.join == pytest.approx(0.0015)
    for line in slices.lines:
        x, y, z = 40.0 * line.pieces[0].points.T
        assert np.abs(y - meshes.wigley_y(x, z)).max() < 1e-9
