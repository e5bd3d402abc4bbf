"""Importing a mesh from the command line."""

import json
from pathlib import Path

import pytest

import assoc_hull as ah
from assoc_hull.cli import main
from assoc_hull.errors import BadInputError
from tests import meshes


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
    assert {"slices", "joins", "smoothing", "adoption", "rules"} <= set(facts)
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
