"""The SQLite database in a hull file: tables, migration, connecting, and a foreign log refused.

``PRAGMA application_id`` says that it is a hull file, ``PRAGMA user_version`` by which version of
the schema. Real numbers lie in blobs of 8 bytes each, IEEE 754, little-endian: SQLite itself stores
-0.0 as 0.0 and nan as NULL. `database_errors` turns what SQLite says into errors of this package,
in one line. `docs/file_format.md` tells what each column holds.

A log beside a hull file that belongs to another hull is refused before it is opened.

SQLite takes whatever log has the name of the file for its own: it would write the pages of the
other hull over this one. A hull file keeps the fingerprint with which its history began, and every
commit writes the page with that row; so the newest such page in the log tells whose log it is.

Examples
--------
>>> from pathlib import Path
>>> from assoc_hull.io.open_databases import is_hull_file
>>> is_hull_file(Path(__file__))
False
>>> from assoc_hull.io.hull_file.database import require_own_log
>>> require_own_log(Path("no.hull"))  # no log, nothing to refuse
"""

from __future__ import annotations

import contextlib
import functools
import os
import shutil
import sqlite3
import tempfile
import time
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from urllib.parse import quote

import numpy as np

from assoc_hull.arguments import regular_file
from assoc_hull.errors import (
    BadInputError,
    DamagedFileError,
    FileBusyError,
    HullFileError,
)
from assoc_hull.io.hull_file.guard import (
    GuardedConnection,
    Schema,
    schema_fault,
    schema_of,
)
from assoc_hull.io.open_databases import MAGIC, is_open_here, log_file

__all__ = [
    "AGAIN",
    "APPLICATION",
    "MIGRATIONS",
    "SCHEMA",
    "TABLES",
    "connect_database",
    "connect_new",
    "create_tables",
    "damage_errors",
    "database_errors",
    "is_writable",
    "known_schema",
    "migrate_tables",
    "require_own_log",
    "require_schema",
]

_HEAD, _FRAME = 32, 24
"""Bytes of the header of a log, and of that of each page in it: https://sqlite.org/fileformat2.html
section 4."""

_LOOKS, _PAUSE = 3, 0.02
"""A log in use changes between two looks: it is foreign if so many say so, s apart."""


def require_own_log(path: Path) -> None:
    """Refuse a hull file beside which the log of another hull lies.

    Raises
    ------
    DamagedFileError
        It does; neither file is changed.
    """
    if is_open_here(path):  # and opened when its log was looked at
        return
    for look in range(_LOOKS):
        if not _is_foreign(path):
            return
        if look < _LOOKS - 1:
            time.sleep(_PAUSE)
    log = log_file(path)
    what = f"the log beside it, {log.name}, is that of another hull"
    remedy = f"move {log.name} beside the hull file that it belongs to, then open this one again"
    raise DamagedFileError(what, f"at {path}", remedy)


def _is_foreign(path: Path) -> bool:
    """Tell whether the log holds the row of another hull."""
    try:
        log = log_file(path).read_bytes()
    except OSError:  # none, or one that may not be read: opening says so
        return False
    if len(log) <= _HEAD:
        return False
    own = _start(path, "mode=ro&immutable=1")
    page = None if own is None else _newest_page(log, own[1])
    if own is None or page is None or own[0].encode() in page:
        return False
    # The row may have grown beyond its page: SQLite reads it from copies.
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder) / "copy.hull"
        try:
            shutil.copyfile(path, copy)
            log_file(copy).write_bytes(log)
        except OSError:
            return False
        found = _start(copy, "mode=rw")
    return found is None or found[0] != own[0]


def _start(path: Path, how: str) -> tuple[str, int] | None:
    """Give the fingerprint with which a history began, and the page it lies on; None if unread."""
    address = f"file:{quote(os.path.abspath(path))}?{how}"
    try:
        with contextlib.closing(sqlite3.connect(address, uri=True)) as database:
            (start,) = database.execute("SELECT start FROM hull").fetchone()
            wanted = "SELECT rootpage FROM sqlite_master WHERE name = 'hull'"
            (root,) = database.execute(wanted).fetchone()
    except (sqlite3.Error, TypeError, ValueError):
        return None
    return (start, root) if isinstance(start, str) and start and isinstance(root, int) else None


def _newest_page(log: bytes, number: int) -> bytes | None:
    """Give the last content of a page that a log holds; None if it has none."""
    size, salt = int.from_bytes(log[8:12], "big"), log[16:24]
    if size < 512:
        return None
    found = None
    for at in range(_HEAD, len(log) - _FRAME - size + 1, _FRAME + size):
        # Frames after the last of this round are those of an older one, with other salts.
        if log[at + 8 : at + 16] != salt:
            break
        if int.from_bytes(log[at : at + 4], "big") == number:
            found = log[at + _FRAME : at + _FRAME + size]
    return found


# --------------------------------------------------------------------------------------
# Tables and migrations.

AGAIN = (
    "take it from another copy; if it is a copy, make it again while nobody edits, or by "
    "hull.save(other)"
)
"""What to do about a file that is damaged: a copy that an edit tore looks like that, too."""

APPLICATION = 0x4148554C
"""``AHUL`` in ASCII; bytes 68 to 71 of the file."""

SCHEMA = 11

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
    deck TEXT NOT NULL DEFAULT 'open',
    base INTEGER NOT NULL DEFAULT 0
);
CREATE TABLE groups (
    number INTEGER PRIMARY KEY, name TEXT NOT NULL, family TEXT NOT NULL, alive INTEGER NOT NULL,
    members TEXT NOT NULL DEFAULT '[]'
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
    direction BLOB, gap_limit BLOB, gap BLOB, base BLOB, anchor_from BLOB, anchor_weight BLOB,
    faired BLOB, first_role INTEGER NOT NULL DEFAULT -1, stands_for TEXT NOT NULL DEFAULT ''
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
CREATE TABLE rulings (
    place INTEGER PRIMARY KEY, a TEXT NOT NULL, b TEXT NOT NULL, two_way INTEGER NOT NULL,
    box TEXT NOT NULL
);
CREATE TABLE tunnels (
    place INTEGER PRIMARY KEY, name TEXT NOT NULL, x BLOB NOT NULL, z BLOB NOT NULL,
    radius BLOB NOT NULL
);
CREATE TABLE bodies (
    place INTEGER PRIMARY KEY, name TEXT NOT NULL, kind TEXT NOT NULL, sections TEXT NOT NULL,
    corners TEXT NOT NULL, both INTEGER NOT NULL, sign INTEGER NOT NULL
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


def _add_base(database: sqlite3.Connection) -> None:
    """From 6 to 7: the tables may lag behind the steps; those of older files never do."""
    database.execute("ALTER TABLE hull ADD COLUMN base INTEGER NOT NULL DEFAULT 0")
    database.execute("UPDATE hull SET base = head")


def _add_faired(database: sqlite3.Connection) -> None:
    """From 7 to 8: how far fairing has taken points; older hulls were never faired."""
    database.execute("ALTER TABLE points ADD COLUMN faired BLOB")


def _add_switches(database: sqlite3.Connection) -> None:
    """From 8 to 9: what switched associations left, and groups of one's own; none in older ones."""
    database.execute("ALTER TABLE points ADD COLUMN first_role INTEGER NOT NULL DEFAULT -1")
    database.execute("ALTER TABLE points ADD COLUMN stands_for TEXT NOT NULL DEFAULT ''")
    database.execute("ALTER TABLE groups ADD COLUMN members TEXT NOT NULL DEFAULT '[]'")
    database.execute(
        "CREATE TABLE rulings (place INTEGER PRIMARY KEY, a TEXT NOT NULL, b TEXT NOT NULL, "
        "two_way INTEGER NOT NULL, box TEXT NOT NULL)"
    )


def _add_tunnels(database: sqlite3.Connection) -> None:
    """From 9 to 10: tunnels through the hull; older ones have none."""
    database.execute(
        "CREATE TABLE tunnels (place INTEGER PRIMARY KEY, name TEXT NOT NULL, x BLOB NOT NULL, "
        "z BLOB NOT NULL, radius BLOB NOT NULL)"
    )


def _add_bodies(database: sqlite3.Connection) -> None:
    """From 10 to 11: bodies beside the net; older ones have none."""
    database.execute(
        "CREATE TABLE bodies (place INTEGER PRIMARY KEY, name TEXT NOT NULL, kind TEXT NOT NULL, "
        "sections TEXT NOT NULL, corners TEXT NOT NULL, both INTEGER NOT NULL, "
        "sign INTEGER NOT NULL)"
    )


MIGRATIONS: Mapping[int, Migration] = {
    1: _add_label_authors, 2: _add_gone, 3: _add_deck, 4: _add_features,
    5: _add_definitions, 6: _add_base, 7: _add_faired,
    8: _add_switches, 9: _add_tunnels, 10: _add_bodies,
}  # fmt: skip
"""By version: what brings a file of it to the next one."""


_CAME = {
    "gone": 3, "features": 5, "definitions": 6, "generated": 6, "rulings": 9, "tunnels": 10,
    "bodies": 11,
}  # fmt: skip
_GREW = (
    ("labels", 2, ",author TEXT NOT NULL DEFAULT '',time TEXT NOT NULL DEFAULT ''"),
    ("hull", 4, ",deck TEXT NOT NULL DEFAULT 'open'"),
    ("hull", 7, ",base INTEGER NOT NULL DEFAULT 0"),
    ("points", 8, ",faired BLOB"),
    ("groups", 9, ",members TEXT NOT NULL DEFAULT '[]'"),
    ("points", 9, ",first_role INTEGER NOT NULL DEFAULT -1,stands_for TEXT NOT NULL DEFAULT ''"),
)
"""Versions in which tables came, and in which they got columns, without white space."""


@functools.cache
def known_schema(version: int) -> Schema:
    """Give the schema of a version, made anew or brought there from an older one."""
    found = {
        name: each for name, each in schema_of(TABLES).items() if _CAME.get(name, 1) <= version
    }
    for name, since, columns in _GREW:
        if version < since:
            kind, table, text = found[name]
            found[name] = kind, table, text.replace(columns, "")
    return found


def require_schema(database: sqlite3.Connection, path: Path, version: int = SCHEMA) -> None:
    """Refuse a file whose schema is not exactly that of a version.

    Raises
    ------
    DamagedFileError
        It is not: what else is in there might run with any query.
    """
    fault = schema_fault(database, known_schema(version))
    if fault:
        raise DamagedFileError(f"it is damaged or was tampered with ({fault})", f"at {path}", AGAIN)


def create_tables(database: sqlite3.Connection) -> None:
    """Make the tables in an empty database."""
    database.executescript(TABLES)
    database.execute(f"PRAGMA application_id = {APPLICATION}")
    database.execute(f"PRAGMA user_version = {SCHEMA}")


def migrate_tables(database: sqlite3.Connection, path: Path) -> None:
    """Bring a file to this version, all of it or nothing.

    Raises
    ------
    DamagedFileError
        Its schema is not that of its version.
    """
    database.execute("BEGIN IMMEDIATE")
    try:
        # Another process may have brought it there while this one waited.
        version = database.execute("PRAGMA user_version").fetchone()[0]
        require_schema(database, path, version)
        for each in range(version, SCHEMA):
            MIGRATIONS[each](database)
        database.execute(f"PRAGMA user_version = {SCHEMA}")
        require_schema(database, path)
        database.execute("COMMIT")
    except BaseException:
        database.execute("ROLLBACK")
        raise


# --------------------------------------------------------------------------------------
# Connecting, and saying in one line why it cannot be done.


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
        raise DamagedFileError(what, f"at {path}", AGAIN) from error


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
    except MemoryError as error:
        what = f"{fault} (it asks for more memory than there is)"
        raise DamagedFileError(what, f"in {path}", AGAIN) from error
    except (
        ValueError, TypeError, LookupError, ArithmeticError, AttributeError, RecursionError,
    ) as error:  # fmt: skip
        what = " ".join(f"{fault} ({error})".split())
        raise DamagedFileError(what, f"in {path}", AGAIN) from error


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
        log = log_file(path)
        # SQLite makes an index beside a log before it reads one.
        if log.exists() and not _may(path.parent, os.W_OK | os.X_OK):
            what = f"its last edits lie in the log beside it, {log.name}, in a read-only folder"
            remedy = "copy both files to a folder that may be written, and open the copy"
    elif name.startswith("SQLITE_IOERR"):
        what, remedy = f"input or output failed ({error})", "the file is as it was; check the disk"
    elif isinstance(error, sqlite3.ProgrammingError | sqlite3.InterfaceError):
        what, remedy = f"it cannot be used ({error})", "open it again"
    elif name.startswith("SQLITE_INTERRUPT"):
        what = "it is damaged (looking through it takes longer than its size allows)"
        return DamagedFileError(what, f"at {path}", AGAIN)
    else:
        what = " ".join(f"it is damaged ({error})".split())
        return DamagedFileError(what, f"at {path}", AGAIN)
    return HullFileError(str(path), what, remedy)


def is_writable(path: Path) -> bool:
    """Tell whether file and folder may be written: the database needs a log beside the file."""
    return _may(path, os.W_OK) and _may(path.parent, os.W_OK | os.X_OK)


def _may(path: Path, mode: int) -> bool:
    """Tell whether this process may use a file or folder in a mode, by its effective ids."""
    return os.access(path, mode, effective_ids=os.access in os.supports_effective_ids)


def connect_database(path: Path, wait: float, *, beside: bool = False) -> GuardedConnection:
    """Open the database in a hull file, migrated to this version of the schema.

    `wait` (s) is how long to wait while another process writes. `beside`: only to read, by the side
    of a connection of this process that is closed later.

    Raises
    ------
    BadInputError
        There is no such file, or it is no hull file, or one of a newer version.
    DamagedFileError, FileBusyError, HullFileError
        See `database_errors`.
    """
    _require_readable(path)
    require_own_log(path)
    with database_errors(path, wait):
        database = _connect(_address(path), wait)
    try:
        if not beside:
            database.know(path)
        with database_errors(path, wait):
            database.guard(path)
            _set_up(database, path)
            if beside:
                database.execute("PRAGMA query_only = ON")
    except BaseException:
        database.close()
        raise
    return database


def connect_new(name: str) -> GuardedConnection:
    """Open an empty file, in which a database is to be made."""
    database = _connect(f"file:{quote(os.path.abspath(name))}?mode=rw", 0.0)
    database.guard(None)
    database.execute("PRAGMA synchronous = FULL")
    return database


def _connect(address: str, wait: float) -> GuardedConnection:
    return sqlite3.connect(
        address, uri=True, timeout=wait, isolation_level=None, check_same_thread=False,
        factory=GuardedConnection,
    )  # fmt: skip


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
    require_schema(database, path, version)
    database.execute("PRAGMA synchronous = FULL")
    if version < SCHEMA:
        if not is_writable(path):
            what = f"it has version {version} of the hull file, and may only be read"
            raise BadInputError(what, f"at {path}", "copy it to where it can be brought up to date")
        migrate_tables(database, path)


def _require_readable(path: Path) -> None:
    """Refuse a file that is none of these, or cut off, before SQLite does, which would say less."""
    if is_open_here(path):
        return
    if path.is_dir():
        raise BadInputError("this is a folder", f"at {path}", "give the name of a hull file")
    head, size = _head(path)
    if len(head) < 100 or head[: len(MAGIC)] != MAGIC:
        what = f"this is no hull file ({'it is empty' if not head else 'it begins otherwise'})"
        raise BadInputError(what, f"at {path}", "give a hull file, made by save or assoc-hull")
    # SQLite would run a journal over the file before it looks at anything; a log it checks.
    if head[18:20] == b"\x02\x02" and path.with_name(f"{path.name}-journal").exists():
        what = f"a journal of another program lies beside it, {path.name}-journal"
        raise DamagedFileError(what, f"at {path}", "move the journal away, then open it again")
    for again in (True, True, True, False):
        fault = _length_fault(head, size)
        if not fault or log_file(path).exists():
            return
        if not again:
            raise DamagedFileError(fault, f"at {path}", AGAIN)
        time.sleep(0.02)  # whoever closed it just now may have changed it between the two looks
        head, size = _head(path)


def _head(path: Path) -> tuple[bytes, int]:
    """Give the first 100 bytes of a file, and how many there are."""
    try:
        with regular_file(path).open("rb") as file:
            return file.read(100), os.fstat(file.fileno()).st_size
    except OSError as error:
        what = f"the file cannot be read ({error.strerror or error})"
        raise BadInputError(what, f"at {path}", "check name and permissions") from error


def _length_fault(head: bytes, size: int) -> str:
    """Say whether a file without a log is longer or shorter than its first page tells."""
    page = int.from_bytes(head[16:18], "big")
    whole = (65536 if page == 1 else page) * int.from_bytes(head[28:32], "big")
    if size < whole:
        return f"it is cut off: it has {size} of {whole} bytes"
    # The number of pages counts where it was written with the last change of the first page.
    if size > whole and head[24:28] == head[92:96]:
        return f"it is torn: it has {size} bytes, and says that it has {whole}"
    return ""
