"""The definition of a hull and its published values, as plain values in canonical order.

The *definition* is what the designer decided: lines with their planes, end conditions, values of
shared crossings, placed and adopted points, kinds, roles, which intersection is which crossing,
associations, particulars, tolerances, features, definitions by form parameters.
All else is *derived* and can be made from it again (`assoc_hull.model.definition.restore`).
An object that could not be made keeps its last good shape; as nothing else tells that shape,
it is part of the definition while the failure lasts.

Source of the idea of held crossings: S.W. Choi and K.Y. Lee, "A Study on the Hull Form
Design System on the Basis of the Associative Geometry Objects", J. SNAK 36(4), 1999.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from enum import IntEnum
from typing import Any

import attrs
import numpy as np

from assoc_hull.geometry.curves import EndKind, PointKind
from assoc_hull.model.attachments import attachment_records
from assoc_hull.model.definition.canonical_columns import (
    CanonicalOrder,
    Column,
    canonical_order,
    curve_columns,
    line_columns,
    meet_columns,
    point_columns,
    retired_keys,
    value_columns,
)
from assoc_hull.model.kinds import BoundaryKind, Role, Sort, State
from assoc_hull.model.tables import HullState

__all__ = [
    "code_words",
    "definition",
    "definition_columns",
    "definition_records",
    "generated_columns",
    "generated_records",
    "published",
]

# --------------------------------------------------------------------------------------
# Form definitions and generated curves: records, and columns for the fingerprint.

Record = dict[str, Any]


def definition_records(state: HullState) -> Iterator[Record]:
    """Give each form definition as plain values, by key; values that are None are left out."""
    for each in state.definitions:
        record: Record = {"use": each.use, "name": each.name, "kind": each.kind}
        record |= {"rule": each.rule, "nodes": list(each.nodes)}
        yield record | {"values": {n: v for n, v in each.values.items() if v is not None}}


def generated_records(state: HullState) -> Iterator[Record]:
    """Give each generated curve as plain values, by key; ``attached`` is written if false only."""
    keys = state.rows.key.data
    for each in state.generated:
        record: Record = {"curve": each.key, "what": each.what, "layout": each.layout}
        record |= {"points": [str(keys[row]) for row in each.rows]}
        record |= {"marks": [[piece, t] for piece, t in each.marks]}
        yield record | ({} if each.attached else {"attached": False})


def definition_columns(state: HullState) -> dict[str, Column]:
    """Give the form definitions by key, their values one behind the other; nan for None."""
    found = state.definitions
    values = [np.nan if v is None else v for each in found for v in each.values.values()]
    return {
        "use": [each.use for each in found],
        "name": [each.name for each in found],
        "kind": [each.kind for each in found],
        "rule": [each.rule for each in found],
        "nodes": [json.dumps(each.nodes) for each in found],
        "value": np.array(values, np.float64),
    }


def generated_columns(state: HullState, order: CanonicalOrder) -> dict[str, Column]:
    """Give the generated curves by key; points and marks one curve behind the other."""
    found = state.generated
    rows = np.array([row for each in found for row in each.rows], np.int64)
    return {
        "key": [each.key for each in found],
        "what": [each.what for each in found],
        "layout": [each.layout for each in found],
        "attached": np.array([each.attached for each in found], np.int64),
        "count": np.array([len(each.rows) for each in found], np.int64),
        "row": order.row[rows],
        "mark": np.array([m for each in found for m in each.marks], np.float64).reshape(-1, 2),
    }


# --------------------------------------------------------------------------------------
# The whole definition.


def code_words(codes: type[IntEnum]) -> list[str]:
    """Give the names of codes as they stand in a definition, in the order of the codes."""
    return [code.name.lower().replace("_", " ") for code in codes]


_KINDS, _ENDS, _SORTS = code_words(PointKind), code_words(EndKind), code_words(Sort)
_ROLES, _STATES, _BOUNDARIES = code_words(Role), code_words(State), code_words(BoundaryKind)


def definition(state: HullState) -> dict[str, object]:
    """Give the definition of a hull as plain values, in canonical order.

    Parameters
    ----------
    state : HullState
        The tables.

    Returns
    -------
    dict
        ``particulars`` and ``tolerances`` (m, degrees), and lists sorted by key or name:
        ``groups``, ``associations``, ``lines``, ``curves``, ``points``, ``births`` (line,
        line, how many crossings the pair ever had), ``retired`` (keys that must not come
        back) and, of a hull that has any, ``features``, ``rulings`` (which lines rule where),
        ``tunnels`` (athwartships), ``bodies`` (beside the net), ``definitions`` (by form
        parameters) and ``generated`` (curves that come from these). What has its default is left
        out: an open deck, notes, labels, free ends, zero directions, smooth passage,
        overrides, zero signs.
        ``meets`` of a curve lists, per associated line and along the curve, the sign of
        each intersection and the crossing it is, or None. ``value`` of a point (x, y, z; m)
        stands only where nothing else gives it; a ``riding`` point has ``anchors``,
        ``base``, ``from`` and ``weight`` instead. ``faired`` is how far fairing has taken a point
        from its given value (x, y, z; m).
    """
    order = canonical_order(state)
    more = {
        "features": list(_feature_records(state)),
        "rulings": ruling_records(state),
        **attachment_records(state),
        "definitions": list(definition_records(state)),
        "generated": list(generated_records(state)),
    }
    return {
        "particulars": plain_fields(state.particulars),
        "tolerances": plain_fields(state.tolerances),
        "groups": [
            {"name": state.groups.name[i], "family": state.groups.family[i]}
            | ({"members": list(state.groups.members[i])} if state.groups.members[i] else {})
            for i in order.groups.tolist()
        ],
        "associations": association_records(state),
        "lines": list(_line_records(line_columns(state, order))),
        "curves": list(_curve_records(state, order)),
        "points": list(_point_records(state, order)),
        "births": birth_records(state),
        "retired": retired_keys(state),
        **{name: records for name, records in more.items() if records},
    }


def plain_fields(fields: attrs.AttrsInstance) -> Record:
    """Give the fields of a class of numbers and words; whole numbers become floats.

    A word that is the default is left out: hulls keep the fingerprint they had before the
    word came.
    """
    default = {each.name: each.default for each in attrs.fields(type(fields))}
    values = attrs.asdict(fields)
    return {
        name: v if isinstance(v, str) else float(v)
        for name, v in values.items()
        if not isinstance(v, str) or v != default[name]
    }


def association_records(state: HullState) -> list[Record]:
    found = sorted((link.a, link.b, bool(link.two_way)) for link in state.associations)
    return [{"a": a, "b": b, "two_way": two_way} for a, b, two_way in found]


def ruling_records(state: HullState) -> list[Record]:
    return [
        {**attrs.asdict(each), "low": list(each.low), "high": list(each.high)}
        for each in state.rulings
    ]


def birth_records(state: HullState) -> list[list[object]]:
    return [[*pair, count] for pair, count in sorted(state.births.items())]


def _rows_of(columns: dict[str, Column]) -> Iterator[Record]:
    """Turn columns of one length into a record per row."""
    lists = [part.tolist() if isinstance(part, np.ndarray) else part for part in columns.values()]
    for values in zip(*lists, strict=True):
        yield dict(zip(columns, values, strict=True))


def _line_records(columns: dict[str, Column]) -> Iterator[Record]:
    for row in _rows_of(columns):
        record: Record = {"key": row["key"], "name": row["name"], "group": row["group"]}
        if row["planar"]:
            record |= {"normal": row["normal"], "offset": row["offset"]}
        if row["boundary"] >= 0:
            record["boundary"] = _BOUNDARIES[row["boundary"]]
        if row["note"]:
            record["note"] = row["note"]
        yield record


def _curve_records(state: HullState, order: CanonicalOrder) -> Iterator[Record]:
    columns = curve_columns(state, order)
    line, point = line_columns(state, order)["key"], point_columns(state, order)["key"]
    rows = [point[place] for place in np.asarray(columns.pop("row")).tolist()]
    meets = _meet_records(state, order)
    first = 0
    for number, row in zip(order.curves.tolist(), _rows_of(columns), strict=True):
        record: Record = {"key": row["key"], "line": line[row["line"]]}
        record |= _end_records(row)
        record["points"] = rows[first : (first := first + row["count"])]
        record["meets"] = meets.get(row["key"], {})
        if row["state"] != State.CLEAN:
            record["kept"] = {
                "state": _STATES[row["state"]],
                **_shape(state, number, with_xyz=True),
            }
            record["kept"]["meets"] = _places_met(state, order).get(row["key"], {})
        yield record


def _end_records(row: Record) -> Record:
    return {
        name: {"kind": _ENDS[kind], "vector": vector}
        for name, kind, vector in zip(
            ("start", "finish"), row["end_kind"], row["end_vector"], strict=True
        )
        if kind or _marked(vector)
    }


def _marked(vector: list[float]) -> bool:
    """Tell whether a vector differs from (0.0, 0.0, 0.0) by a bit, -0.0 included."""
    return any(repr(number) != "0.0" for number in vector)


def _meet_records(state: HullState, order: CanonicalOrder) -> dict[str, dict[str, list[list[Any]]]]:
    """Give the sign of each intersection, and its crossing, by curve and line."""
    columns = meet_columns(state, order)
    keys, found = _Keys(state, order), dict[str, dict[str, list[list[Any]]]]()
    names = ("owner", "line", "sign", "row")
    for row in _rows_of({name: columns[name] for name in names}):
        crossing = None if row["row"] < 0 else keys.row(row["row"])
        mine = found.setdefault(keys.curve(row["owner"]), {})
        mine.setdefault(keys.line(row["line"]), []).append([row["sign"], crossing])
    return found


def _places_met(state: HullState, order: CanonicalOrder) -> dict[str, dict[str, list[list[float]]]]:
    """Give parameter and place (t, x, y, z; m) of each intersection, by curve and line."""
    columns = meet_columns(state, order)
    keys, found = _Keys(state, order), dict[str, dict[str, list[list[float]]]]()
    names = ("owner", "line", "parameter", "xyz")
    for row in _rows_of({name: columns[name] for name in names}):
        mine = found.setdefault(keys.curve(row["owner"]), {})
        mine.setdefault(keys.line(row["line"]), []).append([row["parameter"], *row["xyz"]])
    return found


@attrs.frozen(eq=False)
class _Keys:
    """Keys of objects by their place in the canonical order."""

    state: HullState
    order: CanonicalOrder

    def row(self, place: int) -> str:
        return str(self.state.rows.key[self.order.rows[place]])

    def curve(self, place: int) -> str:
        return str(self.state.curves.key[self.order.curves[place]])

    def line(self, place: int) -> str:
        return str(self.state.lines.key[self.order.lines[place]])


def _shape(state: HullState, curve: int, *, with_xyz: bool = False) -> Record:
    spline = state.spline(curve)
    names = ("knot", *(("xyz",) if with_xyz else ()), "leave", "arrive")
    return {name: getattr(spline, name).tolist() for name in names}


def _feature_records(state: HullState) -> Iterator[Record]:
    keys = state.rows.key.data
    for each in state.features:
        record: Record = {"key": each.key, "kind": each.kind, "name": each.name}
        record |= {"lines": list(each.lines), "points": [str(keys[row]) for row in each.points]}
        record |= {
            name: list(value) if isinstance(value, tuple) else value
            for name, value in each.parameters.items()
        }
        yield record | {name: v for name, v in (("side", each.side), ("gap", each.gap)) if v}


def _point_records(state: HullState, order: CanonicalOrder) -> Iterator[Record]:
    columns = point_columns(state, order)
    keys = _Keys(state, order)
    for row in _rows_of(columns):
        curves = [keys.curve(place) for place in row["curve"] if place >= 0]
        record: Record = {"key": row["key"], "sort": _SORTS[row["sort"]], "curves": curves}
        # Only crossings have a role, and are counted as born of a pair of lines.
        if row["role"] >= 0:
            record |= {"role": _ROLES[row["role"]], "birth": row["birth"]}
        record |= {name: row[name] for name in ("contact", "sign", "label") if row[name]}
        if row["override"] >= 0:
            record["override"] = _ROLES[row["override"]]
        if any(row["kind"]):
            # The table has room for two curves at every point.
            record["kinds"] = [_KINDS[kind] for kind in row["kind"][: len(curves)]]
        if any(_marked(vector) for vector in row["direction"]):
            record["directions"] = row["direction"][: len(curves)]
        if row["watched"]:
            record["limit"] = row["limit"]
        if row["riding"]:
            record["riding"] = {
                "anchors": [None if place < 0 else keys.row(place) for place in row["anchor"]],
                "base": row["base"],
                "from": row["anchor_from"],
                "weight": row["anchor_weight"],
            }
        if row["stored"]:
            record["value"] = row["value"]
        if row["state"] != State.CLEAN:
            record["state"] = _STATES[row["state"]]
        if any(row.get("faired", ())):
            record["faired"] = row["faired"]
        if row.get("first_role", -1) >= 0:
            record["first_role"] = _ROLES[row["first_role"]]
        if row.get("stands_for"):
            record["stands_for"] = row["stands_for"]
        yield record


# --------------------------------------------------------------------------------------
# Published values.


def published(state: HullState) -> dict[str, object]:
    """Give the derived values of a hull, by key.

    Returns
    -------
    dict
        ``curves``: by key, for every curve that is up to date, ``knot`` (n,), m, ``leave``
        and ``arrive`` (n, 3), and ``meets``: per line, parameter and place (t, x, y, z; m)
        of each intersection. The place of a crossing on each of its curves is that of its
        intersection there. ``points``: by key, ``value`` (x, y, z; m) of points that are
        computed, and ``gap`` (m) of watched ones.
    """
    order = canonical_order(state)
    met = _places_met(state, order)
    curves: Record = {}
    for number in order.curves.tolist():
        key = state.curves.key[number]
        if state.curves.state[number] == State.CLEAN:
            curves[key] = {**_shape(state, number), "meets": met.get(key, {})}
    return {"curves": curves, "points": dict(_values(state, order))}


def _values(state: HullState, order: CanonicalOrder) -> Iterator[tuple[str, Record]]:
    names = ("key", "stored", "watched")
    columns = {name: point_columns(state, order)[name] for name in names}
    for row in _rows_of(columns | value_columns(state, order)):
        record: Record = {} if row["stored"] else {"value": row["xyz"]}
        if row["watched"]:
            record["gap"] = row["gap"]
        if record:
            yield row["key"], record
