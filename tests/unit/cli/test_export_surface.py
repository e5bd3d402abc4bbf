"""The commands `surface`, and `export` to CAD files, meshes and drawings."""

import sys
from collections.abc import Callable
from importlib import resources
from pathlib import Path

import pytest
from jsonschema import Draft202012Validator

import assoc_hull as ah
from assoc_hull.cli import main
from assoc_hull.cli.export import _ENDINGS, _FORMS, _SURFACES
from assoc_hull.cli.surface import every_fourth
from assoc_hull.errors import BadInputError
from assoc_hull.hull import Hull
from assoc_hull.hull.sources import examples
from assoc_hull.io.export.write import ENDINGS, FORMS, export_form
from assoc_hull.io.surfaces.hull_surface import (
    SURFACE_ENDINGS,
    SURFACE_FORMS,
    fitted_surface_schema,
)
from assoc_hull.io.tables.json_schema import dumps_schema
from tests.unit.cli.conftest import Json


@pytest.fixture(scope="module")
def small_bytes(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    """A small hull as a file holds it."""
    path = tmp_path_factory.mktemp("hulls") / "small.hull.json"
    examples.wigley(stations=9, waterlines=6).save(path)
    return path.read_bytes()


@pytest.fixture
def small(tmp_path: Path, small_bytes: bytes) -> Path:
    """A hull file of this test's own."""
    path = tmp_path / "small.hull.json"
    path.write_bytes(small_bytes)
    return path


def test_the_command_knows_the_forms_of_its_writers() -> None:
    """The lists that start without loading the writers are theirs."""
    assert (*FORMS, *SURFACE_FORMS) == _FORMS
    assert tuple(_SURFACES) == SURFACE_FORMS
    assert {**ENDINGS, **SURFACE_ENDINGS} == _ENDINGS
    for ending in SURFACE_ENDINGS:
        with pytest.raises(BadInputError, match=r"hull.surface\(\).write"):
            export_form(f"ship{ending}")


@pytest.mark.parametrize(
    ("name", "form", "unit", "told"),
    [
        pytest.param("a.step", "step", "mm", {"faces": 2, "shells": 1}, id="STEP"),
        pytest.param("a.igs", "iges", "mm", {"faces": 2, "shells": 0}, id="IGES"),
        pytest.param("a.stl", "stl", "m", {"groups": ["shell", "deck"]}, id="STL"),
        pytest.param("a.glb", "glb", "m", {"groups": ["shell", "deck"]}, id="glTF"),
    ],
)
def test_the_ending_chooses_the_form(
    small: Path, facts: Json, tmp_path: Path, name: str, form: str, unit: str,
    told: dict[str, object],
) -> None:  # fmt: skip
    """Surfaces in mm, meshes in m, both sides; the report tells what is in the file."""
    pytest.importorskip("OCP" if form in ("step", "iges") else "trimesh")
    found = facts("export", small, "-o", tmp_path / name)["export"]
    assert (found["form"], found["unit"], found["half"]) == (form, unit, False)
    assert {key: found[key] for key in told} == told
    assert found["size"] == (tmp_path / name).stat().st_size


def test_half_unit_and_points_are_those_of_the_call(
    small: Path, facts: Json, tmp_path: Path
) -> None:
    """The port half, in mm, of a coarser mesh; bare surfaces without a library."""
    whole = facts("export", small, "-o", tmp_path / "a.ply")["export"]
    half = facts(
        "export", small, "-o", tmp_path / "b.ply", "--half", "--unit", "mm", "--points", 2,
        "--accept",
    )["export"]  # fmt: skip
    assert (half["half"], half["unit"], half["volume"]) == (True, "mm", None)
    assert 7 * half["triangles"] < whole["triangles"]
    bare = facts(
        "export", small, "-o", tmp_path / "a.igs", "--format", "iges-surfaces", "--unit", "m",
        "--half",
    )["export"]  # fmt: skip
    assert (bare["faces"], bare["unit"], bare["control_point_error"]) == (1, "m", 0.0)


def test_words_say_what_was_written(
    small: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A person reads whether the mesh is closed, or the shell one."""
    assert main(["export", str(small), "-o", str(tmp_path / "a.obj")]) == 0
    assert "shell, deck\nclosed, 48" in capsys.readouterr().out
    assert main(["export", str(small), "-o", str(tmp_path / "a.obj"), "--half"]) == 0
    assert "the port half, open in the centre plane\n" in capsys.readouterr().out
    pytest.importorskip("OCP")
    assert main(["export", str(small), "-o", str(tmp_path / "a.step")]) == 0
    out = capsys.readouterr().out
    assert "2 faces, both sides, 21" in out
    assert "1 shell, 3 joined edges, 2 free" in out
    assert "(step, mm)" in out


def test_views_choose_the_drawing(small: Path, facts: Json, tmp_path: Path) -> None:
    """Lines in their places, or a plan; letters by the scale."""
    pytest.importorskip("ezdxf")
    out = tmp_path / "a.dxf"
    assert facts("export", small, "-o", out)["export"]["form"] == "dxf"
    assert facts("export", small, "-o", out, "--views", "3d")["export"]["form"] == "dxf"
    plan = facts("export", small, "-o", out, "--views", "2d", "--unit", "mm", "--scale", 50)
    assert plan["export"]["form"] == "dxf-plan"
    text = out.read_text()
    assert "Scale 1:50" in text
    assert text.partition("$INSUNITS")[2].split()[:2] == ["70", "4"]


def test_a_surface_is_fitted_told_and_written(small: Path, facts: Json, tmp_path: Path) -> None:
    """One document: blocks with residuals, also of lines that were left out, and files."""
    found = facts(
        "surface", small, "-o", tmp_path / "a.igs", "--leave-out", "WL 2.5", "ST 3"
    )  # fmt: skip
    Draft202012Validator(fitted_surface_schema()).validate(found)
    assert sorted(found["left_out"]) == ["ST 3", "WL 2.5"]
    kinds = [each["kind"] for block in found["blocks"] for each in block["residuals"]]
    assert kinds == ["fitted", "left out"]
    assert found["saved"] == [str(tmp_path / "a.igs")]


def test_a_surface_with_crossing_halves_is_written_if_it_is_accepted(
    shipped: Callable[[str], ah.Hull], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Refused with code 3, no file, and the place and size of each fault; following it works."""
    ship, out = tmp_path / "ship.hull.json", tmp_path / "a.igs"
    shipped("plain_ship").save(ship)
    asked = ["export", str(ship), "-o", str(out), "--format", "iges-surfaces"]
    assert main(asked) == 3
    told = capsys.readouterr()
    assert "stern counter: waves across the centre plane by 6.24 mm at (2.96, -0.01, 4.28)" in (
        told.out
    )
    assert f"not written: {out}" in told.out
    assert "--accept" in told.err
    assert not out.exists()
    assert main(["surface", str(ship), "-o", str(out)]) == 3
    assert not out.exists()
    assert main([*asked, "--accept"]) == 0
    assert out.stat().st_size > 0


def test_the_schema_beside_the_module_is_the_one_in_use() -> None:
    """If not: ``python -m assoc_hull schema --of hull-surface -o`` writes it."""
    Draft202012Validator.check_schema(fitted_surface_schema())
    shipped = resources.files("assoc_hull.io").joinpath("hull_surface.schema.json")
    assert shipped.read_text("utf-8") == dumps_schema(fitted_surface_schema())


def test_every_fourth_line_is_left_out(
    small: Path, capsys: pytest.CaptureFixture[str], series60_70: Hull
) -> None:
    """Sections and waterlines by place; the last of each, which bound the surface, stay."""
    assert main(["surface", str(small), "--leave-out", "every-fourth"]) == 0
    assert "left out of the fit: ST 4, WL 5" in capsys.readouterr().out
    names = every_fourth(series60_70)
    assert (names[0], names[-1], len(names)) == ("ST 0.75", "WL 1.08", 14)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["export", "-o", "a.xyz"], r".glb, or choose the format"),
        (["export", "-o", "a.csv", "--half"], "--half is for surfaces and meshes"),
        (["export", "-o", "a.csv", "--unit", "mm"], "--unit is for drawings"),
        (["export", "-o", "a.step", "--points", "2"], "--points is for meshes"),
        (["export", "-o", "a.step", "--views", "2d"], "--views chooses the views of a drawing"),
        (["export", "-o", "a.csv", "--accept"], "--accept is for surfaces and meshes"),
        (["surface", "--accept"], "--accept is for a file"),
        (["export", "-o", "a.dxf", "--scale", "100"], "add --views 2d"),
        (["export", "-o", "a.dxf", "--views", "2d", "--scale", "0"], "scale is 0"),
        (["export", "-o", "a.dxf", "--biarcs", "1mm", "--views", "2d"], "--views is none of arcs"),
        (["export", "-o", "a.dxf", "--biarcs", "1mm", "--unit", "mm"], "--unit is none of arcs"),
        (["export", "-o", "a.glb", "--unit", "mm"], "unit is 'mm'"),
        (["export", "-o", "a.stl", "--points", "3"], "3 points to an edge"),
        (["surface", "-o", "a.csv"], "end it in .step"),
        (["surface", "--unit", "m"], "--unit is for a file"),
        (["surface", "--half"], "--half is for a file"),
        (["surface", "--leave-out", "WL 99"], "'WL 99'"),
        (["surface", "--picture", "a.dxf"], ".pdf or .svg or .png"),
    ],
)
def test_options_that_do_not_fit_are_refused(
    small: Path,
    tmp_path: Path,
    arguments: list[str],
    words: str,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """One line, before anything is computed; no file."""
    monkeypatch.chdir(tmp_path)
    assert main([arguments[0], str(small), *arguments[1:]]) == 2
    error = capsys.readouterr().err
    assert words in error
    assert len(error.splitlines()) == 1
    assert list(tmp_path.iterdir()) == [small]


@pytest.mark.parametrize(
    ("name", "library", "extra"),
    [("a.step", "OCP", "cad"), ("a.glb", "trimesh", "mesh"), ("a.dxf", "ezdxf", "dxf")],
)
def test_a_missing_library_is_named_with_its_extra(
    small: Path,
    tmp_path: Path,
    name: str,
    library: str,
    extra: str,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """One line says what to install."""
    for known in [each for each in sys.modules if each.split(".")[0] == library]:
        monkeypatch.delitem(sys.modules, known)
    monkeypatch.setitem(sys.modules, library, None)
    assert main(["export", str(small), "-o", str(tmp_path / name)]) == 2
    error = capsys.readouterr().err
    assert f"pip install 'assoc-hull[{extra}]'" in error
    assert len(error.splitlines()) == 1
    assert not (tmp_path / name).exists()
