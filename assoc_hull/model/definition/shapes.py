"""Published values put back as they are stored: splines, places of points, gaps.

Nothing is computed here, so what was written comes back to the last bit.

Examples
--------
>>> from assoc_hull.model.definition.shapes import spline_of
>>> spline_of(
...     {"knot": [0, 1], "leave": [[1, 0, 0]] * 2, "arrive": [[1, 0, 0]] * 2},
...     [[0, 0, 0], [1, 0, 0]],
...     "c",
... ).knot
array([0., 1.])
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.geometry.curves import SplineBatch
from assoc_hull.graph.journal import Journal
from assoc_hull.model.definition.canonical_columns import places, point_columns
from assoc_hull.model.definition.filling import wrong
from assoc_hull.model.definition.meetings import put_places
from assoc_hull.model.kinds import State
from assoc_hull.model.state import HullState

__all__ = ["put_kept", "put_published", "spline_of"]

Record = Mapping[str, Any]


def spline_of(shape: Record, xyz: ArrayLike, key: str) -> SplineBatch:
    """Make a spline of stored arrays.

    Parameters
    ----------
    shape : mapping
        ``knot`` (n,), m, from 0 upward; ``leave`` and ``arrive`` (n, 3).
    xyz : (n, 3), m
        The defining points.
    key : str
        Key of the curve, for the message.

    Raises
    ------
    BadInputError
        If the arrays are not of one length, or a knot is not above the one before.
    """
    points = np.array(xyz, np.float64)
    knot = np.array(shape["knot"], np.float64)
    leave, arrive = (np.array(shape[name], np.float64) for name in ("leave", "arrive"))
    where, counts = f"at the curve {key!r}", [len(part) for part in (points, knot, leave, arrive)]
    if len(set(counts)) > 1:
        raise wrong(
            f"it has {counts[0]} points, {counts[1]} knots and {counts[2:]} derivatives",
            where,
        )
    falls = np.flatnonzero(np.diff(knot) <= 0.0)
    if knot[0] != 0.0 or len(falls):
        at = int(falls[0]) + 1 if len(falls) else 0
        raise wrong(f"knot {at} is {knot[at]!r}; knots begin at 0 and ascend", where)
    return SplineBatch(np.array([0, len(knot)], np.int64), knot, points, leave, arrive)


def put_kept(state: HullState, journal: Journal, curves: list[Record]) -> None:
    """Give the curves that could not be made their last good shape."""
    for record in curves:
        if "kept" not in record:
            continue
        number, shape = state.curves.key.data.index(record["key"]), record["kept"]
        spline = spline_of(shape, shape["xyz"], record["key"])
        journal.set(state.curves.spline, [number], [spline])
        put_places(state, journal, number, shape["meets"])


def put_published(state: HullState, journal: Journal, published: Record) -> None:
    """Put all derived values of a hull back.

    Raises
    ------
    BadInputError
        If there are values for other curves or points than those that need them.
    """
    _put_values(state, journal, published["points"])
    clean = [
        number
        for number in state.live("curves").tolist()
        if state.curves.state.data[number] == State.CLEAN
    ]
    keys = {state.curves.key.data[number]: number for number in clean}
    _same("curves", set(keys), set(published["curves"]))
    for key, number in keys.items():
        shape = published["curves"][key]
        spline = spline_of(shape, state.rows.xyz.data[state.curves.rows.data[number]], key)
        journal.set(state.curves.spline, [number], [spline])
        put_places(state, journal, number, shape["meets"])


def _put_values(state: HullState, journal: Journal, points: Record) -> None:
    order = places(state)
    columns = point_columns(state, order)
    lists = {name: np.asarray(columns[name]) for name in ("stored", "watched")}
    for name, needed, column in (
        ("value", ~lists["stored"], state.rows.xyz),
        ("gap", lists["watched"], state.rows.gap),
    ):
        rows = order.rows[needed]
        keys = [state.rows.key.data[row] for row in rows.tolist()]
        _same(f"points with a {name}", set(keys), {k for k, each in points.items() if name in each})
        if keys:
            journal.put(column, rows, [points[key][name] for key in keys])


def _same(what: str, needed: set[str], given: set[str]) -> None:
    odd = sorted(needed ^ given)
    if odd:
        act = "misses" if odd[0] in needed else "has no use for"
        raise wrong(f"it {act} {odd[0]!r}", f"in the published {what}")
