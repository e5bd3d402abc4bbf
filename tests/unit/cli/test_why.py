"""Why an object is as it is, asked of a hull: in words, as a tree, as data."""

import io
import itertools
import json
from collections.abc import Callable
from pathlib import Path

import pytest

import assoc_hull as ah
from assoc_hull.cli import inspection, main
from tests.unit.cli.conftest import Json

POINT = "WL 2.5 x ST 7"
Told = Callable[..., str]


@pytest.fixture
def told(hull: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> Told:
    """Ask a hull that has a history, whatever kind of file would hold it."""
    ship = ah.open(hull)
    with ship.edit("fair") as edit:
        edit.set_role("WL 5 x ST 7", "drives b")
    with ship.edit("fill out") as edit:
        edit.move(POINT, y=ship.points[POINT].y + 0.01)
    monkeypatch.setattr(inspection, "open_hull", lambda _: ship)

    def ask(*arguments: str, code: int = 0) -> str:
        capsys.readouterr()
        assert main(["why", str(hull), *arguments]) == code
        return capsys.readouterr().out

    return ask


@pytest.mark.parametrize("option", [(), ("--tree",)], ids=["words", "tree"])
def test_without_history_no_edit_has_reached_it(
    option: tuple[str, ...], hull: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A text form holds none; that is no error."""
    assert main(["why", str(hull), POINT, *option]) == 0
    assert capsys.readouterr().out == f"{POINT}: as it was made: no edit has reached it\n"


def test_without_history_data_say_so_too(hull: Path, facts: Json) -> None:
    """No edit, no step, no causes."""
    found = facts("why", hull, "ST 7")
    assert (found["object"], found["edit"], found["step"]) == ("sections:35.000000/1", None, 0)
    assert (found["causes"], found["moved"]) == ([], None)


def test_words_are_those_of_the_python_object(told: Told) -> None:
    """Edit, object, causes below it."""
    lines = told("WL 5").splitlines()
    assert lines[0] == "edit 2, 'fill out':"
    assert lines[1].startswith("WL 5: followed, moved ")
    assert lines[2].startswith("  WL 5 x ST 7: followed, moved ")
    assert lines[-1].lstrip() == f"{POINT}: set by the edit, moved 10.000 mm"


def test_the_tree_has_the_lines_of_the_text(told: Told) -> None:
    """Each after its branch; the marks join up: each begins below a branch or the text above."""
    tree, text = told("WL 5", "--tree").splitlines(), told("WL 5").splitlines()
    assert [line.lstrip("│├└─ ") for line in tree] == [line.lstrip() for line in text]
    assert tree[2].startswith("└─ WL 5 x ST 7")
    for above, line in itertools.pairwise(tree[1:]):
        mark = max(line.find("├"), line.find("└"))
        assert above[mark : mark + 1] not in ("", " "), (above, line)


def test_the_tree_is_drawn_with_plain_marks_where_others_cannot_be_printed(
    told: Told, hull: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """On an output that takes ASCII only."""
    assert "└─ " in told("WL 5", "--tree")
    narrow = io.TextIOWrapper(io.BytesIO(), encoding="ascii")
    monkeypatch.setattr("sys.stdout", narrow)
    assert main(["why", str(hull), "WL 5", "--tree"]) == 0
    narrow.seek(0)
    assert "\n`- WL 5 x ST 7" in narrow.read()


def test_data_hold_the_whole_tree(told: Told) -> None:
    """Objects by key and name, movements in m."""
    found = json.loads(told("WL 5", "--json"))
    assert (found["edit"], found["step"]) == ("fill out", 2)
    while found["causes"]:
        found = found["causes"][0]
    assert (found["name"], found["what"]) == (POINT, "set by the edit")
    assert found["moved"] == pytest.approx(0.01)


def test_objects_are_asked_by_address_or_key(told: Told) -> None:
    """A line means its first curve."""
    assert told("WL 5") == told("waterlines:5.000000") == told("waterlines:5.000000/1")
    assert told("WL 5") == told("WL 5 [1]")


@pytest.mark.parametrize("name", ["WL 77", "", "sections", "WL 5 x WL 2.5"])
def test_what_cannot_be_asked_is_refused(
    name: str, hull: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """In one line, exit 2."""
    assert main(["why", str(hull), name]) == 2
    told = capsys.readouterr()
    assert (told.out, told.err.count("\n")) == ("", 1)
    assert told.err.startswith("error: ")


def test_tree_and_data_exclude_each_other(hull: Path) -> None:
    """There is one form of output."""
    assert main(["why", str(hull), POINT, "--tree", "--json"]) == 2
