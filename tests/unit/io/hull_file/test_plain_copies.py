"""Copies of a hull file that programs make which know nothing of it, and locks that they cost."""

from __future__ import annotations

import random
import shutil
import signal
import sqlite3
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest

import assoc_hull as ah
from assoc_hull.errors import AssocHullError, DamagedFileError, HullFileError, StaleHullError
from assoc_hull.io.hull_file.storage import HullFile
from assoc_hull.io.open_databases import log_file
from tests.long_forms import LONG

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


def shift(hull: ah.Hull, name: str, by: float = 0.01) -> None:
    """Move a crossing."""
    with hull.edit(name) as edit:
        edit.move(POINT, y=hull.points[POINT].y + by)


def names(hull: ah.Hull) -> list[str]:
    """Names of the edits."""
    return [report.name for report in hull.history]


def keeper(hull: ah.Hull) -> HullFile:
    """Give what keeps the hull."""
    found = hull.document.keeper
    assert isinstance(found, HullFile)
    return found


def opened(path: Path) -> ah.Hull | None:
    """Open a copy; None if it is refused, with what to do."""
    try:
        return ah.open(path)
    except DamagedFileError as error:
        if "hull.save(other)" not in str(error):
            raise
    return None


COPIES = """
import shutil, sys, time
path, count = sys.argv[1], int(sys.argv[2])
for number in range(count):
    begin = time.time()
    shutil.copy(path, f"{path}.{number}")
    print(number, begin, time.time(), flush=True)
    time.sleep(0.02)
"""


def test_copies_that_are_made_during_a_session_are_whole_or_refused(file: Path) -> None:
    """None opens wrong, nor short of what was committed a second before it was begun."""
    hull, rng, count = ah.open(file), random.Random(1), 200 if LONG else 40
    known = [(time.time(), hull.fingerprint)]
    command = [sys.executable, "-c", COPIES, str(file), str(count)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as child:
        while child.poll() is None:
            act = rng.random()
            if act < 0.1 and hull.history:
                hull.undo()
            elif act < 0.2 and hull.document.undone:
                hull.redo()
            elif act < 0.3:
                with hull.edit("a line") as edit:
                    edit.add_line("waterlines", rng.uniform(1.0, 5.0), f"x {rng.random():.9f}")
                known.append((time.time(), hull.fingerprint))
                with hull.edit("no line") as edit:
                    edit.remove_line(next(name for name in hull.lines if name.startswith("x ")))
            else:
                shift(hull, "shift", rng.uniform(-0.01, 0.01))
            known.append((time.time(), hull.fingerprint))
        assert child.stdout is not None
        made = [line.split() for line in child.stdout]
    assert len(made) == count
    prints = [each for _, each in known]
    whole = 0
    for number, begin, _ in made:
        found = opened(file.with_name(f"ship.hull.{number}"))
        if found is None:
            continue
        before = [i for i, (when, _) in enumerate(known) if when < float(begin) - 1.0]
        assert found.fingerprint in prints[before[-1] if before else 0 :]
        assert found.verify() == ()
        found.close()
        whole += 1
    assert whole
    hull.close()


def test_a_copy_between_edits_is_whole(file: Path, tmp_path: Path) -> None:
    """Everything that was committed is in the file itself, the log is not needed."""
    hull = ah.open(file)
    acts: list[Callable[[], object]] = [
        lambda: shift(hull, "two"), hull.undo, lambda: hull.checkpoint("here"), hull.redo,
    ]  # fmt: skip
    for number, act in enumerate(acts):
        act()
        copy = tmp_path / f"copy {number}.hull"
        # From another process: this one would lose its locks.
        subprocess.run(["cp", str(file), str(copy)], check=True)
        again = ah.open(copy)
        assert (again.fingerprint, set(again.labels)) == (hull.fingerprint, set(hull.labels))
        again.close()


def test_a_reader_that_held_the_log_up_leaves_a_whole_file(file: Path, tmp_path: Path) -> None:
    """What could not be folded in because somebody read is, with the next act of anybody."""
    hull = ah.open(file)
    reader = sqlite3.connect(file, isolation_level=None)
    reader.execute("BEGIN")
    reader.execute("SELECT count(*) FROM points").fetchone()
    shift(hull, "two")
    reader.close()
    ah.open(file).close()
    shutil.copy(file, tmp_path / "copy.hull")
    assert names(ah.open(tmp_path / "copy.hull")) == ["one", "two"]


def test_a_fold_that_fails_takes_nothing_back(file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The commit counts; the next edit is refused if the disk does not take what is there."""
    hull = ah.open(file)

    def full(_: HullFile) -> bool:
        raise sqlite3.OperationalError("disk I/O error")

    with monkeypatch.context() as patch:
        patch.setattr(HullFile, "_folded", full)
        shift(hull, "two")
        known = hull.fingerprint
        with pytest.raises(AssocHullError):
            shift(hull, "three")
    assert (names(hull), hull.fingerprint) == (["one", "two"], known)
    shift(hull, "four")
    assert names(ah.open(file)) == ["one", "two", "four"]


def test_an_interrupted_fold_takes_nothing_back(
    file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It comes behind the commit: memory and file agree."""
    hull = ah.open(file)

    def interrupted(_: HullFile) -> bool:
        raise KeyboardInterrupt

    with monkeypatch.context() as patch:
        patch.setattr(HullFile, "_folded", interrupted)
        with pytest.raises(KeyboardInterrupt):
            shift(hull, "two")
    assert names(hull) == ["one", "two"]
    assert ah.open(file).fingerprint == hull.fingerprint


@pytest.mark.parametrize("step", ["_refuse_stale", "_hold"])
def test_an_interrupted_begin_leaves_nothing_open(
    file: Path, monkeypatch: pytest.MonkeyPatch, step: str
) -> None:
    """Others can write at once, and so can the same hull."""
    hull, other = ah.open(file), ah.open(file)

    def interrupted(_: HullFile) -> None:
        raise KeyboardInterrupt

    with monkeypatch.context() as patch:
        patch.setattr(HullFile, step, interrupted)
        with pytest.raises(KeyboardInterrupt):
            shift(hull, "cut short")
    assert not keeper(hull).database.in_transaction
    shift(other, "two")
    hull.refresh()
    shift(hull, "three")
    assert names(ah.open(file)) == ["one", "two", "three"]


ELSEWHERE = """
import sys, assoc_hull as ah
hull = ah.open(sys.argv[1])
if len(sys.argv) > 2:
    with hull.edit(sys.argv[2]) as edit:
        edit.move(sys.argv[3], y=hull.points[sys.argv[3]].y + 0.01)
hull.close()
"""


def elsewhere(file: Path, *edit: str) -> None:
    """Open the file in another process, edit it or not, and close it."""
    command = [sys.executable, "-c", ELSEWHERE, str(file), *edit]
    subprocess.run(command, check=True, timeout=300)


def copy_here(file: Path) -> None:
    """Copy all files of a hull in this process, which gives up its locks on them."""
    for path in (file, log_file(file), file.with_name(f"{file.name}-shm")):
        shutil.copy(path, path.with_name(f"copy of {path.name}"))


def test_a_session_goes_on_after_a_copy_in_its_own_process(file: Path) -> None:
    """Also if another process, to which the file seems free, clears the log away meanwhile."""
    hull = ah.open(file)
    copy_here(file)
    shift(hull, "two")
    copy_here(file)
    elsewhere(file)
    shift(hull, "three")
    copy_here(file)
    elsewhere(file, "other", POINT)
    with pytest.raises(StaleHullError):
        shift(hull, "late")
    hull.refresh()
    shift(hull, "four")
    assert names(hull) == names(ah.open(file)) == ["one", "two", "three", "other", "four"]
    assert hull.verify() == ()


def test_two_that_write_at_once_do_not_spoil_the_file(file: Path) -> None:
    """A copy during an edit lets another process write, too: the edit is refused."""
    hull = ah.open(file)

    def meanwhile() -> None:
        with hull.edit("two") as edit:
            edit.move(POINT, y=hull.points[POINT].y + 0.02)
            copy_here(file)
            elsewhere(file, "other", POINT)

    with pytest.raises(HullFileError):
        meanwhile()
    # Memory follows what is kept (`Document.settle`): the other edit, and nothing of this one.
    hull.refresh()
    assert names(hull) == ["one", "other"]
    assert hull.fingerprint == ah.open(file).fingerprint
    shift(hull, "three")
    again = ah.open(file)
    assert names(again) == ["one", "other", "three"]
    assert again.verify() == ()


KILLED = """
import os, signal, sys, assoc_hull as ah
hull = ah.open(sys.argv[1])
with hull.edit("two") as edit:
    edit.move(sys.argv[2], y=hull.points[sys.argv[2]].y + 0.01)
os.kill(os.getpid(), signal.SIGKILL)
"""


def test_a_file_is_written_over_after_a_kill(file: Path) -> None:
    """Its log lies beside it; it is carried in before the file is replaced."""
    command = [sys.executable, "-c", KILLED, str(file), POINT]
    assert subprocess.run(command, check=False).returncode == -signal.SIGKILL
    assert log_file(file).exists()
    other = ah.examples.wigley(stations=7, waterlines=5)
    shift(other, "another")
    assert other.save(file, replace=True).written
    shift(other, "more")
    assert names(ah.open(file)) == ["another", "more"]
