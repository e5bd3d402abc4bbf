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

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.splines.distance import closest_points
from assoc_hull.geometry.splines.evaluation import evaluate
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.make_objects import Maker
from assoc_hull.model.tables import CurveIntersections, HullState

__all__ = [
    "NO_ROOT",
    "PlaneTangency",
    "clear_at_tangencies",
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
