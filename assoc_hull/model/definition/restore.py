"""From a definition back to a hull, and whether a hull is what its definition gives.

Published values are splines, places of points and gaps. Where they are given they are put
back bit by bit and nothing is computed; where they are not, every curve is lofted and every
point computed, level by level. Curves that could not be made keep their last good shape.

The comparison of a hull with what its own definition gives.

Examples
--------
>>> from assoc_hull.model.tables import HullState, Particulars
>>> from assoc_hull.model.definition.restore import verify
>>> verify(HullState(Particulars("S", 9.0, 2.0, 1.0, 1.0)))
[]
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.errors import AssocHullError, BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.graph.journal import Journal
from assoc_hull.model.definition.canonical_columns import (
    canonical_order,
    meet_columns,
    point_columns,
    value_columns,
)
from assoc_hull.model.definition.fill_tables import contradiction, make_tables, put_places
from assoc_hull.model.definition.records import check_definition, check_published, definition
from assoc_hull.model.gaps import gap_at, watched_on
from assoc_hull.model.generated_curves import unmade_rows
from assoc_hull.model.index import build_index
from assoc_hull.model.kinds import State
from assoc_hull.model.network import HullNetwork
from assoc_hull.model.node import Node
from assoc_hull.model.tables import HullState

__all__ = [
    "Difference",
    "from_definition",
    "put_kept",
    "put_published",
    "rebuilt",
    "spline_of",
    "verify",
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


@attrs.frozen
class Difference:
    """One derived value that is not what the definition gives.

    Attributes
    ----------
    key : str
        Key of the curve or point.
    field : str
        Which value, for instance ``"spline.leave"``.
    amount : float
        Largest difference of its numbers, m where it is a length; inf where they cannot be
        compared.
    """

    key: str
    field: str
    amount: float


def verify(state: HullState, relative: float = 0.0) -> list[Difference]:
    """Rebuild a hull beside the published one, and give every derived value that differs.

    Parameters
    ----------
    state : HullState
        The published tables; only read.
    relative : float
        0 compares bits. On another machine 1e-12 allows for its arithmetic: a value may
        then differ by this part of the largest number of its array, of 1 at least.

    Returns
    -------
    list of Difference
        By object, then field; empty if there is none.
    """
    try:
        other, misfits = rebuilt(definition(state))
    except AssocHullError as error:
        return [Difference(state.particulars.name, f"rebuild: {error}", float("inf"))]
    found = [Difference(key, "meetings", float("inf")) for key in misfits]
    found += _points(state, other, relative)
    found += _links(state, other)
    theirs = dict(_curves(other))
    for place, mine in _curves(state):
        amount = _apart(mine, theirs[place], relative)
        if amount is not None:
            found.append(Difference(*place, amount))
    return sorted(found, key=lambda each: (each.key, each.field))


def _points(state: HullState, other: HullState, relative: float) -> Iterator[Difference]:
    """Compare places of points and watched gaps."""
    order = canonical_order(state)
    one, two = value_columns(state, order), value_columns(other, canonical_order(other))
    for field in one:
        mine, theirs = np.asarray(one[field]), np.asarray(two[field])
        for place in np.flatnonzero(_odd(mine, theirs)).tolist():
            amount = _apart(np.atleast_1d(mine[place]), np.atleast_1d(theirs[place]), relative)
            if amount is not None:
                yield Difference(state.rows.key[order.rows[place]], field, amount)


def _odd(one: FloatArray, other: FloatArray) -> np.typing.NDArray[np.bool_]:
    """Tell which rows differ by a bit."""
    differs = _bits(one) != _bits(other)
    found: np.typing.NDArray[np.bool_] = differs.any(axis=1) if differs.ndim > 1 else differs
    return found


def _bits(values: FloatArray) -> IntArray:
    found: IntArray = np.ascontiguousarray(values, np.float64).view(np.int64)
    return found


def _links(state: HullState, other: HullState) -> Iterator[Difference]:
    """Compare which curves each point defines and which drives it with what its role says."""
    mine, theirs = canonical_order(state), canonical_order(other)
    for field in ("reader", "driver"):
        one = mine.curve[getattr(state.rows, field).data[mine.rows]]
        two = theirs.curve[getattr(other.rows, field).data[theirs.rows]]
        odd = (one != two).any(axis=1) if one.ndim > 1 else one != two
        for place in np.flatnonzero(odd).tolist():
            yield Difference(state.rows.key[mine.rows[place]], field, float("inf"))


def _curves(state: HullState) -> Iterator[tuple[tuple[str, str], FloatArray]]:
    """Give spline and places of meetings of each curve, by key of the curve and field."""
    order = canonical_order(state)
    met = {name: np.asarray(part) for name, part in meet_columns(state, order).items()}
    first = np.searchsorted(met["owner"], np.arange(len(order.curves) + 1)).tolist()
    for place, number in enumerate(order.curves.tolist()):
        key, spline = str(state.curves.key[number]), state.spline(number)
        for name in ("knot", "xyz", "leave", "arrive"):
            yield (key, f"spline.{name}"), getattr(spline, name)
        for name in ("parameter", "xyz"):
            yield (key, f"meetings.{name}"), met[name][first[place] : first[place + 1]]


def _apart(one: FloatArray, other: FloatArray, relative: float) -> float | None:
    """Give how far two arrays differ, None if they agree."""
    if one.shape != other.shape:
        return float("inf")
    if not one.size or np.array_equal(_bits(one), _bits(other)):
        return None
    amount = float(np.abs(one - other).max())
    if not np.isfinite(amount):
        return float("inf")
    most = max(1.0, float(np.abs(one).max()), float(np.abs(other).max()))
    return None if relative > 0.0 and amount <= relative * most else amount
