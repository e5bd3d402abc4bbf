"""The points of a hull from a definition: places, kinds, roles, riding links, curve orders.

Examples
--------
>>> from assoc_hull.graph.journal import Journal
>>> from assoc_hull.model.definition.filling import Keys
>>> from assoc_hull.model.definition.filling_points import put_points
>>> from assoc_hull.model.state import HullState, Particulars
>>> state = HullState(Particulars("S", 9.0, 2.0, 1.0, 1.0))
>>> point = {"key": "p", "sort": "placed", "curves": ["c"], "value": [1.0, 2.0, 3.0]}
>>> put_points(state, Journal(), [point], Keys({}, {}, {"c": 0}, {"p": 0}))
>>> state.rows.xyz.data
array([[1., 2., 3.]])
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from enum import IntEnum
from itertools import pairwise
from typing import Any

import numpy as np

from assoc_hull.geometry.curves import IntArray, PointKind
from assoc_hull.graph.journal import Journal
from assoc_hull.model.definition.definition import words
from assoc_hull.model.definition.filling import Keys, fill, wrong
from assoc_hull.model.kinds import Role, Sort, State
from assoc_hull.model.make_objects import Maker
from assoc_hull.model.state import HullState

__all__ = ["put_defining", "put_points"]

Record = Mapping[str, Any]

_NIL = [0.0, 0.0, 0.0]


def _codes(values: Sequence[str], codes: type[IntEnum], count: int) -> list[int]:
    names = words(codes)
    return [*(names.index(value) for value in values), *[0] * (count - len(values))]


def put_points(
    state: HullState,
    journal: Journal,
    points: list[Record],
    keys: Keys,
    computed: Collection[str] = (),
) -> None:
    """Add the points of a hull, with the links that follow from their roles.

    Parameters
    ----------
    state : HullState
        Tables that hold the curves already.
    journal : Journal
        Takes the writes.
    points : list of mapping
        As in a definition, by number.
    keys : Keys
        Numbers by key.
    computed : collection of str
        Keys of the points whose places come from form definitions.

    Raises
    ------
    BadInputError
        If a point lacks what a point of its sort and role has, or has more.
    """
    for point in points:
        _check_point(point, made=point["key"] in computed)
    if not points:
        return
    roles, sorts, states = words(Role), words(Sort), words(State)
    values = [point.get("value", _NIL) for point in points]
    rows = fill(
        state.rows,
        journal,
        len(points),
        key=[point["key"] for point in points],
        label=[point.get("label", "") for point in points],
        sort=[sorts.index(point["sort"]) for point in points],
        xyz=values,
        kind=[_codes(point.get("kinds", ()), PointKind, 2) for point in points],
        direction=[_pair(point.get("directions", ())) for point in points],
        curve=[_numbers(keys, "curves", point["curves"], point["key"]) for point in points],
        override=[
            roles.index(point["override"]) if "override" in point else -1 for point in points
        ],
        contact=[point.get("contact", False) for point in points],
        sign=[point.get("sign", 0) for point in points],
        birth=[point.get("birth", 0) for point in points],
        limit=[point.get("limit", np.nan) for point in points],
        base=values,
        state=[states.index(point.get("state", states[0])) for point in points],
    )
    crossing = state.rows.sort.data == Sort.CROSSING
    role = np.array([roles.index(point.get("role", roles[0])) for point in points])
    Maker(state, journal).roles(rows[crossing], role[crossing])
    alone = rows[~crossing]
    journal.put(state.rows.reader, alone, state.rows.curve.data[alone])
    _put_riding(state, journal, points, keys)


def _override(point: Record, roles: list[str]) -> int:
    return roles.index(point["override"]) if "override" in point else -1


def _check_point(point: Record, *, made: bool = False) -> None:
    """Check that a point of its sort has just the parts that such a point has."""
    where, crossing = f"at the point {point['key']!r}", point["sort"] == "crossing"
    if len(point["curves"]) != (2 if crossing else 1):
        raise wrong(f"a {point['sort']} point lies on {len(point['curves'])} curve(s)", where)
    for name in ("kinds", "directions"):
        if len(point.get(name, point["curves"])) != len(point["curves"]):
            raise wrong(f"there are not as many {name} as curves", where)
    role = point.get("role")
    own = not crossing and "riding" not in point and not made
    known = role == "shared" or own or "state" in point
    wanted = {
        "role": crossing,
        "birth": crossing,
        "limit": role == "watched",
        "value": known,
    }
    for name, needed in wanted.items():
        if needed != (name in point):
            raise wrong(f"{name!r} is {'missing' if needed else 'out of place'}", where)
    for name in ("contact", "sign", "override"):
        if name in point and not crossing:
            raise wrong(f"{name!r} is out of place at a {point['sort']} point", where)
    if "riding" in point and point["sort"] != "adopted":
        raise wrong(f"a {point['sort']} point cannot ride", where)


def _pair(vectors: Sequence[Sequence[float]]) -> list[Sequence[float]]:
    return [*vectors, *[_NIL] * (2 - len(vectors))]


def _numbers(keys: Keys, kind: str, names: Sequence[str | None], where: str) -> list[int]:
    found = [-1 if name is None else keys.find(kind, name, where) for name in names]
    return [*found, *[-1] * (2 - len(found))]


def _put_riding(state: HullState, journal: Journal, points: list[Record], keys: Keys) -> None:
    riding = [number for number, point in enumerate(points) if "riding" in point]
    if not riding:
        return
    links = [points[number]["riding"] for number in riding]
    names = [points[number]["key"] for number in riding]
    anchors = [
        _numbers(keys, "points", link["anchors"], name)
        for link, name in zip(links, names, strict=True)
    ]
    journal.put(state.rows.anchor, riding, anchors)
    journal.put(state.rows.base, riding, [link["base"] for link in links])
    journal.put(state.rows.anchor_from, riding, [link["from"] for link in links])
    journal.put(state.rows.anchor_weight, riding, [link["weight"] for link in links])


def put_defining(state: HullState, journal: Journal, curves: list[Record], keys: Keys) -> None:
    """Put the points on the curves they define, in order.

    Raises
    ------
    BadInputError
        If a curve lists other points than those whose role says that they define it.
    """
    maker = Maker(state, journal)
    owners, used = list[int](), list[int]()
    for index, curve in enumerate(curves):
        rows = [keys.find("points", key, curve["key"]) for key in curve["points"]]
        maker.define(index, rows)
        owners += [index] * len(rows)
        used += rows
    _check_links(state, np.array(used, np.int64), np.array(owners, np.int64))


def _check_links(state: HullState, rows: IntArray, curves: IntArray) -> None:
    """Compare the points that curves list with those whose roles say that they define them."""
    side, row = np.nonzero(state.rows.reader.data.T >= 0)
    by_role = sorted(zip(row.tolist(), state.rows.reader.data[row, side].tolist(), strict=True))
    by_list = sorted(zip(rows.tolist(), curves.tolist(), strict=True))
    if by_role == by_list:
        return
    odd = sorted(set(by_role) ^ set(by_list)) or [
        pair for pair, after in pairwise(by_list) if pair == after
    ]
    point, curve = state.rows.key.data[odd[0][0]], state.curves.key.data[odd[0][1]]
    raise wrong(f"{point!r} does not define {curve!r} just once, as its role says", "in the curves")
