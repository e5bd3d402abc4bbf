"""The verdict on an import, on the command line: last line, exit code, report, refusal."""

import json
from pathlib import Path

import pytest

import assoc_hull as ah
from assoc_hull.cli import main
from tests.unit.io.importing.test_verdict import wigley_table


@pytest.fixture
def table(tmp_path: Path) -> Path:
    """A table of a Wigley hull."""
    path = tmp_path / "ship.csv"
    path.write_text(wigley_table())
    return path


def asked(table: Path, *more: str, out: str = "ship.hull") -> list[str]:
    """The command to import it."""
    return ["import", str(table), "-o", str(table.parent / out), "--length", "100", *more]


def test_every_import_ends_with_the_verdict(
    table: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """One line after what was written; what was assumed is told once."""
    assert main(asked(table, "--draught", "6.25")) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[-1] == "verdict: sound"
    assert lines[-2].startswith("written: ")
    assert len([each for each in lines if "breadth: " in each]) == 1
    assert "  suspicions (0)" in lines


def test_a_hull_that_is_not_sound_is_refused(
    table: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """All findings on standard output, one line of error, exit code 3, a report and no hull."""
    report = table.parent / "report.json"
    more = ["--draught", "6.25", "--depth", "5", "--deck", "closed", "--breadth", "10.5"]
    assert main(asked(table, *more, "--report", str(report))) == 3
    said = capsys.readouterr()
    assert said.err.count("\n") == 1
    assert said.err.startswith("error: not sound: 2 faults, in ship.csv; mend these 2, or take")
    lines = said.out.splitlines()
    at = lines.index("  faults (2)")
    assert [each.split(":")[0].strip() for each in lines[at + 1 : at + 3]] == ["draught", "breadth"]
    assert lines[-1] == "verdict: not sound (2 faults)"
    assert lines[-2].startswith("not written: ")
    assert not (table.parent / "ship.hull").exists()
    verdict = json.loads(report.read_text())["verdict"]
    assert verdict["word"] == "not sound"
    assert [each["kind"] for each in verdict["faults"]] == ["draught", "breadth"]


def test_json_holds_the_verdict(table: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Of a hull that is taken, and of one that is refused: then there is no hull."""
    assert main(asked(table, "--draught", "6.25", "--json")) == 0
    facts = json.loads(capsys.readouterr().out)
    assert facts["report"]["verdict"]["word"] == "sound"
    assert main(asked(table, "--breadth", "10.5", "--json", out="other.hull")) == 3
    facts = json.loads(capsys.readouterr().out)
    assert facts["hull"] is None
    assert facts["report"]["verdict"]["faults"][0]["kind"] == "breadth"


@pytest.mark.parametrize("out", ["ship.hull", "ship.hull.json"])
def test_accept_takes_it_and_keeps_the_verdict(
    out: str, table: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """As a checkpoint in the hull file; the text form has no place for it, which is said."""
    assert main(asked(table, "--draught", "6.25", "--breadth", "10.5", "--accept", out=out)) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[-1] == "verdict: not sound (1 fault)"
    kept = list(ah.open(table.parent / out).labels)
    assert [each.partition(": ")[0] for each in kept] == (
        ["as imported, not sound (1 fault)"] if out == "ship.hull" else []
    )
    assert ("is not kept" in lines[-2]) == (out == "ship.hull.json")


def test_strict_refuses_suspicions(table: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """With exit code 3, and by name; without it the hull is taken and they are told."""
    asked_for = asked(table, "--draught", "0.7", "--breadth", "10")
    assert main([*asked_for, "--strict"]) == 3
    said = capsys.readouterr()
    assert said.err.startswith("error: sound with suspicions, and strict: ")
    assert "B/T is 14.29" in said.out
    assert main(asked_for) == 0
    assert capsys.readouterr().out.splitlines()[-1].startswith("verdict: sound with suspicions")
    assert main([*asked_for, "--strict", "--accept", "--replace"]) == 2
    assert "give one of them" in capsys.readouterr().err
