"""The command `classical`: a text in, its own numbers out, the net beside if asked."""

from __future__ import annotations

from pathlib import Path

import pytest

import assoc_hull as ah
from assoc_hull.cli import main
from tests.unit.cli.conftest import Json
from tests.unit.io.classical.test_sfolds_text import TEXT


@pytest.fixture
def text(tmp_path: Path) -> Path:
    """A body of one portion."""
    path = tmp_path / "body.txt"
    path.write_text(TEXT.replace("16 m\n", "8 m\n16 m\n24 m\n"), "utf-8")
    return path


def test_the_numbers_of_a_definition_are_told(text: Path, facts: Json) -> None:
    """As a document; nothing is made."""
    found = facts("classical", text)
    figures = {each["name"]: each for each in found["definition"]["figures"]}
    volume = figures["main body: volume, with camber"]
    assert (round(volume["value"], 4), volume["unit"], volume["net"]) == (11618.9267, "m3", None)
    assert "hull" not in found


def test_the_net_is_made_beside(text: Path, tmp_path: Path, facts: Json) -> None:
    """Its numbers stand with those of the definition; `import` makes the same hull."""
    out = tmp_path / "body.hull"
    found = facts("classical", text, "-o", out)
    assert ah.open(out).fingerprint == found["fingerprint"]
    below = found["definition"]["figures"][-2]
    assert below["net"] == pytest.approx(below["value"], rel=1e-4)
    other = facts("import", text, "-o", tmp_path / "other.hull")
    assert other["fingerprint"] == found["fingerprint"]
    assert other["report"]["definition"]["kind"] == "SFOLDS"


def test_an_example_can_be_read(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """What is printed is a text that the command takes."""
    assert main(["classical", "--example", "sfolds"]) == 0
    path = tmp_path / "ferry.txt"
    path.write_text(capsys.readouterr().out, "utf-8")
    assert main(["classical", str(path)]) == 0
    said = capsys.readouterr().out
    assert "6. bow: volume" in said
    assert "note: portion 13 (bossing)" in said


@pytest.mark.parametrize(
    ("arguments", "what"),
    [
        pytest.param([], "FILE is missing", id="nothing"),
        pytest.param(["--example", "ferry"], "there is no example 'ferry'", id="no kind"),
        pytest.param(["a.txt", "--example", "sfolds"], "--example stands alone", id="both"),
        pytest.param(["none.txt"], "the file cannot be read", id="no file"),
    ],
)
def test_usage(arguments: list[str], what: str, capsys: pytest.CaptureFixture[str]) -> None:
    """One line, and code 2."""
    assert main(["classical", *arguments]) == 2
    assert what in capsys.readouterr().err


@pytest.mark.parametrize("option", [["--deck", "open"], ["--unit", "mm"], ["--station-zero", "ap"]])
def test_import_takes_no_options_with_a_definition(
    text: Path, tmp_path: Path, option: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    """The text says all."""
    assert main(["import", str(text), "-o", str(tmp_path / "a.hull"), *option]) == 2
    said = capsys.readouterr().err
    name = option[0].removeprefix("--").replace("-", "_")
    assert f"{name} cannot be given, for {text.name}; leave it out: a definition says all" in said
