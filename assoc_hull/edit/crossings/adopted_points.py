"""Adopted points and their links, and planes that are tangent to a feature.

`insert_defining_point` puts any point where it makes the least detour. Adopted points ride: they
go along with the driven points beside them, by links that are made anew when these change. A
watched gap over its limit is mended with an adopted point on the curve that gives way; one that
comes from definitions never does.

Planes that are tangent to a feature, and the lines that turn there.

A plane tangent to a round end meets it in a double root, on which rounding would decide. So
whoever makes the feature says where it is touched, and that is one crossing of sign 0: the line
comes to the boundary curve there, turns in a knuckle, and goes on. The double root itself counts
for nothing, nor does a meeting from which the curve hardly leaves the plane.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import attrs
import numpy as np

from assoc_hull.geometry.curves import (
    FloatArray,
    IntArray,
    PointKind,
    freeze,
)
from assoc_hull.geometry.splines.distance import closest_points
from assoc_hull.geometry.splines.segments import evaluate
from assoc_hull.graph.journal import Journal
from assoc_hull.model.generated_curves import attached_curves, kept_rows
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.make_objects import Maker, PointSpec
from assoc_hull.model.tables import CurveIntersections, HullState

__all__ = [
    "NO_ROOT",
    "PlaneTangency",
    "clear_at_tangencies",
    "hold_along_tangencies",
    "insert_defining_point",
    "insertion_index",
    "is_tangency",
    "least_detour",
    "link_adopted_points",
    "mend_gaps",
    "rebase_adopted_points",
    "renew_anchors",
    "runs_along_tangency",
    "swap_anchors",
    "tangency_rows",
    "without_double_roots",
]

NO_ROOT = -1
"""What stands for the number of a meeting at a touch, which is none."""

_DOUBLE = 0.02
"""Times `Tolerances.factor`: roots as near as this (m) to a touch are the double root that it
stands for."""

_FLAT = 2e-3
"""Times the same: a curve that stays as near as this (m) to a plane from a touch on does not
cross it there."""

_SAME = 1e-3
"""Times the same: points of a curve as near as this (m) are one."""

_PROBES = 33

_APART = 1e-3
"""Times the same: so far (m) a branch that runs along a cylinder stays on its side of the line of
touch, so that it meets no plane through it twice; off a cylinder of 1 m that is half a micrometre.
"""


@attrs.frozen(eq=False)
class PlaneTangency:
    """Where a plane touches a feature.

    Attributes
    ----------
    curve : int
        The curve that is the feature.
    line : int
        The line whose plane touches it.
    xyz : (3,), m
        The place, exactly on both.
    """

    curve: int
    line: int
    xyz: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.xyz)


def is_tangency(state: HullState, rows: IntArray) -> np.typing.NDArray[np.bool_]:
    """Tell which points are crossings at a touch."""
    table = state.rows
    crossing = table.alive[rows] & (table.sort[rows] == Sort.CROSSING)
    return np.asarray(crossing & table.contact[rows] & (table.sign[rows] == 0))


def tangency_rows(state: HullState, curve: int, line: int) -> list[int]:
    """Give the crossings at which a line touches a curve; one, or none."""
    rows: IntArray = state.curves.rows[curve]
    rows = rows[is_tangency(state, rows)]
    return [row for row in rows.tolist() if state.line_of(_other(state, row, curve)) == line]


def _other(state: HullState, row: int, curve: int) -> int:
    a, b = state.rows.curve[row].tolist()
    return int(b if a == curve else a)


def without_double_roots(
    state: HullState, xyz: FloatArray, place: FloatArray | None
) -> np.typing.NDArray[np.bool_]:
    """Tell which meetings (k, 3), m, a touch does not stand for, (k,) bool."""
    if place is None:
        return np.ones(len(xyz), bool)
    double = state.tolerances.factor * _DOUBLE
    return np.asarray(((xyz - place) ** 2).sum(axis=1) > double * double)


def clear_at_tangencies(maker: Maker, touches: Sequence[PlaneTangency]) -> None:
    """Make room on boundary curves for the crossings at touches.

    A point adopted where one comes to be goes; a crossing with another line reads the curve.
    """
    state = maker.state
    same = state.tolerances.factor * _SAME
    for each in touches:
        rows: IntArray = state.curves.rows[each.curve]
        near = ((state.rows.xyz[rows] - each.xyz) ** 2).sum(axis=1) <= same * same
        near[[0, -1]] = False
        gone = rows[near & ~is_tangency(state, rows)]
        if not len(gone):
            continue
        maker.define(each.curve, rows[~np.isin(rows, gone)])
        adopted = state.rows.sort[gone] == Sort.ADOPTED
        maker.remove_rows(gone[adopted])
        left = gone[~adopted]
        maker.roles(left, np.full(len(left), int(Role.DRIVES_B)))


def hold_along_tangencies(maker: Maker, line: int, touches: Sequence[PlaneTangency]) -> None:
    """Let both branches of a line that turns at a round end run straight along the cylinder.

    Sections of a cylinder are touched and not crossed, so they give the line no point. Where the
    last of them is touched each branch gets an adopted tangent point: up to there it is straight.
    """
    state = maker.state
    for curve in state.lines.curves[line]:
        rows: IntArray = state.curves.rows[curve]
        for row in rows[is_tangency(state, rows)].tolist():
            order = state.curves.rows[curve].tolist()
            at = order.index(row)
            if not 0 < at < len(order) - 1:
                continue
            specs = [_held(state, curve, row, order[at + step], step, touches) for step in (-1, 1)]
            made = [maker.points([each]).tolist() if each else [] for each in specs]
            maker.define(curve, [*order[:at], *made[0], row, *made[1], *order[at + 1 :]])


def _held(
    state: HullState, curve: int, turn: int, beside: int, step: int,
    touches: Sequence[PlaneTangency],
) -> PointSpec | None:  # fmt: skip
    """Give the point up to which a branch is straight, between its turn and the point beside it."""
    start: FloatArray = state.rows.xyz[turn]
    away = state.rows.xyz[beside] - start
    found, along, sense = None, 0.0, 1.0 if step > 0 else -1.0
    for each in touches:
        chord = each.xyz - start
        length, part = float(np.sqrt(chord @ chord)), float(chord @ away)
        # a touch beyond the next point of the branch is of another cylinder
        if along < length and 0.0 < part < float(away @ away):
            found, along = chord, length
    if found is None:
        return None
    unit = found / along
    across = away - (away @ unit) * unit
    size = float(np.sqrt(across @ across))
    apart = state.tolerances.factor * _APART
    if size <= apart or away @ unit <= along:
        return None
    chord = found + across * (apart / size)
    direction = sense * chord / np.sqrt(chord @ chord)
    return PointSpec(curve, start + chord, Sort.ADOPTED, PointKind.TANGENT, direction)


def runs_along_tangency(state: HullState, curve: int, spot: int) -> bool:
    """Tell whether a meeting with a line that touches a feature is none.

    From it to the next one, or to the touch, the curve hardly leaves the plane.
    """
    meets: CurveIntersections = state.curves.meets[curve]
    line = int(meets.line[spot])
    rows = np.concatenate([state.curves.rows[each] for each in state.lines.curves[line]])
    rows = rows[is_tangency(state, rows)]
    if not len(rows):
        return False
    passed = [parameter_at_tangency(state, curve, state.rows.xyz[row]) for row in rows.tolist()]
    here, along = float(meets.parameter[spot]), meets.line == line
    others = [*np.delete(meets.parameter[along], int(along[:spot].sum())).tolist(), *passed]
    plane = state.lines.normal[line], float(state.lines.offset[line])
    return any(stays_near_plane(state, curve, (here, at), plane) for at in others if at is not None)


def parameter_at_tangency(state: HullState, curve: int, place: FloatArray) -> float | None:
    """Give where a curve passes a touch, its parameter (m); None if it does not."""
    at, _, away = closest_points(state.spline(curve), 0, place[None])
    return float(at[0]) if float(away[0]) <= state.tolerances.factor * _FLAT else None


def stays_near_plane(
    state: HullState, curve: int, span: tuple[float, float], plane: tuple[FloatArray, float]
) -> bool:
    """Tell whether a curve hardly leaves a plane between two parameters (m)."""
    t = span[0] + (span[1] - span[0]) * np.linspace(0.0, 1.0, _PROBES)
    places = evaluate(state.spline(curve), np.zeros(_PROBES, np.int64), t)
    off = float(np.abs(places @ plane[0] - plane[1]).max())
    return off <= state.tolerances.factor * _FLAT


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
    anchor, xyz = state.rows.anchor.take(rows), state.rows.xyz.data
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
