"""The SQLite database in a hull file: its tables, migration of older versions, and connecting.

``PRAGMA application_id`` says that it is a hull file, ``PRAGMA user_version`` by which version of
the schema. Real numbers lie in blobs of 8 bytes each, IEEE 754, little-endian: SQLite itself stores
-0.0 as 0.0 and nan as NULL. `database_errors` turns what SQLite says into errors of this package,
in one line. `docs/file_format.md` tells what each column holds.

Examples
--------
>>> from pathlib import Path
>>> from assoc_hull.io.open_databases import is_hull_file
>>> is_hull_file(Path(__file__))
False
"""

from __future__ import annotations

import contextlib
import os
import sqlite3
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from urllib.parse import quote

import numpy as np

from assoc_hull.arguments import regular_file
from assoc_hull.errors import BadInputError, DamagedFileError, FileBusyError, HullFileError
from assoc_hull.io.open_databases import MAGIC, HullFileConnection, is_open_here, log_file

__all__ = [
    "APPLICATION",
    "MIGRATIONS",
    "SCHEMA",
    "TABLES",
    "connect_database",
    "create_tables",
    "damage_errors",
    "database_errors",
    "is_writable",
    "migrate_tables",
]

# --------------------------------------------------------------------------------------
# Tables and migrations.

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


def _add_label_authors(database: sqlite3.Connection) -> None:
    """From 1 to 2: labels have an author and a time; those of older ones are not known."""
    for column in ("author", "time"):
        database.execute(f"ALTER TABLE labels ADD COLUMN {column} TEXT NOT NULL DEFAULT ''")


def _add_gone(database: sqlite3.Connection) -> None:
    """From 2 to 3: revisions of rows that undoing took out; those of older ones are lost."""
    database.execute(
        "CREATE TABLE gone (kind TEXT NOT NULL, number INTEGER NOT NULL, "
        "revision INTEGER NOT NULL, PRIMARY KEY (kind, number)) WITHOUT ROWID"
    )


def _add_deck(database: sqlite3.Connection) -> None:
    """From 3 to 4: the deck is open or closed; that of older hulls counts as open."""
    database.execute("ALTER TABLE hull ADD COLUMN deck TEXT NOT NULL DEFAULT 'open'")


def _add_features(database: sqlite3.Connection) -> None:
    """From 4 to 5: features; older hulls have none."""
    database.execute(
        "CREATE TABLE features (number INTEGER PRIMARY KEY, alive INTEGER NOT NULL, "
        "key TEXT NOT NULL, kind TEXT NOT NULL, name TEXT NOT NULL, lines TEXT NOT NULL, "
        "points BLOB NOT NULL, centre BLOB, radius BLOB, normal BLOB, plane_offset BLOB, "
        "direction BLOB, side INTEGER NOT NULL, gap BLOB NOT NULL)"
    )


def _add_definitions(database: sqlite3.Connection) -> None:
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
    1: _add_label_authors, 2: _add_gone, 3: _add_deck, 4: _add_features,
    5: _add_definitions,
}  # fmt: skip
"""By version: what brings a file of it to the next one."""


def create_tables(database: sqlite3.Connection) -> None:
    """Make the tables in an empty database."""
    database.executescript(TABLES)
    database.execute(f"PRAGMA application_id = {APPLICATION}")
    database.execute(f"PRAGMA user_version = {SCHEMA}")


def migrate_tables(database: sqlite3.Connection) -> None:
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


# --------------------------------------------------------------------------------------
# Connecting, and saying in one line why it cannot be done.

_COPY = "take it from a copy, and look after the disk"


@contextlib.contextmanager
def database_errors(path: Path, waited: float = 0.0) -> Iterator[None]:
    """Turn what the database says of a file into errors of this package.

    Raises
    ------
    FileBusyError
        Another process writes to it.
    DamagedFileError
        It does not hold what was written to it.
    HullFileError
        The disk is full, the file may not be written, or input or output failed.
    BadInputError
        A name cannot be written.
    """
    try:
        yield
    except sqlite3.Error as error:
        raise _explained(error, path, waited) from error
    except UnicodeEncodeError as error:
        what = f"a name holds {error.object[error.start]!r}, which is no character"
        raise BadInputError(what, f"for {path}", "choose another name") from error
    except UnicodeDecodeError as error:  # the database quotes what it found
        what = "it is damaged (there are bytes that are no text)"
        raise DamagedFileError(what, f"at {path}", _COPY) from error


@contextlib.contextmanager
def damage_errors(path: Path, fault: str) -> Iterator[None]:
    """Turn what is raised over content that was never written into a damaged file.

    `fault` says what cannot be done with the file then.

    Raises
    ------
    DamagedFileError
        With what was come upon.
    """
    try:
        with np.errstate(all="ignore"):
            yield
    except DamagedFileError:
        raise
    except (ValueError, TypeError, LookupError, ArithmeticError, AttributeError) as error:
        what = " ".join(f"{fault} ({error})".split())
        raise DamagedFileError(what, f"in {path}", "take it from a copy") from error


def _explained(error: sqlite3.Error, path: Path, waited: float) -> Exception:
    """Give the error of this package for an error of SQLite."""
    name = getattr(error, "sqlite_errorname", "") or ""
    if isinstance(error, sqlite3.ProgrammingError) and "closed" in str(error):
        return HullFileError(str(path), "it is closed", "open it again")
    if name.startswith(("SQLITE_BUSY", "SQLITE_LOCKED")):
        return FileBusyError(str(path), waited)
    if name.startswith("SQLITE_FULL"):
        what, remedy = "the disk is full", "make room; the file is as it was"
    elif name.startswith("SQLITE_READONLY"):
        what, remedy = "it may only be read", "change its permissions, or save a copy elsewhere"
    elif name.startswith("SQLITE_CANTOPEN"):
        what, remedy = "it cannot be opened", "check the folder, name and permissions"
    elif name.startswith("SQLITE_IOERR"):
        what, remedy = f"input or output failed ({error})", "the file is as it was; check the disk"
    elif isinstance(error, sqlite3.ProgrammingError | sqlite3.InterfaceError):
        what, remedy = f"it cannot be used ({error})", "open it again"
    else:
        what = " ".join(f"it is damaged ({error})".split())
        return DamagedFileError(what, f"at {path}", _COPY)
    return HullFileError(str(path), what, remedy)


def is_writable(path: Path) -> bool:
    """Tell whether file and folder may be written: the database needs a log beside the file."""
    return _may(path, os.W_OK) and _may(path.parent, os.W_OK | os.X_OK)


def _may(path: Path, mode: int) -> bool:
    """Tell whether this process may use a file or folder in a mode, by its effective ids."""
    return os.access(path, mode, effective_ids=os.access in os.supports_effective_ids)


def connect_database(path: Path, wait: float) -> HullFileConnection:
    """Open the database in a hull file, migrated to this version of the schema.

    `wait` (s) is how long to wait while another process writes.

    Raises
    ------
    BadInputError
        There is no such file, or it is no hull file, or one of a newer version.
    DamagedFileError, FileBusyError, HullFileError
        See `database_errors`.
    """
    _require_readable(path)
    with database_errors(path, wait):
        database = sqlite3.connect(
            _address(path), uri=True, timeout=wait, isolation_level=None, check_same_thread=False,
            factory=HullFileConnection,
        )  # fmt: skip
    try:
        database.know(path)
        with database_errors(path, wait):
            _set_up(database, path)
    except BaseException:
        database.close()
        raise
    return database


def _address(path: Path) -> str:
    """Give the URI by which SQLite opens the file: to write, to read, or as one nobody changes."""
    name = f"file:{quote(str(path.absolute()))}"
    if is_writable(path):
        return f"{name}?mode=rw"
    if log_file(path).exists() or _may(path.parent, os.W_OK | os.X_OK):
        return f"{name}?mode=ro"
    return f"{name}?mode=ro&immutable=1"  # nobody can write a log in that folder


def _set_up(database: sqlite3.Connection, path: Path) -> None:
    """Refuse a database of another program or a newer version; migrate an older one."""
    found = database.execute("PRAGMA application_id").fetchone()[0]
    if found != APPLICATION:
        what = f"this is a database of something else (application {found:#x})"
        raise BadInputError(what, f"at {path}", "give a hull file, made by save or assoc-hull")
    version = database.execute("PRAGMA user_version").fetchone()[0]
    if version > SCHEMA or version < 1:
        raise BadInputError(
            f"it has version {version} of the hull file, and this program reads 1 to {SCHEMA}",
            f"at {path}", "open it with the version of assoc-hull that wrote it",
        )  # fmt: skip
    database.execute("PRAGMA synchronous = FULL")
    if version < SCHEMA:
        if not is_writable(path):
            what = f"it has version {version} of the hull file, and may only be read"
            raise BadInputError(what, f"at {path}", "copy it to where it can be brought up to date")
        migrate_tables(database)


def _require_readable(path: Path) -> None:
    """Refuse a file that is none of these, or cut off, before SQLite does, which would say less."""
    if is_open_here(path):
        return
    if path.is_dir():
        raise BadInputError("this is a folder", f"at {path}", "give the name of a hull file")
    try:
        with regular_file(path).open("rb") as file:
            head = file.read(100)
        size = path.stat().st_size
    except OSError as error:
        what = f"the file cannot be read ({error.strerror or error})"
        raise BadInputError(what, f"at {path}", "check name and permissions") from error
    if len(head) < 100 or head[: len(MAGIC)] != MAGIC:
        what = f"this is no hull file ({'it is empty' if not head else 'it begins otherwise'})"
        raise BadInputError(what, f"at {path}", "give a hull file, made by save or assoc-hull")
    page = int.from_bytes(head[16:18], "big")
    whole = (65536 if page == 1 else page) * int.from_bytes(head[28:32], "big")
    if size < whole and not log_file(path).exists():
        what = f"it is cut off: it has {size} of {whole} bytes"
        raise DamagedFileError(what, f"at {path}", _COPY)
