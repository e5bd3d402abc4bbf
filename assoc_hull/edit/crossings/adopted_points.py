"""Adopted points: put among those that define a curve, linked, and used to close gaps.

`insert_defining_point` puts any point where it makes the least detour. Adopted points ride: they
go along with the driven points beside them, by links that are made anew when these change. A
watched gap over its limit is mended with an adopted point on the curve that gives way; one that
comes from definitions never does.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from assoc_hull.edit.crossings.tangencies import is_tangency
from assoc_hull.geometry.curves import FloatArray, IntArray, PointKind
from assoc_hull.graph.journal import Journal
from assoc_hull.model.generated_curves import attached_curves, kept_rows
from assoc_hull.model.kinds import Sort
from assoc_hull.model.make_objects import Maker, PointSpec
from assoc_hull.model.tables import HullState

__all__ = [
    "insert_defining_point",
    "insertion_index",
    "least_detour",
    "link_adopted_points",
    "mend_gaps",
    "rebase_adopted_points",
    "renew_anchors",
    "swap_anchors",
]


def insertion_index(xyz: FloatArray, place: FloatArray) -> int:
    """Give the index before which a place belongs: the least detour from neighbour to neighbour.

    `xyz` (n, 3), m, are the points of a curve in order, `place` (3,), m, is the new one.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.edit.crossings.adopted_points import insertion_index
    >>> insertion_index(np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0]]), np.array([1.0, 0.5, 0]))
    2
    """
    return int(_detours(xyz, place).argmin()) + 1


def least_detour(xyz: FloatArray, place: FloatArray) -> float:
    """Give the least detour (m) through a place, from one point of a curve (n, 3) to the next."""
    return float(_detours(xyz, place).min())


def _detours(xyz: FloatArray, place: FloatArray) -> FloatArray:
    to = np.sqrt(((xyz - place) ** 2).sum(axis=1))
    step = np.sqrt((np.diff(xyz, axis=0) ** 2).sum(axis=1))
    found: FloatArray = to[:-1] + to[1:] - step
    return found


def insert_defining_point(maker: Maker, curve: int, row: int) -> None:
    """Let a point define a curve, between the two points it lies between."""
    rows: IntArray = maker.state.curves.rows[curve]
    place = maker.state.rows.xyz[row]
    index = insertion_index(maker.state.rows.xyz[rows], place)
    maker.define(curve, np.insert(rows, index, row))


# --------------------------------------------------------------------------------------
# Riding. An adopted point holds a shape that crossings alone cannot. Its place is its base plus a
# linear blend of the displacements of its nearest driven neighbours since they were last linked;
# so there and back is exact. A generated point does not ride, and none that was one: definitions
# place it, or a designer did. Nor does what stands in for a crossing, nor what holds a line on a
# cylinder.


def link_adopted_points(state: HullState, curves: IntArray, journal: Journal) -> None:
    """Link the adopted points of curves to their driven neighbours as these lie now."""
    found = _riders(state, curves)
    if found is None:
        return
    rows, owner, adopted, pair, anchor = found
    points, alone = rows[adopted], (pair < 0).all(axis=1)
    journal.put(state.rows.anchor, points, anchor)
    linked = points[~alone]
    weights = _weights(state, rows, owner, adopted[~alone], pair[~alone])
    journal.put(state.rows.anchor_weight, linked, weights)
    rebase_adopted_points(state, linked, journal)


def _riders(
    state: HullState, curves: IntArray
) -> tuple[IntArray, IntArray, IntArray, IntArray, IntArray] | None:
    """Find the adopted points of curves that may ride.

    Gives the defining points, the index of the curve of each, and of the adopted ones the index
    among them, that of the neighbours (k, 2), and with which of these rows they ride; -1 for none.
    """
    parts = [state.curves.rows[curve] for curve in curves.tolist()]
    if not parts:
        return None
    rows, size = np.concatenate(parts), np.array([len(part) for part in parts])
    owner = np.arange(len(parts)).repeat(size)
    rides = state.rows.sort[rows] == Sort.ADOPTED
    kept, stand_ins = kept_rows(state), np.array([*state.rows.stands_for.data.given], np.int64)
    if len(kept) or len(stand_ins):
        rides &= ~np.isin(rows, np.concatenate([kept, stand_ins]))
    rides[_held_by_tangency(state, rows, np.flatnonzero(rides))] = False
    adopted, others = np.flatnonzero(rides), np.flatnonzero(~rides)
    if not len(adopted):
        return None
    after = np.searchsorted(others, adopted)
    pair = np.full((len(adopted), 2), -1)
    for side, place in enumerate((after - 1, after)):
        there = np.flatnonzero((place >= 0) & (place < len(others)))
        beside = others[place[there]]
        mine = owner[beside] == owner[adopted[there]]
        pair[there[mine], side] = beside[mine]
    anchor = np.where(pair >= 0, rows[np.maximum(pair, 0)], -1)
    driven = (anchor >= 0) & (state.rows.driver[anchor] >= 0)
    if len(stand_ins):
        # What rode with a crossing goes on with its stand-in.
        driven |= np.isin(anchor, stand_ins) & (anchor == state.rows.anchor[rows[adopted]])
    return rows, owner, adopted, pair, np.where(driven, anchor, -1)


def _held_by_tangency(state: HullState, rows: IntArray, adopted: IntArray) -> IntArray:
    """Give those of adopted points, as places in `rows`, up to which a line is on a cylinder."""
    at = adopted[state.rows.kind[rows[adopted], 0] == PointKind.TANGENT]
    beside = np.clip(at[:, None] + np.array([-1, 1]), 0, len(rows) - 1)
    held = is_tangency(state, rows[beside].ravel()).reshape(beside.shape).any(axis=1)
    found: IntArray = at[held]
    return found


def swap_anchors(state: HullState, curve: int, swaps: dict[int, int], journal: Journal) -> None:
    """Let points that rode with some go on with others, which lie where those did.

    Links that say no more or less than before stay, so that there and back is exact.
    """
    found = _anchored(state, curve)
    old = state.rows.anchor[found]
    new = np.array([[swaps.get(row, row) for row in pair] for pair in old.tolist()], np.int64)
    changed = (new.reshape(-1, 2) != old).any(axis=1)
    journal.put(state.rows.anchor, found[changed], new[changed])


def renew_anchors(state: HullState, curve: int, journal: Journal) -> None:
    """Link the adopted points of a curve whose neighbours have come to be driven, or ceased to.

    A link that stays is not made anew: the points keep their places, to the bit.
    """
    found = _riders(state, np.array([curve]))
    if found is None:
        return
    rows, owner, adopted, pair, anchor = found
    table, points = state.rows, rows[adopted]
    changed = np.flatnonzero((anchor != table.anchor[points]).any(axis=1))
    for i in changed.tolist():
        point, before = int(points[i]), table.anchor[points[i]].copy()
        journal.put(table.anchor, [point], anchor[i][None])
        lost = before[(before >= 0) & ~np.isin(before, anchor[i])]
        come = anchor[i][(anchor[i] >= 0) & ~np.isin(anchor[i], before)]
        since = table.anchor_from[point].copy()
        sides = np.flatnonzero(np.isin(before, lost) & (before >= 0))
        still = bool((since[sides] == table.xyz[before[sides]]).all())
        if (before < 0).all() or not still:
            weight = _weights(state, rows, owner, adopted[[i]], pair[[i]])
            journal.put(table.anchor_weight, [point], weight)
            rebase_adopted_points(state, np.array([point]), journal)
            continue
        for side in range(2):
            if anchor[i, side] in come:
                since[side] = table.xyz[anchor[i, side]]
            elif anchor[i, side] < 0:
                since[side] = 0.0
        journal.put(table.anchor_from, [point], since[None])


def _anchored(state: HullState, curve: int) -> IntArray:
    """Give the points of a curve that ride."""
    rows: IntArray = state.curves.rows[curve]
    found: IntArray = rows[(state.rows.anchor[rows] >= 0).any(axis=1)]
    return found


def _weights(
    state: HullState, rows: IntArray, owner: IntArray, adopted: IntArray, pair: IntArray
) -> np.typing.NDArray[np.float64]:
    """Give the part of the way from the first to the second neighbour, by chords, (k,)."""
    step = np.diff(state.rows.xyz[rows], axis=0)
    length = np.sqrt((step * step).sum(axis=1))
    chord = np.zeros(len(rows))
    begin = np.flatnonzero(np.diff(owner, prepend=-1, append=-1))
    for first, last in pairwise(begin.tolist()):
        np.cumsum(length[first : last - 1], out=chord[first + 1 : last])
    low, high = chord[np.maximum(pair[:, 0], 0)], chord[np.maximum(pair[:, 1], 0)]
    whole = np.where(high > low, high - low, 1.0)
    weight = np.where(
        pair[:, 0] < 0, 1.0, np.where(pair[:, 1] < 0, 0.0, (chord[adopted] - low) / whole)
    )
    return np.asarray(weight, np.float64)


def rebase_adopted_points(state: HullState, rows: IntArray, journal: Journal) -> None:
    """Make the present places of adopted points, and of their neighbours, those they ride from."""
    if not len(rows):
        return
    anchor, xyz = state.rows.anchor.data.take(rows, axis=0), state.rows.xyz.data
    at = np.where((anchor >= 0)[:, :, None], xyz.take(anchor, axis=0, mode="wrap"), 0.0)
    journal.put(state.rows.base, rows, xyz.take(rows, axis=0))
    journal.put(state.rows.anchor_from, rows, at)


# --------------------------------------------------------------------------------------
# Mending a watched gap: the curve of higher rank gets a point where the other passes, unless a
# crossing or a border holds it just there.

_NEAR = 0.15
"""Times `Tolerances.factor`: an adopted point as near as this (m) is moved instead of setting
another beside it,"""

_NEARER = 3.0
"""and one that is nearer by this factor than the points before and after the place: two side by
side would bend the curve both ways."""


def mend_gaps(
    maker: Maker, rows: IntArray, on: IntArray | None = None
) -> tuple[IntArray, IntArray]:
    """Close gaps over their limit at watched crossings (k,), in the given order.

    `on` (k,) are the curves that are to give way; the one of higher rank, else the other, if None.
    Gives the curves whose recipe changed, and the points that were moved.
    """
    state, curves, moved = maker.state, set[int](), set[int]()
    giving = state.rows.curve[rows, 1] if on is None else on
    for row, curve in zip(rows.tolist(), giving.tolist(), strict=True):
        pair: list[int] = state.rows.curve[row].tolist()
        # where a fixed point beside the crossing holds one curve, the other gives way
        other = pair[1 - pair.index(curve)]
        for yielding in (curve,) if on is not None else (curve, other):
            place = state.rows.spot[row, 1 - pair.index(yielding)].copy()
            point = _hold(maker, yielding, place)
            if point is not None:
                curves.add(yielding)
                moved |= {point} - {-1}
                break
    touched = np.array(sorted(curves), np.int64)
    link_adopted_points(state, touched, maker.journal)
    return touched, np.array(sorted(moved), np.int64)


def _hold(maker: Maker, curve: int, place: FloatArray) -> int | None:
    """Lead a curve through a place: give the point moved there, -1 for a new one, None if held."""
    state = maker.state
    if curve in attached_curves(state):
        return None
    defining: IntArray = state.curves.rows[curve]
    away = np.sqrt(((state.rows.xyz[defining] - place) ** 2).sum(axis=1))
    nearest = int(away.argmin())
    others = np.delete(away, nearest)
    crowded = state.rows.sort[defining[nearest]] == Sort.ADOPTED and (
        away[nearest] * _NEARER < others.min(initial=np.inf)
    )
    if away[nearest] >= state.tolerances.factor * _NEAR and not crowded:
        point = maker.points([PointSpec(curve, place, Sort.ADOPTED)])[0]
        insert_defining_point(maker, curve, int(point))
        return -1
    if state.rows.sort[defining[nearest]] != Sort.ADOPTED:
        return None
    maker.journal.put(state.rows.xyz, [defining[nearest]], [place])
    return int(defining[nearest])
