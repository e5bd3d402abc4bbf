"""The tables of a hull to the rows of a hull file (SQLite), and back.

A row of the file has the number of the row in the table. Reals are little-endian float64 blobs, so
that they come back bit by bit; tuples of ids are JSON. Nothing is computed but splines, which are
lofted from their points; only a curve that has failed keeps the spline it last had.
"""

from __future__ import annotations

import json
import operator
import sqlite3
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import IntArray, SplineBatch, freeze
from assoc_hull.io.hull_file.guard import parse_json, read_numbered, read_rows
from assoc_hull.io.hull_file.packed_arrays import pack_arrays, unpack_arrays
from assoc_hull.model.attached_body import AttachedBody
from assoc_hull.model.attachments import attachments_in_order
from assoc_hull.model.births import Births, Pair
from assoc_hull.model.change import (
    CrossingPositions,
    crossing_positions,
    put_crossing_positions,
    shape_curves,
)
from assoc_hull.model.features import Feature
from assoc_hull.model.form_definition import FormDefinition, GeneratedCurve
from assoc_hull.model.kinds import State
from assoc_hull.model.tables import Association, Ends, HullState, Particulars, Ruling
from assoc_hull.model.tunnel_definition import TunnelDefinition
from assoc_hull.tolerance import Tolerances

__all__ = [
    "WRITTEN",
    "definition_of",
    "definition_row",
    "definition_rows",
    "feature_of",
    "feature_row",
    "feature_rows",
    "generated_of",
    "generated_row",
    "generated_rows",
    "put_rows",
    "read_definitions",
    "read_features",
    "read_generated",
    "read_revisions",
    "read_state",
    "require_counts",
    "write_births",
    "write_settings",
    "write_state",
]

# --------------------------------------------------------------------------------------
# Features.


def feature_rows(state: HullState, numbers: IntArray) -> Iterator[tuple[Any, ...]]:
    """Give rows of the table of features as rows of the file."""
    table = state.featured
    for i in numbers.tolist():
        yield feature_row(i, bool(table.alive[i]), table.feature[i])


def read_features(state: HullState, rows: Sequence[tuple[Any, ...]]) -> None:
    """Put rows of the file into the empty table of features.

    Raises
    ------
    ValueError, TypeError, AssocHullError
        A row holds none.
    """
    table = state.featured
    table.resize(len(rows))
    table.feature.data[:] = [feature_of(row) for row in rows]
    table.alive.store[: len(rows)] = [bool(row[1]) for row in rows]
    table.alive.writes += 1


def feature_row(number: int, alive: bool, feature: Feature) -> tuple[Any, ...]:
    """Give a feature as a row of the table."""
    return (
        number, int(alive), feature.key, feature.kind, feature.name, json.dumps(feature.lines),
        np.array(feature.points, "<i4").tobytes(), _optional_blob(feature.centre),
        _optional_blob(feature.radius), _optional_blob(feature.normal),
        _optional_blob(feature.offset), _optional_blob(feature.direction), feature.side,
        _optional_blob(feature.gap),
    )  # fmt: skip


def feature_of(row: tuple[Any, ...]) -> Feature:
    """Take a feature from a row of the table.

    Raises
    ------
    ValueError, TypeError, AssocHullError
        The row holds none.
    """
    _, _, key, kind, name, lines, points, centre, radius, normal, offset, direction, side, gap = row
    return Feature(
        key, kind, name, parse_json(lines), np.frombuffer(points, "<i4").tolist(), _vector(centre),
        _real(radius), _vector(normal), _real(offset), _vector(direction), side, _real(gap),
    )  # fmt: skip


def _optional_blob(value: object) -> bytes | None:
    return None if value is None else np.asarray(value, "<f8").tobytes()


def _vector(blob: bytes | None) -> Any:
    return None if blob is None else np.frombuffer(blob, "<f8").tolist()


def _real(blob: bytes | None) -> Any:
    return None if blob is None else np.frombuffer(blob, "<f8").item()


# --------------------------------------------------------------------------------------
# Definitions and generated curves.

Row = tuple[Any, ...]

_MARK = np.dtype([("piece", "<i4"), ("t", "<f8")])


def definition_rows(state: HullState, numbers: IntArray) -> Iterator[Row]:
    """Give rows of the table of definitions as rows of the file."""
    table = state.formed
    for i in numbers.tolist():
        yield definition_row(i, bool(table.alive[i]), table.definition[i])


def generated_rows(state: HullState, numbers: IntArray) -> Iterator[Row]:
    """Give rows of the table of generated curves as rows of the file."""
    table = state.produced
    for i in numbers.tolist():
        yield generated_row(i, bool(table.alive[i]), table.curve[i])


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
    bare = FormDefinition(name, use, kind, {}, rule, parse_json(nodes))
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
    _put_alive(table, rows)


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
    _put_alive(table, rows)


def _put_alive(table: Any, rows: Sequence[Row]) -> None:
    table.alive.store[: len(rows)] = [bool(row[1]) for row in rows]
    table.alive.writes += 1


# --------------------------------------------------------------------------------------
# The whole of a hull; groups, lines, curves and points.

_POINT = np.dtype([("row", "<i4"), ("side", "i1")])
_PLACE = np.dtype([("line", "<i4"), ("row", "<i4"), ("sign", "i1"), ("at", "<f8", (4,))])

_REALS = {
    "direction": "direction", "limit": "gap_limit", "gap": "gap", "base": "base",
    "anchor_from": "anchor_from", "anchor_weight": "anchor_weight", "faired": "faired",
}  # fmt: skip
"""Columns of points that may be left out, holding the fill value, and their names in the file."""

_PAIRS = ("curve", "kind", "reader", "anchor")
_NAMES = {
    "rows": "points", "featured": "features", "formed": "definitions", "produced": "generated",
}  # fmt: skip
"""Tables that the file calls otherwise."""

WRITTEN = ("groups", "lines", "curves", "rows", "featured", "formed", "produced")
"""Tables of which each row is a row of the file, too."""

_WHOLES = ("alive", "sort", "role", "override", "driver", "contact", "sign", "birth", "state")


def write_state(
    database: sqlite3.Connection, state: HullState, written_by: str, fingerprint: str
) -> None:
    """Write a hull into empty tables; the history begins there."""
    ship = state.particulars
    tolerances = json.dumps(attrs.asdict(state.tolerances))
    database.execute(
        "INSERT INTO hull VALUES (1, ?, ?, ?, ?, ?, ?, '[]', ?, ?, ?, 0, 0, 0, ?, 0)",
        (ship.name, ship.length, ship.breadth, ship.depth, ship.draught, tolerances, written_by,
         fingerprint, fingerprint, ship.deck),
    )  # fmt: skip
    write_settings(database, state)
    write_births(database, state.births)
    for table in WRITTEN:
        put_rows(database, state, table, np.arange(getattr(state, table).count))
    for table, known in (("rows", state.revision_row), ("curves", state.revision_curve)):
        count = getattr(state, table).count
        _write_gone(database, state, table, [i for i in sorted(known) if i >= count])


def write_settings(database: sqlite3.Connection, state: HullState) -> None:
    """Write particulars, failures, associations, rulings, tunnels and bodies."""
    ship = state.particulars
    database.execute(
        "UPDATE hull SET name = ?, length = ?, breadth = ?, depth = ?, draught = ?, deck = ?, "
        "failed = ?",
        (ship.name, ship.length, ship.breadth, ship.depth, ship.draught, ship.deck,
         json.dumps([int(curve) for curve in state.failed])),
    )  # fmt: skip
    database.execute("DELETE FROM associations")
    links = [(link.a, link.b, int(link.two_way)) for link in state.associations]
    database.executemany("INSERT INTO associations VALUES (?, ?, ?)", links)
    database.execute("DELETE FROM rulings")
    ruled = [
        (place, each.a, each.b, int(each.two_way), json.dumps([each.low, each.high]))
        for place, each in enumerate(state.rulings)
    ]
    database.executemany("INSERT INTO rulings VALUES (?, ?, ?, ?, ?)", ruled)
    database.execute("DELETE FROM tunnels")
    cylinders = [
        (place, each.name, *(_real_blob(value) for value in (each.x, each.z, each.radius)))
        for place, each in enumerate(state.tunnels)
    ]
    database.executemany("INSERT INTO tunnels VALUES (?, ?, ?, ?, ?)", cylinders)
    database.execute("DELETE FROM bodies")
    outlined = [
        (place, each.name, each.group, json.dumps(each.sections), json.dumps(each.corners),
         int(each.both), each.sign)
        for place, each in enumerate(state.bodies)
    ]  # fmt: skip
    database.executemany("INSERT INTO bodies VALUES (?, ?, ?, ?, ?, ?, ?)", outlined)


def write_births(database: sqlite3.Connection, counts: Mapping[Pair, int]) -> None:
    """Write how many crossings some pairs of lines have ever had; 0 takes the pair out."""
    rows = [(*pair, count) for pair, count in counts.items()]
    database.executemany("INSERT OR REPLACE INTO births VALUES (?, ?, ?)", rows)
    database.execute("DELETE FROM births WHERE count = 0")


def put_rows(database: sqlite3.Connection, state: HullState, table: str, numbers: IntArray) -> None:
    """Write rows of a table as they are now; those that it no longer has are taken out."""
    name, count = _NAMES.get(table, table), getattr(state, table).count
    live = numbers[numbers < count]
    if len(live):
        rows = list(_GIVE[table](state, live))
        marks = ", ".join("?" * len(rows[0]))
        database.executemany(f"INSERT OR REPLACE INTO {name} VALUES ({marks})", rows)
    if len(live) < len(numbers):
        database.execute(f"DELETE FROM {name} WHERE number >= ?", (count,))
        _write_gone(database, state, table, numbers[numbers >= count].tolist())


def _write_gone(
    database: sqlite3.Connection, state: HullState, table: str, numbers: Sequence[int]
) -> None:
    """Remember the revisions of rows that the table no longer has: redone, they go on there."""
    known = {"rows": state.revision_row, "curves": state.revision_curve}.get(table, {})
    rows = [(_NAMES.get(table, table), i, known[i]) for i in numbers if i in known]
    database.executemany("INSERT OR REPLACE INTO gone VALUES (?, ?, ?)", rows)


def _group_rows(state: HullState, numbers: IntArray) -> Iterator[Row]:
    table = state.groups
    for i in numbers.tolist():
        yield i, table.name[i], table.family[i], int(table.alive[i]), json.dumps(table.members[i])


def _line_rows(state: HullState, numbers: IntArray) -> Iterator[Row]:
    table = state.lines
    for i in numbers.tolist():
        yield (
            i, table.key[i], table.name[i], int(table.alive[i]),
            int(table.group[i]), int(table.planar[i]), _real_blob(table.normal[i]),
            _real_blob(table.offset[i]), int(table.boundary[i]),
            json.dumps([int(curve) for curve in table.curves[i]]), table.note[i],
        )  # fmt: skip


def _curve_rows(state: HullState, numbers: IntArray) -> Iterator[Row]:
    table, places = state.curves, _place_blobs(crossing_positions(state, numbers))
    for i, place in zip(numbers.tolist(), places, strict=True):
        ends, points = table.ends[i], np.zeros(len(table.rows[i]), _POINT)
        points["row"], points["side"] = table.rows[i], table.side[i]
        failed = table.state[i] != State.CLEAN and table.spline[i] is not None
        yield (
            i, table.key[i], int(table.alive[i]), int(table.line[i]),
            int(table.state[i]), state.revision_curve.get(i, 0),
            json.dumps([[int(kind) for kind in ends.kind], ends.vector]),
            points.tobytes(), place, pack_spline(table.spline[i]) if failed else None,
        )  # fmt: skip


def _place_blobs(places: CrossingPositions) -> Iterator[bytes]:
    records = np.zeros(len(places.line), _PLACE)
    records["line"], records["row"] = places.line, places.row
    records["sign"], records["at"] = places.sign, places.at
    for part in np.split(records, np.cumsum(places.count)[:-1]):
        yield part.tobytes()


def pack_spline(spline: SplineBatch) -> bytes:
    """Put a spline into bytes."""
    return pack_arrays({name: getattr(spline, name) for name in ("knot", "xyz", "leave", "arrive")})


def _point_rows(state: HullState, numbers: IntArray) -> Iterator[Row]:
    table, revision = state.rows, state.revision_row
    whole = {name: getattr(table, name).data[numbers].astype(int).tolist() for name in _WHOLES}
    pairs = {name: getattr(table, name).take(numbers).astype(int).tolist() for name in _PAIRS}
    reals = {name: _blobs(getattr(table, name), numbers) for name in _REALS}
    xyz = [_real_blob(each) for each in table.xyz[numbers]]
    first = table.first_role[numbers].astype(int).tolist()
    key = table.key.data.for_looks(len(numbers))
    for place, i in enumerate(numbers.tolist()):
        yield (
            i, key[i], table.label[i],
            *(whole[name][place] for name in ("alive", "sort", "role", "override")),
            *pairs["curve"][place], *pairs["kind"][place], *pairs["reader"][place],
            *(whole[name][place] for name in ("driver", "contact", "sign", "birth", "state")),
            revision.get(i, 0), *pairs["anchor"][place], xyz[place],
            *(reals[name][place] for name in _REALS), first[place], table.stands_for[i],
        )  # fmt: skip


def _real_blob(values: object) -> bytes:
    return np.asarray(values, "<f8").tobytes()


def _blobs(column: Any, numbers: IntArray) -> list[bytes | None]:
    """Give the bytes of rows of a column, None where they are what a new row holds."""
    values = column.take(numbers)
    # By bytes, not by value: nan equals nan, and -0.0 does not equal 0.0.
    nothing = _real_blob(np.full(column.shape, column.fill))
    found = [_real_blob(each) for each in values]
    return [None if each == nothing else each for each in found]


_GIVE = {
    "groups": _group_rows, "lines": _line_rows, "curves": _curve_rows, "rows": _point_rows,
    "featured": feature_rows, "formed": definition_rows, "produced": generated_rows,
}  # fmt: skip


def read_state(database: sqlite3.Connection) -> HullState:
    """Read the tables of a hull as they were written.

    Raises
    ------
    ValueError, TypeError, KeyError, IndexError
        The file holds what was never written by this module.
    """
    said = database.execute(
        "SELECT name, length, breadth, depth, draught, deck, tolerances, failed FROM hull"
    ).fetchone()
    state = HullState(Particulars(*said[:6]), Tolerances(**parse_json(said[6])))
    links = read_rows(database, "SELECT a, b, two_way FROM associations ORDER BY a, b")
    state.settings.associations.data[0] = tuple(Association(a, b, bool(w)) for a, b, w in links)
    ruled = read_rows(database, "SELECT a, b, two_way, box FROM rulings ORDER BY place")
    state.settings.rulings.data[0] = tuple(
        Ruling(a, b, bool(way), *(tuple(corner) for corner in parse_json(box)))
        for a, b, way, box in ruled
    )
    cylinders = read_rows(database, "SELECT name, x, z, radius FROM tunnels ORDER BY place")
    state.settings.tunnels.data[0] = attachments_in_order(
        TunnelDefinition(name, *(float(np.frombuffer(each, "<f8")[0]) for each in numbers))
        for name, *numbers in cylinders
    )
    outlined = read_rows(
        database, "SELECT name, kind, sections, corners, both, sign FROM bodies ORDER BY place"
    )
    state.settings.bodies.data[0] = attachments_in_order(
        AttachedBody(name, kind, parse_json(rings), parse_json(corners), bool(both), sign)
        for name, kind, rings, corners, both, sign in outlined
    )
    births = read_rows(database, "SELECT a, b, count FROM births ORDER BY a, b")
    state.settings.births.data[0] = Births.of({(a, b): int(count) for a, b, count in births})
    state.settings.failed.data[0] = tuple(parse_json(said[7]))
    _read_groups(state, read_numbered(database, "groups"))
    _read_lines(state, read_numbered(database, "lines"))
    _read_points(state, read_numbered(database, "points"))
    _read_curves(state, read_numbered(database, "curves"))
    read_features(state, read_numbered(database, "features"))
    read_definitions(state, read_numbered(database, "definitions"))
    read_generated(state, read_numbered(database, "generated"))
    state.revision_row, state.revision_curve = read_revisions(database)
    return state


def read_revisions(database: sqlite3.Connection) -> tuple[dict[int, int], dict[int, int]]:
    """Read the revisions of points and curves by number, gone ones too; none that are zero."""
    points, curves = (
        {
            operator.index(number): operator.index(revision)
            for number, revision in database.execute(
                "SELECT number, MAX(revision) FROM (SELECT number, revision FROM gone "
                f"WHERE kind = ? UNION ALL SELECT number, revision FROM {name}) "
                "WHERE revision > 0 GROUP BY number", (name,),
            )
        }
        for name in ("points", "curves")
    )  # fmt: skip
    return points, curves


def _columns(rows: Sequence[Row], count: int) -> list[tuple[Any, ...]]:
    return list(zip(*rows, strict=True)) if rows else [()] * count


def _put_whole(column: Any, values: Sequence[Any]) -> None:
    """Put whole numbers, or several to a row, into a column."""
    given = np.array(values, np.int64).reshape(-1, *column.shape)
    column.put(np.arange(len(given)), given.astype(column.dtype))


def _put_reals(column: Any, blobs: Sequence[bytes | None]) -> None:
    """Put real numbers into a column; None leaves the fill value."""
    here = [i for i, blob in enumerate(blobs) if blob is not None]
    given = np.frombuffer(b"".join(blobs[i] for i in here), "<f8")  # type: ignore[misc]
    column.put(np.array(here, np.int64), given.reshape(len(here), *column.shape))


def _read_groups(state: HullState, rows: Sequence[Row]) -> None:
    _, name, family, alive, members = _columns(rows, 5)
    state.groups.resize(len(rows))
    state.groups.name.data[:], state.groups.family.data[:] = name, family
    state.groups.members.data[:] = [tuple(parse_json(each)) for each in members]
    _put_whole(state.groups.alive, alive)


def _read_lines(state: HullState, rows: Sequence[Row]) -> None:
    table = state.lines
    table.resize(len(rows))
    _, key, name, alive, group, planar, normal, offset, boundary, curves, note = _columns(rows, 11)
    table.key.data[:], table.name.data[:], table.note.data[:] = key, name, note
    table.curves.data[:] = [tuple(parse_json(each)) for each in curves]
    for column, values in (
        (table.alive, alive), (table.group, group), (table.planar, planar),
        (table.boundary, boundary),
    ):  # fmt: skip
        _put_whole(column, values)
    _put_reals(table.normal, normal)
    _put_reals(table.offset, offset)


def _read_points(state: HullState, rows: Sequence[Row]) -> None:
    table = state.rows
    table.resize(len(rows))
    found = _columns(rows, 31)
    table.key.data[:], table.label.data[:] = found[1], found[2]
    for name, place in zip(("alive", "sort", "role", "override"), range(3, 7), strict=True):
        _put_whole(getattr(table, name), found[place])
    for name, place in zip(("curve", "kind", "reader"), (7, 9, 11), strict=True):
        _put_whole(getattr(table, name), list(zip(found[place], found[place + 1], strict=True)))
    for name, place in zip(
        ("driver", "contact", "sign", "birth", "state"), range(13, 18), strict=True
    ):
        _put_whole(getattr(table, name), found[place])
    _put_whole(table.anchor, list(zip(found[19], found[20], strict=True)))
    _put_reals(table.xyz, found[21])
    for name, place in zip(_REALS, range(22, 29), strict=True):
        _put_reals(getattr(table, name), found[place])
    _put_whole(table.first_role, found[29])
    table.stands_for.data[:] = found[30]


def _read_curves(state: HullState, rows: Sequence[Row]) -> None:
    table = state.curves
    table.resize(len(rows))
    _, key, alive, line, states, _, ends, points, places, kept = _columns(rows, 10)
    table.key.data[:] = key
    table.ends.data[:] = [_ends(parse_json(each)) for each in ends]
    for i, each in enumerate(points):
        record = np.frombuffer(each, _POINT)
        chosen, side = record["row"].astype(np.int64), record["side"].astype(np.int64)
        freeze(chosen, side)
        table.rows.data[i], table.side.data[i] = chosen, side
    for column, values in ((table.alive, alive), (table.line, line), (table.state, states)):
        _put_whole(column, values)
    put_crossing_positions(state, _places(places))
    splines, left = dict[int, SplineBatch](), _MOST_SPLINES
    for i, each in enumerate(kept):
        if each is not None:
            splines[i] = unpack_spline(each, left)
            left -= splines[i].xyz.nbytes
    shape_curves(state, np.arange(len(rows)), splines)


def _ends(said: list[Any]) -> Ends:
    (first, last), (start, finish) = said
    return Ends((int(first), int(last)), (tuple(start), tuple(finish)))


def _places(blobs: Sequence[bytes]) -> CrossingPositions:
    record = np.frombuffer(b"".join(blobs), _PLACE)
    count = np.array([len(blob) // _PLACE.itemsize for blob in blobs], np.int64)
    whole = {name: record[name].astype(np.int64) for name in ("line", "sign", "row")}
    return CrossingPositions(
        np.arange(len(blobs)), count, whole["line"], whole["sign"], whole["row"],
        np.ascontiguousarray(record["at"], np.float64),
    )  # fmt: skip


_MOST_SPLINES = 1 << 25
"""Bytes of the splines that a hull keeps of curves that failed: a million points."""


def unpack_spline(data: bytes, most: int = _MOST_SPLINES) -> SplineBatch:
    """Take a spline out of bytes, at most so many."""
    arrays: dict[str, NDArray[Any]] = unpack_arrays(data, most)[0]
    knot = arrays["knot"]
    return SplineBatch(
        np.array([0, len(knot)], np.int64), knot, arrays["xyz"], arrays["leave"], arrays["arrive"]
    )


def require_counts(database: sqlite3.Connection, state: HullState) -> None:
    """Refuse tables that have not as many rows as the hull.

    Raises
    ------
    ValueError
        Naming the first such table.
    """
    for table in WRITTEN:
        name, count = _NAMES.get(table, table), getattr(state, table).count
        found = database.execute(f"SELECT count(*) FROM {name}").fetchone()[0]
        if found != count:
            raise ValueError(f"the table {name} has {found} rows, and the hull {count}")
