"""From a definition to the tables of a hull, every reference checked; nothing is computed.

Row numbers follow the canonical order. Meetings are put back with their senses and
crossings, their places not yet known (nan).

Examples
--------
>>> from assoc_hull.model.definition.definition import definition
>>> from assoc_hull.model.state import HullState, Particulars
>>> from assoc_hull.model.definition.tables import make_tables
>>> make_tables(definition(HullState(Particulars("S", 9.0, 2.0, 1.0, 1.0)))).particulars.name
'S'
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from assoc_hull.geometry.curves import EndKind
from assoc_hull.graph.journal import Journal
from assoc_hull.model.definition.definition import words
from assoc_hull.model.definition.filling import Keys, fill, wrong
from assoc_hull.model.definition.filling_features import put_features
from assoc_hull.model.definition.filling_forms import computed_points, put_forms
from assoc_hull.model.definition.filling_points import put_defining, put_points
from assoc_hull.model.definition.meetings import put_meetings
from assoc_hull.model.kinds import BoundaryKind, Sort, State
from assoc_hull.model.state import Association, Ends, HullState, Particulars
from assoc_hull.tolerance import Tolerances

__all__ = ["make_tables"]

Record = Mapping[str, Any]

_NIL = [0.0, 0.0, 0.0]
_UNIT = 1e-9
"""A unit normal is this near to 1 long."""
_STATES = words(State)


def make_tables(definition: Record) -> HullState:
    """Make the tables of a hull from a definition of the right form.

    Raises
    ------
    BadInputError
        If a name refers to nothing, an object stands twice, or two parts contradict.
    """
    particulars: dict[str, Any] = {
        name: value if isinstance(value, str) else float(value)
        for name, value in definition["particulars"].items()
    }
    tolerances = {name: float(value) for name, value in definition["tolerances"].items()}
    state = HullState(Particulars(**particulars), Tolerances(**tolerances))
    parts = [_sorted(definition[name]) for name in ("lines", "curves", "points")]
    groups = sorted(definition["groups"], key=lambda each: str(each["name"]))
    gone = definition["retired"]
    keys = Keys(
        _number("group", [group["name"] for group in groups], ()),
        _number("line", [line["key"] for line in parts[0]], gone["lines"]),
        _number("curve", [curve["key"] for curve in parts[1]], gone["curves"]),
        _number("point", [point["key"] for point in parts[2]], gone["points"]),
    )
    journal = Journal()
    _put_groups(state, journal, groups, definition, keys)
    _put_lines(state, journal, parts[0], keys)
    _put_curves(state, journal, parts[1], keys)
    put_points(state, journal, parts[2], keys, computed_points(definition))
    put_defining(state, journal, parts[1], keys)
    _check_births(state)
    put_meetings(state, journal, parts[1], keys.find)
    put_features(state, journal, definition.get("features", ()), keys)
    put_forms(state, journal, definition, keys)
    _retire(state, journal, gone)
    return state


def _sorted(records: Iterable[Record]) -> list[Record]:
    return sorted(records, key=lambda record: str(record["key"]))


def _number(kind: str, keys: Sequence[str], gone: Sequence[str]) -> dict[str, int]:
    found = {key: number for number, key in enumerate(keys)}
    for many in (keys, gone, (*found, *gone)):
        if len(set(many)) < len(many):
            twice = next(key for key in many if list(many).count(key) > 1)
            raise wrong(f"the {kind} {twice!r} stands there twice", "in the file")
    return found


def _put_groups(
    state: HullState, journal: Journal, groups: list[Record], definition: Record, keys: Keys
) -> None:
    names, families = [each["name"] for each in groups], [each["family"] for each in groups]
    fill(state.groups, journal, len(groups), name=names, family=families)
    links = [Association(**link) for link in definition["associations"]]
    for link in links:
        for name in (link.a, link.b):
            keys.find("groups", name, "an association")
    if len({frozenset((link.a, link.b)) for link in links}) < len(links):
        raise wrong("two groups are associated twice", "in the associations")
    links.sort(key=lambda each: (each.a, each.b))
    births = {(a, b): count for a, b, count in definition["births"]}
    if len(births) < len(definition["births"]):
        raise wrong("a pair of lines stands there twice", "in the births")
    journal.set(state.settings.associations, [0], [tuple(links)])
    journal.set(state.settings.births, [0], [births])


def _put_lines(state: HullState, journal: Journal, lines: list[Record], keys: Keys) -> None:
    names = [(line["group"], line["name"]) for line in lines]
    for line, name in zip(lines, names, strict=True):
        if ("normal" in line) != ("offset" in line):
            raise wrong("a plane needs both a normal and an offset", f"at the line {line['key']!r}")
        length = math.hypot(*line.get("normal", (1.0,)))
        if abs(length - 1.0) > _UNIT:
            raise wrong(f"the normal is {length:.6g} long, not 1", f"at the line {line['key']!r}")
        if names.count(name) > 1:
            raise wrong(f"two lines of {name[0]} have the name {name[1]!r}", "in the lines")
    boundary = words(BoundaryKind)
    fill(
        state.lines,
        journal,
        len(lines),
        key=[line["key"] for line in lines],
        name=[line["name"] for line in lines],
        note=[line.get("note", "") for line in lines],
        group=[keys.find("groups", line["group"], line["key"]) for line in lines],
        planar=["normal" in line for line in lines],
        normal=[line.get("normal", _NIL) for line in lines],
        offset=[line.get("offset", np.nan) for line in lines],
        boundary=[boundary.index(line["boundary"]) if "boundary" in line else -1 for line in lines],
    )


def _put_curves(state: HullState, journal: Journal, curves: list[Record], keys: Keys) -> None:
    owner = [keys.find("lines", curve["line"], curve["key"]) for curve in curves]
    fill(
        state.curves,
        journal,
        len(curves),
        key=[curve["key"] for curve in curves],
        line=owner,
        ends=[_ends(curve) for curve in curves],
        state=[_STATES.index(curve["kept"]["state"]) if "kept" in curve else 0 for curve in curves],
    )
    for line in range(len(keys.lines)):
        mine = tuple(number for number, each in enumerate(owner) if each == line)
        journal.set(state.lines.curves, [line], [mine])
    failed = np.flatnonzero(state.curves.state.data == State.FAILED)
    journal.set(state.settings.failed, [0], [tuple(failed.tolist())])


def _ends(curve: Record) -> Ends:
    kinds = words(EndKind)
    given = [curve.get(name, {"kind": kinds[0], "vector": _NIL}) for name in ("start", "finish")]
    first, last = (_vector(end["vector"]) for end in given)
    return Ends((kinds.index(given[0]["kind"]), kinds.index(given[1]["kind"])), (first, last))


def _vector(values: Sequence[float]) -> tuple[float, float, float]:
    x, y, z = values
    return float(x), float(y), float(z)


def _check_births(state: HullState) -> None:
    """No crossing may have a higher number than were ever born of its two lines."""
    table, keys = state.rows, state.lines.key.data
    for row in np.flatnonzero(table.sort.data == Sort.CROSSING).tolist():
        pair = tuple(keys[state.line_of(curve)] for curve in table.curve.data[row].tolist())
        if table.birth.data[row] > state.births.get(pair, 0):
            count = state.births.get(pair, 0)
            raise wrong(f"its lines bore {count} crossings only", f"at {table.key.data[row]!r}")


def _retire(state: HullState, journal: Journal, gone: Record) -> None:
    """Add dead rows that hold nothing but keys, so that these never come back."""
    for table, name in ((state.lines, "lines"), (state.curves, "curves"), (state.rows, "points")):
        rows = journal.grow(table, len(gone[name]))
        journal.set(table.key, rows.tolist(), sorted(gone[name]))
    if gone["points"]:
        journal.put(state.rows.sort, rows, int(Sort.PLACED))
