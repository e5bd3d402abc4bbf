"""Edits from a file: carried out, tried, refused, explained."""

from collections.abc import Callable
from pathlib import Path

import pytest

import assoc_hull as ah
from assoc_hull.cli import main

from .conftest import Json

POINT = "WL 2.5 x ST 7"
Edits = Callable[[object], Path]


def moved(hull: Path, by: float) -> list[dict[str, object]]:
    """Edits that move a point."""
    return [{"op": "move", "point": POINT, "y": ah.open(hull).points[POINT].y + by}]


def test_an_edit_replaces_the_hull(hull: Path, edits: Edits, facts: Json) -> None:
    """The file holds what the same edit gives in Python; the report is that of Python."""
    ship, changes = ah.open(hull), moved(hull, 0.01)
    report = ship.apply("edits", changes)
    found = facts("edit", hull, edits(changes))
    assert found["fingerprint"] == ship.fingerprint == ah.open(hull).fingerprint
    assert (found["refused"], found["saved"], found["edit"]) == (False, str(hull), "edits")
    assert report is not None
    assert found["report"]["relofted"] == list(report.relofted)
    assert found["report"]["largest"]["distance"] == pytest.approx(0.01)
    assert found["report"]["largest_gap"] == report.largest_gap


def test_the_first_hull_stays_if_another_is_named(hull: Path, edits: Edits, facts: Json) -> None:
    """With -o; the name of the edit may be given."""
    before, out = hull.read_bytes(), hull.with_name("other.hull.json")
    found = facts("edit", hull, edits(moved(hull, 0.01)), "-o", out, "--name", "bulge")
    assert (hull.read_bytes(), found["edit"]) == (before, "bulge")
    assert ah.open(out).fingerprint == found["fingerprint"]


def test_a_dry_run_writes_nothing(hull: Path, edits: Edits, facts: Json) -> None:
    """And reports the same."""
    before = hull.read_bytes()
    found = facts("edit", hull, edits(moved(hull, 0.01)), "--dry-run")
    assert (hull.read_bytes(), found["saved"]) == (before, None)
    assert found["fingerprint"] != ah.open(hull).fingerprint
    assert len(found["report"]["relofted"]) == 2


def test_an_edit_tells_why(hull: Path, edits: Edits, facts: Json) -> None:
    """The chain of causes ends at the point that was set; also in words."""
    file = edits(moved(hull, 0.01))
    found = facts("edit", hull, file, "--dry-run", "--why", "ST 7", "--why", POINT)
    cause = found["why"]["ST 7"]
    assert (cause["name"], cause["edit"]) == ("ST 7", "edits")
    assert cause["causes"][0]["name"] == POINT
    assert found["why"][POINT]["what"] == "set by the edit"


def test_an_edit_is_told_in_words(
    hull: Path, edits: Edits, capsys: pytest.CaptureFixture[str]
) -> None:
    """Curves by name, lengths in mm."""
    assert main(["edit", str(hull), str(edits(moved(hull, 0.01))), "--why", "ST 7"]) == 0
    text = capsys.readouterr().out
    assert "2 curves re-lofted (sections 1, waterlines 1)" in text
    assert f"moved most   {POINT}, by 10.0 mm" in text
    assert "why ST 7\nedit 1, 'edits':" in text
    assert f"written: {hull}" in text


def test_several_modifications_are_one_edit(hull: Path, edits: Edits, facts: Json) -> None:
    """A pull, a pin and a new line."""
    changes = [
        {"op": "pull", "point": POINT, "d": 0.02, "radius": [15, 4]},
        {"op": "rename", "obj": "WL 2.5", "name": "middle"},
    ]
    found = facts("edit", hull, edits(changes))
    assert len(found["report"]["relofted"]) > 2
    assert "middle" in ah.open(hull).lines


def test_a_refused_edit_leaves_the_file(
    hull: Path, edits: Edits, facts: Json, capsys: pytest.CaptureFixture[str]
) -> None:
    """A fold: exit 1, its place among the findings, the same bytes in the file."""
    before, file = hull.read_bytes(), edits(moved(hull, 40.0))
    found = facts("edit", hull, file, code=1)
    assert (found["refused"], found["saved"], hull.read_bytes()) == (True, None, before)
    assert any("fold" in each for each in found["findings"])
    assert main(["edit", str(hull), str(file)]) == 1
    told = capsys.readouterr()
    assert "folds back on itself" in told.out
    assert told.err.startswith("refused: edit 'edits', ")
    assert hull.read_bytes() == before
