"""The rows of the tables follow the steps, many at once: nobody who opens the file sees that."""

from __future__ import annotations

import shutil
import sqlite3
from pathlib import Path

import pytest

import assoc_hull as ah
from assoc_hull.errors import DamagedFileError
from assoc_hull.io.hull_file.steps import step_digest
from assoc_hull.model.definition.fingerprint import is_root
from benchmarks.copies import copies_of
from tests.properties.test_changes import picture

POINT = "WL 4.6875 x ST 3"
OLD = Path(__file__).parents[1] / "old_files"


@pytest.fixture
def file(tmp_path: Path) -> Path:
    """Where a hull file goes."""
    return tmp_path / "ship.hull"


@pytest.fixture
def hull(file: Path) -> ah.Hull:
    """A small hull in a file."""
    made = ah.examples.wigley(stations=7, waterlines=5)
    made.save(file)
    return made


def shift(hull: ah.Hull, name: str, by: float = 0.001) -> None:
    """Move a crossing."""
    with hull.edit(name) as edit:
        edit.move(POINT, y=hull.points[POINT].y + by)


def killed(file: Path) -> Path:
    """A copy as a process that was killed leaves it."""
    found = file.with_name("killed.hull")
    shutil.copy(file, found)
    return found


def cell(file: Path, query: str) -> object:
    """One value of a database."""
    database = sqlite3.connect(file)
    (found,) = database.execute(query).fetchone()
    database.close()
    return found


def stand(hull: ah.Hull) -> tuple[object, ...]:
    """All that a file must give back."""
    state = hull.state
    revisions = dict(state.revision_row), dict(state.revision_curve)
    return (hull.fingerprint, picture(state), revisions, [each.name for each in hull.history],
            [each.name for each in hull.undone], {**hull.labels})  # fmt: skip


def structure(hull: ah.Hull, number: int) -> None:
    """Lines, points, names and groups come and go."""
    if number % 3 == 0:
        with hull.edit(f"line {number}") as edit:
            edit.add_line("waterlines", 1.0 + 0.05 * number)
    elif number % 3 == 1:
        with hull.edit(f"name {number}") as edit:
            edit.rename("WL 3.125", f"WL 3.125 ({number})")
            edit.rename(f"WL 3.125 ({number})", "WL 3.125")
            edit.set_end("WL 3.125", "start", tangent=(1.0, 0.2 + 0.001 * number, 0.0))
            edit.rename("WL 3.125 x ST 4", f"there {number}")
    else:
        shift(hull, f"move {number}")


def test_what_was_committed_is_there_though_the_tables_lag(hull: ah.Hull, file: Path) -> None:
    """Every bit and revision, after each of a dozen edits of all kinds; undo goes on there."""
    for number in range(12):
        structure(hull, number)
        copy = killed(file)
        assert cell(copy, "SELECT base FROM hull") == 0
        again = ah.open(copy)
        assert stand(again) == stand(hull)
        again.close()
    again = ah.open(killed(file))
    for act in (again, hull):
        act.undo(5)
        act.redo(2)
        shift(act, "another way")
        act.go("branch 1")
    mine, theirs = stand(hull), stand(again)
    assert mine[:5] == theirs[:5]
    assert again.verify() == ()
    # What was undone is in the rows, for nothing else tells its revisions.
    assert cell(file, "SELECT base = head FROM hull") == 1


def test_closing_brings_the_tables_up_to_date(hull: ah.Hull, file: Path) -> None:
    """Who reads the rows without this package finds the hull as it is, once it is closed."""
    shift(hull, "one")
    place, known = hull.points[POINT].y, stand(hull)
    hull.close()
    assert cell(file, "SELECT base FROM hull") == 1
    before = file.read_bytes()
    again = ah.open(file)
    assert again.points[POINT].y == place
    assert stand(again) == known
    again.close()
    assert file.read_bytes() == before  # who only reads writes nothing


def test_the_tables_lag_by_so_many_steps_at_most(hull: ah.Hull, file: Path) -> None:
    """And then by none, in the very commit that would be one too many."""
    found = set[int]()
    for number in range(70):
        shift(hull, f"edit {number}")
        base = cell(file, "SELECT base FROM hull")
        assert isinstance(base, int)
        found.add(base)
    assert found == {0, 33, 66}
    again = ah.open(killed(file))
    assert stand(again) == stand(hull)
    assert again.verify() == ()


def test_a_copy_that_is_saved_does_not_lag(hull: ah.Hull, file: Path) -> None:
    """The file that it was made of goes on lagging, or is brought up to date when it is closed."""
    structure(hull, 0)
    shift(hull, "two")
    known = stand(hull)
    hull.save(file.with_name("copy.hull"))
    assert cell(file.with_name("copy.hull"), "SELECT base FROM hull") == 2
    shift(hull, "three")
    assert [each.name for each in ah.open(file).history] == ["line 0", "two"]
    assert stand(ah.open(file)) == known
    assert stand(ah.open(file.with_name("copy.hull"))) == stand(hull)


def test_two_that_lag_behind_each_other(hull: ah.Hull, file: Path) -> None:
    """In turns, one closing while the other goes on: both, and who comes later, see the same."""
    second = ah.open(file)
    for number in range(6):
        hull.refresh()
        structure(hull, number)
        second.refresh()
        shift(second, f"second {number}")
        if number == 3:
            second.undo()
            second.redo()
    hull.close()  # it was overtaken, and leaves the rows to the other one
    third = ah.open(file)
    assert stand(third) == stand(second)
    shift(third, "third")
    third.close()
    second.refresh()
    shift(second, "last")
    assert stand(ah.open(killed(file))) == stand(second)
    second.close()
    assert cell(file, "SELECT base = head FROM hull") == 1
    assert ah.open(file).verify() == ()


def spoil(file: Path, number: int, *, sign: bool) -> None:
    """Write over the middle of what a step changed."""
    database = sqlite3.connect(file, isolation_level=None)
    query = f"SELECT change FROM steps WHERE number = {number}"
    change = bytearray(database.execute(query).fetchone()[0])
    change[90] ^= 0xFF
    update = f"UPDATE steps SET change = ? WHERE number = {number}"
    database.execute(update, (bytes(change),))
    row = database.execute(f"SELECT * FROM steps WHERE number = {number}").fetchone()
    if sign:
        digest = step_digest((*row[:7], *row[8:]))
        database.execute("UPDATE steps SET digest = ? WHERE number = ?", (digest, number))
    database.close()


@pytest.mark.parametrize("sign", [False, True], ids=["as it is", "signed anew"])
def test_a_damaged_step_that_the_tables_lack_refuses_opening(
    hull: ah.Hull, file: Path, sign: bool
) -> None:
    """If it is to be opened all the same, the hull stands before that step."""
    prints = [hull.fingerprint]
    for number in range(3):
        shift(hull, f"edit {number}")
        prints.append(hull.fingerprint)
    copy = killed(file)
    spoil(copy, 2, sign=sign)
    with pytest.raises(DamagedFileError):
        ah.open(copy)
    again = ah.open(copy, damaged=True)
    assert (again.fingerprint, [each.name for each in again.history]) == (prints[1], ["edit 0"])
    again.save(file.with_name("saved.hull.json"))
    assert ah.open(file.with_name("saved.hull.json")).fingerprint == prints[1]


def test_a_long_history_is_not_run_because_a_file_says_so(
    hull: ah.Hull, file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A stranger's file whose tables claim to lag behind by more than they ever do is refused."""
    monkeypatch.setattr("assoc_hull.io.hull_file.storage._TOO_MANY_BEHIND", 3)
    for number in range(4):
        shift(hull, f"edit {number}")
    with pytest.raises(DamagedFileError, match="lag behind by 4 steps"):
        ah.open(killed(file))
    assert stand(ah.open(killed(file), damaged=True)) == stand(hull)
    hull.close()
    assert len(ah.open(file).history) == 4


def test_a_file_of_version_6_goes_on(file: Path) -> None:
    """Its old fingerprints are still what undo is checked by; new steps have a root instead."""
    shutil.copy(OLD / "version_6.hull", file)
    hull = ah.open(file)
    known = stand(hull)
    with hull.edit("in version 7") as edit:
        edit.rename("WL 6.25", "deck")
    new = stand(hull)
    assert stand(ah.open(killed(file)))[:3] == new[:3]
    hull.undo()
    assert stand(ah.open(file))[:2] == known[:2]
    hull.undo(len(hull.history))
    hull.go("branch 3" if "branch 3" in hull.labels else "branch 2")
    hull.close()
    database = sqlite3.connect(file, isolation_level=None)
    rows = database.execute("SELECT number, fingerprint FROM steps ORDER BY number").fetchall()
    assert [is_root(text) for _, text in rows] == [False] * (len(rows) - 1) + [True]
    spoiled = "UPDATE hull SET fingerprint = ?, head = 1, tip = 1, base = 1"
    database.execute(spoiled, ("0" * 64,))
    database.close()
    with pytest.raises(DamagedFileError, match="the content has the fingerprint"):
        ah.open(file)


def test_inflections_are_counted_when_the_report_is_read(hull: ah.Hull, file: Path) -> None:
    """As many as at once, for steps before and behind the rows, undone ones, and of a gone hull."""
    with hull.edit("bumps") as edit:
        edit.move(POINT, y=hull.points[POINT].y + 0.6)
    structure(hull, 0)
    with hull.edit("and back", gaps="report") as edit:
        edit.move(POINT, y=hull.points[POINT].y - 1.2)
    shift(hull, "small")
    known = [report.inflections for report in hull.history]
    assert known[0] != ()
    copy = killed(file)
    database = sqlite3.connect(copy)
    texts = [text for (text,) in database.execute("SELECT report FROM steps")]
    assert all("inflections" not in text for text in texts)
    database.close()
    again = ah.open(copy)
    assert [report.inflections for report in again.history] == known
    again.undo(3)
    reports = [*again.history, *again.undone[::-1]]
    again.close()
    del again
    assert [report.inflections for report in reports] == known
    late = ah.open(copy).history[0]
    shutil.copy(OLD / "version_6.hull", copy)
    with pytest.raises(ah.AssocHullError):
        _ = late.inflections


def written_by(hull: ah.Hull, folder: Path) -> int:
    """Bytes that a commit writes to the log, which begins anew with the file."""
    path = folder / f"{len(hull.lines)}.hull"
    point = next(
        name for name, each in hull.points.items()
        if each.y > 1.0 and "waterlines #0/" in name and "sections #0/" in name
    )  # fmt: skip
    hull.save(path)
    log = path.with_name(f"{path.name}-wal")
    before = log.stat().st_size if log.exists() else 0
    with hull.edit("move", gaps="report") as edit:
        edit.move(point, y=hull.points[point].y + 0.001)
    after = log.stat().st_size
    hull.close()
    return after - before


def test_a_commit_writes_as_much_in_a_model_eight_times_as_large(tmp_path: Path) -> None:
    """The same gesture on one of many copies of a net: the log is no longer."""
    net = ah.examples.wigley(stations=7, waterlines=5)
    one, many = (ah.Hull(copies_of(net.state, count)) for count in (2, 16))
    assert many.state.rows.count == 8 * one.state.rows.count
    small, large = (written_by(hull, tmp_path) for hull in (one, many))
    assert 0 < large <= small
