"""Reaching the database in a hull file, and saying in one line why it cannot be reached.

Examples
--------
>>> from pathlib import Path
>>> from assoc_hull.io.hull_file.connect import is_hull_file
>>> is_hull_file(Path(__file__))
False
"""

from __future__ import annotations

import contextlib
import os
import sqlite3
from collections.abc import Iterator
from pathlib import Path
from urllib.parse import quote

import numpy as np

from assoc_hull.errors import BadInputError, DamagedFileError, FileBusyError, HullFileError
from assoc_hull.io.hull_file.schema import APPLICATION, SCHEMA, migrate
from assoc_hull.io.open_databases import Connection, is_open_here, log_of

__all__ = ["as_written", "connect", "is_hull_file", "speaking_of", "writable"]

_MAGIC = b"SQLite format 3\x00"
_COPY = "take it from a copy, and look after the disk"


def is_hull_file(path: Path) -> bool:
    """Tell whether a file begins as a database does."""
    if is_open_here(path):
        return True
    with contextlib.suppress(OSError), path.open("rb") as file:
        return file.read(len(_MAGIC)) == _MAGIC
    return False


@contextlib.contextmanager
def speaking_of(path: Path, waited: float = 0.0) -> Iterator[None]:
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
def as_written(path: Path, fault: str) -> Iterator[None]:
    """Say that a file is damaged where it holds what was never written to one.

    Parameters
    ----------
    path : Path
        The file.
    fault : str
        What cannot be done with it then.

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


def writable(path: Path) -> bool:
    """Tell whether file and folder may be written: the database needs a log beside the file."""
    return _may(path, os.W_OK) and _may(path.parent, os.W_OK | os.X_OK)


def _may(path: Path, mode: int) -> bool:
    """Tell whether this process may use a file or folder so, as who it is at present."""
    return os.access(path, mode, effective_ids=os.access in os.supports_effective_ids)


def connect(path: Path, wait: float) -> Connection:
    """Open the database in a hull file, of this version of the schema or brought to it.

    Parameters
    ----------
    path : Path
        The file.
    wait : float, s
        How long to wait while another process writes.

    Raises
    ------
    BadInputError
        There is no such file, or it is no hull file, or one of a newer version.
    DamagedFileError, FileBusyError, HullFileError
        See `speaking_of`.
    """
    _look(path)
    with speaking_of(path, wait):
        database = sqlite3.connect(
            _address(path), uri=True, timeout=wait, isolation_level=None, check_same_thread=False,
            factory=Connection,
        )  # fmt: skip
    try:
        database.know(path)
        with speaking_of(path, wait):
            _set_up(database, path)
    except BaseException:
        database.close()
        raise
    return database


def _address(path: Path) -> str:
    """Give the file as the database wants it named, with how it may be used."""
    name = f"file:{quote(str(path.absolute()))}"
    if writable(path):
        return f"{name}?mode=rw"
    if log_of(path).exists() or _may(path.parent, os.W_OK | os.X_OK):
        return f"{name}?mode=ro"
    return f"{name}?mode=ro&immutable=1"  # nobody can write a log in that folder


def _set_up(database: sqlite3.Connection, path: Path) -> None:
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
        if not writable(path):
            what = f"it has version {version} of the hull file, and may only be read"
            raise BadInputError(what, f"at {path}", "copy it to where it can be brought up to date")
        migrate(database)


def _look(path: Path) -> None:
    """Look at a file before the database does, which would say less."""
    if is_open_here(path):
        return
    if path.is_dir():
        raise BadInputError("this is a folder", f"at {path}", "give the name of a hull file")
    try:
        with path.open("rb") as file:
            head = file.read(100)
        size = path.stat().st_size
    except OSError as error:
        what = f"the file cannot be read ({error.strerror or error})"
        raise BadInputError(what, f"at {path}", "check name and permissions") from error
    if len(head) < 100 or head[: len(_MAGIC)] != _MAGIC:
        what = f"this is no hull file ({'it is empty' if not head else 'it begins otherwise'})"
        raise BadInputError(what, f"at {path}", "give a hull file, made by save or assoc-hull")
    page = int.from_bytes(head[16:18], "big")
    whole = (65536 if page == 1 else page) * int.from_bytes(head[28:32], "big")
    if size < whole and not log_of(path).exists():
        what = f"it is cut off: it has {size} of {whole} bytes"
        raise DamagedFileError(what, f"at {path}", _COPY)
