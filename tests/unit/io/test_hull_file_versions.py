"""Hull files of other versions: older ones are brought up to date, newer ones refused."""

import shutil
import sqlite3
from pathlib import Path

import pytest

import assoc_hull as ah
from assoc_hull.io.hull_file.database import MIGRATIONS, SCHEMA, migrate_tables

OLD = Path(__file__).parent / "old_files"
PRINT = "0e275868597c38061acf0b780531a5e89c848937aa4fbe74c37ae6cea4b779c1"


def columns(path: Path) -> dict[str, list[tuple[object, ...]]]:
    """Give the tables and columns of a database."""
    database = sqlite3.connect(path)
    names = [name for (name,) in database.execute("SELECT name FROM sqlite_schema ORDER BY name")]
    found = {
        name: database.execute(f"PRAGMA table_info({name})").fetchall()
        for name in names
        if not name.startswith("sqlite_")
    }
    found["version"] = database.execute("PRAGMA user_version").fetchall()
    database.close()
    return found


def test_there_is_a_file_of_every_older_version() -> None:
    """And a way from each to the next."""
    names = {each.name for each in OLD.glob("*.hull")}
    assert names == {f"version_{number}.hull" for number in range(1, SCHEMA)}
    assert sorted(MIGRATIONS) == list(range(1, SCHEMA))


@pytest.mark.parametrize("version", range(1, SCHEMA))
def test_a_file_of_an_older_version_is_brought_up_to_date(tmp_path: Path, version: int) -> None:
    """All of it is there: state, history, undone steps, branch, checkpoint; and it goes on."""
    path = tmp_path / "old.hull"
    shutil.copy(OLD / f"version_{version}.hull", path)
    hull = ah.open(path)
    assert hull.fingerprint == PRINT
    assert [(each.name, each.author) for each in hull.history] == [
        ("fuller", "naval architect"),
        ("another way", "naval architect"),
    ]
    assert [each.name for each in hull.undone] == ["one more line"]
    assert {label.name: (label.step, label.author) for label in hull.labels.values()} == {
        "after the first": (1, ""),
        "branch 1": (2, ""),
    }
    hull.checkpoint("brought up to date")
    hull.go("branch 1")
    hull.go("branch 2")
    assert hull.verify() == ()
    hull.close()
    new = tmp_path / "new.hull"
    ah.examples.wigley(stations=5, waterlines=4).save(new)
    assert columns(path) == columns(new)
    again = ah.open(path)
    assert "brought up to date" in again.labels


def test_two_processes_bring_a_file_up_to_date_once(tmp_path: Path) -> None:
    """The one that comes second finds it done, though it saw an old file before."""
    path = tmp_path / "old.hull"
    shutil.copy(OLD / "version_1.hull", path)
    one, two = (sqlite3.connect(path, isolation_level=None) for _ in range(2))
    for database in (one, two):
        migrate_tables(database, path)
        assert database.execute("PRAGMA user_version").fetchone() == (SCHEMA,)
        database.close()
    assert ah.open(path).verify() == ()


def test_a_newer_file_is_refused_and_left_alone(tmp_path: Path) -> None:
    """One line that says which version it has."""
    path = tmp_path / "newer.hull"
    ah.examples.wigley(stations=5, waterlines=4).save(path)
    database = sqlite3.connect(path)
    database.execute(f"PRAGMA user_version = {SCHEMA + 1}")
    database.close()
    before = path.read_bytes()
    with pytest.raises(
        ah.errors.BadInputError, match=f"version {SCHEMA + 1} .* reads 1 to {SCHEMA}"
    ):
        ah.open(path)
    assert path.read_bytes() == before
