"""Edits typed on the command line do what a file with the same edit does."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

import assoc_hull as ah
from assoc_hull.cli import main
from assoc_hull.cli.typed_edits import typed_edit


@pytest.fixture
def file(tmp_path: Path) -> Path:
    """Give a Wigley hull as a text file."""
    path = tmp_path / "w.hull.json"
    assert main(["example", "wigley", "-o", str(path)]) == 0
    return path


@pytest.mark.parametrize(
    ("typed", "asked"),
    [
        (
            ["pull", "WL 2.5 x ST 5", "-20mm", "radius=20,8"],
            {"op": "pull", "point": "WL 2.5 x ST 5", "d": -0.02, "radius": [20.0, 8.0]},
        ),
        (["move", "wl 2,5 x st 5", "y=2.41"], {"op": "move", "point": "WL 2.5 x ST 5", "y": 2.41}),
        (
            ["move", "WL 2.5 x ST 5", "by=0,1cm,0"],
            {"op": "move", "point": "WL 2.5 x ST 5", "by": [0.0, 0.01, 0.0]},
        ),
        (
            ["pull", "WL 2.5 x ST 5", "d=5mm", "fair=yes"],
            {"op": "pull", "point": "WL 2.5 x ST 5", "d": 0.005, "fair": True},
        ),
        (
            ["knuckle_line", "chine", "WL 2.5 x ST 5; WL 2.5 x ST 6; WL 2.5 x ST 7"],
            {"op": "knuckle_line", "name": "chine",
             "points": ["WL 2.5 x ST 5", "WL 2.5 x ST 6", "WL 2.5 x ST 7"]},
        ),
    ],
)  # fmt: skip
def test_what_is_typed_gives_the_hull_that_a_file_gives(
    file: Path, tmp_path: Path, typed: list[str], asked: dict[str, object]
) -> None:
    """To the bit; the step is called by what was typed."""
    script = tmp_path / "edits.json"
    script.write_text(json.dumps([asked]), encoding="utf-8")
    one, other = tmp_path / "one.hull", tmp_path / "other.hull"
    assert main(["edit", str(file), *typed, "-o", str(one)]) == 0
    assert main(["edit", str(file), str(script), "-o", str(other)]) == 0
    found = ah.open(one)
    assert found.fingerprint == ah.open(other).fingerprint != ah.open(file).fingerprint
    assert found.history[-1].name == f"{typed[0]} {typed[1]}"


@pytest.mark.parametrize(
    ("typed", "told"),
    [
        (["pul", "WL 2.5 x ST 5", "1mm"], "there is no modification 'pul'; did you mean 'pull'?"),
        (["pull", "WL 2.5 x ST 5", "1mm", "depth=3"], "pull takes no 'depth': it takes point, d,"),
        (["move", "WL 2.5 x ST 5", "2.4"], "'2.4' is one more; write name=2.4, with one of"),
        (["pull", "WL 2.5 x ST 5", "1mm", "d=2mm"], "'d' of pull is given twice"),
        (["pull"], "missing a required argument: 'point'"),
        (["pull", "WL 2.5 x ST 5", "far"], "(pull, modification 1)"),
    ],
)
def test_a_mistake_is_told_and_changes_nothing(
    file: Path, typed: list[str], told: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """In one line, with what is to be typed."""
    before = file.read_bytes()
    assert main(["edit", str(file), *typed]) == 2
    line = capsys.readouterr().err
    assert told in line
    assert line.count("\n") == 1
    assert file.read_bytes() == before


def test_a_file_called_like_a_modification_is_a_file(
    file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What is there is read."""
    monkeypatch.chdir(tmp_path)
    asked = [{"op": "move", "point": "WL 2.5 x ST 5", "y": 2.41}]
    Path("pull").write_text(json.dumps(asked), encoding="utf-8")
    assert main(["edit", str(file), "pull"]) == 0
    assert ah.open(file).points["WL 2.5 x ST 5"].y == 2.41


@pytest.mark.parametrize("words", [(), ("lead=no",)], ids=["leads", "pinned"])
def test_a_typed_point_beside_its_line_leads_as_in_python(
    file: Path, tmp_path: Path, words: tuple[str, ...]
) -> None:
    """A file that does not say so pins it; what is typed is new."""
    x, y, z = ah.open(file).lines["WL 2.5"].curves[0].at(37.0).tolist()
    made = tmp_path / "made.hull"
    place = f"{x},{y + 0.01},{z}"
    assert main(["edit", str(file), "insert", "WL 2.5", place, *words, "-o", str(made)]) == 0
    (step,) = ah.open(made).document.history
    assert step.script.edits[0]["lead"] is not bool(words)
    assert bool(step.report.led) is not bool(words)


def test_words_that_are_no_numbers_are_names() -> None:
    """A name with commas, or an equals sign, is taken as it stands."""
    assert typed_edit("rename", ["WL 2.5", "a, b"])["name"] == "a, b"
    assert typed_edit("delete", ["a=b x c"]) == {"op": "delete", "point": "a=b x c"}
