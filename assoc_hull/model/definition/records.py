"""The definition of a hull as plain values in canonical order, and the form of its document.

The *definition* is what the designer decided: lines with their planes, end conditions, values of
shared crossings, placed and adopted points, kinds, roles, which intersection is which crossing,
associations, particulars, tolerances, features, definitions by form parameters.
All else is *derived* and can be made from it again (`assoc_hull.model.definition.restore`).
An object that could not be made keeps its last good shape; as nothing else tells that shape,
it is part of the definition while the failure lasts.

Source of the idea of held crossings: S.W. Choi and K.Y. Lee, "A Study on the Hull Form
Design System on the Basis of the Associative Geometry Objects", J. SNAK 36(4), 1999.

The form of a definition and of published values: which keys, which types, which numbers.

Only the form is checked here; whether names refer to something is found when the tables are
made. The same tables give the JSON Schema (`assoc_hull.io.hull_json`).

Examples
--------
>>> from assoc_hull.model.definition.records import check_definition
>>> check_definition({"particulars": {"name": "S"}})
Traceback (most recent call last):
...
assoc_hull.errors.BadInputError: the key 'tolerances' is missing, in the definition; ...
"""

from __future__ import annotations

import json
from collections.abc import Collection, Iterator, Mapping
from enum import IntEnum
from typing import Any

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
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
from assoc_hull.model.features import FEATURE_KINDS
from assoc_hull.model.form_definition import FORM_KINDS, GENERATED, RULES
from assoc_hull.model.kinds import (
    FAMILIES,
    OWN,
    BoundaryKind,
    Role,
    Sort,
    State,
)
from assoc_hull.model.tables import DECKS, HullState, Particulars
from assoc_hull.model.value_schema import (
    COUNT,
    INDEX,
    NAME,
    NOT_NEGATIVE,
    POSITIVE,
    REAL,
    TEXT,
    TRUTH,
    ValueSchema,
    WrongValueError,
    described,
    list_of,
    mapping_of,
    one_of,
    or_none,
    record,
    tuple_of,
)
from assoc_hull.tolerance import Tolerances

__all__ = [
    "DEFINITION",
    "PUBLISHED",
    "check_definition",
    "check_published",
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


_REMEDY = "take the file from where it was written, or write it anew"

_VECTOR = described(list_of(REAL, 3, 3), "x forward, y to port, z up; a place in m")
_MEETS = described(
    mapping_of(list_of(tuple_of(REAL, REAL, REAL, REAL))),
    "by key of a line: parameter on this curve and place (t, x, y, z; m) of each meeting",
)
_SHAPE = {
    "knot": described(list_of(REAL, 2), "chord length from the start to each point, m"),
    "leave": described(list_of(_VECTOR, 2), "derivative with which the curve leaves each point"),
    "arrive": described(list_of(_VECTOR, 2), "derivative with which it arrives at each point"),
}
_END = record({"kind": one_of(code_words(EndKind)), "vector": _VECTOR})
_STATE = one_of(code_words(State)[1:])

_LINE = record(
    {"key": NAME, "name": NAME, "group": TEXT},
    {"normal": _VECTOR, "offset": REAL, "boundary": one_of(code_words(BoundaryKind)), "note": NAME},
)
_CURVE = record(
    {
        "key": NAME,
        "line": TEXT,
        "points": described(list_of(TEXT, 2), "keys of its points, along it"),
        "meets": described(
            mapping_of(list_of(tuple_of(one_of((1, -1)), or_none(TEXT)), 1)),
            "by key of a line: sense of each meeting, and the key of its crossing",
        ),
    },
    {
        "start": _END,
        "finish": _END,
        "kept": described(
            record({"state": _STATE, **_SHAPE, "xyz": list_of(_VECTOR, 2), "meets": _MEETS}),
            "the last good shape of a curve that could not be made",
        ),
    },
)
_RIDING = record(
    {
        "anchors": tuple_of(or_none(TEXT), or_none(TEXT)),
        "base": _VECTOR,
        "from": tuple_of(_VECTOR, _VECTOR),
        "weight": REAL,
    }
)
_POINT = record(
    {"key": NAME, "sort": one_of(code_words(Sort)), "curves": list_of(TEXT, 1, 2)},
    {
        "role": one_of(code_words(Role)),
        "birth": described(COUNT, "which crossing of its pair of lines it is, ever"),
        "contact": TRUTH,
        "sign": one_of((1, -1)),
        "label": NAME,
        "override": one_of(code_words(Role)),
        "kinds": list_of(one_of(code_words(PointKind)), 1, 2),
        "directions": list_of(_VECTOR, 1, 2),
        "limit": described(REAL, "largest gap of a watched crossing, m"),
        "riding": described(_RIDING, "between which points an adopted point rides"),
        "value": _VECTOR,
        "state": _STATE,
        "faired": described(_VECTOR, "how far fairing has taken it from its given value, m"),
        "first_role": described(
            one_of(code_words(Role)), "of a crossing before its association was switched"
        ),
        "stands_for": described(NAME, "key of the crossing whose place a stand-in holds"),
    },
)


_FEATURE = record(
    {
        "key": NAME,
        "kind": one_of(FEATURE_KINDS),
        "name": NAME,
        "lines": described(list_of(TEXT, 1), "keys of the lines that it lies on"),
        "points": described(list_of(TEXT, 1), "keys of the points that it owns, along the line"),
    },
    {
        "centre": _VECTOR,
        "radius": POSITIVE,
        "normal": _VECTOR,
        "offset": described(REAL, "normal . place on its plane, m"),
        "direction": _VECTOR,
        "side": described(
            one_of((1, -1)), "1: centre or region lies left of its points, -1: right"
        ),
        "gap": described(NOT_NEGATIVE, "how far its points lie off it at most, m"),
    },
)


_CORNER = described(
    tuple_of(or_none(REAL), or_none(REAL), or_none(REAL)), "of a box, m; null where it has no bound"
)
_RULING = record(
    {
        "a": described(NAME, "name of a group, or key of a line"),
        "b": described(NAME, "likewise"),
        "two_way": TRUTH,
        "low": _CORNER,
        "high": _CORNER,
    }
)


_TUNNEL = record(
    {
        "name": NAME,
        "x": described(REAL, "of its axis, from AP, m"),
        "z": described(REAL, "of its axis, from the base line, m"),
        "radius": described(POSITIVE, "of its inside, m"),
    }
)


_BODY = record(
    {
        "name": NAME,
        "group": described(NAME, "hatches, deck houses, boxes, bossings and so on"),
        "sections": described(
            list_of(list_of(_VECTOR, 3), 2), "closed, from aft forward, of as many points each, m"
        ),
        "corners": described(list_of(INDEX), "points at which edges run along"),
        "both": described(TRUTH, "its mirror image stands on the other side"),
        "sign": described(one_of((1, -1)), "1: stands on the hull, -1: is taken from it"),
    }
)


_FORM = record(
    {
        "use": described(NAME, "what is taken from it; each use stands once"),
        "name": NAME,
        "kind": one_of(FORM_KINDS),
        "rule": described(one_of(RULES), "how a course runs between its nodes"),
        "nodes": described(list_of(NAME), "labels of the nodes of a course, in order"),
        "values": described(mapping_of(REAL), "by name: m, m2, degrees, 1/m or parts"),
    }
)
_MADE = record(
    {
        "curve": described(TEXT, "key of the curve"),
        "what": described(one_of(GENERATED), "what is generated"),
        "layout": described(TEXT, "of which pieces"),
        "points": described(list_of(TEXT), "keys of its generated points, along the curve"),
        "marks": described(
            list_of(tuple_of(NOT_NEGATIVE, NOT_NEGATIVE)),
            "of each point: number of the piece, and parameter (0 to 4) on it",
        ),
    },
    {
        "attached": described(
            TRUTH, "whether the points are those of the definitions; if not told, so"
        )
    },
)


def _fields(cls: type, form: ValueSchema, leave: Collection[str] = ()) -> Mapping[str, ValueSchema]:
    """Give the forms of an attrs class of numbers, and perhaps a name."""
    names = [each.name for each in attrs.fields(cls) if each.name not in leave]
    return {name: TEXT if name == "name" else form for name in names}


_DECK = described(one_of(DECKS), "between the deck edges to port and starboard; open if not told")


DEFINITION = record(
    {
        "particulars": described(
            record(_fields(Particulars, POSITIVE, ("deck",)), {"deck": _DECK}), "m"
        ),
        "tolerances": described(record(_fields(Tolerances, NOT_NEGATIVE)), "m, parts and degrees"),
        "groups": list_of(
            record(
                {"name": NAME, "family": one_of((*FAMILIES, OWN))},
                {"members": described(list_of(NAME), "keys of lines and names of groups")},
            )
        ),
        "associations": described(
            list_of(record({"a": TEXT, "b": TEXT, "two_way": TRUTH})),
            "lines of group a generate points on those of b, and back if two_way",
        ),
        "lines": list_of(_LINE),
        "curves": list_of(_CURVE),
        "points": list_of(_POINT),
        "births": described(
            list_of(tuple_of(TEXT, TEXT, COUNT)),
            "keys of two lines, and how many crossings the pair ever had",
        ),
        "retired": described(
            record(dict.fromkeys(("lines", "curves", "points"), list_of(NAME))),
            "keys that must not come back",
        ),
    },
    {
        "features": described(
            list_of(_FEATURE), "circles, arcs, flats and so on; none if not told"
        ),
        "rulings": described(list_of(_RULING), "which lines rule where; none if not told"),
        "tunnels": described(list_of(_TUNNEL), "through the hull athwartships; none if not told"),
        "bodies": described(list_of(_BODY), "beside the net; none if not told"),
        "definitions": described(list_of(_FORM), "curves of form parameters; none if not told"),
        "generated": described(list_of(_MADE), "curves that come from these; none if not told"),
    },
)
PUBLISHED = record(
    {
        "curves": mapping_of(record({**_SHAPE, "meets": _MEETS})),
        "points": mapping_of(record({}, {"value": _VECTOR, "gap": described(REAL, "m")})),
    }
)


def check_definition(value: object) -> None:
    """Check the form of a definition.

    Raises
    ------
    BadInputError
        With the way to what is wrong, the value and the remedy.
    """
    _check(DEFINITION, value, "the definition")


def check_published(value: object) -> None:
    """Check the form of published values.

    Raises
    ------
    BadInputError
        With the way to what is wrong, the value and the remedy.
    """
    _check(PUBLISHED, value, "the published values")


def _check(form: ValueSchema, value: object, name: str) -> None:
    try:
        form.check(value)
    except WrongValueError as wrong:
        path = "".join(reversed(wrong.path)).lstrip(".")
        where = f"in {name}" + (f", at {path}" if path else "")
        raise BadInputError(wrong.what, where, _REMEDY) from None
