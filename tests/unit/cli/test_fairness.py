"""The command `fairness`: its table, its document, and hulls side by side."""

from pathlib import Path

import pytest

import assoc_hull as ah
from assoc_hull.cli import main
from assoc_hull.fairing.line_fairness import FairnessTable
from tests.unit.cli.conftest import Json


def test_the_document_holds_what_the_library_gives(hull: Path, facts: Json) -> None:
    """A row for each curve with its numbers, and the curves that keep no limit."""
    found = facts("fairness", hull)
    table = ah.form.fairness(ah.open(hull))
    assert isinstance(table, FairnessTable)
    assert [each["key"] for each in found["curves"]] == list(table.keys)
    assert [each["variation"] for each in found["curves"]] == [each.variation for each in table]
    assert found["failures"].keys() == table.failures.keys()


def test_lines_can_be_chosen(hull: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Only those that are named are told."""
    assert main(["fairness", str(hull), "WL 2.5", "ST 3"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert sorted(line[:6].strip() for line in lines[1:3]) == ["ST 3", "WL 2.5"]
    assert "no line of 2 is unfair: battens spring as on the lines beside" in lines


def test_two_hulls_stand_side_by_side(
    hull: Path, tmp_path: Path, facts: Json, capsys: pytest.CaptureFixture[str]
) -> None:
    """Before and after an edit: ratios of what has no limit, curve by curve."""
    after = ah.open(hull)
    with after.edit("push") as edit:
        edit.move("WL 2.5 x ST 3", y=after.points["WL 2.5 x ST 3"].y + 0.02)
    other = tmp_path / "after.hull.json"
    after.save(other)
    rows = {each["before"]["name"]: each for each in
            facts("fairness", hull, "--compare", other)["curves"]}  # fmt: skip
    assert rows["ST 3"]["ratios"]["variation"] > 1.0
    assert rows["ST 15"]["ratios"]["variation"] == 1.0
    capsys.readouterr()
    assert main(["fairness", str(hull), "--compare", str(other)]) == 0
    assert "curves are the same" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("words", "message"),
    [
        pytest.param(["WL 77"], "WL 77", id="unknown line"),
        pytest.param(["--allowed", "-1"], "allowed is -1", id="less than no inflections"),
        pytest.param(["--compare", "nowhere.hull"], "nowhere.hull", id="no other hull"),
    ],
)
def test_what_it_cannot_answer_is_one_line(
    hull: Path, words: list[str], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """Exit code 2, nothing on standard output."""
    assert main(["fairness", str(hull), *words]) == 2
    told = capsys.readouterr()
    assert told.out == ""
    assert message in told.err
    assert len(told.err.splitlines()) == 1
