"""The command `create`: a design in, a hull and its report out."""

from __future__ import annotations

import json
from pathlib import Path

import attrs
import pytest

import assoc_hull as ah
from assoc_hull.cli import main
from assoc_hull.shipped.plain_ship import plain_ship_design
from tests.unit.cli.conftest import Json


@pytest.fixture(scope="module")
def design(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The plain ship with few lines, as a file."""
    few = attrs.evolve(
        plain_ship_design(), stations=(0.0, 5.0, 10.0, 15.0), waterlines=(3.6,), buttocks=()
    )
    path = tmp_path_factory.mktemp("design") / "design.json"
    path.write_text(few.to_json(), encoding="utf-8")
    return path


def test_a_design_becomes_a_hull(design: Path, tmp_path: Path, facts: Json) -> None:
    """The hull is written, the report tells closure and net, and each section."""
    out = tmp_path / "ship.hull"
    found = facts("create", design, "-o", out)
    assert ah.open(out).fingerprint == found["fingerprint"]
    figures = {each["name"]: each for each in found["report"]["figures"]}
    assert figures["CB"]["closure"] == pytest.approx(0.68, abs=1e-12)
    assert [each["name"] for each in found["report"]["sections"]] == [
        "ST 0", "ST 5", "ST 10", "ST 15"
    ]  # fmt: skip


def test_the_report_is_told_in_words(
    design: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """As a table."""
    assert main(["create", str(design), "-o", str(tmp_path / "ship.hull.json")]) == 0
    said = capsys.readouterr().out
    assert "closure" in said
    assert "level+arc+upright+topside" in said


def test_an_example_is_a_design(capsys: pytest.CaptureFixture[str]) -> None:
    """What is printed can be read."""
    assert main(["create", "--example"]) == 0
    assert ah.creation.Design.from_json(capsys.readouterr().out) == plain_ship_design()


def test_the_schema_of_designs(capsys: pytest.CaptureFixture[str]) -> None:
    """It is printed by the command for schemas."""
    assert main(["schema", "--of", "design"]) == 0
    assert json.loads(capsys.readouterr().out)["title"] == "assoc-hull design"


def test_the_definitions_are_drawn(design: Path, tmp_path: Path) -> None:
    """Of a created hull; another one has none."""
    hull, picture = tmp_path / "ship.hull", tmp_path / "definitions.svg"
    assert main(["create", str(design), "-o", str(hull)]) == 0
    assert main(["plot", str(hull), "-o", str(picture), "--view", "definitions"]) == 0
    assert "sectional areas" in picture.read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("text", "words"),
    [
        pytest.param("{", "is no JSON", id="no JSON"),
        pytest.param('{"format": "assoc-hull design"}', "'schema' is missing", id="half of it"),
        pytest.param("[]", "is no mapping", id="a list"),
    ],
)
def test_what_is_no_design_ends_with_exit_2(
    text: str, words: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """In one line that names the file; nothing is written."""
    path, out = tmp_path / "design.json", tmp_path / "ship.hull"
    path.write_text(text, encoding="utf-8")
    assert main(["create", str(path), "-o", str(out)]) == 2
    said = capsys.readouterr().err
    assert words in said
    assert len(said.splitlines()) == 1
    assert not out.exists()


@pytest.mark.parametrize(
    "given",
    [[], ["design.json"], ["-o", "a.hull"], ["--example", "design.json"], ["--example", "--json"]],
    ids=["nothing", "no target", "no design", "both", "as JSON"],
)
def test_usage(given: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    """What is missing or too much is told."""
    assert main(["create", *given]) == 2
    assert "in create" in capsys.readouterr().err


def test_combs_are_of_lines(capsys: pytest.CaptureFixture[str]) -> None:
    """Not of definitions, which have theirs in any case."""
    given = ["plot", "a.hull", "-o", "a.svg", "--view", "definitions", "--combs", "ST 1"]
    assert main(given) == 2
    assert "--combs" in capsys.readouterr().err
