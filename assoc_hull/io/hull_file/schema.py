"""The tables of a hull file, and how files of older versions are brought to this one.

A hull file is one SQLite database. ``PRAGMA application_id`` says that it is one,
``PRAGMA user_version`` by which version of this schema. Real numbers lie in blobs of 8 bytes
each, IEEE 754, little end first: SQLite itself stores -0.0 as 0.0 and nan as nothing.
`docs/file_format.md` tells what each column holds.

Examples
--------
>>> import sqlite3
>>> from assoc_hull.io.hull_file.schema import create, SCHEMA
>>> database = sqlite3.connect(":memory:", isolation_level=None)
>>> create(database)
>>> database.execute("PRAGMA user_version").fetchone() == (SCHEMA,)
True
"""

from __future__ import annotations

import sqlite3
from collections.abc import Callable, Mapping

__all__ = ["APPLICATION", "MIGRATIONS", "SCHEMA", "TABLES", "create", "migrate"]

APPLICATION = 0x4148554C
"""``AHUL`` in ASCII; bytes 68 to 71 of the file."""

SCHEMA = 6

TABLES = """
CREATE TABLE hull (
    id INTEGER PRIMARY KEY CHECK (id = 1),
    name TEXT NOT NULL,
    length REAL NOT NULL,
    breadth REAL NOT NULL,
    depth REAL NOT NULL,
    draught REAL NOT NULL,
    tolerances TEXT NOT NULL,
    failed TEXT NOT NULL,
    written_by TEXT NOT NULL,
    start TEXT NOT NULL,
    fingerprint TEXT NOT NULL,
    head INTEGER NOT NULL,
    tip INTEGER NOT NULL,
    serial INTEGER NOT NULL,
    deck TEXT NOT NULL DEFAULT 'open'
);
CREATE TABLE groups (
    number INTEGER PRIMARY KEY, name TEXT NOT NULL, family TEXT NOT NULL, alive INTEGER NOT NULL
);
CREATE TABLE lines (
    number INTEGER PRIMARY KEY, key TEXT NOT NULL, name TEXT NOT NULL, alive INTEGER NOT NULL,
    group_number INTEGER NOT NULL, planar INTEGER NOT NULL, normal BLOB NOT NULL,
    offset BLOB NOT NULL, boundary INTEGER NOT NULL, curves TEXT NOT NULL, note TEXT NOT NULL
);
CREATE TABLE curves (
    number INTEGER PRIMARY KEY, key TEXT NOT NULL, alive INTEGER NOT NULL, line INTEGER NOT NULL,
    state INTEGER NOT NULL, revision INTEGER NOT NULL, ends TEXT NOT NULL, points BLOB NOT NULL,
    places BLOB NOT NULL, kept BLOB
);
CREATE TABLE points (
    number INTEGER PRIMARY KEY, key TEXT NOT NULL, label TEXT NOT NULL, alive INTEGER NOT NULL,
    sort INTEGER NOT NULL, role INTEGER NOT NULL, override INTEGER NOT NULL,
    curve_a INTEGER NOT NULL, curve_b INTEGER NOT NULL, kind_a INTEGER NOT NULL,
    kind_b INTEGER NOT NULL, reader_a INTEGER NOT NULL, reader_b INTEGER NOT NULL,
    driver INTEGER NOT NULL, contact INTEGER NOT NULL, sign INTEGER NOT NULL,
    birth INTEGER NOT NULL, state INTEGER NOT NULL, revision INTEGER NOT NULL,
    anchor_a INTEGER NOT NULL, anchor_b INTEGER NOT NULL, xyz BLOB NOT NULL,
    direction BLOB, gap_limit BLOB, gap BLOB, base BLOB, anchor_from BLOB, anchor_weight BLOB
);
CREATE TABLE features (
    number INTEGER PRIMARY KEY, alive INTEGER NOT NULL, key TEXT NOT NULL, kind TEXT NOT NULL,
    name TEXT NOT NULL, lines TEXT NOT NULL, points BLOB NOT NULL, centre BLOB, radius BLOB,
    normal BLOB, plane_offset BLOB, direction BLOB, side INTEGER NOT NULL, gap BLOB NOT NULL
);
CREATE TABLE definitions (
    number INTEGER PRIMARY KEY, alive INTEGER NOT NULL, use TEXT NOT NULL, name TEXT NOT NULL,
    kind TEXT NOT NULL, rule TEXT NOT NULL, nodes TEXT NOT NULL, numbers BLOB NOT NULL
);
CREATE TABLE generated (
    number INTEGER PRIMARY KEY, alive INTEGER NOT NULL, key TEXT NOT NULL, curve INTEGER NOT NULL,
    what TEXT NOT NULL, layout TEXT NOT NULL, points BLOB NOT NULL, marks BLOB NOT NULL,
    attached INTEGER NOT NULL
);
CREATE TABLE associations (
    a TEXT NOT NULL, b TEXT NOT NULL, two_way INTEGER NOT NULL, PRIMARY KEY (a, b)
);
CREATE TABLE births (
    a TEXT NOT NULL, b TEXT NOT NULL, count INTEGER NOT NULL, PRIMARY KEY (a, b)
) WITHOUT ROWID;
CREATE TABLE gone (
    kind TEXT NOT NULL, number INTEGER NOT NULL, revision INTEGER NOT NULL,
    PRIMARY KEY (kind, number)
) WITHOUT ROWID;
CREATE TABLE labels (
    name TEXT PRIMARY KEY, step INTEGER NOT NULL, branch INTEGER NOT NULL,
    author TEXT NOT NULL DEFAULT '', time TEXT NOT NULL DEFAULT ''
);
CREATE TABLE steps (
    number INTEGER PRIMARY KEY, parent INTEGER NOT NULL, name TEXT NOT NULL,
    author TEXT NOT NULL, time TEXT NOT NULL, structural INTEGER NOT NULL,
    fingerprint TEXT NOT NULL, digest TEXT NOT NULL, script TEXT NOT NULL, report TEXT NOT NULL,
    trace BLOB NOT NULL, change BLOB NOT NULL
);
"""

Migration = Callable[[sqlite3.Connection], None]


def _sign_labels(database: sqlite3.Connection) -> None:
    """From 1 to 2: names tell who gave them, and when; of older ones nobody knows."""
    for column in ("author", "time"):
        database.execute(f"ALTER TABLE labels ADD COLUMN {column} TEXT NOT NULL DEFAULT ''")


def _remember_gone(database: sqlite3.Connection) -> None:
    """From 2 to 3: revisions of rows that undoing took out; those of older ones are lost."""
    database.execute(
        "CREATE TABLE gone (kind TEXT NOT NULL, number INTEGER NOT NULL, "
        "revision INTEGER NOT NULL, PRIMARY KEY (kind, number)) WITHOUT ROWID"
    )


def _tell_deck(database: sqlite3.Connection) -> None:
    """From 3 to 4: the deck is open or closed; that of older hulls counts as open."""
    database.execute("ALTER TABLE hull ADD COLUMN deck TEXT NOT NULL DEFAULT 'open'")


def _tell_features(database: sqlite3.Connection) -> None:
    """From 4 to 5: features; older hulls have none."""
    database.execute(
        "CREATE TABLE features (number INTEGER PRIMARY KEY, alive INTEGER NOT NULL, "
        "key TEXT NOT NULL, kind TEXT NOT NULL, name TEXT NOT NULL, lines TEXT NOT NULL, "
        "points BLOB NOT NULL, centre BLOB, radius BLOB, normal BLOB, plane_offset BLOB, "
        "direction BLOB, side INTEGER NOT NULL, gap BLOB NOT NULL)"
    )


def _tell_definitions(database: sqlite3.Connection) -> None:
    """From 5 to 6: definitions and the curves that come from them; older hulls have none."""
    database.execute(
        "CREATE TABLE definitions (number INTEGER PRIMARY KEY, alive INTEGER NOT NULL, "
        "use TEXT NOT NULL, name TEXT NOT NULL, kind TEXT NOT NULL, rule TEXT NOT NULL, "
        "nodes TEXT NOT NULL, numbers BLOB NOT NULL)"
    )
    database.execute(
        "CREATE TABLE generated (number INTEGER PRIMARY KEY, alive INTEGER NOT NULL, "
        "key TEXT NOT NULL, curve INTEGER NOT NULL, what TEXT NOT NULL, layout TEXT NOT NULL, "
        "points BLOB NOT NULL, marks BLOB NOT NULL, attached INTEGER NOT NULL)"
    )


MIGRATIONS: Mapping[int, Migration] = {
    1: _sign_labels, 2: _remember_gone, 3: _tell_deck, 4: _tell_features,
    5: _tell_definitions,
}  # fmt: skip
"""By version: what brings a file of it to the next one."""


def create(database: sqlite3.Connection) -> None:
    """Make the tables in an empty database."""
    database.executescript(TABLES)
    database.execute(f"PRAGMA application_id = {APPLICATION}")
    database.execute(f"PRAGMA user_version = {SCHEMA}")


def migrate(database: sqlite3.Connection) -> None:
    """Bring a file to this version, all of it or nothing."""
    database.execute("BEGIN IMMEDIATE")
    try:
        # Another process may have brought it there while this one waited.
        version = database.execute("PRAGMA user_version").fetchone()[0]
        for each in range(version, SCHEMA):
            MIGRATIONS[each](database)
        database.execute(f"PRAGMA user_version = {SCHEMA}")
        database.execute("COMMIT")
    except BaseException:
        database.execute("ROLLBACK")
        raise
