"""From a definition back to a hull: with its published values as stored, or computed again.

Published values are splines, places of points and gaps. Where they are given they are put
back bit by bit and nothing is computed; where they are not, every curve is lofted and every
point computed, level by level. Curves that could not be made keep their last good shape.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import IntArray, SplineBatch
from assoc_hull.graph.journal import Journal
from assoc_hull.model.definition.canonical_columns import canonical_order, point_columns
from assoc_hull.model.definition.fill_tables import contradiction, make_tables, put_places
from assoc_hull.model.definition.schema import check_definition, check_published
from assoc_hull.model.gaps import gap_at, watched_on
from assoc_hull.model.generated_curves import unmade_rows
from assoc_hull.model.index import build_index
from assoc_hull.model.kinds import State
from assoc_hull.model.network import HullNetwork
from assoc_hull.model.node import Node
from assoc_hull.model.tables import HullState

__all__ = [
    "from_definition",
    "put_kept",
    "put_published",
    "rebuilt",
    "spline_of",
]

# --------------------------------------------------------------------------------------
# Stored values put back.

Record = Mapping[str, Any]


def spline_of(shape: Record, xyz: ArrayLike, key: str) -> SplineBatch:
    """Make a spline through defining points (n, 3), m, of stored arrays.

    These are ``knot`` (n,), m, from 0 upward, ``leave`` and ``arrive`` (n, 3); `key` is that of
    the curve, for the message.

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
        raise contradiction(
            f"it has {counts[0]} points, {counts[1]} knots and {counts[2:]} derivatives",
            where,
        )
    falls = np.flatnonzero(np.diff(knot) <= 0.0)
    if knot[0] != 0.0 or len(falls):
        at = int(falls[0]) + 1 if len(falls) else 0
        raise contradiction(f"knot {at} is {knot[at]!r}; knots begin at 0 and ascend", where)
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
        if state.curves.state[number] == State.CLEAN
    ]
    keys = {state.curves.key[number]: number for number in clean}
    _same("curves", set(keys), set(published["curves"]))
    for key, number in keys.items():
        shape = published["curves"][key]
        spline = spline_of(shape, state.rows.xyz[state.curves.rows[number]], key)
        journal.set(state.curves.spline, [number], [spline])
        put_places(state, journal, number, shape["meets"])


def _put_values(state: HullState, journal: Journal, points: Record) -> None:
    order = canonical_order(state)
    columns = point_columns(state, order)
    lists = {name: np.asarray(columns[name]) for name in ("stored", "watched")}
    for name, needed, column in (
        ("value", ~lists["stored"], state.rows.xyz),
        ("gap", lists["watched"], state.rows.gap),
    ):
        rows = order.rows[needed]
        keys = [state.rows.key[row] for row in rows.tolist()]
        _same(f"points with a {name}", set(keys), {k for k, each in points.items() if name in each})
        if keys:
            journal.put(column, rows, [points[key][name] for key in keys])


def _same(what: str, needed: set[str], given: set[str]) -> None:
    odd = sorted(needed ^ given)
    if odd:
        act = "misses" if odd[0] in needed else "has no use for"
        raise contradiction(f"it {act} {odd[0]!r}", f"in the published {what}")


# --------------------------------------------------------------------------------------
# The whole hull. Made from the definition alone, it has the bits of one that was brought there by
# edits: levels follow the driven links.


def from_definition(
    given: Mapping[str, Any], published: Mapping[str, Any] | None = None
) -> HullState:
    """Make a hull of its definition.

    Parameters
    ----------
    given : mapping
        As `assoc_hull.model.definition.records.definition` gives it.
    published : mapping or None
        As `assoc_hull.model.definition.records.published` gives it: put back as it is. If None,
        all derived values are made from the definition.

    Returns
    -------
    HullState
        Rows in canonical order; revisions begin at 0.

    Raises
    ------
    BadInputError
        If the form is wrong, a name refers to nothing, parts contradict one another, or a
        rebuilt curve meets its partners otherwise than the definition says.
    AssocHullError
        If a curve cannot be made.
    """
    check_definition(given)
    if published is None:
        state, misfits = rebuilt(given)
    else:
        check_published(published)
        state, misfits = _stored(given, published), []
    if misfits:
        raise BadInputError(
            f"{len(misfits)} curves meet other lines than the definition says",
            f"first at the curve {misfits[0]!r}",
            "take the file from where it was written",
        )
    return state


def _stored(given: Mapping[str, Any], published: Mapping[str, Any]) -> HullState:
    state, journal = make_tables(given), Journal()
    put_kept(state, journal, list(given["curves"]))
    put_published(state, journal, published)
    _settle_spots(state, journal)
    return state


def rebuilt(given: Mapping[str, Any]) -> tuple[HullState, list[str]]:
    """Make everything from a definition of the right form.

    Returns
    -------
    HullState, list of str
        The hull, and the keys of the curves that meet their partners' planes otherwise
        than the definition says.
    """
    state, journal = make_tables(given), Journal()
    put_kept(state, journal, list(given["curves"]))
    misfits = _rebuild(state, journal)
    _settle_spots(state, journal)
    return state, misfits


def _rebuild(state: HullState, journal: Journal) -> list[str]:
    """Evaluate all that is up to date, level by level; what failed or is blocked stays."""
    network = HullNetwork(state, build_index(state))
    for nodes in _by_level(network, _all_nodes(state)):
        network.evaluate(nodes, journal)
    watched = watched_on(state, state.live("curves"))
    if len(watched):
        journal.put(state.rows.gap, watched, gap_at(state, watched))
        journal.put(state.rows.xyz, watched, state.rows.spot[watched, 0])
    return [str(state.curves.key[each.curve]) for each in network.realigned]


def _all_nodes(state: HullState) -> IntArray:
    """Give every curve, computed, riding and generated point that is up to date."""
    rows, curves = state.live("rows"), state.live("curves")
    table = state.rows
    made = (table.driver[rows] >= 0) | (table.anchor[rows] >= 0).any(axis=1)
    made |= ~unmade_rows(state, rows)
    rows = rows[made & (table.state[rows] == State.CLEAN)]
    curves = curves[state.curves.state[curves] == State.CLEAN]
    return np.concatenate([Node.point(rows), Node.curve(curves)])


def _by_level(network: HullNetwork, nodes: IntArray) -> list[IntArray]:
    if not len(nodes):
        return []
    level = network.level(nodes)
    return [nodes[level == each] for each in np.unique(level).tolist()]


def _settle_spots(state: HullState, journal: Journal) -> None:
    """Store the crossing itself as its place on a curve that has no intersection there."""
    rows = state.live("rows")
    spot, xyz = state.rows.spot[rows], state.rows.xyz[rows]
    unknown = np.isnan(spot) & (state.rows.curve[rows] >= 0)[:, :, None]
    journal.put(state.rows.spot, rows, np.where(unknown, xyz[:, None, :], spot))
