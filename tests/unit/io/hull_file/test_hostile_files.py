"""Hull files that somebody made to do harm: each is refused in one line, at once."""

from __future__ import annotations

import json
import sqlite3
import time
import zlib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import assoc_hull as ah
from assoc_hull.cli import main
from assoc_hull.edit.document import Document
from assoc_hull.errors import AssocHullError, DamagedFileError
from assoc_hull.io.hull_file.database import SCHEMA, known_schema
from assoc_hull.io.hull_file.packed_arrays import pack_arrays, unpack_arrays
from assoc_hull.io.hull_file.steps import step_digest
from assoc_hull.io.hull_file.tables import read_state
from assoc_hull.model.definition.fingerprint import root_of

POINT = "WL 4.6875 x ST 3"
OLD = Path(__file__).parents[1] / "old_files"
Harm = Callable[[sqlite3.Connection], object]


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    """A hull file with three edits, one of them undone."""
    path = tmp_path_factory.mktemp("hostile") / "ship.hull"
    hull = ah.examples.wigley(stations=7, waterlines=5)
    hull.save(path)
    for number in range(3):
        with hull.edit(f"edit {number}") as edit:
            edit.move(POINT, y=hull.points[POINT].y + 0.01 * (1 + number))
    hull.undo()
    hull.close()
    return path.read_bytes()


@pytest.fixture
def file(whole: bytes, tmp_path: Path) -> Path:
    """A copy of it."""
    path = tmp_path / "ship.hull"
    path.write_bytes(whole)
    return path


def alter(path: Path, harm: Harm) -> None:
    """Change a file as somebody would who knows SQLite."""
    database = sqlite3.connect(path, isolation_level=None)
    harm(database)
    database.close()


def run(*texts: str) -> Harm:
    """Run some statements."""
    return lambda database: [database.execute(text) for text in texts]


def schema_text(name: str, old: str, new: str) -> Harm:
    """Write another text of a table into the schema."""

    def harm(database: sqlite3.Connection) -> None:
        database.execute("PRAGMA writable_schema = ON")
        database.execute(
            "UPDATE sqlite_master SET sql = replace(sql, ?, ?) WHERE name = ?", (old, new, name)
        )

    return harm


def cell(
    table: str, column: str, value: object, where: str = "TRUE", *, sign: bool = False
) -> Harm:
    """Put a value into a cell, and sign the file anew."""

    def harm(database: sqlite3.Connection) -> None:
        database.execute(f"UPDATE {table} SET {column} = ? WHERE {where}", (value,))
        if sign:
            signed(database)

    return harm


def signed(database: sqlite3.Connection) -> None:
    """Make all digests and the fingerprint agree with what is there."""
    for row in database.execute("SELECT * FROM steps").fetchall():
        made = step_digest((*row[:7], *row[8:]))
        database.execute("UPDATE steps SET digest = ? WHERE number = ?", (made, row[0]))
    found = root_of(read_state(database))
    database.execute("UPDATE hull SET fingerprint = ?", (found,))


def bomb(size: int) -> bytes:
    """Zeros that unpack to so many bytes."""
    head = json.dumps({"facts": None, "arrays": [["knot", "<f8", [size // 8]]]})
    return zlib.compress(head.encode() + b"\n" + bytes(size), 9)


def doubled(database: sqlite3.Connection) -> None:
    """Append the last step once more, well signed."""
    row = database.execute("SELECT * FROM steps WHERE number = 3").fetchone()
    made = (4, *row[1:])
    made = (*made[:7], step_digest((*made[:7], *made[8:])), *made[8:])
    database.execute(f"INSERT INTO steps VALUES ({', '.join('?' * len(made))})", made)


BRACKETS = "[" * 200_000
SHORT_LISTS = "[" + "[]," * 5_000_000 + "[]]"

HARMS: dict[str, Harm] = {
    "trigger": run(
        "CREATE TRIGGER t AFTER UPDATE ON hull BEGIN DELETE FROM steps; END"
    ),
    "view in the place of a table": run(
        "ALTER TABLE points RENAME TO really",
        "CREATE VIEW points AS WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n) "
        "SELECT i FROM n",
    ),
    "further view": run("CREATE VIEW more AS SELECT * FROM hull"),
    "virtual table": run("CREATE VIRTUAL TABLE v USING fts5(a)"),
    "further table": run("CREATE TABLE more (a)"),
    "further index": run("CREATE INDEX i ON points (key)"),
    "index over an expression": run("CREATE INDEX i ON points (abs(number))"),
    "statistics": run("ANALYZE"),
    "table that is missing": run("DROP TABLE features"),
    "generated column": run("ALTER TABLE lines ADD COLUMN more AS (hex(zeroblob(60000000)))"),
    "default that is computed": schema_text("hull", "'open'", "(hex(randomblob(99999999)))"),
    "check": schema_text("points", "key TEXT NOT NULL", "key TEXT NOT NULL CHECK (key <> '')"),
    "collation": schema_text("labels", "PRIMARY KEY", "PRIMARY KEY COLLATE NOCASE"),
    "comment": schema_text("groups", "number", "/* harmless? */ number"),
    "schema that is none": schema_text("groups", "CREATE TABLE groups (", "CREATE TABLE groups (("),
    "name of an index": lambda database: [
        database.execute("PRAGMA writable_schema = ON"),
        database.execute("UPDATE sqlite_master SET name = 'x' WHERE type = 'index'"),
    ],
    "two tables at one place": lambda database: [
        database.execute("PRAGMA writable_schema = ON"),
        database.execute(
            "UPDATE sqlite_master SET rootpage = "
            "(SELECT rootpage FROM sqlite_master WHERE name = 'births') WHERE name = 'gone'"
        ),
    ],
    "brackets in ends": cell("curves", "ends", BRACKETS, "number = 1"),
    "brackets in a note": cell("lines", "note", BRACKETS, "number = 1"),
    "brackets in curves": cell("lines", "curves", BRACKETS),
    "brackets in tolerances": cell("hull", "tolerances", BRACKETS),
    "brackets in failures": cell("hull", "failed", BRACKETS),
    "brackets in a script": cell("steps", "script", BRACKETS, "number = 2"),
    "brackets in a report": cell("steps", "report", BRACKETS, "number = 2"),
    "huge JSON": cell("hull", "failed", SHORT_LISTS),
    "endless text": cell("lines", "note", "x" * 80_000_000, "number = 0"),
    "pieces that unpack to gigabytes": cell("curves", "kept", bomb(1 << 28)),
    "piece that names gigabytes": cell(
        "curves", "kept",
        zlib.compress(b'{"facts": 0, "arrays": [["knot", "<f8", [9999999999]]]}\n'),
    ),
    "curves that kept a spline each": cell("curves", "kept", bomb(1 << 24)),
    "step that was deleted": run("DELETE FROM steps WHERE number = 2"),
    "last step that was deleted": run("DELETE FROM steps WHERE number = 3"),
    "deleted step, and a stand that fits": run(
        "DELETE FROM steps WHERE number > 1", "UPDATE hull SET head = 1, tip = 1"
    ),
    "step that leads to itself": cell("steps", "parent", 2, "number = 2"),
    "tables after a step that was undone": run("UPDATE hull SET base = 3"),
    "tables after a step that is not there": run("UPDATE hull SET base = 99"),
    "tables before all steps": run("UPDATE hull SET base = -1"),
    "tables after a word": run("UPDATE hull SET base = 'x'"),
    "tables that say that they lag": run("UPDATE hull SET base = 1"),
    "head elsewhere": run("UPDATE hull SET head = 1"),
    "name that is no text": run("INSERT INTO labels VALUES (x'00ff', 1, 0, '', '')"),
    "row that is missing": run("DELETE FROM points WHERE number = 4"),
    "no row of the hull": run("DELETE FROM hull"),
    "step of the wrong digest": cell("steps", "digest", "0" * 64, "number = 3"),
}  # fmt: skip


@pytest.mark.parametrize("harm", HARMS.values(), ids=HARMS)
def test_a_hostile_file_is_refused_at_once(file: Path, harm: Harm) -> None:
    """In one line, in less than a second of the processor, and the file is left alone."""
    alter(file, harm)
    before = file.read_bytes()
    start = time.process_time()
    with pytest.raises(DamagedFileError) as caught:
        ah.open(file)
    assert time.process_time() - start < 1.0
    assert "\n" not in str(caught.value)
    assert len(str(caught.value)) < 1000
    assert file.read_bytes() == before


@pytest.mark.parametrize("name", ["trigger", "check", "brackets in ends", "step that was deleted"])
def test_the_command_line_says_so_in_one_line(
    file: Path, name: str, capfd: pytest.CaptureFixture[str]
) -> None:
    """Exit code 2, and no traceback."""
    alter(file, HARMS[name])
    assert main(["info", str(file)]) == 2
    told = capfd.readouterr().err
    assert told.startswith("error: it is damaged")
    assert told.count("\n") == 1


def test_pages_that_lead_to_one_another_are_not_followed_for_ever(file: Path) -> None:
    """Interior pages whose children are all one page multiply what there is."""
    database = sqlite3.connect(file, isolation_level=None)
    query = "SELECT rootpage FROM sqlite_master WHERE name = 'points'"
    root = database.execute(query).fetchone()[0]
    size = database.execute("PRAGMA page_size").fetchone()[0]
    database.close()
    data = bytearray(file.read_bytes())
    first, page = (root - 1) * size, data[(root - 1) * size : root * size]
    assert page[0] == 5  # the points take more than one page
    child = int.from_bytes(page[8:12], "big")
    count, pages = 300, len(data) // size
    made = bytearray(size)

    def interior(leads: int) -> bytes:
        made[:] = bytes(size)
        made[0], made[3:5], made[8:12] = 5, count.to_bytes(2, "big"), leads.to_bytes(4, "big")
        start = size
        for number in range(count):
            start -= 6
            made[12 + 2 * number : 14 + 2 * number] = start.to_bytes(2, "big")
            made[start : start + 5] = leads.to_bytes(4, "big") + bytes([1 + number % 100])
        made[5:7] = start.to_bytes(2, "big")
        return bytes(made)

    data[first : first + size] = interior(pages + 1)
    for level in range(4):
        data += interior(pages + 2 + level if level < 3 else child)
    data[28:32] = (len(data) // size).to_bytes(4, "big")
    file.write_bytes(data)
    start = time.process_time()
    with pytest.raises(DamagedFileError):
        ah.open(file)
    with pytest.raises(DamagedFileError):
        ah.open(file, damaged=True)
    assert time.process_time() - start < 2.0


def test_a_query_ends_that_takes_longer_than_the_size_allows(file: Path) -> None:
    """Whatever it is: the database is told to give it up."""
    hull = ah.open(file)
    keeper = hull.document.keeper
    query = "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n) SELECT max(i) FROM n"
    start = time.process_time()
    with pytest.raises(sqlite3.OperationalError, match="interrupted"):
        keeper.database.execute(query).fetchone()  # type: ignore[union-attr]
    assert time.process_time() - start < 1.0
    with hull.edit("goes on") as edit:
        edit.move(POINT, y=hull.points[POINT].y + 0.02)


def test_no_connection_takes_in_another_database(file: Path) -> None:
    """Nor does it trust what stands in the schema."""
    hull = ah.open(file)
    database = hull.document.keeper.database  # type: ignore[union-attr]
    with pytest.raises(sqlite3.OperationalError, match="too many attached"):
        database.execute("ATTACH ':memory:' AS other")
    for name, value in (("trusted_schema", 0), ("cell_size_check", 1), ("synchronous", 2)):
        assert database.execute(f"PRAGMA {name}").fetchone() == (value,)


def test_a_report_that_is_not_looked_at_on_opening_is_refused_when_it_is_told(file: Path) -> None:
    """Opened in spite of damage, the report says so by itself."""
    alter(file, HARMS["brackets in a report"])
    hull = ah.open(file, damaged=True)
    with pytest.raises(DamagedFileError, match="step 2 cannot be read"):
        assert hull.history


def test_a_change_that_asks_for_all_memory_is_refused(file: Path) -> None:
    """The sizes of tables that a step names are those that its rows fill."""
    database = sqlite3.connect(file, isolation_level=None)
    data = database.execute("SELECT change FROM steps WHERE number = 2").fetchone()[0]
    arrays, facts = unpack_arrays(data)
    made = pack_arrays(arrays, {**facts, "sizes": {"rows": [10, 4_000_000_000]}})
    database.execute("UPDATE steps SET change = ? WHERE number = 2", (made,))
    row = database.execute("SELECT * FROM steps WHERE number = 2").fetchone()
    digest = step_digest((*row[:7], *row[8:]))
    database.execute("UPDATE steps SET digest = ? WHERE number = 2", (digest,))
    database.close()
    hull = ah.open(file)
    before = hull.fingerprint
    with pytest.raises(DamagedFileError, match="step 2 cannot be read"):
        hull.undo()
    assert hull.fingerprint == before


Arrays = dict[str, NDArray[Any]]


def altered(**parts: Callable[[NDArray[Any]], NDArray[Any]]) -> Callable[[Arrays, Any], bytes]:
    """Alter arrays of a change; `__` stands for the dot in their names."""

    def alter(arrays: Arrays, facts: Any) -> bytes:
        named = {name.replace("__", "."): act for name, act in parts.items()}
        assert named.keys() <= arrays.keys()
        changed = {name: act(arrays[name].copy()) for name, act in named.items()}
        return pack_arrays({**arrays, **changed}, facts, 0)

    return alter


def told(**facts: Any) -> Callable[[Arrays, Any], bytes]:
    """Alter what a change says of itself."""
    return lambda arrays, known: pack_arrays(arrays, {**known, **facts}, 0)


def put(place: int, value: object) -> Callable[[NDArray[Any]], NDArray[Any]]:
    """Put a value into an array."""

    def act(array: NDArray[Any]) -> NDArray[Any]:
        array.flat[place] = value
        return array

    return act


def headed(head: bytes, more: bytes = b"") -> Callable[[Arrays, Any], bytes]:
    """Give a piece of this head, whatever was there."""
    return lambda _, __: b"AH" + head + b"\n" + more


NAN = 0x7FF8000000000000

BLOBS: dict[str, Callable[[Arrays, Any], bytes]] = {
    "nothing": lambda _, __: b"",
    "two letters": lambda _, __: b"AH",
    "no JSON": headed(b"arrays"),
    "another JSON": headed(b"[]"),
    "cut off": lambda arrays, facts: pack_arrays(arrays, facts, 0)[:-9],
    "longer": lambda arrays, facts: pack_arrays(arrays, facts, 0) + b"x",
    "gigabytes": headed(b'{"facts": 0, "arrays": [["lofted", "<f8", [9999999999]]]}'),
    "sizes that cancel": headed(b'{"facts": 0, "arrays": [["lofted", "<f8", [99999999, 0]]]}'),
    "negative size": headed(b'{"facts": 0, "arrays": [["lofted", "<i4", [-1]]]}'),
    "size that is no number": headed(b'{"facts": 0, "arrays": [["lofted", "<i4", ["9"]]]}'),
    "objects": headed(b'{"facts": 0, "arrays": [["lofted", "|O", [1]]]}', bytes(8)),
    "a type that is no text": headed(b'{"facts": 0, "arrays": [["lofted", 7, [1]]]}', bytes(8)),
    "deep brackets": headed(b"[" * 100_000),
    "array that is missing": lambda arrays, facts: pack_arrays(
        {name: each for name, each in arrays.items() if name != "lofted"}, facts, 0
    ),
    "rows of another type": altered(rows__xyz__rows=lambda each: each.astype(np.float64)),
    "rows of two axes": altered(rows__xyz__rows=lambda each: each.reshape(-1, 1)),
    "row beyond the end": altered(rows__xyz__rows=put(-1, 2**31 - 1)),
    "row below nil": altered(rows__xyz__rows=put(0, -1)),
    "row that stands twice": altered(
        rows__xyz__rows=lambda each: np.repeat(each, 2),
        rows__xyz__mask=lambda each: np.packbits(np.repeat(np.unpackbits(each)[:3], 2)),
        rows__xyz__words=lambda each: np.repeat(each, 2),
    ),
    "rows and bits of two lengths": altered(rows__xyz__rows=lambda each: np.append(each, 5)),
    "mask of another length": altered(rows__xyz__mask=lambda each: np.append(each, np.uint8(0))),
    "mask beyond the rows": altered(rows__xyz__mask=put(0, 255)),
    "words too few": altered(moved__words=lambda each: each[:-1]),
    "words of another type": altered(moved__words=lambda each: each.view(np.float64)),
    "a place more": altered(moved__odd=lambda each: each[:0] if len(each) else np.zeros(1, "u1")),
    "curve that is not there": altered(moved=put(-1, 10_000)),
    "curves in another order": altered(moved=lambda each: each[::-1]),
    "lofted curve below nil": altered(lofted=put(0, -7)),
    "width of nothing": told(bits={"rows.xyz": 0}),
    "width of more": told(bits={"rows.xyz": 8_000_000_000}),
    "width that is no number": told(bits={"rows.xyz": "24"}),
    "column that is none": told(bits={"rows.xyz": 24, "rows.more": 8}),
    "facts that are none": told(bits=7),
    "texts as numbers": told(objects={"rows.xyz": [[1], [2], [3]]}),
    "an object for a row that is not there": told(objects={"lines.note": [[99], ["a"], ["b"]]}),
    "objects too few": told(objects={"lines.note": [[1, 2], ["a"], ["b"]]}),
    "spline that is not there": told(kept=[[1], []]),
    "sizes of all memory": told(sizes={"rows": [10, 4_000_000_000]}),
    "counts of births that are texts": told(births=[["a", "b", "x", "y"]]),
}  # fmt: skip


@pytest.mark.parametrize("harm", BLOBS.values(), ids=BLOBS)
def test_a_change_that_was_never_written_is_refused(
    file: Path, harm: Callable[[Arrays, Any], bytes]
) -> None:
    """Well signed: by undo, and by opening where the tables lag behind; the hull is as it was."""
    alter(file, lambda database: blob(database, 2, harm))
    hull = ah.open(file)
    before = hull.fingerprint
    start = time.process_time()
    with pytest.raises(DamagedFileError) as caught:
        hull.undo()
    assert time.process_time() - start < 1.0
    assert "\n" not in str(caught.value)
    assert len(str(caught.value)) < 1000
    assert hull.fingerprint == before
    hull.close()


def blob(database: sqlite3.Connection, number: int, harm: Callable[[Arrays, Any], bytes]) -> None:
    """Put another change into a step, and sign it."""
    (data,) = database.execute("SELECT change FROM steps WHERE number = ?", (number,)).fetchone()
    made = harm(*unpack_arrays(data))
    database.execute("UPDATE steps SET change = ? WHERE number = ?", (made, number))
    row = database.execute("SELECT * FROM steps WHERE number = ?", (number,)).fetchone()
    digest = step_digest((*row[:7], *row[8:]))
    database.execute("UPDATE steps SET digest = ? WHERE number = ?", (digest, number))


def test_a_place_that_becomes_no_number_is_refused(file: Path) -> None:
    """The bits that lead to nan or to infinity, of a point or of a meeting."""
    hull = ah.open(file)
    place = hull.points[POINT].y
    hull.close()
    bits = np.array(place).view(np.int64)

    def harm(arrays: Arrays, facts: Any) -> bytes:
        words = arrays["rows.xyz.words"].copy()
        words[0] = bits ^ NAN
        return pack_arrays({**arrays, "rows.xyz.words": words}, facts, 0)

    alter(file, lambda database: blob(database, 2, harm))
    hull = ah.open(file)
    with pytest.raises(DamagedFileError, match=r"rows\.xyz becomes no number"):
        hull.undo()
    hull.close()

    def other(arrays: Arrays, facts: Any) -> bytes:
        words = np.full(len(arrays["moved.words"]), 0x7FF0000000000000)
        return pack_arrays({**arrays, "moved.words": words}, facts, 0)

    alter(file, lambda database: blob(database, 1, other))
    hull = ah.open(file)
    with pytest.raises(DamagedFileError):
        hull.undo(2)


def test_a_journal_beside_it_is_not_run(file: Path) -> None:
    """SQLite would, before it looks at anything."""
    journal = file.with_name("ship.hull-journal")
    journal.write_bytes(b"\xd9\xd5\x05\xf9\x20\xa1\x63\xd7" + bytes(512))
    before = file.read_bytes()
    with pytest.raises(DamagedFileError, match="a journal of another program"):
        ah.open(file)
    assert file.read_bytes() == before
    journal.unlink()
    assert ah.open(file).history


@pytest.mark.parametrize("version", range(1, SCHEMA))
def test_an_old_file_with_a_trigger_is_not_brought_up_to_date(tmp_path: Path, version: int) -> None:
    """The schema is looked at before anything is written; without the trigger it opens."""
    path = tmp_path / "old.hull"
    path.write_bytes((OLD / f"version_{version}.hull").read_bytes())
    alter(path, run("CREATE TRIGGER t AFTER UPDATE ON hull BEGIN DELETE FROM steps; END"))
    before = path.read_bytes()
    with pytest.raises(DamagedFileError, match="there is a trigger in it"):
        ah.open(path)
    assert path.read_bytes() == before
    alter(path, run("DROP TRIGGER t"))
    assert ah.open(path).verify() == ()


def test_a_step_more_than_was_made_does_no_harm(file: Path) -> None:
    """Well signed, on no way to the tip or to a name: nothing leads there, and edits go on."""
    before = ah.open(file)
    known = before.fingerprint
    before.close()
    alter(file, doubled)
    hull = ah.open(file)
    assert (hull.fingerprint, hull.verify()) == (known, ())
    with hull.edit("goes on") as edit:
        edit.move(POINT, y=hull.points[POINT].y + 0.02)
    hull.go("branch 1")
    again = ah.open(file)
    assert [each.name for each in again.history] == [f"edit {number}" for number in range(3)]
    assert again.verify() == ()


def test_a_step_whose_name_an_interrupt_cost_does_not_cost_the_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A hull in memory whose `go` was broken off is saved, and opens with all that has a name."""
    hull = ah.examples.wigley(stations=7, waterlines=5)
    for number in range(3):
        if number == 2:
            hull.undo()
        with hull.edit(f"edit {number}") as edit:
            edit.move(POINT, y=hull.points[POINT].y + 0.01 * (1 + number))

    def interrupted(*_: object) -> None:
        raise KeyboardInterrupt

    with monkeypatch.context() as patch:
        patch.setattr(Document, "_name", interrupted)
        with pytest.raises(KeyboardInterrupt):
            hull.go("branch 1")
    hull.save(tmp_path / "saved.hull")
    again = ah.open(tmp_path / "saved.hull")
    assert [each.name for each in again.history] == ["edit 0", "edit 1"]
    assert (again.fingerprint, again.verify()) == (hull.fingerprint, ())


def test_each_version_is_told_from_the_others() -> None:
    """A file of one version is not taken with the schema of another."""
    every = range(1, SCHEMA + 1)
    assert len({tuple(sorted(known_schema(each).items())) for each in every}) == SCHEMA


def test_a_long_note_is_no_harm(file: Path) -> None:
    """What is no JSON may be long, if the file is signed."""
    alter(file, cell("lines", "note", "[" * 10_000, "number = 1", sign=True))
    try:
        assert len(ah.open(file, damaged=True).lines) > 5
    except AssocHullError as error:
        pytest.fail(str(error))
