"""The history of a hull file on the command line: undo, redo, checkpoint, go, diff, replay."""

from collections.abc import Callable
from pathlib import Path

import pytest

import assoc_hull as ah
from assoc_hull.cli import main
from assoc_hull.edit.recording import ANY_FUNCTION, Script, VariedValues
from tests.unit.cli.conftest import Json

Edits = Callable[[object], Path]
POINT = "WL 2.5 x ST 7"
MOVE = [{"op": "move", "point": POINT, "y": 3.2}]


@pytest.fixture
def file(tmp_path: Path) -> Path:
    """A hull file."""
    path = tmp_path / "ship.hull"
    assert main(["example", "wigley", "-o", str(path)]) == 0
    return path


@pytest.fixture
def twice(file: Path, edits: Edits) -> Path:
    """With two edits."""
    for name, y in (("fuller", 3.2), ("fuller still", 3.21)):
        change = edits([{"op": "move", "point": POINT, "y": y}])
        assert main(["edit", str(file), str(change), "--name", name]) == 0
    return file


def test_an_edit_is_kept_in_the_file(twice: Path, facts: Json) -> None:
    """Each is a step of its own, with its name; nothing is written beside it."""
    found = facts("history", twice)
    assert [step["name"] for step in found["history"]] == ["fuller", "fuller still"]
    assert [step["number"] for step in found["history"]] == [1, 2]
    assert found["history"][0]["largest"]["point"]
    assert all(step["time"] for step in found["history"])
    assert sorted(path.name for path in twice.parent.iterdir()) == ["edits.json", "ship.hull"]


def test_undo_and_redo_go_to_and_fro(twice: Path, facts: Json) -> None:
    """By one step or several; the fingerprints come back."""
    last = ah.open(twice).fingerprint
    assert facts("undo", twice)["undo"] == ["fuller still"]
    found = facts("redo", twice)
    assert (found["redo"], found["fingerprint"], found["steps"]) == (["fuller still"], last, 2)
    assert facts("undo", twice, "2")["undo"] == ["fuller still", "fuller"]
    assert facts("history", twice)["history"] == []
    assert [step["name"] for step in facts("history", twice)["undone"]] == [
        "fuller",
        "fuller still",
    ]
    assert facts("redo", twice, "2")["fingerprint"] == last


@pytest.mark.parametrize(
    ("command", "says"),
    [
        (["undo", "3"], "3 steps were asked and there are 2 to undo"),
        (["undo", "0"], "0 steps were asked"),
        (["redo"], "there is nothing to redo"),
        (["go", "nowhere"], "there is no checkpoint or branch named 'nowhere'"),
        (["diff", "nowhere"], "there is no checkpoint or branch named 'nowhere'"),
        (
            ["diff", "b.hull"],
            "b.hull is a file, not a checkpoint, in diff; say: assoc-hull compare",
        ),
        (["undo", "--wait", "-1"], "'-1' is no time in seconds"),
    ],
)
def test_what_cannot_be_done_is_said_in_one_line(
    twice: Path, capsys: pytest.CaptureFixture[str], command: list[str], says: str
) -> None:
    """And changes nothing."""
    capsys.readouterr()
    before = twice.read_bytes()
    assert main([command[0], str(twice), *command[1:]]) == 2
    told = capsys.readouterr()
    assert (told.out, told.err.count("\n")) == ("", 1)
    assert told.err.startswith("error: ")
    assert says in told.err
    assert twice.read_bytes() == before


def test_text_has_no_history(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The way to a hull file is told, and it works."""
    text, file = tmp_path / "ship.hull.json", tmp_path / "ship.hull"
    assert main(["example", "wigley", "-o", str(text)]) == 0
    capsys.readouterr()
    assert main(["undo", str(text)]) == 2
    assert "assoc-hull import SHIP.hull.json -o SHIP.hull" in capsys.readouterr().err
    assert main(["import", str(text), "-o", str(file)]) == 0
    assert ah.open(file).fingerprint == ah.open(text).fingerprint


def test_a_checkpoint_is_gone_to_and_compared_with(
    twice: Path, edits: Edits, facts: Json, capsys: pytest.CaptureFixture[str]
) -> None:
    """What is left on the way is on a branch with a name."""
    facts("undo", twice)
    assert facts("checkpoint", twice, "one") == {"checkpoint": "one", "step": 1}
    change = edits([{"op": "rename", "obj": None, "name": "Sister"}, {"op": "pin", "point": POINT}])
    assert main(["edit", str(twice), str(change)]) == 2  # a crossing cannot be pinned
    change = edits([{"op": "rename", "obj": None, "name": "Sister"}])
    assert main(["edit", str(twice), str(change), "--name", "named"]) == 0
    found = facts("history", twice)
    labels = {label["name"]: (label["step"], label["branch"]) for label in found["labels"]}
    assert labels == {"one": (1, False), "branch 1": (2, True)}
    assert facts("diff", twice, "one")["diff"]["names"] == ["Wigley", "Sister"]
    found = facts("diff", twice, "one", "branch 1")["diff"]
    assert {line["line"] for line in found["lines"]} == {"WL 2.5", "ST 7"}
    assert max(line["distance"] for line in found["lines"]) == pytest.approx(0.01, rel=0.02)
    assert found["numbers"]["volume"][1] > found["numbers"]["volume"][0]
    assert facts("go", twice, "branch 1")["left"] == ["branch 2"]
    capsys.readouterr()
    assert main(["history", str(twice)]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert [line.split("  ")[-2 if "curves" in line else -1].strip() for line in lines] == [
        "fuller", "[one]", "fuller still", "[branch 1]", "> the present state",
        "branch or checkpoint elsewhere: branch 2",
    ]  # fmt: skip


def test_an_edit_elsewhere_leaves_the_file_alone(twice: Path, edits: Edits, facts: Json) -> None:
    """With -o: a copy with all the history and the edit, or its text."""
    before, change = twice.read_bytes(), edits([{"op": "move", "point": POINT, "y": 3.22}])
    copy, text = twice.with_name("copy.hull"), twice.with_name("copy.hull.json")
    found = facts("edit", twice, change, "-o", copy, "--name", "more")
    assert facts("edit", twice, change, "-o", text)["fingerprint"] == found["fingerprint"]
    names = [step["name"] for step in facts("history", copy)["history"]]
    assert names == ["fuller", "fuller still", "more"]
    assert facts("undo", copy, "3")["steps"] == 0
    assert twice.read_bytes() == before
    assert main(["edit", str(twice), str(change), "-o", str(copy)]) == 2
    assert facts("edit", twice, change, "-o", copy, "--replace")["fingerprint"]


def test_edits_are_made_again_on_a_sister(twice: Path, tmp_path: Path, facts: Json) -> None:
    """Each as a step of its own; exit 1 where one cannot be made, which is named."""
    sister, other = tmp_path / "sister.hull", tmp_path / "other.hull"
    ah.examples.wigley(breadth=10.5).save(sister)
    ah.examples.wigley(stations=5, waterlines=4).save(other)
    found = facts("replay", twice, sister)
    assert [edit["made"] for edit in found["edits"]] == [True, True]
    assert [step["name"] for step in facts("history", sister)["history"]] == [
        "fuller", "fuller still",
    ]  # fmt: skip
    found = facts("replay", twice, other, code=1)
    assert (len(found["edits"]), found["left"]) == (1, 1)
    assert POINT in found["edits"][0]["why"]
    found = facts("replay", twice, other, "--skip", "-o", tmp_path / "third.hull", code=1)
    assert len(found["edits"]) == 2


def test_variations_are_made_again_on_a_sister(
    file: Path, tmp_path: Path, facts: Json, capsys: pytest.CaptureFixture[str]
) -> None:
    """By the values asked for, set or reached; from the file, in another process."""
    sister = tmp_path / "sister.hull"
    ah.examples.wigley(length=110.0).save(sister)
    facts("vary", file, "breadth=11")
    facts("vary", file, "--reach", "volume=2900", "--free", "draught")
    facts("shift", file, "--by", "cb=0.005")
    found = facts("replay", file, sister)
    assert [(edit["made"], edit["why"]) for edit in found["edits"]] == [(True, "")] * 3
    made = ah.open(sister)
    assert made.particulars.breadth == pytest.approx(11.0)
    made.undo()
    assert made.hydrostatics().volume == pytest.approx(2900.0, rel=1e-8)


def test_nothing_is_said_to_be_written_where_no_edit_was_made(
    twice: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Nor is it: not for an edit that cannot be made, and not for a hull without edits."""
    bare, out = tmp_path / "bare.hull", tmp_path / "out.hull"
    ah.examples.wigley(stations=5, waterlines=4).save(bare)
    for source, onto, code in ((twice, bare, 1), (bare, twice, 0)):
        assert main(["replay", str(source), str(onto), "-o", str(out)]) == code
        assert "written:" not in capsys.readouterr().out
        assert not out.exists()


def test_a_step_that_cannot_be_repeated_gives_its_own_reason() -> None:
    """A function, a variation of which an older file kept the values, and what is neither."""
    steps = (
        (Script(edits=({"op": "transform", "function": ANY_FUNCTION},)), "given a function"),
        (Script(varied=VariedValues(set={"breadth": 11.0})), "vary this hull again, by breadth=11"),
        (Script(), "made of no modifications"),
    )
    one, hull = ah.examples.wigley(), ah.examples.wigley()
    one.apply("moved", MOVE)
    for script, why in steps:
        one.document.history[0].script = script
        found = hull.replay(one)
        assert found[0].report is None
        assert why in found[0].why


def test_one_step_is_told_in_full(
    twice: Path, edits: Edits, facts: Json, capsys: pytest.CaptureFixture[str]
) -> None:
    """What was asked for can be asked again as it stands there; the report is that of the edit."""
    found = facts("history", twice, "--step", "2")
    assert found["edits"] == [{"op": "move", "point": POINT, "y": 3.21, "lead": False}]
    assert (found["name"], found["parent"]) == ("fuller still", 1)
    assert found["report"]["relofted"] == list(ah.open(twice).history[1].relofted)
    facts("undo", twice)
    assert facts("edit", twice, edits(found["edits"]))["fingerprint"] == found["fingerprint"]
    assert main(["history", str(twice), "--step", "2"]) == 0
    told = capsys.readouterr().out
    assert '{"op": "move", "point": "WL 2.5 x ST 7", "y": 3.21, "lead": false}' in told
    assert "curves re-lofted" in told
    assert main(["history", str(twice), "--step", "9"]) == 2
    assert "step 9 was asked, and there are 3" in capsys.readouterr().err


def test_why_is_answered_from_the_file(twice: Path, facts: Json) -> None:
    """In another process than the edit: which edit, and through what."""
    found = facts("why", twice, "ST 7")
    assert (found["edit"], found["step"]) == ("fuller still", 2)
    assert found["causes"][0]["name"] == POINT


def test_only_what_an_edit_changed_is_drawn(twice: Path, facts: Json) -> None:
    """The graph of the last edit, and of an earlier one."""
    for number in ("1", "2"):
        found = facts("graph", twice, "--only", "changed", "--step", number)
        names = {node.get("name") for node in found["nodes"]}
        assert {"WL 2.5", "ST 7"} <= names
        assert "ST 8" not in names


def test_a_dry_run_takes_no_lock_and_writes_nothing(twice: Path, edits: Edits, facts: Json) -> None:
    """While another writer is at it."""
    change = edits([{"op": "move", "point": POINT, "y": 3.22}])
    writer = ah.open(twice)
    with writer.edit("long"):
        assert not facts("edit", twice, change, "--dry-run")["refused"]
        assert main(["edit", str(twice), str(change)]) == 2
    writer.close()
    assert len(facts("history", twice)["history"]) == 2
