"""Several handles on one hull file, other names of it, and what may not be done meanwhile."""

import os
import shutil
import sqlite3
import subprocess
import sys
import threading
from collections.abc import Callable
from pathlib import Path

import pytest

import assoc_hull as ah
from assoc_hull.errors import (
    AssocHullError,
    BadInputError,
    DamagedFileError,
    HullBusyError,
    HullFileError,
    StaleHullError,
)
from assoc_hull.io.open_databases import is_open_here, log_file

POINT = "WL 4.6875 x ST 3"


@pytest.fixture
def file(tmp_path: Path) -> Path:
    """A hull file with one edit, closed."""
    hull = ah.examples.wigley(stations=7, waterlines=5)
    path = tmp_path / "ship.hull"
    hull.save(path)
    shift(hull, "one")
    hull.close()
    return path


def shift(hull: ah.Hull, name: str) -> None:
    """Move a crossing."""
    with hull.edit(name) as edit:
        edit.move(POINT, y=hull.points[POINT].y + 0.01)


def names(hull: ah.Hull) -> list[str]:
    """Names of the edits."""
    return [report.name for report in hull.history]


@pytest.mark.parametrize("name", ["new.hull", "new.hull.json"])
def test_the_name_of_a_new_file_is_brought_to_the_disk(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    """What is on the disk without a name would be lost with the power."""
    brought, really = list[Path](), os.fsync

    def fsync(handle: int) -> None:
        brought.append(Path(os.readlink(f"/proc/self/fd/{handle}")))
        really(handle)

    monkeypatch.setattr(os, "fsync", fsync)
    ah.examples.wigley(stations=7, waterlines=5).save(tmp_path / name)
    assert brought[-1] == tmp_path


def test_a_relative_name_holds_when_the_working_folder_changes(
    file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The file is known by its whole path from the moment it is opened."""
    (file.parent / "elsewhere").mkdir()
    monkeypatch.chdir(file.parent)
    hull = ah.open(file.name)
    assert not hull.save(file.name).written
    assert not hull.save(file).written
    monkeypatch.chdir("elsewhere")
    shift(hull, "two")
    assert hull.path == file
    assert names(ah.open(file)) == ["one", "two"]


def test_a_link_leads_to_the_file_and_its_log(file: Path) -> None:
    """Through a link and by its own name the file is the same one."""
    folder = file.parent / "links"
    folder.mkdir()
    (folder / "link.hull").symlink_to(file)
    hull = ah.open(folder / "link.hull")
    shift(hull, "two")
    assert not hull.save(file).written
    assert not hull.save(folder / "link.hull").written
    assert [each.name for each in folder.iterdir()] == ["link.hull"]
    assert names(ah.open(file)) == ["one", "two"]


def test_a_forked_process_opens_the_file_anew(file: Path) -> None:
    """The database it inherits is not its own."""
    hull = ah.open(file)
    reader, writer = os.pipe()
    pid = os.fork()
    if not pid:
        try:
            shift(hull, "inherited")
        except HullFileError as error:
            os.write(writer, str(error).encode())
        finally:
            os._exit(0)
    os.waitpid(pid, 0)
    os.close(writer)
    with os.fdopen(reader) as told:
        assert "before this process was forked" in told.read()
    shift(hull, "here")


def test_an_open_edit_is_not_exported(file: Path) -> None:
    """What it has asked for by then is no hull yet."""
    hull = ah.open(file)
    with hull.edit("half") as edit:
        edit.add_line("waterlines", 2.0)
        with pytest.raises(ah.errors.BadInputError, match="an edit is open, in export"):
            hull.export(file.with_name("offsets.csv"))
    assert not file.with_name("offsets.csv").exists()


@pytest.mark.parametrize(
    "act",
    [
        lambda hull: hull.undo(),
        lambda hull: hull.refresh(),
        lambda hull: hull.save(hull.path.with_name("copy.hull")),
        lambda hull: shift(hull, "two"),
    ],
)
def test_a_closed_file_is_said_to_be_closed(file: Path, act: Callable[[ah.Hull], object]) -> None:
    """Nobody is told that it is damaged."""
    hull = ah.open(file)
    hull.close()
    with pytest.raises(HullFileError, match=r"it is closed, at .*; open it again"):
        act(hull)


@pytest.mark.parametrize(
    "act",
    [
        lambda hull: hull.refresh(),
        lambda hull: hull.close(),
        lambda hull: hull.detach(),
        lambda hull: hull.save(hull.path.with_name("copy.hull")),
        lambda hull: hull.save(hull.path.with_name("copy.hull.json")),
    ],
)
def test_an_open_edit_is_ended_first(file: Path, act: Callable[[ah.Hull], object]) -> None:
    """What would meet a half-made edit is refused; the next writer finds the file free."""
    hull = ah.open(file)

    def meanwhile() -> None:
        with hull.edit("two") as edit:
            edit.move(POINT, y=hull.points[POINT].y + 0.01)
            act(hull)

    with pytest.raises(BadInputError, match="an edit is open"):
        meanwhile()
    assert names(hull) == ["one"]
    assert [each.name for each in file.parent.glob("copy*")] == []
    other = ah.open(file)
    shift(other, "three")
    hull.refresh()
    assert names(hull) == ["one", "three"]


_SECOND_LOOK = """
import os, signal, subprocess, sys
import assoc_hull as ah
path, point = sys.argv[1:]
hull = ah.open(path)
def shift(name):
    with hull.edit(name) as edit:
        edit.move(point, y=hull.points[point].y + 0.01)
shift("two")
ah.open(path).close()
ah.read(path).close()
look = "import sys, assoc_hull as ah; ah.open(sys.argv[1]).close()"
subprocess.run([sys.executable, "-c", look, path], check=True)
shift("three")
os.kill(os.getpid(), signal.SIGKILL)
"""


def test_a_second_look_at_an_open_file_loses_no_later_edit(file: Path) -> None:
    """Closing another handle on the file in one process leaves the log to its writer."""
    command = [sys.executable, "-c", _SECOND_LOOK, str(file), POINT]
    assert subprocess.run(command, check=False, timeout=60).returncode == -9
    assert names(ah.open(file)) == ["one", "two", "three"]


def test_a_hull_file_that_is_read_is_not_edited(file: Path) -> None:
    """Reading takes it into memory with its history; what is edited then is not in the file."""
    hull = ah.read(file)
    assert (names(hull), hull.path) == (["one"], None)
    shift(hull, "two")
    assert names(ah.open(file)) == ["one"]


def test_a_process_knows_what_it_has_open(file: Path) -> None:
    """From opening to closing, each handle on its own."""
    assert not is_open_here(file)
    one, two = ah.open(file), ah.open(file)
    one.close()
    assert is_open_here(file)
    two.close()
    assert not is_open_here(file)


def test_a_file_that_is_open_here_is_not_written_over(file: Path) -> None:
    """Its edits would go on in a file that has no name."""
    hull = ah.open(file)
    with pytest.raises(BadInputError, match="open in this process"):
        ah.examples.wigley(stations=7, waterlines=5).save(file, replace=True)
    shift(hull, "two")
    assert names(ah.open(file)) == ["one", "two"]


def test_nothing_is_written_to_a_log_that_goes_during_an_edit(file: Path) -> None:
    """An edit that nobody would ever see is refused, and all others are in the file."""
    hull = ah.open(file)
    before = hull.fingerprint

    def meanwhile() -> None:
        with hull.edit("two") as edit:
            edit.move(POINT, y=hull.points[POINT].y + 0.01)
            os.replace(log_file(file), log_file(file).with_name("away"))

    with pytest.raises(HullFileError, match=r"its log ship\.hull-wal was removed"):
        meanwhile()
    assert hull.fingerprint == before
    shift(hull, "three")
    assert names(ah.open(file)) == ["one", "three"]


def test_a_session_goes_on_with_another_log(file: Path) -> None:
    """All that was committed is in the file; whether somebody wrote is asked as ever."""
    hull = ah.open(file)
    os.replace(log_file(file), log_file(file).with_name("away"))
    shift(hull, "two")
    os.replace(log_file(file), log_file(file).with_name("away"))
    hull.undo()
    os.replace(log_file(file), log_file(file).with_name("away"))
    hull.refresh()
    assert names(hull) == names(ah.open(file)) == ["one"]


def test_a_log_that_is_gone_for_two_handles_is_told(file: Path) -> None:
    """Neither can take up another one while the other has the file open, too."""
    hull, other = ah.open(file), ah.open(file)
    os.replace(log_file(file), log_file(file).with_name("away"))
    before = hull.fingerprint
    acts: list[Callable[[], None]] = [lambda: shift(hull, "two"), hull.undo, hull.refresh]
    for act in acts:
        with pytest.raises(HullFileError, match=r"its log ship\.hull-wal was removed"):
            act()
    assert hull.fingerprint == before
    other.close()
    shift(hull, "two")
    assert names(ah.open(file)) == ["one", "two"]


def test_nobody_is_told_that_edits_are_in_a_file_that_has_gone(file: Path) -> None:
    """Saving has nothing to do only while the file is there; elsewhere all can be saved."""
    hull = ah.open(file)
    file.unlink()
    for path in (None, file):
        with pytest.raises(HullFileError, match="it was removed or replaced"):
            hull.save(path)
    hull.save(file.with_name("again.hull"))
    assert names(ah.open(file.with_name("again.hull"))) == ["one"]


def test_a_file_that_was_replaced_is_not_refreshed_from(file: Path) -> None:
    """The file of that name holds another hull by now."""
    hull = ah.open(file)
    os.replace(file, file.with_name("away.hull"))
    with pytest.raises(HullFileError, match="it was removed or replaced"):
        hull.refresh()


def test_threads_that_edit_one_hull_are_told_apart(file: Path) -> None:
    """One edits at a time; the others are refused, and none joins the edit of another."""
    hull, said = ah.open(file), list[str]()

    def work() -> None:
        for _ in range(10):
            try:
                shift(hull, "in a thread")
                hull.undo()
            except AssocHullError as error:
                said.append(str(error))

    threads = [threading.Thread(target=work) for _ in range(3)]
    for each in threads:
        each.start()
    for each in threads:
        each.join()
    assert not [each for each in said if "damaged" in each]
    assert hull.verify() == ()
    shift(hull, "last")
    again = ah.open(file)
    assert again.fingerprint == hull.fingerprint
    assert again.verify() == ()


def test_no_thread_joins_the_edit_of_another(file: Path) -> None:
    """What it would add belongs to another edit; the open one goes on."""
    hull, said = ah.open(file), list[str]()

    def meanwhile() -> None:
        try:
            shift(hull, "two")
        except HullBusyError as error:
            said.append(str(error))

    with hull.edit("one more") as edit:
        edit.move(POINT, y=hull.points[POINT].y + 0.01)
        thread = threading.Thread(target=meanwhile)
        thread.start()
        thread.join()
    assert len(said) == 1
    assert "another thread is at work" in said[0]
    assert names(ah.open(file)) == ["one", "one more"]


def test_who_reads_the_history_in_another_thread_is_in_no_writers_way(file: Path) -> None:
    """Every edit is made, and every report is there; a plain copy has them all at the end."""
    hull, over, seen = ah.open(file), threading.Event(), [["one"]]
    raised = list[BaseException]()

    def read() -> None:
        while not over.is_set():
            try:
                seen.append(names(hull))
            except BaseException as error:
                raised.append(error)

    reader = threading.Thread(target=read)
    reader.start()
    try:
        for number in range(20):
            shift(hull, str(number))
    finally:
        over.set()
        reader.join()
    made = ["one", *map(str, range(20))]
    assert not raised
    assert all(each == made[: len(each)] for each in seen)
    copy = Path(shutil.copy(file, file.with_name("copy.hull")))
    assert names(ah.open(copy)) == names(hull) == made


def test_a_refresh_that_fails_leaves_all_as_it_was(file: Path) -> None:
    """A step that cannot be read is told; no edit is made upon a state that is not the file's."""
    hull, other = ah.open(file), ah.open(file)
    before = hull.fingerprint
    shift(other, "two")
    shift(other, "three")
    database = sqlite3.connect(file)
    with database:
        database.execute("UPDATE steps SET digest = 'none' WHERE number = 3")
    database.close()
    for _ in range(2):
        with pytest.raises(DamagedFileError, match="step 3 cannot be read"):
            hull.refresh()
        assert hull.fingerprint == before
        assert names(hull) == ["one"]
        with pytest.raises(StaleHullError):
            shift(hull, "four")


def test_a_hull_repeats_its_own_edits_once() -> None:
    """The steps that are made meanwhile are not repeated as well."""
    hull = ah.examples.wigley(stations=7, waterlines=5)
    with hull.edit("pull") as edit:
        edit.pull(POINT, 0.001, (20.0, 6.0))
    assert len(hull.replay(hull)) == 1
    assert names(hull) == ["pull", "pull"]
