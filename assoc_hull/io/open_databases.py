"""Which hull files are open in this process, and whether a file is a hull file at all.

A process that closes any handle on a file gives up all its locks on that file, those of SQLite
too. So whoever writes or looks at files asks here first, before opening one; and since a program
may copy its own hull file without asking, `FileIdentity.hold` takes the locks of SQLite anew before
anything rests on them. The database itself is in `io.hull_file.database`.

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
from collections.abc import Iterator
from pathlib import Path

from assoc_hull.errors import HullFileError

_POSIX = os.name == "posix"  # elsewhere closing a handle gives no lock up
if _POSIX:
    import fcntl

__all__ = [
    "MAGIC",
    "FileIdentity",
    "HullFileConnection",
    "is_hull_file",
    "is_open_here",
    "log_file",
    "spared_log",
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
        if not _connections(self.identity):
            for handle, _ in _HANDLES.pop(self.identity, {}).values():
                os.close(handle)


def _connections(identity: tuple[int, int]) -> int:
    """Count the connections of this process to a file."""
    return sum(each.identity == identity for each in list(_OPEN))


def is_open_here(path: Path) -> bool:
    """Tell whether this process has a hull file open."""
    found = _identity(path)
    return found != (0, 0) and _connections(found) > 0


def log_file(path: Path) -> Path:
    """Give the file beside a hull file that its last commits are in."""
    return path.with_name(f"{path.name}-wal")


@contextlib.contextmanager
def spared_log(path: Path) -> Iterator[None]:
    """Keep a log that another process made, while a database is closed whose own has gone.

    The last one to close a database deletes the log by its name, also if it never was its own.
    """
    log, spare = log_file(path), path.with_name(f"{path.name}-wal-spare")
    with contextlib.suppress(OSError):
        os.link(log, spare)
    try:
        yield
    finally:
        with contextlib.suppress(OSError):
            if log.exists():
                os.unlink(spare)
            else:
                os.rename(spare, log)


# --------------------------------------------------------------------------------------
# Locks, as SQLite lays them on POSIX systems: bytes of a file, owned by the process.

_PRESENT = (0x40000002, 510)
"""Of the file: somebody has it open. Without it the next one to close clears the log away."""

_LIVING, _WRITER = (128, 1), (120, 1)
"""Of the index of the log (``-shm``): it is in use; somebody writes."""

_HANDLES: dict[tuple[int, int], dict[str, tuple[int, tuple[int, int]]]] = {}
"""By hull file, and by name of the file that they are on: handles for locks, and what they lead to.

They stay open as long as a connection does: closing one is what gives locks up.
"""


def _handle(identity: tuple[int, int], path: Path) -> int | None:
    """Give the handle on a file by which its locks are held; None if it cannot be opened."""
    handles = _HANDLES.setdefault(identity, {})
    there = _identity(path)
    if path.name in handles and handles[path.name][1] != there:
        os.close(handles.pop(path.name)[0])
    if path.name not in handles and there != (0, 0):
        mode = os.O_RDWR if os.access(path, os.W_OK) else os.O_RDONLY
        with contextlib.suppress(OSError):
            handles[path.name] = os.open(path, mode | os.O_CLOEXEC), there
    return handles[path.name][0] if path.name in handles else None


def _lock(handle: int | None, place: tuple[int, int], how: int) -> bool:
    """Lock bytes of a file, which this process may have locked already; False if another has."""
    if handle is None:
        return True
    try:
        fcntl.lockf(handle, how | fcntl.LOCK_NB, place[1], place[0])
    except OSError:
        return False
    return True


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
        self._written = _stamp(path)

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

    @property
    def has_log(self) -> bool:
        """Whether the log still is the one that was there when the file was opened."""
        return _identity(log_file(self.path)) == self._log

    @property
    def is_alone(self) -> bool:
        """Whether this process has the file open once."""
        return _connections(self._file) == 1

    def hold(self, *, writing: bool = False) -> bool:
        """Take the locks of SQLite anew, that may have been given up; False if others have them.

        `writing`: this process has the right to write, as it believes.
        """
        if not _POSIX or self._log == (0, 0):  # read as it is, or not by a log
            return True
        file = _handle(self._file, self.path)
        index = _handle(self._file, self.path.with_name(f"{self.path.name}-shm"))
        return (
            _lock(file, _PRESENT, fcntl.LOCK_SH)
            and _lock(index, _LIVING, fcntl.LOCK_SH)
            and (not writing or _lock(index, _WRITER, fcntl.LOCK_EX))
        )

    def note_log(self) -> None:
        """Remember the log as it is now, with the right to write."""
        self._written = _stamp(self.path)

    def require_own(self) -> None:
        """Refuse to write where another process did since `note_log`, or may.

        Raises
        ------
        HullFileError
            It did: this process had lost its locks.
        """
        self.require_log()
        if not self.hold(writing=True) or _stamp(self.path) != self._written:
            what = "its files were opened and closed here during the edit, and another one wrote"
            remedy = "call refresh() and make the edit anew; copy a hull with hull.save(other)"
            raise HullFileError(str(self.path), what, remedy)


def _stamp(path: Path) -> tuple[int, int]:
    """Tell whether a log was written to: its length and when."""
    try:
        found = os.stat(log_file(path))
    except OSError:
        return (0, 0)
    return found.st_size, found.st_mtime_ns
