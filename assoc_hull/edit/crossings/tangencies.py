"""Planes that are tangent to a feature, and the lines that turn there.

A plane tangent to a round end meets it in a double root, on which rounding would decide. So
whoever makes the feature says where it is touched, and that is one crossing of sign 0: the line
comes to the boundary curve there, turns in a knuckle, and goes on. The double root itself counts
for nothing, nor does a meeting from which the curve hardly leaves the plane.
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, PointKind, freeze
from assoc_hull.geometry.splines.distance import closest_points
from assoc_hull.geometry.splines.evaluation import evaluate
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.make_objects import Maker, PointSpec
from assoc_hull.model.tables import CurveIntersections, HullState

__all__ = [
    "NO_ROOT",
    "PlaneTangency",
    "clear_at_tangencies",
    "hold_along_tangencies",
    "is_tangency",
    "runs_along_tangency",
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
