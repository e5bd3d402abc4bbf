"""Saving and opening a hull: as a hull file that keeps every edit, or as canonical text.

The name says which: ``.hull.json`` is text, ``.hull`` a hull file. Opening looks at the content,
not at the name. A file is written beside its target and takes its place whole or not at all; from
then on each edit is in the hull file before it counts as committed.

Examples
--------
>>> from pathlib import Path
>>> from tempfile import TemporaryDirectory
>>> from assoc_hull.edit.document import Document
>>> from assoc_hull.shipped.wigley import wigley
>>> from assoc_hull.io.hull_file.saving import open_hull_file
>>> from assoc_hull.io.hull_file.saving import save_hull_file
>>> with TemporaryDirectory() as folder:
...     document = Document(wigley())
...     save_hull_file(document, Path(folder) / "ship.hull")
...     again = open_hull_file(Path(folder) / "ship.hull")
...     print(again.state.particulars.name)
...     again.keeper.close()
...     document.keeper.close()
Wigley

>>> from pathlib import Path
>>> from tempfile import TemporaryDirectory
>>> from assoc_hull.edit.document import Document
>>> from assoc_hull.shipped.wigley import wigley
>>> from assoc_hull.io.hull_file.saving import save_hull_file
>>> with TemporaryDirectory() as folder:
...     document = Document(wigley())
...     save_hull_file(document, Path(folder) / "ship.hull")
...     document.keeper.close()
...     print([each.name for each in Path(folder).iterdir()])
['ship.hull']
"""

from __future__ import annotations

import contextlib
import getpass
import os
import sqlite3
import tempfile
from importlib import metadata
from pathlib import Path

import attrs

from assoc_hull.arguments import file_path
from assoc_hull.edit.document import Document
from assoc_hull.edit.explain.compare_states import walk_states
from assoc_hull.edit.past_states import PackedWrites
from assoc_hull.edit.step import Rerun
from assoc_hull.errors import AssocHullError, BadInputError, HullFileError
from assoc_hull.graph.journal import Journal
from assoc_hull.io.hull_file.check import require_sound_tables
from assoc_hull.io.hull_file.database import (
    connect_database,
    connect_new,
    create_tables,
    damage_errors,
    database_errors,
    require_schema,
)
from assoc_hull.io.hull_file.steps import write_labels, write_step
from assoc_hull.io.hull_file.storage import HullFile
from assoc_hull.io.hull_file.tables import read_state, write_state
from assoc_hull.io.hull_json import read_hull_json, write_hull_json
from assoc_hull.io.open_databases import is_hull_file, is_open_here, log_file
from assoc_hull.io.write_file import take_place
from assoc_hull.model.change import TableChange, change_of
from assoc_hull.model.definition.fingerprint import root_of
from assoc_hull.model.definition.restore import Difference
from assoc_hull.model.packed_change import with_strays

__all__ = [
    "FILE_ENDING",
    "TEXT_ENDING",
    "Saved",
    "close_hull_file",
    "detach_hull",
    "file_damages",
    "holds_hull",
    "is_behind_file",
    "open_document",
    "open_hull_file",
    "path_of",
    "refresh_hull",
    "save_hull",
    "save_hull_file",
    "user_name",
]

# --------------------------------------------------------------------------------------
# Opening a hull file.


def user_name() -> str:
    """Give the name of who is at work, as the system knows it; empty if it does not."""
    try:
        return getpass.getuser()
    except (OSError, KeyError, ImportError):
        return ""


def open_hull_file(path: Path, wait: float = 0.0, *, damaged: bool = False) -> Document:
    """Open a hull file with its history; splines are lofted, and the fingerprint must agree.

    `wait` (s) is how long to wait while another process writes, now and at each edit. `damaged`
    opens it also if its tables contradict one another, to be looked at by a check.

    Raises
    ------
    BadInputError, DamagedFileError, FileBusyError, HullFileError
        See `assoc_hull.io.hull_file.database.connect_database`.
    """
    path = Path(os.path.realpath(path))
    database = connect_database(path, wait)
    try:
        with database_errors(path, wait), damage_errors(path, "it is damaged"):
            database.execute("BEGIN")
            require_schema(database, path)
            state = read_state(database)
            file = HullFile(path, database, state, wait)
            document = Document(state, keeper=file, author=user_name())
            head, tip = file.follow(document)
            document.stand(*file.catch_up(document, head, tip, damaged=damaged))
            document.start = str(file.recorded(0))
            file.require_print(document.head)
            if not damaged:
                require_sound_tables(state)
                file.require_newest()
            database.execute("ROLLBACK")
            file.fold_left()
    except BaseException:
        database.close()
        raise
    return document


# --------------------------------------------------------------------------------------
# Writing a hull that lives in memory, or a copy of its file, as a hull file.


def save_hull_file(
    document: Document, path: Path, wait: float = 0.0, *, replace: bool = False
) -> None:
    """Write a hull with its history, and keep its steps in that file from then on.

    `wait` (s) is how long to wait for another writer, from then on; `replace` allows to write over
    a file that is there. The folder must exist, and no edit may be open.

    Raises
    ------
    BadInputError
        An edit is open; there is a file of this name, and it is not to be replaced.
    HullFileError
        The file cannot be written; nothing is left behind, and the hull is kept where it was.
    """
    document.require_ended("save")
    document.lock.refuse_others("in save")
    target = Path(os.path.realpath(path))
    _require_free(target, replace=replace)
    changes = _write_whole(document, target)
    database = connect_database(target, wait)
    file, before = HullFile(target, database, document.state, wait), document.keeper
    document.keeper = file
    file.take_over(document, changes)
    if isinstance(before, HullFile):
        before.close()


def _require_free(target: Path, *, replace: bool) -> None:
    """Refuse to write over anything."""
    if os.path.isdir(target):
        raise BadInputError("this is a folder", f"at {target}", "give the name of a file")
    if not os.path.isdir(target.parent):
        what = f"there is no folder {target.parent}"
        raise BadInputError(what, f"for {target.name}", "make the folder first")
    if os.path.lexists(target) and not replace:
        what, remedy = "there is a file of this name", "choose another name, or ask to replace it"
        raise BadInputError(what, f"at {target}", remedy)
    if is_open_here(target):
        remedy = "close it first, or give another name"
        raise BadInputError("this hull file is open in this process", f"at {target}", remedy)
    log = log_file(target)
    if replace and os.path.isfile(target) and os.path.lexists(log):
        _tidy(target)
    if os.path.lexists(log):
        what = "the log of another hull file lies beside it, with edits that may be nowhere else"
        remedy = "close the program that uses it, or move it to where its hull file is"
        raise BadInputError(what, f"at {log}", remedy)


def _tidy(target: Path) -> None:
    """Carry the log of a killed process into the file that is to be replaced, by opening it.

    If that cannot be done, or another process has the file open, the log stays.
    """
    with contextlib.suppress(AssocHullError):
        connect_database(target, 0.0).close()


def _write_whole(document: Document, target: Path) -> dict[int, TableChange]:
    """Write beside the target, bring it to the disk, then take the target's place."""
    try:
        handle, name = tempfile.mkstemp(
            prefix=f".{target.name}.", suffix=".part", dir=target.parent
        )
    except OSError as error:
        what = f"the file cannot be written ({error.strerror or error})"
        raise HullFileError(str(target), what, "give another place") from error
    os.close(handle)
    try:
        with database_errors(target):
            changes = _fill(document, name)
        take_place(name, target)
    except OSError as error:
        if isinstance(error, HullFileError):
            raise
        what = f"the file cannot be written ({error.strerror or error})"
        raise HullFileError(str(target), what, "give another place") from error
    finally:
        for left in (name, f"{name}-journal", f"{name}-wal", f"{name}-shm"):
            with contextlib.suppress(OSError):
                os.unlink(left)
    return changes


def _fill(document: Document, name: str) -> dict[int, TableChange]:
    """Fill an empty file: with a copy of the file that keeps the hull, or from memory."""
    database = connect_new(name)
    try:
        if isinstance(document.keeper, HullFile):
            document.keeper.copy_to(database)
            return {}
        create_tables(database)
        database.execute("BEGIN")
        changes = _write_all(database, document)
        database.execute("COMMIT")
        database.execute("PRAGMA journal_mode = WAL")
    finally:
        database.close()
    return changes


_RECENT = 16
"""So many of the last steps stay in memory; older ones are read where they are asked."""


def _write_all(database: sqlite3.Connection, document: Document) -> dict[int, TableChange]:
    """Write every step, then the hull as it is now; give the changes of the last steps."""
    state, changes = document.state, dict[int, TableChange]()
    with walk_states(document) as walk:
        if not document.start:
            walk.go(0)
            document.start = root_of(state)
        for number, step in sorted(document.steps.items()):
            journal = step.journal
            # A step that never was in a file holds its journal; its change is what it did there.
            if isinstance(journal, Journal | PackedWrites):
                walk.go(number)
                step.fingerprint = step.fingerprint or root_of(state)
                if isinstance(journal, Journal):
                    change = change_of(state, journal)
                else:
                    change = with_strays(state, journal.change)
                if number > len(document.steps) - _RECENT:
                    changes[number] = change
                journal = Rerun(state, change)
            assert isinstance(journal, Rerun), "a step holds its journal or its change"
            write_step(database, step, journal.change)
    write_state(database, state, _version(), document.start)
    write_labels(database, list(document.labels.values()))
    database.execute(
        "UPDATE hull SET fingerprint = ?, head = ?, tip = ?, base = ?",
        (root_of(state), document.head, document.tip, document.head),
    )
    return changes


def _version() -> str:
    try:
        return metadata.version("assoc-hull")
    except metadata.PackageNotFoundError:
        return "unknown"


# --------------------------------------------------------------------------------------
# Hull file or text.

FILE_ENDING, TEXT_ENDING = ".hull", ".hull.json"


@attrs.frozen
class Saved:
    """What came of saving.

    Attributes
    ----------
    path : Path
        The file that holds the hull.
    written : bool
        Whether anything was written.
    """

    path: Path
    written: bool

    def __str__(self) -> str:
        if self.written:
            return f"written: {self.path}"
        return f"nothing to write: every edit is in {self.path} already"


def path_of(document: Document) -> Path | None:
    """Give the hull file of a document, None if it lives in memory."""
    return document.keeper.path if isinstance(document.keeper, HullFile) else None


def save_hull(
    document: Document, path: str | os.PathLike[str] | None = None, *, replace: bool = False
) -> Saved:
    """Write a hull; see `assoc_hull.hull.Hull.save`."""
    there = path_of(document)
    if path is None:
        if there is None:
            remedy = "give the name of a file, for instance ship.hull"
            raise BadInputError("this hull lives in memory", "in save", remedy)
        return _in_place(document, there)
    document.require_ended("save")
    document.lock.refuse_others("in save")
    name = file_path(path, "in save")
    if name.endswith(TEXT_ENDING):
        write_hull_json(document.state.published(), path)
        return Saved(Path(path), written=True)
    if there is not None and there == Path(os.path.realpath(path)):
        return _in_place(document, there)
    if not name.endswith(FILE_ENDING):
        remedy = f"end the name in {FILE_ENDING} or {TEXT_ENDING}; other forms are exported"
        raise BadInputError("the form is unknown", f"at {name}", remedy)
    wait = document.keeper.wait if isinstance(document.keeper, HullFile) else 0.0
    save_hull_file(document, Path(path), wait, replace=replace)
    document.author = document.author or user_name()
    return Saved(Path(path), written=True)


def _in_place(document: Document, there: Path) -> Saved:
    """Say that every edit is in the hull file, if that still is where it was."""
    if isinstance(document.keeper, HullFile):
        document.keeper.place.require_file()
    return Saved(there, written=False)


def open_document(
    path: str | os.PathLike[str], wait: float = 0.0, *, damaged: bool = False
) -> Document:
    """Open a hull file, or read the canonical text; see `assoc_hull.open`."""
    if not (isinstance(path, str) and path.lstrip()[:1] == "{"):
        file = Path(os.path.realpath(path))
        if is_hull_file(file) or not (_is_text(file) or file.name.endswith(".json")):
            return open_hull_file(file, wait, damaged=damaged)
    return Document(read_hull_json(path), author=user_name())


def holds_hull(path: Path) -> bool:
    """Tell whether a file begins as a hull file or as the canonical text does."""
    return is_hull_file(path) or _is_text(path)


def _is_text(path: Path) -> bool:
    """Tell whether a file begins as the canonical text does."""
    if not path.is_file():
        return False
    with contextlib.suppress(OSError), path.open("rb") as file:
        return file.read(200).lstrip(b"\xef\xbb\xbf \t\r\n")[:1] == b"{"
    return False


def refresh_hull(document: Document) -> None:
    """Bring a document to the state in its hull file.

    Raises
    ------
    BadInputError
        It lives in memory.
    """
    if not isinstance(document.keeper, HullFile):
        remedy = "save it as a hull file first"
        raise BadInputError("this hull lives in memory", "in refresh", remedy)
    document.require_ended("refresh")
    with document.held("refresh", keep=False):
        document.keeper.refresh(document)


def is_behind_file(document: Document) -> bool:
    """Tell whether another process has committed to the hull file since; False in memory."""
    return isinstance(document.keeper, HullFile) and document.keeper.is_behind()


def detach_hull(document: Document) -> None:
    """Let a hull live in memory, with all its history; the hull file stays as it is.

    Raises
    ------
    BadInputError, HullBusyError
        An edit is open, here or in another thread.
    """
    document.require_ended("detach")
    document.lock.refuse_others("in detach")
    document.keeper = None


def file_damages(document: Document) -> list[Difference]:
    """Give what in the hull file, if there is one, is not as it was written."""
    keeper = document.keeper
    found = keeper.damages() if isinstance(keeper, HullFile) else []
    return [Difference(each, "hull file", float("inf")) for each in found]


def close_hull_file(document: Document) -> None:
    """Let go of the hull file, if there is one.

    Raises
    ------
    BadInputError, HullBusyError
        An edit is open, here or in another thread.
    """
    document.require_ended("close")
    document.lock.refuse_others("in close")
    if isinstance(document.keeper, HullFile):
        document.keeper.close()
