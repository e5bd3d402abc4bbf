"""What a hull file from a stranger may ask of this process: sizes, depths, queries, a schema.

A file is data and runs nothing. The schema must be the one that this package writes, to the word:
a trigger, a view, a generated column or a check would run with every query. Bounds follow from the
file where they can: what an honest file holds takes up room in it.
"""

from __future__ import annotations

import contextlib
import json
import os
import re
import sqlite3
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

from assoc_hull.io.open_databases import HullFileConnection, log_file

__all__ = [
    "MOST_BYTES",
    "MOST_TEXT",
    "GuardedConnection",
    "parse_json",
    "read_numbered",
    "read_rows",
    "schema_fault",
    "schema_of",
]

MOST_BYTES = 1 << 26
"""No value is longer, read or written."""

MOST_TEXT = 1 << 24
"""No JSON is longer: it is all parsed at once."""

_MOST_BRACKETS = 1 << 20
"""Lists and objects in one JSON; each takes a hundred bytes of memory, and two in the file."""

_EACH, _LEAST, _PER_BYTE = 20_000, 2_000_000, 20
"""A query may take `_LEAST` steps of the database and `_PER_BYTE` for each byte of the file.

The dearest honest one, ``integrity_check``, takes about 2 for each byte. Pages that lead to one
another again and again take any number. Looked at after `_EACH` steps.
"""

_LIMITS = {
    sqlite3.SQLITE_LIMIT_LENGTH: MOST_BYTES,
    sqlite3.SQLITE_LIMIT_SQL_LENGTH: 20_000,
    sqlite3.SQLITE_LIMIT_COLUMN: 40,
    sqlite3.SQLITE_LIMIT_EXPR_DEPTH: 20,
    sqlite3.SQLITE_LIMIT_COMPOUND_SELECT: 3,
    sqlite3.SQLITE_LIMIT_VDBE_OP: 25_000,
    sqlite3.SQLITE_LIMIT_FUNCTION_ARG: 8,
    sqlite3.SQLITE_LIMIT_ATTACHED: 0,
    sqlite3.SQLITE_LIMIT_LIKE_PATTERN_LENGTH: 100,
    sqlite3.SQLITE_LIMIT_VARIABLE_NUMBER: 100,
    sqlite3.SQLITE_LIMIT_TRIGGER_DEPTH: 1,
    sqlite3.SQLITE_LIMIT_WORKER_THREADS: 0,
}

_SETTINGS = (
    "PRAGMA trusted_schema = OFF",
    "PRAGMA cell_size_check = ON",
    "PRAGMA mmap_size = 0",
    # The log is folded in by `HullFile`; SQLite would do so inside COMMIT, which might fail then
    # though the commit counts.
    "PRAGMA wal_autocheckpoint = 0",
)


class _Effort:
    """Counts the steps of a query; apart from the connection, which SQLite must not keep alive."""

    def __init__(self) -> None:
        self.path: Path | None = None
        self.spent = 0

    def tick(self) -> int:
        """Tell SQLite whether to give the query up."""
        self.spent += _EACH
        if self.path is None or self.spent <= _LEAST:
            return 0
        size = 0
        for each in (self.path, log_file(self.path)):
            with contextlib.suppress(OSError):
                size += os.stat(each).st_size
        return int(self.spent > _LEAST + _PER_BYTE * size)


class GuardedConnection(HullFileConnection):
    """A connection that spends on a file what its size allows."""

    def guard(self, path: Path | None) -> None:
        """Set what holds for every connection; `path` is None for a file that is being made."""
        for limit, most in _LIMITS.items():
            self.setlimit(limit, most)
        self._effort = _Effort()
        self._effort.path = path
        self.set_progress_handler(self._effort.tick, _EACH)
        for each in _SETTINGS:
            super().execute(each)

    def execute(self, sql: str, parameters: Any = (), /) -> sqlite3.Cursor:
        """Run a query, that may take as long as the size of the file allows."""
        self._effort.spent = 0
        return super().execute(sql, parameters)

    def executemany(self, sql: str, parameters: Iterable[Any], /) -> sqlite3.Cursor:
        """Write many rows, which are this process's own: as long as it takes."""
        path, self._effort.path = self._effort.path, None
        try:
            return super().executemany(sql, parameters)
        finally:
            self._effort.path = path


# --------------------------------------------------------------------------------------
# The schema.

Schema = Mapping[str, tuple[str, str, str]]
"""By name: type, table and text of what ``sqlite_master`` lists."""

_INDICES = ("associations", "labels")
"""Tables with a key of their own, for which SQLite makes an index."""


def schema_of(tables: str) -> Schema:
    """Give what ``sqlite_master`` lists where some tables were made, and nothing else."""
    found = {}
    for text in filter(None, map(str.strip, tables.split(";"))):
        name = text.split()[2]
        found[name] = ("table", name, _plain(text))
        if name in _INDICES:
            found[f"sqlite_autoindex_{name}_1"] = ("index", name, "")
    return found


def _plain(text: str) -> str:
    """Leave out white space that means nothing; no text in the known schemas holds any."""
    return re.sub(r"\s*([(),])\s*", r"\1", " ".join(text.split()))


def schema_fault(database: sqlite3.Connection, known: Schema) -> str:
    """Say what in the schema of a file is not as it should be; empty if nothing is."""
    found: dict[str, int] = {}
    cursor = database.execute("SELECT type, name, tbl_name, rootpage, sql FROM sqlite_master")
    for kind, name, table, page, text in cursor:
        # Only what is known is shown: all else may be any bytes.
        if not isinstance(name, str) or name not in known:
            what = kind if kind in ("table", "index", "trigger", "view") else "thing"
            return f"there is a {what} in it that no hull file has"
        if (kind, table, _plain(text or "")) != known[name] or name in found:
            return f"the {known[name][0]} {name} is not the one of a hull file"
        found[name] = page
    for name in known:
        if name not in found:
            return f"the {known[name][0]} {name} is missing"
    if len(set(found.values())) < len(found):
        return "two tables lie at one place"
    return ""


# --------------------------------------------------------------------------------------
# Rows and values.


def read_rows(database: sqlite3.Connection, query: str) -> Iterator[tuple[Any, ...]]:
    """Give the rows of a query, that together are no longer than the file.

    Raises
    ------
    ValueError
        They are: one stretch of the file is used again and again.
    """
    pages, page = (
        database.execute(f"PRAGMA {each}").fetchone()[0] for each in ("page_count", "page_size")
    )
    left = pages * page
    for row in database.execute(query):
        for each in row:
            if each.__class__ is bytes or each.__class__ is str:
                left -= len(each)
        if left < 0:
            raise ValueError("its rows are longer than the file")
        yield row


def read_numbered(database: sqlite3.Connection, name: str) -> list[tuple[Any, ...]]:
    """Give all rows of a table by number, which must leave no gap and stand once each.

    Raises
    ------
    ValueError
        They do not.
    """
    found: list[tuple[Any, ...]] = []
    for row in read_rows(database, f"SELECT * FROM {name} ORDER BY number"):
        if row[0] != len(found):
            raise ValueError(f"the table {name} lacks rows, or has one twice")
        found.append(row)
    return found


def parse_json(text: str | bytes, most: int = MOST_TEXT) -> Any:
    """Take JSON that is neither too long nor nested too deep.

    Raises
    ------
    ValueError, TypeError
        It is, or it is no JSON.
    """
    if len(text) > most:
        raise ValueError(f"a text of {len(text)} letters where at most {most} are")
    brackets = ("[", "{") if isinstance(text, str) else (b"[", b"{")
    if sum(map(text.count, brackets)) > _MOST_BRACKETS:  # type: ignore[arg-type]
        raise ValueError(f"a text of more than {_MOST_BRACKETS} lists")
    try:
        return json.loads(text)
    except RecursionError as error:
        raise ValueError("a text of lists within lists, too deep") from error
