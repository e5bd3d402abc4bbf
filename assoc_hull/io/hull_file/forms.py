"""The definitions of a hull and its generated curves to the rows of a hull file, and back.

Examples
--------
>>> from assoc_hull.io.hull_file.forms import definition_of, definition_row
>>> from assoc_hull.model.definition_part import FormDefinition
>>> angle = FormDefinition("flare", "waterline_angle", "course", {"AP_y": 3.0}, nodes=("AP",))
>>> definition_of(definition_row(0, True, angle)) == angle
True
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from assoc_hull.geometry.curves import IntArray
from assoc_hull.model.definition_part import FormDefinition, GeneratedCurve
from assoc_hull.model.state import HullState

__all__ = [
    "definition_of",
    "definition_row",
    "definition_rows",
    "generated_of",
    "generated_row",
    "generated_rows",
    "read_definitions",
    "read_generated",
]

Row = tuple[Any, ...]

_MARK = np.dtype([("piece", "<i4"), ("t", "<f8")])


def definition_rows(state: HullState, numbers: IntArray) -> Iterator[Row]:
    """Give rows of the table of definitions as rows of the file."""
    table = state.formed
    for i in numbers.tolist():
        yield definition_row(i, bool(table.alive.data[i]), table.definition.data[i])


def generated_rows(state: HullState, numbers: IntArray) -> Iterator[Row]:
    """Give rows of the table of generated curves as rows of the file."""
    table = state.produced
    for i in numbers.tolist():
        yield generated_row(i, bool(table.alive.data[i]), table.curve.data[i])


def definition_row(number: int, alive: bool, form: FormDefinition) -> Row:
    """Give a definition as a row; its values in the order of their names, nan for None."""
    values = [np.nan if value is None else value for value in form.values.values()]
    return (
        number, int(alive), form.use, form.name, form.kind, form.rule, json.dumps(form.nodes),
        np.array(values, "<f8").tobytes(),
    )  # fmt: skip


def generated_row(number: int, alive: bool, made: GeneratedCurve) -> Row:
    """Give a generated curve as a row."""
    marks = np.array(list(made.marks), _MARK)
    return (
        number, int(alive), made.key, made.curve, made.what, made.layout,
        np.array(made.rows, "<i4").tobytes(), marks.tobytes(), int(made.attached),
    )  # fmt: skip


def definition_of(row: Row) -> FormDefinition:
    """Take a definition from a row.

    Raises
    ------
    ValueError, TypeError, AssocHullError
        The row holds none.
    """
    _, _, use, name, kind, rule, nodes, numbers = row
    bare = FormDefinition(name, use, kind, {}, rule, json.loads(nodes))
    values = np.frombuffer(numbers, "<f8").tolist()
    known = [None if np.isnan(value) else value for value in values]
    return bare.having(dict(zip(bare.names, known, strict=True)))


def generated_of(row: Row) -> GeneratedCurve:
    """Take a generated curve from a row.

    Raises
    ------
    ValueError, TypeError
        The row holds none.
    """
    _, _, key, curve, what, layout, points, marks, attached = row
    return GeneratedCurve(
        key, curve, what, layout, tuple(np.frombuffer(points, "<i4").tolist()),
        tuple(np.frombuffer(marks, _MARK).tolist()), bool(attached),
    )  # fmt: skip


def read_definitions(state: HullState, rows: Sequence[Row]) -> None:
    """Put rows of the file into the empty table of definitions.

    Raises
    ------
    ValueError, TypeError, AssocHullError
        A row holds none.
    """
    table = state.formed
    table.resize(len(rows))
    table.definition.data[:] = [definition_of(row) for row in rows]
    _revive(table, rows)


def read_generated(state: HullState, rows: Sequence[Row]) -> None:
    """Put rows of the file into the empty table of generated curves.

    Raises
    ------
    ValueError, TypeError
        A row holds none.
    """
    table = state.produced
    table.resize(len(rows))
    table.curve.data[:] = [generated_of(row) for row in rows]
    _revive(table, rows)


def _revive(table: Any, rows: Sequence[Row]) -> None:
    table.alive.store[: len(rows)] = [bool(row[1]) for row in rows]
    table.alive.writes += 1
