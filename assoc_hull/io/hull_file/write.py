"""Writing a hull that lives in memory, or a copy of a file, as a hull file.

Examples
--------
>>> from pathlib import Path
>>> from tempfile import TemporaryDirectory
>>> from assoc_hull.edit.document import Document
>>> from assoc_hull.shipped.wigley import wigley
>>> from assoc_hull.io.hull_file.write import save_hull_file
>>> with TemporaryDirectory() as folder:
...     document = Document(wigley())
...     save_hull_file(document, Path(folder) / "ship.hull")
...     document.keeper.close()
...     print([each.name for each in Path(folder).iterdir()])
['ship.hull']
"""

from __future__ import annotations

import contextlib
import os
import sqlite3
import tempfile
from importlib import metadata
from pathlib import Path

from assoc_hull.edit.document import Document
from assoc_hull.edit.explain.states import walking
from assoc_hull.edit.step import Rerun
from assoc_hull.errors import BadInputError, HullFileError
from assoc_hull.graph.journal import Journal
from assoc_hull.io.hull_file.connect import connect, speaking_of
from assoc_hull.io.hull_file.schema import create
from assoc_hull.io.hull_file.steps import write_labels, write_step
from assoc_hull.io.hull_file.storage import HullFile
from assoc_hull.io.hull_file.tables import write_state
from assoc_hull.io.open_databases import is_open_here, log_of
from assoc_hull.io.write_file import take_place
from assoc_hull.model.change import Change, change_of
from assoc_hull.model.definition.definition import fingerprint

__all__ = ["save_hull_file"]


def save_hull_file(
    document: Document, path: Path, wait: float = 0.0, *, replace: bool = False
) -> None:
    """Write a hull with its history, and keep its steps in that file from then on.

    Parameters
    ----------
    document : Document
        The hull; no edit may be open.
    path : Path
        The file; its folder must exist.
    wait : float, s
        How long to wait for another writer, from then on.
    replace : bool
        Write over a file that is there.

    Raises
    ------
    BadInputError
        An edit is open; there is a file of this name, and it is not to be replaced.
    HullFileError
        The file cannot be written; nothing is left behind, and the hull is kept where it was.
    """
    document.require_ended("save")
    target = Path(os.path.realpath(path))
    _require_free(target, replace=replace)
    changes = _write_whole(document, target)
    database = connect(target, wait)
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
    log = log_of(target)
    if os.path.lexists(log):
        what = "the log of another hull file lies beside it, with edits that may be nowhere else"
        remedy = "close the program that uses it, or move it to where its hull file is"
        raise BadInputError(what, f"at {log}", remedy)


def _write_whole(document: Document, target: Path) -> dict[int, Change]:
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
        with speaking_of(target):
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


def _fill(document: Document, name: str) -> dict[int, Change]:
    """Fill an empty file: with a copy of the file that keeps the hull, or from memory."""
    database = sqlite3.connect(name, isolation_level=None)
    try:
        database.execute("PRAGMA synchronous = FULL")
        if isinstance(document.keeper, HullFile):
            document.keeper.copy_to(database)
            return {}
        create(database)
        database.execute("BEGIN")
        changes = _write_all(database, document)
        database.execute("COMMIT")
        database.execute("PRAGMA journal_mode = WAL")
    finally:
        database.close()
    return changes


def _write_all(database: sqlite3.Connection, document: Document) -> dict[int, Change]:
    """Write every step, then the hull as it is now."""
    state, changes = document.state, dict[int, Change]()
    with walking(document) as walk:
        if not document.start:
            walk.go(0)
            document.start = fingerprint(state)
        for number, step in sorted(document.steps.items()):
            journal = step.journal
            if isinstance(journal, Journal):
                walk.go(number)
                changes[number] = change_of(state, journal)
                step.fingerprint = step.fingerprint or fingerprint(state)
                journal = Rerun(state, changes[number])
            assert isinstance(journal, Rerun), "a step holds its journal or its change"
            write_step(database, step, journal.change)
    write_state(database, state, _version(), document.start)
    write_labels(database, list(document.labels.values()))
    database.execute(
        "UPDATE hull SET fingerprint = ?, head = ?, tip = ?",
        (fingerprint(state), document.head, document.tip),
    )
    return changes


def _version() -> str:
    try:
        return metadata.version("assoc-hull")
    except metadata.PackageNotFoundError:
        return "unknown"
