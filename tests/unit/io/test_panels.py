"""Files of panels: written, read back by content, and refused with a reason where damaged."""

from __future__ import annotations

import gzip
import random
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from assoc_hull.analysis.panels.hull_panels import panels
from assoc_hull.analysis.panels.mesh_quality import panel_report
from assoc_hull.errors import AssocHullError, BadInputError
from assoc_hull.geometry.surfaces.panel_mesh import PanelMesh, below_water
from assoc_hull.hull import Hull
from assoc_hull.hull.sources import examples
from assoc_hull.io.panels.formats import PANEL_FORMS, panel_bytes, read_panels, write_panels

TEXT = ("nemoh", "wamit", "hams", "stl-text")


@pytest.fixture(scope="module")
def mesh(series60_70: Hull) -> PanelMesh:
    """Half a ship with a few triangles."""
    return panels(series60_70, count=200)


@pytest.mark.parametrize("form", ["nemoh", "wamit", "hams"])
@pytest.mark.parametrize("side", ["half", "full"])
def test_a_mesh_comes_back_to_the_last_digit_written(
    form: str, side: str, mesh: PanelMesh, tmp_path: Path
) -> None:
    """Panel by panel, with its symmetry; and written again it is the same file."""
    given_mesh = mesh if side == "half" else mesh.whole()
    path = tmp_path / f"mesh{PANEL_FORMS[form]}"
    write_panels(given_mesh, path)
    again = read_panels(path)
    assert (again.mirror_x, again.mirror_y) == (False, side == "half")
    assert again.count == given_mesh.count
    wanted = np.round(given_mesh.xyz, 6)[given_mesh.panel]
    assert (_from_least(again.xyz[again.panel]) == _from_least(wanted)).all()
    assert panel_report(again).watertight
    write_panels(again, tmp_path / "again", form)
    once_more = read_panels(tmp_path / "again")
    assert (once_more.xyz == again.xyz).all()
    assert (once_more.panel == again.panel).all()


@pytest.mark.parametrize("form", ["nemoh", "hams"])
def test_numbers_of_many_vertices_stand_apart(form: str, tmp_path: Path) -> None:
    """A file names vertices by numbers of six digits as well, with room between them."""
    x = np.arange(50_002.0)
    row = np.stack([x, np.ones(len(x)), -np.ones(len(x))], axis=1)
    last = len(x) - 2
    panel = [[last + len(x), last, last + 1, last + 1 + len(x)]]
    wide = PanelMesh(np.concatenate([row, row + np.array([0.0, 0.0, 1.0])]), np.array(panel))
    write_panels(wide, tmp_path / "wide", form)
    again = read_panels(tmp_path / "wide")
    assert again.count == 1
    assert again.area == pytest.approx(1.0, abs=1e-9)


def test_the_highest_frequency_is_that_of_the_shortest_wave(mesh: PanelMesh) -> None:
    """In deep water a wave is 2 pi g / omega^2 long; the shortest is six diagonals."""
    report = panel_report(mesh)
    wave = 2.0 * np.pi * 9.80665 / report.highest_frequency**2
    assert wave == pytest.approx(6.0 * report.diagonal, rel=1e-12)


def test_a_panel_with_one_dry_corner_keeps_the_rest() -> None:
    """What is left has five corners: a quadrilateral and a triangle."""
    side = np.array([[0.0, 1, -2], [4, 1, -2], [4, 1, 2], [0, 1, -1]])
    left = below_water(PanelMesh(side, np.array([[3, 2, 1, 0]])))
    # The trapezium less the triangle above z = 0, 2 m high and 8 / 3 m long.
    assert left.area == pytest.approx(10.0 - 0.5 * 2.0 * 8.0 / 3.0, abs=1e-12)
    assert (left.count, int(left.triangle.sum())) == (2, 1)


def _from_least(corner: np.ndarray) -> np.ndarray:
    """Corners of panels in an order that does not depend on the first one."""
    key = corner[:, :, 0] * 1e8 + corner[:, :, 1] * 1e3 + corner[:, :, 2]
    order = np.argsort(key, axis=1)
    return np.take_along_axis(corner, order[:, :, None], axis=1)


@pytest.mark.parametrize("form", ["stl", "stl-text"])
def test_triangles_are_the_whole_ship(form: str, mesh: PanelMesh, tmp_path: Path) -> None:
    """STL knows no symmetry: both sides are written, closed, to its own precision."""
    path = tmp_path / "mesh.stl"
    write_panels(mesh, path, form)
    again = read_panels(path)
    whole = mesh.whole()
    assert again.triangle.all()
    assert again.count == 2 * whole.count - whole.triangle.sum()
    assert panel_report(again).outward
    assert_allclose(again.volumes, mesh.volumes, rtol=2e-3)
    write_panels(again, path, form)
    once_more = read_panels(path)
    assert (once_more.xyz == again.xyz).all()
    assert (once_more.panel == again.panel).all()


def test_both_symmetries_are_kept_where_the_form_has_them(tmp_path: Path) -> None:
    """A quarter of a box stays one for WAMIT and HAMS; Nemoh gets the half."""
    corner = np.array([[0.0, 1, -2], [5, 1, -2], [5, 1, 0], [0, 1, 0]])
    quarter = PanelMesh(corner, np.array([[3, 2, 1, 0]]), mirror_x=True, mirror_y=True)
    for form, count, flags in (
        ("wamit", 1, (True, True)), ("hams", 1, (True, True)), ("nemoh", 2, (False, True)),
    ):  # fmt: skip
        write_panels(quarter, tmp_path / form, form)
        again = read_panels(tmp_path / form)
        assert (again.count, again.mirror_x, again.mirror_y) == (count, *flags)
        assert again.area == pytest.approx(40.0)
        assert again.volumes[1] == pytest.approx(quarter.volumes[1])


def test_the_boat_has_the_published_volume(data_folder: Path) -> None:
    """500 panels of capytaine's boat; below the water 933.77 m3, by x, by y and by z."""
    boat = read_panels(data_folder / "panels" / "capytaine_boat_200.mar.gz")
    assert boat.count == 500
    assert not boat.mirror_y
    wet = below_water(boat)
    report = panel_report(wet)
    assert report.outward
    assert_allclose(wet.volumes, 933.77, rtol=0.0, atol=0.005)
    told = panel_report(boat)
    assert told.above > 0
    assert told.edges.above > 0
    assert not told.watertight


DAMAGED = [
    ("", "no file of panels"),
    ("ship\n1 9.81\n", "no file of panels"),
    ("2 0\n1 0 0 0\n2 1 0 0\n3 1 1 0\n", "not closed"),
    ("2 0\n1 0 0 0\n2 1 0 0\n3 1 1 0\n0 0 0 0\n1 2 3 4\n0 0 0 0\n", "line 6.*vertices 1 to 3"),
    ("2 0\n1 0 0 0\n2 1 0 0\n3 1 1 0\n0 0 0 0\n1 2 0 3\n0 0 0 0\n", "names vertex 0"),
    ("2 0\n1 0 0 0\n3 1 0 0\n0 0 0 0\n", "vertex 2 has the number 3"),
    ("2 0\n1 0 0 nan\n0 0 0 0\n", "'nan' is not a number"),
    ("2 0\n1 0 0 0\n2 1e9 0 0\n0 0 0 0\n", "line 3"),
    ("2 0\n1 0 0 0\n2 1 0 0\n3 1 1 0\n0 0 0 0\n1 2 2 1\n0 0 0 0\n", "no panels"),
    ("2 0\n1 0 0 0\n2 1 0 0\n3 1 1 0\n0 0 0 0\n1 2 3\n0 0 0 0\n", "names 3 of 4"),
    ("boat\n1 9.81\n0 0\n1\n0 0 0 1 0 0 1 1 0\n", "9 numbers of 12"),
    ("boat\n1 9.81\n0 0\n0\n", "0 panels"),
    ("boat\n1 9.81\n0 0\n999999999\n0 0 0\n", "3 numbers of 11999999988"),
    ("boat\n1 9.81\n0 0\n1\n0 0 0 1 0 0 1 1 inf 0 1 0\n", "'inf' is not a number"),
    ("Hull Mesh File\n#\n1 3 0\n", "four numbers"),
    ("Hull Mesh File\n#\n1 3 0 2\n1 0 0 0\n2 1 0 0\n3 1 1 0\n1 3 1 2 3\n", "symmetries"),
    ("Hull Mesh File\n#\n1 3 0 0\n1 0 0 0\n2 1 0 0\n3 1 1 0\n", "3 lines for 3 vertices"),
    ("Hull Mesh File\n#\n1 3 0 0\n1 0 0 0\n2 1 0 0\n3 1 1 0\n1 5 1 2 3\n", "neither 3 nor 4"),
    ("Hull Mesh File\n#\n1 3 0 0\n1 0 0 0\n2 1 0 0\n3 1 1 0\n1 4 1 2 3\n", "names 3 of 4"),
    ("Hull Mesh File\n#\n1 3 0 0\n1 0 0 0\n2 1 0 0\n3 1 1 0\n1 3 1 2 7\n", "vertices 1 to 3"),
    ("solid x\nfacet\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\n", "cut short"),
    ("solid x\nfacet\nvertex 0 0\nendsolid\n", "line 3"),
    ("solid x\nendsolid\n", "no triangles"),
]


@pytest.mark.parametrize(("text", "told"), DAMAGED)
def test_a_damaged_file_is_refused_with_the_reason(text: str, told: str, tmp_path: Path) -> None:
    """What is wrong, and in which line; nothing is guessed."""
    path = tmp_path / "mesh.txt"
    path.write_text(text)
    with pytest.raises(BadInputError, match=told) as caught:
        read_panels(path)
    assert "mesh.txt" in str(caught.value)


def test_names_and_forms_are_checked(mesh: PanelMesh, tmp_path: Path) -> None:
    """An ending that tells no form, a form that is none, a file that is not there or not whole."""
    with pytest.raises(BadInputError, match="tells no form"):
        write_panels(mesh, tmp_path / "mesh.dat")
    with pytest.raises(BadInputError, match="format"):
        write_panels(mesh, tmp_path / "mesh.mar", "aqwa")
    with pytest.raises(BadInputError, match="cannot be read"):
        read_panels(tmp_path / "none.mar")
    packed = gzip.compress(panel_bytes(mesh, "nemoh"))
    (tmp_path / "whole.mar.gz").write_bytes(packed)
    assert read_panels(tmp_path / "whole.mar.gz").count == mesh.count
    (tmp_path / "cut.mar.gz").write_bytes(packed[:-500])
    with pytest.raises(BadInputError, match="cannot be read"):
        read_panels(tmp_path / "cut.mar.gz")


@pytest.fixture(scope="module")
def small_files() -> list[bytes]:
    """A small mesh in every form."""
    small = panels(examples.wigley(), stations=4, points=4)
    return [panel_bytes(small, form) for form in PANEL_FORMS]


@given(seed=st.integers(0, 2**32 - 1))
def test_no_damage_leads_to_anything_but_a_mesh_or_a_reason(
    seed: int, small_files: list[bytes], tmp_path_factory: pytest.TempPathFactory
) -> None:
    """Bytes changed, left out, doubled, cut off, words put in: a mesh comes, or a named error."""
    chance = random.Random(seed)
    path = tmp_path_factory.getbasetemp() / "damaged"
    for data in small_files:
        found = bytearray(data)
        for _ in range(chance.randint(1, 6)):
            at, size = chance.randrange(len(found) + 1), chance.randint(0, 40)
            words = [
                b"", b"nan", b"-1", b"1e999", b" 99999999999 ", b"\xff\x00", b"1_0", b"\n",
                bytes(found[at : at + size]), bytes([chance.randrange(256)]), b" 0 0 0 0\n",
            ]  # fmt: skip
            found[at : at + chance.choice([0, 1, size])] = chance.choice(words)
        path.write_bytes(found[: chance.choice([len(found), chance.randrange(len(found) + 1)])])
        try:
            mesh = read_panels(path)
        except AssocHullError:
            continue
        assert np.isfinite(mesh.xyz).all()
        panel_report(mesh)


SQUARE = [[0.0, 1, -2], [5, 1, -2], [5, 1, 0], [0, 1, 0]]


@pytest.mark.parametrize(
    ("xyz", "panel", "told"),
    [
        (SQUARE, [[0, 1, 2, 4]], "corner that is none of the 4"),
        (SQUARE, [[0, 1, 2, -1]], "corner that is none of the 4"),
        (SQUARE, [[0, 1, 1, 2]], "names a corner twice"),
        (SQUARE, [[0, 1, 2, 0]], "names a corner twice"),
        (SQUARE, [[0.5, 1, 2, 3]], "have shape"),
        (SQUARE, [], "have shape"),
        (SQUARE, "abcd", "have shape"),
        ("abcd", [[0, 1, 2, 2]], "not finite"),
        ([[0, 1]], [[0, 1, 2, 2]], "have shape"),
        ([[np.inf, 0, 0], *SQUARE], [[0, 1, 2, 3]], "vertex 1 is not finite"),
        ([[1e7, 0, 0], *SQUARE], [[0, 1, 2, 3]], "farther than"),
    ],
)
def test_what_is_no_mesh_is_refused(xyz: object, panel: object, told: str) -> None:
    """Numbers of corners, shapes and places are looked at when a mesh is made."""
    with pytest.raises(BadInputError, match=told):
        PanelMesh(xyz, panel)


def test_a_mesh_is_frozen_and_its_own() -> None:
    """What is handed in stays as it was, and writable; the mesh does not."""
    xyz, panel = np.array(SQUARE), np.array([[3, 2, 1, 0]])
    mesh = PanelMesh(xyz, panel)
    xyz[0], panel[0, 0] = 9.0, 2
    assert mesh.xyz[0].tolist() == [0.0, 1.0, -2.0]
    assert mesh.panel[0].tolist() == [3, 2, 1, 0]
    for values in (mesh.xyz, mesh.panel):
        with pytest.raises(ValueError, match="read-only"):
            values[0] = 1
    with pytest.raises(BadInputError, match="mirror_y"):
        PanelMesh(SQUARE, [[3, 2, 1, 0]], mirror_y=1)  # type: ignore[arg-type]
