"""Files of Rhino: what is written, and what of other hands is read and told."""

from __future__ import annotations

from collections import Counter
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import rhino3dm

import assoc_hull as ah
from assoc_hull.errors import BadInputError
from assoc_hull.hull import Hull
from assoc_hull.io.digitised.read import read_lines
from assoc_hull.io.reports import ExportReport
from assoc_hull.io.rhino.read import is_rhino, read_rhino
from assoc_hull.io.slicing.surface_lines import cad_kind, faces_of_file
from tests.conftest import Shipped


@pytest.fixture(scope="module")
def hull(shipped: Shipped) -> Hull:
    """A hull of 31 lines."""
    return shipped("wigley")


@pytest.fixture(scope="module")
def ours(hull: Hull, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Its file, in millimetres."""
    path = tmp_path_factory.mktemp("rhino") / "ship.3dm"
    report: ExportReport = hull.export(path, unit="mm")
    assert (report.form, report.lines, report.left_out) == ("3dm", 31, ())
    return path


def test_lines_surface_and_mesh_are_written_by_layer(hull: Hull, ours: Path) -> None:
    """Named curves on the layer of their group, both sides of the surface, one closed mesh."""
    model = rhino3dm.File3dm.Read(str(ours))
    layers = {each.Index: each.Name for each in model.Layers}
    found = Counter(
        (layers[each.Attributes.LayerIndex], type(each.Geometry).__name__) for each in model.Objects
    )
    lines = Counter(each.group.name for each in hull.lines.values())
    assert found == {(name, "NurbsCurve"): count for name, count in lines.items()} | {
        ("surface", "NurbsSurface"): 2, ("mesh", "Mesh"): 1,
    }  # fmt: skip
    names = {e.Attributes.Name for e in model.Objects if type(e.Geometry).__name__ == "NurbsCurve"}
    assert names == {each.name for each in hull.lines.values()}
    assert model.Settings.ModelUnitSystem == rhino3dm.UnitSystem.Millimeters
    assert all(each.Geometry.IsValid for each in model.Objects)
    mesh = next(e.Geometry for e in model.Objects if isinstance(e.Geometry, rhino3dm.Mesh))
    assert mesh.IsClosed


def foreign(ours: Path, path: Path, kinds: tuple[str, ...], **changes: Any) -> Path:
    """The file as another program would have drawn it: without our texts, some kinds of objects.

    `names` False leaves names out; `dots` adds words; `hide` turns a layer off.
    """
    model, made = rhino3dm.File3dm.Read(str(ours)), rhino3dm.File3dm()
    made.Settings.ModelUnitSystem = model.Settings.ModelUnitSystem
    for each in model.Layers:
        layer = rhino3dm.Layer()
        layer.Name, layer.Visible = each.Name, each.Name != changes.get("hide")
        made.Layers.Add(layer)
    add = {"NurbsCurve": "AddCurve", "NurbsSurface": "AddSurface", "Mesh": "AddMesh"}
    for each in model.Objects:
        kind = type(each.Geometry).__name__
        if kind in kinds:
            look = rhino3dm.ObjectAttributes()
            look.LayerIndex = each.Attributes.LayerIndex
            look.Name = each.Attributes.Name if changes.get("names", True) else ""
            getattr(made.Objects, add[kind])(each.Geometry, look)
    for _ in range(changes.get("dots", 0)):
        made.Objects.AddTextDot("here", rhino3dm.Point3d(0, 0, 0), rhino3dm.ObjectAttributes())
    made.Write(str(path), 7)
    return path


def test_curves_are_lines_by_name(hull: Hull, ours: Path, tmp_path: Path) -> None:
    """Names as of any digitised lines, boundary curves too; the unit is that of the file."""
    slices = read_lines(foreign(ours, tmp_path / "a.3dm", ("NurbsCurve",), dots=2))
    wanted = {each.name for each in hull.lines.values()}
    assert {each.name for each in (*slices.lines, *slices.boundaries)} == wanted
    assert slices.high[0] - slices.low[0] == pytest.approx(100.0, abs=1e-9)
    told = [str(note) for note in slices.report.assumptions]
    assert any("2 objects: TextDot" in each for each in told)
    assert any("unit: the lines: mm, as the form has it" in each for each in told)


def test_curves_without_names_go_by_layer_and_plane(ours: Path, tmp_path: Path) -> None:
    """Sections and waterlines by their planes; curves of boundaries are told, by layer."""
    slices = read_lines(foreign(ours, tmp_path / "a.3dm", ("NurbsCurve",), names=False))
    assert Counter(each.group for each in slices.lines) == {"sections": 19, "waterlines": 10}
    assert slices["ST 50"].offset == 50.0
    (note,) = slices.report.suspicions
    assert note.where == "the layer 'boundary'"


def test_surfaces_are_taken_before_curves(hull: Hull, ours: Path, tmp_path: Path) -> None:
    """A file with surfaces is cut as STEP is; what else it holds is told."""
    path = foreign(ours, tmp_path / "a.3dm", ("NurbsCurve", "NurbsSurface", "Mesh"))
    assert cad_kind(path) == "3dm"
    faces = faces_of_file(path)
    assert len(faces.surfaces) == 2
    assert "31 curves" in " ".join(faces.notes)
    patch = hull.surface().patches[0]
    known = next(each for each in faces.surfaces if each is not None and "port" in each.name)
    assert np.abs(known.net - patch.net).max() <= 1e-12 * 100.0
    with pytest.raises(BadInputError, match="the file says that its unit is 'mm'"):
        faces_of_file(path, "m")


@pytest.mark.parametrize(
    ("kinds", "changes", "words"),
    [
        (("Mesh",), {}, "1 meshes"),
        (("NurbsSurface",), {"hide": "surface"}, "no curve and no surface"),
    ],
    ids=["meshes only", "all hidden"],
)
def test_a_file_without_lines_or_surfaces_is_refused(
    ours: Path, tmp_path: Path, kinds: tuple[str, ...], changes: dict[str, Any], words: str
) -> None:
    """The message says what it shows, and what to do."""
    path = foreign(ours, tmp_path / "a.3dm", kinds, **changes)
    with pytest.raises(BadInputError, match=words):
        ah.read(path)


def test_trimmed_faces_are_refused(tmp_path: Path) -> None:
    """Their trims are not told: the remedy is STEP, or hiding them."""
    model = rhino3dm.File3dm()
    model.Settings.ModelUnitSystem = rhino3dm.UnitSystem.Meters
    plane = rhino3dm.Plane.WorldXY()
    circle = rhino3dm.Circle(5.0)
    disc = rhino3dm.Brep.CreateTrimmedPlane(plane, circle.ToNurbsCurve())
    model.Objects.AddBrep(disc)
    model.Write(str(tmp_path / "a.3dm"), 7)
    assert len(read_rhino(tmp_path / "a.3dm").trimmed) == 1
    with pytest.raises(BadInputError, match=r"1 faces are trimmed.*export the hull as STEP"):
        ah.read(tmp_path / "a.3dm")


def test_whole_faces_of_a_polysurface_are_read(tmp_path: Path) -> None:
    """The six sides of a box are whole surfaces."""
    model = rhino3dm.File3dm()
    model.Settings.ModelUnitSystem = rhino3dm.UnitSystem.Feet
    box = rhino3dm.BoundingBox(rhino3dm.Point3d(0, -2, 0), rhino3dm.Point3d(20, 2, 3))
    model.Objects.AddBrep(rhino3dm.Brep.CreateFromBoundingBox(box))
    model.Write(str(tmp_path / "a.3dm"), 7)
    found = read_rhino(tmp_path / "a.3dm")
    assert (len(found.surfaces), found.trimmed, found.unit) == (6, (), "ft")
    assert faces_of_file(tmp_path / "a.3dm").surfaces[0] is not None


@pytest.mark.parametrize("part", [0.1, 0.5, 0.9])
def test_a_file_cut_short_is_refused(ours: Path, tmp_path: Path, part: float) -> None:
    """Half a file is none."""
    data = ours.read_bytes()
    (tmp_path / "a.3dm").write_bytes(data[: int(part * len(data))])
    assert is_rhino(tmp_path / "a.3dm")
    with pytest.raises(BadInputError):
        ah.read(tmp_path / "a.3dm")
