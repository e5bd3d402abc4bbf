"""Importing a mesh from the command line."""

import io
import json
import re
import sys
from pathlib import Path

import pytest

import assoc_hull as ah
from assoc_hull.cli import main, output
from assoc_hull.errors import BadInputError
from assoc_hull.hull import Hull
from assoc_hull.io.slicing.read import read_slices
from tests import meshes
from tests.unit.io.slicing.test_mesh import torn


def test_a_mesh_is_imported_with_its_report(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The hull and a report with assumptions, smoothing and adoption are written."""
    mesh = meshes.write(meshes.closed_wigley(121, 31), tmp_path / "w.stl.gz")
    out, report = tmp_path / "w.hull.json", tmp_path / "r.json"
    arguments = ["--stations", "7", "--waterlines", "2,4", "--buttocks", "1", "--draught", "5"]
    code = main(["import", str(mesh), "-o", str(out), "--report", str(report), *arguments])
    assert code == 0, capsys.readouterr().err
    facts = json.loads(report.read_text())
    assert (facts["format"], facts["schema"]) == ("assoc-hull report", 1)
    assert {
        "slices", "joins", "gaps", "rules", "tolerances", "noise", "facet_depth", "smoothing",
        "knuckles", "adoption", "bands", "adopted", "inflections",
    } <= set(facts)  # fmt: skip
    assert len(facts["bands"]) == len(facts["smoothing"]) == len(facts["adoption"]["lines"])
    text = capsys.readouterr().out
    rows = [row.split() for row in text.splitlines()]
    for line, piece in zip(facts["adoption"]["lines"], facts["smoothing"], strict=True):
        words = line["line"].split()
        (row,) = (each for each in rows if each[: len(words)] == words and ">" in each)
        assert row[len(words)] == str(piece["given"])
        assert f"{1e3 * line['deviation']:.2f}" in row
        assert row[-3:] == [str(line["inflections_given"]), ">", str(line["inflections"])]
    hull = ah.open(out)
    assert hull.particulars.draught == 5.0
    assert hull.check() == ()
    same = ah.read(mesh, stations=7, waterlines=[2.0, 4.0], buttocks=1, draught=5.0)
    assert same.fingerprint == hull.fingerprint


def test_options_of_another_form_are_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """--stations with a table of offsets, and unknown options of `read`, say what is wrong."""
    table = tmp_path / "t.csv"
    table.write_text("# station 0 = AP\nstation,wl_0,wl_1\n0,0,1\n10,0,1\n")
    assert main(["import", str(table), "-o", str(tmp_path / "t.hull.json"), "--stations", "9"]) == 2
    assert "meshes" in capsys.readouterr().err
    with pytest.raises(BadInputError, match="stations"):
        ah.read(table, stations=9)


def test_options_of_meshes_are_refused_for_lines(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Digitised lines are not cut: planes are refused by name."""
    lines = tmp_path / "lines.csv"
    lines.write_text("line,x,y,z\nST 1,0,0,0\nST 1,0,2,2\nST 2,9,0,0\nST 2,9,2,2\n")
    with pytest.raises(BadInputError, match="stations cannot be given for digitised lines"):
        ah.read(lines, stations=3, axes="rubbish")
    assert main(["import", str(lines), "-o", str(tmp_path / "o.hull.json"), "--buttocks", "2"]) == 2
    assert "buttocks cannot be given" in capsys.readouterr().err


@pytest.mark.parametrize("name", ["w.stl", "w.csv"])
def test_options_of_offsets_are_refused_for_meshes_and_lines(
    name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """--station-zero is for tables alone."""
    file = tmp_path / name
    file.write_text("line,x,y,z\nST 1,0,0,0\n")
    asked = ["import", str(file), "-o", str(tmp_path / "o.hull.json"), "--station-zero", "fp"]
    assert main(asked) == 2
    assert "it is for tables of offsets" in capsys.readouterr().err


def test_a_file_that_is_not_there_is_told_first(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Whatever options stand beside it, the missing file is the error."""
    file = tmp_path / "none.xyz"
    asked = ["import", str(file), "-o", str(tmp_path / "o.hull.json"), "--stations", "5"]
    assert main(asked) == 2
    assert "there is no such file" in capsys.readouterr().err
    with pytest.raises(BadInputError, match="no such file"):
        ah.read(file, stations=5)


class Terminal(io.StringIO):
    """Standard error as a terminal has it."""

    def isatty(self) -> bool:
        """Say that a person looks on."""
        return True


@pytest.mark.parametrize(
    ("terminal", "options", "shown"),
    [
        pytest.param(True, [], True, id="on a terminal"),
        pytest.param(True, ["--json"], False, id="for a program"),
        pytest.param(False, [], False, id="piped"),
    ],
)
def test_progress_is_for_people(
    terminal: bool, options: list[str], shown: bool,
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
) -> None:  # fmt: skip
    """A bar with the step stands on standard error of a terminal, and nothing elsewhere."""
    mesh = meshes.write(meshes.closed_wigley(121, 31), tmp_path / "w.stl")
    stream = Terminal() if terminal else io.StringIO()
    monkeypatch.setattr(sys, "stderr", stream)
    monkeypatch.setattr(output, "_PATIENCE", 0.0)
    monkeypatch.setenv("TERM", "xterm")
    asked = ["import", str(mesh), "-o", str(tmp_path / "w.hull.json"), "--buttocks", "1", *options]
    assert main([*asked, "--stations", "7", "--waterlines", "2"]) == 0
    assert ("importing w.stl" in stream.getvalue()) == shown
    assert shown or stream.getvalue() == ""


def test_work_tells_how_far_it_is(tmp_path: Path) -> None:
    """Every step is told, lines one by one, and telling changes nothing."""
    path = meshes.write(meshes.wigley_half(41, 16), tmp_path / "w.stl")
    heard: list[tuple[str, int, int]] = []
    state, _ = read_slices(
        path, stations=3, waterlines=2, buttocks=1, tell=lambda *step: heard.append(step)
    )
    assert [each for each in heard if each[0] == "cutting lines"] == [
        ("cutting lines", i, 6) for i in range(6)
    ]
    steps = list(dict.fromkeys(each[0] for each in heard))
    assert steps == [
        "reading the mesh", "cutting lines", "finding features and smoothing", "adopting",
    ]  # fmt: skip
    silently = ah.read(path, stations=3, waterlines=2, buttocks=1)
    assert silently.fingerprint == Hull(state).fingerprint


def test_the_report_is_drawn(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """--picture writes a picture; another ending is refused before anything is computed."""
    pytest.importorskip("matplotlib")
    mesh = meshes.write(meshes.wigley_half(41, 16), tmp_path / "w.stl")
    out = tmp_path / "w.hull.json"
    few = ["--stations", "5", "--waterlines", "2", "--buttocks", "1"]
    assert main(["import", str(mesh), "-o", str(out), *few,
                 "--picture", str(tmp_path / "p.gif")]) == 2  # fmt: skip
    assert "end the name in .pdf or .svg or .png" in capsys.readouterr().err
    assert not out.exists()
    assert main(["import", str(mesh), "-o", str(out), *few,
                 "--picture", str(tmp_path / "p.png")]) == 0  # fmt: skip
    assert (tmp_path / "p.png").read_bytes()[:4] == b"\x89PNG"


def test_the_width_of_a_gap_is_given(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Pieces 100 mm apart are refused with the option to give, and joined where it is given."""
    mesh = meshes.write(torn(meshes.wigley_half(), 0.1), tmp_path / "w.stl")
    asked = ["import", str(mesh), "-o", str(tmp_path / "w.hull.json"), "--buttocks", "1"]
    asked += ["--stations", "5", "--waterlines", "1,5"]
    assert main(asked) == 2
    message = capsys.readouterr().err
    assert "do not chain: two ends 100 mm apart" in message
    told = re.search(r"give --join of ([\d.]+) m", message)
    assert told is not None
    assert main([*asked, "--join", told.group(1)]) == 0
    assert "join: ST 50: 100.0 mm at (50.000, " in capsys.readouterr().out
