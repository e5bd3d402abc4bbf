"""Which hull files are open in this process, and whether a file is a hull file at all.

A process that closes any handle on a file gives up all its locks on that file, those of SQLite
too. So whoever writes or looks at files asks here first, before opening one. The database itself
is in `io.hull_file.database`.

Examples
--------
>>> from pathlib import Path
>>> from assoc_hull.io.open_databases import is_open_here
>>> is_open_here(Path(__file__))
False
"""

from __future__ import annotations

import contextlib
import os
import sqlite3
import weakref
from pathlib import Path

from assoc_hull.errors import HullFileError

__all__ = [
    "MAGIC",
    "FileIdentity",
    "HullFileConnection",
    "is_hull_file",
    "is_open_here",
    "log_file",
]

MAGIC = b"SQLite format 3\x00"


def is_hull_file(path: Path) -> bool:
    """Tell whether a file begins as a database does."""
    if is_open_here(path):
        return True
    if not path.is_file():  # opening a pipe waits for ever
        return False
    with contextlib.suppress(OSError), path.open("rb") as file:
        return file.read(len(MAGIC)) == MAGIC
    return False


_OPEN: weakref.WeakSet[HullFileConnection] = weakref.WeakSet()


class HullFileConnection(sqlite3.Connection):
    """An open database that its process knows of."""

    identity: tuple[int, int] = (0, 0)

    def know(self, path: Path) -> None:
        """Let the process know which file this is."""
        self.identity = _identity(path)
        _OPEN.add(self)

    def close(self) -> None:
        """Close the database."""
        super().close()
        _OPEN.discard(self)


def is_open_here(path: Path) -> bool:
    """Tell whether this process has a hull file open."""
    found = _identity(path)
    return found != (0, 0) and any(each.identity == found for each in list(_OPEN))


def log_file(path: Path) -> Path:
    """Give the file beside a hull file that its last commits are in."""
    return path.with_name(f"{path.name}-wal")


def _identity(path: Path) -> tuple[int, int]:
    """Tell a file from another one of the same name; zeros if there is none."""
    try:
        found = os.stat(path)
    except OSError:
        return (0, 0)
    return found.st_dev, found.st_ino


class FileIdentity:
    """A hull file and its log, as they were when the database in them was opened.

    Parameters
    ----------
    path : Path
        The hull file, of which the database has read something already.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self._file, self._log = _identity(path), _identity(log_file(path))
        self._process = os.getpid()

    def require_file(self) -> None:
        """Refuse another file of the same name, and another process than opened it.

        Raises
        ------
        HullFileError
            The file was removed or replaced; this process was forked from the one that opened it.
        """
        if os.getpid() != self._process:
            what = "it was opened before this process was forked from another"
            raise HullFileError(str(self.path), what, "open it again here")
        if _identity(self.path) != self._file:
            remedy = "save the hull under another name, so that nothing is lost"
            raise HullFileError(str(self.path), "it was removed or replaced", remedy)

    def require_log(self) -> None:
        """Refuse another log; what was written to the one that has gone would be lost.

        Raises
        ------
        HullFileError
            The log was removed or replaced.
        """
        if _identity(log_file(self.path)) != self._log:
            what = f"its log {log_file(self.path).name} was removed while it was open"
            remedy = "open it again, and make the last edit anew; those before it are in the file"
            raise HullFileError(str(self.path), what, remedy)
