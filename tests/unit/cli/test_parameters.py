"""The command `parameters`: what it asks, prints, writes and refuses."""

import json
import sys
from pathlib import Path

import pytest
from jsonschema import Draft202012Validator

import assoc_hull as ah
from assoc_hull.analysis.form.form_parameters import CATALOGUE, TABLES
from assoc_hull.cli import form_parameters as parameters
from assoc_hull.cli import main
from assoc_hull.io.tables.form_parameters import catalogue_schema, form_schema
from assoc_hull.plot.diagrams.form_report import ENDINGS
from tests.unit.cli.conftest import Json


def test_the_document_has_the_names_of_the_python_objects(hull: Path, facts: Json) -> None:
    """All entries, at the design draught if none is given; it has the form of the schema."""
    found = facts("parameters", hull)
    assert Draft202012Validator(form_schema()).is_valid(found)
    assert list(found["values"]) == list(CATALOGUE)
    assert found["position"] == {"draught_aft": 6.25, "draught_fore": 6.25, "heel_deg": 0.0}
    own = ah.open(hull).form_parameters()
    assert {symbol: value["number"] for symbol, value in found["values"].items()} == {
        symbol: value.number for symbol, value in own.items()
    }
    assert found["header"]["date"]
    assert found["saved"] == []


def test_the_place_and_the_water_are_as_asked(hull: Path, facts: Json) -> None:
    """Draughts aft first; a density and a factor for the plating."""
    found = facts("parameters", hull, "--draughts", 6, 5.5, "--rho", 1, "--shell-factor", 1.01,
                  "--transom", "--only", "V, Disp")  # fmt: skip
    assert (found["position"]["draught_aft"], found["position"]["draught_fore"]) == (6.0, 5.5)
    assert list(found["values"]) == ["V", "Disp"]
    volume, mass = (each["number"] for each in found["values"].values())
    assert mass == pytest.approx(1.01 * volume, rel=1e-12)
    assert found["header"]["transom"] is True


def test_the_screw_is_as_told(hull: Path, facts: Json) -> None:
    """Height and diameter at least."""
    found = facts("parameters", hull, "--shaft-height", 2, "--propeller-diameter", 3, "--screw-x",
                  2.5, "--shaft-spacing", 4, "--boss-diameter", 0.5, "--boss-x", 2.0,
                  "--only", "Cb")  # fmt: skip
    assert found["screw"] == {
        "height": 2.0, "diameter": 3.0, "x": 2.5, "spacing": 4.0, "boss_diameter": 0.5,
        "boss_x": 2.0,
    }  # fmt: skip
    found = facts(
        "parameters", hull, "--shaft-height", 2, "--propeller-diameter", 3, "--only", "Cb"
    )
    assert (found["screw"]["x"], found["screw"]["spacing"]) == (None, 0.0)


def test_a_part_may_be_asked(hull: Path, facts: Json) -> None:
    """The choices are the parts of the catalogue."""
    found = facts("parameters", hull, "--table", "particulars", "--table", "measures")
    assert {CATALOGUE[symbol].table for symbol in found["values"]} <= {"particulars", "measures"}
    assert found["values"]["Lpp"]["number"] == 100.0
    assert parameters._TABLES == TABLES
    assert parameters._ENDINGS == ENDINGS


def test_words_are_the_sheet(hull: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Particulars and values, as in a file of text."""
    assert main(["parameters", str(hull), "--only", "Cb,V"]) == 0
    text = capsys.readouterr().out
    assert text.startswith("FORM PARAMETERS\n")
    assert "Length between perpendiculars" in text
    assert text.split()[-6:] == ["V", "2777.45", "m3", "Cb", "0.4444", "-"]


@pytest.mark.parametrize("ending", [".txt", ".csv", ".xlsx", ".json", ".pdf"])
def test_a_file_is_written(hull: Path, facts: Json, tmp_path: Path, ending: str) -> None:
    """In the form of its ending; the document names it."""
    needed = {".xlsx": "openpyxl", ".pdf": "matplotlib"}
    if ending in needed:
        pytest.importorskip(needed[ending])
    out = tmp_path / f"form{ending}"
    found = facts("parameters", hull, "--only", "Cb", "-o", out)
    assert found["saved"] == [str(out)]
    data = out.read_bytes()
    begins = {".txt": b"FORM PARAMETERS", ".csv": b"# ship: Wigley", ".xlsx": b"PK",
              ".json": b'{\n "format"', ".pdf": b"%PDF-"}  # fmt: skip
    assert data.startswith(begins[ending])
    if ending == ".json":
        assert json.loads(data)["values"] == found["values"]


def test_the_catalogue_is_told(facts: Json, capsys: pytest.CaptureFixture[str]) -> None:
    """Without a hull, whole or in part, in words and as a document of the schema."""
    found = facts("parameters", "--catalogue")
    assert Draft202012Validator(catalogue_schema()).is_valid(found)
    assert [each["symbol"] for each in found["entries"]] == list(CATALOGUE)
    found = facts("parameters", "--catalogue", "--table", "hydrostatic")
    assert {each["table"] for each in found["entries"]} == {"hydrostatic"}
    assert main(["parameters", "--catalogue", "--only", "Cb"]) == 0
    assert "Cb (C_B), -: block coefficient\n    V / (Lpp B T)" in capsys.readouterr().out


def test_the_catalogue_is_written(tmp_path: Path, facts: Json) -> None:
    """As JSON or as text."""
    for name in ("catalogue.json", "catalogue.txt"):
        found = facts("parameters", "--catalogue", "-o", tmp_path / name)
        assert found["saved"] == [str(tmp_path / name)]
    written = json.loads((tmp_path / "catalogue.json").read_text("utf-8"))
    assert written["entries"] == found["entries"]
    assert "block coefficient" in (tmp_path / "catalogue.txt").read_text("utf-8")


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--draught", "99"], ["draught of 99 m", "from 0 to"]),
        (["--draught", "nan"], ["draught of nan m"]),
        (["--draught", "6", "--draughts", "6", "5"], ["not allowed with"]),
        (["--rho", "0"], ["rho is 0"]),
        (["--only", "Cbb"], ["'Cbb'", "nearest names", "'Cb'"]),
        (["--only", ","], ["no symbol"]),
        (["--only", "Cb", "--table", "measures"], ["not allowed with"]),
        (["--table", "bulb"], ["'bulb'", "bulb and resistance"]),
        (["--shaft-height", "2"], ["--propeller-diameter"]),
        (["--propeller-diameter", "2"], ["--shaft-height"]),
        (["--screw-x", "2"], ["--shaft-height"]),
        (["--shaft-height", "2", "--propeller-diameter", "-3"], ["diameter is -3"]),
        (["-o", "form.doc"], ["form is unknown", ".txt or .pdf"]),
        (["-o", "nowhere/form.pdf"], ["no folder nowhere"]),
        (["--catalogue"], ["a hull and --catalogue"]),
    ],
)
def test_what_cannot_be_is_refused(
    hull: Path, arguments: list[str], words: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    """With exit code 2 and one line that says what to do."""
    assert main(["parameters", str(hull), *arguments]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith("error: ")
    assert err.count("\n") == 1
    assert [each for each in words if each not in err] == []


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ([], "give HULL, or --catalogue"),
        (["nowhere.hull"], "nowhere.hull"),
        (["--catalogue", "-o", "catalogue.pdf"], ".txt or .json"),
        (["--catalogue", "--only", "Cbb"], "'Cbb'"),
    ],
)
def test_without_a_hull_only_the_catalogue_can_be_told(
    arguments: list[str], words: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """And only in forms that it has."""
    assert main(["parameters", *arguments]) == 2
    assert words in capsys.readouterr().err


def test_the_hull_is_not_written_over(hull: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Though its name ends as a report's may."""
    before = hull.read_bytes()
    assert main(["parameters", str(hull), "-o", str(hull)]) == 2
    assert "written over" in capsys.readouterr().err
    assert hull.read_bytes() == before


def test_without_matplotlib_a_pdf_is_refused(
    hull: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """It is said what to install, and nothing is written; a text needs nothing."""
    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)
    assert main(["parameters", str(hull), "--only", "Cb", "-o", str(tmp_path / "form.pdf")]) == 2
    assert "assoc-hull[plot]" in capsys.readouterr().err
    assert not (tmp_path / "form.pdf").exists()
    assert main(["parameters", str(hull), "--only", "Cb", "-o", str(tmp_path / "form.txt")]) == 0
