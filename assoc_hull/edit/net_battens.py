"""The batten residuals of a hull, and which of its points fairing may move.

These are the points that a field may move, less those of features and all between the ends of a
feature on its curve: a straight run or an arc would be bent off its shape by them. All others stay
in the windows as they are, so that lines run smoothly into flats, knuckles and the profile.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.analysis.fairness.batten_problem import BattenProblem, batten_problem
from assoc_hull.edit.displacement_field import FieldContext
from assoc_hull.edit.hull_normals import free_normals, hull_normals, shape_columns
from assoc_hull.geometry.curves import IntArray
from assoc_hull.model.feature_geometry import host_curve
from assoc_hull.model.tables import HullState

__all__ = ["fairable_rows", "feature_rows", "net_battens"]


def net_battens(state: HullState, also: IntArray | None = None) -> BattenProblem:
    """Give the residuals of a whole net and how they change with all points that may be faired.

    `also` (k,) are points that may move besides, as they are asked for.
    """
    depends_on = (
        *shape_columns(state), state.rows.role, state.rows.driver, state.rows.anchor,
        state.rows.anchor_weight, state.rows.key, state.featured.alive, state.featured.feature,
    )  # fmt: skip
    rows = state.derived(("fairable rows",), depends_on, lambda: fairable_rows(state), most=1)
    if also is not None and not np.isin(also, rows).all():
        return _battens(state, _by_key(state, np.union1d(rows, also)))
    return state.derived(("battens",), depends_on, lambda: _battens(state, rows), most=1)


def _battens(state: HullState, rows: IntArray) -> BattenProblem:
    normal = hull_normals(state)
    return batten_problem(
        state, rows, normal, free_normals(state, np.arange(state.rows.count), normal)
    )


def fairable_rows(state: HullState) -> IntArray:
    """Give the points that fairing may move, by key."""
    ground = FieldContext(state, across_flats=False)
    free = ground.free()
    free = free[ground.freedoms(free).good]
    return _by_key(state, np.setdiff1d(free, feature_rows(state)))


def _by_key(state: HullState, rows: IntArray) -> IntArray:
    return np.array(sorted(rows.tolist(), key=state.rows.key.__getitem__), np.int64)


def feature_rows(state: HullState) -> IntArray:
    """Give the points of features, and all between the ends of each on its curve, ascending."""
    found: list[IntArray] = []
    for feature in state.features:
        points = np.array(feature.points, np.int64)
        found.append(points)
        curve = host_curve(state, feature)
        if curve >= 0:
            rows = state.curves.rows.data[curve]
            on = np.flatnonzero(np.isin(rows, points))
            if len(on) > 1:
                found.append(rows[on[0] : on[-1] + 1])
    return np.unique(np.concatenate([np.zeros(0, np.int64), *found]))
