"""Edits from a file: carried out, tried, refused, explained."""

from collections.abc import Callable
from pathlib import Path

import pytest

import assoc_hull as ah
from assoc_hull.cli import main
from tests.unit.cli.conftest import Json

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


def test_a_hull_is_edited_in_place_however_it_is_named(
    hull: Path, edits: Edits, facts: Json
) -> None:
    """-o may say the same file by another path, or by a link; the history goes on."""
    file, link = hull.with_name("ship.hull"), hull.with_name("link.hull")
    ah.read(hull).save(file)
    link.symlink_to(file)
    for out in (file.parent / "." / file.name, file.parent / ".." / file.parent.name / file.name):
        facts("edit", file, edits(moved(file, 0.01)), "-o", out)
    facts("edit", file, edits(moved(file, 0.01)), "-o", link)
    facts("replay", file, file, "-o", link)
    assert link.is_symlink()
    assert len(ah.open(file).history) == 6


def test_the_verbs_of_a_loftsman_come_from_a_file(hull: Path, edits: Edits, facts: Json) -> None:
    """Moves by a vector, a run, an arc, a hollow made longer, a knuckle line and its removal."""
    ship, chine = ah.open(hull), [f"ST {number} x WL 2.5" for number in (15, 16, 17)]
    for asked in (
        [{"op": "move", "point": [POINT], "by": [0, -0.1, 0]}],
        [{"op": "spread", "point": POINT, "length": 40}],
        [{"op": "straighten", "line": "WL 5", "a": "WL 5 x ST 11", "b": "WL 5 x ST 13"}],
        [{"op": "round", "line": "ST 10", "a": "ST 10 x WL 0.625", "b": "ST 10 x WL 5.625",
          "radius": 5}],
        [{"op": "knuckle_line", "name": "chine", "points": chine}],
        [{"op": "remove_knuckle_line", "line": "chine"}],
    ):  # fmt: skip
        ship.apply("edits", asked)
        found = facts("edit", hull, edits(asked))
        assert found["refused"] is False
        assert found["fingerprint"] == ship.fingerprint


def test_a_dry_run_writes_nothing(hull: Path, edits: Edits, facts: Json) -> None:
    """And reports what the edit then does, with the fingerprint that the hull then has."""
    before, file = hull.read_bytes(), edits(moved(hull, 0.01))
    trial = facts("edit", hull, file, "--dry-run")
    assert (hull.read_bytes(), trial["saved"]) == (before, None)
    assert sorted(each.name for each in hull.parent.iterdir()) == ["edits.json", "ship.hull.json"]
    done = facts("edit", hull, file)
    for name in ("refused", "edit", "inflections", "fingerprint"):
        assert trial[name] == done[name]
    for name in ("seconds", "number", "author", "time"):
        trial["report"].pop(name)
        assert done["report"].pop(name) or name == "author"
    assert trial["report"] == done["report"]


def test_a_dry_run_needs_no_place_to_write(hull: Path, edits: Edits, facts: Json) -> None:
    """A hull that may only be read, in a folder that may only be read."""
    file = edits(moved(hull, 0.01))
    modes = {each: each.stat().st_mode for each in (hull, hull.parent)}
    try:
        hull.chmod(0o444)
        hull.parent.chmod(0o555)
        assert facts("edit", hull, file, "--dry-run")["refused"] is False
    finally:
        for each, mode in modes.items():
            each.chmod(mode)


def test_a_dry_run_tells_lines_movement_and_place(hull: Path, edits: Edits, facts: Json) -> None:
    """As data: each line with the point that moves most, and the change of what is displaced."""
    found = facts("edit", hull, edits(moved(hull, 0.01)), "--dry-run")
    names = [(each["group"], each["line"], each["point"]) for each in found["lines"]]
    assert names == [("sections", "ST 7", POINT), ("waterlines", "WL 2.5", POINT)]
    for each in found["lines"]:
        assert each["distance"] == pytest.approx(0.01)
        assert each["place"] == pytest.approx([35.0, ah.open(hull).points[POINT].y + 0.01, 2.5])
    preview = ah.open(hull).preview(moved(hull, 0.01))
    assert found["volume_change"] == preview.volume_change
    assert found["lcb_change"] == preview.lcb_change
    assert preview.volume_change is not None
    assert preview.volume_change > 0.0


def test_a_dry_run_of_a_fair_edit_tells_the_plain_field_too(
    hull: Path, edits: Edits, facts: Json, capsys: pytest.CaptureFixture[str]
) -> None:
    """In words and as data; of a plain edit there is nothing beside."""
    pull = {"op": "pull", "point": POINT, "d": 0.02, "radius": [15, 4]}
    file = edits([{**pull, "fair": True}])
    plain = facts("edit", hull, file, "--dry-run")["plain"]
    alone = facts("edit", hull, edits([pull]), "--dry-run")
    assert (plain["lines"], plain["inflections"]) == (alone["lines"], alone["inflections"])
    assert alone["plain"] is None
    assert main(["edit", str(hull), str(edits([{**pull, "fair": True}])), "--dry-run"]) == 0
    told = capsys.readouterr().out
    assert "  with the plain field\n    would change 15 lines\n" in told


def test_a_dry_run_tells_it_in_words(
    hull: Path, edits: Edits, capsys: pytest.CaptureFixture[str]
) -> None:
    """By group: how many, which, the largest movement and where; then what remains."""
    changes = [{"op": "pull", "point": POINT, "d": 0.02, "radius": [15, 4]}]
    assert main(["edit", str(hull), str(edits(changes)), "--dry-run"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[:2] == ["edits", "  would change 15 lines"]
    assert lines[2] == "  sections     5"
    assert lines[3] == "    lines        ST 5, ST 6, ST 7, ST 8, ST 9"
    assert lines[4].startswith(f"    most         26.567 mm at {POINT} (35.000, 2.939, 2.500) m")
    assert lines[5] == "  waterlines   10, 1 of them by less than 0.1 mm"
    assert [line.split()[0] for line in lines[-4:-1]] == ["inflections", "largest", "volume"]
    assert "LCB" in lines[-2]
    assert lines[-1] == "nothing written"


def test_a_lead_in_a_file_tells_what_followed(
    hull: Path, edits: Edits, capsys: pytest.CaptureFixture[str]
) -> None:
    """Its notes are printed, by the dry run as by the edit."""
    x, y, z = ah.open(hull).points[POINT].position
    line = POINT.split(" x ")[0]
    changes = [{"op": "lead", "line": line, "points": [[POINT, [x, y + 0.01, z]]]}]
    file = edits(changes)
    assert main(["edit", str(hull), str(file)]) == 0
    told = " ".join(capsys.readouterr().out.split())
    assert f"{line} leads over x 0.00 to 100.00 m: {POINT}" in told
    assert ah.open(hull).points[POINT].y == y + 0.01


def test_a_dry_run_of_nothing_says_so(
    hull: Path, edits: Edits, facts: Json, capsys: pytest.CaptureFixture[str]
) -> None:
    """A point that lies there already."""
    file = edits(moved(hull, 0.0))
    assert facts("edit", hull, file, "--dry-run")["lines"] == []
    assert main(["edit", str(hull), str(file), "--dry-run"]) == 0
    assert "nothing would change" in capsys.readouterr().out


def test_a_dry_run_tells_every_reason_of_a_refusal(
    hull: Path, edits: Edits, facts: Json, capsys: pytest.CaptureFixture[str]
) -> None:
    """Those of the edit itself, with its exit code."""
    file, before = edits(moved(hull, 40.0)), hull.read_bytes()
    trial = facts("edit", hull, file, "--dry-run", code=1)
    assert trial == facts("edit", hull, file, code=1)
    assert len(trial["findings"]) > 1
    assert main(["edit", str(hull), str(file), "--dry-run"]) == 1
    told = capsys.readouterr()
    assert told.out.splitlines() == trial["findings"]
    assert told.err.startswith("would be refused: edit 'edits', ")
    assert hull.read_bytes() == before


def test_an_error_of_a_dry_run_names_the_modification(
    hull: Path, edits: Edits, capsys: pytest.CaptureFixture[str]
) -> None:
    """In the words of the real run."""
    for wrong in (
        {"op": "move", "point": POINT, "x": 1.0},
        {"op": "move", "point": POINT, "y": []},
    ):
        file, told = edits([{"op": "rename", "obj": "WL 5", "name": "five"}, wrong]), []
        for option in ([], ["--dry-run"]):
            assert main(["edit", str(hull), str(file), *option]) == 2
            told.append(capsys.readouterr().err)
        assert told[0] == told[1]
        assert "modification 2" in told[0]


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
    assert f"moved most   {POINT}, by 7.5 mm along the normal" in text
    assert f"with slides  {POINT}, by 10.0 mm" in text
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


def test_a_tunnel_is_typed_and_told(
    hull: Path, facts: Json, capsys: pytest.CaptureFixture[str]
) -> None:
    """It stands in the file, in `info` and in the head of hydrostatics; taken away it is not."""
    before = ah.open(hull).fingerprint
    facts("edit", hull, "tunnel", "bow thruster", "x=80", "z=3", "radius=700mm")
    assert facts("info", hull)["tunnels"] == [
        {"name": "bow thruster", "x": 80.0, "z": 3.0, "radius": 0.7}
    ]
    assert main(["info", str(hull)]) == 0
    assert "bow thruster: 1.4 m across at x 80, z 3 m" in capsys.readouterr().out
    assert main(["hydrostatics", str(hull), "--draught", "6"]) == 0
    assert "taken off as far as it is immersed" in " ".join(capsys.readouterr().out.split())
    assert main(["edit", str(hull), "tunnel", "another", "x=20"]) == 2
    assert "tunnel takes NAME x= z= radius=" in capsys.readouterr().err
    facts("edit", hull, "remove_tunnel", "bow thruster")
    assert ah.open(hull).fingerprint == before


def test_what_was_born_is_told_by_the_names_of_lines(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """No key of the program, such as ``sections:36.000000 +1``, is shown."""
    path = tmp_path / "ship.hull"
    ah.examples.wigley().save(path)
    assert main(["edit", str(path), "add_line", "waterlines", "3.3"]) == 0
    told = capsys.readouterr().out.partition("born")[2]
    assert "ST 7 x WL 3.3" in told or "WL 3.3 x ST 7" in told
    assert "sections:" not in told


@pytest.mark.parametrize("how", [[], ["--dry-run"]])
def test_a_pull_without_a_radius_tells_how_far_it_reaches(
    hull: Path, how: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    """Nobody asked for it, and nothing beyond moves; who gives one is told nothing."""
    assert main(["edit", str(hull), "pull", POINT, "10mm", *how]) == 0
    (told,) = [each for each in capsys.readouterr().out.splitlines() if "radius  " in each]
    reach = float(told.split()[1])
    given = ["--radius", str(reach), str(reach)]
    assert main(["edit", str(hull), "pull", POINT, "10mm", *given, *how]) == 0
    assert "radius  " not in capsys.readouterr().out
