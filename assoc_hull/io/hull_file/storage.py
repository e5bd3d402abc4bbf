"""The hull file: one database that holds a hull with all that was ever committed to it.

`HullFile` is what a `Document` keeps its steps in. A step is one row: it is written in one
transaction of the database, and brought to the disk before the edit counts as committed; a process
that is killed leaves the file as the last commit did. Then the log is folded into the file
(`HullFile.fold`), so that a plain copy of the file has it all. The rows of the tables follow later,
many steps at once (`Behind`): at an undo, at closing, and when too many steps have come together.
Opening runs the steps that the tables lack.

Examples
--------
>>> from pathlib import Path
>>> from tempfile import TemporaryDirectory
>>> from assoc_hull.edit.document import Document
>>> from assoc_hull.edit.session import Edit
>>> from assoc_hull.shipped.wigley import wigley
>>> from assoc_hull.io.hull_file.saving import open_hull_file
>>> from assoc_hull.io.hull_file.saving import save_hull_file
>>> with TemporaryDirectory() as folder:
...     document = Document(wigley())
...     save_hull_file(document, Path(folder) / "ship.hull")
...     with Edit(document, "fuller") as edit:
...         edit.move("WL 2.5 x ST 7", y=2.95)
...     document.keeper.close()
...     again = open_hull_file(Path(folder) / "ship.hull")
...     print([step.name for step in again.history])
...     again.keeper.close()
['fuller']
"""

from __future__ import annotations

import contextlib
import itertools
import operator
import sqlite3
import threading
import time
import weakref
from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from assoc_hull.edit.checks.update_findings import plane_normals
from assoc_hull.edit.document import Document, Label
from assoc_hull.edit.step import EditReport, Fairness, Rerun, Step, StepBody
from assoc_hull.errors import (
    AssocHullError,
    DamagedFileError,
    FileBusyError,
    HullFileError,
    StaleHullError,
)
from assoc_hull.geometry.curves import IntArray
from assoc_hull.graph.derived import Gate
from assoc_hull.graph.journal import Journal, distinct
from assoc_hull.io.hull_file.check import require_sound_tables, require_whole_history
from assoc_hull.io.hull_file.database import (
    AGAIN,
    connect_database,
    damage_errors,
    database_errors,
    require_schema,
)
from assoc_hull.io.hull_file.steps import (
    body_of,
    newest_fault,
    read_labels,
    report_from,
    steps_of,
    write_labels,
    write_step,
)
from assoc_hull.io.hull_file.tables import (
    WRITTEN,
    put_rows,
    read_revisions,
    read_state,
    require_counts,
    write_births,
    write_settings,
)
from assoc_hull.io.open_databases import (
    FileIdentity,
    HullFileConnection,
    log_file,
    spared_log,
)
from assoc_hull.model.address import AddressBook
from assoc_hull.model.change import TableChange, change_of, with_signed_zeros
from assoc_hull.model.definition.fingerprint import HashTree, fingerprint, is_root
from assoc_hull.model.packed_change import with_strays
from assoc_hull.model.tables import HullState, copy_into, copy_state

__all__ = ["Behind", "HullFile", "LateInflections"]

_WRITE = "BEGIN IMMEDIATE"

_MOST_BEHIND = 32
"""So many steps the rows of the tables may lag behind; opening runs those."""

_TOO_MANY_BEHIND = 8 * _MOST_BEHIND
"""So many are never written; running the whole of a long history takes minutes."""

_CLOSING = 2.0
"""So long (s) the next act waits for another process that is just closing the file."""


def _moves_only(step: Step) -> bool:
    """Tell whether a step that is kept changes places and shapes alone."""
    change = step.journal.change if isinstance(step.journal, Rerun) else None
    return change is not None and change.keeps_structure and not change.objects


class Behind:
    """What steps changed in the tables that the rows of the file do not show yet."""

    def __init__(self) -> None:
        self.steps = 0
        self.here = False
        """Whether any of them was committed by this process."""
        self._parts: dict[str, list[IntArray]] = {table: [] for table in WRITTEN}
        self._pairs = set[tuple[str, str]]()
        self._settings = False

    def add(self, change: TableChange, rows: IntArray, curves: IntArray) -> None:
        """Note what a step changed, and the points and curves whose revisions it raised."""
        self.steps += 1
        for table, parts in self._parts.items():
            parts.append(change.touched(table))
        self._parts["rows"].append(rows)
        self._parts["curves"] += [curves, change.curves]
        self._pairs |= change.births.keys()
        self._settings |= any(name.startswith("settings.") for name in change.objects)

    def write(self, database: sqlite3.Connection, state: HullState, head: int) -> None:
        """Write all those rows as they are now, after step `head`."""
        for table, parts in self._parts.items():
            if written := [part for part in parts if len(part)]:
                numbers = distinct(np.concatenate(written))
                put_rows(database, state, table, numbers[numbers >= 0])
        if self._settings:
            write_settings(database, state)
        if self._pairs:
            births = state.births
            write_births(database, {pair: births.get(pair, 0) for pair in sorted(self._pairs)})
        database.execute("UPDATE hull SET base = ?", (head,))


class LateInflections:
    """Counts the inflections of a step in a hull file when asked, by running what led there.

    It holds the name of the file, not the hull: a report may be kept longer than that.

    Parameters
    ----------
    path : Path
        The file.
    number : int
        The step.
    digest : str
        That of its row, by which another file in the place of this one is told.
    """

    def __init__(self, path: Path, number: int, digest: str) -> None:
        self.path, self.number, self.digest = path, number, digest
        self._found: tuple[tuple[str, int], ...] | None = None

    def __repr__(self) -> str:
        return f"LateInflections(step {self.number} of {self.path.name})"

    def added(self) -> tuple[tuple[str, int], ...]:
        """Give the curves with more curvature sign changes than before, and how many.

        Raises
        ------
        BadInputError, DamagedFileError, HullFileError
            The file is gone, damaged, or another one.
        """
        if self._found is None:
            database = connect_database(self.path, 0.0)
            try:
                with (
                    database_errors(self.path),
                    damage_errors(self.path, f"step {self.number} cannot be read"),
                ):
                    database.execute("BEGIN")
                    require_schema(database, self.path)
                    self._found = self._counted(database).added()
                    database.execute("ROLLBACK")
            finally:
                database.close()
        return self._found

    def _counted(self, database: sqlite3.Connection) -> Fairness:
        """Give the splines before and after the step."""
        self._state = state = read_state(database)
        digest = database.execute(
            "SELECT digest FROM steps WHERE number = ?", (self.number,)
        ).fetchone()
        if digest != (self.digest,):
            what = "it was replaced by another hull file"
            raise HullFileError(str(self.path), what, "count from the hull before that is done")
        parents = dict(database.execute("SELECT number, parent FROM steps"))
        here, there = (
            _way(parents, number)
            for number in (database.execute("SELECT base FROM hull").fetchone()[0], self.number)
        )
        there.pop()  # the step itself is run last, also where the tables show it already
        for number in here[::-1]:
            if number not in there:
                self._body(database, number).journal.back()
        for number in there:
            if number not in here:
                self._body(database, number).journal.forth()
        known = {state.curves.key[i]: i for i in state.live("curves").tolist()}
        before = {
            curve: spline
            for curve in known.values()
            if (spline := state.curves.spline[curve]) is not None
        }
        body = self._body(database, self.number)
        body.journal.forth()
        known = {state.curves.key[i]: i for i in state.live("curves").tolist()}
        keys = tuple(key for key in body.report.relofted if key in known)
        curves = np.array([known[key] for key in keys], np.int64)
        after = {curve: state.spline(curve) for curve in curves.tolist()}
        return Fairness(before, after, plane_normals(state, curves), curves, keys)

    def _body(self, database: sqlite3.Connection, number: int) -> StepBody:
        row = database.execute("SELECT * FROM steps WHERE number = ?", (number,)).fetchone()
        return body_of(row or (), self._state)


def _close_all(opened: list[HullFileConnection]) -> None:
    """Close connections, the first one last: the last one to close tidies the log away."""
    while opened:
        opened.pop().close()


def _way(parents: Mapping[int, int], number: int) -> list[int]:
    """Give the numbers of the steps that lead to a step, oldest first."""
    found = list[int]()
    while number:
        found.append(number)
        before, number = number, operator.index(parents[number])
        if number >= before:
            raise ValueError(f"step {before} is made upon step {number}")
    return found[::-1]


class HullFile:
    """Keeps the steps of a document in a file.

    Parameters
    ----------
    path : Path
        The file, without links.
    database : HullFileConnection
        The open database.
    state : HullState
        The tables of the document, as the file holds them.
    wait : float, s
        How long to wait for another writer.
    """

    def __init__(
        self, path: Path, database: HullFileConnection, state: HullState, wait: float
    ) -> None:
        self.path, self.database, self.state, self.wait = path, database, state, wait
        self.serial = 0
        self._known = 0
        self.place = FileIdentity(path)
        self._known_tree: HashTree | None = None
        self._behind, self._follows = Behind(), False
        self._schema: list[tuple[object, ...]] = []
        self._agreed = False
        self._open = True
        self._unfolded = False
        self._thread = threading.get_ident()
        """The one that has begun the last transaction of the database."""
        self._opened, self._reads = [database], Gate()
        """The database, and a second connection where threads have read beside one that writes."""
        self._closing = weakref.finalize(self, _close_all, self._opened)

    def _one(self, sql: str, *values: object) -> Any:
        found = self.database.execute(sql, values).fetchone()
        if found is None:
            raise DamagedFileError("a row is missing", f"in {self.path}", AGAIN)
        return found

    def close(self) -> None:
        """Let go of the file; edits are refused from then on."""
        if self._open and self._behind.here:
            self._catch_up_rows()
        self._open = False
        self._reads.alone(self._let_go)

    def _let_go(self) -> None:
        if self.place.has_log:
            _close_all(self._opened)
        else:
            with spared_log(self.path):
                _close_all(self._opened)

    def _catch_up_rows(self) -> None:
        """Bring the rows of the tables up to date, if that can be done at once; else it is not."""
        with contextlib.suppress(AssocHullError, sqlite3.Error, OSError):
            try:
                self.place.require_file()
                self._roll_back()
                if self.place.has_log and self.place.hold():
                    self.database.execute("PRAGMA busy_timeout = 0")
                    self._begin(_WRITE)
                    self._refuse_stale()
                    self._settle(self._one("SELECT head FROM hull")[0])
                    self._keep()
            finally:
                self.end()

    def begin(self) -> None:
        """Take the right to write.

        Raises
        ------
        FileBusyError, StaleHullError, HullFileError
            Another process writes; it has written; the file may only be read, is closed, or
            has been replaced by another.
        """
        self._agreed = False
        try:
            self._enter(_WRITE)
            with database_errors(self.path):
                self.place.require_log()
                self._refuse_stale()
                self.place.note_log()
        except BaseException:
            self.end()
            raise

    def _require_open(self) -> None:
        if not self._open:
            raise HullFileError(str(self.path), "it is closed", "open it again")

    def _enter(self, how: str) -> None:
        """Begin a transaction of the database, if this still is the file that was opened."""
        self._require_open()
        self.place.require_file()
        with database_errors(self.path, self.wait):
            self._roll_back()  # one whose end was broken off
            self._hold()
            if not self.place.has_log and self.place.is_alone and not self._unfolded:
                self._reopen()
            if self._unfolded and how == _WRITE:
                # A full disk: the log would take further edits, and a plain copy lack them.
                self._unfolded = not self._folded()
            self._begin(how)

    def _begin(self, how: str) -> None:
        self._thread = threading.get_ident()  # before: see `_is_writing_here`
        self.database.execute(how)
        # The schema is looked at to the word once, and then whether it is the very same.
        query = "SELECT type, name, tbl_name, rootpage, sql FROM sqlite_master"
        found = itertools.zip_longest(self.database.execute(query), self._schema)
        if not self._schema or any(one != other for one, other in found):
            require_schema(self.database, self.path)
            self._schema = self.database.execute(query).fetchall()

    def _roll_back(self) -> None:
        try:
            if self.database.in_transaction:
                self.database.execute("ROLLBACK")
        finally:  # once more, should an interrupt come just there
            if self.database.in_transaction:
                self.database.execute("ROLLBACK")

    def _hold(self) -> None:
        """Have the locks of SQLite, even if a copy that was made in this process gave them up."""
        until = time.monotonic() + max(self.wait, _CLOSING)
        while not self.place.hold():
            if time.monotonic() > until:
                raise FileBusyError(str(self.path), self.wait)
            time.sleep(0.005)

    def _reopen(self) -> None:
        """Take up the log that another process made after it had cleared this one's away.

        It could, as a copy that was made in this process had given the locks up; all that was
        committed here is in the file, and whether somebody wrote since is looked at as ever.
        """
        self._reads.alone(self._connect_anew)
        self._hold()

    def _connect_anew(self) -> None:
        with spared_log(self.path):
            _close_all(self._opened)
        self.database = connect_database(self.path, self.wait)
        self._opened.append(self.database)
        self.place = FileIdentity(self.path)

    def _refuse_stale(self) -> None:
        if self._one("SELECT serial FROM hull")[0] != self.serial:
            newer = self.database.execute(
                "SELECT name FROM steps WHERE number > ? ORDER BY number", (self._known,)
            )
            raise StaleHullError(str(self.path), tuple(str(row[0]) for row in newer))

    def end(self) -> None:
        """Give the right to write back."""
        self._follows = False
        if not self._agreed:
            self._known_tree = None  # the tables are, or will be, what they were before
        if self._open:
            self._roll_back()
            if self._unfolded:
                self.fold()

    def fold(self) -> None:
        """Fold the log into the file, unless somebody reads what is older; it never fails.

        What is committed is so already. What could not be folded now is before the next edit.
        """
        with contextlib.suppress(sqlite3.Error):
            self._unfolded = not self._folded()

    def fold_left(self) -> None:
        """Fold in what a process that was killed or blocked left, in nobody's way."""
        with contextlib.suppress(sqlite3.Error, OSError):
            if log_file(self.path).stat().st_size:
                self.database.execute("PRAGMA wal_checkpoint(PASSIVE)").fetchone()

    def _folded(self) -> bool:
        """Fold the log into the file; tell whether all of it is there now.

        The log keeps its length, and the next commit begins it anew: cutting it off would cost the
        disk two further changes of its length at each commit.
        """
        if not self.place.has_log or not self.place.hold():
            return False
        try:
            # Passive: whoever reads is not waited for, but threads of this process that read a row.
            fold = "PRAGMA wal_checkpoint(PASSIVE)"
            told = self._reads.alone(lambda: self.database.execute(fold).fetchone())
        except sqlite3.OperationalError as error:
            # Somebody else is at it; a disk that is full, or fails, is told.
            if error.sqlite_errorname.startswith(("SQLITE_BUSY", "SQLITE_LOCKED")):
                return False
            raise
        busy, frames, folded = told
        return bool(not busy and frames == folded)

    def commit(self, step: Step, branch: Label | None) -> None:
        """Write a step and what it changed, and bring it to the disk."""
        journal = step.journal
        assert isinstance(journal, Journal), "a step that was just made holds its journal"
        known = step.change
        change = change_of(self.state, journal) if known is None else with_strays(self.state, known)
        with database_errors(self.path):
            self.place.require_own()
            self._behind.add(change, step.rows, step.curves)
            self._behind.here = True
            self._tree.note(change)
            step.fingerprint = self._tree.root()
            self._sign(step.fingerprint, step.number, step.number)
            write_step(self.database, step, change)
            self._label(branch)
            if self._behind.steps > _MOST_BEHIND:
                self._settle(step.number)
            self._keep()
        self.keep(step, change)

    def keep(self, step: Step, change: TableChange) -> None:
        """Let a step hold no more of its journal than its change, and that only for a while."""
        body = step.body
        self._lend(step)
        rerun = Rerun(self.state, change)
        step.replace(StepBody(rerun, body.cause, body.changed, body.moved, body.seeds, body.report))
        step.change = None

    def _lend(self, step: Step) -> None:
        """Let a step read from the file what it does not hold."""
        step.load = partial(self.load, step.number)
        step.tell = partial(self.tell, step.number)

    def move(self, head: int, tip: int, steps: Sequence[Step], branch: Label | None) -> None:
        """Write the rows that steps changed when they were run, and where the hull is now."""
        with (
            database_errors(self.path),
            damage_errors(self.path, "the history does not fit the hull"),
        ):
            self.place.require_own()
            for step in steps:
                journal = step.journal
                assert isinstance(journal, Rerun), "a step that is kept holds its change"
                self._behind.add(journal.change, step.rows, step.curves)
                if self._known_tree is not None:
                    self._known_tree.note(journal.change)
            # Revisions of what is undone are told by the rows alone, so these do not lag here.
            self._settle(head)
            said = str(self.recorded(head))
            if self._print(said) != said:
                raise ValueError(f"the hull after step {head} is not as it was then")
            self._sign(said, head, tip)
            # What leads somewhere does so still where places and shapes alone are others.
            if not all(_moves_only(step) for step in steps):
                require_sound_tables(self.state)
                require_counts(self.database, self.state)
            self._label(branch)
            self._keep()

    def label(self, label: Label) -> None:
        """Write a name."""
        with database_errors(self.path):
            self.place.require_own()
            self._label(label)
            self.database.execute("UPDATE hull SET serial = serial + 1")
            self._keep()

    def _keep(self) -> None:
        """Commit to the disk; nothing that may fail stands behind it, `end` folds the log."""
        self._unfolded = True
        self.database.execute("COMMIT")
        if self._follows:
            self._behind = Behind()

    def agree(self, steps: int) -> None:
        """Take note that what was kept last is in memory as well, where there are so many steps.

        Were this process interrupted before, the file would be ahead of it, and the next edit
        be told so.
        """
        self.serial += 1
        self._known = steps
        self._agreed = True

    def _label(self, label: Label | None) -> None:
        if label is not None:
            write_labels(self.database, [label])

    def _settle(self, head: int) -> None:
        """Write the rows that lag behind, as they are now, after step `head`."""
        self._behind.write(self.database, self.state, head)
        self._follows = True

    def _sign(self, found: str, head: int, tip: int) -> None:
        """Write the present fingerprint, and where in the history the hull is."""
        self.database.execute(
            "UPDATE hull SET fingerprint = ?, head = ?, tip = ?, serial = serial + 1",
            (found, head, tip),
        )

    def _print(self, like: str) -> str:
        """Take the fingerprint of the tables: the root of the tree, or what files up to 6 have.

        Those may hold that of curves whose zeros have signs, which is the same hull.
        """
        if is_root(like):
            return self._tree.root()
        found = fingerprint(self.state)
        return found if found == like else fingerprint(with_signed_zeros(self.state))

    @property
    def _tree(self) -> HashTree:
        """Takes the fingerprint, and knows what has not changed since."""
        if self._known_tree is None:
            self._known_tree = HashTree(self.state)
        return self._known_tree

    def recorded(self, head: int) -> object:
        """Give the fingerprint that was written for the state after a step."""
        if not head:
            return self._one("SELECT start FROM hull")[0]
        return self._one("SELECT fingerprint FROM steps WHERE number = ?", head)[0]

    def load(self, number: int) -> StepBody:
        """Read the body of a step.

        Raises
        ------
        DamagedFileError
            It is not as it was written.
        """
        row = self._read("SELECT * FROM steps WHERE number = ?", number)
        with damage_errors(self.path, f"step {number} cannot be read"):
            return body_of(row, self.state, LateInflections(self.path, number, row[7]))

    def tell(self, number: int) -> EditReport:
        """Read the report of a step; whether the rest of it is whole is not looked at.

        Raises
        ------
        DamagedFileError
            It cannot be read.
        """
        text, digest = self._read("SELECT report, digest FROM steps WHERE number = ?", number)
        with damage_errors(self.path, f"step {number} cannot be read"):
            return report_from(text, LateInflections(self.path, number, digest))

    def _read(self, sql: str, number: int) -> Any:
        """Read one row, in nobody's way; threads that do not write share a connection for it."""

        def row(database: sqlite3.Connection) -> Any:
            return database.execute(sql, (number,)).fetchone() or ()

        with database_errors(self.path, self.wait):
            found = None
            if not self._reads_as_writer():
                found = self._reads.alone(lambda: row(self._second()) if self._open else None)
        if found is None:
            with self._reader() as database:
                found = row(database)
        return found

    @contextlib.contextmanager
    def _reader(self) -> Iterator[sqlite3.Connection]:
        """Give a connection to read from for long; what was let go of is opened for it alone."""
        with database_errors(self.path, self.wait):
            if self._reads_as_writer():
                yield self.database
                return
            with contextlib.closing(connect_database(self.path, self.wait)) as database:
                yield database

    def _reads_as_writer(self) -> bool:
        """Tell whether this thread reads from the connection that writes: its own, or the last."""
        return self._open and (self._is_writing_here() or not self._is_there())

    def _is_writing_here(self) -> bool:
        """Tell whether the transaction of the database, if there is one, is of this thread."""
        # In this order: who begins one says so before.
        return self.database.in_transaction and self._thread == threading.get_ident()

    def _is_there(self) -> bool:
        """Tell whether what is opened by the name of the file is the same, and so is its log.

        If not, nothing can be written, and what was opened first is all that there is to read.
        """
        with contextlib.suppress(HullFileError):
            self.place.require_file()
            return self.place.has_log
        return False

    def _second(self) -> sqlite3.Connection:
        """Give the connection that threads share which read; only with the right to read."""
        if len(self._opened) == 1:
            database = connect_database(self.path, self.wait, beside=True)
            self._opened.append(database)
            if not self._is_there():  # it was taken away just now
                self._opened.pop().close()
        return self._opened[-1]

    def is_behind(self) -> bool:
        """Tell whether another process has committed since; nobody is waited for."""
        return self._open and bool(self._read("SELECT 1 FROM hull WHERE serial != ?", self.serial))

    def follow(self, document: Document) -> tuple[int, int]:
        """Tell a document of steps and names it does not know; give where the file stands.

        Returns
        -------
        int, int
            Numbers of the step that led to the state in the file, and of the last undone one.
        """
        database = self.database
        with database_errors(self.path, self.wait):
            head, tip, serial = map(operator.index, self._one("SELECT head, tip, serial FROM hull"))
            new = steps_of(database, len(document.steps), self.load, self.tell)
            labels = read_labels(database)
        require_whole_history(document, new, labels, (head, tip))
        document.steps |= {step.number: step for step in new}
        document.labels = {label.name: label for label in labels}
        self._known, self.serial = len(document.steps), serial
        return head, tip

    def catch_up(
        self, document: Document, head: int, tip: int, *, damaged: bool = False
    ) -> tuple[int, int]:
        """Run the steps that the rows of the tables lack; give where the hull stands then.

        That is `head` and `tip`; with `damaged` it may be before a step that cannot be run.
        """
        reached, state, missing = self._base(), self.state, self._missing(document, head)
        if len(missing) > _TOO_MANY_BEHIND and not damaged:
            raise ValueError(f"its tables lag behind by {len(missing)} steps")
        for step in missing:
            was = copy_state(state) if damaged else None
            try:
                step.journal.forth()
            except DamagedFileError:
                if was is None:
                    raise
                copy_into(state, was)
                head, tip = reached, reached
                break
            reached = step.number
        self._take_stock(document, head)
        return head, tip

    def _base(self) -> int:
        return operator.index(self._one("SELECT base FROM hull")[0])

    def _missing(self, document: Document, head: int) -> list[Step]:
        """Give the steps that lead from the rows of the tables to step `head`."""
        base, way = self._base(), document.path(head)
        numbers = [0, *(step.number for step in way)]
        if base not in numbers:
            raise ValueError(f"the tables are those after step {base}, which leads elsewhere")
        return way[numbers.index(base) :]

    def _take_stock(self, document: Document, head: int) -> None:
        """Take note of what the rows of the tables lack, and raise revisions to what they are."""
        self._behind = Behind()
        found = read_revisions(self.database)
        for step in self._missing(document, head):
            rows, curves, journal = step.rows, step.curves, step.journal
            assert isinstance(journal, Rerun), "a step that is kept holds its change"
            self._behind.add(journal.change, rows, curves)
            for known, numbers in zip(found, (rows, curves), strict=True):
                known |= {number: known.get(number, 0) + 1 for number in numbers.tolist()}
            step.release()
        document.keep_revisions(*found)

    def take_over(self, document: Document, changes: Mapping[int, TableChange]) -> None:
        """Keep the steps of a document that was just written; `changes` are those it held."""
        self.follow(document)
        for number, step in document.steps.items():
            if number in changes:
                self.keep(step, changes[number])
            else:
                self._lend(step)
                step.release()
        document.forget_past()

    def copy_to(self, database: sqlite3.Connection) -> None:
        """Copy the whole file into another database."""
        self._require_open()
        with database_errors(self.path, self.wait):
            self._begin("BEGIN")
            try:
                self._refuse_stale()
                self.database.backup(database)
                if self._behind.steps:
                    database.execute("BEGIN")
                    self._behind.write(database, self.state, self._one("SELECT head FROM hull")[0])
                    database.execute("COMMIT")
            finally:
                self.end()

    def refresh(self, document: Document) -> None:
        """Bring a document to the state in the file; if that fails, it is as it was."""
        self._known_tree = None
        known = self.serial, self._known, self._behind
        try:
            self._enter("BEGIN")
            self.place.require_log()
            with document.unharmed():
                head, tip = self.follow(document)
                document.follow(head, tip)
                self._take_stock(document, head)
                self.require_print(head)
        except BaseException:
            self.serial, self._known, self._behind = known
            raise
        finally:
            self.end()

    def require_print(self, head: int) -> None:
        """Refuse tables whose fingerprint is not the one in the file for the state after a step."""
        splines = self.state.curves.spline
        for curve in self.state.live("curves").tolist():
            if splines[curve] is None:  # a curve without a shape has no fingerprint
                what = f"the curve {AddressBook(self.state).curve_name(curve)!r} has no shape"
                raise DamagedFileError(what, f"at {self.path}", AGAIN)
        present, said = self._one("SELECT head, fingerprint FROM hull")
        said = str(said if head == present else self.recorded(head))
        found = self._print(said)
        if found != said:
            one, other = found[-64:][:12], said[-64:][:12]
            what = f"the content has the fingerprint {one}, the file says {other}"
            raise DamagedFileError(what, f"at {self.path}", AGAIN)

    def require_newest(self) -> None:
        """Refuse a history whose newest steps are not as they were written, or lead elsewhere.

        What a commit tears in a copy are the newest ones; older ones are looked at when they are
        run or told.
        """
        head, said = self._one("SELECT head, fingerprint FROM hull")
        if self.recorded(head) != said:
            raise ValueError(f"the hull is not as step {head} left it")
        fault = newest_fault(self.database)
        if fault:
            raise ValueError(fault)

    def damages(self) -> list[str]:
        """Look through the whole file for what is not as it was written; one line each."""
        with self._reader() as database:
            told = database.execute("PRAGMA integrity_check(20)").fetchall()
            numbers = database.execute("SELECT number FROM steps ORDER BY number").fetchall()
        found = [str(line) for (line,) in told if line != "ok"]
        for (number,) in numbers:
            try:
                self.load(number)
            except DamagedFileError as error:
                found.append(error.what)
        return found
