"""Hull files: bytes flipped or cut off, cells altered, mostly signed anew, so that they open."""

from __future__ import annotations

import contextlib
import functools
import json
import sqlite3
import tempfile
import zlib
from collections.abc import Iterator
from pathlib import Path
from random import Random

import numpy as np

from assoc_hull.hull import Hull
from assoc_hull.io.hull_file.packed_arrays import pack_arrays, unpack_arrays
from assoc_hull.io.hull_file.steps import step_digest
from assoc_hull.io.hull_file.tables import read_state
from assoc_hull.model.definition.fingerprint import root_of
from tests.fuzz.kind import TARGET, Kind
from tests.fuzz.text import change_bytes
from tests.fuzz.values import change_value
from tests.strategies import wigley_sources

__all__ = ["HULL_FILE"]

TABLES = (
    "hull", "groups", "lines", "curves", "points", "features", "associations", "births", "labels",
    "steps",
)  # fmt: skip
CELLS: tuple[object, ...] = (
    0, 1, -1, 2, 7, 2**31, -(2**63), 10_000, None, "", "x", "[]", "{}", "[1, 2]", "null", 0.5,
    float("inf"), b"", b"\x00" * 8, b"\xff" * 24, b"\x00" * 41, "WL 4.167", "nan",
)  # fmt: skip
EDITS = b'[{"op": "transform", "scale": [1, 1.02, 1], "drivers": ["sections"]}]'
LATER = (
    ["check", "ship.hull"],
    ["verify", "ship.hull"],
    ["history", "ship.hull"],
    ["why", "ship.hull", "WL 4.2"],
    ["diff", "ship.hull", "here"],
    ["graph", "ship.hull", "--format", "json"],
    ["edit", "ship.hull", "edits.json", "-o", TARGET],
    ["export", "ship.hull", "-o", TARGET],
    ["undo", "ship.hull", "2"],
    ["redo", "ship.hull"],
    ["go", "ship.hull", "branch 1"],
    ["checkpoint", "ship.hull", "there"],
    ["edit", "ship.hull", "edits.json"],
)


@functools.cache
def base() -> bytes:
    """A small hull with a history: edits, an undone one, a branch and a checkpoint."""
    hull = Hull(wigley_sources(2, 2, 1).adopt())
    with hull.edit("features") as edit:
        edit.insert("ST 1", (100 / 3, 1.2, 0.9), lead=False)
        edit.set_end("ST 2", "start", tangent=(0.0, 1.0, 0.1))
    hull.checkpoint("here")
    with hull.edit("more") as edit:
        edit.shift_line("WL 4.167", 4.2)
    hull.undo()
    with hull.edit("other") as edit:
        edit.rename("WL 2.083 x ST 1", "bilge")
        edit.shift_line("WL 4.167", 4.25)
    with hull.edit("last") as edit:
        edit.rename("WL 4.167", "WL 4.2")
    hull.undo()
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "ship.hull"
        hull.save(path)
        hull.close()
        _forget_when(path)
        return path.read_bytes()


def _forget_when(path: Path) -> None:
    """Take out who and when, so that the bytes are the same each time."""
    database = sqlite3.connect(path, isolation_level=None)
    database.execute("UPDATE labels SET author = '', time = ''")
    for row in list(_steps(database)):
        report = json.loads(str(row[9])) | {"seconds": {}, "author": "", "time": ""}
        plain = (*row[:3], "", "", *row[5:9], json.dumps(report), *row[10:])
        signed = (*plain[:7], step_digest((*plain[:7], *plain[8:])), *plain[8:])
        database.execute(
            "INSERT OR REPLACE INTO steps VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)", signed
        )
    database.execute("VACUUM")
    database.close()


def make(rng: Random) -> bytes:
    """Changed bytes, or changed cells."""
    data = base()
    part = rng.random()
    if part < 0.15:
        return data[: rng.randrange(len(data))]
    if part < 0.35:
        return change_bytes(rng, data)
    # A database in memory knows no log: bytes 18 and 19 say whether there is one.
    database = sqlite3.connect(":memory:", isolation_level=None)
    try:
        database.deserialize(data[:18] + b"\x01\x01" + data[20:])
        for _ in range(rng.choice((1, 1, 1, 2, 4))):
            _change(rng, database)
        if rng.random() < 0.8:
            _sign(database)
        found = database.serialize()
    finally:
        database.close()
    return found[:18] + b"\x02\x02" + found[20:]


def _change(rng: Random, database: sqlite3.Connection) -> None:
    """Alter a cell, take a row away, or take the structure apart."""
    table = rng.choice(TABLES)
    part = rng.random()
    with contextlib.suppress(sqlite3.Error, OverflowError):
        if part < 0.03:
            database.execute(f"DROP TABLE {table}")
        elif part < 0.1:
            database.execute(f"DELETE FROM {table} WHERE rowid = {rng.randrange(1, 20)}")
        elif part < 0.3:
            _change_blob(rng, database)
        else:
            names = [row[1] for row in database.execute(f"PRAGMA table_info({table})")]
            rows = database.execute(f"SELECT count(*) FROM {table}").fetchone()[0]
            row, value = rng.randrange(max(rows, 1)), rng.choice(CELLS)
            database.execute(
                f"UPDATE {table} SET {rng.choice(names)} = ? WHERE {names[0]} = "
                f"(SELECT {names[0]} FROM {table} LIMIT 1 OFFSET {row})",
                (value,),
            )


def _change_blob(rng: Random, database: sqlite3.Connection) -> None:
    """Change what a step holds, inside its packing."""
    column = rng.choice(("change", "trace"))
    number = rng.randrange(1, 5)
    row = database.execute(f"SELECT {column} FROM steps WHERE number = {number}").fetchone()
    data = row[0] if row else b""
    try:
        arrays, facts = unpack_arrays(data)
    except (ValueError, TypeError):  # it was changed already
        return
    if rng.random() < 0.5 and facts is not None:
        facts = change_value(rng, facts)
    else:
        name = rng.choice(sorted(arrays))
        array = arrays[name].copy()
        if array.size and rng.random() < 0.7:
            array.flat[rng.randrange(array.size)] = rng.choice((0, 1, 100))
        else:
            array = array[: len(array) // 2] if array.ndim else np.zeros(3)
        arrays = {**arrays, name: array}
    with contextlib.suppress(TypeError, ValueError, RecursionError):
        database.execute(
            f"UPDATE steps SET {column} = ? WHERE number = {number}", (pack_arrays(arrays, facts),)
        )


def _sign(database: sqlite3.Connection) -> None:
    """Make fingerprint and digests agree, where there is anything to sign."""
    with contextlib.suppress(Exception):  # the trial meets it again, and judges it
        for row in list(_steps(database)):
            made = step_digest((*row[:7], *row[8:]))
            database.execute("UPDATE steps SET digest = ? WHERE number = ?", (made, row[0]))
        with np.errstate(all="ignore"):
            found = root_of(read_state(database))
        database.execute("UPDATE hull SET fingerprint = ?", (found,))


def _steps(database: sqlite3.Connection) -> Iterator[tuple[object, ...]]:
    yield from database.execute("SELECT * FROM steps").fetchall()


def commands(data: bytes) -> list[list[str]]:
    """Open it, and go a step further if it can be opened."""
    return [["info", "ship.hull"], LATER[zlib.crc32(data) % len(LATER)]]


def beside() -> dict[str, bytes]:
    """An edit of all of it."""
    return {"edits.json": EDITS}


HULL_FILE = Kind(
    "hull_file", "ship.hull", make, commands, beside, weight=40,
    rewrites=("undo", "redo", "go", "checkpoint", "edit"),
)  # fmt: skip
