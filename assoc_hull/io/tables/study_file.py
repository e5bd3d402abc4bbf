"""The rows of a study in one SQLite file, to which they are added durably, or in memory.

Rows land in transactions, each of which is on the disk before the next begins (write-ahead log,
``synchronous = FULL``): a kill or a loss of power takes none that has landed. The file says what
was asked for, and of which hull, so that the same call goes on where it stopped, and another call
is refused. Real numbers lie in blobs, IEEE 754, 8 bytes each, little end first, as SQLite knows
neither nan nor -0.0. While a study runs, others may read; nobody else may add rows.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import pickle
import sqlite3
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.errors import BadInputError, DamagedFileError, HullFileError, StudyBusyError
from assoc_hull.geometry.curves import freeze
from assoc_hull.model.definition.fingerprint import fingerprint
from assoc_hull.study.run import StudyRow, StudyRun
from assoc_hull.study.side_processes import versions

__all__ = ["StudyFile"]

_APPLICATION, _VERSION = 0x41485354, 1
"""``AHST`` in ASCII, and the version of the tables."""

_TABLES = """
CREATE TABLE study (
    id INTEGER PRIMARY KEY CHECK (id = 1), written_by TEXT NOT NULL, parent TEXT NOT NULL,
    design TEXT NOT NULL, units TEXT NOT NULL, count INTEGER NOT NULL, given BLOB NOT NULL,
    targets BLOB NOT NULL, digest TEXT NOT NULL
);
CREATE TABLE rows (
    number INTEGER PRIMARY KEY, numbers BLOB NOT NULL, trials INTEGER NOT NULL,
    anew INTEGER NOT NULL, failure TEXT NOT NULL, reason TEXT NOT NULL, digest TEXT NOT NULL
);
"""
_ADD = "INSERT OR IGNORE INTO rows VALUES (?, ?, ?, ?, ?, ?, ?)"

_PATIENCE = 0.25
"""s: a transaction takes some milliseconds of the disk."""

_MANY = 4096
"""Rows that are read at once."""

_NUMBERS = ("margin", "shift", "residual")
"""What a row has behind its values and outputs."""


@attrs.frozen(eq=False)
class StudyFile:
    """Rows of a study.

    Attributes
    ----------
    run : StudyRun
        What was asked for, and of which hull.
    path : Path or None
        The file, as it was named; None for rows in memory.
    """

    run: StudyRun
    path: Path | None
    _place: Path | None
    _database: sqlite3.Connection
    _lock: sqlite3.Connection | None

    @classmethod
    @contextlib.contextmanager
    def opened(cls, run: StudyRun, path: Path | None) -> Iterator[StudyFile]:
        """Open it to add rows; it can be read from when the block has ended.

        Raises
        ------
        StudyBusyError
            Another study is writing to it.
        BadInputError
            It is no file of a study, or of another one; what differs.
        DamagedFileError, HullFileError
            It does not hold what was written to it; it cannot be read or written.
        """
        place = None if path is None else path.absolute()
        with contextlib.ExitStack() as stack:
            lock = None if path is None else stack.enter_context(_locked(path))
            with _file_errors(path):
                database = _connect(place, write=True)
                if path is not None:
                    stack.callback(database.close)
                found = cls(run, path, place, database, lock)
                found._begin()
                if path is not None:
                    stack.callback(_fold, database)
            yield found

    @property
    def patience(self) -> float:
        """For how long rows may be kept back, s, before they land together."""
        return 0.0 if self.path is None else _PATIENCE

    @property
    def stay(self) -> str:
        """What becomes of its rows where a study fails, and what to do."""
        if self.path is None:
            return "give file=, so that the rows that have been made stay"
        return f"rows that were made are in {self.path}, and the same call goes on"

    def landed(self) -> NDArray[np.bool_]:
        """Tell for each row whether it is there, (n,)."""
        found = np.zeros(self.run.design.count, bool)
        with self._reading() as database:
            for number, *_ in self._sound(database.execute("SELECT * FROM rows")):
                found[number] = True
        return found

    def land(self, rows: Sequence[StudyRow]) -> None:
        """Take rows, all or none; one that is there already stays as it is."""
        with _file_errors(self.path), self._database as database:
            database.execute("BEGIN IMMEDIATE")
            database.executemany(_ADD, map(_packed, rows))

    # ----------------------------------------------------------------------------------
    # Reading.

    @contextlib.contextmanager
    def _reading(self) -> Iterator[sqlite3.Connection]:
        """Give a connection to read by."""
        with _file_errors(self.path):
            if self._place is None:
                yield self._database
                return
            if not self._place.exists():
                raise HullFileError(str(self.path), "the file is not there any more", "look for it")
            with contextlib.closing(_connect(self._place, write=False)) as database:
                yield database

    def __len__(self) -> int:
        with self._reading() as database:
            return int(database.execute("SELECT count(*) FROM rows").fetchone()[0])

    def failures(self) -> Counter[str]:
        """Count rows by the kind of their failure; those without one too."""
        with self._reading() as database:
            return Counter(
                dict(database.execute("SELECT failure, count(*) FROM rows GROUP BY failure"))
            )

    def rows(self, *, failed: bool = False) -> tuple[StudyRow, ...]:
        """Give all rows by their numbers, or those without a hull."""
        which = "WHERE failure <> ''" if failed else ""
        with self._reading() as database:
            found = database.execute(f"SELECT * FROM rows {which} ORDER BY number")
            return tuple(map(self._row, self._sound(found)))

    def row(self, number: int) -> StudyRow | None:
        """Give a row; None if it has not landed."""
        with self._reading() as database:
            found = database.execute("SELECT * FROM rows WHERE number = ?", (number,))
            return next(map(self._row, self._sound(found)), None)

    def _sound(self, rows: Iterable[tuple[Any, ...]]) -> Iterator[tuple[Any, ...]]:
        """Give rows as they were written; refuse one that is not."""
        for each in rows:
            if _digest_of(each[:-1]) != each[-1]:
                what = f"row {each[0]} is not what was written"
                raise DamagedFileError(what, f"in {self.path}", _AGAIN)
            yield each[:-1]

    def _row(self, found: tuple[Any, ...]) -> StudyRow:
        number, packed, trials, anew, failure, reason = found
        numbers, design = np.frombuffer(packed, "<f8"), self.run.design
        ends = np.cumsum([len(design.names), len(design.outputs)])
        values, outputs, rest = np.split(numbers, ends)
        margin, shift, residual = rest.tolist()
        return StudyRow(
            number, values, outputs, margin, shift, residual, trials, failure, reason, bool(anew)
        )

    def columns(self) -> dict[str, NDArray[Any]]:
        """Give all rows as frozen arrays (n,) by name; see `Study.table`."""
        design = self.run.design
        names = (*design.names, *design.outputs, *_NUMBERS)
        with self._reading() as database:
            database.execute("BEGIN")  # a study may be adding rows
            count = database.execute("SELECT count(*) FROM rows").fetchone()[0]
            numbers = np.empty((len(names), count))
            whole = np.empty((3, count), np.int64)
            words = np.empty((2, count), object)
            cursor = database.execute("SELECT * FROM rows ORDER BY number")
            place = 0
            while part := list(self._sound(cursor.fetchmany(_MANY))):
                here = slice(place, place := place + len(part))
                number, packed, trials, anew, failure, reason = zip(*part, strict=True)
                whole[:, here], words[:, here] = (number, trials, anew), (failure, reason)
                flat = np.frombuffer(b"".join(packed), "<f8")
                numbers[:, here] = flat.reshape(len(part), len(names)).T
            database.execute("ROLLBACK")
        told = dict(zip(names, numbers, strict=True))
        asked = {name: design.targets[whole[0], i] for i, name in enumerate(design.aims)}
        found: dict[str, NDArray[Any]] = {"number": whole[0]}
        found |= {name: told[name] for name in design.names}
        found |= {f"asked {name}": column for name, column in asked.items()}
        found |= {name: told[name] for name in (*design.outputs, *_NUMBERS)}
        found |= {"trials": whole[1], "anew": whole[2].astype(bool)}
        found |= {"failure": words[0], "reason": words[1]}
        freeze(*found.values())
        return found

    # ----------------------------------------------------------------------------------
    # What was asked for.

    def _begin(self) -> None:
        """Write what is asked for into a new file, or see that an old one was asked the same."""
        asked, database = _asked(self.run), self._database
        old = database.execute("SELECT count(*) FROM sqlite_master").fetchone()[0]
        if old:
            self._require_study()
            asked["written_by"] = self._require_same(asked)
        if self.path is not None:
            database.execute("PRAGMA journal_mode = WAL")
            database.execute("PRAGMA synchronous = FULL")
        with database:
            database.execute("BEGIN IMMEDIATE")
            if not old:
                for table in filter(str.strip, _TABLES.split(";")):
                    database.execute(table)
                database.execute(f"PRAGMA application_id = {_APPLICATION}")
                database.execute(f"PRAGMA user_version = {_VERSION}")
            row = (1, *asked.values())
            marks = ", ".join("?" * (len(row) + 1))
            database.execute(f"REPLACE INTO study VALUES ({marks})", (*row, _digest_of(row)))

    def _require_study(self) -> None:
        """Refuse a database of another kind, or of a later version."""
        kind, version = (
            self._database.execute(f"PRAGMA {each}").fetchone()[0]
            for each in ("application_id", "user_version")
        )
        if kind != _APPLICATION:
            raise BadInputError("it is no file of a study", f"at {self.path}", "name another file")
        if version != _VERSION:
            what = f"it is of version {version}, and this program knows {_VERSION}"
            raise BadInputError(what, f"at {self.path}", "take the program that wrote it")

    def _require_same(self, asked: Mapping[str, Any]) -> object:
        """Refuse another hull, another design, and another program while rows are missing.

        Gives the program whose rows are there.
        """
        cursor = self._database.execute("SELECT * FROM study")
        found = cursor.fetchone()
        if found is None or _digest_of(found[:-1]) != found[-1]:
            raise DamagedFileError("it does not say what was asked", f"in {self.path}", _AGAIN)
        was = dict(zip((each[0] for each in cursor.description), found, strict=True))
        fault = _difference(was, asked)
        if fault:
            remedy = "ask as it was asked there, or name another file"
            raise BadInputError(fault, f"in {self.path}", remedy)
        missing = asked["count"] - self._database.execute("SELECT count(*) FROM rows").fetchone()[0]
        if missing and was["written_by"] != asked["written_by"]:
            theirs, ours = (
                " ".join(map(" ".join, json.loads(each["written_by"]).items()))
                for each in (was, asked)
            )
            what = f"{missing} rows are missing, the others are of {theirs}, and this is {ours}"
            remedy = "go on with the program that wrote it, or name another file"
            raise BadInputError(what, f"in {self.path}", remedy)
        return was["written_by"]


_AGAIN = "name another file, or take this one from a copy"


def _packed(row: StudyRow) -> tuple[object, ...]:
    """Give a row as the file has it."""
    rest = [getattr(row, name) for name in _NUMBERS]
    numbers = np.concatenate([row.values, row.outputs, rest]).astype("<f8").tobytes()
    found = row.number, numbers, row.trials, int(row.anew), row.failure, row.reason
    return *found, _digest_of(found)


def _digest_of(row: tuple[Any, ...]) -> str:
    """Give a word for all that a row of a table holds, its own digest left out."""
    found = hashlib.sha256()
    for each in row:
        data = each if isinstance(each, bytes) else repr(each).encode("utf-8", "surrogatepass")
        found.update(f"{len(data)}:".encode() + data)
    return found.hexdigest()[:16]


# --------------------------------------------------------------------------------------
# The file.


def _connect(path: Path | None, *, write: bool) -> sqlite3.Connection:
    """Open the database; a new one is empty."""
    place = ":memory:" if path is None else f"{path.as_uri()}?mode=rw{'c' * write}"
    return sqlite3.connect(place, uri=True, isolation_level=None, check_same_thread=False)


def _fold(database: sqlite3.Connection) -> None:
    """Make a file whole in itself: copies need no log beside it."""
    with contextlib.suppress(sqlite3.Error):  # somebody reads: the last one to close folds it in
        database.execute("PRAGMA journal_mode = DELETE")


@contextlib.contextmanager
def _locked(path: Path) -> Iterator[sqlite3.Connection]:
    """Keep others from adding rows; the end of the process gives the lock up, whatever ends it.

    The lock is that of SQLite on an empty file beside the rows, as the lock on these themselves
    would be given up with each transaction.
    """
    beside = path.absolute().with_name(f"{path.name}-writer")
    with _file_errors(path):
        while True:
            before = _identity(beside)
            with contextlib.closing(
                sqlite3.connect(beside, isolation_level=None, timeout=0.0, check_same_thread=False)
            ) as lock:
                lock.execute("PRAGMA journal_mode = MEMORY")  # nothing is written
                lock.execute("BEGIN EXCLUSIVE")
                if before != _identity(beside):  # the one before has taken it away meanwhile
                    continue
                try:
                    yield lock
                finally:
                    with contextlib.suppress(OSError):
                        beside.unlink()
                return


def _identity(path: Path) -> tuple[int, int]:
    """Tell a file from another one of the same name; make it if it is not there."""
    try:
        path.touch()
        found = path.stat()
    except OSError as error:
        why = error.strerror or str(error)
        remedy = "check the folder, its name and its permissions"
        raise HullFileError(str(path), f"it cannot be written ({why})", remedy) from error
    return found.st_dev, found.st_ino


@contextlib.contextmanager
def _file_errors(path: Path | None) -> Iterator[None]:
    """Turn what the database says into errors of this package."""
    try:
        yield
    except UnicodeDecodeError as error:  # of what sqlite3 says, or of the name of a column
        raise DamagedFileError("its tables are damaged", f"at {path}", _AGAIN) from error
    except sqlite3.Error as error:
        name = getattr(error, "sqlite_errorname", "") or ""
        why, place = " ".join(str(error).split()), str(path)
        if name.startswith(("SQLITE_BUSY", "SQLITE_LOCKED")):
            raise StudyBusyError(place, 0.0) from error
        if name.startswith("SQLITE_NOTADB"):
            what = "it is no file of a study"
            raise BadInputError(what, f"at {path}", "name another file") from error
        if name.startswith("SQLITE_CORRUPT"):
            raise DamagedFileError(f"it is damaged ({why})", f"at {path}", _AGAIN) from error
        what = (
            "the disk is full" if name.startswith("SQLITE_FULL") else f"it cannot be used ({why})"
        )
        remedy = "see to its folder and the disk; rows in it stay, and the same call goes on"
        raise HullFileError(place, what, remedy) from error


# --------------------------------------------------------------------------------------
# What was asked for, as the file has it.


def _asked(run: StudyRun) -> dict[str, Any]:
    """Give what a study is asked for, by the columns of the table."""
    design = run.design
    told = {
        "set": list(design.given), "free": list(design.free), "reach": list(design.aims),
        "outputs": list(design.outputs), "bounds": design.bounds.tolist(),
        "layers": [[each.name, _digest(each)] for each in design.layers],
        "layout": attrs.asdict(design.layout), "drawn": design.drawn,
    }  # fmt: skip
    return {
        "written_by": json.dumps(versions()),
        "parent": fingerprint(run.ground.maps.state),
        "design": json.dumps(told),
        "units": json.dumps(run.units),
        "count": design.count,
        "given": design.values.astype("<f8").tobytes(),
        "targets": design.targets.astype("<f8").tobytes(),
    }


_PARTS = {
    "set": "parameters that are set", "free": "parameters that are free",
    "reach": "targets", "outputs": "outputs", "bounds": "bounds", "layers": "layers",
    "layout": "layout",
}  # fmt: skip


def _difference(was: Mapping[str, Any], asked: Mapping[str, Any]) -> str:
    """Say what differs in what was asked for; empty if it is the same, or more of the same."""
    if was["parent"] != asked["parent"]:
        theirs, ours = was["parent"][:12], asked["parent"][:12]
        return f"the study there is of another hull ({theirs}..., this is {ours}...)"
    old, new = json.loads(was["design"]), json.loads(asked["design"])
    for part, words in _PARTS.items():
        if old[part] != new[part]:
            return f"the {words} are others there: {_both(old[part], new[part])}"
    if was["count"] > asked["count"]:
        return f"{was['count']} rows were asked for there, and {asked['count']} here"
    for part, names in (("given", new["set"]), ("targets", new["reach"])):
        theirs, ours = (
            np.frombuffer(each[part], "<f8").reshape(-1, len(names))[: was["count"]]
            if names else np.empty((was["count"], 0))
            for each in (was, asked)
        )  # fmt: skip
        rows, columns = np.nonzero(theirs != ours)
        if len(rows):
            i, k = int(rows[0]), int(columns[0])
            there, here = float(theirs[i, k]), float(ours[i, k])
            return f"{names[k]} of row {i} is {there!r} there, and {here!r} here"
    return ""


def _both(old: object, new: object) -> str:
    """Show two things that differ, where they do."""
    if isinstance(old, Mapping) and isinstance(new, Mapping):
        name = next(each for each in new if old.get(each) != new[each])
        return f"{name} {old.get(name)}, not {new[name]}"
    words = [json.dumps(each)[:120] for each in (old, new)]
    return f"{words[0]}, not {words[1]}"


def _digest(layer: object) -> str:
    """Give a word for all that a layer is made of."""
    return hashlib.sha256("\n".join(_spelt(layer)).encode()).hexdigest()[:16]


def _spelt(value: Any) -> Iterable[str]:
    """Spell a value out, part by part; numbers to the last bit."""
    if attrs.has(type(value)):
        yield type(value).__qualname__
        for field in attrs.fields(type(value)):
            yield from _spelt(getattr(value, field.name))
    elif isinstance(value, np.ndarray):
        yield f"{value.dtype} {value.shape} {value.tobytes().hex()}"
    elif isinstance(value, Mapping):
        for key in value:
            yield from _spelt(key)
            yield from _spelt(value[key])
    elif isinstance(value, list | tuple):
        yield f"{len(value)}"
        for each in value:
            yield from _spelt(each)
    elif isinstance(value, float):
        yield value.hex()
    elif value is None or isinstance(value, str | int):
        yield repr(value)
    else:
        yield hashlib.sha256(pickle.dumps(value)).hexdigest()
