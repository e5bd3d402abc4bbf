"""The command `export --biarcs`: lengths as they are typed, what it prints, what it refuses."""

import argparse
from pathlib import Path

import pytest

from assoc_hull.cli import main
from assoc_hull.cli.arguments import parse_length
from tests.unit.cli.conftest import Json


@pytest.mark.parametrize(
    ("text", "metres"),
    [
        ("0.5mm", 0.0005), ("0.5 mm", 0.0005), ("0.0005", 0.0005), ("5e-4", 0.0005),
        ("50mm", 0.05), ("2.5cm", 0.025), (" 1 m ", 1.0), (".1mm", 0.0001), ("1e-1mm", 0.0001),
    ],
)  # fmt: skip
def test_lengths_are_the_numbers_that_were_typed(text: str, metres: float) -> None:
    """To the last bit, with and without a unit."""
    assert parse_length(text) == metres


@pytest.mark.parametrize(
    "text",
    [
        "",
        "mm",
        "0.5 furlongs",
        "-0.5mm",
        "0",
        "nan",
        "inf",
        "1e9m",
        "1e-9",
        "0,5mm",
        "1e999",
        "5MM",
    ],
)
def test_no_lengths_are_refused(text: str) -> None:
    """By a message that shows one."""
    with pytest.raises(argparse.ArgumentTypeError, match=r"is no length|lies not between"):
        parse_length(text)


def test_the_command_reports_arcs_and_deviation(hull: Path, facts: Json, tmp_path: Path) -> None:
    """Per line and in all; the file holds as many arcs."""
    out = tmp_path / "arcs.csv"
    told = facts("export", hull, "-o", out, "--biarcs", "0.5mm", "--lines", "waterlines")["arcs"]
    assert (told["form"], told["within"]) == ("csv", 0.0005)
    assert told["arcs"] == sum(line["arcs"] for line in told["lines"])
    assert 0.0 < told["deviation"] <= 0.0005
    assert told["deviation"] == max(line["deviation"] for line in told["lines"])
    assert told["arcs"] <= 0.5 * told["one_biarc_per_interval"]
    assert len(out.read_text().splitlines()) == told["arcs"] + 1


def test_words_tell_the_same(
    hull: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A row per curve, a sum, and the file."""
    pytest.importorskip("ezdxf")
    out = tmp_path / "lines.dxf"
    assert main(["export", str(hull), "-o", str(out), "--biarcs", "1mm", "--lines", "WL 5"]) == 0
    words = capsys.readouterr().out.splitlines()
    assert words[0].split()[:2] == ["line", "arcs"]
    assert words[1].startswith("WL 5")
    assert words[2].startswith("1 curves, ")
    assert words[-1] == f"written: {out} (dxf)"
    assert out.read_bytes().startswith(b"  0\nSECTION")


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["-o", "a.csv", "--lines", "WL 5"], "--lines chooses lines for arcs"),
        (["-o", "a.csv", "--least-radius", "5cm"], "--least-radius is one of arcs"),
        (["-o", "a.csv", "--entities", "arcs"], "--entities is for a drawing of arcs"),
        (["-o", "a.csv", "--biarcs", "1mm", "--format", "gf"], "--format is none of arcs"),
        (["-o", "a.txt", "--biarcs", "1mm"], "tells no form of arcs"),
        (["-o", "a.csv", "--biarcs", "5kg"], "'5kg' is no length"),
        (["-o", "a.csv", "--biarcs", "2m"], "within is 2 m"),
        (["-o", "a.csv", "--biarcs", "1mm", "--lines", "WL 99"], "no object named 'WL 99'"),
    ],
    ids=["lines", "radius", "entities", "format", "ending", "unit", "coarse", "name"],
)  # fmt: skip
def test_what_makes_no_sense_is_refused(
    hull: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str], options: list[str], message: str,
) -> None:  # fmt: skip
    """In one line, and no file is written."""
    monkeypatch.chdir(tmp_path)
    assert main(["export", str(hull), *options]) == 2
    assert message in capsys.readouterr().err
    assert sorted(each.name for each in tmp_path.iterdir()) == [hull.name]
