"""A log beside a hull file that belongs to another hull is refused before it is opened.

SQLite takes whatever log has the name of the file for its own: it would write the pages of the
other hull over this one. A hull file keeps the fingerprint with which its history began, and every
commit writes the page with that row; so the newest such page in the log tells whose log it is.

Examples
--------
>>> from pathlib import Path
>>> from assoc_hull.io.hull_file.foreign_log import require_own_log
>>> require_own_log(Path("no.hull"))  # no log, nothing to refuse
"""

from __future__ import annotations

import contextlib
import os
import shutil
import sqlite3
import tempfile
import time
from pathlib import Path
from urllib.parse import quote

from assoc_hull.errors import DamagedFileError
from assoc_hull.io.open_databases import is_open_here, log_file

__all__ = ["require_own_log"]

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
