"""`check` exits 1 and names each planted defect, from a file or whatever else holds the hull."""

from collections.abc import Callable
from pathlib import Path

import pytest

import assoc_hull as ah
from assoc_hull.cli import inspection, main
from assoc_hull.io.hull_json import dumps_hull_json
from assoc_hull.model.tables import HullState
from tests.unit.cli.conftest import Json
from tests.unit.edit.planted_defects import every_defect, planted, sound

HELD = {
    "a failed curve",
    "a blocked point",
    "a fold",
    "a gap",
    "a missing twin link: one curve does not list the crossing",
    "a broken association: one-way, and shared",
    "a broken association: a meeting without its crossing",
}
"""Defects that the text form can hold; the others contradict what it is made of."""
FILED = (HELD - {"a fold"}) | {
    "a fold through its points",
    "a friend that does not read",
    "a shared crossing with a driver",
    "a driver of nothing",
    "an orphan: a point on no curve",
    "an orphan: a curve through a point that has gone",
    "an orphan: points on a curve that has gone",
    "an orphan: a curve of no line",
    "an orphan: a curve of a line that has gone",
    "an orphan: a curve its line does not list",
    "an orphan: lines of a group that has gone",
    "an orphan: a line of no group",
    "a missing twin link: a crossing of one curve",
    "a missing twin link: a crossing of two other curves",
    "a broken association: crossings without one",
    "a broken association: driven against it",
    "a broken association: of no group",
    "a broken association: declared twice",
    "a ring",
    "a role that there is not",
    "a sort that there is not",
    "a state that there is not",
    "a family that there is not",
    "a key that two points have",
}
"""Defects that a hull file can hold: its tables are kept row by row, splines made of the points."""
REFUSED = {
    "a point out of its plane",
    "two points at one place",
    "an orphan: a point its curve does not know",
    "an orphan: points on a curve that has gone",
    "an orphan: a curve of no line",
    "a missing twin link: a crossing of one curve",
    "a missing twin link: a crossing of two other curves",
    "a broken association: crossings without one",
    "a broken association: of no group",
    "a broken association: declared twice",
    "a family that there is not",
    "a key that two points have",
}
"""Some that it can be made to tell and that opening names already."""
Opened = Callable[[HullState], Path]


@pytest.fixture
def opened(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Opened:
    """Let the command open these tables, as a file holds them that stores them row by row."""

    def give(state: HullState) -> Path:
        monkeypatch.setattr(inspection, "open_hull", lambda _, damaged: ah.Hull(state))
        return tmp_path / "ship.hull.json"

    return give


@every_defect
def test_check_exits_1_and_names_the_defect(name: str, opened: Opened, facts: Json) -> None:
    """Kind, object and message; no defect makes it stumble."""
    state = sound()
    defect = planted(name, state)
    found = facts("check", opened(state), "--notes", code=1)["findings"]
    mine = [each for each in found if each["kind"] == defect.kind]
    assert any(defect.object in each["object"] for each in mine), found


@pytest.mark.parametrize("name", sorted(HELD))
def test_the_text_form_holds_the_defect(
    name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It is written, opened as it is, and check names it in words on a line of its own."""
    state = sound()
    defect, file = planted(name, state), tmp_path / "ship.hull.json"
    ah.Hull(state).save(file)
    assert main(["check", str(file)]) == 1
    told = capsys.readouterr()
    assert told.err == ""
    *lines, last = told.out.splitlines()
    assert any(line.startswith(f"{defect.kind}: {defect.object}") for line in lines), lines
    assert last == f"{len(lines)} finding" + ("s" if len(lines) > 1 else "")


@pytest.mark.parametrize("name", sorted(FILED))
def test_a_hull_file_holds_the_defect(
    name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It opens, and check exits 1 and names it."""
    state = sound()
    defect, file = planted(name, state), tmp_path / "ship.hull"
    hull = ah.Hull(state)
    hull.save(file)
    hull.close()
    assert main(["check", "--notes", str(file)]) == 1
    told = capsys.readouterr()
    assert told.err == ""
    lines = [line for line in told.out.splitlines() if line.startswith(f"{defect.kind}: ")]
    assert any(defect.object in line for line in lines), told.out


@pytest.mark.parametrize("name", sorted(REFUSED))
def test_opening_refuses_what_the_text_form_contradicts(
    name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """There is no hull to check: exit 2, and one line that says what and where."""
    state = sound()
    planted(name, state)
    file = tmp_path / "ship.hull.json"
    file.write_text(dumps_hull_json(state), "utf-8")
    assert main(["check", str(file)]) == 2
    told = capsys.readouterr()
    assert (told.out, told.err.count("\n")) == ("", 1)
    assert told.err.startswith("error: ")
    assert str(file) in told.err
