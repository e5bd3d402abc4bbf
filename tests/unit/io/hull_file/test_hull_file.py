"""The hull file: every commit is in it, and what comes back is what was there, to the bit."""

import subprocess
import sys
from pathlib import Path

import attrs
import pytest

import assoc_hull as ah
from assoc_hull.errors import FileBusyError, HullFileError, NameTakenError, StaleHullError
from assoc_hull.model.tables import HullState

POINT = "WL 2.5 x ST 7"
OTHER = "WL 3.75 x ST 12"


@pytest.fixture
def file(tmp_path: Path) -> Path:
    """Where a hull file goes."""
    return tmp_path / "ship.hull"


@pytest.fixture
def hull(file: Path) -> ah.Hull:
    """A Wigley hull in a file."""
    made = ah.examples.wigley()
    assert made.save(file).written
    return made


def shift(hull: ah.Hull, name: str, point: str = POINT, by: float = 0.01) -> None:
    """Move a crossing."""
    with hull.edit(name) as edit:
        edit.move(point, y=hull.points[point].y + by)


def stand(hull: ah.Hull) -> tuple[object, ...]:
    """All that a file must give back."""
    state = hull.state
    return (
        hull.fingerprint,
        [(each.name, each.number, each.author, each.time) for each in hull.history],
        [each.name for each in hull.undone],
        dict(hull.labels),
        dict(state.revision_row),
        dict(state.revision_curve),
    )


def test_an_edit_is_in_the_file_before_it_is_left(hull: ah.Hull, file: Path) -> None:
    """Another reader sees it at once, and the writer need not save."""
    shift(hull, "fuller")
    reader = ah.open(file)
    assert stand(reader) == stand(hull)
    assert [str(report) for report in reader.history] == [str(each) for each in hull.history]
    assert reader.history[0].relofted == hull.history[0].relofted
    assert reader.check() == ()
    assert reader.verify() == ()
    assert not hull.save().written
    assert "nothing to write" in str(hull.save())


def test_why_survives_the_process(hull: ah.Hull, file: Path) -> None:
    """Causes, movements and where it stopped, word for word."""
    shift(hull, "fuller")
    again = ah.open(file)
    for name in ("WL 2.5", "ST 7", POINT):
        assert str(again.why(name)) == str(hull.why(name))


def test_undo_and_redo_work_across_processes(hull: ah.Hull, file: Path) -> None:
    """Every state comes back, in whatever process it is asked for."""
    prints = [hull.fingerprint]
    for number in range(4):
        shift(hull, f"edit {number}", POINT if number % 2 else OTHER)
        prints.append(hull.fingerprint)
    hull.undo(2)
    hull.close()
    for expected, act in ((prints[2], "redo"), (prints[3], "redo"), (prints[4], "undo")):
        again = ah.open(file)
        assert again.fingerprint == expected
        getattr(again, act)()
        again.close()
    again = ah.open(file)
    assert again.fingerprint == prints[3]
    again.undo(3)
    assert again.fingerprint == prints[0]
    assert ah.open(file).fingerprint == prints[0]


def test_an_edit_after_an_undo_keeps_the_undone_ones(hull: ah.Hull, file: Path) -> None:
    """They are a branch with a name, in every process."""
    shift(hull, "first")
    shift(hull, "second")
    left = hull.fingerprint
    hull.undo()
    shift(hull, "other", OTHER)
    new = hull.fingerprint
    again = ah.open(file)
    assert {name: (each.step, each.branch) for name, each in again.labels.items()} == {
        "branch 1": (2, True)
    }
    again.go("branch 1")
    assert (again.fingerprint, [each.name for each in again.history]) == (left, ["first", "second"])
    assert set(again.labels) == {"branch 1", "branch 2"}
    again.go("branch 2")
    assert (again.fingerprint, [each.name for each in again.history]) == (new, ["first", "other"])


def test_revisions_of_what_was_undone_go_on_when_it_is_redone(hull: ah.Hull, file: Path) -> None:
    """Also if the file was closed meanwhile, and in a copy; and so for another line there."""
    with hull.edit("one more") as edit:
        edit.add_line("waterlines", 1.0)
    hull.undo()
    known = stand(hull)
    copy = ah.read(file)
    copy.save(file.with_name("copy.hull"))
    for path in (file, file.with_name("copy.hull")):
        again = ah.open(path)
        assert stand(again) == known
        again.close()
    hull.redo()
    known = stand(hull)
    again = ah.open(file.with_name("copy.hull"))
    again.redo()
    assert stand(again) == known
    assert stand(ah.open(file)) == known


def test_a_checkpoint_is_returned_to_and_compared_with(hull: ah.Hull, file: Path) -> None:
    """By name, in another process; the comparison says which lines and how far."""
    start = hull.fingerprint
    hull.checkpoint("as it came")
    shift(hull, "fuller", by=0.02)
    again = ah.open(file)
    found = again.diff("as it came")
    moved = {each.line: each.distance for each in found.lines}
    assert set(moved) == {"WL 2.5", "ST 7"}
    assert moved["WL 2.5"] == pytest.approx(
        0.02, rel=0.01
    )  # it is all but parallel to the centre plane
    assert found.numbers["volume"][1] > found.numbers["volume"][0]  # type: ignore[operator]
    again.go("as it came")
    assert again.fingerprint == start
    assert [each.name for each in again.undone] == ["fuller"]
    with pytest.raises(NameTakenError):
        again.checkpoint("as it came")


def test_the_second_writer_is_told_that_the_file_has_moved_on(hull: ah.Hull, file: Path) -> None:
    """Its edit is refused, the hull as it was; after a refresh it goes on from there."""
    second = ah.open(file)
    point = second.points[POINT]
    before = second.fingerprint
    shift(hull, "fuller")
    with pytest.raises(StaleHullError) as caught:
        shift(second, "late", OTHER)
    assert caught.value.newer == ("fuller",)
    assert (second.fingerprint, len(second.history)) == (before, 0)
    second.refresh()
    assert stand(second) == stand(hull)
    assert point.y == hull.points[POINT].y
    shift(second, "late", OTHER)
    hull.refresh()
    assert stand(hull) == stand(second)
    second.undo(2)
    hull.refresh()
    assert (hull.fingerprint, len(hull.undone)) == (before, 2)


def line_and_fold(hull: ah.Hull, position: float) -> None:
    """An edit that is refused after it has changed the structure."""
    with hull.edit("refused") as edit:
        edit.add_line("waterlines", position)
        edit.move(POINT, y=-50.0)


def test_two_writers_change_the_structure_in_turns(hull: ah.Hull, file: Path) -> None:
    """Refused edits and undone ones between; what the file says is what a reader finds."""
    second = ah.open(file)
    for number, writer in enumerate((hull, second, hull, second)):
        writer.refresh()
        shift(writer, "shape", by=0.002)
        with writer.edit("line") as edit:
            edit.add_line("waterlines", 2.6 + 0.1 * number)
        with pytest.raises(ah.AssocHullError):
            line_and_fold(writer, 2.65 + 0.1 * number)
        shift(writer, "shape", OTHER, 0.002)
        writer.undo(2)
        writer.redo()
        shift(writer, "shape", OTHER, 0.001)
        assert ah.open(file).fingerprint == writer.fingerprint


def test_a_writer_waits_for_another_one_as_long_as_asked(hull: ah.Hull, file: Path) -> None:
    """At once without a wait; a reader is never in the way."""
    second = ah.open(file)
    with hull.edit("long") as edit:
        edit.move(POINT, y=hull.points[POINT].y + 0.01)
        assert ah.open(file).fingerprint == second.fingerprint
        with pytest.raises(FileBusyError) as caught:
            shift(second, "meanwhile", OTHER)
    assert caught.value.waited == 0.0
    patient = (
        "import sys, assoc_hull as ah\n"
        "hull = ah.open(sys.argv[1], wait=30.0)\n"
        "print('ready', flush=True)\n"
        "with hull.edit('patient') as edit:\n"
        "    edit.move(sys.argv[2], y=hull.points[sys.argv[2]].y + 0.01)\n"
    )
    command = [sys.executable, "-c", patient, str(file), OTHER]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as child:
        with hull.edit("nothing"):
            assert child.stdout is not None
            assert child.stdout.readline() == "ready\n"
        assert child.wait(60) == 0
    hull.refresh()
    assert [each.name for each in hull.history] == ["long", "patient"]


def test_a_refused_or_idle_edit_leaves_no_trace(hull: ah.Hull, file: Path) -> None:
    """Neither a step nor a changed byte of the database."""
    before = stand(hull)
    with pytest.raises(ah.AssocHullError), hull.edit("too far") as edit:
        edit.move(POINT, y=-50.0)
    with hull.edit("nothing") as edit:
        edit.move(POINT, y=hull.points[POINT].y)
    assert stand(hull) == before == stand(ah.open(file))


def test_a_file_that_is_there_is_not_written_over(hull: ah.Hull, file: Path) -> None:
    """Unless it is asked for."""
    shift(hull, "fuller")
    other = ah.examples.wigley(breadth=11.0)
    with pytest.raises(ah.errors.BadInputError, match="there is a file of this name"):
        other.save(file)
    hull.close()
    assert other.save(file, replace=True).written
    assert ah.open(file).fingerprint == other.fingerprint


def test_a_hull_with_history_is_saved_with_it(file: Path) -> None:
    """Steps, undone ones, branches and labels made in memory; then every edit is kept."""
    hull = ah.examples.wigley()
    shift(hull, "one")
    hull.checkpoint("after one")
    shift(hull, "two")
    hull.undo()
    shift(hull, "three", OTHER)
    shift(hull, "four")
    hull.undo()
    hull.save(file)
    again = ah.open(file)
    assert stand(again) == stand(hull)
    for go in ("branch 1", "after one", "branch 2"):
        hull.go(go)
        again.refresh()
        assert stand(again) == stand(hull)
    assert hull.verify() == ()


def test_a_copy_is_a_file_of_its_own(hull: ah.Hull, file: Path, tmp_path: Path) -> None:
    """It holds the history, and edits go to it from then on."""
    shift(hull, "one")
    hull.save(tmp_path / "copy.hull")
    assert hull.path == tmp_path / "copy.hull"
    shift(hull, "two")
    assert [each.name for each in ah.open(file).history] == ["one"]
    assert [each.name for each in ah.open(tmp_path / "copy.hull").history] == ["one", "two"]


def test_a_file_that_was_taken_away_is_not_written_into(hull: ah.Hull, file: Path) -> None:
    """An edit that nobody could find again is refused; it can be saved elsewhere."""
    file.rename(file.with_name("moved.hull"))
    with pytest.raises(HullFileError, match="removed or replaced"):
        shift(hull, "lost")


def test_the_edits_of_one_hull_are_made_again_on_another(hull: ah.Hull, file: Path) -> None:
    """From the file, by address; one that cannot be made says why and stops the rest."""
    with hull.edit("several") as edit:
        edit.move(hull.points[POINT], y=hull.points[POINT].y + 0.01)
        edit.add_line("waterlines", 2.8)
    with hull.edit("pull", gaps="report") as edit:
        edit.pull(POINT, 0.02, (20.0, 5.0))
    with hull.edit("by a function") as edit:
        edit.transform(lambda p: p * [1.0, 1.01, 1.0], drivers=["sections", "profile"])
    other = ah.examples.wigley()
    found = other.replay(ah.open(file), skip=True)
    assert [each.report is not None for each in found] == [True, True, False]
    assert "function" in found[2].why
    hull.undo()
    assert other.fingerprint == hull.fingerprint


def test_file_text_file_keeps_the_fingerprint(hull: ah.Hull, file: Path, tmp_path: Path) -> None:
    """After edits of structure, and through the text both ways: the text keeps its bytes, too."""
    with hull.edit("structure") as edit:
        edit.add_line("waterlines", 2.8, "extra")
        edit.remove_line("ST 3")
    with hull.edit("points") as edit:
        edit.insert("WL 3.75", (20.0, 2.0, 3.75), lead=False)
        edit.set_end("WL 3.75", "start", tangent=(1.0, 0.2, 0.0))
        edit.rename(POINT, "bilge")
    one, other = tmp_path / "one.hull.json", tmp_path / "other.hull.json"
    hull.save(one)
    again = ah.open(one)
    again.save(tmp_path / "again.hull")
    ah.open(tmp_path / "again.hull").save(other)
    assert ah.open(tmp_path / "again.hull").fingerprint == hull.fingerprint
    assert one.read_bytes() == other.read_bytes()


def test_an_edit_after_opening_has_the_bits_of_one_without(hull: ah.Hull, file: Path) -> None:
    """Where a hull was closed and opened in between makes no difference to what comes."""
    shift(hull, "one")
    again = ah.examples.wigley()
    shift(again, "one")
    hull.close()
    hull = ah.open(file)
    for each in (hull, again):
        shift(each, "two", OTHER, 0.02)
        with each.edit("pull", gaps="report") as edit:
            edit.pull(POINT, 0.03, (20.0, 5.0))
        with each.edit("line") as edit:
            edit.add_line("sections", 42.0)
    assert hull.fingerprint == again.fingerprint


def test_a_closed_hull_is_read_and_not_edited(hull: ah.Hull, file: Path) -> None:
    """Reports, causes and a rebuild are there; edits, undo and refresh say that it is closed."""
    shift(hull, "one")
    hull.close()
    again = ah.open(file)
    again.close()
    assert [each.name for each in again.history] == ["one"]
    assert again.why("ST 7").edit == "one"
    assert again.verify() == ()
    for act in (again.undo, again.refresh, lambda: shift(again, "two")):
        with pytest.raises(HullFileError, match="it is closed"):
            act()
    assert ah.open(file).fingerprint == again.fingerprint


def test_a_path_is_the_same_wherever_one_stands(
    hull: ah.Hull, file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A file opened by a relative name is edited from another folder, and is its own place."""
    monkeypatch.chdir(tmp_path)
    again = ah.open("ship.hull")
    assert again.path == hull.path == file
    assert not again.save("ship.hull").written
    assert not again.save("ship.hull", replace=True).written
    (tmp_path / "elsewhere").mkdir()
    monkeypatch.chdir(tmp_path / "elsewhere")
    shift(again, "from elsewhere")
    assert [each.name for each in ah.open(file).history] == ["from elsewhere"]


def test_a_name_that_is_no_text_is_refused(hull: ah.Hull, file: Path, tmp_path: Path) -> None:
    """Of an edit, an author, a checkpoint or the ship; nothing is kept, and all goes on."""
    before = stand(hull)
    refused = r"which is no character|give printable text"
    with pytest.raises(ah.errors.BadInputError, match=refused):
        shift(hull, "fair \ud800")
    with pytest.raises(ah.errors.BadInputError, match=refused):
        hull.checkpoint("\ud800")
    with pytest.raises(ah.errors.BadInputError, match=refused):
        hull.author = "\ud800"
    assert stand(hull) == before == stand(ah.open(file))
    odd = HullState(attrs.evolve(hull.particulars, name="\ud800"))
    with pytest.raises(ah.errors.BadInputError, match="which is no character"):
        ah.Hull(odd).save(tmp_path / "odd.hull")
    assert sorted(path.name for path in tmp_path.glob("odd*")) == []
    shift(hull, "fair")


def test_an_interrupt_leaves_no_two_truths(
    hull: ah.Hull, file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Behind the commit, before memory knows: the step counts, and memory has it too."""

    def interrupted(*_: object) -> None:
        raise KeyboardInterrupt

    before = hull.fingerprint
    with monkeypatch.context() as patch:
        patch.setattr(type(hull.document.keeper), "keep", interrupted)
        with pytest.raises(KeyboardInterrupt):
            shift(hull, "cut short")
    assert [each.name for each in hull.history] == ["cut short"]
    assert hull.fingerprint == ah.open(file).fingerprint != before
    shift(hull, "next")
    assert stand(hull) == stand(ah.open(file))


def test_what_cannot_be_settled_at_once_is_before_the_next_edit(
    hull: ah.Hull, file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The file cannot be read either, for a while: the next edit finds the step in its history."""

    def interrupted(*_: object) -> None:
        raise KeyboardInterrupt

    def unreadable(*_: object) -> None:
        raise ah.errors.HullFileError(str(file), "it cannot be read", "try again")

    with monkeypatch.context() as patch:
        patch.setattr(type(hull.document.keeper), "keep", interrupted)
        patch.setattr(type(hull.document.keeper), "refresh", unreadable)
        with pytest.raises(KeyboardInterrupt):
            shift(hull, "cut short")
        with pytest.raises(ah.errors.HullFileError, match="cannot be read"):
            shift(hull, "refused")
    shift(hull, "next")
    assert [each.name for each in hull.history] == ["cut short", "next"]
    assert stand(hull) == stand(ah.open(file))
