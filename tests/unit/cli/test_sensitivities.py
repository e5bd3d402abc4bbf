"""The command `sensitivities`: what it prints, and what it refuses."""

from pathlib import Path

import pytest

import assoc_hull as ah
from assoc_hull.cli import main
from tests.unit.cli.conftest import Json


def test_the_document_is_that_of_python(hull: Path, facts: Json) -> None:
    """Outputs and parameters as named, with a point beside them."""
    point = "WL 2.5 x ST 7"
    found = facts(
        "sensitivities", hull, "--of", "volume", "Cb", "--by", "breadth", "--point", point
    )
    own = ah.open(hull).sensitivities(["volume", "Cb"], ["breadth", "trim"])
    assert [each["name"] for each in found["parameters"]] == ["breadth", point]
    assert [row[0] for row in found["derivatives"]] == own.matrix[:, 0].tolist()
    assert [each["value"] for each in found["outputs"]] == own.values.tolist()


def test_a_person_gets_a_table(hull: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """In percent if that is asked for."""
    call = ["sensitivities", str(hull), "--of", "volume", "--by", "breadth", "--percent"]
    assert main(call) == 0
    row = capsys.readouterr().out.splitlines()[3].split()
    assert row[:3] == ["breadth", "0.5", "m"]
    assert float(row[3]) == pytest.approx(5.0, rel=1e-4)


def test_what_is_unknown_is_told_in_one_line(
    hull: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """With the nearest names; nothing is printed besides."""
    assert main(["sensitivities", str(hull), "--by", "bredth"]) == 2
    shown = capsys.readouterr()
    assert shown.out == ""
    assert "'breadth'" in shown.err
    assert len(shown.err.splitlines()) == 1
