"""Committed steps to the rows of a hull file, and back.

Examples
--------
>>> from assoc_hull.edit.report import EditReport
>>> from assoc_hull.io.hull_file.steps import report_from, report_text
>>> report_from(report_text(EditReport("fair", relofted=("WL 1",)))).relofted
('WL 1',)
"""

from __future__ import annotations

import hashlib
import json
import sqlite3
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import attrs
import numpy as np

from assoc_hull.edit.recording import Script
from assoc_hull.edit.report import EditReport, Movement
from assoc_hull.edit.step import Rerun, Step, StepBody
from assoc_hull.edit.step_storage import Label
from assoc_hull.graph.node import Readers
from assoc_hull.io.hull_file.change import pack_change, unpack_change
from assoc_hull.io.hull_file.packed_arrays import pack, unpack
from assoc_hull.model.change import Change
from assoc_hull.model.state import HullState

__all__ = [
    "body_of",
    "digest",
    "read_labels",
    "report_from",
    "report_text",
    "steps_of",
    "write_labels",
    "write_step",
]


def write_step(database: sqlite3.Connection, step: Step, change: Change) -> None:
    """Write a step.

    Parameters
    ----------
    database : sqlite3.Connection
        The file, inside a transaction.
    step : Step
        The step, with the fingerprint of the hull after it.
    change : Change
        What it changed.
    """
    report = step.report
    trace = pack(
        {"reader": step.cause.reader, "source": step.cause.source, "changed": step.changed,
         "moved": step.moved, "seeds": step.seeds}
    )  # fmt: skip
    row = (
        step.number, step.parent, step.name, report.author, report.time, int(step.structural),
        step.fingerprint, script_text(step.script), report_text(report), trace, pack_change(change),
    )  # fmt: skip
    database.execute(
        "INSERT INTO steps VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
        (*row[:7], digest(row), *row[7:]),
    )


def digest(row: tuple[Any, ...]) -> str:
    """Give the SHA-256 of all that a row of steps holds, its own digest left out."""
    found = hashlib.sha256()
    for each in row:
        data = each if isinstance(each, bytes) else json.dumps(each).encode()
        found.update(f"{len(data)}:".encode() + data)
    return found.hexdigest()


def script_text(script: Script) -> str:
    """Give what an edit was asked for as JSON."""
    return json.dumps(attrs.asdict(script), separators=(",", ":"))


def script_from(text: str) -> Script:
    """Give what an edit was asked for from JSON.

    Raises
    ------
    ValueError, KeyError, TypeError
        It is no script.
    """
    said = json.loads(text)
    return Script(tuple(dict(each) for each in said["edits"]), said["policy"], said["gaps"])


def report_text(report: EditReport) -> str:
    """Give a report as JSON; lengths in m, times in s."""
    said = attrs.asdict(report, filter=lambda field, _: field.name not in ("fairness", "counted"))
    return json.dumps({**said, "inflections": report.inflections}, separators=(",", ":"))


def report_from(text: str) -> EditReport:
    """Give a report from JSON.

    Raises
    ------
    ValueError, KeyError, TypeError
        It is no report.
    """
    said = json.loads(text)
    counted = tuple((key, int(count)) for key, count in said.pop("inflections"))
    largest = said.pop("largest")
    if largest is not None:
        largest = Movement(largest["point"], largest["distance"], tuple(largest["place"]))
    changes = tuple(tuple(each) for each in said.pop("definitions", ()))
    plain: dict[str, Any] = {
        name: tuple(x) if isinstance(x, list) else x for name, x in said.items()
    }
    return EditReport(**plain, largest=largest, counted=counted, definitions=changes)


def steps_of(
    database: sqlite3.Connection,
    after: int,
    load: Callable[[int], StepBody],
    tell: Callable[[int], EditReport],
) -> list[Step]:
    """Give the steps beyond a number, without their bodies.

    Parameters
    ----------
    database : sqlite3.Connection
        The file.
    after : int
        Number of the last step that is known.
    load, tell : callable
        Take the number of a step, and give its body and its report.
    """
    rows = database.execute(
        "SELECT number, parent, name, structural, script, fingerprint FROM steps WHERE number > ? "
        "ORDER BY number", (after,),
    )  # fmt: skip
    return [
        Step(
            name, bool(structural), number, parent, script_from(script), fingerprint,
            partial(load, number), partial(tell, number),
        )
        for number, parent, name, structural, script, fingerprint in rows
    ]  # fmt: skip


def body_of(row: tuple[Any, ...], state: HullState) -> StepBody:
    """Give the body of a step from its row.

    Parameters
    ----------
    row : tuple
        ``SELECT *`` of the table.
    state : HullState
        The tables that its change runs over.

    Raises
    ------
    ValueError, KeyError, TypeError
        The row is not as it was written.
    """
    if digest((*row[:7], *row[8:])) != row[7]:
        raise ValueError("its digest is another one")
    trace = unpack(row[10])[0]
    reader, source, changed, seeds = (
        trace[name].astype(np.int64) for name in ("reader", "source", "changed", "seeds")
    )
    return StepBody(
        Rerun(state, unpack_change(row[11])), Readers(reader, source), changed,
        trace["moved"].astype(np.float64), seeds, report_from(row[9]),
    )  # fmt: skip


def write_labels(database: sqlite3.Connection, labels: Sequence[Label]) -> None:
    """Write names of states."""
    rows = [(each.name, each.step, int(each.branch), each.author, each.time) for each in labels]
    database.executemany("INSERT INTO labels VALUES (?, ?, ?, ?, ?)", rows)


def read_labels(database: sqlite3.Connection) -> list[Label]:
    """Read all names of states, in the order of the steps."""
    rows = database.execute(
        "SELECT name, step, branch, author, time FROM labels ORDER BY step, name"
    )
    return [
        Label(name, step, bool(branch), author, time) for name, step, branch, author, time in rows
    ]
