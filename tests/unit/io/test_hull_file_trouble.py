"""What is no hull file, or cannot be written: one line that says so, and nothing overwritten."""

import contextlib
import os
import resource
import shutil
import sqlite3
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

import assoc_hull as ah
from assoc_hull.cli import main
from assoc_hull.errors import DamagedFileError, HullFileError
from assoc_hull.io.hull_file.steps import step_digest

POINT = "WL 4.6875 x ST 3"


@pytest.fixture
def file(tmp_path: Path) -> Path:
    """A hull file with two edits, closed."""
    hull = ah.examples.wigley(stations=7, waterlines=5)
    path = tmp_path / "ship.hull"
    hull.save(path)
    shift(hull, "one")
    shift(hull, "two")
    hull.close()
    return path


def shift(hull: ah.Hull, name: str, by: float = 0.01) -> None:
    """Move a crossing."""
    with hull.edit(name) as edit:
        edit.move(POINT, y=hull.points[POINT].y + by)


def refused(path: Path, capfd: pytest.CaptureFixture[str], says: str) -> None:
    """Opening fails in one line, through Python and on the command line; the bytes stay."""
    before = path.read_bytes() if path.is_file() else None
    with pytest.raises(ah.errors.BadInputError) as caught:
        ah.open(path)
    assert "\n" not in str(caught.value)
    assert says in str(caught.value)
    for command in ("info", "history", "undo"):
        assert main([command, str(path)]) == 2
        told = capfd.readouterr().err
        assert told.startswith("error: ")
        assert told.count("\n") == 1
        assert "inside the program" not in told
    assert (path.read_bytes() if path.is_file() else None) == before


def test_a_folder(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    """Is none."""
    refused(tmp_path, capfd, "this is a folder")


def test_a_file_that_is_not_there(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    """Is not made."""
    refused(tmp_path / "none.hull", capfd, "cannot be read (No such file")
    assert list(tmp_path.iterdir()) == []


def test_an_empty_file(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    """Is no hull file."""
    (tmp_path / "ship.hull").touch()
    refused(tmp_path / "ship.hull", capfd, "it is empty")


def test_a_database_of_something_else(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    """Is told by its application id."""
    path = tmp_path / "ship.hull"
    database = sqlite3.connect(path)
    database.execute("CREATE TABLE hull (name TEXT)")
    database.commit()
    database.close()
    refused(path, capfd, "a database of something else")


@pytest.mark.parametrize("part", [0.0005, 0.3, 0.6, 0.99])
def test_a_file_that_is_cut_off(file: Path, part: float, capfd: pytest.CaptureFixture[str]) -> None:
    """Says how much is missing, or that it is none."""
    whole = file.read_bytes()
    file.write_bytes(whole[: int(part * len(whole))])
    refused(file, capfd, "begins otherwise" if part < 0.01 else "it is cut off")


def opened(path: Path) -> ah.Hull | None:
    """Open a file; None if that is refused in one line."""
    try:
        return ah.open(path)
    except ah.AssocHullError as error:
        if "\n" in str(error):
            raise
    return None


def test_flipped_bytes_are_noticed_or_do_no_harm(
    file: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    """Wherever a byte flips: a one-line error, or a hull that is the same to the bit."""
    whole, expected = file.read_bytes(), ah.open(file).fingerprint
    noticed = 0
    for place in range(0, len(whole), 397):
        file.write_bytes(whole[:place] + bytes([whole[place] ^ 0x55]) + whole[place + 1 :])
        hull = opened(file)
        if hull is None:
            noticed += 1
            continue
        assert hull.fingerprint == expected
        with contextlib.suppress(DamagedFileError):
            assert [each.name for each in hull.history]
            hull.undo(2)
            hull.redo(2)
            assert hull.fingerprint == expected
        hull.close()
    assert noticed > 25
    capfd.readouterr()


def test_damage_in_the_history_is_found_by_verify(file: Path) -> None:
    """Opening refuses it; who opens it all the same does not run the step, and verify names it."""
    database = sqlite3.connect(file)
    database.execute("UPDATE steps SET name = 'other' WHERE number = 2")
    database.commit()
    database.close()
    with pytest.raises(DamagedFileError, match="step 2 is not as it was written"):
        ah.open(file)
    hull = ah.open(file, damaged=True)
    before = hull.fingerprint
    with pytest.raises(DamagedFileError, match="step 2 cannot be read"):
        hull.undo()
    assert (hull.fingerprint, len(hull.undone)) == (before, 0)
    assert ["step 2" in each.key for each in hull.verify()] == [True]
    assert main(["verify", str(file)]) == 2


def test_a_value_that_was_changed_from_outside_is_noticed(file: Path) -> None:
    """The fingerprint of the file does not agree any more."""
    database = sqlite3.connect(file)
    database.execute("UPDATE points SET xyz = zeroblob(24) WHERE number = 3")
    database.commit()
    database.close()
    with pytest.raises(DamagedFileError, match="fingerprint"):
        ah.open(file)


def test_a_curve_that_is_said_to_be_unfinished_is_noticed(
    file: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    """Its points are there and its shape is not: found by files with changed cells."""
    database = sqlite3.connect(file)
    database.execute("UPDATE curves SET state = 1 WHERE number = 1")
    database.commit()
    database.close()
    refused(file, capfd, "has no shape")


def let_in(folder: Path) -> None:
    """Let everybody reach a folder of the tests."""
    for each in (folder, *folder.parents):
        if each.owner() == folder.owner() and each.parent != each:
            each.chmod(each.stat().st_mode | 0o055)


@contextlib.contextmanager
def as_nobody() -> Iterator[None]:
    """Permissions mean nothing to root: be somebody else."""
    if os.geteuid():
        yield
        return
    os.seteuid(65534)
    try:
        yield
    finally:
        os.seteuid(0)


def test_a_file_that_may_only_be_read_is_read(file: Path) -> None:
    """All of it; an edit is refused in one line, and the hull and the file are as they were."""
    let_in(file.parent)
    file.chmod(0o444)
    before = file.read_bytes()
    with as_nobody():
        hull = ah.open(file)
        assert [each.name for each in hull.history] == ["one", "two"]
        assert hull.verify() == ()
        with pytest.raises(HullFileError, match="may only be read"):
            shift(hull, "three")
        with pytest.raises(HullFileError, match="may only be read"):
            hull.undo()
        with pytest.raises(HullFileError, match="may only be read"):
            hull.checkpoint("here")
        assert len(hull.history) == 2
        hull.close()
    assert file.read_bytes() == before


def test_a_folder_that_may_only_be_read_is_no_place_to_save(file: Path) -> None:
    """One line, and nothing is left behind."""
    folder = file.parent / "closed"
    folder.mkdir()
    let_in(folder)
    folder.chmod(0o555)
    hull = ah.examples.wigley(stations=7, waterlines=5)
    with as_nobody(), pytest.raises(ah.AssocHullError, match="cannot be written"):
        hull.save(folder / "ship.hull")
    assert list(folder.iterdir()) == []
    assert hull.path is None


FULL = """
import resource, signal, sys
import assoc_hull as ah
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
hull = ah.open(sys.argv[1])
before, steps = hull.fingerprint, len(hull.history)
import os
size = os.path.getsize(sys.argv[1])
resource.setrlimit(resource.RLIMIT_FSIZE, (size + int(sys.argv[2]), resource.RLIM_INFINITY))
point, told = hull.points[sys.argv[3]], None
for number in range(500):
    before, steps = hull.fingerprint, len(hull.history)
    try:
        with hull.edit(f"edit {number}") as edit:
            edit.move(point, y=point.y + 0.001 * (-1) ** number)
    except OSError as error:
        told = str(error)
        break
assert told is not None and isinstance(told, str)
assert (hull.fingerprint, len(hull.history)) == (before, steps)
print(steps, before, told)
os._exit(0)
"""


@pytest.mark.parametrize("room", [0, 20_000, 100_000])
def test_a_full_disk_loses_the_edit_and_nothing_else(file: Path, room: int) -> None:
    """The limit on the size of files is what fills; what was committed before is all there."""
    # -B: a compiled module that is cut off at the limit would be kept, and fail the next Python.
    found = subprocess.run(
        [sys.executable, "-B", "-c", FULL, str(file), str(room), POINT],
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    steps, print_, told = found.stdout.strip().split(" ", 2)
    assert "the disk is full" in told or "input or output failed" in told
    hull = ah.open(file)
    assert (len(hull.history), hull.fingerprint) == (int(steps), print_)
    assert hull.check() == ()
    assert hull.verify() == ()
    shift(hull, "there is room again")


def fill(hull: ah.Hull) -> None:
    """Edit until it fails."""
    for number in range(500):
        shift(hull, f"edit {number}", 0.001 * (-1) ** number)


def test_a_real_full_disk(file: Path, tmp_path: Path) -> None:
    """On a small file system of its own, where one can be mounted: save, edits and save again."""
    disk = tmp_path / "disk"
    disk.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", "size=400k", "tmpfs", str(disk)]
    if shutil.which("mount") is None or subprocess.run(mount, capture_output=True).returncode:
        pytest.skip("no file system can be mounted here")
    try:
        shutil.copy(file, disk / "ship.hull")
        hull = ah.open(disk / "ship.hull")
        with pytest.raises(HullFileError, match="the disk is full"):
            fill(hull)
        steps, print_ = len(hull.history), hull.fingerprint
        with pytest.raises(HullFileError, match=r"full|No space"):
            ah.examples.series60(0.60).save(disk / "other.hull")
        assert not (disk / "other.hull").exists()
        hull.close()
        again = ah.open(disk / "ship.hull")
        assert (len(again.history), again.fingerprint) == (steps, print_)
        again.close()
    finally:
        subprocess.run(["umount", str(disk)], check=True)


def test_a_log_of_another_file_is_not_taken_for_its_own(file: Path) -> None:
    """A hull is not saved beside a log that may hold edits of a file that was moved away."""
    log = file.with_name("new.hull-wal")
    log.write_bytes(b"something")
    with pytest.raises(ah.errors.BadInputError, match="the log of another hull file"):
        ah.examples.wigley(stations=7, waterlines=5).save(file.with_name("new.hull"))
    assert not file.with_name("new.hull").exists()
    assert log.read_bytes() == b"something"


def test_the_limit_is_real() -> None:
    """The machine can limit the size of files, so that the tests above mean something."""
    assert hasattr(resource, "RLIMIT_FSIZE")


def test_an_undo_that_leads_elsewhere_is_taken_back(file: Path) -> None:
    """The state that a step recorded is not the one that its change gives: nothing is believed."""
    database = sqlite3.connect(file, isolation_level=None)
    row = list(database.execute("SELECT * FROM steps WHERE number = 1").fetchone())
    row[6] = "0" * 64
    row[7] = step_digest((*row[:7], *row[8:]))
    database.execute("DELETE FROM steps WHERE number = 1")
    database.execute(f"INSERT INTO steps VALUES ({', '.join('?' * len(row))})", row)
    database.close()
    hull = ah.open(file)
    before = hull.fingerprint
    with pytest.raises(DamagedFileError, match="the hull after step 1 is not as it was then"):
        hull.undo()
    assert (hull.fingerprint, len(hull.history), len(hull.undone)) == (before, 2, 0)
    hull.undo(2)
    hull.redo(2)
    assert hull.fingerprint == before
    assert hull.verify() == ()


def left_log(source: Path, target: Path) -> None:
    """Lay the log of a hull in use beside another file, as a careless copy does."""
    hull = ah.open(source)
    shift(hull, "three")
    shutil.copy(f"{source}-wal", f"{target}-wal")
    hull.close()


def test_the_log_of_another_hull_is_named_and_nothing_is_written(
    file: Path, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    """It is told from the log of this one, which is read as ever; moved away, the hull opens."""
    other = tmp_path / "other.hull"
    with contextlib.closing(ah.examples.wigley(stations=7, waterlines=5, breadth=11.0)) as hull:
        hull.save(other)
    left_log(other, file)
    log = file.with_name("ship.hull-wal")
    before = file.read_bytes(), log.read_bytes()
    with pytest.raises(DamagedFileError, match=r"ship\.hull-wal, is that of another hull"):
        ah.open(file)
    assert main(["info", str(file)]) == 2
    assert "is that of another hull" in capfd.readouterr().err
    assert (file.read_bytes(), log.read_bytes()) == before
    log.unlink()
    with contextlib.closing(ah.open(file)) as hull:
        assert len(hull.history) == 2


def test_a_log_of_its_own_is_read(file: Path, tmp_path: Path) -> None:
    """That which a process left when it was killed, here copied together with its file."""
    copy = tmp_path / "copy.hull"
    hull = ah.open(file)
    shift(hull, "three")
    shutil.copy(file, copy)
    shutil.copy(f"{file}-wal", f"{copy}-wal")
    hull.close()
    with contextlib.closing(ah.open(copy)) as hull:
        assert [each.name for each in hull.history] == ["one", "two", "three"]


def test_a_log_in_a_folder_that_may_only_be_read_is_named(file: Path, tmp_path: Path) -> None:
    """The last edits are in the log: the message says so, and no older state is shown."""
    folder = tmp_path / "closed"
    folder.mkdir()
    hull = ah.open(file)
    shift(hull, "three")
    shutil.copy(file, folder / "ship.hull")
    shutil.copy(f"{file}-wal", folder / "ship.hull-wal")
    hull.close()
    let_in(folder)
    for each in folder.iterdir():
        each.chmod(0o444)
    folder.chmod(0o555)
    with as_nobody(), pytest.raises(HullFileError) as caught:
        ah.open(folder / "ship.hull")
    assert "the log beside it, ship.hull-wal, in a read-only folder" in str(caught.value)
    assert "copy both files" in str(caught.value)
    folder.chmod(0o755)
