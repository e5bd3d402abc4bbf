"""The tables of a hull as columns in canonical order: sorted by key, dead rows left out.

Row numbers and the order in which objects were made never show: objects refer to one
another by their *place*, the index in the sorted list of keys. All that a definition or a
fingerprint holds is taken from these columns, and nothing else is.

Examples
--------
>>> from assoc_hull.model.definition.canonical_columns import canonical_order
>>> from assoc_hull.model.tables import HullState, Particulars
>>> canonical_order(HullState(Particulars("S", 9.0, 2.0, 1.0, 1.0))).rows
array([], dtype=int64)
"""

from __future__ import annotations

import json

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.graph.table import ValueColumn
from assoc_hull.model.generated_curves import unmade_rows
from assoc_hull.model.keys import Keys
from assoc_hull.model.kinds import Role, Sort, State
from assoc_hull.model.tables import HullState

__all__ = [
    "CanonicalOrder",
    "Column",
    "canonical_order",
    "curve_columns",
    "feature_columns",
    "line_columns",
    "meet_columns",
    "point_columns",
    "retired_keys",
    "spline_columns",
    "value_columns",
]

Column = list[str] | NDArray[np.generic]


@attrs.frozen(eq=False)
class CanonicalOrder:
    """The live objects in canonical order, and where each stands in it.

    Attributes
    ----------
    rows, curves, lines, groups : (k,) int
        Numbers of the live objects, by ascending key.
    row, curve, line : (count + 1,) int
        Place of each number; -1 for dead ones and for the number -1.
    """

    rows: IntArray
    curves: IntArray
    lines: IntArray
    groups: IntArray
    row: IntArray
    curve: IntArray
    line: IntArray


def canonical_order(state: HullState) -> CanonicalOrder:
    """Sort the live objects of a hull by key."""
    rows, curves, lines = (_sorted(state, name, "key") for name in ("rows", "curves", "lines"))
    return CanonicalOrder(
        rows,
        curves,
        lines,
        _sorted(state, "groups", "name"),
        _inverse(rows, state.rows.count),
        _inverse(curves, state.curves.count),
        _inverse(lines, state.lines.count),
    )


def _sorted(state: HullState, table: str, key: str) -> IntArray:
    keys, numbers = getattr(getattr(state, table), key).data, state.live(table).tolist()
    if isinstance(keys, Keys):
        keys = keys.for_looks(len(numbers))
    return np.array(sorted(numbers, key=keys.__getitem__), np.int64)


def _inverse(numbers: IntArray, count: int) -> IntArray:
    place = np.full(count + 1, -1)
    place[numbers] = np.arange(len(numbers))
    return place


def _texts(column: ValueColumn[str], numbers: IntArray) -> list[str]:
    return [column[number] for number in numbers.tolist()]


def line_columns(state: HullState, order: CanonicalOrder) -> dict[str, Column]:
    """Give what defines the lines."""
    table, numbers = state.lines, order.lines
    planar = table.planar[numbers]
    return {
        "key": _texts(table.key, numbers),
        "name": _texts(table.name, numbers),
        "note": _texts(table.note, numbers),
        "group": _texts(state.groups.name, table.group[numbers]),
        "planar": planar,
        "normal": np.where(planar[:, None], table.normal[numbers], 0.0),
        "offset": np.where(planar, table.offset[numbers], 0.0),
        "boundary": table.boundary[numbers],
    }


def curve_columns(state: HullState, order: CanonicalOrder) -> dict[str, Column]:
    """Give what defines the curves; their points lie one curve behind the other."""
    table, numbers = state.curves, order.curves
    ends = [table.ends[curve] for curve in numbers.tolist()]
    rows = [table.rows[curve] for curve in numbers.tolist()]
    return {
        "key": _texts(table.key, numbers),
        "line": order.line[table.line[numbers]],
        "state": table.state[numbers],
        "end_kind": np.array([end.kind for end in ends], np.int64).reshape(-1, 2),
        "end_vector": np.array([end.vector for end in ends], np.float64).reshape(-1, 2, 3),
        "count": np.array([len(part) for part in rows], np.int64),
        "row": order.row[np.concatenate([np.zeros(0, np.int64), *rows])],
    }


def meet_columns(state: HullState, order: CanonicalOrder) -> dict[str, Column]:
    """Give the meetings of the curves, by curve, then key of the line, then along the curve.

    ``owner`` is the place of the curve; ``line``, ``sign`` and ``row`` are definition,
    ``parameter`` (m) and ``xyz`` (m) are derived.
    """
    parts = [state.curves.meets[curve] for curve in order.curves.tolist()]
    whole, reals = np.zeros(0, np.int64), np.zeros(0)
    owner, line, turn = _meet_turn(state, order)
    return {
        "owner": owner,
        "line": line[turn],
        "sign": np.concatenate([whole, *(part.sign for part in parts)])[turn],
        "row": order.row[np.concatenate([whole, *(part.row for part in parts)])][turn],
        "parameter": np.concatenate([reals, *(part.parameter for part in parts)])[turn],
        "xyz": np.concatenate([reals.reshape(0, 3), *(part.xyz for part in parts)])[turn],
    }


def _meet_turn(state: HullState, order: CanonicalOrder) -> tuple[IntArray, IntArray, IntArray]:
    """Give owner and line of the meetings as the curves list them, and the canonical order."""
    parts = [state.curves.meets[curve].line for curve in order.curves.tolist()]
    owner: IntArray = np.repeat(np.arange(len(parts)), [len(part) for part in parts])
    line: IntArray = order.line[np.concatenate([np.zeros(0, np.int64), *parts])]
    return owner, line, np.lexsort((line, owner))


def point_columns(state: HullState, order: CanonicalOrder) -> dict[str, Column]:
    """Give what defines the points; what is derived at a point is masked with nil."""
    table, rows = state.rows, order.rows
    anchor = order.row[table.anchor[rows]]
    riding = np.asarray((anchor >= 0).any(axis=1))
    crossing = table.sort[rows] == Sort.CROSSING
    shared = crossing & (table.role[rows] == Role.SHARED)
    own = ~crossing & ~riding & unmade_rows(state, rows)
    stored = shared | own | (table.state[rows] != State.CLEAN)
    watched, faired = _watched(state, rows), table.faired[rows]
    # Of a hull that was never faired nothing is told, as before there was such a thing.
    more: dict[str, Column] = {"faired": faired} if faired.any() else {}
    # So it is with associations that were never switched.
    first, stands_for = table.first_role[rows], _texts(table.stands_for, rows)
    more |= {"first_role": first} if (first >= 0).any() else {}
    more |= {"stands_for": stands_for} if any(stands_for) else {}
    return {
        "key": _texts(table.key, rows),
        "label": _texts(table.label, rows),
        "sort": table.sort[rows],
        "kind": table.kind[rows],
        "direction": table.direction[rows],
        "curve": order.curve[table.curve[rows]],
        "role": np.where(crossing, table.role[rows], -1),
        "override": table.override[rows],
        "contact": table.contact[rows],
        "sign": table.sign[rows],
        "birth": table.birth[rows],
        "state": table.state[rows],
        "stored": stored,
        "value": np.where(stored[:, None], table.xyz[rows], 0.0),
        "watched": watched,
        "limit": np.where(watched, table.limit[rows], 0.0),
        "riding": riding,
        "anchor": anchor,
        "base": np.where(riding[:, None], table.base[rows], 0.0),
        "anchor_from": np.where(riding[:, None, None], table.anchor_from[rows], 0.0),
        "anchor_weight": np.where(riding, table.anchor_weight[rows], 0.0),
        **more,
    }


def _watched(state: HullState, rows: IntArray) -> NDArray[np.bool_]:
    crossing = state.rows.sort[rows] == Sort.CROSSING
    found: NDArray[np.bool_] = crossing & (state.rows.role[rows] == Role.WATCHED)
    return found


def value_columns(state: HullState, order: CanonicalOrder) -> dict[str, Column]:
    """Give the places of all points (k, 3), m, and the watched gaps (k,), m, nil elsewhere."""
    watched = _watched(state, order.rows)
    return {
        "xyz": state.rows.xyz[order.rows],
        "gap": np.where(watched, state.rows.gap[order.rows], 0.0),
    }


def spline_columns(state: HullState, order: CanonicalOrder) -> dict[str, Column]:
    """Give the published splines, one curve behind the other; ``knots`` counts each."""
    parts = [state.spline(curve) for curve in order.curves.tolist()]
    empty: FloatArray = np.zeros((0, 3))
    return {
        "knots": np.array([len(part.knot) for part in parts], np.int64),
        "knot": np.concatenate([np.zeros(0), *(part.knot for part in parts)]),
        "xyz": np.concatenate([empty, *(part.xyz for part in parts)]),
        "leave": np.concatenate([empty, *(part.leave for part in parts)]),
        "arrive": np.concatenate([empty, *(part.arrive for part in parts)]),
    }


def feature_columns(state: HullState, order: CanonicalOrder) -> dict[str, Column]:
    """Give the features by key; lines and points one feature behind the other, nil for None."""
    found = state.features
    points = [np.array(each.points, np.int64) for each in found]
    lines = [list(each.lines) for each in found]
    nil = (0.0, 0.0, 0.0)
    vectors = [(each.centre, each.normal, each.direction) for each in found]
    reals = [(each.radius, each.offset) for each in found]
    return {
        "key": [each.key for each in found],
        "kind": [each.kind for each in found],
        "name": [each.name for each in found],
        # A column holds one text to a feature, and a name may hold any separator.
        "lines": [json.dumps(each) for each in lines],
        "count": np.array([len(part) for part in points], np.int64),
        # Without features the empty array makes it a column of whole numbers still.
        "row": order.row[np.concatenate([np.zeros(0, np.int64), *points])],
        # Nil is not mistaken for what was given: the kind says which of these there are.
        "vectors": np.array([[v or nil for v in part] for part in vectors]).reshape(-1, 3, 3),
        "reals": np.array([[v or 0.0 for v in part] for part in reals]).reshape(-1, 2),
        "side": np.array([each.side for each in found], np.int64),
        "gap": np.array([each.gap for each in found], np.float64),
    }


def retired_keys(state: HullState) -> dict[str, list[str]]:
    """Give the keys of lines, curves and points that were taken out: none may come back.

    Dead crossings are not listed: the number of births of their pair of lines rules them out.
    Nor are stand-ins of crossings: the same one comes back where it is wanted again.
    """
    own = state.rows.sort.data != Sort.CROSSING
    found = {"lines": ~state.lines.alive.data, "curves": ~state.curves.alive.data}
    found["points"] = ~state.rows.alive.data & own
    for row in state.rows.stands_for.data.given:
        found["points"][row] = False
    keys = {"lines": state.lines.key, "curves": state.curves.key, "points": state.rows.key}
    return {
        name: sorted(keys[name][number] for number in np.flatnonzero(dead).tolist())
        for name, dead in found.items()
    }
