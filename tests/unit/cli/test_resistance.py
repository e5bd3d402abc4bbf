"""The command `resistance`: what it prints and writes, and what it refuses."""

import json
from pathlib import Path

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.cli import main
from tests.unit.cli.conftest import Json


def test_the_document_is_that_of_python(hull: Path, facts: Json) -> None:
    """Speeds as numbers and as a range, draughts, water and what is stated."""
    found = facts(
        "resistance", hull, "--speeds", "8", "10:12:1", "--method", "1982", "--draughts", "6",
        "5.5", "--water", "fresh", "--nu", "1.139e-6", "--c-stern", "10", "--appendage-area", "9",
        "--appendage-factor", "1.4",
    )  # fmt: skip
    own = ah.open(hull).resistance(
        [8.0, 10.0, 11.0, 12.0], method="1982", draughts=(6.0, 5.5), rho=1.0, nu=1.139e-6,
        c_stern=10.0, appendage_area=9.0, appendage_factor=1.4,
    )  # fmt: skip
    assert found["format"] == "assoc-hull resistance"
    assert found["columns"] == {head: each.tolist() for head, each in own.table().items()}
    assert [each["value"] for each in found["inputs"]] == [each.value for each in own.inputs]
    assert found["coefficients"] == dict(own.coefficients)
    assert found["warnings"] == list(own.warnings)
    assert found["saved"] == []


def test_a_person_gets_what_python_prints(hull: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """And the name of the file that was written."""
    out = hull.with_name("r.txt")
    assert main(["resistance", str(hull), "--speeds", "10", "-o", str(out)]) == 0
    words = str(ah.open(hull).resistance(10.0))
    assert capsys.readouterr().out == f"{words}\nwritten: {out}\n"
    assert out.read_text("utf-8") == f"{words}\n"


@pytest.mark.parametrize("ending", ["csv", "json", "xlsx"])
def test_files_hold_the_table(hull: Path, ending: str) -> None:
    """The total at each speed, in any of the forms."""
    out = hull.with_name(f"r.{ending}")
    assert main(["resistance", str(hull), "--speeds", "10", "14", "-o", str(out)]) == 0
    if ending == "json":
        found = json.loads(out.read_text("utf-8"))["columns"]["R"]
    elif ending == "csv":
        head, _, *rows = [row for row in out.read_text("utf-8").splitlines() if row[0] != "#"]
        place = head.split(",").index("R")
        found = [float(row.split(",")[place]) for row in rows]
    else:
        sheet = pytest.importorskip("openpyxl").load_workbook(out).active
        cells = [[cell.value for cell in row] for row in sheet.iter_rows()]
        (top,) = (i for i, row in enumerate(cells) if row[0] == "V" and "R" in row)
        found = [row[cells[top].index("R")] for row in cells[top + 2 :]]
    np.testing.assert_allclose(found, ah.open(hull).resistance([10, 14]).total, rtol=1e-11)


@pytest.mark.parametrize(
    ("given", "words"),
    [
        (["--speeds", "fast"], "a speed is 'fast', in --speeds"),
        (["--speeds", "0"], "give speeds above 0, kn"),
        (["--speeds", "14:10:1"], "--speeds"),
        (["--speeds", "10", "--draught", "30"], "draught of 30 m"),
        (["--speeds", "10", "--appendage-area", "9"], "without appendage_factor"),
        (["--speeds", "10", "-o", "r.pdf"], "end the name in .txt or .csv or .xlsx or .json"),
        ([], "--speeds"),
    ],
)
def test_what_cannot_be_done_is_told_in_one_line(
    hull: Path, capsys: pytest.CaptureFixture[str], given: list[str], words: str
) -> None:
    """And nothing is printed besides."""
    assert main(["resistance", str(hull), *given]) == 2
    shown = capsys.readouterr()
    assert shown.out == ""
    assert words in shown.err
    assert len(shown.err.splitlines()) == 1
