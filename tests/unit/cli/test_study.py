"""The command `study`: values drawn, targets, files, reasons."""

import csv
import json
from pathlib import Path

import pytest

from assoc_hull.cli import main
from tests.unit.cli.conftest import Json


def test_drawn_values_make_a_table(hull: Path, tmp_path: Path, facts: Json) -> None:
    """LOW:HIGH is drawn for each variant; the file has a row each, below names and units."""
    target = tmp_path / "variants.csv"
    found = facts("study", hull, "--set", "draught=6:6.4", "--count", 2, "--seed", 3,
                  "--outputs", "cb", "-o", target)  # fmt: skip
    drawn = found["columns"]["draught"]
    assert found["saved"] == str(target)
    assert found["drawn"] == "sobol, seed 3"
    assert all(6.0 <= value <= 6.4 for value in drawn)
    rows = list(csv.reader(target.read_text().splitlines()))
    assert rows[0][:3] == ["number", "draught", "cb"]
    assert rows[1][1] == "m"
    assert [float(row[1]) for row in rows[2:]] == pytest.approx(drawn, rel=1e-11)


def test_the_same_command_goes_on_in_its_file(hull: Path, tmp_path: Path, facts: Json) -> None:
    """Rows of a table of one's own, in a grid's place; the second time they are read."""
    rows, file = tmp_path / "rows.csv", tmp_path / "study.sqlite"
    rows.write_text("breadth,draught\nm,m\n10.0,6.1\n10.2,6.2\n")
    for _ in range(2):
        found = facts("study", hull, "--rows", rows, "--file", file, "--outputs", "cb")
        assert found["columns"]["breadth"] == [10.0, 10.2]
    asked = ["study", hull, "--rows", rows, "--set", "draught=6", "--file", file]
    assert main([*map(str, asked)]) == 2  # of which the outputs, too, are others


def test_a_grid_is_every_combination(hull: Path, tmp_path: Path, facts: Json) -> None:
    """LOW:HIGH:N is N values from end to end."""
    target = tmp_path / "grid.parquet"
    found = facts("study", hull, "--set", "breadth=10:11:2", "--set", "draught=6:6.2:3",
                  "--outputs", "cb", "-o", target)  # fmt: skip
    assert found["columns"]["draught"] == pytest.approx([6.0, 6.1, 6.2] * 2)
    assert found["columns"]["breadth"] == [10.0] * 3 + [11.0] * 3
    assert target.read_bytes()[:4] == b"PAR1"


def test_a_script_names_what_is_asked(
    hull: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Reasons of variants that are none are told; exit 1 if none is left."""
    script = tmp_path / "asked.json"
    script.write_text(json.dumps({"reach": {"volume": 2700}, "free": ["breadth"],
                                  "bounds": {"breadth": [9.9, 9.95]}}))  # fmt: skip
    assert main(["study", str(hull), "--script", str(script)]) == 1
    said = capsys.readouterr().out
    assert "0 of 1 variants, 1 out of range" in said
    assert "breadth of 9.7" in said


def test_rows_of_a_script_are_not_mixed_with_options(
    hull: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A script may give a mapping for each variant; then that is all."""
    script = tmp_path / "asked.json"
    script.write_text(json.dumps({"set": [{"breadth": 10.1}, {"breadth": 10.2}]}))
    assert main(["study", str(hull), "--script", str(script)]) == 0
    assert "2 of 2 variants" in capsys.readouterr().out
    assert main(["study", str(hull), "--script", str(script), "--set", "draught=6"]) == 2
    assert "row by row" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--set", "breadth"], "give NAME=VALUE"),
        (["--set", "breadth=x"], "'x' is no number"),
        (["--set", "breadth=3", "--set", "breadth=4"], "given twice"),
        (["--set", "bredth=3"], "'breadth'"),
        (["--reach", "volume=3", "--free", "breadth=3"], "give LOW:HIGH"),
        (["--set", "breadth=3:4:x"], "'x' is no number of values"),
        (["--set", "breadth=3:4:5", "--set", "draught=5:6"], "is a grid"),
        (["--set", "breadth=10", "--cluster", "nowhere://x"], "no scheduler answers"),
        ([], "nothing is asked for"),
    ],
    ids=[
        "no value",
        "no number",
        "twice",
        "unknown",
        "no bounds",
        "no count",
        "half a grid",
        "no cluster",
        "nothing",
    ],
)
def test_what_cannot_be_asked_ends_with_exit_2(
    hull: Path, options: list[str], words: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """In one line that says what."""
    assert main(["study", str(hull), *options]) == 2
    said = capsys.readouterr().err
    assert words in said
    assert len(said.splitlines()) == 1
