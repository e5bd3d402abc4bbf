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
    assert found.history[-1].name == " ".join(typed)


@pytest.mark.parametrize(
    ("typed", "told"),
    [
        (["pul", "WL 2.5 x ST 5", "1mm"], "there is no modification 'pul'; did you mean 'pull'?"),
        (["pull", "WL 2.5 x ST 5", "1mm", "depth=3"], "pull takes no 'depth': pull takes POINT D"),
        (["move", "WL 2.5 x ST 5", "2.4"], "'2.4' is one value too many: move takes POINT [x=]"),
        (["lead", "WL 2.5"], "lead takes LINE POINTS [SPAN]"),
        (["rule", "sections", "waterlines", "x"], "cannot be typed; give it in a .json file"),
        (["pull", "WL 2.5 x ST 5", "1mm", "d=2mm"], "'d' of pull is given twice"),
        (["pull"], "missing a required argument: 'point': pull takes POINT D [RADIUS]"),
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


@pytest.mark.parametrize(
    ("typed", "same"),
    [
        (["pull", "WL 2.5 x ST 5", "50mm", "--radius", "20", "8"],
         ["pull", "WL 2.5 x ST 5", "50mm", "radius=20,8"]),
        (["pull", "--fair", "WL 2.5 x ST 5", "--radius", "20", "8", "50mm"],
         ["pull", "WL 2.5 x ST 5", "50mm", "radius=20,8", "fair=yes"]),
        (["move", "WL 2.5 x ST 5", "--by", "0", "-1cm", "0"],
         ["move", "WL 2.5 x ST 5", "by=0,-1cm,0"]),
        (["move", "WL 2.5 x ST 5", "--y=2.41"], ["move", "WL 2.5 x ST 5", "y=2.41"]),
        (["fair", "--noise", "auto"], ["fair", "noise=auto"]),
    ],
    ids=["two numbers", "a switch, and a value behind numbers", "negative", "equals", "a word"],
)  # fmt: skip
def test_values_with_a_name_are_typed_as_options_too(
    file: Path, typed: list[str], same: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    """They do the same."""
    told = list[str]()
    for words in (typed, same):
        assert main(["edit", str(file), *words, "--name", "it", "--dry-run"]) == 0
        told.append(capsys.readouterr().out)
    assert told[0] == told[1]


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["pull", "WL 2.5 x ST 5", "1mm", "--radus", "20"], "pull takes no --radus: pull takes"),
        (["pull", "WL 2.5 x ST 5", "1mm", "--radius"], "--radius has no value"),
        (["smooth", "WL 2.5"], "did you mean 'fair'?"),
        (["vary", "breadth=11"], "a command of its own; see: assoc-hull vary --help"),
    ],
    ids=["slip", "no value", "synonym", "command"],
)
def test_a_slip_in_a_typed_edit_is_told_with_what_is_meant(
    file: Path, words: list[str], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """In one line; nothing is written."""
    assert main(["edit", str(file), *words]) == 2
    told = capsys.readouterr().err
    assert said in told
    assert told.count("\n") == 1


def test_parameters_of_a_variation_stand_without_their_option(
    file: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Before and behind options."""
    out = file.parent / "wide.hull"
    assert main(["vary", str(file), "-o", str(out), "breadth=10.5", "--stations", "x"]) == 0
    assert ah.open(out).particulars.breadth == pytest.approx(10.5, rel=1e-12)
    capsys.readouterr()


def test_words_that_are_no_numbers_are_names() -> None:
    """A name with commas, an equals sign, or digits is taken as it stands."""
    assert typed_edit("add_line", ["waterlines", "4.2", "7"])["name"] == "7"
    assert typed_edit("add_line", ["waterlines", "4.2", "none"])["name"] == "none"
    assert typed_edit("group", ["mine", "WL 0.5"])["lines"] == ["WL 0.5"]
    assert typed_edit("fair", ["WL 0.5", "hold=volume;lcb"])["hold"] == ["volume", "lcb"]
    assert typed_edit("rename", ["WL 2.5", "a, b"])["name"] == "a, b"
    assert typed_edit("delete", ["a=b x c"]) == {"op": "delete", "point": "a=b x c"}


def test_a_place_that_begins_with_a_minus_is_a_value(
    file: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Also one abaft of the after perpendicular, or with an exponent."""
    assert main(["edit", str(file), "lead", "WL 2.5", "-2,0.5,2.5"]) == 2
    assert "unrecognized" not in capsys.readouterr().err
    assert main(["edit", str(file), "pull", "WL 2.5 x ST 5", "-1e-2", "20,8"]) == 0


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--json", "info"], "the command comes first, options behind it"),
        ([""], "the command comes first"),
        (["EDIT", "ship.hull"], "did you mean 'edit'"),
    ],
)
def test_what_stands_before_the_command_is_told(
    words: list[str], told: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """And a command in capitals."""
    assert main(words) == 2
    assert told in capsys.readouterr().err


def test_help_is_asked_for_as_a_command_too(capsys: pytest.CaptureFixture[str]) -> None:
    """Of the program, and of one command."""
    assert main(["help"]) == 0
    assert "hydrostatics" in capsys.readouterr().out
    assert main(["help", "undo"]) == 0
    assert "assoc-hull undo" in capsys.readouterr().out
