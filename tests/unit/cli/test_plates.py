"""The command `plates`: surfaces in, a table, a map and plates laid flat out."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import pytest
from jsonschema import Draft202012Validator

import assoc_hull as ah
from assoc_hull.cli import main
from assoc_hull.cli.plates import _UNITS
from assoc_hull.io.surfaces.surface_file import write_surfaces
from assoc_hull.io.tables.plates import hull_plates_schema, plates_schema
from assoc_hull.io.units import METRES
from tests.unit.cli.conftest import Json


@pytest.fixture
def shell(tmp_path: Path) -> Path:
    """The plates that ship, as a table."""
    path = tmp_path / "shell.csv"
    write_surfaces(ah.examples.typical_plates(), path)
    return path


def test_the_command_knows_every_unit() -> None:
    """The list that starts without loading the readers is theirs."""
    assert tuple(METRES) == _UNITS


def test_words_are_those_of_the_object(shell: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The table, advice with its caveat, the band, and notes: on standard output."""
    assert main(["plates", str(shell)]) == 0
    words, problems = capsys.readouterr()
    assert words == f"{ah.surface.plates(ah.examples.typical_plates())}\n"
    assert "Advice only" in words
    assert problems == ""


def test_all_files_are_written_and_named(shell: Path, facts: Json, tmp_path: Path) -> None:
    """The document on standard output is the one in the file, and valid; files are named."""
    out, flat = tmp_path / "plates.json", tmp_path / "flat.csv"
    found = facts("plates", shell, "-o", out, "--development", flat)
    Draft202012Validator(plates_schema()).validate(found)
    assert found.pop("saved") == [str(out), str(flat)]
    assert json.loads(out.read_text()) == found
    rows = list(csv.reader(flat.read_text().splitlines()[3:]))
    assert {row[0] for row in rows} == {each["name"] for each in found["plates"]}


def test_every_option_reaches_the_plates(shell: Path, facts: Json) -> None:
    """As if they were given to the function."""
    found = facts(
        "plates", shell, "--zero", "absolute", "--k0", 0.002, "--delta", 1e-6, "--share", 0.9,
        "--sagitta-tol", 0.01, "--area-tol", 1e-4, "--seams-u", 0.5, "--seams-v", 0.25, 0.5,
        "--unit", "m",
    )  # fmt: skip
    assert len(found["plates"]) == 6 * 2 * 3
    assert {plate["k0"] for plate in found["plates"]} == {0.002}
    assert found["search"]["delta"] == 1e-6
    assert found["search"]["area_tol"] == 1e-4
    assert found["options"]["share"] == 0.9
    assert found["options"]["sagitta_tol"] == 0.01
    found = facts("plates", shell, "--strain-tol", 0.002, "--breadth", "own")
    assert found["options"]["breadth"] is None
    assert found["search"]["strain_tol"] == 0.002
    found = facts("plates", shell, "--breadth", 2, "--unit", "cm")
    assert found["options"]["breadth"] == 2.0
    assert found["plates"][0]["length"] == pytest.approx(0.08)


def test_notes_on_the_file_are_told(
    facts: Json, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    """In words and in the document."""
    path = tmp_path / "shell.igs"
    write_surfaces(ah.examples.typical_plates(), path)
    note = "shell.igs says that its unit is m; it is read in ft, as asked."
    assert note in facts("plates", path, "--unit", "ft")["notes"]
    capsys.readouterr()
    assert main(["plates", str(path), "--unit", "ft"]) == 0
    assert note in capsys.readouterr().out


def test_surfaces_are_turned_into_another_form(shell: Path, facts: Json, tmp_path: Path) -> None:
    """Those that were read, cut at the seams that are given."""
    path = tmp_path / "cut.igs"
    assert facts("plates", shell, "--surfaces", path, "--seams-u", 0.5)["saved"] == [str(path)]
    found = ah.surface.read_surfaces(path)
    assert len(found) == 12
    assert found[0].name == "flat of side 1"
    assert found[0].domain == ((0.0, 0.5), (0.0, 1.0))


def test_a_map_and_a_sheet_are_drawn(facts: Json, tmp_path: Path) -> None:
    """A picture of the ending that is asked for; a PDF in place of the table."""
    path, plate = tmp_path / "map.svg", tmp_path / "plate.csv"
    write_surfaces(ah.examples.typical_plates()[:1], plate)
    sheet = tmp_path / "plates.pdf"
    found = facts("plates", plate, "-o", sheet, "--picture", path, "--breadth", "own")
    assert found["saved"] == [str(sheet), str(path)]
    assert sheet.read_bytes().startswith(b"%PDF")
    assert path.read_text().startswith("<?xml")


def test_plates_that_ship_are_written(facts: Json, tmp_path: Path) -> None:
    """In each form, for the command to read."""
    for name in ("a.csv", "a.json", "a.igs"):
        path = tmp_path / name
        found = facts("example", "typical-plates", "-o", path)
        assert found["saved"] == [str(path)]
        assert [each.name for each in ah.surface.read_surfaces(path)] == found["surfaces"]


@pytest.mark.parametrize(
    ("words", "problem"),
    [
        pytest.param(["-o", "plates.xls"], "end the name in .csv or .json or .pdf", id="table"),
        pytest.param(["--picture", "map.txt"], "end the name in .pdf or .svg", id="picture"),
        pytest.param(["--development", "flat.json"], "end the name in .csv", id="flat"),
        pytest.param(
            ["--surfaces", "nets.stp"], "end the name in .csv or .json or .igs", id="nets"
        ),
        pytest.param(["-o", "no/plates.csv"], "make the folder first", id="folder"),
        pytest.param(["-o", "shell.csv"], "another file of this command", id="itself"),
        pytest.param(["-o", "a.pdf", "--picture", "a.pdf"], "another file of this", id="twice"),
        pytest.param(["--breadth", "wide"], "is no length, and not 'own'", id="breadth"),
        pytest.param(["--zero", "absolute"], "give k0, 1/m2", id="no K0"),
        pytest.param(["--k0", "1"], "leave k0 out", id="K0 that is not used"),
        pytest.param(["--share", "0.2"], "above 0.5", id="share"),
        pytest.param(["--seams-u", "2"], "does not cut it", id="seam"),
        pytest.param(["--unit", "yd"], "--unit", id="unit"),
    ],
)
def test_what_cannot_be_is_refused_in_a_line(
    shell: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    words: list[str],
    problem: str,
) -> None:
    """Exit 2, and no file but the surfaces."""
    monkeypatch.chdir(shell.parent)
    before = shell.read_bytes()
    assert main(["plates", shell.name, *words]) == 2
    told = capsys.readouterr().err
    assert problem in told
    assert told.count("\n") == 1
    assert [path.name for path in shell.parent.iterdir()] == ["shell.csv"]
    assert shell.read_bytes() == before


def test_a_hull_is_cut_by_butts_and_seams(hull: Path, facts: Json, tmp_path: Path) -> None:
    """As the function finds it; the file has what is printed. Ranges have a step."""
    out = tmp_path / "plates.json"
    found = facts(
        "plates", hull, "--butts", "30:50:10", "--seams-girth", 2, 4, "--inside", "--one-fit",
        "--strain-tol", 0.002, "--share", 0.9, "-o", out,
    )  # fmt: skip
    Draft202012Validator(hull_plates_schema()).validate(found)
    assert found.pop("saved") == [str(out)]
    assert json.loads(out.read_text()) == found
    assert [plate["name"] for plate in found["plates"]] == ["1.1", "2.1"]
    assert found["plates"][0]["range"] == "x 30 to 40 m, girth 2 to 4 m"
    assert found["seams"] == {"x": [30, 40, 50], "z": [], "girth": [2, 4], "inside": True}
    assert (found["fits"], found["search"]["strain_tol"], found["options"]["share"]) == (
        0,
        2e-3,
        0.9,
    )


@pytest.mark.parametrize(
    ("words", "problem"),
    [
        pytest.param([], "give --butts, --seams-z or --seams-girth", id="nothing cuts it"),
        pytest.param(["--seams-u", "0.5"], "--seams-u does not go with a hull", id="parameters"),
        pytest.param(["--unit", "m"], "--unit does not go with a hull", id="unit"),
        pytest.param(["--zero", "exact"], "--zero exact does not go", id="no band"),
        pytest.param(["--breadth", "own"], "--breadth own does not go", id="own breadths"),
        pytest.param(["--butts", "1:2"], "give LOW:HIGH:STEP", id="range without step"),
        pytest.param(["--butts", "0:1e9:1e-3"], "give LOW:HIGH:STEP", id="a billion"),
        pytest.param(["--butts", "bow"], "is no place in m", id="word"),
        pytest.param(["-o", "plates.xls"], "end the name in .csv", id="table"),
        pytest.param(["-o", "ship.hull.json"], "another file of this command", id="itself"),
    ],
)
def test_what_does_not_go_with_a_hull_is_refused(
    hull: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    words: list[str],
    problem: str,
) -> None:
    """In a line, before anything is computed."""
    monkeypatch.chdir(hull.parent)
    assert main(["plates", hull.name, *words]) == 2
    told = capsys.readouterr().err
    assert problem in told
    assert told.count("\n") == 1


def test_butts_do_not_go_with_surfaces(shell: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Which have parameters instead."""
    assert main(["plates", str(shell), "--butts", "3"]) == 2
    assert "--butts goes with a hull" in capsys.readouterr().err
